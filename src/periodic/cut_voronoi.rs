//! Voronoi cells and facets of a set that repeats, cut by a box and half-spaces.
//!
//! Cells inside of vertices at home, and the facets around these, are those of the repeating set, and are cut as those of
//! an open triangulation are: by the half-spaces, and by the box that [`container`](PeriodicTriangulation::container)
//! makes.

use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{VoronoiCell, VoronoiFacet, nowhere};
use crate::periodic::container::Container;
use crate::periodic::lattice::HOME;
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Dimension> PeriodicTriangulation<G> {
    /// Tells what there is of the Voronoi cell of each id in a box and half-spaces, or of those of which `mask` has an entry that
    /// is not 0, in any order, when all are computed: as [`for_voronoi_cells`](Self::for_voronoi_cells) does, and by that where
    /// nothing cuts.
    ///
    /// `clip`: the corners of the box of the least and the greatest coordinates, infinite along axes along which a vector of
    /// the lattice goes, and where it has no face otherwise; none if there is no box. `half_spaces`: rows of an outward normal n
    /// and an offset, the places x with n · x at most the offset; the products of n with all vectors of the lattice, on the
    /// grid, are 0, exactly. So what is left of space repeats as well. Across the vectors it is bounded.
    ///
    /// Rounded: let the box of the container be the least one that has the places of the container up to 1.5 of the reduced vectors
    /// away from the unit cell, along axes across which a face is given between that and its opposite. With h as for
    /// [`MovingTriangulation::voronoi_cells_within`](crate::motion::MovingTriangulation::voronoi_cells_within), of that box, errors
    /// are those of cells in the open. The volumes of all ids add up to that of the container in one period.
    ///
    /// ```
    /// use deldrift::{Plane, motion::Options, periodic::PeriodicTriangulation};
    ///
    /// // A strip between walls at the heights 0 and 2.
    /// let t = PeriodicTriangulation::<Plane>::new(&[[0.5, 0.5], [7.5, 1.5]], &[[1.0, 0.0]], Options::default())?;
    /// let walls = [[f64::NEG_INFINITY, 0.0], [f64::INFINITY, 2.0]];
    /// t.for_voronoi_cells_within(Some(walls.each_ref()), &[], None, &mut |_| true, &mut |v, cell| {
    ///     assert_eq!((cell.volume, cell.area), (1.0, 4.0));
    ///     assert_eq!(cell.centroid, t.position(v).unwrap());
    /// })?;
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`](crate::Error::NotFinite) and [`Error::OutOfRange`](crate::Error::OutOfRange) for a corner of the box, a
    /// normal or an offset; [`Error::InvalidValue`](crate::Error::InvalidValue) for a face of the box across an axis along which a
    /// vector goes, one that is not above its opposite, a normal that is zero or has a product with a vector that is not 0, or if
    /// what is left is not bounded across the vectors; [`Error::WrongCount`](crate::Error::WrongCount) for a mask or rows;
    /// [`Error::Cancelled`](crate::Error::Cancelled), [`Error::OutOfMemory`](crate::Error::OutOfMemory). Then nothing has been told.
    pub fn for_voronoi_cells_within(
        &self,
        clip: Option<[&G::Point; 2]>,
        half_spaces: &[f64],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
        tell: &mut dyn FnMut(VertexId, VoronoiCell<G::Point>),
    ) -> Result<()> {
        mask.map_or(Ok(()), |mask| self.check_vertex_mask(mask.len()))?;
        let container = self.container(clip, half_spaces)?;
        self.for_voronoi_cells_in(container.as_ref(), mask, monitor, tell)
    }

    /// Tells what a container leaves of Voronoi cells, as [`for_voronoi_cells_within`](Self::for_voronoi_cells_within) does; the
    /// mask has an entry for each id.
    pub(crate) fn for_voronoi_cells_in(
        &self,
        container: Option<&Container<'_, G>>,
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
        tell: &mut dyn FnMut(VertexId, VoronoiCell<G::Point>),
    ) -> Result<()> {
        let Some(&Container { corners: [low, high], half_spaces }) = container else {
            return self.for_voronoi_cells(mask, monitor, tell);
        };
        let (images, t) = (self.inside.images.as_slice(), &self.inside.t);
        let is_wanted = |v: VertexId| mask.is_none_or(|mask| mask[v.index()] != 0);
        let mut inside = Vec::new();
        memory::lengthen(&mut inside, t.id_count(), 0)?;
        for (entry, image) in inside.iter_mut().zip(images) {
            *entry = u8::from(image.shift == HOME && is_wanted(image.vertex));
        }
        t.for_voronoi_cells([&low, &high], half_spaces, Some(&inside), monitor, &mut |inner, mut cell| {
            cell.centroid = self.at_position_of(inner, &cell.centroid);
            tell(images[inner].vertex, cell);
        })?;
        for v in VertexId::range(0..self.id_count()).filter(|&v| is_wanted(v) && !self.is_present(v)) {
            tell(v, VoronoiCell { volume: f64::NAN, area: f64::NAN, centroid: nowhere::<G>() });
        }
        Ok(())
    }

    /// By vertex id, what there is of the area or volume of its Voronoi cell in a box, as
    /// [`for_voronoi_cells_within`](Self::for_voronoi_cells_within) tells it.
    ///
    /// # Errors
    /// Those of [`for_voronoi_cells_within`](Self::for_voronoi_cells_within).
    pub fn voronoi_volumes_within(
        &self,
        clip: Option<[&G::Point; 2]>,
        half_spaces: &[f64],
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Vec<f64>> {
        let container = self.container(clip, half_spaces)?;
        self.voronoi_volumes_in(container.as_ref(), monitor)
    }

    /// By vertex id, what a container leaves of the area or volume of its Voronoi cell.
    pub(crate) fn voronoi_volumes_in(
        &self,
        container: Option<&Container<'_, G>>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Vec<f64>> {
        let mut volumes = Vec::new();
        memory::lengthen(&mut volumes, self.id_count(), f64::NAN)?;
        self.for_voronoi_cells_in(container, None, monitor, &mut |v, cell| {
            volumes[v.index()] = cell.volume;
        })?;
        Ok(volumes)
    }

    /// Tells what there is of the Voronoi facet of each edge in a box and half-spaces, given as for
    /// [`for_voronoi_cells_within`](Self::for_voronoi_cells_within), or of those edges that have an end of which `mask` has an entry
    /// that is not 0: the number of the edge in the order of [`edges`](Self::edges), and the facet, as
    /// [`for_voronoi_facets`](Self::for_voronoi_facets) does, and by that where nothing cuts. All are computed before.
    ///
    /// The container stays where it is: sums of derivatives are as in a box that repeats in all directions.
    ///
    /// With the h of [`for_voronoi_cells_within`](Self::for_voronoi_cells_within) errors are those of
    /// [`MovingTriangulation::voronoi_derivatives_within`](crate::motion::MovingTriangulation::voronoi_derivatives_within).
    ///
    /// # Errors
    /// Those of [`for_voronoi_cells_within`](Self::for_voronoi_cells_within).
    pub fn for_voronoi_facets_within(
        &self,
        clip: Option<[&G::Point; 2]>,
        half_spaces: &[f64],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
        tell: &mut dyn FnMut(usize, VoronoiFacet<G::Point>),
    ) -> Result<()> {
        mask.map_or(Ok(()), |mask| self.check_vertex_mask(mask.len()))?;
        let container = self.container(clip, half_spaces)?;
        self.for_voronoi_facets_in(container.as_ref(), mask, monitor, tell)
    }

    /// Tells what a container leaves of Voronoi facets, as [`for_voronoi_facets_within`](Self::for_voronoi_facets_within) does; the
    /// mask has an entry for each id.
    pub(crate) fn for_voronoi_facets_in(
        &self,
        container: Option<&Container<'_, G>>,
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
        tell: &mut dyn FnMut(usize, VoronoiFacet<G::Point>),
    ) -> Result<()> {
        let Some(&Container { corners: [low, high], half_spaces }) = container else {
            return self.for_voronoi_facets(mask, monitor, tell);
        };
        let (all, images) = (&self.read_edges()?.list, &self.inside.images);
        let (mut chosen, mut numbers) = (Vec::new(), Vec::new());
        for (number, edge) in all.iter().enumerate() {
            let is_wanted =
                |mask: &[u8]| edge.0.iter().any(|&inner| mask[images.of(inner).vertex.index()] != 0);
            if mask.is_none_or(is_wanted) {
                memory::push(&mut chosen, *edge)?;
                memory::push(&mut numbers, number)?;
            }
        }
        let t = &self.inside.t;
        t.for_cut_voronoi_facets(&chosen, [&low, &high], half_spaces, monitor, &mut |k, mut facet| {
            facet.centroid = self.at_position_of(chosen[k].0[0], &facet.centroid);
            tell(numbers[k], facet);
        })
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
}

#[cfg(test)]
mod tests;
