//! *Rebuilding* (report, section 1): triangulate all positions again.
//!
//! The storage order of the sites is kept while it serves: motions are small, so what was near still is. Where sites
//! next to each other in storage have gone apart, they are sorted first.
//!
//! The new triangulation is built beside the old one and takes its place when it is complete, so what fails or is
//! cancelled on the way has changed nothing.

use std::cell::Cell;

use crate::delaunay::{Delaunay, Dimension, Merge, Site};
use crate::error::{Error, Result};
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::motion::constants::constants;
use crate::motion::options::CoincidencePolicy;
use crate::motion::report::CommitReport;
use crate::motion::state::checking::differ;
use crate::motion::state::goals::{Goals, Movers, Moves};
use crate::motion::state::hidden::Hidden;
use crate::motion::triangulation::MovingTriangulation;

impl<G: Dimension> MovingTriangulation<G> {
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
        let mut next = self.kernel.successor(self.hidden.count(), place, announce)?;
        report.moved += moved.get();
        let spread = self.spread_hidden(&mut next).map(|spread| {
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
        let mut next = self.kernel.successor(self.hidden.count(), |site| site.point, |_| {})?;
        let spread = self.spread_hidden(&mut next).map(|spread| {
            for &v in vertices {
                let s = self.own_site(&spread, v);
                report.moved += u64::from(move_to(&mut next, s, goals.of(v)));
            }
        });
        self.build_and_adopt(next, spread, report)
    }

    /// Triangulates all sites where they are, those that are in no cell included, in a call on one vertex.
    pub(in crate::motion) fn rebuild_as_is(&mut self, report: &mut CommitReport) -> Result<()> {
        self.kernel.pace_mut().skip_start();
        let mut next = self.kernel.successor(self.hidden.count(), |site| site.point, |_| {})?;
        let spread = self.spread_hidden(&mut next).map(drop);
        self.build_and_adopt(next, spread, report)
    }

    /// Triangulates all vertices, one of them at another place, in a call on it.
    pub(in crate::motion) fn rebuild_with(
        &mut self,
        vertex: VertexId,
        q: &G::Point,
        report: &mut CommitReport,
    ) -> Result<()> {
        self.kernel.pace_mut().skip_start();
        let mut next = self.kernel.successor(self.hidden.count(), |site| site.point, |_| {})?;
        let spread = self.spread_hidden(&mut next).map(|spread| {
            next.set_point(self.own_site(&spread, vertex), *q);
        });
        self.build_and_adopt(next, spread, report)
    }

    /// Gives every hidden vertex a site of its own in a new kernel, at the place where it is. Returns vertices and
    /// sites, by vertex.
    pub(in crate::motion) fn spread_hidden(&self, next: &mut Delaunay<G>) -> Result<Vec<(VertexId, SiteId)>> {
        let mut spread = Vec::new();
        if self.hidden.count() == 0 {
            return Ok(spread);
        }
        memory::reserve_exact(&mut spread, self.hidden.count())?;
        for (v, &s) in VertexId::range(0..self.site_of.len()).zip(&self.site_of) {
            if s != SiteId::NONE && self.kernel.site(s).id != v {
                spread.push((v, next.add_site(self.kernel.site(s).point, v)?));
            }
        }
        Ok(spread)
    }

    /// The site that a vertex has for itself in a new kernel where the hidden ones have been
    /// [spread](Self::spread_hidden).
    pub(in crate::motion) fn own_site(&self, spread: &[(VertexId, SiteId)], vertex: VertexId) -> SiteId {
        let at = spread.binary_search_by_key(&vertex, |&(hidden, _)| hidden);
        at.map_or(self.site_of[vertex], |k| spread[k].1)
    }

    /// Triangulates the sites of a new kernel, which takes the place of the present one.
    pub(in crate::motion) fn build_and_adopt(
        &mut self,
        mut next: Delaunay<G>,
        is_ready: Result<()>,
        report: &mut CommitReport,
    ) -> Result<()> {
        let built = is_ready.and_then(|()| self.build(&mut next));
        match built {
            Ok((hidden, stride, keeps_sites)) => {
                report.rebuilds += 1;
                self.adopt(next, hidden, stride);
                if !keeps_sites {
                    self.find_sites();
                }
                Ok(())
            }
            Err(error) => {
                next.give_scratch_to(&mut self.kernel);
                Err(error)
            }
        }
    }

    /// Triangulates the sites of a new kernel. Returns the hidden vertices, the mean stride of sorted sites, and
    /// whether the sites have their indices from before.
    fn build(&mut self, next: &mut Delaunay<G>) -> Result<(Hidden, f64, bool)> {
        let (mut stride, mut keeps_sites) = (self.sorted_stride, next.keeps_sites());
        if next.mean_stride() > constants::<G>().max_stride_ratio * stride || !next.has_even_parts() {
            next.sort_sites()?;
            (stride, keeps_sites) = (next.mean_stride(), false);
        }
        next.restore_parts();
        let pace = self.kernel.pace_mut();
        let merges = next.rebuild(&mut |fraction| pace.ask(fraction))?;
        let hidden = self.hide_merged(next, &merges)?;
        if self.takes_changes {
            self.note_visibilities_of(next, &hidden)?;
        }
        keeps_sites &= self.hidden.count() + hidden.count() == 0 && self.edits.are_none();
        Ok((hidden, stride, keeps_sites))
    }

    /// The trees of hidden vertices, unless the options reject them.
    pub(in crate::motion) fn hide_merged(&self, kernel: &Delaunay<G>, merges: &[Merge]) -> Result<Hidden> {
        let hidden = Hidden::of_merges(merges, self.site_of.len(), |s| kernel.site(s).id)?;
        if self.options.coincidence == CoincidencePolicy::Reject
            && let Some((vertex, other)) = hidden.first_pair()
        {
            return Err(Error::Coincident { vertex, other });
        }
        Ok(hidden)
    }

    /// Notes the vertices that a new kernel hides and the present one does not, or the other way round. Insertions that
    /// are staged, but not a part of this change, are in neither.
    fn note_visibilities_of(&mut self, next: &Delaunay<G>, hidden: &Hidden) -> Result<()> {
        if self.hidden.count() + hidden.count() == 0 {
            return Ok(());
        }
        for s in next.live_sites() {
            let representative = next.site(s).id;
            if self.is_present(representative) && self.is_hidden(representative) {
                self.note_visibility(representative, true)?;
            }
            let mut noted = Ok(());
            hidden.for_all_behind(representative, |v| {
                if noted.is_ok() && (!self.is_present(v) || !self.is_hidden(v)) {
                    noted = self.note_visibility(v, false);
                }
            });
            noted?;
        }
        Ok(())
    }

    /// Puts a new kernel, which is complete, in the place of the present one; unless its sites have the indices from
    /// before, [`find_sites`](Self::find_sites) must follow. Cannot fail.
    pub(in crate::motion) fn adopt(&mut self, mut next: Delaunay<G>, hidden: Hidden, stride: f64) {
        *next.pace_mut() = std::mem::take(self.kernel.pace_mut());
        self.kernel = next;
        self.hidden = hidden;
        self.sorted_stride = stride;
        self.regions.invalidate();
        self.transaction.adopt();
    }

    /// Finds the site of each vertex.
    pub(in crate::motion) fn find_sites(&mut self) {
        let Self { kernel, hidden, site_of, .. } = self;
        for s in kernel.live_sites() {
            hidden.for_all_at(kernel.site(s).id, |v| site_of[v] = s);
        }
    }
}

/// Puts a site of a new kernel somewhere; whether it was elsewhere.
pub(in crate::motion) fn move_to<G: Dimension>(next: &mut Delaunay<G>, s: SiteId, goal: G::Point) -> bool {
    let differ = differ::<G>(&next.site(s).point, &goal);
    next.set_point(s, goal);
    differ
}

#[cfg(test)]
mod tests {
    use crate::delaunay::{Dimension, Plane, Space};
    use crate::motion::algorithms::Algorithm;
    use crate::motion::options::Options;
    use crate::motion::triangulation::MovingTriangulation;
    use crate::random::Rng;

    /// The mean distance in storage after each of a few commits of vertices that go anywhere, next to that at first.
    fn strides<G: Dimension>() -> Vec<f64> {
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
        let first = t.kernel.mean_stride();
        let commit = |_| {
            t.move_all(&points()).expect("good places");
            t.commit_timestamp().expect("room");
            t.kernel.mean_stride() / first
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
