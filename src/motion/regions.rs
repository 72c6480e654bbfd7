//! Tolerances and delimiters: what lets a vertex move without a look at its certificates (report, sections 2.3, 2.4).
//!
//! Invariants while valid: every interior bi-cell has a delimiter, a sphere with its interior facet inside and its opposing
//! vertices outside, and the ball around the fixed position of each site, of its tolerance, is inside all its safe
//! regions. With a filter that keeps safe regions the delimiters are stored; a vertex found inside its safe region may be
//! outside its ball.
//!
//! While cells change (a queue, an insertion, a removal) the regions are not valid. They are again once
//! every bi-cell that has a new cell or a relocated vertex has been computed at the positions of that moment
//! ([`with_regions`]): the points of all other bi-cells have stayed, since they were last known to be on
//! their sides, or moved within their regions. Where most bi-cells are concerned all are computed, which
//! also makes good for tolerances that have only been lowered for long.
//!
//! [`with_regions`]: MovingTriangulation::with_regions
//!
//! **In space a safe region is not enough.** The report's Proposition 1 fails there for bi-cells whose flip would be 3-2
//! (see [`predicates::Delimiter::reach`](crate::predicates::Delimiter)): a vertex must also stay within the *reach* of its
//! bi-cells, which is infinite in the plane.
//!
//! At the hull a bi-cell has no sphere. Its certificate is the orientation of `D + 1` points, and its tolerance and its
//! reach are half the least width of their simplex.

use super::bicell::BiCell;
use super::prefetch::prefetch;
use super::{CommitReport, MovingTriangulation};
use crate::complex::{Corners, Facet};
use crate::delaunay::{Delaunay, Dimension};
use crate::error::{Error, Result};
use crate::predicates::{LANES, displacement_limit};

/// Which regions let a vertex pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Filter {
    /// Algorithm 1, T.
    Tolerance,
    /// Algorithm 2, S.
    SafeRegion,
    /// S+T: the safe region only where the tolerance fails.
    Both,
}

/// Fixed position and tolerance of a site, in one line of the cache.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Fixed<G: Dimension> {
    point: G::Point,
    tolerance: f64,
}

/// Bi-cells whose tolerances are to be computed together.
#[derive(Debug, Default)]
struct Batch<G: Dimension> {
    bicells: G::BiCells,
    sites: [[u32; 5]; LANES],
    n: usize,
}

impl<G: Dimension> Batch<G> {
    #[inline(always)]
    fn push(&mut self, sites: [u32; 5], points: &[&G::Point]) {
        G::set_bicell(&mut self.bicells, self.n, points);
        self.sites[self.n] = sites;
        self.n += 1;
    }
}

/// What the filters know of the triangulation.
#[derive(Debug)]
pub(super) struct Regions<G: Dimension> {
    /// For which filter the rest is valid; `None` if it is not.
    valid_for: Option<Filter>,
    /// By site.
    fixed: Vec<Fixed<G>>,
    /// By site, for safe regions: how far from its fixed position a vertex inside its safe region may be.
    reach: Vec<f64>,
    /// By the lower facet code of an interior bi-cell, for safe regions: centre and radius of the delimiter.
    delimiters: Vec<(G::Point, f64)>,
    /// Memory of the kernel's record of changed cells.
    changed: Vec<u32>,
    /// Vertices that have been relocated during the change under way.
    relocated: Vec<u32>,
}

impl<G: Dimension> Default for Regions<G> {
    fn default() -> Self {
        Regions {
            valid_for: None,
            fixed: Vec::new(),
            reach: Vec::new(),
            delimiters: Vec::new(),
            changed: Vec::new(),
            relocated: Vec::new(),
        }
    }
}

impl<G: Dimension> Regions<G> {
    /// The triangulation has changed without the regions.
    pub(super) fn invalidate(&mut self) {
        self.valid_for = None;
    }

    /// A vertex has been relocated: all bi-cells of its site are among the changes.
    pub(super) fn note_relocated(&mut self, vertex: u32) {
        self.relocated.push(vertex);
    }

    /// The filter that the regions are kept for.
    pub(super) fn kept_for(&self) -> Option<Filter> {
        self.valid_for
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.fixed.capacity() * size_of::<Fixed<G>>()
            + self.delimiters.capacity() * size_of::<(G::Point, f64)>()
            + self.reach.capacity() * 8
    }

    /// Follows the number of sites and cells. New sites have no bi-cells yet, so no tolerance smaller than any.
    pub(super) fn grow(&mut self, kernel: &Delaunay<G>, filter: Filter) -> Result<()> {
        let more_sites = kernel.sites().len().saturating_sub(self.fixed.len());
        let more_facets = match filter {
            Filter::Tolerance => 0,
            _ => (4 * kernel.complex().n_slots()).saturating_sub(self.delimiters.len()),
        };
        let bytes = more_sites * size_of::<Fixed<G>>() + more_facets * size_of::<(G::Point, f64)>();
        if self.fixed.try_reserve(more_sites).is_err() || self.delimiters.try_reserve(more_facets).is_err() {
            return Err(Error::OutOfMemory { bytes });
        }
        let none = Fixed { point: G::Point::default(), tolerance: f64::INFINITY };
        self.fixed.resize(self.fixed.len() + more_sites, none);
        self.delimiters.resize(self.delimiters.len() + more_facets, (G::Point::default(), 0.0));
        if filter != Filter::Tolerance {
            self.reach.resize(self.fixed.len(), f64::INFINITY);
        }
        Ok(())
    }

    /// The report's pre-computations: every site is fixed where it is, and every bi-cell lowers tolerances.
    pub(super) fn compute(
        &mut self,
        kernel: &Delaunay<G>,
        filter: Filter,
        report: &mut CommitReport,
    ) -> Result<()> {
        self.valid_for = None;
        self.fixed.clear();
        self.reach.clear();
        self.delimiters.clear();
        self.grow(kernel, filter)?;
        for (fixed, site) in self.fixed.iter_mut().zip(kernel.sites()) {
            fixed.point = site.point;
        }
        let mut batch = Batch::default();
        for c in kernel.complex().live() {
            for i in 0..G::Corners::N {
                if c < kernel.complex().cell(c).neighbour(i).cell() {
                    self.measure::<false>(kernel, filter, Facet::new(c, i), &mut batch);
                    report.tolerances += 1;
                }
            }
        }
        self.lower_batch(&mut batch);
        self.valid_for = Some(filter);
        Ok(())
    }

    /// The tolerance of a site is going to be asked for.
    #[inline(always)]
    pub(super) fn prefetch(&self, s: usize) {
        prefetch(&self.fixed, s);
    }

    /// Whether a site may move to `p` as far as its tolerance goes.
    #[inline(always)]
    pub(super) fn is_within_tolerance(&self, s: u32, p: &G::Point) -> bool {
        let fixed = &self.fixed[s as usize];
        G::squared_distance(&fixed.point, p) < displacement_limit(fixed.tolerance)
    }

    /// The sub-routine of Algorithm 2: is `p` certainly inside the delimiters of the facets that have the site, outside
    /// those of the facets opposite it, and in reach?
    pub(super) fn is_in_safe_region(&self, kernel: &mut Delaunay<G>, s: u32, p: &G::Point) -> bool {
        let from = &self.fixed[s as usize].point;
        if G::squared_distance(from, p) >= displacement_limit(self.reach[s as usize]) {
            return false;
        }
        // The outside of a sphere is not convex: a vertex must not jump over a delimiter.
        let here = kernel.site(s).point;
        kernel.gather_star(s);
        let complex = kernel.complex();
        kernel.gathered_star().iter().filter(|(c, _)| !complex.cell(*c).is_ghost()).all(|&(c, at)| {
            (0..G::Corners::N).all(|i| {
                let (facet, across) = (Facet::new(c, i), complex.cell(c).neighbour(i));
                if complex.cell(across.cell()).is_ghost() {
                    return true;
                }
                let (centre, radius) = &self.delimiters[facet.code().min(across.code()) as usize];
                if i == at as usize {
                    G::is_path_certainly_outside(centre, *radius, &here, p)
                } else {
                    G::is_certainly_inside(centre, *radius, p)
                }
            })
        })
    }

    /// Computes a bi-cell: lets it lower the tolerances of its vertices, and keeps its delimiter. `ANEW`
    /// unless all sites are fixed where they are.
    #[inline(always)]
    fn measure<const ANEW: bool>(
        &mut self,
        kernel: &Delaunay<G>,
        filter: Filter,
        facet: Facet,
        batch: &mut Batch<G>,
    ) {
        let bicell = BiCell::of(kernel, facet);
        if ANEW {
            for &s in bicell.sites() {
                self.fix_anew(kernel, filter, s);
            }
        }
        if filter == Filter::Tolerance {
            match bicell.interior() {
                Some((sites, points)) => {
                    batch.push(sites, points);
                    if batch.n == LANES {
                        self.lower_batch(batch);
                    }
                }
                None => self.lower(bicell.sites(), bicell.hull_tolerance()),
            }
            return;
        }
        let (tolerance, reach) = match bicell.delimiter() {
            Some(delimiter) => {
                let across = kernel.complex().cell(facet.cell()).neighbour(facet.index());
                self.delimiters[facet.code().min(across.code()) as usize] =
                    (delimiter.centre, delimiter.radius);
                (delimiter.tolerance, delimiter.reach)
            }
            None => {
                let width = bicell.hull_tolerance();
                (width, width)
            }
        };
        self.lower(bicell.sites(), tolerance);
        for &s in bicell.sites() {
            let least = &mut self.reach[s as usize];
            *least = least.min(reach);
        }
    }

    #[inline(always)]
    fn lower(&mut self, sites: &[u32], tolerance: f64) {
        for &s in sites {
            let fixed = &mut self.fixed[s as usize];
            fixed.tolerance = fixed.tolerance.min(tolerance);
        }
    }

    /// Computes the tolerances of a batch, which is empty then.
    fn lower_batch(&mut self, batch: &mut Batch<G>) {
        let mut enough = [0.0; LANES];
        for (enough, sites) in enough.iter_mut().zip(&batch.sites[..batch.n]) {
            for &s in &sites[..G::D + 2] {
                *enough = self.fixed[s as usize].tolerance.max(*enough);
            }
        }
        let tolerances = G::tolerances(&batch.bicells, enough);
        for (k, tolerance) in tolerances.into_iter().enumerate().take(batch.n) {
            self.lower(&batch.sites[k][..G::D + 2], tolerance);
        }
        batch.n = 0;
    }

    /// Fixes a site where it is: what is left of its ball, as a lower bound, is its tolerance.
    #[inline(always)]
    fn fix_anew(&mut self, kernel: &Delaunay<G>, filter: Filter, s: u32) {
        let fixed = &mut self.fixed[s as usize];
        let point = kernel.site(s).point;
        if fixed.point != point {
            let moved = G::distance_above(&fixed.point, &point);
            fixed.tolerance = (fixed.tolerance - moved).next_down().max(0.0);
            fixed.point = point;
            if filter != Filter::Tolerance {
                let reach = &mut self.reach[s as usize];
                *reach = (*reach - moved).next_down().max(0.0);
            }
        }
    }

    /// Fixes a site where it is, all bi-cells of which are going to be computed.
    fn fix(&mut self, kernel: &Delaunay<G>, s: u32) {
        self.fixed[s as usize] = Fixed { point: kernel.site(s).point, tolerance: f64::INFINITY };
        if let Some(reach) = self.reach.get_mut(s as usize) {
            *reach = f64::INFINITY;
        }
    }

    /// Computes the bi-cells of all facets of the cells that the kernel has recorded, once each.
    fn follow(
        &mut self,
        kernel: &mut Delaunay<G>,
        filter: Filter,
        mut changed: Vec<u32>,
        relocated: impl Iterator<Item = u32>,
        report: &mut CommitReport,
    ) -> Result<()> {
        kernel.tidy_changes(&mut changed);
        if 2 * changed.len() > kernel.complex().n_finite() {
            self.compute(kernel, filter, report)?;
        } else {
            self.grow(kernel, filter)?;
            relocated.for_each(|s| self.fix(kernel, s));
            let mut batch = Batch::default();
            kernel.for_facets_of(&changed, |kernel, facet| {
                self.measure::<true>(kernel, filter, facet, &mut batch);
                report.tolerances += 1;
            });
            self.lower_batch(&mut batch);
            self.valid_for = Some(filter);
        }
        self.changed = changed;
        Ok(())
    }
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Makes a change that the regions follow if they are valid. If it fails they are not any more.
    pub(super) fn with_regions<T>(
        &mut self,
        report: &mut CommitReport,
        change: impl FnOnce(&mut Self, &mut CommitReport) -> Result<T>,
    ) -> Result<T> {
        let Some(filter) = self.regions.valid_for.take() else {
            return change(self, report);
        };
        self.regions.relocated.clear();
        self.kernel.record_changes(std::mem::take(&mut self.regions.changed));
        let done = change(self, report);
        if let Some(changed) = self.kernel.take_changes()
            && done.is_ok()
        {
            let relocated = std::mem::take(&mut self.regions.relocated);
            let sites =
                relocated.iter().map(|&v| self.site_of[v as usize]).filter(|&s| !self.hidden.any_at(s));
            // Without the memory for it the regions stay invalid, and the next commit says so.
            let _ = self.regions.follow(&mut self.kernel, filter, changed, sites, report);
            self.regions.relocated = relocated;
        }
        done
    }
}
