//! Corners of Voronoi cells in a box, and of power cells: places where bisectors and faces of the box meet, by exact
//! signs.
//!
//! In the plane the third coordinate is zero, and fixed.
//!
//! # Idea
//!
//! Let u be the differences from a vertex to others, w what their weights are more than its own, b a place, h the
//! difference from the vertex to b, and δ that from b to a corner on the bisectors of the vertex and the others, where
//! both have one power. Each of these says 2 u · δ = u · (u − 2 h) − w. A face of the box says that δ is zero along its
//! axis. So as many others as there are axes left make a system of linear equations; Cramer's rule gives δ along an
//! axis as a quotient N / M of polynomials in the differences, of degrees 4 and 3 at most, where a weight counts as a
//! square. The sign of δ is the side of the corner on which a face of the box through b is.
//!
//! # Accuracy
//!
//! N and M are sums of products of differences. They are evaluated with the sums of the magnitudes of these
//! ([`Weighed`]), which bound their errors; where that does not leave a sign certain, or a value as accurate as it has
//! to be, with bounds of each error on the way, none of which is added where numbers are exact, as on lattices
//! ([`Bounded`]); then from integers of any length (`big.rs`): so the sign is exact, and the value within 2⁻⁴⁹ of
//! itself.
//!
//! With coordinates of magnitude 2¹⁹⁰ at most, and weights of twice the exponent, nothing overflows but quotients of
//! corners that are too far away to be in any box. Of equal weights nothing is computed: corners are those without, to
//! the last bit.

use std::ops::{Add, Mul, Sub};

use super::big::{LimbRoom, decode, differences_in_units, in_square_of_unit};
use super::distance::two_product;
use super::in_space::{PlaceInSpace, VertexInSpace};
use super::measures::scaled;

/// Where the bisectors of a vertex and others meet faces of a box.
#[derive(Clone, Copy, Debug)]
pub struct Meeting<'p, V> {
    /// The vertex.
    pub vertex: V,
    /// The others: as many as there are axes that are not fixed.
    pub others: &'p [V],
    /// The place from which offsets are counted, on the faces.
    pub from: PlaceInSpace,
    /// The axes along which the corner is where `from` is.
    pub is_fixed: [bool; 3],
}

impl<V: VertexInSpace> Meeting<'_, V> {
    /// The sign of the offset along an axis that is not fixed: exact.
    #[inline(always)]
    pub fn sign(&self, axis: usize) -> i32 {
        let (above, below) = self.quotient_of(axis, Weighed::difference);
        match (above.sign(), below.sign()) {
            (Some(above), Some(below)) => above * below,
            _ => self.uncertain_sign(axis),
        }
    }

    #[cold]
    #[inline(never)]
    fn uncertain_sign(&self, axis: usize) -> i32 {
        let (above, below) = self.quotient_of(axis, Bounded::difference);
        let x = match (above.sign(), below.sign()) {
            (Some(above), Some(below)) => return above * below,
            _ => self.exact_offset(axis),
        };
        i32::from(x > 0.0) - i32::from(x < 0.0)
    }

    /// The offset along an axis that is not fixed, off by at most `tolerance` or 2⁻⁴⁹ of itself.
    #[inline(always)]
    pub fn offset(&self, axis: usize, tolerance: f64) -> f64 {
        let (above, below) = self.quotient_of(axis, Weighed::difference);
        let quotient = above.bounded().over(below.bounded());
        if quotient.error <= tolerance { quotient.value } else { self.uncertain_offset(axis, tolerance) }
    }

    #[cold]
    #[inline(never)]
    fn uncertain_offset(&self, axis: usize, tolerance: f64) -> f64 {
        let (above, below) = self.quotient_of(axis, Bounded::difference);
        let quotient = above.over(below);
        if quotient.error <= tolerance { quotient.value } else { self.exact_offset(axis) }
    }

    /// Numerator and denominator, by differences of some kind.
    #[inline(always)]
    fn quotient_of<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>>(
        &self,
        axis: usize,
        difference: impl Fn(f64, f64) -> T,
    ) -> (T, T) {
        let minus = |p: &PlaceInSpace| [0, 1, 2].map(|k| difference(p[k], self.vertex.place()[k]));
        let seen = |p: &V| SeenVertex {
            difference: minus(p.place()),
            weight: self.is_other(p).then(|| difference(p.weight(), self.vertex.weight())),
        };
        let from = minus(&self.from);
        match self.others {
            [p] => quotient(&[seen(p)], &from, &self.is_fixed, axis),
            [p, q] => quotient(&[seen(p), seen(q)], &from, &self.is_fixed, axis),
            [p, q, r] => quotient(&[seen(p), seen(q), seen(r)], &from, &self.is_fixed, axis),
            _ => unreachable!("as many others as there are axes that are not fixed"),
        }
    }

    /// Whether a vertex has another weight.
    #[inline(always)]
    fn is_other(&self, p: &V) -> bool {
        V::HAS_WEIGHT && p.weight() != self.vertex.weight()
    }

    #[cold]
    #[inline(never)]
    fn exact_offset(&self, axis: usize) -> f64 {
        let room = LimbRoom::new();
        let mut balls = [&self.vertex; 3];
        self.others.iter().zip(&mut balls).for_each(|(other, ball)| *ball = other);
        let [p, q, r] = balls;
        // The square of the unit has to divide weights that count.
        let count = balls.iter().any(|ball| self.is_other(ball));
        let weights = balls.map(V::weight).into_iter().chain([self.vertex.weight()]);
        let exponents = weights.filter(|&weight| count && weight != 0.0).map(|weight| decode(weight).1);
        let most = exponents.min().map_or(i32::MAX, |exponent| exponent.div_euclid(2));
        let points = [p.place(), q.place(), r.place(), &self.from];
        let (unit, [u, v, w, from]) = differences_in_units(&room, self.vertex.place(), points, most);
        let seen = |ball: &V, difference| SeenVertex {
            difference,
            weight: self.is_other(ball).then(|| {
                let [weight, own] =
                    [ball, &self.vertex].map(|ball| in_square_of_unit(&room, ball.weight(), unit));
                weight - own
            }),
        };
        let all = [seen(p, u), seen(q, v), seen(r, w)];
        let (above, below) = quotient(&all[..self.others.len()], &from, &self.is_fixed, axis);
        let ((numerator, more), (divisor, less)) = (above.rounded(), below.rounded());
        let value = scaled(numerator / divisor, more - less + unit);
        // One that is not zero has a sign, however small it is.
        if value == 0.0 && numerator != 0.0 { f64::from_bits(1).copysign(numerator * divisor) } else { value }
    }
}

/// The sign of a component of (p - o) × (q - o): exact.
pub fn sign_of_cross([o, p, q]: [&PlaceInSpace; 3], axis: usize) -> i32 {
    let [j, k] = [(axis + 1) % 3, (axis + 2) % 3];
    let minus = |p: &PlaceInSpace, k: usize| Bounded::difference(p[k], o[k]);
    let rounded = minus(p, j) * minus(q, k) - minus(p, k) * minus(q, j);
    rounded.sign().unwrap_or_else(|| {
        let room = LimbRoom::new();
        let (_, [u, v]) = differences_in_units(&room, o, [p, q], i32::MAX);
        let (m, _) = (u[j] * v[k] - u[k] * v[j]).rounded();
        i32::from(m > 0.0) - i32::from(m < 0.0)
    })
}

/// A vertex as it is seen from another one.
struct SeenVertex<T> {
    difference: [T; 3],
    /// What its weight is more than that of the other one, if it is not the same.
    weight: Option<T>,
}

/// Numerator and denominator of the offset along an axis.
#[inline(always)]
fn quotient<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>>(
    others: &[SeenVertex<T>],
    from: &[T; 3],
    is_fixed: &[bool; 3],
    axis: usize,
) -> (T, T) {
    let right = |seen: &SeenVertex<T>| {
        let u = &seen.difference;
        let part = |k: usize| u[k] * (u[k] - from[k] - from[k]);
        let square = part(0) + part(1) + part(2);
        seen.weight.map_or(square, |weight| square - weight)
    };
    let twice = |x: T| x + x;
    match others {
        [p] => (right(p), twice(p.difference[axis])),
        [p, q] => {
            let other = (0..3).find(|&k| k != axis && !is_fixed[k]).expect("two axes that are not fixed");
            let (u, v) = (&p.difference, &q.difference);
            let above = right(p) * v[other] - right(q) * u[other];
            (above, twice(u[axis] * v[other] - u[other] * v[axis]))
        }
        [p, q, r] => {
            let minor = |p: &[T; 3], q: &[T; 3], k: usize| {
                p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3]
            };
            let (u, v, w) = (&p.difference, &q.difference, &r.difference);
            let volume = u[0] * minor(v, w, 0) + u[1] * minor(v, w, 1) + u[2] * minor(v, w, 2);
            let above =
                right(p) * minor(v, w, axis) + right(q) * minor(w, u, axis) + right(r) * minor(u, v, axis);
            (above, twice(volume))
        }
        _ => unreachable!("as many bisectors as there are axes that are not fixed"),
    }
}

/// A rounded sum of products of differences, and the sum of their magnitudes.
///
/// No product has more than four differences, of which that of weights counts for two, so it and the sums that it is in
/// are rounded fewer than 24 times: the sum is off by less than 2⁻⁴⁸ times that of the magnitudes. A product that
/// underflows loses less than 10⁻³²³; times three differences, and fewer than a hundred times, that is less than
/// [`LOST`].
#[derive(Clone, Copy, Debug)]
struct Weighed {
    value: f64,
    magnitude: f64,
}

const WEIGHT: f64 = 1.0 / (1u64 << 48) as f64;
const LOST: f64 = 1e-145;

impl Weighed {
    #[inline(always)]
    fn difference(a: f64, b: f64) -> Self {
        Weighed { value: a - b, magnitude: (a - b).abs() }
    }

    #[inline(always)]
    fn bounded(self) -> Bounded {
        Bounded { value: self.value, error: WEIGHT * self.magnitude + LOST }
    }

    /// If it is certain.
    #[inline(always)]
    fn sign(self) -> Option<i32> {
        let is_certain = self.value.abs() > WEIGHT * self.magnitude + LOST;
        is_certain.then_some(if self.value > 0.0 { 1 } else { -1 })
    }
}

impl Add for Weighed {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Weighed { value: self.value + other.value, magnitude: self.magnitude + other.magnitude }
    }
}

impl Sub for Weighed {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Weighed { value: self.value - other.value, magnitude: self.magnitude + other.magnitude }
    }
}

impl Mul for Weighed {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Weighed { value: self.value * other.value, magnitude: self.magnitude * other.magnitude }
    }
}

/// A rounded number and a bound of its error.
///
/// A rounding is off by 2⁻⁵³ of the result at most; twice that, [`UNIT`], also covers the roundings of the bounds
/// themselves, of which less than a hundred follow each other, and [`TINY`] those of products that underflow.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounded {
    value: f64,
    error: f64,
}

const UNIT: f64 = f64::EPSILON;
const TINY: f64 = 1e-320;

/// The tail of a product above this has not underflowed.
const LEAST_EXACT: f64 = 1e-280;

impl Bounded {
    const ZERO: Bounded = Bounded { value: 0.0, error: 0.0 };

    /// A difference of coordinates. Of many it is exact, as of those that are near each other.
    pub(super) fn difference(a: f64, b: f64) -> Self {
        let value = a - b;
        // Knuth's tail of the sum of a and -b.
        let taken = value - a;
        let tail = (a - (value - taken)) - (b + taken);
        Bounded { value, error: tail.abs() }
    }

    /// If it is certain.
    pub(super) fn sign(self) -> Option<i32> {
        if self.value.abs() > self.error {
            Some(if self.value > 0.0 { 1 } else { -1 })
        } else {
            (self.error == 0.0).then_some(0)
        }
    }

    /// The quotient; of an infinite error or none that is a number where the divisor may be zero.
    fn over(self, divisor: Self) -> Self {
        let value = self.value / divisor.value;
        let least = divisor.value.abs() - divisor.error;
        let error = (self.error + value.abs() * divisor.error) / least * (1.0 + 8.0 * UNIT)
            + UNIT * value.abs()
            + TINY;
        Bounded { value, error: if least > 0.0 { error } else { f64::INFINITY } }
    }
}

impl Add for Bounded {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if (self.error == 0.0) & (other.error == 0.0) {
            return Bounded::difference(self.value, -other.value);
        }
        let value = self.value + other.value;
        Bounded { value, error: self.error + other.error + UNIT * value.abs() }
    }
}

impl Sub for Bounded {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + Bounded { value: -other.value, ..other }
    }
}

impl Mul for Bounded {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if (self.error == 0.0) & (other.error == 0.0) {
            let (value, tail) = two_product(self.value, other.value);
            if value == 0.0 && (self.value == 0.0 || other.value == 0.0) {
                return Bounded::ZERO;
            }
            let error = tail.abs() + if value.abs() > LEAST_EXACT { 0.0 } else { TINY };
            return Bounded { value, error };
        }
        let value = self.value * other.value;
        let of_factors = self.value.abs() * other.error + self.error * (other.value.abs() + other.error);
        Bounded { value, error: of_factors + UNIT * value.abs() + TINY }
    }
}
