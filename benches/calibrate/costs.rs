//! What the parts of a commit cost, by themselves.

use crate::common::Rng;
use crate::inputs::{Size, lattice, turned};
use crate::recording::{beside, points};
use crate::trial::{Trial, in_force};
use deldrift::internals::constants::{Constants, Costs};
use deldrift::motion::{Algorithm, CommitReport, MovingTriangulation, Options};
use deldrift::{Dimension, VertexId};
use std::time::Instant;

/// A step so short that nothing changes.
const STILL: f64 = 1e-12;

/// Vertices that go to and fro.
struct Swing<G: Dimension> {
    t: MovingTriangulation<G>,
    places: [Vec<G::Point>; 2],
    n_commits: usize,
}

/// What a commit took, in nanoseconds, and what it counted.
type Timed = (f64, CommitReport);

impl<G: Dimension> Swing<G> {
    fn new(algorithm: Algorithm, here: &[G::Point], there: &[G::Point]) -> Self {
        let options = Options { algorithm, threads: 1, ..Options::default() };
        let mut t = MovingTriangulation::new(here, options).expect("points in range");
        t.set_constants(in_force());
        Swing { t, places: [there.to_vec(), here.to_vec()], n_commits: 0 }
    }

    /// As many vertices as hardly move.
    fn still(algorithm: Algorithm, here: &[G::Point]) -> Self {
        let random = &mut Rng::new(11);
        let there: Vec<_> = here.iter().map(|p| beside::<G>(p, STILL, random)).collect();
        Self::new(algorithm, here, &there)
    }

    fn commit(&mut self) -> Timed {
        let places = &self.places[self.n_commits % 2];
        self.n_commits += 1;
        let start = Instant::now();
        let report = self.t.commit_positions(places).expect("positions in range");
        (1e9 * start.elapsed().as_secs_f64(), report)
    }
}

/// The least of a figure of several commits, after the first few: what else the machine does only adds to it.
fn least_of(repeats: usize, mut commit: impl FnMut() -> f64) -> f64 {
    (0..repeats + 4).map(|_| commit()).skip(4).fold(f64::INFINITY, f64::min)
}

/// Replaces constants of the dimension, of the calling thread.
fn put<G: Dimension>(change: impl Fn(&mut Constants)) {
    let mut trial = Trial::as_is();
    change(if G::D == 2 { &mut trial.table.plane } else { &mut trial.table.space });
    trial.put_in_force();
}

/// Measures the costs of a dimension.
pub fn measure<G: Dimension>(size: &Size) -> Costs {
    let n = size.n_for_costs as f64;
    let here = points::<G>(size.n_for_costs, &mut Rng::new(10));
    let repeats = 20 * size.rounds + 1;
    // Nothing is watched, and nothing goes beyond: what is left is to move all and to test them.
    put::<G>(|constants| constants.watched_share = 0.0);
    let mut moved = Swing::<G>::still(Algorithm::Watching, &here);
    let moving = least_of(repeats, || moved.commit().0);
    let beyond = beyond::<G>(&here, moving, repeats);
    put::<G>(|constants| constants.watched_share = f64::MAX);
    let mut all = Swing::<G>::still(Algorithm::Watching, &here);
    let watched = least_of(repeats, || {
        let (time, report) = all.commit();
        // Three certificates are counted for each.
        3.0 * (time - moving) / report.certificates.max(1) as f64
    });
    put::<G>(|_| {});
    let mut swing = Swing::<G>::still(Algorithm::Repair, &here);
    let sweep = least_of(repeats, || swing.commit().0);
    let mut slack = Swing::<G>::still(Algorithm::Slack, &here);
    let slackened = least_of(repeats, || slack.commit().0);
    let computed = least_of(repeats.min(31), || {
        // Another algorithm's commit ends the tolerances.
        moved.t.set_algorithm(Algorithm::Repair);
        moved.commit();
        moved.t.set_algorithm(Algorithm::Watching);
        moved.commit().0 - moving
    });
    let mut rebuilding = Swing::<G>::still(Algorithm::Rebuilding, &here);
    let rebuilt = least_of(repeats.min(31), || rebuilding.commit().0);
    let costs = Costs {
        watched,
        beyond,
        sweep: (sweep - moving) / n,
        slack: Some((slackened - moving) / n),
        used_up: used_up::<G>(&here, slackened, repeats),
        computed: computed / n,
        rebuilt: rebuilt / n,
        placed: placed::<G>(&here, sweep, repeats),
        certified: certified::<G>(&here, sweep, repeats),
        exact: exact::<G>(size.n_for_costs, repeats),
    };
    println!("  {}D, nanoseconds: {costs:.1?}", G::D);
    costs
}

/// A vertex beyond its tolerance: one in fifty goes that far and back.
fn beyond<G: Dimension>(here: &[G::Point], moving: f64, repeats: usize) -> f64 {
    let mut there = here.to_vec();
    let t = MovingTriangulation::<G>::new(here, Options::default()).expect("points in range");
    for v in (0..here.len()).step_by(50) {
        there[v][0] += 1.2 * t.tolerance(VertexId::at(v)).expect("present");
    }
    let mut swing = Swing::<G>::new(Algorithm::Watching, here, &there);
    least_of(repeats, || {
        let (time, report) = swing.commit();
        (time - moving) / (here.len() as u64 - report.within_tolerance).max(1) as f64
    })
}

/// A bi-cell whose slack is used up: vertices go to and fro by a hundredth of the mean tolerance.
fn used_up<G: Dimension>(here: &[G::Point], slackened: f64, repeats: usize) -> f64 {
    let random = &mut Rng::new(12);
    let step = if G::D == 2 { 1e-4 } else { 2e-5 };
    let there: Vec<_> = here.iter().map(|p| beside::<G>(p, step, random)).collect();
    let mut swing = Swing::<G>::new(Algorithm::Slack, here, &there);
    for _ in 0..100 {
        swing.commit();
    }
    least_of(repeats, || {
        let (time, report) = swing.commit();
        (time - slackened) / report.tolerances.max(1) as f64
    })
}

/// A vertex placed, by a repair: one in a hundred jumps.
fn placed<G: Dimension>(here: &[G::Point], sweep: f64, repeats: usize) -> f64 {
    let random = &mut Rng::new(13);
    let jump = |(v, p): (usize, &G::Point)| beside::<G>(p, if v % 100 == 0 { 2.0 } else { STILL }, random);
    let there: Vec<_> = here.iter().enumerate().map(jump).collect();
    let mut swing = Swing::<G>::new(Algorithm::Repair, here, &there);
    least_of(repeats, || {
        let (time, report) = swing.commit();
        (time - sweep) / report.placements.max(1) as f64
    })
}

/// A certificate of those that flips and placements evaluate: all vertices go to and fro by a twentieth of a spacing.
fn certified<G: Dimension>(here: &[G::Point], sweep: f64, repeats: usize) -> f64 {
    let random = &mut Rng::new(15);
    let there: Vec<_> = here.iter().map(|p| beside::<G>(p, 0.05, random)).collect();
    let mut swing = Swing::<G>::new(Algorithm::Repair, here, &there);
    let mut swept = Swing::<G>::still(Algorithm::Repair, here);
    let n_swept = swept.commit().1.certificates;
    least_of(repeats.min(31), || {
        let (time, report) = swing.commit();
        (time - sweep) / report.certificates.saturating_sub(n_swept).max(1) as f64
    })
}

/// An exact evaluation: what sweeps of a turned lattice take longer than those of one whose points are not quite there.
fn exact<G: Dimension>(n: usize, repeats: usize) -> f64 {
    let random = &mut Rng::new(14);
    let tied: Vec<_> = lattice::<G>(n).iter().map(|p| turned::<G>(p, 0.37)).collect();
    let apart: Vec<_> = tied.iter().map(|p| beside::<G>(p, 1e-3, random)).collect();
    let mut sweeps = [tied, apart].map(|places| {
        let options = Options { algorithm: Algorithm::Repair, threads: 1, ..Options::default() };
        let t = MovingTriangulation::<G>::new(&places, options).expect("points in range");
        (t, places[0])
    });
    // One vertex moves, and hardly.
    let mut sweep = |k: usize| {
        let (t, place) = &mut sweeps[k];
        *place = beside::<G>(place, STILL, random);
        t.move_vertices(&[VertexId::new(0)], std::slice::from_ref(place)).expect("in range");
        let start = Instant::now();
        let report = t.commit_timestamp().expect("a commit");
        (1e9 * start.elapsed().as_secs_f64(), report.exact_calls as f64)
    };
    let [mut tied, mut apart] = [(f64::INFINITY, 0.0); 2];
    for _ in 0..repeats {
        for (k, least) in [&mut tied, &mut apart].into_iter().enumerate() {
            let (time, n_exact) = sweep(k);
            *least = (least.0.min(time), n_exact);
        }
    }
    (tied.0 - apart.0) / (tied.1 - apart.1).max(1.0)
}
