//! Geometry of the cells: circumspheres, volumes, masks by circumradius, and the facets around a mask.

use std::mem::MaybeUninit;
use std::slice;

use super::handle::{Content, Reading, by_kind, deldrift_triangulation, in_any};
use super::pointers::{Array, Buffer, Output, fill_all, given};
use super::status::{Failure, deldrift_status};
use crate::complex::Corners;
use crate::error::Result;
use crate::ids::VertexId;
use crate::motion::{BoundaryFacet, check_not_negative};
use crate::predicates::PointArray;

/// The circumcentres and squared circumradii of all cells, in the order of deldrift_cells.
///
/// centres: a buffer with room for capacity points. squared_radii: a buffer with room for capacity numbers. count:
/// receives the number of cells.
///
/// Rounded: a coordinate of a centre is off by at most 1e-9 circumradii and its own rounding, a squared radius by 4e-9
/// of itself, however flat the cell. Unless the cell is nearly flat, they are off by a few last bits. What is too large
/// for a number is infinite; nothing is NaN. One pass over the cells; nearly flat ones take a microsecond each.
///
/// In a periodic triangulation a centre is that of the cell whose corner of the lowest id is at its own position, as
/// deldrift_cell_shifts has it. Its rounding may be twice that of its coordinates and of the position's.
///
/// Cost: m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_circumcentres(
    t: *const deldrift_triangulation,
    centres: *mut f64,
    squared_radii: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, squared_radii[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        let needed = cell_count_of(t)?;
        in_any!(t => {
            let centres = centres.cast();
            given!(centres[capacity]: Buffer);
            fill_all(count, needed, capacity, [centres.offer(), squared_radii.offer()], || {
                let mut centres = centres.places_if_any(needed)?.iter_mut();
                let mut squared = squared_radii.places_if_any(needed)?.iter_mut();
                t.for_circumspheres(None, |_, (centre, squared_radius)| {
                    write_next(&mut centres, centre.coordinates());
                    write_next(&mut squared, squared_radius);
                })?;
                Ok(())
            })
        })
    })
}

/// The areas (2D) or volumes (3D) of all cells, in the order of deldrift_cells.
///
/// volumes: a buffer with room for capacity numbers. count: receives the number of cells.
///
/// Rounded, with a relative error of at most 1e-9, and of a few last bits unless the cell is nearly flat: always
/// positive. (Below the least normal number, 2.2e-308, they are less accurate.) One pass over the cells; nearly flat
/// ones take up to a microsecond each.
///
/// Cost: m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_volumes(
    t: *const deldrift_triangulation,
    volumes: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, volumes[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        volumes.fill_by(count, cell_count_of(t)?, |places| {
            let mut places = places.iter_mut();
            in_any!(t => Ok(t.for_volumes(None, |_, volume| write_next(&mut places, volume))?))
        })
    })
}

/// Which cells have a circumradius of at most a given one, as for an alpha shape, in the order of deldrift_cells. It is
/// 1 for those whose squared circumradius is at most squared_radius, 0 for the others.
///
/// squared_radius: 0 or more, with weights any number; infinity is all cells. mask: a buffer with room for capacity
/// bytes. count: receives the number of cells.
///
/// Exact: squared_radius, as given, is compared exactly with the squared radius of the circle or sphere through the
/// positions. One pass over the cells; where the two nearly agree, a cell takes a microsecond.
///
/// Cost: m.
///
/// Errors: DELDRIFT_INVALID_VALUE for a squared radius that is negative or NaN, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_mask_by_circumradius(
    t: *const deldrift_triangulation,
    squared_radius: f64,
    mask: *mut u8,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, mask[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        check_squared_radius(t, squared_radius)?;
        mask.fill_by(count, cell_count_of(t)?, |places| {
            let mut places = places.iter_mut();
            let write = |_, is_in: bool| write_next(&mut places, is_in.into());
            in_any!(t => Ok(t.for_mask_by_circumradius(squared_radius, None, write)?))
        })
    })
}

/// Which cells are more than what the rounding of a straight or flat side has made, in the order of deldrift_cells. It
/// is 0 for cells along the convex hull that are flat, 1 for the others.
///
/// tolerance: 0 or more, such as 1e-9; with 0 no cell is flat. A cell is flat if its least height is at most tolerance
/// times its longest edge. It has 0 if it is flat, and has a facet on the hull or on a cell that has 0. mask: a buffer
/// with room for capacity bytes. count: receives the number of cells.
///
/// Vertices that were meant to be on one line or plane are not, once their coordinates are rounded, and the hull goes
/// over flat cells from one to the other. Those cells are exactly Delaunay, and useless where a program divides by
/// areas or volumes. Where no vertices but those of a side are nearly in line with it, the mask leaves these cells out
/// and keeps all others: deldrift_mask_boundary then gives the sides as they were meant. Flat cells elsewhere are kept,
/// as leaving them out would leave holes.
///
/// Rounded: a cell may get either number if its quotient of height and edge differs from tolerance by less than
/// 1.1e-9 + 2e-15 / tolerance of it.
///
/// Cost: m.
///
/// Errors: DELDRIFT_INVALID_VALUE for a tolerance that is negative or NaN, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_mask_without_flat_cells(
    t: *const deldrift_triangulation,
    tolerance: f64,
    mask: *mut u8,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, mask[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        in_any!(t => {
            check_not_negative("tolerance", tolerance)?;
            let cells = t.cells()?;
            mask.fill(count, cells.corners.len(), || Ok(t.mask_without_flat_cells(tolerance)?))
        })
    })
}

/// The boundary of some of the cells: the facets between a cell in a mask and one that is not in it, or the outside.
///
/// mask: mask_count bytes, one for each cell in the order of deldrift_cells (mask_count must be deldrift_cell_count). A
/// cell is in it if its byte is not 0. facets: a buffer with room for capacity rows of 2 (2D) or 3 (3D) vertex ids.
/// Facets are seen from outside. In 2D the cell in the mask is on the left of the edge from the first vertex to the
/// second. In 3D the vertices are in counter-clockwise order as seen from the side away from the cell. cells, corners:
/// buffers with room for capacity numbers, which receive that cell and which of its corners (0, 1, ...) is opposite the
/// facet. count: receives the number of facets.
///
/// Facets are in ascending order of cell and then of corner. Exact. Two passes over the cells. In a periodic
/// triangulation each is where deldrift_cell_shifts has its cell.
///
/// Cost: m.
///
/// Errors: DELDRIFT_WRONG_COUNT, DELDRIFT_OUT_OF_MEMORY.
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
    given!(t: Reading, mask[mask_count]: Array, cells[capacity]: Buffer, corners[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        given!(facets[capacity.saturating_mul(t.dimension() as usize)]: Buffer);
        in_any!(t => {
            t.check_mask(mask_count)?;
            let mask = mask.get()?;
            let mut needed = 0;
            t.mask_boundary(mask, |_| needed += 1)?;
            let columns = Columns { facets, cells, corners, capacity };
            columns.fill(count, needed, |found| t.mask_boundary(mask, found))
        })
    })
}

/// The facets of the convex hull, in ascending order of cell and then of corner.
///
/// facets, cells, corners: as for deldrift_mask_boundary, with all cells in the mask. count: receives the number of
/// facets.
///
/// Exact. One pass over the cells; the count alone takes constant time. A periodic triangulation has no facets unless
/// its box is open somewhere; counting them takes a pass over the cells.
///
/// Cost: m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_hull_facets(
    t: *const deldrift_triangulation,
    facets: *mut u32,
    cells: *mut u32,
    corners: *mut u8,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, cells[capacity]: Buffer, corners[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        given!(facets[capacity.saturating_mul(t.dimension() as usize)]: Buffer);
        let columns = Columns { facets, cells, corners, capacity };
        by_kind!(t => {
            columns.fill(count, t.hull_facet_count(), |found| t.hull_facets(found))
        }, periodic t => {
            let mut needed = 0;
            t.hull_facets(|_| needed += 1)?;
            columns.fill(count, needed, |found| t.hull_facets(found))
        })
    })
}

/// The square of a radius must be a number, and not negative unless there are weights.
pub(super) fn check_squared_radius(t: &Content, squared_radius: f64) -> Result<()> {
    let least = if t.is_weighted() { squared_radius.abs() } else { squared_radius };
    check_not_negative("squared_radius", least)
}

/// How many cells there are, of those of a periodic triangulation one of each class.
pub(super) fn cell_count_of(t: &Content) -> Result<usize> {
    by_kind!(t => Ok(t.cell_count()), periodic t => t.cell_count())
}

/// Writes an entry of a buffer, if there is one.
#[inline(always)]
pub(super) fn write_next<T>(places: &mut slice::IterMut<'_, MaybeUninit<T>>, value: T) {
    if let Some(place) = places.next() {
        place.write(value);
    }
}

/// The buffers for facets: their vertices, their cells, and the corners opposite them.
struct Columns<'a> {
    facets: Buffer<'a, u32>,
    cells: Buffer<'a, u32>,
    corners: Buffer<'a, u8>,
    /// For so many facets there is room.
    capacity: usize,
}

impl Columns<'_> {
    /// Writes the `needed` facets that `list` lists, if the buffers are large enough, and tells their number.
    fn fill<C: Corners<VertexId>>(
        self,
        count: Output<'_, usize>,
        needed: usize,
        list: impl FnOnce(&mut dyn FnMut(BoundaryFacet<C>)) -> Result<()>,
    ) -> Result<(), Failure> {
        let Columns { facets, cells, corners, capacity } = self;
        let offers = [facets.offer(), cells.offer(), corners.offer()];
        fill_all(count, needed, capacity, offers, || {
            let mut vertices = facets.places_if_any(needed * (C::N - 1))?.iter_mut();
            let mut cells = cells.places_if_any(needed)?.iter_mut();
            let mut corners = corners.places_if_any(needed)?.iter_mut();
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
