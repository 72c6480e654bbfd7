//! *Auto*: the algorithm for each commit, from what the last ones found.
//!
//! | commit | algorithm |
//! |---|---|
//! | of few of the vertices | tolerance if up to date, else placement by flips, rebuilding where that costs more; what is kept for commits of all follows where these are few between two such |
//! | of all vertices, while few leave their tolerance | watching |
//! | of all vertices, while few bi-cells use theirs up, in space | slack |
//! | otherwise | repair, which rebuilds where too much fails |
//! | after such a rebuild | rebuilding, for a while |
//!
//! **What is known before** decides before anything that the last commits have found: where nothing moves, nothing is
//! done; where all vertices move by exactly the same vector, the cells stay; and few vertices that move are placed,
//! also while commits are rebuilt or a cheaper way is due to be tried ([`outlook`](super::outlook)).
//!
//! **Checking everything or not.** Few flips in the last commits announce that most bi-cells have tolerance left. To
//! compute that of all costs eight sweeps. What is recomputed after that, and watched, is counted and weighed by
//! measured costs ([`constants`](crate::motion::constants)). When it has cost more than the expensive way would have,
//! by a share of a computation of all tolerances, the expensive way is taken, and the cheaper one is tried more and
//! more rarely. In space the way down is repair, slack, watching, without slack where almost nothing changes, and the
//! way up the same, without slack where much has changed; in the plane a sweep is so cheap that slack would seldom pay.
//! Before watching a sample of the vertices is checked. When what is watched or what is recomputed has cost more than
//! the other by a share of a computation of all, all tolerances are computed again, so that what is watched follows
//! from how far the vertices go now.
//!
//! **Rebuilding.** A repair may have to rebuild, or cost more than that, only once: when points leave a lattice. So
//! the next commit is swept as well. If repairs rebuild twice in a row, the next commit rebuilds without a sweep, then
//! three commits, then seven. Where a repair was expensive because of what came after its sweep, the next commit with
//! at least half as many failures is rebuilt; after the second such repair three commits are, then seven. What a
//! repair has cost is estimated from what it has counted. On lattices exact evaluations, and removals of vertices of
//! high degree near the hull, cost more than flips.
//!
//! **Immediate relocations** are counted in rounds of as many as there are vertices. After a round of which most
//! changed no cell tolerances are computed, and kept while most relocations are within: a test costs a hundredth of a
//! look at the star, a vertex beyond some eight looks.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::machine::memory;
use crate::motion::algorithms::Algorithm;
use crate::motion::options::SwitchingRule;
use crate::motion::plan::auto::{ImmediateRound, Scope};
use crate::motion::plan::budget::REPAIRED_ALONE;
use crate::motion::region_kind::RegionKind;
use crate::motion::report::CommitReport;
use crate::motion::state::goals::Moves;
use crate::motion::state::mesh::REPLACED_TO_SORT_FIRST;
use crate::motion::state::mesh::Standing;
use crate::motion::triangulation::MovingTriangulation;
use crate::motion::ways::attempt::{Attempt, Start};
use crate::motion::ways::outlook::Outlook;

/// Vertices sampled before all tolerances are computed.
const SAMPLED_VERTICES: u32 = 64;

/// Tolerances are computed only if this share of the sampled vertices is within its own.
const MIN_SHARE_WITHIN: f64 = 0.8;

/// While tolerances are kept, rounds are shorter by this factor: where they are of no use, every move is the more
/// expensive for them.
const SHORTER_ROUNDS: f64 = 8.0;

impl<G: Moving> MovingTriangulation<G> {
    pub(in crate::motion) fn commit_by_auto(
        &mut self,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        let is_of_few = self.mesh.constants.are_few(moves.count(), self.mesh.n_present);
        self.auto.note_few(is_of_few);
        if !self.mesh.kernel.has_cells() {
            return self.rebuild(moves, report);
        }
        if is_of_few {
            return match self.regions.kept_for() {
                Some(RegionKind::Tolerance) => self.commit_by_tolerance(moves, report),
                Some(_) if self.auto.count_few(moves.count(), self.mesh.n_present) => {
                    self.place_or_rebuild_with_regions(moves, report)
                }
                _ => self.commit_by_placement_or_rebuilding(moves, report),
            };
        }
        let is_rebuild_due = self.auto.take_rebuild();
        if !self.keeps_for_scope() {
            let is_way_due = is_rebuild_due || self.auto.scope() != Scope::All;
            match self.mesh.outlook(moves, is_way_due) {
                Outlook::AtRest => return Ok(()),
                Outlook::Together => return self.commit_together(moves, report),
                // Few moves do not tell how all will move.
                Outlook::FewMove => return self.commit_by_repair(Start::AtOrigins, moves, report),
                Outlook::Unknown => {}
            }
        }
        let before = self.mesh.evaluations();
        if is_rebuild_due {
            self.rebuild(moves, report)?;
            let after = self.mesh.evaluations();
            self.auto.note_rebuild([before, after]);
            return Ok(());
        }
        let can_check_less = self.mesh.moves_in_one_loop(moves);
        let start = match self.commit_by_scope(can_check_less, moves, report)? {
            Attempt::Committed => return Ok(()),
            Attempt::GivenUp(start) => start,
        };
        memory::made(&mut self.repair)?.set_limit(self.auto.limit());
        let repaired = self.commit_by_repair(start, moves, report);
        let (evaluations, slowdown) = ([before, self.mesh.evaluations()], self.mesh.slowdown(REPAIRED_ALONE));
        let repair = memory::made(&mut self.repair)?;
        repair.set_limit(None);
        repaired?;
        let swept = (self.mesh.kernel.n_certificates(), slowdown);
        self.auto.learn(self.mesh.constants, self.mesh.n_present, swept, report, repair, evaluations);
        Ok(())
    }

    /// Whether what the scope in force wants is kept: then a commit in which little happens takes hardly any time.
    fn keeps_for_scope(&self) -> bool {
        let wanted = match self.auto.scope() {
            Scope::All => return false,
            Scope::Slack => RegionKind::Slack,
            Scope::Watched => RegionKind::Watch,
        };
        self.regions.kept_for() == Some(wanted)
    }

    /// Moves all vertices, which go by one exact vector. Whatever the cells are a function of stays as it is but for
    /// that, so they stay.
    fn commit_together(&mut self, moves: &mut Moves<'_, G>, report: &mut CommitReport) -> Result<()> {
        self.regions.invalidate();
        if self.mesh.moves_in_one_loop(moves) {
            self.mesh.move_everything(moves)?;
        } else {
            self.move_sites_together(moves)?;
        }
        (report.moved, report.unchanged) = (self.mesh.n_present as u64, self.mesh.n_present as u64);
        Ok(())
    }

    /// Moves all vertices, some of which share their sites.
    fn move_sites_together(&mut self, moves: &mut Moves<'_, G>) -> Result<()> {
        let (goals, movers) = (moves.checked()?, self.queue_of(moves)?);
        let (mut lower, mut upper) = (self.mesh.kernel.lower(), self.mesh.kernel.upper());
        self.mesh.transaction.origins_mut().make_room(self.mesh.site_of.len(), movers.len())?;
        for &v in &movers {
            if let Standing::Shown(s) | Standing::Above(s) = self.mesh.standing(v) {
                let goal = goals.of(v);
                for k in 0..G::NUMBERS {
                    (lower[k], upper[k]) = (lower[k].min(goal[k]), upper[k].max(goal[k]));
                }
                self.mesh.transaction.origins_mut().note(v, self.mesh.kernel.site(s).point);
                self.mesh.kernel.set_point(s, goal);
            }
        }
        self.mesh.kernel.cover(&lower, &upper);
        self.queue = movers;
        Ok(())
    }

    /// Commits by watching or by slack, if that is in force and `can` be done.
    fn commit_by_scope(
        &mut self,
        can: bool,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<Attempt> {
        let mut ended = Attempt::GivenUp(Start::AtOrigins);
        if !can {
            return Ok(ended);
        }
        if self.auto.scope() == Scope::Watched {
            let is_kept = self.regions.kept_for() == Some(RegionKind::Watch);
            if (is_kept || self.auto.take_due() || self.is_sample_within(moves)?)
                && self.commit_by_watching(moves, report)? == Attempt::Committed
            {
                if self.auto.weigh_watching(
                    self.mesh.constants,
                    self.regions.n_watched(),
                    self.mesh.n_present,
                    report,
                ) {
                    self.regions.invalidate();
                }
                return Ok(Attempt::Committed);
            }
            self.auto.give_up(self.mesh.constants, self.mesh.n_present, true);
        }
        if self.auto.scope() == Scope::Slack {
            let was_kept = self.regions.kept_for() == Some(RegionKind::Slack);
            ended = self.commit_by_slack(moves, report)?;
            if ended == Attempt::Committed {
                if was_kept {
                    self.auto.weigh_slack(self.mesh.constants, self.mesh.n_present, report);
                }
                if self.mesh.kernel.is_disordered(REPLACED_TO_SORT_FIRST) {
                    // So that the next commit sorts the cells.
                    self.regions.invalidate();
                    self.mesh.want_order_when_published();
                }
                return Ok(ended);
            }
            self.auto.give_up(self.mesh.constants, self.mesh.n_present, false);
        }
        Ok(ended)
    }

    /// All tolerances are going to be forgotten, though not for anything that the vertices do.
    pub(in crate::motion) fn note_tolerances_dropped(&mut self) {
        if self.regions.kept_for() == Some(RegionKind::Watch) {
            self.auto.note_tolerances_dropped();
        }
    }

    /// Whether all but a few of a sample of the vertices stay within tolerance.
    fn is_sample_within(&mut self, moves: &mut Moves<'_, G>) -> Result<bool> {
        let rule = SwitchingRule { sample: SAMPLED_VERTICES, ..SwitchingRule::default() };
        Ok(self.sampled_share(&rule, moves)? >= MIN_SHARE_WITHIN)
    }

    /// Relocations in a round.
    fn round(&self, is_kept: bool) -> u64 {
        let all = self.mesh.n_present as f64;
        let round = if is_kept { all / SHORTER_ROUNDS } else { all };
        round.max(f64::from(SAMPLED_VERTICES)) as u64
    }

    /// Whether the next relocation within tolerance is surely not the last one of its round.
    #[inline(always)]
    pub(in crate::motion) fn may_count_within(&self) -> bool {
        self.auto.may_count_within()
    }

    /// Counts an immediate relocation within tolerance that is not the last one of its round, if there was one.
    #[inline(always)]
    pub(in crate::motion) fn count_within(&mut self, relocated: bool) {
        self.auto.count_within(relocated);
    }

    /// Counts the relocations of a commit of few vertices.
    pub(in crate::motion) fn follow_commit(&mut self, done: &CommitReport) {
        if self.options.algorithm == Algorithm::Auto && self.auto.take_few() && self.mesh.kernel.has_cells() {
            self.follow_relocations(done);
        }
    }

    /// Counts relocations, and decides after a round of them whether tolerances are to be kept.
    pub(in crate::motion) fn follow_relocations(&mut self, done: &CommitReport) {
        let is_kept = self.regions.kept_for() == Some(RegionKind::Tolerance);
        let round = self.round(is_kept);
        if let Some(ended) = self.auto.count_relocations(round, done) {
            self.follow_round(is_kept, ended);
        }
        if self.regions.kept_for() == Some(RegionKind::Tolerance) {
            self.auto.grant(self.round(true));
        }
    }

    /// Decides after a round.
    fn follow_round(&mut self, is_kept: bool, ended: ImmediateRound) {
        if is_kept {
            if !ended.are_most_within {
                self.regions.invalidate();
                self.auto.give_up(self.mesh.constants, self.mesh.n_present, false);
            }
        } else if self.auto.has_waited() && ended.are_most_unchanged {
            // Without the memory for them all goes on as it did.
            let _ = self.prepare_regions(RegionKind::Tolerance, &[], &mut CommitReport::default());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::REPLACED_TO_SORT_FIRST;
    use crate::delaunay::{Level, Space};
    use crate::ids::VertexId;
    use crate::motion::options::Options;
    use crate::motion::region_kind::RegionKind;
    use crate::motion::triangulation::MovingTriangulation;
    use crate::random::Rng;

    /// Random points in a cube, and their triangulation.
    fn random(n: usize, side: f64, rng: &mut Rng) -> (Vec<[f64; 3]>, MovingTriangulation<Space>) {
        let mut points = vec![[0.0; 3]; n];
        points.as_flattened_mut().iter_mut().for_each(|x| *x = side * rng.unit());
        let options = Options { threads: 1, ..Options::default() };
        let t = MovingTriangulation::new(&points, options).expect("room");
        (points, t)
    }

    /// What is kept for commits of all stays while few vertices move or come in between, and is still right: the next commit of
    /// all computes few tolerances, and ends in the triangulation of a build.
    #[test]
    fn tolerances_follow_few_vertices() {
        let rng = &mut Rng::new(3);
        let (mut now, mut t) = random(2_000, 12.0, rng);
        for step in 0..40 {
            now.as_flattened_mut().iter_mut().for_each(|x| *x += 1e-5 * (rng.unit() - 0.5));
            let report = t.commit_positions(&now).expect("a commit");
            let kept = t.regions.kept_for();
            // By then it has found out how little changes.
            if step > 20 {
                assert!(kept.is_some(), "step {step}");
                assert!(report.tolerances < now.len() as u64, "step {step}: {}", report.tolerances);
            }
            if step % 2 == 0 {
                let place = [12.0 * rng.unit(), 12.0 * rng.unit(), 12.0 * rng.unit()];
                t.stage_insertions(&[place]).expect("room");
                now.push(place);
            }
            let v = VertexId::at(rng.below(2_000));
            now[v] = [12.0 * rng.unit(), 12.0 * rng.unit(), 12.0 * rng.unit()];
            t.move_vertices(&[v], &[now[v]]).expect("room");
            t.commit_timestamp().expect("a commit");
            assert_eq!(t.regions.kept_for(), kept, "step {step}");
        }
        t.validate(Level::Delaunay).expect("a triangulation");
        let built = MovingTriangulation::<Space>::new(&now, Options::default()).expect("room");
        assert_eq!(t.cell_count(), built.cell_count());
    }

    /// Cells are sorted again as flips, placements and insertions replace them: after repairs, before slacks are
    /// computed and while they are kept. They stay those of the triangulation.
    #[test]
    fn cells_are_sorted_again() {
        let rng = &mut Rng::new(1);
        // More cells than a processor's own cache holds.
        let (n, side) = (6_000, 18.0);
        let (mut now, mut t) = random(n, side, rng);
        let first = REPLACED_TO_SORT_FIRST;
        for (step, n_commits, is_slack) in [(0.06, 60, false), (1e-4, 20, true), (1e-4, 3, true)] {
            let mut n_sorted = 0;
            for _ in 0..n_commits {
                now.as_flattened_mut().iter_mut().for_each(|x| *x += step * (rng.unit() - 0.5));
                let was_disordered = t.mesh.kernel.is_disordered(first);
                let rebuilds = t.commit_positions(&now).expect("room").rebuilds;
                n_sorted += u32::from(rebuilds == 0 && was_disordered && !t.mesh.kernel.is_disordered(first));
            }
            assert_eq!(t.regions.kept_for() == Some(RegionKind::Slack), is_slack);
            assert!(if is_slack { n_sorted == 1 } else { n_sorted > 1 }, "{n_sorted} of {n_commits}");
            assert_eq!(t.validate(Level::Delaunay), Ok(()));
            while is_slack && !t.mesh.kernel.is_disordered(first) {
                let place = [(); 3].map(|()| side * rng.unit());
                t.insert_vertex(&place).expect("room");
                now.push(place);
            }
        }
    }

    /// All vertices creep, and from some timestamp on this share of them leaps at each. Whether they are watched at the
    /// end, and how many bi-cells are before the leaps and at the end.
    fn watched_among_leaps(share: f64) -> (bool, usize, usize) {
        let rng = &mut Rng::new(3);
        let (n, side) = (6_000, 18.0);
        let (mut now, mut t) = random(n, side, rng);
        let mut n_before = 0;
        for commit in 0..50 {
            if commit == 10 {
                n_before = t.regions.n_watched();
            }
            for p in &mut now {
                let leaps = commit >= 10 && rng.unit() < share;
                p.iter_mut()
                    .for_each(|x| *x = if leaps { side * rng.unit() } else { *x + 1e-5 * rng.unit() });
            }
            t.commit_positions(&now).expect("room");
        }
        assert_eq!(t.validate(Level::Delaunay), Ok(()));
        (t.regions.kept_for() == Some(RegionKind::Watch), n_before, t.regions.n_watched())
    }

    /// Where few vertices leap, the others stay watched, and hardly more bi-cells are; where many do, the leaps cost
    /// more than watching spares.
    #[test]
    fn few_leaps_leave_the_others_watched() {
        let (are_watched, n_before, n_after) = watched_among_leaps(5e-4);
        assert!(are_watched && n_before > 100 && n_after < 2 * n_before, "{n_before} to {n_after}");
        let (are_watched, ..) = watched_among_leaps(2e-2);
        assert!(!are_watched);
    }
}
