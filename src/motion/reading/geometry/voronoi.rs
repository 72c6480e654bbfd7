//! Voronoi cells and facets, cut by a box.
//!
//! The Voronoi facet of an edge has the circumcentres of the cells around the edge for corners. If all of them are in
//! the box it is their polygon (in the plane a segment), and the cells of both vertices have a pyramid of it; otherwise
//! it is cut (`cut_facets.rs`), and so are both cells (`cut_cells.rs`). Which circumcentres are in the box is exact.
//!
//! # Cost
//!
//! In proportion to the cells: those around all edges are three times as many as there are in the plane, and six times
//! in space, and what is cut is visited twice more.

use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::motion::reading::geometry::centres::Centres;
use crate::motion::reading::geometry::clipping::{
    Clip, Vector, cross, dot, greatest, in_space, length_by, minus,
};
use crate::motion::reading::geometry::cut_facets::CutFacet;
use crate::motion::reading::geometry::rings::Ring;
use crate::motion::state::cells::Cells;
use crate::motion::triangulation::MovingTriangulation;

/// Computes Voronoi facets.
pub(super) struct Voronoi<'t, G: Dimension> {
    pub(super) t: &'t MovingTriangulation<G>,
    pub(super) cells: &'t Cells<G>,
    pub(super) centres: &'t Centres<'t, G::Point>,
    pub(super) ring: Ring,
    pub(super) facet: CutFacet,
}

/// What of a Voronoi facet is in the box.
pub(super) enum Part {
    All,
    /// Some of it, or none.
    Cut,
}

impl<'t, G: Dimension> Voronoi<'t, G> {
    /// With the centres of all cells that are around edges that are looked at.
    pub(super) fn new(
        t: &'t MovingTriangulation<G>,
        cells: &'t Cells<G>,
        centres: &'t Centres<'t, G::Point>,
    ) -> Self {
        Voronoi { t, cells, centres, ring: Ring::default(), facet: CutFacet::default() }
    }

    pub(super) fn place(&self, v: VertexId) -> Vector {
        self.t.place_in_space(v)
    }

    /// How much of the facet of the ring is in the box, if there is a box.
    #[inline(always)]
    pub(super) fn part(&self) -> Part {
        let is_inside = |cell: &CellId| self.centres.of(*cell).fits();
        if self.ring.is_closed && self.ring.cells.iter().all(is_inside) { Part::All } else { Part::Cut }
    }

    /// Whether the facet of the ring is beyond a face of the box.
    pub(super) fn is_outside(&self) -> bool {
        let sides =
            self.ring.cells.iter().fold(u8::MAX, |sides, cell| sides & self.centres.of(*cell).faces());
        self.ring.is_closed && sides != 0
    }

    /// Twice the area of the polygon of the circumcentres around an edge times the length of the edge; in the plane,
    /// the square of the distance between the two centres.
    #[inline(always)]
    fn rounded_measure(&self, along: &Vector) -> f64 {
        let centre = |cell: CellId| in_space::<G>(&self.centres.of(cell).place);
        let (first, others) = self.ring.cells.split_first().expect("a cell at the edge");
        let first = centre(*first);
        let mut before = minus(&centre(others[0]), &first);
        if G::D == 2 {
            return dot(&before, &before);
        }
        let mut doubled = 0.0;
        for &cell in &others[1..] {
            let next = minus(&centre(cell), &first);
            doubled += dot(&cross(&before, &next), along);
            before = next;
        }
        doubled.abs()
    }

    /// Length or area of the polygon of the circumcentres around an edge, and the length of that.
    #[inline(always)]
    pub(super) fn polygon(&self, [v, w]: [VertexId; 2]) -> [f64; 2] {
        let along = minus(&self.place(w), &self.place(v));
        let (square, rounded) = (dot(&along, &along), self.rounded_measure(&along));
        let is_safe = (square > LEAST_SQUARE) & (square < MOST_SQUARE) & (rounded < MOST);
        if !is_safe || G::D == 2 && rounded < LEAST_SQUARE && rounded != 0.0 {
            return self.polygon_scaled(&along);
        }
        let length = square.sqrt();
        [if G::D == 2 { rounded.sqrt() } else { 0.5 * rounded / length }, length]
    }

    /// Length or area of the polygon, and the length of its edge, where numbers are too large or too small for their
    /// products.
    #[cold]
    #[inline(never)]
    fn polygon_scaled(&self, along: &Vector) -> [f64; 2] {
        let length = length_by(dot(along, along), along);
        let unit = along.map(|x| x / greatest(along));
        let unit = unit.map(|x| x / dot(&unit, &unit).sqrt());
        let centre = |cell: CellId| in_space::<G>(&self.centres.of(cell).place);
        let (first, others) = self.ring.cells.split_first().expect("a cell at the edge");
        let first = centre(*first);
        let most = others.iter().fold(greatest(&first), |most, &cell| most.max(greatest(&centre(cell))));
        if most == f64::INFINITY {
            return [most, length];
        }
        // Halves, as the difference may be twice the greatest number.
        let from_first = |cell: CellId| minus(&centre(cell).map(|x| 0.5 * x), &first.map(|x| 0.5 * x));
        let most = others.iter().fold(0.0f64, |most, &cell| most.max(greatest(&from_first(cell))));
        if most == 0.0 {
            return [0.0, length];
        }
        let scaled = |cell: CellId| from_first(cell).map(|x| x / most);
        if G::D == 2 {
            let along = scaled(others[0]);
            return [2.0 * (most * dot(&along, &along).sqrt()), length];
        }
        let doubled: f64 =
            others.windows(2).map(|pair| dot(&cross(&scaled(pair[0]), &scaled(pair[1])), &unit)).sum();
        let area = 2.0 * doubled.abs();
        // Not the square, which may be beyond the range of numbers where the area is not.
        [area * most * most, length]
    }

    /// Makes `facet` the part in the box of that of an edge, around which `ring` is.
    pub(super) fn cut(&mut self, [v, w]: [VertexId; 2], clip: &Clip) -> Result<()> {
        let has_left = self.ring.orient(self.cells, [v, w]);
        let edge = [self.place(v), self.place(w)];
        let (t, ring) = (self.t, &self.ring);
        self.facet.fill(edge, ring, |z| t.place_in_space(z), G::D == 2, has_left)?;
        self.facet.cut(clip, self.centres)?;
        self.facet.place(clip, self.centres)
    }

    /// Length or area of the facet of an edge of which `first` is a cell.
    pub(super) fn measure(&mut self, edge: [VertexId; 2], first: CellId, clip: Option<&Clip>) -> Result<f64> {
        let Some(clip) = clip else {
            self.ring.go_around(self.cells, edge, first)?;
            return Ok(if self.ring.is_closed { self.polygon(edge)[0] } else { f64::INFINITY });
        };
        self.ring.go_around(self.cells, edge, first)?;
        if let Part::All = self.part() {
            return Ok(self.polygon(edge)[0]);
        }
        if self.is_outside() {
            return Ok(0.0);
        }
        self.cut(edge, clip)?;
        Ok(self.facet.measure())
    }
}

/// Bounds of numbers of which products have neither overflowed nor lost more than a result may be off.
const LEAST_SQUARE: f64 = 1e-140;
const MOST_SQUARE: f64 = 1e140;
const MOST: f64 = 1e280;

impl<G: Dimension> MovingTriangulation<G> {
    /// The place of a vertex, in the plane at height 0.
    pub(super) fn place_in_space(&self, v: VertexId) -> Vector {
        in_space::<G>(&self.mesh.kernel.site(self.mesh.site_of[v]).point)
    }
}

/// Area or volume of the pyramid from a vertex to a Voronoi facet, by the measure of that and the length of the edge.
#[inline(always)]
pub(super) fn pyramid<G: Dimension>([measure, length]: [f64; 2]) -> f64 {
    // Half of the least length is zero.
    if measure == f64::INFINITY { measure } else { 0.5 * length * measure / G::D as f64 }
}
