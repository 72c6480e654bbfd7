//! Integers of fixed size on the stack, and the room that those of one determinant share.

#![allow(unsafe_code)]

use std::cell::{Cell, UnsafeCell};
use std::cmp::Ordering;
use std::mem::MaybeUninit;
use std::ops::{Add, Mul, Sub};

/// Limbs of all integers that a determinant takes, but for those of comparisons with a radius or a box.
///
/// A difference has 20 limbs, and a product as many as both factors; a sum takes one more than the longer term, which
/// stays zero (see the module's documentation), and so do numbers to be shifted. So a square is 3 · 40 + 2 · 41 in space and
/// 2 · 40 + 41 in the plane, as is a minor, and a volume three minors and 3 · 60 + 2 · 61. `incircle` has 8 coordinates and 6
/// differences of 21, three squares, three minors, three products of 80 and two sums of 81: 1,422. `insphere` has 15 and 12,
/// four terms of 100 and three sums of 101: 1,270. `orient3d` has 12 and 9, and a volume: 1,106. All others have fewer.
pub(super) const FEW_LIMBS: usize = 1424;

/// Limbs of a term of `insphere`: a square, a volume, and a product of 100: 967. One with a lift takes no square, and a
/// product of 104.
pub(super) const TERM_LIMBS: usize = 968;

/// Limbs of all integers that a determinant with weights takes, but for volumes.
///
/// A weight is as long as a square and a limb to be shifted, and so is a lift: 42 at most, or 44 as a sum. In space 15
/// coordinates and 12 differences of 21, five weights and four differences of these, four squares of 202 and four lifts, four terms
/// of 106 and three sums of 107: 2,684. In the plane there are fewer.
pub(super) const POWER_LIMBS: usize = 2688;

/// Limbs of all integers that any other comparison takes.
///
/// The most are those of comparing the radius of a sphere (`measures.rs`). 12 coordinates and 9 differences are 21 · 21; three
/// squares; nine minors; a volume of them, 3 · 60 + 2 · 61; a vector, three times 3 · 80 + 2 · 81; its square, 3 · 160 +
/// 2 · 161; that of the volume, 120; the given radius and its product with that, 53 + 173. These are 4,792.
pub(super) const LIMBS: usize = 4800;

/// Limbs of all integers that a sphere and a box take (`reach.rs`).
///
/// The vector of a sphere with its square as above, 4,446; twice the volume, 61; 6 coordinates and 6 differences, 12 · 21;
/// for each side of the box a product of 80 and a difference of 82; for each axis a square of 162 and a difference of at
/// most 165. These are 6,712.
pub(in crate::predicates) const MOST_LIMBS: usize = 6720;

/// Limbs of all integers that comparing the radius of a power sphere takes (`power_measures.rs`).
///
/// As for a sphere, with lifts of 44 in the place of squares: 12 coordinates and 9 differences, 21 · 21; three squares
/// of 202, four weights and three differences of 43, three lifts of 44; nine minors of 121; a volume, 484; a vector,
/// three times 3 · 84 + 2 · 85; its square, 3 · 170 + 2 · 171; that of the volume, 122; the weight, 44, the given
/// number, which may be as great as any, 53, and their sum, 54; its product with that, 176, and a difference of 177.
/// These are 5,573.
pub(in crate::predicates) const POWER_RADIUS_LIMBS: usize = 5576;

/// Limbs of all integers that the lifted cell of a reach takes (`reach/weighted.rs`).
///
/// As for a power sphere, with the sides of a box beside the corners: 18 coordinates and 15 differences, 33 · 21; five squares
/// of 202, six weights and five differences of 43, and five lifts of 44; nine minors of 121, a volume, 484, and a vector,
/// three times 3 · 84 + 2 · 85. These are 5,235.
pub(in crate::predicates) const POWER_REACH_LIMBS: usize = 5240;

/// Limbs of what is kept of that: the vector, the volume and the sides, 3 · 85 + 61 + 6 · 21.
pub(in crate::predicates) const POWER_CELL_LIMBS: usize = 442;

/// Limbs of what is made of that with the box.
///
/// Twice the volume, 62; two weights and their difference, 131; the square of the vector, 3 · 170 + 2 · 171, that of the volume,
/// 124, its product with a weight, 168, and a sum of 171; for each side of the box a product of 83 and a difference of 86;
/// for each axis a square of 172 and a difference of at most 175. These are 3,563.
pub(in crate::predicates) const POWER_BOX_LIMBS: usize = 3568;

/// Room for integers, which are given up together.
pub(in crate::predicates) struct LimbRoom<const N: usize = LIMBS> {
    limbs: UnsafeCell<[MaybeUninit<u64>; N]>,
    /// How many are in use: the first ones.
    n: Cell<usize>,
}

impl LimbRoom {
    #[inline(always)]
    pub(in crate::predicates) fn new() -> Self {
        Self::of_any_size()
    }
}

impl<const N: usize> LimbRoom<N> {
    #[inline(always)]
    pub(in crate::predicates) fn of_any_size() -> Self {
        LimbRoom { limbs: UnsafeCell::new([MaybeUninit::uninit(); N]), n: Cell::new(0) }
    }

    /// Takes `n` limbs, and sets them to zero.
    #[allow(clippy::mut_from_ref)] // Each call gives other limbs.
    pub(super) fn zeros(&self, n: usize) -> &mut [u64] {
        let first = self.n.get();
        assert!(n <= N - first, "room for a determinant");
        self.n.set(first + n);
        // SAFETY: there are so many, and nothing else has them, as the number of those in use never falls, and they are
        // written before they are handed out.
        unsafe {
            let first = self.limbs.get().cast::<u64>().add(first);
            first.write_bytes(0, n);
            std::slice::from_raw_parts_mut(first, n)
        }
    }
}

/// An integer: sign and magnitude.
#[derive(Clone, Copy)]
pub(in crate::predicates) struct Integer<'r, const N: usize = LIMBS> {
    pub(super) room: &'r LimbRoom<N>,
    /// False for zero.
    pub(super) is_negative: bool,
    /// The lowest limb first; the highest is not zero.
    pub(super) magnitude: &'r [u64],
}

impl<'r, const N: usize> Integer<'r, N> {
    pub(super) fn new(room: &'r LimbRoom<N>, is_negative: bool, limbs: &'r [u64]) -> Self {
        let n = limbs.iter().rposition(|&limb| limb != 0).map_or(0, |highest| highest + 1);
        Integer { room, is_negative: is_negative & (n > 0), magnitude: &limbs[..n] }
    }

    /// `x` · 2^`shift`.
    pub(in crate::predicates) fn shifted(room: &'r LimbRoom<N>, x: i64, shift: u32) -> Self {
        let at = (shift / 64) as usize;
        let limbs = room.zeros(at + 2);
        let magnitude = u128::from(x.unsigned_abs()) << (shift % 64);
        (limbs[at], limbs[at + 1]) = (magnitude as u64, (magnitude >> 64) as u64);
        Self::new(room, x < 0, limbs)
    }

    /// The integer itself, with another room for what is made of it.
    pub(in crate::predicates) fn within<'s, const M: usize>(self, room: &'s LimbRoom<M>) -> Integer<'s, M>
    where
        'r: 's,
    {
        Integer { room, is_negative: self.is_negative, magnitude: self.magnitude }
    }

    /// A copy in another room.
    pub(in crate::predicates) fn copied_to<'s, const M: usize>(
        self,
        room: &'s LimbRoom<M>,
    ) -> Integer<'s, M> {
        let limbs = room.zeros(self.magnitude.len());
        limbs.copy_from_slice(self.magnitude);
        Integer::new(room, self.is_negative, limbs)
    }

    /// How it compares with zero.
    pub(in crate::predicates) fn sign(&self) -> Ordering {
        if self.is_negative { Ordering::Less } else { self.magnitude.len().cmp(&0) }
    }

    pub(in crate::predicates) fn compare_magnitude(&self, other: &Self) -> Ordering {
        let lengths = self.magnitude.len().cmp(&other.magnitude.len());
        lengths.then_with(|| self.magnitude.iter().rev().cmp(other.magnitude.iter().rev()))
    }

    /// A number m of 64 bits, rounded, and an exponent e: m 2ᵉ is within 2⁻⁵² of it, relatively.
    pub(in crate::predicates) fn rounded(&self) -> (f64, i32) {
        let Some((&high, lower)) = self.magnitude.split_last() else { return (0.0, 0) };
        let next = lower.last().copied().unwrap_or(0);
        let shift = high.leading_zeros();
        let leading = (u128::from(high) << 64 | u128::from(next)) << shift >> 64;
        let m = leading as u64 as f64;
        (if self.is_negative { -m } else { m }, 64 * lower.len() as i32 - shift as i32)
    }

    /// Sum of magnitudes, the other one not longer, with the sign of this one.
    fn plus_magnitude(self, other: Self) -> Self {
        let n = self.magnitude.len();
        let sum = self.room.zeros(n + 1);
        let others = other.magnitude.iter().chain(std::iter::repeat(&0));
        let mut carry = false;
        for ((sum, &x), &y) in sum.iter_mut().zip(self.magnitude).zip(others) {
            let (partial, first) = x.overflowing_add(y);
            let (whole, second) = partial.overflowing_add(u64::from(carry));
            (*sum, carry) = (whole, first | second);
        }
        sum[n] = u64::from(carry);
        Self::new(self.room, self.is_negative, sum)
    }

    /// Difference of magnitudes, the other one not greater, with the sign of this one.
    fn minus_magnitude(self, other: Self) -> Self {
        let difference = self.room.zeros(self.magnitude.len());
        let others = other.magnitude.iter().chain(std::iter::repeat(&0));
        let mut borrow = false;
        for ((difference, &x), &y) in difference.iter_mut().zip(self.magnitude).zip(others) {
            let (partial, first) = x.overflowing_sub(y);
            let (whole, second) = partial.overflowing_sub(u64::from(borrow));
            (*difference, borrow) = (whole, first | second);
        }
        debug_assert!(!borrow);
        Self::new(self.room, self.is_negative, difference)
    }
}

impl<const N: usize> PartialEq for Integer<'_, N> {
    fn eq(&self, other: &Self) -> bool {
        self.is_negative == other.is_negative && self.magnitude == other.magnitude
    }
}

impl<const N: usize> Add for Integer<'_, N> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (greater, less) = match self.compare_magnitude(&other) {
            Ordering::Less => (other, self),
            _ => (self, other),
        };
        if less.magnitude.is_empty() {
            greater
        } else if greater.is_negative == less.is_negative {
            greater.plus_magnitude(less)
        } else {
            greater.minus_magnitude(less)
        }
    }
}

impl<const N: usize> Sub for Integer<'_, N> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + Integer { is_negative: !other.is_negative & !other.magnitude.is_empty(), ..other }
    }
}

impl<const N: usize> Mul for Integer<'_, N> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = self.room.zeros(self.magnitude.len() + other.magnitude.len());
        // Coordinates have few limbs that are not zero.
        let skipped = other.magnitude.iter().take_while(|&&y| y == 0).count();
        let others = &other.magnitude[skipped..];
        for (k, &x) in self.magnitude.iter().enumerate().filter(|&(_, &x)| x != 0) {
            let mut carry = 0;
            let (row, rest) = product[k + skipped..].split_at_mut(others.len());
            for (sum, &y) in row.iter_mut().zip(others) {
                // (2⁶⁴ - 1)² + 2 (2⁶⁴ - 1) is 2¹²⁸ - 1.
                let whole = u128::from(x) * u128::from(y) + u128::from(*sum) + u128::from(carry);
                (*sum, carry) = (whole as u64, (whole >> 64) as u64);
            }
            if let Some(next) = rest.first_mut() {
                *next = carry;
            }
        }
        Self::new(self.room, self.is_negative != other.is_negative, product)
    }
}
