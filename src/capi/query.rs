//! Queries: cells, and what is where. None changes the triangulation.

use super::handle::{Reading, deldrift_triangulation, tell};
use super::pointers::{Buffer, Input, Output, Point, Points, fill_all, given, start_of, write_all};
use super::status::{Failure, deldrift_status};
use crate::delaunay::{Dimension, IndexSet};
use crate::ids::{CellId, VertexId};
use crate::in_its_dimension;
use crate::motion::{CellsView, Level, Location, MovingTriangulation, NO_CELL, cells_at};

/// No cell, no vertex: the neighbour of a cell across a facet of the convex hull, the nearest vertex of
/// an empty triangulation.
pub const DELDRIFT_NONE: u32 = u32::MAX;
const _: () = assert!(DELDRIFT_NONE == NO_CELL.get());

/// The cells of a triangulation: triangles in 2D, tetrahedra in 3D. Read-only, without a copy, valid
/// until the next call that changes the triangulation.
///
/// Cells are positively oriented: the vertices of a triangle are in counter-clockwise order; of a
/// tetrahedron a, b, c, d, the determinant of the rows b - a, c - a, d - a is positive.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct deldrift_cells_view {
    /// Number of cells.
    pub count: usize,
    /// 3 in 2D, 4 in 3D.
    pub corners_per_cell: u32,
    /// count rows of corners_per_cell vertex ids. NULL if there are no cells.
    pub vertices: *const u32,
    /// count rows of corners_per_cell cell indices: entry i of a row is the cell on the other side of
    /// the facet opposite vertex i, DELDRIFT_NONE on the hull. NULL if there are no cells.
    pub neighbours: *const u32,
}

/// A list of cell indices that belongs to the triangulation, valid until the next call that changes it.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct deldrift_indices_view {
    /// Number of indices.
    pub count: usize,
    /// The indices, in ascending order. NULL if there are none.
    pub indices: *const u32,
}

/// How a point lies to what the index of a deldrift_location names.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum deldrift_location_kind {
    /// At the place of a vertex: index is its id, the lowest one if several share the place.
    DELDRIFT_LOCATION_VERTEX = 0,
    /// In a cell or on its boundary, at no vertex: index is that of the cell.
    DELDRIFT_LOCATION_CELL = 1,
    /// Outside the convex hull: index is that of a cell with a hull facet that faces the place.
    DELDRIFT_LOCATION_OUTSIDE = 2,
    /// There are no cells, as the vertices do not span the dimension, and no vertex is at the place: index is
    /// DELDRIFT_NONE. At the place of a vertex the kind is DELDRIFT_LOCATION_VERTEX, with or without cells.
    DELDRIFT_LOCATION_NO_CELLS = 3,
}

/// Where a point lies.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct deldrift_location {
    /// What index names.
    pub kind: deldrift_location_kind,
    /// A vertex or a cell.
    pub index: u32,
}

impl From<Location> for deldrift_location {
    fn from(location: Location) -> Self {
        let (kind, index) = match location {
            Location::Vertex(vertex) => (deldrift_location_kind::DELDRIFT_LOCATION_VERTEX, vertex.get()),
            Location::Cell(cell) => (deldrift_location_kind::DELDRIFT_LOCATION_CELL, cell.get()),
            Location::Outside(cell) => (deldrift_location_kind::DELDRIFT_LOCATION_OUTSIDE, cell.get()),
            Location::NoCells => (deldrift_location_kind::DELDRIFT_LOCATION_NO_CELLS, DELDRIFT_NONE),
        };
        Self { kind, index }
    }
}

const _: () = assert!(size_of::<deldrift_location>() == size_of::<[u32; 2]>());

/// The location that a program gives to begin a search at, if it gives one that has a meaning. Its kind may be any
/// number.
pub(super) fn hint_at(given: Input<'_, [u32; 2]>) -> Result<Option<Location>, Failure> {
    Ok(given.if_any()?.and_then(|&[kind, index]| hint(kind, index)))
}

/// A location, if its kind has a meaning.
fn hint(kind: u32, index: u32) -> Option<Location> {
    use deldrift_location_kind::*;
    let (vertex, cell) = (VertexId::new(index), CellId::new(index));
    [
        (DELDRIFT_LOCATION_VERTEX, Location::Vertex(vertex)),
        (DELDRIFT_LOCATION_CELL, Location::Cell(cell)),
        (DELDRIFT_LOCATION_OUTSIDE, Location::Outside(cell)),
    ]
    .into_iter()
    .find(|&(code, _)| code as u32 == kind)
    .map(|(_, location)| location)
}

/// The cells, without a copy, to *view.
///
/// The first call of all makes the arrays. They are kept: the first call after a change brings them up
/// to date, in time proportional to what has changed, and further calls take constant time. A cell that
/// exists before and after a change keeps its index, whatever the algorithm, unless cells have become
/// fewer: then the last ones take the free indices (see deldrift_take_changes). Calls on several threads are
/// legal, the first included.
///
/// Cost: m for the first call of all; after a change what has changed; else constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_cells(
    t: *const deldrift_triangulation,
    view: *mut deldrift_cells_view,
) -> deldrift_status {
    given!(t: Reading, view: Output);
    tell!(t, view => view_of_cells(t)?)
}

/// A copy of the cells: see deldrift_cells_view for what the rows mean.
///
/// vertices, neighbours: buffers with room for capacity rows of 3 (2D) or 4 (3D) numbers; one that is
/// NULL is not filled. count: receives the number of cells, which is also written when the buffers are
/// too small. NULL for both with capacity 0 asks for the count alone, with another it is DELDRIFT_NULL_ARGUMENT.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_copy_cells(
    t: *const deldrift_triangulation,
    vertices: *mut u32,
    neighbours: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, count: Output);
    t.read(|t| {
        in_its_dimension!(t => {
            let (vertices, neighbours) = (vertices.cast(), neighbours.cast());
            given!(vertices[capacity]: Buffer, neighbours[capacity]: Buffer);
            let cells = t.cells()?;
            let needed = cells.corners.len();
            fill_all(count, needed, capacity, [vertices.offer(), neighbours.offer()], || {
                // Both are looked at before anything is written.
                let (vertices, neighbours) = (vertices.places_if_any(needed)?, neighbours.places_if_any(needed)?);
                write_all(vertices, cells.corners.iter().copied());
                write_all(neighbours, cells.neighbours.iter().copied());
                Ok(())
            })
        })
    })
}

/// The star of a vertex: the indices of the cells that have it as a corner, in no particular order; for
/// a hidden vertex those of its representative.
///
/// cells: a buffer with room for capacity indices. count: receives their number, which is also written
/// when the buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Cost: the cells of the star.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NO_SUCH_VERTEX,
/// DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX if its insertion is staged, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY. After a change the first call also does what the first deldrift_cells does; else the cost is that of the star. Where there are more vertices
/// than a cache holds, stars are read fastest in the order of the ids.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_star(
    t: *const deldrift_triangulation,
    vertex: u32,
    cells: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, cells[capacity]: Buffer, count: Output);
    t.read(|t| {
        let mut slots = IndexSet::new();
        let (index_of, needed) = in_its_dimension!(t => t.list_star(VertexId::new(vertex), &mut slots))?;
        cells.fill(count, needed, || Ok(cells_at(&slots, index_of).map(CellId::get)))
    })
}

/// The tolerance of a vertex, to *out: while every vertex stays closer to its current position than its
/// tolerance, no cell changes.
///
/// It is a certified lower bound: rounding can make it smaller, but never too large. It is 0 where nothing
/// is certain and for vertices that share their place, and infinite, without a meaning, while there are no
/// cells. Computed from the star of the vertex, whatever the algorithm in force.
///
/// Cost: the cells of the star.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NO_SUCH_VERTEX,
/// DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX if its insertion is staged, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_tolerance(
    t: *const deldrift_triangulation,
    vertex: u32,
    out: *mut f64,
) -> deldrift_status {
    given!(t: Reading, out: Output);
    tell!(t, out => t.tolerance(VertexId::new(vertex))?)
}

/// The annulus widths of all bi-cells: entry i of the row of a cell, in the order of deldrift_cells, is
/// that of the bi-cell at the facet opposite corner i. Each bi-cell is there twice, from either side;
/// facets of the hull have none, and their entries are NaN.
///
/// A bi-cell is a facet with the two cells that share it. Its annulus is between two circles or spheres
/// with the same centre: the inner one through the vertices of the facet, the outer one through the two
/// vertices opposite it. The widths are certified lower bounds, 0 where nothing is certain.
///
/// widths: a buffer with room for capacity numbers. count: receives the number of entries, 3 (2D) or 4 (3D)
/// times that of the cells, which is also written when the buffer is too small. NULL with capacity 0 asks
/// for the count alone.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_annulus_widths(
    t: *const deldrift_triangulation,
    widths: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, widths[capacity]: Buffer, count: Output);
    t.read(|t| {
        in_its_dimension!(t => {
            let needed = t.cell_count() * (dimension_of(t) + 1);
            widths.fill(count, needed, || Ok(t.annulus_widths()?))
        })
    })
}

/// The standard delimiter of a bi-cell: the circle or sphere in the middle of its annulus, see
/// deldrift_annulus_widths, which has the vertices of the facet inside and the two opposite it outside.
///
/// cell, corner: the facet opposite this corner (0, 1, ...) of this cell, an index into deldrift_cells.
/// centre: receives 2 or 3 numbers, which are not finite where none could be computed. tolerance: receives
/// the certified tolerance of the bi-cell, which those of its vertices do not exceed; half the annulus
/// width in 2D, and at most that in 3D, where other changes may come sooner.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NO_SUCH_FACET,
/// DELDRIFT_NO_DELIMITER for a facet of the hull, DELDRIFT_OUT_OF_MEMORY. After a change the first call also
/// does what the first deldrift_cells does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_standard_delimiter(
    t: *const deldrift_triangulation,
    cell: u32,
    corner: u32,
    centre: *mut f64,
    radius: *mut f64,
    tolerance: *mut f64,
) -> deldrift_status {
    given!(t: Reading, radius: Output, tolerance: Output);
    t.read(|t| {
        in_its_dimension!(t => {
            let centre = centre.cast();
            given!(centre: Output);
            let (centre, radius, tolerance) = (centre.place()?, radius.place()?, tolerance.place()?);
            check_facet(t, cell, corner)?;
            let delimiter =
                t.standard_delimiter(CellId::new(cell), corner)?.ok_or(Failure::HullFacet { cell, corner })?;
            centre.write(delimiter.centre);
            radius.write(delimiter.radius);
            tolerance.write(delimiter.tolerance);
        });
        Ok(())
    })
}

/// Where a point lies, exactly, to *location.
///
/// position: 2 or 3 numbers.
///
/// Cost: the cells that a walk crosses from where an earlier one ended, or from a vertex that is near: a few for most
/// sets, m at most. While there are no cells, constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY. After a change the first call also does what the first
/// deldrift_cells does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_locate(
    t: *const deldrift_triangulation,
    position: *const f64,
    location: *mut deldrift_location,
) -> deldrift_status {
    given!(t: Reading, position: Point, location: Output);
    tell!(t, location => t.locate(position.of(t)?)?.into())
}

/// Where count points lie, exactly, to locations, which has room for count: as count calls of deldrift_locate,
/// and faster if each point is near the one before it.
///
/// positions: 2 or 3 numbers for each point; NULL if count is 0, as may locations be. hint: where to begin to look
/// for the first point, for example the last answer of the call before; NULL if nothing is known. It only
/// matters for speed: it may be far away, from before a change, or name nothing. It may be one of locations.
///
/// Cost: count times that of deldrift_locate.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY; then nothing is written. After a change the first call also
/// does what the first deldrift_cells does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_locate_points(
    t: *const deldrift_triangulation,
    positions: *const f64,
    count: usize,
    hint: *const deldrift_location,
    locations: *mut deldrift_location,
) -> deldrift_status {
    let hint = hint.cast();
    given!(t: Reading, positions[count]: Points, hint: Input, locations[count]: Buffer);
    t.read(|t| {
        in_its_dimension!(t => {
            if count == 0 {
                return Ok(());
            }
            let positions = positions.of(t)?;
            let hint = hint_at(hint)?;
            let mut places = locations.places(count)?.iter_mut();
            t.locate_points(positions, hint, |location| {
                places.next().expect("as many as positions").write(location.into());
            })?;
            Ok(())
        })
    })
}

/// The vertex nearest to a point, to *vertex: the lowest id among the nearest; DELDRIFT_NONE if the
/// triangulation has no vertices.
///
/// position: 2 or 3 numbers.
///
/// Cost: that of deldrift_locate, and the stars of the vertices on the way and of all that are nearest. While there are
/// no cells, n.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_nearest_vertex(
    t: *const deldrift_triangulation,
    position: *const f64,
    vertex: *mut u32,
) -> deldrift_status {
    given!(t: Reading, position: Point, vertex: Output);
    tell!(t, vertex => t.nearest_vertex(position.of(t)?)?.map_or(DELDRIFT_NONE, VertexId::get))
}

/// The lowest id among the vertices at the place of this one, to *representative: the one that is a
/// corner of cells. It is the vertex itself unless the vertex is hidden.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX if its
/// insertion is staged.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_coincident_representative(
    t: *const deldrift_triangulation,
    vertex: u32,
    representative: *mut u32,
) -> deldrift_status {
    given!(t: Reading, representative: Output);
    tell!(t, representative => t.coincident_representative(VertexId::new(vertex))?.get())
}

/// The cells of now that did not exist before the latest commit, to *view, as indices into
/// deldrift_cells. Cells that immediate calls have made since that commit are among them; before the
/// first commit there are none. Needs track_changes in the options.
///
/// Cost: what has changed.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_CHANGES_NOT_TRACKED, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_changed_cells(
    t: *const deldrift_triangulation,
    view: *mut deldrift_indices_view,
) -> deldrift_status {
    given!(t: Reading, view: Output);
    tell!(t, view => {
        let changed = CellId::numbers_of(t.changed_cells()?);
        deldrift_indices_view { count: changed.len(), indices: start_of(changed) }
    })
}

/// Checks the triangulation exactly, in time proportional to its size.
///
/// level: 1 checks indices and adjacency; 2 also the orientation of the cells, and that the hull is
/// convex and winds once; 3 also that no sphere through the vertices of a cell contains a vertex.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_INVALID_LEVEL, DELDRIFT_INVALID if something is wrong:
/// deldrift_last_error then gives the first violation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_validate(t: *const deldrift_triangulation, level: u32) -> deldrift_status {
    given!(t: Reading);
    t.read(|t| {
        let level = match level {
            1 => Level::Structure,
            2 => Level::Embedding,
            3 => Level::Delaunay,
            given => return Err(Failure::Level { given }),
        };
        in_its_dimension!(t => t.validate(level)).map_err(Failure::Invalid)
    })
}

fn view_of_cells<G: Dimension>(t: &MovingTriangulation<G>) -> Result<deldrift_cells_view, Failure> {
    let CellsView { corners, neighbours } = t.cells()?;
    // A row of ids is a row of their numbers.
    Ok(deldrift_cells_view {
        count: corners.len(),
        corners_per_cell: G::D as u32 + 1,
        vertices: start_of(corners).cast(),
        neighbours: start_of(neighbours).cast(),
    })
}

/// There must be a facet opposite this corner of this cell.
pub(super) fn check_facet<G: Dimension>(
    t: &MovingTriangulation<G>,
    cell: u32,
    corner: u32,
) -> Result<(), Failure> {
    let (cells, corners) = (t.cell_count(), dimension_of(t) + 1);
    if cell as usize >= cells || corner as usize >= corners {
        return Err(Failure::NoSuchFacet { cell, corner, cells, corners });
    }
    Ok(())
}

/// The number of coordinates of a point of `t`.
pub(super) fn dimension_of<G: Dimension>(_t: &MovingTriangulation<G>) -> usize {
    G::D
}
