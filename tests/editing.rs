//! Insertions and removals staged into commits, with moves and immediate calls in between: the cells are those of a
//! fresh build after every commit, and a commit that is cancelled leaves everything as it was, staged.

use crate::common::exact::representatives;
use crate::common::history::Snapshot;
use crate::common::inputs::{Kind, draw, draw_one};
use crate::common::{Rng, assert_same_cells, cell_set, fresh_cells, ids, point, seeds, vertex, vertices};
use deldrift::motion::Level;
use deldrift::motion::{Algorithm, CoincidencePolicy, MovingTriangulation, Options, Saved};
use deldrift::{Dimension, Plane, Space, VertexId};
use deldrift::{Error, StagedEdit};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering::Relaxed};

const KINDS: [Kind; 4] = [Kind::Random, Kind::Lattice, Kind::Sphere, Kind::Hyperplane];

/// What a triangulation should hold.
struct Model<G: Dimension> {
    t: MovingTriangulation<G>,
    positions: Vec<Option<G::Point>>,
    moves: BTreeMap<VertexId, G::Point>,
    coming: BTreeMap<VertexId, G::Point>,
    leaving: Vec<VertexId>,
    /// Calls of the monitor until it cancels; negative if it never does.
    patience: Arc<AtomicI64>,
    rng: Rng,
    kind: Kind,
    name: String,
}

impl<G: Dimension> Model<G> {
    fn new(kind: Kind, n: usize, seed: u64, threads: u32) -> Self {
        deldrift::internals::use_all_threads();
        let mut rng = Rng::new(seed);
        let points = draw::<G>(kind, n, &mut rng);
        let patience = Arc::new(AtomicI64::new(-1));
        let left = Arc::clone(&patience);
        let monitor = move |_: f64| left.fetch_sub(1, Relaxed) != 0;
        let options = Options { threads, monitor: Some(Box::new(monitor)), ..Options::default() };
        let t = MovingTriangulation::new(&points, options).expect("a build");
        let name = format!("{}D, {kind:?}, {n} points, seed {seed}, {threads} threads", G::D);
        let positions = points.into_iter().map(Some).collect();
        let (moves, coming, leaving) = (BTreeMap::new(), BTreeMap::new(), Vec::new());
        Model { t, positions, moves, coming, leaving, patience, rng, kind, name }
    }

    fn place(&mut self) -> G::Point {
        let present: Vec<G::Point> = self.positions.iter().flatten().copied().collect();
        if !present.is_empty() && self.rng.one_in(4) {
            return *self.rng.pick(&present);
        }
        draw_one::<G>(self.kind, self.positions.len(), &mut self.rng)
    }

    fn stage(&mut self) {
        let n_present = self.positions.iter().flatten().count();
        let share = *self.rng.pick(&[2, 5, 50]);
        let coming: Vec<G::Point> =
            (0..self.rng.below(1 + n_present / share + 3)).map(|_| self.place()).collect();
        let first = self.t.stage_insertions(&coming).expect("room");
        assert_eq!(first.index(), self.positions.len(), "{}", self.name);
        for (k, q) in coming.into_iter().enumerate() {
            self.positions.push(None);
            self.coming.insert(VertexId::at(first.index() + k), q);
        }
        let mut movable: Vec<VertexId> = VertexId::range(0..self.positions.len())
            .filter(|v| self.positions[*v].is_some() && !self.leaving.contains(v))
            .collect();
        self.rng.shuffle(&mut movable);
        let n_moves = self.rng.below(movable.len() + 1);
        for &v in &movable[..n_moves] {
            if self.moves.contains_key(&v) {
                continue;
            }
            let far = self.rng.one_in(8);
            let p = self.positions[v].expect("present");
            let q = if far { self.place() } else { point::<G>(|k| p[k] + self.rng.within(-1, 1) as f64) };
            self.t.move_vertices(&[v], &[q]).expect("room");
            self.moves.insert(v, q);
        }
        self.rng.shuffle(&mut movable);
        let n_leaving = self.rng.below(movable.len() / share + 2).min(movable.len());
        let leaving = movable[..n_leaving].to_vec();
        self.t.stage_removals(&leaving).expect("room");
        for v in leaving {
            self.moves.remove(&v);
            self.leaving.push(v);
        }
        assert_eq!(self.t.staged_count(), self.moves.len(), "{}", self.name);
        assert_eq!(self.t.staged_edits(), (self.coming.len(), self.leaving.len()), "{}", self.name);
    }

    fn commit(&mut self, algorithm: Algorithm) {
        self.t.set_algorithm(algorithm);
        for cancelled in 0..3 {
            let before = Snapshot::of(&self.t);
            let changes = cell_set(&self.t);
            self.patience.store(if cancelled < 2 { 0 } else { -1 }, Relaxed);
            if cancelled == 1 {
                self.patience.store(1 + self.rng.below(3) as i64, Relaxed);
            }
            match self.t.commit_timestamp() {
                Ok(report) => {
                    assert_eq!(report.inserted, self.coming.len() as u64, "{} {algorithm:?}", self.name);
                    assert_eq!(report.removed, self.leaving.len() as u64, "{} {algorithm:?}", self.name);
                    break;
                }
                Err(error) => {
                    assert_eq!(error, Error::Cancelled, "{} {algorithm:?}", self.name);
                    assert_eq!(Snapshot::of(&self.t), before, "{} {algorithm:?}", self.name);
                    assert_eq!(cell_set(&self.t), changes);
                    assert_eq!(self.t.staged_edits(), (self.coming.len(), self.leaving.len()));
                }
            }
        }
        for (v, q) in std::mem::take(&mut self.moves).into_iter().chain(std::mem::take(&mut self.coming)) {
            self.positions[v] = Some(q);
        }
        for v in std::mem::take(&mut self.leaving) {
            self.positions[v] = None;
        }
        self.check(algorithm);
    }

    fn check(&self, algorithm: Algorithm) {
        let context = || format!("{} after {algorithm:?}", self.name);
        if let Err(violation) = self.t.validate(Level::Delaunay) {
            panic!("{}: {violation}", context());
        }
        assert_same_cells(&cell_set(&self.t), &fresh_cells::<G>(&self.positions), context);
        for (v, (p, r)) in vertices().zip(self.positions.iter().zip(representatives(&self.positions))) {
            assert_eq!(self.t.position(v).ok(), *p, "{}: vertex {v}", context());
            assert_eq!(self.t.coincident_representative(v).ok(), r, "{}: vertex {v}", context());
        }
        assert_eq!(self.t.vertex_count(), self.positions.iter().flatten().count(), "{}", context());
        assert_eq!(self.t.id_count(), self.positions.len(), "{}", context());
    }

    /// A few immediate calls, on vertices about to go as well.
    fn call(&mut self) {
        let present: Vec<VertexId> =
            VertexId::range(0..self.positions.len()).filter(|v| self.positions[*v].is_some()).collect();
        match self.rng.below(4) {
            0 => {
                let q = self.place();
                let v = self.t.insert_vertex(&q).expect("room");
                assert_eq!(v.index(), self.positions.len());
                self.positions.push(Some(q));
            }
            1 if !present.is_empty() => {
                let v = *self.rng.pick(&present);
                self.t.remove_vertex(v).expect("it is present");
                self.positions[v] = None;
                self.moves.remove(&v);
                self.leaving.retain(|&w| w != v);
            }
            2 if !present.is_empty() => {
                let v = *self.rng.pick(&present);
                if !self.moves.contains_key(&v) {
                    let q = self.place();
                    self.t.relocate_vertex(v, &q).expect("it is present");
                    self.positions[v] = Some(q);
                }
            }
            _ => {
                self.t.discard_moves();
                self.moves.clear();
                self.leaving.clear();
                while let Some((id, _)) = self.coming.pop_last() {
                    if id.index() + 1 == self.positions.len() {
                        self.positions.pop();
                    }
                }
            }
        }
    }
}

fn histories<G: Dimension>(sizes: &[usize]) {
    for seed in seeds(12) {
        for kind in KINDS {
            for (k, &n) in sizes.iter().enumerate() {
                let mut model = Model::<G>::new(kind, n, seed, 1 + (seed % 3) as u32 * 2);
                for step in 0..6 {
                    model.stage();
                    if model.rng.one_in(3) {
                        model.call();
                    }
                    let algorithm = Algorithm::ALL[(seed as usize + step + k) % Algorithm::ALL.len()];
                    model.commit(algorithm);
                }
            }
        }
    }
}

#[test]
fn edits_in_the_plane_match_fresh_builds() {
    histories::<Plane>(&[0, 3, 12, 80, 600]);
}

#[test]
fn edits_in_space_match_fresh_builds() {
    histories::<Space>(&[0, 4, 15, 60, 300]);
}

#[test]
fn an_insertion_onto_a_vertex_is_rejected_and_stays_staged() {
    let options = Options { coincidence: CoincidencePolicy::Reject, ..Options::default() };
    let square = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [2.0, 2.0]];
    let mut t = MovingTriangulation::<Plane>::new(&square, options).expect("a build");
    assert_eq!(t.stage_insertions(&[[0.5, 0.25], [1.0, 0.0]]), Ok(vertex(4)));
    let before = cell_set(&t);
    assert_eq!(t.commit_timestamp(), Err(Error::Coincident { vertex: vertex(1), other: vertex(5) }));
    assert_eq!((cell_set(&t), t.staged_edits(), t.id_count()), (before, (2, 0), 6));
    // The vertex in the way goes, in the same commit.
    t.stage_removals(&[vertex(1)]).expect("it is present");
    let report = t.commit_timestamp().expect("nothing is in the way");
    assert_eq!((report.inserted, report.removed, t.vertex_count()), (2, 1, 5));
    t.validate(Level::Delaunay).expect("a Delaunay triangulation");
}

#[test]
fn edits_survive_a_compaction() {
    let points: Vec<[f64; 2]> = (0..40).map(|i| [f64::from(i % 7), f64::from(i * i % 11)]).collect();
    let mut t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("a build");
    t.remove_vertex(vertex(3)).expect("it is present");
    assert_eq!(t.stage_insertions(&[[0.5, 0.5], [20.0, 3.5]]), Ok(vertex(40)));
    t.stage_removals(&ids([5, 6])).expect("they are present");
    t.move_vertices(&[vertex(7)], &[[30.0, 30.0]]).expect("it is present");
    let map = t.compact().expect("room");
    assert_eq!([map[3], map[4], map[40], map[41]], [VertexId::NONE, vertex(3), vertex(39), vertex(40)]);
    assert_eq!((t.id_count(), t.staged_edits(), t.staged_count()), (41, (2, 2), 1));
    assert!(!t.is_present(vertex(39)));
    t.commit_timestamp().expect("room");
    assert_eq!((t.position(vertex(39)), t.position(vertex(6))), (Ok([0.5, 0.5]), Ok([30.0, 30.0])));
    assert_eq!((t.is_present(vertex(4)), t.is_present(vertex(5)), t.vertex_count()), (false, false, 39));
    t.validate(Level::Delaunay).expect("a Delaunay triangulation");
}

#[test]
fn ids_of_discarded_insertions_are_given_again() {
    let mut t =
        MovingTriangulation::<Plane>::new(&[[0.0, 0.0], [1.0, 0.0]], Options::default()).expect("a build");
    assert_eq!(t.stage_insertions(&[[3.0, 1.0]; 3]), Ok(vertex(2)));
    assert_eq!((t.id_count(), t.is_present(vertex(2))), (5, false));
    t.discard_moves();
    assert_eq!((t.id_count(), t.stage_insertions(&[[0.0, 1.0]])), (2, Ok(vertex(2))));
    assert_eq!(
        t.stage_removals(&ids([0, 2])),
        Err(Error::StagedVertex {
            argument: "vertices",
            index: 1,
            vertex: vertex(2),
            staged: StagedEdit::Insertion
        })
    );
    assert_eq!(t.staged_edits(), (1, 0));
    t.stage_removals(&[vertex(0)]).expect("it is present");
    let staged = StagedEdit::Removal;
    let again = Error::StagedVertex { argument: "vertices", index: 0, vertex: vertex(0), staged };
    assert_eq!(t.stage_removals(&[vertex(0)]), Err(again.clone()));
    assert_eq!(t.move_vertices(&[vertex(0)], &[[5.0, 5.0]]), Err(again));
    t.commit_timestamp().expect("room");
    assert_eq!((t.vertex_count(), t.is_present(vertex(0)), t.is_present(vertex(2))), (2, false, true));
}

/// Positions by id say where vertices whose insertion is staged will be; those of vertices whose removal is staged are
/// not read. The oracle is a fresh build of what was said last.
#[test]
fn positions_of_all_ids_place_staged_insertions() {
    let start = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.0, 2.0]];
    // Few edits, that are made one by one, and many, for which all is rebuilt.
    for n in [40, 0] {
        let mut points = start.to_vec();
        points.extend((0..n).map(|k| [f64::from(k) * 0.1, 5.0 + f64::from(k * k) * 0.01]));
        let mut t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("a build");
        let first = t.stage_insertions(&[[2.0, 2.0], [3.0, -0.0]]).expect("room");
        t.stage_removals(&[vertex(1)]).expect("it is there");
        assert_eq!([first, vertex(1)].map(|v| t.position_or_goal(v)), [Some([2.0, 2.0]), Some([4.0, 0.0])]);
        let mut all = points.clone();
        all.extend([[7.0, 7.0], [3.0, -0.0]]);
        all[1] = [f64::NAN; 2];
        // All or nothing.
        let mut bad = all.clone();
        bad[first.index() + 1][1] = f64::INFINITY;
        let index = first.index() + 1;
        let error = Error::NotFinite { argument: "positions", index, axis: 1, value: f64::INFINITY };
        for staged in [t.move_all(&bad), t.commit_positions(&bad).map(drop)] {
            assert_eq!(staged, Err(error.clone()));
        }
        assert_eq!((t.staged_count(), t.position_or_goal(first)), (0, Some([2.0, 2.0])));
        let (given, wanted) = (points.len(), all.len());
        let error = Error::WrongCount { argument: "count", given, wanted, coming: 2 };
        assert!(error.to_string().ends_with("with 2 vertices whose insertion is staged"), "{error}");
        assert_eq!(t.commit_positions(&points).map(drop), Err(error));
        let report = t.commit_positions(&all).expect("room");
        assert_eq!((report.moved, report.inserted, report.removed), (0, 2, 1));
        let mut left: Vec<_> = all.into_iter().map(Some).collect();
        left[1] = None;
        assert_eq!(t.position(first), Ok([7.0, 7.0]));
        assert_same_cells(&cell_set(&t), &fresh_cells::<Plane>(&left), || format!("{n} more"));
        // Without a commit in the same call, and then moved again.
        let second = t.stage_insertions(&[[-3.0, 1.0]]).expect("room");
        left.push(Some([-2.0, -1.0]));
        let places: Vec<_> = left.iter().map(|p| p.unwrap_or([f64::NAN; 2])).collect();
        t.move_all(&places).expect("good places");
        assert_eq!(t.position_or_goal(second), Some([-2.0, -1.0]));
        t.commit_timestamp().expect("room");
        assert_same_cells(&cell_set(&t), &fresh_cells::<Plane>(&left), || format!("{n} more, again"));
    }
}

/// A step in one call that is refused leaves staged insertions where they were.
#[test]
fn refused_positions_leave_staged_insertions_in_place() {
    let start = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.0, 2.0]];
    let options = Options { coincidence: CoincidencePolicy::Reject, ..Options::default() };
    let mut t = MovingTriangulation::<Plane>::new(&start, options).expect("a build");
    let first = t.stage_insertions(&[[2.0, 2.0]]).expect("room");
    let mut all = start.to_vec();
    all.push([4.0, 4.0]);
    let error = Error::Coincident { vertex: vertex(2), other: first };
    assert_eq!(t.commit_positions(&all).map(drop), Err(error));
    assert_eq!(
        (t.staged_count(), t.staged_edits(), t.position_or_goal(first)),
        (0, (1, 0), Some([2.0, 2.0]))
    );
    t.commit_timestamp().expect("room");
    assert_eq!(t.position(first), Ok([2.0, 2.0]));
}

/// Moves and removals that are forgotten one by one are forgotten, whatever is asked for in between.
#[test]
fn moves_of_removed_vertices_are_forgotten() {
    let points: Vec<_> = (0..40).map(|k| [f64::from(k), f64::from(k * k % 17)]).collect();
    let mut t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("a build");
    let aims: Vec<_> = points.iter().map(|p| [p[0] + 0.25, p[1]]).collect();
    t.move_all(&aims).expect("good places");
    t.stage_removals(&ids([3, 9, 20])).expect("they are there");
    t.stage_removals(&ids([39])).expect("it is there");
    t.remove_vertex(vertex(9)).expect("it is there");
    t.remove_vertex(vertex(12)).expect("it is there");
    assert_eq!((t.staged_count(), t.staged_edits()), (35, (0, 3)));
    let mut copies = vec![t.try_clone(None).expect("room")];
    let bytes = t.saved().expect("room");
    let saved = Saved::of(&bytes).expect("good data");
    copies.push(MovingTriangulation::load(&saved, Options::default()).expect("good data"));
    copies.push(t);
    for mut t in copies {
        assert_eq!((t.staged_count(), t.staged_edits()), (35, (0, 3)));
        let report = t.commit_timestamp().expect("room");
        assert_eq!((report.moved, report.removed), (35, 3));
        let mut left: Vec<_> = aims.iter().copied().map(Some).collect();
        [3, 9, 12, 20, 39].iter().for_each(|&v| left[v] = None);
        assert_same_cells(&cell_set(&t), &fresh_cells::<Plane>(&left), || "committed".into());
    }
}

/// Ids of discarded insertions are given again, unless others have been given since.
#[test]
fn discarded_insertions_give_back_ids_at_the_end_alone() {
    let mut t = MovingTriangulation::<Plane>::new(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], Options::default())
        .expect("a build");
    assert_eq!(t.stage_insertions(&[[0.2, 0.2], [0.3, 0.2]]), Ok(vertex(3)));
    t.discard_moves();
    assert_eq!(t.id_count(), 3);
    assert_eq!(t.stage_insertions(&[[0.2, 0.2], [0.3, 0.2]]), Ok(vertex(3)));
    assert_eq!(t.insert_vertex(&[0.4, 0.4]), Ok(vertex(5)));
    assert_eq!(t.stage_insertions(&[[0.2, 0.3]]), Ok(vertex(6)));
    t.discard_moves();
    assert_eq!(t.id_count(), 6);
    assert_eq!(t.position(vertex(5)), Ok([0.4, 0.4]));
    assert!(!t.is_present(vertex(3)) && !t.is_present(vertex(4)));
    t.validate(Level::Delaunay).expect("valid");
}

/// A vertex of which a move is staged is not relocated, not even by the short way: within the tolerance kept of it.
#[test]
fn staged_vertices_are_not_relocated_within_their_tolerance() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.1, 1.2], [0.5, 0.4]];
    let options = Options { algorithm: Algorithm::Tolerance, ..Options::default() };
    let mut t = MovingTriangulation::<Plane>::new(&corners, options).expect("a build");
    for step in [1e-9, 2e-9, 3e-9] {
        t.relocate_vertex(vertex(4), &[0.5 + step, 0.4]).expect("a relocation");
    }
    assert!(t.statistics().within_tolerance > 0);
    t.move_vertices(&[vertex(4)], &[[0.6, 0.4]]).expect("room");
    let error = Error::DuplicateMove { argument: "vertex", index: 0, vertex: vertex(4) };
    assert_eq!(t.relocate_vertex(vertex(4), &[0.5 + 4e-9, 0.4]), Err(error));
    assert_eq!(t.position(vertex(4)), Ok([0.5 + 3e-9, 0.4]));
    t.relocate_vertex(vertex(3), &[1.1, 1.2 + 1e-9]).expect("it is not staged");
    t.commit_timestamp().expect("room");
    assert_eq!(t.position(vertex(4)), Ok([0.6, 0.4]));
}
