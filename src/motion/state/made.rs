//! Vertices that refinement has added, and pieces that it, or splitting, has made of segments: where they come from.
//!
//! Vertices that splitting has added, where segments cross, are not listed: they are on several originals, and refinement
//! must not take them away.
//!
//! What has been removed since stays listed until the next refinement or coarsening, or until its id is given again.

use crate::error::Result;
use crate::ids::{SegmentId, VertexId};
use crate::machine::memory;
use crate::motion::report::VertexWeights;
use crate::motion::state::density::Density;
use crate::motion::state::looked::{Found, Looked};

/// The segment that a piece was made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::motion) struct Origin {
    pub(in crate::motion) segment: SegmentId,
    /// Its ends, or the nearest vertices at which it was split by others.
    pub(in crate::motion) ends: [VertexId; 2],
}

/// Where a piece comes from, by a list of them.
fn origin_in(pieces: &[(SegmentId, Origin)], piece: SegmentId) -> Option<Origin> {
    let at = pieces.binary_search_by_key(&piece, |&(piece, _)| piece).ok()?;
    Some(pieces[at].1)
}

/// The vertices that a refinement has inserted.
#[derive(Debug, Default)]
pub(in crate::motion) struct Inserted {
    /// Ascending.
    pub(in crate::motion) vertices: Vec<VertexId>,
    /// How values there follow from others; empty if that was not asked for.
    pub(in crate::motion) weights: Vec<VertexWeights>,
    /// The sizes there; empty if none were given.
    pub(in crate::motion) sizes: Vec<f64>,
}

/// What has been made.
#[derive(Debug, Default)]
pub(in crate::motion) struct Made {
    /// Ascending; each with the original segment that it is on, [`SegmentId::NONE`] if there is none.
    vertices: Vec<(VertexId, SegmentId)>,
    /// Ascending.
    pieces: Vec<(SegmentId, Origin)>,
    /// The staged pieces, ascending, above the others, for which there is room among them.
    staged: Vec<(SegmentId, Origin)>,
    /// By the last refinement.
    inserted: Inserted,
    /// How dense the mesh is.
    pub(in crate::motion) density: Density,
    /// Copies know nothing of it.
    pub(in crate::motion) looked: Looked,
    pub(in crate::motion) found: Found,
}

impl Made {
    /// The vertices, ascending, with the segment that each is on.
    pub(in crate::motion) fn vertices(&self) -> &[(VertexId, SegmentId)] {
        &self.vertices
    }

    /// The pieces, ascending, with where they come from; those that are staged are the last.
    pub(in crate::motion) fn pieces(&self) -> impl Iterator<Item = &(SegmentId, Origin)> {
        self.pieces.iter().chain(&self.staged)
    }

    /// What saved lists say, each ascending: pieces from `n_enforced` on are staged.
    pub(in crate::motion) fn of_lists(
        vertices: Vec<(VertexId, SegmentId)>,
        mut pieces: Vec<(SegmentId, Origin)>,
        n_enforced: usize,
    ) -> Result<Self> {
        let first = pieces.partition_point(|&(piece, _)| piece.index() < n_enforced);
        let mut staged = Vec::new();
        memory::append(&mut staged, &pieces[first..])?;
        // Its room stays, for when those are made.
        pieces.truncate(first);
        let made = Made { vertices, pieces, staged, ..Made::default() };
        Ok(made)
    }

    /// The segment that a vertex is on, if it is listed.
    pub(in crate::motion) fn is_on(&self, vertex: VertexId) -> Option<SegmentId> {
        let at = self.vertices.binary_search_by_key(&vertex, |&(vertex, _)| vertex).ok()?;
        Some(self.vertices[at].1)
    }

    /// Where a segment comes from, if it is a piece.
    pub(in crate::motion) fn origin(&self, piece: SegmentId) -> Option<Origin> {
        origin_in(&self.pieces, piece)
    }

    /// Where a segment comes from, if it is a piece, or is staged as one.
    pub(in crate::motion) fn origin_with_staged(&self, piece: SegmentId) -> Option<Origin> {
        self.origin(piece).or_else(|| origin_in(&self.staged, piece))
    }

    /// Makes room for more staged pieces, and for all of them once they are made.
    pub(in crate::motion) fn reserve_staged(&mut self, n: usize) -> Result<()> {
        memory::reserve(&mut self.staged, n)?;
        memory::reserve(&mut self.pieces, self.staged.len() + n)
    }

    /// Enters a staged piece of a higher id than all others; there is room.
    pub(in crate::motion) fn enter_staged(&mut self, piece: SegmentId, origin: Origin) {
        self.staged.push((piece, origin));
    }

    /// What is staged is forgotten.
    pub(in crate::motion) fn discard_staged(&mut self) {
        self.staged.clear();
    }

    /// How many pieces there are, staged ones not counted.
    pub(in crate::motion) fn n_pieces(&self) -> usize {
        self.pieces.len()
    }

    /// All but the first pieces have not been made.
    pub(in crate::motion) fn truncate_pieces(&mut self, n: usize) {
        self.pieces.truncate(n);
        self.staged.clear();
    }

    /// What was staged is made. Needs no memory.
    pub(in crate::motion) fn end_staging(&mut self) {
        self.pieces.append(&mut self.staged);
    }

    /// What the refinement of a timestamp inserted, if that was the last one.
    pub(in crate::motion) fn inserted(&self, timestamp: u64) -> Option<&Inserted> {
        (self.density.refined_at() == timestamp).then_some(&self.inserted)
    }

    /// Remembers what the last refinement inserted.
    pub(in crate::motion) fn set_inserted(&mut self, inserted: Inserted) {
        self.inserted = inserted;
    }

    /// Makes room for more.
    pub(in crate::motion) fn reserve(&mut self, n_vertices: usize, n_pieces: usize) -> Result<()> {
        memory::reserve(&mut self.vertices, n_vertices)?;
        memory::reserve(&mut self.pieces, n_pieces)
    }

    /// Enters vertices that are not listed; there is room.
    pub(in crate::motion) fn enter_vertices(
        &mut self,
        vertices: impl Iterator<Item = (VertexId, SegmentId)>,
    ) {
        self.vertices.extend(vertices);
        self.vertices.sort_unstable();
    }

    /// The ids of vertices that are no more, ascending, will be those of others.
    pub(in crate::motion) fn forget(&mut self, ids: &[VertexId]) {
        self.vertices.retain(|(v, _)| ids.binary_search(v).is_err());
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
        let mut copy = Made { vertices: memory::copy_of(&self.vertices)?, ..Made::default() };
        memory::reserve_exact(&mut copy.pieces, self.pieces.len() + self.staged.len())?;
        copy.pieces.extend_from_slice(&self.pieces);
        copy.staged = memory::copy_of(&self.staged)?;
        let Inserted { vertices, weights, sizes } = &self.inserted;
        copy.inserted = Inserted {
            vertices: memory::copy_of(vertices)?,
            weights: memory::copy_of(weights)?,
            sizes: memory::copy_of(sizes)?,
        };
        copy.density = self.density;
        Ok(copy)
    }

    /// A copy in which the vertices have other ids, in their order: by the old ones, [`VertexId::NONE`] for those removed.
    pub(in crate::motion) fn renumbered(&self, ids: &[VertexId]) -> Result<Self> {
        let mut copy = self.copied()?;
        copy.inserted = Inserted::default();
        copy.vertices.iter_mut().for_each(|(v, _)| *v = ids[*v]);
        copy.vertices.retain(|&(v, _)| v != VertexId::NONE);
        copy.pieces.iter_mut().chain(&mut copy.staged).for_each(|(_, origin)| {
            origin.ends = origin.ends.map(|v| if v == VertexId::NONE { v } else { ids[v] });
        });
        Ok(copy)
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.vertices)
            + memory::bytes_of(&self.pieces)
            + memory::bytes_of(&self.staged)
            + memory::bytes_of(&self.inserted.vertices)
            + memory::bytes_of(&self.inserted.weights)
            + memory::bytes_of(&self.inserted.sizes)
            + self.looked.memory_bytes()
            + self.found.memory_bytes()
    }
}
