//! The kernel's steps in space.

use super::dimension::Space;
use super::flip::{Flipper, Flips};
use super::kernel::Kernel;
use super::site::{Site, Sites};
use super::uncertain::{Held, apexes_beyond, corners_at};
use super::winding::Ray;
use super::{Delaunay, cavity_space};
use crate::complex::{Facet, INFINITE, Obstacle, outer_of_three, outer_of_two};
use crate::ids::{SiteId, Slot, VertexId};
use crate::predicates::{self, OwnBounds3d, StaticFilter};
use crate::simd::{ALL, Avx2, LANES, Lanes, Real};

impl Kernel<Space> for Space {
    const BUILT_AT_LEAST: usize = 2_500;
    type Scratch = cavity_space::Scratch;

    fn filter(lower: &[f64; 3], upper: &[f64; 3]) -> StaticFilter {
        StaticFilter::space(*lower, *upper)
    }

    fn exact_filter<'p>(
        lower: &'p [f64; 3],
        upper: &'p [f64; 3],
        points: impl Iterator<Item = &'p [f64; 3]>,
    ) -> Option<StaticFilter> {
        predicates::exact_filter(StaticFilter::space, lower, upper, points)
    }

    #[inline(always)]
    fn orient(f: &StaticFilter, points: &[&[f64; 3]]) -> f64 {
        let &[a, b, c, d] = points else { unreachable!("a tetrahedron") };
        predicates::orient3d(f, a, b, c, d)
    }

    #[inline(always)]
    fn is_in_sphere(
        f: &StaticFilter,
        sites: Sites<Space>,
        v: &[SiteId; 4],
        q: &[f64; 3],
        id: VertexId,
    ) -> bool {
        debug_assert!(v[3] != INFINITE);
        let [a, b, c, d] = v.map(|s| sites.point(s));
        predicates::insphere_perturbed(f, [a, b, c, d, q], || {
            let [i, j, k, l] = v.map(|s| sites.id(s).get());
            [i, j, k, l, id.get()]
        })
    }

    #[inline(always)]
    fn is_clear_of(sites: Sites<Space>, v: &[SiteId; 4], lower: &[f64; 3], upper: &[f64; 3]) -> bool {
        predicates::is_box_outside_sphere(v.map(|s| sites.point(s)), [lower, upper])
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
    fn stays_positive(old: &[&[f64; 3]], new: &[&[f64; 3]]) -> bool {
        let tetrahedron = |p: &[_]| <[_; 4]>::try_from(p).expect("four corners");
        predicates::stays_positive3d(tetrahedron(old), tetrahedron(new))
    }

    #[inline(always)]
    fn cell_holds(t: &Delaunay<Space>, c: Slot) -> bool {
        let cell = t.complex.cell(c);
        let [a, b, d, e] = cell.corners.map(|s| t.view().point(s));
        let sphere = predicates::sphere(a, b, d, e);
        let side = |i| {
            let apex = t.complex.apex(cell.neighbour(i));
            let side = predicates::side_of_sphere(&sphere, a, t.view().point(apex));
            if apex == INFINITE { f64::NEG_INFINITY } else { side }
        };
        let greatest = Real::max(Real::max(side(0), side(1)), Real::max(side(2), side(3)));
        sphere[3] > t.filter.orient && greatest < -t.filter.prepared
    }

    #[inline(always)]
    fn cells_hold<const HAVE_OWN_BOUNDS: bool>(
        avx2: Avx2,
        f: &StaticFilter,
        sites: Sites<Space>,
        cells: [&[SiteId; 4]; LANES],
        apexes: [&[SiteId; LANES]; 4],
    ) -> Held {
        let [a, b, c, d] = corners(avx2, sites, cells);
        let sphere = predicates::sphere(&a, &b, &c, &d);
        let own = OwnBounds3d::new(&a, &b, &c, &d);
        let mut hold_for_all = avx2.splat(f.orient).is_less(sphere[3]);
        let are_positive = if HAVE_OWN_BOUNDS { own.volume().is_less(sphere[3]) } else { hold_for_all };
        let mut facets = [are_positive; 4];
        for (facet, apexes) in facets.iter_mut().zip(apexes) {
            let q = places(avx2, sites, *apexes);
            let side = predicates::side_of_sphere(&sphere, &a, &q);
            let is_none = avx2.are_equal(&apexes.map(SiteId::get), INFINITE.get());
            let hold = side.is_less(avx2.splat(-f.prepared)) | is_none;
            hold_for_all = hold_for_all & hold;
            *facet = if HAVE_OWN_BOUNDS {
                side.is_less(avx2.splat(0.0) - own.side(&a, &q)) | is_none
            } else {
                hold
            };
        }
        Held { positive: are_positive, facets, by_static_bounds: hold_for_all }
    }

    #[inline(always)]
    fn star_holds(avx2: Avx2, t: &Delaunay<Space>, star: &[(Slot, u8)]) -> bool {
        t.star_holds_in_lanes(avx2, star)
    }

    #[inline(always)]
    fn are_outside(
        avx2: Avx2,
        f: &StaticFilter,
        sites: Sites<Space>,
        cells: [&[SiteId; 4]; LANES],
        others: &[SiteId; LANES],
    ) -> u32 {
        let [a, b, c, d] = corners(avx2, sites, cells);
        let sphere = predicates::sphere(&a, &b, &c, &d);
        let side = predicates::side_of_sphere(&sphere, &a, &places(avx2, sites, *others));
        side.is_less(avx2.splat(-f.prepared)).bits()
    }

    #[inline(always)]
    fn ray(
        avx2: Avx2,
        f: &StaticFilter,
        sites: Sites<Space>,
        ghosts: [&[SiteId; 4]; LANES],
        o: &[f64; 3],
        aim: &[f64; 3],
    ) -> Ray {
        let [a, b, c] = [0, 1, 2].map(|i| places(avx2, sites, ghosts.map(|g| g[i])));
        let [o, aim] = [o, aim].map(|p| p.map(|x| avx2.splat(x)));
        Ray::of(avx2, f, predicates::ray_and_triangle([&a, &b, &c], &o, &aim))
    }

    #[inline(always)]
    fn are_convex(
        avx2: Avx2,
        f: &StaticFilter,
        sites: Sites<Space>,
        ghosts: [&[SiteId; 4]; LANES],
        across: [&[SiteId; LANES]; 3],
    ) -> u32 {
        let [a, b, c] = [0, 1, 2].map(|i| places(avx2, sites, ghosts.map(|g| g[i])));
        let volumes = predicates::volumes_over([&a, &b, &c], across.map(|s| places(avx2, sites, *s)));
        let bound = avx2.splat(-f.orient);
        (volumes[0].is_less(bound) & volumes[1].is_less(bound) & volumes[2].is_less(bound)).bits()
    }

    #[inline(always)]
    fn bicell_holds(t: &Delaunay<Space>, facet: Facet) -> bool {
        let cell = t.complex.cell(facet.cell());
        let across = cell.neighbour(facet.index());
        let corners = t.complex.cell(across.cell()).corners;
        let [a, b, d, e] = cell.corners.map(|s| t.view().point(s));
        let sphere = predicates::sphere(a, b, d, e);
        let side = predicates::side_of_sphere(&sphere, a, t.view().point(corners[across.index()]));
        let beyond = corners.map(|s| t.view().point(s));
        let volume = predicates::sphere(beyond[0], beyond[1], beyond[2], beyond[3])[3];
        sphere[3] > t.filter.orient && volume > t.filter.orient && side < -t.filter.prepared
    }

    #[inline(always)]
    fn facets_hold(avx2: Avx2, t: &Delaunay<Space>, faces: &[Facet; LANES]) -> u32 {
        let [k, l, m, n] = [
            corners_at(t, faces[0]),
            corners_at(t, faces[1]),
            corners_at(t, faces[2]),
            corners_at(t, faces[3]),
        ];
        let bicells = [
            places(avx2, t.view(), [k[0], l[0], m[0], n[0]]),
            places(avx2, t.view(), [k[1], l[1], m[1], n[1]]),
            places(avx2, t.view(), [k[2], l[2], m[2], n[2]]),
            places(avx2, t.view(), [k[3], l[3], m[3], n[3]]),
            places(avx2, t.view(), apexes_beyond(t, faces)),
        ];
        let hold = predicates::bicells_surely_hold3d(&t.filter, &bicells).bits();
        if hold == ALL { ALL } else { hold | predicates::bicells_hold_for_their_size3d(&bicells).bits() }
    }

    #[inline(always)]
    fn drop_outside(t: &Delaunay<Space>, cell: &[SiteId; 4], sites: &[SiteId], set: u64) -> u64 {
        let Some(avx2) = Avx2::new() else { return set };
        avx2.run_with(
            (t, cell),
            sites,
            set,
            #[inline(always)]
            |(t, cell), sites, set| drop_outside_sphere(avx2, t, cell, sites, set),
        )
    }

    /// Flips if that makes positive cells.
    fn flip(
        Flipper { filter, sites, cells, .. }: &mut Flipper<Space>,
        face: Facet,
        flips: &mut Flips<Space>,
    ) -> Result<(), Obstacle> {
        let i = face.index();
        let cell = cells.cell(face.cell())?;
        let q = sites.point(cells.apex(cell.neighbour(i))?);
        let others = [(i + 1) % 4, (i + 2) % 4, (i + 3) % 4];
        // The orientation of the cell with q in place of each corner of the facet.
        let signs = others.map(|k| Space::orientation_with(filter, *sites, &cell.corners, k, q));
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

    #[inline(always)]
    fn exchange(
        avx2: Avx2,
        places: &mut [[f64; 3]; LANES],
        [s, t, u, v]: [&mut Site<Space>; LANES],
        [lower, upper]: &mut [Lanes; 2],
    ) -> u64 {
        let places = places.as_flattened_mut();
        let new = [
            avx2.load(from(places, 0)),
            avx2.load(from(places, 3)),
            avx2.load(from(places, 6)),
            avx2.load(from(places, 8)).rotated(),
        ];
        let old =
            [avx2.load(s.padded()), avx2.load(t.padded()), avx2.load(u.padded()), avx2.load(v.padded())];
        *lower = lower.min(new[0].min(new[1]).min(new[2].min(new[3])));
        *upper = upper.max(new[0].max(new[1]).max(new[2].max(new[3])));
        // What is behind a site's point stays.
        let new = [
            new[0].with_last_of(old[0]),
            new[1].with_last_of(old[1]),
            new[2].with_last_of(old[2]),
            new[3].with_last_of(old[3]),
        ];
        new[0].store_to(s.padded_mut());
        new[1].store_to(t.padded_mut());
        new[2].store_to(u.padded_mut());
        new[3].store_to(v.padded_mut());
        // Each has one number too many, which the next one mends.
        old[0].store_to(from(places, 0));
        old[1].store_to(from(places, 3));
        old[2].store_to(from(places, 6));
        old[3].store_three_to(from(places, 9));
        (0..LANES).map(|k| u64::from(new[k].are_same(old[k]).bits() != ALL)).sum()
    }
}

/// The places of the corners of cells, by corner.
#[inline(always)]
fn corners(avx2: Avx2, all: Sites<Space>, [k, l, m, n]: [&[SiteId; 4]; LANES]) -> [[Lanes; 3]; 4] {
    [
        places(avx2, all, [k[0], l[0], m[0], n[0]]),
        places(avx2, all, [k[1], l[1], m[1], n[1]]),
        places(avx2, all, [k[2], l[2], m[2], n[2]]),
        places(avx2, all, [k[3], l[3], m[3], n[3]]),
    ]
}

#[inline(always)]
fn places(avx2: Avx2, all: Sites<Space>, sites: [SiteId; LANES]) -> [Lanes; 3] {
    let [x, y, z, _] = avx2.fours(sites.map(|s| all.padded_point(s)));
    [x, y, z]
}

/// Takes sites that are certainly outside the sphere of a tetrahedron out of a set of them, by position.
#[inline(always)]
fn drop_outside_sphere(
    avx2: Avx2,
    t: &Delaunay<Space>,
    cell: &[SiteId; 4],
    sites: &[SiteId],
    mut set: u64,
) -> u64 {
    let [a, b, c, d] = cell.map(|s| t.view().point(s));
    let [x, y, z, volume] = predicates::sphere(a, b, c, d);
    let sphere = [avx2.splat(x), avx2.splat(y), avx2.splat(z), avx2.splat(volume)];
    let a = [avx2.splat(a[0]), avx2.splat(a[1]), avx2.splat(a[2])];
    for k in (0..sites.len()).step_by(LANES) {
        if (set >> k) as u32 & ALL == 0 {
            continue;
        }
        // The last one fills the last lanes.
        let four = std::array::from_fn(|lane| sites[(k + lane).min(sites.len() - 1)]);
        let side = predicates::side_of_sphere(&sphere, &a, &places(avx2, t.view(), four));
        set &= !(u64::from(side.is_less(avx2.splat(-t.filter.prepared)).bits()) << k);
    }
    set
}

#[inline(always)]
fn from<const N: usize>(numbers: &mut [f64], first: usize) -> &mut [f64; N] {
    numbers[first..].first_chunk_mut().expect("all are there")
}
