//! *Rebuilding* (report, section 1): triangulate all positions again.
//!
//! The storage order of the sites is kept while it serves: motions are small, so what was near still is. Where sites
//! next to each other in storage have gone apart, they are sorted first.
//!
//! The new triangulation is built beside the old one and takes its place when it is complete, so what fails or is
//! cancelled on the way has changed nothing.

use std::cell::Cell;

use crate::delaunay::{Delaunay, Moving, Site};
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::motion::report::CommitReport;
use crate::motion::state::checking::differ;
use crate::motion::state::goals::{Goals, Movers, Moves};
use crate::motion::state::hidden::Hidden;
use crate::motion::triangulation::MovingTriangulation;

/// Sites are sorted when the mean distance of those next to each other has become so much greater: with less, they are
/// sorted without need; with more the walks take longer than to sort.
const MAX_STRIDE_RATIO: f64 = 1.7;

impl<G: Moving> MovingTriangulation<G> {
    /// Triangulates all vertices at their goals, where none has moved yet.
    pub(in crate::motion) fn rebuild(
        &mut self,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        let goals = moves.checked()?;
        if let Movers::Listed(vertices) = moves.movers() {
            return self.rebuild_moving(vertices, goals, report);
        }
        let moved = Cell::new(0);
        let place = |site: &Site<G>| {
            let goal = goals.of(site.id);
            moved.set(moved.get() + u64::from(differ::<G>(&site.point, &goal)));
            goal
        };
        let announce = |site: &Site<G>| goals.prefetch(site.id);
        let mut next = self.mesh.kernel.successor(self.mesh.hidden.count(), place, announce)?;
        report.moved += moved.get();
        let spread = self.mesh.spread_hidden(&mut next).map(|spread| {
            for &(v, s) in &spread {
                report.moved += u64::from(move_to(&mut next, s, goals.of(v)));
            }
        });
        self.build_and_adopt(next, spread, report)
    }

    /// Triangulates all vertices, these at their goals, all others where they are.
    pub(in crate::motion) fn rebuild_moving(
        &mut self,
        vertices: &[VertexId],
        goals: Goals<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        let mut next = self.mesh.kernel.successor(self.mesh.hidden.count(), |site| site.point, |_| {})?;
        let moved = self.mesh.spread_hidden(&mut next).and_then(|spread| {
            vertices.iter().try_for_each(|&v| {
                let s = self.mesh.own_site(&spread, v);
                report.moved += u64::from(move_to(&mut next, s, goals.read(v)?));
                Ok(())
            })
        });
        self.build_and_adopt(next, moved, report)
    }

    /// Triangulates all sites where they are, those that are in no cell included, in a call on one vertex.
    pub(in crate::motion) fn rebuild_as_is(&mut self, report: &mut CommitReport) -> Result<()> {
        self.mesh.kernel.pace_mut().skip_start();
        let mut next = self.mesh.kernel.successor(self.mesh.hidden.count(), |site| site.point, |_| {})?;
        let spread = self.mesh.spread_hidden(&mut next).map(drop);
        self.build_and_adopt(next, spread, report)
    }

    /// Triangulates all vertices, one of them at another place, in a call on it.
    pub(in crate::motion) fn rebuild_with(
        &mut self,
        vertex: VertexId,
        q: &G::Point,
        report: &mut CommitReport,
    ) -> Result<()> {
        self.mesh.kernel.pace_mut().skip_start();
        let mut next = self.mesh.kernel.successor(self.mesh.hidden.count(), |site| site.point, |_| {})?;
        let spread = self.mesh.spread_hidden(&mut next).map(|spread| {
            next.set_point(self.mesh.own_site(&spread, vertex), *q);
        });
        self.build_and_adopt(next, spread, report)
    }

    /// Triangulates the sites of a new kernel, which takes the place of the present one.
    pub(in crate::motion) fn build_and_adopt(
        &mut self,
        mut next: Delaunay<G>,
        is_ready: Result<()>,
        report: &mut CommitReport,
    ) -> Result<()> {
        let built = is_ready.and_then(|()| {
            let built = self.build(&mut next)?;
            self.mesh.enforce_segments_in(&mut next, &built.0)?;
            let in_no_cell = self.mesh.hidden_in(&next, self.options.coincidence)?;
            self.mesh.make_room_for_former()?;
            Ok((built, in_no_cell))
        });
        match built {
            Ok(((hidden, stride, keeps_sites), in_no_cell)) => {
                report.rebuilds += 1;
                self.mesh.hidden_in_new = Some(in_no_cell);
                self.adopt(next, hidden, stride);
                if !keeps_sites {
                    self.mesh.find_sites();
                }
                Ok(())
            }
            Err(error) => {
                next.give_scratch_to(&mut self.mesh.kernel);
                Err(error)
            }
        }
    }

    /// Triangulates the sites of a new kernel. Returns the hidden vertices, the mean stride of sorted sites, and
    /// whether the sites have their indices from before.
    fn build(&mut self, next: &mut Delaunay<G>) -> Result<(Hidden, f64, bool)> {
        let (mut stride, mut keeps_sites) = (self.mesh.sorted_stride, next.keeps_sites());
        if next.mean_stride() > MAX_STRIDE_RATIO * stride || !next.has_even_parts() {
            next.sort_sites()?;
            (stride, keeps_sites) = (next.mean_stride(), false);
        }
        next.restore_parts();
        let pace = self.mesh.kernel.pace_mut();
        let merges = next.rebuild(&mut |fraction| pace.ask(fraction))?;
        let hidden = self.mesh.hide_merged(next, &merges, self.options.coincidence)?;
        self.mesh.note_visibilities_of(next, &hidden)?;
        keeps_sites &= self.mesh.hidden.count() + hidden.count() == 0 && self.edits.are_none();
        Ok((hidden, stride, keeps_sites))
    }

    /// Puts a new kernel, which is complete, in the place of the present one; unless its sites have the indices from
    /// before, [`find_sites`](crate::motion::state::mesh::Mesh::find_sites) must follow. Cannot fail.
    pub(in crate::motion) fn adopt(&mut self, next: Delaunay<G>, hidden: Hidden, stride: f64) {
        self.mesh.adopt(next, hidden, stride);
        self.regions.invalidate();
    }
}

/// Puts a site of a new kernel somewhere; whether it was elsewhere.
pub(in crate::motion) fn move_to<G: Moving>(next: &mut Delaunay<G>, s: SiteId, goal: G::Point) -> bool {
    let differ = differ::<G>(&next.site(s).point, &goal);
    next.set_point(s, goal);
    differ
}

#[cfg(test)]
mod tests {
    use crate::delaunay::{Moving, Plane, Space};
    use crate::motion::algorithms::Algorithm;
    use crate::motion::options::Options;
    use crate::motion::triangulation::MovingTriangulation;
    use crate::random::Rng;

    /// The mean distance in storage after each of a few commits of vertices that go anywhere, next to that at first.
    fn strides<G: Moving>() -> Vec<f64> {
        let rng = &mut Rng::new(1);
        let mut points = || {
            let mut points = vec![G::Point::default(); 2_000];
            for p in &mut points {
                for axis in 0..G::D {
                    p[axis] = (rng.next() >> 40) as f64;
                }
            }
            points
        };
        let options = Options { algorithm: Algorithm::Rebuilding, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&points(), options).expect("room");
        let first = t.mesh.kernel.mean_stride();
        let commit = |_| {
            t.move_all(&points()).expect("good places");
            t.commit_timestamp().expect("room");
            t.mesh.kernel.mean_stride() / first
        };
        (0..4).map(commit).collect()
    }

    /// Storage follows vertices that have gone far away at once, not after a slow build.
    #[test]
    fn storage_is_in_order_after_every_leap() {
        for strides in [strides::<Plane>(), strides::<Space>()] {
            assert!(strides.iter().all(|stride| (0.8..1.2).contains(stride)), "{strides:?}");
        }
    }
}
