//! Files for programs that draw and mesh: positions and cells, without a way back.
//!
//! They hold the vertices that are present, hidden ones included, in the order of their ids and numbered without gaps;
//! the id of each is kept beside it.
//!
//! Segments in force are lines behind the cells, in the order of their ids, so that the cell of an index is there where
//! it is without segments. A triangulation without segments has no lines, and nothing else that speaks of them.

mod medit;
mod vtu;

use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::state::segments::Segment;
use crate::motion::triangulation::MovingTriangulation;
pub use vtu::Field;

impl<G: Dimension> MovingTriangulation<G> {
    /// The vertices that are present, ascending.
    fn present(&self) -> impl Iterator<Item = VertexId> + '_ {
        VertexId::range(0..self.id_count()).filter(|&v| self.mesh.is_present(v))
    }

    /// The segments in force, between vertices that are corners of cells: where others are at the same place, those that
    /// represent them.
    fn lines(&self) -> impl Iterator<Item = Segment> + '_ {
        let shown = |v: VertexId| self.mesh.kernel.site(self.mesh.site_of[v]).id;
        let segments = self.mesh.segments.iter().flat_map(|segments| segments.laid());
        segments.map(move |(_, Segment { ends, marker })| Segment { ends: ends.map(shown), marker })
    }

    /// Whether files have lines.
    pub(crate) fn has_lines(&self) -> bool {
        self.lines().next().is_some()
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
