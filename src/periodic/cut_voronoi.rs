//! Voronoi cells and facets of a set that repeats, cut by a box and half-spaces.
//!
//! Cells inside of vertices at home, and the facets around these, are those of the repeating set, and are cut as those of
//! an open triangulation are: by the half-spaces, and by the box that [`container`](PeriodicTriangulation::container)
//! makes.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{
    EdgeWithCell, Progress, TellCell, TellFacet, VoronoiAsked, VoronoiCell, VoronoiFacet, nowhere,
};
use crate::periodic::container::Container;
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// Tells Voronoi cells, facets, or both, of all ids and edges, or of ids of which `mask` has an entry that is not 0 and
    /// of edges that have such an end, in any order, when all are computed: what a box and half-spaces leave of them. Cells
    /// are told as [`for_voronoi_cells`](Self::for_voronoi_cells) does, facets as
    /// [`for_voronoi_facets`](Self::for_voronoi_facets) does, by their numbers in the order of [`edges`](Self::edges), and
    /// by these where nothing cuts. The numbers are the same, to the last bit, whatever else is told.
    ///
    /// `clip`: the corners of the box of the least and the greatest coordinates, infinite along axes along which a vector of
    /// the lattice goes, and where it has no face otherwise; none if there is no box. `half_spaces`: rows of an outward normal n
    /// and an offset, the places x with n · x at most the offset; the products of n with all vectors of the lattice, on the
    /// grid, are 0, exactly. So what is left of space repeats as well. Across the vectors it is bounded. The container stays
    /// where it is: sums of derivatives are as in a box that repeats in all directions.
    ///
    /// Rounded: let the box of the container be the least one that has the places of the container up to 1.5 of the reduced vectors
    /// away from the unit cell, along axes across which a face is given between that and its opposite. With h as for
    /// [`MovingTriangulation::voronoi_cells_within`](crate::motion::MovingTriangulation::voronoi_cells_within), of that box, errors
    /// are those of cells in the open, and of facets there. The volumes of all ids add up to that of the container in one period.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{Options, VoronoiCell}, periodic::PeriodicTriangulation};
    ///
    /// // A strip between walls at the heights 0 and 2.
    /// let t = PeriodicTriangulation::<Plane>::new(&[[0.5, 0.5], [7.5, 1.5]], &[[1.0, 0.0]], Options::default())?;
    /// let walls = [[f64::NEG_INFINITY, 0.0], [f64::INFINITY, 2.0]];
    /// let tell = &mut |v, cell: VoronoiCell<_>| {
    ///     assert_eq!((cell.volume, cell.area), (1.0, 4.0));
    ///     assert_eq!(cell.centroid, t.position(v).unwrap());
    /// };
    /// t.for_voronoi(Some(walls.each_ref()), &[], None, &mut |_| true, Some(tell), None)?;
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors [`Error::NotFinite`](crate::Error::NotFinite) and [`Error::OutOfRange`](crate::Error::OutOfRange) for a
    /// corner of the box, a normal or an offset; [`Error::InvalidValue`](crate::Error::InvalidValue) for a face of the box
    /// across an axis along which a vector goes, one that is not above its opposite, a normal that is zero or has a product
    /// with a vector that is not 0, or if what is left is not bounded across the vectors;
    /// [`Error::WrongCount`](crate::Error::WrongCount) for a mask or rows; [`Error::Cancelled`](crate::Error::Cancelled),
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory). Then nothing has been told.
    pub fn for_voronoi(
        &self,
        clip: Option<[&G::Point; 2]>,
        half_spaces: &[f64],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
        tell_cell: TellCell<'_, G::Point>,
        tell_facet: TellFacet<'_, G::Point>,
    ) -> Result<()> {
        mask.map_or(Ok(()), |mask| self.check_vertex_mask(mask.len()))?;
        let container = self.container(clip, half_spaces)?;
        self.for_voronoi_in(container.as_ref(), mask, monitor, tell_cell, tell_facet)
    }

    /// Tells what a container leaves of Voronoi cells and facets, as [`for_voronoi`](Self::for_voronoi) does; the mask has an entry
    /// for each id.
    pub(crate) fn for_voronoi_in(
        &self,
        container: Option<&Container<'_, G>>,
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
        tell_cell: TellCell<'_, G::Point>,
        tell_facet: TellFacet<'_, G::Point>,
    ) -> Result<()> {
        let corners = container.map(|container| container.corners.each_ref());
        let half_spaces = container.map_or(&[][..], |container| container.half_spaces);
        let (images, t) = (&self.inside.images, &self.inside.t);
        let is_wanted = |v: VertexId| mask.is_none_or(|mask| mask[v.index()] != 0);
        let homes = || images.homes().filter(|&(vertex, _)| is_wanted(vertex)).map(|(_, inner)| inner);
        let (mut vertices, mut chosen, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
        let is_shown = |inner: &VertexId| t.corner_at(*inner) == Some(*inner);
        memory::collect(&mut vertices, homes().filter(is_shown))?;
        let n_shown = vertices.len();
        if tell_facet.is_some() {
            for (number, edge) in self.read_edges()?.list.iter().enumerate() {
                if edge.0.iter().any(|&inner| is_wanted(images.of(inner).vertex)) {
                    memory::push(&mut chosen, *edge)?;
                    memory::push(&mut numbers, number)?;
                }
            }
            // Edges are where their first vertices are at home, which may be beyond the mask.
            memory::collect(&mut vertices, chosen.iter().map(|edge: &EdgeWithCell| edge.0[0]))?;
        }
        let region = t.region(corners, half_spaces)?;
        let size = self.lattice.measure().powf(1.0 / self.lattice.rank() as f64);
        let asked = VoronoiAsked {
            around: Some(&vertices),
            vertices: tell_cell.as_ref().map(|_| &vertices[..n_shown]),
            edges: tell_facet.as_ref().map(|_| &chosen[..]),
        };
        let found = t.find_voronoi(region.as_ref(), size, &asked, &mut Progress::new(monitor, 1))?;
        let placed = |inner: VertexId, centroid: &G::Point| match region {
            None => self.at_position(inner, centroid),
            Some(_) => self.at_position_of(inner, centroid),
        };
        if let Some(tell) = tell_cell {
            for inner in homes() {
                let cell = t.found_cell(&found, region.as_ref(), inner);
                tell(
                    images.of(inner).vertex,
                    VoronoiCell { centroid: placed(inner, &cell.centroid), ..cell },
                );
            }
            let none = VoronoiCell { volume: f64::NAN, area: f64::NAN, centroid: nowhere::<G>() };
            let gone = VertexId::range(0..self.id_count()).filter(|&v| is_wanted(v) && !self.is_present(v));
            gone.for_each(|v| tell(v, none));
        }
        if let Some(tell) = tell_facet {
            for (k, number) in numbers.into_iter().enumerate() {
                let facet = found.facet::<G>(k);
                let centroid = placed(chosen[k].0[0], &facet.centroid);
                tell(number, VoronoiFacet { centroid, ..facet });
            }
        }
        Ok(())
    }

    /// What is at a place inside beside a vertex at home, where that vertex is at its position: moved along axes along which
    /// vectors go, so that nothing comes out of a box.
    fn at_position_of(&self, inner: VertexId, place: &G::Point) -> G::Point {
        if self.wraps[self.inside.images.of(inner).vertex] == [0; 3] {
            return *place;
        }
        let (home, mut moved) = (&self.inside.places[inner], *place);
        (0..G::D).for_each(|axis| moved[axis] -= home[axis]);
        moved = self.at_position(inner, &moved);
        for axis in (0..G::D).filter(|&axis| !self.lattice.is_spanned(axis)) {
            moved[axis] = place[axis];
        }
        moved
    }

    pub(crate) fn check_vertex_mask(&self, given: usize) -> Result<()> {
        let wanted = self.id_count();
        if given == wanted {
            return Ok(());
        }
        let coming = self.staged.insertions().len();
        Err(Error::WrongCount { argument: "mask_count", given, wanted, coming })
    }
}

#[cfg(test)]
mod tests;
