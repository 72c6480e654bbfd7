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
    pub(crate) const fn width<G: Moving>(self) -> usize {
        match self {
            PointPart::Place => G::D,
            PointPart::Weight => 1,
        }
    }

    /// Both parts.
    pub(crate) const BOTH: [Self; 2] = [PointPart::Place, PointPart::Weight];

    /// The other one.
    pub(crate) const fn other(self) -> Self {
        match self {
            PointPart::Place => PointPart::Weight,
            PointPart::Weight => PointPart::Place,
        }
    }

    /// What programs know it by.
    pub(crate) const fn argument(self) -> &'static str {
        match self {
            PointPart::Place => "positions",
            PointPart::Weight => "weights",
        }
    }

    /// The row of numbers at an index.
    pub(crate) fn row<G: Moving>(self, numbers: &[f64], index: usize) -> &[f64] {
        let width = self.width::<G>();
        &numbers[width * index..width * (index + 1)]
    }

    /// A bit for each.
    pub(crate) const fn bit(self) -> u8 {
        match self {
            PointPart::Place => 1,
            PointPart::Weight => 2,
        }
    }
}

/// Takes the numbers for this part of a point, without negative zeros.
pub(crate) fn set_part<G: Moving>(point: &mut G::Point, part: PointPart, numbers: &[f64]) {
    let first = if part == PointPart::Place { 0 } else { G::D };
    numbers.iter().enumerate().for_each(|(k, &value)| point[first + k] = value + 0.0);
}

/// The numbers of this part of a point.
pub(crate) fn numbers_of<G: Moving>(point: &G::Point, part: PointPart) -> &[f64] {
    let numbers = G::Point::flattened(std::slice::from_ref(point));
    if part == PointPart::Place { &numbers[..G::D] } else { &numbers[G::D..] }
}

/// Takes this part of another point.
pub(crate) fn copy_part<G: Moving>(point: &mut G::Point, part: PointPart, other: &G::Point) {
    let numbers = if part == PointPart::Place { 0..G::D } else { G::D..G::NUMBERS };
    numbers.for_each(|k| point[k] = other[k]);
}

/// The part of a goal that is staged; both if none is left out.
pub(crate) fn staged_part<G: Moving>(goal: &G::Point) -> Option<PointPart> {
    let is_without = |part| numbers_of::<G>(goal, part).iter().all(|x| x.is_nan());
    match [PointPart::Place, PointPart::Weight].map(is_without) {
        [true, false] => Some(PointPart::Weight),
        [false, true] => Some(PointPart::Place),
        _ => None,
    }
}
