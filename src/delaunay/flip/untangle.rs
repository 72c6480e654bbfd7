//! Untangling: cells that are not positive any more, and ridges of the hull that are not convex, mended by flips.
//!
//! A motion turns flat cells inside out, and it dents the hull where vertices are in a plane but for rounding, as on
//! the sides of a sheared lattice. To take vertices back and place them again is expensive there: from its old place a
//! vertex sees all others of its side.
//!
//! ```text
//! exchange cells that are not positive, with one or two neighbours, for positive ones on the same sites; take a vertex
//!     of each that cannot be exchanged back to its old place, and again
//! if some are left: take flat cells at the hull away until none is (peel)
//! where the hull is not convex: exchange ghost cells, which adds a positive cell under them; again, in another order,
//!     where that is stuck
//! if ridges are stuck in every order: take a vertex of each back
//! ```
//!
//! An exchange may leave a cell that is not positive of vertices that have all been taken back, and ridges that are
//! stuck cannot be mended there and then. All exchanges are undone in these cases, and the caller begins again: with
//! the vertices back from the start fewer cells are not positive, and other exchanges are made.
//!
//! An exchange is a flip, done for another reason: of two cells for three or three for two in space, two for two in the
//! plane. A new ghost cell counts as positive if a point within all is on the inner side of its facet.
//!
//! A vertex that is taken back has to be placed later, which takes twenty times as long as an exchange. If nothing were
//! exchanged, a vertex of nearly every inverted cell would have to be.
//!
//! Every step comes to an end: no vertex is taken back twice, exchanges leave fewer cells that are not positive,
//! peeling fewer finite ones, and exchanges of ghosts more volume in the hull. In the end all cells are positive and
//! the hull is convex at every ridge, or all exchanges are undone. How often the hull winds is not asked here.
//!
//! Cost: half a microsecond for an exchange. What it spares is a placement of every vertex taken back. (For a cubic
//! lattice of 10,648 vertices, sheared by 0.001 in each timestamp, `deldrift_bench --targets --target shear_grid` has
//! 1.2 microseconds a vertex for repairs; 5.4 without it, and 2.4 for rebuilding.)

use super::untangling::Untangling;
use crate::complex::{Corners, Facet};
use crate::delaunay::{Delaunay, Failures, Geometry};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;

/// Untangling ends when more than this number of cells, and one in `HARD_SHARE`, are left that are not flat before any
/// vertex is taken back: where vertices go farther than cells are thick, hardly any can be exchanged.
const HARD: usize = 8;
const HARD_SHARE: usize = 2;

/// Untangling is not begun with more ridges that are not convex than one for this number of facets of the hull; a sweep
/// lists each from both sides, and they are known only if all cells are positive. Vertices that leave a side of a
/// lattice dent all of it, and where some have gone outwards what is added soon reaches across the side and is stuck.
const FACETS_PER_DENT: usize = 4;

/// Orders in which dents are filled at most. Four of five times the first one does; else edges around a vertex that has
/// sunk wait for each other, and none of them can be flipped. (So it is with flips to a regular triangulation of the
/// plane: Edelsbrunner and Shah, 10.1007/BF01975867.) No other order is tried with fewer exchanges than this number for
/// each ridge that is stuck.
const ATTEMPTS: u32 = 8;
const FILLED_PER_STUCK: u64 = 16;

/// No vertices are taken back for the ridges that are stuck then if these are more than one for this number of cells
/// that were not positive, and `HARD`: so it is on the sides of lattices, from which placing takes too long.
const CELLS_PER_STUCK: usize = 32;

/// What has become of cells that were not positive, when no more of them can be exchanged.
enum Turned {
    /// None is left.
    All,
    /// Some of those left, all of which are listed, are not flat.
    Stuck,
    /// All those left are flat, or too many are not, or it took too many certificates.
    Hopeless,
}

/// Takes one of these vertices back to where it was before a motion, and tells which one; `None` if there is none to be
/// taken back, or too many have been.
pub(crate) type TakeBack<'f, G> = &'f mut dyn FnMut(&mut Delaunay<G>, &[SiteId]) -> Result<Option<SiteId>>;

impl<G: Geometry> Delaunay<G> {
    /// Makes all cells positive and the hull convex at every ridge, where flips can do that in at most `most`
    /// certificates once some vertices have been taken back; whether that has been done. Facets of new cells are added
    /// to `suspects`, those around vertices taken back to what has failed. What is done is part of the next
    /// [`flip_all`](Self::flip_all), and [`undo_flips`](Self::undo_flips) undoes both. Otherwise, and after an error,
    /// all is as it was, but for the vertices taken back: of their stars nothing is known then.
    pub(crate) fn untangle(
        &mut self,
        failures: &mut Failures,
        suspects: &mut Vec<Facet>,
        most: u64,
        take_back: TakeBack<'_, G>,
    ) -> Result<bool> {
        let mut flips = memory::take_made(&mut self.flips)?;
        // Undoing must not go back to before flips that have been kept.
        let untangling = &mut flips.untangling;
        untangling.flips.begin(most);
        untangling.flips.suspects.clear();
        let n_failing = (failures.cells.len(), failures.facets.len());
        let done = self.untangle_with(untangling, failures, take_back);
        failures.cells.truncate(n_failing.0);
        self.certificates += std::mem::take(&mut untangling.flips.certificates);
        let done = done.and_then(|is_done| {
            if is_done {
                memory::append(suspects, &untangling.flips.suspects)?;
            }
            Ok(is_done)
        });
        if done != Ok(true) {
            failures.facets.truncate(n_failing.1);
            self.take_untangling_back(untangling);
        }
        self.flips = Some(flips);
        done
    }

    /// Puts cells back that have been exchanged.
    pub(super) fn take_untangling_back(&mut self, untangling: &mut Untangling<G>) {
        self.complex.undo_rows(untangling.flips.journal.drain(..).rev());
        untangling.flips.begin(u64::MAX);
    }

    fn untangle_with(
        &mut self,
        untangling: &mut Untangling<G>,
        failures: &mut Failures,
        take_back: TakeBack<'_, G>,
    ) -> Result<bool> {
        if FACETS_PER_DENT * failures.ridges.len() > self.complex.n_ghosts() {
            return Ok(false);
        }
        untangling.cells.clear();
        memory::append(&mut untangling.cells, &failures.cells)?;
        let mut most_hard = HARD + untangling.cells.len() / HARD_SHARE;
        while let Some(inner) = self.deep_point() {
            match self.turn_cells(untangling, &inner, most_hard)? {
                Turned::All => {
                    let are_filled = self.fill_dents(untangling, failures, &inner)?;
                    if !are_filled && untangling.stuck.len() <= HARD + failures.cells.len() / CELLS_PER_STUCK
                    {
                        self.take_dents_back(untangling, take_back)?;
                    }
                    return Ok(are_filled);
                }
                Turned::Hopeless => break,
                Turned::Stuck => {}
            }
            if !self.take_hard_back(untangling, failures, take_back)? {
                break;
            }
            most_hard = usize::MAX;
        }
        Ok(false)
    }

    /// A point strictly inside a cell that is not flat.
    fn deep_point(&self) -> Option<G::Point> {
        self.complex.finite().filter(|&c| !self.is_flat(c)).find_map(|c| self.point_inside(c))
    }

    /// Takes a vertex back of each listed cell that is neither positive nor flat, of which there is one; lists the
    /// cells that are not positive then. Whether each had one to be taken back.
    fn take_hard_back(
        &mut self,
        untangling: &mut Untangling<G>,
        failures: &mut Failures,
        take_back: TakeBack<'_, G>,
    ) -> Result<bool> {
        let (n_listed, mut have_all) = (failures.cells.len(), true);
        for k in 0..untangling.cells.len() {
            let c = untangling.cells[k];
            if self.is_positive(c) || self.is_flat(c) {
                continue;
            }
            let corners = self.complex.cell(c).corners;
            match take_back(self, corners.as_ref())? {
                Some(s) => self.check_star_from(c, s, failures)?,
                None => have_all = false,
            }
        }
        memory::append(&mut untangling.cells, &failures.cells[n_listed..])?;
        failures.cells.truncate(n_listed);
        Ok(have_all)
    }

    /// Takes a vertex back at each ridge that is stuck. Their stars are not looked at: what has been exchanged is going
    /// to be undone.
    fn take_dents_back(&mut self, untangling: &Untangling<G>, take_back: TakeBack<'_, G>) -> Result<()> {
        for &ridge in &untangling.stuck {
            if self.is_ghost(ridge.cell()) && !self.is_convex(ridge) {
                let ghost = self.complex.cell(ridge.cell());
                let apex = self.complex.apex(ghost.neighbour(ridge.index()));
                take_back(self, ghost.corners.with(Self::LAST, apex).as_ref())?;
            }
        }
        Ok(())
    }

    /// Exchanges cells that are not positive, of which those listed are all, while any can be; lists those left.
    fn turn_cells(
        &mut self,
        untangling: &mut Untangling<G>,
        inner: &G::Point,
        most_hard: usize,
    ) -> Result<Turned> {
        let is_far = self.is_far();
        loop {
            let before = untangling.flips.n_flips;
            let (mut n_left, mut n_hard) = (0, 0);
            for k in 0..untangling.cells.len() {
                if is_far {
                    self.prefetch_around_cells(&untangling.cells, k);
                }
                let c = untangling.cells[k];
                if !self.is_finite(c) || self.is_positive(c) {
                    continue;
                }
                if self.exchange(c, inner, untangling)? {
                    continue;
                }
                untangling.cells[n_left] = c;
                n_left += 1;
                n_hard += usize::from(!self.is_flat(c));
                if n_hard > most_hard || untangling.is_exhausted() {
                    return Ok(Turned::Hopeless);
                }
            }
            untangling.cells.truncate(n_left);
            if n_left == 0 {
                return Ok(Turned::All);
            }
            if untangling.flips.n_flips == before {
                return Ok(if n_hard > 0 {
                    Turned::Stuck
                } else if self.peel(untangling)? {
                    Turned::All
                } else {
                    Turned::Hopeless
                });
            }
        }
    }

    /// Exchanges a cell, by any of its facets, for positive ones; whether that has been done.
    fn exchange(&mut self, c: Slot, inner: &G::Point, untangling: &mut Untangling<G>) -> Result<bool> {
        for i in 0..G::Corners::N {
            if self.exchange_across(Facet::new(c, i), Some(inner), untangling)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Leaves no ridge at which the hull is not convex; whether that could be done.
    fn fill_dents(
        &mut self,
        untangling: &mut Untangling<G>,
        failures: &Failures,
        inner: &G::Point,
    ) -> Result<bool> {
        let flips = &untangling.flips;
        let before = (flips.journal.len(), flips.changed.len(), flips.suspects.len(), flips.n_flips);
        for attempt in 0..ATTEMPTS {
            untangling.ridges.clear();
            memory::append(&mut untangling.ridges, &failures.ridges)?;
            self.add_ridges(&failures.open_ghosts, &mut untangling.ridges)?;
            self.add_ridges(&untangling.flips.changed, &mut untangling.ridges)?;
            if attempt > 0 {
                // Any other order.
                let factor = attempt.wrapping_mul(0x9e37_79b9);
                untangling.ridges.sort_unstable_by_key(|ridge| ridge.code().wrapping_mul(factor));
            }
            if self.fill_listed_dents(untangling, inner)? {
                return Ok(true);
            }
            let filled = untangling.flips.n_flips - before.3;
            let are_most_stuck = FILLED_PER_STUCK * untangling.stuck.len() as u64 > filled;
            if attempt + 1 == ATTEMPTS || are_most_stuck || untangling.is_exhausted() {
                break;
            }
            let flips = &mut untangling.flips;
            self.complex.undo_rows(flips.journal.drain(before.0..).rev());
            flips.changed.truncate(before.1);
            flips.suspects.truncate(before.2);
            flips.n_flips = before.3;
        }
        Ok(false)
    }

    /// Exchanges ghosts at the listed ridges, from the end of the list on, and at those of new cells, until the hull is
    /// convex at each; whether that could be done.
    fn fill_listed_dents(&mut self, untangling: &mut Untangling<G>, inner: &G::Point) -> Result<bool> {
        loop {
            let before = untangling.flips.n_flips;
            untangling.stuck.clear();
            while let Some(ridge) = untangling.ridges.pop() {
                if untangling.is_exhausted() {
                    return Ok(false);
                }
                untangling.flips.certificates += 1;
                if !self.is_ghost(ridge.cell()) || self.is_convex(ridge) {
                    continue;
                }
                let n_changed = untangling.flips.changed.len();
                if self.exchange_across(ridge, Some(inner), untangling)? {
                    self.add_ridges(&untangling.flips.changed[n_changed..], &mut untangling.ridges)?;
                } else {
                    memory::push(&mut untangling.stuck, ridge)?;
                }
            }
            if untangling.stuck.is_empty() {
                return Ok(true);
            }
            if untangling.flips.n_flips == before {
                return Ok(false);
            }
            std::mem::swap(&mut untangling.ridges, &mut untangling.stuck);
        }
    }

    /// Adds the ridges of those of these cells that are ghosts.
    fn add_ridges(&self, cells: &[Slot], ridges: &mut Vec<Facet>) -> Result<()> {
        let ghosts = cells.iter().filter(|&&c| self.is_ghost(c));
        memory::collect(ridges, ghosts.flat_map(|&g| (0..Self::LAST).map(move |i| Facet::new(g, i))))
    }
}

#[cfg(test)]
mod tests;
