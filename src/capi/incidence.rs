//! What meets what: edges, neighbours and cells of vertices, mirror indices, ordered stars.

use super::handle::{Content, Reading, by_kind, deldrift_triangulation, in_any, tell_any};
use super::interpolation::check_product;
use super::pointers::{Array, Buffer, Output, fill_all, fit, given, write_all};
use super::query::{DELDRIFT_NONE, check_facet, corners_of, dimension_of};
use super::status::{Failure, deldrift_status};
use crate::either::{AnyTriangulation, AnyWeighted};
use crate::error::{Error, Result};
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::{Rows, check_corners};
use crate::periodic::AnyPeriodic;

/// The edges: rows of two vertex ids, the lower one first, each edge once, in lexicographic order. They depend on
/// positions and ids alone.
///
/// edges: a buffer with room for capacity rows. count: receives the number of edges. The count alone takes constant
/// time.
///
/// Takes some passes over the cells, and memory for the cells of each vertex while it runs.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_edges(
    t: *const deldrift_triangulation,
    edges: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let edges = edges.cast::<[VertexId; 2]>();
    given!(t: Reading, edges[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        by_kind!(t => edges.fill(count, t.edge_count(), || Ok(t.edges()?)), periodic t => {
            let listed = t.edges()?;
            edges.fill(count, listed.len(), || Ok(listed.map(|(edge, _)| edge)))
        })
    })
}

/// The neighbours of all vertices: for each id the vertices with which it shares an edge, ascending, one list after the
/// other. Removed and hidden vertices have none. The lists depend on positions and ids alone.
///
/// offsets: a buffer for offset_count numbers, which must be deldrift_id_count + 1. The list of vertex v begins in
/// neighbours at the index that is entry v of offsets, and ends before entry v + 1. neighbours: a buffer with room for
/// capacity ids. Where offsets is NULL, offset_count is not looked at; without neighbours capacity must be 0. count:
/// receives the number of entries, twice that of the edges. The count alone takes constant time.
///
/// In a periodic triangulation a vertex is listed once for each edge that leads to it: several times where edges lead
/// to it in several periods, and twice in its own list for each edge to itself.
///
/// Takes some passes over the cells, and while it runs memory for the lists and for the cells of each vertex.
///
/// Cost: n + m, and d log d for the d neighbours of each vertex; m log m for a periodic triangulation.
///
/// Errors: DELDRIFT_WRONG_COUNT, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_vertex_neighbours(
    t: *const deldrift_triangulation,
    offsets: *mut u32,
    offset_count: usize,
    neighbours: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, offsets[offset_count]: Buffer, neighbours[capacity]: Buffer, count: Output);
    let lists = Lists { offsets, offset_count, entries: neighbours, capacity };
    t.read_any(|t| {
        by_kind!(t => {
            let needed = 2 * t.edge_count();
            lists.fill(id_counts!(t), count, needed, || t.vertex_neighbours(), VertexId::numbers_of)
        }, periodic t => {
            let made = t.vertex_neighbours()?;
            lists.fill(id_counts!(t), count, made.entries.len(), || Ok(made), VertexId::numbers_of)
        })
    })
}

/// The cells of all vertices: for each id the indices of the cells that have it as a corner, ascending, one list
/// after the other. Removed and hidden vertices have none.
///
/// offsets: a buffer for offset_count numbers, which must be deldrift_id_count + 1. The list of vertex v begins in
/// cells at the index that is entry v of offsets, and ends before entry v + 1. cells: a buffer with room for capacity
/// indices. Where offsets is NULL, offset_count is not looked at; without cells capacity must be 0. count: receives the
/// number of entries, 3 (2D) or 4 (3D) times that of the cells. The count alone takes constant time.
///
/// In a periodic triangulation a cell is listed once for each of its corners that is the vertex, in whatever period.
///
/// Takes two passes over the cells, and memory for the lists while it runs.
///
/// Cost: n + m; m log m for a periodic triangulation.
///
/// Errors: DELDRIFT_WRONG_COUNT, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_vertex_cells(
    t: *const deldrift_triangulation,
    offsets: *mut u32,
    offset_count: usize,
    cells: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, offsets[offset_count]: Buffer, cells[capacity]: Buffer, count: Output);
    let lists = Lists { offsets, offset_count, entries: cells, capacity };
    t.read_any(|t| {
        by_kind!(t => {
            let needed = t.cell_count() * (dimension_of(t) + 1);
            lists.fill(id_counts!(t), count, needed, || t.vertex_cells(), CellId::numbers_of)
        }, periodic t => {
            let made = t.vertex_cells()?;
            lists.fill(id_counts!(t), count, made.entries.len(), || Ok(made), CellId::numbers_of)
        })
    })
}

/// A cell of each vertex: for each id the index of the first cell of which the vertex is a corner. Vertices that are
/// hidden or removed, or whose insertion is staged, have DELDRIFT_NONE, and so have all while there are no cells.
///
/// cells: a buffer with room for capacity indices. count: receives deldrift_id_count.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_cell_of_each_vertex(
    t: *const deldrift_triangulation,
    cells: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, cells[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        in_any!(t => {
            let first = || Ok(t.cell_of_each_vertex()?.into_iter().map(CellId::get));
            cells.fill(count, t.id_count(), first)
        })
    })
}

/// Cells that have given vertices as corners: for each of count simplices the index of one, DELDRIFT_NONE if there is
/// none. So it tells which edges of a list are in the triangulation, and which facets.
///
/// corners_per_simplex: 1 (a cell of each vertex), 2 (edges), 3 (triangles) or, in 3D, 4. vertices: count rows of as
/// many ids, in any order. A hidden vertex stands for the one that represents it. A simplex with two corners at the
/// same place is in no cell, unless t is periodic and a cell has them in different periods. cells: receives count
/// indices.
///
/// Cost: for each simplex the least number of cells that a corner of it has. Where there are more simplices than an
/// eighth of the vertices, also n + m.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_VALUE for another number of corners, DELDRIFT_NO_SUCH_VERTEX,
/// DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_find_simplices(
    t: *const deldrift_triangulation,
    corners_per_simplex: u32,
    vertices: *const u32,
    count: usize,
    cells: *mut u32,
) -> deldrift_status {
    let n_corners = corners_per_simplex as usize;
    let n_ids = count.saturating_mul(n_corners);
    given!(t: Reading, vertices[n_ids]: Array, cells[count]: Buffer);
    t.read_any(|t| {
        check_corners(t.dimension() as usize, n_corners)?;
        in_any!(t => {
            check_product::<u32>("vertices", count, n_corners)?;
            let vertices = VertexId::of_numbers(vertices.get()?);
            let places = cells.places(count)?;
            let mut made = Vec::new();
            memory::reserve_exact(&mut made, count)?;
            t.find_simplices(vertices, n_corners, |cell| made.push(cell.map_or(DELDRIFT_NONE, CellId::get)))?;
            write_all(places, made);
            Ok(())
        })
    })
}

/// The mirror indices of all facets, in the order of deldrift_cells. Entry i of the row of a cell is about the facet
/// opposite corner i. It is the corner (0, 1, ...) of the neighbour beyond that is opposite the same facet, 255 on the
/// hull. In a periodic triangulation a cell may be its own neighbour.
///
/// mirrors: a buffer with room for capacity rows of 3 (2D) or 4 (3D) bytes. count: receives the number of cells.
///
/// Cost: m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_mirror_indices(
    t: *const deldrift_triangulation,
    mirrors: *mut u8,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, count: Output);
    t.read_any(|t| {
        in_any!(t => {
            let cells = t.cells()?;
            let (needed, n_corners) = (cells.corners.len(), corners_of(cells.corners));
            given!(mirrors[capacity.saturating_mul(n_corners)]: Buffer);
            fill_all(count, needed, capacity, [mirrors.offer()], || {
                let places = mirrors.places(needed * n_corners)?;
                for (row, indices) in places.chunks_exact_mut(n_corners).zip(t.mirror_indices()?) {
                    write_all(row, indices);
                }
                Ok(())
            })
        })
    })
}

/// The mirror index of one facet, to *mirror: the corner of the neighbour beyond that is opposite the same facet,
/// DELDRIFT_NONE on the hull.
///
/// cell, corner: the facet opposite this corner (0, 1, ...) of this cell, an index into deldrift_cells.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NO_SUCH_FACET, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_mirror_index(
    t: *const deldrift_triangulation,
    cell: u32,
    corner: u32,
    mirror: *mut u32,
) -> deldrift_status {
    given!(t: Reading, mirror: Output);
    tell_any!(t, mirror => {
        check_facet(t.cells()?.corners, cell, corner)?;
        let index = t.mirror_index(CellId::new(cell), corner as usize)?;
        index.map_or(DELDRIFT_NONE, |index| index as u32)
    })
}

/// The star of a vertex of the plane, counter-clockwise: the indices of the cells that have it as a corner. Each cell
/// shares an edge with the next one, and the last one with the first one, unless the vertex is on the convex hull.
/// There the first cell is the one at the hull's edge that leaves the vertex when the hull is passed counter-clockwise.
/// Elsewhere it is the one of lowest index. A hidden vertex has the star of its representative.
///
/// cells: a buffer with room for capacity indices. count: receives their number.
///
/// Cost: the cells of the star.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX,
/// DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_ordered_star(
    t: *const deldrift_triangulation,
    vertex: u32,
    cells: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, cells[capacity]: Buffer, count: Output);
    let vertex = VertexId::new(vertex);
    // Each kind of triangulation has an iterator of its own.
    macro_rules! fill {
        ($t:ident) => {{
            let star = $t.ordered_star(vertex)?;
            cells.fill(count, star.clone().count(), || Ok(star.map(CellId::get)))
        }};
    }
    t.read_any(|t| match t {
        Content::Open(AnyTriangulation::Plane(t)) => fill!(t),
        Content::Open(AnyTriangulation::Space(_)) => Err(Failure::NotOfThePlane),
        Content::Weighted(t) => match &**t {
            AnyWeighted::Plane(t) => fill!(t),
            AnyWeighted::Space(_) => Err(Failure::NotOfThePlane),
        },
        Content::Periodic(t) => match &**t {
            AnyPeriodic::Plane(t) => fill!(t),
            AnyPeriodic::PowerPlane(t) => fill!(t),
            AnyPeriodic::Space(_) | AnyPeriodic::PowerSpace(_) => Err(Failure::NotOfThePlane),
        },
    })
}

/// The number of ids, and how many of them are of staged insertions.
macro_rules! id_counts {
    ($t:ident) => {
        [$t.id_count(), $t.staged_edits().0]
    };
}
use id_counts;

/// The buffers for lists by vertex.
struct Lists<'a> {
    offsets: Buffer<'a, u32>,
    offset_count: usize,
    entries: Buffer<'a, u32>,
    capacity: usize,
}

impl Lists<'_> {
    /// Writes the lists of so many ids, of which some are of staged insertions, with `needed` entries, if the buffers
    /// are large enough, and tells that number.
    fn fill<T>(
        self,
        [n_ids, coming]: [usize; 2],
        count: Output<'_, usize>,
        needed: usize,
        make: impl FnOnce() -> Result<Rows<T>>,
        numbers_of: impl FnOnce(&[T]) -> &[u32],
    ) -> Result<(), Failure> {
        let Lists { offsets, offset_count, entries, capacity } = self;
        let wanted = n_ids + 1;
        if !offsets.is_null() && offset_count != wanted {
            let (argument, given) = ("offset_count", offset_count);
            return Err(Error::WrongCount { argument, given, wanted, coming }.into());
        }
        let fitting = fit(count, needed, capacity, &[entries.offer()])?;
        if !offsets.is_null() || !entries.is_null() {
            let (offsets, entries) = (offsets.places_if_any(wanted)?, entries.places_if_any(needed)?);
            let rows = make()?;
            write_all(offsets, rows.offsets.iter().copied());
            write_all(entries, numbers_of(&rows.entries).iter().copied());
        }
        fitting.tell();
        Ok(())
    }
}
