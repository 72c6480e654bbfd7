//! Two triangulations of different sites become one.
//!
//! ```text
//! the zone of the right one: its cells that may be in conflict with a site of the left one
//! take the zone out; its sites are the border
//! put what is left of the right one beside the left one
//! insert the border into the left one
//! of that, take out what fills the place of what was left of the right one; glue
//! ```
//!
//! A cell of the right triangulation that is in conflict with no site of the left one is a cell of the whole.
//! Any other cell of the whole has sites of the left one and of the border alone: a right site that is not of
//! the border has all its cells among the former. Such a cell is in conflict with no site at all, so it is
//! also a cell of the left triangulation with the border inserted. There, the other cells fill the place of
//! the right cells that stay: they are behind the *rim*, the facets between these cells and the zone.
//!
//! *The zone.* Instead of the left sites, their bounding box is tested, against spheres and half-spaces: a
//! cell is *clear* if the box is certainly outside. A site in the hyperplane of a ghost's facet is in
//! conflict with the ghost exactly if it is with the cell behind. The cells in conflict with one site are
//! connected by facets, and if the site is outside the hull, some ghost is among them. So where a hyperplane
//! separates the box from the right sites, the zone is found from the ghosts, in time proportional to its
//! size; elsewhere all cells are taken for it, which is right if slow.
//!
//! *The rim* is recognised by its corners. A facet of a right cell and the facet of the cell that fills its
//! place have the same orientation; the cell on the other side has the opposite one, and is the new
//! neighbour.
//!
//! Cost: a search and an insertion for each site of the border, and new numbers in the right cells, which all threads
//! of both parts write.

use super::facets::{ByCorners, facet_of};
use super::order::in_rounds;
use super::{Delaunay, Geometry, Site};
use crate::complex::{Corners, Facet, INFINITE};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;

/// A triangulation without its zone.
pub(super) struct Open<G: Geometry> {
    t: Delaunay<G>,
    /// The sites of the zone, ascending. Their records name no cell.
    border: Vec<SiteId>,
    /// The facets to the zone, seen from the cells that stay.
    rim: Vec<Facet>,
}

const IN_ZONE: u8 = 1;
const SEEN: u8 = 2;

impl<G: Geometry> Delaunay<G> {
    /// Takes out the cells that may be in conflict with points in a box.
    pub(super) fn open(mut self, lower: &G::Point, upper: &G::Point) -> Result<Open<G>> {
        let is_apart = (0..G::D).any(|k| upper[k] < self.lower[k] || self.upper[k] < lower[k]);
        self.cover(lower, upper);
        let mut zone = Vec::new();
        if is_apart {
            self.list_zone_of_box(&mut zone, lower, upper)?;
        } else {
            memory::collect(&mut zone, self.complex.live())?;
        }
        for &c in &zone {
            self.complex.set_mark(c, IN_ZONE);
        }
        let (mut border, mut rim) = (Vec::new(), Vec::new());
        for &c in &zone {
            let cell = *self.complex.cell(c);
            for i in 0..G::Corners::N {
                let across = cell.neighbour(i);
                if self.complex.mark(across.cell()) != IN_ZONE {
                    memory::push(&mut rim, across)?;
                }
                let site = self.corner_mut(cell.corners[i]);
                if site.cell != Slot::NONE && cell.corners[i] != INFINITE {
                    site.cell = Slot::NONE;
                    memory::push(&mut border, cell.corners[i])?;
                }
            }
        }
        for &c in &zone {
            self.complex.retire(c);
            self.complex.release(c);
        }
        border.sort_unstable();
        Ok(Open { t: self, border, rim })
    }

    /// Lists the cells that are not clear of a box that a hyperplane separates from all sites, and marks them.
    fn list_zone_of_box(&mut self, zone: &mut Vec<Slot>, lower: &G::Point, upper: &G::Point) -> Result<()> {
        // All ghosts at first.
        memory::push(zone, self.site(INFINITE).cell)?;
        self.complex.set_mark(zone[0], SEEN);
        let mut next = 0;
        while let Some(&g) = zone.get(next) {
            next += 1;
            for i in 0..Self::LAST {
                let beside = self.complex.cell(g).neighbour(i).cell();
                if self.complex.mark(beside) == 0 {
                    self.complex.set_mark(beside, SEEN);
                    memory::push(zone, beside)?;
                }
            }
        }
        for &g in zone.iter() {
            self.complex.set_mark(g, 0);
        }
        zone.retain(|&g| !self.is_clear(g, lower, upper));
        for &g in zone.iter() {
            self.complex.set_mark(g, IN_ZONE);
        }
        let mut next = 0;
        while let Some(&c) = zone.get(next) {
            next += 1;
            for i in 0..G::Corners::N {
                let across = self.complex.cell(c).neighbour(i).cell();
                if self.complex.mark(across) == 0 && !self.is_clear(across, lower, upper) {
                    self.complex.set_mark(across, IN_ZONE);
                    self.complex.prefetch_neighbours(across);
                    memory::push(zone, across)?;
                }
            }
        }
        Ok(())
    }

    /// Whether a cell is certainly in conflict with no point of a box.
    fn is_clear(&self, cell: Slot, lower: &G::Point, upper: &G::Point) -> bool {
        let c = self.complex.cell(cell);
        let clears = |corners| G::is_clear_of(self.view(), corners, lower, upper);
        if !c.is_ghost() {
            return clears(&c.corners);
        }
        let mut touches = false;
        for corner in 0..1 << G::D {
            let mut q = *lower;
            for k in (0..G::D).filter(|k| corner >> k & 1 == 1) {
                q[k] = upper[k];
            }
            let beyond = G::orientation_with(&self.filter, self.view(), &c.corners, Self::LAST, &q);
            if beyond > 0.0 {
                return false;
            }
            touches |= beyond == 0.0;
        }
        !touches || clears(&self.complex.cell(c.neighbour(Self::LAST).cell()).corners)
    }

    /// Unites the triangulation with one of other sites, which get the indices from `first` on, where they may be
    /// already without their cells; it has been opened for the box of the sites before. Returns pairs of coincident
    /// sites, the second in the cells. After an error the cells are half made.
    pub(super) fn unite(
        &mut self,
        Open { t: mut right, border, mut rim }: Open<G>,
        first: SiteId,
        n_threads: usize,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Vec<(SiteId, SiteId)>> {
        let shift = first.get() - 1;
        let first_slot = self.complex.append(std::mem::take(&mut right.complex), shift, n_threads)?;
        let moved = |c: Slot| Slot::at(c.index() + first_slot);
        let shifted = |site: &Site<G>| {
            let mut site = *site;
            if site.cell != Slot::NONE {
                site.cell = moved(site.cell);
            }
            site
        };
        let others = &right.sites[1..];
        match self.sites.get_mut(first.index()..first.index() + others.len()) {
            Some(there) => memory::overwrite(there, others, n_threads, &shifted),
            None => memory::extend(&mut self.sites, others, n_threads, shifted)?,
        }
        self.cover(&right.lower, &right.upper);
        self.cavity.steps += right.cavity.steps;
        drop(right);
        for facet in &mut rim {
            *facet = Facet::new(moved(facet.cell()), facet.index());
        }
        let order = in_rounds::<G>(border.iter().map(|s| SiteId::new(s.get() + shift)))?;
        self.record_changes(Vec::new());
        let inserted = self.insert_all(&order, monitor);
        let mut made = self.take_changes().expect("a record was started");
        let coincident = inserted?;
        self.tidy_changes(&mut made);
        self.close(&rim, &made, first)?;
        Ok(coincident)
    }

    /// Glues the facets of the rim to their new neighbours, which are among the cells that were `made`, and
    /// takes out what fills the place of the cells behind the rim. All sites of the rim are from `first` on.
    fn close(&mut self, rim: &[Facet], made: &[Slot], first: SiteId) -> Result<()> {
        let mut by_corners = ByCorners::<G::Corners, (Facet, bool)>::default();
        memory::reserve_map(&mut by_corners, rim.len())?;
        for &facet in rim {
            let (corners, is_odd) = facet_of(&self.complex.cell(facet.cell()).corners, facet.index());
            by_corners.insert(corners, (facet, is_odd));
        }
        let mut n_glued = 0;
        let mut filling = Vec::new();
        for &c in made {
            let corners = self.complex.cell(c).corners;
            let is_left = |i: usize| corners[i] < first && corners[i] != INFINITE;
            let n_left = (0..G::Corners::N).filter(|&i| is_left(i)).count();
            if n_left > 1 {
                continue;
            }
            for i in (0..G::Corners::N).filter(|&i| n_left == 0 || is_left(i)) {
                let (facet, is_odd) = facet_of(&corners, i);
                match by_corners.get(&facet) {
                    Some(&(rim, rim_is_odd)) if rim_is_odd != is_odd => {
                        // The cell on the other side keeps its half of the old gluing.
                        self.complex.glue(rim, Facet::new(c, i));
                        n_glued += 1;
                    }
                    Some(_) if self.complex.mark(c) == 0 => {
                        self.complex.set_mark(c, SEEN);
                        memory::push(&mut filling, c)?;
                    }
                    _ => {}
                }
            }
        }
        assert_eq!(n_glued, rim.len(), "every facet of the rim is one of the united triangulation");
        self.take_out(filling)?;
        for facet in rim {
            let corners = self.complex.cell(facet.cell()).corners;
            for i in (0..G::Corners::N).filter(|&i| i != facet.index()) {
                self.corner_mut(corners[i]).cell = facet.cell();
            }
            self.recent = facet.cell();
        }
        Ok(())
    }

    /// Takes out cells, which are marked, and all that they are glued to both ways.
    fn take_out(&mut self, mut cells: Vec<Slot>) -> Result<()> {
        let mut next = 0;
        while let Some(&c) = cells.get(next) {
            next += 1;
            for i in 0..G::Corners::N {
                let across = self.complex.cell(c).neighbour(i);
                let back = self.complex.cell(across.cell()).neighbour(across.index());
                if back == Facet::new(c, i) && self.complex.mark(across.cell()) == 0 {
                    self.complex.set_mark(across.cell(), SEEN);
                    memory::push(&mut cells, across.cell())?;
                }
            }
        }
        for c in cells {
            self.complex.retire(c);
            self.complex.release(c);
        }
        Ok(())
    }
}
