//! The cells of a set that repeats, one of each class of translations of each other.

use super::lattice::{HOME, Shift};
use crate::complex::Corners;
use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::MovingTriangulation;

/// Cells, each with its least vertex at home: the one of the lowest id, and of several images of that the first in the order
/// of coordinates.
#[derive(Debug)]
pub(super) struct PeriodicCells<G: Dimension> {
    pub(super) corners: Vec<G::Vertices>,
    /// D + 1 for each cell.
    pub(super) shifts: Vec<Shift>,
    /// The cell inside.
    pub(super) inside: Vec<CellId>,
}

impl<G: Dimension> Default for PeriodicCells<G> {
    fn default() -> Self {
        PeriodicCells { corners: Vec::new(), shifts: Vec::new(), inside: Vec::new() }
    }
}

impl<G: Dimension> PeriodicCells<G> {
    /// Reads all cells.
    pub(super) fn read(
        &mut self,
        t: &MovingTriangulation<G>,
        images: &[(VertexId, Shift)],
        n_vertices: usize,
    ) -> Result<()> {
        self.corners.clear();
        self.shifts.clear();
        self.inside.clear();
        for (cell, row) in t.cells()?.corners.iter().enumerate() {
            let row = row.as_ref();
            if row.iter().all(|v| v.index() >= n_vertices) {
                continue;
            }
            let mut least = row[0];
            for &v in &row[1..] {
                if is_before(t, images, v, least)? {
                    least = v;
                }
            }
            if images[least].1 != HOME {
                continue;
            }
            let mut corners = t.cells()?.corners[cell];
            for i in 0..G::Vertices::N {
                memory::push(&mut self.shifts, images[row[i]].1)?;
                corners[i] = images[row[i]].0;
            }
            memory::push(&mut self.corners, corners)?;
            memory::push(&mut self.inside, CellId::new(cell as u32))?;
        }
        Ok(())
    }
}

/// Whether one image is less than another: by vertex, and of images of one, by position.
fn is_before<G: Dimension>(
    t: &MovingTriangulation<G>,
    images: &[(VertexId, Shift)],
    one: VertexId,
    other: VertexId,
) -> Result<bool> {
    let (u, w) = (images[one].0, images[other].0);
    if u != w {
        return Ok(u < w);
    }
    let (p, q) = (t.position(one)?, t.position(other)?);
    Ok(p.as_ref().partial_cmp(q.as_ref()).is_some_and(std::cmp::Ordering::is_lt))
}
