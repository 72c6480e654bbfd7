//! Cells in the order of their sites.

use super::free::FreeSlots;
use super::record::Record;
use super::{Cell, Complex, Corners, Facet, MAX_CELLS};
use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot};
use crate::machine::aligned::Aligned;
use crate::machine::memory;

/// The free slots among those of `n_live` sorted cells: one after every `gap_after` of them.
fn gaps(n_live: usize, gap_after: usize) -> impl Iterator<Item = Slot> {
    (1..=n_live / gap_after).map(move |k| Slot::at(k * (gap_after + 1) - 1))
}

impl<C: Corners> Complex<C> {
    /// Puts the cells in the order of the lowest of their corners, of which there are less than `n_sites`, and a free
    /// one after every `gap_after` of them; returns the new slot of each.
    pub(crate) fn sort(&mut self, n_sites: usize, gap_after: usize) -> Result<Vec<Slot>> {
        debug_assert!(!self.is_recording() || self.rows().is_empty(), "rows are named by slot");
        let (sorted, index) = self.sorted(n_sites, gap_after, |s| s)?;
        let n_live = self.cells.len() - self.free.len();
        let spare = sorted.capacity().saturating_sub(self.marks.len());
        memory::reserve_exact(&mut self.marks, spare)?;
        self.free.cover(sorted.capacity())?;
        self.follow_sort(sorted.capacity(), sorted.len())?;
        self.cells = sorted;
        self.marks.resize(self.cells.len(), 0);
        self.free.put_everywhere(gaps(n_live, gap_after));
        Ok(index)
    }

    /// A copy with the cells in the order of [`sort`](Self::sort), without memory for those that are gone, in which the
    /// sites have other `names`, all below `n_sites`; and the new slot of each cell, [`Slot::NONE`] for free ones.
    pub(crate) fn compacted(
        &self,
        n_sites: usize,
        gap_after: usize,
        names: &[SiteId],
    ) -> Result<(Self, Vec<Slot>)> {
        let (cells, index) = self.sorted(n_sites, gap_after, |s| names[s])?;
        let (mut marks, mut free) = (Vec::new(), FreeSlots::default());
        memory::reserve_exact(&mut marks, cells.capacity())?;
        marks.resize(cells.len(), 0);
        let n_live = self.cells.len() - self.free.len();
        free.cover(cells.capacity())?;
        free.put_everywhere(gaps(n_live, gap_after));
        Ok((Complex { cells, marks, free, n_ghosts: self.n_ghosts, record: Record::default() }, index))
    }

    /// The cells in the order of [`sort`](Self::sort), by new names of the sites, and the new slot of each.
    fn sorted(
        &self,
        n_sites: usize,
        gap_after: usize,
        name: impl Fn(SiteId) -> SiteId,
    ) -> Result<(Aligned<Cell<C>>, Vec<Slot>)> {
        let lowest = |cell: &Cell<C>| {
            cell.corners.as_ref().iter().map(|&s| name(s)).fold(SiteId::NONE, SiteId::min).index()
        };
        let n_live = self.cells.len() - self.free.len();
        let n_slots = n_live + n_live / gap_after;
        if n_slots > MAX_CELLS {
            return Err(Error::TooManyCells { limit: MAX_CELLS });
        }
        let (mut starts, mut index, mut sorted) = (Vec::new(), Vec::new(), Aligned::new());
        memory::reserve_exact(&mut starts, n_sites + 1)?;
        memory::reserve_exact(&mut index, self.cells.len())?;
        sorted.reserve_exact(n_slots + n_live / 64)?;
        starts.resize(n_sites + 1, 0u32);
        for cell in self.cells.iter().filter(|cell| !cell.is_free()) {
            starts[lowest(cell) + 1] += 1;
        }
        for s in 0..n_sites {
            starts[s + 1] += starts[s];
        }
        index.extend(self.cells.iter().map(|cell| {
            if cell.is_free() {
                return Slot::NONE;
            }
            let at = &mut starts[lowest(cell)];
            *at += 1;
            let rank = *at - 1;
            Slot::at(rank as usize + rank as usize / gap_after)
        }));
        sorted.lengthen(n_slots, Cell::free());
        for (cell, &to) in self.cells.iter().zip(&index) {
            if to == Slot::NONE {
                continue;
            }
            let mut cell = *cell;
            for corner in cell.corners.as_mut() {
                *corner = name(*corner);
            }
            for out in cell.neighbours.as_mut() {
                *out = Facet::new(index[out.cell()], out.index());
            }
            sorted[to] = cell;
        }
        Ok((sorted, index))
    }
}
