//! The C boundary: everything that the headers in `include/deldrift` declare, and nothing else.
//!
//! Each function here does three things and no geometry: it takes its arguments and checks them, calls the one
//! method of [`MovingTriangulation`](crate::motion::MovingTriangulation) that does the work, and
//! converts the result. Types, functions and enumerators carry their C names, so that a search finds
//! both sides, and their documentation is that of the header, which cbindgen copies from here.
//!
//! # Floors
//!
//! Each file uses only those below it.
//!
//! | files | what |
//! |---|---|
//! | `triangulation`, `motion`, `state`, `query`, ... | the functions, by subject |
//! | `handle` | the object that C knows as a triangulation, and how calls read and change what is in it |
//! | `options` | the structure of options, and the callbacks |
//! | `guard` | what every function runs in |
//! | `pointers` | pointers taken at their word, as types that are used safely |
//! | `status` | status codes, and why a call fails |
//! | `message`, `files` | the message of the last failure; files by the system's own calls |
//!
//! At its head a function makes safe values of its pointers, with `given!`; its body is safe code.
//!
//! # Guard
//!
//! No panic and no message on a terminal leaves the library. Every entry runs inside the guard:
//! a failure becomes a [`deldrift_status`] and a message kept for the calling thread, and so does a
//! panic, which is by definition an internal error. A panic in a call that was changing a
//! triangulation leaves it in an unknown state, so it is *poisoned*: all it accepts from then on is
//! its destruction.
//!
//! # Ownership
//!
//! A triangulation is created and destroyed here and belongs to the caller in between. Arrays that are
//! passed in are read during the call and never kept. Arrays that are passed out belong to the
//! triangulation and stay until it changes (views), or belong to the caller and are filled (copies).
//! A call writes to its outputs only when it succeeds; the one exception is the count of a buffer that
//! is too small, without which the caller could not provide a greater one.
//!
//! # What is trusted
//!
//! That pointers which are neither NULL nor misaligned point to what the header says they do, and that
//! calls which change a triangulation do not run at the same time as others on it. Everything else is
//! checked: enumerators and option sizes arrive as plain integers, counts are multiplied with care, and
//! a callback that calls back into the triangulation it serves is turned away as
//! [`deldrift_status::DELDRIFT_BUSY`].

#![allow(unsafe_code)]
// One page for C, the header's first, says what pointers must be; repeating it in every function would
// only bury what is particular to it.
#![allow(clippy::missing_safety_doc)]
#![allow(non_camel_case_types)]

mod changes;
mod domain;
mod files;
mod geometry;
mod guard;
mod handle;
mod immediate;
mod incidence;
mod interpolation;
mod keys;
mod listed;
mod location;
mod message;
mod motion;
mod near;
mod options;
#[cfg(test)]
mod panics;
mod periodic;
mod pointers;
mod predicates;
mod preparing;
mod query;
mod reach;
mod refining;
mod regions;
mod research;
mod saving;
mod segments;
mod splitting;
mod state;
mod status;
mod transferring;
mod triangulation;
mod voronoi;
#[cfg(target_family = "wasm")]
mod wasm;
mod weights;

pub use changes::*;
pub use domain::*;
pub use geometry::*;
pub use handle::deldrift_triangulation;
pub use immediate::*;
pub use incidence::*;
pub use interpolation::*;
pub use keys::*;
pub use listed::*;
pub use location::*;
pub use motion::*;
pub use near::*;
pub use options::*;
pub use periodic::*;
pub use predicates::*;
pub use preparing::*;
pub use query::*;
pub use reach::*;
pub use refining::*;
pub use regions::*;
pub use research::*;
pub use saving::*;
pub use segments::*;
pub use splitting::*;
pub use state::*;
pub use status::*;
pub use transferring::*;
pub use triangulation::*;
pub use voronoi::*;
pub use weights::*;
