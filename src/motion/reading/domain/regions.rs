//! Regions: the cells that are reached from each other without crossing a segment.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::delaunay::Plane;
use crate::error::{Error, Result};
use crate::ids::{CellId, SegmentId};
use crate::machine::memory;
use crate::motion::reading::query::Location;
use crate::motion::state::cells::NO_CELL;
use crate::motion::triangulation::MovingTriangulation;

/// The level of a cell that has not been reached.
const UNKNOWN: u32 = u32::MAX;

/// An error about positions, which are those of seeds.
fn of_seeds(mut error: Error) -> Error {
    if let Error::NotFinite { argument, .. } | Error::OutOfRange { argument, .. } = &mut error {
        *argument = "seeds";
    }
    error
}

impl MovingTriangulation<Plane> {
    /// How many segments at least a way crosses from each cell to the outside, in the order of [`cells`](Self::cells).
    /// Cells outside of all closed chains of segments have 0, those of a domain 1, those of a hole in it 2. A segment
    /// with one region on both sides, such as a slit, divides nothing, and several at one edge count once. That is how CGAL
    /// marks domains.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn nesting_levels(&self) -> Result<Vec<u32>> {
        self.least_crossed(|segments| segments.min(1))
    }

    /// How many segments at least a way crosses from each cell to the outside, in the order of [`cells`](Self::cells),
    /// where several at one edge count each. Of closed chains, each way crosses as many but for an even number: an odd one
    /// is what the even-odd rule fills.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn crossing_numbers(&self) -> Result<Vec<u32>> {
        self.least_crossed(|segments| segments)
    }

    /// The least length of a way from each cell to the outside, where an edge with so many segments has this length, which
    /// is 0 without segments and above it with them. All cells of a region have the same.
    fn least_crossed(&self, length: impl Fn(u32) -> u32) -> Result<Vec<u32>> {
        let cells = self.cell_arrays()?;
        let at_edges = self.segments_at_edges()?;
        let mut is_crossed = Vec::new();
        memory::lengthen(&mut is_crossed, cells.corners().len(), [false; 3])?;
        at_edges.iter().for_each(|&(cell, i, _)| is_crossed[cell.index()][i] = true);
        let (regions, is_open) = self.regions(|cell, i| is_crossed[cell.index()][i])?;
        // Ways between regions; the outside is one more, at level 0.
        let outside = is_open.len() as u32;
        let mut ways = Vec::new();
        for &(cell, i, segments) in &at_edges {
            let to = match cells.neighbours()[cell][i] {
                NO_CELL => outside,
                across => regions[across.index()],
            };
            let from = regions[cell.index()];
            if from != to {
                memory::append(&mut ways, &[(to, from, length(segments)), (from, to, length(segments))])?;
            }
        }
        let open = (0..).zip(&is_open).filter(|&(_, &is_open)| is_open);
        memory::collect(&mut ways, open.map(|(region, _)| (outside, region, 0)))?;
        ways.sort_unstable();
        ways.dedup();
        let mut levels = Vec::new();
        memory::lengthen(&mut levels, is_open.len() + 1, UNKNOWN)?;
        let mut waiting = BinaryHeap::new();
        memory::enter(&mut waiting, (Reverse(0), outside))?;
        while let Some((Reverse(level), region)) = waiting.pop() {
            if levels[region as usize] != UNKNOWN {
                continue;
            }
            levels[region as usize] = level;
            let first = ways.partition_point(|&(from, ..)| from < region);
            for &(_, to, length) in ways[first..].iter().take_while(|&&(from, ..)| from == region) {
                if levels[to as usize] == UNKNOWN {
                    memory::enter(&mut waiting, (Reverse(level + length), to))?;
                }
            }
        }
        let mut of_cells = regions;
        of_cells.iter_mut().for_each(|region| *region = levels[*region as usize]);
        Ok(of_cells)
    }

    /// The number of the region of each cell, in the order of [`cells`](Self::cells), and for each region whether the
    /// outside of the hull is reached from it without crossing a segment. `has_segment` tells of the edge of a cell that is
    /// opposite a corner.
    pub(super) fn regions(
        &self,
        has_segment: impl Fn(CellId, usize) -> bool,
    ) -> Result<(Vec<u32>, Vec<bool>)> {
        let cells = self.cell_arrays()?;
        let (mut regions, mut waiting, mut is_open) = (Vec::new(), Vec::new(), Vec::new());
        memory::lengthen(&mut regions, cells.corners().len(), UNKNOWN)?;
        for first in CellId::range(0..cells.corners().len()) {
            if regions[first.index()] != UNKNOWN {
                continue;
            }
            let n = is_open.len();
            memory::push(&mut is_open, false)?;
            regions[first.index()] = n as u32;
            memory::push(&mut waiting, first)?;
            while let Some(cell) = waiting.pop() {
                for (i, across) in cells.neighbours()[cell].into_iter().enumerate() {
                    if has_segment(cell, i) {
                        continue;
                    }
                    if across == NO_CELL {
                        is_open[n] = true;
                    } else if regions[across.index()] == UNKNOWN {
                        regions[across.index()] = n as u32;
                        memory::push(&mut waiting, across)?;
                    }
                }
            }
        }
        Ok((regions, is_open))
    }

    /// The cells that a place is in, or on the boundary of, and `NO_CELL` behind them if it is on the hull: its position is
    /// `q`. None if it is outside.
    fn cells_touching(&self, place: Location, q: &[f64; 2]) -> Result<Vec<CellId>> {
        let (cells, kernel, mut found) = (self.cell_arrays()?, &self.mesh.kernel, Vec::new());
        match place {
            Location::Vertex(v) if kernel.has_cells() => {
                kernel.for_cells_around(self.mesh.site_of[v], |slot| {
                    memory::push(&mut found, cells.index_of()[slot])
                })?;
                let is_on_hull = found.iter().any(|&cell| {
                    let (corners, neighbours) = (cells.corners()[cell], cells.neighbours()[cell]);
                    (0..3).any(|i| neighbours[i] == NO_CELL && corners[i] != v)
                });
                if is_on_hull {
                    memory::push(&mut found, NO_CELL)?;
                }
            }
            Location::Cell(cell) => {
                memory::push(&mut found, cell)?;
                for i in 0..3 {
                    if kernel.is_on_facet(cells.facet(cell, i), q) {
                        memory::push(&mut found, cells.neighbours()[cell][i])?;
                    }
                }
            }
            Location::Vertex(_) | Location::Outside(_) | Location::NoCells => {}
        }
        Ok(found)
    }

    /// A label for each cell, in the order of [`cells`](Self::cells): that of the first seed in its region, or `other`
    /// where there is none. A seed outside of the hull labels nothing.
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`]; [`Error::AmbiguousSeed`] for one on the boundary of several regions, of
    /// which the outside is one; [`Error::OutOfMemory`].
    pub fn label_cells(&self, seeds: &[[f64; 2]], labels: &[i32], other: i32) -> Result<Vec<i32>> {
        let at_edges = self.segments_of_cells()?;
        let (regions, is_open) = self.regions(|cell, i| at_edges[cell.index()][i] != SegmentId::NONE)?;
        let (mut label_of_region, mut places) = (Vec::new(), Vec::new());
        memory::lengthen(&mut label_of_region, is_open.len(), None)?;
        memory::reserve(&mut places, seeds.len())?;
        self.locate_points(seeds, None, |place| places.push(place)).map_err(of_seeds)?;
        for (index, (seed, place)) in seeds.iter().zip(places).enumerate() {
            let touching = self.cells_touching(place, seed)?;
            let Some(first) = touching.first() else { continue };
            let region = regions[first.index()];
            let is_in = |cell: &CellId| match *cell {
                NO_CELL => is_open[region as usize],
                cell => regions[cell.index()] == region,
            };
            if !touching.iter().all(is_in) {
                return Err(Error::AmbiguousSeed { index });
            }
            label_of_region[region as usize].get_or_insert(labels[index]);
        }
        let mut label_of = Vec::new();
        memory::collect(
            &mut label_of,
            regions.iter().map(|&region| label_of_region[region as usize].unwrap_or(other)),
        )?;
        Ok(label_of)
    }
}
