//! What the last commits have found, and what follows for the next one: by which algorithm, and when to give one up.
//!
//! What is decided follows from counts of commits, which are kept here, from what else is kept, and from
//! [`constants`](super::constants). Nothing here changes a vertex, a cell or a store.

pub(in crate::motion) mod auto;
pub(in crate::motion) mod budget;
pub(in crate::motion) mod switching;
