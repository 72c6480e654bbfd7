//! Exact comparison of distances and powers, with each other and with a bound, and collinearity in space.

use super::big::{self, has_room};
use super::filter::UNDERFLOW;
use super::vectors::squared_distance;
use super::weighted::WeightedPoint;
use robust::Coord;
use std::cmp::Ordering;

/// Compares the distances of `a` and of `b` from `q`, exactly.
#[inline(always)]
pub fn compare_distance<P: AsRef<[f64]>>(q: &P, a: &P, b: &P) -> Ordering {
    let (to_a, to_b) = (squared_distance(q, a), squared_distance(q, b));
    let difference = to_a - to_b;
    // A rounded squared distance is a sum of D non-negative terms, each of relative error 3 u to first order
    // (twice the difference's, and the product's), plus u for each of D − 1 sums: at most 5 u in all. The
    // last subtraction keeps the sign. 6 u covers the higher orders and the rounding of this bound. Each of
    // the 2 D squares and the bound's product may underflow, with an error of 2⁻¹⁰⁷⁵.
    let bound = 6.0 * (f64::EPSILON / 2.0) * (to_a + to_b) + UNDERFLOW;
    if difference > bound {
        Ordering::Greater
    } else if difference < -bound {
        Ordering::Less
    } else {
        compare_distance_exactly(q, a, b)
    }
}

/// Compares the powers of a place in respect of `a` and of `b`, exactly: the squared distances, less the weights.
pub fn compare_power<const D: usize>(q: &[f64; D], a: &WeightedPoint<D>, b: &WeightedPoint<D>) -> Ordering {
    if a.weight == b.weight {
        return compare_distance(q, &a.place, &b.place);
    }
    let (to_a, to_b) = (squared_distance(q, &a.place), squared_distance(q, &b.place));
    let apart = a.weight - b.weight;
    let difference = (to_a - to_b) - apart;
    // As in `compare_distance`: 5 u for each squared distance, u for their difference and for that of the weights. The
    // last subtraction keeps the sign. 8 u covers the higher orders and the rounding of this bound.
    let bound = 8.0 * (f64::EPSILON / 2.0) * (to_a + to_b + apart.abs()) + UNDERFLOW;
    if difference > bound {
        Ordering::Greater
    } else if difference < -bound {
        Ordering::Less
    } else {
        compare_power_exactly(q, a, b)
    }
}

/// Whether the squared distance of `a` from `q` is at most `squared`, which is not negative: exactly.
pub fn is_within_distance<P: AsRef<[f64]>>(q: &P, a: &P, squared: f64) -> bool {
    let own = squared_distance(q, a);
    let difference = own - squared;
    // One squared distance is rounded, with a relative error of 5 u and an underflow: see `compare_distance`.
    let bound = 6.0 * (f64::EPSILON / 2.0) * own + UNDERFLOW;
    if difference.abs() > bound { difference < 0.0 } else { is_exactly_within_distance(q, a, squared) }
}

/// The sign of |q − a|² − squared = Σ q² − 2qa + a² − squared, every product being a sum of two doubles.
#[cold]
#[inline(never)]
fn is_exactly_within_distance<P: AsRef<[f64]>>(q: &P, a: &P, squared: f64) -> bool {
    let [q, a] = [q, a].map(P::as_ref);
    if !has_room([q, a], 2) {
        return big::is_within_distance([q, a], squared);
    }
    let mut sum = ExactSum::default();
    sum.add(-squared);
    for (&q, &a) in q.iter().zip(a) {
        for (factor, other) in [(q, q), (-2.0 * q, a), (a, a)] {
            let (product, tail) = two_product(factor, other);
            sum.add(tail);
            sum.add(product);
        }
    }
    sum.sign() != Ordering::Greater
}

/// Whether three points of space lie on a line, exactly: whether all three projections do.
pub fn is_collinear3(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]) -> bool {
    if !has_room([a, b, c], 2) {
        return big::is_collinear3([a, b, c]);
    }
    [(0, 1), (1, 2), (2, 0)].into_iter().all(|(x, y)| {
        let [a, b, c] = [a, b, c].map(|p| Coord { x: p[x], y: p[y] });
        robust::orient2d(a, b, c) == 0.0
    })
}

/// The sign of |q − a|² − |q − b|².
#[cold]
#[inline(never)]
fn compare_distance_exactly<P: AsRef<[f64]>>(q: &P, a: &P, b: &P) -> Ordering {
    let [q, a, b] = [q, a, b].map(P::as_ref);
    if !has_room([q, a, b], 2) {
        return big::compare_distance([q, a, b]);
    }
    difference_of_squares(q, a, b).sign()
}

/// The sign of |q − a|² − |q − b|², less what the weight of a is more than that of b.
#[cold]
#[inline(never)]
fn compare_power_exactly<const D: usize>(
    q: &[f64; D],
    a: &WeightedPoint<D>,
    b: &WeightedPoint<D>,
) -> Ordering {
    if !has_room([q, &a.place, &b.place], 2) {
        return big::compare_power(q, [&a.place, &b.place], [a.weight, b.weight]);
    }
    let mut sum = difference_of_squares(q, &a.place, &b.place);
    sum.add(b.weight);
    sum.add(-a.weight);
    sum.sign()
}

/// |q − a|² − |q − b|² = Σ a² − b² − 2qa + 2qb, every product being a sum of two doubles.
fn difference_of_squares(q: &[f64], a: &[f64], b: &[f64]) -> ExactSum {
    let mut sum = ExactSum::default();
    for ((&q, &a), &b) in q.iter().zip(a).zip(b) {
        for (factor, other) in [(a, a), (-b, b), (-2.0 * q, a), (2.0 * q, b)] {
            let (product, tail) = two_product(factor, other);
            sum.add(tail);
            sum.add(product);
        }
    }
    sum
}

/// An exact sum of up to 26 numbers: a non-overlapping expansion, smallest component first.
///
/// (Shewchuk, *Adaptive precision floating-point arithmetic and fast robust geometric predicates*, 1997,
/// Grow-Expansion with elimination of zeros.)
#[derive(Default)]
struct ExactSum {
    components: [f64; 26],
    length: usize,
}

impl ExactSum {
    fn add(&mut self, term: f64) {
        let mut carry = term;
        let mut kept = 0;
        for position in 0..self.length {
            let (sum, tail) = two_sum(carry, self.components[position]);
            carry = sum;
            if tail != 0.0 {
                self.components[kept] = tail;
                kept += 1;
            }
        }
        if carry != 0.0 {
            self.components[kept] = carry;
            kept += 1;
        }
        self.length = kept;
    }

    /// The largest component exceeds the sum of the others.
    fn sign(&self) -> Ordering {
        self.components[..self.length].last().map_or(Ordering::Equal, |largest| largest.total_cmp(&0.0))
    }
}

/// Rounded sum and its error (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    let a_part = sum - b_part;
    (sum, (a - a_part) + (b - b_part))
}

/// Rounded product and its error (Dekker).
pub(super) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    let error = ((product - a_high * b_high) - a_low * b_high) - a_high * b_low;
    (product, a_low * b_low - error)
}

/// Halves of at most 26 bits (Veltkamp).
fn split(a: f64) -> (f64, f64) {
    let scaled = ((1u64 << 27) + 1) as f64 * a;
    let high = scaled - (scaled - a);
    (high, a - high)
}
