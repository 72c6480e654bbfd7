//! All vertices moved, and how far each has gone entered in the odometers of slacks.

use crate::delaunay::{Moving, Site};
use crate::error::Result;
use crate::ids::SiteId;
use crate::machine::prefetch::{AHEAD, CACHE_BYTES, prefetch};
use crate::motion::filters::slack::Slacks;
use crate::motion::state::goals::Moves;
use crate::motion::state::mesh::Mesh;
use crate::motion::ways::moving::{BLOCK, Blocks, sites_at};
use crate::predicates::{distance_above, distances_above};
use crate::simd::{LANES, Simd, in_lanes};

/// What a motion on record has found.
pub(in crate::motion) struct Motion {
    /// How many positions differ.
    pub(in crate::motion) moved: u64,
    /// The longest way.
    pub(in crate::motion) greatest: f64,
    /// Whether the unit of ways still fits.
    pub(in crate::motion) fits: bool,
}

impl<G: Moving> Mesh<G> {
    /// Moves all vertices, and adds to the ways of their sites. The origins of all are known
    /// afterwards, also after the error that one of the goals is bad.
    pub(in crate::motion) fn move_all_on_record(
        &mut self,
        moves: &mut Moves<'_, G>,
        slacks: &mut Slacks<G>,
    ) -> Result<Motion> {
        in_lanes!(simd, self, moves, slacks => |t, moves, slacks| {
                t.move_all_on_record_by(
                    moves,
                    slacks,
                    #[inline(always)]
                    |sites, places, sites_of| {
                        // SAFETY: every vertex has a site of its own, and the sites are borrowed.
                        let sites = unsafe { sites_at(sites.as_mut_ptr(), sites.len(), sites_of) };
                        let old = [&sites[0].point, &sites[1].point, &sites[2].point, &sites[3].point];
                        let distances = distances_above(simd, old, places.each_ref());
                        G::exchange(simd, places, sites, &mut [simd.splat(0.0); 2]);
                        distances
                    },
                )
        })
    }

    /// Does what [`move_all_on_record`](Self::move_all_on_record) does, by exchanges of several positions at a time
    /// that tell how far apart they were, at most.
    #[inline(always)]
    fn move_all_on_record_by(
        &mut self,
        moves: &mut Moves<'_, G>,
        slacks: &mut Slacks<G>,
        mut exchange: impl FnMut(&mut [Site<G>], &mut [G::Point; LANES], &[SiteId; LANES]) -> [f64; LANES],
    ) -> Result<Motion> {
        let mut record = WaysOnRecord { longest: slacks.longest_way(), n: 0, sum: 0.0, greatest: 0.0 };
        let sites = self.kernel.sites_mut();
        let is_far = size_of_val(sites) > CACHE_BYTES;
        let mut blocks = Blocks::of(moves);
        let origins = self.transaction.origins_mut().of_all_mut(self.site_of.len())?;
        for (first, positions) in (0..).step_by(BLOCK).zip(origins.chunks_mut(BLOCK)) {
            blocks.copy(first, positions, &self.site_of[first..], sites);
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
        self.transaction.origins_mut().note_all();
        let WaysOnRecord { n: moved, sum, greatest, .. } = record;
        let fits = slacks.end_motion(&mut self.kernel, sum / moved.max(1) as f64, greatest);
        moves.end_check(blocks.are_good)?;
        Ok(Motion { moved, greatest, fits })
    }
}

/// The ways of vertices that are moved on record.
struct WaysOnRecord {
    /// No way counts as longer in the sum.
    longest: f64,
    /// How many vertices have moved, the sum of their ways, and the longest one.
    n: u64,
    sum: f64,
    greatest: f64,
}

impl WaysOnRecord {
    /// Adds to the way of a site, unless it stays where it is.
    #[inline(always)]
    fn enter<G: Moving>(&mut self, slacks: &mut Slacks<G>, s: SiteId, distance: f64) {
        if distance == 0.0 {
            return;
        }
        slacks.travel(s, distance);
        self.sum += if distance < self.longest { distance } else { self.longest };
        self.greatest = if distance > self.greatest { distance } else { self.greatest };
        self.n += 1;
    }
}
