//! Triangulations of moving points: staging, timestamps, and the algorithms of the report.
//!
//! A vertex has an id, for life or until a compaction, and a position at each timestamp. Relocations are staged; a
//! commit makes all of them the next timestamp, by one of the algorithms. `algorithms` has a row for each; they are
//! in these files:
//!
//! | file | report | what |
//! |---|---|---|
//! | `rebuilding` | section 1 | triangulate all positions again |
//! | `placement` | sections 3.1, 3.2 | relocate the vertices one at a time |
//! | `tolerance` | section 3.3, Algorithm 1 | place only vertices that leave their tolerance |
//! | `safe_region` | section 3.3, Algorithm 2 | place only vertices that leave their safe region |
//! | `switching` | section 5.2 | rebuild until few leave their tolerance |
//! | `repair` | | move all at once, check every certificate, mend what fails |
//! | `watching` | | as repair, but of what has left its tolerance, or soon will |
//! | `slack` | | as repair, but of bi-cells whose own tolerance is used up |
//! | `auto` | | watching, slack, repair or rebuilding, by what the last commits found |
//!
//! Each of `tolerance`, `safe_region`, `watching` and `slack` has a store and a commit; `regions` keeps one of the
//! stores, and lets it follow changes. `immediate` relocates, inserts and removes one vertex at a time; `moving` has
//! the loops that move all vertices; `transaction` what undoes a change; `cells` and `changes` what callers read of
//! it, and `foreseen` what they are going to read; `geometry` what they compute from that; `compaction` forgets removed vertices; `cloning` and `saving` copy
//! everything.
//!
//! Invariants between calls:
//! - the cells are those of a fresh build of (positions, ids), whatever happened before;
//! - the vertices at one place share a site; the lowest id represents it, the others are *hidden*;
//! - a call that fails has no effect: every change is a transaction (`transaction`), which is undone from its own
//!   record.
//!
//! Memory per vertex: the kernel's, 4 bytes for the site of an id, and once moves are staged a position, a flag and
//! an id.

mod algorithms;
mod attempt;
mod auto;
mod bicell;
mod cells;
mod changes;
mod chunks;
mod cloning;
mod coincidence;
mod commit;
mod compaction;
pub(crate) mod constants;
mod editing;
mod edits;
mod exporting;
mod foreseen;
mod geometry;
mod goals;
mod hidden;
mod immediate;
mod marks;
mod matching;
mod moves;
mod moving;
mod options;
mod ordering;
mod origins;
mod outlook;
mod placement;
mod query;
mod reading;
mod rebuilding;
mod regions;
mod repair;
mod report;
mod safe_region;
mod saving;
mod slack;
mod staging;
mod switching;
mod tolerance;
mod transaction;
mod triangulation;
mod undoing;
mod views;
mod visibility;
mod watching;

pub use crate::delaunay::{Level, Violation};
pub use algorithms::{Algorithm, AlgorithmRow, Commits, Purpose};
pub use cells::{NO_CELL, NO_CORNER};
pub use changes::{Changes, NO_VERTEX};
pub use exporting::Field;
pub use geometry::{BoundaryFacet, Interpolation, OrderedStar, Rows, VertexValues};
pub use options::{CoincidencePolicy, Monitor, Options, SwitchingRule};
pub use query::Location;
pub(crate) use query::cells_at;
pub use report::CommitReport;
pub use saving::Saved;
pub(crate) use staging::check_position;
pub use triangulation::{MAX_VERTICES, MovingTriangulation};
pub use views::CellsView;
