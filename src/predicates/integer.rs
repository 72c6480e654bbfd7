//! Exact determinants of nearby points, in integers of fixed width.
//!
//! Ties are not rare: on a grid nearly every in-sphere test is one, or fails to be one by the rounding of
//! the coordinates. They should not cost a hundred times an easy test, as with expansions of any length.
//!
//! Points that nearly tie are mostly neighbours with similar exponents, so their differences are integers of few
//! bits in a unit that is a power of two ([`Scaled`], [`LongScaled`]). A determinant D of degree k consists of terms
//! of k times as many bits, but D itself is shorter: this stage is entered only when the rounded determinant does
//! not exceed its error bound, so |D| is at most twice that bound. With an extent of b bits that is
//! 2 · 756 u · 2⁵ᵇ·(1 + 2⁻⁴⁰) < 2⁵ᵇ⁻⁴² for `insphere`, 2 · 72 u · 2⁴ᵇ < 2⁴ᵇ⁻⁴⁵ for `incircle` and 2 · 40 u · 2³ᵇ <
//! 2³ᵇ⁻⁴⁶ for `orient3d`, and what the bound allows for underflow is less than a thousandth of that (see
//! [`MIN_EXTENT`]). Hence it suffices to know D modulo a power of two above twice that number, which costs a few
//! wrapping multiplications ([`Modular`]), and overflow of intermediate values is of no consequence: 64 bits for
//! neighbours on a lattice, 256 where differences have all bits of coordinates of one exponent, 512 where exponents
//! differ by up to fifty. Long differences mostly are those of points that are much closer along one axis than along
//! another: the bound that has not been exceeded is small then, and D shorter still ([`LongScaled::n_bits_within`]).

use std::cmp::Ordering;

use super::filter::UNDERFLOW;

/// Bits of a difference in the smaller format.
const N_BITS: i32 = 59;

/// Bits of a difference in the larger format.
const N_LONG_BITS: i32 = 110;

/// Least extent at which the determinants are known to fit.
///
/// Let the extent be at least 2ᵉ, and the unit 2ᵉ⁻ᵇ. For e ≥ 0, twice the term for underflow, [`UNDERFLOW`], is
/// 2⁻¹⁰²¹·2⁽ᵉ⁺¹⁾⁽ᵏ⁻²⁾, in units 2⁻¹⁰²¹⁺ᵇᵏ⁺⁽ᵏ⁻²⁾⁻²ᵉ, for k = 5 less than 2⁵ᵇ⁻¹⁰¹⁷. For e < 0 it is 2⁻¹⁰²¹, in units
/// 2⁻¹⁰²¹⁺⁽ᵇ⁻ᵉ⁾ᵏ, which for e = −190 and k = 5 is 2⁵ᵇ⁻⁷¹, and less for smaller k, compared with 2ᵏᵇ.
const MIN_EXTENT: f64 = power_of_two(-190);
const _: () = assert!(UNDERFLOW <= power_of_two(-1022), "twice of it is 2⁻¹⁰²¹");

/// Two to the power of an exponent that a normal number can have.
pub(super) const fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((f64::MAX_EXP - 1 + exponent) as u64) << (f64::MANTISSA_DIGITS - 1))
}

/// The exponent of a normal number.
fn exponent_of(x: f64) -> i32 {
    (x.to_bits() >> (f64::MANTISSA_DIGITS - 1)) as i32 - (f64::MAX_EXP - 1)
}

/// Differences of points as integers in a unit of their own.
pub(super) struct Scaled<const D: usize, const N: usize> {
    /// The differences: at least one of them is odd.
    pub differences: [[i64; D]; N],
    /// Bits of the extent of the points' box, which may be twice the longest difference.
    pub n_bits: u32,
}

impl<const D: usize, const N: usize> Scaled<D, N> {
    /// The differences from `origin` to `points` if all of them are multiples of 2⁻⁵⁸ times the largest power of two
    /// not above `extent`. The latter bounds their magnitudes, up to rounding; it must not be too small.
    pub fn new(origin: &[f64; D], points: [&[f64; D]; N], extent: f64) -> Option<Self> {
        if extent < MIN_EXTENT {
            return None;
        }
        // Within the range of coordinates, the exponents of unit and scale are far from the ends of the
        // format's.
        let exponent = exponent_of(extent);
        let (unit, scale) = (power_of_two(exponent - (N_BITS - 1)), power_of_two(N_BITS - 1 - exponent));

        let mut differences = [[0; D]; N];
        let mut is_exact = true;
        let mut bits = 0;
        for (difference, point) in differences.iter_mut().zip(points) {
            for axis in 0..D {
                let (rounded, tail) = two_difference(point[axis], origin[axis]);
                let integers = ((rounded * scale) as i64, (tail * scale) as i64);
                // Scaled back, as the scaled number may have underflowed.
                is_exact &= integers.0 as f64 * unit == rounded && integers.1 as f64 * unit == tail;
                let sum = integers.0 + integers.1;
                bits |= sum;
                difference[axis] = sum;
            }
        }
        if !is_exact {
            return None;
        }
        let shift = bits.trailing_zeros() % i64::BITS;
        differences.as_flattened_mut().iter_mut().for_each(|x| *x >>= shift);
        Some(Self { differences, n_bits: N_BITS as u32 - shift.min(N_BITS as u32) })
    }

    /// The differences modulo a power of two.
    pub fn modular<M: Modular>(&self) -> [[M; D]; N] {
        self.differences.map(|difference| difference.map(|x| M::from(i128::from(x))))
    }
}

/// Differences of points as integers in a unit of their own, of more bits than [`Scaled`] has room for.
pub(super) struct LongScaled<const D: usize, const N: usize> {
    differences: [[i128; D]; N],
    pub n_bits: u32,
}

impl<const D: usize, const N: usize> LongScaled<D, N> {
    /// The differences from `origin` to `points` if all of them are multiples of 2⁻¹⁰⁹ times the largest power of two
    /// not above `extent`. The latter bounds their magnitudes, up to rounding; it must not be too small.
    pub fn new(origin: &[f64; D], points: [&[f64; D]; N], extent: f64) -> Option<Self> {
        if extent < MIN_EXTENT {
            return None;
        }
        let lowest = exponent_of(extent) - (N_LONG_BITS - 1);
        let mut differences = [[0; D]; N];
        let mut bits = 0;
        for (difference, point) in differences.iter_mut().zip(points) {
            for axis in 0..D {
                let (rounded, tail) = two_difference(point[axis], origin[axis]);
                let sum = in_units(rounded, lowest)? + in_units(tail, lowest)?;
                bits |= sum;
                difference[axis] = sum;
            }
        }
        let shift = bits.trailing_zeros() % i128::BITS;
        differences.as_flattened_mut().iter_mut().for_each(|x| *x >>= shift);
        Some(Self { differences, n_bits: N_LONG_BITS as u32 - shift.min(N_LONG_BITS as u32) })
    }

    /// The differences modulo a power of two.
    pub fn modular<M: Modular>(&self) -> [[M; D]; N] {
        self.differences.map(|difference| difference.map(M::from))
    }

    /// Bits of a determinant of degree five of differences within `extent`, sign included, where neither the rounded
    /// one nor its error exceeds `bound`, a normal number.
    pub fn n_bits_within(&self, bound: f64, extent: f64) -> i32 {
        let unit = exponent_of(extent) - (self.n_bits as i32 - 1);
        // Twice the bound is less than two to the power of its exponent and two.
        exponent_of(bound) + 2 - 5 * unit + 1
    }
}

/// A number of magnitude below 2¹¹¹ units in units of 2^`lowest`, if it is a multiple of these.
fn in_units(x: f64, lowest: i32) -> Option<i128> {
    if x == 0.0 {
        return Some(0);
    }
    let exponent = exponent_of(x.abs());
    let mantissa = x.to_bits() & ((1 << (f64::MANTISSA_DIGITS - 1)) - 1) | 1 << (f64::MANTISSA_DIGITS - 1);
    // How far the last bit of the mantissa is above the unit.
    let shift = exponent - (f64::MANTISSA_DIGITS as i32 - 1) - lowest;
    // Numbers that are not normal are below any unit.
    let is_multiple =
        shift >= 0 || shift > -(f64::MANTISSA_DIGITS as i32) && mantissa.trailing_zeros() as i32 >= -shift;
    if !is_multiple {
        return None;
    }
    let magnitude = if shift >= 0 { i128::from(mantissa) << shift } else { i128::from(mantissa >> -shift) };
    Some(if x < 0.0 { -magnitude } else { magnitude })
}

/// Rounded difference and its error (Knuth).
#[inline(always)]
pub(super) fn two_difference(a: f64, b: f64) -> (f64, f64) {
    let difference = a - b;
    let b_part = a - difference;
    let a_part = difference + b_part;
    (difference, (a - a_part) + (b_part - b))
}

/// The rounded value of a determinant, which is near the exact one, with the sign of that.
pub(super) fn with_sign(rounded: f64, sign: Ordering) -> f64 {
    let magnitude = rounded.abs().max(f64::MIN_POSITIVE);
    match sign {
        Ordering::Less => -magnitude,
        Ordering::Equal => 0.0,
        Ordering::Greater => magnitude,
    }
}

/// An integer modulo a power of two.
pub(super) trait Modular: Copy + From<i128> {
    fn plus(self, other: Self) -> Self;
    fn minus(self, other: Self) -> Self;
    fn times(self, other: Self) -> Self;
    /// The sign of the integer that is congruent and smallest in magnitude.
    fn sign(self) -> Ordering;
}

/// Modulo 2⁶⁴ or 2¹²⁸, in two's complement.
#[derive(Clone, Copy)]
pub(super) struct Short<I>(I);

macro_rules! modular {
    ($integer:ty) => {
        impl From<i128> for Short<$integer> {
            #[inline(always)]
            fn from(x: i128) -> Self {
                Short(x as $integer)
            }
        }

        impl Modular for Short<$integer> {
            #[inline(always)]
            fn plus(self, other: Self) -> Self {
                Short(self.0.wrapping_add(other.0))
            }

            #[inline(always)]
            fn minus(self, other: Self) -> Self {
                Short(self.0.wrapping_sub(other.0))
            }

            #[inline(always)]
            fn times(self, other: Self) -> Self {
                Short(self.0.wrapping_mul(other.0))
            }

            #[inline(always)]
            fn sign(self) -> Ordering {
                self.0.cmp(&0)
            }
        }
    };
}
modular!(i64);
modular!(i128);

/// Modulo 2⁶⁴ᴺ, in two's complement; the lowest limb first.
#[derive(Clone, Copy)]
pub(super) struct Limbs<const N: usize>([u64; N]);

impl<const N: usize> From<i128> for Limbs<N> {
    #[inline]
    fn from(x: i128) -> Self {
        Limbs(std::array::from_fn(|k| (x >> (64 * k).min(127)) as u64))
    }
}

impl<const N: usize> Modular for Limbs<N> {
    #[inline]
    fn plus(mut self, other: Self) -> Self {
        let mut carry = false;
        for (x, y) in self.0.iter_mut().zip(other.0) {
            let (partial, first) = x.overflowing_add(y);
            let (whole, second) = partial.overflowing_add(u64::from(carry));
            (*x, carry) = (whole, first | second);
        }
        self
    }

    #[inline]
    fn minus(mut self, other: Self) -> Self {
        let mut borrow = false;
        for (x, y) in self.0.iter_mut().zip(other.0) {
            let (partial, first) = x.overflowing_sub(y);
            let (whole, second) = partial.overflowing_sub(u64::from(borrow));
            (*x, borrow) = (whole, first | second);
        }
        self
    }

    #[inline]
    fn times(self, other: Self) -> Self {
        let mut product = [0; N];
        for (i, &x) in self.0.iter().enumerate() {
            let mut carry = 0;
            for (sum, &y) in product[i..].iter_mut().zip(&other.0) {
                // (2⁶⁴ - 1)² + 2 (2⁶⁴ - 1) is 2¹²⁸ - 1.
                let whole = u128::from(x) * u128::from(y) + u128::from(*sum) + u128::from(carry);
                (*sum, carry) = (whole as u64, (whole >> 64) as u64);
            }
        }
        Limbs(product)
    }

    #[inline]
    fn sign(self) -> Ordering {
        if self.0[N - 1] >> 63 == 1 {
            Ordering::Less
        } else if self.0 == [0; N] {
            Ordering::Equal
        } else {
            Ordering::Greater
        }
    }
}

/// An integer modulo 2²⁵⁶, in two's complement, that is multiplied by such as fit `i128`.
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

    /// The sign of the integer that is congruent and smallest in magnitude.
    pub fn sign(self) -> Ordering {
        (self.high as i128).cmp(&0).then(self.low.cmp(&0))
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
    use crate::random::Rng;

    #[test]
    fn wide_arithmetic_is_modular() {
        let (p, q) = (i128::MAX - 12_345, i128::MIN + 67_890);
        // (p + q)(p - q) = p p - q q, where the differences have been spelt out.
        let sum = p + q;
        let left = Wide::from(p).times(sum).minus(Wide::from(q).times(sum));
        let right = Wide::from(p).times(p).minus(Wide::from(q).times(q));
        assert_eq!((left.high, left.low), (right.high, right.low));
        assert_eq!(Wide::from(-3).times(1 << 100).sign(), Ordering::Less);
        assert_eq!(Wide::from(1 << 100).times(-(1 << 101)).sign(), Ordering::Less);
        assert_eq!(Wide::from(1 << 100).times(1 << 101).sign(), Ordering::Greater);
        assert_eq!(Wide::from(-1).plus(Wide::from(1)).sign(), Ordering::Equal);
    }

    #[test]
    fn limbs_are_those_of_num_bigint() {
        const N: usize = 6;
        let rng = &mut Rng::new(3);
        let modulus = num_bigint::BigInt::from(1) << (64 * N);
        let big = |x: Limbs<N>| {
            let bytes: Vec<u8> = x.0.iter().flat_map(|limb| limb.to_le_bytes()).collect();
            num_bigint::BigInt::from_signed_bytes_le(&bytes)
        };
        // The representative that is smallest in magnitude.
        let reduced = |x: num_bigint::BigInt| {
            let half = &modulus / 2;
            ((x + &half) % &modulus + &modulus) % &modulus - half
        };
        for _ in 0..20_000 {
            let mut difference = || {
                let bits = i128::from(rng.next()) << 64 | i128::from(rng.next());
                bits >> (rng.next() % 127)
            };
            let [a, b, c, d] = std::array::from_fn(|_| difference());
            let [p, q, r, s] = [a, b, c, d].map(Limbs::<N>::from);
            let [w, x, y, z] = [a, b, c, d].map(num_bigint::BigInt::from);
            assert_eq!(big(p), w);
            let (left, right) = (p.times(q).times(r).minus(s), &w * &x * &y - &z);
            assert_eq!(big(left), reduced(right.clone()));
            let (sum, expected) = (left.times(left).plus(p), reduced(&right * &right + &w));
            assert_eq!(big(sum), expected);
            assert_eq!(sum.sign(), expected.cmp(&num_bigint::BigInt::ZERO));
        }
    }

    #[test]
    fn scaled_differences_are_exact_or_refused() {
        let extent = 1.0 + 2f64.powi(-30);
        let scaled = Scaled::new(&[-2f64.powi(-30)], [&[1.0], &[2f64.powi(-58)]], extent).unwrap();
        let half = 1i64 << 58;
        assert_eq!(scaled.differences, [[half + (half >> 30)], [1 + (half >> 30)]]);
        assert_eq!(scaled.n_bits, 59);
        assert!(Scaled::new(&[0.0], [&[1.0], &[2f64.powi(-59)]], 1.0).is_none());
        let least = f64::from_bits(1);
        assert!(Scaled::new(&[0.0], [&[1e57], &[least]], 1e57).is_none(), "it scales to zero");
        assert!(Scaled::new(&[0.0], [&[least]], least).is_none());
        let few = Scaled::new(&[0.5], [&[3.0], &[-4.5]], 7.5).unwrap();
        assert_eq!((few.differences, few.n_bits), ([[5], [-10]], 4));
        let none = Scaled::new(&[7.5], [&[7.5]], 7.5).unwrap();
        assert_eq!(none.differences, [[0]]);
    }

    #[test]
    fn long_differences_are_exact_or_refused() {
        let extent = 1.0 + 2f64.powi(-30);
        let scaled = LongScaled::new(&[-2f64.powi(-30)], [&[1.0], &[2f64.powi(-109)]], extent).unwrap();
        let half = 1i128 << 109;
        assert_eq!(scaled.differences, [[half + (half >> 30)], [1 + (half >> 30)]]);
        assert_eq!(scaled.n_bits, 110);
        assert!(LongScaled::new(&[0.0], [&[1.0], &[2f64.powi(-110)]], 1.0).is_none());
        let least = f64::from_bits(1);
        assert!(LongScaled::new(&[0.0], [&[1e57], &[least]], 1e57).is_none());
        assert!(LongScaled::new(&[0.0], [&[least]], least).is_none());
        let few = LongScaled::new(&[0.5], [&[3.0], &[-4.5]], 7.5).unwrap();
        assert_eq!((few.differences, few.n_bits), ([[5], [-10]], 4));
        let rng = &mut Rng::new(5);
        for _ in 0..20_000 {
            // Both formats agree where both take it.
            let mut any = || (rng.unit() - 0.5) * 2f64.powi(-(rng.below(70) as i32));
            let (origin, point) = ([any()], [any()]);
            let extent = (origin[0] - point[0]).abs();
            if let Some(short) = Scaled::new(&origin, [&point], extent) {
                let long = LongScaled::new(&origin, [&point], extent).unwrap();
                assert_eq!(long.differences, short.differences.map(|row| row.map(i128::from)));
                assert_eq!(long.n_bits, short.n_bits);
            }
        }
    }
}
