//! What has been exchanged to untangle cells.

use crate::complex::Facet;
use crate::delaunay::Geometry;
use crate::delaunay::flips::Flips;
use crate::ids::Slot;
use crate::machine::memory;

/// What has been exchanged, and scratch memory.
#[derive(Debug)]
pub(super) struct Untangling<G: Geometry> {
    /// The exchanges made. Their suspects are facets of new cells.
    pub(super) flips: Flips<G>,
    /// Cells that are not positive, and then flat ones around them.
    pub(super) cells: Vec<Slot>,
    /// Ridges at which the hull may not be convex, as facets of ghosts.
    pub(super) ridges: Vec<Facet>,
    /// Ridges where ghosts cannot be exchanged at present.
    pub(super) stuck: Vec<Facet>,
    pub(super) slots: Vec<Slot>,
}

impl<G: Geometry> Default for Untangling<G> {
    fn default() -> Self {
        Untangling {
            flips: Flips::default(),
            cells: Vec::new(),
            ridges: Vec::new(),
            stuck: Vec::new(),
            slots: Vec::new(),
        }
    }
}

impl<G: Geometry> Untangling<G> {
    pub(super) fn memory_bytes(&self) -> usize {
        self.flips.memory_bytes()
            + memory::bytes_of(&self.cells)
            + memory::bytes_of(&self.ridges)
            + memory::bytes_of(&self.stuck)
            + memory::bytes_of(&self.slots)
    }

    pub(super) fn is_exhausted(&self) -> bool {
        self.flips.certificates > self.flips.most
    }
}
