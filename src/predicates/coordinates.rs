//! Points: arrays of coordinates, of either dimension, with a weight or without.

use std::fmt::Debug;
use std::ops::{Index, IndexMut};

use super::array::PointArray;
use super::weighted::WeightedPoint;

/// What is known of one point: `[f64; D]`, or a `WeightedPoint`, of which an index of `D` has the weight. As a slice it is its
/// place.
pub trait Coordinates:
    Copy
    + Debug
    + Default
    + PartialEq
    + Index<usize, Output = f64>
    + IndexMut<usize>
    + AsRef<[f64]>
    + PointArray
    + Send
    + Sync
    + 'static
{
}
impl Coordinates for [f64; 2] {}
impl Coordinates for [f64; 3] {}
impl Coordinates for WeightedPoint<2> {}
impl Coordinates for WeightedPoint<3> {}
