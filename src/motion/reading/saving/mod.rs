//! Saving and loading: a triangulation as bytes, the same on every machine.
//!
//! docs/FORMAT.md describes the bytes. They hold what programs see: positions, which vertices are present and which
//! hidden, the cells with their indices, what is staged, the timestamp, and sums. What the algorithms keep, and what
//! of the changes has not been taken, is not saved.
//!
//! Loading triangulates nothing. It trusts nothing either: after the checksum, cells must fit together, and pass all
//! certificates of a Delaunay triangulation ([`Damage`](crate::Damage) has what may be wrong).

pub(in crate::motion) mod header;
mod loading;
pub(in crate::motion) mod reader;
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
        let header = Header::read(data, data.len() as u64)?;
        header::check_sum(data)?;
        Ok(Saved { header, data })
    }

    /// Bytes of the header.
    pub const HEADER: usize = header::SIZE;

    /// The size of all data by their header, or as much of it as there is, if that is right and there are as many
    /// bytes: so much is to be read.
    ///
    /// # Errors
    /// What is wrong with the header.
    pub fn size_by(header: &[u8], given: u64) -> Result<usize, Damage> {
        let header = Header::read(header, given)?;
        // The size is `given`, and that of bytes in memory.
        Ok(header.size().and_then(|size| usize::try_from(size).ok()).unwrap_or(usize::MAX))
    }

    /// The number of ids, if nothing is staged and there have been no segments.
    pub(crate) fn plain_ids(&self) -> Option<usize> {
        let Header { ids, moves, insertions, removals, segment_bytes, .. } = self.header;
        ([moves, insertions, removals, segment_bytes] == [0; 4]).then_some(ids)
    }

    /// Whether the vertices of the triangulation have weights.
    pub fn is_weighted(&self) -> bool {
        self.header.has_weights
    }

    /// The dimension of the triangulation, 2 or 3.
    pub fn dimension(&self) -> u32 {
        self.header.dimension
    }
}
