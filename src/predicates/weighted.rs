//! Points with weights: balls, whose squared radii are the weights, in the field's words.

#![allow(unsafe_code)]

use std::cmp::Ordering;
use std::ops::{Index, IndexMut};

use super::array::{PointArray, place_in_space};
use super::distance::compare_power;
use super::integer::two_difference;
use super::vectors::square_between;
use crate::simd::{LANES, Real, Simd};

/// A place and its weight; or several, in lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct WeightedPoint<const D: usize, T = f64> {
    /// Where it is.
    pub place: [T; D],
    /// What is taken from the square of a distance to it.
    pub weight: T,
}

impl<const D: usize> Default for WeightedPoint<D> {
    fn default() -> Self {
        WeightedPoint { place: [0.0; D], weight: 0.0 }
    }
}

impl<const D: usize> AsRef<[f64]> for WeightedPoint<D> {
    #[inline(always)]
    fn as_ref(&self) -> &[f64] {
        &self.place
    }
}

impl<const D: usize> Index<usize> for WeightedPoint<D> {
    type Output = f64;

    #[inline(always)]
    fn index(&self, k: usize) -> &f64 {
        if k == D { &self.weight } else { &self.place[k] }
    }
}

impl<const D: usize> IndexMut<usize> for WeightedPoint<D> {
    #[inline(always)]
    fn index_mut(&mut self, k: usize) -> &mut f64 {
        if k == D { &mut self.weight } else { &mut self.place[k] }
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

const _: () = assert!(size_of::<WeightedPoint<2>>() == size_of::<[f64; 3]>());
const _: () = assert!(size_of::<WeightedPoint<3>>() == size_of::<[f64; 4]>());

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
