//! MEDIT's text format, as read by Mmg, FreeFem, Gmsh and others (P. Frey: *MEDIT, an interactive mesh visualization
//! software*, INRIA technical report RT-0253, 2001).

use crate::delaunay::Dimension;
use crate::error::{Error, Result};
use crate::motion::reading::chunks::Chunks;
use crate::motion::reading::exporting::rank;
use crate::motion::triangulation::MovingTriangulation;

impl<G: Dimension> MovingTriangulation<G> {
    /// There must be a reference for each cell.
    pub(crate) fn check_references(&self, given: usize) -> Result<()> {
        let wanted = self.cell_count();
        if given == wanted {
            Ok(())
        } else {
            Err(Error::WrongCount { argument: "reference_count", given, wanted, coming: 0 })
        }
    }

    /// Hands on the text of a `.mesh` file, some thousand bytes at a time. Vertices are numbered from 1; the reference
    /// of each is its id, that of a cell the number given for it, or 1 if none are given, and that of a segment its
    /// marker. Coordinates have as many digits as tell them apart.
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there is a number for each cell, [`Error::OutOfMemory`], both before the first byte;
    /// and those of `put`, with which it ends.
    pub fn write_medit<E: From<Error>>(
        &self,
        references: Option<&[i32]>,
        put: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        references.map_or(Ok(()), |references| self.check_references(references.len()))?;
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
        for (c, row) in cells.corners.iter().enumerate() {
            for &v in row.as_ref() {
                chunks.text(format_args!("{} ", rank(&ranks, v) + 1))?;
            }
            chunks.text(format_args!("{}\n", references.map_or(1, |references| references[c])))?;
        }
        let n_lines = self.lines().count();
        if n_lines != 0 {
            chunks.text(format_args!("Edges\n{n_lines}\n"))?;
        }
        for line in self.lines() {
            let [a, b] = line.ends.map(|v| rank(&ranks, v) + 1);
            chunks.text(format_args!("{a} {b} {}\n", line.marker))?;
        }
        chunks.text(format_args!("End\n"))?;
        chunks.end()
    }
}
