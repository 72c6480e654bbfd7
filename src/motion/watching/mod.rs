//! *Watching*: a tolerance for each vertex, and a list of the bi-cells that would make it too small.

mod commit;
mod tolerances;
mod watched;

pub(super) use tolerances::Watching;
