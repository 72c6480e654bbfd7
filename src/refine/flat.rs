//! Vertices that touch a piece of a segment.
//!
//! A vertex may be a few last places beside a piece, as one does that is meant to be on it. No vertex fits between the two,
//! and splitting the piece brings its ends nearer without end. So the vertex does not encroach the piece, the flat
//! triangles between both stay as they are, and the piece is split as if the vertex were one of its ends.

use super::parts::{NONE, Side};
use super::refinement::Refinement;
use crate::error::Result;
use crate::machine::memory;
use crate::predicates::{dot, minus};

/// Flat triangles that are looked at beside a piece.
const MAX_FLAT: usize = 64;

impl Refinement<'_> {
    /// Where on a piece, from 0 to 1, a middle is of the parts into which vertices divide it that touch it: of the part beside
    /// the cause, if that has room, otherwise of the longest one. Nothing where no vertex touches it.
    pub(super) fn middle_between_touching(
        &mut self,
        piece: u32,
        cause: Option<[f64; 2]>,
    ) -> Result<Option<f64>> {
        self.touching.clear();
        let [p, q] = self.mesh.pieces[piece as usize].ends.map(|v| *self.mesh.point(v));
        let u = minus::<f64, 2>(&q, &p);
        self.mesh.waiting.clear();
        for side in self.mesh.sides_of(piece).into_iter().filter(|&side| side != Side::NONE) {
            memory::push(&mut self.mesh.waiting, side)?;
        }
        for _ in 0..MAX_FLAT {
            let Some(side) = self.mesh.waiting.pop() else { break };
            let triangle = *self.mesh.triangle(side.triangle());
            if !triangle.is_selected() || !self.is_flat(side.triangle()) {
                continue;
            }
            let w = minus::<f64, 2>(self.mesh.point(self.mesh.apex(side)), &p);
            let share = dot(&w, &u) / dot(&u, &u);
            if share > 0.0 && share < 1.0 {
                memory::push(&mut self.touching, share)?;
            }
            for other in [side.next(), side.previous()] {
                if triangle.pieces[other.index()] == NONE {
                    let across = self.mesh.cross(other)?;
                    if across != Side::NONE {
                        memory::push(&mut self.mesh.waiting, across)?;
                    }
                }
            }
        }
        if self.touching.is_empty() {
            return Ok(None);
        }
        memory::push(&mut self.touching, 1.0)?;
        self.touching.sort_unstable_by(f64::total_cmp);
        let share_of_cause = cause.map(|cause| {
            let w = minus::<f64, 2>(&cause, &p);
            (dot(&w, &u) / dot(&u, &u)).clamp(0.0, 1.0)
        });
        let least = 2.0 * self.tests.resolution / dot(&u, &u).sqrt();
        let mut start = 0.0;
        let (mut longest, mut middle) = (0.0, 0.5);
        for &end in &self.touching {
            let is_beside = share_of_cause.is_some_and(|share| (start..=end).contains(&share));
            if is_beside && end - start > least {
                return Ok(Some(0.5 * (start + end)));
            }
            if end - start > longest {
                (longest, middle) = (end - start, 0.5 * (start + end));
            }
            start = end;
        }
        Ok(Some(middle))
    }

    /// The piece behind a side, across flat triangles there.
    pub(super) fn piece_behind(&mut self, side: Side) -> Result<Option<u32>> {
        let across = self.mesh.cross(side)?;
        self.piece_beyond(across)
    }

    /// The piece across flat triangles, of which the first one has this side; each is left by its longest side.
    pub(super) fn piece_beyond(&mut self, mut side: Side) -> Result<Option<u32>> {
        for _ in 0..MAX_FLAT {
            if side == Side::NONE {
                return Ok(None);
            }
            let triangle = *self.mesh.triangle(side.triangle());
            if !triangle.is_selected() || !self.is_flat(side.triangle()) {
                return Ok(None);
            }
            let squares = [0, 1, 2].map(|i| {
                let [p, q] = triangle.ends(i).map(|v| self.mesh.point(v));
                let u = minus::<f64, 2>(q, p);
                dot(&u, &u)
            });
            let longest = (0..3).fold(0, |most, i| if squares[i] > squares[most] { i } else { most });
            if longest == side.index() {
                return Ok(None);
            }
            if triangle.pieces[longest] != NONE {
                return Ok(Some(triangle.pieces[longest]));
            }
            side = self.mesh.cross(Side::new(side.triangle(), longest))?;
        }
        Ok(None)
    }

    pub(super) fn is_flat(&self, t: u32) -> bool {
        self.tests.is_flat(self.mesh.triangle(t).corners.map(|v| self.mesh.point(v)))
    }
}
