//! Voronoi cells and facets, clipped by a box.

use super::fence;
use super::pointers::{self, Room, copy_out};
use super::status::{Failure, deldrift_status};
use super::triangulation::{deldrift_triangulation, in_its_dimension};
use crate::delaunay::Dimension;
use crate::motion::MovingTriangulation;

/// The areas (2D) or volumes (3D) of the Voronoi cells of all ids, within a box.
///
/// low, high: the corners of the box with the least and the greatest coordinates, 2 or 3 numbers each, read during the
/// call only; vertices may be outside of it. NULL for both is no box: then the Voronoi cells of the vertices on the
/// convex hull are infinite. volumes: a buffer with room for capacity numbers. A removed vertex has NaN, a hidden one
/// 0; while there are no cells, all have NaN. count: receives the number of ids, which is also written when the buffer
/// is too small. NULL for volumes with capacity 0 asks for the count alone.
///
/// Rounded: as accurate as the circumcentres of the cells around a vertex (see deldrift_circumcentres) allow, and
/// never negative by more than that. The volumes of all ids add up to that of the box but for rounding.
///
/// Takes some passes over the cells, and memory for circumcentres and for the cells of each vertex while it runs; the
/// Voronoi cells at the boundary of the box take a microsecond (2D) or some (3D) each.
///
/// Cost: n + m, and in a box d² at most for the d neighbours of each vertex whose Voronoi cell is at its boundary.
///
/// Errors: DELDRIFT_NULL_ARGUMENT (also if one of low and high is NULL), DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE if high is not above low in every coordinate,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY. After a change the first call also does what the first
/// deldrift_cells does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_voronoi_volumes(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    volumes: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    // SAFETY: the header's conditions on pointers.
    unsafe {
        fence::read(t, |kernel| {
            in_its_dimension!(kernel, t => {
                let clip = clip_for(t, low, high)?;
                copy_out(Room { capacity, count }, t.id_count(), &[("volumes", volumes.cast())], || {
                    pointers::buffer("volumes", volumes, t.id_count())?;
                    pointers::fill("volumes", volumes, &t.voronoi_volumes(clip)?)
                })
            })
        })
    }
}

/// The lengths (2D) or areas (3D) of the Voronoi facets of all edges, in the order of deldrift_edges, within a box.
/// The Voronoi facet of an edge is what the Voronoi cells of its two vertices share.
///
/// low, high: as for deldrift_voronoi_volumes. Without a box, the Voronoi facets of the edges on the convex hull are
/// infinite. measures: a buffer with room for capacity numbers. count: receives the number of edges, which is also
/// written when the buffer is too small. NULL for measures with capacity 0 asks for the count alone.
///
/// Rounded, and never negative; 0 for facets outside the box, and between the vertices of cocircular or cospherical
/// cells. Takes some passes over the cells, and memory for circumcentres and for the cells of each vertex while it
/// runs.
///
/// Cost: n + m, and in a box d² at most for the d neighbours of each vertex whose Voronoi cell is at its boundary.
///
/// Errors: as deldrift_voronoi_volumes: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_voronoi_facets(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    measures: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    // SAFETY: the header's conditions on pointers.
    unsafe {
        fence::read(t, |kernel| {
            in_its_dimension!(kernel, t => {
                let clip = clip_for(t, low, high)?;
                copy_out(Room { capacity, count }, t.edge_count(), &[("measures", measures.cast())], || {
                    pointers::buffer("measures", measures, t.edge_count())?;
                    pointers::fill("measures", measures, &t.voronoi_facets(clip)?)
                })
            })
        })
    }
}

/// The corners of a box that is a good one, in the dimension of `t`; none if both are NULL.
///
/// # Safety
/// The header's conditions on pointers.
unsafe fn clip_for<'a, G: Dimension>(
    t: &MovingTriangulation<G>,
    low: *const f64,
    high: *const f64,
) -> Result<Option<[&'a G::Point; 2]>, Failure> {
    if low.is_null() && high.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller's promise.
    let clip =
        unsafe { [pointers::reference("low", low.cast())?, pointers::reference("high", high.cast())?] };
    t.check_clip(clip)?;
    Ok(Some(clip))
}
