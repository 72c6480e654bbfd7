//! The two dimensions in which deldrift works, as types.

use std::fmt::Debug;

use super::kernel::Kernel;
use crate::complex::Corners;
use crate::predicates::Coordinates;

/// A dimension: [`Plane`] or [`Space`].
pub trait Dimension: Kernel<Self> + Copy + Debug + Default + Send + Sync + 'static {
    /// Number of coordinates.
    const D: usize;
    /// `[f64; D]`.
    type Point: Coordinates;
    /// `[u32; D + 1]`: the corners of a cell, or its neighbours.
    type Corners: Corners;
}

/// Two dimensions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plane;

/// Three dimensions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Space;

impl Dimension for Plane {
    const D: usize = 2;
    type Point = [f64; 2];
    type Corners = [u32; 3];
}

impl Dimension for Space {
    const D: usize = 3;
    type Point = [f64; 3];
    type Corners = [u32; 4];
}
