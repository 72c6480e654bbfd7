//! One exchange: of two or three cells for those that fill the same space in the other way.
//!
//! An exchange is a flip that is not made for the sake of the empty sphere, and may have ghost cells on either side.

use super::key;
use super::untangling::Untangling;
use crate::complex::{Corners, Facet, INFINITE, NewCell};
use crate::delaunay::{Delaunay, Geometry};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;

/// The most cells on either side of an exchange, and facets around it.
const MOST_CELLS: usize = 3;
const MOST_OUTER: usize = 6;

/// Cells, and those that are to take their place.
struct Exchange<C: Corners> {
    old: [Slot; MOST_CELLS],
    n_old: usize,
    new: [NewCell<C>; MOST_CELLS],
    n_new: usize,
}

impl<C: Corners> Exchange<C> {
    fn of(cells: [Slot; 2]) -> Self {
        let none =
            NewCell { corners: C::filled(SiteId::NONE), neighbours: C::Of::filled(Facet::NONE), inner: 0 };
        Exchange { old: [cells[0], cells[1], Slot::NONE], n_old: 2, new: [none; MOST_CELLS], n_new: 0 }
    }

    fn old(&self) -> &[Slot] {
        &self.old[..self.n_old]
    }

    /// Glues the new cells to each other, and to these facets, by the sites of each; whether they fill what is within.
    fn glue(&mut self, outer: &[([SiteId; 3], Facet)]) -> bool {
        let new = &mut self.new[..self.n_new];
        let mut n_glued = 0;
        for a in 0..new.len() {
            for i in 0..C::N {
                let sites = key(&new[a].corners, i);
                if let Some(&(_, to)) = outer.iter().find(|(outer, _)| *outer == sites) {
                    new[a].neighbours[i] = to;
                    n_glued += 1;
                    continue;
                }
                let others = (0..new.len()).filter(|&b| b != a);
                let mut facets = others.flat_map(|b| (0..C::N).map(move |j| (b, j)));
                let Some((b, j)) = facets.find(|&(b, j)| key(&new[b].corners, j) == sites) else {
                    return false;
                };
                new[a].neighbours[i] = Facet::new(Slot::at(b), j);
                new[a].inner |= 1 << i;
            }
        }
        n_glued == outer.len()
    }
}

/// A cell with its corners so ordered that the ghost vertex, if it has that, is last.
fn with_ghost_last<C: Corners>(corners: C) -> C {
    let ghost = (0..C::N).find(|&i| corners[i] == INFINITE);
    ghost.map_or(corners, |i| corners.rotated_to_last(i))
}

impl<G: Geometry> Delaunay<G> {
    /// Exchanges the cells at a facet, or those at an edge of it if these are three; given a point within all, only if
    /// the new cells are positive. Whether that has been done.
    pub(super) fn exchange_across(
        &mut self,
        facet: Facet,
        inner: Option<&G::Point>,
        untangling: &mut Untangling<G>,
    ) -> Result<bool> {
        let Some(mut exchange) = self.find_exchange(facet, inner, &mut untangling.flips.certificates) else {
            return Ok(false);
        };
        let mut outer = [([SiteId::NONE; 3], Facet::NONE); MOST_OUTER];
        let mut n_outer = 0;
        for &c in exchange.old() {
            let cell = self.complex.cell(c);
            for i in (0..G::Corners::N).filter(|&i| !exchange.old().contains(&cell.neighbour(i).cell())) {
                // More if the third cell is not at the second one.
                let Some(facet) = outer.get_mut(n_outer) else { return Ok(false) };
                *facet = (key(&cell.corners, i), cell.neighbour(i));
                n_outer += 1;
            }
        }
        if !exchange.glue(&outer[..n_outer]) {
            return Ok(false);
        }
        let Untangling { flips, slots, .. } = untangling;
        let (old, new) = (exchange.old(), &exchange.new[..exchange.n_new]);
        slots.clear();
        memory::append(slots, old)?;
        memory::reserve(&mut flips.suspects, new.len() * G::Corners::N)?;
        memory::reserve(&mut flips.changed, new.len())?;
        self.complex.prepare_replacing(new.len(), slots, &mut flips.journal)?;
        self.complex.replace(old.len(), new, slots, &mut flips.journal);
        for &slot in &slots[..new.len()] {
            flips.changed.push(slot);
            flips.suspects.extend((0..G::Corners::N).map(|i| Facet::new(slot, i)));
        }
        flips.n_flips += 1;
        Ok(true)
    }

    /// The cells that [`exchange_across`](Self::exchange_across) exchanges, and the new ones, not glued yet. `None`
    /// also where a site would be left without a cell.
    fn find_exchange(
        &self,
        facet: Facet,
        inner: Option<&G::Point>,
        certificates: &mut u64,
    ) -> Option<Exchange<G::Corners>> {
        let cell = self.complex.cell(facet.cell());
        let across = cell.neighbour(facet.index());
        let apex = self.complex.apex(across);
        let mut exchange = Exchange::of([facet.cell(), across.cell()]);
        let mut third = None;
        for i in (0..G::Corners::N).filter(|&i| i != facet.index()) {
            if self.complex.apex(cell.neighbour(i)) == apex {
                if third.is_some() || G::D == 2 {
                    return None;
                }
                third = Some(i);
                exchange.old[2] = cell.neighbour(i).cell();
                exchange.n_old = 3;
            }
        }
        for i in (0..G::Corners::N).filter(|&i| i != facet.index() && Some(i) != third) {
            let corners = with_ghost_last(cell.corners.with(i, apex));
            *certificates += 1;
            if inner.is_some_and(|inner| !self.would_be_positive(&corners, inner)) {
                return None;
            }
            exchange.new[exchange.n_new].corners = corners;
            exchange.n_new += 1;
        }
        Some(exchange)
    }

    /// Whether a cell that is not there yet is positive; a ghost, if this point is on the inner side.
    fn would_be_positive(&self, corners: &G::Corners, inner: &G::Point) -> bool {
        if corners[Self::LAST] == INFINITE {
            G::orientation_with(&self.filter, self.view(), corners, Self::LAST, inner) < 0.0
        } else {
            G::orientation(&self.filter, self.view(), corners) > 0.0
        }
    }
}
