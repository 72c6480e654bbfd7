//! Crossing numbers of cells: beside rays through the segments as they were staged, in integers, and the least way over
//! edges.

use crate::common::{Rng, seeds};
use deldrift::motion::{MovingTriangulation, NO_CELL, Options, Segment};
use deldrift::{CellId, Plane, VertexId};
use std::collections::BTreeMap;

type Triangulation = MovingTriangulation<Plane>;
type Chain = Vec<[i64; 2]>;

/// A triangulation of the corners of chains, with their sides as segments, which are split where they meet.
fn triangulated(chains: &[Chain]) -> Triangulation {
    let points: Vec<[f64; 2]> = chains.iter().flatten().map(|p| p.map(|x| x as f64)).collect();
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    let (mut sides, mut first) = (Vec::new(), 0);
    for chain in chains {
        let n = chain.len() as u32;
        sides.extend((0..n).map(|k| [first + k, first + (k + 1) % n]));
        first += n;
    }
    let segment = |ends: [u32; 2]| Segment { ends: ends.map(VertexId::new), marker: 0, ..Segment::default() };
    t.stage_segments(sides.into_iter().map(segment)).expect("present");
    t.stage_splits(usize::MAX).expect("no ends meet");
    t.commit_timestamp().expect("nothing is in the way");
    t
}

/// How many sides of the chains a ray to the right from a place crosses. Places are three times the sum of corners.
fn crossed_by_ray(chains: &[Chain], [x, y]: [i64; 2]) -> usize {
    let sides = chains
        .iter()
        .flat_map(|chain| (0..chain.len()).map(move |k| [chain[k], chain[(k + 1) % chain.len()]]));
    let is_crossed = |[a, b]: &[[i64; 2]; 2]| {
        let [a, b] = [a, b].map(|p| p.map(|x| 3 * x));
        if (a[1] > y) == (b[1] > y) {
            return false;
        }
        let turn = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
        // The side goes through the ray if the place is on its left where it goes up, and on its right where it goes down.
        if b[1] > a[1] { turn < 0 } else { turn > 0 }
    };
    sides.filter(is_crossed).count()
}

/// Three times the centroid of a cell, whose corners are whole.
fn centre(t: &Triangulation, cell: CellId) -> [i64; 2] {
    let corners = t.cells().expect("room").corners[cell].map(|v| t.position(v).expect("present"));
    [0, 1].map(|axis| {
        corners
            .iter()
            .map(|p| {
                assert_eq!(p[axis].fract(), 0.0);
                p[axis] as i64
            })
            .sum()
    })
}

fn area(t: &Triangulation, is_in: impl Fn(usize) -> bool) -> f64 {
    t.volumes().expect("room").enumerate().filter(|&(cell, _)| is_in(cell)).map(|(_, area)| area).sum()
}

/// The least number of segments on a way, by relaxation; `counts_each` or one for each edge that has some.
fn relaxed(t: &Triangulation, counts_each: bool) -> Vec<u32> {
    let shown = |v| t.coincident_representative(v).expect("present");
    let mut at_edge = BTreeMap::new();
    for (_, segment) in t.segments() {
        let [v, w] = segment.ends.map(shown);
        let n = at_edge.entry([v.min(w), v.max(w)]).or_insert(0);
        *n = if counts_each { *n + 1 } else { 1 };
    }
    let view = t.cells().expect("room");
    let mut levels = vec![u32::MAX; view.corners.len()];
    loop {
        let before = levels.clone();
        for (cell, (row, neighbours)) in view.corners.iter().zip(view.neighbours).enumerate() {
            for i in 0..3 {
                let [v, w] = [row[(i + 1) % 3], row[(i + 2) % 3]];
                let from = if neighbours[i] == NO_CELL { 0 } else { levels[neighbours[i].index()] };
                let crossed = at_edge.get(&[v.min(w), v.max(w)]).copied().unwrap_or(0);
                levels[cell] = levels[cell].min(from.saturating_add(crossed));
            }
        }
        if levels == before {
            return levels;
        }
    }
}

fn rectangle([x, y]: [i64; 2], [width, height]: [i64; 2]) -> Chain {
    vec![[x, y], [x + width, y], [x + width, y + height], [x, y + height]]
}

/// Of a notch that is a chain along a side, and of an outline that is there twice.
#[test]
fn shared_sides_count_each() {
    let square = rectangle([0, 0], [4, 4]);
    let cases = [
        (vec![square.clone(), rectangle([1, 0], [2, 2])], 16.0, 12.0),
        (vec![square.clone(), square.clone()], 16.0, 0.0),
        (vec![square.clone(), square.clone(), square.clone()], 16.0, 16.0),
        (vec![square.clone(), rectangle([1, 1], [2, 2])], 12.0, 12.0),
        (vec![square.clone(), rectangle([1, 1], [2, 2]), rectangle([1, 1], [2, 2])], 12.0, 16.0),
        (vec![square, rectangle([4, 0], [3, 4])], 28.0, 28.0),
    ];
    for (chains, nested, filled) in cases {
        let t = triangulated(&chains);
        let (levels, numbers) = (t.nesting_levels().expect("room"), t.crossing_numbers().expect("room"));
        assert_eq!(area(&t, |cell| levels[cell] % 2 == 1), nested, "{chains:?}");
        assert_eq!(area(&t, |cell| numbers[cell] % 2 == 1), filled, "{chains:?}");
    }
}

/// Of rectangles whose sides cross, overlap and are there several times, the crossing number is odd where that of a ray is.
#[test]
fn crossing_numbers_are_odd_where_those_of_rays_are() {
    let (mut n_cells, mut n_differ) = (0, 0);
    for seed in seeds(60) {
        let rng = &mut Rng::new(seed);
        let mut chains: Vec<Chain> = Vec::new();
        for _ in 0..2 + rng.below(6) {
            let mut chain = rectangle([0, 0].map(|_| rng.within(0, 8)), [0, 0].map(|_| rng.within(1, 6)));
            if rng.one_in(2) {
                chain.reverse();
            }
            let copies = if rng.one_in(3) { 1 + rng.below(3) } else { 1 };
            chains.extend(std::iter::repeat_n(chain, copies));
        }
        let t = triangulated(&chains);
        let (levels, numbers) = (t.nesting_levels().expect("room"), t.crossing_numbers().expect("room"));
        assert_eq!(levels, relaxed(&t, false), "seed {seed}");
        assert_eq!(numbers, relaxed(&t, true), "seed {seed}");
        for (cell, &number) in CellId::range(0..numbers.len()).zip(&numbers) {
            let crossed = crossed_by_ray(&chains, centre(&t, cell));
            assert_eq!(number as usize % 2, crossed % 2, "seed {seed}: {cell:?}, {number}, {crossed}");
            n_differ += usize::from(number % 2 != levels[cell.index()] % 2);
        }
        n_cells += numbers.len();
    }
    assert!(n_cells > 1500 && n_differ > 100, "{n_cells} {n_differ}");
}

/// Slits, open chains and sides that divide are crossed where that is least, and pieces of refinement count as their
/// segments do.
#[test]
fn open_chains_and_pieces_are_crossed_where_that_is_least() {
    let mut t =
        triangulated(&[rectangle([0, 0], [8, 8]), rectangle([2, 2], [4, 4]), rectangle([2, 2], [4, 4])]);
    let more = [[0, 4], [2, 6], [3, 1]].map(|ends| Segment {
        ends: ends.map(VertexId::new),
        marker: 0,
        ..Segment::default()
    });
    t.stage_segments(more.into_iter()).expect("present");
    t.stage_splits(usize::MAX).expect("no ends meet");
    t.commit_timestamp().expect("nothing is in the way");
    assert_eq!(t.crossing_numbers().expect("room"), relaxed(&t, true));
    let filled = |t: &Triangulation| {
        let numbers = t.crossing_numbers().expect("room");
        area(t, |cell| numbers[cell] % 2 == 1)
    };
    let before = filled(&t);
    let mask = vec![1; t.cell_count()];
    let quality = deldrift::motion::Quality { greatest_area: 0.5, ..Default::default() };
    assert!(t.refine(&quality, &Default::default(), &mask).expect("it ends").inserted > 50);
    assert_eq!(t.crossing_numbers().expect("room"), relaxed(&t, true));
    assert!((filled(&t) - before).abs() < 1e-9);
    assert_eq!(t.nesting_levels().expect("room"), relaxed(&t, false));
}
