//! What is near a place: the nearest vertices, those in a ball or a box, the cells that a new vertex would remove.

use super::handle::{Reading, deldrift_triangulation, in_any};
use super::interpolation::check_product;
use super::location::{deldrift_location, hint_at};
use super::pointers::{Buffer, Input, Output, Point, Points, given, write_all};
use super::status::deldrift_status;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;

/// The k vertices nearest to each of count positions: rows of k ids, by distance and, at the same distance, by id, or by key
/// where vertices have keys;
/// DELDRIFT_NONE where there are fewer vertices than k. Distances are compared exactly. Hidden vertices count like
/// others.
///
/// positions: 2 or 3 numbers each, read during the call only; NULL if count is 0. vertices: receives count rows of k
/// ids; may be NULL if there are none.
///
/// It is fastest if each position is near the one before it. The first id of a row is that of deldrift_nearest_vertex.
///
/// In a periodic triangulation positions may be in any period, and are rounded as for deldrift_locate. Each vertex comes
/// once, by the distance of its nearest image (the minimum image); images farther away do not count.
///
/// Cost: count times that of deldrift_nearest_vertex, the stars of the k vertices, and k log k; with k = 0 constant.
/// While there are no cells, count times n; n more in a periodic triangulation with hidden vertices.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY; then nothing is written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_nearest_vertices(
    t: *const deldrift_triangulation,
    positions: *const f64,
    count: usize,
    k: usize,
    vertices: *mut u32,
) -> deldrift_status {
    let n_found = count.saturating_mul(k);
    given!(t: Reading, positions[count]: Points, vertices[n_found]: Buffer);
    t.read_any(|t| {
        in_any!(t => {
            let positions = positions.of(t)?;
            check_product::<u32>("vertices", count, k)?;
            let places = vertices.places(n_found)?;
            let mut made = Vec::new();
            memory::reserve_exact(&mut made, n_found)?;
            t.nearest_vertices(positions, k, |vertex| made.push(vertex.get()))?;
            write_all(places, made);
            Ok(())
        })
    })
}

/// The vertices in a closed ball, ascending by id, hidden ones included: those whose squared distance from centre is at
/// most squared_radius. Exact.
///
/// centre: 2 or 3 numbers. squared_radius: 0 or more; infinity is all vertices. vertices: a buffer with room for
/// capacity ids; deldrift_vertex_count is always enough. count: receives their number, which is also written when the
/// buffer is too small. NULL with capacity 0 asks for the count alone, which takes as long.
///
/// In a periodic triangulation the centre may be in any period, and is rounded as for deldrift_locate. A vertex is in the
/// ball if any image of it is; each is told once. The ball may be larger than the box.
///
/// Cost: that of deldrift_nearest_vertex, the stars of the vertices in the ball, and k log k for the k of them; n log n
/// at most but for the former. While there are no cells, and in a periodic triangulation with hidden vertices, n.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_INVALID_VALUE for a squared radius that is negative or NaN, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_vertices_in_ball(
    t: *const deldrift_triangulation,
    centre: *const f64,
    squared_radius: f64,
    vertices: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, centre: Point, vertices[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        in_any!(t => {
            let found = t.vertices_in_ball(centre.of("centre", t)?, squared_radius)?;
            vertices.fill(count, found.len(), || Ok(found.into_iter().map(VertexId::get)))
        })
    })
}

/// The vertices in a closed box, ascending by id, hidden ones included: those of which each coordinate is at least that
/// of low and at most that of high.
///
/// low, high: 2 or 3 numbers each, which may be infinite. Where one of low is above that of high there are none.
/// vertices: a buffer with room for capacity ids; deldrift_vertex_count is always enough. count: receives their number,
/// which is also written when the buffer is too small. NULL with capacity 0 asks for the count alone, which takes as
/// long.
///
/// In a periodic triangulation a vertex is in the box if any image of it is; each is told once. The box is not rounded, and may
/// be larger than the period; one that is 10^20 periods away is refused. Where vectors go along several axes, as in a skewed
/// box, one that is thousands of periods long, or infinite, along some of these has to be as wide as all these vectors together
/// along each, or infinite along all but one.
///
/// Cost: that of deldrift_locate, the cells whose bounding boxes meet the box, the facets of the hull that are seen
/// from it, and k log k for the k vertices in it; n log n at most but for the first. While there are no cells, n. In a
/// periodic triangulation that of deldrift_vertices_in_ball where the box is shorter than half of the shortest vector, else n;
/// and, where vectors go along several axes, the periods that the box meets, for each vertex.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_INVALID_VALUE for NaN, or for a box that is too long,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_vertices_in_box(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    vertices: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, low: Point, high: Point, vertices[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        in_any!(t => {
            let found = t.vertices_in_box(low.of("low", t)?, high.of("high", t)?)?;
            vertices.fill(count, found.len(), || Ok(found.into_iter().map(VertexId::get)))
        })
    })
}

/// The cells that the insertion of a vertex at a position would remove, in no particular order: those whose circle or
/// sphere has the position inside, exactly, with ties broken as for a vertex of the highest id. At the place of a
/// vertex, and while there are no cells, there are none.
///
/// position: 2 or 3 numbers. hint: where to begin to look for it, as for deldrift_locate_points; NULL if nothing is
/// known. cells: a buffer with room for capacity indices. count: receives their number, which is also written when the
/// buffer is too small. NULL with capacity 0 asks for the count alone, which takes as long.
///
/// A position outside the convex hull may be in the circle or sphere of no cell: then the insertion removes none, and
/// joins the vertex to the facets of the hull that it sees.
///
/// In a periodic triangulation the position may be in any period, and is rounded as for deldrift_locate. A cell is told, once,
/// if a translation of it is in conflict: it would be removed by the insertion of the vertex with all of its images. A position
/// outside the convex hull is refused, as facets without an end are seen from there.
///
/// Cost: that of deldrift_locate, the cells found, and the facets of the hull that are seen from the position. After a
/// change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_PERIODIC outside the hull of a periodic triangulation, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_conflicts(
    t: *const deldrift_triangulation,
    position: *const f64,
    hint: *const deldrift_location,
    cells: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let hint = hint.cast();
    given!(t: Reading, position: Point, hint: Input, cells[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        in_any!(t => {
            let found = t.conflicts(position.of("position", t)?, hint_at(hint)?)?;
            cells.fill(count, found.len(), || Ok(found.into_iter().map(CellId::get)))
        })
    })
}
