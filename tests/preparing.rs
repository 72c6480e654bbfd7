//! Commits in two phases: what is prepared is what a commit would be, and what is withdrawn has never been, beside a twin
//! that has never prepared anything and beside fresh builds.

use crate::common::inputs::{Kind, draw, draw_one};
use crate::common::{
    CellSet, Rng, assert_same_cells, cell_set, check_adjacency, fresh_cells, point, seeds, vertex,
};
use deldrift::motion::{Algorithm, Level, MovingTriangulation, Options, Saved, Segment};
use deldrift::{Dimension, Error, Plane, SegmentId, Space, VertexId};
use std::cmp::Ordering;
use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering::Relaxed};

const KINDS: [Kind; 6] =
    [Kind::Random, Kind::Lattice, Kind::Sphere, Kind::Hyperplane, Kind::Clusters, Kind::Duplicates];

/// What is to be staged.
#[derive(Clone, Debug)]
struct Staged<P> {
    coming: Vec<P>,
    /// Keys of those that come.
    keys: Option<Vec<u64>>,
    /// Whether those that come are given ids of removed vertices.
    is_at_free: bool,
    leaving: Vec<VertexId>,
    moves: Vec<(VertexId, P)>,
    all: Option<Vec<P>>,
}

/// Something to be staged in the present state of a triangulation.
fn drawn<G: Dimension>(t: &MovingTriangulation<G>, kind: Kind, rng: &mut Rng) -> Staged<G::Point> {
    let mut staged = Staged {
        coming: Vec::new(),
        keys: None,
        is_at_free: rng.one_in(3),
        leaving: Vec::new(),
        moves: Vec::new(),
        all: None,
    };
    let mut present: Vec<VertexId> = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect();
    let place = |v: VertexId, rng: &mut Rng| {
        let p = t.position(v).expect("present");
        match rng.below(8) {
            0 => draw_one::<G>(kind, present.len().max(4), rng),
            1 => p,
            2 => *rng.pick(&present.iter().map(|&v| t.position(v).expect("present")).collect::<Vec<_>>()),
            _ => point::<G>(|k| p[k] + 0.25 * rng.within(-2, 2) as f64),
        }
    };
    if rng.one_in(4) && present.len() == t.id_count() {
        staged.all = Some(present.iter().map(|&v| place(v, rng)).collect());
        return staged;
    }
    if !present.is_empty() {
        let most = if rng.one_in(3) { present.len() } else { 5 };
        for _ in 0..rng.below(most) {
            let v = *rng.pick(&present);
            if staged.moves.iter().all(|&(other, _)| other != v) {
                staged.moves.push((v, place(v, rng)));
            }
        }
    }
    let share = *rng.pick(&[3, 20, 100]);
    staged.coming = (0..rng.below(2 + present.len() / share))
        .map(|_| draw_one::<G>(kind, present.len().max(4), rng))
        .collect();
    staged.keys = rng.one_in(3).then(|| staged.coming.iter().map(|_| drawn_key(rng)).collect());
    present.retain(|v| staged.moves.iter().all(|(moved, _)| moved != v));
    rng.shuffle(&mut present);
    present.truncate(rng.below(2 + present.len() / share));
    staged.leaving = present;
    staged
}

/// A key that many vertices have, or few.
fn drawn_key(rng: &mut Rng) -> u64 {
    let n = *rng.pick(&[3, 50, usize::MAX]);
    rng.below(n) as u64
}

/// Stages all of it; returns the ids of those that come.
fn stage<G: Dimension>(t: &mut MovingTriangulation<G>, staged: &Staged<G::Point>) -> Vec<VertexId> {
    let mut ids = Vec::new();
    if let Some(all) = &staged.all {
        t.move_all(all).expect("room");
        return ids;
    }
    if staged.is_at_free {
        let keys = staged.keys.as_deref();
        t.stage_insertions_at_free_ids(&staged.coming, keys, |v| ids.push(v)).expect("room");
    } else if !staged.coming.is_empty() {
        let first = match &staged.keys {
            Some(keys) => t.stage_insertions_with_keys(&staged.coming, keys),
            None => t.stage_insertions(&staged.coming),
        };
        ids.extend(VertexId::range(first.expect("room").index()..t.id_count()));
    }
    for &(v, p) in &staged.moves {
        t.move_vertices(&[v], &[p]).expect("room");
    }
    t.stage_removals(&staged.leaving).expect("room");
    ids
}

/// Changes as they were told.
#[derive(Debug, PartialEq)]
struct Told(Vec<Vec<u32>>);

fn told<G: Dimension>(t: &mut MovingTriangulation<G>) -> Told {
    let changes = t.take_changes().expect("room");
    let cells = [changes.created, changes.removed, changes.renumbered_from, changes.renumbered_to];
    let vertices = [changes.stars, changes.hidden, changes.shown];
    let mut lists: Vec<Vec<u32>> = cells.iter().map(|list| list.iter().map(|c| c.get()).collect()).collect();
    lists.extend(vertices.iter().map(|list| list.iter().map(|v| v.get()).collect::<Vec<u32>>()));
    lists.push(changes.removed_corners.iter().flat_map(|row| row.as_ref()).map(|v| v.get()).collect());
    Told(lists)
}

fn bytes<G: Dimension>(t: &MovingTriangulation<G>) -> Vec<u8> {
    t.saved().expect("room")
}

fn positions<G: Dimension>(t: &MovingTriangulation<G>) -> Vec<Option<G::Point>> {
    VertexId::range(0..t.id_count()).map(|v| t.position(v).ok()).collect()
}

fn hidden<G: Dimension>(t: &MovingTriangulation<G>) -> Vec<Option<VertexId>> {
    VertexId::range(0..t.id_count()).map(|v| t.coincident_representative(v).ok()).collect()
}

fn keys<G: Dimension>(t: &MovingTriangulation<G>) -> Vec<u64> {
    VertexId::range(0..t.id_count()).map(|v| t.key_of_id(v)).collect()
}

/// Everything that reads sees the prepared state.
fn check_prepared<G: Dimension>(t: &mut MovingTriangulation<G>, context: &dyn Fn() -> String) {
    t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("{}: {violation}", context()));
    check_adjacency(t, context);
    assert_same_cells(&cell_set(t), &cells_by_rank(t), context);
}

/// The cells of a build without keys of the vertices in the order of their keys and places.
fn cells_by_rank<G: Dimension>(t: &MovingTriangulation<G>) -> CellSet {
    let mut order: Vec<VertexId> = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect();
    let place = |v| t.position(v).expect("present");
    order.sort_by(|&v, &w| {
        let (p, q) = (place(v), place(w));
        let differing = (0..G::D).map(|k| p[k].total_cmp(&q[k])).find(|order| order.is_ne());
        let by_key = t.key_of_id(v).cmp(&t.key_of_id(w));
        by_key.then(differing.unwrap_or(Ordering::Equal)).then(v.cmp(&w))
    });
    let places: Vec<Option<G::Point>> = order.iter().map(|&v| Some(place(v))).collect();
    let named = |cell: &Vec<VertexId>| {
        let mut cell: Vec<VertexId> = cell.iter().map(|&k| order[k]).collect();
        cell.sort_unstable();
        cell
    };
    fresh_cells::<G>(&places).iter().map(named).collect()
}

/// What may not be done while a timestamp is prepared is refused, and does nothing.
fn check_refusals<G: Dimension>(t: &mut MovingTriangulation<G>, rounds: usize, context: &dyn Fn() -> String) {
    let refusal = Error::Prepared { timestamp: t.timestamp() + 1, rounds };
    let (n_ids, p) = (t.id_count(), G::Point::default());
    assert_eq!(t.commit_timestamp().err(), Some(refusal.clone()), "{}", context());
    assert_eq!(t.commit_positions(&[]).err(), Some(refusal.clone()), "{}", context());
    assert_eq!(t.insert_vertex(&p).err(), Some(refusal.clone()), "{}", context());
    assert_eq!(t.remove_vertex(vertex(0)).err(), Some(refusal.clone()), "{}", context());
    assert_eq!(t.relocate_vertex(vertex(0), &p).err(), Some(refusal.clone()), "{}", context());
    assert_eq!(t.compact().err(), Some(refusal.clone()), "{}", context());
    assert_eq!(t.take_changes().err(), Some(refusal.clone()), "{}", context());
    assert_eq!(t.saved().err(), Some(refusal.clone()), "{}", context());
    assert_eq!(t.try_clone(None).err(), Some(refusal), "{}", context());
    assert_eq!(t.id_count(), n_ids, "{}", context());
}

/// A triangulation and a twin that prepares nothing, after the same calls.
struct Pair<G: Dimension> {
    t: MovingTriangulation<G>,
    twin: MovingTriangulation<G>,
    /// Calls of the monitor of `t` until it cancels; negative if it never does.
    patience: Arc<AtomicI64>,
}

fn pair<G: Dimension>(kind: Kind, n: usize, threads: u32, rng: &mut Rng) -> Pair<G> {
    let points = draw::<G>(kind, n, rng);
    let patience = Arc::new(AtomicI64::new(-1));
    let left = Arc::clone(&patience);
    let monitor = move |_: f64| left.fetch_sub(1, Relaxed) != 0;
    let options = Options { threads, monitor: Some(Box::new(monitor)), ..Options::default() };
    let keys: Option<Vec<u64>> = rng.one_in(3).then(|| points.iter().map(|_| drawn_key(rng)).collect());
    let build = |options| match &keys {
        Some(keys) => MovingTriangulation::with_keys(&points, keys, options),
        None => MovingTriangulation::new(&points, options),
    };
    let t = build(options).expect("a build");
    let twin = build(Options { threads, ..Options::default() }).expect("a build");
    Pair { t, twin, patience }
}

impl<G: Dimension> Pair<G> {
    fn both(&mut self, mut call: impl FnMut(&mut MovingTriangulation<G>)) {
        call(&mut self.t);
        call(&mut self.twin);
    }

    /// Prepares in a few rounds, with reading in between or without; some are cancelled.
    fn prepare(&mut self, kind: Kind, rng: &mut Rng, context: &dyn Fn() -> String) -> Vec<Staged<G::Point>> {
        let (mut rounds, mut removed) = (Vec::new(), Vec::new());
        for _ in 0..1 + rng.below(4) {
            self.t.set_algorithm(*rng.pick(&Algorithm::ALL));
            let staged = drawn(&self.t, kind, rng);
            let ids = stage(&mut self.t, &staged);
            assert!(ids.iter().all(|id| !removed.contains(id)), "{}: {ids:?}, {removed:?}", context());
            removed.extend(&staged.leaving);
            if rng.one_in(4) {
                let (before, was_prepared) = (positions(&self.t), self.t.is_prepared());
                self.patience.store(rng.below(4) as i64, Relaxed);
                let done = self.t.prepare_timestamp();
                self.patience.store(-1, Relaxed);
                match done {
                    Ok(_) => rounds.push(staged),
                    Err(error) => {
                        assert_eq!(error, Error::Cancelled, "{}", context());
                        assert_eq!(self.t.is_prepared(), was_prepared, "{}", context());
                        assert_eq!(positions(&self.t), before, "{}", context());
                        if rng.one_in(2) {
                            check_prepared(&mut self.t, context);
                        }
                        self.t.prepare_timestamp().expect("room");
                        rounds.push(staged);
                    }
                }
            } else {
                let report = self.t.prepare_timestamp().expect("room");
                assert_eq!(report.timestamp, self.t.timestamp() + 1, "{}", context());
                rounds.push(staged);
            }
            assert_eq!((self.t.staged_count(), self.t.staged_edits()), (0, (0, 0)), "{}", context());
            if rng.one_in(2) {
                check_prepared(&mut self.t, context);
            }
            if rng.one_in(3) {
                check_refusals(&mut self.t, rounds.len(), context);
            }
        }
        rounds
    }

    fn withdraw(&mut self, rng: &mut Rng) {
        if self.t.is_prepared() && rng.one_in(3) {
            let staged = drawn(&self.t, Kind::Random, rng);
            stage(&mut self.t, &staged);
        }
        self.t.withdraw_timestamp();
        assert!(!self.t.is_prepared());
    }

    fn compare_sets(&mut self, context: &dyn Fn() -> String) {
        assert_eq!(positions(&self.t), positions(&self.twin), "{}", context());
        assert_eq!(hidden(&self.t), hidden(&self.twin), "{}", context());
        assert_eq!(keys(&self.t), keys(&self.twin), "{}", context());
        assert_eq!(self.t.timestamp(), self.twin.timestamp(), "{}", context());
        self.t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("{}: {violation}", context()));
        assert_same_cells(&cell_set(&self.t), &cell_set(&self.twin), context);
    }
}

/// A triangulation that has withdrawn is, byte for byte, as its twin, and then goes on as that does.
fn withdrawn_is_as_never_prepared<G: Dimension>(seed: u64) {
    deldrift::internals::use_all_threads();
    let rng = &mut Rng::new(seed);
    let (kind, threads) = (*rng.pick(&KINDS), 1 + rng.below(2) as u32);
    let n = *rng.pick(&[1, 4, 20, 100, 400]);
    let mut pair = pair::<G>(kind, n, threads, rng);
    let reads = rng.below(3);
    let context = || format!("{}D, {kind:?}, {n} points, {threads} threads, seed {seed}", G::D);
    for _ in 0..rng.below(4) {
        match reads {
            1 if rng.one_in(2) => pair.both(|t| drop(cell_set(t))),
            2 if rng.one_in(2) => pair.both(|t| drop(told(t))),
            _ => {}
        }
        let algorithm = *rng.pick(&Algorithm::ALL);
        let staged = drawn(&pair.t, kind, rng);
        pair.both(|t| {
            t.set_algorithm(algorithm);
            stage(t, &staged);
            t.commit_timestamp().expect("room");
        });
    }
    let (algorithm, statistics) = (pair.t.algorithm(), pair.t.statistics());
    for _ in 0..1 + rng.below(3) {
        pair.prepare(kind, rng, &context);
        pair.withdraw(rng);
    }
    pair.t.set_algorithm(algorithm);
    assert_eq!(pair.t.statistics(), statistics, "{}", context());
    // How many certificates several threads evaluate depends on which of them is first.
    if statistics == pair.twin.statistics() {
        assert!(bytes(&pair.t) == bytes(&pair.twin), "{}: bytes differ", context());
    } else {
        assert_eq!(threads, 2, "{}", context());
    }
    assert_eq!(told(&mut pair.t), told(&mut pair.twin), "{}", context());
    for _ in 0..3 {
        let rounds = pair.prepare(kind, rng, &context);
        if rng.one_in(3) {
            pair.withdraw(rng);
        } else {
            assert_eq!(pair.t.publish_timestamp(), Ok(pair.twin.timestamp() + 1));
            // Where ids are given again, those of the first round's vertices are free after a commit.
            let is_committed = rounds.iter().skip(1).all(|staged| !staged.is_at_free);
            for (k, staged) in rounds.iter().enumerate() {
                stage(&mut pair.twin, staged);
                if k == 0 && is_committed {
                    pair.twin.commit_timestamp().expect("room");
                } else {
                    pair.twin.prepare_timestamp().expect("room");
                }
            }
            if rounds.len() > 1 {
                // The twin's later rounds are none of a timestamp of its own.
                let (t, twin) = (cell_set(&pair.t), cell_set(&pair.twin));
                assert_same_cells(&t, &twin, context);
                assert_eq!(positions(&pair.t), positions(&pair.twin), "{}", context());
                return;
            }
        }
        pair.compare_sets(&context);
    }
}

#[test]
fn what_is_withdrawn_has_never_been_in_the_plane() {
    seeds(300).for_each(withdrawn_is_as_never_prepared::<Plane>);
}

#[test]
fn what_is_withdrawn_has_never_been_in_space() {
    seeds(200).for_each(withdrawn_is_as_never_prepared::<Space>);
}

/// One round and publishing is a commit, cell by cell in its index.
fn one_round_is_a_commit<G: Dimension>(seed: u64) {
    let rng = &mut Rng::new(seed);
    let kind = *rng.pick(&KINDS);
    let mut pair = pair::<G>(kind, 200, 1, rng);
    let context = || format!("{}D, {kind:?}, seed {seed}", G::D);
    let algorithm = *rng.pick(&Algorithm::ALL);
    pair.both(|t| t.set_algorithm(algorithm));
    pair.both(|t| drop(told(t)));
    for _ in 0..6 {
        let staged = drawn(&pair.t, kind, rng);
        pair.both(|t| drop(stage(t, &staged)));
        let prepared = pair.t.prepare_timestamp().expect("room");
        pair.t.publish_timestamp().expect("it is prepared");
        assert_eq!(prepared, pair.twin.commit_timestamp().expect("room"), "{}", context());
        assert!(bytes(&pair.t) == bytes(&pair.twin), "{}: bytes differ", context());
        assert_eq!(told(&mut pair.t), told(&mut pair.twin), "{}", context());
    }
}

#[test]
fn one_round_and_publishing_is_a_commit() {
    seeds(60).for_each(one_round_is_a_commit::<Plane>);
    seeds(40).for_each(one_round_is_a_commit::<Space>);
}

/// Segments come, go and are refused in rounds; what is withdrawn has never been.
fn segments_are_withdrawn(seed: u64) {
    let rng = &mut Rng::new(seed);
    let kind = *rng.pick(&[Kind::Random, Kind::Lattice, Kind::Duplicates, Kind::Hyperplane]);
    let n = *rng.pick(&[8, 40, 150]);
    let mut pair = pair::<Plane>(kind, n, 1, rng);
    let context = || format!("{kind:?}, {n} points, seed {seed}");
    let reads = rng.one_in(2);
    for _ in 0..4 {
        let (staged, segments) = (drawn(&pair.t, kind, rng), drawn_segments(&pair.t, rng));
        let algorithm = *rng.pick(&Algorithm::ALL);
        let mut done = Vec::new();
        pair.both(|t| {
            t.set_algorithm(algorithm);
            stage(t, &staged);
            stage_segments(t, &segments);
            done.push(t.commit_timestamp().map(drop));
            if done[0].is_err() {
                t.discard_moves();
            }
            if reads {
                drop(told(t));
            }
        });
        assert_eq!(done[0], done[1], "{}", context());
    }
    let algorithm = pair.t.algorithm();
    for _ in 0..3 {
        let mut n_rounds = 0;
        for _ in 0..1 + rng.below(4) {
            pair.t.set_algorithm(*rng.pick(&Algorithm::ALL));
            let (staged, segments) = (drawn(&pair.t, kind, rng), drawn_segments(&pair.t, rng));
            stage(&mut pair.t, &staged);
            stage_segments(&mut pair.t, &segments);
            if rng.one_in(3) {
                let _ = pair.t.check_staged();
            }
            let before: Vec<_> = pair.t.segments().collect();
            match pair.t.prepare_timestamp() {
                Ok(_) => n_rounds += 1,
                Err(Error::Conflict { .. }) => {
                    assert_eq!(pair.t.segments().collect::<Vec<_>>(), before, "{}", context());
                    pair.t.discard_moves();
                }
                Err(error) => panic!("{}: {error}", context()),
            }
            if pair.t.is_prepared() && rng.one_in(2) {
                pair.t.validate(Level::Delaunay).unwrap_or_else(|wrong| panic!("{}: {wrong}", context()));
                check_adjacency(&pair.t, &context);
            }
        }
        assert_eq!(pair.t.is_prepared(), n_rounds > 0, "{}", context());
        pair.withdraw(rng);
    }
    pair.t.discard_moves();
    pair.t.set_algorithm(algorithm);
    assert!(pair.t.segments().eq(pair.twin.segments()), "{}", context());
    assert!(bytes(&pair.t) == bytes(&pair.twin), "{}: bytes differ", context());
    assert_eq!(told(&mut pair.t), told(&mut pair.twin), "{}", context());
    pair.compare_sets(&context);
    for _ in 0..3 {
        let (staged, segments) = (drawn(&pair.t, kind, rng), drawn_segments(&pair.t, rng));
        pair.both(|t| {
            stage(t, &staged);
            stage_segments(t, &segments);
        });
        let done = pair.t.prepare_timestamp();
        let committed = pair.twin.commit_timestamp();
        assert_eq!(done.is_ok(), committed.is_ok(), "{}", context());
        if done.is_ok() {
            pair.t.publish_timestamp().expect("it is prepared");
        } else {
            pair.both(|t| {
                t.discard_moves();
            });
        }
        pair.compare_sets(&context);
        assert!(pair.t.segments().eq(pair.twin.segments()), "{}", context());
    }
}

/// Segments to be staged, and those to be removed.
type StagedSegments = (Vec<Segment>, Vec<SegmentId>);

fn drawn_segments(t: &MovingTriangulation<Plane>, rng: &mut Rng) -> StagedSegments {
    let present: Vec<VertexId> = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect();
    let (mut coming, mut leaving) = (Vec::new(), Vec::new());
    if present.len() > 1 {
        for marker in 0..rng.below(4) as i32 {
            let ends = [*rng.pick(&present), *rng.pick(&present)];
            if ends[0] != ends[1] {
                coming.push(Segment { ends, marker, ..Segment::default() });
            }
        }
    }
    for (id, _) in t.segments() {
        if rng.one_in(3) {
            leaving.push(id);
        }
    }
    (coming, leaving)
}

fn stage_segments(t: &mut MovingTriangulation<Plane>, (coming, leaving): &StagedSegments) {
    t.stage_segments(coming.iter().copied()).expect("room");
    t.stage_segment_removals(leaving).expect("room");
}

#[test]
fn segments_that_are_withdrawn_have_never_been() {
    seeds(300).for_each(segments_are_withdrawn);
}

#[test]
fn nothing_is_published_or_withdrawn_that_is_not_prepared() {
    let mut t = MovingTriangulation::<Plane>::new(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], Options::default())
        .expect("room");
    assert_eq!(t.publish_timestamp(), Err(Error::NotPrepared));
    t.move_vertices(&[vertex(0)], &[[0.1, 0.1]]).expect("room");
    t.withdraw_timestamp();
    assert_eq!((t.staged_count(), t.is_prepared()), (1, false));
    t.prepare_timestamp().expect("room");
    assert_eq!((t.publish_timestamp(), t.publish_timestamp()), (Ok(1), Err(Error::NotPrepared)));
    // Nothing staged is a round as well.
    t.prepare_timestamp().expect("room");
    assert_eq!((t.is_prepared(), t.publish_timestamp()), (true, Ok(2)));
}

#[test]
fn insertions_that_have_been_loaded_give_their_ids_back() {
    let places = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let mut t = MovingTriangulation::<Plane>::new(&places, Options::default()).expect("room");
    t.remove_vertex(vertex(1)).expect("present");
    t.stage_insertions_at_free_ids(&[[0.2, 0.2], [0.3, 0.7]], Some(&[7, 7]), |_| ()).expect("room");
    let saved = bytes(&t);
    let saved = Saved::of(&saved).expect("its own bytes");
    let mut t = MovingTriangulation::<Plane>::load(&saved, Options::default()).expect("its own bytes");
    assert_eq!((t.id_count(), t.staged_edits()), (5, (2, 0)));
    t.prepare_timestamp().expect("room");
    assert_eq!(t.vertex_count(), 5);
    t.withdraw_timestamp();
    assert_eq!((t.id_count(), t.vertex_count(), t.staged_edits()), (4, 3, (0, 0)));
}
