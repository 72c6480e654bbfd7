//! One vertex at a time: relocations, insertions and removals that are visible at once, whatever is staged.
//!
//! Each is a commit of its own, of that one edit; the timestamp stays.

use crate::delaunay::Moving;
use crate::error::{Error, Result, StagedEdit};
use crate::ids::VertexId;
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// Moves one vertex at once, whatever is staged for others.
    ///
    /// Cost: that of a commit of one move.
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`], [`Error::NoSuchVertex`], [`Error::RemovedVertex`], [`Error::StagedVertex`];
    /// [`Error::DuplicateMove`] if a move of the vertex is staged; and those of
    /// [`commit_timestamp`](Self::commit_timestamp).
    pub fn relocate_vertex(&mut self, vertex: VertexId, position: &G::Point) -> Result<()> {
        self.reject_prepared()?;
        self.position(vertex)?;
        if self.staged.moves().iter().any(|&(moving, _)| moving == vertex) {
            return Err(Error::DuplicateMove { argument: "vertex", index: 0, vertex });
        }
        self.at_once(|t| t.move_vertices(&[vertex], std::slice::from_ref(position)))
    }

    /// Inserts a vertex at once; returns its id, which is one above the highest ever given.
    ///
    /// Cost: that of a commit of one edit: what it changes, and now and then, or in a small box, that of a creation.
    ///
    /// # Errors
    /// [`Error::StagedVertex`] if insertions are staged, which have that id; [`Error::NotFinite`], [`Error::OutOfRange`],
    /// [`Error::TooManyVertices`], and those of [`commit_timestamp`](Self::commit_timestamp).
    pub fn insert_vertex(&mut self, position: &G::Point) -> Result<VertexId> {
        self.reject_prepared()?;
        if !self.staged.insertions().is_empty() {
            let vertex = VertexId::at(self.inside.images.n_vertices());
            let (argument, index, staged) = ("out_vertex", 0, StagedEdit::Insertion);
            return Err(Error::StagedVertex { argument, index, vertex, staged });
        }
        self.at_once(|t| t.stage_insertions(std::slice::from_ref(position)))
    }

    /// Removes a vertex at once, with the move or the removal staged for it, if any.
    ///
    /// Cost: that of a commit of one edit: what it changes, and now and then, or in a small box, that of a creation.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`], [`Error::RemovedVertex`], [`Error::StagedVertex`], and those of
    /// [`commit_timestamp`](Self::commit_timestamp).
    pub fn remove_vertex(&mut self, vertex: VertexId) -> Result<()> {
        self.reject_prepared()?;
        self.position(vertex)?;
        self.at_once(|t| t.stage_removals(&[vertex]))?;
        self.staged.forget(vertex);
        Ok(())
    }

    /// Commits what is staged by this alone, and keeps what was staged before.
    fn at_once<T>(&mut self, stage: impl FnOnce(&mut Self) -> Result<T>) -> Result<T> {
        let (staged, coming) = (std::mem::take(&mut self.staged), self.coming.take());
        let done = stage(self).and_then(|made| {
            self.commit_timestamp()?;
            self.statistics.timestamp -= 1;
            // The timestamp does not tell that there is a change.
            self.taking.iter_mut().for_each(|taking| taking.timestamp = None);
            Ok(made)
        });
        (self.staged, self.coming) = (staged, coming);
        done.map_err(of_one)
    }
}

/// An error about the only entry of a list, as one about an argument that is no list.
fn of_one(mut error: Error) -> Error {
    if let Error::NoSuchVertex { argument, .. }
    | Error::RemovedVertex { argument, .. }
    | Error::StagedVertex { argument, .. }
    | Error::NotFinite { argument, .. }
    | Error::OutOfRange { argument, .. } = &mut error
    {
        *argument = match *argument {
            "positions" => "position",
            "weights" => "weight",
            _ => "vertex",
        };
    }
    error
}
