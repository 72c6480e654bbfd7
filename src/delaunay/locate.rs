//! Point location: the visibility walk.
//!
//! From a cell the walk crosses the first facet that has the point strictly beyond it. In a Delaunay
//! triangulation, ties broken by a perturbation included, such a walk cannot cycle (Edelsbrunner,
//! 10.1007/BF02122779), so it needs no randomness. It ends in a cell whose closure holds the point, or in a
//! ghost cell whose facet has the point strictly beyond it.

use super::{Delaunay, Geometry, IndexSet};
use crate::complex::{Cell, Corners};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::prefetch::{CACHE_BYTES, prefetch};
use crate::predicates::StaticFilter;

/// Cells between those of which one thing and the next are asked for.
const STEP: usize = 6;

/// Where a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// At this site.
    Site(SiteId),
    /// At no site, in the closure of this finite cell.
    Cell(Slot),
    /// Strictly beyond the hull facet of this ghost cell.
    Outside(Slot),
    /// At no site, and there are no cells.
    NoCells,
}

impl<G: Geometry> Delaunay<G> {
    /// Cell where a walk to `q` from the cell `start` ends. `f` must hold for `q`. Counts its steps.
    #[inline(always)]
    pub(super) fn walk(&self, f: &StaticFilter, q: &G::Point, start: Slot, steps: &mut u64) -> Slot {
        // Whichever cell is next comes while it is found out which that is.
        let is_enough = |cell| {
            self.complex.prefetch_neighbours(cell);
            false
        };
        self.walk_until(f, q, start, steps, is_enough).0
    }

    /// Cell where a walk to `q` from the cell `start` ends, at the latest in a finite cell that is enough; and whether
    /// it ended in one. `f` must hold for `q`. Counts its steps.
    #[inline(always)]
    pub(super) fn walk_until(
        &self,
        f: &StaticFilter,
        q: &G::Point,
        start: Slot,
        steps: &mut u64,
        is_enough: impl Fn(Slot) -> bool,
    ) -> (Slot, bool) {
        let n = G::Corners::N;
        let mut cell = start;
        if self.complex.cell(cell).is_ghost() {
            cell = self.complex.cell(cell).neighbour(Self::LAST).cell();
        }
        let mut entered = n;
        'cells: loop {
            if is_enough(cell) {
                return (cell, true);
            }
            let c = self.complex.cell(cell);
            for i in 0..n {
                if i != entered && G::orientation_with(f, self.view(), &c.corners, i, q) < 0.0 {
                    *steps += 1;
                    let next = c.neighbour(i);
                    cell = next.cell();
                    if self.complex.cell(cell).is_ghost() {
                        return (cell, false);
                    }
                    entered = next.index();
                    continue 'cells;
                }
            }
            return (cell, false);
        }
    }

    /// Enters the finite cells that have a place in their closure, of which `start` is one, into an empty set.
    pub(crate) fn list_cells_at(&self, q: &G::Point, start: Slot, cells: &mut IndexSet<Slot>) -> Result<()> {
        cells.insert(start)?;
        let mut next = 0;
        while let Some(&cell) = cells.as_slice().get(next) {
            next += 1;
            let row = self.complex.cell(cell);
            for i in 0..G::Corners::N {
                let beyond = row.neighbour(i).cell();
                if G::orientation_with(&self.filter, self.view(), &row.corners, i, q) == 0.0
                    && !self.complex.cell(beyond).is_ghost()
                {
                    cells.insert(beyond)?;
                }
            }
        }
        Ok(())
    }

    /// Whether `q` is in the closure of a finite cell, which is positive.
    pub(super) fn has_place(&self, cell: Slot, q: &G::Point) -> bool {
        let corners = &self.complex.cell(cell).corners;
        (0..G::Corners::N).all(|i| G::orientation_with(&self.filter, self.view(), corners, i, q) >= 0.0)
    }

    /// The site of a finite cell that is at `q`.
    #[inline(always)]
    pub(super) fn corner_at(&self, cell: Slot, q: &G::Point) -> Option<SiteId> {
        let c = self.complex.cell(cell);
        if c.is_ghost() {
            return None;
        }
        (0..G::Corners::N).map(|i| c.corners[i]).find(|&s| self.site(s).point.as_ref() == q.as_ref())
    }

    /// Where a point lies; `near` is a cell that may be near it, [`Slot::NONE`] if none is known.
    pub fn locate(&self, q: &G::Point, near: Slot) -> Place {
        if !self.has_cells() {
            return self.flat.site_at(q).map_or(Place::NoCells, Place::Site);
        }
        let filter = self.filter_for(q);
        let start = self.cell_towards(q, if near == Slot::NONE { self.recent } else { near });
        let mut steps = 0;
        let cell = if self.is_constrained {
            self.walk_straight(&filter, q, start)
        } else {
            self.walk(&filter, q, start, &mut steps)
        };
        self.note_walk(q, cell, steps);
        match self.corner_at(cell, q) {
            Some(s) => Place::Site(s),
            None if self.complex.cell(cell).is_ghost() => Place::Outside(cell),
            None => Place::Cell(cell),
        }
    }

    /// The static filter, widened where a point lies outside the box that it was made for.
    pub(crate) fn filter_for(&self, q: &G::Point) -> StaticFilter {
        if (0..G::NUMBERS).all(|k| self.lower[k] <= q[k] && q[k] <= self.upper[k]) {
            return self.filter;
        }
        let (mut lower, mut upper) = (self.lower, self.upper);
        for k in 0..G::NUMBERS {
            lower[k] = lower[k].min(q[k]);
            upper[k] = upper[k].max(q[k]);
        }
        G::filter(&lower, &upper)
    }

    /// Whether sites and cells are too many to stay in a cache near the processor.
    #[inline(always)]
    pub(crate) fn is_far(&self) -> bool {
        size_of_val(&*self.sites) > CACHE_BYTES
    }

    /// Bytes of sites and cells.
    pub(crate) fn bytes_read(&self) -> usize {
        self.complex.n_slots() * size_of::<Cell<G::Corners>>() + size_of_val(&*self.sites)
    }

    /// Asks for what a relocation of a site reads first, besides its star: the sites of the link and the cells beyond
    /// it.
    #[inline(always)]
    pub(crate) fn prefetch_around(&self, s: SiteId, star: &IndexSet<Slot>) {
        if !self.is_far() {
            return;
        }
        for &c in star.as_slice() {
            self.prefetch_across(c, self.complex.cell(c).index_of(s));
        }
    }

    /// Asks for the corners of a cell, and for the neighbour opposite one of them.
    #[inline(always)]
    pub(super) fn prefetch_across(&self, c: Slot, at: usize) {
        self.complex.prefetch(self.complex.cell(c).neighbour(at).cell());
        self.prefetch_corners(c);
    }

    /// Asks for what the relocation of a site will read first, in as many calls as there are steps in turn: the site, a
    /// cell of it, and the cells next to that with their corners.
    #[inline(always)]
    pub(crate) fn prefetch_star(&self, s: SiteId, step: usize) {
        match step {
            0 => prefetch(&self.sites, s.index()),
            // What is hidden has no star.
            _ if G::HAS_WEIGHTS && self.site(s).cell == Slot::NONE => {}
            1 => self.complex.prefetch(self.site(s).cell),
            2 => self.complex.prefetch_neighbours(self.site(s).cell),
            _ => {
                let first = self.complex.cell(self.site(s).cell);
                for i in 0..G::Corners::N {
                    let next = first.neighbour(i).cell();
                    self.prefetch_corners(next);
                    self.complex.prefetch_neighbours(next);
                }
            }
        }
    }

    /// Asks for what an exchange of the listed cells after the `k`-th one will read: the cells, their neighbours, and
    /// the corners of both.
    #[inline(always)]
    pub(super) fn prefetch_around_cells(&self, cells: &[Slot], k: usize) {
        if let Some(&c) = cells.get(k + 3 * STEP) {
            self.complex.prefetch(c);
        }
        if let Some(&c) = cells.get(k + 2 * STEP) {
            self.complex.prefetch_neighbours(c);
            self.prefetch_corners(c);
        }
        if let Some(&c) = cells.get(k + STEP) {
            self.prefetch_apexes(c);
        }
    }

    /// Asks for what a visit of all cells in the order of their slots will read some slots after `c`: cells, their
    /// neighbours, and the corners of both.
    #[inline(always)]
    pub(crate) fn prefetch_around_cells_after(&self, c: Slot) {
        if let Some(c) = self.prefetch_neighbours_after(c) {
            self.prefetch_corners(c);
        }
        if let Some(c) = self.slot_after(c, STEP) {
            self.prefetch_apexes(c);
        }
    }

    /// Asks for the neighbours of a cell some slots after `c`, even if they do not exist; returns that cell.
    #[inline(always)]
    pub(super) fn prefetch_neighbours_after(&self, c: Slot) -> Option<Slot> {
        let c = self.slot_after(c, 2 * STEP)?;
        self.complex.prefetch_neighbours(c);
        Some(c)
    }

    /// The slot `n` after this one, if there is any.
    #[inline(always)]
    fn slot_after(&self, c: Slot, n: usize) -> Option<Slot> {
        Some(Slot::at(c.index() + n)).filter(|c| c.index() < self.complex.n_slots())
    }

    /// Asks for the sites beyond the facets of a cell, unless it is free.
    #[inline(always)]
    fn prefetch_apexes(&self, c: Slot) {
        if self.complex.is_free(c) {
            return;
        }
        let cell = self.complex.cell(c);
        for i in 0..G::Corners::N {
            prefetch(&self.sites, self.complex.apex(cell.neighbour(i)).index());
        }
    }

    /// Asks for the corners of a cell.
    #[inline(always)]
    pub(crate) fn prefetch_corners(&self, c: Slot) {
        for &corner in self.complex.cell(c).corners.as_ref() {
            prefetch(&self.sites, corner.index());
        }
    }
}
