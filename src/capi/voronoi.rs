//! Voronoi cells and facets, clipped by a box.

use super::handle::{Content, Reading, deldrift_triangulation};
use super::pointers::{Buffer, Output, Point, given};
use super::status::{Failure, deldrift_status};
use crate::delaunay::Dimension;
use crate::in_its_dimension;
use crate::motion::MovingTriangulation;

/// The areas (2D) or volumes (3D) of the Voronoi cells of all ids, within a box.
///
/// low, high: the corners of the box with the least and the greatest coordinates, 2 or 3 numbers each, read during the
/// call only; vertices may be outside of it. NULL for both is no box: then the Voronoi cells of the vertices on the
/// convex hull are infinite. volumes: a buffer with room for capacity numbers. count: receives the number of ids, which
/// is also written when the buffer is too small. NULL for volumes with capacity 0 asks for the count alone.
///
/// A removed vertex has NaN, and nothing else has. A hidden vertex has 0: the one of lowest id at its place has the
/// cell. Vertices in one hyperplane, a single one included, have cells too, though deldrift_cells has none: in a box
/// what of it is nearest to each; without one these are infinite. What is beyond the range of numbers, or has a corner
/// there, is infinite.
///
/// Rounded: in a box, let h be 1e-8 times its greatest extent and 1e-15 times the greatest magnitude of its
/// coordinates; without a box, 1e-8 times the greatest circumradius of the cells around the vertex and 1e-15 times the
/// greatest magnitude of a coordinate of their circumcentres. A corner of a Voronoi cell is off by at most h, and so is
/// a volume by at most h times the area of the cell's surface, an area by at most h times its perimeter, however near
/// to each other vertices are. In place of 1e-8 it is some last bits, about 1e-15, unless cells are nearly flat (see
/// deldrift_circumcentres). Never negative. The volumes of all ids add up to that of the box but for rounding.
///
/// Takes time in proportion to the number of cells, and of ids; in a box, for Voronoi cells at its boundary, to the
/// number of corners of their facets as well, a microsecond (2D) or some (3D) for each such cell of ordinary sets.
/// Where a circumcentre nearly is in a face of the box, microseconds for each, as that is decided exactly. Takes memory
/// for circumcentres and for the cells of each vertex while it runs. For vertices in one hyperplane, in a box, it takes
/// the time and the memory of creating a triangulation of these. Calls the callbacks of the options.
///
/// Cost: n + m; in a box, for vertices in one hyperplane, that of deldrift_create. After a change the first call also
/// does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT (also if one of low and high is NULL), DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE if high is not above low in every coordinate,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_voronoi_volumes(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    volumes: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, low: Point, high: Point, volumes[capacity]: Buffer, count: Output);
    t.read_any_watched(|t, monitor| {
        let t = match t {
            Content::Open(t) => t,
            Content::Periodic(_) if !(low.is_null() && high.is_null()) => return Err(Failure::Clipped),
            Content::Periodic(t) => {
                return volumes.fill(count, t.id_count(), || Ok(t.voronoi_volumes(monitor)?));
            }
        };
        in_its_dimension!(t => {
            let clip = clip_for(t, low, high)?;
            volumes.fill(count, t.id_count(), || Ok(t.voronoi_volumes_monitored(clip, monitor)?))
        })
    })
}

/// The lengths (2D) or areas (3D) of the Voronoi facets of all edges, in the order of deldrift_edges, within a box.
/// The Voronoi facet of an edge is what the Voronoi cells of its two vertices share.
///
/// low, high: the corners of the box with the least and the greatest coordinates, 2 or 3 numbers each, read during the
/// call only; vertices may be outside of it. NULL for both is no box. Without a box, the Voronoi facets of the edges on
/// the convex hull are infinite. measures: a buffer with room for capacity numbers. count: receives the number of
/// edges, which is also written when the buffer is too small. NULL for measures with capacity 0 asks for the count
/// alone.
///
/// There is one number for each edge of the triangulation, so vertices in one hyperplane have none; each is the measure
/// of what both cells share, whichever of the two it is seen from. It is never NaN, and infinite where a corner is
/// beyond the range of numbers. Of vertices on an empty circle or sphere some share an edge only as ties are broken by
/// id: their Voronoi facet is a point, or in space may be a segment, and has 0 but for rounding; others, which have no
/// edge, share no more than that. A facet outside the box has 0. One that is in a face of the box counts as inside.
///
/// Rounded: with the h that deldrift_voronoi_volumes has, of the cells around the edge, a length is off by at most 2 h,
/// an area by at most h times the perimeter of the facet, however near to each other vertices are. Never negative. The
/// facets of a vertex whose Voronoi cell is in the box, times the lengths of its edges and divided by 4 (2D) or 6 (3D),
/// add up to its area or volume but for rounding.
///
/// Takes time in proportion to the number of cells, and memory for circumcentres and for the cells of each vertex while
/// it runs. What is cut by the box, and is nearly in a face of it, takes as long as in deldrift_voronoi_volumes. Calls
/// the callbacks of the options.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_NULL_ARGUMENT (also if one of low and high is NULL), DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_voronoi_facets(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    measures: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, low: Point, high: Point, measures[capacity]: Buffer, count: Output);
    t.read_watched(|t, monitor| {
        in_its_dimension!(t => {
            let clip = clip_for(t, low, high)?;
            measures.fill(count, t.edge_count(), || Ok(t.voronoi_facets_monitored(clip, monitor)?))
        })
    })
}

/// The corners of a box that is a good one, in the dimension of `t`; none if both are NULL.
fn clip_for<'a, G: Dimension>(
    t: &MovingTriangulation<G>,
    low: Point<'a>,
    high: Point<'a>,
) -> Result<Option<[&'a G::Point; 2]>, Failure> {
    if low.is_null() && high.is_null() {
        return Ok(None);
    }
    let clip = [low.of("low", t)?, high.of("high", t)?];
    t.check_clip(clip)?;
    Ok(Some(clip))
}
