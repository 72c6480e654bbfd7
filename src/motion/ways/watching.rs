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
//! ([`Watching`](crate::motion::filters::watching::Watching)).
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

use crate::delaunay::{Moving, Waiting};
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::filters::store::TimestampSteps;
use crate::motion::region_kind::RegionKind;
use crate::motion::report::CommitReport;
use crate::motion::state::goals::{Goals, Moves};
use crate::motion::state::mesh::REPLACED_TO_SORT_FIRST;
use crate::motion::state::repair::Repair;
use crate::motion::triangulation::MovingTriangulation;
use crate::motion::ways::attempt::{Attempt, Start};
use crate::motion::ways::moving::Advance;
use crate::motion::ways::moving::Beyond;
use crate::motion::ways::repair::Mending;

/// Watching pays only while less than this share of the vertices is beyond its tolerance.
const MAX_SHARE_BEYOND: f64 = 0.125;

impl<G: Moving> MovingTriangulation<G> {
    /// Commits by watching where that is possible, else by repair.
    pub(in crate::motion) fn watch_or_repair(
        &mut self,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        let can_watch = self.mesh.kernel.has_cells() && self.mesh.moves_in_one_loop(moves);
        let attempt = if can_watch {
            self.commit_by_watching(moves, report)?
        } else {
            Attempt::GivenUp(Start::AtOrigins)
        };
        match attempt {
            Attempt::Committed => Ok(()),
            Attempt::GivenUp(start) => self.commit_by_repair(start, moves, report),
        }
    }

    /// Brings all vertices to their goals, or none if more than [`MAX_SHARE_BEYOND`] of them leave their tolerance. No
    /// two vertices may share a site.
    pub(in crate::motion) fn commit_by_watching(
        &mut self,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<Attempt> {
        if self.regions.kept_for() != Some(RegionKind::Watch) {
            let goals = moves.checked()?;
            self.mesh.sort_cells(REPLACED_TO_SORT_FIRST)?;
            self.prepare_regions(RegionKind::Watch, goals.positions(), report)?;
        }
        let most = (self.mesh.n_present as f64 * MAX_SHARE_BEYOND) as usize;
        let mut queue = std::mem::take(&mut self.queue);
        let mut beyond = Beyond { fixed: self.regions.fixed(), most, queue: &mut queue };
        let Advance::Moved(moved) = self.mesh.move_and_queue::<true>(moves, &mut beyond)? else {
            self.queue = queue;
            return Ok(Attempt::GivenUp(Start::AtOrigins));
        };
        report.moved += moved;
        report.within_tolerance += (self.mesh.n_present - queue.len()) as u64;
        if queue.len() + self.regions.n_watched() > 0 {
            let mut repair = memory::take_made(&mut self.repair)?;
            let done = self.check_and_mend(&mut repair, &queue, moves.checked()?, report);
            self.repair = Some(repair);
            done?;
        }
        self.queue = queue;
        Ok(Attempt::Committed)
    }

    /// Checks the bi-cells that may have failed. If all hold, those of the vertices beyond are computed; else what has
    /// failed is mended.
    fn check_and_mend(
        &mut self,
        repair: &mut Repair,
        beyond: &[VertexId],
        goals: Goals<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        self.check_moved(repair, beyond)?;
        if !repair.is_unneeded() {
            return self.mend_checked(repair, beyond, goals, report);
        }
        report.unchanged += beyond.len() as u64;
        if let Some(watching) = self.regions.watching() {
            let sites = beyond.iter().map(|&v| self.mesh.site_of[v]);
            let other_positions = self.mesh.transaction.origins().positions();
            let steps = TimestampSteps { other_positions, watched_share: self.mesh.constants.watched_share };
            report.tolerances += watching.recompute(&mut self.mesh.kernel, steps, repair.touched(), sites);
        }
        Ok(())
    }

    /// Checks the bi-cells that are not held; lists the cells of the stars of the vertices beyond, each once.
    fn check_moved(&mut self, repair: &mut Repair, beyond: &[VertexId]) -> Result<()> {
        let (failures, touched) = repair.begin_check();
        for &v in beyond {
            let s = self.mesh.site_of[v];
            let point = self.mesh.kernel.site(s).point;
            self.mesh.kernel.cover(&point, &point);
            self.mesh.kernel.gather_star(s)?;
            memory::collect(touched, self.mesh.kernel.gathered_star().iter().map(|&(c, _)| c))?;
        }
        self.mesh.kernel.tidy_changes(touched);
        let (kernel, before) = (&self.mesh.kernel, self.mesh.transaction.origins().positions());
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
        self.mesh.kernel.check_cells(touched, before, failures)?;
        self.mesh.kernel.count_certificates(3 * self.regions.n_watched());
        Ok(())
    }

    /// Repairs what a check of some certificates has found, all vertices being at their goals. Those beyond their
    /// tolerance and those placed have their bi-cells recomputed, like all new cells.
    pub(in crate::motion) fn mend_checked(
        &mut self,
        repair: &mut Repair,
        beyond: &[VertexId],
        goals: Goals<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        self.with_regions(report, |t, report| {
            for &v in beyond {
                t.regions.note_relocated(v)?;
            }
            t.mesh.kernel.record_all(repair.touched())?;
            let mended = t.mend_moved(repair, goals, report)?;
            let queue = repair.queue();
            match mended {
                Mending::Mended => {
                    t.place_all(queue, goals, report, |t, v, goal, report| t.relocate_noted(v, goal, report))
                }
                Mending::TooMuch => t.rebuild_moving(queue, goals, report),
            }
        })
    }
}
