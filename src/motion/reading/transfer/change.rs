//! The cells of a change: which are gone, which have come, and which count as both.

use super::near::near;
use super::now::Now;
use super::overlap::{centroid, is_turned_over, plus};
use super::{Arrived, BeyondFacet, Gone, GoneCells, TransferOrder, Transferred};
use crate::error::{Error, Result};
use crate::ids::CellId;
use crate::machine::memory;
use crate::motion::reading::progress::Progress;

#[cfg(test)]
pub(crate) mod tests;

/// Transfers means from the cells that are gone to those that have come; `renumbered` are the cells that live and have
/// other indices, of before and now, and `value` tells a component of the mean of a cell that was.
pub(crate) fn transfer<T: Now>(
    now: &T,
    gone: Vec<Gone>,
    arrived: Vec<CellId>,
    renumbered: [&[CellId]; 2],
    (order, n_values): (TransferOrder, usize),
    value: &impl Fn(u32, usize) -> f64,
    monitor: &mut dyn FnMut(f64) -> bool,
) -> Result<Transferred> {
    let (change, progress) = (Change { now, gone, arrived }, &mut Progress::new(monitor, 1));
    if T::D == 2 {
        change.transfer::<2>(renumbered, order, n_values, value, progress)
    } else {
        change.transfer::<3>(renumbered, order, n_values, value, progress)
    }
}

struct Change<'t, T> {
    now: &'t T,
    gone: Vec<Gone>,
    /// Ascending once all are there.
    arrived: Vec<CellId>,
}

impl<T: Now> Change<'_, T> {
    /// Where a cell that is gone is turned over, cells that live and that it meets are both gone and come.
    fn enter_met<const D: usize>(&mut self, progress: &mut Progress) -> Result<()> {
        self.arrived.sort_unstable();
        let mut turned_over = Vec::new();
        let all = self.gone.iter().copied();
        memory::collect(&mut turned_over, all.filter(|cell| is_turned_over::<D>(&cell.corners)))?;
        if turned_over.is_empty() {
            return Ok(());
        }
        progress.expect_more(self.now.len() + self.arrived.len());
        let met = match near::<D, T>(self.now, &turned_over, progress)? {
            Some(near) => self.met::<D>(&turned_over, &near, progress)?,
            None => self.met_of_all::<D>(&turned_over, progress)?,
        };
        memory::reserve(&mut self.gone, met.len())?;
        for &cell in &met {
            let (corners, facets) = (self.now.corners(cell), self.now.facets(cell));
            self.gone.push(Gone { corners, facets, before: self.now.before(cell).get() });
        }
        memory::append(&mut self.arrived, &met)?;
        self.arrived.sort_unstable();
        Ok(())
    }

    /// Which cells of now, but for those that have come, meet some that are turned over.
    fn met_of_all<const D: usize>(
        &self,
        turned_over: &[Gone],
        progress: &mut Progress,
    ) -> Result<Vec<CellId>> {
        let mut all = Vec::new();
        memory::collect(&mut all, CellId::range(0..self.now.len()))?;
        self.met::<D>(turned_over, &all, progress)
    }

    /// Which of these cells do so.
    fn met<const D: usize>(
        &self,
        turned_over: &[Gone],
        cells: &[CellId],
        progress: &mut Progress,
    ) -> Result<Vec<CellId>> {
        let copies = self.now.copies(turned_over, cells.iter().copied())?;
        let (meeting, mut met) = (GoneCells::of::<D>(turned_over, copies)?, Vec::new());
        progress.expect_more(cells.len() + self.arrived.len());
        for &cell in cells {
            progress.advance(1)?;
            let is_met = meeting.meets::<D>(&self.now.corners(cell))?;
            if is_met && self.arrived.binary_search(&cell).is_err() {
                memory::push(&mut met, cell)?;
            }
        }
        Ok(met)
    }

    fn beyond<const D: usize>(&self, cell: CellId) -> [BeyondFacet; 4] {
        let mut beyond = [BeyondFacet::Nothing; 4];
        for (k, entry) in beyond.iter_mut().enumerate().take(D + 1) {
            let Some((other, shift)) = self.now.across(cell, k) else { continue };
            *entry = match self.arrived.binary_search(&other) {
                Ok(k) => BeyondFacet::Arrived(k as u32),
                Err(_) => {
                    let (corners, offset) = (self.now.corners(other), self.now.offset(&shift));
                    let centre = plus(&plus(&corners[0], &offset), &centroid::<D>(&corners));
                    BeyondFacet::Living { before: self.now.before(other).get(), centre }
                }
            };
        }
        beyond
    }

    fn transfer<const D: usize>(
        mut self,
        [from, to]: [&[CellId]; 2],
        order: TransferOrder,
        n_values: usize,
        value: &impl Fn(u32, usize) -> f64,
        progress: &mut Progress,
    ) -> Result<Transferred> {
        self.enter_met::<D>(progress)?;
        let mut arrived = Vec::new();
        let cells = self.arrived.iter().map(|&index| Arrived {
            index,
            corners: self.now.corners(index),
            facets: self.now.facets(index),
            beyond: self.beyond::<D>(index),
        });
        memory::collect(&mut arrived, cells)?;
        let living = arrived.iter().flat_map(|cell| &cell.beyond).filter_map(|beyond| match beyond {
            BeyondFacet::Living { before, .. } => Some(*before),
            _ => None,
        });
        for before in self.gone.iter().map(|cell| cell.before).chain(living) {
            (0..n_values).try_for_each(|c| check_value(before as usize * n_values + c, value(before, c)))?;
        }
        let copies = self.now.copies(&self.gone, self.arrived.iter().copied())?;
        let overlay = GoneCells::of::<D>(&self.gone, copies)?.overlay::<D>(&arrived, progress)?;
        let mut made = overlay.transfer::<D>(order, n_values, value)?;
        memory::append(&mut made.cells, to)?;
        memory::reserve(&mut made.means, to.len() * n_values)?;
        // A cell that counts as come may have another index as well: the last entry, with what has come of it, is in
        // force.
        from.iter().for_each(|cell| made.means.extend((0..n_values).map(|c| value(cell.get(), c))));
        made.cells.rotate_right(to.len());
        made.means.rotate_right(to.len() * n_values);
        Ok(made)
    }
}

/// A value must be a number that can be calculated with: sums and differences of some are finite.
fn check_value(index: usize, value: f64) -> Result<()> {
    if value.abs() <= 1e300 {
        return Ok(());
    }
    Err(Error::InvalidValue { argument: "values", index, value, wanted: "a number up to 1e300 in magnitude" })
}
