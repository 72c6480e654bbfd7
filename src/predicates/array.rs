//! What is the same for points of any dimension.

use super::corners::{PlaceInSpace, VertexInSpace};
use super::distance::compare_distance;
use super::integer::two_difference;
use super::vectors::square_between;
use crate::simd::{LANES, Simd};
use std::cmp::Ordering;

/// A place in space, of the plane at height 0.
#[inline(always)]
pub(super) fn place_in_space<const D: usize>(p: &[f64; D]) -> PlaceInSpace {
    [p[0], p[1], if D == 3 { p[D - 1] } else { 0.0 }]
}

/// Points as arrays, whatever their length: written once, but only where that is known.
pub trait PointArray: Sized {
    /// The coordinates of a point, without a weight.
    type Place: Copy + AsRef<[f64]> + PointArray + 'static;
    /// A point in space.
    type VertexInSpace: VertexInSpace;

    /// The point at a place; of this weight if points have weights.
    fn at(place: Self::Place, weight: f64) -> Self;
    /// Where it is.
    fn coordinates(&self) -> Self::Place;
    /// Its weight; 0 if points have none.
    fn weight(&self) -> f64;
    /// The points at some places, without a copy, if a point is no more than its place.
    fn of_places(places: &[Self::Place]) -> Option<&[Self]>;
    /// The point in space, of the plane at height 0.
    fn in_space(&self) -> Self::VertexInSpace;
    /// The coordinates of points, one after the other.
    fn flattened(points: &[Self]) -> &[f64];
    /// The coordinates of points, one after the other, to write.
    fn flattened_mut(points: &mut [Self]) -> &mut [f64];
    /// The points of which the coordinates are given one after the other, and the coordinates left over.
    fn of_flattened(coordinates: &[f64]) -> (&[Self], &[f64]);
    /// The square of the way from one to the other: of the distance of two places, and the magnitude of the difference of two
    /// weights more.
    fn squared_way(&self, other: &Self) -> f64;
    /// The [`squared_way`](Self::squared_way) of several pairs of points, in lanes.
    fn squared_ways<S: Simd>(simd: S, points: [&Self; LANES], others: [&Self; LANES]) -> S::Lanes;
    /// The vector to this point from another, if no coordinate of it is rounded; of points that are not finite none is
    /// known.
    fn exact_difference(&self, other: &Self) -> Option<Self>;
    /// Compares the powers of this place in respect of two points, exactly: the squares of distances, less the weights
    /// of the points if they have any.
    fn compare_powers(&self, a: &Self, b: &Self) -> Ordering;
}

impl<const D: usize> PointArray for [f64; D] {
    type Place = Self;
    type VertexInSpace = PlaceInSpace;

    #[inline(always)]
    fn at(place: Self, _: f64) -> Self {
        place
    }

    #[inline(always)]
    fn coordinates(&self) -> Self {
        *self
    }

    #[inline(always)]
    fn weight(&self) -> f64 {
        0.0
    }

    #[inline(always)]
    fn of_places(places: &[Self]) -> Option<&[Self]> {
        Some(places)
    }

    #[inline(always)]
    fn in_space(&self) -> PlaceInSpace {
        place_in_space(self)
    }

    fn flattened(points: &[Self]) -> &[f64] {
        points.as_flattened()
    }

    fn flattened_mut(points: &mut [Self]) -> &mut [f64] {
        points.as_flattened_mut()
    }

    fn of_flattened(coordinates: &[f64]) -> (&[Self], &[f64]) {
        coordinates.as_chunks()
    }

    #[inline(always)]
    fn squared_way(&self, other: &Self) -> f64 {
        square_between(self, other)
    }

    #[inline(always)]
    fn squared_ways<S: Simd>(simd: S, points: [&Self; LANES], others: [&Self; LANES]) -> S::Lanes {
        square_between(&simd.points(points), &simd.points(others))
    }

    #[inline(always)]
    fn exact_difference(&self, other: &Self) -> Option<Self> {
        let parts: [_; D] = std::array::from_fn(|axis| two_difference(self[axis], other[axis]));
        parts.iter().all(|&(_, tail)| tail == 0.0).then(|| parts.map(|(rounded, _)| rounded))
    }
    #[inline(always)]
    fn compare_powers(&self, a: &Self, b: &Self) -> Ordering {
        compare_distance(self, a, b)
    }
}
