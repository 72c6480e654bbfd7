//! Bad triangles that refinement has left, and would not leave once vertices have gone.
//!
//! A triangle is left where a piece that is kept whole, or has no room, is in the way of its centre. If a vertex goes from
//! another piece near it, that piece is longer, and may come to be in the way as well: refinement would split it, and the
//! vertex would come and go in each round. Such vertices stay.

use super::criteria::Tests;
use super::mesh::Mesh;
use super::parts::{Side, next, previous};
use super::refinement::{Kept, Origins, Refinement};
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;

/// The bad cells for which refinement does nothing, ascending, and what it has to know to tell.
pub(crate) struct LeftBad<'a> {
    pub cells: &'a [u32],
    pub origins: Origins,
    pub kept: Kept,
}

/// The vertices, of those that have gone from this mesh, that have to stay so that refinement would do nothing for the
/// cells that it has left. Each is given with the piece that is where it was, [`NONE`](super::parts::NONE) if it was on none.
pub(super) fn wakers(
    mesh: Mesh,
    tests: Tests,
    left: LeftBad,
    gone: &[(VertexId, u32)],
) -> Result<Vec<VertexId>> {
    let mut refinement = Refinement::new(mesh, tests, left.origins, left.kept)?;
    let (mut pieces, mut wakers) = (Vec::new(), Vec::new());
    let mut cells = Vec::new();
    for &cell in left.cells {
        let t = refinement.mesh.copy(cell)?;
        // It may have gone.
        if refinement.mesh.triangle(t).corners == refinement.mesh.given.row(cell) {
            memory::push(&mut cells, cell)?;
        }
    }
    refinement.see_flat(cells.iter().copied())?;
    for cell in cells {
        let t = refinement.mesh.copy(cell)?;
        if !refinement.would_change(t)? {
            continue;
        }
        refinement.list_pieces_for(t, &mut pieces)?;
        let n_before = wakers.len();
        let on_pieces = gone.iter().filter(|(_, piece)| pieces.contains(piece));
        memory::collect(&mut wakers, on_pieces.map(|&(v, _)| v))?;
        // A piece may be seen only since vertices in front of it have gone.
        if wakers.len() == n_before {
            let in_cavity = gone.iter().filter(|&&(v, _)| refinement.is_in_cavity(v));
            memory::collect(&mut wakers, in_cavity.map(|&(v, _)| v))?;
        }
    }
    refinement.tests.check_stop()?;
    wakers.sort_unstable();
    wakers.dedup();
    Ok(wakers)
}

impl Refinement<'_> {
    /// Lists the pieces that would be split for a bad triangle. What is found at its centre is the cavity.
    fn list_pieces_for(&mut self, t: u32, pieces: &mut Vec<u32>) -> Result<()> {
        pieces.clear();
        for i in 0..3 {
            if let Some((piece, _)) = self.wanted_at(Side::new(t, i))?
                && self.may_split(piece)
            {
                memory::push(pieces, piece)?;
            }
        }
        self.mesh.cells.clear();
        let measured = self.measure(t);
        if self.may_mend(t, measured) {
            self.in_the_way.clear();
            self.remedy(t, measured)?;
            let in_the_way = self.in_the_way.iter().map(|&(piece, _)| piece);
            memory::collect(pieces, in_the_way.filter(|&piece| self.may_split(piece)))?;
        }
        Ok(())
    }

    /// Whether a vertex that has gone is in one of the triangles of the cavity.
    fn is_in_cavity(&self, vertex: VertexId) -> bool {
        let p = self.mesh.point(vertex);
        self.mesh.cells.iter().any(|&t| {
            let row = self.mesh.triangle(t).corners;
            (0..3).all(|i| self.mesh.turn([row[next(i)], row[previous(i)]], p) >= 0.0)
        })
    }
}
