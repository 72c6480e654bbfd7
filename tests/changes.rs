//! The change list: what is carried along by it alone is what there is, whatever has happened.
//!
//! Random histories of every call there is; between two takes come any number of them, and the cells may have been read
//! or not. `DELDRIFT_SOAK` multiplies the number of seeds.

use crate::common::carried::{Carried, some_present, take};
use crate::common::exact::{Grid, orientation, representatives};
use crate::common::inputs::{KINDS, Kind, draw, draw_one, quantized, to_grid};
use crate::common::{
    Rng, assert_same_cells, cell_set, check_adjacency, fresh_cells, point, seeds, vertex, vertices,
};
use deldrift::Error;
use deldrift::motion::{
    Algorithm, CoincidencePolicy, Commits, Level, Location, Monitor, MovingTriangulation, Options,
};
use deldrift::{CellId, Dimension, Plane, Space, VertexId};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::{AtomicI64, AtomicUsize, Ordering::Relaxed};

/// How often what happened, over all histories of a test.
#[derive(Debug, Default)]
struct Counts {
    commits: usize,
    given: usize,
    cancelled: usize,
    rejected: usize,
    takes: usize,
    created: usize,
    removed: usize,
    renumbered: usize,
    hidden: usize,
    shown: usize,
    flat: usize,
}

struct History<'c, G: Dimension> {
    t: MovingTriangulation<G>,
    kind: Kind,
    positions: Vec<Option<G::Point>>,
    staged: BTreeMap<VertexId, G::Point>,
    /// Staged insertions and removals.
    coming: BTreeMap<VertexId, G::Point>,
    leaving: BTreeSet<VertexId>,
    carried: Carried,
    /// Cells when the latest commit began, if changes are tracked.
    rejects: bool,
    /// One in so many operations is followed by a look at the cells.
    looks: usize,
    patience: Arc<AtomicI64>,
    rng: Rng,
    name: String,
    log: Vec<String>,
    counts: &'c mut Counts,
}

impl<'c, G: Dimension> History<'c, G> {
    fn new(kind: Kind, n: usize, threads: u32, seed: u64, counts: &'c mut Counts) -> Self {
        deldrift::internals::use_all_threads();
        let mut rng = Rng::new(seed);
        let points = draw::<G>(kind, n, &mut rng);
        let positions: Vec<Option<G::Point>> = points.iter().copied().map(Some).collect();
        let is_merged = vertices().zip(representatives(&positions)).any(|(v, r)| r != Some(v));
        let rejects = !is_merged && rng.one_in(3);
        let patience = Arc::new(AtomicI64::new(i64::MAX));
        let left = patience.clone();
        let monitor: Monitor = Box::new(move |_| left.fetch_sub(1, Relaxed) > 0);
        let options = Options {
            threads,
            coincidence: if rejects { CoincidencePolicy::Reject } else { CoincidencePolicy::Merge },
            monitor: Some(monitor),
            ..Options::default()
        };
        let t = MovingTriangulation::new(&points, options).expect("a build");
        History {
            t,
            kind,
            positions,
            staged: BTreeMap::new(),
            coming: BTreeMap::new(),
            leaving: BTreeSet::new(),
            carried: Carried::default(),
            rejects,
            looks: *rng.pick(&[1, 3, 8]),
            patience,
            rng,
            name: format!("{}D, {kind:?}, {n} points, {threads} threads, seed {seed}", G::D),
            log: Vec::new(),
            counts,
        }
    }

    fn context(&self) -> String {
        let from = self.log.len().saturating_sub(10);
        format!("{}, step {}: ... {}", self.name, self.log.len(), self.log[from..].join("; "))
    }

    fn present(&self) -> Vec<VertexId> {
        VertexId::range(0..self.positions.len()).filter(|&v| self.positions[v].is_some()).collect()
    }

    fn at(&self, v: VertexId) -> G::Point {
        self.positions[v].expect("present")
    }

    /// Where a vertex may go: a little off, onto another one, anywhere, or by a lattice step.
    fn destination(&mut self, v: VertexId, how: usize) -> G::Point {
        let p = self.at(v);
        let other = some_present(&self.positions, &mut self.rng).expect("this one");
        let (other, rng) = (self.at(other), &mut self.rng);
        quantized::<G>(match how {
            0..=2 => point::<G>(|k| p[k] + 0.5f64.powi(how as i32 * 3) * (2.0 * rng.unit() - 1.0)),
            3 => point::<G>(|k| p[k] + rng.within(-1, 1) as f64),
            4 => other,
            5 => draw_one::<G>(self.kind, self.positions.len(), rng),
            6 => point::<G>(|k| if k == 0 { -p[0] } else { p[k] }),
            7 => point::<G>(|k| if k + 1 == G::D { 1.0 } else { p[k] }),
            8 => point::<G>(|k| if k == 0 { p[0] } else { (k as f64) * p[0] }),
            _ => point::<G>(|_| 3000.0 * (2.0 * rng.unit() - 1.0)),
        })
    }

    fn stage(&mut self) {
        let how = self.rng.below(10);
        let share = *self.rng.pick(&[1, 1, 1, 2, 10, 40]);
        let mut chosen = self.present();
        chosen
            .retain(|v| !self.staged.contains_key(v) && !self.leaving.contains(v) && self.rng.one_in(share));
        self.log.push(format!("stage {} by {how}", chosen.len()));
        let is_whole = chosen.len() == self.positions.len();
        let places: Vec<G::Point> = chosen.iter().map(|&v| self.destination(v, how)).collect();
        let staged = if is_whole { self.t.move_all(&places) } else { self.t.move_vertices(&chosen, &places) };
        staged.unwrap_or_else(|error| panic!("{}: {error}", self.context()));
        self.staged.extend(chosen.into_iter().zip(places));
    }

    /// Stages insertions and removals: a few, or many.
    fn stage_edits(&mut self) {
        let most = *self.rng.pick(&[1, 1, 3, 30]);
        let places: Vec<G::Point> = (0..self.rng.below(most + 1))
            .map(|_| {
                let some = some_present(&self.positions, &mut self.rng);
                match some {
                    Some(v) if self.rng.one_in(3) => self.destination(v, 4),
                    _ => draw_one::<G>(self.kind, self.positions.len(), &mut self.rng),
                }
            })
            .collect();
        let share = *self.rng.pick(&[2, 10, 40, 40]);
        let mut gone = self.present();
        gone.retain(|v| !self.leaving.contains(v) && self.rng.one_in(share));
        self.log.push(format!("stage insertions of {places:?} and removals of {gone:?}"));
        let first = self.t.stage_insertions(&places).expect("room");
        assert_eq!(first.index(), self.positions.len(), "{}", self.context());
        self.positions.resize(self.positions.len() + places.len(), None);
        self.coming.extend(vertices().skip(first.index()).zip(places));
        self.t.stage_removals(&gone).expect("room");
        self.staged.retain(|v, _| !gone.contains(v));
        self.leaving.extend(gone);
        let staged = (self.coming.len(), self.leaving.len());
        assert_eq!(self.t.staged_edits(), staged, "{}", self.context());
    }

    fn commit(&mut self) {
        let algorithm = *self.rng.pick(&Algorithm::ALL);
        self.t.set_algorithm(algorithm);
        let calls = if self.rng.one_in(6) { self.rng.below(4) as i64 } else { i64::MAX };
        self.log.push(format!("commit {} by {algorithm:?}, {calls} calls", self.staged.len()));
        let given = self.unstage_all();
        let n_staged = if given.is_some() { 0 } else { self.staged.len() };
        let commit = |t: &mut MovingTriangulation<G>| match &given {
            Some(positions) => t.commit_positions(positions),
            None => t.commit_timestamp(),
        };
        self.patience.store(calls, Relaxed);
        let mut committed = commit(&mut self.t);
        self.patience.store(i64::MAX, Relaxed);
        if matches!(committed, Err(Error::Cancelled)) {
            self.counts.cancelled += 1;
            assert_eq!(self.t.staged_count(), n_staged, "{}", self.context());
            self.after_a_failure();
            if self.rng.one_in(3) {
                if let Some(positions) = &given {
                    self.t.move_all(positions).expect("good positions");
                }
                return;
            }
            self.log.push("again".to_string());
            committed = commit(&mut self.t);
        }
        if let Err(error) = &committed {
            self.expect_rejection(error);
            assert_eq!(self.t.staged_count(), n_staged, "{}", self.context());
            self.after_a_failure();
            if let Some(positions) = &given {
                self.t.move_all(positions).expect("good positions");
            }
            self.discard();
            return;
        }
        self.counts.commits += 1;
        for (v, q) in std::mem::take(&mut self.staged).into_iter().chain(std::mem::take(&mut self.coming)) {
            self.positions[v] = Some(q);
        }
        for v in std::mem::take(&mut self.leaving) {
            self.positions[v] = None;
        }
    }

    /// Of moves of all vertices, sometimes: unstages them, and returns what is to be given to the commit.
    fn unstage_all(&mut self) -> Option<Vec<G::Point>> {
        let n_present = self.positions.iter().flatten().count();
        let has_edits = self.coming.len() + self.leaving.len() > 0;
        if n_present == 0 || self.staged.len() < n_present || has_edits || self.rng.one_in(2) {
            return None;
        }
        self.log.push("given".to_string());
        assert_eq!(self.t.discard_moves(), n_present, "{}", self.context());
        self.counts.given += 1;
        let positions = VertexId::range(0..self.positions.len());
        Some(positions.map(|v| self.staged.get(&v).copied().unwrap_or_default()).collect())
    }

    fn after_a_failure(&mut self) {
        if self.rng.one_in(2) {
            self.look();
        }
        if self.rng.one_in(3) {
            self.take();
        }
    }

    fn expect_rejection(&mut self, error: &Error) {
        let is_rejection = self.rejects && matches!(error, Error::Coincident { .. });
        assert!(is_rejection, "{}: {error}", self.context());
        self.counts.rejected += 1;
    }

    fn discard(&mut self) {
        self.log.push("discard".to_string());
        assert_eq!(self.t.discard_moves(), self.staged.len(), "{}", self.context());
        self.staged.clear();
        self.leaving.clear();
        while let Some((id, _)) = self.coming.pop_last() {
            if id.index() + 1 == self.positions.len() {
                self.positions.pop();
            }
        }
        assert_eq!(self.t.id_count(), self.positions.len(), "{}", self.context());
    }

    fn insert(&mut self) {
        let some = some_present(&self.positions, &mut self.rng);
        let q = match some {
            Some(v) if self.rng.one_in(2) => self.destination(v, 4),
            _ => draw_one::<G>(self.kind, self.positions.len(), &mut self.rng),
        };
        self.log.push(format!("insert {q:?}"));
        match self.t.insert_vertex(&q) {
            Ok(_) => self.positions.push(Some(q)),
            Err(error) => self.expect_rejection(&error),
        }
    }

    fn remove(&mut self) {
        let Some(v) = some_present(&self.positions, &mut self.rng) else { return };
        if self.leaving.contains(&v) && self.t.remove_vertex(v).is_err() {
            return;
        }
        if self.leaving.remove(&v) {
            self.positions[v] = None;
            return;
        }
        self.log.push(format!("remove {v}"));
        self.t.remove_vertex(v).expect("a removal");
        self.positions[v] = None;
        self.staged.remove(&v);
        self.leaving.remove(&v);
    }

    fn relocate(&mut self) {
        let Some(v) = some_present(&self.positions, &mut self.rng) else { return };
        if self.staged.contains_key(&v) || self.leaving.contains(&v) {
            return;
        }
        let how = self.rng.below(10);
        let q = self.destination(v, how);
        self.log.push(format!("relocate {v} to {q:?}"));
        match self.t.relocate_vertex(v, &q) {
            Ok(()) => self.positions[v] = Some(q),
            Err(error) => self.expect_rejection(&error),
        }
    }

    fn take(&mut self) {
        self.log.push("take".to_string());
        let mut carried = std::mem::take(&mut self.carried);
        let name = format!("{}, step {}", self.name, self.log.len());
        let from = self.log.len().saturating_sub(10);
        let log = self.log[from..].join("; ");
        let list = carried.take(&mut self.t, &|| format!("{name}: ... {log}"));
        self.carried = carried;
        let counts = &mut *self.counts;
        counts.takes += 1;
        counts.created += list.created.len();
        counts.removed += list.removed.len();
        counts.renumbered += list.renumbered.len();
        counts.hidden += list.hidden.len();
        counts.shown += list.shown.len();
        counts.flat += usize::from(self.t.cell_count() == 0);
    }

    /// Reads the cells, and compares all that is said of them with a fresh build.
    fn look(&mut self) {
        self.log.push("look".to_string());
        if self.rng.one_in(2) {
            self.check_star();
        }
        for (v, p) in vertices().zip(&self.positions) {
            assert_eq!(self.t.position(v).ok(), *p, "{}: vertex {v}", self.context());
        }
        let cells = cell_set(&self.t);
        assert_same_cells(&cells, &fresh_cells::<G>(&self.positions), || self.context());
        check_adjacency(&self.t, &|| self.context());
        self.check_orientations();
        self.check_star();
    }

    fn check_orientations(&self) {
        for row in self.t.cells().expect("room").corners {
            let grid: Vec<Grid> = row.as_ref().iter().map(|&v| to_grid::<G>(&self.at(v))).collect();
            let is_positive = orientation(&grid.iter().collect::<Vec<_>>()) > 0;
            assert!(is_positive, "{}: cell {row:?} is inverted", self.context());
        }
    }

    fn check_star(&mut self) {
        let Some(v) = some_present(&self.positions, &mut self.rng) else { return };
        let representative = self.t.coincident_representative(v).expect("present");
        let mut star = Vec::new();
        self.t.star(v, &mut star).expect("room");
        star.sort_unstable();
        let corners = self.t.cells().expect("room").corners;
        let has = |c: &CellId| corners[*c].as_ref().contains(&representative);
        assert!(CellId::range(0..corners.len()).filter(has).eq(star), "{}: star of {v}", self.context());
        if let Location::Vertex(found) = self.t.locate(&self.at(v)).expect("room") {
            assert_eq!(found, representative, "{}", self.context());
        } else {
            panic!("{}: {v} is not found", self.context());
        }
    }

    fn step(&mut self) {
        match self.rng.below(12) {
            n @ 0..6 => {
                if n < 2 {
                    self.stage_edits();
                }
                self.stage();
                if n == 2 {
                    self.stage_edits();
                }
                self.commit();
            }
            6 => self.stage(),
            7 => self.discard(),
            8 => self.insert(),
            9 => self.remove(),
            _ => self.relocate(),
        }
        if self.rng.one_in(self.looks) {
            self.look();
        } else {
            self.t.validate(Level::Structure).unwrap_or_else(|error| panic!("{}: {error}", self.context()));
        }
        if self.rng.one_in(3) {
            self.take();
        }
    }
}

fn follow<G: Dimension>(
    n_seeds: u64,
    steps: usize,
    threads: impl Fn(u64) -> u32,
    n: impl Fn(&mut Rng) -> usize,
) {
    let mut counts = Counts::default();
    for kind in KINDS {
        for seed in seeds(n_seeds) {
            let n = n(&mut Rng::new(seed ^ 0x77));
            let mut history = History::<G>::new(kind, n, threads(seed), seed, &mut counts);
            for _ in 0..steps {
                history.step();
            }
            history.look();
            history.take();
        }
    }
    println!("{counts:?}");
    let rare = [counts.given, counts.cancelled, counts.renumbered, counts.hidden, counts.shown, counts.flat];
    assert!(rare.iter().all(|&n| 100 * n > counts.commits), "{counts:?}");
}

#[test]
fn small_histories_in_the_plane() {
    follow::<Plane>(20, 25, |_| 0, |rng| rng.below(61));
}

#[test]
fn small_histories_in_space() {
    follow::<Space>(14, 25, |_| 0, |rng| rng.below(51));
}

#[test]
fn histories_on_threads_in_the_plane() {
    follow::<Plane>(3, 8, |seed| 1 + seed as u32 % 7, |rng| 300 + rng.below(500));
}

#[test]
fn histories_on_threads_in_space() {
    follow::<Space>(2, 6, |seed| 2 + seed as u32 % 6, |rng| 300 + rng.below(300));
}

/// Points anywhere in the unit cube.
fn cloud<G: Dimension>(n: usize, seed: u64) -> Vec<G::Point> {
    let rng = &mut Rng::new(seed);
    (0..n).map(|_| point::<G>(|_| rng.unit())).collect()
}

fn built<G: Dimension>(points: &[G::Point], options: Options) -> MovingTriangulation<G> {
    MovingTriangulation::new(points, options).expect("a build")
}

const NO_CONTEXT: &dyn Fn() -> String = &String::new;

fn first_take_lists_all<G: Dimension>() {
    let mut points = cloud::<G>(80, 1);
    points[7] = points[3];
    let mut t = built::<G>(&points, Options::default());
    let list = take(&mut t).expect("room");
    let all = CellId::range(0..t.cell_count());
    assert!(list.created.iter().copied().eq(all) && list.removed.is_empty() && list.renumbered.is_empty());
    assert_eq!((list.hidden, list.shown), (vec![vertex(7)], vec![]));
    let all: Vec<VertexId> = VertexId::range(0..80).filter(|&v| v != vertex(7)).collect();
    assert_eq!(list.stars, all);
    assert!(take(&mut t).expect("room").is_empty());

    // Nothing at all.
    let mut t = built::<G>(&[], Options::default());
    assert!(take(&mut t).expect("room").is_empty() && take(&mut t).expect("room").is_empty());
}

#[test]
fn the_first_take_lists_all_and_the_second_nothing() {
    first_take_lists_all::<Plane>();
    first_take_lists_all::<Space>();
}

fn insertion_before_the_first_take<G: Dimension>() {
    let corners = (0..=G::D).map(|i| point::<G>(|k| if k + 1 == i { 8.0 } else { 0.0 }));
    let mut t = built::<G>(&corners.collect::<Vec<_>>(), Options::default());
    assert_eq!(t.cells().expect("room").corners.len(), 1);
    t.insert_vertex(&point::<G>(|_| 1.0)).expect("room");
    t.move_vertices(&[VertexId::new(G::D as u32 + 1)], &[point::<G>(|_| 1.25)]).expect("room");
    t.commit_timestamp().expect("room");
    let list = Carried::default().take(&mut t, NO_CONTEXT);
    assert_eq!((list.created.len(), list.removed.len()), (G::D + 1, 0));
}

#[test]
fn insertions_before_the_first_take_count() {
    insertion_before_the_first_take::<Plane>();
    insertion_before_the_first_take::<Space>();
}

/// Commits that change no cell leave the very arrays that were read before.
fn still_commits_keep_the_view<G: Dimension>(algorithm: Algorithm) {
    let points = cloud::<G>(400, 2);
    let mut t = built::<G>(&points, Options { algorithm, ..Options::default() });
    take(&mut t).expect("room");
    for step in 1..6 {
        let view = t.cells().expect("room");
        let before = (view.corners.as_ptr(), view.neighbours.as_ptr(), view.corners.to_vec());
        // So little that nothing changes.
        let places: Vec<G::Point> =
            points.iter().map(|p| point::<G>(|k| p[k] + f64::from(step) * 1e-14)).collect();
        t.move_all(&places).expect("room");
        let report = t.commit_timestamp().expect("room");
        assert!(report.moved > 300 && report.flips + report.placements == 0, "{report:?}");
        let view = t.cells().expect("room");
        assert_eq!((view.corners.as_ptr(), view.neighbours.as_ptr()), (before.0, before.1), "{algorithm:?}");
        assert_eq!(view.corners, before.2, "{algorithm:?}");
        assert!(take(&mut t).expect("room").is_empty(), "{algorithm:?}");
    }
}

#[test]
fn commits_that_change_no_cell_keep_the_view() {
    for algorithm in Algorithm::ALL {
        still_commits_keep_the_view::<Plane>(algorithm);
        still_commits_keep_the_view::<Space>(algorithm);
    }
}

/// Whether two orders of the same corners have the same orientation.
fn is_even(a: &[VertexId], b: &[VertexId]) -> bool {
    let place = |x: &VertexId| b.iter().position(|y| x == y).expect("the same corners");
    let places: Vec<usize> = a.iter().map(place).collect();
    let later = |i: usize| places[i + 1..].iter().filter(|&&x| x < places[i]).count();
    (0..a.len()).map(later).sum::<usize>().is_multiple_of(2)
}

/// What survives keeps its row: index, order of corners, and neighbours but for those that have gone.
fn rows_are_kept<G: Dimension>(algorithm: Algorithm, step: f64) {
    let points = cloud::<G>(500, 3);
    let mut t = built::<G>(&points, Options { algorithm, ..Options::default() });
    let mut carried = Carried::default();
    let mut before: Vec<Vec<VertexId>> = Vec::new();
    let mut n_kept = 0;
    for k in 0..6 {
        let rng = &mut Rng::new(40 + k);
        let places: Vec<G::Point> =
            points.iter().map(|p| point::<G>(|k| p[k] + step * (rng.unit() - 0.5))).collect();
        t.move_all(&places).expect("room");
        t.commit_timestamp().expect("room");
        let rows: Vec<Vec<VertexId>> =
            t.cells().expect("room").corners.iter().map(|row| row.as_ref().to_vec()).collect();
        let list = carried.take(&mut t, NO_CONTEXT);
        let moved: BTreeMap<CellId, CellId> = list.renumbered.iter().copied().collect();
        if k > 0 {
            for (index, row) in
                (0..).map(CellId::new).zip(&before).filter(|(index, _)| !list.removed.contains(index))
            {
                let now = moved.get(&index).copied().unwrap_or(index);
                let is_turned = !is_even(row, &rows[now]);
                assert!(is_turned || &rows[now] == row, "{algorithm:?}: cell {index}");
                n_kept += usize::from(!is_turned);
            }
        }
        before = rows;
    }
    assert!(n_kept > 5 * before.len() / 4, "{algorithm:?}: {n_kept}");
}

#[test]
fn cells_that_survive_keep_their_rows() {
    for algorithm in Algorithm::ALL {
        rows_are_kept::<Plane>(algorithm, 0.01);
        rows_are_kept::<Space>(algorithm, 0.01);
    }
}

/// A cell that was destroyed and made again between two takes is not listed, in whatever slot it is now.
fn there_and_back<G: Dimension>(algorithm: Algorithm, reads: bool) {
    let points = cloud::<G>(300, 4);
    let mut t = built::<G>(&points, Options { algorithm, ..Options::default() });
    take(&mut t).expect("room");
    for far in [0.05, 3.0] {
        let rng = &mut Rng::new(5);
        let away: Vec<G::Point> =
            points.iter().map(|p| point::<G>(|k| p[k] + far * (rng.unit() - 0.5))).collect();
        for places in [&away, &points] {
            t.move_all(places).expect("room");
            t.commit_timestamp().expect("room");
            if reads {
                t.cells().expect("room");
            }
        }
        let list = take(&mut t).expect("room");
        assert!(list.created.is_empty() && list.removed.is_empty() && list.stars.is_empty(), "{algorithm:?}");
        // Without a look in between nobody has been given another index.
        assert!(reads || list.renumbered.is_empty(), "{algorithm:?}: {:?}", list.renumbered);
    }
    let added = t.insert_vertex(&point::<G>(|_| 0.5)).expect("room");
    if reads {
        t.cells().expect("room");
    }
    t.remove_vertex(added).expect("room");
    let list = take(&mut t).expect("room");
    assert!(list.created.is_empty() && list.removed.is_empty(), "{algorithm:?}: {list:?}");
}

#[test]
fn cells_that_come_back_are_not_listed() {
    for algorithm in Algorithm::ALL {
        for reads in [false, true] {
            there_and_back::<Plane>(algorithm, reads);
            there_and_back::<Space>(algorithm, reads);
        }
    }
}

/// Rebuilding makes all cells again, in new slots; only what differs is listed.
fn rebuilding_keeps_what_stays<G: Dimension>() {
    let mut points = cloud::<G>(3000, 6);
    let options = Options { algorithm: Algorithm::Rebuilding, ..Options::default() };
    let mut t = built::<G>(&points, options);
    let mut carried = Carried::default();
    carried.take(&mut t, NO_CONTEXT);
    t.move_all(&points).expect("room");
    assert_eq!(t.commit_timestamp().expect("room").rebuilds, 1);
    assert!(carried.take(&mut t, NO_CONTEXT).is_empty());

    // Some leap far, so that storage is sorted again, and the cells of the others keep their indices.
    let rng = &mut Rng::new(7);
    for p in points.iter_mut().filter(|p| p[0] > 0.7) {
        *p = point::<G>(|_| 0.7 + 0.3 * rng.unit());
    }
    t.move_all(&points).expect("room");
    t.commit_timestamp().expect("room");
    let n = carried.cells.len();
    let list = carried.take(&mut t, NO_CONTEXT);
    assert!(!list.removed.is_empty() && list.removed.len() < n / 2, "{} of {n}", list.removed.len());
    assert!(list.renumbered.len() <= list.removed.len());
}

#[test]
fn rebuilding_lists_only_what_differs() {
    rebuilding_keeps_what_stays::<Plane>();
    rebuilding_keeps_what_stays::<Space>();
}

/// Insertions that are staged when an immediate call builds all cells are no part of what it changes, nor of what
/// follows when they are discarded.
fn discarded_insertions_are_not_listed<G: Dimension>() {
    let mut points: Vec<G::Point> = (0..9).map(|i| point::<G>(|k| [i as f64, 0.0, 0.0][k])).collect();
    if G::D == 3 {
        points[7][1] = 5.0;
    }
    points.push(points[4]);
    let mut t = built::<G>(&points, Options::default());
    assert_eq!(t.cell_count(), 0);
    take(&mut t).expect("room");
    t.stage_insertions(&cloud::<G>(4, 5)).expect("room");
    t.relocate_vertex(vertex(0), &point::<G>(|k| [2.0, 7.0, 1.0][k])).expect("room");
    assert!(t.cell_count() > 0);
    t.discard_moves();
    let ids = t.compact().expect("room");
    assert_eq!(ids, VertexId::range(0..points.len()).collect::<Vec<_>>());
    let list = take(&mut t).expect("room");
    assert_eq!((list.hidden, list.shown), (vec![], vec![]));
}

#[test]
fn insertions_discarded_after_all_cells_are_built_are_not_listed() {
    discarded_insertions_are_not_listed::<Plane>();
    discarded_insertions_are_not_listed::<Space>();
}

/// The first repair of many cells sorts them; nobody hears of that, and a commit that is cancelled then leaves all as
/// it was.
fn sorting_keeps_indices<G: Dimension>(n: usize, algorithm: Algorithm, threads: u32, cancelled_at: usize) {
    deldrift::internals::use_all_threads();
    let mut points = cloud::<G>(n, 8);
    let calls = Arc::new(AtomicUsize::new(usize::MAX));
    let left = calls.clone();
    let monitor: Monitor = Box::new(move |_| left.fetch_sub(1, Relaxed) != 0);
    let options = Options { algorithm, threads, monitor: Some(monitor), ..Options::default() };
    let mut t = built::<G>(&points, options);
    // Cells are in another order than their sites, with holes between.
    for v in VertexId::range(0..50) {
        points[v] = point::<G>(|k| (1 + v.index() * (k + 1)) as f64 / 170.0 % 1.0);
        t.relocate_vertex(v, &points[v]).expect("room");
    }
    let mut carried = Carried::default();
    carried.take(&mut t, NO_CONTEXT);
    let ids: Vec<VertexId> = VertexId::range(0..n).collect();
    let size = 0.02 / (n as f64).powf(1.0 / G::D as f64);
    for round in 0..3 {
        let rng = &mut Rng::new(90 + round);
        for p in &mut points {
            *p = point::<G>(|k| p[k] + size * (rng.unit() - 0.5));
        }
        t.move_vertices(&ids, &points).expect("room");
        calls.store(cancelled_at, Relaxed);
        let first = t.commit_timestamp();
        calls.store(usize::MAX, Relaxed);
        assert!(cancelled_at > 0 || first.is_err(), "{algorithm:?}: {first:?}");
        if let Err(error) = first {
            assert_eq!(error, Error::Cancelled);
            t.validate(Level::Delaunay).expect("a triangulation");
            assert!(carried.take(&mut t, NO_CONTEXT).is_empty(), "a cancelled commit has changes");
            t.commit_timestamp().expect("room");
        }
        t.validate(Level::Delaunay).expect("a triangulation");
        let list = carried.take(&mut t, NO_CONTEXT);
        assert!(!list.created.is_empty() && list.created.len() < t.cell_count() / 2);
    }
}

#[test]
fn sorting_the_cells_keeps_indices() {
    for algorithm in Algorithm::ALL.into_iter().filter(|a| a.row().commits == Commits::Together) {
        for cancelled_at in [usize::MAX, 0] {
            for threads in [1, 4] {
                sorting_keeps_indices::<Plane>(17_000, algorithm, threads, cancelled_at);
                sorting_keeps_indices::<Space>(5_500, algorithm, threads, cancelled_at);
            }
        }
    }
}
