//! What programs read: the cells, and what has changed.

use crate::delaunay::Dimension;
use crate::error::{Error, Result};
use crate::ids::{CellId, SiteId, VertexId};
use crate::machine::memory;
use crate::motion::state::cells::Cells;
use crate::motion::state::changes::{Changes, Taken};
use crate::motion::state::views::CellsView;
use crate::motion::triangulation::MovingTriangulation;

impl<G: Dimension> MovingTriangulation<G> {
    /// The finite cells and their neighbours.
    ///
    /// The first call after a change costs what that has changed, others constant time.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn cells(&self) -> Result<CellsView<'_, G>> {
        let cells = self.cell_arrays()?;
        Ok(CellsView { corners: cells.corners(), neighbours: cells.neighbours() })
    }

    pub(in crate::motion) fn cell_arrays(&self) -> Result<&Cells<G>> {
        self.views.cells(&self.kernel)
    }

    /// Indices, ascending, of the finite cells that did not exist when the latest commit began: of none before the
    /// first one since it was made or loaded. Immediate relocations, insertions and removals since then count.
    ///
    /// # Errors
    /// [`Error::ChangesNotTracked`] unless the options ask for it, [`Error::OutOfMemory`].
    pub fn changed_cells(&self) -> Result<&[CellId]> {
        if !self.options.track_changes {
            return Err(Error::ChangesNotTracked);
        }
        self.views.changed(&self.kernel, Cells::list_created)
    }

    /// Gets ready to track what a commit changes, if the options ask for it.
    pub(in crate::motion) fn prepare_tracking(&mut self) -> Result<()> {
        if !self.options.track_changes {
            return Ok(());
        }
        self.views.cells_mut(&self.kernel)?.track_commit()
    }

    /// Puts the cells in the order of the sites, and the arrays follow. Sorted cells stay as they are until `replaced`
    /// times as many as there are have been replaced.
    pub(in crate::motion) fn sort_cells(&mut self, replaced: f64) -> Result<()> {
        if let Some(index) = self.kernel.sort_cells(replaced)? {
            self.views.renumber_slots(&index);
        }
        Ok(())
    }

    /// What has changed since this was last called: everything, as created, at the first call. Commits and immediate
    /// calls count alike. A program that never calls this pays nothing for it.
    ///
    /// The cost is that of what has changed.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory); then nothing has been taken.
    pub fn take_changes(&mut self) -> Result<Changes<'_, G::Vertices>> {
        let cells = self.views.cells_mut(&self.kernel)?;
        cells.take(memory::made(&mut self.taken)?, self.site_of.len())?;
        let mut taken = memory::take_made(&mut self.taken)?;
        let listed = self.list_visibilities(&mut taken);
        let taken = self.taken.insert(taken);
        listed?;
        self.views.visibilities().truncate(0);
        self.takes_changes = true;
        self.views.cells_mut(&self.kernel).expect("they are up to date").end_taking();
        Ok(taken.changes())
    }

    /// Notes that a vertex is about to be hidden or shown, if the program takes changes.
    pub(in crate::motion) fn note_visibility(&mut self, vertex: VertexId, was_hidden: bool) -> Result<()> {
        if !self.takes_changes {
            return Ok(());
        }
        self.views.visibilities().note(vertex, was_hidden)
    }

    /// Lists the vertices that have been hidden or shown; at the first call all that are hidden.
    fn list_visibilities(&mut self, taken: &mut Taken<G::Vertices>) -> Result<()> {
        if !self.takes_changes {
            taken.reserve_vertices(self.hidden.count())?;
            for v in VertexId::range(0..self.site_of.len()) {
                if self.is_present(v) {
                    taken.list_vertex(v, false, self.is_hidden(v));
                }
            }
            return Ok(());
        }
        taken.reserve_vertices(self.views.visibilities().len())?;
        self.views.visibilities().keep_first();
        for (vertex, was_hidden) in self.views.visibilities().iter() {
            let s = self.site_of[vertex];
            if s != SiteId::NONE {
                let is_hidden = self.kernel.site(s).id != vertex;
                taken.list_vertex(vertex, was_hidden, is_hidden);
            }
        }
        Ok(())
    }
}
