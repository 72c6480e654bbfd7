//! Whether a weighted point is below the hyperplane through others: the sign that decides with weights.
//!
//! The *power* of a place x to a point p of weight w is |x − p|² − w: with w = r² it is the square of a tangent to the circle or
//! sphere of radius r. The points of a simplex have one *power sphere*: its centre has one power to all of them, which is its
//! squared radius, and may be negative. A point q of weight w is *inside* if its power distance to the centre, |q − c|² − w, is
//! below that.
//!
//! # One lift
//!
//! Weights enter where points are lifted, and nowhere else: to |p|² − w in the place of |p|². With the differences pᵢ of the
//! corners from q, the lift Lᵢ = |pᵢ|² − (wᵢ − w), and the orientation Oᵢ of the simplex with q in the place of corner i, the
//! determinant is Σ Lᵢ Oᵢ: positive if q is inside of a positive simplex, as its barycentric coordinates are the Oᵢ over the
//! orientation of the simplex. So it is linear in the weights, and without any it is that of [`insphere`].
//!
//! # What is certain
//!
//! Multiplied out, the determinant is a sum of products of differences of coordinates, and of such with a difference of weights.
//! A computed one has been rounded at most 18 times on the way of each product into the sum: in the square of a difference, its
//! sums and that with the weights, 6 times; in a volume 8 times; once in their product, and in three sums. With P for the sum
//! of the magnitudes of the products it is off by less than 18 u P, as in `filter.rs`. Underflow adds less than 6 η M + 3 η to a
//! volume and 3 η to a lift, for M the greatest difference, and η to their product: less than [`UNDERFLOW`] times
//! (1 + L) (1 + M) + V, for the greatest magnitudes L of lifts and V of volumes.
//!
//! # Range
//!
//! Weights are of magnitude up to [`MAX_WEIGHT`], the square of the greatest coordinate: lifts are below 14·10¹¹⁴, volumes below
//! 48·10¹⁷¹, and the determinant below 10²⁸⁹. In integers, the unit of coordinates is at most the root of that of weights, and
//! so at least 2⁻¹⁰⁷⁴; in its square a weight is below 2²⁵²⁷, and so as long as a square (`big.rs`).

use super::big;
use super::filter::{ROUND_UP, StaticFilter, UNDERFLOW, UNIT};
use super::plane::incircle;
use super::space::insphere;
use super::vectors::{dot, minor, minus};
use crate::machine::tally;

/// The greatest magnitude of a weight.
pub const MAX_WEIGHT: f64 = 1e114;

/// Bound of the determinant / the sum of the magnitudes of its products.
const TERMS: f64 = 18.0 * UNIT * ROUND_UP;

/// Positive iff the last point, of the last weight, is inside the power circle of the others, in counter-clockwise order, zero iff it
/// is on it; negated for clockwise ones.
///
/// The sign is exact; the magnitude is approximate. Weights are of magnitude [`MAX_WEIGHT`] at most.
pub fn in_power_circle(f: &StaticFilter, points: [&[f64; 2]; 4], weights: &[f64; 4]) -> f64 {
    let [a, b, c, d] = points;
    if weights.iter().all(|weight| weight == &weights[0]) {
        return incircle(f, a, b, c, d);
    }
    let [u, v, w] = [a, b, c].map(|p| minus(p, d));
    let terms = [(&u, 0, area(&v, &w)), (&v, 1, area(&w, &u)), (&w, 2, area(&u, &v))];
    sum_of_terms(&terms, weights).unwrap_or_else(|rounded| {
        tally::count();
        big::in_power_circle(rounded, points, weights)
    })
}

/// Positive iff the last point, of the last weight, is inside the power sphere of the others, of positive orientation, zero iff it is
/// on it; negated for others.
///
/// The sign is exact; the magnitude is approximate. Weights are of magnitude [`MAX_WEIGHT`] at most.
pub fn in_power_sphere(f: &StaticFilter, points: [&[f64; 3]; 5], weights: &[f64; 5]) -> f64 {
    let [a, b, c, d, e] = points;
    if weights.iter().all(|weight| weight == &weights[0]) {
        return insphere(f, a, b, c, d, e);
    }
    let [u, v, w, s] = [a, b, c, d].map(|p| minus(p, e));
    let terms = [
        (&u, 0, volume(&v, &w, &s)),
        // With two of the others exchanged, for the sign.
        (&v, 1, volume(&w, &u, &s)),
        (&w, 2, volume(&u, &v, &s)),
        (&s, 3, volume(&v, &u, &w)),
    ];
    sum_of_terms(&terms, weights).unwrap_or_else(|rounded| {
        tally::count();
        big::in_power_sphere(rounded, points, weights)
    })
}

/// A determinant, and the sum of the magnitudes of its products.
#[derive(Clone, Copy)]
struct Orientation {
    value: f64,
    magnitude: f64,
}

fn area(v: &[f64; 2], w: &[f64; 2]) -> Orientation {
    Orientation { value: minor(v, w), magnitude: (v[0] * w[1]).abs() + (v[1] * w[0]).abs() }
}

fn volume(u: &[f64; 3], v: &[f64; 3], w: &[f64; 3]) -> Orientation {
    let value = minor(v, w) * u[2] - minor(u, w) * v[2] + minor(u, v) * w[2];
    let [a, b, c] = [u, v, w].map(|p| p.map(f64::abs));
    let minors = |p: &[f64; 3], q: &[f64; 3]| p[0] * q[1] + p[1] * q[0];
    Orientation { value, magnitude: minors(&b, &c) * a[2] + minors(&a, &c) * b[2] + minors(&a, &b) * c[2] }
}

/// The sum of the lifts of corners, each a difference and the number of its weight, times orientations. The last weight is that of
/// the point that they are seen from. The rounded sum is an error if its sign is not certain.
fn sum_of_terms<const D: usize>(
    terms: &[(&[f64; D], usize, Orientation)],
    weights: &[f64],
) -> Result<f64, f64> {
    let own = weights[weights.len() - 1];
    let (mut sum, mut products) = (0.0, 0.0);
    let (mut most_lift, mut most_volume, mut most) = (1.0f64, 0.0f64, 1.0f64);
    for &(p, k, orientation) in terms {
        let (square, weight) = (dot(p, p), weights[k] - own);
        let magnitude = square + weight.abs();
        sum += (square - weight) * orientation.value;
        products += magnitude * orientation.magnitude;
        most_lift = most_lift.max(magnitude);
        most_volume = most_volume.max(orientation.magnitude);
        most = p.iter().fold(most, |most, x| most.max(x.abs()));
    }
    // The greatest of each is 1 at least, and twice that no less than the sum with 1.
    let underflow = 4.0 * UNDERFLOW * (most_lift * most + most_volume);
    if sum.abs() > TERMS * products + underflow { Ok(sum) } else { Err(sum) }
}

#[cfg(test)]
mod tests;
