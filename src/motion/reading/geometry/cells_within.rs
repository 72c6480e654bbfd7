//! Voronoi cells in a box that half-spaces cut, too.
//!
//! A circumcentre that is beyond a half-space is marked, as those are that are out of the box. A cell that has none is
//! in all half-spaces. Of the others those that are certainly beyond a half-space as a whole have nothing, and the rest
//! are made polytopes (`polytopes.rs`) of their facets in the box.
//!
//! # Cost
//!
//! A circumcentre is compared with the half-spaces that are near it, a cell that is cut with all: a bound for its
//! corners with each.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::{memory, threads};
use crate::motion::reading::geometry::centres::{BEYOND, Centre, Centres, SHARED_AT_LEAST};
use crate::motion::reading::geometry::clipping::{Clip, Vector, in_space, times};
use crate::motion::reading::geometry::cut_cells::BoxCorner;
use crate::motion::reading::geometry::half_spaces::{BoxBounds, HalfSpaces};
use crate::motion::reading::geometry::incidence::Neighbours;
use crate::motion::reading::geometry::polytopes::Polytope;
use crate::motion::reading::geometry::sums::Sums;
use crate::motion::reading::geometry::voronoi::Voronoi;
use crate::motion::reading::progress::Progress;
use crate::motion::state::cells::NO_CELL;
use crate::motion::triangulation::MovingTriangulation;

/// How many half-spaces a cell is compared with in about the time of a visit to a cell of the triangulation.
const SPACES_PER_CELL: usize = 32;

/// What Voronoi cells are clipped by.
pub(crate) struct Region {
    pub(super) clip: Clip,
    pub(super) half_spaces: HalfSpaces,
}

impl Region {
    /// The offset of a place from the box's corner of least coordinates, in the box's unit.
    pub(super) fn offset(&self, place: &Vector) -> Vector {
        let low = self.clip.low();
        [0, 1, 2].map(|axis| (place[axis] - low[axis]) * self.clip.unit)
    }

    /// Marks circumcentres in the box that are beyond a half-space.
    pub(super) fn mark<G: Moving>(&self, t: &MovingTriangulation<G>, centres: &mut Centres<G::Point>) {
        if self.half_spaces.is_empty() {
            return;
        }
        let n_threads = t.mesh.kernel.threads().for_work(centres.list.len(), SHARED_AT_LEAST, 64);
        threads::for_parts(&mut centres.list, 0, n_threads, &|_, part: &mut [Centre<G::Point>]| {
            for centre in part.iter_mut().filter(|centre| centre.fits()) {
                if self.half_spaces.are_left_by(&self.offset(&in_space::<G>(&centre.place))) {
                    centre.sides |= BEYOND;
                }
            }
        });
    }

    /// What a cell has in the half-spaces, with offsets from the place in the box that is nearest to its vertex; the
    /// facets of the cell and the corners of the box in it have been added.
    pub(super) fn sums_of<G: Moving>(
        &self,
        cell: &mut Polytope,
        corners: &[(BoxCorner, VertexId)],
        v: VertexId,
        place: &Vector,
    ) -> Result<Sums> {
        for (corner, _) in corners.iter().filter(|(_, owner)| *owner == v) {
            cell.add_corner::<G>(&self.clip, corner)?;
        }
        cell.close::<G>()?;
        cell.cut::<G>(&self.half_spaces)?;
        Ok(cell.sums::<G>(&times(&self.clip.offset_within(place), self.clip.unit)))
    }
}

impl<G: Moving> Voronoi<'_, G> {
    /// Tells what there is of the cells of some vertices.
    pub(super) fn cells_within(
        &mut self,
        region: &Region,
        mut neighbours: Neighbours<'_, G>,
        vertices: impl Iterator<Item = VertexId>,
        progress: &mut Progress,
        mut tell: impl FnMut(VertexId, &Sums),
    ) -> Result<()> {
        let mut corners = Vec::new();
        self.for_corners(&region.clip, |corner, owner| memory::push(&mut corners, (corner, owner)))?;
        let (mut list, mut cell) = (Vec::new(), Polytope::default());
        for v in vertices {
            progress.advance(neighbours.star(v).len() + region.half_spaces.list.len() / SPACES_PER_CELL)?;
            if self.is_missed(region, neighbours.star(v), v) {
                tell(v, &Sums::default());
                continue;
            }
            neighbours.list(v, VertexId::new(0), &mut list, |w, cell| (w, cell))?;
            cell.clear();
            for &(w, first) in &list {
                self.ring.go_around(self.cells, [v, w], first)?;
                if !self.is_outside() {
                    self.cut([v, w], &region.clip)?;
                    cell.add_facet::<G>(&region.clip, &self.facet)?;
                }
                progress.advance(self.ring.cells.len())?;
            }
            tell(v, &region.sums_of::<G>(&mut cell, &corners, v, &self.place(v))?);
        }
        Ok(())
    }

    /// Whether a vertex has a cell in the box that is beyond a half-space as a whole, for certain.
    fn is_missed(&self, region: &Region, star: &[CellId], v: VertexId) -> bool {
        let mut bounds = BoxBounds::NONE;
        for &cell in star {
            let centre = self.centres.of(cell);
            let corners = self.cells.corners()[cell].as_ref().iter();
            let mut around = corners.zip(self.cells.neighbours()[cell].as_ref());
            if centre.sides != BEYOND || around.any(|(&w, &next)| w != v && next == NO_CELL) {
                return false;
            }
            bounds.include(&region.offset(&in_space::<G>(&centre.place)));
        }
        region.half_spaces.certainly_miss(&bounds)
    }
}
