//! Small sets of indices, for questions that may not write marks.

use crate::error::Result;
use crate::machine::memory;

/// Up to this number, indices need no memory of their own.
const FEW: usize = 64;
/// Places where to look for them: a power of two, four times as many, so that hardly any two meet.
const PLACES: usize = 4 * FEW;

/// A set of indices, in the order in which they came.
#[derive(Debug)]
pub(crate) struct IndexSet {
    n: usize,
    few: [u32; FEW],
    /// One above the position in `few` of each, at its hash or behind; 0 where there is none.
    places: [u8; PLACES],
    /// All of them, once they are more.
    all: Vec<u32>,
    /// Then, where to find each: one above its position, at its hash or behind; a power of two of entries, half of them 0
    /// at least.
    table: Vec<u32>,
}

#[inline(always)]
fn hash(index: u32) -> usize {
    (u64::from(index).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as usize
}

impl IndexSet {
    pub(crate) fn new() -> Self {
        IndexSet { n: 0, few: [0; FEW], places: [0; PLACES], all: Vec::new(), table: Vec::new() }
    }

    /// The indices.
    #[inline(always)]
    pub(crate) fn as_slice(&self) -> &[u32] {
        if self.all.is_empty() { &self.few[..self.n] } else { &self.all }
    }

    /// Takes all out; keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.n = 0;
        self.places = [0; PLACES];
        self.all.clear();
    }

    /// Enters an index; whether it was not there. After an error it is not.
    #[inline(always)]
    pub(crate) fn insert(&mut self, index: u32) -> Result<bool> {
        if self.n > FEW {
            return self.insert_into_table(index);
        }
        let mut at = hash(index) % PLACES;
        while let Some(position) = usize::from(self.places[at]).checked_sub(1) {
            if self.few[position] == index {
                return Ok(false);
            }
            at = (at + 1) % PLACES;
        }
        if self.n == FEW {
            self.spill(index)?;
        } else {
            self.few[self.n] = index;
            self.places[at] = self.n as u8 + 1;
        }
        self.n += 1;
        Ok(true)
    }

    /// Where the index is, or its entry would be.
    fn find(&self, index: u32) -> usize {
        let mask = self.table.len() - 1;
        let mut at = hash(index) & mask;
        while self.table[at] != 0 && self.all[self.table[at] as usize - 1] != index {
            at = (at + 1) & mask;
        }
        at
    }

    #[cold]
    #[inline(never)]
    fn spill(&mut self, index: u32) -> Result<()> {
        memory::reserve(&mut self.all, FEW + 1)?;
        self.make_table(4 * FEW)?;
        self.all.extend_from_slice(&self.few);
        self.all.push(index);
        self.fill_table();
        Ok(())
    }

    #[cold]
    #[inline(never)]
    fn insert_into_table(&mut self, index: u32) -> Result<bool> {
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
            for _ in 0..[3, 64, 65, 66, 130, 1000][round % 6] {
                let index = rng.next() as u32 >> [24, 20, 0][round / 6 % 3];
                let is_new = expected.insert(index);
                assert_eq!(set.insert(index), Ok(is_new));
                if is_new {
                    order.push(index);
                }
                assert_eq!(set.as_slice(), order);
            }
        }
    }
}
