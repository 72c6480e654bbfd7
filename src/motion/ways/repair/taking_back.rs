//! Which vertices a repair takes back to their old places, to be placed.

use crate::complex::{Corners, INFINITE};
use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::prefetch;
use crate::motion::state::places::At;
use crate::motion::state::repair::Repair;
use crate::motion::triangulation::MovingTriangulation;
use crate::motion::ways::repair::Prospect;
use crate::predicates::squared_distance;

/// Cells between those of which one thing and the next are asked for.
const STEP: usize = 8;

impl<G: Moving> MovingTriangulation<G> {
    /// Takes the vertices of inverted cells back that have gone farther than the cell reaches: they have left their
    /// stars, and would have to be placed after much untangling. Too much if more than `most` are back.
    pub(super) fn take_leapers_back(&mut self, repair: &mut Repair, most: usize) -> Result<Prospect> {
        let is_far = self.mesh.kernel.is_far();
        for k in 0..repair.failures.cells.len() {
            if is_far {
                self.prefetch_old_places(&repair.failures.cells, k);
            }
            if let Some(s) = self.leaper(repair, repair.failures.cells[k]) {
                self.take_back(repair, s)?;
                if repair.places.queue.len() > most {
                    return Ok(Prospect::TooMuch);
                }
            }
        }
        if !repair.places.queue.is_empty() {
            let cells = &mut repair.failures.cells;
            cells.retain(|&c| !self.mesh.kernel.is_positive(c));
            cells.sort_unstable();
            cells.dedup();
        }
        Ok(Prospect::Mendable)
    }

    /// The corner of a cell that has gone farthest, if that is farther than the cell reaches.
    pub(super) fn leaper(&self, repair: &Repair, c: Slot) -> Option<SiteId> {
        let corners = self.mesh.kernel.complex().cell(c).corners;
        let s = self.farthest(repair, corners.as_ref())?;
        let site = self.mesh.kernel.site(s);
        let old = self.mesh.transaction.origins().of(site.id);
        let gone = squared_distance(&site.point, old);
        let mut others = corners.as_ref().iter().filter(|&&other| other != s);
        others.all(|&other| squared_distance(self.mesh.kernel.place(other), old) < gone).then_some(s)
    }

    /// Asks for where the corners of the listed cells after the `k`-th one are, and have been.
    #[inline(always)]
    fn prefetch_old_places(&self, cells: &[Slot], k: usize) {
        let complex = self.mesh.kernel.complex();
        if let Some(&c) = cells.get(k + 3 * STEP) {
            complex.prefetch(c);
        }
        if let Some(&c) = cells.get(k + 2 * STEP) {
            self.mesh.kernel.prefetch_corners(c);
        }
        if let Some(&c) = cells.get(k + STEP) {
            for &s in complex.cell(c).corners.as_ref() {
                prefetch(self.mesh.transaction.origins().positions(), self.mesh.kernel.site(s).id.index());
            }
        }
    }

    /// Takes vertices back until every cell is positive and the hull convex; too much if more than `most` are back.
    pub(super) fn take_back_failed(&mut self, repair: &mut Repair, most: usize) -> Result<Prospect> {
        self.check_taken_back(repair)?;
        loop {
            while let Some(c) = repair.failures.cells.pop() {
                if self.mesh.kernel.is_positive(c) {
                    continue;
                }
                let corners = self.mesh.kernel.complex().cell(c).corners;
                let s = self.farthest(repair, corners.as_ref()).expect("old places have positive cells");
                repair.failures.cells.push(c);
                self.take_back(repair, s)?;
                if repair.places.queue.len() > most {
                    return Ok(Prospect::TooMuch);
                }
            }
            self.check_ridges(repair)?;
            if repair.failures.ridges.is_empty() {
                return Ok(Prospect::Mendable);
            }
            while let Some(ridge) = repair.failures.ridges.pop() {
                if self.mesh.kernel.is_convex(ridge) {
                    continue;
                }
                let complex = self.mesh.kernel.complex();
                let across = complex.cell(ridge.cell()).neighbour(ridge.index());
                let behind = complex.cell(ridge.cell()).neighbour(G::D).cell();
                // The last corner of a ghost cell is the ghost vertex. The cell behind decides ties.
                let mut corners = [INFINITE; 5];
                corners[..G::Corners::N].copy_from_slice(complex.cell(behind).corners.as_ref());
                corners[4] = complex.apex(across);
                let s = self.farthest(repair, &corners).expect("old places have a convex hull");
                repair.failures.ridges.push(ridge);
                self.take_back(repair, s)?;
                if repair.places.queue.len() > most {
                    return Ok(Prospect::TooMuch);
                }
                if !repair.failures.cells.is_empty() {
                    break;
                }
            }
        }
    }

    /// Lists the ridges of the hull that are not convex.
    pub(super) fn check_ridges(&self, repair: &mut Repair) -> Result<()> {
        let (at, origins) = (&repair.places.at, self.mesh.transaction.origins());
        let before = |id: VertexId| matches!(at[id], At::New | At::Listed).then(|| origins.of(id));
        self.mesh.kernel.check_ridges(&mut repair.failures, before)
    }

    /// Lists a vertex of each facet where flips are stuck.
    pub(super) fn list_stuck(&mut self, repair: &mut Repair) -> Result<()> {
        repair.sites.clear();
        memory::reserve(&mut repair.sites, repair.stuck.len())?;
        for k in 0..repair.stuck.len() {
            let facet = repair.stuck[k];
            let complex = self.mesh.kernel.complex();
            debug_assert!(!complex.is_free(facet.cell()), "what is stuck is of a cell that is there");
            let across = complex.cell(facet.cell()).neighbour(facet.index());
            let mut corners = [INFINITE; 5];
            corners[..G::Corners::N].copy_from_slice(complex.cell(facet.cell()).corners.as_ref());
            corners[4] = complex.apex(across);
            let is_listed =
                |&s: &SiteId| s != INFINITE && repair.places.at[self.mesh.kernel.site(s).id] == At::Listed;
            if corners.iter().any(is_listed) {
                continue;
            }
            if let Some(s) = self.farthest(repair, &corners) {
                repair.sites.push(s);
                repair.places.at[self.mesh.kernel.site(s).id] = At::Listed;
            }
        }
        Ok(())
    }

    /// Takes the listed vertices back.
    pub(super) fn take_back_listed(&mut self, repair: &mut Repair) -> Result<()> {
        let sites = std::mem::take(&mut repair.sites);
        let taken = sites.iter().try_for_each(|&s| self.take_back(repair, s));
        repair.sites = sites;
        taken
    }

    /// Takes all vertices back, so that the cells are those before.
    pub(super) fn take_all_back(&mut self, repair: &mut Repair) -> Result<()> {
        let Repair { places, .. } = repair;
        memory::reserve(&mut places.queue, places.n_new)?;
        let first = places.queue.len();
        let origins = self.mesh.transaction.origins();
        places.list_new(&self.mesh.kernel, origins, &self.mesh.site_of)?;
        for &v in &places.queue[first..] {
            self.mesh.kernel.set_point(self.mesh.site_of[v], *origins.of(v));
            places.at[v] = At::Old;
        }
        places.n_new = 0;
        Ok(())
    }

    /// Takes a vertex back to its old place, and looks at its star.
    pub(super) fn take_back(&mut self, repair: &mut Repair, s: SiteId) -> Result<()> {
        repair.places.take_back(&mut self.mesh.kernel, self.mesh.transaction.origins(), s)?;
        self.mesh.kernel.check_star(s, &mut repair.failures)
    }

    /// Looks at the stars of the vertices that were taken back while cells were exchanged, once that has been undone.
    pub(super) fn check_taken_back(&mut self, repair: &mut Repair) -> Result<()> {
        let Repair { places, failures, .. } = repair;
        for k in std::mem::take(&mut places.unchecked) {
            self.mesh.kernel.check_star(self.mesh.site_of[places.queue[k]], failures)?;
        }
        Ok(())
    }

    /// Of these sites, the one that has moved farthest and is at its new place.
    pub(super) fn farthest(&self, repair: &Repair, sites: &[SiteId]) -> Option<SiteId> {
        repair.places.farthest(&self.mesh.kernel, self.mesh.transaction.origins(), sites)
    }
}

#[cfg(test)]
mod tests {
    use crate::delaunay::{Level, Moving, Plane, Space};
    use crate::motion::algorithms::Algorithm;
    use crate::motion::options::Options;
    use crate::motion::triangulation::MovingTriangulation;
    use crate::random::Rng;

    const N: usize = 3_000;

    /// A triangulation of random points a spacing apart, repaired; these points, and the side of their box.
    fn repaired<G: Moving>(rng: &mut Rng) -> (MovingTriangulation<G>, Vec<G::Point>, f64) {
        let side = (N as f64).powf(1.0 / G::D as f64);
        let mut points = vec![G::Point::default(); N];
        points.iter_mut().for_each(|p| leap::<G>(p, side, rng));
        let options = Options { algorithm: Algorithm::Repair, threads: 1, ..Options::default() };
        (MovingTriangulation::new(&points, options).expect("room"), points, side)
    }

    fn leap<G: Moving>(p: &mut G::Point, side: f64, rng: &mut Rng) {
        (0..G::D).for_each(|axis| p[axis] = side * rng.unit());
    }

    /// Vertices that leap anywhere while all others move are placed, and not much else: nothing is rebuilt.
    fn leapers_are_placed<G: Moving>() {
        let rng = &mut Rng::new(2);
        let (mut t, mut now, side) = repaired::<G>(rng);
        for _ in 0..10 {
            let mut n_leaps = 0;
            for p in &mut now {
                (0..G::D).for_each(|axis| p[axis] += 0.02 * (rng.unit() - 0.5));
                if rng.unit() < 0.03 {
                    leap::<G>(p, side, rng);
                    n_leaps += 1;
                }
            }
            let report = t.commit_positions(&now).expect("room");
            assert_eq!(report.rebuilds, 0, "{report:?} {n_leaps}");
            assert!((n_leaps * 9 / 10..n_leaps * 3 / 2).contains(&report.placements), "{report:?} {n_leaps}");
            assert_eq!(t.validate(Level::Delaunay), Ok(()));
        }
    }

    #[test]
    fn leapers_are_placed_in_the_plane() {
        leapers_are_placed::<Plane>();
    }

    #[test]
    fn leapers_are_placed_in_space() {
        leapers_are_placed::<Space>();
    }

    /// Where few of all positions given are others than before, only the cells around these vertices are looked at.
    fn few_that_move_need_no_sweep<G: Moving>() {
        let rng = &mut Rng::new(2);
        let (mut t, mut now, side) = repaired::<G>(rng);
        for _ in 0..5 {
            (0..10).for_each(|_| leap::<G>(&mut now[(N as f64 * rng.unit()) as usize], side, rng));
            let report = t.commit_positions(&now).expect("room");
            assert!((8..=10).contains(&report.moved) && report.rebuilds == 0, "{report:?}");
            assert!(report.certificates < 2 * N as u64, "{report:?}");
            assert_eq!(t.validate(Level::Delaunay), Ok(()));
        }
    }

    #[test]
    fn few_that_move_need_no_sweep_in_the_plane() {
        few_that_move_need_no_sweep::<Plane>();
    }

    #[test]
    fn few_that_move_need_no_sweep_in_space() {
        few_that_move_need_no_sweep::<Space>();
    }
}
