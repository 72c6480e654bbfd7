//! Motions on record, and their replay.

use crate::common::{Rng, in_ball, in_cube};
use crate::trial::in_force;
use deldrift::motion::{Algorithm, CommitReport, MovingTriangulation, Options, SwitchingRule};
use deldrift::{Dimension, VertexId};
use std::time::Instant;

/// What a program does at a timestamp.
pub enum Frame<G: Dimension> {
    /// All vertices go to these places.
    All(Vec<G::Point>),
    /// Some vertices do.
    Some(Vec<VertexId>, Vec<G::Point>),
    /// All vertices do, one after the other, at once.
    OneByOne(Vec<G::Point>),
    /// Vertices are removed, and as many inserted.
    Edited(Vec<VertexId>, Vec<G::Point>),
}

/// A motion, and the way in which a triangulation follows it.
pub struct Recording<G: Dimension> {
    pub start: Vec<G::Point>,
    pub frames: Vec<Frame<G>>,
    pub algorithm: Algorithm,
}

/// One timestamp of a replay.
#[derive(Clone, Copy)]
pub struct Step {
    pub seconds: f64,
    pub counts: CommitReport,
}

/// What the steps of a replay count.
pub fn counts(steps: &[Step]) -> Vec<CommitReport> {
    steps.iter().map(|step| step.counts).collect()
}

impl<G: Dimension> Recording<G> {
    pub fn new(start: Vec<G::Point>, frames: Vec<Frame<G>>) -> Self {
        Recording { start, frames, algorithm: Algorithm::Auto }
    }

    pub fn by(self, algorithm: Algorithm) -> Self {
        Recording { algorithm, ..self }
    }

    /// Does what is on record, by one thread.
    pub fn replay(&self, switching: SwitchingRule) -> Vec<Step> {
        let options = Options { algorithm: self.algorithm, threads: 1, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&self.start, options).expect("points in range");
        t.set_constants(in_force());
        t.set_switching_rule(switching);
        self.frames.iter().map(|frame| step(&mut t, frame)).collect()
    }
}

fn step<G: Dimension>(t: &mut MovingTriangulation<G>, frame: &Frame<G>) -> Step {
    let start = Instant::now();
    let counts = advance(t, frame);
    Step { seconds: start.elapsed().as_secs_f64(), counts }
}

/// Makes the next timestamp.
fn advance<G: Dimension>(t: &mut MovingTriangulation<G>, frame: &Frame<G>) -> CommitReport {
    let good = "a frame that can be committed";
    match frame {
        Frame::All(positions) => return t.commit_positions(positions).expect(good),
        Frame::Some(vertices, positions) => t.move_vertices(vertices, positions).expect(good),
        Frame::OneByOne(positions) => {
            for (v, p) in VertexId::range(0..positions.len()).zip(positions) {
                t.relocate_vertex(v, p).expect(good);
            }
            return t.statistics();
        }
        Frame::Edited(gone, come) => {
            t.stage_removals(gone).expect(good);
            t.stage_insertions(come).expect(good);
        }
    }
    t.commit_timestamp().expect(good)
}

/// Random points at unit density.
pub fn points<G: Dimension>(n: usize, random: &mut Rng) -> Vec<G::Point> {
    let side = side_of::<G>(n);
    (0..n).map(|_| in_cube::<G>(random, side)).collect()
}

/// The side of a square or cube for points at unit density.
pub fn side_of<G: Dimension>(n: usize) -> f64 {
    (n as f64).powf(1.0 / G::D as f64)
}

/// A point so far away, in a random direction.
pub fn beside<G: Dimension>(p: &G::Point, step: f64, random: &mut Rng) -> G::Point {
    let by = in_ball::<G>(random, 1.0);
    let length = by.as_ref().iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-9);
    let mut q = *p;
    for k in 0..G::D {
        q[k] += by[k] * step / length;
    }
    q
}

/// A walk: at each timestamp all points go so far, in random directions.
pub fn walk<G: Dimension>(n: usize, steps: impl Iterator<Item = f64>) -> Recording<G> {
    let random = &mut Rng::new(1);
    let start = points::<G>(n, random);
    let mut now = start.clone();
    let go = |step| {
        now.iter_mut().for_each(|p| *p = beside::<G>(p, step, random));
        Frame::All(now.clone())
    };
    Recording::new(start, steps.map(go).collect())
}

/// A motion of `start` that is a function of the time, from 1 on.
pub fn flow<G: Dimension>(
    start: Vec<G::Point>,
    commits: usize,
    place: impl Fn(&G::Point, f64) -> G::Point,
) -> Recording<G> {
    let at = |time: usize| Frame::All(start.iter().map(|p| place(p, time as f64)).collect());
    let frames = (1..=commits).map(at).collect();
    Recording::new(start, frames)
}
