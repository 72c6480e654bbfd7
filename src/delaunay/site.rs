//! Sites: the distinct places at which the triangulation has vertices.
//!
//! Predicates read sites through [`Sites`], without a bounds check: the corners of cells are indices of sites by the
//! kernel's invariants, which [`validate`](super::Delaunay::validate) checks. (Checks cost 6 % of a 3D build.)

#![allow(unsafe_code)]

use super::keys::Keys;
use super::shape::{PowerPlane, Shape, Space};
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::prefetch::prefetch;

/// A place and the vertex that represents it. Index 0 is a placeholder for the ghost vertex.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Site<G: Shape> {
    /// The place.
    pub point: G::Point,
    /// A cell that has the site as a corner; [`Slot::NONE`] while there is none.
    pub cell: Slot,
    /// The vertex at the place, the one of the lowest key and then of the lowest id if there are several: ties between
    /// signs are broken by its key. [`VertexId::NONE`] if the index is free.
    pub id: VertexId,
}

impl<G: Shape> Site<G> {
    /// A site that is in no cell yet.
    pub fn new(point: G::Point, id: VertexId) -> Self {
        Site { point, cell: Slot::NONE, id }
    }

    /// Whether the index is in use.
    #[inline(always)]
    pub fn is_live(&self) -> bool {
        self.id != VertexId::NONE
    }
}

/// The sites of a triangulation, for its own corners.
#[derive(Clone, Copy, Debug)]
pub struct Sites<'s, G: Shape> {
    sites: &'s [Site<G>],
    keys: &'s Keys,
}

impl<'s, G: Shape> Sites<'s, G> {
    /// The caller passes only corners of cells of the triangulation whose sites these are, and such sites themselves.
    #[inline(always)]
    pub(super) fn new(sites: &'s [Site<G>], keys: &'s Keys) -> Self {
        Sites { sites, keys }
    }

    #[inline(always)]
    fn site(self, s: SiteId) -> &'s Site<G> {
        debug_assert!(s.index() < self.sites.len());
        // SAFETY: `s` is a corner of a cell, so the index of a site (see `new`).
        unsafe { self.sites.get_unchecked(s.index()) }
    }

    /// The place of a corner; a meaningless one for the ghost vertex.
    #[inline(always)]
    pub fn point(self, s: SiteId) -> &'s G::Point {
        &self.site(s).point
    }

    /// The places of the corners of a cell, as [`point`](Self::point) has them; in the plane the last is there twice.
    #[inline(always)]
    pub fn points(self, v: &G::Corners) -> [&'s G::Point; 4] {
        [0, 1, 2, G::D].map(|i| self.point(v[i]))
    }

    /// Asks for a site.
    #[inline(always)]
    pub(super) fn prefetch(self, s: SiteId) {
        prefetch(self.sites, s.index());
    }

    /// The vertex id of a corner.
    #[inline(always)]
    pub fn id(self, s: SiteId) -> VertexId {
        self.site(s).id
    }

    /// The keys of vertices.
    #[inline(always)]
    pub(super) fn keys(self) -> &'s Keys {
        self.keys
    }
}

impl<'s> Sites<'s, Space> {
    /// The place of a corner, and a fourth number without a meaning: one load for all three coordinates.
    #[inline(always)]
    pub fn padded_point(self, s: SiteId) -> &'s [f64; 4] {
        self.site(s).padded()
    }
}

/// A shape whose points are three numbers.
pub trait ThreeNumbers: Shape {
    /// Whether a site is as long as four numbers.
    const FITS: () = assert!(size_of::<Site<Self>>() == size_of::<[f64; 4]>() && Self::NUMBERS == 3);
}

impl ThreeNumbers for Space {}
impl ThreeNumbers for PowerPlane {}

impl<G: ThreeNumbers> Site<G> {
    /// The three numbers of the point, and a fourth one without a meaning.
    #[inline(always)]
    pub(super) fn padded(&self) -> &[f64; 4] {
        const { G::FITS };
        // SAFETY: a site is as long as four numbers, all bits of it are set, and any bits are a number.
        unsafe { &*std::ptr::from_ref(self).cast() }
    }

    /// The three numbers of the point, and a fourth one without a meaning, to write. That one is the site's cell and id.
    #[inline(always)]
    pub(super) fn padded_mut(&mut self) -> &mut [f64; 4] {
        const { G::FITS };
        // SAFETY: a site is as long as four numbers, all bits of it are set, and any bits are numbers, or a cell and an
        // id.
        unsafe { &mut *std::ptr::from_mut(self).cast() }
    }
}
