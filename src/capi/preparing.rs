//! Commits in two phases.

use super::handle::{Changing, deldrift_triangulation, in_any};
use super::motion::deldrift_commit_report;
use super::pointers::{Output, given};
use super::status::deldrift_status;

/// The first phase of a commit. It brings the triangulation to the staged moves, insertions, removals and segments, as
/// deldrift_commit_timestamp does, so that every call that reads sees the prepared state. That is not a timestamp yet:
/// deldrift_timestamp gives the last one. deldrift_publish_timestamp makes it the next one, in constant time;
/// deldrift_withdraw_timestamp takes it back. A solver that rejects a step withdraws it; processes that have to agree
/// publish or withdraw together.
///
/// Rounds: while a timestamp is prepared, more may be staged and prepared, any number of times. Each time is another
/// round of the same timestamp, which begins where the last one has ended. A round that fails is taken back alone. The
/// rounds before stay in force, and what was staged for it stays staged.
///
/// report: receives what this round has done; may be NULL. Its timestamp is the one that is prepared.
/// deldrift_statistics counts rounds as they are made.
///
/// While a timestamp is prepared, these calls give DELDRIFT_PREPARED and do nothing: deldrift_commit_timestamp,
/// deldrift_commit_positions, deldrift_commit_weighted, deldrift_set_weight, deldrift_insert_vertex,
/// deldrift_insert_vertex_with_key, deldrift_insert_vertex_with_weight, deldrift_remove_vertex,
/// deldrift_relocate_vertex, deldrift_compact, deldrift_refine, deldrift_coarsen, deldrift_take_changes,
/// deldrift_transfer_cells, deldrift_clone, deldrift_save and deldrift_save_file. All others may be made, those that
/// stage or check what is staged included. Changes are of published states: between two calls of deldrift_take_changes,
/// rounds count as commits once they are published. In deldrift_cells a cell that was there before has the index that
/// it had, as after commits.
///
/// Passings are looked at round by round, each on the way from where the round before has left the vertices.
///
/// Memory: what the rounds have changed is kept until the timestamp is published or withdrawn. Of a round that builds
/// the triangulation anew, all that was before is kept. If deldrift_cells is called, what it brings up to date is kept
/// as well: where most cells have changed, a copy of the arrays.
///
/// Cost: that of deldrift_commit_timestamp. Later rounds also copy where vertices were that the last one has moved. If
/// t is periodic, the first round also makes a copy of t; to publish or withdraw it frees one of both.
///
/// Errors: those of deldrift_commit_timestamp, DELDRIFT_OUT_OF_MEMORY and DELDRIFT_CANCELLED among them, except
/// DELDRIFT_PREPARED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_prepare_timestamp(
    t: *mut deldrift_triangulation,
    report: *mut deldrift_commit_report,
) -> deldrift_status {
    given!(t: Changing, report: Output);
    t.change_any(|t| {
        let report = report.if_any()?;
        let done = in_any!(t => t.prepare_timestamp())?;
        if let Some(report) = report {
            report.write(done.into());
        }
        Ok(())
    })
}

/// The second phase of a commit. The state that deldrift_prepare_timestamp has prepared becomes the next timestamp.
/// What has been staged since the last round stays so. Needs no memory.
///
/// Cost: constant, but where a commit would sort the cells for speed, or t is periodic.
///
/// Errors: DELDRIFT_NOT_PREPARED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_publish_timestamp(t: *mut deldrift_triangulation) -> deldrift_status {
    given!(t: Changing);
    t.change_any(|t| {
        in_any!(t => t.publish_timestamp())?;
        Ok(())
    })
}

/// Takes back what deldrift_prepare_timestamp has prepared, all rounds. The triangulation is as it was at its last
/// timestamp, with nothing staged. Positions, cells with their indices and the order of their corners, neighbours,
/// hidden vertices, segments and statistics are those of that time. So deldrift_save writes the bytes that it would
/// have written then, after deldrift_discard_moves, and deldrift_take_changes gives what it would have given. What has
/// been staged is forgotten, for the rounds or since. Ids that were given for it are given again, those of segments
/// included. Without a prepared timestamp nothing is done, and what is staged stays so.
///
/// What algorithms keep between commits may be computed again by the next one; cells that are new after that may have
/// other indices than without the rounds. Needs no memory, and cannot be refused any.
///
/// Cost: in proportion to what the rounds have changed, and, if deldrift_cells has been called since, to what it has
/// brought up to date.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_withdraw_timestamp(t: *mut deldrift_triangulation) -> deldrift_status {
    given!(t: Changing);
    t.change_any(|t| {
        in_any!(t => t.withdraw_timestamp());
        Ok(())
    })
}
