//! Sites above the cells find the cells that are below them, or come to be corners again; see [`above`](super::above).

use super::cavity::Cavity;
use super::geometry::Insert;
use super::{Delaunay, Geometry, IndexSet};
use crate::error::Result;
use crate::ids::{SiteId, Slot};

/// How many hidden sites are looked at to find out whether one is alone at its place.
const MOST_LOOKED_AT: usize = 256;

impl<G: Geometry> Delaunay<G> {
    /// The cell below a hidden site.
    pub fn cell_below(&self, s: SiteId) -> Slot {
        let (cell, is_loose) = self.above.link(s);
        if is_loose { self.cell_over(s) } else { cell }
    }

    /// Loosens the sites above the cells around a site, which has moved and leaves them as they are.
    pub(crate) fn loosen_around(&mut self, s: SiteId) -> Result<()> {
        if !G::HAS_WEIGHTS || self.above.count() == 0 {
            return Ok(());
        }
        if self.is_hidden(s) {
            self.loosen_site(s);
            return Ok(());
        }
        self.gather_star(s)?;
        self.loosen_star();
        Ok(())
    }

    /// Whether no other site is at the place of a live one, while there are cells and none is loose; `false` as well
    /// where that would take long to find out.
    pub(crate) fn is_alone(&mut self, s: SiteId) -> Result<bool> {
        let place = self.site(s).point;
        let mut cells = IndexSet::new();
        if self.is_hidden(s) {
            let below = self.cell_below(s);
            if self.corner_at(below, &place).is_some() {
                return Ok(false);
            }
            self.list_cells_at(&place, below, &mut cells)?;
        } else {
            self.gather_star(s)?;
            self.star.iter().try_for_each(|&(cell, _)| cells.insert(cell).map(drop))?;
        }
        let mut there = cells.as_slice().iter().flat_map(|&cell| self.sites_above(cell));
        let is_other = |other: SiteId| other != s && self.site(other).point.as_ref() == place.as_ref();
        Ok(!there.by_ref().take(MOST_LOOKED_AT).any(is_other) && there.next().is_none())
    }

    /// How many sites are loose.
    #[cfg(test)]
    pub(crate) fn n_loose(&self) -> usize {
        self.hidden_sites().filter(|&s| self.above.link(s).1).count()
    }

    /// Finds the cell at the place of each loose site, and inserts the sites that are below it, which `shown` is told. After an error those
    /// that are left are loose still.
    pub fn settle(&mut self, mut shown: impl FnMut(SiteId) -> Result<()>) -> Result<()> {
        if !G::HAS_WEIGHTS || !self.has_cells() {
            return Ok(());
        }
        while self.has_loose() {
            self.go_on()?;
            self.make_room_to_hide()?;
            let s = self.above.first_loose();
            let cell = self.cell_over(s);
            if self.is_above(s, cell) {
                self.settle_above(s, cell);
                continue;
            }
            let mut cavity = std::mem::take(&mut self.cavity);
            let inserted = self.insert_from(&mut cavity, cell, s);
            self.cavity = cavity;
            inserted?;
            shown(s)?;
        }
        Ok(())
    }

    /// Finds the cell below each site that an undone change has left loose: all of them are hidden. There is
    /// [room](Self::make_room_to_hide).
    pub(crate) fn settle_undone(&mut self) {
        while self.has_cells() && self.has_loose() {
            let s = self.above.first_loose();
            let cell = self.cell_over(s);
            debug_assert!(self.is_above(s, cell));
            self.settle_above(s, cell);
        }
    }

    /// Lists a loose site above the cell that has its place.
    fn settle_above(&mut self, s: SiteId, cell: Slot) {
        self.above.take_out(s);
        self.above.enter(s, Some(cell));
        // The next one in the list is near, as those listed after a build are along a curve.
        self.recent = cell;
    }

    /// The cell that has the place of a loose site.
    fn cell_over(&self, s: SiteId) -> Slot {
        let (hint, _) = self.above.link(s);
        let near = if self.complex.is_live(hint) { hint } else { self.recent };
        self.walk(&self.filter, &self.site(s).point, near, &mut 0)
    }

    /// Whether a site is above the cell that has its place.
    fn is_above(&self, s: SiteId, cell: Slot) -> bool {
        let site = self.site(s);
        !self.complex.cell(cell).is_ghost() && !self.is_in_conflict(cell, &site.point, site.id)
    }

    /// Inserts a loose site, of whose zone this is a cell.
    fn insert_from(&mut self, cavity: &mut Cavity<G>, cell: Slot, s: SiteId) -> Result<()> {
        let made = cavity.scratch.insert::<false>(self, cell, s)?;
        self.above.take_out(s);
        self.note_turned(s);
        self.recent = made;
        self.sites[s].cell = made;
        self.record(cavity.scratch.made());
        self.pace.count(cavity.scratch.made().len());
        self.list_swallowed();
        Ok(())
    }
}

#[cfg(test)]
mod tests;
