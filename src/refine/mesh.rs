//! The triangles that are refined: corners, neighbours, and which sides are segments.
//!
//! They are a copy of the cells of a triangulation, without what moving vertices needs: of those alone that are looked
//! at, each when it is first entered. Vertices keep their numbers, by which ties are broken; new ones have higher
//! numbers. So by uniqueness the triangles are at any time those of a fresh constrained build.
//!
//! A side beyond which nothing has been copied names the cell there ([`Side::unread`]); to [cross](Mesh::cross) it copies
//! the cell. A cell that has not been copied has the neighbours that it was given with: before one of these is replaced,
//! all around it are copied.

use super::given::Given;
use super::parts::{NONE, Piece, Rim, Side, Triangle, UNREAD, next, previous};
use crate::delaunay::Plane;
use crate::error::{Error, Result};
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::predicates::{self, StaticFilter};

/// Triangles, and the pieces of segments among them.
#[derive(Debug)]
pub(super) struct Mesh<'a> {
    pub(super) given: Given<'a>,
    /// By vertex.
    pub(super) points: Vec<[f64; 2]>,
    /// Copies of cells, and those made.
    pub(super) triangles: Vec<Triangle>,
    pub(super) free: Vec<u32>,
    /// By cell that was given, the triangle that is or was its copy; [`NONE`] if it has not been copied.
    copies: Vec<u32>,
    /// How many have not been.
    n_unread: usize,
    /// Cells that are to be copied.
    to_copy: Vec<u32>,
    /// The first ones are the segments that were given.
    pub(super) pieces: Vec<Piece>,
    /// A triangle of each vertex, maybe one that has not been copied; [`NONE`] of those that are in none.
    pub(super) at: Vec<u32>,
    pub(super) filter: StaticFilter,
    /// The triangles of a cavity, and its sides, counter-clockwise.
    pub(super) cells: Vec<u32>,
    pub(super) rim: Vec<Rim>,
    pub(super) waiting: Vec<Side>,
    /// The triangles made last.
    pub(super) made: Vec<u32>,
}

impl<'a> Mesh<'a> {
    /// What is given, with the places of vertices, and none copied.
    pub(super) fn new(given: Given<'a>, points: Vec<[f64; 2]>) -> Result<Self> {
        let n = given.corners.len();
        if n > UNREAD as usize {
            return Err(Error::TooManyCells { limit: UNREAD as usize });
        }
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
        for &(cell, sides) in given.sides {
            for piece in sides.into_iter().filter(|&piece| piece != NONE) {
                pieces[piece as usize].side = Side::unread(cell);
            }
        }
        let mut at = memory::copy_of(given.at)?;
        at.iter_mut().filter(|t| **t != NONE).for_each(|t| *t |= UNREAD);
        let mut copies = Vec::new();
        memory::lengthen(&mut copies, n, NONE)?;
        Ok(Mesh {
            given,
            points,
            triangles: Vec::new(),
            free: Vec::new(),
            copies,
            n_unread: n,
            to_copy: Vec::new(),
            pieces,
            at,
            filter: StaticFilter::plane(given.lower, given.upper),
            cells: Vec::new(),
            rim: Vec::new(),
            waiting: Vec::new(),
            made: Vec::new(),
        })
    }

    /// No more than this many triangles are there.
    pub(super) fn n_triangles(&self) -> usize {
        self.n_unread + self.triangles.len()
    }

    /// The triangle of a number that may be that of a cell that has not been copied.
    #[inline(always)]
    pub(super) fn read(&mut self, t: u32) -> Result<u32> {
        if t & UNREAD == 0 { Ok(t) } else { self.copy(t & !UNREAD) }
    }

    /// The triangle that a cell has been copied to, if it has.
    #[inline(always)]
    pub(super) fn copy_of(&self, cell: u32) -> Option<u32> {
        Some(self.copies[cell as usize]).filter(|&t| t != NONE)
    }

    /// The triangle of a cell, which is copied if it has not been, with all that are beyond segments from there on.
    #[cold]
    pub(super) fn copy(&mut self, cell: u32) -> Result<u32> {
        self.to_copy.clear();
        memory::push(&mut self.to_copy, cell)?;
        while let Some(cell) = self.to_copy.pop() {
            if self.copies[cell as usize] == NONE {
                self.copy_one(cell)?;
            }
        }
        Ok(self.copies[cell as usize])
    }

    fn copy_one(&mut self, cell: u32) -> Result<()> {
        let given = self.given;
        let (corners, neighbours, pieces) = (given.row(cell), given.across(cell), given.sides_of(cell));
        let t = self.triangles.len() as u32;
        memory::reserve(&mut self.triangles, 1)?;
        memory::reserve(&mut self.to_copy, 3)?;
        let mut across = [Side::NONE; 3];
        for i in 0..3 {
            if neighbours[i] == CellId::NONE {
                continue;
            }
            let beyond = self.copies[neighbours[i].index()];
            if beyond == NONE {
                across[i] = Side::unread(neighbours[i].get());
                if pieces[i] != NONE {
                    self.to_copy.push(neighbours[i].get());
                }
                continue;
            }
            // The corner before the one that is opposite has the side's first end.
            let row = self.triangle(beyond).corners;
            let start = corners[next(i)];
            let j = (0..3).find(|&j| row[previous(j)] == start).expect("neighbours share an edge");
            across[i] = Side::new(beyond, j);
            self.triangles[beyond as usize].across[j] = Side::new(t, i);
        }
        for (i, &piece) in pieces.iter().enumerate() {
            if piece != NONE {
                self.pieces[piece as usize].side = Side::new(t, i);
            }
        }
        self.copies[cell as usize] = t;
        self.n_unread -= 1;
        self.triangles.push(Triangle { corners, across, pieces, label: given.label(cell) });
        Ok(())
    }

    /// What is across a side, copied.
    #[inline(always)]
    pub(super) fn cross(&mut self, side: Side) -> Result<Side> {
        let across = self.across(side);
        if let Some(cell) = across.unread_cell() {
            self.copy(cell)?;
            return Ok(self.across(side));
        }
        Ok(across)
    }

    /// Copies the triangles at a piece.
    pub(super) fn read_piece(&mut self, piece: u32) -> Result<()> {
        match self.pieces[piece as usize].side.unread_cell() {
            Some(cell) => self.copy(cell).map(|_| ()),
            None => Ok(()),
        }
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
            let [i, j, k] = corners;
            let first_made = VertexId::at(self.given.at.len());
            self.given.keys.ranks_with_made::<Plane, 4>(first_made, [i, j, k, id], || [*a, *b, *c, *p])
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

    /// The two sides of a piece of copied triangles, the one with the piece's direction first; [`Side::NONE`] beyond the hull.
    pub(super) fn sides_of(&self, piece: u32) -> [Side; 2] {
        let Piece { ends, side, .. } = self.pieces[piece as usize];
        let other = self.across(side);
        let starts = self.triangle(side.triangle()).ends(side.index())[0];
        if starts == ends[0] { [side, other] } else { [other, side] }
    }

    /// Takes slots for `n` triangles, those of the cavity first, as `made`.
    pub(super) fn claim(&mut self, n: usize) -> Result<()> {
        let n_new = n.saturating_sub(self.cells.len() + self.free.len());
        if self.n_triangles() + n_new > UNREAD as usize {
            return Err(Error::TooManyCells { limit: UNREAD as usize });
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
}
