//! Conservative transfer of means in cells: histories beside sums, ranges, and what exact rational numbers say.
//!
//! `DELDRIFT_SOAK` multiplies the number of seeds.

mod boxes;
mod exact;
mod exact_boxes;
mod orders;

use crate::common::{Rng, point, seeds, vertex};
use deldrift::motion::{MovingTriangulation, Options, TransferOrder, TransferReport};
use deldrift::{Dimension, Error, Plane, Space, VertexId};
use exact::{Ratio, common, place, volume};

/// A constant, whose sums round.
const CONSTANT: f64 = 0.1;

/// Number of components: a constant, random numbers, and a linear function.
const N: usize = 3;

/// What all histories of a test have met.
#[derive(Debug, Default)]
struct Counts {
    takes: usize,
    turned_over: usize,
    uncovered: usize,
    lost: usize,
    compared: usize,
}

struct History<G: Dimension> {
    t: MovingTriangulation<G>,
    /// Where each vertex is, or was when it was removed.
    places: Vec<G::Point>,
    values: Vec<f64>,
    rows: Vec<G::Vertices>,
    order: TransferOrder,
    /// Coordinates are whole numbers up to this, if they are to be; so many cells are flat.
    lattice: Option<f64>,
    /// How far vertices go.
    way: f64,
    rng: Rng,
    name: String,
}

fn linear<P: AsRef<[f64]>>(p: &P) -> f64 {
    p.as_ref().iter().zip([0.7, -1.3, 0.4]).map(|(x, slope)| x * slope).sum::<f64>() + 2.0
}

impl<G: Dimension> History<G> {
    fn new(seed: u64, n: usize) -> Self {
        let mut rng = Rng::new(seed);
        let lattice = rng.one_in(3).then_some(5.0);
        let order = if rng.one_in(2) { TransferOrder::First } else { TransferOrder::Second };
        let way = *rng.pick(&[0.01, 0.1, 1.0]);
        let mut history = History {
            t: MovingTriangulation::new(&[], Options::default()).expect("nothing"),
            places: Vec::new(),
            values: Vec::new(),
            rows: Vec::new(),
            order,
            lattice,
            way,
            name: format!("{}D, seed {seed}, {order:?}, way {way}, lattice {lattice:?}", G::D),
            rng,
        };
        history.places = (0..n).map(|_| history.draw(None)).collect();
        history.t = MovingTriangulation::new(&history.places, Options::default()).expect("good points");
        history.t.take_changes().expect("room");
        history.begin();
        history
    }

    /// A place, or one near another.
    fn draw(&mut self, near: Option<G::Point>) -> G::Point {
        let (rng, way) = (&mut self.rng, self.way);
        let place = point::<G>(|k| match near {
            Some(p) => p[k] + way * (rng.unit() - 0.5),
            None => rng.unit(),
        });
        match self.lattice {
            Some(n) => point::<G>(|k| (place[k] * n).round() / n),
            None => place,
        }
    }

    /// Gives each cell values anew.
    fn begin(&mut self) {
        self.rows = self.t.cells().expect("room").corners.to_vec();
        self.values.clear();
        for row in &self.rows {
            let corners = row.as_ref().iter().map(|v| linear(&self.places[v.index()]));
            let mean = corners.sum::<f64>() / (G::D + 1) as f64;
            self.values.extend([CONSTANT, self.rng.unit() - 0.3, mean]);
        }
    }

    fn present(&mut self) -> VertexId {
        loop {
            let v = vertex(self.rng.below(self.places.len()) as u32);
            if self.t.is_present(v) {
                return v;
            }
        }
    }

    fn change(&mut self) {
        match self.rng.below(5) {
            0 => {
                let place = self.draw(None);
                self.t.insert_vertex(&place).expect("an insertion");
                self.places.push(place);
            }
            1 if self.t.vertex_count() > G::D + 3 => {
                let v = self.present();
                self.t.remove_vertex(v).expect("a removal");
            }
            2 => {
                let v = self.present();
                let place = self.draw(Some(self.places[v.index()]));
                self.places[v.index()] = place;
                self.t.relocate_vertex(v, &place).expect("a move");
            }
            _ => {
                for v in VertexId::range(0..self.places.len()) {
                    if self.t.is_present(v) && !self.rng.one_in(3) {
                        let place = self.draw(Some(self.places[v.index()]));
                        self.places[v.index()] = place;
                        self.t.move_vertices(&[v], &[place]).expect("a move");
                    }
                }
                self.t.commit_timestamp().expect("a commit");
            }
        }
    }

    /// Volumes of the cells that were, at the new positions, with their signs.
    fn volumes_before(&self) -> Vec<f64> {
        let signed = |row: &G::Vertices| {
            let corners: Vec<_> =
                row.as_ref().iter().map(|v| place(self.places[v.index()].as_ref())).collect();
            volume(&corners).value() / if G::D == 2 { 2.0 } else { 6.0 }
        };
        self.rows.iter().map(signed).collect()
    }

    fn step(&mut self, is_exact: bool, counts: &mut Counts) {
        let n_ids = self.places.len();
        for _ in 0..1 + self.rng.below(3) {
            self.change();
        }
        self.t.take_changes().expect("room");
        let before = self.values.clone();
        let places = self.places[..n_ids].to_vec();
        let report = self
            .t
            .transfer_cells(Some(&places), self.order, N, &mut self.values, &mut |_| true)
            .expect("a transfer");
        counts.takes += 1;
        counts.turned_over += report.turned_over;
        counts.uncovered += report.uncovered;
        counts.lost += usize::from(report.lost_volume.abs() > report.volume_error);
        self.check_sums(&before, &report);
        if is_exact {
            self.check_exactly(&before, &report, counts);
        }
        self.begin();
    }

    fn check_sums(&self, before: &[f64], report: &TransferReport) {
        let volumes: Vec<f64> = self.t.volumes().expect("room").collect();
        let volumes_before = self.volumes_before();
        assert_eq!(self.values.len(), N * volumes.len(), "{}: as many as cells", self.name);
        for c in 0..N {
            let greatest = before.iter().skip(c).step_by(N).fold(0.0, |m: f64, x| m.max(x.abs()));
            let content = |values: &[f64], volumes: &[f64]| -> f64 {
                volumes.iter().zip(values.iter().skip(c).step_by(N)).map(|(v, x)| v * x).sum()
            };
            let is = content(&self.values, &volumes);
            let was = content(before, &volumes_before) - report.lost[c] + report.gained[c];
            // Sums of as many rounded numbers, whose rounding the volumes' bounds leave room for.
            let all: f64 = volumes_before.iter().chain(&volumes).map(|v| v.abs()).sum();
            let room = 2.0 * greatest * (report.volume_error + 1e-14 * all);
            assert!((is - was).abs() <= room, "{}: component {c}: {is} for {was}, {report:?}", self.name);
            let [low, high] = before
                .iter()
                .skip(c)
                .step_by(N)
                .fold([f64::MAX, f64::MIN], |[low, high], &x| [low.min(x), high.max(x)]);
            if report.turned_over == 0 && !before.is_empty() {
                let are_within = self.values.iter().skip(c).step_by(N).all(|&x| low <= x && x <= high);
                assert!(are_within, "{}: component {c} has new extremes: {low} to {high}", self.name);
            }
        }
        if !before.is_empty() {
            let is_kept = self.values.iter().step_by(N).all(|&x| x == CONSTANT);
            assert!(is_kept, "{}: the constant is another one: {:?}, {report:?}", self.name, self.values);
        }
    }

    /// Compares the random component of the first order with what all cells that were have in each cell of now.
    fn check_exactly(&self, before: &[f64], report: &TransferReport, counts: &mut Counts) {
        let exact = |row: &G::Vertices| -> Vec<_> {
            row.as_ref().iter().map(|v| place(self.places[v.index()].as_ref())).collect()
        };
        let old: Vec<_> = self.rows.iter().map(exact).collect();
        let unit = if G::D == 2 { 2.0 } else { 6.0 };
        let (mut lost_volume, mut gained_volume) = (Ratio::of(0.0), Ratio::of(0.0));
        old.iter().for_each(|row| lost_volume = &lost_volume + &volume(row));
        let cells = self.t.cells().expect("room").corners;
        let mut is_twice = false;
        for (index, row) in cells.iter().enumerate() {
            let corners = exact(row);
            let (mut content, mut cover) = (Ratio::of(0.0), Ratio::of(0.0));
            let (mut is_signed, whole) = (false, volume(&corners));
            for (k, other) in old.iter().enumerate() {
                let part = common(&corners, other);
                is_signed |= part.sign() < 0;
                cover = &cover + &part;
                content = &content + &(&part * &Ratio::of(before[k * N + 1]));
            }
            (lost_volume, gained_volume) = (&lost_volume - &cover, &gained_volume + &(&whole - &cover));
            // A hull that has come to lie over itself covers some cells twice, though none is turned over.
            is_twice |= (&cover - &whole).sign() > 0;
            let is_covered = (&whole - &cover).sign() == 0;
            let is_told = is_covered || !is_signed && cover.sign() > 0 && (&whole - &cover).sign() > 0;
            if self.order == TransferOrder::Second || !is_told {
                continue;
            }
            counts.compared += 1;
            let volume = cover.value() / unit;
            let (is, should) = (self.values[index * N + 1] * volume, content.value() / unit);
            let room = 3.0 * report.volume_error + 1e-15;
            assert!(
                (is - should).abs() <= room,
                "{}: cell {index} has {is}, not {should}, of volume {volume}: {report:?}",
                self.name
            );
        }
        let net = &lost_volume - &gained_volume;
        let mut pairs = vec![(report.lost_volume - report.gained_volume, net)];
        if !is_twice {
            pairs.extend([(report.lost_volume, lost_volume), (report.gained_volume, gained_volume)]);
        }
        for (found, should) in pairs {
            let should = should.value() / unit;
            assert!(
                (found - should).abs() <= report.volume_error,
                "{}: {found} for {should}: {report:?}",
                self.name
            );
        }
    }
}

fn histories<G: Dimension>(n_seeds: u64, n: usize, steps: usize, is_exact: bool) -> Counts {
    let mut counts = Counts::default();
    for seed in seeds(n_seeds) {
        let mut history = History::<G>::new(seed, n);
        (0..steps).for_each(|_| history.step(is_exact, &mut counts));
    }
    println!("{}D: {counts:?}", G::D);
    counts
}

#[test]
fn content_and_constants_are_kept_in_the_plane() {
    let counts = histories::<Plane>(250, 24, 6, false);
    assert!(counts.turned_over > 100 && counts.lost > 100 && counts.uncovered > 10, "{counts:?}");
}

#[test]
fn content_and_constants_are_kept_in_space() {
    let counts = histories::<Space>(250, 16, 3, false);
    assert!(counts.turned_over > 100 && counts.lost > 100 && counts.uncovered > 10, "{counts:?}");
}

#[test]
fn exact_rational_numbers_say_the_same_in_the_plane() {
    let counts = histories::<Plane>(60, 10, 3, true);
    assert!(counts.compared > 500, "{counts:?}");
}

#[test]
fn exact_rational_numbers_say_the_same_in_space() {
    let counts = histories::<Space>(12, 8, 2, true);
    assert!(counts.compared > 50, "{counts:?}");
}

/// A transfer that is broken off leaves the values as they were; each cell meets all others here.
#[test]
fn a_transfer_may_be_broken_off() {
    let mut rng = Rng::new(7);
    let places: Vec<[f64; 2]> = (0..600).map(|_| [rng.unit(), rng.unit()]).collect();
    let mut goals = places.clone();
    goals.rotate_left(1);
    let mut t = MovingTriangulation::<Plane>::new(&places, Options::default()).expect("good places");
    t.take_changes().expect("room");
    let given: Vec<f64> = (0..t.cell_count()).map(|k| k as f64).collect();
    t.commit_positions(&goals).expect("good places");
    t.take_changes().expect("room");
    let mut n_asked = 0;
    let mut values = given.clone();
    let mut told = 0.0;
    let whole = t.transfer_cells(Some(&goals), TransferOrder::Second, 1, &mut values, &mut |share| {
        assert!((0.0..=1.0).contains(&share) && share >= told, "{share} after {told}");
        (n_asked, told) = (n_asked + 1, share);
        true
    });
    assert!(whole.is_ok() && n_asked > 3 && values != given, "{n_asked}");
    for most in 0..n_asked {
        let (mut values, mut left) = (given.clone(), most);
        let broken = t.transfer_cells(Some(&goals), TransferOrder::Second, 1, &mut values, &mut |_| {
            left -= 1;
            left >= 0
        });
        assert_eq!((broken.map(drop), values == given), (Err(Error::Cancelled), true), "after {most}");
    }
}
