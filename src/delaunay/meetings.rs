//! The gluing of the cells that join a site to the rim of its zone in space.
//!
//! Each edge of the rim is seen once in each direction: the facet that sees it as `kl` meets the one that sees it as
//! `lk`. The meeting place is a square table over local labels of the rim's sites; a label is kept in the site's `cell`
//! field, which the insertion overwrites anyway, and is greater than any slot. Whether there is one cannot be
//! predicted, so both ways are written and one is kept.

use std::hint::select_unpredictable;

use super::Delaunay;
use super::in_space::InSpace;
use super::shape::Space;
use crate::complex::{Facet, INFINITE, MAX_CELLS};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;

/// Rims up to this size go through the table: a rim of `m` facets has `m / 2 + 2` sites.
pub(super) const SMALL_RIM: usize = 2 * (MAX_LABELS - 2);
const MAX_LABELS: usize = 64;
const TABLE: usize = MAX_LABELS * MAX_LABELS;

/// The first label: all are greater than any slot.
const FIRST_LABEL: u32 = MAX_CELLS.next_power_of_two() as u32;

/// A facet of the rim, the cell that joins it to the site, and beside it, where that is no matter of the facet, a cell
/// of the zone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// Corners of the new cell.
    pub(super) corners: [SiteId; 4],
    /// The facet seen from outside the zone.
    pub(super) out: Facet,
    /// Slot of the new cell.
    pub(super) cell: Slot,
    /// Labels of its last three corners.
    local: [u8; 4],
    /// A cell of the zone, by the facet through which it was found.
    pub(super) found: Facet,
}

impl Row {
    /// What is to be written over.
    pub(super) fn blank() -> Self {
        let facet = Facet::new(Slot::new(0), 0);
        Row { corners: [INFINITE; 4], out: facet, cell: Slot::new(0), local: [0; 4], found: facet }
    }
}

/// Where the two facets of a ridge meet: the facet that sees the edge from label `k` to label `l` is at
/// `k * MAX_LABELS + l`.
#[derive(Debug, Default)]
pub(super) struct Meetings(Vec<Facet>);

impl Meetings {
    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.0)
    }

    /// Makes room for rims of up to [`SMALL_RIM`] facets, unless there is.
    pub(super) fn make_room(&mut self) -> Result<()> {
        memory::lengthen(&mut self.0, TABLE, Facet::new(Slot::new(0), 0))
    }

    /// Puts the new cells of a rim, which have their slots, and glues them. Room has been [made](Self::make_room), and
    /// for all ridges of a rim that is larger than [`SMALL_RIM`].
    #[inline(always)]
    pub(super) fn glue<P: InSpace>(
        &mut self,
        t: &mut Delaunay<Space<P>>,
        rim: &mut [Row],
        ridges: Vec<Ridge>,
    ) {
        if rim.len() > SMALL_RIM {
            return glue_sorted(t, rim, ridges);
        }
        let (tables, _) = self.0.as_chunks_mut::<TABLE>();
        glue_by_table(t, rim, &mut tables[0], labels());
    }
}

/// Labels for the sites of one rim, each of them at its first and at all further calls.
#[inline(always)]
fn labels<P: InSpace>() -> impl FnMut(&mut Delaunay<Space<P>>, SiteId) -> usize {
    let mut next = FIRST_LABEL;
    move |t: &mut Delaunay<Space<P>>, v| {
        let site = t.corner_mut(v);
        let old = site.cell.get();
        debug_assert!(
            old < FIRST_LABEL + MAX_LABELS as u32,
            "a corner of a cell names a cell, or has a label"
        );
        let is_known = old >= FIRST_LABEL;
        let label = select_unpredictable(is_known, old, next);
        site.cell = Slot::new(label);
        next += !is_known as u32;
        (label - FIRST_LABEL) as usize
    }
}

/// Puts and glues the new cells of a rim by the table.
#[inline(always)]
fn glue_by_table<P: InSpace>(
    t: &mut Delaunay<Space<P>>,
    rim: &mut [Row],
    table: &mut [Facet; TABLE],
    mut label: impl FnMut(&mut Delaunay<Space<P>>, SiteId) -> usize,
) {
    for row in rim.iter_mut() {
        let cell = row.cell;
        let [_, k, l, m] = row.corners;
        let (k, l, m) = (label(t, k), label(t, l), label(t, m));
        row.local = [0, k as u8, l as u8, m as u8];
        table[(l * MAX_LABELS + m) % TABLE] = Facet::new(cell, 1);
        table[(m * MAX_LABELS + k) % TABLE] = Facet::new(cell, 2);
        table[(k * MAX_LABELS + l) % TABLE] = Facet::new(cell, 3);
    }
    for row in rim.iter() {
        let (cell, [_, k, l, m]) = (row.cell, row.local.map(usize::from));
        let at = |from: usize, to: usize| table[(from * MAX_LABELS + to) % TABLE];
        t.complex.put_glued(cell, row.corners, [row.out, at(m, l), at(k, m), at(l, k)]);
        for i in 1..4 {
            t.corner_mut(row.corners[i]).cell = cell;
        }
    }
}

/// An edge of the rim, and a facet there.
pub(super) type Ridge = ([SiteId; 2], Facet);

/// Puts and glues the new cells of a rim that has too many sites for the table: the two facets of an edge are
/// neighbours in sorted order. There is room for all `ridges`.
#[cold]
fn glue_sorted<P: InSpace>(t: &mut Delaunay<Space<P>>, rim: &[Row], mut ridges: Vec<Ridge>) {
    for row in rim {
        let (cell, v) = (row.cell, row.corners);
        t.complex.put(cell, v);
        t.complex.glue(Facet::new(cell, 0), row.out);
        for (i, k, l) in [(1, 2, 3), (2, 3, 1), (3, 1, 2)] {
            ridges.push(([v[k].min(v[l]), v[k].max(v[l])], Facet::new(cell, i)));
            t.sites[v[i]].cell = cell;
        }
    }
    ridges.sort_unstable();
    for pair in ridges.chunks_exact(2) {
        debug_assert_eq!(pair[0].0, pair[1].0);
        t.complex.glue(pair[0].1, pair[1].1);
    }
}
