//! Volumes, boundaries and centroids of the Voronoi cells of ids, in a box and half-spaces.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::motion::reading::geometry::clipping::{Clip, in_space, minus};
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

impl<G: Moving> MovingTriangulation<G> {
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
pub(crate) fn nowhere<G: Moving>() -> G::Point {
    let mut nowhere = G::Point::default();
    (0..G::D).for_each(|axis| nowhere[axis] = f64::NAN);
    nowhere
}

/// What the sums of a vertex at this place say.
pub(super) fn cell_of<G: Moving>(clip: &Clip, place: &G::Point, target: &Target) -> VoronoiCell<G::Point> {
    let sums = &target.sums;
    let [of_volume, of_facets, of_moment] = target.factors::<G>();
    let volume = of_volume * sums.volume;
    // What is left of negative parts by rounding may be negative.
    let measured = clip.measure_in(G::D, volume).max(0.0);
    let mut centroid = nowhere::<G>();
    if measured > 0.0 {
        let place = in_space::<G>(place);
        // Pieces are seen from the vertex, which with weights may be outside of the box though its cell is not.
        let is_outside = G::HAS_WEIGHTS && !target.is_cut;
        let apex = if is_outside { minus(&place, clip.low()) } else { clip.offset_within(&place) };
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
