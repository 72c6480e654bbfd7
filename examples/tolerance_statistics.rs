//! Figure 7 (c) of the report: tolerances of 10,000 random points at unit density in a disk and in a ball.
//!
//! Every facet between two cells is a bi-cell. Two widths are taken of it: that of the generator of its
//! *standard* delimiter (report, section 2.3: the facet inside, the opposing vertices outside), and that of
//! the *least* annulus of its points (section 2.2), whatever points are inside. The report takes them for
//! the same. They are not where the line through the opposing vertices misses the facet; its averages are of
//! the least ones, except that the average greatest width in space is of standard ones. Its figures stand
//! beside both, with the deviations; that of ε has one or two digits only.
//!
//! The annulus of least width has all D + 2 points on its two spheres, unless its centre is at infinity,
//! which it comes near to as closely as one likes. So it is among the annuli of the partitions of the points
//! into two parts, each of which fixes one centre: equidistant from the points of either part. All of these
//! hold all points, so the least of their widths is the one. Before the table, random searches for better
//! centres try to refute that.
//!
//! ε of a vertex is half the least width among the bi-cells that have it. *Certified* is the tolerance that
//! deldrift works with: a lower bound of what is proved safe, in the plane by standard delimiters, in space
//! by all that `predicates/tolerance.rs` demands, and at the hull by the certificates of the hull as well.
//!
//! The report does not say what it does about the hull, where widths are larger. Beside the averages over all
//! points stand those over interior ones, more than 3 spacings away from the circle or sphere, and over
//! bi-cells of which all points are interior.
mod common;

use common::{Rng, in_ball};
use deldrift::motion::{MovingTriangulation, NO_CELL, Options};
use deldrift::{CellId, Coordinates, Dimension, Plane, Space, VertexId};

const N: usize = 10_000;
const SEEDS: u64 = 10;
/// How many bi-cells are searched for narrower annuli, about.
const SEARCHED: usize = 200;
/// Spacings from the boundary beyond which a point is interior.
const MARGIN: f64 = 3.0;

fn norm<P: Coordinates>(p: &P) -> f64 {
    p.as_ref().iter().map(|x| x * x).sum::<f64>().sqrt()
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

fn squared_distance<P: Coordinates>(p: &P, q: &P) -> f64 {
    p.as_ref().iter().zip(q.as_ref()).map(|(x, y)| (x - y) * (x - y)).sum()
}

/// Width of the annulus about a centre that holds all points.
fn width_about<P: Coordinates>(centre: &P, points: &[P]) -> f64 {
    let squares = points.iter().map(|p| squared_distance(centre, p));
    let (least, greatest) =
        squares.fold((f64::INFINITY, 0.0), |(l, g): (f64, f64), square| (l.min(square), g.max(square)));
    (greatest - least) / (greatest.sqrt() + least.sqrt())
}

/// The point that is equidistant from the points of `part`, a set of bits, and from the others; NaN if there
/// is none.
fn centre_of<G: Dimension>(points: &[G::Point], part: usize) -> G::Point {
    let in_part = |i: &usize| part >> i & 1 != 0;
    // Bisectors: 2 (p - q)·x = |p|² - |q|², from the first point on.
    let mut rows: Vec<[f64; 4]> = Vec::new();
    for set in [true, false] {
        let mut members = (0..points.len()).filter(|i| in_part(i) == set);
        let Some(q) = members.next() else { continue };
        for p in members {
            let mut row = [0.0; 4];
            for k in 0..G::D {
                let (x, y) = (points[p][k] - points[0][k], points[q][k] - points[0][k]);
                row[k] = 2.0 * (x - y);
                row[3] += (x - y) * (x + y);
            }
            rows.push(row);
        }
    }
    for k in 0..G::D {
        let pivot = (k..G::D).max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs())).expect("a row");
        rows.swap(k, pivot);
        let row = rows[k];
        for (_, other) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = other[k] / row[k];
            other.iter_mut().zip(row).for_each(|(x, y)| *x -= factor * y);
        }
    }
    let mut centre = points[0];
    for k in 0..G::D {
        centre[k] += rows[k][3] / rows[k][k];
    }
    centre
}

/// Width of the least annulus of D + 2 points.
fn least_width<G: Dimension>(points: &[G::Point]) -> f64 {
    // The last point is never in the part, so that every partition comes once.
    let widths = (1..1 << (G::D + 1)).map(|part| width_about(&centre_of::<G>(points, part), points));
    widths.fold(f64::INFINITY, f64::min)
}

/// The least width that a random search finds: steps of all sizes from many places, kept where they improve.
fn searched_width<G: Dimension>(points: &[G::Point], random: &mut Rng) -> f64 {
    let mut best = f64::INFINITY;
    for start in 0..12 {
        let step = |size: f64, from: &G::Point, random: &mut Rng| {
            let mut to = *from;
            for k in 0..G::D {
                to[k] += size * (2.0 * random.unit() - 1.0);
            }
            to
        };
        let mut centre = step(10f64.powf(f64::from(start) / 4.0 - 1.0), &points[0], random);
        let mut width = width_about(&centre, points);
        for _ in 0..4_000 {
            let away = squared_distance(&centre, &points[0]).sqrt();
            let next = step(away * 10f64.powf(-9.0 * random.unit()), &centre, random);
            let next_width = width_about(&next, points);
            if next_width < width {
                (centre, width) = (next, next_width);
            }
        }
        best = best.min(width);
    }
    best
}

/// What one vertex has seen of its bi-cells: standard and least widths.
#[derive(Clone, Copy)]
struct Seen {
    least: [f64; 2],
    greatest: [f64; 2],
    bicells: f64,
}

const ROWS: [&str; 8] = [
    "avg(W), standard",
    "avg(W), least",
    "avg(eps(V)), standard",
    "avg(eps(V)), least",
    "avg(eps(V)), certified",
    "average max. annuli width, standard",
    "average max. annuli width, least",
    "average number of adjacent bi-cells",
];

/// The rows of the table, over all points and over interior ones; and what searches find, in units of least
/// widths.
fn measure<G: Dimension>(seed: u64, rows: &mut [[Mean; 2]; 8], ratios: &mut Vec<f64>) {
    let unit_ball = if G::D == 2 { std::f64::consts::PI } else { 4.0 / 3.0 * std::f64::consts::PI };
    let radius = (N as f64 / unit_ball).powf(1.0 / G::D as f64);
    let random = &mut Rng::new(seed);
    let points: Vec<G::Point> = (0..N).map(|_| in_ball::<G>(random, radius)).collect();
    let t = MovingTriangulation::<G>::new(&points, Options::default()).expect("points in range");
    let is_interior = |v: VertexId| norm(&points[v]) < radius - MARGIN;

    let mut seen = vec![Seen { least: [f64::INFINITY; 2], greatest: [0.0; 2], bicells: 0.0 }; N];
    let (cells, standard) = (t.cells().expect("room"), t.annulus_widths().expect("room"));
    for (c, corners) in cells.corners.iter().enumerate() {
        let corners = corners.as_ref();
        for (i, &across) in cells.neighbours[c].as_ref().iter().enumerate() {
            if across == NO_CELL || across < CellId::at(c) {
                continue;
            }
            let beyond = cells.corners[across];
            let apex = *beyond.as_ref().iter().find(|v| !corners.contains(v)).expect("another cell");
            let vertices = || corners.iter().copied().chain([apex]);
            let bicell: Vec<G::Point> = vertices().map(|v| points[v]).collect();
            let widths = [standard[c * (G::D + 1) + i], least_width::<G>(&bicell)];
            if seed == 0 && c % (cells.corners.len() / SEARCHED) == 0 {
                let searched = searched_width::<G>(&bicell, random) / widths[1];
                assert!(
                    searched > 1.0 - 1e-9,
                    "a search has found an annulus of {searched} of the least width"
                );
                ratios.push(searched);
            }
            for (row, width) in rows.iter_mut().zip(widths) {
                row[0].add(width);
                if vertices().all(is_interior) {
                    row[1].add(width);
                }
            }
            for v in vertices() {
                let seen = &mut seen[v];
                for (k, width) in widths.into_iter().enumerate() {
                    seen.least[k] = seen.least[k].min(width);
                    seen.greatest[k] = seen.greatest[k].max(width);
                }
                seen.bicells += 1.0;
            }
        }
    }
    for (v, Seen { least, greatest, bicells }) in VertexId::range(0..N).zip(seen) {
        let certified = t.tolerance(v).expect("present");
        let values = [0.5 * least[0], 0.5 * least[1], certified, greatest[0], greatest[1], bicells];
        for (row, value) in rows[2..].iter_mut().zip(values) {
            row[0].add(value);
            if is_interior(v) {
                row[1].add(value);
            }
        }
    }
}

/// A deviation from the report.
fn deviation(mean: Mean, report: Option<f64>) -> String {
    report.map_or(String::new(), |report| format!("{:+.1} %", 100.0 * (mean.value() / report - 1.0)))
}

fn print<G: Dimension>(report: [Option<f64>; 8]) {
    let mut rows = [[Mean::default(); 2]; 8];
    let mut ratios = Vec::new();
    for seed in 0..SEEDS {
        measure::<G>(seed, &mut rows, &mut ratios);
    }
    ratios.sort_by(f64::total_cmp);
    println!(
        "{}D: searches for narrower annuli of {} bi-cells end at {:.7} of the least width at best, in the median at {:.7}",
        G::D,
        ratios.len(),
        ratios[0],
        ratios[ratios.len() / 2]
    );
    println!("{}D, {N} points, {SEEDS} seeds{:11} report   all points             interior", G::D, "");
    for ((name, [all, interior]), report) in ROWS.iter().zip(&rows).zip(report) {
        let figure = report.map_or(String::new(), |x| format!("{x}"));
        let [a, b] = [all, interior].map(|mean| deviation(*mean, report));
        println!("{name:36} {figure:>7} {:12.6} {a:>10} {:12.6} {b:>10}", all.value(), interior.value());
    }
    println!();
}

fn main() {
    let rows = |w: f64, eps: f64, greatest: f64, bicells: f64| {
        let certified = None;
        [Some(w), Some(w), Some(eps), Some(eps), certified, Some(greatest), Some(greatest), Some(bicells)]
    };
    print::<Plane>(rows(0.255, 0.014, 0.610, 12.0));
    print::<Space>(rows(0.126, 0.002, 0.742, 66.3));
}
