//! What is near a place: the nearest vertices, those in a ball or a box, the cells that a new vertex would remove.

use super::handle::{Reading, by_kind, deldrift_triangulation, in_any};
use super::interpolation::check_product;
use super::location::{deldrift_location, hint_at};
use super::pointers::{Array, Buffer, Input, Output, Point, Points, fit, given, write_all};
use super::status::{Failure, deldrift_status};
use crate::error::Error;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::{Entry, Lists, ListsOf};

/// The k vertices nearest to each of count positions: rows of k ids, by distance. At the same distance they are in the
/// order of ids, or of keys where vertices have keys. Entries beyond the number of vertices are DELDRIFT_NONE.
/// Distances are compared exactly. Hidden vertices count like others.
///
/// vertices: receives count rows of k ids, NULL if there are none.
///
/// It is fastest if each position is near the one before it. Without weights the first id of a row is that of
/// deldrift_nearest_vertex.
///
/// In a periodic triangulation each vertex comes once, by the distance of its nearest image (the minimum image); images
/// farther away do not count.
///
/// Cost: count times that of deldrift_nearest_vertex, the stars of the k vertices, and k log k; with k = 0 constant.
/// While there are no cells, and in a periodic triangulation with weights, count times n; n more in a periodic
/// triangulation with hidden vertices.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
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
            t.nearest_vertices(&positions, k, |vertex| made.push(vertex.get()))?;
            write_all(places, made);
            Ok(())
        })
    })
}

/// The vertices in a closed ball, ascending by id, hidden ones included. They are those whose squared distance from
/// centre is at most squared_radius, exactly.
///
/// centre: 2 or 3 numbers. squared_radius: 0 or more; infinity is all vertices. vertices: a buffer with room for
/// capacity ids; deldrift_vertex_count is always enough. count: receives their number.
///
/// In a periodic triangulation a vertex is in the ball if any image of it is; each is told once. The ball may be larger
/// than the box.
///
/// Cost: that of deldrift_nearest_vertex, the stars of the vertices in the ball, and k log k for the k of them; n log n
/// at most but for the former. While there are no cells, and in a periodic triangulation with hidden vertices, n.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE for a squared radius that is negative or
/// NaN, DELDRIFT_OUT_OF_MEMORY.
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
            let found = t.vertices_in_ball(&centre.of("centre", t)?, squared_radius)?;
            vertices.fill(count, found.len(), || Ok(found.into_iter().map(VertexId::get)))
        })
    })
}

/// In how many lists of deldrift_neighbour_lists a pair of vertices is.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum deldrift_pairs {
    /// In the list of each of the two in whose ball the other one is: full lists.
    DELDRIFT_PAIRS_FULL = 0,
    /// Each pair of which the full lists have one vertex or both, once: half lists.
    DELDRIFT_PAIRS_HALF = 1,
}

/// What pairs are asked for as it arrives from C, where any number may be passed.
pub type PairsCode = u32;

/// For each vertex the others that are near it, all in one call: the neighbour lists of particle codes.
///
/// The list of a vertex has the vertices whose squared distance from it is at most its squared radius, exactly. They
/// are those that deldrift_vertices_in_ball finds around it, hidden ones included, but not the vertex itself. Hidden
/// vertices have lists, too. Those of removed and of staged vertices are empty. Each list ascends by id.
///
/// squared_radii: one number for all lists, radius_count being 1; or one for each id, radius_count being
/// deldrift_id_count. Each is 0 or more, and infinity is all vertices. Entries of vertices without a list are not
/// looked at. mask: an entry for each vertex id. Only vertices whose entry is not 0 have a list, which may have others
/// in it. NULL for all. mask_count: deldrift_id_count; without a mask it is not looked at. pairs: DELDRIFT_PAIRS_FULL,
/// or DELDRIFT_PAIRS_HALF for each pair once. Where radii differ, one vertex may be in the ball of another and not the
/// other way round. Half lists have each pair that full lists have one way or both: two vertices with lists are a pair
/// if their distance is at most the greater one of their radii. It is in the list of the lower id, or, if only one of
/// the two has a list, in that.
///
/// offsets: a buffer for offset_count numbers, which must be deldrift_id_count + 1. The list of vertex v begins in
/// neighbours at the index that is entry v of offsets, and ends before entry v + 1. neighbours: a buffer with room for
/// capacity ids. shifts: one with room for as many rows of 2 (2D) or 3 (3D) whole numbers: in which period each
/// neighbour is, as deldrift_edge_shifts has them. count: receives the number of entries. With NULL for neighbours and
/// shifts and capacity 0 offsets are filled, and nothing is kept. A program that asks again and again, as in each step,
/// keeps its buffers, with some room to spare, and so asks once.
///
/// In a periodic triangulation a list has every image that is near, each with its shift, ascending by id and by shift.
/// Where the radius is large beside the box, there are several images of one vertex, and images of the vertex itself.
/// Half lists have one of the two ways between two images. Of those from a vertex to itself it is the one whose shift
/// has a positive number as the first that is not 0. Radii are refused that are so large that places of images would be
/// rounded. Up to eight times the least distance between opposite sides of the reduced box is always possible. Where
/// the triangulation is not periodic, shifts are 0.
///
/// Runs on several threads, as the options allow. The lists do not depend on how many there are. Takes memory for the
/// places and for all lists while it runs, and writes nothing until all are known.
///
/// Cost: n log n, the entries, and k log k for the k of each list. With one radius for all, that is so for every set,
/// however unevenly it is spread. What is looked at besides is at most a constant times n and the entries, and mostly
/// some five times these. Where radii differ by powers of two of many sizes, what is looked at for each size is at most
/// n times the root of the number of entries.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT, DELDRIFT_INVALID_VALUE for a squared radius that is negative
/// or NaN, or too large for a periodic triangulation, and for other pairs, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_neighbour_lists(
    t: *const deldrift_triangulation,
    squared_radii: *const f64,
    radius_count: usize,
    mask: *const u8,
    mask_count: usize,
    pairs: PairsCode,
    offsets: *mut usize,
    offset_count: usize,
    neighbours: *mut u32,
    shifts: *mut i64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, squared_radii[radius_count]: Array, mask[mask_count]: Array, offsets[offset_count]: Buffer);
    given!(neighbours[capacity]: Buffer, count: Output);
    t.read_any_watched(|t, monitor| {
        let (n_ids, d) = (in_any!(t => t.id_count()), t.dimension() as usize);
        let room = capacity.saturating_mul(d);
        given!(shifts[room]: Buffer);
        if !offsets.is_null() && offset_count != n_ids + 1 {
            return Err(wrong_count("offset_count", offset_count, n_ids + 1));
        }
        if radius_count != 1 && radius_count != n_ids {
            return Err(wrong_count("radius_count", radius_count, n_ids));
        }
        if !mask.is_null() && mask_count != n_ids {
            return Err(wrong_count("mask_count", mask_count, n_ids));
        }
        let mask = mask.if_any()?;
        let wanted = ListsOf { squared_radii: squared_radii.get()?, mask, is_half: is_half(pairs)? };
        let is_kept = !(neighbours.is_null() && shifts.is_null());
        let into = Into { offsets, neighbours, shifts, capacity, d };
        by_kind!(t => {
            let found = t.lists_of(&wanted, is_kept, monitor)?;
            into.fill(count, &found, |_, entry| (entry.parts().0, [0; 3]))
        }, periodic t => {
            let found = t.lists_of(&wanted, is_kept, monitor)?;
            into.fill(count, &found.lists, |vertex, entry| t.told(&found, vertex, entry))
        })
    })
}

/// The buffers for lists.
struct Into<'a> {
    offsets: Buffer<'a, usize>,
    neighbours: Buffer<'a, u32>,
    shifts: Buffer<'a, i64>,
    capacity: usize,
    d: usize,
}

impl Into<'_> {
    /// Fills those that are there; `told` is what an entry in the list of a vertex is.
    fn fill<E: Entry>(
        self,
        count: Output<'_, usize>,
        lists: &Lists<E>,
        told: impl Fn(VertexId, E) -> (VertexId, [i64; 3]),
    ) -> Result<(), Failure> {
        let Into { offsets, neighbours, shifts, capacity, d } = self;
        let needed = lists.n_entries();
        let fitting = fit(count, needed, capacity, &[neighbours.offer(), shifts.offer()])?;
        let offsets = offsets.places_if_any(lists.offsets.len())?;
        let (neighbours, shifts) = (neighbours.places_if_any(needed)?, shifts.places_if_any(needed * d)?);
        let is_asked = !(neighbours.is_empty() && shifts.is_empty());
        let mut write = |vertex: VertexId, begin: usize, list: &[E]| {
            let those = || list.iter().map(|&entry| told(vertex, entry));
            if let Some(places) = neighbours.get_mut(begin..begin + list.len()) {
                write_all(places, those().map(|(other, _)| other.get()));
            }
            if let Some(places) = shifts.get_mut(d * begin..d * (begin + list.len())) {
                write_all(places, those().flat_map(|(_, shift)| shift.into_iter().take(d)));
            }
        };
        // Otherwise lengths are known alone.
        if is_asked {
            lists.for_each(&mut write);
        }
        write_all(offsets, lists.offsets.iter().copied());
        fitting.tell();
        Ok(())
    }
}

fn wrong_count(argument: &'static str, given: usize, wanted: usize) -> Failure {
    Error::WrongCount { argument, given, wanted, coming: 0 }.into()
}

/// Whether each pair is wanted once.
fn is_half(code: PairsCode) -> Result<bool, Failure> {
    match code {
        _ if code == deldrift_pairs::DELDRIFT_PAIRS_FULL as u32 => Ok(false),
        _ if code == deldrift_pairs::DELDRIFT_PAIRS_HALF as u32 => Ok(true),
        _ => {
            let (argument, wanted) = ("pairs", "0 or 1");
            Err(Error::InvalidValue { argument, index: 0, value: f64::from(code), wanted }.into())
        }
    }
}

/// The vertices in a closed box, ascending by id, hidden ones included. Each of their coordinates is at least that of
/// low and at most that of high.
///
/// low, high: 2 or 3 numbers each, which may be infinite. Where one of low is above that of high there are none.
/// vertices: a buffer with room for capacity ids; deldrift_vertex_count is always enough. count: receives their number.
///
/// In a periodic triangulation a vertex is in the box if any image of it is; each is told once. The box is not rounded,
/// and may be larger than the period. One that is 10^20 periods away is refused. Where vectors go along several axes,
/// as in a skewed box, there is a condition on one that is thousands of periods long, or infinite, along some of these
/// axes. It has to be as wide as all these vectors together along each, or infinite along all but one.
///
/// Cost: that of deldrift_locate, the cells whose bounding boxes meet the box, the facets of the hull that are seen
/// from it, and k log k for the k vertices in it; n log n at most but for the first. While there are no cells, n. In a
/// periodic triangulation that of deldrift_vertices_in_ball where the box is shorter than half of the shortest vector,
/// else n; and, where vectors go along several axes, the periods that the box meets, for each vertex.
///
/// Errors: DELDRIFT_INVALID_VALUE for NaN, or for a box that is too long, DELDRIFT_OUT_OF_MEMORY.
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
            let found = t.vertices_in_box(&low.of("low", t)?, &high.of("high", t)?)?;
            vertices.fill(count, found.len(), || Ok(found.into_iter().map(VertexId::get)))
        })
    })
}

/// The cells that the insertion of a vertex at a position would remove, in no particular order. Their circle or sphere
/// has the position inside, exactly, with ties broken as for a vertex of the highest id. At the place of a vertex, and
/// while there are no cells, there are none.
///
/// hint: where to begin to look for it, as for deldrift_locate_points; NULL if nothing is known. cells: a buffer with
/// room for capacity indices. count: receives their number.
///
/// A position outside the convex hull may be in the circle or sphere of no cell: then the insertion removes none, and
/// joins the vertex to the facets of the hull that it sees.
///
/// In a periodic triangulation a cell is told, once, if a translation of it is in conflict: it would be removed by the
/// insertion of the vertex with all of its images. A position outside the convex hull is refused, as facets without an
/// end are seen from there.
///
/// Cost: that of deldrift_locate, the cells found, and the facets of the hull that are seen from the position.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_PERIODIC outside the hull of a periodic triangulation,
/// DELDRIFT_OUT_OF_MEMORY.
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
            let found = t.conflicts(&position.of("position", t)?, hint_at(hint)?)?;
            cells.fill(count, found.len(), || Ok(found.into_iter().map(CellId::get)))
        })
    })
}
