//! Other cells in the place of some: the flip of a whole cavity.

use super::{Cell, Complex, Corners, Facet, INFINITE, Row};
use crate::error::Result;
use crate::ids::Slot;
use crate::machine::memory;

/// A cell that is going to be made, with others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NewCell<C: Corners> {
    pub(crate) corners: C,
    /// What lies opposite each corner.
    pub(crate) neighbours: C::Of<Facet>,
    /// Bit `i` is set where that is a facet of another new cell, whose slot is its position among these.
    pub(crate) inner: u8,
}

impl<C: Corners> Complex<C> {
    /// Replaces cells by others with the same boundary, for which there are `slots` in all, the old ones first
    /// and then free ones as [`prepare_replacing`](Self::prepare_replacing) has chosen them; enters the rows before.
    pub(crate) fn replace(
        &mut self,
        n_old: usize,
        new: &[NewCell<C>],
        slots: &[Slot],
        journal: &mut Vec<Row<C>>,
    ) {
        journal.extend(slots.iter().map(|&slot| Row::of(slot, self.cell(slot))));
        self.n_ghosts -= slots[..n_old].iter().filter(|&&slot| self.cell(slot).is_ghost()).count();
        self.n_ghosts += new.iter().filter(|cell| cell.corners[C::N - 1] == INFINITE).count();
        for (&slot, cell) in slots.iter().zip(new) {
            let mut neighbours = cell.neighbours;
            for (i, out) in neighbours.as_mut().iter_mut().enumerate() {
                if cell.inner >> i & 1 == 1 {
                    *out = Facet::new(slots[out.cell().index()], out.index());
                } else {
                    self.cell_mut(out.cell()).neighbours[out.index()] = Facet::new(slot, i);
                }
            }
            *self.cell_mut(slot) = Cell { alignment: [], corners: cell.corners, neighbours };
        }
        for &slot in &slots[new.len().min(n_old)..n_old] {
            *self.cell_mut(slot) = Cell::free();
            self.free.put(slot);
        }
    }

    /// Adds free slots to those of the old cells, so that there are `n_new`, and makes sure that the rows can be
    /// entered. Nothing else changes before [`replace`](Self::replace).
    pub(crate) fn prepare_replacing(
        &mut self,
        n_new: usize,
        slots: &mut Vec<Slot>,
        journal: &mut Vec<Row<C>>,
    ) -> Result<()> {
        let missing = n_new.saturating_sub(slots.len());
        memory::reserve(slots, missing)?;
        memory::reserve(journal, slots.len() + missing)?;
        if self.free.len() < missing {
            self.create_free(missing)?;
        }
        let near = slots[0];
        slots.extend(std::iter::from_fn(|| self.free.take_near(near)).take(missing));
        Ok(())
    }
}
