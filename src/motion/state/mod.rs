//! Stores: what a triangulation is at its last commit, what waits for the next one, and what undoes a change.
//!
//! Each has private fields, but for the mesh and rounds, and knows nothing of the triangulation or of how it gets from one
//! timestamp to the next.

pub(in crate::motion) mod cells;
pub(in crate::motion) mod changes;
pub(in crate::motion) mod checking;
pub(in crate::motion) mod density;
pub(in crate::motion) mod edits;
pub(in crate::motion) mod foreseen;
pub(in crate::motion) mod goals;
pub(in crate::motion) mod hidden;
pub(in crate::motion) mod hidden_ids;
pub(in crate::motion) mod last_found;
pub(in crate::motion) mod looked;
pub(in crate::motion) mod made;
pub(in crate::motion) mod marks;
pub(in crate::motion) mod matching;
pub(in crate::motion) mod mesh;
pub(in crate::motion) mod ordering;
pub(in crate::motion) mod origins;
pub(in crate::motion) mod part;
pub(in crate::motion) mod passings;
pub(in crate::motion) mod places;
pub(in crate::motion) mod repair;
pub(in crate::motion) mod rounds;
pub(in crate::motion) mod segments;
pub(in crate::motion) mod staging;
pub(in crate::motion) mod taken;
pub(in crate::motion) mod transaction;
pub(in crate::motion) mod views;
pub(in crate::motion) mod visibility;
