//! Timestamps that are prepared in rounds, published or withdrawn.

use super::*;
use crate::motion::{CommitReport, Level};
use std::sync::atomic::{AtomicI64, Ordering::Relaxed};
use std::sync::{Arc, OnceLock};

/// Stages edits, moves of some or of all, and now and then other vectors.
fn stage<G: Moving>(t: &mut PeriodicTriangulation<G>, rng: &mut Rng, basis: &[G::Point]) {
    let grid = (1u64 << 20) as f64;
    let n = t.inside.images.n_vertices();
    let present: Vec<VertexId> = VertexId::range(0..n).filter(|&v| t.is_present(v)).collect();
    let count = rng.below(3);
    t.stage_insertions(&random_points::<G>(rng, count, basis)).unwrap();
    if present.len() > 3 && rng.one_in(2) {
        t.stage_removals(&[present[rng.below(present.len())]]).unwrap();
    }
    let going: Vec<VertexId> = t.staged.removals().to_vec();
    let is_rare = rng.one_in(2);
    for v in present.into_iter().filter(|v| !going.contains(v)) {
        if is_rare && !rng.one_in(8) {
            continue;
        }
        let mut p = t.position(v).unwrap();
        (0..G::D).for_each(|axis| p[axis] += (rng.below(1 << 15) as f64 - (1 << 14) as f64) / grid);
        t.move_vertices(&[v], &[p]).unwrap();
    }
    if rng.one_in(3) {
        let mut other = basis.to_vec();
        for b in &mut other {
            (0..G::D).for_each(|axis| b[axis] += (rng.below(1 << 12) as f64 - (1 << 11) as f64) / grid);
        }
        t.stage_vectors(&other).unwrap();
    }
}

/// What is read of cells, with their indices, and of vertices.
#[derive(Debug, PartialEq)]
struct Seen {
    corners: Vec<Vec<u32>>,
    neighbours: Vec<Vec<u32>>,
    shifts: Vec<[i64; 3]>,
    positions: Vec<Option<Vec<f64>>>,
    edges: usize,
    statistics: CommitReport,
    vectors: Vec<Vec<f64>>,
    waiting: (usize, (usize, usize)),
}

fn seen<G: Moving>(t: &PeriodicTriangulation<G>) -> Seen {
    let cells = t.cells().unwrap();
    let position = |v| t.position(v).ok().map(|p| p.as_ref().to_vec());
    Seen {
        corners: cells.corners.iter().map(|row| row.as_ref().iter().map(|v| v.get()).collect()).collect(),
        neighbours: cells
            .neighbours
            .iter()
            .map(|row| row.as_ref().iter().map(|c| c.get()).collect())
            .collect(),
        shifts: t.cell_shifts().unwrap().collect(),
        positions: VertexId::range(0..t.id_count()).map(position).collect(),
        edges: t.edge_count().unwrap(),
        statistics: t.statistics(),
        vectors: t.vectors().map(|v| v.as_ref().to_vec()).collect(),
        waiting: (t.staged_count(), t.staged_edits()),
    }
}

/// Its bytes, and what is seen of it; it has not been read for that.
fn all_of<G: Moving>(t: &PeriodicTriangulation<G>) -> (Vec<u8>, Seen) {
    (t.saved().unwrap(), seen(&t.try_clone(None).unwrap()))
}

fn refuses_all_else<G: Moving>(t: &mut PeriodicTriangulation<G>, rounds: usize) {
    let (prepared, origin) = (Error::Prepared { timestamp: t.timestamp() + 1, rounds }, G::Point::default());
    assert_eq!(t.commit_timestamp().err(), Some(prepared.clone()));
    assert_eq!(t.commit_positions(&[]).err(), Some(prepared.clone()));
    assert_eq!(t.saved().err(), Some(prepared.clone()));
    assert_eq!(t.try_clone(None).err(), Some(prepared.clone()));
    assert_eq!(t.compact().err(), Some(prepared.clone()));
    assert_eq!(t.take_changes().err(), Some(prepared.clone()));
    assert_eq!(t.insert_vertex(&origin).err(), Some(prepared.clone()));
    assert_eq!(t.remove_vertex(VertexId::new(0)).err(), Some(prepared.clone()));
    assert_eq!(t.relocate_vertex(VertexId::new(0), &origin).err(), Some(prepared));
}

/// The cells are those of a fresh build.
fn is_as_anew<G: Moving>(t: &PeriodicTriangulation<G>, context: &str) {
    assert_eq!(t.violation(Level::Delaunay), Ok(None), "{context}");
    let ids = || VertexId::range(0..t.inside.images.n_vertices());
    let places: Vec<G::Point> = ids().map(|v| t.position(v).unwrap_or_default()).collect();
    let is_there: Vec<bool> = ids().map(|v| t.is_present(v)).collect();
    let vectors: Vec<G::Point> = t.vectors().collect();
    let expected = classes(&anew::<G>(&places, &is_there, &vectors), &places, &vectors);
    assert!(classes(t, &places, &vectors) == expected, "{context}");
}

/// Rounds, some of them refused on the way, which leaves those before, are withdrawn, which leaves the bytes that
/// there were, or published. How many have been refused after others.
fn prepared<G: Moving>(seed: u64, n: usize, basis: &[G::Point]) -> usize {
    let rng = &mut Rng::new(seed);
    let points = random_points::<G>(rng, n, basis);
    let patience = Arc::new(AtomicI64::new(-1));
    let left = Arc::clone(&patience);
    let monitor = move |_: f64| left.fetch_sub(1, Relaxed) != 0;
    let options = Options { monitor: Some(Box::new(monitor)), ..Options::default() };
    let mut t = PeriodicTriangulation::<G>::new(&points, basis, options).unwrap();
    let (takes, mut n_refused) = (rng.one_in(3), 0);
    for step in 0..6 {
        if takes {
            t.take_changes().unwrap();
        }
        if rng.one_in(2) {
            seen(&t);
        }
        let (before, mut beside) = (all_of(&t), t.try_clone(None).unwrap());
        let (timestamp, rounds, algorithm) = (t.timestamp(), 1 + rng.below(4), t.algorithm());
        for round in 0..rounds {
            let context = format!("{}D, {n} points, seed {seed}, step {step}, round {round}", G::D);
            t.set_algorithm(*rng.pick(&Algorithm::ALL));
            stage(&mut t, rng, basis);
            let mut is_made = false;
            if rng.one_in(2) {
                let known = seen(&t);
                patience.store(rng.below(3) as i64, Relaxed);
                let done = t.prepare_timestamp();
                patience.store(-1, Relaxed);
                is_made = done.is_ok();
                if !is_made {
                    n_refused += usize::from(round > 0);
                    assert_eq!(done.err(), Some(Error::Cancelled), "{context}");
                    assert!(seen(&t) == known, "{context}: a refused round is seen");
                    (t.cells, t.edges) = (OnceLock::new(), OnceLock::new());
                    assert!(seen(&t) == known, "{context}: a refused round is read");
                    assert_eq!(t.reject_prepared().is_err(), round > 0, "{context}");
                    if rng.one_in(2) {
                        is_as_anew(&t, &context);
                    }
                }
            }
            if !is_made {
                let report = t.prepare_timestamp().unwrap();
                assert_eq!((report.timestamp, t.timestamp()), (timestamp + 1, timestamp), "{context}");
            }
            assert_eq!((t.staged_count(), t.staged_edits()), (0, (0, 0)), "{context}");
            refuses_all_else(&mut t, round + 1);
            if rng.one_in(2) {
                is_as_anew(&t, &context);
            }
        }
        let context = format!("{}D, {n} points, seed {seed}, step {step}, {rounds} rounds", G::D);
        if rng.one_in(2) {
            if rng.one_in(2) {
                stage(&mut t, rng, basis);
            }
            t.withdraw_timestamp();
            assert_eq!(
                (t.publish_timestamp().err(), t.reject_prepared()),
                (Some(Error::NotPrepared), Ok(()))
            );
            t.set_algorithm(algorithm);
            if rng.one_in(2) {
                assert!(seen(&t) == before.1, "{context}: cells that are kept");
            }
            assert!(all_of(&t) == before, "{context}: bytes");
            let told: [Vec<u32>; 2] = [&mut t, &mut beside].map(|t| {
                let changes = t.take_changes().unwrap();
                let cells = [changes.created, changes.removed, changes.renumbered_to].concat();
                cells.iter().map(|c| c.get()).chain(changes.stars.iter().map(|v| v.get())).collect()
            });
            assert_eq!(told[0], told[1], "{context}");
            assert!(!takes || told[0].is_empty(), "{context}: nothing has changed");
        } else {
            assert_eq!(t.publish_timestamp().unwrap(), timestamp + 1);
            assert_eq!(t.reject_prepared(), Ok(()));
            is_as_anew(&t, &context);
            let bytes = t.saved().unwrap();
            let saved = SavedPeriodic::of(&bytes).unwrap();
            let loaded = PeriodicTriangulation::<G>::load(&saved, Options::default()).unwrap();
            assert!(loaded.saved().unwrap() == bytes, "{context}: loaded");
            is_as_anew(&loaded, &context);
        }
        stage(&mut t, rng, basis);
        t.commit_timestamp().unwrap();
        if rng.one_in(2) {
            is_as_anew(&t, &context);
        }
    }
    n_refused
}

#[test]
fn rounds_are_published_or_withdrawn() {
    // `DELDRIFT_SOAK=125` makes a thousand of it.
    let soak: f64 = std::env::var("DELDRIFT_SOAK").map_or(1.0, |soak| soak.parse().unwrap());
    let mut n_refused = 0;
    for seed in 0..(8.0 * soak).ceil() as u64 {
        let n = [1, 4, 40, 200][seed as usize % 4];
        n_refused += prepared::<Plane>(seed, n, &[[1.0, 0.0], [0.0, 1.0]]);
        n_refused += prepared::<Plane>(seed, n, &[[0.75, 0.25]]);
        let n = [1, 4, 30, 90][seed as usize % 4];
        n_refused += prepared::<Space>(seed, n, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 0.75]]);
    }
    assert!(n_refused > 20, "{n_refused} rounds have been refused after others");
}

/// What is prepared again and again, and withdrawn or published, needs no more memory.
fn keeps_its_memory<G: Moving>(basis: &[G::Point], is_published: bool) {
    let rng = &mut Rng::new(9);
    let points = random_points::<G>(rng, 300, basis);
    let mut t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    let mut most = 0;
    for step in 0..200 {
        for _ in 0..1 + step % 3 {
            let goals: Vec<G::Point> = points
                .iter()
                .map(|&(mut p)| {
                    (0..G::D).for_each(|axis| p[axis] += rng.below(1 << 12) as f64 / (1u64 << 20) as f64);
                    p
                })
                .collect();
            t.move_first(&goals).unwrap();
            t.prepare_timestamp().unwrap();
            t.cell_count().unwrap();
        }
        if is_published {
            _ = t.publish_timestamp().unwrap()
        } else {
            t.withdraw_timestamp()
        }
        t.cell_count().unwrap();
        if step < 50 {
            most = most.max(t.memory_bytes());
        } else {
            assert!(t.memory_bytes() <= most + most / 50, "step {step}: {} of {most}", t.memory_bytes());
        }
    }
}

#[test]
fn rounds_again_and_again_keep_their_memory() {
    for is_published in [false, true] {
        keeps_its_memory::<Plane>(&[[1.0, 0.0], [0.0, 1.0]], is_published);
        keeps_its_memory::<Space>(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], is_published);
    }
}

/// A round that cannot be made leaves those before, and what is staged.
#[test]
fn a_round_that_fails_leaves_those_before() {
    let basis = [[1.0, 0.0], [0.0, 1.0]];
    let points = random_points::<Plane>(&mut Rng::new(3), 50, &basis);
    let mut t = PeriodicTriangulation::<Plane>::new(&points, &basis, Options::default()).unwrap();
    let far = [1e13, 0.0];
    // In the box of side 1 that is a place, but not in one that is so much smaller.
    t.move_vertices(&[VertexId::new(7)], &[far]).unwrap();
    t.stage_vectors(&[[1e-8, 0.0], [0.0, 1e-8]]).unwrap();
    let before = all_of(&t);
    assert!(matches!(t.prepare_timestamp(), Err(Error::OutOfRange { index: 7, .. })));
    assert_eq!((all_of(&t), t.reject_prepared()), (before, Ok(())));
    t.discard_moves();
    t.stage_insertions(&[[0.5, 0.5]]).unwrap();
    t.prepare_timestamp().unwrap();
    let (cells, id) = (t.cell_count().unwrap(), VertexId::new(50));
    t.move_vertices(&[VertexId::new(7)], &[far]).unwrap();
    t.stage_vectors(&[[1e-8, 0.0], [0.0, 1e-8]]).unwrap();
    assert!(matches!(t.prepare_timestamp(), Err(Error::OutOfRange { index: 7, .. })));
    assert_eq!((t.cell_count().unwrap(), t.staged_count(), t.is_present(id)), (cells, 1, true));
    t.discard_moves();
    t.publish_timestamp().unwrap();
    assert_eq!((t.cell_count().unwrap(), t.timestamp(), t.position(id)), (cells, 1, Ok([0.5, 0.5])));
}
