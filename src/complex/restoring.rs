//! A complex from the rows of its finite cells: the ghost cells around them are found, not listed.
//!
//! The rows may come from anywhere. What is returned is closed and keeps the invariants of the module, and its cells
//! are oriented alike: those on the two sides of a facet see it from different sides.
//!
//! Cost: a pass over the rows, and around each ridge of the hull two over the cells there, whatever the rows hold: they
//! are gone around only where all gluings are one to one.

use super::free::FreeSlots;
use super::record::Record;
use super::{Cell, Complex, Corners, Facet, INFINITE, MAX_CELLS};
use crate::damage::{Damage, LoadError};
use crate::error::Error;
use crate::ids::{CellId, SiteId, Slot};
use crate::machine::aligned::Aligned;
use crate::machine::memory;
use crate::machine::prefetch::{AHEAD, prefetch};

/// Cells between two calls of a monitor.
const MONITORED: usize = 1 << 16;

/// Where corner `a` of a cell is in the ghost cell at its facet opposite corner `i`.
fn place_in_ghost(n: usize, i: usize, a: usize) -> usize {
    match a {
        0 | 1 if i == n - 1 => 1 - a,
        _ if a == n - 1 => i,
        _ => a,
    }
}

/// The corners of the ghost cell at the facet opposite corner `i`: those of the facet as seen from outside.
fn ghost_of<C: Corners>(corners: &C, i: usize) -> C {
    let mut ghost = C::filled(INFINITE);
    for a in (0..C::N).filter(|&a| a != i) {
        ghost[place_in_ghost(C::N, i, a)] = corners[a];
    }
    ghost
}

/// The corners of the facet opposite each corner, all seen from the same side; in the plane there are two.
const FACETS: [[[usize; 3]; 4]; 2] =
    [[[1, 2, 0], [2, 0, 0], [0, 1, 0], [0, 0, 0]], [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]];

/// Whether two cells meet in the facets opposite corners `i` and `j`, each on its own side: the facets have the same
/// corners, in orders of opposite orientation. Without branches, as the orders are random. The corners of each cell are
/// distinct.
#[inline(always)]
fn meet<C: Corners>(one: &C, i: usize, other: &C, j: usize) -> bool {
    let facets = &FACETS[C::N - 3];
    let [a, b, c] = facets[i].map(|k| one[k]);
    let [x, y, z] = facets[j].map(|k| other[k]);
    if C::N == 3 {
        return (a == y) & (b == x);
    }
    ((a == x) & (b == z) & (c == y)) | ((a == y) & (b == x) & (c == z)) | ((a == z) & (b == y) & (c == x))
}

/// The only place of a number in a row, if it has one.
#[inline(always)]
fn place_of<N: Corners<CellId>>(row: &N, cell: CellId) -> Option<usize> {
    let (mut place, mut n_found) = (0, 0);
    for j in 0..N::N {
        let is_there = usize::from(row[j] == cell);
        place |= j * is_there;
        n_found += is_there;
    }
    (n_found == 1).then_some(place)
}

impl<C: Corners> Complex<C> {
    /// The complex of finite cells with these corners, distinct in each, and these neighbours, opposite each corner:
    /// [`CellId::NONE`] at the hull. Cell k gets slot k, the ghost cells follow. `monitor` is called with the fraction
    /// done; if it returns `false`, this ends in [`Error::Cancelled`].
    pub(crate) fn of_rows<N: Corners<CellId>>(
        corners: impl ExactSizeIterator<Item = Result<C, LoadError>>,
        neighbours: &[N],
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Self, LoadError> {
        let n = neighbours.len();
        debug_assert_eq!(corners.len(), n);
        let at_hull = |row: &N| row.as_ref().iter().filter(|&&across| across == CellId::NONE).count();
        let n_ghosts = neighbours.iter().map(at_hull).sum::<usize>();
        if n + n_ghosts > MAX_CELLS {
            return Err(Error::TooManyCells { limit: MAX_CELLS }.into());
        }
        let (mut cells, mut marks, mut free) = (Aligned::new(), Vec::new(), FreeSlots::default());
        cells.reserve_exact(n + n_ghosts)?;
        memory::reserve_exact(&mut marks, cells.capacity())?;
        free.cover(cells.capacity())?;
        let all = (2 * n + n_ghosts) as f64;
        let mut go_on = |done: usize| {
            let is_wanted = !done.is_multiple_of(MONITORED) || monitor(done as f64 / all);
            if is_wanted { Ok(()) } else { Err(Error::Cancelled) }
        };
        for (c, corners) in corners.enumerate() {
            go_on(c)?;
            cells.push(Cell { corners: corners?, ..Cell::free() });
        }
        marks.resize(n + n_ghosts, 0);
        let mut complex = Complex { cells, marks, free, n_ghosts, record: Record::default() };
        for (c, row) in neighbours.iter().enumerate() {
            go_on(n + c)?;
            if let Some(later) = neighbours.get(c + AHEAD) {
                for i in 0..C::N {
                    prefetch(&complex.cells, later[i].index());
                    prefetch(neighbours, later[i].index());
                }
            }
            if let Err(i) = complex.glue_cell(neighbours, c) {
                return Err(Damage::Neighbour { cell: CellId::at(c), corner: i, given: row[i] }.into());
            }
        }
        for g in n..n + n_ghosts {
            go_on(n + g)?;
            complex.glue_ghost(Slot::at(g), n);
        }
        Ok(complex)
    }

    /// Notes the facets that cell `c` touches, of its neighbours and of new ghost cells; if there is one that it does
    /// not meet, the corner opposite it.
    ///
    /// Each cell is looked at from both sides of every facet, which finds the same: a cell has one place in the row of
    /// its neighbour. So only cell `c` is written to, and nothing depends on which cell is first, as that is random.
    #[inline(always)]
    fn glue_cell<N: Corners<CellId>>(&mut self, neighbours: &[N], c: usize) -> Result<(), usize> {
        let (row, corners) = (neighbours[c], self.cells[c].corners);
        let mut facets = C::Of::<Facet>::filled(Facet::NONE);
        for i in 0..C::N {
            let d = row[i].index();
            let Some(back) = neighbours.get(d) else {
                if row[i] != CellId::NONE {
                    return Err(i);
                }
                facets[i] = self.add_ghost(Facet::new(Slot::at(c), i));
                continue;
            };
            match place_of(back, CellId::at(c)) {
                Some(j) if meet(&corners, i, &self.cells[d].corners, j) => {
                    facets[i] = Facet::new(Slot::at(d), j);
                }
                _ => return Err(i),
            }
        }
        self.cells[c].neighbours = facets;
        Ok(())
    }

    /// A new ghost cell at a facet: its own side of it.
    #[cold]
    #[inline(never)]
    fn add_ghost(&mut self, facet: Facet) -> Facet {
        let corners = ghost_of(&self.cells[facet.cell()].corners, facet.index());
        let mut ghost = Cell { corners, ..Cell::free() };
        ghost.neighbours[C::N - 1] = facet;
        self.cells.push(ghost);
        Facet::new(Slot::at(self.cells.len() - 1), C::N - 1)
    }

    /// Glues the ridges of a ghost cell to those of others, where `n` finite cells are glued to each other: around a
    /// ridge, from one finite cell to the next, until there is none. As each gluing is one to one that comes to an end,
    /// and not where it began.
    fn glue_ghost(&mut self, ghost: Slot, n: usize) {
        let at_hull = self.cells[ghost].neighbours[C::N - 1];
        for a in (0..C::N).filter(|&a| a != at_hull.index()) {
            // The ridge is the cell without corners `i` and `b`; it is left through the facet opposite `b`.
            let (mut c, mut i, mut b) = (at_hull.cell(), at_hull.index(), a);
            let other = loop {
                let out = self.cells[c].neighbours[b];
                if out.cell().index() >= n {
                    break out.cell();
                }
                let kept: SiteId = self.cells[c].corners[i];
                (c, i, b) = (out.cell(), out.index(), self.cells[out.cell()].index_of(kept));
            };
            let ridge = Facet::new(ghost, place_in_ghost(C::N, at_hull.index(), a));
            self.glue(ridge, Facet::new(other, place_in_ghost(C::N, b, i)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ghost_has_the_corners_of_its_facet_and_the_opposite_orientation() {
        let cell = [5, 6, 7, 8].map(SiteId::new);
        for i in 0..4 {
            let ghost = ghost_of(&cell, i);
            assert_eq!(ghost[3], INFINITE);
            assert!((0..4).all(|a| a == i || ghost[place_in_ghost(4, i, a)] == cell[a]));
            assert!(meet(&cell, i, &ghost, 3), "{i}: {ghost:?}");
        }
        let cell = [5, 6, 7].map(SiteId::new);
        assert!((0..3).all(|i| meet(&cell, i, &ghost_of(&cell, i), 2)));
    }

    #[test]
    fn cells_meet_only_on_different_sides_of_a_facet() {
        let cell = [1, 2, 3].map(SiteId::new);
        assert!(meet(&cell, 2, &[2, 1, 4].map(SiteId::new), 2));
        assert!(!meet(&cell, 2, &[1, 2, 4].map(SiteId::new), 2));
        assert!(!meet(&cell, 2, &[2, 4, 1].map(SiteId::new), 1));
        assert!(meet(&cell, 2, &[1, 4, 2].map(SiteId::new), 1));
        assert!(!meet(&cell, 2, &[2, 5, 4].map(SiteId::new), 2));
    }
}
