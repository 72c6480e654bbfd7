//! Places and weights of vertices, given apart: a program that has two arrays stages and commits either, or both.
//!
//! A goal has both parts. What is not given stays: it is what the other part of the goal is staged to be, or what the vertex has.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::report::CommitReport;
use crate::motion::state::checking::{check_numbers, check_position};
use crate::motion::state::part::{PointPart, set_part};
use crate::motion::triangulation::MovingTriangulation;

impl<G: Moving> MovingTriangulation<G> {
    /// Stages places or weights of these vertices, or of those with the first ids: rows of as many numbers as they have, one for
    /// each; all of them or, on an error, none. The other part stays what it is, or what it is staged to be. In a list vertices
    /// that are to be inserted can be given weights, again and again, and no places. Without a list entries of vertices that are
    /// gone, or are to go, are not read.
    ///
    /// # Errors
    /// [`Error::WrongCount`] if there are more rows than ids, or not one for each; [`Error::NoSuchVertex`], [`Error::RemovedVertex`],
    /// [`Error::StagedVertex`]; [`Error::DuplicateMove`] if this part is staged already; [`Error::NotFinite`],
    /// [`Error::OutOfRange`], [`Error::OutOfMemory`].
    pub fn move_parts(
        &mut self,
        part: PointPart,
        vertices: Option<&[VertexId]>,
        numbers: &[f64],
    ) -> Result<()> {
        let n_ids = self.mesh.site_of.len();
        let n = numbers.len() / part.width::<G>();
        let wanted = vertices.map_or(n.min(n_ids), <[VertexId]>::len);
        if n != wanted {
            return Err(Error::WrongCount {
                argument: "count",
                given: n,
                wanted,
                coming: self.staged_edits().0,
            });
        }
        self.staging.list()?;
        self.staging.reserve(n_ids, n)?;
        let vertex_at = |k: usize| vertices.map_or(VertexId::at(k), |vertices| vertices[k]);
        for k in 0..n {
            let staged = self.stage_part(part, k, vertex_at(k), vertices.is_some(), numbers);
            if let Err(error) = staged {
                (0..k).rev().for_each(|k| self.unstage_part(part, vertex_at(k)));
                return Err(error);
            }
        }
        // Insertions are not taken back, so they come last.
        for k in 0..n {
            if self.edits.is_insertion_staged(vertex_at(k)) {
                self.edits.set_part(vertex_at(k), part, part.row::<G>(numbers, k));
            }
        }
        Ok(())
    }

    /// Checks one row, and stages it unless the vertex is yet to be inserted, or is skipped.
    fn stage_part(
        &mut self,
        part: PointPart,
        index: usize,
        vertex: VertexId,
        is_listed: bool,
        numbers: &[f64],
    ) -> Result<()> {
        let row = part.row::<G>(numbers, index);
        if self.edits.is_insertion_staged(vertex) && !(is_listed && part == PointPart::Place) {
            return check_numbers::<G>(part.argument(), index, part, row);
        }
        if !is_listed && (!self.mesh.is_present(vertex) || self.edits.is_removal_staged(vertex)) {
            return Ok(());
        }
        let s = self.site_of_vertex("vertices", index, vertex)?;
        if self.staging.is_part_staged(vertex, part) {
            let argument = if is_listed { "vertices" } else { part.argument() };
            return Err(Error::DuplicateMove { argument, index, vertex });
        }
        check_numbers::<G>(part.argument(), index, part, row)?;
        let Self { staging, mesh, .. } = self;
        staging.stage_part(vertex, part, || mesh.kernel.site(s).point, row);
        Ok(())
    }

    /// Takes back what [`stage_part`](Self::stage_part) has staged last.
    fn unstage_part(&mut self, part: PointPart, vertex: VertexId) {
        if let Some(s) = self.mesh.site(vertex).filter(|_| self.staging.is_part_staged(vertex, part)) {
            self.staging.unstage_part(vertex, part, &self.mesh.kernel.site(s).point);
        }
    }

    /// Makes these places and weights the next timestamp, one row for each id; what is not given stays, and what is staged to be
    /// inserted keeps the part that is not given, too. On an error no move is staged, and insertions are staged as before.
    ///
    /// # Errors
    /// [`Error::WrongCount`]; [`Error::DuplicateMove`] if moves are staged; otherwise those of
    /// [`commit_timestamp`](Self::commit_timestamp) and [`move_parts`](Self::move_parts).
    pub fn commit_parts(&mut self, places: Option<&[f64]>, weights: Option<&[f64]>) -> Result<CommitReport> {
        self.reject_prepared()?;
        self.mesh.last_found.begin();
        if let Some(vertex) = self.staging.first_staged() {
            return Err(Error::DuplicateMove { argument: "positions", index: vertex.index(), vertex });
        }
        let n_ids = self.mesh.site_of.len();
        let parts = [(PointPart::Place, places), (PointPart::Weight, weights)];
        for (part, numbers) in parts.into_iter().filter_map(|(part, numbers)| Some((part, numbers?))) {
            let given = numbers.len() / part.width::<G>();
            if given != n_ids {
                let coming = self.staged_edits().0;
                return Err(Error::WrongCount { argument: "count", given, wanted: n_ids, coming });
            }
        }
        if n_ids > 0 && self.can_stage_whole(n_ids) {
            return self.commit_all_parts(places, weights);
        }
        let before = memory::copy_of(self.edits.insertions())?;
        let staged = parts
            .into_iter()
            .filter_map(|(part, numbers)| Some((part, numbers?)))
            .try_for_each(|(part, numbers)| self.move_parts(part, None, numbers));
        let done = staged.and_then(|()| self.commit_timestamp());
        if done.is_err() {
            self.staging.clear();
            self.edits.restore_insertions(before);
        }
        done
    }

    /// Commits places and weights of vertices that are all there are, by way of the array of goals.
    fn commit_all_parts(&mut self, places: Option<&[f64]>, weights: Option<&[f64]>) -> Result<CommitReport> {
        let Self { staging, mesh, .. } = self;
        staging.stage_all_by(mesh.site_of.len(), |goals| {
            for (k, goal) in goals.iter_mut().enumerate() {
                if places.is_none() || weights.is_none() {
                    *goal = mesh.kernel.site(mesh.site_of[VertexId::at(k)]).point;
                }
                if let Some(places) = places {
                    set_part::<G>(goal, PointPart::Place, PointPart::Place.row::<G>(places, k));
                }
                if let Some(weights) = weights {
                    set_part::<G>(goal, PointPart::Weight, PointPart::Weight.row::<G>(weights, k));
                }
                check_position::<G>("positions", k, goal)?;
            }
            Ok(())
        })?;
        let done = self.commit_timestamp();
        if done.is_err() {
            self.staging.clear();
        }
        done
    }

    /// Moves one vertex at once, and it keeps its weight; or gives it another weight, and it keeps its place.
    ///
    /// # Errors
    /// The errors of [`relocate_vertex`](Self::relocate_vertex).
    pub fn relocate_part(&mut self, part: PointPart, vertex: VertexId, numbers: &[f64]) -> Result<()> {
        let mut goal = self.position(vertex)?;
        set_part::<G>(&mut goal, part, numbers);
        self.relocate_vertex(vertex, &goal)
    }
}
