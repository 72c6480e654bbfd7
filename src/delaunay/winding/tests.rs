//! Rays through several facets at a time against single facets.

use super::*;
use crate::complex::Facet;
use crate::delaunay::{Failures, Plane, Space};
use crate::random::Rng;

/// Random points, points of a small grid, or points on a sphere.
fn points<G: Geometry>(kind: usize, n: usize, rng: &mut Rng) -> Vec<G::Point> {
    let mut points = vec![G::Point::default(); n];
    for p in &mut points {
        (0..G::D).for_each(|k| p[k] = rng.unit() * 6.0 - 3.0);
        let length = (0..G::D).map(|k| p[k] * p[k]).sum::<f64>().sqrt();
        match kind {
            0 => {}
            1 => (0..G::D).for_each(|k| p[k] = p[k].floor()),
            _ => (0..G::D).for_each(|k| p[k] /= length),
        }
    }
    points
}

fn ghosts<G: Geometry>(t: &Delaunay<G>) -> Vec<Slot> {
    t.complex.live().filter(|&c| t.complex.cell(c).is_ghost()).collect()
}

/// Whether the ray from `o` through `aim` crosses the facet of a ghost cell, of which `o` is on the inner side; `None`
/// if it meets the boundary of the facet, or there is no ray.
fn crosses<G: Geometry>(t: &Delaunay<G>, ghost: Slot, o: &G::Point, aim: &G::Point) -> Option<bool> {
    let mut crosses = Some(true);
    for i in 0..G::D {
        let mut points = t.view().points(&t.complex.cell(ghost).corners);
        (points[i], points[G::D]) = (aim, o);
        let sign = G::orient(&t.filter, &points[..G::Corners::N]);
        if sign > 0.0 {
            return Some(false);
        }
        if sign == 0.0 {
            crosses = None;
        }
    }
    crosses
}

/// Each bit is right; returns how many there are, by what they say.
fn rays_agree<G: Geometry>(t: &Delaunay<G>, o: &G::Point, aim: &G::Point) -> [usize; 3] {
    let mut n_certain = [0; 3];
    for four in ghosts(t).chunks_exact(LANES) {
        let corners = [0, 1, 2, 3].map(|k| t.complex.cell(four[k]).corners);
        let ray = in_lanes!(simd => G::ray(simd, &t.filter, t.view(), corners.each_ref(), o, aim));
        for (k, &g) in four.iter().enumerate() {
            let is = |bits: u32| bits >> k & 1 == 1;
            let side = G::orientation_with(&t.filter, t.view(), &corners[k], Delaunay::<G>::LAST, o);
            let is_crossed = crosses(t, g, o, aim);
            assert!(!is(ray.inside) || side < 0.0);
            if is(ray.inside) {
                assert!(!is(ray.crossing) || is_crossed == Some(true));
                assert!(!is(ray.passing) || is_crossed == Some(false));
            }
            for (n, bits) in n_certain.iter_mut().zip([ray.inside, ray.crossing, ray.passing]) {
                *n += usize::from(is(bits));
            }
        }
    }
    n_certain
}

/// What is dropped has convex ridges alone; returns how many are dropped, and how many kept in vain.
fn dropped_ones_are_convex<G: Geometry>(t: &Delaunay<G>) -> [usize; 2] {
    let is_convex = |g: Slot| (0..G::D).all(|i| t.is_convex(Facet::new(g, i)));
    let ghosts = ghosts(t);
    let mut failures = Failures { open_ghosts: ghosts.clone(), may_wind_twice: true, ..Failures::default() };
    t.check_ridges(&mut failures, |_| None).expect("room for it");
    let failing = ghosts.iter().flat_map(|&g| (0..G::D).map(move |i| Facet::new(g, i)));
    let failing: Vec<Facet> = failing.filter(|&ridge| !t.is_convex(ridge)).collect();
    assert_eq!(failures.ridges, failing);
    let mut kept = ghosts.clone();
    t.drop_convex(&mut kept);
    assert!(ghosts.iter().all(|g| kept.contains(g) || is_convex(*g)));
    [ghosts.len() - kept.len(), kept.iter().filter(|&&g| is_convex(g)).count()]
}

fn all_agree<G: Geometry>() {
    let rng = &mut Rng::new(7);
    for kind in 0..3 {
        let (mut n_certain, mut n_convex, mut n_once) = ([0; 3], [0; 2], [0; 2]);
        for round in 0..300 {
            let mut t = Delaunay::<G>::default();
            t.add_sites(&points::<G>(kind, 12 + round, rng)).expect("room for it");
            t.rebuild(&mut |_| true).expect("room for it");
            let all = ghosts(&t);
            assert!(t.winds_once(&all) && t.exactly_winds_once(&all));
            let is_seen = t.inner_point().is_some_and(|o| t.surely_winds_once(&all, &o));
            n_once[usize::from(is_seen)] += 1;
            for size in [0.0, 1e-15, 0.03, 0.5] {
                for s in t.live_sites().collect::<Vec<_>>() {
                    let mut q = t.site(s).point;
                    (0..G::D).for_each(|k| q[k] += size * (rng.unit() - 0.5));
                    t.cover(&q, &q);
                    t.set_point(s, q);
                }
                let pair = points::<G>(round % 2, 2, rng);
                let aim = aim_in::<G>(&t.lower, &t.upper);
                t.cover(&pair[0], &pair[1]);
                for [o, aim] in [[&pair[0], &pair[1]], [&pair[0], &aim]] {
                    let more = rays_agree(&t, o, aim);
                    (0..3).for_each(|k| n_certain[k] += more[k]);
                }
                let more = dropped_ones_are_convex(&t);
                (0..2).for_each(|k| n_convex[k] += more[k]);
            }
        }
        assert!(n_certain.iter().all(|&n| n > 500), "kind {kind}: {n_certain:?}");
        // On a grid most ridges are flat, or nearly so.
        let most_are_seen = kind == 1 || n_convex[0] > n_convex[1];
        assert!(n_convex[0] > 500 && most_are_seen, "kind {kind}: {n_convex:?}");
        assert!(n_once[1] > 10 * n_once[0], "kind {kind}: {n_once:?}");
    }
}

#[test]
fn rays_agree_in_both_dimensions() {
    all_agree::<Plane>();
    all_agree::<Space>();
}
