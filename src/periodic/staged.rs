//! What waits for a commit.

use crate::delaunay::Moving;
use crate::error::{Error, Result, StagedEdit};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{PointPart, copy_part, set_part};

/// Moves, insertions and removals that are staged.
#[derive(Debug)]
pub(super) struct Staged<G: Moving> {
    /// Vertices, and where they go: with weights, the part of that which is not staged is what they have.
    moves: Vec<(VertexId, G::Point)>,
    /// By vertex, which parts of it are staged, and whether it goes; as long as any is.
    marks: Vec<u8>,
    /// With weights, by vertex that is among those that move, its place in the list.
    entries: Vec<u32>,
    insertions: Vec<G::Point>,
    removals: Vec<VertexId>,
}

/// Marks that a place, or a weight, is staged.
const MOVES: u8 = PointPart::Place.bit() | PointPart::Weight.bit();
/// Marks that a removal is staged.
const GOES: u8 = 4;

impl<G: Moving> Default for Staged<G> {
    fn default() -> Self {
        let (moves, insertions, removals) = (Vec::new(), Vec::new(), Vec::new());
        Staged { moves, marks: Vec::new(), entries: Vec::new(), insertions, removals }
    }
}

impl<G: Moving> Staged<G> {
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

    /// Whether a part of a vertex is staged.
    pub(super) fn is_moving(&self, vertex: VertexId) -> bool {
        self.has(vertex, MOVES)
    }

    /// Whether this part of a vertex is staged.
    pub(super) fn has_part(&self, vertex: VertexId, part: PointPart) -> bool {
        self.has(vertex, part.bit())
    }

    fn make_room(&mut self, n_vertices: usize) -> Result<()> {
        if G::HAS_WEIGHTS {
            memory::lengthen(&mut self.entries, n_vertices, 0)?;
        }
        memory::lengthen(&mut self.marks, n_vertices, 0)
    }

    /// Enters where the vertices of the list are in it; there is room.
    fn index_moves(&mut self) {
        if G::HAS_WEIGHTS {
            for (entry, &(vertex, _)) in self.moves.iter().enumerate() {
                self.entries[vertex.index()] = entry as u32;
            }
        }
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
                self.push_move(vertex, goal, MOVES)
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

    fn push_move(&mut self, vertex: VertexId, goal: G::Point, marks: u8) -> Result<()> {
        memory::push(&mut self.moves, (vertex, goal))?;
        self.marks[vertex] |= marks;
        if G::HAS_WEIGHTS {
            self.entries[vertex] = self.moves.len() as u32 - 1;
        }
        Ok(())
    }

    /// Stages one part of vertices that are there, each with its place among what the program has given, by which `row` tells the
    /// numbers; all of them, or none. `present` tells what they have.
    pub(super) fn move_parts<'n>(
        &mut self,
        part: PointPart,
        n_vertices: usize,
        vertices: &[(usize, VertexId)],
        row: impl Fn(usize) -> &'n [f64],
        present: impl Fn(VertexId) -> G::Point,
    ) -> Result<()> {
        self.make_room(n_vertices)?;
        for (k, &(index, vertex)) in vertices.iter().enumerate() {
            let staged = self.check(index, vertex).and_then(|()| {
                if self.has_part(vertex, part) {
                    return Err(Error::DuplicateMove { argument: "vertices", index, vertex });
                }
                if !self.has(vertex, MOVES) {
                    self.push_move(vertex, present(vertex), 0)?;
                }
                self.marks[vertex] |= part.bit();
                let entry = self.entries[vertex] as usize;
                set_part::<G>(&mut self.moves[entry].1, part, row(index));
                Ok(())
            });
            if staged.is_err() {
                for &(_, vertex) in vertices[..k].iter().rev() {
                    self.marks[vertex] &= !part.bit();
                    if self.has(vertex, MOVES) {
                        let entry = self.entries[vertex] as usize;
                        copy_part::<G>(&mut self.moves[entry].1, part, &present(vertex));
                    } else {
                        self.moves.pop();
                    }
                }
                return staged;
            }
        }
        Ok(())
    }

    /// A vertex that is to be inserted has this part.
    pub(super) fn set_part_of_insertion(&mut self, index: usize, part: PointPart, numbers: &[f64]) {
        set_part::<G>(&mut self.insertions[index], part, numbers);
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
        self.entries.clear();
        n
    }

    pub(super) fn copied(&self) -> Result<Self> {
        Ok(Staged {
            moves: memory::copy_of(&self.moves)?,
            marks: memory::copy_of(&self.marks)?,
            entries: memory::copy_of(&self.entries)?,
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
        self.index_moves();
    }

    /// The edits with the vertices under new ids; there are `n_vertices` vertices.
    pub(super) fn renumbered(&self, new_ids: &[VertexId], n_vertices: usize) -> Result<Self> {
        let mut new = self.copied()?;
        new.marks.clear();
        new.make_room(n_vertices)?;
        for (vertex, _) in &mut new.moves {
            let marks = self.marks[vertex.index()];
            *vertex = new_ids[*vertex];
            new.marks[vertex.index()] |= marks & MOVES;
        }
        new.removals.iter_mut().for_each(|vertex| *vertex = new_ids[*vertex]);
        new.removals.iter().for_each(|vertex| new.marks[vertex.index()] |= GOES);
        new.index_moves();
        Ok(new)
    }

    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.moves)
            + memory::bytes_of(&self.marks)
            + memory::bytes_of(&self.entries)
            + memory::bytes_of(&self.insertions)
            + memory::bytes_of(&self.removals)
    }
}
