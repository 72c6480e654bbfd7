//! The neighbours of the cells.

use crate::complex::Corners;
use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::{CellId, Slot, VertexId};
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::machine::{memory, threads};
use crate::motion::state::cells::{Cells, NO_CELL, ids_of};
use crate::motion::state::marks::Marks;
use crate::motion::state::ordering::Ordering;

/// Rows that take a few times as long to write as a thread takes to wake up.
const GLUED_AT_LEAST: usize = 1 << 13;

impl<G: Moving> Cells<G> {
    /// Writes the neighbours of the cells in the dirty slots and in those that have `moved`, and their neighbours'
    /// sides.
    pub(super) fn glue_slots(&mut self, kernel: &Delaunay<G>, dirty: &Marks<Slot>, moved: &[Slot]) {
        let complex = kernel.complex();
        let last = Slot::at(complex.n_slots() - 1);
        for (k, &slot) in dirty.as_slice().iter().chain(moved).enumerate() {
            if let Some(&next) = dirty.as_slice().get(k + 3 * AHEAD / 2) {
                prefetch(complex.cells(), next.index());
            }
            if let Some(&next) = dirty.as_slice().get(k + AHEAD) {
                let cell = complex.cell(next.min(last));
                (0..G::Corners::N).for_each(|i| prefetch(&self.index_of, cell.neighbour(i).cell().index()));
            }
            if let Some(&next) = dirty.as_slice().get(k + AHEAD / 2) {
                let cell = complex.cell(next.min(last));
                for i in 0..G::Corners::N {
                    let index = self.index_in(cell.neighbour(i).cell()).index();
                    prefetch(&self.neighbours, index);
                    prefetch(&self.orderings, index);
                }
            }
            if !complex.is_live(slot) {
                continue;
            }
            let cell = complex.cell(slot);
            if cell.is_ghost() {
                let behind = cell.neighbour(G::D);
                if !dirty.has(behind.cell()) {
                    let index = self.index_of[behind.cell()];
                    self.neighbours[index][self.orderings[index].place(behind.index())] = NO_CELL;
                }
                continue;
            }
            // Each into its place: a row put in order first would be read as a whole right after it was written in
            // parts, which waits.
            let index = self.index_of[slot];
            let ordering = self.orderings[index];
            for i in 0..G::Corners::N {
                let out = cell.neighbour(i);
                let across = self.index_of[out.cell()];
                self.neighbours[index][ordering.place(i)] = across;
                if across != NO_CELL && !dirty.has(out.cell()) {
                    self.neighbours[across][self.orderings[across].place(out.index())] = index;
                }
            }
        }
    }

    /// Writes the neighbours of all cells, on several threads where that pays.
    pub(super) fn glue_all(&mut self, kernel: &Delaunay<G>) {
        let (slots, orderings, index_of) = (&self.slots[..], &self.orderings[..], &self.index_of[..]);
        let n_threads = kernel.threads().for_work(slots.len(), GLUED_AT_LEAST, 256);
        threads::for_parts(&mut self.neighbours, 0, n_threads, &|first, rows: &mut [G::Neighbours]| {
            for (index, row) in (first..).zip(rows) {
                if let Some(&next) = slots.get(index + AHEAD) {
                    prefetch(kernel.complex().cells(), next.index());
                }
                let (cell, ordering) = (kernel.complex().cell(slots[index]), orderings[index]);
                for i in 0..G::Corners::N {
                    row[ordering.place(i)] = index_of[cell.neighbour(i).cell()];
                }
            }
        });
    }

    /// Makes the arrays of all cells, of which there are none yet.
    pub(super) fn fill(&mut self, kernel: &Delaunay<G>) -> Result<()> {
        let (n, n_slots) = (kernel.complex().n_finite(), kernel.complex().n_slots());
        let Cells { corners, neighbours, index_of, slots, orderings, .. } = self;
        memory::reserve(corners, n)?;
        memory::reserve(neighbours, n)?;
        memory::reserve(slots, n)?;
        let more_orderings = n.saturating_sub(orderings.len());
        memory::reserve(orderings, more_orderings)?;
        index_of.clear();
        memory::reserve(index_of, n_slots)?;
        if let Some(tracker) = &mut self.since_taken {
            tracker.reserve(0, 0, n, n, self.journal.is_none())?;
        }
        // From here on nothing fails.
        if let Some(tracker) = &mut self.since_taken {
            CellId::range(0..n).for_each(|index| tracker.create(index));
        }
        index_of.resize(n_slots, NO_CELL);
        for (slot, index) in kernel.complex().finite().zip(CellId::range(0..n)) {
            slots.push(slot);
            index_of[slot] = index;
        }
        orderings.clear();
        orderings.resize(n, Ordering::SAME);
        neighbours.resize(n, G::Neighbours::filled(NO_CELL));
        corners.resize(n, G::Vertices::filled(VertexId::NONE));
        let (slots, n_threads) = (&slots[..], kernel.threads().for_work(n, GLUED_AT_LEAST, 256));
        threads::for_parts(corners, 0, n_threads, &|first, rows: &mut [G::Vertices]| {
            rows.iter_mut().zip(&slots[first..]).for_each(|(row, &slot)| *row = ids_of(kernel, slot));
        });
        self.glue_all(kernel);
        Ok(())
    }
}
