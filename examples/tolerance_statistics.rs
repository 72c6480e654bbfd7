//! Figure 7 (c) of the report: tolerances of 10,000 random points at unit density in a disk and in a ball.
//!
//! Every facet between two cells is a bi-cell. Its *annulus width* W is that of the generator of its standard delimiter;
//! the report's ε of a vertex is half the least width among the bi-cells that have it. *Certified* is the tolerance that
//! deldrift works with: a lower bound; in space less than the report's, which is none (see `predicates/tolerance.rs`);
//! and at the hull subject to the certificates of the hull as well.
//!
//! The report does not say what it does about the hull, where widths are larger. Beside the averages over all points stand
//! those over interior ones, more than 3 spacings away from the circle or sphere, and over bi-cells of which all points are
//! interior.
use deldrift::delaunay::{Coordinates, Dimension, Plane, Space};
use deldrift::motion::{MovingTriangulation, NO_CELL, Options};

const N: usize = 10_000;
const SEEDS: u64 = 10;
/// Spacings from the boundary beyond which a point is interior.
const MARGIN: f64 = 3.0;

/// Splitmix64.
struct Random(u64);

impl Random {
    /// In [0, 1).
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ z >> 31) >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn norm<P: Coordinates>(p: &P) -> f64 {
    p.as_ref().iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Uniform in the ball of this radius.
fn in_ball<G: Dimension>(radius: f64, random: &mut Random) -> G::Point {
    loop {
        let mut p = G::Point::default();
        for k in 0..G::D {
            p[k] = radius * (2.0 * random.unit() - 1.0);
        }
        if norm(&p) <= radius {
            return p;
        }
    }
}

/// A mean in the making.
#[derive(Clone, Copy, Default)]
struct Mean {
    sum: f64,
    n: f64,
}

impl Mean {
    fn add(&mut self, x: f64) {
        self.sum += x;
        self.n += 1.0;
    }

    fn value(&self) -> f64 {
        self.sum / self.n
    }
}

/// What one vertex has seen of its bi-cells.
#[derive(Clone, Copy)]
struct Seen {
    least: f64,
    greatest: f64,
    bicells: f64,
}

const ROWS: [&str; 5] = [
    "avg(W)",
    "avg(eps(V))",
    "avg(eps(V)), certified",
    "average max. annuli width at vertices",
    "average number of adjacent bi-cells",
];

/// The rows of the table, over all points and over interior ones.
fn measure<G: Dimension>(seed: u64, rows: &mut [[Mean; 2]; 5]) {
    let unit_ball = if G::D == 2 { std::f64::consts::PI } else { 4.0 / 3.0 * std::f64::consts::PI };
    let radius = (N as f64 / unit_ball).powf(1.0 / G::D as f64);
    let random = &mut Random(seed);
    let points: Vec<G::Point> = (0..N).map(|_| in_ball::<G>(radius, random)).collect();
    let t = MovingTriangulation::<G>::new(&points, Options::default()).expect("points in range");
    let is_interior = |v: u32| norm(&points[v as usize]) < radius - MARGIN;

    let mut seen = vec![Seen { least: f64::INFINITY, greatest: 0.0, bicells: 0.0 }; N];
    let (cells, widths) = (t.cells(), t.annulus_widths());
    for (c, corners) in cells.corners.iter().enumerate() {
        for i in 0..=G::D {
            let across = cells.neighbours[c][i];
            if across == NO_CELL || across < c as u32 {
                continue;
            }
            let width = widths[c * (G::D + 1) + i];
            let beyond = &cells.corners[across as usize];
            let apex = beyond.as_ref().iter().find(|v| !corners.as_ref().contains(v)).expect("another cell");
            let vertices = || corners.as_ref().iter().chain([apex]).copied();
            rows[0][0].add(width);
            if vertices().all(is_interior) {
                rows[0][1].add(width);
            }
            for v in vertices() {
                let seen = &mut seen[v as usize];
                seen.least = seen.least.min(width);
                seen.greatest = seen.greatest.max(width);
                seen.bicells += 1.0;
            }
        }
    }
    for (v, seen) in (0u32..).zip(&seen) {
        let certified = t.tolerance(v).expect("present");
        let values = [0.5 * seen.least, certified, seen.greatest, seen.bicells];
        for (row, value) in rows[1..].iter_mut().zip(values) {
            row[0].add(value);
            if is_interior(v) {
                row[1].add(value);
            }
        }
    }
}

fn print<G: Dimension>(report: [Option<f64>; 5]) {
    println!("{}D, {N} points, {SEEDS} seeds{:15} all points     interior      report", G::D, "");
    let mut rows = [[Mean::default(); 2]; 5];
    for seed in 0..SEEDS {
        measure::<G>(seed, &mut rows);
    }
    for ((name, [all, interior]), report) in ROWS.iter().zip(&rows).zip(report) {
        let report = report.map_or(String::new(), |x| format!("{x}"));
        println!("{name:38} {:12.6} {:12.6} {report:>11}", all.value(), interior.value());
    }
    println!();
}

fn main() {
    print::<Plane>([Some(0.255), Some(0.014), None, Some(0.610), Some(12.0)]);
    print::<Space>([Some(0.126), Some(0.002), None, Some(0.742), Some(66.3)]);
}
