//! Meshes come to rest: what coarsening takes is nothing that refinement puts back.

use super::lives::{LIMIT, bytes, turned};
use super::{Domain, Triangulation, circle, mask, rectangle};
use deldrift::motion::{CoarsenOptions, Kept, Quality, RefineOptions};

/// Coarsens and refines; how many vertices have gone and come.
fn go_on(t: &mut Triangulation, quality: &Quality, keeps: Kept, n_loops: usize) -> [usize; 2] {
    let is_loop = |marker: i32| (marker as usize) < n_loops;
    let selected = mask(t, is_loop);
    let coarsening = CoarsenOptions { keeps, ..CoarsenOptions::default() };
    let removed = t.coarsen(quality, &coarsening, &selected).expect("a domain").removed;
    let selected = mask(t, is_loop);
    let options = RefineOptions { keeps, limit: LIMIT, ..RefineOptions::default() };
    [removed, t.refine(quality, &options, &selected).expect("a domain").inserted]
}

/// Beside sides that stay whole, cells are left bad. Once a vertex has gone from a segment near one, the segment may be in
/// the way of what the cell would get, too, and would be split: the vertex stays.
#[test]
fn vertices_stay_where_segments_would_be_in_the_way() {
    let in_square = Domain {
        edges: vec![[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4], [0, 7], [5, 8]],
        points: vec![
            [1.0, 0.0],
            [6.123233995736766e-17, 1.0],
            [-1.0, 1.2246467991473532e-16],
            [-1.8369701987210297e-16, -1.0],
            [0.35142278298533663, 0.11135998486354129],
            [0.15037312907743758, 0.21627044394602982],
            [0.1736357712213426, 0.013653222057549761],
            [-0.3495306196615283, 0.01211890262509041],
            [-0.3476627497607556, 0.06533093765989784],
        ],
    };
    let mut in_heptagon = Domain::default().with_ring(&circle([0.0; 2], 1.0, 7)).with_ring(&[
        [0.3055970776162554, 0.12609071440978198],
        [0.28108659703949407, 0.1983266055430716],
        [0.12904144787712094, 0.16848619189078154],
        [0.13938591483820906, 0.06346190784119324],
        [0.251913031336066, 0.008223004691619906],
    ]);
    in_heptagon.points.push([0.26665217069021796, -0.12274187576260409]);
    in_heptagon.edges.push([1, 12]);
    let conforming =
        Quality { least_angle: 20.0, greatest_area: 0.05, is_conforming: true, ..Quality::default() };
    let by_angles = Quality { least_angle: 25.0, ..Quality::default() };
    for (domain, n_loops, quality) in [(in_square, 7, conforming), (in_heptagon, 12, by_angles)] {
        let mut t = domain.build();
        for _ in 0..3 {
            go_on(&mut t, &quality, Kept::Outer, n_loops);
        }
        let before = bytes(&t);
        let done = go_on(&mut t, &quality, Kept::Outer, n_loops);
        assert!(done == [0, 0] && bytes(&t) == before, "{done:?}, {domain:?}");
    }
}

/// Without a least angle pieces are split at vertices that are on them but for rounding: these stay.
#[test]
fn vertices_stay_beside_vertices_on_segments() {
    let mut n_split = 0;
    for k in 0..200 {
        let height = [1e-9, 1e-10, 1e-11, 1e-12][k % 4];
        let mut domain = Domain::default()
            .with_ring(&rectangle([-2.0, -2.0], [2.0, 2.0]))
            .with_chain(&[[-1.0, 0.0], [1.0, 0.0]]);
        domain.points.push([0.003 * k as f64, height]);
        domain.points = turned(&domain.points, 0.1 + 0.01 * k as f64);
        let quality = Quality { greatest_area: 10.0, ..Quality::default() };
        let mut t = domain.build();
        for _ in 0..2 {
            go_on(&mut t, &quality, Kept::None, 4);
        }
        let before = bytes(&t);
        let done = go_on(&mut t, &quality, Kept::None, 4);
        assert!(done == [0, 0] && bytes(&t) == before, "{k}, {height}: {done:?}");
        n_split += usize::from(t.made_vertices().next().is_some());
    }
    assert!(n_split > 20, "{n_split}");
}
