//! Undoing changes of the kernel: one that fails leaves no trace.
//!
//! Between [`begin`](Delaunay::begin) and [`end`](Delaunay::end) the complex keeps a [record](crate::complex) of its
//! cells, and sites that are removed, added or renamed are *logged*: what they were is kept, in the order of the
//! changes. [`undo`](Delaunay::undo) goes back through both and needs no memory.
//!
//! The filter holds for all places before as well, whatever it is made for meanwhile ([`tighten_filter`]).
//!
//! Places are not kept: a caller that moves a site and leaves the cells as they are, or lets flips repair them, knows
//! where it was. Those of sites that are removed are kept, as these may come back elsewhere.
//!
//! [`tighten_filter`]: Delaunay::tighten_filter

use super::flat::Flat;
use super::{Delaunay, Geometry, Site};
use crate::complex::{Complex, Corners, KeptRecord};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;

/// What a site was.
#[derive(Clone, Copy, Debug)]
struct Logged<G: Geometry> {
    s: SiteId,
    before: Site<G>,
    /// Whether its place was kept as well.
    has_place: bool,
}

/// What sites were before a change.
#[derive(Debug)]
pub(super) struct Log<G: Geometry> {
    is_on: bool,
    /// The box for which the filter held before.
    lower: G::Point,
    upper: G::Point,
    sites: Vec<Logged<G>>,
    /// How many have been set aside with changes that may be taken up again.
    n_aside: usize,
    /// The cells, where the change has given up all of them.
    cells: Option<Box<Complex<G::Corners>>>,
    /// What stood in for cells, where it has to be put back.
    flat: Option<Box<Flat<G>>>,
}

impl<G: Geometry> Default for Log<G> {
    fn default() -> Self {
        let none = G::Point::default();
        Log { is_on: false, lower: none, upper: none, sites: Vec::new(), n_aside: 0, cells: None, flat: None }
    }
}

impl<G: Geometry> Log<G> {
    pub(super) fn memory_bytes(&self) -> usize {
        self.sites.capacity() * size_of::<Logged<G>>()
    }
}

/// A change that has been made, set aside so that others can be made after it and all be undone.
#[derive(Debug)]
pub(crate) struct KeptChange<G: Geometry> {
    lower: G::Point,
    upper: G::Point,
    sites: Vec<Logged<G>>,
    cells: Option<Box<Complex<G::Corners>>>,
    flat: Option<Box<Flat<G>>>,
    record: KeptRecord<G::Corners>,
}

impl<G: Geometry> KeptChange<G> {
    pub(crate) fn memory_bytes(&self) -> usize {
        self.sites.capacity() * size_of::<Logged<G>>()
            + self.record.memory_bytes()
            + memory::bytes_of_made(&self.cells, Complex::memory_bytes)
            + memory::bytes_of_made(&self.flat, Flat::memory_bytes)
    }
}

impl<G: Geometry> Delaunay<G> {
    /// Ends a change, and sets aside what undoes it.
    pub(crate) fn set_change_aside(&mut self) -> KeptChange<G> {
        self.n_replaced += self.complex.rows().len();
        let log = &mut self.log;
        log.is_on = false;
        log.n_aside += log.sites.len();
        KeptChange {
            lower: log.lower,
            upper: log.upper,
            sites: std::mem::take(&mut log.sites),
            cells: log.cells.take(),
            flat: log.flat.take(),
            record: self.complex.set_record_aside(),
        }
    }

    /// Takes up a change that was set aside, to be undone: those after it have been undone.
    pub(crate) fn take_change_up(&mut self, kept: KeptChange<G>) {
        let KeptChange { lower, upper, sites, cells, flat, record } = kept;
        if cells.is_none() {
            self.complex.take_record_up(record);
        }
        let n_aside = self.log.n_aside - sites.len();
        self.log = Log { is_on: true, lower, upper, sites, n_aside, cells, flat };
    }

    /// No change that has been set aside is taken up any more.
    pub(crate) fn forget_changes_aside(&mut self) {
        self.log.n_aside = 0;
    }

    /// Begins a change that may be undone.
    pub(crate) fn begin(&mut self) -> Result<()> {
        debug_assert!(!self.log.is_on);
        self.make_room_to_hide()?;
        self.begin_turning()?;
        self.complex.begin_record()?;
        self.log.is_on = true;
        self.pace.begin();
        (self.log.lower, self.log.upper) = (self.lower, self.upper);
        Ok(())
    }

    /// Whether a change is under way.
    pub(super) fn is_in_change(&self) -> bool {
        self.log.is_on
    }

    /// The box in which the sites were before the change, while there is one.
    pub(super) fn box_before(&self) -> Option<(G::Point, G::Point)> {
        self.log.is_on.then_some((self.log.lower, self.log.upper))
    }

    /// Logs a site that is about to be removed, or to be added: then it is free.
    #[inline(always)]
    pub(crate) fn log_site(&mut self, s: SiteId) -> Result<()> {
        self.log_as(s, true)
    }

    /// Logs a site whose id is about to change, and whose place is not the log's concern.
    pub(super) fn log_id(&mut self, s: SiteId) -> Result<()> {
        self.log_as(s, false)
    }

    fn log_as(&mut self, s: SiteId, has_place: bool) -> Result<()> {
        // Room in the list of free sites: this one may be dropped, and sites that have been added are all free again
        // when they are taken back, those of changes that were set aside as well.
        memory::reserve(&mut self.free_sites, self.log.n_aside + self.log.sites.len() + 1)?;
        if !self.log.is_on {
            return Ok(());
        }
        memory::push(&mut self.log.sites, Logged { s, before: self.sites[s], has_place })
    }

    /// Gives up all cells, which are kept only for `undo`. After an error they are still there.
    pub(super) fn give_up_cells(&mut self) -> Result<()> {
        if self.log.is_on && self.log.cells.is_none() {
            let kept = memory::made(&mut self.log.cells)?;
            std::mem::swap(kept, &mut self.complex);
        } else {
            self.complex = Complex::default();
        }
        Ok(())
    }

    /// Keeps what stands in for cells, if there are none, at the cost of a copy: without that, a change that has inserted a
    /// site, or removed or moved one, cannot be undone.
    pub(crate) fn keep_flat(&mut self) -> Result<()> {
        if !self.has_cells() {
            self.log.flat = Some(memory::boxed(self.flat.copied()?)?);
        }
        Ok(())
    }

    /// Whether the change has given up all cells.
    pub(crate) fn has_given_up_cells(&self) -> bool {
        self.log.cells.is_some()
    }

    /// Undoes the change, except for the places of sites that were only moved.
    pub(crate) fn undo(&mut self) {
        let all_cells = self.log.cells.take();
        let gave_up = all_cells.is_some();
        if let Some(cells) = all_cells {
            self.complex = *cells;
            self.flat = Flat::default();
        }
        if let Some(flat) = self.log.flat.take() {
            self.flat = *flat;
        }
        self.complex.undo_record();
        let mut logged = std::mem::take(&mut self.log.sites);
        while let Some(Logged { s, before, has_place }) = logged.pop() {
            let site = &mut self.sites[s];
            match (site.is_live(), before.is_live()) {
                (true, false) => self.free_sites.push(s),
                // Sites are taken from the end of the list, and given back there.
                (false, true) => drop(self.free_sites.pop()),
                _ => {}
            }
            *site = if has_place { before } else { Site { id: before.id, ..*site } };
        }
        self.log.sites = logged;
        self.find_cells_of_sites(gave_up);
        if G::HAS_WEIGHTS && self.has_cells() {
            self.find_hidden_again();
        }
        self.end();
    }

    /// Gives the corners of all cells that the record has put back, or of all, a cell that there is.
    fn find_cells_of_sites(&mut self, all: bool) {
        let n = if all { self.complex.n_slots() } else { self.complex.rows().len() };
        for k in 0..n {
            let c = if all { Slot::at(k) } else { self.complex.rows()[k].slot };
            if !self.complex.is_live(c) {
                continue;
            }
            let corners = self.complex.cell(c).corners;
            for i in 0..G::Corners::N {
                self.sites[corners[i]].cell = c;
            }
            self.recent = c;
        }
    }

    /// Ends a change.
    pub(crate) fn end(&mut self) {
        self.log.is_on = false;
        self.log.sites.clear();
        self.log.cells = None;
        self.log.flat = None;
        self.n_replaced += self.complex.rows().len();
        self.complex.end_record();
    }
}
