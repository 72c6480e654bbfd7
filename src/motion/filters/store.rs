//! What every kind of regions does.

use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};

/// How far vertices go in a timestamp.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct TimestampSteps<'s, G: Moving> {
    /// Positions of the vertices, by id, at the timestamp before or the next one; none if that does not matter.
    pub(in crate::motion) other_positions: &'s [G::Point],
    /// The constant of this name.
    pub(in crate::motion) watched_share: f64,
}

/// Regions of one kind.
pub(in crate::motion) trait Store<G: Moving> {
    /// The report's pre-computations: every vertex is fixed where it is, and every bi-cell is computed. Returns the
    /// number of bi-cells.
    fn prepare(
        &mut self,
        kernel: &mut Delaunay<G>,
        n_ids: usize,
        steps: TimestampSteps<'_, G>,
    ) -> Result<u64>;

    /// Computes the bi-cells of all facets of these cells, each listed once; returns their number. Among the cells are
    /// the stars of the vertices that have been relocated. `site_of` has the site of each vertex, by id.
    fn follow(
        &mut self,
        kernel: &mut Delaunay<G>,
        site_of: &[SiteId],
        steps: TimestampSteps<'_, G>,
        cells: &[Slot],
        relocated: &[VertexId],
    ) -> Result<u64>;

    /// Forgets what is kept of cells that have changed, or are free.
    fn forget_cells(&mut self, _cells: &[Slot]) {}

    /// Makes the kernel's static filter as sharp as what the regions may let pass allows.
    fn tighten_filter(&mut self, kernel: &mut Delaunay<G>);

    fn memory_bytes(&self) -> usize;
}
