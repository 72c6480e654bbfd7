//! Which vertices are hidden, as a bit for each id.

use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;

/// A set of vertices. Those beyond its end are not in it.
#[derive(Debug, Default)]
pub(crate) struct HiddenIds(Vec<u64>);

impl HiddenIds {
    /// The set of these, of so many ids.
    pub(crate) fn of(vertices: impl Iterator<Item = VertexId>, n_ids: usize) -> Result<Self> {
        let mut words = Vec::new();
        memory::lengthen(&mut words, n_ids.div_ceil(64), 0_u64)?;
        vertices.for_each(|v| words[v.index() / 64] |= 1 << (v.index() % 64));
        Ok(HiddenIds(words))
    }

    /// Makes room for the vertices of so many ids.
    pub(in crate::motion) fn make_room(&mut self, n_ids: usize) -> Result<()> {
        memory::lengthen(&mut self.0, n_ids.div_ceil(64), 0_u64)
    }

    /// Enters a vertex, or takes it out; `false` if there is no room for it.
    pub(in crate::motion) fn set(&mut self, vertex: VertexId, is_in: bool) -> bool {
        let bit = 1_u64 << (vertex.index() % 64);
        match self.0.get_mut(vertex.index() / 64) {
            Some(word) => *word = if is_in { *word | bit } else { *word & !bit },
            None => return !is_in,
        }
        true
    }

    /// Whether a vertex is in the set.
    pub(in crate::motion) fn has(&self, vertex: VertexId) -> bool {
        self.word(vertex.index() / 64) >> (vertex.index() % 64) & 1 == 1
    }

    /// An id above all that are in the set.
    pub(in crate::motion) fn n_ids(&self) -> usize {
        64 * self.0.len()
    }

    fn word(&self, k: usize) -> u64 {
        self.0.get(k).copied().unwrap_or(0)
    }

    /// The vertices that are in one of two sets alone, ascending, each with whether it is in this one.
    pub(crate) fn differences(&self, other: &Self) -> impl Iterator<Item = (VertexId, bool)> {
        (0..self.0.len().max(other.0.len())).flat_map(move |k| {
            let own = self.word(k);
            let mut bits = own ^ other.word(k);
            std::iter::from_fn(move || {
                let bit = bits.trailing_zeros();
                (bits != 0).then(|| {
                    bits &= bits - 1;
                    (VertexId::at(64 * k + bit as usize), own >> bit & 1 == 1)
                })
            })
        })
    }

    /// The set under other ids, `n` in all: those listed by the old ones; what has none is dropped.
    pub(in crate::motion) fn renumbered(&self, ids: &[VertexId], n: usize) -> Result<Self> {
        let none = HiddenIds::default();
        let all = self.differences(&none).map(|(v, _)| ids[v]);
        HiddenIds::of(all.filter(|&v| v != VertexId::NONE), n)
    }

    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(HiddenIds(memory::copy_of(&self.0)?))
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_those_of_sets() {
        let set = |vertices: &[u32], n| {
            HiddenIds::of(vertices.iter().map(|&v| VertexId::new(v)), n).expect("there is room")
        };
        let (before, after) = (set(&[0, 63, 64, 130], 131), set(&[1, 63, 300], 301));
        let found: Vec<_> = before.differences(&after).map(|(v, is_before)| (v.get(), is_before)).collect();
        assert_eq!(found, [(0, true), (1, false), (64, true), (130, true), (300, false)]);
        let ids: Vec<_> =
            (0..131).map(|v| if v == 64 { VertexId::NONE } else { VertexId::new(v / 2) }).collect();
        let renumbered = before.renumbered(&ids, 66).expect("there is room");
        assert_eq!(renumbered.differences(&set(&[0, 31, 65], 66)).count(), 0);
    }

    #[test]
    fn vertices_are_entered_and_taken_out_where_there_is_room() {
        let mut set = HiddenIds::default();
        let [low, high] = [3, 70].map(VertexId::new);
        assert!(!set.set(low, true) && set.set(high, false) && !set.has(low));
        set.make_room(65).expect("there is room");
        assert!(
            set.set(low, true) && set.set(high, true) && set.has(low) && set.has(high) && set.n_ids() == 128
        );
        set.make_room(1).expect("there is room");
        assert!(set.set(low, false) && !set.has(low) && set.has(high) && !set.has(VertexId::new(500)));
    }
}
