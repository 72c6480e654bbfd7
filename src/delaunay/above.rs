//! Sites above the cells: those that weights hide.
//!
//! With weights a site may be above the lower hull of all lifted ones: *hidden*, until it or others change. It is live, and a corner of
//! no cell; it is above the cell that has its place, and that is all there is to test, as the lifted cells are one function of
//! the place. What is hidden can only come back where cells have gone, or corners have moved or been raised, and what is inserted
//! only hides more.
//!
//! So a change of cells *loosens* the sites above them, and [`settle`](Delaunay::settle), after one change or after many,
//! looks for the cell that has the place of each: a site that is below it is inserted, and may hide others. Between these calls the
//! cells are those of the sites that are shown. Every insertion lowers the hull, so there is an end. A change that is undone leaves
//! all of them loose, as vertices may not be back at their places yet; the next one begins by looking for their cells.
//!
//! Sites at one place are no case of their own: the one of the greatest weight, then of the lowest rank, is below the others.
//!
//! What is above a cell is a list through the sites: to enter one and to take one out need no memory.
//!
//! Invariants: a live site has a cell if it is shown, else [`Slot::NONE`]; after `settle` each hidden one is in the list of one live,
//! finite cell that has its place.
//!
//! A change knows which vertices it has hidden and shown, as long as they are few ([`turned`](Delaunay::turned)).
//!
//! Cost: a walk of few steps for each site that was loosened; 20 bytes a site and 4 a cell, where there are weights.

use super::{Delaunay, Geometry};
use crate::complex::Row;
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;

/// Where a hidden site is listed.
#[derive(Clone, Copy, Debug)]
struct Link {
    /// The cell below it, or what was; [`Slot::NONE`] of a site that is shown, or free.
    cell: Slot,
    /// The sites after it and before it in the list of that cell, or of those that are loose.
    next: SiteId,
    previous: SiteId,
    /// Its index among all hidden ones, less than [`LOOSE`]; that added if it is loose.
    index: u32,
}

/// How many vertices a change may hide and show so that it knows them.
const MOST_TURNED: usize = 1024;

/// Marks indices of sites that are loose. There are fewer sites than this.
const LOOSE: u32 = 1 << 31;

impl Link {
    fn is_loose(&self) -> bool {
        self.index >= LOOSE
    }
}

const SHOWN: Link = Link { cell: Slot::NONE, next: SiteId::NONE, previous: SiteId::NONE, index: 0 };

/// The hidden sites.
#[derive(Debug)]
pub(super) struct Above {
    /// By site.
    links: Vec<Link>,
    /// The first site above each cell.
    first: Vec<SiteId>,
    /// The first one that is loose.
    loose: SiteId,
    /// All of them, in no particular order.
    all: Vec<SiteId>,
    /// Those that the last insertion has hidden, and a cell that each had before.
    swallowed: Vec<(SiteId, Slot)>,
    turned: Turnovers,
}

/// Vertices that have been hidden, shown, or taken out hidden since a change began, some of them again and again.
#[derive(Debug, Default)]
struct Turnovers {
    vertices: Vec<VertexId>,
    /// Whether there are no others.
    are_all: bool,
}

impl Turnovers {
    /// A change begins.
    fn begin(&mut self) -> Result<()> {
        self.vertices.clear();
        self.are_all = true;
        if self.vertices.capacity() < MOST_TURNED {
            memory::reserve_exact(&mut self.vertices, MOST_TURNED)?;
        }
        Ok(())
    }

    fn note(&mut self, vertex: VertexId) {
        if self.vertices.len() < MOST_TURNED.min(self.vertices.capacity()) {
            self.vertices.push(vertex);
        } else {
            self.are_all = false;
        }
    }
}

impl Default for Above {
    fn default() -> Self {
        let (links, first, all) = (Vec::new(), Vec::new(), Vec::new());
        Above { links, first, loose: SiteId::NONE, all, swallowed: Vec::new(), turned: Turnovers::default() }
    }
}

impl Above {
    /// How many sites are hidden.
    pub(super) fn count(&self) -> usize {
        self.all.len()
    }

    /// The first site that is loose, [`SiteId::NONE`] if none is.
    pub(super) fn first_loose(&self) -> SiteId {
        self.loose
    }

    /// Where a site is listed: the cell below it, or what was, and whether it is loose.
    pub(super) fn link(&self, s: SiteId) -> (Slot, bool) {
        let link = self.links[s.index()];
        (link.cell, link.is_loose())
    }

    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.links)
            + memory::bytes_of(&self.first)
            + memory::bytes_of(&self.all)
            + memory::bytes_of(&self.swallowed)
            + memory::bytes_of(&self.turned.vertices)
    }

    /// A copy, without scratch memory.
    pub(super) fn copied(&self) -> Result<Self> {
        Ok(Above {
            links: memory::copy_of(&self.links)?,
            first: memory::copy_of(&self.first)?,
            loose: self.loose,
            all: memory::copy_with_room(&self.all, self.links.len())?,
            swallowed: Vec::new(),
            turned: Turnovers::default(),
        })
    }

    /// Makes room for this number of sites and of slots.
    fn reserve(&mut self, n_sites: usize, n_slots: usize) -> Result<()> {
        if self.links.len() < n_sites {
            let n_more = n_sites - self.all.len();
            memory::reserve(&mut self.all, n_more)?;
            memory::lengthen(&mut self.links, n_sites, SHOWN)?;
        }
        if self.first.len() < n_slots {
            memory::lengthen(&mut self.first, n_slots, SiteId::NONE)?;
        }
        Ok(())
    }

    /// Enters a site into the list of a cell; if there is none, into the list of the loose sites. There is room for all sites.
    pub(super) fn enter(&mut self, s: SiteId, cell: Option<Slot>) {
        let Above { links, first, loose, all, .. } = self;
        let head = cell.map_or(loose, |cell| &mut first[cell.index()]);
        let next = std::mem::replace(head, s);
        if next != SiteId::NONE {
            links[next.index()].previous = s;
        }
        let link = &mut links[s.index()];
        let index = all.len() as u32 + if cell.is_none() { LOOSE } else { 0 };
        *link = Link { cell: cell.unwrap_or(link.cell), next, previous: SiteId::NONE, index };
        all.push(s);
    }

    /// Takes a site out of the list that it is in.
    pub(super) fn take_out(&mut self, s: SiteId) {
        let link = self.links[s.index()];
        let Link { cell, next, previous, index } = link;
        if next != SiteId::NONE {
            self.links[next.index()].previous = previous;
        }
        let before = if previous != SiteId::NONE {
            &mut self.links[previous.index()].next
        } else if link.is_loose() {
            &mut self.loose
        } else {
            &mut self.first[cell.index()]
        };
        *before = next;
        self.links[s.index()] = SHOWN;
        // The last of all takes its index.
        let index = index & !LOOSE;
        self.all.swap_remove(index as usize);
        if let Some(&last) = self.all.get(index as usize) {
            let of_last = &mut self.links[last.index()].index;
            *of_last = index | *of_last & LOOSE;
        }
    }

    /// Moves a site from the list of a cell to that of the loose sites. The cell stays as where to look for another one.
    fn loosen_one(&mut self, s: SiteId) {
        let link = self.links[s.index()];
        if !link.is_loose() {
            self.take_out(s);
            self.links[s.index()].cell = link.cell;
            self.enter(s, None);
        }
    }

    /// Whether a site is in a list.
    fn has(&self, s: SiteId) -> bool {
        self.links.get(s.index()).is_some_and(|link| link.is_loose() || link.cell != Slot::NONE)
    }

    /// Loosens what is above a cell.
    fn loosen(&mut self, cell: Slot) {
        while let Some(&s) = self.first.get(cell.index()).filter(|&&s| s != SiteId::NONE) {
            self.loosen_one(s);
        }
    }

    /// The sites above a cell.
    fn of(&self, cell: Slot) -> impl Iterator<Item = SiteId> + '_ {
        let first = self.first.get(cell.index()).copied();
        let some = |s: &SiteId| *s != SiteId::NONE;
        std::iter::successors(first.filter(some), move |s| Some(self.links[s.index()].next).filter(some))
    }
}

/// The sites that an insertion hides: corners of the zone and of no facet of its rim.
pub(super) struct Swallowed(Vec<(SiteId, Slot)>);

impl Swallowed {
    /// Begins with the corners of the rim, each to be [spared](Self::spare).
    pub(super) fn begin<G: Geometry>(t: &mut Delaunay<G>) -> Self {
        let mut list = std::mem::take(&mut t.above.swallowed);
        list.clear();
        Swallowed(list)
    }

    /// These sites stay: they have this cell, which is not in the zone.
    #[inline(always)]
    pub(super) fn spare<G: Geometry, const N: usize>(
        &mut self,
        t: &mut Delaunay<G>,
        sites: [SiteId; N],
        cell: Slot,
    ) {
        sites.into_iter().for_each(|s| t.corner_mut(s).cell = cell);
    }

    /// Lists the corners of a cell of the zone, which is marked, that have not been spared. On an error all have the cells again
    /// that they had, or others that there are.
    #[inline(always)]
    pub(super) fn look_at<G: Geometry>(&mut self, t: &mut Delaunay<G>, cell: Slot) -> Result<()> {
        let corners = t.complex.cell(cell).corners;
        for &s in corners.as_ref() {
            let of = t.site(s).cell;
            if of == Slot::NONE || t.complex.mark(of) == 0 {
                continue;
            }
            if let Err(error) = memory::push(&mut self.0, (s, of)) {
                self.0.drain(..).for_each(|(s, cell)| t.corner_mut(s).cell = cell);
                return Err(error);
            }
            t.corner_mut(s).cell = Slot::NONE;
        }
        Ok(())
    }

    /// Ends with the list complete.
    pub(super) fn end<G: Geometry>(self, t: &mut Delaunay<G>, zone: impl Iterator<Item = Slot>) {
        t.above.swallowed = self.0;
        zone.for_each(|cell| t.above.loosen(cell));
    }
}

impl<G: Geometry> Delaunay<G> {
    /// Whether a live site is hidden by weight.
    #[inline(always)]
    pub(crate) fn is_hidden(&self, s: SiteId) -> bool {
        G::HAS_WEIGHTS && self.has_cells() && self.site(s).cell == Slot::NONE
    }

    /// How many sites are hidden.
    pub fn n_hidden(&self) -> usize {
        if G::HAS_WEIGHTS { self.above.count() } else { 0 }
    }

    /// The sites that are hidden, in no particular order; none while there are no cells.
    pub(crate) fn hidden_sites(&self) -> impl Iterator<Item = SiteId> + '_ {
        self.above.all.iter().copied()
    }

    /// The hidden sites that are above a cell.
    pub(crate) fn sites_above(&self, cell: Slot) -> impl Iterator<Item = SiteId> + '_ {
        self.above.of(cell)
    }

    /// Whether a site is in the list of the cell below it, or of those that an undone change has left loose.
    pub(super) fn is_listed(&self, s: SiteId) -> bool {
        let link = self.above.links[s.index()];
        link.is_loose() || self.above.of(link.cell).any(|other| other == s)
    }

    /// Makes room for what an insertion may hide.
    #[inline(always)]
    pub(super) fn make_room_to_hide(&mut self) -> Result<()> {
        if G::HAS_WEIGHTS { self.above.reserve(self.sites.len(), self.complex.n_slots()) } else { Ok(()) }
    }

    /// Lists what the last insertion has hidden. There is [room](Self::make_room_to_hide).
    #[inline(always)]
    pub(super) fn list_swallowed(&mut self) {
        if G::HAS_WEIGHTS {
            let swallowed = std::mem::take(&mut self.above.swallowed);
            for &(s, _) in &swallowed {
                self.above.enter(s, None);
                self.note_turned(s);
            }
            self.above.swallowed = swallowed;
        }
    }

    /// Lists a site that an insertion has found to be hidden. There is [room](Self::make_room_to_hide).
    pub(super) fn hide(&mut self, s: SiteId, cell: Slot) {
        self.above.enter(s, Some(cell));
        self.note_turned(s);
    }

    /// A site has been hidden or shown, or is about to be taken out.
    pub(super) fn note_turned(&mut self, s: SiteId) {
        self.above.turned.note(self.sites[s].id);
    }

    /// A change begins that will know the vertices which it hides and shows.
    pub(super) fn begin_turning(&mut self) -> Result<()> {
        if G::HAS_WEIGHTS { self.above.turned.begin() } else { Ok(()) }
    }

    /// The vertices that the last change has hidden, shown, or taken out hidden, some of them again and again; none if
    /// they are too many to be known.
    pub(crate) fn turned(&self) -> Option<&[VertexId]> {
        let Turnovers { vertices, are_all } = &self.above.turned;
        are_all.then_some(vertices.as_slice())
    }

    /// Takes a hidden site out of its list, if it is in one.
    pub(super) fn forget_hidden(&mut self, s: SiteId) {
        if self.above.has(s) {
            self.above.take_out(s);
            self.note_turned(s);
        }
    }

    /// Loosens a hidden site, whose place or weight is another one.
    pub(super) fn loosen_site(&mut self, s: SiteId) {
        self.above.loosen_one(s);
    }

    /// Loosens the sites above the cells of the gathered star.
    #[inline(always)]
    pub(super) fn loosen_star(&mut self) {
        if G::HAS_WEIGHTS && self.above.count() > 0 {
            let Self { above, star, .. } = self;
            star.iter().for_each(|&(cell, _)| above.loosen(cell));
        }
    }

    /// Loosens the sites above cells that have been changed.
    pub(super) fn loosen_rows(&mut self, rows: &[Row<G::Corners>]) {
        if G::HAS_WEIGHTS && self.above.count() > 0 {
            rows.iter().for_each(|row| self.above.loosen(row.slot));
        }
    }

    /// Lists the hidden sites after a build, as loose.
    pub(super) fn list_hidden(&mut self) -> Result<()> {
        if !G::HAS_WEIGHTS {
            return Ok(());
        }
        self.make_room_to_hide()?;
        for s in SiteId::range(1..self.sites.len()) {
            if self.is_hidden(s) && self.site(s).is_live() {
                self.above.enter(s, None);
            }
        }
        Ok(())
    }

    /// Loosens all hidden sites, where any site may have moved.
    pub(crate) fn loosen_all(&mut self) {
        if G::HAS_WEIGHTS && self.above.count() > 0 {
            // Each goes to the end of the list, and one that has been there takes its index.
            for index in (0..self.above.count()).rev() {
                self.loosen_site(self.above.all[index]);
            }
        }
    }

    /// Whether there are sites to be [settled](Self::settle).
    pub(crate) fn has_loose(&self) -> bool {
        G::HAS_WEIGHTS && self.above.loose != SiteId::NONE
    }

    /// Forgets the hidden sites: there are no cells, or all are going to be [listed](Self::list_hidden) anew.
    pub(super) fn forget_all_hidden(&mut self) {
        if G::HAS_WEIGHTS {
            self.above.links.fill(SHOWN);
            self.above.first.fill(SiteId::NONE);
            self.above.loose = SiteId::NONE;
            self.above.all.clear();
            self.above.turned.are_all = false;
        }
    }

    /// Makes the room that [`renumber_cells_below`](Self::renumber_cells_below) needs where there will be at most so many slots.
    pub(super) fn room_to_renumber_cells_below(&self, n_slots: usize) -> Result<Vec<SiteId>> {
        let mut room = Vec::new();
        if self.n_hidden() > 0 {
            memory::lengthen(&mut room, n_slots.max(self.above.first.len()), SiteId::NONE)?;
        }
        Ok(room)
    }

    /// Follows a change of the slots of cells: those of what is there are listed by the old ones.
    pub(super) fn renumber_cells_below(&mut self, index: &[Slot], mut room: Vec<SiteId>) {
        if self.n_hidden() == 0 {
            return;
        }
        let Above { links, first, .. } = &mut self.above;
        for (slot, &s) in first.iter().enumerate().filter(|&(_, &s)| s != SiteId::NONE) {
            room[index[slot].index()] = s;
        }
        for link in links.iter_mut().filter(|link| link.cell != Slot::NONE) {
            link.cell = index.get(link.cell.index()).copied().unwrap_or(Slot::NONE);
        }
        self.above.first = room;
    }

    /// After a change has been undone: which sites are shown, and all others as loose ones. Needs no memory, as there was
    /// [room](Self::make_room_to_hide) when the change began.
    pub(super) fn find_hidden_again(&mut self) {
        self.forget_all_hidden();
        for s in SiteId::range(1..self.sites.len()) {
            let site = &mut self.sites[s];
            if !site.is_live() {
                continue;
            }
            let cell = site.cell;
            let is_shown =
                self.complex.is_live(cell) && self.complex.cell(cell).corners.as_ref().contains(&s);
            if !is_shown {
                site.cell = Slot::NONE;
                self.above.links[s.index()].cell = cell;
                self.above.enter(s, None);
            }
        }
    }
}
