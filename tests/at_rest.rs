//! What is known of the moves before an algorithm is chosen decides before anything that past commits have found: where
//! nothing moves nothing is done, where all vertices go by one exact vector the cells stay, and few are placed. The
//! oracle is a fresh build.

use crate::common::{Rng, assert_same_cells, cell_set, fresh_cells, point};
use deldrift::motion::{Algorithm, CommitReport, MovingTriangulation, Options};
use deldrift::{Dimension, Plane, Space, VertexId};

fn commit<G: Dimension>(t: &mut MovingTriangulation<G>, positions: &[G::Point]) -> CommitReport {
    t.commit_positions(positions).expect("room")
}

fn check<G: Dimension>(t: &MovingTriangulation<G>, positions: &[G::Point], context: &str) {
    let positions: Vec<_> = positions.iter().copied().map(Some).collect();
    assert_same_cells(&cell_set(t), &fresh_cells::<G>(&positions), || context.into());
}

/// A grid of this number of points along each axis, turned by 0.37 about (0.36, 0.48, 0.8).
fn turned_grid(n: usize) -> Vec<[f64; 3]> {
    let (axis, (sin, cos)) = ([0.36, 0.48, 0.8], 0.37_f64.sin_cos());
    let turn = |p: [f64; 3]| {
        let along: f64 = (0..3).map(|k| axis[k] * p[k]).sum();
        std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let across = axis[i] * p[j] - axis[j] * p[i];
            p[k] * cos + across * sin + axis[k] * along * (1.0 - cos)
        })
    };
    (0..n * n * n).map(|k| turn([k % n, k / n % n, k / n / n].map(|x| x as f64))).collect()
}

/// A turned grid is moved along, and sheared, which is rebuilt; then it rests.
#[test]
fn grids_that_were_rebuilt_rest() {
    let mut positions = turned_grid(34);
    let mut t = MovingTriangulation::<Space>::new(&positions, Options::default()).expect("room");
    let mut n_rebuilt = 0;
    for step in 0..12 {
        positions.iter_mut().for_each(|p| p[0] += if step < 6 { 0.001 } else { 0.001 * p[1] });
        n_rebuilt += commit(&mut t, &positions).rebuilds;
    }
    assert!(n_rebuilt > 0, "there is a regime of rebuilding");
    for _ in 0..3 {
        let report = commit(&mut t, &positions);
        assert_eq!((report.moved, report.rebuilds), (0, 0));
    }
    check(&t, &positions, "at rest");
}

/// A triangulation the vertices of which have gone anywhere in `n_leaps` commits, so that the last ones were rebuilt
/// without being looked at. Coordinates are multiples of 1/1024 up to 1, those of the last vertices on request those of
/// the first ones.
fn after_leaps<G: Dimension>(n_leaps: usize, n_shared: usize) -> (MovingTriangulation<G>, Vec<G::Point>) {
    let rng = &mut Rng::new(n_leaps as u64);
    let n = 1_500;
    let mut draw = || -> Vec<G::Point> {
        let mut points: Vec<_> = (0..n - n_shared)
            .map(|_| point::<G>(|_| rng.below(1 << 20) as f64 / f64::from(1 << 20)))
            .collect();
        points.extend_from_within(..n_shared);
        points
    };
    let mut t = MovingTriangulation::<G>::new(&draw(), Options::default()).expect("room");
    let mut positions = Vec::new();
    for _ in 0..n_leaps {
        positions = draw();
        commit(&mut t, &positions);
    }
    (t, positions)
}

fn what_is_known_decides<G: Dimension>(n_shared: usize) {
    // Whatever the counters of past commits are: some stop at once, some at the next commit.
    for n_leaps in 2..12 {
        let context = format!("{}D, {n_shared} shared, after {n_leaps} leaps", G::D);
        let (mut t, mut positions) = after_leaps::<G>(n_leaps, n_shared);
        let expect = |t: &mut MovingTriangulation<G>, positions: &[G::Point], moved, what: &str| {
            let report = commit(t, positions);
            assert_eq!((report.moved, report.rebuilds), (moved, 0), "{what}, {context}");
            check(t, positions, &context);
        };
        expect(&mut t, &positions, 0, "none");
        for v in [3, 700, 1_400 - n_shared] {
            positions[v][1] += 0.25;
        }
        expect(&mut t, &positions, 3, "few");
        positions.iter_mut().for_each(|p| p[0] += 0.125);
        expect(&mut t, &positions, positions.len() as u64, "all together");
        // The sum is rounded, so this is another matter; but back it is none.
        let before = positions.clone();
        positions.iter_mut().for_each(|p| p[0] += 1e-3);
        commit(&mut t, &positions);
        check(&t, &positions, &context);
        commit(&mut t, &before);
        check(&t, &before, &context);
        // With an id that is nobody's.
        t.remove_vertex(VertexId::new(900)).expect("a vertex");
        let mut left: Vec<_> = before.iter().map(|p| point::<G>(|k| p[k] - 0.5)).map(Some).collect();
        left[900] = None;
        let report = commit(&mut t, &left.iter().map(|p| p.unwrap_or_default()).collect::<Vec<_>>());
        assert_eq!((report.moved, report.rebuilds), (left.len() as u64 - 1, 0), "{context}");
        assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&left), || context.clone());
    }
}

#[test]
fn what_is_known_decides_in_the_plane() {
    what_is_known_decides::<Plane>(0);
    what_is_known_decides::<Plane>(5);
}

#[test]
fn what_is_known_decides_in_space() {
    what_is_known_decides::<Space>(0);
    what_is_known_decides::<Space>(5);
}

/// Few insertions and removals are made by themselves where nothing moves, with the places given or without.
#[test]
fn edits_of_vertices_at_rest_are_no_reason_to_rebuild() {
    for (n_leaps, are_given) in (2..10).flat_map(|n| [(n, false), (n, true)]) {
        let (mut t, mut positions) = after_leaps::<Plane>(n_leaps, 0);
        t.stage_removals(&[VertexId::new(8)]).expect("a vertex");
        let new = [0.5, 0.25];
        t.stage_insertions(&[new]).expect("a place");
        positions.push(new);
        let report = if are_given { commit(&mut t, &positions) } else { t.commit_timestamp().expect("room") };
        let done = (report.moved, report.rebuilds, report.inserted, report.removed);
        assert_eq!(done, (0, 0, 1, 1), "after {n_leaps} leaps");
        let mut left: Vec<_> = positions.into_iter().map(Some).collect();
        left[8] = None;
        assert_same_cells(&cell_set(&t), &fresh_cells::<Plane>(&left), || format!("after {n_leaps} leaps"));
    }
}

/// Vertices on a line rest as well, by all algorithms but the one that always rebuilds.
#[test]
fn lines_rest() {
    let line: Vec<_> = (0..50).map(|k| [f64::from(k), 2.0 * f64::from(k)]).collect();
    for algorithm in Algorithm::ALL {
        let options = Options { algorithm, ..Options::default() };
        let mut t = MovingTriangulation::<Plane>::new(&line, options).expect("room");
        for _ in 0..3 {
            let report = commit(&mut t, &line);
            let is_rebuilt = algorithm == Algorithm::Rebuilding;
            assert_eq!((report.moved, report.rebuilds), (0, u64::from(is_rebuilt)), "{algorithm:?}");
        }
    }
}
