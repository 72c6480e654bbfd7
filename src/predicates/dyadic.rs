//! Sums and products of numbers without rounding, for tests.

use num_bigint::BigInt;
use std::ops::{Add, Mul, Sub};

/// `digits` · 2^`exponent`.
#[derive(Clone, Debug)]
pub(super) struct Dyadic {
    digits: BigInt,
    exponent: i64,
}

impl From<f64> for Dyadic {
    fn from(x: f64) -> Self {
        assert!(x.is_finite());
        let (fraction, exponent) = (x.to_bits() & ((1 << 52) - 1), (x.to_bits() >> 52 & 2047) as i64);
        let digits = BigInt::from(if exponent == 0 { fraction } else { fraction | 1 << 52 });
        let exponent = exponent.max(1) - 1075;
        Dyadic { digits: if x < 0.0 { -digits } else { digits }, exponent }
    }
}

impl Dyadic {
    /// The digits of both for one exponent, which is returned as well.
    fn aligned(&self, other: &Self) -> (BigInt, BigInt, i64) {
        let exponent = self.exponent.min(other.exponent);
        let digits = |x: &Self| &x.digits << (x.exponent - exponent) as usize;
        (digits(self), digits(other), exponent)
    }

    pub(super) fn abs(self) -> Self {
        Dyadic { digits: self.digits.magnitude().clone().into(), ..self }
    }

    /// Whether the difference is at most 2^-`n_bits` of the other.
    pub(super) fn is_close_to(&self, other: &Self, n_bits: usize) -> bool {
        let (a, b, _) = self.aligned(other);
        ((&a - &b) << n_bits).magnitude() <= b.magnitude()
    }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Self) -> bool {
        let (a, b, _) = self.aligned(other);
        a == b
    }
}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        let (a, b, _) = self.aligned(other);
        a.partial_cmp(&b)
    }
}

impl Add for Dyadic {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (a, b, exponent) = self.aligned(&other);
        Dyadic { digits: a + b, exponent }
    }
}

impl Sub for Dyadic {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        let (a, b, exponent) = self.aligned(&other);
        Dyadic { digits: a - b, exponent }
    }
}

impl Mul for Dyadic {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Dyadic { digits: self.digits * other.digits, exponent: self.exponent + other.exponent }
    }
}

/// The product of the numbers.
pub(super) fn product<const N: usize>(factors: [f64; N]) -> Dyadic {
    factors.into_iter().map(Dyadic::from).fold(Dyadic::from(1.0), Mul::mul)
}
