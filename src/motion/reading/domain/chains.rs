//! The boundary of some of the cells of the plane, in closed chains.
//!
//! A chain goes on at its vertex with the edge that ends the fan of masked cells around it. So at a vertex where two parts
//! of the set touch, each part keeps its own chain, and no chain crosses another.
//!
//! Each chain begins with its least edge, by the id of where an edge begins and then of where it ends, and chains are in the
//! order of these: the list is a function of the set of cells alone.

use crate::delaunay::Plane;
use crate::error::Result;
use crate::ids::{CellId, SegmentId, VertexId};
use crate::machine::memory;
use crate::motion::state::cells::NO_CELL;
use crate::motion::triangulation::MovingTriangulation;

/// An edge of a chain. It goes to the vertex of the next one, that of the last edge of a chain to the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChainEdge {
    /// Which chain it is in: 0, 1, ...
    pub chain: u32,
    /// Where it begins.
    pub vertex: VertexId,
    /// The cell of the set that it bounds, which is on its left.
    pub cell: CellId,
    /// The corner of the cell that is opposite.
    pub corner: usize,
    /// The segment at it, the lowest id if there are several, or [`SegmentId::NONE`].
    pub segment: SegmentId,
}

/// The corners of a cell that an edge goes from and to, by the one opposite.
const ENDS: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];

impl MovingTriangulation<Plane> {
    /// The boundary of the cells of which the entry in `mask` is not 0, in chains that have these cells on the left: an
    /// outer boundary is counter-clockwise, that of a hole clockwise.
    ///
    /// # Errors
    /// [`Error::WrongCount`](crate::Error::WrongCount) unless there is an entry for each cell,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn boundary_chains(&self, mask: &[u8]) -> Result<Vec<ChainEdge>> {
        self.check_mask(mask.len())?;
        let cells = self.cell_arrays()?;
        let at_edges = self.segments_of_cells()?;
        let is_in = |cell: CellId| cell != NO_CELL && mask[cell.index()] != 0;
        let is_bound = |cell: CellId, i: usize| is_in(cell) && !is_in(cells.neighbours()[cell][i]);
        let edge = |cell: CellId, i: usize| ENDS[i].map(|k| cells.corners()[cell][k]);
        let mut starts = Vec::new();
        for cell in CellId::range(0..mask.len()) {
            for i in (0..3).filter(|&i| is_bound(cell, i)) {
                memory::push(&mut starts, (edge(cell, i), cell, i))?;
            }
        }
        starts.sort_unstable();
        // Bit i: the edge opposite corner i is in a chain.
        let (mut is_listed, mut chains, mut chain) = (Vec::new(), Vec::new(), 0);
        memory::lengthen(&mut is_listed, mask.len(), 0_u8)?;
        memory::reserve(&mut chains, starts.len())?;
        for &(_, first, corner) in &starts {
            let (mut cell, mut i) = (first, corner);
            if is_listed[cell.index()] & (1 << i) != 0 {
                continue;
            }
            while is_listed[cell.index()] & (1 << i) == 0 {
                is_listed[cell.index()] |= 1 << i;
                let [vertex, end] = edge(cell, i);
                chains.push(ChainEdge { chain, vertex, cell, corner: i, segment: at_edges[cell.index()][i] });
                // Around the end, from cell to cell of the set, to the next edge of the boundary.
                i = ENDS[i][0];
                while !is_bound(cell, i) {
                    cell = cells.neighbours()[cell][i];
                    let at =
                        cells.corners()[cell].into_iter().position(|v| v == end).expect("a cell around it");
                    i = ENDS[at][1];
                }
            }
            chain += 1;
        }
        Ok(chains)
    }
}
