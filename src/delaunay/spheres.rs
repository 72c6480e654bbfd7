//! Prepared spheres of the cells that a build is busy with.
//!
//! A build along a curve tests the cells of one neighbourhood again and again. A cell's sphere, prepared once, makes
//! each of these tests a few operations on one line of cache (see [`predicates::sphere`]). They are kept in a table of
//! fixed size, each at its cell's slot modulo that; what is not there is prepared when it is asked for. The table is
//! valid while sites do not move and every cell made is [`put`](Table::put) there,
//! [four at a time](Table::put_four), as all cells that an insertion makes have the new site in common.
//!
//! The walk to a new site asks, too: it may end in the first cell whose sphere has the site, as the zone can be found
//! from any cell of it.
//!
//! Where the static bound leaves most tests uncertain, or many that a bound of the cell's own decides, a sphere is
//! prepared with that bound, and tested against it at once: *by lengths*, those of the cell's edges. That takes more
//! operations, but hardly a branch that may go either way. Builds of clusters and of lattices with noise gain
//! (`clusters` and `grid_noise` of `cpp-bench/run --structured`).

#![allow(unsafe_code)]

use super::Delaunay;
use super::in_space::InSpace;
use super::shape::Space;
use crate::complex::INFINITE;
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::predicates::{self, Sphere, StaticFilter};
use crate::simd::{LANES, Lanes, Simd, rows};

/// Mark of a cell that has been found in conflict with the site; of all others it is 0.
pub(super) const IN_ZONE: u8 = 1;

/// Entries of the table at most: 256 KiB, a part of a core's own cache. Sixteen times as many are no faster.
const MOST_ENTRIES: usize = 1 << 12;

/// What a bound is lowered by, by the mark of the cell: one in the zone needs no test.
static ALLOWANCES: [f64; 2] = [0.0, f64::INFINITY];

/// Entries that are looked at to learn what tests have needed.
const SAMPLED: usize = 1 << 8;

/// A cell, its sphere, the place of its first corner, and the length of its edges there.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Entry<P> {
    sphere: Sphere,
    first: P,
    cell: Slot,
    /// See [`predicates::edge_length`]. Infinite until it has decided a test, if it is not prepared with the sphere.
    length: f32,
}

/// The table; without entries outside a build.
#[derive(Debug)]
pub struct Spheres<P> {
    /// Entries, as many as a power of two.
    entries: Vec<Entry<P>>,
    /// Whether spheres are prepared and tested by lengths.
    pub(super) has_lengths: bool,
}

impl<P> Default for Spheres<P> {
    fn default() -> Self {
        Spheres { entries: Vec::new(), has_lengths: false }
    }
}

impl<P: InSpace> Spheres<P> {
    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.entries)
    }

    /// Gets ready for a build of about `n_cells` cells. `is_weak` if the static bound will leave most tests uncertain.
    pub(super) fn begin(&mut self, n_cells: usize, is_weak: bool) -> Result<()> {
        // Lengths bound no weights.
        self.has_lengths = is_weak && !P::HAS_WEIGHT;
        let n = n_cells.next_power_of_two().min(MOST_ENTRIES);
        self.entries.clear();
        memory::reserve_exact(&mut self.entries, n)?;
        let none = Entry { sphere: [0.0; 4], first: P::default(), cell: Slot::NONE, length: f32::INFINITY };
        self.entries.resize(n, none);
        Ok(())
    }

    /// Goes on by lengths where these have decided tests of a quarter of the cells.
    pub(super) fn adapt(&mut self) {
        let sample = self.entries.iter().step_by((self.entries.len() / SAMPLED).max(1));
        let (mut n, mut n_decisive) = (0, 0);
        for entry in sample.filter(|entry| entry.cell != Slot::NONE) {
            n += 1;
            n_decisive += usize::from(entry.length < f32::INFINITY);
        }
        self.has_lengths |= 4 * n_decisive > n;
    }

    /// Frees the table: what it holds would be stale after the first relocation.
    pub(super) fn end(&mut self) {
        self.entries = Vec::new();
    }

    /// Whether the point is certainly in the sphere of this cell; not if that is not in the table.
    #[inline(always)]
    pub(super) fn is_inside(&self, filter: &StaticFilter, cell: Slot, q: &P) -> bool {
        let Some(at) = self.entries.len().checked_sub(1) else { return false };
        let entry = &self.entries[cell.index() & at];
        let bound = if self.has_lengths {
            predicates::side_bound_by_length(entry.length, entry.first.place(), q.place())
        } else {
            filter.prepared
        };
        P::side(&entry.sphere, entry.first.alone(), q.alone()) > bound && entry.cell == cell
    }

    /// The table as a build uses it.
    #[inline(always)]
    pub(super) fn table(&mut self) -> Table<'_, P> {
        Table(&mut self.entries)
    }
}

/// The entries, with what does not change at hand.
pub(super) struct Table<'s, P>(&'s mut [Entry<P>]);

#[inline(always)]
fn entry<P>(entries: &mut [Entry<P>], cell: Slot) -> &mut Entry<P> {
    debug_assert!(entries.len().is_power_of_two(), "only a build asks");
    let at = cell.index() & (entries.len() - 1);
    // SAFETY: the length is a power of two.
    unsafe { entries.get_unchecked_mut(at) }
}

impl<P: InSpace> Table<'_, P> {
    /// Prepares the sphere of a cell with these corners, or what lies beyond the facet of a ghost cell.
    #[inline(always)]
    pub(super) fn put<const BY_LENGTHS: bool>(
        &mut self,
        t: &Delaunay<Space<P>>,
        cell: Slot,
        corners: &[SiteId; 4],
    ) {
        put::<P, BY_LENGTHS>(self.0, t, cell, corners);
    }

    /// Prepares the spheres of four cells that have `a` for their first corner.
    #[inline(always)]
    pub(super) fn put_four<S: Simd, const BY_LENGTHS: bool>(
        &mut self,
        simd: S,
        t: &Delaunay<Space<P>>,
        a: &P,
        cells: &[Slot; LANES],
        corners: [&[SiteId; 4]; LANES],
    ) {
        let at = a.in_all_lanes(simd);
        let others = |i: usize| {
            let points = corners.map(
                #[inline(always)]
                |corners| t.view().point(corners[i]),
            );
            P::load(simd, points)
        };
        let (b, c, d) = (others(1), others(2), others(3));
        let spheres = rows(P::sphere(&at, &b, &c, &d));
        let lengths = if BY_LENGTHS {
            let [at, b, c, d] = [&at, &b, &c, &d].map(P::place_of);
            predicates::edge_length(at, b, c, d).store()
        } else {
            [f64::INFINITY; LANES]
        };
        for k in 0..LANES {
            let entry = entry(self.0, cells[k]);
            spheres[k].store_to(&mut entry.sphere);
            (entry.first, entry.cell, entry.length) = (*a, cells[k], lengths[k] as f32);
        }
        for k in 0..LANES {
            if corners[k][3] == INFINITE {
                self.put::<BY_LENGTHS>(t, cells[k], corners[k]);
            }
        }
    }

    /// The mark of a cell for `q`: [`IN_ZONE`] if they are in conflict, with ties broken as those of vertex `id`, else
    /// 0. `known` is the mark that the cell has: one in the zone stays there.
    #[inline(always)]
    pub(super) fn is_in_conflict<const BY_LENGTHS: bool>(
        &mut self,
        t: &Delaunay<Space<P>>,
        cell: Slot,
        q: &P,
        id: VertexId,
        known: u8,
    ) -> u8 {
        let there = entry(self.0, cell);
        if there.cell != cell {
            return prepare::<P, BY_LENGTHS>(self.0, t, cell, q, id, known);
        }
        is_inside::<P, BY_LENGTHS>(there, t, q, id, known)
    }
}

#[inline(always)]
fn put<P: InSpace, const BY_LENGTHS: bool>(
    entries: &mut [Entry<P>],
    t: &Delaunay<Space<P>>,
    cell: Slot,
    corners: &[SiteId; 4],
) {
    let points = corners.map(|s| t.view().point(s));
    let [a, b, c, d] = points.map(P::place);
    let sphere = || {
        let [a, b, c, d] = points.map(P::alone);
        P::sphere(a, b, c, d)
    };
    let (sphere, length) = match (corners[3] == INFINITE, BY_LENGTHS) {
        (false, false) => (sphere(), f32::INFINITY),
        (false, true) => (sphere(), predicates::edge_length(a, b, c, d) as f32),
        (true, false) => (predicates::half_space(&t.filter, a, b, c), f32::INFINITY),
        (true, true) => predicates::half_space_by_length(a, b, c),
    };
    *entry(entries, cell) = Entry { sphere, first: *points[0], cell, length };
}

#[inline(always)]
fn is_inside<P: InSpace, const BY_LENGTHS: bool>(
    entry: &mut Entry<P>,
    t: &Delaunay<Space<P>>,
    q: &P,
    id: VertexId,
    known: u8,
) -> u8 {
    let side = P::side(&entry.sphere, entry.first.alone(), q.alone());
    let bound = if BY_LENGTHS {
        predicates::side_bound_by_length(entry.length, entry.first.place(), q.place())
    } else {
        t.filter.prepared
    };
    // The allowance is loaded: a choice would be a branch.
    let bound = bound - ALLOWANCES[usize::from(known & IN_ZONE)];
    if side.abs() > bound {
        u8::from(side > 0.0) | known
    } else {
        is_in_uncertain_conflict::<P, BY_LENGTHS>(entry, t, q, id, side).into()
    }
}

/// Prepares the sphere of a cell that is not in the table yet, and answers as [`Table::is_in_conflict`] does.
#[cold]
#[inline(never)]
fn prepare<P: InSpace, const BY_LENGTHS: bool>(
    entries: &mut [Entry<P>],
    t: &Delaunay<Space<P>>,
    cell: Slot,
    q: &P,
    id: VertexId,
    known: u8,
) -> u8 {
    // Where one is missing in the table, so are its neighbours, which are looked at next.
    t.complex.prefetch_neighbours(cell);
    put::<P, BY_LENGTHS>(entries, t, cell, &t.complex.cell(cell).corners);
    is_inside::<P, BY_LENGTHS>(entry(entries, cell), t, q, id, known)
}

/// Whether a point is in conflict with a cell where the first bound did not decide: by the cell's own bound, unless
/// that was the first, from what has been computed.
#[cold]
#[inline(never)]
fn is_in_uncertain_conflict<P: InSpace, const BY_LENGTHS: bool>(
    entry: &mut Entry<P>,
    t: &Delaunay<Space<P>>,
    q: &P,
    id: VertexId,
    side: f64,
) -> bool {
    let corners = t.complex.cell(entry.cell).corners;
    if corners[3] == INFINITE {
        return t.is_in_conflict(entry.cell, q, id);
    }
    let points = corners.map(|s| t.view().point(s));
    let [a, b, c, d] = points.map(P::place);
    if t.filter.is_exact {
        // The side of the sphere is exact, so it is zero: a tie, which ids decide, as there are no keys.
        debug_assert_eq!(side, 0.0);
        let [i, j, k, l] = corners.map(|s| t.view().id(s).get());
        let ids = [i, j, k, l, id.get()];
        return predicates::is_inside_cospherical_on_lattice([a, b, c, d, q.place()], ids);
    }
    // The sphere has been prepared from the corners in this order.
    if !P::HAS_WEIGHT && (!BY_LENGTHS || entry.length == f32::INFINITY) {
        let is_kept = entry.length < f32::INFINITY;
        let length = if is_kept { entry.length } else { predicates::edge_length(a, b, c, d) as f32 };
        if side.abs() > predicates::side_bound_by_length(length, a, q.place()) {
            entry.length = length;
            return side > 0.0;
        }
    }
    let [a, b, c, d] = points;
    let is_certain = P::is_side_certain(side, [a, b, c, d, q]);
    if is_certain { side > 0.0 } else { t.is_in_conflict(entry.cell, q, id) }
}
