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
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::motion::state::marks::Marks;

/// In place of an id: a vertex that has none any more.
pub const NO_VERTEX: VertexId = VertexId::NONE;

/// What has changed since a base.
#[derive(Debug)]
pub(in crate::motion) struct Tracker<C> {
    /// By index of a cell of now, its index at the base; [`CellId::NONE`] if it has been created since.
    origin: Vec<CellId>,
    /// Indices whose origin may be another one; some may be beyond the end.
    touched: Marks<CellId>,
    /// Cells of the base that have been removed: their indices and corners.
    removed: Vec<(CellId, C)>,
    /// How often the arrays have been refreshed since the base: a cell that goes in one refreshment may come back in
    /// another.
    n_refreshed: u32,
    /// How many cells have been given another index since the base.
    n_renumbered: usize,
    /// Cells of the base that have been turned over, and how their corners were listed before.
    turned: Vec<Turned<C>>,
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
struct Turned<C> {
    origin: CellId,
    /// Its place in the order of the events.
    at: u32,
    before: C,
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
            self.turned.push(Turned { origin, at: self.turned.len() as u32, before });
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
    fn origin_of(&self, index: CellId, corners: &[C], removed: &[(C, u32)]) -> Option<(CellId, Option<u32>)> {
        let origin = *self.origin.get(index.index())?;
        if origin != CellId::NONE || removed.is_empty() {
            return Some((origin, None));
        }
        let returned = find(removed, &sorted(corners[index]));
        Some((returned.map_or(CellId::NONE, |k| self.removed[k as usize].0), returned))
    }

    /// The row at the base of a cell that was there, given the one that was seen last.
    fn before(&self, origin: CellId, seen: C) -> C {
        let found = self.turned.binary_search_by_key(&origin, |event| event.origin);
        found.map_or(seen, |k| self.turned[k].before)
    }

    /// The removed cells that may have come back, by their sorted corners, each with its position in the list.
    fn sorted_removed(&self) -> Result<Vec<(C, u32)>> {
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
            + self.turned.capacity() * size_of::<Turned<C>>()
    }
}

/// Whether one row is an odd permutation of another one.
fn is_odd<C: Corners<VertexId>>(row: &C, other: &C) -> bool {
    let (mut row, mut is_odd) = (*row, false);
    for i in 0..C::N {
        let found = (i..C::N).find(|&k| row[k] == other[i]).unwrap_or(i);
        row.as_mut().swap(i, found);
        is_odd ^= found != i;
    }
    is_odd
}

/// Keeps of each cell how it was before it was turned over for the first time, in the order of the cells.
fn keep_first_turns<C>(turned: &mut Vec<Turned<C>>) {
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

/// What has changed since the program last took the changes. Indices are those of
/// [`cells`](crate::motion::MovingTriangulation::cells), at that time or now; vertices are in ascending order.
#[derive(Clone, Copy, Debug)]
pub struct Changes<'t, C> {
    /// Cells that exist now and did not: their indices.
    pub created: &'t [CellId],
    /// Cells that existed and do not now: the index that each had.
    pub removed: &'t [CellId],
    /// The corners of the removed cells, in the order in which each listed them when the program last took the changes.
    /// A vertex that was removed before a [compaction](crate::motion::MovingTriangulation::compact) has no id any more:
    /// it is [`NO_VERTEX`].
    pub removed_corners: &'t [C],
    /// Cells that existed and have another index now: the index that each had.
    pub renumbered_from: &'t [CellId],
    /// The index that each of the renumbered cells has now.
    pub renumbered_to: &'t [CellId],
    /// Vertices whose star has changed: those of all created and removed cells. Some may have been removed, after the
    /// latest compaction if there was one.
    pub stars: &'t [VertexId],
    /// Vertices that are hidden and were not.
    pub hidden: &'t [VertexId],
    /// Vertices that were hidden and are not.
    pub shown: &'t [VertexId],
}

/// The lists behind [`Changes`].
#[derive(Debug)]
pub(in crate::motion) struct Taken<C> {
    created: Vec<CellId>,
    removed: Vec<CellId>,
    removed_corners: Vec<C>,
    renumbered_from: Vec<CellId>,
    renumbered_to: Vec<CellId>,
    /// Cells that live and have been turned over, by their indices of now, and how they listed their corners.
    turned: Vec<(CellId, C)>,
    stars: Marks<VertexId>,
    hidden: Vec<VertexId>,
    shown: Vec<VertexId>,
}

impl<C> Default for Taken<C> {
    fn default() -> Self {
        Taken {
            created: Vec::new(),
            removed: Vec::new(),
            removed_corners: Vec::new(),
            renumbered_from: Vec::new(),
            renumbered_to: Vec::new(),
            turned: Vec::new(),
            stars: Marks::default(),
            hidden: Vec::new(),
            shown: Vec::new(),
        }
    }
}

impl<C: Corners<VertexId>> Taken<C> {
    fn clear(&mut self) {
        clear(&mut self.created);
        clear(&mut self.removed);
        clear(&mut self.removed_corners);
        clear(&mut self.renumbered_from);
        clear(&mut self.renumbered_to);
        clear(&mut self.turned);
        clear(&mut self.hidden);
        clear(&mut self.shown);
        let n_stars = self.stars.as_slice().len();
        self.stars.clear();
        self.stars.shrink_to(4 * n_stars + 1024);
    }

    /// Lists what a tracker knows of the cells, and the vertices of all cells listed; no vertex is hidden or shown yet.
    pub(in crate::motion) fn list(
        &mut self,
        tracker: &mut Tracker<C>,
        corners: &[C],
        n_ids: usize,
    ) -> Result<()> {
        self.clear();
        self.list_cells(tracker, corners)?;
        self.list_stars(corners, n_ids)
    }

    /// Makes room for this number of vertices hidden or shown.
    pub(in crate::motion) fn reserve_vertices(&mut self, n: usize) -> Result<()> {
        memory::reserve(&mut self.hidden, n)?;
        memory::reserve(&mut self.shown, n)
    }

    /// Enters a vertex that has been hidden or shown if it is not as before; there is room.
    pub(in crate::motion) fn list_vertex(&mut self, vertex: VertexId, was_hidden: bool, is_hidden: bool) {
        match (was_hidden, is_hidden) {
            (false, true) => self.hidden.push(vertex),
            (true, false) => self.shown.push(vertex),
            _ => {}
        }
    }

    /// The lists.
    pub(in crate::motion) fn changes(&self) -> Changes<'_, C> {
        Changes {
            created: &self.created,
            removed: &self.removed,
            removed_corners: &self.removed_corners,
            renumbered_from: &self.renumbered_from,
            renumbered_to: &self.renumbered_to,
            stars: self.stars.as_slice(),
            hidden: &self.hidden,
            shown: &self.shown,
        }
    }

    /// Cells that live and have been turned over, by their indices of now, and how they listed their corners.
    pub(in crate::motion) fn turned(&self) -> &[(CellId, C)] {
        &self.turned
    }

    /// Lists what a tracker knows.
    fn list_cells(&mut self, tracker: &mut Tracker<C>, corners: &[C]) -> Result<()> {
        let by_corners = tracker.sorted_removed()?;
        let (n_touched, n_removed) = (tracker.touched.as_slice().len(), tracker.removed.len());
        memory::reserve(&mut self.created, n_touched)?;
        let n_renumbered = n_touched.min(tracker.n_renumbered + by_corners.len());
        memory::reserve(&mut self.renumbered_from, n_renumbered)?;
        memory::reserve(&mut self.renumbered_to, n_renumbered)?;
        memory::reserve(&mut self.removed, n_removed)?;
        memory::reserve(&mut self.removed_corners, n_removed)?;
        let mut has_returned = Vec::new();
        memory::reserve_exact(&mut has_returned, by_corners.len())?;
        has_returned.resize(by_corners.len(), false);
        keep_first_turns(&mut tracker.turned);
        tracker.touched.sort();
        for &index in tracker.touched.as_slice() {
            let Some((origin, returned)) = tracker.origin_of(index, corners, &by_corners) else { break };
            if let Some(k) = returned {
                has_returned[k as usize] = true;
                let before = tracker.before(origin, tracker.removed[k as usize].1);
                memory::push(&mut self.turned, (index, before))?;
            }
            if origin == CellId::NONE {
                self.created.push(index);
            } else if origin != index {
                self.renumbered_from.push(origin);
                self.renumbered_to.push(index);
            }
        }
        self.list_turned(tracker, corners)?;
        for (k, &(origin, corners)) in tracker.removed.iter().enumerate() {
            if has_returned.get(k) == Some(&true) {
                continue;
            }
            self.removed.push(origin);
            self.removed_corners.push(tracker.before(origin, corners));
        }
        Ok(())
    }

    /// Lists the cells that live and are turned over; those that have come back are there, turned over or not.
    fn list_turned(&mut self, tracker: &Tracker<C>, corners: &[C]) -> Result<()> {
        if !tracker.turned.is_empty() {
            let (mut gone, mut moved) = (Vec::new(), Vec::new());
            memory::collect(&mut gone, tracker.removed.iter().map(|&(origin, _)| origin))?;
            gone.sort_unstable();
            let renumbered = self.renumbered_from.iter().zip(&self.renumbered_to);
            memory::collect(&mut moved, renumbered.map(|(&from, &to)| (from, to)))?;
            moved.sort_unstable();
            for event in tracker.turned.iter().filter(|event| gone.binary_search(&event.origin).is_err()) {
                let found = moved.binary_search_by_key(&event.origin, |&(from, _)| from);
                let index = found.map_or(event.origin, |k| moved[k].1);
                memory::push(&mut self.turned, (index, event.before))?;
            }
        }
        self.turned.retain(|(index, before)| is_odd(before, &corners[*index]));
        Ok(())
    }

    /// Lists the vertices of all cells that are listed.
    fn list_stars(&mut self, corners: &[C], n_ids: usize) -> Result<()> {
        let most = C::N * (self.created.len() + self.removed_corners.len());
        self.stars.reserve(most.min(n_ids), n_ids)?;
        let created = self.created.iter().enumerate().map(|(k, &index)| {
            if let Some(&later) = self.created.get(k + AHEAD) {
                prefetch(corners, later.index());
            }
            &corners[index]
        });
        let listed = created.chain(&self.removed_corners).flat_map(|row| row.as_ref());
        listed.filter(|v| **v != NO_VERTEX).for_each(|&v| self.stars.insert(v));
        self.stars.sort();
        Ok(())
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        let cells = [&self.created, &self.removed, &self.renumbered_from, &self.renumbered_to];
        let vertices = [&self.hidden, &self.shown];
        cells.map(memory::bytes_of).iter().chain(&vertices.map(memory::bytes_of)).sum::<usize>()
            + self.removed_corners.capacity() * size_of::<C>()
            + self.turned.capacity() * size_of::<(CellId, C)>()
            + self.stars.memory_bytes()
    }
}

/// Empties a list; its memory is kept unless it has been of little use.
fn clear<T>(list: &mut Vec<T>) {
    if list.capacity() > 4 * list.len() + 1024 {
        *list = Vec::new();
    }
    list.clear();
}
