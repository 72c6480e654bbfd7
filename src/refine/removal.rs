//! Removal of a vertex, in its interior or between two pieces of a segment, which are joined.
//!
//! What the triangles around the vertex leave is one polygon, or two with the joined piece between them. Each gets its
//! constrained Delaunay triangulation, which is what a fresh build would have, as the sides of the polygons are: ears in
//! whose circle no other corner is are cut off. Where there is none, as corners that are not seen are in all circles, any
//! ears are, and diagonals are flipped until all are locally Delaunay. All of this is done beside the triangles, which are
//! replaced if what has been found is wanted. It ends at the first triangle that is not.

use super::mesh::Mesh;
use super::parts::{NONE, Rim, Side, Triangle, next, previous};
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::predicates;

/// Vertices of more neighbours are not removed: what follows takes the square of their number.
pub(super) const MAX_DEGREE: usize = 64;

/// Whether a triangle of these corners and this label may come.
pub(super) type IsGood<'a> = &'a dyn Fn(&Mesh, [VertexId; 3], u32) -> bool;

/// What would take the place of the triangles around a vertex.
#[derive(Debug, Default)]
pub(super) struct Hole {
    /// Corners, and the label.
    pub(super) triangles: Vec<([VertexId; 3], u32)>,
    /// The triangles around the vertex, some of which may not have been copied.
    pub(super) around: Vec<u32>,
    /// The pieces that are joined, in their segment's direction, and what they become.
    joined: Option<([u32; 2], [VertexId; 2])>,
    /// The corners of what is left to be triangulated, counter-clockwise.
    pub(super) polygon: Vec<VertexId>,
}

impl Hole {
    /// Begins the polygon, and the triangles at its sides, at the lowest corner, wherever the vertex was looked at first.
    pub(super) fn begin_at_lowest(&mut self) {
        let first = (0..self.polygon.len()).min_by_key(|&k| self.polygon[k]).unwrap_or(0);
        self.polygon.rotate_left(first);
        self.around.rotate_left(first);
    }
}

impl Mesh<'_> {
    /// Gathers the triangles around a vertex as the cavity; whether that can be removed: it has no segments at it but for
    /// the two pieces, and is not on the hull without them. With pieces the sides begin behind the second one, else at the
    /// lowest corner.
    fn gather(&mut self, v: VertexId, pieces: Option<[u32; 2]>) -> Result<bool> {
        self.cells.clear();
        self.rim.clear();
        // The triangle to the left of the second piece, or, where there is none, of the first one backwards; and what is
        // before it, clockwise.
        let (first, is_behind_hull) = match pieces {
            None => (self.read(self.at[v])?, false),
            Some([before, behind]) => {
                self.read_piece(before)?;
                self.read_piece(behind)?;
                let (start, across) = match (self.sides_of(behind), self.sides_of(before)) {
                    ([left, right], _) if left != Side::NONE => (left, right),
                    (_, [left, right]) => (right, left),
                };
                (start.triangle(), across == Side::NONE)
            }
        };
        let mut t = first;
        loop {
            if self.cells.len() >= MAX_DEGREE {
                return Ok(false);
            }
            memory::push(&mut self.cells, t)?;
            let i = corner_of(self.triangle(t).corners, v);
            let across = self.cross(Side::new(t, i))?;
            let triangle = self.triangle(t);
            let rim =
                Rim { ends: triangle.ends(i), across, piece: triangle.pieces[i], label: triangle.label };
            let piece = triangle.pieces[next(i)];
            if piece != NONE && !pieces.is_some_and(|pieces| pieces.contains(&piece)) {
                return Ok(false);
            }
            memory::push(&mut self.rim, rim)?;
            // Counter-clockwise, across the side that ends in the vertex.
            let across = self.cross(Side::new(t, next(i)))?;
            if across == Side::NONE {
                // Where the hull has a corner at the vertex that is none of the segment, as places are rounded, there is more
                // than what has been gathered.
                return Ok(piece != NONE && is_behind_hull);
            }
            t = across.triangle();
            if t == first {
                if pieces.is_none() {
                    let lowest = (0..self.rim.len()).min_by_key(|&k| self.rim[k].ends[0]).unwrap_or(0);
                    self.rim.rotate_left(lowest);
                    self.cells.rotate_left(lowest);
                }
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
        self.triangulate(hole, label, &|_, _, _| true)
    }

    /// Finds what would take the place of the triangles that have been [found](Self::look_around) around a vertex; whether
    /// all of it is good.
    pub(super) fn fill_polygon(&self, hole: &mut Hole, label: u32, is_good: IsGood) -> Result<bool> {
        hole.triangles.clear();
        hole.joined = None;
        Ok(!self.has_bad_ear(&hole.polygon, label, is_good) && self.triangulate(hole, label, is_good)?)
    }

    /// Copies the triangles around a vertex that are to be [replaced](Self::replace).
    pub(super) fn read_around(&mut self, v: VertexId) -> Result<()> {
        let is_inside = self.gather(v, None)?;
        debug_assert!(is_inside, "it has been looked at");
        Ok(())
    }

    /// Finds the pieces' sides around the vertex between them, as the cavity; whether they can be joined.
    pub(super) fn look_around_joint(&mut self, pieces: [u32; 2]) -> Result<bool> {
        let [a, v] = self.pieces[pieces[0] as usize].ends;
        let b = self.pieces[pieces[1] as usize].ends[1];
        if a == b || !self.gather(v, Some(pieces))? {
            return Ok(false);
        }
        // Where only one of them is on the hull, the vertex sticks out of it, and not all around it has been found.
        let [before, behind] = pieces.map(|piece| self.sides_of(piece).map(|side| side == Side::NONE));
        Ok(before == behind)
    }

    /// Finds what would take the place of the vertex between two pieces, of which the second follows the first, and around
    /// which all has been [found](Self::look_around_joint); whether nothing is in the way of the joined piece and all of
    /// it is good.
    pub(super) fn fill_joined(&self, pieces: [u32; 2], hole: &mut Hole, is_good: IsGood) -> Result<bool> {
        hole.triangles.clear();
        let a = self.pieces[pieces[0] as usize].ends[0];
        let b = self.pieces[pieces[1] as usize].ends[1];
        hole.joined = Some((pieces, [a, b]));
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
            // Rounding has bent the pieces away from one side of a triangle, which the joined piece takes the place of.
            if n == 2 && hole.polygon[1] == to && sides[0].piece == NONE {
                continue;
            }
            if hole.polygon[n - 1] != to
                || sides.iter().any(|side| side.label != label)
                || n < 3
                || hole.polygon[1..n - 1].iter().any(|&w| self.turn([to, from], self.point(w)) <= 0.0)
                || !self.triangulate(hole, label, is_good)?
            {
                return Ok(false);
            }
        }
        Ok(!hole.triangles.is_empty())
    }

    /// Whether a bad triangle is an ear that has to be there: then nothing else need be looked at.
    fn has_bad_ear(&self, polygon: &[VertexId], label: u32, is_good: IsGood) -> bool {
        (0..polygon.len()).any(|k| {
            let corners = ear(polygon, k);
            !is_good(self, corners, label) && self.is_delaunay_ear(polygon, k)
        })
    }

    /// Appends the constrained Delaunay triangulation of the polygon; `false` if it is none, or not good.
    fn triangulate(&self, hole: &mut Hole, label: u32, is_good: IsGood) -> Result<bool> {
        let Hole { polygon, triangles, .. } = hole;
        while polygon.len() > 2 {
            let Some(k) = (0..polygon.len()).find(|&k| self.is_delaunay_ear(polygon, k)) else {
                return self.triangulate_by_flips(hole, label, is_good);
            };
            let corners = ear(polygon, k);
            if !is_good(self, corners, label) {
                return Ok(false);
            }
            memory::push(triangles, (corners, label))?;
            polygon.remove(k);
        }
        Ok(true)
    }

    /// Appends the constrained Delaunay triangulation of what is left of a polygon.
    fn triangulate_by_flips(&self, hole: &mut Hole, label: u32, is_good: IsGood) -> Result<bool> {
        let first = hole.triangles.len();
        let Hole { polygon, triangles, .. } = hole;
        while polygon.len() > 2 {
            let Some(k) = (0..polygon.len()).find(|&k| self.is_ear(polygon, k)) else { return Ok(false) };
            memory::push(triangles, (ear(polygon, k), label))?;
            polygon.remove(k);
        }
        self.flip_all(&mut triangles[first..]);
        Ok(triangles[first..].iter().all(|&(corners, label)| is_good(self, corners, label)))
    }

    /// Whether a corner of a polygon can be cut off, no other corner being in the circle of what is: then that is a triangle
    /// of the polygon's constrained Delaunay triangulation. Others may be, where the corners in their circles are not seen.
    fn is_delaunay_ear(&self, polygon: &[VertexId], k: usize) -> bool {
        let corners = ear(polygon, k);
        let n = polygon.len();
        let others = (2..n - 1).map(|j| polygon[if k + j < n { k + j } else { k + j - n }]);
        self.turn([corners[0], corners[1]], self.point(corners[2])) > 0.0
            && others.into_iter().all(|w| !self.is_inside(corners, self.point(w), w))
    }

    /// Whether a corner of a polygon can be cut off.
    fn is_ear(&self, polygon: &[VertexId], k: usize) -> bool {
        let [a, b, c] = ear(polygon, k);
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
        let is_joined = |ends: [VertexId; 2]| ends == [u, w] || ends == [w, u];
        let joined = joined.filter(|&(_, ends)| is_joined(ends)).map_or(NONE, |(piece, _)| piece);
        if let Some(&Rim { across, mut piece, .. }) = self.rim.iter().find(|rim| rim.ends == [u, w]) {
            if joined != NONE {
                piece = joined;
                // Nothing has been made beyond.
                if across != Side::NONE {
                    self.triangles[across.triangle() as usize].pieces[across.index()] = piece;
                }
            }
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
        let triangle = &mut self.triangles[side.triangle() as usize];
        triangle.across[side.index()] = beyond.unwrap_or(Side::NONE);
        triangle.pieces[side.index()] = joined;
        if joined != NONE {
            self.pieces[joined as usize].side = side;
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

/// A corner of a polygon, between the one before and the next.
#[inline(always)]
fn ear(polygon: &[VertexId], k: usize) -> [VertexId; 3] {
    let n = polygon.len();
    [polygon[if k == 0 { n - 1 } else { k - 1 }], polygon[k], polygon[if k + 1 == n { 0 } else { k + 1 }]]
}

/// The corner that a vertex is.
#[inline(always)]
pub(super) fn corner_of(corners: [VertexId; 3], v: VertexId) -> usize {
    corners.iter().position(|&w| w == v).expect("it is a corner")
}

/// For two triangles with a common side, the corners opposite it.
fn opposite(one: [VertexId; 3], other: [VertexId; 3]) -> Option<(usize, usize)> {
    (0..3).find_map(|i| {
        let ends = [one[next(i)], one[previous(i)]];
        let j = (0..3).find(|&j| other[next(j)] == ends[1] && other[previous(j)] == ends[0])?;
        Some((i, j))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::Keys;
    use crate::random::Rng;
    use crate::refine::Given;

    /// Polygons around a place, of corners on a lattice, so that many are on one circle or line: ears without corners in
    /// their circles lead to what flips do, and a bad ear is found only where it is one of these triangles.
    #[test]
    fn ears_and_flips_agree() {
        let mut n_by_ears = 0;
        for seed in 0..4_000 {
            let rng = &mut Rng::new(seed);
            let size = *rng.pick(&[3, 5, 40]);
            let mut points: Vec<[f64; 2]> = Vec::new();
            for _ in 0..3 + rng.below(8) {
                let p = [0, 1].map(|_| (rng.below(2 * size + 1) as f64) - size as f64);
                let is_new_way = |q: &[f64; 2]| p[0] * q[1] != p[1] * q[0] || p[0] * q[0] + p[1] * q[1] < 0.0;
                if p != [0.0; 2] && points.iter().all(is_new_way) {
                    points.push(p);
                }
            }
            points.sort_by(|p, q| p[1].atan2(p[0]).total_cmp(&q[1].atan2(q[0])));
            let n = points.len();
            let is_convex_there = |k: usize| {
                let (p, q) = (points[k], points[(k + 1) % n]);
                p[0] * q[1] - p[1] * q[0] > 0.0
            };
            if n < 3 || !(0..n).all(is_convex_there) {
                continue;
            }
            // Ids break ties: in any order.
            let mut ids: Vec<usize> = (0..n).collect();
            rng.shuffle(&mut ids);
            let mut by_id = vec![[0.0; 2]; n];
            ids.iter().zip(&points).for_each(|(&id, &p)| by_id[id] = p);
            let at = vec![NONE; n];
            let keys = Keys::default();
            let given = Given {
                lower: [-(size as f64); 2],
                upper: [size as f64; 2],
                corners: &[],
                neighbours: &[],
                at: &at,
                mask: &[],
                labels: None,
                sides: &[],
                segments: &[],
                keys: &keys,
            };
            let mesh = Mesh::new(given, by_id).expect("room");
            let polygon: Vec<_> = ids.iter().map(|&id| VertexId::at(id)).collect();
            let mut by_flips = Hole { polygon: polygon.clone(), ..Hole::default() };
            assert!(mesh.triangulate_by_flips(&mut by_flips, 0, &|_, _, _| true).expect("room"));
            let sorted = |hole: &Hole| {
                let mut all: Vec<_> = hole.triangles.iter().map(|&(row, _)| sorted_row(row)).collect();
                all.sort_unstable();
                all
            };
            let expected = sorted(&by_flips);
            let mut by_ears = Hole { polygon: polygon.clone(), ..Hole::default() };
            assert!(mesh.fill_polygon(&mut by_ears, 0, &|_, _, _| true).expect("room"));
            assert_eq!(sorted(&by_ears), expected, "seed {seed}: {points:?}");
            n_by_ears += usize::from((0..n).any(|k| mesh.is_delaunay_ear(&polygon, k)));
            // Any triangle is refused if and only if it comes.
            let bad = sorted_row([0, 0, 0].map(|_| polygon[rng.below(n)]));
            let is_good = |_: &Mesh, row: [VertexId; 3], _: u32| sorted_row(row) != bad;
            let mut hole = Hole { polygon: polygon.clone(), ..Hole::default() };
            let is_filled = mesh.fill_polygon(&mut hole, 0, &is_good).expect("room");
            assert_eq!(is_filled, !expected.contains(&bad), "seed {seed}: {points:?}, {bad:?}");
        }
        assert!(n_by_ears > 1_000, "{n_by_ears}");
    }

    fn sorted_row(mut row: [VertexId; 3]) -> [VertexId; 3] {
        row.sort_unstable();
        row
    }
}
