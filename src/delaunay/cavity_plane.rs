//! Conflict zones in the plane.
//!
//! The rim is a cycle of edges around the site. Each new triangle starts at one site of it and ends at the next: its
//! neighbour is the triangle that starts where it ends, found through the sites' `cell` fields, which the insertion
//! overwrites anyway.

use super::cavity::{Cavity, IN_ZONE, Rim};
use super::{Delaunay, Plane};
use crate::complex::{Facet, INFINITE, NONE};

/// The corners with `s` in place of corner `i`, turned to have `s` first; but a ghost corner stays last.
#[inline(always)]
fn joined([a, b, c]: [u32; 3], i: usize, s: u32) -> ([u32; 3], u32) {
    match i {
        0 => ([s, b, c], 0),
        1 if c == INFINITE => ([a, s, c], 1),
        1 => ([s, c, a], 0),
        _ => ([s, a, b], 0),
    }
}

/// Finds the zone of `q` from one cell of it, and its rim.
#[inline(always)]
pub(super) fn dig(
    t: &mut Delaunay<Plane>,
    cavity: &mut Cavity<Plane>,
    start: u32,
    s: u32,
    q: &[f64; 2],
    id: u32,
) {
    let Cavity { zone, rim, .. } = cavity;
    let (mut next, mut n_zone, mut n_rim, mut n_ghosts) = (0, 1, 0, 0);
    make_room(zone, rim, n_zone, n_rim);
    zone[0] = start;
    t.complex.set_mark(start, IN_ZONE);
    while next < n_zone {
        make_room(zone, rim, n_zone, n_rim);
        let cell = *t.complex.cell(zone[next]);
        n_ghosts += cell.is_ghost() as usize;
        next += 1;
        for i in 0..3 {
            let out = cell.neighbour(i);
            if t.complex.mark(out.cell()) == IN_ZONE {
                continue;
            }
            if t.is_in_conflict(out.cell(), q, id) {
                t.complex.set_mark(out.cell(), IN_ZONE);
                zone[n_zone] = out.cell();
                n_zone += 1;
            } else {
                let (corners, at) = joined(cell.corners, i, s);
                rim[n_rim] = Rim { corners, out, at };
                n_rim += 1;
            }
        }
    }
    (cavity.n_zone, cavity.n_rim, cavity.n_ghosts) = (n_zone, n_rim, n_ghosts);
}

/// Makes room for the three neighbours of a cell.
#[inline(always)]
fn make_room(zone: &mut Vec<u32>, rim: &mut Vec<Rim<[u32; 3]>>, n_zone: usize, n_rim: usize) {
    if zone.len() < n_zone + 3 {
        zone.resize(2 * n_zone + 64, 0);
    }
    if rim.len() < n_rim + 3 {
        rim.resize(2 * n_rim + 64, Rim { corners: [0; 3], out: Facet::new(0, 0), at: 0 });
    }
}

/// Makes the new triangles and glues them.
#[inline(always)]
pub(super) fn glue(t: &mut Delaunay<Plane>, cavity: &Cavity<Plane>) {
    let Cavity { rim, n_rim, cells, .. } = cavity;
    let rim = &rim[..*n_rim];
    for (facet, &cell) in rim.iter().zip(cells) {
        if facet.at == 0 {
            t.complex.put_glued(cell, facet.corners, [facet.out.code(), NONE, NONE]);
            t.corner_mut(facet.corners[1]).cell = Facet::new(cell, 2).code();
        } else {
            put_ghost(t, facet, cell);
        }
    }
    for (facet, &cell) in rim.iter().zip(cells) {
        let (start, end) = if facet.at == 0 { (1, 2) } else { (2, 0) };
        let next = Facet::from_code(t.corner_mut(facet.corners[end]).cell);
        t.complex.glue(Facet::new(cell, start), next);
    }
    for (facet, &cell) in rim.iter().zip(cells) {
        let start = if facet.at == 0 { 1 } else { 2 };
        t.corner_mut(facet.corners[start]).cell = cell;
    }
}

/// A triangle that starts at the ghost vertex.
#[cold]
#[inline(never)]
fn put_ghost(t: &mut Delaunay<Plane>, facet: &Rim<[u32; 3]>, cell: u32) {
    t.complex.put(cell, facet.corners);
    t.complex.glue(Facet::new(cell, 1), facet.out);
    t.corner_mut(INFINITE).cell = Facet::new(cell, 0).code();
}
