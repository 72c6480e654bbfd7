//! The order of a cell's corners in its row, compared with the order in its slot.

use crate::complex::{CornerEntry, Corners};

/// For each corner of the slot its place in the row, two bits each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) struct Ordering(u8);

impl Ordering {
    /// The row lists them as the slot does.
    pub(in crate::motion) const SAME: Self = Ordering(0b11_10_01_00);

    /// The order of a row's corners, given these as they are in the slot and in the row.
    pub(in crate::motion) fn of<T: CornerEntry, C: Corners<T>>(slot: &C, row: &C) -> Self {
        if slot == row {
            return Self::SAME;
        }
        let mut places = Self::SAME.0;
        for i in 0..C::N {
            let place = (0..C::N).find(|&j| row[j] == slot[i]).expect("the same corners") as u8;
            places = places & !(3 << (2 * i)) | place << (2 * i);
        }
        Ordering(places)
    }

    /// The place, in the row, of a corner of the slot.
    #[inline(always)]
    pub(in crate::motion) fn place(self, corner: usize) -> usize {
        usize::from(self.0 >> (2 * corner) & 3)
    }

    /// The corners of a slot in the order of the row.
    #[inline(always)]
    pub(in crate::motion) fn in_row<T: CornerEntry, C: Corners<T>>(self, slot: C) -> C {
        let mut row = slot;
        if self != Self::SAME {
            (0..C::N).for_each(|i| row[self.place(i)] = slot[i]);
        }
        row
    }

    /// Whether the orientation of the row is opposite to that of the slot.
    pub(in crate::motion) fn is_odd(self) -> bool {
        let is_inversion = |&(i, j): &(usize, usize)| self.place(i) > self.place(j);
        (0..4).flat_map(|j| (0..j).map(move |i| (i, j))).filter(is_inversion).count() % 2 == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_orders_of_four_are_told_apart() {
        let slot = [7, 1, 9, 4];
        let mut n_odd = 0;
        let mut seen = Vec::new();
        for [a, b, c, d] in (0..256).map(|k| [k & 3, k >> 2 & 3, k >> 4 & 3, k >> 6]) {
            if [a, b, c, d].iter().fold(0, |bits, k| bits | 1 << k) != 15 {
                continue;
            }
            let row = [slot[a], slot[b], slot[c], slot[d]];
            let ordering = Ordering::of(&slot, &row);
            assert!((0..4).all(|i| row[ordering.place(i)] == slot[i]));
            assert!(!seen.contains(&ordering.0));
            seen.push(ordering.0);
            n_odd += u32::from(ordering.is_odd());
        }
        assert_eq!((seen.len(), n_odd), (24, 12));
        assert!(!Ordering::of(&[3, 5, 8], &[5, 8, 3]).is_odd());
        assert!(Ordering::of(&[3, 5, 8], &[5, 3, 8]).is_odd());
    }
}
