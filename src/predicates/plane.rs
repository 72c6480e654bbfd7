//! Predicates of the plane.

use super::big::{self, has_room};
use super::filter::{StaticFilter, extents, incircle_bound, is_certain, largest, orient2d_bound};
use super::integer::{Limbs, LongScaled, Modular, Scaled, Short, Wide, with_sign};
use super::running::{Running, incircle_running_bound};
use super::two_heights::{incircle_at_two_heights, is_rectangle};
use super::vectors::{dot, minor, minus};
use crate::machine::tally;
use robust::Coord;
use std::cmp::Ordering;

/// Twice the signed area of the triangle `abc`: positive when counter-clockwise, zero when collinear.
///
/// The sign is exact for points in the filter's box; the magnitude is approximate.
#[inline(always)]
pub fn orient2d(f: &StaticFilter, a: &[f64; 2], b: &[f64; 2], c: &[f64; 2]) -> f64 {
    let det = minor(&minus(b, a), &minus(c, a));
    if det.abs() > f.orient { det } else { orient2d_uncertain(det, [a, b, c]) }
}

/// In-circle determinant: positive iff `d` is strictly inside the circle of the counter-clockwise triangle
/// `abc`, zero iff the points are cocircular (or `abc` degenerates with them); negated for clockwise `abc`.
///
/// The sign is exact for points in the filter's box; the magnitude is approximate.
#[inline(always)]
pub fn incircle(f: &StaticFilter, a: &[f64; 2], b: &[f64; 2], c: &[f64; 2], d: &[f64; 2]) -> f64 {
    let det = incircle_rounded([a, b, c, d]);
    if det.abs() > f.in_sphere { det } else { incircle_uncertain(det, [a, b, c, d]) }
}

/// The sign of [`orient2d`] without a filter's box, not to be counted.
pub(super) fn sign_of_orient2d(points: [&[f64; 2]; 3]) -> Ordering {
    let [a, b, c] = points;
    let (det, extents) = (minor(&minus(b, a), &minus(c, a)), extents(points));
    let is_certain = is_certain(det, orient2d_bound(extents), extents);
    sign_of(if is_certain { det } else { orient2d_exact(det, points) })
}

/// The sign of [`incircle`] without a filter's box, not to be counted.
pub(super) fn sign_of_incircle(points: [&[f64; 2]; 4]) -> Ordering {
    let (det, extents) = (incircle_rounded(points), extents(points));
    let is_certain = is_certain(det, incircle_bound(extents), extents);
    sign_of(if is_certain { det } else { incircle_exact(det, points, largest(extents)) })
}

/// The sign of a rounded determinant.
pub(super) fn sign_of(det: f64) -> Ordering {
    det.partial_cmp(&0.0).expect("a determinant is a number")
}

/// The later stages, after the rounded determinant.
#[cold]
#[inline(never)]
fn orient2d_uncertain(det: f64, points: [&[f64; 2]; 3]) -> f64 {
    let extents = extents(points);
    if is_certain(det, orient2d_bound(extents), extents) {
        return det;
    }
    tally::count();
    orient2d_exact(det, points)
}

fn orient2d_exact(det: f64, points: [&[f64; 2]; 3]) -> f64 {
    if !has_room(points, 2) {
        return big::orient2d(det, points);
    }
    let [a, b, c] = points.map(coord);
    robust::orient2d(a, b, c)
}

#[cold]
#[inline(never)]
fn incircle_uncertain(det: f64, points: [&[f64; 2]; 4]) -> f64 {
    // Most ties of grids; without this the stages below would find them.
    if det == 0.0 && is_rectangle(points) {
        tally::count();
        return det;
    }
    let extents = extents(points);
    if is_certain(det, incircle_bound(extents), extents) || det.abs() > own_incircle_bound(points, extents) {
        return det;
    }
    tally::count();
    incircle_exact(det, points, largest(extents))
}

/// What [`incircle_rounded`] of these points exceeds if its sign is certain.
#[inline(always)]
pub(super) fn own_incircle_bound([a, b, c, d]: [&[f64; 2]; 4], extents: [f64; 2]) -> f64 {
    let (u, v, w) = (minus::<f64, 2>(b, a), minus(c, a), minus(d, a));
    let cross = |p: &[f64; 2]| Running::sum(u[0] * p[1], -(u[1] * p[0]));
    let dot = |p: &[f64; 2], q: &[f64; 2]| Running::sum(p[0] * q[0], p[1] * q[1]);
    let products = [[cross(&w), dot(&v, &minus(c, b))], [cross(&v), dot(&w, &minus(d, b))]];
    incircle_running_bound(products, extents)
}

fn incircle_exact(det: f64, points: [&[f64; 2]; 4], extent: f64) -> f64 {
    if let Some(sign) = incircle_at_two_heights(points) {
        return with_sign(det, sign);
    }
    if let Some(sign) = incircle_sign(points, extent) {
        return with_sign(det, sign);
    }
    if !has_room(points, 4) {
        return big::incircle(det, points);
    }
    let [a, b, c, d] = points.map(coord);
    robust::incircle(a, b, c, d)
}

/// With the differences u, v, w from `a` to `b`, `c`, `d`: minus the determinant with rows (u, |u|²),
/// (v, |v|²), (w, |w|²), which is `|v|² u×w − |u|² v×w − |w|² u×v`.
///
/// The cross products satisfy `u (v×w) − v (u×w) + w (u×v) = 0`. Its scalar product with u replaces
/// `|u|² v×w`, and two products remain of three: `(u×w)(v·(v − u)) − (u×v)(w·(w − u))`.
#[inline(always)]
pub(super) fn incircle_rounded([a, b, c, d]: [&[f64; 2]; 4]) -> f64 {
    let (u, v, w) = (minus(b, a), minus(c, a), minus(d, a));
    minor(&u, &w) * dot(&v, &minus(c, b)) - minor(&u, &v) * dot(&w, &minus(d, b))
}

/// The sign of a determinant that does not exceed its error bound, if the differences are integers that are not too
/// long.
pub(super) fn incircle_sign([origin, others @ ..]: [&[f64; 2]; 4], extent: f64) -> Option<Ordering> {
    let Some(scaled) = Scaled::new(origin, others, extent) else {
        let scaled = LongScaled::new(origin, others, extent)?;
        return Some(match scaled.n_bits {
            ..=91 => incircle_modular(&scaled.modular::<Limbs<5>>()).sign(),
            _ => incircle_modular(&scaled.modular::<Limbs<7>>()).sign(),
        });
    };
    Some(match scaled.n_bits {
        ..=27 => incircle_modular(&scaled.modular::<Short<i64>>()).sign(),
        28..=43 => incircle_modular(&scaled.modular::<Short<i128>>()).sign(),
        _ => incircle_integer(&scaled.differences).sign(),
    })
}

/// [`incircle_rounded`] modulo a power of two.
#[inline(always)]
fn incircle_modular<M: Modular>([u, v, w]: &[[M; 2]; 3]) -> M {
    let cross = |p: &[M; 2], q: &[M; 2]| p[0].times(q[1]).minus(p[1].times(q[0]));
    let dot_from_u = |p: &[M; 2]| p[0].times(p[0].minus(u[0])).plus(p[1].times(p[1].minus(u[1])));
    cross(u, w).times(dot_from_u(v)).minus(cross(u, v).times(dot_from_u(w)))
}

/// [`incircle_rounded`] modulo 2²⁵⁶, of differences of 59 bits.
fn incircle_integer([u, v, w]: &[[i64; 2]; 3]) -> Wide {
    let product = |x: i64, y: i64| i128::from(x) * i128::from(y);
    let cross = |p: &[i64; 2], q: &[i64; 2]| product(p[0], q[1]) - product(p[1], q[0]);
    let dot_from_u = |p: &[i64; 2]| product(p[0], p[0] - u[0]) + product(p[1], p[1] - u[1]);
    Wide::from(cross(u, w)).times(dot_from_u(v)).minus(Wide::from(cross(u, v)).times(dot_from_u(w)))
}

fn coord(&[x, y]: &[f64; 2]) -> Coord<f64> {
    Coord { x, y }
}
