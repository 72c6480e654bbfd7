//! The last stage: determinants in integers of any length.
//!
//! Where a coordinate is so small that expansions would underflow, the coordinates of a call are written as
//! integers in units of the smallest last bit among them. They have at most 1,264 bits. This costs
//! microseconds, but it takes a near tie between points of which one is at a place like 10⁻⁶⁴.

use num_bigint::{BigInt, Sign};
use std::cmp::Ordering;

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
    square(&to_a).cmp(&square(&to_b))
}

#[cold]
#[inline(never)]
pub(super) fn is_collinear3([a, b, c]: [&[f64; 3]; 3]) -> bool {
    let [[x, y, z], [p, q, r]] = differences(a, [b, c]);
    &x * &q == &y * &p && y * &r == &z * q && z * p == x * r
}

/// The differences from `origin` to `points` in a unit of their own.
fn differences<const D: usize, const N: usize>(
    origin: &[f64; D],
    points: [&[f64; D]; N],
) -> [[BigInt; D]; N] {
    let coordinates = || points.into_iter().flatten().chain(origin).filter(|&&x| x != 0.0);
    let unit = coordinates().map(|&x| decode(x).1).min().unwrap_or(0);
    let integer = |x: f64| {
        let (mantissa, exponent) = decode(x);
        if mantissa == 0 { BigInt::ZERO } else { BigInt::from(mantissa) << (exponent - unit) }
    };
    let origin: [BigInt; D] = std::array::from_fn(|axis| integer(origin[axis]));
    points.map(|p| std::array::from_fn(|axis| integer(p[axis]) - &origin[axis]))
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
fn with_sign(rounded: f64, exact: &BigInt) -> f64 {
    let magnitude = rounded.abs().max(f64::MIN_POSITIVE);
    match exact.sign() {
        Sign::Minus => -magnitude,
        Sign::NoSign => 0.0,
        Sign::Plus => magnitude,
    }
}

fn square<const D: usize>(p: &[BigInt; D]) -> BigInt {
    p.iter().map(|x| x * x).sum()
}

/// Minor of the first two columns.
fn minor<const D: usize>(p: &[BigInt; D], q: &[BigInt; D]) -> BigInt {
    &p[0] * &q[1] - &p[1] * &q[0]
}

/// Determinant of three differences.
fn volume(u: &[BigInt; 3], v: &[BigInt; 3], w: &[BigInt; 3]) -> BigInt {
    minor(v, w) * &u[2] - minor(u, w) * &v[2] + minor(u, v) * &w[2]
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
    fn room_depends_on_degree() {
        assert!(has_room([&[0.0, 1.0], &[-1e-128, 1e57]], 2));
        assert!(!has_room([&[1e-130, 1.0]], 2));
        assert!(has_room([&[1e-42, 1.0]], 5) && !has_room([&[-1e-43, 1.0]], 5));
    }
}
