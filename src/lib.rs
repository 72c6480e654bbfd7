//! Exact Delaunay triangulations of **moving points**, in 2D and 3D, behind a C ABI.
//!
//! The subject is that of INRIA's report RR-6750, *Delaunay Triangulations for Moving Points* (Manhães de
//! Castro and Devillers, 2008): points move a little at every timestamp; how does one bring the triangulation
//! to the new positions faster than by rebuilding it? The answer given here, in four steps:
//!
//! 1. A solver stages [relocations](motion::MovingTriangulation::move_vertices) and
//!    [commits](motion::MovingTriangulation::commit_timestamp) them as the next timestamp.
//! 2. *Rebuilding* triangulates all positions anew; *placement* relocates vertices one at a time, and where
//!    no certificate of a star fails, only coordinates change.
//! 3. Signs are exact, ties are broken by vertex id: the cells are a function of positions and ids alone.
//!    Whatever the algorithm and the history, they are the cells that rebuilding gives.
//! 4. A call that fails has no effect.
//!
//! Reading order, each layer knowing only those after it:
//! [`capi`] → [`motion`] → [`delaunay`] → [`complex`] → [`predicates`].

pub mod capi;
pub mod complex;
pub mod delaunay;
mod error;
pub mod motion;
pub mod predicates;
mod prefetch;
mod processors;
mod threads;

pub use error::{Error, Result};
