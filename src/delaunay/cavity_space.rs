//! Conflict zones in space.
//!
//! New cells have the site first, and its rim facet's corners after it in an order that keeps the orientation and
//! leaves a ghost corner last; so which facet of a new cell is which is known to the compiler. How they are glued is the
//! matter of [`meetings`](super::meetings).
//!
//! Which way a test goes cannot be predicted, so both ways are written and one is kept. What can be known is the facet
//! through which a cell of the zone was found: three others are left to look across.

use super::cavity::{Cavity, Insert};
use super::meetings::{FEW_RIM, Meetings, Ridge, Rim, SMALL_RIM};
use super::spheres::{Spheres, Table};
use super::{Delaunay, Space};
use crate::complex::{Facet, INFINITE};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::predicates::StaticFilter;
use crate::simd::{Avx2, LANES};

/// Mark of a cell that has been found in conflict with the site; of all others it is 0.
pub(super) const IN_ZONE: u8 = 1;

/// Scratch memory.
#[derive(Debug, Default)]
pub struct Scratch {
    /// Cells in conflict, each by the facet through which it was found: the first `n_zone` entries. The rest is room to
    /// write before it is known whether to keep it.
    zone: Vec<Facet>,
    n_zone: usize,
    /// How many of them are ghosts.
    n_ghosts: usize,
    /// Likewise, the rim's facets.
    rim: Vec<Rim>,
    n_rim: usize,
    meetings: Meetings,
    pub(super) spheres: Spheres,
}

impl Insert<Space> for Scratch {
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
    fn is_inside(&self, filter: &StaticFilter, cell: Slot, q: &[f64; 3]) -> bool {
        self.spheres.is_inside(filter, cell, q)
    }

    fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.zone)
            + memory::bytes_of(&self.rim)
            + self.meetings.memory_bytes()
            + self.spheres.memory_bytes()
    }

    #[inline(always)]
    fn insert<const BUILD: bool>(
        t: &mut Delaunay<Space>,
        cavity: &mut Cavity<Space>,
        start: Slot,
        s: SiteId,
    ) -> Result<()> {
        let Cavity { cells, scratch, .. } = cavity;
        let mut ridges = Vec::new();
        let dug = match (BUILD, scratch.spheres.has_lengths) {
            (true, true) => dig_in_build::<true>(t, scratch, start, s),
            (true, false) => dig_in_build::<false>(t, scratch, start, s),
            _ => dig::<false, false>(t, scratch, start, s),
        };
        if let Err(error) = dug.and_then(|()| reserve::<BUILD>(t, cells, &mut ridges, scratch)) {
            for found in &scratch.zone[..scratch.n_zone] {
                t.complex.set_mark(found.cell(), 0);
            }
            return Err(error);
        }
        let (zone, n_rim) = (&scratch.zone[..scratch.n_zone], scratch.n_rim);
        t.complex.retire_ghosts(scratch.n_ghosts);
        // The k-th rim facet gets the k-th cell of the zone, whose memory is at hand, then free ones.
        let reused = zone.len().min(n_rim);
        for found in &zone[reused..] {
            t.complex.release(found.cell());
        }
        cells.extend(zone[..reused].iter().map(|found| found.cell()));
        for _ in reused..n_rim {
            cells.push(t.complex.create_blank());
        }
        glue::<BUILD>(t, cells, scratch, ridges);
        cavity.n_cells = n_rim;
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
fn reserve<const BUILD: bool>(
    t: &mut Delaunay<Space>,
    cells: &mut Vec<Slot>,
    ridges: &mut Vec<Ridge>,
    scratch: &Scratch,
) -> Result<()> {
    let n_rim = scratch.n_rim;
    t.complex.reserve(n_rim)?;
    if BUILD {
        t.complex.reserve_free(scratch.n_zone)?;
    } else {
        t.complex.note_all(scratch.zone[..scratch.n_zone].iter().map(|found| found.cell()))?;
        t.complex.reserve_rows(n_rim)?;
    }
    t.reserve_record(n_rim)?;
    cells.clear();
    memory::reserve(cells, n_rim)?;
    if n_rim > SMALL_RIM { memory::reserve_exact(ridges, 3 * n_rim) } else { Ok(()) }
}

/// As [`dig`], in a build.
// On its own: inlined in the loop over all sites it would be slower.
#[inline(never)]
fn dig_in_build<const BY_LENGTHS: bool>(
    t: &mut Delaunay<Space>,
    scratch: &mut Scratch,
    start: Slot,
    s: SiteId,
) -> Result<()> {
    match Avx2::new() {
        Some(avx2) => avx2.run_with(
            (t, scratch),
            start,
            s,
            #[inline(always)]
            |(t, scratch), start, s| dig::<true, BY_LENGTHS>(t, scratch, start, s),
        ),
        None => dig::<true, BY_LENGTHS>(t, scratch, start, s),
    }
}

/// Finds the zone of `s` from one cell of it, and its rim. After an error the zone is what has been marked.
#[inline(always)]
fn dig<const BUILD: bool, const BY_LENGTHS: bool>(
    t: &mut Delaunay<Space>,
    scratch: &mut Scratch,
    start: Slot,
    s: SiteId,
) -> Result<()> {
    scratch.n_zone = 0;
    let Scratch { zone, rim, spheres, meetings, .. } = scratch;
    let mut spheres = spheres.table();
    let (q, id) = (&{ t.site(s).point }, t.site(s).id);
    let (mut next, mut n_zone, mut n_rim, mut n_ghosts) = (0, 1, 0, 0);
    make_room(zone, rim, meetings, [n_zone, n_rim])?;
    zone[0] = Facet::new(start, 0);
    t.complex.set_mark(start, IN_ZONE);
    // With the corners of the new cell if the neighbour is not in the zone.
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
            zone[n_zone] = out;
            rim[n_rim] = Rim { corners: $corners, out };
            n_zone += usize::from(in_zone & !known);
            n_rim += usize::from(in_zone ^ IN_ZONE);
        };
    }
    let cell = *t.complex.cell(start);
    look_across!(cell.neighbour(0), joined(cell.corners, 0, s));
    while next < n_zone {
        if let Err(error) = make_room(zone, rim, meetings, [n_zone, n_rim]) {
            scratch.n_zone = n_zone;
            return Err(error);
        }
        // Through which facet the cell was found: it has been looked across.
        let (cell, from) = (*t.complex.cell(zone[next].cell()), zone[next].index());
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

/// Makes room for the four neighbours of a cell.
#[inline(always)]
fn make_room(
    zone: &mut Vec<Facet>,
    rim: &mut Vec<Rim>,
    meetings: &mut Meetings,
    n: [usize; 2],
) -> Result<()> {
    if zone.len() < n[0] + 4 || rim.len() < n[1] + 4 { grow(zone, rim, meetings, n) } else { Ok(()) }
}

#[cold]
#[inline(never)]
fn grow(
    zone: &mut Vec<Facet>,
    rim: &mut Vec<Rim>,
    meetings: &mut Meetings,
    [n_zone, n_rim]: [usize; 2],
) -> Result<()> {
    let facet = Facet::new(Slot::new(0), 0);
    if rim.len() < n_rim + 4 {
        let n = if n_rim == 0 { FEW_RIM } else { 2 * n_rim + 64 };
        if n > FEW_RIM {
            // First, as whoever has room for such a rim has room for the meetings.
            meetings.make_room()?;
        }
        memory::lengthen(rim, n, Rim { corners: [INFINITE; 4], out: facet })?;
    }
    if zone.len() < n_zone + 4 {
        memory::lengthen(zone, 2 * n_zone + 30, facet)?;
    }
    Ok(())
}

/// Makes the new cells and glues them.
#[inline(always)]
fn glue<const BUILD: bool>(
    t: &mut Delaunay<Space>,
    cells: &[Slot],
    scratch: &mut Scratch,
    ridges: Vec<Ridge>,
) {
    let Scratch { rim, n_rim, spheres, meetings, .. } = scratch;
    let rim = &rim[..*n_rim];
    meetings.glue(t, rim, cells, ridges);
    if BUILD {
        if spheres.has_lengths {
            prepare::<true>(t, rim, cells, spheres);
        } else {
            prepare::<false>(t, rim, cells, spheres);
        }
    }
}

/// Prepares the spheres of the new cells.
#[inline(never)]
fn prepare<const BY_LENGTHS: bool>(t: &Delaunay<Space>, rim: &[Rim], cells: &[Slot], spheres: &mut Spheres) {
    let spheres = spheres.table();
    match Avx2::new() {
        Some(avx2) => avx2.run_with(
            (t, avx2),
            (rim, cells),
            spheres,
            #[inline(always)]
            |(t, avx2), (rim, cells), spheres| prepare_in_lanes::<BY_LENGTHS>(avx2, t, rim, cells, spheres),
        ),
        None => prepare_each::<BY_LENGTHS>(t, rim, cells, spheres),
    }
}

fn prepare_each<const BY_LENGTHS: bool>(
    t: &Delaunay<Space>,
    rim: &[Rim],
    cells: &[Slot],
    mut spheres: Table,
) {
    for (facet, &cell) in rim.iter().zip(cells) {
        spheres.put::<BY_LENGTHS>(t, cell, &facet.corners);
    }
}

/// Four at a time; the last four are those at the end, some of them twice.
#[inline(always)]
fn prepare_in_lanes<const BY_LENGTHS: bool>(
    avx2: Avx2,
    t: &Delaunay<Space>,
    rim: &[Rim],
    cells: &[Slot],
    mut spheres: Table,
) {
    let last = rim.len() - LANES;
    let s = t.view().point(rim[0].corners[0]);
    for begin in (0..rim.len()).step_by(LANES) {
        let begin = begin.min(last);
        let (rim, cells) = (&rim[begin..], &cells[begin..]);
        if let (Some(rim), Some(cells)) = (rim.first_chunk(), cells.first_chunk()) {
            spheres.put_four::<BY_LENGTHS>(
                avx2,
                t,
                s,
                cells,
                rim.each_ref().map(|facet: &Rim| &facet.corners),
            );
        }
    }
}
