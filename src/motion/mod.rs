//! Triangulations of moving points: staging, timestamps, and the algorithms of the report.
//!
//! A vertex has an id, for life or until a compaction, and a position at each timestamp. Relocations are staged; a
//! commit makes all of them the next timestamp, by one of the algorithms ([`Algorithm`]).
//!
//! The folders are floors: each uses only those above it in this list.
//!
//! | floor | what |
//! |---|---|
//! | `algorithms`, `options`, `report`, `constants`, `region_kind` | what programs choose, and what they are told |
//! | `state` | stores: moves that wait, where vertices were, the transaction, cells as programs see them |
//! | `filters` | stores of the regions that let a vertex pass; they know the kernel |
//! | `plan` | by what the last commits found: which algorithm, and when one is given up |
//! | `triangulation` | where the stores meet; a change made or undone, vertices at one place |
//! | `ways` | one file or folder for each way from one timestamp to the next |
//! | `calls` | what programs call to change: commits, single vertices, edits, copies |
//! | `reading` | what programs call to read: cells, changes, geometry, files |
//!
//! Invariants between calls:
//! - the cells are those of a fresh build of (positions, ids), whatever happened before;
//! - the vertices at one place share a site; the lowest key and then id represents it, the others are *hidden*; with weights each
//!   has a site of its own, and who is hidden is found anew (state/mesh/hidden_by_weight);
//! - a call that fails has no effect: every change is a transaction, which is undone from its own record.
//!
//! Memory per vertex: the kernel's, 4 bytes for the site of an id, once there was a commit a position, and once moves
//! are staged another one, a flag and an id.

mod algorithms;
mod calls;
pub(crate) mod constants;
mod filters;
mod options;
mod plan;
mod reading;
mod region_kind;
mod report;
mod state;
mod triangulation;
mod ways;

pub use crate::delaunay::{Level, Violation};
pub use crate::refine::Kept;
pub use algorithms::{Algorithm, AlgorithmRow, Commits, Purpose};
pub(crate) use calls::hiding::ChangedParts;
pub use options::{
    CoarsenOptions, CoincidencePolicy, MAX_LEAST_ANGLE, Monitor, Options, PassingPolicy, Quality,
    RefineOptions, SwitchingRule, TooLarge,
};
pub(crate) use reading::chunks::Chunks;
pub use reading::domain::ChainEdge;
pub use reading::exporting::Field;
pub(crate) use reading::exporting::{Drawn, check_references};
pub use reading::geometry::{
    BoundaryFacet, Interpolation, Rows, TellCell, TellFacet, VertexValues, VoronoiCell, VoronoiCells,
    VoronoiFacet, VoronoiFacets,
};
pub(crate) use reading::geometry::{
    EdgeWithCell, Ridges, VoronoiAsked, are_many, check_corners, check_simplices, find_in_stars, first_cells,
    list_boundary, nowhere, ordered_star, tell_all, without_flat_cells,
};
pub(crate) use reading::near::{BoxTree, Entry, Lists, PlacedVertex, Search};
pub use reading::near::{InReach, ListsOf, NeighbourLists, VerticesInReach};
pub(crate) use reading::progress::Progress;
pub use reading::query::Location;
pub(crate) use reading::query::cells_at;
pub use reading::saving::Saved;
pub(crate) use reading::saving::header::{
    Beginning, N_SUMS_OF_WEIGHTS, enter_sums_of_weights, sums_of_weights,
};
pub(crate) use reading::saving::reader::Reader;
#[cfg(test)]
pub(crate) use reading::transfer::finds_as_by_a_look_at_all;
pub(crate) use reading::transfer::{
    CellAt, Extent, Gone, Multiples, NamedFacet, Now, Transferred, in_place, transfer,
};
pub use reading::transfer::{TransferOrder, TransferReport};
pub use report::{CommitReport, QualityReport, SplitReport, VertexWeights};
pub use state::cells::{NO_CELL, NO_CORNER, OwnedCells};
pub use state::changes::NO_VERTEX;
pub(crate) use state::checking::{check_not_negative, check_numbers, check_position, check_weight};
pub(crate) use state::hidden_ids::HiddenIds;
pub use state::part::PointPart;
pub(crate) use state::part::{copy_part, numbers_of, set_part, staged_part};
pub use state::segments::{NO_LABEL, Segment};
pub use state::taken::Changes;
pub use state::views::CellsView;
pub use triangulation::{MAX_VERTICES, MovingTriangulation};
