//! Steps that commits with regions have in common.

use super::Filter;
use crate::delaunay::{Dimension, Shortcut};
use crate::error::Result;
use crate::ids::VertexId;
use crate::motion::placement::Placed;
use crate::motion::safe_region::Admission;
use crate::motion::{CommitReport, MovingTriangulation};

impl<G: Dimension> MovingTriangulation<G> {
    /// The pre-computations for a filter, unless what the last commit has kept is valid. Positions must be staged.
    pub(in crate::motion) fn prepare_regions(
        &mut self,
        filter: Filter,
        report: &mut CommitReport,
    ) -> Result<()> {
        if self.regions.kept_for() != Some(filter) {
            let (kernel, n_ids) = (&mut self.kernel, self.site_of.len());
            report.tolerances += self.regions.prepare(filter, kernel, n_ids, self.staging.positions())?;
        }
        Ok(())
    }

    /// Moves those of the listed vertices that stay in their regions, and puts them before the others.
    pub(in crate::motion) fn accept_listed(&mut self, report: &mut CommitReport) {
        let mut vertices = std::mem::take(self.staging.vertices_mut());
        let first = self.staging.applied();
        let mut applied = first;
        for k in first..vertices.len() {
            if self.accept(vertices[k], report) {
                vertices.swap(applied, k);
                applied += 1;
            }
        }
        *self.staging.vertices_mut() = vertices;
        self.staging.set_applied(applied);
    }

    /// Moves a vertex to where it is staged if it stays in its region.
    #[inline(always)]
    pub(in crate::motion) fn accept(&mut self, vertex: VertexId, report: &mut CommitReport) -> bool {
        let s = self.site_of[vertex];
        let p = self.staging.positions()[vertex];
        if self.is_shared(s) {
            return false;
        }
        match self.regions.admit(&mut self.kernel, vertex, s, &p) {
            Some(Admission::WithinTolerance) => report.within_tolerance += 1,
            Some(Admission::WithinSafeRegion) => report.within_safe_region += 1,
            None => return false,
        }
        self.kernel.cover(&p, &p);
        report.moved += u64::from(self.exchange_position(vertex));
        true
    }

    /// Places the queued vertices; the regions follow.
    pub(in crate::motion) fn place_queued(&mut self, report: &mut CommitReport) -> Result<()> {
        self.order_queue_by_site();
        self.with_regions(report, |t, report| {
            t.place_staged(report, |t, v, new, report| t.relocate_noted(v, new, report))
        })
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
        let placed = self.relocate(vertex, q, Shortcut::Flips, report)?;
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
        self.kernel.record_changes(record);
        let done = change(self, report);
        match self.kernel.take_changes().filter(|_| done.is_ok()) {
            Some(changed) => {
                let mut relocated = self.regions.end_change();
                relocated.retain(|&v| !self.is_shared(self.site_of[v]));
                let (kernel, site_of) = (&mut self.kernel, &self.site_of);
                let other_positions = self.staging.positions();
                let n = self.regions.follow(kept, changed, relocated, kernel, site_of, other_positions);
                // Without the memory for it none are kept, and the next commit says so.
                report.tolerances += n.unwrap_or_default();
            }
            None => self.regions.give_up(kept),
        }
        done
    }
}
