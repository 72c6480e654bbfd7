//! *Watching*: a tolerance for each vertex, and a look at each timestamp at the bi-cells that would make it too small.
//!
//! ```text
//! for each vertex: is it beyond its tolerance?
//! move all vertices
//! check the watched bi-cells, and all of the vertices beyond
//! if something failed: mend it, as a repair does
//! for each bi-cell of a vertex beyond or a new cell:
//!     if its tolerance is soon used up: watch it
//!     else: its vertices get no greater tolerance
//! ```
//!
//! In the tolerance algorithm a bi-cell of hardly any tolerance sends its D + 2 vertices to the queue at each
//! timestamp, and each of them has a whole star of bi-cells that are far from failing. Here such a bi-cell costs one
//! test, and the vertices have the tolerance of the others. Which are watched follows from how fast the vertices move
//! ([`Regions`](super::regions::Regions)).
//!
//! # What a timestamp proves
//!
//! Call a bi-cell *held* if it is not watched and no vertex of it is beyond its tolerance. It has been found to be locally
//! Delaunay at some earlier timestamp, and no vertex has left its side of what separates them, now or on the
//! straight way from the timestamp before. Every other one is checked where it is now. Then all cells are
//! positive, the hull is convex and winds once, and every facet is locally Delaunay:
//!
//! - *In the plane* a triangle with three held bi-cells is positive. Each of them has a disk with its edge inside
//!   and the triangle's third corner outside; if the corners were ever in line, the one between the others would be inside,
//!   as a disk is convex. All other triangles are checked. With positive triangles a held bi-cell is locally
//!   Delaunay ([`predicates::tolerance`](crate::predicates)).
//! - *In space* that does not hold of four corners that get into a plane as two and two, and the argument is that of
//!   the tolerance algorithm, about the first moment at which a cell of held bi-cells goes flat. The other cells must not
//!   have been flat before that: they are checked all the way
//!   ([`stays_positive`](crate::delaunay::Dimension::stays_positive)).
//! - *At the hull* every ridge is held or checked all the way; so the hull was never folded, and winds as often as
//!   before.
//!
//! What a check leaves open, as it does where a cell was inverted only in between, a sweep of all certificates decides.
//!
//! Cost: 3 ns a vertex; about 15 or 40 ns for a watched bi-cell; and for a vertex beyond its star and the bi-cells
//! there. Both counts shrink with the root of the displacement.

use super::regions::Filter;
use super::repair::Repair;
use super::{CommitReport, MovingTriangulation};
use crate::delaunay::{Dimension, Motion};
use crate::error::Result;

/// More than one vertex in so many beyond its tolerance: a sweep of everything is cheaper.
const MANY: usize = 4;

impl<G: Dimension> MovingTriangulation<G> {
    /// Commits by watching where that is possible, else by repair.
    pub(super) fn watch_or_repair(&mut self, report: &mut CommitReport) -> Result<()> {
        let can_watch = self.kernel.has_cells() && self.staging.is_whole() && self.hidden.count() == 0;
        if can_watch && self.commit_by_watching(self.n_present / MANY, report)? {
            return Ok(());
        }
        self.commit_by_repair(report)
    }

    /// Brings all vertices of a whole staging to their new positions if no more than `most` leave their tolerance; `false`
    /// otherwise, and nothing has moved. No two vertices may share a site.
    pub(super) fn commit_by_watching(&mut self, most: usize, report: &mut CommitReport) -> Result<bool> {
        if self.regions.kept_for() != Some(Filter::Watch) {
            self.kernel.sort_cells()?;
            let (n_ids, elsewhere) = (self.site_of.len(), &self.staging.positions);
            self.regions.compute(&mut self.kernel, n_ids, Filter::Watch, elsewhere, report)?;
        }
        if !self.queue_beyond(most)? {
            return Ok(false);
        }
        let n_beyond = self.staging.vertices.len();
        report.within_tolerance += (self.n_present - n_beyond) as u64;
        if n_beyond + self.regions.n_watched() == 0 {
            report.moved += self.move_whole::<false>().0;
            return Ok(true);
        }
        let (moved, farthest) = self.move_whole::<true>();
        report.moved += moved;
        self.staging.applied = n_beyond;

        let mut repair = std::mem::take(&mut self.repair);
        self.check_moved(farthest, &mut repair);
        let done = if repair.failures.are_none() {
            report.unchanged += n_beyond as u64;
            let sites = self.staging.vertices.iter().map(|&v| self.site_of[v as usize]);
            let (kernel, elsewhere) = (&mut self.kernel, &self.staging.positions);
            self.regions.compute_anew(kernel, Filter::Watch, &repair.touched, sites, elsewhere, report);
            Ok(())
        } else {
            self.mend_watched(&mut repair, report)
        };
        self.repair = repair;
        done.map(|()| true)
    }

    /// Checks the bi-cells that are not held; lists the cells of the stars of the vertices beyond, each once.
    fn check_moved(&mut self, farthest: f64, repair: &mut Repair) {
        let Repair { failures, touched, .. } = repair;
        failures.clear();
        touched.clear();
        for &v in &self.staging.vertices {
            let s = self.site_of[v as usize];
            let point = self.kernel.site(s).point;
            self.kernel.cover(&point, &point);
            self.kernel.gather_star(s);
            touched.extend(self.kernel.gathered_star().iter().map(|&(c, _)| c));
        }
        self.kernel.tidy_changes(touched);
        let motion = Motion { before: &self.staging.positions, farthest };
        let kernel = &self.kernel;
        self.regions.for_watched(kernel, |facet| kernel.check_bicell(facet, motion, failures));
        self.kernel.check_cells(touched, motion, failures);
        self.kernel.count_certificates(3 * self.regions.n_watched());
    }

    /// Mends what has failed. The vertices beyond and those placed have their bi-cells computed anew, like all new cells.
    fn mend_watched(&mut self, repair: &mut Repair, report: &mut CommitReport) -> Result<()> {
        self.with_regions(report, |t, report| {
            for &v in &t.staging.vertices {
                t.regions.note_relocated(v);
            }
            t.kernel.record(repair.touched.iter().copied());
            t.staging.list()?;
            if !t.mend_moved(repair, report)? {
                return t.commit_by_rebuilding(t.staging.applied, report);
            }
            t.place_staged(report, |t, v, new, report| t.relocate_noted(v, new, report))
        })
    }
}
