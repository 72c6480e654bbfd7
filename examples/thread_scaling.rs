//! What more threads bring, and what it costs to divide work into parts: build, sweep and commits, in ns per vertex.
//!
//! ```text
//! cargo run --release --example thread_scaling [kind] [points [threads[:parts]...]]
//! ```
//!
//! By default 1,000,000 points and 1 and 2 threads, with a part for each. The points are about 1 apart: *random* ones,
//! uniform in a square or cube, or those of a *lattice* or a *sphere*. *Build* creates the triangulation. *Sorting* is by
//! what the first repair after it takes longer than the second one: the first sorts the cells, if they are many, and gets
//! memory. *Sweep*, *repair* and *mending* are commits by repair in which all vertices move, by up to half of a
//! billionth, a thousandth and a fiftieth of a spacing along each axis: in the first every certificate is checked and
//! nothing mended, in the last most of the time goes into flips. *Leaps* are placements of one vertex in a hundred,
//! anywhere, in ns per vertex that moves, and *jumps* those of one vertex in 33, up to half a spacing away; both are done
//! by one thread.
//! *Rebuilding* moves no vertex, and triangulates all again. Divisions take turns, so that whatever else the
//! machine does falls upon all alike; printed are the median of all rounds, the least, and how many times faster the
//! medians and the least are than with the first division.

mod common;

use common::Rng;
use deldrift::motion::{Algorithm, Level, MovingTriangulation, Options};
use deldrift::{Dimension, Plane, Space, VertexId};
use std::f64::consts::TAU;
use std::time::Instant;

const ROUNDS: usize = 7;
const STEPS: [&str; 8] = ["build", "sorting", "sweep", "repair", "mending", "leaps", "jumps", "rebuilding"];

/// Threads, and parts into which work is divided; 0 for one for each thread.
type Division = (u32, usize);

/// So many points, about 1 apart; of a lattice, as many as make it a square or cube.
fn draw<G: Dimension>(kind: &str, n: usize, random: &mut Rng) -> Vec<G::Point> {
    let side = (n as f64).powf(1.0 / G::D as f64);
    let mut points = vec![G::Point::default(); n];
    match kind {
        "lattice" => {
            let side = side.round() as usize;
            points.resize(side.pow(G::D as u32), G::Point::default());
            for (i, p) in points.iter_mut().enumerate() {
                (0..G::D).for_each(|k| p[k] = (i / side.pow(k as u32) % side) as f64);
            }
        }
        "sphere" => {
            let radius = if G::D == 2 { n as f64 / TAU } else { (n as f64 / (2.0 * TAU)).sqrt() };
            for p in &mut points {
                let squared = |p: &G::Point| (0..G::D).map(|k| p[k] * p[k]).sum::<f64>();
                while !(1e-6..0.25).contains(&squared(p)) {
                    (0..G::D).for_each(|k| p[k] = random.unit() - 0.5);
                }
                let to_sphere = radius / squared(p).sqrt();
                (0..G::D).for_each(|k| p[k] *= to_sphere);
            }
        }
        "random" => shake::<G>(&mut points, side, random),
        _ => panic!("the kinds are random, lattice and sphere"),
    }
    points
}

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
fn round<G: Dimension>(points: &[G::Point], (threads, parts): Division) -> [f64; STEPS.len()] {
    let mut random = Rng::new(1);
    let mut points = points.to_vec();
    let options = Options { algorithm: Algorithm::Repair, threads, parts, ..Options::default() };
    let start = Instant::now();
    let mut t = MovingTriangulation::<G>::new(&points, options).expect("finite positions");
    let build = start.elapsed().as_secs_f64() * 1e9 / points.len() as f64;
    let [first, second] = [(); 2].map(|()| {
        shake::<G>(&mut points, 1e-3, &mut random);
        t.move_all(&points).expect("finite positions");
        commit(&mut t)
    });
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
    [build, first - second, sweep, repair, mending, leaps, jumps, rebuilding]
}

fn print<G: Dimension>(kind: &str, n: usize, divisions: &[Division]) {
    let points = draw::<G>(kind, n, &mut Rng::new(7));
    let mut figures = vec![[(); STEPS.len()].map(|()| Vec::new()); divisions.len()];
    for _ in 0..ROUNDS {
        for (figures, &division) in figures.iter_mut().zip(divisions) {
            for (figures, figure) in figures.iter_mut().zip(round::<G>(&points, division)) {
                figures.push(figure);
            }
        }
    }
    for (step, name) in STEPS.iter().enumerate() {
        let mut first = None;
        for (figures, (threads, parts)) in figures.iter_mut().zip(divisions) {
            let figures = &mut figures[step];
            figures.sort_by(f64::total_cmp);
            let (median, least) = (figures[ROUNDS / 2], figures[0]);
            let first = first.get_or_insert([median, least]);
            println!(
                "{}D {} {kind} points, {name:10} {threads:2} threads, {parts:2} parts: \
                 {median:8.1} ns, least {least:8.1}; {:.2} and {:.2} times as fast",
                G::D,
                points.len(),
                first[0] / median,
                first[1] / least
            );
        }
    }
}

fn main() {
    let mut args = std::env::args().skip(1).peekable();
    let is_kind = |arg: &String| arg.starts_with(char::is_alphabetic);
    let kind = args.next_if(is_kind).unwrap_or("random".to_string());
    let n = args.next().map_or(1_000_000, |n| n.parse().expect("a number of points"));
    let mut divisions: Vec<Division> = args
        .map(|division| {
            let (threads, parts) = division.split_once(':').unwrap_or((&division, "0"));
            (threads.parse().expect("a number of threads"), parts.parse().expect("a number of parts"))
        })
        .collect();
    if divisions.is_empty() {
        divisions = vec![(1, 0), (2, 0)];
    }
    print::<Plane>(&kind, n, &divisions);
    print::<Space>(&kind, n, &divisions);
}
