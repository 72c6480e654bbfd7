//! The parts of a point with a weight: programs may give either alone.

use crate::delaunay::Moving;
use crate::predicates::PointArray;

/// A part of a point with a weight, which can be staged alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointPart {
    /// The coordinates.
    Place,
    /// The weight.
    Weight,
}

impl PointPart {
    /// How many numbers it has.
    pub(in crate::motion) const fn width<G: Moving>(self) -> usize {
        match self {
            PointPart::Place => G::D,
            PointPart::Weight => 1,
        }
    }

    /// A bit for each.
    pub(in crate::motion) const fn bit(self) -> u8 {
        match self {
            PointPart::Place => 1,
            PointPart::Weight => 2,
        }
    }
}

/// Takes the numbers for this part of a point, without negative zeros.
pub(in crate::motion) fn set_part<G: Moving>(point: &mut G::Point, part: PointPart, numbers: &[f64]) {
    let first = if part == PointPart::Place { 0 } else { G::D };
    numbers.iter().enumerate().for_each(|(k, &value)| point[first + k] = value + 0.0);
}

/// The numbers of this part of a point.
pub(in crate::motion) fn numbers_of<G: Moving>(point: &G::Point, part: PointPart) -> &[f64] {
    let numbers = G::Point::flattened(std::slice::from_ref(point));
    if part == PointPart::Place { &numbers[..G::D] } else { &numbers[G::D..] }
}

/// Takes this part of another point.
pub(in crate::motion) fn copy_part<G: Moving>(point: &mut G::Point, part: PointPart, other: &G::Point) {
    let numbers = if part == PointPart::Place { 0..G::D } else { G::D..G::NUMBERS };
    numbers.for_each(|k| point[k] = other[k]);
}
