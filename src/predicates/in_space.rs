//! Places and vertices in space, where the plane is at height 0.

use std::fmt::Debug;

use super::weighted::WeightedPoint;

/// A place in space, or in the plane at height 0.
pub type PlaceInSpace = [f64; 3];

/// A vertex in space, or in the plane at height 0: a [`PlaceInSpace`], or one with a weight.
pub trait VertexInSpace: Copy + Debug + Default + PartialEq + Send + Sync {
    /// Whether there are weights.
    const HAS_WEIGHT: bool;
    /// Where it is.
    fn place(&self) -> &PlaceInSpace;
    /// Its weight, 0 if there are none.
    fn weight(&self) -> f64;
}

impl VertexInSpace for PlaceInSpace {
    const HAS_WEIGHT: bool = false;

    #[inline(always)]
    fn place(&self) -> &PlaceInSpace {
        self
    }

    #[inline(always)]
    fn weight(&self) -> f64 {
        0.0
    }
}

impl VertexInSpace for WeightedPoint<3> {
    const HAS_WEIGHT: bool = true;

    #[inline(always)]
    fn place(&self) -> &PlaceInSpace {
        &self.place
    }

    #[inline(always)]
    fn weight(&self) -> f64 {
        self.weight
    }
}

/// A place in space, of the plane at height 0.
#[inline(always)]
pub(super) fn place_in_space<const D: usize>(p: &[f64; D]) -> PlaceInSpace {
    [p[0], p[1], if D == 3 { p[D - 1] } else { 0.0 }]
}
