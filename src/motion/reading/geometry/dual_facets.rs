//! Voronoi facets in a box, and in half-spaces, with centroids and derivatives of the volumes on their sides by positions.
//!
//! # Idea
//!
//! A facet is the polygon of the centres of the cells around its edge; triangles from its first corner give its measure A
//! and the moment of its points as seen from the middle of the edge. Each edge is done by itself, so that several threads
//! share them.
//!
//! Let x and y be the ends, L their distance and c the centroid of the facet. A point z of the facet is as far from x as
//! from y: |z − x|² = |z − y|². If y moves by dy, and z by dz, (y − x) · dz = (y − z) · dy; so the facet moves by
//! (y − z) · dy / L along its normal, and with it grows the cell of x: dV_x / dy = A (y − c) / L, as was found by many
//! (for instance Springel, 2010, doi 10.1111/j.1365-2966.2009.15715.x, uses the like for his fluxes). What the box has
//! of a cell does not move. So dV_y / dx = A (x − c) / L, and what a vertex loses to all its neighbours is what it
//! gains: dV_x / dx is minus the sum of dV_y / dx over its facets.
//!
//! With weights z has one power to both ends, |z − x|² − w_x = |z − y|² − w_y, and the same follows: what differs is
//! where the facet is. If w_y grows by dw, 2 (y − x) · dz = −dw: all of the facet moves by dw / 2L towards x, and dV_x
//! / dw_y = dV_y / dw_x = −A / 2L. What a vertex gains by its own weight is what all others lose by it.
//!
//! # Accuracy
//!
//! With h as in [`dual`](super::dual), P the perimeter and d the diameter of a facet, A is off by h P, as its corners
//! are off by h; the centroid by h P d / A; a derivative, which is linear in the measure and the moment, by
//! h P (|y − c| + d) / L, and one by a weight by h P / 2L. Where A ≤ 2 h P the quotient of moment and measure could be
//! anywhere; such facets are cut by the box as those are that it does cut, and the centroid is a mean of corners with
//! weights that are not negative: off by d + h at most.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::{memory, threads};
use crate::motion::reading::geometry::cells_within::Region;
use crate::motion::reading::geometry::centres::{Centres, SHARED_AT_LEAST};
use crate::motion::reading::geometry::clipping::{Clip, Vector, dot, length_by, minus, times};
use crate::motion::reading::geometry::incidence::EdgeWithCell;
use crate::motion::reading::geometry::polytopes::Polytope;
use crate::motion::reading::geometry::sums::LEAST_SQUARE;
use crate::motion::reading::geometry::voronoi::Voronoi;
use crate::motion::reading::geometry::whole_facets::{FacetMeasures, by_weight};
use crate::motion::reading::progress::Progress;
use crate::motion::triangulation::MovingTriangulation;

/// The Voronoi facets of edges in a box.
#[derive(Clone, Debug, PartialEq)]
pub struct VoronoiFacets<P> {
    /// The edges, as [`edges`](MovingTriangulation::edges) lists them.
    pub edges: Vec<[VertexId; 2]>,
    /// Lengths or areas of their facets.
    pub areas: Vec<f64>,
    /// Centroids of these; NaN where nothing of a facet is in the box.
    pub centroids: Vec<P>,
    /// The derivative of the area or volume of the cell of an edge's first vertex by the position of the second one,
    /// and of that of the second one by the position of the first.
    pub derivatives: Vec<[P; 2]>,
    /// The derivative of the area or volume of the cell of either end by the weight of the other one, where weights are
    /// what power distances take from squares: minus the measure of the facet over twice the length of the edge. 0
    /// where there are no weights.
    pub weight_derivatives: Vec<f64>,
}

/// The Voronoi facet of an edge in a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoronoiFacet<P> {
    /// Length or area.
    pub area: f64,
    /// Centroid; NaN where nothing of the facet is in the box.
    pub centroid: P,
    /// The derivative of the area or volume of the cell of the edge's first vertex by the position of the second one,
    /// and of that of the second one by the position of the first.
    pub derivatives: [P; 2],
    /// The derivative of the area or volume of the cell of either end by the weight of the other one: minus the measure
    /// of the facet over twice the length of the edge. 0 where there are no weights.
    pub weight_derivative: f64,
}

/// What the area of a facet is to its perimeter, in sizes of the box, where it is narrow: twice what corners are off,
/// and room for what the unit is less than the size. Then the quotient of its moment and its measure may be anywhere.
const NARROW: f64 = 4e-8;

/// How many facets are computed between two looks at whether to go on.
const FACETS_AT_A_TIME: usize = 1 << 15;

impl<G: Moving> Voronoi<'_, G> {
    /// The facet of the ring, if it is in the box as a whole and not so narrow that it has to be put together from its
    /// corners.
    fn whole(&self, clip: &Clip, [x, y]: &[Vector; 2]) -> Option<FacetMeasures> {
        let along = times(&minus(y, x), clip.unit);
        let square = dot(&along, &along);
        if square < LEAST_SQUARE {
            return None;
        }
        let length = square.sqrt();
        let polygon = self.whole_polygon(x, &times(&along, 0.5), &along, clip.unit);
        if G::D == 3 && polygon.weight <= 2.0 * NARROW * polygon.perimeter * length {
            return None;
        }
        let factor = if G::D == 2 { 1.0 } else { 0.5 };
        let measure = factor * polygon.weight / length;
        let unit = |measure: f64| clip.measure_in(G::D - 1, measure);
        let mut centroid = [f64::NAN; 3];
        let mut derivatives = [[0.0; 3]; 2];
        for axis in 0..3 {
            if polygon.weight > 0.0 {
                let way = (polygon.moment[axis] / polygon.weight + 0.5 * along[axis]) / clip.unit;
                centroid[axis] = (x[axis] + way).clamp(clip.low()[axis], clip.high()[axis]);
            }
            let from_middle = factor * (polygon.moment[axis] / length) / length;
            let half = 0.5 * measure * (along[axis] / length);
            derivatives[0][axis] = unit(half - from_middle);
            derivatives[1][axis] = unit(-half - from_middle);
        }
        let weight_derivative = clip.measure_in(G::D - 2, by_weight::<G>(measure, length));
        Some(FacetMeasures { measure: unit(measure), centroid, derivatives, weight_derivative })
    }

    /// The facet of an edge, of which `first` is a cell.
    fn facet_of(
        &mut self,
        region: &Region,
        left: &mut Polytope,
        edge: [VertexId; 2],
        first: CellId,
    ) -> Result<FacetMeasures> {
        let clip = &region.clip;
        let ends = edge.map(|v| self.place(v));
        self.ring.go_around(self.cells, edge, first)?;
        if self.is_whole()
            && let Some(facet) = self.whole(clip, &ends)
        {
            return Ok(facet);
        }
        if self.is_outside() {
            return Ok(FacetMeasures::NOTHING);
        }
        self.cut(edge, clip)?;
        let (measure, offset) = if region.half_spaces.is_empty() {
            self.facet.measure_and_centroid()
        } else {
            left.facet_within::<G>(clip, &region.half_spaces, &self.facet)?
        };
        if measure == 0.0 {
            return Ok(FacetMeasures::NOTHING);
        }
        let centroid = [0, 1, 2].map(|axis| (clip.low()[axis] + offset[axis]).min(clip.high()[axis]));
        let way = minus(&ends[1], &ends[0]);
        let length = length_by(dot(&way, &way), &way);
        let derivative = |of: &Vector| [0, 1, 2].map(|axis| measure * ((of[axis] - centroid[axis]) / length));
        Ok(FacetMeasures {
            measure,
            centroid,
            derivatives: [derivative(&ends[1]), derivative(&ends[0])],
            weight_derivative: by_weight::<G>(measure, length),
        })
    }
}

impl<G: Moving> MovingTriangulation<G> {
    /// The facets of edges in a region, or without one, each by itself; on several threads where that pays.
    pub(super) fn facets_of(
        &self,
        edges: &[EdgeWithCell],
        region: Option<&Region>,
        centres: &Centres<'_, G::Point>,
        progress: &mut Progress,
    ) -> Result<Vec<FacetMeasures>> {
        let cells = self.cell_arrays()?;
        let mut facets = Vec::new();
        memory::reserve_exact(&mut facets, edges.len())?;
        for some in edges.chunks(FACETS_AT_A_TIME) {
            let n_threads = self.mesh.kernel.threads().for_work(some.len(), SHARED_AT_LEAST, 64);
            let parts = threads::for_ranges(some.len(), n_threads, |range| {
                let mut voronoi = Voronoi::new(self, cells, centres);
                let (mut facets, mut left): (Vec<FacetMeasures>, _) = (Vec::new(), Polytope::default());
                memory::reserve_exact(&mut facets, range.len())?;
                for &(edge, first) in &some[range] {
                    facets.push(match region {
                        Some(region) => voronoi.facet_of(region, &mut left, edge, first)?,
                        None => voronoi.facet_without_box(edge, first)?,
                    });
                }
                Ok(facets)
            })?;
            for part in parts {
                memory::append(&mut facets, &part?)?;
            }
            progress.advance(some.len())?;
        }
        Ok(facets)
    }
}

/// The coordinates that a dimension has.
pub(super) fn of_space<G: Moving>(p: &Vector) -> G::Point {
    let mut point = G::Point::default();
    (0..G::D).for_each(|axis| point[axis] = p[axis]);
    point
}
