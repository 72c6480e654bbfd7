/*
 * deldrift/core.h: What every program needs: statuses, options, creation, positions and cells.
 *
 * A part of deldrift.h, the first page of which has the rules that hold for all functions.
 *
 * Made by `make header` from these files of src/capi and, for the algorithms, src/motion/algorithms.rs: status.rs,
 * options.rs, handle.rs, triangulation.rs, state.rs, query.rs. Change it there.
 *
 * What a call says when it ends: status codes, the message of the last failure, the version.
 *
 *     deldrift_status_string: A status in a few words, in English, without a full stop.
 *     deldrift_last_error: The message of the last call on this thread that failed.
 *     deldrift_version: The version of the library that is running, as "major.minor.patch".
 *
 * Options: a structure that can grow, read as far as the caller's header knows it.
 *
 *     deldrift_options_init: Sets struct_size and the default of every other option.
 *
 * Creation, destruction, and what is chosen for the whole life of a triangulation.
 *
 *     deldrift_create: Creates the Delaunay triangulation of count points in the plane or in space, at timestamp 0.
 *     deldrift_destroy: Destroys a triangulation: its memory is freed and its views end.
 *     deldrift_dimension: The dimension of the triangulation, 2 or 3, to *dimension.
 *     deldrift_set_algorithm: Changes the algorithm of later commits.
 *     deldrift_get_algorithm: The algorithm in force, to *algorithm.
 *
 * What a triangulation holds: counts, and the positions of vertices.
 *
 *     deldrift_vertex_count: How many vertices are present, hidden ones included and removed ones not, to *count.
 *     deldrift_id_count: How many ids there are, to *count: those given so far, or left by the latest deldrift_compact
 *         and given since.
 *     deldrift_cell_count: How many cells there are, to *count.
 *     deldrift_staged_count: How many moves are staged for the next timestamp, to *count.
 *     deldrift_memory_bytes: How many bytes of memory the triangulation holds, to *bytes.
 *     deldrift_timestamp: The number of the current timestamp, to *timestamp.
 *     deldrift_is_present: Whether a vertex of this id is present, to *present.
 *     deldrift_position: The position of a vertex at the current timestamp, not a staged one, to position.
 *     deldrift_copy_positions: The positions of all ids, in their order.
 *
 * Queries: cells, and what is where. None changes the triangulation.
 *
 *     deldrift_cells: The cells, without a copy, to *view.
 *     deldrift_release_cells: Hands the arrays of deldrift_cells over to the program, to *view, with an owner for them,
 *         to *owner.
 *     deldrift_free_cells: Frees arrays that deldrift_release_cells has handed over, once.
 *     deldrift_copy_cells: A copy of the cells: see deldrift_cells_view for what the rows mean.
 *     deldrift_star: The star of a vertex: the indices of the cells that have it as a corner, in no particular order.
 *     deldrift_tolerance: The tolerance of a vertex, to *out: while every vertex stays closer to its current position
 *         than its tolerance, no cell changes.
 *     deldrift_validate: Checks the triangulation exactly, in time proportional to its size.
 */

#ifndef DELDRIFT_CORE_H
#define DELDRIFT_CORE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Version of this header, that of the library it came with: see deldrift_version.
#define DELDRIFT_VERSION_MAJOR 0
#define DELDRIFT_VERSION_MINOR 1
#define DELDRIFT_VERSION_PATCH 0
#define DELDRIFT_VERSION_STRING "0.1.0"

/// No cell, no vertex. It is the neighbour of a cell across a facet of the convex hull, and the nearest vertex of an
/// empty triangulation.
#define DELDRIFT_NONE UINT32_MAX

/// Outcome of a call. DELDRIFT_OK is 0, and a call that gives any other status has had no effect.
///
/// deldrift_last_error says which argument was wrong, at which index, and its value.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_status : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// The call did what it was asked to do.
    DELDRIFT_OK = 0,
    /// A pointer that must not be NULL is.
    DELDRIFT_NULL_ARGUMENT = 1,
    /// A pointer is not aligned for what it should point to.
    DELDRIFT_MISALIGNED_ARGUMENT = 2,
    /// An array with the given count would not fit in the address space.
    DELDRIFT_SIZE_OVERFLOW = 3,
    /// The dimension is neither 2 nor 3, or not one for which there is the function.
    DELDRIFT_INVALID_DIMENSION = 4,
    /// An option has a value that this version does not know; the message names the field.
    DELDRIFT_INVALID_OPTIONS = 5,
    /// The level of deldrift_validate is not 1, 2 or 3.
    DELDRIFT_INVALID_LEVEL = 6,
    /// A buffer has room for fewer entries than there are. Their number is in the message, and in the count if the
    /// function has one.
    DELDRIFT_BUFFER_TOO_SMALL = 7,
    /// A coordinate or a weight is NaN or infinite.
    DELDRIFT_NOT_FINITE = 8,
    /// A coordinate is of a magnitude above 1e57, or a weight above 1e114: signs could not be exact.
    DELDRIFT_OUT_OF_RANGE = 9,
    /// No vertex ever had this id.
    DELDRIFT_NO_SUCH_VERTEX = 10,
    /// The vertex of this id has been removed.
    DELDRIFT_REMOVED_VERTEX = 11,
    /// A move of this vertex is already staged for the next timestamp.
    DELDRIFT_DUPLICATE_MOVE = 12,
    /// An array does not have the number of entries that it must have: one for each id, cell or component. Or, without
    /// a list of ids, it has more entries than there are ids.
    DELDRIFT_WRONG_COUNT = 13,
    /// Two vertices would be at the same place, and the options reject that.
    DELDRIFT_COINCIDENT = 14,
    /// There would be more vertices than 32-bit ids can name, or more segments have been given ids.
    DELDRIFT_TOO_MANY_VERTICES = 15,
    /// There would be more cells than the library can link to each other.
    DELDRIFT_TOO_MANY_CELLS = 16,
    /// Not enough memory.
    DELDRIFT_OUT_OF_MEMORY = 17,
    /// The cancel callback returned true.
    DELDRIFT_CANCELLED = 18,
    /// deldrift_validate found something wrong; the message says what.
    DELDRIFT_INVALID = 19,
    /// A callback, or another thread, used a triangulation while a call was changing it.
    DELDRIFT_BUSY = 20,
    /// An earlier call on this triangulation ended in DELDRIFT_INTERNAL_ERROR while changing it. It can only
    /// be destroyed.
    DELDRIFT_POISONED = 21,
    /// A defect of the library; please report the message.
    DELDRIFT_INTERNAL_ERROR = 22,
    /// There is no cell of this index, or cells have no corner of this number.
    DELDRIFT_NO_SUCH_FACET = 23,
    /// A number has no meaning for its argument, as a negative squared radius.
    DELDRIFT_INVALID_VALUE = 24,
    /// Data are not those of a saved triangulation. They are damaged, incomplete, of another kind, or from a later
    /// version. The message says what is wrong, and where.
    DELDRIFT_INVALID_DATA = 25,
    /// The system cannot read or write a file; the message has the path, and what the system says.
    DELDRIFT_IO_ERROR = 26,
    /// A field has no name, one that is not UTF-8, or no components; the message has its index.
    DELDRIFT_INVALID_FIELD = 27,
    /// The insertion of the vertex is staged: it is not there before the next commit. Or its removal is staged: it can
    /// be neither moved by that commit nor removed twice. The message says which.
    DELDRIFT_STAGED_VERTEX = 28,
    /// There is no segment of this id, or its removal is staged.
    DELDRIFT_NO_SUCH_SEGMENT = 29,
    /// Two segments would cross, at a place that is an end of neither; deldrift_segment_conflicts tells all conflicts.
    DELDRIFT_CROSSING = 30,
    /// A vertex would be on a segment, and not be one of its ends; deldrift_segment_conflicts tells all conflicts.
    DELDRIFT_ON_SEGMENT = 31,
    /// An end of a segment would be removed; deldrift_segment_conflicts tells all conflicts.
    DELDRIFT_END_REMOVED = 32,
    /// Both ends of a segment would be at the same place; deldrift_segment_conflicts tells all conflicts.
    DELDRIFT_ENDS_MEET = 33,
    /// A seed is on the boundary of several regions.
    DELDRIFT_AMBIGUOUS_SEED = 34,
    /// A vertex would pass a segment; deldrift_passings tells all that would.
    DELDRIFT_PASSES_SEGMENT = 35,
    /// A timestamp is prepared, and the call has to wait for deldrift_publish_timestamp or deldrift_withdraw_timestamp.
    /// The message has the timestamp and the number of rounds.
    DELDRIFT_PREPARED = 36,
    /// No timestamp is prepared that could be published.
    DELDRIFT_NOT_PREPARED = 37,
    /// The triangulation is periodic, and the function does not serve such.
    DELDRIFT_PERIODIC = 38,
    /// The vectors of a periodic box depend on each other, or nearly so, or are more than there are axes.
    DELDRIFT_DEPENDENT_VECTORS = 39,
    /// The call needs the lists of the latest deldrift_take_changes, and cells or ids have changed since.
    DELDRIFT_CHANGES_NOT_TAKEN = 40,
    /// The call works on regions by their labels, and the sides of a region have no label, or several. deldrift_regions
    /// counts its cells.
    DELDRIFT_UNDECIDED_REGIONS = 41,
    /// The triangulation has weights, and the function does not serve such.
    DELDRIFT_WEIGHTED = 42,
    /// The triangulation has no weights, and the function is for those that have.
    DELDRIFT_NOT_WEIGHTED = 43,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_status deldrift_status;
#else
typedef uint32_t deldrift_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// How deldrift_commit_timestamp brings the triangulation to the staged positions. Every algorithm
/// gives exactly the same cells; they differ in what they cost.
///
/// DELDRIFT_AUTO is for most programs.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_algorithm : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// Chooses at each commit by what the last ones found. Where all vertices are staged: repair, of only those
    /// certificates that can fail while displacements are small compared with the spacing, or rebuilding where too
    /// much would fail. Where fewer than one vertex in ten is staged: tolerance if that is up to date, else
    /// placement with flips.
    DELDRIFT_AUTO = 0,
    /// Builds the triangulation again from all positions (RR-6750, section 1).
    DELDRIFT_REBUILDING = 1,
    /// Takes the moved vertices one by one. Where no certificate of the star fails, only the coordinates change;
    /// where the cells of the star stay positively oriented, flips repair it (in 3D these can get stuck, and are
    /// then undone); else a walk from the old place, a removal and an insertion (RR-6750, section 3.2). For a few
    /// vertices that move far.
    DELDRIFT_PLACEMENT_FLIPS = 2,
    /// Keeps for each vertex a distance within which it is certain to change nothing but coordinates, see
    /// deldrift_tolerance. A vertex that stays within costs one distance, any other a placement and the
    /// tolerances around it (RR-6750, Algorithm 1). For displacements so small that nearly all vertices stay
    /// within, and for schemes that converge. All tolerances are computed by the first commit, and by the first
    /// one after another algorithm's.
    DELDRIFT_TOLERANCE = 3,
    /// All vertices move at once, every certificate is checked, and what fails is repaired by flips and
    /// placements. Rebuilds where too much fails.
    DELDRIFT_REPAIR = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_algorithm deldrift_algorithm;
#else
typedef uint32_t deldrift_algorithm;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// What happens when vertices come to lie at the same place.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_coincidence : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// The lowest id, or key, represents the place in the cells; the others are hidden until they move apart.
    DELDRIFT_COINCIDENCE_MERGE = 0,
    /// The call fails with DELDRIFT_COINCIDENT and has no effect.
    DELDRIFT_COINCIDENCE_REJECT = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_coincidence deldrift_coincidence;
#else
typedef uint32_t deldrift_coincidence;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// What happens when a vertex would pass a segment. deldrift_check_passings defines that.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_passing : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// Nothing. Only deldrift_check_passings looks for it.
    DELDRIFT_PASSING_IGNORE = 0,
    /// The call goes on, and deldrift_passings then tells which vertices have passed which segments.
    DELDRIFT_PASSING_TELL = 1,
    /// The call fails with DELDRIFT_PASSES_SEGMENT and has no effect; deldrift_passings then tells all of them.
    DELDRIFT_PASSING_REFUSE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_passing deldrift_passing;
#else
typedef uint32_t deldrift_passing;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// Arrays of cells that a program has taken over: opaque, made by deldrift_release_cells, unmade by
/// deldrift_free_cells.
typedef struct deldrift_released_cells deldrift_released_cells;

/// A triangulation: opaque, made by deldrift_create, unmade by deldrift_destroy.
typedef struct deldrift_triangulation deldrift_triangulation;

/// Options of a triangulation. Initialise them with deldrift_options_init, then set what should differ
/// from the defaults, all of which are zero.
///
/// The structure may grow in later versions. struct_size says how much of it the program knows: fields beyond it have
/// their defaults. A greater size than that of the library is accepted if all bytes that the library does not know are
/// zero. A size that is 0, ends inside a field or is beyond 4096 is DELDRIFT_INVALID_OPTIONS. So is any value that has
/// no meaning.
///
/// The callbacks are called from inside every function that names DELDRIFT_CANCELLED among its errors, where the call
/// takes long, and from inside no other. They are called on the thread that makes the call, one at a time, and not
/// after deldrift_destroy. They must return normally (no exception, no longjmp). Where the call creates or changes a
/// triangulation, callbacks must not use that one: DELDRIFT_BUSY turns their calls away. Where the call takes it as
/// const, as deldrift_voronoi_cells does, they may read it, and DELDRIFT_BUSY turns away what would change it. Such
/// calls may run on several threads at once, and each calls the callbacks. Callbacks may use other triangulations. What
/// user_data points to must live as long as the triangulation and its copies.
typedef struct deldrift_options {
    /// sizeof(deldrift_options) as the program sees it.
    size_t struct_size;
    /// Algorithm of later commits; may be changed by deldrift_set_algorithm. Default DELDRIFT_AUTO.
    deldrift_algorithm algorithm;
    /// Greatest number of threads a call may use, the calling one included; 0, the default, is no limit. The library
    /// uses as many as make the call faster, at most one per processor. To build and rebuild that is one for each 5,000
    /// vertices in 2D or 2,500 in 3D, and likewise to move all, check all certificates and flip in repair. All
    /// triangulations of the process share these threads, which sleep between calls. The cells do not depend on the
    /// number. Their order, last bits of rounded numbers and the counts in reports may, unless parts is set. Callbacks
    /// come from the calling thread only.
    uint32_t threads;
    /// Default DELDRIFT_COINCIDENCE_MERGE.
    deldrift_coincidence coincidence;
    /// What commits, deldrift_check_staged and deldrift_relocate_vertex do when a vertex would pass a segment. Default
    /// DELDRIFT_PASSING_IGNORE.
    deldrift_passing passing;
    /// Greatest number of parts into which work is divided where that shows in the order of cells: builds, and flips.
    /// 0, the default, is one for each thread that is used. With any other number the same calls give the same answers
    /// for any number of threads and on every processor. That includes the order of cells, every bit of rounded
    /// numbers, and reports. (A build for whose parts there is no memory is in one.) Take at most as many parts as the
    /// program will have threads: with fewer parts some threads have nothing to do in this work, and each further part
    /// costs something. For 100,000 vertices in 2D, a build on one thread takes 1.1 times as long in eight parts as in
    /// one. In 3D it takes 1.06 times as long in two, 1.1 in four and 1.3 in eight. For 20,000 vertices it takes 1.2
    /// times as long in 2D, 1.15 to 1.6 times in 3D.
    size_t parts;
    /// Called now and then during long calls: at least once for some ten thousand cells that are made, or looked at
    /// around single vertices. Passes over all vertices or cells, each of which takes a part of a build, are not
    /// interrupted. When it returns true, the call ends in DELDRIFT_CANCELLED and has had no effect. NULL, the default,
    /// never cancels.
    bool (*cancel)(void *user_data);
    /// Called just before cancel would be, with the part of the work that is done, from 0 to 1, as far as that is
    /// known. The part need not change from one call to the next, and begins again where a commit goes on by
    /// rebuilding. NULL is the default.
    void (*progress)(void *user_data, double fraction);
    /// Handed to the callbacks as it is.
    void *user_data;
} deldrift_options;

/// The cells of a triangulation: triangles in 2D, tetrahedra in 3D. The arrays are those of the library, not a copy:
/// they are read-only, and valid until the next call that changes the triangulation.
///
/// Some calls change no cells: those that stage, that discard what is staged, that take changes, and
/// deldrift_set_algorithm. They keep a view that is not older than the last change. After deldrift_release_cells a view
/// is valid until its owner is freed.
///
/// Cells are positively oriented. The vertices of a triangle are in counter-clockwise order. For a tetrahedron a, b, c,
/// d the determinant of the rows b - a, c - a, d - a is positive.
typedef struct deldrift_cells_view {
    /// Number of cells.
    size_t count;
    /// 3 in 2D, 4 in 3D.
    uint32_t corners_per_cell;
    /// count rows of corners_per_cell vertex ids. NULL if there are no cells.
    const uint32_t *vertices;
    /// count rows of corners_per_cell cell indices. Entry i of a row is the cell beyond the facet opposite vertex i,
    /// DELDRIFT_NONE on the hull. NULL if there are no cells.
    const uint32_t *neighbours;
} deldrift_cells_view;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// ---------------------------------------------------------------------------------------------------------------------
// What a call says when it ends: status codes, the message of the last failure, the version.
// ---------------------------------------------------------------------------------------------------------------------

/// A status in a few words, in English, without a full stop. For a number that is no status of this version the text
/// says so. The string is static.
///
/// Cost: constant.
const char *deldrift_status_string(deldrift_status status);

/// The message of the last call on this thread that failed. It says which argument was wrong, at which index, and its
/// value. It is an empty string if no call has failed. Calls that succeed leave it as it is, so look at it only after a
/// failure.
///
/// The string is never NULL, belongs to the library, and stays until the next failure on the same
/// thread. It is at most 511 bytes long and valid UTF-8.
///
/// Cost: constant.
const char *deldrift_last_error(void);

/// The version of the library that is running, as "major.minor.patch". The string is static. The
/// version of the header that a program was compiled with is in DELDRIFT_VERSION_STRING.
///
/// Cost: constant.
const char *deldrift_version(void);

// ---------------------------------------------------------------------------------------------------------------------
// Options: a structure that can grow, read as far as the caller's header knows it.
// ---------------------------------------------------------------------------------------------------------------------

/// Sets struct_size and the default of every other option. NULL is legal and does nothing.
///
/// C and C++ programs have it from this header. So it fills the structure of the header, whichever later version they
/// run with. Other languages have a function of this name in the library. In every version that function fills the
/// structure as it is here, and says so in struct_size. A program that knows more fields sets them to zero, the default
/// of all, and struct_size to the size of its structure.
///
/// Cost: constant.
static inline void deldrift_options_init(deldrift_options *options) {
    static deldrift_options zeros;
    if (options) {
        *options = zeros;
        options->struct_size = sizeof *options;
    }
}

// ---------------------------------------------------------------------------------------------------------------------
// Creation, destruction, and what is chosen for the whole life of a triangulation.
// ---------------------------------------------------------------------------------------------------------------------

/// Creates the Delaunay triangulation of count points in the plane or in space, at timestamp 0.
///
/// dimension: 2 or 3. positions: count points, in any unit. Vertex i is the i-th of them until the triangulation is
/// destroyed, or deldrift_compact gives new ids. Any set is legal: the empty one, coincident points, points on one line
/// or plane. Where the points do not span the dimension there are no cells. Every finite coordinate from -1e57 to 1e57
/// is accepted, however close to zero. options: NULL for the defaults.
///
/// out: receives the triangulation.
///
/// Cost: on all sets of docs/COSTS.md n log n and m. No set takes more than n² in 2D, or n m in 3D, where m is the most
/// cells of any subset.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_INVALID_OPTIONS, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_create(uint32_t dimension,
                                const double *positions,
                                size_t count,
                                const deldrift_options *options,
                                deldrift_triangulation **out);

/// Destroys a triangulation: its memory is freed and its views end. NULL is legal and does nothing. A poisoned
/// triangulation is destroyed like any other. From inside a callback of a call on the same triangulation it does
/// nothing but set deldrift_last_error.
///
/// Cost: n + m at most.
void deldrift_destroy(deldrift_triangulation *t);

/// The dimension of the triangulation, 2 or 3, to *dimension.
///
/// Cost: constant.
deldrift_status deldrift_dimension(const deldrift_triangulation *t, uint32_t *dimension);

/// Changes the algorithm of later commits. Staged moves stay. Tolerances and delimiters that the new
/// algorithm needs and the old one did not keep are computed by the next commit.
///
/// Cost: n + m at most, to free what the old one keeps.
///
/// Errors: DELDRIFT_INVALID_OPTIONS for a number that is no algorithm of this version.
deldrift_status deldrift_set_algorithm(deldrift_triangulation *t,
                                       deldrift_algorithm algorithm);

/// The algorithm in force, to *algorithm. It is the one that was set: DELDRIFT_AUTO where the library chooses, and
/// after deldrift_research_set_algorithm the number of an algorithm of deldrift/research.h.
///
/// Cost: constant.
deldrift_status deldrift_get_algorithm(const deldrift_triangulation *t,
                                       deldrift_algorithm *algorithm);

// ---------------------------------------------------------------------------------------------------------------------
// What a triangulation holds: counts, and the positions of vertices.
// ---------------------------------------------------------------------------------------------------------------------

/// How many vertices are present, hidden ones included and removed ones not, to *count.
///
/// Cost: constant.
deldrift_status deldrift_vertex_count(const deldrift_triangulation *t, size_t *count);

/// How many ids there are, to *count: those given so far, or left by the latest deldrift_compact and given since. All
/// valid ids are below it, those of removed vertices and of staged insertions too.
///
/// Cost: constant.
deldrift_status deldrift_id_count(const deldrift_triangulation *t,
                                  size_t *count);

/// How many cells there are, to *count.
///
/// Cost: constant.
deldrift_status deldrift_cell_count(const deldrift_triangulation *t, size_t *count);

/// How many moves are staged for the next timestamp, to *count.
///
/// Cost: constant.
deldrift_status deldrift_staged_count(const deldrift_triangulation *t, size_t *count);

/// How many bytes of memory the triangulation holds, to *bytes. What its views show is included, and so is what it
/// keeps as room for later calls; what the system's allocator adds to each array is not. The number may grow in any
/// call on the triangulation, also in one that fails, and in one that takes it as const (deldrift_cells makes arrays).
/// deldrift_compact makes it as small as that of a fresh triangulation, but for arrays that are made again when asked
/// for.
///
/// Cost: constant.
deldrift_status deldrift_memory_bytes(const deldrift_triangulation *t,
                                      size_t *bytes);

/// The number of the current timestamp, to *timestamp. It is 0 at creation, and one more after each commit.
///
/// Cost: constant.
deldrift_status deldrift_timestamp(const deldrift_triangulation *t,
                                   uint64_t *timestamp);

/// Whether a vertex of this id is present, to *present. It is not if it has been removed, or never was, or if only its
/// insertion is staged. It is if only its removal is staged.
///
/// Cost: constant.
deldrift_status deldrift_is_present(const deldrift_triangulation *t,
                                    uint32_t vertex,
                                    bool *present);

/// The position of a vertex at the current timestamp, not a staged one, to position.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX.
deldrift_status deldrift_position(const deldrift_triangulation *t,
                                  uint32_t vertex,
                                  double *position);

/// The positions of all ids, in their order. Present vertices have the positions of the current timestamp, vertices
/// whose insertion is staged those where they will be inserted, and removed vertices NaN. So the array can be changed
/// and handed to deldrift_commit_positions.
///
/// positions: a buffer with room for capacity points. count: receives the number of ids.
///
/// Cost: n.
deldrift_status deldrift_copy_positions(const deldrift_triangulation *t,
                                        double *positions,
                                        size_t capacity,
                                        size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Queries: cells, and what is where. None changes the triangulation.
// ---------------------------------------------------------------------------------------------------------------------

/// The cells, without a copy, to *view.
///
/// The first call of all makes the arrays, which are kept. The first call after a change brings them up to date, in
/// time proportional to what has changed. Further calls take constant time. A cell that exists before and after a
/// change keeps its index, whatever the algorithm. But where cells have become fewer, the last ones take the free
/// indices (see deldrift_take_changes). Calls on several threads are legal, the first included.
///
/// Cost: m for the first call of all; after a change what has changed; else constant.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_cells(const deldrift_triangulation *t,
                               deldrift_cells_view *view);

/// Hands the arrays of deldrift_cells over to the program, to *view, with an owner for them, to *owner. They stay
/// valid, and as they are, until the owner is handed to deldrift_free_cells, whatever becomes of t.
///
/// Views that deldrift_cells has given since the last change, or the last call of this function, are of these arrays.
/// They are valid until this owner is freed, and no longer. So a program that has shown them to others, such as an
/// interpreter, can call this before it makes a change. Later views are of copies, which belong to t. A commit that
/// fails counts as a change, and so does deldrift_compact.
///
/// Cost: m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY; then nothing is handed over, and views are as valid as before.
deldrift_status deldrift_release_cells(deldrift_triangulation *t,
                                       deldrift_cells_view *view,
                                       deldrift_released_cells **owner);

/// Frees arrays that deldrift_release_cells has handed over, once. NULL is legal and does nothing; a misaligned pointer
/// does nothing either.
///
/// Cost: m at most, to free memory.
void deldrift_free_cells(deldrift_released_cells *owner);

/// A copy of the cells: see deldrift_cells_view for what the rows mean.
///
/// vertices, neighbours: buffers with room for capacity rows of 3 (2D) or 4 (3D) numbers. count: receives the number of
/// cells.
///
/// Cost: m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_copy_cells(const deldrift_triangulation *t,
                                    uint32_t *vertices,
                                    uint32_t *neighbours,
                                    size_t capacity,
                                    size_t *count);

/// The star of a vertex: the indices of the cells that have it as a corner, in no particular order. A hidden vertex has
/// the star of its representative.
///
/// cells: a buffer with room for capacity indices. count: receives their number.
///
/// In a periodic triangulation a cell is listed once for each of its corners that is the vertex, in whatever period.
///
/// Cost: the cells of the star; m for a periodic triangulation. Where there are more vertices than a cache holds, stars
/// are read fastest in the order of the ids.
///
/// Errors: DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_star(const deldrift_triangulation *t,
                              uint32_t vertex,
                              uint32_t *cells,
                              size_t capacity,
                              size_t *count);

/// The tolerance of a vertex, to *out: while every vertex stays closer to its current position than its
/// tolerance, no cell changes.
///
/// It is a certified lower bound: rounding can make it smaller, but never too large. It is 0 where nothing is certain,
/// and for vertices that share their place. It is infinite, without a meaning, while there are no cells. It is computed
/// from the star of the vertex, whatever the algorithm in force. At segments it is what the orientation of the cells on
/// both sides allows. In a periodic triangulation images move as their vertices do, and the vectors stay. There a vertex
/// that alone makes a side of a slab has 0, as it is on one line with its images.
///
/// Cost: the cells of the star.
///
/// Errors: DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_tolerance(const deldrift_triangulation *t,
                                   uint32_t vertex,
                                   double *out);

/// Checks the triangulation exactly, in time proportional to its size.
///
/// level: 1 checks indices and adjacency. 2 also checks the orientation of the cells, and that the hull is convex and
/// winds once. 3 also checks that no sphere through the vertices of a cell contains a vertex. With segments only
/// vertices count that can be seen from the cell's inside. In a periodic triangulation this is checked of what is kept
/// inside, images included. All levels check that images are where the vectors take their vertices. 3 also checks that
/// no image is missing, and that each cell is there once for each of its corners.
///
/// Cost: n + m. Of a periodic triangulation at level 3 that of creation at most, in a copy.
///
/// Errors: DELDRIFT_INVALID_LEVEL, DELDRIFT_INVALID if something is wrong: deldrift_last_error then gives the first
/// violation; DELDRIFT_OUT_OF_MEMORY if t is periodic.
deldrift_status deldrift_validate(const deldrift_triangulation *t,
                                  uint32_t level);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif // DELDRIFT_CORE_H
