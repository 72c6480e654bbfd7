//! What is read once after each change and kept: the cells, in the order of those that the program knows, and the edges.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::NO_CELL;
use crate::periodic::cells::PeriodicCells;
use crate::periodic::changes::{Name, Taking};
use crate::periodic::edges::PeriodicEdges;
use crate::periodic::lattice::Shift;
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// The cells, which the first that asks reads; several threads may do that at the same time.
    pub(super) fn read_cells(&self) -> Result<&PeriodicCells<G>> {
        if let Some(cells) = self.cells.get() {
            return Ok(cells);
        }
        let read = self.in_order(PeriodicCells::of(&self.inside)?)?;
        Ok(self.cells.get_or_init(|| read))
    }

    /// The edges, which the first that asks reads; several threads may do that at the same time.
    pub(super) fn read_edges(&self) -> Result<&PeriodicEdges> {
        if let Some(edges) = self.edges.get() {
            return Ok(edges);
        }
        let read = PeriodicEdges::of(&self.inside)?;
        Ok(self.edges.get_or_init(|| read))
    }

    /// Gives cells that were there at the base their indices, as far as there are as many.
    fn in_order(&self, read: PeriodicCells<G>) -> Result<PeriodicCells<G>> {
        let Some(Taking { base, .. }) = &self.taking else { return Ok(read) };
        let n = read.corners.len();
        let mut origins = Vec::new();
        memory::reserve_exact(&mut origins, n)?;
        for cell in 0..n {
            origins.push(base.index_of.get(&self.name_of(&read, cell).0).copied().unwrap_or(NO_CELL));
        }
        // By index, which one has it.
        let mut order = Vec::new();
        memory::lengthen(&mut order, n, NO_CELL)?;
        let stays = |origin: CellId| origin != NO_CELL && origin.index() < n;
        for (cell, &origin) in CellId::range(0..n).zip(&origins).filter(|&(_, &origin)| stays(origin)) {
            order[origin] = cell;
        }
        let mut others = CellId::range(0..n).filter(|&cell| !stays(origins[cell]));
        for entry in order.iter_mut().filter(|entry| **entry == NO_CELL) {
            *entry = others.next().expect("there are as many as places");
        }
        read.reordered(&order, &origins)
    }

    /// By which a cell is known to the program, and whether that lists the corners in the opposite orientation.
    pub(super) fn name_of(&self, cells: &PeriodicCells<G>, cell: usize) -> (Name, bool) {
        let from = self.least_of(cells, cell);
        let mut name = [(VertexId::NONE, [0; 3]); 4];
        let row = cells.corners[cell].as_ref();
        for (i, (entry, &v)) in name.iter_mut().zip(row).enumerate() {
            *entry = (v, self.given(from, v, cells.shifts.of(cell)[i]));
        }
        let name_of_all = &mut name[..=G::D];
        let is_before = |i: usize| name_of_all[..i].iter().filter(|entry| **entry > name_of_all[i]).count();
        let is_odd = (0..=G::D).map(is_before).sum::<usize>() % 2 == 1;
        name_of_all.sort_unstable();
        let first = name_of_all[0].1;
        name_of_all.iter_mut().for_each(|(_, shift)| *shift = [0, 1, 2].map(|j| shift[j] - first[j]));
        (name, is_odd)
    }

    pub(super) fn least_of(&self, cells: &PeriodicCells<G>, cell: usize) -> VertexId {
        cells.corners[cell].as_ref()[usize::from(cells.least[cell])]
    }

    /// By which multiples of the given vectors one vertex is translated from its position where another one is at its own, if
    /// it is translated by this shift from home where the other one is at home.
    pub(super) fn given(&self, from: VertexId, to: VertexId, shift: Shift) -> [i64; 3] {
        let (first, second) = (&self.wraps[from], &self.wraps[to]);
        self.lattice.of_caller([0, 1, 2].map(|j| i64::from(shift[j]) - second[j] + first[j]))
    }
}
