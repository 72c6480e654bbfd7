//! Arrays with one entry per corner of a cell.

use std::fmt::Debug;
use std::hash::Hash;
use std::ops::{Index, IndexMut};

use crate::ids::SiteId;

/// What such an array holds.
pub trait CornerEntry: Copy + Debug + Eq + Hash + Ord + Send + Sync + 'static {}

impl<T: Copy + Debug + Eq + Hash + Ord + Send + Sync + 'static> CornerEntry for T {}

/// An array of `D + 1` entries: the corners of a cell, or what lies opposite each of them.
pub trait Corners<T: CornerEntry = SiteId>:
    CornerEntry + Index<usize, Output = T> + IndexMut<usize> + AsRef<[T]> + AsMut<[T]>
{
    /// `D + 1`.
    const N: usize;
    /// What makes a cell start where it does not straddle cache lines.
    type Alignment: Copy + Debug + Send + Sync;
    /// The array of as many other entries.
    type Of<U: CornerEntry>: Corners<U>;

    /// The array with `x` everywhere.
    fn filled(x: T) -> Self;

    /// The array with `x` at index `i`.
    #[inline(always)]
    fn with(mut self, i: usize, x: T) -> Self {
        self[i] = x;
        self
    }

    /// The corners of the reflected cell: of the opposite orientation, entry `keep` where it was.
    fn reflected(self, keep: usize) -> Self;

    /// The corners in an order of the same orientation that has entry `i` last.
    fn rotated_to_last(self, i: usize) -> Self;
}

/// Alignment of a 3D cell: its own 32 bytes.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct Align32;

impl<T: CornerEntry> Corners<T> for [T; 3] {
    const N: usize = 3;
    type Alignment = u32;
    type Of<U: CornerEntry> = [U; 3];

    #[inline(always)]
    fn filled(x: T) -> Self {
        [x; 3]
    }

    fn reflected(mut self, keep: usize) -> Self {
        self.swap((keep + 1) % 3, (keep + 2) % 3);
        self
    }

    fn rotated_to_last(self, i: usize) -> Self {
        [self[(i + 1) % 3], self[(i + 2) % 3], self[i]]
    }
}

impl<T: CornerEntry> Corners<T> for [T; 4] {
    const N: usize = 4;
    type Alignment = Align32;
    type Of<U: CornerEntry> = [U; 4];

    #[inline(always)]
    fn filled(x: T) -> Self {
        [x; 4]
    }

    fn reflected(mut self, keep: usize) -> Self {
        self.swap((keep + 1) % 4, (keep + 2) % 4);
        self
    }

    fn rotated_to_last(mut self, i: usize) -> Self {
        if i != 3 {
            self.swap(i, 3);
            self.swap((i + 1) % 3, (i + 2) % 3);
        }
        self
    }
}
