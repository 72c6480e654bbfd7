//! What programs read: the cells, and what has changed.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::state::cells::OwnedCells;
use crate::motion::state::hidden_ids::HiddenIds;
use crate::motion::state::taken::{Changes, Taken};
use crate::motion::triangulation::MovingTriangulation;

impl<G: Moving> MovingTriangulation<G> {
    /// The arrays that [`cells`](Self::cells) shows, as the caller's own: for programs that have shown them to others,
    /// who may look at them for longer than until the next change. The triangulation goes on with copies.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let mut t = MovingTriangulation::<Plane>::new(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// let cells = t.release_cells()?;
    /// t.remove_vertex(cells.corners[0][0])?;
    /// assert_eq!((cells.corners.len(), t.cell_count()), (1, 0));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory); then nothing has been handed over.
    pub fn release_cells(&mut self) -> Result<OwnedCells<G>> {
        self.mesh.views.cells_mut(&self.mesh.kernel)?.hand_over()
    }

    /// What has changed since this was last called: everything, as created, at the first call. Commits and immediate
    /// calls count alike. A program that never calls this pays nothing for it.
    ///
    /// The cost is that of what has changed.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// assert_eq!(t.take_changes()?.created.len(), 2);
    /// t.insert_vertex(&[0.3, 0.3])?;
    /// let changes = t.take_changes()?;
    /// assert_eq!((changes.created.len(), changes.removed.len()), (4, 2));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory), [`Error::Prepared`](crate::Error::Prepared); then nothing has
    /// been taken.
    pub fn take_changes(&mut self) -> Result<Changes<'_, G::Vertices>> {
        self.reject_prepared()?;
        let cells = self.mesh.views.cells_mut(&self.mesh.kernel)?;
        cells.take(memory::made(&mut self.taken)?, self.mesh.site_of.len())?;
        let mut taken = memory::take_made(&mut self.taken)?;
        let listed = self.list_visibilities(&mut taken);
        let taken = self.taken.insert(taken);
        self.mesh.views.visibilities_mut().hidden_when_taken = listed?;
        self.mesh.views.visibilities_mut().truncate(0);
        self.mesh.takes_changes = true;
        self.mesh.views.cells_mut(&self.mesh.kernel).expect("they are up to date").end_taking();
        Ok(taken.changes())
    }

    /// From now on changes are known, as if all there is had been taken.
    pub(crate) fn begin_changes(&mut self) -> Result<()> {
        self.mesh.views.cells_mut(&self.mesh.kernel)?.begin_taking()?;
        self.mesh.takes_changes = true;
        Ok(())
    }

    /// The corners of cells that have been created since changes were taken, with their indices, and of those that have been
    /// removed, also while a timestamp is prepared; none if changes were never taken. A cell that has gone and come back may be
    /// among both.
    pub(crate) fn rows_since_taken(
        &self,
    ) -> Result<Option<impl Iterator<Item = (&G::Vertices, Option<CellId>)>>> {
        Ok(self.cell_arrays()?.rows_since_taken())
    }

    /// Lists the vertices that have been hidden or shown; at the first call all that are hidden. Returns who is, where there are
    /// weights.
    fn list_visibilities(&mut self, taken: &mut Taken<G::Vertices>) -> Result<HiddenIds> {
        if G::HAS_WEIGHTS {
            self.mesh.know_hidden_ids()?;
            let hidden = self.mesh.known.as_ref().expect("they have been found out").ids().copied()?;
            let differences = || hidden.differences(&self.mesh.views.visibilities().hidden_when_taken);
            taken.reserve_vertices(differences().count())?;
            for (vertex, is_hidden) in differences().filter(|&(v, _)| self.mesh.is_present(v)) {
                taken.list_vertex(vertex, !is_hidden, is_hidden);
            }
            return Ok(hidden);
        }
        if !self.mesh.takes_changes {
            taken.reserve_vertices(self.mesh.hidden.count())?;
            for v in VertexId::range(0..self.mesh.site_of.len()) {
                if self.mesh.is_present(v) {
                    taken.list_vertex(v, false, self.mesh.is_hidden(v));
                }
            }
            return Ok(HiddenIds::default());
        }
        taken.reserve_vertices(self.mesh.views.visibilities().len())?;
        self.mesh.views.visibilities_mut().keep_first();
        for (vertex, was_hidden) in self.mesh.views.visibilities().iter() {
            if self.mesh.is_present(vertex) {
                taken.list_vertex(vertex, was_hidden, self.mesh.is_hidden(vertex));
            }
        }
        Ok(HiddenIds::default())
    }
}
