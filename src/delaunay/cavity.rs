//! Insertion (Bowyer 10.1093/comjnl/24.2.162, Watson 10.1093/comjnl/24.2.167): *dig* the zone of cells in conflict
//! with the new site, then *fill* it with the cells that join its rim to the site.
//!
//! The conflict zone is connected and star-shaped as seen from the site, because signs are exact and ties are
//! broken consistently: each facet of its rim makes a positively oriented cell with the site. How the zone is
//! traversed, and how the new cells find each other, is a matter of the dimension: see
//! [`cavity_plane`](super::cavity_plane) and [`cavity_space`](super::cavity_space).
//!
//! Cost: in expectation 6 cells made and 4 deleted in the plane, about 27 and 20 in space, with one in-sphere test
//! for each deleted cell and each rim facet.

use super::geometry::Insert;
use super::{Delaunay, Geometry};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;

/// What an insertion found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Insertion {
    /// The site is in the triangulation.
    New,
    /// This site was at the place already; nothing has changed.
    Coincident(SiteId),
    /// Its weight hides the site, which stays live: it is above this cell.
    Hidden(Slot),
    /// There were no cells, and with the site there would be: a kernel has to be built. Nothing has changed.
    Spans,
}

/// Insertions, and the scratch memory for them.
#[derive(Debug, Default)]
pub struct Cavity<G: Geometry> {
    pub(super) scratch: G::Scratch,
    /// Cells crossed by the walks so far.
    pub(super) steps: u64,
}

impl<G: Geometry> Delaunay<G> {
    /// Inserts a site that has been added; `near` is a cell to walk from, [`Slot::NONE`] for any. A coincident site is
    /// dropped; after an error the site is live and in no cell.
    pub fn insert_site(&mut self, s: SiteId, near: Slot) -> Result<Insertion> {
        self.go_on()?;
        // For the index, should the site be dropped.
        memory::reserve(&mut self.free_sites, 1)?;
        self.make_room_to_hide()?;
        let q = self.site(s).point;
        self.cover(&q, &q);
        let inserted = if self.has_cells() {
            let near = if near == Slot::NONE { self.recent } else { near };
            let mut cavity = std::mem::take(&mut self.cavity);
            let before = cavity.steps;
            let inserted = self.insert_into_cells::<false>(&mut cavity, s, near);
            match inserted {
                Ok(Insertion::New) => {
                    self.record(cavity.scratch.made());
                    self.pace.count(cavity.scratch.made().len());
                    self.list_swallowed();
                }
                Ok(Insertion::Hidden(cell)) => self.hide(s, cell),
                _ => {}
            }
            self.pace.count((cavity.steps - before) as usize);
            self.cavity = cavity;
            inserted
        } else {
            self.insert_flat(s)
        };
        if matches!(inserted, Ok(Insertion::Coincident(_))) {
            self.drop_site(s);
        }
        inserted
    }

    /// [Inserts](Self::insert_site) a site that has been added and may be anywhere, by a walk from a cell
    /// [towards](Self::cell_towards) it.
    pub(crate) fn insert_site_anywhere(&mut self, s: SiteId) -> Result<Insertion> {
        if !self.has_cells() {
            return self.insert_site(s, Slot::NONE);
        }
        let q = self.site(s).point;
        let near = self.cell_towards(&q, self.recent);
        let before = self.cavity.steps;
        let inserted = self.insert_site(s, near);
        // Otherwise the last change is elsewhere.
        if inserted == Ok(Insertion::New) {
            self.note_walk(&q, self.recent, self.cavity.steps - before);
        }
        inserted
    }

    /// Inserts a site that has been added, walking from the cell `near`, with the scratch memory at hand. There must be
    /// cells, and the filter must cover the site. `BUILD` if between [`begin_build`](Insert::begin_build) and
    /// [`end_build`](Insert::end_build).
    #[inline(always)]
    pub(super) fn insert_into_cells<const BUILD: bool>(
        &mut self,
        cavity: &mut Cavity<G>,
        s: SiteId,
        near: Slot,
    ) -> Result<Insertion> {
        let q = self.site(s).point;
        let Cavity { scratch, steps } = cavity;
        let (start, is_inside) = if BUILD {
            let is_inside = |cell| scratch.is_inside(&self.filter, cell, &q);
            self.walk_until(&self.filter, &q, near, steps, is_inside)
        } else {
            (self.walk(&self.filter, &q, near, steps), false)
        };
        if G::HAS_WEIGHTS {
            let is_below = is_inside
                || self.complex.cell(start).is_ghost()
                || self.is_in_conflict(start, &q, self.site(s).id);
            if !is_below {
                return Ok(Insertion::Hidden(start));
            }
        } else if !is_inside && let Some(t) = self.corner_at(start, &q) {
            // What is inside the sphere of a cell is at no site.
            return Ok(Insertion::Coincident(t));
        }
        let made = scratch.insert::<BUILD>(self, start, s)?;
        self.recent = made;
        self.sites[s].cell = made;
        Ok(Insertion::New)
    }

    /// Inserts a site while there are no cells. After an error nothing has changed.
    pub(super) fn insert_flat(&mut self, s: SiteId) -> Result<Insertion> {
        let q = self.site(s).point;
        if let Some(t) = self.flat.enter(s, &q)? {
            return Ok(Insertion::Coincident(t));
        }
        self.sites[s].cell = Slot::NONE;
        if self.spans_without_cells() {
            return Ok(Insertion::Spans);
        }
        if self.extend_basis(s) {
            self.remove_flat(s);
            return Ok(Insertion::Spans);
        }
        Ok(Insertion::New)
    }
}
