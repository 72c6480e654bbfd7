//! Inputs of every kind that has broken a Delaunay code, with coordinates that are multiples of [`QUANTUM`]
//! so that [`exact`](super::exact) can judge them.

use super::exact::Grid;
use super::{Rng, point};
use deldrift::Moving;

/// All coordinates are multiples of this, ...
pub const QUANTUM: f64 = 1.0 / (1u64 << 20) as f64;
/// ... and at most this large.
pub const LIMIT: f64 = 32768.0;

/// The nearest point with allowed coordinates.
pub fn quantized<G: Moving>(p: G::Point) -> G::Point {
    point::<G>(|k| (p[k].clamp(-LIMIT, LIMIT) / QUANTUM).round() * QUANTUM + 0.0)
}

/// In units of the quantum.
pub fn to_grid<G: Moving>(p: &G::Point) -> Grid {
    (0..G::D).map(|k| (p[k] / QUANTUM) as i64).collect()
}

/// A kind of input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Uniform in a box.
    Random,
    /// On a square lattice, most places taken.
    Lattice,
    /// Integer points of one circle or sphere.
    Sphere,
    /// Points of a circle or sphere, rounded: nearly but not quite on one.
    RoundedSphere,
    /// On a line, one off it.
    Line,
    /// In a hyperplane, one off it.
    Hyperplane,
    /// Clusters of several scales within each other.
    Clusters,
    /// A third as many places as points.
    Duplicates,
}

pub const KINDS: [Kind; 8] = [
    Kind::Random,
    Kind::Lattice,
    Kind::Sphere,
    Kind::RoundedSphere,
    Kind::Line,
    Kind::Hyperplane,
    Kind::Clusters,
    Kind::Duplicates,
];

/// Draws `n` points.
pub fn draw<G: Moving>(kind: Kind, n: usize, rng: &mut Rng) -> Vec<G::Point> {
    let mut points: Vec<G::Point> = (0..n).map(|_| draw_one::<G>(kind, n, rng)).collect();
    if n > 0 && matches!(kind, Kind::Line | Kind::Hyperplane) {
        let off = rng.below(n);
        points[off] = point::<G>(|k| points[off][k] + rng.within(1, 3) as f64);
    }
    points
}

/// Draws a point as one of `n`.
pub fn draw_one<G: Moving>(kind: Kind, n: usize, rng: &mut Rng) -> G::Point {
    let side = (n as f64).powf(1.0 / G::D as f64).ceil() as i64;
    let p = match kind {
        Kind::Random => point::<G>(|_| 1000.0 * (2.0 * rng.unit() - 1.0)),
        Kind::Lattice => point::<G>(|_| rng.within(0, side) as f64),
        Kind::Sphere => {
            let points = integer_sphere::<G>();
            points[rng.below(points.len())]
        }
        Kind::RoundedSphere => on_sphere::<G>(100.0, rng),
        Kind::Line => {
            let x = rng.within(-(n as i64), n as i64) as f64;
            point::<G>(|k| (k as f64 + 1.0) * x)
        }
        Kind::Hyperplane => {
            let p = point::<G>(|_| rng.within(0, 2 + side) as f64);
            point::<G>(|k| if k + 1 == G::D { p[0] - 2.0 * p[k - 1] } else { p[k] })
        }
        Kind::Clusters => {
            let scales = [1024.0, 4.0, 1.0 / 64.0, 1.0 / 4096.0];
            let levels = 1 + rng.below(scales.len());
            point::<G>(|_| scales[..levels].iter().map(|s| s * rng.within(-2, 2) as f64).sum::<f64>())
        }
        Kind::Duplicates => {
            let mut place = Rng::new(77 + rng.below(n / 3 + 1) as u64);
            point::<G>(|_| place.within(-20, 20) as f64)
        }
    };
    quantized::<G>(p)
}

/// Integer points at distance 65 (plane) or 15 (space) from the origin.
pub fn integer_sphere<G: Moving>() -> Vec<G::Point> {
    let radius: i64 = if G::D == 2 { 65 } else { 15 };
    let range = -radius..=radius;
    let mut points = Vec::new();
    for x in range.clone() {
        for y in range.clone() {
            for z in if G::D == 2 { 0..=0 } else { range.clone() } {
                if x * x + y * y + z * z == radius * radius {
                    points.push(point::<G>(|k| [x, y, z][k] as f64));
                }
            }
        }
    }
    points
}

/// A point near the sphere of a radius around the origin.
pub fn on_sphere<G: Moving>(radius: f64, rng: &mut Rng) -> G::Point {
    loop {
        let p = point::<G>(|_| 2.0 * rng.unit() - 1.0);
        let norm = (0..G::D).map(|k| p[k] * p[k]).sum::<f64>().sqrt();
        if (0.1..1.0).contains(&norm) {
            return quantized::<G>(point::<G>(|k| radius * p[k] / norm));
        }
    }
}

/// Random places on the unit sphere, as near as numbers come.
pub fn on_unit_sphere(n: usize, rng: &mut Rng) -> Vec<[f64; 3]> {
    let place = |_| {
        let p = [0; 3].map(|_| rng.unit() - 0.5);
        let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
        p.map(|x| x / length)
    };
    (0..n).map(place).collect()
}

/// Random places on three spheres with one centre, in turn.
pub fn on_spheres_within_each_other(n: usize, rng: &mut Rng) -> Vec<[f64; 3]> {
    let mut points = on_unit_sphere(n, rng);
    points.iter_mut().enumerate().for_each(|(k, p)| *p = p.map(|x| x * (1 + k % 3) as f64));
    points
}
