//! Changes that take effect at once, one vertex at a time; and new ids.

use super::handle::{Changing, deldrift_triangulation, in_any, in_weighted};
use super::pointers::{Buffer, Output, Point, fit, given, write_all};
use super::status::deldrift_status;
use crate::ids::VertexId;
use crate::in_its_dimension;
use crate::motion::PointPart;

/// Moves one vertex at once. When the call returns the triangulation is that of the new position. The timestamp stays,
/// and so do the moves staged for other vertices.
///
/// Cost: at most that of a removal and an insertion: of the cells around the vertex before and after, which can be
/// many. While there are no cells, that of deldrift_create. In a periodic triangulation that of a commit of this one
/// move.
///
/// Errors: DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_DUPLICATE_MOVE if a move
/// of this vertex is staged, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject
/// it), DELDRIFT_CROSSING, DELDRIFT_ON_SEGMENT, DELDRIFT_ENDS_MEET, DELDRIFT_PASSES_SEGMENT (if the options refuse it),
/// DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_relocate_vertex(
    t: *mut deldrift_triangulation,
    vertex: u32,
    position: *const f64,
) -> deldrift_status {
    given!(t: Changing, position: Point);
    let vertex = VertexId::new(vertex);
    let is_done = t.change_shortly(|t| {
        in_its_dimension!(t => {
            position.of("position", t).is_ok_and(|position| t.relocate_within_tolerance(vertex, &position))
        })
    });
    if is_done { deldrift_status::DELDRIFT_OK } else { relocate_in_guard(t, vertex, position) }
}

/// The long way of [`deldrift_relocate_vertex`], kept out of the short one's registers.
#[inline(never)]
fn relocate_in_guard(t: Changing<'_>, vertex: VertexId, position: Point<'_>) -> deldrift_status {
    t.change_any(|t| {
        if t.is_weighted() {
            return in_weighted!(t => {
                Ok(t.relocate_part(PointPart::Place, vertex, position.place("position", t)?)?)
            });
        }
        in_any!(t => Ok(t.relocate_vertex(vertex, &position.of("position", t)?)?))
    })
}

/// Inserts a vertex at once.
///
/// out_vertex: receives its id, which is one above the highest ever given, or left by the latest deldrift_compact.
///
/// Cost: that of deldrift_locate, and the cells created and removed. In a periodic triangulation that of a commit of
/// one insertion.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject it),
/// DELDRIFT_ON_SEGMENT, DELDRIFT_STAGED_VERTEX (if t is periodic and insertions are staged, which have the next ids),
/// DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_insert_vertex(
    t: *mut deldrift_triangulation,
    position: *const f64,
    out_vertex: *mut u32,
) -> deldrift_status {
    given!(t: Changing, position: Point, out_vertex: Output);
    t.change_any(|t| {
        let out_vertex = out_vertex.place()?;
        out_vertex.write(in_any!(t => t.insert_vertex(&position.of("position", t)?))?.get());
        Ok(())
    })
}

/// Removes a vertex at once, with the move or the removal staged for it, if any. deldrift_compact frees its id and the
/// rest of its memory; deldrift_stage_insertions_at_free_ids gives the id again.
///
/// Cost: with up to 64 neighbours at most the square of their number, with more a build of the neighbours alone. In 3D
/// that may have as many cells as half the square of their number, as where all points are on the moment curve;
/// callbacks are called for each ten to twenty thousand of them. In a periodic triangulation that of a commit of one
/// removal.
///
/// Errors: DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_END_REMOVED for an end of
/// a segment in force, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_remove_vertex(
    t: *mut deldrift_triangulation,
    vertex: u32,
) -> deldrift_status {
    given!(t: Changing);
    t.change_any(|t| Ok(in_any!(t => t.remove_vertex(VertexId::new(vertex)))?))
}

/// Frees the memory that has served removed vertices, and gives the others new ids. These are 0, 1, ... in the order of
/// the ids that they have. Ties are broken by keys, or the order of ids, so the cells stay the same, with their indices
/// in deldrift_cells. So do positions, staged moves, the ids of segments and the timestamp. Memory and the time of
/// commits are those of a fresh triangulation then.
///
/// map: receives the new id of each old one, DELDRIFT_NONE for removed vertices: a buffer with room for capacity ids;
/// NULL with capacity 0 if it is not wanted. Vertices whose insertion is staged get new ids as well. count: receives
/// the number of old ids (deldrift_id_count before the call); if there is no room for as many, nothing has been
/// compacted.
///
/// Takes no longer than a rebuild, and while it runs the memory of a second triangulation. A periodic triangulation is
/// built anew, if vertices have been removed: its cells stay, and may have other indices.
///
/// Cost: n + m; of a periodic triangulation that of creation.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY; if t is periodic, DELDRIFT_CANCELLED, DELDRIFT_TOO_MANY_CELLS.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_compact(
    t: *mut deldrift_triangulation,
    map: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Changing, map[capacity]: Buffer, count: Output);
    t.change_any(|t| {
        in_any!(t => {
            let needed = t.id_count();
            let fitting = fit(count, needed, capacity, &[map.offer()])?;
            // Looked at before anything changes.
            let places = map.places_if_any(needed)?;
            write_all(places, t.compact()?.into_iter().map(VertexId::get));
            fitting.tell();
        });
        Ok(())
    })
}
