//! *Watching*: a tolerance for each vertex; each timestamp checks the bi-cells that would make it too small.
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
//! ([`Watching`](super::Watching)).
//!
//! # What a timestamp proves
//!
//! Every bi-cell that is not watched had, when it was computed, tolerance for the balls of its vertices around their
//! fixed positions: whatever those of its vertices do that are in their balls, they are on their sides of what
//! separates it ([`predicates::tolerance`](crate::predicates)). Then:
//!
//! - *Every finite cell is positive.* It is checked if a corner is beyond its tolerance or a bi-cell of it is watched.
//!   Otherwise its corners have never been in one hyperplane, now or on the straight way from the timestamp
//!   before. By Radon they would be parted so that the hulls of both parts meet. One corner within the hull of the
//!   others: the bi-cell of the facet opposite has a ball that holds these and not it, or a plane between. In
//!   space, two segments `ab` and `ec` that cross at x: if no bi-cell has a plane between them, those of the facets
//!   at `ab` have a ball with `a` and `b` inside and `e` and `c` outside, those at `ec` the opposite; the difference
//!   of the powers, an affine function, is negative at `a` and `b` and positive at `e` and `c`, and both at x.
//! - *Every facet is locally Delaunay.* It is checked if it is watched, or one of the D + 2 vertices beyond, as it is
//!   then a facet of a cell at that vertex. Otherwise all of them are on their sides, and both cells positive.
//! - *The hull is convex and winds once.* Each ridge has the orientation of D + 1 points for certificate, which is held
//!   or checked, in both cases all the way: the dihedral angles have never been 0 or π, so the hull was never folded.
//!
//! Where the check of a ridge is not certain all the way, a count of the hull's windings decides.
//!
//! Cost: 2 ns a vertex; about 5 or 20 ns for a watched bi-cell; and for a vertex beyond its star and the bi-cells
//! there. Both counts shrink with the root of the displacement.

use crate::delaunay::{Dimension, Waiting};
use crate::error::Result;
use crate::machine::memory;
use crate::motion::attempt::{Advance, Attempt, Mending};
use crate::motion::constants::constants;
use crate::motion::regions::Filter;
use crate::motion::repair::Repair;
use crate::motion::staging::Given;
use crate::motion::{CommitReport, MovingTriangulation};

impl<G: Dimension> MovingTriangulation<G> {
    /// Commits by watching where that is possible, else by repair.
    pub(in crate::motion) fn watch_or_repair(
        &mut self,
        given: &mut Given<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        let can_watch = self.kernel.has_cells() && self.staging.is_whole() && self.hidden.count() == 0;
        let most = constants::<G>().max_share_beyond_alone;
        if can_watch && self.commit_by_watching(most, given, report)? == Attempt::Committed {
            return Ok(());
        }
        self.commit_by_repair(given, report)
    }

    /// Brings all vertices of a whole staging to their new positions, or none if more than this share of them leave
    /// their tolerance. No two vertices may share a site.
    pub(in crate::motion) fn commit_by_watching(
        &mut self,
        max_share_beyond: f64,
        given: &mut Given<'_, G>,
        report: &mut CommitReport,
    ) -> Result<Attempt> {
        if self.regions.kept_for() != Some(Filter::Watch) {
            self.stage_given(given)?;
            self.sort_cells(constants::<G>().replaced_to_sort_first)?;
            self.prepare_regions(Filter::Watch, report)?;
        }
        let most = (self.n_present as f64 * max_share_beyond) as usize;
        let Advance::Moved(moved) = self.move_and_queue::<true>(most, given)? else {
            return Ok(Attempt::NotBegun);
        };
        report.moved += moved;
        let n_beyond = self.staging.vertices().len();
        report.within_tolerance += (self.n_present - n_beyond) as u64;
        if n_beyond + self.regions.n_watched() > 0 {
            let mut repair = memory::take_made(&mut self.repair)?;
            let done = self.check_and_mend(&mut repair, report);
            self.repair = Some(repair);
            done?;
        }
        Ok(Attempt::Committed)
    }

    /// Checks the bi-cells that may have failed. If all hold, those of the vertices beyond are computed; else what has
    /// failed is mended.
    fn check_and_mend(&mut self, repair: &mut Repair, report: &mut CommitReport) -> Result<()> {
        self.check_moved(repair)?;
        if !repair.is_unneeded() {
            return self.mend_checked(repair, report);
        }
        report.unchanged += self.staging.vertices().len() as u64;
        if let Some(watching) = self.regions.watching() {
            let sites = self.staging.vertices().iter().map(|&v| self.site_of[v]);
            let other_positions = self.staging.positions();
            report.tolerances +=
                watching.recompute(&mut self.kernel, other_positions, repair.touched(), sites);
        }
        Ok(())
    }

    /// Checks the bi-cells that are not held; lists the cells of the stars of the vertices beyond, each once.
    fn check_moved(&mut self, repair: &mut Repair) -> Result<()> {
        let (failures, touched) = repair.begin_check();
        for &v in self.staging.vertices() {
            let s = self.site_of[v];
            let point = self.kernel.site(s).point;
            self.kernel.cover(&point, &point);
            self.kernel.gather_star(s)?;
            memory::collect(touched, self.kernel.gathered_star().iter().map(|&(c, _)| c))?;
        }
        self.kernel.tidy_changes(touched);
        let (kernel, before) = (&self.kernel, self.staging.positions());
        let mut waiting = Waiting::default();
        let mut checked = Ok(());
        if let Some(watching) = self.regions.watching() {
            watching.for_watched(kernel, |facet| {
                if checked.is_ok() {
                    checked = kernel.check_bicell_of_many(facet, &mut waiting, before, failures);
                }
            });
        }
        checked?;
        kernel.check_waiting(&mut waiting, before, failures)?;
        self.kernel.check_cells(touched, before, failures)?;
        self.kernel.count_certificates(3 * self.regions.n_watched());
        Ok(())
    }

    /// Repairs what a check of some certificates of a whole staging has found. The listed vertices and those placed
    /// have their bi-cells recomputed, like all new cells.
    pub(in crate::motion) fn mend_checked(
        &mut self,
        repair: &mut Repair,
        report: &mut CommitReport,
    ) -> Result<()> {
        self.with_regions(report, |t, report| {
            for &v in t.staging.vertices() {
                t.regions.note_relocated(v)?;
            }
            t.kernel.record_all(repair.touched())?;
            if t.mend_moved(repair, report)? == Mending::TooMuch {
                return t.commit_by_rebuilding(t.staging.applied(), report);
            }
            t.place_staged(report, |t, v, new, report| t.relocate_noted(v, new, report))
        })
    }
}
