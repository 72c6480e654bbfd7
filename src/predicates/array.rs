//! What is the same for points of any dimension.

#![allow(unsafe_code)]

use std::cmp::Ordering;

use super::distance::{compare_distance, compare_power};
use super::in_space::{PlaceInSpace, VertexInSpace, place_in_space};
use super::integer::two_difference;
use super::vectors::square_between;
use super::weighted::WeightedPoint;
use crate::simd::{LANES, Real, Simd};

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

/// The numbers of points, each its coordinates and then its weight. A vector to a point is one of weights as well.
impl<const D: usize> PointArray for WeightedPoint<D> {
    type Place = [f64; D];
    type VertexInSpace = WeightedPoint<3>;

    #[inline(always)]
    fn at(place: [f64; D], weight: f64) -> Self {
        WeightedPoint { place, weight }
    }

    #[inline(always)]
    fn coordinates(&self) -> [f64; D] {
        self.place
    }

    #[inline(always)]
    fn weight(&self) -> f64 {
        self.weight
    }

    #[inline(always)]
    fn of_places(_: &[[f64; D]]) -> Option<&[Self]> {
        None
    }

    #[inline(always)]
    fn in_space(&self) -> WeightedPoint<3> {
        WeightedPoint { place: place_in_space(&self.place), weight: self.weight }
    }

    fn flattened(points: &[Self]) -> &[f64] {
        // SAFETY: a point is D + 1 numbers, one after the other.
        unsafe { std::slice::from_raw_parts(points.as_ptr().cast(), points.len() * (D + 1)) }
    }

    fn flattened_mut(points: &mut [Self]) -> &mut [f64] {
        // SAFETY: a point is D + 1 numbers, one after the other, and any numbers are one.
        unsafe { std::slice::from_raw_parts_mut(points.as_mut_ptr().cast(), points.len() * (D + 1)) }
    }

    fn of_flattened(numbers: &[f64]) -> (&[Self], &[f64]) {
        let n = numbers.len() / (D + 1);
        let (whole, rest) = numbers.split_at(n * (D + 1));
        // SAFETY: D + 1 numbers, one after the other, are a point.
        (unsafe { std::slice::from_raw_parts(whole.as_ptr().cast(), n) }, rest)
    }

    #[inline(always)]
    fn squared_way(&self, other: &Self) -> f64 {
        square_between(&self.place, &other.place) + (self.weight - other.weight).abs()
    }

    #[inline(always)]
    fn squared_ways<S: Simd>(simd: S, points: [&Self; LANES], others: [&Self; LANES]) -> S::Lanes {
        let [places, goals] = [points, others].map(
            #[inline(always)]
            |points| {
                simd.points(points.map(
                    #[inline(always)]
                    |p| &p.place,
                ))
            },
        );
        let [from, to] = [points, others].map(
            #[inline(always)]
            |points| {
                simd.load(&points.map(
                    #[inline(always)]
                    |p| p.weight,
                ))
            },
        );
        square_between(&places, &goals) + (from - to).abs()
    }

    #[inline(always)]
    fn exact_difference(&self, other: &Self) -> Option<Self> {
        let (weight, tail) = two_difference(self.weight, other.weight);
        let place = self.place.exact_difference(&other.place).filter(|_| tail == 0.0)?;
        Some(WeightedPoint { place, weight })
    }

    #[inline(always)]
    fn compare_powers(&self, a: &Self, b: &Self) -> Ordering {
        compare_power(&self.place, a, b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_points() {
        let mut points = [WeightedPoint { place: [1.0, 2.0], weight: 3.0 }, WeightedPoint::default()];
        assert_eq!(WeightedPoint::flattened(&points), [1.0, 2.0, 3.0, 0.0, 0.0, 0.0]);
        WeightedPoint::flattened_mut(&mut points)[4] = 5.0;
        assert_eq!((points[1].place, points[0].as_ref()), ([0.0, 5.0], &[1.0, 2.0][..]));
        let numbers = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        let (two, rest) = WeightedPoint::<3>::of_flattened(&numbers);
        assert_eq!((two.len(), two[1].weight, two[1][2], two[1][3], rest), (2, 8.0, 7.0, 8.0, &[9.0][..]));
        let step = two[1].exact_difference(&two[0]);
        assert_eq!(step, Some(WeightedPoint { place: [4.0; 3], weight: 4.0 }));
        let far = WeightedPoint { place: [1.0; 3], weight: 1e30 };
        assert_eq!((far.exact_difference(&two[0]), far == far), (None, true));
    }
}
