//! What checks of certificates have found.

use crate::complex::Facet;
use crate::error::Result;
use crate::ids::Slot;
use crate::machine::memory;

/// What does not hold.
#[derive(Debug, Default)]
pub struct Failures {
    /// Finite cells that are not positively oriented.
    pub cells: Vec<Slot>,
    /// Facets between finite cells that fail the empty-sphere test, those of cells that are not positively oriented
    /// left out: they are to be tested once these are.
    pub facets: Vec<Facet>,
    /// Ridges of the hull that are not convex, as facets of ghost cells.
    pub ridges: Vec<Facet>,
    /// Ghost cells whose ridges have not been looked at.
    pub open_ghosts: Vec<Slot>,
    /// All ghost cells, after a sweep.
    pub ghosts: Vec<Slot>,
    /// Whether a sweep has to find out what has failed.
    pub is_sweep_due: bool,
    /// Whether, even if the hull is convex at every ridge, it may wind more than once: some may not have been convex
    /// all the way.
    pub may_wind_twice: bool,
}

impl Failures {
    /// Bytes held.
    pub fn memory_bytes(&self) -> usize {
        let lists = [&self.cells, &self.open_ghosts, &self.ghosts].map(memory::bytes_of);
        let facets = [&self.facets, &self.ridges].map(memory::bytes_of);
        lists.iter().chain(&facets).sum()
    }

    /// Forgets everything; keeps the memory.
    pub fn clear(&mut self) {
        self.cells.clear();
        self.facets.clear();
        self.ridges.clear();
        self.open_ghosts.clear();
        self.ghosts.clear();
        self.is_sweep_due = false;
        self.may_wind_twice = false;
    }

    /// Whether nothing has failed.
    pub fn are_none(&self) -> bool {
        self.is_triangulation() && self.facets.is_empty() && !self.is_sweep_due
    }

    /// Whether all cells are positive and the hull is convex and winds once.
    pub fn is_triangulation(&self) -> bool {
        self.cells.is_empty() && self.ridges.is_empty() && !self.may_wind_twice
    }

    /// Adds those of a later range.
    pub(super) fn append(&mut self, later: &Failures) -> Result<()> {
        memory::append(&mut self.cells, &later.cells)?;
        memory::append(&mut self.facets, &later.facets)?;
        memory::append(&mut self.ridges, &later.ridges)?;
        memory::append(&mut self.ghosts, &later.ghosts)
    }
}
