//! What the last commits have found, and what follows for the next one: by which algorithm, and when to give one up.
//!
//! Functions of counts, of what is kept, and of [`constants`](super::constants) alone. They change nothing else.

pub(in crate::motion) mod auto;
pub(in crate::motion) mod budget;
pub(in crate::motion) mod switching;
