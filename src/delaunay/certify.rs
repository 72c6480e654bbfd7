//! Certificates of many cells at once, after sites have moved and before any cell has changed.
//!
//! Cells are a triangulation again if every finite one is positively oriented, the hull is convex at every ridge, and it
//! winds once: it is then the boundary of a convex set, and the cells, all of one orientation, cover that as often as
//! their boundary winds. They are the Delaunay triangulation if also no facet fails the empty-sphere test (Delaunay's
//! lemma, ties broken by id).

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use super::{Delaunay, Dimension, Plane, Space};
use crate::complex::{Corners, Facet, INFINITE};
use crate::{predicates, threads};

/// A sweep of so many cells takes as long as to start a thread for them.
const SWEPT_AT_LEAST: usize = 1 << 14;

/// What does not hold.
#[derive(Debug, Default)]
pub struct Failures {
    /// Finite cells that are not positively oriented.
    pub cells: Vec<u32>,
    /// Facets between finite cells that fail the empty-sphere test, those of cells that are not positively oriented left
    /// out: they are to be tested once these are.
    pub facets: Vec<Facet>,
    /// Ridges of the hull that are not convex, as facets of ghost cells.
    pub ridges: Vec<Facet>,
    /// The ghost cells, after a sweep.
    pub ghosts: Vec<u32>,
}

impl Failures {
    /// Forgets everything; keeps the memory.
    pub fn clear(&mut self) {
        self.cells.clear();
        self.facets.clear();
        self.ridges.clear();
        self.ghosts.clear();
    }

    /// Adds those of a later range.
    fn append(&mut self, mut later: Failures) {
        self.cells.append(&mut later.cells);
        self.facets.append(&mut later.facets);
        self.ridges.append(&mut later.ridges);
        self.ghosts.append(&mut later.ghosts);
    }
}

impl<G: Dimension> Delaunay<G> {
    /// Checks every certificate of the finite cells once, and lists the ghosts; `false`, before the end,
    /// when more than `most` cells have failed.
    pub(crate) fn sweep(&mut self, failures: &mut Failures, most: usize) -> bool {
        failures.clear();
        let n = self.complex.n_slots();
        let n_threads = self.threads.for_work(n, SWEPT_AT_LEAST, SWEPT_AT_LEAST / 64);
        let n_failed = AtomicUsize::new(0);
        if n_threads == 1 {
            self.sweep_range(0..n, failures, most, &n_failed);
        } else {
            let parts = threads::for_ranges(n, n_threads, |range| {
                let mut failures = Failures::default();
                self.sweep_range(range, &mut failures, most, &n_failed);
                failures
            });
            parts.into_iter().for_each(|part| failures.append(part));
        }
        if n_failed.into_inner() > most {
            return false;
        }
        self.certificates += (self.complex.n_finite() * (G::D + 3) / 2) as u64;
        true
    }

    /// Sweeps the cells of a range; stops when more than `most` cells of all ranges have failed.
    fn sweep_range(&self, range: Range<usize>, failures: &mut Failures, most: usize, n_failed: &AtomicUsize) {
        for c in range.start as u32..range.end as u32 {
            if self.complex.is_free(c) {
                continue;
            }
            if self.complex.cell(c).is_ghost() {
                failures.ghosts.push(c);
                continue;
            }
            let (is_positive, failing) = G::certify(self, c);
            if !is_positive {
                failures.cells.push(c);
                if n_failed.fetch_add(1, Relaxed) >= most {
                    return;
                }
            }
            if failing != 0 {
                failures
                    .facets
                    .extend((0..G::Corners::N).filter(|i| failing >> i & 1 == 1).map(|i| Facet::new(c, i)));
            }
        }
    }

    /// Checks the ridges of the ghost cells found by the sweep. Finite cells must be positive.
    pub(crate) fn check_ridges(&self, failures: &mut Failures) {
        for &g in &failures.ghosts {
            let ridges = (0..Self::LAST).map(|i| Facet::new(g, i));
            failures.ridges.extend(ridges.filter(|&ridge| !self.is_convex(ridge)));
        }
    }

    /// Checks the cells of the star of a site; all its facets may fail.
    pub(crate) fn check_star(&mut self, s: u32, failures: &mut Failures) {
        self.gather_star(s);
        for &(c, _) in self.gathered_star() {
            if self.complex.cell(c).is_ghost() {
                continue;
            }
            if !self.is_positive(c) {
                failures.cells.push(c);
            }
            failures.facets.extend((0..G::Corners::N).map(|i| Facet::new(c, i)));
        }
        self.certificates += self.gathered_star().len() as u64;
    }

    /// As [`Dimension::certify`], with exact predicates.
    #[cold]
    #[inline(never)]
    fn certify_exactly(&self, c: u32) -> (bool, u8) {
        if !self.is_positive(c) {
            return (false, 0);
        }
        let cell = self.complex.cell(c);
        let mut failing = 0;
        for i in 0..G::Corners::N {
            if cell.neighbour(i).cell() < c && !self.is_locally_delaunay(Facet::new(c, i)) {
                failing |= 1 << i;
            }
        }
        (true, failing)
    }

    /// Whether a finite cell is positively oriented.
    pub(crate) fn is_positive(&self, cell: u32) -> bool {
        G::orientation(&self.filter, self.view(), &self.complex.cell(cell).corners) > 0.0
    }

    /// Whether the hull is convex at the ridge that is this facet of a ghost cell; in a flat part of the hull, whether
    /// the facets there are those of the Delaunay triangulation.
    pub(crate) fn is_convex(&self, ridge: Facet) -> bool {
        let across = self.complex.cell(ridge.cell()).neighbour(ridge.index());
        let apex = self.site(self.complex.cell(across.cell()).corners[across.index()]);
        !self.is_in_conflict_with_ghost(ridge.cell(), &apex.point, apex.id)
    }
}

/// Whether a finite triangle is positively oriented, and a bit for each edge, to a triangle of a lower index, that fails.
///
/// The circle is prepared once, and holds the orientation. All edges are tested, from both sides: which side has the
/// lower index cannot be predicted, and a wrong guess costs more than a test.
#[inline(always)]
pub(super) fn certify_triangle(t: &Delaunay<Plane>, c: u32) -> (bool, u8) {
    let cell = t.complex.cell(c);
    let [a, b, d] = cell.corners.map(|s| t.view().point(s));
    let circle = predicates::circle(a, b, d);
    let side = |i| {
        let apex = t.complex.apex(cell.neighbour(i));
        let side = predicates::side_of_circle(&circle, a, t.view().point(apex));
        if apex == INFINITE { f64::NEG_INFINITY } else { side }
    };
    let greatest = max(max(side(0), side(1)), side(2));
    if circle[2] > t.filter.orient && greatest < -t.filter.prepared {
        return (true, 0);
    }
    t.certify_exactly(c)
}

/// Likewise for a tetrahedron.
#[inline(always)]
pub(super) fn certify_tetrahedron(t: &Delaunay<Space>, c: u32) -> (bool, u8) {
    let cell = t.complex.cell(c);
    let [a, b, d, e] = cell.corners.map(|s| t.view().point(s));
    let sphere = predicates::sphere(a, b, d, e);
    let side = |i| {
        let apex = t.complex.apex(cell.neighbour(i));
        let side = predicates::side_of_sphere(&sphere, a, t.view().point(apex));
        if apex == INFINITE { f64::NEG_INFINITY } else { side }
    };
    let greatest = max(max(side(0), side(1)), max(side(2), side(3)));
    if sphere[3] > t.filter.orient && greatest < -t.filter.prepared {
        return (true, 0);
    }
    t.certify_exactly(c)
}

/// The greater one, in one instruction.
#[inline(always)]
fn max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
