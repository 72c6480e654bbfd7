//! Whether the cells inside are those of the repeating set, whatever made them.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::machine::memory;
use crate::periodic::inside::Inside;
use crate::periodic::lattice::Lattice;
use crate::periodic::needed::Needed;

impl<G: Moving> Inside<G> {
    /// Whether the cells at vertices at home are those of the repeating set: no image is missing by the balls of all cells, or
    /// those that are change no cell at home when they come, in a copy. What is inside must be a Delaunay triangulation of
    /// vertices at home and their images.
    ///
    /// Cost: a pass over the cells; a copy and insertions where images are missing by the balls.
    pub(super) fn is_complete(&self, lattice: &Lattice<G>) -> Result<bool> {
        let needed = Needed::of_all(self, lattice)?;
        if needed.images.is_empty() {
            return Ok(true);
        }
        let mut copy = self.copied(None)?;
        copy.complete(lattice, needed, Needed::of_all, |t| t.commit_timestamp().map(drop))?;
        Ok(self.rows_at_home()? == copy.rows_at_home()?)
    }

    /// The corners of the cells at home, each row ascending, and the rows as well.
    fn rows_at_home(&self) -> Result<Vec<G::Vertices>> {
        let mut rows = Vec::new();
        for row in self.t.cells()?.corners {
            if row.as_ref().iter().any(|v| self.images.is_home(*v)) {
                let mut sorted = *row;
                sorted.as_mut().sort_unstable();
                memory::push(&mut rows, sorted)?;
            }
        }
        rows.sort_unstable_by(|one, other| one.as_ref().cmp(other.as_ref()));
        Ok(rows)
    }
}
