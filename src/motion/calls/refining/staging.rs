//! What refinement and coarsening have found is staged, committed and remembered.

use super::reading::Read;
use crate::delaunay::Plane;
use crate::error::Result;
use crate::ids::{SegmentId, VertexId};
use crate::machine::memory;
use crate::motion::calls::keys::Coming;
use crate::motion::report::QualityReport;
use crate::motion::state::made::Origin;
use crate::motion::state::segments::Segment;
use crate::motion::triangulation::MovingTriangulation;

/// Segments that come and go.
#[derive(Debug, Default)]
pub(super) struct SegmentChanges {
    coming: Vec<(Segment, Origin)>,
    leaving: Vec<SegmentId>,
}

impl SegmentChanges {
    pub(super) fn leave(&mut self, segments: &[([VertexId; 2], SegmentId)]) -> Result<()> {
        memory::collect(&mut self.leaving, segments.iter().map(|&(_, id)| id))
    }
}

impl MovingTriangulation<Plane> {
    /// Enters a segment between two vertices in the direction of an edge, for each segment at it.
    pub(super) fn replace_at(
        &self,
        read: &Read,
        edge: u32,
        [v, w]: [VertexId; 2],
        changes: &mut SegmentChanges,
    ) -> Result<()> {
        let shown = |v: VertexId| self.mesh.kernel.site(self.mesh.site_of[v]).id;
        let start = read.edges[edge as usize][0];
        for &(_, id) in read.segments_at(edge as usize) {
            let segment = self.segment_in_force(id);
            let ends = if shown(segment.ends[0]) == start { [v, w] } else { [w, v] };
            // A vertex that shares its place stays the end that it was.
            let ends = ends.map(|v| segment.ends.into_iter().find(|&end| shown(end) == v).unwrap_or(v));
            let marker = segment.marker;
            memory::push(&mut changes.coming, (Segment { ends, marker }, self.origin_of(id)))?;
        }
        Ok(())
    }

    /// Makes all changes in a commit, and remembers them.
    pub(super) fn commit_quality(
        &mut self,
        points: &[[f64; 2]],
        on_segments: &[SegmentId],
        removed: &[VertexId],
        changes: SegmentChanges,
        report: &mut QualityReport,
    ) -> Result<()> {
        memory::made(&mut self.made)?.reserve(points.len(), changes.coming.len())?;
        let done = self.stage_quality(points, removed, &changes).and_then(|ids| {
            self.commit_timestamp()?;
            Ok(ids)
        });
        let (first_vertex, first_segment) = match done {
            Ok(ids) => ids,
            Err(error) => {
                self.discard_moves();
                return Err(error);
            }
        };
        let made = self.made.as_mut().expect("it has been made");
        for (v, &on) in VertexId::range(first_vertex.index()..self.mesh.site_of.len()).zip(on_segments) {
            made.enter_vertex(v, on);
        }
        let n_coming = changes.coming.len();
        let ids = SegmentId::range(first_segment.index()..first_segment.index() + n_coming);
        for (id, &(_, origin)) in ids.zip(&changes.coming) {
            made.enter_piece(id, origin);
        }
        let (mesh, segments) = (&self.mesh, &self.mesh.segments);
        made.keep(
            |v| mesh.is_present(v),
            |piece| segments.as_ref().is_some_and(|segments| segments.get(piece).is_some()),
        );
        (report.replaced_segments, report.new_segments) = (changes.leaving.len(), n_coming);
        Ok(())
    }

    /// Stages all changes; returns the ids of the first vertex and segment that will come.
    fn stage_quality(
        &mut self,
        points: &[[f64; 2]],
        removed: &[VertexId],
        changes: &SegmentChanges,
    ) -> Result<(VertexId, SegmentId)> {
        let first_vertex = self.stage_coming(points, Coming::Made)?;
        self.stage_removals(removed)?;
        let first_segment = self.stage_segments(changes.coming.iter().map(|&(segment, _)| segment))?;
        let segments = memory::made(&mut self.mesh.segments)?;
        changes.leaving.iter().try_for_each(|&segment| segments.stage_removal(segment))?;
        Ok((first_vertex, first_segment))
    }
}
