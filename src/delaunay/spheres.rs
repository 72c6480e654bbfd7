//! Prepared spheres of the cells that a build is busy with.
//!
//! A build along a curve tests the cells of one neighbourhood again and again. A cell's sphere, prepared once, makes
//! each of these tests a few operations on one line of cache (see [`predicates::sphere`]). They are kept in a table of
//! fixed size, each at its cell's slot modulo that; what is not there is prepared when it is asked for. The table is
//! valid while sites do not move and every cell made is [`put`](Table::put) there.

#![allow(unsafe_code)]

use super::{Delaunay, Space};
use crate::complex::INFINITE;
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::predicates::{self, Sphere};
use crate::simd::Real;

/// Entries of the table at most: 256 KiB, a part of a core's own cache. Sixteen times as many are no faster.
const MOST_ENTRIES: usize = 1 << 12;

/// A cell, its sphere, the place of its first corner, and its extent.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Entry {
    sphere: Sphere,
    first: [f64; 3],
    cell: Slot,
    /// Not less than the largest difference of its corners from the first one along an axis. Infinite until it is asked
    /// for.
    extent: f32,
}

/// The table; without entries outside a build.
#[derive(Debug, Default)]
pub struct Spheres {
    /// A power of two of them.
    entries: Vec<Entry>,
    /// Whether a cell's extent is computed with its sphere; a third of the time that it takes later.
    pub(super) has_extents: bool,
}

impl Spheres {
    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.entries)
    }

    /// Gets ready for a build of about `n_cells` cells. `is_weak` if the static bound will leave most tests uncertain.
    pub(super) fn begin(&mut self, n_cells: usize, is_weak: bool) -> Result<()> {
        self.has_extents = is_weak;
        let n = n_cells.next_power_of_two().min(MOST_ENTRIES);
        self.entries.clear();
        memory::reserve_exact(&mut self.entries, n)?;
        self.entries
            .resize(n, Entry { sphere: [0.0; 4], first: [0.0; 3], cell: Slot::NONE, extent: f32::INFINITY });
        Ok(())
    }

    /// Frees the table: what it holds would be stale after the first relocation.
    pub(super) fn end(&mut self) {
        self.entries = Vec::new();
    }

    /// The table as a build uses it.
    #[inline(always)]
    pub(super) fn table(&mut self) -> Table<'_> {
        Table(&mut self.entries)
    }
}

/// The entries, with what does not change at hand.
pub(super) struct Table<'s>(&'s mut [Entry]);

#[inline(always)]
fn entry(entries: &mut [Entry], cell: Slot) -> &mut Entry {
    debug_assert!(entries.len().is_power_of_two(), "only a build asks");
    let at = cell.index() & (entries.len() - 1);
    // SAFETY: the length is a power of two.
    unsafe { entries.get_unchecked_mut(at) }
}

impl Table<'_> {
    /// Prepares the sphere of a cell with these corners, or what lies beyond the facet of a ghost cell.
    #[inline(always)]
    pub(super) fn put(&mut self, t: &Delaunay<Space>, cell: Slot, corners: &[SiteId; 4]) {
        put::<false>(self.0, t, cell, corners);
    }

    /// As [`put`](Self::put), with the cell's extent.
    #[inline(always)]
    pub(super) fn put_with_extent(&mut self, t: &Delaunay<Space>, cell: Slot, corners: &[SiteId; 4]) {
        put::<true>(self.0, t, cell, corners);
    }

    /// Whether `q`, with ties broken as those of vertex `id`, is in conflict with a cell.
    #[inline(always)]
    pub(super) fn is_in_conflict(
        &mut self,
        t: &Delaunay<Space>,
        cell: Slot,
        q: &[f64; 3],
        id: VertexId,
    ) -> bool {
        let there = entry(self.0, cell);
        if there.cell != cell {
            return prepare(self.0, t, cell, q, id);
        }
        is_inside(there, t, q, id)
    }
}

#[inline(always)]
fn put<const WITH_EXTENT: bool>(
    entries: &mut [Entry],
    t: &Delaunay<Space>,
    cell: Slot,
    corners: &[SiteId; 4],
) {
    let [a, b, c, d] = corners.map(|s| t.view().point(s));
    let (sphere, extent) = if corners[3] == INFINITE {
        (predicates::half_space(&t.filter, a, b, c), f32::INFINITY)
    } else {
        (predicates::sphere(a, b, c, d), if WITH_EXTENT { extent([a, b, c, d]) } else { f32::INFINITY })
    };
    *entry(entries, cell) = Entry { sphere, first: *a, cell, extent };
}

#[inline(always)]
fn extent([a, b, c, d]: [&[f64; 3]; 4]) -> f32 {
    let reach = |p| predicates::reach(a, p);
    (Real::max(Real::max(reach(b), reach(c)), reach(d)) as f32).next_up()
}

#[inline(always)]
fn is_inside(entry: &mut Entry, t: &Delaunay<Space>, q: &[f64; 3], id: VertexId) -> bool {
    let side = predicates::side_of_sphere(&entry.sphere, &entry.first, q);
    if side.abs() > t.filter.prepared { side > 0.0 } else { is_in_uncertain_conflict(entry, t, q, id, side) }
}

/// As [`Table::is_in_conflict`], for a cell that is not there yet.
#[cold]
#[inline(never)]
fn prepare(entries: &mut [Entry], t: &Delaunay<Space>, cell: Slot, q: &[f64; 3], id: VertexId) -> bool {
    put::<false>(entries, t, cell, &t.complex.cell(cell).corners);
    is_inside(entry(entries, cell), t, q, id)
}

/// After the static bound. Where spacings differ much, it is that of the largest and nearly all tests come here: so
/// these are decided by a bound of the cell's own, with what has been computed.
#[cold]
#[inline(never)]
fn is_in_uncertain_conflict(
    entry: &mut Entry,
    t: &Delaunay<Space>,
    q: &[f64; 3],
    id: VertexId,
    side: f64,
) -> bool {
    let is_certain =
        !t.filter.is_exact && predicates::is_side_certain_within(side, entry.extent.into(), &entry.first, q);
    if is_certain { side > 0.0 } else { is_in_near_conflict(entry, t, q, id, side) }
}

/// After the cell's own bound, or where that has never been asked for.
#[cold]
#[inline(never)]
fn is_in_near_conflict(
    entry: &mut Entry,
    t: &Delaunay<Space>,
    q: &[f64; 3],
    id: VertexId,
    side: f64,
) -> bool {
    let corners = t.complex.cell(entry.cell).corners;
    if corners[3] == INFINITE {
        return t.is_in_conflict(entry.cell, q, id);
    }
    let [a, b, c, d] = corners.map(|s| t.view().point(s));
    if t.filter.is_exact {
        // The side of the sphere is exact, so it is zero: a tie.
        let [i, j, k, l] = corners.map(|s| t.view().id(s).get());
        return predicates::is_inside_cospherical(&t.filter, [a, b, c, d, q], [i, j, k, l, id.get()]);
    }
    if entry.extent == f32::INFINITY {
        entry.extent = extent([a, b, c, d]);
        if predicates::is_side_certain_within(side, entry.extent.into(), a, q) {
            return side > 0.0;
        }
    }
    // The sphere has been prepared from the corners in this order.
    let is_certain = predicates::is_side_certain(side, [a, b, c, d, q]);
    if is_certain { side > 0.0 } else { t.is_in_conflict(entry.cell, q, id) }
}
