//! The facets around some of the cells, seen from outside.

use crate::complex::Corners;
use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::{CellId, VertexId};
use crate::motion::state::cells::NO_CELL;
use crate::motion::triangulation::MovingTriangulation;

/// A facet between a cell in a set and one that is not, or the outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoundaryFacet<C> {
    /// The cell in the set.
    pub cell: CellId,
    /// The corner opposite the facet in its row.
    pub corner: usize,
    /// All corners of the cell, the facet's first: these are counter-clockwise seen from outside, and in the plane have
    /// the cell on their left. The corner opposite the facet is the last.
    row: C,
}

/// The corners of a facet, seen from outside of the cell, then the one opposite it; by this one.
const OUTWARD_2D: [[usize; 4]; 3] = [[1, 2, 0, 0], [2, 0, 1, 0], [0, 1, 2, 0]];
const OUTWARD_3D: [[usize; 4]; 4] = [[1, 2, 3, 0], [0, 3, 2, 1], [0, 1, 3, 2], [0, 2, 1, 3]];

impl<C: Corners<VertexId>> BoundaryFacet<C> {
    #[inline(always)]
    fn new(cell: CellId, corner: usize, row: &C) -> Self {
        let order = if C::N == 3 { OUTWARD_2D[corner] } else { OUTWARD_3D[corner] };
        let mut ordered = *row;
        (0..C::N).for_each(|i| ordered[i] = row[order[i]]);
        BoundaryFacet { cell, corner, row: ordered }
    }

    /// The vertices of the facet: counter-clockwise seen from outside; in the plane the cell is on the left of the edge
    /// from the first to the second.
    #[inline(always)]
    pub fn vertices(&self) -> &[VertexId] {
        &self.row.as_ref()[..C::N - 1]
    }
}

impl<G: Moving> MovingTriangulation<G> {
    /// The facets between cells of which the entry in `mask`, by index in [`cells`](Self::cells), is not 0 and cells of
    /// which it is 0 or the outside: told to `found`, ascending by cell and then by corner.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let mut edges = Vec::new();
    /// t.mask_boundary(&[1, 0], |facet| edges.push([facet.vertices()[0], facet.vertices()[1]]))?;
    /// assert_eq!(edges.len(), 3); // around the first triangle
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there is an entry for each cell, [`Error::OutOfMemory`].
    pub fn mask_boundary(&self, mask: &[u8], found: impl FnMut(BoundaryFacet<G::Vertices>)) -> Result<()> {
        self.check_mask(mask.len())?;
        let cells = self.cell_arrays()?;
        list_boundary(
            cells.corners(),
            cells.neighbours(),
            #[inline(always)]
            |cell| mask[cell] != 0,
            found,
        );
        Ok(())
    }

    /// There must be an entry for each cell.
    pub(crate) fn check_mask(&self, given: usize) -> Result<()> {
        let wanted = self.cell_count();
        if given == wanted {
            Ok(())
        } else {
            Err(Error::WrongCount { argument: "mask_count", given, wanted, coming: 0 })
        }
    }

    /// The facets of the convex hull: told as [`mask_boundary`](Self::mask_boundary) does for all cells.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn hull_facets(&self, found: impl FnMut(BoundaryFacet<G::Vertices>)) -> Result<()> {
        let cells = self.cell_arrays()?;
        list_boundary(cells.corners(), cells.neighbours(), |_| true, found);
        Ok(())
    }

    /// Number of facets of the convex hull.
    pub fn hull_facet_count(&self) -> usize {
        self.mesh.kernel.complex().n_ghosts()
    }
}

/// The facets between cells that are in a set and those that are not, or the outside, ascending by cell and then by corner.
#[inline(always)]
pub(crate) fn list_boundary<C: Corners<VertexId>, N: Corners<CellId>>(
    corners: &[C],
    neighbours: &[N],
    is_in: impl Fn(CellId) -> bool,
    mut found: impl FnMut(BoundaryFacet<C>),
) {
    for (cell, (row, beside)) in CellId::range(0..corners.len()).zip(corners.iter().zip(neighbours)) {
        if !is_in(cell) {
            continue;
        }
        for corner in 0..C::N {
            let across = beside[corner];
            if across == NO_CELL || !is_in(across) {
                found(BoundaryFacet::new(cell, corner, row));
            }
        }
    }
}
