//! The Voronoi facet of an edge, as what is around it says.
//!
//! The corners of the facet are the circumcentres of the cells around the edge. If all of them are in the box it is their
//! polygon (in the plane a segment); otherwise it is cut (`cut_facets.rs`), and so are the cells of both vertices
//! (`cut_cells.rs`). Which circumcentres are in the box is exact.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::motion::reading::geometry::centres::Centres;
use crate::motion::reading::geometry::clipping::{Ball, Clip, Vector, in_space};
use crate::motion::reading::geometry::cut_facets::CutFacet;
use crate::motion::reading::geometry::rings::EdgeRing;
use crate::motion::state::cells::Cells;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::PointArray;

/// Computes Voronoi facets.
pub(super) struct Voronoi<'t, G: Moving> {
    pub(super) t: &'t MovingTriangulation<G>,
    pub(super) cells: &'t Cells<G>,
    pub(super) centres: &'t Centres<'t, G::Point>,
    pub(super) ring: EdgeRing,
    pub(super) facet: CutFacet<Ball<G>>,
}

impl<'t, G: Moving> Voronoi<'t, G> {
    /// With the centres of all cells that are around edges that are looked at.
    pub(super) fn new(
        t: &'t MovingTriangulation<G>,
        cells: &'t Cells<G>,
        centres: &'t Centres<'t, G::Point>,
    ) -> Self {
        Voronoi { t, cells, centres, ring: EdgeRing::default(), facet: CutFacet::default() }
    }

    pub(super) fn place(&self, v: VertexId) -> Vector {
        self.t.place_in_space(v)
    }

    /// Whether the facet of the ring is in the box, and in the half-spaces, as a whole.
    #[inline(always)]
    pub(super) fn is_whole(&self) -> bool {
        let is_inside = |cell: &CellId| self.centres.of(*cell).fits();
        self.ring.is_closed && self.ring.cells.iter().all(is_inside)
    }

    /// Whether the facet of the ring is beyond a face of the box.
    pub(super) fn is_outside(&self) -> bool {
        let sides =
            self.ring.cells.iter().fold(u8::MAX, |sides, cell| sides & self.centres.of(*cell).faces());
        self.ring.is_closed && sides != 0
    }

    /// Makes `facet` the part in the box of that of an edge, around which `ring` is.
    pub(super) fn cut(&mut self, [v, w]: [VertexId; 2], clip: &Clip) -> Result<()> {
        let has_left = self.ring.orient(self.cells, [v, w]);
        let (t, ring) = (self.t, &self.ring);
        self.facet.fill([t.ball(v), t.ball(w)], ring, |z| t.ball(z), G::D == 2, has_left)?;
        self.facet.cut(clip, self.centres)?;
        self.facet.place(clip, self.centres)
    }
}

impl<G: Moving> MovingTriangulation<G> {
    /// The place of a vertex, in the plane at height 0.
    pub(super) fn place_in_space(&self, v: VertexId) -> Vector {
        in_space::<G>(&self.mesh.kernel.site(self.mesh.site_of[v]).point)
    }

    /// A vertex, in the plane at height 0.
    pub(super) fn ball(&self, v: VertexId) -> Ball<G> {
        self.mesh.kernel.site(self.mesh.site_of[v]).point.in_space()
    }

    /// The weight of a vertex, 0 if there are none.
    pub(super) fn weight(&self, v: VertexId) -> f64 {
        self.mesh.kernel.site(self.mesh.site_of[v]).point.weight()
    }
}
