//! Tests of sweeps and ridges.

use super::*;
use crate::delaunay::{Plane, Space};
use crate::ids::VertexId;
use crate::machine::threads::Threads;

/// A pyramid, and the diagonal of its base as a ridge, after a vertex of that, not on the diagonal, has gone to a
/// place.
fn pyramid_after(place: [f64; 3]) -> (Delaunay<Space>, Facet) {
    let mut t = Delaunay::<Space>::default();
    t.add_sites(&PYRAMID).expect("room for it");
    t.rebuild(&mut |_| true).expect("room for it");
    let site = |id| t.live_sites().find(|&s| t.site(s).id == id).expect("a site for each point");
    let [a, b, p, q] = [0, 1, 2, 3].map(|id| site(VertexId::new(id)));
    let ghosts = t.complex.live().filter(|&c| t.complex.cell(c).is_ghost());
    let ridges = ghosts.flat_map(|g| (0..3).map(move |i| Facet::new(g, i)));
    let mut ridges = ridges.filter(|&ridge| {
        let corners = t.complex.cell(ridge.cell()).corners;
        corners[ridge.index()] == p && [a, b].iter().all(|s| corners.contains(s))
    });
    let ridge = ridges.next().expect("the diagonal is a ridge");
    drop(ridges);
    t.cover(&place, &place);
    t.set_point(q, place);
    (t, ridge)
}

const PYRAMID: [[f64; 3]; 5] =
    [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [-2.0, 0.0, 0.0], [2.0, 0.1, 0.0], [0.0, 0.0, 1.0]];

/// Whether the hull is convex at the diagonal then.
fn is_convex_after(place: [f64; 3]) -> bool {
    let (t, ridge) = pyramid_after(place);
    t.is_convex(ridge)
}

#[test]
fn flat_ridges_are_convex_and_folded_ones_are_not() {
    assert!(is_convex_after([2.0, 0.1, 0.0]) && is_convex_after([0.1, 0.0, 0.0]));
    // The other diagonal would be that of the Delaunay triangulation; that is not asked.
    assert!(is_convex_after([0.2, 0.0, 0.0]) && is_convex_after([9.0, 7.0, 0.0]));
    assert!(is_convex_after([2.0, 0.1, 0.5]) && !is_convex_after([2.0, 0.1, -0.5]));
    assert!(!is_convex_after([-1.0, 0.1, 0.0]) && !is_convex_after([0.0, 0.5, 0.0]));
    assert!(!is_convex_after([-3.0, 0.0, 0.0]));
}

/// A ridge that is convex, but may not have been all the way, leaves it open how often the hull winds.
#[test]
fn ridges_that_were_flat_may_wind() {
    for (from, to, is_open) in [(0.4, 0.5, false), (0.4, 0.0, true), (0.0, 0.0, false), (-0.1, 0.5, true)] {
        let (t, ridge) = pyramid_after([2.0, 0.1, to]);
        let (mut before, mut failures) = (PYRAMID, Failures::default());
        before[3][2] = from;
        assert_eq!(t.check_ridge(ridge, &before, &mut failures), Ok(true));
        assert_eq!(failures.may_wind_twice, is_open, "from {from} to {to}");
        assert!(failures.cells.is_empty() && failures.ridges.is_empty() && failures.open_ghosts.is_empty());
    }
}

/// What a sweep lists and counts does not depend on how many threads there are, also where it ends early.
#[test]
fn sweeps_find_the_same_on_any_number_of_threads() {
    fn check<G: Geometry>(side: usize) {
        let points: Vec<G::Point> = (0..side.pow(G::D as u32))
            .map(|i| {
                let mut p = G::Point::default();
                (0..G::D).for_each(|k| p[k] = (i / side.pow(k as u32) % side) as f64);
                p
            })
            .collect();
        let sweeps = |threads| {
            let mut t = Delaunay::<G>::on(Threads::exactly(threads).in_parts(1)).expect("room");
            t.add_sites(&points).expect("room");
            t.rebuild(&mut |_| true).expect("room");
            // Sites far from each other change places: cells around them are inverted, and the lattice is full of ties.
            for s in (1..points.len() / 2).step_by(40) {
                let [a, b] = [s, points.len() - s].map(SiteId::at);
                let [p, q] = [a, b].map(|s| t.site(s).point);
                t.set_point(a, q);
                t.set_point(b, p);
            }
            let mut failures = Failures::default();
            [0, 5, 60, usize::MAX - 1].map(|most| {
                let start = tally::exact_calls();
                let is_done = t.sweep(&mut failures, most, None).expect("room");
                let exact = tally::exact_calls() - start;
                assert!(is_done == (most > 60) && (exact > 0) == is_done && !failures.cells.is_empty());
                (failures.cells.clone(), failures.facets.clone(), exact)
            })
        };
        let expected = sweeps(1);
        for threads in [2, 3, 5] {
            assert!(sweeps(threads) == expected, "{threads} threads in {}D", G::D);
        }
    }
    check::<Plane>(50);
    check::<Space>(14);
}
