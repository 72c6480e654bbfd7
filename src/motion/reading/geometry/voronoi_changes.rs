//! Which Voronoi cells have changed.
//!
//! A Voronoi cell is bounded by the bisectors with the vertices that share cells with its own. So it changes only where
//! the vertex or one of these has moved, or cells around it have come or gone. Numbers that are computed of it follow
//! the order of the indices of these cells, so that vertices of renumbered cells are listed too, and all others have the
//! same numbers to the last bit.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::motion::triangulation::MovingTriangulation;

impl<G: Moving> MovingTriangulation<G> {
    /// For each id 1 if the Voronoi cell of the vertex has changed, or may have, by the changes that were
    /// [taken](Self::take_changes) last and as these vertices have moved meanwhile, or got other weights, and for
    /// removed ones and those that weights hide; 0 for others.
    /// Vertices may be listed more than once. With such a mask [`voronoi_cells`](Self::voronoi_cells) gives what a full
    /// pass does, to the last bit.
    ///
    /// To be called after changes have been taken, before any others; else all are 1, as they are without cells and in a
    /// constrained triangulation.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let places: Vec<[f64; 2]> = (0..49).map(|k| [f64::from(k % 7), f64::from(k / 7)]).collect();
    /// let mut t = MovingTriangulation::<Plane>::new(&places, Options::default())?;
    /// t.take_changes()?;
    /// let middle = [VertexId::new(24)];
    /// t.move_vertices(&middle, &[[3.1, 3.05]])?;
    /// t.commit_timestamp()?;
    /// t.take_changes()?;
    /// let mask = t.voronoi_changed(&middle)?;
    /// let changed = mask.iter().filter(|&&is_changed| is_changed != 0).count();
    /// assert!(mask[24] == 1 && mask[0] == 0 && changed < 20);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`](crate::Error::NoSuchVertex), [`Error::RemovedVertex`](crate::Error::RemovedVertex),
    /// [`Error::StagedVertex`](crate::Error::StagedVertex), [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn voronoi_changed(&self, moved: &[VertexId]) -> Result<Vec<u8>> {
        let around = self.cells_around(moved)?;
        let cells = self.cell_arrays()?;
        let taken = self.taken.as_ref().filter(|_| cells.are_changes_taken());
        let has_local_cells = self.cell_count() > 0 && !self.mesh.kernel.is_constrained();
        let mut mask = Vec::new();
        let Some(taken) = taken.filter(|_| has_local_cells) else {
            memory::lengthen(&mut mask, self.id_count(), 1)?;
            return Ok(mask);
        };
        // One that has been removed while it was hidden is in no list, and one that weights hide may be in none.
        let is_none = |(_, s): (VertexId, Option<SiteId>)| s.is_none_or(|s| self.mesh.kernel.is_hidden(s));
        memory::reserve_exact(&mut mask, self.id_count())?;
        mask.extend(self.mesh.sites_of_ids().map(|entry| u8::from(is_none(entry))));
        let changes = taken.changes();
        let of_cells = around.iter().chain(changes.renumbered_to).map(|&cell| &cells.corners()[cell]);
        let listed = [moved, changes.stars, changes.hidden, changes.shown];
        for v in of_cells.flat_map(|row| row.as_ref()).chain(listed.into_iter().flatten()) {
            mask[v.index()] = 1;
        }
        Ok(mask)
    }
}
