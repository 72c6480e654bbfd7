//! Islands: cavities around facets that fail and cannot be flipped, triangulated again.
//!
//! In space flips can be stuck short of the Delaunay triangulation, mostly where vertices are cospherical or in a
//! plane, or nearly so. Around a facet that is stuck, cells are gathered that have a vertex of each other in their
//! spheres; their boundary is filled from outside inwards: the cell on a facet is the one whose sphere is empty of the
//! vertices gathered on that side.
//!
//! Invariant: nothing changes unless the new cells are positive, each facet within is of two of them, and each on the
//! boundary of one. Then they cover the cavity once, whatever its form. As flips do, that lowers the lifted surface,
//! so there is an end; the facets of the new cells are suspects. Where the front does not close, the facet stays stuck.
//!
//! Cost: an in-sphere test for each pair of a facet and a vertex, some hundreds for an island. What it spares is to
//! take all flips back and a vertex with them, and to flip again.

use super::key;
use crate::complex::{Corners, Facet, NewCell};
use crate::delaunay::flips::Flips;
use crate::delaunay::site::Sites;
use crate::delaunay::{Delaunay, Geometry};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::predicates::StaticFilter;

/// Cells of the largest island. The cost grows with the square; among lattices and layers those met had 10 to 25, on
/// spheres, where nearly all are in conflict with each other, more than can be filled in the time of a rebuild.
const MOST_CELLS: usize = 32;

/// A facet, and a cell on the other side of it in which the corner opposite is to be replaced.
#[derive(Clone, Copy, Debug)]
struct Front<C: Corners> {
    /// The sites of the facet, in ascending order.
    key: [SiteId; 3],
    /// With the site beyond the facet at `index`, a positive cell.
    corners: C,
    index: usize,
    /// What the new cell is glued to: a facet outside, or of another new cell.
    to: Facet,
    is_inner: bool,
}

/// Scratch memory.
#[derive(Debug)]
pub(super) struct Island<C: Corners> {
    /// Slots of the cells that are replaced, and then of those that are new.
    slots: Vec<Slot>,
    sites: Vec<SiteId>,
    new: Vec<NewCell<C>>,
    open: Vec<Front<C>>,
    closed: Vec<[SiteId; 3]>,
    /// The stuck facets around which cells are triangulated again.
    facets: Vec<Facet>,
}

impl<C: Corners> Default for Island<C> {
    fn default() -> Self {
        Island {
            slots: Vec::new(),
            sites: Vec::new(),
            new: Vec::new(),
            open: Vec::new(),
            closed: Vec::new(),
            facets: Vec::new(),
        }
    }
}

impl<C: Corners> Island<C> {
    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.slots)
            + memory::bytes_of(&self.sites)
            + memory::bytes_of(&self.new)
            + memory::bytes_of(&self.open)
            + memory::bytes_of(&self.closed)
            + memory::bytes_of(&self.facets)
    }

    fn add_sites(&mut self, corners: &C) -> Result<()> {
        for &s in corners.as_ref() {
            if !self.sites.contains(&s) {
                memory::push(&mut self.sites, s)?;
            }
        }
        Ok(())
    }
}

/// The predicates, and how many in-sphere tests there have been.
struct Tests<'t, G: Geometry> {
    filter: &'t StaticFilter,
    sites: Sites<'t, G>,
    certificates: u64,
}

impl<G: Geometry> Tests<'_, G> {
    fn is_in_sphere(&mut self, corners: &G::Corners, s: SiteId) -> bool {
        self.certificates += 1;
        G::is_in_sphere(self.filter, self.sites, corners, self.sites.point(s), self.sites.id(s))
    }

    fn is_beyond(&self, front: &Front<G::Corners>, s: SiteId) -> bool {
        let q = self.sites.point(s);
        G::orientation_with(self.filter, self.sites, &front.corners, front.index, q) > 0.0
    }

    /// The site beyond a facet such that the sphere through all has no other of those beyond it inside.
    fn closest(&mut self, front: &Front<G::Corners>, sites: &[SiteId]) -> Option<SiteId> {
        let mut closest = None;
        for &s in sites.iter().filter(|s| !front.key.contains(s)) {
            let cell = closest.map(|closest| front.corners.with(front.index, closest));
            if self.is_beyond(front, s) && cell.is_none_or(|cell| self.is_in_sphere(&cell, s)) {
                closest = Some(s);
            }
        }
        closest
    }
}

impl<G: Geometry> Delaunay<G> {
    /// Triangulates around facets that are stuck; whether any have been. The facets of what is new are suspects.
    pub(super) fn fill_islands(
        &mut self,
        flips: &mut Flips<G>,
        island: &mut Island<G::Corners>,
    ) -> Result<bool> {
        let before = flips.n_flips;
        // In the time that it took to flip all, they could be taken back and flipped again.
        let last_certificate = 2 * flips.certificates;
        island.facets.clear();
        std::mem::swap(&mut island.facets, &mut flips.stuck);
        memory::reserve(&mut flips.stuck, island.facets.len())?;
        for k in 0..island.facets.len() {
            let facet = island.facets[k];
            // Flips, and islands before it, may have replaced its cell since it was listed.
            if self.complex.is_free(facet.cell()) {
                continue;
            }
            if flips.certificates > last_certificate {
                flips.stuck.push(facet);
                continue;
            }
            let mut tests =
                Tests { filter: &self.filter, sites: Sites::new(&self.sites, &self.keys), certificates: 0 };
            let is_filled = match self.gather_island(facet, &mut tests, island)? {
                Gathered::Nothing => continue,
                Gathered::TooMuch => false,
                Gathered::Cells => self.fill(&mut tests, island)?,
            };
            flips.certificates += tests.certificates;
            if is_filled {
                self.replace_island(flips, island)?;
            } else {
                flips.stuck.push(facet);
            }
        }
        Ok(flips.n_flips > before)
    }

    /// Gathers finite cells around a facet with a site of each other in their spheres, and their sites.
    fn gather_island(
        &self,
        facet: Facet,
        tests: &mut Tests<G>,
        island: &mut Island<G::Corners>,
    ) -> Result<Gathered> {
        let complex = &self.complex;
        let cell = complex.cell(facet.cell());
        let across = cell.neighbour(facet.index());
        let is_inside = !cell.is_ghost() && !complex.cell(across.cell()).is_ghost();
        if !is_inside || !tests.is_in_sphere(&cell.corners, complex.apex(across)) {
            return Ok(Gathered::Nothing);
        }
        island.slots.clear();
        island.sites.clear();
        for slot in [facet.cell(), across.cell()] {
            memory::push(&mut island.slots, slot)?;
            island.add_sites(&complex.cell(slot).corners)?;
        }
        // Sites that come later may be in the spheres of cells that had none before.
        let mut n_before = 0;
        while island.slots.len() > n_before {
            n_before = island.slots.len();
            let mut k = 0;
            while k < island.slots.len() {
                let cell = complex.cell(island.slots[k]);
                k += 1;
                for i in 0..G::Corners::N {
                    let slot = cell.neighbour(i).cell();
                    let next = complex.cell(slot);
                    if next.is_ghost() || island.slots.contains(&slot) {
                        continue;
                    }
                    let others = island.sites.iter().filter(|s| !next.corners.as_ref().contains(s));
                    if { others }.any(|&s| tests.is_in_sphere(&next.corners, s)) {
                        if island.slots.len() == MOST_CELLS {
                            return Ok(Gathered::TooMuch);
                        }
                        memory::push(&mut island.slots, slot)?;
                        island.add_sites(&next.corners)?;
                    }
                }
            }
        }
        Ok(Gathered::Cells)
    }

    /// Finds the new cells; whether they cover the cavity.
    fn fill(&self, tests: &mut Tests<G>, island: &mut Island<G::Corners>) -> Result<bool> {
        let Island { slots, sites, new, open, closed, .. } = island;
        new.clear();
        open.clear();
        closed.clear();
        for &slot in &*slots {
            let cell = self.complex.cell(slot);
            for i in 0..G::Corners::N {
                let to = cell.neighbour(i);
                if !slots.contains(&to.cell()) {
                    let key = key(&cell.corners, i);
                    let front = Front { key, corners: cell.corners, index: i, to, is_inner: false };
                    memory::push(open, front)?;
                }
            }
        }
        while let Some(front) = open.pop() {
            let Some(closest) = tests.closest(&front, sites) else { return Ok(false) };
            if new.len() == 2 * MOST_CELLS {
                return Ok(false);
            }
            let corners = front.corners.with(front.index, closest);
            let slot = Slot::at(new.len());
            let neighbours = <G::Corners as Corners>::Of::<Facet>::filled(Facet::NONE);
            memory::push(new, NewCell { corners, neighbours, inner: 0 })?;
            glue(new, Facet::new(slot, front.index), &front);
            memory::push(closed, front.key)?;
            for i in (0..G::Corners::N).filter(|&i| i != front.index) {
                let (key, to) = (key(&corners, i), Facet::new(slot, i));
                if let Some(at) = open.iter().position(|open| open.key == key) {
                    let other = open.swap_remove(at);
                    if !tests.is_beyond(&other, corners[i]) {
                        return Ok(false);
                    }
                    glue(new, to, &other);
                    memory::push(closed, key)?;
                } else if closed.contains(&key) {
                    return Ok(false);
                } else {
                    let corners = corners.reflected(i);
                    memory::push(open, Front { key, corners, index: i, to, is_inner: true })?;
                }
            }
        }
        Ok(sites.iter().all(|s| new.iter().any(|cell| cell.corners.as_ref().contains(s))))
    }

    fn replace_island(&mut self, flips: &mut Flips<G>, island: &mut Island<G::Corners>) -> Result<()> {
        let (n_old, n_new) = (island.slots.len(), island.new.len());
        memory::reserve(&mut flips.suspects, n_new * G::Corners::N)?;
        memory::reserve(&mut flips.changed, n_new)?;
        self.complex.prepare_replacing(n_new, &mut island.slots, &mut flips.journal)?;
        self.complex.replace(n_old, &island.new, &island.slots, &mut flips.journal);
        for &slot in &island.slots[..n_new] {
            flips.changed.push(slot);
            flips.suspects.extend((0..G::Corners::N).map(|i| Facet::new(slot, i)));
        }
        flips.n_flips += 1;
        Ok(())
    }
}

/// What there is around a facet.
enum Gathered {
    /// Nothing: the facet does not fail any more.
    Nothing,
    /// Too many cells.
    TooMuch,
    Cells,
}

/// Glues a facet of a new cell to what is on the other side.
fn glue<C: Corners>(new: &mut [NewCell<C>], facet: Facet, front: &Front<C>) {
    let cell = &mut new[facet.cell().index()];
    cell.neighbours[facet.index()] = front.to;
    if front.is_inner {
        cell.inner |= 1 << facet.index();
        let other = &mut new[front.to.cell().index()];
        other.neighbours[front.to.index()] = facet;
        other.inner |= 1 << front.to.index();
    }
}
