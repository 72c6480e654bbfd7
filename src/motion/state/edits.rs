//! What waits for the next commit beside moves: insertions and removals.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::state::part::{PointPart, set_part};

/// What waits.
#[derive(Debug, Default)]
pub(in crate::motion) struct Edits<G: Moving> {
    insertions: Vec<(VertexId, G::Point)>,
    /// How many ids had been given when the first of them was staged, or by calls that insert at once since: no insertion that
    /// is forgotten gives one of these back.
    n_known: usize,
    /// Whether vertices had keys then.
    had_keys: bool,
    removals: Vec<VertexId>,
    /// By vertex id, where among the removals it is, [`u32::MAX`] for those that stay; so do ids beyond the end.
    place: Vec<u32>,
}

/// The place among the removals of a vertex that stays.
const STAYS: u32 = u32::MAX;

impl<G: Moving> Edits<G> {
    /// Whether nothing waits.
    #[inline(always)]
    pub(in crate::motion) fn are_none(&self) -> bool {
        self.insertions.is_empty() && self.removals.is_empty()
    }

    /// Whether the removal of a vertex is staged.
    #[inline(always)]
    pub(in crate::motion) fn is_removal_staged(&self, vertex: VertexId) -> bool {
        !self.removals.is_empty() && self.place.get(vertex.index()).is_some_and(|&place| place != STAYS)
    }

    /// Forgets all that waits.
    pub(in crate::motion) fn clear(&mut self) {
        self.insertions.clear();
        for &v in &self.removals {
            self.place[v.index()] = STAYS;
        }
        self.removals.clear();
    }

    /// Forgets the removal of a vertex.
    pub(in crate::motion) fn forget_removal(&mut self, vertex: VertexId) {
        if self.is_removal_staged(vertex) {
            let place = std::mem::replace(&mut self.place[vertex.index()], STAYS);
            self.removals.swap_remove(place as usize);
            if let Some(&last) = self.removals.get(place as usize) {
                self.place[last.index()] = place;
            }
        }
    }

    /// The insertions that wait: ids, ascending, and positions.
    #[inline(always)]
    pub(in crate::motion) fn insertions(&self) -> &[(VertexId, G::Point)] {
        &self.insertions
    }

    /// The vertices whose removal waits.
    #[inline(always)]
    pub(in crate::motion) fn removals(&self) -> &[VertexId] {
        &self.removals
    }

    /// Makes room for `n` more insertions.
    pub(in crate::motion) fn reserve_insertions(&mut self, n: usize) -> Result<()> {
        memory::reserve(&mut self.insertions, n)
    }

    /// Stages an insertion, for which there is room, of an id above those of the others; or they are
    /// [sorted](Self::sort_insertions) afterwards.
    pub(in crate::motion) fn insert(&mut self, id: VertexId, position: G::Point) {
        self.insertions.push((id, position));
    }

    /// Puts the insertions in the order of their ids.
    pub(in crate::motion) fn sort_insertions(&mut self) {
        if !self.insertions.is_sorted_by_key(|&(id, _)| id) {
            self.insertions.sort_unstable_by_key(|&(id, _)| id);
        }
    }

    /// Whether the insertion of a vertex is staged.
    pub(in crate::motion) fn is_insertion_staged(&self, vertex: VertexId) -> bool {
        self.insertion(vertex).is_some()
    }

    /// Where a vertex will be inserted, if its insertion is staged.
    pub(in crate::motion) fn insertion(&self, vertex: VertexId) -> Option<&G::Point> {
        let at = self.insertions.binary_search_by_key(&vertex, |&(id, _)| id).ok()?;
        Some(&self.insertions[at].1)
    }

    /// Vertices that will be inserted will be where these positions say, of the first ids; they have been checked.
    pub(in crate::motion) fn place_insertions(&mut self, positions: &[G::Point]) {
        for (id, place) in &mut self.insertions {
            let Some(position) = positions.get(id.index()) else { return };
            for axis in 0..G::NUMBERS {
                // Places have no negative zeros.
                place[axis] = position[axis] + 0.0;
            }
        }
    }

    /// A vertex that will be inserted will be at this place, or have this weight; the numbers have been checked.
    pub(in crate::motion) fn set_part(&mut self, vertex: VertexId, part: PointPart, numbers: &[f64]) {
        if let Ok(at) = self.insertions.binary_search_by_key(&vertex, |&(id, _)| id) {
            set_part::<G>(&mut self.insertions[at].1, part, numbers);
        }
    }

    /// Puts the insertions back as they were.
    pub(in crate::motion) fn restore_insertions(&mut self, before: Vec<(VertexId, G::Point)>) {
        debug_assert_eq!(before.len(), self.insertions.len());
        self.insertions = before;
    }

    /// Takes back all but the first `n` insertions.
    pub(in crate::motion) fn truncate_insertions(&mut self, n: usize) {
        self.insertions.truncate(n);
    }

    /// Before the first insertion is staged, or after one has been made at once: so many ids have been given for good, and
    /// keys or none.
    pub(in crate::motion) fn know(&mut self, n_ids: usize, has_keys: bool) {
        (self.n_known, self.had_keys) = (n_ids, has_keys);
    }

    /// Whether vertices have keys when all insertions are forgotten.
    pub(in crate::motion) fn had_keys(&self) -> bool {
        self.had_keys
    }

    /// Whether insertions wait.
    pub(in crate::motion) fn has_insertions(&self) -> bool {
        !self.insertions.is_empty()
    }

    /// How many ids forgotten insertions do not give back.
    pub(in crate::motion) fn n_known(&self) -> usize {
        self.n_known
    }

    /// Forgets the insertions; returns their ids, descending.
    pub(in crate::motion) fn forget_insertions(&mut self) -> impl Iterator<Item = VertexId> {
        self.insertions.drain(..).rev().map(|(id, _)| id)
    }

    /// Makes room for `n` more removals of `n_ids` vertices.
    pub(in crate::motion) fn reserve_removals(&mut self, n: usize, n_ids: usize) -> Result<()> {
        memory::reserve(&mut self.removals, n)?;
        memory::lengthen(&mut self.place, n_ids, STAYS)
    }

    /// Stages the removal of a vertex, for which there is room.
    pub(in crate::motion) fn remove(&mut self, vertex: VertexId) {
        self.place[vertex.index()] = self.removals.len() as u32;
        self.removals.push(vertex);
    }

    /// Takes back all but the first `n` removals.
    pub(in crate::motion) fn truncate_removals(&mut self, n: usize) {
        for v in self.removals.drain(n..) {
            self.place[v.index()] = STAYS;
        }
    }

    /// A copy in which the vertices have other ids, `n` in all: those listed by the old ones.
    pub(in crate::motion) fn renumbered(&self, ids: &[VertexId], n: usize) -> Result<Self> {
        let mut insertions = memory::copy_of(&self.insertions)?;
        insertions.iter_mut().for_each(|(id, _)| *id = ids[*id]);
        let mut removals = memory::copy_of(&self.removals)?;
        removals.iter_mut().for_each(|v| *v = ids[*v]);
        let mut place = Vec::new();
        if !removals.is_empty() {
            memory::lengthen(&mut place, n, STAYS)?;
            (0..).zip(&removals).for_each(|(k, v)| place[v.index()] = k);
        }
        let n_known = ids.iter().take(self.n_known).filter(|id| **id != VertexId::NONE).count();
        Ok(Edits { insertions, n_known, had_keys: self.had_keys, removals, place })
    }

    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(Edits {
            insertions: memory::copy_of(&self.insertions)?,
            n_known: self.n_known,
            had_keys: self.had_keys,
            removals: memory::copy_of(&self.removals)?,
            place: memory::copy_of(&self.place)?,
        })
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        self.insertions.capacity() * size_of::<(VertexId, G::Point)>()
            + self.removals.capacity() * 4
            + self.place.capacity() * 4
    }
}
