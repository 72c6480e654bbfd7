//! What is around a vertex, looked at without copying triangles.

use super::mesh::Mesh;
use super::parts::{NONE, Side, Triangle, UNREAD, next, previous};
use super::removal::{Hole, MAX_DEGREE, corner_of};
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;

/// A triangle that may not have been copied.
pub(super) struct SeenTriangle {
    pub(super) corners: [VertexId; 3],
    /// What is beyond the side opposite each corner; nothing beyond the hull.
    pub(super) beyond: [Option<u32>; 3],
    /// The segments, or pieces of these, at the sides.
    pub(super) pieces: [u32; 3],
}

impl Mesh<'_> {
    /// A triangle that may not have been copied, with what is beyond its sides.
    pub(super) fn seen_from_sides(&self, t: u32) -> SeenTriangle {
        let copy = if t & UNREAD == 0 { Some(t) } else { self.copy_of(t & !UNREAD) };
        match copy {
            Some(copy) => {
                let &Triangle { corners, across, pieces, .. } = self.triangle(copy);
                let beyond = across.map(|side| (side != Side::NONE).then_some(side.triangle()));
                SeenTriangle { corners, beyond, pieces }
            }
            None => {
                let cell = t & !UNREAD;
                let beyond = self.given.across(cell).map(|c| (c != CellId::NONE).then_some(c.get() | UNREAD));
                SeenTriangle { corners: self.given.row(cell), beyond, pieces: self.given.sides_of(cell) }
            }
        }
    }

    /// Finds the triangles around a vertex that no segment is at, and the polygon that they leave, without copying any.
    /// Returns their label, if it is one and they are all around.
    pub(super) fn look_around(&self, v: VertexId, hole: &mut Hole) -> Result<Option<u32>> {
        hole.around.clear();
        hole.polygon.clear();
        let (mut t, mut label) = (self.at[v], None);
        loop {
            if hole.around.len() >= MAX_DEGREE {
                return Ok(None);
            }
            let (corners, beyond, own_label) = self.seen(t, v);
            if *label.get_or_insert(own_label) != own_label {
                return Ok(None);
            }
            memory::push(&mut hole.around, t)?;
            memory::push(&mut hole.polygon, corners[0])?;
            if corners[1] == hole.polygon[0] {
                hole.begin_at_lowest();
                return Ok(label);
            }
            match beyond {
                Some(beyond) => t = beyond,
                None => return Ok(None),
            }
        }
    }

    /// Of a triangle that may not have been copied, as seen from one of its corners: the next corner and the one
    /// behind, the triangle beyond the edge to the latter, and the label.
    #[inline(always)]
    fn seen(&self, t: u32, v: VertexId) -> ([VertexId; 2], Option<u32>, u32) {
        let copy = if t & UNREAD == 0 { Some(t) } else { self.copy_of(t & !UNREAD) };
        match copy {
            Some(copy) => {
                let &Triangle { corners, across, label, .. } = self.triangle(copy);
                let i = corner_of(corners, v);
                let across = across[next(i)];
                (
                    [corners[next(i)], corners[previous(i)]],
                    (across != Side::NONE).then_some(across.triangle()),
                    label,
                )
            }
            // Whatever order its corners have.
            None => {
                let cell = t & !UNREAD;
                let corners = self.given.corners[cell as usize];
                let i = corner_of(corners, v);
                let across = self.given.neighbours[cell as usize][next(i)];
                let beyond = (across != CellId::NONE).then_some(across.get() | UNREAD);
                ([corners[next(i)], corners[previous(i)]], beyond, self.given.label(cell))
            }
        }
    }

    /// The corners and label of a triangle that may not have been copied.
    #[inline(always)]
    pub(super) fn corners_of(&self, t: u32) -> ([VertexId; 3], u32) {
        if t & UNREAD == 0 {
            let triangle = self.triangle(t);
            return (triangle.corners, triangle.label);
        }
        let cell = t & !UNREAD;
        match self.copy_of(cell) {
            Some(copy) => (self.triangle(copy).corners, self.triangle(copy).label),
            None => (self.given.row(cell), self.given.label(cell)),
        }
    }

    /// Whether the corner of a triangle, which may not have been copied, is between two segments.
    pub(super) fn is_between_segments(&self, t: u32, corner: usize) -> bool {
        let pieces = self.pieces_of(t);
        [next(corner), previous(corner)].iter().all(|&i| pieces[i] != NONE)
    }

    /// Whether the side of a triangle, which may not have been copied, that is opposite one of its corners has these ends and
    /// is a segment.
    pub(super) fn is_segment_opposite(&self, t: u32, corner: VertexId, ends: [VertexId; 2]) -> bool {
        let corners = self.corners_of(t).0;
        let i = corner_of(corners, corner);
        [corners[next(i)], corners[previous(i)]] == ends && self.pieces_of(t)[i] != NONE
    }

    /// The segments at the sides of a triangle that may not have been copied.
    fn pieces_of(&self, t: u32) -> [u32; 3] {
        let copy = if t & UNREAD == 0 { Some(t) } else { self.copy_of(t & !UNREAD) };
        match copy {
            Some(copy) => self.triangle(copy).pieces,
            None => self.given.sides_of(t & !UNREAD),
        }
    }
}
