//! Tests of ridges.

use super::*;
use crate::delaunay::Space;
use crate::ids::VertexId;

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
