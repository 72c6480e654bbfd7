//! Vertices that refinement has added, and pieces that it has made of segments: where they come from.
//!
//! What has been removed since stays listed until the next refinement or coarsening; its ids are not given again.

use crate::error::Result;
use crate::ids::{SegmentId, VertexId};
use crate::machine::memory;
use crate::motion::report::VertexWeights;

/// The segment that a piece was made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) struct Origin {
    pub(in crate::motion) segment: SegmentId,
    pub(in crate::motion) ends: [VertexId; 2],
}

/// What has been made.
#[derive(Debug, Default)]
pub(in crate::motion) struct Made {
    /// Ascending; each with the original segment that it is on, [`SegmentId::NONE`] if there is none.
    vertices: Vec<(VertexId, SegmentId)>,
    /// Ascending.
    pieces: Vec<(SegmentId, Origin)>,
    /// Those of the vertices that the last refinement inserted.
    weights: Vec<VertexWeights>,
    /// The timestamp that it reached.
    refined_at: u64,
}

impl Made {
    /// The vertices, ascending, with the segment that each is on.
    pub(in crate::motion) fn vertices(&self) -> &[(VertexId, SegmentId)] {
        &self.vertices
    }

    /// Where a segment comes from, if it is a piece.
    pub(in crate::motion) fn origin(&self, piece: SegmentId) -> Option<Origin> {
        let at = self.pieces.binary_search_by_key(&piece, |&(piece, _)| piece).ok()?;
        Some(self.pieces[at].1)
    }

    /// How values at the vertices that the refinement of a timestamp inserted follow from others, if that was the last one.
    pub(in crate::motion) fn weights(&self, timestamp: u64) -> &[VertexWeights] {
        if self.refined_at == timestamp { &self.weights } else { &[] }
    }

    /// Remembers the weights of a refinement that has reached a timestamp.
    pub(in crate::motion) fn set_weights(&mut self, weights: Vec<VertexWeights>, timestamp: u64) {
        (self.weights, self.refined_at) = (weights, timestamp);
    }

    /// Makes room for more.
    pub(in crate::motion) fn reserve(&mut self, n_vertices: usize, n_pieces: usize) -> Result<()> {
        memory::reserve(&mut self.vertices, n_vertices)?;
        memory::reserve(&mut self.pieces, n_pieces)
    }

    /// Enters a vertex of a higher id than the others; there is room.
    pub(in crate::motion) fn enter_vertex(&mut self, vertex: VertexId, on: SegmentId) {
        self.vertices.push((vertex, on));
    }

    /// Enters a piece of a higher id than the others; there is room.
    pub(in crate::motion) fn enter_piece(&mut self, piece: SegmentId, origin: Origin) {
        self.pieces.push((piece, origin));
    }

    /// Forgets what is no longer there.
    pub(in crate::motion) fn keep(
        &mut self,
        is_present: impl Fn(VertexId) -> bool,
        is_in_force: impl Fn(SegmentId) -> bool,
    ) {
        self.vertices.retain(|&(v, _)| is_present(v));
        self.pieces.retain(|&(piece, _)| is_in_force(piece));
    }

    /// A copy.
    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(Made {
            vertices: memory::copy_of(&self.vertices)?,
            pieces: memory::copy_of(&self.pieces)?,
            weights: memory::copy_of(&self.weights)?,
            refined_at: self.refined_at,
        })
    }

    /// A copy in which the vertices have other ids, in their order: by the old ones, [`VertexId::NONE`] for those removed.
    pub(in crate::motion) fn renumbered(&self, ids: &[VertexId]) -> Result<Self> {
        let mut copy = self.copied()?;
        copy.weights = Vec::new();
        copy.vertices.iter_mut().for_each(|(v, _)| *v = ids[*v]);
        copy.vertices.retain(|&(v, _)| v != VertexId::NONE);
        copy.pieces.iter_mut().for_each(|(_, origin)| {
            origin.ends = origin.ends.map(|v| if v == VertexId::NONE { v } else { ids[v] });
        });
        Ok(copy)
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.vertices) + memory::bytes_of(&self.pieces) + memory::bytes_of(&self.weights)
    }
}
