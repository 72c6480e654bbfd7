//! The weights of a place in a cell: its barycentric coordinates.
//!
//! Each is a quotient of volumes: that of the cell with the place for the corner, over that of the cell. Orientations
//! tell the sign exactly. Volumes have a relative error of 1.2·10⁻¹³ at most (`predicates/measures.rs`), and so a
//! weight has one of 2.5·10⁻¹³ at most, however flat the cell, as far as it is in the range of numbers.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::CellId;
use crate::motion::filters::barycentric::barycentric;
use crate::motion::state::checking::check_position;
use crate::motion::triangulation::MovingTriangulation;

impl<G: Moving> MovingTriangulation<G> {
    /// The barycentric coordinates of each place in the cell of the same index of the list: told to `found`, one for
    /// each corner in the order of [`cells`](Self::cells), or `None` where the cell is [`CellId::NONE`]. The place may
    /// be outside of the cell: then some are negative.
    ///
    /// A weight has a relative error of at most 2.5·10⁻¹³, unless a volume or the weight itself is below the least
    /// normal number; its sign is exact, and 0 is. What is beyond the range of numbers is infinite.
    ///
    /// ```
    /// use deldrift::{CellId, Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let mut found = Vec::new();
    /// t.barycentric(&[[1.0, 2.0]], &[CellId::new(0)], |weights| found.extend(weights.map(<[f64]>::to_vec)))?;
    /// let of_vertex = |k| t.cells().unwrap().corners[0].iter().position(|&v| v == VertexId::new(k)).unwrap();
    /// assert_eq!([0, 1, 2].map(|k| found[0][of_vertex(k)]), [0.25, 0.25, 0.5]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there are as many cells as positions; [`Error::NotFinite`] and
    /// [`Error::OutOfRange`] for a place, [`Error::NoSuchCell`], [`Error::OutOfMemory`]: before anything is told.
    pub fn barycentric(
        &self,
        positions: &[G::Point],
        cells: &[CellId],
        mut found: impl FnMut(Option<&[f64]>),
    ) -> Result<()> {
        if cells.len() != positions.len() {
            let (given, wanted) = (cells.len(), positions.len());
            return Err(Error::WrongCount { argument: "the length of cells", given, wanted, coming: 0 });
        }
        let corners = self.cell_arrays()?.corners();
        for (index, (position, &cell)) in positions.iter().zip(cells).enumerate() {
            check_position::<G>("positions", index, position)?;
            if cell != CellId::NONE && cell.index() >= corners.len() {
                return Err(Error::NoSuchCell { argument: "cells", index, cell, cells: corners.len() });
            }
        }
        for (q, &cell) in positions.iter().zip(cells) {
            if cell == CellId::NONE {
                found(None);
                continue;
            }
            let mut places = [q; 4];
            for (place, &vertex) in places.iter_mut().zip(corners[cell].as_ref()) {
                *place = self.mesh.kernel.place(self.mesh.site_of[vertex]);
            }
            found(Some(&barycentric(&self.mesh.kernel, &places[..=G::D], q)[..=G::D]));
        }
        Ok(())
    }
}
