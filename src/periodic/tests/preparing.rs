//! Timestamps that are prepared in rounds, published or withdrawn.

use super::*;

/// Stages edits, moves of some or of all, and now and then other vectors.
fn stage<G: Dimension>(t: &mut PeriodicTriangulation<G>, rng: &mut Rng, basis: &[G::Point]) {
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

/// What is read of a triangulation, with the indices of cells.
fn all_of<G: Dimension>(t: &PeriodicTriangulation<G>) -> (Vec<u8>, Vec<Vec<u32>>, Vec<[i64; 3]>) {
    let numbers = |row: &G::Vertices| row.as_ref().iter().map(|v| v.get()).collect();
    let corners = t.cells().unwrap().corners.iter().map(numbers).collect();
    (t.saved().unwrap(), corners, t.cell_shifts().unwrap().collect())
}

/// Rounds are withdrawn, which leaves the bytes that there were, or published, beside commits of the same.
fn prepared<G: Dimension>(seed: u64, n: usize, basis: &[G::Point], takes: bool) {
    let rng = &mut Rng::new(seed);
    let points = random_points::<G>(rng, n, basis);
    let mut t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    let mut beside = t.try_clone(None).unwrap();
    if takes {
        t.take_changes().unwrap();
        beside.take_changes().unwrap();
    }
    for step in 0..8 {
        let before = all_of(&t);
        let (timestamp, rounds) = (t.timestamp(), 1 + rng.below(3));
        // What is staged before the first round is forgotten when that is withdrawn.
        for round in 0..rounds {
            stage(&mut t, rng, basis);
            let report = t.prepare_timestamp().unwrap();
            assert_eq!((report.timestamp, t.timestamp()), (timestamp + 1, timestamp));
            let prepared = Error::Prepared { timestamp: timestamp + 1, rounds: round + 1 };
            assert_eq!(t.commit_timestamp().err(), Some(prepared.clone()));
            assert_eq!(t.commit_positions(&[]).err(), Some(prepared.clone()));
            assert_eq!(t.saved().err(), Some(prepared.clone()));
            assert_eq!(t.try_clone(None).err(), Some(prepared.clone()));
            assert_eq!(t.compact().err(), Some(prepared.clone()));
            assert_eq!(t.take_changes().err(), Some(prepared.clone()));
            assert_eq!(t.insert_vertex(&points[0]).err(), Some(prepared.clone()));
            assert_eq!(t.remove_vertex(VertexId::new(0)).err(), Some(prepared.clone()));
            assert_eq!(t.relocate_vertex(VertexId::new(0), &points[0]).err(), Some(prepared));
            let places: Vec<G::Point> =
                VertexId::range(0..t.id_count()).map(|v| t.position(v).unwrap_or_default()).collect();
            let is_there: Vec<bool> = VertexId::range(0..t.id_count()).map(|v| t.is_present(v)).collect();
            let vectors: Vec<G::Point> = t.vectors().collect();
            let expected = classes(&anew::<G>(&places, &is_there, &vectors), &places, &vectors);
            assert!(classes(&t, &places, &vectors) == expected, "seed {seed}, step {step}, round {round}");
        }
        if rng.one_in(2) {
            stage(&mut t, rng, basis);
            t.withdraw_timestamp();
            assert_eq!(all_of(&t), before, "seed {seed}, step {step}");
            assert_eq!(t.publish_timestamp().err(), Some(Error::NotPrepared));
            // Nothing has changed since changes were taken.
            if takes {
                assert!(t.take_changes().unwrap().stars.is_empty());
            }
            continue;
        }
        assert_eq!(t.publish_timestamp().unwrap(), timestamp + 1);
        assert_eq!(t.reject_prepared(), Ok(()));
        if takes {
            let changes = t.take_changes().unwrap();
            assert!(!changes.created.is_empty());
        }
    }
}

#[test]
fn rounds_are_published_or_withdrawn() {
    for seed in 0..8 {
        let n = [1, 4, 40, 200][seed as usize % 4];
        prepared::<Plane>(seed, n, &[[1.0, 0.0], [0.0, 1.0]], seed % 3 == 0);
        prepared::<Plane>(seed, n, &[[0.75, 0.25]], seed % 3 == 1);
        let n = [1, 4, 30, 90][seed as usize % 4];
        prepared::<Space>(seed, n, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 0.75]], seed % 3 == 2);
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
