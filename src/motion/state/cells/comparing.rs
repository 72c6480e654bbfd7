//! Which cells are in their slots as before, which have gone, and which are in another slot.

use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::{CellId, Slot};
use crate::machine::memory;
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::motion::state::cells::{Cells, FoundCell, NO_CELL, RefreshLists, ids_of, is_finite};
use crate::motion::state::matching::{Matcher, are_same};
use crate::motion::state::ordering::Ordering;

/// Rows that are compared first when any may have changed: where most of these are gone from their slots, so are most
/// of the others.
const SAMPLE: usize = 512;

/// Slots that are compared at a time when any may have changed.
const BLOCK: usize = 256;

impl<G: Moving> Cells<G> {
    /// Lists what is lost and found in these slots.
    pub(super) fn compare_slots(
        &mut self,
        kernel: &Delaunay<G>,
        dirty: &[Slot],
        scratch: &mut RefreshLists<G::Vertices>,
    ) -> Result<()> {
        memory::reserve(&mut scratch.lost, dirty.len())?;
        memory::reserve(&mut scratch.found, dirty.len())?;
        for (k, &slot) in dirty.iter().enumerate() {
            if let Some(&next) = dirty.get(k + AHEAD) {
                prefetch(kernel.complex().cells(), next.index());
                prefetch(&self.index_of, next.index());
            }
            if let Some(&next) = dirty.get(k + AHEAD / 2) {
                prefetch(&self.corners, self.index_in(next).index());
            }
            let index = self.index_in(slot);
            if !is_finite(kernel, slot) {
                if index != NO_CELL {
                    scratch.lost.push(index);
                }
                continue;
            }
            let ids = ids_of(kernel, slot);
            if index != NO_CELL {
                if self.is_still(index, slot, &ids, &mut scratch.turned)? {
                    continue;
                }
                scratch.lost.push(index);
            }
            scratch.found.push(FoundCell { slot, index: NO_CELL, ids });
        }
        Ok(())
    }

    /// The index of a slot's cell, as far as is known.
    #[inline(always)]
    pub(super) fn index_in(&self, slot: Slot) -> CellId {
        self.index_of.get(slot.index()).copied().unwrap_or(NO_CELL)
    }

    /// Whether a slot still holds the finite cell of an index; lists it if it has been turned over.
    #[inline(always)]
    fn is_still(
        &mut self,
        index: CellId,
        slot: Slot,
        ids: &G::Vertices,
        turned: &mut Vec<Slot>,
    ) -> Result<bool> {
        let row = &self.corners[index];
        if row != ids && !are_same(row, ids) {
            return Ok(false);
        }
        let row = *row;
        self.order(index, slot, ids, &row, turned)?;
        Ok(true)
    }

    /// Notes how a row lists the corners of a slot, and the slot if the cell has been turned over.
    #[inline(always)]
    fn order(
        &mut self,
        index: CellId,
        slot: Slot,
        ids: &G::Vertices,
        row: &G::Vertices,
        turned: &mut Vec<Slot>,
    ) -> Result<()> {
        let ordering = Ordering::of(ids, row);
        if ordering != Ordering::SAME && ordering.is_odd() {
            memory::push(turned, slot)?;
        }
        self.orderings[index] = ordering;
        Ok(())
    }

    /// Lists what is lost and found in all slots; makes `index_of` from `slots`.
    pub(super) fn compare_all(
        &mut self,
        kernel: &Delaunay<G>,
        scratch: &mut RefreshLists<G::Vertices>,
    ) -> Result<()> {
        let n_slots = kernel.complex().n_slots();
        self.index_of.clear();
        memory::reserve(&mut self.index_of, n_slots)?;
        self.index_of.resize(n_slots, NO_CELL);
        memory::reserve(&mut scratch.lost, self.corners.len())?;
        for (&slot, index) in self.slots.iter().zip(CellId::range(0..self.slots.len())) {
            match self.index_of.get_mut(slot.index()) {
                Some(there) if *there == NO_CELL => *there = index,
                _ => scratch.lost.push(index),
            }
        }
        let (mut n_compared, mut goes_on) = (0, true);
        for slot in Slot::range(0..n_slots) {
            prefetch(&self.corners, self.index_in(Slot::at(slot.index() + AHEAD)).index());
            let index = self.index_of[slot];
            if index == NO_CELL {
                continue;
            }
            n_compared += 1;
            goes_on &= n_compared != SAMPLE || 2 * scratch.lost.len() <= SAMPLE;
            let is_there = goes_on && is_finite(kernel, slot);
            if !(is_there && self.is_still(index, slot, &ids_of(kernel, slot), &mut scratch.turned)?) {
                self.index_of[slot] = NO_CELL;
                scratch.lost.push(index);
            }
        }
        if kernel.complex().n_finite() + scratch.lost.len() == self.corners.len() {
            return Ok(());
        }
        let RefreshLists { lost, found, matcher, turned, .. } = scratch;
        matcher.list(&self.corners, lost)?;
        let mut slots = kernel.complex().finite();
        loop {
            // What is new stays listed.
            let n_new = found.len();
            memory::reserve(found, BLOCK)?;
            let unknown = slots.by_ref().filter(|&slot| self.index_of[slot] == NO_CELL);
            found.extend(unknown.take(BLOCK).map(|slot| FoundCell {
                slot,
                index: NO_CELL,
                ids: ids_of(kernel, slot),
            }));
            if found.len() == n_new {
                return Ok(());
            }
            self.find_lost(matcher, &mut found[n_new..], turned)?;
            let mut end = n_new;
            for k in n_new..found.len() {
                let FoundCell { slot, index, .. } = found[k];
                if index == NO_CELL {
                    found.swap(k, end);
                    end += 1;
                } else {
                    (self.slots[index], self.index_of[slot]) = (slot, index);
                }
            }
            found.truncate(end);
        }
    }

    /// Finds lost cells in other slots.
    pub(super) fn find_lost(
        &mut self,
        matcher: &Matcher<G::Vertices>,
        found: &mut [FoundCell<G::Vertices>],
        turned: &mut Vec<Slot>,
    ) -> Result<()> {
        for k in 0..found.len() {
            if let Some(next) = found.get(k + AHEAD) {
                matcher.prefetch_place(&next.ids);
            }
            if let Some(next) = found.get(k + AHEAD / 2) {
                matcher.prefetch_entries(&next.ids);
            }
            let FoundCell { slot, ids, .. } = found[k];
            if let Some((index, row)) = matcher.find(&ids) {
                self.order(index, slot, &ids, &row, turned)?;
                self.is_settled.insert(index);
                found[k].index = index;
            }
        }
        Ok(())
    }
}
