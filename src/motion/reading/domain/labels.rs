//! Labels of cells that have come, from those of the cells around them.

use crate::delaunay::Plane;
use crate::error::{Error, Result};
use crate::ids::CellId;
use crate::machine::memory;
use crate::motion::state::cells::NO_CELL;
use crate::motion::triangulation::MovingTriangulation;

/// What is known of the label of cells that are reached from each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LabelFound {
    Nothing,
    One(i32),
    Several,
}

impl LabelFound {
    pub(super) fn and(self, label: i32) -> Self {
        match self {
            LabelFound::Nothing => LabelFound::One(label),
            LabelFound::One(other) if other == label => self,
            _ => LabelFound::Several,
        }
    }

    /// What is known by both.
    pub(super) fn or(self, other: Self) -> Self {
        match other {
            LabelFound::Nothing => self,
            LabelFound::One(label) => self.and(label),
            LabelFound::Several => other,
        }
    }
}

impl MovingTriangulation<Plane> {
    /// Labels of some cells, in ascending order of the cells, from those of all others: the label of the cells that they are
    /// reached from without crossing a segment. Cells that are reached from the outside alone, from none, or from some of
    /// different labels, get `other`. Returns the cells with their labels, and how many are undecided: those of the last two
    /// kinds.
    ///
    /// Cost: of k cells k log k, and k log s where there are s segments.
    ///
    /// # Errors
    /// [`Error::NoSuchCell`], [`Error::OutOfMemory`].
    pub fn labels_of(
        &self,
        listed: &[CellId],
        label_of: impl Fn(CellId) -> i32,
        other: i32,
    ) -> Result<(Vec<(CellId, i32)>, usize)> {
        let (cells, kernel) = (self.cell_arrays()?, &self.mesh.kernel);
        let n = cells.corners().len();
        if let Some(index) = listed.iter().position(|cell| cell.index() >= n) {
            return Err(Error::NoSuchCell { argument: "cells", index, cell: listed[index], cells: n });
        }
        let mut labels = Vec::new();
        memory::collect(&mut labels, listed.iter().map(|&cell| (cell, other)))?;
        labels.sort_unstable_by_key(|&(cell, _)| cell);
        labels.dedup_by_key(|&mut (cell, _)| cell);
        let mut is_reached = Vec::new();
        memory::lengthen(&mut is_reached, labels.len(), false)?;
        let mut n_undecided = 0;
        // The places among `labels` of the cells of one part; those from `next` on wait.
        let mut part: Vec<usize> = Vec::new();
        for first in 0..labels.len() {
            if std::mem::replace(&mut is_reached[first], true) {
                continue;
            }
            part.clear();
            memory::push(&mut part, first)?;
            let (mut found, mut is_outside, mut next) = (LabelFound::Nothing, false, 0);
            while next < part.len() {
                let cell = labels[part[next]].0;
                next += 1;
                for (i, across) in cells.neighbours()[cell].into_iter().enumerate() {
                    let facet = cells.facet(cell, i);
                    if kernel.is_facet_required(facet.cell(), facet.index()) {
                        continue;
                    }
                    if across == NO_CELL {
                        is_outside = true;
                        continue;
                    }
                    match labels.binary_search_by_key(&across, |&(cell, _)| cell) {
                        Err(_) => found = found.and(label_of(across)),
                        Ok(at) if !std::mem::replace(&mut is_reached[at], true) => {
                            memory::push(&mut part, at)?
                        }
                        Ok(_) => {}
                    }
                }
            }
            match found {
                LabelFound::One(label) => part.iter().for_each(|&at| labels[at].1 = label),
                LabelFound::Nothing if is_outside => {}
                LabelFound::Nothing | LabelFound::Several => n_undecided += part.len(),
            }
        }
        Ok((labels, n_undecided))
    }
}
