//! *Watching*: a tolerance for each vertex, and a list of the bi-cells that would make it too small.

mod tolerances;
mod watched;

pub(in crate::motion) use tolerances::Watching;
