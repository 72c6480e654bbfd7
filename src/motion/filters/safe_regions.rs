//! Delimiters of bi-cells, and what vertices get of them (report, section 2.3).
//!
//! Every interior bi-cell has a delimiter: a sphere with its interior facet inside and its opposing vertices outside.
//!
//! **In space a safe region is not enough.** The report's Proposition 1 fails there for bi-cells whose flip would be
//! 3-2 (see [`predicates::Delimiter::reach`](crate::predicates::Delimiter)): a vertex must also stay within the
//! *reach* of its bi-cells, which is infinite in the plane. With weights no sphere has sides that say enough (see
//! `predicates/power_tolerance.rs`): the reach is the tolerance, and a safe region the ball of that.
//!
//! At the hull a bi-cell has no sphere. Its certificate is the orientation of `D + 1` points, and its tolerance and its
//! reach are half the least width of their simplex.

use crate::complex::{Corners, Facet};
use crate::delaunay::{Delaunay, Moving, Site};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::filters::bicell::{BiCell, for_bicells};
use crate::motion::filters::store::{Store, TimestampSteps};
use crate::motion::filters::tolerance::{Fixed, Tolerances};
use crate::predicates::{
    PointArray, displacement_limit, distance_above, distance_from_sphere, is_certainly_inside,
    is_path_certainly_outside,
};

/// A vertex gets another ball in its safe region if the square of its way since it was fixed is more than this number
/// of times that of its last step: one that goes farther in each step would leave the ball at once.
const SLOW: f64 = 4.0;

/// What lets a vertex move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Admission {
    /// The vertex is certainly within its tolerance.
    WithinTolerance,
    /// The vertex is certainly within its safe region.
    WithinSafeRegion,
}

/// A delimiter for each interior bi-cell, and a tolerance for each vertex: the ball of it is in the safe region. A
/// vertex found inside its safe region may be outside this ball, unless it gets another one there.
#[derive(Debug)]
pub(in crate::motion) struct SafeRegions<G: Moving> {
    /// Whether the safe region is tested only where the tolerance fails.
    tests_tolerance: bool,
    tolerances: Tolerances<G>,
    /// By vertex id: how far from its fixed position a vertex inside its safe region may be.
    reach: Vec<f64>,
    /// By the lower facet code of an interior bi-cell: centre and radius of the delimiter.
    delimiters: Vec<(G::Point, f64)>,
}

impl<G: Moving> SafeRegions<G> {
    pub(in crate::motion) fn new(tests_tolerance: bool) -> Self {
        let tolerances = Tolerances::default();
        SafeRegions { tests_tolerance, tolerances, reach: Vec::new(), delimiters: Vec::new() }
    }

    /// A copy.
    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(SafeRegions {
            tests_tolerance: self.tests_tolerance,
            tolerances: self.tolerances.copied()?,
            reach: memory::copy_of(&self.reach)?,
            delimiters: memory::copy_of(&self.delimiters)?,
        })
    }

    pub(in crate::motion) fn tests_tolerance(&self) -> bool {
        self.tests_tolerance
    }

    /// Fixed positions by vertex id, and the radius of a ball around each that is in the safe region.
    #[inline(always)]
    pub(in crate::motion) fn fixed(&self) -> &[Fixed<G>] {
        self.tolerances.fixed()
    }

    /// Whether a vertex that has site `s` for itself certainly stays in its region when it moves to `p`. If it slowly
    /// leaves only the ball of its tolerance, another one around `p` takes the place of that.
    #[inline(always)]
    pub(in crate::motion) fn admit(
        &mut self,
        kernel: &mut Delaunay<G>,
        vertex: VertexId,
        s: SiteId,
        p: &G::Point,
    ) -> Option<Admission> {
        if self.tests_tolerance && self.fixed()[vertex].holds(p) {
            return Some(Admission::WithinTolerance);
        }
        if !self.is_in_safe_region(kernel, s, p) {
            return None;
        }
        if self.tests_tolerance && !G::HAS_WEIGHTS {
            let (here, from) = (&kernel.site(s).point, self.fixed()[vertex].point());
            if here.squared_way(p) * SLOW < from.squared_way(p) {
                self.keep_ball_around(kernel, vertex, p);
            }
        }
        Some(Admission::WithinSafeRegion)
    }

    /// The sub-routine of Algorithm 2: is `p` certainly inside the delimiters of the facets that have the site, outside
    /// those of the facets opposite it, and in reach?
    fn is_in_safe_region(&self, kernel: &mut Delaunay<G>, s: SiteId, p: &G::Point) -> bool {
        let &Site { point: here, id, .. } = kernel.site(s);
        let from = self.fixed()[id].point();
        if from.squared_way(p) >= displacement_limit(self.reach[id]) {
            return false;
        }
        if G::HAS_WEIGHTS {
            // A reach is a tolerance there.
            return true;
        }
        // The outside of a sphere is not convex: a vertex must not jump over a delimiter.
        kernel.gather_star(s).is_ok()
            && self.delimit_gathered(kernel, |centre, radius, is_outside| {
                if is_outside {
                    is_path_certainly_outside(centre, radius, &here, p)
                } else {
                    is_certainly_inside(centre, radius, p)
                }
            })
    }

    /// Whether all delimiters around the site of the gathered star are such, given by centre and radius, and whether
    /// the site is outside. Facets that have the site are seen from one side.
    #[inline(always)]
    fn delimit_gathered(
        &self,
        kernel: &Delaunay<G>,
        mut are_such: impl FnMut(&G::Point, f64, bool) -> bool,
    ) -> bool {
        let complex = kernel.complex();
        kernel.gathered_star().iter().filter(|(c, _)| !complex.cell(*c).is_ghost()).all(|&(c, at)| {
            (0..G::Corners::N).all(|i| {
                let (facet, across) = (Facet::new(c, i), complex.cell(c).neighbour(i));
                let is_opposite = i == at as usize;
                if !is_opposite && across < facet || complex.cell(across.cell()).is_ghost() {
                    return true;
                }
                let (centre, radius) = &self.delimiters[facet.code().min(across.code()) as usize];
                are_such(centre, *radius, is_opposite)
            })
        })
    }

    /// Fixes the vertex of the gathered star, which goes to `p` and is in its safe region there, at `p`: its
    /// tolerance is the distance of the nearest delimiter, and what is left of its reach is its reach.
    fn keep_ball_around(&mut self, kernel: &mut Delaunay<G>, vertex: VertexId, p: &G::Point) {
        let moved = distance_above(self.fixed()[vertex].point(), p);
        let reach = (self.reach[vertex] - moved).next_down().max(0.0);
        let mut radius = reach;
        self.delimit_gathered(kernel, |centre, of_delimiter, _| {
            radius = radius.min(distance_from_sphere(centre, of_delimiter, p));
            true
        });
        self.reach[vertex] = reach;
        self.tolerances.fix_at(kernel, vertex, p, radius);
    }

    /// Follows the number of ids and cells.
    fn grow(&mut self, kernel: &Delaunay<G>, n_ids: usize) -> Result<()> {
        self.tolerances.grow(n_ids)?;
        memory::lengthen(&mut self.reach, n_ids, f64::INFINITY)?;
        memory::lengthen(&mut self.delimiters, 4 * kernel.complex().n_slots(), (G::Point::default(), 0.0))
    }

    /// Fixes the vertex of a site where it is: what is left of its reach is its reach.
    #[inline(always)]
    fn fix_again(&mut self, site: &Site<G>) {
        if let Some(moved) = self.tolerances.fix_again(site) {
            let reach = &mut self.reach[site.id];
            *reach = (*reach - moved).next_down().max(0.0);
        }
    }

    /// Computes a bi-cell: keeps its delimiter, and lets it lower the tolerance and the reach of its vertices, which
    /// are fixed where they are.
    #[inline(always)]
    fn measure(&mut self, kernel: &Delaunay<G>, facet: Facet, bicell: BiCell<'_, G>) {
        let vertices = bicell.vertices(kernel);
        let finite = &vertices[..bicell.sites().len()];
        let (tolerance, reach) = match bicell.delimiter() {
            Some(delimiter) => {
                let across = kernel.complex().cell(facet.cell()).neighbour(facet.index());
                // The test only looks at the vertex that moves: the others must certainly be on their sides. If
                // rounding leaves that open there are no sides: no place is certainly on either side of this sphere.
                let is_certain = delimiter.half_width > 0.0;
                let radius = if is_certain { delimiter.radius } else { f64::NAN };
                self.delimiters[facet.code().min(across.code()) as usize] = (delimiter.centre, radius);
                (delimiter.tolerance, delimiter.reach)
            }
            None => {
                let width = bicell.hull_tolerance();
                (width, width)
            }
        };
        self.tolerances.lower(finite, tolerance);
        for &v in finite {
            let least = &mut self.reach[v];
            *least = least.min(reach);
        }
    }
}

impl<G: Moving> Store<G> for SafeRegions<G> {
    fn prepare(&mut self, kernel: &mut Delaunay<G>, n_ids: usize, _: TimestampSteps<'_, G>) -> Result<u64> {
        self.reach.clear();
        self.delimiters.clear();
        self.tolerances.fix_all(kernel, n_ids)?;
        self.grow(kernel, n_ids)?;
        Ok(for_bicells(kernel, |facet| self.measure(kernel, facet, BiCell::of(kernel, facet))))
    }

    fn follow(
        &mut self,
        kernel: &mut Delaunay<G>,
        site_of: &[SiteId],
        _: TimestampSteps<'_, G>,
        cells: &[Slot],
        relocated: &[VertexId],
    ) -> Result<u64> {
        self.grow(kernel, site_of.len())?;
        for &v in relocated {
            self.tolerances.fix(kernel, site_of[v]);
            self.reach[v] = f64::INFINITY;
        }
        let mut n = 0;
        kernel.for_facets_of(cells, |kernel, facet| {
            let bicell = BiCell::of(kernel, facet);
            for &s in bicell.sites() {
                self.fix_again(kernel.site(s));
            }
            self.measure(kernel, facet, bicell);
            n += 1;
        });
        Ok(n)
    }

    fn tighten_filter(&mut self, kernel: &mut Delaunay<G>) {
        self.tolerances.tighten_filter(kernel);
        // A vertex in its safe region may be far from its ball, and go back there.
        self.tolerances.cover_balls(kernel);
    }

    fn memory_bytes(&self) -> usize {
        self.tolerances.memory_bytes() + memory::bytes_of(&self.reach) + memory::bytes_of(&self.delimiters)
    }
}
