//! The cells that a new vertex would remove: those in conflict with a place.
//!
//! Cells in conflict are connected by facets. The cell that holds the place is among them, or one beyond whose facet it
//! is; with weights, if any is.

use crate::complex::Corners;
use crate::delaunay::{Delaunay, IndexSet, Moving, Place};
use crate::error::Result;
use crate::ids::{CellId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::reading::query::{Location, cells_at};
use crate::motion::state::checking::check_position;
use crate::motion::triangulation::MovingTriangulation;

/// Enters the cells in conflict with a place that is at no site into an empty set, ghost cells included. `first` is the
/// cell that holds the place, or the ghost cell beyond whose facet it is.
fn list_conflicts<G: Moving>(
    kernel: &Delaunay<G>,
    first: Slot,
    q: &G::Point,
    zone: &mut IndexSet<Slot>,
) -> Result<()> {
    let filter = kernel.filter_for(q);
    zone.insert(first)?;
    let mut next = 0;
    while let Some(&inside) = zone.as_slice().get(next) {
        next += 1;
        for i in 0..G::Corners::N {
            if kernel.is_facet_required(inside, i) {
                continue;
            }
            let across = kernel.complex().cell(inside).neighbour(i).cell();
            // Ties are broken as for a vertex of the highest id.
            if kernel.is_in_conflict_with(&filter, across, q, VertexId::NONE) {
                zone.insert(across)?;
            }
        }
    }
    Ok(())
}

impl<G: Moving> MovingTriangulation<G> {
    /// Whether the insertion of a vertex at a place, at which there is none, would remove a cell. Ties are broken as for a vertex of
    /// the highest id.
    pub(crate) fn is_in_conflict(&self, cell: CellId, q: &G::Point) -> Result<bool> {
        let (slot, kernel) = (self.cell_arrays()?.slots()[cell], &self.mesh.kernel);
        Ok(kernel.is_in_conflict_with(&kernel.filter_for(q), slot, q, VertexId::NONE))
    }

    /// The cells that the insertion of a vertex would remove: those whose circle or sphere has `position` inside, with
    /// ties broken as for a vertex of the highest id. None at the place of a vertex, nor while there are no cells. It
    /// is looked for from `near`, if that is near it.
    ///
    /// With weights they are those of whose power sphere the place, with its own weight, is inside: none if the vertex
    /// would be hidden, and at the place of a vertex those that one of greater weight would remove.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// assert_eq!(t.conflicts(&[0.5, 0.4], None)?.len(), 2);
    /// assert!(t.conflicts(&[1.0, 1.0], None)?.is_empty());
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`](crate::Error::NotFinite), [`Error::OutOfRange`](crate::Error::OutOfRange),
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn conflicts(&self, position: &G::Point, near: Option<Location>) -> Result<Vec<CellId>> {
        let q = check_position::<G>("position", 0, position)?;
        let index_of = self.cell_arrays()?.index_of();
        let (mut zone, mut cells) = (IndexSet::new(), Vec::new());
        let kernel = &self.mesh.kernel;
        let first = match kernel.locate(&q, self.start_near(near)?) {
            Place::Cell(first) | Place::Outside(first) => first,
            Place::Site(s) if G::HAS_WEIGHTS => kernel.site(s).cell,
            Place::Site(_) | Place::NoCells => return Ok(cells),
        };
        // With weights the vertex may be above the cell that has its place.
        if !G::HAS_WEIGHTS || kernel.is_in_conflict(first, &q, VertexId::NONE) {
            list_conflicts(kernel, first, &q, &mut zone)?;
            memory::collect(&mut cells, cells_at(&zone, index_of))?;
        }
        Ok(cells)
    }
}
