//! What programs call to read a triangulation. Nothing here changes the cells.

pub(in crate::motion) mod cells;
pub(in crate::motion) mod chunks;
pub(in crate::motion) mod domain;
pub(in crate::motion) mod exporting;
pub(in crate::motion) mod geometry;
pub(in crate::motion) mod hidden;
pub(in crate::motion) mod near;
pub(in crate::motion) mod progress;
pub(in crate::motion) mod query;
pub(in crate::motion) mod saving;
pub(in crate::motion) mod tolerances;
pub(in crate::motion) mod transfer;
