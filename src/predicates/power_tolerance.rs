//! Tolerances of bi-cells of points with weights.
//!
//! How far a vertex has gone is told by one number: the root of |Δp|² + |Δw|, for a place that has changed by Δp and a weight that
//! has changed by Δw. It is a metric, as |Δp| and the root of |Δw| are: ways add up to no less than the way from the first to
//! the last. A vertex *within* ε of where it was has |Δp|² + |Δw| ≤ ε².
//!
//! # What has to hold
//!
//! Cells are the regular triangulation of the vertices that are shown if all of them are positive, the hull is convex, and Δ > 0
//! for each bi-cell, the determinant Δ = Σ λᵢ powᵢ of the affine dependency λ and the powers of its points for *any* centre C. The
//! separating spheres of `tolerance.rs` say too little here: with a weight, a point in the hull of the others may be above
//! them. So Δ itself is bounded, and all cells have their own [tolerance](orientation_tolerance2d) as well.
//!
//! # How
//!
//! Let λ_d be the volume of the first cell, which is positive, and −λᵢ that of the simplex with `d` in the place of vertex i. C is the
//! power centre of the first cell, or what has been computed for it, and powers are seen from that of the first corner: g is that of
//! `d`, and δᵢ is what those of the cell differ by, zero but for rounding. Within ε
//!
//! - the power of a point at r from C changes by 2 (p − C)·Δp, and by at most ε² more;
//! - λᵢ changes by ∇λᵢ·Δp, at most ε Pᵢ for the sum Pᵢ of the facets of its simplex, and by at most M = m₂ ε² + m₃ ε³ more: facets are
//!   edges in the plane, and m₂ = 4, m₃ = 0; in space they are twice the areas of triangles, and m₂ = 12 L, m₃ = 8, for the
//!   longest edge L, as of the three differences whose determinant a volume is each changes by 2 ε at most.
//!
//! Multiplied out, with all terms but the first at their greatest magnitudes,
//!
//! ```text
//! Δ ≥ λ_d g − Σ |λᵢ| |δᵢ| − ε Σ (|2 λᵢ (pᵢ − C) + g ∇ᵢλ_d| + Pᵢ |δᵢ|)
//!     − ε² Σ |λᵢ| − Σ ε Pᵢ (2 rᵢ ε + ε²) − M Σ (|powᵢ| + 2 rᵢ ε + ε²)
//! ```
//!
//! The root of the terms up to the second order gives ε, to be tried and made smaller until the whole is positive: each trial is
//! certified by itself. To first order that is the best there is, as each vertex may go along its gradient.
//!
//! # Rounding
//!
//! Determinants are off by E at most, the bound of `filter.rs` for the extents of the bi-cell. A power |u|² − Δw − 2 x·u is off by less than
//! 8 u of the sum of the magnitudes of its terms. All else are sums and products of positive numbers, off by less than
//! [`SLACK`] of themselves. Where a product underflows the answer is 0, for bi-cells of less than 10⁻⁶⁰.

use super::bicells::BiCellTolerances;
use super::filter::extents;
use super::lanes::BiCells;
use super::located::Located;
use super::points::{PlanePoint, SpacePoint};
use super::tolerance::{
    Delimiter, LEAST_DETERMINANT, ORIENT_2D, ORIENT_3D, UNIT, orientation_tolerance2d,
    orientation_tolerance3d,
};
use super::vectors::{cross, dot, minor, minus};
use super::weighted::WeightedPoint;
use super::{StaticFilter, bicells_surely_hold2d, bicells_surely_hold3d};
use crate::simd::{LANES, Lanes, in_lanes};

/// What sums and products of positive numbers are off by, relatively, and more.
const SLACK: f64 = 1e-12;

/// The share of the estimate that is tried first, and by what the next trials are smaller.
const FIRST: f64 = 0.98;
const NEXT: f64 = 0.85;
const TRIALS: usize = 12;

/// What Δ is at least, as a polynomial of ε: the first one less the others.
struct Bound([f64; 6]);

impl Bound {
    /// Of points as they are seen from the first one, the last one of the second cell; with the offset of the centre, the λᵢ, what
    /// they are off by, ∇ᵢλ_d of the points of the first cell, and the Pᵢ.
    fn new<const D: usize, const N: usize>(
        points: [&WeightedPoint<D>; N],
        x: &[f64; D],
        volumes: [f64; N],
        error: f64,
        gradients: [[f64; D]; N],
        facets: [f64; N],
    ) -> Self
    where
        WeightedPoint<D>: Located<D, Of<f64> = WeightedPoint<D>>,
    {
        let d = N - 1;
        let (mut powers, mut off, mut ways, mut longest) = ([0.0; N], [0.0; N], [[0.0; D]; N], 0.0f64);
        for (k, p) in points.into_iter().enumerate() {
            let seen = WeightedPoint::<D>::seen::<f64>(p, points[0]);
            let u = seen.difference;
            let (square, along) = (dot(&u, &u), 2.0 * dot(x, &u));
            let magnitudes = x.iter().zip(&u).map(|(x, u)| (x * u).abs()).sum::<f64>();
            let weight = WeightedPoint::<D>::weight_apart::<f64>(p, points[0]);
            (powers[k], off[k]) = (seen.lift - along, 8.0 * UNIT * (square + weight + 2.0 * magnitudes));
            ways[k] = minus(&u, x);
            longest = longest.max(square.sqrt());
        }
        let g = powers[d] - off[d];
        // No edge is longer than twice the way from the first corner.
        let [second, third] = if D == 2 { [4.0, 0.0] } else { [12.0 * (2.0 * longest), 8.0] };
        let mut of = [(volumes[d] - error) * g, 0.0, 0.0, 0.0, second * N as f64, third * N as f64];
        for k in 0..N {
            let (volume, r) = (volumes[k].abs() + error, dot(&ways[k], &ways[k]).sqrt());
            // What the power may differ by from what the terms of first order take it for, and its magnitude.
            let differs = if k == d { 2.0 * off[d] } else { powers[k].abs() + off[k] };
            let power = if k == d { g + differs } else { differs };
            let mut gradient = [0.0; D];
            for axis in 0..D {
                gradient[axis] = 2.0 * volumes[k] * ways[k][axis] + g * gradients[k][axis];
            }
            let rounded = SLACK * (2.0 * volume * r + g * dot(&gradients[k], &gradients[k]).sqrt());
            of[0] -= if k == d { 0.0 } else { volume * differs };
            of[1] += dot(&gradient, &gradient).sqrt() + rounded + facets[k] * differs + 2.0 * error * r;
            of[2] += volume + 2.0 * facets[k] * r + second * power;
            of[3] += facets[k] + 2.0 * second * r + third * power;
            of[4] += 2.0 * third * r;
        }
        Bound(of)
    }

    /// Whether Δ surely is positive while all points are within this distance.
    fn is_positive(&self, e: f64) -> bool {
        let taken = self.0[1..].iter().rev().fold(0.0, |sum, term| (sum + term) * e);
        self.0[0] * (1.0 - SLACK) > taken * (1.0 + SLACK) + f64::MIN_POSITIVE
    }

    /// The tolerance, if it is not above this number; 0 if none is certain.
    fn tolerance(&self, most: f64) -> f64 {
        let [left, first, second, ..] = self.0;
        let root = 2.0 * left / (first + (first * first + 4.0 * second * left).sqrt());
        let mut e = (FIRST * root).min(most);
        for _ in 0..TRIALS {
            if self.is_positive(e) {
                // Of a way below this the square may be nothing.
                return if e > LEAST_WAY { e } else { 0.0 };
            }
            e *= NEXT;
        }
        0.0
    }
}

/// No tolerance is less, but 0.
const LEAST_WAY: f64 = 1e-70;

fn tolerance2d(c: &WeightedPoint<2>, [a, b]: [&WeightedPoint<2>; 2], d: &WeightedPoint<2>) -> f64 {
    let own = orientation_tolerance2d([&a.place, &b.place, &c.place]);
    let others = orientation_tolerance2d([&b.place, &a.place, &d.place]);
    let [nx, ny, volume] = WeightedPoint::<2>::circle::<f64>(a, b, c);
    let x = [nx / (2.0 * volume), ny / (2.0 * volume)];
    let [u, v, s] = [b, c, d].map(|p| minus(&p.place, &a.place));
    let [vu, us, vs] = [minus(&v, &u), minus(&s, &u), minus(&s, &v)];
    let volumes = [-minor(&vu, &us), -minor(&s, &v), -minor(&u, &s), volume];
    let extents = extents([&a.place, &b.place, &c.place, &d.place]);
    let error = ORIENT_2D * (extents[0] * extents[1]) + LEAST_DETERMINANT;
    let (of_b, of_c) = ([v[1], -v[0]], [-u[1], u[0]]);
    let gradients = [[-of_b[0] - of_c[0], -of_b[1] - of_c[1]], of_b, of_c, [0.0; 2]];
    let [ab, ac, ad, bc, bd, cd] = [u, v, s, vu, us, vs].map(|edge| dot(&edge, &edge).sqrt());
    let facets = [bc + bd + cd, ac + ad + cd, ab + ad + bd, ab + bc + ac];
    Bound::new([a, b, c, d], &x, volumes, error, gradients, facets).tolerance(own.min(others))
}

fn tolerance3d(d: &WeightedPoint<3>, [a, b, c]: [&WeightedPoint<3>; 3], e: &WeightedPoint<3>) -> f64 {
    let own = orientation_tolerance3d([&a.place, &b.place, &c.place, &d.place]);
    let others = orientation_tolerance3d([&b.place, &a.place, &c.place, &e.place]);
    let [nx, ny, nz, volume] = WeightedPoint::<3>::sphere::<f64>(a, b, c, d);
    let x = [nx, ny, nz].map(|n| n / (2.0 * volume));
    let [u, v, w, s] = [b, c, d, e].map(|p| minus(&p.place, &a.place));
    let (from_b, from_c) = ([&v, &w, &s].map(|p| minus(p, &u)), [&w, &s].map(|p| minus(p, &v)));
    let bcd = cross(&from_b[0], &from_b[1]);
    let [acd, adb, abc] = [cross(&v, &w), cross(&w, &u), cross(&u, &v)];
    let volumes = [dot(&from_b[2], &bcd), -dot(&s, &acd), -dot(&s, &adb), -dot(&s, &abc), volume];
    let extents = extents([&a.place, &b.place, &c.place, &d.place, &e.place]);
    let error = ORIENT_3D * (extents[0] * extents[1] * extents[2]) + LEAST_DETERMINANT;
    let of_a = std::array::from_fn(|axis| -acd[axis] - adb[axis] - abc[axis]);
    let gradients = [of_a, acd, adb, abc, [0.0; 3]];
    let norm = |n: &[f64; 3]| dot(n, n).sqrt();
    let [abe, ace, ade] = [&u, &v, &w].map(|p| norm(&cross(p, &s)));
    let [bce, bde] = [0, 1].map(|k| norm(&cross(&from_b[k], &from_b[2])));
    let cde = norm(&cross(&from_c[0], &from_c[1]));
    let [bcd, acd, adb, abc] = [&bcd, &acd, &adb, &abc].map(norm);
    let facets = [
        bcd + bce + bde + cde,
        acd + ace + ade + cde,
        adb + abe + ade + bde,
        abc + abe + ace + bce,
        bcd + acd + adb + abc,
    ];
    Bound::new([a, b, c, d, e], &x, volumes, error, gradients, facets).tolerance(own.min(others))
}

/// A delimiter without sides: a vertex is admitted by its tolerance alone.
fn only<const D: usize>(tolerance: f64) -> Delimiter<WeightedPoint<D>> {
    let centre = WeightedPoint::default();
    Delimiter { centre, radius: f64::NAN, half_width: 0.0, reach: tolerance, tolerance }
}

/// The numbers of a weighted point, `N` of them.
fn numbers<const D: usize, const N: usize>(p: &WeightedPoint<D>) -> [f64; N] {
    std::array::from_fn(|k| p[k])
}

fn point_of<const D: usize, const N: usize>(numbers: &[f64; N]) -> WeightedPoint<D> {
    WeightedPoint { place: std::array::from_fn(|k| numbers[k]), weight: numbers[D] }
}

impl BiCellTolerances for WeightedPoint<2> {
    type BiCells = BiCells<3, 4>;

    fn delimiter(bicell: &[&Self]) -> Delimiter<Self> {
        only(Self::tolerance(bicell, f64::INFINITY))
    }

    fn tolerance(bicell: &[&Self], _: f64) -> f64 {
        let &[c, a, b, d] = bicell else { unreachable!("two triangles") };
        tolerance2d(c, [a, b], d)
    }

    fn set_bicell(bicells: &mut BiCells<3, 4>, lane: usize, bicell: &[&Self]) {
        let &[c, a, b, d] = bicell else { unreachable!("two triangles") };
        let numbers = [a, b, c, d].map(numbers);
        bicells.set(lane, numbers.each_ref());
    }

    fn tolerances(bicells: &BiCells<3, 4>, _: [f64; LANES], _: f64) -> [f64; LANES] {
        std::array::from_fn(|lane| {
            let [a, b, c, d] = bicells.lane(lane).map(|numbers| point_of(&numbers));
            tolerance2d(&c, [&a, &b], &d)
        })
    }

    fn bicells_hold(f: &StaticFilter, bicells: &BiCells<3, 4>) -> [bool; LANES] {
        let hold = in_lanes!(simd => {
            let points = bicells.lanes(simd).map(|[x, y, weight]| WeightedPoint { place: [x, y], weight });
            bicells_surely_hold2d::<Self, _>(f, &points).bits()
        });
        std::array::from_fn(|lane| hold >> lane & 1 == 1)
    }

    fn orientation_tolerance(cell: &[&Self]) -> f64 {
        let &[a, b, c] = cell else { unreachable!("a triangle") };
        orientation_tolerance2d([&a.place, &b.place, &c.place])
    }
}

impl BiCellTolerances for WeightedPoint<3> {
    type BiCells = BiCells<4, 5>;

    fn delimiter(bicell: &[&Self]) -> Delimiter<Self> {
        only(Self::tolerance(bicell, f64::INFINITY))
    }

    fn tolerance(bicell: &[&Self], _: f64) -> f64 {
        let &[d, a, b, c, e] = bicell else { unreachable!("two tetrahedra") };
        tolerance3d(d, [a, b, c], e)
    }

    fn set_bicell(bicells: &mut BiCells<4, 5>, lane: usize, bicell: &[&Self]) {
        let &[d, a, b, c, e] = bicell else { unreachable!("two tetrahedra") };
        let numbers = [a, b, c, d, e].map(numbers);
        bicells.set(lane, numbers.each_ref());
    }

    fn tolerances(bicells: &BiCells<4, 5>, _: [f64; LANES], _: f64) -> [f64; LANES] {
        std::array::from_fn(|lane| {
            let [a, b, c, d, e] = bicells.lane(lane).map(|numbers| point_of(&numbers));
            tolerance3d(&d, [&a, &b, &c], &e)
        })
    }

    fn bicells_hold(f: &StaticFilter, bicells: &BiCells<4, 5>) -> [bool; LANES] {
        let hold = in_lanes!(simd => {
            let points =
                bicells.lanes(simd).map(|[x, y, z, weight]| WeightedPoint { place: [x, y, z], weight });
            bicells_surely_hold3d::<Self, _>(f, &points).bits()
        });
        std::array::from_fn(|lane| hold >> lane & 1 == 1)
    }

    fn orientation_tolerance(cell: &[&Self]) -> f64 {
        let &[a, b, c, d] = cell else { unreachable!("a tetrahedron") };
        orientation_tolerance3d([&a.place, &b.place, &c.place, &d.place])
    }
}

#[cfg(test)]
mod tests;
