//! Histories of vertices in a box that repeats: they move, come and go, in the period that they like, while the box is
//! strained, sheared, and given by other vectors of its lattice.

use super::fingerprint::mixed;
use super::{Outcome, Tally};
use crate::common::{Rng, point};
use deldrift::motion::{Algorithm, Level, MovingTriangulation, NO_CELL, Options};
use deldrift::periodic::PeriodicTriangulation;
use deldrift::{Dimension, VertexId};
use std::collections::BTreeSet;

/// Numbers are multiples of this, before they are scaled.
const UNIT: f64 = 1.0 / (1u64 << 20) as f64;

/// A cell as it is in space, wherever: its vertices in order, and by how much each is away from the first, in bits.
type Class = Vec<(u32, Vec<u64>)>;

/// What vertices are like.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Random,
    /// Of eighths of the box.
    Lattice,
    /// At few places, in several periods.
    Coincident,
    Clusters,
    Layers,
}

const KINDS: [Kind; 6] =
    [Kind::Random, Kind::Random, Kind::Lattice, Kind::Coincident, Kind::Clusters, Kind::Layers];

pub struct BoxHistory<G: Dimension> {
    t: PeriodicTriangulation<G>,
    /// Short vectors of the lattice.
    short: Vec<G::Point>,
    /// By vector that is given, its multiples of the short ones.
    multiples: [[i64; 3]; 3],
    /// By id, where each has been given; `None` once removed.
    now: Vec<Option<G::Point>>,
    kind: Kind,
    /// A power of two, by which all is multiplied.
    scale: f64,
    /// Copies up to so many periods away are as many as are needed; 0 where that would be too many.
    n_copies: i64,
    rng: Rng,
    name: String,
    tally: Tally,
    checksum: u64,
    is_loud: bool,
}

impl<G: Dimension> BoxHistory<G> {
    pub fn new(seed: u64, is_loud: bool) -> Self {
        let mut rng = Rng::new(seed ^ 0xb0_0000_0000);
        let rank = if rng.one_in(3) { 1 + rng.below(G::D) } else { G::D };
        let n = *rng.pick(&[1, 2, 3, 5, 8, 20, 60, 200]);
        let kind = *rng.pick(&KINDS);
        let scale = 2f64.powi(*rng.pick(&[0, 0, 0, 60, -60, 90]));
        let shape = rng.below(4);
        let short = short_vectors::<G>(shape, rank, &mut rng);
        let algorithm =
            *rng.pick(&[Algorithm::Auto, Algorithm::Auto, Algorithm::Repair, Algorithm::PlacementFlips]);
        let mut multiples = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
        skew(&mut multiples, rank, &mut rng);
        let now: Vec<_> = (0..n).map(|_| Some(draw::<G>(kind, &short, &mut rng))).collect();
        let name = format!(
            "seed {seed}: {}D, {rank} vectors {short:?}, {n} {kind:?}, {scale:e}, {algorithm:?}",
            G::D
        );
        if is_loud {
            println!("{name}");
        }
        let positions: Vec<_> = now.iter().flatten().map(|p| scaled::<G>(p, scale)).collect();
        let vectors = given::<G>(&short, &multiples, scale);
        let options = Options { algorithm, threads: 1 + rng.below(2) as u32, ..Options::default() };
        let t = PeriodicTriangulation::new(&positions, &vectors, options)
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let tally = Tally { histories: 1, ..Tally::default() };
        let n_copies = [3, 3, 0, 5][shape];
        BoxHistory { t, short, multiples, now, kind, scale, n_copies, rng, name, tally, checksum: 0, is_loud }
    }

    /// Runs it to its end.
    pub fn run(mut self) -> Outcome {
        self.check(true);
        for _ in 0..16 {
            let what = self.step();
            if self.is_loud {
                println!("{what}");
            }
            self.tally.commits += 1;
            self.check(self.tally.commits.is_multiple_of(4));
        }
        Outcome { tally: self.tally, checksum: self.checksum }
    }

    fn present(&self) -> Vec<VertexId> {
        VertexId::range(0..self.now.len()).filter(|v| self.now[v.index()].is_some()).collect()
    }

    /// One commit.
    fn step(&mut self) -> &'static str {
        let size = *self.rng.pick(&[1i64, 1 << 8, 1 << 13, 1 << 16, 1 << 18]);
        if self.rng.one_in(4) {
            self.withdraw(size);
        }
        match self.rng.below(8) {
            0 => {
                let some: Vec<_> = self.present().into_iter().filter(|_| self.rng.one_in(3)).collect();
                let goals: Vec<_> = some.iter().map(|&v| self.moved(self.now[v.index()], size)).collect();
                let places: Vec<_> = goals.iter().map(|p| scaled::<G>(p, self.scale)).collect();
                self.t.move_vertices(&some, &places).expect("vertices that are there");
                some.iter().zip(goals).for_each(|(v, p)| self.now[v.index()] = Some(p));
                self.commit();
                "some move"
            }
            1 => {
                let n = 1 + self.rng.below(3);
                let more: Vec<_> = (0..n).map(|_| draw::<G>(self.kind, &self.short, &mut self.rng)).collect();
                let places: Vec<_> = more.iter().map(|p| scaled::<G>(p, self.scale)).collect();
                let first = self.t.stage_insertions(&places).expect("places");
                assert_eq!(first.index(), self.now.len(), "{}", self.name);
                self.tally.insertions += n as u64;
                // Few go without a build.
                let share = *self.rng.pick(&[4, 40]);
                let going: Vec<_> = self.present().into_iter().filter(|_| self.rng.one_in(share)).collect();
                self.t.stage_removals(&going).expect("vertices that are there");
                self.tally.removals += going.len() as u64;
                self.now.extend(more.into_iter().map(Some));
                going.iter().for_each(|v| self.now[v.index()] = None);
                self.commit();
                "some come and go"
            }
            2 => {
                let before = self.short.clone();
                for b in &mut self.short {
                    let rng = &mut self.rng;
                    *b = point::<G>(|k| {
                        if b[k] == 0.0 { 0.0 } else { b[k] + rng.within(-(1 << 13), 1 << 13) as f64 * UNIT }
                    });
                }
                if self.rng.one_in(2) {
                    // What is in the box goes with it.
                    for p in self.now.iter_mut().flatten() {
                        let shares = point::<G>(|k| p[k]);
                        for (j, (b, old)) in self.short.iter().zip(&before).enumerate() {
                            let share = (64.0 * shares[j]).round() / 64.0;
                            *p = point::<G>(|k| p[k] + ((b[k] - old[k]) * share / UNIT).round() * UNIT);
                        }
                    }
                }
                self.all_in_other_vectors();
                "the box is strained"
            }
            3 => {
                skew(&mut self.multiples, self.short.len(), &mut self.rng);
                self.all_in_other_vectors();
                "other vectors of the lattice"
            }
            kind => {
                let drift = if kind == 4 {
                    point::<G>(|_| self.rng.within(-(1 << 17), 1 << 17) as f64 * UNIT)
                } else {
                    G::Point::default()
                };
                for v in self.present() {
                    let goal = self.moved(self.now[v.index()], size);
                    self.now[v.index()] = Some(point::<G>(|k| goal[k] + drift[k]));
                }
                self.commit_positions();
                "all move"
            }
        }
    }

    /// Rounds that leave nothing: what comes next is a commit as if they had not been.
    fn withdraw(&mut self, size: i64) {
        for _ in 0..1 + self.rng.below(2) {
            let some: Vec<_> = self.present().into_iter().filter(|_| self.rng.one_in(3)).collect();
            let goals: Vec<_> = some.iter().map(|&v| self.moved(self.now[v.index()], size)).collect();
            let places: Vec<_> = goals.iter().map(|p| scaled::<G>(p, self.scale)).collect();
            self.t.move_vertices(&some, &places).expect("vertices that are there");
            let more = scaled::<G>(&draw::<G>(self.kind, &self.short, &mut self.rng), self.scale);
            self.t.stage_insertions(&[more]).expect("a place");
            self.t.prepare_timestamp().unwrap_or_else(|error| panic!("{}: {error}", self.name));
        }
        self.t.withdraw_timestamp();
    }

    /// Where a vertex goes, in the period that it likes.
    fn moved(&mut self, from: Option<G::Point>, size: i64) -> G::Point {
        let from = from.expect("a vertex that is there");
        let rng = &mut self.rng;
        // What ties stays a part of it.
        let quantum =
            if matches!(self.kind, Kind::Lattice) && size > 1 { (1 << 17) as f64 * UNIT } else { UNIT };
        let most = if quantum == UNIT { size } else { 1 };
        let mut to = point::<G>(|k| from[k] + rng.within(-most, most) as f64 * quantum);
        if rng.one_in(5) {
            to = anywhere::<G>(&to, &self.short, rng);
        }
        to
    }

    fn all_in_other_vectors(&mut self) {
        let vectors = given::<G>(&self.short, &self.multiples, self.scale);
        self.t.stage_vectors(&vectors).expect("vectors");
        if self.rng.one_in(2) { self.commit_positions() } else { self.commit_staged_moves() }
    }

    fn commit_staged_moves(&mut self) {
        let present = self.present();
        let places: Vec<_> =
            present.iter().filter_map(|v| self.now[v.index()]).map(|p| scaled::<G>(&p, self.scale)).collect();
        self.t.move_vertices(&present, &places).expect("vertices that are there");
        self.commit();
    }

    fn commit(&mut self) {
        let made = if self.rng.one_in(3) {
            let made = self.t.prepare_timestamp();
            self.t.publish_timestamp().unwrap_or_else(|error| panic!("{}: {error}", self.name));
            made
        } else {
            self.t.commit_timestamp()
        };
        let report = made.unwrap_or_else(|error| panic!("{}: {error}", self.name));
        self.tally.moves += report.moved;
        self.tally.rebuilds += report.rebuilds;
    }

    fn commit_positions(&mut self) {
        let places: Vec<_> =
            self.now.iter().map(|p| scaled::<G>(&p.unwrap_or_default(), self.scale)).collect();
        let report =
            self.t.commit_positions(&places).unwrap_or_else(|error| panic!("{}: {error}", self.name));
        self.tally.moves += report.moved;
        self.tally.rebuilds += report.rebuilds;
    }

    /// The cells are those of what is made anew of the vertices in other periods, from somewhere else, by other vectors; and
    /// those of copies.
    fn check(&mut self, beside_copies: bool) {
        let found = self.classes();
        self.tally.comparisons += 1;
        self.tally.cells_compared += found.len() as u64;
        self.tally.without_cells += u64::from(found.is_empty());
        for class in &found {
            for (v, way) in class {
                let sum = way.iter().fold(u64::from(*v), |sum, &bits| mixed(sum ^ bits));
                self.checksum = mixed(self.checksum.rotate_left(9) ^ sum);
            }
        }
        let expected = self.classes_made_anew();
        assert!(found == expected, "{}: {} and {} classes", self.name, found.len(), expected.len());
        let n = self.present().len();
        if beside_copies && self.n_copies > 0 && n <= if G::D == 2 { 60 } else { 8 } {
            self.tally.validations += 1;
            let expected = self.classes_of_copies();
            assert!(
                found == expected,
                "{}: {} and {} classes of copies",
                self.name,
                found.len(),
                expected.len()
            );
        }
    }

    fn classes(&self) -> BTreeSet<Class> {
        let vectors = given::<G>(&self.short, &self.multiples, self.scale);
        let name = |v: VertexId| v.get();
        for (v, p) in self.now.iter().enumerate() {
            let expected = p.map(|p| scaled::<G>(&p, self.scale));
            assert_eq!(self.t.position(VertexId::new(v as u32)).ok(), expected, "{}", self.name);
        }
        classes_of(&self.t, &vectors, name, &self.name)
    }

    fn classes_made_anew(&mut self) -> BTreeSet<Class> {
        let mut other = self.multiples;
        skew(&mut other, self.short.len(), &mut self.rng);
        let vectors = given::<G>(&self.short, &other, self.scale);
        let rng = &mut self.rng;
        let offset = point::<G>(|_| rng.within(-(1 << 20), 1 << 20) as f64 * UNIT);
        let mut positions = Vec::new();
        for p in self.now.iter().flatten() {
            let p = anywhere::<G>(p, &self.short, rng);
            positions.push(scaled::<G>(&point::<G>(|k| p[k] + offset[k]), self.scale));
        }
        let t = PeriodicTriangulation::<G>::new(&positions, &vectors, Options::default())
            .unwrap_or_else(|error| panic!("{}: {error}", self.name));
        let present = self.present();
        classes_of(&t, &vectors, |v| present[v.index()].get(), &self.name)
    }

    /// Of copies of the box by short vectors, in an open triangulation.
    fn classes_of_copies(&self) -> BTreeSet<Class> {
        let n = self.n_copies;
        let range = |j: usize| if j < self.short.len() { -n..=n } else { 0..=0 };
        let (mut positions, mut keys, mut is_home) = (Vec::new(), Vec::new(), Vec::new());
        for v in self.present() {
            let p = self.now[v.index()].expect("it is there");
            // Where the vertices are is a box of the same size, wherever they have been given.
            let p = at_home::<G>(&p, &self.short);
            for x in range(0) {
                for y in range(1) {
                    for z in range(2) {
                        positions.push(scaled::<G>(&translated::<G>(&p, &self.short, [x, y, z]), self.scale));
                        keys.push(u64::from(v.get()));
                        is_home.push([x, y, z] == [0; 3]);
                    }
                }
            }
        }
        let t = MovingTriangulation::<G>::with_keys(&positions, &keys, Options::default()).expect("copies");
        let cells = t.cells().expect("cells");
        let at_home = cells.corners.iter().filter(|row| row.as_ref().iter().any(|&v| is_home[v.index()]));
        let class = |row: &G::Vertices| {
            let corners = row.as_ref().iter().map(|&v| (keys[v.index()] as u32, positions[v.index()]));
            class_of::<G>(corners.collect())
        };
        at_home.map(class).collect()
    }
}

/// The classes of cells of a triangulation, each of which comes once.
fn classes_of<G: Dimension>(
    t: &PeriodicTriangulation<G>,
    vectors: &[G::Point],
    name: impl Fn(VertexId) -> u32,
    context: &str,
) -> BTreeSet<Class> {
    let cells = t.cells().expect("cells");
    let shifts: Vec<_> = t.cell_shifts().expect("shifts").collect();
    let mut classes = BTreeSet::new();
    for (row, shifts) in cells.corners.iter().zip(shifts.chunks_exact(G::D + 1)) {
        let corners = row.as_ref().iter().zip(shifts).map(|(&v, &shift)| {
            (name(v), translated::<G>(&t.position(v).expect("a vertex that is there"), vectors, shift))
        });
        assert!(classes.insert(class_of::<G>(corners.collect())), "{context}: a class comes once");
    }
    if vectors.len() == G::D {
        assert!(
            cells.neighbours.iter().all(|row| !row.as_ref().contains(&NO_CELL)),
            "{context}: there is no hull"
        );
    }
    classes
}

/// The class of a cell by its corners: vertices, and where they are.
fn class_of<G: Dimension>(mut corners: Vec<(u32, G::Point)>) -> Class {
    corners.sort_by(|(v, p), (w, q)| {
        v.cmp(w).then_with(|| p.as_ref().partial_cmp(q.as_ref()).expect("numbers"))
    });
    let first = corners[0].1;
    let way = |p: &G::Point| (0..G::D).map(|k| (p[k] - first[k] + 0.0).to_bits()).collect();
    corners.iter().map(|(v, p)| (*v, way(p))).collect()
}

/// Vectors that are nearly as short as any of their lattice.
fn short_vectors<G: Dimension>(shape: usize, rank: usize, rng: &mut Rng) -> Vec<G::Point> {
    let lengths = match shape {
        1 => [1.0, 3.0, 0.6875],
        2 => [1.0, 0.0625, 17.0],
        _ => [1.0; 3],
    };
    let is_oblique = shape == 3;
    (0..rank)
        .map(|j| {
            point::<G>(|k| {
                if k == j {
                    lengths[j]
                } else if is_oblique {
                    rng.within(-6, 6) as f64 / 16.0
                } else {
                    0.0
                }
            })
        })
        .collect()
}

/// Other vectors of a lattice: multiples of some are added to others.
fn skew(multiples: &mut [[i64; 3]; 3], rank: usize, rng: &mut Rng) {
    *multiples = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    for _ in 0..rng.below(4) {
        let (i, j) = (rng.below(rank), rng.below(rank));
        if i == j {
            multiples[i] = multiples[i].map(|n| -n);
        } else {
            let n = rng.within(-5, 5);
            multiples[i] = std::array::from_fn(|k| multiples[i][k] + n * multiples[j][k]);
        }
    }
}

/// The vectors that are given to the library.
fn given<G: Dimension>(short: &[G::Point], multiples: &[[i64; 3]; 3], scale: f64) -> Vec<G::Point> {
    let none = G::Point::default();
    (0..short.len()).map(|j| scaled::<G>(&translated::<G>(&none, short, multiples[j]), scale)).collect()
}

fn scaled<G: Dimension>(p: &G::Point, scale: f64) -> G::Point {
    point::<G>(|k| p[k] * scale)
}

fn translated<G: Dimension>(p: &G::Point, vectors: &[G::Point], shift: [i64; 3]) -> G::Point {
    point::<G>(|k| vectors.iter().zip(shift).fold(p[k], |sum, (b, n)| sum + n as f64 * b[k]))
}

/// A place in any of several periods.
fn anywhere<G: Dimension>(p: &G::Point, vectors: &[G::Point], rng: &mut Rng) -> G::Point {
    let shift = std::array::from_fn(|_| rng.within(-3, 3));
    translated::<G>(p, vectors, shift)
}

/// The same place in the period at the origin, for vectors that are not far from orthogonal.
fn at_home<G: Dimension>(p: &G::Point, vectors: &[G::Point]) -> G::Point {
    let mut p = *p;
    for _ in 0..64 {
        for b in vectors {
            let along = |q: &G::Point| (0..G::D).map(|k| q[k] * b[k]).sum::<f64>();
            let n = (along(&p) / along(b)).floor();
            p = point::<G>(|k| p[k] - n * b[k]);
        }
    }
    p
}

/// A place in the box, or beside it where it is open.
fn draw<G: Dimension>(kind: Kind, short: &[G::Point], rng: &mut Rng) -> G::Point {
    let mut share = |k: usize| match kind {
        Kind::Random => rng.below(1 << 10) as f64 / 1024.0,
        Kind::Lattice => rng.below(8) as f64 / 8.0,
        Kind::Coincident => rng.below(3) as f64 / 4.0,
        Kind::Clusters => rng.below(2) as f64 / 2.0 + rng.below(1 << 4) as f64 / 1024.0,
        Kind::Layers if k == G::D - 1 => rng.below(4) as f64 / 4.0,
        Kind::Layers => rng.below(1 << 10) as f64 / 1024.0,
    };
    let shares: Vec<f64> = (0..G::D).map(&mut share).collect();
    let mut p = point::<G>(|k| if k < short.len() { 0.0 } else { shares[k] });
    for (b, share) in short.iter().zip(&shares) {
        p = point::<G>(|k| p[k] + share * b[k]);
    }
    let p = point::<G>(|k| (p[k] / UNIT).round() * UNIT);
    if matches!(kind, Kind::Coincident) || rng.one_in(4) { anywhere::<G>(&p, short, rng) } else { p }
}
