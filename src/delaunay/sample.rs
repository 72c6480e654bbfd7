//! Certificates of a few cells, from which follows what a sweep of all would find.

use super::{Delaunay, Dimension, Failures};
use crate::error::Result;
use crate::ids::Slot;

/// Slots next to each other that are sampled together: their neighbours and sites are near each other in memory.
const RUN: usize = 16;

/// One slot in this number is sampled, so that a sample costs less than a hundredth of a sweep, also where its runs
/// have to be fetched from memory: then a cell takes three times as long as in a sweep (40,000 random points in space).
const SLOTS_PER_SAMPLED: usize = 512;

/// Fewer runs say too little, and more say no more.
const MIN_RUNS: usize = 4;
const MAX_RUNS: usize = 256;

impl<G: Dimension> Delaunay<G> {
    /// Checks the certificates of some cells, in runs at equal distances in storage, as [`sweep`](Self::sweep) does
    /// those of all. Returns how many slots each stands for; `None`, and nothing listed, if there are too few cells.
    /// What is listed is of use for nothing but to be counted.
    pub(crate) fn sample(
        &mut self,
        failures: &mut Failures,
        before: Option<&[G::Point]>,
    ) -> Result<Option<usize>> {
        failures.clear();
        let n = self.complex.n_slots();
        let n_runs = (n / (SLOTS_PER_SAMPLED * RUN)).min(MAX_RUNS);
        if n_runs < MIN_RUNS {
            return Ok(None);
        }
        let distance = n / n_runs;
        let runs = (0..n_runs).map(|k| k * distance);
        let cells = runs.flat_map(|first| Slot::range(first..first + RUN));
        let mut sampled = Ok(());
        self.visit_uncertain(cells, |c| {
            if !self.complex.cell(c).is_ghost() {
                sampled = self.sweep_cell(c, before, failures).map(|_| ());
            }
            sampled.is_ok()
        });
        self.certificates += (n_runs * RUN * (G::D + 3) / 2) as u64;
        sampled.map(|()| Some(distance / RUN))
    }
}
