//! The cells as callers see them: by vertex id, finite cells only, in dense arrays that are brought up to date.
//!
//! **Identity.** A cell is its set of vertices. One that is there before and after keeps its index, and the order of
//! its corners unless it has been turned over, whatever has become of its slot: rows of slots that have changed are
//! compared first with what the slot holds now, and what is left on both sides is matched by corners. Only where
//! cells have become fewer, the last ones are *renumbered* to fill the holes.
//!
//! Invariants: `slots` and `index_of` are inverse to each other for all cells that have not changed since. The order of
//! the corners in a row, beside that in its slot, is in `orderings`.
//!
//! Cost: in proportion to the slots that have changed; when most have, one pass over all. `make bench` times steps,
//! which read the cells and what has changed, beside commits alone.

mod comparing;
mod gluing;

use super::changes::{Taken, Tracker, renumber};
use super::constants::reading;
use super::marks::{Bits, Marks};
use super::matching::Matcher;
use super::ordering::Ordering;
use crate::complex::{Corners, Facet, NONE};
use crate::delaunay::{Delaunay, Dimension};
use crate::error::Result;
use crate::machine::memory;
use crate::machine::prefetch::{AHEAD, prefetch};

/// Neighbour of a cell across a facet of the convex hull.
pub const NO_CELL: u32 = NONE;

/// Whether so many changed slots are too many of `n_slots` to be compared one by one.
pub(super) fn are_most(n_changed: usize, n_slots: usize) -> bool {
    n_changed as f64 > reading().max_share_listed * n_slots as f64
}

/// Memory for this number of changes is always kept.
const KEPT_CHANGES: usize = 64;

/// The arrays behind a view.
#[derive(Debug)]
pub(super) struct Cells<G: Dimension> {
    corners: Vec<G::Corners>,
    neighbours: Vec<G::Corners>,
    /// By slot of the kernel's complex, the index of its cell in the arrays; [`NO_CELL`] if it has none.
    index_of: Vec<u32>,
    /// The slot of each index.
    slots: Vec<u32>,
    /// By index; there may be more than cells.
    orderings: Vec<Ordering>,
    /// A bit for each lost cell that has been found, or whose index has been given to another one. All are 0 between
    /// calls.
    is_settled: Bits,
    /// What has changed since the program last took the changes, if it ever did.
    since_taken: Option<Tracker<G::Corners>>,
    /// What has changed since the latest commit began, if that is tracked.
    since_commit: Option<Tracker<G::Corners>>,
    scratch: Scratch<G::Corners>,
}

/// A slot that holds another cell than before.
#[derive(Clone, Copy, Debug)]
struct Found<C> {
    slot: u32,
    /// The index of the cell, if it was there before; else [`NO_CELL`].
    index: u32,
    ids: C,
}

/// Lists of a refreshment.
#[derive(Debug)]
struct Scratch<C> {
    /// Indices whose slot no longer holds their cell.
    lost: Vec<u32>,
    /// Slots that hold another finite cell than before, if they are known; else, those that hold one that was not
    /// there.
    found: Vec<Found<C>>,
    matcher: Matcher<C>,
    /// Slots of cells that have other indices.
    moved: Vec<u32>,
    /// Slots of cells that have been turned over.
    turned: Vec<u32>,
}

impl<C> Default for Scratch<C> {
    fn default() -> Self {
        Scratch {
            lost: Vec::new(),
            found: Vec::new(),
            matcher: Matcher::default(),
            moved: Vec::new(),
            turned: Vec::new(),
        }
    }
}

impl<C: Corners> Scratch<C> {
    fn memory_bytes(&self) -> usize {
        (self.lost.capacity() + self.moved.capacity() + self.turned.capacity()) * 4
            + self.found.capacity() * size_of::<Found<C>>()
            + self.matcher.memory_bytes()
    }
}

impl<G: Dimension> Default for Cells<G> {
    fn default() -> Self {
        Cells {
            corners: Vec::new(),
            neighbours: Vec::new(),
            index_of: Vec::new(),
            slots: Vec::new(),
            orderings: Vec::new(),
            is_settled: Bits::default(),
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

/// Whether a slot holds a finite cell.
#[inline(always)]
fn is_finite<G: Dimension>(kernel: &Delaunay<G>, slot: u32) -> bool {
    kernel.complex().is_live(slot) && !kernel.complex().cell(slot).is_ghost()
}

impl<G: Dimension> Cells<G> {
    /// Vertex ids of each cell.
    #[inline(always)]
    pub(super) fn corners(&self) -> &[G::Corners] {
        &self.corners
    }

    /// Index of the neighbour opposite each corner of each cell.
    #[inline(always)]
    pub(super) fn neighbours(&self) -> &[G::Corners] {
        &self.neighbours
    }

    /// By slot of the kernel's complex, the index of its cell; [`NO_CELL`] if it has none.
    #[inline(always)]
    pub(super) fn index_of(&self) -> &[u32] {
        &self.index_of
    }

    /// Tracks what changes from now on, which is when a commit begins.
    pub(super) fn track_commit(&mut self) -> Result<()> {
        if self.since_commit.is_none() {
            self.since_commit = Some(Tracker::of(self.corners.len())?);
        }
        Ok(())
    }

    /// A commit begins: if its changes are tracked, the cells of now are their base.
    pub(super) fn begin_commit(&mut self) {
        if let Some(tracker) = &mut self.since_commit {
            tracker.reset();
        }
    }

    /// Lists, ascending, the cells created since the latest commit began, if that is tracked.
    pub(super) fn list_created(&self) -> Result<Vec<u32>> {
        let mut created = Vec::new();
        if let Some(tracker) = &self.since_commit {
            tracker.list_created(&self.corners, &mut created)?;
        }
        Ok(created)
    }

    /// Lists what has changed since this was last [ended](Self::end_taking): everything, as created, if it never was.
    pub(super) fn take(&mut self, taken: &mut Taken<G::Corners>, n_ids: usize) -> Result<()> {
        let tracker = match &mut self.since_taken {
            Some(tracker) => tracker,
            none => none.insert(Tracker::of_none(self.corners.len())?),
        };
        taken.list(tracker, &self.corners, n_ids)
    }

    /// What has been listed has been taken.
    pub(super) fn end_taking(&mut self) {
        self.since_taken.as_mut().expect("it has been listed").reset();
    }

    /// The cells are in other slots, listed by the old ones.
    pub(super) fn renumber_slots(&mut self, slots: &[u32]) {
        for slot in &mut self.slots {
            *slot = slots.get(*slot as usize).copied().unwrap_or(NONE);
        }
    }

    /// Brings the arrays up to date: only the `dirty` slots have changed, or any, if there is no list of them. After an
    /// error they can be brought up to date later.
    pub(super) fn refresh(&mut self, kernel: &Delaunay<G>, dirty: Option<&Marks>) -> Result<()> {
        let mut scratch = std::mem::take(&mut self.scratch);
        let done = self.refresh_with(kernel, dirty, &mut scratch);
        if done.is_err() {
            scratch.lost.iter().for_each(|&index| self.is_settled.clear_around(index));
        }
        self.scratch = scratch;
        done
    }

    fn refresh_with(
        &mut self,
        kernel: &Delaunay<G>,
        dirty: Option<&Marks>,
        scratch: &mut Scratch<G::Corners>,
    ) -> Result<()> {
        scratch.lost.clear();
        scratch.found.clear();
        scratch.moved.clear();
        scratch.turned.clear();
        if self.corners.is_empty() {
            return self.fill(kernel);
        }
        self.is_settled.grow(self.corners.len())?;
        match dirty {
            Some(dirty) => {
                self.compare_slots(kernel, dirty.as_slice(), scratch)?;
                let Scratch { lost, found, matcher, turned, .. } = scratch;
                matcher.list(&self.corners, lost)?;
                self.find_lost(matcher, found, turned)?;
            }
            None => self.compare_all(kernel, scratch)?,
        }
        self.reserve(kernel, scratch)?;
        self.renumber(kernel, scratch);
        match dirty {
            Some(dirty) => self.glue_slots(kernel, dirty, &scratch.moved),
            None => self.glue_all(kernel),
        }
        // Memory for many changes is not kept.
        if scratch.found.capacity().max(scratch.matcher.capacity()) > self.corners.len() / 2 + KEPT_CHANGES {
            *scratch = Scratch::default();
        }
        Ok(())
    }

    /// Makes room for all that [`renumber`](Self::renumber) writes.
    fn reserve(&mut self, kernel: &Delaunay<G>, scratch: &mut Scratch<G::Corners>) -> Result<()> {
        let n = kernel.complex().n_finite();
        let more = n.saturating_sub(self.corners.len());
        memory::reserve_sparingly(&mut self.corners, more)?;
        memory::reserve_sparingly(&mut self.neighbours, more)?;
        memory::reserve_sparingly(&mut self.slots, more)?;
        let n_orderings = n.max(self.orderings.len());
        let more_orderings = n_orderings - self.orderings.len();
        memory::reserve_sparingly(&mut self.orderings, more_orderings)?;
        self.orderings.resize(n_orderings, Ordering::SAME);
        let more_slots = kernel.complex().n_slots().saturating_sub(self.index_of.len());
        memory::reserve_sparingly(&mut self.index_of, more_slots)?;
        let (n_lost, n_found) = (scratch.lost.len(), scratch.found.len());
        memory::reserve(&mut scratch.moved, n_lost)?;
        for tracker in [&mut self.since_taken, &mut self.since_commit].into_iter().flatten() {
            tracker.reserve(n_lost, scratch.turned.len(), n_lost + n_found, n)?;
        }
        Ok(())
    }

    /// Gives every cell its index: those found again theirs; new ones that of the cell which was in their slot, a
    /// hole, or one at the end. What is left of the holes is filled from the end.
    fn renumber(
        &mut self,
        kernel: &Delaunay<G>,
        Scratch { lost, found, moved, turned, .. }: &mut Scratch<G::Corners>,
    ) {
        let n = kernel.complex().n_finite();
        self.index_of.resize(kernel.complex().n_slots(), NO_CELL);
        let Cells {
            corners,
            neighbours,
            index_of,
            slots,
            orderings,
            is_settled,
            since_taken,
            since_commit,
            ..
        } = self;
        let mut trackers = [since_taken, since_commit];
        let mut trackers = trackers.iter_mut().filter_map(|tracker| tracker.as_mut());
        let (mut first, mut second) = (trackers.next(), trackers.next());
        let mut tell = |event: &dyn Fn(&mut Tracker<G::Corners>)| {
            first.iter_mut().chain(&mut second).for_each(|tracker| event(tracker));
        };
        // Slots give up what they have lost before others take it.
        for &Found { index, .. } in found.iter().filter(|found| found.index != NO_CELL) {
            let slot = slots[index as usize] as usize;
            if index_of.get(slot) == Some(&index) {
                index_of[slot] = NO_CELL;
            }
        }
        for (k, &Found { slot, index, ids }) in found.iter().enumerate() {
            if let Some(next) = found.get(k + 2 * AHEAD) {
                prefetch(index_of, next.slot as usize);
            }
            if let Some(next) = found.get(k + AHEAD) {
                let later = index_of[next.slot as usize] as usize;
                prefetch(corners, later);
                prefetch(orderings, later);
                tell(&|tracker| tracker.prefetch(later));
            }
            if index != NO_CELL {
                // It has been found in another slot.
                (slots[index as usize], index_of[slot as usize]) = (slot, index);
                continue;
            }
            // A new one takes the place of the one before in its slot.
            let index = index_of[slot as usize];
            if (index as usize) < n {
                is_settled.insert(index);
                orderings[index as usize] = Ordering::SAME;
                let row = std::mem::replace(&mut corners[index as usize], ids);
                tell(&|tracker| tracker.replace(index, row));
            }
        }
        let holes = &mut *lost;
        holes.retain(|&index| !is_settled.remove(index));
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
        for &Found { slot, ids, .. } in found.iter() {
            if index_of[slot as usize] != NO_CELL {
                continue;
            }
            let index = next_hole.next().unwrap_or(corners.len() as u32);
            if index as usize == corners.len() {
                corners.push(ids);
                neighbours.push(ids);
                slots.push(slot);
            } else {
                corners[index as usize] = ids;
            }
            orderings[index as usize] = Ordering::SAME;
            tell(&|tracker| tracker.create(index));
            slots[index as usize] = slot;
            index_of[slot as usize] = index;
        }
        for &slot in turned.iter() {
            let index = index_of[slot as usize];
            let row = std::mem::replace(&mut corners[index as usize], ids_of(kernel, slot));
            orderings[index as usize] = Ordering::SAME;
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
            orderings[to as usize] = orderings[from];
            index_of[slots[from] as usize] = to;
            moved.push(slots[from]);
            tell(&|tracker| tracker.renumber(from as u32, to));
        }
        corners.truncate(n);
        neighbours.truncate(n);
        slots.truncate(n);
        tell(&|tracker| tracker.truncate(n));
    }

    /// The index, in the complex, of a corner of a cell.
    pub(super) fn facet(&self, index: u32, corner: usize) -> Facet {
        let ordering = self.orderings[index as usize];
        let in_slot =
            (0..G::Corners::N).find(|&i| ordering.place(i) == corner).expect("every place is taken");
        Facet::new(self.slots[index as usize], in_slot)
    }

    /// A copy of arrays that are up to date, in which vertices have other ids and cells other slots, `n_slots` in all:
    /// those listed by the old ones. Every cell keeps its index.
    pub(super) fn renumbered(&self, ids: &[u32], slots: &[u32], n_slots: usize) -> Result<Self> {
        let mut cells = Cells {
            corners: memory::copy_of(&self.corners)?,
            neighbours: memory::copy_of(&self.neighbours)?,
            slots: memory::copy_of(&self.slots)?,
            orderings: memory::copy_of(&self.orderings)?,
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
            + self.orderings.capacity()
            + self.is_settled.memory_bytes()
            + self.scratch.memory_bytes()
            + trackers.map(Tracker::memory_bytes).sum::<usize>()
    }
}
