//! Compaction: the cells stay those of a fresh build, under new ids, and nothing is left of removed vertices.
#![allow(unsafe_code)] // An allocator that runs out has no other way to be one.

mod common;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::collections::BTreeSet;

use common::{
    Rng, assert_same_cells, cell_set, check_adjacency, fresh_cells, point, seeds, sorted, vertex, vertices,
};
use deldrift::Error;
use deldrift::motion::{Algorithm, CommitReport, Level, MovingTriangulation, NO_VERTEX, Options};
use deldrift::{Dimension, Plane, Space, VertexId};

thread_local! {
    /// Bytes that this thread may still have.
    static LEFT: Cell<isize> = const { Cell::new(isize::MAX) };
    /// What it asked for when it got nothing.
    static MISSING: Cell<isize> = const { Cell::new(0) };
}

struct Limited;

#[global_allocator]
static ALLOCATOR: Limited = Limited;

/// Takes so many bytes from what is left; whether there were as many.
fn take(bytes: isize) -> bool {
    let left = LEFT.get();
    if left == isize::MAX {
        return true;
    }
    if bytes > left {
        MISSING.set(bytes - left);
        return false;
    }
    LEFT.set(left - bytes);
    true
}

// SAFETY: all is handed on to the system's allocator, or there is no memory.
unsafe impl GlobalAlloc for Limited {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promise.
        if take(layout.size() as isize) { unsafe { System.alloc(layout) } } else { std::ptr::null_mut() }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        take(-(layout.size() as isize));
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(pointer, layout) }
    }
}

/// A triangulation, what it should be, and what a reader of its changes knows.
struct History<G: Dimension> {
    rng: Rng,
    t: MovingTriangulation<G>,
    /// By id; `None` once removed.
    positions: Vec<Option<G::Point>>,
    staged: Vec<(VertexId, G::Point)>,
    /// The cells by index, as of the changes taken last, if any ever were; removed vertices are [`NO_VERTEX`].
    mirror: Option<Vec<Vec<VertexId>>>,
    /// Which of its vertices the reader has been told are hidden.
    hidden: Vec<VertexId>,
    /// Coordinates are multiples of this, or anything if it is 0.
    grid: f64,
    is_flat: bool,
}

impl<G: Dimension> History<G> {
    fn new(seed: u64) -> Self {
        let mut rng = Rng::new(seed);
        let options = Options { algorithm: *rng.pick(&Algorithm::ALL), threads: 1, ..Options::default() };
        let grid = if rng.one_in(3) { 1.0 } else { 0.0 };
        let is_flat = rng.one_in(6);
        let t = MovingTriangulation::new(&[], options).expect("room");
        let mut history = History {
            rng,
            t,
            positions: vec![],
            staged: vec![],
            mirror: None,
            hidden: vec![],
            grid,
            is_flat,
        };
        for _ in 0..history.rng.below(80) {
            history.insert();
        }
        history
    }

    fn place(&mut self) -> G::Point {
        let (grid, is_flat) = (self.grid, self.is_flat);
        let present = self.present();
        if !present.is_empty() && self.rng.one_in(8) {
            let other = *self.rng.pick(&present);
            return self.positions[other].expect("present");
        }
        let rng = &mut self.rng;
        point::<G>(|k| match k {
            0 if is_flat => 0.0,
            _ if grid > 0.0 => grid * rng.below(6) as f64,
            _ => 6.0 * rng.unit(),
        })
    }

    fn present(&self) -> Vec<VertexId> {
        VertexId::range(0..self.positions.len()).filter(|&v| self.positions[v].is_some()).collect()
    }

    fn insert(&mut self) {
        let p = self.place();
        let v = self.t.insert_vertex(&p).expect("room");
        assert_eq!(v.index(), self.positions.len());
        self.positions.push(Some(p));
    }

    fn remove(&mut self) {
        let present = self.present();
        if present.is_empty() {
            return;
        }
        let v = *self.rng.pick(&present);
        self.t.remove_vertex(v).expect("it is present");
        self.positions[v] = None;
        self.staged.retain(|&(staged, _)| staged != v);
    }

    fn stage(&mut self) {
        let share = 1 + self.rng.below(3);
        for v in self.present() {
            if self.staged.iter().any(|&(staged, _)| staged == v) || !self.rng.one_in(share) {
                continue;
            }
            let p = if self.rng.one_in(10) {
                self.place()
            } else {
                let (p, rng) = (self.positions[v].expect("present"), &mut self.rng);
                point::<G>(|k| if k == 0 && self.is_flat { p[k] } else { p[k] + 1e-3 * rng.unit() })
            };
            self.t.move_vertices(&[v], &[p]).expect("a move");
            self.staged.push((v, p));
        }
    }

    fn commit(&mut self) -> CommitReport {
        let report = self.t.commit_timestamp().expect("room");
        for (v, p) in self.staged.drain(..) {
            self.positions[v] = Some(p);
        }
        report
    }

    /// Brings the mirror up to date, and compares it with the cells.
    fn take_changes(&mut self) {
        let changes = self.t.take_changes().expect("room");
        let old = self.mirror.take().unwrap_or_default();
        let mut old: Vec<Option<Vec<VertexId>>> = old.into_iter().map(Some).collect();
        let mut stars = BTreeSet::new();
        for (&index, corners) in changes.removed.iter().zip(changes.removed_corners) {
            let row = old[index].take().expect("it is removed once");
            assert_eq!(row, sorted(corners.as_ref()), "the removed cell {index}");
            stars.extend(row);
        }
        let from = changes.renumbered_from.iter().map(|&from| old[from].take().expect("it was there"));
        let renumbered: Vec<_> = from.zip(changes.renumbered_to.iter().copied()).collect();
        let created = changes.created.to_vec();
        for v in changes.hidden {
            assert!(!self.hidden.contains(v), "{v} was hidden");
        }
        assert!(changes.shown.iter().all(|v| self.hidden.contains(v)));
        self.hidden.retain(|v| !changes.shown.contains(v));
        self.hidden.extend(changes.hidden);
        let listed = changes.stars.to_vec();

        let rows = self.t.cells().expect("room").corners;
        let mut mirror: Vec<Option<Vec<VertexId>>> = old;
        mirror.resize(rows.len().max(mirror.len()), None);
        for (row, to) in renumbered {
            assert!(mirror[to].replace(row).is_none());
        }
        for index in created {
            let row = sorted(rows[index].as_ref());
            stars.extend(row.iter().copied());
            assert!(mirror[index].replace(row).is_none());
        }
        let mirror: Vec<Vec<VertexId>> = mirror.into_iter().flatten().collect();
        assert_eq!(mirror, rows.iter().map(|row| sorted(row.as_ref())).collect::<Vec<_>>());
        stars.remove(&NO_VERTEX);
        assert_eq!(listed, stars.into_iter().collect::<Vec<_>>());
        self.mirror = Some(mirror);
        let is_hidden = |v: &VertexId| self.t.coincident_representative(*v).is_ok_and(|r| r != *v);
        self.hidden.retain(|v| self.t.is_present(*v));
        self.hidden.sort_unstable();
        assert_eq!(self.hidden, self.present().into_iter().filter(is_hidden).collect::<Vec<_>>());
    }

    /// Compacts, and compares all that can be asked with what it was before.
    fn compact(&mut self) {
        // Without readers there are no arrays of cells to keep.
        let before = (self.rng.one_in(3) || self.mirror.is_some()).then(|| {
            let view = self.t.cells().expect("room");
            (view.corners.to_vec(), view.neighbours.to_vec())
        });
        let representative: Vec<_> = VertexId::range(0..self.positions.len())
            .map(|v| self.t.coincident_representative(v).ok())
            .collect();
        let map = self.t.compact().expect("room");

        let mut next = vertices();
        let expected: Vec<VertexId> = self
            .positions
            .iter()
            .map(|p| if p.is_some() { next.next().expect("endless") } else { NO_VERTEX })
            .collect();
        assert_eq!(map, expected);
        let named = |v: VertexId| map.get(v.index()).copied().unwrap_or(NO_VERTEX);
        for (v, r) in representative.into_iter().enumerate().filter_map(|(v, r)| Some((v, r?))) {
            assert_eq!(self.t.coincident_representative(map[v]), Ok(named(r)));
        }
        if let Some((corners, neighbours)) = before {
            let view = self.t.cells().expect("room");
            let named = |row: &G::Vertices| row.as_ref().iter().map(|&v| named(v)).collect::<Vec<_>>();
            assert!(corners.iter().map(named).eq(view.corners.iter().map(|row| row.as_ref().to_vec())));
            assert_eq!(neighbours, view.neighbours);
        }
        self.positions.retain(Option::is_some);
        self.staged.iter_mut().for_each(|(v, _)| *v = named(*v));
        for row in self.mirror.iter_mut().flatten() {
            *row = sorted(&row.iter().map(|&v| named(v)).collect::<Vec<_>>());
        }
        self.hidden = self.hidden.iter().map(|&v| named(v)).filter(|&v| v != NO_VERTEX).collect();
    }

    fn check(&self, context: &dyn Fn() -> String) {
        self.t.validate(Level::Delaunay).unwrap_or_else(|v| panic!("{}: {v}", context()));
        assert_eq!((self.t.id_count(), self.t.staged_count()), (self.positions.len(), self.staged.len()));
        assert_eq!(self.t.vertex_count(), self.present().len());
        for v in self.present() {
            assert_eq!(self.t.position(v).ok(), self.positions[v], "{}", context());
        }
        check_adjacency(&self.t, context);
        assert_same_cells(&cell_set(&self.t), &fresh_cells::<G>(&self.positions), context);
    }
}

fn histories<G: Dimension>() {
    let mut n_hidden = 0;
    for seed in seeds(150) {
        let mut history = History::<G>::new(seed);
        for step in 0..25 {
            let context = || format!("{}D, seed {seed}, step {step}", G::D);
            match history.rng.below(10) {
                0..=1 => (0..8).for_each(|_| history.insert()),
                2..=3 => (0..8).for_each(|_| history.remove()),
                4 => history.t.set_algorithm(Algorithm::ALL[step % Algorithm::ALL.len()]),
                5 => history.take_changes(),
                6 => history.stage(),
                7 => {
                    history.stage();
                    history.commit();
                }
                _ => {
                    history.compact();
                    history.check(&context);
                    let present = history.present();
                    n_hidden +=
                        present.iter().filter(|&&v| history.t.coincident_representative(v) != Ok(v)).count();
                    // What was staged before is committed now, and then all vertices move.
                    if history.rng.one_in(2) {
                        history.commit();
                        history.check(&context);
                        history.stage();
                        history.commit();
                    }
                }
            }
            history.check(&context);
        }
        if history.mirror.is_some() {
            history.take_changes();
        }
    }
    assert!(n_hidden > 500, "{n_hidden} hidden vertices");
}

#[test]
fn compacted_triangulations_in_the_plane_go_on_as_before() {
    histories::<Plane>();
}

#[test]
fn compacted_triangulations_in_space_go_on_as_before() {
    histories::<Space>();
}

/// Random places in a cube.
fn places<G: Dimension>(n: usize, rng: &mut Rng) -> Vec<G::Point> {
    (0..n).map(|_| point::<G>(|_| rng.unit())).collect()
}

/// A triangulation of `n` vertices, of which each has been replaced `times` over; also where they are, by id.
fn worn<G: Dimension>(n: usize, times: usize, options: Options) -> MovingTriangulation<G> {
    let rng = &mut Rng::new(7);
    let mut t = MovingTriangulation::new(&places::<G>(n, rng), options).expect("room");
    let mut present: Vec<VertexId> = VertexId::range(0..n).collect();
    t.take_changes().expect("room");
    for _ in 0..n * times {
        let v = rng.below(n);
        t.remove_vertex(present[v]).expect("it is present");
        present[v] = t.insert_vertex(&point::<G>(|_| rng.unit())).expect("room");
    }
    t
}

/// Reads all there is, and moves all vertices a little, twice; returns the bytes held then.
fn used<G: Dimension>(t: &mut MovingTriangulation<G>) -> usize {
    let rng = &mut Rng::new(8);
    for _ in 0..2 {
        t.cells().expect("room");
        t.take_changes().expect("room");
        let places: Vec<_> = VertexId::range(0..t.id_count())
            .map(|v| t.position(v).map(|p| point::<G>(|k| p[k] + 1e-4 * rng.unit())).unwrap_or_default())
            .collect();
        t.move_all(&places).expect("places in range");
        t.commit_timestamp().expect("room");
    }
    t.cells().expect("room");
    t.take_changes().expect("room");
    t.memory_bytes()
}

fn memory_is_that_of_a_fresh_one<G: Dimension>() {
    for algorithm in Algorithm::ALL {
        let options = || Options { algorithm, ..Options::default() };
        let mut t = worn::<G>(500, 40, options());
        let before = used(&mut t);
        let map = t.compact().expect("room");
        assert_eq!((map.len(), t.id_count()), (500 * 41, 500));
        let at_once = t.memory_bytes();
        let places: Vec<_> = VertexId::range(0..500).map(|v| t.position(v).expect("dense ids")).collect();
        let mut fresh = MovingTriangulation::<G>::new(&places, options()).expect("room");
        let (compacted, fresh) = (used(&mut t), used(&mut fresh));
        let context =
            || format!("{}D, {algorithm:?}: {before}, {at_once}, {compacted} and not {fresh} bytes", G::D);
        assert!(at_once < compacted && 10 * compacted < 13 * fresh && fresh < before, "{}", context());
    }
}

#[test]
fn a_compacted_triangulation_needs_no_more_memory_than_a_fresh_one() {
    memory_is_that_of_a_fresh_one::<Plane>();
    memory_is_that_of_a_fresh_one::<Space>();
}

/// A commit of all vertices says the same as that of a fresh triangulation with the same positions.
#[test]
fn commits_after_a_compaction_are_those_of_a_fresh_triangulation() {
    for algorithm in Algorithm::ALL {
        let options = || Options { algorithm, ..Options::default() };
        let mut t = worn::<Plane>(300, 3, options());
        t.compact().expect("room");
        let places: Vec<_> = VertexId::range(0..300).map(|v| t.position(v).expect("dense ids")).collect();
        let mut fresh = MovingTriangulation::<Plane>::new(&places, options()).expect("room");
        let rng = &mut Rng::new(9);
        let moved: Vec<_> = places.iter().map(|p| point::<Plane>(|k| p[k] + 1e-4 * rng.unit())).collect();
        let reports = [&mut t, &mut fresh].map(|t| {
            t.move_all(&moved).expect("places in range");
            // The order of cells decides what is looked at in vain.
            CommitReport { certificates: 0, exact_calls: 0, ..t.commit_timestamp().expect("room") }
        });
        assert_eq!(reports[0], reports[1], "{algorithm:?}");
        assert_eq!(cell_set(&t), cell_set(&fresh));
    }
}

/// A staging of all vertices without a list stays one.
#[test]
fn moves_of_all_vertices_stay_staged() {
    let rng = &mut Rng::new(3);
    let mut t =
        MovingTriangulation::<Space>::new(&places::<Space>(60, rng), Options::default()).expect("room");
    let moved = places::<Space>(60, rng);
    t.move_all(&moved).expect("places in range");
    assert_eq!(t.compact().expect("room"), VertexId::range(0..60).collect::<Vec<_>>());
    assert_eq!(t.staged_count(), 60);
    t.insert_vertex(&[0.5; 3]).expect("room");
    t.remove_vertex(vertex(0)).expect("it is present");
    assert_eq!((t.compact().expect("room")[60], t.staged_count()), (vertex(59), 59));
    t.commit_timestamp().expect("room");
    assert_eq!(t.position(vertex(0)), Ok(moved[1]));
    t.validate(Level::Delaunay).expect("valid");
}

#[test]
fn nothing_can_be_compacted() {
    let mut t = MovingTriangulation::<Plane>::new(&[], Options::default()).expect("room");
    assert_eq!(t.compact(), Ok(vec![]));
    t.insert_vertex(&[1.0, 2.0]).expect("room");
    t.remove_vertex(vertex(0)).expect("it is present");
    assert_eq!(t.compact(), Ok(vec![NO_VERTEX]));
    assert_eq!(t.insert_vertex(&[1.0, 2.0]), Ok(vertex(0)));
    t.validate(Level::Delaunay).expect("valid");
}

/// With ever more memory, a compaction fails at one place after the other, and changes nothing until it succeeds.
fn compact_within_limits<G: Dimension>(is_flat: bool) {
    let mut history = History::<G>::new(5);
    (history.is_flat, history.mirror) = (is_flat, None);
    for v in history.present() {
        history.t.remove_vertex(v).expect("it is present");
        history.positions[v] = None;
    }
    (0..60).for_each(|_| history.insert());
    history.take_changes();
    (0..20).for_each(|_| history.remove());
    history.stage();
    let (mut limit, mut n_failures) = (0, 0);
    loop {
        let before = cell_set(&history.t);
        LEFT.set(limit);
        let compacted = history.t.compact();
        LEFT.set(isize::MAX);
        match compacted {
            Ok(map) => {
                assert_eq!(map.len(), history.positions.len());
                break;
            }
            Err(error) => assert!(matches!(error, Error::OutOfMemory { .. }), "{error}"),
        }
        limit += MISSING.get();
        n_failures += 1;
        assert_eq!(cell_set(&history.t), before);
        history.check(&|| format!("{}D, {limit} bytes", G::D));
    }
    assert!(n_failures > 10, "{n_failures} failures");
    history.t.validate(Level::Delaunay).expect("valid");
    assert_eq!(history.t.staged_count(), history.staged.len());
}

#[test]
fn without_memory_for_it_nothing_is_compacted() {
    compact_within_limits::<Plane>(false);
    compact_within_limits::<Plane>(true);
    compact_within_limits::<Space>(false);
    compact_within_limits::<Space>(true);
}

/// With several threads sites are in parts, and in space there are free cells among the others.
fn go_on_by_threads<G: Dimension>() {
    deldrift::internals::use_all_threads();
    for algorithm in [Algorithm::Repair, Algorithm::Rebuilding, Algorithm::Auto] {
        let options = Options { algorithm, threads: 3, ..Options::default() };
        let mut t = worn::<G>(2000, 1, options);
        t.compact().expect("room");
        t.validate(Level::Delaunay).expect("valid");
        for step in [1e-4, 1e-2] {
            let rng = &mut Rng::new(6);
            let places: Vec<_> = VertexId::range(0..2000)
                .map(|v| t.position(v).expect("dense ids"))
                .map(|p| point::<G>(|k| p[k] + step * rng.unit()))
                .collect();
            t.move_all(&places).expect("places in range");
            t.commit_timestamp().expect("room");
            t.take_changes().expect("room");
            t.validate(Level::Delaunay).expect("valid");
            let expected = fresh_cells::<G>(&places.into_iter().map(Some).collect::<Vec<_>>());
            assert_same_cells(&cell_set(&t), &expected, || format!("{}D, {algorithm:?}, {step}", G::D));
        }
    }
}

#[test]
fn compacted_triangulations_go_on_by_several_threads() {
    go_on_by_threads::<Plane>();
    go_on_by_threads::<Space>();
}
