//! The predicates of sites, by dimension.
//!
//! All else above the predicates is written once: a point is an array of `D` coordinates, a cell an array of `D + 1`
//! corners, and the two signs that decide everything are the orientation of `D + 1` points and the position of a point
//! against the sphere through them.

use super::shape::Shape;
use super::site::Sites;
use crate::complex::Corners;
use crate::ids::VertexId;
use crate::predicates::StaticFilter;

/// Exact signs, and what follows from them. They take sites (a place and the vertex id that breaks ties, see
/// [`crate::predicates`]) by index. `INFINITE` must not be among the indices whose place is read.
pub trait Signs: Shape {
    /// Error bounds for points inside the box.
    fn filter(lower: &Self::Point, upper: &Self::Point) -> StaticFilter;

    /// Bounds for points in a box, if all are on one lattice and few steps of it apart: see
    /// [`exact_filter`](crate::predicates::exact_filter).
    fn exact_filter<'p>(
        lower: &'p Self::Point,
        upper: &'p Self::Point,
        points: impl Iterator<Item = &'p Self::Point>,
    ) -> Option<StaticFilter>
    where
        Self::Point: 'p;

    /// Sign of the orientation of `D + 1` points: positive for the corners of a valid finite cell.
    fn orient(f: &StaticFilter, points: &[&Self::Point]) -> f64;

    /// Sign of the orientation of the cell.
    #[inline(always)]
    fn orientation(f: &StaticFilter, sites: Sites<Self>, v: &Self::Corners) -> f64 {
        Self::orient(f, &sites.points(v)[..Self::Corners::N])
    }

    /// Sign of the orientation of the cell after corner `i`, which may be `INFINITE`, has gone to `q`.
    #[inline(always)]
    fn orientation_with(
        f: &StaticFilter,
        sites: Sites<Self>,
        v: &Self::Corners,
        i: usize,
        q: &Self::Point,
    ) -> f64 {
        let mut points = sites.points(v);
        points[i] = q;
        Self::orient(f, &points[..Self::Corners::N])
    }

    /// Whether `q`, whose ties are broken as those of vertex `id`, is inside the sphere of a positively
    /// oriented finite cell, symbolically perturbed.
    fn is_in_sphere(
        f: &StaticFilter,
        sites: Sites<Self>,
        v: &Self::Corners,
        q: &Self::Point,
        id: VertexId,
    ) -> bool;

    /// Whether all points of a box are certainly outside the sphere of a positively oriented finite cell.
    fn is_clear_of(sites: Sites<Self>, v: &Self::Corners, lower: &Self::Point, upper: &Self::Point) -> bool;

    /// Whether the points lie in one affine subspace of dimension `points.len() - 2`: two equal points,
    /// three on a line, four in a plane.
    fn is_dependent(f: &StaticFilter, points: &[Self::Point]) -> bool;

    /// Whether a cell certainly stays positively oriented while its `D + 1` corners go straight from `old` to `new`.
    fn stays_positive(old: &[&Self::Point], new: &[&Self::Point]) -> bool;
}
