//! The cells as callers see them: by vertex id, finite cells only, in one array.
//!
//! The arrays are made at the first request after a change and shared by concurrent readers.

use std::collections::HashSet;

use super::MovingTriangulation;
use crate::complex::{Corners, NONE};
use crate::delaunay::{Delaunay, Dimension};
use crate::error::{Error, Result};

/// Neighbour of a cell across a facet of the convex hull.
pub const NO_CELL: u32 = NONE;

/// The finite cells, by vertex id. Valid until the triangulation changes.
#[derive(Clone, Copy, Debug)]
pub struct CellsView<'t, G: Dimension> {
    /// Vertex ids of each cell, positively oriented.
    pub corners: &'t [G::Corners],
    /// Index of the neighbour opposite each corner, [`NO_CELL`] on the hull.
    pub neighbours: &'t [G::Corners],
}

/// The arrays behind a view.
#[derive(Debug)]
pub(super) struct Cells<G: Dimension> {
    pub(super) corners: Vec<G::Corners>,
    pub(super) neighbours: Vec<G::Corners>,
    /// Index in the arrays of the kernel's cells, [`NO_CELL`] for ghost cells.
    pub(super) index_of: Vec<u32>,
    /// The kernel's cell of each index.
    pub(super) slots: Vec<u32>,
}

impl<G: Dimension> Cells<G> {
    fn of(kernel: &Delaunay<G>) -> Self {
        let complex = kernel.complex();
        let mut index_of = vec![NO_CELL; complex.n_slots()];
        for (index, c) in complex.finite().enumerate() {
            index_of[c as usize] = index as u32;
        }
        let mut corners = Vec::with_capacity(complex.n_finite());
        let mut neighbours = Vec::with_capacity(complex.n_finite());
        for c in complex.finite() {
            let cell = complex.cell(c);
            let (mut ids, mut across) = (cell.corners, cell.corners);
            for i in 0..G::Corners::N {
                ids[i] = kernel.site(cell.corners[i]).id;
                across[i] = index_of[cell.neighbour(i).cell() as usize];
            }
            corners.push(ids);
            neighbours.push(across);
        }
        Cells { corners, neighbours, index_of, slots: complex.finite().collect() }
    }

    pub(super) fn memory_bytes(&self) -> usize {
        (self.corners.capacity() + self.neighbours.capacity()) * size_of::<G::Corners>()
            + (self.index_of.capacity() + self.slots.capacity()) * 4
    }
}

/// The cells, each as its sorted ids, at the moment a commit began.
#[derive(Debug)]
pub(super) struct Baseline<G: Dimension> {
    cells: HashSet<G::Corners>,
}

fn sorted<C: Corners>(mut corners: C) -> C {
    corners.as_mut().sort_unstable();
    corners
}

impl<G: Dimension> Baseline<G> {
    pub(super) fn of(t: &MovingTriangulation<G>) -> Self {
        Baseline { cells: t.cells().corners.iter().map(|&c| sorted(c)).collect() }
    }
}

impl<G: Dimension> MovingTriangulation<G> {
    /// The finite cells and their neighbours.
    pub fn cells(&self) -> CellsView<'_, G> {
        let cells = self.cell_arrays();
        CellsView { corners: &cells.corners, neighbours: &cells.neighbours }
    }

    pub(super) fn cell_arrays(&self) -> &Cells<G> {
        self.cells.get_or_init(|| Cells::of(&self.kernel))
    }

    /// Indices, ascending, of the finite cells that did not exist when the latest commit began: of none before the
    /// first one. Immediate relocations, insertions and removals since then count.
    ///
    /// # Errors
    /// [`Error::ChangesNotTracked`] unless the options ask for it.
    pub fn changed_cells(&self) -> Result<&[u32]> {
        if !self.options.track_changes {
            return Err(Error::ChangesNotTracked);
        }
        Ok(self.changed.get_or_init(|| match &self.baseline {
            None => Vec::new(),
            Some(baseline) => {
                let corners = self.cells().corners;
                let is_new = |i: &u32| !baseline.cells.contains(&sorted(corners[*i as usize]));
                (0..corners.len() as u32).filter(is_new).collect()
            }
        }))
    }

    /// Whether anything derived from the cells is kept.
    #[inline(always)]
    pub(super) fn has_views(&self) -> bool {
        self.cells.get().is_some() || self.changed.get().is_some()
    }

    /// Drops what was derived from the cells: they are about to change.
    pub(super) fn forget_views(&mut self) {
        self.cells.take();
        self.changed.take();
    }
}
