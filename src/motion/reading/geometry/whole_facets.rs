//! Voronoi facets that no box cuts, with centroids and derivatives of the volumes on their sides.
//!
//! Each is computed as `dual_facets` says, in a unit of its own, so that neither its products overflow nor the length of
//! its edge matters.
//!
//! # Accuracy
//!
//! Let R be the greatest circumradius of the cells around the edge, M the greatest magnitude of a coordinate of their
//! circumcentres, and h = 10⁻⁸ R + 10⁻¹⁵ M: corners are off by less than h. With P the perimeter and d the diameter of
//! the facet, its measure A is off by h P, its centroid by h P d / A, a derivative, which is linear in measure and
//! moment, by h P (|x − c| + d) / L. Where A ≤ 2 h P the mean of the corners stands for the centroid: off by d + h at
//! most. The derivative by a weight is off by h P / 2 L. With weights R is the greatest of the lengths that say what
//! the corners are off by ([`Measures::centre`](crate::predicates::Measures::centre)).

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::motion::reading::geometry::clipping::{
    Vector, cross, dot, greatest, in_space, length_by, minus, normalised, times, unit_of, without_unit,
};
use crate::motion::reading::geometry::voronoi::Voronoi;

/// What corners are off in the unit of a facet, in which no coordinate of a way from its vertex to one of them is above 2, and
/// so no circumradius above 3.5.
const OFF: f64 = 3.5e-8;

/// What they are off besides, in magnitudes of coordinates.
const OFF_BY_PLACE: f64 = 1e-15;

/// What a facet measures.
#[derive(Clone, Copy, Debug)]
pub(super) struct FacetMeasures {
    pub(super) measure: f64,
    pub(super) centroid: Vector,
    /// As [`VoronoiFacet`](crate::motion::VoronoiFacet) has them.
    pub(super) derivatives: [Vector; 2],
    pub(super) weight_derivative: f64,
}

impl FacetMeasures {
    /// There is nothing of the facet.
    pub(super) const NOTHING: Self = FacetMeasures {
        measure: 0.0,
        centroid: [f64::NAN; 3],
        derivatives: [[0.0; 3]; 2],
        weight_derivative: 0.0,
    };

    /// The facet has no end.
    const ENDLESS: Self = FacetMeasures {
        measure: f64::INFINITY,
        centroid: [f64::NAN; 3],
        derivatives: [[f64::NAN; 3]; 2],
        weight_derivative: f64::NAN,
    };
}

/// The derivative of the volume of the cell of an edge's end by the weight of the other one, from the measure of the
/// facet and the length of the edge; 0 if there are no weights.
#[inline(always)]
pub(super) fn by_weight<G: Moving>(measure: f64, length: f64) -> f64 {
    match measure {
        _ if !G::HAS_WEIGHTS => 0.0,
        0.0 => 0.0,
        measure => -0.5 * (measure / length),
    }
}

/// Sums over triangles of a facet, with lengths in some unit.
pub(super) struct Polygon {
    /// The measure times the length of the vector along the edge, and times two in space.
    pub(super) weight: f64,
    /// The sum of the lengths of its sides.
    pub(super) perimeter: f64,
    /// The sum of the offsets of its points from the middle of the edge, times as much.
    pub(super) moment: Vector,
}

impl<G: Moving> Voronoi<'_, G> {
    /// The facet of the ring of an edge, of which `half` is a half and `along` any vector along it.
    pub(super) fn whole_polygon(&self, x: &Vector, half: &Vector, along: &Vector, unit: f64) -> Polygon {
        let from_middle =
            |cell: CellId| minus(&times(&minus(&in_space::<G>(&self.centres.of(cell).place), x), unit), half);
        let way = |p: &Vector, q: &Vector| {
            let way = minus(q, p);
            dot(&way, &way).sqrt()
        };
        let first = from_middle(self.ring.cells[0]);
        let mut before = from_middle(self.ring.cells[1]);
        if G::D == 2 {
            let step = minus(&before, &first);
            let weight = (step[0] * along[1] - step[1] * along[0]).abs();
            let moment = times(&[first[0] + before[0], first[1] + before[1], 0.0], 0.5 * weight);
            return Polygon { weight, perimeter: 2.0, moment };
        }
        let mut polygon = Polygon { weight: 0.0, perimeter: way(&first, &before), moment: [0.0; 3] };
        for &cell in &self.ring.cells[2..] {
            let next = from_middle(cell);
            let part = dot(along, &cross(&minus(&before, &first), &minus(&next, &first)));
            polygon.weight += part;
            polygon.perimeter += way(&before, &next);
            for axis in 0..3 {
                polygon.moment[axis] += part * (first[axis] + before[axis] + next[axis]);
            }
            before = next;
        }
        polygon.perimeter += way(&before, &first);
        // The ring may go either way around.
        let sign = if polygon.weight < 0.0 { -1.0 } else { 1.0 };
        polygon.weight *= sign;
        polygon.moment = times(&polygon.moment, sign / 3.0);
        polygon
    }

    /// The facet of an edge, of which `first` is a cell: its centroid as seen from the edge's first vertex. Where it has no
    /// end, or none within the range of numbers, its measure is infinite and the rest NaN.
    pub(super) fn facet_without_box(&mut self, edge: [VertexId; 2], first: CellId) -> Result<FacetMeasures> {
        self.ring.go_around(self.cells, edge, first)?;
        let [x, y] = edge.map(|v| self.place(v));
        let way = minus(&y, &x);
        let to = |&cell: &CellId| minus(&in_space::<G>(&self.centres.of(cell).place), &x);
        let reach = self.ring.cells.iter().fold(greatest(&way), |most, cell| most.max(greatest(&to(cell))));
        if !self.ring.is_closed || reach == f64::INFINITY {
            return Ok(FacetMeasures::ENDLESS);
        }
        let unit = unit_of(reach);
        let (half, normal) = (times(&way, 0.5 * unit), normalised(&way));
        let length = unit * length_by(dot(&way, &way), &way);
        let polygon = self.whole_polygon(&x, &half, &normal, unit);
        let factor = if G::D == 2 { 1.0 } else { 0.5 };
        let measure = factor * polygon.weight;
        let off = self.off(unit) + OFF_BY_PLACE * unit * (reach + greatest(&x));
        // In the plane the mean of the corners is the centroid.
        let by_mean = G::D == 2 || measure <= 2.0 * off * polygon.perimeter;
        let (share, mut sum) = (1.0 / self.ring.cells.len() as f64, [0.0; 3]);
        for cell in self.ring.cells.iter().filter(|_| by_mean) {
            let to = to(cell);
            (0..3).for_each(|axis| sum[axis] += share * to[axis]);
        }
        let (mut centroid, mut derivatives) = ([f64::NAN; 3], [[0.0; 3]; 2]);
        for axis in 0..3 {
            if measure > 0.0 {
                let by_moment = || (polygon.moment[axis] / polygon.weight + half[axis]) / unit;
                centroid[axis] = if by_mean { sum[axis] } else { by_moment() };
            }
            let moment = factor * polygon.moment[axis];
            // An edge may be too short for the unit.
            let from_middle = if moment == 0.0 { 0.0 } else { moment / length };
            let middle = 0.5 * measure * normal[axis];
            derivatives[0][axis] = without_unit(unit, G::D - 1, middle - from_middle);
            derivatives[1][axis] = without_unit(unit, G::D - 1, -middle - from_middle);
        }
        Ok(FacetMeasures {
            measure: without_unit(unit, G::D - 1, measure),
            centroid,
            derivatives,
            weight_derivative: without_unit(unit, G::D - 2, by_weight::<G>(measure, length)),
        })
    }

    /// What corners of the facet of the ring are off in its unit.
    #[inline(always)]
    fn off(&self, unit: f64) -> f64 {
        if !G::HAS_WEIGHTS {
            return OFF;
        }
        let lengths = self.ring.cells.iter().map(|&cell| self.centres.of(cell).place[G::D]);
        1e-8 * unit * lengths.fold(0.0, f64::max)
    }
}
