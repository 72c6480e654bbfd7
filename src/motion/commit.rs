//! The commit: one timestamp, all or nothing.

use super::regions::Filter;
use super::{Algorithm, CommitReport, MovingTriangulation};
use crate::delaunay::{Dimension, Shortcut};
use crate::error::Result;

impl<G: Dimension> MovingTriangulation<G> {
    /// Makes the staged positions the next timestamp.
    ///
    /// On an error the triangulation is at the timestamp before, and the moves stay staged.
    ///
    /// # Errors
    /// [`Error::Cancelled`](crate::Error::Cancelled), [`Error::Coincident`](crate::Error::Coincident) if the options
    /// reject that, [`Error::TooManyCells`](crate::Error::TooManyCells),
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn commit_timestamp(&mut self) -> Result<CommitReport> {
        self.prepare_tracking()?;
        let mut report = CommitReport::default();
        let before = self.evaluations();
        self.staging.applied = 0;
        self.staging.forget_full_list(self.n_present);
        self.begin()?;
        let advanced = self.advance(&mut report);
        if let Err(error) = advanced.and_then(|()| self.views.prepare(&self.kernel)) {
            self.undo();
            return Err(error);
        }
        self.views.begin_commit();
        self.publish();
        self.enter_evaluations(&mut report, before);
        self.staging.clear();
        self.statistics.timestamp += 1;
        self.count(report);
        report.timestamp = self.statistics.timestamp;
        report.coincident = self.statistics.coincident;
        Ok(report)
    }

    /// Brings the staged vertices to their new positions.
    fn advance(&mut self, report: &mut CommitReport) -> Result<()> {
        match self.options.algorithm {
            Algorithm::Placement => self.commit_by_placement(Shortcut::Certificates, report)?,
            Algorithm::PlacementFlips => self.commit_by_placement(Shortcut::Flips, report)?,
            Algorithm::Tolerance => self.commit_by_filter(Filter::Tolerance, report)?,
            Algorithm::SafeRegion => self.commit_by_filter(Filter::SafeRegion, report)?,
            Algorithm::SafeRegionTolerance => self.commit_by_filter(Filter::Both, report)?,
            Algorithm::RebuildingTolerance => self.commit_by_switching(report)?,
            Algorithm::Repair => self.commit_by_repair(report)?,
            Algorithm::Watching => self.watch_or_repair(report)?,
            Algorithm::Slack => self.slack_or_repair(report)?,
            Algorithm::Rebuilding => self.rebuild_staged(report)?,
            Algorithm::Auto => self.commit_by_auto(report)?,
        }
        self.reject_coincidence()
    }

    /// Tells the monitor how far the work is; whether to go on.
    pub(super) fn monitor(&mut self, fraction: f64) -> bool {
        self.options.monitor.as_mut().is_none_or(|monitor| monitor(fraction))
    }
}
