//! The cells as callers see them: by vertex id, finite cells only, in dense arrays that are brought up to date.
//!
//! **Identity.** A cell is its set of vertices. One that is there before and after keeps its index, and the order of
//! its corners unless it has been turned over, whatever has become of its slot: rows of slots that have changed are
//! compared first with what the slot holds now, and what is left on both sides is matched by corners. Only where
//! cells have become fewer, the last ones are *renumbered* to fill the holes.
//!
//! Invariants: `slots` and `index_of` are inverse to each other for all cells that have not changed since. The order of
//! the corners in a row, beside that in its slot, is in `orderings`.
//!
//! Cost: in proportion to the slots that have changed; when most have, one pass over all. `make bench` times steps,
//! which read the cells and what has changed, beside commits alone.

mod comparing;
mod gluing;
mod journal;
mod renumbering;

use crate::complex::{Corners, Facet};
use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::{CellId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::state::cells::journal::CellJournal;
use crate::motion::state::changes::{Tracker, renumber};
use crate::motion::state::marks::{Bits, Marks};
use crate::motion::state::matching::Matcher;
use crate::motion::state::ordering::Ordering;
use crate::motion::state::taken::Taken;

/// When more than this share of the slots has changed, all are compared.
const MAX_SHARE_LISTED: f64 = 0.5;

/// Neighbour of a cell across a facet of the convex hull.
pub const NO_CELL: CellId = CellId::NONE;

/// Mirror index of a facet of the convex hull.
pub const NO_CORNER: u8 = u8::MAX;

/// Whether `n_changed` changed slots are too many of `n_slots` to be compared one by one.
pub(in crate::motion) fn are_most(n_changed: usize, n_slots: usize) -> bool {
    n_changed as f64 > MAX_SHARE_LISTED * n_slots as f64
}

/// Memory for this number of changes is always kept.
const KEPT_CHANGES: usize = 64;

/// Rows of cells that a caller owns.
#[derive(Clone, Debug)]
pub struct OwnedCells<G: Moving> {
    /// Vertex ids of each cell, positively oriented.
    pub corners: Vec<G::Vertices>,
    /// Index of the neighbour opposite each corner, [`NO_CELL`] on the hull.
    pub neighbours: Vec<G::Neighbours>,
}

/// The arrays behind a view.
#[derive(Debug)]
pub(in crate::motion) struct Cells<G: Moving> {
    corners: Vec<G::Vertices>,
    neighbours: Vec<G::Neighbours>,
    /// By slot of the kernel's complex, the index of its cell in the arrays; [`NO_CELL`] if it has none.
    index_of: Vec<CellId>,
    /// The slot of each index.
    slots: Vec<Slot>,
    /// By index, how the row lists the corners of its slot; there may be more than cells.
    orderings: Vec<Ordering>,
    /// A bit for each lost cell that has been found, or whose index has been given to another one. All are 0 between
    /// calls.
    is_settled: Bits,
    /// What has changed since the program last took the changes, if it ever did.
    since_taken: Option<Tracker<G::Vertices>>,
    scratch: RefreshLists<G::Vertices>,
    /// What the arrays were before they were brought up to date, where that may be undone.
    journal: Option<Box<CellJournal<G>>>,
}

/// A slot that holds another cell than before.
#[derive(Clone, Copy, Debug)]
struct FoundCell<C> {
    slot: Slot,
    /// The index of the cell, if it was there before; else [`NO_CELL`].
    index: CellId,
    ids: C,
}

/// Lists of a refreshment.
#[derive(Debug)]
struct RefreshLists<C> {
    /// Indices whose slot no longer holds their cell.
    lost: Vec<CellId>,
    /// Slots that hold another finite cell than before, if they are known; else, those that hold one that was not
    /// there.
    found: Vec<FoundCell<C>>,
    matcher: Matcher<C>,
    /// Slots of cells that have other indices.
    moved: Vec<Slot>,
    /// Slots of cells that have been turned over.
    turned: Vec<Slot>,
}

impl<C> Default for RefreshLists<C> {
    fn default() -> Self {
        RefreshLists {
            lost: Vec::new(),
            found: Vec::new(),
            matcher: Matcher::default(),
            moved: Vec::new(),
            turned: Vec::new(),
        }
    }
}

impl<C: Corners<VertexId>> RefreshLists<C> {
    fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.lost)
            + memory::bytes_of(&self.moved)
            + memory::bytes_of(&self.turned)
            + self.found.capacity() * size_of::<FoundCell<C>>()
            + self.matcher.memory_bytes()
    }
}

/// The vertex ids of a slot's corners.
#[inline(always)]
fn ids_of<G: Moving>(kernel: &Delaunay<G>, slot: Slot) -> G::Vertices {
    let sites = kernel.complex().cell(slot).corners;
    let mut ids = G::Vertices::filled(VertexId::NONE);
    for i in 0..G::Corners::N {
        ids[i] = kernel.site(sites[i]).id;
    }
    ids
}

/// Whether a slot holds a finite cell.
#[inline(always)]
fn is_finite<G: Moving>(kernel: &Delaunay<G>, slot: Slot) -> bool {
    kernel.complex().is_live(slot) && !kernel.complex().cell(slot).is_ghost()
}

impl<G: Moving> Default for Cells<G> {
    fn default() -> Self {
        Cells {
            corners: Vec::new(),
            neighbours: Vec::new(),
            index_of: Vec::new(),
            slots: Vec::new(),
            orderings: Vec::new(),
            is_settled: Bits::default(),
            since_taken: None,
            scratch: RefreshLists::default(),
            journal: None,
        }
    }
}

impl<G: Moving> Cells<G> {
    /// Vertex ids of each cell.
    #[inline(always)]
    pub(in crate::motion) fn corners(&self) -> &[G::Vertices] {
        &self.corners
    }

    /// Index of the neighbour opposite each corner of each cell.
    #[inline(always)]
    pub(in crate::motion) fn neighbours(&self) -> &[G::Neighbours] {
        &self.neighbours
    }

    /// By slot of the kernel's complex, the index of its cell; [`NO_CELL`] if it has none.
    #[inline(always)]
    pub(in crate::motion) fn index_of(&self) -> &[CellId] {
        &self.index_of
    }

    /// The slot of the cell of an index, if there is such a cell.
    pub(in crate::motion) fn slot(&self, index: CellId) -> Option<Slot> {
        self.slots.get(index.index()).copied()
    }

    /// The sites of a cell, in the order of its row.
    #[inline(always)]
    pub(in crate::motion) fn sites(&self, kernel: &Delaunay<G>, index: CellId) -> G::Corners {
        self.orderings[index].in_row(kernel.complex().cell(self.slots[index]).corners)
    }

    /// The slot of each cell.
    #[inline(always)]
    pub(in crate::motion) fn slots(&self) -> &[Slot] {
        &self.slots
    }

    /// For each corner of a cell the place, in the row of the neighbour opposite it, of the corner that is opposite the
    /// same facet; [`NO_CORNER`] on the hull, and after the last corner.
    #[inline(always)]
    pub(in crate::motion) fn mirrors(&self, kernel: &Delaunay<G>, index: CellId) -> [u8; 4] {
        let cell = kernel.complex().cell(self.slots[index]);
        let mut mirrors = [NO_CORNER; 4];
        for i in 0..G::Corners::N {
            let place = self.orderings[index].place(i);
            let across = self.neighbours[index][place];
            if across != NO_CELL {
                mirrors[place] = self.orderings[across].place(cell.neighbour(i).index()) as u8;
            }
        }
        mirrors
    }

    /// Lists what has changed since this was last [ended](Self::end_taking): everything, as created, if it never was.
    pub(in crate::motion) fn take(&mut self, taken: &mut Taken<G::Vertices>, n_ids: usize) -> Result<()> {
        let tracker = match &mut self.since_taken {
            Some(tracker) => tracker,
            none => none.insert(Tracker::of_none(self.corners.len())?),
        };
        taken.list(tracker, &self.corners, n_ids)
    }

    /// The corners of cells that have come or gone since changes were taken; none if they never were.
    pub(in crate::motion) fn rows_since_taken(
        &self,
    ) -> Option<impl Iterator<Item = (&G::Vertices, Option<CellId>)>> {
        self.since_taken.as_ref().map(|tracker| tracker.rows_since_base(&self.corners))
    }

    /// All there is counts as taken.
    pub(in crate::motion) fn begin_taking(&mut self) -> Result<()> {
        let mut tracker = Tracker::of_none(self.corners.len())?;
        tracker.reset();
        self.since_taken = Some(tracker);
        Ok(())
    }

    /// Whether all changes of arrays that are up to date have been taken.
    pub(in crate::motion) fn are_changes_taken(&self) -> bool {
        self.since_taken.as_ref().is_some_and(Tracker::is_clean)
    }

    /// What has been listed has been taken.
    pub(in crate::motion) fn end_taking(&mut self) {
        self.since_taken.as_mut().expect("it has been listed").reset();
    }

    /// The cells are in other slots, listed by the old ones.
    pub(in crate::motion) fn renumber_slots(&mut self, slots: &[Slot]) {
        for slot in &mut self.slots {
            *slot = slots.get(slot.index()).copied().unwrap_or(Slot::NONE);
        }
    }

    /// Brings the arrays up to date: only the `dirty` slots have changed, or any, if there is no list of them. After an
    /// error they can be brought up to date later.
    pub(in crate::motion) fn refresh(
        &mut self,
        kernel: &Delaunay<G>,
        dirty: Option<&Marks<Slot>>,
    ) -> Result<()> {
        let mut scratch = std::mem::take(&mut self.scratch);
        let done = self.refresh_with(kernel, dirty, &mut scratch);
        if done.is_err() {
            scratch.lost.iter().for_each(|&index| self.is_settled.clear_around(index));
        }
        self.scratch = scratch;
        done
    }

    fn refresh_with(
        &mut self,
        kernel: &Delaunay<G>,
        dirty: Option<&Marks<Slot>>,
        scratch: &mut RefreshLists<G::Vertices>,
    ) -> Result<()> {
        scratch.lost.clear();
        scratch.found.clear();
        scratch.moved.clear();
        scratch.turned.clear();
        if self.journal.is_some() {
            self.note_before(kernel, dirty)?;
        }
        if self.corners.is_empty() {
            return self.fill(kernel);
        }
        self.is_settled.grow(self.corners.len())?;
        match dirty {
            Some(dirty) => {
                self.compare_slots(kernel, dirty.as_slice(), scratch)?;
                let RefreshLists { lost, found, matcher, turned, .. } = scratch;
                matcher.list(&self.corners, lost)?;
                self.find_lost(matcher, found, turned)?;
            }
            None => self.compare_all(kernel, scratch)?,
        }
        self.reserve(kernel, scratch)?;
        if let (Some(dirty), true) = (dirty, self.journal.is_some()) {
            self.make_room_for_sides(dirty.as_slice().len() + scratch.lost.len())?;
        }
        self.renumber(kernel, scratch);
        if let (Some(dirty), true) = (dirty, self.journal.is_some()) {
            self.note_sides(kernel, dirty, &scratch.moved);
        }
        match dirty {
            Some(dirty) => self.glue_slots(kernel, dirty, &scratch.moved),
            None => self.glue_all(kernel),
        }
        // Memory for many changes is not kept.
        if scratch.found.capacity().max(scratch.matcher.capacity()) > self.corners.len() / 2 + KEPT_CHANGES {
            *scratch = RefreshLists::default();
        }
        Ok(())
    }

    /// Makes room for all that [`renumber`](Self::renumber) writes.
    fn reserve(&mut self, kernel: &Delaunay<G>, scratch: &mut RefreshLists<G::Vertices>) -> Result<()> {
        let n = kernel.complex().n_finite();
        let more = n.saturating_sub(self.corners.len());
        memory::reserve_sparingly(&mut self.corners, more)?;
        memory::reserve_sparingly(&mut self.neighbours, more)?;
        memory::reserve_sparingly(&mut self.slots, more)?;
        let n_orderings = n.max(self.orderings.len());
        let more_orderings = n_orderings - self.orderings.len();
        memory::reserve_sparingly(&mut self.orderings, more_orderings)?;
        self.orderings.resize(n_orderings, Ordering::SAME);
        let more_slots = kernel.complex().n_slots().saturating_sub(self.index_of.len());
        memory::reserve_sparingly(&mut self.index_of, more_slots)?;
        let (n_lost, n_found) = (scratch.lost.len(), scratch.found.len());
        memory::reserve(&mut scratch.moved, n_lost)?;
        if let Some(tracker) = &mut self.since_taken {
            let may_shorten = self.journal.is_none();
            tracker.reserve(n_lost, scratch.turned.len(), n_lost + n_found, n, may_shorten)?;
        }
        Ok(())
    }

    /// The index, in the complex, of a corner of a cell.
    pub(in crate::motion) fn facet(&self, index: CellId, corner: usize) -> Facet {
        let ordering = self.orderings[index];
        let in_slot =
            (0..G::Corners::N).find(|&i| ordering.place(i) == corner).expect("every place is taken");
        Facet::new(self.slots[index], in_slot)
    }

    /// The cell of a facet, and the corner opposite it as it is shown.
    pub(in crate::motion) fn shown(&self, facet: Facet) -> (CellId, usize) {
        let index = self.index_of[facet.cell()];
        (index, self.orderings[index].place(facet.index()))
    }

    /// A copy of arrays that are up to date, in which vertices have other ids and cells other slots, `n_slots` in all:
    /// those listed by the old ones. Every cell keeps its index.
    pub(in crate::motion) fn renumbered(
        &self,
        ids: &[VertexId],
        slots: &[Slot],
        n_slots: usize,
    ) -> Result<Self> {
        let mut cells = Cells {
            corners: memory::copy_of(&self.corners)?,
            neighbours: memory::copy_of(&self.neighbours)?,
            slots: memory::copy_of(&self.slots)?,
            orderings: memory::copy_of(&self.orderings)?,
            since_taken: self.since_taken.as_ref().map(|tracker| tracker.renumbered(ids)).transpose()?,
            ..Cells::default()
        };
        memory::reserve_exact(&mut cells.index_of, n_slots)?;
        cells.index_of.resize(n_slots, NO_CELL);
        cells.corners.iter_mut().for_each(|row| renumber(row, ids));
        for (index, slot) in CellId::range(0..cells.slots.len()).zip(&mut cells.slots) {
            *slot = slots[*slot];
            cells.index_of[*slot] = index;
        }
        Ok(cells)
    }

    /// A copy, without scratch memory.
    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(Cells {
            corners: memory::copy_of(&self.corners)?,
            neighbours: memory::copy_of(&self.neighbours)?,
            index_of: memory::copy_of(&self.index_of)?,
            slots: memory::copy_of(&self.slots)?,
            orderings: memory::copy_of(&self.orderings)?,
            since_taken: self.since_taken.as_ref().map(Tracker::copied).transpose()?,
            ..Cells::default()
        })
    }

    /// The arrays of a kernel that has cell k of these rows in slot k, and as many slots.
    pub(in crate::motion) fn of_rows(
        corners: Vec<G::Vertices>,
        neighbours: Vec<G::Neighbours>,
        n_slots: usize,
    ) -> Result<Self> {
        let n = corners.len();
        let (mut index_of, mut slots, mut orderings) = (Vec::new(), Vec::new(), Vec::new());
        memory::reserve_exact(&mut index_of, n_slots)?;
        index_of.extend(CellId::range(0..n));
        index_of.resize(n_slots, NO_CELL);
        memory::reserve_exact(&mut slots, n)?;
        slots.extend(Slot::range(0..n));
        memory::lengthen(&mut orderings, n, Ordering::SAME)?;
        Ok(Cells { corners, neighbours, index_of, slots, orderings, ..Cells::default() })
    }

    /// The rows, in place of which there are copies now.
    pub(in crate::motion) fn hand_over(&mut self) -> Result<OwnedCells<G>> {
        let (mut corners, mut neighbours) =
            (memory::copy_of(&self.corners)?, memory::copy_of(&self.neighbours)?);
        if self.journal.is_some() {
            // What the arrays were before may be longer.
            memory::reserve_exact(&mut corners, self.corners.capacity() - self.corners.len())?;
            memory::reserve_exact(&mut neighbours, self.neighbours.capacity() - self.neighbours.len())?;
        }
        Ok(OwnedCells {
            corners: std::mem::replace(&mut self.corners, corners),
            neighbours: std::mem::replace(&mut self.neighbours, neighbours),
        })
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.corners)
            + memory::bytes_of(&self.neighbours)
            + memory::bytes_of(&self.index_of)
            + memory::bytes_of(&self.slots)
            + self.orderings.capacity()
            + self.is_settled.memory_bytes()
            + self.scratch.memory_bytes()
            + self.since_taken.as_ref().map_or(0, Tracker::memory_bytes)
            + memory::bytes_of_made(&self.journal, CellJournal::memory_bytes)
    }
}
