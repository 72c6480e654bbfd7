//! A cell, and a facet of one.

use std::fmt;

use super::{Corners, INFINITE};
use crate::ids::{SiteId, Slot};

/// A facet as seen from one of its two cells: the cell, and the index of the corner opposite the facet.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(transparent)]
pub struct Facet(u32);

impl Facet {
    /// No facet.
    pub const NONE: Self = Facet(u32::MAX);

    /// The facet of `cell` opposite corner `i`.
    #[inline(always)]
    pub const fn new(cell: Slot, i: usize) -> Self {
        Facet(cell.get() << 2 | i as u32)
    }

    /// One number for cell and index.
    #[inline(always)]
    pub fn code(self) -> u32 {
        self.0
    }

    /// The cell.
    #[inline(always)]
    pub fn cell(self) -> Slot {
        Slot::new(self.0 >> 2)
    }

    /// The index of the opposite corner.
    #[inline(always)]
    pub fn index(self) -> usize {
        (self.0 & 3) as usize
    }
}

impl fmt::Debug for Facet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.cell(), self.index())
    }
}

/// A cell: its corners and, opposite each, the facet by which it touches its neighbour.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Cell<C: Corners> {
    pub(super) alignment: [C::Alignment; 0],
    /// Sites at the corners.
    pub corners: C,
    /// The facets seen from the neighbours.
    pub(super) neighbours: C::Of<Facet>,
}

impl<C: Corners> Cell<C> {
    /// No cell.
    pub(super) fn free() -> Self {
        Cell {
            alignment: [],
            corners: C::filled(SiteId::NONE),
            neighbours: C::Of::<Facet>::filled(Facet::NONE),
        }
    }

    /// Whether it is no cell.
    #[inline(always)]
    pub(crate) fn is_free(&self) -> bool {
        self.corners[0] == SiteId::NONE
    }

    /// Whether the last corner is the ghost vertex.
    #[inline(always)]
    pub fn is_ghost(&self) -> bool {
        self.corners[C::N - 1] == INFINITE
    }

    /// The facet opposite corner `i`, seen from the neighbour.
    #[inline(always)]
    pub fn neighbour(&self, i: usize) -> Facet {
        self.neighbours[i]
    }

    /// Index of a corner that the cell is known to have.
    #[inline(always)]
    pub fn index_of(&self, site: SiteId) -> usize {
        let mut at = 0;
        for i in 1..C::N {
            if self.corners[i] == site {
                at = i;
            }
        }
        debug_assert_eq!(self.corners[at], site);
        at
    }
}
