//! Steps of a beam that moves: commit, coarsen, refine and the changes, beside meshing it anew.

use crate::domains::{Domain, beam};
use crate::{build, mask};
use deldrift::motion::{CoarsenOptions, MovingTriangulation, Quality, RefineOptions};
use deldrift::{Plane, VertexId};
use std::time::Instant;

/// Least angle in degrees.
const LEAST_ANGLE: f64 = 25.0;

/// Greatest areas, for some 1e4 and 1e5 cells, each with the number of steps.
const AREAS: [(f64, usize); 2] = [(3e-4, 400), (3e-5, 120)];

/// Steps before the first that counts.
const N_FIRST: usize = 10;

/// Steps between two meshes made anew.
const N_BETWEEN: usize = 20;

/// Steps of a motion before it goes back.
const N_FORTH: usize = 200;

/// How the vertices move, and by how many spacings in the mean, of those that do.
#[derive(Clone, Copy, Debug)]
enum Motion {
    /// All, by a squeeze that keeps areas.
    Squeeze(f64),
    /// Those near the hole, which turns.
    Turn(f64),
    Rest,
}

/// Within this radius the vertices are those of the hole; beyond the other one they are at rest.
const TURNING: [f64; 2] = [0.2, 0.3];

impl Motion {
    /// Where a place goes in a step, if it moves.
    fn goal(self, [x, y]: [f64; 2], step: usize, spacing: f64) -> Option<[f64; 2]> {
        let sign = if (step / N_FORTH).is_multiple_of(2) { 1.0 } else { -1.0 };
        match self {
            Motion::Squeeze(share) => {
                // The mean of |x| is a half.
                let factor = (2.0 * sign * share * spacing).exp();
                Some([x * factor, y / factor])
            }
            Motion::Turn(share) => {
                let [inner, outer] = TURNING;
                let radius = (x * x + y * y).sqrt();
                let part = ((outer - radius) / (outer - inner)).clamp(0.0, 1.0);
                let (sin, cos) = (part * share * spacing / inner).sin_cos();
                (part > 0.0).then_some([cos * x - sin * y, sin * x + cos * y])
            }
            Motion::Rest => None,
        }
    }
}

/// The median, and the first decile, which what else a machine does changes less.
fn quantiles(seconds: &mut [f64]) -> [f64; 2] {
    seconds.sort_by(f64::total_cmp);
    [seconds[seconds.len() / 2], seconds[seconds.len() / 10]]
}

/// What a step takes.
#[derive(Default)]
struct Times {
    commit: Vec<f64>,
    coarsen: Vec<f64>,
    refine: Vec<f64>,
    changes: Vec<f64>,
    /// Coarsening and refinement together.
    quality: Vec<f64>,
    anew: Vec<f64>,
}

fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let done = work();
    (start.elapsed().as_secs_f64(), done)
}

/// A mesh of a domain from its corners and segments alone.
fn anew(domain: &Domain, quality: &Quality) -> (f64, MovingTriangulation<Plane>) {
    let (build_time, mut t) = timed(|| build(domain));
    let selected = mask(&t, domain.n_loops);
    let (time, _) = timed(|| {
        t.refine(quality, &RefineOptions::default(), &selected).expect("a domain");
        t.cells().expect("room");
    });
    (build_time + time, t)
}

/// The steps of one motion; prints a row.
fn go(motion: Motion, area: f64, n_steps: usize) {
    let mut domain = beam();
    let quality = Quality { least_angle: LEAST_ANGLE, greatest_area: area, ..Quality::default() };
    let (_, mut t) = anew(&domain, &quality);
    let mut times = Times::default();
    let (mut n_inserted, mut n_removed, mut n_bad) = (0, 0, 0);
    let spacing = area.sqrt();
    for step in 0..N_FIRST + n_steps {
        let present: Vec<_> = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect();
        let (mut ids, mut goals) = (Vec::new(), Vec::new());
        for v in present {
            let goal = motion.goal(t.position(v).expect("present"), step, spacing);
            goal.into_iter().for_each(|goal| {
                ids.push(v);
                goals.push(goal);
            });
        }
        let (commit, ()) = timed(|| {
            t.move_vertices(&ids, &goals).expect("good places");
            t.commit_timestamp().expect("no conflict");
        });
        let (mut changes, _) = timed(|| t.take_changes().expect("room").created.len());
        let selected = mask(&t, domain.n_loops);
        let (coarsen, coarsened) =
            timed(|| t.coarsen(&quality, &CoarsenOptions::default(), &selected).expect("a domain"));
        changes += timed(|| t.take_changes().expect("room").created.len()).0;
        let selected = mask(&t, domain.n_loops);
        let (refine, refined) =
            timed(|| t.refine(&quality, &RefineOptions::default(), &selected).expect("a domain"));
        changes += timed(|| t.take_changes().expect("room").created.len()).0;
        n_bad += refined.bad_cells;
        if step < N_FIRST {
            continue;
        }
        (n_inserted, n_removed) = (n_inserted + refined.inserted, n_removed + coarsened.removed);
        times.commit.push(commit);
        times.coarsen.push(coarsen);
        times.refine.push(refine);
        times.changes.push(changes);
        times.quality.push(coarsen + refine);
        if step % N_BETWEEN == 0 {
            let corners = VertexId::range(0..domain.points.len()).zip(&mut domain.points);
            corners.for_each(|(v, p)| *p = t.position(v).expect("present"));
            times.anew.push(anew(&domain, &quality).0);
        }
    }
    assert_eq!(n_bad, 0, "all cells are good after each step");
    let n = n_steps as f64;
    let Times { commit, coarsen, refine, changes, quality, anew } = &mut times;
    let [commit, coarsen, refine, changes, quality, anew] =
        [commit, coarsen, refine, changes, quality, anew].map(|list| quantiles(list).map(|x| 1e3 * x));
    for (k, name) in ["median", "decile"].into_iter().enumerate() {
        println!(
            "{motion:?},{area:e},{},{:.1},{:.1},{name},{:.3},{:.3},{:.3},{:.3},{:.2},{:.1},{:.1}",
            t.cell_count(),
            n_inserted as f64 / n,
            n_removed as f64 / n,
            commit[k],
            coarsen[k],
            refine[k],
            changes[k],
            anew[k],
            anew[k] / quality[k],
            anew[k] / (quality[k] + commit[k] + changes[k]),
        );
    }
}

/// Prints the table.
pub fn run() {
    println!(
        "motion,area,cells,inserted a step,removed a step,of steps,commit ms,coarsen ms,refine ms,changes ms,anew ms,\
         anew / (coarsen + refine),anew / step"
    );
    for (area, n_steps) in AREAS {
        for motion in [Motion::Squeeze(1e-3), Motion::Squeeze(1e-2), Motion::Turn(1e-2), Motion::Rest] {
            go(motion, area, n_steps);
        }
    }
}
