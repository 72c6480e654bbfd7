//! What repairing and placing cost beside a rebuild, and when so much that to build all cells again would cost less.

use crate::delaunay::Moving;
use crate::motion::constants::Constants;
use crate::motion::report::{CommitReport, Evaluations};
use crate::motion::state::mesh::Mesh;

/// With each doubling of what sites and cells take beyond [`NEAR_BYTES`] repair and placement take longer by this share
/// of what they do where caches hold all, beside rebuilding, which reads them in order.
const SLOWER_PER_DOUBLING: f64 = 0.11;

/// Bytes of sites and cells below which that makes no difference.
const NEAR_BYTES: f64 = (4 << 20) as f64;

/// Share of a build in parts that one thread does alone.
const BUILT_ALONE: f64 = 0.12;

/// Share of a repair that one thread does alone.
pub(in crate::motion) const REPAIRED_ALONE: f64 = 0.3;

/// Whether to give up placing is asked once this share of what a rebuild costs has been spent.
const MIN_SHARE_SPENT: f64 = 1.0 / 16.0;

impl<G: Moving> Mesh<G> {
    /// By what factor a task, of which one thread does this share alone, grows beside rebuilding, compared with a small
    /// triangulation on one thread: where caches do not hold all, and where several threads rebuild. With a number of parts
    /// given there are taken to be as many threads, so that what is done does not depend on how many there are.
    pub(in crate::motion) fn slowdown(&self, alone: f64) -> f64 {
        let doublings = (self.kernel.bytes_read() as f64 / NEAR_BYTES).log2().max(0.0);
        let n_parts = self.kernel.build_parts(self.n_present) as f64;
        let shortened = |alone: f64| alone + (1.0 - alone) / n_parts;
        (1.0 + SLOWER_PER_DOUBLING * doublings) * shortened(alone) / shortened(BUILT_ALONE)
    }
}

/// The time that placing vertices may take.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct Budget<'c> {
    constants: &'c Constants,
    /// What had been evaluated, and how many vertices placed, at the beginning.
    evaluations: Evaluations,
    placements: u64,
    /// Vertices still to be relocated, and of how many.
    left: usize,
    all: usize,
    /// What a rebuild would cost, and by what factor relocations cost more than their counts tell.
    rebuild: f64,
    slowdown: f64,
}

impl<'c> Budget<'c> {
    /// For `left` vertices to be relocated out of `n`, after a sweep with `exact` exact evaluations.
    pub(in crate::motion) fn new(
        constants: &'c Constants,
        n: usize,
        left: usize,
        exact: u64,
        evaluations: Evaluations,
        report: &CommitReport,
        slowdown: f64,
    ) -> Self {
        let costs = &constants.costs;
        let rebuild = n as f64 * costs.rebuilt + constants.exact_per_swept * exact as f64 * costs.exact;
        Budget { constants, evaluations, placements: report.placements, left, all: left, rebuild, slowdown }
    }

    /// Counts a relocation; whether all others, if they cost what the first ones have, cost more than a rebuild.
    pub(in crate::motion) fn is_exceeded(&mut self, now: Evaluations, report: &CommitReport) -> bool {
        let constants = self.constants;
        self.left -= 1;
        let evaluated = now.since(self.evaluations);
        // Flips count by certificates; those of placements are in what these cost.
        let certified = evaluated.certificates as f64 * constants.costs.certified;
        let counted = constants.costs.of(report.placements - self.placements, evaluated).max(certified);
        let spent = self.slowdown * counted;
        let done = (self.all - self.left) as f64;
        spent > MIN_SHARE_SPENT * self.rebuild
            && spent / done * self.left as f64 > constants.max_placing * self.rebuild
    }
}
