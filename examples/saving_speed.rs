//! Saving, loading and cloning beside a build from nothing, of random points, on one thread: ns of processor time per
//! vertex, and bytes.
mod common;

use common::{Rng, in_cube};
use deldrift::motion::*;
use deldrift::{Dimension, Error, Plane, Space};
use std::time::Instant;

/// Nanoseconds that this thread has been on a processor; where the system does not tell, that have passed.
fn now(start: Instant) -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let on_processor = told.and_then(|told| told.split(' ').next()?.parse().ok());
    on_processor.unwrap_or_else(|| start.elapsed().as_secs_f64() * 1e9)
}

/// The mean time of a work, for each of `n` vertices, and what came of it.
fn mean<T>(n: usize, work: impl Fn() -> T) -> (f64, T) {
    // The system tells times in steps of some milliseconds.
    let rounds = (2_000_000 / n).max(2);
    let start = Instant::now();
    let before = now(start);
    for _ in 1..rounds {
        work();
    }
    let made = work();
    ((now(start) - before) / (n * rounds) as f64, made)
}

fn options() -> Options {
    Options { threads: 1, ..Options::default() }
}

fn run<G: Dimension>(n: usize) {
    let mut rng = Rng::new(7);
    let side = (n as f64).powf(1.0 / G::D as f64);
    let mut positions: Vec<G::Point> = (0..n).map(|_| in_cube::<G>(&mut rng, side)).collect();
    let (build, mut t) = mean(n, || MovingTriangulation::<G>::new(&positions, options()).expect("a build"));
    // Slots and cells are in another order than those of a build.
    for p in &mut positions {
        (0..G::D).for_each(|k| p[k] += 0.1 * (rng.unit() - 0.5));
    }
    t.commit_positions(&positions).expect("a commit");
    t.cells().expect("room");
    let (save, bytes) = mean(n, || t.saved().expect("room"));
    let (load, loaded) = mean(n, || {
        let saved = Saved::of(&bytes).expect("saved");
        MovingTriangulation::<G>::load(&saved, options()).expect("a triangulation")
    });
    let (check, _) = mean(n, || Saved::of(&bytes).expect("saved").dimension());
    let (clone, _) = mean(n, || t.try_clone(None).expect("room"));
    let (vtu, _) = mean(n, || t.write_vtu::<Error>(&[], &[], |_| Ok(())));
    let (medit, _) = mean(n, || t.write_medit::<Error>(None, |_| Ok(())));
    assert!(loaded.saved().expect("room") == bytes);
    let size = bytes.len() as f64 / n as f64;
    println!(
        "{}D {n:8}: build {build:7.1} ns, save {save:6.1}, load {load:6.1} (checksum {check:5.1}), clone {clone:6.1}, \
         vtu {vtu:6.1}, medit {medit:6.1}; {size:5.1} bytes; build / load {:4.2}",
        G::D,
        build / load
    );
}

fn main() {
    for n in [10_000, 100_000, 1_000_000] {
        run::<Plane>(n);
    }
    for n in [10_000, 100_000, 1_000_000] {
        run::<Space>(n);
    }
}
