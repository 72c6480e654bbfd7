//! Flips, while there are any, and undoing them.
//!
//! A facet that fails the empty-sphere test is flipped. In the plane without weights that is always possible and leads to
//! the Delaunay triangulation (Lawson, 10.1016/B978-0-12-587260-7.50011-X). With weights the two cells there need not make a
//! convex quadrilateral (Edelsbrunner and Shah, 10.1007/BF01975867). In space it is done if a 2-3, 3-2 or 4-4 flip there
//! makes positive cells (Joe, 10.1016/0167-8396(91)90038-D). Every flip lowers the lifted surface, so there is an
//! end, but that can be short of the Delaunay triangulation: what is around a facet of space that is stuck is then
//! triangulated again, if it is small (`islands`). The cells that a flip is about to change are kept in a
//! journal, so that all can be as it was; flips that stay are entered into the record of the complex from there.
//!
//! **Threads.** Cells near each other in space are near each other in storage once they have been sorted. So each
//! thread flips in a range of the cells, all with about as many failing facets, and leaves flips that need cells of
//! others alone. As flips of different ranges have no cell in common, it is as if they had been done one after the
//! other: what comes of them depends on how many ranges there are, and not on how many threads. What is left is flipped
//! by one thread. For 300,000 points that move by a fiftieth of a spacing two threads
//! are 1.7 and 1.5 times as fast as one, all of the repair included (`examples/thread_scaling`).
//!
//! Invariant: a facet whose cells have changed since it was found to hold is a suspect, or listed as stuck or as one
//! for later. Sites keep their old cells until no flip will be taken back.

use islands::Island;
use untangling::Untangling;

use super::flipper::Flipper;
use super::flips::Flips;
use super::site::Sites;
use super::{Delaunay, Geometry};
use crate::complex::{Corners, Facet, Row, starts_of_ranges};
use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::machine::prefetch::{AHEAD, prefetch};

/// Failing facets for each thread that take longer to flip than the thread to wake up; and as many if all threads are
/// to be used.
const FLIPPED_AT_LEAST: usize = 500;
const FLIPPED_IF_ASKED: usize = 32;

/// Rows of a journal for which the memory is always kept.
const KEPT: usize = 1 << 14;

/// A larger one is given back when it has this number of times the rows that were needed.
const HELD_PER_NEEDED: usize = 4;

/// Least number of free cells made at once where there are none.
const ROOM: usize = 16;

/// What happens to facets that are stuck.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum WhenStuck {
    /// What is around them is triangulated again, where that is possible.
    Fill,
    /// They stay: to place one vertex costs no more than to triangulate around it.
    Leave,
}

/// The flips of the last call, and the memory for those of the next one.
#[derive(Debug)]
pub(super) struct AllFlips<G: Geometry> {
    /// Flips of the calling thread.
    own: Flips<G>,
    /// Flips of several threads, made before the calling thread's own.
    parts: Vec<Flips<G>>,
    island: Island<G::Corners>,
    /// What was exchanged before all flips.
    untangling: Untangling<G>,
}

impl<G: Geometry> Default for AllFlips<G> {
    fn default() -> Self {
        AllFlips {
            own: Flips::default(),
            parts: Vec::new(),
            island: Island::default(),
            untangling: Untangling::default(),
        }
    }
}

impl<G: Geometry> AllFlips<G> {
    pub(super) fn memory_bytes(&self) -> usize {
        let flips = self.parts.iter().chain([&self.own]);
        flips.map(Flips::memory_bytes).sum::<usize>()
            + memory::bytes_of(&self.parts)
            + self.island.memory_bytes()
            + self.untangling.memory_bytes()
    }
}

impl<G: Geometry> Delaunay<G> {
    /// Flips until no facet of a triangulation fails, where `suspects` are all that may; leaves in `stuck` those that
    /// fail still as they cannot be flipped, all of cells that are there. There are none in the plane without weights; if
    /// there are, [`undo_flips`](Self::undo_flips) must follow. Returns the number of flips; `None` if more than `most`
    /// certificates would have to be evaluated on the way, exact evaluations counted as
    /// [so many](CERTIFICATES_PER_EXACT), and then [`undo_flips`](Self::undo_flips) must follow, too.
    /// After an error all is as it was.
    pub(crate) fn flip_all(
        &mut self,
        suspects: &mut Vec<Facet>,
        stuck: &mut Vec<Facet>,
        most: u64,
    ) -> Result<Option<u64>> {
        let mut flips = memory::take_made(&mut self.flips)?;
        std::mem::swap(&mut flips.own.suspects, suspects);
        std::mem::swap(&mut flips.own.stuck, stuck);
        // Unless the cells are sorted nearly all flips would need those of several threads.
        let n = if self.is_sorted { flips.own.suspects.len() } else { 0 };
        let n_ranges = self.threads.parts_of(n, FLIPPED_AT_LEAST, FLIPPED_IF_ASKED);
        let done = self.flip_listed(&mut flips, n_ranges, most, WhenStuck::Fill);
        std::mem::swap(&mut flips.own.suspects, suspects);
        std::mem::swap(&mut flips.own.stuck, stuck);
        self.flips = Some(flips);
        done
    }

    /// Flips from the facets of the gathered star outwards, until no facet fails; `None`, and no change, if flips are
    /// stuck.
    pub(super) fn flip_star(&mut self) -> Result<Option<u64>> {
        let mut flips = memory::take_made(&mut self.flips)?;
        let done = self.flip_star_with(&mut flips);
        let is_stuck = !flips.own.stuck.is_empty();
        self.flips = Some(flips);
        let done = done?.filter(|_| !is_stuck);
        if done.is_none() {
            self.undo_flips();
        }
        Ok(done)
    }

    fn flip_star_with(&mut self, flips: &mut AllFlips<G>) -> Result<Option<u64>> {
        let Flips { suspects, .. } = &mut flips.own;
        suspects.clear();
        memory::reserve(suspects, self.star.len() * G::Corners::N)?;
        for &(c, at) in &self.star {
            let cell = self.complex.cell(c);
            // A facet between two cells of the star is a suspect once.
            let is_own = |&i: &usize| i == at as usize || c < cell.neighbour(i).cell();
            suspects.extend((0..G::Corners::N).filter(is_own).map(|i| Facet::new(c, i)));
        }
        self.flip_listed(flips, 1, u64::MAX, WhenStuck::Leave)
    }

    /// Flips from the suspects, and keeps that unless flips are stuck or too many; returns their number, and `None` in
    /// the latter case. After an error all is as it was.
    fn flip_listed(
        &mut self,
        flips: &mut AllFlips<G>,
        n_ranges: usize,
        most: u64,
        when_stuck: WhenStuck,
    ) -> Result<Option<u64>> {
        let done = self.flip_as_far_as_possible(flips, n_ranges, most, when_stuck);
        let is_exhausted = flips.own.is_exhausted;
        let is_done = flips.own.stuck.is_empty() && !is_exhausted;
        let done = done.and_then(|()| if is_done { self.enter_flips(flips) } else { Ok(()) });
        if let Err(error) = done {
            self.take_back(flips);
            return Err(error);
        }
        let mut n_flips = 0;
        for part in flips.parts.iter_mut().chain([&mut flips.own]) {
            n_flips += part.n_flips;
            self.certificates += part.certificates;
            if is_done {
                self.keep(part);
            }
        }
        let untangled = &mut flips.untangling.flips;
        if is_done && untangled.n_flips > 0 {
            n_flips += untangled.n_flips;
            self.keep(untangled);
            untangled.begin(u64::MAX);
        }
        Ok((!is_exhausted).then_some(n_flips))
    }

    fn flip_as_far_as_possible(
        &mut self,
        flips: &mut AllFlips<G>,
        n_ranges: usize,
        most: u64,
        when_stuck: WhenStuck,
    ) -> Result<()> {
        flips.own.begin(most);
        flips.parts.iter_mut().for_each(|part| part.begin(most));
        if n_ranges > 1 {
            self.flip_side_by_side(flips, n_ranges)?;
            flips.own.is_exhausted = flips.parts.iter().any(|part| part.is_exhausted);
            if flips.own.is_exhausted {
                return Ok(());
            }
        }
        let (own, are_sites_far) = (&mut flips.own, self.is_far());
        loop {
            let sites = Sites::new(&self.sites, &self.keys);
            let cells = &mut self.complex.whole();
            Flipper { filter: &self.filter, sites, cells, are_sites_far }.flip_all(own);
            if own.has_failed {
                return Err(Error::OutOfMemory { bytes: own.journal.len() * size_of::<Row<G::Corners>>() });
            }
            if own.is_exhausted {
                return Ok(());
            }
            if own.later.is_empty() {
                if own.stuck.is_empty()
                    || when_stuck == WhenStuck::Leave
                    || !self.fill_islands(own, &mut flips.island)?
                {
                    return Ok(());
                }
                continue;
            }
            // If there were only a few more each time, facets would be put off again and again.
            self.complex.create_free(ROOM.max(own.later.len() / 2))?;
            std::mem::swap(&mut own.suspects, &mut own.later);
        }
    }

    /// Flips as far as that is possible in ranges of the cells, by as many threads as there are.
    fn flip_side_by_side(&mut self, flips: &mut AllFlips<G>, n_ranges: usize) -> Result<()> {
        let AllFlips { own: Flips { suspects, .. }, parts, .. } = flips;
        let starts = starts_of_ranges(suspects.iter().map(|facet| facet.cell()), n_ranges)?;
        let missing = starts.len().saturating_sub(parts.len());
        memory::reserve_exact(parts, missing)?;
        parts.resize_with(parts.len() + missing, Flips::default);
        for (k, part) in parts.iter_mut().enumerate().take(starts.len()) {
            let range = starts[k]..starts.get(k + 1).copied().unwrap_or(Slot::NONE);
            for &facet in suspects.iter().filter(|facet| range.contains(&facet.cell())) {
                memory::push(&mut part.suspects, facet)?;
            }
        }
        let (sites, filter, are_sites_far) =
            (Sites::new(&self.sites, &self.keys), &self.filter, self.is_far());
        let n_threads = self.threads.for_work(starts.len(), 1, 1);
        self.complex.divided(&starts, parts, n_threads, |cells, part| {
            Flipper { filter, sites, cells, are_sites_far }.flip_all(part);
        })?;
        suspects.clear();
        for part in parts {
            if part.has_failed {
                return Err(Error::OutOfMemory { bytes: part.journal.len() * size_of::<Row<G::Corners>>() });
            }
            memory::reserve(suspects, part.later.len() + part.stuck.len())?;
            suspects.append(&mut part.later);
            suspects.append(&mut part.stuck);
        }
        Ok(())
    }

    /// Enters flips that will stay into the records.
    fn enter_flips(&mut self, flips: &AllFlips<G>) -> Result<()> {
        let untangled = &flips.untangling.flips;
        for part in [untangled].into_iter().chain(&flips.parts).chain([&flips.own]) {
            self.complex.note_rows(&part.journal)?;
            if let Some(changed) = &mut self.changed {
                memory::reserve(changed, part.changed.len() + part.made.len())?;
                changed.extend_from_slice(&part.changed);
                changed.extend_from_slice(&part.made);
            }
        }
        Ok(())
    }

    /// Nothing of this will be taken back by itself: gives the sites their new cells.
    fn keep(&mut self, flips: &mut Flips<G>) {
        for (k, &c) in flips.changed.iter().enumerate() {
            if let Some(&next) = flips.changed.get(k + AHEAD) {
                prefetch(self.complex.cells(), next.index());
            }
            let cell = *self.complex.cell(c);
            if !cell.is_free() {
                for &s in cell.corners.as_ref() {
                    self.corner_mut(s).cell = c;
                }
                self.recent = c;
            }
        }
        self.loosen_rows(&flips.journal);
        // Keep the memory while timestamps change much, not after one that has changed everything.
        let (needed, held) = (flips.journal.len(), flips.journal.capacity());
        if held > self.sites.len().max(KEPT) && held > HELD_PER_NEEDED * needed {
            flips.journal = Vec::new();
        }
        flips.journal.clear();
    }

    /// Takes the flips of the last [`flip_all`](Self::flip_all) back, and those of [`untangle`](Self::untangle) before
    /// it or after it.
    pub(crate) fn undo_flips(&mut self) {
        if let Some(mut flips) = self.flips.take() {
            self.take_back(&mut flips);
            self.flips = Some(flips);
        }
    }

    fn take_back(&mut self, flips: &mut AllFlips<G>) {
        let AllFlips { own, parts, untangling, .. } = flips;
        for flips in parts.iter_mut().chain([own]).rev() {
            flips.suspects.clear();
            self.complex.undo_rows(flips.journal.drain(..).rev());
        }
        self.take_untangling_back(untangling);
    }
}

/// The sites of the facet opposite corner `i`, in ascending order.
fn key<C: Corners>(corners: &C, i: usize) -> [SiteId; 3] {
    let mut key = [SiteId::NONE; 3];
    for (k, site) in key.iter_mut().enumerate().take(C::N - 1) {
        *site = corners[(i + k + 1) % C::N];
    }
    key.sort_unstable();
    key
}

mod exchange;
mod islands;
mod peel;
#[cfg(test)]
mod tests;
mod untangle;
mod untangling;
