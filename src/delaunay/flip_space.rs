//! Flips in space, while there are any, and the way back.
//!
//! A facet that fails the empty-sphere test is flipped if a 2-3 or a 3-2 flip there makes positive cells (Joe,
//! 10.1016/0167-8396(91)90038-D). Every flip lowers the lifted surface, so there is an end; but unlike in the plane it can
//! be stuck short of the Delaunay triangulation. The cells that a flip is about to change are kept in a journal, so that all
//! can be as it was.

use super::{Delaunay, Dimension, Space};
use crate::complex::{Facet, Undo};
use crate::error::Result;

impl Delaunay<Space> {
    /// Flips until no facet fails or those that do are stuck; see [`Dimension::flip_all`].
    pub(super) fn flip_while_possible(
        &mut self,
        suspects: &mut Vec<Facet>,
        stuck: &mut Vec<Facet>,
    ) -> Result<u64> {
        self.journal.clear();
        let (mut flips, mut before) = (0, 0);
        let mut recent = self.recent;
        loop {
            while let Some(facet) = suspects.pop() {
                // The cell of a facet may have gone; then those around it are suspects, too.
                if self.complex.is_free(facet.cell()) || self.complex.cell(facet.cell()).is_ghost() {
                    continue;
                }
                self.certificates += 1;
                if self.is_locally_delaunay(facet) {
                    continue;
                }
                self.complex.reserve(1)?;
                let Some(outer) = self.flip_facet(facet) else {
                    stuck.push(facet);
                    continue;
                };
                flips += 1;
                recent = outer[0].cell();
                for facet in outer {
                    for s in self.complex.cell(facet.cell()).corners {
                        self.corner_mut(s).cell = facet.cell();
                    }
                }
                suspects.extend(outer);
            }
            if stuck.is_empty() {
                // A flip may have freed the cell that was the recent one. If all are undone it comes back.
                self.recent = recent;
                // Nothing will be undone. Keep the memory for a few flips, not for those of a whole large set.
                if let Some(changed) = &mut self.changed {
                    changed.extend(self.journal.iter().flat_map(Undo::cells));
                }
                self.journal.clear();
                self.journal.shrink_to(self.sites.len() / 16);
                return Ok(flips);
            }
            if flips == before {
                return Ok(flips);
            }
            // What was stuck may not be any more.
            std::mem::swap(suspects, stuck);
            before = flips;
        }
    }

    /// Flips a failing facet if that makes positive cells; returns the facets around them.
    fn flip_facet(&mut self, facet: Facet) -> Option<[Facet; 6]> {
        let (c, i) = (facet.cell(), facet.index());
        let cell = *self.complex.cell(c);
        let across = cell.neighbour(i);
        let q = self.complex.apex(across);
        let others = [(i + 1) % 4, (i + 2) % 4, (i + 3) % 4];
        // Whether the cell is positive with q in place of each corner of the facet.
        let point = &self.site(q).point;
        let positive =
            others.map(|k| Space::orientation_with(&self.filter, self.view(), &cell.corners, k, point) > 0.0);
        let (outer, undo) = match positive {
            [true, true, true] => self.complex.flip_2_3(facet),
            // The segment between the opposing vertices passes the facet beyond the edge opposite one corner.
            [false, true, true] => self.complex.flip_3_2(facet, others[0])?,
            [true, false, true] => self.complex.flip_3_2(facet, others[1])?,
            [true, true, false] => self.complex.flip_3_2(facet, others[2])?,
            _ => return None,
        };
        self.journal.push(undo);
        Some(outer)
    }

    /// Takes the flips of the last [`flip_while_possible`](Self::flip_while_possible) back.
    pub(super) fn undo_flips(&mut self) {
        while let Some(undo) = self.journal.pop() {
            self.complex.undo(&undo);
            for cell in undo.brought_back() {
                for s in self.complex.cell(cell).corners {
                    self.corner_mut(s).cell = cell;
                }
            }
        }
    }
}
