//! What more threads bring: build, sweep and commits of random points, in ns per vertex.
//!
//! ```text
//! cargo run --release --example thread_scaling [points [threads...]]
//! ```
//!
//! By default 1,000,000 points and 1 and 2 threads. The points are uniform in a square or cube. *Build* creates the
//! triangulation. *Sweep*, *repair* and *mending* are commits by repair in which all vertices move, by up to half of a
//! billionth, a thousandth and a fiftieth of a spacing along each axis: in the first every certificate is checked and
//! nothing mended, in the last most of the time goes into flips. *Leaps* are placements of one vertex in a hundred,
//! anywhere, in ns per vertex that moves, and *jumps* those of one vertex in 33, up to half a spacing away; both are done
//! by one thread.
//! *Rebuilding* moves no vertex, and triangulates all again. Thread counts take turns, so that whatever else the
//! machine does falls upon all alike; printed are the median of all rounds, the least, and how many times faster the
//! medians and the least are than with the first thread count.

mod common;

use common::Rng;
use deldrift::motion::{Algorithm, Level, MovingTriangulation, Options};
use deldrift::{Dimension, Plane, Space, VertexId};
use std::time::Instant;

const ROUNDS: usize = 7;
const STEPS: [&str; 7] = ["build", "sweep", "repair", "mending", "leaps", "jumps", "rebuilding"];

/// Moves each coordinate by up to half of `size` either way.
fn shake<G: Dimension>(points: &mut [G::Point], size: f64, random: &mut Rng) {
    for p in points {
        for k in 0..G::D {
            p[k] += size * (random.unit() - 0.5);
        }
    }
}

/// Commits what is staged; ns for each vertex.
fn commit<G: Dimension>(t: &mut MovingTriangulation<G>) -> f64 {
    let start = Instant::now();
    t.commit_timestamp().expect("finite positions");
    start.elapsed().as_secs_f64() * 1e9 / t.vertex_count() as f64
}

/// Moves every `nth` vertex by up to half of `size` either way, or anywhere, and commits that by placements; ns for
/// each vertex that is moved.
fn commit_few<G: Dimension>(
    t: &mut MovingTriangulation<G>,
    points: &mut [G::Point],
    nth: usize,
    size: f64,
    random: &mut Rng,
) -> f64 {
    let (mut vertices, mut places) = (Vec::new(), Vec::new());
    for v in (0..points.len()).step_by(nth) {
        let mut place = [points[v]];
        if size.is_finite() {
            shake::<G>(&mut place, size, random);
        } else {
            place = [points[(random.unit() * points.len() as f64) as usize]];
            shake::<G>(&mut place, 0.5, random);
        }
        points[v] = place[0];
        vertices.push(VertexId::at(v));
        places.push(place[0]);
    }
    t.set_algorithm(Algorithm::PlacementFlips);
    t.move_vertices(&vertices, &places).expect("finite positions");
    commit(t) * points.len() as f64 / vertices.len() as f64
}

/// One round: the figures of all steps.
fn round<G: Dimension>(points: &[G::Point], threads: u32) -> [f64; STEPS.len()] {
    let mut random = Rng::new(1);
    let mut points = points.to_vec();
    let options = Options { algorithm: Algorithm::Repair, threads, ..Options::default() };
    let start = Instant::now();
    let mut t = MovingTriangulation::<G>::new(&points, options).expect("finite positions");
    let build = start.elapsed().as_secs_f64() * 1e9 / points.len() as f64;
    // The first repair after a build sorts the cells.
    for _ in 0..2 {
        shake::<G>(&mut points, 1e-3, &mut random);
        t.move_all(&points).expect("finite positions");
        commit(&mut t);
    }
    let mut commit_all = |algorithm, size, points: &mut [G::Point]| {
        shake::<G>(points, size, &mut random);
        t.move_all(points).expect("finite positions");
        t.set_algorithm(algorithm);
        commit(&mut t)
    };
    let sweep = commit_all(Algorithm::Repair, 1e-9, &mut points);
    let repair = commit_all(Algorithm::Repair, 1e-3, &mut points);
    let mending = commit_all(Algorithm::Repair, 2e-2, &mut points);
    // Once before, as long walks make landmarks for those that follow.
    commit_few::<G>(&mut t, &mut points, 100, f64::INFINITY, &mut random);
    let leaps = commit_few::<G>(&mut t, &mut points, 100, f64::INFINITY, &mut random);
    let jumps = commit_few::<G>(&mut t, &mut points, 33, 1.0, &mut random);
    t.move_all(&points).expect("finite positions");
    t.set_algorithm(Algorithm::Rebuilding);
    let rebuilding = commit(&mut t);
    if points.len() <= 100_000 {
        t.validate(Level::Delaunay).expect("a Delaunay triangulation");
    }
    [build, sweep, repair, mending, leaps, jumps, rebuilding]
}

fn print<G: Dimension>(n: usize, threads: &[u32]) {
    let mut random = Rng::new(7);
    let side = (n as f64).powf(1.0 / G::D as f64);
    let mut points = vec![G::Point::default(); n];
    shake::<G>(&mut points, side, &mut random);
    let mut figures = vec![[(); STEPS.len()].map(|()| Vec::new()); threads.len()];
    for _ in 0..ROUNDS {
        for (figures, &threads) in figures.iter_mut().zip(threads) {
            for (figures, figure) in figures.iter_mut().zip(round::<G>(&points, threads)) {
                figures.push(figure);
            }
        }
    }
    for (step, name) in STEPS.iter().enumerate() {
        let mut first = None;
        for (figures, threads) in figures.iter_mut().zip(threads) {
            let figures = &mut figures[step];
            figures.sort_by(f64::total_cmp);
            let (median, least) = (figures[ROUNDS / 2], figures[0]);
            let first = first.get_or_insert([median, least]);
            println!(
                "{}D {n} points, {name:10} {threads:2} threads: {median:8.1} ns, least {least:8.1}; {:.2} and {:.2} times as fast",
                G::D,
                first[0] / median,
                first[1] / least
            );
        }
    }
}

fn main() {
    let numbers: Vec<usize> = std::env::args().skip(1).map(|arg| arg.parse().expect("numbers")).collect();
    let n = numbers.first().copied().unwrap_or(1_000_000);
    let threads: Vec<u32> = match numbers.get(1..) {
        Some(threads) if !threads.is_empty() => threads.iter().map(|&t| t as u32).collect(),
        _ => vec![1, 2],
    };
    print::<Plane>(n, &threads);
    print::<Space>(n, &threads);
}
