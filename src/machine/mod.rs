//! What the code asks of the machine: memory that may be refused, threads, the floating-point environment, and entries
//! of arrays before they are used.
//!
//! The room uses [`simd`](crate::simd) and [`error`](crate::error) alone: all else is above.

pub(crate) mod aligned;
pub(crate) mod counted;
pub(crate) mod environment;
pub mod memory;
pub(crate) mod pace;
#[cfg(unix)]
mod pool;
pub mod prefetch;
mod processors;
mod shared;
pub mod tally;
pub mod threads;
