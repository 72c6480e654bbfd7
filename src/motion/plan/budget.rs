//! What repairing and placing cost beside a rebuild, and when so much that to build all cells again would cost less.

use crate::delaunay::Dimension;
use crate::motion::constants::Constants;
use crate::motion::report::{CommitReport, Evaluations};
use crate::motion::state::mesh::Mesh;

/// With each doubling of what sites and cells take beyond [`NEAR_BYTES`] repair and placement take longer by this share
/// of what they do where caches hold all, beside rebuilding, which reads them in order.
const SLOWER_PER_DOUBLING: f64 = 0.11;

/// Bytes of sites and cells below which that makes no difference.
const NEAR_BYTES: f64 = (4 << 20) as f64;

/// Whether to give up placing is asked once this share of what a rebuild costs has been spent.
const MIN_SHARE_SPENT: f64 = 1.0 / 16.0;

impl<G: Dimension> Mesh<G> {
    /// By what factor a task grows beside rebuilding, compared with a small triangulation: where caches do not hold all.
    /// How many threads there are is left out: the ways that are taken, and so the order of cells, may not depend on it.
    pub(in crate::motion) fn slowdown(&self) -> f64 {
        1.0 + SLOWER_PER_DOUBLING * doublings(self.kernel.bytes_read() as f64 / NEAR_BYTES)
    }
}

/// The logarithm of a number above 1 to base 2, nearly, by operations that are the same everywhere: straight between powers
/// of two; 0 up to 1.
fn doublings(x: f64) -> f64 {
    let (mut rest, mut doublings) = (x, 0.0);
    while rest >= 2.0 {
        (rest, doublings) = (0.5 * rest, doublings + 1.0);
    }
    doublings + (rest - 1.0).max(0.0)
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
