//! The two dimensions in which deldrift works, as types.
//!
//! Everything above the predicates is written once, over [`Dimension`]: a point is an array of `D`
//! coordinates, a cell an array of `D + 1` corners, and the two signs that decide everything are the
//! orientation of `D + 1` points and the position of a point against the sphere through them.

use std::fmt::Debug;

use super::cavity::Cavity;
use super::flip::{Flipper, Flips};
use super::screen;
use super::site::{self, Site, Sites};
use super::{Delaunay, cavity_plane, cavity_space, certify};
use crate::complex::{Corners, Facet, INFINITE, Obstacle};
use crate::error::Result;
use crate::predicates::{self, Coordinates, StaticFilter};
use crate::simd::{Avx2, LANES};

/// A dimension: its arrays and its predicates.
///
/// The predicates take sites (a place and the vertex id that breaks ties, see
/// `predicates`) by index. `INFINITE` must not be among the indices whose place is read.
pub trait Dimension: Copy + Debug + Default + Send + Sync + 'static {
    /// Number of coordinates.
    const D: usize;
    /// Sites of a part at least for a build in parts to be clearly faster, on a busy machine as well.
    const BUILT_AT_LEAST: usize;
    /// `[f64; D]`.
    type Point: Coordinates;
    /// `[u32; D + 1]`: the corners of a cell, or its neighbours.
    type Corners: Corners;
    /// Scratch memory of insertions.
    type Scratch: Debug + Default + Send + Sync;
    /// Error bounds for points inside the box.
    fn filter(lower: &Self::Point, upper: &Self::Point) -> StaticFilter;
    /// Sign of the orientation of the cell: positive in a valid finite cell.
    fn orientation(f: &StaticFilter, sites: Sites<Self>, v: &Self::Corners) -> f64;
    /// Sign of the orientation of the cell after corner `i` has gone to `q`.
    fn orientation_with(
        f: &StaticFilter,
        sites: Sites<Self>,
        v: &Self::Corners,
        i: usize,
        q: &Self::Point,
    ) -> f64;
    /// Whether `q`, whose ties are broken as those of vertex `id`, is inside the sphere of a positively
    /// oriented finite cell, symbolically perturbed.
    fn is_in_sphere(
        f: &StaticFilter,
        sites: Sites<Self>,
        v: &Self::Corners,
        q: &Self::Point,
        id: u32,
    ) -> bool;
    /// Whether all points of a box are certainly outside the sphere of a positively oriented finite cell.
    fn is_clear_of(sites: Sites<Self>, v: &Self::Corners, lower: &Self::Point, upper: &Self::Point) -> bool;
    /// Whether the points lie in one affine subspace of dimension `points.len() - 2`: two equal points,
    /// three on a line, four in a plane.
    fn is_dependent(f: &StaticFilter, points: &[Self::Point]) -> bool;
    /// Whether the ray from `o` through `aim` crosses the facet opposite the last corner of `v`, of which `o` is on
    /// the inner side; `None` if it meets its boundary.
    fn is_crossed(
        f: &StaticFilter,
        sites: Sites<Self>,
        v: &Self::Corners,
        o: &Self::Point,
        aim: &Self::Point,
    ) -> Option<bool>;
    /// Gets ready to insert very many sites: after that, and until [`end_build`](Self::end_build), `BUILD` is true.
    fn begin_build(t: &mut Delaunay<Self>) -> Result<()>;
    /// Frees what [`begin_build`](Self::begin_build) made.
    fn end_build(t: &mut Delaunay<Self>);
    /// Bytes of the scratch memory of insertions.
    fn scratch_bytes(scratch: &Self::Scratch) -> usize;
    /// Finds the conflict zone of the site `s`, of which the cell `start` is one, and joins its rim to the site. Lists
    /// the new cells in `cavity`. After an error nothing has changed.
    fn insert<const BUILD: bool>(
        t: &mut Delaunay<Self>,
        cavity: &mut Cavity<Self>,
        start: u32,
        s: u32,
    ) -> Result<()>;
    /// Exchanges places with those of sites, by index; returns how many differ, bit by bit.
    fn exchange(
        avx2: Avx2,
        places: &mut [Self::Point; LANES],
        sites: &mut [Site<Self>],
        sites_of: &[u32; LANES],
    ) -> u64;
    /// Whether a finite cell surely is positively oriented and has no other corner of a neighbour in its sphere.
    fn cell_holds(t: &Delaunay<Self>, cell: u32) -> bool;
    /// As [`cell_holds`](Self::cell_holds), of several cells with these sites beyond their facets: one bit each.
    fn cells_hold(avx2: Avx2, t: &Delaunay<Self>, cells: &[u32; LANES], apexes: [&[u32; LANES]; 4]) -> u32;
    /// As [`bicell_holds`](Self::bicell_holds), of several facets, or by bounds that are sharper: one bit each.
    fn facets_hold(avx2: Avx2, t: &Delaunay<Self>, facets: &[Facet; LANES]) -> u32;
    /// Takes sites that are certainly outside the sphere of a cell out of a set of them, by position.
    fn drop_outside(t: &Delaunay<Self>, cell: &Self::Corners, sites: &[u32], set: u64) -> u64;
    /// Whether the two cells of a facet, both finite, surely are positively oriented, and it passes the empty-sphere
    /// test.
    fn bicell_holds(t: &Delaunay<Self>, facet: Facet) -> bool;
    /// Whether a cell certainly stays positively oriented while its `D + 1` corners go straight from `old` to `new`.
    fn stays_positive(old: &[&Self::Point], new: &[&Self::Point]) -> bool;
    /// Flips a facet between finite cells that fails the empty-sphere test, and enters that.
    fn flip(flipper: &mut Flipper<Self>, facet: Facet, flips: &mut Flips<Self>) -> Result<(), Obstacle>;
}

/// Two dimensions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plane;

/// Three dimensions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Space;

impl Dimension for Plane {
    const D: usize = 2;
    const BUILT_AT_LEAST: usize = 16_000;
    type Point = [f64; 2];
    type Corners = [u32; 3];
    type Scratch = cavity_plane::Scratch;

    fn filter(lower: &[f64; 2], upper: &[f64; 2]) -> StaticFilter {
        StaticFilter::plane(*lower, *upper)
    }

    #[inline(always)]
    fn orientation(f: &StaticFilter, sites: Sites<Self>, v: &[u32; 3]) -> f64 {
        let [a, b, c] = v.map(|s| sites.point(s));
        predicates::orient2d(f, a, b, c)
    }

    #[inline(always)]
    fn orientation_with(f: &StaticFilter, sites: Sites<Self>, v: &[u32; 3], i: usize, q: &[f64; 2]) -> f64 {
        // The last corner may be INFINITE, whose record at index 0 is a placeholder: it is replaced.
        let mut p = v.map(|s| sites.point(s));
        p[i] = q;
        predicates::orient2d(f, p[0], p[1], p[2])
    }

    #[inline(always)]
    fn is_in_sphere(f: &StaticFilter, sites: Sites<Self>, v: &[u32; 3], q: &[f64; 2], id: u32) -> bool {
        debug_assert!(v[2] != INFINITE);
        let [a, b, c] = v.map(|s| sites.point(s));
        let sign = predicates::incircle(f, a, b, c, q);
        if sign != 0.0 {
            return sign > 0.0;
        }
        let [i, j, k] = v.map(|s| sites.id(s));
        predicates::incircle_perturbed(f, [a, b, c, q], [i, j, k, id])
    }

    #[inline(always)]
    fn is_clear_of(sites: Sites<Self>, v: &[u32; 3], lower: &[f64; 2], upper: &[f64; 2]) -> bool {
        let [a, b, c] = v.map(|s| sites.point(s));
        predicates::is_box_outside_circle([a, b, c], [lower, upper])
    }

    fn is_dependent(f: &StaticFilter, points: &[[f64; 2]]) -> bool {
        match points {
            [] | [_] => false,
            [a, b] => a == b,
            [a, b, c] => predicates::orient2d(f, a, b, c) == 0.0,
            _ => true,
        }
    }

    #[inline(always)]
    fn exchange(
        avx2: Avx2,
        places: &mut [[f64; 2]; LANES],
        sites: &mut [Site<Self>],
        sites_of: &[u32; LANES],
    ) -> u64 {
        site::exchange_in_plane(avx2, places, sites, sites_of)
    }

    fn begin_build(_: &mut Delaunay<Self>) -> Result<()> {
        Ok(())
    }

    fn end_build(_: &mut Delaunay<Self>) {}

    fn scratch_bytes(scratch: &Self::Scratch) -> usize {
        scratch.memory_bytes()
    }

    #[inline(always)]
    fn insert<const BUILD: bool>(
        t: &mut Delaunay<Self>,
        cavity: &mut Cavity<Self>,
        start: u32,
        s: u32,
    ) -> Result<()> {
        cavity_plane::insert(t, cavity, start, s)
    }

    fn is_crossed(
        f: &StaticFilter,
        sites: Sites<Self>,
        v: &[u32; 3],
        o: &[f64; 2],
        aim: &[f64; 2],
    ) -> Option<bool> {
        let (a, b) = (sites.point(v[0]), sites.point(v[1]));
        all_positive([predicates::orient2d(f, o, aim, a), predicates::orient2d(f, o, b, aim)])
    }

    #[inline(always)]
    fn cell_holds(t: &Delaunay<Self>, cell: u32) -> bool {
        certify::triangle_holds(t, cell)
    }

    #[inline(always)]
    fn cells_hold(avx2: Avx2, t: &Delaunay<Self>, cells: &[u32; LANES], apexes: [&[u32; LANES]; 4]) -> u32 {
        screen::triangles_hold(avx2, t, cells, apexes)
    }

    #[inline(always)]
    fn facets_hold(avx2: Avx2, t: &Delaunay<Self>, edges: &[Facet; LANES]) -> u32 {
        screen::edges_hold(avx2, t, edges)
    }

    #[inline(always)]
    fn drop_outside(_: &Delaunay<Self>, _: &[u32; 3], _: &[u32], set: u64) -> u64 {
        // They are few.
        set
    }

    #[inline(always)]
    fn bicell_holds(t: &Delaunay<Self>, edge: Facet) -> bool {
        certify::bicell_holds_in_plane(t, edge)
    }

    fn stays_positive(old: &[&[f64; 2]], new: &[&[f64; 2]]) -> bool {
        let triangle = |p: &[_]| <[_; 3]>::try_from(p).expect("three corners");
        predicates::stays_positive2d(triangle(old), triangle(new))
    }

    #[inline(always)]
    fn flip(flipper: &mut Flipper<Self>, facet: Facet, flips: &mut Flips<Self>) -> Result<(), Obstacle> {
        flipper.flip_edge(facet, flips)
    }
}

impl Dimension for Space {
    const D: usize = 3;
    const BUILT_AT_LEAST: usize = 5_000;
    type Point = [f64; 3];
    type Corners = [u32; 4];
    type Scratch = cavity_space::Scratch;

    fn filter(lower: &[f64; 3], upper: &[f64; 3]) -> StaticFilter {
        StaticFilter::space(*lower, *upper)
    }

    #[inline(always)]
    fn orientation(f: &StaticFilter, sites: Sites<Self>, v: &[u32; 4]) -> f64 {
        let [a, b, c, d] = v.map(|s| sites.point(s));
        predicates::orient3d(f, a, b, c, d)
    }

    #[inline(always)]
    fn orientation_with(f: &StaticFilter, sites: Sites<Self>, v: &[u32; 4], i: usize, q: &[f64; 3]) -> f64 {
        let mut p = v.map(|s| sites.point(s));
        p[i] = q;
        predicates::orient3d(f, p[0], p[1], p[2], p[3])
    }

    #[inline(always)]
    fn is_in_sphere(f: &StaticFilter, sites: Sites<Self>, v: &[u32; 4], q: &[f64; 3], id: u32) -> bool {
        debug_assert!(v[3] != INFINITE);
        let [a, b, c, d] = v.map(|s| sites.point(s));
        let sign = predicates::insphere(f, a, b, c, d, q);
        if sign != 0.0 {
            return sign > 0.0;
        }
        let [i, j, k, l] = v.map(|s| sites.id(s));
        predicates::insphere_perturbed(f, [a, b, c, d, q], [i, j, k, l, id])
    }

    #[inline(always)]
    fn is_clear_of(sites: Sites<Self>, v: &[u32; 4], lower: &[f64; 3], upper: &[f64; 3]) -> bool {
        let [a, b, c, d] = v.map(|s| sites.point(s));
        predicates::is_box_outside_sphere([a, b, c, d], [lower, upper])
    }

    fn is_dependent(f: &StaticFilter, points: &[[f64; 3]]) -> bool {
        match points {
            [] | [_] => false,
            [a, b] => a == b,
            [a, b, c] => predicates::is_collinear3(a, b, c),
            [a, b, c, d] => predicates::orient3d(f, a, b, c, d) == 0.0,
            _ => true,
        }
    }

    #[inline(always)]
    fn exchange(
        avx2: Avx2,
        places: &mut [[f64; 3]; LANES],
        sites: &mut [Site<Self>],
        sites_of: &[u32; LANES],
    ) -> u64 {
        site::exchange_in_space(avx2, places, sites, sites_of)
    }

    fn begin_build(t: &mut Delaunay<Self>) -> Result<()> {
        t.cavity.scratch.spheres.begin(t.complex.n_cells_reserved())
    }

    fn end_build(t: &mut Delaunay<Self>) {
        t.cavity.scratch.spheres.end();
    }

    fn scratch_bytes(scratch: &Self::Scratch) -> usize {
        scratch.memory_bytes()
    }

    #[inline(always)]
    fn insert<const BUILD: bool>(
        t: &mut Delaunay<Self>,
        cavity: &mut Cavity<Self>,
        start: u32,
        s: u32,
    ) -> Result<()> {
        cavity_space::insert::<BUILD>(t, cavity, start, s)
    }

    fn is_crossed(
        f: &StaticFilter,
        sites: Sites<Self>,
        v: &[u32; 4],
        o: &[f64; 3],
        aim: &[f64; 3],
    ) -> Option<bool> {
        let [a, b, c] = [0, 1, 2].map(|i| sites.point(v[i]));
        let side = |x, y| predicates::orient3d(f, o, aim, x, y);
        all_positive([side(a, b), side(b, c), side(c, a)])
    }

    #[inline(always)]
    fn cell_holds(t: &Delaunay<Self>, cell: u32) -> bool {
        certify::tetrahedron_holds(t, cell)
    }

    #[inline(always)]
    fn cells_hold(avx2: Avx2, t: &Delaunay<Self>, cells: &[u32; LANES], apexes: [&[u32; LANES]; 4]) -> u32 {
        screen::tetrahedra_hold(avx2, t, cells, apexes)
    }

    #[inline(always)]
    fn facets_hold(avx2: Avx2, t: &Delaunay<Self>, facets: &[Facet; LANES]) -> u32 {
        screen::faces_hold(avx2, t, facets)
    }

    #[inline(always)]
    fn drop_outside(t: &Delaunay<Self>, cell: &[u32; 4], sites: &[u32], set: u64) -> u64 {
        let Some(avx2) = Avx2::new() else { return set };
        avx2.run_with(
            (t, cell),
            sites,
            set,
            #[inline(always)]
            |(t, cell), sites, set| screen::drop_outside_sphere(avx2, t, cell, sites, set),
        )
    }

    #[inline(always)]
    fn bicell_holds(t: &Delaunay<Self>, facet: Facet) -> bool {
        certify::bicell_holds_in_space(t, facet)
    }

    fn stays_positive(old: &[&[f64; 3]], new: &[&[f64; 3]]) -> bool {
        let tetrahedron = |p: &[_]| <[_; 4]>::try_from(p).expect("four corners");
        predicates::stays_positive3d(tetrahedron(old), tetrahedron(new))
    }

    #[inline(always)]
    fn flip(flipper: &mut Flipper<Self>, facet: Facet, flips: &mut Flips<Self>) -> Result<(), Obstacle> {
        flipper.flip_face(facet, flips)
    }
}

/// Whether all signs are positive; `None` if that hangs on a zero.
fn all_positive<const K: usize>(signs: [f64; K]) -> Option<bool> {
    if signs.iter().any(|&s| s < 0.0) {
        return Some(false);
    }
    signs.iter().all(|&s| s > 0.0).then_some(true)
}
