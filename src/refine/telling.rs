//! Refinement from what is given to what is told, in the numbers of what was given.

use super::coarsening::{Candidate, strip};
use super::criteria::Tests;
use super::given::Given;
use super::mesh::Mesh;
use super::parts::{NONE, Piece, Side};
use super::refinement::{Kept, Origins, Refinement};
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;

/// What a refinement has done.
#[derive(Debug, Default)]
pub(crate) struct Refined {
    /// The new vertices in the order of their numbers, the first of which is the number of those given; each with the
    /// segment that it is on, or [`NONE`].
    pub vertices: Vec<([f64; 2], u32)>,
    /// The vertices given that have been taken away.
    pub removed: Vec<VertexId>,
    /// By segment the one to which it has been joined, itself if to none; empty if no vertices have been taken away.
    pub into: Vec<u32>,
    /// The sizes of the new vertices, if there are sizes.
    pub sizes: Vec<f64>,
    /// The segments that others take the place of, ascending, each with where its vertices end in `chain`; none where it has
    /// been joined to the one before.
    pub replaced: Vec<(u32, usize)>,
    /// The vertices of what takes the place of these segments, from end to end.
    pub chain: Vec<VertexId>,
    /// Pieces that had to be split and could not, as there is no room for a vertex on them.
    pub n_unsplit: usize,
    /// Selected triangles that are bad.
    pub n_bad: usize,
    /// Whether the limit was reached.
    pub is_cut_short: bool,
}

/// Refines the cells that are selected. `points` are the places of vertices, and `bad` the cells, ascending, that are bad or
/// have segments that are encroached.
pub(crate) fn refine(
    given: Given,
    points: Vec<[f64; 2]>,
    bad: &[u32],
    tests: Tests,
    origins: Origins,
    (kept, limit): (Kept, usize),
    ask: &mut dyn FnMut() -> Result<()>,
) -> Result<Refined> {
    let mut refinement = Refinement::new(Mesh::new(given, points)?, tests, origins, kept)?;
    // What is added depends on the order, and copies of a triangulation have their cells in another one.
    let mut by_corners = Vec::new();
    memory::collect(&mut by_corners, bad.iter().map(|&cell| (given.row(cell), cell)))?;
    by_corners.sort_unstable();
    refinement.see_flat(by_corners.iter().map(|&(_, cell)| cell))?;
    for &(_, cell) in &by_corners {
        let t = refinement.mesh.copy(cell)?;
        refinement.examine(t)?;
    }
    let is_cut_short = refinement.go_on(limit, ask)?;
    refinement.tell(is_cut_short)
}

/// Takes all vertices away that are `made`, by [`strip`] without tests, and refines the selected cells from there.
pub(crate) fn remesh<'a>(
    given: Given<'a>,
    points: Vec<[f64; 2]>,
    (made, no_tests, offset): (&[Candidate], Tests<'a>, f64),
    tests: Tests<'a>,
    origins: Origins,
    (kept, limit): (Kept, usize),
    ask: &mut dyn FnMut() -> Result<()>,
) -> Result<Refined> {
    let (mut mesh, removed, into) = strip(given, points, no_tests, offset, made)?;
    for cell in (0..given.mask.len() as u32).filter(|&cell| given.mask[cell as usize] != 0) {
        mesh.copy(cell)?;
    }
    let mut refinement = Refinement::new(mesh, tests, origins, kept)?;
    refinement.examine_all()?;
    let is_cut_short = refinement.go_on(limit, ask)?;
    Ok(Refined { removed, into, ..refinement.tell(is_cut_short)? })
}

/// Those of the bad cells for which [`refine`] would do something now.
pub(crate) fn mendable(
    given: Given,
    points: Vec<[f64; 2]>,
    bad: &[u32],
    tests: Tests,
    origins: Origins,
    kept: Kept,
) -> Result<Vec<u32>> {
    let mut refinement = Refinement::new(Mesh::new(given, points)?, tests, origins, kept)?;
    let mut mendable = Vec::new();
    refinement.see_flat(bad.iter().copied())?;
    for &cell in bad {
        let t = refinement.mesh.copy(cell)?;
        if refinement.would_change(t)? {
            memory::push(&mut mendable, cell)?;
        }
    }
    refinement.tests.check_stop()?;
    Ok(mendable)
}

impl Refinement<'_> {
    /// Whether a piece would have to be split, and there is no room.
    fn is_unsplit(&self, piece: &Piece) -> bool {
        let is_touched = |side: Side| {
            side != Side::NONE
                && side.unread_cell().is_none()
                && self.mesh.triangle(side.triangle()).is_selected()
                && self.is_seen_wide(side)
        };
        let is_live = piece.ends[0] != VertexId::NONE && piece.side.unread_cell().is_none();
        is_live && (piece.is_fixed || is_touched(piece.side) || is_touched(self.mesh.across(piece.side)))
    }

    /// Numbers the vertices that have stayed, and lists what has become of the segments.
    fn tell(self, is_cut_short: bool) -> Result<Refined> {
        let n = self.mesh.triangles.len() as u32;
        let n_bad =
            (0..n).filter(|&t| self.mesh.triangle(t).is_selected() && self.measure(t).flaw.is_some()).count();
        self.tests.check_stop()?;
        let n_unsplit = self.mesh.pieces.iter().filter(|piece| self.is_unsplit(piece)).count();
        let mut told = Refined { is_cut_short, n_bad, n_unsplit, ..Refined::default() };
        let mut segment_of = Vec::new();
        memory::lengthen(&mut segment_of, self.mesh.points.len() - self.n_given, NONE)?;
        let is_live = |piece: &&Piece| piece.ends[0] != VertexId::NONE;
        for piece in self.mesh.pieces.iter().filter(is_live) {
            for v in piece.ends.into_iter().filter(|v| v.index() >= self.n_given) {
                segment_of[v.index() - self.n_given] = piece.segment;
            }
        }
        let mut number = Vec::new();
        memory::lengthen(&mut number, segment_of.len(), VertexId::NONE)?;
        memory::reserve(&mut told.vertices, self.n_added)?;
        memory::reserve(&mut told.sizes, if self.sizes.is_empty() { 0 } else { self.n_added })?;
        for (k, &segment) in segment_of.iter().enumerate() {
            if self.mesh.at[self.n_given + k] != NONE {
                number[k] = VertexId::at(self.n_given + told.vertices.len());
                told.vertices.push((self.mesh.points[self.n_given + k], segment));
                told.sizes.extend(self.sizes.get(self.n_given + k));
            }
        }
        let renamed =
            |v: VertexId| if v.index() < self.n_given { v } else { number[v.index() - self.n_given] };
        for (segment, ends) in (0..).zip(self.mesh.given.segments) {
            let mut piece = &self.mesh.pieces[segment as usize];
            if piece.next == NONE && piece.ends == *ends {
                continue;
            }
            if piece.ends[0] != VertexId::NONE {
                memory::push(&mut told.chain, renamed(piece.ends[0]))?;
                memory::push(&mut told.chain, renamed(piece.ends[1]))?;
                while piece.next != NONE {
                    piece = &self.mesh.pieces[piece.next as usize];
                    memory::push(&mut told.chain, renamed(piece.ends[1]))?;
                }
            }
            memory::push(&mut told.replaced, (segment, told.chain.len()))?;
        }
        Ok(told)
    }
}
