//! Shared by the examples: random numbers, the same in every run.
#![allow(dead_code)] // Each example uses a part.

use deldrift::Dimension;

/// Splitmix64.
pub struct Random(pub u64);

impl Random {
    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ z >> 31) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// In the cube [0, side)^D, or the square.
    pub fn in_cube<G: Dimension>(&mut self, side: f64) -> G::Point {
        let mut p = G::Point::default();
        for k in 0..G::D {
            p[k] = side * self.unit();
        }
        p
    }

    /// In the ball of this radius.
    pub fn in_ball<G: Dimension>(&mut self, radius: f64) -> G::Point {
        loop {
            let mut p = G::Point::default();
            for k in 0..G::D {
                p[k] = radius * (2.0 * self.unit() - 1.0);
            }
            if p.as_ref().iter().map(|x| x * x).sum::<f64>() <= radius * radius {
                return p;
            }
        }
    }
}
