//! Exact signs for points of the caller's own. They need no triangulation.

use super::guard;
use super::pointers::{Input, Output, given};
use super::status::deldrift_status;
use crate::delaunay::{Plane, Space};
use crate::error::{Error, Result};
use crate::motion::check_position;
use crate::predicates::{StaticFilter, orient2d, orient3d};

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
        let determinant = match dimension {
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
        sign.write(i32::from(determinant > 0.0) - i32::from(determinant < 0.0));
        Ok(())
    })
}

fn orientation_in_plane(points: &[[f64; 2]; 3]) -> Result<f64> {
    for (index, point) in points.iter().enumerate() {
        check_position::<Plane>("points", index, point)?;
    }
    let [a, b, c] = points;
    // The filter of no box leaves the bound to these points' own extents.
    Ok(orient2d(&StaticFilter::plane([1.0; 2], [-1.0; 2]), a, b, c))
}

fn orientation_in_space(points: &[[f64; 3]; 4]) -> Result<f64> {
    for (index, point) in points.iter().enumerate() {
        check_position::<Space>("points", index, point)?;
    }
    let [a, b, c, d] = points;
    Ok(orient3d(&StaticFilter::space([1.0; 3], [-1.0; 3]), a, b, c, d))
}
