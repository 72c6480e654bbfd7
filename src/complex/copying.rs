//! A copy of all cells, in the same slots.

use super::record::Record;
use super::{Complex, Corners};
use crate::error::Result;
use crate::machine::memory;

impl<C: Corners> Complex<C> {
    /// A copy, without room for more cells, and without the record if one is kept.
    pub(crate) fn copied(&self) -> Result<Self> {
        let cells = self.cells.copied()?;
        let mut marks = Vec::new();
        memory::reserve_exact(&mut marks, cells.capacity())?;
        marks.resize(cells.len(), 0);
        let free = self.free.copied()?;
        Ok(Complex { cells, marks, free, n_ghosts: self.n_ghosts, record: Record::default() })
    }
}
