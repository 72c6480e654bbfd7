//! The triangles that are refined: corners, neighbours, and which sides are segments.
//!
//! It is a copy of the cells of a triangulation, without what moving vertices needs. Vertices keep their numbers, by
//! which ties are broken; new ones have higher numbers. So by uniqueness the triangles are at any time those of a fresh
//! constrained build.
//!
//! **Insertion.** The triangles whose circles have the new vertex inside are found from the one that it is in, across sides
//! that are no segments (Lawson's flips, without making them): each is entered by one side, and the next ones are across
//! its two others. So the sides of the cavity come in counter-clockwise order around the new vertex, and the triangles
//! that fill it are beside each other in that order.
//!
//! **A segment is split** at a rounded place, which need not be on it. The two triangles at the segment take the place of a
//! cavity to begin with: the new vertex has to be strictly inside the four lines of their other sides, and inside
//! their circles. Then its pieces cross nothing, and the rest is an insertion.

use crate::error::{Error, Result};
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::predicates::{self, StaticFilter};

/// No triangle, no piece.
pub(crate) const NONE: u32 = u32::MAX;

/// What triangles have for a label that are not to be refined.
pub(crate) const NOT_SELECTED: u32 = u32::MAX;

/// Greatest number of triangles between a place and where rounding puts it.
const MAX_STEPS: usize = 8;

/// Greatest number of triangles.
const MAX_TRIANGLES: usize = 1 << 30;

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
    const FREE: Triangle = Triangle {
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
    /// Whether it stays whole.
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

/// Where a place is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// In this triangle, maybe on a side that is no segment.
    Inside(u32),
    /// Behind a segment, or on it: the piece, seen from where the walk began.
    Behind(u32),
    /// At a vertex, or out of reach.
    Nowhere,
}

/// Triangles, and the pieces of segments among them.
#[derive(Debug)]
pub(super) struct Mesh {
    /// By vertex.
    pub(super) points: Vec<[f64; 2]>,
    pub(super) triangles: Vec<Triangle>,
    pub(super) free: Vec<u32>,
    /// The first ones are the segments that were given.
    pub(super) pieces: Vec<Piece>,
    /// A triangle of each vertex, [`NONE`] of those that are in none.
    pub(super) at: Vec<u32>,
    pub(super) filter: StaticFilter,
    /// The triangles of a cavity, and its sides, counter-clockwise.
    pub(super) cells: Vec<u32>,
    pub(super) rim: Vec<Rim>,
    waiting: Vec<Side>,
    /// The triangles made last.
    pub(super) made: Vec<u32>,
}

/// A triangulation that is to be refined.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Given<'a> {
    /// By vertex; those of vertices that are in no cell are not read.
    pub points: &'a [[f64; 2]],
    /// Counter-clockwise.
    pub corners: &'a [[VertexId; 3]],
    /// Cell across the edge opposite each corner, [`CellId::NONE`] on the hull.
    pub neighbours: &'a [[CellId; 3]],
    /// Segment at the edge opposite each corner, by its place among `segments`, [`NONE`] where there is none.
    pub sides: &'a [[u32; 3]],
    /// The label of each cell, [`NOT_SELECTED`] for those that stay as they are.
    pub labels: &'a [u32],
    /// Ends of each segment.
    pub segments: &'a [[VertexId; 2]],
}

impl Mesh {
    /// A copy of what is given.
    pub(super) fn new(given: &Given) -> Result<Self> {
        let n = given.corners.len();
        let mut triangles = Vec::new();
        memory::reserve(&mut triangles, n + n / 2)?;
        let mut at = Vec::new();
        memory::lengthen(&mut at, given.points.len(), NONE)?;
        let mut pieces = Vec::new();
        memory::collect(
            &mut pieces,
            (0..).zip(given.segments).map(|(segment, &ends)| Piece {
                ends,
                side: Side::NONE,
                segment,
                next: NONE,
                is_fixed: false,
            }),
        )?;
        let (mut lower, mut upper) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for (t, &corners) in given.corners.iter().enumerate() {
            let across = std::array::from_fn(|i| {
                let neighbour = given.neighbours[t][i];
                if neighbour == CellId::NONE {
                    return Side::NONE;
                }
                let start = corners[next(i)];
                let beyond = &given.corners[neighbour];
                // The corner before the one that is opposite has the side's first end.
                let j = (0..3).find(|&j| beyond[previous(j)] == start).expect("neighbours share an edge");
                Side::new(neighbour.get(), j)
            });
            for (i, (&v, &piece)) in corners.iter().zip(&given.sides[t]).enumerate() {
                at[v] = t as u32;
                for axis in 0..2 {
                    let x = given.points[v][axis];
                    (lower[axis], upper[axis]) = (lower[axis].min(x), upper[axis].max(x));
                }
                if piece != NONE {
                    pieces[piece as usize].side = Side::new(t as u32, i);
                }
            }
            triangles.push(Triangle { corners, across, pieces: given.sides[t], label: given.labels[t] });
        }
        Ok(Mesh {
            points: memory::copy_of(given.points)?,
            triangles,
            free: Vec::new(),
            pieces,
            at,
            filter: StaticFilter::plane(lower, upper),
            cells: Vec::new(),
            rim: Vec::new(),
            waiting: Vec::new(),
            made: Vec::new(),
        })
    }

    #[inline(always)]
    pub(super) fn triangle(&self, t: u32) -> &Triangle {
        &self.triangles[t as usize]
    }

    #[inline(always)]
    pub(super) fn point(&self, v: VertexId) -> &[f64; 2] {
        &self.points[v]
    }

    /// Twice the area of a triangle of two vertices and a place, with its sign.
    #[inline(always)]
    pub(super) fn turn(&self, [v, w]: [VertexId; 2], p: &[f64; 2]) -> f64 {
        predicates::orient2d(&self.filter, self.point(v), self.point(w), p)
    }

    /// Whether a vertex of this number at `p` is inside the circle of three others, which are counter-clockwise.
    #[inline(always)]
    pub(super) fn is_inside(&self, corners: [VertexId; 3], p: &[f64; 2], id: VertexId) -> bool {
        let [a, b, c] = corners.map(|v| self.point(v));
        predicates::incircle_perturbed(&self.filter, [a, b, c, p], || {
            let [i, j, k] = corners.map(VertexId::get);
            [i, j, k, id.get()]
        })
    }

    /// The corner opposite a side.
    #[inline(always)]
    pub(super) fn apex(&self, side: Side) -> VertexId {
        self.triangle(side.triangle()).corners[side.index()]
    }

    #[inline(always)]
    pub(super) fn across(&self, side: Side) -> Side {
        self.triangle(side.triangle()).across[side.index()]
    }

    /// The two sides of a piece, the one with the piece's direction first; [`Side::NONE`] beyond the hull.
    pub(super) fn sides_of(&self, piece: u32) -> [Side; 2] {
        let Piece { ends, side, .. } = self.pieces[piece as usize];
        let other = self.across(side);
        let starts = self.triangle(side.triangle()).ends(side.index())[0];
        if starts == ends[0] { [side, other] } else { [other, side] }
    }

    /// Walks straight from the corner opposite a side of a triangle, which it leaves by that side if at all, to `p`.
    pub(super) fn walk(&self, from: Side, p: &[f64; 2]) -> Place {
        let origin = self.apex(from);
        let mut side = from;
        // No triangle is entered twice.
        for _ in 0..=self.triangles.len() {
            let triangle = self.triangle(side.triangle());
            let beyond = -self.turn(triangle.ends(side.index()), p);
            let piece = triangle.pieces[side.index()];
            if beyond < 0.0 || (beyond == 0.0 && piece == NONE) {
                return self.settle(side.triangle(), p);
            }
            if piece != NONE {
                return Place::Behind(piece);
            }
            let entered = triangle.across[side.index()];
            if entered == Side::NONE {
                return Place::Nowhere;
            }
            // The way goes between the apex and the end of the side that is not on the apex's side of it.
            let apex = self.point(self.apex(entered));
            let is_left = predicates::orient2d(&self.filter, self.point(origin), p, apex) > 0.0;
            side = if is_left { entered.next() } else { entered.previous() };
        }
        Place::Nowhere
    }

    /// Where a place is that should be in this triangle, and is in it or, by rounding, near it.
    fn settle(&self, mut t: u32, p: &[f64; 2]) -> Place {
        'near: for _ in 0..MAX_STEPS {
            let triangle = self.triangle(t);
            if triangle.corners.iter().any(|&v| self.point(v) == p) {
                return Place::Nowhere;
            }
            for i in 0..3 {
                let turn = self.turn(triangle.ends(i), p);
                if turn > 0.0 || (turn == 0.0 && triangle.pieces[i] == NONE) {
                    continue;
                }
                if triangle.pieces[i] != NONE {
                    return Place::Behind(triangle.pieces[i]);
                }
                if triangle.across[i] == Side::NONE {
                    return Place::Nowhere;
                }
                t = triangle.across[i].triangle();
                continue 'near;
            }
            return Place::Inside(t);
        }
        Place::Nowhere
    }

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
            let &Triangle { across, pieces, label, .. } = self.triangle(side.triangle());
            let (across, piece) = (across[side.index()], pieces[side.index()]);
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

    /// Takes slots for `n` triangles, those of the cavity first, as `made`.
    pub(super) fn claim(&mut self, n: usize) -> Result<()> {
        let n_new = n.saturating_sub(self.cells.len() + self.free.len());
        if self.triangles.len() + n_new > MAX_TRIANGLES {
            return Err(Error::TooManyCells { limit: MAX_TRIANGLES });
        }
        memory::reserve(&mut self.triangles, n_new)?;
        memory::reserve(&mut self.free, self.cells.len())?;
        self.made.clear();
        memory::reserve(&mut self.made, n)?;
        for &t in &self.cells {
            if self.made.len() < n {
                self.made.push(t);
            } else {
                self.triangles[t as usize] = Triangle::FREE;
                self.free.push(t);
            }
        }
        while self.made.len() < n {
            let t = self.free.pop().unwrap_or_else(|| {
                self.triangles.push(Triangle::FREE);
                (self.triangles.len() - 1) as u32
            });
            self.made.push(t);
        }
        Ok(())
    }

    /// Tells what is across a side, and the piece there, of it.
    #[inline(always)]
    pub(super) fn join(&mut self, side: Side, across: Side, piece: u32) {
        if across != Side::NONE {
            self.triangles[across.triangle() as usize].across[across.index()] = side;
        }
        if piece != NONE {
            self.pieces[piece as usize].side = side;
        }
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
