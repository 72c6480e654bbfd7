//! Point location in a triangulation of the plane that is not Delaunay, where a visibility walk may go round for ever: the
//! straight way from a corner of a cell to the place.
//!
//! Cost: the cells on the way, and those around the corner and around sites that the way passes.

use super::around::{list_ring, next_of_three, previous_of_three};
use super::{Delaunay, Geometry};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::predicates::StaticFilter;

/// What is next on a straight way from a site.
#[derive(Clone, Copy, Debug)]
enum Next {
    /// The place is in this cell, or beyond the facet of this ghost cell.
    Here(Slot),
    /// The way passes this site.
    Site(SiteId),
    /// The way leaves this cell opposite this corner, between the site on its right and that on its left.
    Through(Slot, usize, [SiteId; 2]),
}

impl<G: Geometry> Delaunay<G> {
    /// The cell that holds `q`, for which `f` must hold, or a ghost cell beyond whose facet it is; on a straight way from
    /// a corner of `start`.
    #[cold]
    pub(super) fn walk_straight(&self, f: &StaticFilter, q: &G::Point, start: Slot) -> Slot {
        let cell = self.complex.cell(start);
        let mut from = cell.corners[0];
        'sites: loop {
            let (mut cell, mut corner, [mut a, mut b]) = match self.next_from(f, from, q) {
                Next::Here(slot) => return slot,
                Next::Site(s) => {
                    from = s;
                    continue;
                }
                Next::Through(cell, corner, edge) => (cell, corner, edge),
            };
            loop {
                let across = self.complex.cell(cell).neighbour(corner);
                (cell, corner) = (across.cell(), across.index());
                let c = self.complex.cell(cell);
                if c.is_ghost() {
                    return cell;
                }
                let apex = c.corners[corner];
                let turn = self.turn_to(f, from, q, apex);
                if turn == 0.0 && !self.is_short_of(from, q, apex) {
                    from = apex;
                    continue 'sites;
                }
                // The edge that the way would leave through is opposite the corner on the apex's side.
                let gone = if turn > 0.0 { b } else { a };
                corner = c.index_of(gone);
                if G::orientation_with(f, self.view(), &c.corners, corner, q) >= 0.0 {
                    return cell;
                }
                if turn > 0.0 { b = apex } else { a = apex }
            }
        }
    }

    /// The orientation of a site, `q` and another site.
    fn turn_to(&self, f: &StaticFilter, from: SiteId, q: &G::Point, s: SiteId) -> f64 {
        G::orient(f, &[self.place(from), q, self.place(s)])
    }

    /// Whether `q`, which is on a line with both sites, is nearer to the first than the second is, or on its other side.
    fn is_short_of(&self, from: SiteId, q: &G::Point, s: SiteId) -> bool {
        let (u, p) = (self.place(from), self.place(s));
        let axis = if u[0] == p[0] { 1 } else { 0 };
        if u[axis] < p[axis] { q[axis] < p[axis] } else { q[axis] > p[axis] }
    }

    /// What is next on the straight way from a site to a place elsewhere.
    fn next_from(&self, f: &StaticFilter, from: SiteId, q: &G::Point) -> Next {
        let mut next = None;
        let listed: Result<()> = list_ring(&self.complex, self.site(from).cell, from, |slot, i| {
            let cell = self.complex.cell(slot);
            if cell.is_ghost() {
                if next.is_none() && self.orientation_beyond(f, slot, q) > 0.0 {
                    next = Some(Next::Here(slot));
                }
                return Ok(());
            }
            let [a, b] = [next_of_three(i), previous_of_three(i)].map(|k| cell.corners[k]);
            let [to_a, to_b] = [a, b].map(|s| self.turn_to(f, from, q, s));
            // The angle at the site is less than two right ones: what is behind the site is on the wrong side of one.
            if to_a > 0.0 || to_b < 0.0 {
                return Ok(());
            }
            next = Some(if G::orientation_with(f, self.view(), &cell.corners, i, q) >= 0.0 {
                Next::Here(slot)
            } else if to_a == 0.0 {
                Next::Site(a)
            } else if to_b == 0.0 {
                Next::Site(b)
            } else {
                Next::Through(slot, i, [a, b])
            });
            Ok(())
        });
        debug_assert!(listed.is_ok());
        next.expect("every direction is that of a cell around the site")
    }
}
