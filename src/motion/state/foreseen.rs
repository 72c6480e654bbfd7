//! Vertices that are asked for one after another, in the order of their ids: what the next ones need can be foreseen.
//!
//! A solver that visits all vertices reads the star of one, then of the next. Sites and cells are stored along a curve,
//! so each star lies elsewhere, and five reads in turn wait for memory: the site, a cell of it, those beside that, and
//! so on. What is asked for some vertices ahead has come when it is their turn. In another order that would be wasted,
//! and take time: so it is done only where a vertex of the same block of ids was asked for before.
//!
//! Invariant: none. This decides on hints to the processor, and any thread may note any vertex at any time.
//!
//! Cost: a comparison for each vertex, and a store for each block that is entered.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use crate::delaunay::Moving;
use crate::ids::VertexId;
use crate::machine::prefetch::CACHE_BYTES;
use crate::motion::state::mesh::Mesh;

/// How many vertices with consecutive ids are a block.
const BLOCK: u32 = 64;

/// How many blocks are remembered, so that this number of threads can each visit vertices of its own.
const BLOCKS: usize = 16;

/// How many ids after the one at hand a vertex is in each of the [steps](crate::delaunay::Delaunay::prefetch_star).
const AHEAD: [usize; 4] = [4, 3, 2, 1];

/// The blocks of which vertices were asked for, from 1 on, each at its number modulo that of entries.
#[derive(Debug, Default)]
pub(in crate::motion) struct Foreseen([AtomicU32; BLOCKS]);

impl Foreseen {
    /// Asks for what the stars of the vertices after this one will read, where that is not in a cache anyway and is
    /// going to be needed.
    #[inline(always)]
    pub(in crate::motion) fn prefetch_next_stars<G: Moving>(&self, mesh: &Mesh<G>, vertex: VertexId) {
        if mesh.kernel.has_cells() && mesh.kernel.bytes_read() > CACHE_BYTES && self.note(vertex) {
            prefetch_stars_after(mesh, vertex);
        }
    }

    /// Notes that a vertex is asked for; whether one of its block was, not long before.
    #[inline(always)]
    fn note(&self, vertex: VertexId) -> bool {
        let block = vertex.get() / BLOCK + 1;
        let entry = &self.0[block as usize % BLOCKS];
        let is_known = entry.load(Relaxed) == block;
        if !is_known {
            entry.store(block, Relaxed);
        }
        is_known
    }
}

#[inline(never)]
fn prefetch_stars_after<G: Moving>(mesh: &Mesh<G>, vertex: VertexId) {
    for (step, ahead) in AHEAD.into_iter().enumerate() {
        let next = vertex.index() + ahead;
        if next < mesh.site_of.len()
            && let Some(next) = mesh.site(VertexId::at(next))
        {
            mesh.kernel.prefetch_star(next, step);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::{Level, Plane, Space};
    use crate::ids::CellId;
    use crate::motion::options::Options;
    use crate::motion::triangulation::MovingTriangulation;
    use crate::random::Rng;

    /// Of vertices that are visited in the order of their ids all but the first of each block are noticed to be so,
    /// whatever other threads visit; of vertices far from each other none is.
    #[test]
    fn ids_in_order_are_noticed() {
        fn n_followed(ids: impl Iterator<Item = u32>) -> usize {
            let foreseen = Foreseen::default();
            ids.filter(|&id| foreseen.note(VertexId::new(id))).count()
        }
        assert_eq!(n_followed([0, 1, 2, 5].into_iter()), 3);
        // Two threads, which visit 16 blocks each.
        assert_eq!(n_followed((0..1024).flat_map(|k| [k, 10_048 + k])), 2 * 1024 - 2 * 16);
        assert_eq!(n_followed((0..1000).map(|k| 1_000_000 - 1000 * k)), 0);
    }

    /// More points than a cache holds, some of them at one place and some removed: the stars, read in the order of the
    /// ids, are those that the cells tell, and vertices are relocated in that order.
    fn visits_in_order<G: Moving>() {
        let (n, rng) = (20_000, &mut Rng::new(1));
        let mut points = vec![G::Point::default(); n];
        for p in &mut points {
            (0..G::D).for_each(|k| p[k] = rng.unit());
        }
        for k in (100..n).step_by(100) {
            points[k] = points[k - 99];
        }
        let mut t = MovingTriangulation::<G>::new(&points, Options::default()).expect("room");
        for v in (0..n).step_by(70).chain(n - 3..n) {
            t.remove_vertex(VertexId::at(v)).expect("it is there");
        }
        assert!(t.mesh.kernel.bytes_read() > CACHE_BYTES);
        let mut expected = vec![Vec::new(); n];
        for (index, corners) in t.cells().expect("room").corners.iter().enumerate() {
            corners.as_ref().iter().for_each(|v| expected[v.index()].push(CellId::at(index)));
        }
        let mut star = Vec::new();
        for v in VertexId::range(0..n) {
            let Ok(shown) = t.coincident_representative(v) else { continue };
            t.star(v, &mut star).expect("room");
            star.sort_unstable();
            assert_eq!(star, expected[shown.index()]);
        }
        for v in VertexId::range(0..n) {
            let mut place = points[v.index()];
            place[0] += 1e-4 * rng.unit();
            let is_present = t.position(v).is_ok();
            assert_eq!(t.relocate_vertex(v, &place).is_ok(), is_present);
        }
        assert_eq!(t.validate(Level::Delaunay), Ok(()));
    }

    #[test]
    fn vertices_of_the_plane_are_visited_in_order() {
        visits_in_order::<Plane>();
    }

    #[test]
    fn vertices_in_space_are_visited_in_order() {
        visits_in_order::<Space>();
    }
}
