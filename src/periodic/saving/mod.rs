//! Saving and loading: a triangulation as bytes, the same on every machine.
//!
//! docs/FORMAT.md describes the bytes. They hold the vectors on their grid, of which the same lattice follows, what each
//! vertex inside is, and what is inside as its own bytes; and what is staged, the timestamp, and sums.
//!
//! Loading triangulates nothing, and trusts nothing: what is inside is loaded as any triangulation, each image has to be where
//! the vectors take its vertex, and the cells at home have to be those of the set that repeats (completeness.rs).

mod header;
mod loading;
mod writing;

use crate::damage::Damage;
use crate::motion::Beginning;
use header::PeriodicHeader;

/// Bytes of a saved periodic triangulation, the size and the checksum of which are right.
#[derive(Clone, Copy, Debug)]
pub struct SavedPeriodic<'d> {
    header: PeriodicHeader,
    data: &'d [u8],
}

impl<'d> SavedPeriodic<'d> {
    /// Looks at bytes.
    ///
    /// # Errors
    /// What is wrong with them.
    pub fn of(data: &'d [u8]) -> Result<Self, Damage> {
        let header = PeriodicHeader::read(data)?;
        Beginning::check_sum(data)?;
        Ok(SavedPeriodic { header, data })
    }

    /// Whether these bytes, or the first of them, are those of a periodic triangulation, right or not; `given` bytes are there in
    /// all.
    pub fn is_of(data: &[u8], given: u64) -> bool {
        Beginning::read(data, given).is_ok_and(|beginning| beginning.is_periodic_with_weights().is_some())
    }

    /// The dimension of the triangulation, 2 or 3.
    pub fn dimension(&self) -> u32 {
        self.header.dimension
    }

    /// Whether the vertices of the triangulation have weights.
    pub fn is_weighted(&self) -> bool {
        self.header.has_weights
    }
}
