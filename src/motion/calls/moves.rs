//! Calls that stage moves.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::motion::state::checking::check_position;
use crate::motion::triangulation::MovingTriangulation;

impl<G: Moving> MovingTriangulation<G> {
    /// Stages a move of `vertices[i]` to `positions[i]` for each `i`; all of them or, on an error, none.
    ///
    /// ```
    /// use deldrift::{Error, Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let vertex = VertexId::new(3);
    /// t.move_vertices(&[vertex], &[[2.0, 2.0]])?;
    /// assert_eq!(t.position(vertex)?, [1.0, 1.0]); // until the commit
    /// let again = t.move_vertices(&[vertex], &[[3.0, 3.0]]);
    /// assert!(matches!(again, Err(Error::DuplicateMove { .. })));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::WrongCount`] if the lengths differ; [`Error::NoSuchVertex`], [`Error::RemovedVertex`],
    /// [`Error::StagedVertex`], [`Error::DuplicateMove`] if a move of the vertex is staged already,
    /// [`Error::NotFinite`], [`Error::OutOfRange`], [`Error::OutOfMemory`].
    pub fn move_vertices(&mut self, vertices: &[VertexId], positions: &[G::Point]) -> Result<()> {
        if vertices.len() != positions.len() {
            return Err(Error::WrongCount {
                argument: "count",
                given: positions.len(),
                wanted: vertices.len(),
                coming: 0,
            });
        }
        self.staging.reserve(self.mesh.site_of.len(), vertices.len())?;
        let before = self.staging.n_listed();
        for (index, (&vertex, position)) in vertices.iter().zip(positions).enumerate() {
            if let Err(error) = self.stage("vertices", index, vertex, position) {
                self.staging.truncate(before);
                return Err(error);
            }
        }
        Ok(())
    }

    /// Stages a move of every vertex: as [`move_first`](Self::move_first) with one position for each id ever given.
    ///
    /// # Errors
    /// [`Error::WrongCount`] if `positions` has another length; otherwise as [`move_first`](Self::move_first).
    pub fn move_all(&mut self, positions: &[G::Point]) -> Result<()> {
        if positions.len() == self.mesh.site_of.len() {
            self.move_first(positions)
        } else {
            Err(self.wrong_count(positions.len()))
        }
    }

    /// Stages moves of the vertices with the first ids: vertex `i` goes to `positions[i]`. One whose insertion is
    /// staged will be inserted there. Entries of removed vertices are not read, nor are those of vertices whose removal
    /// is staged.
    ///
    /// # Errors
    /// [`Error::WrongCount`] if there are more `positions` than ids; otherwise as
    /// [`move_vertices`](Self::move_vertices).
    pub fn move_first(&mut self, positions: &[G::Point]) -> Result<()> {
        if positions.len() > self.mesh.site_of.len() {
            return Err(self.wrong_count(positions.len()));
        }
        let n_ids = self.mesh.site_of.len();
        if self.can_stage_whole(positions.len()) {
            self.staging.reserve(n_ids, 0)?;
            if self.staging.stage_all(positions) {
                return Ok(());
            }
        }
        self.staging.reserve(n_ids, positions.len())?;
        let before = self.staging.n_listed();
        for (index, position) in positions.iter().enumerate() {
            let vertex = VertexId::at(index);
            let staged = if self.mesh.is_present(vertex) {
                if self.edits.is_removal_staged(vertex) {
                    continue;
                }
                self.stage("vertices", index, vertex, position)
            } else if self.edits.is_insertion_staged(vertex) {
                check_position::<G>("positions", index, position).map(drop)
            } else {
                continue;
            };
            if let Err(error) = staged {
                self.staging.truncate(before);
                return Err(error);
            }
        }
        self.edits.place_insertions(positions);
        Ok(())
    }

    /// There are more positions than ids, or another number of them where there must be one for each.
    #[cold]
    fn wrong_count(&self, given: usize) -> Error {
        let (wanted, coming) = (self.mesh.site_of.len(), self.staged_edits().0);
        Error::WrongCount { argument: "count", given, wanted, coming }
    }

    /// Whether the first `n` vertices are all that there are, and nothing is staged.
    pub(in crate::motion) fn can_stage_whole(&self, n: usize) -> bool {
        let n_ids = self.mesh.site_of.len();
        self.staging.count() == 0 && n == n_ids && self.mesh.n_present == n_ids && self.edits.are_none()
    }

    #[inline(always)]
    fn stage(
        &mut self,
        argument: &'static str,
        index: usize,
        vertex: VertexId,
        position: &G::Point,
    ) -> Result<()> {
        self.site_of_vertex(argument, index, vertex)?;
        if self.staging.is_staged(vertex) {
            return Err(Error::DuplicateMove { argument, index, vertex });
        }
        let position = check_position::<G>("positions", index, position)?;
        self.staging.stage(vertex, position);
        Ok(())
    }

    /// Forgets the staged moves, insertions and removals; returns how many moves there were.
    pub fn discard_moves(&mut self) -> usize {
        let n = self.staging.clear();
        self.discard_edits();
        if let Some(segments) = &mut self.mesh.segments {
            segments.discard();
        }
        if let Some(made) = &mut self.made {
            made.discard_staged();
        }
        n
    }

    /// Number of staged moves.
    pub fn staged_count(&self) -> usize {
        self.staging.count()
    }
}
