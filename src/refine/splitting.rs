//! Where pieces of segments are split, and at which angles between segments that is at shells.

use super::criteria::{distance, power_of_two_below};
use super::parts::{NONE, Piece, Side};
use super::refining::Refinement;
use crate::error::Result;
use crate::ids::VertexId;
use crate::predicates::is_in_diametral_circle;

/// Squared cosine of an angle between segments from which on they are split at shells: that of 60 degrees.
const SHARP: f64 = 0.25;

/// Last places by which a place is moved along each axis, the least distances first: a place that rounding has put off a
/// piece by less than one is on either side of it among these.
const AROUND: [[f64; 2]; 25] = [
    [0.0, 0.0],
    [1.0, 0.0],
    [0.0, 1.0],
    [-1.0, 0.0],
    [0.0, -1.0],
    [1.0, 1.0],
    [-1.0, 1.0],
    [-1.0, -1.0],
    [1.0, -1.0],
    [2.0, 0.0],
    [0.0, 2.0],
    [-2.0, 0.0],
    [0.0, -2.0],
    [2.0, 1.0],
    [1.0, 2.0],
    [-1.0, 2.0],
    [-2.0, 1.0],
    [-2.0, -1.0],
    [-1.0, -2.0],
    [1.0, -2.0],
    [2.0, -1.0],
    [2.0, 2.0],
    [-2.0, 2.0],
    [-2.0, -2.0],
    [2.0, -2.0],
];

/// How many other shares of a piece are tried where there is little room, and the golden ratio, by whose multiples they
/// are spread evenly.
const N_OTHER_SHARES: u32 = 256;
const GOLDEN: f64 = 0.618_033_988_749_895;

impl Refinement<'_> {
    /// The piece at a side of a triangle, or behind flat triangles there, if it has to be split for that triangle.
    pub(super) fn wanted_at(&mut self, side: Side) -> Result<Option<(u32, Option<[f64; 2]>)>> {
        let triangle = *self.mesh.triangle(side.triangle());
        let piece = triangle.pieces[side.index()];
        if piece == NONE {
            let is_wanted = self.has_flat && self.is_encroached_from(side);
            let apex = *self.mesh.point(self.mesh.apex(side));
            return match is_wanted {
                true => Ok(self.piece_behind(side)?.map(|piece| (piece, Some(apex)))),
                false => Ok(None),
            };
        }
        let ends = triangle.ends(side.index()).map(|v| self.mesh.point(v));
        if self.tests.is_too_long(ends, triangle.label) {
            return Ok(Some((piece, Some([0, 1].map(|axis| 0.5 * (ends[0][axis] + ends[1][axis]))))));
        }
        Ok(self.is_encroached_from(side).then_some((piece, None)))
    }

    /// Splits a piece: in the middle, or, at a small angle with another segment, at a round distance from its apex, so that
    /// what is on both is on common shells.
    pub(super) fn split(&mut self, piece: u32, cause: Option<[f64; 2]>) -> Result<()> {
        if !self.may_split(piece) {
            return Ok(());
        }
        let share = self.share_at_split(piece, cause)?;
        let mut place = self.find_place(piece, share)?;
        if place.is_some() && share == 0.5 {
            self.clear_circle(piece)?;
            // What looks at vertices in the circle finds cavities of their own.
            place = self.find_place(piece, share)?;
        }
        match place {
            Some(place) => {
                self.n_split += 1;
                self.add(place, NONE, Some(piece))
            }
            None => {
                self.mesh.pieces[piece as usize].is_fixed = true;
                self.has_left = true;
                Ok(())
            }
        }
    }

    /// Whether a piece that may be split has room for it.
    pub(super) fn can_split(&mut self, piece: u32, cause: Option<[f64; 2]>) -> Result<bool> {
        let share = self.share_at_split(piece, cause)?;
        Ok(self.may_split(piece) && self.find_place(piece, share)?.is_some())
    }

    /// Where on a piece, from 0 to 1, it is to be split.
    fn share_at_split(&mut self, piece: u32, cause: Option<[f64; 2]>) -> Result<f64> {
        if let Some(middle) = self.middle_between_touching(piece, cause)? {
            return Ok(middle);
        }
        Ok(self.apex_of_shells(piece).map_or(0.5, |apex| {
            let ends = self.mesh.pieces[piece as usize].ends;
            let [d, e] = ends.map(|v| distance(self.mesh.point(apex), self.mesh.point(v)));
            (round_between(d.min(e), d.max(e)) - d) / (e - d)
        }))
    }

    /// Finds a place at this share of a piece, or near it, where it can be split, and the cavity there: rounded, then few last
    /// places beside that, within the hull first, then rounded at other shares.
    fn find_place(&mut self, piece: u32, share: f64) -> Result<Option<[f64; 2]>> {
        let [p, q] = self.mesh.pieces[piece as usize].ends.map(|v| *self.mesh.point(v));
        let room = share.min(1.0 - share);
        if room * distance(&p, &q) < self.tests.resolution {
            return Ok(None);
        }
        let is_on_hull = self.mesh.sides_of(piece).contains(&Side::NONE);
        let last_place = [0, 1].map(|axis: usize| {
            let greatest = p[axis].abs().max(q[axis].abs());
            greatest.next_up() - greatest
        });
        let rounded = self.tests.rounding();
        let at = |share: f64, offsets: [f64; 2]| {
            [0, 1].map(|axis| {
                let x = p[axis] + share * (q[axis] - p[axis]);
                let x = x.clamp(p[axis].min(q[axis]), p[axis].max(q[axis]));
                rounded(x + offsets[axis] * last_place[axis])
            })
        };
        for may_leave in [false, true] {
            for offsets in AROUND {
                let place = at(share, offsets);
                if self.may_be_at(piece, &place, may_leave)? {
                    return Ok(Some(place));
                }
            }
            if !is_on_hull {
                break;
            }
        }
        // Between slivers on both sides a rounded place is legal as often as these are thick.
        for k in 1..=N_OTHER_SHARES {
            let part = (f64::from(k) * GOLDEN).fract() - 0.5;
            let place = at(share + 0.5 * part * room, [0.0; 2]);
            if self.may_be_at(piece, &place, true)? {
                return Ok(Some(place));
            }
        }
        Ok(None)
    }

    /// Whether a piece can be split at a place, of which the cavity has been found then.
    fn may_be_at(&mut self, piece: u32, place: &[f64; 2], may_leave: bool) -> Result<bool> {
        let [p, q] = self.mesh.pieces[piece as usize].ends.map(|v| *self.mesh.point(v));
        let is_between =
            (0..2).all(|axis| p[axis].min(q[axis]) <= place[axis] && place[axis] <= p[axis].max(q[axis]));
        let id = VertexId::at(self.mesh.points.len());
        Ok(is_between && *place != p && *place != q && self.mesh.dig_at_piece(piece, place, id, may_leave)?)
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
        self.is_seen_below(apex, others, SHARP)
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
                self.n_cleared += 1;
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
