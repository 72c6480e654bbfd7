//! The slack of each bi-cell: what is left of its tolerance.
//!
//! Every site has an odometer, an upper bound of the way it has gone. For each cell are kept the slacks of the
//! bi-cells of its facets, and for each corner a *deadline*: the odometer of the corner when these slacks were
//! entered, plus the least of them. While no corner has passed its deadline in either of two cells with a common
//! facet, none of the D + 2 vertices has gone farther than the tolerance that their bi-cell had when it was computed:
//! each is a corner of one of the cells, and both have at most that slack for the facet.
//!
//! When a corner passes its deadline the cell is *referred* to the present: the longest way of a corner since is
//! taken off its slacks, which is exact, and new deadlines follow. The bi-cells that have none left are checked and
//! computed again; they concern only the two cells.
//!
//! **Units.** Ways and slacks are integers of 16 bits. The unit is a power of two of about a sixteenth of the mean
//! way of a timestamp, leaps apart, chosen when all are computed, and again when it has not fitted for long. Ways are
//! rounded up, slacks down. Odometers may overflow: only differences count, which are below 2¹⁵ in magnitude as slacks
//! are cut at 2¹⁴ and the ways of one timestamp at one more.
//!
//! Cost: a timestamp reads 16 bytes for each cell beside its corners (12 in the plane), and the odometers of these.
//! Memory: as many bytes for a cell, and 2 for a site.

use crate::complex::{Complex, Corners, Facet};
use crate::delaunay::{Delaunay, Failures, Moving, Shape};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::prefetch;
use crate::motion::filters::bicell::{BiCell, for_bicells};
use crate::motion::filters::margin::Margin;
use crate::motion::filters::slack::entries::{BLOCK, deadline, entry, least, list_expired_of, slack};
use crate::motion::filters::slack::pass::{CheckFirst, Pass};
use crate::motion::filters::store::{Store, TimestampSteps};
use crate::predicates::distance_above;

/// A number for each corner of a cell.
type EntriesOf<G> = <<G as Shape>::Corners as Corners>::Of<u32>;

/// Greatest slack, in units.
const LIMIT: u16 = 1 << 14;
/// The slack of a bi-cell that has none: as a signed number it is negative.
const NONE_LEFT: u16 = u16::MAX;
/// Units in the mean way of a timestamp when they are chosen, to a factor of two.
const UNITS: f64 = 16.0;
/// How much smaller or greater it may become, and for how many timestamps it may be beyond that.
const FITTING: f64 = 16.0;
const UNFIT: u32 = 32;
/// A slack of this number of timestamps is enough: no effort is made to find more.
const ENOUGH: f64 = 64.0;
/// How many cells or bi-cells in advance to ask for.
const AHEAD: usize = 8;

/// What has become of the bi-cells that have no slack left.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Expired {
    /// How many have been checked, which are all; those that hold have slack again.
    Checked(u64),
    /// Too many cells have some, and none is checked.
    TooMany,
}

#[derive(Debug, Default)]
pub(in crate::motion) struct Slacks<G: Moving> {
    margin: Margin,
    /// How far every vertex may still go until the kernel's static filter must cover more.
    room: f64,
    /// Units in a length of 1: a power of two.
    per_length: f64,
    /// For how many timestamps the unit has not fitted.
    unfit: u32,
    /// A tolerance that need not be sharp.
    enough: f64,
    /// By site, odometers.
    travelled: Vec<u16>,
    /// By cell: in the lower half of entry `i` the deadline of corner `i`, in the upper half the slack of facet `i`,
    /// as a signed number, since the cell was last referred.
    entries: Vec<EntriesOf<G>>,
    /// Cells of which a corner has passed its deadline, and the facets of bi-cells that have no slack left.
    expired: Vec<Slot>,
    facets: Vec<Facet>,
    /// Cells that are *open*: referred to the present, with odometers in place of deadlines. A bit for each.
    open: Vec<Slot>,
    is_open: Vec<u64>,
}

impl<G: Moving> Slacks<G> {
    /// A copy.
    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(Slacks {
            margin: self.margin,
            room: self.room,
            per_length: self.per_length,
            unfit: self.unfit,
            enough: self.enough,
            travelled: memory::copy_of(&self.travelled)?,
            entries: memory::copy_of(&self.entries)?,
            expired: memory::copy_of(&self.expired)?,
            facets: memory::copy_of(&self.facets)?,
            open: memory::copy_of(&self.open)?,
            is_open: memory::copy_of(&self.is_open)?,
        })
    }

    /// Follows the number of sites and cells.
    fn grow(&mut self, kernel: &Delaunay<G>) -> Result<()> {
        let more_sites = kernel.sites().len().saturating_sub(self.travelled.len());
        let more_cells = kernel.complex().n_slots().saturating_sub(self.entries.len());
        memory::reserve(&mut self.travelled, more_sites)?;
        memory::reserve(&mut self.entries, more_cells)?;
        self.entries.resize(self.entries.len() + more_cells, EntriesOf::<G>::filled(0));
        self.travelled.resize(self.travelled.len() + more_sites, 0);
        let more_words = self.entries.len().div_ceil(64).saturating_sub(self.is_open.len());
        memory::reserve(&mut self.is_open, more_words)?;
        self.is_open.resize(self.is_open.len() + more_words, 0);
        Ok(())
    }

    /// Computes the bi-cells of all facets; returns how many.
    fn compute_all(&mut self, kernel: &Delaunay<G>) -> u64 {
        let complex = kernel.complex();
        self.is_open.fill(u64::MAX);
        let mut pass = Pass::new(CheckFirst::Not);
        let n = for_bicells(kernel, |facet| self.push(kernel, facet, &mut pass));
        self.enter_batch(kernel, &mut pass);
        self.is_open.fill(0);
        complex.live().for_each(|c| self.set_deadlines(complex, c));
        n
    }

    fn choose_unit(&mut self, kernel: &Delaunay<G>, steps: TimestampSteps<'_, G>) {
        let mean_of_up_to = |most: f64| {
            let (mut sum, mut n) = (0.0, 0.0);
            for site in kernel.sites()[1..].iter().filter(|site| site.is_live()) {
                let there = steps.other_positions.get(site.id.index());
                let way = there.map_or(0.0, |p| distance_above(&site.point, p));
                if way <= most {
                    sum += way;
                    n += 1.0;
                }
            }
            sum / n
        };
        let of_all = mean_of_up_to(f64::INFINITY);
        // Without those that leap, which may go a million times as far as the others, unless the others rest.
        let of_others = mean_of_up_to(FITTING * of_all);
        let mean = if of_others > 0.0 { of_others } else { of_all };
        // Of no use, but no error either, where nothing moves. A power of two that is no number any more would make
        // all ways 0.
        let units = (UNITS / mean).clamp(2f64.powi(-900), 2f64.powi(900));
        self.per_length = f64::from_bits(units.to_bits() >> 52 << 52);
        self.unfit = 0;
        self.expect(mean);
    }

    /// Computes the bi-cells of all facets of these cells, each listed once; returns how many.
    fn recompute(&mut self, kernel: &mut Delaunay<G>, cells: &[Slot]) -> Result<u64> {
        memory::reserve(&mut self.open, (1 + G::Corners::N) * cells.len())?;
        for &c in cells {
            self.is_open[c.index() / 64] |= 1 << (c.index() % 64);
            self.open.push(c);
        }
        let mut pass = Pass::new(CheckFirst::Not);
        let mut n = 0;
        kernel.for_facets_of(cells, |kernel, facet| {
            self.push(kernel, facet, &mut pass);
            n += 1;
        });
        self.enter_batch(kernel, &mut pass);
        self.close(kernel.complex());
        Ok(n)
    }

    /// The vertices are going to move by about so much in a timestamp. Whether the unit still fits.
    fn expect(&mut self, step: f64) -> bool {
        self.enough = ENOUGH * step;
        let units = step * self.per_length / UNITS;
        let fits = units * FITTING > 1.0 && units < FITTING;
        self.unfit = if fits { 0 } else { self.unfit + 1 };
        self.unfit < UNFIT
    }

    /// All vertices have moved, by these distances at most, and on average, where none counts as longer than the
    /// [longest](Self::longest_way): the kernel's static filter follows.
    /// Whether the unit still fits.
    pub(in crate::motion) fn end_motion(
        &mut self,
        kernel: &mut Delaunay<G>,
        mean: f64,
        greatest: f64,
    ) -> bool {
        self.room = (self.room - greatest).next_down();
        if self.room < 0.0 {
            self.tighten_filter(kernel);
        }
        self.expect(mean)
    }

    /// No way of a timestamp is entered as longer than about this one.
    pub(in crate::motion) fn longest_way(&self) -> f64 {
        f64::from(LIMIT) / self.per_length
    }

    /// Adds to the way of a site; `distance` is an upper bound.
    #[inline(always)]
    pub(in crate::motion) fn travel(&mut self, s: SiteId, distance: f64) {
        // The cut is that of a conversion to less than the range.
        let way = ((distance * self.per_length) as u32).min(u32::from(LIMIT)) as u16 + 1;
        let travelled = &mut self.travelled[s];
        *travelled = travelled.wrapping_add(way);
    }

    /// Checks the bi-cells that have no slack left after a motion from where the vertices were `before`, by id, by at
    /// most `greatest` each, and recomputes those that hold, unless more than `most` cells are concerned.
    pub(in crate::motion) fn check_expired(
        &mut self,
        kernel: &Delaunay<G>,
        before: &[G::Point],
        greatest: f64,
        most: usize,
        failures: &mut Failures,
    ) -> Result<Expired> {
        let complex = kernel.complex();
        let mut expired = std::mem::take(&mut self.expired);
        let mut facets = std::mem::take(&mut self.facets);
        let are_few = self.list_expired(kernel, most, &mut expired);
        let mut outcome = Ok(Expired::TooMany);
        if are_few && self.reserve(expired.len(), &mut facets).is_ok() {
            self.list_facets(complex, &expired, &mut facets);
            let mut checked = Ok(());
            let mut pass = Pass::new(CheckFirst::Moved(before, greatest, failures, &mut checked));
            let n = self.check_facets(kernel, &facets, &mut pass);
            self.close(complex);
            outcome = checked.map(|()| Expired::Checked(n));
        }
        self.expired = expired;
        self.facets = facets;
        outcome
    }

    /// Makes room for the facets of `n_cells` cells, and for these and their neighbours to be open.
    fn reserve(&mut self, n_cells: usize, facets: &mut Vec<Facet>) -> Result<()> {
        memory::reserve(facets, G::Corners::N * n_cells)?;
        memory::reserve(&mut self.open, (1 + G::Corners::N) * n_cells)
    }

    /// Lists the cells of which a corner has passed its deadline; `false` if these are more than `most`.
    fn list_expired(&self, kernel: &Delaunay<G>, most: usize, expired: &mut Vec<Slot>) -> bool {
        let cells = &kernel.complex().cells()[..self.entries.len()];
        // There is an odometer for each site.
        let travelled = &self.travelled[..kernel.sites().len()];
        let mut listed = [0; BLOCK];
        expired.clear();
        for (b, (cells, entries)) in cells.chunks(BLOCK).zip(self.entries.chunks(BLOCK)).enumerate() {
            let listed = list_expired_of(cells, entries, travelled, &mut listed);
            if expired.len() + listed.len() > most || memory::reserve(expired, listed.len()).is_err() {
                return false;
            }
            expired.extend(listed.iter().map(|&k| Slot::at(b * BLOCK + k as usize)));
        }
        true
    }

    /// Lists the facets without slack of these cells, and opens these.
    fn list_facets(&mut self, complex: &Complex<G::Corners>, cells: &[Slot], facets: &mut Vec<Facet>) {
        facets.clear();
        for (k, &c) in cells.iter().enumerate() {
            if let Some(&next) = cells.get(k + AHEAD) {
                prefetch(&self.entries, next.index());
                prefetch(complex.cells(), next.index());
            }
            self.open(complex, c);
            for i in 0..G::Corners::N {
                if slack(self.entries[c][i]) < 0 {
                    facets.push(Facet::new(c, i));
                }
            }
        }
    }

    /// Checks and computes the listed bi-cells; returns how many they are. Each may be listed from both sides.
    fn check_facets(&mut self, kernel: &Delaunay<G>, facets: &[Facet], pass: &mut Pass<'_, G>) -> u64 {
        let complex = kernel.complex();
        let mut n = 0;
        for (k, &facet) in facets.iter().enumerate() {
            if let Some(&next) = facets.get(k + AHEAD) {
                let across = complex.cell(next.cell()).neighbour(next.index()).cell();
                prefetch(&self.entries, across.index());
                prefetch(complex.cells(), across.index());
            }
            if slack(self.entries[facet.cell()][facet.index()]) < 0 {
                self.push(kernel, facet, pass);
                n += 1;
            }
        }
        self.enter_batch(kernel, pass);
        n
    }

    /// Has a bi-cell computed, given from an open cell; until then it has the greatest slack.
    #[inline(always)]
    fn push(&mut self, kernel: &Delaunay<G>, facet: Facet, pass: &mut Pass<'_, G>) {
        let complex = kernel.complex();
        let across = complex.cell(facet.cell()).neighbour(facet.index());
        self.open(complex, across.cell());
        self.enter([facet, across], LIMIT);
        let bicell = BiCell::of(kernel, facet);
        let Some(points) = bicell.interior() else {
            self.enter_at_hull(kernel, [facet, across], bicell.hull_tolerance(), pass);
            return;
        };
        if pass.push([facet, across], points) {
            self.enter_batch(kernel, pass);
        }
    }

    #[cold]
    fn enter_at_hull(
        &mut self,
        kernel: &Delaunay<G>,
        sides: [Facet; 2],
        tolerance: f64,
        pass: &mut Pass<'_, G>,
    ) {
        let holds = pass.holds_at_hull(kernel, sides[0], tolerance);
        self.enter(sides, if holds { self.slack_of(tolerance) } else { NONE_LEFT });
    }

    /// Enters the slacks of the bi-cells that wait in a pass.
    fn enter_batch(&mut self, kernel: &Delaunay<G>, pass: &mut Pass<'_, G>) {
        pass.empty(kernel, self.enough, |sides, tolerance| {
            self.enter(sides, tolerance.map_or(NONE_LEFT, |tolerance| self.slack_of(tolerance)));
        });
    }

    fn slack_of(&self, tolerance: f64) -> u16 {
        ((tolerance * self.per_length) as u32).min(u32::from(LIMIT)) as u16
    }

    /// Enters the slack of a bi-cell for both cells, which are open.
    #[inline(always)]
    fn enter(&mut self, sides: [Facet; 2], slack: u16) {
        for side in sides {
            self.entries[side.cell()][side.index()] = entry(0, slack as i16);
        }
    }

    /// Refers a cell to the present, unless it is.
    #[inline(always)]
    fn open(&mut self, complex: &Complex<G::Corners>, c: Slot) {
        let (word, bit) = (&mut self.is_open[c.index() / 64], 1 << (c.index() % 64));
        if *word & bit != 0 {
            return;
        }
        *word |= bit;
        self.open.push(c);
        let corners = complex.cell(c).corners;
        let entries = &mut self.entries[c];
        let least = least(entries) as u16;
        let mut way = 0;
        for k in 0..G::Corners::N {
            let reference = deadline(entries[k]).wrapping_sub(least);
            way = way.max(self.travelled[corners[k]].wrapping_sub(reference));
        }
        // There is nowhere more to be used up.
        let way = way.min(LIMIT + 1) as i16;
        for i in 0..G::Corners::N {
            entries[i] = entry(0, (slack(entries[i]) - way).max(-1));
        }
    }

    /// Gives all open cells their deadlines.
    fn close(&mut self, complex: &Complex<G::Corners>) {
        let open = std::mem::take(&mut self.open);
        for &c in &open {
            self.is_open[c.index() / 64] = 0;
            self.set_deadlines(complex, c);
        }
        self.open = open;
        self.open.clear();
    }

    #[inline(always)]
    fn set_deadlines(&mut self, complex: &Complex<G::Corners>, c: Slot) {
        let corners = complex.cell(c).corners;
        let entries = &mut self.entries[c];
        let least = least(entries);
        for k in 0..G::Corners::N {
            let travelled = self.travelled[corners[k]];
            entries[k] = entry(travelled.wrapping_add(least as u16), slack(entries[k]));
        }
    }
}

impl<G: Moving> Store<G> for Slacks<G> {
    fn prepare(&mut self, kernel: &mut Delaunay<G>, _: usize, steps: TimestampSteps<'_, G>) -> Result<u64> {
        self.travelled.clear();
        self.entries.clear();
        self.is_open.clear();
        self.margin = Margin::around_all(kernel);
        self.room = self.margin.distance();
        self.grow(kernel)?;
        self.choose_unit(kernel, steps);
        Ok(self.compute_all(kernel))
    }

    fn follow(
        &mut self,
        kernel: &mut Delaunay<G>,
        site_of: &[SiteId],
        _: TimestampSteps<'_, G>,
        cells: &[Slot],
        relocated: &[VertexId],
    ) -> Result<u64> {
        self.grow(kernel)?;
        for &v in relocated {
            let point = kernel.site(site_of[v]).point;
            self.margin.cover(kernel, &point);
        }
        self.recompute(kernel, cells)
    }

    fn tighten_filter(&mut self, kernel: &mut Delaunay<G>) {
        self.margin.tighten(kernel);
        self.room = self.margin.distance();
    }

    fn memory_bytes(&self) -> usize {
        self.travelled.capacity() * size_of::<u16>()
            + memory::bytes_of(&self.expired)
            + memory::bytes_of(&self.facets)
            + memory::bytes_of(&self.open)
            + self.is_open.capacity() * size_of::<u64>()
            + self.entries.capacity() * size_of::<EntriesOf<G>>()
    }
}
