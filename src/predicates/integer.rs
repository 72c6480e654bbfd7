//! Exact determinants of nearby points, in integers of fixed width.
//!
//! Ties are not rare: on a grid nearly every in-sphere test is one, or fails to be one by the rounding of
//! the coordinates. They should not cost a hundred times an easy test, as with expansions of any length.
//!
//! Points that nearly tie are mostly neighbours with similar exponents, so their differences, scaled by a
//! power of two, are exactly integers of at most 59 bits ([`Scaled`]); where they are not, later
//! stages have to do. Products of two differences then fit `i128`. The determinant D of degree k ≤ 5 consists
//! of terms too large for 256 bits, but D itself is not: this stage is entered only when the rounded
//! determinant does not exceed its error bound, so |D| is at most twice that bound, in units of the scale at
//! most 2 · 756 u · 2⁵⁹ᵏ·(1 + 2⁻⁴⁰), plus what the bound allows for underflow, less than 2²⁵³ together (see
//! [`MIN_EXTENT`]). Hence it suffices to know D modulo 2²⁵⁶, which costs a few wrapping multiplications
//! ([`Wide`]), and overflow of intermediate values is of no consequence.

use super::filter::UNDERFLOW;

/// Bits of a scaled difference.
const N_BITS: i32 = 59;

/// Least extent at which the determinants are known to fit.
///
/// Let the extent be at least 2ᵉ, and the unit 2ᵉ⁻⁵⁸. For e ≥ 0, twice the term for underflow, [`UNDERFLOW`], is
/// 2⁻¹⁰²¹·2⁽ᵉ⁺¹⁾⁽ᵏ⁻²⁾, in units 2⁻¹⁰²¹⁺⁵⁸ᵏ⁺⁽ᵏ⁻²⁾⁻²ᵉ < 1. For e < 0 it is 2⁻¹⁰²¹, in units 2⁻¹⁰²¹⁺⁽⁵⁸⁻ᵉ⁾ᵏ,
/// which for e = −190 and k = 5 is 2²¹⁹.
const MIN_EXTENT: f64 = power_of_two(-190);
const _: () = assert!(UNDERFLOW <= power_of_two(-1022), "twice of it is 2⁻¹⁰²¹");

const fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((f64::MAX_EXP - 1 + exponent) as u64) << (f64::MANTISSA_DIGITS - 1))
}

/// Differences of points as integers.
pub(super) struct Scaled<const D: usize, const N: usize> {
    /// The differences in units of `unit`.
    pub differences: [[i64; D]; N],
    unit: f64,
}

impl<const D: usize, const N: usize> Scaled<D, N> {
    /// The differences from `origin` to `points` if all of them are multiples of the unit, which is 2⁻⁵⁸
    /// times the largest power of two not above `extent`. The latter bounds their magnitudes, up to rounding;
    /// it must not be too small.
    pub fn new(origin: &[f64; D], points: [&[f64; D]; N], extent: f64) -> Option<Self> {
        if extent < MIN_EXTENT {
            return None;
        }
        // Within the range of coordinates, the exponents of unit and scale are far from the ends of the
        // format's.
        let exponent = (extent.to_bits() >> (f64::MANTISSA_DIGITS - 1)) as i32 - (f64::MAX_EXP - 1);
        let (unit, scale) = (power_of_two(exponent - (N_BITS - 1)), power_of_two(N_BITS - 1 - exponent));

        let mut differences = [[0; D]; N];
        let mut is_exact = true;
        for (difference, point) in differences.iter_mut().zip(points) {
            for axis in 0..D {
                let (rounded, tail) = two_difference(point[axis], origin[axis]);
                let integers = ((rounded * scale) as i64, (tail * scale) as i64);
                // Scaled back, as the scaled number may have underflowed.
                is_exact &= integers.0 as f64 * unit == rounded && integers.1 as f64 * unit == tail;
                difference[axis] = integers.0 + integers.1;
            }
        }
        is_exact.then_some(Self { differences, unit })
    }

    /// A determinant of the given degree, rounded.
    pub fn value(&self, determinant: Wide, degree: usize) -> f64 {
        let integer = determinant.rounded();
        let value = (0..degree).fold(integer.abs(), |value, _| value * self.unit);
        if integer == 0.0 { 0.0 } else { value.max(f64::MIN_POSITIVE).copysign(integer) }
    }
}

/// Rounded difference and its error (Knuth).
fn two_difference(a: f64, b: f64) -> (f64, f64) {
    let difference = a - b;
    let b_part = a - difference;
    let a_part = difference + b_part;
    (difference, (a - a_part) + (b_part - b))
}

/// An integer modulo 2²⁵⁶, in two's complement.
#[derive(Clone, Copy)]
pub(super) struct Wide {
    high: u128,
    low: u128,
}

impl Wide {
    pub fn plus(self, other: Self) -> Self {
        let (low, carry) = self.low.overflowing_add(other.low);
        Self { high: self.high.wrapping_add(other.high).wrapping_add(u128::from(carry)), low }
    }

    pub fn minus(self, other: Self) -> Self {
        let (low, borrow) = self.low.overflowing_sub(other.low);
        Self { high: self.high.wrapping_sub(other.high).wrapping_sub(u128::from(borrow)), low }
    }

    pub fn times(self, other: i128) -> Self {
        let other = Self::from(other);
        let product = unsigned_product(self.low, other.low);
        let cross = self.low.wrapping_mul(other.high).wrapping_add(self.high.wrapping_mul(other.low));
        Self { high: product.high.wrapping_add(cross), low: product.low }
    }

    /// With the sign of the integer that is congruent and smallest in magnitude.
    fn rounded(self) -> f64 {
        let is_negative = (self.high as i128) < 0;
        let magnitude = if is_negative { Self::from(0).minus(self) } else { self };
        let rounded = magnitude.high as f64 * 2f64.powi(128) + magnitude.low as f64;
        if is_negative { -rounded } else { rounded }
    }
}

impl From<i128> for Wide {
    fn from(x: i128) -> Self {
        Self { high: (x >> 127) as u128, low: x as u128 }
    }
}

fn unsigned_product(a: u128, b: u128) -> Wide {
    let halves = |x: u128| (x >> 64, x & u128::from(u64::MAX));
    let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
    let (carry, lowest) = halves(a_low * b_low);
    let (carry_first, middle) = halves(a_high * b_low + carry);
    let (carry_second, middle) = halves(a_low * b_high + middle);
    Wide { high: a_high * b_high + carry_first + carry_second, low: middle << 64 | lowest }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wide_arithmetic_is_modular() {
        let (p, q) = (i128::MAX - 12_345, i128::MIN + 67_890);
        // (p + q)(p - q) = p p - q q, where the differences have been spelt out.
        let sum = p + q;
        let left = Wide::from(p).times(sum).minus(Wide::from(q).times(sum));
        let right = Wide::from(p).times(p).minus(Wide::from(q).times(q));
        assert_eq!((left.high, left.low), (right.high, right.low));
        assert_eq!(Wide::from(-3).times(1 << 100).rounded(), -3.0 * 2f64.powi(100));
        assert_eq!(Wide::from(1 << 100).times(-(1 << 101)).rounded(), -(2f64.powi(201)));
        assert_eq!(Wide::from(-1).plus(Wide::from(1)).rounded(), 0.0);
    }

    #[test]
    fn scaled_differences_are_exact_or_refused() {
        let extent = 1.0 + 2f64.powi(-30);
        let scaled = Scaled::new(&[-2f64.powi(-30)], [&[1.0], &[2f64.powi(-58)]], extent).unwrap();
        let half = 1i64 << 58;
        assert_eq!(scaled.differences, [[half + (half >> 30)], [1 + (half >> 30)]]);
        assert_eq!(scaled.value(Wide::from(i128::from(half)), 1), 1.0);
        assert!(Scaled::new(&[0.0], [&[1.0], &[2f64.powi(-59)]], 1.0).is_none());
        let least = f64::from_bits(1);
        assert!(Scaled::new(&[0.0], [&[1e57], &[least]], 1e57).is_none(), "it scales to zero");
        assert!(Scaled::new(&[0.0], [&[least]], least).is_none());
    }

    #[test]
    fn values_keep_their_sign() {
        let scaled = Scaled::new(&[0.0], [&[1e-57]], 1e-57).unwrap();
        assert!(scaled.value(Wide::from(1), 5) > 0.0 && scaled.value(Wide::from(-1), 5) < 0.0);
        assert_eq!(scaled.value(Wide::from(0), 5), 0.0);
    }
}
