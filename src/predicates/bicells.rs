//! What is certain of bi-cells, by dimension, and their certificates, several at a time.
//!
//! The certificates are those of the [prepared sphere](super::sphere) of the first cell: its volume, that of the second
//! cell, and the side of the second opposing vertex, by the same operations, and so within the same bounds.

use std::fmt::Debug;

use super::located::{Located, SeenPoint};
use super::points::{PlanePoint, SpacePoint};
use super::sphere::{circle_seen, side_of_circle_seen, side_of_sphere_seen, sphere_seen};
use super::vectors::{cross, dot, greatest_along_axes, greatest_of, minor};
use super::{
    BiCells, Delimiter, StaticFilter, delimiter2d, delimiter3d, orientation_tolerance2d,
    orientation_tolerance3d, separator3d, tolerances2d, tolerances3d,
};
use crate::simd::{LANES, Lanes, Real, in_lanes};

/// Tolerances of cells and bi-cells. A bi-cell is given by its `D + 2` corners, the opposing vertices first and last;
/// the vertices of the facet and then the first of all are in the order of a positive orientation.
pub trait BiCellTolerances: Sized {
    /// Bi-cells that are looked at together.
    type BiCells: Debug + Default;
    /// Standard delimiter.
    fn delimiter(bicell: &[&Self]) -> Delimiter<Self>;
    /// Certified lower bound of the tolerance; it need not be sharp if it is `enough`.
    fn tolerance(bicell: &[&Self], enough: f64) -> f64;
    /// Sets the bi-cell of a lane.
    fn set_bicell(bicells: &mut Self::BiCells, lane: usize, bicell: &[&Self]);
    /// For each lane the [`tolerance`](Self::tolerance) of its bi-cell, which need not be sharp if it is `enough`, or
    /// of both at least this `share`.
    fn tolerances(bicells: &Self::BiCells, enough: [f64; LANES], share: f64) -> [f64; LANES];
    /// For each lane, whether the bi-cell surely has two positive cells and passes the empty-sphere test.
    fn bicells_hold(f: &StaticFilter, bicells: &Self::BiCells) -> [bool; LANES];
    /// Certified lower bound of the tolerance of the orientation of `D + 1` points; 0 unless it is certainly positive.
    fn orientation_tolerance(cell: &[&Self]) -> f64;
}

impl BiCellTolerances for [f64; 2] {
    type BiCells = BiCells<2, 4>;

    #[inline(always)]
    fn delimiter(bicell: &[&Self]) -> Delimiter<Self> {
        let &[c, a, b, d] = bicell else { unreachable!("two triangles") };
        delimiter2d(c, [a, b], d)
    }

    #[inline(always)]
    fn tolerance(bicell: &[&Self], _: f64) -> f64 {
        Self::delimiter(bicell).tolerance
    }

    #[inline(always)]
    fn set_bicell(bicells: &mut BiCells<2, 4>, lane: usize, bicell: &[&Self]) {
        let &[c, a, b, d] = bicell else { unreachable!("two triangles") };
        bicells.set(lane, [a, b, c, d]);
    }

    #[inline(always)]
    fn tolerances(bicells: &BiCells<2, 4>, _: [f64; LANES], _: f64) -> [f64; LANES] {
        tolerances2d(bicells)
    }

    #[inline]
    fn bicells_hold(f: &StaticFilter, bicells: &BiCells<2, 4>) -> [bool; LANES] {
        bits(in_lanes!(simd => bicells_surely_hold2d::<[f64; 2], _>(f, &bicells.lanes(simd)).bits()))
    }

    #[inline(always)]
    fn orientation_tolerance(cell: &[&Self]) -> f64 {
        orientation_tolerance2d(cell.try_into().expect("three corners"))
    }
}

impl BiCellTolerances for [f64; 3] {
    type BiCells = BiCells<3, 5>;

    #[inline(always)]
    fn delimiter(bicell: &[&Self]) -> Delimiter<Self> {
        let &[d, a, b, c, e] = bicell else { unreachable!("two tetrahedra") };
        delimiter3d(d, [a, b, c], e)
    }

    #[inline(always)]
    fn tolerance(bicell: &[&Self], enough: f64) -> f64 {
        let &[d, a, b, c, e] = bicell else { unreachable!("two tetrahedra") };
        separator3d(d, [a, b, c], e, enough).delimiter.tolerance
    }

    #[inline(always)]
    fn set_bicell(bicells: &mut BiCells<3, 5>, lane: usize, bicell: &[&Self]) {
        let &[d, a, b, c, e] = bicell else { unreachable!("two tetrahedra") };
        bicells.set(lane, [a, b, c, d, e]);
    }

    #[inline(always)]
    fn tolerances(bicells: &BiCells<3, 5>, enough: [f64; LANES], share: f64) -> [f64; LANES] {
        tolerances3d(bicells, enough, share)
    }

    #[inline]
    fn bicells_hold(f: &StaticFilter, bicells: &BiCells<3, 5>) -> [bool; LANES] {
        bits(in_lanes!(simd => bicells_surely_hold3d::<[f64; 3], _>(f, &bicells.lanes(simd)).bits()))
    }

    #[inline(always)]
    fn orientation_tolerance(cell: &[&Self]) -> f64 {
        orientation_tolerance3d(cell.try_into().expect("four corners"))
    }
}

fn bits(mask: u32) -> [bool; LANES] {
    std::array::from_fn(|i| mask >> i & 1 == 1)
}

/// Whether both triangles, of the edge `ab` with `c` and `d`, surely are positively oriented, the second with the edge
/// reversed, and `d` is outside the circle of the first: of one bi-cell or of those in lanes.
#[inline(always)]
pub(crate) fn bicells_surely_hold2d<P: PlanePoint, T: Real>(
    filter: &StaticFilter,
    bicells: &[P::Of<T>; 4],
) -> T::Mask {
    let any = P::place_of(&bicells[0])[0];
    let bounds = [any.splat(filter.orient), any.splat(filter.prepared)];
    Certificates::in_plane(&seen_from_first::<P, _, 2, 4, 3>(bicells)).exceed(bounds)
}

/// Whether both tetrahedra, of the facet with `c` and `d`, surely are positively oriented, the second with the facet
/// reversed, and `d` is outside the sphere of the first: of one bi-cell or of those in lanes.
#[inline(always)]
pub(crate) fn bicells_surely_hold3d<P: SpacePoint, T: Real>(
    filter: &StaticFilter,
    bicells: &[P::Of<T>; 5],
) -> T::Mask {
    let any = P::place_of(&bicells[0])[0];
    let bounds = [any.splat(filter.orient), any.splat(filter.prepared)];
    Certificates::in_space(&seen_from_first::<P, _, 3, 5, 4>(bicells)).exceed(bounds)
}

/// What [`bicells_surely_hold2d`] tells, by bounds of each bi-cell's own extents in place of the static filter's.
#[inline(always)]
pub(crate) fn bicells_hold_for_their_size2d<P: PlanePoint, T: Real>(bicells: &[P::Of<T>; 4]) -> T::Mask {
    let seen = seen_from_first::<P, _, 2, 4, 3>(bicells);
    let bounds = P::semi_static(
        greatest_along_axes(seen.each_ref().map(|seen| &seen.difference)),
        weights_apart::<P, _, 2, 4, 3>(bicells),
    );
    Certificates::in_plane(&seen).exceed(bounds)
}

/// What [`bicells_surely_hold3d`] tells, by bounds of each bi-cell's own extents in place of the static filter's.
#[inline(always)]
pub(crate) fn bicells_hold_for_their_size3d<P: SpacePoint, T: Real>(bicells: &[P::Of<T>; 5]) -> T::Mask {
    let seen = seen_from_first::<P, _, 3, 5, 4>(bicells);
    let bounds = P::semi_static(
        greatest_along_axes(seen.each_ref().map(|seen| &seen.difference)),
        weights_apart::<P, _, 3, 5, 4>(bicells),
    );
    Certificates::in_space(&seen).exceed(bounds)
}

/// The `N` others, seen from the first point.
#[inline(always)]
fn seen_from_first<P: Located<D>, T: Real, const D: usize, const M: usize, const N: usize>(
    points: &[P::Of<T>; M],
) -> [SeenPoint<T, D>; N] {
    const { assert!(N + 1 == M) };
    let mut seen = [P::seen(&points[1], &points[0]); N];
    for k in 1..N {
        seen[k] = P::seen(&points[k + 1], &points[0]);
    }
    seen
}

/// The greatest difference of a weight from the first one.
#[inline(always)]
fn weights_apart<P: Located<D>, T: Real, const D: usize, const M: usize, const N: usize>(
    points: &[P::Of<T>; M],
) -> T {
    let mut apart = [P::weight_apart(&points[1], &points[0]); N];
    for k in 1..N {
        apart[k] = P::weight_apart(&points[k + 1], &points[0]);
    }
    greatest_of(&apart)
}

/// The determinants that decide about a bi-cell: the volumes of both cells are to be positive, the side of the second
/// opposing vertex negative.
struct Certificates<T> {
    volume: T,
    beyond: T,
    side: T,
}

impl<T: Real> Certificates<T> {
    #[inline(always)]
    fn in_plane([b, c, d]: &[SeenPoint<T, 2>; 3]) -> Self {
        let circle = circle_seen(b, c);
        let beyond = minor(&d.difference, &b.difference);
        Certificates { volume: circle[2], beyond, side: side_of_circle_seen(&circle, d) }
    }

    #[inline(always)]
    fn in_space([b, c, d, e]: &[SeenPoint<T, 3>; 4]) -> Self {
        let sphere = sphere_seen(b, c, d);
        let beyond = sphere[3].splat(0.0) - dot(&e.difference, &cross(&b.difference, &c.difference));
        Certificates { volume: sphere[3], beyond, side: side_of_sphere_seen(&sphere, e) }
    }

    /// Whether all three surely have the sign wanted, given the bounds of the volumes and of the side.
    #[inline(always)]
    fn exceed(&self, [orient, prepared]: [T; 2]) -> T::Mask {
        let zero = self.side.splat(0.0);
        orient.is_less(self.volume) & orient.is_less(self.beyond) & self.side.is_less(zero - prepared)
    }
}
