//! Changes of the cells by several threads: each has a range of them, with the free slots there, and changes no others.

use super::free::{FreeRange, WORD};
use super::{Cell, Complex, Corners, Facet};
use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::machine::prefetch::prefetch;
use crate::machine::threads;
use std::sync::Mutex;

/// Why cells were not changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obstacle {
    /// The cells there are not such that it can be done, or can be done in a range.
    Shape,
    /// A cell would change that is not of the range.
    OtherRange,
    /// The range has not enough free cells.
    Full,
    /// There is no memory for undoing.
    Memory,
}

/// Only memory can be missing where cells are changed.
impl From<Error> for Obstacle {
    fn from(_: Error) -> Self {
        Obstacle::Memory
    }
}

/// Cells from which it follows where ranges begin.
const SAMPLE: usize = 1 << 10;

/// Where ranges begin, at most this number of them, that have about as many of some cells each: at multiples of
/// [`WORD`], the first one at slot 0.
pub(crate) fn starts_of_ranges(
    cells: impl ExactSizeIterator<Item = Slot>,
    n_ranges: usize,
) -> Result<Vec<Slot>> {
    let (mut sample, mut starts) = (Vec::new(), Vec::new());
    let step = (cells.len() / SAMPLE).max(1);
    memory::reserve_exact(&mut sample, cells.len().div_ceil(step))?;
    memory::reserve_exact(&mut starts, n_ranges)?;
    sample.extend(cells.step_by(step));
    sample.sort_unstable();
    starts.extend((0..n_ranges).map(|k| {
        let quantile: Slot = sample[sample.len() * k / n_ranges];
        Slot::at(quantile.index() / WORD * WORD)
    }));
    starts[0] = Slot::new(0);
    starts.dedup();
    Ok(starts)
}

/// Cells that follow each other in storage, for one thread to change while others change the rest. A change replaces
/// cells and the neighbours' side of their gluings; it is done only if all of these are of the range.
#[derive(Debug)]
pub struct CellRange<'c, C: Corners> {
    /// Slot of the first one.
    first: Slot,
    cells: &'c mut [Cell<C>],
    /// The free slots of the range.
    pub(super) free: FreeRange<'c>,
}

impl<C: Corners> Complex<C> {
    /// All cells.
    pub(crate) fn whole(&mut self) -> CellRange<'_, C> {
        CellRange { first: Slot::new(0), cells: &mut self.cells, free: self.free.whole() }
    }

    /// Works on the ranges that begin at these slots, all of them multiples of [`WORD`] and the first one 0, each with its
    /// own one of `parts`, on so many threads. After an error nothing has changed.
    pub(crate) fn divided<P: Send>(
        &mut self,
        starts: &[Slot],
        parts: &mut [P],
        n_threads: usize,
        work: impl Fn(&mut CellRange<C>, &mut P) + Sync,
    ) -> Result<()> {
        debug_assert!(starts.iter().all(|start| start.index().is_multiple_of(WORD)));
        let (mut numbers, mut all) = (Vec::new(), Vec::new());
        memory::lengthen(&mut numbers, starts.len(), 0)?;
        memory::reserve_exact(&mut all, starts.len())?;
        let mut rest = &mut self.cells[..];
        let free = self.free.ranges(starts, &mut numbers);
        for (k, (free, part)) in free.zip(parts).enumerate() {
            let n = starts.get(k + 1).map_or(rest.len(), |end| end.index() - starts[k].index());
            let cells;
            (cells, rest) = rest.split_at_mut(n);
            all.push(Mutex::new((CellRange { first: starts[k], cells, free }, part)));
        }
        threads::for_pieces(starts.len(), n_threads, &|k| {
            let (range, part) = &mut *all[k].lock().expect("each is locked once");
            work(range, part);
        });
        drop(all);
        self.free.count();
        Ok(())
    }

    /// Adds `n` cells, all of them free. They stay when flips are undone.
    pub(crate) fn create_free(&mut self, n: usize) -> Result<()> {
        self.reserve(self.free.len() + n)?;
        let first = self.cells.len();
        self.cells.lengthen(first + n, Cell::free());
        self.marks.resize(first + n, 0);
        Slot::range(first..first + n).for_each(|c| self.free.set(c, true));
        Ok(())
    }

    /// The free slots.
    pub(crate) fn free_cells(&self) -> impl Iterator<Item = Slot> + '_ {
        self.free.iter()
    }

    /// Number of free slots.
    pub(crate) fn n_free(&self) -> usize {
        self.free.len()
    }
}

impl<C: Corners> CellRange<'_, C> {
    /// Position in the range; beyond its end for a cell that is not of it.
    #[inline(always)]
    fn position(&self, cell: Slot) -> usize {
        cell.get().wrapping_sub(self.first.get()) as usize
    }

    /// Whether a cell is of the range.
    #[inline(always)]
    pub(crate) fn has(&self, cell: Slot) -> bool {
        self.position(cell) < self.cells.len()
    }

    /// A cell of the range.
    #[inline(always)]
    pub(crate) fn cell(&self, cell: Slot) -> Result<&Cell<C>, Obstacle> {
        self.cells.get(self.position(cell)).ok_or(Obstacle::OtherRange)
    }

    /// Asks for a cell, which may be none of the range.
    #[inline(always)]
    pub(crate) fn prefetch(&self, cell: Slot) {
        prefetch(self.cells, self.position(cell));
    }

    /// The corner opposite a facet of a cell of the range.
    #[inline(always)]
    pub(crate) fn apex(&self, facet: Facet) -> Result<SiteId, Obstacle> {
        Ok(self.cell(facet.cell())?.corners[facet.index()])
    }

    #[inline(always)]
    pub(super) fn cell_mut(&mut self, cell: Slot) -> &mut Cell<C> {
        let at = self.position(cell);
        &mut self.cells[at]
    }

    /// An error if one of these cells is not of the range.
    #[inline(always)]
    pub(super) fn has_cells_of(&self, facets: &[Facet]) -> Result<(), Obstacle> {
        if facets.iter().all(|facet| self.has(facet.cell())) { Ok(()) } else { Err(Obstacle::OtherRange) }
    }

    /// Puts a cell, and both sides of all gluings.
    #[inline(always)]
    pub(super) fn put_whole(&mut self, cell: Slot, corners: C, neighbours: C::Of<Facet>) {
        *self.cell_mut(cell) = Cell { alignment: [], corners, neighbours };
        for (i, out) in neighbours.as_ref().iter().enumerate() {
            self.cell_mut(out.cell()).neighbours[out.index()] = Facet::new(cell, i);
        }
    }
}
