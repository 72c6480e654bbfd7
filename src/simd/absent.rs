//! The token that never exists, for processors without AVX2: nothing here is ever called.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

use super::{LANES, Real};

#[derive(Clone, Copy, Debug)]
enum Never {}

/// The token of AVX2 and FMA, in name only: none exists.
#[derive(Clone, Copy, Debug)]
pub struct Avx2(Never);

/// Lanes of AVX2, in name only: none exist.
#[derive(Clone, Copy)]
pub struct Lanes(Never);

impl Avx2 {
    /// Always `None`.
    #[inline(always)]
    pub fn new() -> Option<Self> {
        None
    }

    pub fn run_with<A, B, C, R>(self, _: A, _: B, _: C, _: impl FnOnce(A, B, C) -> R) -> R {
        match self.0 {}
    }

    pub fn splat(self, _: f64) -> Lanes {
        match self.0 {}
    }

    pub fn load(self, _: &[f64; LANES]) -> Lanes {
        match self.0 {}
    }

    pub fn two_pairs(self, _: &[f64; 2], _: &[f64; 2]) -> Lanes {
        match self.0 {}
    }

    pub fn pairs(self, _: [&[f64; 2]; LANES]) -> [Lanes; 2] {
        match self.0 {}
    }

    pub fn mask(self, _: u32) -> Lanes {
        match self.0 {}
    }

    pub fn are_equal(self, _: &[u32; LANES], _: u32) -> Lanes {
        match self.0 {}
    }
}

macro_rules! functions {
    ($($visibility:vis fn $name:ident($($y:ty),*) -> $of:ty;)*) => {
        $($visibility fn $name(self $(, _: $y)*) -> $of {
            match self.0 {}
        })*
    };
}

impl Lanes {
    functions! {
        pub(super) fn even_with_even(Lanes) -> Lanes;
        pub(super) fn odd_with_odd(Lanes) -> Lanes;
        pub(super) fn low_with_low(Lanes) -> Lanes;
        pub(super) fn high_with_high(Lanes) -> Lanes;
        pub fn with_last_of(Lanes) -> Lanes;
        pub fn rotated() -> Lanes;
        pub fn are_same(Lanes) -> Lanes;
        pub fn bits() -> u32;
        pub fn store() -> [f64; LANES];
        pub fn store_to(&mut [f64; LANES]) -> ();
        pub fn store_three_to(&mut [f64; 3]) -> ();
        pub fn store_low_to(&mut [f64; 2]) -> ();
        pub fn store_high_to(&mut [f64; 2]) -> ();
    }
}

impl Real for Lanes {
    type Mask = Lanes;

    functions! {
        fn splat(f64) -> Lanes;
        fn sqrt() -> Lanes;
        fn abs() -> Lanes;
        fn is_less(Lanes) -> Lanes;
    }

    fn select(mask: Lanes, _: Lanes, _: Lanes) -> Lanes {
        match mask.0 {}
    }
}

macro_rules! operators {
    ($($trait:ident $name:ident),*) => {
        $(impl $trait for Lanes {
            type Output = Lanes;

            functions! { fn $name(Lanes) -> Lanes; }
        })*
    };
}
operators!(Add add, Sub sub, Mul mul, Div div, BitAnd bitand, BitOr bitor);

impl Not for Lanes {
    type Output = Lanes;

    functions! { fn not() -> Lanes; }
}
