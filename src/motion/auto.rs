//! *Auto*: the algorithm for each commit, from what the last ones found.
//!
//! | commit | algorithm |
//! |---|---|
//! | of few of the vertices | tolerance if it is up to date, else placement by flips |
//! | of all vertices, while few leave their tolerance | watching |
//! | otherwise | repair, which rebuilds where too much fails |
//! | after such a rebuild | rebuilding, for a while |
//!
//! **Watching or sweeping.** Few flips in a repair announce that most vertices stay within tolerance. Before that of
//! all is computed, for five sweeps or three, a sample is looked at, and ever more rarely if it says no or watching
//! does not last. While it does, what is watched and what is computed anew is counted, and weighed by measured costs
//! ([`Costs`]): when it has cost half a computation of all tolerances more than sweeps would have, watching ends; when
//! either count has cost one more than the other, all tolerances are computed again, so that what is watched
//! follows from how far the vertices go now.
//!
//! **Rebuilding.** After a repair that had to rebuild, so many commits rebuild at once as have failed in a row, and
//! twice as many the next time.
//!
//! **Immediate relocations** are counted in rounds of as many as there are vertices. After a round of which most
//! changed no cell tolerances are computed, and kept while most relocations are within: a test costs a fiftieth of a
//! look at the star, a vertex beyond two or three looks.

use super::regions::Filter;
use super::{CommitReport, MovingTriangulation, SwitchingRule};
use crate::delaunay::{Dimension, Shortcut};
use crate::error::Result;

/// Fewer than one staged vertex in so many are few: a placement costs about as much as so many vertices swept.
const FEW: usize = 20;
/// Watching pays only while fewer than one vertex in so many is beyond its tolerance.
const BEYOND: usize = 8;
/// Vertices sampled before all tolerances are computed, and the share of them that must be within.
const SAMPLE: u32 = 64;
const SHARE: f64 = 0.8;
/// Longest wait for another try, in commits.
const PATIENCE: u32 = 256;
/// What the parts of a commit cost, in nanoseconds.
struct Costs {
    /// A watched bi-cell.
    watched: f64,
    /// A vertex beyond its tolerance.
    beyond: f64,
    /// Per vertex, what a sweep costs that is spared.
    sweep: f64,
    /// Per vertex, to get ready to mend anything.
    mending: f64,
    /// Per vertex, to compute all tolerances.
    computed: f64,
    /// A repair of no more flips and placements than one vertex in so many announces that watching pays.
    calm: u64,
}

/// Measured with 10,000 vertices; only the ratios matter.
const fn costs<G: Dimension>() -> Costs {
    if G::D == 2 {
        Costs { watched: 14.0, beyond: 400.0, sweep: 16.0, mending: 4.0, computed: 90.0, calm: 150 }
    } else {
        Costs { watched: 45.0, beyond: 7000.0, sweep: 120.0, mending: 25.0, computed: 500.0, calm: 500 }
    }
}

/// Most commits rebuilt without a look.
const REBUILT: u32 = 15;

/// What the last commits found.
#[derive(Debug, Default)]
pub(super) struct Auto {
    /// Whether *watching* is in force.
    is_watching: bool,
    /// What it has cost more than sweeps would have, and what the watched bi-cells have cost more than the vertices beyond,
    /// in nanoseconds.
    excess: f64,
    imbalance: f64,
    /// Flips and placements of the last commit, and of the one after which watching ended.
    mended: u64,
    mended_at_stop: u64,
    /// Commits until *watching* may be tried again, and how many they will be next time.
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
        if self.auto.is_watching
            && self.staging.is_whole()
            && self.hidden.count() == 0
            && self.commit_if_calm(report)?
        {
            return Ok(());
        }
        self.commit_by_repair(report)?;
        self.learn(report);
        Ok(())
    }

    /// Commits by watching if few vertices are beyond; otherwise nothing has moved.
    fn commit_if_calm(&mut self, report: &mut CommitReport) -> Result<bool> {
        if self.regions.kept_for() != Some(Filter::Watch) && !self.is_calm() {
            self.stop_watching();
            return Ok(false);
        }
        if !self.commit_by_watching(self.n_present / BEYOND, report)? {
            self.stop_watching();
            return Ok(false);
        }
        self.weigh_watching(report);
        Ok(true)
    }

    /// Weighs what watching has cost against a sweep, and what is watched against what is computed anew.
    fn weigh_watching(&mut self, report: &CommitReport) {
        let costs = costs::<G>();
        let n = self.n_present as f64;
        let watched = self.regions.n_watched() as f64 * costs.watched;
        let beyond = (self.n_present as f64 - report.within_tolerance as f64) * costs.beyond;
        let mended = report.flips + report.placements;
        let mending = if mended > 0 { n * costs.mending } else { 0.0 };
        let auto = &mut self.auto;
        auto.mended = mended;
        auto.excess = (auto.excess + watched + beyond + mending - n * costs.sweep).max(0.0);
        auto.imbalance += watched - beyond;
        if 2.0 * auto.excess > n * costs.computed {
            self.stop_watching();
        } else if auto.imbalance.abs() > n * costs.computed {
            auto.imbalance = 0.0;
            self.regions.invalidate();
        } else {
            auto.next_wait = auto.next_wait.saturating_sub(1);
        }
    }

    /// Whether a sample of the vertices stays within tolerance, but for a few.
    fn is_calm(&mut self) -> bool {
        self.sampled_share(&SwitchingRule { sample: SAMPLE, ..SwitchingRule::default() }) >= SHARE
    }

    fn stop_watching(&mut self) {
        self.auto.is_watching = false;
        self.auto.mended_at_stop = self.auto.mended;
        (self.auto.excess, self.auto.imbalance) = (0.0, 0.0);
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
                self.stop_watching();
            }
        } else if auto.wait > 0 {
            auto.wait -= 1;
        } else if are_most(still) {
            // Without the memory for them all goes on as it did.
            let _ = self.regions.compute(
                &mut self.kernel,
                self.site_of.len(),
                Filter::Tolerance,
                &self.staging.positions,
                &mut CommitReport::default(),
            );
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
        auto.mended = report.flips + report.placements;
        // Also before the wait is over if it has become much calmer.
        let may_try = auto.wait == 0 || 3 * auto.mended < auto.mended_at_stop;
        auto.is_watching = may_try && auto.mended * costs::<G>().calm <= self.n_present as u64;
    }
}
