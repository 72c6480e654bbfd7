//! Checks of all that has to hold.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{Level, NO_CELL, Violation};
use crate::periodic::inside::Inside;
use crate::periodic::lattice::{HOME, Lattice};
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// Looks for what is wrong: in the triangulation inside, which is checked as one of the plane or of space, at images that are
    /// not where the vectors take their vertices, and at [`Level::Delaunay`] at cells that are not those of the set that repeats, or
    /// not in all places. `None` if nothing is wrong.
    ///
    /// Cost: a pass over the cells and images; at [`Level::Delaunay`] that of the last check of
    /// [`load`](Self::load).
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory), and others of a creation.
    pub fn violation(&self, level: Level) -> Result<Option<Violation>> {
        if let Err(violation) = self.inside.t.validate(level) {
            return Ok(Some(violation));
        }
        let of = |message| Some(Violation { level: Level::Structure, message });
        if let Some(inner) = self.inside.misplaced(&self.lattice)? {
            let vertex = self.inside.images.of(inner).vertex;
            return Ok(of(memory::text(format_args!(
                "an image of vertex {vertex} is not where the vectors take it"
            ))));
        }
        if level != Level::Delaunay {
            return Ok(None);
        }
        if !self.inside.is_complete(&self.lattice)? {
            let message = memory::text(format_args!("images are missing"));
            return Ok(Some(Violation { level, message }));
        }
        Ok(self.incomplete_class()?.and_then(|cell| {
            of(memory::text(format_args!("cell {cell} is not there once for each of its corners at home")))
        }))
    }

    /// The first class of cells that is not there once for each shift that takes a corner of it home.
    fn incomplete_class(&self) -> Result<Option<usize>> {
        let cells = self.read_cells()?;
        let mut counts = Vec::new();
        memory::lengthen(&mut counts, cells.corners.len(), 0usize)?;
        cells.class_of.iter().filter(|&&class| class != NO_CELL).for_each(|&class| counts[class] += 1);
        let n = G::D + 1;
        Ok(counts.iter().enumerate().position(|(cell, &count)| {
            let shifts = cells.shifts.of(cell);
            count != (0..n).filter(|&i| !shifts[..i].contains(&shifts[i])).count()
        }))
    }
}

impl<G: Moving> Inside<G> {
    /// An image that is not a translation of its vertex at home, or has not its key.
    fn misplaced(&self, lattice: &Lattice<G>) -> Result<Option<VertexId>> {
        for (inner, image) in VertexId::range(0..self.images.len()).zip(self.images.as_slice()) {
            if !self.images.is_there(image) {
                if self.t.is_present(inner) {
                    return Ok(Some(inner));
                }
                continue;
            }
            let home = self.images.home(image.vertex);
            let is_there =
                lattice.translated(&self.t.position(home)?, image.shift) == self.t.position(inner)?;
            let is_home =
                (image.shift == HOME) == (home == inner) && self.images.is_home(inner) == (home == inner);
            if !is_home || !is_there || self.t.key_of_id(inner) != u64::from(image.vertex.get()) {
                return Ok(Some(inner));
            }
        }
        Ok(None)
    }
}
