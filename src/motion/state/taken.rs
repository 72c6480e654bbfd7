//! The lists of changes that a program takes, made of what a [tracker](super::changes) knows.

use crate::complex::Corners;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::motion::state::changes::{NO_VERTEX, Tracker, keep_first_turns};
use crate::motion::state::marks::Marks;

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
