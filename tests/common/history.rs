//! A triangulation with everything that it should say about itself: random histories, checked step by step.

use super::carried::{self, List};
use super::exact::{Grid, orientation, representatives, squared_distance};
use super::inputs::{Kind, QUANTUM, draw, draw_one, quantized, to_grid};
use super::{
    CellSet, Rng, assert_same_cells, cell_set, check_adjacency, fresh_cells, point, sorted, vertices,
};
use deldrift::motion::{Algorithm, Level, Location, MovingTriangulation, Options};
use deldrift::{CellId, Moving, VertexId};
use std::collections::BTreeMap;

/// How a set of vertices moves from one timestamp to the next.
#[derive(Clone, Copy, Debug)]
enum Motion {
    /// A little, by a power of two drawn once.
    Jitter,
    /// By at most one unit along each axis: lattices stay degenerate.
    Hop,
    /// Two by two, vertices exchange their places.
    Swap,
    /// Onto other vertices.
    Meet,
    /// To new random places, drawn as the input was.
    Redraw,
    /// Far away, outside the hull as a rule.
    Teleport,
    /// Onto a hyperplane, a line or a point.
    Collapse,
    /// By a shear along the first axis.
    Shear,
    /// By a rotation in the plane of the first two axes, rounded: the hull turns.
    Rotate,
    /// To the other side of the first coordinate plane.
    Mirror,
    /// By a factor two, larger or smaller.
    Scale,
}

const MOTIONS: [Motion; 11] = [
    Motion::Jitter,
    Motion::Hop,
    Motion::Swap,
    Motion::Meet,
    Motion::Redraw,
    Motion::Teleport,
    Motion::Collapse,
    Motion::Shear,
    Motion::Rotate,
    Motion::Mirror,
    Motion::Scale,
];

/// A triangulation under test, and what it should hold.
pub struct History<G: Moving> {
    pub t: MovingTriangulation<G>,
    /// Positions by id at the timestamp; `None` once removed.
    pub positions: Vec<Option<G::Point>>,
    staged: BTreeMap<VertexId, G::Point>,
    /// Cells when the changes were last taken.
    baseline: CellSet,
    timestamp: u64,
    kind: Kind,
    name: String,
    /// What has been done.
    log: Vec<String>,
    pub rng: Rng,
}

impl<G: Moving> History<G> {
    pub fn new(kind: Kind, n: usize, seed: u64) -> Self {
        let mut rng = Rng::new(seed);
        let points = draw::<G>(kind, n, &mut rng);
        let name = format!("{}D, {kind:?}, {n} points, seed {seed}", G::D);
        Self::of(points, kind, name, rng)
    }

    pub fn of(points: Vec<G::Point>, kind: Kind, name: String, rng: Rng) -> Self {
        let t = MovingTriangulation::new(&points, Options::default())
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let positions = points.into_iter().map(Some).collect();
        let (staged, log) = (BTreeMap::new(), Vec::new());
        History { t, positions, staged, baseline: CellSet::new(), timestamp: 0, kind, name, log, rng }
    }

    pub fn context(&self) -> String {
        let from = self.log.len().saturating_sub(12);
        format!("{}, step {}: ... {}", self.name, self.log.len(), self.log[from..].join("; "))
    }

    fn present(&self) -> Vec<VertexId> {
        VertexId::range(0..self.positions.len()).filter(|&v| self.positions[v].is_some()).collect()
    }

    fn at(&self, v: VertexId) -> G::Point {
        self.positions[v].expect("present")
    }

    /// The call must succeed.
    fn expect<T>(&self, result: deldrift::Result<T>) -> T {
        result.unwrap_or_else(|error| panic!("{}: {error}", self.context()))
    }

    pub fn insert(&mut self, q: G::Point) -> VertexId {
        self.log.push(format!("insert {q:?}"));
        let inserted = self.t.insert_vertex(&q);
        let id = self.expect(inserted);
        assert_eq!(id.index(), self.positions.len(), "{}", self.context());
        self.positions.push(Some(q));
        id
    }

    pub fn remove(&mut self, v: VertexId) {
        self.log.push(format!("remove {v}"));
        let removed = self.t.remove_vertex(v);
        self.expect(removed);
        self.positions[v] = None;
        self.staged.remove(&v);
    }

    pub fn relocate(&mut self, v: VertexId, q: G::Point) {
        self.log.push(format!("relocate {v} to {q:?}"));
        let relocated = self.t.relocate_vertex(v, &q);
        self.expect(relocated);
        self.positions[v] = Some(q);
    }

    pub fn stage(&mut self, v: VertexId, q: G::Point) {
        let staged = self.t.move_vertices(&[v], &[q]);
        self.expect(staged);
        self.staged.insert(v, q);
    }

    pub fn commit(&mut self, algorithm: Algorithm) {
        self.log.push(format!("commit {} moves by {algorithm:?}", self.staged.len()));
        assert_eq!(self.t.staged_count(), self.staged.len(), "{}", self.context());
        self.t.set_algorithm(algorithm);
        let committed = self.t.commit_timestamp();
        let report = self.expect(committed);
        let mut moved = 0;
        for (v, q) in std::mem::take(&mut self.staged) {
            moved += u64::from(self.positions[v] != Some(q));
            self.positions[v] = Some(q);
        }
        self.timestamp += 1;
        assert_eq!((report.timestamp, report.moved), (self.timestamp, moved), "{}", self.context());
    }

    fn discard(&mut self) {
        self.log.push("discard".to_string());
        assert_eq!(self.t.discard_moves(), self.staged.len(), "{}", self.context());
        self.staged.clear();
    }

    /// Goes on with another triangulation, which should be the same; `knows_changes` unless it has been loaded.
    pub fn replace(&mut self, t: MovingTriangulation<G>, knows_changes: bool) -> MovingTriangulation<G> {
        self.log.push(format!("replaced, knows changes: {knows_changes}"));
        if !knows_changes {
            self.baseline.clear();
        }
        std::mem::replace(&mut self.t, t)
    }

    /// Some random calls, checked; returns after a check.
    pub fn step(&mut self) {
        match self.rng.below(8) {
            0..=2 => self.immediate_calls(),
            3 => {
                self.stage_motion();
                if self.rng.one_in(3) {
                    self.immediate_calls();
                } else {
                    self.discard();
                }
            }
            _ => {
                self.stage_motion();
                let algorithm = *self.rng.pick(&Algorithm::ALL);
                self.commit(algorithm);
            }
        }
        self.check();
    }

    /// Insertions, removals and relocations of a few vertices, staged moves notwithstanding.
    fn immediate_calls(&mut self) {
        for _ in 0..1 + self.rng.below(3) {
            let present = self.present();
            let some = if present.is_empty() { VertexId::new(0) } else { *self.rng.pick(&present) };
            match self.rng.below(4) {
                0 => {
                    let q = if present.is_empty() || self.rng.one_in(2) {
                        draw_one::<G>(self.kind, self.positions.len(), &mut self.rng)
                    } else {
                        self.destination(Motion::Meet, some)
                    };
                    self.insert(q);
                }
                1 if !present.is_empty() => self.remove(some),
                _ if !present.is_empty() && !self.staged.contains_key(&some) => {
                    let motion = *self.rng.pick(&MOTIONS);
                    let q = self.destination(motion, some);
                    self.relocate(some, q);
                }
                _ => {}
            }
        }
    }

    /// Stages moves by one rule of all vertices, of many or of a few, where none is staged yet.
    fn stage_motion(&mut self) {
        let motion = *self.rng.pick(&MOTIONS);
        let share = *self.rng.pick(&[1, 1, 2, 10]);
        self.log.push(format!("stage {motion:?} of one in {share}"));
        let mut chosen: Vec<VertexId> = self.present();
        chosen.retain(|v| self.rng.one_in(share) && !self.staged.contains_key(v));
        self.rng.shuffle(&mut chosen);
        let scale = 0.5f64.powi(self.rng.below(18) as i32);
        let (first, second, third) = (self.rng.unit(), self.rng.below(3), self.rng.below(3));
        for pair in chosen.chunks(2) {
            if let (Motion::Swap, &[v, w]) = (motion, pair) {
                let (p, q) = (self.at(v), self.at(w));
                self.stage(v, q);
                self.stage(w, p);
                continue;
            }
            for &v in pair {
                let p = self.at(v);
                let q = match motion {
                    Motion::Jitter => point::<G>(|k| p[k] + scale * (2.0 * self.rng.unit() - 1.0)),
                    // One and the same map for all.
                    Motion::Collapse => {
                        point::<G>(|k| if k + 1 == G::D || k < second { third as f64 } else { p[k] })
                    }
                    Motion::Shear => {
                        point::<G>(|k| if k == 0 { p[0] + p[1] * (second as f64 - 1.0) } else { p[k] })
                    }
                    Motion::Rotate => {
                        let (sin, cos) = (6.3 * first).sin_cos();
                        point::<G>(|k| [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1], p[G::D - 1]][k])
                    }
                    Motion::Scale => point::<G>(|k| if second == 0 { p[k] * 2.0 } else { p[k] * 0.5 }),
                    _ => self.destination(motion, v),
                };
                self.stage(v, quantized::<G>(q));
            }
        }
    }

    /// Where one vertex goes.
    fn destination(&mut self, motion: Motion, v: VertexId) -> G::Point {
        let p = self.at(v);
        let present = self.present();
        let other = *self.rng.pick(&present);
        let other = self.at(other);
        let rng = &mut self.rng;
        quantized::<G>(match motion {
            Motion::Jitter => point::<G>(|k| p[k] + (2.0 * rng.unit() - 1.0) / 64.0),
            Motion::Hop => point::<G>(|k| p[k] + rng.within(-1, 1) as f64),
            Motion::Swap | Motion::Meet => other,
            Motion::Redraw => draw_one::<G>(self.kind, self.positions.len(), rng),
            Motion::Teleport => point::<G>(|_| 3000.0 * (2.0 * rng.unit() - 1.0)),
            Motion::Collapse => point::<G>(|k| if k == 0 { p[k] } else { other[k] }),
            Motion::Shear | Motion::Rotate => point::<G>(|k| if k == 0 { p[0] + p[1] } else { p[k] }),
            Motion::Mirror => point::<G>(|k| if k == 0 { -p[0] } else { p[k] }),
            Motion::Scale => point::<G>(|k| 2.0 * p[k]),
        })
    }

    /// Compares everything that the triangulation says with what it should say.
    pub fn check(&mut self) {
        self.check_cells();
        self.check_vertices();
        self.check_changes();
        self.check_stars();
        for _ in 0..3 {
            let q = self.query();
            self.check_location(&q);
            self.check_nearest(&q);
        }
    }

    pub fn check_cells(&self) {
        if let Err(violation) = self.t.validate(Level::Delaunay) {
            panic!("{}: {violation}", self.context());
        }
        assert_same_cells(&cell_set(&self.t), &fresh_cells::<G>(&self.positions), || self.context());
        check_adjacency(&self.t, &|| self.context());
    }

    fn check_vertices(&self) {
        let representatives = representatives(&self.positions);
        let hidden = vertices().zip(&representatives).filter(|(v, r)| r.is_some_and(|r| r != *v)).count();
        assert_eq!(self.t.statistics().coincident, hidden as u64, "{}", self.context());
        assert_eq!(self.t.vertex_count(), self.positions.iter().flatten().count(), "{}", self.context());
        assert_eq!(self.t.id_count(), self.positions.len(), "{}", self.context());
        assert_eq!(self.t.staged_count(), self.staged.len(), "{}", self.context());
        assert_eq!(self.t.timestamp(), self.timestamp, "{}", self.context());
        for (v, (p, representative)) in vertices().zip(self.positions.iter().zip(representatives)) {
            assert_eq!(self.t.is_present(v), p.is_some(), "{}: vertex {v}", self.context());
            assert_eq!(self.t.position(v).ok(), *p, "{}: vertex {v}", self.context());
            assert_eq!(
                self.t.coincident_representative(v).ok(),
                representative,
                "{}: vertex {v}",
                self.context()
            );
        }
    }

    fn check_changes(&mut self) {
        let taken = carried::take(&mut self.t);
        let List { created, removed_corners, .. } = self.expect(taken);
        let corners = self.t.cells().expect("room").corners;
        let created_cells: CellSet = created.iter().map(|&c| sorted(corners[c].as_ref())).collect();
        let removed_cells: CellSet = removed_corners.iter().map(|row| sorted(row)).collect();
        let now = cell_set(&self.t);
        let difference = |of: &CellSet, from: &CellSet| of.difference(from).cloned().collect();
        let context = |what| format!("{what} cells, {}", self.context());
        assert_same_cells(&created_cells, &difference(&now, &self.baseline), || context("created"));
        assert_same_cells(&removed_cells, &difference(&self.baseline, &now), || context("removed"));
        assert!(created.is_sorted_by(|a, b| a < b), "{}", self.context());
        self.baseline = now;
    }

    fn check_stars(&mut self) {
        let present = self.present();
        let mut star = Vec::new();
        for _ in 0..present.len().min(5) {
            let v = *self.rng.pick(&present);
            let representative = self.expect(self.t.coincident_representative(v));
            self.expect(self.t.star(v, &mut star));
            star.sort_unstable();
            let corners = self.t.cells().expect("room").corners;
            let has = |c: &CellId| corners[*c].as_ref().contains(&representative);
            let expected: Vec<CellId> = CellId::range(0..corners.len()).filter(has).collect();
            assert_eq!(star, expected, "{}: star of {v}", self.context());
        }
    }

    /// A point to ask about: anywhere, at a vertex, between two, or beyond one.
    fn query(&mut self) -> G::Point {
        let present = self.present();
        if present.is_empty() || self.rng.one_in(4) {
            return draw_one::<G>(self.kind, self.positions.len(), &mut self.rng);
        }
        let (a, b) = (*self.rng.pick(&present), *self.rng.pick(&present));
        let (a, b, share) = (self.at(a), self.at(b), *self.rng.pick(&[0.0, 0.5, 0.25, 1.5]));
        quantized::<G>(point::<G>(|k| a[k] + share * (b[k] - a[k])))
    }

    fn grid(&self, v: VertexId) -> Grid {
        to_grid::<G>(&self.at(v))
    }

    /// Orientations of a cell with each of its corners replaced by a
    /// point: none is negative iff the cell holds it.
    fn sides(&self, cell: &G::Vertices, q: &Grid) -> Vec<i128> {
        let corners: Vec<Grid> = cell.as_ref().iter().map(|&v| self.grid(v)).collect();
        let side = |i: usize| {
            let points: Vec<&Grid> = (0..=G::D).map(|j| if i == j { q } else { &corners[j] }).collect();
            orientation(&points)
        };
        (0..=G::D).map(side).collect()
    }

    fn check_location(&self, q: &G::Point) {
        let context = || format!("{}: location of {q:?}", self.context());
        let grid = to_grid::<G>(q);
        let cells = self.t.cells().expect("room");
        let holds = |c: CellId| self.sides(&cells.corners[c], &grid).iter().all(|&side| side >= 0);
        let at = self.positions.iter().position(|p| p.as_ref() == Some(q));
        match self.expect(self.t.locate(q)) {
            Location::Vertex(v) => assert_eq!(Some(v.index()), at, "{}", context()),
            Location::NoCells => assert!(at.is_none() && cells.corners.is_empty(), "{}", context()),
            Location::Cell(c) => assert!(at.is_none() && holds(c), "{}: cell {c}", context()),
            Location::Outside(c) => {
                let sides = self.sides(&cells.corners[c], &grid);
                let is_beyond =
                    (0..=G::D).any(|i| cells.neighbours[c][i] == deldrift::motion::NO_CELL && sides[i] < 0);
                assert!(
                    is_beyond && !CellId::range(0..cells.corners.len()).any(holds),
                    "{}: outside {c}",
                    context()
                );
            }
        }
    }

    fn check_nearest(&self, q: &G::Point) {
        let grid = to_grid::<G>(q);
        let nearest = self.present().into_iter().min_by_key(|&v| (squared_distance(&self.grid(v), &grid), v));
        assert_eq!(self.expect(self.t.nearest_vertex(q)), nearest, "{}: nearest to {q:?}", self.context());
    }
}

/// Everything that a call without effect must leave as it was.
#[derive(Debug, PartialEq)]
pub struct Snapshot<P> {
    positions: Vec<Option<P>>,
    representatives: Vec<Option<VertexId>>,
    cells: CellSet,
    staged: usize,
    timestamp: u64,
    vertices: usize,
}

impl<P> Snapshot<P> {
    /// Of a valid triangulation.
    pub fn of<G: Moving<Point = P>>(t: &MovingTriangulation<G>) -> Self {
        let ids = VertexId::range(0..t.id_count());
        if let Err(violation) = t.validate(Level::Delaunay) {
            panic!("{violation}");
        }
        Snapshot {
            positions: ids.clone().map(|v| t.position(v).ok()).collect(),
            representatives: ids.map(|v| t.coincident_representative(v).ok()).collect(),
            cells: cell_set(t),
            staged: t.staged_count(),
            timestamp: t.timestamp(),
            vertices: t.vertex_count(),
        }
    }
}

/// A displacement of at most so many quanta along each axis.
pub fn nudged<G: Moving>(p: &G::Point, quanta: i64, rng: &mut Rng) -> G::Point {
    quantized::<G>(point::<G>(|k| p[k] + QUANTUM * rng.within(-quanta, quanta) as f64))
}
