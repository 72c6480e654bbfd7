//! The free slots, from which the one near a given slot is taken: so cells that are near each other stay near each other in
//! storage, however long they are exchanged.
//!
//! There is a bit for each slot, and above that two levels, with a bit for each word of the level below that is not 0. Where
//! the word of a slot has no free one, the level above tells which of the words beside it have. So a free slot is found in
//! the same 64, 64² or 64³ slots, the smallest block of these that has any.
//!
//! The slots that have been freed last are kept in hand: they are in a cache. Where cells are in no order, as they are
//! while one thread does all, they are taken first, which is a tenth faster; otherwise only if they are near.
//!
//! Cost: mostly one word, and a few at each level if the nearest one is far away. A slot takes an eighth of a byte.

use crate::error::Result;
use crate::ids::Slot;
use crate::machine::memory;
use std::cmp::Ordering;

const LEVELS: usize = 3;
/// Bits of a word; ranges of slots begin at a multiple of it.
pub(crate) const WORD: usize = u64::BITS as usize;

/// A slot no farther than this is near.
const NEAR: usize = 1 << 10;

/// The free ones of all slots for which there is memory.
#[derive(Debug, Default)]
pub(super) struct FreeSlots {
    /// Those that are not in hand.
    levels: [Vec<u64>; LEVELS],
    in_hand: InHand,
    /// Of all.
    n: usize,
    /// Whether it counts more that a slot is near than that it is in a cache.
    is_local: bool,
}

/// The slots that have been freed last.
#[derive(Clone, Debug)]
struct InHand {
    slots: [Slot; Self::MOST],
    n: usize,
}

impl Default for InHand {
    fn default() -> Self {
        InHand { slots: [Slot::NONE; Self::MOST], n: 0 }
    }
}

impl InHand {
    const MOST: usize = 32;

    fn as_slice(&self) -> &[Slot] {
        &self.slots[..self.n]
    }
}

/// The free ones of slots that follow each other.
#[derive(Debug)]
pub(super) struct FreeRange<'c> {
    /// The first slot.
    first: usize,
    /// The upper ones are empty where there are other ranges beside this one.
    levels: [&'c mut [u64]; LEVELS],
    /// Further ones, from slot 0 on.
    head: &'c mut [u64],
    n: &'c mut usize,
    /// If these are all slots, and whether those in hand are taken even if they are not near.
    in_hand: Option<(&'c mut InHand, bool)>,
}

/// The set bit of a word that is nearest to this one; there is one.
#[inline(always)]
fn bit_near(word: u64, at: usize) -> usize {
    // Beyond the ends if there is none.
    let after = at + (word >> at).trailing_zeros() as usize;
    let before = at.wrapping_sub((word << (WORD - 1 - at)).leading_zeros() as usize);
    if after < WORD && (before >= WORD || after - at <= at - before) { after } else { before }
}

/// The position of a set bit in the word of a position, or in the nearest one that has any.
fn near_in(words: &[u64], at: usize) -> Option<usize> {
    let own = at / WORD;
    let mut outwards = (0..words.len()).flat_map(|d| [own + d, own.wrapping_sub(d)]);
    let word = outwards.find(|&word| words.get(word).is_some_and(|&bits| bits != 0))?;
    let from = match word.cmp(&own) {
        Ordering::Less => WORD - 1,
        Ordering::Equal => at % WORD,
        Ordering::Greater => 0,
    };
    Some(word * WORD + bit_near(words[word], from))
}

impl FreeSlots {
    /// Has bits for this number of slots.
    pub(super) fn cover(&mut self, n_slots: usize) -> Result<()> {
        let mut n = n_slots;
        for level in &mut self.levels {
            n = n.div_ceil(WORD);
            if level.len() < n {
                memory::lengthen(level, n, 0)?;
            }
        }
        Ok(())
    }

    /// Their number.
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.n
    }

    /// All of them.
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
        if self.in_hand.n == InHand::MOST {
            self.whole().lay_half_down();
        }
        self.n += 1;
        self.in_hand.slots[self.in_hand.n % InHand::MOST] = slot;
        self.in_hand.n += 1;
    }

    /// Takes out a free slot, if there is any: near this one, or from the hand.
    #[inline(always)]
    pub(super) fn take_near(&mut self, near: Slot) -> Option<Slot> {
        if self.n == 0 {
            return None;
        }
        if !self.is_local
            && let Some(&last) = self.in_hand.as_slice().last()
        {
            self.n -= 1;
            self.in_hand.n -= 1;
            return Some(last);
        }
        self.look_near(near)
    }

    #[inline(never)]
    fn look_near(&mut self, near: Slot) -> Option<Slot> {
        self.whole().take_near(near)
    }

    #[inline(always)]
    pub(super) fn whole(&mut self) -> FreeRange<'_> {
        let levels = self.levels.each_mut().map(|level| &mut level[..]);
        let in_hand = Some((&mut self.in_hand, !self.is_local));
        FreeRange { first: 0, levels, head: &mut [], n: &mut self.n, in_hand }
    }

    /// Enters whether a slot is free.
    #[inline(always)]
    pub(super) fn set(&mut self, slot: Slot, is_free: bool) {
        if self.in_hand.n > 0 {
            self.lay_down();
        }
        let mut all = self.whole();
        match (all.has(slot), is_free) {
            (false, true) => {
                *all.n += 1;
                all.put_bit(slot);
            }
            (true, false) => {
                *all.n -= 1;
                all.remove_bit(slot.index());
            }
            _ => {}
        }
    }

    /// Takes none in hand.
    fn lay_down(&mut self) {
        let InHand { slots, n } = std::mem::take(&mut self.in_hand);
        let mut all = self.whole();
        slots[..n].iter().for_each(|&slot| all.put_bit(slot));
    }

    pub(super) fn clear(&mut self) {
        self.levels.iter_mut().for_each(|level| level.fill(0));
        (self.n, self.in_hand.n, self.is_local) = (0, 0, false);
    }

    /// Puts free slots instead of those there are; they are everywhere, so that near ones are to be taken.
    pub(super) fn put_everywhere(&mut self, slots: impl Iterator<Item = Slot>) {
        self.clear();
        slots.for_each(|slot| self.set(slot, true));
        self.is_local = self.n > 0;
    }

    /// Takes out those of these slots that are free.
    pub(super) fn remove_all(&mut self, slots: impl Iterator<Item = Slot>) {
        slots.for_each(|slot| self.set(slot, false));
    }

    /// The ranges that begin at these slots, all of them multiples of [`WORD`], the last one with the slots before the first
    /// one as well; `numbers` is memory for how many are free in each. What has been put and taken there has to be
    /// [counted](Self::count) before anything else.
    pub(super) fn ranges<'c>(
        &'c mut self,
        starts: &'c [Slot],
        numbers: &'c mut [usize],
    ) -> impl Iterator<Item = FreeRange<'c>> {
        self.lay_down();
        let (head, mut rest) = self.levels[0].split_at_mut(starts[0].index() / WORD);
        let mut head = Some(head);
        starts.iter().zip(numbers).enumerate().map(move |(k, (start, n))| {
            let n_words = starts.get(k + 1).map_or(rest.len(), |end| (end.index() - start.index()) / WORD);
            let words = rest.split_off_mut(..n_words).expect("the slots of a range are covered");
            let is_last = k + 1 == starts.len();
            let head = if is_last { head.take().unwrap_or_default() } else { &mut [] };
            *n = words.iter().chain(&*head).map(|word| word.count_ones() as usize).sum();
            FreeRange { first: start.index(), levels: [words, &mut [], &mut []], head, n, in_hand: None }
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
        let (in_hand, n, is_local) = (self.in_hand.clone(), self.n, self.is_local);
        let mut copy = FreeSlots { in_hand, n, is_local, ..FreeSlots::default() };
        for (copied, level) in copy.levels.iter_mut().zip(&self.levels) {
            *copied = memory::copy_of(level)?;
        }
        Ok(copy)
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.levels.iter().map(memory::bytes_of).sum()
    }
}

impl FreeRange<'_> {
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        *self.n
    }

    #[inline(always)]
    fn has(&self, slot: Slot) -> bool {
        let (word, bit) = (slot.index() / WORD, slot.index() % WORD);
        let bits =
            if word < self.head.len() { self.head[word] } else { self.levels[0][word - self.first / WORD] };
        bits >> bit & 1 == 1
    }

    /// Enters a free slot, which was not.
    #[inline(always)]
    pub(super) fn put(&mut self, slot: Slot) {
        *self.n += 1;
        if self.in_hand.is_none() {
            self.put_bit(slot);
        } else {
            self.put_in_hand(slot);
        }
    }

    #[inline(always)]
    fn put_in_hand(&mut self, slot: Slot) {
        if self.in_hand.as_ref().is_some_and(|(in_hand, _)| in_hand.n == InHand::MOST) {
            self.lay_half_down();
        }
        if let Some((in_hand, _)) = &mut self.in_hand {
            in_hand.slots[in_hand.n % InHand::MOST] = slot;
            in_hand.n += 1;
        }
    }

    /// Makes room in hand: those that have been there longest go.
    #[cold]
    #[inline(never)]
    fn lay_half_down(&mut self) {
        const HALF: usize = InHand::MOST / 2;
        let mut half = [Slot::NONE; HALF];
        if let Some((in_hand, _)) = &mut self.in_hand {
            half.copy_from_slice(&in_hand.slots[..HALF]);
            in_hand.slots.copy_within(HALF.., 0);
            in_hand.n -= HALF;
        }
        half.into_iter().for_each(|slot| self.put_bit(slot));
    }

    /// Enters a free slot that is not in hand.
    #[inline(always)]
    fn put_bit(&mut self, slot: Slot) {
        debug_assert!(!self.has(slot));
        if slot.index() < self.first {
            self.head[slot.index() / WORD] |= 1 << (slot.index() % WORD);
            return;
        }
        let mut at = slot.index() - self.first;
        for level in &mut self.levels {
            let Some(word) = level.get_mut(at / WORD) else { return };
            let before = *word;
            *word |= 1 << (at % WORD);
            if before != 0 {
                return;
            }
            at /= WORD;
        }
    }

    /// Takes out a free slot, if there is any in the range: near this one, or from the hand.
    #[inline(always)]
    pub(super) fn take_near(&mut self, near: Slot) -> Option<Slot> {
        *self.n = self.n.checked_sub(1)?;
        if let Some((in_hand, is_any_good)) = &mut self.in_hand
            && let Some(&last) = in_hand.as_slice().last()
            && (*is_any_good || last.index().abs_diff(near.index()) < NEAR)
        {
            in_hand.n -= 1;
            return Some(last);
        }
        if !self.head.is_empty() {
            return Some(self.take_near_from_both(near));
        }
        let at = near.index() - self.first;
        let word = self.levels[0][at / WORD];
        let found =
            if word != 0 { Some(at / WORD * WORD + bit_near(word, at % WORD)) } else { self.beyond(at) };
        if let Some(found) = found {
            self.remove_bit(found);
            return Some(Slot::at(self.first + found));
        }
        // Those in hand are not near, but there are no others.
        let (in_hand, _) = self.in_hand.as_mut()?;
        in_hand.n -= 1;
        Some(in_hand.slots[in_hand.n])
    }

    /// The same where there is a head, and a free slot.
    fn take_near_from_both(&mut self, near: Slot) -> Slot {
        let in_head = |at| near_in(self.head, at);
        let behind = |at| near_in(self.levels[0], at).map(|found| self.first + found);
        let found = if near.index() < self.first {
            in_head(near.index()).or_else(|| behind(0))
        } else {
            behind(near.index() - self.first).or_else(|| in_head(0))
        };
        let found = found.expect("one is free");
        if found < self.first {
            self.head[found / WORD] &= !(1 << (found % WORD));
        } else {
            self.remove_bit(found - self.first);
        }
        Slot::at(found)
    }

    /// Takes out the slot at a position, which is free and not in hand.
    #[inline(always)]
    fn remove_bit(&mut self, mut at: usize) {
        for level in &mut self.levels {
            let Some(word) = level.get_mut(at / WORD) else { return };
            *word &= !(1 << (at % WORD));
            if *word != 0 {
                return;
            }
            at /= WORD;
        }
    }

    /// The position of a free slot in the words near that of a position, which has none.
    #[inline(never)]
    fn beyond(&self, at: usize) -> Option<usize> {
        let n_levels = if self.levels[1].is_empty() { 1 } else { LEVELS };
        // Up to the level at which there is one in the same word, or at the top in another one, ...
        let (mut k, mut place) = (0, at);
        let mut found = loop {
            let words = &self.levels[k];
            let own = place / WORD;
            if words[own] != 0 {
                break own * WORD + bit_near(words[own], place % WORD);
            }
            if k + 1 == n_levels {
                break near_in(words, place)?;
            }
            (k, place) = (k + 1, own);
        };
        // ... and down again, on the side of the position.
        while k > 0 {
            let word = self.levels[k - 1][found];
            let is_after = found > at >> (k as u32 * WORD.ilog2());
            found = found * WORD + bit_near(word, if is_after { 0 } else { WORD - 1 });
            k -= 1;
        }
        Some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Rng;
    use std::collections::BTreeSet;

    fn slots(free: &FreeSlots) -> BTreeSet<usize> {
        free.iter().map(Slot::index).collect()
    }

    #[test]
    fn slots_are_taken_near() {
        let rng = &mut Rng::new(1);
        for n_slots in [1, 64, 65, 5000, 300_000, 900_000] {
            let mut free = FreeSlots::default();
            free.cover(n_slots).expect("room");
            free.is_local = true;
            let mut expected = BTreeSet::new();
            for round in 0..3000 {
                let slot = rng.below(n_slots);
                // Many at first, then fewer and fewer, and none.
                if round < 1000 || round % 4 == 0 && round < 2000 {
                    free.set(Slot::at(slot), true);
                    expected.insert(slot);
                    continue;
                }
                let Some(taken) = free.take_near(Slot::at(slot)) else {
                    assert!(expected.is_empty());
                    continue;
                };
                let smallest = [1, 64, 4096, 64 * 4096, usize::MAX].into_iter().find(|&size| {
                    let first = slot / size * size;
                    expected.range(first..first.saturating_add(size)).next().is_some()
                });
                let size = smallest.expect("one is free");
                let is_near = taken.index().abs_diff(slot) < NEAR;
                assert!(is_near || taken.index() / size == slot / size, "{taken:?} {slot} {size}");
                assert!(expected.remove(&taken.index()));
                assert_eq!(free.len(), expected.len());
            }
            assert_eq!(slots(&free), expected);
            assert!(n_slots > 65 || free.len() == 0);
        }
    }

    /// The latest first, unless they are to be near.
    #[test]
    fn the_latest_are_taken_first() {
        let mut free = FreeSlots::default();
        free.cover(100_000).expect("room");
        let some = [7, 90_000, 50, 40_000].map(Slot::new);
        let take = |free: &mut FreeSlots, near| free.take_near(Slot::new(near)).map(Slot::get);
        for is_local in [false, true] {
            if is_local {
                free.put_everywhere([Slot::new(39_000)].into_iter());
                assert_eq!(take(&mut free, 1), Some(39_000));
            }
            some.iter().for_each(|&slot| free.put(slot));
            let taken = [9; 5].map(|near| take(&mut free, near));
            // No others are there.
            assert_eq!(taken, [Some(40_000), Some(50), Some(90_000), Some(7), None], "{is_local}");
            // The first half of them is not in hand any more.
            let more = (0..33).map(|k| Slot::new(1000 * k));
            more.clone().for_each(|slot| free.put(slot));
            assert_eq!((free.len(), free.iter().count()), (33, 33));
            assert_eq!(take(&mut free, 3001), Some(if is_local { 3000 } else { 32_000 }));
            more.for_each(|slot| free.set(slot, false));
            assert_eq!((free.len(), free.iter().count()), (0, 0));
        }
    }

    #[test]
    fn ranges_have_their_own_and_come_together() {
        let rng = &mut Rng::new(2);
        let n_slots = 40_000;
        let mut free = FreeSlots::default();
        free.cover(n_slots).expect("room");
        let mut expected = BTreeSet::new();
        for round in 0..20 {
            let starts = [round % 3 * 64, 128, 12_800, 39_936].map(Slot::at);
            for _ in 0..100 {
                let slot = rng.below(n_slots);
                free.set(Slot::at(slot), true);
                expected.insert(slot);
            }
            let mut numbers = [0; 4];
            for (k, mut range) in free.ranges(&starts, &mut numbers).enumerate() {
                let end = starts.get(k + 1).map_or(n_slots, |end| end.index());
                let head = if k == 3 { starts[0].index() } else { 0 };
                let own: Vec<usize> = (0..head).chain(starts[k].index()..end).collect();
                assert_eq!(range.len(), own.iter().filter(|slot| expected.contains(slot)).count());
                if own.is_empty() {
                    continue;
                }
                for _ in 0..50 {
                    let slot = own[rng.below(own.len())];
                    if rng.below(3) == 0 && !expected.contains(&slot) {
                        range.put(Slot::at(slot));
                        expected.insert(slot);
                    } else if let Some(taken) = range.take_near(Slot::at(slot)) {
                        assert!(own.contains(&taken.index()) && expected.remove(&taken.index()));
                    } else {
                        assert!(own.iter().all(|slot| !expected.contains(slot)));
                    }
                }
            }
            free.count();
            assert_eq!((slots(&free), free.len()), (expected.clone(), expected.len()));
            let mut again = FreeSlots::default();
            again.cover(n_slots).expect("room");
            expected.iter().for_each(|&slot| again.set(Slot::at(slot), true));
            assert_eq!(again.levels, free.levels);
        }
    }
}
