//! Segments between vertices of the plane, which have to be edges.

use super::domain::of_the_plane;
use super::handle::{Changing, Reading, deldrift_triangulation};
use super::pointers::{Array, Buffer, InBuffer, Output, fill_all, given, write_all};
use super::query::DELDRIFT_NONE;
use super::status::{Failure, deldrift_status};
use crate::either::AnyTriangulation;
use crate::error::Conflict;
use crate::ids::{SegmentId, VertexId};
use crate::in_its_dimension;
use crate::motion::Segment;

/// Why a segment cannot be an edge.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum deldrift_conflict_kind {
    /// Two segments cross at a place that is an end of neither: other is the second one, of the higher id.
    DELDRIFT_CONFLICT_CROSSING = 0,
    /// A vertex is on the segment, and is not one of its ends: other is the one that represents the place: of
    /// several vertices there the lowest id, or key.
    DELDRIFT_CONFLICT_ON_SEGMENT = 1,
    /// An end of the segment has been removed, or would be: other is the end, DELDRIFT_NONE if deldrift_compact has
    /// been called since.
    DELDRIFT_CONFLICT_END_REMOVED = 2,
    /// Both ends of the segment would be at the same place: other is DELDRIFT_NONE.
    DELDRIFT_CONFLICT_ENDS_MEET = 3,
}

/// What is in the way of a segment: see deldrift_segment_conflicts.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct deldrift_conflict {
    /// What other names.
    pub kind: deldrift_conflict_kind,
    /// The id of the segment; of two that cross the lower one.
    pub segment: u32,
    /// The id of a segment or a vertex, or DELDRIFT_NONE, as kind says.
    pub other: u32,
}

impl InBuffer for deldrift_conflict {}

impl From<&Conflict> for deldrift_conflict {
    fn from(conflict: &Conflict) -> Self {
        use deldrift_conflict_kind::*;
        let (kind, segment, other) = match *conflict {
            Conflict::Crossing { segments: [one, other] } => (DELDRIFT_CONFLICT_CROSSING, one, other.get()),
            Conflict::OnSegment { segment, vertex } => (DELDRIFT_CONFLICT_ON_SEGMENT, segment, vertex.get()),
            Conflict::EndRemoved { segment, vertex } => {
                (DELDRIFT_CONFLICT_END_REMOVED, segment, vertex.get())
            }
            Conflict::EndsMeet { segment } => (DELDRIFT_CONFLICT_ENDS_MEET, segment, DELDRIFT_NONE),
        };
        deldrift_conflict { kind, segment: segment.get(), other }
    }
}

/// Stages segments between vertices: all of them, or none if it fails. The next commit makes them, together with the
/// staged moves, insertions and removals. From then on each is an edge, and the cells are the constrained Delaunay
/// triangulation of vertices and segments. The circle of a cell has no vertex inside that can be seen from the cell's
/// inside, where segments are opaque. Ties are broken by id as everywhere, so the cells depend only on positions, ids
/// and segments. Segments move with their ends, and stay until their removal is staged and committed. docs/SEGMENTS.md
/// says more.
///
/// ends: count rows of two vertex ids, in any order, of vertices that are present or whose insertion is staged.
/// markers: count numbers, which are kept with the segments, such as the kind of a boundary condition; NULL for zeros.
/// first_segment: receives the id of the first, which is one above the highest given so far. The others follow it in
/// their order. It must not be NULL even if count is 0: then it receives the id that would be given next. Ids of
/// segments stay, also through deldrift_compact, and are not given again.
///
/// A segment may be given twice, and may be a part of the hull. Many segments may share a vertex. Where vertices are at
/// the same place it goes to the one that represents them. Conflicts are looked for by the commit, and by
/// deldrift_check_staged. Both are refused where segments cross, a vertex is on one, an end is removed, or both ends
/// are at the same place (see deldrift_segment_conflicts). Only the positions after the commit count: a vertex may have
/// gone from one side of a segment to the other, unless the options refuse that (see deldrift_check_passings). Calls
/// that change one vertex at once keep segments, too, and are refused for the same reasons. deldrift_discard_moves also
/// forgets what is staged of segments, and the ids of staged ones are given again. deldrift_staged_count does not count
/// segments.
///
/// Cost: count.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX
/// (the message counts ids in ends: that of row k is ends[2 k] or ends[2 k + 1]), DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_stage_segments(
    t: *mut deldrift_triangulation,
    ends: *const u32,
    markers: *const i32,
    count: usize,
    first_segment: *mut u32,
) -> deldrift_status {
    let ends = ends.cast::<[u32; 2]>();
    given!(t: Changing, ends[count]: Array, markers[count]: Array, first_segment: Output);
    t.change(|t| {
        let AnyTriangulation::Plane(t) = t else { return Err(Failure::NotOfThePlane) };
        let place = first_segment.place()?;
        let ends = ends.get()?;
        let markers = markers.if_any()?;
        let marker = |k: usize| markers.map_or(0, |markers| markers[k]);
        let segments = ends.iter().enumerate().map(|(k, ends)| Segment {
            ends: ends.map(VertexId::new),
            marker: marker(k),
            ..Segment::default()
        });
        place.write(t.stage_segments(segments)?.get());
        Ok(())
    })
}

/// Stages the removal of segments: all of them, or none if it fails. After the next commit they need not be edges any
/// more. Their vertices stay. A vertex that is an end of segments can be removed by the commit that removes these.
///
/// segments: count ids of segments in force, each at most once. Segments that are staged can only be forgotten, by
/// deldrift_discard_moves.
///
/// Cost: count, and that of looking for each among those staged before.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_SEGMENT for an id that is not in
/// force, or whose removal is staged, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_stage_segment_removals(
    t: *mut deldrift_triangulation,
    segments: *const u32,
    count: usize,
) -> deldrift_status {
    given!(t: Changing, segments[count]: Array);
    t.change(|t| {
        let AnyTriangulation::Plane(t) = t else { return Err(Failure::NotOfThePlane) };
        Ok(t.stage_segment_removals(SegmentId::of_numbers(segments.get()?))?)
    })
}

/// The segments in force, ascending by id. They are those of the last commit, and not what is staged. A segment whose
/// removal is staged is in force until the commit.
///
/// segments: a buffer with room for capacity ids. ends: room for capacity rows of two vertex ids, in the order in which
/// they were given; left and right of a segment go by it. markers: room for capacity numbers. count: receives the
/// number of segments.
///
/// Cost: the segments in force.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_segments(
    t: *const deldrift_triangulation,
    segments: *mut u32,
    ends: *mut u32,
    markers: *mut i32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let ends = ends.cast::<[u32; 2]>();
    given!(t: Reading, segments[capacity]: Buffer, ends[capacity]: Buffer, markers[capacity]: Buffer, count: Output);
    t.read(|t| {
        let t = of_the_plane(t)?;
        let needed = t.segments().count();
        fill_all(count, needed, capacity, [segments.offer(), ends.offer(), markers.offer()], || {
            // Each of them is looked at before one is written.
            let (segments, ends) = (segments.places_if_any(needed)?, ends.places_if_any(needed)?);
            let markers = markers.places_if_any(needed)?;
            write_all(segments, t.segments().map(|(id, _)| id.get()));
            write_all(ends, t.segments().map(|(_, segment)| segment.ends.map(VertexId::get)));
            write_all(markers, t.segments().map(|(_, segment)| segment.marker));
            Ok(())
        })
    })
}

/// Whether a commit of what is staged would be refused because of segments. It returns what deldrift_commit_timestamp
/// would return as far as segments are concerned, and commits nothing: what is staged stays so.
/// deldrift_segment_conflicts then tells all conflicts, so that a solver can cut its step. Without segments, in force
/// or staged, as in 3D, nothing is looked at. It ends views, as a commit does.
///
/// A program that commits at once where nothing conflicts need not check first: a commit that is refused has no effect,
/// and tells the conflicts as well.
///
/// Cost: at most that of the commit, and of taking it back.
///
/// Errors: those of deldrift_commit_timestamp: DELDRIFT_CROSSING, DELDRIFT_ON_SEGMENT, DELDRIFT_END_REMOVED and
/// DELDRIFT_ENDS_MEET for conflicts, of which the first is told, DELDRIFT_PASSES_SEGMENT (if the options refuse it;
/// then conflicts have not been looked for), DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_TOO_MANY_CELLS,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_check_staged(t: *mut deldrift_triangulation) -> deldrift_status {
    given!(t: Changing);
    t.change(|t| in_its_dimension!(t => Ok(t.check_staged()?)))
}

/// The conflicts for which the latest call that changes or checks t was refused, in ascending order of kind, segment
/// and other. There are none if it was not refused for conflicts. Ids may be those of segments and vertices that were
/// staged, and have been discarded since.
///
/// This list and that of deldrift_passings are both of one call, the latest of deldrift_commit_timestamp,
/// deldrift_commit_positions, deldrift_prepare_timestamp, deldrift_check_staged, deldrift_check_passings,
/// deldrift_stage_splits, deldrift_relocate_vertex, deldrift_insert_vertex, deldrift_insert_vertex_with_key,
/// deldrift_remove_vertex, deldrift_refine, deldrift_coarsen and deldrift_compact. Each of them empties both lists when
/// it begins, whatever comes of it. It does not if it is turned away with DELDRIFT_PREPARED or DELDRIFT_BUSY, or for a
/// pointer or a structure that is no good. Calls that stage, discard, publish, withdraw or ask keep both lists. A copy
/// has none, and neither has what is loaded.
///
/// conflicts: a buffer with room for capacity entries. count: receives their number.
///
/// Where several segments are at one edge, each has conflicts of its own. A segment that loses both ends has a conflict
/// for each. A segment without two ends has conflicts of the kinds DELDRIFT_CONFLICT_END_REMOVED and
/// DELDRIFT_CONFLICT_ENDS_MEET, and no others are looked for.
///
/// Cost: the number of conflicts.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_segment_conflicts(
    t: *const deldrift_triangulation,
    conflicts: *mut deldrift_conflict,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, conflicts[capacity]: Buffer, count: Output);
    t.read(|t| {
        let t = of_the_plane(t)?;
        let found = t.conflicts_of_segments();
        conflicts.fill(count, found.len(), || Ok(found.iter().map(deldrift_conflict::from)))
    })
}

/// Whether vertices would pass segments in a commit of what is staged, whatever the options say of passings. It commits
/// nothing, and what is staged stays so. deldrift_passings then tells all that would. A program that asks before each
/// commit knows which values to take over from the other side, or cuts its step. With the option passing, commits look
/// for passings themselves.
///
/// A commit compares positions at two timestamps. It accepts a vertex that has jumped across a segment, or a whole loop
/// of segments that has jumped across a vertex. What has happened in between is defined so: each vertex goes straight
/// from its old place to its new one, at constant speed, and so do both ends of each segment that is in force before
/// and after. A vertex passes a segment, of which it is no end, if it goes through it and is not back on its side when
/// the step ends. This is decided exactly. Where f(s, t) = p(t) - a(t) - s (b(t) - a(t)) is 0, for s and t from 0 to 1,
/// vertex p is on the segment from a to b. It passes if the sum over these zeros, each counted as 1 or -1 by the
/// direction, is not 0. The sum is the number of times that the quadrilateral p0 - a0, p0 - b0, p1 - b1, p1 - a1 winds
/// around the origin. The vertex also passes if the origin is on the quadrilateral: then it goes exactly through an end
/// on its way, or stops on the segment.
///
/// A vertex that crosses a segment and returns within one step is not told, as the end of the step is legal. Nor is one
/// that is at the place of an end of the segment before or after, as it is on no side there. Vertices that the commit
/// inserts or removes do not move, and pass nothing. Nothing passes segments that are staged, or whose removal is. Ends
/// of segments are vertices as others, so two segments that go through each other are told by their ends. So are hidden
/// vertices, which move with those that represent them, or part from them. A vertex that goes around the end of a slit
/// is told if it goes through the slit on its straight way: what passes is a matter of the step, not of the region that
/// a vertex is in. One that enters a loop through one segment and leaves it through another is told for both.
///
/// Cost: where many vertices move, a pass over them, and a test for each that is near segments at any time of the step;
/// less than a commit of small moves. Where some move, and no ends of segments, that of looking at them and the
/// segments.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_PASSES_SEGMENT if a vertex would pass a segment, of which the
/// message names the first, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_check_passings(t: *mut deldrift_triangulation) -> deldrift_status {
    given!(t: Changing);
    t.change(|t| {
        let AnyTriangulation::Plane(t) = t else { return Err(Failure::NotOfThePlane) };
        Ok(t.check_passings()?)
    })
}

/// The vertices that pass segments in the step that the latest call has looked at, in ascending order of segment and
/// vertex. That call is deldrift_check_passings or, if the options say so, a commit, deldrift_prepare_timestamp,
/// deldrift_check_staged or deldrift_relocate_vertex. With DELDRIFT_PASSING_TELL these vertices have passed in the
/// latest commit, with DELDRIFT_PASSING_REFUSE it was refused for them. deldrift_segment_conflicts says which calls
/// empty the list.
///
/// segments, vertices: buffers with room for capacity ids. Entry k of vertices passes entry k of segments. count:
/// receives their number.
///
/// Cost: their number.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_passings(
    t: *const deldrift_triangulation,
    segments: *mut u32,
    vertices: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, segments[capacity]: Buffer, vertices[capacity]: Buffer, count: Output);
    t.read(|t| {
        let found = of_the_plane(t)?.passings();
        fill_all(count, found.len(), capacity, [segments.offer(), vertices.offer()], || {
            // Each of them is looked at before one is written.
            let segments = segments.places_if_any(found.len())?;
            let vertices = vertices.places_if_any(found.len())?;
            write_all(segments, found.iter().map(|passing| passing.segment.get()));
            write_all(vertices, found.iter().map(|passing| passing.vertex.get()));
            Ok(())
        })
    })
}
