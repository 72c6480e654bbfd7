//! What the code asks of the machine: memory that may be refused, threads, and entries of arrays before they are used.
//!
//! No module here knows what it is asked for: all of deldrift is above.

pub mod memory;
pub mod prefetch;
mod processors;
pub mod tally;
pub mod threads;
