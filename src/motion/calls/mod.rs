//! What programs call to change a triangulation: moves and edits that wait, commits, changes of one vertex at once,
//! compaction and copies.

pub(in crate::motion) mod cloning;
pub(in crate::motion) mod commit;
pub(in crate::motion) mod compaction;
pub(in crate::motion) mod editing;
pub(in crate::motion) mod hiding;
pub(in crate::motion) mod immediate;
pub(in crate::motion) mod keys;
pub(in crate::motion) mod moves;
mod parts;
pub(in crate::motion) mod passings;
pub(in crate::motion) mod preparing;
pub(in crate::motion) mod refining;
pub(in crate::motion) mod segments;
pub(in crate::motion) mod splitting;
mod weighing;
