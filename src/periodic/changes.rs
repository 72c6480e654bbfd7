//! What has changed since a program last took the changes.
//!
//! A cell is its vertices with their shifts from each other, told by the program's positions and vectors: what a program
//! that keeps something for each cell can recognise. The cells are read as a whole after each change, and found by that
//! among those of the *base*, the last time when changes were taken: each that was there keeps its index, but for the last
//! ones where there are fewer. Cost: n + m.

use std::collections::HashMap;
use std::hash::BuildHasherDefault;

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::{Changes, NO_CELL};
use crate::periodic::cells::{PeriodicCells, RowHasher};
use crate::periodic::lattice::Lattice;

/// A cell by its vertices in order, each with the period in which it is, where the first is at its position; the last is none
/// in the plane.
pub(super) type Name = [(VertexId, [i64; 3]); 4];

/// The cells when changes were last taken.
#[derive(Debug)]
pub(super) struct Base<G: Moving> {
    pub(super) corners: Vec<G::Vertices>,
    pub(super) index_of: HashMap<Name, CellId, BuildHasherDefault<RowHasher>>,
    /// By index, whether a name lists the corners in the opposite orientation.
    pub(super) is_odd: Vec<bool>,
    /// Vertices that others hid, ascending.
    pub(super) hidden: Vec<VertexId>,
    /// The lattice, if changes had been taken.
    pub(super) lattice: Option<Lattice<G>>,
}

impl<G: Moving> Base<G> {
    /// The base of a box of which no cell has been reported yet.
    pub(super) fn none() -> Self {
        Base {
            corners: Vec::new(),
            index_of: HashMap::default(),
            is_odd: Vec::new(),
            hidden: Vec::new(),
            lattice: None,
        }
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
        base.is_odd = memory::copy_of(&self.is_odd)?;
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
        base.lattice = self.lattice.as_ref().map(Lattice::copied);
        Ok(base)
    }

    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.corners)
            + self.index_of.capacity() * size_of::<(Name, CellId)>()
            + memory::bytes_of(&self.is_odd)
            + memory::bytes_of(&self.hidden)
    }
}

/// The lists behind [`Changes`].
#[derive(Debug)]
pub(super) struct ChangeLists<G: Moving> {
    pub(super) created: Vec<CellId>,
    pub(super) removed: Vec<CellId>,
    pub(super) removed_corners: Vec<G::Vertices>,
    /// The names of the removed cells, with the corners in the orientation that each had.
    pub(super) removed_names: Vec<Name>,
    /// Cells that live and have been turned over, by index, and the names of these likewise.
    pub(super) turned: Vec<(CellId, Name)>,
    pub(super) renumbered_from: Vec<CellId>,
    pub(super) renumbered_to: Vec<CellId>,
    pub(super) stars: Vec<VertexId>,
    pub(super) hidden: Vec<VertexId>,
    pub(super) shown: Vec<VertexId>,
}

impl<G: Moving> ChangeLists<G> {
    pub(super) fn none() -> Self {
        ChangeLists {
            created: Vec::new(),
            removed: Vec::new(),
            removed_corners: Vec::new(),
            removed_names: Vec::new(),
            turned: Vec::new(),
            renumbered_from: Vec::new(),
            renumbered_to: Vec::new(),
            stars: Vec::new(),
            hidden: Vec::new(),
            shown: Vec::new(),
        }
    }

    pub(super) fn changes(&self) -> Changes<'_, G::Vertices> {
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
            + memory::bytes_of(&self.removed_names)
            + memory::bytes_of(&self.turned)
            + [&self.stars, &self.hidden, &self.shown].map(memory::bytes_of).iter().sum::<usize>()
    }
}

/// Changes that have been taken.
#[derive(Debug)]
pub(super) struct Taking<G: Moving> {
    pub(super) base: Base<G>,
    pub(super) lists: ChangeLists<G>,
    /// The timestamp at which they were taken, if the lists are still of these ids.
    pub(super) timestamp: Option<u64>,
    /// Whether the vectors are others than when changes were taken before.
    pub(super) is_strained: bool,
}

impl<G: Moving> Taking<G> {
    /// What it is for another triangulation with these ids, listed by the old ones; without the lists.
    pub(super) fn renumbered(&self, new_id: impl Fn(VertexId) -> VertexId) -> Result<Self> {
        let base = self.base.renumbered(new_id)?;
        Ok(Taking { base, lists: ChangeLists::none(), timestamp: None, is_strained: false })
    }
}

impl<G: Moving> PeriodicCells<G> {
    /// The index that a cell had at the base; none for one that was not there.
    pub(super) fn origin(&self, cell: CellId) -> CellId {
        self.origins.get(cell.index()).copied().unwrap_or(NO_CELL)
    }

    /// In another order: by index, the one of `self`, which had these indices at the base.
    pub(super) fn reordered(self, order: &[CellId], origins: &[CellId]) -> Result<Self> {
        let n = order.len();
        let mut index_of = Vec::new();
        memory::lengthen(&mut index_of, n, NO_CELL)?;
        CellId::range(0..n).zip(order).for_each(|(index, &cell)| index_of[cell] = index);
        let new = |cell: CellId| if cell == NO_CELL { NO_CELL } else { index_of[cell] };
        let mut made = PeriodicCells::<G>::none();
        memory::collect(&mut made.corners, order.iter().map(|&cell| self.corners[cell]))?;
        made.shifts = self.shifts.reordered(order)?;
        let neighbours = order.iter().map(|&cell| {
            let mut row = self.neighbours[cell];
            row.as_mut().iter_mut().for_each(|cell| *cell = new(*cell));
            row
        });
        memory::collect(&mut made.neighbours, neighbours)?;
        made.neighbour_shifts = self.neighbour_shifts.reordered(order)?;
        memory::collect(&mut made.least, order.iter().map(|&cell| self.least[cell.index()]))?;
        memory::collect(&mut made.chosen, order.iter().map(|&cell| self.chosen[cell]))?;
        memory::collect(&mut made.class_of, self.class_of.iter().map(|&cell| new(cell)))?;
        memory::collect(&mut made.origins, order.iter().map(|&cell| origins[cell]))?;
        Ok(made)
    }
}
