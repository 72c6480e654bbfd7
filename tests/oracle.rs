//! Any history against a fresh build: after every commit and every few immediate calls the cells must be
//! those of a triangulation made at once of the present positions and ids (see `common/history.rs`).

use crate::common::history::{History, Snapshot, nudged};
use crate::common::inputs::{KINDS, Kind, draw, integer_sphere, on_sphere};
use crate::common::{Rng, assert_same_cells, cell_set, fresh_cells, ids, point, seeds, vertex, vertices};
use deldrift::Error;
use deldrift::motion::{Algorithm, CoincidencePolicy, Level, MovingTriangulation, Options};
use deldrift::{Dimension, Plane, Space, VertexId};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

fn histories_match<G: Dimension>(n_seeds: u64, n: impl Fn(&mut Rng) -> usize, steps: usize) {
    for kind in KINDS {
        for seed in seeds(n_seeds) {
            let n = n(&mut Rng::new(seed ^ 0x5151));
            let mut history = History::<G>::new(kind, n, seed);
            history.check();
            for _ in 0..steps {
                history.step();
            }
        }
    }
}

#[test]
fn small_histories_in_the_plane_match_fresh_builds() {
    histories_match::<Plane>(80, |rng| rng.below(61), 20);
}

#[test]
fn small_histories_in_space_match_fresh_builds() {
    histories_match::<Space>(80, |rng| rng.below(61), 20);
}

#[test]
fn long_histories_in_the_plane_match_fresh_builds() {
    histories_match::<Plane>(2, |rng| 450 + rng.below(100), 20);
}

#[test]
fn long_histories_in_space_match_fresh_builds() {
    histories_match::<Space>(2, |rng| 450 + rng.below(100), 15);
}

/// Starts from nothing and returns to it.
fn grows_and_vanishes<G: Dimension>() {
    for kind in KINDS {
        for seed in seeds(6) {
            let mut history = History::<G>::new(kind, 0, seed);
            let points = draw::<G>(kind, 25, &mut history.rng);
            for q in points {
                history.insert(q);
                history.check();
            }
            let mut order: Vec<VertexId> = VertexId::range(0..25).collect();
            history.rng.shuffle(&mut order);
            for v in order {
                history.remove(v);
                history.check();
            }
            assert_eq!(history.t.vertex_count(), 0);
        }
    }
}

#[test]
fn one_by_one_from_nothing_to_nothing_in_the_plane() {
    grows_and_vanishes::<Plane>();
}

#[test]
fn one_by_one_from_nothing_to_nothing_in_space() {
    grows_and_vanishes::<Space>();
}

/// Vertices that pass through one hyperplane, all or one after the other, and the collapse of all dimensions.
fn collapses_and_expands<G: Dimension>(side: i64) {
    for algorithm in Algorithm::ALL {
        let mut points = Vec::new();
        for i in 0..side.pow(G::D as u32) {
            points.push(point::<G>(|k| (i / side.pow(k as u32) % side) as f64));
        }
        let name = format!("lattice, {algorithm:?}");
        let mut history = History::<G>::of(points.clone(), Kind::Lattice, name, Rng::new(3));
        // Flattened onto a hyperplane, a line, a point, then mirrored and back.
        for flat in (0..G::D).chain([G::D]).chain((0..G::D).rev()) {
            for (v, p) in vertices().zip(&points) {
                history.stage(v, point::<G>(|k| if k < flat { 0.0 } else { p[k] }));
            }
            history.commit(algorithm);
            history.check();
        }
        for factor in [-1.0, 1.0, 0.5] {
            for (v, p) in vertices().zip(&points) {
                history.stage(v, point::<G>(|k| if k == 0 { factor * p[k] } else { p[k] }));
            }
            history.commit(algorithm);
            history.check();
        }
    }
}

#[test]
fn a_lattice_collapses_and_expands_in_the_plane() {
    collapses_and_expands::<Plane>(6);
}

#[test]
fn a_lattice_collapses_and_expands_in_space() {
    collapses_and_expands::<Space>(4);
}

/// Coordinates of all accepted magnitudes, far beyond what the filters can decide.
fn magnitudes_do_not_matter<G: Dimension>() {
    for seed in seeds(30) {
        let rng = &mut Rng::new(seed);
        let (low, high) = *rng.pick(&[(-320, 56), (-320, -250), (-42, -38), (50, 56), (-5, 5)]);
        let coordinate = |rng: &mut Rng| {
            let magnitude = (1.0 + 8.0 * rng.unit()) * 10f64.powi(rng.within(low, high) as i32);
            *rng.pick(&[0.0, 1.0, -1.0, 1.0]) * magnitude
        };
        let mut positions: Vec<Option<G::Point>> =
            (0..20).map(|_| Some(point::<G>(|_| coordinate(rng)))).collect();
        let points: Vec<G::Point> = positions.iter().copied().flatten().collect();
        let mut t = MovingTriangulation::<G>::new(&points, Options::default()).expect("a build");
        for algorithm in Algorithm::ALL {
            t.set_algorithm(algorithm);
            for v in VertexId::range(0..20) {
                if rng.one_in(3) {
                    let q = point::<G>(|_| coordinate(rng));
                    t.move_vertices(&[v], &[q]).expect("a move");
                    positions[v] = Some(q);
                }
            }
            t.commit_timestamp().expect("a commit");
            let context = || format!("seed {seed}, {algorithm:?}, 1e{low} to 1e{high}");
            if let Err(violation) = t.validate(Level::Delaunay) {
                panic!("{}: {violation}", context());
            }
            assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&positions), context);
        }
    }
}

#[test]
fn magnitudes_do_not_matter_in_the_plane() {
    magnitudes_do_not_matter::<Plane>();
}

#[test]
fn magnitudes_do_not_matter_in_space() {
    magnitudes_do_not_matter::<Space>();
}

fn rejecting<G: Dimension>(points: &[G::Point], algorithm: Algorithm) -> MovingTriangulation<G> {
    let options = Options { algorithm, coincidence: CoincidencePolicy::Reject, ..Options::default() };
    MovingTriangulation::new(points, options).expect("distinct points")
}

/// Lattice points, all distinct.
fn lattice<G: Dimension>(n: i64) -> Vec<G::Point> {
    (0..n).map(|i| point::<G>(|k| [i % 5, i / 5 % 5, i / 25][k] as f64)).collect()
}

fn coincidence_is_rejected<G: Dimension>() {
    let points = lattice::<G>(25);
    for algorithm in Algorithm::ALL {
        for seed in seeds(20) {
            let rng = &mut Rng::new(seed);
            let mut t = rejecting::<G>(&points, algorithm);
            // A permutation of some of the vertices, but for one that goes
            // to the place of one that stays or comes.
            let mut vertices: Vec<VertexId> = VertexId::range(0..25).collect();
            rng.shuffle(&mut vertices);
            vertices.truncate(2 + rng.below(20));
            let mut targets: Vec<G::Point> = vertices.iter().map(|&v| points[v]).collect();
            targets.rotate_left(1);
            let (staying, at) = (rng.below(25), rng.below(vertices.len()));
            let old = std::mem::replace(&mut targets[at], points[staying]);
            t.move_vertices(&vertices, &targets).expect("moves");
            let before = Snapshot::of(&t);
            let outcome = t.commit_timestamp();
            let mut then = points.clone();
            for (&v, &q) in vertices.iter().zip(&targets) {
                then[v] = q;
            }
            match outcome {
                Ok(_) => assert_eq!(old, points[staying], "{algorithm:?}, seed {seed}: not rejected"),
                Err(Error::Coincident { vertex, other }) => {
                    assert!(vertex < other && then[vertex] == then[other]);
                    assert_eq!(Snapshot::of(&t), before, "{algorithm:?}, seed {seed}");
                    // Whoever gives way: with the vertices nudged apart the rest can be committed.
                    assert_eq!(t.discard_moves(), vertices.len());
                    targets[at] = old;
                    t.move_vertices(&vertices, &targets).expect("moves");
                    t.commit_timestamp().expect("a permutation, though vertices meet underway");
                    for (&v, &q) in vertices.iter().zip(&targets) {
                        then[v] = q;
                    }
                    let expected = fresh_cells::<G>(&then.into_iter().map(Some).collect::<Vec<_>>());
                    assert_same_cells(&cell_set(&t), &expected, || format!("{algorithm:?}, seed {seed}"));
                }
                Err(error) => panic!("{algorithm:?}, seed {seed}: {error}"),
            }
        }
    }
}

#[test]
fn coincidence_is_rejected_in_the_plane() {
    coincidence_is_rejected::<Plane>();
}

#[test]
fn coincidence_is_rejected_in_space() {
    coincidence_is_rejected::<Space>();
}

/// The immediate calls and creation reject an occupied place too, with and without cells.
fn occupied_places_are_rejected<G: Dimension>() {
    for n in [2, 4, 25] {
        let points = lattice::<G>(n as i64);
        let mut t = rejecting::<G>(&points, Algorithm::Auto);
        let before = Snapshot::of(&t);
        let last = VertexId::at(n - 1);
        let onto_last = Err(Error::Coincident { vertex: vertex(0), other: last });
        assert_eq!(t.relocate_vertex(vertex(0), &points[last]), onto_last);
        assert_eq!(
            t.insert_vertex(&points[0]),
            Err(Error::Coincident { vertex: vertex(0), other: VertexId::at(n) })
        );
        assert_eq!(Snapshot::of(&t), before);
        t.relocate_vertex(vertex(0), &points[0]).expect("its own place is free for it");
        let twice: Vec<G::Point> = points.iter().chain(&points[..1]).copied().collect();
        let options = Options { coincidence: CoincidencePolicy::Reject, ..Options::default() };
        let error = MovingTriangulation::<G>::new(&twice, options).expect_err("a point twice");
        assert_eq!(error, Error::Coincident { vertex: vertex(0), other: VertexId::at(n) });
    }
}

#[test]
fn occupied_places_are_rejected_by_immediate_calls_and_creation() {
    occupied_places_are_rejected::<Plane>();
    occupied_places_are_rejected::<Space>();
}

/// Cancels at the `n`-th call from now on, 0 being the next one; not at all while `n` is `usize::MAX`.
#[derive(Clone, Default)]
struct Canceller(Arc<AtomicUsize>);

impl Canceller {
    fn after(&self, n: usize) {
        self.0.store(n, Ordering::Relaxed);
    }

    fn monitor(&self) -> deldrift::motion::Monitor {
        let left = self.0.clone();
        Box::new(move |fraction| {
            assert!((0.0..=1.0).contains(&fraction), "{fraction}");
            match left.load(Ordering::Relaxed) {
                usize::MAX => true,
                0 => false,
                n => {
                    left.store(n - 1, Ordering::Relaxed);
                    true
                }
            }
        })
    }

    /// Commits what is staged, cancelled at the first call of the monitor, at the second, and so on until that
    /// succeeds. Returns how often it was cancelled.
    fn at_every_call<G: Dimension>(
        &self,
        t: &mut MovingTriangulation<G>,
        targets: &[G::Point],
        name: &str,
    ) -> usize {
        let (before, n_staged) = (Snapshot::of(t), t.staged_count());
        let mut cancellations = 0;
        while {
            self.after(cancellations);
            let outcome = t.commit_timestamp();
            self.after(usize::MAX);
            assert!(matches!(outcome, Ok(_) | Err(Error::Cancelled)), "{outcome:?}");
            outcome.is_err()
        } {
            assert!(Snapshot::of(t) == before, "{name}, cancelled at {cancellations}");
            assert_eq!(t.staged_count(), n_staged, "{name}, cancelled at {cancellations}");
            cancellations += 1;
        }
        let expected = fresh_cells::<G>(&targets.iter().copied().map(Some).collect::<Vec<_>>());
        assert_same_cells(&cell_set(t), &expected, || format!("{name}, cancelled {cancellations} times"));
        let now: Vec<_> = (0..targets.len()).map(|v| t.position(VertexId::at(v)).expect("present")).collect();
        assert!(now == targets);
        cancellations
    }
}

/// A commit is cancelled wherever the monitor is asked; each time the timestamp before is restored,
/// coincident vertices included, and in the end the commit succeeds.
fn commits_are_cancelled_anywhere<G: Dimension>(n: usize) {
    for (kind, algorithm) in KINDS.into_iter().zip(Algorithm::ALL.into_iter().cycle()) {
        let rng = &mut Rng::new(9);
        let mut points = draw::<G>(kind, n, rng);
        for i in 0..n / 4 {
            // Pairs of coincident vertices, the lower id first or last in storage.
            points[n - 1 - i] = points[i];
        }
        let canceller = Canceller::default();
        canceller.after(usize::MAX);
        let options = Options { algorithm, monitor: Some(canceller.monitor()), ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&points, options).expect("a build");
        let mut targets = points.clone();
        for v in (0..n).filter(|v| algorithm != Algorithm::Auto || v % 7 == 0) {
            targets[v] = match v % 5 {
                0 => points[rng.below(n)],
                1 => points[v],
                _ => nudged::<G>(&points[v], 1 << 18, rng),
            };
            t.move_vertices(&[VertexId::at(v)], &[targets[v]]).expect("a move");
        }
        let cancellations = canceller.at_every_call(&mut t, &targets, &format!("{kind:?}, {algorithm:?}"));
        assert!(cancellations > 1, "{kind:?}, {algorithm:?}: {cancellations}");
    }
}

#[test]
fn commits_are_cancelled_anywhere_in_the_plane() {
    commits_are_cancelled_anywhere::<Plane>(3000);
}

#[test]
fn commits_are_cancelled_anywhere_in_space() {
    commits_are_cancelled_anywhere::<Space>(2200);
}

/// As above where all vertices are staged at once, most of them within their tolerance: those are moved first.
fn whole_commits_are_cancelled_anywhere<G: Dimension>(n: usize) {
    for algorithm in Algorithm::ALL {
        let rng = &mut Rng::new(11);
        let mut points = draw::<G>(Kind::Random, n, rng);
        let canceller = Canceller::default();
        canceller.after(usize::MAX);
        let options = Options { algorithm, monitor: Some(canceller.monitor()), ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&points, options).expect("a build");
        for p in &mut points {
            *p = nudged::<G>(p, 1 << 4, rng);
        }
        t.commit_positions(&points).expect("a commit");
        let mut targets = points.clone();
        for v in 0..n {
            targets[v] =
                if v % 20 == 0 { points[rng.below(n)] } else { nudged::<G>(&points[v], 1 << 4, rng) };
        }
        t.move_all(&targets).expect("places");
        let cancellations = canceller.at_every_call(&mut t, &targets, &format!("{algorithm:?}"));
        assert!(cancellations > 0, "{algorithm:?}: {cancellations}");
    }
}

#[test]
fn whole_commits_are_cancelled_anywhere_in_the_plane() {
    whole_commits_are_cancelled_anywhere::<Plane>(3000);
}

#[test]
fn whole_commits_are_cancelled_anywhere_in_space() {
    whole_commits_are_cancelled_anywhere::<Space>(2200);
}

/// All positions are given at once, the last one is bad, and many vertices leave what an algorithm keeps for them: the
/// call is refused, and nothing has moved.
fn bad_positions_among_many_leave_no_trace<G: Dimension>() {
    let n = 500;
    for algorithm in Algorithm::ALL {
        let rng = &mut Rng::new(12);
        let mut points = draw::<G>(Kind::Random, n, rng);
        let options = Options { algorithm, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&points, options).expect("a build");
        for round in 0..6 {
            for p in &mut points {
                *p = nudged::<G>(p, 1 << 4, rng);
            }
            t.commit_positions(&points).expect("a commit");
            let before = Snapshot::of(&t);
            let mut bad = points.clone();
            for p in bad.iter_mut().step_by(1 << round) {
                *p = nudged::<G>(p, 1 << 22, rng);
            }
            let (at, value) = ([n - 1, n / 2][round % 2], [f64::NAN, 1e300, f64::INFINITY][round % 3]);
            bad[at][G::D - 1] = value;
            let error = t.commit_positions(&bad).expect_err("a bad number");
            let names_it = match error {
                Error::NotFinite { index, .. } | Error::OutOfRange { index, .. } => index == at,
                _ => false,
            };
            assert!(names_it, "{algorithm:?}: {error}");
            assert!(Snapshot::of(&t) == before, "{algorithm:?}, round {round}");
            t.validate(Level::Delaunay).expect("valid");
        }
    }
}

#[test]
fn bad_positions_among_many_leave_no_trace_anywhere() {
    bad_positions_among_many_leave_no_trace::<Plane>();
    bad_positions_among_many_leave_no_trace::<Space>();
}

#[test]
fn creation_is_cancelled_anywhere() {
    let points = draw::<Space>(Kind::Random, 3000, &mut Rng::new(1));
    let canceller = Canceller::default();
    for at in 0.. {
        canceller.after(at);
        let options = Options { monitor: Some(canceller.monitor()), ..Options::default() };
        match MovingTriangulation::<Space>::new(&points, options) {
            Err(error) => assert_eq!(error, Error::Cancelled),
            Ok(t) => {
                assert!(at > 2, "the monitor is asked {at} times");
                return t.validate(Level::Delaunay).expect("valid");
            }
        }
    }
}

/// Every refused call names what is wrong and leaves no trace, not even of the good moves before the bad one.
fn bad_arguments_leave_no_trace<G: Dimension>() {
    let points = lattice::<G>(25);
    let mut t = MovingTriangulation::<G>::new(&points, Options::default()).expect("a build");
    t.remove_vertex(vertex(7)).expect("present");
    t.move_vertices(&[vertex(3)], &[points[4]]).expect("a move");
    let before = Snapshot::of(&t);
    let last = G::D - 1;
    let with = |x: f64| point::<G>(|k| if k == last { x } else { 1.0 });
    let is_refused = |t: &mut MovingTriangulation<G>,
                      q: &G::Point,
                      as_expected: &dyn Fn(&Error, usize) -> bool| {
        let staged =
            t.move_vertices(&ids([0, 1, 2]), &[points[1], *q, points[3]]).expect_err("a bad position");
        assert!(as_expected(&staged, 1), "{staged}");
        let mut all = points.clone();
        all[24] = *q;
        t.discard_moves();
        let staged = t.move_all(&all).expect_err("a bad position");
        assert!(as_expected(&staged, 24), "{staged}");
        assert_eq!(t.staged_count(), 0);
        t.move_vertices(&[vertex(3)], &[points[4]]).expect("a move");
        for error in [
            t.relocate_vertex(vertex(2), q).expect_err("a bad position"),
            t.insert_vertex(q).expect_err("a bad position"),
            t.locate(q).expect_err("a bad position"),
            t.nearest_vertex(q).expect_err("a bad position"),
        ] {
            assert!(as_expected(&error, 0), "{error}");
        }
        let created = MovingTriangulation::<G>::new(&all, Options::default()).expect_err("a bad position");
        assert!(as_expected(&created, 24), "{created}");
    };
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        is_refused(&mut t, &with(x), &|error, i| {
            matches!(error, Error::NotFinite { index, axis, value, .. }
                if *index == i && *axis == last && value.to_bits() == x.to_bits())
        });
    }
    for x in [1e300, -1e300, 1e58, -1.001e57, f64::MAX] {
        is_refused(&mut t, &with(x), &|error, i| {
            matches!(error, Error::OutOfRange { index, axis, value, .. }
                if *index == i && *axis == last && *value == x)
        });
    }
    assert_eq!(Snapshot::of(&t), before);

    let removed = vertex(7);
    for (bad, name) in
        [(vertex(25), "no such vertex"), (VertexId::NONE, "no such vertex"), (removed, "a removed vertex")]
    {
        let as_expected = |error: Error, i: usize| {
            let matches = match error {
                Error::NoSuchVertex { index, vertex, ids, .. } => {
                    bad != removed && vertex == bad && index == i && ids == 25
                }
                Error::RemovedVertex { index, vertex, .. } => [bad, vertex] == [removed; 2] && index == i,
                _ => false,
            };
            assert!(matches, "{name}: {error}");
        };
        as_expected(t.move_vertices(&[vertex(0), bad], &[points[1], points[2]]).expect_err(name), 1);
        as_expected(t.relocate_vertex(bad, &points[1]).expect_err(name), 0);
        as_expected(t.remove_vertex(bad).expect_err(name), 0);
        as_expected(t.position(bad).expect_err(name), 0);
        as_expected(t.star(bad, &mut Vec::new()).expect_err(name), 0);
        as_expected(t.coincident_representative(bad).expect_err(name), 0);
    }
    let is_duplicate = |error: Error, i: usize, v: VertexId| {
        assert!(
            matches!(error, Error::DuplicateMove { index, vertex, .. } if index == i && vertex == v),
            "{error}"
        );
    };
    is_duplicate(t.move_vertices(&ids([0, 3]), &points[..2]).expect_err("staged before"), 1, vertex(3));
    is_duplicate(
        t.move_vertices(&ids([0, 1, 0]), &points[..3]).expect_err("twice in one call"),
        2,
        vertex(0),
    );
    is_duplicate(t.move_all(&points).expect_err("staged before"), 3, vertex(3));
    is_duplicate(t.relocate_vertex(vertex(3), &points[1]).expect_err("staged before"), 0, vertex(3));
    let is_wrong_count = |error: Error| assert!(matches!(error, Error::WrongCount { .. }), "{error}");
    is_wrong_count(t.move_vertices(&ids([0, 1]), &points[..1]).expect_err("too few positions"));
    is_wrong_count(t.move_all(&points[..24]).expect_err("too few positions"));
    assert_eq!(Snapshot::of(&t), before);

    // The one good move is still there.
    t.commit_timestamp().expect("a commit");
    let mut then: Vec<Option<G::Point>> = points.iter().copied().map(Some).collect();
    (then[7], then[3]) = (None, Some(points[4]));
    assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&then), || "after bad arguments".to_string());
}

#[test]
fn bad_arguments_leave_no_trace_in_the_plane() {
    bad_arguments_leave_no_trace::<Plane>();
}

#[test]
fn bad_arguments_leave_no_trace_in_space() {
    bad_arguments_leave_no_trace::<Space>();
}

/// Minus zero is zero: it neither hides a coincidence nor shows in positions.
#[test]
fn minus_zero_is_zero() {
    let mut t = MovingTriangulation::<Plane>::new(&[[0.0, -0.0], [1.0, 0.0], [0.0, 1.0]], Options::default())
        .unwrap();
    let v = t.insert_vertex(&[-0.0, 0.0]).unwrap();
    assert_eq!(t.coincident_representative(v), Ok(vertex(0)));
    assert!(t.position(vertex(0)).unwrap()[1].is_sign_positive());
}

/// Inserts, relocates and removes each of the hubs, with a check after each call.
fn hubs_come_and_go<G: Dimension>(name: &str, rim: Vec<G::Point>, hubs: &[G::Point]) {
    let mut history = History::<G>::of(rim, Kind::Random, name.to_string(), Rng::new(4));
    let far = point::<G>(|k| 20000.0 + k as f64);
    let first = history.positions.len();
    let new = || VertexId::range(first..first + hubs.len());
    for (v, &hub) in new().zip(hubs) {
        history.insert(hub);
        history.check_cells();
        let mut star = Vec::new();
        history.t.star(v, &mut star).expect("present");
        assert!(star.len() > 64, "{name}: {hub:?} has only {} cells", star.len());
    }
    for (v, &hub) in new().zip(hubs) {
        // In place, far away, back, out.
        let near = nudged::<G>(&hub, 100, &mut history.rng);
        for q in [near, far, hub] {
            history.relocate(v, q);
            history.check_cells();
        }
        for algorithm in Algorithm::ALL {
            for q in [far, hub] {
                history.stage(v, q);
                history.commit(algorithm);
                history.check_cells();
            }
        }
    }
    history.check();
    for v in new() {
        history.remove(v);
        history.check_cells();
    }
}

/// Points on the circle in the horizontal plane, as a cone or a bipyramid stands on.
fn ring(n: usize, rng: &mut Rng) -> Vec<[f64; 3]> {
    (0..n).map(|_| on_sphere::<Plane>(100.0, rng)).map(|[x, y]| [x, y, 0.0]).collect()
}

fn floor(side: i64) -> Vec<[f64; 3]> {
    (0..side * side).map(|i| [(i % side) as f64, (i / side) as f64, 0.0]).collect()
}

#[test]
fn the_centre_of_a_circle_is_a_hub() {
    for n in [70, 400] {
        let rng = &mut Rng::new(n);
        let rim = (0..n).map(|_| on_sphere::<Plane>(100.0, rng)).collect();
        hubs_come_and_go::<Plane>("circle", rim, &[[0.0, 0.0]]);
    }
}

#[test]
fn the_centre_of_a_sphere_is_a_hub() {
    for n in [66, 300, 2000] {
        let rng = &mut Rng::new(n);
        let rim = (0..n).map(|_| on_sphere::<Space>(100.0, rng)).collect();
        hubs_come_and_go::<Space>("sphere", rim, &[[0.0; 3]]);
    }
    hubs_come_and_go::<Space>("integer sphere", integer_sphere::<Space>(), &[[0.0; 3]]);
}

#[test]
fn a_hub_on_the_hull_leaves_a_flat_set_behind() {
    hubs_come_and_go::<Space>("cone", ring(150, &mut Rng::new(1)), &[[0.0, 0.0, 500.0]]);
    hubs_come_and_go::<Space>("tower on a floor", floor(11), &[[5.5, 5.25, 5000.0]]);
}

#[test]
fn hubs_on_both_sides_of_a_flat_link() {
    let rng = &mut Rng::new(1);
    hubs_come_and_go::<Space>("bipyramid", ring(150, rng), &[[0.0, 0.0, 500.0], [0.0, 0.0, -400.0]]);
    hubs_come_and_go::<Space>("towers", floor(11), &[[5.5, 5.25, 5000.0], [4.0, 5.0, -3000.0]]);
}

/// Two half discs at a right angle, the hub in the middle of the edge where they meet.
#[test]
fn a_hub_on_the_edge_of_two_flat_sides() {
    let mut rim = Vec::new();
    for [x, y, _] in ring(160, &mut Rng::new(8)) {
        rim.push(if rim.len() % 2 == 0 { [x, y.abs(), 0.0] } else { [x, 0.0, y.abs()] });
    }
    rim.extend([[-100.0, 0.0, 0.0], [100.0, 0.0, 0.0]]);
    hubs_come_and_go::<Space>("wedge", rim, &[[0.0; 3]]);
}

/// Conflict zones and stars of every size around those where small tables give way to general ones.
#[test]
fn rims_of_every_size_around_that_of_the_tables() {
    for (n, seed) in (60..=70).flat_map(|n| seeds(12).map(move |seed| (n, seed))) {
        let rng = &mut Rng::new(seed);
        let rim: Vec<[f64; 3]> = (0..n).map(|_| on_sphere::<Space>(100.0, rng)).collect();
        let name = format!("sphere of {n}, seed {seed}");
        let mut history = History::<Space>::of(rim, Kind::Random, name, Rng::new(seed));
        let hub = history.insert([0.0; 3]);
        history.check_cells();
        for q in [[300.0, 10.0, 5.0], [1.0, 0.0, 0.0]] {
            history.relocate(hub, q);
            history.check_cells();
        }
        history.remove(hub);
        history.check_cells();
    }
}

/// Points on two skew lines: every pair of consecutive points of one makes a cell with every pair of the
/// other, so few neighbours mean many cells.
#[test]
fn skew_lines_have_quadratically_many_cells() {
    let points: Vec<[f64; 3]> =
        (0..28).flat_map(|i| [[f64::from(i), 0.0, 0.0], [0.5, f64::from(i), 40.0]]).collect();
    let mut history = History::<Space>::of(points, Kind::Random, "skew lines".to_string(), Rng::new(2));
    assert_eq!(history.t.cell_count(), 27 * 27);
    for hub in [[13.0, 14.0, 20.0], [0.0, 0.0, 20.0], [-30.0, -30.0, 20.0]] {
        let v = history.insert(hub);
        history.check();
        history.relocate(v, [13.25, 14.5, 21.0]);
        history.check();
        history.remove(v);
        history.check();
    }
    for v in VertexId::range(0..56) {
        history.remove(v);
        history.check_cells();
    }
}
