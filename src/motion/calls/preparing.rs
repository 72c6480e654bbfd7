//! Commits in two phases: a timestamp is prepared, in one round or several, and then published or withdrawn.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::motion::report::CommitReport;
use crate::motion::state::goals::Moves;
use crate::motion::state::rounds::Savepoint;
use crate::motion::triangulation::MovingTriangulation;

impl<G: Moving> MovingTriangulation<G> {
    /// Brings the triangulation to the staged positions, as a commit does, but keeps what it was: all that reads sees the
    /// prepared state, which [`publish_timestamp`](Self::publish_timestamp) makes the next timestamp, and
    /// [`withdraw_timestamp`](Self::withdraw_timestamp) takes back. More may be staged then, and prepared in another round
    /// of the same timestamp. On an error the rounds before are in force, and what is staged stays so.
    ///
    /// The report is of this round; its timestamp is the one that is prepared. Statistics count the round.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// t.move_vertices(&[VertexId::new(3)], &[[0.2, 0.2]])?;
    /// t.prepare_timestamp()?;
    /// assert_eq!((t.cell_count(), t.timestamp()), (3, 0));
    /// t.withdraw_timestamp();
    /// assert_eq!((t.cell_count(), t.timestamp()), (2, 0));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`commit_timestamp`](Self::commit_timestamp). Passings of vertices are looked at on the way of the
    /// round, from where the round before has left the vertices.
    pub fn prepare_timestamp(&mut self) -> Result<CommitReport> {
        self.mesh.last_found.begin();
        self.apply_passing_policy_to_staged()?;
        if !self.is_prepared() {
            self.set_savepoint()?;
        }
        self.regions.release();
        let mut staging = std::mem::take(&mut self.staging);
        let done = self.make_round(&mut staging.moves(self.mesh.n_present));
        if done.is_ok() {
            staging.clear();
        }
        self.staging = staging;
        self.mesh.close_empty_rounds();
        if self.is_prepared() {
            self.regions.withhold();
        }
        done
    }

    /// Makes the prepared state the next timestamp, which it returns. What has been staged since the last round stays so.
    ///
    /// # Errors
    /// [`Error::NotPrepared`].
    pub fn publish_timestamp(&mut self) -> Result<u64> {
        if !self.is_prepared() {
            return Err(Error::NotPrepared);
        }
        self.regions.release();
        self.mesh.publish_rounds();
        self.statistics.timestamp += 1;
        Ok(self.statistics.timestamp)
    }

    /// Takes back all rounds of the prepared state: all is as at the last timestamp, with nothing staged, cells with their
    /// indices and statistics included. Does nothing if no timestamp is prepared. Needs no memory.
    ///
    /// Tolerances are forgotten; what auto has learnt stays, but it checks all certificates for a while before it computes
    /// tolerances again.
    pub fn withdraw_timestamp(&mut self) {
        self.withdraw(true);
    }

    /// Takes back the rounds since the last [savepoint](Self::set_savepoint), which is forgotten, as
    /// [`withdraw_timestamp`](Self::withdraw_timestamp) takes back all.
    pub(crate) fn withdraw_to_savepoint(&mut self) {
        self.withdraw(false);
    }

    fn withdraw(&mut self, are_all: bool) {
        self.regions.release();
        let Some(savepoint) = self.mesh.withdraw_rounds(are_all) else { return };
        self.mesh.kernel.settle_undone();
        self.mesh.known = None;
        self.auto.note_withdrawn(self.mesh.constants);
        self.regions.invalidate();
        self.statistics = savepoint.statistics;
        self.staging.clear();
        self.edits.clear();
        self.staging.shrink(savepoint.n_ids);
        if let Some(segments) = &mut self.mesh.segments {
            segments.discard();
        }
        match (&mut self.made, savepoint.n_pieces) {
            (Some(made), Some(n)) => made.truncate_pieces(n),
            (made, _) => *made = None,
        }
    }

    /// From here on rounds can be [taken back](Self::withdraw_to_savepoint) by themselves.
    pub(crate) fn set_savepoint(&mut self) -> Result<()> {
        let (mut n_ids, mut has_keys) = (self.mesh.site_of.len(), self.has_keys());
        if self.edits.has_insertions() {
            n_ids = n_ids.min(self.edits.n_known());
            has_keys = self.edits.had_keys();
        }
        self.mesh.set_savepoint(Savepoint {
            n_rounds: self.mesh.n_rounds(),
            statistics: self.statistics,
            n_ids,
            n_pieces: self.made.as_ref().map(|made| made.n_pieces()),
            has_segments: self.mesh.segments.is_some(),
            has_keys,
        })
    }

    /// Makes the moves and the staged edits as a round.
    fn make_round(&mut self, moves: &mut Moves<'_, G>) -> Result<CommitReport> {
        self.mesh.make_room_to_withhold(self.edits.removals().len())?;
        self.mesh.know_hidden()?;
        let before = self.mesh.evaluations();
        let changed = self.parts_to_change(moves);
        let mut report = self.reach(moves)?;
        self.mesh.settle_round();
        self.mesh.withhold_ids(self.edits.removals());
        self.enter_evaluations(&mut report, before);
        self.end_edits();
        if let Some(made) = &mut self.made {
            made.end_staging();
        }
        self.count(report);
        self.note_hidden(&report);
        report.timestamp = self.statistics.timestamp + 1;
        report.coincident = self.statistics.coincident;
        self.follow_commit(&report);
        self.tell_parts(&mut report, changed);
        Ok(report)
    }
}

#[cfg(test)]
mod tests;
