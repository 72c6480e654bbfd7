//! What the *tolerance* algorithm costs, by the share of the vertices that stay within their tolerance.
//!
//! 10,000 random points at unit density; at every timestamp each moves by the same distance in a random
//! direction. All algorithms commit the same positions. Times are those of the commits, in ns per vertex,
//! the least of [`REPEATS`] replays:
//!
//! - *rebuilding*, *tolerance*, *repair*, *watching*, *slack* and *auto*;
//! - *removal, insertion*: the report's placement (section 3.1), without
//!   a look at whether anything must change;
//! - *placement* and *by flips*: with the improvements of section 3.2.
//!
//! Then, for 100,000 points, commits in which all vertices stay within tolerance: the cost of the test
//! alone. *Staging* is what it takes to hand the positions over, whatever the algorithm.
//!
//! `cargo run --release --example tolerance_share`
mod common;

use std::time::Instant;

use common::{Rng, in_ball, in_cube};
use deldrift::motion::{Algorithm, MovingTriangulation, Options};
use deldrift::{Dimension, Plane, Space, VertexId};

const N: usize = 10_000;
const COMMITS: usize = 10;
const REPEATS: usize = 3;

/// Random points, and where they are at each timestamp.
fn walk<G: Dimension>(n: usize, step: f64, commits: usize) -> Vec<Vec<G::Point>> {
    let random = &mut Rng::new(1);
    let side = (n as f64).powf(1.0 / G::D as f64);
    let mut now: Vec<G::Point> = (0..n).map(|_| in_cube::<G>(random, side)).collect();
    let mut all = vec![now.clone()];
    for _ in 0..commits {
        for p in &mut now {
            let mut direction = in_ball::<G>(random, 1.0);
            let length = direction.as_ref().iter().map(|x| x * x).sum::<f64>().sqrt();
            for k in 0..G::D {
                direction[k] *= step / length;
                p[k] += direction[k];
            }
        }
        all.push(now.clone());
    }
    all
}

/// Nanoseconds per vertex of a commit, and the share within tolerance. The first commit, which computes what
/// later ones use, is not counted.
fn time<G: Dimension>(algorithm: Algorithm, timestamps: &[Vec<G::Point>]) -> (f64, f64) {
    let options = Options { algorithm, ..Options::default() };
    let mut t = MovingTriangulation::<G>::new(&timestamps[0], options).expect("points in range");
    t.commit_timestamp().expect("a commit");
    let (mut seconds, mut within) = (0.0, 0);
    for positions in &timestamps[1..] {
        t.move_all(positions).expect("positions in range");
        let start = Instant::now();
        let report = t.commit_timestamp().expect("a commit");
        seconds += start.elapsed().as_secs_f64();
        within += report.within_tolerance;
    }
    let vertices = (timestamps[0].len() * (timestamps.len() - 1)) as f64;
    (1e9 * seconds / vertices, within as f64 / vertices)
}

/// Nanoseconds per vertex of a removal and an insertion.
fn time_of_replacing<G: Dimension>(timestamps: &[Vec<G::Point>]) -> f64 {
    let mut t = MovingTriangulation::<G>::new(&timestamps[0], Options::default()).expect("points in range");
    let mut ids: Vec<VertexId> = VertexId::range(0..timestamps[0].len()).collect();
    let start = Instant::now();
    for (id, p) in ids.iter_mut().zip(&timestamps[1]) {
        t.remove_vertex(*id).expect("present");
        *id = t.insert_vertex(p).expect("in range");
    }
    1e9 * start.elapsed().as_secs_f64() / ids.len() as f64
}

fn sweep<G: Dimension>(steps: &[f64]) {
    println!("{}D, {N} points: ns per vertex", G::D);
    println!(
        "      step  within  rebuilding  removal, insertion  placement  by flips  tolerance  repair \
         watching   slack    auto"
    );
    for &step in steps {
        let timestamps = walk::<G>(N, step, COMMITS);
        let (mut best, mut share) = ([f64::INFINITY; 9], 0.0);
        // In turn, so that what else the machine does troubles all alike.
        for _ in 0..REPEATS {
            let tolerance = time::<G>(Algorithm::Tolerance, &timestamps);
            let now = [
                time::<G>(Algorithm::Rebuilding, &timestamps).0,
                time_of_replacing::<G>(&timestamps),
                time::<G>(Algorithm::Placement, &timestamps).0,
                time::<G>(Algorithm::PlacementFlips, &timestamps).0,
                tolerance.0,
                time::<G>(Algorithm::Repair, &timestamps).0,
                time::<G>(Algorithm::Watching, &timestamps).0,
                time::<G>(Algorithm::Slack, &timestamps).0,
                time::<G>(Algorithm::Auto, &timestamps).0,
            ];
            best.iter_mut().zip(now).for_each(|(best, now)| *best = best.min(now));
            share = tolerance.1;
        }
        let [rebuilding, replacing, placement, flips, tolerance, repair, watching, slack, auto] = best;
        println!(
            "{step:10.1e} {:6.1}% {rebuilding:11.1} {replacing:19.1} {placement:10.1} {flips:9.1} {tolerance:10.1} \
             {repair:7.1} {watching:9.1} {slack:7.1} {auto:7.1}",
            100.0 * share
        );
    }
    println!();
}

fn test_alone<G: Dimension>() {
    const N: usize = 100_000;
    let options = Options { algorithm: Algorithm::Tolerance, ..Options::default() };
    let mut now = walk::<G>(N, 0.0, 0).remove(0);
    let mut t = MovingTriangulation::<G>::new(&now, options).expect("points in range");
    t.commit_timestamp().expect("a commit");
    // Vertices go to and fro by a part of their tolerances.
    let (mut staging, mut commit) = (f64::INFINITY, f64::INFINITY);
    let there: Vec<f64> = VertexId::range(0..N).map(|v| 0.4 * t.tolerance(v).expect("present")).collect();
    for k in 0..40 {
        for (p, by) in now.iter_mut().zip(&there) {
            p[0] += if k % 2 == 0 { *by } else { -by };
        }
        let start = Instant::now();
        t.move_all(&now).expect("positions in range");
        let staged = start.elapsed();
        let report = t.commit_timestamp().expect("a commit");
        let committed = start.elapsed() - staged;
        assert_eq!(report.within_tolerance, N as u64);
        staging = staging.min(1e9 * staged.as_secs_f64() / N as f64);
        commit = commit.min(1e9 * committed.as_secs_f64() / N as f64);
    }
    println!(
        "{}D, {N} points, all within tolerance: staging {staging:.2}, commit {commit:.2} ns per vertex",
        G::D
    );
}

fn main() {
    sweep::<Plane>(&[1e-4, 3e-4, 1e-3, 2e-3, 4e-3, 7e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0, 10.0]);
    sweep::<Space>(&[1e-5, 1e-4, 2e-4, 4e-4, 7e-4, 1e-3, 1.5e-3, 4e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0, 10.0]);
    test_alone::<Plane>();
    test_alone::<Space>();
}
