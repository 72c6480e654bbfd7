//! Certificates of many cells at once, after sites have moved and before any cell has changed.
//!
//! Cells are a triangulation again if every finite one is positively oriented, the hull is convex at every ridge, and
//! it winds once: it is then the boundary of a convex set, and the cells, all of one orientation, cover that as often
//! as their boundary winds. They are the Delaunay triangulation if also no facet fails the empty-sphere test
//! (Delaunay's lemma, ties broken by id).

mod hull;

use std::ops::Range;

use super::uncertain::Doubts;
use super::{Delaunay, Failures, Geometry};
use crate::complex::{Cell, Corners, Facet, INFINITE};
use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot};
use crate::machine::{memory, tally, threads};
use crate::simd::{LANES, in_lanes};

/// A sweep of this number of cells takes a few times as long as a thread takes to wake up.
const SWEPT_AT_LEAST: usize = 1 << 14;

/// Cells that a thread sweeps between two calls of a monitor.
const SWEPT_UNASKED: usize = 1 << 16;

/// Bytes of cells above which they are asked for in advance. Measured; more than for arrays that are read in no order
/// at all ([`prefetch::CACHE_BYTES`](crate::machine::prefetch)), as most neighbours are stored close by.
const SWEPT_CACHE_BYTES: usize = 4 << 20;

/// Facets between finite cells that wait until they are as many as can be checked together.
#[derive(Debug)]
pub(crate) struct Waiting {
    facets: [Facet; LANES],
    n: usize,
}

impl Default for Waiting {
    fn default() -> Self {
        Waiting { facets: [Facet::new(Slot::new(0), 0); LANES], n: 0 }
    }
}

impl<G: Geometry> Delaunay<G> {
    /// Checks every certificate of the finite cells once, and lists the ghosts; `false`, before the end, when more than
    /// `most` cells have failed; then no sign is counted. What has been listed before an error is of no use. Where it is
    /// known where all vertices were `before`, by id, certificates of those that have not moved are not evaluated again in
    /// exact arithmetic.
    pub(crate) fn sweep(
        &mut self,
        failures: &mut Failures,
        most: usize,
        before: Option<&[G::Point]>,
    ) -> Result<bool> {
        failures.clear();
        let exact_calls = tally::exact_calls();
        self.sweep_slots(0..self.complex.n_slots(), failures, most, before)?;
        if failures.cells.len() > most {
            // How far several threads have come depends on them.
            tally::forget_since(exact_calls);
            return Ok(false);
        }
        self.end_sweep(failures)?;
        Ok(true)
    }

    /// Checks every certificate of the finite cells once, and lists the ghosts; ends early where a cell has failed.
    /// `monitor` is called with the fraction done; if it returns `false`, this ends in [`Error::Cancelled`].
    pub(super) fn sweep_monitored(
        &mut self,
        failures: &mut Failures,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<()> {
        failures.clear();
        let n = self.complex.n_slots();
        let step = SWEPT_UNASKED * self.threads.for_work(n, SWEPT_AT_LEAST, SWEPT_AT_LEAST / 64);
        for first in (0..n).step_by(step) {
            if !monitor(first as f64 / n as f64) {
                return Err(Error::Cancelled);
            }
            let range = first..n.min(first + step);
            self.sweep_slots(range, failures, 0, None)?;
            if !failures.cells.is_empty() {
                return Ok(());
            }
        }
        self.end_sweep(failures)
    }

    /// After all cells have been swept.
    fn end_sweep(&mut self, failures: &mut Failures) -> Result<()> {
        memory::append(&mut failures.open_ghosts, &failures.ghosts)?;
        failures.may_wind_twice = true;
        self.certificates += self.n_certificates();
        Ok(())
    }

    /// Sweeps the cells of a range by as many threads as pay. What is listed does not depend on how many there are: nothing
    /// beyond the cell that is one too many.
    fn sweep_slots(
        &self,
        range: Range<usize>,
        failures: &mut Failures,
        most: usize,
        before: Option<&[G::Point]>,
    ) -> Result<()> {
        let n_threads = self.threads.for_work(range.len(), SWEPT_AT_LEAST, SWEPT_AT_LEAST / 64);
        if n_threads == 1 {
            return self.sweep_range(range, failures, most, before);
        }
        let parts = threads::for_ranges(range.len(), n_threads, |part| {
            let mut failures = Failures::default();
            let part = range.start + part.start..range.start + part.end;
            self.sweep_range(part, &mut failures, most, before).map(|()| failures)
        })?;
        parts.into_iter().try_for_each(|part| failures.append(&part?))?;
        if let Some(&last) = failures.cells.get(most) {
            failures.cells.truncate(most + 1);
            let n_facets = failures.facets.partition_point(|facet| facet.cell() <= last);
            failures.facets.truncate(n_facets);
        }
        Ok(())
    }

    /// How many certificates the finite cells have: an orientation each, and half an empty sphere for each facet.
    pub(crate) fn n_certificates(&self) -> u64 {
        (self.complex.n_finite() * (G::D + 3) / 2) as u64
    }

    /// Sweeps the cells of a range; stops when more than `most` have failed.
    fn sweep_range(
        &self,
        range: Range<usize>,
        failures: &mut Failures,
        most: usize,
        before: Option<&[G::Point]>,
    ) -> Result<()> {
        let mut swept = Ok(());
        self.visit_uncertain(Slot::range(range), |c, doubts| {
            match self.sweep_cell(c, doubts, before, failures) {
                Ok(holds) => holds || failures.cells.len() <= most,
                Err(error) => {
                    swept = Err(error);
                    false
                }
            }
        });
        swept
    }

    /// Calls `visit` with each of these cells that is a ghost or does not surely hold, and with what does not, until it
    /// returns `false`.
    /// Free ones are skipped. Ghosts come in the order of the list, and so do finite cells.
    #[inline(always)]
    pub(super) fn visit_uncertain(
        &self,
        cells: impl Iterator<Item = Slot> + Clone,
        visit: impl FnMut(Slot, Doubts) -> bool,
    ) {
        if self.complex.n_slots() * size_of::<Cell<G::Corners>>() > SWEPT_CACHE_BYTES {
            in_lanes!(simd, self, cells, visit => |t, cells, visit| {
                t.visit_uncertain_in_lanes::<_, true>(simd, cells, visit)
            });
        } else {
            in_lanes!(simd, self, cells, visit => |t, cells, visit| {
                t.visit_uncertain_in_lanes::<_, false>(simd, cells, visit)
            });
        }
    }

    /// Whether all certificates of the cells of a star, listed with the index of its site in each, surely hold: not if
    /// there are ghosts among them.
    #[inline(always)]
    pub(super) fn star_surely_holds(&self, star: &[(Slot, u8)]) -> bool {
        in_lanes!(simd, self, star, () => |t, star, ()| {
            G::star_holds(simd, &t.filter, t.view(), &t.complex, star)
                .unwrap_or_else(|| t.star_holds_in_lanes(simd, star))
        })
    }

    /// Lists a ghost cell, or what of a finite cell fails: `false` if it is not positively oriented. Its facets
    /// to cells of higher slots are left to those. What is not in doubt holds.
    #[cold]
    #[inline(never)]
    pub(super) fn sweep_cell(
        &self,
        c: Slot,
        doubts: Doubts,
        before: Option<&[G::Point]>,
        failures: &mut Failures,
    ) -> Result<bool> {
        let cell = self.complex.cell(c);
        if cell.is_ghost() {
            memory::push(&mut failures.ghosts, c)?;
            return Ok(true);
        }
        let is_at_rest = before.is_some_and(|before| self.are_at_rest(cell.corners.as_ref(), before));
        if doubts.concern_orientation() && !is_at_rest && !self.is_positive(c) {
            memory::push(&mut failures.cells, c)?;
            return Ok(false);
        }
        let facets = (0..G::Corners::N).map(|i| Facet::new(c, i));
        let doubtful = facets.filter(|facet| doubts.concern_facet(facet.index()));
        let lower = doubtful.filter(|&facet| cell.neighbour(facet.index()).cell() < c);
        let failing = lower.filter(|&facet| {
            let apex = self.complex.apex(cell.neighbour(facet.index()));
            let is_as_it_was = is_at_rest && before.is_some_and(|before| self.are_at_rest(&[apex], before));
            !is_as_it_was && !self.is_locally_delaunay(facet)
        });
        memory::collect(&mut failures.facets, failing)?;
        Ok(true)
    }

    /// Checks the certificates of a bi-cell after the vertices have moved from where they were `before`, by id. Of
    /// finite cells: both are positive, and the facet passes the empty-sphere test. At the hull: the finite cell is
    /// positive, or the ridge is convex, and has been so all the way. Whether all is as it must be now.
    #[inline(always)]
    pub(crate) fn check_bicell(
        &self,
        facet: Facet,
        before: &[G::Point],
        failures: &mut Failures,
    ) -> Result<bool> {
        let across = self.complex.cell(facet.cell()).neighbour(facet.index());
        match [facet, across].map(|side| self.complex.cell(side.cell()).is_ghost()) {
            [false, false] => {
                if G::bicell_holds(&self.filter, self.view(), &self.complex, facet) {
                    return Ok(true);
                }
                self.check_bicell_exactly(facet, before, failures)
            }
            [true, true] => self.check_ridge(facet, before, failures),
            [true, false] => self.check_orientation_of(across.cell(), failures),
            [false, true] => self.check_orientation_of(facet.cell(), failures),
        }
    }

    /// [Checks](Self::check_bicell) one of many bi-cells. Those of finite cells wait until they are as many as there
    /// are lanes; after the last one [`check_waiting`](Self::check_waiting) must follow.
    #[inline(always)]
    pub(crate) fn check_bicell_of_many(
        &self,
        facet: Facet,
        waiting: &mut Waiting,
        before: &[G::Point],
        failures: &mut Failures,
    ) -> Result<()> {
        let across = self.complex.cell(facet.cell()).neighbour(facet.index());
        if [facet, across].iter().any(|side| self.complex.cell(side.cell()).is_ghost()) {
            self.check_bicell(facet, before, failures)?;
            return Ok(());
        }
        waiting.facets[waiting.n] = facet;
        waiting.n += 1;
        if waiting.n == LANES { self.check_waiting(waiting, before, failures) } else { Ok(()) }
    }

    /// Checks the bi-cells that wait.
    pub(crate) fn check_waiting(
        &self,
        waiting: &mut Waiting,
        before: &[G::Point],
        failures: &mut Failures,
    ) -> Result<()> {
        let Waiting { facets, n } = waiting;
        let n = std::mem::take(n);
        if n == 0 {
            return Ok(());
        }
        // Any facets between finite cells fill the last lanes.
        let any = facets[0];
        facets[n..].fill(any);
        let hold = in_lanes!(simd => G::facets_hold(simd, &self.filter, self.view(), &self.complex, facets));
        for (k, &facet) in facets[..n].iter().enumerate() {
            if hold >> k & 1 == 0 {
                self.check_bicell_exactly(facet, before, failures)?;
            }
        }
        Ok(())
    }

    #[cold]
    #[inline(never)]
    fn check_bicell_exactly(
        &self,
        facet: Facet,
        before: &[G::Point],
        failures: &mut Failures,
    ) -> Result<bool> {
        let across = self.complex.cell(facet.cell()).neighbour(facet.index());
        let cells = [facet.cell(), across.cell()];
        // Where nothing has moved, what held before holds still: exact arithmetic, which ties would take, is spared.
        if cells.iter().all(|&c| self.are_at_rest(self.complex.cell(c).corners.as_ref(), before)) {
            return Ok(true);
        }
        let mut are_positive = true;
        for c in cells {
            are_positive &= self.check_orientation_of(c, failures)?;
        }
        let holds = are_positive && self.is_locally_delaunay(facet);
        if are_positive && !holds {
            memory::push(&mut failures.facets, facet)?;
        }
        Ok(holds)
    }

    /// Checks that a finite cell is positive.
    fn check_orientation_of(&self, c: Slot, failures: &mut Failures) -> Result<bool> {
        let is_positive = self.is_positive(c);
        if !is_positive {
            memory::push(&mut failures.cells, c)?;
        }
        Ok(is_positive)
    }

    /// Checks all certificates of these cells after a motion, like [`check_bicell`](Self::check_bicell).
    pub(crate) fn check_cells(
        &mut self,
        cells: &[Slot],
        before: &[G::Point],
        failures: &mut Failures,
    ) -> Result<()> {
        let mut checked = Ok(());
        self.visit_uncertain(cells.iter().copied(), |c, doubts| {
            checked = if self.complex.cell(c).is_ghost() {
                let mut ridges = (0..Self::LAST).map(|i| Facet::new(c, i));
                ridges.try_for_each(|ridge| self.check_ridge(ridge, before, failures).map(|_| ()))
            } else {
                self.check_cell_exactly(c, doubts, failures)
            };
            checked.is_ok()
        });
        self.certificates += (cells.len() * (G::D + 2)) as u64;
        checked
    }

    #[cold]
    #[inline(never)]
    fn check_cell_exactly(&self, c: Slot, doubts: Doubts, failures: &mut Failures) -> Result<()> {
        if doubts.concern_orientation() && !self.is_positive(c) {
            return memory::push(&mut failures.cells, c);
        }
        let facets = (0..G::Corners::N).filter(|&i| doubts.concern_facet(i)).map(|i| Facet::new(c, i));
        memory::collect(&mut failures.facets, facets.filter(|&facet| !self.is_locally_delaunay(facet)))
    }

    /// Whether none of these sites, of which one may be the ghost vertex, has moved.
    fn are_at_rest(&self, sites: &[SiteId], before: &[G::Point]) -> bool {
        sites.iter().filter(|&&s| s != INFINITE).all(|&s| {
            let site = self.site(s);
            site.point == before[site.id]
        })
    }

    /// Checks the cells of the star of a site; all its facets may fail.
    pub(crate) fn check_star(&mut self, s: SiteId, failures: &mut Failures) -> Result<()> {
        self.check_star_from(self.sites[s].cell, s, failures)
    }

    /// Checks the cells of the star of a site, of which `first` is one: while there are flips the site itself need not
    /// know one.
    pub(super) fn check_star_from(&mut self, first: Slot, s: SiteId, failures: &mut Failures) -> Result<()> {
        self.gather_star_from(first, s)?;
        for &(c, at) in self.gathered_star() {
            let cell = self.complex.cell(c);
            if cell.is_ghost() {
                memory::push(&mut failures.open_ghosts, c)?;
                continue;
            }
            if !self.is_positive(c) {
                memory::push(&mut failures.cells, c)?;
            }
            // A facet between two cells of the star is checked from one of them.
            let is_own = |&i: &usize| i == at as usize || c < cell.neighbour(i).cell();
            let own = (0..G::Corners::N).filter(is_own).map(|i| Facet::new(c, i));
            memory::collect(&mut failures.facets, own)?;
        }
        self.certificates += self.gathered_star().len() as u64;
        Ok(())
    }

    /// Whether a finite cell is positively oriented.
    pub(crate) fn is_positive(&self, cell: Slot) -> bool {
        G::orientation(&self.filter, self.view(), &self.complex.cell(cell).corners) > 0.0
    }

    /// Whether the opposing vertices of a facet of a finite cell are outside the spheres of the opposite cells.
    pub(super) fn is_locally_delaunay(&self, facet: Facet) -> bool {
        let cell = self.complex.cell(facet.cell());
        let across = cell.neighbour(facet.index());
        let apex = self.complex.apex(across);
        if apex == INFINITE {
            return true;
        }
        let site = self.site(apex);
        !G::is_in_sphere(&self.filter, self.view(), &cell.corners, &site.point, site.id)
    }
}

#[cfg(test)]
mod tests;
