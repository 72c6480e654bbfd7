//! What waits for a commit.

use crate::delaunay::Dimension;
use crate::error::{Error, Result, StagedEdit};
use crate::ids::VertexId;
use crate::machine::memory;

/// Moves, insertions and removals that are staged.
#[derive(Debug)]
pub(super) struct Staged<G: Dimension> {
    /// Vertices, and where they go.
    moves: Vec<(VertexId, G::Point)>,
    /// By vertex, whether it is among those that move, and whether it goes; as long as any is.
    marks: Vec<u8>,
    insertions: Vec<G::Point>,
    removals: Vec<VertexId>,
}

const MOVES: u8 = 1;
const GOES: u8 = 2;

impl<G: Dimension> Default for Staged<G> {
    fn default() -> Self {
        let (moves, marks, insertions, removals) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Staged { moves, marks, insertions, removals }
    }
}

impl<G: Dimension> Staged<G> {
    pub(super) fn moves(&self) -> &[(VertexId, G::Point)] {
        &self.moves
    }

    pub(super) fn insertions(&self) -> &[G::Point] {
        &self.insertions
    }

    pub(super) fn removals(&self) -> &[VertexId] {
        &self.removals
    }

    pub(super) fn goes(&self, vertex: VertexId) -> bool {
        self.has(vertex, GOES)
    }

    fn has(&self, vertex: VertexId, mark: u8) -> bool {
        self.marks.get(vertex.index()).is_some_and(|marks| marks & mark != 0)
    }

    fn make_room(&mut self, n_vertices: usize) -> Result<()> {
        memory::lengthen(&mut self.marks, n_vertices, 0)
    }

    /// Checks that a vertex that is there can move, or go.
    fn check(&self, index: usize, vertex: VertexId) -> Result<()> {
        let argument = "vertices";
        if self.has(vertex, GOES) {
            return Err(Error::StagedVertex { argument, index, vertex, staged: StagedEdit::Removal });
        }
        Ok(())
    }

    /// Stages moves of vertices that are there, each with its place among what the program has given; all of them, or none.
    pub(super) fn move_vertices(
        &mut self,
        n_vertices: usize,
        moves: impl Iterator<Item = (usize, Result<(VertexId, G::Point)>)>,
    ) -> Result<()> {
        self.make_room(n_vertices)?;
        let before = self.moves.len();
        for (index, one) in moves {
            let staged = one.and_then(|(vertex, goal)| {
                self.check(index, vertex)?;
                if self.has(vertex, MOVES) {
                    return Err(Error::DuplicateMove { argument: "vertices", index, vertex });
                }
                memory::push(&mut self.moves, (vertex, goal))?;
                self.marks[vertex] |= MOVES;
                Ok(())
            });
            if staged.is_err() {
                for (vertex, _) in self.moves.drain(before..) {
                    self.marks[vertex.index()] &= !MOVES;
                }
                return staged;
            }
        }
        Ok(())
    }

    /// Stages removals of vertices that are there; all of them, or none. Their moves are forgotten by the commit.
    pub(super) fn remove(
        &mut self,
        n_vertices: usize,
        vertices: impl Iterator<Item = Result<VertexId>>,
    ) -> Result<()> {
        self.make_room(n_vertices)?;
        let before = self.removals.len();
        for (index, one) in vertices.enumerate() {
            let staged = one.and_then(|vertex| {
                self.check(index, vertex)?;
                memory::push(&mut self.removals, vertex)?;
                self.marks[vertex] |= GOES;
                Ok(())
            });
            if staged.is_err() {
                for vertex in self.removals.drain(before..) {
                    self.marks[vertex.index()] &= !GOES;
                }
                return staged;
            }
        }
        Ok(())
    }

    /// Stages insertions.
    pub(super) fn insert(&mut self, positions: &[G::Point]) -> Result<()> {
        memory::append(&mut self.insertions, positions)
    }

    /// The first of the insertions are at these positions.
    pub(super) fn place_insertions(&mut self, positions: &[G::Point]) {
        self.insertions[..positions.len()].copy_from_slice(positions);
    }

    /// The first vertex whose move is staged.
    pub(super) fn first_moving(&self) -> Option<VertexId> {
        self.moves.iter().map(|&(vertex, _)| vertex).min()
    }

    /// Forgets all; how many moves there were.
    pub(super) fn clear(&mut self) -> usize {
        let n = self.moves.len();
        self.moves.clear();
        self.insertions.clear();
        self.removals.clear();
        self.marks.clear();
        n
    }

    pub(super) fn copied(&self) -> Result<Self> {
        Ok(Staged {
            moves: memory::copy_of(&self.moves)?,
            marks: memory::copy_of(&self.marks)?,
            insertions: memory::copy_of(&self.insertions)?,
            removals: memory::copy_of(&self.removals)?,
        })
    }

    /// Forgets the move and the removal of a vertex.
    pub(super) fn forget(&mut self, vertex: VertexId) {
        self.moves.retain(|&(moving, _)| moving != vertex);
        self.removals.retain(|&going| going != vertex);
        if let Some(marks) = self.marks.get_mut(vertex.index()) {
            *marks = 0;
        }
    }

    /// The edits with the vertices under new ids; there are `n_vertices` vertices.
    pub(super) fn renumbered(&self, new_ids: &[VertexId], n_vertices: usize) -> Result<Self> {
        let mut new = self.copied()?;
        new.marks.clear();
        new.make_room(n_vertices)?;
        new.moves.iter_mut().for_each(|(vertex, _)| *vertex = new_ids[*vertex]);
        new.removals.iter_mut().for_each(|vertex| *vertex = new_ids[*vertex]);
        new.moves.iter().for_each(|(vertex, _)| new.marks[vertex.index()] |= MOVES);
        new.removals.iter().for_each(|vertex| new.marks[vertex.index()] |= GOES);
        Ok(new)
    }

    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.moves)
            + memory::bytes_of(&self.marks)
            + memory::bytes_of(&self.insertions)
            + memory::bytes_of(&self.removals)
    }
}
