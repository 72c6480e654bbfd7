//! Volumes, boundaries and centroids of the Voronoi cells of ids, in a box and half-spaces.

use crate::delaunay::Dimension;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::reading::geometry::clipping::{Clip, in_space};
use crate::motion::reading::geometry::dual::Target;
use crate::motion::reading::geometry::half_spaces::checked_row;
use crate::motion::triangulation::MovingTriangulation;

/// What there is of the Voronoi cells of all ids in a box. A removed vertex, and one that is left out, has NaN in all
/// three; a hidden one has no volume.
#[derive(Clone, Debug, PartialEq)]
pub struct VoronoiCells<P> {
    /// Areas or volumes.
    pub volumes: Vec<f64>,
    /// Lengths or areas of the boundaries, with what they have of the box's.
    pub areas: Vec<f64>,
    /// Centroids; NaN where the volume is 0.
    pub centroids: Vec<P>,
}

/// What there is of one Voronoi cell in a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoronoiCell<P> {
    /// Area or volume.
    pub volume: f64,
    /// Length or area of the boundary, with what it has of the box's.
    pub area: f64,
    /// Centroid; NaN where the volume is 0.
    pub centroid: P,
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Areas or volumes, boundaries and centroids of the Voronoi cells of all ids within the box from `low` to `high`,
    /// or of those of which `mask` has an entry that is not 0.
    ///
    /// Rounded: let h be 10⁻⁸ times the greatest extent of the box and 10⁻¹⁵ times the greatest magnitude of its
    /// coordinates. To first order in h, a volume is off by at most h times the area of the cell's surface or two
    /// thirds of that of the triangles that the vertex makes with its edges, whichever is more (an area, by h times the
    /// length of the boundary), an area by h times the sum of the perimeters of its facets, and a centroid by the error
    /// of the volume times d / V, where d is the diameter of the cell and V its volume.
    /// In place of 10⁻⁸ it is some last bits unless cells are nearly flat. The volumes of all ids add up to that of the
    /// box.
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
    /// Those of [`voronoi_cells`](Self::voronoi_cells), also [`NotFinite`](crate::Error::NotFinite) and
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

    /// Whether numbers are rows of normals and offsets.
    pub(crate) fn check_half_spaces(&self, rows: &[f64]) -> Result<()> {
        if !rows.len().is_multiple_of(G::D + 1) {
            let (given, wanted) = (rows.len(), rows.len().next_multiple_of(G::D + 1));
            return Err(Error::WrongCount { argument: "half_spaces", given, wanted, coming: 0 });
        }
        rows.chunks(G::D + 1).enumerate().try_for_each(|(index, row)| checked_row::<G>(index, row))
    }
}

/// No place.
pub(crate) fn nowhere<G: Dimension>() -> G::Point {
    let mut nowhere = G::Point::default();
    (0..G::D).for_each(|axis| nowhere[axis] = f64::NAN);
    nowhere
}

/// What the sums of a vertex at this place say.
pub(super) fn cell_of<G: Dimension>(clip: &Clip, place: &G::Point, target: &Target) -> VoronoiCell<G::Point> {
    let sums = &target.sums;
    let [of_volume, of_facets, of_moment] = target.factors::<G>();
    let volume = of_volume * sums.volume;
    // What is left of negative parts by rounding may be negative.
    let measured = clip.measure_in(G::D, volume).max(0.0);
    let mut centroid = nowhere::<G>();
    if measured > 0.0 {
        let apex = clip.offset_within(&in_space::<G>(place));
        for axis in 0..G::D {
            let way = of_moment * sums.moment[axis] / volume / clip.unit;
            let at = clip.low()[axis] + (apex[axis] + way);
            centroid[axis] = at.clamp(clip.low()[axis], clip.high()[axis]);
        }
    }
    VoronoiCell {
        volume: measured,
        area: clip.measure_in(G::D - 1, of_facets * sums.facets + sums.wall).max(0.0),
        centroid,
    }
}
