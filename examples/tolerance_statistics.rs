//! Figure 7 (c) of the report: tolerances of 10,000 random points at unit density in a disk and in a ball.
//!
//! Every facet between two cells is a bi-cell. Two widths are taken of it: that of the generator of its *standard*
//! delimiter (report, section 2.3: the facet inside, the opposing vertices outside), and that of the *least* annulus
//! of its points (section 2.2), whatever points are inside. The report takes them for the same. They are not where the
//! line through the opposing vertices misses the facet; its averages are of the least ones, except that the average
//! greatest width in space is of standard ones. In space *least* is here twice the bi-cell's certified tolerance, which
//! differs from it by no more than what the orientation of the cells allows.
//!
//! ε of a vertex is half the least width among the bi-cells that have it. *Certified* is the tolerance that deldrift works
//! with: a lower bound of what is proved safe, in the plane by standard delimiters, in space by all that
//! `predicates/tolerance.rs` demands, and at the hull by the certificates of the hull as well.
//!
//! The report does not say what it does about the hull, where widths are larger. Beside the averages over all points stand
//! those over interior ones, more than 3 spacings away from the circle or sphere, and over bi-cells of which all points are
//! interior.
use deldrift::delaunay::{Coordinates, Dimension, Plane, Space};
use deldrift::motion::{MovingTriangulation, NO_CELL, Options};
use deldrift::predicates::{delimiter2d, separator3d};

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

/// Widths of a bi-cell.
trait Widths: Dimension {
    /// Of the least annulus of a facet and two opposing vertices.
    fn least(facet: &[Self::Point], opposing: &[Self::Point; 2]) -> f64;
}

impl Widths for Plane {
    fn least(facet: &[[f64; 2]], [c, d]: &[[f64; 2]; 2]) -> f64 {
        let [a, b] = [&facet[0], &facet[1]];
        let half =
            |i, j, k, l| delimiter2d(k, [i, j], l).half_width.max(delimiter2d(i, [k, l], j).half_width);
        2.0 * half(a, b, c, d).min(half(a, c, b, d)).min(half(a, d, b, c))
    }
}

impl Widths for Space {
    fn least(facet: &[[f64; 3]], [c, d]: &[[f64; 3]; 2]) -> f64 {
        2.0 * separator3d(c, [&facet[0], &facet[1], &facet[2]], d, f64::INFINITY).delimiter.tolerance
    }
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

/// The rows of the table, over all points and over interior ones.
fn measure<G: Widths>(seed: u64, rows: &mut [[Mean; 2]; 8]) {
    let unit_ball = if G::D == 2 { std::f64::consts::PI } else { 4.0 / 3.0 * std::f64::consts::PI };
    let radius = (N as f64 / unit_ball).powf(1.0 / G::D as f64);
    let random = &mut Random(seed);
    let points: Vec<G::Point> = (0..N).map(|_| in_ball::<G>(radius, random)).collect();
    let t = MovingTriangulation::<G>::new(&points, Options::default()).expect("points in range");
    let is_interior = |v: u32| norm(&points[v as usize]) < radius - MARGIN;

    let mut seen = vec![Seen { least: [f64::INFINITY; 2], greatest: [0.0; 2], bicells: 0.0 }; N];
    let (cells, standard) = (t.cells(), t.annulus_widths());
    for (c, corners) in cells.corners.iter().enumerate() {
        let corners = corners.as_ref();
        for (i, &corner) in corners.iter().enumerate() {
            let across = cells.neighbours[c][i];
            if across == NO_CELL || across < c as u32 {
                continue;
            }
            let beyond = cells.corners[across as usize];
            let apex = *beyond.as_ref().iter().find(|v| !corners.contains(v)).expect("another cell");
            let facet: Vec<G::Point> =
                corners.iter().filter(|v| **v != corner).map(|&v| points[v as usize]).collect();
            let widths = [
                standard[c * (G::D + 1) + i],
                G::least(&facet, &[points[corner as usize], points[apex as usize]]),
            ];
            let vertices = || corners.iter().copied().chain([apex]);
            for (row, width) in rows.iter_mut().zip(widths) {
                row[0].add(width);
                if vertices().all(is_interior) {
                    row[1].add(width);
                }
            }
            for v in vertices() {
                let seen = &mut seen[v as usize];
                for (k, width) in widths.into_iter().enumerate() {
                    seen.least[k] = seen.least[k].min(width);
                    seen.greatest[k] = seen.greatest[k].max(width);
                }
                seen.bicells += 1.0;
            }
        }
    }
    for (v, Seen { least, greatest, bicells }) in (0u32..).zip(seen) {
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

fn print<G: Widths>(report: [Option<f64>; 8]) {
    println!("{}D, {N} points, {SEEDS} seeds{:15} all points     interior      report", G::D, "");
    let mut rows = [[Mean::default(); 2]; 8];
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
    print::<Plane>([None, Some(0.255), None, Some(0.014), None, None, Some(0.610), Some(12.0)]);
    print::<Space>([None, Some(0.126), None, Some(0.002), None, Some(0.742), None, Some(66.3)]);
}
