//! Point location: the visibility walk.
//!
//! From a cell the walk crosses the first facet that has the point strictly beyond it. In a Delaunay
//! triangulation, ties broken by a perturbation included, such a walk cannot cycle (Edelsbrunner,
//! 10.1007/BF02122779), so it needs no randomness. It ends in a cell whose closure holds the point, or in a
//! ghost cell whose facet has the point strictly beyond it.

use super::{Delaunay, Dimension, IndexSet};
use crate::complex::{Cell, Complex, Corners};
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

impl<G: Dimension> Delaunay<G> {
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

    /// The site of a finite cell that is at `q`.
    #[inline(always)]
    pub(super) fn corner_at(&self, cell: Slot, q: &G::Point) -> Option<SiteId> {
        let c = self.complex.cell(cell);
        if c.is_ghost() {
            return None;
        }
        (0..G::Corners::N).map(|i| c.corners[i]).find(|&s| self.site(s).point == *q)
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
        if (0..G::D).all(|k| self.lower[k] <= q[k] && q[k] <= self.upper[k]) {
            return self.filter;
        }
        let (mut lower, mut upper) = (self.lower, self.upper);
        for k in 0..G::D {
            lower[k] = lower[k].min(q[k]);
            upper[k] = upper[k].max(q[k]);
        }
        G::filter(&lower, &upper)
    }

    /// Calls `visit` for each cell around a site, ghost cells included, with the index of the site in it.
    pub fn for_star(&self, s: SiteId, mut visit: impl FnMut(Slot, usize)) -> Result<()> {
        let mut star = IndexSet::new();
        self.list_star(s, &mut star, |_| {})?;
        for &cell in star.as_slice() {
            visit(cell, self.complex.cell(cell).index_of(s));
        }
        Ok(())
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

    /// Enters the cells around a site, ghost cells included, into an empty set. Calls `found` as soon as the slot of a
    /// cell is known, for some of them more than once.
    #[inline(always)]
    pub(crate) fn list_star(
        &self,
        s: SiteId,
        star: &mut IndexSet<Slot>,
        found: impl FnMut(Slot),
    ) -> Result<()> {
        if !self.has_cells() {
            return Ok(());
        }
        list_star(&self.complex, self.site(s).cell, s, star, found)
    }
}

/// Enters the cells around the site `s`, of which `first` is one, into an empty set. Calls `found` as soon as the slot
/// of a cell is known, for some of them more than once.
#[inline(always)]
pub(super) fn list_star<C: Corners>(
    complex: &Complex<C>,
    first: Slot,
    s: SiteId,
    star: &mut IndexSet<Slot>,
    mut found: impl FnMut(Slot),
) -> Result<()> {
    if C::N == 3 {
        return list_ring(complex, first, s, |cell, _| {
            found(cell);
            star.push(cell)
        });
    }
    found(first);
    star.spread(first, |cell| {
        let (_, others) = beside(complex, cell, s);
        others.map(|other| {
            complex.prefetch(other);
            found(other);
            other
        })
    })
}

/// Facets of a cell in space that are at one of its corners.
pub(super) const BESIDE: usize = 3;

/// The index of a site in a cell in space, and the cells beyond the facets at that corner. No branch depends on the
/// index.
#[inline(always)]
pub(super) fn beside<C: Corners>(complex: &Complex<C>, c: Slot, s: SiteId) -> (u8, [Slot; BESIDE]) {
    let cell = complex.cell(c);
    let at = cell.index_of(s);
    (at as u8, [1, 2, 3].map(|from| cell.neighbour((at + from) % C::N).cell()))
}

/// Calls `found` for the cells around a site in the plane, ghost cells included, of which `first` is one, with the
/// index of the site in each.
#[inline(always)]
pub(super) fn list_ring<C: Corners>(
    complex: &Complex<C>,
    first: Slot,
    s: SiteId,
    mut found: impl FnMut(Slot, usize) -> Result<()>,
) -> Result<()> {
    // Both ways around at once, so that the processor waits for two cells together. A facet tells where in the cell
    // beyond it is: the site is next to that, and so is the facet to cross then.
    let at = complex.cell(first).index_of(s);
    found(first, at)?;
    let (mut left, mut leaving_left) = (first, next_of_three(at));
    let (mut right, mut leaving_right) = (first, previous_of_three(at));
    loop {
        let facet = complex.cell(left).neighbour(leaving_left);
        (left, leaving_left) = (facet.cell(), previous_of_three(facet.index()));
        if left == right {
            return Ok(());
        }
        found(left, next_of_three(facet.index()))?;
        let facet = complex.cell(right).neighbour(leaving_right);
        (right, leaving_right) = (facet.cell(), next_of_three(facet.index()));
        if right == left {
            return Ok(());
        }
        found(right, previous_of_three(facet.index()))?;
    }
}

/// The corner of a triangle after this one.
#[inline(always)]
pub(super) fn next_of_three(i: usize) -> usize {
    0b00_10_01 >> (2 * i) & 3
}

/// The corner of a triangle before this one.
#[inline(always)]
pub(super) fn previous_of_three(i: usize) -> usize {
    0b01_00_10 >> (2 * i) & 3
}
