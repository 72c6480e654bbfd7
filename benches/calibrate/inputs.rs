//! The recorded motions.

use crate::common::Rng;
use crate::recording::{Frame, Recording, Step, beside, counts, flow, points, side_of, walk};
use crate::trial::Trial;
use deldrift::motion::{Algorithm, CommitReport, MovingTriangulation, NO_CELL, Options, SwitchingRule};
use deldrift::{Dimension, Plane, VertexId};

/// How much is measured.
pub struct Size {
    /// Vertices of a motion in the plane and in space.
    n: [usize; 2],
    /// Vertices when costs are measured.
    pub n_for_costs: usize,
    /// Timestamps are a thousandth of so many.
    permille: usize,
    pub rounds: usize,
    pub factors: &'static [f64],
}

impl Size {
    pub const FULL: Size = Size {
        n: [1_000, 700],
        n_for_costs: 5_000,
        permille: 1_000,
        rounds: 7,
        factors: &[0.25, 0.5, 2.0, 4.0],
    };
    pub const SMALL: Size = Size { n: [60; 2], n_for_costs: 60, permille: 30, rounds: 1, factors: &[0.25] };

    fn commits(&self, commits: usize) -> usize {
        (commits * self.permille / 1_000).max(2)
    }
}

/// A motion that can be replayed, with a rule of switching.
pub struct Input {
    pub name: String,
    pub dimension: usize,
    pub replay: Box<dyn Fn(SwitchingRule) -> Vec<Step>>,
    /// What its commits count with all constants as they are.
    pub counts: Vec<CommitReport>,
}

impl Input {
    /// Replays the motion with these values of the constants.
    pub fn replayed_with(&self, trial: &Trial) -> Vec<Step> {
        trial.put_in_force();
        (self.replay)(trial.rule)
    }
}

/// Inputs of one dimension, by name.
struct Inputs<'s, G: Dimension> {
    size: &'s Size,
    n: usize,
    inputs: Vec<Input>,
    of: std::marker::PhantomData<G>,
}

/// All inputs of a dimension.
pub fn of<G: Dimension>(size: &Size) -> Vec<Input> {
    let mut inputs =
        Inputs::<G> { size, n: size.n[G::D - 2], inputs: Vec::new(), of: std::marker::PhantomData };
    inputs.relax();
    inputs.walk();
    inputs.move_some();
    inputs.edit();
    inputs.structured();
    inputs.switch();
    inputs.inputs
}

impl<G: Dimension> Inputs<'_, G> {
    fn add(&mut self, name: impl Into<String>, recording: Recording<G>) {
        let replay = Box::new(move |rule| recording.replay(rule));
        let mut input = Input { name: name.into(), dimension: G::D, replay, counts: Vec::new() };
        input.counts = counts(&input.replayed_with(&Trial::as_is()));
        self.inputs.push(input);
    }

    fn commits(&self, commits: usize) -> usize {
        self.size.commits(commits)
    }

    /// Iterations that converge.
    fn relax(&mut self) {
        let start = points::<G>(self.n, &mut Rng::new(1));
        if G::D == 2 {
            let plane = |p: &G::Point| [p[0], p[1]];
            let frames = lloyd(start.iter().map(plane).collect(), self.commits(600));
            let frames = frames.into_iter().map(|places| {
                let back = |[x, y]: [f64; 2]| {
                    let mut p = G::Point::default();
                    (p[0], p[1]) = (x, y);
                    p
                };
                Frame::All(places.into_iter().map(back).collect())
            });
            self.add("lloyd", Recording::new(start.clone(), frames.collect()));
        }
        let n_commits = self.commits(if G::D == 2 { 150 } else { 60 });
        self.add("odt", odt::<G>(start, n_commits));
        let steps = (0..self.commits(200)).map(|k| 0.1 * 0.95_f64.powi(k as i32));
        self.add("walk slowing down", walk(self.n, steps));
    }

    /// Random walks, by auto, and by what auto makes use of.
    fn walk(&mut self) {
        let steps: &[f64] =
            if G::D == 2 { &[1e-4, 1e-3, 3e-3, 1e-2, 0.1, 0.3] } else { &[1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.3] };
        let n_commits = self.commits(if G::D == 2 { 100 } else { 30 });
        for (&step, times) in steps.iter().zip([5, 3, 1, 1, 1, 1]) {
            self.add(format!("walk {step}"), walk(self.n, (0..times * n_commits).map(|_| step)));
        }
        let still = steps[0];
        let steps = (0..4 * n_commits).map(move |k| if k % 40 < 5 { 0.03 } else { still });
        self.add("walk with bursts", walk(self.n, steps));
        for step in if G::D == 2 { [1e-3, 2e-3, 4e-3] } else { [2e-4, 4e-4, 8e-4] } {
            let walk = |algorithm| walk::<G>(self.n, (0..n_commits).map(|_| step)).by(algorithm);
            let (watching, slack) = (walk(Algorithm::Watching), walk(Algorithm::Slack));
            self.add(format!("watching {step}"), watching);
            self.add(format!("slack {step}"), slack);
        }
        for step in if G::D == 2 { [1e-4, 1e-3, 1e-2] } else { [1e-5, 1e-4, 1e-3] } {
            let mut rounds = walk::<G>(self.n, (0..n_commits).map(|_| step));
            for frame in &mut rounds.frames {
                if let Frame::All(places) = frame {
                    *frame = Frame::OneByOne(std::mem::take(places));
                }
            }
            self.add(format!("immediate {step}"), rounds);
        }
    }

    /// Some vertices move, or some jump while all others hardly move.
    fn move_some(&mut self) {
        let n_commits = self.commits(20);
        for one_in in [80, 40, 20, 10, 5] {
            let random = &mut Rng::new(2);
            let start = points::<G>(self.n, random);
            let mut now = start.clone();
            let frames = (0..n_commits).map(|k| {
                let vertices: Vec<_> = VertexId::range(k % one_in..self.n).step_by(one_in).collect();
                let places = vertices.iter().map(|&v| {
                    now[v] = beside::<G>(&now[v], 0.1, random);
                    now[v]
                });
                let places = places.collect();
                Frame::Some(vertices, places)
            });
            let recording = Recording::new(start, frames.collect());
            self.add(format!("one in {one_in} moves"), recording);
        }
        for one_in in [100, 40, 20, 10, 5, 3] {
            let random = &mut Rng::new(3);
            let start = points::<G>(self.n, random);
            let mut now = start.clone();
            let frames = (0..n_commits).map(|k| {
                let somewhere = points::<G>(self.n, random);
                for (v, p) in now.iter_mut().enumerate() {
                    let jumps = v % one_in == k % one_in;
                    *p = if jumps { somewhere[v] } else { beside::<G>(p, 1e-3, random) };
                }
                Frame::All(now.clone())
            });
            let recording = Recording::new(start, frames.collect());
            self.add(format!("one in {one_in} jumps"), recording);
        }
    }

    /// Vertices come and go.
    fn edit(&mut self) {
        for one_in in [64, 16, 8, 4, 2] {
            let random = &mut Rng::new(4);
            let start = points::<G>(self.n, random);
            let (side, n_edits) = (side_of::<G>(self.n), self.n / one_in);
            let frames = (0..self.commits(20)).map(|k| {
                let come = (0..n_edits).map(|_| crate::common::in_cube::<G>(random, side)).collect();
                Frame::Edited(VertexId::range(k * n_edits..(k + 1) * n_edits).collect(), come)
            });
            let recording = Recording::new(start, frames.collect());
            self.add(format!("one in {one_in} comes and goes"), recording);
        }
    }

    /// Lattices and spheres.
    fn structured(&mut self) {
        let n_commits = self.commits(40);
        let lattice = lattice::<G>(self.n);
        let shear = |by: f64| {
            move |p: &G::Point, time: f64| {
                let mut q = *p;
                q[0] += by * time * p[G::D - 1];
                q
            }
        };
        self.add("lattice sheared", flow(lattice.clone(), n_commits, shear(0.01)));
        self.add("lattice hardly sheared", flow(lattice.clone(), n_commits, shear(1e-5)));
        self.add("lattice turned", flow(lattice, n_commits, |p, time| turned::<G>(p, 0.01 * time)));
        let random = &mut Rng::new(5);
        let on_sphere: Vec<_> =
            (0..self.n).map(|_| beside::<G>(&G::Point::default(), side_of::<G>(self.n), random)).collect();
        for by in [1e-4, 0.01, 0.1] {
            let squeezed = move |p: &G::Point, time: f64| {
                let mut q = *p;
                q[0] *= 1.0 + by * time;
                q
            };
            self.add(
                format!("sphere stretched by {by}"),
                flow(on_sphere.clone(), self.commits(20), squeezed),
            );
        }
    }

    /// Rebuilding, then tolerance.
    fn switch(&mut self) {
        let n_commits = self.commits(60);
        for step in if G::D == 2 { [1e-3, 3e-3, 1e-2] } else { [1e-4, 3e-4, 1e-3] } {
            let walk = walk::<G>(self.n, (0..n_commits).map(|_| step)).by(Algorithm::RebuildingTolerance);
            self.add(format!("switching {step}"), walk);
        }
        let steps = (0..n_commits).map(|k| 0.03 * 0.9_f64.powi(k as i32));
        self.add("switching slowing down", walk::<G>(self.n, steps).by(Algorithm::RebuildingTolerance));
    }
}

/// A lattice of about this number of points.
pub fn lattice<G: Dimension>(n: usize) -> Vec<G::Point> {
    let side = side_of::<G>(n).round() as usize;
    let place = |k: usize| {
        let mut p = G::Point::default();
        (0..G::D).for_each(|axis| p[axis] = (k / side.pow(axis as u32) % side) as f64);
        p
    };
    (0..side.pow(G::D as u32)).map(place).collect()
}

/// A point turned about the last axes.
pub fn turned<G: Dimension>(p: &G::Point, angle: f64) -> G::Point {
    let mut q = *p;
    let (sin, cos) = angle.sin_cos();
    for [a, b] in [[0, 1], [1, G::D - 1]] {
        if a != b {
            (q[a], q[b]) = (cos * q[a] - sin * q[b], sin * q[a] + cos * q[b]);
        }
    }
    q
}

/// Lloyd's iterations in a square: every point goes to the centroid of its Voronoi cell.
fn lloyd(mut now: Vec<[f64; 2]>, commits: usize) -> Vec<Vec<[f64; 2]>> {
    let side = side_of::<Plane>(now.len());
    let mut t = MovingTriangulation::<Plane>::new(&now, Options::default()).expect("points in range");
    let iteration = |_| {
        let mut cells = vec![vec![[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]; now.len()];
        for &[a, b, c] in t.cells().expect("room").corners {
            for [u, v] in [[a, b], [b, c], [c, a], [b, a], [c, b], [a, c]] {
                let (p, q) = (&now[u], &now[v]);
                cells[u] = nearer(&cells[u], p, q);
            }
        }
        for (p, cell) in now.iter_mut().zip(&cells) {
            *p = centroid(cell);
        }
        t.commit_positions(&now).expect("positions in range");
        now.clone()
    };
    (0..commits).map(iteration).collect()
}

/// The part of a convex polygon that is nearer to p than to q.
fn nearer(polygon: &[[f64; 2]], p: &[f64; 2], q: &[f64; 2]) -> Vec<[f64; 2]> {
    let excess =
        |x: &[f64; 2]| (0..2).map(|k| (x[k] - f64::midpoint(p[k], q[k])) * (q[k] - p[k])).sum::<f64>();
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, a) in polygon.iter().enumerate() {
        let b = &polygon[(k + 1) % polygon.len()];
        let (at_a, at_b) = (excess(a), excess(b));
        if at_a <= 0.0 {
            kept.push(*a);
        }
        if (at_a < 0.0) != (at_b < 0.0) && at_a != at_b {
            let share = at_a / (at_a - at_b);
            kept.push([a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]);
        }
    }
    kept
}

fn centroid(polygon: &[[f64; 2]]) -> [f64; 2] {
    let (mut area, mut sum) = (0.0, [0.0; 2]);
    for (k, a) in polygon.iter().enumerate() {
        let b = &polygon[(k + 1) % polygon.len()];
        let part = a[0] * b[1] - a[1] * b[0];
        area += part;
        sum = [sum[0] + part * (a[0] + b[0]), sum[1] + part * (a[1] + b[1])];
    }
    [sum[0] / (3.0 * area), sum[1] / (3.0 * area)]
}

/// Iterations towards an optimal Delaunay triangulation: every vertex, but those of the hull, goes to the mean of the
/// circumcentres of its cells, weighted by volume (Chen and Xu, Journal of Computational Mathematics 22, 2004).
fn odt<G: Dimension>(start: Vec<G::Point>, commits: usize) -> Recording<G> {
    let mut now = start.clone();
    let mut t = MovingTriangulation::<G>::new(&start, Options::default()).expect("points in range");
    let iteration = |_| {
        let view = t.cells().expect("room");
        let (mut volumes, mut sums) = (vec![0.0; now.len()], vec![G::Point::default(); now.len()]);
        let mut is_on_hull = vec![false; now.len()];
        for (corners, neighbours) in view.corners.iter().zip(view.neighbours) {
            let (corners, neighbours) = (corners.as_ref(), neighbours.as_ref());
            let (centre, volume) = circumcentre::<G>(corners, &now);
            for (i, &v) in corners.iter().enumerate() {
                volumes[v] += volume;
                (0..G::D).for_each(|axis| sums[v][axis] += volume * centre[axis]);
                is_on_hull[v] |= (0..=G::D).any(|k| k != i && neighbours[k] == NO_CELL);
            }
        }
        for v in (0..now.len()).filter(|&v| !is_on_hull[v]) {
            (0..G::D).for_each(|axis| now[v][axis] = sums[v][axis] / volumes[v]);
        }
        t.commit_positions(&now).expect("positions in range");
        Frame::All(now.clone())
    };
    let frames = (0..commits).map(iteration).collect();
    Recording::new(start, frames)
}

/// The circumcentre of a cell, and a multiple of its volume.
fn circumcentre<G: Dimension>(corners: &[VertexId], places: &[G::Point]) -> (G::Point, f64) {
    let origin = &places[corners[0]];
    // Rows of a linear system: edges from the first corner, and half their squares.
    let mut rows = [[0.0; 4]; 3];
    rows[2] = [0.0, 0.0, 1.0, 0.0];
    for (row, &v) in rows.iter_mut().zip(&corners[1..]) {
        (0..G::D).for_each(|axis| row[axis] = places[v][axis] - origin[axis]);
        row[3] = row[..3].iter().map(|x| x * x).sum::<f64>() / 2.0;
    }
    let column = |k: usize| rows.map(|row| row[k]);
    let determinant = |[a, b, c]: [[f64; 3]; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let columns = [column(0), column(1), column(2)];
    let volume = determinant(columns);
    let mut centre = *origin;
    for axis in 0..G::D {
        let mut with = columns;
        with[axis] = column(3);
        centre[axis] += determinant(with) / volume;
    }
    (centre, volume)
}
