//! Peeling: flat cells at the hull are taken away, to uncover those among them that are not positive.
//!
//! Where the vertices on a side of the hull are in a plane but for rounding, that side has flat cells, several one
//! above the other. When rounding differs, some of them are turned inside out, and cannot be exchanged one by one.
//! Without all of them, the side is dented, and dents can be [filled](super::untangle).
//!
//! To take a cell away is to exchange it, with the ghost cells on it, for ghosts. The complex stays a closed one: a
//! vertex within, or an edge, comes to the hull only if it was not there. A cell is taken away through a facet that is
//! not flat itself: flat facets at the rim of a side lead below what covers the rest of it.

use super::untangling::Untangling;
use super::{Delaunay, Geometry};
use crate::complex::{Corners, Facet};
use crate::delaunay::around::list_star;
use crate::error::Result;
use crate::ids::Slot;
use crate::machine::memory;
use crate::predicates::squared_distance;

/// A cell is flat if its volume is less than this share of that of a box with its edges, and a facet if the square of
/// its area is that small, next to a square. Between what rounding makes and what any mesh has; nothing else depends on
/// it.
const FLAT: f64 = 1e-9;

/// Flat cells that are taken away at most for each one that has to be. On sheared lattices they are about as many. On a
/// hull that is rough there are more, and filling large dents there gets stuck.
const TAKEN_PER_INVERTED: usize = 64;

/// Cells of a star that are looked at in the time of a certificate.
const SEEN_PER_CERTIFICATE: usize = 8;

impl<G: Geometry> Delaunay<G> {
    /// Takes flat cells at the hull away until all that are left of those listed are positive; whether that could be
    /// done.
    pub(super) fn peel(&mut self, untangling: &mut Untangling<G>) -> Result<bool> {
        let gathered = self.gather_flat(untangling);
        untangling.cells.iter().for_each(|&c| self.complex.set_mark(c, 0));
        if !gathered? {
            return Ok(false);
        }
        loop {
            let before = untangling.flips.n_flips;
            let (mut n_left, mut are_positive) = (0, true);
            for k in 0..untangling.cells.len() {
                if untangling.is_exhausted() {
                    return Ok(false);
                }
                let c = untangling.cells[k];
                if !self.is_finite(c) || self.take_away(c, untangling)? {
                    continue;
                }
                are_positive &= self.is_positive(c);
                untangling.cells[n_left] = c;
                n_left += 1;
            }
            untangling.cells.truncate(n_left);
            if are_positive {
                return Ok(true);
            }
            if untangling.flips.n_flips == before || untangling.is_exhausted() {
                return Ok(false);
            }
        }
    }

    /// Lists flat cells around those listed, the nearest ones if there are many, and marks all; whether there was time.
    fn gather_flat(&mut self, untangling: &mut Untangling<G>) -> Result<bool> {
        untangling.cells.iter().for_each(|&c| self.complex.set_mark(c, 1));
        let most = TAKEN_PER_INVERTED * untangling.cells.len();
        let mut k = 0;
        while k < untangling.cells.len() {
            let cell = *self.complex.cell(untangling.cells[k]);
            k += 1;
            for next in (0..G::Corners::N).map(|i| cell.neighbour(i).cell()) {
                if self.complex.mark(next) == 1 || self.is_ghost(next) {
                    continue;
                }
                untangling.flips.certificates += 1;
                if untangling.is_exhausted() {
                    return Ok(false);
                }
                if self.is_flat(next) {
                    if untangling.cells.len() == most {
                        return Ok(true);
                    }
                    memory::push(&mut untangling.cells, next)?;
                    self.complex.set_mark(next, 1);
                }
            }
        }
        Ok(true)
    }

    /// Takes a finite cell away, if it is at the hull and nothing is in the way; whether that has been done.
    fn take_away(&mut self, c: Slot, untangling: &mut Untangling<G>) -> Result<bool> {
        let cell = self.complex.cell(c);
        let mut outer =
            (0..G::Corners::N).filter(|&i| self.complex.cell(cell.neighbour(i).cell()).is_ghost());
        let (Some(i), second, None) = (outer.next(), outer.next(), outer.next()) else { return Ok(false) };
        let are_flat = [Some(i), second].iter().flatten().all(|&i| self.is_facet_flat(Facet::new(c, i)));
        // In the plane a triangle with two edges at the hull has a vertex that is in no other.
        if are_flat || second.is_some() && G::D == 2 {
            return Ok(false);
        }
        let is_in_the_way = match second {
            None => {
                let apex = cell.corners[i];
                let around = memory::made(&mut self.around)?;
                around.clear();
                list_star(&self.complex, c, apex, around, |_| {})?;
                let star = around.as_slice();
                untangling.flips.certificates += (star.len() / SEEN_PER_CERTIFICATE) as u64;
                star.iter().any(|&c| self.complex.cell(c).is_ghost())
            }
            Some(j) => self.is_at_hull(c, [i, j]),
        };
        Ok(!is_in_the_way && self.exchange_across(Facet::new(c, i), None, untangling)?)
    }

    /// Whether the edge between two corners of a cell in space is at the hull.
    fn is_at_hull(&self, c: Slot, ends: [usize; 2]) -> bool {
        let cell = self.complex.cell(c);
        let mut others = (0..G::Corners::N).filter(|i| !ends.contains(i));
        let (first, second) = (others.next().expect("one of four"), others.next().expect("another"));
        // Around the edge: each cell is left opposite the corner by which the one before was entered.
        let (mut facet, mut left_behind) = (Facet::new(c, first), cell.corners[second]);
        loop {
            let to = self.complex.cell(facet.cell()).neighbour(facet.index());
            if to.cell() == c {
                return false;
            }
            let next = self.complex.cell(to.cell());
            if next.is_ghost() {
                return true;
            }
            facet = Facet::new(to.cell(), next.index_of(left_behind));
            left_behind = next.corners[to.index()];
        }
    }

    /// Whether a finite cell is flat, or may be.
    pub(super) fn is_flat(&self, c: Slot) -> bool {
        let corners = &self.complex.cell(c).corners;
        let first = self.place(corners[0]);
        let edges = (1..G::Corners::N).map(|i| squared_distance(first, self.place(corners[i])).sqrt());
        G::orientation(&self.filter, self.view(), corners).abs() <= FLAT * edges.product::<f64>()
    }

    /// Whether a facet of a cell is flat; never in the plane.
    fn is_facet_flat(&self, facet: Facet) -> bool {
        let corners = &self.complex.cell(facet.cell()).corners;
        let place = |k: usize| self.place(corners[(facet.index() + k) % G::Corners::N]);
        if G::D == 2 {
            return false;
        }
        let [a, b, c] = [(1, 2), (2, 3), (3, 1)].map(|(i, j)| squared_distance(place(i), place(j)));
        let longest = a.max(b).max(c);
        // Heron: sixteen times the square of the area.
        2.0 * (a * b + b * c + c * a) - (a * a + b * b + c * c) <= FLAT * longest * longest
    }
}
