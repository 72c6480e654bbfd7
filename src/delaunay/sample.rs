//! Certificates of a few cells, from which follows what a sweep of all would find; and how many cells that are to be
//! flipped hang together.

use super::{Delaunay, Failures, Geometry};
use crate::complex::{Corners, Facet};
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

/// Clusters that are gathered, and how many cells of each at most: together they cost as much as a dozen placements.
const CLUSTERS: usize = 16;
const MAX_CLUSTER: usize = 16;

/// What joins the cells of a cluster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Joint {
    /// A facet that fails.
    Failing,
    /// A facet that fails, or that the first stage does not decide.
    Uncertain,
}

impl<G: Geometry> Delaunay<G> {
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
        self.visit_uncertain(cells, |c, doubts| {
            if !self.complex.cell(c).is_ghost() {
                sampled = self.sweep_cell(c, doubts, before, failures).map(|_| ());
            }
            sampled.is_ok()
        });
        self.certificates += (n_runs * RUN * (G::D + 3) / 2) as u64;
        sampled.map(|()| Some(distance / RUN))
    }

    /// How many cells hang together by such facets, from some of these failing ones on: the mean of as many as are
    /// gathered. 0 if there are none.
    pub(crate) fn mean_cluster(&mut self, failing: &[Facet], joint: Joint) -> f64 {
        let step = failing.len().div_ceil(CLUSTERS).max(1);
        let (mut n_cells, mut n_clusters) = (0, 0);
        for &facet in failing.iter().step_by(step) {
            n_cells += self.cluster_size(facet, joint);
            n_clusters += 1;
        }
        n_cells as f64 / f64::from(n_clusters.max(1))
    }

    /// How many positive cells hang together with that of a failing facet, which is positive.
    fn cluster_size(&mut self, facet: Facet, joint: Joint) -> usize {
        let mut cells = [facet.cell(); MAX_CLUSTER];
        let (mut n, mut n_left) = (1, 0);
        while n_left < n {
            let c = cells[n_left];
            n_left += 1;
            for facet in (0..G::Corners::N).map(|i| Facet::new(c, i)) {
                let next = self.complex.cell(c).neighbour(facet.index()).cell();
                if cells[..n].contains(&next) || self.complex.cell(next).is_ghost() || !self.is_positive(next)
                {
                    continue;
                }
                self.certificates += 1;
                let is_joined = match joint {
                    Joint::Failing => !self.is_locally_delaunay(facet),
                    Joint::Uncertain => !G::bicell_holds(&self.filter, self.view(), &self.complex, facet),
                };
                if is_joined {
                    cells[n] = next;
                    n += 1;
                    if n == MAX_CLUSTER {
                        return n;
                    }
                }
            }
        }
        n
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::Space;
    use crate::random::Rng;

    /// The mean cluster of both kinds when these points, built before, are sheared.
    fn clusters_of_sheared(points: &[[f64; 3]]) -> [f64; 2] {
        let mut t = Delaunay::<Space>::default();
        t.add_sites(points).expect("room for it");
        t.rebuild(&mut |_| true).expect("room for it");
        for s in t.live_sites().collect::<Vec<_>>() {
            let [x, y, z] = t.site(s).point;
            let q = [x + 1e-3 * y, y, z];
            t.cover(&q, &q);
            t.set_point(s, q);
        }
        let mut failures = Failures::default();
        assert!(t.sweep(&mut failures, usize::MAX, None).expect("room for it"));
        assert!(failures.facets.len() > 1000, "{}", failures.facets.len());
        [Joint::Failing, Joint::Uncertain].map(|joint| t.mean_cluster(&failures.facets, joint))
    }

    #[test]
    fn clusters_are_as_large_as_what_is_cospherical() {
        let cube = |i: usize| [i % 14, i / 14 % 14, i / 196].map(|x| x as f64);
        let lattice: Vec<_> = (0..14 * 14 * 14).map(cube).collect();
        let [failing, uncertain] = clusters_of_sheared(&lattice);
        // The cells of a cube are five or six, those next to its facets apart.
        assert!((2.0..7.0).contains(&failing) && (2.0..7.0).contains(&uncertain), "{failing}, {uncertain}");

        let rng = &mut Rng::new(1);
        let mut direction = || loop {
            let p = [(); 3].map(|()| 2.0 * rng.unit() - 1.0);
            let length = p.map(|x| x * x).iter().sum::<f64>().sqrt();
            if (0.1..1.0).contains(&length) {
                return p.map(|x| x / length);
            }
        };
        let sphere: Vec<_> = (0..2000).map(|_| direction()).collect();
        let [failing, uncertain] = clusters_of_sheared(&sphere);
        assert!(failing > 7.0 && uncertain > 7.0, "{failing}, {uncertain}");

        let mut t = Delaunay::<Space>::default();
        t.add_sites(&sphere[..4]).expect("room for it");
        assert!(t.mean_cluster(&[], Joint::Failing) == 0.0);
    }
}
