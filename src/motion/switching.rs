//! *Rebuilding + tolerance* (report, section 5.2): rebuild while most vertices leave their tolerance, then swap.
//!
//! "We sample 40 random vertices at each group of four iterations, and we compute their tolerance. We then compare their
//! tolerance with their displacement size, and check if at least 75 % of those vertices have their tolerance larger than
//! their displacement size" (75 % in the plane, 55 % in space). In this case the algorithms are swapped, for good.
//!
//! The sample is drawn by a seeded generator, so a run can be repeated.

use super::MovingTriangulation;
use super::staging::Given;
use super::{CommitReport, SwitchingRule};
use crate::delaunay::Dimension;
use crate::error::Result;
use crate::predicates::{displacement_limit, squared_distance};

/// Where the algorithm is.
#[derive(Debug, Default)]
pub(super) struct Switching {
    has_switched: bool,
    commits: u64,
    draws: u64,
}

impl Switching {
    /// Whether it is *tolerance*'s turn.
    pub(super) fn has_switched(&self) -> bool {
        self.has_switched
    }

    /// A number below `n`, by SplitMix64 (Steele, Lea and Flood, 10.1145/2714064.2660195).
    fn draw(&mut self, seed: u64, n: usize) -> usize {
        self.draws += 1;
        let mut z = seed.wrapping_add(self.draws.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((u128::from(z ^ z >> 31) * n as u128) >> 64) as usize
    }
}

impl<G: Dimension> MovingTriangulation<G> {
    pub(super) fn commit_by_switching(
        &mut self,
        given: &mut Given<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        self.stage_given(given)?;
        let rule = self.options.switching;
        let group = u64::from(rule.period.max(1));
        if !self.switching.has_switched && self.switching.commits.is_multiple_of(group) {
            self.switching.has_switched = self.sampled_share(&rule) >= rule.share_for::<G>();
        }
        self.switching.commits += 1;
        if self.switching.has_switched {
            self.commit_by_tolerance(given, report)
        } else {
            self.rebuild_staged(report)
        }
    }

    /// Share of a sample of the vertices whose displacement is within their tolerance.
    pub(super) fn sampled_share(&mut self, rule: &SwitchingRule) -> f64 {
        if self.site_of.is_empty() || !self.kernel.has_cells() {
            return 0.0;
        }
        let mut within = 0;
        for _ in 0..rule.sample {
            let v = self.switching.draw(rule.seed, self.site_of.len()) as u32;
            if !self.is_present(v) || !self.staging.is_staged(v) {
                within += 1;
                continue;
            }
            let s = self.site_of[v as usize];
            let displacement =
                squared_distance(&self.kernel.site(s).point, &self.staging.positions[v as usize]);
            within += u32::from(displacement < displacement_limit(self.tolerance_of_site(s)));
        }
        f64::from(within) / f64::from(rule.sample.max(1))
    }

    /// Starts over with rebuilding, when the algorithm is chosen again.
    pub(super) fn reset_switching(&mut self) {
        self.switching = Switching::default();
    }
}
