//! The cells, hull facets and vertices that a vertex in a box could change.

use super::geometry::write_next;
use super::handle::{Reading, deldrift_triangulation, in_open};
use super::pointers::{Array, Buffer, Output, Points, fill_all, given, write_all};
use super::status::{Failure, deldrift_status};
use crate::delaunay::Moving;
use crate::motion::MovingTriangulation;
use crate::predicates::PointArray;

/// The cells that a vertex at a place in one of some boxes could change. With deldrift_hull_facets_in_reach, they are
/// what a process has to know of vertices that it does not have, given where these may be.
///
/// A cell is in reach of a box if its closed circumscribed disc or ball meets the closed box. Exactly these are told,
/// decided without rounding. A vertex that is inserted at, or moves to, a place in the box removes no other cell,
/// whatever its id. It joins no facet of the hull but those in reach, and those in whose line or plane its place is,
/// where the cell behind is in reach.
///
/// low, high: box_count rows of the least and the greatest coordinates of each box, which may be infinite. Places
/// beyond the range of coordinates, of magnitudes above 1e57, do not count. A box is empty, and nothing in reach of it,
/// where one of low is above that of high. It may be a place, or flat. The outside of a box is 4 (2D) or 6 (3D) boxes
/// with infinite sides. mask: an entry for each vertex id. Only cells count that have a corner at the place of a vertex
/// whose entry is not 0. NULL for all cells. mask_count: deldrift_id_count; without a mask it is not looked at.
///
/// cells, centres, radii: buffers with room for capacity cells. They receive the indices of those in reach of any of
/// the boxes, ascending and each once; points; and numbers. The closed ball with this centre and radius certainly has
/// the closed disc or ball of the cell in it. It is larger by some 1e-12 of the radius and last bits of the
/// coordinates, or by up to 4e-9 of the radius where the cell is nearly flat. Where numbers do not suffice, the radius
/// is infinite and the centre a corner of the cell. A ball may cover all vertices though few are in that of the cell,
/// if its radius is 1e8 times their extent: whether the cell is in reach does not depend on that. count: receives the
/// number of cells.
///
/// While there are no cells, none are told: then a vertex anywhere could change all there is. Where cells are
/// constrained by segments, those are told whose discs meet the box and that are connected, by such cells, with those
/// that have a place of the box. Segments between them do not count. All that the insertion of a vertex in the box
/// would remove are among them.
///
/// With weights a vertex in the box may have any weight up to the greatest that there is, or up to 0 if that is more: the cells told
/// are those in respect of which a place of the box has a power of at most this weight. Those that have a place of
/// the box are among them, and so is the cell that hides a vertex there. In a mask and in lists of vertices only those count
/// then that are corners.
///
/// Cost: for each box that of deldrift_locate, and the cells and hull facets in its reach, whether in the mask or not;
/// k log k for the k cells told. With weights n as well, once.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT for a mask of another length, DELDRIFT_INVALID_VALUE for NaN,
/// DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_cells_in_reach(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    box_count: usize,
    mask: *const u8,
    mask_count: usize,
    cells: *mut u32,
    centres: *mut f64,
    radii: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, low[box_count]: Points, high[box_count]: Points, mask[mask_count]: Array);
    given!(cells[capacity]: Buffer, radii[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        in_open!(t => {
            let centres = centres.cast();
            given!(centres[capacity]: Buffer);
            let found = t.cells_in_reach(&low.of(t)?, &high.of(t)?, mask_of(t, mask, mask_count)?)?.cells;
            let needed = found.len();
            fill_all(count, needed, capacity, [cells.offer(), centres.offer(), radii.offer()], || {
                let cells = cells.places_if_any(needed)?;
                let (centres, radii) = (centres.places_if_any(needed)?, radii.places_if_any(needed)?);
                if !(centres.is_empty() && radii.is_empty()) {
                    let (mut centres, mut radii) = (centres.iter_mut(), radii.iter_mut());
                    for (centre, radius) in t.covering_balls_of(&found)? {
                        write_next(&mut centres, centre.coordinates());
                        write_next(&mut radii, radius);
                    }
                }
                write_all(cells, found.iter().map(|cell| cell.get()));
                Ok(())
            })
        })
    })
}

/// The facets of the convex hull that a place in one of some boxes is strictly beyond, exactly. A vertex there would be
/// joined to them.
///
/// low, high, box_count, mask, mask_count: as for deldrift_cells_in_reach; with a mask, only facets count that have a
/// corner at the place of a vertex of the mask. cells, corners: buffers with room for capacity numbers, which receive
/// the cell of each facet and which of its corners (0, 1, ...) is opposite, as deldrift_hull_facets has them, ascending
/// and each once. count: receives the number of facets.
///
/// While there are no cells, there are none.
///
/// Cost: that of deldrift_cells_in_reach.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT for a mask of another length, DELDRIFT_INVALID_VALUE for NaN,
/// DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_hull_facets_in_reach(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    box_count: usize,
    mask: *const u8,
    mask_count: usize,
    cells: *mut u32,
    corners: *mut u8,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, low[box_count]: Points, high[box_count]: Points, mask[mask_count]: Array);
    given!(cells[capacity]: Buffer, corners[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        in_open!(t => {
            let found = t.cells_in_reach(&low.of(t)?, &high.of(t)?, mask_of(t, mask, mask_count)?)?.hull;
            let needed = found.len();
            fill_all(count, needed, capacity, [cells.offer(), corners.offer()], || {
                let (cells, corners) = (cells.places_if_any(needed)?, corners.places_if_any(needed)?);
                write_all(cells, found.iter().map(|(cell, _)| cell.get()));
                write_all(corners, found.iter().map(|&(_, corner)| corner as u8));
                Ok(())
            })
        })
    })
}

/// For each of some boxes the vertices of the cells and hull facets in its reach. A process sends them to another one
/// whose vertices are in the box.
///
/// They are the corners of what deldrift_cells_in_reach and deldrift_hull_facets_in_reach tell for this box alone, and
/// the vertices hidden behind them; with a mask, those of which the entry is not 0. low, high, box_count, mask,
/// mask_count: as there.
///
/// vertices: a buffer with room for capacity ids, which receives a list for each box, ascending, one after the other.
/// offsets: a buffer with room for box_count + 1 numbers. The list of box k begins in vertices at the index that is
/// entry k of offsets, and ends before entry k + 1. count: receives the number of entries.
///
/// While there are no cells, a vertex anywhere could change all there is: all vertices of the mask are in reach of each
/// box that is not empty.
///
/// Cost: that of deldrift_cells_in_reach, and k log k for the k vertices of each list; while there are no cells, n for
/// each box.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT for a mask of another length, DELDRIFT_INVALID_VALUE for NaN,
/// DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_vertices_in_reach(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    box_count: usize,
    mask: *const u8,
    mask_count: usize,
    vertices: *mut u32,
    offsets: *mut usize,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let n_offsets = box_count.saturating_add(1);
    given!(t: Reading, low[box_count]: Points, high[box_count]: Points, mask[mask_count]: Array);
    given!(vertices[capacity]: Buffer, offsets[n_offsets]: Buffer, count: Output);
    t.read_any(|t| {
        in_open!(t => {
            let (low, high) = (&low.of(t)?, &high.of(t)?);
            let offsets = offsets.places_if_any(n_offsets)?;
            let found = t.vertices_in_reach(low, high, mask_of(t, mask, mask_count)?)?;
            let needed = found.vertices.len();
            fill_all(count, needed, capacity, [vertices.offer()], || {
                write_all(vertices.places(needed)?, found.vertices.iter().map(|v| v.get()));
                Ok(())
            })?;
            write_all(offsets, found.offsets);
            Ok(())
        })
    })
}

/// The mask, if there is one, which has so many entries.
fn mask_of<'a, G: Moving>(
    t: &MovingTriangulation<G>,
    mask: Array<'a, u8>,
    count: usize,
) -> Result<Option<&'a [u8]>, Failure> {
    if mask.is_null() {
        return Ok(None);
    }
    t.check_vertex_mask(count)?;
    mask.get().map(Some)
}
