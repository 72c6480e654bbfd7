//! The *safe region* algorithm (report, Algorithm 2), also with tolerances: a delimiter for each bi-cell.

mod commit;
mod safe_regions;

pub(super) use safe_regions::{Admission, SafeRegions};
