//! The commit: one timestamp, all or nothing.

use super::algorithms::for_algorithms;
use super::attempt::Edited;
use super::outlook::Outlook;
use super::regions::Filter;
use super::staging::Given;
use super::{Algorithm, CommitReport, MovingTriangulation};
use crate::delaunay::{Dimension, Shortcut};
use crate::error::{Error, Result};
use crate::machine::memory;

impl<G: Dimension> MovingTriangulation<G> {
    /// Makes the staged positions the next timestamp.
    ///
    /// On an error the triangulation is at the timestamp before, and the moves stay staged.
    ///
    /// # Errors
    /// [`Error::Cancelled`], [`Error::Coincident`] if the options reject that, [`Error::TooManyCells`],
    /// [`Error::OutOfMemory`].
    pub fn commit_timestamp(&mut self) -> Result<CommitReport> {
        self.commit_given(Given::nothing())
    }

    /// Makes the next timestamp of the staged positions, or of those given that are not staged yet.
    fn commit_given(&mut self, given: Given<'_, G>) -> Result<CommitReport> {
        self.prepare_tracking()?;
        let mut report = CommitReport::default();
        let before = self.evaluations();
        self.staging.set_applied(0);
        self.staging.tidy();
        if self.edits.are_none() {
            self.staging.forget_full_list(self.n_present);
        } else {
            self.staging.list()?;
        }
        self.begin()?;
        let advanced = self.edit_and_advance(given, &mut report);
        if let Err(error) = advanced.and_then(|()| self.views.prepare(&self.kernel)) {
            self.undo();
            return Err(error);
        }
        self.views.begin_commit();
        self.publish();
        self.enter_evaluations(&mut report, before);
        self.staging.clear();
        self.end_edits();
        self.statistics.timestamp += 1;
        self.count(report);
        report.timestamp = self.statistics.timestamp;
        report.coincident = self.statistics.coincident;
        self.follow_commit(&report);
        Ok(report)
    }

    /// Makes the positions given the next timestamp: as [`move_all`](Self::move_all) and
    /// [`commit_timestamp`](Self::commit_timestamp). On an error no move is staged, and insertions are staged as before.
    ///
    /// # Errors
    /// [`Error::DuplicateMove`] if moves are staged; otherwise those of both.
    pub fn commit_positions(&mut self, positions: &[G::Point]) -> Result<CommitReport> {
        if let Some(vertex) = self.staging.first_staged() {
            return Err(Error::DuplicateMove { argument: "positions", index: vertex.index(), vertex });
        }
        if self.expect_whole(positions.len())? {
            let done = self.commit_given(Given::all(positions));
            if done.is_err() {
                self.staging.clear();
            }
            return done;
        }
        let before = memory::copy_of(self.edits.insertions())?;
        self.move_all(positions)?;
        let done = self.commit_timestamp();
        if done.is_err() {
            self.staging.clear();
            self.edits.restore_insertions(before);
        }
        done
    }

    /// Makes the edits, and brings the staged vertices to their new positions.
    fn edit_and_advance(&mut self, given: Given<'_, G>, report: &mut CommitReport) -> Result<()> {
        match self.make_edits(report)? {
            Edited::WithMoves => Ok(()),
            Edited::WithoutMoves => self.advance(given, report),
        }
    }

    /// Brings the staged vertices to their new positions.
    fn advance(&mut self, mut given: Given<'_, G>, report: &mut CommitReport) -> Result<()> {
        // Without cells nothing is looked at but this, and by rebuilding not even that.
        let algorithm = self.options.algorithm;
        let may_rest = !self.kernel.has_cells() && algorithm != Algorithm::Rebuilding;
        if !may_rest || self.outlook(&given, false) != Outlook::AtRest {
            self.commit_by(algorithm, &mut given, report)?;
        }
        self.reject_coincidence()
    }

    /// Tells the monitor how far the work is; whether to go on.
    pub(super) fn monitor(&mut self, fraction: f64) -> bool {
        self.kernel.pace_mut().ask(fraction)
    }
}

/// Makes the calls of the methods that commit, from the table of algorithms.
macro_rules! commit_by {
    (default $default:ident; $(
        $(#[doc = $line:literal])+
        $variant:ident = $code:literal {
            name: $name:literal,
            purpose: $purpose:ident,
            commits: $commits:ident,
            keeps: $keeps:literal,
            immediate: $immediate:ident$(($filter:ident))?,
            by: $method:ident($($argument:expr),*),
        }
    )+) => {
        impl<G: Dimension> MovingTriangulation<G> {
            /// Brings the staged vertices to their new positions.
            fn commit_by(
                &mut self,
                algorithm: Algorithm,
                given: &mut Given<'_, G>,
                report: &mut CommitReport,
            ) -> Result<()> {
                match algorithm {
                    $(Algorithm::$variant => self.$method($($argument,)* given, report),)+
                }
            }
        }
    };
}

for_algorithms!(commit_by);
