//! Whether a repair is going to take longer than a rebuild, or than to place the vertices that have moved, as far as
//! that can be told before.
//!
//! | when | from what |
//! |---|---|
//! | before the sweep | facets that fail and exact evaluations in a sample of the cells |
//! | after it | those of all cells |
//! | while vertices are placed | what those placed so far have cost |
//!
//! On random points a repair takes as long as a rebuild where about every sixth facet in space, or every seventh in the
//! plane, fails: more and more cells are inverted, and vertices have to be placed, then. It may be every third, or
//! every fifth, where hardly a cell is inverted, or there are ties and flips untangle the cells. Both come sooner where
//! caches do not hold all, and where several threads rebuild, as one of them does much of a repair. All that holds if
//! what fails is in many small clusters of cells, as in the cubes of a lattice. In large ones, of hundreds of vertices
//! nearly on a sphere, flips get stuck, or evaluate the certificates of a cluster again and again: then a repair takes
//! longer when one facet in seventy fails. So some clusters are gathered.
//!
//! Where some vertices leave a lattice, or leap, nearly all of their facets fail. Most of these vertices would have to
//! be placed in the end: they are placed at once.
//!
//! A vertex on a flat part of the hull may have a star of slivers with all others there. How long it takes to place
//! some of these is known only from the first ones.

use crate::delaunay::{Failures, Joint, Moving};
use crate::error::Result;
use crate::motion::plan::budget::REPAIRED_ALONE;
use crate::motion::state::repair::Repair;
use crate::motion::triangulation::MovingTriangulation;
use crate::motion::ways::repair::Prospect;
use crate::predicates::exact_calls;

/// There are ties where a sweep evaluates more than this number of signs exactly for each finite cell. (Random points
/// need none, those of a sheared lattice about one.)
const EXACT_OF_TIES: f64 = 0.1;

/// How many times the limit a sample has to find to be believed: about the error of a small one.
const SAMPLE_MARGIN: f64 = 1.25;

/// What a sweep finds, or is going to find.
#[derive(Clone, Copy, Debug)]
struct Findings {
    /// Facets that fail.
    failing: f64,
    /// Cells that are not positive.
    inverted: f64,
    /// Exact evaluations.
    exact: f64,
}

impl Findings {
    fn of(failures: &Failures, exact: u64, weight: f64) -> Self {
        let (facets, cells) = (failures.facets.len(), failures.cells.len());
        Findings {
            failing: weight * facets as f64,
            inverted: weight * cells as f64,
            exact: weight * exact as f64,
        }
    }

    fn all_failing(self) -> f64 {
        self.failing + self.inverted
    }

    /// Whether many of the vertices of this number of cells are cospherical, or in a plane.
    fn have_ties(self, n_cells: f64) -> bool {
        self.exact > EXACT_OF_TIES * n_cells
    }
}

impl<G: Moving> MovingTriangulation<G> {
    /// Sweeps all cells, of which `most` may fail, unless a sample shows what to do.
    pub(super) fn sweep(&mut self, repair: &mut Repair, most: usize) -> Result<Prospect> {
        let has_rest = 4 * repair.places.n_new <= 3 * self.mesh.n_present;
        let origins = self.mesh.transaction.origins();
        let before = (has_rest && origins.are_of_all()).then_some(origins.positions());
        let n_cells = self.mesh.kernel.complex().n_finite() as f64;
        repair.was_foreseen = true;
        let start = exact_calls();
        if let Some(slots) = self.mesh.kernel.sample(&mut repair.failures, before)? {
            // A sample may err: it decides where it is far from the limit.
            let weight = slots as f64 / SAMPLE_MARGIN;
            let found = Findings::of(&repair.failures, exact_calls() - start, weight);
            match self.prospect(found, repair) {
                Prospect::Mendable => {
                    let inverted =
                        repair.failures.cells.iter().filter(|&&c| self.leaper(repair, c).is_none());
                    let inverted = weight * inverted.count() as f64;
                    if !self.is_worth_untangling(Findings { inverted, ..found }) {
                        return Ok(Prospect::TooMuch);
                    }
                }
                Prospect::TooMuch => return Ok(Prospect::TooMuch),
                Prospect::Placeable => {
                    repair.note_findings(found, n_cells);
                    return Ok(Prospect::Placeable);
                }
            }
        }
        let start = exact_calls();
        let most = repair.limit.map_or(most, |limit| most.min((limit * n_cells) as usize));
        let origins = self.mesh.transaction.origins();
        let before = (has_rest && origins.are_of_all()).then_some(origins.positions());
        let is_done = self.mesh.kernel.sweep(&mut repair.failures, most, before)?;
        let found = Findings::of(&repair.failures, exact_calls() - start, 1.0);
        let prospect = self.prospect(found, repair);
        if is_done || prospect == Prospect::Placeable {
            repair.note_findings(found, n_cells);
        } else {
            return Ok(Prospect::TooMuch);
        }
        repair.was_foreseen = prospect == Prospect::TooMuch;
        Ok(prospect)
    }

    /// What to do about these findings.
    fn prospect(&mut self, found: Findings, repair: &Repair) -> Prospect {
        let constants = self.mesh.constants;
        let (n, n_moved) = (self.mesh.n_present as f64, repair.places.n_new as f64);
        let n_cells = self.mesh.kernel.complex().n_finite() as f64;
        if repair.limit.is_some_and(|limit| found.all_failing() > limit * n_cells) {
            return Prospect::TooMuch;
        }
        let are_few =
            self.mesh.slowdown(1.0) * n_moved * constants.costs.placed < n * constants.costs.rebuilt;
        if are_few && found.all_failing() > constants.failures_per_moved * n_moved {
            return Prospect::Placeable;
        }
        if found.failing > constants.max_failing * n_cells {
            return Prospect::TooMuch;
        }
        if found.failing <= constants.max_failing_of_large * n_cells {
            return Prospect::Mendable;
        }
        let joint = if found.have_ties(n_cells) { Joint::Uncertain } else { Joint::Failing };
        let is_large =
            self.mesh.kernel.mean_cluster(&repair.failures.facets, joint) > constants.cells_of_large;
        if is_large { Prospect::TooMuch } else { Prospect::Mendable }
    }

    /// Whether mending takes less than a rebuild, where these cells are inverted still once leaping vertices are back.
    fn is_worth_untangling(&self, found: Findings) -> bool {
        let constants = self.mesh.constants;
        let n_cells = self.mesh.kernel.complex().n_finite() as f64;
        let failing = found.failing + constants.failing_for_inverted * found.inverted;
        let most = constants.max_failing_with_inverted / self.mesh.slowdown(REPAIRED_ALONE);
        found.have_ties(n_cells) || failing <= most * n_cells
    }

    /// Whether mending takes less than a rebuild, where a sweep has found this number of failing facets, and leaping
    /// vertices are back.
    pub(super) fn is_worth_going_on(&self, repair: &mut Repair, n_failing: usize) -> bool {
        let (inverted, exact) = (repair.failures.cells.len() as f64, repair.exact as f64);
        let is_worth = self.is_worth_untangling(Findings { failing: n_failing as f64, inverted, exact });
        repair.was_foreseen = !is_worth;
        is_worth
    }
}

impl Repair {
    fn note_findings(&mut self, found: Findings, n_cells: f64) {
        self.exact = found.exact as u64;
        self.share_failing = found.all_failing() / n_cells;
        self.was_foreseen = false;
    }
}

#[cfg(test)]
mod tests {
    use crate::delaunay::{Level, Moving, Plane, Space};
    use crate::motion::algorithms::Algorithm;
    use crate::motion::options::Options;
    use crate::motion::triangulation::MovingTriangulation;
    use crate::random::Rng;

    fn random<G: Moving>(n: usize, threads: u32, rng: &mut Rng) -> (MovingTriangulation<G>, Vec<G::Point>) {
        let side = (n as f64).powf(1.0 / G::D as f64);
        let mut points = vec![G::Point::default(); n];
        points.iter_mut().for_each(|p| (0..G::D).for_each(|axis| p[axis] = side * rng.unit()));
        let options = Options { algorithm: Algorithm::Repair, threads, ..Options::default() };
        (MovingTriangulation::new(&points, options).expect("room"), points)
    }

    /// How many of five commits, in which all vertices go up to this far along each axis, are rebuilt.
    fn n_rebuilt<G: Moving>(reach: f64) -> u64 {
        let rng = &mut Rng::new(1);
        let (mut t, mut points) = random::<G>(3_000, 1, rng);
        let mut n_rebuilt = 0;
        for _ in 0..5 {
            for p in &mut points {
                (0..G::D).for_each(|axis| p[axis] += 2.0 * reach * (rng.unit() - 0.5));
            }
            n_rebuilt += t.commit_positions(&points).expect("room").rebuilds;
            assert_eq!(t.validate(Level::Delaunay), Ok(()));
        }
        n_rebuilt
    }

    #[test]
    fn what_takes_longer_than_a_rebuild_is_rebuilt() {
        assert_eq!([0.2, 0.4].map(n_rebuilt::<Plane>), [0, 5]);
        assert_eq!([0.08, 0.2].map(n_rebuilt::<Space>), [0, 5]);
    }

    /// While a lattice trembles, about half the squares change their diagonals at each timestamp, and some cells at the
    /// hull are inverted.
    #[test]
    fn trembling_lattices_are_repaired() {
        let rng = &mut Rng::new(1);
        let rest: Vec<[f64; 2]> = (0..10_000).map(|v| [v % 100, v / 100].map(f64::from)).collect();
        let options = Options { algorithm: Algorithm::Auto, threads: 1, ..Options::default() };
        let mut t = MovingTriangulation::<Plane>::new(&rest, options).expect("room");
        let mut rebuilds = Vec::new();
        for _ in 0..6 {
            let now: Vec<_> = rest.iter().map(|p| p.map(|x| x + 0.02 * (rng.unit() - 0.5))).collect();
            let report = t.commit_positions(&now).expect("room");
            rebuilds.push(report.rebuilds);
            assert!(report.rebuilds > 0 || report.flips > 4_000, "{report:?}");
            assert_eq!(t.validate(Level::Delaunay), Ok(()));
        }
        // The first commit may be rebuilt: it begins with the lattice itself, all sides of which change.
        assert_eq!(rebuilds[1..], [0; 5]);
    }

    /// Rebuilding gains by threads and by order.
    #[test]
    fn repair_is_slower_beside_several_threads_and_where_caches_do_not_hold_all() {
        let rng = &mut Rng::new(1);
        let slowdowns = |n, threads, rng: &mut Rng| {
            let (t, _) = random::<Plane>(n, threads, rng);
            [0.0, 0.3, 1.0].map(|alone| t.mesh.slowdown(alone))
        };
        let few = slowdowns(2_000, 1, rng);
        assert_eq!(few, [1.0; 3]);
        let many = slowdowns(80_000, 1, rng);
        assert!(many[0] > 1.0 && many == [many[0]; 3], "{many:?}");
        if std::thread::available_parallelism().is_ok_and(|n| n.get() > 1) {
            let [none, some, all] = slowdowns(80_000, 2, rng);
            assert!(none < many[0] && many[0] < some && some < all, "{none} {some} {all}");
        }
    }
}
