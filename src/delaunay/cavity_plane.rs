//! Conflict zones in the plane.
//!
//! The rim is a cycle of edges around the site. Each new triangle starts at one site of it and ends at the next: its
//! neighbour is the triangle that starts where it ends, found through the sites' `cell` fields, which the insertion
//! overwrites anyway.

use super::cavity::{Cavity, IN_ZONE, Rim};
use super::{Delaunay, Plane};
use crate::complex::Facet;

/// Finds the zone of `q` from one cell of it, and its rim.
#[inline(always)]
pub(super) fn dig(t: &mut Delaunay<Plane>, cavity: &mut Cavity<Plane>, start: u32, s: u32, q: &[f64; 2], id: u32) {
    let Cavity { zone, rim, .. } = cavity;
    zone.clear();
    rim.clear();
    zone.push(start);
    t.complex.set_mark(start, IN_ZONE);
    let mut next = 0;
    while next < zone.len() {
        let cell = *t.complex.cell(zone[next]);
        next += 1;
        for i in 0..3 {
            let out = cell.neighbour(i);
            if t.complex.mark(out.cell()) == IN_ZONE {
                continue;
            }
            if t.is_in_conflict(out.cell(), q, id) {
                t.complex.set_mark(out.cell(), IN_ZONE);
                zone.push(out.cell());
            } else {
                let mut corners = cell.corners;
                corners[i] = s;
                rim.push(Rim { corners, out, at: i as u32 });
            }
        }
    }
}

/// Makes the new triangles and glues them.
#[inline(always)]
pub(super) fn glue(t: &mut Delaunay<Plane>, cavity: &Cavity<Plane>) {
    let Cavity { rim, cells, .. } = cavity;
    for (facet, &cell) in rim.iter().zip(cells) {
        let at = facet.at as usize;
        t.complex.put(cell, facet.corners);
        t.complex.glue(Facet::new(cell, at), facet.out);
        t.sites[facet.corners[(at + 1) % 3] as usize].cell = Facet::new(cell, (at + 2) % 3).code();
    }
    for (facet, &cell) in rim.iter().zip(cells) {
        let at = facet.at as usize;
        let next = Facet::from_code(t.sites[facet.corners[(at + 2) % 3] as usize].cell);
        t.complex.glue(Facet::new(cell, (at + 1) % 3), next);
    }
    for (facet, &cell) in rim.iter().zip(cells) {
        t.sites[facet.corners[(facet.at as usize + 1) % 3] as usize].cell = cell;
    }
}
