//! The cells of a change: which are gone, which have come, and which count as both.

use super::boxes::Extent;
use super::overlap::{Facets, Place, centroid, plus};
use super::{Arrived, Beyond, Facet, Gone, Meeting, TransferOrder, Transferred};
use crate::error::{Error, Result};
use crate::ids::CellId;
use crate::machine::memory;

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

    /// The cell across the facet opposite a corner, and by how much it is translated from where its corners are told.
    fn beyond(&self, cell: CellId, corner: usize) -> Option<(CellId, Place)>;

    /// Where each of these is that may meet what is in a box: its number, and by how much it is translated.
    fn copies(&self, gone: &[Gone], within: &Extent) -> Result<Vec<(u32, Place)>>;
}

/// Transfers means from the cells that are gone to those that have come; `renumbered` are the cells that live and have
/// other indices, of before and now, and `value` tells a component of the mean of a cell that was.
pub(crate) fn transfer<T: Now>(
    now: &T,
    gone: Vec<Gone>,
    arrived: Vec<CellId>,
    renumbered: [&[CellId]; 2],
    order: TransferOrder,
    n_values: usize,
    value: &impl Fn(u32, usize) -> f64,
) -> Result<Transferred> {
    let change = Change { now, gone, arrived };
    if T::D == 2 {
        change.transfer::<2>(renumbered, order, n_values, value)
    } else {
        change.transfer::<3>(renumbered, order, n_values, value)
    }
}

struct Change<'t, T> {
    now: &'t T,
    gone: Vec<Gone>,
    /// Ascending once all are there.
    arrived: Vec<CellId>,
}

impl<T: Now> Change<'_, T> {
    fn meeting<'a, const D: usize>(
        &self,
        gone: &'a [Gone],
        cells: impl Iterator<Item = CellId>,
    ) -> Result<Meeting<'a>> {
        let mut within = Extent::of(&[]);
        cells.for_each(|cell| within.enter(&Extent::of(&self.now.corners(cell)[..=D])));
        Meeting::of::<D>(gone, self.now.copies(gone, &within)?)
    }

    /// Where a cell that is gone is turned over, cells that live and that it meets are both gone and come.
    fn enter_met<const D: usize>(&mut self) -> Result<()> {
        self.arrived.sort_unstable();
        let is_turned_over = |cell: &Gone| Facets::of::<D>(&cell.corners).determinant < 0.0;
        let mut turned_over = Vec::new();
        memory::collect(&mut turned_over, self.gone.iter().copied().filter(is_turned_over))?;
        if turned_over.is_empty() {
            return Ok(());
        }
        let all = CellId::range(0..self.now.len());
        let (meeting, n) = (self.meeting::<D>(&turned_over, all.clone())?, self.arrived.len());
        for cell in all {
            let corners = self.now.corners(cell);
            if self.arrived[..n].binary_search(&cell).is_err() && meeting.meets::<D>(&corners)? {
                let (facets, before) = (self.now.facets(cell), self.now.before(cell).get());
                memory::push(&mut self.gone, Gone { corners, facets, before })?;
                memory::push(&mut self.arrived, cell)?;
            }
        }
        self.arrived.sort_unstable();
        Ok(())
    }

    fn beyond<const D: usize>(&self, cell: CellId) -> [Beyond; 4] {
        let mut beyond = [Beyond::Nothing; 4];
        for (k, entry) in beyond.iter_mut().enumerate().take(D + 1) {
            let Some((other, offset)) = self.now.beyond(cell, k) else { continue };
            *entry = match self.arrived.binary_search(&other) {
                Ok(k) => Beyond::Arrived(k as u32),
                Err(_) => {
                    let corners = self.now.corners(other);
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
    ) -> Result<Transferred> {
        self.enter_met::<D>()?;
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
        let meeting = self.meeting::<D>(&self.gone, self.arrived.iter().copied())?;
        let mut made = meeting.overlay::<D>(&arrived)?.transfer::<D>(order, n_values, value)?;
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
