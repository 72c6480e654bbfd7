//! In the steady state a commit allocates nothing: all that it works with has grown in the commits before. Lists of neighbours
//! allocate nothing for each vertex.
//!
//! Vertices go round a fixed cycle of places, so that after some rounds every list has been as
//! long as it will be. Every allocation and reallocation by the test's thread, and by others on the way through this
//! crate, is counted from then on, with the place in the sources that asks. (Others: the test's harness.)
#![allow(unsafe_code)] // An allocator that counts has no other way to be one.

mod common;

use common::{Rng, point};
use deldrift::motion::{Algorithm, Commits, ListsOf, MovingTriangulation, Options};
use deldrift::{Dimension, Plane, Space, VertexId};
use std::alloc::{GlobalAlloc, Layout, System};
use std::backtrace::Backtrace;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// How far vertices go from where they began, in spacings: hardly any cell changes, some do, many do.
const STILL: f64 = 1e-6;
const CALM: f64 = 1e-3;
const BRISK: f64 = 0.01;
const LIVELY: f64 = 0.03;

/// Displacements at which an algorithm allocates nothing. (Lively repairs in space rebuild, as so many cells of a hull
/// are inverted.)
fn displacements(dimension: usize, algorithm: Algorithm) -> [f64; 3] {
    let relocates = algorithm.row().commits == Commits::OneByOne;
    [STILL, CALM, if dimension == 2 || relocates { LIVELY } else { BRISK }]
}

/// All but those that rebuild.
fn steady_algorithms() -> impl Iterator<Item = Algorithm> {
    let rebuilds = [Algorithm::Rebuilding, Algorithm::RebuildingTolerance];
    Algorithm::ALL.into_iter().filter(move |algorithm| !rebuilds.contains(algorithm))
}

const N: usize = 1000;
/// Timestamps of a round.
const PLACES: usize = 8;
/// Rounds before allocations are counted: *auto* waits for some 50
/// commits until it tries something else for the second time.
const WARM: usize = 20;
const COUNTED: usize = 4;

struct Counting;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

static IS_COUNTING: AtomicBool = AtomicBool::new(false);
/// Each with whether it is one of the test's thread.
static TRACES: Mutex<Vec<(bool, Backtrace)>> = Mutex::new(Vec::new());

thread_local! {
    /// Whether an allocation is being noted, which itself allocates.
    static IS_NOTING: Cell<bool> = const { Cell::new(false) };
    /// Whether the thread is the test's.
    static IS_TESTING: Cell<bool> = const { Cell::new(false) };
}

fn note() {
    if IS_COUNTING.load(Relaxed) && !IS_NOTING.replace(true) {
        let trace = (IS_TESTING.get(), Backtrace::force_capture());
        TRACES.lock().expect("no panic while noting").push(trace);
        IS_NOTING.set(false);
    }
}

// SAFETY: all is handed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        note();
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        note();
        // SAFETY: the caller's promise.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        note();
        // SAFETY: the caller's promise.
        unsafe { System.realloc(pointer, layout, size) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(pointer, layout) }
    }
}

/// The places in this crate that lead to an allocation, the innermost first.
fn call_sites(trace: &Backtrace) -> String {
    let text = trace.to_string();
    let places = text.lines().filter_map(|line| line.trim().strip_prefix("at ./src/"));
    places.take(4).collect::<Vec<_>>().join(" < ")
}

/// Where the cycle leads: random points, each at random places close to where it began.
fn cycle<G: Dimension>(displacement: f64) -> Vec<Vec<G::Point>> {
    let rng = &mut Rng::new(1);
    let side = (N as f64).powf(1.0 / G::D as f64);
    let start: Vec<G::Point> = (0..N).map(|_| point::<G>(|_| side * rng.unit())).collect();
    let mut near = |p: &G::Point| point::<G>(|k| p[k] + displacement * (2.0 * rng.unit() - 1.0));
    (0..PLACES).map(|_| start.iter().map(&mut near).collect()).collect()
}

/// Allocations of commits once the first rounds are over, by call site.
fn allocations<G: Dimension>(algorithm: Algorithm, displacement: f64) -> BTreeMap<String, usize> {
    let timestamps = cycle::<G>(displacement);
    let options = Options { algorithm, ..Options::default() };
    let mut t = MovingTriangulation::<G>::new(&timestamps[0], options).expect("points in range");
    let ids: Vec<VertexId> = VertexId::range(0..N).collect();
    for round in 0..WARM + COUNTED {
        IS_COUNTING.store(round >= WARM, Relaxed);
        for positions in &timestamps {
            t.move_vertices(&ids, positions).expect("places in range");
            t.commit_timestamp().expect("a commit");
        }
        IS_COUNTING.store(false, Relaxed);
    }
    let mut sites = BTreeMap::new();
    for (is_testing, trace) in TRACES.lock().expect("no panic while noting").drain(..) {
        let site = call_sites(&trace);
        if is_testing || !site.is_empty() {
            *sites.entry(site).or_default() += 1;
        }
    }
    sites
}

/// Allocations of lists of what is near all of so many vertices.
fn allocations_of_lists<G: Dimension>(n: usize) -> usize {
    let rng = &mut Rng::new(2);
    let side = (n as f64).powf(1.0 / G::D as f64);
    let places: Vec<G::Point> = (0..n).map(|_| point::<G>(|_| side * rng.unit())).collect();
    let t = MovingTriangulation::<G>::new(&places, Options::default()).expect("points in range");
    let wanted = ListsOf { squared_radii: &[4.0], mask: None, is_half: false };
    IS_COUNTING.store(true, Relaxed);
    let lists = t.neighbour_lists(&wanted).expect("room");
    IS_COUNTING.store(false, Relaxed);
    assert!(lists.neighbours.len() > 5 * n);
    TRACES.lock().expect("no panic while noting").drain(..).count()
}

/// One test, as the process must do nothing else meanwhile.
#[test]
fn commits_allocate_nothing_once_they_have_gone_round_and_lists_nothing_for_each_vertex() {
    IS_TESTING.set(true);
    for of_lists in [allocations_of_lists::<Plane>, allocations_of_lists::<Space>] {
        let [few, many] = [N, 8 * N].map(of_lists);
        println!("lists of {N} vertices: {few} allocations, of {}: {many}", 8 * N);
        // Arrays for parts of the vertices, which grow.
        assert!(0 < few && few < N / 4 && many < 2 * N);
    }
    let mut found = Vec::new();
    for (dimension, algorithm) in [2, 3].into_iter().flat_map(|d| steady_algorithms().map(move |a| (d, a))) {
        for displacement in displacements(dimension, algorithm) {
            let sites = match dimension {
                2 => allocations::<Plane>(algorithm, displacement),
                _ => allocations::<Space>(algorithm, displacement),
            };
            for (site, count) in sites {
                found.push(format!("{dimension}D, {algorithm:?}, within {displacement}: {count} at {site}"));
            }
        }
    }
    assert!(found.is_empty(), "allocations in {} commits:\n{}", COUNTED * PLACES, found.join("\n"));
}
