//! Creation, destruction, and what is chosen for the whole life of a triangulation.

use super::guard;
use super::handle::{Changing, Reading, deldrift_triangulation, in_any, tell_any};
use super::options::{self, AlgorithmCode, GivenOptions, deldrift_options};
use super::pointers::{Array, Output, Points, given};
use super::status::{Failure, deldrift_status};
use crate::either::AnyTriangulation;
use crate::in_its_dimension;
use crate::motion::MovingTriangulation;

/// Creates the Delaunay triangulation of count points in the plane or in space, at timestamp 0.
///
/// dimension: 2 or 3. positions: count points, in any unit. Vertex i is the i-th of them until the triangulation is
/// destroyed, or deldrift_compact gives new ids. Any set is legal: the empty one, coincident points, points on one line
/// or plane. Where the points do not span the dimension there are no cells. Every finite coordinate from -1e57 to 1e57
/// is accepted, however close to zero. options: NULL for the defaults.
///
/// out: receives the triangulation.
///
/// Cost: on all sets of docs/COSTS.md n log n and m. No set takes more than n² in 2D, or n m in 3D, where m is the most
/// cells of any subset.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_INVALID_OPTIONS, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_create(
    dimension: u32,
    positions: *const f64,
    count: usize,
    options: *const deldrift_options,
    out: *mut *mut deldrift_triangulation,
) -> deldrift_status {
    given!(positions[count]: Points, options: GivenOptions, out: Output);
    guard::enter(|| create(dimension, positions, None, count, options, out))
}

/// Creates a triangulation, of vertices with these keys if there are some.
pub(super) fn create(
    dimension: u32,
    positions: Points<'_>,
    keys: Option<Array<'_, u64>>,
    count: usize,
    options: GivenOptions<'_>,
    out: Output<'_, *mut deldrift_triangulation>,
) -> Result<(), Failure> {
    let out = out.place()?;
    let (callbacks, options) = options.of_creation(dimension, count)?;
    let mut made = if dimension == 2 {
        deldrift_triangulation::unbuilt(
            #[inline(always)]
            || AnyTriangulation::Plane(MovingTriangulation::unbuilt(options)),
            callbacks,
        )?
    } else {
        deldrift_triangulation::unbuilt(
            #[inline(always)]
            || AnyTriangulation::Space(MovingTriangulation::unbuilt(options)),
            callbacks,
        )?
    };
    match keys {
        Some(keys) => {
            let keys = keys.get()?;
            in_its_dimension!(made.content_mut()?, t => t.build_first_with_keys(&positions.of(t)?, keys))?;
        }
        None => in_its_dimension!(made.content_mut()?, t => t.build_first(&positions.of(t)?))?,
    }
    out.write(Box::into_raw(made));
    Ok(())
}

/// Destroys a triangulation: its memory is freed and its views end. NULL is legal and does nothing. A poisoned
/// triangulation is destroyed like any other. From inside a callback of a call on the same triangulation it does
/// nothing but set deldrift_last_error.
///
/// Cost: n + m at most.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_destroy(t: *mut deldrift_triangulation) {
    given!(t: Changing);
    t.destroy();
}

/// The dimension of the triangulation, 2 or 3, to *dimension.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_dimension(
    t: *const deldrift_triangulation,
    dimension: *mut u32,
) -> deldrift_status {
    given!(t: Reading, dimension: Output);
    t.tell_any(dimension, |t| Ok(t.dimension()))
}

/// Changes the algorithm of later commits. Staged moves stay. Tolerances and delimiters that the new
/// algorithm needs and the old one did not keep are computed by the next commit.
///
/// Cost: n + m at most, to free what the old one keeps.
///
/// Errors: DELDRIFT_INVALID_OPTIONS for a number that is no algorithm of this version.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_set_algorithm(
    t: *mut deldrift_triangulation,
    algorithm: AlgorithmCode,
) -> deldrift_status {
    given!(t: Changing);
    t.change_any(|t| {
        let algorithm = options::algorithm("algorithm", algorithm)?;
        in_any!(t => t.set_algorithm(algorithm));
        Ok(())
    })
}

/// The algorithm in force, to *algorithm. It is the one that was set: DELDRIFT_AUTO where the library chooses, and
/// after deldrift_research_set_algorithm the number of an algorithm of deldrift/research.h.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_get_algorithm(
    t: *const deldrift_triangulation,
    algorithm: *mut AlgorithmCode,
) -> deldrift_status {
    given!(t: Reading, algorithm: Output);
    tell_any!(t, algorithm => t.algorithm().code())
}
