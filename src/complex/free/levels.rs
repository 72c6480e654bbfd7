//! Bits with two levels above them, and the search for a set bit near a position.

use std::cmp::Ordering;

pub(super) const LEVELS: usize = 3;
/// Bits of a word; ranges of slots begin at a multiple of it.
pub(in crate::complex) const WORD: usize = u64::BITS as usize;

/// Bits, and above them a bit for each word of the level below that is not 0. The upper levels may be empty: then no
/// bit is kept there, and more words have to be looked at.
#[derive(Debug)]
pub(super) struct Levels<'c>(pub(super) [&'c mut [u64]; LEVELS]);

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

impl Levels<'_> {
    #[inline(always)]
    pub(super) fn has(&self, at: usize) -> bool {
        self.0[0][at / WORD] >> (at % WORD) & 1 == 1
    }

    /// Sets a bit, which was not.
    #[inline(always)]
    pub(super) fn set(&mut self, mut at: usize) {
        debug_assert!(!self.has(at));
        for level in &mut self.0 {
            let Some(word) = level.get_mut(at / WORD) else { return };
            let before = *word;
            *word |= 1 << (at % WORD);
            if before != 0 {
                return;
            }
            at /= WORD;
        }
    }

    /// Takes back a bit, which was set.
    #[inline(always)]
    pub(super) fn unset(&mut self, mut at: usize) {
        debug_assert!(self.has(at));
        for level in &mut self.0 {
            let Some(word) = level.get_mut(at / WORD) else { return };
            *word &= !(1 << (at % WORD));
            if *word != 0 {
                return;
            }
            at /= WORD;
        }
    }

    /// The position of a set bit near this one, if there is any.
    #[inline(always)]
    pub(super) fn near(&self, at: usize) -> Option<usize> {
        match self.0[0].get(at / WORD) {
            Some(&word) if word != 0 => Some(at / WORD * WORD + bit_near(word, at % WORD)),
            _ => self.beyond(at),
        }
    }

    /// The position of a set bit near this one, if there is any, where the word of this one has none.
    #[inline(never)]
    fn beyond(&self, at: usize) -> Option<usize> {
        let n_levels = if self.0[1].is_empty() { 1 } else { LEVELS };
        // Up, to the level at which there is one in the same word, or at the top in another one.
        let (mut k, mut place) = (0, at);
        let mut found = loop {
            let words = &self.0[k];
            if k + 1 == n_levels {
                break near_in(words, place)?;
            }
            if words[place / WORD] != 0 {
                break place / WORD * WORD + bit_near(words[place / WORD], place % WORD);
            }
            (k, place) = (k + 1, place / WORD);
        };
        // Down again, in each word on the side of the position.
        while k > 0 {
            let word = self.0[k - 1][found];
            let is_after = found > at >> (k as u32 * WORD.ilog2());
            found = found * WORD + bit_near(word, if is_after { 0 } else { WORD - 1 });
            k -= 1;
        }
        Some(found)
    }
}
