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

use super::{Cell, CellRange, Complex, Corners, Facet, INFINITE, Obstacle, Row};
use crate::ids::{SiteId, Slot};

impl CellRange<'_, [SiteId; 3]> {
    /// Replaces the edge between two finite cells by the one between its opposing vertices, and returns the edges on
    /// the boundary of both; the two cells keep their slots. With `p` at index `i` of `facet`'s cell `c`, then `b`,
    /// then `a`, and `q` across: `c` becomes `p b q` and its neighbour `q a p`. The rows before go to the end of the
    /// journal, which has room for two.
    pub(crate) fn flip_2_2(
        &mut self,
        facet: Facet,
        journal: &mut Vec<Row<[SiteId; 3]>>,
    ) -> Result<[Facet; 4], Obstacle> {
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
        journal.push(Row::of(c, &old));
        journal.push(Row::of(d, &beyond));
        self.cell_mut(c).corners[next(next(i))] = q;
        self.cell_mut(d).corners[next(next(j))] = p;
        self.glue(Facet::new(c, i), beyond_bq);
        self.glue(Facet::new(d, j), beyond_ap);
        self.glue(Facet::new(c, next(i)), Facet::new(d, next(j)));
        Ok([(c, i), (c, next(next(i))), (d, j), (d, next(next(j)))].map(|(cell, k)| Facet::new(cell, k)))
    }

    /// Glues two facets.
    #[inline(always)]
    fn glue(&mut self, a: Facet, b: Facet) {
        self.cell_mut(a.cell()).neighbours[a.index()] = b;
        self.cell_mut(b.cell()).neighbours[b.index()] = a;
    }
}

/// The rows before flips in space, each in the order in which it has changed three slots, of which the last may have
/// been free.
pub(crate) type Journal = Vec<Row<[SiteId; 4]>>;

/// The facets on the boundary of the cells of a 2-3 flip.
#[inline(always)]
pub(crate) fn outer_of_three([c, d, e]: [Slot; 3]) -> [Facet; 6] {
    [(c, 0), (c, 1), (d, 0), (d, 2), (e, 0), (e, 3)].map(|(cell, i)| Facet::new(cell, i))
}

/// The facets on the boundary of the cells of a 3-2 flip.
#[inline(always)]
pub(crate) fn outer_of_two([c, d]: [Slot; 2]) -> [Facet; 6] {
    [(c, 0), (c, 1), (c, 3), (d, 0), (d, 1), (d, 3)].map(|(cell, i)| Facet::new(cell, i))
}

impl CellRange<'_, [SiteId; 4]> {
    /// Replaces the two finite cells of a facet by three around the edge between their opposing
    /// vertices, and returns these. The caller knows that the exchange is geometrically valid. The rows before go to
    /// the end of the journal, which has room for three.
    ///
    /// (Returned, they would be copied several times, and read wider than they were written, which waits.)
    pub(crate) fn flip_2_3(&mut self, facet: Facet, journal: &mut Journal) -> Result<[Slot; 3], Obstacle> {
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
        let e = self.free.take_near(c).ok_or(Obstacle::Full)?;
        journal.push(Row::of(c, &old));
        journal.push(Row::of(d, &beyond));
        journal.push(Row::of(e, &Cell::free()));
        self.put_whole(c, [p, q, y, z], [dx, cx, Facet::new(d, 1), Facet::new(e, 1)]);
        self.put_whole(d, [p, x, q, z], [dy, Facet::new(c, 2), cy, Facet::new(e, 2)]);
        self.put_whole(e, [p, x, y, q], [dz, Facet::new(c, 3), Facet::new(d, 3), cz]);
        Ok([c, d, e])
    }

    /// Replaces the three cells around an edge by two that share the triangle around it, and returns these. The edge is
    /// opposite the two corners `k` and that of `facet` in the cell of `facet`. No change if it has not exactly three
    /// cells. The rows before go to the end of the journal, which has room for three.
    pub(crate) fn flip_3_2(
        &mut self,
        facet: Facet,
        k: usize,
        journal: &mut Journal,
    ) -> Result<[Slot; 2], Obstacle> {
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
        journal.push(Row::of(c, &old));
        journal.push(Row::of(d, &beyond));
        journal.push(Row::of(e, &behind));
        // q is last, as it may be the ghost vertex.
        self.put_whole(c, [p, k, l, q], [dm, em, Facet::new(d, 2), cm]);
        self.put_whole(d, [k, p, m, q], [el, dl, Facet::new(c, 2), cl]);
        self.cell_mut(e).corners = [SiteId::NONE; 4];
        self.free.put(e);
        Ok([c, d])
    }
}

impl CellRange<'_, [SiteId; 4]> {
    /// Replaces the edge opposite the corners `k` and that of `facet` in the cell of `facet`, with the four cells
    /// around it, by the edge between the opposing vertices of `facet`, and returns the cells of both flips. The caller
    /// knows that the corners of both edges are in one plane, where the edges cross. No change if the edge has not
    /// exactly four cells; the two that are not at `facet` may be ghosts. The rows before go to the end of the journal,
    /// which has room for six.
    pub(crate) fn flip_4_4(
        &mut self,
        facet: Facet,
        k: usize,
        journal: &mut Journal,
    ) -> Result<([Slot; 3], [Slot; 2]), Obstacle> {
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
        let first = self.flip_2_3(facet, journal)?;
        // The new cell that has not the corner k; the opposing vertex of the facet's cell is its first corner.
        let turn = (0..3).find(|&turn| AROUND[facet.index()][turn] == k).expect("a corner of the facet");
        let flat = first[turn];
        let at = self.cell(flat)?.index_of(q);
        let second = self.flip_3_2(Facet::new(flat, 0), at, journal).expect("three cells, all of them here");
        Ok((first, second))
    }
}

impl<C: Corners> Complex<C> {
    /// Takes changes back by the rows that they changed, the latest first.
    pub(crate) fn undo_rows(&mut self, rows: impl Iterator<Item = Row<C>>) {
        for row in rows {
            self.n_ghosts -= usize::from(self.cell(row.slot).is_ghost());
            self.n_ghosts += usize::from(row.corners[C::N - 1] == INFINITE);
            self.put_back(row);
        }
    }
}

/// The indices other than each, so that it and they are an even permutation.
const AROUND: [[usize; 3]; 4] = [[1, 2, 3], [2, 0, 3], [0, 1, 3], [2, 1, 0]];

mod replacing;
#[cfg(test)]
mod tests;
