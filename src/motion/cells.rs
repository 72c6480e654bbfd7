//! The cells as callers see them: by vertex id, finite cells only, in dense arrays that are brought up to date.
//!
//! **Identity.** A cell is its set of vertices. One that is there before and after keeps its index, and the order of its
//! corners unless it has been turned over, whatever has become of its slot: rows of slots that have changed are compared
//! first with what the slot holds now, and what is left on both sides is matched by corners. Only where cells have become
//! fewer, the last ones are *renumbered* to fill the holes.
//!
//! Invariant: `slots` and `index_of` are inverse to each other for all cells that have not changed since.
//!
//! Cost: in proportion to the slots that have changed; when most have, one pass over all. `make bench` times steps, which
//! read the cells and what has changed, beside commits alone.

use super::changes::{Tracker, renumber};
use crate::complex::{Corners, Facet, NONE, memory};
use crate::delaunay::{Delaunay, Dimension};
use crate::error::Result;
use crate::prefetch::{AHEAD, prefetch};

/// Neighbour of a cell across a facet of the convex hull.
pub const NO_CELL: u32 = NONE;

/// When more than one slot in so many has changed all are looked at.
pub(super) const MOST: usize = 2;

/// The arrays behind a view.
#[derive(Debug)]
pub(super) struct Cells<G: Dimension> {
    pub(super) corners: Vec<G::Corners>,
    pub(super) neighbours: Vec<G::Corners>,
    /// By slot of the kernel's complex, the index of its cell in the arrays; [`NO_CELL`] if it has none.
    pub(super) index_of: Vec<u32>,
    /// The slot of each index.
    pub(super) slots: Vec<u32>,
    /// What has changed since the program last took the changes, if it ever did.
    pub(super) since_taken: Option<Tracker<G::Corners>>,
    /// What has changed since the latest commit began, if that is tracked.
    pub(super) since_commit: Option<Tracker<G::Corners>>,
    scratch: Scratch<G::Corners>,
}

/// Slots that have changed.
#[derive(Debug, Default)]
pub(super) struct Dirty {
    /// Each once.
    pub(super) slots: Vec<u32>,
    /// A bit for each; there may be fewer bits than slots.
    pub(super) bits: Vec<u64>,
}

impl Dirty {
    #[inline(always)]
    fn has(&self, slot: u32) -> bool {
        self.bits.get(slot as usize / 64).is_some_and(|word| word >> (slot % 64) & 1 == 1)
    }

    pub(super) fn clear(&mut self) {
        for slot in self.slots.drain(..) {
            self.bits[slot as usize / 64] = 0;
        }
    }
}

/// Lists of a refreshment.
#[derive(Debug)]
struct Scratch<C> {
    /// Indices whose slot no longer holds their cell; [`NO_CELL`] where it was found in another one.
    lost: Vec<u32>,
    /// Slots that hold another finite cell than before, its index if it was found, and its vertices.
    found: Vec<(u32, u32, C)>,
    /// Positions in `lost`, by a hash of the corners.
    table: Vec<u32>,
    /// Slots whose gluings are to be written.
    glued: Vec<u32>,
    /// Slots of cells that have been turned over.
    turned: Vec<u32>,
}

impl<C> Default for Scratch<C> {
    fn default() -> Self {
        Scratch {
            lost: Vec::new(),
            found: Vec::new(),
            table: Vec::new(),
            glued: Vec::new(),
            turned: Vec::new(),
        }
    }
}

impl<G: Dimension> Default for Cells<G> {
    fn default() -> Self {
        Cells {
            corners: Vec::new(),
            neighbours: Vec::new(),
            index_of: Vec::new(),
            slots: Vec::new(),
            since_taken: None,
            since_commit: None,
            scratch: Scratch::default(),
        }
    }
}

/// The vertex ids of a slot's corners.
#[inline(always)]
fn ids_of<G: Dimension>(kernel: &Delaunay<G>, slot: u32) -> G::Corners {
    let mut ids = kernel.complex().cell(slot).corners;
    for i in 0..G::Corners::N {
        ids[i] = kernel.site(ids[i]).id;
    }
    ids
}

/// Whether two cells have the same corners, in any order.
#[inline(always)]
fn are_same<C: Corners>(a: &C, b: &C) -> bool {
    a == b || a.as_ref().iter().all(|x| b.as_ref().contains(x))
}

/// Whether two orders of the same corners have opposite orientations.
fn are_opposite<C: Corners>(a: &C, b: &C) -> bool {
    let (mut a, mut is_odd) = (*a, false);
    for i in 0..C::N {
        if a[i] != b[i] {
            let j = (i + 1..C::N).find(|&j| a[j] == b[i]).expect("the same corners");
            a.as_mut().swap(i, j);
            is_odd = !is_odd;
        }
    }
    is_odd
}

/// A hash that does not depend on the order of the corners.
#[inline(always)]
fn hash<C: Corners>(corners: &C) -> u64 {
    let mixed = |&x: &u32| {
        let x = (u64::from(x) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        (x ^ x >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9)
    };
    corners.as_ref().iter().map(mixed).fold(0, u64::wrapping_add)
}

/// The index of the corner of this id, which is where it is expected as a rule.
#[inline(always)]
pub(super) fn position_of<C: Corners>(row: &C, expected: usize, id: u32) -> usize {
    if row[expected] == id {
        return expected;
    }
    (0..C::N).find(|&i| row[i] == id).expect("a corner of the cell")
}

/// Whether a slot holds a finite cell.
#[inline(always)]
fn is_finite<G: Dimension>(kernel: &Delaunay<G>, slot: u32) -> bool {
    kernel.complex().is_live(slot) && !kernel.complex().cell(slot).is_ghost()
}

impl<G: Dimension> Cells<G> {
    /// Brings the arrays up to date: only the `dirty` slots have changed, or any, if there is no list of them. After an
    /// error they can be brought up to date later.
    pub(super) fn refresh(&mut self, kernel: &Delaunay<G>, dirty: Option<&Dirty>) -> Result<()> {
        let mut scratch = std::mem::take(&mut self.scratch);
        let done = self.refresh_with(kernel, dirty, &mut scratch);
        self.scratch = scratch;
        done
    }

    fn refresh_with(
        &mut self,
        kernel: &Delaunay<G>,
        dirty: Option<&Dirty>,
        scratch: &mut Scratch<G::Corners>,
    ) -> Result<()> {
        scratch.lost.clear();
        scratch.found.clear();
        scratch.glued.clear();
        scratch.turned.clear();
        match dirty {
            Some(dirty) => self.compare_slots(kernel, &dirty.slots, scratch)?,
            None => self.compare_all(kernel, scratch)?,
        }
        self.find_lost(scratch)?;
        self.reserve(kernel, scratch)?;
        self.renumber(kernel, scratch);
        match dirty {
            Some(dirty) => self.glue_slots(kernel, dirty, &scratch.glued),
            None => self.glue_all(kernel),
        }
        // Memory for many changes is not kept.
        if scratch.found.capacity() > self.corners.len() / MOST + 1024 {
            *scratch = Scratch::default();
        }
        Ok(())
    }

    /// Lists what is lost and found in these slots.
    fn compare_slots(
        &self,
        kernel: &Delaunay<G>,
        dirty: &[u32],
        scratch: &mut Scratch<G::Corners>,
    ) -> Result<()> {
        memory::reserve(&mut scratch.lost, dirty.len())?;
        memory::reserve(&mut scratch.found, dirty.len())?;
        for (k, &slot) in dirty.iter().enumerate() {
            if let Some(&next) = dirty.get(k + AHEAD) {
                prefetch(kernel.complex().cells(), next as usize);
                prefetch(&self.index_of, next as usize);
            }
            let index = self.index_of.get(slot as usize).copied().unwrap_or(NO_CELL);
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
            scratch.found.push((slot, NO_CELL, ids));
        }
        Ok(())
    }

    /// Whether a slot still holds the finite cell of an index; lists it if it has been turned over.
    #[inline(always)]
    fn is_still(&self, index: u32, slot: u32, ids: &G::Corners, turned: &mut Vec<u32>) -> Result<bool> {
        let corners = &self.corners[index as usize];
        if corners == ids {
            return Ok(true);
        }
        if !are_same(corners, ids) {
            return Ok(false);
        }
        if are_opposite(corners, ids) {
            memory::push(turned, slot)?;
        }
        Ok(true)
    }

    /// Lists what is lost and found in all slots; makes `index_of` from `slots`.
    fn compare_all(&mut self, kernel: &Delaunay<G>, scratch: &mut Scratch<G::Corners>) -> Result<()> {
        let n_slots = kernel.complex().n_slots();
        self.index_of.clear();
        memory::reserve(&mut self.index_of, n_slots)?;
        self.index_of.resize(n_slots, NO_CELL);
        for (index, (corners, &slot)) in self.corners.iter().zip(&self.slots).enumerate() {
            let ids = if is_finite(kernel, slot) { ids_of(kernel, slot) } else { G::Corners::filled(NONE) };
            if ids == *corners {
                self.index_of[slot as usize] = index as u32;
            } else if are_same(corners, &ids) {
                self.index_of[slot as usize] = index as u32;
                if are_opposite(corners, &ids) {
                    memory::push(&mut scratch.turned, slot)?;
                }
            } else {
                memory::push(&mut scratch.lost, index as u32)?;
            }
        }
        if kernel.complex().n_finite() + scratch.lost.len() == self.corners.len() {
            return Ok(());
        }
        for slot in kernel.complex().finite() {
            if self.index_of[slot as usize] == NO_CELL {
                memory::push(&mut scratch.found, (slot, NO_CELL, ids_of(kernel, slot)))?;
            }
        }
        Ok(())
    }

    /// Finds lost cells in other slots.
    fn find_lost(&self, Scratch { lost, found, table, turned, .. }: &mut Scratch<G::Corners>) -> Result<()> {
        if lost.is_empty() || found.is_empty() {
            return Ok(());
        }
        let bits = (2 * lost.len()).next_power_of_two().trailing_zeros();
        let mask = (1 << bits) - 1;
        table.clear();
        memory::reserve(table, 1 << bits)?;
        table.resize(1 << bits, NONE);
        for (k, &index) in lost.iter().enumerate() {
            if let Some(&next) = lost.get(k + AHEAD) {
                prefetch(&self.corners, next as usize);
            }
            let mut at = hash(&self.corners[index as usize]) as usize >> 7 & mask;
            while table[at] != NONE {
                at = (at + 1) & mask;
            }
            table[at] = k as u32;
        }
        for (slot, index, ids) in found {
            let mut at = hash(ids) as usize >> 7 & mask;
            while table[at] != NONE {
                let old = lost[table[at] as usize];
                if old != NO_CELL && are_same(&self.corners[old as usize], ids) {
                    *index = old;
                    if are_opposite(&self.corners[old as usize], ids) {
                        memory::push(turned, *slot)?;
                    }
                    lost[table[at] as usize] = NO_CELL;
                    break;
                }
                at = (at + 1) & mask;
            }
        }
        Ok(())
    }

    /// Makes room for all that [`renumber`](Self::renumber) writes.
    fn reserve(&mut self, kernel: &Delaunay<G>, scratch: &mut Scratch<G::Corners>) -> Result<()> {
        let n = kernel.complex().n_finite();
        let more = n.saturating_sub(self.corners.len());
        memory::reserve(&mut self.corners, more)?;
        memory::reserve(&mut self.neighbours, more)?;
        memory::reserve(&mut self.slots, more)?;
        let more_slots = kernel.complex().n_slots().saturating_sub(self.index_of.len());
        memory::reserve(&mut self.index_of, more_slots)?;
        let (n_lost, n_found) = (scratch.lost.len(), scratch.found.len());
        memory::reserve(&mut scratch.glued, n_lost)?;
        for tracker in [&mut self.since_taken, &mut self.since_commit].into_iter().flatten() {
            tracker.reserve(n_lost, scratch.turned.len(), n_lost + n_found, n)?;
        }
        Ok(())
    }

    /// Gives every cell its index: those found again theirs, new ones the holes and then the end. What is left of the holes
    /// is filled from the end.
    fn renumber(
        &mut self,
        kernel: &Delaunay<G>,
        Scratch { lost, found, glued, turned, .. }: &mut Scratch<G::Corners>,
    ) {
        let n = kernel.complex().n_finite();
        self.index_of.resize(kernel.complex().n_slots(), NO_CELL);
        let Cells { corners, neighbours, index_of, slots, since_taken, since_commit, .. } = self;
        let mut trackers = [since_taken, since_commit];
        let mut trackers = trackers.iter_mut().filter_map(|tracker| tracker.as_mut());
        let (mut first, mut second) = (trackers.next(), trackers.next());
        let mut tell = |event: &dyn Fn(&mut Tracker<G::Corners>)| {
            first.iter_mut().chain(&mut second).for_each(|tracker| event(tracker));
        };
        // Slots give up what they have lost before others take it.
        let holes = &mut *lost;
        for &(_, index, _) in found.iter().filter(|(_, index, _)| *index != NO_CELL) {
            let slot = slots[index as usize] as usize;
            if index_of.get(slot) == Some(&index) {
                index_of[slot] = NO_CELL;
            }
        }
        holes.retain(|&index| index != NO_CELL);
        for &index in holes.iter() {
            let slot = slots[index as usize] as usize;
            if index_of.get(slot) == Some(&index) {
                index_of[slot] = NO_CELL;
            }
            slots[index as usize] = NONE;
            let row = corners[index as usize];
            tell(&|tracker| tracker.remove(index, row));
        }
        // Those that have to be filled come first: holes beyond the end go with it.
        let mut n_low = 0;
        for k in 0..holes.len() {
            if (holes[k] as usize) < n {
                holes.swap(k, n_low);
                n_low += 1;
            }
        }
        let mut next_hole = holes.iter().copied();
        for &(slot, index, ids) in found.iter() {
            let index = if index == NO_CELL {
                let index = next_hole.next().unwrap_or(corners.len() as u32);
                if index as usize == corners.len() {
                    corners.push(ids);
                    neighbours.push(ids);
                    slots.push(slot);
                } else {
                    corners[index as usize] = ids;
                }
                tell(&|tracker| tracker.create(index));
                index
            } else {
                index
            };
            slots[index as usize] = slot;
            index_of[slot as usize] = index;
        }
        for &slot in turned.iter() {
            let index = index_of[slot as usize];
            let row = std::mem::replace(&mut corners[index as usize], ids_of(kernel, slot));
            tell(&|tracker| tracker.turn(index, row));
        }
        for from in (n..corners.len()).rev() {
            if slots[from] == NONE {
                continue;
            }
            let to = next_hole.next().expect("as many holes as cells beyond the end");
            corners[to as usize] = corners[from];
            neighbours[to as usize] = neighbours[from];
            slots[to as usize] = slots[from];
            index_of[slots[from] as usize] = to;
            glued.push(slots[from]);
            tell(&|tracker| tracker.renumber(from as u32, to));
        }
        corners.truncate(n);
        neighbours.truncate(n);
        slots.truncate(n);
        tell(&|tracker| tracker.truncate(n));
    }

    /// Writes the neighbours of the cells in the dirty slots and in those that have `moved`, and their neighbours' sides.
    fn glue_slots(&mut self, kernel: &Delaunay<G>, dirty: &Dirty, moved: &[u32]) {
        let complex = kernel.complex();
        for (k, &slot) in dirty.slots.iter().chain(moved).enumerate() {
            if let Some(&next) = dirty.slots.get(k + AHEAD) {
                complex.prefetch_neighbours(next.min(complex.n_slots() as u32 - 1));
            }
            if !complex.is_live(slot) {
                continue;
            }
            let cell = complex.cell(slot);
            if cell.is_ghost() {
                let behind = cell.neighbour(G::D);
                if !dirty.has(behind.cell()) {
                    let mut facet = ids_of(kernel, slot);
                    facet[G::D] = NONE;
                    self.set_neighbour(behind, &facet, NO_CELL);
                }
                continue;
            }
            let index = self.index_of[slot as usize];
            let (ids, mut across) = (ids_of(kernel, slot), cell.corners);
            for i in 0..G::Corners::N {
                let out = cell.neighbour(i);
                across[i] = self.index_of[out.cell() as usize];
                if across[i] != NO_CELL && !dirty.has(out.cell()) {
                    self.set_neighbour(out, &ids, index);
                }
            }
            self.set_row(index as usize, &ids, across);
        }
    }

    /// Enters what is beyond the facet of a finite cell that it shares with one of these vertices.
    #[inline(always)]
    fn set_neighbour(&mut self, facet: Facet, beyond: &G::Corners, neighbour: u32) {
        let index = self.index_of[facet.cell() as usize] as usize;
        let row = &self.corners[index];
        let is_apex = |i: usize| !beyond.as_ref().contains(&row[i]);
        let at = if is_apex(facet.index()) {
            facet.index()
        } else {
            (0..G::Corners::N).find(|&i| is_apex(i)).expect("one corner is not of the facet")
        };
        self.neighbours[index][at] = neighbour;
    }

    /// Enters what is opposite the vertices of a cell.
    #[inline(always)]
    fn set_row(&mut self, index: usize, ids: &G::Corners, across: G::Corners) {
        let (corners, row) = (&self.corners[index], &mut self.neighbours[index]);
        if corners == ids {
            *row = across;
            return;
        }
        for i in 0..G::Corners::N {
            row[position_of(corners, i, ids[i])] = across[i];
        }
    }

    /// Writes the neighbours of all cells.
    fn glue_all(&mut self, kernel: &Delaunay<G>) {
        for index in 0..self.slots.len() {
            let slot = self.slots[index];
            let cell = kernel.complex().cell(slot);
            let mut across = cell.corners;
            for i in 0..G::Corners::N {
                across[i] = self.index_of[cell.neighbour(i).cell() as usize];
            }
            self.set_row(index, &ids_of(kernel, slot), across);
        }
    }

    /// The index, in the complex, of a corner of a cell.
    pub(super) fn facet(&self, kernel: &Delaunay<G>, index: u32, corner: usize) -> Facet {
        let slot = self.slots[index as usize];
        let ids = ids_of(kernel, slot);
        Facet::new(slot, position_of(&ids, corner, self.corners[index as usize][corner]))
    }

    /// A copy of arrays that are up to date, in which vertices have other ids and cells other slots, `n_slots` in all:
    /// those listed by the old ones. Every cell keeps its index.
    pub(super) fn renumbered(&self, ids: &[u32], slots: &[u32], n_slots: usize) -> Result<Self> {
        let mut cells = Cells {
            corners: memory::copy_of(&self.corners)?,
            neighbours: memory::copy_of(&self.neighbours)?,
            slots: memory::copy_of(&self.slots)?,
            since_taken: self.since_taken.as_ref().map(|tracker| tracker.renumbered(ids)).transpose()?,
            since_commit: self.since_commit.as_ref().map(|tracker| tracker.renumbered(ids)).transpose()?,
            ..Cells::default()
        };
        memory::reserve_exact(&mut cells.index_of, n_slots)?;
        cells.index_of.resize(n_slots, NO_CELL);
        cells.corners.iter_mut().for_each(|row| renumber(row, ids));
        for (index, slot) in cells.slots.iter_mut().enumerate() {
            *slot = slots[*slot as usize];
            cells.index_of[*slot as usize] = index as u32;
        }
        Ok(cells)
    }

    pub(super) fn memory_bytes(&self) -> usize {
        let trackers = [&self.since_taken, &self.since_commit].into_iter().flatten();
        (self.corners.capacity() + self.neighbours.capacity()) * size_of::<G::Corners>()
            + (self.index_of.capacity() + self.slots.capacity()) * 4
            + (self.scratch.lost.capacity() + self.scratch.table.capacity() + self.scratch.glued.capacity())
                * 4
            + self.scratch.turned.capacity() * 4
            + self.scratch.found.capacity() * size_of::<(u32, u32, G::Corners)>()
            + trackers.map(Tracker::memory_bytes).sum::<usize>()
    }
}
