//! Delimiters and separators of space: see [`tolerance`](super::tolerance).

use super::lanes::BiCells;
use super::tolerance::{CROSS, Delimiter, LEAST, LEAST_DETERMINANT, ORIENT_3D, UNIT, middle};
use super::vectors::{cross, dot, minus, plus, square_between};
use crate::simd::{ALL, LANES, Lanes, Real, Simd, in_lanes};

/// The points of a bi-cell: the vertices of the facet, then the opposing ones, `c` and `d`.
type BiCellPoints<T> = [[T; 3]; 5];

/// Standard delimiter and tolerance of the bi-cell of a facet with opposing vertices `c` and `d`.
///
/// [`separator3d`] is better where the report's sphere is not the one that limits the tolerance.
#[inline]
pub fn delimiter3d(c: &[f64; 3], facet: [&[f64; 3]; 3], d: &[f64; 3]) -> Delimiter<[f64; 3]> {
    let points = [*facet[0], *facet[1], *facet[2], *c, *d];
    separate::<f64, false>(&points, f64::INFINITY, 1.0).delimiter(&points, STANDARD, f64::INFINITY)
}

/// The delimiter that decides about a bi-cell: with the interior facet inside, but for one of its vertices
/// where the line `cd` passes the facet beyond the edge opposite that vertex; the opposing vertices and that
/// one are outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separator<P> {
    /// The sphere, and how far the points may move before another one decides.
    pub delimiter: Delimiter<P>,
    /// Index of the vertex of the facet that is outside, D if none is.
    pub exception: u8,
}

/// Separator and tolerance of the bi-cell of a facet with opposing vertices `c` and `d`.
///
/// A tolerance of at least `enough` is not improved any further.
#[inline]
pub fn separator3d(c: &[f64; 3], facet: [&[f64; 3]; 3], d: &[f64; 3], enough: f64) -> Separator<[f64; 3]> {
    let points = [*facet[0], *facet[1], *facet[2], *c, *d];
    let separated = separate::<f64, true>(&points, enough, 1.0);
    let exception = separated.outside.iter().position(|&k| k).unwrap_or(STANDARD);
    Separator { delimiter: separated.delimiter(&points, exception, enough), exception: exception as u8 }
}

/// Tolerances of [`LANES`] bi-cells, as [`separator3d`] has them, or at least this `share` of them, of 1 at most: no
/// sphere is looked for where planes leave as much as that.
#[inline]
pub fn tolerances3d(bicells: &BiCells<3, 5>, enough: [f64; LANES], share: f64) -> [f64; LANES] {
    in_lanes!(simd => tolerances_in_lanes(simd, bicells, &enough, share))
}

#[inline(always)]
fn tolerances_in_lanes<S: Simd>(
    simd: S,
    bicells: &BiCells<3, 5>,
    enough: &[f64; LANES],
    share: f64,
) -> [f64; LANES] {
    let separated = separate::<_, true>(&bicells.lanes(simd), simd.load(enough), simd.splat(share));
    let mut tolerances = separated.half_width.min(separated.reach).store();
    let is_enough = separated.is_enough.bits();
    if is_enough != ALL {
        let [x, y, z] = separated.outside;
        let outside = [x.bits(), y.bits(), z.bits()];
        let [o, f, g, s] = separated.planes;
        let planes = [o.store(), f.store(), g.store(), s.store()];
        let half_widths = separated.half_width.store();
        for i in (0..LANES).filter(|i| is_enough >> i & 1 == 0) {
            let partition = outside.iter().position(|bits| bits >> i & 1 != 0).unwrap_or(STANDARD);
            let wanted = Real::min(half_widths[i], enough[i]) * share;
            let reach = reach_by_spheres(&bicells.lane(i), partition, &planes.map(|p| p[i]), wanted);
            tolerances[i] = Real::min(half_widths[i], reach);
        }
    }
    tolerances
}

/// The partition of the standard delimiter. The others have the number of the vertex of the facet that is
/// outside.
const STANDARD: usize = 3;

/// The points of each partition, first the side of three, then that of two: the vertices of the facet are 0
/// to 2, `c` and `d` are 3 and 4.
const SIDES: [[usize; 5]; 4] = [[0, 3, 4, 1, 2], [1, 3, 4, 2, 0], [2, 3, 4, 0, 1], [0, 1, 2, 3, 4]];

/// The sphere of one partition, and the planes that exclude the others.
struct Separated<T: Real> {
    centre: [T; 3],
    radius: T,
    half_width: T,
    /// Whether the partition is that of each vertex of the facet; the standard one if none is set.
    outside: [T::Mask; 3],
    /// Lower bounds, to 16 u, of the squared widths of the slabs that exclude the partitions; 0 for a
    /// partition whose slab does not separate its sides, infinity for the given one.
    planes: [T; 4],
    /// Half the least width of these slabs: how far the points may move until one of them decides nothing any more.
    reach: T,
    /// Whether the reach is as much as wanted.
    is_enough: T::Mask,
}

/// Separates a bi-cell by the signs of its affine dependency, or as the standard partition has it. Wanted is this
/// share of the half-width, or of what is enough.
#[inline(always)]
fn separate<T: Real, const BY_SIGNS: bool>(points: &BiCellPoints<T>, enough: T, share: T) -> Separated<T> {
    let slabs = Slabs::new(points);
    let outside = if BY_SIGNS { slabs.exception() } else { [slabs.nowhere(); 3] };
    let [o, f, g, c, d] = points;
    let is_standard = !(outside[0] | outside[1] | outside[2]);
    let pick = |mask, yes: &[T; 3], no: &[T; 3]| {
        [T::select(mask, yes[0], no[0]), T::select(mask, yes[1], no[1]), T::select(mask, yes[2], no[2])]
    };
    let choose = |first, second, third, standard| {
        pick(outside[0], first, &pick(outside[1], second, &pick(outside[2], third, standard)))
    };
    let sides = [
        &choose(o, f, g, o),
        &pick(is_standard, f, c),
        &pick(is_standard, g, d),
        &choose(f, g, o, c),
        &choose(g, o, f, d),
    ];
    let (centre, radius, half_width) = annulus(sides, is_standard);
    let planes = slabs.squared_widths(outside, is_standard);
    let reach = half_of_square(planes[0].min(planes[1]).min(planes[2].min(planes[3])));
    let is_enough = !reach.is_less(half_width.min(enough) * share);
    Separated { centre, radius, half_width, outside, planes, reach, is_enough }
}

impl Separated<f64> {
    /// The delimiter, with the reach that spheres leave where planes are not enough.
    #[inline(always)]
    fn delimiter(&self, points: &BiCellPoints<f64>, partition: usize, enough: f64) -> Delimiter<[f64; 3]> {
        let &Separated { centre, radius, half_width, ref planes, .. } = self;
        let reach = if self.is_enough {
            self.reach
        } else {
            reach_by_spheres(points, partition, planes, Real::min(half_width, enough))
        };
        Delimiter { centre, radius, half_width, reach, tolerance: Real::min(half_width, reach) }
    }
}

/// The least of what excludes the partitions other than the given one: a plane or, where that leaves less
/// than wanted, a sphere if it leaves more.
#[cold]
#[inline(never)]
fn reach_by_spheres(points: &BiCellPoints<f64>, partition: usize, planes: &[f64; 4], wanted: f64) -> f64 {
    let mut reach = f64::INFINITY;
    for (k, &plane) in planes.iter().enumerate().filter(|(k, _)| *k != partition) {
        let mut width = half_of_square(plane);
        if width < wanted {
            let [a, b, c, d, e] = SIDES[k];
            let sides = [&points[a], &points[b], &points[c], &points[d], &points[e]];
            width = Real::max(width, annulus(sides, k == STANDARD).2);
        }
        reach = Real::min(reach, width);
    }
    reach
}

/// Half the width of which this is the square, as a lower bound; infinite if that is.
#[inline(always)]
fn half_of_square<T: Real>(square: T) -> T {
    (square.sqrt() * square.splat(0.5 - 8.0 * UNIT) - square.splat(LEAST)).max(square.splat(0.0))
}

/// Centre, radius and half-width of the sphere in the middle between those about the point that is
/// equidistant from the three on one side and from the two on the other. The three are inside in the
/// standard partition, the two in others.
#[inline(always)]
fn annulus<T: Real>([o, f, g, c, d]: [&[T; 3]; 5], is_standard: T::Mask) -> ([T; 3], T, T) {
    let (u, v, w) = (minus(f, o), minus(g, o), minus(c, d));
    // u·x = |u|² / 2, v·x = |v|² / 2 and w·x = w·s / 2, the bisectors, with x from o to the centre.
    let (vw, wu, uv) = (cross(&v, &w), cross(&w, &u), cross(&u, &v));
    let scale = o[0].splat(0.5) / dot(&u, &vw);
    let (uu, vv) = (dot(&u, &u), dot(&v, &v));
    let ws = dot(&w, &plus(&minus(c, o), &minus(d, o)));
    let coordinate = |k: usize| o[k] + (uu * vw[k] + vv * wu[k] + ws * uv[k]) * scale;
    let centre = [coordinate(0), coordinate(1), coordinate(2)];
    let from = |p| square_between(&centre, p);
    let (a, b, e, x, y) = (from(o), from(f), from(g), from(c), from(d));
    let inner = T::select(is_standard, a.max(b).max(e), x.max(y));
    let outer = T::select(is_standard, x.min(y), a.min(b).min(e));
    let (radius, half_width) = middle::<T, 3>(inner, outer);
    (centre, radius, half_width)
}

/// Extent of the points' bounding box along an axis.
#[inline(always)]
fn extent<T: Real>([o, f, g, c, d]: &BiCellPoints<T>, k: usize) -> T {
    let upper = o[k].max(f[k]).max(g[k].max(c[k])).max(d[k]);
    upper - o[k].min(f[k]).min(g[k].min(c[k])).min(d[k])
}

/// The slabs parallel to the line `cd` and to one edge of the facet each.
struct Slabs<T> {
    /// By the vertex opposite the edge. Heights are above the edge, in units of 1 / |normal|.
    normals: [[T; 3]; 3],
    /// Height of the line.
    heights: [T; 3],
    /// Height of the vertex: six times the volume of both cells.
    volume: T,
    /// Error bound of heights.
    bound: T,
    /// Error bound of squared norms of normals.
    blur: T,
}

impl<T: Real> Slabs<T> {
    #[inline(always)]
    fn new(points: &BiCellPoints<T>) -> Self {
        let [o, f, g, c, d] = points;
        let (u, v, w) = (minus(f, o), minus(g, o), minus(c, d));
        let normals = [cross(&minus(g, f), &w), cross(&v, &w), cross(&w, &u)];
        let volume = dot(&u, &normals[1]);
        let [x, y, z] =
            [dot(&minus(f, c), &normals[0]), dot(&minus(c, g), &normals[1]), dot(&minus(c, o), &normals[2])];
        let zero = volume.splat(0.0);
        let is_negative = volume.is_less(zero);
        let above = |height| T::select(is_negative, zero - height, height);
        let extents = [extent(points, 0), extent(points, 1), extent(points, 2)];
        let largest = extents[0].max(extents[1]).max(extents[2]);
        let square = largest * largest;
        Slabs {
            normals,
            heights: [above(x), above(y), above(z)],
            volume: volume.abs(),
            bound: volume.splat(ORIENT_3D) * (extents[0] * extents[1] * extents[2])
                + volume.splat(LEAST_DETERMINANT),
            // (|n| + CROSS square)², where |n| is below 3.47 square.
            blur: square.splat(7.0 * CROSS) * (square * square) + square.splat(LEAST * LEAST),
        }
    }

    /// A mask that is nowhere set.
    #[inline(always)]
    fn nowhere(&self) -> T::Mask {
        self.volume.is_less(self.volume.splat(0.0))
    }

    /// The partition by the signs of the affine dependency: which vertex is outside.
    #[inline(always)]
    fn exception(&self) -> [T::Mask; 3] {
        let zero = self.volume.splat(0.0);
        let is_beyond = |k: usize| self.heights[k].is_less(zero);
        let (x, y, z) = (is_beyond(0), is_beyond(1), is_beyond(2));
        [x, y & !x, z & !(x | y)]
    }

    /// Lower bounds of the squared widths of the slabs that exclude the partitions, as kept in [`Separated::planes`].
    #[inline(always)]
    fn squared_widths(&self, outside: [T::Mask; 3], is_standard: T::Mask) -> [T; 4] {
        let (zero, infinity) = (self.volume.splat(0.0), self.volume.splat(f64::INFINITY));
        // The width of the slab of the given partition, if it has one, is that of the standard partition: a
        // negative height has the line beyond the edge, and the slab separates it from the whole facet.
        let mut standard = infinity;
        let mut widths = [infinity; 4];
        for k in 0..3 {
            let n = &self.normals[k];
            let height = (self.heights[k].abs().min(self.volume) - self.bound).max(zero);
            let width = height / (dot(n, n) + self.blur) * height;
            let separating = T::select(zero.is_less(self.heights[k]), width, zero);
            widths[k] = T::select(outside[k], infinity, separating);
            standard = T::select(outside[k], width, standard);
        }
        widths[3] = T::select(is_standard, infinity, standard);
        widths
    }
}

#[cfg(test)]
mod tests {
    use super::super::dyadic::product;
    use super::*;
    use crate::random::Rng;

    /// The error bounds of slabs are those of the extents of the bi-cell, in exact numbers.
    #[test]
    fn bounds_of_slabs_are_as_documented() {
        let rng = &mut Rng::new(7);
        for _ in 0..2_000 {
            let size = 2f64.powi(rng.within(-300, 150) as i32);
            let points: BiCellPoints<f64> =
                std::array::from_fn(|_| std::array::from_fn(|_| rng.unit() * size));
            let extents: [f64; 3] = std::array::from_fn(|k| {
                let along = points.map(|p| p[k]);
                along.into_iter().fold(0.0, f64::max) - along.into_iter().fold(f64::INFINITY, f64::min)
            });
            let [x, y, z] = extents;
            let l = x.max(y).max(z);
            let slabs = Slabs::new(&points);
            let bound = product([ORIENT_3D, x, y, z]) + product([LEAST_DETERMINANT]);
            let blur = product([7.0, CROSS, l, l, l, l]) + product([LEAST, LEAST]);
            // Where the square of the bound is all underflow, it is none of a determinant.
            assert!(product([slabs.bound]).is_close_to(&bound, 40), "{points:?}");
            assert!(product([slabs.blur]).is_close_to(&blur, 40), "{points:?} {} {}", slabs.blur, l);
        }
    }
    /// Where all points are in one plane but for rounding, no slab parts them.
    #[test]
    fn flat_bicells_have_no_slabs() {
        let rng = &mut Rng::new(8);
        for _ in 0..2_000 {
            let size = 2f64.powi(rng.within(-90, 90) as i32);
            let [a, b] = [rng.unit() - 0.5, rng.unit() - 0.5];
            let points: BiCellPoints<f64> = std::array::from_fn(|_| {
                let [x, y] = [rng.unit(), rng.unit()];
                [x, y, a * x + b * y].map(|coordinate| coordinate * size)
            });
            let slabs = Slabs::new(&points);
            for is_standard in [false, true] {
                let widths = slabs.squared_widths(slabs.exception(), is_standard);
                assert!(
                    widths.iter().all(|&width| width == 0.0 || width == f64::INFINITY),
                    "{points:?} {widths:?}"
                );
            }
        }
    }
}
