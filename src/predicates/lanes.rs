//! Bi-cells side by side, to be looked at together.

use crate::simd::{LANES, Simd};

/// A number for each lane, as in memory.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(32))]
struct Stored([f64; LANES]);

/// The points of as many bi-cells as there are lanes.
#[derive(Clone, Copy, Debug)]
pub struct BiCells<const D: usize, const P: usize>([[Stored; D]; P]);

impl<const D: usize, const P: usize> Default for BiCells<D, P> {
    fn default() -> Self {
        BiCells([[Stored::default(); D]; P])
    }
}

impl<const D: usize, const P: usize> BiCells<D, P> {
    /// Sets the bi-cell of a lane, below [`LANES`]: the vertices of the facet, then the opposing ones.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, points: [&[f64; D]; P]) {
        for (stored, p) in self.0.iter_mut().zip(points) {
            for (stored, &x) in stored.iter_mut().zip(p) {
                stored.0[lane] = x;
            }
        }
    }

    /// The bi-cell of a lane.
    pub(super) fn lane(&self, lane: usize) -> [[f64; D]; P] {
        self.0.map(|p| p.map(|stored| stored.0[lane]))
    }

    /// The points, in lanes.
    #[inline(always)]
    pub(super) fn lanes<S: Simd>(&self, simd: S) -> [[S::Lanes; D]; P] {
        let mut lanes = [[simd.splat(0.0); D]; P];
        for (lanes, p) in lanes.iter_mut().zip(&self.0) {
            for (lanes, stored) in lanes.iter_mut().zip(p) {
                *lanes = simd.load(&stored.0);
            }
        }
        lanes
    }
}
