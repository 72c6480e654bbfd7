//! What is triangulated: vertices at home, and images of them.

use crate::delaunay::Moving;
use crate::machine::memory;
use crate::motion::MovingTriangulation;
use crate::periodic::images::Images;
use crate::periodic::lattice::Occupied;

/// Vertices at home and their images, triangulated.
#[derive(Debug)]
pub(super) struct Inside<G: Moving> {
    pub(super) t: MovingTriangulation<G>,
    pub(super) images: Images,
    /// The number of vertices when this was built.
    pub(super) n_built: usize,
    /// By id inside, where each vertex at home is; also where images are that were there when this was written.
    pub(super) places: Vec<G::Point>,
    /// Room for where they go.
    pub(super) goals: Vec<G::Point>,
    pub(super) occupied: Occupied,
    /// The mean distance of vertices when this was built.
    pub(super) spacing: f64,
    pub(super) since: InsideBefore,
}

/// What there was at the timestamp from which rounds go on.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct InsideBefore {
    /// Ids that vertices had been given.
    pub(super) n_vertices: usize,
    /// Whether the set [was plain](Inside::is_plain).
    pub(super) is_plain: bool,
}

impl<G: Moving> Inside<G> {
    pub(super) fn memory_bytes(&self) -> usize {
        self.t.memory_bytes()
            + self.images.memory_bytes()
            + memory::bytes_of(&self.places)
            + memory::bytes_of(&self.goals)
    }
}

/// All shifts in these ranges.
pub(super) fn all(
    a: std::ops::RangeInclusive<i32>,
    b: std::ops::RangeInclusive<i32>,
    c: std::ops::RangeInclusive<i32>,
) -> impl Iterator<Item = (i32, i32, i32)> {
    a.flat_map(move |x| {
        let c = c.clone();
        b.clone().flat_map(move |y| c.clone().map(move |z| (x, y, z)))
    })
}
