//! A triangulation that is to be refined.

use super::parts::{NONE, NOT_SELECTED, turn_of, turned};
use crate::delaunay::Keys;
use crate::ids::{CellId, VertexId};

/// Cells, segments at them, and what is selected of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Given<'a> {
    /// The box in which all vertices of cells are.
    pub lower: [f64; 2],
    pub upper: [f64; 2],
    /// Counter-clockwise.
    pub corners: &'a [[VertexId; 3]],
    /// Cell across the edge opposite each corner, [`CellId::NONE`] on the hull.
    pub neighbours: &'a [[CellId; 3]],
    /// A cell of each vertex, [`NONE`] of those that are in none.
    pub at: &'a [u32],
    /// By cell, 0 for those that stay as they are.
    pub mask: &'a [u8],
    /// What the program knows each cell by; without them it is 0.
    pub labels: Option<&'a [u32]>,
    /// The cells at segments, ascending, with the segment at the edge opposite each corner: its place among `segments`,
    /// [`NONE`] where there is none.
    pub sides: &'a [(u32, [u32; 3])],
    /// Ends of each segment.
    pub segments: &'a [[VertexId; 2]],
    /// What breaks ties; of vertices that are made as `Keys` tells.
    pub keys: &'a Keys,
}

impl Given<'_> {
    /// The label of a cell, [`NOT_SELECTED`] if it is not to be refined.
    #[inline(always)]
    pub(crate) fn label(&self, cell: u32) -> u32 {
        match self.labels {
            _ if self.mask[cell as usize] == 0 => NOT_SELECTED,
            Some(labels) => labels[cell as usize].min(NOT_SELECTED - 1),
            None => 0,
        }
    }

    /// The corners of a cell, the lowest first: copies of a triangulation have them in other orders.
    #[inline(always)]
    pub(crate) fn row(&self, cell: u32) -> [VertexId; 3] {
        let row = self.corners[cell as usize];
        turned(row, turn_of(&row))
    }

    /// The cells across its edges, in the order of its [row](Self::row).
    #[inline(always)]
    pub(crate) fn across(&self, cell: u32) -> [CellId; 3] {
        turned(self.neighbours[cell as usize], turn_of(&self.corners[cell as usize]))
    }

    /// The segments at its edges, in the order of its [row](Self::row).
    pub(crate) fn sides_of(&self, cell: u32) -> [u32; 3] {
        let found = self.sides.binary_search_by_key(&cell, |&(cell, _)| cell);
        found.map_or([NONE; 3], |k| turned(self.sides[k].1, turn_of(&self.corners[cell as usize])))
    }
}
