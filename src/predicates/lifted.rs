//! The in-circle determinant as seen from the point that is tested.
//!
//! With the differences u, v, w from `q` to the corners of a triangle, the determinant is
//! `|u|² v×w + |v|² w×u + |w|² u×v`. A search of neighbouring triangles with one `q` meets every difference,
//! every square and every cross product of an edge more than once: kept, they leave 16 operations to a test,
//! of 25. The static bound is derived like those of the other determinants, for this operation order, and
//! [`seen_circle_bound`] is that of the corners at hand, [`seen_circle_running_bound`] that of the values at hand
//! (`running.rs`); what they leave uncertain goes to [`incircle`](super::incircle).

use super::lengths::lifted_bound_by_lengths;
use super::running::{Running, lifted_running_bound};
use super::vectors::{dot, minor, minus};
use crate::simd::Real;

/// A point as seen from another: the difference, and its square.
#[derive(Clone, Copy, Debug)]
pub struct Lifted {
    difference: [f64; 2],
    square: f64,
}

impl Lifted {
    /// The point `p` seen from `q`.
    #[inline(always)]
    pub fn new(p: &[f64; 2], q: &[f64; 2]) -> Self {
        let difference = minus(p, q);
        Lifted { difference, square: dot(&difference, &difference) }
    }

    /// Cross product with another point seen from the same place: positive if that is to the left.
    #[inline(always)]
    pub fn cross(&self, other: &Self) -> f64 {
        minor(&self.difference, &other.difference)
    }
}

/// Positive if the place that they are seen from is inside the circle of the
/// counter-clockwise triangle of `u`, `v` and `w`, negative if outside; open if the magnitude
/// is not above [`StaticFilter::prepared`](super::StaticFilter). The cross products are those
/// of `u` and `v`, `v` and `w`, `w` and `u`.
#[inline(always)]
pub fn side_of_seen_circle([u, v, w]: [&Lifted; 3], [uv, vw, wu]: [f64; 3]) -> f64 {
    u.square * vw + v.square * wu + w.square * uv
}

/// What the magnitude of [`side_of_seen_circle`] exceeds if it is certain, by the distances of the corners.
#[inline(always)]
pub fn seen_circle_bound([u, v, w]: [&Lifted; 3]) -> f64 {
    lifted_bound_by_lengths(Real::max(Real::max(u.square, v.square), w.square))
}

/// What the magnitude of [`side_of_seen_circle`] exceeds if it is certain, by the errors of what it is computed from.
#[inline(always)]
pub fn seen_circle_running_bound([u, v, w]: [&Lifted; 3]) -> f64 {
    let error = |opposite: &Lifted, p: &Lifted, q: &Lifted| {
        let ([x, y], [z, t]) = (p.difference, q.difference);
        Running::sum(x * t, -(y * z)).error_of_lifted(opposite.square)
    };
    let errors = error(u, v, w) + error(v, w, u) + error(w, u, v);
    lifted_running_bound(errors, Real::max(Real::max(u.square, v.square), w.square))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicates::dyadic::product;
    use crate::predicates::near_ties::on_arc;
    use crate::predicates::{StaticFilter, big, incircle};
    use crate::random::Rng;

    /// A certain answer is that of the exact predicate, on random
    /// points and on points a few ulps from a circle.
    #[test]
    fn certain_answers_are_exact() {
        let rng = &mut Rng::new(5);
        let mut below = |n: f64| rng.unit() * n;
        let f = StaticFilter::plane([-6.0; 2], [6.0; 2]);
        let (mut n_certain, mut n_by_lengths, mut n_open) = (0, 0, 0);
        for round in 0..200_000 {
            let on_circle = [[3., 4.], [5., 0.], [4., -3.], [-4., 3.], [0., -5.], [-3., -4.], [0., 5.]];
            let p: [[f64; 2]; 4] = std::array::from_fn(|_| {
                if round % 2 == 0 {
                    std::array::from_fn(|_| below(10.0) - 5.0)
                } else {
                    on_circle[below(7.0) as usize].map(|x| x + [0.0, 0.0, 1e-15, -1e-15][below(4.0) as usize])
                }
            });
            let [a, b, c, q] = &p;
            let [u, v, w] = [a, b, c].map(|p| Lifted::new(p, q));
            let side = side_of_seen_circle([&u, &v, &w], [u.cross(&v), v.cross(&w), w.cross(&u)]);
            let exact = incircle(&f, a, b, c, q);
            if side.abs() > seen_circle_bound([&u, &v, &w]) {
                n_by_lengths += 1;
                assert_eq!(side > 0.0, exact > 0.0);
                assert_ne!(exact, 0.0);
            }
            if side.abs() > f.prepared {
                n_certain += 1;
                assert_eq!(side > 0.0, exact > 0.0);
                assert_ne!(exact, 0.0);
            } else {
                n_open += 1;
            }
        }
        assert!(n_by_lengths > n_certain && n_certain > 90_000, "{n_by_lengths} by lengths, {n_certain}");
        assert!(n_open > 10_000, "{n_open} open");
    }

    /// The bound by running errors is what the analysis asks for, and what exceeds it has the right sign.
    #[test]
    fn running_errors_are_bounded() {
        let rng = &mut Rng::new(7);
        let (mut n_certain, mut n_open) = (0, 0);
        for case in 0..400_000 {
            let points = on_arc(rng);
            let [a, b, c, q] = &points;
            let [u, v, w] = &[a, b, c].map(|p| Lifted::new(p, q));
            let crosses = [u.cross(v), v.cross(w), w.cross(u)];
            let side = side_of_seen_circle([u, v, w], crosses);
            let bound = seen_circle_running_bound([u, v, w]);
            if side.abs() > seen_circle_bound([u, v, w]) {
                continue;
            }
            if side.abs() > bound {
                let exact = big::incircle(1.0, [a, b, c, q]);
                assert!(exact != 0.0 && (side > 0.0) == (exact > 0.0), "{points:?}");
                n_certain += 1;
            } else {
                n_open += 1;
            }
            if case % 8 > 0 {
                continue;
            }
            let exact = |x: f64| product([x]);
            let mut expected =
                exact(f64::MIN_POSITIVE) * exact(u.square.max(v.square).max(w.square).max(1.0));
            for (p, left, right) in [(u, v, w), (v, w, u), (w, u, v)] {
                let ([x, y], [z, t]) = (left.difference, right.difference);
                let products = exact((x * t).abs()) + exact((y * z).abs());
                let errors = exact(3.0) * products + exact(7.0) * exact((x * t - y * z).abs());
                expected = expected + exact(f64::EPSILON / 2.0) * exact(p.square) * errors;
            }
            assert!(exact(bound).is_close_to(&expected, 38), "{points:?}");
        }
        assert!(n_certain > 40_000 && n_open > 40_000, "{n_certain} certain, {n_open} open");
    }
}
