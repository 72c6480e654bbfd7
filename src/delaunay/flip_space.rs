//! Flips in space, while there are any, and the way back.
//!
//! A facet that fails the empty-sphere test is flipped if a 2-3 or a 3-2 flip there makes positive cells (Joe,
//! 10.1016/0167-8396(91)90038-D). Every flip lowers the lifted surface, so there is an end; but unlike in the plane it can
//! be stuck short of the Delaunay triangulation. The cells that a flip is about to change are kept in a journal, so that all
//! can be as it was.

use super::{Delaunay, Dimension, Space};
use crate::complex::{Facet, Journal};
use crate::error::Result;

impl Delaunay<Space> {
    /// Flips until no facet fails or those that do are stuck; see [`Dimension::flip_all`].
    pub(super) fn flip_while_possible(
        &mut self,
        suspects: &mut Vec<Facet>,
        stuck: &mut Vec<Facet>,
    ) -> Result<u64> {
        let mut journal = std::mem::take(&mut self.journal);
        self.complex.begin(&mut journal);
        let flips = self.flip_suspects(suspects, stuck, &mut journal);
        self.journal = journal;
        flips
    }

    /// Takes the flips of the last [`flip_while_possible`](Self::flip_while_possible) back.
    pub(super) fn undo_flips(&mut self) {
        self.complex.roll_back(&mut self.journal);
        for k in 0..self.journal.restored().len() {
            let c = self.journal.restored()[k];
            for s in self.complex.cell(c).corners {
                self.corner_mut(s).cell = c;
            }
        }
    }

    fn flip_suspects(
        &mut self,
        suspects: &mut Vec<Facet>,
        stuck: &mut Vec<Facet>,
        journal: &mut Journal<[u32; 4]>,
    ) -> Result<u64> {
        let (mut flips, mut before) = (0, 0);
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
                let Some((made, n_made)) = self.flip_facet(facet, journal) else {
                    stuck.push(facet);
                    continue;
                };
                flips += 1;
                for &cell in &made[..n_made] {
                    journal.made(cell);
                    for (i, s) in self.complex.cell(cell).corners.into_iter().enumerate() {
                        self.corner_mut(s).cell = cell;
                        suspects.push(Facet::new(cell, i));
                    }
                }
            }
            if stuck.is_empty() || flips == before {
                return Ok(flips);
            }
            // What was stuck may not be any more.
            std::mem::swap(suspects, stuck);
            before = flips;
        }
    }

    /// Flips a failing facet if that makes positive cells: two or three, which are returned.
    fn flip_facet(&mut self, facet: Facet, journal: &mut Journal<[u32; 4]>) -> Option<([u32; 3], usize)> {
        let (c, i) = (facet.cell(), facet.index());
        let cell = *self.complex.cell(c);
        let across = cell.neighbour(i);
        let q = self.complex.cell(across.cell()).corners[across.index()];
        let others = [(i + 1) % 4, (i + 2) % 4, (i + 3) % 4];
        // Whether the cell is positive with q in place of each corner of the facet.
        let point = &self.site(q).point;
        let positive = others
            .map(|k| Space::orientation_with(&self.filter, self.view(), &cell.corners, k, point) > 0.0);
        let [k, l, m] = match positive {
            [true, true, true] => {
                self.complex.save(&[c, across.cell()], journal);
                return Some((self.complex.flip_2_3(facet), 3));
            }
            [false, true, true] => others,
            [true, false, true] => [others[1], others[2], others[0]],
            [true, true, false] => [others[2], others[0], others[1]],
            _ => return None,
        };
        // The segment between the opposing vertices passes the facet beyond the edge from l to m.
        let third = cell.neighbour(k);
        if self.complex.cell(third.cell()).corners[third.index()] != q {
            return None;
        }
        self.complex.save(&[c, across.cell(), third.cell()], journal);
        let [a, b] = self.complex.flip_3_2(c, l, m)?;
        Some(([a, b, a], 2))
    }
}
