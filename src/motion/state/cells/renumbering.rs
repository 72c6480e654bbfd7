//! Gives every cell its index after a change: those found again theirs; new ones that of the cell which was in their
//! slot, a hole, or one at the end. What is left of the holes is filled from the end.
//!
//! Nothing here can fail: [`reserve`](Cells::reserve) has made room.

use crate::complex::Corners;
use crate::delaunay::{Delaunay, Moving};
use crate::ids::{CellId, Slot};
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::motion::state::cells::{Cells, FoundCell, NO_CELL, RefreshLists, ids_of};
use crate::motion::state::changes::Tracker;
use crate::motion::state::ordering::Ordering;

impl<G: Moving> Cells<G> {
    /// Gives every cell its index. What is listed as lost has been used up afterwards, and cells that have other
    /// indices than before are listed as moved.
    pub(super) fn renumber(&mut self, kernel: &Delaunay<G>, scratch: &mut RefreshLists<G::Vertices>) {
        let n = kernel.complex().n_finite();
        self.index_of.resize(kernel.complex().n_slots(), NO_CELL);
        let RefreshLists { lost, found, moved, turned, .. } = scratch;
        self.give_up_slots(found);
        self.enter_in_slots(found, n);
        self.open_holes(lost, n);
        let mut holes = lost.iter().copied();
        self.enter_in_holes(found, &mut holes);
        self.turn(kernel, turned);
        self.fill_holes(n, &mut holes, moved);
        self.corners.truncate(n);
        self.neighbours.truncate(n);
        self.slots.truncate(n);
        self.tell(|tracker| tracker.truncate(n));
    }

    /// Tells the tracker of changes, if there is one.
    #[inline(always)]
    fn tell(&mut self, event: impl FnOnce(&mut Tracker<G::Vertices>)) {
        if let Some(tracker) = &mut self.since_taken {
            event(tracker);
        }
    }

    /// A slot no longer holds the cell of this index, unless it holds another one already.
    #[inline(always)]
    fn give_up_slot(&mut self, index: CellId) {
        let slot = self.slots[index];
        if self.index_of.get(slot.index()) == Some(&index) {
            self.index_of[slot] = NO_CELL;
        }
    }

    /// Slots give up the cells that have been found in others, before these enter them.
    fn give_up_slots(&mut self, found: &[FoundCell<G::Vertices>]) {
        for found in found.iter().filter(|found| found.index != NO_CELL) {
            self.give_up_slot(found.index);
        }
    }

    /// Enters the cells found again in their slots, and new ones in the place of the cell before in theirs, of `n`
    /// cells.
    fn enter_in_slots(&mut self, found: &[FoundCell<G::Vertices>], n: usize) {
        for (k, &FoundCell { slot, index, ids }) in found.iter().enumerate() {
            if let Some(next) = found.get(k + 2 * AHEAD) {
                prefetch(&self.index_of, next.slot.index());
            }
            if let Some(next) = found.get(k + AHEAD) {
                let later = self.index_of[next.slot].index();
                prefetch(&self.corners, later);
                prefetch(&self.orderings, later);
                self.tell(|tracker| tracker.prefetch(later));
            }
            if index != NO_CELL {
                (self.slots[index], self.index_of[slot]) = (slot, index);
                continue;
            }
            let index = self.index_of[slot];
            if index.index() < n {
                self.is_settled.insert(index);
                self.orderings[index] = Ordering::SAME;
                let row = std::mem::replace(&mut self.corners[index], ids);
                self.tell(|tracker| tracker.replace(index, row));
            }
        }
    }

    /// Keeps the holes of the lost indices, those that no cell has taken; those among the first `n` come first.
    fn open_holes(&mut self, lost: &mut Vec<CellId>, n: usize) {
        lost.retain(|&index| !self.is_settled.remove(index));
        for &index in lost.iter() {
            self.give_up_slot(index);
            self.slots[index] = Slot::NONE;
            let row = self.corners[index];
            self.tell(|tracker| tracker.remove(index, row));
        }
        // Holes beyond the end go with it.
        let mut n_low = 0;
        for k in 0..lost.len() {
            if lost[k].index() < n {
                lost.swap(k, n_low);
                n_low += 1;
            }
        }
    }

    /// Enters the new cells that have no index yet in holes, then at the end.
    fn enter_in_holes(&mut self, found: &[FoundCell<G::Vertices>], holes: &mut impl Iterator<Item = CellId>) {
        for &FoundCell { slot, ids, .. } in found {
            if self.index_of[slot] != NO_CELL {
                continue;
            }
            let index = holes.next().unwrap_or(CellId::at(self.corners.len()));
            if index.index() == self.corners.len() {
                self.corners.push(ids);
                self.neighbours.push(G::Neighbours::filled(NO_CELL));
                self.slots.push(slot);
            } else {
                self.corners[index] = ids;
            }
            self.orderings[index] = Ordering::SAME;
            self.tell(|tracker| tracker.create(index));
            self.slots[index] = slot;
            self.index_of[slot] = index;
        }
    }

    /// Turns cells over, listed by their slots.
    fn turn(&mut self, kernel: &Delaunay<G>, turned: &[Slot]) {
        for &slot in turned {
            let index = self.index_of[slot];
            let row = std::mem::replace(&mut self.corners[index], ids_of(kernel, slot));
            self.orderings[index] = Ordering::SAME;
            self.tell(|tracker| tracker.turn(index, row));
        }
    }

    /// Moves the cells beyond the first `n` into the holes that are left, and lists their slots.
    fn fill_holes(&mut self, n: usize, holes: &mut impl Iterator<Item = CellId>, moved: &mut Vec<Slot>) {
        for from in CellId::range(n..self.corners.len()).rev() {
            let slot = self.slots[from];
            if slot == Slot::NONE {
                continue;
            }
            let to = holes.next().expect("as many holes as cells beyond the end");
            self.corners[to] = self.corners[from];
            self.neighbours[to] = self.neighbours[from];
            self.slots[to] = slot;
            self.orderings[to] = self.orderings[from];
            self.index_of[slot] = to;
            moved.push(slot);
            self.tell(|tracker| tracker.renumber(from, to));
        }
    }
}
