//! What points of the plane, and of space, bring to predicates, with weights and without.

use super::filter::{
    StaticFilter, power_bounds_2d, power_bounds_3d, semi_static_bounds_2d, semi_static_bounds_3d,
};
use super::located::{Located, SeenPoint};
use super::perturbation::{
    in_power_circle_perturbed, in_power_sphere_perturbed, incircle_perturbed, insphere_perturbed,
};
use super::sphere::{
    OwnBounds2d, OwnBounds3d, circle_seen, is_box_outside_circle, is_box_outside_sphere, least_outside,
    side_of_circle_seen, side_of_sphere_seen, sphere_seen,
};
use super::vectors::{greatest_along_axes, greatest_of};
use super::weighted::WeightedPoint;
use super::{Circle, Sphere, exact_filter};
use crate::simd::Real;

/// The bounds of a cell's own determinants, and of those with points next to it.
pub trait OwnBounds<P, T> {
    /// What the volume exceeds if it is certainly positive.
    fn volume(&self) -> T;
    /// What the magnitude of the side of `q` exceeds if it is certain, given the first corner.
    fn side(&self, a: &P, q: &P) -> T;
}

/// A point of the plane.
pub trait PlanePoint: Located<2> {
    /// The [`OwnBounds`] of a triangle.
    type OwnBounds<T: Real>: OwnBounds<Self::Of<T>, T>;

    /// Error bounds for points between two corners.
    fn filter(lower: &Self, upper: &Self) -> StaticFilter;
    /// Bounds for points in a box, if all are on one lattice and few steps of it apart; see [`exact_filter`].
    fn exact_filter<'p>(
        lower: &'p Self,
        upper: &'p Self,
        points: impl Iterator<Item = &'p Self>,
    ) -> Option<StaticFilter>;
    /// Whether the last point is inside the circle of the first three, which are in counter-clockwise order; `ranks` break ties.
    fn is_in_circle(f: &StaticFilter, points: [&Self; 4], ranks: impl FnOnce() -> [u32; 4]) -> bool;
    /// Whether all points of a box are certainly outside the circle of a counter-clockwise triangle.
    fn is_box_outside(triangle: [&Self; 3], sides: [&Self; 2]) -> bool;
    /// The bounds of a triangle.
    fn own_bounds<T: Real>(a: &Self::Of<T>, b: &Self::Of<T>, c: &Self::Of<T>) -> Self::OwnBounds<T>;
    /// Bounds of the area and of a prepared circle, for differences of at most these magnitudes and weights that far apart.
    fn semi_static<T: Real>(extents: [T; 2], weight: T) -> [T; 2];

    /// The prepared circle of a triangle.
    #[inline(always)]
    fn circle<T: Real>(a: &Self::Of<T>, b: &Self::Of<T>, c: &Self::Of<T>) -> Circle<T> {
        circle_seen(&Self::seen(b, a), &Self::seen(c, a))
    }

    /// The side of `q` of a prepared circle, of which `a` is the first corner.
    #[inline(always)]
    fn side<T: Real>(circle: &Circle<T>, a: &Self::Of<T>, q: &Self::Of<T>) -> T {
        side_of_circle_seen(circle, &Self::seen(q, a))
    }
}

/// A point of space.
pub trait SpacePoint: Located<3> {
    /// The [`OwnBounds`] of a tetrahedron.
    type OwnBounds<T: Real>: OwnBounds<Self::Of<T>, T>;

    /// Error bounds for points between two corners.
    fn filter(lower: &Self, upper: &Self) -> StaticFilter;
    /// Bounds for points in a box, if all are on one lattice and few steps of it apart; see [`exact_filter`].
    fn exact_filter<'p>(
        lower: &'p Self,
        upper: &'p Self,
        points: impl Iterator<Item = &'p Self>,
    ) -> Option<StaticFilter>;
    /// Whether the last point is inside the sphere of the first four, which are positively oriented; `ranks` break ties.
    fn is_in_sphere(f: &StaticFilter, points: [&Self; 5], ranks: impl FnOnce() -> [u32; 5]) -> bool;
    /// Whether all points of a box are certainly outside the sphere of a positive tetrahedron.
    fn is_box_outside(tetrahedron: [&Self; 4], sides: [&Self; 2]) -> bool;
    /// The bounds of a tetrahedron.
    fn own_bounds<T: Real>(
        a: &Self::Of<T>,
        b: &Self::Of<T>,
        c: &Self::Of<T>,
        d: &Self::Of<T>,
    ) -> Self::OwnBounds<T>;
    /// Bounds of the volume and of a prepared sphere, for differences of at most these magnitudes and weights that far apart.
    fn semi_static<T: Real>(extents: [T; 3], weight: T) -> [T; 2];

    /// The prepared sphere of a tetrahedron.
    #[inline(always)]
    fn sphere<T: Real>(a: &Self::Of<T>, b: &Self::Of<T>, c: &Self::Of<T>, d: &Self::Of<T>) -> Sphere<T> {
        sphere_seen(&Self::seen(b, a), &Self::seen(c, a), &Self::seen(d, a))
    }

    /// The side of `q` of a prepared sphere, of which `a` is the first corner.
    #[inline(always)]
    fn side<T: Real>(sphere: &Sphere<T>, a: &Self::Of<T>, q: &Self::Of<T>) -> T {
        side_of_sphere_seen(sphere, &Self::seen(q, a))
    }

    /// Whether the side of `q`, as computed from the sphere of `abcd`, is certain where it does not exceed
    /// [`StaticFilter::prepared`]: by the same bound for the greatest differences of these points from `a`, which are all
    /// that it has been computed from.
    #[inline(always)]
    fn is_side_certain(side: f64, [a, b, c, d, q]: [&Self; 5]) -> bool {
        let others = [b, c, d, q];
        let seen = others.map(|p| Self::seen(p.alone(), a.alone()).difference);
        let weights = others.map(|p| Self::weight_apart(p.alone(), a.alone()));
        let [_, bound] = Self::semi_static(greatest_along_axes(seen.each_ref()), greatest_of(&weights));
        side.abs() > bound
    }
}

impl PlanePoint for [f64; 2] {
    type OwnBounds<T: Real> = OwnBounds2d<T>;

    fn filter(lower: &Self, upper: &Self) -> StaticFilter {
        StaticFilter::plane(*lower, *upper)
    }

    fn exact_filter<'p>(
        lower: &'p Self,
        upper: &'p Self,
        points: impl Iterator<Item = &'p Self>,
    ) -> Option<StaticFilter> {
        exact_filter(StaticFilter::plane, lower, upper, points)
    }

    #[inline(always)]
    fn is_in_circle(f: &StaticFilter, points: [&Self; 4], ranks: impl FnOnce() -> [u32; 4]) -> bool {
        incircle_perturbed(f, points, ranks)
    }

    #[inline(always)]
    fn is_box_outside(triangle: [&Self; 3], sides: [&Self; 2]) -> bool {
        is_box_outside_circle(triangle, sides)
    }

    #[inline(always)]
    fn own_bounds<T: Real>(a: &[T; 2], b: &[T; 2], c: &[T; 2]) -> OwnBounds2d<T> {
        OwnBounds2d::new(a, b, c)
    }

    #[inline(always)]
    fn semi_static<T: Real>(extents: [T; 2], _: T) -> [T; 2] {
        semi_static_bounds_2d(extents)
    }
}

impl SpacePoint for [f64; 3] {
    type OwnBounds<T: Real> = OwnBounds3d<T>;

    fn filter(lower: &Self, upper: &Self) -> StaticFilter {
        StaticFilter::space(*lower, *upper)
    }

    fn exact_filter<'p>(
        lower: &'p Self,
        upper: &'p Self,
        points: impl Iterator<Item = &'p Self>,
    ) -> Option<StaticFilter> {
        exact_filter(StaticFilter::space, lower, upper, points)
    }

    #[inline(always)]
    fn is_in_sphere(f: &StaticFilter, points: [&Self; 5], ranks: impl FnOnce() -> [u32; 5]) -> bool {
        insphere_perturbed(f, points, ranks)
    }

    #[inline(always)]
    fn is_box_outside(tetrahedron: [&Self; 4], sides: [&Self; 2]) -> bool {
        is_box_outside_sphere(tetrahedron, sides)
    }

    #[inline(always)]
    fn own_bounds<T: Real>(a: &[T; 3], b: &[T; 3], c: &[T; 3], d: &[T; 3]) -> OwnBounds3d<T> {
        OwnBounds3d::new(a, b, c, d)
    }

    #[inline(always)]
    fn semi_static<T: Real>(extents: [T; 3], _: T) -> [T; 2] {
        semi_static_bounds_3d(extents)
    }
}

/// The extents of a cell with weights, as it is seen from its first corner, and of its weights.
#[derive(Clone, Copy)]
pub struct Extents<T, const D: usize> {
    of_place: [T; D],
    of_weight: T,
}

impl<T: Real, const D: usize> Extents<T, D> {
    #[inline(always)]
    fn of<const N: usize>(others: [&SeenPoint<T, D>; N], weights: [T; N]) -> Self {
        let of_place = greatest_along_axes(others.map(|seen| &seen.difference));
        Extents { of_place, of_weight: greatest_of(&weights) }
    }

    /// With one more point, which is seen from the first corner.
    #[inline(always)]
    fn with(&self, other: &SeenPoint<T, D>, weight: T) -> Self {
        let mut more = *self;
        for axis in 0..D {
            more.of_place[axis] = other.difference[axis].abs().max(self.of_place[axis]);
        }
        more.of_weight = weight.max(self.of_weight);
        more
    }
}

impl<T: Real> OwnBounds<WeightedPoint<2, T>, T> for Extents<T, 2> {
    #[inline(always)]
    fn volume(&self) -> T {
        power_bounds_2d(self.of_place, self.of_weight)[0]
    }

    #[inline(always)]
    fn side(&self, a: &WeightedPoint<2, T>, q: &WeightedPoint<2, T>) -> T {
        type P = WeightedPoint<2>;
        let all = self.with(&<P as Located<2>>::seen(q, a), <P as Located<2>>::weight_apart(q, a));
        power_bounds_2d(all.of_place, all.of_weight)[1]
    }
}

impl<T: Real> OwnBounds<WeightedPoint<3, T>, T> for Extents<T, 3> {
    #[inline(always)]
    fn volume(&self) -> T {
        power_bounds_3d(self.of_place, self.of_weight)[0]
    }

    #[inline(always)]
    fn side(&self, a: &WeightedPoint<3, T>, q: &WeightedPoint<3, T>) -> T {
        type P = WeightedPoint<3>;
        let all = self.with(&<P as Located<3>>::seen(q, a), <P as Located<3>>::weight_apart(q, a));
        power_bounds_3d(all.of_place, all.of_weight)[1]
    }
}

impl<T: Real> OwnBounds<[T; 2], T> for OwnBounds2d<T> {
    #[inline(always)]
    fn volume(&self) -> T {
        self.area()
    }

    #[inline(always)]
    fn side(&self, a: &[T; 2], q: &[T; 2]) -> T {
        OwnBounds2d::side(self, a, q)
    }
}

impl<T: Real> OwnBounds<[T; 3], T> for OwnBounds3d<T> {
    #[inline(always)]
    fn volume(&self) -> T {
        OwnBounds3d::volume(self)
    }

    #[inline(always)]
    fn side(&self, a: &[T; 3], q: &[T; 3]) -> T {
        OwnBounds3d::side(self, a, q)
    }
}

/// The greatest side of points of a box in respect of the power circle of a triangle, positive inside, and a bound beyond which the
/// sign of it is certain. The bound is infinite where nothing is. Derived as without weights ([`is_box_outside_circle`]): what a
/// side is off by holds for all points of the box up to the last rounding, and so for the greatest, in either direction.
#[inline(always)]
pub(super) fn side_of_box_2d(triangle: [&WeightedPoint<2>; 3], sides: [&WeightedPoint<2>; 2]) -> (f64, f64) {
    let [a, b, c] = triangle.map(Located::alone);
    let circle = <WeightedPoint<2> as PlanePoint>::circle(a, b, c);
    let [x, y, volume] = circle;
    let (q, mut extents, mut weight) = least_outside(triangle[0], [x, y], volume, sides);
    for p in [b, c] {
        let seen = WeightedPoint::<2>::seen(p, a).difference;
        (0..2).for_each(|k| extents[k] = extents[k].max(seen[k].abs()));
        weight = weight.max(WeightedPoint::<2>::weight_apart(p, a));
    }
    let [_, bound] = power_bounds_2d(extents, weight);
    (side_of_circle_seen(&circle, &q), if volume > 0.0 { 4.0 * bound } else { f64::INFINITY })
}

/// [`side_of_box_2d`], of a power sphere.
#[inline(always)]
pub(super) fn side_of_box_3d(
    tetrahedron: [&WeightedPoint<3>; 4],
    sides: [&WeightedPoint<3>; 2],
) -> (f64, f64) {
    let [a, b, c, d] = tetrahedron.map(Located::alone);
    let sphere = <WeightedPoint<3> as SpacePoint>::sphere(a, b, c, d);
    let [x, y, z, volume] = sphere;
    let (q, mut extents, mut weight) = least_outside(tetrahedron[0], [x, y, z], volume, sides);
    for p in [b, c, d] {
        let seen = WeightedPoint::<3>::seen(p, a).difference;
        (0..3).for_each(|k| extents[k] = extents[k].max(seen[k].abs()));
        weight = weight.max(WeightedPoint::<3>::weight_apart(p, a));
    }
    let [_, bound] = power_bounds_3d(extents, weight);
    (side_of_sphere_seen(&sphere, &q), if volume > 0.0 { 4.0 * bound } else { f64::INFINITY })
}

impl PlanePoint for WeightedPoint<2> {
    type OwnBounds<T: Real> = Extents<T, 2>;

    fn filter(lower: &Self, upper: &Self) -> StaticFilter {
        StaticFilter::power_plane(lower.place, upper.place, [lower.weight, upper.weight])
    }

    /// None: the lattice would have to be one of weights as well.
    fn exact_filter<'p>(_: &'p Self, _: &'p Self, _: impl Iterator<Item = &'p Self>) -> Option<StaticFilter> {
        None
    }

    #[inline(always)]
    fn is_in_circle(f: &StaticFilter, points: [&Self; 4], ranks: impl FnOnce() -> [u32; 4]) -> bool {
        in_power_circle_perturbed(f, points, ranks)
    }

    #[inline(always)]
    fn is_box_outside(triangle: [&Self; 3], sides: [&Self; 2]) -> bool {
        let (side, bound) = side_of_box_2d(triangle, sides);
        side < -bound
    }

    #[inline(always)]
    fn own_bounds<T: Real>(
        a: &WeightedPoint<2, T>,
        b: &WeightedPoint<2, T>,
        c: &WeightedPoint<2, T>,
    ) -> Extents<T, 2> {
        let weights = [b, c].map(|p| Self::weight_apart(p, a));
        Extents::of([&Self::seen(b, a), &Self::seen(c, a)], weights)
    }

    #[inline(always)]
    fn semi_static<T: Real>(extents: [T; 2], weight: T) -> [T; 2] {
        power_bounds_2d(extents, weight)
    }
}

impl SpacePoint for WeightedPoint<3> {
    type OwnBounds<T: Real> = Extents<T, 3>;

    fn filter(lower: &Self, upper: &Self) -> StaticFilter {
        StaticFilter::power_space(lower.place, upper.place, [lower.weight, upper.weight])
    }

    /// None: the lattice would have to be one of weights as well.
    fn exact_filter<'p>(_: &'p Self, _: &'p Self, _: impl Iterator<Item = &'p Self>) -> Option<StaticFilter> {
        None
    }

    #[inline(always)]
    fn is_in_sphere(f: &StaticFilter, points: [&Self; 5], ranks: impl FnOnce() -> [u32; 5]) -> bool {
        in_power_sphere_perturbed(f, points, ranks)
    }

    #[inline(always)]
    fn is_box_outside(tetrahedron: [&Self; 4], sides: [&Self; 2]) -> bool {
        let (side, bound) = side_of_box_3d(tetrahedron, sides);
        side < -bound
    }

    #[inline(always)]
    fn own_bounds<T: Real>(
        a: &WeightedPoint<3, T>,
        b: &WeightedPoint<3, T>,
        c: &WeightedPoint<3, T>,
        d: &WeightedPoint<3, T>,
    ) -> Extents<T, 3> {
        let weights = [b, c, d].map(|p| Self::weight_apart(p, a));
        Extents::of([&Self::seen(b, a), &Self::seen(c, a), &Self::seen(d, a)], weights)
    }

    #[inline(always)]
    fn semi_static<T: Real>(extents: [T; 3], weight: T) -> [T; 2] {
        power_bounds_3d(extents, weight)
    }
}
