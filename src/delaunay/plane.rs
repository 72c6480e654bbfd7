//! What the plane does on its own.

use super::around::{next_of_three, previous_of_three};
use super::flipper::{Flip, Flipper};
use super::flips::Flips;
use super::geometry::Geometry;
use super::lane_tests::{Held, LaneTests, Ray, apexes_beyond, corners_at};
use super::shape::{Plane, PowerPlane};
use super::signs::Signs;
use super::site::Sites;
use super::{cavity_marked, cavity_plane};
use crate::complex::{Complex, Facet, INFINITE, Obstacle};
use crate::ids::{SiteId, Slot, VertexId};
use crate::predicates::{self, OwnBounds, PlanePoint, StaticFilter};
use crate::simd::{ALL, LANES, Lanes, Real, Simd};

impl<P: PlanePoint> Signs for Plane<P> {
    fn filter(lower: &P, upper: &P) -> StaticFilter {
        P::filter(lower, upper)
    }

    fn exact_filter<'p>(
        lower: &'p P,
        upper: &'p P,
        points: impl Iterator<Item = &'p P>,
    ) -> Option<StaticFilter> {
        P::exact_filter(lower, upper, points)
    }

    #[inline(always)]
    fn orient(f: &StaticFilter, points: &[&P]) -> f64 {
        let &[a, b, c] = points else { unreachable!("a triangle") };
        predicates::orient2d(f, a.place(), b.place(), c.place())
    }

    #[inline(always)]
    fn is_in_sphere(f: &StaticFilter, sites: Sites<Self>, v: &[SiteId; 3], q: &P, id: VertexId) -> bool {
        debug_assert!(v[2] != INFINITE);
        let [a, b, c] = v.map(|s| sites.point(s));
        P::is_in_circle(f, [a, b, c, q], || {
            let [i, j, k] = v.map(|s| sites.id(s));
            sites.keys().ranks::<Self, 4>([i, j, k, id], || [*a, *b, *c, *q])
        })
    }

    #[inline(always)]
    fn is_clear_of(sites: Sites<Self>, v: &[SiteId; 3], lower: &P, upper: &P) -> bool {
        P::is_box_outside(v.map(|s| sites.point(s)), [lower, upper])
    }

    fn is_dependent(f: &StaticFilter, points: &[P]) -> bool {
        match points {
            [] | [_] => false,
            [a, b] => a.place() == b.place(),
            [a, b, c] => predicates::orient2d(f, a.place(), b.place(), c.place()) == 0.0,
            _ => true,
        }
    }

    #[inline(always)]
    fn stays_positive(old: &[&P], new: &[&P]) -> bool {
        let triangle = |p: &[&P]| [0, 1, 2].map(|k| *p[k].place());
        let [old, new] = [triangle(old), triangle(new)];
        predicates::stays_positive2d(old.each_ref(), new.each_ref())
    }
}

impl<P: PlanePoint> LaneTests for Plane<P> {
    #[inline(always)]
    fn cells_hold<S: Simd, const HAVE_OWN_BOUNDS: bool>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: [&[SiteId; 3]; LANES],
        apexes: [&[SiteId; LANES]; 4],
    ) -> Held<S::Lanes> {
        let [a, b, c] = corners(simd, sites, cells);
        let circle = P::circle(&a, &b, &c);
        let own = P::own_bounds(&a, &b, &c);
        let mut hold_for_all = simd.splat(f.orient).is_less(circle[2]);
        let are_positive = if HAVE_OWN_BOUNDS { own.volume().is_less(circle[2]) } else { hold_for_all };
        let mut facets = [are_positive; 4];
        for (facet, apexes) in facets.iter_mut().zip(&apexes[..3]) {
            let q = points(simd, sites, **apexes);
            let side = P::side(&circle, &a, &q);
            let is_none = simd.are_equal(&apexes.map(SiteId::get), INFINITE.get());
            let hold = side.is_less(simd.splat(-f.prepared)) | is_none;
            hold_for_all = hold_for_all & hold;
            *facet = if HAVE_OWN_BOUNDS {
                side.is_less(simd.splat(0.0) - own.side(&a, &q)) | is_none
            } else {
                hold
            };
        }
        Held { positive: are_positive, facets, by_static_bounds: hold_for_all }
    }

    #[inline(always)]
    fn star_holds<S: Simd>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: &Complex<[SiteId; 3]>,
        star: &[(Slot, u8)],
    ) -> Option<bool> {
        // The cells have the site in common: the others are its neighbours.
        let Some(&(c, at)) = star.first() else { return Some(true) };
        let center = sites.point(cells.cell(c).corners[usize::from(at)]).in_all_lanes(simd);
        for four in star.chunks(LANES) {
            let rows = [0, 1, 2, 3].map(|k| {
                // Any cells fill the last lanes.
                let (c, at) = four[k.min(four.len() - 1)];
                let (cell, at) = (cells.cell(c), usize::from(at));
                let (next, previous) = (next_of_three(at), previous_of_three(at));
                let [across, beside] = [at, next].map(|i| cells.apex(cell.neighbour(i)));
                [cell.corners[next], cell.corners[previous], across, beside]
            });
            let [next, previous, across, beside] = [0, 1, 2, 3].map(|i| rows.map(|row| row[i]));
            let are_ghosts = [next, previous].iter().flatten().any(|&s| s == INFINITE);
            let circle = P::circle(&center, &points(simd, sites, next), &points(simd, sites, previous));
            let [across_side, beside_side] =
                [across, beside].map(|s| P::side(&circle, &center, &points(simd, sites, s)));
            let is_none = simd.are_equal(&across.map(SiteId::get), INFINITE.get());
            let bound = simd.splat(-f.prepared);
            // Each edge at the site is tested from one of its cells.
            let hold = simd.splat(f.orient).is_less(circle[2])
                & (across_side.is_less(bound) | is_none)
                & beside_side.is_less(bound);
            if are_ghosts || hold.bits() != ALL {
                return Some(false);
            }
        }
        Some(true)
    }

    #[inline(always)]
    fn are_outside<S: Simd>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: [&[SiteId; 3]; LANES],
        others: &[SiteId; LANES],
    ) -> u32 {
        let [a, b, c] = corners(simd, sites, cells);
        let circle = P::circle(&a, &b, &c);
        let side = P::side(&circle, &a, &points(simd, sites, *others));
        side.is_less(simd.splat(-f.prepared)).bits()
    }

    #[inline(always)]
    fn ray<S: Simd>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        ghosts: [&[SiteId; 3]; LANES],
        o: &P,
        aim: &P,
    ) -> Ray {
        let [a, b] = [0, 1].map(|i| places(simd, sites, ghosts.map(|g| g[i])));
        let [o, aim] = [o, aim].map(|p| p.place().map(|x| simd.splat(x)));
        Ray::of(simd, f, predicates::ray_and_segment([&a, &b], &o, &aim))
    }

    #[inline(always)]
    fn are_convex<S: Simd>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        ghosts: [&[SiteId; 3]; LANES],
        across: [&[SiteId; LANES]; 3],
    ) -> u32 {
        let [a, b] = [0, 1].map(|i| places(simd, sites, ghosts.map(|g| g[i])));
        let bound = simd.splat(-f.orient);
        let [first, last] =
            [across[0], across[1]].map(|s| predicates::area(&a, &b, &places(simd, sites, *s)).is_less(bound));
        (first & last).bits()
    }

    #[inline(always)]
    fn bicell_holds(f: &StaticFilter, sites: Sites<Self>, cells: &Complex<[SiteId; 3]>, edge: Facet) -> bool {
        let cell = cells.cell(edge.cell());
        let across = cell.neighbour(edge.index());
        let corners = cells.cell(across.cell()).corners;
        let [a, b, d] = cell.corners.map(|s| sites.point(s).alone());
        let circle = P::circle(a, b, d);
        let side = P::side(&circle, a, sites.point(corners[across.index()]).alone());
        let [a, b, d] = corners.map(|s| sites.point(s).alone());
        let beyond = P::circle(a, b, d);
        circle[2] > f.orient && beyond[2] > f.orient && side < -f.prepared
    }

    #[inline(always)]
    fn facets_hold<S: Simd>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: &Complex<[SiteId; 3]>,
        edges: &[Facet; LANES],
    ) -> u32 {
        let [k, l, m, n] = [
            corners_at(cells, edges[0]),
            corners_at(cells, edges[1]),
            corners_at(cells, edges[2]),
            corners_at(cells, edges[3]),
        ];
        let bicells = [
            points(simd, sites, [k[0], l[0], m[0], n[0]]),
            points(simd, sites, [k[1], l[1], m[1], n[1]]),
            points(simd, sites, [k[2], l[2], m[2], n[2]]),
            points(simd, sites, apexes_beyond(cells, edges)),
        ];
        let hold = predicates::bicells_surely_hold2d::<P, _>(f, &bicells).bits();
        if hold == ALL {
            ALL
        } else {
            hold | predicates::bicells_hold_for_their_size2d::<P, _>(&bicells).bits()
        }
    }

    #[inline(always)]
    fn drop_outside(_: &StaticFilter, _: Sites<Self>, _: &[SiteId; 3], _: &[SiteId], set: u64) -> u64 {
        // They are few.
        set
    }
}

impl<P: PlanePoint> Flip for Plane<P> {
    /// Flips if that makes positive cells: without weights it always does.
    #[inline(always)]
    fn flip(flipper: &mut Flipper<Self>, edge: Facet, flips: &mut Flips<Self>) -> Result<(), Obstacle> {
        let Flipper { filter, sites, cells, .. } = flipper;
        if P::HAS_WEIGHT {
            let i = edge.index();
            let cell = cells.cell(edge.cell())?;
            let q = sites.point(cells.apex(cell.neighbour(i))?);
            let others = [next_of_three(i), previous_of_three(i)];
            if others.iter().any(|&k| Self::orientation_with(filter, *sites, &cell.corners, k, q) <= 0.0) {
                return Err(Obstacle::Shape);
            }
        }
        let outer = cells.flip_2_2(edge, &mut flips.journal)?;
        flips.enter(outer);
        Ok(())
    }
}

impl Geometry for Plane {
    type Scratch = cavity_plane::Scratch;
}

impl Geometry for PowerPlane {
    type Scratch = cavity_marked::Scratch;
}

/// The corners of cells, by corner.
#[inline(always)]
fn corners<S: Simd, P: PlanePoint>(
    simd: S,
    all: Sites<Plane<P>>,
    [k, l, m, n]: [&[SiteId; 3]; LANES],
) -> [P::Of<S::Lanes>; 3] {
    [
        points(simd, all, [k[0], l[0], m[0], n[0]]),
        points(simd, all, [k[1], l[1], m[1], n[1]]),
        points(simd, all, [k[2], l[2], m[2], n[2]]),
    ]
}

#[inline(always)]
fn points<S: Simd, P: PlanePoint>(simd: S, all: Sites<Plane<P>>, sites: [SiteId; LANES]) -> P::Of<S::Lanes> {
    P::load(simd, sites.map(|s| all.point(s)))
}

#[inline(always)]
fn places<S: Simd, P: PlanePoint>(simd: S, all: Sites<Plane<P>>, sites: [SiteId; LANES]) -> [S::Lanes; 2] {
    simd.pairs(sites.map(|s| all.point(s).place()))
}
