//! Exact Delaunay triangulations of **moving points**, in 2D and 3D, behind a C ABI.
//!
//! The subject is that of INRIA's report RR-6750, *Delaunay Triangulations for Moving Points* (Manhães de
//! Castro and Devillers, 2008): points move a little at every timestamp; how does one bring the triangulation
//! to the new positions faster than by rebuilding it? The answer given here, in four steps:
//!
//! 1. A solver stages [relocations](motion::MovingTriangulation::move_vertices) and
//!    [commits](motion::MovingTriangulation::commit_timestamp) them as the next timestamp.
//! 2. *Rebuilding* triangulates all positions again; *placement* relocates vertices one at a time, and where
//!    no certificate of a star fails, only coordinates change.
//! 3. Signs are exact, ties are broken by vertex id, or by keys that are given: the cells are a function of
//!    positions and these alone.
//!    Whatever the algorithm and the history, they are the cells that rebuilding gives.
//! 4. A call that fails has no effect.
//!
//! In ten lines:
//!
//! ```
//! use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
//!
//! let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
//! let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
//! t.move_vertices(&[VertexId::new(3)], &[[0.9, 0.8]])?; // staged
//! let report = t.commit_timestamp()?; // done
//! assert_eq!((report.timestamp, report.moved), (1, 1));
//! for row in t.cells()?.corners {
//!     println!("a triangle of the vertices {row:?}");
//! }
//! # Ok::<(), deldrift::Error>(())
//! ```
//!
//! Programs that know the dimension use [`MovingTriangulation`](motion::MovingTriangulation); bindings, which do not,
//! use [`AnyTriangulation`].
//!
//! Reading order, each layer using only those after it: [`capi`] → [`motion`] → `refine` → `delaunay` → `complex` →
//! `predicates` → `machine`. What is public in the last five is so for the layers above: it trusts its arguments, so none of
//! it leaves the crate.

pub mod capi;
mod complex;
mod damage;
mod delaunay;
mod either;
mod error;
mod ids;
mod machine;
pub mod motion;
#[cfg(test)]
#[path = "../tests/common/passing_by_roots.rs"]
mod passing_by_roots;
pub mod periodic;
mod predicates;
#[cfg(test)]
#[path = "../tests/common/random.rs"]
mod random;
mod refine;
mod simd;

pub use damage::{Damage, LoadError};
pub use delaunay::{Dimension, Moving, Plane, PowerPlane, PowerSpace, Shape, Space};
pub use either::{AnyTriangulation, AnyWeighted, points_of};
pub use error::{AXIS_OF_WEIGHT, Conflict, Error, Passing, Result, StagedEdit};
pub use ids::{CellId, SegmentId, VertexId};
pub use predicates::{Coordinates, WeightedPoint};

/// The parts below [`motion`], for the crate's own tests and benchmarks. They trust their arguments, wrong indices are
/// undefined behaviour, and any version may change them.
#[cfg(feature = "internals")]
#[doc(hidden)]
pub mod internals {
    pub use crate::delaunay::{Delaunay, Insertion, PowerPlane, PowerSpace, Shortcut};
    pub use crate::ids::{SiteId, Slot};
    pub use crate::machine::threads::use_all_threads;

    /// What decides between two ways, and how to try other values.
    pub mod constants {

        pub use crate::motion::constants::{Constants, Costs, TABLE, Table};
    }

    pub mod predicates {
        pub use crate::predicates::*;
    }
}

// A triangulation may be handed to another thread, and be read from several at once.
const _: () = {
    const fn is_send_and_sync<T: Send + Sync>() {}
    is_send_and_sync::<motion::MovingTriangulation<Plane>>();
    is_send_and_sync::<motion::MovingTriangulation<Space>>();
};
