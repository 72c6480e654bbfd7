//! *Auto*: the algorithm for each commit, from what the last ones found.
//!
//! | commit | algorithm |
//! |---|---|
//! | of few of the vertices | tolerance if it is up to date, else placement by flips |
//! | of all vertices, while few leave their tolerance | watching |
//! | of all vertices, while few bi-cells use theirs up, in space | slack |
//! | otherwise | repair, which rebuilds where too much fails |
//! | after such a rebuild | rebuilding, for a while |
//!
//! **Looking at everything or not.** Few flips in the last commits announce that most bi-cells have tolerance left. To
//! compute that of all costs eight sweeps. What is recomputed after that, and watched, is counted and weighed by
//! measured costs ([`Costs`]). When it has cost more than the expensive way would have, by a quarter of a computation of all
//! tolerances, the expensive way is taken, and the cheaper one is tried more and more rarely. In space the way down is repair, slack, watching, without
//! slack where almost nothing changes; in the plane a sweep is so cheap that slack would seldom pay. Before watching
//! a sample of the vertices is checked. When what is watched or what is recomputed has cost more than the other
//! by half a computation of all, all tolerances are computed again, so that what is watched follows from how far the
//! vertices go now.
//!
//! **Rebuilding.** After a repair that had to rebuild, as many commits rebuild at once as have failed in a row, and
//! twice as many the next time.
//!
//! **Immediate relocations** are counted in rounds of as many as there are vertices. After a round of which most
//! changed no cell tolerances are computed, and kept while most relocations are within: a test costs a hundredth of a
//! look at the star, a vertex beyond some eight looks.

use super::attempt::Attempt;
use super::regions::Filter;
use super::staging::Given;
use super::{CommitReport, MovingTriangulation, SwitchingRule};
use crate::delaunay::{Dimension, Shortcut};
use crate::error::Result;

/// A staging is small if it has less than one vertex in `FEW`: a placement costs about as much as sweeping this number of
/// vertices.
const FEW: usize = 20;
/// Watching pays only while less than one vertex in `BEYOND` is beyond its tolerance.
const BEYOND: usize = 8;
/// Vertices sampled before all tolerances are computed, and the share of them that must be within.
const SAMPLE: u32 = 64;
const SHARE: f64 = 0.8;
/// Shortest and longest wait for another try, in commits.
const WAIT: u32 = 16;
const PATIENCE: u32 = 256;
/// Share of the last commit in the pace.
const LAST: f64 = 0.125;
/// What the parts of a commit cost, in nanoseconds.
struct Costs {
    /// A watched bi-cell.
    watched: f64,
    /// A vertex beyond its tolerance.
    beyond: f64,
    /// Per vertex, what a sweep costs that is spared.
    sweep: f64,
    /// Per vertex, checking the slack of all cells; none if that never pays.
    slack: Option<f64>,
    /// A bi-cell that has used up its slack.
    used_up: f64,
    /// Per vertex, to compute all tolerances.
    computed: f64,
    /// The cheaper way is tried after commits with at most one flip or placement per this number of vertices.
    calm: f64,
}

/// Measured with 1,000 vertices in the plane, 13,000 in space, in Lloyd's iterations; only the ratios matter.
const fn costs<G: Dimension>() -> Costs {
    if G::D == 2 {
        Costs {
            watched: 5.0,
            beyond: 1000.0,
            sweep: 11.0,
            slack: None,
            used_up: 0.0,
            computed: 90.0,
            calm: 1500.0,
        }
    } else {
        let slack = Some(18.0);
        Costs {
            watched: 20.0,
            beyond: 7000.0,
            sweep: 60.0,
            slack,
            used_up: 100.0,
            computed: 500.0,
            calm: 250.0,
        }
    }
}

/// Watching is tried without slack before it after commits with at most one flip or placement per this number of vertices.
const QUIET: f64 = 4000.0;
/// Watching is tried when less than one bi-cell per this number of vertices uses up its slack.
const STILL: u64 = 60;

/// How much is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Look {
    /// Repair: everything.
    #[default]
    All,
    /// Slack: all cells, and the bi-cells that have none left.
    Slack,
    /// Watching: all vertices, those beyond, and what is watched.
    Watched,
}

/// Most commits rebuilt without trying to repair.
const REBUILT: u32 = 15;

/// What the last commits found.
#[derive(Debug, Default)]
pub(super) struct Auto {
    look: Look,
    /// By how much that has cost more than the expensive way would have, and what the watched bi-cells have cost more than the
    /// vertices beyond, in nanoseconds.
    excess: f64,
    imbalance: f64,
    /// Whether all tolerances are to be computed again, for balance.
    is_due: bool,
    /// Flips and placements in a commit, a mean with decreasing weights, and what it was when a way was given up.
    pace: f64,
    pace_at_stop: f64,
    /// Commits until a cheaper way may be tried again, and how many they will be next time.
    wait: u32,
    next_wait: u32,
    /// Commits still to be rebuilt without trying to repair, and how many they were last time.
    rebuilds: u32,
    last_rebuilds: u32,
    /// Immediate relocations in this round, those within tolerance, and those that changed no cell.
    relocated: u64,
    within: u64,
    still: u64,
}

impl<G: Dimension> MovingTriangulation<G> {
    pub(super) fn commit_by_auto(
        &mut self,
        given: &mut Given<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        if !self.kernel.has_cells() {
            return self.rebuild_given(given, report);
        }
        if self.staging.count() * FEW < self.n_present {
            return if self.regions.kept_for() == Some(Filter::Tolerance) {
                self.commit_by_tolerance(given, report)
            } else {
                self.commit_by_placement(Shortcut::Flips, given, report)
            };
        }
        if self.auto.rebuilds > 0 {
            self.auto.rebuilds -= 1;
            return self.rebuild_given(given, report);
        }
        if self.staging.is_whole() && self.hidden.count() == 0 && self.commit_by_look(given, report)? {
            return Ok(());
        }
        self.commit_by_repair(given, report)?;
        self.learn(report);
        Ok(())
    }

    /// Commits by watching or by slack, if that is in force; `false` if a repair has to follow.
    fn commit_by_look(&mut self, given: &mut Given<'_, G>, report: &mut CommitReport) -> Result<bool> {
        if self.auto.look == Look::Watched {
            let is_kept = self.regions.kept_for() == Some(Filter::Watch);
            if (is_kept || std::mem::take(&mut self.auto.is_due) || self.is_calm(given)?)
                && self.commit_by_watching(self.n_present / BEYOND, given, report)? == Attempt::Committed
            {
                self.weigh_watching(report);
                return Ok(true);
            }
            self.give_up();
        }
        if self.auto.look == Look::Slack {
            let was_kept = self.regions.kept_for() == Some(Filter::Slack);
            if self.commit_by_slack(given, report)? == Attempt::Committed {
                if was_kept {
                    self.weigh_slack(report);
                }
                return Ok(true);
            }
            self.give_up();
        }
        Ok(false)
    }

    /// Weighs what watching has cost against the more expensive way, and what is watched against what is recomputed.
    fn weigh_watching(&mut self, report: &CommitReport) {
        let costs = costs::<G>();
        let n = self.n_present as f64;
        let watched = self.regions.n_watched() as f64 * costs.watched;
        let beyond = (self.n_present as f64 - report.within_tolerance as f64) * costs.beyond;
        self.auto.imbalance += watched - beyond;
        self.weigh(report, watched + beyond - n * costs.slack.unwrap_or(costs.sweep));
        if 2.0 * self.auto.imbalance.abs() > n * costs.computed {
            self.auto.imbalance = 0.0;
            self.auto.is_due = true;
            self.regions.invalidate();
        }
    }

    /// Weighs what slack has cost against a sweep.
    fn weigh_slack(&mut self, report: &CommitReport) {
        let costs = costs::<G>();
        let n = self.n_present as f64;
        let spared = costs.sweep - costs.slack.unwrap_or_default();
        self.weigh(report, report.tolerances as f64 * costs.used_up - n * spared);
        let auto = &mut self.auto;
        if auto.wait == 0 && report.tolerances * STILL < self.n_present as u64 {
            auto.look = Look::Watched;
        }
    }

    /// Enters by how much a commit has cost more than the more expensive way, which is taken when the sum is too large.
    fn weigh(&mut self, report: &CommitReport, excess: f64) {
        self.follow_pace(report);
        let auto = &mut self.auto;
        auto.excess = (auto.excess + excess).max(0.0);
        auto.wait = auto.wait.saturating_sub(1);
        if 4.0 * auto.excess > self.n_present as f64 * costs::<G>().computed {
            self.give_up();
        } else {
            auto.next_wait = auto.next_wait.saturating_sub(1);
        }
    }

    /// All tolerances are going to be forgotten, though not for anything that the vertices do.
    pub(super) fn note_oblivion(&mut self) {
        self.auto.is_due |= self.auto.look == Look::Watched && self.regions.kept_for() == Some(Filter::Watch);
    }

    /// Whether all but a few of a sample of the vertices stay within tolerance.
    fn is_calm(&mut self, given: &mut Given<'_, G>) -> Result<bool> {
        self.stage_given(given)?;
        Ok(self.sampled_share(&SwitchingRule { sample: SAMPLE, ..SwitchingRule::default() }) >= SHARE)
    }

    /// From now on the more expensive way is taken.
    fn give_up(&mut self) {
        let auto = &mut self.auto;
        auto.look =
            if auto.look == Look::Watched && costs::<G>().slack.is_some() { Look::Slack } else { Look::All };
        auto.pace_at_stop = auto.pace;
        (auto.excess, auto.imbalance, auto.is_due) = (0.0, 0.0, false);
        auto.next_wait = (2 * auto.next_wait + WAIT).min(PATIENCE);
        auto.wait = auto.next_wait;
    }

    /// Immediate relocations in a round.
    #[inline(always)]
    fn round(&self) -> u64 {
        self.n_present.max(SAMPLE as usize) as u64
    }

    /// Whether the next immediate relocation is the last of its round.
    #[inline(always)]
    pub(super) fn is_round_ending(&self) -> bool {
        self.auto.relocated + 1 >= self.round()
    }

    /// Counts immediate relocations within tolerance, none of them the last of its round.
    #[inline(always)]
    pub(super) fn count_within(&mut self, relocated: u64) {
        self.auto.relocated += relocated;
        self.auto.within += relocated;
        self.auto.still += relocated;
    }

    /// Counts an immediate relocation, and decides after a round of them whether tolerances are to be kept.
    pub(super) fn follow_relocation(&mut self, done: &CommitReport) {
        let is_kept = self.regions.kept_for() == Some(Filter::Tolerance);
        let is_last = self.is_round_ending();
        let auto = &mut self.auto;
        auto.relocated += 1;
        auto.within += done.within_tolerance;
        auto.still += done.within_tolerance + done.unchanged;
        if !is_last {
            return;
        }
        let round = auto.relocated;
        let (within, still) = (auto.within, auto.still);
        (auto.relocated, auto.within, auto.still) = (0, 0, 0);
        let are_most = |some: u64| 20 * some >= 17 * round;
        if is_kept {
            if !are_most(within) {
                self.regions.invalidate();
                self.give_up();
            }
        } else if auto.wait > 0 {
            auto.wait -= 1;
        } else if are_most(still) {
            // Without the memory for them all goes on as it did.
            let _ = self.prepare_regions(Filter::Tolerance, &mut CommitReport::default());
        }
    }

    fn follow_pace(&mut self, report: &CommitReport) {
        let mended = (report.flips + report.placements) as f64;
        self.auto.pace += LAST * (mended - self.auto.pace);
    }

    /// Draws conclusions from a repair.
    fn learn(&mut self, report: &CommitReport) {
        self.follow_pace(report);
        let auto = &mut self.auto;
        if report.rebuilds > 0 {
            auto.last_rebuilds = (2 * auto.last_rebuilds + 1).min(REBUILT);
            auto.rebuilds = auto.last_rebuilds;
            return;
        }
        auto.last_rebuilds = 0;
        auto.wait = auto.wait.saturating_sub(1);
        // Also before the wait is over if it has become much calmer.
        let may_try = auto.wait == 0 || 3.0 * auto.pace < auto.pace_at_stop;
        let costs = costs::<G>();
        if may_try && auto.pace * costs.calm <= self.n_present as f64 {
            let is_still = auto.pace * QUIET <= self.n_present as f64;
            auto.look = if costs.slack.is_none() || is_still { Look::Watched } else { Look::Slack };
        }
    }
}
