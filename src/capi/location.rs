//! Where points lie, and which vertices are near.

use std::iter::repeat_n;

use super::handle::{
    Content, Reading, by_kind, deldrift_triangulation, in_any, in_its_period, tell_any, with_weights,
};
use super::pointers::{Buffer, InBuffer, Input, Output, Point, Points, fill_all, given, write_all};
use super::query::DELDRIFT_NONE;
use super::status::{Failure, deldrift_status};
use crate::ids::{CellId, VertexId};
use crate::in_its_dimension;
use crate::motion::Location;

/// What the index of a deldrift_location refers to.
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

impl InBuffer for deldrift_location {}

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

/// Where a point lies, exactly, to *location.
///
/// In a periodic triangulation the location is that of the translation of a vertex or a cell that is there;
/// deldrift_locate_in_period tells which one. A point can be outside only where the box is open in some direction.
///
/// Cost: the cells that a walk crosses from where an earlier one ended, or from a vertex that is near: a few for most
/// sets, m at most. While there are no cells, constant; n in a periodic one.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_locate(
    t: *const deldrift_triangulation,
    position: *const f64,
    location: *mut deldrift_location,
) -> deldrift_status {
    given!(t: Reading, position: Point, location: Output);
    tell_any!(t, location => t.locate(&position.of("position", t)?)?.into())
}

/// Where count points lie, exactly, to locations, which has room for count. It gives what count calls of
/// deldrift_locate give, and is faster if each point is near the one before it. deldrift_locate_in_period also tells in
/// which period of a periodic triangulation.
///
/// hint: where to begin to look for the first point, for example the last answer of the call before; NULL if nothing is
/// known. It only matters for speed: it may be far away, from before a change, or name nothing. It may be one of
/// locations.
///
/// Cost: count times that of deldrift_locate.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
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
    t.read_any(|t| locate(t, positions, count, hint_at(hint)?, locations, None))
}

/// Where count points lie, exactly, to locations, and in which period, to shifts. It is deldrift_locate_points for
/// programs that need the places of the corners.
///
/// positions, hint, locations: as for deldrift_locate_points. shifts: receives a row of 2 (2D) or 3 (3D) whole numbers
/// for each point, multiples of the vectors, 0 beyond the last of these. Translated by them, the vertex is at the
/// point, or the cell of deldrift_cell_shifts has the point; where the point is outside, the cell then has a facet of
/// the hull that faces it. So a corner of the cell is at its position and the sum of these multiples and of its own.
///
/// All shifts are 0 where there are no cells or vertices at the point, and where the triangulation is not periodic.
///
/// Cost: count times that of deldrift_locate.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_locate_in_period(
    t: *const deldrift_triangulation,
    positions: *const f64,
    count: usize,
    hint: *const deldrift_location,
    locations: *mut deldrift_location,
    shifts: *mut i64,
) -> deldrift_status {
    let hint = hint.cast();
    given!(t: Reading, positions[count]: Points, hint: Input, locations[count]: Buffer);
    t.read_any(|t| {
        let n_numbers = count.saturating_mul(t.dimension() as usize);
        given!(shifts[n_numbers]: Buffer);
        locate(t, positions, count, hint_at(hint)?, locations, Some((shifts, n_numbers)))
    })
}

/// Tells where points are, and by which shifts what is there is to be translated, with the number of these.
fn locate(
    t: &Content,
    positions: Points<'_>,
    count: usize,
    hint: Option<Location>,
    locations: Buffer<'_, deldrift_location>,
    shifts: Option<(Buffer<'_, i64>, usize)>,
) -> Result<(), Failure> {
    if count == 0 {
        return Ok(());
    }
    let mut places = locations.places(count)?.iter_mut();
    let mut shifts = shifts.map_or(Ok(&mut [][..]), |(shifts, n_numbers)| shifts.places(n_numbers))?;
    let mut tell = |location: Location| {
        places.next().expect("as many as positions").write(location.into());
    };
    let d = t.dimension() as usize;
    by_kind!(t => t.locate_points(&positions.of(t)?, hint, tell)?, periodic t => {
        let mut rows = shifts.chunks_exact_mut(d);
        t.locate_in_period(&positions.of(t)?, hint, |location, shift| {
            tell(location);
            rows.next().into_iter().for_each(|row| write_all(row, shift));
        })?;
        shifts = &mut [];
    });
    let n_open = shifts.len();
    write_all(shifts, repeat_n(0, n_open));
    Ok(())
}

/// The vertex nearest to a point, to *vertex. Of several it is the one of the lowest id, or, where vertices have keys,
/// of the lowest key. It is DELDRIFT_NONE if the triangulation has no vertices.
///
/// In a periodic triangulation the distance is that of the nearest image of a vertex.
///
/// Cost: that of deldrift_locate, and the stars of the vertices on the way and of all that are nearest. While there are
/// no cells, n.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_nearest_vertex(
    t: *const deldrift_triangulation,
    position: *const f64,
    vertex: *mut u32,
) -> deldrift_status {
    given!(t: Reading, position: Point, vertex: Output);
    t.tell_any(vertex, |t| {
        let nearest = in_any!(t => t.nearest_vertex(&position.of("position", t)?)?);
        Ok(nearest.map_or(DELDRIFT_NONE, VertexId::get))
    })
}

/// The vertex that represents this one in cells, to *representative. It is the one of the lowest id at the same place,
/// or, where vertices have keys, of the lowest key and then of the lowest id; with weights the heaviest one before these.
/// It is the vertex itself unless that is hidden.
///
/// Cost: constant; n for a hidden vertex of a triangulation with weights.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY if t has weights, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_coincident_representative(
    t: *const deldrift_triangulation,
    vertex: u32,
    representative: *mut u32,
) -> deldrift_status {
    given!(t: Reading, representative: Output);
    tell_any!(t, representative => t.coincident_representative(VertexId::new(vertex))?.get())
}

/// The vertices that are hidden by place, ascending, each with the one that represents it. In a periodic triangulation vertices
/// share a place if they do in any period.
///
/// vertices, representatives: buffers with room for capacity ids each. count: receives the number of hidden vertices.
///
/// Cost: n; constant where there are none, and for the count alone; n for a periodic triangulation, and for one with
/// weights.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY if t is periodic or has weights.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_hidden_vertices(
    t: *const deldrift_triangulation,
    vertices: *mut u32,
    representatives: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, vertices[capacity]: Buffer, representatives[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        // Without weights those of an open triangulation are counted at once, and listed without a copy.
        let hidden = match t {
            Content::Open(t) => in_its_dimension!(t => {
                let needed = t.hidden_count();
                return fill_pairs([vertices, representatives], count, (needed, capacity), || t.hidden_vertices());
            }),
            Content::Weighted(t) => with_weights!(&**t, t => t.hidden_by_place()?),
            Content::Periodic(t) => in_its_period!(t, t => t.hidden_vertices()?),
        };
        fill_pairs([vertices, representatives], count, (hidden.len(), capacity), || hidden.iter().copied())
    })
}

/// Fills two buffers with as many pairs of vertices as are needed.
fn fill_pairs<I: Iterator<Item = (VertexId, VertexId)>>(
    [firsts, seconds]: [Buffer<'_, u32>; 2],
    count: Output<'_, usize>,
    (needed, capacity): (usize, usize),
    pairs: impl Fn() -> I,
) -> Result<(), Failure> {
    fill_all(count, needed, capacity, [firsts.offer(), seconds.offer()], || {
        let (firsts, seconds) = (firsts.places_if_any(needed)?, seconds.places_if_any(needed)?);
        write_all(firsts, pairs().map(|(vertex, _)| vertex.get()));
        write_all(seconds, pairs().map(|(_, other)| other.get()));
        Ok(())
    })
}

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
