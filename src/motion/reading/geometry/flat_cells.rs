//! Voronoi cells of vertices in one hyperplane, cut by a box.
//!
//! While all vertices are on a line, or in space in a plane, there are no cells that tell which Voronoi cells meet.
//! With further places, as few as make the vertices span the dimension, there are: those of a triangulation of all. In
//! it, the sphere of a cell of vertices in a hyperplane and one other place meets the hyperplane in the sphere of the
//! vertices alone, so it holds no other vertex: these cells are a Delaunay triangulation of the vertices in their
//! hyperplane. What is said of the further places is left out. With weights the same is true of power spheres and of
//! the vertices that are shown, whatever the weights of the further places; those that are hidden have no cells.

use std::array::from_fn;

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::options::Options;
use crate::motion::reading::geometry::cells_within::Region;
use crate::motion::reading::geometry::centres::Centres;
use crate::motion::reading::geometry::clipping::{Clip, Vector, greatest, in_space};
use crate::motion::reading::geometry::cut_cells::BoxCorner;
use crate::motion::reading::geometry::cut_facets::CutFacet;
use crate::motion::reading::geometry::incidence::Neighbours;
use crate::motion::reading::geometry::polytopes::Polytope;
use crate::motion::reading::geometry::rings::EdgeRing;
use crate::motion::reading::geometry::sums::Sums;
use crate::motion::reading::progress::Progress;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::{VertexInSpace, sign_of_cross};

/// Whether places are moved along each axis from the first one of a set to make it span the dimension.
fn missing_axes<G: Moving>(places: &[Vector]) -> [bool; 3] {
    let first = &places[0];
    let Some(second) = places.iter().find(|p| *p != first) else { return [false; 3] };
    let normal = |p: &Vector| (0..3).find(|&axis| sign_of_cross([first, second, p], axis) != 0);
    match if G::D == 3 { places.iter().find_map(normal) } else { None } {
        Some(missing) => from_fn(|axis| axis == missing),
        None => {
            let along = (0..G::D).find(|&axis| first[axis] != second[axis]).expect("other places");
            from_fn(|axis| axis < G::D && axis != along)
        }
    }
}

/// Places in one hyperplane, and others with which they span the dimension: those that are moved by the size of the
/// set.
fn spanning<G: Moving>(mut places: Vec<G::Point>) -> Result<Vec<G::Point>> {
    let mut in_space_all = Vec::new();
    memory::collect(&mut in_space_all, places.iter().map(in_space::<G>))?;
    let size = in_space_all.iter().fold(0.0f64, |most, p| most.max(greatest(p)));
    let step = if size > 0.0 { size } else { 1.0 };
    let is_missing = missing_axes::<G>(&in_space_all);
    for axis in (0..G::D).filter(|&axis| is_missing[axis]) {
        let mut place = places[0];
        place[axis] -= step.copysign(place[axis]);
        memory::push(&mut places, place)?;
    }
    Ok(places)
}

impl<G: Moving> MovingTriangulation<G> {
    /// Tells what there is in a box of the Voronoi cells of vertices in one hyperplane: parts whose sums are to be
    /// added, with offsets as in [`cut_cells`](super::voronoi::Voronoi::cut_cells).
    pub(super) fn flat_cells(
        &self,
        region: &Region,
        progress: &mut Progress,
        mut tell: impl FnMut(VertexId, &Sums),
    ) -> Result<()> {
        let (mut ids, mut places) = (Vec::new(), Vec::new());
        let hidden = self.mesh.kernel.hidden_without_cells()?;
        let shown = self.mesh.kernel.live_sites().filter(|s| hidden.binary_search(s).is_err());
        memory::collect(&mut ids, shown.map(|s| self.mesh.kernel.site(s).id))?;
        if ids.is_empty() {
            return Ok(());
        }
        ids.sort_unstable();
        memory::collect(&mut places, ids.iter().map(|&v| self.mesh.kernel.site(self.mesh.site_of[v]).point))?;
        let Options { threads, parts, .. } = self.options;
        let options = Options { threads, parts, ..Options::default() };
        let spanning = MovingTriangulation::<G>::new(&spanning::<G>(places)?, options)?;
        spanning.cells_of_first(ids.len(), region, progress, |v, sums| tell(ids[v.index()], sums))
    }

    /// Tells parts of the Voronoi cells of the first vertices, which are in one hyperplane, as if there were no others.
    fn cells_of_first(
        &self,
        n: usize,
        region: &Region,
        progress: &mut Progress,
        mut tell: impl FnMut(VertexId, &Sums),
    ) -> Result<()> {
        let (cells, clip) = (self.cell_arrays()?, &region.clip);
        progress.expect_more(2 * cells.corners().len());
        let mut neighbours = Neighbours::new(cells, self.id_count())?;
        let corners = self.corners_of_first(n, clip, &mut neighbours)?;
        let is_cut = !region.half_spaces.is_empty();
        let (mut ring, mut facet, mut list) = (EdgeRing::default(), CutFacet::default(), Vec::new());
        let mut cell = Polytope::default();
        let centres = Centres::<G::Point>::NONE;
        for v in VertexId::range(0..n) {
            let at = self.ball(v);
            let apex = clip.offset_within(at.place());
            cell.clear();
            neighbours.list(v, VertexId::new(0), &mut list, |w, cell| (w, cell))?;
            for &(w, first) in list.iter().filter(|(w, _)| w.index() < n) {
                ring.go_around(cells, [v, w], first)?;
                let (mut others, mut n_others) = ([at; 2], 0);
                for &z in ring.link.iter().filter(|z| G::D == 3 && z.index() < n) {
                    others[n_others] = self.ball(z);
                    n_others += 1;
                }
                facet.fill_flat([at, self.ball(w)], &others[..n_others], G::D == 2)?;
                facet.cut(clip, &centres)?;
                facet.place(clip, &centres)?;
                progress.advance(ring.cells.len())?;
                if is_cut {
                    cell.add_facet::<G>(clip, &facet)?;
                    continue;
                }
                let mut sums = Sums::default();
                facet.add_pyramids(clip, &apex, &mut sums);
                sums.facets = clip.facet_in_unit(G::D, facet.measure());
                tell(v, &sums);
            }
            if is_cut {
                tell(v, &region.sums_of::<G>(&mut cell, &corners, v, at.place())?);
            }
        }
        for (corner, owner) in corners.iter().filter(|_| !is_cut) {
            tell(*owner, &corner.sums::<G>(clip, &clip.offset_within(&self.place_in_space(*owner))));
        }
        Ok(())
    }

    /// The corners of the box, and in whose cells of the first vertices they are.
    fn corners_of_first(
        &self,
        n: usize,
        clip: &Clip,
        neighbours: &mut Neighbours<'_, G>,
    ) -> Result<Vec<(BoxCorner, VertexId)>> {
        let mut corners = Vec::new();
        for corner in BoxCorner::all::<G>(clip) {
            let near = self.nearest_of_first(n, &corner)?;
            let owner = corner.owner(
                near,
                |v| self.ball(v),
                |v, others| {
                    neighbours.list(v, VertexId::new(0), others, |w, _| w)?;
                    others.retain(|w| w.index() < n);
                    Ok(())
                },
            )?;
            memory::push(&mut corners, (corner, owner))?;
        }
        Ok(corners)
    }

    /// Of the first vertices, one from which to look for that nearest to a corner of the box.
    fn nearest_of_first(&self, n: usize, corner: &BoxCorner) -> Result<VertexId> {
        let is_first = |v: &VertexId| v.index() < n;
        let nearest = self.nearest_vertex(&corner.point::<G>())?.filter(is_first);
        let of_cell = || self.cell_arrays().map(|cells| cells.corners()[CellId::new(0)]);
        match nearest {
            Some(nearest) => Ok(nearest),
            None => Ok(*of_cell()?.as_ref().iter().find(|&v| is_first(v)).expect("one that is not an apex")),
        }
    }
}
