//! Conflict zones in space.
//!
//! New cells have the site first, and its rim facet's corners after it in an order that keeps the orientation and
//! leaves a ghost corner last; so which facet of a new cell is which is known to the compiler. How they are glued is
//! the matter of [`meetings`](super::meetings).
//!
//! Which way a test goes cannot be predicted, so both ways are written and one is kept. What can be known is the facet
//! through which a cell of the zone was found: three others are left to look across.

#![allow(unsafe_code)]

use super::Delaunay;
use super::above::Swallowed;
use super::geometry::Insert;
use super::in_space::InSpace;
use super::meetings::{Meetings, Ridge, Row, SMALL_RIM};
use super::shape::Space;
use super::spheres::{IN_ZONE, Spheres, Table};
use crate::complex::Facet;
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::predicates::StaticFilter;
use crate::simd::{LANES, Simd, in_lanes};

/// Scratch memory.
#[derive(Debug)]
pub struct Scratch<P> {
    /// Two lists side by side: the first `n_zone` rows have the cells in conflict, the first `n_rim` the rim's facets.
    /// The rest is room to write before it is known whether to keep it.
    rows: Vec<Row>,
    n_zone: usize,
    /// How many of them are ghosts.
    n_ghosts: usize,
    n_rim: usize,
    meetings: Meetings,
    pub(super) spheres: Spheres<P>,
}

impl<P> Default for Scratch<P> {
    fn default() -> Self {
        Scratch {
            rows: Vec::new(),
            n_zone: 0,
            n_ghosts: 0,
            n_rim: 0,
            meetings: Meetings::default(),
            spheres: Spheres::default(),
        }
    }
}

impl<P: InSpace> Insert<Space<P>> for Scratch<P> {
    fn begin_build(&mut self, n_cells: usize, is_weak: bool) -> Result<()> {
        self.spheres.begin(n_cells, is_weak)
    }

    fn adapt(&mut self) {
        self.spheres.adapt();
    }

    fn end_build(&mut self) {
        self.spheres.end();
    }

    #[inline(always)]
    fn is_inside(&self, filter: &StaticFilter, cell: Slot, q: &P) -> bool {
        self.spheres.is_inside(filter, cell, q)
    }

    fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.rows) + self.meetings.memory_bytes() + self.spheres.memory_bytes()
    }

    #[inline(always)]
    fn insert<const BUILD: bool>(
        &mut self,
        t: &mut Delaunay<Space<P>>,
        start: Slot,
        s: SiteId,
    ) -> Result<Slot> {
        let mut ridges = Vec::new();
        let dug = match (BUILD, self.spheres.has_lengths) {
            (true, true) => dig_in_build::<P, true>(t, self, start, s),
            (true, false) => dig_in_build::<P, false>(t, self, start, s),
            _ => dig::<P, false, false>(t, self, start, s),
        };
        let reserved = dug.and_then(|()| reserve::<P, BUILD>(t, &mut ridges, self));
        let reserved = reserved.and_then(|()| if P::HAS_WEIGHT { self.swallow(t) } else { Ok(()) });
        if let Err(error) = reserved {
            for row in &self.rows[..self.n_zone] {
                t.complex.set_mark(row.found.cell(), 0);
            }
            return Err(error);
        }
        let (n_zone, n_rim) = (self.n_zone, self.n_rim);
        t.complex.retire_ghosts(self.n_ghosts);
        // The k-th rim facet gets the k-th cell of the zone, whose memory is at hand, then free ones.
        let reused = n_zone.min(n_rim);
        for row in &self.rows[reused..n_zone] {
            t.complex.release(row.found.cell());
        }
        for row in &mut self.rows[..reused] {
            row.cell = row.found.cell();
        }
        for row in &mut self.rows[reused..n_rim] {
            row.cell = t.complex.create_blank(start);
        }
        glue::<P, BUILD>(t, self, ridges);
        Ok(self.rows[0].cell)
    }

    fn made(&self) -> impl ExactSizeIterator<Item = Slot> + '_ {
        self.rows[..self.n_rim].iter().map(|row| row.cell)
    }
}

impl<P: InSpace> Scratch<P> {
    /// Lists the sites that no facet of the rim has, which the new site hides, and loosens what is above the cells of the zone.
    #[inline(never)]
    fn swallow(&self, t: &mut Delaunay<Space<P>>) -> Result<()> {
        let mut swallowed = Swallowed::begin(t);
        for row in &self.rows[..self.n_rim] {
            let [_, a, b, c] = row.corners;
            swallowed.spare(t, [a, b, c], row.out.cell());
        }
        self.rows[..self.n_zone].iter().try_for_each(|row| swallowed.look_at(t, row.found.cell()))?;
        swallowed.end(t, self.rows[..self.n_zone].iter().map(|row| row.found.cell()));
        Ok(())
    }
}

/// The corners with `s` in place of corner `i`, in an even order that has `s` first.
#[inline(always)]
fn joined([a, b, c, d]: [SiteId; 4], i: usize, s: SiteId) -> [SiteId; 4] {
    match i {
        0 => [s, b, c, d],
        1 => [s, c, a, d],
        2 => [s, a, b, d],
        _ => [s, c, b, a],
    }
}

/// Makes room for all that the new cells need.
#[inline(always)]
fn reserve<P: InSpace, const BUILD: bool>(
    t: &mut Delaunay<Space<P>>,
    ridges: &mut Vec<Ridge>,
    scratch: &Scratch<P>,
) -> Result<()> {
    let Scratch { rows, n_zone, n_rim, .. } = scratch;
    let n_created = n_rim.saturating_sub(*n_zone);
    t.complex.reserve(n_created)?;
    if !BUILD {
        t.complex.note_all(rows[..*n_zone].iter().map(|row| row.found.cell()))?;
        t.complex.reserve_rows(n_created)?;
    }
    t.reserve_record(*n_rim)?;
    if *n_rim > SMALL_RIM { memory::reserve_exact(ridges, 3 * n_rim) } else { Ok(()) }
}

/// Finds the zone of `s` from one cell of it, and its rim, during a build.
// Not inlined: within the loop over all sites it would be slower.
#[inline(never)]
fn dig_in_build<P: InSpace, const BY_LENGTHS: bool>(
    t: &mut Delaunay<Space<P>>,
    scratch: &mut Scratch<P>,
    start: Slot,
    s: SiteId,
) -> Result<()> {
    in_lanes!(_simd, (t, scratch), start, s => |(t, scratch), start, s| {
        dig::<P, true, BY_LENGTHS>(t, scratch, start, s)
    })
}

/// Finds the zone of `s` from one cell of it, and its rim. After an error the zone is what has been marked.
#[inline(always)]
fn dig<P: InSpace, const BUILD: bool, const BY_LENGTHS: bool>(
    t: &mut Delaunay<Space<P>>,
    scratch: &mut Scratch<P>,
    start: Slot,
    s: SiteId,
) -> Result<()> {
    scratch.n_zone = 0;
    let Scratch { rows, spheres, meetings, .. } = scratch;
    let mut spheres = spheres.table();
    let (q, id) = (&{ t.site(s).point }, t.site(s).id);
    let (mut next, mut n_zone, mut n_rim, mut n_ghosts) = (0, 1, 0, 0);
    make_room(rows, meetings, n_zone)?;
    rows[0].found = Facet::new(start, 0);
    t.complex.set_mark(start, IN_ZONE);
    // Looks across a facet, given the corners of the new cell that is there if the neighbour is not in the zone.
    macro_rules! look_across {
        ($out:expr, $corners:expr) => {
            let out = $out;
            let known = t.complex.mark(out.cell());
            // A prepared test is cheaper than a wrong guess whether the cell is known.
            let in_zone = if BUILD {
                spheres.is_in_conflict::<BY_LENGTHS>(t, out.cell(), q, id, known)
            } else {
                u8::from(known == IN_ZONE || t.is_in_conflict(out.cell(), q, id))
            };
            // A site that comes alone finds nothing at hand.
            if !BUILD && in_zone == IN_ZONE && known != IN_ZONE {
                t.complex.prefetch_neighbours(out.cell());
                t.complex.prefetch_marks(t.complex.cell(out.cell()));
            }
            t.complex.set_mark(out.cell(), in_zone);
            debug_assert!(n_zone.max(n_rim) < rows.len());
            // SAFETY: there is room for all neighbours of the cell, each of which adds a row at most.
            unsafe {
                rows.get_unchecked_mut(n_zone).found = out;
                let row = rows.get_unchecked_mut(n_rim);
                (row.corners, row.out) = ($corners, out);
            }
            n_zone += usize::from(in_zone & !known);
            n_rim += usize::from(in_zone ^ IN_ZONE);
        };
    }
    let cell = *t.complex.cell(start);
    look_across!(cell.neighbour(0), joined(cell.corners, 0, s));
    while next < n_zone {
        if let Err(error) = make_room(rows, meetings, n_zone.max(n_rim)) {
            scratch.n_zone = n_zone;
            return Err(error);
        }
        // Through which facet the cell was found: it has been looked across.
        let (cell, from) = (*t.complex.cell(rows[next].found.cell()), rows[next].found.index());
        next += 1;
        if cell.is_ghost() {
            n_ghosts += 1;
            for i in (0..4).filter(|&i| i != from) {
                look_across!(cell.neighbour(i), joined(cell.corners, i, s));
            }
            continue;
        }
        // Written out, and in an order of corners by which each facet is at a fixed place: an even one, as are all that
        // exchange two pairs.
        let at = |k: usize| from ^ k;
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| cell.corners[at(k)]);
        look_across!(cell.neighbour(at(1)), [s, c, a, d]);
        look_across!(cell.neighbour(at(2)), [s, a, b, d]);
        look_across!(cell.neighbour(at(3)), [s, c, b, a]);
    }
    (scratch.n_zone, scratch.n_rim, scratch.n_ghosts) = (n_zone, n_rim, n_ghosts);
    Ok(())
}

/// Makes room for the four neighbours of a cell after `n` rows.
#[inline(always)]
fn make_room(rows: &mut Vec<Row>, meetings: &mut Meetings, n: usize) -> Result<()> {
    if rows.len() < n + 4 { grow(rows, meetings, n) } else { Ok(()) }
}

#[cold]
#[inline(never)]
fn grow(rows: &mut Vec<Row>, meetings: &mut Meetings, n: usize) -> Result<()> {
    // Room for the meetings first: where there is room for a rim, there has to be room for these.
    meetings.make_room()?;
    memory::lengthen(rows, 2 * n + 64, Row::blank())
}

/// Makes the new cells and glues them.
#[inline(always)]
fn glue<P: InSpace, const BUILD: bool>(
    t: &mut Delaunay<Space<P>>,
    scratch: &mut Scratch<P>,
    ridges: Vec<Ridge>,
) {
    let Scratch { rows, n_rim, spheres, meetings, .. } = scratch;
    let rim = &mut rows[..*n_rim];
    meetings.glue(t, rim, ridges);
    if BUILD {
        if spheres.has_lengths {
            prepare::<P, true>(t, rim, spheres);
        } else {
            prepare::<P, false>(t, rim, spheres);
        }
    }
}

/// Prepares the spheres of the new cells.
#[inline(never)]
fn prepare<P: InSpace, const BY_LENGTHS: bool>(
    t: &Delaunay<Space<P>>,
    rim: &[Row],
    spheres: &mut Spheres<P>,
) {
    let spheres = spheres.table();
    in_lanes!(simd, t, rim, spheres => |t, rim, spheres| {
        prepare_in_lanes::<_, P, BY_LENGTHS>(simd, t, rim, spheres)
    });
}

/// Four at a time; the last four are those at the end, some of them twice.
#[inline(always)]
fn prepare_in_lanes<S: Simd, P: InSpace, const BY_LENGTHS: bool>(
    simd: S,
    t: &Delaunay<Space<P>>,
    rim: &[Row],
    mut spheres: Table<P>,
) {
    let last = rim.len() - LANES;
    let s = t.view().point(rim[0].corners[0]);
    for begin in (0..rim.len()).step_by(LANES) {
        let begin = begin.min(last);
        if let Some(four) = rim[begin..].first_chunk() {
            let four: [&Row; LANES] = four.each_ref();
            let cells = four.map(|row| row.cell);
            spheres.put_four::<_, BY_LENGTHS>(simd, t, s, &cells, four.map(|row| &row.corners));
        }
    }
}
