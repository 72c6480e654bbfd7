//! Rings: what is around an edge, in order.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::state::cells::{Cells, NO_CELL};

/// The cells around an edge, in the order in which they share facets, and the vertices of its link.
///
/// In space a cell has the link's vertices of its own index and of the next one; in a ring that is closed the first one
/// follows the last one. In the plane a cell has the one of its own index, and of two cells the first one is on the
/// left of the edge.
#[derive(Debug, Default)]
pub(super) struct EdgeRing {
    pub(super) cells: Vec<CellId>,
    pub(super) link: Vec<VertexId>,
    /// Whether it goes all around, so that the edge is not on the hull.
    pub(super) is_closed: bool,
}

/// The cell across the facet opposite a corner.
#[inline(always)]
fn beyond<G: Moving>(cells: &Cells<G>, cell: CellId, corner: VertexId) -> CellId {
    let row = cells.corners()[cell].as_ref();
    let at = row.iter().position(|&v| v == corner).expect("a corner of the cell");
    cells.neighbours()[cell][at]
}

/// The corner of a cell besides those of an edge and, in space, another one.
#[inline(always)]
fn other<G: Moving>(cells: &Cells<G>, cell: CellId, [v, w]: [VertexId; 2], but: VertexId) -> VertexId {
    let row = cells.corners()[cell].as_ref();
    *row.iter().find(|&&x| x != v && x != w && x != but).expect("one more corner")
}

/// Whether corners are listed in an order of the orientation that a row has.
fn is_even<const N: usize>(row: &[VertexId], corners: [VertexId; N]) -> bool {
    let at = corners.map(|v| row.iter().position(|&x| x == v));
    let inversions = (0..N).flat_map(|j| (0..j).map(move |i| (i, j))).filter(|&(i, j)| at[i] > at[j]);
    inversions.count().is_multiple_of(2)
}

impl EdgeRing {
    /// Goes around an edge, of which `first` is a cell.
    #[inline(always)]
    pub(super) fn go_around<G: Moving>(
        &mut self,
        cells: &Cells<G>,
        edge: [VertexId; 2],
        first: CellId,
    ) -> Result<()> {
        self.cells.clear();
        self.link.clear();
        let last = other(cells, first, edge, VertexId::NONE);
        if G::D == 2 {
            memory::push(&mut self.cells, first)?;
            memory::push(&mut self.link, last)?;
            let across = beyond(cells, first, last);
            if across != NO_CELL {
                memory::push(&mut self.cells, across)?;
                memory::push(&mut self.link, other(cells, across, edge, VertexId::NONE))?;
            }
            self.is_closed = across != NO_CELL;
            return Ok(());
        }
        let start = other(cells, first, edge, last);
        self.is_closed = self.follow(cells, edge, first, [last, start])?;
        if !self.is_closed {
            self.turn_back(cells, edge)?;
        }
        Ok(())
    }

    /// From the last cell around the other way, to the other end.
    #[cold]
    fn turn_back<G: Moving>(&mut self, cells: &Cells<G>, edge: [VertexId; 2]) -> Result<()> {
        let cell = *self.cells.last().expect("a cell at the edge");
        let [.., before, met] = self.link[..] else { unreachable!("two vertices for each cell") };
        self.cells.clear();
        self.link.clear();
        let is_closed = self.follow(cells, edge, cell, [met, before])?;
        debug_assert!(!is_closed);
        Ok(())
    }

    /// Out of each cell by the facet of the edge and the vertex that has been met last; whether that comes back.
    #[inline(always)]
    fn follow<G: Moving>(
        &mut self,
        cells: &Cells<G>,
        edge: [VertexId; 2],
        first: CellId,
        [last, start]: [VertexId; 2],
    ) -> Result<bool> {
        let (mut left, mut met, mut cell) = (last, start, first);
        memory::push(&mut self.cells, first)?;
        memory::push(&mut self.link, last)?;
        memory::push(&mut self.link, start)?;
        loop {
            cell = beyond(cells, cell, left);
            if cell == NO_CELL {
                return Ok(false);
            }
            if cell == first {
                // The vertex met last has been the first.
                self.link.pop();
                return Ok(true);
            }
            (left, met) = (met, other(cells, cell, edge, met));
            memory::push(&mut self.cells, cell)?;
            memory::push(&mut self.link, met)?;
        }
    }

    /// Makes the order counter-clockwise, seen from the end of the edge towards its start; in the
    /// plane, lists the cell on the left of the edge first, if there is one. Whether there is one.
    pub(super) fn orient<G: Moving>(&mut self, cells: &Cells<G>, [v, w]: [VertexId; 2]) -> bool {
        let row = cells.corners()[self.cells[0]].as_ref();
        if G::D == 2 {
            let is_left = is_even(row, [v, w, self.link[0]]);
            if !is_left {
                self.cells.reverse();
                self.link.reverse();
            }
            return is_left || self.is_closed;
        }
        if !is_even(row, [v, w, self.link[0], self.link[1]]) {
            self.cells.reverse();
            self.link.reverse();
            if self.is_closed {
                // The vertex that two cells share comes before the second one of them.
                self.link.rotate_right(1);
            }
        }
        true
    }
}
