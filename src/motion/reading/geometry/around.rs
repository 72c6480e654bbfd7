//! The cells around some of the vertices.
//!
//! Of few vertices the stars are listed and sorted. Where they are many, a pass over all cells looks for those that
//! have a vertex of the list as a corner.

use crate::complex::Corners;
use crate::delaunay::{IndexSet, Moving};
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::prefetch;
use crate::motion::reading::query::cells_at;
use crate::motion::state::cells::Cells;
use crate::motion::state::marks::Bits;
use crate::motion::state::mesh::Standing;
use crate::motion::triangulation::MovingTriangulation;

/// The share of the vertices from which on a pass over all cells is faster than their stars: of 100,000 vertices 0.03
/// in the plane and 0.02 in space, with hardly a difference in between.
const LEAST_SHARE: f64 = 0.025;

/// Steps in which the star of a vertex is asked for, and how many vertices in advance to begin each.
const STEPS: usize = 4;
const VERTICES_PER_STEP: usize = 2;

impl<G: Moving> MovingTriangulation<G> {
    /// The cells of which at least one of these vertices is a corner: ascending, each once. Vertices may be listed more
    /// than once; hidden ones have no cells.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`](crate::Error::NoSuchVertex), [`Error::RemovedVertex`](crate::Error::RemovedVertex),
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn cells_around(&self, vertices: &[VertexId]) -> Result<Vec<CellId>> {
        for (index, &vertex) in vertices.iter().enumerate() {
            self.present_site("vertices", index, vertex)?;
        }
        let cells = self.cell_arrays()?;
        if cells.corners().is_empty() {
            return Ok(Vec::new());
        }
        if vertices.len() as f64 > LEAST_SHARE * self.vertex_count() as f64 {
            self.find_around(cells, vertices)
        } else {
            self.list_around(cells, vertices)
        }
    }

    /// The vertices of which a mask has an entry that is not 0, but for hidden and removed ones.
    pub(super) fn shown_in(&self, mask: &[u8]) -> Result<Vec<VertexId>> {
        let mut shown = Vec::new();
        let is_shown = |v: &VertexId| matches!(self.mesh.standing(*v), Standing::Shown(_));
        let masked = VertexId::range(0..mask.len()).filter(|v| mask[v.index()] != 0);
        memory::collect(&mut shown, masked.filter(is_shown))?;
        Ok(shown)
    }

    /// The cells around vertices, from their stars.
    fn list_around(&self, cells: &Cells<G>, vertices: &[VertexId]) -> Result<Vec<CellId>> {
        let index_of = cells.index_of();
        let (mut list, mut star) = (Vec::new(), IndexSet::new());
        for (k, &vertex) in vertices.iter().enumerate() {
            for step in 0..STEPS {
                if let Some(&next) = vertices.get(k + VERTICES_PER_STEP * (STEPS - step)) {
                    self.mesh.kernel.prefetch_star(self.mesh.site_of[next], step);
                }
            }
            let Standing::Shown(s) = self.mesh.standing(vertex) else { continue };
            star.clear();
            self.mesh.kernel.list_star(s, &mut star, |slot| prefetch(index_of, slot.index()))?;
            memory::reserve(&mut list, star.as_slice().len())?;
            list.extend(cells_at(&star, index_of));
        }
        list.sort_unstable();
        list.dedup();
        Ok(list)
    }

    /// The cells around vertices, by a pass over all cells.
    fn find_around(&self, cells: &Cells<G>, vertices: &[VertexId]) -> Result<Vec<CellId>> {
        let mut is_listed = Bits::default();
        is_listed.grow(self.id_count())?;
        vertices.iter().for_each(|&vertex| _ = is_listed.insert(vertex));
        let corners = cells.corners();
        let mut list = Vec::new();
        memory::lengthen(&mut list, corners.len(), CellId::NONE)?;
        let mut n = 0;
        for (cell, row) in CellId::range(0..corners.len()).zip(corners) {
            // No branch, as the answer cannot be predicted: what is not to stay is overwritten.
            list[n] = cell;
            n +=
                usize::from((0..G::Corners::N).fold(false, |is_around, i| is_around | is_listed.has(row[i])));
        }
        list.truncate(n);
        Ok(list)
    }
}
