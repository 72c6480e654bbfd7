//! The arrays of cells that programs read: they are kept, and follow the changes.
//!
//! The [arrays](super::cells) are made when they are first asked for, and kept. A change leaves a list of the slots
//! whose corners it has changed; the next reading brings the arrays up to date, at the cost of these. A program that
//! never reads them pays nothing, and a change of no cell costs nothing.
//!
//! Several threads may read at the same time, the first one after a change included: it works while the others wait.

use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::{Slot, VertexId};
use crate::machine::memory;
use crate::motion::state::cells::{Cells, are_most};
use crate::motion::state::marks::Marks;
use crate::motion::state::visibility::Visibilities;

/// The finite cells, by vertex id. Valid until the triangulation changes.
#[derive(Clone, Copy, Debug)]
pub struct CellsView<'t, G: Moving> {
    /// Vertex ids of each cell, positively oriented.
    pub corners: &'t [G::Vertices],
    /// Index of the neighbour opposite each corner, [`NO_CELL`](crate::motion::NO_CELL) on the hull.
    pub neighbours: &'t [G::Neighbours],
}

/// Arrays that are not up to date, and the slots that have changed since they were.
#[derive(Debug)]
struct Behind<G: Moving> {
    cells: Option<Box<Cells<G>>>,
    dirty: Marks<Slot>,
    /// Whether any slot may have changed.
    are_all: bool,
    /// What there was before the rounds of a timestamp that is being prepared.
    before: Option<Box<ArraysBefore>>,
}

/// What there was before rounds that may be taken back.
#[derive(Debug)]
struct ArraysBefore {
    /// Whether there were arrays.
    existed: bool,
    /// Whether they were up to date.
    were_current: bool,
    were_all: bool,
    /// How many slots were dirty: the first of those that are, or were when the arrays were first brought up to date.
    n_dirty: usize,
    /// The slots that were dirty then, if the arrays have been brought up to date since.
    dirty: Option<Marks<Slot>>,
}

impl<G: Moving> Default for Behind<G> {
    fn default() -> Self {
        Behind { cells: None, dirty: Marks::default(), are_all: true, before: None }
    }
}

impl<G: Moving> Behind<G> {
    /// The arrays have been brought up to date: what was dirty before the rounds is kept, if there are rounds.
    fn keep_first_dirty(&mut self) {
        if let Some(before) = &mut self.before
            && before.dirty.is_none()
        {
            let mut dirty = Marks::default();
            if before.n_dirty > 0 {
                std::mem::swap(&mut dirty, &mut self.dirty);
                dirty.truncate(before.n_dirty);
            }
            before.dirty = Some(dirty);
        }
    }

    /// All slots may have changed, and none is listed unless rounds may be taken back.
    fn forget_list(&mut self) {
        if self.before.as_ref().is_none_or(|before| before.dirty.is_some()) {
            self.dirty.clear();
        }
        self.are_all = true;
    }
}

/// The arrays, up to date or behind, and what else is kept for programs that read the cells.
#[derive(Debug, Default)]
pub(in crate::motion) struct Views<G: Moving> {
    current: OnceLock<Box<Cells<G>>>,
    behind: Mutex<Behind<G>>,
    visibilities: Visibilities,
}

impl<G: Moving> Views<G> {
    fn lock(&self) -> MutexGuard<'_, Behind<G>> {
        // After a panic while arrays were refreshed, they are made from nothing.
        self.behind.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn behind(&mut self) -> &mut Behind<G> {
        self.behind.get_mut().unwrap_or_else(PoisonError::into_inner)
    }

    /// The arrays, up to date.
    pub(in crate::motion) fn cells(&self, kernel: &Delaunay<G>) -> Result<&Cells<G>> {
        if let Some(cells) = self.current.get() {
            return Ok(cells);
        }
        let mut behind = self.lock();
        if let Some(cells) = self.current.get() {
            return Ok(cells);
        }
        let mut cells = match behind.cells.take() {
            Some(cells) => cells,
            None => memory::boxed(Cells::default())?,
        };
        if behind.before.as_ref().is_some_and(|before| before.existed)
            && let Err(error) = cells.keep_journal()
        {
            behind.cells = Some(cells);
            return Err(error);
        }
        let were_all = std::mem::replace(&mut behind.are_all, true);
        let dirty = if were_all { None } else { Some(&behind.dirty) };
        let done = cells.refresh(kernel, dirty);
        if let Err(error) = done {
            behind.cells = Some(cells);
            behind.are_all = were_all;
            return Err(error);
        }
        behind.keep_first_dirty();
        behind.dirty.clear();
        behind.are_all = false;
        Ok(self.current.get_or_init(|| cells))
    }

    /// The arrays, up to date, to be changed.
    pub(in crate::motion) fn cells_mut(&mut self, kernel: &Delaunay<G>) -> Result<&mut Cells<G>> {
        self.cells(kernel)?;
        Ok(self.current.get_mut().expect("they are up to date"))
    }

    /// Makes sure that a change, of which the complex has a record, can be [followed](Self::follow).
    #[inline(always)]
    pub(in crate::motion) fn prepare(&mut self, kernel: &Delaunay<G>) -> Result<()> {
        if kernel.complex().rows().is_empty() || !self.exist() { Ok(()) } else { self.prepare_kept(kernel) }
    }

    #[cold]
    fn prepare_kept(&mut self, kernel: &Delaunay<G>) -> Result<()> {
        let n_slots = kernel.complex().n_slots();
        let n_rows = kernel.complex().rows().len();
        let behind = self.behind();
        if behind.are_all && behind.cells.is_some() {
            return Ok(());
        }
        // When most have changed, that follows, and needs no list.
        if are_most(behind.dirty.as_slice().len() + n_rows, n_slots) {
            return Ok(());
        }
        behind.dirty.reserve(n_rows, n_slots)
    }

    /// Whether there are arrays, up to date or not.
    #[inline(always)]
    fn exist(&mut self) -> bool {
        self.current.get().is_some() || self.behind().cells.is_some()
    }

    /// The cells of the record have changed.
    #[inline(always)]
    pub(in crate::motion) fn follow(&mut self, kernel: &Delaunay<G>) {
        if !kernel.complex().rows().is_empty() && self.exist() {
            self.follow_kept(kernel);
        }
    }

    #[cold]
    fn follow_kept(&mut self, kernel: &Delaunay<G>) {
        self.fall_behind();
        let n_slots = kernel.complex().n_slots();
        let rows = kernel.complex().rows();
        let behind = self.behind();
        if behind.are_all {
            return;
        }
        if are_most(behind.dirty.as_slice().len() + rows.len(), n_slots) {
            behind.forget_list();
            return;
        }
        for row in rows {
            behind.dirty.insert(row.slot);
        }
    }

    /// All cells may have changed.
    pub(in crate::motion) fn follow_all(&mut self) {
        self.fall_behind();
        self.behind().forget_list();
    }

    /// Rounds that may be taken back begin.
    pub(in crate::motion) fn open_rounds(&mut self) -> Result<()> {
        let (existed, were_current) = (self.exist(), self.current.get().is_some());
        let behind = self.behind();
        let n_dirty = behind.dirty.as_slice().len();
        let before = ArraysBefore { existed, were_current, were_all: behind.are_all, n_dirty, dirty: None };
        behind.before = Some(memory::boxed(before)?);
        Ok(())
    }

    /// No round is taken back any more.
    pub(in crate::motion) fn end_rounds(&mut self) {
        if let Some(cells) = self.current.get_mut() {
            cells.end_journal();
        }
        let behind = self.behind();
        behind.before = None;
        if behind.are_all {
            behind.dirty.clear();
        }
        if let Some(cells) = &mut behind.cells {
            cells.end_journal();
        }
    }

    /// All rounds have been taken back: puts the arrays back to what they were. Needs no memory.
    pub(in crate::motion) fn withdraw_rounds(&mut self) {
        self.fall_behind();
        let behind = self.behind();
        let Some(before) = behind.before.take() else { return };
        let ArraysBefore { existed, were_current, were_all, n_dirty, dirty } = *before;
        match dirty {
            // Without entries nothing but its memory differs.
            Some(_) if n_dirty == 0 => behind.dirty.clear(),
            Some(dirty) => behind.dirty = dirty,
            None => behind.dirty.truncate(n_dirty),
        }
        behind.are_all = were_all;
        if !existed {
            behind.cells = None;
        }
        let Some(mut cells) = behind.cells.take() else { return };
        cells.undo_journal();
        if were_current {
            self.current = OnceLock::from(cells);
        } else {
            behind.cells = Some(cells);
        }
    }

    /// The arrays are not up to date any more.
    fn fall_behind(&mut self) {
        if let Some(cells) = self.current.take() {
            self.behind().cells = Some(cells);
        }
    }

    /// The cells have other slots now, by their old ones; no other has changed.
    pub(in crate::motion) fn renumber_slots(&mut self, index: &[Slot]) {
        if !self.exist() {
            return;
        }
        self.fall_behind();
        let behind = self.behind();
        behind.dirty.clear();
        behind.are_all = true;
        if let Some(cells) = &mut behind.cells {
            cells.renumber_slots(index);
        }
    }

    /// A copy for a kernel of `n_slots` in which vertices have other ids and cells other slots: those listed by the old
    /// ones.
    pub(in crate::motion) fn renumbered(
        &mut self,
        kernel: &Delaunay<G>,
        ids: &[VertexId],
        slots: &[Slot],
        n_slots: usize,
    ) -> Result<Self> {
        let visibilities = self.visibilities.renumbered(ids)?;
        let mut views = Views { visibilities, ..Views::default() };
        if self.exist() {
            // What is not up to date has rows of vertices without an id.
            let cells = self.cells(kernel)?.renumbered(ids, slots, n_slots)?;
            views.current = OnceLock::from(memory::boxed(cells)?);
            views.behind().are_all = false;
        }
        Ok(views)
    }

    /// A copy, of arrays that are brought up to date for it if there are any.
    pub(in crate::motion) fn copied(&self, kernel: &Delaunay<G>) -> Result<Self> {
        let visibilities = self.visibilities.copied()?;
        // Asked under the lock, as another thread may be bringing them up to date: then they are in neither place.
        let exist = {
            let behind = self.lock();
            self.current.get().is_some() || behind.cells.is_some()
        };
        let mut views = Views { visibilities, ..Views::default() };
        if exist {
            views.show(self.cells(kernel)?.copied()?)?;
        }
        Ok(views)
    }

    /// Takes these for the arrays; they are up to date.
    pub(in crate::motion) fn show(&mut self, cells: Cells<G>) -> Result<()> {
        self.current = OnceLock::from(memory::boxed(cells)?);
        self.behind().are_all = false;
        Ok(())
    }

    /// Vertices hidden or shown since the program last took the changes.
    pub(in crate::motion) fn visibilities(&self) -> &Visibilities {
        &self.visibilities
    }

    /// Vertices hidden or shown since the program last took the changes, to enter more or forget some.
    pub(in crate::motion) fn visibilities_mut(&mut self) -> &mut Visibilities {
        &mut self.visibilities
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        let behind = self.lock();
        let kept = self.current.get().or(behind.cells.as_ref());
        behind.dirty.memory_bytes()
            + kept.map_or(0, |cells| cells.memory_bytes() + size_of::<Cells<G>>())
            + self.visibilities.memory_bytes()
    }
}
