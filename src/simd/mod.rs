//! Arithmetic on four numbers at a time. All intrinsics, all `target_feature` and all detection of the processor are
//! here.
//!
//! A [`Simd`] is a token, which makes [`Lanes`]. There is one of AVX2 (`Avx2`), which exists only where the processor has
//! that, since only its `new`, which detects it, makes one; so every operation on its lanes is safe. There is one of NEON
//! (`Neon`) on 64-bit ARM, whose processors all have that, and one of the vectors of WebAssembly (`Vectors`), where that
//! is compiled for them. And there is [`Scalar`], which always is there, with four numbers for lanes.
//!
//! Code that uses lanes is generic over the token, and called through [`in_lanes!`], which takes the best one and
//! compiles the code for it. It must be inlined for that: the closure and all functions of lanes that it calls are
//! `#[inline(always)]`. If one is not, results are the same, but every operation is a function call.
//!
//! **Same bits.** Every lane of every token has the bits of the operation on numbers: there are sums, differences,
//! products, quotients and roots, which IEEE 754 rounds in one way, and no fused ones, which processors may lack. So
//! which facets surely hold, what tolerances are, and all that is chosen by these, is the same on every processor. (Fused
//! products would spare a build in space 2 % of its instructions.) Code that takes another way without lanes, or that asks
//! which token there is, would break this.
//!
//! If the environment variable `DELDRIFT_SCALAR` is set, to any value, everything runs as on a processor without AVX2
//! or NEON, which tests use. The variable is read once.
//!
//! A token for other processors needs a file with [`Simd`] for the token and [`Lanes`] for its lanes, and an arm in
//! [`in_lanes!`]. The tests here compare it with numbers, bit by bit.
//!
//! Functions over [`Real`] compile to scalar code for `f64`, and to one instruction for four numbers for lanes.
//!
//! The crate `pulp` has such tokens, too. With those of its version 0.22, and its `vectorize`, a sweep takes 1.5 % more
//! instructions in the plane and 3.1 % more in space. With `run_with` as it is here a sweep takes as many as now, and
//! *tolerance* 0.3 to 0.5 % more; `avx2.rs` would have 18 lines less, and 3 blocks of `unsafe` for 13, at the price of
//! 13 crates.

#![allow(unsafe_code)]

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(all(target_arch = "aarch64", target_endian = "little"))]
mod neon;
#[cfg(any(target_arch = "x86_64", all(target_arch = "aarch64", target_endian = "little")))]
mod presence;
mod scalar;
#[cfg(test)]
mod tests;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod wasm;

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

#[cfg(target_arch = "x86_64")]
pub use avx2::Avx2;
#[cfg(all(target_arch = "aarch64", target_endian = "little"))]
pub use neon::Neon;
pub use scalar::Scalar;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub use wasm::Vectors;

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

/// A token: proof that there are lanes of some kind.
pub trait Simd: Copy {
    /// What it makes.
    type Lanes: Lanes;

    /// Calls `work` with these arguments, compiled for the processor.
    fn run_with<A, B, C, R>(self, a: A, b: B, c: C, work: impl FnOnce(A, B, C) -> R) -> R;
    /// One number in all lanes.
    fn splat(self, x: f64) -> Self::Lanes;
    /// One number for each lane.
    fn load(self, x: &[f64; LANES]) -> Self::Lanes;
    /// Two numbers, and two more behind them.
    fn two_pairs(self, low: &[f64; 2], high: &[f64; 2]) -> Self::Lanes;
    /// A mask of the lanes that have a bit in `bits`, which has no others.
    fn mask(self, bits: u32) -> Self::Lanes;
    /// A mask of the numbers that are equal to `y`.
    fn are_equal(self, x: &[u32; LANES], y: u32) -> Self::Lanes;

    /// Two numbers for each lane.
    #[inline(always)]
    fn pairs(self, [a, b, c, d]: [&[f64; 2]; LANES]) -> [Self::Lanes; 2] {
        let (ac, bd) = (self.two_pairs(a, c), self.two_pairs(b, d));
        [ac.even_with_even(bd), ac.odd_with_odd(bd)]
    }

    /// Two or three numbers for each lane.
    #[inline(always)]
    fn points<const D: usize>(self, points: [&[f64; D]; LANES]) -> [Self::Lanes; D] {
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
    fn fours(self, fours: [&[f64; 4]; LANES]) -> [Self::Lanes; 4] {
        let [a, b, c, d] = fours.map(|four| four.as_chunks::<2>().0);
        let [x, y] = self.pairs([&a[0], &b[0], &c[0], &d[0]]);
        let [z, w] = self.pairs([&a[1], &b[1], &c[1], &d[1]]);
        [x, y, z, w]
    }
}

/// Four numbers; or a mask, with all bits of a lane set or none.
pub trait Lanes:
    Real<Mask = Self> + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// Lane 0 of each, then lane 2 of each.
    fn even_with_even(self, y: Self) -> Self;
    /// Lane 1 of each, then lane 3 of each.
    fn odd_with_odd(self, y: Self) -> Self;
    /// Lanes 0 and 1 of each.
    fn low_with_low(self, y: Self) -> Self;
    /// Lanes 2 and 3 of each.
    fn high_with_high(self, y: Self) -> Self;
    /// The lanes of `self`, but the last one of `y`.
    fn with_last_of(self, y: Self) -> Self;
    /// Lanes 1, 2, 3 and 0.
    fn rotated(self) -> Self;
    /// A mask of the lanes that have the same bits.
    fn are_same(self, y: Self) -> Self;
    /// One bit for each lane of a mask.
    fn bits(self) -> u32;
    /// The number of each lane.
    fn store(self) -> [f64; LANES];
    /// Writes all numbers.
    fn store_to(self, x: &mut [f64; LANES]);
    /// Writes the first three numbers.
    fn store_three_to(self, x: &mut [f64; 3]);
    /// Writes the first two numbers.
    fn store_low_to(self, x: &mut [f64; 2]);
    /// Writes the last two numbers.
    fn store_high_to(self, x: &mut [f64; 2]);
}

/// Calls a closure of up to three arguments, with the best token that there is under this name, and compiles it for that.
///
/// If it captures more than two pointers, they are passed in memory: arguments are faster.
macro_rules! in_lanes {
    ($simd:ident => $work:expr) => {
        $crate::simd::in_lanes!($simd, (), (), () => |(), (), ()| $work)
    };
    ($simd:ident, $a:expr, $b:expr, $c:expr => |$x:pat_param, $y:pat_param, $z:pat_param| $work:expr) => {{
        macro_rules! run {
            ($token:expr) => {{
                let $simd = $token;
                $crate::simd::Simd::run_with(
                    $simd,
                    $a,
                    $b,
                    $c,
                    #[inline(always)]
                    |$x, $y, $z| $work,
                )
            }};
        }
        #[cfg(target_arch = "x86_64")]
        match $crate::simd::Avx2::new() {
            Some(avx2) => run!(avx2),
            None => run!($crate::simd::Scalar),
        }
        #[cfg(all(target_arch = "aarch64", target_endian = "little"))]
        match $crate::simd::Neon::new() {
            Some(neon) => run!(neon),
            None => run!($crate::simd::Scalar),
        }
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        match $crate::simd::Vectors::new() {
            Some(vectors) => run!(vectors),
            None => run!($crate::simd::Scalar),
        }
        #[cfg(not(any(
            target_arch = "x86_64",
            all(target_arch = "aarch64", target_endian = "little"),
            all(target_arch = "wasm32", target_feature = "simd128")
        )))]
        run!($crate::simd::Scalar)
    }};
}
pub(crate) use in_lanes;

/// The numbers of each lane, in lanes of their own: the reverse of [`Simd::fours`].
#[inline(always)]
pub fn rows<L: Lanes>([x, y, z, w]: [L; 4]) -> [L; LANES] {
    let [xy, zw] = [x.even_with_even(y), z.even_with_even(w)];
    let [xy_odd, zw_odd] = [x.odd_with_odd(y), z.odd_with_odd(w)];
    [xy.low_with_low(zw), xy_odd.low_with_low(zw_odd), xy.high_with_high(zw), xy_odd.high_with_high(zw_odd)]
}

/// Prefetches what is at an address, which need not be valid.
#[inline(always)]
pub fn prefetch_at<T>(address: *const T) {
    #[cfg(target_arch = "x86_64")]
    avx2::prefetch_at(address);
    #[cfg(all(target_arch = "aarch64", target_endian = "little"))]
    neon::prefetch_at(address);
    #[cfg(not(any(target_arch = "x86_64", all(target_arch = "aarch64", target_endian = "little"))))]
    let _ = address;
}
