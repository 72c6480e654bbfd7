//! The last stage: determinants in integers that are long enough for any.
//!
//! Where a coordinate is so small that expansions would underflow, the coordinates of a call are written as
//! integers in units of the smallest last bit among them. This costs microseconds, but it takes a near tie between
//! points of which one is at a place like 10⁻⁶⁴.
//!
//! The integers are of fixed size and on the stack, as there is no way to report from here that memory has run out. A
//! coordinate is of magnitude at most 10⁵⁷ < 2¹⁹⁰ and a multiple of 2⁻¹⁰⁷⁴, so at most 2¹²⁶⁴ units; a difference is below
//! 2¹²⁶⁵. In space the greatest determinant is `insphere`. Each of its four terms is the product of a square, three
//! products of two differences, and a volume, six of three: below 4 · 3 · 6 · 2⁵·¹²⁶⁵ < 2⁶³³², and so are all sums on the way.
//! That fits 99 limbs of 64 bits, the sign apart.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Sub};

/// Whether expansions can evaluate a polynomial of the given degree in coordinates: whether coordinates other
/// than zero are large enough for products of so many to be multiples of 2⁻⁹⁶⁰.
#[inline]
pub(super) fn has_room<const D: usize, const N: usize>(points: [&[f64; D]; N], degree: u32) -> bool {
    // A number of 53 bits that is at least 2⁵² units is a multiple of the unit.
    let least = 2f64.powi(52 - 960 / degree as i32);
    points.into_iter().flatten().all(|&x| x == 0.0 || x.abs() >= least)
}

/// `orient2d`, of which the rounded value is given.
#[cold]
#[inline(never)]
pub(super) fn orient2d(rounded: f64, [a, b, c]: [&[f64; 2]; 3]) -> f64 {
    let [u, v] = differences(a, [b, c]);
    with_sign(rounded, &minor(&u, &v))
}

/// `incircle`, of which the rounded value is given.
#[cold]
#[inline(never)]
pub(super) fn incircle(rounded: f64, [a, b, c, d]: [&[f64; 2]; 4]) -> f64 {
    let [u, v, w] = differences(a, [b, c, d]);
    let det = square(&v) * minor(&u, &w) - square(&u) * minor(&v, &w) - square(&w) * minor(&u, &v);
    with_sign(rounded, &det)
}

/// `orient3d`, of which the rounded value is given.
#[cold]
#[inline(never)]
pub(super) fn orient3d(rounded: f64, [a, b, c, d]: [&[f64; 3]; 4]) -> f64 {
    let [u, v, w] = differences(a, [b, c, d]);
    with_sign(rounded, &volume(&u, &v, &w))
}

/// `insphere`, of which the rounded value is given.
#[cold]
#[inline(never)]
pub(super) fn insphere(rounded: f64, [a, b, c, d, e]: [&[f64; 3]; 5]) -> f64 {
    let [u, v, w, s] = differences(a, [b, c, d, e]);
    let det = square(&u) * volume(&v, &w, &s) - square(&v) * volume(&u, &w, &s)
        + square(&w) * volume(&u, &v, &s)
        - square(&s) * volume(&u, &v, &w);
    with_sign(rounded, &det)
}

#[cold]
#[inline(never)]
pub(super) fn compare_distance<const D: usize>(q: &[f64; D], a: &[f64; D], b: &[f64; D]) -> Ordering {
    let [to_a, to_b] = differences(q, [a, b]);
    (square(&to_a) - square(&to_b)).sign()
}

#[cold]
#[inline(never)]
pub(super) fn is_collinear3([a, b, c]: [&[f64; 3]; 3]) -> bool {
    let [[x, y, z], [p, q, r]] = differences(a, [b, c]);
    x * q == y * p && y * r == z * q && z * p == x * r
}

/// The differences from `origin` to `points` in a unit of their own.
fn differences<const D: usize, const N: usize>(
    origin: &[f64; D],
    points: [&[f64; D]; N],
) -> [[Integer; D]; N] {
    let coordinates = || points.into_iter().flatten().chain(origin).filter(|&&x| x != 0.0);
    let unit = coordinates().map(|&x| decode(x).1).min().unwrap_or(0);
    let integer = |x: f64| {
        let (mantissa, exponent) = decode(x);
        if mantissa == 0 { Integer::ZERO } else { Integer::shifted(mantissa, (exponent - unit) as u32) }
    };
    let origin: [Integer; D] = std::array::from_fn(|axis| integer(origin[axis]));
    points.map(|p| std::array::from_fn(|axis| integer(p[axis]) - origin[axis]))
}

/// `x` as mantissa · 2^exponent.
fn decode(x: f64) -> (i64, i32) {
    const MANTISSA_BITS: u32 = f64::MANTISSA_DIGITS - 1;
    let magnitude = x.abs().to_bits();
    let fraction = (magnitude & ((1 << MANTISSA_BITS) - 1)) as i64;
    // Subnormal numbers share the exponent of the smallest normal ones and lack their leading bit.
    let (biased, leading) = match (magnitude >> MANTISSA_BITS) as i32 {
        0 => (1, 0),
        biased => (biased, 1 << MANTISSA_BITS),
    };
    let mantissa = leading | fraction;
    let exponent = biased - (f64::MAX_EXP - 1) - MANTISSA_BITS as i32;
    (if x < 0.0 { -mantissa } else { mantissa }, exponent)
}

/// The rounded value, which is near the exact one, with the sign of that.
fn with_sign(rounded: f64, exact: &Integer) -> f64 {
    let magnitude = rounded.abs().max(f64::MIN_POSITIVE);
    match exact.sign() {
        Ordering::Less => -magnitude,
        Ordering::Equal => 0.0,
        Ordering::Greater => magnitude,
    }
}

fn square<const D: usize>(p: &[Integer; D]) -> Integer {
    p.iter().fold(Integer::ZERO, |sum, &x| sum + x * x)
}

/// Minor of the first two columns.
fn minor<const D: usize>(p: &[Integer; D], q: &[Integer; D]) -> Integer {
    p[0] * q[1] - p[1] * q[0]
}

/// Determinant of three differences.
fn volume(u: &[Integer; 3], v: &[Integer; 3], w: &[Integer; 3]) -> Integer {
    minor(v, w) * u[2] - minor(u, w) * v[2] + minor(u, v) * w[2]
}

/// Limbs of the greatest integer (see the module's documentation).
const LIMBS: usize = 99;

/// An integer: sign and magnitude.
#[derive(Clone, Copy, Debug)]
struct Integer {
    /// False for zero.
    is_negative: bool,
    /// Limbs from the lowest to the highest that is not zero.
    n: usize,
    /// The lowest limb first. Those from `n` on are zero.
    limbs: [u64; LIMBS],
}

impl Integer {
    const ZERO: Self = Integer { is_negative: false, n: 0, limbs: [0; LIMBS] };

    /// `x` · 2^`shift`.
    fn shifted(x: i64, shift: u32) -> Self {
        let mut integer = Integer { is_negative: x < 0, ..Integer::ZERO };
        let (at, magnitude) = ((shift / 64) as usize, u128::from(x.unsigned_abs()) << (shift % 64));
        (integer.limbs[at], integer.limbs[at + 1]) = (magnitude as u64, (magnitude >> 64) as u64);
        integer.trimmed(at + 2)
    }

    /// With `n` set, where no limb from this one on is other than zero.
    fn trimmed(mut self, mut n: usize) -> Self {
        while n > 0 && self.limbs[n - 1] == 0 {
            n -= 1;
        }
        self.n = n;
        self.is_negative &= n > 0;
        self
    }

    fn magnitude(&self) -> &[u64] {
        &self.limbs[..self.n]
    }

    /// How it compares with zero.
    fn sign(&self) -> Ordering {
        if self.is_negative { Ordering::Less } else { self.n.cmp(&0) }
    }

    fn compare_magnitude(&self, other: &Self) -> Ordering {
        let (own, others) = (self.magnitude().iter().rev(), other.magnitude().iter().rev());
        self.n.cmp(&other.n).then_with(|| own.cmp(others))
    }

    /// Sum of magnitudes, with the sign of this one.
    fn plus_magnitude(&self, other: &Self) -> Self {
        let n = self.n.max(other.n);
        let mut sum = *self;
        let mut carry = false;
        for (x, &y) in sum.limbs[..n].iter_mut().zip(&other.limbs[..n]) {
            let (partial, first) = x.overflowing_add(y);
            let (whole, second) = partial.overflowing_add(u64::from(carry));
            (*x, carry) = (whole, first | second);
        }
        if carry {
            sum.limbs[n] = 1;
        }
        sum.n = n + usize::from(carry);
        sum
    }

    /// Difference of magnitudes, the other one not greater, with the sign of this one.
    fn minus_magnitude(&self, other: &Self) -> Self {
        let n = self.n;
        let mut difference = *self;
        let mut borrow = false;
        for (x, &y) in difference.limbs[..n].iter_mut().zip(&other.limbs[..n]) {
            let (partial, first) = x.overflowing_sub(y);
            let (whole, second) = partial.overflowing_sub(u64::from(borrow));
            (*x, borrow) = (whole, first | second);
        }
        debug_assert!(!borrow);
        difference.trimmed(n)
    }

    #[inline(never)]
    fn sum(&self, other: &Self, is_negated: bool) -> Self {
        let is_other_negative = other.is_negative ^ is_negated;
        if self.n == 0 || self.is_negative == is_other_negative {
            let sum = self.plus_magnitude(other);
            return Integer { is_negative: is_other_negative & (sum.n > 0), ..sum };
        }
        match self.compare_magnitude(other) {
            Ordering::Less => {
                let difference = other.minus_magnitude(self);
                Integer { is_negative: is_other_negative, ..difference }
            }
            Ordering::Equal => Integer::ZERO,
            Ordering::Greater => self.minus_magnitude(other),
        }
    }

    #[inline(never)]
    fn product(&self, other: &Self) -> Self {
        let is_negative = self.is_negative != other.is_negative;
        let mut product = Integer { is_negative, ..Integer::ZERO };
        for (k, &x) in self.magnitude().iter().enumerate() {
            let mut carry = 0;
            let (row, rest) = product.limbs[k..].split_at_mut(other.n);
            for (sum, &y) in row.iter_mut().zip(other.magnitude()) {
                // (2⁶⁴ - 1)² + 2 (2⁶⁴ - 1) is 2¹²⁸ - 1.
                let whole = u128::from(x) * u128::from(y) + u128::from(*sum) + u128::from(carry);
                (*sum, carry) = (whole as u64, (whole >> 64) as u64);
            }
            if carry != 0 {
                rest[0] = carry;
            }
        }
        product.trimmed((self.n + other.n).min(LIMBS))
    }
}

impl PartialEq for Integer {
    fn eq(&self, other: &Self) -> bool {
        self.is_negative == other.is_negative && self.magnitude() == other.magnitude()
    }
}

impl Add for Integer {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.sum(&other, false)
    }
}

impl Sub for Integer {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.sum(&other, true)
    }
}

impl Mul for Integer {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.product(&other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_decode_to_themselves() {
        for x in [1.0, -0.1, 1e57, f64::MIN_POSITIVE, f64::MIN_POSITIVE.next_down(), -f64::from_bits(1)] {
            let (mantissa, exponent) = decode(x);
            // In two steps, as the power of two alone may underflow.
            let (first, second) = (exponent / 2, exponent - exponent / 2);
            assert_eq!(mantissa as f64 * 2f64.powi(first) * 2f64.powi(second), x);
        }
    }

    #[test]
    fn integers_are_those_of_num_bigint() {
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = state;
            z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^ z >> 31
        };
        // Differences: random, or with long runs of equal bits, so that carries go far.
        let mut difference = || {
            let mut x = Integer::ZERO;
            let n_bits = random() as usize % 1266;
            let is_run = random().is_multiple_of(3);
            let fill = random();
            for (k, limb) in x.limbs[..n_bits.div_ceil(64)].iter_mut().enumerate() {
                let any = if !is_run { random() } else { 0u64.wrapping_sub(fill >> k & 1) };
                *limb = any & u64::MAX >> (64 * (k + 1)).saturating_sub(n_bits);
            }
            x.is_negative = random().is_multiple_of(2);
            x.trimmed(LIMBS)
        };
        let big = |x: &Integer| {
            let bytes: Vec<u8> = x.limbs.iter().flat_map(|limb| limb.to_le_bytes()).collect();
            let sign = if x.is_negative { num_bigint::Sign::Minus } else { num_bigint::Sign::Plus };
            assert!(x.limbs[x.n..].iter().all(|&limb| limb == 0) && (x.n == 0 || x.limbs[x.n - 1] != 0));
            num_bigint::BigInt::from_bytes_le(sign, &bytes)
        };
        let check = |x: &Integer, expected: &num_bigint::BigInt| {
            assert_eq!(big(x), *expected);
            let sign = match x.sign() {
                Ordering::Less => num_bigint::Sign::Minus,
                Ordering::Equal => num_bigint::Sign::NoSign,
                Ordering::Greater => num_bigint::Sign::Plus,
            };
            assert_eq!(sign, expected.sign());
        };
        for _ in 0..40_000 {
            let [a, b, c, d, e] = std::array::from_fn(|_| difference());
            let [p, q, r, s, t] = [&a, &b, &c, &d, &e].map(big);
            let (ab, cde, pq, rst) = (a * b, c * d * e, &p * &q, &r * &s * &t);
            check(&ab, &pq);
            check(&(a + b), &(&p + &q));
            check(&(a - b), &(&p - &q));
            check(&(ab - c), &(&pq - &r));
            check(&(cde + ab), &(&rst + &pq));
            let (whole, expected) = (ab * cde, pq * rst);
            check(&whole, &expected);
            check(&(whole - ab), &(&expected - &p * &q));
            check(&(whole - whole), &num_bigint::BigInt::ZERO);
            assert!(whole == cde * b * a);
        }
    }

    /// The greatest determinant there is fits.
    #[test]
    fn integers_are_long_enough() {
        let greatest = Integer::shifted((1 << 53) - 1, 1265 - 53);
        let degree_5 = greatest * greatest * greatest * greatest * greatest;
        let sum = (0..72).fold(Integer::ZERO, |sum, _| sum + degree_5);
        assert_eq!(sum.n, LIMBS);
        let corner = [crate::predicates::MAX_MAGNITUDE, -crate::predicates::MAX_MAGNITUDE];
        let least = f64::from_bits(1);
        let p = |k: usize| [corner[k & 1], corner[k >> 1 & 1], corner[k >> 2 & 1]];
        let near = [corner[0], corner[0], least];
        for k in 0..8 {
            let points = [p(k), p(k ^ 1), p(k ^ 2), p(k ^ 4), near];
            assert_ne!(insphere(1.0, points.each_ref()), 0.0);
            assert_eq!(insphere(1.0, [p(k), p(k ^ 1), p(k ^ 2), p(k ^ 4), p(k ^ 7)].each_ref()), 0.0);
        }
    }

    #[test]
    fn room_depends_on_degree() {
        assert!(has_room([&[0.0, 1.0], &[-1e-128, 1e57]], 2));
        assert!(!has_room([&[1e-130, 1.0]], 2));
        assert!(has_room([&[1e-42, 1.0]], 5) && !has_room([&[-1e-43, 1.0]], 5));
    }
}
