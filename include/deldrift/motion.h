/*
 * deldrift/motion.h: Vertices that move, come and go: staging, commits, keys, the list of changes.
 *
 * A part of deldrift.h, the first page of which has the rules that hold for all functions.
 *
 * Made by `make header` from these files of src/capi: motion.rs, preparing.rs, immediate.rs, keys.rs, changes.rs,
 * transferring.rs. Change it there.
 *
 * Motion: what is staged, and becomes a timestamp.
 *
 *     deldrift_move_vertex: Stages the move of one vertex for the next timestamp.
 *     deldrift_move_vertices: Stages the moves of count vertices for the next timestamp: all of them, or none if it
 *         fails.
 *     deldrift_stage_insertions: Stages the insertion of count vertices: all of them, or none if it fails.
 *     deldrift_stage_removals: Stages the removal of count vertices: all of them, or none if it fails.
 *     deldrift_discard_moves: Forgets all staged moves, insertions and removals, of vertices and of segments.
 *     deldrift_commit_timestamp: Makes the staged positions the next timestamp.
 *     deldrift_commit_positions: Moves all vertices and makes that the next timestamp.
 *     deldrift_statistics: What all commits and immediate calls so far have done, in sum, to *report.
 *
 * Commits in two phases.
 *
 *     deldrift_prepare_timestamp: The first phase of a commit.
 *     deldrift_publish_timestamp: The second phase of a commit.
 *     deldrift_withdraw_timestamp: Takes back what deldrift_prepare_timestamp has prepared, all rounds.
 *
 * Changes that take effect at once, one vertex at a time; and new ids.
 *
 *     deldrift_relocate_vertex: Moves one vertex at once.
 *     deldrift_insert_vertex: Inserts a vertex at once.
 *     deldrift_remove_vertex: Removes a vertex at once, with the move or the removal staged for it, if any.
 *     deldrift_compact: Frees the memory that has served removed vertices, and gives the others new ids.
 *
 * Keys of vertices, which break ties in place of ids, and ids that are given again.
 *
 *     deldrift_create_with_keys: Creates a triangulation, as deldrift_create does, of vertices that have keys.
 *     deldrift_stage_insertions_with_keys: Stages the insertion of count vertices, as deldrift_stage_insertions does,
 *         with keys.
 *     deldrift_stage_insertions_at_free_ids: Stages the insertion of count vertices, as
 *         deldrift_stage_insertions_with_keys does, under ids that are given again.
 *     deldrift_insert_vertex_with_key: Inserts a vertex at once, as deldrift_insert_vertex does, with a key.
 *     deldrift_keys: The key of each vertex by id, to keys: the one that it was given, or else its id.
 *
 * The change list: what a program has to know that keeps something for each cell.
 *
 *     deldrift_take_changes: Takes what has changed since the last call of this function, to *changes.
 *
 * Conservative transfer of means in cells.
 *
 *     deldrift_transfer_cells: Brings means in cells over to the cells of now.
 */

#ifndef DELDRIFT_MOTION_H
#define DELDRIFT_MOTION_H

#include "core.h"

/// How much of a function means in cells are transferred with.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_transfer_order : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// As if it were constant in each cell.
    DELDRIFT_TRANSFER_FIRST_ORDER = 0,
    /// With a gradient in each cell, which is limited so that no new extreme comes of it.
    DELDRIFT_TRANSFER_SECOND_ORDER = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_transfer_order deldrift_transfer_order;
#else
typedef uint32_t deldrift_transfer_order;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// What a commit did, or, from deldrift_statistics, what all of them did.
///
/// A vertex that leaves its tolerance is relocated once; none ever has to be a second time.
typedef struct deldrift_commit_report {
    /// Number of the timestamp reached. It is 0 at creation, and one more after each commit.
    uint64_t timestamp;
    /// Vertices whose position differs from that of the timestamp before.
    uint64_t moved;
    /// Moved vertices for which nothing but coordinates changed.
    uint64_t unchanged;
    /// Vertices removed and inserted again.
    uint64_t placements;
    /// Flips made.
    uint64_t flips;
    /// 1 if the triangulation was rebuilt (in the statistics, how often).
    uint64_t rebuilds;
    /// Vertices hidden by place at the end: those at the place of a vertex with a lower id, or key, or greater weight.
    uint64_t coincident;
    /// Vertices that were certainly within their tolerance, with an algorithm that tests it.
    uint64_t within_tolerance;
    /// Bi-cells whose tolerance was computed.
    uint64_t tolerances;
    /// Orientations and in-sphere tests of the stars of relocated vertices.
    uint64_t certificates;
    /// Signs, of whatever purpose, that floating-point filters left to exact arithmetic. Ties are among them, but not
    /// those on a lattice in builds.
    uint64_t exact_calls;
    /// Vertices inserted.
    uint64_t inserted;
    /// Vertices removed.
    uint64_t removed;
    /// Vertices whose weight differs from that of the timestamp before, in a triangulation with weights.
    uint64_t reweighted;
    /// Vertices hidden by weight at the end; deldrift_hidden_by_weight lists them. Of vertices at one place those that
    /// do not represent it count in coincident alone.
    uint64_t hidden_by_weight;
    /// Vertices with weights that are hidden at the end, by weight or by place, and were not.
    uint64_t newly_hidden;
    /// Vertices with weights that were hidden, and are there at the end and not hidden.
    uint64_t newly_shown;
    /// Zero; later versions may count more.
    uint64_t reserved[3];
} deldrift_commit_report;

/// What has changed since the program last took the changes. The lists belong to the triangulation, and are valid until
/// the next call that changes it. A pointer is NULL if its list is empty.
///
/// A cell is its set of vertices. One that existed before and exists now is neither created nor removed, whatever has
/// happened in between. It keeps its index unless it is listed as renumbered. Its row keeps the order of the vertices,
/// except if the cell was turned over by a motion through a flat cell, or was removed and created again in between. A
/// program with data per cell updates them in three steps. Set aside those of removed cells, and of renumbered ones by
/// old index. Write the latter to their new indices. Make those of created cells. Neighbours change only at cells that
/// are listed, and at the neighbours of those.
typedef struct deldrift_changes {
    /// Number of cells that exist and did not.
    size_t created_count;
    /// Their indices into deldrift_cells, ascending.
    const uint32_t *created;
    /// Number of cells that existed and do not.
    size_t removed_count;
    /// The index that each had.
    const uint32_t *removed;
    /// removed_count rows of 3 (2D) or 4 (3D) vertex ids: their vertices, in the order that their rows had when the
    /// program last took the changes. Vertices may have been removed since. After a compaction those are DELDRIFT_NONE.
    const uint32_t *removed_vertices;
    /// Number of cells that existed under another index.
    size_t renumbered_count;
    /// The index that each had.
    const uint32_t *renumbered_from;
    /// The index that each has.
    const uint32_t *renumbered_to;
    /// Number of vertices whose star has changed: all those of created and removed cells.
    size_t star_count;
    /// These vertices, ascending. Some may have been removed.
    const uint32_t *stars;
    /// Number of vertices that are hidden and were not: a vertex of lower id, or key, is at the same place now, or
    /// weights of others hide it. One that has been inserted and is hidden is among them.
    size_t hidden_count;
    /// These vertices, ascending.
    const uint32_t *hidden;
    /// Number of vertices that were hidden, and are there and not hidden.
    size_t shown_count;
    /// These vertices, ascending.
    const uint32_t *shown;
    /// Zero; later versions may tell more.
    size_t reserved[4];
} deldrift_changes;

/// What deldrift_transfer_cells has met. A cell that is gone is at the new positions here.
typedef struct deldrift_transfer_report {
    /// Cells that are gone, those that count as such included.
    uint64_t gone;
    /// Cells that have come, those that count as such included.
    uint64_t arrived;
    /// Pairs of these that have something in common.
    uint64_t overlaps;
    /// Cells that are gone and turned over: what they have is counted as negative.
    uint64_t turned_over;
    /// Cells that have come where nothing was: their means are those of a neighbour.
    uint64_t uncovered;
    /// Zero; later versions may count more.
    uint64_t reserved[3];
    /// The area or volume, of the cells that are gone, where no cell has come, with its sign.
    double lost_volume;
    /// The area or volume, of the cells that have come, where no cell that is gone was, with its sign.
    double gained_volume;
    /// By how much at most both are off. What is no more than that may be 0.
    double volume_error;
    /// Zero; later versions may tell more.
    double reserved_numbers[3];
} deldrift_transfer_report;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// ---------------------------------------------------------------------------------------------------------------------
// Motion: what is staged, and becomes a timestamp.
// ---------------------------------------------------------------------------------------------------------------------

/// Stages the move of one vertex for the next timestamp. Nothing that can be read changes until
/// deldrift_commit_timestamp.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_DUPLICATE_MOVE,
/// DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_move_vertex(deldrift_triangulation *t,
                                     uint32_t vertex,
                                     const double *position);

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
deldrift_status deldrift_move_vertices(deldrift_triangulation *t,
                                       const uint32_t *vertices,
                                       const double *positions,
                                       size_t count);

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
deldrift_status deldrift_stage_insertions(deldrift_triangulation *t,
                                          const double *positions,
                                          size_t count,
                                          uint32_t *first_vertex);

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
deldrift_status deldrift_stage_removals(deldrift_triangulation *t,
                                        const uint32_t *vertices,
                                        size_t count);

/// Forgets all staged moves, insertions and removals, of vertices and of segments.
///
/// Cost: what is staged.
deldrift_status deldrift_discard_moves(deldrift_triangulation *t);

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
deldrift_status deldrift_commit_timestamp(deldrift_triangulation *t,
                                          deldrift_commit_report *report);

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
deldrift_status deldrift_commit_positions(deldrift_triangulation *t,
                                          const double *positions,
                                          size_t count,
                                          deldrift_commit_report *report);

/// What all commits and immediate calls so far have done, in sum, to *report. Its timestamp, coincident and
/// hidden_by_weight are those of now.
///
/// Cost: constant; for a triangulation with weights, what deldrift_hidden_by_weight costs.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY if t has weights.
deldrift_status deldrift_statistics(const deldrift_triangulation *t,
                                    deldrift_commit_report *report);

// ---------------------------------------------------------------------------------------------------------------------
// Commits in two phases.
// ---------------------------------------------------------------------------------------------------------------------

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
deldrift_status deldrift_prepare_timestamp(deldrift_triangulation *t,
                                           deldrift_commit_report *report);

/// The second phase of a commit. The state that deldrift_prepare_timestamp has prepared becomes the next timestamp.
/// What has been staged since the last round stays so. Needs no memory.
///
/// Cost: constant, but where a commit would sort the cells for speed, or t is periodic.
///
/// Errors: DELDRIFT_NOT_PREPARED.
deldrift_status deldrift_publish_timestamp(deldrift_triangulation *t);

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
deldrift_status deldrift_withdraw_timestamp(deldrift_triangulation *t);

// ---------------------------------------------------------------------------------------------------------------------
// Changes that take effect at once, one vertex at a time; and new ids.
// ---------------------------------------------------------------------------------------------------------------------

/// Moves one vertex at once. When the call returns the triangulation is that of the new position. The timestamp stays,
/// and so do the moves staged for other vertices.
///
/// Cost: at most that of a removal and an insertion: of the cells around the vertex before and after, which can be
/// many. While there are no cells, that of deldrift_create. In a periodic triangulation that of a commit of this one
/// move.
///
/// Errors: DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_DUPLICATE_MOVE if a move
/// of this vertex is staged, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject
/// it), DELDRIFT_CROSSING, DELDRIFT_ON_SEGMENT, DELDRIFT_ENDS_MEET, DELDRIFT_PASSES_SEGMENT (if the options refuse it),
/// DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_relocate_vertex(deldrift_triangulation *t,
                                         uint32_t vertex,
                                         const double *position);

/// Inserts a vertex at once.
///
/// out_vertex: receives its id, which is one above the highest ever given, or left by the latest deldrift_compact.
///
/// Cost: that of deldrift_locate, and the cells created and removed. In a periodic triangulation that of a commit of
/// one insertion.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject it),
/// DELDRIFT_ON_SEGMENT, DELDRIFT_STAGED_VERTEX (if t is periodic and insertions are staged, which have the next ids),
/// DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_insert_vertex(deldrift_triangulation *t,
                                       const double *position,
                                       uint32_t *out_vertex);

/// Removes a vertex at once, with the move or the removal staged for it, if any. deldrift_compact frees its id and the
/// rest of its memory; deldrift_stage_insertions_at_free_ids gives the id again.
///
/// Cost: with up to 64 neighbours at most the square of their number, with more a build of the neighbours alone. In 3D
/// that may have as many cells as half the square of their number, as where all points are on the moment curve;
/// callbacks are called for each ten to twenty thousand of them. In a periodic triangulation that of a commit of one
/// removal.
///
/// Errors: DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_END_REMOVED for an end of
/// a segment in force, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_remove_vertex(deldrift_triangulation *t,
                                       uint32_t vertex);

/// Frees the memory that has served removed vertices, and gives the others new ids. These are 0, 1, ... in the order of
/// the ids that they have. Ties are broken by keys, or the order of ids, so the cells stay the same, with their indices
/// in deldrift_cells. So do positions, staged moves, the ids of segments and the timestamp. Memory and the time of
/// commits are those of a fresh triangulation then.
///
/// map: receives the new id of each old one, DELDRIFT_NONE for removed vertices: a buffer with room for capacity ids;
/// NULL with capacity 0 if it is not wanted. Vertices whose insertion is staged get new ids as well. count: receives
/// the number of old ids (deldrift_id_count before the call); if there is no room for as many, nothing has been
/// compacted.
///
/// Takes no longer than a rebuild, and while it runs the memory of a second triangulation. A periodic triangulation is
/// built anew, if vertices have been removed: its cells stay, and may have other indices.
///
/// Cost: n + m; of a periodic triangulation that of creation.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY; if t is periodic, DELDRIFT_CANCELLED, DELDRIFT_TOO_MANY_CELLS.
deldrift_status deldrift_compact(deldrift_triangulation *t,
                                 uint32_t *map,
                                 size_t capacity,
                                 size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Keys of vertices, which break ties in place of ids, and ids that are given again.
// ---------------------------------------------------------------------------------------------------------------------

/// Creates a triangulation, as deldrift_create does, of vertices that have keys.
///
/// A key breaks ties in place of the id. Where points are cocircular or cospherical, the cells are those of the order
/// of keys. Vertices of equal keys are in the order of their positions, by x, then y, then z. Of several vertices at
/// the same place the one of the lowest key, and of those the one of the lowest id, is the corner of cells. So cells
/// follow from positions and keys, and a program may give ids in any order. Images of a vertex in a periodic box, or
/// copies of vertices of other processes, have the key of the vertex. Without a key of its own a vertex has its id for
/// one.
///
/// keys: count of them, in the order of positions, any numbers. NULL stands for the ids. All else is as in
/// deldrift_create. Keys take 8 bytes for each id, and deldrift_compact leaves them as they are. Vertices that
/// deldrift_refine and deldrift_stage_splits make have the greatest key, 2^64 - 1.
///
/// Cost: that of deldrift_create.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_INVALID_OPTIONS, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_create_with_keys(uint32_t dimension,
                                          const double *positions,
                                          const uint64_t *keys,
                                          size_t count,
                                          const deldrift_options *options,
                                          deldrift_triangulation **out);

/// Stages the insertion of count vertices, as deldrift_stage_insertions does, with keys. deldrift_create_with_keys says
/// what these are.
///
/// keys: count of them, in the order of positions. NULL stands for the ids. The others are as in
/// deldrift_stage_insertions.
///
/// Cost: count, in the mean over many calls; the first keys of a triangulation also n.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_stage_insertions_with_keys(deldrift_triangulation *t,
                                                    const double *positions,
                                                    const uint64_t *keys,
                                                    size_t count,
                                                    uint32_t *first_vertex);

/// Stages the insertion of count vertices, as deldrift_stage_insertions_with_keys does, under ids that are given again.
/// They get the ids of removed vertices, the lowest first, and after these the ones above the highest id given so far.
/// So deldrift_id_count does not grow where vertices come and go for ever. An id is free from the removal of its
/// vertex, or the commit of that, until it is given here. deldrift_discard_moves makes those that are staged free
/// again.
///
/// A program that has kept the id of a removed vertex sees another vertex under it. In lists of changes it is as if the
/// vertex had moved: cells that have the same ids as before are not listed, whether or not an id is that of another
/// vertex. The ends of staged segments are not given again, and neither are those of segments that have been split, as
/// long as there are pieces of them.
///
/// keys: count keys, or NULL for the ids. vertices: room for count ids, receives that of each vertex, ascending; both
/// The others are as in deldrift_stage_insertions.
///
/// Cost: n + count, a pass over 4 bytes for each id; and the segments.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_stage_insertions_at_free_ids(deldrift_triangulation *t,
                                                      const double *positions,
                                                      const uint64_t *keys,
                                                      size_t count,
                                                      uint32_t *vertices);

/// Inserts a vertex at once, as deldrift_insert_vertex does, with a key. deldrift_create_with_keys says what that is.
///
/// key: any number. out_vertex: receives the id, one above the highest given so far.
///
/// Cost: that of deldrift_insert_vertex; the first key of a triangulation also n.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject it),
/// DELDRIFT_ON_SEGMENT, DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY,
/// DELDRIFT_CANCELLED.
deldrift_status deldrift_insert_vertex_with_key(deldrift_triangulation *t,
                                                const double *position,
                                                uint64_t key,
                                                uint32_t *out_vertex);

/// The key of each vertex by id, to keys: the one that it was given, or else its id. Vertices whose insertion is staged
/// have theirs, too. The entries of removed vertices are 0.
///
/// keys: receives them: a buffer with room for capacity keys; NULL with capacity 0 if it is not wanted. count: receives
/// deldrift_id_count.
///
/// Cost: n.
deldrift_status deldrift_keys(const deldrift_triangulation *t,
                              uint64_t *keys,
                              size_t capacity,
                              size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// The change list: what a program has to know that keeps something for each cell.
// ---------------------------------------------------------------------------------------------------------------------

/// Takes what has changed since the last call of this function, to *changes. It may have changed by commits or
/// immediate calls. The first call lists all cells as created.
///
/// Between two calls may be any number of commits and immediate calls. With a call before it and one after it, this is
/// what one insertion, removal or new weight at once has hidden and shown.
///
/// A program that never calls this pays nothing for it. One that does pays in proportion to what has changed, and may
/// call it as often or as rarely as it likes. It ends the lists of the call before. A view of the cells stays valid
/// unless it is older than the last change. deldrift_cells takes constant time after it.
///
/// Where the triangulation is periodic, a cell is its vertices with their shifts from each other
/// (deldrift_cell_shifts). It is new if the program takes a vertex of it to another period, or gives other vectors of
/// the lattice. From the first call on cells that stay keep their indices. A commit that builds anew may list their
/// corners in another order.
///
/// Cost: what has changed, and with weights a bit for each id; of the first call n + m. Where the triangulation is
/// periodic, always n + m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY; then nothing has been taken.
deldrift_status deldrift_take_changes(deldrift_triangulation *t,
                                      deldrift_changes *changes);

// ---------------------------------------------------------------------------------------------------------------------
// Conservative transfer of means in cells.
// ---------------------------------------------------------------------------------------------------------------------

/// Brings means in cells over to the cells of now. It is conservative transfer, by the latest deldrift_take_changes, of
/// what a program keeps for each cell.
///
/// A mean rides with its cell while vertices move, and a cell that lives keeps it. At the positions of now, the cells
/// that are gone and those that have come cover the same region: each new cell gets the mean of what is in it. So the
/// sum of mean times area or volume stays where the hull does. A constant stays to the last bit. No mean is beyond
/// those of the cells around. The sum is that with the volumes at the positions of now. A program that keeps the
/// content of a cell while its volume changes first divides it by the volume of now, whatever the sign of that.
///
/// positions: by id, where the vertices of the former cells are now, or where they were when they were removed. That is
/// what a program has given to its last commit, before it reads the positions of what has been inserted since. There
/// are position_count rows of 2 or 3 numbers, of which those of vertices of cells that are gone are used. NULL stands
/// for where they are now, if none of them has been removed. In a periodic triangulation they are where vertices have
/// gone, through whatever periods: those before the program took any to another period. order: see
/// deldrift_transfer_order. values: a row of n_values numbers, up to 1e300 in magnitude, for each cell that there was
/// at the deldrift_take_changes before the last one, in the order of that time. It receives rows for the cells that
/// there are, in the order of deldrift_cells. value_count: how many cells there were. capacity: for how many rows there
/// is room, at least for the cells that were and for those that are. report: receives what was met. lost, gained:
/// receive n_values numbers each, see below. Each of the last three may be NULL.
///
/// Where the hull has changed, regions differ. lost is the content, mean times volume, that was where no new cell is.
/// gained is the content of new cells where nothing was. Such a cell has the mean of what covers the rest of it, or, if
/// nothing does, that of the nearest cell through facets, or 0 if there is none. With these the sums always agree but
/// for rounding: what there is, is what was, less lost and with gained. Where regions agree both are 0 but for
/// rounding: no more than volume_error times twice the greatest magnitude.
///
/// A cell that is gone, and is turned over at the new positions, has a negative volume there. What it has in common
/// with others counts as negative. Cells that live beneath it count as both gone and come, and get other means, too. So
/// the sum stays exact, and so does a constant, but means there may be beyond those of all others. turned_over counts
/// such cells, and shorter steps avoid them. A cell of now that was turned over since is gone as it was, and has come.
///
/// With the second order, what gradients add is limited for each cell. Its new mean is no less and no more than those
/// of the cells that it comes from, of their neighbours, and of the neighbours of these. Gradients are fitted to the
/// means of neighbours. Linear functions are kept but for rounding where that does not limit them, as it may at the
/// hull.
///
/// Cost: n log n for n cells in the list of changes and what they have in common, times n_values. A cell that is turned
/// over adds log m, and the cells of now that it meets, or would if it were half as large again. All such cells add m
/// if no corner of one is in the convex hull, or if they meet an eighth of all cells. In a periodic triangulation also
/// n + m.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_VALUE for an order that there is not, for a value that is used and
/// is no number or a greater one, and for positions that take a cell through more than 64 periods,
/// DELDRIFT_CHANGES_NOT_TAKEN if cells have changed since the latest deldrift_take_changes, if there was none, or if
/// ids have been given anew since the one before, DELDRIFT_WRONG_COUNT, DELDRIFT_NO_SUCH_VERTEX for a vertex beyond
/// position_count, DELDRIFT_REMOVED_VERTEX for one where positions are NULL, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_PREPARED, DELDRIFT_CANCELLED, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_transfer_cells(const deldrift_triangulation *t,
                                        const double *positions,
                                        size_t position_count,
                                        deldrift_transfer_order order,
                                        double *values,
                                        size_t value_count,
                                        size_t n_values,
                                        size_t capacity,
                                        deldrift_transfer_report *report,
                                        double *lost,
                                        double *gained);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif // DELDRIFT_MOTION_H
