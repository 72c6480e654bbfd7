//! A segment that is entered: the cells that it crosses go, and the polygons on its two sides are triangulated.

use super::{Crossing, Passed, Waiting};
use crate::complex::{Corners, Facet};
use crate::delaunay::{Delaunay, Geometry};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;

impl<G: Geometry> Delaunay<G> {
    /// Enters a segment that has been [looked along](Self::look_along), unless it crosses one that has been entered since.
    /// Returns whether it is there.
    pub(crate) fn enter_segment(
        &mut self,
        ends: [SiteId; 2],
        has_to_be: impl Fn([SiteId; 2]) -> bool,
        crossing: &mut Crossing,
    ) -> Result<bool> {
        let Crossing { cells, crossed, left, right, .. } = crossing;
        cells.clear();
        crossed.clear();
        left.clear();
        right.clear();
        let mut is_free = true;
        self.follow_segment(ends, |passed| match passed {
            Passed::Cell(cell) => memory::push(cells, cell),
            Passed::Edge([a, b]) => {
                is_free &= !has_to_be([a, b]);
                memory::push(crossed, [a, b])?;
                for (side, s) in [(&mut *right, a), (&mut *left, b)] {
                    if side.last() != Some(&s) {
                        memory::push(side, s)?;
                    }
                }
                Ok(())
            }
            Passed::Site(_) | Passed::End => Ok(()),
        })?;
        if !is_free {
            return Ok(false);
        }
        self.list_beyond(crossing)?;
        let Crossing { cells, left, right, beyond_left, beyond_right, waiting, twice, .. } = crossing;
        self.complex.note_all(cells.iter().copied())?;
        memory::reserve(waiting, cells.len() + 1)?;
        twice.clear();
        memory::reserve(twice, beyond_left.len() + beyond_right.len())?;
        // The corners of each side in counter-clockwise order, and what is beyond them in the order of `fill_side`.
        right.reverse();
        beyond_left.reverse();
        cells.iter().for_each(|&cell| self.complex.set_mark(cell, 1));
        let (to_left, to_right) = cells.split_at(left.len());
        let sides =
            [(ends, to_left, &*left, &*beyond_left), ([ends[1], ends[0]], to_right, &*right, &*beyond_right)];
        for (base, cells, corners, beyond) in sides {
            self.fill_side(base, cells, corners, beyond, waiting, twice);
        }
        cells.iter().for_each(|&cell| self.complex.set_mark(cell, 0));
        self.complex.glue(Facet::new(to_left[0], 2), Facet::new(to_right[0], 2));
        for &([a, b], facet) in &*twice {
            let other = twice.iter().find(|(edge, _)| *edge == [b, a]);
            self.complex.glue(facet, other.expect("a polygon goes there and back").1);
        }
        self.recent = cells[0];
        self.is_constrained = true;
        Ok(true)
    }

    /// Lists what is beyond the cells that a segment crosses.
    fn list_beyond(&self, crossing: &mut Crossing) -> Result<()> {
        let Crossing { cells, crossed, beyond_left, beyond_right, .. } = crossing;
        beyond_left.clear();
        beyond_right.clear();
        memory::reserve(beyond_left, cells.len())?;
        memory::reserve(beyond_right, cells.len())?;
        for (k, &slot) in cells.iter().enumerate() {
            let cell = self.complex.cell(slot);
            let beyond = |opposite| cell.neighbour(cell.index_of(opposite));
            if k == 0 || k == crossed.len() {
                let [a, b] = crossed[k.min(crossed.len() - 1)];
                beyond_left.push(beyond(a));
                beyond_right.push(beyond(b));
            } else if crossed[k][0] == crossed[k - 1][0] {
                beyond_left.push(beyond(crossed[k][0]));
            } else {
                beyond_right.push(beyond(crossed[k][1]));
            }
        }
        Ok(())
    }

    /// Triangulates the polygon to the left of an edge into as many slots as it has corners beside the edge's ends. The
    /// facet of the first triangle that is the edge, which is opposite its last corner, is left as it is. `beyond`: what is
    /// beyond the other edges, from the end of `base` to its beginning.
    fn fill_side(
        &mut self,
        base: [SiteId; 2],
        slots: &[Slot],
        corners: &[SiteId],
        beyond: &[Facet],
        waiting: &mut Vec<Waiting>,
        twice: &mut Vec<([SiteId; 2], Facet)>,
    ) {
        let (mut slots, mut beyond) = (slots.iter(), beyond.iter());
        let first = slots.as_slice()[0];
        waiting.push(Waiting { edge: base, part: [0, corners.len()], facet: Facet::new(first, 2) });
        while let Some(Waiting { edge: [a, b], part: [from, end], facet }) = waiting.pop() {
            if from == end {
                let other = *beyond.next().expect("a facet beyond each edge");
                if self.complex.mark(other.cell()) == 0 {
                    self.complex.glue(facet, other);
                } else {
                    twice.push(([a, b], facet));
                }
                continue;
            }
            let best = self.apex_of([a, b], corners, [from, end]);
            let (slot, c) = (*slots.next().expect("a slot for each corner"), corners[best]);
            let mut row = G::Corners::filled(a);
            (row[1], row[2]) = (b, c);
            self.complex.put(slot, row);
            self.complex.set_mark(slot, 1);
            if slot != first {
                self.complex.glue(facet, Facet::new(slot, 2));
            }
            [a, b, c].into_iter().for_each(|s| self.sites[s].cell = slot);
            waiting.push(Waiting { edge: [a, c], part: [from, best], facet: Facet::new(slot, 1) });
            waiting.push(Waiting { edge: [c, b], part: [best + 1, end], facet: Facet::new(slot, 0) });
        }
    }

    /// Which of some corners makes a triangle with an edge whose circle has no other of them inside.
    fn apex_of(&self, [a, b]: [SiteId; 2], corners: &[SiteId], [from, end]: [usize; 2]) -> usize {
        let mut best = from;
        for k in from + 1..end {
            let mut cell = G::Corners::filled(a);
            (cell[1], cell[2]) = (b, corners[best]);
            let (place, id) = (*self.place(corners[k]), self.site(corners[k]).id);
            if G::is_in_sphere(&self.filter, self.view(), &cell, &place, id) {
                best = k;
            }
        }
        best
    }
}
