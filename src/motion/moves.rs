//! Calls that stage moves.

use super::MovingTriangulation;
use super::staging::{Given, check_position, first_bad, stage_block};
use crate::delaunay::Dimension;
use crate::error::{Error, Result};
use crate::ids::{SiteId, VertexId};

impl<G: Dimension> MovingTriangulation<G> {
    /// Stages a move of `vertices[i]` to `positions[i]` for each `i`; all of them or, on an error, none.
    ///
    /// # Errors
    /// [`Error::WrongCount`] if the lengths differ; [`Error::NoSuchVertex`], [`Error::RemovedVertex`],
    /// [`Error::StagedVertex`], [`Error::DuplicateMove`] if a move of the vertex is staged already, [`Error::NotFinite`],
    /// [`Error::OutOfRange`], [`Error::OutOfMemory`].
    pub fn move_vertices(&mut self, vertices: &[VertexId], positions: &[G::Point]) -> Result<()> {
        if vertices.len() != positions.len() {
            return Err(Error::WrongCount {
                argument: "count",
                given: positions.len(),
                wanted: vertices.len(),
                coming: 0,
            });
        }
        self.staging.reserve(self.site_of.len(), vertices.len())?;
        let before = self.staging.vertices().len();
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
        if positions.len() == self.site_of.len() {
            self.move_first(positions)
        } else {
            Err(self.wrong_count(positions.len()))
        }
    }

    /// Stages moves of the vertices with the first ids: vertex `i` goes to `positions[i]`. One whose insertion is staged
    /// will be inserted there. Entries of removed vertices are not read, nor are those of vertices whose removal is
    /// staged.
    ///
    /// # Errors
    /// [`Error::WrongCount`] if there are more `positions` than ids; otherwise as
    /// [`move_vertices`](Self::move_vertices).
    pub fn move_first(&mut self, positions: &[G::Point]) -> Result<()> {
        if positions.len() > self.site_of.len() {
            return Err(self.wrong_count(positions.len()));
        }
        let n_ids = self.site_of.len();
        if self.can_stage_whole(positions.len()) {
            self.staging.reserve(n_ids, 0)?;
            if self.staging.stage_all(positions) {
                return Ok(());
            }
        }
        self.staging.reserve(n_ids, positions.len())?;
        let before = self.staging.vertices().len();
        for (index, position) in positions.iter().enumerate() {
            let vertex = VertexId::at(index);
            let staged = if self.site_of[vertex] != SiteId::NONE {
                if self.edits.is_leaving(vertex) {
                    continue;
                }
                self.stage("vertices", index, vertex, position)
            } else if self.edits.is_coming(vertex) {
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
        let (wanted, coming) = (self.site_of.len(), self.staged_edits().0);
        Error::WrongCount { argument: "count", given, wanted, coming }
    }

    /// Whether moves of the first `n` vertices can be staged whole.
    fn can_stage_whole(&self, n: usize) -> bool {
        let n_ids = self.site_of.len();
        self.staging.count() == 0 && n == n_ids && self.n_present == n_ids && self.edits.are_none()
    }

    /// Says that all vertices are staged, though their positions are not yet, if these can be staged whole.
    pub(super) fn expect_whole(&mut self, n: usize) -> Result<bool> {
        if n == 0 || !self.can_stage_whole(n) {
            return Ok(false);
        }
        self.staging.reserve(n, 0)?;
        self.staging.expect_whole();
        Ok(true)
    }

    /// Stages positions that are not staged yet.
    pub(super) fn stage_given(&mut self, given: &mut Given<'_, G>) -> Result<()> {
        match given.take() {
            Some(positions) if !stage_block::<G>(self.staging.positions_mut(), positions) => {
                Err(first_bad::<G>(positions))
            }
            _ => Ok(()),
        }
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
        n
    }

    /// Number of staged moves.
    pub fn staged_count(&self) -> usize {
        self.staging.count()
    }
}
