//! Delimiters and tolerances (report, sections 2 to 4), certified.
//!
//! A *bi-cell* has an interior facet and two opposing vertices `c` and `d`, one on either side. Its *standard
//! delimiter* is the sphere halfway between the sphere about C through the facet and the one about C through
//! `c` and `d`, C being equidistant from the facet's vertices and from `c` and `d`.
//!
//! # Certified whatever the centre
//!
//! Section 4 of the report follows the rounding errors through the division that gives C. There is no need:
//! *every* point C' is the centre of a delimiter if the farthest vertex of the facet is nearer to it, at r',
//! than the nearest opposing vertex, at R'. So C' is computed by any formula, and errors are bounded from
//! there: those of five distances between given points. What the error of C' costs is width, and very little
//! of that.
//!
//! Let u = 2⁻⁵³. A squared distance rounds every difference, its square and D − 1 sums: its relative error
//! is within (1 ± u)ᴰ⁺², that of its root within (1 ± u)ᵏ, k = (D + 4)/2. With the rounded roots r, R and the
//! stored radius ρ = fl((r + R)/2), which is between them,
//!
//! ```text
//! ρ − r' ≥ (ρ − r) − ((1 − u)⁻ᵏ − 1) r,      R' − ρ ≥ (R − ρ) − (1 − (1 + u)⁻ᵏ) R
//! ```
//!
//! R − ρ is exact and ρ − r at most u R/2 off (ρ ≥ R/2), and so is the last subtraction: the half-width is
//! min(ρ − r, R − ρ) less (k + 1) u R, rounded up for the second order. That is a lower bound of the distance
//! of all D + 2 points from the *stored* sphere, the rounding of its centre and radius included. A form free
//! of cancellation, R² − r² = (c − f)·((c − C) + (f − C)), would not do better here: the stored centre alone
//! is u R off.
//!
//! # In the plane, this proves the triangulation
//!
//! Let λ be the affine dependency of the moved points, λ_c and λ_d > 0 (the two cells are positive). For any
//! sphere, the in-sphere determinant is Δ = Σ λᵢ powᵢ, a sum over the powers of the points. If all vertices
//! of the facet have λ < 0, a delimiter makes every term positive. In the plane the only other case is that
//! one point is in the hull of the others, and then Δ > 0 by convexity of the lift.
//!
//! # In space it does not
//!
//! There, λ may be negative for two vertices a, b of the facet and positive for the third, e: the line `cd`
//! passes the facet beyond the edge `ab`, as it does in two thirds of the bi-cells of random points (a flip
//! would be 3-2 there).
//! A sphere that holds `a`, `b`, `e` and neither `c` nor `d` then says *nothing* about the sign of Δ. With
//! a, b = (0, 0, ±1) and c, d, e at distance 1 + s around the z axis, 120° apart, all three facets at the
//! edge `ab` have annuli of half-width ¾ s to first order, and yet moving every vertex by ½ s makes all five
//! cospherical. So in space the report's Proposition 1 is wrong, and its tolerance is not one.
//!
//! Let the points be separated for *each* of four partitions: `abe | cd`, and for each vertex e of the facet
//! `ab | ecd`. Then Δ > 0 whatever the signs of λ, as long as λ_c, λ_d > 0. A partition is separated
//!
//! - by a sphere with the first part (the facet, or `ab`) inside and the second outside: if the signs of λ
//!   are those of the partition, all terms of Δ are positive;
//! - or by a plane: then the hulls of both parts do not meet, so they are not the signs of λ. In the slab
//!   parallel to `ab` and `cd` let `ab` be at height 0. Then `c` and `d` are at height
//!   h = \[abcd\] / |ab × cd|, and e is at H = \[abec − abed\] / |ab × cd|. Choose the orientation so that
//!   H > 0. If h > 0, the plane at half the lesser of both excludes `ab | ecd`; if h < 0, that at h / 2
//!   excludes `abe | cd`. This costs hardly anything, as the vectors and volumes are those of the centre, and
//!   is enough unless `cd` passes close to `ab`.
//!
//! A sphere needs a margin only for the partition in force, that of the signs of λ: its sphere is the
//! [separator](super::separator3d). The least width that any other partition has is the
//! [`reach`](Delimiter::reach), and the tolerance is the lesser of half-width and reach. A safe region is
//! the side of the separator *within reach* of the position for which it was computed.
//!
//! # From bi-cells to the triangulation
//!
//! Move all vertices from the old to the new positions at constant speed and look at the first moment at
//! which some Δ vanishes or some cell has no volume. By the above it is the latter. The empty sphere of the
//! flat cell tends to a sphere or to a half-space. If to a sphere, its corners are cocircular or two of them
//! equal, and some partition 2 | 2 or 1 | 1 of them is not separated; but those above contain it. If to a
//! half-space, cells have flattened up to the hull, which the
//! [orientation tolerances](orientation_tolerance3d) of its cells and at its ridges exclude.
//!
//! So points must be on their sides *all the way*. Inside a sphere, and in a ball around the old position,
//! they are if they are at the end; outside a sphere they need not be. For safe regions, which are larger
//! than the balls of the tolerances, this is a second gap in Proposition 1, in both dimensions: a vertex can
//! jump across a delimiter, out on the other side, and invert a cell. See [`is_path_certainly_outside`].
//!
//! # With segments
//!
//! In the plane a bi-cell may have a segment for its facet, which stays whatever the circles are. The triangulation is the
//! constrained one as long as all cells are positive and Δ > 0 at all other facets. Look at the first moment again at which
//! a cell is flat: if its empty circle tends to a half-plane, cells have flattened up to the hull *or to a segment*, and
//! the orientation tolerance of the cell there excludes that. So that is all that is asked of the two cells at a segment.
//!
//! # Orientation
//!
//! D + 1 points get into one hyperplane no sooner than, for some partition of them (Radon), the hulls of both
//! parts meet. The parts are in the two faces of a slab whose normal n is orthogonal to all differences
//! within each part; its width is the determinant over |n|, with the *same* determinant for all partitions:
//! three heights in the plane; in space four heights and three distances of opposite edges. Points moved by
//! less than half the least width stay on their sides of all middles, and those moved by as much can be
//! brought together: the tolerance is det / (2 max |n|). Rounded: the determinant less the bound of
//! `filter.rs` (a last sum there counts relative to the result, 1 − u), over the greatest norm plus the error
//! of its components. A minor of differences is 8 u off, relative to extents; a sum of three minors 34 u, by
//! the rules of `filter.rs`;
//! |n| therefore at most √3 times that, in units of the largest extent squared.
//!
//! # Underflow
//!
//! Products that underflow are at most 2⁻¹⁰⁷⁵ off in addition. All thresholds are safe with coordinates of
//! any magnitude up to 1e57, subnormal ones included: distances are only trusted above 1e-140 ([`LEAST`]),
//! whose square is 2¹⁴⁰ times that error with u taken off, and determinants above 1e-250, where such an error
//! has been multiplied by a difference of at most 2e57.
//!
//! # Cost
//!
//! Time per bi-cell or cell of random points, on one core of a recent x86-64 server: [`delimiter2d`] 9 ns,
//! [`tolerances2d`] 8 ns; [`delimiter3d`] 82 ns; [`separator3d`] 94 ns, 74 ns if 0.01 spacings are enough,
//! 70 ns if anything is; [`tolerances3d`] 48, 26 and 21 ns; [`orientation_tolerance2d`] 5 ns,
//! [`orientation_tolerance3d`] 14 ns.
//!
//! [`delimiter3d`]: super::delimiter3d
//! [`separator3d`]: super::separator3d
//! [`tolerances3d`]: super::tolerances3d

use super::array::PointArray;
use super::filter::{extents, largest};
use super::lanes::BiCells;
use super::vectors::{cross, dot, minor, minus, plus, square_between, squared_distance};
use crate::simd::{LANES, Lanes, Real, Simd, in_lanes};

/// Delimiter of a bi-cell: a sphere with the interior facet inside and the opposing vertices outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delimiter<P> {
    /// Centre; not finite if it could not be computed, and then no point is certainly inside or outside.
    pub centre: P,
    /// Radius of the delimiter.
    pub radius: f64,
    /// Certified lower bound of the distance of the D + 2 points from this sphere, half
    /// the annulus width; 0 if none is certain.
    pub half_width: f64,
    /// Certified displacement of all D + 2 points up to which their sides of this sphere decide, see the
    /// module; infinite in the plane.
    pub reach: f64,
    /// Certified lower bound of the tolerance: the lesser of half-width and reach.
    pub tolerance: f64,
}

/// Unit roundoff, u.
pub(super) const UNIT: f64 = f64::EPSILON / 2.0;
/// Second-order terms, and the rounding of bounds.
const ROUND_UP: f64 = 1.0 + 1.0 / (1u64 << 40) as f64;
/// Distances below this count as this.
pub(super) const LEAST: f64 = 1e-140;
/// A determinant below this may be all underflow.
pub(super) const LEAST_DETERMINANT: f64 = 1e-250;
/// (1 − u)⁻ᵏ for distances, 3.5 u, and a product.
const ABOVE: f64 = 1.0 + 6.0 * UNIT;
/// (1 ± u)⁵ for squared distances, and two products.
const SQUARE_BELOW: f64 = 1.0 - 8.0 * UNIT;

/// (k + 1) u, k = (D + 4) / 2: what a half-width loses, in units of the outer radius.
const fn half_width_error(dimension: usize) -> f64 {
    (dimension + 6) as f64 / 2.0 * UNIT * ROUND_UP
}

/// Bounds of determinants / product of extents: 6 u and 40 u to first order (`filter.rs`).
/// Underflow is left to [`LEAST_DETERMINANT`].
pub(super) const ORIENT_2D: f64 = 7.0 * UNIT;
pub(super) const ORIENT_3D: f64 = 41.0 * UNIT;
/// Bound of a component of a vector product of differences / largest extent², times √3 or more.
pub(super) const CROSS: f64 = 14.0 * UNIT;
/// Bound of a component of the sum of three vector products / largest extent², times √3 or more.
const CROSS_SUM: f64 = 60.0 * UNIT;
/// Half, less 8 u: two roundings of the numerator, 4 of the denominator, a quotient and a product.
const HALF: f64 = 0.5 - 4.0 * UNIT;

/// Upper bound of the [way](PointArray::squared_way) from one to the other.
#[inline(always)]
pub fn distance_above<P: PointArray + PartialEq>(p: &P, q: &P) -> f64 {
    let square = p.squared_way(q);
    if square < LEAST * LEAST {
        return if p == q { 0.0 } else { LEAST * ABOVE };
    }
    square.sqrt() * ABOVE
}

/// Upper bounds of the ways of several points, each from another one.
#[inline(always)]
pub(crate) fn distances_above<S: Simd, P: PointArray + PartialEq>(
    simd: S,
    p: [&P; LANES],
    q: [&P; LANES],
) -> [f64; LANES] {
    let square = P::squared_ways(simd, p, q);
    if square.is_less(simd.splat(LEAST * LEAST)).bits() != 0 {
        return [0, 1, 2, 3].map(|k| distance_above(p[k], q[k]));
    }
    (square.sqrt() * simd.splat(ABOVE)).store()
}

/// What the [square of the way](PointArray::squared_way) of a vertex from its fixed position must be below for the way to be
/// certainly below its tolerance; 0, which nothing is below, if that is too small to tell.
#[inline(always)]
pub fn displacement_limit(tolerance: f64) -> f64 {
    limit(tolerance)
}

/// [`displacement_limit`] for any [`Real`].
#[inline(always)]
fn limit<T: Real>(tolerance: T) -> T {
    // Twice the least distance, so that its square is certainly above that of the least.
    let least = tolerance.splat(2.0 * LEAST);
    let t = T::select(least.is_less(tolerance), tolerance, tolerance.splat(0.0));
    // 1e150 is no restriction, and its square is finite.
    let t = t.min(t.splat(1e150));
    t * t * t.splat(SQUARE_BELOW)
}

/// For each of several vertices whether it is certainly nearer to its fixed position than its tolerance: one bit each.
#[inline(always)]
pub(crate) fn are_within<S: Simd, P: PointArray>(
    simd: S,
    fixed: [&P; LANES],
    tolerances: &[f64; LANES],
    places: [&P; LANES],
) -> u32 {
    P::squared_ways(simd, fixed, places).is_less(limit(simd.load(tolerances))).bits()
}

/// Whether `p` is certainly strictly inside the sphere.
#[inline(always)]
pub fn is_certainly_inside<P: AsRef<[f64]>>(centre: &P, radius: f64, p: &P) -> bool {
    squared_distance(centre, p) < displacement_limit(radius)
}

/// Whether a point that goes straight from one place to the other is certainly
/// strictly outside the sphere all the way.
///
/// By Stewart's theorem the middle of a segment is nowhere nearer, in squares, than the nearer end less a
/// quarter of the squared length.
#[inline(always)]
pub fn is_path_certainly_outside<P: AsRef<[f64]>>(centre: &P, radius: f64, from: &P, to: &P) -> bool {
    let square = Real::min(squared_distance(centre, from), squared_distance(centre, to));
    // (1 ± u)⁵ twice and three roundings.
    let limit = (radius * radius + 0.25 * squared_distance(from, to)) * (1.0 + 16.0 * UNIT);
    square > limit + LEAST * LEAST && square < f64::INFINITY
}

/// Lower bound of the distance of `p` from the sphere.
///
/// The rounded distance from the centre is (D + 4) / 2 u off, see the module, and its difference to the radius u
/// more; both in units of no more than the sum.
#[inline(always)]
pub fn distance_from_sphere<P: AsRef<[f64]>>(centre: &P, radius: f64, p: &P) -> f64 {
    let from_centre = squared_distance(centre, p).sqrt();
    let error = (radius + from_centre) * (8.0 * UNIT) + 2.0 * LEAST;
    non_negative((radius - from_centre).abs() - error)
}

/// Standard delimiter and tolerance of the bi-cell of a facet with opposing vertices `c` and `d`.
#[inline(always)]
pub fn delimiter2d(c: &[f64; 2], facet: [&[f64; 2]; 2], d: &[f64; 2]) -> Delimiter<[f64; 2]> {
    let (centre, radius, half_width) = annulus2d(&[*facet[0], *facet[1], *c, *d]);
    Delimiter { centre, radius, half_width, reach: f64::INFINITY, tolerance: half_width }
}

/// Tolerances of [`LANES`] bi-cells, as [`delimiter2d`] has them.
#[inline]
pub fn tolerances2d(bicells: &BiCells<2, 4>) -> [f64; LANES] {
    in_lanes!(simd => annulus2d(&bicells.lanes(simd)).2.store())
}

/// Centre, radius and half-width of the standard delimiter of a facet and two opposing vertices.
#[inline(always)]
fn annulus2d<T: Real>([o, f, c, d]: &[[T; 2]; 4]) -> ([T; 2], T, T) {
    let (u, w, s) = (minus(f, o), minus(c, d), plus(&minus(c, o), &minus(d, o)));
    // u·x = |u|² / 2 and w·x = w·s / 2, the bisectors, with x from o to the centre.
    let (uu, ws) = (dot(&u, &u), dot(&w, &s));
    let scale = o[0].splat(0.5) / minor(&u, &w);
    let centre = [o[0] + (uu * w[1] - ws * u[1]) * scale, o[1] + (ws * u[0] - uu * w[0]) * scale];
    let inner = square_between(&centre, o).max(square_between(&centre, f));
    let outer = square_between(&centre, c).min(square_between(&centre, d));
    let (radius, half_width) = middle::<T, 2>(inner, outer);
    (centre, radius, half_width)
}

/// Radius of the sphere in the middle and certified half-width, from the greatest squared distance of points
/// inside and the least of points outside.
#[inline(always)]
pub(super) fn middle<T: Real, const D: usize>(inner: T, outer: T) -> (T, T) {
    let (r, big) = (inner.sqrt(), outer.sqrt());
    let radius = r.splat(0.5) * (r + big);
    let lost = big * big.splat(const { half_width_error(D) }) + big.splat(2.0 * LEAST);
    let half_width = (radius - r).min(big - radius) - lost;
    // Also for NaN.
    (radius, half_width.max(half_width.splat(0.0)))
}

/// Certified lower bound of the tolerance of the orientation of a triangle: half its least height. 0 unless
/// the triangle is certainly positive.
#[inline]
pub fn orientation_tolerance2d([a, b, c]: [&[f64; 2]; 3]) -> f64 {
    let volume = minor(&minus(b, a), &minus(c, a));
    let [x, y] = extents([a, b, c]);
    let bound = ORIENT_2D * (x * y) + LEAST_DETERMINANT;
    let square = Real::max(Real::max(squared_distance(a, b), squared_distance(a, c)), squared_distance(b, c));
    non_negative((volume - bound) / (square.sqrt() + LEAST) * HALF)
}

/// Certified lower bound of the tolerance of the orientation of a tetrahedron: half the least of its heights
/// and of the distances of opposite edges. 0 unless the tetrahedron is certainly positive.
#[inline]
pub fn orientation_tolerance3d([a, b, c, d]: [&[f64; 3]; 4]) -> f64 {
    let (u, v, w) = (minus(b, a), minus(c, a), minus(d, a));
    let (uv, vw, wu) = (cross(&u, &v), cross(&v, &w), cross(&w, &u));
    let volume = dot(&w, &uv);
    let extents = extents([a, b, c, d]);
    let bound = ORIENT_3D * (extents[0] * extents[1] * extents[2]) + LEAST_DETERMINANT;
    let sum = plus(&uv, &vw);
    let normals = [uv, vw, wu, sum, plus(&vw, &wu), plus(&wu, &uv), plus(&sum, &wu)];
    let square = normals.iter().fold(0.0, |square, n| Real::max(square, dot(n, n)));
    let largest = largest(extents);
    non_negative((volume - bound) / (square.sqrt() + (CROSS_SUM * (largest * largest) + LEAST)) * HALF)
}

/// Zero for negative numbers and NaN, which overflow gives.
#[inline(always)]
fn non_negative(x: f64) -> f64 {
    if x > 0.0 && x < f64::INFINITY { x } else { 0.0 }
}

#[cfg(test)]
mod tests;
