//! Conflict zones in the plane.
//!
//! No vertex goes when one comes, so a zone has none inside it: it is a polygon, and its triangles are joined like a
//! tree. Walked depth first and always to the right first, it is found without a mark, and its rim comes in order, edge
//! after edge around the new site: each new triangle has those before and after it for neighbours.
//!
//! The walk carries what it knows of the edge that it is about to cross, as seen from the new site: both ends, the
//! squares of their distances and their cross product. A test has only the third corner to look at, and what it
//! computes is what is known of the two edges behind.

#![allow(unsafe_code)]

use super::geometry::Insert;
use super::signs::Signs;
use super::{Delaunay, Plane};
use crate::complex::{Facet, INFINITE};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::predicates::{Lifted, seen_circle_bound, seen_circle_running_bound, side_of_seen_circle};

/// Scratch memory, written without a check of the bounds (they cost 10 % of a build).
#[derive(Debug, Default)]
pub struct Scratch {
    /// Whether this build tests by lengths (see [`seen_circle_bound`]): the static bound would leave most tests
    /// uncertain.
    has_lengths: bool,
    /// Edges where the walk through the zone turned right, to be taken up when it comes back: as long as `rows`.
    turns: Vec<Edge>,
    /// Cells and rim side by side; the first `n_made` rows were made by the last insertion.
    rows: Vec<Row>,
    n_made: usize,
}

/// A cell of the zone, then a new cell in its place or one more, and an edge of the rim, which is counter-clockwise.
#[derive(Clone, Copy, Debug)]
struct Row {
    cell: Slot,
    /// Where the edge starts.
    start: SiteId,
    /// The edge seen from outside the zone.
    out: Facet,
}

impl Insert<Plane> for Scratch {
    fn begin_build(&mut self, _n_cells: usize, is_weak: bool) -> Result<()> {
        self.has_lengths = is_weak;
        Ok(())
    }

    fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.turns) + memory::bytes_of(&self.rows)
    }

    #[inline(always)]
    fn insert<const BUILD: bool>(&mut self, t: &mut Delaunay<Plane>, start: Slot, s: SiteId) -> Result<Slot> {
        // A polygon has two edges more than triangles.
        t.complex.reserve(2)?;
        let zone = match BUILD && self.has_lengths {
            true => dig::<true>(t, self, start, s)?,
            false => dig::<false>(t, self, start, s)?,
        };
        let n_made = zone.n_cells + 2;
        t.reserve_record(n_made)?;
        if !BUILD {
            t.complex.note_all(self.rows[..zone.n_cells].iter().map(|row| row.cell))?;
            t.complex.reserve_rows(2)?;
        }
        for row in &mut self.rows[zone.n_cells..n_made] {
            row.cell = t.complex.create_blank(start);
        }
        self.n_made = n_made;
        let made = &self.rows[..n_made];
        fill(t, made, s);
        if zone.n_ghosts > 0 {
            t.complex.retire_ghosts(zone.n_ghosts);
            put_ghosts(t, made, s);
        }
        Ok(made[0].cell)
    }

    fn made(&self) -> impl ExactSizeIterator<Item = Slot> + '_ {
        self.rows[..self.n_made].iter().map(|row| row.cell)
    }
}

/// The zone found, by the length of its lists: `n_cells + 2` edges of the rim.
struct Zone {
    n_cells: usize,
    n_ghosts: usize,
}

/// An edge to be crossed outwards, from `right` to `left`, both seen from the new site.
#[derive(Clone, Copy, Debug)]
struct Edge {
    /// The edge seen from outside.
    out: Facet,
    /// The corner on the right, where it starts.
    start: SiteId,
    right: Lifted,
    left: Lifted,
    /// Cross product of right and left.
    cross: f64,
}

impl Edge {
    /// The edge opposite corner `i` of a cell; what is seen of the ghost vertex is meaningless.
    #[inline(always)]
    fn of(t: &Delaunay<Plane>, cell: Slot, i: usize, q: &[f64; 2]) -> Self {
        let cell = t.complex.cell(cell);
        let [start, end] = [cell.corners[(i + 1) % 3], cell.corners[(i + 2) % 3]];
        let [right, left] = [start, end].map(|s| Lifted::new(t.view().point(s), q));
        Edge { out: cell.neighbour(i), start, right, left, cross: right.cross(&left) }
    }
}

/// Finds the zone of `s` from one cell of it, and its rim.
// On its own the loop has all registers: inlined in that over all sites, a build of 1,000 points takes a fifth longer.
#[inline(never)]
fn dig<const BY_LENGTHS: bool>(
    t: &Delaunay<Plane>,
    scratch: &mut Scratch,
    start: Slot,
    s: SiteId,
) -> Result<Zone> {
    let (q, id) = (&t.site(s).point, t.site(s).id);
    let mut n_ghosts = t.complex.cell(start).is_ghost() as usize;
    let (mut n_cells, mut n_turns, mut n_rim) = (1, 2, 0);
    make_room(scratch, n_cells)?;
    scratch.rows[0].cell = start;
    scratch.turns[0] = Edge::of(t, start, 1, q);
    scratch.turns[1] = Edge::of(t, start, 0, q);
    let mut edge = Edge::of(t, start, 2, q);
    loop {
        let beyond = edge.out.cell();
        let (tip_at, [first, second]) = (edge.out.index(), OTHERS[edge.out.index()]);
        let cell = t.complex.cell(beyond);
        let behind = if cell.is_ghost() {
            let is_in_zone = t.is_in_conflict_with_ghost(&t.filter, beyond, q, id);
            n_ghosts += is_in_zone as usize;
            is_in_zone.then(|| [first, second].map(|i| Edge::of(t, beyond, i, q)))
        } else {
            let tip_site = cell.corners[tip_at];
            let tip = Lifted::new(t.view().point(tip_site), q);
            let (right, left) = (edge.right.cross(&tip), tip.cross(&edge.left));
            let corners = [&edge.left, &edge.right, &tip];
            let side = side_of_seen_circle(corners, [-edge.cross, right, left]);
            let bound = if BY_LENGTHS { seen_circle_bound(corners) } else { t.filter.prepared };
            let is_in_zone = side > bound
                || side >= -bound && is_in_uncertain_conflict(t, beyond, q, id, side, corners.map(|&p| p));
            is_in_zone.then(|| {
                let [out_first, out_second] = [first, second].map(|i| cell.neighbour(i));
                [
                    Edge { out: out_first, left: tip, cross: right, ..edge },
                    Edge { out: out_second, start: tip_site, right: tip, left: edge.left, cross: left },
                ]
            })
        };
        if let Some([next, turn]) = behind {
            make_room(scratch, n_cells + 1)?;
            // SAFETY: there is room for one more cell, and for as many turns as cells and one more.
            unsafe {
                scratch.rows.get_unchecked_mut(n_cells).cell = beyond;
                *scratch.turns.get_unchecked_mut(n_turns) = turn;
            }
            n_cells += 1;
            n_turns += 1;
            edge = next;
        } else {
            // SAFETY: the rim so far and the turns to come are at most two more than the cells, which is the room made.
            let row = unsafe { scratch.rows.get_unchecked_mut(n_rim) };
            (row.start, row.out) = (edge.start, edge.out);
            n_rim += 1;
            if n_turns == 0 {
                return Ok(Zone { n_cells, n_ghosts });
            }
            n_turns -= 1;
            // SAFETY: below the turns written.
            edge = *unsafe { scratch.turns.get_unchecked(n_turns) };
        }
    }
}

/// Makes room for a zone of `n_cells` cells: its rim has two edges more, and at most as many turns.
#[inline(always)]
fn make_room(scratch: &mut Scratch, n_cells: usize) -> Result<()> {
    if scratch.rows.len() < n_cells + 2 { grow(scratch, n_cells) } else { Ok(()) }
}

#[cold]
#[inline(never)]
fn grow(Scratch { turns, rows, .. }: &mut Scratch, n_cells: usize) -> Result<()> {
    let room = 2 * n_cells + 64;
    let facet = Facet::new(Slot::new(0), 0);
    let seen = Lifted::new(&[0.0; 2], &[0.0; 2]);
    memory::lengthen(turns, room, Edge { out: facet, start: INFINITE, right: seen, left: seen, cross: 0.0 })?;
    // The rows are lengthened last, as their length stands for that of both lists.
    memory::lengthen(rows, room, Row { cell: Slot::new(0), start: INFINITE, out: facet })
}

/// The edges behind the one opposite a corner, the right one first, by the corners that they are opposite.
const OTHERS: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];

/// Whether a cell is in conflict where the first bound did not decide: by the bounds of the corners, and of their cross
/// products.
#[cold]
#[inline(never)]
fn is_in_uncertain_conflict(
    t: &Delaunay<Plane>,
    cell: Slot,
    q: &[f64; 2],
    id: VertexId,
    side: f64,
    corners: [Lifted; 3],
) -> bool {
    let corners = corners.each_ref();
    // On lattices the side is mostly zero.
    if side != 0.0 && side.abs() > seen_circle_running_bound(corners) {
        return side > 0.0;
    }
    Plane::is_in_sphere(&t.filter, t.view(), &t.complex.cell(cell).corners, q, id)
}

/// Joins each edge of the rim to the site; the new triangles turn around it, so each is glued to the one before and to
/// the one after it.
#[inline(always)]
fn fill(t: &mut Delaunay<Plane>, made: &[Row], s: SiteId) {
    let (mut before, mut row) = (made[made.len() - 1].cell, made[0]);
    let mut put = |next: Row| {
        let neighbours = [row.out, Facet::new(next.cell, 2), Facet::new(before, 1)];
        t.complex.put_glued(row.cell, [s, row.start, next.start], neighbours);
        t.corner_mut(row.start).cell = row.cell;
        (before, row) = (row.cell, next);
    };
    for &next in &made[1..] {
        put(next);
    }
    put(made[0]);
}

/// Turns the triangle that starts at the ghost vertex, so that this comes last, and counts both ghosts.
#[cold]
#[inline(never)]
fn put_ghosts(t: &mut Delaunay<Plane>, made: &[Row], s: SiteId) {
    let n = made.len();
    let k =
        made.iter().position(|row| row.start == INFINITE).expect("ghosts in the zone have the ghost vertex");
    let (before, row, after) = (made[(k + n - 1) % n], made[k], made[(k + 1) % n]);
    t.complex.put(row.cell, [after.start, s, INFINITE]);
    t.complex.glue(Facet::new(row.cell, 0), Facet::new(before.cell, 1));
    t.complex.glue(Facet::new(row.cell, 1), row.out);
    t.complex.glue(Facet::new(row.cell, 2), Facet::new(after.cell, 2));
}
