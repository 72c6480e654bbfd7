//! What the kernel does differently in the plane and in space.
//!
//! All else above the predicates is written once, over [`Dimension`]: a point is an array of `D` coordinates, a cell an
//! array of `D + 1` corners, and the two signs that decide everything are the orientation of `D + 1` points and the
//! position of a point against the sphere through them.

use super::Delaunay;
use super::cavity::Insert;
use super::dimension::Dimension;
use super::flip::{Flipper, Flips};
use super::site::{Site, Sites};
use super::uncertain::Held;
use super::winding::Ray;
use crate::complex::{Corners, Facet, Obstacle};
use crate::ids::{SiteId, Slot, VertexId};
use crate::predicates::StaticFilter;
use crate::simd::{Avx2, LANES, Lanes};

/// The predicates of a dimension, and the steps of algorithms that differ. `G` is the dimension itself: a supertrait of
/// [`Dimension`] can name its types only by a parameter.
///
/// The predicates take sites (a place and the vertex id that breaks ties, see [`crate::predicates`]) by index.
/// `INFINITE` must not be among the indices whose place is read.
pub trait Kernel<G: Dimension> {
    /// Sites of a part at least for a build in parts to be clearly faster, on a busy machine as well. (On an idle one
    /// two parts are faster from 3,000 sites on; where no processor is free they take up to a third longer than one.)
    const BUILT_AT_LEAST: usize;
    /// Scratch memory of insertions.
    type Scratch: Insert<G>;

    /// Error bounds for points inside the box.
    fn filter(lower: &G::Point, upper: &G::Point) -> StaticFilter;

    /// Bounds for points in a box, if all are on one lattice and few steps of it apart: see
    /// [`exact_filter`](crate::predicates::exact_filter).
    fn exact_filter<'p>(
        lower: &'p G::Point,
        upper: &'p G::Point,
        points: impl Iterator<Item = &'p G::Point>,
    ) -> Option<StaticFilter>
    where
        G::Point: 'p;

    /// Sign of the orientation of `D + 1` points: positive for the corners of a valid finite cell.
    fn orient(f: &StaticFilter, points: &[&G::Point]) -> f64;

    /// Sign of the orientation of the cell.
    #[inline(always)]
    fn orientation(f: &StaticFilter, sites: Sites<G>, v: &G::Corners) -> f64 {
        Self::orient(f, &sites.points(v)[..G::Corners::N])
    }

    /// Sign of the orientation of the cell after corner `i`, which may be `INFINITE`, has gone to `q`.
    #[inline(always)]
    fn orientation_with(f: &StaticFilter, sites: Sites<G>, v: &G::Corners, i: usize, q: &G::Point) -> f64 {
        let mut points = sites.points(v);
        points[i] = q;
        Self::orient(f, &points[..G::Corners::N])
    }

    /// Whether `q`, whose ties are broken as those of vertex `id`, is inside the sphere of a positively
    /// oriented finite cell, symbolically perturbed.
    fn is_in_sphere(f: &StaticFilter, sites: Sites<G>, v: &G::Corners, q: &G::Point, id: VertexId) -> bool;

    /// Whether all points of a box are certainly outside the sphere of a positively oriented finite cell.
    fn is_clear_of(sites: Sites<G>, v: &G::Corners, lower: &G::Point, upper: &G::Point) -> bool;

    /// Whether the points lie in one affine subspace of dimension `points.len() - 2`: two equal points,
    /// three on a line, four in a plane.
    fn is_dependent(f: &StaticFilter, points: &[G::Point]) -> bool;

    /// Whether a cell certainly stays positively oriented while its `D + 1` corners go straight from `old` to `new`.
    fn stays_positive(old: &[&G::Point], new: &[&G::Point]) -> bool;

    /// Whether a finite cell surely is positively oriented and has no other corner of a neighbour in its sphere.
    fn cell_holds(t: &Delaunay<G>, cell: Slot) -> bool;

    /// What surely holds of several cells, with these corners and these sites beyond their facets;
    /// [`cell_holds`](Self::cell_holds) is that all of it does.
    fn cells_hold<const HAVE_OWN_BOUNDS: bool>(
        avx2: Avx2,
        f: &StaticFilter,
        sites: Sites<G>,
        cells: [&G::Corners; LANES],
        apexes: [&[SiteId; LANES]; 4],
    ) -> Held;

    /// Whether all cells of a star, listed with the index of its site in each, surely are as
    /// [`cell_holds`](Self::cell_holds) says: not if there are ghosts among them.
    fn star_holds(avx2: Avx2, t: &Delaunay<G>, star: &[(Slot, u8)]) -> bool;

    /// For each of several cells, with a site each, whether the site surely is outside the cell's sphere: one bit each.
    fn are_outside(
        avx2: Avx2,
        f: &StaticFilter,
        sites: Sites<G>,
        cells: [&G::Corners; LANES],
        others: &[SiteId; LANES],
    ) -> u32;

    /// Where the ray from `o` through `aim` goes, past the facets of several ghosts or through them.
    fn ray(
        avx2: Avx2,
        f: &StaticFilter,
        sites: Sites<G>,
        ghosts: [&G::Corners; LANES],
        o: &G::Point,
        aim: &G::Point,
    ) -> Ray;

    /// For each of several ghosts, with the finite corners across its ridges, whether the hull surely is convex at all
    /// of these: one bit each.
    fn are_convex(
        avx2: Avx2,
        f: &StaticFilter,
        sites: Sites<G>,
        ghosts: [&G::Corners; LANES],
        across: [&[SiteId; LANES]; 3],
    ) -> u32;

    /// Whether the two cells of a facet, both finite, surely are positively oriented, and it passes the empty-sphere
    /// test.
    fn bicell_holds(t: &Delaunay<G>, facet: Facet) -> bool;

    /// For each of several facets whether [`bicell_holds`](Self::bicell_holds) says so of it, or sharper bounds do: one
    /// bit each.
    fn facets_hold(avx2: Avx2, t: &Delaunay<G>, facets: &[Facet; LANES]) -> u32;

    /// Takes sites that are certainly outside the sphere of a cell out of a set of them, by position.
    fn drop_outside(t: &Delaunay<G>, cell: &G::Corners, sites: &[SiteId], set: u64) -> u64;

    /// Flips a facet between finite cells that fails the empty-sphere test, and enters that.
    fn flip(flipper: &mut Flipper<G>, facet: Facet, flips: &mut Flips<G>) -> Result<(), Obstacle>;

    /// Exchanges places with those of sites; returns how many differ, bit by bit. Widens a box, given by its lower and
    /// its upper corner, to the places that the sites get. The lanes of a corner are x, y, x, y in the plane; in space
    /// x, y, z and something without a meaning.
    fn exchange(
        avx2: Avx2,
        places: &mut [G::Point; LANES],
        sites: [&mut Site<G>; LANES],
        covered: &mut [Lanes; 2],
    ) -> u64;
}
