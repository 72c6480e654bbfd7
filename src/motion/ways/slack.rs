//! *Slack*: a tolerance for each bi-cell; each timestamp checks those that have used it up.
//!
//! ```text
//! move all vertices, and add to their ways
//! for each cell with a vertex that has gone as far as one of its bi-cells allows:
//!     check the bi-cells that have no slack left; compute the tolerances of those that hold
//! if something failed: mend it, as a repair does, and compute the bi-cells of all new cells
//! ```
//!
//! In the tolerance algorithm, and when watching, a vertex beyond its tolerance has its whole star recomputed, in space
//! 66 bi-cells, though hardly more than one of them has become tight. Here it is that one alone
//! ([`Slacks`](crate::motion::filters::slack::Slacks)); in return each timestamp looks at all cells, if only at three
//! or four numbers each.
//!
//! What a timestamp proves is what it proves in [watching](super::watching): read "held" for a bi-cell that
//! has slack left, "watched" for one that has none.
//!
//! Cost: 2 ns a cell, and about 80 ns for a bi-cell whose slack is used up; these are in proportion to the
//! displacement, but for a logarithm.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::machine::memory;
use crate::motion::filters::slack::Expired;
use crate::motion::region_kind::RegionKind;
use crate::motion::report::CommitReport;
use crate::motion::state::goals::Moves;
use crate::motion::state::mesh::REPLACED_TO_SORT_FIRST;
use crate::motion::state::repair::Repair;
use crate::motion::triangulation::MovingTriangulation;
use crate::motion::ways::attempt::{Attempt, Start};
use crate::motion::ways::moving::Motion;

/// With more than this share of the cells past their deadlines, a sweep of everything is cheaper.
const MAX_SHARE_EXPIRED: f64 = 1.0 / 3.0;

impl<G: Moving> MovingTriangulation<G> {
    /// Commits by slack where that is possible, else by repair.
    pub(in crate::motion) fn slack_or_repair(
        &mut self,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        let can = self.mesh.kernel.has_cells() && self.mesh.moves_in_one_loop(moves);
        let attempt =
            if can { self.commit_by_slack(moves, report)? } else { Attempt::GivenUp(Start::AtOrigins) };
        match attempt {
            Attempt::Committed => Ok(()),
            Attempt::GivenUp(start) => self.commit_by_repair(start, moves, report),
        }
    }

    /// Brings all vertices to their goals, and that alone if too many bi-cells have no slack left. No two vertices may
    /// share a site.
    pub(in crate::motion) fn commit_by_slack(
        &mut self,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<Attempt> {
        if self.regions.kept_for() != Some(RegionKind::Slack) {
            let goals = moves.checked()?;
            self.mesh.sort_cells(REPLACED_TO_SORT_FIRST)?;
            self.prepare_regions(RegionKind::Slack, goals.positions(), report)?;
        }
        let mut repair = memory::take_made(&mut self.repair)?;
        let done = self.move_check_and_mend(&mut repair, moves, report);
        self.repair = Some(repair);
        done
    }

    fn move_check_and_mend(
        &mut self,
        repair: &mut Repair,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<Attempt> {
        let slacks = self.regions.slacks().expect("they have been prepared");
        let Motion { moved, greatest, fits } = self.mesh.move_all_on_record(moves, slacks)?;
        let most = (self.mesh.kernel.complex().n_finite() as f64 * MAX_SHARE_EXPIRED) as usize;
        let (origins, (failures, _)) = (self.mesh.transaction.origins().positions(), repair.begin_check());
        let expired = slacks.check_expired(&self.mesh.kernel, origins, greatest, most, failures)?;
        if !fits {
            self.regions.invalidate();
        }
        let Expired::Checked(n) = expired else {
            return Ok(Attempt::GivenUp(Start::AtGoals { n_moved: moved }));
        };
        report.moved += moved;
        report.tolerances += n;
        self.mesh.kernel.count_certificates(3 * n as usize);
        if !repair.is_unneeded() {
            self.mend_checked(repair, &[], moves.checked()?, report)?;
        }
        Ok(Attempt::Committed)
    }
}
