//! Lanes of NEON, in two registers of two lanes each. Every processor of 64-bit ARM has it.

use std::arch::aarch64::*;
use std::arch::asm;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

use super::presence::{self, Presence};
use super::{LANES, Lanes, Real, Simd};

/// The token of NEON, which is there unless lanes of numbers are forced.
#[derive(Clone, Copy, Debug)]
pub struct Neon(());

static PRESENCE: Presence = Presence::unknown();

impl Neon {
    /// The token; `None` if lanes of numbers are forced.
    #[inline(always)]
    pub fn new() -> Option<Self> {
        PRESENCE.is_there(detect).then_some(Neon(()))
    }
}

#[cold]
#[inline(never)]
fn detect() -> bool {
    PRESENCE.note(!presence::is_scalar_path_forced())
}

impl Simd for Neon {
    type Lanes = Four;

    #[inline(always)]
    fn run_with<A, B, C, R>(self, a: A, b: B, c: C, work: impl FnOnce(A, B, C) -> R) -> R {
        work(a, b, c)
    }

    #[inline(always)]
    fn splat(self, x: f64) -> Four {
        // SAFETY: the processor has NEON.
        let two = unsafe { vdupq_n_f64(x) };
        Four(two, two)
    }

    #[inline(always)]
    fn load(self, x: &[f64; LANES]) -> Four {
        let (low, high) = (x.as_ptr(), x[2..].as_ptr());
        // SAFETY: the processor has NEON; the addresses are those of two numbers.
        unsafe { Four(vld1q_f64(low), vld1q_f64(high)) }
    }

    #[inline(always)]
    fn two_pairs(self, low: &[f64; 2], high: &[f64; 2]) -> Four {
        // SAFETY: the processor has NEON; the addresses are those of two numbers.
        unsafe { Four(vld1q_f64(low.as_ptr()), vld1q_f64(high.as_ptr())) }
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> Four {
        const BITS: [u64; LANES] = [1, 2, 4, 8];
        // SAFETY: the processor has NEON; the addresses are those of two numbers.
        unsafe {
            let bits = vdupq_n_u64(u64::from(bits));
            let [low, high] = [&BITS[..2], &BITS[2..]].map(|own| vtstq_u64(bits, vld1q_u64(own.as_ptr())));
            Four::of_bits(low, high)
        }
    }

    #[inline(always)]
    fn are_equal(self, x: &[u32; LANES], y: u32) -> Four {
        // SAFETY: the processor has NEON; the address is that of four numbers.
        unsafe {
            let are_equal = vreinterpretq_s32_u32(vceqq_u32(vld1q_u32(x.as_ptr()), vdupq_n_u32(y)));
            let (low, high) = (vmovl_s32(vget_low_s32(are_equal)), vmovl_high_s32(are_equal));
            Four(vreinterpretq_f64_s64(low), vreinterpretq_f64_s64(high))
        }
    }
}

/// Prefetches what is at an address, which need not be valid.
#[inline(always)]
pub fn prefetch_at<T>(address: *const T) {
    // SAFETY: a prefetch is a hint, which is harmless at any address.
    unsafe { asm!("prfm pldl1keep, [{}]", in(reg) address, options(nostack, preserves_flags, readonly)) };
}

/// Four numbers; or a mask, with all bits of a lane set or none.
#[derive(Clone, Copy)]
pub struct Four(float64x2_t, float64x2_t);

/// Functions of lanes by intrinsics that need NEON and are safe otherwise, done to the low lanes and to the high ones.
/// The compiler checks that: the inner function has this feature, so the only calls that it may not make are those with
/// further conditions.
macro_rules! functions {
    ($(fn $name:ident($x:ident $(, $y:ident)*) = $of:expr;)*) => {$(
        #[inline(always)]
        fn $name(self $(, $y: Four)*) -> Four {
            #[target_feature(enable = "neon")]
            #[inline]
            fn with_neon($x: float64x2_t $(, $y: float64x2_t)*) -> float64x2_t {
                $of
            }
            // SAFETY: the processor has NEON.
            unsafe { Four(with_neon(self.0 $(, $y.0)*), with_neon(self.1 $(, $y.1)*)) }
        }
    )*};
}

/// Functions of the bits of lanes.
macro_rules! functions_of_bits {
    ($(fn $name:ident($x:ident $(, $y:ident)*) = $of:expr;)*) => {
        functions! {$(
            fn $name($x $(, $y)*) = {
                let $x = vreinterpretq_u64_f64($x);
                $(let $y = vreinterpretq_u64_f64($y);)*
                vreinterpretq_f64_u64($of)
            };
        )*}
    };
}

impl Four {
    #[inline(always)]
    fn of_bits(low: uint64x2_t, high: uint64x2_t) -> Four {
        // SAFETY: the processor has NEON.
        unsafe { Four(vreinterpretq_f64_u64(low), vreinterpretq_f64_u64(high)) }
    }

    functions! {
        fn selected(mask, yes, no) = vbslq_f64(vreinterpretq_u64_f64(mask), yes, no);
    }
}

impl Lanes for Four {
    functions! {
        fn even_with_even(x, y) = vtrn1q_f64(x, y);
        fn odd_with_odd(x, y) = vtrn2q_f64(x, y);
    }

    functions_of_bits! {
        fn are_same(x, y) = vceqq_u64(x, y);
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
        // SAFETY: the processor has NEON.
        Four(self.0, unsafe { vcopyq_laneq_f64::<1, 1>(self.1, y.1) })
    }

    #[inline(always)]
    fn rotated(self) -> Four {
        // SAFETY: the processor has NEON.
        unsafe { Four(vextq_f64::<1>(self.0, self.1), vextq_f64::<1>(self.1, self.0)) }
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        const BITS: [u32; LANES] = [1, 2, 4, 8];
        // SAFETY: the processor has NEON; the address is that of four numbers.
        unsafe {
            // The upper halves of the lanes: each has the sign of its lane.
            let (low, high) = (vreinterpretq_s32_f64(self.0), vreinterpretq_s32_f64(self.1));
            let are_set = vcltzq_s32(vuzp2q_s32(low, high));
            vaddvq_u32(vandq_u32(are_set, vld1q_u32(BITS.as_ptr())))
        }
    }

    #[inline(always)]
    fn store(self) -> [f64; LANES] {
        let mut x = [0.0; LANES];
        self.store_to(&mut x);
        x
    }

    #[inline(always)]
    fn store_to(self, x: &mut [f64; LANES]) {
        let at = x.as_mut_ptr();
        // SAFETY: the processor has NEON; the addresses are those of two numbers.
        unsafe {
            vst1q_f64(at, self.0);
            vst1q_f64(at.add(2), self.1);
        }
    }

    #[inline(always)]
    fn store_three_to(self, x: &mut [f64; 3]) {
        let at = x.as_mut_ptr();
        // SAFETY: the processor has NEON; the addresses are those of two numbers and of one.
        unsafe {
            vst1q_f64(at, self.0);
            vst1q_lane_f64::<0>(at.add(2), self.1);
        }
    }

    #[inline(always)]
    fn store_low_to(self, x: &mut [f64; 2]) {
        // SAFETY: the processor has NEON; the address is that of two numbers.
        unsafe { vst1q_f64(x.as_mut_ptr(), self.0) };
    }

    #[inline(always)]
    fn store_high_to(self, x: &mut [f64; 2]) {
        // SAFETY: the processor has NEON; the address is that of two numbers.
        unsafe { vst1q_f64(x.as_mut_ptr(), self.1) };
    }
}

impl Real for Four {
    type Mask = Four;

    #[inline(always)]
    fn splat(self, x: f64) -> Four {
        Neon(()).splat(x)
    }

    #[inline(always)]
    fn select(mask: Four, yes: Four, no: Four) -> Four {
        mask.selected(yes, no)
    }

    functions! {
        fn sqrt(x) = vsqrtq_f64(x);
        fn abs(x) = vabsq_f64(x);
        fn is_less(x, y) = vreinterpretq_f64_u64(vcltq_f64(x, y));
        // The instructions with these names give NaN where either number is that, and tell zeros apart.
        fn min(x, y) = vbslq_f64(vcltq_f64(x, y), x, y);
        fn max(x, y) = vbslq_f64(vcltq_f64(y, x), x, y);
    }
}

macro_rules! operators {
    ($($functions:ident $trait:ident $name:ident $intrinsic:ident),*) => {
        $(impl $trait for Four {
            type Output = Four;

            $functions! { fn $name(x, y) = $intrinsic(x, y); }
        })*
    };
}
operators!(
    functions Add add vaddq_f64, functions Sub sub vsubq_f64, functions Mul mul vmulq_f64, functions Div div vdivq_f64,
    functions_of_bits BitAnd bitand vandq_u64, functions_of_bits BitOr bitor vorrq_u64
);

impl Not for Four {
    type Output = Four;

    functions! { fn not(x) = vreinterpretq_f64_u8(vmvnq_u8(vreinterpretq_u8_f64(x))); }
}
