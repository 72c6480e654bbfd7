//! Taking what has changed.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::{Changes, NO_CELL};
use crate::periodic::cells::PeriodicCells;
use crate::periodic::changes::{Base, ChangeLists, Name, Taking};
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// What has changed since this was last called: everything, as created, at the first call. A cell is its vertices with their
    /// [shifts](Self::cell_shifts) from each other, so one is new if the program takes one of its vertices to another period,
    /// or gives other vectors of the lattice. A cell that stays keeps its index unless it is among the renumbered ones.
    ///
    /// The cost is n + m.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory), [`Error::Prepared`](crate::Error::Prepared); then nothing has been
    /// taken.
    pub fn take_changes(&mut self) -> Result<Changes<'_, G::Vertices>> {
        self.reject_prepared()?;
        let cells = self.read_cells()?;
        let base = self.base_of(cells)?;
        let lists = self.list_changes(cells, &base.is_odd)?;
        let before = self.taking.as_ref().and_then(|taking| taking.base.lattice.as_ref());
        let is_strained = before.is_some_and(|lattice| !lattice.is_equal(&self.lattice));
        let timestamp = Some(self.timestamp());
        // From now on, each has been where it is.
        self.set_origins()?;
        Ok(self.taking.insert(Taking { base, lists, timestamp, is_strained }).lists.changes())
    }

    /// For each id 1 if the Voronoi cell of the vertex has changed, or may have, by the changes that were
    /// [taken](Self::take_changes) last and as these vertices have moved meanwhile, and for removed ones; 0 for others. Vertices may be
    /// listed more than once. With such a mask [`for_voronoi_cells`](Self::for_voronoi_cells) tells all that have changed by more than
    /// rounding.
    ///
    /// To be called after changes have been taken, before any others; else all are 1, as they are without cells and after a change of
    /// the vectors.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`](crate::Error::NoSuchVertex), [`Error::RemovedVertex`](crate::Error::RemovedVertex),
    /// [`Error::StagedVertex`](crate::Error::StagedVertex), [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn voronoi_changed(&self, moved: &[VertexId]) -> Result<Vec<u8>> {
        let around = self.cells_around(moved)?;
        let cells = self.read_cells()?;
        let is_fresh = |taking: &&Taking<G>| {
            let is_of_now = taking.timestamp == Some(self.timestamp()) && self.former.is_none();
            is_of_now && !taking.is_strained
        };
        let taking = self.taking.as_ref().filter(is_fresh).filter(|_| !cells.corners.is_empty());
        let mut mask = Vec::new();
        memory::lengthen(&mut mask, self.id_count(), u8::from(taking.is_none()))?;
        let Some(Taking { lists, .. }) = taking else { return Ok(mask) };
        let of_cells = around.iter().chain(&lists.renumbered_to).map(|&cell| &cells.corners[cell]);
        let listed = [moved, &lists.stars, &lists.hidden, &lists.shown];
        for v in of_cells.flat_map(|row| row.as_ref()).chain(listed.into_iter().flatten()) {
            mask[v.index()] = 1;
        }
        for v in VertexId::range(0..mask.len()).filter(|&v| !self.is_present(v)) {
            mask[v.index()] = 1;
        }
        Ok(mask)
    }

    fn base_of(&self, cells: &PeriodicCells<G>) -> Result<Base<G>> {
        let mut base = Base::none();
        base.corners = memory::copy_of(&cells.corners)?;
        memory::reserve_map(&mut base.index_of, cells.corners.len())?;
        memory::reserve_exact(&mut base.is_odd, cells.corners.len())?;
        for cell in CellId::range(0..cells.corners.len()) {
            let (name, is_odd) = self.name_of(cells, cell.index());
            base.index_of.insert(name, cell);
            base.is_odd.push(is_odd);
        }
        base.hidden = self.vertices_in_no_cell()?;
        base.lattice = Some(self.lattice.copied());
        Ok(base)
    }

    fn list_changes(&self, cells: &PeriodicCells<G>, is_odd: &[bool]) -> Result<ChangeLists<G>> {
        let none = Base::none();
        let base = self.taking.as_ref().map_or(&none, |taking| &taking.base);
        let mut lists = ChangeLists::none();
        let mut is_there = Vec::new();
        memory::lengthen(&mut is_there, base.corners.len(), false)?;
        for cell in CellId::range(0..cells.corners.len()) {
            match cells.origin(cell) {
                NO_CELL => {
                    memory::push(&mut lists.created, cell)?;
                    memory::append(&mut lists.stars, cells.corners[cell].as_ref())?;
                }
                origin => {
                    is_there[origin] = true;
                    if is_odd[cell.index()] != base.is_odd[origin.index()] {
                        let (name, is_odd) = self.name_of(cells, cell.index());
                        memory::push(&mut lists.turned, (cell, oriented(name, !is_odd)))?;
                    }
                    if origin != cell {
                        memory::push(&mut lists.renumbered_from, origin)?;
                        memory::push(&mut lists.renumbered_to, cell)?;
                    }
                }
            }
        }
        for cell in CellId::range(0..is_there.len()).filter(|&cell| !is_there[cell]) {
            let row = base.corners[cell];
            memory::push(&mut lists.removed, cell)?;
            memory::push(&mut lists.removed_corners, row)?;
            memory::append(&mut lists.stars, row.as_ref())?;
        }
        self.name_removed(base, &is_there, &mut lists)?;
        lists.stars.sort_unstable();
        lists.stars.dedup();
        let hidden = self.vertices_in_no_cell()?;
        for &v in hidden.iter().filter(|v| base.hidden.binary_search(v).is_err()) {
            memory::push(&mut lists.hidden, v)?;
        }
        let is_shown = |v: &&VertexId| hidden.binary_search(v).is_err() && self.is_present(**v);
        for &v in base.hidden.iter().filter(is_shown) {
            memory::push(&mut lists.shown, v)?;
        }
        Ok(lists)
    }

    /// Lists the names of the removed cells, in the order of these.
    fn name_removed(&self, base: &Base<G>, is_there: &[bool], lists: &mut ChangeLists<G>) -> Result<()> {
        if lists.removed.is_empty() {
            return Ok(());
        }
        let nothing = [(VertexId::NONE, [0; 3]); 4];
        memory::lengthen(&mut lists.removed_names, lists.removed.len(), nothing)?;
        for (&name, cell) in base.index_of.iter().filter(|(_, cell)| !is_there[cell.index()]) {
            let k = lists.removed.binary_search(cell).expect("it has been listed");
            lists.removed_names[k] = oriented(name, base.is_odd[cell.index()]);
        }
        Ok(())
    }

    /// The cells of now are those of the base.
    fn set_origins(&mut self) -> Result<()> {
        let Some(cells) = self.cells.get_mut() else { return Ok(()) };
        let n = cells.corners.len();
        let mut origins = Vec::new();
        memory::collect(&mut origins, CellId::range(0..n))?;
        cells.origins = origins;
        Ok(())
    }
}

/// A name with the corners in the other orientation, if they are to be.
fn oriented(mut name: Name, is_odd: bool) -> Name {
    if is_odd {
        name.swap(0, 1);
    }
    name
}
