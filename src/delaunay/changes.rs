//! A record of the cells that change, for the layers above.

use super::{Delaunay, Geometry};
use crate::error::Result;
use crate::ids::Slot;
use crate::machine::memory;

/// Lists of more than one cell in this number are put in storage order, unless all cells are near the processor anyway.
const SLOTS_PER_CELL_LISTED: usize = 32;
const MAX_SLOTS_IN_CACHE: usize = 1 << 14;

impl<G: Geometry> Delaunay<G> {
    /// Starts a record of the cells that relocations, insertions and removals make or move, in `buffer`.
    pub fn record_changes(&mut self, mut buffer: Vec<Slot>) {
        buffer.clear();
        self.changed = Some(buffer);
    }

    /// Ends the record and returns it: cells, some of them more than once, some free again by now. `None` if
    /// all cells are new since it was started, or it was not.
    pub fn take_changes(&mut self) -> Option<Vec<Slot>> {
        self.changed.take()
    }

    /// Reduces a record to its live cells, each once.
    pub(crate) fn tidy_changes(&mut self, changed: &mut Vec<Slot>) {
        let complex = &mut self.complex;
        changed.retain(|&c| {
            let is_first = complex.is_live(c) && complex.mark(c) == 0;
            if is_first {
                complex.set_mark(c, 1);
            }
            is_first
        });
        if complex.n_slots() > MAX_SLOTS_IN_CACHE && changed.len() * SLOTS_PER_CELL_LISTED > complex.n_slots()
        {
            changed.clear();
            changed.extend(Slot::range(0..complex.n_slots()).filter(|&c| complex.mark(c) != 0));
        }
        for &c in changed.iter() {
            complex.set_mark(c, 0);
        }
    }

    /// Makes room for `n` more cells in the record, if there is one.
    #[inline(always)]
    pub(crate) fn reserve_record(&mut self, n: usize) -> Result<()> {
        match &mut self.changed {
            Some(changed) => memory::reserve(changed, n),
            None => Ok(()),
        }
    }

    /// Enters cells into the record, if there is one; there must be [room](Self::reserve_record) for them.
    #[inline(always)]
    pub(crate) fn record(&mut self, cells: impl IntoIterator<Item = Slot>) {
        if let Some(changed) = &mut self.changed {
            changed.extend(cells);
        }
    }

    /// Enters cells into the record, if there is one, and makes the room for them.
    pub(crate) fn record_all(&mut self, cells: &[Slot]) -> Result<()> {
        if let Some(changed) = &mut self.changed {
            memory::reserve(changed, cells.len())?;
            changed.extend_from_slice(cells);
        }
        Ok(())
    }
}
