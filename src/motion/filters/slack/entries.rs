//! What is kept for each corner of a cell: its deadline, and the slack of the facet opposite it.

#![allow(unsafe_code)]

use crate::complex::{Cell, Corners};

/// Cells looked at in one go.
pub(super) const BLOCK: usize = 64;

/// The deadline of a corner.
pub(super) fn deadline(entry: u32) -> u16 {
    entry as u16
}

/// The slack of the facet opposite it.
pub(super) fn slack(entry: u32) -> i16 {
    (entry >> 16) as i16
}

/// Both in one number.
pub(super) fn entry(deadline: u16, slack: i16) -> u32 {
    u32::from(deadline) | u32::from(slack as u16) << 16
}

/// The least slack of a cell.
#[inline(always)]
pub(super) fn least<C: Corners<u32>>(entries: &C) -> i16 {
    let mut least = slack(entries[0]);
    for i in 1..C::N {
        least = least.min(slack(entries[i]));
    }
    least
}

/// Lists those of at most [`BLOCK`] cells of which a corner has passed its deadline, by a loop without branches: they
/// cannot be predicted. The corners must be indices of odometers.
#[inline(never)]
pub(super) fn list_expired_of<'l, C: Corners>(
    cells: &[Cell<C>],
    entries: &[C::Of<u32>],
    travelled: &[u16],
    listed: &'l mut [u32; BLOCK],
) -> &'l [u32] {
    let mut n = 0;
    for (k, (cell, entries)) in cells.iter().zip(entries).enumerate() {
        if cell.is_free() {
            continue;
        }
        let mut differences = 0;
        for i in 0..C::N {
            // SAFETY: the caller's promise; a free cell, which has no corners, is not here.
            let travelled = unsafe { *travelled.get_unchecked(cell.corners[i].index()) };
            differences |= entries[i].wrapping_sub(u32::from(travelled));
        }
        listed[n % BLOCK] = k as u32;
        n += (differences >> 15 & 1) as usize;
    }
    &listed[..n]
}
