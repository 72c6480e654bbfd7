//! The two dimensions in which deldrift works, as types by what a point is, and the arrays that have a length for each.

use std::fmt::Debug;
use std::marker::PhantomData;

use crate::complex::Corners;
use crate::ids::{CellId, SiteId, VertexId};
use crate::predicates::{Coordinates, PlanePoint, SpacePoint, WeightedPoint};

/// The number of coordinates, and the arrays whose lengths follow from it.
pub trait Shape: Copy + Debug + Default + Send + Sync + 'static {
    /// Number of coordinates.
    const D: usize;
    /// How many numbers a point is: its coordinates, and its weight if it has one.
    const NUMBERS: usize;
    /// Whether points have weights.
    const HAS_WEIGHTS: bool = Self::NUMBERS > Self::D;
    /// `[f64; D]`, or that with a weight.
    type Point: Coordinates;
    /// `[SiteId; D + 1]`: the corners of a cell in the kernel.
    type Corners: Corners;
    /// `[VertexId; D + 1]`: the vertices of a cell.
    type Vertices: Corners<VertexId>;
    /// `[CellId; D + 1]`: the neighbours of a cell, opposite its vertices.
    type Neighbours: Corners<CellId>;
}

/// Two dimensions: points are `[f64; 2]`, or `WeightedPoint<2>` for power distances.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plane<P = [f64; 2]>(PhantomData<P>);

/// Three dimensions: points are `[f64; 3]`, or `WeightedPoint<3>` for power distances.
#[derive(Clone, Copy, Debug, Default)]
pub struct Space<P = [f64; 3]>(PhantomData<P>);

/// The plane, of points with weights.
pub type PowerPlane = Plane<WeightedPoint<2>>;

/// Space, of points with weights.
pub type PowerSpace = Space<WeightedPoint<3>>;

impl<P: PlanePoint> Shape for Plane<P> {
    const D: usize = 2;
    const NUMBERS: usize = 2 + P::HAS_WEIGHT as usize;
    type Point = P;
    type Corners = [SiteId; 3];
    type Vertices = [VertexId; 3];
    type Neighbours = [CellId; 3];
}

impl<P: SpacePoint> Shape for Space<P> {
    const D: usize = 3;
    const NUMBERS: usize = 3 + P::HAS_WEIGHT as usize;
    type Point = P;
    type Corners = [SiteId; 4];
    type Vertices = [VertexId; 4];
    type Neighbours = [CellId; 4];
}
