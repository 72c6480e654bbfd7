//! Triangulations of points with weights: any history against a fresh build, by every algorithm.

mod definition;
mod exactly;
mod few;
mod known;
mod saving;
mod stuck;
mod together;

use crate::common::inputs::{KINDS, Kind, draw_one};
use crate::common::{CellSet, Rng, assert_same_cells, cell_set, check_adjacency, seeds};
use deldrift::internals::{PowerPlane, PowerSpace};
use deldrift::motion::{Algorithm, Level, MovingTriangulation, Options};
use deldrift::{Moving, Shape, VertexId};

/// Cells and the vertices that weights hide.
type Shown = (CellSet, Vec<VertexId>);

fn shown<G: Moving>(t: &MovingTriangulation<G>) -> Shown {
    t.validate(Level::Delaunay).expect("a regular triangulation");
    (cell_set(t), t.vertices_hidden_by_weight().expect("room"))
}

/// Whether a vertex is hidden in a line, by its definition: another one at its place or two beside it have it above them.
fn is_above_on_line((x, w): (i64, i64), k: usize, all: &[(i64, i64)]) -> bool {
    let lift = |(x, w): (i64, i64)| i128::from(x) * i128::from(x) - i128::from(w);
    let others = || all.iter().copied().enumerate().filter(|&(i, _)| i != k);
    // At one place the greater weight is below, then the lower id.
    let beaten = others().any(|(i, (y, v))| y == x && (v > w || v == w && i < k));
    beaten
        || others().filter(|&(_, (y, _))| y < x).any(|(i, p)| {
            others().filter(|&(_, (y, _))| y > x).any(|(j, q)| {
                let (left, right) = (i128::from(x - p.0), i128::from(q.0 - x));
                let apart = lift((x, w)) * (left + right) - lift(p) * right - lift(q) * left;
                // A tie is decided by the vertex of the highest id, which is raised.
                apart > 0 || apart == 0 && k > i && k > j
            })
        })
}

/// Who is hidden in a line in space, along any direction, with an end never, and among vertices at one place.
#[test]
fn vertices_on_a_line_are_hidden_by_the_hull_there() {
    fn check<G: Moving>(rng: &mut Rng) -> usize {
        let (n, extent, most) = (1 + rng.below(12), 1 + rng.below(12) as i64, rng.below(40) as i64);
        let all: Vec<(i64, i64)> = (0..n).map(|_| (rng.within(0, extent), rng.within(0, most))).collect();
        let direction: Vec<i64> = loop {
            let direction: Vec<i64> = (0..G::D).map(|_| rng.within(-2, 2)).collect();
            if direction.iter().any(|&x| x != 0) {
                break direction;
            }
        };
        // As far from zero as coordinates may be, or near it.
        let (unit, origin) = [(1.0, 0.0), (2.0_f64.powi(184), 16.0)][rng.below(2)];
        let square: i64 = direction.iter().map(|x| x * x).sum();
        let points: Vec<G::Point> = all
            .iter()
            .map(|&(x, w)| {
                let mut p = G::Point::default();
                (0..G::D).for_each(|k| p[k] = unit * (origin + (direction[k] * x) as f64));
                // Along a direction distances are as many times as long.
                p[G::D] = unit * unit * (w * square) as f64;
                p
            })
            .collect();
        let t = MovingTriangulation::<G>::new(&points, Options::default()).expect("a build");
        let expected: Vec<VertexId> =
            (0..n).filter(|&k| is_above_on_line(all[k], k, &all)).map(|k| VertexId::new(k as u32)).collect();
        assert_eq!(t.vertices_hidden_by_weight().expect("room"), expected, "{all:?} along {direction:?}");
        expected.len()
    }
    let rng = &mut Rng::new(1);
    let n_hidden: usize = (0..1_500).map(|_| check::<PowerPlane>(rng) + check::<PowerSpace>(rng)).sum();
    assert!(n_hidden > 3_000, "{n_hidden}");
}

/// Vertices in a plane in space are hidden as they are in the plane itself, ties and several at one place included.
#[test]
fn vertices_in_a_plane_are_hidden_by_the_hull_there() {
    let rng = &mut Rng::new(2);
    let mut n_hidden = 0;
    for _ in 0..800 {
        let (n, extent, most) = (3 + rng.below(20), 1 + rng.below(9) as i64, rng.below(20) as i64);
        let across = rng.below(3);
        let (mut in_plane, mut in_space) = (Vec::new(), Vec::new());
        for _ in 0..n {
            let mut p = <PowerPlane as Shape>::Point::default();
            let mut q = <PowerSpace as Shape>::Point::default();
            (p[0], p[1], p[2]) =
                (rng.within(0, extent) as f64, rng.within(0, extent) as f64, rng.within(0, most) as f64);
            (q[across], q[(across + 1) % 3], q[(across + 2) % 3], q[3]) = (7.0, p[0], p[1], p[2]);
            in_plane.push(p);
            in_space.push(q);
        }
        let plane = MovingTriangulation::<PowerPlane>::new(&in_plane, Options::default()).expect("a build");
        let space = MovingTriangulation::<PowerSpace>::new(&in_space, Options::default()).expect("a build");
        let hidden = plane.vertices_hidden_by_weight().expect("room");
        assert_eq!(space.cell_count(), 0);
        assert_eq!(space.vertices_hidden_by_weight(), Ok(hidden.clone()), "{in_plane:?}");
        n_hidden += hidden.len();
    }
    assert!(n_hidden > 2_000, "{n_hidden}");
}

/// Those of a fresh build of the present vertices, by their ids here.
fn fresh<G: Moving>(points: &[Option<G::Point>]) -> Shown {
    let present: Vec<VertexId> = VertexId::range(0..points.len()).filter(|&v| points[v].is_some()).collect();
    let some: Vec<G::Point> = points.iter().copied().flatten().collect();
    let t = MovingTriangulation::<G>::new(&some, Options::default()).expect("a fresh build");
    let (cells, hidden) = shown(&t);
    let named = |ids: &[VertexId]| ids.iter().map(|&v| present[v]).collect::<Vec<_>>();
    (cells.iter().map(|cell| named(cell)).collect(), named(&hidden))
}

/// A history, and what it draws weights from.
struct History<G: Moving> {
    t: MovingTriangulation<G>,
    points: Vec<Option<G::Point>>,
    kind: Kind,
    n: usize,
    /// Weights are integers from 0 to this, times `unit`.
    most: i64,
    unit: f64,
    rng: Rng,
    name: String,
}

impl<G: Moving> History<G> {
    fn new(kind: Kind, seed: u64) -> Self {
        let mut rng = Rng::new(seed);
        let n = G::D + 2 + rng.below(60);
        let most = *rng.pick(&[0, 1, 9, 1000]);
        // The square of a spacing, a tenth of it, or so many that few are left.
        let spacing = match kind {
            Kind::Random => 2000.0 / (n as f64).powf(1.0 / G::D as f64),
            Kind::RoundedSphere | Kind::Sphere => 10.0,
            Kind::Clusters => 100.0,
            _ => 1.0,
        };
        let unit = spacing * spacing * *rng.pick(&[0.1, 1.0, 4.0]) / most.max(1) as f64;
        let mut history = History {
            t: MovingTriangulation::new(&[], Options::default()).expect("room"),
            points: Vec::new(),
            kind,
            n,
            most,
            unit,
            rng,
            name: format!("{}D, {kind:?}, seed {seed}", G::D),
        };
        let points: Vec<G::Point> = (0..n).map(|_| history.draw()).collect();
        history.t = MovingTriangulation::new(&points, Options::default()).expect("room");
        history.points = points.into_iter().map(Some).collect();
        history
    }

    fn weight(&mut self) -> f64 {
        self.rng.within(0, self.most) as f64 * self.unit
    }

    fn draw(&mut self) -> G::Point {
        let mut p = draw_one::<G>(self.kind, self.n, &mut self.rng);
        p[G::D] = self.weight();
        p
    }

    /// Where a vertex goes: near by, anywhere, on another one, or nowhere but with another weight.
    fn goal(&mut self, p: &G::Point) -> G::Point {
        let mut goal = *p;
        match self.rng.below(6) {
            0 => goal = self.draw(),
            1 => {
                let others: Vec<G::Point> = self.points.iter().copied().flatten().collect();
                goal = *self.rng.pick(&others);
                if self.rng.one_in(2) {
                    goal[G::D] = self.weight();
                }
            }
            2 | 3 => goal[G::D] = self.weight(),
            _ => {
                let step = 0.5f64.powi(self.rng.below(12) as i32);
                (0..G::D).for_each(|k| goal[k] += step * (2.0 * self.rng.unit() - 1.0));
                goal[G::D] += self.unit * step * (2.0 * self.rng.unit() - 1.0);
            }
        }
        goal
    }

    fn present(&self) -> Vec<VertexId> {
        VertexId::range(0..self.points.len()).filter(|&v| self.points[v].is_some()).collect()
    }

    fn step(&mut self, what: usize) {
        let present = self.present();
        let some = (!present.is_empty()).then(|| *self.rng.pick(&present));
        match (what, some) {
            (0, Some(v)) if present.len() > 2 => {
                self.t.remove_vertex(v).expect("room");
                self.points[v.index()] = None;
            }
            (1, _) => {
                let q = self.draw();
                self.t.insert_vertex(&q).expect("room");
                self.points.push(Some(q));
            }
            (2, Some(v)) => {
                let q = self.goal(&self.points[v.index()].expect("present"));
                self.t.relocate_vertex(v, &q).expect("room");
                self.points[v.index()] = Some(q);
            }
            _ => {
                let share = *self.rng.pick(&[1, 1, 4, 20]);
                let is_small = self.rng.one_in(2);
                for v in present {
                    if !self.rng.one_in(share) {
                        continue;
                    }
                    let p = self.points[v.index()].expect("present");
                    let mut q = p;
                    if is_small {
                        (0..=G::D).for_each(|k| q[k] += 1e-4 * self.unit * (2.0 * self.rng.unit() - 1.0));
                    } else {
                        q = self.goal(&p);
                    }
                    self.t.move_vertices(&[v], &[q]).expect("good places");
                    self.points[v.index()] = Some(q);
                }
                self.commit();
            }
        }
    }

    fn commit(&mut self) {
        let algorithm = *self.rng.pick(&Algorithm::ALL);
        self.t.set_algorithm(algorithm);
        if self.rng.one_in(4) {
            // Prepared, taken back and staged again; or published.
            let before = shown(&self.t);
            self.t.prepare_timestamp().expect("room");
            let prepared = shown(&self.t);
            self.t.withdraw_timestamp();
            assert_eq!(shown(&self.t), before, "{}: withdrawn", self.name);
            for v in self.present() {
                let q = self.points[v.index()].expect("present");
                if self.t.position(v) != Ok(q) {
                    self.t.move_vertices(&[v], &[q]).expect("good places");
                }
            }
            self.t.prepare_timestamp().expect("room");
            assert_eq!(shown(&self.t), prepared, "{}: prepared again", self.name);
            self.t.publish_timestamp().expect("it is prepared");
        } else {
            self.stage_edits();
            self.t.commit_timestamp().expect("room");
        }
        self.name += &format!(" {algorithm:?}");
    }

    /// Sometimes: some vertices come, and others go.
    fn stage_edits(&mut self) {
        if self.rng.one_in(2) {
            return;
        }
        let coming: Vec<G::Point> = (0..self.rng.below(4)).map(|_| self.draw()).collect();
        self.t.stage_insertions(&coming).expect("room");
        let present = self.present();
        let n_going = if present.len() > 4 { self.rng.below(4) } else { 0 };
        let mut going: Vec<VertexId> = (0..n_going).map(|_| *self.rng.pick(&present)).collect();
        going.sort_unstable();
        going.dedup();
        self.t.stage_removals(&going).expect("present");
        going.iter().for_each(|&v| self.points[v.index()] = None);
        self.points.extend(coming.into_iter().map(Some));
    }

    /// The present vertices get the ids from 0 on; cells and the hidden ones follow.
    fn compact(&mut self) {
        self.t.compact().expect("room");
        self.points.retain(Option::is_some);
    }

    fn check(&self) {
        let context = || self.name.clone();
        let (cells, hidden) = shown(&self.t);
        let (fresh_cells, fresh_hidden) = fresh::<G>(&self.points);
        assert_same_cells(&cells, &fresh_cells, context);
        assert_eq!(hidden, fresh_hidden, "{}", self.name);
        check_adjacency(&self.t, &context);
        for (v, p) in VertexId::range(0..self.points.len()).zip(&self.points) {
            assert_eq!(self.t.position(v).ok(), *p, "{}: vertex {v}", self.name);
        }
    }
}

fn histories_match<G: Moving>(n: u64) {
    let mut n_hidden = 0;
    for kind in KINDS {
        for seed in seeds(n) {
            let mut history = History::<G>::new(kind, seed);
            history.check();
            for _ in 0..16 {
                let what = history.rng.below(8);
                history.step(what);
                history.check();
                n_hidden += history.t.vertices_hidden_by_weight().expect("room").len();
                if history.rng.one_in(8) {
                    history.compact();
                    history.check();
                }
                if history.rng.one_in(8) {
                    history.t = history.t.try_clone(None).expect("room");
                    history.check();
                }
            }
        }
    }
    assert!(n_hidden as u64 > 50 * n, "{n_hidden} hidden");
}

#[test]
fn histories_in_the_plane_match_fresh_builds() {
    histories_match::<PowerPlane>(40);
}

#[test]
fn histories_in_space_match_fresh_builds() {
    histories_match::<PowerSpace>(25);
}

/// So many vertices that cells are sorted, and what is above them with them.
fn large_sets_match<G: Moving>(n: usize) {
    let rng = &mut Rng::new(3);
    let mut point = |_| {
        let mut p = G::Point::default();
        (0..G::D).for_each(|k| p[k] = rng.unit());
        p[G::D] = 0.8 * (n as f64).powf(-2.0 / G::D as f64) * rng.unit();
        p
    };
    let mut points: Vec<G::Point> = (0..n).map(&mut point).collect();
    let mut t = MovingTriangulation::<G>::new(&points, Options::default()).expect("a build");
    for algorithm in [Algorithm::Repair, Algorithm::Watching, Algorithm::Tolerance, Algorithm::Auto] {
        t.set_algorithm(algorithm);
        for _ in 0..2 {
            let unit = (n as f64).powf(-1.0 / G::D as f64);
            for p in &mut points {
                let other = point(0);
                (0..G::D).for_each(|k| p[k] += 0.02 * unit * (other[k] - 0.5));
                p[G::D] += 0.02 * (other[G::D] - p[G::D]);
            }
            t.commit_positions(&points).expect("room");
        }
        let (cells, hidden) = shown(&t);
        let present: Vec<Option<G::Point>> = points.iter().copied().map(Some).collect();
        let (fresh_cells, fresh_hidden) = fresh::<G>(&present);
        assert_same_cells(&cells, &fresh_cells, || format!("{algorithm:?}"));
        assert_eq!(hidden, fresh_hidden, "{algorithm:?}");
        assert!(hidden.len() > n / 200, "{} hidden", hidden.len());
    }
}

/// Vertices so many that what their relocation reads is asked for in advance, of hidden ones as well.
#[test]
fn sets_beyond_a_cache_match_fresh_builds() {
    fn check<G: Moving>(n: usize) {
        let rng = &mut Rng::new(4);
        let spacing = (n as f64).powf(-1.0 / G::D as f64);
        let mut points = vec![G::Point::default(); n];
        for p in &mut points {
            (0..G::D).for_each(|k| p[k] = rng.unit());
            p[G::D] = 4.0 * spacing * spacing * rng.unit();
        }
        let mut t = MovingTriangulation::<G>::new(&points, Options::default()).expect("a build");
        for algorithm in [Algorithm::Repair, Algorithm::Placement, Algorithm::PlacementFlips] {
            t.set_algorithm(algorithm);
            for p in &mut points {
                (0..G::D).for_each(|k| p[k] += 1e-3 * spacing * (rng.unit() - 0.5));
                p[G::D] += 0.1 * spacing * spacing * (rng.unit() - 0.5);
            }
            t.commit_positions(&points).expect("room");
        }
        let present: Vec<Option<G::Point>> = points.iter().copied().map(Some).collect();
        let (cells, hidden) = shown(&t);
        let (fresh_cells, fresh_hidden) = fresh::<G>(&present);
        assert_same_cells(&cells, &fresh_cells, || format!("{}D", G::D));
        assert_eq!(hidden, fresh_hidden, "{}D", G::D);
    }
    check::<PowerPlane>(40_000);
    check::<PowerSpace>(40_000);
}

#[test]
fn large_sets_match_fresh_builds() {
    large_sets_match::<PowerPlane>(20_000);
    large_sets_match::<PowerSpace>(6_000);
}
