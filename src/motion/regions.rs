//! Tolerances and delimiters: what lets a vertex move without a look at its certificates (report, sections 2.3, 2.4).
//!
//! Invariants while valid: every interior bi-cell has a delimiter, a sphere with its interior facet inside and its opposing
//! vertices outside, and the ball around the fixed position of each site, of its tolerance, is inside all its safe
//! regions. With a filter that keeps safe regions the delimiters are stored; a vertex found inside its safe region may be
//! outside its ball.
//!
//! **In space a safe region is not enough.** The report's Proposition 1 fails there for bi-cells whose flip would be 3-2
//! (see [`predicates::Delimiter::reach`](crate::predicates::Delimiter)): a vertex must also stay within the *reach* of its
//! bi-cells, which is infinite in the plane.
//!
//! At the hull a bi-cell has no sphere. Its certificate is the orientation of `D + 1` points, and its tolerance and its
//! reach are half the least width of their simplex.

use super::CommitReport;
use super::bicell::BiCell;
use crate::complex::{Corners, Facet};
use crate::delaunay::{Delaunay, Dimension};
use crate::error::{Error, Result};
use crate::predicates::{Delimiter, displacement_limit};

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

/// Fixed position and tolerance of a site.
#[derive(Clone, Copy, Debug)]
struct Fixed<G: Dimension> {
    point: G::Point,
    tolerance: f64,
}

/// A bi-cell and what was computed for it.
#[derive(Clone, Copy, Debug)]
struct Measured<G: Dimension> {
    facet: Facet,
    bicell: BiCell<G>,
    /// `None` at the hull.
    delimiter: Option<Delimiter<G::Point>>,
    tolerance: f64,
    reach: f64,
}

impl<G: Dimension> Measured<G> {
    #[inline(always)]
    fn of(kernel: &Delaunay<G>, facet: Facet) -> Self {
        let bicell = BiCell::of(kernel, facet);
        let delimiter = bicell.delimiter();
        let (tolerance, reach) = match &delimiter {
            Some(delimiter) => (delimiter.tolerance, delimiter.reach),
            None => {
                let width = bicell.hull_tolerance();
                (width, width)
            }
        };
        Measured { facet, bicell, delimiter, tolerance, reach }
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
    /// New bi-cells, until all of them are known to have a delimiter.
    pending: Vec<Measured<G>>,
    /// Memory of the record of changed cells.
    pub(super) changed: Vec<u32>,
    /// Vertices to be placed.
    pub(super) queue: Vec<u32>,
}

impl<G: Dimension> Default for Regions<G> {
    fn default() -> Self {
        Regions {
            valid_for: None,
            fixed: Vec::new(),
            reach: Vec::new(),
            delimiters: Vec::new(),
            pending: Vec::new(),
            changed: Vec::new(),
            queue: Vec::new(),
        }
    }
}

impl<G: Dimension> Regions<G> {
    /// The triangulation has changed without the regions.
    pub(super) fn invalidate(&mut self) {
        self.valid_for = None;
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
    pub(super) fn compute(&mut self, kernel: &Delaunay<G>, filter: Filter) -> Result<()> {
        self.valid_for = None;
        self.fixed.clear();
        self.reach.clear();
        self.delimiters.clear();
        self.grow(kernel, filter)?;
        for (fixed, site) in self.fixed.iter_mut().zip(kernel.sites()) {
            fixed.point = site.point;
        }
        for c in kernel.complex().live() {
            for i in 0..G::Corners::N {
                if c < kernel.complex().cell(c).neighbour(i).cell() {
                    self.keep(kernel, filter, &Measured::of(kernel, Facet::new(c, i)));
                }
            }
        }
        self.valid_for = Some(filter);
        Ok(())
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

    /// Moves a site to `q` if every bi-cell of it certainly has a delimiter there, which proves its certificates: the
    /// empty spheres need no other test. Fixes it, and lets the bi-cells lower tolerances.
    pub(super) fn move_in_place(
        &mut self,
        kernel: &mut Delaunay<G>,
        filter: Filter,
        s: u32,
        q: &G::Point,
        report: &mut CommitReport,
    ) -> bool {
        let old = kernel.site(s).point;
        if !kernel.move_within_link(s, q) {
            return false;
        }
        self.pending.clear();
        for &(c, at) in kernel.gathered_star() {
            for i in 0..G::Corners::N {
                if i != at as usize && kernel.complex().cell(c).neighbour(i).cell() < c {
                    continue;
                }
                let measured = Measured::of(kernel, Facet::new(c, i));
                if measured.tolerance <= 0.0 {
                    kernel.set_point(s, old);
                    return false;
                }
                self.pending.push(measured);
            }
        }
        self.fix(kernel, s);
        let pending = std::mem::take(&mut self.pending);
        for measured in &pending {
            self.keep(kernel, filter, measured);
        }
        report.tolerances += pending.len() as u64;
        self.pending = pending;
        true
    }

    /// Lets a new bi-cell lower the tolerances of its vertices, and keeps its delimiter.
    #[inline(always)]
    fn keep(&mut self, kernel: &Delaunay<G>, filter: Filter, measured: &Measured<G>) {
        for &s in measured.bicell.sites() {
            self.fix_anew(kernel, filter, s);
            let fixed = &mut self.fixed[s as usize];
            fixed.tolerance = fixed.tolerance.min(measured.tolerance);
        }
        if filter != Filter::Tolerance {
            for &s in measured.bicell.sites() {
                let reach = &mut self.reach[s as usize];
                *reach = reach.min(measured.reach);
            }
            if let Some(delimiter) = &measured.delimiter {
                let facet = measured.facet;
                let across = kernel.complex().cell(facet.cell()).neighbour(facet.index());
                self.delimiters[facet.code().min(across.code()) as usize] =
                    (delimiter.centre, delimiter.radius);
            }
        }
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

    /// Fixes a site where it is; all its bi-cells are to be added again.
    pub(super) fn fix(&mut self, kernel: &Delaunay<G>, s: u32) {
        self.fixed[s as usize] = Fixed { point: kernel.site(s).point, tolerance: f64::INFINITY };
        if let Some(reach) = self.reach.get_mut(s as usize) {
            *reach = f64::INFINITY;
        }
    }

    /// Adds the bi-cells of all facets of the cells that the kernel has recorded.
    pub(super) fn add_changes(
        &mut self,
        kernel: &mut Delaunay<G>,
        filter: Filter,
        report: &mut CommitReport,
    ) -> Result<()> {
        let mut changed = kernel.take_changes();
        self.grow(kernel, filter)?;
        changed.retain(|&c| kernel.complex().is_live(c));
        changed.sort_unstable();
        changed.dedup();
        for &c in &changed {
            for i in 0..G::Corners::N {
                let across = kernel.complex().cell(c).neighbour(i).cell();
                if across < c && changed.binary_search(&across).is_ok() {
                    continue;
                }
                self.keep(kernel, filter, &Measured::of(kernel, Facet::new(c, i)));
                report.tolerances += 1;
            }
        }
        self.changed = changed;
        Ok(())
    }
}
