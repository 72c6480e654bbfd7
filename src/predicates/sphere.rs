//! The sphere of a cell, prepared once to be tested against many points.
//!
//! The in-sphere determinant is linear in the lift of its last point. With the
//! differences u, v, w from corner `a` of a cell to the others and s to the point, and a
//! vector *n* and a volume *V* of the cell alone,
//!
//! ```text
//! in-sphere = s·n − |s|² V,    space: V = [u v w],    n = |u|² v × w − |v|² u × w + |w|² u × v
//!                              plane: V = u × v,      n = |u|² (v_y, −v_x) − |v|² (u_y, −u_x)
//! ```
//!
//! since u·n = |u|² V, and likewise for v and w, determines n. A test costs 9 or 14 operations instead of 25
//! or 74, and fewer in lanes, where a product and a sum are one. The bound is derived like those of the
//! other determinants, for this operation order. What the static bound leaves uncertain goes to
//! [`incircle`](super::incircle), or in space to [`SpacePoint::is_side_certain`](super::SpacePoint::is_side_certain) and then to [`insphere`](super::insphere).
//!
//! The half-space beyond a hull facet is the sphere of a ghost cell: V = 0 and n is the facet's outer normal,
//! times [`StaticFilter::largest_square`], so that its values have the same degree. Their sign is that of the
//! orientation for whatever positive scale there is; their errors grow with the scale, so all that the bound
//! asks of it is not to exceed the square of the largest extent by more than a rounding error, with or
//! without underflow. (The compiler checks that the bound of spheres is sufficient.) A scale of zero, the
//! square of less than 10⁻¹⁶², makes all values zero, hence uncertain.
//!
//! Underflow of n and V is amplified like that of any other intermediate value and part of the bound.
//! Infinity, the scale in a filter that bounds nothing, may make a value NaN, which like any value does not
//! exceed infinity.

use super::StaticFilter;
use super::filter::{extents, largest, prepared_bound_2d, prepared_bound_3d};
use super::lengths::{
    HALF_SPACE_SCALE, LEAST_LENGTH, area_bound_by_length, prepared_bound_by_length_2d,
    prepared_bound_by_length_3d, volume_bound_by_length,
};
use super::located::SeenPoint;
use super::vectors::{cross, dot, minor, minus};
use super::weighted::WeightedPoint;
use crate::simd::Real;

/// Vector and area of a cell of the plane: `[n_x, n_y, V]`.
pub type Circle<T = f64> = [T; 3];
/// Vector and volume of a cell of space: `[n_x, n_y, n_z, V]`.
pub type Sphere<T = f64> = [T; 4];

/// The circle of the triangle `abc`.
#[inline(always)]
pub fn circle<T: Real>(a: &[T; 2], b: &[T; 2], c: &[T; 2]) -> Circle<T> {
    circle_seen(&SeenPoint::from(b, a), &SeenPoint::from(c, a))
}

/// The circle, or the power circle, of a triangle, of which two corners are seen from the first one.
#[inline(always)]
pub fn circle_seen<T: Real>(b: &SeenPoint<T, 2>, c: &SeenPoint<T, 2>) -> Circle<T> {
    let SeenPoint { difference: u, lift: uu } = *b;
    let SeenPoint { difference: v, lift: vv } = *c;
    [uu * v[1] - vv * u[1], vv * u[0] - uu * v[0], minor(&u, &v)]
}

/// Positive if a point, which is seen from the first corner of a circle, is inside, negative if outside; open if the
/// magnitude is not above [`StaticFilter::prepared`]. (Two numbers, not one answer of three: a branch on it
/// would be mispredicted.)
#[inline(always)]
pub fn side_of_circle_seen<T: Real>(&[x, y, volume]: &Circle<T>, q: &SeenPoint<T, 2>) -> T {
    dot(&q.difference, &[x, y]) - q.lift * volume
}

/// The sphere of the tetrahedron `abcd`.
#[inline(always)]
pub fn sphere<T: Real>(a: &[T; 3], b: &[T; 3], c: &[T; 3], d: &[T; 3]) -> Sphere<T> {
    sphere_seen(&SeenPoint::from(b, a), &SeenPoint::from(c, a), &SeenPoint::from(d, a))
}

/// The sphere, or the power sphere, of a tetrahedron, of which three corners are seen from the first one.
#[inline(always)]
pub fn sphere_seen<T: Real>(b: &SeenPoint<T, 3>, c: &SeenPoint<T, 3>, d: &SeenPoint<T, 3>) -> Sphere<T> {
    let SeenPoint { difference: u, lift: uu } = *b;
    let SeenPoint { difference: v, lift: vv } = *c;
    let SeenPoint { difference: w, lift: ww } = *d;
    let (vw, uw, uv) = (cross(&v, &w), cross(&u, &w), cross(&u, &v));
    let n = |axis: usize| uu * vw[axis] - vv * uw[axis] + ww * uv[axis];
    [n(0), n(1), n(2), dot(&u, &vw)]
}

/// What lies beyond the plane of `a`, `b`, `c`, on the side from which they turn counter-clockwise.
#[inline(always)]
pub fn half_space(f: &StaticFilter, a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]) -> Sphere {
    let [x, y, z] = cross(&minus(b, a), &minus(c, a)).map(|t| t * f.largest_square);
    [x, y, z, 0.0]
}

/// The half-space of [`half_space`] at another scale, for [`side_bound_by_length`], and the length for that.
#[inline(always)]
pub fn half_space_by_length(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]) -> (Sphere, f32) {
    let squared = Real::max(squared_length(a, b), squared_length(a, c));
    let scale = HALF_SPACE_SCALE * squared;
    let [x, y, z] = cross(&minus(b, a), &minus(c, a)).map(|t| t * scale);
    ([x, y, z, 0.0], length_above(squared) as f32)
}

/// Positive if a point, which is seen from the first corner of a sphere, is inside, negative if outside; open as of circles.
#[inline(always)]
pub fn side_of_sphere_seen<T: Real>(&[x, y, z, volume]: &Sphere<T>, q: &SeenPoint<T, 3>) -> T {
    dot(&q.difference, &[x, y, z]) - q.lift * volume
}

/// What the magnitude of [`side_of_sphere_seen`] exceeds if it is certain, where edges from the first corner, `a`, of the
/// sphere's cell have at most this length, see [`edge_length`]; also for half-spaces by [`half_space_by_length`].
#[inline(always)]
pub fn side_bound_by_length(length: f32, a: &[f64; 3], q: &[f64; 3]) -> f64 {
    let s = minus(q, a);
    let length = f64::from(length);
    let squared = length * length;
    prepared_bound_by_length_3d(squared, squared * length, dot(&s, &s))
}

/// The greatest distance of `b`, `c` and `d` from `a`, from above, also after rounding to `f32`; infinite where it is
/// too small or too large for [`side_bound_by_length`], which is infinite, too, then.
#[inline(always)]
pub fn edge_length<T: Real>(a: &[T; 3], b: &[T; 3], c: &[T; 3], d: &[T; 3]) -> T {
    let [uu, vv, ww] = [b, c, d].map(
        #[inline(always)]
        |p| squared_length(a, p),
    );
    length_above(Real::max(Real::max(uu, vv), ww))
}

#[inline(always)]
fn squared_length<T: Real, const D: usize>(a: &[T; D], b: &[T; D]) -> T {
    let u = minus(b, a);
    dot(&u, &u)
}

#[inline(always)]
fn length_above<T: Real>(squared: T) -> T {
    let length = squared.sqrt() * squared.splat(1.0 + f64::from(f32::EPSILON));
    T::select(length.is_less(squared.splat(LEAST_LENGTH)), squared.splat(f64::INFINITY), length)
}

/// The bounds of a cell of the plane and of points next to it, by the lengths of its edges from the first corner.
#[derive(Clone, Copy)]
pub struct OwnBounds2d<T> {
    /// The square of the longest edge's length, or of [`LEAST_LENGTH`] if all are shorter.
    squared: T,
}

impl<T: Real> OwnBounds2d<T> {
    /// The bounds of a triangle.
    #[inline(always)]
    pub fn new(a: &[T; 2], b: &[T; 2], c: &[T; 2]) -> Self {
        let longest = squared_length(a, b).max(squared_length(a, c));
        OwnBounds2d { squared: longest.max(longest.splat(LEAST_LENGTH * LEAST_LENGTH)) }
    }

    /// What the area exceeds if it is certainly positive.
    #[inline(always)]
    pub fn area(&self) -> T {
        area_bound_by_length(self.squared)
    }

    /// What the magnitude of [`side_of_circle_seen`] exceeds if it is certain.
    #[inline(always)]
    pub fn side(&self, a: &[T; 2], q: &[T; 2]) -> T {
        prepared_bound_by_length_2d(self.squared, squared_length(a, q))
    }
}

/// The bounds of a cell of space and of points next to it, by the lengths of its edges from the first corner.
#[derive(Clone, Copy)]
pub struct OwnBounds3d<T> {
    /// The square of the longest edge's length, or of [`LEAST_LENGTH`] if all are shorter.
    squared: T,
    /// The third power of that length.
    cubed: T,
}

impl<T: Real> OwnBounds3d<T> {
    /// The bounds of a tetrahedron.
    #[inline(always)]
    pub fn new(a: &[T; 3], b: &[T; 3], c: &[T; 3], d: &[T; 3]) -> Self {
        let longest = squared_length(a, b).max(squared_length(a, c)).max(squared_length(a, d));
        let squared = longest.max(longest.splat(LEAST_LENGTH * LEAST_LENGTH));
        OwnBounds3d { squared, cubed: squared * squared.sqrt() }
    }

    /// What the volume exceeds if it is certainly positive.
    #[inline(always)]
    pub fn volume(&self) -> T {
        volume_bound_by_length(self.cubed)
    }

    /// What the magnitude of [`side_of_sphere_seen`] exceeds if it is certain.
    #[inline(always)]
    pub fn side(&self, a: &[T; 3], q: &[T; 3]) -> T {
        prepared_bound_by_length_3d(self.squared, self.cubed, squared_length(a, q))
    }
}

/// Whether all points of a box are certainly outside the sphere of the positively oriented tetrahedron
/// `abcd`.
///
/// [`side_of_sphere_seen`], with the computed *n* and *V* > 0, is a concave function of each difference s, so that
/// its maximum over the box is at the s next to *n* / 2*V* along each axis; rounding being monotone, the
/// differences of points in the box are between those of its corners. The bound, for the extents of the
/// tetrahedron and the greatest difference, holds for all these points up to the last rounding, which the
/// sign survives: once for the errors of *n* and *V*, once for the rounding of the maximum. A quotient that
/// is u |s| off costs another u² |s|² *V*, which is far less. So twice the bound would be enough, and four
/// times is.
#[inline(always)]
pub fn is_box_outside_sphere([a, b, c, d]: [&[f64; 3]; 4], [lower, upper]: [&[f64; 3]; 2]) -> bool {
    let [x, y, z, volume] = sphere(a, b, c, d);
    let (s, reach) = nearest(a, [x, y, z], volume, [lower, upper]);
    let side = dot(&s, &[x, y, z]) - dot(&s, &s) * volume;
    volume > 0.0 && side < -4.0 * prepared_bound_3d(largest(extents([a, b, c, d])), reach)
}

/// Whether all points of a box are certainly outside the circle of the counter-clockwise triangle `abc`; derived as in
/// [`is_box_outside_sphere`].
#[inline(always)]
pub fn is_box_outside_circle([a, b, c]: [&[f64; 2]; 3], [lower, upper]: [&[f64; 2]; 2]) -> bool {
    let [x, y, volume] = circle(a, b, c);
    let (s, reach) = nearest(a, [x, y], volume, [lower, upper]);
    let side = dot(&s, &[x, y]) - dot(&s, &s) * volume;
    volume > 0.0 && side < -4.0 * prepared_bound_2d(largest(extents([a, b, c])), reach)
}

/// The difference from `a` to the point of a box that is next to `a` + `n` / 2`volume`, and the greatest
/// difference of a coordinate from `a` to points in the box.
#[inline(always)]
fn nearest<const D: usize>(
    a: &[f64; D],
    n: [f64; D],
    volume: f64,
    [lower, upper]: [&[f64; D]; 2],
) -> ([f64; D], f64) {
    let mut reach = 0.0f64;
    let s = std::array::from_fn(|k| {
        let (least, greatest) = (lower[k] - a[k], upper[k] - a[k]);
        reach = reach.max(-least).max(greatest);
        next_to(n[k] / (2.0 * volume), least, greatest)
    });
    (s, reach)
}

/// The point of a box of places and weights that is the least outside of a power circle or sphere, as it is seen from the first
/// corner; and what the differences of points in the box are at most, along axes and of weights: what [`nearest`] is without
/// weights. The side of a place grows with its weight, so the greatest one counts.
#[inline(always)]
pub(super) fn least_outside<const D: usize>(
    a: &WeightedPoint<D>,
    n: [f64; D],
    volume: f64,
    [lower, upper]: [&WeightedPoint<D>; 2],
) -> (SeenPoint<f64, D>, [f64; D], f64) {
    let (mut extents, apart) = ([0.0; D], [lower, upper].map(|p| p.weight - a.weight));
    let difference: [f64; D] = std::array::from_fn(|k| {
        let (least, greatest) = (lower.place[k] - a.place[k], upper.place[k] - a.place[k]);
        extents[k] = (-least).max(greatest);
        next_to(n[k] / (2.0 * volume), least, greatest)
    });
    let seen = SeenPoint { difference, lift: dot(&difference, &difference) - apart[1] };
    (seen, extents, apart[0].abs().max(apart[1].abs()))
}

/// The number between `lower` and `upper` that is next to `x`.
#[inline(always)]
fn next_to(x: f64, lower: f64, upper: f64) -> f64 {
    if x < lower {
        lower
    } else if x > upper {
        upper
    } else {
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicates::{PlanePoint, SpacePoint, incircle, insphere, orient2d, orient3d};
    use crate::random::Rng;

    fn certain(f: &StaticFilter, value: f64) -> Option<bool> {
        (value.abs() > f.prepared).then_some(value > 0.0)
    }

    /// A certain answer is that of the exact predicate, on random points and on points a few ulps from a
    /// sphere.
    #[test]
    fn certain_answers_are_exact() {
        let rng = &mut Rng::new(5);
        let (mut n_certain, mut n_open) = (0, 0);
        for round in 0..200_000 {
            // Every other round has integer points around a sphere of radius 5, shaken by a last bit or not
            // at all.
            let shaken = |rng: &mut Rng, x: f64| x + [0.0, 0.0, 1e-15, -1e-15][(rng.unit() * 4.0) as usize];
            let on_sphere = [
                [3., 4., 0.],
                [5., 0., 0.],
                [0., 3., -4.],
                [-4., 0., 3.],
                [0., -5., 0.],
                [-3., 0., -4.],
                [0., 0., 5.],
            ];
            let p: [[f64; 3]; 5] = std::array::from_fn(|_| {
                if round % 2 == 0 {
                    std::array::from_fn(|_| rng.unit() * 10.0 - 5.0)
                } else {
                    on_sphere[(rng.unit() * 7.0) as usize].map(|x| shaken(rng, x))
                }
            });
            let f = StaticFilter::space([-6.0; 3], [6.0; 3]);
            let [a, b, c, d, q] = &p;
            match certain(&f, <[f64; 3]>::side(&sphere(a, b, c, d), a, q)) {
                Some(inside) => {
                    n_certain += 1;
                    assert_eq!(inside, insphere(&f, a, b, c, d, q) > 0.0);
                    assert_ne!(insphere(&f, a, b, c, d, q), 0.0);
                }
                None => n_open += 1,
            }
            if let Some(beyond) = certain(&f, <[f64; 3]>::side(&half_space(&f, a, b, c), a, q)) {
                assert_eq!(beyond, orient3d(&f, a, b, c, q) > 0.0);
                assert_ne!(orient3d(&f, a, b, c, q), 0.0);
            }
        }
        assert!(n_certain > 90_000 && n_open > 10_000, "{n_certain} certain, {n_open} open");
    }

    /// A box that is said to be outside has no point inside, and most that are outside are said to be.
    #[test]
    fn boxes_outside_are_outside() {
        let rng = &mut Rng::new(9);
        let f = StaticFilter::space([-6.0; 3], [6.0; 3]);
        let g = StaticFilter::plane([-6.0; 2], [6.0; 2]);
        let (mut n_outside, mut n_seen) = (0, 0);
        for _ in 0..20_000 {
            let p: [[f64; 3]; 7] =
                std::array::from_fn(|_| std::array::from_fn(|_| (rng.unit() * 12.0).round() - 6.0));
            let [a, b, c, d, l, u, _] = &p;
            let lower: [f64; 3] = std::array::from_fn(|k| l[k].min(u[k]));
            let upper: [f64; 3] = std::array::from_fn(|k| l[k].max(u[k]));
            let points = || {
                let axis = |k: usize| (lower[k] as i32..=upper[k] as i32).map(f64::from);
                axis(0).flat_map(move |x| axis(1).flat_map(move |y| axis(2).map(move |z| [x, y, z])))
            };
            if orient3d(&f, a, b, c, d) > 0.0 {
                let outside = is_box_outside_sphere([a, b, c, d], [&lower, &upper]);
                let is_seen = points().any(|q| insphere(&f, a, b, c, d, &q) >= 0.0);
                assert!(!(outside && is_seen), "{p:?}");
                (n_outside, n_seen) = (n_outside + outside as usize, n_seen + is_seen as usize);
            }
            let [a, b, c, lower, upper] = [a, b, c, &lower, &upper].map(|p| [p[0], p[1]]);
            if orient2d(&g, &a, &b, &c) > 0.0 {
                let outside = is_box_outside_circle([&a, &b, &c], [&lower, &upper]);
                let is_seen = points().any(|q| incircle(&g, &a, &b, &c, &[q[0], q[1]]) >= 0.0);
                assert!(!(outside && is_seen), "{p:?}");
                (n_outside, n_seen) = (n_outside + outside as usize, n_seen + is_seen as usize);
            }
        }
        assert!(n_outside > 2_000 && n_seen > 2_000, "{n_outside} outside, {n_seen} not");
    }

    /// A box of places and weights that is said to be outside of a power circle or sphere has no point inside.
    #[test]
    fn boxes_outside_of_power_spheres_are_outside() {
        let rng = &mut Rng::new(11);
        let corner = |x: f64| WeightedPoint { place: [x; 3], weight: 4.0 * x };
        let f = WeightedPoint::<3>::filter(&corner(-6.0), &corner(6.0));
        let flat = |p: &WeightedPoint<3>| WeightedPoint { place: [p.place[0], p.place[1]], weight: p.weight };
        let g = WeightedPoint::<2>::filter(&flat(&corner(-6.0)), &flat(&corner(6.0)));
        let (mut n_outside, mut n_seen) = (0, 0);
        for _ in 0..20_000 {
            let mut number = || (rng.unit() * 12.0).round() - 6.0;
            let p: [WeightedPoint<3>; 6] = std::array::from_fn(|_| WeightedPoint {
                place: std::array::from_fn(|_| number()),
                weight: 4.0 * number(),
            });
            let [a, b, c, d, l, u] = &p;
            let lower = WeightedPoint {
                place: std::array::from_fn(|k| l.place[k].min(u.place[k])),
                weight: l.weight.min(u.weight),
            };
            let upper = WeightedPoint {
                place: std::array::from_fn(|k| l.place[k].max(u.place[k])),
                weight: l.weight.max(u.weight),
            };
            let points = || {
                let axis = |k: usize| (lower.place[k] as i32..=upper.place[k] as i32).map(f64::from);
                let places =
                    axis(0).flat_map(move |x| axis(1).flat_map(move |y| axis(2).map(move |z| [x, y, z])));
                places.flat_map(|place| {
                    [lower.weight, upper.weight].map(|weight| WeightedPoint { place, weight })
                })
            };
            if orient3d(&StaticFilter::space([-6.0; 3], [6.0; 3]), &a.place, &b.place, &c.place, &d.place)
                > 0.0
            {
                let outside = WeightedPoint::<3>::is_box_outside([a, b, c, d], [&lower, &upper]);
                let is_seen = points()
                    .any(|q| WeightedPoint::<3>::is_in_sphere(&f, [a, b, c, d, &q], || [0, 1, 2, 3, 4]));
                assert!(!(outside && is_seen), "{p:?}");
                (n_outside, n_seen) = (n_outside + outside as usize, n_seen + is_seen as usize);
            }
            let [a, b, c, low, high] = [a, b, c, &lower, &upper].map(flat);
            if orient2d(&StaticFilter::plane([-6.0; 2], [6.0; 2]), &a.place, &b.place, &c.place) > 0.0 {
                let outside = WeightedPoint::<2>::is_box_outside([&a, &b, &c], [&low, &high]);
                let is_seen = points()
                    .any(|q| WeightedPoint::<2>::is_in_circle(&g, [&a, &b, &c, &flat(&q)], || [0, 1, 2, 3]));
                assert!(!(outside && is_seen), "{p:?}");
                (n_outside, n_seen) = (n_outside + outside as usize, n_seen + is_seen as usize);
            }
        }
        assert!(n_outside > 2_000 && n_seen > 2_000, "{n_outside} outside, {n_seen} not");
    }
}
