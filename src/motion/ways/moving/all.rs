//! All vertices moved, whatever their tolerances, on several threads where that pays.

use crate::delaunay::{Moving, Site};
use crate::error::Result;
use crate::ids::SiteId;
use crate::machine::prefetch::{AHEAD, CACHE_BYTES, prefetch_at};
use crate::machine::threads;
use crate::motion::state::goals::Moves;
use crate::motion::state::mesh::Mesh;
use crate::motion::ways::moving::{BLOCK, copy_good, exchange, sites_at};
use crate::simd::{LANES, Lanes, Simd, in_lanes};

/// Moves of this number of vertices take a few times as long as a thread takes to wake up.
const MOVED_AT_LEAST: usize = 1 << 14;

impl<G: Moving> Mesh<G> {
    /// Moves all vertices, on several threads where that pays; returns how many goals differ from the places before.
    /// The origins of all are known afterwards, also after the error that one of the goals is bad.
    pub(in crate::motion) fn move_everything(&mut self, moves: &mut Moves<'_, G>) -> Result<u64> {
        let n_threads = self.kernel.threads().for_work(self.site_of.len(), MOVED_AT_LEAST, 256);
        let origins = self.transaction.origins_mut().of_all_mut(self.site_of.len())?;
        let sites = self.kernel.sites_mut();
        let sites = SharedSites { start: sites.as_mut_ptr(), n: sites.len() };
        // SAFETY: every vertex has a site of its own, and these are borrowed for as long as this takes.
        let moved = unsafe { sites.move_all(origins, moves.unchecked(), &self.site_of, n_threads) };
        self.transaction.origins_mut().note_all();
        self.kernel.cover(&moved.lower, &moved.upper);
        moves.end_check(moved.are_good)?;
        Ok(moved.n)
    }
}

/// How many positions differ, a box that holds the new ones, and whether all of these were good.
struct Moved<G: Moving> {
    n: u64,
    are_good: bool,
    lower: G::Point,
    upper: G::Point,
}

impl<G: Moving> Moved<G> {
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

    /// Holds a box in lanes, as exchanges of positions have them.
    fn hold_lanes<L: Lanes>(&mut self, [lower, upper]: [L; 2]) {
        for (lane, (lower, upper)) in lower.store().into_iter().zip(upper.store()).enumerate() {
            let axis = lane % G::D.next_power_of_two();
            if axis < G::D {
                self.hold_along(axis, lower, upper);
            }
        }
    }
}

/// Sites that several threads move, each some of them.
#[derive(Clone, Copy)]
struct SharedSites<G: Moving> {
    start: *mut Site<G>,
    n: usize,
}

// SAFETY: callers of the functions below promise that no two threads use the same site.
unsafe impl<G: Moving> Send for SharedSites<G> {}

impl<G: Moving> SharedSites<G> {
    /// Moves sites to their goals, and enters their origins.
    ///
    /// # Safety
    /// `sites_of` are indices of these sites, no two the same, and nothing else uses the sites meanwhile.
    unsafe fn move_all(
        self,
        origins: &mut [G::Point],
        goals: &[G::Point],
        sites_of: &[SiteId],
        n_threads: usize,
    ) -> Moved<G> {
        if n_threads > 1 {
            let middle = origins.len() / n_threads * (n_threads / 2);
            let (origins, more_origins) = origins.split_at_mut(middle);
            let (goals, more_goals) = goals.split_at(middle);
            let (sites_of, more_sites_of) = sites_of.split_at(middle);
            let n_more_threads = n_threads - n_threads / 2;
            let (mut moved, more) = threads::join(
                // SAFETY: the caller's promise, for a half of the sites; the two halves have no site in common.
                || unsafe { self.move_all(origins, goals, sites_of, n_threads / 2) },
                // SAFETY: the caller's promise, for the other half.
                move || unsafe { self.move_all(more_origins, more_goals, more_sites_of, n_more_threads) },
            );
            moved.n += more.n;
            moved.are_good &= more.are_good;
            moved.hold(&more.lower, &more.upper);
            return moved;
        }
        in_lanes!(simd, self, (origins, goals), sites_of => |sites, (origins, goals), sites_of| {
                let mut covered = [simd.splat(f64::INFINITY), simd.splat(f64::NEG_INFINITY)];
                // SAFETY: the caller's promise.
                let mut moved = unsafe {
                    sites.move_blocks(
                        origins,
                        goals,
                        sites_of,
                        #[inline(always)]
                        |sites, moved, places, sites_of| {
                            let sites = sites_at(sites.start, sites.n, sites_of);
                            moved.n += G::exchange(simd, places, sites, &mut covered);
                        },
                    )
                };
                moved.hold_lanes(covered);
                moved
        })
    }

    /// Copies goals block by block, and exchanges them with the positions of sites by an exchange of several at a time.
    ///
    /// # Safety
    /// `sites_of` are indices of these sites, no two the same, and nothing else uses the sites meanwhile.
    #[inline(always)]
    unsafe fn move_blocks(
        self,
        origins: &mut [G::Point],
        goals: &[G::Point],
        sites_of: &[SiteId],
        mut exchange: impl FnMut(Self, &mut Moved<G>, &mut [G::Point; LANES], &[SiteId; LANES]),
    ) -> Moved<G> {
        debug_assert!(sites_of.iter().all(|s| s.index() < self.n));
        let is_far = self.n * size_of::<Site<G>>() > CACHE_BYTES;
        let mut moved = Moved::none();
        for (first, positions) in (0..).step_by(BLOCK).zip(origins.chunks_mut(BLOCK)) {
            let sites_of = &sites_of[first..];
            // SAFETY: these are indices of sites that nothing else uses.
            let place = |k: usize| unsafe { (*self.start.add(sites_of[k].index())).point };
            moved.are_good &= copy_good::<G>(positions, &goals[first..], place);
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
    /// `s` is the index of one of these sites, which nothing else uses meanwhile.
    #[inline(always)]
    unsafe fn move_one(self, p: &mut G::Point, s: SiteId, moved: &mut Moved<G>) {
        moved.hold(p, p);
        // SAFETY: `s` is the index of a site that nothing else uses.
        let point = unsafe { &mut (*self.start.add(s.index())).point };
        moved.n += u64::from(exchange::<G>(point, p));
    }
}
