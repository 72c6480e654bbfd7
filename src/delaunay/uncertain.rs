//! The cells of which not all certificates surely hold, found four cells at a time, in lanes.
//!
//! Nearly all cells hold after a motion. They are taken in blocks: first the sites beyond the facets of all
//! cells of a block are looked up, then the certificates of four cells are evaluated together. The loads of
//! the first step do not depend on each other, so that the processor waits for many at once. All facets are
//! tested, from both sides.
//!
//! The static bound is that of the whole triangulation, and says nothing of cells that are much smaller than others
//! are. Where it has said nothing of nearly all cells of a block, the next block is evaluated with bounds of its cells'
//! own, which takes a seventh longer, until the static bound would do for most of a block.

use super::lane_tests::Held;
use super::{Delaunay, Geometry};
use crate::complex::{Corners, INFINITE};
use crate::ids::{SiteId, Slot};
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::simd::{ALL, LANES, Lanes, Simd};

/// Most cells of a block of many cells, by lane.
const MANY: usize = 64 / LANES;
/// Most cells of a block for a star, by lane: as many as most stars in space have.
const STAR: usize = 32 / LANES;

/// Certificates of a cell that do not surely hold.
#[derive(Clone, Copy, Debug)]
pub(super) struct Doubts(u8);

impl Doubts {
    const ORIENTATION: usize = 4;
    /// Nothing is known.
    pub(super) const ALL: Doubts = Doubts(0x1f);

    /// What does not surely hold of the cell in a lane.
    #[inline(always)]
    fn of<L: Lanes>(held: &Held<L>, lane: u32) -> Doubts {
        let doubt = |of: L, at: usize| ((!of.bits() >> lane & 1) as u8) << at;
        let facets = held.facets.iter().enumerate().map(|(i, &facet)| doubt(facet, i));
        Doubts(doubt(held.positive, Doubts::ORIENTATION) | facets.sum::<u8>())
    }

    /// Whether the cell may not be positively oriented.
    #[inline(always)]
    pub(super) fn concern_orientation(self) -> bool {
        self.concern_facet(Self::ORIENTATION)
    }

    /// Whether the site beyond the facet opposite a corner may be inside the sphere.
    #[inline(always)]
    pub(super) fn concern_facet(self, i: usize) -> bool {
        self.0 >> i & 1 == 1
    }
}

/// Finite cells, by lane.
struct Block<const N: usize> {
    n: usize,
    cells: [[Slot; LANES]; N],
    /// Sites beyond the facets opposite each corner.
    apexes: [[[SiteId; LANES]; N]; 4],
}

impl<const N: usize> Block<N> {
    fn new() -> Self {
        Block { n: 0, cells: [[Slot::new(0); LANES]; N], apexes: [[[INFINITE; LANES]; N]; 4] }
    }
}

impl<G: Geometry> Delaunay<G> {
    /// Does what [`visit_uncertain`](Self::visit_uncertain) does, in lanes. `IS_FAR` if the cells are too many to stay
    /// in a cache near the processor: then neighbours and sites are asked for in advance, which would only cost time
    /// otherwise.
    #[inline(always)]
    pub(super) fn visit_uncertain_in_lanes<S: Simd, const IS_FAR: bool>(
        &self,
        simd: S,
        cells: impl Iterator<Item = Slot> + Clone,
        visit: impl FnMut(Slot, Doubts) -> bool,
    ) {
        self.visit_uncertain_in_blocks::<_, IS_FAR, MANY>(simd, cells, visit);
    }

    /// Whether all certificates of the cells of a star in space surely hold: not if there are ghosts among them. By
    /// blocks as large as most stars, as to make one takes the longer the larger it is.
    #[inline(always)]
    pub(super) fn star_holds_in_lanes<S: Simd>(&self, simd: S, star: &[(Slot, u8)]) -> bool {
        let mut holds = true;
        self.visit_uncertain_in_blocks::<_, false, STAR>(simd, star.iter().map(|&(c, _)| c), |_, _| {
            holds = false;
            false
        });
        holds
    }

    /// Visits uncertain cells, looking at blocks of `N` times as many cells as there are lanes.
    #[inline(always)]
    fn visit_uncertain_in_blocks<S: Simd, const IS_FAR: bool, const N: usize>(
        &self,
        simd: S,
        mut cells: impl Iterator<Item = Slot> + Clone,
        mut visit: impl FnMut(Slot, Doubts) -> bool,
    ) {
        let mut ahead = cells.clone().skip(AHEAD);
        let mut block = Block::<N>::new();
        let mut has_own_bounds = false;
        let (filter, sites) = (&self.filter, self.view());
        loop {
            block.n = 0;
            while block.n < N * LANES {
                let Some(c) = cells.next() else { break };
                if IS_FAR && let Some(next) = ahead.next() {
                    self.complex.prefetch_neighbours(next);
                }
                let cell = self.complex.cell(c);
                if self.complex.is_free(c) {
                    continue;
                }
                if cell.is_ghost() {
                    if !visit(c, Doubts::ALL) {
                        return;
                    }
                    continue;
                }
                block.cells.as_flattened_mut()[block.n] = c;
                for (i, apexes) in block.apexes[..G::Corners::N].iter_mut().enumerate() {
                    let apex = self.complex.apex(cell.neighbour(i));
                    apexes.as_flattened_mut()[block.n] = apex;
                    if IS_FAR {
                        prefetch(&self.sites, apex.index());
                    }
                }
                block.n += 1;
            }
            let Some(last) = block.n.checked_sub(1) else { return };
            // Any finite cells fill the last lanes.
            for k in block.n..block.n.next_multiple_of(LANES) {
                block.cells.as_flattened_mut()[k] = block.cells.as_flattened()[last];
            }
            // How many hold by the static bound.
            let mut n_hold = 0;
            for k in 0..block.n.div_ceil(LANES) {
                let apexes = block.apexes.each_ref().map(|a| &a[k]);
                let corners = block.cells[k].map(|c| &self.complex.cell(c).corners);
                let held = if has_own_bounds {
                    G::cells_hold::<_, true>(simd, filter, sites, corners, apexes)
                } else {
                    G::cells_hold::<_, false>(simd, filter, sites, corners, apexes)
                };
                n_hold += held.by_static_bounds.bits().count_ones() as usize;
                let n = (block.n - k * LANES).min(LANES);
                let mut open = !held.all::<G>() & (ALL >> (LANES - n));
                while open != 0 {
                    let lane = open.trailing_zeros();
                    if !visit(block.cells[k][lane as usize], Doubts::of(&held, lane)) {
                        return;
                    }
                    open &= open - 1;
                }
            }
            has_own_bounds = if has_own_bounds { 2 * n_hold < block.n } else { 8 * n_hold < block.n };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::complex::Facet;
    use crate::delaunay::lane_tests::LaneTests;
    use crate::delaunay::{Failures, Plane, Space};
    use crate::predicates;
    use crate::random::Rng;
    use crate::simd::in_lanes;

    fn point<G: Geometry>(mut coordinate: impl FnMut() -> f64) -> G::Point {
        let mut p = G::Point::default();
        (0..G::D).for_each(|k| p[k] = coordinate());
        p
    }

    /// Random points, points of a small grid, or points on a sphere, so that there are very many ghosts.
    fn points<G: Geometry>(kind: usize, n: usize, rng: &mut Rng) -> Vec<G::Point> {
        let mut points: Vec<G::Point> = (0..n)
            .map(|_| {
                point::<G>(|| if kind == 1 { (rng.unit() * 7.0).floor() } else { rng.unit() * 6.0 - 3.0 })
            })
            .collect();
        if kind == 2 {
            for p in &mut points {
                let length = p.as_ref().iter().map(|x| x * x).sum::<f64>().sqrt();
                (0..G::D).for_each(|k| p[k] /= length);
            }
        }
        points
    }

    /// Moves one site in every `one_in` by up to `size` along each axis.
    fn move_sites<G: Geometry>(t: &mut Delaunay<G>, one_in: f64, size: f64, rng: &mut Rng) {
        let (mut lower, mut upper) = (t.lower(), t.upper());
        for s in t.live_sites().collect::<Vec<_>>() {
            if rng.unit() * one_in < 1.0 {
                let mut q = t.site(s).point;
                for k in 0..G::D {
                    q[k] += size * (2.0 * rng.unit() - 1.0);
                    (lower[k], upper[k]) = (lower[k].min(q[k]), upper[k].max(q[k]));
                }
                t.set_point(s, q);
            }
        }
        t.cover(&lower, &upper);
    }

    /// What is found in the cells that this visits.
    fn failures<G: Geometry>(
        t: &Delaunay<G>,
        visit_uncertain: impl FnOnce(&mut dyn FnMut(Slot, Doubts) -> bool),
    ) -> (Vec<Slot>, Vec<Facet>, Vec<Slot>) {
        let mut failures = Failures::default();
        visit_uncertain(&mut |c, doubts| {
            t.sweep_cell(c, doubts, None, &mut failures).expect("room for it");
            true
        });
        (failures.cells, failures.facets, failures.ghosts)
    }

    /// Returns how many of each have failed, and how many cells there were to look at.
    fn agree<G: Geometry>(t: &Delaunay<G>, context: &str) -> [usize; 3] {
        let all = Slot::range(0..t.complex.n_slots());
        let expected = failures(t, |visit| t.complex.live().for_each(|c| assert!(visit(c, Doubts::ALL))));
        let found = failures(t, |visit| {
            in_lanes!(simd => t.visit_uncertain_in_lanes::<_, false>(simd, all.clone(), visit));
        });
        assert_eq!(found, expected, "{context}, near");
        let found = failures(t, |visit| {
            in_lanes!(simd => t.visit_uncertain_in_lanes::<_, true>(simd, all.clone(), visit));
        });
        assert_eq!(found, expected, "{context}, far");
        let mut n_open = 0;
        in_lanes!(simd => t.visit_uncertain_in_lanes::<_, false>(simd, all.clone(), |_, _| {
            n_open += 1;
            true
        }));
        [expected.0.len(), expected.1.len(), n_open - expected.2.len()]
    }

    /// All ways to find uncertain cells lead to the failures that a visit of all cells finds.
    fn all_agree<G: Geometry>() {
        let rng = &mut Rng::new(3);
        for kind in 0..3 {
            let mut total = [0; 3];
            for round in 0..40 {
                let mut t = Delaunay::<G>::default();
                let n = G::D + 1 + (rng.unit() * [20.0, 400.0][round % 2]) as usize;
                t.add_sites(&points::<G>(kind, n, rng)).expect("room for it");
                t.rebuild(&mut |_| true).expect("room for it");
                // Leaves free cells among the others.
                for s in t.live_sites().collect::<Vec<_>>() {
                    if rng.unit() < 0.05 && t.has_cells() {
                        t.remove_site(s).expect("room for it");
                    }
                }
                if round % 4 > 1 {
                    t.cover(&point::<G>(|| -1e4), &point::<G>(|| 1e4));
                }
                let mut n_failed = agree(&t, &format!("{n} points of kind {kind}, at rest"));
                assert_eq!(n_failed[..2], [0, 0]);
                for (one_in, size) in [(20.0, 0.01), (1.0, 1e-9), (20.0, 3.0), (1.0, 0.05), (1.0, 1.0)] {
                    move_sites(&mut t, one_in, size, rng);
                    let context = format!("{n} points of kind {kind}, moved by {size}");
                    let more = agree(&t, &context);
                    (0..3).for_each(|k| n_failed[k] += more[k]);
                }
                (0..3).for_each(|k| total[k] += n_failed[k]);
            }
            assert!(total[0] > 300 && total[1] > 300, "kind {kind}: {total:?}");
        }
    }

    #[test]
    fn uncertain_cells_agree() {
        all_agree::<Plane>();
        all_agree::<Space>();
    }

    /// A random triangulation at rest leaves almost nothing to check, so that finding the uncertain cells is worth it.
    /// Where the static bound says nothing, that is so from the second block on.
    #[test]
    fn cells_at_rest_pass() {
        fn n_open<G: Geometry>(reach: f64) -> usize {
            let mut t = Delaunay::<G>::default();
            t.add_sites(&points::<G>(0, 1000, &mut Rng::new(5))).expect("room for it");
            t.rebuild(&mut |_| true).expect("room for it");
            t.cover(&point::<G>(|| -reach), &point::<G>(|| reach));
            agree(&t, "at rest")[2]
        }
        assert_eq!([n_open::<Plane>(3.0), n_open::<Space>(3.0)], [0, 0]);
        assert_eq!([n_open::<Plane>(1e5), n_open::<Space>(1e5)], [MANY * LANES; 2]);
    }

    /// How many facets between finite cells hold, and for how many of these that is certain.
    fn certain_of<G: Geometry>(t: &Delaunay<G>, context: &str) -> [usize; 2] {
        let is_ghost = |facet: Facet| t.complex.cell(facet.cell()).is_ghost();
        let across = |facet: Facet| t.complex.cell(facet.cell()).neighbour(facet.index());
        let facets = t.complex.live().flat_map(|c| (0..G::Corners::N).map(move |i| Facet::new(c, i)));
        let interior: Vec<Facet> = facets.filter(|&f| !is_ghost(f) && !is_ghost(across(f))).collect();
        let mut n = [0; 2];
        for four in interior.as_chunks::<LANES>().0 {
            let certain = in_lanes!(simd => G::facets_hold(simd, &t.filter, t.view(), &t.complex, four));
            for (k, &facet) in four.iter().enumerate() {
                let are_positive = t.is_positive(facet.cell()) && t.is_positive(across(facet).cell());
                let holds = are_positive && t.is_locally_delaunay(facet);
                let is_certain = certain >> k & 1 == 1;
                assert!(holds || !is_certain, "{context}: {facet:?}");
                n[0] += usize::from(holds);
                n[1] += usize::from(is_certain);
            }
        }
        n
    }

    /// What is said of facets is so, and almost nothing that is so is left unsaid, also where the cells are so small
    /// next to all that a bound for all says nothing.
    fn facets_are_certain<G: Geometry>() {
        let rng = &mut Rng::new(11);
        let mut n_failed = 0;
        for round in 0..40 {
            // Scaled so, the points of the grid are next to cocircular, or cospherical, by rounding.
            let (kind, scale) = [(0, 1.0), (0, 1e-9), (1, 0.1), (1, 1e-9)][round % 4];
            let mut points = points::<G>(kind, 300, rng);
            points.iter_mut().for_each(|p| (0..G::D).for_each(|k| p[k] *= scale));
            let mut t = Delaunay::<G>::default();
            t.add_sites(&points).expect("room for it");
            t.rebuild(&mut |_| true).expect("room for it");
            t.cover(&point::<G>(|| -1e3), &point::<G>(|| 1e3));
            let [n, n_certain] = certain_of(&t, "at rest");
            assert!(kind == 1 || 1000 * n_certain > 995 * n, "{n_certain} of {n}, scale {scale}");
            for size in [1e-16, 1e-9, 0.05, 1.0] {
                move_sites(&mut t, 1.0, scale * size, rng);
                n_failed += n - certain_of(&t, &format!("moved by {size}"))[0];
            }
        }
        assert!(n_failed > 1000, "{n_failed}");
    }

    #[test]
    fn certain_facets_hold() {
        facets_are_certain::<Plane>();
        facets_are_certain::<Space>();
    }

    /// No site inside a sphere or on it is dropped, and nearly all outside are; those not in the set stay out of it.
    #[test]
    fn sites_outside_are_dropped() {
        let rng = &mut Rng::new(13);
        let (mut n_outside, mut n_dropped) = (0, 0);
        for round in 0..60 {
            let mut t = Delaunay::<Space>::default();
            let n = 5 + (rng.unit() * 59.0) as usize;
            t.add_sites(&points::<Space>(round % 2, n, rng)).expect("room for it");
            t.rebuild(&mut |_| true).expect("room for it");
            let sites: Vec<SiteId> = t.live_sites().collect();
            for c in t.complex.finite().take(20) {
                let corners = t.complex.cell(c).corners;
                let any = (rng.unit() * 2f64.powi(53)) as u64 * 2048 + (rng.unit() * 2048.0) as u64;
                let set = any & (u64::MAX >> (64 - sites.len()));
                let left = Space::drop_outside(&t.filter, t.view(), &corners, &sites, set);
                assert_eq!(left & !set, 0);
                for (k, &s) in sites.iter().enumerate().filter(|&(k, _)| set >> k & 1 == 1) {
                    let site = t.site(s);
                    let [a, b, c, d] = corners.map(|s| t.place(s));
                    let is_outside = predicates::insphere(&t.filter, a, b, c, d, &site.point) < 0.0;
                    let is_dropped = left >> k & 1 == 0;
                    assert!(is_outside || !is_dropped);
                    n_outside += usize::from(is_outside);
                    n_dropped += usize::from(is_dropped);
                }
            }
        }
        assert!(n_outside > 10_000 && 1000 * n_dropped > 999 * n_outside, "{n_dropped} of {n_outside}");
    }

    /// No cell is visited after a visit that wants no more.
    #[test]
    fn visits_end() {
        let mut t = Delaunay::<Plane>::default();
        t.add_sites(&points::<Plane>(0, 500, &mut Rng::new(7))).expect("room for it");
        t.rebuild(&mut |_| true).expect("room for it");
        move_sites(&mut t, 1.0, 1.0, &mut Rng::new(9));
        for most in [1, 2, 5, 100] {
            let mut n = 0;
            let all = Slot::range(0..t.complex.n_slots());
            t.visit_uncertain(all, |_, _| {
                n += 1;
                n < most
            });
            assert_eq!(n, most);
        }
    }
}
