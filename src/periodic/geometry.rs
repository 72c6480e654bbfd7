//! Geometry of the cells of a set that repeats.
//!
//! Numbers of a cell are those that it has inside, where its least vertex is at home. What is told of places is so where
//! that vertex is at its own position, as in [`cell_shifts`](PeriodicTriangulation::cell_shifts).

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::{BoundaryFacet, list_boundary, tell_all, without_flat_cells};
use crate::periodic::lattice::HOME;
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// Tells circumcentre and squared circumradius of each cell, or of those of these indices, in their order.
    ///
    /// A coordinate of a centre is off by at most 10⁻⁹ circumradii and its own rounding, where the corner is in another
    /// period than the library has it, by twice that; a squared radius by 4·10⁻⁹ of itself; both by a few last bits unless the
    /// cell is nearly flat.
    ///
    /// # Errors
    /// [`Error::NoSuchCell`], [`Error::OutOfMemory`]; then nothing has been told.
    pub fn for_circumspheres(
        &self,
        cells: Option<&[CellId]>,
        mut tell: impl FnMut(CellId, (G::Point, f64)),
    ) -> Result<()> {
        let (read, t) = (self.read_cells()?, &self.inside.t);
        self.with_inside(cells, |inside| {
            let rows = t.cells()?.corners;
            let spheres = inside.iter().zip(t.circumspheres_of(inside)?);
            tell_all(cells, spheres, |cell, (&there, (mut centre, squared))| {
                let least = rows[there].as_ref()[usize::from(read.least[cell])];
                if self.wraps[self.inside.images.of(least).vertex] != [0; 3] {
                    let home = self.inside.places[least];
                    (0..G::D).for_each(|axis| centre[axis] -= home[axis]);
                    centre = self.at_position(least, &centre);
                }
                tell(cell, (centre, squared));
            });
            Ok(())
        })
    }

    /// Tells the area or volume of each cell, or of those of these indices, in their order: positive, with a relative error of
    /// at most 10⁻⁹, and of a few last bits unless the cell is nearly flat.
    ///
    /// # Errors
    /// The errors of [`for_circumspheres`](Self::for_circumspheres).
    pub fn for_volumes(&self, cells: Option<&[CellId]>, tell: impl FnMut(CellId, f64)) -> Result<()> {
        self.with_inside(cells, |inside| {
            tell_all(cells, self.inside.t.volumes_of(inside)?, tell);
            Ok(())
        })
    }

    /// Tells whether the squared circumradius of each cell, or of those of these indices, in their order, is at most
    /// `squared_radius`, decided exactly.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] if the bound is negative or NaN, and those of
    /// [`for_circumspheres`](Self::for_circumspheres).
    pub fn for_mask_by_circumradius(
        &self,
        squared_radius: f64,
        cells: Option<&[CellId]>,
        tell: impl FnMut(CellId, bool),
    ) -> Result<()> {
        self.with_inside(cells, |inside| {
            tell_all(cells, self.inside.t.mask_by_circumradius_of(inside, squared_radius)?, tell);
            Ok(())
        })
    }

    /// For each cell, in the order of [`cells`](Self::cells), 0 if it is flat and on the hull of a set that is open somewhere, or
    /// beside such a cell; else 1. What is flat, and how it is rounded, is told at
    /// [`MovingTriangulation::mask_without_flat_cells`](crate::motion::MovingTriangulation::mask_without_flat_cells).
    ///
    /// # Errors
    /// [`Error::InvalidValue`] if the tolerance is negative or NaN, [`Error::OutOfMemory`].
    pub fn mask_without_flat_cells(&self, tolerance: f64) -> Result<Vec<u8>> {
        let cells = self.read_cells()?;
        without_flat_cells::<G>(&cells.neighbours, tolerance, |cell| {
            self.corners_of(cells, (cell, HOME)).map(|(_, place)| place)
        })
    }

    /// The facets between cells of which the entry in `mask` is not 0 and cells of which it is 0, or the outside of a set
    /// that is open somewhere: told to `found`, ascending by cell and then by corner, each where the cell has it.
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there is an entry for each cell, [`Error::OutOfMemory`].
    pub fn mask_boundary(&self, mask: &[u8], found: impl FnMut(BoundaryFacet<G::Vertices>)) -> Result<()> {
        self.check_mask(mask.len())?;
        let cells = self.read_cells()?;
        list_boundary(&cells.corners, &cells.neighbours, |cell| mask[cell] != 0, found);
        Ok(())
    }

    /// The facets of the hull of a set that is open somewhere, told as [`mask_boundary`](Self::mask_boundary) does for all
    /// cells. There are none if it repeats in all directions.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn hull_facets(&self, found: impl FnMut(BoundaryFacet<G::Vertices>)) -> Result<()> {
        let cells = self.read_cells()?;
        list_boundary(&cells.corners, &cells.neighbours, |_| true, found);
        Ok(())
    }

    /// There must be an entry for each cell.
    pub(crate) fn check_mask(&self, given: usize) -> Result<()> {
        let wanted = self.cell_count()?;
        if given == wanted {
            Ok(())
        } else {
            Err(Error::WrongCount { argument: "mask_count", given, wanted, coming: 0 })
        }
    }

    /// Looks at all cells, or those of these indices, as they are known inside.
    fn with_inside<R>(
        &self,
        cells: Option<&[CellId]>,
        look: impl FnOnce(&[CellId]) -> Result<R>,
    ) -> Result<R> {
        let chosen = &self.read_cells()?.chosen;
        let Some(cells) = cells else { return look(chosen) };
        if let Some(index) = cells.iter().position(|cell| cell.index() >= chosen.len()) {
            let (argument, cell) = ("cells", cells[index]);
            return Err(Error::NoSuchCell { argument, index, cell, cells: chosen.len() });
        }
        let mut inside = Vec::new();
        memory::collect(&mut inside, cells.iter().map(|&cell| chosen[cell]))?;
        look(&inside)
    }

    /// What is seen from a vertex at home, seen from its position.
    pub(super) fn at_position(&self, inside: VertexId, way: &G::Point) -> G::Point {
        let vertex = self.inside.images.of(inside).vertex;
        let mut place = self.lattice.unwrapped(&self.inside.places[inside], &self.wraps[vertex]);
        (0..G::D).for_each(|axis| place[axis] += way[axis]);
        place
    }
}

#[cfg(test)]
mod tests;
