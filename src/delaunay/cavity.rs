//! Insertion (Bowyer 10.1093/comjnl/24.2.162, Watson 10.1093/comjnl/24.2.167): *dig* the zone of cells in conflict
//! with the new site, then *fill* it with the cells that join its rim to the site.
//!
//! The conflict zone is connected and star-shaped as seen from the site, because signs are exact and ties are
//! broken consistently. A rim facet keeps the corners of the dead cell it comes from, with the site in place of the
//! corner that goes, so that the new cell is positively oriented without a test.
//!
//! To glue the new cells to each other, every ridge of the rim must find its second facet: see
//! [`cavity_plane`](super::cavity_plane) and [`cavity_space`](super::cavity_space), which fill the zone.
//!
//! Cost: in expectation 6 cells made and 4 deleted in the plane, about 27 and 20 in space, with one in-sphere test
//! for each deleted cell and each rim facet.

use super::{Delaunay, Dimension};
use crate::complex::{Facet, NONE};
use crate::error::Result;

/// What an insertion found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Insertion {
    /// The site is in the triangulation.
    New,
    /// This site was at the place already; nothing has changed.
    Coincident(u32),
}

/// A facet of the conflict zone's rim.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim<C> {
    /// Corners of the new cell.
    pub(super) corners: C,
    /// The facet seen from outside the zone.
    pub(super) out: Facet,
    /// Index of the new site in `corners`.
    pub(super) at: u32,
}

pub(super) const IN_ZONE: u8 = 1;

/// Scratch memory of insertions.
#[derive(Debug)]
pub struct Cavity<G: Dimension> {
    /// Cells in conflict: the first `n_zone` entries. The rest is room to write before it is known whether to keep it.
    pub(super) zone: Vec<u32>,
    pub(super) n_zone: usize,
    /// How many of them are ghosts.
    pub(super) n_ghosts: usize,
    /// Likewise, the rim's facets.
    pub(super) rim: Vec<Rim<G::Corners>>,
    pub(super) n_rim: usize,
    /// The cell that takes the place of each rim facet.
    pub(super) cells: Vec<u32>,
    pub(super) scratch: G::Scratch,
    /// Cells crossed by the walks so far.
    pub(super) steps: u64,
}

impl<G: Dimension> Default for Cavity<G> {
    fn default() -> Self {
        Cavity {
            zone: Vec::new(),
            n_zone: 0,
            n_ghosts: 0,
            rim: Vec::new(),
            n_rim: 0,
            cells: Vec::new(),
            scratch: G::Scratch::default(),
            steps: 0,
        }
    }
}

impl<G: Dimension> Delaunay<G> {
    /// Inserts a site that has been added; `near` is a cell to walk from, [`NONE`] for any. A coincident site is
    /// dropped; after an error the site is live and in no cell.
    pub fn insert_site(&mut self, s: u32, near: u32) -> Result<Insertion> {
        let q = self.site(s).point;
        self.cover(&q, &q);
        let inserted = if self.has_cells() {
            let inserted = self.insert_into_cells::<false>(s, if near == NONE { self.recent } else { near });
            if inserted == Ok(Insertion::New)
                && let Some(changed) = &mut self.changed
            {
                changed.extend_from_slice(&self.cavity.cells);
            }
            inserted
        } else {
            self.insert_flat(s)
        };
        if matches!(inserted, Ok(Insertion::Coincident(_))) {
            self.drop_site(s);
        }
        inserted
    }

    /// Inserts a site that has been added, walking from the cell `near`. There must be cells, and the filter must
    /// cover the site. `BUILD` if between [`begin_build`](Dimension::begin_build) and
    /// [`end_build`](Dimension::end_build).
    pub(super) fn insert_into_cells<const BUILD: bool>(&mut self, s: u32, near: u32) -> Result<Insertion> {
        let (q, id) = (self.site(s).point, self.site(s).id);
        let mut steps = 0;
        let start = self.walk(&self.filter, &q, near, &mut steps);
        self.cavity.steps += steps;
        if let Some(t) = self.corner_at(start, &q) {
            return Ok(Insertion::Coincident(t));
        }
        let mut cavity = std::mem::take(&mut self.cavity);
        G::dig::<BUILD>(self, &mut cavity, start, s, &q, id);
        let filled = self.fill::<BUILD>(s, &mut cavity);
        self.cavity = cavity;
        filled?;
        Ok(Insertion::New)
    }

    /// Replaces the zone by the cells that join its rim to the site.
    #[inline(always)]
    fn fill<const BUILD: bool>(&mut self, s: u32, cavity: &mut Cavity<G>) -> Result<()> {
        let (zone, n_rim) = (&cavity.zone[..cavity.n_zone], cavity.n_rim);
        if let Err(error) = self.complex.reserve(n_rim) {
            for &c in zone {
                self.complex.set_mark(c, 0);
            }
            return Err(error);
        }
        self.complex.retire_ghosts(cavity.n_ghosts);
        // The k-th rim facet gets the k-th cell of the zone, whose memory is at hand, then free ones.
        let reused = zone.len().min(n_rim);
        for &c in &zone[reused..] {
            self.complex.release(c);
        }
        cavity.cells.clear();
        cavity.cells.extend_from_slice(&zone[..reused]);
        for _ in reused..n_rim {
            cavity.cells.push(self.complex.create_blank());
        }
        G::glue::<BUILD>(self, cavity);
        self.recent = cavity.cells[0];
        self.sites[s as usize].cell = cavity.cells[0];
        Ok(())
    }
}
