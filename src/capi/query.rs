//! Queries: cells, and what is where. None changes the triangulation.

use super::handle::{Changing, Content, Reading, by_kind, deldrift_triangulation, in_any, tell_any};
use super::pointers::{Buffer, Output, Owned, fill_all, given, start_of, write_all};
use super::status::{Failure, deldrift_status};
use crate::complex::Corners;
use crate::delaunay::{IndexSet, Moving, Plane, PowerPlane, PowerSpace, Space};
use crate::either::{AnyTriangulation, AnyWeighted};
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::{Level, MovingTriangulation, NO_CELL, OwnedCells, cells_at};
use crate::periodic::AnyPeriodic;

/// No cell, no vertex. It is the neighbour of a cell across a facet of the convex hull, and the nearest vertex of an
/// empty triangulation.
pub const DELDRIFT_NONE: u32 = u32::MAX;
const _: () = assert!(DELDRIFT_NONE == NO_CELL.get());

/// The cells of a triangulation: triangles in 2D, tetrahedra in 3D. The arrays are those of the library, not a copy:
/// they are read-only, and valid until the next call that changes the triangulation.
///
/// Some calls change no cells: those that stage, that discard what is staged, that take changes, and
/// deldrift_set_algorithm. They keep a view that is not older than the last change. After deldrift_release_cells a view
/// is valid until its owner is freed.
///
/// Cells are positively oriented. The vertices of a triangle are in counter-clockwise order. For a tetrahedron a, b, c,
/// d the determinant of the rows b - a, c - a, d - a is positive.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct deldrift_cells_view {
    /// Number of cells.
    pub count: usize,
    /// 3 in 2D, 4 in 3D.
    pub corners_per_cell: u32,
    /// count rows of corners_per_cell vertex ids. NULL if there are no cells.
    pub vertices: *const u32,
    /// count rows of corners_per_cell cell indices. Entry i of a row is the cell beyond the facet opposite vertex i,
    /// DELDRIFT_NONE on the hull. NULL if there are no cells.
    pub neighbours: *const u32,
}

/// The cells, without a copy, to *view.
///
/// The first call of all makes the arrays, which are kept. The first call after a change brings them up to date, in
/// time proportional to what has changed. Further calls take constant time. A cell that exists before and after a
/// change keeps its index, whatever the algorithm. But where cells have become fewer, the last ones take the free
/// indices (see deldrift_take_changes). Calls on several threads are legal, the first included.
///
/// Cost: m for the first call of all; after a change what has changed; else constant.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_cells(
    t: *const deldrift_triangulation,
    view: *mut deldrift_cells_view,
) -> deldrift_status {
    given!(t: Reading, view: Output);
    tell_any!(t, view => view_of(t.cells()?.corners, t.cells()?.neighbours))
}

/// Arrays of cells that a program has taken over: opaque, made by deldrift_release_cells, unmade by
/// deldrift_free_cells.
#[derive(Debug)]
pub struct deldrift_released_cells {
    arrays: Option<Arrays>,
}

/// The arrays of either dimension, which are only kept: a view reads them.
#[derive(Debug)]
enum Arrays {
    Plane(OwnedCells<Plane>),
    Space(OwnedCells<Space>),
    PowerPlane(OwnedCells<PowerPlane>),
    PowerSpace(OwnedCells<PowerSpace>),
}

/// Hands the arrays of deldrift_cells over to the program, to *view, with an owner for them, to *owner. They stay
/// valid, and as they are, until the owner is handed to deldrift_free_cells, whatever becomes of t.
///
/// Views that deldrift_cells has given since the last change, or the last call of this function, are of these arrays.
/// They are valid until this owner is freed, and no longer. So a program that has shown them to others, such as an
/// interpreter, can call this before it makes a change. Later views are of copies, which belong to t. A commit that
/// fails counts as a change, and so does deldrift_compact.
///
/// Cost: m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY; then nothing is handed over, and views are as valid as before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_release_cells(
    t: *mut deldrift_triangulation,
    view: *mut deldrift_cells_view,
    owner: *mut *mut deldrift_released_cells,
) -> deldrift_status {
    given!(t: Changing, view: Output, owner: Output);
    t.change_any(|t| {
        let (view, owner) = (view.place()?, owner.place()?);
        // Room for the owner first: what has been handed over is not put back.
        let mut room = memory::boxed(deldrift_released_cells { arrays: None })?;
        let arrays = room.arrays.insert(match t {
            Content::Open(AnyTriangulation::Plane(t)) => Arrays::Plane(t.release_cells()?),
            Content::Open(AnyTriangulation::Space(t)) => Arrays::Space(t.release_cells()?),
            Content::Weighted(t) => match &mut **t {
                AnyWeighted::Plane(t) => Arrays::PowerPlane(t.release_cells()?),
                AnyWeighted::Space(t) => Arrays::PowerSpace(t.release_cells()?),
            },
            Content::Periodic(t) => match &mut **t {
                AnyPeriodic::Plane(t) => Arrays::Plane(t.release_cells()?),
                AnyPeriodic::Space(t) => Arrays::Space(t.release_cells()?),
                AnyPeriodic::PowerPlane(t) => Arrays::PowerPlane(t.release_cells()?),
                AnyPeriodic::PowerSpace(t) => Arrays::PowerSpace(t.release_cells()?),
            },
        });
        view.write(match arrays {
            Arrays::Plane(cells) => view_of(&cells.corners, &cells.neighbours),
            Arrays::Space(cells) => view_of(&cells.corners, &cells.neighbours),
            Arrays::PowerPlane(cells) => view_of(&cells.corners, &cells.neighbours),
            Arrays::PowerSpace(cells) => view_of(&cells.corners, &cells.neighbours),
        });
        owner.write(Box::into_raw(room));
        Ok(())
    })
}

/// Frees arrays that deldrift_release_cells has handed over, once. NULL is legal and does nothing; a misaligned pointer
/// does nothing either.
///
/// Cost: m at most, to free memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_free_cells(owner: *mut deldrift_released_cells) {
    given!(owner: Owned);
    owner.free();
}

/// A copy of the cells: see deldrift_cells_view for what the rows mean.
///
/// vertices, neighbours: buffers with room for capacity rows of 3 (2D) or 4 (3D) numbers. count: receives the number of
/// cells.
///
/// Cost: m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_copy_cells(
    t: *const deldrift_triangulation,
    vertices: *mut u32,
    neighbours: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, count: Output);
    t.read_any(|t| {
        in_any!(t => {
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

/// The star of a vertex: the indices of the cells that have it as a corner, in no particular order. A hidden vertex has
/// the star of its representative.
///
/// cells: a buffer with room for capacity indices. count: receives their number.
///
/// In a periodic triangulation a cell is listed once for each of its corners that is the vertex, in whatever period.
///
/// Cost: the cells of the star; m for a periodic triangulation. Where there are more vertices than a cache holds, stars
/// are read fastest in the order of the ids.
///
/// Errors: DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_star(
    t: *const deldrift_triangulation,
    vertex: u32,
    cells: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, cells[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        by_kind!(t => {
            let mut slots = IndexSet::new();
            let (index_of, needed) = t.list_star(VertexId::new(vertex), &mut slots)?;
            cells.fill(count, needed, || Ok(cells_at(&slots, index_of).map(CellId::get)))
        }, periodic t => {
            let star = t.star(VertexId::new(vertex))?;
            cells.fill(count, star.len(), || Ok(star.into_iter().map(CellId::get)))
        })
    })
}

/// The tolerance of a vertex, to *out: while every vertex stays closer to its current position than its
/// tolerance, no cell changes.
///
/// It is a certified lower bound: rounding can make it smaller, but never too large. It is 0 where nothing is certain,
/// and for vertices that share their place. It is infinite, without a meaning, while there are no cells. It is computed
/// from the star of the vertex, whatever the algorithm in force. At segments it is what the orientation of the cells on
/// both sides allows. In a periodic triangulation images move as their vertices do, and the vectors stay. There a vertex
/// that alone makes a side of a slab has 0, as it is on one line with its images.
///
/// Cost: the cells of the star.
///
/// Errors: DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_tolerance(
    t: *const deldrift_triangulation,
    vertex: u32,
    out: *mut f64,
) -> deldrift_status {
    given!(t: Reading, out: Output);
    tell_any!(t, out => t.tolerance(VertexId::new(vertex))?)
}

/// Checks the triangulation exactly, in time proportional to its size.
///
/// level: 1 checks indices and adjacency. 2 also checks the orientation of the cells, and that the hull is convex and
/// winds once. 3 also checks that no sphere through the vertices of a cell contains a vertex. With segments only
/// vertices count that can be seen from the cell's inside. In a periodic triangulation this is checked of what is kept
/// inside, images included. All levels check that images are where the vectors take their vertices. 3 also checks that
/// no image is missing, and that each cell is there once for each of its corners.
///
/// Cost: n + m. Of a periodic triangulation at level 3 that of creation at most, in a copy.
///
/// Errors: DELDRIFT_INVALID_LEVEL, DELDRIFT_INVALID if something is wrong: deldrift_last_error then gives the first
/// violation; DELDRIFT_OUT_OF_MEMORY if t is periodic.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_validate(t: *const deldrift_triangulation, level: u32) -> deldrift_status {
    given!(t: Reading);
    t.read_any(|t| {
        let level = match level {
            1 => Level::Structure,
            2 => Level::Embedding,
            3 => Level::Delaunay,
            given => return Err(Failure::Level { given }),
        };
        by_kind!(t => t.validate(level).map_err(Failure::Invalid), periodic t => {
            let violation = t.violation(level)?;
            violation.map_or(Ok(()), |violation| Err(Failure::Invalid(violation)))
        })
    })
}

fn view_of<V: Copy, N>(corners: &[V], neighbours: &[N]) -> deldrift_cells_view {
    // A row of ids is a row of their numbers.
    deldrift_cells_view {
        count: corners.len(),
        corners_per_cell: (size_of::<V>() / size_of::<u32>()) as u32,
        vertices: start_of(corners).cast(),
        neighbours: start_of(neighbours).cast(),
    }
}

/// There must be a facet opposite this corner of this cell.
pub(super) fn check_facet<V: Corners<VertexId>>(rows: &[V], cell: u32, corner: u32) -> Result<(), Failure> {
    let (cells, corners) = (rows.len(), corners_of(rows));
    if cell as usize >= cells || corner as usize >= corners {
        return Err(Failure::NoSuchFacet { cell, corner, cells, corners });
    }
    Ok(())
}

/// The number of corners of each cell.
pub(super) fn corners_of<V: Corners<VertexId>>(_rows: &[V]) -> usize {
    V::N
}

/// The number of coordinates of a point of `t`.
pub(super) fn dimension_of<G: Moving>(_t: &MovingTriangulation<G>) -> usize {
    G::D
}
