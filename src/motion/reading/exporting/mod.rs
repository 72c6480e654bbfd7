//! Files for programs that draw and mesh: positions and cells, without a way back.
//!
//! They hold the vertices that are present, hidden ones included, in the order of their ids and numbered without gaps;
//! the id of each is kept beside it.

mod medit;
mod vtu;

use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::triangulation::MovingTriangulation;
pub use vtu::Field;

impl<G: Dimension> MovingTriangulation<G> {
    /// The vertices that are present, ascending.
    fn present(&self) -> impl Iterator<Item = VertexId> + '_ {
        VertexId::range(0..self.id_count()).filter(|&v| self.mesh.is_present(v))
    }

    /// For each id the number of present vertices with lower ones; nothing if that is the id itself.
    fn ranks(&self) -> Result<Vec<u32>> {
        let mut ranks = Vec::new();
        if self.vertex_count() == self.id_count() {
            return Ok(ranks);
        }
        memory::lengthen(&mut ranks, self.id_count(), 0)?;
        self.present().zip(0..).for_each(|(v, rank)| ranks[v] = rank);
        Ok(ranks)
    }
}

/// The number of a vertex among those present.
fn rank(ranks: &[u32], vertex: VertexId) -> u32 {
    ranks.get(vertex.index()).copied().unwrap_or(vertex.get())
}
