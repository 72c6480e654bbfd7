//! Lanes of WebAssembly, in two vectors of two lanes each. They are there where the module is compiled for them: a
//! module is refused as a whole by what does not know its instructions, so nothing is detected.

use std::arch::wasm32::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

use super::{LANES, Lanes, Real, Simd};

/// The token of the vectors.
#[derive(Clone, Copy, Debug)]
pub struct Vectors(());

impl Vectors {
    /// The token, which always is there.
    #[inline(always)]
    pub fn new() -> Option<Self> {
        Some(Vectors(()))
    }
}

/// Two numbers at an address.
#[inline(always)]
fn two(x: &[f64; 2]) -> v128 {
    // SAFETY: there are 16 bytes, and any alignment will do.
    unsafe { v128_load(x.as_ptr().cast()) }
}

/// Writes two numbers.
#[inline(always)]
fn put(x: &mut [f64; 2], two: v128) {
    // SAFETY: there is room for 16 bytes, and any alignment will do.
    unsafe { v128_store(x.as_mut_ptr().cast(), two) };
}

impl Simd for Vectors {
    type Lanes = Four;

    #[inline(always)]
    fn run_with<A, B, C, R>(self, a: A, b: B, c: C, work: impl FnOnce(A, B, C) -> R) -> R {
        work(a, b, c)
    }

    #[inline(always)]
    fn splat(self, x: f64) -> Four {
        Four(f64x2_splat(x), f64x2_splat(x))
    }

    #[inline(always)]
    fn load(self, x: &[f64; LANES]) -> Four {
        let [low, high] = halves(x);
        Four(two(low), two(high))
    }

    #[inline(always)]
    fn two_pairs(self, low: &[f64; 2], high: &[f64; 2]) -> Four {
        Four(two(low), two(high))
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> Four {
        let (bits, none) = (i64x2_splat(i64::from(bits)), i64x2_splat(0));
        let are_set = |own| i64x2_ne(v128_and(bits, own), none);
        Four(are_set(i64x2(1, 2)), are_set(i64x2(4, 8)))
    }

    #[inline(always)]
    fn are_equal(self, x: &[u32; LANES], y: u32) -> Four {
        // SAFETY: there are 16 bytes, and any alignment will do.
        let are_equal = i32x4_eq(unsafe { v128_load(x.as_ptr().cast()) }, u32x4_splat(y));
        Four(i64x2_extend_low_i32x4(are_equal), i64x2_extend_high_i32x4(are_equal))
    }
}

#[inline(always)]
fn halves(x: &[f64; LANES]) -> [&[f64; 2]; 2] {
    let (pairs, _) = x.as_chunks();
    [&pairs[0], &pairs[1]]
}

/// Four numbers; or a mask, with all bits of a lane set or none.
#[derive(Clone, Copy)]
pub struct Four(v128, v128);

impl Lanes for Four {
    #[inline(always)]
    fn even_with_even(self, y: Four) -> Four {
        Four(i64x2_shuffle::<0, 2>(self.0, y.0), i64x2_shuffle::<0, 2>(self.1, y.1))
    }

    #[inline(always)]
    fn odd_with_odd(self, y: Four) -> Four {
        Four(i64x2_shuffle::<1, 3>(self.0, y.0), i64x2_shuffle::<1, 3>(self.1, y.1))
    }

    #[inline(always)]
    fn low_with_low(self, y: Four) -> Four {
        Four(self.0, y.0)
    }

    #[inline(always)]
    fn high_with_high(self, y: Four) -> Four {
        Four(self.1, y.1)
    }

    #[inline(always)]
    fn with_last_of(self, y: Four) -> Four {
        Four(self.0, i64x2_shuffle::<0, 3>(self.1, y.1))
    }

    #[inline(always)]
    fn rotated(self) -> Four {
        Four(i64x2_shuffle::<1, 2>(self.0, self.1), i64x2_shuffle::<1, 2>(self.1, self.0))
    }

    #[inline(always)]
    fn are_same(self, y: Four) -> Four {
        Four(i64x2_eq(self.0, y.0), i64x2_eq(self.1, y.1))
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(i64x2_bitmask(self.0)) | u32::from(i64x2_bitmask(self.1)) << 2
    }

    #[inline(always)]
    fn store(self) -> [f64; LANES] {
        let mut x = [0.0; LANES];
        self.store_to(&mut x);
        x
    }

    #[inline(always)]
    fn store_to(self, x: &mut [f64; LANES]) {
        let (pairs, _) = x.as_chunks_mut();
        put(&mut pairs[0], self.0);
        put(&mut pairs[1], self.1);
    }

    #[inline(always)]
    fn store_three_to(self, x: &mut [f64; 3]) {
        let [a, b, c] = x;
        *a = f64x2_extract_lane::<0>(self.0);
        *b = f64x2_extract_lane::<1>(self.0);
        *c = f64x2_extract_lane::<0>(self.1);
    }

    #[inline(always)]
    fn store_low_to(self, x: &mut [f64; 2]) {
        put(x, self.0);
    }

    #[inline(always)]
    fn store_high_to(self, x: &mut [f64; 2]) {
        put(x, self.1);
    }
}

impl Real for Four {
    type Mask = Four;

    #[inline(always)]
    fn splat(self, x: f64) -> Four {
        Vectors(()).splat(x)
    }

    #[inline(always)]
    fn sqrt(self) -> Four {
        Four(f64x2_sqrt(self.0), f64x2_sqrt(self.1))
    }

    #[inline(always)]
    fn abs(self) -> Four {
        Four(f64x2_abs(self.0), f64x2_abs(self.1))
    }

    #[inline(always)]
    fn is_less(self, y: Four) -> Four {
        Four(f64x2_lt(self.0, y.0), f64x2_lt(self.1, y.1))
    }

    #[inline(always)]
    fn select(mask: Four, yes: Four, no: Four) -> Four {
        Four(v128_bitselect(yes.0, no.0, mask.0), v128_bitselect(yes.1, no.1, mask.1))
    }

    // The second number of these instructions is the one that a comparison has to choose.

    #[inline(always)]
    fn min(self, y: Four) -> Four {
        Four(f64x2_pmin(y.0, self.0), f64x2_pmin(y.1, self.1))
    }

    #[inline(always)]
    fn max(self, y: Four) -> Four {
        Four(f64x2_pmax(y.0, self.0), f64x2_pmax(y.1, self.1))
    }
}

macro_rules! operators {
    ($($trait:ident $name:ident $instruction:ident),*) => {
        $(impl $trait for Four {
            type Output = Four;

            #[inline(always)]
            fn $name(self, y: Four) -> Four {
                Four($instruction(self.0, y.0), $instruction(self.1, y.1))
            }
        })*
    };
}
operators!(
    Add add f64x2_add, Sub sub f64x2_sub, Mul mul f64x2_mul, Div div f64x2_div,
    BitAnd bitand v128_and, BitOr bitor v128_or
);

impl Not for Four {
    type Output = Four;

    #[inline(always)]
    fn not(self) -> Four {
        Four(v128_not(self.0), v128_not(self.1))
    }
}
