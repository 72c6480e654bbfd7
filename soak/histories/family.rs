//! What the points of a history are like, and where they are.

use crate::common::inputs::{Kind, draw_one, integer_sphere};
use crate::common::{Rng, point};
use deldrift::Dimension;

/// A kind of input; those that tests/common/inputs.rs does not have are added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    Of(Kind),
    /// Integer points of a few spheres with one centre.
    Cospherical,
    /// Random points of a few spheres with one centre, as near as numbers come.
    Shells,
    /// Random points of a few parallel hyperplanes.
    Layers,
    /// Around a few places, so near that coordinates differ in their last bits.
    Ulps,
    /// Coordinates of very different magnitudes.
    Magnitudes,
}

const FAMILIES: [Family; 13] = [
    Family::Of(Kind::Random),
    Family::Of(Kind::Random),
    Family::Of(Kind::Lattice),
    Family::Cospherical,
    Family::Shells,
    Family::Of(Kind::RoundedSphere),
    Family::Layers,
    Family::Of(Kind::Line),
    Family::Of(Kind::Hyperplane),
    Family::Of(Kind::Clusters),
    Family::Of(Kind::Duplicates),
    Family::Ulps,
    Family::Magnitudes,
];

/// Where points are drawn from.
#[derive(Debug)]
pub struct Source<G: Dimension> {
    pub family: Family,
    pub n: usize,
    sphere: Vec<G::Point>,
}

impl<G: Dimension> Source<G> {
    /// Of about `n` points.
    pub fn new(n: usize, rng: &mut Rng) -> Self {
        let family = *rng.pick(&FAMILIES);
        // Whose every sign is left to exact arithmetic, in numbers of thousands of bits.
        let n = if family == Family::Magnitudes { n.min(160 / G::D.pow(2)) } else { n };
        let sphere = if family == Family::Cospherical { integer_sphere::<G>() } else { Vec::new() };
        Source { family, n, sphere }
    }

    pub fn draw(&self, rng: &mut Rng) -> Vec<G::Point> {
        (0..self.n).map(|_| self.draw_one(rng)).collect()
    }

    pub fn draw_one(&self, rng: &mut Rng) -> G::Point {
        let mut p = match self.family {
            Family::Of(kind) => draw_one::<G>(kind, self.n, rng),
            Family::Cospherical => {
                let (p, factor) = (*rng.pick(&self.sphere), rng.within(1, 3) as f64);
                point::<G>(|k| factor * p[k])
            }
            Family::Shells => {
                let p = point::<G>(|_| 2.0 * rng.unit() - 1.0);
                let square: f64 = (0..G::D).map(|k| p[k] * p[k]).sum();
                let radius = rng.within(1, 3) as f64;
                if square == 0.0 { p } else { point::<G>(|k| 100.0 * radius * (p[k] / square.sqrt())) }
            }
            Family::Layers => point::<G>(|_| 100.0 * rng.unit()),
            Family::Ulps => {
                let mut place = Rng::new(7 + rng.below(1 + self.n / 30) as u64);
                point::<G>(|_| shifted(1.0 + 20.0 * place.unit(), rng.within(-4, 4)))
            }
            Family::Magnitudes => point::<G>(|_| {
                let size = 0.5f64.powi(55 * rng.below(13) as i32);
                *rng.pick(&[0.0, 1.0, -1.0]) * size * (1.0 + rng.unit())
            }),
        };
        match self.family {
            Family::Layers => p[G::D - 1] = rng.below(6) as f64,
            // Off the line or hyperplane.
            Family::Of(Kind::Line | Kind::Hyperplane) if rng.one_in(self.n.max(12)) => p[0] += 1.0,
            _ => {}
        }
        p
    }
}

/// So many numbers further on, away from 0 or towards it; 0 stays.
pub fn shifted(x: f64, ulps: i64) -> f64 {
    if x == 0.0 { x } else { f64::from_bits(x.to_bits().wrapping_add_signed(ulps)) }
}

/// Positions of the history are (p + offset) · scale, rounded.
#[derive(Clone, Copy, Debug)]
pub struct Frame<G: Dimension> {
    offset: G::Point,
    /// A power of two.
    scale: f64,
}

/// Coordinates before they are scaled are at most this large.
pub const LIMIT: f64 = 32768.0;

impl<G: Dimension> Frame<G> {
    /// A frame that suits the source, and how many points it suits.
    pub fn new(family: Family, rng: &mut Rng) -> (Self, usize) {
        let none = G::Point::default();
        let at = |scale| Frame { offset: none, scale };
        match rng.below(16) {
            0..3 if family != Family::Ulps => {
                let offset = *rng.pick(&[1e7, -1e7, 3e10]);
                (
                    Frame { offset: point::<G>(|k| if k == 0 { offset } else { -0.3 * offset }), scale: 1.0 },
                    6000,
                )
            }
            // The largest coordinates, and the least numbers that there are: these have no filter.
            3 => (at(2f64.powi(173)), 6000),
            4 => (at(0.5f64.powi(1054)), 500 / G::D.pow(2)),
            5 => (at(0.5f64.powi(540)), 500 / G::D.pow(2)),
            6 => (at(0.5f64.powi(60)), usize::MAX),
            _ => (at(1.0), usize::MAX),
        }
    }

    pub fn place(&self, p: &G::Point) -> G::Point {
        point::<G>(|k| (p[k] + self.offset[k]) * self.scale + 0.0)
    }
}
