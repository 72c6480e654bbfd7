//! The certificates of a bi-cell, several at a time.
//!
//! They are those of the [prepared sphere](super::sphere) of the first cell: its volume, that of the second cell, and the
//! side of the second opposing vertex, by the same operations, and so within the same bounds.

use super::StaticFilter;
use super::filter::{semi_static_bounds_2d, semi_static_bounds_3d};
use super::lanes::BiCells;
use super::vectors::{cross, dot, minor, minus};
use crate::simd::{Avx2, LANES, Real};

/// For each lane, whether both triangles, of the edge `ab` with `c` and `d`, surely are positively oriented, the second
/// with the edge reversed, and `d` is outside the circle of the first.
#[inline]
pub fn bicells_hold2d(f: &StaticFilter, bicells: &BiCells<2, 4>) -> [bool; LANES] {
    if let Some(avx2) = Avx2::new() {
        return bits(avx2.run(
            #[inline(always)]
            || bicells_surely_hold2d(f, &bicells.lanes(avx2)).bits(),
        ));
    }
    std::array::from_fn(|i| bicells_surely_hold2d(f, &bicells.lane(i)))
}

/// Likewise for tetrahedra, of the facet with `c` positively oriented and the reversed one with `d`.
#[inline]
pub fn bicells_hold3d(f: &StaticFilter, bicells: &BiCells<3, 5>) -> [bool; LANES] {
    if let Some(avx2) = Avx2::new() {
        return bits(avx2.run(
            #[inline(always)]
            || bicells_surely_hold3d(f, &bicells.lanes(avx2)).bits(),
        ));
    }
    std::array::from_fn(|i| bicells_surely_hold3d(f, &bicells.lane(i)))
}

fn bits(mask: u32) -> [bool; LANES] {
    std::array::from_fn(|i| mask >> i & 1 == 1)
}

/// As [`bicells_hold2d`], of one bi-cell or of those in lanes.
#[inline(always)]
pub(crate) fn bicells_surely_hold2d<T: Real>(filter: &StaticFilter, bicells: &[[T; 2]; 4]) -> T::Mask {
    let any = bicells[0][0];
    let bounds = [any.splat(filter.orient), any.splat(filter.prepared)];
    Certificates::in_plane(&differences(bicells)).exceed(bounds)
}

/// As [`bicells_hold3d`], of one bi-cell or of those in lanes.
#[inline(always)]
pub(crate) fn bicells_surely_hold3d<T: Real>(filter: &StaticFilter, bicells: &[[T; 3]; 5]) -> T::Mask {
    let any = bicells[0][0];
    let bounds = [any.splat(filter.orient), any.splat(filter.prepared)];
    Certificates::in_space(&differences(bicells)).exceed(bounds)
}

/// The same by the bounds of the bi-cells' own extents.
#[inline(always)]
pub(crate) fn bicells_hold_for_their_size2d<T: Real>(bicells: &[[T; 2]; 4]) -> T::Mask {
    let differences = differences(bicells);
    Certificates::in_plane(&differences).exceed(semi_static_bounds_2d(extents(&differences)))
}

/// The same by the bounds of the bi-cells' own extents.
#[inline(always)]
pub(crate) fn bicells_hold_for_their_size3d<T: Real>(bicells: &[[T; 3]; 5]) -> T::Mask {
    let differences = differences(bicells);
    Certificates::in_space(&differences).exceed(semi_static_bounds_3d(extents(&differences)))
}

/// From the first point to the others, of which there are `N`.
#[inline(always)]
fn differences<T: Real, const D: usize, const P: usize, const N: usize>(points: &[[T; D]; P]) -> [[T; D]; N] {
    const { assert!(N + 1 == P) };
    let mut differences = [points[0]; N];
    for k in 0..N {
        differences[k] = minus(&points[k + 1], &points[0]);
    }
    differences
}

/// The greatest magnitude along each axis.
#[inline(always)]
fn extents<T: Real, const D: usize, const N: usize>(differences: &[[T; D]; N]) -> [T; D] {
    let mut greatest = [differences[0][0].splat(0.0); D];
    for difference in differences {
        for axis in 0..D {
            greatest[axis] = difference[axis].abs().max(greatest[axis]);
        }
    }
    greatest
}

/// All but the side are to be positive, that negative.
struct Certificates<T> {
    volume: T,
    beyond: T,
    side: T,
}

impl<T: Real> Certificates<T> {
    #[inline(always)]
    fn in_plane([u, v, s]: &[[T; 2]; 3]) -> Self {
        let (uu, vv, ss) = (dot(u, u), dot(v, v), dot(s, s));
        let n = [uu * v[1] - vv * u[1], vv * u[0] - uu * v[0]];
        let volume = minor(u, v);
        Certificates { volume, beyond: minor(s, u), side: dot(s, &n) - ss * volume }
    }

    #[inline(always)]
    fn in_space([u, v, w, s]: &[[T; 3]; 4]) -> Self {
        let (uu, vv, ww, ss) = (dot(u, u), dot(v, v), dot(w, w), dot(s, s));
        let (vw, uw, uv) = (cross(v, w), cross(u, w), cross(u, v));
        let mut n = [uu; 3];
        for k in 0..3 {
            n[k] = uu * vw[k] - vv * uw[k] + ww * uv[k];
        }
        let volume = dot(u, &vw);
        let beyond = volume.splat(0.0) - dot(s, &uv);
        Certificates { volume, beyond, side: dot(s, &n) - ss * volume }
    }

    /// Whether all surely have the sign wanted, given the bounds of the volumes and of the side.
    #[inline(always)]
    fn exceed(&self, [orient, prepared]: [T; 2]) -> T::Mask {
        let zero = self.side.splat(0.0);
        orient.is_less(self.volume) & orient.is_less(self.beyond) & self.side.is_less(zero - prepared)
    }
}
