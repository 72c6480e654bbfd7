//! What a point brings to the signs that decide: its place, and how high it is lifted.
//!
//! Circles and spheres are tested by differences from a corner, and by the *lifts* of these: their squares, less what the weight of
//! the point is more than that of the corner. The tests are written over [`SeenPoint`], and so once for points with weights and without.

use super::coordinates::Coordinates;
use super::vectors::{dot, minus};
use super::weighted::WeightedPoint;
use crate::simd::{LANES, Real, Simd};

/// A point as it is seen from another one.
#[derive(Clone, Copy, Debug)]
pub struct SeenPoint<T, const D: usize> {
    /// To it from the other one.
    pub difference: [T; D],
    /// The square of that, less what its weight is more than that of the other one.
    pub lift: T,
}

impl<T: Real, const D: usize> SeenPoint<T, D> {
    /// The point `p`, seen from `a`, without weights.
    #[inline(always)]
    pub(super) fn from(p: &[T; D], a: &[T; D]) -> Self {
        let difference = minus(p, a);
        SeenPoint { difference, lift: dot(&difference, &difference) }
    }
}

/// A point with `D` coordinates.
pub trait Located<const D: usize>: Coordinates {
    /// Whether there are weights.
    const HAS_WEIGHT: bool;
    /// One of numbers of another kind, as of several points in lanes.
    type Of<T: Real>: Copy;

    /// Its coordinates.
    fn place(&self) -> &[f64; D];
    /// The coordinates of one of numbers of any kind.
    fn place_of<T: Real>(p: &Self::Of<T>) -> &[T; D];
    /// Itself, as one of numbers.
    fn alone(&self) -> &Self::Of<f64>;
    /// The point `p`, seen from `a`.
    fn seen<T: Real>(p: &Self::Of<T>, a: &Self::Of<T>) -> SeenPoint<T, D>;
    /// The magnitude of the difference of two weights.
    fn weight_apart<T: Real>(p: &Self::Of<T>, a: &Self::Of<T>) -> T;
    /// Several points, in lanes.
    fn load<S: Simd>(simd: S, points: [&Self; LANES]) -> Self::Of<S::Lanes>;
    /// One point in all lanes.
    fn in_all_lanes<S: Simd>(&self, simd: S) -> Self::Of<S::Lanes>;
}

impl<const D: usize> Located<D> for [f64; D]
where
    [f64; D]: Coordinates,
{
    const HAS_WEIGHT: bool = false;
    type Of<T: Real> = [T; D];

    #[inline(always)]
    fn place(&self) -> &[f64; D] {
        self
    }

    #[inline(always)]
    fn place_of<T: Real>(p: &[T; D]) -> &[T; D] {
        p
    }

    #[inline(always)]
    fn alone(&self) -> &[f64; D] {
        self
    }

    #[inline(always)]
    fn seen<T: Real>(p: &[T; D], a: &[T; D]) -> SeenPoint<T, D> {
        SeenPoint::from(p, a)
    }

    #[inline(always)]
    fn weight_apart<T: Real>(p: &[T; D], _: &[T; D]) -> T {
        p[0].splat(0.0)
    }

    #[inline(always)]
    fn load<S: Simd>(simd: S, points: [&[f64; D]; LANES]) -> [S::Lanes; D] {
        simd.points(points)
    }

    #[inline(always)]
    fn in_all_lanes<S: Simd>(&self, simd: S) -> [S::Lanes; D] {
        self.map(
            #[inline(always)]
            |x| simd.splat(x),
        )
    }
}

impl<const D: usize> Located<D> for WeightedPoint<D>
where
    WeightedPoint<D>: Coordinates,
{
    const HAS_WEIGHT: bool = true;
    type Of<T: Real> = WeightedPoint<D, T>;

    #[inline(always)]
    fn place(&self) -> &[f64; D] {
        &self.place
    }

    #[inline(always)]
    fn place_of<T: Real>(p: &WeightedPoint<D, T>) -> &[T; D] {
        &p.place
    }

    #[inline(always)]
    fn alone(&self) -> &WeightedPoint<D> {
        self
    }

    #[inline(always)]
    fn seen<T: Real>(p: &WeightedPoint<D, T>, a: &WeightedPoint<D, T>) -> SeenPoint<T, D> {
        let SeenPoint { difference, lift } = SeenPoint::from(&p.place, &a.place);
        SeenPoint { difference, lift: lift - (p.weight - a.weight) }
    }

    #[inline(always)]
    fn weight_apart<T: Real>(p: &WeightedPoint<D, T>, a: &WeightedPoint<D, T>) -> T {
        (p.weight - a.weight).abs()
    }

    #[inline(always)]
    fn load<S: Simd>(simd: S, [a, b, c, d]: [&WeightedPoint<D>; LANES]) -> WeightedPoint<D, S::Lanes> {
        WeightedPoint {
            place: simd.points([&a.place, &b.place, &c.place, &d.place]),
            weight: simd.load(&[a.weight, b.weight, c.weight, d.weight]),
        }
    }

    #[inline(always)]
    fn in_all_lanes<S: Simd>(&self, simd: S) -> WeightedPoint<D, S::Lanes> {
        let place = self.place.map(
            #[inline(always)]
            |x| simd.splat(x),
        );
        WeightedPoint { place, weight: simd.splat(self.weight) }
    }
}
