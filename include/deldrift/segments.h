/*
 * deldrift/segments.h: Segments in the plane, the domains that they bound, and the refinement of these.
 *
 * A part of deldrift.h, the first page of which has the rules that hold for all functions.
 *
 * Made by `make header` from these files of src/capi: segments.rs, splitting.rs, domain.rs, regions.rs, refining.rs.
 * Change it there.
 *
 * Segments between vertices of the plane, which have to be edges.
 *
 *     deldrift_stage_segments: Stages segments between vertices: all of them, or none if it fails.
 *     deldrift_stage_segment_removals: Stages the removal of segments: all of them, or none if it fails.
 *     deldrift_segments: The segments in force, ascending by id.
 *     deldrift_check_staged: Whether a commit of what is staged would be refused because of segments.
 *     deldrift_segment_conflicts: The conflicts for which the latest call that changes or checks t was refused, in
 *         ascending order of kind, segment and other.
 *     deldrift_check_passings: Whether vertices would pass segments in a commit of what is staged, whatever the options
 *         say of passings.
 *     deldrift_passings: The vertices that pass segments in the step that the latest call has looked at, in ascending
 *         order of segment and vertex.
 *
 * Segments that are split where they are in the way of each other.
 *
 *     deldrift_stage_splits: Splits segments, staged ones and those in force, for which a commit of what is staged
 *         would be refused.
 *
 * What segments divide the plane into: levels, labels, and boundaries in chains.
 *
 *     deldrift_segments_of_cells: The segments at the edges of each cell, in the order of deldrift_cells: entry i of a
 *         row is the segment at the edge opposite corner i.
 *     deldrift_cells_of_segments: The cells on both sides of each segment in force, in the order of deldrift_segments.
 *     deldrift_nesting_levels: The nesting level of each cell, in the order of deldrift_cells: the least number of
 *         edges with segments on a path from the cell to the outside.
 *     deldrift_crossing_numbers: The crossing number of each cell, in the order of deldrift_cells: the least number of
 *         segments on a path from the cell to the outside, where each segment at an edge counts.
 *     deldrift_label_cells: A label for each cell, in the order of deldrift_cells: the label of the first seed in its
 *         region.
 *     deldrift_update_labels: Computes the labels of some cells again, in an array that deldrift_label_cells has
 *         filled, or that is filled with nesting levels.
 *     deldrift_boundary_chains: The boundary of some of the cells of the plane, in closed chains of edges, which have
 *         these cells on their left.
 *
 * Labels of regions that follow: the sides of segments keep them.
 *
 *     deldrift_set_regions: Gives regions labels that follow them.
 *     deldrift_set_segment_sides: Gives labels to the sides of segments; deldrift_set_regions does so for all of them,
 *         by labels of cells.
 *     deldrift_regions: The label of the region of each cell, in the order of deldrift_cells.
 *
 * Refinement and coarsening of the cells of a domain.
 *
 *     deldrift_quality_init: Sets a quality to the defaults: no criterion.
 *     deldrift_refine: Inserts vertices into cells of the plane, and on segments at these, until the cells there are of
 *         a quality.
 *     deldrift_coarsen: Removes vertices that deldrift_refine has inserted and that are not needed any more.
 *     deldrift_made_vertices: The vertices that deldrift_refine has inserted and that are present, ascending by id.
 *     deldrift_original_segments: The original of each segment in force, in the order of deldrift_segments.
 *     deldrift_refined_weights: How linear values at the vertices that the last deldrift_refine inserted, in the order
 *         of their ids, follow from those at the vertices before.
 *     deldrift_refined_sizes: The sizes of the vertices that the last deldrift_refine inserted, in the order of their
 *         ids: the greatest length of edges that it had there, from those given in quality.sizes at the vertices
 *         before.
 *     deldrift_refined_vertices: The vertices that the last deldrift_refine inserted, ascending by id.
 */

#ifndef DELDRIFT_SEGMENTS_H
#define DELDRIFT_SEGMENTS_H

#include "core.h"

/// No label.
#define DELDRIFT_NO_LABEL (-2147483647 - 1)

/// Why a segment cannot be an edge.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_conflict_kind : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
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
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_conflict_kind deldrift_conflict_kind;
#else
typedef uint32_t deldrift_conflict_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// Which cells deldrift_refine and deldrift_coarsen work on where they are given no mask.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_domain : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// Those with an odd nesting level: see deldrift_nesting_levels.
    DELDRIFT_DOMAIN_NESTING = 0,
    /// Those with an odd crossing number, as the even-odd rule has it: see deldrift_crossing_numbers.
    DELDRIFT_DOMAIN_EVEN_ODD = 1,
    /// All within closed chains of segments: those with a nesting level above 0.
    DELDRIFT_DOMAIN_INSIDE = 2,
    /// Those in regions with a label above 0: see deldrift_regions.
    DELDRIFT_DOMAIN_REGIONS = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_domain deldrift_domain;
#else
typedef uint32_t deldrift_domain;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// Which segments deldrift_refine keeps whole.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_kept : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// None: the quality is reached wherever angles between segments allow it.
    DELDRIFT_KEPT_NONE = 0,
    /// Those with cells to be refined on one side only: the boundary of the cells that are refined.
    DELDRIFT_KEPT_OUTER = 1,
    /// All.
    DELDRIFT_KEPT_ALL = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_kept deldrift_kept;
#else
typedef uint32_t deldrift_kept;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// What is in the way of a segment: see deldrift_segment_conflicts.
typedef struct deldrift_conflict {
    /// What other names.
    deldrift_conflict_kind kind;
    /// The id of the segment; of two that cross the lower one.
    uint32_t segment;
    /// The id of a segment or a vertex, or DELDRIFT_NONE, as kind says.
    uint32_t other;
} deldrift_conflict;

/// What deldrift_stage_splits has staged.
typedef struct deldrift_split_report {
    /// Vertices to be inserted, where segments cross.
    uint64_t inserted;
    /// Segments that are replaced by pieces.
    uint64_t replaced_segments;
    /// Pieces to be made.
    uint64_t pieces;
    /// The number of rounds, each of which splits all segments and pieces that are in the way of each other.
    uint64_t rounds;
    /// The id of the first vertex to be inserted; the others follow it. The id that would be given next if there are
    /// none.
    uint32_t first_vertex;
    /// The id of the first piece; the others follow it, by the ids of their segments, and along each of these from its
    /// first end. The id that would be given next if there are none.
    uint32_t first_piece;
    /// Zero; later versions may tell more.
    uint64_t reserved[3];
} deldrift_split_report;

/// What deldrift_refine and deldrift_coarsen work towards, and how. Initialise it with deldrift_quality_init, then set
/// what should differ from the defaults. Without a criterion nothing is done.
///
/// The structure may grow in later versions, as deldrift_options does. struct_size says how much of it the program
/// knows.
typedef struct deldrift_quality {
    /// sizeof(deldrift_quality) as the program sees it.
    size_t struct_size;
    /// The least angle of a cell in degrees, up to 34; 0, the default, for any. Up to 26.5 degrees it is proved that
    /// all cells have it wherever angles between segments are at least 60 degrees and no vertex is within 1,024 last
    /// places of the greatest coordinate of another one or of a segment. Above that they do in practice. Refinement
    /// ends for all angles and domains, as no vertex is inserted that is so near to another one.
    double least_angle;
    /// The greatest area of a cell; 0, the default, for any.
    double greatest_area;
    /// A label for each cell, in the order of deldrift_cells, as deldrift_label_cells gives them. NULL, the default,
    /// stands for those of deldrift_regions, with 0 for other.
    const int32_t *labels;
    /// How many labels there are: as many as cells, or 0.
    size_t label_count;
    /// The greatest area of cells by label, 0 for any. Entry k is that of label k; labels below 0 and beyond the
    /// entries have none. New cells have the label of the region that they are in. NULL by default.
    const double *areas;
    /// How many areas there are.
    size_t area_count;
    /// By vertex id the greatest length of edges there: no edge of a cell is longer than the mean at its corners. New
    /// vertices have sizes in between. Entries are above 0, infinity for any; those of removed vertices are not used.
    /// NULL, the default, is no criterion.
    const double *sizes;
    /// How many sizes there are: as many as ids, or 0.
    size_t size_count;
    /// Another criterion: whether a cell is too large, given the coordinates of its corners, 6 numbers,
    /// counter-clockwise. It gives 1 if the cell is too large, otherwise 0. It has to give the same answer for the same
    /// corners, and 0 for cells that are small enough. A number below 0 stops: it is not called again, and the call
    /// ends in DELDRIFT_CANCELLED and has had no effect. It is called from inside the call as the callbacks of
    /// deldrift_options are. NULL, the default, for none.
    int (*is_too_large)(void *user_data, const double *corners);
    /// Handed to is_too_large as it is.
    void *user_data;
    /// Which segments deldrift_refine keeps whole: default DELDRIFT_KEPT_NONE. Cells at those that it keeps may stay
    /// bad.
    deldrift_kept keeps;
    /// Not 0 if deldrift_refined_weights will be called. Default 0.
    uint32_t has_weights;
    /// Not 0 if no corner of a cell is to be strictly inside the circle that has a segment at the cell for a diameter.
    /// Then no vertex is inside the circle of a cell that it sees, segments or not: a conforming Delaunay
    /// triangulation. Segments that are kept whole may still have such corners, and so may those that a vertex touches
    /// and those at narrow gaps (see unsplit). What is said of 26.5 degrees then holds up to 20.7, and there are more
    /// cells. Default 0: segments are split where angles, areas and lengths need it.
    uint32_t is_conforming;
    /// Greatest number of vertices that deldrift_refine inserts: default SIZE_MAX.
    size_t limit;
    /// By how many degrees the angles of cells that deldrift_coarsen makes have to be above the least one, so that the
    /// removed vertex is not needed again at once: from 0 to 30, default 2.
    double margin;
    /// The share of the greatest areas and lengths that cells may have that deldrift_coarsen makes: above 0 and at most
    /// 1, default 0.9.
    double share;
    /// deldrift_coarsen joins two pieces of a segment if the vertex between them is on the line through their other
    /// ends, or off it by no more than this share of their distance: from 0 to 1. If the share is above 0, the vertex
    /// may always be off by 64 last places of the greatest coordinate. The default, 1e-9, is above what the rounding of
    /// motions adds up to.
    double joins;
    /// How many times as many vertices as a mesh made anew the mesh may have: 1 or more, default 1.1. Where
    /// deldrift_coarsen leaves more of those that deldrift_refine has inserted, or takes many away for another quality,
    /// the next deldrift_refine makes the mesh anew on a copy. If that has fewer vertices by this factor it takes it,
    /// in its one commit, and its report tells what was removed. Infinity for never. Not done with sizes.
    double growth;
    /// Not 0 if deldrift_refine gives its vertices free ids, as deldrift_stage_insertions_at_free_ids does: those of
    /// vertices that earlier commits have removed, the lowest first, and then new ones. deldrift_refined_vertices tells
    /// which. So deldrift_id_count does not grow for ever. From the first insertion on vertices then have keys, as if
    /// these had been given (see deldrift_keys): those that deldrift_refine inserts the greatest one, the others their
    /// ids. A program that transfers means of cells takes the changes between deldrift_coarsen and deldrift_refine as
    /// well, as a cell with the ids of a former one is not listed. Default 0.
    uint32_t reuses_ids;
    /// Which cells are refined without a mask: default DELDRIFT_DOMAIN_NESTING.
    deldrift_domain domain;
} deldrift_quality;

/// What deldrift_refine or deldrift_coarsen did.
typedef struct deldrift_quality_report {
    /// Vertices inserted. Their ids are the last ones below deldrift_id_count, or those of deldrift_refined_vertices if
    /// quality.reuses_ids was set.
    uint64_t inserted;
    /// How many of them are on segments.
    uint64_t on_segments;
    /// Vertices removed.
    uint64_t removed;
    /// Segments removed, as pieces have replaced a segment, or a segment pieces.
    uint64_t replaced_segments;
    /// Segments made. Their ids are the last ones that have been given.
    uint64_t new_segments;
    /// Pieces that had to be split and are whole, as there is no room for a vertex between their ends, as a vertex
    /// touches them (it is beside them by less than 1,024 last places of the greatest coordinate), or as what they
    /// had to be split for is across a narrow gap: one between two nearly parallel segments that is narrower than
    /// 1 / 8,192 of the shorter one.
    uint64_t unsplit;
    /// Cells that are still bad, of those that were to be refined: at small angles between segments, in narrow gaps
    /// between them, at segments that are kept whole, and where the limit was reached. What is_conforming asks of
    /// segments does not count.
    uint64_t bad_cells;
    /// 1 if the limit was reached, otherwise 0.
    uint64_t is_cut_short;
    /// Zero; later versions may count more.
    uint64_t reserved[4];
} deldrift_quality_report;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// ---------------------------------------------------------------------------------------------------------------------
// Segments between vertices of the plane, which have to be edges.
// ---------------------------------------------------------------------------------------------------------------------

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
deldrift_status deldrift_stage_segments(deldrift_triangulation *t,
                                        const uint32_t *ends,
                                        const int32_t *markers,
                                        size_t count,
                                        uint32_t *first_segment);

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
deldrift_status deldrift_stage_segment_removals(deldrift_triangulation *t,
                                                const uint32_t *segments,
                                                size_t count);

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
deldrift_status deldrift_segments(const deldrift_triangulation *t,
                                  uint32_t *segments,
                                  uint32_t *ends,
                                  int32_t *markers,
                                  size_t capacity,
                                  size_t *count);

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
deldrift_status deldrift_check_staged(deldrift_triangulation *t);

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
deldrift_status deldrift_segment_conflicts(const deldrift_triangulation *t,
                                           deldrift_conflict *conflicts,
                                           size_t capacity,
                                           size_t *count);

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
deldrift_status deldrift_check_passings(deldrift_triangulation *t);

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
deldrift_status deldrift_passings(const deldrift_triangulation *t,
                                  uint32_t *segments,
                                  uint32_t *vertices,
                                  size_t capacity,
                                  size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Segments that are split where they are in the way of each other.
// ---------------------------------------------------------------------------------------------------------------------

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
deldrift_status deldrift_stage_splits(deldrift_triangulation *t,
                                      size_t limit,
                                      deldrift_split_report *report);

// ---------------------------------------------------------------------------------------------------------------------
// What segments divide the plane into: levels, labels, and boundaries in chains.
// ---------------------------------------------------------------------------------------------------------------------

/// The segments at the edges of each cell, in the order of deldrift_cells: entry i of a row is the segment at the edge
/// opposite corner i. It is the lowest id if there are several, DELDRIFT_NONE if there is none. Ids are not places in
/// the lists of deldrift_segments once segments have been removed.
///
/// segments: a buffer with room for capacity rows of 3 ids. count: receives the number of cells.
///
/// Cost: m, and for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_segments_of_cells(const deldrift_triangulation *t,
                                           uint32_t *segments,
                                           size_t capacity,
                                           size_t *count);

/// The cells on both sides of each segment in force, in the order of deldrift_segments.
///
/// cells: a buffer with room for capacity rows of 2 cells: the one on the left of the segment, as seen from its first
/// end along it, and the one on its right. The outside is DELDRIFT_NONE, and so are both while there are no cells.
/// count: receives the number of segments.
///
/// Cost: for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_cells_of_segments(const deldrift_triangulation *t,
                                           uint32_t *cells,
                                           size_t capacity,
                                           size_t *count);

/// The nesting level of each cell, in the order of deldrift_cells: the least number of edges with segments on a path
/// from the cell to the outside.
///
/// Cells outside of all closed chains of segments have 0, those of a domain 1, those of its holes 2, those of islands
/// in these 3, and so on. The cells of the domain are those with an odd number. A segment with one region on both
/// sides, such as a slit or an open chain, divides nothing, and several at the same edge count once. No seed is needed,
/// and cells between the domain and the convex hull have 0. A domain that is divided in parts by further segments needs
/// deldrift_label_cells: parts that do not touch the outside would have a higher level.
///
/// deldrift_refine takes these levels by default. For them a segment is a wall, however often it has been drawn: a side
/// that two parts share, or an outline that is there twice, bounds what it would bound alone. deldrift_crossing_numbers
/// is for chains that are meant by the even-odd rule.
///
/// levels: a buffer with room for capacity numbers. count: receives the number of cells.
///
/// Exact. Cost: m, and for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_nesting_levels(const deldrift_triangulation *t,
                                        uint32_t *levels,
                                        size_t capacity,
                                        size_t *count);

/// The crossing number of each cell, in the order of deldrift_cells: the least number of segments on a path from the
/// cell to the outside, where each segment at an edge counts. Cells with an odd number are those that the even-odd rule
/// fills.
///
/// If segments form closed chains, an even number of them ends at each vertex, and any two paths from a cell differ by
/// an even number of crossings. So the number is odd exactly if a ray from the cell crosses an odd number of segments.
/// A notch that is given as a second chain along a side is then no part of the domain, and neither is anything if an
/// outline is given twice. With deldrift_nesting_levels, which differs only where an edge has several segments, both
/// are. The direction in which segments were given does not matter. Pieces of deldrift_stage_splits and deldrift_refine
/// count each, as the segments do that they come from. At open chains, as slits and interfaces that divide a domain,
/// the least number decides.
///
/// numbers: a buffer with room for capacity numbers. count: receives the number of cells.
///
/// Exact. Cost: m, s log s for s segments, and for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_crossing_numbers(const deldrift_triangulation *t,
                                          uint32_t *numbers,
                                          size_t capacity,
                                          size_t *count);

/// A label for each cell, in the order of deldrift_cells: the label of the first seed in its region. A region is a set
/// of cells that can be reached from each other without crossing a segment.
///
/// seeds: seed_count rows of 2 coordinates. labels: as many numbers, any. A seed outside of the convex hull labels
/// nothing. other: the label of cells in whose region no seed is. label_of: a buffer with room for capacity numbers.
/// count: receives the number of cells.
///
/// Holes are regions, too: give their seeds a label of their own. Without segments there is one region. A seed on a
/// segment with one region on both sides is in that region. The outside of the convex hull is a region like the others,
/// together with the regions from which it is reached without crossing a segment. So a seed on the hull, at a segment
/// that bounds a region or at a corner of such segments, is on the boundary of two regions.
///
/// Exact. Cost: m, for each segment the cells around an end, and for each seed that of deldrift_locate.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_AMBIGUOUS_SEED for one that is exactly on the boundary of several regions, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_label_cells(const deldrift_triangulation *t,
                                     const double *seeds,
                                     const int32_t *labels,
                                     size_t seed_count,
                                     int32_t other,
                                     int32_t *label_of,
                                     size_t capacity,
                                     size_t *count);

/// Computes the labels of some cells again, in an array that deldrift_label_cells has filled, or that is filled with
/// nesting levels. Each listed cell gets the label of the cells, not listed, from which it is reached without crossing
/// a segment. Other entries are not touched.
///
/// cells: cell_count indices into deldrift_cells, in any order, some maybe more than once: the created ones of
/// deldrift_take_changes, and those that have been turned over. A cell that was turned over is not in the change list;
/// its row lists its corners in the opposite order. It needs a label too: where the end of a segment goes to the other
/// side of two vertices, the cell of the three is now beyond the segment, though no vertex has passed one. other: the
/// label of the cells outside of all closed chains of segments, along the hull. For nesting levels it is 0, for labels
/// what deldrift_label_cells was given as other, or the label of a seed there. Three kinds of cells get it: those that
/// are reached from the outside of the hull alone, those that are reached from listed cells alone, and those that are
/// reached from cells of different labels. label_of: an array of capacity numbers, of which those of cells that are not
/// listed are read. capacity: at least deldrift_cell_count. undecided: receives the number of cells of the last two
/// kinds. If it is not 0, a region has listed cells only, or touches two labels, and it is time for
/// deldrift_label_cells.
///
/// deldrift_update_circumcentres has the steps by which an array for all cells is brought up to date. While segments
/// stay, and vertices move without passing any, labels stay with their regions, as deldrift_label_cells would have them
/// for seeds that move with these. Where a commit adds segments, both parts of a region have its label. Where it
/// removes segments between regions of different labels, either label may go on: label anew then.
///
/// Exact. Cost: of k cells k log k, and k log s for s segments.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_FACET for an index that is no
/// cell's, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_update_labels(const deldrift_triangulation *t,
                                       const uint32_t *cells,
                                       size_t cell_count,
                                       int32_t other,
                                       int32_t *label_of,
                                       size_t capacity,
                                       size_t *undecided);

/// The boundary of some of the cells of the plane, in closed chains of edges, which have these cells on their left. An
/// outer boundary goes counter-clockwise, that of a hole clockwise. With the mask of the cells that have an odd nesting
/// level it is the boundary of a domain, and the markers of its segments tell what holds there.
///
/// mask: mask_count bytes, one for each cell in the order of deldrift_cells (mask_count must be deldrift_cell_count); a
/// cell is in the set if its byte is not 0. The others are buffers with room for capacity entries, one for each edge.
/// vertices: where the edge begins. It ends where the next edge of its chain begins, the last one where the first of
/// its chain does. chains: the chain that it is in: 0, 1, ..., ascending. segments: the segment at it, the lowest id if
/// there are several, DELDRIFT_NONE if there is none. cells: the cell of the set beside it. corners: which of its
/// corners (0, 1, 2) is opposite. count: receives the number of edges.
///
/// No chain crosses another, or itself: where parts of the set touch in a vertex, each part has a chain of its own.
/// Each chain begins with its least edge, by the id of the vertex where an edge begins and then of that where it ends.
/// Chains are in the order of these edges. So vertices, chains and segments depend only on the set.
///
/// Exact. Cost: m, e log e for e edges, and for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_WRONG_COUNT, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_boundary_chains(const deldrift_triangulation *t,
                                         const uint8_t *mask,
                                         size_t mask_count,
                                         uint32_t *vertices,
                                         uint32_t *chains,
                                         uint32_t *segments,
                                         uint32_t *cells,
                                         uint8_t *corners,
                                         size_t capacity,
                                         size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Labels of regions that follow: the sides of segments keep them.
// ---------------------------------------------------------------------------------------------------------------------

/// Gives regions labels that follow them. A domain is described once, and deldrift_regions tells the label of each cell
/// from then on. A region is a set of cells that can be reached from each other without crossing a segment.
///
/// labels: a number for each cell, in the order of deldrift_cells, one for each region: those of deldrift_label_cells,
/// deldrift_nesting_levels or deldrift_crossing_numbers, or others. label_count: deldrift_cell_count. NULL and 0 take
/// all labels away.
///
/// Both sides of each segment in force get the label of the cell there, DELDRIFT_NO_LABEL beyond the hull. They keep it
/// while segments move with their ends, and hand it on to the pieces that deldrift_refine, deldrift_coarsen and
/// deldrift_stage_splits make. Clones have it, and so has what is saved and loaded. So labels follow through all calls,
/// as long as no vertex passes a segment (see deldrift_check_passings). A segment that is added later has no labels.
/// The regions on both sides keep theirs if they have other segments, or are given some by deldrift_set_segment_sides.
/// Ends no views.
///
/// Cost: m, and for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT, DELDRIFT_INVALID_VALUE for a
/// cell with another label than one of its region beside it, DELDRIFT_PREPARED, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_set_regions(deldrift_triangulation *t,
                                     const int32_t *labels,
                                     size_t label_count);

/// Gives labels to the sides of segments; deldrift_set_regions does so for all of them, by labels of cells. It is for a
/// domain that is described by what is on the left and on the right of each segment, and for segments that are added to
/// one.
///
/// segments: count ids, in force or staged. If one is listed twice the last row counts. sides: a row of 2 labels for
/// each: on the left, as seen from its first end along it, and on the right. DELDRIFT_NO_LABEL is none. Ends no views.
///
/// Cost: count.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_SEGMENT, DELDRIFT_PREPARED; then
/// none is changed.
deldrift_status deldrift_set_segment_sides(deldrift_triangulation *t,
                                           const uint32_t *segments,
                                           const int32_t *sides,
                                           size_t count);

/// The label of the region of each cell, in the order of deldrift_cells. It is the label of the sides of the region's
/// outer boundary, which deldrift_set_regions and deldrift_set_segment_sides have given. Where these have none, it is
/// that of the sides around islands in it. So a region keeps its label when an island jumps into it, or out of it.
///
/// other: the label of cells from which the outside of the hull is reached without crossing a segment, and of undecided
/// ones. labels: a buffer with room for capacity numbers. count: receives the number of cells. undecided: receives the
/// number of cells in other regions whose sides have several labels, or none; may be NULL. If it is not 0, segments
/// have been added or removed, or vertices have passed segments, and it is time for deldrift_set_regions.
///
/// Exact. Cost: m, and for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_regions(const deldrift_triangulation *t,
                                 int32_t other,
                                 int32_t *labels,
                                 size_t capacity,
                                 size_t *count,
                                 size_t *undecided);

// ---------------------------------------------------------------------------------------------------------------------
// Refinement and coarsening of the cells of a domain.
// ---------------------------------------------------------------------------------------------------------------------

/// Sets a quality to the defaults: no criterion.
///
/// Cost: constant.
deldrift_status deldrift_quality_init(deldrift_quality *quality);

/// Inserts vertices into cells of the plane, and on segments at these, until the cells there are of a quality. It is
/// one commit of its own, all or nothing, and deldrift_take_changes tells what it has changed. docs/SEGMENTS.md has a
/// loop that moves, commits, coarsens and refines.
///
/// quality: what is wanted. mask: mask_count bytes, one for each cell in the order of deldrift_cells (mask_count must
/// be deldrift_cell_count). Cells are refined if their byte is not 0. They have to end at segments: an edge beyond
/// which there is no cell, or one that is not refined, has to have one. NULL with mask_count 0 stands for the domain
/// (see deldrift_domain): by default the cells that have an odd nesting level. report: receives what was done; may be
/// NULL. Views end only if anything was inserted or removed.
///
/// A segment that gets a vertex is removed, and pieces take its place, with its marker (see
/// deldrift_original_segments). The places of new vertices are rounded, and pieces are straight between their own ends.
/// Some cells stay bad: between segments at a small angle, in narrow gaps between segments (see unsplit), at segments
/// that stay whole, and where there is no room for a vertex. The report tells how many.
///
/// After a deldrift_coarsen it may make the mesh anew, where that has fewer vertices by a factor (see growth). Then it
/// also removes vertices that it has inserted, in its one commit.
///
/// Where all is good already, nothing is committed.
///
/// Cost: a comparison of the m cells with those that this call or deldrift_coarsen has looked at last, a test of those
/// alone that are others, or of which corners, labels or sizes are, s log s for s segments, and for each vertex
/// inserted, on the average, a constant. Without a mask also that of deldrift_nesting_levels, or
/// deldrift_crossing_numbers, unless nothing has changed since a call with the same domain. With is_too_large all
/// cells are tested. Where no place, cell or segment has changed since one of the calls has found all to be good with
/// these numbers: comparing mask, labels and sizes.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_OPTIONS for struct_size, keeps
/// and domain, DELDRIFT_WRONG_COUNT, DELDRIFT_INVALID_VALUE for a number of quality that has no meaning, those for
/// deldrift_coarsen included, and for a mask that does not end at segments, DELDRIFT_UNDECIDED_REGIONS where the labels
/// of regions are used: for the domain, and for areas without labels of cells, DELDRIFT_STAGED_VERTEX if anything is
/// staged, DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED, and
/// DELDRIFT_ON_SEGMENT and DELDRIFT_CROSSING where pieces that are bent by rounding would touch others (see
/// deldrift_segment_conflicts).
deldrift_status deldrift_refine(deldrift_triangulation *t,
                                const deldrift_quality *quality,
                                const uint8_t *mask,
                                size_t mask_count,
                                deldrift_quality_report *report);

/// Removes vertices that deldrift_refine has inserted and that are not needed any more. Without them the cells are
/// still of the quality, by a margin. Pieces of a segment are joined again. It is one commit of its own, all or
/// nothing, and deldrift_take_changes tells what it has changed.
///
/// The arguments are those of deldrift_refine. has_weights, limit and reuses_ids of the quality are not used; keeps
/// says what it would do.
///
/// Around cells that are of lower quality already, new cells may have angles as small. So call it before
/// deldrift_refine, which then has less to insert. Vertices that stay keep their ids, and so values by id stay, too:
/// one pass after deldrift_refine carries them over both (see deldrift_refined_weights).
///
/// Cost: that of deldrift_refine where all is good, and for each vertex that deldrift_refine has inserted, and around
/// which cells are others than at the last call, or at segments, at most that of looking at these. Where no place,
/// cell or segment has changed since this call has found nothing to remove with these numbers: comparing mask, labels
/// and sizes.
///
/// Errors: those of deldrift_refine: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_OPTIONS
/// for struct_size, keeps and domain, DELDRIFT_WRONG_COUNT, DELDRIFT_INVALID_VALUE, DELDRIFT_UNDECIDED_REGIONS,
/// DELDRIFT_STAGED_VERTEX, DELDRIFT_TOO_MANY_VERTICES for ids of segments, DELDRIFT_TOO_MANY_CELLS,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED, DELDRIFT_ON_SEGMENT and DELDRIFT_CROSSING.
deldrift_status deldrift_coarsen(deldrift_triangulation *t,
                                 const deldrift_quality *quality,
                                 const uint8_t *mask,
                                 size_t mask_count,
                                 deldrift_quality_report *report);

/// The vertices that deldrift_refine has inserted and that are present, ascending by id.
///
/// vertices: a buffer with room for capacity ids. segments: room for as many: the segment that the vertex was put on,
/// by the id that it had before it was split, DELDRIFT_NONE if there is none. count: receives the number of vertices.
///
/// Cost: the vertices inserted so far.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D.
deldrift_status deldrift_made_vertices(const deldrift_triangulation *t,
                                       uint32_t *vertices,
                                       uint32_t *segments,
                                       size_t capacity,
                                       size_t *count);

/// The original of each segment in force, in the order of deldrift_segments. For a piece that deldrift_stage_splits or
/// deldrift_refine has made it is the id of the segment that the program staged; for a whole segment it is its own id.
/// The original of a piece is not in force any more, or, where it was split before it was made, has never been.
///
/// originals: a buffer with room for capacity ids. count: receives the number of segments.
///
/// Cost: of s segments in force s log s.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D.
deldrift_status deldrift_original_segments(const deldrift_triangulation *t,
                                           uint32_t *originals,
                                           size_t capacity,
                                           size_t *count);

/// How linear values at the vertices that the last deldrift_refine inserted, in the order of their ids, follow from
/// those at the vertices before. Each is a sum of the values of three vertices by their weights. So
///
///   value(new(k)) = sum of weights(3 k + i) * value(vertices(3 k + i)) for i = 0, 1, 2
///
/// carries values at vertices over, where new(k) is what deldrift_refined_vertices tells, or, without reuses_ids,
/// id_count - inserted + k. Vertices on the right may have been removed by this deldrift_refine, which has not given
/// their ids again, but not by a deldrift_coarsen before it: one pass with values from before both carries them over
/// both. deldrift_refine has to have been called with has_weights, and neither a commit nor a compaction must have come
/// since; otherwise there are none.
///
/// vertices: a buffer with room for capacity rows of 3 ids: the corners of the cell that the vertex was put into, or
/// the two ends of its segment or edge, the first one twice. weights: room for as many rows of 3 numbers, from 0 to 1,
/// with a sum of 1 but for rounding. count: receives the number of vertices.
///
/// Cost: the vertices inserted.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D.
deldrift_status deldrift_refined_weights(const deldrift_triangulation *t,
                                         uint32_t *vertices,
                                         double *weights,
                                         size_t capacity,
                                         size_t *count);

/// The sizes of the vertices that the last deldrift_refine inserted, in the order of their ids: the greatest length of
/// edges that it had there, from those given in quality.sizes at the vertices before. With these by id, behind the
/// others unless reuses_ids was set, a second call finds nothing to do. deldrift_refine has to have been called with
/// sizes, and neither a commit nor a compaction must have come since; otherwise there are none.
///
/// sizes: a buffer with room for capacity numbers. count: receives the number of vertices.
///
/// Cost: the vertices inserted.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D.
deldrift_status deldrift_refined_sizes(const deldrift_triangulation *t,
                                       double *sizes,
                                       size_t capacity,
                                       size_t *count);

/// The vertices that the last deldrift_refine inserted, ascending by id. deldrift_refined_weights and
/// deldrift_refined_sizes are in this order. Neither a commit nor a compaction must have come since; otherwise there
/// are none.
///
/// vertices: a buffer with room for capacity ids. count: receives the number of vertices.
///
/// Cost: the vertices inserted.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D.
deldrift_status deldrift_refined_vertices(const deldrift_triangulation *t,
                                          uint32_t *vertices,
                                          size_t capacity,
                                          size_t *count);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif // DELDRIFT_SEGMENTS_H
