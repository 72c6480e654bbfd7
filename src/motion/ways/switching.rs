//! *Rebuilding + tolerance* (report, section 5.2): rebuild while most vertices leave their tolerance, then swap.
//!
//! "We sample 40 random vertices at each group of four iterations, and we compute their tolerance. We then compare
//! their tolerance with their displacement size, and check if at least 75 % of those vertices have their tolerance
//! larger than their displacement size" (75 % in the plane, 55 % in space). In this case the algorithms are swapped,
//! for good.
//!
//! The sample is drawn by a seeded generator, so a run can be repeated.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::motion::filters::bicell::tolerance_of_site;
use crate::motion::options::SwitchingRule;
use crate::motion::report::CommitReport;
use crate::motion::state::goals::{Movers, Moves};
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::{displacement_limit, squared_distance};

impl<G: Moving> MovingTriangulation<G> {
    pub(in crate::motion) fn commit_by_switching(
        &mut self,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        let mut rule = self.switching.rule();
        rule.sample = rule.sample.min(self.mesh.site_of.len() as u32);
        let group = u64::from(rule.period.max(1));
        if self.switching.begin_commit(group) && self.sampled_share(&rule, moves)? >= rule.share_for::<G>() {
            self.switching.switch();
        }
        if self.switching.has_switched() {
            self.commit_by_tolerance(moves, report)
        } else {
            self.rebuild(moves, report)
        }
    }

    /// Share of a sample of the vertices whose displacement is within their tolerance. Those that stay where they are
    /// count as such.
    pub(in crate::motion) fn sampled_share(
        &mut self,
        rule: &SwitchingRule,
        moves: &mut Moves<'_, G>,
    ) -> Result<f64> {
        let (movers, goals) = (moves.movers(), moves.checked()?);
        if self.mesh.site_of.is_empty() || !self.mesh.kernel.has_cells() {
            return Ok(0.0);
        }
        let mut within = 0;
        for _ in 0..rule.sample {
            let k = self.switching.draw(rule.seed, self.mesh.site_of.len());
            let mover = match movers {
                Movers::All => Some(VertexId::at(k)),
                Movers::Listed(vertices) => vertices.get(k).copied(),
            };
            let Some(v) = mover else {
                within += 1;
                continue;
            };
            let s = self.mesh.site_of[v];
            let displacement = squared_distance(&self.mesh.kernel.site(s).point, &goals.of(v));
            within +=
                u32::from(displacement < displacement_limit(tolerance_of_site(&mut self.mesh.kernel, s)));
        }
        Ok(f64::from(within) / f64::from(rule.sample.max(1)))
    }

    /// The rule of [`Algorithm::RebuildingTolerance`](crate::motion::Algorithm::RebuildingTolerance), from the next
    /// commit on; until this is called it is the default one.
    pub fn set_switching_rule(&mut self, rule: SwitchingRule) {
        self.switching.set_rule(rule);
    }

    /// Starts over with rebuilding, when the algorithm is chosen again.
    pub(in crate::motion) fn reset_switching(&mut self) {
        self.switching.start_over();
    }
}
