//! Insertion of a vertex.
//!
//! The triangles whose circles have the new vertex inside are found from the one that it is in, across sides that are no
//! segments (Lawson's flips, without making them): each is entered by one side, and the next ones are across its two
//! others. So the sides of the cavity come in counter-clockwise order around the new vertex, and the triangles that fill
//! it are beside each other in that order.
//!
//! **A segment is split** at a rounded place, which need not be on it. The place has to be on the segment, or strictly inside
//! one of the two triangles at it: then the pieces touch and cross nothing. That triangle is a part of the cavity to begin
//! with. The one beyond is, too, if the place is in its circle, which it then sees through the segment: it is between the
//! lines of its two other sides, as the circle there is. Otherwise it stays, and a triangle between it and the new vertex
//! has the whole segment for a side, which is none any more. That is a sliver, so the triangle beyond must not be one that
//! is to be refined. It happens where this is a sliver itself, outside of a domain: between the halves of a segment of the
//! hull that has been split before, at a place that rounding has put inwards, and the line through its ends.

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

    /// Finds the cavity of a vertex of this number at `p` that is to split a piece, in the box of whose ends that is; whether
    /// it may. `may_leave`: whether it may be outside of the hull.
    pub(super) fn dig_at_piece(
        &mut self,
        piece: u32,
        p: &[f64; 2],
        id: VertexId,
        may_leave: bool,
    ) -> Result<bool> {
        self.cells.clear();
        self.rim.clear();
        self.waiting.clear();
        let sides = self.sides_of(piece);
        // Of a triangle that stays; the one to the left is first around the cavity.
        let mut stays = [None; 2];
        for (side, stays) in sides.into_iter().zip(&mut stays).rev().filter(|&(side, _)| side != Side::NONE) {
            let triangle = self.triangle(side.triangle());
            let turn = |side: Side| self.turn(triangle.ends(side.index()), p);
            let is_here = turn(side) > 0.0;
            if !may_leave && self.across(side) == Side::NONE && turn(side) < 0.0 {
                return Ok(false);
            }
            if is_here && [side.next(), side.previous()].into_iter().any(|other| turn(other) <= 0.0) {
                return Ok(false);
            }
            if !is_here && !self.is_inside(triangle.corners, p, id) {
                if triangle.is_selected() {
                    return Ok(false);
                }
                let [u, w] = triangle.ends(side.index());
                *stays = Some(Rim { ends: [w, u], across: side, piece: NONE, label: triangle.label });
                continue;
            }
            memory::push(&mut self.cells, side.triangle())?;
            memory::append(&mut self.waiting, &[side.previous(), side.next()])?;
        }
        memory::collect(&mut self.rim, stays[0].into_iter())?;
        self.dig_on(p, id)?;
        memory::collect(&mut self.rim, stays[1].into_iter())?;
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
            let Rim { ends: [u, w], across, .. } = self.rim[k];
            // A triangle beyond that stays.
            if outer.contains(&u) && outer.contains(&w) {
                self.triangles[across.triangle() as usize].pieces[across.index()] = NONE;
            }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::Keys;
    use crate::ids::CellId;
    use crate::random::Rng;
    use crate::refine::Given;
    use crate::refine::parts::{next, previous};
    use crate::refine::removal::Hole;

    fn turn([a, b, c]: [[f64; 2]; 3]) -> f64 {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    fn is_strictly_in(corners: [[f64; 2]; 3], p: [f64; 2]) -> bool {
        (0..3).all(|i| turn([corners[i], corners[next(i)], p]) > 0.0)
    }

    /// Two triangles at a segment, of corners on a lattice, and a place there: it may be put on the segment exactly where it
    /// is in one of them or between the ends, unless a triangle that is to be refined would get a sliver beside it. What
    /// comes are the triangulations of the polygons on both sides, made by ears.
    #[test]
    fn a_segment_is_bent_to_any_place_beside_it() {
        let (mut n_split, mut n_with_sliver, mut n_refused) = (0, 0, 0);
        for seed in 0..60_000 {
            let rng = &mut Rng::new(seed);
            let size = *rng.pick(&[3, 6, 40]);
            let mut place = || [0, 1].map(|_| rng.below(size) as f64);
            let [a, b, c, d, p] = [(); 5].map(|()| place());
            if turn([a, b, c]) <= 0.0 || turn([b, a, d]) <= 0.0 || [a, b, c, d].contains(&p) {
                continue;
            }
            let is_selected = [rng.below(2) == 0, rng.below(2) == 0];
            let is_on = turn([a, b, p]) == 0.0;
            if is_on && (0..2).any(|i| p[i].clamp(a[i].min(b[i]), a[i].max(b[i])) != p[i]) {
                continue;
            }
            let is_in = [is_strictly_in([a, b, c], p), is_strictly_in([b, a, d], p)];
            let ids = [0, 1, 2, 3, 4].map(VertexId::at);
            let corners = [[ids[0], ids[1], ids[2]], [ids[1], ids[0], ids[3]]];
            let beyond = |cell: u32| [CellId::NONE, CellId::NONE, CellId::new(cell)];
            let keys = Keys::default();
            let given = Given {
                keys: &keys,
                lower: [0.0; 2],
                upper: [size as f64; 2],
                corners: &corners,
                neighbours: &[beyond(1), beyond(0)],
                at: &[0, 0, 0, 1],
                mask: &is_selected.map(u8::from),
                labels: None,
                sides: &[(0, [NONE, NONE, 0]), (1, [NONE, NONE, 0])],
                segments: &[[ids[0], ids[1]]],
            };
            let mut mesh = Mesh::new(given, vec![a, b, c, d]).expect("room");
            mesh.copy(0).expect("room");
            let may = mesh.dig_at_piece(0, &p, ids[4], true).expect("room");
            let gets_sliver = [1, 0].map(|k| is_in[k] && !mesh.is_inside(corners[1 - k], &p, ids[4]));
            let is_refused = (0..2).any(|k| gets_sliver[k] && is_selected[k]);
            let context = || format!("seed {seed}: {:?}, {is_selected:?}", [a, b, c, d, p]);
            assert_eq!(may, (is_on || is_in[0] || is_in[1]) && !is_refused, "{}", context());
            n_refused += usize::from(is_refused);
            if !may {
                continue;
            }
            mesh.fill(p, Some(0)).expect("room");
            check_sides(&mesh, &context);
            let mut expected = Vec::new();
            for (corner, polygon) in [[4, 1, 2, 0], [4, 0, 3, 1]].into_iter().enumerate() {
                let mut hole = Hole::default();
                hole.polygon.extend(polygon.map(|k| ids[k]));
                assert!(mesh.fill_polygon(&mut hole, corner as u32, &|_, _, _| true).expect("room"));
                let label = if is_selected[corner] { 0 } else { u32::MAX };
                expected.extend(hole.triangles.iter().map(|&(row, _)| (from_least(row), label)));
            }
            let live = mesh.triangles.iter().filter(|triangle| triangle.is_live());
            let mut found: Vec<_> = live.map(|t| (from_least(t.corners), t.label)).collect();
            expected.sort_unstable();
            found.sort_unstable();
            assert_eq!(found, expected, "{}", context());
            n_split += 1;
            n_with_sliver += usize::from(gets_sliver.contains(&true));
        }
        assert!(
            n_split > 500 && n_with_sliver > 50 && n_refused > 50,
            "{n_split}, {n_with_sliver}, {n_refused}"
        );
    }

    /// Neighbours know each other, and the two pieces are at the sides between their ends alone.
    fn check_sides(mesh: &Mesh, context: &dyn Fn() -> String) {
        let pieces: Vec<_> = mesh.pieces.iter().map(|piece| piece.ends).collect();
        assert_eq!(pieces, [[0, 4], [4, 1]].map(|ends| ends.map(VertexId::at)), "{}", context());
        for (t, triangle) in (0..).zip(&mesh.triangles).filter(|(_, triangle)| triangle.is_live()) {
            for i in 0..3 {
                let [u, w] = triangle.ends(i);
                let piece = pieces.iter().position(|ends| ends.contains(&u) && ends.contains(&w));
                assert_eq!(triangle.pieces[i], piece.map_or(NONE, |k| k as u32), "{}", context());
                let across = triangle.across[i];
                if across != Side::NONE {
                    let other = mesh.triangle(across.triangle());
                    assert_eq!(other.ends(across.index()), [w, u], "{}", context());
                    assert_eq!(other.across[across.index()], Side::new(t, i), "{}", context());
                } else {
                    assert!(
                        piece.is_none() && [u, w].iter().any(|v| (2..4).contains(&v.index())),
                        "{}",
                        context()
                    );
                }
            }
        }
        for (k, piece) in (0..).zip(&mesh.pieces) {
            assert_eq!(mesh.triangle(piece.side.triangle()).pieces[piece.side.index()], k, "{}", context());
        }
        (0..5).map(VertexId::at).for_each(|v| {
            assert!(mesh.corners_of(mesh.at[v]).0.contains(&v), "{}", context());
        });
    }

    /// The corners from the least one on.
    fn from_least(row: [VertexId; 3]) -> [VertexId; 3] {
        let first = (0..3).min_by_key(|&i| row[i]).expect("three");
        [row[first], row[next(first)], row[previous(first)]]
    }
}
