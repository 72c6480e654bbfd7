//! Exact signs for points of the caller's own. They need no triangulation.

use super::guard;
use super::pointers::{Array, Output, given};
use super::status::{Failure, deldrift_status};
use crate::delaunay::{Dimension, Plane, Space};
use crate::error::{Error, Result};
use crate::motion::check_position;
use crate::predicates::{
    MAX_WEIGHT, StaticFilter, in_power_circle, in_power_sphere, incircle, insphere, orient2d, orient3d,
};

/// The orientation of points, exactly, to *sign: 1, -1 or 0.
///
/// dimension: 2 or 3. points: dimension + 1 points. For 3 points in the plane the sign is 1 if they are in
/// counter-clockwise order, -1 if they are in clockwise order, and 0 on a line. For 4 points a, b, c, d in space it is
/// the sign of the determinant of the rows b - a, c - a, d - a, and 0 on a plane. The cells of a triangulation have
/// orientation 1. With another point in the place of a corner it tells on which side of the opposite facet that point
/// lies: 1 on the side of the cell, 0 on the facet's line or plane.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_orientation(
    dimension: u32,
    points: *const f64,
    sign: *mut i32,
) -> deldrift_status {
    let n = numbers_of(dimension, 1);
    given!(points[n]: Array, sign: Output);
    tell(
        dimension,
        sign,
        || Ok(orientation_in_plane(points_in(points.get()?))),
        || Ok(orientation_in_space(points_in(points.get()?))),
    )
}

/// Whether a point is inside the circle or sphere through others, exactly, to *sign: 1 inside, -1 outside, 0 on it.
///
/// dimension: 2 or 3. points: dimension + 2 points: those that the circle or sphere goes through, of orientation 1
/// (deldrift_orientation), and the one that is asked about. If their orientation is -1, the sign is the opposite one.
/// If it is 0 there is no circle or sphere, and the sign has no meaning. Ties are not broken.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_in_sphere(
    dimension: u32,
    points: *const f64,
    sign: *mut i32,
) -> deldrift_status {
    let n = numbers_of(dimension, 2);
    given!(points[n]: Array, sign: Output);
    tell(
        dimension,
        sign,
        || Ok(side_of_circle(points_in(points.get()?))),
        || Ok(side_of_sphere(points_in(points.get()?))),
    )
}

/// Whether a point with a weight is inside the power circle or power sphere of others, exactly, to *sign: 1 inside, -1
/// outside, 0 on it.
///
/// The power of a place x to a point p of weight w is |x - p|^2 - w. The centre of the power sphere has one power to all
/// of its points, and a point is inside if the centre has a lower one to it. With equal weights this is
/// deldrift_in_sphere. It is the test of regular triangulations, of which power diagrams are the duals.
///
/// dimension: 2 or 3. points: dimension + 2 points, as deldrift_in_sphere takes them. weights: as many numbers, of
/// magnitude up to 1e114, negative ones included: the square of a radius for a circle or a sphere around its point.
/// Ties are not broken.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE for a weight.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_in_power_sphere(
    dimension: u32,
    points: *const f64,
    weights: *const f64,
    sign: *mut i32,
) -> deldrift_status {
    let (n, n_points) = (numbers_of(dimension, 2), dimension.saturating_add(2) as usize);
    given!(points[n]: Array, weights[n_points]: Array, sign: Output);
    tell(
        dimension,
        sign,
        || Ok(side_of_power_circle(points_in(points.get()?), all_of(weights.get()?))),
        || Ok(side_of_power_sphere(points_in(points.get()?), all_of(weights.get()?))),
    )
}

/// How many coordinates there are of so many points more than a dimension has; none in one that there is not, which is refused.
fn numbers_of(dimension: u32, n_more: u32) -> usize {
    if matches!(dimension, 2 | 3) { (dimension * (dimension + n_more)) as usize } else { 0 }
}

/// The points of as many coordinates.
fn points_in<const D: usize, const N: usize>(coordinates: &[f64]) -> &[[f64; D]; N] {
    all_of(coordinates.as_chunks().0)
}

/// Entries of which there are as many as the dimension says.
fn all_of<T, const N: usize>(entries: &[T]) -> &[T; N] {
    entries.try_into().expect("as many as the dimension says")
}

/// Writes the sign of a determinant of points of the plane or of space, which has been made or refused.
fn tell(
    dimension: u32,
    sign: Output<'_, i32>,
    in_plane: impl FnOnce() -> Result<Result<f64>, Failure>,
    in_space: impl FnOnce() -> Result<Result<f64>, Failure>,
) -> deldrift_status {
    guard::enter(|| {
        let sign = sign.place()?;
        let determinant = match dimension {
            2 => in_plane()??,
            3 => in_space()??,
            given => return Err(Error::InvalidDimension { given }.into()),
        };
        sign.write(i32::from(determinant > 0.0) - i32::from(determinant < 0.0));
        Ok(())
    })
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
    Ok(orient2d(&filter_of_plane(), a, b, c))
}

fn orientation_in_space(points: &[[f64; 3]; 4]) -> Result<f64> {
    check_points::<Space>(points)?;
    let [a, b, c, d] = points;
    Ok(orient3d(&filter_of_space(), a, b, c, d))
}

fn side_of_circle(points: &[[f64; 2]; 4]) -> Result<f64> {
    check_points::<Plane>(points)?;
    let [a, b, c, d] = points;
    Ok(incircle(&filter_of_plane(), a, b, c, d))
}

fn side_of_sphere(points: &[[f64; 3]; 5]) -> Result<f64> {
    check_points::<Space>(points)?;
    let [a, b, c, d, e] = points;
    Ok(insphere(&filter_of_space(), a, b, c, d, e))
}

fn side_of_power_circle(points: &[[f64; 2]; 4], weights: &[f64; 4]) -> Result<f64> {
    check_points::<Plane>(points)?;
    check_weights(weights)?;
    Ok(in_power_circle(&filter_of_plane(), points.each_ref(), weights))
}

fn side_of_power_sphere(points: &[[f64; 3]; 5], weights: &[f64; 5]) -> Result<f64> {
    check_points::<Space>(points)?;
    check_weights(weights)?;
    Ok(in_power_sphere(&filter_of_space(), points.each_ref(), weights))
}

fn check_weights(weights: &[f64]) -> Result<()> {
    // NaN is in no range.
    match weights.iter().position(|weight| !(-MAX_WEIGHT..=MAX_WEIGHT).contains(weight)) {
        None => Ok(()),
        Some(index) => {
            let (value, wanted) = (weights[index], "a number of magnitude 1e114 at most");
            Err(Error::InvalidValue { argument: "weights", index, value, wanted })
        }
    }
}

/// The filter of a box without points in the plane: it leaves the bound to the extents of the points that are given.
fn filter_of_plane() -> StaticFilter {
    StaticFilter::plane([1.0; 2], [-1.0; 2])
}

/// The filter of a box without points in space: it leaves the bound to the extents of the points that are given.
fn filter_of_space() -> StaticFilter {
    StaticFilter::space([1.0; 3], [-1.0; 3])
}
