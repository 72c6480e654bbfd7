//! The *tolerance* algorithm (report, Algorithm 1): a tolerance for each vertex.

mod batch;
mod commit;
mod query;
mod tolerances;

pub(super) use tolerances::{Fixed, Tolerances};
