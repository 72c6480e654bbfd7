//! Where pieces of segments are split, and at which angles between segments that is at shells.

use super::criteria::{distance, power_of_two_below};
use super::parts::{NONE, Piece, Side};
use super::refining::Refinement;
use crate::error::Result;
use crate::ids::VertexId;
use crate::predicates::{dot, is_in_diametral_circle, minus};

/// Squared cosine of an angle between segments from which on they are split at shells: that of 60 degrees.
const SHARP: f64 = 0.25;

impl Refinement<'_> {
    /// Splits a piece: in the middle, or, at a small angle with another segment, at a round distance from its apex, so that
    /// what is on both is on common shells.
    pub(super) fn split(&mut self, piece: u32) -> Result<()> {
        if !self.may_split(piece) {
            return Ok(());
        }
        let ends = self.mesh.pieces[piece as usize].ends;
        let [p, q] = ends.map(|v| *self.mesh.point(v));
        let share = match self.apex_of_shells(piece) {
            None => {
                self.clear_circle(piece)?;
                0.5
            }
            Some(apex) => {
                let [d, e] = [p, q].map(|p| distance(self.mesh.point(apex), &p));
                (round_between(d.min(e), d.max(e)) - d) / (e - d)
            }
        };
        let middle = [0, 1].map(|axis| {
            let x = p[axis] + share * (q[axis] - p[axis]);
            x.clamp(p[axis].min(q[axis]), p[axis].max(q[axis])) + 0.0
        });
        let id = VertexId::at(self.mesh.points.len());
        if middle == p || middle == q || !self.mesh.dig_at_piece(piece, &middle, id)? {
            self.mesh.pieces[piece as usize].is_fixed = true;
            self.n_unsplit += 1;
            return Ok(());
        }
        self.add(middle, NONE, Some(piece))
    }

    /// Where a piece makes a small angle with another segment: at one of its ends, with a triangle in between, or further
    /// along the segments, where a vertex of the other one encroaches it.
    fn apex_of_shells(&self, piece: u32) -> Option<VertexId> {
        let Piece { ends, segment, .. } = self.mesh.pieces[piece as usize];
        if let Some(end) = [1, 0].into_iter().find(|&end| self.is_sharp(piece, end)) {
            return Some(ends[end]);
        }
        let own = self.origins.of_segments[segment as usize];
        let of_other = self
            .selected_sides(piece)
            .filter(|&side| self.is_encroached_from(side))
            .map(|side| self.mesh.apex(side));
        of_other.filter(|&v| self.on[v] != NONE && self.on[v] != own).find_map(|v| {
            let apex = self.common_end(own, self.on[v])?;
            let [d, e] = ends.map(|v| distance(self.mesh.point(apex), self.mesh.point(v)));
            // One of pieces that have moved may go around its apex.
            let is_outward =
                (d - e).abs() > 0.5 * distance(self.mesh.point(ends[0]), self.mesh.point(ends[1]));
            (is_outward && self.is_acute(apex, [ends[1], v])).then_some(apex)
        })
    }

    /// The vertex at which two originals meet.
    pub(super) fn common_end(&self, one: u32, other: u32) -> Option<VertexId> {
        let [one, other] = [one, other].map(|original| self.origins.ends[original as usize]);
        let is_there = |v: &VertexId| self.mesh.at.get(v.index()).is_some_and(|&t| t != NONE);
        one.into_iter().find(|v| other.contains(v)).filter(is_there)
    }

    /// Whether two vertices are seen from a third one under less than 60 degrees.
    fn is_acute(&self, apex: VertexId, others: [VertexId; 2]) -> bool {
        let [u, v] = others.map(|v| minus::<f64, 2>(self.mesh.point(v), self.mesh.point(apex)));
        let cosine = dot(&u, &v);
        cosine > 0.0 && cosine * cosine > SHARP * (dot(&u, &u) * dot(&v, &v))
    }

    /// Whether a piece makes a small angle at one of its ends with another one, with a triangle in between.
    fn is_sharp(&self, piece: u32, end: usize) -> bool {
        let Piece { ends, .. } = self.mesh.pieces[piece as usize];
        self.selected_sides(piece).any(|side| {
            let triangle = self.mesh.triangle(side.triangle());
            // The side at that end is opposite the other end.
            let other = (0..3).find(|&i| triangle.corners[i] == ends[1 - end]).expect("it is an end");
            if triangle.pieces[other] == NONE {
                return false;
            }
            self.is_acute(ends[end], [ends[1 - end], triangle.corners[side.index()]])
        })
    }

    /// Takes away vertices of this call that are on no segment, next to a piece and in its diametral circle: they are nearer
    /// to it than the vertex that it gets (Chew, 10.1145/160985.161150).
    fn clear_circle(&mut self, piece: u32) -> Result<()> {
        for k in 0..2 {
            loop {
                let side = self.mesh.sides_of(piece)[k];
                if side == Side::NONE || !self.mesh.triangle(side.triangle()).is_selected() {
                    break;
                }
                let apex = self.mesh.apex(side);
                let ends = self.mesh.pieces[piece as usize].ends.map(|v| self.mesh.point(v));
                let is_free = apex.index() >= self.n_given && self.on[apex] == NONE;
                if !is_free
                    || !is_in_diametral_circle(ends, self.mesh.point(apex))
                    || !self.mesh.find_hole(apex, &mut self.hole)?
                {
                    break;
                }
                self.mesh.replace(apex, &self.hole)?;
                self.n_added -= 1;
                self.examine_made()?;
            }
        }
        Ok(())
    }
}

/// The number between two others, away from both by a quarter of their difference, that is a multiple of the greatest
/// power of two.
fn round_between(low: f64, high: f64) -> f64 {
    let quarter = 0.25 * (high - low);
    let (low, high) = (low + quarter, high - quarter);
    let mut step = power_of_two_below(high);
    // Halves of steps soon fit, unless there is no number between.
    for _ in 0..128 {
        let round = (low / step).ceil() * step;
        if round <= high {
            return round;
        }
        step *= 0.5;
    }
    0.5 * (low + high)
}
