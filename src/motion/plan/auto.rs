//! Which certificates a commit checks, and what the last ones tell about that.

use crate::motion::constants::Constants;
use crate::motion::report::{CommitReport, Evaluations};
use crate::motion::state::repair::Repair;

/// While vertices are watched, one that is placed counts as so many more beyond: the bi-cells around two places are
/// computed again, which no cache holds.
const BEYOND_PER_PLACED: f64 = 3.0;

/// Watching is tried when less than one bi-cell per this number of vertices uses up its slack.
const VERTICES_PER_USED_UP: u64 = 60;

/// The longest wait for another try of a cheaper way, in shortest waits.
const LONGEST_WAIT: u32 = 16;

/// The wait ends early when changes are that many times rarer than when the cheaper way was given up.
const RARER_CHANGES: f64 = 3.0;

/// Vertices that move one at a time, at once or few in a commit, are counted in rounds of as many as there are.
/// Tolerances are kept for them after a round of which this share changed no cell, and while this share is within.
const MIN_SHARE_OF_ROUND: f64 = 0.85;

/// Most commits rebuilt without trying to repair. After each repair that was too expensive they are twice as many as
/// after the last one, and one more.
const MAX_REBUILDS: u32 = 15;

/// After a repair that was too expensive, commits with more than this share of its failures are rebuilt. How many such
/// commits follows as for [`MAX_REBUILDS`].
const SHARE_TOO_MANY: f64 = 0.5;

/// What is kept for commits of all vertices follows relocations of one in so many, which costs a small part of what to compute
/// it again does.
const FOLLOWED_SHARE: usize = 50;

/// Which certificates a commit checks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::motion) enum Scope {
    /// Repair: everything.
    #[default]
    All,
    /// Slack: all cells, and the bi-cells that have none left.
    Slack,
    /// Watching: all vertices, those beyond, and what is watched.
    Watched,
}

/// What the last commits found.
#[derive(Clone, Debug, Default)]
pub(in crate::motion) struct Auto {
    scope: Scope,
    /// By how much that has cost more than the expensive way would have, and what the watched bi-cells have cost more
    /// than the vertices beyond, in nanoseconds.
    excess: f64,
    imbalance: f64,
    /// Whether all tolerances are to be computed again, for balance.
    is_due: bool,
    /// Flips and placements in a commit, a mean with decreasing weights, and what it was when a way was given up.
    changes: f64,
    changes_at_stop: f64,
    /// Commits until a cheaper way may be tried again, and how many they will be next time.
    wait: u32,
    next_wait: u32,
    /// Commits still to be rebuilt without trying to repair, and how many they were last time.
    rebuilds: u32,
    last_rebuilds: u32,
    /// Failures for each finite cell that are too many to repair: a share of those of the last repair that was too
    /// expensive.
    too_many_failing: f64,
    /// Commits with too many failures that are still to be rebuilt, and how many they were last time.
    refusals: u32,
    last_refusals: u32,
    /// Exact evaluations of the last rebuild that came without a repair that had failed, if there was one.
    exact_of_rebuild: Option<u64>,
    /// Whether the latest commit relocated few vertices, one after the other.
    is_of_few: bool,
    /// Vertices that commits of few have relocated since the last commit of all.
    n_followed: usize,
    /// Relocations in this round, those within tolerance, and those that changed no cell.
    relocated: u64,
    within: u64,
    unchanged: u64,
    /// While tolerances are kept, a relocation within tolerance only lowers `left`: how many may still come before the
    /// last one of the round. `granted` is what that was when those before were entered into the counts above.
    left: u64,
    granted: u64,
}

/// What immediate relocations of a round have done.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct ImmediateRound {
    /// Whether most were within tolerance.
    pub(in crate::motion) are_most_within: bool,
    /// Whether most changed no cell.
    pub(in crate::motion) are_most_unchanged: bool,
}

impl Auto {
    /// Which certificates a commit checks.
    pub(in crate::motion) fn scope(&self) -> Scope {
        self.scope
    }

    /// Whether the next commit is to rebuild without trying to repair; counts it.
    pub(in crate::motion) fn take_rebuild(&mut self) -> bool {
        let rebuilds = self.rebuilds > 0;
        self.rebuilds = self.rebuilds.saturating_sub(1);
        rebuilds
    }

    /// Whether all tolerances are to be computed again, for balance; not any more after that.
    pub(in crate::motion) fn take_due(&mut self) -> bool {
        std::mem::take(&mut self.is_due)
    }

    /// Failures for each finite cell with which not to repair, where some repair was too expensive.
    pub(in crate::motion) fn limit(&self) -> Option<f64> {
        (self.refusals > 0).then_some(self.too_many_failing)
    }

    /// All tolerances are going to be forgotten, though not for anything that the vertices do.
    pub(in crate::motion) fn note_tolerances_dropped(&mut self) {
        self.is_due |= self.scope == Scope::Watched;
    }

    /// A timestamp has been withdrawn, and tolerances are lost with it: to compute them again costs several sweeps, and would
    /// be in vain if the next timestamp is withdrawn too. So commits sweep for a while.
    pub(in crate::motion) fn note_withdrawn(&mut self, constants: &Constants) {
        if self.scope != Scope::All {
            self.scope = Scope::All;
            self.changes_at_stop = self.changes;
            (self.excess, self.imbalance, self.is_due) = (0.0, 0.0, false);
            self.wait = constants.min_wait_commits;
        }
    }

    /// Weighs what watching this number of bi-cells has cost, for `n` vertices, against the more expensive way, and
    /// what is watched against what is recomputed. Whether all tolerances are to be computed again.
    pub(in crate::motion) fn weigh_watching(
        &mut self,
        constants: &Constants,
        n_watched: usize,
        n: usize,
        report: &CommitReport,
    ) -> bool {
        let costs = &constants.costs;
        let vertices = n as f64;
        let watched = n_watched as f64 * costs.watched;
        let beyond = (vertices - report.within_tolerance as f64) * costs.beyond;
        let followed = report.placements as f64 * BEYOND_PER_PLACED * costs.beyond;
        self.imbalance += watched - beyond;
        // Slack would have to follow the same placements.
        let (sweep, slack) = (vertices * costs.sweep, costs.slack.map(|slack| vertices * slack + followed));
        let others = slack.unwrap_or(sweep).min(sweep);
        self.weigh(constants, n, report, watched + beyond + followed - others, others < sweep);
        if self.imbalance.abs() <= constants.max_imbalance * costs.computed * vertices {
            return false;
        }
        self.imbalance = 0.0;
        self.is_due = true;
        true
    }

    /// Weighs what slack has cost, for `n` vertices, against a sweep.
    pub(in crate::motion) fn weigh_slack(&mut self, constants: &Constants, n: usize, report: &CommitReport) {
        let costs = &constants.costs;
        if report.moved == 0 {
            // At rest slack neither spares nor costs much.
            return;
        }
        // Few that move are placed without a sweep.
        let sweep = if constants.are_few(report.moved as usize, n) { 0.0 } else { costs.sweep };
        let spared = sweep - costs.slack.unwrap_or_default();
        self.weigh(constants, n, report, report.tolerances as f64 * costs.used_up - n as f64 * spared, false);
        if self.wait == 0 && report.tolerances * VERTICES_PER_USED_UP < n as u64 {
            self.scope = Scope::Watched;
        }
    }

    /// Enters by how much a commit has cost more than the more expensive way, which is taken when the sum is too large:
    /// slack, if that would have cost less than a sweep.
    fn weigh(
        &mut self,
        constants: &Constants,
        n: usize,
        report: &CommitReport,
        excess: f64,
        is_slack_less: bool,
    ) {
        self.follow_changes(constants, report);
        self.excess = (self.excess + excess).max(0.0);
        self.wait = self.wait.saturating_sub(1);
        if self.excess > constants.max_excess * constants.costs.computed * n as f64 {
            self.give_up(constants, n, is_slack_less && report.rebuilds == 0);
        } else {
            self.next_wait = self.next_wait.saturating_sub(1);
        }
    }

    /// From now on the more expensive way is taken: slack, if that may come next and few cells change, or a sweep.
    pub(in crate::motion) fn give_up(&mut self, constants: &Constants, n: usize, may_be_slack: bool) {
        let may_be_slack = may_be_slack && constants.costs.slack.is_some();
        self.scope = if may_be_slack && self.changes * constants.vertices_per_change <= n as f64 {
            Scope::Slack
        } else {
            Scope::All
        };
        self.changes_at_stop = self.changes;
        (self.excess, self.imbalance, self.is_due) = (0.0, 0.0, false);
        let longer = 2 * self.next_wait + constants.min_wait_commits;
        self.next_wait = longer.min(LONGEST_WAIT * constants.min_wait_commits);
        self.wait = self.next_wait;
    }

    /// Whether the next relocation within tolerance is surely not the last one of its round.
    #[inline(always)]
    pub(in crate::motion) fn may_count_within(&self) -> bool {
        self.left > 0
    }

    /// Counts a relocation within tolerance that is not the last one of its round, if there was one.
    #[inline(always)]
    pub(in crate::motion) fn count_within(&mut self, relocated: bool) {
        self.left -= u64::from(relocated);
    }

    /// Tolerances are kept: a round has `round` relocations from now on.
    pub(in crate::motion) fn grant(&mut self, round: u64) {
        self.left = round.saturating_sub(self.relocated + 1);
        self.granted = self.left;
    }

    /// Enters the relocations that have only lowered `left`.
    fn enter_within(&mut self) {
        let counted = self.granted - self.left;
        self.granted = self.left;
        self.relocated += counted;
        self.within += counted;
        self.unchanged += counted;
    }

    /// Notes whether the commit relocates few vertices, one after the other.
    pub(in crate::motion) fn note_few(&mut self, is_of_few: bool) {
        self.is_of_few = is_of_few;
        if !is_of_few {
            self.n_followed = 0;
        }
    }

    /// Counts `n_moved` of `n` vertices as relocated by a commit of few; whether what is kept for commits of all is to follow: as long
    /// as they are few in all since the last such commit, as the next one would have to compute it again otherwise.
    pub(in crate::motion) fn count_few(&mut self, n_moved: usize, n: usize) -> bool {
        self.n_followed = self.n_followed.saturating_add(n_moved);
        self.n_followed <= n / FOLLOWED_SHARE
    }

    /// Whether the commit has done so; not any more after that.
    pub(in crate::motion) fn take_few(&mut self) -> bool {
        std::mem::take(&mut self.is_of_few)
    }

    /// Counts relocations in a round of `round`; what has become of the round if it ends with them.
    pub(in crate::motion) fn count_relocations(
        &mut self,
        round: u64,
        done: &CommitReport,
    ) -> Option<ImmediateRound> {
        self.enter_within();
        self.relocated += done.moved;
        self.within += done.within_tolerance;
        self.unchanged += done.within_tolerance + done.unchanged;
        if self.relocated < round {
            return None;
        }
        let least = MIN_SHARE_OF_ROUND * self.relocated as f64;
        let are_most = |some: u64| some as f64 >= least;
        let ended = ImmediateRound {
            are_most_within: are_most(self.within),
            are_most_unchanged: are_most(self.unchanged),
        };
        (self.relocated, self.within, self.unchanged) = (0, 0, 0);
        Some(ended)
    }

    /// Whether a cheaper way may be tried again; a round has passed.
    pub(in crate::motion) fn has_waited(&mut self) -> bool {
        let has_waited = self.wait == 0;
        self.wait = self.wait.saturating_sub(1);
        has_waited
    }

    fn follow_changes(&mut self, constants: &Constants, report: &CommitReport) {
        let mended = (report.flips + report.placements) as f64;
        self.changes += constants.weight_of_last * (mended - self.changes);
    }

    /// Notes what a commit that rebuilt without trying to repair has evaluated.
    pub(in crate::motion) fn note_rebuild(&mut self, [before, after]: [Evaluations; 2]) {
        self.exact_of_rebuild = Some(after.exact - before.exact);
    }

    /// Whether a repair of `n` vertices has cost more than rebuilding would have. Placements count by their number, or
    /// together with flips by what they have evaluated, whichever is more.
    fn is_too_expensive(
        &self,
        constants: &Constants,
        n: usize,
        (n_swept, slowdown): (u64, f64),
        report: &CommitReport,
        [before, after]: [Evaluations; 2],
    ) -> bool {
        let (costs, done) = (&constants.costs, after.since(before));
        let certified = done.certificates.saturating_sub(n_swept) as f64 * costs.certified;
        let counted = costs.of(report.placements, done).max(certified);
        let spent = n as f64 * costs.sweep + slowdown * counted;
        // While it is not known it counts as equal.
        let exact_of_rebuild = self.exact_of_rebuild.unwrap_or(done.exact);
        spent > n as f64 * costs.rebuilt + exact_of_rebuild as f64 * costs.exact
    }

    /// Draws conclusions from a repair, for `n` vertices, of which the sweep has checked so many certificates, and
    /// which takes so many times as long as counts tell.
    pub(in crate::motion) fn learn(
        &mut self,
        constants: &Constants,
        n: usize,
        swept: (u64, f64),
        report: &CommitReport,
        repair: &Repair,
        evaluations: [Evaluations; 2],
    ) {
        if report.moved == 0 {
            // Vertices at rest tell nothing about how they will move.
            return;
        }
        self.follow_changes(constants, report);
        let [before, after] = evaluations;
        if report.rebuilds > 0 && repair.was_foreseen() {
            // All but the sweep's.
            self.exact_of_rebuild = Some(after.since(before).exact.saturating_sub(repair.exact_of_sweep()));
        }
        if report.rebuilds > 0 || self.is_too_expensive(constants, n, swept, report, evaluations) {
            self.rebuilds = self.last_rebuilds;
            let more = 2 * self.last_rebuilds + 1;
            self.last_rebuilds = more.min(MAX_REBUILDS);
            if repair.was_foreseen() {
                self.refusals = self.refusals.saturating_sub(1);
            } else if repair.share_failing() > 0.0 && (report.rebuilds == 0 || !repair.is_dented()) {
                self.too_many_failing = SHARE_TOO_MANY * repair.share_failing();
                let more = 2 * self.last_refusals + 1;
                self.last_refusals = more.min(MAX_REBUILDS);
                self.refusals = self.last_refusals;
            }
            return;
        }
        self.last_rebuilds = 0;
        // Few failures tell nothing about many.
        if self.refusals == 0 && repair.share_failing() > self.too_many_failing {
            self.last_refusals = 0;
        }
        self.wait = self.wait.saturating_sub(1);
        // Also before the wait is over if changes have become much rarer.
        let may_try = self.wait == 0 || RARER_CHANGES * self.changes < self.changes_at_stop;
        // Few that move and change cells take less time without tolerances.
        let are_placed = constants.are_few(report.moved as usize, n) && report.flips + report.placements > 0;
        if may_try && !are_placed && self.changes * constants.vertices_per_change <= n as f64 {
            let are_changes_rare = self.changes * constants.vertices_per_change_to_watch <= n as f64;
            let skips_slack = constants.costs.slack.is_none() || are_changes_rare;
            self.scope = if skips_slack { Scope::Watched } else { Scope::Slack };
        }
    }
}
