//! Lanes of numbers, one after the other, for processors without AVX2: by the same operations, so to the same bits.
//!
//! Compilers make instructions of these for two lanes at a time, on x86-64 and arm64.

use std::array::from_fn;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

use super::{LANES, Lanes, Real, Simd};

/// The token that there always is.
#[derive(Clone, Copy, Debug)]
pub struct Scalar;

/// Four numbers; or a mask, with all bits of a lane set or none.
#[derive(Clone, Copy)]
pub struct FourNumbers([f64; LANES]);

impl FourNumbers {
    #[inline(always)]
    fn each(self, f: impl Fn(f64) -> f64) -> FourNumbers {
        FourNumbers(from_fn(
            #[inline(always)]
            |k| f(self.0[k]),
        ))
    }

    #[inline(always)]
    fn with(self, other: FourNumbers, f: impl Fn(f64, f64) -> f64) -> FourNumbers {
        FourNumbers(from_fn(
            #[inline(always)]
            |k| f(self.0[k], other.0[k]),
        ))
    }

    /// A mask of lanes.
    #[inline(always)]
    fn mask_of(is_set: impl Fn(usize) -> bool) -> FourNumbers {
        FourNumbers(from_fn(
            #[inline(always)]
            |k| f64::from_bits(0u64.wrapping_sub(u64::from(is_set(k)))),
        ))
    }

    /// By the bits of both.
    #[inline(always)]
    fn with_bits(self, other: FourNumbers, f: impl Fn(u64, u64) -> u64) -> FourNumbers {
        self.with(
            other,
            #[inline(always)]
            |x, y| f64::from_bits(f(x.to_bits(), y.to_bits())),
        )
    }
}

impl Simd for Scalar {
    type Lanes = FourNumbers;

    #[inline(always)]
    fn run_with<A, B, C, R>(self, a: A, b: B, c: C, work: impl FnOnce(A, B, C) -> R) -> R {
        work(a, b, c)
    }

    #[inline(always)]
    fn splat(self, x: f64) -> FourNumbers {
        FourNumbers([x; LANES])
    }

    #[inline(always)]
    fn load(self, x: &[f64; LANES]) -> FourNumbers {
        FourNumbers(*x)
    }

    #[inline(always)]
    fn two_pairs(self, low: &[f64; 2], high: &[f64; 2]) -> FourNumbers {
        FourNumbers([low[0], low[1], high[0], high[1]])
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> FourNumbers {
        FourNumbers::mask_of(
            #[inline(always)]
            |k| bits >> k & 1 == 1,
        )
    }

    #[inline(always)]
    fn are_equal(self, x: &[u32; LANES], y: u32) -> FourNumbers {
        FourNumbers::mask_of(
            #[inline(always)]
            |k| x[k] == y,
        )
    }
}

impl Lanes for FourNumbers {
    #[inline(always)]
    fn even_with_even(self, y: FourNumbers) -> FourNumbers {
        FourNumbers([self.0[0], y.0[0], self.0[2], y.0[2]])
    }

    #[inline(always)]
    fn odd_with_odd(self, y: FourNumbers) -> FourNumbers {
        FourNumbers([self.0[1], y.0[1], self.0[3], y.0[3]])
    }

    #[inline(always)]
    fn low_with_low(self, y: FourNumbers) -> FourNumbers {
        FourNumbers([self.0[0], self.0[1], y.0[0], y.0[1]])
    }

    #[inline(always)]
    fn high_with_high(self, y: FourNumbers) -> FourNumbers {
        FourNumbers([self.0[2], self.0[3], y.0[2], y.0[3]])
    }

    #[inline(always)]
    fn with_last_of(self, y: FourNumbers) -> FourNumbers {
        FourNumbers([self.0[0], self.0[1], self.0[2], y.0[3]])
    }

    #[inline(always)]
    fn rotated(self) -> FourNumbers {
        FourNumbers([self.0[1], self.0[2], self.0[3], self.0[0]])
    }

    #[inline(always)]
    fn are_same(self, y: FourNumbers) -> FourNumbers {
        FourNumbers::mask_of(
            #[inline(always)]
            |k| self.0[k].to_bits() == y.0[k].to_bits(),
        )
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        (0..LANES).fold(
            0,
            #[inline(always)]
            |bits, k| bits | ((self.0[k].to_bits() >> 63) as u32) << k,
        )
    }

    #[inline(always)]
    fn store(self) -> [f64; LANES] {
        self.0
    }

    #[inline(always)]
    fn store_to(self, x: &mut [f64; LANES]) {
        *x = self.0;
    }

    #[inline(always)]
    fn store_three_to(self, x: &mut [f64; 3]) {
        *x = [self.0[0], self.0[1], self.0[2]];
    }

    #[inline(always)]
    fn store_low_to(self, x: &mut [f64; 2]) {
        *x = [self.0[0], self.0[1]];
    }

    #[inline(always)]
    fn store_high_to(self, x: &mut [f64; 2]) {
        *x = [self.0[2], self.0[3]];
    }
}

impl Real for FourNumbers {
    type Mask = FourNumbers;

    #[inline(always)]
    fn splat(self, x: f64) -> FourNumbers {
        FourNumbers([x; LANES])
    }

    #[inline(always)]
    fn sqrt(self) -> FourNumbers {
        self.each(f64::sqrt)
    }

    #[inline(always)]
    fn abs(self) -> FourNumbers {
        self.each(f64::abs)
    }

    #[inline(always)]
    fn is_less(self, other: FourNumbers) -> FourNumbers {
        FourNumbers::mask_of(
            #[inline(always)]
            |k| self.0[k] < other.0[k],
        )
    }

    #[inline(always)]
    fn select(mask: FourNumbers, yes: FourNumbers, no: FourNumbers) -> FourNumbers {
        (mask & yes) | (!mask & no)
    }

    #[inline(always)]
    fn min(self, other: FourNumbers) -> FourNumbers {
        self.with(other, Real::min)
    }

    #[inline(always)]
    fn max(self, other: FourNumbers) -> FourNumbers {
        self.with(other, Real::max)
    }
}

macro_rules! operators {
    ($($trait:ident $name:ident $apply:ident $operator:tt),*) => {
        $(impl $trait for FourNumbers {
            type Output = FourNumbers;

            #[inline(always)]
            fn $name(self, y: FourNumbers) -> FourNumbers {
                self.$apply(
                    y,
                    #[inline(always)]
                    |x, y| x $operator y,
                )
            }
        })*
    };
}
operators!(
    Add add with +, Sub sub with -, Mul mul with *, Div div with /,
    BitAnd bitand with_bits &, BitOr bitor with_bits |
);

impl Not for FourNumbers {
    type Output = FourNumbers;

    #[inline(always)]
    fn not(self) -> FourNumbers {
        self.each(
            #[inline(always)]
            |x| f64::from_bits(!x.to_bits()),
        )
    }
}
