//! Stores of regions: what lets a vertex move without a look at its certificates (report, sections 2.3, 2.4).
//!
//! Stores know the kernel, and nothing of the triangulation or of the commits that use them.

pub(in crate::motion) mod barycentric;
pub(in crate::motion) mod bicell;
pub(in crate::motion) mod margin;
pub(in crate::motion) mod regions;
pub(in crate::motion) mod safe_regions;
pub(in crate::motion) mod slack;
pub(in crate::motion) mod store;
pub(in crate::motion) mod tolerance;
pub(in crate::motion) mod watching;
