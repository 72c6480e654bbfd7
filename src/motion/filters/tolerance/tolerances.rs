//! Fixed positions and tolerances of vertices (report, section 2.4).

use crate::complex::Facet;
use crate::delaunay::{Delaunay, Moving, Site};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::filters::bicell::{BiCell, for_bicells};
use crate::motion::filters::margin::Margin;
use crate::motion::filters::store::{Store, TimestampSteps};
use crate::motion::filters::tolerance::batch::Batch;
use crate::predicates::{LANES, PointArray, displacement_limit, distance_above};

/// Fixed position and tolerance of a vertex.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct Fixed<G: Moving> {
    point: G::Point,
    tolerance: f64,
}

impl<G: Moving> Fixed<G> {
    /// Whether `p` is certainly within tolerance.
    #[inline(always)]
    pub(in crate::motion) fn holds(&self, p: &G::Point) -> bool {
        self.point.squared_way(p) < displacement_limit(self.tolerance)
    }

    #[inline(always)]
    pub(in crate::motion) fn point(&self) -> &G::Point {
        &self.point
    }

    #[inline(always)]
    pub(in crate::motion) fn tolerance(&self) -> f64 {
        self.tolerance
    }
}

/// Fixed position and tolerance of each vertex: as far as bi-cells have been allowed to lower it.
#[derive(Debug, Default)]
pub(in crate::motion) struct Tolerances<G: Moving> {
    /// No tolerance is greater.
    margin: Margin,
    /// By vertex id, so that what a timestamp reads that changes nothing is one stream. For a site with several
    /// vertices, that of its representative is in force.
    fixed: Vec<Fixed<G>>,
}

impl<G: Moving> Tolerances<G> {
    /// A copy.
    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(Tolerances { margin: self.margin, fixed: memory::copy_of(&self.fixed)? })
    }

    /// Fixed positions and tolerances by vertex id.
    #[inline(always)]
    pub(in crate::motion) fn fixed(&self) -> &[Fixed<G>] {
        &self.fixed
    }

    /// Fixes every vertex where it is; no bi-cell has lowered a tolerance yet.
    pub(in crate::motion) fn fix_all(&mut self, kernel: &mut Delaunay<G>, n_ids: usize) -> Result<()> {
        self.fixed.clear();
        self.margin = Margin::around_all(kernel);
        self.grow(n_ids)?;
        for site in kernel.sites()[1..].iter().filter(|site| site.is_live()) {
            self.fixed[site.id].point = site.point;
        }
        Ok(())
    }

    /// Follows the number of ids. New vertices have no bi-cells yet, so no tolerance smaller than any.
    pub(in crate::motion) fn grow(&mut self, n_ids: usize) -> Result<()> {
        let tolerance = self.margin.distance();
        memory::lengthen(&mut self.fixed, n_ids, Fixed { point: G::Point::default(), tolerance })
    }

    /// Fixes the vertex of a site that has been relocated where it is. All of its bi-cells are going to be computed.
    #[inline(always)]
    pub(in crate::motion) fn fix(&mut self, kernel: &mut Delaunay<G>, s: SiteId) {
        let &Site { point, id, .. } = kernel.site(s);
        self.margin.cover(kernel, &point);
        self.fixed[id] = Fixed { point, tolerance: self.margin.distance() };
    }

    /// Fixes the vertex of a site where it is: what is left of its ball, as a lower bound, is its tolerance. Returns
    /// how far that is from where it was fixed, as an upper bound, unless it is there.
    #[inline(always)]
    pub(in crate::motion) fn fix_again(&mut self, &Site { point, id, .. }: &Site<G>) -> Option<f64> {
        let fixed = &mut self.fixed[id];
        if fixed.point == point {
            return None;
        }
        let moved = distance_above(&fixed.point, &point);
        fixed.tolerance = (fixed.tolerance - moved).next_down().max(0.0);
        fixed.point = point;
        Some(moved)
    }

    /// Fixes a vertex at the place to which it goes: it may go by this distance from there.
    pub(in crate::motion) fn fix_at(
        &mut self,
        kernel: &mut Delaunay<G>,
        vertex: VertexId,
        place: &G::Point,
        distance: f64,
    ) {
        self.margin.cover(kernel, place);
        self.fixed[vertex] = Fixed { point: *place, tolerance: distance.min(self.margin.distance()) };
    }

    /// Makes the kernel's static filter cover the balls of all vertices, wherever these are.
    pub(in crate::motion) fn cover_balls(&self, kernel: &mut Delaunay<G>) {
        for s in SiteId::range(1..kernel.sites().len()) {
            if kernel.site(s).is_live() {
                let fixed = &self.fixed[kernel.site(s).id];
                self.margin.cover(kernel, &fixed.point);
            }
        }
    }

    /// A bi-cell with this tolerance has these vertices.
    #[inline(always)]
    pub(in crate::motion) fn lower(&mut self, vertices: &[VertexId], tolerance: f64) {
        for &v in vertices {
            let fixed = &mut self.fixed[v];
            fixed.tolerance = fixed.tolerance.min(tolerance);
        }
    }

    /// Lets all bi-cells lower tolerances, but for those that are `set_aside`, as that says of a bi-cell by fixed
    /// positions, its facet from both sides, its vertices and its tolerance. Every site must be fixed where it is.
    /// Returns the number of bi-cells.
    pub(in crate::motion) fn measure_all(
        &mut self,
        kernel: &Delaunay<G>,
        mut set_aside: impl FnMut(&[Fixed<G>], [Facet; 2], &[VertexId], f64) -> bool,
    ) -> u64 {
        let mut batch = Batch::default();
        let n = for_bicells(kernel, |facet| {
            self.measure::<true>(kernel, facet, &mut batch, &mut set_aside);
        });
        self.lower_batch(&mut batch, &mut set_aside);
        n
    }

    /// Lets the bi-cells of all facets of these cells lower tolerances, but for those that are `set_aside`, see
    /// [`measure_all`](Self::measure_all). All vertices of the cells are fixed where they are. Returns the number of
    /// bi-cells.
    pub(in crate::motion) fn measure_around(
        &mut self,
        kernel: &mut Delaunay<G>,
        cells: &[Slot],
        mut set_aside: impl FnMut(&[Fixed<G>], [Facet; 2], &[VertexId], f64) -> bool,
    ) -> u64 {
        let mut batch = Batch::default();
        let mut n = 0;
        kernel.for_facets_of(cells, |kernel, facet| {
            self.measure::<false>(kernel, facet, &mut batch, &mut set_aside);
            n += 1;
        });
        self.lower_batch(&mut batch, &mut set_aside);
        n
    }

    /// Has a bi-cell computed. `ARE_FIXED` says that all sites are fixed where they are.
    #[inline(always)]
    fn measure<const ARE_FIXED: bool>(
        &mut self,
        kernel: &Delaunay<G>,
        facet: Facet,
        batch: &mut Batch<G>,
        set_aside: &mut impl FnMut(&[Fixed<G>], [Facet; 2], &[VertexId], f64) -> bool,
    ) {
        let bicell = BiCell::of(kernel, facet);
        if !ARE_FIXED {
            for &s in bicell.sites() {
                self.fix_again(kernel.site(s));
            }
        }
        let facets = [facet, kernel.complex().cell(facet.cell()).neighbour(facet.index())];
        match bicell.interior() {
            Some(points) => {
                batch.push(facets, bicell.sites().iter().map(|&s| kernel.site(s).id), points);
                if batch.is_full() {
                    self.lower_batch(batch, set_aside);
                }
            }
            None => {
                let vertices = bicell.vertices(kernel);
                let finite = &vertices[..bicell.sites().len()];
                let tolerance = bicell.hull_tolerance();
                if !set_aside(&self.fixed, facets, finite, tolerance) {
                    self.lower(finite, tolerance);
                }
            }
        }
    }

    /// Computes the tolerances of a batch, which is empty then.
    fn lower_batch(
        &mut self,
        batch: &mut Batch<G>,
        set_aside: &mut impl FnMut(&[Fixed<G>], [Facet; 2], &[VertexId], f64) -> bool,
    ) {
        let mut enough = [0.0; LANES];
        for (enough, vertices) in enough.iter_mut().zip(batch.vertices()) {
            for &v in vertices {
                *enough = self.fixed[v].tolerance.max(*enough);
            }
        }
        batch.empty(&enough, |facets, vertices, tolerance| {
            if !set_aside(&self.fixed, facets, vertices, tolerance) {
                self.lower(vertices, tolerance);
            }
        });
    }
}

impl<G: Moving> Store<G> for Tolerances<G> {
    fn prepare(&mut self, kernel: &mut Delaunay<G>, n_ids: usize, _: TimestampSteps<'_, G>) -> Result<u64> {
        self.fix_all(kernel, n_ids)?;
        Ok(self.measure_all(kernel, |_, _, _, _| false))
    }

    fn follow(
        &mut self,
        kernel: &mut Delaunay<G>,
        site_of: &[SiteId],
        _: TimestampSteps<'_, G>,
        cells: &[Slot],
        relocated: &[VertexId],
    ) -> Result<u64> {
        self.grow(site_of.len())?;
        relocated.iter().for_each(|&v| self.fix(kernel, site_of[v]));
        Ok(self.measure_around(kernel, cells, |_, _, _, _| false))
    }

    fn tighten_filter(&mut self, kernel: &mut Delaunay<G>) {
        self.margin.tighten(kernel);
    }

    fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.fixed)
    }
}
