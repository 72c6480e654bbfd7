//! The last stage: determinants in integers that are long enough for any.
//!
//! Where a coordinate is so small that expansions would underflow, the coordinates of a call are written as
//! integers in units of the smallest last bit among them. This costs microseconds, but it takes a near tie between
//! points of which one is at a place like 10⁻⁶⁴. `insphere` comes here without trying expansions: where its
//! differences do not fit shorter integers, these are as fast, and take a fifth of the stack.
//!
//! The integers are of fixed size and on the stack, as there is no way to report from here that memory has run out. A
//! coordinate is of magnitude at most 10⁵⁷ < 2¹⁹⁰ and a multiple of 2⁻¹⁰⁷⁴, so at most 2¹²⁶⁴ units; a difference is
//! below 2¹²⁶⁵. In space the greatest determinant is `insphere`. Each of its four terms is the product of a square,
//! three products of two differences, and a volume, six of three: below 4 · 3 · 6 · 2⁵·¹²⁶⁵ < 2⁶³³², and so are all
//! sums on the way. That fits 99 limbs of 64 bits, the sign apart. Integers of very different lengths are made on the
//! way, so their limbs follow each other in one [`LimbRoom`] for all of a determinant, or of a term of `insphere`.

mod limbs;

use std::cmp::Ordering;
use std::ops::{Add, Mul, Sub};

use super::integer::with_sign;
use limbs::{FEW_LIMBS, POWER_LIMBS, TERM_LIMBS};
pub(super) use limbs::{
    Integer, LimbRoom, MOST_LIMBS, POWER_BOX_LIMBS, POWER_CELL_LIMBS, POWER_RADIUS_LIMBS, POWER_REACH_LIMBS,
};

/// Whether expansions can evaluate a polynomial of the given degree in coordinates: whether coordinates other
/// than zero are large enough for products of so many to be multiples of 2⁻⁹⁶⁰.
#[inline]
pub(super) fn has_room<P: AsRef<[f64]> + ?Sized, const N: usize>(points: [&P; N], degree: u32) -> bool {
    // A number of 53 bits that is at least 2⁵² units is a multiple of the unit.
    let least = 2f64.powi(52 - 960 / degree as i32);
    points.into_iter().flat_map(P::as_ref).all(|&x| x == 0.0 || x.abs() >= least)
}

/// `orient2d`, of which the rounded value is given.
#[cold]
#[inline(never)]
pub(super) fn orient2d(rounded: f64, [a, b, c]: [&[f64; 2]; 3]) -> f64 {
    let room = LimbRoom::<FEW_LIMBS>::of_any_size();
    let [u, v] = differences(&room, a, [b, c]);
    with_sign(rounded, minor(&u, &v).sign())
}

/// The sign of the cross product of two differences, each from the second point of a pair to the first.
#[cold]
#[inline(never)]
pub(super) fn sign_of_cross(pairs: [[&[f64; 2]; 2]; 2]) -> Ordering {
    let room = LimbRoom::<FEW_LIMBS>::of_any_size();
    // Each in a unit of its own, which does not change the sign.
    let [[u], [v]] = pairs.map(|[p, q]| differences(&room, q, [p]));
    minor(&u, &v).sign()
}

/// `incircle`, of which the rounded value is given.
#[cold]
#[inline(never)]
pub(super) fn incircle(rounded: f64, [a, b, c, d]: [&[f64; 2]; 4]) -> f64 {
    let room = LimbRoom::<FEW_LIMBS>::of_any_size();
    let [u, v, w] = differences(&room, a, [b, c, d]);
    let det = square(&v) * minor(&u, &w) - square(&u) * minor(&v, &w) - square(&w) * minor(&u, &v);
    with_sign(rounded, det.sign())
}

/// `orient3d`, of which the rounded value is given.
#[cold]
#[inline(never)]
pub(super) fn orient3d(rounded: f64, [a, b, c, d]: [&[f64; 3]; 4]) -> f64 {
    let room = LimbRoom::<FEW_LIMBS>::of_any_size();
    let [u, v, w] = differences(&room, a, [b, c, d]);
    with_sign(rounded, volume(&u, &v, &w).sign())
}

/// `insphere`, of which the rounded value is given.
#[cold]
#[inline(never)]
pub(super) fn insphere(rounded: f64, points: [&[f64; 3]; 5]) -> f64 {
    let room = LimbRoom::<FEW_LIMBS>::of_any_size();
    with_sign(rounded, insphere_in(&room, points).sign())
}

fn insphere_in<'r>(room: &'r LimbRoom<FEW_LIMBS>, [a, b, c, d, e]: [&[f64; 3]; 5]) -> Integer<'r, FEW_LIMBS> {
    let [u, v, w, s] = differences(room, a, [b, c, d, e]);
    insphere_term(&u, [&v, &w, &s]) - insphere_term(&v, [&u, &w, &s]) + insphere_term(&w, [&u, &v, &s])
        - insphere_term(&s, [&u, &v, &w])
}

/// A square times a volume, in the room of these; all that is made on the way is elsewhere, for the time of this call.
#[inline(never)]
fn insphere_term<'r, const N: usize>(
    p: &[Integer<'r, N>; 3],
    others: [&[Integer<'r, N>; 3]; 3],
) -> Integer<'r, N> {
    let room = LimbRoom::<TERM_LIMBS>::of_any_size();
    let [u, v, w] = others.map(|q| q.map(|x| x.within(&room)));
    (square(&p.map(|x| x.within(&room))) * volume(&u, &v, &w)).copied_to(p[0].room)
}

/// `in_power_circle` (`power.rs`), of which the rounded value is given.
#[cold]
#[inline(never)]
pub(super) fn in_power_circle(rounded: f64, [a, b, c, d]: [&[f64; 2]; 4], weights: &[f64; 4]) -> f64 {
    let room = LimbRoom::<POWER_LIMBS>::of_any_size();
    let (_, [u, v, w], [of_u, of_v, of_w]) = lifted(&room, d, [a, b, c], weights);
    let det = of_u * minor(&v, &w) + of_v * minor(&w, &u) + of_w * minor(&u, &v);
    with_sign(rounded, det.sign())
}

/// `in_power_sphere` (`power.rs`), of which the rounded value is given.
#[cold]
#[inline(never)]
pub(super) fn in_power_sphere(rounded: f64, [a, b, c, d, e]: [&[f64; 3]; 5], weights: &[f64; 5]) -> f64 {
    let room = LimbRoom::<POWER_LIMBS>::of_any_size();
    let (_, [u, v, w, s], [of_u, of_v, of_w, of_s]) = lifted(&room, e, [a, b, c, d], weights);
    let det = lifted_term(of_u, [&v, &w, &s]) - lifted_term(of_v, [&u, &w, &s])
        + lifted_term(of_w, [&u, &v, &s])
        - lifted_term(of_s, [&u, &v, &w]);
    with_sign(rounded, det.sign())
}

/// The differences from a point to others, after the exponent of their unit, and in its square their squares, less what their weights
/// are more than that of the point, which comes after theirs. The unit's square divides any numbers after that as well.
pub(super) fn lifted<'r, const D: usize, const N: usize, const LIMBS: usize>(
    room: &'r LimbRoom<LIMBS>,
    origin: &[f64; D],
    points: [&[f64; D]; N],
    weights: &[f64],
) -> (i32, [[Integer<'r, LIMBS>; D]; N], [Integer<'r, LIMBS>; N]) {
    let of_weights = weights.iter().filter(|&&weight| weight != 0.0).map(|&weight| decode(weight).1);
    let most = of_weights.min().map_or(i32::MAX, |exponent| exponent.div_euclid(2));
    let (unit, differences) = differences_in_units(room, origin, points, most);
    let weight = |k: usize| in_square_of_unit(room, weights[k], unit);
    let own = weight(N);
    (unit, differences, std::array::from_fn(|k| square(&differences[k]) - (weight(k) - own)))
}

/// A number in the square of a unit, which divides it.
pub(super) fn in_square_of_unit<const LIMBS: usize>(
    room: &LimbRoom<LIMBS>,
    x: f64,
    unit: i32,
) -> Integer<'_, LIMBS> {
    let (mantissa, exponent) = decode(x);
    Integer::shifted(room, mantissa, if mantissa == 0 { 0 } else { (exponent - 2 * unit) as u32 })
}

/// A lift times a volume, in the room of these; all that is made on the way is elsewhere, for the time of this call.
#[inline(never)]
fn lifted_term<'r, const N: usize>(
    lift: Integer<'r, N>,
    others: [&[Integer<'r, N>; 3]; 3],
) -> Integer<'r, N> {
    let room = LimbRoom::<TERM_LIMBS>::of_any_size();
    let [u, v, w] = others.map(|q| q.map(|x| x.within(&room)));
    (lift.within(&room) * volume(&u, &v, &w)).copied_to(lift.room)
}

#[cold]
#[inline(never)]
pub(super) fn compare_distance(points: [&[f64]; 3]) -> Ordering {
    // An axis without extent adds no distance.
    let in_space = |p: &[f64]| std::array::from_fn(|axis| p.get(axis).copied().unwrap_or(0.0));
    let [q, a, b]: [[f64; 3]; 3] = points.map(in_space);
    let room = LimbRoom::<FEW_LIMBS>::of_any_size();
    let [to_a, to_b] = differences(&room, &q, [&a, &b]);
    (square(&to_a) - square(&to_b)).sign()
}

/// `compare_power` (`distance.rs`).
#[cold]
#[inline(never)]
pub(super) fn compare_power<const D: usize>(
    q: &[f64; D],
    points: [&[f64; D]; 2],
    [of_a, of_b]: [f64; 2],
) -> Ordering {
    let room = LimbRoom::<POWER_LIMBS>::of_any_size();
    let (_, _, [to_a, to_b]) = lifted(&room, q, points, &[of_a, of_b, 0.0]);
    (to_a - to_b).sign()
}

/// Whether the squared distance of two points is at most `squared`, which is finite.
#[cold]
#[inline(never)]
pub(super) fn is_within_distance(points: [&[f64]; 2], squared: f64) -> bool {
    // An axis without extent adds no distance.
    let in_space = |p: &[f64]| std::array::from_fn(|axis| p.get(axis).copied().unwrap_or(0.0));
    let [q, a]: [[f64; 3]; 2] = points.map(in_space);
    let room = LimbRoom::<FEW_LIMBS>::of_any_size();
    let (mantissa, exponent) = decode(squared);
    // The square of the unit must divide the given one.
    let (unit, [to_a]) = differences_in_units(&room, &q, [&a], exponent.div_euclid(2));
    let given = Integer::shifted(&room, mantissa, (exponent - 2 * unit) as u32);
    square(&to_a).compare_magnitude(&given) != Ordering::Greater
}

/// Compares the lengths of two vectors of integers below 2¹²⁴, each in units of a power of two of its axis.
#[cold]
#[inline(never)]
pub fn compare_lengths(v: &[i128; 3], w: &[i128; 3], exponents: &[i32; 3]) -> Ordering {
    const LOW_BITS: u32 = 62;
    let room = LimbRoom::new();
    let least = exponents.iter().fold(i32::MAX, |least, &x| least.min(x));
    let square_of = |axis: usize, x: i128| {
        let shift = (exponents[axis] - least) as u32;
        let low = Integer::shifted(&room, (x & ((1 << LOW_BITS) - 1)) as i64, shift);
        let whole = Integer::shifted(&room, (x >> LOW_BITS) as i64, shift + LOW_BITS) + low;
        whole * whole
    };
    let square = |v: &[i128; 3]| square_of(0, v[0]) + square_of(1, v[1]) + square_of(2, v[2]);
    (square(v) - square(w)).sign()
}

#[cold]
#[inline(never)]
pub(super) fn is_collinear3([a, b, c]: [&[f64; 3]; 3]) -> bool {
    let room = LimbRoom::<FEW_LIMBS>::of_any_size();
    let [[x, y, z], [p, q, r]] = differences(&room, a, [b, c]);
    x * q == y * p && y * r == z * q && z * p == x * r
}

/// The differences from `origin` to `points` in a unit of their own.
fn differences<'r, const D: usize, const N: usize, const LIMBS: usize>(
    room: &'r LimbRoom<LIMBS>,
    origin: &[f64; D],
    points: [&[f64; D]; N],
) -> [[Integer<'r, LIMBS>; D]; N] {
    differences_in_units(room, origin, points, i32::MAX).1
}

/// The differences from `origin` to `points`, after the exponent of their unit: the greatest one possible that is not
/// above `most`, unless all coordinates are zero.
pub(super) fn differences_in_units<'r, const D: usize, const N: usize, const LIMBS: usize>(
    room: &'r LimbRoom<LIMBS>,
    origin: &[f64; D],
    points: [&[f64; D]; N],
    most: i32,
) -> (i32, [[Integer<'r, LIMBS>; D]; N]) {
    let coordinates = || points.into_iter().flatten().chain(origin).filter(|&&x| x != 0.0);
    let unit = coordinates().map(|&x| decode(x).1).min().unwrap_or(0).min(most);
    let integer = |x: f64| {
        let (mantissa, exponent) = decode(x);
        Integer::shifted(room, mantissa, if mantissa == 0 { 0 } else { (exponent - unit) as u32 })
    };
    let origin: [_; D] = std::array::from_fn(|axis| integer(origin[axis]));
    (unit, points.map(|p| std::array::from_fn(|axis| integer(p[axis]) - origin[axis])))
}

/// `x` as mantissa · 2^exponent.
pub(super) fn decode(x: f64) -> (i64, i32) {
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

/// What determinants are evaluated in.
pub(super) trait Ring: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {}
impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>> Ring for T {}

pub(super) fn square<T: Ring, const D: usize>(p: &[T; D]) -> T {
    p[1..].iter().fold(p[0] * p[0], |sum, &x| sum + x * x)
}

/// Minor of the first two columns.
pub(super) fn minor<T: Ring, const D: usize>(p: &[T; D], q: &[T; D]) -> T {
    p[0] * q[1] - p[1] * q[0]
}

/// Determinant of three differences.
pub(super) fn volume<T: Ring>(u: &[T; 3], v: &[T; 3], w: &[T; 3]) -> T {
    minor(v, w) * u[2] - minor(u, w) * v[2] + minor(u, v) * w[2]
}

#[cfg(test)]
mod tests;
