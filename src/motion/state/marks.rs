//! Sets of slots, cells or vertices whose numbers are below a bound: a bit for each, and a list of those whose bit is
//! set.

use crate::error::Result;
use crate::ids::Id;
use crate::machine::memory;

/// Scanning the bits of this number of numbers takes as long as sorting one.
const SCANNED_PER_SORTED: usize = 256;

/// Bits by number; those beyond the end are 0.
#[derive(Debug, Default)]
pub(in crate::motion) struct Bits(Vec<u64>);

impl Bits {
    #[inline(always)]
    pub(in crate::motion) fn has(&self, k: impl Id) -> bool {
        self.0.get(k.index() / 64).is_some_and(|word| word >> (k.index() % 64) & 1 == 1)
    }

    /// Sets a bit within the end; whether it was not set.
    #[inline(always)]
    pub(in crate::motion) fn insert(&mut self, k: impl Id) -> bool {
        let (word, bit) = (&mut self.0[k.index() / 64], 1 << (k.index() % 64));
        let is_new = *word & bit == 0;
        *word |= bit;
        is_new
    }

    /// Clears a bit within the end; whether it was set.
    #[inline(always)]
    pub(in crate::motion) fn remove(&mut self, k: impl Id) -> bool {
        let (word, bit) = (&mut self.0[k.index() / 64], 1 << (k.index() % 64));
        let was_set = *word & bit != 0;
        *word &= !bit;
        was_set
    }

    /// Clears a bit within the end, and maybe some next to it.
    #[inline(always)]
    pub(in crate::motion) fn clear_around(&mut self, k: impl Id) {
        self.0[k.index() / 64] = 0;
    }

    /// Makes room for the bits of the numbers below `n`.
    pub(in crate::motion) fn grow(&mut self, n: usize) -> Result<()> {
        let missing = n.div_ceil(64).saturating_sub(self.0.len());
        memory::reserve(&mut self.0, missing)?;
        self.0.resize(self.0.len() + missing, 0);
        Ok(())
    }

    /// The numbers whose bits are set, ascending.
    fn iter(&self) -> impl Iterator<Item = u32> {
        self.0.iter().zip(0..).flat_map(|(&word, k)| {
            let mut rest = word;
            std::iter::from_fn(move || {
                let bit = (rest != 0).then(|| rest.trailing_zeros())?;
                rest &= rest - 1;
                Some(64 * k + bit)
            })
        })
    }

    fn copied(&self) -> Result<Self> {
        Ok(Bits(memory::copy_of(&self.0)?))
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        self.0.capacity() * 8
    }
}

/// A set.
#[derive(Debug)]
pub(in crate::motion) struct Marks<I> {
    list: Vec<I>,
    bits: Bits,
}

impl<I> Default for Marks<I> {
    fn default() -> Self {
        Marks { list: Vec::new(), bits: Bits::default() }
    }
}

impl<I: Id> Marks<I> {
    /// Makes room for `more` numbers below `n`.
    pub(in crate::motion) fn reserve(&mut self, more: usize, n: usize) -> Result<()> {
        memory::reserve(&mut self.list, more)?;
        self.bits.grow(n)
    }

    /// Adds a number for which there is room.
    #[inline(always)]
    pub(in crate::motion) fn insert(&mut self, k: I) {
        if self.bits.insert(k) {
            self.list.push(k);
        }
    }

    #[inline(always)]
    pub(in crate::motion) fn has(&self, k: I) -> bool {
        self.bits.has(k)
    }

    /// The numbers, in the order in which they came, or ascending since the set was last [sorted](Self::sort).
    pub(in crate::motion) fn as_slice(&self) -> &[I] {
        &self.list
    }

    /// Puts a list of all the numbers in ascending order.
    fn put_in_order(&self, list: &mut Vec<I>) {
        if SCANNED_PER_SORTED * list.len() < 64 * self.bits.0.len() {
            list.sort_unstable();
        } else {
            list.clear();
            list.extend(self.bits.iter().map(I::new));
        }
    }

    /// Puts the numbers in ascending order.
    pub(in crate::motion) fn sort(&mut self) {
        let mut list = std::mem::take(&mut self.list);
        self.put_in_order(&mut list);
        self.list = list;
    }

    /// Takes out all but those of the numbers that came first.
    pub(in crate::motion) fn truncate(&mut self, n: usize) {
        for k in self.list.drain(n.min(self.list.len())..) {
            self.bits.remove(k);
        }
    }

    pub(in crate::motion) fn clear(&mut self) {
        for k in self.list.drain(..) {
            self.bits.clear_around(k);
        }
    }

    /// Gives back memory for more than `n` numbers. The set must be empty.
    pub(in crate::motion) fn shrink_to(&mut self, n: usize) {
        debug_assert!(self.list.is_empty());
        if self.list.capacity() > n {
            self.list = Vec::new();
        }
    }

    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(Marks { list: memory::copy_of(&self.list)?, bits: self.bits.copied()? })
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        self.list.capacity() * 4 + self.bits.memory_bytes()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Slot;

    #[test]
    fn numbers_come_once_and_in_order() {
        for n in [3_000, 1_000_000] {
            let mut marks = Marks::default();
            let numbers: Vec<Slot> = (0..2_000).map(|k| Slot::new(k * 7_919 % 1_009 * (n / 1_009))).collect();
            marks.reserve(numbers.len(), n as usize).expect("room");
            numbers.iter().for_each(|&k| marks.insert(k));
            let mut expected = numbers;
            assert!(!marks.as_slice().is_sorted());
            expected.sort_unstable();
            expected.dedup();
            assert_eq!((expected.len(), marks.as_slice().len()), (1_009, 1_009));
            marks.sort();
            assert_eq!(marks.as_slice(), expected, "below {n}");
            assert!(
                expected.iter().all(|&k| marks.has(k)) && !marks.has(Slot::new(1)) && !marks.has(Slot::NONE)
            );
            marks.clear();
            assert!(marks.as_slice().is_empty() && !expected.iter().any(|&k| marks.has(k)));
        }
    }
}
