//! Sides, triangles and pieces of segments.

use crate::ids::VertexId;

/// No triangle, no piece.
pub(crate) const NONE: u32 = u32::MAX;

/// What triangles have for a label that are not to be refined.
pub(crate) const NOT_SELECTED: u32 = u32::MAX;

/// In the number of a triangle that has not been copied: then the rest is the number of the cell.
pub(super) const UNREAD: u32 = 1 << 29;

/// A side of a triangle, the one opposite a corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Side(u32);

impl Side {
    pub(super) const NONE: Self = Side(u32::MAX);

    #[inline(always)]
    pub(super) fn new(triangle: u32, index: usize) -> Self {
        Side(triangle << 2 | index as u32)
    }

    #[inline(always)]
    pub(super) fn triangle(self) -> u32 {
        self.0 >> 2
    }

    #[inline(always)]
    pub(super) fn index(self) -> usize {
        (self.0 & 3) as usize
    }

    /// One of a triangle that has not been copied. Which of its sides this is, is not known.
    #[inline(always)]
    pub(super) fn unread(cell: u32) -> Self {
        Side::new(cell | UNREAD, 0)
    }

    /// The cell, if the triangle has not been copied.
    #[inline(always)]
    pub(super) fn unread_cell(self) -> Option<u32> {
        (self != Side::NONE && self.triangle() & UNREAD != 0).then_some(self.triangle() & !UNREAD)
    }

    /// The next side of its triangle, counter-clockwise.
    #[inline(always)]
    pub(super) fn next(self) -> Self {
        Side::new(self.triangle(), next(self.index()))
    }

    /// The side before.
    #[inline(always)]
    pub(super) fn previous(self) -> Self {
        Side::new(self.triangle(), previous(self.index()))
    }
}

#[inline(always)]
pub(super) fn next(i: usize) -> usize {
    [1, 2, 0][i]
}

#[inline(always)]
pub(super) fn previous(i: usize) -> usize {
    [2, 0, 1][i]
}

/// By how many places a row of corners is turned so that the lowest is first: whatever order copies have, they are then
/// the same, and so is what is rounded.
#[inline(always)]
pub(crate) fn turn_of(corners: &[VertexId; 3]) -> usize {
    let [a, b, c] = *corners;
    if a < b && a < c {
        0
    } else if b < c {
        1
    } else {
        2
    }
}

/// What belongs to the corners of a triangle, turned by so many places.
#[inline(always)]
pub(crate) fn turned<T: Copy>([a, b, c]: [T; 3], by: usize) -> [T; 3] {
    match by {
        0 => [a, b, c],
        1 => [b, c, a],
        _ => [c, a, b],
    }
}

/// A triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// Counter-clockwise; the first is [`VertexId::NONE`] where there is none.
    pub(super) corners: [VertexId; 3],
    /// Beyond the side opposite each corner.
    pub(super) across: [Side; 3],
    /// The piece of a segment at each side.
    pub(super) pieces: [u32; 3],
    /// What the program knows it by, or [`NOT_SELECTED`].
    pub(super) label: u32,
}

impl Triangle {
    pub(super) const FREE: Triangle = Triangle {
        corners: [VertexId::NONE; 3],
        across: [Side::NONE; 3],
        pieces: [NONE; 3],
        label: NOT_SELECTED,
    };

    #[inline(always)]
    pub(super) fn is_live(&self) -> bool {
        self.corners[0] != VertexId::NONE
    }

    #[inline(always)]
    pub(super) fn is_selected(&self) -> bool {
        self.label != NOT_SELECTED
    }

    /// The ends of a side, with the triangle to the left.
    #[inline(always)]
    pub(super) fn ends(&self, i: usize) -> [VertexId; 2] {
        [self.corners[next(i)], self.corners[previous(i)]]
    }
}

/// A piece of a segment, or all of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// In the direction of its segment.
    pub(super) ends: [VertexId; 2],
    /// A side at which it is.
    pub(super) side: Side,
    /// The segment, by its place in the list that was given.
    pub(super) segment: u32,
    /// The next piece of the segment.
    pub(super) next: u32,
    /// Whether there has been no room to split it.
    pub(super) is_fixed: bool,
}

/// A side of a cavity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    /// With the cavity to the left.
    pub(super) ends: [VertexId; 2],
    pub(super) across: Side,
    pub(super) piece: u32,
    pub(super) label: u32,
}
