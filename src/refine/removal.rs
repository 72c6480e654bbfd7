//! Removal of a vertex, in its interior or between two pieces of a segment, which are joined.
//!
//! What the triangles around the vertex leave is one polygon, or two with the joined piece between them. Each is
//! triangulated by cutting off ears, and its diagonals are flipped until all are locally Delaunay: then they are what a
//! fresh build would have, as the sides of the polygons are. All of this is done beside the triangles, which are replaced
//! if what has been found is wanted.

use super::mesh::{Mesh, NONE, Rim, Side, Triangle, next, previous};
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::predicates;

/// Vertices of more neighbours are not removed: what follows takes the square of their number.
const MAX_DEGREE: usize = 64;

/// What would take the place of the triangles around a vertex.
#[derive(Debug, Default)]
pub(super) struct Hole {
    /// Corners, and the label.
    pub(super) triangles: Vec<([VertexId; 3], u32)>,
    /// The pieces that are joined, in their segment's direction, and what they become.
    joined: Option<([u32; 2], [VertexId; 2])>,
    polygon: Vec<VertexId>,
}

impl Mesh {
    /// Gathers the triangles around a vertex as the cavity; whether that can be removed: it has no segments at it but for
    /// the two pieces, and is not on the hull without them. With pieces the sides begin behind the second one.
    fn gather(&mut self, v: VertexId, pieces: Option<[u32; 2]>) -> Result<bool> {
        self.cells.clear();
        self.rim.clear();
        let corner = |mesh: &Self, t: u32| {
            mesh.triangle(t).corners.iter().position(|&w| w == v).expect("it is a corner")
        };
        // The triangle to the left of the second piece, or, where there is none, of the first one backwards.
        let first = match pieces {
            None => self.at[v],
            Some([before, behind]) => match [self.sides_of(behind)[0], self.sides_of(before)[1]] {
                [left, _] if left != Side::NONE => left.triangle(),
                [_, right] => right.triangle(),
            },
        };
        let mut t = first;
        loop {
            if self.cells.len() >= MAX_DEGREE {
                return Ok(false);
            }
            memory::push(&mut self.cells, t)?;
            let i = corner(self, t);
            let triangle = self.triangle(t);
            let rim = Rim {
                ends: triangle.ends(i),
                across: triangle.across[i],
                piece: triangle.pieces[i],
                label: triangle.label,
            };
            // Counter-clockwise, across the side that ends in the vertex.
            let (across, piece) = (triangle.across[next(i)], triangle.pieces[next(i)]);
            if piece != NONE && !pieces.is_some_and(|pieces| pieces.contains(&piece)) {
                return Ok(false);
            }
            memory::push(&mut self.rim, rim)?;
            if across == Side::NONE {
                return Ok(pieces.is_some());
            }
            t = across.triangle();
            if t == first {
                return Ok(true);
            }
        }
    }

    /// Finds what would take the place of a vertex that no segment is at; whether that can be told.
    pub(super) fn find_hole(&mut self, v: VertexId, hole: &mut Hole) -> Result<bool> {
        hole.triangles.clear();
        hole.joined = None;
        if !self.gather(v, None)? {
            return Ok(false);
        }
        let label = self.rim[0].label;
        if self.rim.iter().any(|side| side.label != label) {
            return Ok(false);
        }
        hole.polygon.clear();
        memory::collect(&mut hole.polygon, self.rim.iter().map(|side| side.ends[0]))?;
        self.triangulate(hole, label)
    }

    /// Finds what would take the place of the vertex between two pieces, of which the second follows the first; whether
    /// nothing is in the way of the joined piece.
    pub(super) fn find_joined_hole(&mut self, pieces: [u32; 2], hole: &mut Hole) -> Result<bool> {
        hole.triangles.clear();
        let [a, v] = self.pieces[pieces[0] as usize].ends;
        let b = self.pieces[pieces[1] as usize].ends[1];
        hole.joined = Some((pieces, [a, b]));
        if a == b || !self.gather(v, Some(pieces))? {
            return Ok(false);
        }
        // From the second piece's end around to the first one's, and on the other side back.
        let starts_at = |w: VertexId| self.rim.iter().position(|side| side.ends[0] == w);
        let n = self.rim.len();
        let (left, right) = match (starts_at(b), starts_at(a)) {
            (Some(0), Some(k)) => (0..k, k..n),
            (Some(0), None) => (0..n, n..n),
            (None, Some(0)) => (0..0, 0..n),
            _ => return Ok(false),
        };
        for (range, [from, to]) in [(left, [b, a]), (right, [a, b])] {
            if range.is_empty() {
                continue;
            }
            let label = self.rim[range.start].label;
            let sides = &self.rim[range];
            hole.polygon.clear();
            memory::push(&mut hole.polygon, from)?;
            memory::collect(&mut hole.polygon, sides.iter().map(|side| side.ends[1]))?;
            let n = hole.polygon.len();
            if hole.polygon[n - 1] != to
                || sides.iter().any(|side| side.label != label)
                || n < 3
                || hole.polygon[1..n - 1].iter().any(|&w| self.turn([to, from], self.point(w)) <= 0.0)
                || !self.triangulate(hole, label)?
            {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Appends the constrained Delaunay triangulation of the polygon; `false` if it is none.
    fn triangulate(&self, hole: &mut Hole, label: u32) -> Result<bool> {
        let first = hole.triangles.len();
        let Hole { polygon, triangles, .. } = hole;
        while polygon.len() > 2 {
            let n = polygon.len();
            let Some(k) = (0..n).find(|&k| self.is_ear(polygon, k)) else { return Ok(false) };
            let corners = [polygon[(k + n - 1) % n], polygon[k], polygon[(k + 1) % n]];
            memory::push(triangles, (corners, label))?;
            polygon.remove(k);
        }
        self.flip_all(&mut triangles[first..]);
        Ok(true)
    }

    /// Whether a corner of a polygon can be cut off.
    fn is_ear(&self, polygon: &[VertexId], k: usize) -> bool {
        let n = polygon.len();
        let [a, b, c] = [polygon[(k + n - 1) % n], polygon[k], polygon[(k + 1) % n]];
        self.turn([a, b], self.point(c)) > 0.0
            && polygon.iter().all(|&w| {
                let p = self.point(w);
                [a, b, c].contains(&w)
                    || self.turn([a, b], p) < 0.0
                    || self.turn([b, c], p) < 0.0
                    || self.turn([c, a], p) < 0.0
            })
    }

    /// Flips diagonals until all are locally Delaunay.
    fn flip_all(&self, triangles: &mut [([VertexId; 3], u32)]) {
        let mut has_flipped = true;
        while has_flipped {
            has_flipped = false;
            for j in 1..triangles.len() {
                for i in 0..j {
                    let [one, other] = [triangles[i].0, triangles[j].0];
                    let Some((apex, beyond)) = opposite(one, other) else { continue };
                    let q = other[beyond];
                    if self.is_inside(one, self.point(q), q) {
                        let [p, u, w] = [one[apex], one[next(apex)], one[previous(apex)]];
                        triangles[i].0 = [p, u, q];
                        triangles[j].0 = [p, q, w];
                        has_flipped = true;
                    }
                }
            }
        }
    }

    /// Puts what has been found in the place of the triangles around the vertex. The joined piece is the first of the two,
    /// and the other one is in no triangle.
    pub(super) fn replace(&mut self, v: VertexId, hole: &Hole) -> Result<()> {
        let n = hole.triangles.len();
        self.claim(n)?;
        let joined = hole.joined.map(|([first, second], ends)| {
            let next = self.pieces[second as usize].next;
            let piece = &mut self.pieces[first as usize];
            (piece.ends, piece.next) = (ends, next);
            self.pieces[second as usize].ends = [VertexId::NONE; 2];
            (first, ends)
        });
        self.at[v] = NONE;
        for k in 0..n {
            let (corners, label) = hole.triangles[k];
            let t = self.made[k];
            corners.iter().for_each(|&w| self.at[w] = t);
            self.triangles[t as usize] =
                Triangle { corners, across: [Side::NONE; 3], pieces: [NONE; 3], label };
        }
        for k in 0..n {
            let t = self.made[k];
            for i in 0..3 {
                self.link(Side::new(t, i), hole, joined);
            }
        }
        Ok(())
    }

    /// Finds what is across a side of a triangle that has been made.
    fn link(&mut self, side: Side, hole: &Hole, joined: Option<(u32, [VertexId; 2])>) {
        let [u, w] = self.triangle(side.triangle()).ends(side.index());
        if let Some(&Rim { across, piece, .. }) = self.rim.iter().find(|rim| rim.ends == [u, w]) {
            let triangle = &mut self.triangles[side.triangle() as usize];
            triangle.across[side.index()] = across;
            triangle.pieces[side.index()] = piece;
            self.join(side, across, piece);
            return;
        }
        let beyond = hole.triangles.iter().zip(&self.made).find_map(|(&(corners, _), &t)| {
            let i = (0..3).find(|&i| corners[next(i)] == w && corners[previous(i)] == u)?;
            Some(Side::new(t, i))
        });
        let piece = match joined {
            Some((piece, ends)) if ends == [u, w] || ends == [w, u] => piece,
            _ => NONE,
        };
        let triangle = &mut self.triangles[side.triangle() as usize];
        triangle.across[side.index()] = beyond.unwrap_or(Side::NONE);
        triangle.pieces[side.index()] = piece;
        if piece != NONE {
            self.pieces[piece as usize].side = side;
        }
    }

    /// Squared distance of a place from the line through two vertices.
    pub(super) fn squared_offset(&self, v: VertexId, [a, b]: [VertexId; 2]) -> f64 {
        let [p, a, b] = [v, a, b].map(|v| *self.point(v));
        let (u, w) = (predicates::minus::<f64, 2>(&b, &a), predicates::minus::<f64, 2>(&p, &a));
        let cross = u[0] * w[1] - u[1] * w[0];
        cross * cross / predicates::dot(&u, &u)
    }
}

/// For two triangles with a common side, the corners opposite it.
fn opposite(one: [VertexId; 3], other: [VertexId; 3]) -> Option<(usize, usize)> {
    (0..3).find_map(|i| {
        let ends = [one[next(i)], one[previous(i)]];
        let j = (0..3).find(|&j| other[next(j)] == ends[1] && other[previous(j)] == ends[0])?;
        Some((i, j))
    })
}
