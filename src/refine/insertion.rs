//! Insertion of a vertex.
//!
//! The triangles whose circles have the new vertex inside are found from the one that it is in, across sides that are no
//! segments (Lawson's flips, without making them): each is entered by one side, and the next ones are across its two
//! others. So the sides of the cavity come in counter-clockwise order around the new vertex, and the triangles that fill
//! it are beside each other in that order.
//!
//! **A segment is split** at a rounded place, which need not be on it. The two triangles at the segment take the place of a
//! cavity to begin with: the new vertex has to be strictly inside the four lines of their other sides, and inside
//! their circles. Then its pieces cross nothing, and the rest is an insertion.

use super::mesh::Mesh;
use super::parts::{NONE, Piece, Rim, Side, Triangle};
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;

impl Mesh<'_> {
    /// Finds the cavity of a vertex of this number at `p`, in a triangle.
    pub(super) fn dig(&mut self, t: u32, p: &[f64; 2], id: VertexId) -> Result<()> {
        self.cells.clear();
        self.rim.clear();
        self.waiting.clear();
        memory::push(&mut self.cells, t)?;
        memory::append(&mut self.waiting, &[2, 1, 0].map(|i| Side::new(t, i)))?;
        self.dig_on(p, id)
    }

    /// Finds the cavity of a vertex of this number at `p` that is to split a piece; whether it may.
    pub(super) fn dig_at_piece(&mut self, piece: u32, p: &[f64; 2], id: VertexId) -> Result<bool> {
        self.cells.clear();
        self.rim.clear();
        self.waiting.clear();
        let sides = self.sides_of(piece);
        for side in sides.into_iter().rev().filter(|&side| side != Side::NONE) {
            let triangle = self.triangle(side.triangle());
            let is_right = |i: usize| self.turn(triangle.ends(i), p) > 0.0;
            if !is_right(side.next().index())
                || !is_right(side.previous().index())
                || !self.is_inside(triangle.corners, p, id)
            {
                return Ok(false);
            }
            memory::push(&mut self.cells, side.triangle())?;
            memory::append(&mut self.waiting, &[side.previous(), side.next()])?;
        }
        self.dig_on(p, id)?;
        Ok(true)
    }

    /// Goes on across the sides that wait, the last one first.
    fn dig_on(&mut self, p: &[f64; 2], id: VertexId) -> Result<()> {
        while let Some(side) = self.waiting.pop() {
            let across = self.cross(side)?;
            let &Triangle { pieces, label, .. } = self.triangle(side.triangle());
            let piece = pieces[side.index()];
            let is_open = piece == NONE && across != Side::NONE;
            if is_open && self.is_inside(self.triangle(across.triangle()).corners, p, id) {
                memory::push(&mut self.cells, across.triangle())?;
                memory::append(&mut self.waiting, &[across.previous(), across.next()])?;
            } else {
                let ends = self.triangle(side.triangle()).ends(side.index());
                memory::push(&mut self.rim, Rim { ends, across, piece, label })?;
            }
        }
        Ok(())
    }

    /// Fills the cavity around a new vertex, the next one. With a piece it is split; the part behind it is a new piece.
    pub(super) fn fill(&mut self, p: [f64; 2], split: Option<u32>) -> Result<VertexId> {
        let v = VertexId::at(self.points.len());
        let n = self.rim.len();
        memory::reserve(&mut self.points, 1)?;
        memory::reserve(&mut self.at, 1)?;
        memory::reserve(&mut self.pieces, 1)?;
        self.claim(n)?;
        self.points.push(p);
        let parts = split.map(|piece| self.split_piece(piece, v));
        for k in 0..n {
            let t = self.made[k];
            let Rim { ends: [u, w], across, piece, label } = self.rim[k];
            let following = self.made[if k + 1 == n { 0 } else { k + 1 }];
            let before = self.made[if k == 0 { n - 1 } else { k - 1 }];
            self.triangles[t as usize] = Triangle {
                corners: [u, w, v],
                across: [Side::new(following, 1), Side::new(before, 0), across],
                pieces: [NONE, NONE, piece],
                label,
            };
            self.join(Side::new(t, 2), across, piece);
            self.at[u] = t;
            self.at[w] = t;
        }
        self.at.push(self.made[0]);
        if let Some([first, second]) = parts {
            self.lay_parts([first, second]);
        }
        Ok(v)
    }

    /// Makes two pieces of one; there is room.
    fn split_piece(&mut self, piece: u32, v: VertexId) -> [u32; 2] {
        let other = self.pieces.len() as u32;
        let first = &mut self.pieces[piece as usize];
        let second = Piece { ends: [v, first.ends[1]], ..*first };
        first.ends[1] = v;
        first.next = other;
        self.pieces.push(second);
        [piece, other]
    }

    /// Enters the two pieces at the new vertex into the triangles around it.
    fn lay_parts(&mut self, parts: [u32; 2]) {
        let n = self.made.len();
        let outer = [self.pieces[parts[0] as usize].ends[0], self.pieces[parts[1] as usize].ends[1]];
        let is_on_hull = self.rim[n - 1].ends[1] != self.rim[0].ends[0];
        for k in 0..n {
            let t = self.made[k];
            let [u, w] = self.rim[k].ends;
            for (part, end) in parts.into_iter().zip(outer) {
                if w == end {
                    self.triangles[t as usize].pieces[0] = part;
                    self.pieces[part as usize].side = Side::new(t, 0);
                }
                if u == end {
                    self.triangles[t as usize].pieces[1] = part;
                    self.pieces[part as usize].side = Side::new(t, 1);
                }
            }
        }
        if is_on_hull {
            self.triangles[self.made[0] as usize].across[1] = Side::NONE;
            self.triangles[self.made[n - 1] as usize].across[0] = Side::NONE;
        }
    }
}
