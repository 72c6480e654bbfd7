//! Segments that programs stage, and ask about.

use crate::delaunay::Plane;
use crate::error::{Conflict, Error, Result};
use crate::ids::{SegmentId, VertexId};
use crate::machine::memory;
use crate::motion::state::segments::Segment;
use crate::motion::triangulation::MovingTriangulation;

impl MovingTriangulation<Plane> {
    /// Stages segments between vertices, all of them or, on an error, none; returns the id of the first, which those of
    /// the others follow. From the next commit on each is an edge. Ends may be vertices whose insertion is staged.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`], [`Error::RemovedVertex`], [`Error::OutOfMemory`].
    pub fn stage_segments(
        &mut self,
        segments: impl ExactSizeIterator<Item = Segment> + Clone,
    ) -> Result<SegmentId> {
        for (index, vertex) in segments.clone().flat_map(|segment| segment.ends).enumerate() {
            if !self.edits.is_coming(vertex) {
                self.present_site("ends", index, vertex)?;
            }
        }
        memory::made(&mut self.mesh.segments)?.stage(segments)
    }

    /// Stages the removal of segments: from the next commit on they are no longer edges that have to be there.
    ///
    /// # Errors
    /// [`Error::NoSuchSegment`], [`Error::OutOfMemory`]; then none is staged.
    pub fn stage_segment_removals(&mut self, removals: &[SegmentId]) -> Result<()> {
        let segments = memory::made(&mut self.mesh.segments)?;
        let before = segments.n_leaving();
        for (index, &segment) in removals.iter().enumerate() {
            let staged = match segments.get(segment) {
                Some(_) if !segments.is_leaving(segment) => segments.stage_removal(segment),
                _ => {
                    Err(Error::NoSuchSegment { argument: "segments", index, segment, ids: segments.n_ids() })
                }
            };
            if let Err(error) = staged {
                segments.truncate_removals(before);
                return Err(error);
            }
        }
        Ok(())
    }

    /// The segments in force, with their ids, ascending.
    pub fn segments(&self) -> impl Iterator<Item = (SegmentId, Segment)> {
        self.mesh.segments.iter().flat_map(|segments| segments.laid())
    }

    /// The conflicts for which the last change of all was refused that had some.
    pub fn conflicts_of_segments(&self) -> &[Conflict] {
        self.mesh.segments.as_ref().map_or(&[], |segments| segments.conflicts())
    }

    /// Whether some cell is not one of the Delaunay triangulation.
    pub fn is_constrained(&self) -> bool {
        self.mesh.segments.as_ref().is_some_and(|segments| segments.have_replaced_cells())
    }

    /// For each cell and each of its corners the segment at the edge opposite it, in the order of
    /// [`cells`](Self::cells): the lowest id if there are several, [`SegmentId::NONE`] if there is none.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn segments_of_cells(&self) -> Result<impl ExactSizeIterator<Item = [SegmentId; 3]> + '_> {
        let mut edges = Vec::new();
        let shown = |v: VertexId| self.mesh.kernel.site(self.mesh.site_of[v]).id;
        memory::collect(
            &mut edges,
            self.segments().map(|(id, segment)| {
                let [v, w] = segment.ends.map(shown);
                ([v.min(w), v.max(w)], id)
            }),
        )?;
        edges.sort_unstable();
        edges.dedup_by_key(|&mut (edge, _)| edge);
        let corners = self.mesh.views.cells(&self.mesh.kernel)?.corners();
        Ok(corners.iter().map(move |row| {
            [[1, 2], [2, 0], [0, 1]].map(|[i, j]| {
                let edge = [row[i].min(row[j]), row[i].max(row[j])];
                edges.binary_search_by_key(&edge, |&(edge, _)| edge).map_or(SegmentId::NONE, |k| edges[k].1)
            })
        }))
    }
}
