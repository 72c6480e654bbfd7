//! Segments that are split where they are in the way of each other.

use super::handle::{Changing, deldrift_triangulation};
use super::pointers::{Output, given};
use super::status::{Failure, deldrift_status};
use crate::either::AnyTriangulation;
use crate::motion::SplitReport;

/// What deldrift_stage_splits has staged.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct deldrift_split_report {
    /// Vertices to be inserted, where segments cross.
    pub inserted: u64,
    /// Segments that are replaced by pieces.
    pub replaced_segments: u64,
    /// Pieces to be made.
    pub pieces: u64,
    /// The number of rounds, each of which splits all segments and pieces that are in the way of each other.
    pub rounds: u64,
    /// The id of the first vertex to be inserted; the others follow it. The id that would be given next if there are
    /// none.
    pub first_vertex: u32,
    /// The id of the first piece; the others follow it, by the ids of their segments, and along each of these from its
    /// first end. The id that would be given next if there are none.
    pub first_piece: u32,
    /// Zero; later versions may tell more.
    pub reserved: [u64; 3],
}

impl From<SplitReport> for deldrift_split_report {
    fn from(report: SplitReport) -> Self {
        deldrift_split_report {
            inserted: report.inserted as u64,
            replaced_segments: report.replaced_segments as u64,
            pieces: report.pieces as u64,
            rounds: report.rounds as u64,
            first_vertex: report.first_vertex.get(),
            first_piece: report.first_piece.get(),
            reserved: [0; 3],
        }
    }
}

/// Splits segments, staged ones and those in force, for which a commit of what is staged would be refused. Call it
/// before the commit. A segment with a vertex on it is replaced by pieces between its ends and such vertices. Two
/// segments that cross get a vertex there. The new vertices and the pieces are staged, and so is the removal of
/// segments in force that pieces take the place of. A staged segment that is split is not made, and its id is not given
/// again. Where nothing is in the way of segments nothing is done.
///
/// Pieces have the marker and the direction of their segment. Segments that overlap have common pieces, with an id for
/// each of them. A crossing is rounded correctly: each coordinate is the number nearest to that of the place where the
/// segments, or pieces of them, cross. If a vertex will be at that place, it is taken, the lowest id of several. Where
/// a place on a segment is rounded to that of an end of the other one, the segment is cut at that end. Pieces are
/// straight between their own ends. So a segment may bend by last places, and come to be in the way of another one:
/// then both are split again. Each coordinate of a vertex on a segment is off by at most rounds halves of a last place
/// of the segment's greatest coordinates, and along the segment both coordinates go one way. The rounds end, as there
/// are finitely many numbers between the ends of a segment. Mostly there are one or two, and more where many segments
/// go through nearly one place.
///
/// limit: the greatest number of vertices to insert; SIZE_MAX for any number. With 0 segments are split only at
/// vertices that are there. report: receives what has been staged; may be NULL.
///
/// Places and ids of the new vertices, and the edges that are required, depend only on positions, vertex ids and
/// segments. They do not depend on the order and directions in which segments were given, nor on what was before. All
/// can be committed or discarded as if the program had staged it. What is staged afterwards may be in the way of
/// pieces, which can be split again. Vertices that were inserted where segments cross stay when segments are removed.
///
/// Passings are not looked at, whatever the options say of them: a vertex that stops on a segment is where the segment
/// is split. The commit looks at them, except at those of pieces and of segments that are removed.
///
/// Cost: that of deldrift_check_staged for each round and once more; for m crossings that of sorting them, and a search
/// among them for each vertex.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D; DELDRIFT_CROSSING if more than limit vertices would be inserted;
/// DELDRIFT_END_REMOVED and DELDRIFT_ENDS_MEET for conflicts that no split resolves, whatever others there are; for
/// these three, deldrift_segment_conflicts tells all conflicts of what is staged; DELDRIFT_COINCIDENT (if the options
/// reject it), DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. After
/// an error what was staged is staged as before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_stage_splits(
    t: *mut deldrift_triangulation,
    limit: usize,
    report: *mut deldrift_split_report,
) -> deldrift_status {
    given!(t: Changing, report: Output);
    t.change(|t| {
        let AnyTriangulation::Plane(t) = t else { return Err(Failure::NotOfThePlane) };
        let place = report.if_any()?;
        let report = t.stage_splits(limit)?;
        if let Some(place) = place {
            place.write(report.into());
        }
        Ok(())
    })
}
