//! Keys of vertices, which break ties in place of ids, and ids that are given again.

use super::guard;
use super::handle::{Changing, Reading, deldrift_triangulation, in_open};
use super::options::{GivenOptions, deldrift_options};
use super::pointers::{Array, Buffer, Output, Point, Points, given, write_all};
use super::status::deldrift_status;
use super::triangulation::create;
use crate::ids::VertexId;

/// Creates a triangulation, as deldrift_create does, of vertices that have keys.
///
/// A key breaks ties in place of the id. Where points are cocircular or cospherical, the cells are those of the order
/// of keys. Vertices of equal keys are in the order of their positions, by x, then y, then z. Of several vertices at
/// the same place the one of the lowest key, and of those the one of the lowest id, is the corner of cells. So cells
/// follow from positions and keys, and a program may give ids in any order. Images of a vertex in a periodic box, or
/// copies of vertices of other processes, have the key of the vertex. Without a key of its own a vertex has its id for
/// one.
///
/// keys: count of them, in the order of positions, any numbers. NULL stands for the ids. All else is as in
/// deldrift_create. Keys take 8 bytes for each id, and deldrift_compact leaves them as they are. Vertices that
/// deldrift_refine and deldrift_stage_splits make have the greatest key, 2^64 - 1.
///
/// Cost: that of deldrift_create.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_INVALID_OPTIONS, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_create_with_keys(
    dimension: u32,
    positions: *const f64,
    keys: *const u64,
    count: usize,
    options: *const deldrift_options,
    out: *mut *mut deldrift_triangulation,
) -> deldrift_status {
    given!(positions[count]: Points, keys[count]: Array, options: GivenOptions, out: Output);
    guard::enter(|| create(dimension, positions, (!keys.is_null()).then_some(keys), count, options, out))
}

/// Stages the insertion of count vertices, as deldrift_stage_insertions does, with keys. deldrift_create_with_keys says
/// what these are.
///
/// keys: count of them, in the order of positions. NULL stands for the ids. The others are as in
/// deldrift_stage_insertions.
///
/// Cost: count, in the mean over many calls; the first keys of a triangulation also n.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_stage_insertions_with_keys(
    t: *mut deldrift_triangulation,
    positions: *const f64,
    keys: *const u64,
    count: usize,
    first_vertex: *mut u32,
) -> deldrift_status {
    given!(t: Changing, positions[count]: Points, keys[count]: Array, first_vertex: Output);
    t.change_any(|t| {
        let first_vertex = first_vertex.place()?;
        let first = in_open!(t => {
            let positions = positions.of(t)?;
            if keys.is_null() {
                t.stage_insertions(&positions)
            } else {
                t.stage_insertions_with_keys(&positions, keys.get()?)
            }
        })?;
        first_vertex.write(first.get());
        Ok(())
    })
}

/// Stages the insertion of count vertices, as deldrift_stage_insertions_with_keys does, under ids that are given again.
/// They get the ids of removed vertices, the lowest first, and after these the ones above the highest id given so far.
/// So deldrift_id_count does not grow where vertices come and go for ever. An id is free from the removal of its
/// vertex, or the commit of that, until it is given here. deldrift_discard_moves makes those that are staged free
/// again.
///
/// A program that has kept the id of a removed vertex sees another vertex under it. In lists of changes it is as if the
/// vertex had moved: cells that have the same ids as before are not listed, whether or not an id is that of another
/// vertex. The ends of staged segments are not given again, and neither are those of segments that have been split, as
/// long as there are pieces of them.
///
/// keys: count keys, or NULL for the ids. vertices: room for count ids, receives that of each vertex, ascending; both
/// The others are as in deldrift_stage_insertions.
///
/// Cost: n + count, a pass over 4 bytes for each id; and the segments.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_stage_insertions_at_free_ids(
    t: *mut deldrift_triangulation,
    positions: *const f64,
    keys: *const u64,
    count: usize,
    vertices: *mut u32,
) -> deldrift_status {
    given!(t: Changing, positions[count]: Points, keys[count]: Array, vertices[count]: Buffer);
    t.change_any(|t| {
        in_open!(t => {
            let positions = positions.of(t)?;
            let keys = keys.if_any()?;
            let places = vertices.places(count)?;
            let mut free = places.iter_mut();
            t.stage_insertions_at_free_ids(&positions, keys, |v| {
                if let Some(place) = free.next() {
                    place.write(v.get());
                }
            })?;
        });
        Ok(())
    })
}

/// Inserts a vertex at once, as deldrift_insert_vertex does, with a key. deldrift_create_with_keys says what that is.
///
/// key: any number. out_vertex: receives the id, one above the highest given so far.
///
/// Cost: that of deldrift_insert_vertex; the first key of a triangulation also n.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject it),
/// DELDRIFT_ON_SEGMENT, DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY,
/// DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_insert_vertex_with_key(
    t: *mut deldrift_triangulation,
    position: *const f64,
    key: u64,
    out_vertex: *mut u32,
) -> deldrift_status {
    given!(t: Changing, position: Point, out_vertex: Output);
    t.change_any(|t| {
        let out_vertex = out_vertex.place()?;
        let inserted = in_open!(t => t.insert_vertex_with_key(&position.of("position", t)?, key))?;
        out_vertex.write(inserted.get());
        Ok(())
    })
}

/// The key of each vertex by id, to keys: the one that it was given, or else its id. Vertices whose insertion is staged
/// have theirs, too. The entries of removed vertices are 0.
///
/// keys: receives them: a buffer with room for capacity keys; NULL with capacity 0 if it is not wanted. count: receives
/// deldrift_id_count.
///
/// Cost: n.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_keys(
    t: *const deldrift_triangulation,
    keys: *mut u64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, keys[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        in_open!(t => {
            let needed = t.id_count();
            keys.fill_by(count, needed, |places| {
                write_all(places, VertexId::range(0..needed).map(|v| t.key_of_id(v)));
                Ok(())
            })
        })
    })
}
