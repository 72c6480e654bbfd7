//! Small sets of sites or slots, for questions that may not write marks.

use crate::error::Result;
use crate::ids::Id;
use crate::machine::memory;

/// Up to this number, indices need no memory of their own: a power of two, less one.
const INLINE_CAPACITY: usize = 63;
/// Places where to look for them: a power of two, four times as many and more, so that hardly any two meet.
const PLACES: usize = 1 << u8::BITS;

/// A set of indices, in the order in which they came.
#[derive(Debug)]
pub(crate) struct IndexSet<I> {
    n: usize,
    /// From 1 on.
    few: [I; INLINE_CAPACITY + 1],
    /// One more than each, at its hash or behind; 0 where there is none. Once one has been [inserted](Self::insert):
    /// those that are only [pushed](Self::push) are not looked for.
    places: Option<[u32; PLACES]>,
    /// All indices, once they are more than `few` holds.
    all: Vec<I>,
    /// Once there are so many, where to find each: one above its position, at its hash or behind; a power of two of
    /// entries, half of them 0 at least.
    table: Vec<u32>,
}

/// The upper bits of multiples of it, the golden ratio of 2^32, spread well.
const GOLDEN: u32 = 0x9e37_79b9;

/// Where to look for one of few.
#[inline(always)]
fn place_of(index: impl Id) -> usize {
    usize::from((index.get().wrapping_mul(GOLDEN) >> 24) as u8)
}

/// What stands for an index in its place: no index is the greatest number.
#[inline(always)]
fn key_of(index: impl Id) -> u32 {
    debug_assert!(index.get() != u32::MAX);
    index.get() + 1
}

/// Enters an index, unless it is there, into the few, of which there are `n`, with room for one more.
#[inline(always)]
fn enter<I: Id>(few: &mut [I; INLINE_CAPACITY + 1], places: &mut [u32; PLACES], index: I, n: &mut usize) {
    let (at, key) = (place_of(index), key_of(index));
    let found = places[at];
    // Whether an index is new is hard to foresee: no branch is on it, but for one on whether another is in its place.
    if u64::from(found) * u64::from(found ^ key) != 0 {
        return enter_behind(few, places, index, n);
    }
    // Where nothing is new, what is behind the last entry is written.
    few[(*n + 1) & INLINE_CAPACITY] = index;
    *n += usize::from(found == 0);
    places[at] = key;
}

/// Enters an index, unless it is there, into the few, where another index is in its place.
#[cold]
#[inline(never)]
fn enter_behind<I: Id>(
    few: &mut [I; INLINE_CAPACITY + 1],
    places: &mut [u32; PLACES],
    index: I,
    n: &mut usize,
) {
    let (at, is_there) = look_up(places, index);
    if !is_there {
        *n += 1;
        few[*n] = index;
        places[at] = key_of(index);
    }
}

/// The place of an index, or the one that it would get; and whether it is there.
#[inline(always)]
fn look_up(places: &[u32; PLACES], index: impl Id) -> (usize, bool) {
    let (mut at, key) = (place_of(index), key_of(index));
    while places[at] != 0 && places[at] != key {
        at = (at + 1) % PLACES;
    }
    (at, places[at] == key)
}

impl<I: Id> Default for IndexSet<I> {
    fn default() -> Self {
        Self::new()
    }
}

impl<I: Id> IndexSet<I> {
    pub(crate) fn new() -> Self {
        IndexSet {
            n: 0,
            few: [I::new(0); INLINE_CAPACITY + 1],
            places: None,
            all: Vec::new(),
            table: Vec::new(),
        }
    }

    /// The indices.
    #[inline(always)]
    pub(crate) fn as_slice(&self) -> &[I] {
        if self.all.is_empty() { &self.few[1..=self.n] } else { &self.all }
    }

    /// Whether an index has been [entered](Self::insert).
    #[inline(always)]
    fn contains(&self, index: I) -> bool {
        if self.n > INLINE_CAPACITY {
            return self.table[self.find(index)] != 0;
        }
        self.places.as_ref().is_some_and(|places| look_up(places, index).1)
    }

    /// Takes all out; keeps the memory.
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.n = 0;
        self.places = None;
        self.all.clear();
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.all) + memory::bytes_of(&self.table)
    }

    /// Enters an index; whether it was not there. After an error it is not.
    #[inline(always)]
    pub(crate) fn insert(&mut self, index: I) -> Result<bool> {
        let n = self.n;
        if n < INLINE_CAPACITY {
            enter(&mut self.few, self.places.get_or_insert([0; PLACES]), index, &mut self.n);
            return Ok(self.n > n);
        }
        self.insert_beyond(index)
    }

    /// Enters an index into an empty set, and all that are reached from it: `around` tells which are next to an index.
    #[inline(always)]
    pub(crate) fn spread<const N: usize>(
        &mut self,
        first: I,
        mut around: impl FnMut(I) -> [I; N],
    ) -> Result<()> {
        // The number is not kept in memory meanwhile: each entry would wait for that of the one before.
        let (mut n, mut next) = (0, 1);
        let (few, places) = (&mut self.few, self.places.get_or_insert([0; PLACES]));
        enter(few, places, first, &mut n);
        while next <= n && n + N <= INLINE_CAPACITY {
            for other in around(few[next & INLINE_CAPACITY]) {
                enter(few, places, other, &mut n);
            }
            next += 1;
        }
        self.n = n;
        while let Some(&index) = self.as_slice().get(next - 1) {
            for other in around(index) {
                self.insert(other)?;
            }
            next += 1;
        }
        Ok(())
    }

    /// Enters an index that is known not to be there. No [`insert`](Self::insert) may follow until the set has been
    /// cleared.
    #[inline(always)]
    pub(crate) fn push(&mut self, index: I) -> Result<()> {
        if self.n < INLINE_CAPACITY {
            self.n += 1;
            self.few[self.n & INLINE_CAPACITY] = index;
            return Ok(());
        }
        self.push_beyond(index)
    }

    #[cold]
    #[inline(never)]
    fn push_beyond(&mut self, index: I) -> Result<()> {
        if self.all.is_empty() {
            memory::reserve(&mut self.all, INLINE_CAPACITY + 1)?;
            self.all.extend_from_slice(&self.few[1..]);
        }
        memory::push(&mut self.all, index)?;
        self.n += 1;
        Ok(())
    }

    /// Enters an index where there are more than `few` holds, or will be; whether it was not there.
    #[cold]
    #[inline(never)]
    fn insert_beyond(&mut self, index: I) -> Result<bool> {
        if self.n > INLINE_CAPACITY {
            return self.insert_into_table(index);
        }
        if self.contains(index) {
            return Ok(false);
        }
        self.spill(index)?;
        self.n += 1;
        Ok(true)
    }

    /// Where the index is, or its entry would be.
    fn find(&self, index: I) -> usize {
        let mask = self.table.len() - 1;
        let mut at = ((u64::from(index.get().wrapping_mul(GOLDEN)) * self.table.len() as u64) >> 32) as usize;
        while self.table[at] != 0 && self.all[self.table[at] as usize - 1] != index {
            at = (at + 1) & mask;
        }
        at
    }

    fn spill(&mut self, index: I) -> Result<()> {
        memory::reserve(&mut self.all, INLINE_CAPACITY + 1)?;
        self.make_table(4 * (INLINE_CAPACITY + 1))?;
        self.all.extend_from_slice(&self.few[1..]);
        self.all.push(index);
        self.fill_table();
        Ok(())
    }

    fn insert_into_table(&mut self, index: I) -> Result<bool> {
        let at = self.find(index);
        if self.table[at] != 0 {
            return Ok(false);
        }
        memory::reserve(&mut self.all, 1)?;
        if 2 * (self.n + 1) > self.table.len() {
            self.make_table(2 * self.table.len())?;
            self.all.push(index);
            self.fill_table();
        } else {
            self.all.push(index);
            self.table[at] = self.all.len() as u32;
        }
        self.n += 1;
        Ok(true)
    }

    /// Makes the table empty and of a length, to be filled.
    fn make_table(&mut self, length: usize) -> Result<()> {
        let mut table = Vec::new();
        memory::lengthen(&mut table, length, 0)?;
        self.table = table;
        Ok(())
    }

    fn fill_table(&mut self) {
        for k in 0..self.all.len() {
            let at = self.find(self.all[k]);
            self.table[at] = k as u32 + 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Slot;
    use crate::random::Rng;
    use std::collections::HashSet;

    #[test]
    fn sets_hold_what_has_been_entered() {
        let mut set = IndexSet::new();
        let rng = &mut Rng::new(1);
        for round in 0..200 {
            set.clear();
            let mut expected = HashSet::new();
            let mut order = Vec::new();
            for _ in 0..[3, 63, 64, 65, 130, 1000][round % 6] {
                let index = Slot::new(rng.next() as u32 >> [24, 20, 0][round / 6 % 3]);
                let is_new = expected.insert(index);
                assert_eq!(set.contains(index), !is_new);
                assert_eq!(set.insert(index), Ok(is_new));
                assert!(set.contains(index));
                if is_new {
                    order.push(index);
                }
                assert_eq!(set.as_slice(), order);
            }
        }
    }

    #[test]
    fn sets_spread_to_all_that_is_reached() {
        let rng = &mut Rng::new(2);
        for n in [1, 2, 20, 60, 61, 62, 63, 64, 65, 100, 1000] {
            for _ in 0..20 {
                let next: Vec<[u32; 3]> = (0..n).map(|_| [0; 3].map(|_| rng.next() as u32 % n)).collect();
                // Indices that few places have to do for, or that are far apart.
                let scale = [1, 256, 0x9e37][rng.next() as usize % 3];
                let mut set = IndexSet::new();
                set.spread(Slot::new(0), |at| {
                    next[(at.get() / scale) as usize].map(|to| Slot::new(to * scale))
                })
                .unwrap();
                let mut reached = HashSet::from([0]);
                let mut open = vec![0];
                while let Some(at) = open.pop() {
                    open.extend(next[at as usize].into_iter().filter(|&to| reached.insert(to)));
                }
                assert_eq!(set.as_slice().len(), reached.len());
                assert_eq!(set.as_slice().iter().map(|at| at.get() / scale).collect::<HashSet<_>>(), reached);
            }
        }
    }

    #[test]
    fn sets_keep_what_is_pushed() {
        let mut set = IndexSet::new();
        for n in [0, 1, 62, 63, 64, 65, 1000] {
            set.clear();
            Slot::range(0..n).for_each(|index| set.push(index).unwrap());
            assert!(set.as_slice().iter().copied().eq(Slot::range(0..n)));
        }
    }
}
