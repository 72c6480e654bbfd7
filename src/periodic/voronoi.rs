//! Voronoi cells and facets of a set that repeats.
//!
//! Inside, the cells of each vertex at home are whole, so its Voronoi cell is the one that it has there; those of images
//! are not looked at. What is told of places is so where a vertex is at its own position.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{VoronoiCell, VoronoiFacet};
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// By vertex id the area or volume of its Voronoi cell, as [`for_voronoi_cells`](Self::for_voronoi_cells) tells it.
    /// `monitor` is called now and then, and told the fraction done.
    ///
    /// # Errors
    /// [`Error::Cancelled`](crate::Error::Cancelled) if `monitor` returns `false`,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn voronoi_volumes(&self, monitor: &mut dyn FnMut(f64) -> bool) -> Result<Vec<f64>> {
        let mut volumes = Vec::new();
        memory::lengthen(&mut volumes, self.id_count(), f64::NAN)?;
        self.for_voronoi_cells(None, monitor, &mut |v, cell| volumes[v.index()] = cell.volume)?;
        Ok(volumes)
    }

    /// Tells the Voronoi cell of each id, or of those of which `mask` has an entry that is not 0, in any order, when all are
    /// computed: area or volume, boundary, and the centroid where the vertex is at its position.
    ///
    /// Infinite for cells without an end, NaN for removed and staged vertices; hidden ones have volume and boundary 0. A
    /// centroid is NaN unless the volume is positive and finite.
    ///
    /// Let h be 10⁻⁸ times the greatest circumradius of the cells around the vertex and 10⁻¹⁵ times the greatest magnitude
    /// of their coordinates, in place of 10⁻⁸ some last bits unless they are nearly flat. Then to first order a volume is off
    /// by at most h times the area of the cell's surface, or two thirds of that of the triangles that the vertex makes with
    /// its edges if that is more (an area by h times the length of the boundary), a boundary by h times the sum of the
    /// perimeters of the facets, in the plane 2 h for each, and a centroid, beside the rounding of its coordinates, by the
    /// error of the volume times d / V, with the diameter d of the cell and its volume V.
    ///
    /// ```
    /// use deldrift::{Plane, motion::Options, periodic::PeriodicTriangulation};
    ///
    /// let square = [[1.0, 0.0], [0.0, 1.0]];
    /// let t = PeriodicTriangulation::<Plane>::new(&[[0.5, 7.25]], &square, Options::default())?;
    /// t.for_voronoi_cells(None, &mut |_| true, &mut |_, cell| {
    ///     assert_eq!((cell.volume, cell.area, cell.centroid), (1.0, 4.0, [0.5, 7.25]));
    /// })?;
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Cancelled`](crate::Error::Cancelled) if `monitor` returns `false`,
    /// [`Error::WrongCount`](crate::Error::WrongCount) if the mask has not an entry for each id,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory); then nothing has been told.
    pub fn for_voronoi_cells(
        &self,
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
        tell: &mut dyn FnMut(VertexId, VoronoiCell<G::Point>),
    ) -> Result<()> {
        self.for_voronoi(None, &[], mask, monitor, Some(tell), None)
    }

    /// Tells the Voronoi facet of each edge, or of those that have an end of which `mask` has an entry that is not 0: the
    /// number of the edge in the order of [`edges`](Self::edges), and the facet, its centroid where the edge's first vertex
    /// is at its position. All are computed before.
    ///
    /// Facets without an end have an infinite measure, and NaN for the rest. The derivatives are those by the position of one
    /// end of the edge alone. With all that repeats the derivative of the volume of a cell by the position of another vertex is
    /// the sum over the edges between both; that by its own vertex's is minus the sum, over its edges to other vertices, of the
    /// derivatives of their cells by that position: an edge from a vertex to itself contributes nothing, as the facets at both
    /// of its ends move along, and the cell gains at one what it loses at the other.
    ///
    /// Let h be as for [`for_voronoi_cells`](Self::for_voronoi_cells), of the cells around the edge, P the perimeter of the
    /// facet (in the plane, 2), d its diameter, A its measure, and L the length of its edge. A measure is off by at most h P, a
    /// centroid, beside the rounding of its coordinates, by h P d / A, or by d + h where A is less than 4 h P; a derivative by
    /// h P / L times the sum of d and the distance from the vertex to the centroid.
    ///
    /// # Errors
    /// The errors of [`for_voronoi_cells`](Self::for_voronoi_cells).
    pub fn for_voronoi_facets(
        &self,
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
        tell: &mut dyn FnMut(usize, VoronoiFacet<G::Point>),
    ) -> Result<()> {
        self.for_voronoi(None, &[], mask, monitor, None, Some(tell))
    }
}

#[cfg(test)]
mod tests;
