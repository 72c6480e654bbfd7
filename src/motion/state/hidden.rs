//! Which vertices are hidden: trees of those at the same place.
//!
//! The vertices at a place form a tree whose root, the one of lowest key and then of lowest id, represents them. (Without
//! keys of the program's, those are ids.) A vertex on level `k` has two branches: one for the ids below it whose bit `k`,
//! from the lowest bit on, is 0, and one for those where it is 1. On top of each branch is the lowest of its vertices. So
//! the tree is a function of ids and keys alone, which makes undoing simple:
//! a vertex is taken out that was put in, and the other way round. It has no more levels than ids have bits, and of ids
//! that follow each other the logarithm of their number.
//!
//! Most vertices are alone at their place. So nothing is kept until the first vertex is hidden, and then 8 bytes for
//! each id.
//!
//! Cost: a vertex that comes or goes, wherever in the order of ids, takes a step on each level.

use crate::delaunay::{Keys, Merge};
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;

/// What is on top of the two branches of a vertex; [`VertexId::NONE`] for an empty one.
type Branches = [VertexId; 2];

const NO_BRANCHES: Branches = [VertexId::NONE; 2];

/// Levels below a root, at most: one for each bit of an id.
const LEVELS: usize = u32::BITS as usize;

/// Which branch of a vertex on this level a vertex below it is in.
#[inline(always)]
fn branch_of(vertex: VertexId, level: usize) -> usize {
    (vertex.get() >> level & 1) as usize
}

/// Which vertices are hidden.
#[derive(Debug, Default)]
pub(in crate::motion) struct Hidden {
    /// By vertex id; ids beyond the end are alone at their places.
    branches: Vec<Branches>,
    count: usize,
    /// Levels looked at so far: the work of coming and going.
    #[cfg(test)]
    steps: u64,
}

impl Hidden {
    /// Number of hidden vertices.
    #[inline(always)]
    pub(in crate::motion) fn count(&self) -> usize {
        self.count
    }

    #[inline(always)]
    fn branches(&self, vertex: VertexId) -> Branches {
        self.branches.get(vertex.index()).copied().unwrap_or(NO_BRANCHES)
    }

    /// Whether a representative has others behind it.
    #[inline(always)]
    pub(in crate::motion) fn is_followed(&self, representative: VertexId) -> bool {
        self.count != 0 && self.branches(representative) != NO_BRANCHES
    }

    /// The lowest of those behind a representative, [`VertexId::NONE`] if there are none.
    pub(in crate::motion) fn first_behind(&self, keys: &Keys, representative: VertexId) -> VertexId {
        let [left, right] = self.branches(representative);
        keys.lower(left, right)
    }

    /// What is on top of the branches of a vertex, [`VertexId::NONE`] for an empty one. From a representative on, each
    /// vertex behind it is so reached once, and from one of a lower id.
    pub(in crate::motion) fn tops_below(&self, vertex: VertexId) -> [VertexId; 2] {
        self.branches(vertex)
    }

    /// Visits a representative and all behind it, in no particular order.
    #[inline(always)]
    pub(in crate::motion) fn for_all_at(&self, representative: VertexId, mut visit: impl FnMut(VertexId)) {
        visit(representative);
        if self.is_followed(representative) {
            self.for_all_behind(representative, visit);
        }
    }

    /// Visits all behind a representative.
    pub(in crate::motion) fn for_all_behind(
        &self,
        representative: VertexId,
        mut visit: impl FnMut(VertexId),
    ) {
        // Of each level above the present one there is a branch to come back to.
        let mut waiting = [VertexId::NONE; LEVELS + 1];
        let (mut n_waiting, mut above) = (0, representative);
        loop {
            for top in self.branches(above) {
                if top != VertexId::NONE {
                    waiting[n_waiting] = top;
                    n_waiting += 1;
                }
            }
            if n_waiting == 0 {
                return;
            }
            n_waiting -= 1;
            above = waiting[n_waiting];
            visit(above);
        }
    }

    /// Makes room for `n_ids` ids.
    pub(in crate::motion) fn reserve(&mut self, n_ids: usize) -> Result<()> {
        memory::lengthen(&mut self.branches, n_ids, NO_BRANCHES)
    }

    /// Lets a vertex, for which there is room, join those of a representative; the lower of the two represents all.
    pub(in crate::motion) fn join(&mut self, keys: &Keys, representative: VertexId, vertex: VertexId) {
        self.count += 1;
        if keys.is_lower(vertex, representative) {
            self.branches[vertex] = self.branches[representative];
        }
        let mut above = keys.lower(representative, vertex);
        let mut lower = keys.higher(representative, vertex);
        // Where one finds another of a higher key on top of its branch, it takes that one's place, and that one goes on.
        for level in 0.. {
            self.count_step();
            let branch = branch_of(lower, level);
            let place = &mut self.branches[above][branch];
            let top = std::mem::replace(place, keys.lower(lower, *place));
            if top == VertexId::NONE {
                self.branches[lower] = NO_BRANCHES;
                return;
            }
            if keys.is_lower(lower, top) {
                self.branches[lower] = self.branches[top];
                (above, lower) = (lower, top);
            } else {
                above = top;
            }
        }
    }

    /// Takes a vertex away from those of its representative, be it that one itself.
    pub(in crate::motion) fn part(&mut self, keys: &Keys, representative: VertexId, vertex: VertexId) {
        self.count -= 1;
        let (mut above, mut level, mut there) = (None, 0, representative);
        while there != vertex {
            self.count_step();
            let branch = branch_of(vertex, level);
            above = Some((there, branch));
            there = self.branches[there][branch];
            level += 1;
        }
        // What is lower on top of the two branches rises, and leaves a gap in its turn.
        let mut below = std::mem::replace(&mut self.branches[vertex], NO_BRANCHES);
        loop {
            self.count_step();
            let top = keys.lower(below[0], below[1]);
            if let Some((above, branch)) = above {
                self.branches[above][branch] = top;
            }
            if top == VertexId::NONE {
                return;
            }
            let branch = usize::from(below[1] == top);
            let next = std::mem::replace(&mut self.branches[top], below);
            (above, below) = (Some((top, branch)), next);
        }
    }

    #[inline(always)]
    fn count_step(&mut self) {
        #[cfg(test)]
        {
            self.steps += 1;
        }
    }

    /// Levels looked at so far.
    #[cfg(test)]
    pub(in crate::motion) fn steps(&self) -> u64 {
        self.steps
    }

    /// The trees of merged vertices, by their representatives' ids.
    pub(in crate::motion) fn of_merges(
        keys: &Keys,
        merges: &[Merge],
        n_ids: usize,
        representative: impl Fn(SiteId) -> VertexId,
    ) -> Result<Self> {
        let mut hidden = Hidden::default();
        if !merges.is_empty() {
            hidden.reserve(n_ids)?;
        }
        for merge in merges {
            hidden.join(keys, representative(merge.site), merge.hidden);
        }
        Ok(hidden)
    }

    /// The trees of the vertices at the same places, of each of which the representative is given; [`VertexId::NONE`]
    /// for ids that have none.
    pub(in crate::motion) fn of_representatives(keys: &Keys, representatives: &[VertexId]) -> Result<Self> {
        let mut hidden = Hidden::default();
        let all = VertexId::range(0..representatives.len()).zip(representatives);
        for (v, &first) in all.filter(|&(v, &first)| first != VertexId::NONE && first != v) {
            hidden.reserve(representatives.len())?;
            hidden.join(keys, first, v);
        }
        Ok(hidden)
    }

    /// A copy.
    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(Hidden {
            branches: memory::copy_of(&self.branches)?,
            count: self.count,
            #[cfg(test)]
            steps: self.steps,
        })
    }

    /// A copy in which the vertices have other ids, in the same order, `n` in all: those listed by the old ones. The keys
    /// are by the other ids.
    pub(in crate::motion) fn renumbered(&self, keys: &Keys, ids: &[VertexId], n: usize) -> Result<Self> {
        let mut representatives = Vec::new();
        if self.count > 0 {
            memory::lengthen(&mut representatives, n, VertexId::NONE)?;
        }
        // What is above each first: only representatives have nothing above.
        let followed = || self.branches.iter().enumerate().filter(|(_, branches)| **branches != NO_BRANCHES);
        for (v, branches) in followed() {
            for top in branches.iter().filter(|top| **top != VertexId::NONE) {
                representatives[ids[*top]] = ids[v];
            }
        }
        for (v, _) in followed() {
            if representatives[ids[v]] != VertexId::NONE {
                continue;
            }
            representatives[ids[v]] = ids[v];
            self.for_all_behind(VertexId::at(v), |hidden| representatives[ids[hidden]] = ids[v]);
        }
        Self::of_representatives(keys, &representatives)
    }

    /// Two vertices at the same place, the one of the lower id first: without keys of the program's, the first
    /// representative with hidden vertices behind it, and the first of them.
    pub(in crate::motion) fn first_pair(&self, keys: &Keys) -> Option<(VertexId, VertexId)> {
        if self.count == 0 {
            return None;
        }
        let first = VertexId::at(self.branches.iter().position(|&branches| branches != NO_BRANCHES)?);
        let other = self.first_behind(keys, first);
        Some((first.min(other), first.max(other)))
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.branches)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::random::Rng;

    fn all_at(hidden: &Hidden, representative: VertexId) -> BTreeSet<VertexId> {
        let mut all = Vec::new();
        hidden.for_all_at(representative, |v| all.push(v));
        let set: BTreeSet<_> = all.iter().copied().collect();
        assert_eq!(set.len(), all.len(), "each once");
        set
    }

    /// Vertices come to a place and leave it in any order; a set is the oracle. Undone in the opposite order, all is
    /// bit by bit as it was.
    #[test]
    fn trees_have_what_sets_have() {
        let rng = &mut Rng::new(7);
        for n_ids in [2, 3, 10, 100, 5_000] {
            let mut hidden = Hidden::default();
            hidden.reserve(n_ids).expect("room");
            let mut there = BTreeSet::from([VertexId::at(rng.below(n_ids))]);
            let mut events = Vec::new();
            for step in 0..4 * n_ids {
                let v = VertexId::at(rng.below(n_ids));
                let first = *there.first().expect("some are there");
                let before = hidden.branches.clone();
                if !there.contains(&v) {
                    hidden.join(&Keys::default(), first, v);
                    there.insert(v);
                } else if there.len() > 1 {
                    hidden.part(&Keys::default(), first, v);
                    there.remove(&v);
                } else {
                    continue;
                }
                events.push((v, before));
                let first = *there.first().expect("some are there");
                assert_eq!(hidden.count(), there.len() - 1);
                assert_eq!(
                    hidden.first_behind(&Keys::default(), first),
                    there.iter().nth(1).copied().unwrap_or(VertexId::NONE)
                );
                let pair = there.iter().nth(1).map(|&second| (first, second));
                assert_eq!(hidden.first_pair(&Keys::default()), pair);
                if step % (1 + n_ids / 16) == 0 {
                    assert_eq!(all_at(&hidden, first), there);
                }
            }
            while let Some((v, before)) = events.pop() {
                let first = *there.first().expect("some are there");
                if there.contains(&v) {
                    hidden.part(&Keys::default(), first, v);
                    there.remove(&v);
                } else {
                    hidden.join(&Keys::default(), first, v);
                    there.insert(v);
                }
                assert_eq!(hidden.branches, before);
            }
        }
    }

    /// Of twice as many vertices at one place hardly more than twice as much is looked at, whatever the order in which
    /// they come and go, also of ids far apart.
    #[test]
    fn steps_are_as_many_as_vertices_but_for_a_logarithm() {
        let rng = &mut Rng::new(8);
        let mut steps = |n: usize, stride: usize, order: usize| {
            let mut ids: Vec<_> = (0..n).map(|k| VertexId::at(k * stride)).collect();
            match order {
                0 => {}
                1 => ids.reverse(),
                _ => (1..n).rev().for_each(|k| ids.swap(k, rng.below(k + 1))),
            }
            let mut hidden = Hidden::default();
            hidden.reserve(n * stride).expect("room");
            let mut first = ids[0];
            for &v in &ids[1..] {
                hidden.join(&Keys::default(), first, v);
                first = first.min(v);
            }
            for &v in &ids[1..] {
                let next = hidden.first_behind(&Keys::default(), first);
                hidden.part(&Keys::default(), first, v);
                first = if first == v { next } else { first };
            }
            assert_eq!((hidden.count(), first), (0, ids[0]));
            hidden.steps()
        };
        for stride in [1, 64] {
            for order in 0..3 {
                let [few, many] = [1 << 12, 1 << 13].map(|n| steps(n, stride, order));
                assert!(10 * many <= 23 * few && many <= 2 * 20 * (1 << 13), "{few} {many}");
            }
        }
    }

    #[test]
    fn other_ids_in_the_same_order_have_the_same_places() {
        let mut hidden = Hidden::default();
        hidden.reserve(40).expect("room");
        let at = VertexId::at;
        [7, 21, 30, 14, 9].iter().for_each(|&v| hidden.join(&Keys::default(), at(3), at(v)));
        hidden.join(&Keys::default(), at(12), at(33));
        let is_gone = |v: &usize| [0, 1, 8, 20, 32].contains(v);
        let mut ids = vec![VertexId::NONE; 40];
        (0..40).filter(|v| !is_gone(v)).enumerate().for_each(|(k, v)| ids[v] = at(k));
        let other = hidden.renumbered(&Keys::default(), &ids, 35).expect("room");
        assert_eq!(other.count(), hidden.count());
        for group in [&[3, 7, 9, 14, 21, 30][..], &[12, 33]] {
            assert_eq!(all_at(&other, ids[group[0]]), group.iter().map(|&v| ids[v]).collect());
        }
    }
}
