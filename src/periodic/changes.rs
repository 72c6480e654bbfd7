//! What has changed since a program last took the changes.
//!
//! A cell is its vertices with their shifts from each other, told by the program's positions and vectors: what a program
//! that keeps something for each cell can recognise. The cells are read as a whole after each change, and found by that
//! among those of the *base*, the last time when changes were taken: each that was there keeps its index, but for the last
//! ones where there are fewer. Cost: n + m.

use std::collections::HashMap;
use std::hash::BuildHasherDefault;

use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::{Changes, NO_CELL};
use crate::periodic::cells::{PeriodicCells, RowHasher};
use crate::periodic::triangulation::PeriodicTriangulation;

/// A cell by its vertices in order, each with the period in which it is, where the first is at its position; the last is none
/// in the plane.
type Name = [(VertexId, [i64; 3]); 4];

/// The cells when changes were last taken.
#[derive(Debug)]
pub(super) struct Base<G: Dimension> {
    corners: Vec<G::Vertices>,
    index_of: HashMap<Name, CellId, BuildHasherDefault<RowHasher>>,
    /// Vertices that others hid, ascending.
    hidden: Vec<VertexId>,
}

impl<G: Dimension> Base<G> {
    /// That of a box in which no cell has been told yet.
    fn none() -> Self {
        Base { corners: Vec::new(), index_of: HashMap::default(), hidden: Vec::new() }
    }

    /// A copy in which vertices have other ids, listed by the old ones; those that have none any more are in no cell of now.
    fn renumbered(&self, new_id: impl Fn(VertexId) -> VertexId) -> Result<Self> {
        let mut base = Base::none();
        let renumbered = self.corners.iter().map(|row| {
            let mut row = *row;
            row.as_mut().iter_mut().for_each(|v| *v = new_id(*v));
            row
        });
        memory::collect(&mut base.corners, renumbered)?;
        memory::reserve_map(&mut base.index_of, self.index_of.len())?;
        for (name, &cell) in &self.index_of {
            let mut name = *name;
            name[..=G::D].iter_mut().for_each(|(v, _)| *v = new_id(*v));
            if name[..=G::D].iter().all(|&(v, _)| v != VertexId::NONE) {
                base.index_of.insert(name, cell);
            }
        }
        memory::reserve_exact(&mut base.hidden, self.hidden.len())?;
        base.hidden.extend(self.hidden.iter().map(|&v| new_id(v)).filter(|&v| v != VertexId::NONE));
        Ok(base)
    }

    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.corners)
            + self.index_of.capacity() * size_of::<(Name, CellId)>()
            + memory::bytes_of(&self.hidden)
    }
}

/// The lists behind [`Changes`].
#[derive(Debug)]
pub(super) struct Lists<G: Dimension> {
    created: Vec<CellId>,
    removed: Vec<CellId>,
    removed_corners: Vec<G::Vertices>,
    renumbered_from: Vec<CellId>,
    renumbered_to: Vec<CellId>,
    stars: Vec<VertexId>,
    hidden: Vec<VertexId>,
    shown: Vec<VertexId>,
}

impl<G: Dimension> Lists<G> {
    fn none() -> Self {
        Lists {
            created: Vec::new(),
            removed: Vec::new(),
            removed_corners: Vec::new(),
            renumbered_from: Vec::new(),
            renumbered_to: Vec::new(),
            stars: Vec::new(),
            hidden: Vec::new(),
            shown: Vec::new(),
        }
    }

    fn changes(&self) -> Changes<'_, G::Vertices> {
        Changes {
            created: &self.created,
            removed: &self.removed,
            removed_corners: &self.removed_corners,
            renumbered_from: &self.renumbered_from,
            renumbered_to: &self.renumbered_to,
            stars: &self.stars,
            hidden: &self.hidden,
            shown: &self.shown,
        }
    }

    pub(super) fn memory_bytes(&self) -> usize {
        [&self.created, &self.removed, &self.renumbered_from, &self.renumbered_to]
            .map(memory::bytes_of)
            .iter()
            .sum::<usize>()
            + memory::bytes_of(&self.removed_corners)
            + [&self.stars, &self.hidden, &self.shown].map(memory::bytes_of).iter().sum::<usize>()
    }
}

/// Changes that have been taken.
#[derive(Debug)]
pub(super) struct Taking<G: Dimension> {
    pub(super) base: Base<G>,
    pub(super) lists: Lists<G>,
}

impl<G: Dimension> Taking<G> {
    /// What it is for another triangulation with these ids, listed by the old ones; without the lists.
    pub(super) fn renumbered(&self, new_id: impl Fn(VertexId) -> VertexId) -> Result<Self> {
        Ok(Taking { base: self.base.renumbered(new_id)?, lists: Lists::none() })
    }
}

impl<G: Dimension> PeriodicTriangulation<G> {
    /// What has changed since this was last called: everything, as created, at the first call. A cell is its vertices with their
    /// [shifts](Self::cell_shifts) from each other, so one is new if the program takes one of its vertices to another period,
    /// or gives other vectors of the lattice. A cell that stays keeps its index unless it is among the renumbered ones.
    ///
    /// The cost is n + m.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory); then nothing has been taken.
    pub fn take_changes(&mut self) -> Result<Changes<'_, G::Vertices>> {
        let cells = self.read_cells()?;
        let (lists, base) = (self.list_changes(cells)?, self.base_of(cells)?);
        // From now on, each has been where it is.
        self.set_origins()?;
        Ok(self.taking.insert(Taking { base, lists }).lists.changes())
    }

    /// Gives cells that were there at the base their indices, as far as there are as many.
    pub(super) fn in_order(&self, read: PeriodicCells<G>) -> Result<PeriodicCells<G>> {
        let Some(Taking { base, .. }) = &self.taking else { return Ok(read) };
        let n = read.corners.len();
        let mut origins = Vec::new();
        memory::reserve_exact(&mut origins, n)?;
        for cell in 0..n {
            origins.push(base.index_of.get(&self.name_of(&read, cell)).copied().unwrap_or(NO_CELL));
        }
        // By index, which one has it.
        let mut order = Vec::new();
        memory::lengthen(&mut order, n, NO_CELL)?;
        let stays = |origin: CellId| origin != NO_CELL && origin.index() < n;
        for (cell, &origin) in CellId::range(0..n).zip(&origins).filter(|&(_, &origin)| stays(origin)) {
            order[origin] = cell;
        }
        let mut others = CellId::range(0..n).filter(|&cell| !stays(origins[cell]));
        for entry in order.iter_mut().filter(|entry| **entry == NO_CELL) {
            *entry = others.next().expect("there are as many as places");
        }
        read.reordered(&order, &origins)
    }

    /// By which a cell is known to the program.
    fn name_of(&self, cells: &PeriodicCells<G>, cell: usize) -> Name {
        let from = self.least_of(cells, cell);
        let mut name = [(VertexId::NONE, [0; 3]); 4];
        let row = cells.corners[cell].as_ref();
        for (i, (entry, &v)) in name.iter_mut().zip(row).enumerate() {
            *entry = (v, self.given(from, v, cells.shifts[cell * (G::D + 1) + i]));
        }
        let name_of_all = &mut name[..=G::D];
        name_of_all.sort_unstable();
        let first = name_of_all[0].1;
        name_of_all.iter_mut().for_each(|(_, shift)| *shift = [0, 1, 2].map(|j| shift[j] - first[j]));
        name
    }

    fn base_of(&self, cells: &PeriodicCells<G>) -> Result<Base<G>> {
        let mut base = Base::none();
        base.corners = memory::copy_of(&cells.corners)?;
        memory::reserve_map(&mut base.index_of, cells.corners.len())?;
        for cell in CellId::range(0..cells.corners.len()) {
            base.index_of.insert(self.name_of(cells, cell.index()), cell);
        }
        base.hidden = self.hidden_now()?;
        Ok(base)
    }

    /// Vertices that others hide, ascending.
    fn hidden_now(&self) -> Result<Vec<VertexId>> {
        let mut hidden = Vec::new();
        if self.inside.t.hidden_count() > 0 {
            let at_home =
                self.inside.t.hidden_vertices().map(|(v, _)| v).filter(|v| v.index() < self.inside.n_home);
            for v in at_home {
                memory::push(&mut hidden, self.inside.images.of(v).vertex)?;
            }
        }
        hidden.sort_unstable();
        Ok(hidden)
    }

    fn list_changes(&self, cells: &PeriodicCells<G>) -> Result<Lists<G>> {
        let none = Base::none();
        let base = self.taking.as_ref().map_or(&none, |taking| &taking.base);
        let mut lists = Lists::none();
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
        lists.stars.sort_unstable();
        lists.stars.dedup();
        let hidden = self.hidden_now()?;
        for &v in hidden.iter().filter(|v| base.hidden.binary_search(v).is_err()) {
            memory::push(&mut lists.hidden, v)?;
        }
        let is_shown = |v: &&VertexId| hidden.binary_search(v).is_err() && self.is_present(**v);
        for &v in base.hidden.iter().filter(is_shown) {
            memory::push(&mut lists.shown, v)?;
        }
        Ok(lists)
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

impl<G: Dimension> PeriodicCells<G> {
    /// The index that a cell had at the base; none for one that was not there.
    fn origin(&self, cell: CellId) -> CellId {
        self.origins.get(cell.index()).copied().unwrap_or(NO_CELL)
    }

    /// In another order: by index, the one of `self`, which had these indices at the base.
    fn reordered(self, order: &[CellId], origins: &[CellId]) -> Result<Self> {
        let n = order.len();
        let mut index_of = Vec::new();
        memory::lengthen(&mut index_of, n, NO_CELL)?;
        CellId::range(0..n).zip(order).for_each(|(index, &cell)| index_of[cell] = index);
        let new = |cell: CellId| if cell == NO_CELL { NO_CELL } else { index_of[cell] };
        let rows = |of: &Vec<[i32; 3]>| {
            let mut made = Vec::new();
            memory::reserve_exact(&mut made, of.len())?;
            order.iter().for_each(|&cell| made.extend_from_slice(&of[cell.index() * (G::D + 1)..][..=G::D]));
            Ok(made)
        };
        let mut made = PeriodicCells::<G>::none();
        memory::collect(&mut made.corners, order.iter().map(|&cell| self.corners[cell]))?;
        made.shifts = rows(&self.shifts)?;
        let neighbours = order.iter().map(|&cell| {
            let mut row = self.neighbours[cell];
            row.as_mut().iter_mut().for_each(|cell| *cell = new(*cell));
            row
        });
        memory::collect(&mut made.neighbours, neighbours)?;
        made.neighbour_shifts = rows(&self.neighbour_shifts)?;
        memory::collect(&mut made.least, order.iter().map(|&cell| self.least[cell.index()]))?;
        memory::collect(&mut made.chosen, order.iter().map(|&cell| self.chosen[cell]))?;
        memory::collect(&mut made.class_of, self.class_of.iter().map(|&cell| new(cell)))?;
        memory::collect(&mut made.origins, order.iter().map(|&cell| origins[cell]))?;
        Ok(made)
    }
}
