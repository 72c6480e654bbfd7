//! Arithmetic on four numbers at a time. All intrinsics, all `target_feature` and all detection of the processor are
//! here.
//!
//! An [`Avx2`] is a token: it exists only if the processor has AVX2 and FMA, since only [`Avx2::new`], which detects
//! them, makes one. [`Lanes`] are made by a token or from other lanes, so every operation on them is safe.
//!
//! Code that uses lanes is called through [`Avx2::run`] or [`Avx2::run_with`], which compile it for AVX2 and FMA. It
//! must be inlined for that: the closure and all functions of lanes that it calls are `#[inline(always)]`. If one is
//! not, results are the same, but every operation is a function call.
//!
//! If the environment variable `DELDRIFT_SCALAR` is set, to any value, there is no token, and everything runs as on a
//! processor without AVX2. This is for tests. The variable is read once.
//!
//! Functions over [`Real`] compile to scalar code for `f64`, and to one instruction for four numbers for [`Lanes`].
//! Rust contracts no operations, so each lane has the same bits as the scalar result, except after
//! [`times_plus`](Real::times_plus) and [`minus_product`](Real::minus_product): they round once in lanes, where they
//! take no longer than a product, and twice in `f64`.
//!
//! The crate `pulp` has such tokens, too. With those of its version 0.22, and its `vectorize`, a sweep takes 1.5 % more
//! instructions in the plane and 3.1 % more in space. With `run_with` as it is here a sweep takes as many as now, and
//! *tolerance* 0.3 to 0.5 % more; `avx2.rs` would have 18 lines less, and 3 blocks of `unsafe` for 13, at the price of
//! 13 crates. `absent.rs` would stay, since the tokens are of one processor there, too.

#![allow(unsafe_code)]

#[cfg(not(target_arch = "x86_64"))]
mod absent;
#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(test)]
mod tests;

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

#[cfg(not(target_arch = "x86_64"))]
pub use absent::{Avx2, Lanes};
#[cfg(target_arch = "x86_64")]
pub use avx2::{Avx2, Lanes};

/// Number of lanes.
pub const LANES: usize = 4;

/// A bit for each lane.
pub const ALL: u32 = (1 << LANES) - 1;

/// Numbers with the precision of `f64`.
pub trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// The result of a comparison.
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask> + Not<Output = Self::Mask>;
    /// `x` in all lanes. `self` only proves that there may be lanes: its value is not used.
    fn splat(self, x: f64) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Magnitude.
    fn abs(self) -> Self;
    /// Where a number is less than the other.
    fn is_less(self, other: Self) -> Self::Mask;
    /// `yes` where the mask is set, `no` absent.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// `self` · `factor` + `term`, rounded once or twice.
    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    /// `self` − `x` · `y`, rounded once or twice.
    #[inline(always)]
    fn minus_product(self, x: Self, y: Self) -> Self {
        self - x * y
    }

    // One instruction each, unlike those of `f64`, which treat NaN in another way.

    /// The lesser one.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(self.is_less(other), self, other)
    }

    /// The greater one.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(other.is_less(self), self, other)
    }
}

impl Real for f64 {
    type Mask = bool;

    #[inline(always)]
    fn splat(self, x: f64) -> f64 {
        x
    }

    #[inline(always)]
    fn sqrt(self) -> f64 {
        self.sqrt()
    }

    #[inline(always)]
    fn abs(self) -> f64 {
        self.abs()
    }

    #[inline(always)]
    fn is_less(self, other: f64) -> bool {
        self < other
    }

    #[inline(always)]
    fn select(mask: bool, yes: f64, no: f64) -> f64 {
        if mask { yes } else { no }
    }
}

impl Avx2 {
    /// Calls `work`, compiled for AVX2 and FMA.
    ///
    /// If it captures more than two pointers, they are passed in memory: then [`run_with`](Self::run_with) is faster.
    #[inline(always)]
    pub fn run<R>(self, work: impl FnOnce() -> R) -> R {
        self.run_with(
            work,
            (),
            (),
            #[inline(always)]
            |work, (), ()| work(),
        )
    }

    /// Two or three numbers for each lane.
    #[inline(always)]
    pub fn points<const D: usize>(self, points: [&[f64; D]; LANES]) -> [Lanes; D] {
        const { assert!(D == 2 || D == 3) };
        let mut lanes = [self.splat(0.0); D];
        [lanes[0], lanes[1]] = self.pairs(points.map(|p| p.first_chunk().expect("two or three")));
        if D == 3 {
            [_, lanes[2]] = self.pairs(points.map(|p| p.last_chunk().expect("two or three")));
        }
        lanes
    }

    /// Four numbers for each lane.
    #[inline(always)]
    pub fn fours(self, fours: [&[f64; 4]; LANES]) -> [Lanes; 4] {
        let [a, b, c, d] = fours.map(|four| four.as_chunks::<2>().0);
        let [x, y] = self.pairs([&a[0], &b[0], &c[0], &d[0]]);
        let [z, w] = self.pairs([&a[1], &b[1], &c[1], &d[1]]);
        [x, y, z, w]
    }
}

/// The numbers of each lane, in lanes of their own: the reverse of [`Avx2::fours`].
#[inline(always)]
pub fn rows([x, y, z, w]: [Lanes; 4]) -> [Lanes; LANES] {
    let [xy, zw] = [x.even_with_even(y), z.even_with_even(w)];
    let [xy_odd, zw_odd] = [x.odd_with_odd(y), z.odd_with_odd(w)];
    [xy.low_with_low(zw), xy_odd.low_with_low(zw_odd), xy.high_with_high(zw), xy_odd.high_with_high(zw_odd)]
}

/// Prefetches what is at an address, which need not be valid.
#[inline(always)]
pub fn prefetch_at<T>(address: *const T) {
    #[cfg(target_arch = "x86_64")]
    avx2::prefetch_at(address);
    #[cfg(not(target_arch = "x86_64"))]
    let _ = address;
}
