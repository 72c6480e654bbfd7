//! Motion: what is staged, and becomes a timestamp.

use std::slice;

use super::handle::{Changing, Reading, by_kind, deldrift_triangulation, in_any, in_weighted};
use super::pointers::{Array, Output, Point, Points, given};
use super::status::deldrift_status;
use crate::error::Error;
use crate::ids::VertexId;
use crate::motion::{CommitReport, PointPart};

/// What a commit did, or, from deldrift_statistics, what all of them did.
///
/// A vertex that leaves its tolerance is relocated once; none ever has to be a second time.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct deldrift_commit_report {
    /// Number of the timestamp reached. It is 0 at creation, and one more after each commit.
    pub timestamp: u64,
    /// Vertices whose position differs from that of the timestamp before.
    pub moved: u64,
    /// Moved vertices for which nothing but coordinates changed.
    pub unchanged: u64,
    /// Vertices removed and inserted again.
    pub placements: u64,
    /// Flips made.
    pub flips: u64,
    /// 1 if the triangulation was rebuilt (in the statistics, how often).
    pub rebuilds: u64,
    /// Vertices hidden by place at the end: those at the place of a vertex with a lower id, or key, or greater weight.
    pub coincident: u64,
    /// Vertices that were certainly within their tolerance, with an algorithm that tests it.
    pub within_tolerance: u64,
    /// Bi-cells whose tolerance was computed.
    pub tolerances: u64,
    /// Orientations and in-sphere tests of the stars of relocated vertices.
    pub certificates: u64,
    /// Signs, of whatever purpose, that floating-point filters left to exact arithmetic. Ties are among them, but not
    /// those on a lattice in builds.
    pub exact_calls: u64,
    /// Vertices inserted.
    pub inserted: u64,
    /// Vertices removed.
    pub removed: u64,
    /// Vertices whose weight differs from that of the timestamp before, in a triangulation with weights.
    pub reweighted: u64,
    /// Vertices hidden by weight at the end; deldrift_hidden_by_weight lists them. Of vertices at one place those that
    /// do not represent it count in coincident alone.
    pub hidden_by_weight: u64,
    /// Vertices with weights that are hidden at the end, by weight or by place, and were not.
    pub newly_hidden: u64,
    /// Vertices with weights that were hidden, and are there at the end and not hidden.
    pub newly_shown: u64,
    /// Zero; later versions may count more.
    pub reserved: [u64; 3],
}

impl From<CommitReport> for deldrift_commit_report {
    fn from(report: CommitReport) -> Self {
        Self {
            timestamp: report.timestamp,
            moved: report.moved,
            unchanged: report.unchanged,
            placements: report.placements,
            flips: report.flips,
            rebuilds: report.rebuilds,
            coincident: report.coincident,
            within_tolerance: report.within_tolerance,
            tolerances: report.tolerances,
            certificates: report.certificates,
            exact_calls: report.exact_calls,
            inserted: report.inserted,
            removed: report.removed,
            reweighted: report.reweighted,
            hidden_by_weight: report.hidden_by_weight,
            newly_hidden: report.newly_hidden,
            newly_shown: report.newly_shown,
            reserved: [0; 3],
        }
    }
}

/// Stages the move of one vertex for the next timestamp. Nothing that can be read changes until
/// deldrift_commit_timestamp.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_DUPLICATE_MOVE,
/// DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_move_vertex(
    t: *mut deldrift_triangulation,
    vertex: u32,
    position: *const f64,
) -> deldrift_status {
    given!(t: Changing, position: Point);
    t.change_any(|t| {
        let vertex = VertexId::new(vertex);
        if t.is_weighted() {
            return in_weighted!(t => {
                let place = position.place("position", t)?;
                Ok(t.move_parts(PointPart::Place, Some(&[vertex]), place).map_err(of_one)?)
            });
        }
        in_any!(t => {
            let position = position.of("position", t)?;
            t.move_vertices(&[vertex], slice::from_ref(&position)).map_err(of_one)?;
        });
        Ok(())
    })
}

/// Stages the moves of count vertices for the next timestamp: all of them, or none if it fails.
///
/// vertices: count ids, each at most once. NULL stands for 0, 1, ..., count - 1: count may then be at most
/// deldrift_id_count, and vertices from count on are not staged. The entry of a vertex whose insertion is staged
/// replaces the place where it will be inserted. Entries of removed vertices, and of those whose removal is staged, are
/// not read. positions: count points. Both may be NULL if count is 0, when nothing is staged.
///
/// Cost: count.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT if there are more positions than ids, DELDRIFT_NO_SUCH_VERTEX,
/// DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX for one in vertices, DELDRIFT_DUPLICATE_MOVE (also within vertices),
/// DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_move_vertices(
    t: *mut deldrift_triangulation,
    vertices: *const u32,
    positions: *const f64,
    count: usize,
) -> deldrift_status {
    given!(t: Changing, vertices[count]: Array, positions[count]: Points);
    t.change_any(|t| {
        if count == 0 {
            return Ok(());
        }
        let vertices = vertices.if_any()?.map(VertexId::of_numbers);
        if t.is_weighted() {
            return in_weighted!(t => Ok(t.move_parts(PointPart::Place, vertices, positions.numbers(t)?)?));
        }
        in_any!(t => {
            let positions = positions.of(t)?;
            match vertices {
                None => t.move_first(&positions)?,
                Some(vertices) => t.move_vertices(vertices, &positions)?,
            }
        });
        Ok(())
    })
}

/// Stages the insertion of count vertices: all of them, or none if it fails. They are present from the
/// next commit on, which makes them together with the staged moves and removals.
///
/// positions: count points. first_vertex: receives the id of the first, which is one above the highest given so far.
/// The others follow it in their order. It must not be NULL even if count is 0: then it receives the id that would be
/// given next.
///
/// The ids count in deldrift_id_count from now on, though the vertices are not present before the commit
/// (deldrift_is_present). deldrift_copy_positions tells where they will be. deldrift_move_vertices without a list of
/// ids, and deldrift_commit_positions, change that. deldrift_discard_moves forgets the insertions. Their ids are then
/// given again, if none higher has been given since.
///
/// Cost: count, in the mean over many calls.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_stage_insertions(
    t: *mut deldrift_triangulation,
    positions: *const f64,
    count: usize,
    first_vertex: *mut u32,
) -> deldrift_status {
    given!(t: Changing, positions[count]: Points, first_vertex: Output);
    t.change_any(|t| {
        let first_vertex = first_vertex.place()?;
        first_vertex.write(in_any!(t => t.stage_insertions(&positions.of(t)?))?.get());
        Ok(())
    })
}

/// Stages the removal of count vertices: all of them, or none if it fails. The next commit removes them, together with
/// the staged moves and insertions. Until then the vertices are present: they can be asked about, and relocated or
/// removed at once. Moves staged for them are forgotten, and none can be staged any more (DELDRIFT_STAGED_VERTEX).
/// Their entries in arrays without a list of ids are not read. deldrift_discard_moves forgets the removals.
///
/// vertices: count ids, each at most once.
///
/// The commit removes them one by one, or rebuilds where that takes less. It does where many go, or where those with 64
/// neighbours and more have more neighbours in all than there are vertices.
///
/// Cost: count, in the mean over many calls.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX (its
/// removal is staged already, or its insertion is), DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_stage_removals(
    t: *mut deldrift_triangulation,
    vertices: *const u32,
    count: usize,
) -> deldrift_status {
    given!(t: Changing, vertices[count]: Array);
    t.change_any(|t| {
        let vertices = VertexId::of_numbers(vertices.get()?);
        in_any!(t => t.stage_removals(vertices))?;
        Ok(())
    })
}

/// Forgets all staged moves, insertions and removals, of vertices and of segments.
///
/// Cost: what is staged.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_discard_moves(t: *mut deldrift_triangulation) -> deldrift_status {
    given!(t: Changing);
    t.change_any(|t| {
        in_any!(t => t.discard_moves());
        Ok(())
    })
}

/// Makes the staged positions the next timestamp. The cells become those of the Delaunay triangulation of the new
/// positions, whatever the algorithm, or of the constrained one if there are segments. Ids stay. A commit without
/// staged moves is a timestamp too.
///
/// report: receives what was done; may be NULL.
///
/// Cost: of k staged moves, insertions and removals at most k times that of deldrift_relocate_vertex, or that of
/// deldrift_create, whichever the algorithm chooses. Constant if nothing is staged. While there are no cells, that of
/// deldrift_create. Each segment adds the cells around an end, and those that it crosses in the Delaunay triangulation,
/// of k of them up to k².
///
/// Errors: DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_CROSSING, DELDRIFT_ON_SEGMENT,
/// DELDRIFT_END_REMOVED, DELDRIFT_ENDS_MEET (see deldrift_segment_conflicts), DELDRIFT_PASSES_SEGMENT (if the options
/// refuse it; looked for before conflicts), DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. The
/// triangulation then stays at its timestamp, and what is staged stays so.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_commit_timestamp(
    t: *mut deldrift_triangulation,
    report: *mut deldrift_commit_report,
) -> deldrift_status {
    given!(t: Changing, report: Output);
    t.change_any(|t| {
        let report = report.if_any()?;
        let done = in_any!(t => t.commit_timestamp())?;
        if let Some(report) = report {
            report.write(done.into());
        }
        Ok(())
    })
}

/// Moves all vertices and makes that the next timestamp. It is deldrift_move_vertices for all ids and
/// deldrift_commit_timestamp in one, usually without copying the positions.
///
/// positions: count points, one for each id (count must be deldrift_id_count, those of staged insertions included). A
/// vertex whose insertion is staged is inserted where its entry says; entries of removed vertices, and of those whose
/// removal is staged, are not read. They may be read up to the end of the call: neither a callback nor another thread
/// may change them before it returns. report: receives what was done; may be NULL.
///
/// Cost: n + m, and that of deldrift_commit_timestamp for what has moved.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT if there are fewer or more, DELDRIFT_DUPLICATE_MOVE if a move
/// is staged, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject it),
/// DELDRIFT_CROSSING, DELDRIFT_ON_SEGMENT, DELDRIFT_END_REMOVED, DELDRIFT_ENDS_MEET, DELDRIFT_PASSES_SEGMENT (if the
/// options refuse it), DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. The triangulation then
/// stays at its timestamp, no move is staged, and insertions, removals and segments are staged as before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_commit_positions(
    t: *mut deldrift_triangulation,
    positions: *const f64,
    count: usize,
    report: *mut deldrift_commit_report,
) -> deldrift_status {
    given!(t: Changing, positions[count]: Points, report: Output);
    t.change_any(|t| {
        let report = report.if_any()?;
        let done = if t.is_weighted() {
            in_weighted!(t => t.commit_parts(Some(positions.numbers(t)?), None))?
        } else {
            in_any!(t => t.commit_positions(&positions.of(t)?))?
        };
        if let Some(report) = report {
            report.write(done.into());
        }
        Ok(())
    })
}

/// What all commits and immediate calls so far have done, in sum, to *report. Its timestamp, coincident and
/// hidden_by_weight are those of now.
///
/// Cost: constant; for a triangulation with weights, what deldrift_hidden_by_weight costs.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY if t has weights.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_statistics(
    t: *const deldrift_triangulation,
    report: *mut deldrift_commit_report,
) -> deldrift_status {
    given!(t: Reading, report: Output);
    t.tell_any(report, |t| Ok(by_kind!(t => t.statistics_of_now()?, periodic t => t.statistics()).into()))
}

/// An error about arrays of one, told in the names of the single arguments.
fn of_one(mut error: Error) -> Error {
    match &mut error {
        Error::NotFinite { argument, .. } | Error::OutOfRange { argument, .. } => *argument = "position",
        Error::NoSuchVertex { argument, .. }
        | Error::RemovedVertex { argument, .. }
        | Error::StagedVertex { argument, .. }
        | Error::DuplicateMove { argument, .. } => *argument = "vertex",
        _ => {}
    }
    error
}
