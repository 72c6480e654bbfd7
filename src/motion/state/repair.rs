//! Memory of repairs.

use crate::complex::Facet;
use crate::delaunay::Failures;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::state::places::Places;

/// Scratch memory of repairs.
#[derive(Debug, Default)]
pub(in crate::motion) struct Repair {
    pub(in crate::motion) failures: Failures,
    /// Cells that may have failed, each once.
    pub(in crate::motion) touched: Vec<Slot>,
    pub(in crate::motion) suspects: Vec<Facet>,
    pub(in crate::motion) stuck: Vec<Facet>,
    pub(in crate::motion) places: Places,
    /// Exact evaluations of the sweep.
    pub(in crate::motion) exact: u64,
    /// Failures for each finite cell with which to rebuild, where that is known better than by what random points do.
    pub(in crate::motion) limit: Option<f64>,
    /// Failures for each finite cell that were found.
    pub(in crate::motion) share_failing: f64,
    /// Whether all has been rebuilt, and nothing done before but to look at certificates.
    pub(in crate::motion) was_foreseen: bool,
    /// Sites to be taken back.
    pub(in crate::motion) sites: Vec<SiteId>,
}

impl Repair {
    /// A check begins: nothing has failed, and no cell is touched.
    pub(in crate::motion) fn begin_check(&mut self) -> (&mut Failures, &mut Vec<Slot>) {
        self.failures.clear();
        self.touched.clear();
        (&mut self.failures, &mut self.touched)
    }

    /// Whether the check has found no failure.
    pub(in crate::motion) fn is_unneeded(&self) -> bool {
        self.failures.are_none()
    }

    /// Cells that may have failed, each once.
    pub(in crate::motion) fn touched(&self) -> &[Slot] {
        &self.touched
    }

    /// Vertices that have been taken back, to be placed, in the order in which to do so.
    pub(in crate::motion) fn queue(&self) -> &[VertexId] {
        &self.places.queue
    }

    /// From now on, rebuilds where more failures for each finite cell are found.
    pub(in crate::motion) fn set_limit(&mut self, limit: Option<f64>) {
        self.limit = limit;
    }

    /// Failures for each finite cell that the last repair has found.
    pub(in crate::motion) fn share_failing(&self) -> f64 {
        self.share_failing
    }

    /// Exact evaluations of the last sweep.
    pub(in crate::motion) fn exact_of_sweep(&self) -> u64 {
        self.exact
    }

    /// Whether the last repair has rebuilt all, and done nothing before but to look at certificates.
    pub(in crate::motion) fn was_foreseen(&self) -> bool {
        self.was_foreseen
    }

    /// Whether the hull was not convex when the repair was given up. Flat sides that bend are dented all over once, and
    /// that says nothing of facets that fail.
    pub(in crate::motion) fn is_dented(&self) -> bool {
        !self.failures.ridges.is_empty()
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        self.failures.memory_bytes()
            + memory::bytes_of(&self.touched)
            + memory::bytes_of(&self.suspects)
            + memory::bytes_of(&self.stuck)
            + self.places.memory_bytes()
            + memory::bytes_of(&self.sites)
    }
}
