//! Long calls ask whether to go on, by the work that they do, whatever it consists of; and what is cancelled leaves
//! everything at its last timestamp. The oracle is a fresh build. Counts of calls do not depend on the machine.

use crate::common::{Rng, assert_same_cells, cell_set, fresh_cells};
use deldrift::motion::{Algorithm, CoincidencePolicy, MovingTriangulation, Options};
use deldrift::{Error, Plane, Space, VertexId};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// How often the monitor has been called, and at which call it says no.
#[derive(Default)]
struct Monitor {
    calls: AtomicU64,
    last: AtomicU64,
}

impl Monitor {
    fn new() -> Arc<Self> {
        Arc::new(Monitor { calls: AtomicU64::new(0), last: AtomicU64::new(u64::MAX) })
    }

    fn options(self: &Arc<Self>, algorithm: Algorithm) -> Options {
        let monitor = Arc::clone(self);
        let ask = move |_: f64| monitor.calls.fetch_add(1, Relaxed) + 1 < monitor.last.load(Relaxed);
        Options { algorithm, threads: 1, monitor: Some(Box::new(ask)), ..Options::default() }
    }

    /// From now on the `last`-th call says no.
    fn stop_at(&self, last: u64) {
        self.calls.store(0, Relaxed);
        self.last.store(last, Relaxed);
    }

    fn calls(&self) -> u64 {
        self.calls.load(Relaxed)
    }
}

/// Points on the moment curve: all are neighbours of each other.
fn moment_curve(n: usize) -> Vec<[f64; 3]> {
    (0..n).map(|k| k as f64).map(|x| [x, x * x, x * x * x]).collect()
}

type Positions = Vec<Option<[f64; 3]>>;

fn all(points: &[[f64; 3]]) -> Positions {
    points.iter().copied().map(Some).collect()
}

fn check(t: &MovingTriangulation<Space>, positions: &Positions, context: &str) {
    assert_same_cells(&cell_set(t), &fresh_cells::<Space>(positions), || context.into());
}

/// Makes a change at 500 vertices of the moment curve, cancelled at each of the first calls and then not; how often the
/// monitor is called.
fn ask_during(
    context: &str,
    algorithm: Algorithm,
    change: impl Fn(&mut MovingTriangulation<Space>) -> Result<(), Error>,
    after: &Positions,
) -> u64 {
    let points = moment_curve(500);
    let monitor = Monitor::new();
    let mut t = MovingTriangulation::new(&points, monitor.options(algorithm)).expect("room");
    let before = cell_set(&t);
    for last in [1, 2, 5] {
        monitor.stop_at(last);
        assert_eq!(change(&mut t), Err(Error::Cancelled), "{context}, {last}");
        assert_eq!(monitor.calls(), last, "{context}");
        assert_same_cells(&cell_set(&t), &before, || format!("{context}, cancelled at {last}"));
        t.discard_moves();
        assert_eq!((t.id_count(), t.vertex_count()), (points.len(), points.len()), "{context}");
    }
    monitor.stop_at(u64::MAX);
    change(&mut t).expect("room");
    check(&t, after, context);
    monitor.calls()
}

/// A vertex of high degree has a link whose triangulation is quadratic: it asks while that is made.
#[test]
fn removals_and_relocations_of_vertices_of_high_degree_ask() {
    let mut after = all(&moment_curve(500));
    after[20] = None;
    let remove = |t: &mut MovingTriangulation<Space>| t.remove_vertex(VertexId::new(20));
    let calls = ask_during("a removal", Algorithm::Auto, remove, &after);
    // 125,000 cells: about twice as many are made and then listed.
    assert!((8..100).contains(&calls), "{calls}");
    let aim = [100.0, 2e6, 5e5];
    after[20] = Some(aim);
    let relocate = |t: &mut MovingTriangulation<Space>| t.relocate_vertex(VertexId::new(20), &aim);
    ask_during("a relocation", Algorithm::Auto, relocate, &after);
    for algorithm in [Algorithm::PlacementFlips, Algorithm::Repair, Algorithm::Auto] {
        let commit = |t: &mut MovingTriangulation<Space>| {
            t.move_vertices(&[VertexId::new(20)], &[aim])?;
            t.commit_timestamp().map(drop)
        };
        ask_during(&format!("{algorithm:?}"), algorithm, commit, &after);
    }
}

/// Where those that leave have more neighbours in all than there are vertices, all are built again, which is faster by as
/// much.
#[test]
fn many_removals_of_vertices_of_high_degree_rebuild() {
    let monitor = Monitor::new();
    let points = moment_curve(700);
    let mut t = MovingTriangulation::new(&points, monitor.options(Algorithm::Auto)).expect("room");
    let leaving: Vec<_> = (0..20).map(|k| VertexId::new(30 * k + 7)).collect();
    monitor.stop_at(3);
    t.stage_removals(&leaving).expect("vertices");
    assert_eq!(t.commit_timestamp().map(drop), Err(Error::Cancelled));
    check(&t, &all(&points), "cancelled");
    monitor.stop_at(u64::MAX);
    let report = t.commit_timestamp().expect("room");
    assert_eq!((report.rebuilds, report.removed), (1, 20));
    let mut left = all(&points);
    leaving.iter().for_each(|v| left[v.index()] = None);
    check(&t, &left, "removed");
    // A quarter of a million cells.
    assert!((10..60).contains(&monitor.calls()), "{}", monitor.calls());
    // One by itself is removed by itself.
    t.stage_removals(&[VertexId::new(0)]).expect("a vertex");
    assert_eq!(t.commit_timestamp().expect("room").rebuilds, 0);
    left[0] = None;
    check(&t, &left, "one");
}

/// Few vertices of high degree among many of low degree are removed by themselves.
#[test]
fn removals_of_few_neighbours_do_not_rebuild() {
    let rng = &mut Rng::new(4);
    let mut points: Vec<[f64; 2]> = (0..4_000)
        .map(|_| {
            let (sin, cos) = (std::f64::consts::TAU * rng.unit()).sin_cos();
            [cos, sin].map(|x| x * (1.0 + 0.1 * rng.unit()))
        })
        .collect();
    points.extend([[0.0, 0.0], [0.01, 0.0]]);
    let mut t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("room");
    t.stage_removals(&[VertexId::new(4_000), VertexId::new(4_001), VertexId::new(5)]).expect("vertices");
    assert_eq!(t.commit_timestamp().expect("room").rebuilds, 0);
    let mut left: Vec<_> = points.into_iter().map(Some).collect();
    [4_000, 4_001, 5].into_iter().for_each(|v| left[v] = None);
    assert_same_cells(&cell_set(&t), &fresh_cells::<Plane>(&left), || "removed".into());
}

/// A small call asks nobody.
#[test]
fn short_calls_do_not_ask() {
    let monitor = Monitor::new();
    let rng = &mut Rng::new(1);
    let points: Vec<_> = (0..500).map(|_| [rng.unit(), rng.unit()]).collect();
    let mut t = MovingTriangulation::<Plane>::new(&points, monitor.options(Algorithm::Auto)).expect("room");
    monitor.stop_at(1);
    for v in 0..100 {
        t.relocate_vertex(VertexId::new(v), &[rng.unit(), rng.unit()]).expect("room");
        t.insert_vertex(&[rng.unit(), rng.unit()]).expect("room");
        t.remove_vertex(VertexId::new(v + 100)).expect("room");
    }
    assert_eq!(monitor.calls(), 0);
}

/// Thousands of vertices come to one place, in any order of ids, leave it, and are removed, staged or at once; hidden
/// vertices, cells and what is cancelled are as in fresh builds.
#[test]
fn crowds_at_one_place_come_and_go() {
    let rng = &mut Rng::new(9);
    let k = 3_000;
    let mut positions: Vec<Option<[f64; 2]>> = (0..500).map(|_| Some([rng.unit(), rng.unit()])).collect();
    positions.extend((0..k).map(|_| Some([rng.unit(), rng.unit()])));
    let start: Vec<_> = positions.iter().copied().flatten().collect();
    let monitor = Monitor::new();
    let mut t = MovingTriangulation::<Plane>::new(&start, monitor.options(Algorithm::Auto)).expect("room");
    let check = |t: &MovingTriangulation<Plane>, positions: &[Option<[f64; 2]>], context: &str| {
        assert_same_cells(&cell_set(t), &fresh_cells::<Plane>(positions), || context.into());
        let mut lowest = std::collections::HashMap::new();
        for (v, p) in positions.iter().enumerate() {
            let Some(p) = p else { continue };
            let first = *lowest.entry(p.map(f64::to_bits)).or_insert(v);
            let found = t.coincident_representative(VertexId::new(v as u32)).expect("a vertex");
            assert_eq!(found.index(), first, "{context}");
        }
    };
    let place = [0.25, 0.75];
    let mut crowd: Vec<usize> = (500..500 + k).collect();
    rng.shuffle(&mut crowd);
    for &v in &crowd {
        t.relocate_vertex(VertexId::new(v as u32), &place).expect("room");
        positions[v] = Some(place);
    }
    check(&t, &positions, "all there");
    rng.shuffle(&mut crowd);
    // Staged by halves: some leave, some are removed, some come back, more are inserted.
    for (round, half) in crowd.chunks(k / 6).enumerate() {
        let context = format!("round {round}");
        for &v in half {
            let id = VertexId::new(v as u32);
            match (round % 3, v % 2) {
                (0, 0) => {
                    positions[v] = Some([rng.unit(), rng.unit()]);
                    t.relocate_vertex(id, &positions[v].expect("one")).expect("room");
                }
                (0, _) => {
                    positions[v] = None;
                    t.remove_vertex(id).expect("room");
                }
                (1, 0) => {
                    positions[v] = Some([rng.unit(), rng.unit()]);
                    t.move_vertices(&[id], &[positions[v].expect("one")]).expect("room");
                }
                (1, _) => {
                    positions[v] = None;
                    t.stage_removals(&[id]).expect("room");
                }
                _ => {
                    positions.push(Some(place));
                    t.insert_vertex(&place).expect("room");
                }
            }
        }
        if round % 3 == 1 {
            t.stage_insertions(&vec![place; half.len()]).expect("room");
            positions.extend(vec![Some(place); half.len()]);
            // Cancelled where it asks, and then done.
            let before = cell_set(&t);
            let coincident = t.statistics().coincident;
            monitor.stop_at(1);
            if t.commit_timestamp().is_err() {
                assert_same_cells(&cell_set(&t), &before, || context.clone());
                assert_eq!(t.statistics().coincident, coincident);
            }
            monitor.stop_at(u64::MAX);
            t.commit_timestamp().expect("room");
        }
        check(&t, &positions, &context);
    }
    t.compact().expect("room");
    let left: Vec<_> = positions.iter().copied().filter(Option::is_some).collect();
    check(&t, &left, "compacted");
}

/// What is rejected in the middle of a commit puts a crowd back as it was.
#[test]
fn crowds_are_put_back() {
    let rng = &mut Rng::new(3);
    let mut points: Vec<[f64; 2]> = (0..2_000).map(|_| [rng.unit(), rng.unit()]).collect();
    let options = Options { coincidence: CoincidencePolicy::Merge, ..Options::default() };
    points.extend(vec![[0.5, 0.5]; 300]);
    let mut t = MovingTriangulation::<Plane>::new(&points, options).expect("room");
    let monitor = Monitor::new();
    let mut u = t.try_clone(monitor.options(Algorithm::Auto).monitor).expect("room");
    for t in [&mut t, &mut u] {
        t.set_algorithm(Algorithm::PlacementFlips);
        for k in 0..300 {
            t.move_vertices(&[VertexId::new(2_000 + k)], &[[0.1 + f64::from(k) * 1e-3, 0.3]]).expect("room");
            t.move_vertices(&[VertexId::new(k)], &[[0.5, 0.5]]).expect("room");
        }
    }
    let before = cell_set(&u);
    for last in 1..4 {
        monitor.stop_at(last);
        let done = u.commit_timestamp();
        assert_eq!(done.map(drop), Err(Error::Cancelled));
        assert_same_cells(&cell_set(&u), &before, || format!("cancelled at {last}"));
        assert_eq!(u.statistics().coincident, 299);
        (0..300).for_each(|k| {
            let found = u.coincident_representative(VertexId::new(2_000 + k)).expect("a vertex");
            assert_eq!(found.get(), 2_000);
        });
    }
    monitor.stop_at(u64::MAX);
    t.commit_timestamp().expect("room");
    u.commit_timestamp().expect("room");
    assert_same_cells(&cell_set(&u), &cell_set(&t), || "committed".into());
}
