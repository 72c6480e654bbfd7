//! The change record: what the cells were before a change.
//!
//! Between [`begin_record`](Complex::begin_record) and [`end_record`](Complex::end_record) the row of a slot (its
//! corners and its neighbours' facets) is noted before its corners change for the first time. The memory for that is
//! reserved before anything changes. The record has two readers: [`undo_record`](Complex::undo_record), which needs no
//! memory, and what follows the cells, which learns from [`rows`](Complex::rows) which slots hold other cells now.
//!
//! **Gluings are not noted.** A cell that keeps its corners while the one across a facet changes is glued again when
//! that one is put back. Rows are put back in the opposite order: a row that was noted after a neighbour had changed
//! has a gluing to what came in its place, and the neighbour's own row, put back later, mends that.

use super::{Cell, Complex, Corners, Facet};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;

/// Records of more rows than one cell in `KEPT`, and of more than `SMALL` rows, are not kept as scratch memory.
const KEPT: usize = 16;
const SMALL: usize = 1 << 14;

/// What a slot held: the corners of a cell, or none, and its neighbours' facets.
#[derive(Clone, Copy, Debug)]
pub struct Row<C: Corners> {
    pub(crate) slot: Slot,
    pub(crate) corners: C,
    neighbours: C::Of<Facet>,
}

impl<C: Corners> Row<C> {
    /// What a slot holds.
    #[inline(always)]
    pub(super) fn of(slot: Slot, cell: &Cell<C>) -> Self {
        Row { slot, corners: cell.corners, neighbours: cell.neighbours }
    }

    /// The cells have other slots now, by their old ones.
    pub(crate) fn renumber_slots(&mut self, index: &[Slot]) {
        self.slot = index[self.slot];
        for facet in self.neighbours.as_mut() {
            *facet = Facet::new(index[facet.cell()], facet.index());
        }
    }

    /// Whether the slot held no cell.
    #[inline(always)]
    pub(crate) fn is_free(&self) -> bool {
        self.corners[0] == SiteId::NONE
    }
}

/// The rows noted since the record was begun.
#[derive(Debug)]
pub(super) struct Record<C: Corners> {
    is_on: bool,
    rows: Vec<Row<C>>,
    /// By slot, a bit for those that have been noted. All are 0 while no record is kept.
    noted: Vec<u64>,
    /// How many slots and ghosts there were when it was begun.
    n_slots: usize,
    n_ghosts: usize,
}

impl<C: Corners> Default for Record<C> {
    fn default() -> Self {
        Record { is_on: false, rows: Vec::new(), noted: Vec::new(), n_slots: 0, n_ghosts: 0 }
    }
}

impl<C: Corners> Record<C> {
    /// Enters a row unless its slot has been noted. There must be room for it.
    #[inline(always)]
    fn enter(&mut self, row: Row<C>) {
        let (word, bit) = (&mut self.noted[row.slot.index() / 64], 1 << (row.slot.index() % 64));
        if *word & bit == 0 {
            *word |= bit;
            debug_assert!(self.rows.len() < self.rows.capacity(), "rows are reserved before a change");
            self.rows.push(row);
        }
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.rows.capacity() * size_of::<Row<C>>() + self.noted.capacity() * 8
    }
}

/// A record that has been set aside.
#[derive(Debug)]
pub(crate) struct KeptRecord<C: Corners> {
    rows: Vec<Row<C>>,
    n_slots: usize,
    n_ghosts: usize,
}

impl<C: Corners> KeptRecord<C> {
    pub(crate) fn memory_bytes(&self) -> usize {
        self.rows.capacity() * size_of::<Row<C>>()
    }
}

impl<C: Corners> Complex<C> {
    /// Ends the record, and sets it aside, so that another one can be begun.
    pub(crate) fn set_record_aside(&mut self) -> KeptRecord<C> {
        let record = &mut self.record;
        record.is_on = false;
        for row in &record.rows {
            record.noted[row.slot.index() / 64] = 0;
        }
        let rows = std::mem::take(&mut record.rows);
        KeptRecord { rows, n_slots: record.n_slots, n_ghosts: record.n_ghosts }
    }

    /// Takes up a record that was set aside, to be undone: since then all has been put back to what it was.
    pub(crate) fn take_record_up(&mut self, kept: KeptRecord<C>) {
        let KeptRecord { rows, n_slots, n_ghosts } = kept;
        self.record = Record { is_on: true, rows, n_slots, n_ghosts, ..std::mem::take(&mut self.record) };
    }

    /// Begins a record of all changes.
    pub(crate) fn begin_record(&mut self) -> Result<()> {
        debug_assert!(!self.record.is_on && self.record.rows.is_empty());
        let n_slots = self.cells.capacity();
        self.cover(n_slots)?;
        self.record.is_on = true;
        self.record.n_slots = self.cells.len();
        self.record.n_ghosts = self.n_ghosts;
        Ok(())
    }

    /// The cells are about to be sorted into `n_slots` slots: a record in which no row has been noted yet begins there.
    pub(super) fn follow_sort(&mut self, capacity: usize, n_slots: usize) -> Result<()> {
        if self.record.is_on {
            self.cover(capacity)?;
            self.record.n_slots = n_slots;
        }
        Ok(())
    }

    /// Has a bit for each of `n_slots` slots.
    pub(super) fn cover(&mut self, n_slots: usize) -> Result<()> {
        let missing = n_slots.div_ceil(64).saturating_sub(self.record.noted.len());
        if missing > 0 {
            memory::reserve_exact(&mut self.record.noted, missing)?;
            self.record.noted.resize(self.record.noted.len() + missing, 0);
        }
        Ok(())
    }

    /// Makes sure that `n` more rows can be noted.
    #[inline(always)]
    pub(crate) fn reserve_rows(&mut self, n: usize) -> Result<()> {
        if !self.record.is_on || self.record.rows.capacity() - self.record.rows.len() >= n {
            return Ok(());
        }
        memory::reserve(&mut self.record.rows, n)
    }

    /// What a slot holds.
    pub(crate) fn row(&self, slot: Slot) -> Row<C> {
        Row::of(slot, self.cell(slot))
    }

    /// Whether a record is kept.
    #[inline(always)]
    pub(crate) fn is_recording(&self) -> bool {
        self.record.is_on
    }

    /// Notes a slot whose corners are about to change. There must be room for its row.
    #[inline(always)]
    pub(super) fn note(&mut self, slot: Slot) {
        if self.record.is_on {
            let row = Row::of(slot, self.cell(slot));
            self.record.enter(row);
        }
    }

    /// Notes cells that are about to be replaced.
    #[inline(always)]
    pub(crate) fn note_all(&mut self, cells: impl ExactSizeIterator<Item = Slot>) -> Result<()> {
        if self.record.is_on {
            self.reserve_rows(cells.len())?;
            cells.for_each(|c| self.note(c));
        }
        Ok(())
    }

    /// Enters rows that were noted elsewhere before the cells were changed, in the order of the changes.
    pub(crate) fn note_rows(&mut self, rows: &[Row<C>]) -> Result<()> {
        if self.record.is_on {
            self.reserve_rows(rows.len())?;
            rows.iter().for_each(|&row| self.record.enter(row));
        }
        Ok(())
    }

    /// The slots whose corners have changed since the record was begun, each once, and what they held then.
    pub(crate) fn rows(&self) -> &[Row<C>] {
        &self.record.rows
    }

    /// Puts back all that has changed since the record was begun.
    pub(crate) fn undo_record(&mut self) {
        let rows = std::mem::take(&mut self.record.rows);
        for &row in rows.iter().rev() {
            self.put_back(row);
        }
        let n_slots = self.record.n_slots;
        self.free.remove_all(Slot::range(n_slots..self.cells.len()));
        self.cells.truncate(n_slots);
        self.marks.truncate(n_slots);
        self.n_ghosts = self.record.n_ghosts;
        self.record.rows = rows;
    }

    /// Puts back the row of a slot, with both sides of its gluings.
    pub(super) fn put_back(&mut self, row: Row<C>) {
        self.set_mark(row.slot, 0);
        self.free.set(row.slot, row.is_free());
        let cell = self.cell_mut(row.slot);
        cell.corners = row.corners;
        cell.neighbours = row.neighbours;
        if row.is_free() {
            return;
        }
        for i in 0..C::N {
            let out = row.neighbours[i];
            self.cell_mut(out.cell()).neighbours[out.index()] = Facet::new(row.slot, i);
        }
    }

    /// Ends the record and forgets it.
    pub(crate) fn end_record(&mut self) {
        let record = &mut self.record;
        record.is_on = false;
        for row in &record.rows {
            record.noted[row.slot.index() / 64] = 0;
        }
        if record.rows.capacity() > SMALL.max(self.cells.len() / KEPT) {
            record.rows = Vec::new();
        }
        record.rows.clear();
    }
}
