//! The edges of a set that repeats, one of each class of translations of each other.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::periodic::inside::Inside;
use crate::periodic::lattice::HOME;

/// The edges, each where its first vertex is at home. That is of the lower id; of an edge between images of one vertex, the
/// one from which the shift is greater than nothing in the order of its multiples.
#[derive(Debug)]
pub(super) struct PeriodicEdges {
    /// The ids inside of both vertices, in the order of images, and a cell inside that has both.
    pub(super) list: Vec<([VertexId; 2], CellId)>,
}

impl PeriodicEdges {
    /// Reads all edges. The cells of a vertex at home are all inside, and so is the edge of each class at each of its ends.
    pub(super) fn of<G: Moving>(inside: &Inside<G>) -> Result<Self> {
        let images = &inside.images;
        let mut list: Vec<([VertexId; 2], CellId)> = Vec::new();
        let mut begin = 0;
        inside.t.for_edges(images.homes().map(|(_, inner)| inner), |[v, w], cell| {
            let (from, to) = (images.of(v), images.of(w));
            if list.get(begin).is_some_and(|edge| edge.0[0] != v) {
                list[begin..].sort_unstable_by_key(|edge| images.of(edge.0[1]));
                begin = list.len();
            }
            debug_assert_eq!(from.shift, HOME);
            if from < to { memory::push(&mut list, ([v, w], cell)) } else { Ok(()) }
        })?;
        list[begin..].sort_unstable_by_key(|edge| images.of(edge.0[1]));
        Ok(PeriodicEdges { list })
    }
}
