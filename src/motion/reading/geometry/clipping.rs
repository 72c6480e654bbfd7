//! Boxes that Voronoi cells are cut by, and vectors of space.
//!
//! In the plane, the third coordinate is 0.

use crate::delaunay::{Moving, Shape};
use crate::predicates::{Meeting, PointArray};

/// A vector of space.
pub(super) type Vector = [f64; 3];

/// A point, in the plane at height 0.
// What follows is written out, as closures over arrays are function calls in hot loops.
#[inline(always)]
pub(super) fn in_space<G: Moving>(p: &G::Point) -> Vector {
    [p[0], p[1], if G::D == 3 { p[2] } else { 0.0 }]
}

/// A point in space, with its weight if it has one.
pub(super) type Ball<G> = <<G as Shape>::Point as PointArray>::VertexInSpace;

#[inline(always)]
pub(super) fn minus(p: &Vector, q: &Vector) -> Vector {
    [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
}

#[inline(always)]
pub(super) fn times(p: &Vector, x: f64) -> Vector {
    [p[0] * x, p[1] * x, p[2] * x]
}

#[inline(always)]
pub(super) fn dot(p: &Vector, q: &Vector) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

#[inline(always)]
pub(super) fn cross(p: &Vector, q: &Vector) -> Vector {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

/// The greatest magnitude of a coordinate.
pub(super) fn greatest(p: &Vector) -> f64 {
    p.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Squares of lengths in these bounds have neither overflowed nor lost digits.
const SAFE: std::ops::Range<f64> = 1e-250..1e250;

/// The length of a vector, however short or long that is, from its square.
#[inline(always)]
pub(super) fn length_by(square: f64, p: &Vector) -> f64 {
    if SAFE.contains(&square) { square.sqrt() } else { length_scaled(p) }
}

#[cold]
fn length_scaled(p: &Vector) -> f64 {
    let most = greatest(p);
    if most == 0.0 || most == f64::INFINITY {
        return most;
    }
    let scaled = p.map(|x| x / most);
    most * dot(&scaled, &scaled).sqrt()
}

/// The vector of length 1 in the direction of one that is not zero, however short or long that is.
pub(super) fn normalised(p: &Vector) -> Vector {
    let most = greatest(p);
    let scaled = p.map(|x| x / most);
    let length = dot(&scaled, &scaled).sqrt();
    scaled.map(|x| x / length)
}

/// A face of a box: the one of least or of greatest coordinates along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Face {
    pub(super) axis: usize,
    pub(super) is_high: bool,
}

impl Face {
    /// All of them, in the order in which they cut.
    pub(super) fn all<G: Moving>() -> impl Iterator<Item = Face> {
        (0..2 * G::D).map(|k| Face { axis: k / 2, is_high: k % 2 == 1 })
    }

    /// Which way is out of the box: 1 or -1 along the axis.
    pub(super) fn outward(self) -> i32 {
        if self.is_high { 1 } else { -1 }
    }

    /// A bit of its own.
    pub(super) fn bit(self) -> u8 {
        1 << (2 * self.axis + usize::from(self.is_high))
    }
}

/// The power of two times which a positive number is from 1 to 2, if that is far enough from the bounds of numbers.
pub(super) fn unit_of(size: f64) -> f64 {
    let exponent = (size.to_bits() >> 52) as i32 - 1023;
    2f64.powi(-exponent.clamp(-1000, 1000))
}

/// A product of some lengths in such a unit, in that of coordinates.
pub(super) fn without_unit(unit: f64, dimension: usize, product: f64) -> f64 {
    (0..dimension).fold(product, |product, _| product / unit)
}

/// A box, between two opposite corners.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clip {
    low: Vector,
    high: Vector,
    /// The greatest of its extents.
    pub(super) size: f64,
    /// The greatest magnitude of its coordinates.
    reach: f64,
    /// A power of two times which its size is about 1: products of lengths in this unit are numbers.
    pub(super) unit: f64,
}

impl Clip {
    pub(super) fn new<G: Moving>(low: &G::Point, high: &G::Point) -> Self {
        let (low, high) = (in_space::<G>(low), in_space::<G>(high));
        let reach = greatest(&low).max(greatest(&high));
        let size = greatest(&minus(&high, &low));
        Clip { low, high, size, reach, unit: unit_of(size) }
    }

    /// A product of some lengths in the box's unit, in that of its coordinates.
    pub(super) fn measure_in(&self, dimension: usize, product: f64) -> f64 {
        without_unit(self.unit, dimension, product)
    }

    /// The coordinate of a face along its axis.
    pub(super) fn bound(&self, face: Face) -> f64 {
        if face.is_high { self.high[face.axis] } else { self.low[face.axis] }
    }

    /// Its extent along an axis.
    pub(super) fn extent(&self, axis: usize) -> f64 {
        self.high[axis] - self.low[axis]
    }

    /// Whether a place is in the box.
    pub(super) fn has(&self, p: &Vector) -> bool {
        (0..3).all(|axis| self.low[axis] <= p[axis] && p[axis] <= self.high[axis])
    }

    /// The offset of a place from the corner of least coordinates, or that of the nearest place in the box.
    pub(super) fn offset_within(&self, p: &Vector) -> Vector {
        [0, 1, 2].map(|axis| (p[axis] - self.low[axis]).clamp(0.0, self.extent(axis)))
    }

    /// The measure of a facet, in the box's unit.
    pub(super) fn facet_in_unit(&self, dimension: usize, measure: f64) -> f64 {
        (1..dimension).fold(measure, |measure, _| measure * self.unit)
    }

    /// The way from an offset from the corner of least coordinates to a face, in the box's unit.
    pub(super) fn way_to(&self, face: Face, offset: &Vector) -> Vector {
        let to = if face.is_high { self.extent(face.axis) } else { 0.0 };
        let mut way = [0.0; 3];
        way[face.axis] = (to - offset[face.axis]) * self.unit;
        way
    }

    /// The corner of least coordinates.
    pub(super) fn low(&self) -> &Vector {
        &self.low
    }

    /// The corner of greatest coordinates.
    pub(super) fn high(&self) -> &Vector {
        &self.high
    }

    /// The faces that the circumcentre of a cell is beyond, by their bits: exact. What it is off by follows from the
    /// square of a length, as [`Measures::centre`](crate::predicates::Measures::centre) says.
    #[inline(always)]
    pub(super) fn sides<G: Moving>(&self, centre: &G::Point, squared: f64, cell: &[&G::Point]) -> u8 {
        // The rounding of a centre that is twice as far away as the box does not matter.
        let margin = 1.01e-9 * squared.sqrt() + 4.0 * f64::EPSILON * self.reach;
        let is_inside = |axis: usize| {
            (centre[axis] - self.low[axis] > margin) & (self.high[axis] - centre[axis] > margin)
        };
        if (0..G::D).fold(true, |all, axis| all & is_inside(axis)) {
            return 0;
        }
        self.sides_of_outer::<G>(centre, margin, cell)
    }

    #[inline(never)]
    fn sides_of_outer<G: Moving>(&self, centre: &G::Point, margin: f64, cell: &[&G::Point]) -> u8 {
        let mut sides = 0;
        for face in Face::all::<G>() {
            let beyond = f64::from(face.outward()) * (centre[face.axis] - self.bound(face));
            let is_beyond = if beyond.abs() > margin {
                beyond > 0.0
            } else {
                self.sign_of_centre::<G>(face, cell) == face.outward()
            };
            sides |= if is_beyond { face.bit() } else { 0 };
        }
        sides
    }

    /// The side of a face on which the circumcentre of a cell is.
    #[cold]
    fn sign_of_centre<G: Moving>(&self, face: Face, cell: &[&G::Point]) -> i32 {
        let corners: [Ball<G>; 4] = std::array::from_fn(|k| cell[k.min(G::D)].in_space());
        let mut from = [0.0; 3];
        from[face.axis] = self.bound(face);
        let others = &corners[1..=G::D];
        let is_fixed = [false, false, G::D == 2];
        Meeting { vertex: corners[0], others, from, is_fixed }.sign(face.axis)
    }
}

/// Twice the distance of the bisector of an edge from its first end, and from the other one, in lengths of the edge: 1,
/// unless weights differ. Given are the square of the length, and what the weight of the first end is more.
#[inline(always)]
pub(super) fn heights<G: Moving>(square: f64, apart: f64) -> [f64; 2] {
    if !G::HAS_WEIGHTS {
        return [1.0; 2];
    }
    let more = apart / square;
    [1.0 + more, 1.0 - more]
}
