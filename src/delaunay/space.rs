//! What space does on its own.

use super::cavity_space;
use super::flipper::{Flip, Flipper};
use super::flips::Flips;
use super::geometry::Geometry;
use super::in_space::InSpace;
use super::lane_tests::{Held, LaneTests, Ray, apexes_beyond, corners_at};
use super::shape::Space;
use super::signs::Signs;
use super::site::Sites;
use crate::complex::{Complex, Facet, INFINITE, Obstacle, outer_of_three, outer_of_two};
use crate::ids::{SiteId, VertexId};
use crate::predicates::{self, OwnBounds, StaticFilter};
use crate::simd::{ALL, LANES, Lanes, Real, Simd, in_lanes};

impl<P: InSpace> Signs for Space<P> {
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
        let &[a, b, c, d] = points else { unreachable!("a tetrahedron") };
        predicates::orient3d(f, a.place(), b.place(), c.place(), d.place())
    }

    #[inline(always)]
    fn is_in_sphere(f: &StaticFilter, sites: Sites<Self>, v: &[SiteId; 4], q: &P, id: VertexId) -> bool {
        debug_assert!(v[3] != INFINITE);
        let [a, b, c, d] = v.map(|s| sites.point(s));
        P::is_in_sphere(f, [a, b, c, d, q], || {
            let [i, j, k, l] = v.map(|s| sites.id(s));
            sites.keys().ranks::<Self, 5>([i, j, k, l, id], || [*a, *b, *c, *d, *q])
        })
    }

    #[inline(always)]
    fn is_clear_of(sites: Sites<Self>, v: &[SiteId; 4], lower: &P, upper: &P) -> bool {
        P::is_box_outside(v.map(|s| sites.point(s)), [lower, upper])
    }

    fn is_dependent(f: &StaticFilter, points: &[P]) -> bool {
        match points {
            [] | [_] => false,
            [a, b] => a.place() == b.place(),
            [a, b, c] => predicates::is_collinear3(a.place(), b.place(), c.place()),
            [a, b, c, d] => predicates::orient3d(f, a.place(), b.place(), c.place(), d.place()) == 0.0,
            _ => true,
        }
    }

    #[inline(always)]
    fn stays_positive(old: &[&P], new: &[&P]) -> bool {
        let tetrahedron = |p: &[&P]| [0, 1, 2, 3].map(|k| *p[k].place());
        let [old, new] = [tetrahedron(old), tetrahedron(new)];
        predicates::stays_positive3d(old.each_ref(), new.each_ref())
    }
}

impl<P: InSpace> LaneTests for Space<P> {
    #[inline(always)]
    fn cells_hold<S: Simd, const HAVE_OWN_BOUNDS: bool>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: [&[SiteId; 4]; LANES],
        apexes: [&[SiteId; LANES]; 4],
    ) -> Held<S::Lanes> {
        let [a, b, c, d] = corners(simd, sites, cells);
        let sphere = P::sphere(&a, &b, &c, &d);
        let own = P::own_bounds(&a, &b, &c, &d);
        let mut hold_for_all = simd.splat(f.orient).is_less(sphere[3]);
        let are_positive = if HAVE_OWN_BOUNDS { own.volume().is_less(sphere[3]) } else { hold_for_all };
        let mut facets = [are_positive; 4];
        for (facet, apexes) in facets.iter_mut().zip(apexes) {
            let q = P::of_sites(simd, sites, *apexes);
            let side = P::side(&sphere, &a, &q);
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
    fn are_outside<S: Simd>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: [&[SiteId; 4]; LANES],
        others: &[SiteId; LANES],
    ) -> u32 {
        let [a, b, c, d] = corners(simd, sites, cells);
        let sphere = P::sphere(&a, &b, &c, &d);
        let side = P::side(&sphere, &a, &P::of_sites(simd, sites, *others));
        side.is_less(simd.splat(-f.prepared)).bits()
    }

    #[inline(always)]
    fn ray<S: Simd>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        ghosts: [&[SiteId; 4]; LANES],
        o: &P,
        aim: &P,
    ) -> Ray {
        let [a, b, c] = [0, 1, 2].map(|i| places(simd, sites, ghosts.map(|g| g[i])));
        let [o, aim] = [o, aim].map(|p| p.place().map(|x| simd.splat(x)));
        Ray::of(simd, f, predicates::ray_and_triangle([&a, &b, &c], &o, &aim))
    }

    #[inline(always)]
    fn are_convex<S: Simd>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        ghosts: [&[SiteId; 4]; LANES],
        across: [&[SiteId; LANES]; 3],
    ) -> u32 {
        let [a, b, c] = [0, 1, 2].map(|i| places(simd, sites, ghosts.map(|g| g[i])));
        let volumes = predicates::volumes_over([&a, &b, &c], across.map(|s| places(simd, sites, *s)));
        let bound = simd.splat(-f.orient);
        (volumes[0].is_less(bound) & volumes[1].is_less(bound) & volumes[2].is_less(bound)).bits()
    }

    #[inline(always)]
    fn bicell_holds(
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: &Complex<[SiteId; 4]>,
        facet: Facet,
    ) -> bool {
        let cell = cells.cell(facet.cell());
        let across = cell.neighbour(facet.index());
        let corners = cells.cell(across.cell()).corners;
        let [a, b, d, e] = cell.corners.map(|s| sites.point(s).alone());
        let sphere = P::sphere(a, b, d, e);
        let side = P::side(&sphere, a, sites.point(corners[across.index()]).alone());
        let beyond = corners.map(|s| sites.point(s).alone());
        let volume = P::sphere(beyond[0], beyond[1], beyond[2], beyond[3])[3];
        sphere[3] > f.orient && volume > f.orient && side < -f.prepared
    }

    #[inline(always)]
    fn facets_hold<S: Simd>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: &Complex<[SiteId; 4]>,
        faces: &[Facet; LANES],
    ) -> u32 {
        let [k, l, m, n] = [
            corners_at(cells, faces[0]),
            corners_at(cells, faces[1]),
            corners_at(cells, faces[2]),
            corners_at(cells, faces[3]),
        ];
        let bicells = [
            P::of_sites(simd, sites, [k[0], l[0], m[0], n[0]]),
            P::of_sites(simd, sites, [k[1], l[1], m[1], n[1]]),
            P::of_sites(simd, sites, [k[2], l[2], m[2], n[2]]),
            P::of_sites(simd, sites, [k[3], l[3], m[3], n[3]]),
            P::of_sites(simd, sites, apexes_beyond(cells, faces)),
        ];
        let hold = predicates::bicells_surely_hold3d::<P, _>(f, &bicells).bits();
        if hold == ALL {
            ALL
        } else {
            hold | predicates::bicells_hold_for_their_size3d::<P, _>(&bicells).bits()
        }
    }

    #[inline(always)]
    fn drop_outside(
        f: &StaticFilter,
        sites: Sites<Self>,
        cell: &[SiteId; 4],
        listed: &[SiteId],
        set: u64,
    ) -> u64 {
        in_lanes!(simd, (f, sites), (cell, listed), set => |(f, sites), (cell, listed), set| {
            drop_outside_sphere(simd, f, sites, cell, listed, set)
        })
    }
}

impl<P: InSpace> Flip for Space<P> {
    /// Flips if that makes positive cells.
    fn flip(
        Flipper { filter, sites, cells, .. }: &mut Flipper<Self>,
        face: Facet,
        flips: &mut Flips<Self>,
    ) -> Result<(), Obstacle> {
        let i = face.index();
        let cell = cells.cell(face.cell())?;
        let q = sites.point(cells.apex(cell.neighbour(i))?);
        let others = [(i + 1) % 4, (i + 2) % 4, (i + 3) % 4];
        // The orientation of the cell with q in place of each corner of the facet.
        let signs = others.map(|k| Self::orientation_with(filter, *sites, &cell.corners, k, q));
        let mut not_positive = (0..3).filter(|&k| signs[k] <= 0.0);
        match (not_positive.next(), not_positive.next()) {
            (None, _) => {
                let three = cells.flip_2_3(face, &mut flips.journal)?;
                flips.made.push(three[2]);
                flips.enter(outer_of_three(three));
            }
            // The segment between the opposing vertices meets the edge opposite one corner: beyond it, or in it.
            (Some(k), None) if signs[k] < 0.0 => {
                let two = cells.flip_3_2(face, others[k], &mut flips.journal)?;
                flips.enter(outer_of_two(two));
            }
            (Some(k), None) => {
                let (three, two) = cells.flip_4_4(face, others[k], &mut flips.journal)?;
                flips.made.push(three[2]);
                flips.enter(outer_of_three(three));
                flips.enter(outer_of_two(two));
            }
            _ => return Err(Obstacle::Shape),
        }
        Ok(())
    }
}

impl<P: InSpace> Geometry for Space<P> {
    type Scratch = cavity_space::Scratch<P>;
}

/// The corners of cells, by corner.
#[inline(always)]
fn corners<S: Simd, P: InSpace>(
    simd: S,
    all: Sites<Space<P>>,
    [k, l, m, n]: [&[SiteId; 4]; LANES],
) -> [P::Of<S::Lanes>; 4] {
    [
        P::of_sites(simd, all, [k[0], l[0], m[0], n[0]]),
        P::of_sites(simd, all, [k[1], l[1], m[1], n[1]]),
        P::of_sites(simd, all, [k[2], l[2], m[2], n[2]]),
        P::of_sites(simd, all, [k[3], l[3], m[3], n[3]]),
    ]
}

#[inline(always)]
fn places<S: Simd, P: InSpace>(simd: S, all: Sites<Space<P>>, sites: [SiteId; LANES]) -> [S::Lanes; 3] {
    *P::place_of(&P::of_sites(simd, all, sites))
}

/// Takes sites that are certainly outside the sphere of a tetrahedron out of a set of them, by position.
#[inline(always)]
fn drop_outside_sphere<S: Simd, P: InSpace>(
    simd: S,
    f: &StaticFilter,
    sites: Sites<Space<P>>,
    cell: &[SiteId; 4],
    listed: &[SiteId],
    mut set: u64,
) -> u64 {
    let [a, b, c, d] = cell.map(|s| sites.point(s));
    let [x, y, z, volume] = P::sphere(a.alone(), b.alone(), c.alone(), d.alone());
    let sphere = [simd.splat(x), simd.splat(y), simd.splat(z), simd.splat(volume)];
    let a = a.in_all_lanes(simd);
    for k in (0..listed.len()).step_by(LANES) {
        if (set >> k) as u32 & ALL == 0 {
            continue;
        }
        // The last one fills the last lanes.
        let four = std::array::from_fn(|lane| listed[(k + lane).min(listed.len() - 1)]);
        let side = P::side(&sphere, &a, &P::of_sites(simd, sites, four));
        set &= !(u64::from(side.is_less(simd.splat(-f.prepared)).bits()) << k);
    }
    set
}
