//! What refinement and coarsening have found is staged, committed and remembered.

use super::NONE;
use super::reading::Read;
use crate::delaunay::Plane;
use crate::error::Result;
use crate::ids::{SegmentId, VertexId};
use crate::machine::memory;
use crate::motion::calls::keys::{Coming, Ids};
use crate::motion::options::RefineOptions;
use crate::motion::report::QualityReport;
use crate::motion::state::made::{Inserted, Origin};
use crate::motion::state::segments::Segment;
use crate::motion::triangulation::MovingTriangulation;
use crate::refine::Refined;

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
            let origin = self.origin_of(id);
            // A vertex that shares its place stays the end that it was.
            let own = |v: VertexId| segment.ends.into_iter().find(|&end| shown(end) == v);
            let ends = ends.map(|v| own(v).or_else(|| self.end_at(v, origin)).unwrap_or(v));
            memory::push(&mut changes.coming, (Segment { ends, ..segment }, origin))?;
        }
        Ok(())
    }

    /// The vertex that shares the place of this one, and is an end of a piece of this origin: pieces have been joined
    /// up to it.
    fn end_at(&self, v: VertexId, origin: Origin) -> Option<VertexId> {
        let s = self.mesh.site(v).filter(|&s| self.mesh.is_shared(s))?;
        let pieces = self.segments().filter(|&(id, _)| self.origin_of(id) == origin);
        pieces.flat_map(|(_, piece)| piece.ends).find(|&end| self.mesh.site(end) == Some(s))
    }

    /// Makes what has been found in a commit; `inserted` gets the new vertices, and their weights if they are wanted.
    pub(super) fn commit_refined(
        &mut self,
        read: &Read,
        refined: &Refined,
        options: &RefineOptions,
        inserted: &mut Inserted,
        report: &mut QualityReport,
    ) -> Result<()> {
        let from = if options.reuses_ids { Ids::Free } else { Ids::Next };
        inserted.vertices = self.coming_ids(refined.vertices.len(), from)?;
        let n_given = self.id_count();
        let id = |v: VertexId| if v.index() < n_given { v } else { inserted.vertices[v.index() - n_given] };
        let mut changes = SegmentChanges::default();
        let mut start = 0;
        for &(edge, end) in &refined.replaced {
            for pair in refined.chain[start..end].windows(2) {
                self.replace_at(read, edge, [id(pair[0]), id(pair[1])], &mut changes)?;
            }
            changes.leave(read.segments_at(edge as usize))?;
            start = end;
        }
        let mut points = Vec::new();
        memory::collect(
            &mut points,
            refined.vertices.iter().map(|&(p, _)| p.map(|x| x / read.places.scale)),
        )?;
        let on = |edge: u32| match edge {
            NONE => SegmentId::NONE,
            edge => self.origin_of(read.segments_at(edge as usize)[0].1).segment,
        };
        let mut on_segments = Vec::new();
        memory::collect(&mut on_segments, refined.vertices.iter().map(|&(_, edge)| on(edge)))?;
        if options.has_weights {
            inserted.weights = self.weights_of(&points, &self.edges_under(read, refined)?)?;
        }
        let coming = (&inserted.vertices[..], &points[..], &on_segments[..]);
        self.commit_quality(coming, &refined.removed, changes, report)
    }

    /// Makes all changes in a commit, and remembers them. Of vertices that come: ids, places, and the segments that
    /// they are on.
    pub(super) fn commit_quality(
        &mut self,
        (vertices, points, on_segments): (&[VertexId], &[[f64; 2]], &[SegmentId]),
        removed: &[VertexId],
        changes: SegmentChanges,
        report: &mut QualityReport,
    ) -> Result<()> {
        memory::made(&mut self.made)?.reserve(points.len(), changes.coming.len())?;
        let done = self.stage_quality((vertices, points), removed, &changes).and_then(|first| {
            self.commit_timestamp()?;
            Ok(first)
        });
        let first_segment = match done {
            Ok(first) => first,
            Err(error) => {
                self.discard_moves();
                return Err(error);
            }
        };
        let made = self.made.as_mut().expect("it has been made");
        made.enter_vertices(vertices.iter().copied().zip(on_segments.iter().copied()));
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

    /// Stages all changes; returns the id of the first segment that will come.
    fn stage_quality(
        &mut self,
        (vertices, points): (&[VertexId], &[[f64; 2]]),
        removed: &[VertexId],
        changes: &SegmentChanges,
    ) -> Result<SegmentId> {
        self.stage_at(points, Coming::Made, vertices)?;
        self.stage_removals(removed)?;
        let first_segment = self.stage_segments(changes.coming.iter().map(|&(segment, _)| segment))?;
        let segments = memory::made(&mut self.mesh.segments)?;
        changes.leaving.iter().try_for_each(|&segment| segments.stage_removal(segment))?;
        Ok(first_segment)
    }
}
