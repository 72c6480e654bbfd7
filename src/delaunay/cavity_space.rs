//! Conflict zones in space.
//!
//! New cells have the site first, and its rim facet's corners after it in an order that keeps the orientation and
//! leaves a ghost corner last; so which facet of a new cell is which is known to the compiler. Each edge of the rim is
//! seen once in each direction: the facet that sees it as `kl` meets the one that sees it as `lk`. The meeting place is
//! a square table over local labels of the rim's sites; a label is kept in the site's `cell` field, which the
//! insertion overwrites anyway, and holds if the list of labels agrees.
//!
//! Which way a test or a label goes cannot be predicted, so both ways are written and one is kept.

use super::cavity::{Cavity, IN_ZONE, Rim};
use super::{Delaunay, Space};
use crate::complex::Facet;

/// Rims up to this size go through the table: a rim of `m` facets has `m / 2 + 2` sites.
const SMALL_RIM: usize = 2 * (MAX_LABELS - 2);
const MAX_LABELS: usize = 64;

/// Memory in which the two facets of a ridge meet.
#[derive(Debug)]
pub struct Ridges {
    /// Code of the facet that sees the edge from label `k` to label `l`, at `k * MAX_LABELS + l`.
    table: Box<[u32; MAX_LABELS * MAX_LABELS]>,
    labels: Box<[u32; MAX_LABELS]>,
    /// Labels of the last three corners of each new cell.
    local: Vec<[u8; 4]>,
}

impl Default for Ridges {
    fn default() -> Self {
        Ridges { table: Box::new([0; MAX_LABELS * MAX_LABELS]), labels: Box::new([0; MAX_LABELS]), local: Vec::new() }
    }
}

/// The corners with `s` in place of corner `i`, in an even order that has `s` first.
#[inline(always)]
fn joined([a, b, c, d]: [u32; 4], i: usize, s: u32) -> [u32; 4] {
    match i {
        0 => [s, b, c, d],
        1 => [s, c, a, d],
        2 => [s, a, b, d],
        _ => [s, c, b, a],
    }
}

/// Finds the zone of `q` from one cell of it, and its rim.
#[inline(always)]
pub(super) fn dig(t: &mut Delaunay<Space>, cavity: &mut Cavity<Space>, start: u32, s: u32, q: &[f64; 3], id: u32) {
    let Cavity { zone, rim, .. } = cavity;
    let blank = Rim { corners: [0; 4], out: Facet::new(0, 0), at: 0 };
    zone.clear();
    zone.push(start);
    t.complex.set_mark(start, IN_ZONE);
    let (mut next, mut n_zone, mut n_rim) = (0, 1, 0);
    while next < n_zone {
        if zone.len() < n_zone + 4 {
            zone.resize(2 * n_zone + 64, 0);
        }
        if rim.len() < n_rim + 4 {
            rim.resize(2 * n_rim + 64, blank);
        }
        let cell = *t.complex.cell(zone[next]);
        next += 1;
        for i in 0..4 {
            let out = cell.neighbour(i);
            if t.complex.mark(out.cell()) == IN_ZONE {
                continue;
            }
            let in_zone = t.is_in_conflict(out.cell(), q, id);
            t.complex.set_mark(out.cell(), in_zone as u8);
            zone[n_zone] = out.cell();
            rim[n_rim] = Rim { corners: joined(cell.corners, i, s), out, at: 0 };
            n_zone += in_zone as usize;
            n_rim += !in_zone as usize;
        }
    }
    zone.truncate(n_zone);
    rim.truncate(n_rim);
}

/// Makes the new cells and glues them.
#[inline(always)]
pub(super) fn glue(t: &mut Delaunay<Space>, cavity: &mut Cavity<Space>) {
    let Cavity { rim, cells, ridges, .. } = cavity;
    for (facet, &cell) in rim.iter().zip(&*cells) {
        t.complex.put(cell, facet.corners);
        t.complex.glue(Facet::new(cell, 0), facet.out);
    }
    if rim.len() > SMALL_RIM {
        glue_sorted(t, rim, cells);
        return;
    }
    let Ridges { table, labels, local } = ridges;
    local.clear();
    let mut n_labels = 0;
    for (facet, &cell) in rim.iter().zip(&*cells) {
        let [_, k, l, m] = facet.corners.map(|v| {
            let site = &mut t.sites[v as usize];
            let old = site.cell as usize;
            let is_known = old < n_labels && labels[old % MAX_LABELS] == v;
            let label = if is_known { old } else { n_labels };
            labels[label % MAX_LABELS] = v;
            site.cell = label as u32;
            n_labels += !is_known as usize;
            label
        });
        local.push([0, k as u8, l as u8, m as u8]);
        table[(l * MAX_LABELS + m) % (MAX_LABELS * MAX_LABELS)] = Facet::new(cell, 1).code();
        table[(m * MAX_LABELS + k) % (MAX_LABELS * MAX_LABELS)] = Facet::new(cell, 2).code();
        table[(k * MAX_LABELS + l) % (MAX_LABELS * MAX_LABELS)] = Facet::new(cell, 3).code();
    }
    for ((facet, &cell), label) in rim.iter().zip(&*cells).zip(&*local) {
        let [_, k, l, m] = label.map(usize::from);
        let at = |from: usize, to: usize| Facet::from_code(table[(from * MAX_LABELS + to) % (MAX_LABELS * MAX_LABELS)]);
        t.complex.set_last_neighbours(cell, [at(m, l), at(k, m), at(l, k)]);
        for &v in &facet.corners[1..] {
            t.sites[v as usize].cell = cell;
        }
    }
}

/// As the table, for rims with too many sites: the two facets of an edge are neighbours in sorted order.
#[cold]
fn glue_sorted(t: &mut Delaunay<Space>, rim: &[Rim<[u32; 4]>], cells: &[u32]) {
    let mut ridges: Vec<([u32; 2], Facet)> = Vec::with_capacity(3 * rim.len());
    for (facet, &cell) in rim.iter().zip(cells) {
        let v = facet.corners;
        for (i, k, l) in [(1, 2, 3), (2, 3, 1), (3, 1, 2)] {
            ridges.push(([v[k].min(v[l]), v[k].max(v[l])], Facet::new(cell, i)));
            t.sites[v[i] as usize].cell = cell;
        }
    }
    ridges.sort_unstable();
    for pair in ridges.chunks_exact(2) {
        debug_assert_eq!(pair[0].0, pair[1].0);
        t.complex.glue(pair[0].1, pair[1].1);
    }
}
