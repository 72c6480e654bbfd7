//! The way back from a number of flips.

use super::{Cell, Complex, Corners, NONE};

/// What cells were before they changed, since [`Complex::begin`].
#[derive(Debug)]
pub struct Journal<C: Corners> {
    /// Cells as they were, the latest change last; free ones for those made.
    cells: Vec<(u32, Cell<C>)>,
    /// The free indices at the beginning.
    free: Vec<u32>,
    /// The number of indices at the beginning.
    n_slots: usize,
    /// The cells changed back, after a way back.
    restored: Vec<u32>,
}

impl<C: Corners> Default for Journal<C> {
    fn default() -> Self {
        Journal { cells: Vec::new(), free: Vec::new(), n_slots: 0, restored: Vec::new() }
    }
}

impl<C: Corners> Journal<C> {
    /// Enters a cell that was made where none was, or where the one that was has been [saved](Complex::save).
    pub(crate) fn made(&mut self, cell: u32) {
        self.cells.push((cell, Cell::free()));
    }

    /// The cells changed back by [`Complex::roll_back`].
    pub(crate) fn restored(&self) -> &[u32] {
        &self.restored
    }
}

impl<C: Corners> Complex<C> {
    /// Begins a journal.
    pub(crate) fn begin(&self, journal: &mut Journal<C>) {
        journal.cells.clear();
        journal.free.clone_from(&self.free);
        journal.n_slots = self.cells.len();
    }

    /// Enters cells that are about to be exchanged, and their neighbours.
    pub(crate) fn save(&self, cells: &[u32], journal: &mut Journal<C>) {
        for &c in cells {
            let cell = *self.cell(c);
            journal.cells.push((c, cell));
            journal.cells.extend((0..C::N).map(|i| {
                let next = cell.neighbour(i).cell();
                (next, *self.cell(next))
            }));
        }
    }

    /// Makes all as it was when the journal began. No cell may have become a ghost or ceased to be one.
    pub(crate) fn roll_back(&mut self, journal: &mut Journal<C>) {
        journal.restored.clear();
        for (c, cell) in journal.cells.drain(..).rev() {
            *self.cell_mut(c) = cell;
            journal.restored.push(c);
        }
        self.cells.truncate(journal.n_slots);
        self.marks.truncate(journal.n_slots);
        self.free.clone_from(&journal.free);
        journal.restored.retain(|&c| (c as usize) < self.cells.len() && self.cells[c as usize].corners[0] != NONE);
    }
}
