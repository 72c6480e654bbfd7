//! The *tolerance* algorithm (report, Algorithm 1), the *safe region* algorithm (Algorithm 2) and both together.
//!
//! ```text
//! for each relocation of z to p:
//!     m_z <- p
//!     if m_z is certainly in the tolerance (safe) region of z: done
//!     else: z joins the queue
//! for each z in the queue:
//!     move z with the placement algorithm
//!     for each new bi-cell: its delimiter; for each vertex of it: a smaller tolerance
//! ```
//!
//! **One embedding.** The report places vertices in the embedding at *fixed* positions, T_f, and so has to queue a vertex
//! again when a new bi-cell's tolerance falls below its displacement. Here the queue is worked off in the embedding at
//! the *moving* positions: once every accepted vertex has moved, that is a Delaunay triangulation by Proposition 1 (in
//! space, with the correction in [`regions`](super::regions)), the queued vertices being where they were; predicates are exact, so it stays one after each placement. New delimiters are
//! taken at the moving positions, which lie within them by construction, and no vertex is ever queued again. A vertex *w*
//! that gets a smaller tolerance is fixed anew where it is: the ball around `f_w` of radius ε_w holds the ball around `m_w`
//! of radius `ε_w − |m_w − f_w|`, so `(f_w, ε_w) <- (m_w, min(ε_w − |m_w − f_w|, ε'))`.
//!
//! **Certified.** Tolerances are lower bounds and displacements are compared as upper bounds
//! ([`predicates::tolerance`](crate::predicates)), so an accepted vertex *provably* changes nothing.
//!
//! **Coincident vertices** always take the queue.
//!
//! Cost: a test is a squared distance, or one for each bi-cell of the star; a queued vertex costs a placement and about
//! 12 (plane) or 66 (space) delimiters and more for what the hole is filled with.

use super::regions::Filter;
use super::{Algorithm, CommitReport, MovingTriangulation};
use crate::delaunay::{Dimension, Shortcut};
use crate::error::Result;

impl<G: Dimension> MovingTriangulation<G> {
    /// Brings the staged vertices to their new positions by a filter and a queue.
    pub(super) fn commit_by_filter(&mut self, filter: Filter, report: &mut CommitReport) -> Result<()> {
        if !self.kernel.has_cells() {
            return self.commit_by_rebuilding(0, report);
        }
        self.pre_compute(filter, report)?;
        self.accept_staged(filter, report);
        self.order_queue_by_site();
        self.with_regions(report, |t, report| {
            t.place_staged(report, |t, v, new, report| t.relocate_noted(v, new, report))
        })
    }

    /// Computes tolerances and delimiters unless those of the last commit are valid.
    fn pre_compute(&mut self, filter: Filter, report: &mut CommitReport) -> Result<()> {
        if self.regions.kept_for() == Some(filter) {
            return Ok(());
        }
        self.regions.compute(&self.kernel, filter, report)
    }

    /// Moves the vertices that stay in their regions; the others are queued, behind them.
    fn accept_staged(&mut self, filter: Filter, report: &mut CommitReport) {
        for k in 0..self.staging.vertices.len() {
            if self.accept(self.staging.vertices[k], filter, report) {
                self.staging.vertices.swap(self.staging.applied, k);
                self.staging.applied += 1;
            }
        }
    }

    /// Moves a vertex if it stays in its region.
    #[inline(always)]
    fn accept(&mut self, vertex: u32, filter: Filter, report: &mut CommitReport) -> bool {
        let s = self.site_of[vertex as usize];
        let p = self.staging.positions[vertex as usize];
        if self.hidden.any_at(s) {
            return false;
        }
        let within = filter != Filter::SafeRegion && self.regions.is_within_tolerance(s, &p);
        let accepted =
            within || filter != Filter::Tolerance && self.regions.is_in_safe_region(&mut self.kernel, s, &p);
        if accepted {
            report.moved += u64::from(self.exchange_position(vertex));
            if within {
                report.within_tolerance += 1;
            } else {
                report.within_safe_region += 1;
            }
            self.kernel.cover(&p, &p);
        }
        accepted
    }

    /// Moves one vertex at once, by the filter in force if there is one.
    pub(super) fn relocate_filtered(
        &mut self,
        vertex: u32,
        q: &G::Point,
        report: &mut CommitReport,
    ) -> Result<()> {
        let Some(filter) = self.filter().filter(|_| self.kernel.has_cells()) else {
            self.regions.invalidate();
            return self.relocate(vertex, q, Shortcut::Flips, report);
        };
        self.pre_compute(filter, report)?;
        self.staging.grow_for(self.site_of.len())?;
        self.staging.positions[vertex as usize] = *q;
        if self.accept(vertex, filter, report) {
            report.moved = 1;
            return Ok(());
        }
        self.with_regions(report, |t, report| t.relocate_noted(vertex, q, report))
    }

    /// Relocates a vertex; the regions are told.
    fn relocate_noted(&mut self, vertex: u32, q: &G::Point, report: &mut CommitReport) -> Result<()> {
        self.relocate(vertex, q, Shortcut::Flips, report)?;
        self.regions.note_relocated(vertex);
        Ok(())
    }

    /// The filter of the algorithm in force.
    fn filter(&self) -> Option<Filter> {
        match self.options.algorithm {
            Algorithm::Tolerance => Some(Filter::Tolerance),
            Algorithm::RebuildingTolerance => self.switching.has_switched().then_some(Filter::Tolerance),
            Algorithm::SafeRegion => Some(Filter::SafeRegion),
            Algorithm::SafeRegionTolerance => Some(Filter::Both),
            _ => None,
        }
    }
}
