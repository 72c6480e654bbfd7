//! In-sphere tests without ties, by symbolic perturbation of the lift.
//!
//! # Derivation
//!
//! (Devillers and Teillaud, *Perturbations for Delaunay and weighted Delaunay 3D triangulations*,
//! [10.1016/j.comgeo.2010.09.010](https://doi.org/10.1016/j.comgeo.2010.09.010).)
//!
//! Lift a point p to height |p|². A point e lies inside the sphere of a simplex iff its lifted image lies
//! below the hyperplane through the lifted vertices aᵢ: with the barycentric coordinates λᵢ of e in the
//! simplex, iff
//!
//! |e|² − Σ λᵢ |aᵢ|² < 0.
//!
//! Raise the vertex of id i by εᵢ, where 0 < ε₀ ≪ ε₁ ≪ …, each infinitesimal compared with the next: of
//! several, the *highest* id dominates. When the left-hand side is zero, what remains is
//!
//! ε(e) − Σ λᵢ ε(aᵢ) < 0,
//!
//! and its sign is that of the non-zero term with the highest id. The term of e is positive: e is outside.
//! The term of aᵢ is opposite to λᵢ, and λᵢ is the orientation of the simplex with aᵢ replaced by e, over
//! the orientation of the simplex: e is inside iff that orientation, the simplex being positive, is
//! positive.
//!
//! Raising a point never moves it, so orientations are those of the unperturbed points and cells of
//! volume zero never appear; and since the perturbation belongs to a vertex and not to a call, all calls
//! speak of one and the same set of lifted points in general position. Its lower hull is unique: the
//! triangulation is a function of positions and ids alone.
//!
//! Weights are terms of the lift, and raised lifts stay so: the rule is one for points with weights. Two of these may be at one
//! place. Then, where their weights are equal, λ is 1 for the one that is a corner, and 0 for all others: the one of the lower
//! id is below, and hides the other one.
//!
//! # Cost
//!
//! The cost of the in-sphere test, then, on ties only, one orientation as a rule. In the plane it is exactly
//! one (three of four distinct cocircular points are never collinear); in space more are needed when four
//! of the points are coplanar.

use super::filter::StaticFilter;
use super::located::Located;
use super::plane::{incircle, orient2d};
use super::power::{in_power_circle, in_power_sphere};
use super::space::{insphere, orient3d};
use super::sphere::{circle_seen, side_of_circle_seen, side_of_sphere_seen, sphere_seen};
use super::vectors::{minor, minus};
use super::weighted::WeightedPoint;

/// Whether the last point is inside the circle of the first three, ties being decided by `ids`, which only these ask
/// for.
///
/// The first three points are in counter-clockwise order and no two points coincide; ids are distinct.
#[inline(always)]
pub fn incircle_perturbed(f: &StaticFilter, points: [&[f64; 2]; 4], ids: impl FnOnce() -> [u32; 4]) -> bool {
    let [a, b, c, d] = points;
    let det = incircle(f, a, b, c, d);
    if det != 0.0 { det > 0.0 } else { is_inside_cocircular(f, points, ids()) }
}

/// Whether the last point is inside the sphere of the first four, ties being decided by `ids`, which only these ask
/// for.
///
/// The first four points are in positive orientation and no two points coincide; ids are distinct.
#[inline(always)]
pub fn insphere_perturbed(f: &StaticFilter, points: [&[f64; 3]; 5], ids: impl FnOnce() -> [u32; 5]) -> bool {
    let [a, b, c, d, e] = points;
    let det = insphere(f, a, b, c, d, e);
    if det != 0.0 { det > 0.0 } else { is_inside_cospherical(f, points, ids()) }
}

#[cold]
#[inline(never)]
fn is_inside_cocircular(f: &StaticFilter, [a, b, c, d]: [&[f64; 2]; 4], ids: [u32; 4]) -> bool {
    debug_assert!(orient2d(f, a, b, c) > 0.0, "the triangle is not counter-clockwise");
    is_inside_raised(ids, |vertex| match vertex {
        0 => orient2d(f, d, b, c),
        1 => orient2d(f, a, d, c),
        _ => orient2d(f, a, b, d),
    })
}

/// Whether the last point is inside the power circle of the first three, ties being decided by `ids`, which only these ask for:
/// of two points at one place, which have a weight in common, the one of the higher id is above the other one.
///
/// The first three points are in counter-clockwise order; ids are distinct.
#[inline(always)]
pub fn in_power_circle_perturbed(
    f: &StaticFilter,
    points: [&WeightedPoint<2>; 4],
    ids: impl FnOnce() -> [u32; 4],
) -> bool {
    type P = WeightedPoint<2>;
    let [a, b, c, q] = points;
    let side = side_of_circle_seen(&circle_seen(&P::seen(b, a), &P::seen(c, a)), &P::seen(q, a));
    if side.abs() > f.prepared {
        return side > 0.0;
    }
    let (places, weights) = (points.map(|p| &p.place), points.map(|p| p.weight));
    let det = in_power_circle(f, places, &weights);
    if det != 0.0 { det > 0.0 } else { is_inside_cocircular(f, places, ids()) }
}

/// Whether the last point is inside the power sphere of the first four, ties being decided as by [`in_power_circle_perturbed`].
///
/// The first four points are in positive orientation; ids are distinct.
#[inline(always)]
pub fn in_power_sphere_perturbed(
    f: &StaticFilter,
    points: [&WeightedPoint<3>; 5],
    ids: impl FnOnce() -> [u32; 5],
) -> bool {
    type P = WeightedPoint<3>;
    let [a, b, c, d, q] = points;
    let sphere = sphere_seen(&P::seen(b, a), &P::seen(c, a), &P::seen(d, a));
    let side: f64 = side_of_sphere_seen(&sphere, &P::seen(q, a));
    if side.abs() > f.prepared {
        return side > 0.0;
    }
    let (places, weights) = (points.map(|p| &p.place), points.map(|p| p.weight));
    let det = in_power_sphere(f, places, &weights);
    if det != 0.0 { det > 0.0 } else { is_inside_cospherical(f, places, ids()) }
}

/// What [`insphere_perturbed`] tells, of points that are cospherical: by ids.
#[cold]
#[inline(never)]
fn is_inside_cospherical(f: &StaticFilter, [a, b, c, d, e]: [&[f64; 3]; 5], ids: [u32; 5]) -> bool {
    debug_assert!(orient3d(f, a, b, c, d) > 0.0, "the tetrahedron is not positive");
    is_inside_raised(ids, |vertex| match vertex {
        0 => orient3d(f, e, b, c, d),
        1 => orient3d(f, a, e, c, d),
        2 => orient3d(f, a, b, e, d),
        _ => orient3d(f, a, b, c, e),
    })
}

/// What [`insphere_perturbed`] tells, of points that are cospherical and on a lattice (see
/// [`lattice`](super::lattice)): by ids, without a branch, as which vertex decides cannot be foreseen.
#[inline(always)]
pub fn is_inside_cospherical_on_lattice([a, b, c, d, e]: [&[f64; 3]; 5], ids: [u32; 5]) -> bool {
    let [a, b, c, d] = [a, b, c, d].map(|p| minus(p, e));
    let (ab, ac, ad) = (minor(&a, &b), minor(&a, &c), minor(&a, &d));
    let (bc, bd, cd) = (minor(&b, &c), minor(&b, &d), minor(&c, &d));
    // The orientations of the simplex with each vertex replaced.
    let orientations = [
        cd * b[2] - bd * c[2] + bc * d[2],
        ad * c[2] - cd * a[2] - ac * d[2],
        bd * a[2] - ad * b[2] + ab * d[2],
        ac * b[2] - bc * a[2] - ab * c[2],
    ];
    // The id first, so that the greatest is that of the vertex that decides.
    let raised = |id: u32, is_inside: u64| u64::from(id) << 1 | is_inside;
    let deciding = (0..4).fold(raised(ids[4], 0), |most, i| {
        let bits = orientations[i].to_bits();
        // Comparisons of integers: those of numbers look for NaN as well, by a branch.
        let is_zero = bits << 1 == 0;
        most.max(if is_zero { 0 } else { raised(ids[i], 1 - (bits >> 63)) })
    });
    deciding & 1 == 1
}

/// Decides a tie among the `N − 1` vertices of a positive simplex and a query point, which comes last.
/// `replaced(i)` is the orientation of the simplex with vertex `i` replaced by the query point.
fn is_inside_raised<const N: usize>(ids: [u32; N], replaced: impl Fn(usize) -> f64) -> bool {
    let mut left = ids.map(i64::from);
    loop {
        let dominating =
            (1..N).fold(0, |most, position| if left[position] > left[most] { position } else { most });
        if dominating == N - 1 {
            return false;
        }
        let orientation = replaced(dominating);
        if orientation != 0.0 {
            return orientation > 0.0;
        }
        left[dominating] = -1;
    }
}
