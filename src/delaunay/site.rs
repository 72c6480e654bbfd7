//! Sites: the distinct places at which the triangulation has vertices.

use crate::complex::NONE;
use crate::delaunay::Dimension;

/// A place and the vertex that represents it. Index 0 is a placeholder for the ghost vertex.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Site<G: Dimension> {
    /// The place.
    pub point: G::Point,
    /// A cell that has the site as a corner; [`NONE`] while there is none.
    pub cell: u32,
    /// The vertex at the place, the lowest id if there are several: ties between signs are broken by it.
    /// [`NONE`] if the index is free.
    pub id: u32,
}

impl<G: Dimension> Site<G> {
    /// A site that is in no cell yet.
    pub fn new(point: G::Point, id: u32) -> Self {
        Site { point, cell: NONE, id }
    }

    /// Whether the index is in use.
    #[inline(always)]
    pub fn is_live(&self) -> bool {
        self.id != NONE
    }
}
