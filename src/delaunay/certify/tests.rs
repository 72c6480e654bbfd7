//! Tests of ridges.

use super::*;
use crate::delaunay::Space;

/// Whether the hull of a pyramid is convex at the diagonal of its base after one vertex of that, not on the diagonal,
/// has gone to a place.
fn is_convex_after(place: [f64; 3]) -> bool {
    let mut t = Delaunay::<Space>::default();
    let base = [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [-2.0, 0.0, 0.0], [2.0, 0.1, 0.0]];
    t.add_sites(&[&base[..], &[[0.0, 0.0, 1.0]]].concat()).expect("room for it");
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
