//! Shared by the examples: random points, the same in every run.
#![allow(dead_code)] // Each example uses a part.

#[path = "../../tests/common/random.rs"]
mod random;

use deldrift::Dimension;
pub use random::Rng;

/// A point in the cube [0, side)^D, or the square.
pub fn in_cube<G: Dimension>(rng: &mut Rng, side: f64) -> G::Point {
    let mut p = G::Point::default();
    for k in 0..G::D {
        p[k] = side * rng.unit();
    }
    p
}

/// A point in the ball of this radius.
pub fn in_ball<G: Dimension>(rng: &mut Rng, radius: f64) -> G::Point {
    loop {
        let mut p = G::Point::default();
        for k in 0..G::D {
            p[k] = radius * (2.0 * rng.unit() - 1.0);
        }
        if p.as_ref().iter().map(|x| x * x).sum::<f64>() <= radius * radius {
            return p;
        }
    }
}
