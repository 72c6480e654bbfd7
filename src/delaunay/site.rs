//! Sites: the distinct places at which the triangulation has vertices.
//!
//! Predicates read sites through [`Sites`], without a bounds check: the corners of cells are indices of sites by the
//! kernel's invariants, which [`validate`](super::Delaunay::validate) checks. (Checks cost 6 % of a 3D build.)

#![allow(unsafe_code)]

use crate::complex::NONE;
use crate::delaunay::{Dimension, Plane, Space};
use crate::simd::{ALL, Avx2, LANES};

/// A place and the vertex that represents it. Index 0 is a placeholder for the ghost vertex.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Site<G: Dimension> {
    /// The place.
    pub point: G::Point,
    /// A cell that has the site as a corner; [`NONE`] while there is none.
    pub cell: u32,
    /// The vertex at the place, the lowest id if there are several: ties between signs are broken by it.
    /// [`NONE`] if the index is free.
    pub id: u32,
}

impl<G: Dimension> Site<G> {
    /// A site that is in no cell yet.
    pub fn new(point: G::Point, id: u32) -> Self {
        Site { point, cell: NONE, id }
    }

    /// Whether the index is in use.
    #[inline(always)]
    pub fn is_live(&self) -> bool {
        self.id != NONE
    }
}

/// The sites of a triangulation, for its own corners.
#[derive(Clone, Copy, Debug)]
pub struct Sites<'s, G: Dimension>(&'s [Site<G>]);

impl<'s, G: Dimension> Sites<'s, G> {
    /// The caller passes only corners of cells of the triangulation whose sites these are, and such sites themselves.
    pub(super) fn new(sites: &'s [Site<G>]) -> Self {
        Sites(sites)
    }

    /// The place of a corner; a meaningless one for the ghost vertex.
    #[inline(always)]
    pub fn point(self, s: u32) -> &'s G::Point {
        debug_assert!((s as usize) < self.0.len());
        // SAFETY: `s` is a corner of a cell, so the index of a site (see `new`).
        unsafe { &self.0.get_unchecked(s as usize).point }
    }

    /// The vertex id of a corner.
    #[inline(always)]
    pub fn id(self, s: u32) -> u32 {
        debug_assert!((s as usize) < self.0.len());
        // SAFETY: as for `point`.
        unsafe { self.0.get_unchecked(s as usize).id }
    }
}

const _: () = assert!(size_of::<Site<Space>>() == size_of::<[f64; 4]>());

impl<'s> Sites<'s, Space> {
    /// The place of a corner, and a fourth number without a meaning: one load for all three coordinates.
    #[inline(always)]
    pub fn padded_point(self, s: u32) -> &'s [f64; 4] {
        debug_assert!((s as usize) < self.0.len());
        // SAFETY: as for `point`.
        unsafe { self.0.get_unchecked(s as usize) }.padded()
    }
}

impl Site<Space> {
    /// The place, and a fourth number without a meaning.
    #[inline(always)]
    fn padded(&self) -> &[f64; 4] {
        // SAFETY: a site is as long as four numbers, all bits of it are set, and any bits are a number.
        unsafe { &*std::ptr::from_ref(self).cast() }
    }

    /// The same, to write.
    #[inline(always)]
    fn padded_mut(&mut self) -> &mut [f64; 4] {
        // SAFETY: likewise, and any bits are a cell and an id.
        unsafe { &mut *std::ptr::from_mut(self).cast() }
    }
}

/// As [`Dimension::exchange`]. All is read before anything is written.
#[inline(always)]
pub(super) fn exchange_in_plane(
    avx2: Avx2,
    places: &mut [[f64; 2]; LANES],
    sites: &mut [Site<Plane>],
    sites_of: &[u32; LANES],
) -> u64 {
    let [s, t, u, v] = sites_of.map(|s| s as usize);
    let (first, last) = halves(places);
    let new = [avx2.load(first), avx2.load(last)];
    let old =
        [avx2.two_pairs(&sites[s].point, &sites[t].point), avx2.two_pairs(&sites[u].point, &sites[v].point)];
    new[0].store_low_to(&mut sites[s].point);
    new[0].store_high_to(&mut sites[t].point);
    new[1].store_low_to(&mut sites[u].point);
    new[1].store_high_to(&mut sites[v].point);
    old[0].store_to(first);
    old[1].store_to(last);
    let same = [new[0].are_same(old[0]).bits(), new[1].are_same(old[1]).bits()];
    let same = [same[0] & 3, same[0] >> 2, same[1] & 3, same[1] >> 2];
    same.iter().map(|&bits| u64::from(bits != 3)).sum()
}

#[inline(always)]
fn halves(places: &mut [[f64; 2]; LANES]) -> (&mut [f64; LANES], &mut [f64; LANES]) {
    let halves = places.as_flattened_mut().as_chunks_mut().0;
    let [first, last] = halves else { unreachable!("four pairs") };
    (first, last)
}

/// As [`Dimension::exchange`]. All is read before anything is written.
#[inline(always)]
pub(super) fn exchange_in_space(
    avx2: Avx2,
    places: &mut [[f64; 3]; LANES],
    sites: &mut [Site<Space>],
    sites_of: &[u32; LANES],
) -> u64 {
    let [s, t, u, v] = sites_of.map(|s| s as usize);
    let places = places.as_flattened_mut();
    let new = [
        avx2.load(from(places, 0)),
        avx2.load(from(places, 3)),
        avx2.load(from(places, 6)),
        avx2.load(from(places, 8)).rotated(),
    ];
    let old = [
        avx2.load(sites[s].padded()),
        avx2.load(sites[t].padded()),
        avx2.load(sites[u].padded()),
        avx2.load(sites[v].padded()),
    ];
    // What is behind a site's point stays.
    let new = [
        new[0].with_last_of(old[0]),
        new[1].with_last_of(old[1]),
        new[2].with_last_of(old[2]),
        new[3].with_last_of(old[3]),
    ];
    new[0].store_to(sites[s].padded_mut());
    new[1].store_to(sites[t].padded_mut());
    new[2].store_to(sites[u].padded_mut());
    new[3].store_to(sites[v].padded_mut());
    // Each has one number too many, which the next one mends.
    old[0].store_to(from(places, 0));
    old[1].store_to(from(places, 3));
    old[2].store_to(from(places, 6));
    old[3].store_three_to(from(places, 9));
    (0..LANES).map(|k| u64::from(new[k].are_same(old[k]).bits() != ALL)).sum()
}

/// As many numbers from one of them on as are wanted.
#[inline(always)]
fn from<const N: usize>(numbers: &mut [f64], first: usize) -> &mut [f64; N] {
    numbers[first..].first_chunk_mut().expect("all are there")
}
