//! Fixed positions and tolerances of vertices (report, section 2.4).

use crate::complex::Facet;
use crate::delaunay::{Delaunay, Moving, Site};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::filters::bicell::{BiCell, for_bicells};
use crate::motion::filters::margin::Margin;
use crate::motion::filters::store::{Store, TimestampSteps, proto};
use crate::motion::filters::tolerance::batch::Batch;
use crate::predicates::{BiCellTolerances, LANES, PointArray, displacement_limit, distance_above};

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
    /// scratch
    next: Vec<Next<G>>,
}

/// scratch: the least tolerance, the next one, the way from the nearest delimiter, how far that may be followed, and
/// how far the vertex has gone when it was fixed last.
#[derive(Clone, Copy, Debug)]
struct Next<G: Moving> {
    least: f64,
    second: f64,
    away: G::Point,
    room: f64,
    drift: f64,
}

impl<G: Moving> Next<G> {
    fn none() -> Self {
        Next { least: f64::INFINITY, second: f64::INFINITY, away: G::Point::default(), room: 0.0, drift: 0.0 }
    }
}

impl<G: Moving> Tolerances<G> {
    /// A copy.
    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(Tolerances { margin: self.margin, fixed: memory::copy_of(&self.fixed)?, next: self.next.clone() })
    }

    /// Fixed positions and tolerances by vertex id.
    #[inline(always)]
    pub(in crate::motion) fn fixed(&self) -> &[Fixed<G>] {
        &self.fixed
    }

    /// scratch
    pub(in crate::motion) fn set_ball(&mut self, v: VertexId, point: G::Point, radius: f64) {
        self.fixed[v] = Fixed { point, tolerance: radius.min(self.margin.distance()).max(0.0) };
    }

    /// Fixes every vertex where it is; no bi-cell has lowered a tolerance yet.
    pub(in crate::motion) fn fix_all(&mut self, kernel: &mut Delaunay<G>, n_ids: usize) -> Result<()> {
        let former = std::mem::take(&mut self.fixed);
        self.margin = Margin::around_all(kernel);
        self.grow(n_ids)?;
        for site in kernel.sites()[1..].iter().filter(|site| site.is_live()) {
            self.fixed[site.id].point = site.point;
            if proto().capw > 0.0 && !former.is_empty() {
                let former = &former[site.id];
                let moved = distance_above(&former.point, &site.point);
                let most = (proto().capw * former.tolerance).max(proto().steps * moved);
                let tolerance = &mut self.fixed[site.id].tolerance;
                *tolerance = tolerance.min(most);
            }
        }
        Ok(())
    }

    /// Follows the number of ids. New vertices have no bi-cells yet, so no tolerance smaller than any.
    pub(in crate::motion) fn grow(&mut self, n_ids: usize) -> Result<()> {
        let tolerance = self.margin.distance();
        self.next.resize(n_ids, Next::none());
        memory::lengthen(&mut self.fixed, n_ids, Fixed { point: G::Point::default(), tolerance })
    }

    /// Fixes the vertex of a site that has been relocated where it is. All of its bi-cells are going to be computed.
    #[inline(always)]
    pub(in crate::motion) fn fix(&mut self, kernel: &mut Delaunay<G>, s: SiteId) {
        let &Site { point, id, .. } = kernel.site(s);
        self.margin.cover(kernel, &point);
        let mut tolerance = self.margin.distance();
        let moved = distance_above(&self.fixed[id].point, &point);
        if proto().cap > 0.0 && moved < tolerance {
            tolerance = tolerance.min((proto().cap * self.fixed[id].tolerance).max(proto().steps * moved));
        }
        self.next[id] = Next { drift: moved, ..Next::none() };
        self.fixed[id] = Fixed { point, tolerance };
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
        self.next[id].drift = moved;
        Some(moved)
    }

    /// A bi-cell with this tolerance has these vertices.
    #[inline(always)]
    pub(in crate::motion) fn lower(&mut self, vertices: &[VertexId], tolerance: f64) {
        for &v in vertices {
            let fixed = &mut self.fixed[v];
            fixed.tolerance = fixed.tolerance.min(tolerance);
        }
    }

    /// scratch: the delimiter nearer to the vertices that have gone less.
    fn lower_by_share(&mut self, vertices: &[VertexId], tolerance: f64) {
        let points: [&G::Point; 5] = std::array::from_fn(|k| &self.fixed[vertices[k.min(G::D + 1)]].point);
        let (mut half_width, mut exception, mut reach) = (tolerance, 9, f64::INFINITY);
        if G::D == 3 {
            let (delimiter, outside) = G::Point::separated(&points[..G::D + 2]);
            (half_width, exception, reach) = (delimiter.half_width, outside, delimiter.reach);
        }
        let is_outside = |k: usize| k == 0 || k == G::D + 1 || k == exception + 1;
        let mut drifts = [0.0f64; 2];
        for (k, &v) in vertices.iter().enumerate() {
            let of = &mut drifts[usize::from(is_outside(k))];
            *of = of.max(self.next[v].drift);
        }
        let sum = drifts[0] + drifts[1];
        let least = proto().share;
        let share = if sum > 0.0 { (drifts[0] / sum).clamp(least, 1.0 - least) } else { 0.5 };
        for (k, &v) in vertices.iter().enumerate() {
            let share = if is_outside(k) { 1.0 - share } else { share };
            let of_this = (2.0 * half_width * share * (1.0 - 1e-12)).min(reach);
            let fixed = &mut self.fixed[v];
            fixed.tolerance = fixed.tolerance.min(of_this);
        }
    }

    /// scratch: where the nearest delimiter is.
    fn note_next(&mut self, vertices: &[VertexId], tolerance: f64) {
        if vertices.len() != G::D + 2 {
            for &v in vertices {
                let next = &mut self.next[v];
                if tolerance < next.least {
                    (next.second, next.least, next.room) = (next.least, tolerance, 0.0);
                } else {
                    next.second = next.second.min(tolerance);
                }
            }
            return;
        }
        let wanted = vertices.iter().any(|&v| tolerance < self.next[v].least);
        let mut sphere = None;
        if wanted {
            let points: [&G::Point; 5] = std::array::from_fn(|k| &self.fixed[vertices[k.min(G::D + 1)]].point);
            let (delimiter, exception) = G::Point::separated(&points[..G::D + 2]);
            if delimiter.half_width <= delimiter.reach && delimiter.half_width > 0.0 {
                sphere = Some((delimiter.centre, exception, delimiter.reach));
            }
        }
        for (k, &v) in vertices.iter().enumerate() {
            let here = self.fixed[v].point;
            let next = &mut self.next[v];
            if tolerance < next.least {
                next.second = next.least;
                next.least = tolerance;
                next.room = 0.0;
                if let Some((centre, exception, reach)) = sphere {
                    let outside = k == 0 || k == G::D + 1 || k == exception + 1;
                    let mut away = G::Point::default();
                    let mut length = 0.0;
                    for axis in 0..G::D {
                        away[axis] = if outside { here[axis] - centre[axis] } else { centre[axis] - here[axis] };
                        length += away[axis] * away[axis];
                    }
                    let length = length.sqrt();
                    (0..G::D).for_each(|axis| away[axis] /= length);
                    next.away = away;
                    next.room = ((reach - tolerance) / 2.0).min(if outside { 1e9 } else { 0.9 * length });
                }
            } else {
                next.second = next.second.min(tolerance);
            }
        }
    }

    /// scratch: moves the balls of these vertices away from their nearest delimiter.
    fn shift(&mut self, vertices: &[VertexId]) {
        for &v in vertices {
            let (next, fixed) = (self.next[v], &mut self.fixed[v]);
            if next.least < fixed.tolerance || !next.least.is_finite() {
                continue;
            }
            let by = ((next.second - next.least) / 2.0).min(next.room).min(proto().shift * next.least)
                .min((self.margin.distance() - next.least) / 2.0);
            if by > 0.0 {
                for axis in 0..G::D {
                    fixed.point[axis] += by * next.away[axis];
                }
                let size: f64 = (0..G::D).map(|axis| fixed.point[axis].abs()).sum();
                fixed.tolerance = ((next.least + by) * (1.0 - 1e-12) - size * 1e-15).max(0.0);
            }
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
                    if proto().shift > 0.0 {
                        self.note_next(finite, tolerance);
                    }
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
                if proto().share > 0.0 {
                    self.lower_by_share(vertices, tolerance);
                } else {
                    self.lower(vertices, tolerance);
                }
                if proto().shift > 0.0 {
                    self.note_next(vertices, tolerance);
                }
            }
        });
    }
}

impl<G: Moving> Store<G> for Tolerances<G> {
    fn prepare(&mut self, kernel: &mut Delaunay<G>, n_ids: usize, _: TimestampSteps<'_, G>) -> Result<u64> {
        self.fix_all(kernel, n_ids)?;
        self.next.fill(Next::none());
        let n = self.measure_all(kernel, |_, _, _, _| false);
        if proto().shift > 0.0 {
            let all: Vec<VertexId> = VertexId::range(0..n_ids).collect();
            self.shift(&all);
        }
        Ok(n)
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
        let n = self.measure_around(kernel, cells, |_, _, _, _| false);
        if proto().shift > 0.0 {
            self.shift(relocated);
        }
        Ok(n)
    }

    fn tighten_filter(&mut self, kernel: &mut Delaunay<G>) {
        self.margin.tighten(kernel);
    }

    fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.fixed)
    }
}
