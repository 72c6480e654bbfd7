//! What a triangulation holds: counts, and the positions of vertices.

use super::geometry::cell_count_of;
use super::handle::{Reading, deldrift_triangulation, in_any, tell_any};
use super::pointers::{Buffer, Output, given};
use super::status::deldrift_status;
use crate::ids::VertexId;
use crate::predicates::{Coordinates, PointArray};

/// How many vertices are present, hidden ones included and removed ones not, to *count.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_vertex_count(
    t: *const deldrift_triangulation,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, count: Output);
    tell_any!(t, count => t.vertex_count())
}

/// How many ids there are, to *count: those given so far, or left by the latest deldrift_compact and given since. All
/// valid ids are below it, those of removed vertices and of staged insertions too.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_id_count(
    t: *const deldrift_triangulation,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, count: Output);
    tell_any!(t, count => t.id_count())
}

/// How many cells there are, to *count.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_cell_count(
    t: *const deldrift_triangulation,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, count: Output);
    t.tell_any(count, |t| Ok(cell_count_of(t)?))
}

/// How many moves are staged for the next timestamp, to *count.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_staged_count(
    t: *const deldrift_triangulation,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, count: Output);
    tell_any!(t, count => t.staged_count())
}

/// How many bytes of memory the triangulation holds, to *bytes. What its views show is included, and so is what it
/// keeps as room for later calls; what the system's allocator adds to each array is not. The number may grow in any
/// call on the triangulation, also in one that fails, and in one that takes it as const (deldrift_cells makes arrays).
/// deldrift_compact makes it as small as that of a fresh triangulation, but for arrays that are made again when asked
/// for.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_memory_bytes(
    t: *const deldrift_triangulation,
    bytes: *mut usize,
) -> deldrift_status {
    given!(t: Reading, bytes: Output);
    tell_any!(t, bytes => size_of::<deldrift_triangulation>() + t.memory_bytes())
}

/// The number of the current timestamp, to *timestamp. It is 0 at creation, and one more after each commit.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_timestamp(
    t: *const deldrift_triangulation,
    timestamp: *mut u64,
) -> deldrift_status {
    given!(t: Reading, timestamp: Output);
    tell_any!(t, timestamp => t.timestamp())
}

/// Whether a vertex of this id is present, to *present. It is not if it has been removed, or never was, or if only its
/// insertion is staged. It is if only its removal is staged.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_is_present(
    t: *const deldrift_triangulation,
    vertex: u32,
    present: *mut bool,
) -> deldrift_status {
    given!(t: Reading, present: Output);
    tell_any!(t, present => t.is_present(VertexId::new(vertex)))
}

/// The position of a vertex at the current timestamp, not a staged one, to position.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_position(
    t: *const deldrift_triangulation,
    vertex: u32,
    position: *mut f64,
) -> deldrift_status {
    given!(t: Reading);
    t.read_any(|t| {
        in_any!(t => {
            let position = position.cast();
            given!(position: Output);
            let place = position.place()?;
            place.write(t.position(VertexId::new(vertex))?.coordinates());
        });
        Ok(())
    })
}

/// The positions of all ids, in their order. Present vertices have the positions of the current timestamp, vertices
/// whose insertion is staged those where they will be inserted, and removed vertices NaN. So the array can be changed
/// and handed to deldrift_commit_positions.
///
/// positions: a buffer with room for capacity points. count: receives the number of ids.
///
/// Cost: n.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_copy_positions(
    t: *const deldrift_triangulation,
    positions: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, count: Output);
    t.read_any(|t| {
        in_any!(t => {
            let positions = positions.cast();
            given!(positions[capacity]: Buffer);
            let n = t.id_count();
            positions.fill(count, n, || Ok(VertexId::range(0..n).map(|vertex| or_nan(t.position_or_goal(vertex)))))
        })
    })
}

/// The position of a vertex, or where it will be inserted, NaN if it has been removed.
fn or_nan<P: Coordinates>(position: Option<P>) -> P::Place {
    let position = position.unwrap_or_else(|| {
        let mut nowhere = P::default();
        (0..nowhere.as_ref().len()).for_each(|axis| nowhere[axis] = f64::NAN);
        nowhere
    });
    position.coordinates()
}
