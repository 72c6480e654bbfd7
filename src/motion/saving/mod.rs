//! Saving and loading: a triangulation as bytes, the same on every machine.
//!
//! docs/FORMAT.md describes the bytes. They hold what programs see: positions, which vertices are present and which
//! hidden, the cells with their indices, what is staged, the timestamp, and sums. What the algorithms keep, and what
//! of the changes has not been taken, is not saved.
//!
//! Loading triangulates nothing. It trusts nothing either: after the checksum, cells must fit together, and pass all
//! certificates of a Delaunay triangulation ([`Damage`](crate::Damage) has what may be wrong).

mod header;
mod loading;
mod writing;

use crate::damage::Damage;
use header::Header;

/// Bytes of a saved triangulation, the size and the checksum of which are right.
#[derive(Clone, Copy, Debug)]
pub struct Saved<'d> {
    header: Header,
    data: &'d [u8],
}

impl<'d> Saved<'d> {
    /// Looks at bytes.
    ///
    /// # Errors
    /// What is wrong with them.
    pub fn of(data: &'d [u8]) -> Result<Self, Damage> {
        Ok(Saved { header: Header::read(data)?, data })
    }

    /// The dimension of the triangulation, 2 or 3.
    pub fn dimension(&self) -> u32 {
        self.header.dimension
    }
}
