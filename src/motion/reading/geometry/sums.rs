//! What a Voronoi cell adds up from its parts.

use crate::motion::reading::geometry::clipping::Vector;

/// Edges of which the square of the length, in the unit of a box, is less than that are too short for products with it.
pub(super) const LEAST_SQUARE: f64 = 1e-140;

/// Sums over parts of a cell, with lengths in the unit of a box.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    /// Area or volume.
    pub(super) volume: f64,
    /// Length or area of the facets that it shares with other cells.
    pub(super) facets: f64,
    /// Length or area of what it has of faces of the box.
    pub(super) wall: f64,
    /// The sum of the offsets of its points.
    pub(super) moment: Vector,
}

impl Sums {
    /// Adds a part with a centroid that is `share` times the sum of these offsets.
    #[inline(always)]
    pub(super) fn add<const N: usize>(&mut self, volume: f64, share: f64, offsets: [&Vector; N]) {
        self.volume += volume;
        for axis in 0..3 {
            let sum = offsets.iter().fold(0.0, |sum, offset| sum + offset[axis]);
            self.moment[axis] += volume * share * sum;
        }
    }

    /// Adds the sums of other parts.
    pub(super) fn join(&mut self, other: &Sums) {
        self.volume += other.volume;
        self.facets += other.facets;
        self.wall += other.wall;
        (0..3).for_each(|axis| self.moment[axis] += other.moment[axis]);
    }
}
