//! The kernel where memory runs out: every allocation of a call fails once, in turn. The call returns an error, and
//! what it says to have left alone is as it was. And what a triangulation says to hold is what it has asked for.
#![allow(unsafe_code)] // An allocator that fails has no other way to be one.

#[path = "common/random.rs"]
mod random;
#[allow(dead_code)] // Nothing is read here.
#[path = "saving_format/mod.rs"]
mod saving_format;

use deldrift::Error;
use deldrift::internals::{Delaunay, Insertion, PowerPlane, PowerSpace, Shortcut, SiteId, Slot};
use deldrift::motion::Level;
use deldrift::motion::{Algorithm, MovingTriangulation, Options, Saved};
use deldrift::{Dimension, Plane, Shape, Space, VertexId};
use random::Rng;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::ptr::null_mut;

struct Failing;

#[global_allocator]
static ALLOCATOR: Failing = Failing;

thread_local! {
    /// Allocations of this thread until one fails, ...
    static LEFT: Cell<u64> = const { Cell::new(u64::MAX) };
    /// ... whether all do from that one on, ...
    static FOR_GOOD: Cell<bool> = const { Cell::new(false) };
    /// ... and whether one has.
    static HAS_FAILED: Cell<bool> = const { Cell::new(false) };
    /// Bytes that this thread has asked for and not given back.
    static HELD: Cell<usize> = const { Cell::new(0) };
    /// The most of them at a time, as signed numbers: what other threads have asked for may be given back here.
    static MOST_HELD: Cell<isize> = const { Cell::new(0) };
}

/// What an allocation returns, counted.
fn counted(memory: *mut u8, before: usize, after: usize) -> *mut u8 {
    if !memory.is_null() {
        HELD.set(HELD.get().wrapping_add(after).wrapping_sub(before));
        MOST_HELD.set(MOST_HELD.get().max(HELD.get() as isize));
    }
    memory
}

fn fails() -> bool {
    match LEFT.get() {
        u64::MAX => return false,
        0 => {}
        left => {
            LEFT.set(left - 1);
            return false;
        }
    }
    if !FOR_GOOD.get() {
        LEFT.set(u64::MAX);
    }
    HAS_FAILED.set(true);
    true
}

// SAFETY: all is handed on to the system's allocator, or there is no memory.
unsafe impl GlobalAlloc for Failing {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promise.
        let memory = if fails() { null_mut() } else { unsafe { System.alloc(layout) } };
        counted(memory, 0, layout.size())
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        counted(memory, layout.size(), 0);
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the caller's promise.
        let moved = if fails() { null_mut() } else { unsafe { System.realloc(memory, layout, size) } };
        counted(moved, layout.size(), size)
    }
}

/// Does the work on something new each time, without the `k`-th allocation, or without those after it either, for all
/// `k` until it needs no more; returns how many there were. Afterwards `after` looks at what is left, and is told
/// whether the work has been done: what can do without goes on.
fn without_each<T>(
    make: impl Fn() -> T,
    mut work: impl FnMut(&mut T) -> Result<(), Error>,
    mut after: impl FnMut(&mut T, bool),
) -> u64 {
    let counts = [false, true].map(|for_good| {
        for k in 0.. {
            let mut t = make();
            FOR_GOOD.set(for_good);
            LEFT.set(k);
            let done = work(&mut t);
            LEFT.set(u64::MAX);
            let has_failed = HAS_FAILED.replace(false);
            if let Err(error) = &done {
                assert!(has_failed && matches!(error, Error::OutOfMemory { .. }), "{error}");
            }
            if !has_failed {
                return k;
            }
            after(&mut t, done.is_ok());
        }
        unreachable!()
    });
    counts.into_iter().min().expect("two")
}

fn point<G: Dimension>(rng: &mut Rng) -> G::Point {
    let mut p = G::Point::default();
    (0..G::D).for_each(|k| p[k] = rng.unit() - 0.5);
    p
}

fn random<G: Dimension>(n: usize) -> Vec<G::Point> {
    let rng = &mut Rng::new(1);
    (0..n).map(|_| point::<G>(rng)).collect()
}

/// A vertex in the middle of so many that all are its neighbours.
fn hub<G: Dimension>(n: usize) -> Vec<G::Point> {
    let mut points = random::<G>(n);
    for p in &mut points {
        let length = p.as_ref().iter().map(|x| x * x).sum::<f64>().sqrt();
        (0..G::D).for_each(|k| p[k] /= length);
    }
    points[0] = G::Point::default();
    points
}

fn built<G: Dimension>(points: &[G::Point]) -> Delaunay<G> {
    let mut t = Delaunay::<G>::default();
    t.add_sites(points).expect("room for it");
    t.rebuild(&mut |_| true).expect("room for it");
    t.record_changes(Vec::new());
    t
}

fn site_of<G: Dimension>(t: &Delaunay<G>, id: VertexId) -> SiteId {
    t.live_sites().find(|&s| t.site(s).id == id).expect("a site of each vertex")
}

fn is_valid<G: Dimension>(t: &Delaunay<G>) {
    t.validate(Level::Delaunay).expect("as it was");
}

fn builds<G: Dimension>() {
    let mut points = random::<G>(400);
    points[17] = points[300];
    let n = without_each(
        Delaunay::<G>::default,
        |t| {
            t.add_sites(&points)?;
            t.rebuild(&mut |_| true).map(|merges| assert_eq!(merges.len(), 1))
        },
        |_, _| {},
    );
    assert!(n > 10, "{n}");
    // Where there is no memory for parts, the whole is built on one thread.
    deldrift::internals::use_all_threads();
    let (points, options) = (random::<G>(2000), || Options { threads: 3, ..Options::default() });
    let n = without_each(
        || None,
        |t| MovingTriangulation::<G>::new(&points, options()).map(|built| *t = Some(built)),
        |t, is_done| assert_eq!(t.is_some(), is_done),
    );
    assert!(n > 20, "{n}");
}

fn inserts<G: Dimension>() {
    let far = |sign: f64| {
        let mut q = G::Point::default();
        (0..G::D).for_each(|k| q[k] = sign * (30.0 + k as f64));
        q
    };
    for (points, q) in [
        (random::<G>(300), G::Point::default()),
        (random::<G>(300), far(1.0)),
        (hub::<G>(400)[1..].to_vec(), G::Point::default()),
        (hub::<G>(40), hub::<G>(40)[7]),
        (random::<G>(1), far(1.0)),
    ] {
        let n = without_each(
            || built::<G>(&points),
            |t| {
                let s = t.add_site(q, VertexId::new(1000))?;
                t.insert_site(s, Slot::NONE)
                    .map(|_| ())
                    .inspect_err(|_| t.discard_site(s).expect("room was made for it"))
            },
            |t, is_done| {
                is_valid(t);
                if is_done {
                    return;
                }
                let s = t.add_site(q, VertexId::new(1000)).expect("room for it");
                let inserted = t.insert_site(s, Slot::NONE).expect("room for it");
                assert_eq!(inserted == Insertion::New, !points.contains(&q));
                is_valid(t);
            },
        );
        assert!(n > 0);
    }
}

fn removes<G: Dimension>() {
    for points in [random::<G>(300), hub::<G>(60), hub::<G>(300), random::<G>(G::D + 1), random::<G>(1)] {
        let n_corners = points.len();
        let n = without_each(
            || built::<G>(&points),
            |t| t.remove_site(site_of(t, VertexId::new(0))),
            |t, is_done| {
                if n_corners > G::D + 1 && !is_done {
                    is_valid(t);
                    t.remove_site(site_of(t, VertexId::new(0))).expect("room for it");
                    is_valid(t);
                }
            },
        );
        assert!(n > 0);
    }
}

fn relocates<G: Dimension>() {
    for points in [random::<G>(300), hub::<G>(300), random::<G>(G::D + 1)] {
        let mut near = points[0];
        near[0] += 0.03;
        for (q, shortcut) in [
            (points[0], Shortcut::Flips),
            (near, Shortcut::Flips),
            (random::<G>(1000)[999], Shortcut::Flips),
            (hub::<G>(2)[1], Shortcut::Certificates),
            (points[1], Shortcut::Flips),
        ] {
            without_each(
                || built::<G>(&points),
                |t| t.relocate_site(site_of(t, VertexId::new(0)), &q, VertexId::new(0), shortcut).map(|_| ()),
                |t, is_done| {
                    if is_done && t.has_cells() {
                        is_valid(t);
                    }
                },
            );
        }
    }
}

fn answers<G: Dimension>() {
    for points in [random::<G>(300), hub::<G>(300)[1..].to_vec()] {
        let n = without_each(
            || MovingTriangulation::<G>::new(&points, Options::default()).expect("room for it"),
            |t| {
                t.tolerance(VertexId::new(0))?;
                t.nearest_vertex(&G::Point::default()).map(|nearest| assert!(nearest.is_some()))
            },
            |_, _| {},
        );
        assert!(n < 1000);
    }
    let t = built::<G>(&random::<G>(300));
    LEFT.set(0);
    let validated = t.validate(Level::Delaunay);
    assert_eq!(LEFT.replace(u64::MAX), 0, "needs no memory");
    assert!(!HAS_FAILED.get());
    validated.expect("a Delaunay triangulation");
}

#[test]
fn triangulations_of_the_plane_are_left_alone() {
    builds::<Plane>();
    inserts::<Plane>();
    removes::<Plane>();
    relocates::<Plane>();
    answers::<Plane>();
}

#[test]
fn triangulations_of_space_are_left_alone() {
    builds::<Space>();
    inserts::<Space>();
    removes::<Space>();
    relocates::<Space>();
    answers::<Space>();
}

type Call<G> = fn(&mut MovingTriangulation<G>, &<G as Shape>::Point) -> Result<(), Error>;

/// A vertex goes next to another one, one comes, one goes, each without every allocation in turn: positions and cells
/// are as they were.
/// Keys of so many vertices, or their ids.
fn keyed<G: Dimension>(points: &[G::Point], options: Options, has_keys: bool) -> MovingTriangulation<G> {
    let keys: Vec<u64> = (0..points.len() as u64).map(|v| 7 * v % 11).collect();
    if has_keys {
        MovingTriangulation::with_keys(points, &keys, options).expect("room")
    } else {
        MovingTriangulation::new(points, options).expect("room")
    }
}

fn immediate_calls<G: Dimension>(algorithm: Algorithm, has_keys: bool) {
    let mut points = random::<G>(60);
    points[7] = points[30];
    let make = || {
        let options = Options { algorithm, threads: 1, ..Options::default() };
        let mut t = keyed::<G>(&points, options, has_keys);
        for p in [points[1], points[2]] {
            // What the algorithm keeps for such calls is there.
            t.relocate_vertex(VertexId::new(1), &p).expect("room");
        }
        // Who reads the cells follows the changes, which takes memory.
        t.cells().expect("room");
        t
    };
    let state = |t: &MovingTriangulation<G>| {
        let positions: Vec<_> = (0..t.id_count()).map(|v| t.position(VertexId::new(v as u32)).ok()).collect();
        let keys: Vec<_> = (0..t.id_count()).map(|v| t.key_of_id(VertexId::at(v))).collect();
        (positions, keys, t.has_keys(), t.cells().expect("room").corners.to_vec())
    };
    let before = state(&make());
    let mut after = |t: &mut MovingTriangulation<G>, is_done: bool| {
        t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("{algorithm:?}: {violation}"));
        assert!(is_done || state(t) == before, "{algorithm:?}");
    };
    let near: G::Point = {
        let mut p = points[40];
        p[0] += 1e-3;
        p
    };
    let calls: [Call<G>; 8] = [
        |t, p| t.relocate_vertex(VertexId::new(5), p),
        |t, _| {
            // By flips.
            let mut p = t.position(VertexId::new(9)).expect("a vertex");
            (0..G::D).for_each(|k| p[k] += 0.04);
            t.relocate_vertex(VertexId::new(9), &p)
        },
        |t, p| t.relocate_vertex(VertexId::new(30), p),
        |t, p| t.insert_vertex(p).map(drop),
        |t, p| t.insert_vertex_with_key(p, 4).map(drop),
        |t, _| {
            // It takes the place of another one.
            let there = t.position(VertexId::new(19)).expect("a vertex");
            t.insert_vertex_with_key(&there, 0).map(drop)
        },
        |t, p| t.stage_insertions_at_free_ids(&[*p, *p], Some(&[5, 6]), |_| {}),
        |t, _| t.remove_vertex(VertexId::new(30)),
    ];
    let n_refused: u64 = calls.map(|call| without_each(make, |t| call(t, &near), &mut after)).iter().sum();
    assert!(n_refused > 0, "{algorithm:?}");
}

#[test]
fn immediate_calls_leave_all_alone() {
    for algorithm in Algorithm::ALL {
        for has_keys in [false, true] {
            immediate_calls::<Plane>(algorithm, has_keys);
        }
        for has_keys in [false, true] {
            immediate_calls::<Space>(algorithm, has_keys);
        }
    }
}

/// All vertices move, by one call or staged before, without every allocation in turn: positions and cells are as they
/// were, and what is staged still is.
fn commits<G: Dimension>(algorithm: Algorithm, size: f64) {
    let rng = &mut Rng::new(9);
    let points = random::<G>(120);
    let mut moved = points.clone();
    for p in &mut moved {
        (0..G::D).for_each(|k| p[k] += size * (rng.unit() - 0.5));
    }
    let make = || {
        let options = Options { algorithm, threads: 1, ..Options::default() };
        let t = MovingTriangulation::<G>::new(&points, options).expect("room");
        t.cells().expect("room");
        t
    };
    let staged = || {
        let mut t = make();
        t.move_all(&moved).expect("room");
        t
    };
    let cells = |t: &MovingTriangulation<G>| t.cells().expect("room").corners.to_vec();
    let before = cells(&make());
    let is_as_before = |t: &MovingTriangulation<G>| {
        for (v, p) in points.iter().enumerate() {
            assert_eq!(t.position(VertexId::new(v as u32)), Ok(*p), "{algorithm:?}");
        }
        assert!(cells(t) == before, "{algorithm:?}");
    };
    let is_valid = |t: &MovingTriangulation<G>| {
        t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("{algorithm:?}: {violation}"));
    };
    let at_once = without_each(
        make,
        |t| t.commit_positions(&moved).map(drop),
        |t, is_done| if is_done { is_valid(t) } else { is_as_before(t) },
    );
    let in_two = without_each(
        staged,
        |t| t.commit_timestamp().map(drop),
        |t, is_done| {
            if !is_done {
                is_as_before(t);
                assert_eq!(t.staged_count(), points.len());
                t.commit_timestamp().expect("room");
            }
            is_valid(t);
        },
    );
    assert!(at_once.min(in_two) > 0, "{algorithm:?}");
}

#[test]
fn commits_leave_all_alone() {
    for algorithm in Algorithm::ALL {
        for size in [1e-3, 0.1] {
            commits::<Plane>(algorithm, size);
            commits::<Space>(algorithm, size);
        }
    }
}

/// After each change the bytes that the triangulation says to hold are those that the allocator has given and not got
/// back. Some vertices share a place.
fn holds_what_it_says<G: Dimension>(algorithm: Algorithm, has_keys: bool) {
    let rng = &mut Rng::new(4);
    let mut points = random::<G>(400);
    points[7] = points[300];
    let before = HELD.get();
    let options = Options { algorithm, threads: 1, ..Options::default() };
    let mut t = keyed::<G>(&points, options, has_keys);
    let same = |t: &MovingTriangulation<G>, when: &str| {
        assert_eq!(t.memory_bytes(), HELD.get() - before, "{algorithm:?} {when}");
    };
    same(&t, "at first");
    for (round, size) in [1e-6, 1e-3, 0.02, 1e-3].into_iter().enumerate() {
        for p in &mut points {
            (0..G::D).for_each(|k| p[k] += size * (rng.unit() - 0.5));
        }
        if round % 2 == 0 {
            t.move_all(&points).expect("room");
            same(&t, "with all staged");
            t.commit_timestamp().expect("room");
        } else {
            t.commit_positions(&points).expect("room");
        }
        same(&t, "after a commit");
        t.cells().expect("room");
        same(&t, "with cells");
        t.take_changes().expect("room");
        same(&t, "with changes");
        t.relocate_vertex(VertexId::new(3), &points[4]).expect("room");
        t.relocate_vertex(VertexId::new(3), &points[3]).expect("room");
        same(&t, "after relocations");
    }
    for k in 0..20 {
        t.insert_vertex(&point::<G>(rng)).expect("room");
        t.remove_vertex(VertexId::new(2 * k)).expect("room");
    }
    same(&t, "after edits");
    let gone: [VertexId; 50] = std::array::from_fn(|k| VertexId::new(50 + k as u32));
    t.stage_removals(&gone).expect("room");
    t.stage_insertions(&random::<G>(30)).expect("room");
    t.move_vertices(&[VertexId::new(200)], &[points[201]]).expect("room");
    same(&t, "with staged edits");
    t.commit_timestamp().expect("room");
    same(&t, "after staged edits");
    t.stage_insertions_at_free_ids(&random::<G>(9), Some(&[3; 9]), |_| {}).expect("room");
    same(&t, "with keys staged");
    t.commit_timestamp().expect("room");
    same(&t, "with keys");
    t.take_changes().expect("room");
    let ids = t.compact().expect("room");
    drop(ids);
    same(&t, "after a compaction");
    drop(t);
    assert_eq!(HELD.get(), before);
}

#[test]
fn triangulations_hold_what_they_say() {
    for algorithm in Algorithm::ALL {
        for has_keys in [false, true] {
            holds_what_it_says::<Plane>(algorithm, has_keys);
            holds_what_it_says::<Space>(algorithm, has_keys);
        }
    }
}

/// Bytes that a load holds at most, and the processor time that it takes, in seconds.
fn cost_of_loading(dimension: usize, bytes: &[u8]) -> (usize, f64) {
    let options = Options { threads: 1, ..Options::default() };
    let before = HELD.get() as isize;
    MOST_HELD.set(before);
    let start = processor_time();
    let saved = Saved::of(bytes).expect("its header is right");
    // What is wrong is tested elsewhere.
    match (dimension, saved.is_weighted()) {
        (2, false) => drop(MovingTriangulation::<Plane>::load(&saved, options)),
        (_, false) => drop(MovingTriangulation::<Space>::load(&saved, options)),
        (2, true) => drop(
            MovingTriangulation::<PowerPlane>::load(&saved, options).expect("cells and who is above them"),
        ),
        (_, true) => drop(
            MovingTriangulation::<PowerSpace>::load(&saved, options).expect("cells and who is above them"),
        ),
    }
    let time = processor_time() - start;
    assert_eq!(HELD.get() as isize, before);
    ((MOST_HELD.get() - before) as usize, time)
}

/// Of this thread.
fn processor_time() -> f64 {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: there is room for the answer.
    assert_eq!(unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &mut time) }, 0);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// Memory and time of loading follow the size of the data, whatever these are: 16 bytes a byte at most, and eight times
/// the data take less than three times as long for each byte.
#[test]
fn loading_costs_in_proportion_to_the_data() {
    for dimension in [2, 3] {
        let all = |n: usize| {
            let mut all = saving_format::forged::of_wrong_hulls(dimension, n);
            all.extend(saving_format::forged::legal(dimension, n));
            all.push(("covered", saving_format::forged::covered(dimension, n)));
            all
        };
        for ((name, small), (_, large)) in all(4_000).into_iter().zip(all(32_000)) {
            let times = [small, large].map(|parts| {
                let bytes = parts.bytes();
                let (held, _) = cost_of_loading(dimension, &bytes);
                let share = held as f64 / bytes.len() as f64;
                println!("{dimension}D, {name}: {} bytes, {share:.1} held for each", bytes.len());
                assert!(share < 16.0, "{dimension}D, {name}: {held} bytes for {}", bytes.len());
                let times = (0..3).map(|_| cost_of_loading(dimension, &bytes).1);
                times.fold(f64::INFINITY, f64::min) / bytes.len() as f64
            });
            let ratio = times[1] / times[0];
            println!(
                "{dimension}D, {name}: {:.1} ns a byte, {ratio:.2} times as much in the long run",
                1e9 * times[0]
            );
            assert!(ratio < 3.0, "{dimension}D, {name}: {times:?}");
        }
    }
}
