//! MEDIT's text format, as read by Mmg, FreeFem, Gmsh and others (P. Frey: *MEDIT, an interactive mesh visualization
//! software*, INRIA technical report RT-0253, 2001).

use crate::delaunay::Dimension;
use crate::error::{Error, Result};
use crate::motion::reading::chunks::Chunks;
use crate::motion::reading::exporting::rank;
use crate::motion::triangulation::MovingTriangulation;

impl<G: Dimension> MovingTriangulation<G> {
    /// Hands on the text of a `.mesh` file, some thousand bytes at a time. Vertices are numbered from 1; the reference
    /// of each is its id, that of cells is 1. Coordinates have as many digits as tell them apart.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], before the first byte; and those of `put`, with which it ends.
    pub fn write_medit<E: From<Error>>(&self, put: impl FnMut(&[u8]) -> Result<(), E>) -> Result<(), E> {
        let (cells, ranks) = (self.cells()?, self.ranks()?);
        let mut chunks = Chunks::new(put);
        let n = self.vertex_count();
        chunks.text(format_args!("MeshVersionFormatted 2\nDimension {}\nVertices\n{n}\n", G::D))?;
        for v in self.present() {
            let point = &self.mesh.kernel.site(self.mesh.site_of[v]).point;
            (0..G::D).try_for_each(|axis| chunks.text(format_args!("{:?} ", point[axis])))?;
            chunks.text(format_args!("{v}\n"))?;
        }
        let kind = if G::D == 2 { "Triangles" } else { "Tetrahedra" };
        chunks.text(format_args!("{kind}\n{}\n", cells.corners.len()))?;
        for row in cells.corners {
            for &v in row.as_ref() {
                chunks.text(format_args!("{} ", rank(&ranks, v) + 1))?;
            }
            chunks.text(format_args!("1\n"))?;
        }
        chunks.text(format_args!("End\n"))?;
        chunks.end()
    }
}
