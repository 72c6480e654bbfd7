//! Walks through triangles to a place.

use super::mesh::Mesh;
use super::parts::{NONE, Side};
use crate::error::Result;
use crate::predicates;

/// Greatest number of triangles between a place and where rounding puts it.
const MAX_STEPS: usize = 8;

/// Where a place is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// In this triangle, maybe on a side that is no segment.
    Inside(u32),
    /// Behind a segment, or on it: the piece, seen from where the walk began.
    Behind(u32),
    /// At a vertex, or out of reach.
    Nowhere,
}

impl Mesh<'_> {
    /// Walks straight from the corner opposite a side of a triangle, which it leaves by that side if at all, to `p`.
    pub(super) fn walk(&mut self, from: Side, p: &[f64; 2]) -> Result<Place> {
        let origin = self.apex(from);
        let mut side = from;
        // No triangle is entered twice.
        for _ in 0..=self.n_triangles() {
            let triangle = self.triangle(side.triangle());
            let beyond = -self.turn(triangle.ends(side.index()), p);
            let piece = triangle.pieces[side.index()];
            if beyond < 0.0 || (beyond == 0.0 && piece == NONE) {
                return self.settle(side.triangle(), p);
            }
            if piece != NONE {
                return Ok(Place::Behind(piece));
            }
            let entered = self.cross(side)?;
            if entered == Side::NONE {
                return Ok(Place::Nowhere);
            }
            // The way goes between the apex and the end of the side that is not on the apex's side of it.
            let apex = self.point(self.apex(entered));
            let is_left = predicates::orient2d(&self.filter, self.point(origin), p, apex) > 0.0;
            side = if is_left { entered.next() } else { entered.previous() };
        }
        Ok(Place::Nowhere)
    }

    /// Where a place is that should be in this triangle, and is in it or, by rounding, near it.
    fn settle(&mut self, mut t: u32, p: &[f64; 2]) -> Result<Place> {
        'near: for _ in 0..MAX_STEPS {
            let triangle = *self.triangle(t);
            if triangle.corners.iter().any(|&v| self.point(v) == p) {
                return Ok(Place::Nowhere);
            }
            for i in 0..3 {
                let turn = self.turn(triangle.ends(i), p);
                if turn > 0.0 || (turn == 0.0 && triangle.pieces[i] == NONE) {
                    continue;
                }
                if triangle.pieces[i] != NONE {
                    return Ok(Place::Behind(triangle.pieces[i]));
                }
                if triangle.across[i] == Side::NONE {
                    return Ok(Place::Nowhere);
                }
                t = self.cross(Side::new(t, i))?.triangle();
                continue 'near;
            }
            return Ok(Place::Inside(t));
        }
        Ok(Place::Nowhere)
    }
}
