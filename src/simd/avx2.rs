//! Lanes of AVX2.

use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

use super::presence::{self, Presence};
use super::{LANES, Lanes, Real, Simd};

/// Proof that the processor has AVX2.
#[derive(Clone, Copy, Debug)]
pub struct Avx2(());

static PRESENCE: Presence = Presence::unknown();

impl Avx2 {
    /// The token; `None` if the processor lacks AVX2, or if lanes of numbers are forced.
    #[inline(always)]
    pub fn new() -> Option<Self> {
        PRESENCE.is_there(detect).then_some(Avx2(()))
    }
}

impl Simd for Avx2 {
    type Lanes = Four;

    #[inline(always)]
    fn run_with<A, B, C, R>(self, a: A, b: B, c: C, work: impl FnOnce(A, B, C) -> R) -> R {
        #[target_feature(enable = "avx2")]
        fn with_avx2<A, B, C, R>(a: A, b: B, c: C, work: impl FnOnce(A, B, C) -> R) -> R {
            work(a, b, c)
        }
        // SAFETY: the processor has AVX2, or there would be no token.
        unsafe { with_avx2(a, b, c, work) }
    }

    #[inline(always)]
    fn splat(self, x: f64) -> Four {
        // SAFETY: the processor has AVX2, or there would be no token.
        Four(unsafe { _mm256_set1_pd(x) })
    }

    #[inline(always)]
    fn load(self, x: &[f64; LANES]) -> Four {
        // SAFETY: AVX2 is there by the token; the address is that of four numbers.
        Four(unsafe { _mm256_loadu_pd(x.as_ptr()) })
    }

    #[inline(always)]
    fn two_pairs(self, low: &[f64; 2], high: &[f64; 2]) -> Four {
        // SAFETY: AVX2 is there by the token; the addresses are those of two numbers.
        Four(unsafe { _mm256_loadu2_m128d(high.as_ptr(), low.as_ptr()) })
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> Four {
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
        Four(unsafe { _mm256_loadu_pd(mask.as_ptr().cast()) })
    }

    #[inline(always)]
    fn are_equal(self, x: &[u32; LANES], y: u32) -> Four {
        // SAFETY: AVX2 is there by the token; the address is that of four numbers.
        unsafe {
            let are_equal = _mm_cmpeq_epi32(_mm_loadu_si128(x.as_ptr().cast()), _mm_set1_epi32(y as i32));
            Four(_mm256_castsi256_pd(_mm256_cvtepi32_epi64(are_equal)))
        }
    }
}

/// Detects the processor, and remembers the result.
#[cold]
#[inline(never)]
fn detect() -> bool {
    PRESENCE.note(is_x86_feature_detected!("avx2") && !presence::is_scalar_path_forced())
}

/// Prefetches what is at an address, which need not be valid.
#[inline(always)]
pub fn prefetch_at<T>(address: *const T) {
    // SAFETY: a prefetch is a hint, which is harmless at any address.
    unsafe { _mm_prefetch::<_MM_HINT_T0>(address.cast()) };
}

/// Four numbers; or a mask, with all bits of a lane set or none. They exist only if a token does.
#[derive(Clone, Copy)]
pub struct Four(__m256d);

/// Functions of lanes by intrinsics that need AVX2 and are safe otherwise. The compiler checks that: the inner
/// function has this feature, so the only calls that it may not make are those with further conditions.
macro_rules! functions {
    ($(fn $name:ident($x:ident $(, $y:ident)*) = $of:expr;)*) => {$(
        #[inline(always)]
        fn $name(self $(, $y: Four)*) -> Four {
            #[target_feature(enable = "avx2")]
            #[inline]
            fn with_avx2($x: __m256d $(, $y: __m256d)*) -> __m256d {
                $of
            }
            // SAFETY: AVX2 is there, or there would be no lanes.
            Four(unsafe { with_avx2(self.0 $(, $y.0)*) })
        }
    )*};
}

impl Four {
    functions! {
        fn blend(mask, yes, no) = _mm256_blendv_pd(no, yes, mask);
    }
}

impl Lanes for Four {
    functions! {
        fn even_with_even(x, y) = _mm256_unpacklo_pd(x, y);
        fn odd_with_odd(x, y) = _mm256_unpackhi_pd(x, y);
        fn low_with_low(x, y) = _mm256_permute2f128_pd::<0x20>(x, y);
        fn high_with_high(x, y) = _mm256_permute2f128_pd::<0x31>(x, y);
        fn with_last_of(x, y) = _mm256_blend_pd::<0b1000>(x, y);
        fn rotated(x) = _mm256_permute4x64_pd::<0b00_11_10_01>(x);
        fn are_same(x, y) =
            _mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_castpd_si256(x), _mm256_castpd_si256(y)));
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        // SAFETY: AVX2 is there, or there would be no lanes.
        unsafe { _mm256_movemask_pd(self.0) as u32 }
    }

    #[inline(always)]
    fn store(self) -> [f64; LANES] {
        #[repr(align(32))]
        struct AlignedLanes([f64; LANES]);
        let mut x = AlignedLanes([0.0; LANES]);
        self.store_to(&mut x.0);
        x.0
    }

    #[inline(always)]
    fn store_to(self, x: &mut [f64; LANES]) {
        // SAFETY: AVX2 is there, or there would be no lanes; the address is that of four numbers.
        unsafe { _mm256_storeu_pd(x.as_mut_ptr(), self.0) };
    }

    #[inline(always)]
    fn store_three_to(self, x: &mut [f64; 3]) {
        let at = x.as_mut_ptr();
        // SAFETY: AVX2 is there, or there would be no lanes; the addresses are those of two numbers and of one.
        unsafe {
            _mm_storeu_pd(at, _mm256_castpd256_pd128(self.0));
            _mm_store_sd(at.add(2), _mm256_extractf128_pd::<1>(self.0));
        }
    }

    #[inline(always)]
    fn store_low_to(self, x: &mut [f64; 2]) {
        // SAFETY: AVX2 is there, or there would be no lanes; the address is that of two numbers.
        unsafe { _mm_storeu_pd(x.as_mut_ptr(), _mm256_castpd256_pd128(self.0)) };
    }

    #[inline(always)]
    fn store_high_to(self, x: &mut [f64; 2]) {
        // SAFETY: AVX2 is there, or there would be no lanes; the address is that of two numbers.
        unsafe { _mm_storeu_pd(x.as_mut_ptr(), _mm256_extractf128_pd::<1>(self.0)) };
    }
}

impl Real for Four {
    type Mask = Four;

    #[inline(always)]
    fn splat(self, x: f64) -> Four {
        // A token exists, since lanes do.
        Avx2(()).splat(x)
    }

    #[inline(always)]
    fn select(mask: Four, yes: Four, no: Four) -> Four {
        mask.blend(yes, no)
    }

    functions! {
        fn sqrt(x) = _mm256_sqrt_pd(x);
        fn abs(x) = _mm256_andnot_pd(_mm256_set1_pd(-0.0), x);
        fn is_less(x, y) = _mm256_cmp_pd::<_CMP_LT_OQ>(x, y);
        // Both give the second number unless the first is less, or greater.
        fn min(x, y) = _mm256_min_pd(x, y);
        fn max(x, y) = _mm256_max_pd(x, y);
    }
}

macro_rules! operators {
    ($($trait:ident $name:ident $intrinsic:ident),*) => {
        $(impl $trait for Four {
            type Output = Four;

            functions! { fn $name(x, y) = $intrinsic(x, y); }
        })*
    };
}
operators!(
    Add add _mm256_add_pd, Sub sub _mm256_sub_pd, Mul mul _mm256_mul_pd, Div div _mm256_div_pd,
    BitAnd bitand _mm256_and_pd, BitOr bitor _mm256_or_pd
);

impl Not for Four {
    type Output = Four;

    functions! { fn not(x) = _mm256_xor_pd(x, _mm256_castsi256_pd(_mm256_set1_epi64x(-1))); }
}
