//! What the arrays were before they were brought up to date, where that may have to be undone.
//!
//! Rows are noted before they are written to: where the changed slots are listed, those of their cells and of the cells
//! next to these; otherwise all are copied once, as all are compared. Undoing needs no memory: no array gives back room
//! while there is a journal.

use crate::complex::Corners;
use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::{CellId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::state::cells::{Cells, NO_CELL};
use crate::motion::state::changes::{Lengths, Tracker};
use crate::motion::state::marks::Marks;
use crate::motion::state::ordering::Ordering;

/// What was known of an index.
#[derive(Debug)]
struct RowBefore<G: Moving> {
    index: CellId,
    corners: G::Vertices,
    neighbours: G::Neighbours,
    slot: Slot,
    ordering: Ordering,
    /// Its origin in the list of changes.
    origin: CellId,
}

/// The lengths of arrays before they were brought up to date, and of the lists of the journal.
#[derive(Debug)]
struct Refreshed {
    n_cells: usize,
    n_orderings: usize,
    n_slots: usize,
    tracked: Option<Lengths>,
    n_rows: usize,
    n_sides: usize,
    n_in_slots: usize,
}

/// What has been noted since the journal was begun.
#[derive(Debug)]
pub(in crate::motion) struct CellJournal<G: Moving> {
    refreshed: Vec<Refreshed>,
    rows: Vec<RowBefore<G>>,
    /// Neighbours of cells next to those that have changed.
    sides: Vec<(CellId, G::Neighbours)>,
    /// The indices that slots had.
    in_slots: Vec<(Slot, CellId)>,
    /// All that there was after the above; nothing else is noted from then on.
    whole: Option<Box<Cells<G>>>,
}

impl<G: Moving> Default for CellJournal<G> {
    fn default() -> Self {
        CellJournal {
            refreshed: Vec::new(),
            rows: Vec::new(),
            sides: Vec::new(),
            in_slots: Vec::new(),
            whole: None,
        }
    }
}

impl<G: Moving> CellJournal<G> {
    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.refreshed)
            + memory::bytes_of(&self.rows)
            + memory::bytes_of(&self.sides)
            + memory::bytes_of(&self.in_slots)
            + memory::bytes_of_made(&self.whole, Cells::memory_bytes)
    }
}

impl<G: Moving> Cells<G> {
    /// From now on what brings the arrays up to date can be undone.
    pub(in crate::motion) fn keep_journal(&mut self) -> Result<()> {
        memory::made(&mut self.journal).map(drop)
    }

    /// Nothing is undone any more.
    pub(in crate::motion) fn end_journal(&mut self) {
        self.journal = None;
    }

    /// Notes what bringing the arrays up to date is going to change, but for the sides of cells next to those that have
    /// changed.
    pub(super) fn note_before(&mut self, kernel: &Delaunay<G>, dirty: Option<&Marks<Slot>>) -> Result<()> {
        let mut journal = memory::take_made(&mut self.journal)?;
        let noted = match dirty {
            _ if journal.whole.is_some() => Ok(()),
            Some(dirty) if !self.corners.is_empty() => self.note_rows(&mut journal, kernel, dirty),
            _ => self.copied().and_then(memory::boxed).map(|mut cells| {
                // What is kept has the room that it had.
                std::mem::swap(self, &mut cells);
                journal.whole = Some(cells);
            }),
        };
        self.journal = Some(journal);
        noted
    }

    /// Notes what is in the dirty slots, and what will be beyond the end.
    fn note_rows(
        &self,
        journal: &mut CellJournal<G>,
        kernel: &Delaunay<G>,
        dirty: &Marks<Slot>,
    ) -> Result<()> {
        let (n_cells, n_slots) = (self.corners.len(), self.index_of.len());
        let beyond = CellId::range(kernel.complex().n_finite().min(n_cells)..n_cells);
        let slots_beyond = Slot::range(kernel.complex().n_slots().min(n_slots)..n_slots);
        let n = dirty.as_slice().len() + beyond.len();
        memory::reserve(&mut journal.refreshed, 1)?;
        memory::reserve(&mut journal.rows, n)?;
        memory::reserve(&mut journal.in_slots, n + slots_beyond.len())?;
        journal.refreshed.push(Refreshed {
            n_cells,
            n_orderings: self.orderings.len(),
            n_slots,
            tracked: self.since_taken.as_ref().map(Tracker::lengths),
            n_rows: journal.rows.len(),
            n_sides: journal.sides.len(),
            n_in_slots: journal.in_slots.len(),
        });
        for &slot in dirty.as_slice() {
            if let Some(&index) = self.index_of.get(slot.index()) {
                journal.in_slots.push((slot, index));
                if index != NO_CELL {
                    journal.rows.push(self.row_before(index));
                }
            }
        }
        for index in beyond {
            let row = self.row_before(index);
            if let Some(&there) = self.index_of.get(row.slot.index()) {
                journal.in_slots.push((row.slot, there));
            }
            journal.rows.push(row);
        }
        slots_beyond.for_each(|slot| journal.in_slots.push((slot, self.index_of[slot])));
        Ok(())
    }

    fn row_before(&self, index: CellId) -> RowBefore<G> {
        RowBefore {
            index,
            corners: self.corners[index],
            neighbours: self.neighbours[index],
            slot: self.slots[index],
            ordering: self.orderings[index],
            origin: self.since_taken.as_ref().map_or(CellId::NONE, |tracker| tracker.origin(index)),
        }
    }

    /// Makes room for the sides of the cells next to so many.
    pub(super) fn make_room_for_sides(&mut self, n: usize) -> Result<()> {
        let journal = memory::made(&mut self.journal)?;
        if journal.whole.is_some() { Ok(()) } else { memory::reserve(&mut journal.sides, n * G::Corners::N) }
    }

    /// Notes the neighbours of the cells next to the dirty slots, and to those that have `moved`; there is
    /// [room](Self::make_room_for_sides).
    pub(super) fn note_sides(&mut self, kernel: &Delaunay<G>, dirty: &Marks<Slot>, moved: &[Slot]) {
        let Some(journal) = self.journal.as_mut().filter(|journal| journal.whole.is_none()) else { return };
        for &slot in dirty.as_slice().iter().chain(moved) {
            if !kernel.complex().is_live(slot) {
                continue;
            }
            let cell = kernel.complex().cell(slot);
            for i in 0..G::Corners::N {
                let across = cell.neighbour(i).cell();
                let index = self.index_of[across];
                if index != NO_CELL && !dirty.has(across) {
                    journal.sides.push((index, self.neighbours[index]));
                }
            }
        }
    }

    /// Puts the arrays back to what they were when the journal was begun, and ends it. Needs no memory.
    pub(in crate::motion) fn undo_journal(&mut self) {
        let Some(mut journal) = self.journal.take() else { return };
        if let Some(whole) = journal.whole.take() {
            let scratch = std::mem::take(&mut self.scratch);
            *self = Cells { scratch, ..*whole };
        }
        while let Some(refreshed) = journal.refreshed.pop() {
            self.undo_refreshed(&mut journal, &refreshed);
        }
    }

    /// Puts the arrays back to what they were before they were brought up to date last.
    fn undo_refreshed(&mut self, journal: &mut CellJournal<G>, before: &Refreshed) {
        for (index, neighbours) in journal.sides.drain(before.n_sides..).rev() {
            self.neighbours[index] = neighbours;
        }
        self.corners.resize(before.n_cells, G::Vertices::filled(VertexId::NONE));
        self.neighbours.resize(before.n_cells, G::Neighbours::filled(NO_CELL));
        self.slots.resize(before.n_cells, Slot::NONE);
        self.orderings.resize(before.n_orderings, Ordering::SAME);
        self.index_of.resize(before.n_slots, NO_CELL);
        if let (Some(tracker), Some(lengths)) = (&mut self.since_taken, before.tracked) {
            tracker.go_back(lengths);
        }
        for row in journal.rows.drain(before.n_rows..).rev() {
            let index = row.index;
            (self.corners[index], self.neighbours[index]) = (row.corners, row.neighbours);
            (self.slots[index], self.orderings[index]) = (row.slot, row.ordering);
            if let Some(tracker) = &mut self.since_taken {
                tracker.put_back(index, row.origin);
            }
        }
        for (slot, index) in journal.in_slots.drain(before.n_in_slots..).rev() {
            self.index_of[slot] = index;
        }
    }
}
