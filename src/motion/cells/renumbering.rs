//! Gives every cell its index after a change: those found again theirs; new ones that of the cell which was in their
//! slot, a hole, or one at the end. What is left of the holes is filled from the end.
//!
//! Nothing here can fail: [`reserve`](Cells::reserve) has made room.

use super::{Cells, Found, NO_CELL, Scratch, ids_of};
use crate::complex::NONE;
use crate::delaunay::{Delaunay, Dimension};
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::motion::changes::Tracker;
use crate::motion::ordering::Ordering;

impl<G: Dimension> Cells<G> {
    /// Gives every cell its index. What is listed as lost has been used up afterwards, and cells that have other indices
    /// than before are listed as moved.
    pub(super) fn renumber(&mut self, kernel: &Delaunay<G>, scratch: &mut Scratch<G::Corners>) {
        let n = kernel.complex().n_finite();
        self.index_of.resize(kernel.complex().n_slots(), NO_CELL);
        let Scratch { lost, found, moved, turned, .. } = scratch;
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

    /// Tells all who track changes.
    #[inline(always)]
    fn tell(&mut self, event: impl Fn(&mut Tracker<G::Corners>)) {
        [&mut self.since_taken, &mut self.since_commit].into_iter().flatten().for_each(event);
    }

    /// A slot no longer holds the cell of this index, unless it holds another one already.
    #[inline(always)]
    fn give_up_slot(&mut self, index: u32) {
        let slot = self.slots[index as usize] as usize;
        if self.index_of.get(slot) == Some(&index) {
            self.index_of[slot] = NO_CELL;
        }
    }

    /// Slots give up the cells that have been found in others, before these enter them.
    fn give_up_slots(&mut self, found: &[Found<G::Corners>]) {
        for found in found.iter().filter(|found| found.index != NO_CELL) {
            self.give_up_slot(found.index);
        }
    }

    /// Enters the cells found again in their slots, and new ones in the place of the cell before in theirs, of `n` cells.
    fn enter_in_slots(&mut self, found: &[Found<G::Corners>], n: usize) {
        for (k, &Found { slot, index, ids }) in found.iter().enumerate() {
            if let Some(next) = found.get(k + 2 * AHEAD) {
                prefetch(&self.index_of, next.slot as usize);
            }
            if let Some(next) = found.get(k + AHEAD) {
                let later = self.index_of[next.slot as usize] as usize;
                prefetch(&self.corners, later);
                prefetch(&self.orderings, later);
                self.tell(|tracker| tracker.prefetch(later));
            }
            if index != NO_CELL {
                (self.slots[index as usize], self.index_of[slot as usize]) = (slot, index);
                continue;
            }
            let index = self.index_of[slot as usize];
            if (index as usize) < n {
                self.is_settled.insert(index);
                self.orderings[index as usize] = Ordering::SAME;
                let row = std::mem::replace(&mut self.corners[index as usize], ids);
                self.tell(|tracker| tracker.replace(index, row));
            }
        }
    }

    /// Of the lost indices keeps the holes, those that no cell has taken; those among the first `n` come first.
    fn open_holes(&mut self, lost: &mut Vec<u32>, n: usize) {
        lost.retain(|&index| !self.is_settled.remove(index));
        for &index in lost.iter() {
            self.give_up_slot(index);
            self.slots[index as usize] = NONE;
            let row = self.corners[index as usize];
            self.tell(|tracker| tracker.remove(index, row));
        }
        // Holes beyond the end go with it.
        let mut n_low = 0;
        for k in 0..lost.len() {
            if (lost[k] as usize) < n {
                lost.swap(k, n_low);
                n_low += 1;
            }
        }
    }

    /// Enters the new cells that have no index yet in holes, then at the end.
    fn enter_in_holes(&mut self, found: &[Found<G::Corners>], holes: &mut impl Iterator<Item = u32>) {
        for &Found { slot, ids, .. } in found {
            if self.index_of[slot as usize] != NO_CELL {
                continue;
            }
            let index = holes.next().unwrap_or(self.corners.len() as u32);
            if index as usize == self.corners.len() {
                self.corners.push(ids);
                self.neighbours.push(ids);
                self.slots.push(slot);
            } else {
                self.corners[index as usize] = ids;
            }
            self.orderings[index as usize] = Ordering::SAME;
            self.tell(|tracker| tracker.create(index));
            self.slots[index as usize] = slot;
            self.index_of[slot as usize] = index;
        }
    }

    /// Turns cells over, listed by their slots.
    fn turn(&mut self, kernel: &Delaunay<G>, turned: &[u32]) {
        for &slot in turned {
            let index = self.index_of[slot as usize];
            let row = std::mem::replace(&mut self.corners[index as usize], ids_of(kernel, slot));
            self.orderings[index as usize] = Ordering::SAME;
            self.tell(|tracker| tracker.turn(index, row));
        }
    }

    /// Moves the cells beyond the first `n` into the holes that are left, and lists their slots.
    fn fill_holes(&mut self, n: usize, holes: &mut impl Iterator<Item = u32>, moved: &mut Vec<u32>) {
        for from in (n..self.corners.len()).rev() {
            let slot = self.slots[from];
            if slot == NONE {
                continue;
            }
            let to = holes.next().expect("as many holes as cells beyond the end");
            self.corners[to as usize] = self.corners[from];
            self.neighbours[to as usize] = self.neighbours[from];
            self.slots[to as usize] = slot;
            self.orderings[to as usize] = self.orderings[from];
            self.index_of[slot as usize] = to;
            moved.push(slot);
            self.tell(|tracker| tracker.renumber(from as u32, to));
        }
    }
}
