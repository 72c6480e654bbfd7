//! MEDIT's text format, as read by Mmg, FreeFem, Gmsh and others (P. Frey: *MEDIT, an interactive mesh visualization
//! software*, INRIA technical report RT-0253, 2001).

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::motion::reading::chunks::Chunks;
use crate::motion::reading::exporting::{Drawn, check_references};

/// Writes all, with a reference for each cell, or 1.
pub(super) fn write<G: Moving, E: From<Error>>(
    drawn: &impl Drawn<G>,
    references: Option<&[i32]>,
    put: impl FnMut(&[u8]) -> Result<(), E>,
) -> Result<(), E> {
    references.map_or(Ok(()), |references| check_references(references.len(), drawn.cell_count()))?;
    let mut chunks = Chunks::new(put);
    let n = drawn.point_count();
    chunks.text(format_args!("MeshVersionFormatted 2\nDimension {}\nVertices\n{n}\n", G::D))?;
    for (v, point) in drawn.points() {
        (0..G::D).try_for_each(|axis| chunks.text(format_args!("{:?} ", point[axis])))?;
        chunks.text(format_args!("{v}\n"))?;
    }
    let kind = if G::D == 2 { "Triangles" } else { "Tetrahedra" };
    chunks.text(format_args!("{kind}\n{}\n", drawn.cell_count()))?;
    for (c, row) in drawn.cells().enumerate() {
        for n in &row[..=G::D] {
            chunks.text(format_args!("{} ", n + 1))?;
        }
        chunks.text(format_args!("{}\n", references.map_or(1, |references| references[c])))?;
    }
    let n_lines = drawn.lines().count();
    if n_lines != 0 {
        chunks.text(format_args!("Edges\n{n_lines}\n"))?;
    }
    for ([a, b], marker) in drawn.lines() {
        chunks.text(format_args!("{} {} {marker}\n", a + 1, b + 1))?;
    }
    chunks.text(format_args!("End\n"))?;
    chunks.end()
}
