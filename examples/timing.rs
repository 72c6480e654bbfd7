//! Static build, rebuilding commit and placement commit of random points, in ns per vertex.
mod common;

use common::{Rng, in_cube};
use deldrift::motion::*;
use deldrift::{Dimension, Plane, Space};
use std::time::Instant;

fn run<G: Dimension>(n: usize) {
    let mut r = Rng::new(7);
    let side = (n as f64).powf(1.0 / G::D as f64);
    let mut p: Vec<G::Point> = (0..n).map(|_| in_cube::<G>(&mut r, side)).collect();
    let repeats = (300_000 / n).max(1);
    let mut best = f64::MAX;
    for _ in 0..repeats.max(3) {
        let t0 = Instant::now();
        let t = MovingTriangulation::<G>::new(&p, Options::default()).unwrap();
        best = best.min(t0.elapsed().as_secs_f64());
        drop(t);
    }
    let mut t =
        MovingTriangulation::<G>::new(&p, Options { algorithm: Algorithm::Rebuilding, ..Options::default() })
            .unwrap();
    print!("{}D n {n:8}: build {:7.1}", G::D, best * 1e9 / n as f64);
    print!(
        "  cells/n {:.2} bytes/n {:.1}",
        t.cell_count() as f64 / n as f64,
        t.memory_bytes() as f64 / n as f64
    );
    for (name, a) in [
        ("rebuild", Algorithm::Rebuilding),
        ("place", Algorithm::Placement),
        ("flips", Algorithm::PlacementFlips),
    ] {
        t.set_algorithm(a);
        let mut best = f64::MAX;
        for _ in 0..(repeats / 4).max(3) {
            for x in &mut p {
                for k in 0..G::D {
                    x[k] += 0.1 * (r.unit() - 0.5);
                }
            }
            let t0 = Instant::now();
            t.move_all(&p).unwrap();
            let rep = t.commit_timestamp().unwrap();
            best = best.min(t0.elapsed().as_secs_f64());
            std::hint::black_box(rep);
        }
        print!("  {name} {:7.1}", best * 1e9 / n as f64);
    }
    println!("  bytes/n {:.1}", t.memory_bytes() as f64 / n as f64);
    t.validate(Level::Delaunay).unwrap();
}

fn main() {
    for n in [1_000, 10_000, 100_000, 1_000_000] {
        run::<Plane>(n);
    }
    for n in [1_000, 10_000, 100_000, 1_000_000] {
        run::<Space>(n);
    }
}
