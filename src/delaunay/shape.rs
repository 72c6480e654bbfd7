//! The two dimensions in which deldrift works, as types, and the arrays that have a length for each.

use std::fmt::Debug;

use crate::complex::Corners;
use crate::ids::{CellId, SiteId, VertexId};
use crate::predicates::Coordinates;

/// The number of coordinates, and the arrays whose lengths follow from it.
pub trait Shape: Copy + Debug + Default + Send + Sync + 'static {
    /// Number of coordinates.
    const D: usize;
    /// `[f64; D]`.
    type Point: Coordinates;
    /// `[SiteId; D + 1]`: the corners of a cell in the kernel.
    type Corners: Corners;
    /// `[VertexId; D + 1]`: the vertices of a cell.
    type Vertices: Corners<VertexId>;
    /// `[CellId; D + 1]`: the neighbours of a cell, opposite its vertices.
    type Neighbours: Corners<CellId>;
}

/// Two dimensions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plane;

/// Three dimensions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Space;

impl Shape for Plane {
    const D: usize = 2;
    type Point = [f64; 2];
    type Corners = [SiteId; 3];
    type Vertices = [VertexId; 3];
    type Neighbours = [CellId; 3];
}

impl Shape for Space {
    const D: usize = 3;
    type Point = [f64; 3];
    type Corners = [SiteId; 4];
    type Vertices = [VertexId; 4];
    type Neighbours = [CellId; 4];
}
