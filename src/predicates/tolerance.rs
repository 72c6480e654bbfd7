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
//! passes the facet beyond the edge `ab`, as it does in two thirds of the bi-cells of random points (a flip
//! would be 3-2 there).
//! A sphere that holds `a`, `b`, `e` and neither `c` nor `d` then says *nothing* about the sign of Δ. With
//! a, b = (0, 0, ±1) and c, d, e at distance 1 + s around the z axis, 120° apart, all three facets at the edge
//! `ab` have annuli of half-width ¾ s to first order, and yet moving every vertex by ½ s makes all five
//! cospherical. So in space the report's Proposition 1 is wrong, and its tolerance is not one.
//!
//! Let the points be separated for *each* of four partitions: `abe | cd`, and for each vertex e of the facet
//! `ab | ecd`. Then Δ > 0 whatever the signs of λ, as long as λ_c, λ_d > 0. A partition is separated
//!
//! - by a sphere with the first part (the facet, or `ab`) inside and the second outside: if the signs of λ are those
//!   of the partition, all terms of Δ are positive;
//! - or by a plane: then the hulls of both parts do not meet, so they are not the signs of λ. In the slab parallel to `ab`
//!   and `cd` let `ab` be at height 0. Then `c` and `d` are at height h = \[abcd\] / |ab × cd|, and e is at
//!   H = \[abec − abed\] / |ab × cd|. Choose the orientation so that H > 0. If h > 0, the plane at half the lesser of
//!   both excludes `ab | ecd`; if h < 0, that at h / 2 excludes `abe | cd`. This costs hardly anything, as
//!   the vectors and volumes are those of the centre, and is enough unless `cd` passes close to `ab`.
//!
//! A sphere needs a margin only for the partition in force, that of the signs of λ: its sphere is the
//! [separator](separator3d). The least width that any other partition has is the [`reach`](Delimiter::reach),
//! and the tolerance is the lesser of half-width and reach. A safe region is the side of the separator *within reach* of
//! the position for which it was computed.
//!
//! # From bi-cells to the triangulation
//!
//! Move all vertices from the old to the new positions at constant speed and look at the first moment at which some Δ
//! vanishes or some cell has no volume. By the above it is the latter. The empty sphere of the flat cell tends to a
//! sphere or to a half-space. If to a sphere, its corners are cocircular or two of them equal, and some partition
//! 2 | 2 or 1 | 1 of them is not separated; but those above contain it. If to a half-space, cells have flattened up to
//! the hull, which the [orientation tolerances](orientation_tolerance3d) of its cells and at its ridges exclude.
//!
//! So points must be on their sides *all the way*. Inside a sphere, and in a ball around the old position, they are
//! if they are at the end; outside a sphere they need not be. For safe regions, which are larger than the balls of
//! the tolerances, this is a second gap in Proposition 1, in both dimensions: a vertex can jump across a delimiter,
//! out on the other side, and invert a cell. See [`is_path_certainly_outside`].
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
//!
//! # Cost
//!
//! Time per call for the bi-cells and cells of random points, on one core of a recent x86-64 server: [`delimiter2d`] 9 ns;
//! [`delimiter3d`] 74 ns; [`separator3d`] 73 ns, 46 ns if 0.01 spacings are enough, 40 ns if anything is;
//! [`orientation_tolerance2d`] 5 ns, [`orientation_tolerance3d`] 14 ns.

use super::filter::{extents, largest};

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
    /// Certified displacement of all D + 2 points up to which their sides of this sphere decide, see the module; infinite
    /// in the plane.
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

/// Bounds of determinants / product of extents: 6 u and 40 u to first order (`filter.rs`). Underflow is left to
/// [`LEAST_DETERMINANT`], as the bounds there multiply a subnormal number, which takes longer than all the rest.
const ORIENT_2D: f64 = 7.0 * UNIT;
const ORIENT_3D: f64 = 41.0 * UNIT;
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

/// Whether a point that goes straight from one place to the other is certainly strictly outside the sphere all the way.
///
/// By Stewart's theorem the middle of a segment is nowhere nearer, in squares, than the nearer end less a quarter of
/// the squared length.
#[inline(always)]
pub fn is_path_certainly_outside<const D: usize>(
    centre: &[f64; D],
    radius: f64,
    from: &[f64; D],
    to: &[f64; D],
) -> bool {
    let square = min(squared_distance(centre, from), squared_distance(centre, to));
    // (1 ± u)⁵ twice and three roundings.
    let limit = (radius * radius + 0.25 * squared_distance(from, to)) * (1.0 + 16.0 * UNIT);
    square > limit + LEAST * LEAST && square < f64::INFINITY
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
///
/// [`separator3d`] is faster, and better where the report's sphere is not the one that limits the tolerance.
#[inline]
pub fn delimiter3d(c: &[f64; 3], facet: [&[f64; 3]; 3], d: &[f64; 3]) -> Delimiter<[f64; 3]> {
    let points = [facet[0], facet[1], facet[2], c, d];
    let mut delimiter = Annulus::new(points, STANDARD).delimiter(STANDARD);
    let planes = Slabs::new(points).squared_widths(STANDARD);
    delimiter.reach = reach(points, STANDARD, &planes, delimiter.half_width);
    delimiter.tolerance = min(delimiter.half_width, delimiter.reach);
    delimiter
}

/// The delimiter that decides about a bi-cell: with the interior facet inside, but for one of its vertices where the line
/// `cd` passes the facet beyond the edge opposite that vertex; the opposing vertices and that one are outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separator<P> {
    /// The sphere, and how far the points may move before another one decides.
    pub delimiter: Delimiter<P>,
    /// Index of the vertex of the facet that is outside, D if none is.
    pub exception: u8,
}

/// Separator and tolerance of the bi-cell of a facet with opposing vertices `c` and `d`.
///
/// A tolerance of at least `enough` is not improved any further, which halves the cost.
#[inline]
pub fn separator3d(c: &[f64; 3], facet: [&[f64; 3]; 3], d: &[f64; 3], enough: f64) -> Separator<[f64; 3]> {
    let points = [facet[0], facet[1], facet[2], c, d];
    let slabs = Slabs::new(points);
    match slabs.partition() {
        0 => separator::<0>(points, &slabs, enough),
        1 => separator::<1>(points, &slabs, enough),
        2 => separator::<2>(points, &slabs, enough),
        _ => separator::<STANDARD>(points, &slabs, enough),
    }
}

#[inline(always)]
fn separator<const P: usize>(points: [&[f64; 3]; 5], slabs: &Slabs, enough: f64) -> Separator<[f64; 3]> {
    let mut delimiter = Annulus::new(points, P).delimiter(P);
    let wanted = min(delimiter.half_width, enough);
    delimiter.reach = reach(points, P, &slabs.squared_widths(P), wanted);
    delimiter.tolerance = min(delimiter.half_width, delimiter.reach);
    Separator { delimiter, exception: P as u8 }
}

/// The partition of the standard delimiter. The others have the number of the vertex of the facet that is outside.
const STANDARD: usize = 3;

/// The points of each partition, first the side of three, then that of two: the vertices of the facet are 0 to 2, `c` and `d`
/// are 3 and 4.
const SIDES: [[usize; 5]; 4] = [[0, 3, 4, 1, 2], [1, 3, 4, 2, 0], [2, 3, 4, 0, 1], [0, 1, 2, 3, 4]];

/// The least of what excludes the partitions other than the given one: a plane or, where that leaves less than
/// wanted, a sphere if it leaves more.
#[inline(always)]
fn reach(points: [&[f64; 3]; 5], partition: usize, planes: &[f64; 4], wanted: f64) -> f64 {
    let least = min(min(planes[0], planes[1]), min(planes[2], planes[3]));
    let reach = half_of_square(least);
    if reach >= wanted { reach } else { reach_by_spheres(points, partition, planes, wanted) }
}

#[cold]
#[inline(never)]
fn reach_by_spheres(points: [&[f64; 3]; 5], partition: usize, planes: &[f64; 4], wanted: f64) -> f64 {
    let mut reach = f64::INFINITY;
    for (k, &plane) in planes.iter().enumerate().filter(|(k, _)| *k != partition) {
        let mut width = half_of_square(plane);
        if width < wanted {
            width = max(width, Annulus::new(points, k).delimiter(k).half_width);
        }
        reach = min(reach, width);
    }
    reach
}

/// Half the width of which this is the square, as a lower bound; infinite if that is.
#[inline(always)]
fn half_of_square(square: f64) -> f64 {
    max(square.sqrt() * (0.5 - 8.0 * UNIT) - LEAST, 0.0)
}

/// Five points around the point that is equidistant from the three on one side and from the two on the other.
struct Annulus {
    centre: [f64; 3],
    /// Squared distances from the centre.
    three: [f64; 3],
    two: [f64; 2],
}

impl Annulus {
    #[inline(always)]
    fn new(points: [&[f64; 3]; 5], partition: usize) -> Self {
        let [o, f, g, c, d] = SIDES[partition].map(|i| points[i]);
        let (u, v, w) = (minus(f, o), minus(g, o), minus(c, d));
        let (p, q) = (minus(c, o), minus(d, o));
        // u·x = |u|² / 2, v·x = |v|² / 2 and w·x = w·s / 2, the bisectors, with x from o to the centre.
        let (vw, wu, uv) = (cross(&v, &w), cross(&w, &u), cross(&u, &v));
        let scale = 0.5 / dot(&u, &vw);
        let (uu, vv) = (dot(&u, &u), dot(&v, &v));
        let ws = w[0] * (p[0] + q[0]) + w[1] * (p[1] + q[1]) + w[2] * (p[2] + q[2]);
        let centre: [f64; 3] = std::array::from_fn(|k| o[k] + (uu * vw[k] + vv * wu[k] + ws * uv[k]) * scale);
        Annulus {
            centre,
            three: [o, f, g].map(|p| squared_distance(&centre, p)),
            two: [c, d].map(|p| squared_distance(&centre, p)),
        }
    }

    /// The sphere in the middle, if it has the right side inside: the side of two but in the standard partition.
    #[inline(always)]
    fn delimiter(&self, partition: usize) -> Delimiter<[f64; 3]> {
        let Annulus { centre, three: [a, b, c], two: [d, e] } = *self;
        let (inner, outer) = if partition == STANDARD {
            (max(max(a, b), c), min(d, e))
        } else {
            (max(d, e), min(min(a, b), c))
        };
        let (radius, half_width) = middle::<3>(inner, outer);
        Delimiter { centre, radius, half_width, reach: 0.0, tolerance: 0.0 }
    }
}

/// The slabs parallel to the line `cd` and to one edge of the facet each.
struct Slabs {
    /// By the vertex opposite the edge. Heights are above the edge, in units of 1 / |normal|.
    normals: [[f64; 3]; 3],
    /// Height of the line.
    heights: [f64; 3],
    /// Height of the vertex: six times the volume of both cells.
    volume: f64,
    /// Error bound of heights.
    bound: f64,
    /// Error bound of squared norms of normals.
    blur: f64,
}

impl Slabs {
    #[inline(always)]
    fn new(points: [&[f64; 3]; 5]) -> Self {
        let [o, f, g, c, d] = points;
        let (u, v, w) = (minus(f, o), minus(g, o), minus(c, d));
        let normals = [cross(&minus(g, f), &w), cross(&v, &w), cross(&w, &u)];
        let volume = dot(&u, &normals[1]);
        let heights =
            [-dot(&minus(c, f), &normals[0]), dot(&minus(c, g), &normals[1]), dot(&minus(c, o), &normals[2])];
        let sign = 1f64.copysign(volume);
        let extents = extents(points);
        let square = largest(extents) * largest(extents);
        Slabs {
            normals,
            heights: heights.map(|height| height * sign),
            volume: volume.abs(),
            bound: ORIENT_3D * (extents[0] * extents[1] * extents[2]) + LEAST_DETERMINANT,
            // (|n| + CROSS square)², where |n| is below 3.47 square.
            blur: (7.0 * CROSS) * (square * square) + LEAST * LEAST,
        }
    }

    /// The partition by the signs of the affine dependency.
    #[inline(always)]
    fn partition(&self) -> usize {
        const FIRST: [u8; 8] = [3, 0, 1, 0, 2, 0, 1, 0];
        let [x, y, z] = self.heights.map(|height| usize::from(height < 0.0));
        usize::from(FIRST[x + 2 * y + 4 * z])
    }

    /// Lower bounds, to 16 u, of the squared widths of the slabs that exclude the partitions; 0 for a partition whose slab does
    /// not separate its sides, infinity for the given one.
    #[inline(always)]
    fn squared_widths(&self, partition: usize) -> [f64; 4] {
        let mut widths = [0.0; 4];
        // The width of the slab of the given partition, if it has one, is that of the standard partition: a negative
        // height has the line beyond the edge, and the slab separates it from the whole facet.
        for k in 0..3 {
            let n = &self.normals[k];
            let height = max(min(self.heights[k].abs(), self.volume) - self.bound, 0.0);
            let width = height / (dot(n, n) + self.blur) * height;
            widths[k] = if self.heights[k] > 0.0 { width } else { 0.0 };
            widths[3] = if partition == k { width } else { widths[3] };
        }
        widths[partition] = f64::INFINITY;
        widths
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
    let [x, y] = extents([a, b, c]);
    let bound = ORIENT_2D * (x * y) + LEAST_DETERMINANT;
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
    let bound = ORIENT_3D * (extents[0] * extents[1] * extents[2]) + LEAST_DETERMINANT;
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
