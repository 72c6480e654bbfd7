//! Stars in the order in which one goes around a vertex of the plane.

use crate::delaunay::{Plane, Shape};
use crate::error::Result;
use crate::ids::{CellId, SiteId, VertexId};
use crate::motion::state::cells::NO_CELL;
use crate::motion::triangulation::MovingTriangulation;

/// The cells around a vertex, counter-clockwise.
#[derive(Clone, Debug)]
pub struct OrderedStar<'t> {
    corners: &'t [<Plane as Shape>::Vertices],
    neighbours: &'t [<Plane as Shape>::Neighbours],
    vertex: VertexId,
    first: CellId,
    next: CellId,
}

impl OrderedStar<'_> {
    /// The cell that follows another one, counter-clockwise or else clockwise.
    fn beside(&self, cell: CellId, counter_clockwise: bool) -> CellId {
        let row = self.corners[cell];
        let at = row.iter().position(|&v| v == self.vertex).expect("a corner");
        // The next cell is across the edge to the last of the three corners, and so opposite the one after the vertex.
        self.neighbours[cell][(at + if counter_clockwise { 1 } else { 2 }) % 3]
    }
}

impl Iterator for OrderedStar<'_> {
    type Item = CellId;

    fn next(&mut self) -> Option<CellId> {
        let cell = self.next;
        if cell == NO_CELL {
            return None;
        }
        self.next = self.beside(cell, true);
        if self.next == self.first {
            self.next = NO_CELL;
        }
        Some(cell)
    }
}

impl MovingTriangulation<Plane> {
    /// The cells around the place of a vertex, counter-clockwise: from the one of lowest index, or, for a vertex of the
    /// convex hull, from the one at the hull's edge that leaves the vertex when the hull is passed counter-clockwise.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`](crate::Error::NoSuchVertex), [`Error::RemovedVertex`](crate::Error::RemovedVertex),
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn ordered_star(&self, vertex: VertexId) -> Result<OrderedStar<'_>> {
        let s: SiteId = self.present_site("vertex", 0, vertex)?;
        let cells = self.cell_arrays()?;
        let vertex = self.mesh.kernel.site(s).id;
        let (corners, neighbours) = (cells.corners(), cells.neighbours());
        let mut star = OrderedStar { corners, neighbours, vertex, first: NO_CELL, next: NO_CELL };
        if corners.is_empty() {
            return Ok(star);
        }
        let around = self.mesh.kernel.site(s).cell;
        let behind = self.mesh.kernel.complex().cell(around).neighbour(Plane::D).cell();
        let is_ghost = self.mesh.kernel.complex().cell(around).is_ghost();
        let start = cells.index_of()[if is_ghost { behind } else { around }];
        let (mut lowest, mut cell) = (start, start);
        star.first = loop {
            let before = star.beside(cell, false);
            if before == NO_CELL {
                break cell;
            }
            if before == start {
                break lowest;
            }
            lowest = lowest.min(before);
            cell = before;
        };
        star.next = star.first;
        Ok(star)
    }
}
