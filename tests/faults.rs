//! Calls that fail midway: the k-th allocation of a call, or all from there on, finds no memory; or the monitor
//! cancels. The call returns an error and all is as it was, and the same call then succeeds as if nothing had been.
//!
//! Each fault happens in a process of its own, forked from one in which everything is ready: that is quick, and an
//! allocation that cannot fail aborts that process alone. Such are counted and listed with their places.
//! `DELDRIFT_SOAK` multiplies the number of faults for each call.
#![cfg(target_os = "linux")]
#![allow(unsafe_code)] // An allocator that fails, and processes to fail in, have no other way to be.

mod common;
#[path = "faults_in_boxes/mod.rs"]
mod faults_in_boxes;

use common::carried::{Carried, List, take};
use common::history::Snapshot;
use common::{Rng, ids, point, seeds, sorted, vertex};
use deldrift::motion::{Algorithm, CommitReport, Interpolation, Level, ListsOf, Location, Monitor};
use deldrift::motion::{MovingTriangulation, Options, Rows, Saved, TransferOrder, VertexValues};
use deldrift::{CellId, Dimension, Plane, Space, VertexId};
use deldrift::{Error, LoadError, Result};
use std::alloc::{GlobalAlloc, Layout, System};
use std::backtrace::Backtrace;
use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::null_mut;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicPtr, AtomicUsize, Ordering::Relaxed};

struct Failing;

#[global_allocator]
static ALLOCATOR: Failing = Failing;

static IS_ARMED: AtomicBool = AtomicBool::new(false);
static REQUESTS: AtomicUsize = AtomicUsize::new(0);
static FIRST: AtomicUsize = AtomicUsize::new(usize::MAX);
static FAILS_ON: AtomicBool = AtomicBool::new(false);
static TRACES: AtomicBool = AtomicBool::new(false);
/// What the forked process tells.
static PAGE: AtomicPtr<Page> = AtomicPtr::new(null_mut());

thread_local! {
    static IS_NOTING: Cell<bool> = const { Cell::new(false) };
}

const TEXT: usize = 1 << 15;
const FRAMES: usize = 20;

/// Memory that both processes have.
#[repr(C)]
struct Page {
    requests: usize,
    has_failed: bool,
    outcome: Outcome,
    frames: [usize; FRAMES],
    length: usize,
    text: [u8; TEXT],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
enum Outcome {
    /// No allocation was left to fail.
    Untouched,
    /// The call did without.
    Absorbed,
    /// The call failed, and all was well.
    Clean,
    /// Something was not as it should be.
    Changed,
    /// The process ended.
    Aborted,
}

impl Page {
    fn tell(&mut self, text: &str) {
        self.length = text.len().min(TEXT);
        self.text[..self.length].copy_from_slice(&text.as_bytes()[..self.length]);
    }

    fn text(&self) -> String {
        String::from_utf8_lossy(&self.text[..self.length]).into_owned()
    }
}

/// Whether the present request fails.
fn fails() -> bool {
    if !IS_ARMED.load(Relaxed) || IS_NOTING.get() {
        return false;
    }
    let k = REQUESTS.fetch_add(1, Relaxed);
    let first = FIRST.load(Relaxed);
    if k < first || k > first && !FAILS_ON.load(Relaxed) {
        return false;
    }
    if k == first {
        IS_NOTING.set(true);
        note_place();
        IS_NOTING.set(false);
    }
    true
}

fn note_place() {
    // SAFETY: the page is there while the process is armed, and one thread alone is the first to fail.
    let page = unsafe { &mut *PAGE.load(Relaxed) };
    page.has_failed = true;
    let mut frames = [null_mut(); FRAMES];
    // SAFETY: there is room for so many frames.
    unsafe { libc::backtrace(frames.as_mut_ptr(), FRAMES as i32) };
    page.frames = frames.map(|frame| frame as usize);
    if TRACES.load(Relaxed) {
        page.tell(&Backtrace::force_capture().to_string());
    }
}

// SAFETY: all is handed on to the system's allocator, or there is no memory.
unsafe impl GlobalAlloc for Failing {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promise.
        if fails() { null_mut() } else { unsafe { System.alloc(layout) } }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promise.
        if fails() { null_mut() } else { unsafe { System.alloc_zeroed(layout) } }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the caller's promise.
        if fails() { null_mut() } else { unsafe { System.realloc(pointer, layout, size) } }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(pointer, layout) }
    }
}

fn arm(first: usize, goes_on: bool) {
    REQUESTS.store(0, Relaxed);
    FIRST.store(first, Relaxed);
    FAILS_ON.store(goes_on, Relaxed);
    IS_ARMED.store(true, Relaxed);
}

fn disarm() {
    IS_ARMED.store(false, Relaxed);
}

/// Does the work in a process of its own; it tells what came of it on the page.
fn forked(page: &mut Page, work: impl FnOnce(&mut Page)) {
    (page.requests, page.has_failed, page.outcome, page.length) = (0, false, Outcome::Aborted, 0);
    page.frames = [0; FRAMES];
    // SAFETY: the new process has this thread alone, and ends below.
    let child = unsafe { libc::fork() };
    assert!(child >= 0, "no process");
    if child == 0 {
        let limit = libc::rlimit { rlim_cur: 0, rlim_max: 0 };
        // SAFETY: plain calls of the system. What is written to the standard error would be in the way.
        unsafe {
            libc::setrlimit(libc::RLIMIT_CORE, &limit);
            libc::dup2(libc::open(c"/dev/null".as_ptr(), libc::O_WRONLY), 2);
            libc::alarm(120);
        }
        if let Err(panic) = catch_unwind(AssertUnwindSafe(|| work(page))) {
            disarm();
            let text = panic.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
            page.outcome = Outcome::Changed;
            page.tell(text.unwrap_or("a panic"));
        }
        // SAFETY: the process is done.
        unsafe { libc::_exit(0) };
    }
    let mut status = 0;
    // SAFETY: the child is one of this process.
    let waited = unsafe { libc::waitpid(child, &mut status, 0) };
    assert_eq!(waited, child);
    if libc::WIFSIGNALED(status) && libc::WTERMSIG(status) != libc::SIGABRT {
        page.outcome = Outcome::Changed;
        page.tell(&format!("signal {}", libc::WTERMSIG(status)));
    }
}

/// What a triangulation has gone through before the call.
#[derive(Clone, Copy, Debug)]
struct Setting {
    n: usize,
    threads: u32,
    hides: bool,
    reads: bool,
    takes: bool,
    edits: bool,
    /// Insertions, and half as many removals, that are staged with the moves of a commit.
    stages: usize,
    /// Commits before.
    warm: usize,
}

const COLD: Setting =
    Setting { n: 60, threads: 1, hides: false, reads: false, takes: false, edits: false, stages: 0, warm: 0 };

const SETTINGS: [Setting; 10] = [
    COLD,
    Setting { stages: 7, ..COLD },
    Setting { reads: true, warm: 2, ..COLD },
    Setting { hides: true, takes: true, ..COLD },
    Setting { warm: 1, ..COLD },
    Setting { hides: true, reads: true, takes: true, stages: 3, warm: 1, ..COLD },
    Setting { hides: true, takes: true, stages: 16, ..COLD },
    Setting { hides: true, reads: true, takes: true, edits: true, warm: 1, ..COLD },
    Setting { n: 800, threads: 3, ..COLD },
    Setting { n: 800, threads: 3, hides: true, reads: true, takes: true, warm: 1, ..COLD },
];

/// A call, with what it is about.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Call {
    New,
    /// A vertex goes far, onto another one, or from where others are.
    Relocate(Goal),
    Insert(Goal),
    Remove(Goal),
    MoveVertices,
    MoveAll,
    StageInsertions,
    StageRemovals,
    /// Of all vertices, or of some.
    Commit(Algorithm, bool),
    /// The first phase of a commit, and what takes it back.
    Prepare,
    Withdraw,
    Clone,
    Save,
    Load,
    Cells,
    Star,
    Locate,
    Nearest,
    Validate,
    AnnulusWidths,
    StandardDelimiter,
    TakeChanges,
    TransferCells,
    Tolerance,
    Circumspheres,
    MaskBoundary,
    /// Of two vertices, or of all.
    CellsAround(bool),
    Edges,
    VertexNeighbours,
    VertexCells,
    MirrorIndices,
    VoronoiVolumes,
    VoronoiFacets,
    VoronoiCells,
    VoronoiCellsWithin,
    VoronoiDerivatives,
    VoronoiChanged,
    Interpolate(Interpolation),
    NearestVertices,
    VerticesInBall,
    NeighbourLists,
    VerticesInBox,
    Conflicts(Goal),
    CellsInReach,
    VerticesInReach,
    /// Of two edges, or of as many as half the vertices.
    FindSimplices(bool),
    CellOfEachVertex,
    Barycentric,
    MaskWithoutFlatCells,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Goal {
    Near,
    Far,
    Shared,
}

impl Call {
    fn all() -> Vec<Call> {
        let mut calls = vec![Call::New];
        for goal in [Goal::Near, Goal::Far, Goal::Shared] {
            calls.extend([Call::Relocate(goal), Call::Insert(goal), Call::Remove(goal)]);
        }
        for algorithm in Algorithm::ALL {
            calls.extend([Call::Commit(algorithm, true), Call::Commit(algorithm, false)]);
        }
        calls.extend([Call::Prepare, Call::Withdraw, Call::StageInsertions, Call::StageRemovals]);
        calls.extend([Call::MoveVertices, Call::MoveAll, Call::Cells, Call::Star, Call::Locate]);
        calls.extend([Call::Nearest, Call::Validate, Call::AnnulusWidths, Call::StandardDelimiter]);
        calls.extend([Call::TakeChanges, Call::TransferCells, Call::Tolerance]);
        calls.extend([Call::Circumspheres, Call::MaskBoundary, Call::Edges, Call::VertexNeighbours]);
        calls.extend([Call::VertexCells, Call::MirrorIndices, Call::VoronoiVolumes, Call::VoronoiFacets]);
        calls.extend([
            Call::VoronoiCells,
            Call::VoronoiCellsWithin,
            Call::VoronoiDerivatives,
            Call::VoronoiChanged,
        ]);
        calls.extend([Interpolation::Linear, Interpolation::NaturalNeighbour].map(Call::Interpolate));
        calls.extend([Call::CellsAround(false), Call::CellsAround(true)]);
        calls.extend([
            Call::NearestVertices,
            Call::VerticesInBall,
            Call::NeighbourLists,
            Call::VerticesInBox,
        ]);
        calls.extend([Call::CellsInReach, Call::VerticesInReach]);
        calls.extend([Goal::Near, Goal::Far, Goal::Shared].map(Call::Conflicts));
        calls.extend([Call::FindSimplices(false), Call::FindSimplices(true)]);
        calls.extend([Call::CellOfEachVertex, Call::Barycentric, Call::MaskWithoutFlatCells]);
        calls.extend([Call::Clone, Call::Save, Call::Load]);
        calls
    }

    /// The name of the function.
    fn name(self) -> String {
        match self {
            Call::Commit(algorithm, _) => format!("commit by {algorithm:?}"),
            Call::Relocate(_) => "relocate_vertex".to_string(),
            Call::Insert(_) => "insert_vertex".to_string(),
            Call::Remove(_) => "remove_vertex".to_string(),
            Call::CellsAround(_) => "CellsAround".to_string(),
            Call::Conflicts(_) => "Conflicts".to_string(),
            Call::FindSimplices(_) => "FindSimplices".to_string(),
            other => format!("{other:?}"),
        }
    }

    /// Whether it makes what is staged happen.
    fn brings_edits(self) -> bool {
        matches!(self, Call::Commit(..) | Call::Prepare | Call::Withdraw)
    }

    fn algorithm(self) -> Algorithm {
        match self {
            Call::Commit(algorithm, _) => algorithm,
            Call::Relocate(_) | Call::Insert(_) | Call::Remove(_) => Algorithm::SafeRegionTolerance,
            _ => Algorithm::Auto,
        }
    }
}

/// A triangulation before a call.
struct Scene<G: Dimension> {
    t: MovingTriangulation<G>,
    points: Vec<G::Point>,
    carried: Option<Carried>,
    call: Call,
    options: Option<Options>,
    /// An entry for each cell, and a value for each id.
    mask: Vec<u8>,
    values: Vec<f64>,
    /// The vertices that are present.
    present: Vec<VertexId>,
    /// What is to be loaded.
    saved: Vec<u8>,
}

/// What a call gave, as far as that does not depend on the order of cells.
#[derive(Debug, PartialEq)]
enum Given {
    Nothing,
    Id(VertexId),
    Cells(BTreeSet<Vec<VertexId>>),
    Report(u64, u64, u64),
    Where(Option<VertexId>),
    Numbers(Vec<u64>),
    Ids(Vec<VertexId>),
    Pairs(Vec<[VertexId; 2]>),
    Lists(Rows<VertexId>),
    Nearest(Option<VertexId>),
}

fn cloud<G: Dimension>(n: usize, rng: &mut Rng) -> Vec<G::Point> {
    (0..n).map(|_| point::<G>(|_| rng.unit())).collect()
}

fn nudge<G: Dimension>(points: &mut [G::Point], size: f64, rng: &mut Rng) {
    for p in points {
        *p = point::<G>(|k| p[k] + size * (rng.unit() - 0.5));
    }
}

/// A place at a point or beside it.
fn beside<G: Dimension>(p: &G::Point, k: usize) -> G::Point {
    point::<G>(|axis| p[axis] + [0.0, 0.01, 1.0][k % 3])
}

impl<G: Dimension> Scene<G> {
    fn new(call: Call, setting: &Setting, monitor: Option<Monitor>) -> Self {
        deldrift::internals::use_all_threads();
        let rng = &mut Rng::new(17);
        let mut points = cloud::<G>(setting.n, rng);
        if setting.hides {
            (points[20], points[30], points[40]) = (points[10], points[10], points[11]);
        }
        let options =
            || Options { algorithm: call.algorithm(), threads: setting.threads, ..Options::default() };
        let mut t =
            MovingTriangulation::<G>::new(&points, Options { monitor, ..options() }).expect("a build");
        let spacing = (setting.n as f64).powf(-1.0 / G::D as f64);
        for _ in 0..setting.warm {
            nudge::<G>(&mut points, 0.02 * spacing, rng);
            if setting.hides {
                (points[20], points[30], points[40]) = (points[10], points[10], points[11]);
            }
            t.move_all(&points).expect("moves");
            t.commit_timestamp().expect("a commit");
        }
        let mut carried = setting.takes.then(Carried::default);
        if let Some(carried) = &mut carried {
            carried.take(&mut t, &|| "before".to_string());
        }
        if setting.edits {
            t.insert_vertex(&point::<G>(|k| 0.3 + 0.1 * k as f64)).expect("an insertion");
            t.remove_vertex(vertex(7)).expect("a removal");
            let p = point::<G>(|k| 0.9 - 0.1 * k as f64);
            t.relocate_vertex(vertex(8), &p).expect("a relocation");
            points[8] = p;
            points.push(point::<G>(|k| 0.3 + 0.1 * k as f64));
        }
        if setting.reads {
            t.cells().expect("room");
            if setting.edits {
                // The arrays are there, but not up to date.
                t.remove_vertex(vertex(9)).expect("a removal");
            }
        }
        let mut places = points.clone();
        nudge::<G>(&mut places, 0.3 * spacing, rng);
        let present: Vec<VertexId> = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect();
        match call {
            Call::Commit(_, true) if present.len() == places.len() => t.move_all(&places).expect("moves"),
            Call::Commit(_, is_whole) => {
                let some: Vec<VertexId> =
                    present.into_iter().filter(|v| is_whole || v.get() % 3 == 0).collect();
                let places: Vec<G::Point> = some.iter().map(|&v| places[v]).collect();
                t.move_vertices(&some, &places).expect("moves");
            }
            Call::MoveVertices | Call::MoveAll | Call::New => {}
            Call::StageInsertions | Call::StageRemovals => t.move_all(&points).expect("moves"),
            _ => t.move_vertices(&ids([3, 4]), &[places[3], places[4]]).expect("moves"),
        }
        if call.brings_edits() {
            let coming: Vec<G::Point> = (0..setting.stages).map(|k| points[k * 3]).collect();
            let coming: Vec<G::Point> = (0..).zip(coming).map(|(k, p)| beside::<G>(&p, k)).collect();
            t.stage_insertions(&coming).expect("insertions");
            // Fewer than come, so that these are not all at sites that are left.
            let leaving: Vec<VertexId> = (0..setting.stages / 2).map(|k| VertexId::at(10 + 3 * k)).collect();
            t.stage_removals(&leaving).expect("removals");
        }
        if call == Call::Withdraw {
            t.prepare_timestamp().expect("a prepared timestamp");
            // More rounds: what they add comes to more than any of them alone has room for.
            for round in 1..4 {
                let away = 1e-3 * f64::from(round);
                let more: Vec<G::Point> =
                    points[..20].iter().map(|p| point::<G>(|axis| p[axis] + away)).collect();
                t.stage_insertions(&more).expect("insertions");
                t.prepare_timestamp().expect("a prepared timestamp");
            }
        }
        let options = Some(options());
        let (mask, mut values) = (vec![1; t.cell_count()], (0..t.id_count()).map(|v| v as f64).collect());
        if call == Call::TransferCells {
            let carried = carried.get_or_insert_default();
            carried.take(&mut t, &|| "before".to_string());
            values = vec![0.25; t.cell_count()];
            let p = point::<G>(|k| 0.45 + 0.05 * k as f64);
            t.relocate_vertex(vertex(5), &p).expect("a relocation");
            points[5] = p;
            let list = take(&mut t).expect("room");
            carried.follow(&t, &list, &|| "after".to_string());
        }
        let saved = if call == Call::Load { t.saved().expect("room") } else { Vec::new() };
        let present = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect();
        Scene { t, points, carried, call, options, mask, values, present, saved }
    }

    /// Makes the call, and disarms as soon as it is back.
    fn call(&mut self) -> Result<Given> {
        let Scene { t, points, call, options, mask, values, present, saved, .. } = self;
        let goal = |goal: Goal| match goal {
            Goal::Near => point::<G>(|k| points[12][k] + 1e-3),
            Goal::Far => point::<G>(|k| 1.5 + k as f64),
            Goal::Shared => points[13],
        };
        // One of those that share a place, if any do.
        let chosen = |goal: Goal| match goal {
            Goal::Near => 12,
            Goal::Far => 10,
            Goal::Shared => 30,
        };
        fn given<T>(result: Result<T>) -> Result<T> {
            disarm();
            result
        }
        Ok(match *call {
            Call::New => {
                let options = options.take().unwrap_or_default();
                let made = given(MovingTriangulation::<G>::new(points, options))?;
                Given::Cells(common::cell_set(&made))
            }
            Call::Clone => Given::Cells(common::cell_set(&given(t.try_clone(None))?)),
            Call::Save => {
                let n_bytes = given(t.saved())?.len();
                Given::Numbers(vec![n_bytes as u64])
            }
            Call::Load => {
                let options = options.take().unwrap_or_default();
                let saved = Saved::of(saved).expect("saved");
                let loaded =
                    given(MovingTriangulation::<G>::load(&saved, options).map_err(|error| match error {
                        LoadError::Call(error) => error,
                        other => panic!("{other}"),
                    }))?;
                Given::Cells(common::cell_set(&loaded))
            }
            Call::Relocate(to) => {
                given(t.relocate_vertex(VertexId::new(chosen(to)), &goal(to)))?;
                Given::Nothing
            }
            Call::Insert(to) => Given::Id(given(t.insert_vertex(&goal(to)))?),
            Call::Remove(to) => {
                given(t.remove_vertex(VertexId::new(chosen(to))))?;
                Given::Nothing
            }
            Call::MoveVertices => {
                given(t.move_vertices(&ids([1, 2, 5]), &points[14..17]))?;
                Given::Nothing
            }
            Call::StageInsertions => Given::Id(given(t.stage_insertions(&points[..20]))?),
            Call::StageRemovals => {
                given(t.stage_removals(&ids([10, 20, 21, 22, 23])))?;
                Given::Nothing
            }
            Call::MoveAll => {
                given(t.move_all(points))?;
                Given::Nothing
            }
            Call::Commit(..) => {
                let CommitReport { timestamp, moved, coincident, .. } = given(t.commit_timestamp())?;
                Given::Report(timestamp, moved, coincident)
            }
            Call::Prepare => {
                let CommitReport { moved, coincident, .. } = given(t.prepare_timestamp())?;
                Given::Report(0, moved, coincident)
            }
            Call::Withdraw => {
                t.withdraw_timestamp();
                given(Ok(Given::Nothing))?
            }
            Call::Cells => {
                given(t.cells().map(drop))?;
                Given::Nothing
            }
            Call::Star => {
                let mut star = Vec::new();
                given(t.star(vertex(12), &mut star))?;
                let rows = t.cells()?.corners;
                Given::Cells(star.iter().map(|&c| sorted(rows[c].as_ref())).collect())
            }
            Call::Locate => match given(t.locate(&point::<G>(|_| 0.51)))? {
                Location::Vertex(v) => Given::Where(Some(v)),
                _ => Given::Where(None),
            },
            Call::Nearest => Given::Nearest(given(t.nearest_vertex(&point::<G>(|_| 0.49)))?),
            Call::Validate => {
                let valid = t.validate(Level::Delaunay);
                disarm();
                match valid {
                    Err(violation) if violation.message.contains("memory") => {
                        return Err(Error::OutOfMemory { bytes: 0 });
                    }
                    other => other.expect("valid"),
                }
                Given::Nothing
            }
            Call::AnnulusWidths => {
                let widths = given(t.annulus_widths())?;
                let mut bits: Vec<u64> = widths.iter().map(|width| width.to_bits()).collect();
                bits.sort_unstable();
                Given::Numbers(bits)
            }
            Call::StandardDelimiter => {
                given(t.standard_delimiter(CellId::new(0), 1).map(drop))?;
                Given::Nothing
            }
            Call::TakeChanges => {
                let taken = t.take_changes();
                disarm();
                let list = List::of(&taken?);
                let carried = self.carried.get_or_insert_default();
                carried.follow(t, &list, &|| "taken".to_string());
                Given::Nothing
            }
            Call::TransferCells => {
                let mut made = t.transfer_cells(None, TransferOrder::Second, 1, values, &mut |_| true);
                if let Err(Error::WrongCount { wanted, .. }) = made {
                    // Changes have been taken again, to compare what there is.
                    disarm();
                    values.resize(wanted, 0.25);
                    made = t.transfer_cells(None, TransferOrder::Second, 1, values, &mut |_| true);
                }
                disarm();
                assert!(values.iter().all(|&mean| mean == 0.25), "a constant is another one");
                made?;
                assert_eq!(values.len(), t.cell_count());
                Given::Numbers(vec![values.len() as u64])
            }
            Call::Circumspheres => {
                let n = given(t.circumspheres().map(Iterator::count))?;
                Given::Numbers(vec![n as u64, t.volumes()?.len() as u64])
            }
            Call::CellsAround(is_of_all) => {
                let listed = if is_of_all { &present[..] } else { &present[12..14] };
                let around = given(t.cells_around(listed))?;
                let rows = t.cells()?.corners;
                Given::Cells(around.iter().map(|&c| sorted(rows[c].as_ref())).collect())
            }
            Call::MaskBoundary => {
                let mut n = 0;
                given(t.mask_boundary(mask, |_| n += 1))?;
                Given::Numbers(vec![n])
            }
            Call::Edges => Given::Pairs(given(t.edges())?),
            Call::VertexNeighbours => Given::Lists(given(t.vertex_neighbours())?),
            Call::VertexCells => {
                let lists = given(t.vertex_cells())?;
                Given::Numbers(vec![lists.entries.len() as u64])
            }
            Call::MirrorIndices => {
                let n = given(t.mirror_indices().map(Iterator::count))?;
                Given::Numbers(vec![n as u64])
            }
            Call::VoronoiVolumes => {
                let clip = [&point::<G>(|_| 0.2), &point::<G>(|_| 0.7)];
                let volumes = given(t.voronoi_volumes(Some(clip)))?;
                Given::Numbers(vec![volumes.len() as u64])
            }
            Call::VoronoiFacets => {
                let clip = [&point::<G>(|_| 0.2), &point::<G>(|_| 0.7)];
                let measures = given(t.voronoi_facets(Some(clip)))?;
                Given::Numbers(vec![measures.len() as u64])
            }
            Call::VoronoiCells => {
                let clip = [&point::<G>(|_| 0.2), &point::<G>(|_| 0.7)];
                let cells = given(t.voronoi_cells(clip, None, &mut |_| true))?;
                Given::Numbers(vec![cells.volumes.len() as u64])
            }
            Call::VoronoiCellsWithin => {
                let clip = [&point::<G>(|_| 0.2), &point::<G>(|_| 0.7)];
                let mut rows = [1.0; 8];
                rows[0] = -0.5;
                let rows = &rows[..2 * (G::D + 1)];
                let cells = given(t.voronoi_cells_within(clip, rows, None, &mut |_| true))?;
                Given::Numbers(vec![cells.volumes.len() as u64])
            }
            Call::VoronoiDerivatives => {
                let clip = [&point::<G>(|_| 0.2), &point::<G>(|_| 0.7)];
                Given::Pairs(given(t.voronoi_derivatives(clip, None, &mut |_| true))?.edges)
            }
            Call::VoronoiChanged => {
                let mask = given(t.voronoi_changed(&present[12..14]))?;
                Given::Numbers(vec![mask.len() as u64])
            }
            Call::Interpolate(method) => {
                let places = [point::<G>(|_| 0.5), point::<G>(|axis| 0.4 + 0.1 * axis as f64)];
                let values = VertexValues { values, n_values: 1 };
                let mut n = 0;
                given(
                    t.interpolate(method, values, &places, None, |result| n += u64::from(result.is_some())),
                )?;
                Given::Numbers(vec![n])
            }
            Call::NearestVertices => {
                let mut sum = 0u64;
                let add = |v: VertexId| sum = sum.wrapping_mul(31).wrapping_add(u64::from(v.get()));
                given(t.nearest_vertices(&points[12..15], 10, add))?;
                Given::Numbers(vec![sum])
            }
            Call::VerticesInBall => Given::Ids(given(t.vertices_in_ball(&points[12], 0.09))?),
            Call::NeighbourLists => {
                let wanted = ListsOf { squared_radii: &[0.01], mask: None, is_half: false };
                Given::Ids(given(t.neighbour_lists(&wanted))?.neighbours)
            }
            Call::VerticesInBox => {
                let (low, high) = (point::<G>(|_| 0.3), point::<G>(|axis| 0.6 + axis as f64));
                Given::Ids(given(t.vertices_in_box(&low, &high))?)
            }
            Call::CellsInReach => {
                let (low, high) = (point::<G>(|_| 0.3), point::<G>(|axis| 0.6 + axis as f64));
                let found = given(t.cells_in_reach(&[low], &[high], None))?;
                let rows = t.cells()?.corners;
                Given::Cells(found.cells.iter().map(|&c| sorted(rows[c].as_ref())).collect())
            }
            Call::VerticesInReach => {
                let (low, high) = (point::<G>(|_| 0.3), point::<G>(|axis| 0.6 + axis as f64));
                Given::Ids(given(t.vertices_in_reach(&[low], &[high], None))?.vertices)
            }
            Call::Conflicts(to) => {
                let found = given(t.conflicts(&goal(to), None))?;
                let rows = t.cells()?.corners;
                Given::Cells(found.iter().map(|&c| sorted(rows[c].as_ref())).collect())
            }
            Call::FindSimplices(is_of_many) => {
                let n = if is_of_many { present.len() / 2 * 2 } else { 4 };
                let mut sum = 0u64;
                let add =
                    |cell: Option<CellId>| sum = sum.wrapping_mul(31).wrapping_add(u64::from(cell.is_some()));
                given(t.find_simplices(&present[..n], 2, add))?;
                Given::Numbers(vec![sum])
            }
            Call::CellOfEachVertex => {
                let n = given(
                    t.cell_of_each_vertex()
                        .map(|cells| cells.iter().filter(|&&cell| cell != CellId::NONE).count()),
                )?;
                Given::Numbers(vec![n as u64])
            }
            Call::Barycentric => {
                let (mut n, cells) = (0, [CellId::new(0), CellId::NONE]);
                given(t.barycentric(&points[12..14], &cells, |row| n += u64::from(row.is_some())))?;
                Given::Numbers(vec![n])
            }
            Call::MaskWithoutFlatCells => {
                let mask = given(t.mask_without_flat_cells(0.1))?;
                Given::Numbers(vec![mask.iter().map(|&stays| u64::from(stays)).sum(), mask.len() as u64])
            }
            Call::Tolerance => {
                let tolerance = given(t.tolerance(vertex(12)))?;
                Given::Numbers(vec![tolerance.to_bits()])
            }
        })
    }

    /// All that there is to be seen, now and after what is staged.
    fn finish(&mut self) -> (Snapshot<G::Point>, Option<Snapshot<G::Point>>) {
        let now = Snapshot::of(&self.t);
        if self.call == Call::Prepare {
            self.t.publish_timestamp().expect("a prepared timestamp");
        }
        self.follow();
        let is_staged = self.t.staged_count() > 0 || self.t.staged_edits() != (0, 0);
        let later = is_staged.then(|| {
            self.t.commit_timestamp().expect("a commit");
            Snapshot::of(&self.t)
        });
        self.follow();
        (now, later)
    }

    fn follow(&mut self) {
        if let Some(carried) = &mut self.carried {
            carried.take(&mut self.t, &|| "after".to_string());
        }
    }

    fn rows(&self) -> Vec<G::Vertices> {
        self.t.cells().expect("room").corners.to_vec()
    }

    fn positions(&self) -> Vec<Option<G::Point>> {
        VertexId::range(0..self.t.id_count()).map(|v| self.t.position(v).ok()).collect()
    }
}

/// What came of the faults in the calls of one function.
#[derive(Debug, Default)]
struct Tally {
    faults: usize,
    absorbed: usize,
    clean: usize,
    changed: usize,
    aborted: usize,
}

struct Faults<'p> {
    page: &'p mut Page,
    /// Faults for each call in each setting.
    most: usize,
    tallies: BTreeMap<String, Tally>,
    /// Places of the aborts, by the addresses on the stack, and how often they were met.
    aborts: BTreeMap<[usize; FRAMES], (String, usize)>,
    changed: Vec<String>,
}

impl Faults<'_> {
    fn of_call<G: Dimension>(&mut self, call: Call, setting: &Setting) {
        let name = format!("{}D, {call:?}, {setting:?}", G::D);
        // What it gives without faults.
        let mut reference = Scene::<G>::new(call, setting, None);
        let given = reference.call().unwrap_or_else(|error| panic!("{name}: it fails: {error}"));
        let finished = reference.finish();
        drop(reference);
        // Without looking at the cells where they have not been read: that would make the arrays.
        let mut before = Scene::<G>::new(call, setting, None);
        let positions = before.positions();
        let state = Snapshot::of(&Scene::<G>::new(call, setting, None).t);
        let (statistics, edits) = (before.t.statistics(), before.t.staged_edits());
        let rows = setting.reads.then(|| Scene::<G>::new(call, setting, None).rows());

        forked(self.page, |page| {
            arm(usize::MAX, false);
            let _ = before.call();
            disarm();
            page.requests = REQUESTS.load(Relaxed);
            page.outcome = Outcome::Untouched;
        });
        // The larger ones are slower.
        let most = if setting.threads > 1 { self.most / 3 } else { self.most };
        let stride = self.page.requests.div_ceil(most).max(1);
        for (round, k) in (0..).step_by(stride).enumerate().take(4 * most) {
            let goes_on = round % 3 == 2;
            let mut attempt = |page: &mut Page, traces: bool| {
                forked(page, |page| {
                    let scene = &mut before;
                    TRACES.store(traces, Relaxed);
                    arm(k, goes_on);
                    let done = scene.call();
                    disarm();
                    let is_untouched = !page.has_failed;
                    let second = match done {
                        Ok(given) => given,
                        Err(error) => {
                            assert!(
                                matches!(error, Error::OutOfMemory { .. }) && page.has_failed,
                                "another error: {error}"
                            );
                            assert_eq!(scene.t.statistics(), statistics, "other counts");
                            assert_eq!(scene.positions(), positions, "other positions");
                            assert_eq!(scene.t.staged_edits(), edits, "other edits");
                            if round % 2 == 0 {
                                assert_eq!(Snapshot::of(&scene.t), state, "another state");
                                assert!(rows.as_ref().is_none_or(|rows| *rows == scene.rows()), "other rows");
                                scene.follow();
                            } else {
                                scene.t.validate(Level::Delaunay).expect("a triangulation");
                            }
                            page.outcome = Outcome::Clean;
                            if scene.options.is_none() {
                                scene.options = Scene::<G>::new(call, setting, None).options;
                            }
                            scene.call().expect("no fault")
                        }
                    };
                    assert_eq!(second, given, "another result");
                    assert_eq!(scene.finish(), finished, "another end");
                    if is_untouched {
                        page.outcome = Outcome::Untouched;
                    } else if page.outcome != Outcome::Clean {
                        page.outcome = Outcome::Absorbed;
                    }
                });
            };
            attempt(self.page, false);
            // A process that ended after the call had come back was not ended by the fault.
            if self.page.outcome == Outcome::Untouched {
                break;
            }
            self.enter(&call.name(), &name, (k, goes_on), |page| attempt(page, true));
        }
    }

    /// Enters what came of a fault, a request that failed and maybe all behind it; `again` has it again, and traces it.
    fn enter(&mut self, function: &str, context: &str, fault: (usize, bool), again: impl FnOnce(&mut Page)) {
        let tally = self.tallies.entry(function.to_string()).or_default();
        let (k, goes_on) = fault;
        tally.faults += 1;
        match self.page.outcome {
            Outcome::Untouched => {}
            Outcome::Absorbed => tally.absorbed += 1,
            Outcome::Clean => tally.clean += 1,
            Outcome::Changed => {
                tally.changed += 1;
                let text: String = self.page.text().chars().take(600).collect();
                self.changed.push(format!("{context}, request {k}, goes on: {goes_on}: {text}"));
            }
            Outcome::Aborted => {
                tally.aborted += 1;
                let frames = self.page.frames;
                if !self.aborts.contains_key(&frames) {
                    again(self.page);
                    let place = format!("{} ({context}, {k})", place(&self.page.text()));
                    self.aborts.insert(frames, (place, 0));
                }
                self.aborts.get_mut(&frames).expect("it is there").1 += 1;
            }
        }
    }
}

/// The places in this crate that lead to an allocation, the innermost first; functions where the build knows no lines.
fn place(trace: &str) -> String {
    let lines: Vec<&str> = trace.lines().map(str::trim).collect();
    let places: Vec<&str> = lines.iter().filter_map(|line| line.strip_prefix("at ./src/")).collect();
    let functions: Vec<&str> = lines.iter().copied().filter(|line| line.contains("deldrift::")).collect();
    let known = if places.is_empty() { functions } else { places };
    known[..known.len().min(4)].join(" < ")
}

/// A page that forked processes share.
fn shared_page() -> &'static mut Page {
    // SAFETY: memory of zeros is a page; it is never given back, and this is called once.
    unsafe {
        let memory = libc::mmap(
            null_mut(),
            size_of::<Page>(),
            libc::PROT_READ | libc::PROT_WRITE,
            libc::MAP_SHARED | libc::MAP_ANONYMOUS,
            -1,
            0,
        );
        assert_ne!(memory, libc::MAP_FAILED);
        PAGE.store(memory.cast(), Relaxed);
        &mut *memory.cast::<Page>()
    }
}

#[test]
fn calls_without_memory_leave_all_as_it_was() {
    let mut frames = [null_mut(); 2];
    // SAFETY: there is room; the first call loads what later ones need.
    unsafe { libc::backtrace(frames.as_mut_ptr(), 2) };
    let mut faults = Faults {
        page: shared_page(),
        most: 9 * seeds(1).end as usize,
        tallies: BTreeMap::new(),
        aborts: BTreeMap::new(),
        changed: Vec::new(),
    };
    for call in Call::all() {
        for setting in &SETTINGS {
            let is_whole = matches!(call, Call::MoveAll | Call::StageInsertions | Call::StageRemovals);
            if setting.edits && is_whole || setting.stages > 0 && !call.brings_edits() {
                continue;
            }
            faults.of_call::<Plane>(call, setting);
            faults.of_call::<Space>(call, setting);
        }
    }
    faults_in_boxes::all(&mut faults);
    let Faults { tallies, aborts, changed, .. } = faults;
    println!("{:<34}{:>8}{:>10}{:>8}{:>9}{:>8}", "", "faults", "absorbed", "clean", "changed", "aborts");
    let mut sum = Tally::default();
    for (name, tally) in &tallies {
        let Tally { faults, absorbed, clean, changed, aborted } = *tally;
        println!("{name:<34}{faults:>8}{absorbed:>10}{clean:>8}{changed:>9}{aborted:>8}");
        sum.faults += faults;
        sum.absorbed += absorbed;
        sum.clean += clean;
        sum.changed += changed;
        sum.aborted += aborted;
    }
    println!("{sum:?}");
    let mut places = BTreeMap::<&str, (usize, &str)>::new();
    for (place, times) in aborts.values() {
        let entry = places.entry(place.split(" (").next().expect("a place")).or_insert((0, place));
        entry.0 += times;
    }
    for (place, (times, example)) in places {
        println!("aborts {times:>5} at {place}\n        as in {example}");
    }
    assert_eq!(sum.aborted, 0, "allocations that cannot fail");
    assert!(sum.faults > 2500, "{} faults", sum.faults);
    assert!(changed.is_empty(), "{} of {}:\n{}", changed.len(), sum.faults, changed.join("\n"));
}

/// Cancels at each call of the monitor in turn.
fn cancels_at_each_call<G: Dimension>(call: Call, setting: &Setting) -> usize {
    let left = Arc::new(AtomicUsize::new(usize::MAX));
    let monitor = || -> Option<Monitor> {
        let left = left.clone();
        Some(Box::new(move |_| left.fetch_sub(1, Relaxed) != 0))
    };
    let mut reference = Scene::<G>::new(call, setting, monitor());
    left.store(usize::MAX, Relaxed);
    let given = reference.call().expect("a commit");
    let n_calls = usize::MAX - left.swap(usize::MAX, Relaxed);
    let finished = reference.finish();
    for k in 0..n_calls {
        let mut scene = Scene::<G>::new(call, setting, monitor());
        let name = format!("{}D, {call:?}, {setting:?}, call {k}", G::D);
        let (statistics, edits) = (scene.t.statistics(), scene.t.staged_edits());
        let positions = scene.positions();
        let rows = setting.reads.then(|| scene.rows());
        left.store(k, Relaxed);
        assert_eq!(scene.call(), Err(Error::Cancelled), "{name}");
        left.store(usize::MAX, Relaxed);
        assert_eq!(scene.t.statistics(), statistics, "{name}");
        assert_eq!(scene.t.staged_edits(), edits, "{name}");
        assert_eq!(scene.positions(), positions, "{name}");
        scene.t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("{name}: {violation}"));
        assert!(rows.is_none_or(|rows| rows == scene.rows()), "{name}");
        if k % 2 == 0 {
            let state = Snapshot::of(&Scene::<G>::new(call, setting, monitor()).t);
            assert_eq!(Snapshot::of(&scene.t), state, "{name}");
            scene.follow();
        }
        assert_eq!(scene.call().as_ref(), Ok(&given), "{name}");
        assert_eq!(scene.finish(), finished, "{name}");
    }
    n_calls
}

#[test]
fn cancelled_commits_leave_all_as_it_was() {
    let mut n_calls = 0;
    for algorithm in Algorithm::ALL {
        let n_before = n_calls;
        for is_whole in [true, false] {
            for setting in &SETTINGS {
                n_calls += cancels_at_each_call::<Plane>(Call::Commit(algorithm, is_whole), setting);
                n_calls += cancels_at_each_call::<Space>(Call::Commit(algorithm, is_whole), setting);
            }
        }
        println!("cancelled commits by {algorithm:?}: {}", n_calls - n_before);
    }
    println!("cancelled {n_calls} times");
    assert!(n_calls > 500, "{n_calls}");
}
