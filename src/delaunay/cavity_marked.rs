//! Conflict zones in the plane where vertices go when one comes: with weights, the zone of a site may have others inside.
//!
//! Such a zone is no tree of triangles, so its cells are marked as they are found. Its rim is one polygon around the site, of which
//! each corner starts one edge: while new triangles are glued, the corner's `cell` is that of the triangle at this edge.

use super::Delaunay;
use super::above::Swallowed;
use super::geometry::Insert;
use super::shape::PowerPlane;
use crate::complex::{Facet, INFINITE};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::predicates::WeightedPoint;

/// Mark of a cell of the zone.
const IN_ZONE: u8 = 1;

/// An edge of the rim, which is counter-clockwise, and the new cell there.
#[derive(Clone, Copy, Debug)]
struct RimEdge {
    start: SiteId,
    end: SiteId,
    /// The edge seen from outside the zone.
    out: Facet,
    cell: Slot,
}

/// Scratch memory.
#[derive(Debug, Default)]
pub struct Scratch {
    zone: Vec<Slot>,
    rim: Vec<RimEdge>,
    n_ghosts: usize,
}

impl Insert<PowerPlane> for Scratch {
    fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.zone) + memory::bytes_of(&self.rim)
    }

    fn insert<const BUILD: bool>(
        &mut self,
        t: &mut Delaunay<PowerPlane>,
        start: Slot,
        s: SiteId,
    ) -> Result<Slot> {
        let made_room = self.dig(t, start, s).and_then(|()| self.reserve::<BUILD>(t));
        if let Err(error) = made_room.and_then(|()| self.swallow(t)) {
            self.zone.iter().for_each(|&cell| t.complex.set_mark(cell, 0));
            return Err(error);
        }
        t.complex.retire_ghosts(self.n_ghosts);
        let reused = self.zone.len().min(self.rim.len());
        for &cell in &self.zone[reused..] {
            t.complex.release(cell);
        }
        for (row, &cell) in self.rim.iter_mut().zip(&self.zone) {
            row.cell = cell;
        }
        for row in &mut self.rim[reused..] {
            row.cell = t.complex.create_blank(start);
        }
        self.fill(t, s);
        Ok(self.rim[0].cell)
    }

    fn made(&self) -> impl ExactSizeIterator<Item = Slot> + '_ {
        self.rim.iter().map(|row| row.cell)
    }
}

impl Scratch {
    /// Finds the zone of `s` from one cell of it, and its rim. After an error the zone is what has been marked.
    fn dig(&mut self, t: &mut Delaunay<PowerPlane>, start: Slot, s: SiteId) -> Result<()> {
        let (q, id): (WeightedPoint<2>, _) = (t.site(s).point, t.site(s).id);
        self.zone.clear();
        self.rim.clear();
        self.n_ghosts = 0;
        memory::push(&mut self.zone, start)?;
        t.complex.set_mark(start, IN_ZONE);
        let mut next = 0;
        while let Some(&cell) = self.zone.get(next) {
            next += 1;
            let cell = *t.complex.cell(cell);
            self.n_ghosts += usize::from(cell.is_ghost());
            for i in 0..3 {
                let out = cell.neighbour(i);
                if t.complex.mark(out.cell()) == IN_ZONE {
                    continue;
                }
                if t.is_in_conflict(out.cell(), &q, id) {
                    memory::push(&mut self.zone, out.cell())?;
                    t.complex.set_mark(out.cell(), IN_ZONE);
                } else {
                    let [start, end] = [cell.corners[(i + 1) % 3], cell.corners[(i + 2) % 3]];
                    memory::push(&mut self.rim, RimEdge { start, end, out, cell: Slot::NONE })?;
                }
            }
        }
        Ok(())
    }

    /// Makes room for all that the new cells need.
    fn reserve<const BUILD: bool>(&self, t: &mut Delaunay<PowerPlane>) -> Result<()> {
        let n_created = self.rim.len().saturating_sub(self.zone.len());
        t.complex.reserve(n_created)?;
        if !BUILD {
            t.complex.note_all(self.zone.iter().copied())?;
            t.complex.reserve_rows(n_created)?;
        }
        t.reserve_record(self.rim.len())
    }

    /// Lists the sites inside the zone, which the new one hides, and loosens what is above its cells.
    fn swallow(&self, t: &mut Delaunay<PowerPlane>) -> Result<()> {
        let mut swallowed = Swallowed::begin(t);
        // A polygon of triangles has two edges more than triangles, and two less for each vertex inside.
        if self.rim.len() < self.zone.len() + 2 {
            self.rim.iter().for_each(|row| swallowed.spare(t, [row.start], row.out.cell()));
            self.zone.iter().try_for_each(|&cell| swallowed.look_at(t, cell))?;
        }
        swallowed.end(t, self.zone.iter().copied());
        Ok(())
    }

    /// Joins each edge of the rim to the site.
    fn fill(&self, t: &mut Delaunay<PowerPlane>, s: SiteId) {
        // The facet of the new cell at an edge that is opposite the edge's start, or its end. The ghost vertex comes last.
        let opposite_start = |row: &RimEdge| Facet::new(row.cell, if row.start == INFINITE { 2 } else { 1 });
        let opposite_end = |row: &RimEdge| Facet::new(row.cell, if row.start == INFINITE { 0 } else { 2 });
        for (k, row) in self.rim.iter().enumerate() {
            // For now, where the edge is listed: no slot.
            t.corner_mut(row.start).cell = Slot::at(k);
        }
        for row in &self.rim {
            let is_ghost = row.start == INFINITE;
            let corners = if is_ghost { [row.end, s, INFINITE] } else { [s, row.start, row.end] };
            t.complex.put(row.cell, corners);
            t.complex.glue(Facet::new(row.cell, usize::from(is_ghost)), row.out);
        }
        for row in &self.rim {
            let next = &self.rim[t.site(row.end).cell.index()];
            t.complex.glue(opposite_start(row), opposite_end(next));
        }
        for row in &self.rim {
            t.corner_mut(row.start).cell = row.cell;
        }
    }
}
