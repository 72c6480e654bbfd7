//! Narrow gaps between segments.
//!
//! Between two segments that are nearly parallel, and much longer than the gap is wide, cells without small angles are
//! as small as the gap, and as many as it is longer than wide. So what is in such a gap is left: triangles are not
//! mended for their angles, and pieces not split for what sees them across it. A triangle is in a gap if its middle is:
//! if straight ways from there, along or across its longest edge, lead to pieces of two segments. That depends on the
//! pieces alone, and not on the vertices between them. How narrow a gap is, is measured by the segments, and not by the
//! pieces, so that no gap comes to be wide as pieces are split.

use super::criteria::{NARROW, Tests, distance};
use super::mesh::Mesh;
use super::parts::{NONE, next, previous, turn_of, turned};
use super::refinement::Origins;
use crate::ids::VertexId;
use crate::predicates::{dot, minus};

/// The greatest sine of the angle between two pieces that have a gap between them, and not a corner.
const PARALLEL: f64 = 1.0 / 256.0;

/// The least sine of the angle between a piece and a way across a gap: one of two that are at right angles is above.
const ACROSS: f64 = 0.6;

/// Triangles that are crossed on a way to a piece.
const MAX_STEPS: usize = 256;

/// A narrow gap, at one place.
pub(super) struct NarrowGap {
    pub(super) width: f64,
    /// It would not be narrow if it were as wide as this.
    pub(super) limit: f64,
}

impl Mesh<'_> {
    /// The narrow gap in which the middle of a triangle is, which may not have been copied.
    pub(super) fn gap_around(&self, t: u32, tests: &Tests, origins: &Origins) -> Option<NarrowGap> {
        let (corners, _) = self.corners_of(t);
        self.gap_of(corners, t, tests, origins)
    }

    /// The narrow gap in which the middle of three vertices is, which is in this triangle.
    pub(super) fn gap_of(
        &self,
        corners: [VertexId; 3],
        t: u32,
        tests: &Tests,
        origins: &Origins,
    ) -> Option<NarrowGap> {
        // Whatever order the corners have.
        let p = turned(corners, turn_of(&corners)).map(|v| self.point(v));
        if !tests.is_thin(p) {
            return None;
        }
        let edges = [0, 1, 2].map(|i| minus::<f64, 2>(p[previous(i)], p[next(i)]));
        let longest = edges.into_iter().reduce(|u, v| if dot(&v, &v) > dot(&u, &u) { v } else { u })?;
        let length = dot(&longest, &longest).sqrt();
        let u = longest.map(|x| x / length);
        let middle = middle(p);
        [[-u[1], u[0]], u].into_iter().find_map(|way| self.gap_along(t, &middle, way, tests, origins))
    }

    /// The narrow gap that a straight way of length 1, and back, goes across.
    fn gap_along(
        &self,
        t: u32,
        from: &[f64; 2],
        way: [f64; 2],
        tests: &Tests,
        origins: &Origins,
    ) -> Option<NarrowGap> {
        let (one, to_one) = self.piece_ahead(t, from, way, tests.widest_gap)?;
        let (other, to_other) = self.piece_ahead(t, from, way.map(|x| -x), tests.widest_gap)?;
        let pieces = [one, other].map(|piece| &self.pieces[piece as usize]);
        let [one, other] = pieces.map(|piece| origins.of_segments[piece.segment as usize] as usize);
        let [u, v] = pieces.map(|piece| {
            let [p, q] = piece.ends.map(|v| self.point(v));
            minus::<f64, 2>(q, p).map(|x| x / distance(p, q))
        });
        // From a common end on, a gap is as wide as the angle there makes it.
        let is_common = |end: &&VertexId| {
            origins.ends[other].contains(end) && self.at.get(end.index()).is_some_and(|&t| t != NONE)
        };
        let apex = origins.ends[one].iter().find(is_common);
        let from_apex = apex.map_or(f64::INFINITY, |&apex| distance(self.point(apex), from));
        let length = origins.lengths[one].min(origins.lengths[other]).min(from_apex);
        let gap = NarrowGap { width: to_one + to_other, limit: NARROW * length };
        let is_narrow = one != other
            && gap.width < gap.limit
            && turn(u, v).abs() <= PARALLEL
            && turn(u, way).abs() >= ACROSS;
        is_narrow.then_some(gap)
    }

    /// The piece to which a straight way of length 1 leads from inside a triangle, if it is not farther than this, and
    /// how far it is.
    fn piece_ahead(&self, t: u32, from: &[f64; 2], way: [f64; 2], farthest: f64) -> Option<(u32, f64)> {
        let is_left = |v: VertexId| turn(way, minus::<f64, 2>(self.point(v), from)) >= 0.0;
        let mut seen = self.seen_from_sides(t);
        // It leaves a triangle between a corner on its right and the next one, on its left.
        let mut i =
            (0..3).find(|&i| !is_left(seen.corners[next(i)]) && is_left(seen.corners[previous(i)]))?;
        for _ in 0..MAX_STEPS {
            let [u, w] = [next(i), previous(i)].map(|i| seen.corners[i]);
            let p = self.point(u);
            let side = minus::<f64, 2>(self.point(w), p);
            let far = turn(minus::<f64, 2>(p, from), side) / turn(way, side);
            if far.is_nan() || far >= farthest {
                return None;
            }
            if seen.pieces[i] != NONE {
                return Some((seen.pieces[i], far));
            }
            seen = self.seen_from_sides(seen.beyond[i]?);
            let entered = (0..3).find(|&i| seen.corners[next(i)] == w).expect("neighbours share an edge");
            i = if is_left(seen.corners[entered]) { next(entered) } else { previous(entered) };
        }
        None
    }

    /// Of these triangles the one that the middle of three vertices is in.
    pub(super) fn place_of_middle(&self, corners: [VertexId; 3], triangles: &[u32]) -> Option<usize> {
        if triangles.is_empty() {
            return None;
        }
        let middle = middle(turned(corners, turn_of(&corners)).map(|v| self.point(v)));
        triangles.iter().position(|&t| {
            let (row, _) = self.corners_of(t);
            (0..3).all(|i| self.turn([row[next(i)], row[previous(i)]], &middle) >= 0.0)
        })
    }
}

fn middle(p: [&[f64; 2]; 3]) -> [f64; 2] {
    [0, 1].map(|axis| (p[0][axis] + p[1][axis] + p[2][axis]) / 3.0)
}

fn turn(u: [f64; 2], v: [f64; 2]) -> f64 {
    u[0] * v[1] - u[1] * v[0]
}
