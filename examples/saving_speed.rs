//! Saving, loading and cloning beside a build from nothing, of random points, on one thread: ns per vertex, and bytes.
mod common;

use common::{Rng, in_cube};
use deldrift::motion::*;
use deldrift::{Dimension, Error, Plane, Space};
use std::time::Instant;

/// The shortest of a few times, in nanoseconds for each vertex, and what came of it.
fn best<T>(n: usize, mut work: impl FnMut() -> T) -> (f64, T) {
    let mut best = None;
    for _ in 0..5 {
        let start = Instant::now();
        let made = work();
        let time = start.elapsed().as_secs_f64() * 1e9 / n as f64;
        if best.as_ref().is_none_or(|(least, _)| time < *least) {
            best = Some((time, made));
        }
    }
    best.expect("there were some")
}

fn options() -> Options {
    Options { threads: 1, ..Options::default() }
}

fn run<G: Dimension>(n: usize) {
    let mut rng = Rng::new(7);
    let side = (n as f64).powf(1.0 / G::D as f64);
    let mut positions: Vec<G::Point> = (0..n).map(|_| in_cube::<G>(&mut rng, side)).collect();
    let (build, mut t) = best(n, || MovingTriangulation::<G>::new(&positions, options()).expect("a build"));
    let (fill, _) = best(1, || t.cells().expect("room").corners.len());
    // Slots and cells are in another order than those of a build.
    for p in &mut positions {
        (0..G::D).for_each(|k| p[k] += 0.1 * (rng.unit() - 0.5));
    }
    t.commit_positions(&positions).expect("a commit");
    t.cells().expect("room");
    let (save, bytes) = best(n, || t.saved().expect("room"));
    let (load, loaded) = best(n, || {
        let saved = Saved::of(&bytes).expect("saved");
        MovingTriangulation::<G>::load(&saved, options()).expect("a triangulation")
    });
    let (check, _) = best(n, || Saved::of(&bytes).expect("saved").dimension());
    let (clone, _) = best(n, || t.try_clone(None).expect("room"));
    let (vtu, _) = best(n, || t.write_vtu::<Error>(&[], &[], |_| Ok(())));
    let (medit, _) = best(n, || t.write_medit::<Error>(|_| Ok(())));
    assert!(loaded.saved().expect("room") == bytes && fill > 0.0);
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
