//! Flips that are stuck. In the plane an edge that fails can always be flipped without weights. With weights it may
//! not: the quadrilateral around it need not be convex, and the vertex that is in its way can vanish by a flip only
//! if it has three neighbours (Edelsbrunner and Shah, 10.1007/BF01975867). Whoever flips from such a state must
//! notice, and place vertices instead.

use super::definition::{Points, check, to_point};
use super::{fresh, shown};
use crate::common::exact::{Grid, is_inside_lifted, orientation};
use crate::common::{CellSet, Rng, cell_set, vertices};
use deldrift::internals::PowerPlane;
use deldrift::motion::{Algorithm, MovingTriangulation, Options, Saved};
use deldrift::{Shape, VertexId};
use std::collections::{BTreeMap, BTreeSet};

type Point = <PowerPlane as Shape>::Point;
/// Coordinates and the weight.
type Numbers = [i64; 3];

/// What the edges of cells are when vertices have moved and cells have not changed yet.
#[derive(Debug, PartialEq)]
enum Edges {
    /// A cell has turned over, or the hull is not convex any more.
    Torn,
    Regular,
    /// One that fails can be flipped, or a vertex of three neighbours beside one can vanish.
    Flippable,
    /// So many fail, and no flip is possible at any of them.
    Stuck(usize),
}

/// Looks at the edges of cells by ids, counter-clockwise before the move, at these points.
fn edges_of(cells: &CellSet, points: &[Numbers]) -> Edges {
    let places: Vec<Grid> = points.iter().map(|p| p[..2].to_vec()).collect();
    let turn = |a: VertexId, b: VertexId, c: VertexId| orientation(&[a, b, c].map(|v| &places[v.index()]));
    let lift = |v: VertexId| {
        let [x, y, w] = points[v.index()].map(i128::from);
        x * x + y * y - w
    };
    let (mut beyond, mut neighbours) = (BTreeMap::new(), BTreeMap::<VertexId, BTreeSet<VertexId>>::new());
    for cell in cells {
        let (a, b, c) = (cell[0], cell[1], cell[2]);
        for (u, v, w) in [(a, b, c), (b, c, a), (c, a, b)] {
            beyond.insert((u, v), w);
            neighbours.entry(u).or_default().extend([v, w]);
        }
        if turn(a, b, c) <= 0 {
            return Edges::Torn;
        }
    }
    let hull: Vec<(VertexId, VertexId)> =
        beyond.keys().copied().filter(|&(u, v)| !beyond.contains_key(&(v, u))).collect();
    let all = || VertexId::range(0..points.len());
    if hull.iter().any(|&(u, v)| all().any(|w| turn(u, v, w) < 0)) {
        return Edges::Torn;
    }
    let is_on_hull = |v: VertexId| hull.iter().any(|&(u, _)| u == v);
    let (mut n_failing, mut n_flippable) = (0, 0);
    for (&(u, v), &w) in &beyond {
        let Some(&x) = beyond.get(&(v, u)).filter(|_| u < v) else { continue };
        let all = [u, v, w, x];
        if !is_inside_lifted(&all.map(|v| &places[v.index()]), &all.map(lift), &all) {
            continue;
        }
        n_failing += 1;
        let is_convex = turn(x, v, w) > 0 && turn(w, u, x) > 0;
        let may_vanish = |v: VertexId| neighbours[&v].len() == 3 && !is_on_hull(v);
        n_flippable += usize::from(is_convex || may_vanish(u) || may_vanish(v));
    }
    match (n_failing, n_flippable) {
        (0, _) => Edges::Regular,
        (n, 0) => Edges::Stuck(n),
        _ => Edges::Flippable,
    }
}

/// Cells by ids, counter-clockwise at these places, from the lowest id on.
fn turned(cells: &CellSet, points: &[Numbers]) -> CellSet {
    let place = |v: VertexId| -> Grid { points[v.index()][..2].to_vec() };
    let turn = |cell: &Vec<VertexId>| {
        let places: Vec<Grid> = cell.iter().map(|&v| place(v)).collect();
        let is_left = orientation(&places.iter().collect::<Vec<_>>()) > 0;
        if is_left { cell.clone() } else { vec![cell[0], cell[2], cell[1]] }
    };
    cells.iter().map(turn).collect()
}

fn build(points: &[Numbers]) -> MovingTriangulation<PowerPlane> {
    MovingTriangulation::new(&as_points(points), Options::default()).expect("a build")
}

fn as_points(points: &[Numbers]) -> Vec<Point> {
    points.iter().map(|p| to_point::<PowerPlane>(p)).collect()
}

/// A commit from one set to another one, by every algorithm, of all at once or of those that move, and one vertex
/// after the other.
fn reach(from: &[Numbers], to: &[Numbers], name: &str) {
    let goals = as_points(to);
    let present: Vec<Option<Point>> = goals.iter().copied().map(Some).collect();
    let expected = fresh::<PowerPlane>(&present);
    let numbers: Points = to.iter().map(|p| Some(p.to_vec())).collect();
    let built = build(from);
    let moving: Vec<VertexId> =
        vertices().zip(from.iter().zip(to)).filter(|(_, (p, q))| p != q).map(|(v, _)| v).collect();
    let moves: Vec<Point> = moving.iter().map(|v| goals[v.index()]).collect();
    for algorithm in Algorithm::ALL {
        for is_whole in [true, false] {
            let mut t = built.try_clone(None).expect("room");
            t.set_algorithm(algorithm);
            if is_whole {
                t.commit_positions(&goals).expect("room");
            } else {
                t.move_vertices(&moving, &moves).expect("good places");
                t.commit_timestamp().expect("room");
            }
            assert_eq!(shown(&t), expected, "{name}, {algorithm:?}");
            if algorithm == Algorithm::Auto {
                check(&t, &numbers, name);
            }
        }
    }
    let mut t = built;
    for (&v, q) in moving.iter().zip(&moves) {
        t.relocate_vertex(v, q).expect("room");
    }
    assert_eq!(shown(&t), expected, "{name}, one after the other");
}

/// Three vertices within a triangle, each at the end of an arm that the next one is near: as they turn back and rise,
/// none of the six edges at them can be flipped. Where they are at first, and then; the weight is what they lose.
fn pinwheel(is_turned: bool, weight: i64) -> [Numbers; 6] {
    let [a, b, c] = if is_turned { [[-3, 10], [-7, -7], [10, -3]] } else { [[9, 3], [-8, 6], [-2, -10]] };
    let outer = [[0, 40, 0], [-35, -20, 0], [35, -20, 0]];
    let inner = [a, b, c].map(|[x, y]| [x, y, -weight]);
    [outer[0], outer[1], outer[2], inner[0], inner[1], inner[2]]
}

/// Several beside each other.
fn pinwheels(side: i64, state: impl Fn(i64) -> (bool, i64)) -> Vec<Numbers> {
    let at = |k: i64| {
        let (is_turned, weight) = state(k);
        pinwheel(is_turned, weight)
            .map(|[x, y, w]| [x + 200 * (k % side), y + 190 * (k / side) + 7 * (k % side), w])
    };
    (0..side * side).flat_map(at).collect()
}

#[test]
fn flips_that_are_stuck_at_a_pinwheel_end_in_fresh_builds() {
    let start = pinwheel(false, 0);
    let cells = turned(&cell_set(&build(&start)), &start);
    assert_eq!((cells.len(), edges_of(&cells, &start)), (7, Edges::Regular));
    for weight in [1_600, 6_400, 1_000_000] {
        let goal = pinwheel(true, weight);
        assert_eq!(edges_of(&cells, &goal), Edges::Stuck(6), "{weight}");
        reach(&start, &goal, "pinwheel");
        assert_eq!(build(&goal).vertices_hidden_by_weight().expect("room").len(), 3);
    }
    // With less to lose they are no more stuck than without weights.
    assert_eq!(edges_of(&cells, &pinwheel(true, 800)), Edges::Flippable);
    reach(&start, &pinwheel(true, 800), "pinwheel");
    // Many at once, all or some of which are stuck; and back.
    for side in [2, 5, 9] {
        let start = pinwheels(side, |_| (false, 0));
        let cells = turned(&cell_set(&build(&start)), &start);
        let all = pinwheels(side, |k| (true, 1_600 + 10 * k));
        assert_eq!(edges_of(&cells, &all), Edges::Stuck(6 * (side * side) as usize));
        let some = pinwheels(side, |k| if k % 3 == 0 { (true, 2_000) } else { (false, k % 2) });
        for goal in [all, some] {
            reach(&start, &goal, "pinwheels");
            reach(&goal, &start, "back");
        }
    }
}

/// A triangulation that is stuck again and again is the fresh one each time, also on copies, and stays at rest between.
#[test]
fn what_has_been_stuck_lasts() {
    let (start, goal) = (pinwheels(3, |_| (false, 0)), pinwheels(3, |_| (true, 2_000)));
    let sets = [start, goal].map(|set| as_points(&set));
    let expected = sets.each_ref().map(|set| {
        let t = MovingTriangulation::<PowerPlane>::new(set, Options::default()).expect("a build");
        shown(&t)
    });
    for algorithm in Algorithm::ALL {
        let mut t = MovingTriangulation::<PowerPlane>::new(&sets[0], Options::default()).expect("a build");
        t.set_algorithm(algorithm);
        for step in 0..200 {
            let which = usize::from(step % 4 < 2);
            let report = t.commit_positions(&sets[which]).expect("room");
            if step % 2 == 1 {
                assert_eq!(
                    (report.moved, report.newly_hidden, report.newly_shown),
                    (0, 0, 0),
                    "{algorithm:?}, {step}"
                );
            }
            if step % 8 == 5 {
                t = t.try_clone(None).expect("room");
            }
            if step % 8 == 6 {
                let bytes = t.saved().expect("room");
                t = MovingTriangulation::load(&Saved::of(&bytes).expect("whole"), Options::default())
                    .expect("saved");
                t.set_algorithm(algorithm);
            }
            if step % 5 == 0 {
                assert_eq!(shown(&t), expected[which], "{algorithm:?}, {step}");
            }
            // A commit that is withdrawn in between leaves what there was.
            if step % 20 == 3 {
                t.move_all(&sets[1 - which]).expect("good places");
                t.prepare_timestamp().expect("room");
                assert_eq!(shown(&t), expected[1 - which], "{algorithm:?}, {step}, prepared");
                t.withdraw_timestamp();
                assert_eq!(shown(&t), expected[which], "{algorithm:?}, {step}, withdrawn");
                t.discard_moves();
            }
        }
    }
}

/// Random ones: one vertex that moves or loses weight, and several.
#[test]
fn flips_that_are_stuck_at_random_end_in_fresh_builds() {
    let rng = &mut Rng::new(1);
    let (mut n_by_one, mut n_by_several) = (0, 0);
    for _ in 0..6_000 {
        let (n, extent) = (6 + rng.below(6), *rng.pick(&[10, 20, 40]));
        let most = extent * extent / *rng.pick(&[16, 4, 2]);
        let start: Vec<Numbers> =
            (0..n).map(|_| [rng.within(0, extent), rng.within(0, extent), rng.within(0, most)]).collect();
        let t = build(&start);
        if t.cell_count() == 0 || !t.vertices_hidden_by_weight().expect("room").is_empty() {
            continue;
        }
        let cells = turned(&cell_set(&t), &start);
        for _ in 0..20 {
            let mut goal = start.clone();
            let n_moving = if rng.one_in(2) { 1 } else { 2 + rng.below(3) };
            for _ in 0..n_moving {
                let p = &mut goal[rng.below(n)];
                if rng.one_in(2) {
                    (0..2).for_each(|k| p[k] += rng.within(-extent / 4, extent / 4));
                }
                p[2] -= rng.within(-most, most);
            }
            if let Edges::Stuck(_) = edges_of(&cells, &goal) {
                if n_moving == 1 {
                    n_by_one += 1
                } else {
                    n_by_several += 1
                }
                reach(&start, &goal, "at random");
            }
        }
    }
    assert!(n_by_one > 30 && n_by_several > 30, "{n_by_one} by one vertex, {n_by_several} by several");
}
