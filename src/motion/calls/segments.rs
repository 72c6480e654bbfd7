//! Segments that programs stage, and ask about.

use crate::delaunay::Plane;
use crate::error::{Conflict, Error, Result};
use crate::ids::SegmentId;
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
            if !self.edits.is_insertion_staged(vertex) {
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
        for (index, &segment) in removals.iter().enumerate() {
            let staged = match segments.get(segment) {
                Some(_) if !segments.is_removal_staged(segment) => segments.stage_removal(segment),
                _ => {
                    Err(Error::NoSuchSegment { argument: "segments", index, segment, ids: segments.n_ids() })
                }
            };
            if let Err(error) = staged {
                segments.forget_removals(&removals[..index]);
                return Err(error);
            }
        }
        Ok(())
    }

    /// The segments in force, with their ids, ascending.
    pub fn segments(&self) -> impl Iterator<Item = (SegmentId, Segment)> {
        self.mesh.segments.iter().flat_map(|segments| segments.enforced())
    }

    /// The conflicts for which the latest call that changes or checks was refused, ascending; none if it was not refused
    /// for conflicts. Calls that stage, discard, publish, withdraw or ask keep them.
    pub fn conflicts_of_segments(&self) -> &[Conflict] {
        self.mesh.last_found.conflicts()
    }

    /// Whether some cell is not one of the Delaunay triangulation.
    pub fn is_constrained(&self) -> bool {
        self.mesh.segments.as_ref().is_some_and(|segments| segments.have_replaced_cells())
    }
}
