//! Untangling: cells that are not positive any more, and ridges of the hull that are not convex, mended by flips.
//!
//! A motion turns flat cells inside out, and it dents the hull where vertices are in a plane but for rounding, as on the
//! sides of a sheared lattice. To take vertices back and place them again is expensive there: from its old place a
//! vertex sees all others of its side.
//!
//! ```text
//! exchange cells that are not positive, with one or two neighbours, for positive ones on the same sites; take a vertex
//!     of each that cannot be exchanged back to its old place, and again
//! if some are left: take flat cells at the hull away until none is (peel)
//! where the hull is not convex: exchange ghost cells, which adds a positive cell under them; again, in another order,
//!     where that is stuck
//! ```
//!
//! An exchange is a flip, done for another reason: of two cells for three or three for two in space, two for two in the
//! plane. A new ghost cell counts as positive if a point within all is on the inner side of its facet.
//!
//! A vertex taken back has to be placed afterwards; but for that, each inverted cell would cost such a placement: of 10,000
//! random points that move by up to a tenth of a spacing 600 cells are inverted, and 180 of them cannot be exchanged.
//!
//! Every step comes to an end: no vertex is taken back twice, exchanges leave fewer cells that are not positive, peeling
//! fewer finite ones, and exchanges of ghosts more volume in the hull. In the end all cells are positive and the hull is convex at every ridge,
//! or all is undone. How often the hull winds is not asked here.
//!
//! Cost: half a microsecond for an exchange. What it spares is a placement of every vertex taken back. (For a cubic
//! lattice of 10,648 vertices, sheared by 0.001 in each timestamp, `deldrift_bench --targets --target shear_grid` has 1.2
//! microseconds a vertex for repairs; 5.4 without it, and 2.4 for rebuilding.)

use super::{Delaunay, Dimension, Flips, key};
use crate::complex::{Corners, Facet, INFINITE, NewCell};
use crate::delaunay::Failures;
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;

/// It ends when at first more than this number of cells, and one in `HARD_SHARE`, cannot be exchanged and are not flat: where vertices go farther than cells are thick, hardly any can be exchanged.
const HARD: usize = 8;
const HARD_SHARE: usize = 2;

/// It is not begun with more ridges that are not convex than one for this number of facets of the hull; a sweep lists each
/// from both sides, and they are known only if all cells are positive. Vertices that leave a side of a lattice dent all of
/// it, and where some have gone outwards what is added soon reaches across the side and is stuck.
const FACETS_PER_DENT: usize = 4;

/// Orders in which dents are filled at most. Four of five times the first one does; else edges around a vertex that has
/// sunk wait for each other, and none of them can be flipped. (So it is with flips to a regular triangulation of the plane:
/// Edelsbrunner and Shah, 10.1007/BF01975867.) No other order is tried with fewer exchanges than this number for each
/// ridge that is stuck.
const ATTEMPTS: u32 = 8;
const FILLED_PER_STUCK: u64 = 16;

/// The most cells on either side of an exchange, and facets around it.
const MOST_CELLS: usize = 3;
const MOST_OUTER: usize = 6;

/// What has been exchanged, and scratch memory.
#[derive(Debug)]
pub(super) struct Untangling<G: Dimension> {
    /// Their suspects are facets of new cells.
    pub(super) flips: Flips<G>,
    /// Cells that are not positive, and then flat ones around them.
    pub(super) cells: Vec<Slot>,
    /// Of ghosts, that may not be convex, ...
    ridges: Vec<Facet>,
    /// ... and where ghosts cannot be exchanged at present.
    stuck: Vec<Facet>,
    slots: Vec<Slot>,
}

/// What has become of cells that were not positive.
enum Turned {
    /// None is left.
    All,
    /// Some of those left, all of which are listed, are not flat.
    Stuck,
    /// Too few could be exchanged, or it took too much.
    TooFew,
}

/// Takes a vertex of a cell back to where it was before a motion, and tells which one; `None` if there is none to be taken
/// back, or too many have been.
pub(crate) type TakeBack<'f, G> = &'f mut dyn FnMut(&mut Delaunay<G>, Slot) -> Result<Option<SiteId>>;

impl<G: Dimension> Default for Untangling<G> {
    fn default() -> Self {
        Untangling {
            flips: Flips::default(),
            cells: Vec::new(),
            ridges: Vec::new(),
            stuck: Vec::new(),
            slots: Vec::new(),
        }
    }
}

impl<G: Dimension> Untangling<G> {
    pub(super) fn memory_bytes(&self) -> usize {
        self.flips.memory_bytes()
            + memory::bytes_of(&self.cells)
            + memory::bytes_of(&self.ridges)
            + memory::bytes_of(&self.stuck)
            + memory::bytes_of(&self.slots)
    }

    pub(super) fn is_exhausted(&self) -> bool {
        self.flips.certificates > self.flips.most
    }
}

/// Cells, and those that are to take their place.
struct Exchange<C: Corners> {
    old: [Slot; MOST_CELLS],
    n_old: usize,
    new: [NewCell<C>; MOST_CELLS],
    n_new: usize,
}

impl<C: Corners> Exchange<C> {
    fn of(cells: [Slot; 2]) -> Self {
        let none =
            NewCell { corners: C::filled(SiteId::NONE), neighbours: C::Of::filled(Facet::NONE), inner: 0 };
        Exchange { old: [cells[0], cells[1], Slot::NONE], n_old: 2, new: [none; MOST_CELLS], n_new: 0 }
    }

    fn old(&self) -> &[Slot] {
        &self.old[..self.n_old]
    }

    /// Glues the new cells to each other, and to these facets, by the sites of each; whether they fill what is within.
    fn glue(&mut self, outer: &[([SiteId; 3], Facet)]) -> bool {
        let new = &mut self.new[..self.n_new];
        let mut n_glued = 0;
        for a in 0..new.len() {
            for i in 0..C::N {
                let sites = key(&new[a].corners, i);
                if let Some(&(_, to)) = outer.iter().find(|(outer, _)| *outer == sites) {
                    new[a].neighbours[i] = to;
                    n_glued += 1;
                    continue;
                }
                let others = (0..new.len()).filter(|&b| b != a);
                let mut facets = others.flat_map(|b| (0..C::N).map(move |j| (b, j)));
                let Some((b, j)) = facets.find(|&(b, j)| key(&new[b].corners, j) == sites) else {
                    return false;
                };
                new[a].neighbours[i] = Facet::new(Slot::at(b), j);
                new[a].inner |= 1 << i;
            }
        }
        n_glued == outer.len()
    }
}

/// The same cell, with the ghost vertex last if it has that.
fn with_ghost_last<C: Corners>(corners: C) -> C {
    let ghost = (0..C::N).find(|&i| corners[i] == INFINITE);
    ghost.map_or(corners, |i| corners.rotated_to_last(i))
}

impl<G: Dimension> Delaunay<G> {
    /// Makes all cells positive and the hull convex at every ridge, where flips can do that in at most `most`
    /// certificates once some vertices have been taken back; whether that has been done. Facets of new cells are added to
    /// `suspects`, those around vertices taken back to what has failed. What is done is part of the next
    /// [`flip_all`](Self::flip_all), and [`undo_flips`](Self::undo_flips) undoes both. Otherwise, and after an error, all
    /// is as it was, but for the vertices taken back: of their stars nothing is known then.
    pub(crate) fn untangle(
        &mut self,
        failures: &mut Failures,
        suspects: &mut Vec<Facet>,
        most: u64,
        take_back: TakeBack<'_, G>,
    ) -> Result<bool> {
        let mut flips = std::mem::take(&mut self.flips);
        // Undoing must not go back to before flips that have been kept.
        flips.were_several = false;
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
        self.flips = flips;
        done
    }

    /// Puts cells back that have been exchanged.
    pub(super) fn take_untangling_back(&mut self, untangling: &mut Untangling<G>) {
        self.complex.undo_flips(untangling.flips.journal.drain(..).rev());
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
                Turned::All => return self.fill_dents(untangling, failures, &inner),
                Turned::TooFew => break,
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

    /// Takes a vertex back of each listed cell that is not positive, and not flat; lists cells that are not positive then.
    /// Whether there was one of each such cell, and of at least one.
    fn take_hard_back(
        &mut self,
        untangling: &mut Untangling<G>,
        failures: &mut Failures,
        take_back: TakeBack<'_, G>,
    ) -> Result<bool> {
        let (n_listed, mut is_one_back) = (failures.cells.len(), false);
        for k in 0..untangling.cells.len() {
            let c = untangling.cells[k];
            if self.is_positive(c) || self.is_flat(c) {
                continue;
            }
            let Some(s) = take_back(self, c)? else { return Ok(false) };
            self.check_star_from(c, s, failures)?;
            is_one_back = true;
        }
        memory::append(&mut untangling.cells, &failures.cells[n_listed..])?;
        failures.cells.truncate(n_listed);
        Ok(is_one_back)
    }

    /// Exchanges cells that are not positive, of which those listed are all, while any can be; lists those left.
    fn turn_cells(
        &mut self,
        untangling: &mut Untangling<G>,
        inner: &G::Point,
        most_hard: usize,
    ) -> Result<Turned> {
        loop {
            let before = untangling.flips.n_flips;
            let (mut n_left, mut n_hard) = (0, 0);
            for k in 0..untangling.cells.len() {
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
                    return Ok(Turned::TooFew);
                }
            }
            untangling.cells.truncate(n_left);
            if n_left == 0 {
                return Ok(Turned::All);
            }
            if untangling.flips.n_flips == before {
                let are_peeled = n_hard == 0 && self.peel(untangling)?;
                return Ok(if are_peeled {
                    Turned::All
                } else if n_hard == 0 {
                    Turned::TooFew
                } else {
                    Turned::Stuck
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
            self.complex.undo_flips(flips.journal.drain(before.0..).rev());
            flips.changed.truncate(before.1);
            flips.suspects.truncate(before.2);
            flips.n_flips = before.3;
        }
        Ok(false)
    }

    /// As [`fill_dents`](Self::fill_dents), where these ridges are listed, those at the end first.
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

    /// Whether there is a finite cell in this slot, which may be free.
    pub(super) fn is_finite(&self, c: Slot) -> bool {
        !self.complex.is_free(c) && !self.complex.cell(c).is_ghost()
    }

    /// Whether there is a ghost cell in this slot, which may be free.
    pub(in crate::delaunay) fn is_ghost(&self, c: Slot) -> bool {
        !self.complex.is_free(c) && self.complex.cell(c).is_ghost()
    }

    /// Exchanges the cells at a facet, or those at an edge of it if these are three; given a point within all, only if
    /// the new cells are positive. Whether that has been done.
    pub(super) fn exchange_across(
        &mut self,
        facet: Facet,
        inner: Option<&G::Point>,
        untangling: &mut Untangling<G>,
    ) -> Result<bool> {
        let Some(mut exchange) = self.find_exchange(facet, inner, &mut untangling.flips.certificates) else {
            return Ok(false);
        };
        let mut outer = [([SiteId::NONE; 3], Facet::NONE); MOST_OUTER];
        let mut n_outer = 0;
        for &c in exchange.old() {
            let cell = self.complex.cell(c);
            for i in (0..G::Corners::N).filter(|&i| !exchange.old().contains(&cell.neighbour(i).cell())) {
                // More if the third cell is not at the second one.
                let Some(facet) = outer.get_mut(n_outer) else { return Ok(false) };
                *facet = (key(&cell.corners, i), cell.neighbour(i));
                n_outer += 1;
            }
        }
        if !exchange.glue(&outer[..n_outer]) {
            return Ok(false);
        }
        let Untangling { flips, slots, .. } = untangling;
        let (old, new) = (exchange.old(), &exchange.new[..exchange.n_new]);
        slots.clear();
        memory::append(slots, old)?;
        memory::reserve(&mut flips.suspects, new.len() * G::Corners::N)?;
        memory::reserve(&mut flips.changed, new.len())?;
        self.complex.prepare_replacing(new.len(), slots, &mut flips.journal, 0)?;
        self.complex.replace(old.len(), new, slots, &mut flips.journal);
        for &slot in &slots[..new.len()] {
            flips.changed.push(slot);
            flips.suspects.extend((0..G::Corners::N).map(|i| Facet::new(slot, i)));
        }
        flips.n_flips += 1;
        Ok(true)
    }

    /// The cells that [`exchange_across`](Self::exchange_across) exchanges, and the new ones, not glued yet. `None` also
    /// where a site would be left without a cell.
    fn find_exchange(
        &self,
        facet: Facet,
        inner: Option<&G::Point>,
        certificates: &mut u64,
    ) -> Option<Exchange<G::Corners>> {
        let cell = self.complex.cell(facet.cell());
        let across = cell.neighbour(facet.index());
        let apex = self.complex.apex(across);
        let mut exchange = Exchange::of([facet.cell(), across.cell()]);
        let mut third = None;
        for i in (0..G::Corners::N).filter(|&i| i != facet.index()) {
            if self.complex.apex(cell.neighbour(i)) == apex {
                if third.is_some() || G::D == 2 {
                    return None;
                }
                third = Some(i);
                exchange.old[2] = cell.neighbour(i).cell();
                exchange.n_old = 3;
            }
        }
        for i in (0..G::Corners::N).filter(|&i| i != facet.index() && Some(i) != third) {
            let corners = with_ghost_last(cell.corners.with(i, apex));
            *certificates += 1;
            if inner.is_some_and(|inner| !self.would_be_positive(&corners, inner)) {
                return None;
            }
            exchange.new[exchange.n_new].corners = corners;
            exchange.n_new += 1;
        }
        Some(exchange)
    }

    /// Whether a cell that is not there yet is positive; a ghost, if this point is on the inner side.
    fn would_be_positive(&self, corners: &G::Corners, inner: &G::Point) -> bool {
        if corners[Self::LAST] == INFINITE {
            G::orientation_with(&self.filter, self.view(), corners, Self::LAST, inner) < 0.0
        } else {
            G::orientation(&self.filter, self.view(), corners) > 0.0
        }
    }
}

#[cfg(test)]
mod tests;
