//! Values between vertices.

use super::handle::{Content, Reading, by_kind, deldrift_triangulation, in_any};
use super::location::{deldrift_location, hint_at};
use super::pointers::{Array, Buffer, Input, Points, given, write_all};
use super::status::{Failure, Wrong, deldrift_status};
use crate::error::Error;
use crate::ids::CellId;
use crate::machine::memory;
use crate::motion::{Interpolation, VertexValues};

/// How values between vertices follow from those at vertices.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum deldrift_interpolation {
    /// Linear in each cell.
    DELDRIFT_INTERPOLATION_LINEAR = 0,
    /// By the natural neighbours of a position, which are the vertices that would share an edge with it. The weight of
    /// each is the length or area of the Voronoi facet between the two over their distance (Laplace's, or non-Sibsonian
    /// interpolation). Smooth except at vertices and on the circles or spheres of cells.
    DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR = 1,
}

/// A method as it arrives from C, where any number may be passed.
pub type InterpolationCode = u32;

/// Interpolates values of the vertices at count positions.
///
/// values: value_count rows of n_values numbers, one for each id (value_count must be deldrift_id_count). Rows of
/// removed vertices are not used, and for a hidden vertex the row of its representative counts. hint: as for
/// deldrift_locate_points. It is fastest if each position is near the one before it. outside: what positions outside
/// the convex hull get, n_values numbers; NULL for NaN. While there are no cells, all positions but those of vertices
/// are outside. results: receives count rows of n_values numbers. values may also be NULL if n_values is 0.
///
/// At the place of a vertex the result is that of the vertex. Elsewhere it is rounded, and linear functions are
/// reproduced but for rounding, with either method. Which cell or which neighbours count is decided exactly. A position
/// takes as long as deldrift_locate_points, and with natural neighbours some microseconds more.
///
/// In a periodic triangulation an image of a vertex has the values of the vertex. Natural neighbours of a position are
/// images, several of one vertex in a small box.
///
/// Cost: count times that of deldrift_locate and n_values; with natural neighbours also the cells whose circle or
/// sphere has the position inside.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_VALUE for a method that this version does not have,
/// DELDRIFT_WRONG_COUNT, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE (of positions), DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_interpolate(
    t: *const deldrift_triangulation,
    method: InterpolationCode,
    values: *const f64,
    value_count: usize,
    n_values: usize,
    positions: *const f64,
    count: usize,
    hint: *const deldrift_location,
    outside: *const f64,
    results: *mut f64,
) -> deldrift_status {
    let (hint, n_known, n_results) =
        (hint.cast(), value_count.saturating_mul(n_values), count.saturating_mul(n_values));
    given!(t: Reading, values[n_known]: Array, positions[count]: Points, hint: Input);
    given!(outside[n_values]: Array, results[n_results]: Buffer);
    t.read_any(|t| {
        let method = method_of(method)?;
        let (wanted, coming) = ids_of(t);
        if value_count != wanted {
            let (argument, given) = ("value_count", value_count);
            return Err(Error::WrongCount { argument, given, wanted, coming }.into());
        }
        check_product::<f64>("values", value_count, n_values)?;
        let values = VertexValues { values: values.get()?, n_values };
        in_any!(t => positions.of(t).map(drop))?;
        check_product::<f64>("results", count, n_values)?;
        let hint = hint_at(hint)?;
        let outside = (!outside.is_null()).then(|| outside.get()).transpose()?;
        let places = results.places(n_results)?;
        let mut made = Vec::new();
        memory::reserve_exact(&mut made, n_results)?;
        let enter = |row: Option<&[f64]>| match row.or(outside) {
            Some(row) => made.extend_from_slice(row),
            None => made.extend(std::iter::repeat_n(f64::NAN, n_values)),
        };
        in_any!(t => t.interpolate(method, values, &positions.of(t)?, hint, enter))?;
        write_all(places, made);
        Ok(())
    })
}

/// The number of ids, and of those that are staged.
fn ids_of(t: &Content) -> (usize, usize) {
    by_kind!(t => (t.id_count(), t.staged_edits().0), periodic t => (t.id_count(), 0))
}

/// The barycentric coordinates of count positions, each in a cell that is given: rows of 3 (2D) or 4 (3D) numbers, one
/// for each corner in the order of deldrift_cells. They are for programs that keep weights, to carry values with them
/// more than once. The weights of deldrift_interpolate may differ in last bits, and more where a cell is flat.
///
/// cells: count indices into deldrift_cells, as deldrift_locate_points gives them. DELDRIFT_NONE is no cell: its row is
/// NaN. weights: receives count rows. A position may be outside of its cell: then some of its coordinates are negative.
///
/// The sign of each is exact, and so is 0; the value has a relative error of at most 2.5e-13, however flat the cell.
/// (Where an area, a volume or the value itself is below the least normal number, 2.2e-308, it is less accurate.) What
/// is beyond the range of numbers is infinite. A row adds up to 1 but for these errors.
///
/// In a periodic triangulation the weights are those in the translation of the cell that has the position inside or on
/// its boundary; where there is none, the row is NaN.
///
/// Cost: count.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_NO_SUCH_FACET if there is no
/// cell of an index, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_barycentric(
    t: *const deldrift_triangulation,
    positions: *const f64,
    cells: *const u32,
    count: usize,
    weights: *mut f64,
) -> deldrift_status {
    given!(t: Reading, positions[count]: Points, cells[count]: Array);
    t.read_any(|t| {
        let n_corners = t.dimension() as usize + 1;
        in_any!(t => {
            let positions = positions.of(t)?;
            let cells = CellId::of_numbers(cells.get()?);
            check_product::<f64>("weights", count, n_corners)?;
            given!(weights[count * n_corners]: Buffer);
            let mut rows = weights.places(count * n_corners)?.chunks_exact_mut(n_corners);
            t.barycentric(&positions, cells, |found| {
                let row = rows.next().expect("as many as positions");
                match found {
                    Some(found) => write_all(row, found.iter().copied()),
                    None => write_all(row, std::iter::repeat(f64::NAN)),
                }
            })?;
            Ok(())
        })
    })
}

/// The method of a number.
fn method_of(code: InterpolationCode) -> Result<Interpolation, Failure> {
    use deldrift_interpolation::*;
    [
        (DELDRIFT_INTERPOLATION_LINEAR, Interpolation::Linear),
        (DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR, Interpolation::NaturalNeighbour),
    ]
    .into_iter()
    .find(|&(known, _)| known as u32 == code)
    .map(|(_, method)| method)
    .ok_or_else(|| {
        let (argument, wanted) = ("method", "0 or 1");
        Error::InvalidValue { argument, index: 0, value: f64::from(code), wanted }.into()
    })
}

/// `count` rows of `n_values` entries must have a length.
pub(super) fn check_product<T>(argument: &'static str, count: usize, n_values: usize) -> Result<(), Failure> {
    let size = n_values.saturating_mul(size_of::<T>());
    count.checked_mul(n_values).map(|_| ()).ok_or(Wrong::TooLarge { count, size }.in_argument(argument))
}
