//! Edges that have to be there: from the Delaunay triangulation of the plane to a constrained one.
//!
//! In the *constrained Delaunay triangulation* of sites and segments, each segment is an edge, and the circle of a cell
//! has no site inside that is seen from the cell's inside, where segments are opaque (Chew, 10.1007/BF01553881). Ties are
//! broken by vertex id as everywhere, so it is a function of sites and segments alone.
//!
//! **A segment that is missing** crosses cells; those are taken away, and the polygons on its two sides are triangulated.
//! Every corner of a polygon sees a place on the segment through the cell that it was opposite in. So of the corners on
//! one side that one makes a cell with the segment whose circle has no other of them inside: nothing can be between, as
//! what enters such a triangle without a corner in it would hide the corner. The two edges that the cell adds have
//! polygons of the same kind beyond them (Anglada, 10.1016/S0097-8493(97)00004-1). What is made is again constrained
//! Delaunay, whatever the order in which segments are entered.
//!
//! **Segments are walked along first**, all that are missing, before any cell is replaced. Then it is known whether one has
//! a site on it or crosses another, which is told; and the rows of all cells that will be replaced are kept as they are in
//! the Delaunay triangulation. To put them back is to have that again, slot by slot: what moves vertices does so, and
//! never sees a segment.
//!
//! Cost: of a segment that is there, the cells around one end; of others, the cells crossed, and for k of them up to k²
//! tests of circles, though few are that lopsided.

mod entering;

use super::around::{list_ring, next_of_three, previous_of_three};
use super::{Delaunay, Geometry};
use crate::complex::{Corners, Facet, INFINITE, Row};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;

/// What is in the way of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum InTheWay {
    /// A vertex on it.
    Site(VertexId),
    /// An edge that has to be there, too.
    Edge([SiteId; 2]),
}

/// The cells that segments take the place of, as they are in the Delaunay triangulation.
#[derive(Debug)]
pub(crate) struct Replaced<G: Geometry> {
    rows: Vec<Row<G::Corners>>,
}

impl<G: Geometry> Default for Replaced<G> {
    fn default() -> Self {
        Replaced { rows: Vec::new() }
    }
}

impl<G: Geometry> Replaced<G> {
    /// Whether no segment was missing.
    pub(crate) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    pub(crate) fn clear(&mut self) {
        self.rows.clear();
    }

    pub(crate) fn copied(&self) -> Result<Self> {
        Ok(Replaced { rows: memory::copy_of(&self.rows)? })
    }

    /// The cells have other slots now, by their old ones.
    pub(crate) fn renumber_slots(&mut self, index: &[Slot]) {
        self.rows.iter_mut().for_each(|row| row.renumber_slots(index));
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.rows)
    }
}

/// What a segment passes on its way.
#[derive(Clone, Copy, Debug)]
enum Passed {
    /// Into this cell.
    Cell(Slot),
    /// The edge between these sites, the one on the right first.
    Edge([SiteId; 2]),
    /// A site on the segment.
    Site(SiteId),
    /// The other end.
    End,
}

/// An edge with a polygon to its left that waits for its triangles.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    edge: [SiteId; 2],
    /// Which part of the list of corners the polygon has.
    part: [usize; 2],
    /// The facet at the edge of the triangle that has been made on its other side.
    facet: Facet,
}

/// Scratch memory of one segment after the other.
#[derive(Debug, Default)]
pub(crate) struct Crossing {
    cells: Vec<Slot>,
    /// The edges between one of the cells and the next.
    crossed: Vec<[SiteId; 2]>,
    /// The corners of the polygon to the left, from the first end to the second, both ends left out; and to the right.
    left: Vec<SiteId>,
    right: Vec<SiteId>,
    /// The facets beyond the boundary of the cells to the left, from the first end to the second; and to the right.
    beyond_left: Vec<Facet>,
    beyond_right: Vec<Facet>,
    waiting: Vec<Waiting>,
    /// Edges with cells on both sides that the segment crosses, and the facets that have been made there.
    twice: Vec<([SiteId; 2], Facet)>,
}

impl Crossing {
    pub(crate) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.cells)
            + memory::bytes_of(&self.crossed)
            + memory::bytes_of(&self.left)
            + memory::bytes_of(&self.right)
            + memory::bytes_of(&self.beyond_left)
            + memory::bytes_of(&self.beyond_right)
            + memory::bytes_of(&self.waiting)
            + memory::bytes_of(&self.twice)
    }
}

/// Orientations along segments, in the plane; in space there are none.
impl<G: Geometry> Delaunay<G> {
    /// The orientation of three sites of the plane.
    fn turn(&self, [a, b, c]: [SiteId; 3]) -> f64 {
        let place = |s| self.place(s);
        G::orient(&self.filter, &[place(a), place(b), place(c)])
    }

    /// Whether `b`, which is on a line with `u` and `v`, is on the same side of `u` as `v`.
    fn is_towards(&self, [u, v, b]: [SiteId; 3]) -> bool {
        let [u, v, b] = [u, v, b].map(|s| self.place(s));
        let axis = if u[0] == v[0] { 1 } else { 0 };
        (v[axis] > u[axis]) == (b[axis] > u[axis])
    }

    /// Follows the segment from `u` to `v` through the cells, which are a triangulation, constrained or not.
    fn follow_segment(&self, [u, v]: [SiteId; 2], mut pass: impl FnMut(Passed) -> Result<()>) -> Result<()> {
        let mut from = u;
        'sites: loop {
            // The cell around the site through whose opposite edge the segment goes, or the next site on it.
            let (mut on, mut through) = (None, None);
            list_ring(&self.complex, self.site(from).cell, from, |slot, i| {
                let cell = self.complex.cell(slot);
                if cell.is_ghost() {
                    return Ok(());
                }
                let [a, b] = [next_of_three(i), previous_of_three(i)].map(|k| cell.corners[k]);
                let [to_a, to_b] = [a, b].map(|s| self.turn([from, v, s]));
                for (s, turn) in [(a, to_a), (b, to_b)] {
                    if turn == 0.0 && self.is_towards([from, v, s]) {
                        on = Some(s);
                    }
                }
                if to_a < 0.0 && to_b > 0.0 {
                    through = Some((slot, i, [a, b]));
                }
                Ok(())
            })?;
            if let Some(s) = on {
                if s == v {
                    return pass(Passed::End);
                }
                pass(Passed::Site(s))?;
                from = s;
                continue;
            }
            // Both ends are sites, so the segment is in the hull.
            let Some((mut cell, mut corner, [mut a, mut b])) = through else { return pass(Passed::End) };
            pass(Passed::Cell(cell))?;
            loop {
                pass(Passed::Edge([a, b]))?;
                let across = self.complex.cell(cell).neighbour(corner);
                (cell, corner) = (across.cell(), across.index());
                pass(Passed::Cell(cell))?;
                let apex = self.complex.cell(cell).corners[corner];
                if apex == v {
                    return pass(Passed::End);
                }
                let turn = self.turn([from, v, apex]);
                if turn == 0.0 {
                    pass(Passed::Site(apex))?;
                    from = apex;
                    continue 'sites;
                }
                // The edge that is left through next is opposite the corner on the apex's side.
                let gone = if turn > 0.0 {
                    std::mem::replace(&mut b, apex)
                } else {
                    std::mem::replace(&mut a, apex)
                };
                corner = self.complex.cell(cell).index_of(gone);
            }
        }
    }

    /// Whether two segments, of ends that are apart, cross at a place that is an end of neither.
    pub(crate) fn do_cross(&self, [a, b]: [SiteId; 2], [c, d]: [SiteId; 2]) -> bool {
        let are_apart = |u, v, s, t| {
            let [to_s, to_t] = [s, t].map(|s| self.turn([u, v, s]));
            to_s.min(to_t) < 0.0 && to_s.max(to_t) > 0.0
        };
        let is_shared = [c, d].contains(&a) || [c, d].contains(&b);
        !is_shared && are_apart(a, b, c, d) && are_apart(c, d, a, b)
    }

    /// The finite cells to the left and to the right of an edge, seen from its first site; their facets are the edge.
    pub(crate) fn cells_beside(&self, [u, v]: [SiteId; 2]) -> Result<[Option<Facet>; 2]> {
        let mut sides = [None; 2];
        list_ring(&self.complex, self.site(u).cell, u, |slot, i| {
            let cell = self.complex.cell(slot);
            let [next, previous] = [next_of_three(i), previous_of_three(i)];
            if cell.is_ghost() {
                return Ok(());
            }
            if cell.corners[next] == v {
                sides[0] = Some(Facet::new(slot, previous));
            } else if cell.corners[previous] == v {
                sides[1] = Some(Facet::new(slot, next));
            }
            Ok(())
        })?;
        Ok(sides)
    }

    /// Tells the finite cells around a site of the plane.
    pub(crate) fn for_cells_around(&self, s: SiteId, mut told: impl FnMut(Slot) -> Result<()>) -> Result<()> {
        list_ring(&self.complex, self.site(s).cell, s, |slot, _| {
            if self.complex.cell(slot).is_ghost() { Ok(()) } else { told(slot) }
        })
    }

    /// Whether a place is on the line through a facet of a finite cell of the plane.
    pub(crate) fn is_on_facet(&self, facet: Facet, q: &G::Point) -> bool {
        let filter = self.filter_for(q);
        let corners = &self.complex.cell(facet.cell()).corners;
        G::orientation_with(&filter, self.view(), corners, facet.index(), q) == 0.0
    }

    /// Whether a slot, or none, holds a cell with this edge.
    pub(crate) fn has_edge(&self, slot: Slot, [u, v]: [SiteId; 2]) -> bool {
        slot.index() < self.complex.n_slots() && self.complex.is_live(slot) && {
            let corners = self.complex.cell(slot).corners;
            corners.as_ref().contains(&u) && corners.as_ref().contains(&v)
        }
    }

    /// A cell with this edge, [`Slot::NONE`] if the sites share none.
    pub(crate) fn find_edge(&self, [u, v]: [SiteId; 2]) -> Result<Slot> {
        let mut found = Slot::NONE;
        list_ring(&self.complex, self.site(u).cell, u, |slot, _| {
            if self.complex.cell(slot).corners.as_ref().contains(&v) {
                found = slot;
            }
            Ok(())
        })?;
        Ok(found)
    }

    /// Looks along a segment that is missing, while no cell has been replaced. Tells what is in the way; if nothing is,
    /// keeps the cells that it crosses.
    pub(crate) fn look_along(
        &mut self,
        ends: [SiteId; 2],
        has_to_be: impl Fn([SiteId; 2]) -> bool,
        crossing: &mut Crossing,
        replaced: &mut Replaced<G>,
        mut is_in_the_way: impl FnMut(InTheWay) -> Result<()>,
    ) -> Result<()> {
        let (cells, mut is_free) = (&mut crossing.cells, true);
        cells.clear();
        self.follow_segment(ends, |passed| {
            let found = match passed {
                Passed::Cell(cell) => return memory::push(cells, cell),
                Passed::Edge(edge) if has_to_be(edge) => InTheWay::Edge(edge),
                Passed::Site(site) => InTheWay::Site(self.site(site).id),
                Passed::Edge(_) | Passed::End => return Ok(()),
            };
            is_free = false;
            is_in_the_way(found)
        })?;
        if is_free {
            // A cell that two segments cross is marked the second time.
            for &cell in &*cells {
                if self.complex.mark(cell) == 0 {
                    memory::push(&mut replaced.rows, self.complex.row(cell))?;
                    self.complex.set_mark(cell, 1);
                }
            }
        }
        Ok(())
    }

    /// Clears the marks that [`look_along`](Self::look_along) has left.
    pub(crate) fn end_looking(&mut self, replaced: &Replaced<G>) {
        replaced.rows.iter().for_each(|row| self.complex.set_mark(row.slot, 0));
    }

    /// Exchanges the edges that have to be there, each with the lower site first, sorted.
    pub(crate) fn exchange_required(&mut self, edges: &mut Vec<[SiteId; 2]>) {
        std::mem::swap(&mut self.required, edges);
    }

    /// Whether an edge has to be there.
    pub(crate) fn is_required(&self, [s, t]: [SiteId; 2]) -> bool {
        self.required.binary_search(&if s < t { [s, t] } else { [t, s] }).is_ok()
    }

    /// Whether the edge opposite a corner of a cell of the plane has to be there.
    pub(crate) fn is_facet_required(&self, cell: Slot, i: usize) -> bool {
        !self.required.is_empty() && {
            let corners = &self.complex.cell(cell).corners;
            self.is_required([next_of_three(i), previous_of_three(i)].map(|k| corners[k]))
        }
    }

    /// Whether a facet is there only because it has to be.
    pub(crate) fn is_facet_held(&self, cell: Slot, i: usize) -> bool {
        let is_inner = !self.complex.cell(cell).is_ghost();
        is_inner && self.is_facet_required(cell, i) && !self.is_locally_delaunay(Facet::new(cell, i))
    }

    /// A change has been undone: whether some cell is not one of the Delaunay triangulation.
    pub(crate) fn set_constrained(&mut self, is_constrained: bool) {
        self.is_constrained = is_constrained;
    }

    /// Whether some cell is not one of the Delaunay triangulation.
    pub(crate) fn is_constrained(&self) -> bool {
        self.is_constrained
    }

    /// The cells that segments have taken the place of, where the cells are the constrained Delaunay triangulation for the
    /// edges that have to be there: by flips, which are undone.
    pub(crate) fn find_replaced(&mut self) -> Result<Replaced<G>> {
        let mut replaced = Replaced::default();
        let (mut suspects, mut stuck) = (Vec::new(), Vec::new());
        for slot in self.complex.finite() {
            for i in (0..3).filter(|&i| self.is_facet_held(slot, i)) {
                memory::push(&mut suspects, Facet::new(slot, i))?;
            }
        }
        if suspects.is_empty() {
            return Ok(replaced);
        }
        self.begin()?;
        let flipped = self.flip_all(&mut suspects, &mut stuck, u64::MAX);
        let kept = flipped.and_then(|_| {
            memory::collect(
                &mut replaced.rows,
                self.complex.rows().iter().map(|row| self.complex.row(row.slot)),
            )
        });
        self.undo();
        kept?;
        self.is_constrained = true;
        Ok(replaced)
    }

    /// Puts back the cells that segments have taken the place of: then the cells are the Delaunay triangulation.
    pub(crate) fn put_back_replaced(&mut self, replaced: &Replaced<G>) -> Result<()> {
        self.complex.note_all(replaced.rows.iter().map(|row| row.slot))?;
        self.complex.undo_rows(replaced.rows.iter().copied());
        for row in &replaced.rows {
            for i in 0..G::Corners::N {
                if row.corners[i] != INFINITE {
                    self.sites[row.corners[i]].cell = row.slot;
                }
            }
        }
        if let Some(row) = replaced.rows.first() {
            self.recent = row.slot;
        }
        self.is_constrained = false;
        Ok(())
    }
}
