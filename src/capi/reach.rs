//! The cells, hull facets and vertices that a point in a box could change.

use std::mem::MaybeUninit;

use super::geometry::write_next;
use super::handle::{Reading, deldrift_triangulation};
use super::pointers::{Array, Buffer, Offer, Output, Points, fill_all, given, write_all};
use super::status::{Failure, deldrift_status};
use crate::error::Error;
use crate::in_its_dimension;

/// The cells and the facets of the convex hull that a vertex at a place in one of some boxes could change: what a process
/// has to know of vertices that it does not have, given where they may be.
///
/// A cell is in reach of a box if its closed circumscribed disc or ball meets the closed box, and a facet of the hull if
/// a place of the box is strictly beyond its line or plane. Exactly these are told, decided without rounding: none is
/// missing and none is too many. A vertex that is inserted, or moves to, a place in the box can remove no other cell,
/// whatever its id, and joins no other facet of the hull: for a place in the plane of a facet, the cell behind it is in
/// reach where that matters.
///
/// low, high: box_count rows of 2 (2D) or 3 (3D) numbers, the least and the greatest coordinates of each box, which may
/// be infinite; NULL if box_count is 0. Only places in the range of coordinates count, of magnitude up to 1e57. A box is
/// empty, and nothing in reach of it, where one of low is above that of high. It may be a place or flat. The outside of a
/// box is the union of 4 (2D) or 6 (3D) boxes with infinite sides.
/// mask: an entry for each vertex id: only cells and facets count that have a corner at the place of a vertex whose entry
/// is not 0; NULL for all of them. mask_count: deldrift_id_count; without a mask it is not looked at.
///
/// cells, centres, radii: buffers with room for capacity cells, which receive the indices of those in reach of any of the
/// boxes, ascending and each once; rows of 2 or 3 coordinates; and numbers. The closed ball with this centre and radius
/// certainly has the closed disc or ball of the cell in it. It is larger by some last bits of the radius and of the
/// coordinates, by up to 4e-9 radii where the cell is nearly flat. Where the centre or the radius is beyond the range of
/// numbers, the radius is infinite and the centre a corner of the cell. A ball of a radius above some 1e15 extents of the
/// vertices may well cover all of them: whether the cell is in reach does not depend on that.
/// count: receives the number of cells.
/// hull_cells, hull_corners: buffers with room for hull_capacity entries, which receive for each facet in reach its cell
/// and which of its corners (0, 1, ...) is opposite the facet, as deldrift_hull_facets tells them, ascending. hull_count:
/// receives the number of facets.
/// A buffer that is NULL is not filled. Both counts are also written when a buffer is too small; then nothing else is.
/// NULL for all five with capacities of 0 asks for the counts alone, which saves the balls.
///
/// While there are no cells, as all vertices are in one line or plane or fewer than 3 or 4, nothing is told: a vertex
/// anywhere could change all there is.
/// Where cells are constrained by segments, they are those whose discs meet the box and that are connected through such
/// cells with those that have a place of the box; segments do not stop them. Among these are all that the insertion of a
/// vertex in the box would remove.
///
/// Cost: for each box that of deldrift_locate, some 100 to 200 ns for each cell and facet in its reach, whether in the
/// mask or not, and k log k for the k of them. After a change the first call also does what the first deldrift_cells
/// does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT for a mask
/// of another length, DELDRIFT_INVALID_VALUE for NaN, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
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
    hull_cells: *mut u32,
    hull_corners: *mut u8,
    hull_capacity: usize,
    hull_count: *mut usize,
) -> deldrift_status {
    given!(
        t: Reading, low[box_count]: Points, high[box_count]: Points, mask[mask_count]: Array,
        cells[capacity]: Buffer, radii[capacity]: Buffer, count: Output,
        hull_cells[hull_capacity]: Buffer, hull_corners[hull_capacity]: Buffer, hull_count: Output,
    );
    t.read(|t| {
        in_its_dimension!(t => {
            let centres = centres.cast();
            given!(centres[capacity]: Buffer);
            let found = t.cells_in_reach(low.of(t)?, high.of(t)?, mask_of(mask)?)?;
            let sizes = [(found.cells.len(), capacity), (found.hull.len(), hull_capacity)];
            let offers = [cells.offer(), centres.offer(), radii.offer()];
            let counts = check_room([count, hull_count], sizes, [&offers, &[hull_cells.offer(), hull_corners.offer()]])?;
            let [n, n_hull] = sizes.map(|(n, _)| n);
            let (centres, radii) = (centres.places_if_any(n)?, radii.places_if_any(n)?);
            let (hull_cells, hull_corners) = (hull_cells.places_if_any(n_hull)?, hull_corners.places_if_any(n_hull)?);
            if !(centres.is_empty() && radii.is_empty()) {
                let (mut centres, mut radii) = (centres.iter_mut(), radii.iter_mut());
                for (centre, radius) in t.covering_balls_of(&found.cells)? {
                    write_next(&mut centres, centre);
                    write_next(&mut radii, radius);
                }
            }
            write_all(cells.places_if_any(n)?, found.cells.iter().map(|cell| cell.get()));
            write_all(hull_cells, found.hull.iter().map(|(cell, _)| cell.get()));
            write_all(hull_corners, found.hull.iter().map(|&(_, corner)| corner as u8));
            counts.into_iter().zip(sizes).for_each(|(count, (n, _))| _ = count.write(n));
            Ok(())
        })
    })
}

/// For each of some boxes the vertices of the cells and hull facets in its reach: those that a process sends to another
/// one whose vertices are in the box.
///
/// They are the corners of what deldrift_cells_in_reach tells for this box alone, and the vertices hidden behind them;
/// with a mask, those of which the entry is not 0. low, high, box_count, mask, mask_count: as there.
///
/// vertices: a buffer with room for capacity ids, which receives a list for each box, ascending, one after the other.
/// offsets: a buffer for offset_count numbers, which must be box_count + 1: the list of box k is in vertices from the
/// index that is entry k of offsets on, and ends before entry k + 1. One that is NULL is not filled; without offsets
/// their count is not looked at. count: receives the number of entries, which is also written when vertices is too small.
/// NULL for both with capacity 0 asks for the count alone, which takes as long.
///
/// While there are no cells, a vertex anywhere could change everything: all vertices of the mask are in reach of each
/// box that is not empty.
///
/// Cost: that of deldrift_cells_in_reach, and sorting each list; while there are no cells, n for each box.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT for a mask
/// or offsets of another length, DELDRIFT_INVALID_VALUE for NaN, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_vertices_in_reach(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    box_count: usize,
    mask: *const u8,
    mask_count: usize,
    vertices: *mut u32,
    capacity: usize,
    offsets: *mut usize,
    offset_count: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(
        t: Reading, low[box_count]: Points, high[box_count]: Points, mask[mask_count]: Array,
        vertices[capacity]: Buffer, offsets[offset_count]: Buffer, count: Output,
    );
    t.read(|t| {
        in_its_dimension!(t => {
            if !offsets.is_null() && offset_count != box_count.saturating_add(1) {
                let (argument, given, wanted) = ("offset_count", offset_count, box_count.saturating_add(1));
                return Err(Error::WrongCount { argument, given, wanted, coming: 0 }.into());
            }
            let found = t.vertices_in_reach(low.of(t)?, high.of(t)?, mask_of(mask)?)?;
            let needed = found.vertices.len();
            fill_all(count, needed, capacity, [vertices.offer()], || {
                write_all(vertices.places(needed)?, found.vertices.iter().map(|v| v.get()));
                Ok(())
            })?;
            write_all(offsets.places_if_any(found.offsets.len())?, found.offsets);
            Ok(())
        })
    })
}

/// The mask, if there is one.
fn mask_of(mask: Array<'_, u8>) -> Result<Option<&[u8]>, Failure> {
    if mask.is_null() { Ok(None) } else { mask.get().map(Some) }
}

/// The places of two counts, where the buffers of each, if there are any, have the room for what is needed of the
/// capacity. Otherwise both counts are told if a capacity is too small.
fn check_room<'a>(
    counts: [Output<'a, usize>; 2],
    sizes: [(usize, usize); 2],
    buffers: [&[Offer]; 2],
) -> Result<[&'a mut MaybeUninit<usize>; 2], Failure> {
    let [count, hull_count] = counts;
    let places = [count.place()?, hull_count.place()?];
    let are_any = buffers.map(|buffers| buffers.iter().any(|buffer| buffer.is_there));
    for k in 0..2 {
        if !are_any[k] && sizes[k].1 > 0 {
            return Err(buffers[k][0].missing());
        }
    }
    for (k, argument) in ["capacity", "hull_capacity"].into_iter().enumerate() {
        let (needed, capacity) = sizes[k];
        if are_any[k] && capacity < needed {
            places.into_iter().zip(sizes).for_each(|(place, (n, _))| _ = place.write(n));
            return Err(Failure::BufferTooSmall { argument, capacity, needed });
        }
    }
    Ok(places)
}
