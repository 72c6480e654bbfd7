//! Where segments come from, and how long the originals are.

use super::reading::Read;
use crate::delaunay::Plane;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::state::made::Origin;
use crate::motion::triangulation::MovingTriangulation;
use crate::refine::{Origins, distance};

impl MovingTriangulation<Plane> {
    /// The original of each edge that is a segment, and those of vertices that have been added.
    pub(super) fn origins(&self, read: &Read) -> Result<Origins> {
        let mut of_edges = Vec::new();
        memory::collect(
            &mut of_edges,
            (0..read.edges.len()).map(|edge| self.origin_of(read.segments_at(edge)[0].1)),
        )?;
        let mut sorted = memory::copy_of(&of_edges)?;
        sorted.sort_unstable();
        sorted.dedup();
        let place = |origin: &Origin| sorted.binary_search(origin).expect("it is listed") as u32;
        let mut origins = Origins::default();
        memory::collect(&mut origins.of_segments, of_edges.iter().map(place))?;
        // Parts of one segment, between vertices at which others have split it, are originals of their own. A vertex is on
        // that of the pieces beside it.
        let made_on = |v: VertexId| self.made.as_ref().and_then(|made| made.is_on(v));
        for (edge, &ends) in read.edges.iter().enumerate() {
            for v in ends {
                let Some(on) = made_on(v) else { continue };
                let others = || read.segments_at(edge)[1..].iter();
                if of_edges[edge].segment == on || others().any(|&(_, id)| self.original_segment(id) == on) {
                    memory::push(&mut origins.of_vertices, (v, origins.of_segments[edge]))?;
                }
            }
        }
        memory::collect(&mut origins.ends, sorted.iter().map(|origin| origin.ends))?;
        Self::measure_originals(read, &mut origins)?;
        Ok(origins)
    }

    /// Measures what is in force of each original: from corner to corner of the box around it, which no split changes.
    fn measure_originals(read: &Read, origins: &mut Origins) -> Result<()> {
        let mut boxes = Vec::new();
        memory::lengthen(&mut boxes, origins.ends.len(), [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]])?;
        for (&original, piece) in origins.of_segments.iter().zip(&read.edges) {
            let [low, high] = &mut boxes[original as usize];
            for p in piece.map(|v| read.places.points[v]) {
                for axis in 0..2 {
                    low[axis] = low[axis].min(p[axis]);
                    high[axis] = high[axis].max(p[axis]);
                }
            }
        }
        memory::collect(&mut origins.lengths, boxes.iter().map(|[low, high]| distance(low, high)))
    }
}
