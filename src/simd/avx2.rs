//! Lanes of AVX2 and FMA.

use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};
use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

use super::{LANES, Real};

/// Proof that the processor has AVX2 and FMA.
#[derive(Clone, Copy, Debug)]
pub struct Avx2(());

/// Whether there is a token: not known yet, no, or yes.
static IS_THERE: AtomicU8 = AtomicU8::new(UNKNOWN);
const UNKNOWN: u8 = 0;
const NO: u8 = 1;
const YES: u8 = 2;

impl Avx2 {
    /// The token; `None` if the processor lacks AVX2 or FMA, or if the scalar path is forced.
    #[inline(always)]
    pub fn new() -> Option<Self> {
        match IS_THERE.load(Relaxed) {
            YES => Some(Avx2(())),
            UNKNOWN => detect(),
            _ => None,
        }
    }

    /// Calls `work` with these arguments, compiled for AVX2 and FMA.
    #[inline(always)]
    pub fn run_with<A, B, C, R>(self, a: A, b: B, c: C, work: impl FnOnce(A, B, C) -> R) -> R {
        #[target_feature(enable = "avx2,fma")]
        fn with_both<A, B, C, R>(a: A, b: B, c: C, work: impl FnOnce(A, B, C) -> R) -> R {
            work(a, b, c)
        }
        // SAFETY: the processor has both, or there would be no token.
        unsafe { with_both(a, b, c, work) }
    }

    /// The same number in all lanes.
    #[inline(always)]
    pub fn splat(self, x: f64) -> Lanes {
        // SAFETY: the processor has AVX2, or there would be no token.
        Lanes(unsafe { _mm256_set1_pd(x) })
    }

    /// One number for each lane.
    #[inline(always)]
    pub fn load(self, x: &[f64; LANES]) -> Lanes {
        // SAFETY: AVX2 is there by the token; the address is that of four numbers.
        Lanes(unsafe { _mm256_loadu_pd(x.as_ptr()) })
    }

    /// Two numbers, and two more behind them.
    #[inline(always)]
    pub fn two_pairs(self, low: &[f64; 2], high: &[f64; 2]) -> Lanes {
        // SAFETY: AVX2 is there by the token; the addresses are those of two numbers.
        Lanes(unsafe { _mm256_loadu2_m128d(high.as_ptr(), low.as_ptr()) })
    }

    /// Two numbers for each lane.
    #[inline(always)]
    pub fn pairs(self, [a, b, c, d]: [&[f64; 2]; LANES]) -> [Lanes; 2] {
        let (ac, bd) = (self.two_pairs(a, c), self.two_pairs(b, d));
        [ac.even_with_even(bd), ac.odd_with_odd(bd)]
    }

    /// A mask of the lanes that have a bit in `bits`, which has no others.
    #[inline(always)]
    pub fn mask(self, bits: u32) -> Lanes {
        const MASKS: [[u64; LANES]; 1 << LANES] = {
            let mut masks = [[0; LANES]; 1 << LANES];
            let mut at = 0;
            while at < LANES << LANES {
                masks[at / LANES][at % LANES] =
                    if (at / LANES) >> (at % LANES) & 1 == 1 { u64::MAX } else { 0 };
                at += 1;
            }
            masks
        };
        let mask = &MASKS[bits as usize];
        // SAFETY: AVX2 is there by the token; the address is that of four numbers.
        Lanes(unsafe { _mm256_loadu_pd(mask.as_ptr().cast()) })
    }

    /// A mask of the numbers that are equal to `y`.
    #[inline(always)]
    pub fn are_equal(self, x: &[u32; LANES], y: u32) -> Lanes {
        // SAFETY: AVX2 is there by the token; the address is that of four numbers.
        unsafe {
            let are_equal = _mm_cmpeq_epi32(_mm_loadu_si128(x.as_ptr().cast()), _mm_set1_epi32(y as i32));
            Lanes(_mm256_castsi256_pd(_mm256_cvtepi32_epi64(are_equal)))
        }
    }
}

/// Detects the processor, and remembers the result.
#[cold]
#[inline(never)]
fn detect() -> Option<Avx2> {
    let is_there =
        is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") && !is_scalar_path_forced();
    IS_THERE.store(if is_there { YES } else { NO }, Relaxed);
    is_there.then_some(Avx2(()))
}

/// Whether `DELDRIFT_SCALAR` is set. Does not allocate, unlike the function of the standard library.
fn is_scalar_path_forced() -> bool {
    // SAFETY: the name ends with a zero, and what the answer points to is not read.
    !unsafe { libc::getenv(c"DELDRIFT_SCALAR".as_ptr()) }.is_null()
}

/// Prefetches what is at an address, which need not be valid.
#[inline(always)]
pub fn prefetch_at<T>(address: *const T) {
    // SAFETY: a prefetch is a hint, which is harmless at any address.
    unsafe { _mm_prefetch::<_MM_HINT_T0>(address.cast()) };
}

/// Four numbers; or a mask, with all bits of a lane set or none. Lanes exist only if a token does.
#[derive(Clone, Copy)]
pub struct Lanes(__m256d);

/// Functions of lanes by intrinsics that need AVX2 and FMA and are safe otherwise. The compiler checks that: the inner
/// function has both features, so the only calls that it may not make are those with further conditions.
macro_rules! functions {
    ($($(#[$attribute:meta])* $visibility:vis fn $name:ident($x:ident $(, $y:ident)*) = $of:expr;)*) => {$(
        $(#[$attribute])*
        #[inline(always)]
        $visibility fn $name(self $(, $y: Lanes)*) -> Lanes {
            #[target_feature(enable = "avx2,fma")]
            #[inline]
            fn with_both($x: __m256d $(, $y: __m256d)*) -> __m256d {
                $of
            }
            // SAFETY: AVX2 and FMA are there, or there would be no lanes.
            Lanes(unsafe { with_both(self.0 $(, $y.0)*) })
        }
    )*};
}

impl Lanes {
    functions! {
        /// Lane 0 of each, then lane 2 of each.
        pub(super) fn even_with_even(x, y) = _mm256_unpacklo_pd(x, y);
        /// Lane 1 of each, then lane 3 of each.
        pub(super) fn odd_with_odd(x, y) = _mm256_unpackhi_pd(x, y);
        /// Lanes 0 and 1 of each.
        pub(super) fn low_with_low(x, y) = _mm256_permute2f128_pd::<0x20>(x, y);
        /// Lanes 2 and 3 of each.
        pub(super) fn high_with_high(x, y) = _mm256_permute2f128_pd::<0x31>(x, y);
        fn blend(mask, yes, no) = _mm256_blendv_pd(no, yes, mask);
        /// These, with the last lane of `y`.
        pub fn with_last_of(x, y) = _mm256_blend_pd::<0b1000>(x, y);
        /// Lanes 1, 2, 3 and 0.
        pub fn rotated(x) = _mm256_permute4x64_pd::<0b00_11_10_01>(x);
        /// A mask of the lanes that have the same bits.
        pub fn are_same(x, y) =
            _mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_castpd_si256(x), _mm256_castpd_si256(y)));
    }

    /// One bit for each lane of a mask.
    #[inline(always)]
    pub fn bits(self) -> u32 {
        // SAFETY: AVX2 is there, or there would be no lanes.
        unsafe { _mm256_movemask_pd(self.0) as u32 }
    }

    /// The number of each lane.
    #[inline(always)]
    pub fn store(self) -> [f64; LANES] {
        #[repr(align(32))]
        struct Aligned([f64; LANES]);
        let mut x = Aligned([0.0; LANES]);
        self.store_to(&mut x.0);
        x.0
    }

    /// Writes all numbers.
    #[inline(always)]
    pub fn store_to(self, x: &mut [f64; LANES]) {
        // SAFETY: AVX2 is there, or there would be no lanes; the address is that of four numbers.
        unsafe { _mm256_storeu_pd(x.as_mut_ptr(), self.0) };
    }

    /// Writes the first three numbers.
    #[inline(always)]
    pub fn store_three_to(self, x: &mut [f64; 3]) {
        let at = x.as_mut_ptr();
        // SAFETY: AVX2 is there, or there would be no lanes; the addresses are those of two numbers and of one.
        unsafe {
            _mm_storeu_pd(at, _mm256_castpd256_pd128(self.0));
            _mm_store_sd(at.add(2), _mm256_extractf128_pd::<1>(self.0));
        }
    }

    /// Writes the first two numbers.
    #[inline(always)]
    pub fn store_low_to(self, x: &mut [f64; 2]) {
        // SAFETY: AVX2 is there, or there would be no lanes; the address is that of two numbers.
        unsafe { _mm_storeu_pd(x.as_mut_ptr(), _mm256_castpd256_pd128(self.0)) };
    }

    /// Writes the last two numbers.
    #[inline(always)]
    pub fn store_high_to(self, x: &mut [f64; 2]) {
        // SAFETY: AVX2 is there, or there would be no lanes; the address is that of two numbers.
        unsafe { _mm_storeu_pd(x.as_mut_ptr(), _mm256_extractf128_pd::<1>(self.0)) };
    }
}

impl Real for Lanes {
    type Mask = Lanes;

    #[inline(always)]
    fn splat(self, x: f64) -> Lanes {
        // A token exists, since lanes do.
        Avx2(()).splat(x)
    }

    #[inline(always)]
    fn select(mask: Lanes, yes: Lanes, no: Lanes) -> Lanes {
        mask.blend(yes, no)
    }

    functions! {
        fn sqrt(x) = _mm256_sqrt_pd(x);
        fn abs(x) = _mm256_andnot_pd(_mm256_set1_pd(-0.0), x);
        fn is_less(x, y) = _mm256_cmp_pd::<_CMP_LT_OQ>(x, y);
        fn times_plus(x, factor, term) = _mm256_fmadd_pd(x, factor, term);
        fn minus_product(x, y, z) = _mm256_fnmadd_pd(y, z, x);
        // These give the second number unless the first is less, or greater.
        fn min(x, y) = _mm256_min_pd(x, y);
        fn max(x, y) = _mm256_max_pd(x, y);
    }
}

macro_rules! operators {
    ($($trait:ident $name:ident $intrinsic:ident),*) => {
        $(impl $trait for Lanes {
            type Output = Lanes;

            functions! { fn $name(x, y) = $intrinsic(x, y); }
        })*
    };
}
operators!(
    Add add _mm256_add_pd, Sub sub _mm256_sub_pd, Mul mul _mm256_mul_pd, Div div _mm256_div_pd,
    BitAnd bitand _mm256_and_pd, BitOr bitor _mm256_or_pd
);

impl Not for Lanes {
    type Output = Lanes;

    functions! { fn not(x) = _mm256_xor_pd(x, _mm256_castsi256_pd(_mm256_set1_epi64x(-1))); }
}
