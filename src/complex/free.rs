//! The free slots, from which the one near a given slot is taken: so cells that are near each other stay near each
//! other in storage, however long they are exchanged.
//!
//! There is a bit for each slot, and above that two [levels], with a bit for each word of the level below that is not
//! 0. Where the word of a slot has no free one, the level above tells which of the words beside it have. So a free slot
//! is found in the same 64, 64² or 64³ slots, the smallest block of these that has any.
//!
//! The slots that have been freed last are kept *in hand*, in a short list: they are in a cache, so that writing them
//! waits for no memory. Where cells are in no order, as they are while one thread does all, they are taken first;
//! otherwise only if they are near.
//!
//! Cost: mostly one word, and a few at each level if the nearest one is far away. A slot takes an eighth of a byte.

mod levels;

pub(super) use levels::WORD;

use crate::error::Result;
use crate::ids::Slot;
use crate::machine::memory;
use levels::{LEVELS, Levels};

/// A slot no farther than this is near.
const NEAR: usize = 1 << 10;

/// Most slots in hand.
const MOST: usize = 32;
/// How many are laid down to make room.
const HALF: usize = MOST / 2;

/// The free ones of all slots for which there is memory.
#[derive(Debug, Default)]
pub(super) struct FreeSlots {
    /// Bits of those that are not in hand.
    levels: [Vec<u64>; LEVELS],
    in_hand: InHand,
    /// How many slots are free, in hand or not.
    n: usize,
}

/// The slots that have been freed last.
#[derive(Clone, Debug)]
struct InHand {
    slots: [Slot; MOST],
    n: usize,
    /// Whether it counts more that a slot is near than that it is in a cache.
    are_near_wanted: bool,
}

impl Default for InHand {
    fn default() -> Self {
        InHand { slots: [Slot::NONE; MOST], n: 0, are_near_wanted: false }
    }
}

impl InHand {
    fn as_slice(&self) -> &[Slot] {
        &self.slots[..self.n]
    }

    /// Adds a slot; returns those that have been there longest, if there was no room for it.
    #[inline(always)]
    fn push(&mut self, slot: Slot) -> Option<[Slot; HALF]> {
        let laid_down = if self.n == MOST { Some(self.pop_oldest()) } else { None };
        self.slots[self.n % MOST] = slot;
        self.n += 1;
        laid_down
    }

    #[cold]
    #[inline(never)]
    fn pop_oldest(&mut self) -> [Slot; HALF] {
        let mut oldest = [Slot::NONE; HALF];
        oldest.copy_from_slice(&self.slots[..HALF]);
        self.slots.copy_within(HALF.., 0);
        self.n -= HALF;
        oldest
    }

    /// Takes out the latest slot, if it is good enough in place of one near this one.
    #[inline(always)]
    fn pop_for(&mut self, near: Slot) -> Option<Slot> {
        let last = *self.as_slice().last()?;
        if self.are_near_wanted && last.index().abs_diff(near.index()) >= NEAR {
            return None;
        }
        self.n -= 1;
        Some(last)
    }
}

/// The free ones of slots that follow each other.
#[derive(Debug)]
pub(super) struct FreeRange<'c> {
    /// The first slot.
    first: usize,
    /// Bits of those of the range, without upper levels where there are other ranges beside it.
    levels: Levels<'c>,
    pub(super) n: &'c mut usize,
    /// The slots in hand, if the range is all slots.
    in_hand: Option<&'c mut InHand>,
}

impl FreeSlots {
    /// Has bits for this number of slots.
    pub(super) fn cover(&mut self, n_slots: usize) -> Result<()> {
        let mut n = n_slots;
        for level in &mut self.levels {
            n = n.div_ceil(WORD);
            memory::lengthen(level, n, 0)?;
        }
        Ok(())
    }

    /// Number of free slots.
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.n
    }

    /// All free slots.
    pub(super) fn iter(&self) -> impl Iterator<Item = Slot> + '_ {
        let listed = self.levels[0].iter().enumerate().flat_map(|(k, &word)| {
            let lowest = std::iter::successors(Some(word), |left| Some(left & left.wrapping_sub(1)));
            let bits = lowest.take_while(|&left| left != 0).map(u64::trailing_zeros);
            bits.map(move |bit| Slot::at(WORD * k + bit as usize))
        });
        listed.chain(self.in_hand.as_slice().iter().copied())
    }

    /// Enters a free slot, which was not.
    #[inline(always)]
    pub(super) fn put(&mut self, slot: Slot) {
        self.n += 1;
        if let Some(oldest) = self.in_hand.push(slot) {
            self.set_bits(&oldest);
        }
    }

    /// Takes out a free slot, if there is any: near this one, or from the hand.
    #[inline(always)]
    pub(super) fn take_near(&mut self, near: Slot) -> Option<Slot> {
        if self.n == 0 {
            return None;
        }
        match self.in_hand.pop_for(near) {
            Some(slot) => {
                self.n -= 1;
                Some(slot)
            }
            None => self.look_near(near),
        }
    }

    #[inline(never)]
    fn look_near(&mut self, near: Slot) -> Option<Slot> {
        self.whole().take_near(near)
    }

    #[inline(always)]
    pub(super) fn whole(&mut self) -> FreeRange<'_> {
        let FreeSlots { levels, in_hand, n } = self;
        FreeRange {
            first: 0,
            levels: Levels(levels.each_mut().map(|level| &mut level[..])),
            n,
            in_hand: Some(in_hand),
        }
    }

    /// Enters whether a slot is free.
    pub(super) fn set(&mut self, slot: Slot, is_free: bool) {
        self.lay_down();
        let all = self.whole();
        let (mut levels, n) = (all.levels, all.n);
        match (levels.has(slot.index()), is_free) {
            (false, true) => {
                *n += 1;
                levels.set(slot.index());
            }
            (true, false) => {
                *n -= 1;
                levels.unset(slot.index());
            }
            _ => {}
        }
    }

    /// Enters the slots in hand among the bits, so that none is in hand.
    fn lay_down(&mut self) {
        let InHand { slots, n, .. } = self.in_hand;
        if n > 0 {
            self.in_hand.n = 0;
            self.set_bits(&slots[..n]);
        }
    }

    #[inline(never)]
    fn set_bits(&mut self, slots: &[Slot]) {
        let mut levels = self.whole().levels;
        slots.iter().for_each(|slot| levels.set(slot.index()));
    }

    pub(super) fn clear(&mut self) {
        self.levels.iter_mut().for_each(|level| level.fill(0));
        (self.n, self.in_hand) = (0, InHand::default());
    }

    /// Puts free slots instead of those there are; they are everywhere, so that near ones are to be taken.
    pub(super) fn put_everywhere(&mut self, slots: impl Iterator<Item = Slot>) {
        self.clear();
        slots.for_each(|slot| self.set(slot, true));
        self.in_hand.are_near_wanted = self.n > 0;
    }

    /// Takes out those of these slots that are free.
    pub(super) fn remove_all(&mut self, slots: impl Iterator<Item = Slot>) {
        slots.for_each(|slot| self.set(slot, false));
    }

    /// The ranges that begin at these slots, all of them multiples of [`WORD`] and the first one 0; `numbers` is memory
    /// for how many are free in each. What has been put and taken there has to be [counted](Self::count) before
    /// anything else.
    pub(super) fn ranges<'c>(
        &'c mut self,
        starts: &'c [Slot],
        numbers: &'c mut [usize],
    ) -> impl Iterator<Item = FreeRange<'c>> {
        self.lay_down();
        let mut rest = &mut self.levels[0][..];
        starts.iter().zip(numbers).enumerate().map(move |(k, (start, n))| {
            let n_words = starts.get(k + 1).map_or(rest.len(), |end| (end.index() - start.index()) / WORD);
            let words = rest.split_off_mut(..n_words).expect("the slots of a range are covered");
            *n = words.iter().map(|word| word.count_ones() as usize).sum();
            FreeRange { first: start.index(), levels: Levels([words, &mut [], &mut []]), n, in_hand: None }
        })
    }

    /// Makes the upper levels by the lowest one.
    pub(super) fn count(&mut self) {
        self.n = self.levels[0].iter().map(|word| word.count_ones() as usize).sum();
        for k in 1..LEVELS {
            let (lower, upper) = self.levels.split_at_mut(k);
            for (word, below) in upper[0].iter_mut().zip(lower[k - 1].chunks(WORD)) {
                *word = below.iter().rev().fold(0, |word, &below| word << 1 | u64::from(below != 0));
            }
        }
    }

    pub(super) fn copied(&self) -> Result<Self> {
        let [a, b, c] = &self.levels;
        let levels = [memory::copy_of(a)?, memory::copy_of(b)?, memory::copy_of(c)?];
        Ok(FreeSlots { levels, in_hand: self.in_hand.clone(), n: self.n })
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.levels.iter().map(memory::bytes_of).sum()
    }
}

impl FreeRange<'_> {
    /// Enters a free slot, which was not.
    #[inline(always)]
    pub(super) fn put(&mut self, slot: Slot) {
        *self.n += 1;
        match &mut self.in_hand {
            None => self.set_bit(slot),
            Some(in_hand) => {
                if let Some(oldest) = in_hand.push(slot) {
                    oldest.into_iter().for_each(|slot| self.set_bit(slot));
                }
            }
        }
    }

    #[inline(always)]
    fn set_bit(&mut self, slot: Slot) {
        self.levels.set(slot.index() - self.first);
    }

    /// Takes out a free slot, if there is any in the range: near this one, or from the hand.
    #[inline(always)]
    pub(super) fn take_near(&mut self, near: Slot) -> Option<Slot> {
        *self.n = self.n.checked_sub(1)?;
        if let Some(in_hand) = &mut self.in_hand
            && let Some(slot) = in_hand.pop_for(near)
        {
            return Some(slot);
        }
        if let Some(found) = self.levels.near(near.index().saturating_sub(self.first)) {
            self.levels.unset(found);
            return Some(Slot::at(self.first + found));
        }
        // There are none but those in hand, which are not near.
        let in_hand = self.in_hand.as_mut()?;
        in_hand.n -= 1;
        Some(in_hand.slots[in_hand.n])
    }
}

#[cfg(test)]
mod tests;
