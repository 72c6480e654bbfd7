//! The hole that a star would leave: its frontier, and the cells that are to fill it.

use super::{Delaunay, Geometry, Shape};
use crate::complex::{Corners, Facet, MAX_CELLS};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;

/// Link sites that the bit masks of facets can tell apart, the ghost vertex included.
pub(super) const MAX_LINK: usize = 64;

/// Slots from here on stand for the cells of `made`, which are not in the complex yet.
pub(super) const NEW: usize = MAX_CELLS;

/// Which one of `made` a facet is of, if it is of one.
#[inline(always)]
pub(super) fn new_of(facet: Facet) -> Option<usize> {
    facet.cell().index().checked_sub(NEW)
}

/// A facet of the frontier: its corners, with a hole at `at` for the corner of the cell on the inner side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap<C> {
    pub(super) corners: C,
    pub(super) at: usize,
    /// The facet seen from the cell that exists.
    pub(super) out: Facet,
}

/// The facets of a cell, seen from its neighbours.
pub(super) type FacetsOf<G> = <<G as Shape>::Corners as Corners>::Of<Facet>;

/// Scratch memory of removals.
#[derive(Debug)]
pub(super) struct Hole<G: Geometry> {
    /// The frontier at first: the link, seen from outside.
    pub(super) link: Vec<Gap<G::Corners>>,
    /// Sites of the link, the ghost vertex included.
    pub(super) sites: Vec<SiteId>,
    pub(super) open: Vec<(u64, Gap<G::Corners>)>,
    pub(super) open_ghost: Vec<(u64, Facet)>,
    /// New cells, and the gluing of their facets: a facet whose slot counts from `NEW` is that of one of them.
    pub(super) made: Vec<(G::Corners, FacetsOf<G>)>,
    pub(super) made_at: Vec<Slot>,
}

impl<G: Geometry> Default for Hole<G> {
    fn default() -> Self {
        Hole {
            link: Vec::new(),
            sites: Vec::new(),
            open: Vec::new(),
            open_ghost: Vec::new(),
            made: Vec::new(),
            made_at: Vec::new(),
        }
    }
}

impl<G: Geometry> Hole<G> {
    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.link)
            + memory::bytes_of(&self.sites)
            + memory::bytes_of(&self.open)
            + memory::bytes_of(&self.open_ghost)
            + memory::bytes_of(&self.made)
            + memory::bytes_of(&self.made_at)
    }
}

impl<G: Geometry> Delaunay<G> {
    /// Lists the link of the gathered star and its sites. Each gets its position in the list as a label, kept in its
    /// `cell` field.
    pub(super) fn label_link(&mut self, hole: &mut Hole<G>) -> Result<()> {
        hole.link.clear();
        memory::reserve(&mut hole.link, self.star.len())?;
        hole.link.extend(self.star.iter().map(|&(c, at)| {
            let (cell, at) = (self.complex.cell(c), usize::from(at));
            Gap { corners: cell.corners, at, out: cell.neighbour(at) }
        }));
        hole.sites.clear();
        // The link is a sphere: in the plane it has as many sites as facets, in space two more than half as many.
        memory::reserve(&mut hole.sites, hole.link.len())?;
        for gap in &hole.link {
            for i in (0..G::Corners::N).filter(|&i| i != gap.at) {
                let site = self.corner_mut(gap.corners[i]);
                let l = site.cell.index();
                if l >= hole.sites.len() || hole.sites[l] != gap.corners[i] {
                    site.cell = Slot::at(hole.sites.len());
                    hole.sites.push(gap.corners[i]);
                }
            }
        }
        Ok(())
    }

    /// Gives the link's sites, whose `cell` fields hold labels, a cell of the star again.
    pub(super) fn restore_link_cells(&mut self) {
        for &(c, at) in &self.star {
            let corners = self.complex.cell(c).corners;
            for i in (0..G::Corners::N).filter(|&i| i != at as usize) {
                self.sites[corners[i]].cell = c;
            }
        }
    }
}
