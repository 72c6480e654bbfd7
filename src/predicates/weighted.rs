//! Points with weights: balls, whose squared radii are the weights, in the field's words.

use std::ops::{Index, IndexMut};

/// A place and its weight; or several, in lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct WeightedPoint<const D: usize, T = f64> {
    /// Where it is.
    pub place: [T; D],
    /// What is taken from the square of a distance to it.
    pub weight: T,
}

impl<const D: usize> Default for WeightedPoint<D> {
    fn default() -> Self {
        WeightedPoint { place: [0.0; D], weight: 0.0 }
    }
}

impl<const D: usize> AsRef<[f64]> for WeightedPoint<D> {
    #[inline(always)]
    fn as_ref(&self) -> &[f64] {
        &self.place
    }
}

impl<const D: usize> Index<usize> for WeightedPoint<D> {
    type Output = f64;

    #[inline(always)]
    fn index(&self, k: usize) -> &f64 {
        if k == D { &self.weight } else { &self.place[k] }
    }
}

impl<const D: usize> IndexMut<usize> for WeightedPoint<D> {
    #[inline(always)]
    fn index_mut(&mut self, k: usize) -> &mut f64 {
        if k == D { &mut self.weight } else { &mut self.place[k] }
    }
}

const _: () = assert!(size_of::<WeightedPoint<2>>() == size_of::<[f64; 3]>());
const _: () = assert!(size_of::<WeightedPoint<3>>() == size_of::<[f64; 4]>());
