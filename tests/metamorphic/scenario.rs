//! Points and moves that can be changed as a whole.

use crate::common::inputs::{Kind, draw, draw_one, quantized};
use crate::common::{CellSet, Rng, cell_set, point, vertices};
use deldrift::motion::{MovingTriangulation, Options};
use deldrift::{Dimension, VertexId};

/// Inputs, and motions that go with them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    Of(Kind),
    /// Points of a few planes, which tremble in them.
    Layers,
}

pub const FAMILIES: [Family; 9] = [
    Family::Of(Kind::Random),
    Family::Of(Kind::Lattice),
    Family::Of(Kind::Sphere),
    Family::Of(Kind::RoundedSphere),
    Family::Of(Kind::Line),
    Family::Of(Kind::Hyperplane),
    Family::Of(Kind::Clusters),
    Family::Of(Kind::Duplicates),
    Family::Layers,
];

/// What is staged for a commit.
pub struct Moves<G: Dimension> {
    pub vertices: Vec<VertexId>,
    pub targets: Vec<G::Point>,
}

impl<G: Dimension> Moves<G> {
    /// The positions after them.
    pub fn applied(&self, positions: &[G::Point]) -> Vec<G::Point> {
        let mut now = positions.to_vec();
        for (&v, &q) in self.vertices.iter().zip(&self.targets) {
            now[v] = q;
        }
        now
    }

    /// Some of them, and the others.
    pub fn halves(&self, rng: &mut Rng) -> (Self, Self) {
        let mut halves = [(); 2].map(|()| Moves { vertices: Vec::new(), targets: Vec::new() });
        for (&v, &q) in self.vertices.iter().zip(&self.targets) {
            let half = &mut halves[rng.below(2)];
            half.vertices.push(v);
            half.targets.push(q);
        }
        halves.into()
    }
}

/// Points, and the moves of several commits.
pub struct Scenario<G: Dimension> {
    pub name: String,
    pub kind: Kind,
    pub points: Vec<G::Point>,
    pub steps: Vec<Moves<G>>,
}

/// The motions of a scenario: the first three use tolerances up.
const MOTIONS: usize = 9;
/// Those that keep points in general position.
const GENERAL: [usize; 6] = [0, 1, 2, 8, 1, 0];

impl<G: Dimension> Scenario<G> {
    pub fn new(family: Family, seed: u64) -> Self {
        let rng = &mut Rng::new(seed ^ 0x6d65);
        let n = if seed.is_multiple_of(2) { 25 + rng.below(20) } else { 90 + rng.below(60) };
        let kind = if let Family::Of(kind) = family { kind } else { Kind::Random };
        let mut points = draw::<G>(kind, n, rng);
        if family == Family::Layers {
            points.iter_mut().for_each(|p| p[G::D - 1] = rng.below(4) as f64);
        }
        let mut order: Vec<usize> = (0..MOTIONS).collect();
        rng.shuffle(&mut order);
        let name = format!("{}D, {family:?}, {n} points, seed {seed}", G::D);
        Self::of(name, kind, points, &order, rng)
    }

    pub fn in_general_position(seed: u64) -> Self {
        let rng = &mut Rng::new(seed ^ 0x6765);
        let n = 60 + rng.below(100);
        let points = draw::<G>(Kind::Random, n, rng);
        let name = format!("{}D, general position, {n} points, seed {seed}", G::D);
        Self::of(name, Kind::Random, points, &GENERAL, rng)
    }

    fn of(name: String, kind: Kind, points: Vec<G::Point>, motions: &[usize], rng: &mut Rng) -> Self {
        let mut now = points.clone();
        let mut steps = Vec::new();
        for &motion in motions {
            let moves = moves::<G>(motion, kind, &now, rng);
            now = moves.applied(&now);
            steps.push(moves);
        }
        Scenario { name, kind, points, steps }
    }

    /// The cells in the beginning and after every commit.
    pub fn run(&self, options: Options) -> Vec<CellSet> {
        let mut t = MovingTriangulation::<G>::new(&self.points, options).expect("a build");
        let mut cells = vec![cell_set(&t)];
        for moves in &self.steps {
            if moves.vertices.iter().copied().eq(vertices().take(self.points.len())) {
                t.commit_positions(&moves.targets).expect("a commit");
            } else {
                t.move_vertices(&moves.vertices, &moves.targets).expect("good moves");
                t.commit_timestamp().expect("a commit");
            }
            cells.push(cell_set(&t));
        }
        cells
    }

    /// With all positions replaced, exactly: `inverse` leads back.
    pub fn mapped(
        &self,
        map: impl Fn(&G::Point) -> G::Point,
        inverse: impl Fn(&G::Point) -> G::Point,
    ) -> Self {
        let exactly = |p: &G::Point| {
            let q = map(p);
            assert_eq!(inverse(&q), *p, "{q:?} is rounded");
            q
        };
        let step = |moves: &Moves<G>| Moves {
            vertices: moves.vertices.clone(),
            targets: moves.targets.iter().map(exactly).collect(),
        };
        Scenario {
            name: self.name.clone(),
            kind: self.kind,
            points: self.points.iter().map(exactly).collect(),
            steps: self.steps.iter().map(step).collect(),
        }
    }

    /// With other ids: vertex `i` is what vertex `order[i]` was.
    pub fn reordered(&self, order: &[VertexId]) -> Self {
        let mut new = vec![VertexId::NONE; order.len()];
        order.iter().zip(vertices()).for_each(|(&old, v)| new[old] = v);
        let step = |moves: &Moves<G>| Moves {
            vertices: moves.vertices.iter().map(|&v| new[v]).collect(),
            targets: moves.targets.clone(),
        };
        Scenario {
            name: self.name.clone(),
            kind: self.kind,
            points: order.iter().map(|&v| self.points[v]).collect(),
            steps: self.steps.iter().map(step).collect(),
        }
    }
}

/// The moves of a motion from where the vertices are.
fn moves<G: Dimension>(motion: usize, kind: Kind, now: &[G::Point], rng: &mut Rng) -> Moves<G> {
    let share = if motion < 3 { 1 } else { *rng.pick(&[1, 1, 3, 10]) };
    let chosen: Vec<VertexId> = VertexId::range(0..now.len()).filter(|_| rng.one_in(share)).collect();
    let size = [0.5f64.powi(14), 0.5f64.powi(8), 0.5f64.powi(8)][motion.min(2)];
    let axis = rng.below(G::D);
    let mut target = |i: usize, v: VertexId| {
        let p = now[v];
        quantized::<G>(match motion {
            0..3 => point::<G>(|k| p[k] + size * (2.0 * rng.unit() - 1.0)),
            // Lattices stay lattices, layers stay layers.
            3 => point::<G>(|k| if k == axis { p[k] + rng.within(-1, 1) as f64 } else { p[k] }),
            // Two by two, vertices exchange their places.
            4 => now[*chosen.get(i ^ 1).unwrap_or(&v)],
            5 if i.is_multiple_of(3) => now[rng.below(now.len())],
            // Onto a hyperplane.
            6 => point::<G>(|k| if k == axis { 1.0 } else { p[k] }),
            7 => draw_one::<G>(kind, now.len(), rng),
            8 if i.is_multiple_of(5) => point::<G>(|_| 3000.0 * (2.0 * rng.unit() - 1.0)),
            _ => p,
        })
    };
    let targets = chosen.iter().enumerate().map(|(i, &v)| target(i, v)).collect();
    Moves { vertices: chosen, targets }
}
