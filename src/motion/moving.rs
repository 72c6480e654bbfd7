//! All vertices of a whole staging, moved in one loop.
//!
//! Applying a move exchanges the staged position with that of the vertex's site. Vertices are taken in the order of
//! their ids, and sites are stored in another one, so of a large triangulation they are asked for in advance. Positions
//! that are not staged yet are staged block by block on the way: so they are read once, and written once more in the
//! cache next to the processor.
//!
//! Every vertex must have a site of its own: a staging is whole only if no vertex is removed, and none may be hidden.
//!
//! Cost of a hundred thousand vertices, tests included: 3.3 ns each in the plane, 4.1 in space (`make targets`,
//! `tolerance_test`).

#![allow(unsafe_code)]

use std::ops::ControlFlow;

use super::MovingTriangulation;
use super::attempt::Advance;
use super::slack::Slacks;
use super::staging::{Given, first_bad, stage_block};
use super::tolerance::Fixed;
use crate::delaunay::{Dimension, Site};
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::prefetch::{AHEAD, CACHE_BYTES, prefetch, prefetch_at};
use crate::machine::{memory, threads};
use crate::predicates::{are_within, distance_above, distances_above};
use crate::simd::{ALL, Avx2, LANES, Lanes};

/// Moves of this number of vertices take a few times as long as a thread takes to wake up.
const MOVED_AT_LEAST: usize = 1 << 14;

/// Whether two places, without negative zeros, differ.
#[inline(always)]
pub(super) fn differ<G: Dimension>(p: &G::Point, q: &G::Point) -> bool {
    (0..G::D).fold(0, |bits, axis| bits | (p[axis].to_bits() ^ q[axis].to_bits())) != 0
}

/// Exchanges a position with that of a site; whether they differ.
#[inline(always)]
fn exchange<G: Dimension>(point: &mut G::Point, p: &mut G::Point) -> bool {
    let differ = differ::<G>(point, p);
    std::mem::swap(point, p);
    differ
}

/// Vertices that are staged at a time: a few kilobytes, and whole lanes.
const BLOCK: usize = 16 * LANES;

/// What a motion on record has found.
pub(super) struct Motion {
    /// How many positions differ.
    pub(super) moved: u64,
    /// The longest way.
    pub(super) greatest: f64,
    /// Whether the unit of ways still fits.
    pub(super) fits: bool,
}

/// Vertices that go to their new places unless they have to wait.
struct Movers<'m, G: Dimension> {
    sites: &'m mut [Site<G>],
    /// Vertices beyond their tolerance, of which there may be `most`.
    queue: &'m mut Vec<VertexId>,
    most: usize,
    n_moved: u64,
}

impl<G: Dimension> Movers<'_, G> {
    /// Queues those of a few vertices of which a bit is set, and moves the others, or all if `MOVES_ALL`; ends, and
    /// does nothing, where there is no room in the queue.
    #[cold]
    #[inline(never)]
    fn queue_or_move<const MOVES_ALL: bool>(
        &mut self,
        first: usize,
        beyond: u32,
        places: &mut [G::Point],
        sites_of: &[SiteId],
    ) -> ControlFlow<Result<()>> {
        self.queue(first, beyond)?;
        for (k, (p, &s)) in places.iter_mut().zip(sites_of).enumerate() {
            if MOVES_ALL || beyond >> k & 1 == 0 {
                self.n_moved += self.exchange(p, s);
            }
        }
        ControlFlow::Continue(())
    }

    /// Exchanges a position with that of a site; returns how many differ.
    #[inline(always)]
    fn exchange(&mut self, p: &mut G::Point, s: SiteId) -> u64 {
        u64::from(exchange::<G>(&mut self.sites[s].point, p))
    }

    fn queue(&mut self, first: usize, beyond: u32) -> ControlFlow<Result<()>> {
        if self.queue.len() + beyond.count_ones() as usize > self.most {
            return ControlFlow::Break(Ok(()));
        }
        if self.queue.capacity() - self.queue.len() < LANES
            && let Err(error) = memory::reserve(self.queue, LANES)
        {
            return ControlFlow::Break(Err(error));
        }
        self.queue.extend((0..LANES).filter(|k| beyond >> k & 1 == 1).map(|k| VertexId::at(first + k)));
        ControlFlow::Continue(())
    }
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Of a whole staging, moves the vertices within their tolerance, or all if `MOVES_ALL`, and queues the others; the
    /// staging holds the old positions of those that have moved. None moves if those to be queued are more than `most`.
    ///
    /// This loop is what a timestamp costs that changes nothing.
    ///
    /// Undoing knows which vertices have moved: the staging says that the others are applied, and so are those queued
    /// if `MOVES_ALL`. That holds also after the error that one of the positions given is bad, when some are at other
    /// places than given.
    pub(super) fn move_and_queue<const MOVES_ALL: bool>(
        &mut self,
        most: usize,
        given: &mut Given<'_, G>,
    ) -> Result<Advance> {
        let mut blocks = Blocks { given: given.positions(), are_good: true };
        let moved = if size_of_val(self.kernel.sites()) > CACHE_BYTES {
            self.move_and_queue_from::<MOVES_ALL, true>(most, &mut blocks)?
        } else {
            self.move_and_queue_from::<MOVES_ALL, false>(most, &mut blocks)?
        };
        if moved != Advance::TooManyBeyond {
            blocks.end(given)?;
        }
        Ok(moved)
    }

    /// As [`move_and_queue`](Self::move_and_queue). `IS_FAR` asks for sites in advance.
    fn move_and_queue_from<const MOVES_ALL: bool, const IS_FAR: bool>(
        &mut self,
        most: usize,
        blocks: &mut Blocks<'_, G>,
    ) -> Result<Advance> {
        if let Some(avx2) = Avx2::new() {
            return avx2.run_with(
                self,
                most,
                blocks,
                #[inline(always)]
                |t, most, blocks| {
                    t.move_and_queue_by::<MOVES_ALL, IS_FAR>(
                        most,
                        blocks,
                        #[inline(always)]
                        |fixed, places| {
                            let tolerances = fixed.each_ref().map(Fixed::tolerance);
                            let fixed = fixed.each_ref().map(Fixed::point);
                            are_within(avx2, fixed, &tolerances, places.each_ref())
                        },
                        #[inline(always)]
                        |movers, places, sites_of| {
                            // SAFETY: every vertex has a site of its own.
                            let sites = unsafe { sites_at(movers.sites.as_mut_ptr(), sites_of) };
                            G::exchange(avx2, places, sites, &mut [avx2.splat(0.0); 2])
                        },
                    )
                },
            );
        }
        self.move_and_queue_by::<MOVES_ALL, IS_FAR>(
            most,
            blocks,
            |fixed, places| bits_of(fixed, places),
            |movers, places, sites_of| {
                places.iter_mut().zip(sites_of).map(|(p, &s)| movers.exchange(p, s)).sum()
            },
        )
    }

    /// As [`move_and_queue`](Self::move_and_queue), by a test and an exchange of several vertices.
    #[inline(always)]
    fn move_and_queue_by<const MOVES_ALL: bool, const IS_FAR: bool>(
        &mut self,
        most: usize,
        blocks: &mut Blocks<'_, G>,
        hold: impl Fn(&[Fixed<G>; LANES], &[G::Point; LANES]) -> u32,
        exchange: impl Fn(&mut Movers<'_, G>, &mut [G::Point; LANES], &[SiteId; LANES]) -> u64,
    ) -> Result<Advance> {
        let n = self.site_of.len();
        let sites = self.kernel.sites_mut();
        let (positions, queue) = self.staging.parts_mut();
        let mut movers = Movers { sites, queue, most, n_moved: 0 };
        let positions = &mut positions[..n];
        let (fixed, last_fixed) = self.regions.fixed()[..n].as_chunks::<LANES>();
        let (sites_of, last_sites_of) = self.site_of.as_chunks::<LANES>();
        let mut ended = None;
        'blocks: for (block, positions) in positions.chunks_mut(BLOCK).enumerate() {
            let first = block * BLOCK;
            blocks.stage(first, positions, &self.site_of[first..], movers.sites);
            let (places, last_places) = positions.as_chunks_mut::<LANES>();
            let (fixed, at) = (&fixed[first / LANES..], &sites_of[first / LANES..]);
            for (k, ((places, fixed), at)) in places.iter_mut().zip(fixed).zip(at).enumerate() {
                let k = first / LANES + k;
                if IS_FAR && let Some(next) = sites_of.get(k + AHEAD / LANES) {
                    next.iter().for_each(|&s| prefetch(movers.sites, s.index()));
                }
                let beyond = !hold(fixed, places) & ALL;
                if beyond == 0 {
                    movers.n_moved += exchange(&mut movers, places, at);
                } else if let ControlFlow::Break(room) =
                    movers.queue_or_move::<MOVES_ALL>(k * LANES, beyond, places, at)
                {
                    ended = Some((k * LANES, room));
                    break 'blocks;
                }
            }
            if !last_places.is_empty() {
                let first = sites_of.len() * LANES;
                let beyond = !bits_of(last_fixed, last_places) & ((1 << last_places.len()) - 1);
                if let ControlFlow::Break(room) =
                    movers.queue_or_move::<MOVES_ALL>(first, beyond, last_places, last_sites_of)
                {
                    ended = Some((first, room));
                    break;
                }
            }
        }
        let n_moved = movers.n_moved;
        let Some((end, room)) = ended else {
            self.staging.apply_others();
            if MOVES_ALL {
                self.staging.set_applied(self.staging.vertices().len());
            }
            return Ok(Advance::Moved(n_moved));
        };
        let queue = std::mem::take(self.staging.vertices_mut());
        let not_moved = if MOVES_ALL { &[] } else { &queue[..] };
        // Those that have not moved are exchanged in vain.
        for v in VertexId::range(0..end).chain(not_moved.iter().copied()) {
            self.exchange_position(v);
        }
        *self.staging.vertices_mut() = queue;
        self.staging.vertices_mut().clear();
        room.map(|()| Advance::TooManyBeyond)
    }

    /// Moves all vertices of a whole staging, on several threads where that pays; returns how many positions differ.
    /// Errors as those of [`move_and_queue`](Self::move_and_queue).
    pub(super) fn move_all_staged(&mut self, given: &mut Given<'_, G>) -> Result<u64> {
        let n_threads = self.kernel.threads().for_work(self.site_of.len(), MOVED_AT_LEAST, 256);
        let sites = self.kernel.sites_mut();
        let sites = SharedSites { start: sites.as_mut_ptr(), n: sites.len() };
        // SAFETY: every vertex has a site of its own, and these are borrowed for as long as this takes.
        let moved = unsafe {
            sites.move_all(self.staging.positions_mut(), given.positions(), &self.site_of, n_threads)
        };
        self.staging.apply_others();
        self.kernel.cover(&moved.lower, &moved.upper);
        Blocks { given: given.positions(), are_good: moved.are_good }.end(given)?;
        Ok(moved.n)
    }

    /// Moves all vertices of a whole staging, and adds to the ways of their sites. Slacks must be kept. Errors as those
    /// of [`move_and_queue`](Self::move_and_queue).
    pub(super) fn move_all_on_record(&mut self, given: &mut Given<'_, G>) -> Result<Motion> {
        let Some(avx2) = Avx2::new() else {
            return self.move_all_on_record_by(given, |sites, places, sites_of| {
                let pairs = std::iter::zip(places, sites_of);
                let mut distances = [0.0; LANES];
                std::iter::zip(&mut distances, pairs).for_each(|(distance, (p, &s))| {
                    *distance = distance_above(&sites[s].point, p);
                    std::mem::swap(&mut sites[s].point, p);
                });
                distances
            });
        };
        avx2.run_with(
            avx2,
            self,
            given,
            #[inline(always)]
            |avx2, t, given| {
                t.move_all_on_record_by(
                    given,
                    #[inline(always)]
                    |sites, places, sites_of| {
                        // SAFETY: every vertex has a site of its own.
                        let sites = unsafe { sites_at(sites.as_mut_ptr(), sites_of) };
                        let old = [&sites[0].point, &sites[1].point, &sites[2].point, &sites[3].point];
                        let distances = distances_above(avx2, old, places.each_ref());
                        G::exchange(avx2, places, sites, &mut [avx2.splat(0.0); 2]);
                        distances
                    },
                )
            },
        )
    }

    /// As [`move_all_on_record`](Self::move_all_on_record), by an exchange of several positions that tells how far
    /// apart they were, at most.
    #[inline(always)]
    fn move_all_on_record_by(
        &mut self,
        given: &mut Given<'_, G>,
        mut exchange: impl FnMut(&mut [Site<G>], &mut [G::Point; LANES], &[SiteId; LANES]) -> [f64; LANES],
    ) -> Result<Motion> {
        let slacks = self.regions.slacks().expect("they have been prepared");
        let mut record = Record { longest: slacks.longest_way(), n: 0, sum: 0.0, greatest: 0.0 };
        let sites = self.kernel.sites_mut();
        let is_far = size_of_val(sites) > CACHE_BYTES;
        let mut blocks = Blocks { given: given.positions(), are_good: true };
        for (first, positions) in (0..).step_by(BLOCK).zip(self.staging.positions_mut().chunks_mut(BLOCK)) {
            blocks.stage(first, positions, &self.site_of[first..], sites);
            let sites_of = &self.site_of[first..];
            let (places, last_places) = positions.as_chunks_mut::<LANES>();
            let (at, last_at) = sites_of[..LANES * places.len() + last_places.len()].as_chunks::<LANES>();
            for (k, (places, at)) in places.iter_mut().zip(at).enumerate() {
                if is_far && let Some(next) = sites_of.get(k * LANES + AHEAD..) {
                    next.iter().take(LANES).for_each(|s| prefetch(sites, s.index()));
                }
                let distances = exchange(sites, places, at);
                at.iter().zip(distances).for_each(|(&s, distance)| record.enter(slacks, s, distance));
            }
            for (p, &s) in last_places.iter_mut().zip(last_at) {
                let point = &mut sites[s].point;
                record.enter(slacks, s, distance_above(point, p));
                std::mem::swap(point, p);
            }
        }
        self.staging.apply_others();
        let Record { n: moved, sum, greatest, .. } = record;
        let fits = slacks.end_motion(&mut self.kernel, sum / moved.max(1) as f64, greatest);
        blocks.end(given)?;
        Ok(Motion { moved, greatest, fits })
    }
}

/// The ways of vertices that are moved on record.
struct Record {
    /// No way counts as longer in the sum.
    longest: f64,
    /// How many vertices have moved, the sum of their ways, and the longest one.
    n: u64,
    sum: f64,
    greatest: f64,
}

impl Record {
    /// Adds to the way of a site, unless it stays where it is.
    #[inline(always)]
    fn enter<G: Dimension>(&mut self, slacks: &mut Slacks<G>, s: SiteId, distance: f64) {
        if distance == 0.0 {
            return;
        }
        slacks.travel(s, distance);
        self.sum += if distance < self.longest { distance } else { self.longest };
        self.greatest = if distance > self.greatest { distance } else { self.greatest };
        self.n += 1;
    }
}

/// Stages positions that are not staged yet, block by block.
struct Blocks<'p, G: Dimension> {
    given: Option<&'p [G::Point]>,
    are_good: bool,
}

impl<G: Dimension> Blocks<'_, G> {
    /// Stages the positions of the vertices from `first` on; for bad ones those where the vertices are.
    #[inline(always)]
    fn stage(&mut self, first: usize, staged: &mut [G::Point], sites_of: &[SiteId], sites: &[Site<G>]) {
        if let Some(given) = self.given {
            let place = |k: usize| sites[sites_of[k]].point;
            self.are_good &= stage_good::<G>(staged, &given[first..], place);
        }
    }

    /// Everything is staged.
    fn end(self, given: &mut Given<'_, G>) -> Result<()> {
        given.take();
        match self.given {
            Some(positions) if !self.are_good => Err(first_bad::<G>(positions)),
            _ => Ok(()),
        }
    }
}

/// Stages positions, and other ones in the place of those that are bad; whether none is.
#[inline(always)]
fn stage_good<G: Dimension>(
    staged: &mut [G::Point],
    given: &[G::Point],
    other: impl Fn(usize) -> G::Point,
) -> bool {
    let are_good = stage_block::<G>(staged, given);
    if !are_good {
        for (k, p) in staged.iter_mut().enumerate() {
            if !stage_block::<G>(std::slice::from_mut(p), &given[k..]) {
                *p = other(k);
            }
        }
    }
    are_good
}

/// A bit for each of a few vertices that is certainly within its tolerance.
#[inline(always)]
fn bits_of<G: Dimension>(fixed: &[Fixed<G>], places: &[G::Point]) -> u32 {
    let hold = fixed.iter().zip(places).map(|(fixed, p)| fixed.holds(p));
    hold.enumerate().fold(0, |bits, (k, holds)| bits | u32::from(holds) << k)
}

/// How many positions differ, a box that holds the new ones, and whether all of these were good.
struct Moved<G: Dimension> {
    n: u64,
    are_good: bool,
    lower: G::Point,
    upper: G::Point,
}

impl<G: Dimension> Moved<G> {
    fn none() -> Self {
        let (mut lower, mut upper) = (G::Point::default(), G::Point::default());
        for axis in 0..G::D {
            (lower[axis], upper[axis]) = (f64::INFINITY, f64::NEG_INFINITY);
        }
        Moved { n: 0, are_good: true, lower, upper }
    }

    #[inline(always)]
    fn hold(&mut self, lower: &G::Point, upper: &G::Point) {
        for axis in 0..G::D {
            self.hold_along(axis, lower[axis], upper[axis]);
        }
    }

    #[inline(always)]
    fn hold_along(&mut self, axis: usize, lower: f64, upper: f64) {
        let (least, greatest) = (&mut self.lower[axis], &mut self.upper[axis]);
        *least = if lower < *least { lower } else { *least };
        *greatest = if upper > *greatest { upper } else { *greatest };
    }

    /// Holds a box in lanes, as [`exchange`](crate::delaunay::kernel::Kernel::exchange) has them.
    fn hold_lanes(&mut self, [lower, upper]: [Lanes; 2]) {
        for (lane, (lower, upper)) in lower.store().into_iter().zip(upper.store()).enumerate() {
            let axis = lane % G::D.next_power_of_two();
            if axis < G::D {
                self.hold_along(axis, lower, upper);
            }
        }
    }
}

/// Several sites.
///
/// # Safety
/// These are indices of the sites that begin there, no two the same, and nobody else uses them meanwhile.
#[inline(always)]
unsafe fn sites_at<'s, G: Dimension>(
    start: *mut Site<G>,
    sites_of: &[SiteId; LANES],
) -> [&'s mut Site<G>; LANES] {
    // SAFETY: the caller's promise.
    sites_of.map(|s| unsafe { &mut *start.add(s.index()) })
}

/// Sites that several threads move, each some of them.
#[derive(Clone, Copy)]
struct SharedSites<G: Dimension> {
    start: *mut Site<G>,
    n: usize,
}

// SAFETY: who uses them promises that no two threads use the same site (`move_all`).
unsafe impl<G: Dimension> Send for SharedSites<G> {}

impl<G: Dimension> SharedSites<G> {
    /// Exchanges positions with those of sites.
    ///
    /// # Safety
    /// `sites_of` are indices of these sites, no two the same, and nobody else uses the sites meanwhile.
    unsafe fn move_all(
        self,
        positions: &mut [G::Point],
        given: Option<&[G::Point]>,
        sites_of: &[SiteId],
        n_threads: usize,
    ) -> Moved<G> {
        if n_threads > 1 {
            let middle = positions.len() / n_threads * (n_threads / 2);
            let (positions, more_positions) = positions.split_at_mut(middle);
            let (given, more_given) = given.map(|given| given.split_at(middle)).unzip();
            let (sites_of, more_sites_of) = sites_of.split_at(middle);
            let n_more_threads = n_threads - n_threads / 2;
            let (mut moved, more) = threads::join(
                // SAFETY: as for the whole; the two halves have no site in common.
                || unsafe { self.move_all(positions, given, sites_of, n_threads / 2) },
                // SAFETY: likewise.
                move || unsafe { self.move_all(more_positions, more_given, more_sites_of, n_more_threads) },
            );
            moved.n += more.n;
            moved.are_good &= more.are_good;
            moved.hold(&more.lower, &more.upper);
            return moved;
        }
        let Some(avx2) = Avx2::new() else {
            // SAFETY: the caller's promise.
            return unsafe {
                self.move_blocks(positions, given, sites_of, |sites, moved, places, sites_of| {
                    places.iter_mut().zip(sites_of).for_each(|(p, &s)| sites.move_one(p, s, moved));
                })
            };
        };
        let mut covered = [avx2.splat(f64::INFINITY), avx2.splat(f64::NEG_INFINITY)];
        let mut moved = avx2.run_with(
            self,
            (positions, given, sites_of),
            &mut covered,
            #[inline(always)]
            |sites, (positions, given, sites_of), covered| {
                // SAFETY: the caller's promise.
                unsafe {
                    sites.move_blocks(
                        positions,
                        given,
                        sites_of,
                        #[inline(always)]
                        |sites, moved, places, sites_of| {
                            let sites = sites_at(sites.start, sites_of);
                            moved.n += G::exchange(avx2, places, sites, covered);
                        },
                    )
                }
            },
        );
        moved.hold_lanes(covered);
        moved
    }

    /// As [`move_all`](Self::move_all), block by block, and by an exchange of several positions.
    ///
    /// # Safety
    /// As for [`move_all`](Self::move_all).
    #[inline(always)]
    unsafe fn move_blocks(
        self,
        positions: &mut [G::Point],
        given: Option<&[G::Point]>,
        sites_of: &[SiteId],
        mut exchange: impl FnMut(Self, &mut Moved<G>, &mut [G::Point; LANES], &[SiteId; LANES]),
    ) -> Moved<G> {
        debug_assert!(sites_of.iter().all(|s| s.index() < self.n));
        let is_far = self.n * size_of::<Site<G>>() > CACHE_BYTES;
        let mut moved = Moved::none();
        for (first, positions) in (0..).step_by(BLOCK).zip(positions.chunks_mut(BLOCK)) {
            let sites_of = &sites_of[first..];
            if let Some(given) = given {
                // SAFETY: these are indices of sites that nobody else uses.
                let place = |k: usize| unsafe { (*self.start.add(sites_of[k].index())).point };
                moved.are_good &= stage_good::<G>(positions, &given[first..], place);
            }
            let (places, last_places) = positions.as_chunks_mut::<LANES>();
            let (at, last_at) = sites_of[..LANES * places.len() + last_places.len()].as_chunks::<LANES>();
            for (k, (places, at)) in places.iter_mut().zip(at).enumerate() {
                if is_far && let Some(next) = sites_of.get(k * LANES + AHEAD..) {
                    next.iter().take(LANES).for_each(|s| prefetch_at(self.start.wrapping_add(s.index())));
                }
                exchange(self, &mut moved, places, at);
            }
            for (p, &s) in last_places.iter_mut().zip(last_at) {
                // SAFETY: the caller's promise.
                unsafe { self.move_one(p, s, &mut moved) };
            }
        }
        moved
    }

    /// Exchanges a position with that of a site.
    ///
    /// # Safety
    /// As for [`move_all`](Self::move_all).
    #[inline(always)]
    unsafe fn move_one(self, p: &mut G::Point, s: SiteId, moved: &mut Moved<G>) {
        moved.hold(p, p);
        // SAFETY: `s` is the index of a site that nobody else uses.
        let point = unsafe { &mut (*self.start.add(s.index())).point };
        moved.n += u64::from(exchange::<G>(point, p));
    }
}

#[cfg(test)]
mod tests;
