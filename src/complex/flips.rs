//! Flips: the smallest exchanges of cells that keep the boundary of their union.
//!
//! ```text
//!        p                 p
//!       /|\               / \
//!      / | \    2-2      / c \
//!     a c|d b' -->      a-----b'     (in the plane the diagonal changes ends)
//!      \ | /             \ d /
//!       \|/               \ /
//! ```
//!
//! In space a 2-3 flip replaces the facet between two cells by the edge between their opposing vertices,
//! and a 3-2 flip the other way round. A 4-4 flip is both in a row, by way of a cell whose corners are in one plane: it
//! changes the diagonal of a quadrilateral that has two cells on each side, which on one side may be ghosts.

pub(crate) use replacing::NewCell;

use super::{Cell, Complex, Corners, Facet, INFINITE, Row};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::machine::prefetch::prefetch;
use crate::machine::threads;
use std::sync::Mutex;

/// Why a facet was not flipped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obstacle {
    /// The cells there are not such that a flip makes positive ones.
    Shape,
    /// A cell would change that is not of the range.
    OtherRange,
    /// The range has no free cell.
    Full,
    /// There is no memory for undoing.
    Memory,
}

/// Cells that follow each other in storage, for one thread to flip while others flip the rest. A flip changes two to
/// four cells and the neighbours' side of their gluings; it is done only if all of these are of the range.
#[derive(Debug)]
pub struct CellRange<'c, C: Corners> {
    /// Slot of the first one.
    first: Slot,
    cells: &'c mut [Cell<C>],
    /// Those of them that are free.
    free: &'c mut Vec<Slot>,
}

impl<C: Corners> Complex<C> {
    /// All cells.
    pub(crate) fn whole(&mut self) -> CellRange<'_, C> {
        CellRange { first: Slot::new(0), cells: &mut self.cells, free: &mut self.free }
    }

    /// Works on the ranges that begin at these cells, the first of them cell 0, each on a thread of its own and with
    /// its own one of `parts`. After an error the list of free cells [has to be restored](Self::restore_free).
    pub(crate) fn divided<P: Send>(
        &mut self,
        starts: &[Slot],
        parts: &mut [P],
        work: impl Fn(usize, &mut CellRange<C>, &mut P) + Sync,
    ) -> Result<()> {
        let (mut free, mut all) = (Vec::<Vec<Slot>>::new(), Vec::new());
        memory::reserve_exact(&mut free, starts.len())?;
        memory::reserve_exact(&mut all, starts.len())?;
        free.resize_with(starts.len(), Vec::new);
        for &c in &self.free {
            memory::push(&mut free[starts.partition_point(|&start| start <= c) - 1], c)?;
        }
        self.free.clear();
        let mut rest = &mut self.cells[..];
        for (k, (free, part)) in free.iter_mut().zip(parts).enumerate() {
            let n = starts.get(k + 1).map_or(rest.len(), |end| end.index() - starts[k].index());
            let cells;
            (cells, rest) = rest.split_at_mut(n);
            all.push(Mutex::new((CellRange { first: starts[k], cells, free }, part)));
        }
        threads::for_each(0..starts.len(), &|k| {
            let (range, part) = &mut *all[k].lock().expect("each is locked once");
            work(k, range, part);
        });
        drop(all);
        self.reserve_free(free.iter().map(Vec::len).sum())?;
        self.free.extend(free.into_iter().flatten());
        Ok(())
    }

    /// Adds `n` cells, all of them free; they are used after those that are free already, whose order
    /// [`undo_flips`](Self::undo_flips) relies on. As they stay when flips are undone, there is room in the list for
    /// those, too, that come back then: at most as many as there are `rows` in the journal.
    pub(crate) fn create_free(&mut self, n: usize, rows: usize) -> Result<()> {
        self.reserve(self.free.len() + n)?;
        self.reserve_free(n + rows)?;
        let first = self.cells.len();
        self.cells.lengthen(first + n, Cell::free());
        self.marks.resize(first + n, 0);
        self.free.splice(0..0, Slot::range(first..first + n));
        Ok(())
    }

    /// The free slots.
    pub(crate) fn free_cells(&self) -> &[Slot] {
        &self.free
    }
}

impl<C: Corners> CellRange<'_, C> {
    /// Position in the range; beyond its end for a cell that is not of it.
    #[inline(always)]
    fn position(&self, cell: Slot) -> usize {
        cell.get().wrapping_sub(self.first.get()) as usize
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
    fn cell_mut(&mut self, cell: Slot) -> &mut Cell<C> {
        let at = self.position(cell);
        &mut self.cells[at]
    }

    /// An error if one of these cells is not of the range.
    #[inline(always)]
    fn has_cells_of(&self, facets: &[Facet]) -> Result<(), Obstacle> {
        let has = |facet: &Facet| self.position(facet.cell()) < self.cells.len();
        if facets.iter().all(has) { Ok(()) } else { Err(Obstacle::OtherRange) }
    }

    /// Puts a cell, and both sides of all gluings.
    #[inline(always)]
    fn put_whole(&mut self, cell: Slot, corners: C, neighbours: C::Of<Facet>) {
        *self.cell_mut(cell) = Cell { alignment: [], corners, neighbours };
        for (i, out) in neighbours.as_ref().iter().enumerate() {
            self.cell_mut(out.cell()).neighbours[out.index()] = Facet::new(cell, i);
        }
    }
}

/// What a flip in the plane has put there, and the rows before.
type Swapped = ([Facet; 4], [Row<[SiteId; 3]>; 2]);

impl CellRange<'_, [SiteId; 3]> {
    /// Replaces the edge between two finite cells by the one between its opposing vertices, and returns the edges on
    /// the boundary of both; the two cells keep their slots. With `p` at index `i` of `facet`'s cell `c`, then `b`,
    /// then `a`, and `q` across: `c` becomes `p b q` and its neighbour `q a p`.
    pub(crate) fn flip_2_2(&mut self, facet: Facet) -> Result<Swapped, Obstacle> {
        let (c, i) = (facet.cell(), facet.index());
        let old = *self.cell(c)?;
        let across = old.neighbour(i);
        let (d, j) = (across.cell(), across.index());
        let beyond = *self.cell(d)?;
        debug_assert!(!old.is_ghost() && !beyond.is_ghost());
        let next = |k: usize| (k + 1) % 3;
        let (p, q) = (old.corners[i], beyond.corners[j]);
        let (beyond_bq, beyond_ap) = (beyond.neighbours[next(j)], old.neighbours[next(i)]);
        self.has_cells_of(&[beyond_bq, beyond_ap])?;
        self.cell_mut(c).corners[next(next(i))] = q;
        self.cell_mut(d).corners[next(next(j))] = p;
        self.glue(Facet::new(c, i), beyond_bq);
        self.glue(Facet::new(d, j), beyond_ap);
        self.glue(Facet::new(c, next(i)), Facet::new(d, next(j)));
        let outer =
            [(c, i), (c, next(next(i))), (d, j), (d, next(next(j)))].map(|(cell, k)| Facet::new(cell, k));
        Ok((outer, [Row::of(c, &old), Row::of(d, &beyond)]))
    }

    /// Glues two facets.
    #[inline(always)]
    fn glue(&mut self, a: Facet, b: Facet) {
        self.cell_mut(a.cell()).neighbours[a.index()] = b;
        self.cell_mut(b.cell()).neighbours[b.index()] = a;
    }
}

/// What a flip in space has changed: three slots as they were before, of which the last may have been free.
pub(crate) type Undo = [Row<[SiteId; 4]>; 3];

/// The rows of cells.
fn rows<C: Corners>(cells: [(Slot, Cell<C>); 3]) -> [Row<C>; 3] {
    cells.map(|(slot, cell)| Row::of(slot, &cell))
}

impl CellRange<'_, [SiteId; 4]> {
    /// Replaces the two finite cells of a facet by three around the edge between their opposing
    /// vertices, and returns the facets on the boundary of both. The caller knows that the exchange is
    /// geometrically valid.
    pub(crate) fn flip_2_3(&mut self, facet: Facet) -> Result<([Facet; 6], Undo), Obstacle> {
        let c = facet.cell();
        let old = *self.cell(c)?;
        let across = old.neighbour(facet.index());
        let d = across.cell();
        let beyond = *self.cell(d)?;
        let q = beyond.corners[across.index()];
        debug_assert!(!old.is_ghost() && !beyond.is_ghost());
        let around = AROUND[facet.index()];
        let [p, x, y, z] = [facet.index(), around[0], around[1], around[2]].map(|i| old.corners[i]);
        let [cx, cy, cz] = around.map(|i| old.neighbours[i]);
        let [dx, dy, dz] = [x, y, z].map(|s| beyond.neighbours[beyond.index_of(s)]);
        self.has_cells_of(&[cx, cy, cz, dx, dy, dz])?;
        let e = self.free.pop().ok_or(Obstacle::Full)?;
        self.put_whole(c, [p, q, y, z], [dx, cx, Facet::new(d, 1), Facet::new(e, 1)]);
        self.put_whole(d, [p, x, q, z], [dy, Facet::new(c, 2), cy, Facet::new(e, 2)]);
        self.put_whole(e, [p, x, y, q], [dz, Facet::new(c, 3), Facet::new(d, 3), cz]);
        let outer = [(c, 0), (c, 1), (d, 0), (d, 2), (e, 0), (e, 3)].map(|(cell, i)| Facet::new(cell, i));
        Ok((outer, rows([(c, old), (d, beyond), (e, Cell::free())])))
    }

    /// Replaces the three cells around an edge by two that share the triangle around it, and returns
    /// the facets on the boundary of both. The edge is opposite the two corners `k` and that of `facet` in
    /// the cell of `facet`. No change if it has not exactly three cells.
    pub(crate) fn flip_3_2(&mut self, facet: Facet, k: usize) -> Result<([Facet; 6], Undo), Obstacle> {
        let c = facet.cell();
        let old = *self.cell(c)?;
        let (across, third) = (old.neighbour(facet.index()), old.neighbour(k));
        let (d, e) = (across.cell(), third.cell());
        let (beyond, behind) = (*self.cell(d)?, *self.cell(e)?);
        let q = beyond.corners[across.index()];
        if behind.corners[third.index()] != q {
            return Err(Obstacle::Shape);
        }
        debug_assert!(!old.is_ghost() && beyond.is_ghost() == behind.is_ghost());
        // The corners of the facet in even order, k first.
        let around = AROUND[facet.index()];
        let turn = (0..3).find(|&turn| around[turn] == k).expect("a corner of the facet");
        let [l, m] = [around[(turn + 1) % 3], around[(turn + 2) % 3]];
        let [cl, cm] = [l, m].map(|i| old.neighbours[i]);
        let [p, k, l, m] = [facet.index(), k, l, m].map(|i| old.corners[i]);
        let [dl, dm] = [l, m].map(|s| beyond.neighbours[beyond.index_of(s)]);
        let [el, em] = [l, m].map(|s| behind.neighbours[behind.index_of(s)]);
        self.has_cells_of(&[cl, cm, dl, dm, el, em])?;
        memory::reserve(self.free, 1).map_err(|_| Obstacle::Memory)?;
        // q is last, as it may be the ghost vertex.
        self.put_whole(c, [p, k, l, q], [dm, em, Facet::new(d, 2), cm]);
        self.put_whole(d, [k, p, m, q], [el, dl, Facet::new(c, 2), cl]);
        self.cell_mut(e).corners = [SiteId::NONE; 4];
        self.free.push(e);
        let outer = [(c, 0), (c, 1), (c, 3), (d, 0), (d, 1), (d, 3)].map(|(cell, i)| Facet::new(cell, i));
        Ok((outer, rows([(c, old), (d, beyond), (e, behind)])))
    }
}

/// What two flips in a row have put there.
type Both = [([Facet; 6], Undo); 2];

impl CellRange<'_, [SiteId; 4]> {
    /// Replaces the edge opposite the corners `k` and that of `facet` in the cell of `facet`, with the four cells
    /// around it, by the edge between the opposing vertices of `facet`, and returns what both flips do. The caller
    /// knows that the corners of both edges are in one plane, where the edges cross. No change if the edge has not
    /// exactly four cells; the two that are not at `facet` may be ghosts.
    pub(crate) fn flip_4_4(&mut self, facet: Facet, k: usize) -> Result<Both, Obstacle> {
        let old = *self.cell(facet.cell())?;
        let across = old.neighbour(facet.index());
        let beyond = *self.cell(across.cell())?;
        let q = beyond.corners[across.index()];
        let below = [old.neighbour(k), beyond.neighbour(beyond.index_of(old.corners[k]))];
        let apexes = [self.apex(below[0])?, self.apex(below[1])?];
        if apexes[0] != apexes[1] {
            return Err(Obstacle::Shape);
        }
        // The second flip must not fail after the first.
        for facet in below {
            let neighbours = self.cell(facet.cell())?.neighbours;
            self.has_cells_of(&neighbours)?;
        }
        let first = self.flip_2_3(facet)?;
        // The new cell that has not the corner k; the opposing vertex of the facet's cell is its first corner.
        let turn = (0..3).find(|&turn| AROUND[facet.index()][turn] == k).expect("a corner of the facet");
        let flat = first.0[2 * turn].cell();
        let at = self.cell(flat)?.index_of(q);
        let second = self.flip_3_2(Facet::new(flat, 0), at).expect("three cells, all of them here");
        Ok([first, second])
    }
}

impl<C: Corners> Complex<C> {
    /// Takes flips back by the rows that they changed, the latest first. The list of free cells comes back as well if
    /// all were flips of the whole, and so does the number of ghosts.
    pub(crate) fn undo_flips(&mut self, rows: impl Iterator<Item = Row<C>>) {
        for row in rows {
            let was_free = self.is_free(row.slot);
            self.n_ghosts -= usize::from(self.cell(row.slot).is_ghost());
            self.n_ghosts += usize::from(row.corners[C::N - 1] == INFINITE);
            self.put_back(row);
            match (was_free, row.is_free()) {
                (false, true) => self.free.push(row.slot),
                (true, false) => drop(self.free.pop()),
                _ => {}
            }
        }
    }

    /// Puts rows back, and leaves the list of free cells to [`restore_free`](Self::restore_free).
    pub(crate) fn put_back_all(&mut self, rows: impl Iterator<Item = Row<C>>) {
        rows.for_each(|row| self.put_back(row));
    }

    /// Goes back to where there were this number of cells, with these free ones, after the cells have been
    /// [put back](Self::put_back_all).
    pub(crate) fn restore_free(&mut self, n_slots: usize, free: &[Slot]) {
        self.cells.truncate(n_slots);
        self.marks.truncate(n_slots);
        self.free.clear();
        self.free.extend_from_slice(free);
    }
}

/// The indices other than each, so that it and they are an even permutation.
const AROUND: [[usize; 3]; 4] = [[1, 2, 3], [2, 0, 3], [0, 1, 3], [2, 1, 0]];

mod replacing;
#[cfg(test)]
mod tests;
