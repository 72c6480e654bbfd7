//! Tolerances and delimiters: what lets a vertex move without checking its certificates (report, sections 2.3, 2.4).
//!
//! Invariants while valid: every interior bi-cell has a delimiter, a sphere with its interior facet inside and its opposing
//! vertices outside, and the ball around the fixed position of each vertex, of its tolerance, is inside all its safe
//! regions. With a filter that keeps safe regions the delimiters are stored; a vertex found inside its safe region may be
//! outside its ball.
//!
//! With the filter of watching, a bi-cell is either *watched*, and lowers no tolerance, or all that is said here holds for
//! it.
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

mod measuring;

use self::measuring::Batch;
use super::slack::Slacks;
use super::watching::Watched;
use super::{CommitReport, MovingTriangulation};
use crate::complex::{Corners, Facet};
use crate::delaunay::{Delaunay, Dimension, Site};
use crate::error::{Error, Result};
use crate::machine::memory;
use crate::predicates::{
    displacement_limit, distance_above, is_certainly_inside, is_path_certainly_outside, squared_distance,
};

/// Tolerances are capped at this fraction (one over `CAPPED`) of the least extent.
const CAPPED: f64 = 16.0;

/// Which regions let a vertex pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Filter {
    /// Algorithm 1, T.
    Tolerance,
    /// Algorithm 2, S.
    SafeRegion,
    /// S+T: the safe region only where the tolerance fails.
    Both,
    /// The tolerance, of those bi-cells that are not [watched](super::watching).
    Watch,
    /// The tolerance of each bi-cell for itself.
    Slack,
}

impl Filter {
    /// Whether safe regions are among what it lets pass.
    fn keeps_delimiters(self) -> bool {
        matches!(self, Filter::SafeRegion | Filter::Both)
    }
}

/// Fixed position and tolerance of a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fixed<G: Dimension> {
    pub(super) point: G::Point,
    pub(super) tolerance: f64,
}

impl<G: Dimension> Fixed<G> {
    /// Whether `p` is certainly within tolerance.
    #[inline(always)]
    pub(super) fn holds(&self, p: &G::Point) -> bool {
        squared_distance(&self.point, p) < displacement_limit(self.tolerance)
    }
}

/// What the filters know of the triangulation.
#[derive(Debug)]
pub(super) struct Regions<G: Dimension> {
    /// For which filter the rest is valid; `None` if it is not.
    valid_for: Option<Filter>,
    /// Greatest tolerance that is kept: a small part of the least extent of all vertices. The kernel's static filter
    /// covers all fixed positions and as much around them, so that a vertex within tolerance need not be looked at for that.
    most: f64,
    /// With a filter of slacks: how far every vertex may still go until the static filter must cover more.
    room: f64,
    /// By vertex id, so that what a timestamp reads that changes nothing is one stream. For a site with several
    /// vertices, that of its representative is in force.
    fixed: Vec<Fixed<G>>,
    /// By vertex id, for safe regions: how far from its fixed position a vertex inside its safe region may be.
    reach: Vec<f64>,
    /// By the lower facet code of an interior bi-cell, for safe regions: centre and radius of the delimiter.
    delimiters: Vec<(G::Point, f64)>,
    /// The bi-cells that are watched instead of lowering tolerances.
    watched: Watched,
    /// With a filter of slacks, all there is.
    pub(super) slacks: Slacks<G>,
    /// The kernel's record of changed cells, or its memory.
    changed: Vec<u32>,
    /// Vertices that have been relocated during the change under way.
    relocated: Vec<u32>,
}

impl<G: Dimension> Default for Regions<G> {
    fn default() -> Self {
        Regions {
            valid_for: None,
            most: 0.0,
            room: 0.0,
            fixed: Vec::new(),
            reach: Vec::new(),
            delimiters: Vec::new(),
            watched: Watched::default(),
            slacks: Slacks::default(),
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
    pub(super) fn note_relocated(&mut self, vertex: u32) -> Result<()> {
        memory::push(&mut self.relocated, vertex)
    }

    /// Makes sure that a vertex can be [noted](Self::note_relocated) without a failure.
    pub(super) fn make_room_to_note(&mut self) -> Result<()> {
        memory::reserve(&mut self.relocated, 1)
    }

    /// The filter that the regions are kept for.
    pub(super) fn kept_for(&self) -> Option<Filter> {
        self.valid_for
    }

    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.fixed)
            + memory::bytes_of(&self.reach)
            + memory::bytes_of(&self.delimiters)
            + self.watched.memory_bytes()
            + self.slacks.memory_bytes()
            + memory::bytes_of(&self.changed)
            + memory::bytes_of(&self.relocated)
    }

    /// Follows the number of ids and cells. New vertices have no bi-cells yet, so no tolerance smaller than any.
    fn grow(&mut self, kernel: &Delaunay<G>, n_ids: usize, filter: Filter) -> Result<()> {
        if filter == Filter::Slack {
            return self.slacks.grow(kernel);
        }
        let more_ids = n_ids.saturating_sub(self.fixed.len());
        let more_facets = if filter.keeps_delimiters() {
            (4 * kernel.complex().n_slots()).saturating_sub(self.delimiters.len())
        } else {
            0
        };
        let bytes = more_ids * size_of::<Fixed<G>>() + more_facets * size_of::<(G::Point, f64)>();
        if self.fixed.try_reserve(more_ids).is_err() || self.delimiters.try_reserve(more_facets).is_err() {
            return Err(Error::OutOfMemory { bytes });
        }
        let none = Fixed { point: G::Point::default(), tolerance: self.most };
        self.fixed.resize(self.fixed.len() + more_ids, none);
        self.delimiters.resize(self.delimiters.len() + more_facets, (G::Point::default(), 0.0));
        if filter.keeps_delimiters() {
            let missing = self.fixed.len().saturating_sub(self.reach.len());
            memory::reserve(&mut self.reach, missing)?;
            self.reach.resize(self.fixed.len(), f64::INFINITY);
        }
        if filter == Filter::Watch {
            self.watched.grow(kernel.complex().n_slots())?;
        }
        Ok(())
    }

    /// The report's pre-computations: every vertex is fixed where it is, and every bi-cell lowers tolerances, or is watched
    /// if the filter does that. The vertices were `elsewhere`, by id, a timestamp ago, or will be at the next.
    pub(super) fn compute(
        &mut self,
        kernel: &mut Delaunay<G>,
        n_ids: usize,
        filter: Filter,
        elsewhere: &[G::Point],
        report: &mut CommitReport,
    ) -> Result<()> {
        self.valid_for = None;
        self.fixed.clear();
        self.reach.clear();
        self.delimiters.clear();
        self.watched.clear();
        kernel.tighten_filter();
        let (lower, upper) = (kernel.lower(), kernel.upper());
        self.most = (0..G::D).map(|axis| upper[axis] - lower[axis]).fold(f64::INFINITY, f64::min) / CAPPED;
        kernel.cover_around(&lower, &upper, self.most);
        if filter == Filter::Slack {
            self.room = self.most;
            report.tolerances += self.slacks.compute(kernel, elsewhere)?;
            self.valid_for = Some(filter);
            return Ok(());
        }
        self.grow(kernel, n_ids, filter)?;
        for site in kernel.sites()[1..].iter().filter(|site| site.is_live()) {
            self.fixed[site.id as usize].point = site.point;
        }
        let mut batch = Batch::default();
        for c in kernel.complex().live() {
            for i in 0..G::Corners::N {
                if c < kernel.complex().cell(c).neighbour(i).cell() {
                    self.measure::<false>(kernel, filter, Facet::new(c, i), elsewhere, &mut batch);
                    report.tolerances += 1;
                }
            }
        }
        self.lower_batch(filter, elsewhere, &mut batch);
        self.valid_for = Some(filter);
        Ok(())
    }

    /// Every vertex has gone at most so far: the kernel's static filter follows.
    pub(super) fn follow_motion(&mut self, kernel: &mut Delaunay<G>, distance: f64) {
        self.room = (self.room - distance).next_down();
        if self.room < 0.0 {
            self.tighten_filter(kernel);
        }
    }

    /// Makes the kernel's static filter as sharp as what the regions, if they are kept, may let pass allows.
    pub(super) fn tighten_filter(&mut self, kernel: &mut Delaunay<G>) {
        kernel.tighten_filter();
        if self.valid_for.is_some() {
            // A vertex is within its tolerance of where it was fixed, and may go as far to the other side of that.
            let (lower, upper) = (kernel.lower(), kernel.upper());
            kernel.cover_around(&lower, &upper, 2.0 * self.most);
            self.room = self.most;
        }
    }

    /// Fixed positions and tolerances by vertex id.
    pub(super) fn fixed(&self) -> &[Fixed<G>] {
        &self.fixed
    }

    /// Whether a vertex that has its site for itself may move to `p` as far as its tolerance goes.
    #[inline(always)]
    pub(super) fn is_within_tolerance(&self, vertex: u32, p: &G::Point) -> bool {
        self.fixed[vertex as usize].holds(p)
    }

    /// The sub-routine of Algorithm 2: is `p` certainly inside the delimiters of the facets that have the site, outside
    /// those of the facets opposite it, and in reach?
    pub(super) fn is_in_safe_region(&self, kernel: &mut Delaunay<G>, s: u32, p: &G::Point) -> bool {
        let &Site { point: here, id, .. } = kernel.site(s);
        let from = &self.fixed[id as usize].point;
        if squared_distance(from, p) >= displacement_limit(self.reach[id as usize]) {
            return false;
        }
        // The outside of a sphere is not convex: a vertex must not jump over a delimiter.
        if kernel.gather_star(s).is_err() {
            return false;
        }
        let complex = kernel.complex();
        kernel.gathered_star().iter().filter(|(c, _)| !complex.cell(*c).is_ghost()).all(|&(c, at)| {
            (0..G::Corners::N).all(|i| {
                let (facet, across) = (Facet::new(c, i), complex.cell(c).neighbour(i));
                if complex.cell(across.cell()).is_ghost() {
                    return true;
                }
                let (centre, radius) = &self.delimiters[facet.code().min(across.code()) as usize];
                if i == at as usize {
                    is_path_certainly_outside(centre, *radius, &here, p)
                } else {
                    is_certainly_inside(centre, *radius, p)
                }
            })
        })
    }

    /// Visits the facets that are watched.
    pub(super) fn for_watched(&mut self, kernel: &Delaunay<G>, visit: impl FnMut(Facet)) {
        self.watched.for_each(kernel, visit);
    }

    /// About how many facets are watched.
    pub(super) fn n_watched(&self) -> usize {
        self.watched.len()
    }

    /// Fixes the vertex of a site where it is: what is left of its ball, as a lower bound, is its tolerance.
    #[inline(always)]
    fn fix_anew(&mut self, &Site { point, id, .. }: &Site<G>, filter: Filter) {
        let fixed = &mut self.fixed[id as usize];
        if fixed.point != point {
            let moved = distance_above(&fixed.point, &point);
            fixed.tolerance = (fixed.tolerance - moved).next_down().max(0.0);
            fixed.point = point;
            if filter.keeps_delimiters() {
                let reach = &mut self.reach[id as usize];
                *reach = (*reach - moved).next_down().max(0.0);
            }
        }
    }

    /// Fixes the vertex of a site where it is, all bi-cells of which are going to be computed.
    fn fix(&mut self, &Site { point, id, .. }: &Site<G>) {
        self.fixed[id as usize] = Fixed { point, tolerance: self.most };
        if let Some(reach) = self.reach.get_mut(id as usize) {
            *reach = f64::INFINITY;
        }
    }

    /// Computes the bi-cells of all facets of the cells that the kernel has recorded, once each.
    fn follow(
        &mut self,
        kernel: &mut Delaunay<G>,
        n_ids: usize,
        filter: Filter,
        relocated: impl Iterator<Item = u32>,
        elsewhere: &[G::Point],
        report: &mut CommitReport,
    ) -> Result<()> {
        let mut changed = std::mem::take(&mut self.changed);
        self.watched.forget(&changed);
        kernel.tidy_changes(&mut changed);
        if 2 * changed.len() > kernel.complex().n_finite() {
            self.compute(kernel, n_ids, filter, elsewhere, report)?;
        } else {
            self.grow(kernel, n_ids, filter)?;
            self.compute_anew(kernel, filter, &changed, relocated, elsewhere, report)?;
            self.valid_for = Some(filter);
        }
        self.changed = changed;
        Ok(())
    }

    /// Computes the bi-cells of all facets of these cells, each listed once. Among them are the stars of the relocated
    /// sites.
    pub(super) fn compute_anew(
        &mut self,
        kernel: &mut Delaunay<G>,
        filter: Filter,
        cells: &[u32],
        relocated: impl Iterator<Item = u32>,
        elsewhere: &[G::Point],
        report: &mut CommitReport,
    ) -> Result<()> {
        for s in relocated {
            let point = kernel.site(s).point;
            kernel.cover_around(&point, &point, self.most);
            if filter != Filter::Slack {
                self.fix(kernel.site(s));
            }
        }
        if filter == Filter::Slack {
            report.tolerances += self.slacks.compute_anew(kernel, cells)?;
            return Ok(());
        }
        let mut batch = Batch::default();
        kernel.for_facets_of(cells, |kernel, facet| {
            self.measure::<true>(kernel, filter, facet, elsewhere, &mut batch);
            report.tolerances += 1;
        });
        self.lower_batch(filter, elsewhere, &mut batch);
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
        self.regions.relocated.clear();
        let Some(filter) = self.regions.valid_for.take() else {
            let done = change(self, report);
            self.regions.relocated.clear();
            return done;
        };
        self.kernel.record_changes(std::mem::take(&mut self.regions.changed));
        let done = change(self, report);
        if let Some(changed) = self.kernel.take_changes()
            && done.is_ok()
        {
            let mut relocated = std::mem::take(&mut self.regions.relocated);
            relocated.iter_mut().for_each(|v| *v = self.site_of[*v as usize]);
            relocated.retain(|&s| !self.is_shared(s));
            let sites = relocated.iter().copied();
            // Without the memory for it the regions stay invalid, and the next commit says so.
            self.regions.changed = changed;
            let (n_ids, elsewhere) = (self.site_of.len(), &self.staging.positions);
            let kernel = &mut self.kernel;
            let _ = self.regions.follow(kernel, n_ids, filter, sites, elsewhere, report);
            self.regions.relocated = relocated;
        }
        done
    }
}
