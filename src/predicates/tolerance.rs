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
//! than the nearest opposing vertex, at R'. So C' is computed by any formula, and errors are bounded from there:
//! those of five distances between given points. What the error of C' costs is width, and very little of that.
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
//! of all D + 2 points from the *stored* sphere, the rounding of its centre and radius included. A form free of
//! cancellation, R² − r² = (c − f)·((c − C) + (f − C)), would not do better here: the stored centre
//! alone is u R off.
//!
//! # In the plane, this proves the triangulation
//!
//! Let λ be the affine dependency of the moved points, λ_c and λ_d > 0 (the two cells are positive). For any
//! sphere, the in-sphere determinant is Δ = Σ λᵢ powᵢ, a sum over the powers of the points. If all vertices of
//! the facet have λ < 0, a delimiter makes every term positive. In the plane the only other case is that one
//! point is in the hull of the others, and then Δ > 0 by convexity of the lift.
//!
//! # In space it does not
//!
//! There, λ may be negative for two vertices a, b of the facet and positive for the third, e: the line `cd`
//! passes the facet beyond the edge `ab`, as it does in nearly half of all bi-cells, where the flip would be 3-2.
//! A sphere that holds `a`, `b`, `e` and neither `c` nor `d` then says *nothing* about the sign of Δ. With
//! a, b = (0, 0, ±1) and c, d, e at distance 1 + s around the z axis, 120° apart, all three facets at the edge
//! `ab` have annuli of half-width ¾ s to first order, and yet moving every vertex by ½ s makes all five
//! cospherical. So in space the report's Proposition 1 is wrong, and its tolerance is not one.
//!
//! Δ > 0 holds whatever the signs of λ if the points are separated for *each* of the four partitions: `abe | cd` by
//! the delimiter, and for each vertex e of the facet `ab | ecd`
//!
//! - either by a sphere with `a`, `b` inside and the others outside, which gives the sign as before,
//! - or by a plane: the hulls of both parts do not meet, so these are not the signs of λ. The slab parallel to
//!   `ab` and `cd` has `c` and `d` at height \[abcd\] and `e` at \[abed\] − \[abec\], over the area of
//!   |ab × cd|; by its half-width it excludes the partition at hardly any cost, unless `cd` passes close to `ab`.
//!
//! The least of the three is the [`reach`](Delimiter::reach) of the bi-cell, and its tolerance is the lesser of
//! half-width and reach. For the proof that tolerances preserve a whole triangulation, move all vertices at
//! constant speed and look at the first moment at which some cell has no volume or some Δ vanishes. Not Δ alone,
//! by the above. The empty sphere of a flat cell tends to a sphere or a half-space. If a sphere, its corners are
//! cocircular, hence of a partition 2 | 2, which is one of those above, excluded. If a half-space, the hull has
//! changed, which the [orientation tolerances](orientation_tolerance3d) of cells and ridges on the hull
//! exclude.
//!
//! # Orientation
//!
//! D + 1 points get into one hyperplane no sooner than, for some partition of them (Radon), the hulls of both
//! parts meet. The parts are in the two faces of a slab whose normal n is orthogonal to all differences within
//! each part; its width is the determinant over |n|, with the *same* determinant for all partitions: three
//! heights in the plane; in space four heights and three distances of opposite edges. Points moved by less than
//! half the least width stay on their sides of all middles, and those moved by as much can be brought together:
//! the tolerance is det / (2 max |n|). Rounded: the determinant less the bound of `filter.rs` (a last sum there
//! counts relative to the result, 1 − u), over the greatest norm plus the error of its components. A minor
//! of differences is 8 u off, relative to extents; a sum of three minors 34 u, by the rules of `filter.rs`;
//! |n| therefore at most √3 times that, in units of the largest extent squared.
//!
//! # Underflow
//!
//! Products that underflow are at most 2⁻¹⁰⁷⁵ off in addition. All thresholds are safe with coordinates of any
//! magnitude up to 1e57, subnormal ones included: distances are only trusted above 1e-140 ([`LEAST`]),
//! whose square is 2¹⁴⁰ times that error with u taken off, and determinants above 1e-250, where such an error has been
//! multiplied by a difference of at most 2e57.

use super::filter::{extents, largest, orient2d_bound, orient3d_bound};

/// Delimiter of a bi-cell: a sphere with the interior facet inside and the opposing vertices outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delimiter<P> {
    /// Centre; not finite if it could not be computed, and then no point is certainly inside or outside.
    pub centre: P,
    /// Radius of the delimiter.
    pub radius: f64,
    /// Certified lower bound of the distance of the D + 2 points from this sphere, half the annulus width; 0 if none
    /// is certain.
    pub half_width: f64,
    /// Certified: whatever the orientation of other simplices becomes, the bi-cell stays Delaunay as long as its points
    /// move by less than this, its cells keep their orientation, *and* the points stay on their sides of the
    /// sphere. Infinite in the plane; see the module on why not in space.
    pub reach: f64,
    /// Certified lower bound of the tolerance: the lesser of half-width and reach.
    pub tolerance: f64,
}

/// Unit roundoff, u.
const UNIT: f64 = f64::EPSILON / 2.0;
/// Second-order terms, and the rounding of bounds.
const ROUND_UP: f64 = 1.0 + 1.0 / (1u64 << 40) as f64;
/// Distances below this are taken for it.
const LEAST: f64 = 1e-140;
/// A determinant below this may be all underflow.
const LEAST_DETERMINANT: f64 = 1e-250;
/// (1 − u)⁻ᵏ for distances, 3.5 u, and a product.
const ABOVE: f64 = 1.0 + 6.0 * UNIT;
/// (1 ± u)⁵ for squared distances, and two products.
const SQUARE_BELOW: f64 = 1.0 - 8.0 * UNIT;
const SQUARE_ABOVE: f64 = 1.0 + 8.0 * UNIT;

/// (k + 1) u, k = (D + 4) / 2: what a half-width loses, in units of the outer radius.
const fn half_width_error(dimension: usize) -> f64 {
    (dimension + 6) as f64 / 2.0 * UNIT * ROUND_UP
}

/// Bound of a component of a vector product of differences / largest extent², times √3 or more.
const CROSS: f64 = 14.0 * UNIT;
/// The same for the sum of three.
const CROSS_SUM: f64 = 60.0 * UNIT;
/// Half, less 8 u: two roundings of the numerator, 4 of the denominator, a quotient and a product.
const HALF: f64 = 0.5 - 4.0 * UNIT;

/// Squared distance, in the order of operations that the thresholds of this module certify.
#[inline(always)]
pub fn squared_distance<const D: usize>(p: &[f64; D], q: &[f64; D]) -> f64 {
    let mut sum = (p[0] - q[0]) * (p[0] - q[0]);
    for axis in 1..D {
        sum += (p[axis] - q[axis]) * (p[axis] - q[axis]);
    }
    sum
}

/// Upper bound of the distance.
#[inline(always)]
pub fn distance_above<const D: usize>(p: &[f64; D], q: &[f64; D]) -> f64 {
    let square = squared_distance(p, q);
    if square < LEAST * LEAST {
        return if p == q { 0.0 } else { LEAST * ABOVE };
    }
    square.sqrt() * ABOVE
}

/// What the [`squared_distance`] of a vertex from its fixed position must be below for the distance to be certainly below
/// its tolerance; 0, which nothing is below, if that is too small to tell.
#[inline(always)]
pub fn displacement_limit(tolerance: f64) -> f64 {
    // Twice the least distance, so that its square is certainly above that of the least.
    if tolerance >= 2.0 * LEAST {
        // 1e150 is no restriction, and its square is finite.
        let t = if tolerance < 1e150 { tolerance } else { 1e150 };
        t * t * SQUARE_BELOW
    } else {
        0.0
    }
}

/// Whether `p` is certainly strictly inside the sphere.
#[inline(always)]
pub fn is_certainly_inside<const D: usize>(centre: &[f64; D], radius: f64, p: &[f64; D]) -> bool {
    squared_distance(centre, p) < displacement_limit(radius)
}

/// Whether `p` is certainly strictly outside the sphere.
#[inline(always)]
pub fn is_certainly_outside<const D: usize>(centre: &[f64; D], radius: f64, p: &[f64; D]) -> bool {
    // The finite bound excludes overflow, of which nothing follows.
    let square = squared_distance(centre, p);
    square > radius * radius * SQUARE_ABOVE + LEAST * LEAST && square < f64::INFINITY
}

/// Standard delimiter and tolerance of the bi-cell of a facet with opposing vertices `c` and `d`.
#[inline(always)]
pub fn delimiter2d(c: &[f64; 2], facet: [&[f64; 2]; 2], d: &[f64; 2]) -> Delimiter<[f64; 2]> {
    let [o, f] = facet;
    let (u, w) = ([f[0] - o[0], f[1] - o[1]], [c[0] - d[0], c[1] - d[1]]);
    let s = [(c[0] - o[0]) + (d[0] - o[0]), (c[1] - o[1]) + (d[1] - o[1])];
    // u·x = |u|² / 2 and w·x = w·s / 2, the bisectors, with x from o to the centre.
    let (uu, ws) = (u[0] * u[0] + u[1] * u[1], w[0] * s[0] + w[1] * s[1]);
    let scale = 0.5 / (u[0] * w[1] - u[1] * w[0]);
    let centre = [o[0] + (uu * w[1] - ws * u[1]) * scale, o[1] + (ws * u[0] - uu * w[0]) * scale];
    let inner = max(squared_distance(&centre, o), squared_distance(&centre, f));
    let outer = min(squared_distance(&centre, c), squared_distance(&centre, d));
    let (radius, half_width) = middle::<2>(inner, outer);
    Delimiter { centre, radius, half_width, reach: f64::INFINITY, tolerance: half_width }
}

/// Standard delimiter and tolerance of the bi-cell of a facet with opposing vertices `c` and `d`.
#[inline]
pub fn delimiter3d(c: &[f64; 3], facet: [&[f64; 3]; 3], d: &[f64; 3]) -> Delimiter<[f64; 3]> {
    let annulus = Annulus::new(facet, [c, d]);
    let inner = max(max(annulus.triple[0], annulus.triple[1]), annulus.triple[2]);
    let outer = min(annulus.pair[0], annulus.pair[1]);
    let (radius, half_width) = middle::<3>(inner, outer);
    let planes = annulus.planes(c, facet, d);
    let least = min(min(planes[0], planes[1]), planes[2]);
    let reach = if least >= (2.0 * half_width) * (2.0 * half_width) {
        half_of_square(least)
    } else {
        reach_by_spheres(c, facet, d, planes, half_width)
    };
    Delimiter { centre: annulus.centre, radius, half_width, reach, tolerance: min(half_width, reach) }
}

/// The reach where a plane does not do: for such an edge `ab` of the facet, the better of the plane and the sphere with
/// `a` and `b` inside and the other three outside.
#[inline(never)]
fn reach_by_spheres(
    c: &[f64; 3],
    facet: [&[f64; 3]; 3],
    d: &[f64; 3],
    planes: [f64; 3],
    half_width: f64,
) -> f64 {
    let mut reach = f64::INFINITY;
    for (k, plane) in planes.into_iter().enumerate() {
        let mut width = half_of_square(plane);
        if width < half_width {
            let annulus = Annulus::new([facet[k], c, d], [facet[(k + 1) % 3], facet[(k + 2) % 3]]);
            let outer = min(min(annulus.triple[0], annulus.triple[1]), annulus.triple[2]);
            let (_, sphere) = middle::<3>(max(annulus.pair[0], annulus.pair[1]), outer);
            width = max(width, sphere);
        }
        reach = min(reach, width);
    }
    reach
}

/// Half the width of which this is the square, as a lower bound.
#[inline(always)]
fn half_of_square(square: f64) -> f64 {
    non_negative(square.sqrt() * (0.5 - 8.0 * UNIT) - LEAST)
}

/// Five points around the point that is equidistant from three of them and from the other two.
struct Annulus {
    centre: [f64; 3],
    /// Squared distances from the centre.
    triple: [f64; 3],
    pair: [f64; 2],
    /// Normals of the slabs parallel to the line of the pair and to the edge opposite each of the three.
    normals: [[f64; 3]; 3],
    /// Six times the volume of both cells, signed.
    volume: f64,
}

impl Annulus {
    #[inline(always)]
    fn new(triple: [&[f64; 3]; 3], pair: [&[f64; 3]; 2]) -> Self {
        let ([o, f, g], [c, d]) = (triple, pair);
        let (u, v, w) = (minus(f, o), minus(g, o), minus(c, d));
        let (p, q) = (minus(c, o), minus(d, o));
        // u·x = |u|² / 2, v·x = |v|² / 2 and w·x = w·s / 2, the bisectors, with x from o to the centre.
        let (vw, wu, uv) = (cross(&v, &w), cross(&w, &u), cross(&u, &v));
        let volume = dot(&u, &vw);
        let scale = 0.5 / volume;
        let (uu, vv) = (dot(&u, &u), dot(&v, &v));
        let ws = w[0] * (p[0] + q[0]) + w[1] * (p[1] + q[1]) + w[2] * (p[2] + q[2]);
        let centre: [f64; 3] = std::array::from_fn(|k| o[k] + (uu * vw[k] + vv * wu[k] + ws * uv[k]) * scale);
        Annulus {
            centre,
            triple: triple.map(|p| squared_distance(&centre, p)),
            pair: pair.map(|p| squared_distance(&centre, p)),
            // Opposite o, f, g.
            normals: [cross(&minus(g, f), &w), vw, wu],
            volume,
        }
    }

    /// Lower bounds of the squared widths of the three slabs, to 16 u; 0 where a plane does not separate.
    #[inline(always)]
    fn planes(&self, c: &[f64; 3], facet: [&[f64; 3]; 3], d: &[f64; 3]) -> [f64; 3] {
        let [o, f, g] = facet;
        let extents = extents([c, o, f, g, d]);
        let bound = orient3d_bound(extents) + LEAST_DETERMINANT;
        let square = largest(extents) * largest(extents);
        // (|n| + CROSS square)², where |n| is below 3.47 square.
        let blur = (7.0 * CROSS) * (square * square) + LEAST * LEAST;
        let sign = 1f64.copysign(self.volume);
        std::array::from_fn(|k| {
            let n = &self.normals[k];
            let from = minus(c, facet[(k + 1) % 3]);
            // Height of the pair above the edge, in units of 1 / |n|; the third vertex is at the volume.
            let height = if k == 0 { -dot(&from, n) } else { dot(&from, n) };
            let height = max(min(height * sign, self.volume * sign) - bound, 0.0);
            height / (dot(n, n) + blur) * height
        })
    }
}

/// Radius of the sphere in the middle and certified half-width, from the greatest squared distance of points inside
/// and the least of points outside.
#[inline(always)]
fn middle<const D: usize>(inner: f64, outer: f64) -> (f64, f64) {
    let (r, big) = (inner.sqrt(), outer.sqrt());
    let radius = 0.5 * (r + big);
    let half_width = min(radius - r, big - radius) - (big * const { half_width_error(D) } + 2.0 * LEAST);
    (radius, if half_width > 0.0 { half_width } else { 0.0 })
}

/// Certified lower bound of the tolerance of the orientation of a triangle: half its least height. 0 unless the triangle
/// is certainly positive.
#[inline]
pub fn orientation_tolerance2d([a, b, c]: [&[f64; 2]; 3]) -> f64 {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let volume = u[0] * v[1] - u[1] * v[0];
    let bound = orient2d_bound(extents([a, b, c])) + LEAST_DETERMINANT;
    let square = max(max(squared_distance(a, b), squared_distance(a, c)), squared_distance(b, c));
    non_negative((volume - bound) / (square.sqrt() + LEAST) * HALF)
}

/// Certified lower bound of the tolerance of the orientation of a tetrahedron: half the least of its heights and of the
/// distances of opposite edges. 0 unless the tetrahedron is certainly positive.
#[inline]
pub fn orientation_tolerance3d([a, b, c, d]: [&[f64; 3]; 4]) -> f64 {
    let (u, v, w) = (minus(b, a), minus(c, a), minus(d, a));
    let (uv, vw, wu) = (cross(&u, &v), cross(&v, &w), cross(&w, &u));
    let volume = dot(&w, &uv);
    let extents = extents([a, b, c, d]);
    let bound = orient3d_bound(extents) + LEAST_DETERMINANT;
    let plus = |p: &[f64; 3], q: &[f64; 3]| [p[0] + q[0], p[1] + q[1], p[2] + q[2]];
    let sum = plus(&uv, &vw);
    let normals = [uv, vw, wu, sum, plus(&vw, &wu), plus(&wu, &uv), plus(&sum, &wu)];
    let square = normals.iter().fold(0.0, |square, n| max(square, dot(n, n)));
    let largest = largest(extents);
    non_negative((volume - bound) / (square.sqrt() + (CROSS_SUM * (largest * largest) + LEAST)) * HALF)
}

/// Zero for negative numbers and NaN, which overflow gives.
#[inline(always)]
fn non_negative(x: f64) -> f64 {
    if x > 0.0 && x < f64::INFINITY { x } else { 0.0 }
}

// One instruction each, unlike those of `f64` with their regard for NaN.
#[inline(always)]
fn min(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[inline(always)]
fn minus(p: &[f64; 3], q: &[f64; 3]) -> [f64; 3] {
    [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
}

#[inline(always)]
fn dot(p: &[f64; 3], q: &[f64; 3]) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

#[inline(always)]
fn cross(p: &[f64; 3], q: &[f64; 3]) -> [f64; 3] {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}
