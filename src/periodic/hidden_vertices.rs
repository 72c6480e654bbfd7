//! What can be asked of vertices that are hidden.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::periodic::hidden::HiddenHomes;
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// The vertices that are hidden by others at their place in any period, ascending, each with the one that represents them:
    /// the one of the lowest id, with weights of those of the greatest weight.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn hidden_vertices(&self) -> Result<Vec<(VertexId, VertexId)>> {
        Ok(self.inside.hidden_homes(&self.lattice)?.by_place)
    }

    /// The vertices that are hidden by weight, ascending: those that represent their place and are corners of no cell. Each is
    /// listed with the index of a cell that it is above in some period; [`CellId::NONE`] where there are no cells.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn hidden_by_weight(&self) -> Result<Vec<(VertexId, CellId)>> {
        let hidden = self.inside.hidden_homes(&self.lattice)?.by_weight;
        let mut listed = Vec::new();
        memory::reserve_exact(&mut listed, hidden.len())?;
        let cells = self.read_cells()?;
        for vertex in hidden {
            let cell = if self.inside.t.cell_count() == 0 {
                CellId::NONE
            } else {
                let below = self.inside.t.cell_below(self.inside.images.home(vertex))?;
                self.placed_anywhere(cells, below)?.0
            };
            listed.push((vertex, cell));
        }
        Ok(listed)
    }

    /// All vertices that are hidden, by place or by weight, ascending.
    pub(super) fn vertices_in_no_cell(&self) -> Result<Vec<VertexId>> {
        let HiddenHomes { by_place, by_weight } = self.inside.hidden_homes(&self.lattice)?;
        let mut hidden = by_weight;
        memory::collect(&mut hidden, by_place.into_iter().map(|(vertex, _)| vertex))?;
        hidden.sort_unstable();
        Ok(hidden)
    }

    /// The vertex that has the cells at the place of this one; itself where weights hide both.
    ///
    /// # Errors
    /// The errors of [`position`](Self::position).
    pub(super) fn represented(&self, vertex: VertexId) -> Result<VertexId> {
        self.position(vertex)?;
        let corner = self.inside.t.corner_at(self.inside.images.home(vertex));
        Ok(corner.map_or(vertex, |corner| self.inside.images.of(corner).vertex))
    }

    /// The vertex of lowest id of those that share a place with this one, in any period; with weights, of those of the greatest
    /// weight there.
    ///
    /// # Errors
    /// The errors of [`position`](Self::position).
    pub fn coincident_representative(&self, vertex: VertexId) -> Result<VertexId> {
        self.position(vertex)?;
        let (inside, home) = (&self.inside, self.inside.images.home(vertex));
        if !G::HAS_WEIGHTS {
            return Ok(inside.images.of(inside.t.coincident_representative(home)?).vertex);
        }
        if inside.t.cell_count() > 0
            && let Some(corner) = inside.t.corner_at(home)
        {
            return Ok(inside.images.of(corner).vertex);
        }
        // One that is hidden by weight has no images to be found by.
        let there = |other: &VertexId| inside.shift_between(&self.lattice, home, *other).is_some();
        let all = inside.images.homes().map(|(_, other)| other).filter(there);
        Ok(all
            .min_by(|a, b| inside.rank_at_place(*a).total_cmp(&inside.rank_at_place(*b)).then(a.cmp(b)))
            .map_or(vertex, |first| inside.images.of(first).vertex))
    }
}
