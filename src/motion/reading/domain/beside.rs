//! Which segment is at which edge of which cell.

use crate::complex::Facet;
use crate::delaunay::Plane;
use crate::error::Result;
use crate::ids::{CellId, SegmentId};
use crate::machine::memory;
use crate::motion::state::cells::NO_CELL;
use crate::motion::triangulation::MovingTriangulation;

impl MovingTriangulation<Plane> {
    /// The cells to the left and to the right of each segment in force, as seen from its first end, in the order of
    /// [`segments`](Self::segments); `None` for the outside, and while there are no cells.
    pub(super) fn facets_beside_segments(&self) -> Result<Vec<(SegmentId, [Option<Facet>; 2])>> {
        let (mut facets, kernel) = (Vec::new(), &self.mesh.kernel);
        memory::reserve(&mut facets, self.segments().count())?;
        for (id, segment) in self.segments() {
            let sides = if kernel.has_cells() {
                kernel.cells_beside(segment.ends.map(|v| self.mesh.site_of[v]))?
            } else {
                [None; 2]
            };
            facets.push((id, sides));
        }
        Ok(facets)
    }

    /// For each cell and each of its corners the segment at the edge opposite it, in the order of
    /// [`cells`](Self::cells): the lowest id if there are several, [`SegmentId::NONE`] if there is none.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn segments_of_cells(&self) -> Result<Vec<[SegmentId; 3]>> {
        self.rows_of_cells(SegmentId::NONE, |entry, id| *entry = id.min(*entry))
    }

    /// The edges of cells at segments, by cell and the corner opposite, ascending, each with how many segments there
    /// are.
    pub(super) fn segments_at_edges(&self) -> Result<Vec<(CellId, usize, u32)>> {
        let (cells, mut edges) = (self.cell_arrays()?, Vec::new());
        let facets = self.facets_beside_segments()?;
        memory::reserve(&mut edges, 2 * facets.len())?;
        let facets = facets.into_iter().flat_map(|(_, sides)| sides).flatten();
        edges.extend(facets.map(|facet| cells.shown(facet)).map(|(cell, corner)| (cell, corner, 1)));
        edges.sort_unstable();
        edges.dedup_by(|next, edge| {
            let is_same = (next.0, next.1) == (edge.0, edge.1);
            edge.2 += u32::from(is_same);
            is_same
        });
        Ok(edges)
    }

    /// A row for each cell, in which each segment enters itself where it is opposite a corner.
    fn rows_of_cells<T: Copy>(&self, none: T, enter: impl Fn(&mut T, SegmentId)) -> Result<Vec<[T; 3]>> {
        let cells = self.cell_arrays()?;
        let mut rows = Vec::new();
        memory::lengthen(&mut rows, cells.corners().len(), [none; 3])?;
        for (id, sides) in self.facets_beside_segments()? {
            for facet in sides.into_iter().flatten() {
                let (cell, corner) = cells.shown(facet);
                enter(&mut rows[cell.index()][corner], id);
            }
        }
        Ok(rows)
    }

    /// The cells to the left and to the right of each segment in force, as seen from its first end, in the order of
    /// [`segments`](Self::segments); [`NO_CELL`] for the outside, and while there are no cells.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn cells_of_segments(&self) -> Result<Vec<[CellId; 2]>> {
        let (cells, mut rows) = (self.cell_arrays()?, Vec::new());
        let facets = self.facets_beside_segments()?;
        memory::collect(
            &mut rows,
            facets.iter().map(|(_, sides)| {
                sides.map(|side| side.map_or(NO_CELL, |facet| cells.index_of()[facet.cell()]))
            }),
        )?;
        Ok(rows)
    }
}
