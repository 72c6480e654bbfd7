//! Labels of regions that follow: the sides of segments keep them.
//!
//! A region is bounded by segments, which move with their ends, keep their sides, and hand them on to the pieces that
//! refinement and splitting make of them. So a label at a side is that of the region there, whatever happens to the cells:
//! nothing has to be kept up to date, and saved data and copies have it.

use super::labels::LabelFound;
use crate::delaunay::Plane;
use crate::error::{Error, Result};
use crate::ids::{CellId, SegmentId};
use crate::machine::memory;
use crate::motion::state::cells::{Cells, NO_CELL};
use crate::motion::state::segments::NO_LABEL;
use crate::motion::triangulation::MovingTriangulation;

impl MovingTriangulation<Plane> {
    /// Gives each side of each segment in force the label of the cell there, in the order of [`cells`](Self::cells);
    /// [`NO_LABEL`] beyond the hull. Segments that are staged keep theirs.
    ///
    /// # Errors
    /// [`Error::WrongCount`]; [`Error::InvalidValue`] if a region has two labels; [`Error::OutOfMemory`].
    pub fn set_regions(&mut self, labels: &[i32]) -> Result<()> {
        self.reject_prepared()?;
        let cells = self.cell_arrays()?;
        let wanted = cells.corners().len();
        if labels.len() != wanted {
            return Err(Error::WrongCount { argument: "labels", given: labels.len(), wanted, coming: 0 });
        }
        for (index, segments) in self.segments_of_cells()?.into_iter().enumerate() {
            let mut across = cells.neighbours()[index].into_iter().zip(segments);
            let is_other = |cell: CellId| cell != NO_CELL && labels[cell.index()] != labels[index];
            if across.any(|(cell, segment)| segment == SegmentId::NONE && is_other(cell)) {
                let wanted = "that of the cells that are reached from there without crossing a segment";
                let value = f64::from(labels[index]);
                return Err(Error::InvalidValue { argument: "labels", index, value, wanted });
            }
        }
        let beside = self.cells_of_segments()?;
        // Nothing fails from here on.
        let enforced = self.mesh.segments.iter_mut().flat_map(|segments| segments.enforced_mut());
        for (segment, row) in enforced.zip(beside) {
            segment.sides = row.map(|cell| labels.get(cell.index()).copied().unwrap_or(NO_LABEL));
        }
        Ok(())
    }

    /// Gives the sides of segments in force, or staged, labels: that on the left, as seen from the first end along it, and
    /// that on the right; [`NO_LABEL`] for none. All of them or, on an error, none.
    ///
    /// # Errors
    /// [`Error::NoSuchSegment`].
    pub fn set_sides(&mut self, given: &[SegmentId], sides: &[[i32; 2]]) -> Result<()> {
        self.reject_prepared()?;
        let segments = self.mesh.segments.as_deref();
        let is_there =
            |&id: &SegmentId| segments.is_some_and(|segments| segments.enforced_or_staged(id).is_some());
        if let Some(index) = given.iter().position(|id| !is_there(id)) {
            let ids = segments.map_or(0, |segments| segments.n_ids());
            return Err(Error::NoSuchSegment { argument: "segments", index, segment: given[index], ids });
        }
        let Some(segments) = &mut self.mesh.segments else { return Ok(()) };
        for (&id, &sides) in given.iter().zip(sides) {
            segments.get_mut(id).expect("it has been looked at").sides = sides;
        }
        Ok(())
    }

    /// Takes all labels away from sides, of staged segments as well.
    ///
    /// # Errors
    /// [`Error::Prepared`].
    pub fn forget_regions(&mut self) -> Result<()> {
        self.reject_prepared()?;
        if let Some(segments) = &mut self.mesh.segments {
            segments.forget_labels();
        }
        Ok(())
    }

    /// Whether a side of a segment, staged ones included, has a label.
    pub fn has_regions(&self) -> bool {
        self.mesh.segments.as_ref().is_some_and(|segments| segments.have_labels())
    }

    /// The label of the region of each cell, in the order of [`cells`](Self::cells): that of the sides of its outer boundary,
    /// or, where these have none, of those around islands; `other` where they have none either, or several, and where the
    /// outside of the hull is reached without crossing a segment. Also, how many cells are undecided: in regions that are
    /// closed, and of which the sides have several labels, or none.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn region_labels(&self, other: i32) -> Result<(Vec<i32>, usize)> {
        let cells = self.cell_arrays()?;
        let told = self.labels_at_edges()?;
        let (regions, is_open) = self.regions(|cell, i| told[cell.index()][i].is_some())?;
        let (mut outer, mut labels) = (Vec::new(), Vec::new());
        memory::lengthen(&mut outer, is_open.len(), LabelFound::Nothing)?;
        for (start, found) in self.outer_edges(&told, &regions, &is_open)?.into_iter().zip(&mut outer) {
            let Some(start) = start else { continue };
            let mut edge = start;
            loop {
                *found = found.or(told[edge.0.index()][edge.1].expect("there is a segment"));
                edge = next_edge(cells, &told, edge);
                if edge == start {
                    break;
                }
            }
        }
        // Where the outer boundary tells nothing, all sides do.
        let mut found = memory::copy_of(&outer)?;
        for (row, &region) in told.iter().zip(&regions) {
            let region = region as usize;
            if outer[region] == LabelFound::Nothing {
                found[region] = row.iter().flatten().fold(found[region], |found, &label| found.or(label));
            }
        }
        let mut n_undecided = 0;
        memory::collect(
            &mut labels,
            regions.iter().map(|&region| match found[region as usize] {
                _ if is_open[region as usize] => other,
                LabelFound::One(label) => label,
                LabelFound::Nothing | LabelFound::Several => {
                    n_undecided += 1;
                    other
                }
            }),
        )?;
        Ok((labels, n_undecided))
    }

    /// For each edge of each cell, opposite its corners, what the sides of the segments there tell of the cell; `None` where
    /// there is no segment.
    fn labels_at_edges(&self) -> Result<Vec<LabelsAtEdges>> {
        let (cells, mut told) = (self.cell_arrays()?, Vec::new());
        memory::lengthen(&mut told, cells.corners().len(), [None; 3])?;
        for ((_, facets), (_, segment)) in self.facets_beside_segments()?.into_iter().zip(self.segments()) {
            for (label, facet) in segment.sides.into_iter().zip(facets) {
                let Some(facet) = facet else { continue };
                let (cell, corner) = cells.shown(facet);
                let found = told[cell.index()][corner].get_or_insert(LabelFound::Nothing);
                if label != NO_LABEL {
                    *found = found.and(label);
                }
            }
        }
        Ok(told)
    }

    /// For each region but the open ones an edge of its outer boundary: one at its leftmost vertex, the lowest of those.
    fn outer_edges(
        &self,
        told: &[LabelsAtEdges],
        regions: &[u32],
        is_open: &[bool],
    ) -> Result<Vec<Option<CellEdge>>> {
        let (cells, mut edges) = (self.cell_arrays()?, Vec::new());
        memory::lengthen(&mut edges, is_open.len(), None)?;
        let mut leftmost = Vec::new();
        memory::lengthen(&mut leftmost, is_open.len(), [f64::INFINITY; 2])?;
        for (cell, row) in CellId::range(0..told.len()).zip(told) {
            let region = regions[cell.index()] as usize;
            for i in (0..3).filter(|&i| row[i].is_some() && !is_open[region]) {
                for end in [(i + 1) % 3, (i + 2) % 3] {
                    let place = self.position(cells.corners()[cell][end])?;
                    if place < leftmost[region] {
                        (edges[region], leftmost[region]) = (Some((cell, i)), place);
                    }
                }
            }
        }
        Ok(edges)
    }
}

/// What is told at the edges of a cell, opposite its corners.
type LabelsAtEdges = [Option<LabelFound>; 3];

/// An edge of a cell, by the corner opposite.
type CellEdge = (CellId, usize);

/// The next edge with a segment around a region, with that on the left: the cells around the end of the edge are crossed.
fn next_edge(cells: &Cells<Plane>, told: &[LabelsAtEdges], (cell, corner): CellEdge) -> CellEdge {
    let end = cells.corners()[cell][(corner + 2) % 3];
    let (mut cell, mut corner) = (cell, (corner + 1) % 3);
    while told[cell.index()][corner].is_none() {
        cell = cells.neighbours()[cell][corner];
        let at = cells.corners()[cell].iter().position(|&v| v == end).expect("a cell around the end");
        corner = (at + 2) % 3;
    }
    (cell, corner)
}
