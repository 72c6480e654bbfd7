//! What is kept from one commit to the next, under motions that go on: after every commit the cells are those of a
//! fresh build.
//!
//! Tolerances, slacks, watched bi-cells and what *auto* has learnt are right or wrong by what happened many commits
//! ago. So a history here is a few phases, each of several commits of one of [`motions`] with lasting velocities, which
//! use tolerances up a little at a time. In between come partial commits, cancelled and rejected ones, other
//! algorithms, and calls that take effect at once. `DELDRIFT_SOAK` multiplies the number of seeds.

use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering::Relaxed};

use crate::common::{Rng, assert_same_cells, cell_set, fresh_cells, point, seeds};
use deldrift::Error;
use deldrift::motion::{
    Algorithm, CoincidencePolicy, CommitReport, Commits, Level, Monitor, MovingTriangulation, Options,
};
use deldrift::{Dimension, Plane, Shape, Space, VertexId};

/// Those that keep something, and those that move all vertices at once. Each has its own histories, and turns up now
/// and then in those of the others.
fn lasting_algorithms() -> Vec<Algorithm> {
    let lasts = |algorithm: &Algorithm| {
        let row = algorithm.row();
        !row.keeps.is_empty() || row.commits == Commits::Together
    };
    Algorithm::ALL.into_iter().filter(lasts).collect()
}

type Point<G> = <G as Shape>::Point;

/// Extent of the inputs, and about how far apart points are.
const EXTENT: f64 = 8.0;

/// What the vertices have in common while a motion lasts.
struct Phase<G: Dimension> {
    centre: Point<G>,
    /// How far a vertex goes at one step.
    size: f64,
    /// How strong the motions are that have an end.
    strength: f64,
    /// From 0 to 1 and back.
    wave: f64,
    step: usize,
}

/// What a vertex has for itself.
#[derive(Clone, Copy)]
struct Mover<G: Dimension> {
    begin: Point<G>,
    /// Each coordinate between -1 and 1.
    velocity: Point<G>,
    /// Where another vertex was in the beginning.
    other: Point<G>,
    is_chosen: bool,
}

/// Takes a vertex from where it is to where it is next.
type Motion<G> = fn(&Phase<G>, &Mover<G>, Point<G>) -> Point<G>;

fn motions<G: Dimension>() -> [(&'static str, Motion<G>); 11] {
    [
        ("drift", |p, m, q| point::<G>(|k| q[k] + p.size * m.velocity[k])),
        ("a few drift", |p, m, q| {
            let far = if m.is_chosen { 10.0 * p.size } else { 0.0 };
            point::<G>(|k| q[k] + far * m.velocity[k])
        }),
        // Faces of a box stay flat, lattices half degenerate.
        ("drift along an axis", |p, m, q| {
            point::<G>(|k| if k == p.step % G::D { q[k] + p.size * m.velocity[0] } else { q[k] })
        }),
        ("turn", |p, _, q| turned::<G>(q, p.centre, p.size)),
        ("whirl", |p, _, q| {
            let square = (0..G::D).map(|k| (q[k] - p.centre[k]).powi(2)).sum::<f64>();
            turned::<G>(q, p.centre, p.size / (0.1 + square))
        }),
        ("tremble", |p, m, _| {
            let off = if p.step.is_multiple_of(2) { p.size } else { 0.0 };
            point::<G>(|k| m.begin[k] + off * m.velocity[k])
        }),
        ("shear and back", |p, m, _| {
            let along = p.strength * p.wave * (m.begin[1] - p.centre[1]);
            point::<G>(|k| if k == 0 { m.begin[0] + along } else { m.begin[k] })
        }),
        ("onto a line and back", |p, m, _| {
            let towards = |k: usize| m.begin[k] + p.wave * (p.centre[k] - m.begin[k]);
            point::<G>(|k| if k == 0 { m.begin[0] } else { towards(k) })
        }),
        ("the outer ones come in", |p, m, q| {
            let is_outer = (0..G::D).any(|k| (m.begin[k] - EXTENT / 2.0).abs() > EXTENT / 3.0);
            let inwards = |k: usize| m.begin[k] + p.strength * p.wave * (p.centre[k] - m.begin[k]);
            if is_outer { point::<G>(inwards) } else { q }
        }),
        ("a few jump", |p, m, q| match (m.is_chosen, p.step % 3) {
            (false, _) => q,
            (true, 0) => point::<G>(|k| m.other[k] + EXTENT * m.velocity[k]),
            (true, _) => m.begin,
        }),
        ("a few meet and part", |p, m, q| {
            let apart = [0.0, 1e-15, 1e-9, 1e-3][p.step % 4];
            if m.is_chosen { point::<G>(|k| m.other[k] + apart * m.velocity[k]) } else { q }
        }),
    ]
}

fn turned<G: Dimension>(mut q: Point<G>, centre: Point<G>, angle: f64) -> Point<G> {
    let (sin, cos) = angle.sin_cos();
    let [x, y] = [q[0] - centre[0], q[1] - centre[1]];
    (q[0], q[1]) = (centre[0] + cos * x - sin * y, centre[1] + sin * x + cos * y);
    q
}

fn beginning<G: Dimension>(kind: usize, n: usize, rng: &mut Rng) -> Vec<Point<G>> {
    let side = (n as f64).powf(1.0 / G::D as f64).ceil() as usize;
    let on_grid = |i: usize, k: usize| (i / side.pow(k as u32) % side) as f64 * EXTENT / side as f64;
    let one = |i: usize| match kind {
        0 => point::<G>(|_| EXTENT * rng.unit()),
        1 => point::<G>(|k| on_grid(i, k)),
        2 => point::<G>(|k| on_grid(i, k) + 1e-3 * rng.unit()),
        // Clusters of different scales in a row.
        3 => point::<G>(|_| (i % 5) as f64 + [1.0, 1e-3, 1e-6][i % 3] * rng.unit()),
        // A box: its corners, points on its faces and within.
        _ => {
            let mut p = point::<G>(|_| EXTENT * rng.unit());
            if i < 1 << G::D {
                p = point::<G>(|k| EXTENT * (i >> k & 1) as f64);
            } else if i.is_multiple_of(2) {
                p[rng.below(G::D)] = *rng.pick(&[0.0, EXTENT]);
            }
            p
        }
    };
    (0..n).map(one).collect()
}

/// How many commits there were, and how many of each kind.
#[derive(Debug, Default)]
struct Counts {
    commits: usize,
    within: usize,
    /// With vertices within and beyond their tolerance, and flips.
    mended: usize,
    flipped: usize,
    placed: usize,
    rebuilt: usize,
    cancelled: usize,
    rejected: usize,
}

struct History<'c, G: Dimension> {
    t: MovingTriangulation<G>,
    algorithm: Algorithm,
    /// Positions by id, as the motions see them; `None` once removed.
    now: Vec<Option<Point<G>>>,
    /// The triangulation's positions are those, moved by this ...
    offset: f64,
    /// ... and then scaled.
    scale: f64,
    coincidence: CoincidencePolicy,
    /// Calls that the monitor still lets pass.
    patience: Arc<AtomicI64>,
    rng: Rng,
    name: String,
    log: Vec<String>,
    counts: &'c mut Counts,
}

impl<'c, G: Dimension> History<'c, G> {
    fn new(algorithm: Algorithm, seed: u64, counts: &'c mut Counts) -> Self {
        let mut rng = Rng::new(seed);
        let (n, scale) = match seed % 16 {
            0 => (200 + rng.below(100), 1.0),
            // Where every sign is left to exact arithmetic.
            1 => (8 + rng.below(10), *rng.pick(&[1e-140, 2f64.powi(-1060)])),
            _ => (8 + rng.below(60), *rng.pick(&[1.0, 1.0, 1e48, 1e-60])),
        };
        let kind = rng.below(5);
        let first = beginning::<G>(kind, n, &mut rng);
        let mut history = History {
            t: MovingTriangulation::new(&[], Options::default()).expect("nothing"),
            algorithm,
            now: first.into_iter().map(Some).collect(),
            offset: *rng.pick(&[0.0, 0.0, 1e6]),
            scale,
            coincidence: CoincidencePolicy::Merge,
            patience: Arc::new(AtomicI64::new(i64::MAX)),
            rng,
            name: format!("{algorithm:?}, {}D, seed {seed}: kind {kind}, {n} points, scale {scale:e}", G::D),
            log: Vec::new(),
            counts,
        };
        history.begin_anew();
        history
    }

    fn context(&self) -> String {
        let from = self.log.len().saturating_sub(8);
        format!("{}, step {}: ... {}", self.name, self.log.len(), self.log[from..].join("; "))
    }

    fn place(&self, p: &Point<G>) -> Point<G> {
        point::<G>(|k| (p[k] + self.offset) * self.scale)
    }

    fn present(&self) -> Vec<VertexId> {
        VertexId::range(0..self.now.len()).filter(|&v| self.now[v].is_some()).collect()
    }

    fn any(&mut self) -> VertexId {
        let present = self.present();
        *self.rng.pick(&present)
    }

    fn at(&self, v: VertexId) -> Point<G> {
        self.now[v].expect("present")
    }

    /// Builds from what is present, without removed ids: while there are some no commit is of all vertices.
    fn begin_anew(&mut self) {
        self.log.push("begin".to_string());
        self.now.retain(Option::is_some);
        let places: Vec<Point<G>> = self.now.iter().flatten().map(|p| self.place(p)).collect();
        let build = |coincidence| {
            let patience = self.patience.clone();
            let monitor: Monitor = Box::new(move |_| patience.fetch_sub(1, Relaxed) > 0);
            let options = Options {
                algorithm: self.algorithm,
                coincidence,
                monitor: Some(monitor),
                ..Options::default()
            };
            MovingTriangulation::new(&places, options)
        };
        self.coincidence =
            if self.rng.one_in(4) { CoincidencePolicy::Reject } else { CoincidencePolicy::Merge };
        let built = build(self.coincidence).or_else(|_| {
            self.coincidence = CoincidencePolicy::Merge;
            build(CoincidencePolicy::Merge)
        });
        self.t = built.expect("a build");
    }

    fn check(&self) {
        let places: Vec<Option<Point<G>>> = self.now.iter().map(|p| p.map(|p| self.place(&p))).collect();
        for (v, p) in places.iter().enumerate() {
            assert_eq!(self.t.position(VertexId::at(v)).ok(), *p, "{}: vertex {v}", self.context());
        }
        // The fresh build has been validated in full, and its cells are the same.
        self.t.validate(Level::Structure).unwrap_or_else(|v| panic!("{}: {v}", self.context()));
        assert_same_cells(&cell_set(&self.t), &fresh_cells::<G>(&places), || self.context());
    }

    /// Several steps of one motion.
    fn phase(&mut self) {
        if self.now.contains(&None) && self.rng.one_in(2) {
            self.begin_anew();
        }
        let motions = motions::<G>();
        // The first three are the ones that use tolerances up.
        let several = if self.rng.one_in(2) { &motions[..3] } else { &motions };
        let (name, motion) = *self.rng.pick(several);
        let steps = 2 + self.rng.below(20);
        let at_once = self.rng.one_in(8);
        let v = self.any();
        let mut phase = Phase {
            centre: self.at(v),
            size: *self.rng.pick(&[1e-9, 1e-5, 1e-3, 1e-3, 3e-3, 3e-3, 1e-2, 1e-2, 0.03, 0.3]),
            strength: self.rng.unit(),
            wave: 0.0,
            step: 0,
        };
        let movers: Vec<Option<Mover<G>>> = (0..self.now.len())
            .map(|v| {
                let other = self.any();
                self.now[v].map(|begin| Mover {
                    begin,
                    velocity: point::<G>(|_| 2.0 * self.rng.unit() - 1.0),
                    other: self.at(other),
                    is_chosen: self.rng.one_in(12),
                })
            })
            .collect();
        for step in 0..steps {
            self.log.push(format!("{name} by {:e}, {step} of {steps}", phase.size));
            phase.step = step;
            phase.wave = 1.0 - (2.0 * (step + 1) as f64 / steps as f64 - 1.0).abs();
            let mut next = self.now.clone();
            // Those that came or went since are left alone.
            for (q, mover) in next.iter_mut().zip(&movers) {
                if let (Some(q), Some(mover)) = (q, mover) {
                    *q = motion(&phase, mover, *q);
                }
            }
            if at_once {
                for v in self.present() {
                    self.relocate(v, next[v].expect("present"));
                }
            } else {
                self.commit(next);
            }
            self.check();
            if self.rng.one_in(6) {
                self.call_at_once(phase.size);
                self.check();
            }
        }
    }

    /// Stages moves of all vertices or of some, and commits, sometimes not at the first try.
    fn commit(&mut self, mut next: Vec<Option<Point<G>>>) {
        let mut order = self.present();
        let places: Vec<Point<G>> = next.iter().map(|p| self.place(&p.unwrap_or_default())).collect();
        match self.rng.below(12) {
            few @ 0..2 => {
                self.rng.shuffle(&mut order);
                if few == 0 {
                    let share = 1 + self.rng.below(30);
                    order.truncate(order.len().div_ceil(share));
                }
                let moves: Vec<Point<G>> = order.iter().map(|&v| places[v]).collect();
                self.t.move_vertices(&order, &moves).expect("moves");
                for v in self.present().into_iter().filter(|v| !order.contains(v)) {
                    next[v] = self.now[v];
                }
            }
            _ => self.t.move_all(&places).expect("moves"),
        }
        if self.rng.one_in(60) && order.len() > G::D + 2 {
            // A staged move ends with its vertex.
            let v = self.remove();
            next[v] = None;
        }
        let algorithm =
            if self.rng.one_in(8) { *self.rng.pick(&lasting_algorithms()) } else { self.algorithm };
        self.t.set_algorithm(algorithm);
        let tries: &[i64] = if self.rng.one_in(5) { &[0, 1, 2, 4, i64::MAX] } else { &[i64::MAX] };
        for &calls in tries {
            self.log.push(format!("commit by {algorithm:?}"));
            self.patience.store(calls, Relaxed);
            let done = self.t.commit_timestamp();
            self.patience.store(i64::MAX, Relaxed);
            match done {
                Ok(report) => {
                    self.note(&report);
                    self.now = next;
                    return;
                }
                Err(Error::Cancelled) => {
                    self.counts.cancelled += 1;
                    self.check();
                }
                Err(error) => {
                    self.expect_rejection(&error);
                    self.t.discard_moves();
                    return;
                }
            }
        }
    }

    fn expect_rejection(&mut self, error: &Error) {
        let rejects = self.coincidence == CoincidencePolicy::Reject;
        assert!(rejects && matches!(error, Error::Coincident { .. }), "{}: {error}", self.context());
        self.counts.rejected += 1;
    }

    fn relocate(&mut self, v: VertexId, q: Point<G>) {
        match self.t.relocate_vertex(v, &self.place(&q)) {
            Ok(()) => self.now[v] = Some(q),
            Err(error) => self.expect_rejection(&error),
        }
    }

    fn insert(&mut self, q: Point<G>) {
        match self.t.insert_vertex(&self.place(&q)) {
            Ok(_) => self.now.push(Some(q)),
            Err(error) => self.expect_rejection(&error),
        }
    }

    fn remove(&mut self) -> VertexId {
        let v = self.any();
        self.log.push(format!("remove {v}"));
        self.t.remove_vertex(v).expect("a removal");
        self.now[v] = None;
        v
    }

    /// A few calls that take effect at once.
    fn call_at_once(&mut self, size: f64) {
        for _ in 0..1 + self.rng.below(3) {
            let (v, w) = (self.any(), self.any());
            let off = *self.rng.pick(&[0.0, size, size, EXTENT]);
            let by = point::<G>(|_| off * (self.rng.unit() - 0.5));
            let near = |q: Point<G>| point::<G>(|k| q[k] + by[k]);
            let (to_itself, to_another) = (near(self.at(v)), near(self.at(w)));
            self.log.push(format!("at once, {v} by {off:e}"));
            match self.rng.below(8) {
                0 => self.insert(to_another),
                1 if self.present().len() > G::D + 2 => {
                    self.remove();
                }
                2 => self.relocate(v, to_another),
                _ => self.relocate(v, to_itself),
            }
        }
    }

    fn note(&mut self, report: &CommitReport) {
        let counts = &mut *self.counts;
        counts.commits += 1;
        counts.within += usize::from(report.within_tolerance > 0);
        counts.mended += usize::from(report.within_tolerance > 0 && report.flips > 0);
        counts.flipped += usize::from(report.flips > 0);
        counts.placed += usize::from(report.placements > 0);
        counts.rebuilt += usize::from(report.rebuilds > 0);
    }
}

fn all_agree<G: Dimension>() {
    let mut counts = Counts::default();
    for algorithm in lasting_algorithms() {
        for seed in seeds(60) {
            let mut history = History::<G>::new(algorithm, seed, &mut counts);
            for _ in 0..4 {
                history.phase();
            }
        }
    }
    // The histories do what they are for.
    let Counts { commits, within, mended, flipped, placed, rebuilt, cancelled, rejected } = counts;
    assert!(5 * within > commits && 100 * mended > commits, "tolerances were hardly used: {counts:?}");
    assert!(20 * flipped.min(placed).min(rebuilt) > commits, "a way was hardly taken: {counts:?}");
    assert!(10 * cancelled > commits && 1000 * rejected > commits, "hardly a commit failed: {counts:?}");
}

#[test]
fn lasting_motion_in_the_plane_matches_fresh_builds() {
    all_agree::<Plane>();
}

#[test]
fn lasting_motion_in_space_matches_fresh_builds() {
    all_agree::<Space>();
}

/// *Auto*, when one vertex in a hundred is staged for every commit, keeps tolerances when nearly all of
/// them change no cell, and gives them up when they move far.
fn few_vertices_are_followed<G: Dimension>() {
    let rng = &mut Rng::new(3);
    let n = 2_000;
    let side = (n as f64).powf(1.0 / G::D as f64);
    let mut places: Vec<Point<G>> = (0..n).map(|_| point::<G>(|_| side * rng.unit())).collect();
    let mut t = MovingTriangulation::<G>::new(&places, Options::default()).expect("points in range");
    let mut commits = |t: &mut MovingTriangulation<G>, n_commits: u64, step: f64| {
        let before = t.statistics();
        for _ in 0..n_commits {
            let first = rng.below(n / 20);
            for v in VertexId::range(0..n).skip(first).step_by(n / 20) {
                let p = places[v];
                places[v] = point::<G>(|axis| p[axis] + step * (2.0 * rng.unit() - 1.0));
                t.move_vertices(&[v], &[places[v]]).expect("good places");
            }
            t.commit_timestamp().expect("good places");
        }
        let after = t.statistics();
        (after.within_tolerance - before.within_tolerance) as f64 / (after.moved - before.moved) as f64
    };
    commits(&mut t, 100, 1e-7);
    assert!(commits(&mut t, 100, 1e-7) > 0.95, "tolerances are kept");
    commits(&mut t, 100, 0.3);
    assert_eq!(commits(&mut t, 20, 0.3), 0.0, "tolerances are given up");
    let places: Vec<_> = places.into_iter().map(Some).collect();
    assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&places), || "in the end".into());
}

#[test]
fn few_vertices_are_followed_in_the_plane() {
    few_vertices_are_followed::<Plane>();
}

#[test]
fn few_vertices_are_followed_in_space() {
    few_vertices_are_followed::<Space>();
}
