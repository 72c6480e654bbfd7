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

#![allow(unsafe_code)]

use std::cell::{Cell, UnsafeCell};
use std::cmp::Ordering;
use std::mem::MaybeUninit;
use std::ops::{Add, Mul, Sub};

use super::integer::with_sign;

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

/// Limbs of all integers that a determinant takes, but for those of comparisons with a radius or a box.
///
/// A difference has 20 limbs, and a product as many as both factors; a sum takes one more than the longer term, which
/// stays zero (see the module's documentation), and so do numbers to be shifted. So a square is 3 · 40 + 2 · 41 in space and
/// 2 · 40 + 41 in the plane, as is a minor, and a volume three minors and 3 · 60 + 2 · 61. `incircle` has 8 coordinates and 6
/// differences of 21, three squares, three minors, three products of 80 and two sums of 81: 1,422. `insphere` has 15 and 12,
/// four terms of 100 and three sums of 101: 1,270. `orient3d` has 12 and 9, and a volume: 1,106. All others have fewer.
const FEW_LIMBS: usize = 1424;

/// Limbs of a term of `insphere`: a square, a volume, and a product of 100: 967. One with a lift takes no square, and a
/// product of 104.
const TERM_LIMBS: usize = 968;

/// Limbs of all integers that a determinant with weights takes, but for volumes.
///
/// A weight is as long as a square and a limb to be shifted, and so is a lift: 42 at most, or 44 as a sum. In space 15
/// coordinates and 12 differences of 21, five weights and four differences of these, four squares of 202 and four lifts, four terms
/// of 106 and three sums of 107: 2,684. In the plane there are fewer.
const POWER_LIMBS: usize = 2688;

/// Limbs of all integers that any other comparison takes.
///
/// The most are those of comparing the radius of a sphere (`measures.rs`). 12 coordinates and 9 differences are 21 · 21; three
/// squares; nine minors; a volume of them, 3 · 60 + 2 · 61; a vector, three times 3 · 80 + 2 · 81; its square, 3 · 160 +
/// 2 · 161; that of the volume, 120; the given radius and its product with that, 53 + 173. These are 4,792.
const LIMBS: usize = 4800;

/// Limbs of all integers that a sphere and a box take (`reach.rs`).
///
/// The vector of a sphere with its square as above, 4,446; twice the volume, 61; 6 coordinates and 6 differences, 12 · 21;
/// for each side of the box a product of 80 and a difference of 82; for each axis a square of 162 and a difference of at
/// most 165. These are 6,712.
pub(super) const MOST_LIMBS: usize = 6720;

/// Limbs of all integers that comparing the radius of a power sphere takes (`power_measures.rs`).
///
/// As for a sphere, with lifts of 44 in the place of squares: 12 coordinates and 9 differences, 21 · 21; three squares
/// of 202, four weights and three differences of 43, three lifts of 44; nine minors of 121; a volume, 484; a vector,
/// three times 3 · 84 + 2 · 85; its square, 3 · 170 + 2 · 171; that of the volume, 122; the weight, 44, the given
/// number, which may be as great as any, 53, and their sum, 54; its product with that, 176, and a difference of 177.
/// These are 5,573.
pub(super) const POWER_RADIUS_LIMBS: usize = 5576;

/// Limbs of all integers that the lifted cell of a reach takes (`reach/weighted.rs`).
///
/// As for a power sphere, with the sides of a box beside the corners: 18 coordinates and 15 differences, 33 · 21; five squares
/// of 202, six weights and five differences of 43, and five lifts of 44; nine minors of 121, a volume, 484, and a vector,
/// three times 3 · 84 + 2 · 85. These are 5,235.
pub(super) const POWER_REACH_LIMBS: usize = 5240;

/// Limbs of what is kept of that: the vector, the volume and the sides, 3 · 85 + 61 + 6 · 21.
pub(super) const POWER_CELL_LIMBS: usize = 442;

/// Limbs of what is made of that with the box.
///
/// Twice the volume, 62; two weights and their difference, 131; the square of the vector, 3 · 170 + 2 · 171, that of the volume,
/// 124, its product with a weight, 168, and a sum of 171; for each side of the box a product of 83 and a difference of 86;
/// for each axis a square of 172 and a difference of at most 175. These are 3,563.
pub(super) const POWER_BOX_LIMBS: usize = 3568;

/// Room for integers, which are given up together.
pub(super) struct LimbRoom<const N: usize = LIMBS> {
    limbs: UnsafeCell<[MaybeUninit<u64>; N]>,
    /// How many are in use: the first ones.
    n: Cell<usize>,
}

impl LimbRoom {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self::of_any_size()
    }
}

impl<const N: usize> LimbRoom<N> {
    #[inline(always)]
    pub(super) fn of_any_size() -> Self {
        LimbRoom { limbs: UnsafeCell::new([MaybeUninit::uninit(); N]), n: Cell::new(0) }
    }

    /// Takes `n` limbs, and sets them to zero.
    #[allow(clippy::mut_from_ref)] // Each call gives other limbs.
    fn zeros(&self, n: usize) -> &mut [u64] {
        let first = self.n.get();
        assert!(n <= N - first, "room for a determinant");
        self.n.set(first + n);
        // SAFETY: there are so many, and nothing else has them, as the number of those in use never falls, and they are
        // written before they are handed out.
        unsafe {
            let first = self.limbs.get().cast::<u64>().add(first);
            first.write_bytes(0, n);
            std::slice::from_raw_parts_mut(first, n)
        }
    }
}

/// An integer: sign and magnitude.
#[derive(Clone, Copy)]
pub(super) struct Integer<'r, const N: usize = LIMBS> {
    room: &'r LimbRoom<N>,
    /// False for zero.
    is_negative: bool,
    /// The lowest limb first; the highest is not zero.
    magnitude: &'r [u64],
}

impl<'r, const N: usize> Integer<'r, N> {
    fn new(room: &'r LimbRoom<N>, is_negative: bool, limbs: &'r [u64]) -> Self {
        let n = limbs.iter().rposition(|&limb| limb != 0).map_or(0, |highest| highest + 1);
        Integer { room, is_negative: is_negative & (n > 0), magnitude: &limbs[..n] }
    }

    /// `x` · 2^`shift`.
    pub(super) fn shifted(room: &'r LimbRoom<N>, x: i64, shift: u32) -> Self {
        let at = (shift / 64) as usize;
        let limbs = room.zeros(at + 2);
        let magnitude = u128::from(x.unsigned_abs()) << (shift % 64);
        (limbs[at], limbs[at + 1]) = (magnitude as u64, (magnitude >> 64) as u64);
        Self::new(room, x < 0, limbs)
    }

    /// The integer itself, with another room for what is made of it.
    pub(super) fn within<'s, const M: usize>(self, room: &'s LimbRoom<M>) -> Integer<'s, M>
    where
        'r: 's,
    {
        Integer { room, is_negative: self.is_negative, magnitude: self.magnitude }
    }

    /// A copy in another room.
    pub(super) fn copied_to<'s, const M: usize>(self, room: &'s LimbRoom<M>) -> Integer<'s, M> {
        let limbs = room.zeros(self.magnitude.len());
        limbs.copy_from_slice(self.magnitude);
        Integer::new(room, self.is_negative, limbs)
    }

    /// How it compares with zero.
    pub(super) fn sign(&self) -> Ordering {
        if self.is_negative { Ordering::Less } else { self.magnitude.len().cmp(&0) }
    }

    pub(super) fn compare_magnitude(&self, other: &Self) -> Ordering {
        let lengths = self.magnitude.len().cmp(&other.magnitude.len());
        lengths.then_with(|| self.magnitude.iter().rev().cmp(other.magnitude.iter().rev()))
    }

    /// A number m of 64 bits, rounded, and an exponent e: m 2ᵉ is within 2⁻⁵² of it, relatively.
    pub(super) fn rounded(&self) -> (f64, i32) {
        let Some((&high, lower)) = self.magnitude.split_last() else { return (0.0, 0) };
        let next = lower.last().copied().unwrap_or(0);
        let shift = high.leading_zeros();
        let leading = (u128::from(high) << 64 | u128::from(next)) << shift >> 64;
        let m = leading as u64 as f64;
        (if self.is_negative { -m } else { m }, 64 * lower.len() as i32 - shift as i32)
    }

    /// Sum of magnitudes, the other one not longer, with the sign of this one.
    fn plus_magnitude(self, other: Self) -> Self {
        let n = self.magnitude.len();
        let sum = self.room.zeros(n + 1);
        let others = other.magnitude.iter().chain(std::iter::repeat(&0));
        let mut carry = false;
        for ((sum, &x), &y) in sum.iter_mut().zip(self.magnitude).zip(others) {
            let (partial, first) = x.overflowing_add(y);
            let (whole, second) = partial.overflowing_add(u64::from(carry));
            (*sum, carry) = (whole, first | second);
        }
        sum[n] = u64::from(carry);
        Self::new(self.room, self.is_negative, sum)
    }

    /// Difference of magnitudes, the other one not greater, with the sign of this one.
    fn minus_magnitude(self, other: Self) -> Self {
        let difference = self.room.zeros(self.magnitude.len());
        let others = other.magnitude.iter().chain(std::iter::repeat(&0));
        let mut borrow = false;
        for ((difference, &x), &y) in difference.iter_mut().zip(self.magnitude).zip(others) {
            let (partial, first) = x.overflowing_sub(y);
            let (whole, second) = partial.overflowing_sub(u64::from(borrow));
            (*difference, borrow) = (whole, first | second);
        }
        debug_assert!(!borrow);
        Self::new(self.room, self.is_negative, difference)
    }
}

impl<const N: usize> PartialEq for Integer<'_, N> {
    fn eq(&self, other: &Self) -> bool {
        self.is_negative == other.is_negative && self.magnitude == other.magnitude
    }
}

impl<const N: usize> Add for Integer<'_, N> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (greater, less) = match self.compare_magnitude(&other) {
            Ordering::Less => (other, self),
            _ => (self, other),
        };
        if less.magnitude.is_empty() {
            greater
        } else if greater.is_negative == less.is_negative {
            greater.plus_magnitude(less)
        } else {
            greater.minus_magnitude(less)
        }
    }
}

impl<const N: usize> Sub for Integer<'_, N> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + Integer { is_negative: !other.is_negative & !other.magnitude.is_empty(), ..other }
    }
}

impl<const N: usize> Mul for Integer<'_, N> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = self.room.zeros(self.magnitude.len() + other.magnitude.len());
        // Coordinates have few limbs that are not zero.
        let skipped = other.magnitude.iter().take_while(|&&y| y == 0).count();
        let others = &other.magnitude[skipped..];
        for (k, &x) in self.magnitude.iter().enumerate().filter(|&(_, &x)| x != 0) {
            let mut carry = 0;
            let (row, rest) = product[k + skipped..].split_at_mut(others.len());
            for (sum, &y) in row.iter_mut().zip(others) {
                // (2⁶⁴ - 1)² + 2 (2⁶⁴ - 1) is 2¹²⁸ - 1.
                let whole = u128::from(x) * u128::from(y) + u128::from(*sum) + u128::from(carry);
                (*sum, carry) = (whole as u64, (whole >> 64) as u64);
            }
            if let Some(next) = rest.first_mut() {
                *next = carry;
            }
        }
        Self::new(self.room, self.is_negative != other.is_negative, product)
    }
}

#[cfg(test)]
mod tests;
