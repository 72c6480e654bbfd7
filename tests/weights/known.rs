//! Sets that others test their regular triangulations with: those of CGAL (`test_regular_3.cpp`,
//! `test_regular_remove_3.cpp` with its data, `_test_cls_regular_triangulation_2.h`, issues 3175, 3186 and 3188
//! there) and of GUDHI's weighted alpha complexes. The oracle is the definition in exact integers.

mod sets;

use super::definition::{Points, by_weight, check, to_point};
use super::fresh;
use crate::common::inputs::{KINDS, draw};
use crate::common::{Rng, assert_same_cells, cell_set, vertex};
use deldrift::internals::{PowerPlane, PowerSpace};
use deldrift::motion::{Algorithm, MovingTriangulation, Options, PointPart, Saved};
use deldrift::{Dimension, Moving, Plane, Space, VertexId};
use num_bigint::BigInt;
use sets::{Set, in_plane, line_in_plane, listed, numbered, of_alpha_complexes, of_quadratic_forms};
use sets::{on_grid, sets, sets_in_plane, sheared_grid, without_third_axis};

fn build<G: Moving>(set: &[Vec<i64>]) -> MovingTriangulation<G> {
    let points: Vec<G::Point> = set.iter().map(|p| to_point::<G>(p)).collect();
    MovingTriangulation::new(&points, Options::default()).expect("a build")
}

fn all(set: &[Vec<i64>]) -> Points {
    set.iter().cloned().map(Some).collect()
}

fn loaded<G: Moving>(t: &MovingTriangulation<G>) -> MovingTriangulation<G> {
    let bytes = t.saved().expect("room");
    MovingTriangulation::load(&Saved::of(&bytes).expect("whole"), Options::default()).expect("saved")
}

/// As CGAL does, always the first one that is shown, so that hidden ones come back, until nothing is left.
fn empty<G: Moving>(
    t: &mut MovingTriangulation<G>,
    points: &mut Points,
    is_checked: impl Fn(usize) -> bool,
    name: &str,
) -> usize {
    let mut n_came_back = 0;
    while t.vertex_count() > 0 {
        let hidden = t.vertices_hidden_by_weight().expect("room");
        let shown =
            (0..points.len()).map(VertexId::at).find(|v| points[v.index()].is_some() && !hidden.contains(v));
        let v = shown.unwrap_or_else(|| panic!("{name}: all of {} are hidden", t.vertex_count()));
        t.remove_vertex(v).expect("room");
        points[v.index()] = None;
        n_came_back += usize::from(t.vertices_hidden_by_weight().expect("room").len() < hidden.len());
        if is_checked(t.vertex_count()) {
            check(t, points, &format!("{name}, {} left", t.vertex_count()));
        }
    }
    n_came_back
}

fn grow_and_empty<G: Moving>(name: &str, set: &Set) -> usize {
    let mut n_came_back = 0;
    let context = |what: &str| format!("{}D, {name}, {what}", G::D);
    check(&build::<G>(set), &all(set), &context("built"));
    let mut t = build::<G>(&[]);
    let mut points = Points::new();
    // What has been emptied is filled again, with other ids.
    for round in ["grown", "grown again"] {
        for p in set {
            t.insert_vertex(&to_point::<G>(p)).expect("room");
            points.push(Some(p.clone()));
            check(&t, &points, &context(round));
        }
        let mut copies = [t.try_clone(None).expect("room"), loaded(&t)];
        for copy in &mut copies {
            n_came_back += empty(copy, &mut points.clone(), |n| n % 5 == 0, &context("a copy is emptied"));
        }
        n_came_back += empty(&mut t, &mut points, |_| true, &context("emptied"));
    }
    n_came_back
}

#[test]
fn sets_of_others_grow_and_are_emptied() {
    let in_space: usize = sets().iter().map(|(name, set)| grow_and_empty::<PowerSpace>(name, set)).sum();
    let in_plane: usize =
        sets_in_plane().iter().map(|(name, set)| grow_and_empty::<PowerPlane>(name, set)).sum();
    assert!(in_space > 100 && in_plane > 50, "hidden ones come back: {in_space} and {in_plane} times");
}

/// Every algorithm comes to each set from others, and stays there: at rest, with weights that come and go, on copies.
fn come_to_and_last<G: Moving>(name: &str, set: &Set) {
    let goals: Vec<G::Point> = set.iter().map(|p| to_point::<G>(p)).collect();
    let expected = fresh::<G>(&goals.iter().copied().map(Some).collect::<Vec<_>>());
    for algorithm in Algorithm::ALL {
        // Elsewhere all weights are equal, or they are those of the next vertices.
        for is_elsewhere in [true, false] {
            let start: Set = (0..set.len())
                .map(|i| {
                    let mut p = set[i].clone();
                    p[G::D] = if is_elsewhere { 3 } else { set[(i + 1) % set.len()][G::D] };
                    if is_elsewhere {
                        (0..G::D).for_each(|k| p[k] += (i as i64 * (k as i64 + 3)) % 5 - 2);
                    }
                    p
                })
                .collect();
            let mut t = build::<G>(&start);
            t.set_algorithm(algorithm);
            let context = format!("{}D, {name}, {algorithm:?}", G::D);
            t.commit_positions(&goals).expect("room");
            check(&t, &all(set), &context);
            assert_eq!(super::shown(&t), expected, "{context}");
        }
    }
    let mut t = build::<G>(set);
    for step in 0..200 {
        t.set_algorithm(Algorithm::ALL[step % Algorithm::ALL.len()]);
        let report = t.commit_positions(&goals).expect("room");
        let told = (report.moved, report.reweighted, report.newly_hidden, report.newly_shown);
        assert_eq!(told, (0, 0, 0, 0), "{name}, at rest {step}");
        if step % 20 == 7 {
            t = t.try_clone(None).expect("room");
        }
        if step % 20 == 17 {
            t = loaded(&t);
        }
        if step % 10 == 0 {
            assert_eq!(super::shown(&t), expected, "{name}, at rest {step}");
        }
    }
    check(&t, &all(set), name);
}

#[test]
fn sets_of_others_are_reached_and_last() {
    for (name, set) in sets() {
        come_to_and_last::<PowerSpace>(&name, &set);
    }
    for (name, set) in sets_in_plane() {
        come_to_and_last::<PowerPlane>(&name, &set);
    }
}

/// The sizes that CGAL removes: 100 points of a plane, 500 in space; and its large sets as they are built and grow.
#[test]
fn large_sets_of_others_grow_and_are_emptied() {
    fn check_large<G: Moving>(name: &str, set: &Set, is_checked: fn(usize) -> bool) -> usize {
        let mut t = build::<G>(set);
        check(&t, &all(set), &format!("{}D, {name}, built", G::D));
        let mut grown = build::<G>(&[]);
        for p in set {
            grown.insert_vertex(&to_point::<G>(p)).expect("room");
        }
        check(&grown, &all(set), &format!("{}D, {name}, grown", G::D));
        empty(&mut t, &mut all(set), is_checked, name)
    }
    let mut n_came_back = 0;
    for seed in [42, 7] {
        let (flat, full) = (on_grid(2, 100, seed), on_grid(3, 500, seed));
        n_came_back += check_large::<PowerSpace>("grid of two axes", &flat, |n| n % 10 == 0);
        n_came_back += check_large::<PowerPlane>("grid of two axes", &without_third_axis(&flat), |_| true);
        n_came_back += check_large::<PowerSpace>("grid of three axes", &full, |n| n % 50 == 0 || n < 20);
    }
    let sheared = sheared_grid(20, [1, -1, -2, 5]);
    n_came_back += check_large::<PowerSpace>("sheared grid", &sheared, |n| n % 100 == 0);
    n_came_back += check_large::<PowerPlane>("sheared grid", &without_third_axis(&sheared), |n| n % 50 == 0);
    n_came_back += check_large::<PowerSpace>("quadratic forms", &of_quadratic_forms(), |n| n % 50 == 0);
    assert!(n_came_back > 200, "{n_came_back} times");
}

/// What CGAL asserts of its points in the plane.
#[test]
fn numbers_of_others_hold() {
    // Three of five on a line are shown.
    let line = build::<PowerPlane>(&without_third_axis(&line_in_plane())[..5]);
    assert_eq!(line.vertices_hidden_by_weight(), Ok(vec![vertex(2), vertex(3)]));
    // Three of four that span the plane; all nine of a sheared grid.
    let four = build::<PowerPlane>(&without_third_axis(
        &[(0, 4), (1, 80), (2, 80), (3, 4)].map(|(i, w)| numbered(i, w)),
    ));
    assert_eq!(four.vertices_hidden_by_weight(), Ok(vec![vertex(3)]));
    assert_eq!(four.cell_count(), 1);
    let nine = build::<PowerPlane>(&without_third_axis(&sheared_grid(3, [1; 4])));
    assert_eq!((nine.vertices_hidden_by_weight(), nine.cell_count()), (Ok(Vec::new()), 8));
    // Of those that come later, three are hidden at a vertex, on an edge and in a cell, and change nothing.
    let set = without_third_axis(&in_plane());
    let mut t = build::<PowerPlane>(&set[..11]);
    let before = cell_set(&t);
    for p in &set[11..14] {
        let v = t.insert_vertex(&to_point::<PowerPlane>(p)).expect("room");
        assert_same_cells(&cell_set(&t), &before, || format!("{v} is hidden"));
    }
    assert_eq!(t.hidden_by_place().expect("room"), [(vertex(11), vertex(4)), (vertex(12), vertex(2))]);
    assert!(t.vertices_hidden_by_weight().expect("room").contains(&vertex(13)));
    let with_hidden = (cell_set(&t), t.vertices_hidden_by_weight(), t.hidden_by_place());
    for p in &set[14..] {
        t.insert_vertex(&to_point::<PowerPlane>(p)).expect("room");
    }
    let n_hidden = t.vertices_hidden_by_weight().expect("room").len();
    assert!(n_hidden > with_hidden.1.as_ref().expect("room").len(), "the last one hides others");
    // They go in the other order, and what they hide comes back.
    for v in [16, 15, 14] {
        t.remove_vertex(vertex(v)).expect("room");
    }
    assert_eq!((cell_set(&t), t.vertices_hidden_by_weight(), t.hidden_by_place()), with_hidden);
}

/// With equal weights, of whatever size, cells and ties are those without weights, for sets of all kinds.
#[test]
fn equal_weights_are_delaunay() {
    fn check<P: Dimension, W: Moving>(rng: &mut Rng) {
        for kind in KINDS {
            for weight in [0.0, 0.3, -7.0, 1e100] {
                let plain = draw::<P>(kind, 60, rng);
                let weighted: Vec<W::Point> = plain
                    .iter()
                    .map(|p| {
                        let mut q = W::Point::default();
                        (0..W::D).for_each(|k| q[k] = p[k]);
                        q[W::D] = weight;
                        q
                    })
                    .collect();
                let plain = MovingTriangulation::<P>::new(&plain, Options::default()).expect("a build");
                let t = MovingTriangulation::<W>::new(&weighted, Options::default()).expect("a build");
                assert_same_cells(&cell_set(&t), &cell_set(&plain), || format!("{kind:?}, {weight}"));
                assert_eq!(by_weight(&t), [], "{kind:?}, {weight}");
                let hidden: Vec<_> = plain.hidden_vertices().collect();
                assert_eq!(t.hidden_by_place(), Ok(hidden), "{kind:?}, {weight}");
            }
        }
    }
    let rng = &mut Rng::new(1);
    check::<Plane, PowerPlane>(rng);
    check::<Space, PowerSpace>(rng);
}

/// What an insertion does: its place and weight, and who is hidden then.
struct Case {
    numbers: [i64; 4],
    by_place: Option<VertexId>,
    by_weight: Option<VertexId>,
    /// How many are newly hidden, the inserted one included.
    newly_hidden: u64,
}

/// Which of four things an insertion is can be told before it is made: shown beside others, shown in the place of a
/// lighter one, hidden at the place of one as heavy or heavier, or hidden by weight; and whom it hides.
#[test]
fn what_an_insertion_does_is_told_before_it() {
    let set = listed(&[[0, 0, 0, 1], [8, 0, 0, 1], [0, 8, 0, 1], [0, 0, 8, 1], [2, 2, 2, -1]]);
    let mut t = build::<PowerSpace>(&set);
    let before = (cell_set(&t), t.vertices_hidden_by_weight().expect("room"));
    let new = vertex(5);
    let case =
        |numbers, by_place, by_weight, newly_hidden| Case { numbers, by_place, by_weight, newly_hidden };
    let cases = [
        case([8, 8, 8, 0], None, None, 0),
        case([2, 2, 2, 5], Some(vertex(4)), None, 1),
        case([2, 2, 2, -1], Some(new), None, 1),
        case([2, 2, 2, -5], Some(new), None, 1),
        case([1, 1, 1, -90], None, Some(new), 1),
        case([3, 3, 3, 30], None, Some(vertex(4)), 1),
    ];
    for Case { numbers, by_place, by_weight: above, newly_hidden } in cases {
        let p = to_point::<PowerSpace>(&numbers);
        for round in 0..200 {
            t.stage_insertions(&[p]).expect("room");
            let report = t.prepare_timestamp().expect("room");
            assert_eq!(report.newly_hidden, newly_hidden, "{numbers:?}, {round}");
            let hidden: Vec<VertexId> =
                t.hidden_by_place().expect("room").into_iter().map(|(v, _)| v).collect();
            assert_eq!(hidden, by_place.into_iter().collect::<Vec<_>>(), "{numbers:?}, {round}");
            assert_eq!(by_weight(&t), above.into_iter().collect::<Vec<_>>(), "{numbers:?}, {round}");
            t.withdraw_timestamp();
            t.discard_moves();
            assert_eq!((cell_set(&t), t.vertices_hidden_by_weight().expect("room")), before, "{numbers:?}");
        }
        let mut made = t.try_clone(None).expect("room");
        assert_eq!(made.insert_vertex(&p), Ok(new));
        check(&made, &set.iter().cloned().chain([numbers.to_vec()]).map(Some).collect(), "inserted");
        // One that is hidden for good is removed, which changes no cell.
        let cells = cell_set(&made);
        if by_place == Some(new) || above == Some(new) {
            made.remove_vertex(new).expect("room");
            assert_same_cells(&cell_set(&made), &cells, || format!("{numbers:?}"));
        }
    }
}

/// The nearest vertices by power of CGAL's cube as its corners come, and at the power centres of its cells.
#[test]
fn nearest_vertices_of_others_hold() {
    let cube = &of_alpha_complexes()[2];
    let centre = to_point::<PowerSpace>(&[1, 1, 1, 0]);
    let mut t = build::<PowerSpace>(&[]);
    let twice = |p: &Vec<i64>| [2 * p[0], 2 * p[1], 2 * p[2], 4 * p[3]];
    for (n, nearest) in [(2, 1), (4, 3), (8, 7)] {
        for p in &cube[t.id_count()..n] {
            t.insert_vertex(&to_point::<PowerSpace>(&twice(p))).expect("room");
        }
        assert_eq!(t.nearest_vertex(&centre), Ok(Some(vertex(nearest))), "of {n}");
    }
    let set: Set = cube.iter().map(|p| twice(p).to_vec()).collect();
    check(&t, &all(&set), "cube");
    let corners = t.cells().expect("room").corners;
    assert!(!corners.is_empty());
    for ((centre, _), cell) in t.circumspheres().expect("room").zip(corners) {
        let nearest = t.nearest_vertex(&centre).expect("room").expect("a vertex");
        // Several may be at the same power distance from it.
        let power = |v: VertexId| {
            let p = t.position(v).expect("present");
            (0..3).map(|k| (p[k] - centre[k]).powi(2)).sum::<f64>() - p.weight
        };
        assert!((power(nearest) - power(cell[0])).abs() < 1e-9, "{cell:?} and {nearest}");
    }
}

/// The least value at which the edge of two vertices on a line is in a weighted alpha complex, times four squares of
/// their distance, and that times the value given: with d, v and w in units of 2^-60 and of its square.
fn alpha_of_edge(d: f64, v: f64, w: f64, value: f64) -> (BigInt, BigInt) {
    let scaled = |x: f64, shift: u32| {
        let bits = x.to_bits();
        let (mantissa, exponent) =
            ((bits & ((1 << 52) - 1)) | (1 << 52), (bits >> 52 & 0x7ff) as i64 - 1_075);
        let shift = exponent + i64::from(shift);
        BigInt::from(mantissa) * BigInt::from(2).pow(shift.try_into().expect("a number of enough bits"))
    };
    let (d, v, w, value) = (scaled(d, 60), scaled(v, 120), scaled(w, 120), scaled(value, 120));
    let sum = &d * &d + &v - w;
    (&sum * &sum - BigInt::from(4) * &d * &d * v, BigInt::from(4) * &d * &d * value)
}

/// GUDHI's two vertices of very different weights on a line are both shown, and their edge has the value 249,900; of
/// three the one between is hidden.
#[test]
fn alpha_values_of_others_hold() {
    // With the decimal numbers exactly, here times 10,000; with those of the machine nearly.
    let (found, expected) = alpha_of_edge(10.0, 1e6, 100.0, 2_499e6);
    assert_eq!(found, expected);
    let (found, expected) = alpha_of_edge(0.1, 100.0, 0.01, 249_900.0);
    let (below, within) = (&expected - &found, alpha_of_edge(0.1, 100.0, 0.01, 5e-11).1);
    assert!(below > BigInt::from(0) && below < within, "less by at most 5e-11");

    fn point<G: Moving>([x, y, w]: [f64; 3]) -> G::Point {
        let mut p = G::Point::default();
        (p[0], p[1], p[G::D]) = (x, y, w);
        p
    }
    fn check<G: Moving>() {
        let build = |rows: &[[f64; 3]]| {
            let points: Vec<G::Point> = rows.iter().map(|&row| point::<G>(row)).collect();
            MovingTriangulation::<G>::new(&points, Options::default()).expect("a build")
        };
        let two = build(&[[0.0, 0.0, 100.0], [0.1, 0.0, 0.01]]);
        assert_eq!(two.vertices_hidden_by_weight(), Ok(Vec::new()));
        let mut three = build(&[[0.0, 0.0, 100.0], [0.1, 0.0, 0.01], [0.2, 0.0, 0.01]]);
        for _ in 0..200 {
            assert_eq!(three.vertices_hidden_by_weight(), Ok(vec![vertex(1)]));
            three.relocate_part(PointPart::Weight, vertex(2), &[-1e3]).expect("room");
            assert_eq!(three.vertices_hidden_by_weight(), Ok(Vec::new()));
            three.relocate_part(PointPart::Weight, vertex(2), &[0.01]).expect("room");
        }
    }
    check::<PowerPlane>();
    check::<PowerSpace>();

    // A third vertex of the same power at the centre of the edge makes a cell of the same power sphere.
    for (unit, value) in [(100.0, 2_499e6), (1.0, 249_900.0)] {
        let rows = [[0.0, 0.0, 100.0], [0.1, 0.0, 0.01], [500.0, 500.0, 100.0]];
        let scaled = |[x, y, w]: [f64; 3]| point::<PowerPlane>([unit * x, unit * y, unit * unit * w]);
        let mut t =
            MovingTriangulation::<PowerPlane>::new(&rows.map(scaled), Options::default()).expect("a build");
        for step in 0..200 {
            t.set_algorithm(Algorithm::ALL[step % Algorithm::ALL.len()]);
            t.commit_positions(&rows.map(scaled)).expect("room");
            let (centre, square) = t.circumspheres().expect("room").next().expect("a cell");
            assert!((square - value).abs() < 1e-9 * value && (centre[0] - 500.0 * unit).abs() < 1e-9 * value);
            if unit > 1.0 {
                let is_within = |square: f64| t.mask_by_circumradius(square).expect("a bound").next();
                assert_eq!((is_within(value), is_within(value.next_down())), (Some(true), Some(false)));
            }
        }
    }
    // The tetrahedron whose power sphere has a negative square, in an alpha complex without values that are not
    // numbers.
    let t = build::<PowerSpace>(&of_alpha_complexes()[0]);
    let spheres: Vec<f64> = t.circumspheres().expect("room").map(|(_, square)| square).collect();
    assert!(spheres.iter().all(|square| square.is_finite()));
    let first = t.cells().expect("room").corners.iter().position(|cell| !cell.contains(&vertex(4)));
    assert_eq!(spheres[first.expect("a cell of the first four")], -1.0);
}
