//! Steps that commits with regions have in common.

use crate::delaunay::{Moving, Shortcut};
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::filters::safe_regions::Admission;
use crate::motion::filters::store::TimestampSteps;
use crate::motion::region_kind::RegionKind;
use crate::motion::report::CommitReport;
use crate::motion::state::goals::{Goals, Moves};
use crate::motion::triangulation::MovingTriangulation;
use crate::motion::ways::moving::{Advance, Beyond};
use crate::motion::ways::placement::Placed;

impl<G: Moving> MovingTriangulation<G> {
    /// The pre-computations for a kind of regions, unless what the last commit has kept is valid. `other_positions` are
    /// those of [`TimestampSteps`].
    pub(in crate::motion) fn prepare_regions(
        &mut self,
        kind: RegionKind,
        other_positions: &[G::Point],
        report: &mut CommitReport,
    ) -> Result<()> {
        if self.regions.kept_for() != Some(kind) {
            let steps = TimestampSteps { other_positions, watched_share: self.mesh.constants.watched_share };
            let (kernel, n_ids) = (&mut self.mesh.kernel, self.mesh.site_of.len());
            report.tolerances += self.regions.prepare(kind, kernel, n_ids, steps)?;
        }
        Ok(())
    }

    /// Moves all vertices that stay within tolerance, in one loop; returns the others.
    pub(in crate::motion) fn accept_all(
        &mut self,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<Vec<VertexId>> {
        let mut queue = std::mem::take(&mut self.queue);
        let mut beyond = Beyond { fixed: self.regions.fixed(), most: usize::MAX, queue: &mut queue };
        let Advance::Moved(moved) = self.mesh.move_and_queue::<false>(moves, &mut beyond)? else {
            unreachable!("there is room for all in the queue");
        };
        report.moved += moved;
        report.within_tolerance += (self.mesh.site_of.len() - queue.len()) as u64;
        Ok(queue)
    }

    /// Moves those of the queued vertices that stay in their regions; the others stay in the queue.
    pub(in crate::motion) fn accept_queued(
        &mut self,
        queue: &mut Vec<VertexId>,
        goals: Goals<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        self.mesh.transaction.origins_mut().make_room(self.mesh.site_of.len(), queue.len())?;
        queue.retain(|&v| match self.accept(v, &goals.of(v), report) {
            Some(origin) => {
                self.mesh.transaction.origins_mut().note(v, origin);
                false
            }
            None => true,
        });
        Ok(())
    }

    /// Moves a vertex if it stays in its region; returns where it was.
    #[inline(always)]
    pub(in crate::motion) fn accept(
        &mut self,
        vertex: VertexId,
        goal: &G::Point,
        report: &mut CommitReport,
    ) -> Option<G::Point> {
        let s = self.mesh.site_of[vertex];
        if self.mesh.is_shared(s) {
            return None;
        }
        match self.regions.admit(&mut self.mesh.kernel, vertex, s, goal)? {
            Admission::WithinTolerance => report.within_tolerance += 1,
            Admission::WithinSafeRegion => report.within_safe_region += 1,
        }
        self.mesh.kernel.cover(goal, goal);
        let origin = self.mesh.kernel.site(s).point;
        self.mesh.kernel.set_point(s, *goal);
        report.moved += u64::from(origin != *goal);
        Some(origin)
    }

    /// Places the queued vertices; the regions follow.
    pub(in crate::motion) fn place_queued(
        &mut self,
        mut queue: Vec<VertexId>,
        goals: Goals<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        self.mesh.order_by_site(&mut queue);
        self.with_regions(report, |t, report| {
            t.place_all(&queue, goals, report, |t, v, goal, report| t.relocate_noted(v, goal, report))
        })?;
        self.queue = queue;
        Ok(())
    }

    /// Relocates the vertices one after the other, with flips, and rebuilds where what is left would take longer; the regions
    /// that are kept follow.
    pub(in crate::motion) fn place_or_rebuild_with_regions(
        &mut self,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        let goals = moves.checked()?;
        let mut queue = self.queue_of(moves)?;
        self.mesh.order_for_placement(&mut queue, goals);
        self.with_regions(report, |t, report| {
            t.place_within_budget(&queue, goals, 0, report, Self::relocate_noted)
        })?;
        self.queue = queue;
        Ok(())
    }

    /// Relocates a vertex; the regions are told.
    pub(in crate::motion) fn relocate_noted(
        &mut self,
        vertex: VertexId,
        q: &G::Point,
        report: &mut CommitReport,
    ) -> Result<Placed> {
        // A failure after the relocation would have to take it back.
        self.regions.make_room_to_note()?;
        let placed = self.mesh.relocate(vertex, q, Shortcut::Flips, report)?;
        self.regions.note_relocated(vertex)?;
        Ok(placed)
    }

    /// Makes a change that the regions follow if any are kept. If it fails none are any more.
    pub(in crate::motion) fn with_regions<T>(
        &mut self,
        report: &mut CommitReport,
        change: impl FnOnce(&mut Self, &mut CommitReport) -> Result<T>,
    ) -> Result<T> {
        let Some((kept, record)) = self.regions.begin_change() else {
            return change(self, report);
        };
        self.mesh.kernel.record_changes(record);
        let done = change(self, report);
        match self.mesh.kernel.take_changes().filter(|_| done.is_ok()) {
            Some(changed) => {
                let mut relocated = self.regions.end_change();
                relocated.retain(|&v| !self.mesh.is_shared(self.mesh.site_of[v]));
                let (kernel, site_of) = (&mut self.mesh.kernel, &self.mesh.site_of);
                let other_positions = self.mesh.transaction.origins().positions();
                let steps =
                    TimestampSteps { other_positions, watched_share: self.mesh.constants.watched_share };
                let n = self.regions.follow(kept, changed, relocated, kernel, site_of, steps);
                // Without the memory for it none are kept, and the next commit says so.
                report.tolerances += n.unwrap_or_default();
            }
            None => self.regions.give_up(kept),
        }
        done
    }

    /// Shows those of the vertices that weights hide, and that are loose, which are below the cells now; the regions
    /// that are kept follow.
    pub(in crate::motion) fn settle_hidden(&mut self, report: &mut CommitReport) -> Result<()> {
        // A new kernel has been built with all of them.
        if !G::HAS_WEIGHTS || self.mesh.transaction.has_rebuilt() {
            return Ok(());
        }
        if self.mesh.kernel.has_loose() {
            self.with_regions(report, |t, _| {
                let Self { mesh, regions, .. } = t;
                let mut shown = Vec::new();
                mesh.kernel.settle(|s| memory::push(&mut shown, s))?;
                shown.iter().try_for_each(|&s| regions.note_relocated(mesh.kernel.site(s).id))
            })?;
        }
        if self.mesh.kernel.spans_without_cells() {
            self.rebuild_as_is(report)?;
        }
        Ok(())
    }
}
