//! The cells around a site, listed without marks: for questions, which may not write any.

use super::{Delaunay, Geometry, IndexSet};
use crate::complex::{Complex, Corners};
use crate::error::Result;
use crate::ids::{SiteId, Slot};

impl<G: Geometry> Delaunay<G> {
    /// Calls `visit` for each cell around a site, ghost cells included, with the index of the site in it.
    pub fn for_star(&self, s: SiteId, mut visit: impl FnMut(Slot, usize)) -> Result<()> {
        let mut star = IndexSet::new();
        self.list_star(s, &mut star, |_| {})?;
        for &cell in star.as_slice() {
            visit(cell, self.complex.cell(cell).index_of(s));
        }
        Ok(())
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
        if !self.has_cells() || self.is_hidden(s) {
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
