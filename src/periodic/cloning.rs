//! A second triangulation like the first.

use std::sync::OnceLock;

use crate::delaunay::Moving;
use crate::error::Result;
use crate::machine::memory;
use crate::motion::Monitor;
use crate::periodic::inside::Inside;
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// An independent triangulation that is as this one: positions, ids, vectors, cells with their indices, what is staged, the
    /// timestamp, statistics, options, and what the algorithm keeps between commits. The callback of the options is
    /// `monitor`, as that of this one cannot be copied.
    ///
    /// Cost: a pass over what is kept; the copy reads its cells anew.
    ///
    /// ```
    /// use deldrift::{Plane, motion::Options, periodic::PeriodicTriangulation};
    ///
    /// let t = PeriodicTriangulation::<Plane>::new(&[[0.25, 0.25]], &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// let mut copy = t.try_clone(None)?;
    /// copy.stage_insertions(&[[0.5, 0.75]])?;
    /// copy.commit_timestamp()?;
    /// assert_eq!((t.cell_count()?, copy.cell_count()?), (2, 4));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory), [`Error::Prepared`](crate::Error::Prepared).
    pub fn try_clone(&self, monitor: Option<Monitor>) -> Result<Self> {
        self.reject_prepared()?;
        let coming = self.coming.as_ref().map(|lattice| memory::boxed(lattice.copied())).transpose()?;
        Ok(PeriodicTriangulation {
            lattice: memory::boxed(self.lattice.copied())?,
            inside: self.inside.copied(monitor)?,
            wraps: memory::copy_of(&self.wraps)?,
            staged: self.staged.copied()?,
            coming,
            statistics: self.statistics,
            cells: OnceLock::new(),
            edges: OnceLock::new(),
            former: None,
            taking: self.taking.as_ref().map(|taking| taking.renumbered(|v| v)).transpose()?,
        })
    }
}

impl<G: Moving> Inside<G> {
    /// A copy, without the room for goals.
    pub(super) fn copied(&self, monitor: Option<Monitor>) -> Result<Self> {
        Ok(Inside {
            t: self.t.duplicate(monitor)?,
            images: self.images.copied()?,
            places: memory::copy_of(&self.places)?,
            goals: Vec::new(),
            ..*self
        })
    }
}
