//! Combinatorics alone: cells, their neighbours, the ghost vertex. Knows no coordinates.
//!
//! A complex is a closed pseudo-manifold: the *ghost* (infinite) vertex [`INFINITE`] completes the convex
//! hull, so that every facet has exactly two cells. A *ghost cell* has the ghost vertex as its last corner.
//!
//! A cell is named by its [`Slot`].
//!
//! Invariants, for every live cell `c` and index `i`:
//! - neighbours are mutual: if `neighbour(c, i)` is facet `j` of `d`, then
//!   `neighbour(d, j)` is facet `i` of `c`;
//! - the two cells have the same corners except for those opposite the facet;
//! - only the last corner may be [`INFINITE`].
//!
//! A neighbour is stored with the index of the shared facet seen from the other side, in the two low bits:
//! crossing a facet costs no search. That bounds the number of cells by [`MAX_CELLS`].
//!
//! Methods that take a cell's slot are for this crate alone and do not check it (checks cost 5 % of a 3D
//! build): by the invariants, a slot read from a live cell is that of a live cell.

#![allow(unsafe_code)]

mod cell;
mod copying;
mod corners;
mod flips;
mod free;
mod ranges;
mod record;
mod restoring;
mod sorting;

pub use cell::{Cell, Facet};
pub use corners::{CornerEntry, Corners};
pub(crate) use flips::{NewCell, outer_of_three, outer_of_two};
pub(crate) use ranges::starts_of_ranges;
pub use ranges::{CellRange, Obstacle};
pub(crate) use record::KeptRecord;
pub use record::Row;

use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot};
use crate::machine::aligned::Aligned;
use crate::machine::memory;
use crate::machine::prefetch::prefetch;
use free::FreeSlots;
use record::Record;

/// The ghost vertex: index 0 of the sites.
pub const INFINITE: SiteId = SiteId::new(0);
/// Greatest number of cells: a little below 2^30, so that codes are left to name cells in the making.
pub const MAX_CELLS: usize = (1 << 30) - 4096;

/// A set of cells, glued along facets.
#[derive(Debug)]
pub struct Complex<C: Corners> {
    cells: Aligned<Cell<C>>,
    /// One byte per cell for the traversals of the layers above; 0 between them.
    marks: Vec<u8>,
    free: FreeSlots,
    n_ghosts: usize,
    record: Record<C>,
}

impl<C: Corners> Default for Complex<C> {
    fn default() -> Self {
        Complex {
            cells: Aligned::new(),
            marks: Vec::new(),
            free: FreeSlots::default(),
            n_ghosts: 0,
            record: Record::default(),
        }
    }
}

impl<C: Corners> Complex<C> {
    /// Removes all cells; keeps the memory.
    pub(crate) fn clear(&mut self) {
        debug_assert!(!self.is_recording(), "who may want the cells back keeps them");
        self.cells.truncate(0);
        self.marks.clear();
        self.free.clear();
        self.n_ghosts = 0;
    }

    /// Number of cells, ghost cells not counted.
    pub fn n_finite(&self) -> usize {
        self.cells.len() - self.free.len() - self.n_ghosts
    }

    /// Number of ghost cells: facets of the convex hull.
    pub fn n_ghosts(&self) -> usize {
        self.n_ghosts
    }

    /// One above the highest slot of a cell.
    pub fn n_slots(&self) -> usize {
        self.cells.len()
    }

    /// Number of cells for which there is memory.
    pub fn n_cells_reserved(&self) -> usize {
        self.cells.capacity()
    }

    /// The cell of a slot below [`n_slots`](Self::n_slots).
    #[inline(always)]
    pub(crate) fn cell(&self, cell: Slot) -> &Cell<C> {
        debug_assert!(cell.index() < self.cells.len());
        // SAFETY: the slot is that of a cell (module's documentation).
        unsafe { self.cells.get_unchecked(cell.index()) }
    }

    /// All cells by slot, free ones included.
    pub(crate) fn cells(&self) -> &[Cell<C>] {
        &self.cells
    }

    /// The corner of a facet's cell that is opposite the facet.
    #[inline(always)]
    pub(crate) fn apex(&self, facet: Facet) -> SiteId {
        debug_assert!(facet.cell().index() < self.cells.len() && facet.index() < C::N);
        // In fewer operations than by cell and index.
        let at = facet.code() as usize + 2 * (C::N - 2) * facet.cell().index();
        // SAFETY: a cell is 2 N numbers, its corners and then its neighbours; this is number `index` of a cell
        // that there is.
        unsafe { *self.cells.as_ptr().cast::<SiteId>().add(at) }
    }

    /// Asks for a cell.
    #[inline(always)]
    pub(crate) fn prefetch(&self, cell: Slot) {
        prefetch(&self.cells, cell.index());
    }

    /// Asks for the neighbours of a cell, which may be free.
    #[inline(always)]
    pub(crate) fn prefetch_neighbours(&self, cell: Slot) {
        for i in 0..C::N {
            prefetch(&self.cells, self.cell(cell).neighbour(i).cell().index());
        }
    }

    /// Asks for the marks of the neighbours of a cell.
    #[inline(always)]
    pub(crate) fn prefetch_marks(&self, cell: &Cell<C>) {
        for i in 0..C::N {
            prefetch(&self.marks, cell.neighbour(i).cell().index());
        }
    }

    #[inline(always)]
    fn cell_mut(&mut self, cell: Slot) -> &mut Cell<C> {
        debug_assert!(cell.index() < self.cells.len());
        // SAFETY: the slot is that of a cell (module's documentation).
        unsafe { self.cells.get_unchecked_mut(cell.index()) }
    }

    /// Whether the slot has no cell at present.
    #[inline(always)]
    pub(crate) fn is_free(&self, cell: Slot) -> bool {
        self.cell(cell).is_free()
    }

    /// Whether there is a cell in this slot.
    pub fn is_live(&self, cell: Slot) -> bool {
        cell.index() < self.cells.len() && !self.is_free(cell)
    }

    /// Slots of all cells, ghost cells included.
    pub fn live(&self) -> impl Iterator<Item = Slot> + '_ {
        Slot::range(0..self.cells.len()).filter(|&c| !self.is_free(c))
    }

    /// Slots of the cells that are not ghosts.
    pub fn finite(&self) -> impl Iterator<Item = Slot> + '_ {
        self.live().filter(|&c| !self.cell(c).is_ghost())
    }

    /// Mark of a cell.
    #[inline(always)]
    pub(crate) fn mark(&self, cell: Slot) -> u8 {
        debug_assert!(cell.index() < self.marks.len());
        // SAFETY: there is a mark for each cell.
        unsafe { *self.marks.get_unchecked(cell.index()) }
    }

    /// Marks a cell.
    #[inline(always)]
    pub(crate) fn set_mark(&mut self, cell: Slot, mark: u8) {
        debug_assert!(cell.index() < self.marks.len());
        // SAFETY: there is a mark for each cell.
        unsafe { *self.marks.get_unchecked_mut(cell.index()) = mark }
    }

    /// Makes sure that `n` more cells can be created without a failure.
    #[inline(always)]
    pub(crate) fn reserve(&mut self, n: usize) -> Result<()> {
        self.reserve_rows(n)?;
        if self.cells.capacity() - self.cells.len() + self.free.len() >= n {
            return Ok(());
        }
        self.grow(n)
    }

    /// Room for `n` more cells at least, and for an eighth more than now, so that growing stays linear
    /// without doubling a large array.
    #[cold]
    fn grow(&mut self, n: usize) -> Result<()> {
        if self.cells.len() + n > MAX_CELLS {
            return Err(Error::TooManyCells { limit: MAX_CELLS });
        }
        let more = n.max(self.cells.len() / 8).min(MAX_CELLS - self.cells.len());
        let room = self.cells.len() + more;
        // The cells last: where there is room for one, there is for its mark, whatever has failed before.
        let more_marks = room - self.marks.len();
        memory::reserve_exact(&mut self.marks, more_marks)?;
        self.free.cover(room)?;
        if self.is_recording() {
            self.cover(room)?;
        }
        self.cells.reserve_exact(more)?;
        debug_assert!(self.cells.capacity() <= self.marks.capacity());
        Ok(())
    }

    /// Creates a cell that has no neighbours yet, in a slot near this one.
    #[inline(always)]
    pub(crate) fn create(&mut self, corners: C, near: Slot) -> Slot {
        let cell = self.create_blank(near);
        self.put(cell, corners);
        cell
    }

    /// A slot near this one, for a cell that is [put](Self::put) there next.
    #[inline(always)]
    pub(crate) fn create_blank(&mut self, near: Slot) -> Slot {
        let cell = self.free.take_near(near).unwrap_or_else(|| {
            let cell = Slot::at(self.cells.len());
            self.cells.push(Cell::free());
            self.marks.push(0);
            cell
        });
        self.note(cell);
        cell
    }

    /// Puts new corners where a cell is free or to be replaced; its mark is cleared, its neighbours are not.
    /// The caller has [retired](Self::retire) the old one.
    #[inline(always)]
    pub(crate) fn put(&mut self, cell: Slot, corners: C) {
        self.n_ghosts += (corners[C::N - 1] == INFINITE) as usize;
        self.cell_mut(cell).corners = corners;
        self.set_mark(cell, 0);
    }

    /// Puts a cell where one is free or to be replaced, with its side of all gluings; the neighbours' sides are still
    /// to be set. The caller has [retired](Self::retire) the old one.
    #[inline(always)]
    pub(crate) fn put_whole(&mut self, cell: Slot, corners: C, neighbours: C::Of<Facet>) {
        self.n_ghosts += (corners[C::N - 1] == INFINITE) as usize;
        *self.cell_mut(cell) = Cell { alignment: [], corners, neighbours };
        self.set_mark(cell, 0);
    }

    /// Puts a [whole](Self::put_whole) cell, and sets the neighbour's side opposite corner 0.
    #[inline(always)]
    pub(crate) fn put_glued(&mut self, cell: Slot, corners: C, neighbours: C::Of<Facet>) {
        self.put_whole(cell, corners, neighbours);
        self.set_neighbour(neighbours[0], Facet::new(cell, 0));
    }

    /// Sets one side of a gluing.
    #[inline(always)]
    pub(crate) fn set_neighbour(&mut self, of: Facet, neighbour: Facet) {
        self.cell_mut(of.cell()).neighbours[of.index()] = neighbour;
    }

    /// Takes a cell out of the count of ghosts before [`put`](Self::put) or [`release`](Self::release).
    #[inline(always)]
    pub(crate) fn retire(&mut self, cell: Slot) {
        self.n_ghosts -= self.cell(cell).is_ghost() as usize;
    }

    /// [Retires](Self::retire) several cells, of which `n` are ghosts.
    #[inline(always)]
    pub(crate) fn retire_ghosts(&mut self, n: usize) {
        self.n_ghosts -= n;
    }

    /// Frees the slot of a retired cell.
    #[inline(always)]
    pub(crate) fn release(&mut self, cell: Slot) {
        self.cell_mut(cell).corners = C::filled(SiteId::NONE);
        self.set_mark(cell, 0);
        self.free.put(cell);
    }

    /// Glues two facets.
    #[inline(always)]
    pub(crate) fn glue(&mut self, a: Facet, b: Facet) {
        self.set_neighbour(a, b);
        self.set_neighbour(b, a);
    }

    /// Creates a single cell and the ghost cells around it.
    pub(crate) fn start(&mut self, corners: C) -> Result<()> {
        self.reserve(C::N + 1)?;
        let last = C::N - 1;
        // Where the ghost cell beyond facet `i` has corner `k` of the cell. The ghost vertex comes in for corner `i`,
        // and changes places with the last one; if it is the last one, two others do, as the order must be even.
        let place = |i: usize, k: usize| match (i == last, k) {
            (true, 0 | 1) => 1 - k,
            (false, k) if k == last => i,
            _ => k,
        };
        let cell = self.create(corners, Slot::new(0));
        let mut ghosts = [Slot::NONE; 4];
        for i in 0..C::N {
            let mut ghost = C::filled(INFINITE);
            for k in (0..C::N).filter(|&k| k != i) {
                ghost.as_mut()[place(i, k)] = corners[k];
            }
            ghosts[i] = self.create(ghost, cell);
            self.glue(Facet::new(cell, i), Facet::new(ghosts[i], last));
            for k in 0..i {
                self.glue(Facet::new(ghosts[i], place(i, k)), Facet::new(ghosts[k], place(k, i)));
            }
        }
        Ok(())
    }

    /// Keeps room for `kept` cells; an empty complex that has the room for the `n` cells behind them, for another
    /// thread to fill. One that turns out to have more cells moves them elsewhere.
    pub(crate) fn divide(&mut self, kept: usize, n: usize) -> Result<Self> {
        let mut other = Self::default();
        memory::reserve_exact(&mut other.marks, n)?;
        other.free.cover(n)?;
        other.cells = self.cells.divide(kept, n)?;
        Ok(other)
    }

    /// Has all its room again, once those that were [divided](Self::divide) from it are gone.
    pub(crate) fn reclaim(&mut self) {
        self.cells.reclaim();
        debug_assert!(self.cells.capacity() <= self.marks.capacity());
    }

    /// Adds the cells of another complex, on other sites: its site `s` becomes `s + shift`, its slot `c` becomes `c`
    /// plus what is returned; on several threads. Where it has the room behind that of this one, cells stay where they
    /// are.
    pub(crate) fn append(&mut self, other: Self, shift: u32, n_threads: usize) -> Result<usize> {
        let is_behind = self.cells.is_followed_by(&other.cells);
        let (n, n_others, room) = (self.cells.len(), other.cells.len(), self.cells.capacity());
        let first = if is_behind { room } else { n };
        if first + n_others > MAX_CELLS {
            return Err(Error::TooManyCells { limit: MAX_CELLS });
        }
        let moved = |c: Slot| Slot::new(c.get() + first as u32);
        let shift_one = |cell: &mut Cell<C>| {
            if cell.is_free() {
                return;
            }
            for corner in cell.corners.as_mut().iter_mut().filter(|corner| **corner != INFINITE) {
                *corner = SiteId::new(corner.get() + shift);
            }
            for out in cell.neighbours.as_mut() {
                *out = Facet::new(moved(out.cell()), out.index());
            }
        };
        // As when the complex grows, the cells last.
        let room = if is_behind { room + other.cells.capacity() } else { room.max(n + n_others) };
        let more_marks = room - self.marks.len();
        memory::reserve_exact(&mut self.marks, more_marks)?;
        self.free.cover(room)?;
        if is_behind {
            self.cells.rejoin(other.cells, Cell::free());
            memory::change(&mut self.cells[first..], n_threads, &shift_one);
        } else {
            self.cells.extend(&other.cells, n_threads, |cell| {
                let mut cell = *cell;
                shift_one(&mut cell);
                cell
            })?;
        }
        debug_assert!(self.cells.capacity() <= self.marks.capacity());
        self.marks.resize(self.cells.len(), 0);
        Slot::range(n..first).for_each(|c| self.free.set(c, true));
        other.free.iter().for_each(|c| self.free.set(moved(c), true));
        self.n_ghosts += other.n_ghosts;
        Ok(first)
    }

    /// Bytes held.
    pub fn memory_bytes(&self) -> usize {
        self.cells.memory_bytes()
            + self.marks.capacity()
            + self.free.memory_bytes()
            + self.record.memory_bytes()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Slots that were free before do not come back with the next cells.
    #[test]
    fn a_cleared_complex_begins_with_the_first_slot() {
        let cell = [1, 2, 3].map(SiteId::new);
        let mut complex = Complex::<[SiteId; 3]>::default();
        complex.start(cell).expect("room");
        assert_eq!((complex.n_finite(), complex.n_ghosts()), (1, 3));
        complex.retire(Slot::new(2));
        complex.release(Slot::new(2));
        complex.clear();
        assert_eq!((complex.n_finite(), complex.n_ghosts(), complex.n_slots()), (0, 0, 0));
        complex.start(cell).expect("room");
        assert_eq!((complex.n_finite(), complex.n_ghosts(), complex.n_slots()), (1, 3, 4));
        assert_eq!(complex.cell(Slot::new(0)).corners, cell);
    }
}
