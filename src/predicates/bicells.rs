//! The certificates of a bi-cell, several at a time.
//!
//! They are those of the [prepared sphere](super::sphere) of the first cell: its volume, that of the second cell, and the
//! side of the second opposing vertex, by the same operations, and so within the same bounds.

#![allow(unsafe_code)]

use super::StaticFilter;
#[cfg(target_arch = "x86_64")]
use super::lanes::avx2;
use super::lanes::{BiCells, LANES, Real};
use super::tolerance::{cross, dot, minus};

/// For each lane, whether both triangles, of the edge `ab` with `c` and `d`, surely are positively oriented, the second
/// with the edge reversed, and `d` is outside the circle of the first.
#[inline]
pub fn bicells_hold2d(f: &StaticFilter, bicells: &BiCells<2, 4>) -> [bool; LANES] {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn all(f: &StaticFilter, bicells: &BiCells<2, 4>) -> u32 {
            bicells_surely_hold2d(f, &bicells.lanes()).bits()
        }
        if avx2::is_there() {
            // SAFETY: it is.
            return bits(unsafe { all(f, bicells) });
        }
    }
    std::array::from_fn(|i| bicells_surely_hold2d(f, &bicells.lane(i)))
}

/// Likewise for tetrahedra, of the facet with `c` positively oriented and the reversed one with `d`.
#[inline]
pub fn bicells_hold3d(f: &StaticFilter, bicells: &BiCells<3, 5>) -> [bool; LANES] {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn all(f: &StaticFilter, bicells: &BiCells<3, 5>) -> u32 {
            bicells_surely_hold3d(f, &bicells.lanes()).bits()
        }
        if avx2::is_there() {
            // SAFETY: it is.
            return bits(unsafe { all(f, bicells) });
        }
    }
    std::array::from_fn(|i| bicells_surely_hold3d(f, &bicells.lane(i)))
}

#[cfg(target_arch = "x86_64")]
fn bits(mask: u32) -> [bool; LANES] {
    std::array::from_fn(|i| mask >> i & 1 == 1)
}

/// As [`bicells_hold2d`], of one bi-cell or of those in lanes.
#[inline(always)]
pub(crate) fn bicells_surely_hold2d<T: Real>(filter: &StaticFilter, [a, b, c, d]: &[[T; 2]; 4]) -> T::Mask {
    let [u, v, s] = [b, c, d].map(|p| [p[0] - a[0], p[1] - a[1]]);
    let [uu, vv, ss] = [u, v, s].map(|p| p[0] * p[0] + p[1] * p[1]);
    let n = [uu * v[1] - vv * u[1], vv * u[0] - uu * v[0]];
    let area = u[0] * v[1] - u[1] * v[0];
    let beyond = s[0] * u[1] - s[1] * u[0];
    let side = (s[0] * n[0] + s[1] * n[1]) - ss * area;
    are_certain(filter, area, beyond, side)
}

/// As [`bicells_hold3d`], of one bi-cell or of those in lanes.
#[inline(always)]
pub(crate) fn bicells_surely_hold3d<T: Real>(filter: &StaticFilter, [o, f, g, c, d]: &[[T; 3]; 5]) -> T::Mask {
    let (u, v, w, s) = (minus(f, o), minus(g, o), minus(c, o), minus(d, o));
    let (uu, vv, ww, ss) = (dot(&u, &u), dot(&v, &v), dot(&w, &w), dot(&s, &s));
    let (vw, uw, uv) = (cross(&v, &w), cross(&u, &w), cross(&u, &v));
    let n = |k: usize| uu * vw[k] - vv * uw[k] + ww * uv[k];
    let volume = dot(&u, &vw);
    let beyond = T::splat(0.0) - dot(&s, &uv);
    let side = dot(&s, &[n(0), n(1), n(2)]) - ss * volume;
    are_certain(filter, volume, beyond, side)
}

#[inline(always)]
fn are_certain<T: Real>(filter: &StaticFilter, volume: T, beyond: T, side: T) -> T::Mask {
    let orient = T::splat(filter.orient);
    orient.is_less(volume) & orient.is_less(beyond) & side.is_less(T::splat(-filter.prepared))
}
