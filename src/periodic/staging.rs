//! Staging: what the next commit is to do.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::MAX_VERTICES;
use crate::periodic::lattice::Lattice;
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// Stages a move of `vertices[i]` to `positions[i]` for each `i`; all of them or, on an error, none.
    ///
    /// # Errors
    /// The errors of [`MovingTriangulation::move_vertices`](crate::motion::MovingTriangulation::move_vertices).
    pub fn move_vertices(&mut self, vertices: &[VertexId], positions: &[G::Point]) -> Result<()> {
        if vertices.len() != positions.len() {
            let (given, wanted) = (positions.len(), vertices.len());
            return Err(Error::WrongCount { argument: "count", given, wanted, coming: 0 });
        }
        let images = &self.inside.images;
        let (n, n_coming) = (images.n_vertices(), self.staged.insertions().len());
        let lattice = self.coming.as_ref().unwrap_or(&self.lattice);
        let moves = vertices.iter().zip(positions).enumerate().map(|(index, (&vertex, position))| {
            let checked = images.check(index, vertex, n_coming).and_then(|_| {
                lattice.check("positions", index, position)?;
                Ok((vertex, *position))
            });
            (index, checked)
        });
        self.staged.move_vertices(n, moves)
    }

    /// Stages moves of the vertices with the first ids: vertex `i` goes to `positions[i]`. One whose insertion is staged will be
    /// inserted there. Entries of removed vertices are not read, nor are those of vertices whose removal is staged.
    ///
    /// # Errors
    /// The errors of [`move_vertices`](Self::move_vertices), and [`Error::WrongCount`] if there are more than ids.
    pub fn move_first(&mut self, positions: &[G::Point]) -> Result<()> {
        let (given, wanted) = (positions.len(), self.id_count());
        if given > wanted {
            let coming = self.staged.insertions().len();
            return Err(Error::WrongCount { argument: "count", given, wanted, coming });
        }
        let images = &self.inside.images;
        let n = images.n_vertices();
        let mut going = Vec::new();
        memory::lengthen(&mut going, given, false)?;
        for &vertex in self.staged.removals().iter().filter(|v| v.index() < given) {
            going[vertex] = true;
        }
        let lattice = self.coming.as_ref().unwrap_or(&self.lattice);
        let moves = positions.iter().enumerate().filter_map(|(index, position)| {
            let vertex = VertexId::at(index);
            if index < n && (images.home(vertex) == VertexId::NONE || going[index]) {
                return None;
            }
            match lattice.check("positions", index, position) {
                Ok(()) if index >= n => None,
                checked => Some((index, checked.map(|()| (vertex, *position)))),
            }
        });
        self.staged.move_vertices(n, moves)?;
        self.staged.place_insertions(&positions[n.min(given)..]);
        Ok(())
    }

    /// Stages the insertion of vertices; returns the id of the first, which the others follow.
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`], [`Error::TooManyVertices`], [`Error::OutOfMemory`].
    pub fn stage_insertions(&mut self, positions: &[G::Point]) -> Result<VertexId> {
        let lattice = self.coming.as_ref().unwrap_or(&self.lattice);
        for (index, position) in positions.iter().enumerate() {
            lattice.check("positions", index, position)?;
        }
        let n = self.id_count();
        if n + positions.len() > MAX_VERTICES {
            return Err(Error::TooManyVertices { given: n + positions.len(), limit: MAX_VERTICES });
        }
        self.staged.insert(positions)?;
        Ok(VertexId::at(n))
    }

    /// Stages the removal of vertices; all of them or, on an error, none.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`], [`Error::RemovedVertex`], [`Error::StagedVertex`], [`Error::OutOfMemory`].
    pub fn stage_removals(&mut self, vertices: &[VertexId]) -> Result<()> {
        let images = &self.inside.images;
        let (n, n_coming) = (images.n_vertices(), self.staged.insertions().len());
        let each = vertices.iter().enumerate();
        self.staged.remove(n, each.map(|(index, &v)| images.check(index, v, n_coming).map(|_| v)))
    }

    /// Stages another lattice, with as many vectors. Vertices stay where they were given, unless they move.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new) for vectors, and [`Error::WrongCount`] for another number of them.
    pub fn stage_vectors(&mut self, vectors: &[G::Point]) -> Result<()> {
        let (given, wanted) = (vectors.len(), self.lattice.rank());
        if given != wanted {
            return Err(Error::WrongCount { argument: "vector_count", given, wanted, coming: 0 });
        }
        let lattice = memory::boxed(Lattice::<G>::new(vectors)?)?;
        // Programs hand over their vectors at every step, changed or not.
        self.coming = (!lattice.is_equal(&self.lattice)).then_some(lattice);
        Ok(())
    }

    /// Forgets what is staged; returns how many moves there were.
    pub fn discard_moves(&mut self) -> usize {
        self.coming = None;
        self.staged.clear()
    }
}
