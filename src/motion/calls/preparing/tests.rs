//! Rounds that are withdrawn to savepoints, beside a twin that has never prepared anything, and copies made at the
//! savepoints.

use super::*;
use crate::delaunay::{Level, Plane, Space};
use crate::ids::VertexId;
use crate::motion::algorithms::Algorithm;
use crate::motion::options::Options;
use crate::motion::state::segments::Segment;
use crate::random::Rng;

/// What is known without a look at the arrays of cells.
fn known<G: Moving>(t: &MovingTriangulation<G>) -> impl PartialEq + use<G> {
    let ids = || VertexId::range(0..t.id_count());
    let places: Vec<_> = ids().map(|v| t.position(v).ok().map(|p| p.as_ref().to_vec())).collect();
    let shown: Vec<_> = ids().map(|v| t.coincident_representative(v).ok()).collect();
    let keys: Vec<u64> = ids().map(|v| t.key_of_id(v)).collect();
    let withheld: Vec<bool> = ids().map(|v| t.mesh.is_withheld(v)).collect();
    let segments = t.mesh.segments.as_ref().filter(|segments| segments.enforced().len() > 0);
    let segments =
        segments.map(|segments| (segments.have_replaced_cells(), segments.enforced().collect::<Vec<_>>()));
    (places, shown, keys, withheld, segments, t.statistics, t.cell_count(), t.mesh.n_rounds())
}

/// The bytes of a copy in which all that is prepared is published; cells have been read for that.
fn bytes<G: Moving>(t: &MovingTriangulation<G>) -> Vec<u8> {
    t.duplicate(None).unwrap().saved().unwrap()
}

/// A place on a coarse grid, so that some are shared, and sometimes all are on a line.
fn place<G: Moving>(rng: &mut Rng) -> G::Point {
    let mut p = G::Point::default();
    (0..G::D).for_each(|axis| p[axis] = rng.below(64) as f64 / 8.0);
    p
}

/// Stages moves of few or of all, insertions and removals.
fn stage<G: Moving>(t: &mut MovingTriangulation<G>, rng: &mut Rng) {
    let present: Vec<VertexId> = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect();
    let coming: Vec<G::Point> = (0..rng.below(4)).map(|_| place::<G>(rng)).collect();
    match rng.below(4) {
        0 => _ = t.stage_insertions(&coming).unwrap(),
        1 => {
            let keys: Vec<u64> = coming.iter().map(|_| rng.below(99) as u64).collect();
            t.stage_insertions_with_keys(&coming, &keys).unwrap();
        }
        2 => t.stage_insertions_at_free_ids(&coming, None, |_| {}).unwrap(),
        _ => {}
    }
    let share = *rng.pick(&[1, 8, 1_000]);
    for v in present {
        if rng.one_in(share) {
            t.move_vertices(&[v], &[place::<G>(rng)]).unwrap();
        } else if rng.one_in(12) {
            t.stage_removals(&[v]).unwrap();
        }
    }
}

/// Stages a segment between vertices that stay, and removals of some.
fn stage_segments(t: &mut MovingTriangulation<Plane>, rng: &mut Rng) {
    let stays = |v: &VertexId| t.site_of_vertex("", 0, *v).is_ok();
    let staying: Vec<VertexId> = VertexId::range(0..t.id_count()).filter(stays).collect();
    if staying.len() > 1 && rng.one_in(2) {
        let k = 1 + rng.below(staying.len() - 1);
        let segment = Segment { ends: [staying[0], staying[k]], ..Segment::default() };
        t.stage_segments([segment].into_iter()).unwrap();
    }
    let leaving: Vec<_> = t.segments().map(|(id, _)| id).filter(|_| rng.one_in(4)).collect();
    t.stage_segment_removals(&leaving).unwrap();
}

type Stage<G> = fn(&mut MovingTriangulation<G>, &mut Rng);

/// A round, which segments may refuse.
fn round<G: Moving>(t: &mut MovingTriangulation<G>, rng: &mut Rng, more: Stage<G>) -> bool {
    t.set_algorithm(*rng.pick(&Algorithm::ALL));
    stage(t, rng);
    more(t, rng);
    match t.prepare_timestamp() {
        Ok(_) => true,
        Err(error) => {
            assert!(matches!(error, Error::Conflict { .. }), "{error}");
            t.discard_moves();
            false
        }
    }
}

fn history<G: Moving>(seed: u64, more: Stage<G>) {
    let rng = &mut Rng::new(seed);
    let n = *rng.pick(&[1, 5, 30, 120]);
    let points: Vec<G::Point> = (0..n).map(|_| place::<G>(rng)).collect();
    let build =
        || MovingTriangulation::<G>::new(&points, Options { threads: 1, ..Options::default() }).unwrap();
    let (mut t, mut twin) = (build(), build());
    for k in 0..3 {
        let context = || format!("{}D, {n} points, seed {seed}, {k}", G::D);
        let reads = rng.below(3);
        for t in [&mut t, &mut twin] {
            match reads {
                0 => _ = t.cells().unwrap(),
                1 => _ = t.take_changes().unwrap(),
                _ => {}
            }
        }
        // What was known at each savepoint, and the bytes, for which cells had to be read.
        let mut savepoints = Vec::new();
        for _ in 0..rng.below(12) {
            if !t.is_prepared() || rng.one_in(2) {
                let is_read = rng.one_in(2);
                if is_read && !t.is_prepared() {
                    twin.cells().unwrap();
                }
                savepoints.push((known(&t), is_read.then(|| bytes(&t))));
                t.set_savepoint().unwrap();
            }
            let is_refused = rng.one_in(4) || !round(&mut t, rng, more);
            if is_refused && !t.is_prepared() {
                savepoints.clear();
            }
            if rng.one_in(3) {
                t.cells().unwrap();
            }
            while rng.one_in(3)
                && let Some((expected, expected_bytes)) = savepoints.pop()
            {
                stage(&mut t, rng);
                t.withdraw_to_savepoint();
                assert_eq!(t.is_prepared(), !savepoints.is_empty(), "{}", context());
                assert!(known(&t) == expected, "{}: what is known", context());
                assert_eq!(t.validate(Level::Delaunay).err(), None, "{}", context());
                if let Some(expected) = expected_bytes {
                    assert!(bytes(&t) == expected, "{}: bytes", context());
                }
            }
        }
        t.withdraw_timestamp();
        t.set_algorithm(twin.algorithm());
        assert!(t.saved().unwrap() == twin.saved().unwrap(), "{}: all withdrawn", context());
    }
    for _ in 0..6 {
        t.set_savepoint().unwrap();
        if !round(&mut t, rng, more) || rng.one_in(3) {
            t.withdraw_to_savepoint();
        }
    }
    let n_published = u64::from(t.publish_timestamp().is_ok());
    assert_eq!((t.timestamp(), t.is_prepared()), (n_published, false));
    assert_eq!(t.validate(Level::Delaunay).err(), None);
    t.commit_timestamp().unwrap();
}

#[test]
fn rounds_are_withdrawn_to_savepoints() {
    for seed in 0..500 {
        history::<Plane>(seed, |_, _| {});
        history::<Space>(seed, |_, _| {});
        history::<Plane>(seed, stage_segments);
    }
}
