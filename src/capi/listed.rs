//! Geometry of some of the cells: those around vertices, and entries of arrays that a program keeps for all cells.

use std::mem::MaybeUninit;

use super::geometry::cell_count_of;
use super::handle::{Reading, deldrift_triangulation, in_any};
use super::pointers::{Array, Buffer, Offer, Output, given};
use super::status::{Failure, deldrift_status};
use crate::ids::{CellId, VertexId};
use crate::predicates::PointArray;

/// The cells around some vertices: those that have at least one of the vertices as a corner, ascending, each once.
///
/// vertices: vertex_count ids, in any order, some maybe more than once; hidden vertices have no cells. cells: a buffer
/// with room for capacity indices; deldrift_cell_count is always enough. count: receives the number of indices.
///
/// After a commit, only two kinds of cells have changed their shape: those around the vertices that have moved, and
/// those that deldrift_take_changes lists as created. With the functions that follow, a program that keeps an array for
/// all cells updates those entries alone.
///
/// Cost: the cells of the stars, and k log k for the k of them; m at most, and for a periodic triangulation.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX,
/// DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_cells_around(
    t: *const deldrift_triangulation,
    vertices: *const u32,
    vertex_count: usize,
    cells: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, vertices[vertex_count]: Array, cells[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        let vertices = VertexId::of_numbers(vertices.get()?);
        let found = in_any!(t => t.cells_around(vertices))?;
        cells.fill(count, found.len(), || Ok(found.iter().map(|cell| cell.get())))
    })
}

/// Computes circumcentres and squared circumradii of some cells again, in arrays that deldrift_circumcentres has
/// filled. For each index in cells, the entry of this index becomes that of the cell. Other entries are not touched.
///
/// cells: cell_count indices into deldrift_cells, in any order, some maybe more than once. centres: an array with room
/// for capacity points. squared_radii: an array with room for capacity numbers. One that is NULL is not filled, but not
/// both. capacity: at least deldrift_cell_count.
///
/// After a change an array for all cells is brought up to date in three steps. Its entries follow renumbered cells as
/// deldrift_changes says. Then this is called for the created cells, and then for those that deldrift_cells_around
/// gives for the vertices that have moved. The values are then those of deldrift_circumcentres, with the same accuracy.
/// Their last bits may differ where a cell was removed and created again in between, as they depend on the order in
/// which the library keeps its corners. It pays while fewer than a tenth of the vertices move, or a third if they are
/// neighbours. Beyond that the pass of deldrift_circumcentres is faster.
///
/// Cost: cell_count.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_FACET for an index that is no cell's, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_update_circumcentres(
    t: *const deldrift_triangulation,
    cells: *const u32,
    cell_count: usize,
    centres: *mut f64,
    squared_radii: *mut f64,
    capacity: usize,
) -> deldrift_status {
    given!(t: Reading, cells[cell_count]: Array, squared_radii[capacity]: Buffer);
    t.read_any(|t| {
        let n = cell_count_of(t)?;
        in_any!(t => {
            let centres = centres.cast();
            given!(centres[capacity]: Buffer);
            check_arrays([centres.offer(), squared_radii.offer()], capacity, n)?;
            let cells = CellId::of_numbers(cells.get()?);
            let (centres, squared_radii) = (centres.places_if_any(n)?, squared_radii.places_if_any(n)?);
            t.for_circumspheres(Some(cells), |cell, (centre, squared_radius)| {
                write_if_any(centres, cell, centre.coordinates());
                write_if_any(squared_radii, cell, squared_radius);
            })?;
            Ok(())
        })
    })
}

/// Computes the areas (2D) or volumes (3D) of some cells again, in an array that deldrift_volumes has filled. Entries
/// are as for deldrift_update_circumcentres.
///
/// cells: cell_count indices into deldrift_cells, in any order, some maybe more than once. volumes: an array with room
/// for capacity numbers. capacity: at least deldrift_cell_count.
///
/// deldrift_update_circumcentres has the steps by which an array for all cells is brought up to date, and when that
/// pays. The values are then those of deldrift_volumes, with its accuracy; last bits may differ where a cell was
/// removed and created again.
///
/// Cost: cell_count.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_FACET for an index that is no cell's, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_update_volumes(
    t: *const deldrift_triangulation,
    cells: *const u32,
    cell_count: usize,
    volumes: *mut f64,
    capacity: usize,
) -> deldrift_status {
    given!(t: Reading, cells[cell_count]: Array, volumes[capacity]: Buffer);
    t.read_any(|t| {
        let n = cell_count_of(t)?;
        check_arrays([volumes.offer()], capacity, n)?;
        let cells = CellId::of_numbers(cells.get()?);
        let volumes = volumes.places(n)?;
        in_any!(t => Ok(t.for_volumes(Some(cells), |cell, volume| _ = volumes[cell].write(volume))?))
    })
}

/// Decides for some cells again whether their circumradius is at most a given one, in a mask that
/// deldrift_mask_by_circumradius has filled for the same one. Entries are as for deldrift_update_circumcentres.
///
/// cells: cell_count indices into deldrift_cells, in any order, some maybe more than once. squared_radius: 0 or more,
/// with weights any number; infinity is all cells. mask: an array with room for capacity bytes. capacity: at least
/// deldrift_cell_count.
///
/// deldrift_update_circumcentres has the steps by which an array for all cells is brought up to date, and when that
/// pays.
///
/// Exact: a mask that is kept up to date is that of a full pass, byte by byte.
///
/// Cost: cell_count.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_VALUE for a squared radius that is negative or NaN,
/// DELDRIFT_NO_SUCH_FACET for an index that is no cell's, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_update_mask_by_circumradius(
    t: *const deldrift_triangulation,
    cells: *const u32,
    cell_count: usize,
    squared_radius: f64,
    mask: *mut u8,
    capacity: usize,
) -> deldrift_status {
    given!(t: Reading, cells[cell_count]: Array, mask[capacity]: Buffer);
    t.read_any(|t| {
        let n = cell_count_of(t)?;
        check_arrays([mask.offer()], capacity, n)?;
        let cells = CellId::of_numbers(cells.get()?);
        let mask = mask.places(n)?;
        let write = |cell: CellId, is_in: bool| _ = mask[cell].write(is_in.into());
        in_any!(t => Ok(t.for_mask_by_circumradius(squared_radius, Some(cells), write)?))
    })
}

/// There must be an array at least, and room in it for an entry of each of `n` cells.
pub(super) fn check_arrays<const N: usize>(
    arrays: [Offer; N],
    capacity: usize,
    n: usize,
) -> Result<(), Failure> {
    if n > 0 && !arrays.iter().any(|array| array.is_there) {
        return Err(arrays[0].missing());
    }
    if capacity < n {
        return Err(Failure::BufferTooSmall { argument: "capacity", capacity, needed: n });
    }
    Ok(())
}

/// Writes the entry of a cell to an array for all cells, if there is one.
#[inline(always)]
fn write_if_any<T>(array: &mut [MaybeUninit<T>], cell: CellId, value: T) {
    if let Some(place) = array.get_mut(cell.index()) {
        place.write(value);
    }
}
