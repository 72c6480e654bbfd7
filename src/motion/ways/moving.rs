//! All vertices, moved in one loop.
//!
//! Block by block goals are checked and copied to where the origins are to be, in the cache next to the processor, and
//! there exchanged with the positions of the sites. So goals are read once, and origins written once to memory.
//! Vertices are taken in the order of their ids, and sites are stored in another one, so of a large triangulation they
//! are asked for in advance.
//!
//! Every vertex must have a site of its own: none may be removed, and none hidden.
//!
//! Cost of a hundred thousand vertices, tests included: 3.3 ns each in the plane, 4.1 in space (`make targets`,
//! `tolerance_test`).

#![allow(unsafe_code)]
// Clippy does not see the SAFETY lines of blocks inside of `in_lanes!`.
#![allow(clippy::undocumented_unsafe_blocks)]

mod all;
mod on_record;

use std::ops::ControlFlow;

use crate::delaunay::{Moving, Site};
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::{AHEAD, CACHE_BYTES, prefetch};
use crate::motion::filters::tolerance::Fixed;
use crate::motion::state::checking::{copy_checked, differ};
use crate::motion::state::goals::Moves;
use crate::motion::state::mesh::Mesh;
use crate::predicates::are_within;
use crate::simd::{ALL, LANES, Simd, in_lanes};
pub(in crate::motion) use on_record::Motion;

/// Exchanges a position with that of a site; whether they differ.
#[inline(always)]
fn exchange<G: Moving>(point: &mut G::Point, p: &mut G::Point) -> bool {
    let differ = differ::<G>(point, p);
    std::mem::swap(point, p);
    differ
}

/// Vertices that are staged at a time: a few kilobytes, and whole lanes.
const BLOCK: usize = 16 * LANES;

/// What has become of all vertices when those beyond their tolerance are queued.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Advance {
    /// How many have moved to another position; those beyond are queued.
    Moved(u64),
    /// Too many are beyond; none has moved, and none is queued.
    TooManyBeyond,
}

/// Tolerances by vertex id, and those vertices that leave theirs, of which there may be `most`.
pub(in crate::motion) struct Beyond<'b, G: Moving> {
    pub(in crate::motion) fixed: &'b [Fixed<G>],
    pub(in crate::motion) most: usize,
    pub(in crate::motion) queue: &'b mut Vec<VertexId>,
}

/// Vertices that go to their new places unless they have to wait.
struct MovingSites<'m, G: Moving> {
    sites: &'m mut [Site<G>],
    /// Vertices beyond their tolerance, of which there may be `most`.
    queue: &'m mut Vec<VertexId>,
    most: usize,
    n_moved: u64,
}

impl<G: Moving> MovingSites<'_, G> {
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

impl<G: Moving> Mesh<G> {
    /// Moves the vertices that are within their tolerance, or all if `MOVES_ALL`, and queues those that are not. None
    /// moves if those to be queued are more than `most`.
    ///
    /// A timestamp that changes nothing costs the loop of this function.
    ///
    /// The origins of all are known afterwards, also after the error that one of the goals is bad, when some vertices
    /// have stayed where they were.
    pub(in crate::motion) fn move_and_queue<const MOVES_ALL: bool>(
        &mut self,
        moves: &mut Moves<'_, G>,
        beyond: &mut Beyond<'_, G>,
    ) -> Result<Advance> {
        beyond.queue.clear();
        let mut blocks = Blocks::of(moves);
        let moved = if size_of_val(self.kernel.sites()) > CACHE_BYTES {
            self.move_and_queue_from::<MOVES_ALL, true>(&mut blocks, beyond)?
        } else {
            self.move_and_queue_from::<MOVES_ALL, false>(&mut blocks, beyond)?
        };
        if moved != Advance::TooManyBeyond {
            moves.end_check(blocks.are_good)?;
        }
        Ok(moved)
    }

    /// Does what [`move_and_queue`](Self::move_and_queue) does, and asks for sites in advance if `IS_FAR`.
    fn move_and_queue_from<const MOVES_ALL: bool, const IS_FAR: bool>(
        &mut self,
        blocks: &mut Blocks<'_, G>,
        beyond: &mut Beyond<'_, G>,
    ) -> Result<Advance> {
        in_lanes!(simd, self, blocks, beyond => |t, blocks, beyond| {
                    t.move_and_queue_by::<MOVES_ALL, IS_FAR>(
                        blocks,
                        beyond,
                        #[inline(always)]
                        |fixed, places| {
                            let tolerances = fixed.each_ref().map(Fixed::tolerance);
                            let fixed = fixed.each_ref().map(Fixed::point);
                            are_within(simd, fixed, &tolerances, places.each_ref())
                        },
                        #[inline(always)]
                        |movers, places, sites_of| {
                            // SAFETY: every vertex has a site of its own, and the sites are borrowed.
                            let sites =
                                unsafe { sites_at(movers.sites.as_mut_ptr(), movers.sites.len(), sites_of) };
                            G::exchange(simd, places, sites, &mut [simd.splat(0.0); 2])
                        },
                    )
        })
    }

    /// Does what [`move_and_queue`](Self::move_and_queue) does, by tests and exchanges of several vertices at a time.
    #[inline(always)]
    fn move_and_queue_by<const MOVES_ALL: bool, const IS_FAR: bool>(
        &mut self,
        blocks: &mut Blocks<'_, G>,
        beyond: &mut Beyond<'_, G>,
        hold: impl Fn(&[Fixed<G>; LANES], &[G::Point; LANES]) -> u32,
        exchange: impl Fn(&mut MovingSites<'_, G>, &mut [G::Point; LANES], &[SiteId; LANES]) -> u64,
    ) -> Result<Advance> {
        let n = self.site_of.len();
        let sites = self.kernel.sites_mut();
        let origins = self.transaction.origins_mut().of_all_mut(n)?;
        let (fixed, last_fixed) = beyond.fixed[..n].as_chunks::<LANES>();
        let mut movers = MovingSites { sites, queue: beyond.queue, most: beyond.most, n_moved: 0 };
        let (sites_of, last_sites_of) = self.site_of.as_chunks::<LANES>();
        let mut ended = None;
        'blocks: for (block, positions) in origins.chunks_mut(BLOCK).enumerate() {
            let first = block * BLOCK;
            blocks.copy(first, positions, &self.site_of[first..], movers.sites);
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
            if !MOVES_ALL {
                // Queued vertices have been left where they are, and their goals where origins are to be.
                movers.queue.iter().for_each(|&v| origins[v] = movers.sites[self.site_of[v]].point);
            }
            self.transaction.origins_mut().note_all();
            return Ok(Advance::Moved(n_moved));
        };
        let not_moved = if MOVES_ALL { &[] } else { &movers.queue[..] };
        // Vertices that have not moved are exchanged in vain.
        for v in VertexId::range(0..end).chain(not_moved.iter().copied()) {
            std::mem::swap(&mut movers.sites[self.site_of[v]].point, &mut origins[v]);
        }
        movers.queue.clear();
        room.map(|()| Advance::TooManyBeyond)
    }
}

/// Copies goals block by block, and checks them.
struct Blocks<'p, G: Moving> {
    goals: &'p [G::Point],
    are_good: bool,
}

impl<'p, G: Moving> Blocks<'p, G> {
    fn of(moves: &Moves<'p, G>) -> Self {
        Blocks { goals: moves.unchecked(), are_good: true }
    }

    /// Copies the goals of the vertices from `first` on; for bad ones the places where the vertices are.
    #[inline(always)]
    fn copy(&mut self, first: usize, to: &mut [G::Point], sites_of: &[SiteId], sites: &[Site<G>]) {
        let place = |k: usize| sites[sites_of[k]].point;
        self.are_good &= copy_good::<G>(to, &self.goals[first..], place);
    }
}

/// Copies goals, and other places for those that are bad; whether none is.
#[inline(always)]
fn copy_good<G: Moving>(to: &mut [G::Point], goals: &[G::Point], other: impl Fn(usize) -> G::Point) -> bool {
    let are_good = copy_checked::<G>(to, goals);
    if !are_good {
        for (k, p) in to.iter_mut().enumerate() {
            if !copy_checked::<G>(std::slice::from_mut(p), &goals[k..]) {
                *p = other(k);
            }
        }
    }
    are_good
}

/// A bit for each of a few vertices that is certainly within its tolerance.
#[inline(always)]
fn bits_of<G: Moving>(fixed: &[Fixed<G>], places: &[G::Point]) -> u32 {
    let hold = fixed.iter().zip(places).map(|(fixed, p)| fixed.holds(p));
    hold.enumerate().fold(0, |bits, (k, holds)| bits | u32::from(holds) << k)
}

/// Several sites.
///
/// # Safety
/// `sites_of` are indices of the `n` sites that begin at `start`, all different, and nothing else uses these meanwhile.
#[inline(always)]
unsafe fn sites_at<'s, G: Moving>(
    start: *mut Site<G>,
    n: usize,
    sites_of: &[SiteId; LANES],
) -> [&'s mut Site<G>; LANES] {
    debug_assert!((0..LANES).all(|k| sites_of[k].index() < n && !sites_of[..k].contains(&sites_of[k])));
    // SAFETY: the caller's promise.
    sites_of.map(|s| unsafe { &mut *start.add(s.index()) })
}

#[cfg(test)]
mod tests;
