//! Geometry of the cells: circumspheres, volumes, masks by circumradius, and the facets around a mask.

use std::mem::MaybeUninit;
use std::slice;

use super::fence;
use super::pointers::{self, Room, copy_out};
use super::state::pointer_for;
use super::status::{Failure, deldrift_status};
use super::triangulation::{deldrift_triangulation, in_its_dimension};
use crate::delaunay::Dimension;
use crate::error::Result;
use crate::motion::{BoundaryFacet, MovingTriangulation};

/// The circumcentres and squared circumradii of all cells, in the order of deldrift_cells.
///
/// centres: a buffer with room for capacity points. squared_radii: a buffer with room for capacity numbers. One
/// that is NULL is not filled. count: receives the number of cells, which is also written when the buffers are
/// too small. NULL for both with capacity 0 asks for the count alone.
///
/// Rounded: a coordinate of a centre is off by at most 1e-9 circumradii and its own rounding, a squared radius by
/// 4e-9 of itself, however flat the cell; unless it is nearly flat, by a few last bits. What is too large for a
/// number is infinite; nothing is NaN. One pass over the cells; nearly flat ones take a microsecond each.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY. After a change the first call also does what the first deldrift_cells does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_circumcentres(
    t: *const deldrift_triangulation,
    centres: *mut f64,
    squared_radii: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    // SAFETY: the header's conditions on pointers.
    unsafe {
        fence::read(t, |kernel| {
            in_its_dimension!(kernel, t => {
                let (needed, centres) = (t.cell_count(), pointer_for(t, centres));
                let buffers = [("centres", centres.cast()), ("squared_radii", squared_radii.cast())];
                copy_out(Room { capacity, count }, needed, &buffers, || {
                    let mut centres = pointers::buffer_if_any("centres", centres, needed)?.iter_mut();
                    let mut squared =
                        pointers::buffer_if_any("squared_radii", squared_radii, needed)?.iter_mut();
                    for (centre, squared_radius) in t.circumspheres()? {
                        write_next(&mut centres, centre);
                        write_next(&mut squared, squared_radius);
                    }
                    Ok(())
                })
            })
        })
    }
}

/// The areas (2D) or volumes (3D) of all cells, in the order of deldrift_cells.
///
/// volumes: a buffer with room for capacity numbers. count: receives the number of cells, which is also written
/// when the buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Rounded, with a relative error of at most 1e-9, and of a few last bits unless the cell is nearly flat: always
/// positive. (Below the least normal number, 2.2e-308, they are less accurate.) One pass over the cells; nearly flat
/// ones take up to a microsecond each.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY. After a change the first call also does what the first deldrift_cells does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_volumes(
    t: *const deldrift_triangulation,
    volumes: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    // SAFETY: the header's conditions on pointers.
    unsafe {
        fence::read(t, |kernel| {
            in_its_dimension!(kernel, t => {
                let needed = t.cell_count();
                copy_out(Room { capacity, count }, needed, &[("volumes", volumes.cast())], || {
                    pointers::fill_from("volumes", volumes, t.volumes()?)
                })
            })
        })
    }
}

/// Which cells have a circumradius of at most a given one, as for an alpha shape: 1 for those whose squared
/// circumradius is at most squared_radius, 0 for the others, in the order of deldrift_cells.
///
/// squared_radius: 0 or more; infinity is all cells. mask: a buffer with room for capacity bytes. count: receives
/// the number of cells, which is also written when the buffer is too small. NULL with capacity 0 asks for the count
/// alone.
///
/// Exact: every entry is that of an exact comparison of squared_radius, as given, with the squared radius of the
/// circle or sphere through the positions. One pass over the cells; where the two nearly agree, a cell takes a
/// microsecond.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_INVALID_VALUE for a squared radius that
/// is negative or NaN, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY. After a change the first call also does
/// what the first deldrift_cells does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_mask_by_circumradius(
    t: *const deldrift_triangulation,
    squared_radius: f64,
    mask: *mut u8,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    // SAFETY: the header's conditions on pointers.
    unsafe {
        fence::read(t, |kernel| {
            in_its_dimension!(kernel, t => {
                let entries = t.mask_by_circumradius(squared_radius)?.map(u8::from);
                copy_out(Room { capacity, count }, entries.len(), &[("mask", mask)], || {
                    pointers::fill_from("mask", mask, entries)
                })
            })
        })
    }
}

/// The boundary of some of the cells: the facets between a cell in a mask and one that is not in it, or the outside.
///
/// mask: mask_count bytes, one for each cell in the order of deldrift_cells (mask_count must be deldrift_cell_count);
/// a cell is in it if its byte is not 0. Read during the call only. facets: a buffer with room for capacity rows of 2
/// (2D) or 3 (3D) vertex ids. Facets are seen from outside: in 2D the cell in the mask is on the left of the edge from
/// the first vertex to the second; in 3D the vertices are in counter-clockwise order as seen from the side away from
/// the cell. cells, corners: buffers with room for capacity numbers, which receive that cell and which of its corners
/// (0, 1, ...) is opposite the facet. One of the three that is NULL is not filled. count: receives the number of
/// facets, which is also written when the buffers are too small. NULL for all three with capacity 0 asks for the
/// count alone.
///
/// Facets are in ascending order of cell and then of corner. Exact. Two passes over the cells.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_WRONG_COUNT,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY. After a change the first call also does what the first
/// deldrift_cells does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_mask_boundary(
    t: *const deldrift_triangulation,
    mask: *const u8,
    mask_count: usize,
    facets: *mut u32,
    cells: *mut u32,
    corners: *mut u8,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    // SAFETY: the header's conditions on pointers.
    unsafe {
        fence::read(t, |kernel| {
            in_its_dimension!(kernel, t => {
                t.check_mask(mask_count)?;
                let mask = pointers::array("mask", mask, mask_count)?;
                let mut needed = 0;
                t.mask_boundary(mask, |_| needed += 1)?;
                let columns = Columns { facets, cells, corners };
                columns.copy_out(t, Room { capacity, count }, needed, |found| t.mask_boundary(mask, found))
            })
        })
    }
}

/// The facets of the convex hull, as deldrift_mask_boundary gives them if all cells are in the mask.
///
/// facets, cells, corners, capacity, count: as there. One pass over the cells; constant time for the count alone.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY. After a change the first call also does what the first deldrift_cells does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_hull_facets(
    t: *const deldrift_triangulation,
    facets: *mut u32,
    cells: *mut u32,
    corners: *mut u8,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    // SAFETY: the header's conditions on pointers.
    unsafe {
        fence::read(t, |kernel| {
            in_its_dimension!(kernel, t => {
                let columns = Columns { facets, cells, corners };
                let needed = t.hull_facet_count();
                columns.copy_out(t, Room { capacity, count }, needed, |found| t.hull_facets(found))
            })
        })
    }
}

/// Writes an entry of a buffer, if there is one.
#[inline(always)]
fn write_next<T>(places: &mut slice::IterMut<'_, MaybeUninit<T>>, value: T) {
    if let Some(place) = places.next() {
        place.write(value);
    }
}

/// The buffers for facets.
struct Columns {
    facets: *mut u32,
    cells: *mut u32,
    corners: *mut u8,
}

impl Columns {
    /// Copies `needed` facets of `t`, which `list` lists, if the buffers are large enough, and tells the count.
    ///
    /// # Safety
    /// The header's conditions on pointers.
    unsafe fn copy_out<G: Dimension>(
        self,
        _t: &MovingTriangulation<G>,
        room: Room,
        needed: usize,
        list: impl FnOnce(&mut dyn FnMut(BoundaryFacet<G::Vertices>)) -> Result<()>,
    ) -> Result<(), Failure> {
        let Columns { facets, cells, corners } = self;
        let buffers = [("facets", facets.cast()), ("cells", cells.cast()), ("corners", corners)];
        // SAFETY: the caller's promise.
        unsafe {
            copy_out(room, needed, &buffers, || {
                let mut vertices = pointers::buffer_if_any("facets", facets, needed * G::D)?.iter_mut();
                let mut cells = pointers::buffer_if_any("cells", cells, needed)?.iter_mut();
                let mut corners = pointers::buffer_if_any("corners", corners, needed)?.iter_mut();
                list(&mut |facet| {
                    for v in facet.vertices() {
                        write_next(&mut vertices, v.get());
                    }
                    write_next(&mut cells, facet.cell.get());
                    write_next(&mut corners, facet.corner as u8);
                })?;
                Ok(())
            })
        }
    }
}
