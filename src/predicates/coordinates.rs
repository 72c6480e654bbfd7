//! Points: arrays of coordinates, of either dimension.

use std::fmt::Debug;
use std::ops::{Index, IndexMut};

use super::array::PointArray;
use super::bicells::BiCellTolerances;
use super::measures::Measures;
use super::reach::Reach;

/// Coordinates of one point: `[f64; D]`.
pub trait Coordinates:
    Copy
    + Debug
    + Default
    + PartialEq
    + Index<usize, Output = f64>
    + IndexMut<usize>
    + AsRef<[f64]>
    + PointArray
    + BiCellTolerances
    + Measures
    + Reach
    + Send
    + Sync
{
}
impl Coordinates for [f64; 2] {}
impl Coordinates for [f64; 3] {}
