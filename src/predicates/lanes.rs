//! Arithmetic on one number or on four at a time.
//!
//! What is written over [`Real`] compiles to scalar code for `f64`, and to one instruction for four numbers
//! in functions that may use AVX2 and FMA. Rust contracts no operations, so each of the four is bit for
//! bit what `f64` gives, but for [`times_plus`](Real::times_plus) and
//! [`minus_product`](Real::minus_product): they round once in lanes, which takes no longer than a product
//! alone, and twice in `f64`.

#![allow(unsafe_code)]

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

/// Numbers with the precision of `f64`.
pub trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Answers to a comparison.
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask> + Not<Output = Self::Mask>;
    /// The same number in all lanes.
    fn splat(x: f64) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Magnitude.
    fn abs(self) -> Self;
    /// Where a number is less than the other.
    fn is_less(self, other: Self) -> Self::Mask;
    /// `yes` where the mask is set, `no` elsewhere.
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

    // One instruction each, unlike those of `f64` with their regard for NaN.

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
    fn splat(x: f64) -> f64 {
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

/// Bi-cells treated at a time.
pub const LANES: usize = 4;

/// A number for each lane, as in memory.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(32))]
struct Stored([f64; LANES]);

/// The points of as many bi-cells as there are lanes.
#[derive(Clone, Copy, Debug)]
pub struct BiCells<const D: usize, const P: usize>([[Stored; D]; P]);

impl<const D: usize, const P: usize> Default for BiCells<D, P> {
    fn default() -> Self {
        BiCells([[Stored::default(); D]; P])
    }
}

impl<const D: usize, const P: usize> BiCells<D, P> {
    /// Sets the bi-cell of a lane, below [`LANES`]: the vertices of the facet, then the opposing ones.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, points: [&[f64; D]; P]) {
        for (stored, p) in self.0.iter_mut().zip(points) {
            for (stored, &x) in stored.iter_mut().zip(p) {
                stored.0[lane] = x;
            }
        }
    }

    /// The bi-cell of a lane.
    pub(super) fn lane(&self, lane: usize) -> [[f64; D]; P] {
        self.0.map(|p| p.map(|stored| stored.0[lane]))
    }
}

/// Four numbers at a time, by AVX2 and FMA.
#[cfg(target_arch = "x86_64")]
pub(crate) mod avx2 {
    use super::{BiCells, LANES, Real, Stored};
    use std::arch::x86_64::*;
    use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

    /// Whether the processor has both. Nothing else of this module may be used if it has not.
    #[inline(always)]
    pub(crate) fn is_there() -> bool {
        is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")
    }

    /// Four numbers, or, as a mask, all bits set or none in each.
    #[derive(Clone, Copy)]
    pub(crate) struct Lanes(__m256d);

    impl Lanes {
        #[inline(always)]
        pub(crate) fn load(x: &[f64; LANES]) -> Self {
            // SAFETY: AVX2 is there; the address is that of four numbers.
            Lanes(unsafe { _mm256_loadu_pd(x.as_ptr()) })
        }

        #[inline(always)]
        pub(crate) fn store(self) -> [f64; LANES] {
            let mut x = Stored::default();
            // SAFETY: AVX2 is there; the address is that of four numbers, aligned.
            unsafe { _mm256_store_pd(x.0.as_mut_ptr(), self.0) };
            x.0
        }

        /// Two numbers for each lane.
        #[inline(always)]
        pub(crate) fn of_pairs([a, b, c, d]: [&[f64; 2]; LANES]) -> [Lanes; 2] {
            let (ac, bd) = (two_pairs(a, c), two_pairs(b, d));
            // SAFETY: AVX2 is there.
            unsafe { [Lanes(_mm256_unpacklo_pd(ac, bd)), Lanes(_mm256_unpackhi_pd(ac, bd))] }
        }

        /// Three numbers for each lane.
        #[inline(always)]
        pub(crate) fn of_triples(triples: [&[f64; 3]; LANES]) -> [Lanes; 3] {
            let ends = triples.map(|triple| {
                let ends = (triple.first_chunk(), triple.last_chunk());
                (ends.0.expect("two of three"), ends.1.expect("two of three"))
            });
            let [x, y] = Lanes::of_pairs(ends.map(|(xy, _)| xy));
            let [_, z] = Lanes::of_pairs(ends.map(|(_, yz)| yz));
            [x, y, z]
        }

        /// Four numbers for each lane.
        #[inline(always)]
        pub(crate) fn of_fours(fours: [&[f64; 4]; LANES]) -> [Lanes; 4] {
            let [a, b, c, d] = fours.map(|four| four.as_chunks::<2>().0);
            let [x, y] = Lanes::of_pairs([&a[0], &b[0], &c[0], &d[0]]);
            let [z, w] = Lanes::of_pairs([&a[1], &b[1], &c[1], &d[1]]);
            [x, y, z, w]
        }

        /// Where these numbers are equal to `y`.
        #[inline(always)]
        pub(crate) fn are_equal(x: &[u32; LANES], y: u32) -> Lanes {
            // SAFETY: AVX2 is there; the address is that of four numbers.
            unsafe {
                let are_equal = _mm_cmpeq_epi32(_mm_loadu_si128(x.as_ptr().cast()), _mm_set1_epi32(y as i32));
                Lanes(_mm256_castsi256_pd(_mm256_cvtepi32_epi64(are_equal)))
            }
        }

        /// One bit for each lane of a mask.
        #[inline(always)]
        pub(crate) fn bits(self) -> u32 {
            // SAFETY: AVX2 is there.
            unsafe { _mm256_movemask_pd(self.0) as u32 }
        }
    }

    /// Two numbers, and two more behind them.
    #[inline(always)]
    fn two_pairs(low: &[f64; 2], high: &[f64; 2]) -> __m256d {
        // SAFETY: AVX2 is there; the addresses are those of two numbers.
        unsafe { _mm256_loadu2_m128d(high.as_ptr(), low.as_ptr()) }
    }

    impl<const D: usize, const P: usize> BiCells<D, P> {
        /// The points, in lanes.
        #[inline(always)]
        pub(crate) fn lanes(&self) -> [[Lanes; D]; P] {
            let mut lanes = [[Lanes::splat(0.0); D]; P];
            for (lanes, p) in lanes.iter_mut().zip(&self.0) {
                for (lanes, stored) in lanes.iter_mut().zip(p) {
                    *lanes = Lanes::load(&stored.0);
                }
            }
            lanes
        }
    }

    macro_rules! operators {
        ($($trait:ident $name:ident $intrinsic:ident),*) => {
            $(impl $trait for Lanes {
                type Output = Lanes;

                #[inline(always)]
                fn $name(self, other: Lanes) -> Lanes {
                    // SAFETY: AVX2 is there.
                    Lanes(unsafe { $intrinsic(self.0, other.0) })
                }
            })*
        };
    }
    operators!(
        Add add _mm256_add_pd, Sub sub _mm256_sub_pd, Mul mul _mm256_mul_pd, Div div _mm256_div_pd,
        BitAnd bitand _mm256_and_pd, BitOr bitor _mm256_or_pd
    );

    impl Not for Lanes {
        type Output = Lanes;

        #[inline(always)]
        fn not(self) -> Lanes {
            // SAFETY: AVX2 is there.
            Lanes(unsafe { _mm256_xor_pd(self.0, _mm256_castsi256_pd(_mm256_set1_epi64x(-1))) })
        }
    }

    impl Real for Lanes {
        type Mask = Lanes;

        #[inline(always)]
        fn splat(x: f64) -> Lanes {
            // SAFETY: AVX2 is there.
            Lanes(unsafe { _mm256_set1_pd(x) })
        }

        #[inline(always)]
        fn sqrt(self) -> Lanes {
            // SAFETY: AVX2 is there.
            Lanes(unsafe { _mm256_sqrt_pd(self.0) })
        }

        #[inline(always)]
        fn abs(self) -> Lanes {
            // SAFETY: AVX2 is there.
            Lanes(unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0) })
        }

        #[inline(always)]
        fn is_less(self, other: Lanes) -> Lanes {
            // SAFETY: AVX2 is there.
            Lanes(unsafe { _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0) })
        }

        #[inline(always)]
        fn select(mask: Lanes, yes: Lanes, no: Lanes) -> Lanes {
            // SAFETY: AVX2 is there.
            Lanes(unsafe { _mm256_blendv_pd(no.0, yes.0, mask.0) })
        }

        #[inline(always)]
        fn times_plus(self, factor: Lanes, term: Lanes) -> Lanes {
            // SAFETY: AVX2 and FMA are there.
            Lanes(unsafe { _mm256_fmadd_pd(self.0, factor.0, term.0) })
        }

        #[inline(always)]
        fn minus_product(self, x: Lanes, y: Lanes) -> Lanes {
            // SAFETY: AVX2 and FMA are there.
            Lanes(unsafe { _mm256_fnmadd_pd(x.0, y.0, self.0) })
        }

        #[inline(always)]
        fn min(self, other: Lanes) -> Lanes {
            // SAFETY: AVX2 is there. Gives the second number unless the first is less.
            Lanes(unsafe { _mm256_min_pd(self.0, other.0) })
        }

        #[inline(always)]
        fn max(self, other: Lanes) -> Lanes {
            // SAFETY: AVX2 is there. Gives the second number unless the first is greater.
            Lanes(unsafe { _mm256_max_pd(self.0, other.0) })
        }
    }
}
