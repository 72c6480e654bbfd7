//! Several threads: the cells are those of one thread, whatever the input and the algorithm.
//!
//! All threads are used that are asked for, from a few hundred vertices each on, so small inputs are divided as well.
//! `DELDRIFT_SOAK` multiplies the number of seeds.

use crate::common::inputs::{KINDS, Kind, draw};
use crate::common::{Rng, assert_same_cells, cell_set, check_adjacency, point, seeds};
use deldrift::Error;
use deldrift::internals::use_all_threads;
use deldrift::motion::{Algorithm, Level, MovingTriangulation, Options};
use deldrift::{Dimension, Plane, Space, VertexId};
use std::sync::{Arc, Mutex};
use std::thread;

const THREADS: [u32; 5] = [1, 2, 3, 4, 7];

fn options(algorithm: Algorithm, threads: u32) -> Options {
    use_all_threads();
    Options { algorithm, threads, ..Options::default() }
}

/// Triangulations of the same points on one and on several threads.
fn on_threads<G: Dimension>(
    points: &[G::Point],
    algorithm: Algorithm,
    threads: &[u32],
) -> Vec<MovingTriangulation<G>> {
    let new = |&threads: &u32| {
        MovingTriangulation::<G>::new(points, options(algorithm, threads)).expect("points in range")
    };
    threads.iter().map(new).collect()
}

/// All are valid and have the cells and the hidden vertices of the first.
fn assert_all_same<G: Dimension>(all: &[MovingTriangulation<G>], context: &dyn Fn() -> String) {
    let expected = cell_set(&all[0]);
    for (k, t) in all.iter().enumerate() {
        if let Err(violation) = t.validate(Level::Delaunay) {
            panic!("{}, {k}: {violation}", context());
        }
        assert_same_cells(&cell_set(t), &expected, || format!("{}, {k}", context()));
        for v in VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)) {
            assert_eq!(
                t.coincident_representative(v),
                all[0].coincident_representative(v),
                "{}, {k}",
                context()
            );
        }
    }
}

/// Flat inputs, and inputs that a hyperplane does not divide evenly.
fn degenerate<G: Dimension>(n: usize, rng: &mut Rng) -> Vec<(&'static str, Vec<G::Point>)> {
    let mut cloud = |f: &dyn Fn(usize, f64) -> f64| -> Vec<G::Point> {
        (0..n).map(|_| point::<G>(|k| f(k, rng.unit()))).collect()
    };
    let grid = |k: usize, x: f64| if k == 0 { 0.0 } else { (x * 40.0).floor() };
    vec![
        ("one place", cloud(&|_, _| 1.0)),
        ("on a line", cloud(&|k, x| if k == 0 { x } else { 2.0 })),
        ("in a hyperplane", cloud(&|k, x| if k == 0 { 0.0 } else { x })),
        ("a grid in a hyperplane", cloud(&grid)),
        ("on two hyperplanes", cloud(&|k, x| if k == 0 { 9.0 * (9.0 * x).floor().min(1.0) } else { x })),
        ("thin", cloud(&|k, x| if k == 0 { 1e-9 * x } else { x })),
        ("uneven", cloud(&|k, x| if k == 0 { 1.0 / (x * x * x + 1e-4) } else { x })),
        ("a fine grid", cloud(&|_, x| (x * 12.0).floor())),
    ]
}

fn builds<G: Dimension>() {
    for seed in seeds(2) {
        let mut rng = Rng::new(seed);
        for kind in KINDS {
            for n in [300, 800, 2000] {
                let points = draw::<G>(kind, n, &mut rng);
                let all = on_threads::<G>(&points, Algorithm::Auto, &THREADS);
                let context = || format!("{}D, seed {seed}, {kind:?}, {n}", G::D);
                assert_all_same(&all, &context);
                all.iter().for_each(|t| check_adjacency(t, &context));
            }
        }
        for (name, points) in degenerate::<G>(1200, &mut rng) {
            let all = on_threads::<G>(&points, Algorithm::Auto, &THREADS);
            assert_all_same(&all, &|| format!("{}D, seed {seed}, {name}", G::D));
        }
    }
}

#[test]
fn builds_in_the_plane() {
    builds::<Plane>();
}

#[test]
fn builds_in_space() {
    builds::<Space>();
}

/// So large that the library itself divides them.
#[test]
fn large_builds() {
    let mut rng = Rng::new(1);
    let points = draw::<Plane>(Kind::Random, 60_000, &mut rng);
    assert_all_same(&on_threads::<Plane>(&points, Algorithm::Auto, &[1, 0, 5]), &|| "plane".into());
    let points = draw::<Space>(Kind::Lattice, 20_000, &mut rng);
    assert_all_same(&on_threads::<Space>(&points, Algorithm::Auto, &[1, 0, 5]), &|| "space".into());
}

/// How positions change from one commit to the next.
fn motion<G: Dimension>(step: usize, now: &mut [G::Point], rng: &mut Rng) {
    for v in 0..now.len() {
        match step % 6 {
            0 | 3 => (0..G::D).for_each(|k| now[v][k] += 0.02 * (rng.unit() - 0.5)),
            1 => now[v][0] = -now[v][0],
            2 if rng.one_in(20) => now[v] = now[rng.below(now.len())],
            4 if rng.one_in(50) => now[v] = point::<G>(|_| 3000.0 * (rng.unit() - 0.5)),
            5 => now[v][1] *= 1.0 + now[v][0].abs() / 1000.0,
            _ => {}
        }
    }
}

/// Rebuilding and repair, with insertions and removals in between.
fn histories<G: Dimension>(algorithm: Algorithm) {
    for seed in seeds(2) {
        let mut rng = Rng::new(seed + 50);
        let kind = if seed % 2 == 0 { Kind::Random } else { Kind::Lattice };
        let mut now = draw::<G>(kind, 1500, &mut rng);
        let mut all = on_threads::<G>(&now, algorithm, &[1, 2, 3, 6]);
        for step in 0..8 {
            motion::<G>(step, &mut now, &mut rng);
            let extra = point::<G>(|_| 100.0 * rng.unit());
            for t in &mut all {
                t.move_first(&now).expect("positions in range");
                t.commit_timestamp().expect("a commit");
                t.insert_vertex(&extra).expect("a position in range");
                t.remove_vertex(VertexId::new(now.len() as u32 + step as u32))
                    .expect("the vertex just inserted");
            }
            assert_all_same(&all, &|| format!("{}D, {algorithm:?}, seed {seed}, step {step}", G::D));
        }
    }
}

/// From one to seven threads, by every algorithm: points that are about 1 apart, or a lattice, tremble, meet and are
/// reflected.
fn on_one_to_seven<G: Dimension>(side: usize) {
    let threads: Vec<u32> = (1..=7).collect();
    for (i, algorithm) in Algorithm::ALL.into_iter().enumerate() {
        for is_lattice in [false, true] {
            let mut rng = Rng::new(i as u64);
            let place = |v: usize, k: usize, rng: &mut Rng| {
                if is_lattice { (v / side.pow(k as u32) % side) as f64 } else { side as f64 * rng.unit() }
            };
            let mut now: Vec<G::Point> =
                (0..side.pow(G::D as u32)).map(|v| point::<G>(|k| place(v, k, &mut rng))).collect();
            let mut all = on_threads::<G>(&now, algorithm, &threads);
            for (step, size) in [0.02, 0.05, 0.0, 0.02, 1e-4].into_iter().enumerate() {
                for v in 0..now.len() {
                    (0..G::D).for_each(|k| now[v][k] += size * (rng.unit() - 0.5));
                    if step == 2 {
                        now[v] = if rng.one_in(10) { now[rng.below(v + 1)] } else { now[v] };
                        now[v][0] = -now[v][0];
                    }
                }
                for t in &mut all {
                    t.commit_positions(&now).expect("positions in range");
                }
                let context = || format!("{}D, {algorithm:?}, lattice: {is_lattice}, step {step}", G::D);
                assert_all_same(&all, &context);
            }
        }
    }
}

#[test]
fn every_algorithm_on_one_to_seven_threads() {
    on_one_to_seven::<Plane>(24);
    on_one_to_seven::<Space>(8);
}

#[test]
fn rebuilding_in_the_plane() {
    histories::<Plane>(Algorithm::Rebuilding);
}

#[test]
fn rebuilding_in_space() {
    histories::<Space>(Algorithm::Rebuilding);
}

#[test]
fn repair_in_the_plane() {
    histories::<Plane>(Algorithm::Repair);
}

#[test]
fn repair_in_space() {
    histories::<Space>(Algorithm::Repair);
}

/// Some vertices go to other ones or near them; others tremble.
fn leaps<G: Dimension>(n: usize) {
    for seed in seeds(2) {
        for kind in [Kind::Random, Kind::Lattice] {
            let mut rng = Rng::new(seed + 70);
            let mut now = draw::<G>(kind, n, &mut rng);
            // The first commit sorts the cells, or finds them unsorted.
            let first = [Algorithm::Repair, Algorithm::PlacementFlips][seed as usize % 2];
            let mut all = on_threads::<G>(&now, first, &[1, 2, 3, 4]);
            for step in 0..8 {
                let is_first = step == 0 && first == Algorithm::Repair;
                for v in 0..now.len() {
                    let other = now[rng.below(now.len())];
                    let size = [0.0, 0.0, 0.5][rng.below(3)];
                    if !is_first && rng.one_in(7) {
                        now[v] = point::<G>(|k| other[k] + size * (rng.unit() - 0.5));
                    } else if is_first || rng.one_in(20) {
                        now[v] = point::<G>(|k| now[v][k] + 1e-3 * (rng.unit() - 0.5));
                    }
                }
                for t in &mut all {
                    t.move_first(&now).expect("positions in range");
                    t.commit_timestamp().expect("a commit");
                    t.set_algorithm([Algorithm::PlacementFlips, Algorithm::Placement][step % 2]);
                }
                assert_all_same(&all, &|| format!("{}D, {kind:?}, seed {seed}, step {step}", G::D));
            }
        }
    }
}

#[test]
fn leaps_in_the_plane() {
    leaps::<Plane>(2500);
}

#[test]
fn leaps_in_space() {
    leaps::<Space>(1200);
}

/// Layers that tremble in their planes: four vertices of many bi-cells are in one plane, in the hull as well, and flips
/// concern four cells.
#[test]
fn layers_in_space() {
    for seed in seeds(2) {
        let mut rng = Rng::new(seed + 90);
        let mut now: Vec<[f64; 3]> =
            (0..1728).map(|v| [v % 12, v / 12 % 12, v / 144].map(f64::from)).collect();
        let is_inner = |x: f64| x > 0.0 && x < 11.0;
        let mut tremble = |now: &mut [[f64; 3]], size: f64| {
            for x in now.iter_mut().flat_map(|p| &mut p[..2]).filter(|x| is_inner(**x)) {
                *x += size * (rng.unit() - 0.5);
            }
        };
        tremble(&mut now, 0.5);
        let mut all = on_threads::<Space>(&now, Algorithm::Repair, &THREADS);
        for step in 0..6 {
            tremble(&mut now, 0.05);
            for t in &mut all {
                t.move_all(&now).expect("positions in range");
                let report = t.commit_timestamp().expect("a commit");
                assert!(report.rebuilds == 0 && report.flips > 300, "{report:?}");
            }
            assert_all_same(&all, &|| format!("seed {seed}, step {step}"));
        }
    }
}

/// What all threads evaluate counts. Ties are most of a lattice's exact signs, so that their number hardly
/// depends on the order of insertion. The coordinates are rounded, as those of few bits need no exact arithmetic.
#[test]
fn exact_calls_of_all_threads_count() {
    let mut points = draw::<Space>(Kind::Lattice, 3000, &mut Rng::new(3));
    points.iter_mut().for_each(|p| *p = p.map(|x| 0.1 * x));
    let counts: Vec<u64> = on_threads::<Space>(&points, Algorithm::Rebuilding, &THREADS)
        .iter_mut()
        .map(|t| {
            t.move_all(&points).expect("positions in range");
            t.commit_timestamp().expect("a commit").exact_calls
        })
        .collect();
    assert!(counts[0] > 1000, "{counts:?}");
    for &count in &counts[1..] {
        assert!(2 * count > counts[0] && count < 2 * counts[0], "{counts:?}");
    }
}

/// A monitor that cancels at its `last`-th call; it enters the fractions that it is told.
fn cancelling(last: usize, seen: &Arc<Mutex<Vec<f64>>>) -> deldrift::motion::Monitor {
    let (caller, seen) = (thread::current().id(), Arc::clone(seen));
    Box::new(move |fraction| {
        assert_eq!(thread::current().id(), caller);
        let mut seen = seen.lock().expect("no panic while it is locked");
        seen.push(fraction);
        seen.len() < last
    })
}

#[test]
fn monitor_is_called_by_the_caller_and_cancels() {
    let points = draw::<Space>(Kind::Random, 12_000, &mut Rng::new(4));
    let seen = Arc::new(Mutex::new(Vec::new()));
    let create = |last: usize| {
        seen.lock().expect("no panic while it is locked").clear();
        let options = Options { monitor: Some(cancelling(last, &seen)), ..options(Algorithm::Rebuilding, 3) };
        MovingTriangulation::<Space>::new(&points, options)
    };
    create(usize::MAX).expect("never cancelled");
    let fractions = seen.lock().expect("no panic while it is locked").clone();
    assert!(fractions.is_sorted() && fractions.iter().all(|x| (0.0..=1.0).contains(x)), "{fractions:?}");
    assert!(fractions.last() > Some(&0.8), "{fractions:?}");
    for last in 1..=fractions.len() {
        assert_eq!(create(last).err(), Some(Error::Cancelled), "call {last} of {}", fractions.len());
    }
}

#[test]
fn cancelled_commits_have_no_effect() {
    let points = draw::<Plane>(Kind::Random, 6000, &mut Rng::new(5));
    let moved: Vec<[f64; 2]> = points.iter().map(|p| [0.5 * p[1], -p[0]]).collect();
    let seen = Arc::new(Mutex::new(Vec::new()));
    let n_seen = || seen.lock().expect("no panic while it is locked").len();
    let create = |last: usize| {
        seen.lock().expect("no panic while it is locked").clear();
        let monitor = Some(cancelling(last, &seen));
        let options = Options { monitor, ..options(Algorithm::Rebuilding, 2) };
        let mut t = MovingTriangulation::<Plane>::new(&points, options).expect("not cancelled yet");
        t.move_all(&moved).expect("positions in range");
        t
    };
    let mut t = create(usize::MAX);
    let before = cell_set(&t);
    let first = n_seen() + 1;
    t.commit_timestamp().expect("never cancelled");
    for last in first..=n_seen() {
        let mut t = create(last);
        assert_eq!(t.commit_timestamp(), Err(Error::Cancelled), "call {last}");
        t.validate(Level::Delaunay).expect("the triangulation before");
        assert_same_cells(&cell_set(&t), &before, || format!("cancelled at call {last}"));
        for (v, p) in points.iter().enumerate() {
            assert_eq!(t.position(VertexId::at(v)), Ok(*p));
        }
    }
}

/// Steps so short that hardly a facet is stuck: another round, on one thread, would find the facets that a thread has
/// left to the others, if these were forgotten.
#[test]
fn facets_left_to_other_threads() {
    let mut rng = Rng::new(8);
    let mut now: Vec<[f64; 3]> = (0..2000).map(|_| [(); 3].map(|()| 12.5 * rng.unit())).collect();
    let mut all = on_threads::<Space>(&now, Algorithm::Repair, &[1, 2, 3]);
    for step in 0..20 {
        let size = [0.009, 0.012, 0.015, 0.018, 0.022][step % 5];
        now.iter_mut().flatten().for_each(|x| *x += size * (rng.unit() - 0.5));
        for t in &mut all {
            let report = t.commit_positions(&now).expect("positions in range");
            assert!(report.rebuilds == 0 && report.flips > 30, "{report:?}");
        }
        assert_all_same(&all, &|| format!("step {step}"));
    }
}
