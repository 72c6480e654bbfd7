//! The parts of a point with a weight: programs may give either alone.

use crate::delaunay::Moving;

/// A part of a point with a weight, which can be staged alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The coordinates.
    Place,
    /// The weight.
    Weight,
}

impl Part {
    /// A bit for each.
    pub(in crate::motion) const fn bit(self) -> u8 {
        match self {
            Part::Place => 1,
            Part::Weight => 2,
        }
    }
}

/// Takes the numbers for this part of a point, without negative zeros.
pub(in crate::motion) fn set_part<G: Moving>(point: &mut G::Point, part: Part, numbers: &[f64]) {
    let first = if part == Part::Place { 0 } else { G::D };
    numbers.iter().enumerate().for_each(|(k, &value)| point[first + k] = value + 0.0);
}

/// Takes this part of another point.
pub(in crate::motion) fn copy_part<G: Moving>(point: &mut G::Point, part: Part, other: &G::Point) {
    let numbers = if part == Part::Place { 0..G::D } else { G::D..G::NUMBERS };
    numbers.for_each(|k| point[k] = other[k]);
}
