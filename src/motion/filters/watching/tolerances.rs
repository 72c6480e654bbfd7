//! A tolerance for each vertex, and the bi-cells that are watched instead of lowering it.

use crate::complex::Facet;
use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::motion::filters::store::{Store, TimestampSteps};
use crate::motion::filters::tolerance::{Fixed, Tolerances};
use crate::motion::filters::watching::watched::WatchedFacets;
use crate::predicates::squared_distance;

/// A bi-cell is either watched, and lowers no tolerance, or has lowered those of its vertices.
#[derive(Debug, Default)]
pub(in crate::motion) struct Watching<G: Moving> {
    tolerances: Tolerances<G>,
    watched: WatchedFacets,
}

impl<G: Moving> Watching<G> {
    /// A copy.
    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(Watching { tolerances: self.tolerances.copied()?, watched: self.watched.copied()? })
    }

    /// Fixed positions and tolerances by vertex id.
    #[inline(always)]
    pub(in crate::motion) fn fixed(&self) -> &[Fixed<G>] {
        self.tolerances.fixed()
    }

    /// About how many facets are watched.
    pub(in crate::motion) fn n_watched(&self) -> usize {
        self.watched.len()
    }

    /// Visits the facets that are watched.
    pub(in crate::motion) fn for_watched(&mut self, kernel: &Delaunay<G>, visit: impl FnMut(Facet)) {
        self.watched.for_each(kernel, visit);
    }

    /// Computes the bi-cells of all facets of these cells, each listed once; returns their number. Among the cells are
    /// the stars of the sites that have been relocated.
    pub(in crate::motion) fn recompute(
        &mut self,
        kernel: &mut Delaunay<G>,
        steps: TimestampSteps<'_, G>,
        cells: &[Slot],
        relocated: impl Iterator<Item = SiteId>,
    ) -> u64 {
        let Watching { tolerances, watched } = self;
        relocated.for_each(|s| tolerances.fix(kernel, s));
        tolerances.measure_around(kernel, cells, |fixed, facets, vertices, tolerance| {
            watched.set(facets, is_soon_beyond(fixed, vertices, tolerance, steps, f64::INFINITY))
        })
    }
}

/// Whether a bi-cell's tolerance is so small, next to its size h and the displacement u of its vertices from one
/// timestamp to the next, that watching it is cheaper than recomputing stars now and then. Watching those
/// below θ costs in proportion to θ / h, what is recomputed in proportion to u / θ; so the best θ² is in
/// proportion to u h. `longest` is the square of a length that no step exceeds.
#[inline(always)]
fn is_soon_beyond<G: Moving>(
    fixed: &[Fixed<G>],
    vertices: &[VertexId],
    tolerance: f64,
    steps: TimestampSteps<'_, G>,
    longest: f64,
) -> bool {
    let square = squared_distance(fixed[vertices[1]].point(), fixed[vertices[2]].point());
    let t = tolerance * tolerance;
    let is_small_for = |step: f64| t * t <= steps.watched_share * step * square;
    // Nearly all bi-cells are large enough for the longest step of all. (Where that is infinite, the product may be no
    // number, which says nothing.)
    (is_small_for(longest) || longest.is_infinite()) && is_small_for(longest_step(fixed, vertices, steps))
}

/// The longest way of a vertex of a bi-cell in the last timestamp, squared. Out of the loop, which hardly ever asks.
#[inline(never)]
fn longest_step<G: Moving>(fixed: &[Fixed<G>], vertices: &[VertexId], steps: TimestampSteps<'_, G>) -> f64 {
    let here = |v: VertexId| fixed[v].point();
    let from_one = |&v: &VertexId| squared_distance(here(vertices[1]), here(v));
    let greatest = vertices.iter().map(from_one).fold(0.0, f64::max);
    // A step longer than the bi-cell is a leap, which tells nothing about the next step.
    let step = |&v: &VertexId| {
        let there = steps.other_positions.get(v.index());
        there.map(|p| squared_distance(here(v), p)).filter(|&step| step <= greatest).unwrap_or(0.0)
    };
    vertices.iter().map(step).fold(0.0, f64::max)
}

impl<G: Moving> Store<G> for Watching<G> {
    fn prepare(
        &mut self,
        kernel: &mut Delaunay<G>,
        n_ids: usize,
        steps: TimestampSteps<'_, G>,
    ) -> Result<u64> {
        let Watching { tolerances, watched } = self;
        watched.clear();
        tolerances.fix_all(kernel, n_ids)?;
        watched.grow(kernel.complex().n_slots())?;
        let pairs = tolerances.fixed().iter().zip(steps.other_positions);
        let longest = pairs.map(|(fixed, p)| squared_distance(fixed.point(), p)).fold(0.0, f64::max);
        Ok(tolerances.measure_all(kernel, |fixed, facets, vertices, tolerance| {
            watched.set(facets, is_soon_beyond(fixed, vertices, tolerance, steps, longest))
        }))
    }

    fn follow(
        &mut self,
        kernel: &mut Delaunay<G>,
        site_of: &[SiteId],
        steps: TimestampSteps<'_, G>,
        cells: &[Slot],
        relocated: &[VertexId],
    ) -> Result<u64> {
        self.tolerances.grow(site_of.len())?;
        self.watched.grow(kernel.complex().n_slots())?;
        Ok(self.recompute(kernel, steps, cells, relocated.iter().map(|&v| site_of[v])))
    }

    fn forget_cells(&mut self, cells: &[Slot]) {
        self.watched.forget(cells);
    }

    fn tighten_filter(&mut self, kernel: &mut Delaunay<G>) {
        self.tolerances.tighten_filter(kernel);
    }

    fn memory_bytes(&self) -> usize {
        self.tolerances.memory_bytes() + self.watched.memory_bytes()
    }
}
