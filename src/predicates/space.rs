//! Predicates of space.
//!
//! Orientation follows CGAL: the tetrahedron `abcd` is positive when `b − a`, `c − a`, `d − a` form a
//! right-handed basis, that is, when `abc` turns counter-clockwise seen from `d`.

use super::big::{self, has_room};
use super::filter::{
    StaticFilter, extents, insphere_bound, insphere_bound_of_terms, is_certain, largest, orient3d_bound,
};
use super::integer::{Limbs, LongScaled, Modular, Scaled, Short, Wide, with_sign};
use super::plane::{sign_of_incircle, sign_of_orient2d};
use super::two_heights::{insphere_at_two_heights, orient3d_at_two_heights};
use super::vectors::{dot, minor, minus};
use crate::machine::tally;
use robust::Coord3D;
use std::cmp::Ordering;

/// Six times the signed volume of the tetrahedron `abcd`, the determinant of `b − a`, `c − a`, `d − a`; zero
/// when the points are coplanar.
///
/// The sign is exact for points in the filter's box; the magnitude is approximate.
#[inline(always)]
pub fn orient3d(f: &StaticFilter, a: &[f64; 3], b: &[f64; 3], c: &[f64; 3], d: &[f64; 3]) -> f64 {
    let det = volume(&minus(b, a), &minus(c, a), &minus(d, a));
    if det.abs() > f.orient { det } else { orient3d_uncertain(det, [a, b, c, d]) }
}

/// In-sphere determinant: positive iff `e` is strictly inside the sphere of the positive tetrahedron
/// `abcd`, zero iff the points are cospherical (or `abcd` degenerates with them); negated for negative
/// `abcd`.
///
/// The sign is exact for points in the filter's box; the magnitude is approximate.
#[inline(always)]
pub fn insphere(
    f: &StaticFilter,
    a: &[f64; 3],
    b: &[f64; 3],
    c: &[f64; 3],
    d: &[f64; 3],
    e: &[f64; 3],
) -> f64 {
    let det = insphere_rounded([a, b, c, d, e]);
    if det.abs() > f.in_sphere { det } else { insphere_uncertain(det, [a, b, c, d, e]) }
}

/// The later stages, after the rounded determinant.
#[cold]
#[inline(never)]
fn orient3d_uncertain(det: f64, points: [&[f64; 3]; 4]) -> f64 {
    let extents = extents(points);
    if is_certain(det, orient3d_bound(extents), extents) {
        return det;
    }
    tally::count();
    if let Some(sign) = orient3d_at_two_heights(points, sign_of_orient2d) {
        return with_sign(det, sign);
    }
    if let Some(sign) = orient3d_sign(points, largest(extents)) {
        return with_sign(det, sign);
    }
    if !has_room(points, 3) {
        return big::orient3d(det, points);
    }
    let [a, b, c, d] = points.map(coord);
    // Shewchuk's tetrahedra are positive when left-handed.
    -robust::orient3d(a, b, c, d)
}

#[cold]
#[inline(never)]
fn insphere_uncertain(det: f64, points: [&[f64; 3]; 5]) -> f64 {
    let extents = extents(points);
    let bound = insphere_bound(extents);
    if is_certain(det, bound, extents) {
        return det;
    }
    if let Some(sign) = insphere_at_two_heights(points, sign_of_incircle) {
        tally::count();
        return with_sign(det, sign);
    }
    let bound = bound.min(insphere_bound_of_terms(insphere_magnitudes(points), extents));
    if det.abs() > bound {
        return det;
    }
    tally::count();
    if let Some(sign) = insphere_sign(points, largest(extents), bound) {
        return with_sign(det, sign);
    }
    big::insphere(det, points)
}

/// With the differences u, v, w, s from `a` to `b`, `c`, `d`, `e`: minus the determinant with rows (u, |u|²),
/// (v, |v|²), (w, |w|²), (s, |s|²), which, `[·]` being volumes, is
/// `|u|² [vws] − |v|² [uws] + |w|² [uvs] − |s|² [uvw]`.
///
/// The volumes satisfy `u [vws] − v [uws] + w [uvs] − s [uvw] = 0`. Its scalar product with u replaces
/// `|u|² [vws]`, and three products remain of four:
/// `[uvs] (w·(w − u)) − [uws] (v·(v − u)) − [uvw] (s·(s − u))`.
#[inline(always)]
pub(super) fn insphere_rounded([a, b, c, d, e]: [&[f64; 3]; 5]) -> f64 {
    let (u, v, w, s) = (minus(b, a), minus(c, a), minus(d, a), minus(e, a));
    let (minor_uv, minor_uw, minor_us) = (minor(&u, &v), minor(&u, &w), minor(&u, &s));
    let (minor_vw, minor_vs, minor_ws) = (minor(&v, &w), minor(&v, &s), minor(&w, &s));
    let volume_uvw = minor_vw * u[2] - minor_uw * v[2] + minor_uv * w[2];
    let volume_uvs = minor_vs * u[2] - minor_us * v[2] + minor_uv * s[2];
    let volume_uws = minor_ws * u[2] - minor_us * w[2] + minor_uw * s[2];
    volume_uvs * dot(&w, &minus(d, b))
        - volume_uws * dot(&v, &minus(c, b))
        - volume_uvw * dot(&s, &minus(e, b))
}

/// The sum of the magnitudes of all terms of [`insphere_rounded`], computed in the same order.
pub(super) fn insphere_magnitudes([a, b, c, d, e]: [&[f64; 3]; 5]) -> f64 {
    let magnitudes = |p, q| minus::<f64, 3>(p, q).map(f64::abs);
    let (u, v, w, s) = (magnitudes(b, a), magnitudes(c, a), magnitudes(d, a), magnitudes(e, a));
    let minor = |p: &[f64; 3], q: &[f64; 3]| p[0] * q[1] + p[1] * q[0];
    let (minor_uv, minor_uw, minor_us) = (minor(&u, &v), minor(&u, &w), minor(&u, &s));
    let (minor_vw, minor_vs, minor_ws) = (minor(&v, &w), minor(&v, &s), minor(&w, &s));
    let volume_uvw = minor_vw * u[2] + minor_uw * v[2] + minor_uv * w[2];
    let volume_uvs = minor_vs * u[2] + minor_us * v[2] + minor_uv * s[2];
    let volume_uws = minor_ws * u[2] + minor_us * w[2] + minor_uw * s[2];
    volume_uvs * dot(&w, &magnitudes(d, b))
        + volume_uws * dot(&v, &magnitudes(c, b))
        + volume_uvw * dot(&s, &magnitudes(e, b))
}

/// The sign of a determinant that does not exceed its error bound, if the differences are integers that are not too
/// long.
pub(super) fn insphere_sign(
    [origin, others @ ..]: [&[f64; 3]; 5],
    extent: f64,
    bound: f64,
) -> Option<Ordering> {
    let Some(scaled) = Scaled::new(origin, others, extent) else {
        let scaled = LongScaled::new(origin, others, extent)?;
        return Some(match scaled.n_bits_within(bound, extent) {
            ..=256 => insphere_modular(&scaled.modular::<Limbs<4>>()).sign(),
            257..=320 => insphere_modular(&scaled.modular::<Limbs<5>>()).sign(),
            321..=384 => insphere_modular(&scaled.modular::<Limbs<6>>()).sign(),
            _ => insphere_modular(&scaled.modular::<Limbs<8>>()).sign(),
        });
    };
    Some(match scaled.n_bits {
        ..=21 => insphere_modular(&scaled.modular::<Short<i64>>()).sign(),
        22..=33 => insphere_modular(&scaled.modular::<Short<i128>>()).sign(),
        _ => insphere_integer(&scaled.differences).sign(),
    })
}

/// The sign of an orientation that does not exceed its error bound, if the differences are integers that are not too
/// long.
pub(super) fn orient3d_sign([origin, others @ ..]: [&[f64; 3]; 4], extent: f64) -> Option<Ordering> {
    let Some(scaled) = Scaled::new(origin, others, extent) else {
        let scaled = LongScaled::new(origin, others, extent)?;
        return Some(orient3d_modular(&scaled.modular::<Limbs<5>>()).sign());
    };
    Some(match scaled.n_bits {
        ..=36 => orient3d_modular(&scaled.modular::<Short<i64>>()).sign(),
        37..=57 => orient3d_modular(&scaled.modular::<Short<i128>>()).sign(),
        _ => orient3d_modular(&scaled.modular::<Limbs<3>>()).sign(),
    })
}

/// [`insphere_rounded`] modulo a power of two.
#[inline(always)]
fn insphere_modular<M: Modular>([u, v, w, s]: &[[M; 3]; 4]) -> M {
    let (minor_uv, minor_uw, minor_us) = (minor_modular(u, v), minor_modular(u, w), minor_modular(u, s));
    let (minor_vw, minor_vs, minor_ws) = (minor_modular(v, w), minor_modular(v, s), minor_modular(w, s));
    let volume_uvw = volume_modular([minor_vw, minor_uw, minor_uv], [u, v, w]);
    let volume_uvs = volume_modular([minor_vs, minor_us, minor_uv], [u, v, s]);
    let volume_uws = volume_modular([minor_ws, minor_us, minor_uw], [u, w, s]);
    let dot_from_u = |p: &[M; 3]| {
        let [x, y, z] = std::array::from_fn(|axis| p[axis].times(p[axis].minus(u[axis])));
        x.plus(y).plus(z)
    };
    let first = volume_uvs.times(dot_from_u(w));
    first.minus(volume_uws.times(dot_from_u(v))).minus(volume_uvw.times(dot_from_u(s)))
}

#[inline(always)]
fn orient3d_modular<M: Modular>([u, v, w]: &[[M; 3]; 3]) -> M {
    volume_modular([minor_modular(v, w), minor_modular(u, w), minor_modular(u, v)], [u, v, w])
}

/// Determinant of three differences modulo a power of two, given the minors without each of them.
#[inline(always)]
fn volume_modular<M: Modular>(minors: [M; 3], differences: [&[M; 3]; 3]) -> M {
    let [first, second, third] = std::array::from_fn(|i| minors[i].times(differences[i][2]));
    first.minus(second).plus(third)
}

#[inline(always)]
fn minor_modular<M: Modular>(p: &[M; 3], q: &[M; 3]) -> M {
    p[0].times(q[1]).minus(p[1].times(q[0]))
}

/// [`insphere_rounded`] modulo 2²⁵⁶, of differences of 59 bits.
fn insphere_integer([u, v, w, s]: &[[i64; 3]; 4]) -> Wide {
    let (minor_uv, minor_uw, minor_us) = (minor_integer(u, v), minor_integer(u, w), minor_integer(u, s));
    let (minor_vw, minor_vs, minor_ws) = (minor_integer(v, w), minor_integer(v, s), minor_integer(w, s));
    let volume_uvw = volume_integer([minor_vw, minor_uw, minor_uv], [u, v, w]);
    let volume_uvs = volume_integer([minor_vs, minor_us, minor_uv], [u, v, s]);
    let volume_uws = volume_integer([minor_ws, minor_us, minor_uw], [u, w, s]);
    let dot_from_u = |p: &[i64; 3]| (0..3).map(|axis| product(p[axis], p[axis] - u[axis])).sum();
    let first = volume_uvs.times(dot_from_u(w));
    first.minus(volume_uws.times(dot_from_u(v))).minus(volume_uvw.times(dot_from_u(s)))
}

/// Determinant of three differences, given the minors without each of them.
fn volume_integer(minors: [i128; 3], differences: [&[i64; 3]; 3]) -> Wide {
    let [first, second, third] =
        std::array::from_fn(|i| Wide::from(minors[i]).times(i128::from(differences[i][2])));
    first.minus(second).plus(third)
}

fn minor_integer(p: &[i64; 3], q: &[i64; 3]) -> i128 {
    product(p[0], q[1]) - product(p[1], q[0])
}

fn product(x: i64, y: i64) -> i128 {
    i128::from(x) * i128::from(y)
}

/// Determinant of three differences.
#[inline(always)]
pub(super) fn volume(u: &[f64; 3], v: &[f64; 3], w: &[f64; 3]) -> f64 {
    minor(v, w) * u[2] - minor(u, w) * v[2] + minor(u, v) * w[2]
}

fn coord(&[x, y, z]: &[f64; 3]) -> Coord3D<f64> {
    Coord3D { x, y, z }
}

#[cfg(test)]
mod tests {
    use super::super::dyadic::{Dyadic, product};
    use super::*;
    use crate::random::Rng;

    /// The sum of magnitudes is that of the determinant multiplied out, in exact numbers.
    #[test]
    fn magnitudes_are_those_of_all_terms() {
        let rng = &mut Rng::new(6);
        for _ in 0..2_000 {
            let spread = rng.within(0, 60);
            let points: [[f64; 3]; 5] = std::array::from_fn(|_| {
                std::array::from_fn(|_| (rng.unit() - 0.5) * 2f64.powi(rng.within(-spread, spread) as i32))
            });
            let exact = |p: usize, q: usize| -> [Dyadic; 3] {
                std::array::from_fn(|k| (product([points[p][k]]) - product([points[q][k]])).abs())
            };
            let volume = |rows: [usize; 3]| {
                let rows = rows.map(|p| exact(p, 0));
                let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
                orders.into_iter().fold(Dyadic::from(0.0), |sum, order| {
                    let [u, v, w] = std::array::from_fn(|row| rows[row][order[row]].clone());
                    sum + u * v * w
                })
            };
            let scalar = |p: usize| {
                let [from_a, from_b] = [exact(p, 0), exact(p, 1)];
                from_a.into_iter().zip(from_b).fold(Dyadic::from(0.0), |sum, (x, y)| sum + x * y)
            };
            let expected =
                volume([1, 2, 4]) * scalar(3) + volume([1, 3, 4]) * scalar(2) + volume([1, 2, 3]) * scalar(4);
            let found = insphere_magnitudes(points.each_ref());
            assert!(product([found]).is_close_to(&expected, 48), "{points:?}");
        }
    }
}
