//! What waits for the next commit beside moves: insertions and removals.

use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;

/// What waits.
#[derive(Debug)]
pub(super) struct Edits<G: Dimension> {
    insertions: Vec<(VertexId, G::Point)>,
    removals: Vec<VertexId>,
    /// By vertex id, whether a removal is staged; ids beyond the end have none.
    is_leaving: Vec<bool>,
}

impl<G: Dimension> Default for Edits<G> {
    fn default() -> Self {
        Edits { insertions: Vec::new(), removals: Vec::new(), is_leaving: Vec::new() }
    }
}

impl<G: Dimension> Edits<G> {
    /// Whether nothing waits.
    #[inline(always)]
    pub(super) fn are_none(&self) -> bool {
        self.insertions.is_empty() && self.removals.is_empty()
    }

    /// Whether the removal of a vertex is staged.
    #[inline(always)]
    pub(super) fn is_leaving(&self, vertex: VertexId) -> bool {
        !self.removals.is_empty() && self.is_leaving.get(vertex.index()).copied().unwrap_or(false)
    }

    /// Forgets all that waits.
    pub(super) fn clear(&mut self) {
        self.insertions.clear();
        for &v in &self.removals {
            self.is_leaving[v] = false;
        }
        self.removals.clear();
    }

    /// Forgets the removal of a vertex.
    pub(super) fn forget_removal(&mut self, vertex: VertexId) {
        if self.is_leaving(vertex) {
            self.is_leaving[vertex] = false;
            self.removals.retain(|&v| v != vertex);
        }
    }

    /// The insertions that wait: ids and positions.
    #[inline(always)]
    pub(super) fn insertions(&self) -> &[(VertexId, G::Point)] {
        &self.insertions
    }

    /// The vertices whose removal waits.
    #[inline(always)]
    pub(super) fn removals(&self) -> &[VertexId] {
        &self.removals
    }

    /// Makes room for `n` more insertions.
    pub(super) fn reserve_insertions(&mut self, n: usize) -> Result<()> {
        memory::reserve(&mut self.insertions, n)
    }

    /// Stages an insertion, for which there is room.
    pub(super) fn insert(&mut self, id: VertexId, position: G::Point) {
        self.insertions.push((id, position));
    }

    /// Puts the insertions in another order.
    pub(super) fn reorder_insertions(&mut self, ordered: Vec<(VertexId, G::Point)>) {
        debug_assert_eq!(ordered.len(), self.insertions.len());
        self.insertions = ordered;
    }

    /// Forgets the insertions; returns their ids, descending.
    pub(super) fn forget_insertions(&mut self) -> impl Iterator<Item = VertexId> {
        // A commit that failed has put them in another order.
        self.insertions.sort_unstable_by_key(|&(id, _)| id);
        self.insertions.drain(..).rev().map(|(id, _)| id)
    }

    /// Makes room for `n` more removals of `n_ids` vertices.
    pub(super) fn reserve_removals(&mut self, n: usize, n_ids: usize) -> Result<()> {
        memory::reserve(&mut self.removals, n)?;
        memory::lengthen(&mut self.is_leaving, n_ids, false)
    }

    /// Stages the removal of a vertex, for which there is room.
    pub(super) fn remove(&mut self, vertex: VertexId) {
        self.is_leaving[vertex] = true;
        self.removals.push(vertex);
    }

    /// Takes back all but the first `n` removals.
    pub(super) fn truncate_removals(&mut self, n: usize) {
        for v in self.removals.drain(n..) {
            self.is_leaving[v] = false;
        }
    }

    /// A copy in which the vertices have other ids, `n` in all: those listed by the old ones.
    pub(super) fn renumbered(&self, ids: &[VertexId], n: usize) -> Result<Self> {
        let mut insertions = memory::copy_of(&self.insertions)?;
        insertions.iter_mut().for_each(|(id, _)| *id = ids[*id]);
        let mut removals = memory::copy_of(&self.removals)?;
        removals.iter_mut().for_each(|v| *v = ids[*v]);
        let mut is_leaving = Vec::new();
        if !removals.is_empty() {
            memory::lengthen(&mut is_leaving, n, false)?;
            removals.iter().for_each(|&v| is_leaving[v] = true);
        }
        Ok(Edits { insertions, removals, is_leaving })
    }

    pub(super) fn copied(&self) -> Result<Self> {
        Ok(Edits {
            insertions: memory::copy_of(&self.insertions)?,
            removals: memory::copy_of(&self.removals)?,
            is_leaving: memory::copy_of(&self.is_leaving)?,
        })
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.insertions.capacity() * size_of::<(VertexId, G::Point)>()
            + self.removals.capacity() * 4
            + self.is_leaving.capacity()
    }
}
