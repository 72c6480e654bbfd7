//! All numbers of Voronoi cells, or of facets, as lists.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::reading::geometry::dual_cells::{VoronoiCell, VoronoiCells, nowhere};
use crate::motion::reading::geometry::dual_facets::{VoronoiFacet, VoronoiFacets, of_space};
use crate::motion::triangulation::MovingTriangulation;

impl<G: Moving> MovingTriangulation<G> {
    /// Areas or volumes, boundaries and centroids of the Voronoi cells of all ids within the box from `low` to `high`,
    /// or of those of which `mask` has an entry that is not 0.
    ///
    /// Rounded: let h be 10⁻⁸ times the greatest extent of the box and 10⁻¹⁵ times the greatest magnitude of its
    /// coordinates. To first order in h, a volume is off by at most h times the area of the cell's surface or two
    /// thirds of that of the triangles that the vertex makes with its edges, whichever is more (an area, by h times the
    /// length of the boundary), an area by h times the sum of the perimeters of its facets, and a centroid by the error
    /// of the volume times d / V, where d is the diameter of the cell and V its volume.
    /// With weights these are power cells, of which a vertex may be outside. Then a volume is off by two thirds of the
    /// area of these triangles times h (an area, by half of the sum of the distances of the corners from the vertex),
    /// and d is at least the greatest distance of a corner from the vertex; of a cell that the box cuts, in place of
    /// the vertex take what is nearest to it in the box. In place of 10⁻⁸ it is some last bits unless cells are nearly
    /// flat. The volumes of all ids add up to that of the box.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let cells = t.voronoi_cells([&[0.0, 0.0], &[1.0, 1.0]], None, &mut |_| true)?;
    /// assert_eq!(cells.volumes, [0.25; 4]);
    /// assert_eq!(cells.areas, [2.0; 4]);
    /// assert_eq!(cells.centroids[3], [0.75, 0.75]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Cancelled`](crate::Error::Cancelled) if `monitor`, which is told the fraction done now and then, returns
    /// `false`; [`NotFinite`](crate::Error::NotFinite), [`OutOfRange`](crate::Error::OutOfRange) and
    /// [`InvalidValue`](crate::Error::InvalidValue) for the box; [`WrongCount`](crate::Error::WrongCount) if the mask has
    /// not an entry for each id; [`OutOfMemory`](crate::Error::OutOfMemory).
    pub fn voronoi_cells(
        &self,
        clip: [&G::Point; 2],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<VoronoiCells<G::Point>> {
        self.voronoi_cells_within(clip, &[], mask, monitor)
    }

    /// The [`voronoi_cells`](Self::voronoi_cells) within a box and half-spaces, of which there is a row each of an
    /// outward normal n, of any length but zero, and an offset: the places x with n · x at most the offset. There may be
    /// hundreds.
    ///
    /// Where half-spaces leave nothing of a cell, or of the box, volume and area are 0. Planes are not exact: where
    /// distances of corners from them are less than h, with 3·10⁻¹⁵ in place of 10⁻¹⁵ in it, a corner may be taken as
    /// inside or as beyond. With that h, errors are those of [`voronoi_cells`](Self::voronoi_cells), and an area may be
    /// off by twice a section of the cell that is no thicker than 2 h. The volumes of all ids add up to that of the box
    /// in the half-spaces.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let below = [1.0, 1.0, 1.0]; // x + y is at most 1
    /// let cells = t.voronoi_cells_within([&[0.0, 0.0], &[1.0, 1.0]], &below, None, &mut |_| true)?;
    /// assert_eq!(cells.volumes, [0.25, 0.125, 0.125, 0.0]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`voronoi_cells`](Self::voronoi_cells), also [`NotFinite`](crate::Error::NotFinite) and
    /// [`InvalidValue`](crate::Error::InvalidValue) for a normal that is zero, and
    /// [`WrongCount`](crate::Error::WrongCount) if the numbers do not make up rows.
    pub fn voronoi_cells_within(
        &self,
        clip: [&G::Point; 2],
        half_spaces: &[f64],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<VoronoiCells<G::Point>> {
        let (mut volumes, mut areas, mut centroids) = (Vec::new(), Vec::new(), Vec::new());
        let n_ids = self.id_count();
        memory::lengthen(&mut volumes, n_ids, f64::NAN)?;
        memory::lengthen(&mut areas, n_ids, f64::NAN)?;
        memory::lengthen(&mut centroids, n_ids, nowhere::<G>())?;
        let tell = &mut |v: VertexId, cell: VoronoiCell<G::Point>| {
            volumes[v.index()] = cell.volume;
            areas[v.index()] = cell.area;
            centroids[v.index()] = cell.centroid;
        };
        self.for_voronoi(Some(clip), half_spaces, mask, monitor, Some(tell), None)?;
        Ok(VoronoiCells { volumes, areas, centroids })
    }

    /// The Voronoi facets of all edges within the box from `low` to `high`: measures, centroids, and derivatives of the
    /// areas or volumes on their sides by positions and by weights. With a `mask`, NaN for edges that have no end of
    /// which the entry is not 0.
    ///
    /// The derivative of the volume of a cell by the position of its own vertex is minus the sum of those of its
    /// neighbours by that position; so it is for weights.
    ///
    /// Rounded: with h as for [`voronoi_cells`](Self::voronoi_cells), P the perimeter of a facet (in the plane, 2), d
    /// its diameter, A its measure and L the length of its edge, a measure is off by at most h P, a centroid by
    /// h P d / A, or by d + h where A is less than 4 h P, a derivative by h P / L times the sum of d and the distance
    /// from the vertex to the centroid, one by a weight by h P / 2 L.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let facets = t.voronoi_derivatives([&[-1.0, -1.0], &[2.0, 2.0]], None, &mut |_| true)?;
    /// assert_eq!(facets.areas[0], 1.5); // between vertices 0 and 1: from y = -1 to 1/2
    /// assert_eq!(facets.centroids[0], [0.5, -0.25]);
    /// assert_eq!(facets.derivatives[0][0], [0.75, 0.375]); // by the position of vertex 1
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`voronoi_cells`](Self::voronoi_cells).
    pub fn voronoi_derivatives(
        &self,
        clip: [&G::Point; 2],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<VoronoiFacets<G::Point>> {
        self.voronoi_derivatives_within(clip, &[], mask, monitor)
    }

    /// The [`voronoi_derivatives`](Self::voronoi_derivatives) within a box and half-spaces, rows as
    /// [`voronoi_cells_within`](Self::voronoi_cells_within) has them; box and half-spaces stay where they are.
    ///
    /// With h as there, errors are those of [`voronoi_derivatives`](Self::voronoi_derivatives), but for a facet that a
    /// plane cuts divided by the sine of the angle between both; a facet that is in a plane, but for h, may be there or
    /// not.
    ///
    /// # Errors
    /// The errors of [`voronoi_cells_within`](Self::voronoi_cells_within).
    pub fn voronoi_derivatives_within(
        &self,
        clip: [&G::Point; 2],
        half_spaces: &[f64],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<VoronoiFacets<G::Point>> {
        let nowhere = of_space::<G>(&[f64::NAN; 3]);
        let (mut areas, mut centroids, mut derivatives) = (Vec::new(), Vec::new(), Vec::new());
        let mut weight_derivatives = Vec::new();
        memory::lengthen(&mut areas, self.edge_count(), f64::NAN)?;
        memory::lengthen(&mut weight_derivatives, self.edge_count(), f64::NAN)?;
        memory::lengthen(&mut centroids, self.edge_count(), nowhere)?;
        memory::lengthen(&mut derivatives, self.edge_count(), [nowhere; 2])?;
        let edges = self.edges()?;
        let tell = &mut |edge: usize, facet: VoronoiFacet<G::Point>| {
            areas[edge] = facet.area;
            centroids[edge] = facet.centroid;
            derivatives[edge] = facet.derivatives;
            weight_derivatives[edge] = facet.weight_derivative;
        };
        self.for_voronoi(Some(clip), half_spaces, mask, monitor, None, Some(tell))?;
        Ok(VoronoiFacets { edges, areas, centroids, derivatives, weight_derivatives })
    }
}
