//! The cells of a change: which are gone, which have come, and which count as both.

use super::boxes::Extent;
use super::near::near;
use super::overlap::{Place, centroid, is_turned_over, plus};
use super::{Arrived, Beyond, Facet, Gone, Meeting, TransferOrder, Transferred};
use crate::error::{Error, Result};
use crate::ids::CellId;
use crate::machine::memory;
use crate::motion::reading::progress::Progress;

#[cfg(test)]
pub(crate) mod tests;

/// Multiples of vectors.
pub(crate) type Shift = [i64; 3];

/// A cell, and by what it is translated from where its corners are told.
pub(crate) type CellAt = (CellId, Shift);

/// The cells of now.
pub(crate) trait Now {
    /// The dimension.
    const D: usize;

    /// How many there are.
    fn len(&self) -> usize;

    /// The index that one had that was there.
    fn before(&self, cell: CellId) -> CellId;

    fn corners(&self, cell: CellId) -> [Place; 4];

    fn facets(&self, cell: CellId) -> [Facet; 4];

    /// The cell across the facet opposite a corner, where the cell is as its corners are told.
    fn across(&self, cell: CellId, corner: usize) -> Option<CellAt>;

    /// By how much what has a shift is translated.
    fn offset(&self, shift: &Shift) -> Place;

    /// A cell that has a place, of which it may be a corner.
    fn at(&self, place: &Place) -> Result<Option<CellAt>>;

    /// By how much more, at least, than corners of a cell with this box, and those of cells there, are off by rounding.
    fn rounding(&self, extent: &Extent) -> Place;

    /// Where each of these is that may meet some cells of now: its number, and by how much it is translated.
    fn copies(&self, gone: &[Gone], cells: impl Iterator<Item = CellId>) -> Result<Vec<(u32, Place)>>;

    /// The box of some cells.
    fn extent_of(&self, cells: impl Iterator<Item = CellId>) -> Extent {
        let mut all = Extent::of(&[]);
        cells.for_each(|cell| all.enter(&Extent::of(&self.corners(cell)[..=Self::D])));
        all
    }
}

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
        let (meeting, mut met) = (Meeting::of::<D>(turned_over, copies)?, Vec::new());
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

    fn beyond<const D: usize>(&self, cell: CellId) -> [Beyond; 4] {
        let mut beyond = [Beyond::Nothing; 4];
        for (k, entry) in beyond.iter_mut().enumerate().take(D + 1) {
            let Some((other, shift)) = self.now.across(cell, k) else { continue };
            *entry = match self.arrived.binary_search(&other) {
                Ok(k) => Beyond::Arrived(k as u32),
                Err(_) => {
                    let (corners, offset) = (self.now.corners(other), self.now.offset(&shift));
                    let centre = plus(&plus(&corners[0], &offset), &centroid::<D>(&corners));
                    Beyond::Living { before: self.now.before(other).get(), centre }
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
            Beyond::Living { before, .. } => Some(*before),
            _ => None,
        });
        for before in self.gone.iter().map(|cell| cell.before).chain(living) {
            (0..n_values).try_for_each(|c| check_value(before as usize * n_values + c, value(before, c)))?;
        }
        let copies = self.now.copies(&self.gone, self.arrived.iter().copied())?;
        let overlay = Meeting::of::<D>(&self.gone, copies)?.overlay::<D>(&arrived, progress)?;
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
