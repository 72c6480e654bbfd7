//! Which vertices are hidden, by what is at their place or, with weights, by the cells that they are above.

use crate::delaunay::{IndexSet, Moving};
use crate::error::Result;
use crate::ids::{CellId, SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::options::CoincidencePolicy;
use crate::motion::report::CommitReport;
use crate::motion::state::mesh::Standing;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::PointArray;

impl<G: Moving> MovingTriangulation<G> {
    /// Among the vertices at the place of this one, the one of the lowest [key](Self::key) and then of the lowest id;
    /// with weights, among those of the greatest weight there, whether that is hidden by others elsewhere or not.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`](crate::Error::NoSuchVertex), [`Error::RemovedVertex`](crate::Error::RemovedVertex); with
    /// weights [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn coincident_representative(&self, vertex: VertexId) -> Result<VertexId> {
        let site = self.mesh.kernel.site(self.present_site("vertex", 0, vertex)?);
        if !G::HAS_WEIGHTS {
            return Ok(site.id);
        }
        let weight = |&v: &VertexId| self.mesh.kernel.site(self.mesh.site_of[v]).point.weight();
        let ranked = |v: VertexId| (v, site.point.as_ref());
        let keys = self.mesh.kernel.keys();
        let there = self.vertices_in_box(&site.point, &site.point)?.into_iter();
        let first = there.min_by(|v, w| {
            weight(w).total_cmp(&weight(v)).then_with(|| keys.compare_at(ranked(*v), ranked(*w)))
        });
        Ok(first.unwrap_or(vertex))
    }

    /// The vertices that are hidden, ascending, each with the one that represents it.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0]];
    /// let t = MovingTriangulation::<Plane>::new(&points, Options::default())?;
    /// let hidden: Vec<_> = t.hidden_vertices().collect();
    /// assert_eq!(hidden, [(VertexId::new(3), VertexId::new(1))]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    pub fn hidden_vertices(&self) -> impl Iterator<Item = (VertexId, VertexId)> {
        let n = if self.hidden_count() == 0 { 0 } else { self.id_count() };
        VertexId::range(0..n).filter_map(|v| match self.mesh.standing(v) {
            Standing::Hidden(s) => Some((v, self.mesh.kernel.site(s).id)),
            Standing::Shown(_) | Standing::Above(_) | Standing::Gone => None,
        })
    }

    /// The vertices that are hidden by another one at their place, ascending, each with the one that represents it.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn hidden_by_place(&self) -> Result<Vec<(VertexId, VertexId)>> {
        if G::HAS_WEIGHTS {
            return Ok(self.mesh.vertices_in_no_cell()?.by_place);
        }
        let mut hidden = Vec::new();
        memory::collect(&mut hidden, self.hidden_vertices())?;
        Ok(hidden)
    }

    /// The vertices that are hidden by weight, ascending: those that represent their place and are corners of no cell. Each is listed
    /// with the index of the cell that it is above, the lowest one if its place is on the boundary of several. Where there are no cells
    /// that is [`CellId::NONE`], and the lower hull in the dimension that all vertices span says who is hidden, at the cost of a build.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn hidden_by_weight(&self) -> Result<Vec<(VertexId, CellId)>> {
        let mut hidden = Vec::new();
        if G::HAS_WEIGHTS {
            let index_of = self.cell_arrays()?.index_of();
            for covered in self.mesh.vertices_in_no_cell()?.by_weight {
                let s = self.mesh.site_of[covered.vertex];
                let cell = self.lowest_cell_at(s, covered.cell, index_of)?;
                memory::push(&mut hidden, (covered.vertex, cell))?;
            }
        }
        Ok(hidden)
    }

    /// The corner of cells at the place of a vertex; none at one that is hidden by weight. There must be cells.
    pub(crate) fn corner_at(&self, vertex: VertexId) -> Option<VertexId> {
        let (mesh, s) = (&self.mesh, self.mesh.site_of[vertex]);
        let corner = if G::HAS_WEIGHTS { mesh.shown_at(s) } else { Some(s) };
        corner.map(|s| mesh.kernel.site(s).id)
    }

    /// The cell that a vertex hidden by weight is above: of several the one of the lowest index.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn cell_below(&self, vertex: VertexId) -> Result<CellId> {
        let s = self.mesh.site_of[vertex];
        self.lowest_cell_at(s, self.mesh.kernel.cell_below(s), self.cell_arrays()?.index_of())
    }

    /// Of the cells that have the place of a hidden site in their closure, of which one is given, the lowest index: it does not depend
    /// on where the site has been looked for. [`CellId::NONE`] where there are no cells.
    pub(in crate::motion) fn lowest_cell_at(
        &self,
        s: SiteId,
        one: Slot,
        index_of: &[CellId],
    ) -> Result<CellId> {
        if one == Slot::NONE {
            return Ok(CellId::NONE);
        }
        let (kernel, mut cells) = (&self.mesh.kernel, IndexSet::new());
        kernel.list_cells_at(&kernel.site(s).point, one, &mut cells)?;
        Ok(cells.as_slice().iter().map(|&slot| index_of[slot]).min().unwrap_or(CellId::NONE))
    }

    /// The vertices that are corners of no cell, ascending, in a triangulation with weights: those of
    /// [`hidden_by_weight`](Self::hidden_by_weight) and of [`hidden_by_place`](Self::hidden_by_place). Where there are no cells the lower
    /// hull in the dimension that all vertices span says who is hidden, at the cost of a build.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn vertices_hidden_by_weight(&self) -> Result<Vec<VertexId>> {
        let kernel = &self.mesh.kernel;
        let mut hidden = Vec::new();
        if kernel.has_cells() {
            let n = if kernel.n_hidden() == 0 { 0 } else { self.id_count() };
            let are_covered = |&v: &VertexId| matches!(self.mesh.standing(v), Standing::Above(_));
            memory::collect(&mut hidden, VertexId::range(0..n).filter(are_covered))?;
        } else {
            let sites = kernel.hidden_without_cells()?;
            memory::collect(&mut hidden, sites.into_iter().map(|s| kernel.site(s).id))?;
            hidden.sort_unstable();
        }
        Ok(hidden)
    }

    /// Sums over all commits and immediate calls, with who is hidden now.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory), with weights.
    pub fn statistics_of_now(&self) -> Result<CommitReport> {
        let mut statistics = self.statistics;
        if G::HAS_WEIGHTS {
            (statistics.coincident, statistics.hidden_by_weight) = match self.mesh.known_counts() {
                Some(known) => known,
                None => {
                    let now = self.mesh.hidden_in(&self.mesh.kernel, CoincidencePolicy::Merge)?;
                    (now.by_place, now.by_weight)
                }
            };
        }
        Ok(statistics)
    }
}
