//! Which vertices are hidden: chains of those at the same place.
//!
//! The vertices at a place form a chain in ascending order: each names the next one. A vertex without a next one is the
//! last at its place, and most are alone there. So nothing is kept until the first vertex is hidden, and then 4 bytes
//! for each id.

use crate::delaunay::Merge;
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;

/// Which vertices are hidden.
#[derive(Debug, Default)]
pub(super) struct Hidden {
    /// By vertex id, the next one at the same place; [`VertexId::NONE`] for the last one, and for ids beyond the end.
    next: Vec<VertexId>,
    count: usize,
}

impl Hidden {
    /// Number of hidden vertices.
    #[inline(always)]
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// The next vertex at the place of this one.
    #[inline(always)]
    pub(super) fn next(&self, vertex: VertexId) -> VertexId {
        self.next.get(vertex.index()).copied().unwrap_or(VertexId::NONE)
    }

    /// Whether a representative has others behind it.
    #[inline(always)]
    pub(super) fn is_followed(&self, representative: VertexId) -> bool {
        self.count != 0 && self.next(representative) != VertexId::NONE
    }

    /// The one of the vertices at a representative's place after which this one comes.
    pub(super) fn before(&self, representative: VertexId, vertex: VertexId) -> VertexId {
        let mut before = representative;
        while self.next(before) < vertex {
            before = self.next(before);
        }
        before
    }

    /// Makes room for `n_ids` ids.
    pub(super) fn reserve(&mut self, n_ids: usize) -> Result<()> {
        let missing = n_ids.saturating_sub(self.next.len());
        if missing > 0 {
            memory::reserve(&mut self.next, missing)?;
            self.next.resize(n_ids, VertexId::NONE);
        }
        Ok(())
    }

    /// Sets the next vertex after one that there is room for.
    pub(super) fn set_next(&mut self, vertex: VertexId, next: VertexId) {
        if let Some(entry) = self.next.get_mut(vertex.index()) {
            *entry = next;
        }
    }

    /// Sets the number of hidden vertices.
    pub(super) fn set_count(&mut self, count: usize) {
        self.count = count;
    }

    /// The chains of merged vertices, by their representatives' ids.
    pub(super) fn of_merges(
        mut merges: Vec<Merge>,
        n_ids: usize,
        representative: impl Fn(SiteId) -> VertexId,
    ) -> Result<Self> {
        let mut hidden = Hidden::default();
        if merges.is_empty() {
            return Ok(hidden);
        }
        hidden.reserve(n_ids)?;
        merges.sort_unstable_by_key(|merge| std::cmp::Reverse(merge.hidden));
        for merge in &merges {
            let first = representative(merge.site);
            let after = hidden.next(first);
            hidden.set_next(merge.hidden, after);
            hidden.set_next(first, merge.hidden);
        }
        hidden.count = merges.len();
        Ok(hidden)
    }

    /// The chains of the vertices at the same places, of each of which the representative is given;
    /// [`VertexId::NONE`] for ids that have none.
    pub(super) fn of_representatives(representatives: &[VertexId]) -> Result<Self> {
        let mut hidden = Hidden::default();
        let all = VertexId::range(0..representatives.len()).zip(representatives);
        let others = all.filter(|&(v, &first)| first != VertexId::NONE && first != v);
        // Each is put in front of those with higher ids.
        for (v, &first) in others.rev() {
            hidden.reserve(representatives.len())?;
            hidden.set_next(v, hidden.next(first));
            hidden.set_next(first, v);
            hidden.count += 1;
        }
        Ok(hidden)
    }

    /// A copy.
    pub(super) fn copied(&self) -> Result<Self> {
        Ok(Hidden { next: memory::copy_of(&self.next)?, count: self.count })
    }

    /// A copy in which the vertices have other ids, `n` in all: those listed by the old ones.
    pub(super) fn renumbered(&self, ids: &[VertexId], n: usize) -> Result<Self> {
        let mut hidden = Hidden { next: Vec::new(), count: self.count };
        if self.count > 0 {
            memory::reserve_exact(&mut hidden.next, n)?;
            hidden.next.resize(n, VertexId::NONE);
            for (&id, &next) in ids.iter().zip(&self.next).filter(|(_, next)| **next != VertexId::NONE) {
                hidden.next[id] = ids[next];
            }
        }
        Ok(hidden)
    }

    /// The first representative with hidden vertices behind it, and the first of them.
    pub(super) fn first_pair(&self) -> Option<(VertexId, VertexId)> {
        // A vertex that another one names is no representative; those come in ascending order.
        let first = self.next.iter().position(|&next| next != VertexId::NONE)?;
        Some((VertexId::at(first), self.next[first]))
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.next.capacity() * 4
    }
}
