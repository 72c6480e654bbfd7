//! *Auto*: the algorithm for each commit, from what the last ones found.
//!
//! | commit | algorithm |
//! |---|---|
//! | of few of the vertices | tolerance if it is up to date, else placement by flips |
//! | while next to all vertices stay within tolerance | tolerance |
//! | otherwise | repair, which rebuilds where too much fails |
//! | after such a rebuild | rebuilding, for a while |
//!
//! A vertex beyond its tolerance costs *tolerance* a placement and the tolerances around it: 4 ns a vertex and 30 times
//! that a sweep of its own. So *tolerance* pays while fewer than one vertex in fifty is beyond, and a commit that finds more
//! goes on as a repair: the vertices accepted are moved already. Few flips in a repair announce that most vertices stay
//! within tolerance; before that of all is computed, for five sweeps or three, a sample is looked at, and ever more rarely
//! if it says no or *tolerance* does not last. After a repair that had to
//! rebuild, so many commits rebuild at once as have failed in a row, and twice as many the next time.
//!
//! Immediate relocations are counted in rounds of as many as there are vertices. After a round of which most changed no
//! cell tolerances are computed, and kept while most relocations are within: a test costs a fiftieth of a look at the star,
//! a vertex beyond two or three looks.

use super::regions::Filter;
use super::{CommitReport, MovingTriangulation, SwitchingRule};
use crate::delaunay::{Dimension, Shortcut};
use crate::error::Result;

/// Fewer than one staged vertex in so many are few: a placement costs about as much as so many vertices swept.
const FEW: usize = 20;
/// *Tolerance* pays while fewer than one vertex in so many is beyond.
const BEYOND: usize = 50;
/// A repair of fewer flips and placements than one vertex in so many announces that. (A vertex beyond its tolerance
/// makes about a tenth of a flip.)
const CALM: usize = 500;
/// Vertices sampled before all tolerances are computed, and the share of them that must be within.
const SAMPLE: u32 = 64;
const SHARE: f64 = 0.98;
/// Longest wait for another try, in commits.
const PATIENCE: u32 = 64;
/// Most commits rebuilt without a look.
const REBUILT: u32 = 15;

/// What the last commits found.
#[derive(Debug, Default)]
pub(super) struct Auto {
    /// Whether *tolerance* is in force.
    is_filtering: bool,
    /// Commits until *tolerance* may be tried again, and how many they will be next time.
    wait: u32,
    next_wait: u32,
    /// Commits still to be rebuilt without a look, and how many they were last time.
    rebuilds: u32,
    last_rebuilds: u32,
    /// Immediate relocations in this round, those within tolerance, and those that changed no cell.
    relocated: u64,
    within: u64,
    still: u64,
}

impl<G: Dimension> MovingTriangulation<G> {
    pub(super) fn commit_by_auto(&mut self, report: &mut CommitReport) -> Result<()> {
        if !self.kernel.has_cells() {
            return self.rebuild_staged(report);
        }
        if self.staging.count() * FEW < self.n_present {
            return if self.regions.kept_for() == Some(Filter::Tolerance) {
                self.commit_by_filter(Filter::Tolerance, report)
            } else {
                self.commit_by_placement(Shortcut::Flips, report)
            };
        }
        if self.auto.rebuilds > 0 {
            self.auto.rebuilds -= 1;
            return self.rebuild_staged(report);
        }
        if self.auto.is_filtering && self.commit_if_calm(report)? {
            return Ok(());
        }
        self.commit_by_repair(report)?;
        self.learn(report);
        Ok(())
    }

    /// Commits by *tolerance* if few vertices are beyond; otherwise those within have moved when it is done.
    fn commit_if_calm(&mut self, report: &mut CommitReport) -> Result<bool> {
        if self.regions.kept_for() != Some(Filter::Tolerance) && !self.is_calm() {
            self.stop_filtering();
            return Ok(false);
        }
        if self.accept_by(Filter::Tolerance, self.n_present / BEYOND, report)? {
            self.auto.next_wait = self.auto.next_wait.saturating_sub(1);
            self.place_beyond(report)?;
            return Ok(true);
        }
        self.stop_filtering();
        Ok(false)
    }

    /// Whether a sample of the vertices stays within tolerance, but for a few.
    fn is_calm(&mut self) -> bool {
        self.sampled_share(&SwitchingRule { sample: SAMPLE, ..SwitchingRule::default() }) >= SHARE
    }

    fn stop_filtering(&mut self) {
        self.auto.is_filtering = false;
        self.auto.next_wait = (2 * self.auto.next_wait + 4).min(PATIENCE);
        self.auto.wait = self.auto.next_wait;
    }

    /// Counts an immediate relocation, and decides after a round of them whether tolerances are to be kept.
    pub(super) fn follow_relocation(&mut self, done: &CommitReport) {
        let is_kept = self.regions.kept_for() == Some(Filter::Tolerance);
        let auto = &mut self.auto;
        auto.relocated += 1;
        auto.within += done.within_tolerance;
        auto.still += done.within_tolerance + done.unchanged;
        let round = auto.relocated;
        if round < self.n_present.max(SAMPLE as usize) as u64 {
            return;
        }
        let (within, still) = (auto.within, auto.still);
        (auto.relocated, auto.within, auto.still) = (0, 0, 0);
        let are_most = |some: u64| 10 * some >= 6 * round;
        if is_kept {
            if !are_most(within) {
                self.regions.invalidate();
                self.stop_filtering();
            }
        } else if auto.wait > 0 {
            auto.wait -= 1;
        } else if are_most(still) {
            // Without the memory for them all goes on as it did.
            let _ = self.regions.compute(&mut self.kernel, self.site_of.len(), Filter::Tolerance, &mut CommitReport::default());
        }
    }

    /// Draws conclusions from a repair.
    fn learn(&mut self, report: &CommitReport) {
        let auto = &mut self.auto;
        if report.rebuilds > 0 {
            auto.last_rebuilds = (2 * auto.last_rebuilds + 1).min(REBUILT);
            auto.rebuilds = auto.last_rebuilds;
            return;
        }
        auto.last_rebuilds = 0;
        auto.wait = auto.wait.saturating_sub(1);
        let mended = (report.flips + report.placements) as usize;
        auto.is_filtering = auto.wait == 0 && mended * CALM <= self.n_present;
    }
}
