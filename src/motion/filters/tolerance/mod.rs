//! The *tolerance* algorithm (report, Algorithm 1): a tolerance for each vertex.

mod batch;
mod tolerances;

pub(in crate::motion) use tolerances::{Fixed, Tolerances};
