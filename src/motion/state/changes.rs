//! The change list: what a program that keeps something for each cell has to know.
//!
//! A tracker compares the cells of now with those of an earlier moment, its *base*, by what every refreshment of the
//! arrays ([`cells`](super::cells)) tells it. It knows of each index under which one its cell was at the base, and of
//! each cell of the base that is gone its index and corners. So it never holds more than there were cells, however long
//! the program does not take the changes.

use crate::complex::Corners;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::prefetch;
use crate::motion::state::marks::Marks;

/// In place of an id: a vertex that has none any more.
pub const NO_VERTEX: VertexId = VertexId::NONE;

/// What has changed since a base.
#[derive(Debug)]
pub(in crate::motion) struct Tracker<C> {
    /// By index of a cell of now, its index at the base; [`CellId::NONE`] if it has been created since.
    origin: Vec<CellId>,
    /// Indices whose origin may be another one; some may be beyond the end.
    pub(super) touched: Marks<CellId>,
    /// Cells of the base that have been removed: their indices and corners.
    pub(super) removed: Vec<(CellId, C)>,
    /// How often the arrays have been refreshed since the base: a cell that goes in one refreshment may come back in
    /// another.
    n_refreshed: u32,
    /// How many cells have been given another index since the base.
    pub(super) n_renumbered: usize,
    /// Cells of the base that have been turned over, and how their corners were listed before.
    pub(super) turned: Vec<TurnedCell<C>>,
}

/// Lengths and counts of a tracker, to which it can go back.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct Lengths {
    n_cells: usize,
    n_removed: usize,
    n_turned: usize,
    n_refreshed: u32,
    n_renumbered: usize,
}

/// A cell of the base that has been turned over.
#[derive(Clone, Copy, Debug)]
pub(super) struct TurnedCell<C> {
    pub(super) origin: CellId,
    /// Its place in the order of the events.
    at: u32,
    pub(super) before: C,
}

impl<C: Corners<VertexId>> Tracker<C> {
    /// A tracker whose base has no cells, while there are `n`.
    pub(in crate::motion) fn of_none(n: usize) -> Result<Self> {
        let mut origin = Vec::new();
        memory::reserve_exact(&mut origin, n)?;
        origin.resize(n, CellId::NONE);
        let mut touched = Marks::default();
        touched.reserve(n, n)?;
        CellId::range(0..n).for_each(|index| touched.insert(index));
        Ok(Tracker {
            origin,
            touched,
            removed: Vec::new(),
            n_refreshed: 0,
            n_renumbered: 0,
            turned: Vec::new(),
        })
    }

    /// Makes room for these numbers of removals, cells turned over, touched indices, and cells. A long list of cells turned
    /// over is shortened if it `may` be.
    pub(in crate::motion) fn reserve(
        &mut self,
        n_removed: usize,
        n_turned: usize,
        n_touched: usize,
        n_cells: usize,
        may_shorten: bool,
    ) -> Result<()> {
        if may_shorten && self.turned.len() > self.origin.len() {
            keep_first_turns(&mut self.turned);
        }
        memory::reserve(&mut self.turned, n_turned)?;
        self.n_refreshed = self.n_refreshed.saturating_add(1);
        memory::reserve(&mut self.removed, n_removed)?;
        self.touched.reserve(n_touched, n_cells.max(self.origin.len()))?;
        let more = n_cells.saturating_sub(self.origin.len());
        memory::reserve(&mut self.origin, more)
    }

    /// The lengths and counts of now.
    pub(in crate::motion) fn lengths(&self) -> Lengths {
        Lengths {
            n_cells: self.origin.len(),
            n_removed: self.removed.len(),
            n_turned: self.turned.len(),
            n_refreshed: self.n_refreshed,
            n_renumbered: self.n_renumbered,
        }
    }

    /// The corners of cells that have been created since the base, with their indices, and of those that have been removed.
    /// One that has gone and come back may be among both.
    pub(in crate::motion) fn rows_since_base<'t>(
        &'t self,
        corners: &'t [C],
    ) -> impl Iterator<Item = (&'t C, Option<CellId>)> + 't {
        let is_created = |index: CellId| index.index() < corners.len() && self.origin[index] == CellId::NONE;
        let created = self.touched.as_slice().iter().filter(move |&&index| is_created(index));
        let removed = self.removed.iter().map(|(_, row)| (row, None));
        created.map(|&index| (&corners[index], Some(index))).chain(removed)
    }

    /// The index at the base of the cell of an index, if there is a cell.
    pub(in crate::motion) fn origin(&self, index: CellId) -> CellId {
        self.origin.get(index.index()).copied().unwrap_or(CellId::NONE)
    }

    /// Goes back to when the lengths were these; what has changed since of origins has to be put back.
    pub(in crate::motion) fn go_back(&mut self, lengths: Lengths) {
        // There is room, as there was once.
        self.origin.resize(lengths.n_cells, CellId::NONE);
        self.removed.truncate(lengths.n_removed);
        self.turned.truncate(lengths.n_turned);
        (self.n_refreshed, self.n_renumbered) = (lengths.n_refreshed, lengths.n_renumbered);
    }

    /// Puts an origin back. That the index is touched stays, which says nothing.
    pub(in crate::motion) fn put_back(&mut self, index: CellId, origin: CellId) {
        self.origin[index] = origin;
    }

    pub(in crate::motion) fn remove(&mut self, index: CellId, corners: C) {
        let origin = self.origin[index];
        if origin != CellId::NONE {
            self.removed.push((origin, corners));
        }
    }

    /// A cell stays, but its corners are no longer listed in this order.
    pub(in crate::motion) fn turn(&mut self, index: CellId, before: C) {
        let origin = self.origin[index];
        if origin != CellId::NONE {
            self.turned.push(TurnedCell { origin, at: self.turned.len() as u32, before });
        }
    }

    /// Asks for what is known of an index; any will do.
    #[inline(always)]
    pub(in crate::motion) fn prefetch(&self, index: usize) {
        prefetch(&self.origin, index);
    }

    /// A cell has gone, and a new one has its index.
    #[inline(always)]
    pub(in crate::motion) fn replace(&mut self, index: CellId, before: C) {
        let origin = &mut self.origin[index];
        if *origin != CellId::NONE {
            self.removed.push((*origin, before));
            *origin = CellId::NONE;
        }
        self.touched.insert(index);
    }

    pub(in crate::motion) fn create(&mut self, index: CellId) {
        if index.index() == self.origin.len() {
            self.origin.push(CellId::NONE);
        } else {
            self.origin[index] = CellId::NONE;
        }
        self.touched.insert(index);
    }

    pub(in crate::motion) fn renumber(&mut self, from: CellId, to: CellId) {
        self.origin[to] = self.origin[from];
        self.n_renumbered += 1;
        self.touched.insert(to);
    }

    /// Whether the cells of now are those of the base, in the same rows.
    pub(in crate::motion) fn is_clean(&self) -> bool {
        self.touched.as_slice().is_empty() && self.removed.is_empty() && self.turned.is_empty()
    }

    pub(in crate::motion) fn truncate(&mut self, n: usize) {
        self.origin.truncate(n);
    }

    /// The cells of now are the base.
    pub(in crate::motion) fn reset(&mut self) {
        for &index in self.touched.as_slice() {
            if let Some(origin) = self.origin.get_mut(index.index()) {
                *origin = index;
            }
        }
        self.touched.clear();
        self.touched.shrink_to(1024 + self.origin.len() / 2);
        if self.removed.capacity() > 1024 + self.origin.len() / 2 {
            self.removed = Vec::new();
        }
        self.removed.clear();
        (self.n_refreshed, self.n_renumbered) = (0, 0);
        self.turned.clear();
    }

    /// A copy in which the vertices have other ids, listed by the old ones. A removed vertex has none any more: no
    /// cell of now or later has it, so a row with [`NO_VERTEX`] is never there again.
    pub(in crate::motion) fn renumbered(&self, ids: &[VertexId]) -> Result<Self> {
        let mut removed = memory::copy_of(&self.removed)?;
        for (_, row) in &mut removed {
            renumber(row, ids);
        }
        let mut turned = memory::copy_of(&self.turned)?;
        turned.iter_mut().for_each(|event| renumber(&mut event.before, ids));
        let mut touched = Marks::default();
        touched.reserve(self.touched.as_slice().len(), self.origin.len())?;
        let is_there = |index: &&CellId| index.index() < self.origin.len();
        self.touched.as_slice().iter().filter(is_there).for_each(|&index| touched.insert(index));
        Ok(Tracker {
            origin: memory::copy_of(&self.origin)?,
            touched,
            removed,
            n_refreshed: self.n_refreshed,
            n_renumbered: self.n_renumbered,
            turned,
        })
    }

    /// A copy.
    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(Tracker {
            origin: memory::copy_of(&self.origin)?,
            touched: self.touched.copied()?,
            removed: memory::copy_of(&self.removed)?,
            n_refreshed: self.n_refreshed,
            n_renumbered: self.n_renumbered,
            turned: memory::copy_of(&self.turned)?,
        })
    }

    /// The index at the base of a cell, [`CellId::NONE`] if it is new, and which of the removed ones it is if it has
    /// come back; nothing beyond the end.
    pub(super) fn origin_of(
        &self,
        index: CellId,
        corners: &[C],
        removed: &[(C, u32)],
    ) -> Option<(CellId, Option<u32>)> {
        let origin = *self.origin.get(index.index())?;
        if origin != CellId::NONE || removed.is_empty() {
            return Some((origin, None));
        }
        let returned = find(removed, &sorted(corners[index]));
        Some((returned.map_or(CellId::NONE, |k| self.removed[k as usize].0), returned))
    }

    /// The row at the base of a cell that was there, given the one that was seen last.
    pub(super) fn before(&self, origin: CellId, seen: C) -> C {
        let found = self.turned.binary_search_by_key(&origin, |event| event.origin);
        found.map_or(seen, |k| self.turned[k].before)
    }

    /// The removed cells that may have come back, by their sorted corners, each with its position in the list.
    pub(super) fn sorted_removed(&self) -> Result<Vec<(C, u32)>> {
        let mut by_corners = Vec::new();
        if self.n_refreshed < 2 {
            return Ok(by_corners);
        }
        memory::reserve_exact(&mut by_corners, self.removed.len())?;
        by_corners.extend(self.removed.iter().zip(0..).map(|(&(_, corners), k)| (sorted(corners), k)));
        by_corners.sort_unstable();
        Ok(by_corners)
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        self.origin.capacity() * 4
            + self.touched.memory_bytes()
            + self.removed.capacity() * size_of::<(CellId, C)>()
            + self.turned.capacity() * size_of::<TurnedCell<C>>()
    }
}

/// Keeps of each cell how it was before it was turned over for the first time, in the order of the cells.
pub(super) fn keep_first_turns<C>(turned: &mut Vec<TurnedCell<C>>) {
    turned.sort_unstable_by_key(|event| (event.origin, event.at));
    turned.dedup_by_key(|event| event.origin);
    turned.iter_mut().for_each(|event| event.at = 0);
}

/// Gives the corners of a cell other ids, listed by the old ones; [`NO_VERTEX`] stays.
pub(in crate::motion) fn renumber<C: Corners<VertexId>>(row: &mut C, ids: &[VertexId]) {
    for v in row.as_mut() {
        *v = ids.get(v.index()).copied().unwrap_or(NO_VERTEX);
    }
}

fn sorted<C: Corners<VertexId>>(mut corners: C) -> C {
    corners.as_mut().sort_unstable();
    corners
}

/// The position in the list of removed cells of one with these sorted corners.
fn find<C: Corners<VertexId>>(by_corners: &[(C, u32)], corners: &C) -> Option<u32> {
    let at = by_corners.binary_search_by(|(there, _)| there.cmp(corners)).ok()?;
    Some(by_corners[at].1)
}
