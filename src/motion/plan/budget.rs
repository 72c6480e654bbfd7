//! What repairing and placing cost beside a rebuild, and when so much that to build all cells again would cost less.

use crate::delaunay::Dimension;
use crate::motion::constants::constants;
use crate::motion::report::{CommitReport, Evaluations};
use crate::motion::state::mesh::Mesh;

impl<G: Dimension> Mesh<G> {
    /// By what factor a task, of which one thread does this share alone, grows beside rebuilding, compared with a small
    /// triangulation on one thread: where caches do not hold all, and where several threads rebuild.
    pub(in crate::motion) fn slowdown(&self, alone: f64) -> f64 {
        let constants = constants::<G>();
        let doublings = (self.kernel.bytes_read() as f64 / constants.near_bytes as f64).log2().max(0.0);
        let n_threads = self.kernel.build_threads(self.n_present) as f64;
        let shortened = |alone: f64| alone + (1.0 - alone) / n_threads;
        (1.0 + constants.slower_per_doubling * doublings) * shortened(alone)
            / shortened(constants.built_alone)
    }
}

/// The time that placing vertices may take.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct Budget {
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

impl Budget {
    /// For `left` vertices to be relocated out of `n`, after a sweep with `exact` exact evaluations.
    pub(in crate::motion) fn new<G: Dimension>(
        n: usize,
        left: usize,
        exact: u64,
        evaluations: Evaluations,
        report: &CommitReport,
        slowdown: f64,
    ) -> Self {
        let constants = constants::<G>();
        let costs = &constants.costs;
        let rebuild = n as f64 * costs.rebuilt + constants.exact_per_swept * exact as f64 * costs.exact;
        Budget { evaluations, placements: report.placements, left, all: left, rebuild, slowdown }
    }

    /// Counts a relocation; whether all others, if they cost what the first ones have, cost more than a rebuild.
    pub(in crate::motion) fn is_exceeded<G: Dimension>(
        &mut self,
        now: Evaluations,
        report: &CommitReport,
    ) -> bool {
        let constants = constants::<G>();
        self.left -= 1;
        let evaluated = now.since(self.evaluations);
        // Flips count by certificates; those of placements are in what these cost.
        let certified = evaluated.certificates as f64 * constants.costs.certified;
        let counted = constants.costs.of(report.placements - self.placements, evaluated).max(certified);
        let spent = self.slowdown * counted;
        let done = (self.all - self.left) as f64;
        spent > constants.min_share_spent * self.rebuild
            && spent / done * self.left as f64 > constants.max_placing * self.rebuild
    }
}
