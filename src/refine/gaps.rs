//! Narrow gaps between segments.

use super::criteria::distance;
use super::parts::{NONE, next, previous, turn_of, turned};
use super::refinement::Refinement;
use crate::ids::VertexId;
use crate::predicates::{dot, minus};

/// A gap between two segments is narrow if it is below this share of the shorter one's length.
pub(super) const NARROW: f64 = 1.0 / 8192.0;

/// Two pieces have a gap between them, and not a corner, if the sine of their angle is no more than this.
const PARALLEL: f64 = 1.0 / 256.0;

/// The least sine of the angle between a piece and a way across a gap: one of two that are at right angles is above.
const ACROSS: f64 = 0.6;

/// Triangles that are crossed on a way to a piece.
const MAX_STEPS: usize = 256;

impl Refinement<'_> {
    /// Whether the middle of a triangle is in a narrow gap.
    pub(super) fn is_in_gap(&self, t: u32) -> bool {
        let triangle = self.mesh.triangle(t);
        if !self.tests.is_thin(triangle.corners.map(|v| self.mesh.point(v))) {
            return false;
        }
        // Whatever order the corners have.
        let p = turned(triangle.corners, turn_of(&triangle.corners)).map(|v| *self.mesh.point(v));
        let middle = [0, 1].map(|axis| (p[0][axis] + p[1][axis] + p[2][axis]) / 3.0);
        let edges = [0, 1, 2].map(|i| minus::<f64, 2>(&p[previous(i)], &p[next(i)]));
        let longest = edges.into_iter().reduce(|u, v| if dot(&v, &v) > dot(&u, &u) { v } else { u });
        let u = longest.expect("there are three");
        let length = dot(&u, &u).sqrt();
        let u = u.map(|x| x / length);
        // One of these goes across the gap, the other one may go along it.
        [[-u[1], u[0]], u].into_iter().any(|way| self.is_gap_along(t, &middle, way))
    }

    /// Whether a straight way of length 1, and back, leads to two pieces that have a narrow gap between them.
    fn is_gap_along(&self, t: u32, from: &[f64; 2], way: [f64; 2]) -> bool {
        let Some((one, to_one)) = self.piece_ahead(t, from, way) else { return false };
        let Some((other, to_other)) = self.piece_ahead(t, from, way.map(|x| -x)) else { return false };
        let pieces = [one, other].map(|piece| &self.mesh.pieces[piece as usize]);
        let originals = pieces.map(|piece| self.origins.of_segments[piece.segment as usize]);
        let [one, other] = pieces.map(|piece| {
            let [p, q] = piece.ends.map(|v| self.mesh.point(v));
            minus::<f64, 2>(q, p).map(|x| x / distance(p, q))
        });
        let [length, other_length] = originals.map(|original| self.origins.lengths[original as usize]);
        // From a common end on a gap is as narrow as the angle there.
        let [own, other_own] = originals;
        let sine = if self.common_end(own, other_own).is_some() { NARROW } else { PARALLEL };
        own != other_own
            && to_one + to_other < NARROW * length.min(other_length)
            && turn(one, other).abs() <= sine
            && turn(one, way).abs() >= ACROSS
    }

    /// The piece that a straight way of length 1 from the inside of a triangle leads to, and how far away it is.
    fn piece_ahead(&self, t: u32, from: &[f64; 2], way: [f64; 2]) -> Option<(u32, f64)> {
        let is_left = |v: VertexId| turn(way, minus::<f64, 2>(self.mesh.point(v), from)) >= 0.0;
        let mut seen = self.mesh.seen_from_sides(t);
        // A way leaves a triangle between a corner on its right and the next one, on its left.
        let mut i =
            (0..3).find(|&i| !is_left(seen.corners[next(i)]) && is_left(seen.corners[previous(i)]))?;
        for _ in 0..MAX_STEPS {
            let [u, w] = [next(i), previous(i)].map(|i| seen.corners[i]);
            let p = self.mesh.point(u);
            let side = minus::<f64, 2>(self.mesh.point(w), p);
            let far = turn(minus::<f64, 2>(p, from), side) / turn(way, side);
            if !(far < self.tests.widest_gap) {
                return None;
            }
            if seen.pieces[i] != NONE {
                return Some((seen.pieces[i], far));
            }
            seen = self.mesh.seen_from_sides(seen.beyond[i]?);
            let entered = (0..3).find(|&i| seen.corners[next(i)] == w).expect("neighbours share an edge");
            i = if is_left(seen.corners[entered]) { next(entered) } else { previous(entered) };
        }
        None
    }
}

fn turn(u: [f64; 2], w: [f64; 2]) -> f64 {
    u[0] * w[1] - u[1] * w[0]
}
