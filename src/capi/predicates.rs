//! Exact signs for points of the caller's own. They need no triangulation.

use super::guard;
use super::pointers::{Input, Output, given};
use super::status::deldrift_status;
use crate::delaunay::{Dimension, Plane, Space};
use crate::error::{Error, Result};
use crate::motion::check_position;
use crate::predicates::{StaticFilter, incircle, insphere, orient2d, orient3d};

/// The orientation of points, exactly, to *sign: 1, -1 or 0.
///
/// dimension: 2 or 3. points: dimension + 1 points, one after the other, 2 or 3 numbers each. Of 3 points in the
/// plane it is 1 if they are in counter-clockwise order, -1 if they are in clockwise order, and 0 on a line. Of 4
/// points a, b, c, d in space it is the sign of the determinant of the rows b - a, c - a, d - a, and 0 on a plane.
/// The cells of a triangulation have orientation 1. With another point in the place of a corner it tells on which
/// side of the opposite facet that point lies: 1 on the side of the cell, 0 on the facet's line or plane.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE. Constant time, some nanoseconds except close to 0. May be called from any number of threads
/// at once.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_orientation(
    dimension: u32,
    points: *const f64,
    sign: *mut i32,
) -> deldrift_status {
    given!(sign: Output);
    guard::enter(|| {
        let sign = sign.place()?;
        let orientation = match dimension {
            2 => {
                let points = points.cast();
                given!(points: Input);
                orientation_in_plane(points.get()?)?
            }
            3 => {
                let points = points.cast();
                given!(points: Input);
                orientation_in_space(points.get()?)?
            }
            given => return Err(Error::InvalidDimension { given }.into()),
        };
        sign.write(sign_of(orientation));
        Ok(())
    })
}

/// Whether a point is inside the circle or sphere through others, exactly, to *sign: 1 inside, -1 outside, 0 on it.
///
/// dimension: 2 or 3. points: dimension + 2 points, one after the other, 2 or 3 numbers each: those that the circle or
/// sphere goes through, of orientation 1 (deldrift_orientation), and the one that is asked about. If their orientation is
/// -1, the sign is the opposite one. If it is 0, it is that of the determinant alone. Ties are not broken.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE. Constant time, some ten nanoseconds except close to 0. May be called from any number of threads
/// at once.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_in_sphere(
    dimension: u32,
    points: *const f64,
    sign: *mut i32,
) -> deldrift_status {
    given!(sign: Output);
    guard::enter(|| {
        let sign = sign.place()?;
        let side = match dimension {
            2 => {
                let points = points.cast();
                given!(points: Input);
                side_of_circle(points.get()?)?
            }
            3 => {
                let points = points.cast();
                given!(points: Input);
                side_of_sphere(points.get()?)?
            }
            given => return Err(Error::InvalidDimension { given }.into()),
        };
        sign.write(sign_of(side));
        Ok(())
    })
}

/// The sign of a determinant.
fn sign_of(determinant: f64) -> i32 {
    i32::from(determinant > 0.0) - i32::from(determinant < 0.0)
}

fn check_points<G: Dimension>(points: &[G::Point]) -> Result<()> {
    points
        .iter()
        .enumerate()
        .try_for_each(|(index, point)| check_position::<G>("points", index, point).map(|_| ()))
}

fn orientation_in_plane(points: &[[f64; 2]; 3]) -> Result<f64> {
    check_points::<Plane>(points)?;
    let [a, b, c] = points;
    Ok(orient2d(&of_plane(), a, b, c))
}

fn orientation_in_space(points: &[[f64; 3]; 4]) -> Result<f64> {
    check_points::<Space>(points)?;
    let [a, b, c, d] = points;
    Ok(orient3d(&of_space(), a, b, c, d))
}

fn side_of_circle(points: &[[f64; 2]; 4]) -> Result<f64> {
    check_points::<Plane>(points)?;
    let [a, b, c, d] = points;
    Ok(incircle(&of_plane(), a, b, c, d))
}

fn side_of_sphere(points: &[[f64; 3]; 5]) -> Result<f64> {
    check_points::<Space>(points)?;
    let [a, b, c, d, e] = points;
    Ok(insphere(&of_space(), a, b, c, d, e))
}

/// The filter of no box, which leaves the bound to the points' own extents.
fn of_plane() -> StaticFilter {
    StaticFilter::plane([1.0; 2], [-1.0; 2])
}

/// The filter of no box in space.
fn of_space() -> StaticFilter {
    StaticFilter::space([1.0; 3], [-1.0; 3])
}
