/*
 * deldrift: exact Delaunay triangulations of moving points, in 2D and 3D.
 *
 * Made by `make header` from src/capi and, for the algorithms, src/motion/algorithms.rs: change it there.
 *
 * A triangulation is created once from an array of points. Vertex i is the i-th point, until
 * deldrift_compact gives new ids. Then the points move: stage the moves, commit them as the next
 * timestamp, read the cells. After every commit the cells are exactly those of the Delaunay triangulation
 * of the current positions. Ties (cocircular and cospherical points) are broken by vertex id, so the cells
 * depend only on positions and ids; or by keys that the program gives (deldrift_create_with_keys). In 2D edges can be
 * prescribed: with segments (deldrift_stage_segments) the triangulation is the constrained Delaunay triangulation.
 *
 *     #include <deldrift.h>
 *     #include <stdio.h>
 *
 *     int main(void) {
 *         double square[] = {0, 0, 4, 0, 4, 3, 0, 3, 1, 1};  // vertices 0 to 4
 *         deldrift_triangulation *t;
 *         if (deldrift_create(2, square, 5, NULL, &t) != DELDRIFT_OK) {
 *             fprintf(stderr, "%s\n", deldrift_last_error());
 *             return 1;
 *         }
 *         double position[] = {3, 2};
 *         deldrift_cells_view cells;
 *         deldrift_move_vertex(t, 4, position);
 *         deldrift_commit_timestamp(t, NULL);
 *         deldrift_cells(t, &cells);
 *         for (const uint32_t *v = cells.vertices; v < cells.vertices + 3 * cells.count; v += 3)
 *             printf("triangle %u %u %u\n", v[0], v[1], v[2]);
 *         deldrift_destroy(t);
 *     }
 *
 * Compile and link: `cc program.c $(pkg-config --cflags --libs deldrift)`, or in CMake
 * `find_package(deldrift)` and `target_link_libraries(program deldrift::deldrift)`. C++ programs may use
 * deldrift.hpp, which wraps this header.
 *
 * Arrays. Points are contiguous: x0 y0 x1 y1 ... in 2D, x0 y0 z0 x1 ... in 3D. Counts and capacities are
 * in points, vertices or cells, never in numbers or bytes. A pointer must be aligned for its type and
 * point to as many elements as the count says. NULL is accepted where the documentation says so, and if the
 * count is 0; otherwise it is an error. What a pointer leads to cannot be checked: that arrays are as long as the
 * count says, that strings end in a NUL, and that what is handed over has not been freed or destroyed are duties of
 * the program. Arrays that a call writes must overlap with no other of its arrays. A buffer that may be NULL with a
 * capacity of 0, to ask for a count alone, may not be NULL with another: that is DELDRIFT_NULL_ARGUMENT.
 *
 * Staging. A vertex whose insertion is staged has an id, but is not present before the commit: functions that take its
 * id return DELDRIFT_STAGED_VERTEX; in arrays by id that a call fills, its entry is that of a removed vertex, but in
 * deldrift_copy_positions; in positions by id that you pass, it is where the vertex will be inserted. A vertex whose
 * removal is staged is present until the commit; it can be neither moved with that nor removed by it twice.
 *
 * Errors. Functions return a deldrift_status, DELDRIFT_OK being 0. A call that fails has no effect: what can be asked
 * about the triangulation is as it was, what is staged included, and outputs are not written (except the count of a
 * buffer that is too small). A failed call still ends views, and may keep the memory it reserved, which
 * deldrift_memory_bytes tells. deldrift_last_error gives the details. Nothing is printed, and no
 * exception leaves the library.
 *
 * Besides the errors named with each function, every function that takes a triangulation may return
 * DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUSY (called from a callback of a call
 * on the same triangulation), DELDRIFT_POISONED and DELDRIFT_INTERNAL_ERROR. Of a periodic triangulation (see
 * deldrift_create_periodic) those that do not serve it return DELDRIFT_PERIODIC, and those that tell of cells may return
 * DELDRIFT_OUT_OF_MEMORY.
 *
 * Costs. "Cost:" says how the time of a call grows: n stands for the number of ids, m for that of cells. m is below 2 n
 * in 2D; in 3D it is about 6.8 n for points spread evenly, and n² / 2 at most. docs/COSTS.md has what has been measured,
 * on sets of points that are hard. Memory is in proportion to n + m.
 *
 * Ownership. What deldrift_create made must be given to deldrift_destroy, once. Arrays that are passed in
 * are read during the call and not kept. Views (deldrift_cells_view, deldrift_changes) belong to
 * the triangulation and end with the next call on it that takes it as non-const, or with its destruction; but see
 * deldrift_cells_view for calls that change no cells, and deldrift_release_cells for views that outlive any.
 * Strings belong to the library.
 *
 * Threads. Functions that take `const deldrift_triangulation *` may run on the same triangulation from
 * any number of threads at once. Those that take it as non-const change it, and no other call on it may
 * run meanwhile. Different triangulations are independent, and none is bound to a thread. Errors are kept
 * per thread. Where more threads pay, the library starts some of its own and keeps them (see
 * deldrift_options). They handle no signals. A process that is forked off, between calls, has the triangulations
 * but not these threads, and starts its own. dlclose and exit end them.
 *
 * Floating point. Every function does, and gives, what it does in the default floating-point environment, whatever that
 * of the caller is: its rounding, traps, and numbers near zero that count as zero. It leaves the caller's environment as it
 * is, the flags of exceptions included. Callbacks run in the caller's environment; what they change there stays changed. This
 * is so on x86-64, by MXCSR, and on 64-bit ARM; on other processors calls must come from the default environment. What is
 * inline in deldrift.hpp and deldrift/cgal.hpp is compiled as a part of the program, and does its arithmetic in the
 * environment of the program.
 *
 * Stack. A call takes at most 80 KiB of the stack of its thread, however many points there are and whatever their
 * coordinates, if the library is compiled with any optimisation. So a thread that has 128 KiB, as threads of musl do by
 * default, is enough for a call, but for what callbacks take. The library's own threads have 2 MiB each, of address
 * space: what they use of it is memory, and no more than that of a call.
 *
 * Index. Types come first; then the functions, under these headings, each with the first function below it:
 *
 *     What a call says when it ends: status codes, the message of the last failure, the version.
 *         deldrift_status_string
 *     Options: a structure that can grow, read as far as the caller's header knows it.
 *         deldrift_options_init
 *     Creation, destruction, and what is chosen for the whole life of a triangulation.
 *         deldrift_create
 *     Motion: what is staged, and becomes a timestamp.
 *         deldrift_move_vertex
 *     Commits in two phases.
 *         deldrift_prepare_timestamp
 *     Changes that take effect at once, one vertex at a time; and new ids.
 *         deldrift_relocate_vertex
 *     Keys of vertices, which break ties in place of ids, and ids that are given again.
 *         deldrift_create_with_keys
 *     Segments between vertices of the plane, which have to be edges.
 *         deldrift_stage_segments
 *     Segments that are split where they are in the way of each other.
 *         deldrift_stage_splits
 *     The change list: what a program has to know that keeps something for each cell.
 *         deldrift_take_changes
 *     Conservative transfer of means in cells.
 *         deldrift_transfer_cells
 *     What a triangulation holds: counts, sums, and the positions of vertices.
 *         deldrift_vertex_count
 *     Queries: cells, and what is where. None changes the triangulation.
 *         deldrift_cells
 *     Where points lie, and which vertices are near.
 *         deldrift_locate
 *     What is near a place: the nearest vertices, those in a ball or a box, the cells that a new vertex would remove.
 *         deldrift_nearest_vertices
 *     The cells, hull facets and vertices that a vertex in a box could change.
 *         deldrift_cells_in_reach
 *     Geometry of the cells: circumspheres, volumes, masks by circumradius, and the facets around a mask.
 *         deldrift_circumcentres
 *     What segments divide the plane into: levels, labels, and boundaries in chains.
 *         deldrift_segments_of_cells
 *     Labels of regions that follow: the sides of segments keep them.
 *         deldrift_set_regions
 *     Refinement and coarsening of the cells of a domain.
 *         deldrift_quality_init
 *     What meets what: edges, neighbours and cells of vertices, mirror indices, ordered stars.
 *         deldrift_edges
 *     Geometry of some of the cells: those around vertices, and entries of arrays that a program keeps for all cells.
 *         deldrift_cells_around
 *     Voronoi cells and facets, clipped by a box, or by half-spaces besides.
 *         deldrift_voronoi_volumes
 *     Periodic triangulations: their creation, and what only they have.
 *         deldrift_create_periodic
 *     Values between vertices.
 *         deldrift_interpolate
 *     A triangulation as bytes, in memory or in a file, and a second one like it.
 *         deldrift_clone
 *     Exact signs for points of the caller's own. They need no triangulation.
 *         deldrift_orientation
 */

#ifndef DELDRIFT_H
#define DELDRIFT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Version of this header, that of the library it came with: see deldrift_version.
#define DELDRIFT_VERSION_MAJOR 0
#define DELDRIFT_VERSION_MINOR 1
#define DELDRIFT_VERSION_PATCH 0
#define DELDRIFT_VERSION_STRING "0.1.0"

/// No cell, no vertex: the neighbour of a cell across a facet of the convex hull, the nearest vertex of
/// an empty triangulation.
#define DELDRIFT_NONE UINT32_MAX

/// No label.
#define DELDRIFT_NO_LABEL (-2147483647 - 1)

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
    /// A buffer has room for fewer entries than there are. How many there are is in the message, and has been written
    /// to the count if the function has one.
    DELDRIFT_BUFFER_TOO_SMALL = 7,
    /// A coordinate is NaN or infinite.
    DELDRIFT_NOT_FINITE = 8,
    /// A coordinate is of a magnitude above 1e57: signs could not be exact.
    DELDRIFT_OUT_OF_RANGE = 9,
    /// No vertex ever had this id.
    DELDRIFT_NO_SUCH_VERTEX = 10,
    /// The vertex of this id has been removed.
    DELDRIFT_REMOVED_VERTEX = 11,
    /// A move of this vertex is already staged for the next timestamp.
    DELDRIFT_DUPLICATE_MOVE = 12,
    /// An array has another number of entries than there have to be: one for each id, cell or component; or, without a
    /// list of ids, more entries than there are ids.
    DELDRIFT_WRONG_COUNT = 13,
    /// Two vertices would be at the same place, and the options reject that.
    DELDRIFT_COINCIDENT = 14,
    /// There would be more vertices than 32-bit ids can name.
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
    /// Data are not those of a saved triangulation: they are damaged, incomplete or of another kind, or come from a
    /// later version; the message says what is wrong, and where.
    DELDRIFT_INVALID_DATA = 25,
    /// The system cannot read or write a file; the message has the path, and what the system says.
    DELDRIFT_IO_ERROR = 26,
    /// A field has no name, one that is not UTF-8, or no components; the message has its index.
    DELDRIFT_INVALID_FIELD = 27,
    /// The insertion of the vertex is staged, so that it is not there before the next commit; or its removal is staged,
    /// and it can be neither moved with that commit nor removed twice. The message says which.
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
    /// A timestamp is prepared, and the call is not one that may be made before deldrift_publish_timestamp or
    /// deldrift_withdraw_timestamp; the message has the timestamp and the number of rounds.
    DELDRIFT_PREPARED = 36,
    /// No timestamp is prepared that could be published.
    DELDRIFT_NOT_PREPARED = 37,
    /// The triangulation is periodic, and the function does not serve such.
    DELDRIFT_PERIODIC = 38,
    /// The vectors of a periodic box depend on each other, or nearly so, or are more than there are axes.
    DELDRIFT_DEPENDENT_VECTORS = 39,
    /// The call needs the lists of the latest deldrift_take_changes, and cells have changed since, or ids are not
    /// those of then.
    DELDRIFT_CHANGES_NOT_TAKEN = 40,
    /// The call works on regions by their labels, and the sides of one have none, or several; deldrift_regions counts the
    /// cells.
    DELDRIFT_UNDECIDED_REGIONS = 41,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_status deldrift_status;
#else
typedef uint32_t deldrift_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

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
    /// An end of the segment has been removed, or would be: other is the end, DELDRIFT_NONE if deldrift_compact has been
    /// called since.
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

/// What the index of a deldrift_location refers to.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_location_kind : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// At the place of a vertex: index is its id, the lowest one if several share the place.
    DELDRIFT_LOCATION_VERTEX = 0,
    /// In a cell or on its boundary, at no vertex: index is that of the cell.
    DELDRIFT_LOCATION_CELL = 1,
    /// Outside the convex hull: index is that of a cell with a hull facet that faces the place.
    DELDRIFT_LOCATION_OUTSIDE = 2,
    /// There are no cells, as the vertices do not span the dimension, and no vertex is at the place: index is
    /// DELDRIFT_NONE. At the place of a vertex the kind is DELDRIFT_LOCATION_VERTEX, with or without cells.
    DELDRIFT_LOCATION_NO_CELLS = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_location_kind deldrift_location_kind;
#else
typedef uint32_t deldrift_location_kind;
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

/// How values between vertices follow from those at vertices.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_interpolation : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// Linear in each cell.
    DELDRIFT_INTERPOLATION_LINEAR = 0,
    /// By the natural neighbours of a position, the vertices that would share an edge with it: each with the length or
    /// area of the Voronoi facet between the two over their distance (Laplace's, or non-Sibsonian interpolation).
    /// Smooth but at vertices and on the circles or spheres of cells.
    DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_interpolation deldrift_interpolation;
#else
typedef uint32_t deldrift_interpolation;
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

/// In how many lists of deldrift_neighbour_lists a pair of vertices is.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_pairs : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// In the list of each of the two in whose ball the other one is: full lists.
    DELDRIFT_PAIRS_FULL = 0,
    /// Each pair of which the full lists have one vertex or both, once: half lists.
    DELDRIFT_PAIRS_HALF = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_pairs deldrift_pairs;
#else
typedef uint32_t deldrift_pairs;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// What happens when a vertex would pass a segment: deldrift_check_passings says what that is.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_passing : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// Nothing: it is not looked for, except by deldrift_check_passings.
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

/// Arrays of cells that a program has taken over: opaque, made by deldrift_release_cells, unmade by
/// deldrift_free_cells.
typedef struct deldrift_released_cells deldrift_released_cells;

/// A triangulation: opaque, made by deldrift_create, unmade by deldrift_destroy.
typedef struct deldrift_triangulation deldrift_triangulation;

/// Options of a triangulation. Initialise them with deldrift_options_init, then set what should differ
/// from the defaults, all of which are zero.
///
/// The structure may grow in later versions. struct_size says how much of it the program knows: fields
/// beyond it have their defaults. A size greater than the library's own is accepted as long as all
/// bytes that the library does not know are zero. A size that is 0, ends inside a field or is beyond
/// 4096 is DELDRIFT_INVALID_OPTIONS, as is any value that has no meaning.
///
/// The callbacks are called from inside every function that names DELDRIFT_CANCELLED among its errors, where the call takes
/// long, and from inside no other; on the thread that makes the call, one at a time, and not after deldrift_destroy. They
/// must return normally (no exception, no longjmp). From inside a call that creates or changes a triangulation they must not
/// use it: such calls are turned away with DELDRIFT_BUSY. From inside one that takes it as const, as deldrift_voronoi_cells
/// does, they may read it, and calls that change it are turned away with DELDRIFT_BUSY; such calls may be made on several
/// threads at once, and each calls them. Other triangulations may be used. What user_data points to must live as long as the
/// triangulation, and its copies.
typedef struct deldrift_options {
    /// sizeof(deldrift_options) as the program sees it.
    size_t struct_size;
    /// Algorithm of later commits; may be changed by deldrift_set_algorithm. Default DELDRIFT_AUTO.
    deldrift_algorithm algorithm;
    /// Greatest number of threads a call may use, the calling one included; 0, the default, is no limit. The library uses
    /// as many as make the call faster, at most one per processor: one for each 5,000 vertices in 2D or 2,500
    /// in 3D to build and rebuild, and likewise to move all, check all certificates and flip in repair. All
    /// triangulations of the process share them, and they sleep between calls. The cells do not depend on the number. Their
    /// order, last bits of rounded numbers and the counts in reports may, unless parts is set. Callbacks come from the
    /// calling thread only.
    uint32_t threads;
    /// Default DELDRIFT_COINCIDENCE_MERGE.
    deldrift_coincidence coincidence;
    /// What commits, deldrift_check_staged and deldrift_relocate_vertex do when a vertex would pass a segment. Default
    /// DELDRIFT_PASSING_IGNORE.
    deldrift_passing passing;
    /// Greatest number of parts into which work is divided where that shows in the order of cells: builds, and flips. 0,
    /// the default, is one for each thread that is used. With any other number the same calls give the same answers for any
    /// number of threads and on every processor: cells in the same order, every bit of rounded numbers, and reports
    /// included. (A build for whose parts there is no memory is in one.) Parts should be as many as the threads that a
    /// program is to run on, at most: with fewer some threads have nothing to do in this work, and with more each costs
    /// something. For 100,000 vertices a build on one thread takes 1.1 times as long in eight parts as in one in 2D; in 3D
    /// 1.06 times in two, 1.1 in four and 1.3 in eight; for 20,000 1.2 times in 2D, 1.15 to 1.6 times in 3D.
    size_t parts;
    /// Called now and then during long calls: at least once for some ten thousand cells that are made, or looked at
    /// around single vertices. Passes over all vertices or cells, each of which takes a part of a build, are not
    /// interrupted. When it returns true, the call ends in DELDRIFT_CANCELLED and has had no effect. NULL, the default,
    /// never cancels.
    bool (*cancel)(void *user_data);
    /// Called just before cancel would be, with the part of the work that is done, from 0 to 1, as far as that is
    /// known: it need not change from one call to the next, and begins again where a commit goes on by rebuilding. NULL
    /// is the default.
    void (*progress)(void *user_data, double fraction);
    /// Handed to the callbacks as it is.
    void *user_data;
} deldrift_options;

/// What a commit did, or, from deldrift_statistics, what all of them did.
///
/// A vertex that leaves its tolerance is relocated once; none ever has to be a second time.
typedef struct deldrift_commit_report {
    /// Number of the timestamp reached: 0 at creation, one more at each commit.
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
    /// Hidden vertices at the end: those at the place of a vertex with a lower id, or key.
    uint64_t coincident;
    /// Vertices that were certainly within their tolerance, with an algorithm that tests it.
    uint64_t within_tolerance;
    /// Bi-cells whose tolerance was computed.
    uint64_t tolerances;
    /// Orientations and in-sphere tests of the stars of relocated vertices.
    uint64_t certificates;
    /// Signs, of whatever purpose, that floating-point filters left to exact arithmetic; ties are among them, but
    /// those on a lattice, in builds, need none.
    uint64_t exact_calls;
    /// Vertices inserted.
    uint64_t inserted;
    /// Vertices removed.
    uint64_t removed;
    /// Zero; later versions may count more.
    uint64_t reserved[3];
} deldrift_commit_report;

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
    /// Segments that pieces take the place of.
    uint64_t replaced_segments;
    /// Pieces to be made.
    uint64_t pieces;
    /// How often segments and pieces were split, all that were in the way of each other at a time.
    uint64_t rounds;
    /// The id of the first vertex to be inserted; the others follow it. The id that would be given next if there are none.
    uint32_t first_vertex;
    /// The id of the first piece; the others follow it, by the ids of their segments, and along each of these from its first
    /// end. The id that would be given next if there are none.
    uint32_t first_piece;
    /// Zero; later versions may tell more.
    uint64_t reserved[3];
} deldrift_split_report;

/// What has changed since the program last took the changes: lists that belong to the triangulation, valid
/// until the next call that changes it. A pointer is NULL if its list is empty.
///
/// A cell is its set of vertices: one that existed before and exists now is neither created nor removed, whatever has
/// happened in between. It keeps its index unless it is listed as renumbered. Its row keeps the order of the
/// vertices, except if the cell was turned over by a motion through a flat cell, or was removed and created
/// again in between. A program with data per cell updates it in three steps:
/// set aside those of removed cells, and of renumbered ones by old index; write the latter to their new
/// indices; make those of created cells. Neighbours change only at cells that are listed, and at the
/// neighbours of those.
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
    /// program last took the changes. Vertices may have been removed since; after a compaction those are DELDRIFT_NONE.
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
    /// Number of vertices that are hidden and were not: a vertex of lower id, or key, is at the same place now.
    size_t hidden_count;
    /// These vertices, ascending.
    const uint32_t *hidden;
    /// Number of vertices that were hidden and are not.
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
    /// The area or volume of the cells that are gone to which no cell has come, with its sign.
    double lost_volume;
    /// That of the cells that have come of which none of those that are gone has had any, with its sign.
    double gained_volume;
    /// By how much at most both are off: what is no more than that may be 0.
    double volume_error;
    /// Zero; later versions may tell more.
    double reserved_numbers[3];
} deldrift_transfer_report;

/// The cells of a triangulation: triangles in 2D, tetrahedra in 3D. Read-only, without a copy, valid
/// until the next call that changes the triangulation.
///
/// Calls that stage, that discard what is staged, that take changes, and deldrift_set_algorithm, change no cells: a
/// view that is not older than the last change stays valid. After deldrift_release_cells it is valid until its owner is
/// freed.
///
/// Cells are positively oriented: the vertices of a triangle are in counter-clockwise order; of a
/// tetrahedron a, b, c, d, the determinant of the rows b - a, c - a, d - a is positive.
typedef struct deldrift_cells_view {
    /// Number of cells.
    size_t count;
    /// 3 in 2D, 4 in 3D.
    uint32_t corners_per_cell;
    /// count rows of corners_per_cell vertex ids. NULL if there are no cells.
    const uint32_t *vertices;
    /// count rows of corners_per_cell cell indices: entry i of a row is the cell on the other side of
    /// the facet opposite vertex i, DELDRIFT_NONE on the hull. NULL if there are no cells.
    const uint32_t *neighbours;
} deldrift_cells_view;

/// Where a point lies.
typedef struct deldrift_location {
    /// What index names.
    deldrift_location_kind kind;
    /// A vertex or a cell.
    uint32_t index;
} deldrift_location;

/// What deldrift_refine and deldrift_coarsen work towards, and how. Initialise it with deldrift_quality_init, then set what
/// should differ from the defaults: without a criterion nothing is done.
///
/// The structure may grow in later versions, as deldrift_options does: struct_size says how much of it the program knows.
///
/// Arrays are read during the call only.
typedef struct deldrift_quality {
    /// sizeof(deldrift_quality) as the program sees it.
    size_t struct_size;
    /// The least angle of a cell in degrees, up to 34; 0, the default, for any. Up to 26.5 degrees all cells have it wherever
    /// angles between segments are at least 60 degrees and no vertex is within 1,024 last places of the greatest coordinate of
    /// another one or of a segment, as is proved; above they do in practice. Refinement ends for all angles and domains: no
    /// vertex is inserted that is so near to another one.
    double least_angle;
    /// The greatest area of a cell; 0, the default, for any.
    double greatest_area;
    /// A label for each cell, in the order of deldrift_cells, as deldrift_label_cells gives them; NULL, the default, for those
    /// of deldrift_regions, with 0 for other.
    const int32_t *labels;
    /// How many labels there are: as many as cells, or 0.
    size_t label_count;
    /// The greatest area of cells by label, 0 for any: entry k is that of label k, and labels below 0 and beyond have none.
    /// New cells have the label of the region that they are in. NULL by default.
    const double *areas;
    /// How many areas there are.
    size_t area_count;
    /// By vertex id the greatest length of edges there: no edge of a cell is longer than the mean at its corners. New
    /// vertices have what is between. Above 0, infinity for any; entries of removed vertices are not used. NULL, the default,
    /// for any.
    const double *sizes;
    /// How many sizes there are: as many as ids, or 0.
    size_t size_count;
    /// Another criterion: whether a cell is too large, with the coordinates of its corners, 6 numbers, counter-clockwise: 1
    /// if it is, otherwise 0. It has to give the same answer for the same corners, and 0 for cells that are small enough. A
    /// number below 0 is to stop: it is not called again, and the call ends in DELDRIFT_CANCELLED and has had no effect. It is
    /// called from inside the call as the callbacks of deldrift_options are. NULL, the default, for none.
    int (*is_too_large)(void *user_data, const double *corners);
    /// Handed to is_too_large as it is.
    void *user_data;
    /// Which segments deldrift_refine keeps whole: default DELDRIFT_KEPT_NONE. Cells at those that it keeps may stay bad.
    deldrift_kept keeps;
    /// Not 0 if deldrift_refined_weights will be asked for. Default 0.
    uint32_t has_weights;
    /// Not 0 if no corner of a cell is to be strictly inside the circle that has a segment at the cell for a diameter. Then no
    /// vertex is inside the circle of a cell that it sees, segments or not: a conforming Delaunay triangulation. Segments that
    /// are kept whole may have such corners, and those that a vertex touches (see unsplit). What is said of 26.5 degrees then
    /// holds up to 20.7, and there are more cells.
    /// Default 0: segments are split where angles, areas and lengths need it.
    uint32_t is_conforming;
    /// Greatest number of vertices that deldrift_refine inserts: default SIZE_MAX.
    size_t limit;
    /// By how many degrees the angles of cells that come by deldrift_coarsen have to be above the least one, so that the
    /// vertex that went is not missed at once: from 0 to 30, default 2.
    double margin;
    /// The share of the greatest areas and lengths that cells that come by deldrift_coarsen may have: above 0 and at most 1,
    /// default 0.9.
    double share;
    /// Two pieces of a segment are joined by deldrift_coarsen if the vertex between them is on the line through their other
    /// ends, or off it by no more than this share of the distance of these: from 0 to 1. Above 0 it may be off by 64 last
    /// places of the greatest coordinate at least. The default, 1e-9, is above what the rounding of motions adds up to.
    double joins;
    /// How many times as many vertices as a mesh made anew the mesh may have: 1 or more, default 1.1. Where deldrift_coarsen
    /// leaves more of those that deldrift_refine has inserted, or takes many away for another quality, the next
    /// deldrift_refine finds the mesh made anew, and if it has fewer by this factor takes it: in its one commit, the report of
    /// which tells what was removed. Infinity for never. Not done with sizes.
    double growth;
    /// Not 0 if deldrift_refine gives its vertices free ids, as deldrift_stage_insertions_at_free_ids does: of vertices
    /// that earlier commits have removed, the lowest first, and then new ones; deldrift_refined_vertices tells which. So
    /// deldrift_id_count does not grow for ever. From the first insertion on vertices have keys then, as if these had
    /// been given (see deldrift_keys): those that deldrift_refine inserts the greatest one, the others their ids. Who
    /// transfers means of cells takes the changes between deldrift_coarsen and deldrift_refine as well: a cell with the
    /// ids of one that was is not listed. Default 0.
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
    /// Segments removed, as pieces took the place of one, or one that of pieces.
    uint64_t replaced_segments;
    /// Segments that came. Their ids are the last ones that have been given.
    uint64_t new_segments;
    /// Pieces that had to be split and are whole, as there is no room for a vertex: between their ends, or as a vertex touches
    /// them, which is beside them by less than 1,024 last places of the greatest coordinate.
    uint64_t unsplit;
    /// Cells that are still bad, of those that were to be refined: at small angles between segments, at segments that are
    /// kept whole, and where the limit was reached. What is_conforming asks of segments does not count.
    uint64_t bad_cells;
    /// 1 if the limit was reached, otherwise 0.
    uint64_t is_cut_short;
    /// Zero; later versions may count more.
    uint64_t reserved[4];
} deldrift_quality_report;

/// Numbers for each vertex, or for each cell, that deldrift_write_vtu writes along.
typedef struct deldrift_field {
    /// What it is called: UTF-8, with a NUL at the end; without control characters, U+FFFE and U+FFFF, which XML does
    /// not have. Fields of vertices have different names, none of them "vertex", and so have fields of cells, none of
    /// them "marker" if there are segments.
    const char *name;
    /// components numbers for each vertex, by id (those of removed vertices are not written), or for each cell, by
    /// index.
    const double *values;
    /// How many numbers each has, at least 1.
    size_t components;
} deldrift_field;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// ---------------------------------------------------------------------------------------------------------------------
// What a call says when it ends: status codes, the message of the last failure, the version.
// ---------------------------------------------------------------------------------------------------------------------

/// A status in a few words, in English, without a full stop. For a number that is no status of this
/// version the text says so. The string is static. Never fails; may be called from any thread.
///
/// Cost: constant.
const char *deldrift_status_string(deldrift_status status);

/// The message of the last call on this thread that failed: which argument, which index, which value.
/// An empty string if none has failed. Calls that succeed leave it as it is, so look at it only after
/// a failure.
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
/// C and C++ programs have it from this header, so that it fills the structure of the header, whichever later version
/// they run with. Other languages have a function of this name in the library. In every version that one fills the
/// structure as it is here, and says so in struct_size; a program that knows more fields sets them to zero, which is the
/// default of all, and struct_size to the size of its structure.
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
/// dimension: 2 or 3. positions: count points one after the other, dimension numbers each (x, y or
/// x, y, z), in any unit; read during the call only; may be NULL if count is 0. Vertex i is the i-th of
/// them until the triangulation is destroyed, or deldrift_compact gives new ids. Any set is legal, the empty one,
/// coincident points and points on one line or plane included; where the points do not span the dimension there are no
/// cells. Every finite coordinate from -1e57 to 1e57 is accepted, however close to zero. options: NULL for the
/// defaults; read during the call only.
///
/// out: receives the triangulation, which the caller has to hand to deldrift_destroy. It is written on
/// success only.
///
/// Cost: on all sets of docs/COSTS.md n log n and m. No set takes more than n² in 2D, or n m in 3D, where m is the most
/// cells of any subset.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_INVALID_OPTIONS, DELDRIFT_NULL_ARGUMENT,
/// DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. May be called from any number of threads at once.
deldrift_status deldrift_create(uint32_t dimension,
                                const double *positions,
                                size_t count,
                                const deldrift_options *options,
                                deldrift_triangulation **out);

/// Destroys a triangulation: its memory is freed and its views end. NULL is legal and does nothing.
/// A poisoned triangulation is destroyed like any other. From inside a callback of a call on the same
/// triangulation this does nothing but set deldrift_last_error.
///
/// Cost: n + m at most.
void deldrift_destroy(deldrift_triangulation *t);

/// The dimension of the triangulation, 2 or 3, to *dimension.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_dimension(const deldrift_triangulation *t, uint32_t *dimension);

/// Changes the algorithm of later commits. Staged moves stay. Tolerances and delimiters that the new
/// algorithm needs and the old one did not keep are computed by the next commit.
///
/// Cost: n + m at most, to free what the old one keeps.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_INVALID_OPTIONS for a number that is no algorithm of this
/// version. Not to be called at the same time as any other call on t.
deldrift_status deldrift_set_algorithm(deldrift_triangulation *t,
                                       deldrift_algorithm algorithm);

/// The algorithm in force, to *algorithm: the one chosen, thus DELDRIFT_AUTO where the library chooses; after
/// deldrift_research_set_algorithm the number of that of deldrift/research.h.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_get_algorithm(const deldrift_triangulation *t,
                                       deldrift_algorithm *algorithm);

// ---------------------------------------------------------------------------------------------------------------------
// Motion: what is staged, and becomes a timestamp.
// ---------------------------------------------------------------------------------------------------------------------

/// Stages the move of one vertex for the next timestamp. Nothing that can be read changes until
/// deldrift_commit_timestamp.
///
/// position: 2 or 3 numbers, read during the call only.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NO_SUCH_VERTEX,
/// DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_DUPLICATE_MOVE, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY. Not to be called at the same time as any other call on t.
deldrift_status deldrift_move_vertex(deldrift_triangulation *t,
                                     uint32_t vertex,
                                     const double *position);

/// Stages the moves of count vertices for the next timestamp: all of them, or none if it fails.
///
/// vertices: count ids, each at most once. NULL stands for 0, 1, ..., count - 1: count may then be at most
/// deldrift_id_count, and vertices from count on are not staged. The entry of a vertex whose insertion is staged is
/// where it will be inserted, in place of where it would have been; entries of removed vertices, and of those whose
/// removal is staged, are not read.
/// positions: count points one after the other, 2 or 3 numbers each. Both are read during the call only
/// and may be NULL if count is 0, when nothing is staged.
///
/// Cost: count.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW,
/// DELDRIFT_WRONG_COUNT if there are more positions than ids, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX,
/// DELDRIFT_STAGED_VERTEX for one in vertices, DELDRIFT_DUPLICATE_MOVE (also within vertices), DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY. Not to be called at the same time as any other call on t.
deldrift_status deldrift_move_vertices(deldrift_triangulation *t,
                                       const uint32_t *vertices,
                                       const double *positions,
                                       size_t count);

/// Stages the insertion of count vertices: all of them, or none if it fails. They are present from the
/// next commit on, which makes them together with the staged moves and removals.
///
/// positions: count points, read during the call only; may be NULL if count is 0. first_vertex: receives
/// the id of the first, which is one above the highest given so far; the others follow it in their order. It must not
/// be NULL, even if count is 0: then it receives the id that would be given next.
///
/// The ids count in deldrift_id_count from now on, but until the commit the vertices are not present
/// (deldrift_is_present): functions that take an id return DELDRIFT_STAGED_VERTEX for them. Where they will be is told
/// by deldrift_copy_positions, and changed by deldrift_move_vertices without a list of ids and by
/// deldrift_commit_positions. deldrift_discard_moves forgets the insertions; ids are given again then if none higher
/// has been given since.
///
/// Cost: count, in the mean over many calls.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW,
/// DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_OUT_OF_MEMORY. Not to
/// be called at the same time as any other call on t.
deldrift_status deldrift_stage_insertions(deldrift_triangulation *t,
                                          const double *positions,
                                          size_t count,
                                          uint32_t *first_vertex);

/// Stages the removal of count vertices: all of them, or none if it fails. The next commit removes them,
/// together with the staged moves and insertions; until then the vertices are present, and can be asked about, and
/// relocated or removed at once. Moves staged for them are forgotten, and none can be staged any more
/// (DELDRIFT_STAGED_VERTEX; their entries in arrays without a list of ids are not read). deldrift_discard_moves forgets
/// the removals.
///
/// vertices: count ids, each at most once, read during the call only; may be NULL if count is 0.
///
/// The commit removes them one by one, or rebuilds where that takes less: where many go, or those with 64 neighbours
/// and more that go have more neighbours in all than there are vertices.
///
/// Cost: count, in the mean over many calls.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW,
/// DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX (its removal is staged already, or its
/// insertion is), DELDRIFT_OUT_OF_MEMORY.
/// Not to be called at the same time as any other call on t.
deldrift_status deldrift_stage_removals(deldrift_triangulation *t,
                                        const uint32_t *vertices,
                                        size_t count);

/// Forgets all staged moves, insertions and removals, of vertices and of segments.
///
/// Cost: what is staged.
///
/// Errors: DELDRIFT_NULL_ARGUMENT. Not to be called at the same time as any other call on t.
deldrift_status deldrift_discard_moves(deldrift_triangulation *t);

/// Makes the staged positions the next timestamp. The cells become those of the Delaunay triangulation
/// of the new positions, whatever the algorithm, or of the constrained one if there are segments; ids stay. A commit
/// without staged moves counts as a timestamp too.
///
/// report: receives what was done; may be NULL. Ends all views.
///
/// Cost: of k staged moves, insertions and removals at most k times that of deldrift_relocate_vertex, or that of
/// deldrift_create, whichever the algorithm chooses; of none, constant. While there are no cells, that of
/// deldrift_create. With segments, for each also the cells around an end, and those that it crosses in the Delaunay
/// triangulation, of k of them up to k².
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_COINCIDENT (if the options
/// reject it), DELDRIFT_CROSSING, DELDRIFT_ON_SEGMENT, DELDRIFT_END_REMOVED, DELDRIFT_ENDS_MEET (see
/// deldrift_segment_conflicts), DELDRIFT_PASSES_SEGMENT (if the options refuse it; looked at before all that segments
/// are refused for else), DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED: the triangulation
/// stays at its timestamp, and what is staged stays so. Not to be called at the same time as any other call
/// on t.
deldrift_status deldrift_commit_timestamp(deldrift_triangulation *t,
                                          deldrift_commit_report *report);

/// Moves all vertices and makes that the next timestamp: deldrift_move_vertices for all ids and
/// deldrift_commit_timestamp in one, usually without copying the positions.
///
/// positions: count points, one for each id (count must be deldrift_id_count, those of staged insertions included). A
/// vertex whose insertion is staged is inserted where its entry says; entries of removed vertices, and of those whose
/// removal is staged, are not read. They are read during the call only, which may be up to its end: neither a callback nor
/// another thread may change them before it returns. report: receives what was done; may be NULL. Ends all views.
///
/// Cost: n + m, and that of deldrift_commit_timestamp for what has moved.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW,
/// DELDRIFT_WRONG_COUNT if there are fewer or more, DELDRIFT_DUPLICATE_MOVE if a move is staged, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_CROSSING, DELDRIFT_ON_SEGMENT,
/// DELDRIFT_END_REMOVED, DELDRIFT_ENDS_MEET, DELDRIFT_PASSES_SEGMENT (if the options refuse it), DELDRIFT_TOO_MANY_CELLS,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED: the triangulation stays at its timestamp, no move is staged, and insertions, removals and segments are staged as before.
/// Not to be called at the same time as any other call on t.
deldrift_status deldrift_commit_positions(deldrift_triangulation *t,
                                          const double *positions,
                                          size_t count,
                                          deldrift_commit_report *report);

// ---------------------------------------------------------------------------------------------------------------------
// Commits in two phases.
// ---------------------------------------------------------------------------------------------------------------------

/// The first phase of a commit: brings the triangulation to the staged moves, insertions, removals and segments, as
/// deldrift_commit_timestamp does, so that every call that reads sees the prepared state. It is not a timestamp yet:
/// deldrift_timestamp gives the last one. deldrift_publish_timestamp makes it the next one, in constant time;
/// deldrift_withdraw_timestamp takes it back. A solver that rejects a step withdraws it; processes that have to agree
/// publish or withdraw together.
///
/// Rounds: while a timestamp is prepared, more may be staged and prepared, any number of times: another round of the same
/// timestamp, which begins where the last one has ended. A round that fails is taken back alone: the rounds before stay in
/// force, and what was staged for it stays staged.
///
/// report: receives what this round has done; may be NULL. Its timestamp is the one that is prepared. deldrift_statistics
/// counts rounds as they are made. Ends all views.
///
/// While a timestamp is prepared, these calls give DELDRIFT_PREPARED and do nothing: deldrift_commit_timestamp,
/// deldrift_commit_positions, deldrift_insert_vertex, deldrift_insert_vertex_with_key, deldrift_remove_vertex,
/// deldrift_relocate_vertex, deldrift_compact, deldrift_refine, deldrift_coarsen, deldrift_take_changes,
/// deldrift_transfer_cells, deldrift_clone, deldrift_save and deldrift_save_file. All others may be made, those that
/// stage or check what is staged included. Changes are of published states: between two calls of
/// deldrift_take_changes, rounds count as commits once they are published. deldrift_cells gives a cell that was there
/// before the index that it had, as after commits.
///
/// Passings are looked at round by round, each on the way from where the round before has left the vertices.
///
/// Memory: what the rounds have changed is kept until the timestamp is published or withdrawn; of a round that builds the
/// triangulation anew, all that was before. If deldrift_cells is called, so is what it brings up to date: where most cells
/// have changed, a copy of the arrays.
///
/// Cost: that of deldrift_commit_timestamp, and in later rounds a copy of where vertices were that the last one has moved. If t
/// is periodic, in the first round a copy of t, and as much memory; to publish or withdraw it frees one of both.
///
/// Errors: those of deldrift_commit_timestamp, DELDRIFT_OUT_OF_MEMORY and DELDRIFT_CANCELLED among them, except
/// DELDRIFT_PREPARED. Not to be called at the same time as any other call on t.
deldrift_status deldrift_prepare_timestamp(deldrift_triangulation *t,
                                           deldrift_commit_report *report);

/// The second phase of a commit: the state that deldrift_prepare_timestamp has prepared is the next timestamp. What has been
/// staged since the last round stays so. Needs no memory. Ends all views.
///
/// Cost: constant, but where a commit would sort the cells for speed, or t is periodic.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_PREPARED. Not to be called at the same time as
/// any other call on t.
deldrift_status deldrift_publish_timestamp(deldrift_triangulation *t);

/// Takes back what deldrift_prepare_timestamp has prepared, all rounds: the triangulation is as it was at its last timestamp,
/// with nothing staged. deldrift_save writes the bytes that it would have written then, after deldrift_discard_moves:
/// positions, cells with their indices and the order of their corners, neighbours, hidden vertices, segments and statistics are
/// those of that time, and deldrift_take_changes gives what it would have given. What has been staged is forgotten, for the
/// rounds or since, and ids that were given for it are given again, those of segments included. Without a prepared timestamp
/// nothing is done, and what is staged stays so.
///
/// What algorithms keep between commits may be computed again by the next one; cells that are new after that may have other
/// indices than without the rounds. Needs no memory, and cannot be refused any. Ends all views.
///
/// Cost: in proportion to what the rounds have changed, and, if deldrift_cells has been called since, to what it has brought
/// up to date.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT. Not to be called at the same time as any other call on t.
deldrift_status deldrift_withdraw_timestamp(deldrift_triangulation *t);

// ---------------------------------------------------------------------------------------------------------------------
// Changes that take effect at once, one vertex at a time; and new ids.
// ---------------------------------------------------------------------------------------------------------------------

/// Moves one vertex at once: the triangulation is that of the new position when the call returns. The
/// timestamp stays, and so do the moves staged for other vertices. Ends all views.
///
/// position: 2 or 3 numbers, read during the call only.
///
/// Cost: that of a removal and an insertion at most, of the cells around the vertex before and after, which can be
/// many. While there are no cells, that of deldrift_create. Of a periodic triangulation that of a commit of this one move.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NO_SUCH_VERTEX,
/// DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX if its insertion is staged, DELDRIFT_DUPLICATE_MOVE if a move of
/// this vertex is staged, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject it),
/// DELDRIFT_CROSSING, DELDRIFT_ON_SEGMENT, DELDRIFT_ENDS_MEET, DELDRIFT_PASSES_SEGMENT (if the options refuse it),
/// DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. Not to be called at the same time as any other call on
/// t.
deldrift_status deldrift_relocate_vertex(deldrift_triangulation *t,
                                         uint32_t vertex,
                                         const double *position);

/// Inserts a vertex at once. Ends all views.
///
/// position: 2 or 3 numbers, read during the call only. out_vertex: receives its id, which is one above
/// the highest ever given, or left by the latest deldrift_compact.
///
/// Cost: that of deldrift_locate, and the cells created and removed; of a periodic triangulation that of a commit of one
/// insertion.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_ON_SEGMENT, DELDRIFT_STAGED_VERTEX (if t
/// is periodic and insertions are staged, which have the next ids), DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. Not to be called at the same time as any other call on t.
deldrift_status deldrift_insert_vertex(deldrift_triangulation *t,
                                       const double *position,
                                       uint32_t *out_vertex);

/// Removes a vertex at once, with the move or the removal staged for it, if any. Its id is not given again before a
/// deldrift_compact, but by deldrift_stage_insertions_at_free_ids, nor is all of its memory. Ends all views.
///
/// Cost: up to 64 neighbours at most the square of their number, beyond that a build of the neighbours alone. In 3D
/// that may have as many cells as half the square of their number, as where all points are on the moment curve; each
/// ten to twenty thousand of them the callbacks are called. Of a periodic triangulation that of a commit of one removal.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX if its
/// insertion is staged, DELDRIFT_END_REMOVED for an end of a segment in force, DELDRIFT_TOO_MANY_CELLS,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. Not to be called at the same time as any other call on t.
deldrift_status deldrift_remove_vertex(deldrift_triangulation *t,
                                       uint32_t vertex);

/// Frees the memory that has served removed vertices, and gives the others new ids: 0, 1, ... in the order
/// of those that they have. Ties between cocircular or cospherical points are broken by keys, or the order of ids, so
/// the cells stay the same, with their indices in deldrift_cells; so do positions, staged moves, the ids of segments and the
/// timestamp. Memory and the time of commits are those of a fresh triangulation then. Ends all views.
///
/// map: receives the new id of each old one, DELDRIFT_NONE for removed vertices: a buffer with room for
/// capacity ids; NULL with capacity 0 if it is not wanted, NULL with another is DELDRIFT_NULL_ARGUMENT. Vertices whose
/// insertion is staged get new ids as well. count: receives the number of old ids
/// (deldrift_id_count before the call), which is also written when the buffer is too small: then nothing
/// has been compacted.
///
/// Takes no longer than a rebuild, and while it runs the memory of a second
/// triangulation. A periodic triangulation is built anew, if vertices have been removed: its cells stay, and may have other
/// indices.
///
/// Cost: n + m; of a periodic triangulation that of creation.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY; if t is periodic, DELDRIFT_CANCELLED, DELDRIFT_TOO_MANY_CELLS. Not to be called at the same time as
/// any other call on t.
deldrift_status deldrift_compact(deldrift_triangulation *t,
                                 uint32_t *map,
                                 size_t capacity,
                                 size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Keys of vertices, which break ties in place of ids, and ids that are given again.
// ---------------------------------------------------------------------------------------------------------------------

/// Creates a triangulation, as deldrift_create does, of vertices that have keys.
///
/// A key is what breaks ties in place of the id. Where points are cocircular or cospherical, the cells are those of the
/// order of keys; vertices of equal keys are in the order of their positions, by x, then y, then z. Of several vertices at the
/// same place the one of the lowest key, and of those the one of the lowest id, is the corner of cells. So cells follow from
/// positions and keys, and a program may give ids in any order: images of a vertex in a periodic box, or copies of those of
/// other processes, have the key of the vertex. Without a key of its own a vertex has its id for one.
///
/// keys: count of them, in the order of positions, any numbers; read during the call only. NULL stands for the ids.
/// All else is as in deldrift_create. Where vertices have keys they take 8 bytes for each id, deldrift_compact leaves them
/// as they are, and vertices that deldrift_refine and deldrift_stage_splits make have the greatest key, 2^64 - 1.
///
/// Cost: that of deldrift_create.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_INVALID_OPTIONS, DELDRIFT_NULL_ARGUMENT,
/// DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. May be called from any number of threads at once.
deldrift_status deldrift_create_with_keys(uint32_t dimension,
                                          const double *positions,
                                          const uint64_t *keys,
                                          size_t count,
                                          const deldrift_options *options,
                                          deldrift_triangulation **out);

/// Stages the insertion of count vertices, as deldrift_stage_insertions does, with keys; see deldrift_create_with_keys.
///
/// keys: count of them, in the order of positions, read during the call only. NULL stands for the ids. The others are as in
/// deldrift_stage_insertions.
///
/// Cost: count, in the mean over many calls; the first keys of a triangulation also n.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW,
/// DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_OUT_OF_MEMORY. Not to
/// be called at the same time as any other call on t.
deldrift_status deldrift_stage_insertions_with_keys(deldrift_triangulation *t,
                                                    const double *positions,
                                                    const uint64_t *keys,
                                                    size_t count,
                                                    uint32_t *first_vertex);

/// Stages the insertion of count vertices, as deldrift_stage_insertions_with_keys does, under ids that are given again:
/// those of removed vertices, the lowest first, and after these the ones above the highest id given so far. So
/// deldrift_id_count does not grow where vertices come and go for ever. An id is free from the removal of its vertex, or the
/// commit of that, until it is given here; deldrift_discard_moves makes those that are staged free again.
///
/// Who has kept an id of a removed vertex sees another vertex under it. In lists of changes it is as if the vertex had
/// moved: cells that have the same ids as before are not listed, whether or not an id is that of another vertex. Not
/// given again are ends of staged segments, and those of segments that have been split, as long as there are pieces of them.
///
/// keys: count keys, or NULL for the ids. vertices: room for count ids, receives that of each vertex, ascending; both may be
/// NULL if count is 0. The others are as in deldrift_stage_insertions.
///
/// Cost: n + count, a pass over 4 bytes for each id; and the segments.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW,
/// DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_OUT_OF_MEMORY. Not to
/// be called at the same time as any other call on t.
deldrift_status deldrift_stage_insertions_at_free_ids(deldrift_triangulation *t,
                                                      const double *positions,
                                                      const uint64_t *keys,
                                                      size_t count,
                                                      uint32_t *vertices);

/// Inserts a vertex at once, as deldrift_insert_vertex does, with a key; see deldrift_create_with_keys.
///
/// position: 2 or 3 numbers, read during the call only. key: any number. out_vertex: receives the id, one above the highest
/// given so far.
///
/// Cost: that of deldrift_insert_vertex; the first key of a triangulation also n.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_ON_SEGMENT, DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. Not to be called at the same time as any other
/// call on t.
deldrift_status deldrift_insert_vertex_with_key(deldrift_triangulation *t,
                                                const double *position,
                                                uint64_t key,
                                                uint32_t *out_vertex);

/// The key of each vertex by id, to keys: what it has been given, or else its id; also of vertices whose insertion is
/// staged. The entries of removed vertices are 0.
///
/// keys: receives them: a buffer with room for capacity keys; NULL with capacity 0 if it is not wanted, NULL with another is
/// DELDRIFT_NULL_ARGUMENT. count: receives deldrift_id_count, which is also written when the buffer is too small.
///
/// Cost: n.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_keys(const deldrift_triangulation *t,
                              uint64_t *keys,
                              size_t capacity,
                              size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Segments between vertices of the plane, which have to be edges.
// ---------------------------------------------------------------------------------------------------------------------

/// Stages segments between vertices: all of them, or none if it fails. From the next commit on, which makes them together
/// with the staged moves, insertions and removals, each is an edge, and the cells are the constrained Delaunay
/// triangulation of vertices and segments: the circle of a cell has no vertex inside that can be seen from the cell's
/// inside, where segments are opaque. Ties are broken by id as everywhere, so the cells depend only on positions, ids and
/// segments. Segments move with their ends, and stay until their removal is staged and committed. docs/SEGMENTS.md says
/// more.
///
/// ends: count rows of two vertex ids, in any order, of vertices that are present or whose insertion is staged. markers:
/// count numbers, which are kept with the segments, such as the kind of a boundary condition; NULL for zeros. Both are read
/// during the call only, and may be NULL if count is 0. first_segment: receives the id of the first, which is one above the
/// highest given so far; the others follow it in their order. It must not be NULL, even if count is 0: then it receives
/// the id that would be given next. Ids of segments stay, also through deldrift_compact, and are not given again.
///
/// A segment may be given twice, and be a part of the hull; many may share a vertex. Where vertices are at the same place
/// it goes to the one that represents them. Nothing is looked at before the commit, which is refused, as is
/// deldrift_check_staged, where segments cross, a vertex is on one, an end is removed, or both ends are at the same place:
/// see deldrift_segment_conflicts. Only the positions that it leads to count: a vertex may have gone from one side of a
/// segment to the other, unless the options refuse that: see deldrift_check_passings. Segments that are in force are kept by
/// calls that change one vertex at once, too, which are refused for the same reasons. deldrift_discard_moves forgets what is
/// staged of segments, too, and the ids of staged ones are given again. deldrift_staged_count does not count segments.
///
/// Cost: count.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX (the message counts ids in ends: that of row
/// k is ends[2 k] or ends[2 k + 1]), DELDRIFT_OUT_OF_MEMORY. Not to be called at the same time as any other call on t.
deldrift_status deldrift_stage_segments(deldrift_triangulation *t,
                                        const uint32_t *ends,
                                        const int32_t *markers,
                                        size_t count,
                                        uint32_t *first_segment);

/// Stages the removal of segments: all of them, or none if it fails. From the next commit on they need not be edges any
/// more. Their vertices stay. A vertex that is an end of segments can be removed by the commit that removes these.
///
/// segments: count ids of segments in force, each at most once, read during the call only; may be NULL if count is 0.
/// Segments that are staged can only be forgotten, by deldrift_discard_moves.
///
/// Cost: count, and that of looking for each among those staged before.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_SEGMENT for an id that is not in force, or whose removal is staged,
/// DELDRIFT_OUT_OF_MEMORY. Not to be called at the same time as any other call on t.
deldrift_status deldrift_stage_segment_removals(deldrift_triangulation *t,
                                                const uint32_t *segments,
                                                size_t count);

/// The segments in force, ascending by id: those of the last commit, and not what is staged. A segment whose removal is
/// staged is in force until the commit.
///
/// segments: a buffer with room for capacity ids; ends: for capacity rows of two vertex ids, in the order in which they were
/// given, which is what left and right of a segment go by; markers: for capacity numbers. One that is NULL is not filled.
/// count: receives the number of segments, which is also written when the buffers are too small.
/// NULL for all with capacity 0 asks for the count alone.
///
/// Cost: the segments in force.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_segments(const deldrift_triangulation *t,
                                  uint32_t *segments,
                                  uint32_t *ends,
                                  int32_t *markers,
                                  size_t capacity,
                                  size_t *count);

/// Whether a commit of what is staged, moves, insertions, removals and segments, would be refused because of segments.
/// Returns what deldrift_commit_timestamp would return as far as segments are concerned, and commits nothing: what is staged
/// stays so. deldrift_segment_conflicts then tells all conflicts, so that a solver can cut its step. Without segments, in
/// force or staged, nothing is looked at, and in 3D there are none. Ends all views, as a commit does.
///
/// A program that commits at once where nothing conflicts need not check first: a commit that is refused has no effect, and
/// tells the conflicts as well.
///
/// Cost: at most that of the commit, and of taking it back.
///
/// Errors: those of deldrift_commit_timestamp: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_CROSSING,
/// DELDRIFT_ON_SEGMENT, DELDRIFT_END_REMOVED and DELDRIFT_ENDS_MEET for conflicts, of which the first is told,
/// DELDRIFT_PASSES_SEGMENT (if the options refuse it; then conflicts have not been looked for), DELDRIFT_COINCIDENT (if the
/// options reject it), DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. Not to be called at the same time
/// as any other call on t.
deldrift_status deldrift_check_staged(deldrift_triangulation *t);

/// The conflicts for which the latest call that changes or checks t was refused: all of them, in ascending order of kind,
/// segment and other. None if it was not refused for conflicts. Ids of segments and vertices may be of such as were staged, and
/// have been discarded since.
///
/// This list and that of deldrift_passings are both of one call, the latest of deldrift_commit_timestamp,
/// deldrift_commit_positions, deldrift_prepare_timestamp, deldrift_check_staged, deldrift_check_passings,
/// deldrift_stage_splits, deldrift_relocate_vertex, deldrift_insert_vertex, deldrift_insert_vertex_with_key,
/// deldrift_remove_vertex, deldrift_refine, deldrift_coarsen and deldrift_compact. Each of them empties both lists when it
/// begins, whatever comes of it, unless it is turned away with DELDRIFT_PREPARED or DELDRIFT_BUSY, or for a pointer or a
/// structure that is no good. Calls that stage, discard, publish, withdraw or ask keep them. A copy, and what is loaded, has
/// none.
///
/// conflicts: a buffer with room for capacity entries. count: receives their number, which is also written when the buffer
/// is too small. NULL with capacity 0 asks for the count alone.
///
/// Where several segments are at one edge, each has conflicts of its own. A segment that loses both ends has a conflict for
/// each. Those of a segment without two ends, which are of the kinds DELDRIFT_CONFLICT_END_REMOVED and
/// DELDRIFT_CONFLICT_ENDS_MEET, are all that is told of it.
///
/// Cost: the number of conflicts.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_segment_conflicts(const deldrift_triangulation *t,
                                           deldrift_conflict *conflicts,
                                           size_t capacity,
                                           size_t *count);

/// Whether vertices would pass segments in a commit of what is staged, whatever the options say of it. Commits nothing, and
/// what is staged stays so. deldrift_passings then tells all that would. A program that asks before each commit knows
/// which values to take over from the other side, or cuts its step; with an option, commits ask by themselves.
///
/// A commit compares positions at two timestamps, and accepts a vertex that has jumped across a segment, or a whole loop of
/// segments that has jumped across a vertex. What has happened in between is defined so: each vertex goes straight from its
/// old place to its new one, at constant speed, and so do both ends of each segment that is in force before and after. A
/// vertex passes a segment, of which it is no end, if it goes through it and is not back on its side when the step ends:
/// at f(s, t) = p(t) - a(t) - s (b(t) - a(t)) = 0, for s and t from 0 to 1, vertex p is on the segment from a to b, and it
/// passes if the number of zeros, each counted as 1 or -1 by the direction, is not 0. That is the number of times that the
/// quadrilateral p0 - a0, p0 - b0, p1 - b1, p1 - a1 winds around the origin. It also passes if the origin is on the
/// quadrilateral: then it goes exactly through an end on its way, or stops on the segment. All of this is exact, at all
/// positions.
///
/// Not told are: a vertex that goes through a segment and back in one step, as the end of the step is legal; one that is at
/// the place of an end of the segment before or after, as it is on no side there; vertices that are inserted or removed by
/// the commit, which do not move; and segments that are staged, or whose removal is, with their vertices. Ends of segments
/// are vertices as others, so that two segments that go through each other are told by their ends, and so are hidden
/// vertices, which move with those that represent them, or part from them. A vertex that goes around the end of a slit is
/// told if it goes through the slit on its straight way: what passes is a matter of the step, not of the region that a
/// vertex is in. One that enters a loop through one segment and leaves it through another is told for both.
///
/// Cost: where many vertices move, a pass over them, and for each near segments at any time of the step the test; less than
/// a commit of small moves. Where some move, and no ends of segments, that of looking at them and the segments.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_PASSES_SEGMENT if
/// a vertex would pass a segment, of which the message names the first, DELDRIFT_OUT_OF_MEMORY. Not to be called at the same
/// time as any other call on t.
deldrift_status deldrift_check_passings(deldrift_triangulation *t);

/// The vertices that pass segments in the step that the latest call has looked at: deldrift_check_passings, or, where the
/// options say that they look, a commit, deldrift_prepare_timestamp, deldrift_check_staged or deldrift_relocate_vertex; in
/// ascending order of segment and vertex. With DELDRIFT_PASSING_TELL those that have passed in the latest commit, with
/// DELDRIFT_PASSING_REFUSE those for which it was refused. deldrift_segment_conflicts says which calls empty the list.
///
/// segments: a buffer with room for capacity ids; vertices: for capacity ids; entry k of vertices
/// passes entry k of segments. One that is NULL is not filled. count: receives their number, which is also written when the
/// buffers are too small. NULL for both with capacity 0 asks for the count alone.
///
/// Cost: their number.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_passings(const deldrift_triangulation *t,
                                  uint32_t *segments,
                                  uint32_t *vertices,
                                  size_t capacity,
                                  size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Segments that are split where they are in the way of each other.
// ---------------------------------------------------------------------------------------------------------------------

/// Splits segments, staged ones and those in force, for which a commit of what is staged would be refused: to be called
/// before the commit. A segment with a vertex on it is replaced by pieces between its ends and such vertices, and two that
/// cross get a vertex there. The new vertices and the pieces are staged, and so are removals of segments in force that pieces
/// take the place of; a segment that was staged is not made, and its id is not given again. Where nothing is in the way of
/// segments nothing is done.
///
/// Pieces have the marker and the direction of their segment. Segments that overlap have common pieces, with an id for each
/// of them. A crossing is rounded correctly: each coordinate is the number nearest to that of the place where the segments,
/// or pieces of them, cross. If a vertex will be at that place, it is taken, the lowest id of several; and where a place on a
/// segment is rounded to that of an end of the other one, the segment is cut at that end. Pieces are straight between their
/// own ends, so that a segment may bend by last places, and be in the way of another one that it was not before: then both are
/// split again. Each coordinate of a vertex on a segment is off by at most rounds halves of a last place of the segment's
/// greatest coordinates, and along the segment both coordinates go one way. This ends, as numbers between the ends of a
/// segment do; mostly after one or two rounds, and after more where many segments go through nearly one place.
///
/// limit: how many vertices may be inserted at most; SIZE_MAX for any number. With 0 segments are split only at vertices that
/// are there. report: receives what has been staged; may be NULL.
///
/// Places and ids of the new vertices, and the edges that are required, depend only on positions, vertex ids and segments:
/// neither on the order and directions in which segments were given nor on what was before. All can be committed or
/// discarded as if the program had staged it; what is staged afterwards may be in the way of pieces, which can be split again.
/// Vertices that were inserted where segments cross stay when segments are removed, as all do.
///
/// Passings are not looked at, whatever the options say of them: a vertex that stops on a segment is where the segment is
/// split. The commit looks at them, but for those of segments that leave, and of pieces.
///
/// Cost: that of deldrift_check_staged for each round and once more; for m crossings that of sorting them, and a search among
/// them for each vertex.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT; DELDRIFT_CROSSING if more
/// than limit vertices would be inserted; DELDRIFT_END_REMOVED and DELDRIFT_ENDS_MEET for conflicts that no split resolves,
/// whatever others there are; for these three, deldrift_segment_conflicts tells all conflicts of what is staged;
/// DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. After an error what was staged is staged as before. Not to be called at the same
/// time as any other call on t.
deldrift_status deldrift_stage_splits(deldrift_triangulation *t,
                                      size_t limit,
                                      deldrift_split_report *report);

// ---------------------------------------------------------------------------------------------------------------------
// The change list: what a program has to know that keeps something for each cell.
// ---------------------------------------------------------------------------------------------------------------------

/// Takes what has changed since this was last called, to *changes: commits, immediate calls, insertions and removals
/// alike. The first call lists all cells as created.
///
/// A program that never calls this pays nothing for it; one that does pays in proportion to what has changed, and may
/// call it as often or as rarely as it likes. Ends the lists of the call before; a view of the cells stays valid unless
/// it is older than the last change. deldrift_cells takes constant time after it.
///
/// Where the triangulation is periodic, a cell is its vertices with their shifts from each other (deldrift_cell_shifts): one is
/// new if the program takes a vertex of it to another period, or gives other vectors of the lattice. From the first call on
/// cells that stay keep their indices; a commit that builds anew may list their corners in another order.
///
/// Cost: what has changed; of the first call n + m. Where the triangulation is periodic, always n + m.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_OUT_OF_MEMORY; then nothing has been taken.
/// Not to be called at the same time as any other call on t.
deldrift_status deldrift_take_changes(deldrift_triangulation *t,
                                      deldrift_changes *changes);

// ---------------------------------------------------------------------------------------------------------------------
// Conservative transfer of means in cells.
// ---------------------------------------------------------------------------------------------------------------------

/// Brings means in cells over to the cells of now: conservative transfer, by the latest deldrift_take_changes, of what
/// a program keeps for each cell.
///
/// A mean rides with its cell while vertices move, and a cell that lives keeps it. At the positions of now, the cells
/// that are gone and those that have come cover the same region: each new cell gets the mean of what is in it. So the
/// sum of mean times area or volume stays, where the hull does; a constant stays to the last bit; and no mean is
/// beyond those of the cells around. What is kept is the sum with the volumes at the positions of now: a program that
/// keeps the content of a cell while its volume changes divides it by the volume of now before, whatever the sign of
/// that.
///
/// positions: by id, where the vertices of the cells that were are now, or where they were when they were removed:
/// what a program has given to its last commit, before it reads the positions of what has been inserted since.
/// position_count rows of 2 or 3 numbers, of which those of vertices of cells that are gone are used. NULL for where
/// they are now, if none of them has been removed. In a periodic triangulation they are where vertices have gone,
/// through whatever periods: those before the program took any to another period. order: see deldrift_transfer_order.
/// values: rows of n_values components, for each cell that there was at the deldrift_take_changes before the last one,
/// in the order of that time; receives rows for the cells that there are, in the order of deldrift_cells. Numbers up
/// to 1e300 in magnitude. value_count: how many cells there were. capacity: for how many rows there is room, at least
/// for the cells that were and for those that are. report: receives what was met. lost, gained: receive n_values
/// numbers each, see below. Each of the last three may be NULL.
///
/// Where the hull has changed, regions differ. The content, mean times volume, that was where no new cell is, is told
/// as lost; that of new cells where nothing was, as gained: a new cell has the mean of what covers the rest of it, or,
/// if nothing does, that of the nearest cell through facets, or 0 if there is none. With these the sums always agree:
/// what there is, is what was less lost and with gained, but for rounding. Both are 0 where regions agree, but for
/// rounding: no more than volume_error times twice the greatest magnitude.
///
/// A cell that is gone, and is turned over at the new positions, has a negative volume there, and what it has in
/// common with others counts as negative; cells that live beneath it are both gone and come, and get other means, too.
/// So the sum stays exact, and so does a constant, but means there may be beyond those of all others: turned_over
/// tells of it, and shorter steps avoid it. A cell of now that was turned over since is gone as it was, and has come.
///
/// With the second order, what gradients add is limited for each cell by what its new mean may be: no less and no more
/// than the cells that it comes from have, their neighbours, and the neighbours of these. Gradients are fitted to the
/// means of neighbours. Linear functions are kept but for rounding where that does not limit them, as it may at the
/// hull.
///
/// Cost: n log n for n cells in the list of changes and what they have in common, times n_values. For those that are
/// turned over also log m each, and the cells of now that they meet, or would if they were half as large again; m, if no
/// corner of one is in the convex hull, or they meet an eighth of all. In a periodic triangulation also n + m.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_VALUE for an
/// order that there is not, for a value that is used and is no number or a greater one, and for positions that take a
/// cell through more than 64 periods, DELDRIFT_CHANGES_NOT_TAKEN if cells have changed since the latest
/// deldrift_take_changes, if there was none, or if ids have been given anew since the one before,
/// DELDRIFT_WRONG_COUNT, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_NO_SUCH_VERTEX for a vertex beyond position_count,
/// DELDRIFT_REMOVED_VERTEX for one where positions are NULL, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_PREPARED, DELDRIFT_CANCELLED, DELDRIFT_OUT_OF_MEMORY; then nothing is written.
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

// ---------------------------------------------------------------------------------------------------------------------
// What a triangulation holds: counts, sums, and the positions of vertices.
// ---------------------------------------------------------------------------------------------------------------------

/// How many vertices are present, hidden ones included and removed ones not, to *count.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_vertex_count(const deldrift_triangulation *t, size_t *count);

/// How many ids have been given, or left by the latest deldrift_compact and given since, to *count: valid
/// ids are below it, those of removed vertices and of staged insertions too.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_id_count(const deldrift_triangulation *t,
                                  size_t *count);

/// How many cells there are, to *count.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_cell_count(const deldrift_triangulation *t, size_t *count);

/// How many moves are staged for the next timestamp, to *count.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_staged_count(const deldrift_triangulation *t, size_t *count);

/// How many bytes of memory the triangulation holds, to *bytes: what its views show and what it keeps as room
/// for later calls included, and without what the system's allocator adds to each of its arrays. It may grow in any
/// call on the triangulation, also in one that fails, and in one that takes it as const (deldrift_cells makes arrays);
/// deldrift_compact makes it as small as that of a fresh one, but for arrays that are made again when asked for.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_memory_bytes(const deldrift_triangulation *t,
                                      size_t *bytes);

/// The number of the current timestamp, to *timestamp: 0 at creation, one more at each commit.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_timestamp(const deldrift_triangulation *t, uint64_t *timestamp);

/// The sums of what all commits and immediate calls so far have done, to *report, whose timestamp and
/// coincident are those of now.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_statistics(const deldrift_triangulation *t,
                                    deldrift_commit_report *report);

/// Whether a vertex of this id is present, to *present: false if it has been removed, or never was, or only its
/// insertion is staged; true if only its removal is.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_is_present(const deldrift_triangulation *t,
                                    uint32_t vertex,
                                    bool *present);

/// The position of a vertex, 2 or 3 numbers, to position: that of the current timestamp, not a staged one.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX if its
/// insertion is staged.
deldrift_status deldrift_position(const deldrift_triangulation *t,
                                  uint32_t vertex,
                                  double *position);

/// The positions of all ids, in their order, 2 or 3 numbers each: of present vertices those of the current timestamp,
/// of vertices whose insertion is staged those where they will be inserted, of removed vertices NaN. So the array can
/// be changed and handed to deldrift_commit_positions.
///
/// positions: a buffer with room for capacity points. count: receives the number of ids, which is also
/// written when the buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Cost: n.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_copy_positions(const deldrift_triangulation *t,
                                        double *positions,
                                        size_t capacity,
                                        size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Queries: cells, and what is where. None changes the triangulation.
// ---------------------------------------------------------------------------------------------------------------------

/// The cells, without a copy, to *view.
///
/// The first call of all makes the arrays. They are kept: the first call after a change brings them up
/// to date, in time proportional to what has changed, and further calls take constant time. A cell that
/// exists before and after a change keeps its index, whatever the algorithm, unless cells have become
/// fewer: then the last ones take the free indices (see deldrift_take_changes). Calls on several threads are
/// legal, the first included.
///
/// Cost: m for the first call of all; after a change what has changed; else constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_cells(const deldrift_triangulation *t,
                               deldrift_cells_view *view);

/// Hands the arrays of deldrift_cells over to the program, to *view, with an owner for them, to *owner: they stay as
/// they are, and valid, until the owner is handed to deldrift_free_cells, whatever becomes of t.
///
/// Views that deldrift_cells has given since the last change, or the last call of this function, are of these arrays:
/// they are valid until this owner is freed, and no longer. So a program that has shown them to others, such as an
/// interpreter, can call this before it makes a change. Views that are got afterwards are of copies, which belong to t.
/// A commit that fails and deldrift_compact count as changes.
///
/// Cost: m.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_OUT_OF_MEMORY; then nothing is handed over,
/// and views are as valid as before. Not to be called at the same time as any other call on t.
deldrift_status deldrift_release_cells(deldrift_triangulation *t,
                                       deldrift_cells_view *view,
                                       deldrift_released_cells **owner);

/// Frees arrays that deldrift_release_cells has handed over, once. NULL is legal and does nothing, and neither does a
/// misaligned pointer. May be called from any thread.
///
/// Cost: m at most, to free memory.
void deldrift_free_cells(deldrift_released_cells *owner);

/// A copy of the cells: see deldrift_cells_view for what the rows mean.
///
/// vertices, neighbours: buffers with room for capacity rows of 3 (2D) or 4 (3D) numbers; one that is
/// NULL is not filled. count: receives the number of cells, which is also written when the buffers are
/// too small. NULL for both with capacity 0 asks for the count alone, with another it is DELDRIFT_NULL_ARGUMENT.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_copy_cells(const deldrift_triangulation *t,
                                    uint32_t *vertices,
                                    uint32_t *neighbours,
                                    size_t capacity,
                                    size_t *count);

/// The star of a vertex: the indices of the cells that have it as a corner, in no particular order; for
/// a hidden vertex those of its representative.
///
/// cells: a buffer with room for capacity indices. count: receives their number, which is also written
/// when the buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Of a periodic triangulation a cell is there once for each of its corners that is the vertex, in whatever period.
///
/// Cost: the cells of the star; m for a periodic triangulation. After a change the first call also does what the first
/// deldrift_cells does. Where there are more vertices than a cache holds, stars are read fastest in the order of the ids.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX,
/// DELDRIFT_STAGED_VERTEX if its insertion is staged, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_star(const deldrift_triangulation *t,
                              uint32_t vertex,
                              uint32_t *cells,
                              size_t capacity,
                              size_t *count);

/// The tolerance of a vertex, to *out: while every vertex stays closer to its current position than its
/// tolerance, no cell changes.
///
/// It is a certified lower bound: rounding can make it smaller, but never too large. It is 0 where nothing
/// is certain and for vertices that share their place, and infinite, without a meaning, while there are no
/// cells. Computed from the star of the vertex, whatever the algorithm in force. At segments it is what the orientation of
/// the cells on both sides allows.
///
/// Cost: the cells of the star.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NO_SUCH_VERTEX,
/// DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX if its insertion is staged, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_tolerance(const deldrift_triangulation *t,
                                   uint32_t vertex,
                                   double *out);

/// Checks the triangulation exactly, in time proportional to its size.
///
/// level: 1 checks indices and adjacency; 2 also the orientation of the cells, and that the hull is
/// convex and winds once; 3 also that no sphere through the vertices of a cell contains a vertex, or, with segments, none
/// that can be seen from the cell's inside. Of a periodic triangulation what is kept inside is checked so, images included,
/// and that these are where the vectors take their vertices; 3 also that none is missing, and that each cell is there
/// once for each of its corners.
///
/// Cost: n + m. Of a periodic triangulation at level 3 that of creation at most, in a copy.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_INVALID_LEVEL, DELDRIFT_INVALID if something is wrong:
/// deldrift_last_error then gives the first violation; DELDRIFT_OUT_OF_MEMORY if t is periodic.
deldrift_status deldrift_validate(const deldrift_triangulation *t,
                                  uint32_t level);

// ---------------------------------------------------------------------------------------------------------------------
// Where points lie, and which vertices are near.
// ---------------------------------------------------------------------------------------------------------------------

/// Where a point lies, exactly, to *location.
///
/// position: 2 or 3 numbers.
///
/// In a periodic triangulation the point is rounded to the grid of deldrift_create_periodic, as a vertex would be; it may
/// be in any period. The location is that of the translation of a vertex or a cell that is there:
/// deldrift_locate_in_period tells which one. It is outside only of what is open in some direction.
///
/// Cost: the cells that a walk crosses from where an earlier one ended, or from a vertex that is near: a few for most
/// sets, m at most. While there are no cells, constant; n in a periodic one. After a change the first call also does what
/// the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_locate(const deldrift_triangulation *t,
                                const double *position,
                                deldrift_location *location);

/// Where count points lie, exactly, to locations, which has room for count: as count calls of deldrift_locate,
/// and faster if each point is near the one before it. deldrift_locate_in_period also tells in which period of a periodic
/// triangulation.
///
/// positions: 2 or 3 numbers for each point; NULL if count is 0, as may locations be. hint: where to begin to look
/// for the first point, for example the last answer of the call before; NULL if nothing is known. It only
/// matters for speed: it may be far away, from before a change, or name nothing. It may be one of locations.
///
/// Cost: count times that of deldrift_locate. After a change the first call also does what the first deldrift_cells
/// does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY; then nothing is written.
deldrift_status deldrift_locate_points(const deldrift_triangulation *t,
                                       const double *positions,
                                       size_t count,
                                       const deldrift_location *hint,
                                       deldrift_location *locations);

/// Where count points lie, exactly, to locations, and in which period what is there, to shifts: deldrift_locate_points for
/// programs that need the places of the corners.
///
/// positions, hint, locations: as for deldrift_locate_points. shifts: receives a row of 2 (2D) or 3 (3D) whole numbers for
/// each point, multiples of the vectors, 0 beyond the last of these: by them the vertex is to be translated from its
/// position to be at the point, or the cell from where deldrift_cell_shifts has it to have the point, or, where the point is
/// outside, a facet of the hull that faces it. So the corners of the cell are at their positions and the sums of these
/// multiples and of theirs. May be NULL if count is 0.
///
/// In a periodic triangulation the points are rounded to the grid of deldrift_create_periodic, as vertices would be. All
/// shifts are 0 where there are no cells or vertices at the point, and where the triangulation is not periodic.
///
/// Cost: count times that of deldrift_locate. After a change the first call also does what the first deldrift_cells
/// does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY; then nothing is written.
deldrift_status deldrift_locate_in_period(const deldrift_triangulation *t,
                                          const double *positions,
                                          size_t count,
                                          const deldrift_location *hint,
                                          deldrift_location *locations,
                                          int64_t *shifts);

/// The vertex nearest to a point, to *vertex: the lowest id among the nearest, or where vertices have keys the one
/// of the lowest key; DELDRIFT_NONE if the
/// triangulation has no vertices.
///
/// position: 2 or 3 numbers. In a periodic triangulation it may be in any period, and is rounded as for deldrift_locate;
/// the distance is that of the nearest image of a vertex.
///
/// Cost: that of deldrift_locate, and the stars of the vertices on the way and of all that are nearest. While there are
/// no cells, n.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_nearest_vertex(const deldrift_triangulation *t,
                                        const double *position,
                                        uint32_t *vertex);

/// The lowest id among the vertices at the place of this one, or where vertices have keys the one of the lowest key and then
/// of the lowest id, to *representative: the one that is a corner of cells. It is the vertex itself unless the vertex is
/// hidden.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX if its
/// insertion is staged.
deldrift_status deldrift_coincident_representative(const deldrift_triangulation *t,
                                                   uint32_t vertex,
                                                   uint32_t *representative);

/// The vertices that are hidden, ascending, each with the one that represents it. Vertices of a periodic triangulation that
/// share a place in any period count.
///
/// vertices, representatives: buffers with room for capacity ids each. One that is NULL is not filled. count: receives
/// the number of hidden vertices, which is also written when the buffers are too small. NULL for both with capacity 0
/// asks for the count alone.
///
/// Cost: n; constant where there are none, and for the count alone; n for a periodic triangulation.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL; DELDRIFT_OUT_OF_MEMORY if t is
/// periodic.
deldrift_status deldrift_hidden_vertices(const deldrift_triangulation *t,
                                         uint32_t *vertices,
                                         uint32_t *representatives,
                                         size_t capacity,
                                         size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// What is near a place: the nearest vertices, those in a ball or a box, the cells that a new vertex would remove.
// ---------------------------------------------------------------------------------------------------------------------

/// The k vertices nearest to each of count positions: rows of k ids, by distance and, at the same distance, by id, or by key
/// where vertices have keys;
/// DELDRIFT_NONE where there are fewer vertices than k. Distances are compared exactly. Hidden vertices count like
/// others.
///
/// positions: 2 or 3 numbers each, read during the call only; NULL if count is 0. vertices: receives count rows of k
/// ids; may be NULL if there are none.
///
/// It is fastest if each position is near the one before it. The first id of a row is that of deldrift_nearest_vertex.
///
/// In a periodic triangulation positions may be in any period, and are rounded as for deldrift_locate. Each vertex comes
/// once, by the distance of its nearest image (the minimum image); images farther away do not count.
///
/// Cost: count times that of deldrift_nearest_vertex, the stars of the k vertices, and k log k; with k = 0 constant.
/// While there are no cells, count times n; n more in a periodic triangulation with hidden vertices.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY; then nothing is written.
deldrift_status deldrift_nearest_vertices(const deldrift_triangulation *t,
                                          const double *positions,
                                          size_t count,
                                          size_t k,
                                          uint32_t *vertices);

/// The vertices in a closed ball, ascending by id, hidden ones included: those whose squared distance from centre is at
/// most squared_radius. Exact.
///
/// centre: 2 or 3 numbers. squared_radius: 0 or more; infinity is all vertices. vertices: a buffer with room for
/// capacity ids; deldrift_vertex_count is always enough. count: receives their number, which is also written when the
/// buffer is too small. NULL with capacity 0 asks for the count alone, which takes as long.
///
/// In a periodic triangulation the centre may be in any period, and is rounded as for deldrift_locate. A vertex is in the
/// ball if any image of it is; each is told once. The ball may be larger than the box.
///
/// Cost: that of deldrift_nearest_vertex, the stars of the vertices in the ball, and k log k for the k of them; n log n
/// at most but for the former. While there are no cells, and in a periodic triangulation with hidden vertices, n.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_INVALID_VALUE for a squared radius that is negative or NaN, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_vertices_in_ball(const deldrift_triangulation *t,
                                          const double *centre,
                                          double squared_radius,
                                          uint32_t *vertices,
                                          size_t capacity,
                                          size_t *count);

/// For each vertex the others that are near it, all in one call: the neighbour lists of particle codes.
///
/// The list of a vertex has the vertices of which the squared distance from it is at most that of its radius, exactly: those that
/// deldrift_vertices_in_ball finds around it, hidden ones included, but not the vertex itself. Hidden vertices have lists, too;
/// those of removed ones are empty, as they are of vertices that are staged. Each list ascends by id.
///
/// squared_radii: one number, the square of the radius of all lists, radius_count being 1; or one for each id, radius_count being
/// deldrift_id_count. Each is 0 or more, and infinity is all vertices. Entries of vertices without a list are not looked at.
/// mask: an entry for each vertex id; only vertices whose entry is not 0 have a list, in which others may be all the same. NULL for
/// all. mask_count: deldrift_id_count; without a mask it is not looked at.
/// pairs: DELDRIFT_PAIRS_FULL, or DELDRIFT_PAIRS_HALF for each pair once. Where radii differ, the one vertex may be in the ball of the
/// other and not the other way round; half lists have each pair that full lists have one way or both, so that two vertices with
/// lists are a pair if their distance is at most the greater one of their radii. It is in the list of the lower id, or, if only one of
/// the two has a list, in that.
///
/// offsets: a buffer for offset_count numbers, which must be deldrift_id_count + 1: the list of vertex v is in neighbours from the
/// index that is entry v of offsets on, and ends before entry v + 1. neighbours: a buffer with room for capacity ids. shifts: one
/// with room for as many rows of 2 (2D) or 3 (3D) whole numbers: in which period each neighbour is, as deldrift_edge_shifts has them.
/// One that is NULL is not filled. count: receives the number of entries, which is also written when neighbours or shifts are too
/// small; then nothing else is. NULL for both with capacity 0 asks for offsets and the count alone, for which nothing is kept. A program
/// that asks again and again, as in each step, keeps its buffers, with some room to spare, and so asks once.
///
/// In a periodic triangulation a list has every image that is near, each with its shift, ascending by id and by shift: several of one
/// vertex, and of the vertex itself those in other periods, where the radius is large beside the box. Half lists have one of the two
/// ways between two images: of those from a vertex to itself the one whose shift has a first number that is not 0 above 0. Radii are
/// refused that are so large that places of images would be rounded: up to eight times the least distance between opposite sides of
/// the reduced box is always possible. Where the triangulation is not periodic, shifts are 0.
///
/// Uses the threads of the options, and calls their callbacks. The lists do not depend on how many threads there are. Takes memory for
/// the places and for all lists while it runs, and writes nothing until all are known.
///
/// Cost: n log n, the entries, and k log k for the k of each list. With one radius for all, that is so for every set, however unevenly
/// it is spread: what is looked at besides is at most a constant times n and the entries, and mostly some five times these. Where radii
/// differ by powers of two of many sizes, what is looked at for each size is at most n times the root of the number of entries.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT, DELDRIFT_INVALID_VALUE
/// for a squared radius that is negative or NaN, or too large for a periodic triangulation, and for other pairs,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_neighbour_lists(const deldrift_triangulation *t,
                                         const double *squared_radii,
                                         size_t radius_count,
                                         const uint8_t *mask,
                                         size_t mask_count,
                                         deldrift_pairs pairs,
                                         size_t *offsets,
                                         size_t offset_count,
                                         uint32_t *neighbours,
                                         int64_t *shifts,
                                         size_t capacity,
                                         size_t *count);

/// The vertices in a closed box, ascending by id, hidden ones included: those of which each coordinate is at least that
/// of low and at most that of high.
///
/// low, high: 2 or 3 numbers each, which may be infinite. Where one of low is above that of high there are none.
/// vertices: a buffer with room for capacity ids; deldrift_vertex_count is always enough. count: receives their number,
/// which is also written when the buffer is too small. NULL with capacity 0 asks for the count alone, which takes as
/// long.
///
/// In a periodic triangulation a vertex is in the box if any image of it is; each is told once. The box is not rounded, and may
/// be larger than the period; one that is 10^20 periods away is refused. Where vectors go along several axes, as in a skewed
/// box, one that is thousands of periods long, or infinite, along some of these has to be as wide as all these vectors together
/// along each, or infinite along all but one.
///
/// Cost: that of deldrift_locate, the cells whose bounding boxes meet the box, the facets of the hull that are seen
/// from it, and k log k for the k vertices in it; n log n at most but for the first. While there are no cells, n. In a
/// periodic triangulation that of deldrift_vertices_in_ball where the box is shorter than half of the shortest vector, else n;
/// and, where vectors go along several axes, the periods that the box meets, for each vertex.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_INVALID_VALUE for NaN, or for a box that is too long,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_vertices_in_box(const deldrift_triangulation *t,
                                         const double *low,
                                         const double *high,
                                         uint32_t *vertices,
                                         size_t capacity,
                                         size_t *count);

/// The cells that the insertion of a vertex at a position would remove, in no particular order: those whose circle or
/// sphere has the position inside, exactly, with ties broken as for a vertex of the highest id. At the place of a
/// vertex, and while there are no cells, there are none.
///
/// position: 2 or 3 numbers. hint: where to begin to look for it, as for deldrift_locate_points; NULL if nothing is
/// known. cells: a buffer with room for capacity indices. count: receives their number, which is also written when the
/// buffer is too small. NULL with capacity 0 asks for the count alone, which takes as long.
///
/// A position outside the convex hull may be in the circle or sphere of no cell: then the insertion removes none, and
/// joins the vertex to the facets of the hull that it sees.
///
/// In a periodic triangulation the position may be in any period, and is rounded as for deldrift_locate. A cell is told, once,
/// if a translation of it is in conflict: it would be removed by the insertion of the vertex with all of its images. A position
/// outside the convex hull is refused, as facets without an end are seen from there.
///
/// Cost: that of deldrift_locate, the cells found, and the facets of the hull that are seen from the position. After a
/// change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_PERIODIC outside the hull of a periodic triangulation, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_conflicts(const deldrift_triangulation *t,
                                   const double *position,
                                   const deldrift_location *hint,
                                   uint32_t *cells,
                                   size_t capacity,
                                   size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// The cells, hull facets and vertices that a vertex in a box could change.
// ---------------------------------------------------------------------------------------------------------------------

/// The cells that a vertex at a place in one of some boxes could change: with deldrift_hull_facets_in_reach, what a process
/// has to know of vertices that it does not have, given where they may be.
///
/// A cell is in reach of a box if its closed circumscribed disc or ball meets the closed box. Exactly these are told,
/// decided without rounding: none is missing, and none is too many. A vertex that is inserted, or moves to, a place in the box
/// removes no other cell, whatever its id, and joins no facet of the hull but those in reach, and those in whose line or
/// plane its place is, where the cell behind is in reach.
///
/// low, high: box_count rows of 2 (2D) or 3 (3D) numbers, the least and the greatest coordinates of each box, which may
/// be infinite; NULL if box_count is 0. Places beyond the range of coordinates, of magnitudes above 1e57, do not count. A
/// box is empty, and nothing in reach of it, where one of low is above that of high. It may be a place, or flat. The
/// outside of a box is 4 (2D) or 6 (3D) boxes with infinite sides.
/// mask: an entry for each vertex id; only cells count that have a corner at the place of a vertex whose entry is not 0.
/// NULL for all cells. mask_count: deldrift_id_count; without a mask it is not looked at.
///
/// cells, centres, radii: buffers with room for capacity cells. They receive the indices of those in reach of any of the
/// boxes, ascending and each once; rows of 2 or 3 coordinates; and numbers. The closed ball with this centre and radius
/// certainly has the closed disc or ball of the cell in it. It is larger by some 1e-12 of the radius and last bits of the
/// coordinates, where the cell is nearly flat by up to 4e-9 of the radius. Where numbers do not suffice, the radius is
/// infinite and the centre a corner of the cell. A ball may cover all vertices though few are in that of the cell, if its
/// radius is 1e8 times their extent: whether the cell is in reach does not depend on that.
/// One that is NULL is not filled. count: receives the number of cells, which is also written when the buffers are too
/// small. NULL for all three with capacity 0 asks for the count alone.
///
/// While there are no cells, as all vertices are in one line or plane, or fewer than 3 or 4, none are told: then a vertex
/// anywhere could change all there is.
/// Where cells are constrained by segments, they are those whose discs meet the box and that are connected, by such cells,
/// with those that have a place of the box. Segments between them do not count. All that the insertion of a vertex in the
/// box would remove are among them.
///
/// Cost: for each box that of deldrift_locate, and the cells and hull facets in its reach, whether in the mask or not; k
/// log k for the k cells told. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT for a mask
/// of another length, DELDRIFT_INVALID_VALUE for NaN, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_cells_in_reach(const deldrift_triangulation *t,
                                        const double *low,
                                        const double *high,
                                        size_t box_count,
                                        const uint8_t *mask,
                                        size_t mask_count,
                                        uint32_t *cells,
                                        double *centres,
                                        double *radii,
                                        size_t capacity,
                                        size_t *count);

/// The facets of the convex hull that a place in one of some boxes is strictly beyond: those to which a vertex there
/// would be joined. Exact.
///
/// low, high, box_count, mask, mask_count: as for deldrift_cells_in_reach; with a mask, only facets count that have a
/// corner at the place of a vertex of it. cells, corners: buffers with room for capacity numbers, which receive the cell
/// of each facet and which of its corners (0, 1, ...) is opposite, as deldrift_hull_facets has them, ascending and each
/// once. One that is NULL is not filled. count: receives the number of facets, which is also written when the buffers are
/// too small. NULL for both with capacity 0 asks for the count alone.
///
/// While there are no cells, there are none.
///
/// Cost: that of deldrift_cells_in_reach.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT for a mask
/// of another length, DELDRIFT_INVALID_VALUE for NaN, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_hull_facets_in_reach(const deldrift_triangulation *t,
                                              const double *low,
                                              const double *high,
                                              size_t box_count,
                                              const uint8_t *mask,
                                              size_t mask_count,
                                              uint32_t *cells,
                                              uint8_t *corners,
                                              size_t capacity,
                                              size_t *count);

/// For each of some boxes the vertices of the cells and hull facets in its reach: those that a process sends to another
/// one whose vertices are in the box.
///
/// They are the corners of what deldrift_cells_in_reach and deldrift_hull_facets_in_reach tell for this box alone, and the
/// vertices hidden behind them; with a mask, those of which the entry is not 0. low, high, box_count, mask, mask_count: as
/// there.
///
/// vertices: a buffer with room for capacity ids, which receives a list for each box, ascending, one after the other.
/// offsets: a buffer with room for box_count + 1 numbers: the list of box k is in vertices from the index that is entry k of
/// offsets on, and ends before entry k + 1. One that is NULL is not filled. count: receives the number of entries, which
/// is also written when vertices is too small. NULL for both with capacity 0 asks for the count alone, which takes as long.
///
/// While there are no cells, a vertex anywhere could change all there is: all vertices of the mask are in reach of each
/// box that is not empty.
///
/// Cost: that of deldrift_cells_in_reach, and k log k for the k vertices of each list; while there are no cells, n for
/// each box.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT for a mask
/// of another length, DELDRIFT_INVALID_VALUE for NaN, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_vertices_in_reach(const deldrift_triangulation *t,
                                           const double *low,
                                           const double *high,
                                           size_t box_count,
                                           const uint8_t *mask,
                                           size_t mask_count,
                                           uint32_t *vertices,
                                           size_t *offsets,
                                           size_t capacity,
                                           size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Geometry of the cells: circumspheres, volumes, masks by circumradius, and the facets around a mask.
// ---------------------------------------------------------------------------------------------------------------------

/// The circumcentres and squared circumradii of all cells, in the order of deldrift_cells.
///
/// centres: a buffer with room for capacity points. squared_radii: a buffer with room for capacity numbers. One
/// that is NULL is not filled. count: receives the number of cells, which is also written when the buffers are
/// too small. NULL for both with capacity 0 asks for the count alone.
///
/// Rounded: a coordinate of a centre is off by at most 1e-9 circumradii and its own rounding, a squared radius by
/// 4e-9 of itself, however flat the cell; unless it is nearly flat, by a few last bits. What is too large for a
/// number is infinite; nothing is NaN. One pass over the cells; nearly flat ones take a microsecond each.
///
/// In a periodic triangulation a centre is where the cell's corner of the lowest id is at its own position, as
/// deldrift_cell_shifts has it, and its rounding may be twice that of its coordinates and of the position's.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_circumcentres(const deldrift_triangulation *t,
                                       double *centres,
                                       double *squared_radii,
                                       size_t capacity,
                                       size_t *count);

/// The areas (2D) or volumes (3D) of all cells, in the order of deldrift_cells.
///
/// volumes: a buffer with room for capacity numbers. count: receives the number of cells, which is also written
/// when the buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Rounded, with a relative error of at most 1e-9, and of a few last bits unless the cell is nearly flat: always
/// positive. (Below the least normal number, 2.2e-308, they are less accurate.) One pass over the cells; nearly flat
/// ones take up to a microsecond each.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_volumes(const deldrift_triangulation *t,
                                 double *volumes,
                                 size_t capacity,
                                 size_t *count);

/// Which cells have a circumradius of at most a given one, as for an alpha shape: 1 for those whose squared
/// circumradius is at most squared_radius, 0 for the others, in the order of deldrift_cells.
///
/// squared_radius: 0 or more; infinity is all cells. mask: a buffer with room for capacity bytes. count: receives
/// the number of cells, which is also written when the buffer is too small. NULL with capacity 0 asks for the count
/// alone.
///
/// Exact: every entry is that of an exact comparison of squared_radius, as given, with the squared radius of the
/// circle or sphere through the positions. One pass over the cells; where the two nearly agree, a cell takes a
/// microsecond.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_INVALID_VALUE for a squared radius that is
/// negative or NaN, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mask_by_circumradius(const deldrift_triangulation *t,
                                              double squared_radius,
                                              uint8_t *mask,
                                              size_t capacity,
                                              size_t *count);

/// Which cells are more than what the rounding of a straight or flat side has made: 0 for cells along the convex hull
/// that are flat, 1 for the others, in the order of deldrift_cells.
///
/// tolerance: 0 or more, such as 1e-9; 0 is all cells. A cell is flat if its least height is at most tolerance times
/// its longest edge. It has 0 if it is flat, and has a facet on the hull or on a cell that has 0. mask: a buffer with
/// room for capacity bytes. count: receives the number of cells, which is also written when the buffer is too small.
/// NULL with capacity 0 asks for the count alone.
///
/// Vertices that were meant to be on one line or plane are not, once their coordinates are rounded, and the hull goes
/// over flat cells from one to the other. They are exactly Delaunay, and useless where a program divides by areas or
/// volumes. Where no vertices but those of a side are nearly in line with it, the mask leaves these cells out and keeps
/// all others: deldrift_mask_boundary then gives the sides as they were meant. Flat cells elsewhere are kept, as
/// leaving them out would leave holes.
///
/// Rounded: a cell whose quotient of height and edge is tolerance but for a part of 1.1e-9 + 2e-15 / tolerance may get
/// either.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_INVALID_VALUE for a tolerance that is
/// negative or NaN, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mask_without_flat_cells(const deldrift_triangulation *t,
                                                 double tolerance,
                                                 uint8_t *mask,
                                                 size_t capacity,
                                                 size_t *count);

/// The boundary of some of the cells: the facets between a cell in a mask and one that is not in it, or the outside.
///
/// mask: mask_count bytes, one for each cell in the order of deldrift_cells (mask_count must be deldrift_cell_count);
/// a cell is in it if its byte is not 0. Read during the call only. facets: a buffer with room for capacity rows of 2
/// (2D) or 3 (3D) vertex ids. Facets are seen from outside: in 2D the cell in the mask is on the left of the edge from
/// the first vertex to the second; in 3D the vertices are in counter-clockwise order as seen from the side away from
/// the cell. cells, corners: buffers with room for capacity numbers, which receive that cell and which of its corners
/// (0, 1, ...) is opposite the facet. One of the three that is NULL is not filled. count: receives the number of
/// facets, which is also written when the buffers are too small. NULL for all three with capacity 0 asks for the
/// count alone.
///
/// Facets are in ascending order of cell and then of corner. Exact. Two passes over the cells. In a periodic triangulation each
/// is where deldrift_cell_shifts has its cell.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_WRONG_COUNT, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mask_boundary(const deldrift_triangulation *t,
                                       const uint8_t *mask,
                                       size_t mask_count,
                                       uint32_t *facets,
                                       uint32_t *cells,
                                       uint8_t *corners,
                                       size_t capacity,
                                       size_t *count);

/// The facets of the convex hull, in ascending order of cell and then of corner.
///
/// facets: a buffer with room for capacity rows of 2 (2D) or 3 (3D) vertex ids. Facets are seen from outside: in 2D the
/// cell is on the left of the edge from the first vertex to the second; in 3D the vertices are in counter-clockwise
/// order as seen from the side away from the cell. cells, corners: buffers with room for capacity numbers, which
/// receive the cell and which of its corners (0, 1, ...) is opposite the facet. One of the three that is NULL is not
/// filled. count: receives the number of facets, which is also written when the buffers are too small. NULL for all
/// three with capacity 0 asks for the count alone.
///
/// Exact. One pass over the cells; constant time for the count alone. A periodic triangulation has none unless its box is open
/// somewhere; to count them takes a pass over the cells.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_hull_facets(const deldrift_triangulation *t,
                                     uint32_t *facets,
                                     uint32_t *cells,
                                     uint8_t *corners,
                                     size_t capacity,
                                     size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// What segments divide the plane into: levels, labels, and boundaries in chains.
// ---------------------------------------------------------------------------------------------------------------------

/// For each cell and each of its corners the segment at the edge opposite it, in the order of deldrift_cells: the lowest id
/// if there are several, DELDRIFT_NONE if there is none. Ids are not places in the lists of deldrift_segments once segments
/// have been removed.
///
/// segments: a buffer with room for capacity rows of 3 ids. count: receives the number of cells, which is also written when
/// the buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Cost: m, and for each segment the cells around an end. After a change the first call also does what the first
/// deldrift_cells does.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_segments_of_cells(const deldrift_triangulation *t,
                                           uint32_t *segments,
                                           size_t capacity,
                                           size_t *count);

/// The cells on both sides of each segment in force, in the order of deldrift_segments.
///
/// cells: a buffer with room for capacity rows of 2 cells: that on the left of the segment, as seen from its first end
/// along it, and that on its right; DELDRIFT_NONE for the outside, and for both while there are no cells. count: receives
/// the number of segments, which is also written when the buffer is too small. NULL with capacity 0 asks for the count
/// alone.
///
/// Cost: for each segment the cells around an end. After a change the first call also does what the first deldrift_cells
/// does.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_cells_of_segments(const deldrift_triangulation *t,
                                           uint32_t *cells,
                                           size_t capacity,
                                           size_t *count);

/// The nesting level of each cell, in the order of deldrift_cells: the least number of edges with segments on a path from the
/// cell to the outside.
///
/// Cells outside of all closed chains of segments have 0, those of a domain 1, those of its holes 2, those of islands in
/// these 3, and so on: the cells of the domain are those with an odd number. A segment with one region on both sides, such
/// as a slit or an open chain, divides nothing, and several at the same edge count once. No seed is needed, and cells
/// between the domain and the convex hull have 0. A domain that is divided in parts by further segments needs
/// deldrift_label_cells: parts that do not touch the outside would have a higher level.
///
/// This is the default of deldrift_refine, as a segment is a wall, however often it has been drawn: a side that two parts
/// share, or an outline that is there twice, bounds what it would bound alone. deldrift_crossing_numbers is for chains that
/// are meant by the even-odd rule.
///
/// levels: a buffer with room for capacity numbers. count: receives the number of cells, which is also written when the
/// buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Exact. Cost: m, and for each segment the cells around an end. After a change the first call also does what the first
/// deldrift_cells does.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_nesting_levels(const deldrift_triangulation *t,
                                        uint32_t *levels,
                                        size_t capacity,
                                        size_t *count);

/// The crossing number of each cell, in the order of deldrift_cells: the least number of segments on a path from the cell to
/// the outside, where each segment at an edge counts. Cells with an odd number are those that the even-odd rule fills.
///
/// If segments form closed chains, so that an even number of them ends at each vertex, all paths from a cell cross as many
/// but for an even number: the number is odd exactly if a ray from the cell crosses an odd number of segments. So a notch that
/// is given as a second chain along a side is no part of the domain, and neither is anything if an outline is given twice;
/// with deldrift_nesting_levels, which differs only where an edge has several segments, both are. The direction in which
/// segments were given does not matter. Pieces of deldrift_stage_splits and deldrift_refine count each, as the segments do
/// that they come from. At open chains, as slits and interfaces that divide a domain, the least number decides.
///
/// numbers: a buffer with room for capacity numbers. count: receives the number of cells, which is also written when the
/// buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Exact. Cost: m, s log s for s segments, and for each segment the cells around an end. After a change the first call also
/// does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_crossing_numbers(const deldrift_triangulation *t,
                                          uint32_t *numbers,
                                          size_t capacity,
                                          size_t *count);

/// A label for each cell, in the order of deldrift_cells: that of the first seed in its region. A region is a set of cells
/// that can be reached from each other without crossing a segment.
///
/// seeds: seed_count rows of 2 coordinates; labels: as many numbers, any. Both are read during the call only, and may be
/// NULL if seed_count is 0. A seed outside of the convex hull labels nothing. other: the label of cells in whose region no
/// seed is. label_of: a buffer with room for capacity numbers. count: receives the number of cells, which is also written
/// when the buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Holes are regions, too: give their seeds a label of their own. Without segments there is one region. A seed on a segment
/// with one region on both sides is in that region. The outside of the convex hull is a region like the others, and one with
/// those from which it is reached without crossing a segment: a seed on the hull, at a segment that bounds a region or at a
/// corner of such ones, is on the boundary of two.
///
/// Exact. Cost: m, for each segment the cells around an end, and for each seed that of deldrift_locate. After a change the
/// first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_AMBIGUOUS_SEED for one that is exactly on
/// the boundary of several regions, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_label_cells(const deldrift_triangulation *t,
                                     const double *seeds,
                                     const int32_t *labels,
                                     size_t seed_count,
                                     int32_t other,
                                     int32_t *label_of,
                                     size_t capacity,
                                     size_t *count);

/// Computes the labels of some cells again, in an array that deldrift_label_cells has filled, or that is filled with
/// nesting levels: each listed cell gets the label of the cells that it is reached from without crossing a segment, and that
/// are not listed. Other entries are not touched.
///
/// cells: cell_count indices into deldrift_cells, in any order, some maybe more than once: the created ones of
/// deldrift_take_changes, and those that have been turned over. A cell that was turned over is not in the change list; its
/// row lists its corners in the opposite order, and it needs a label too: where the end of a segment goes to the other side
/// of two vertices, the cell of the three comes to be beyond the segment, though no vertex passes one. NULL if cell_count is
/// 0. other: the label of the cells outside of all closed chains of segments, along the hull: 0 for nesting levels, and for
/// labels what deldrift_label_cells was given as other, or the label of a seed there. Cells that are reached from the outside
/// of the hull alone get it, and so do those that are reached from no cell that is not listed, or from some of different
/// labels. label_of: an array of capacity numbers, of which those of cells that are not listed are read. capacity: at least
/// deldrift_cell_count. undecided: receives the number of cells of the last two kinds: if it is not 0, a region has listed
/// cells only, or touches two labels, and it is time for deldrift_label_cells.
///
/// deldrift_update_circumcentres has the steps by which an array for all cells is brought up to date. While segments stay,
/// and vertices move without passing any, labels stay with their regions: that is what deldrift_label_cells would give for
/// seeds that move with these. Where a commit adds segments, both parts of a region have its label; where it removes some
/// between regions of different labels, either label may go on: label anew then.
///
/// Exact. Cost: of k cells k log k, and k log s for s segments. After a change the first call also does what the first
/// deldrift_cells does.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_FACET for an index that is no cell's, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_update_labels(const deldrift_triangulation *t,
                                       const uint32_t *cells,
                                       size_t cell_count,
                                       int32_t other,
                                       int32_t *label_of,
                                       size_t capacity,
                                       size_t *undecided);

/// The boundary of some of the cells of the plane, in closed chains of edges, which have these cells on their left: an outer
/// boundary goes counter-clockwise, that of a hole clockwise. With the mask of the cells that have an odd nesting level it is
/// the boundary of a domain, and the markers of its segments tell what holds there.
///
/// mask: mask_count bytes, one for each cell in the order of deldrift_cells (mask_count must be deldrift_cell_count); a cell
/// is in the set if its byte is not 0. Read during the call only. Buffers with room for capacity entries, one for each edge;
/// one that is NULL is not filled. vertices: where the edge begins; it ends where the next edge of its chain begins, the last
/// one where the first of its chain does. chains: which chain it is in: 0, 1, ..., ascending. segments: the segment at it,
/// the lowest id if there are several, DELDRIFT_NONE if there is none. cells: the cell of the set beside it. corners: which
/// of its corners (0, 1, 2) is opposite. count: receives the number of edges, which is also written when the buffers are too
/// small. NULL for all with capacity 0 asks for the count alone.
///
/// No chain crosses another, or itself: where parts of the set touch in a vertex, each part has a chain of its own. Each
/// chain begins with its least edge, by the id of the vertex where an edge begins and then of that where it ends, and chains
/// are in the order of these edges. So vertices, chains and segments depend only on the set.
///
/// Exact. Cost: m, e log e for e edges, and for each segment the cells around an end. After a change the first call also
/// does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_WRONG_COUNT,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
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

/// Gives regions labels that follow them: a domain is described once, and deldrift_regions tells the label of each cell from
/// then on. A region is a set of cells that can be reached from each other without crossing a segment.
///
/// labels: a number for each cell, in the order of deldrift_cells, one for each region: those of deldrift_label_cells,
/// deldrift_nesting_levels or deldrift_crossing_numbers, or others. label_count: deldrift_cell_count. NULL and 0 take all labels
/// away. Read during the call only.
///
/// Both sides of each segment in force get the label of the cell there, DELDRIFT_NO_LABEL beyond the hull. They keep it while
/// segments move with their ends, and hand it on to the pieces that deldrift_refine, deldrift_coarsen and deldrift_stage_splits
/// make; clones, and what is saved and loaded, have it. So labels follow through all calls, as long as no vertex passes a
/// segment (see deldrift_check_passings). A segment that is added later has none: the regions on both sides keep theirs if they
/// have other segments, or are given some by deldrift_set_segment_sides. Ends no views.
///
/// Cost: m, and for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW,
/// DELDRIFT_WRONG_COUNT, DELDRIFT_INVALID_VALUE for a cell with another label than one of its region beside it,
/// DELDRIFT_PREPARED, DELDRIFT_OUT_OF_MEMORY. Not to be called at the same time as any other call on t.
deldrift_status deldrift_set_regions(deldrift_triangulation *t,
                                     const int32_t *labels,
                                     size_t label_count);

/// Gives the sides of segments labels, as deldrift_set_regions does for all by the labels of cells: for a domain that is
/// described by what is on the left and on the right of each segment, and for segments that are added to one.
///
/// segments: count ids, in force or staged; of one that is listed twice the last row counts. sides: a row of 2 labels for each:
/// on the left, as seen from its first end along it, and on the right; DELDRIFT_NO_LABEL for none. Both are read during the call
/// only, and may be NULL if count is 0. Ends no views.
///
/// Cost: count.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW,
/// DELDRIFT_NO_SUCH_SEGMENT, DELDRIFT_PREPARED; then none is changed. Not to be called at the same time as any other call
/// on t.
deldrift_status deldrift_set_segment_sides(deldrift_triangulation *t,
                                           const uint32_t *segments,
                                           const int32_t *sides,
                                           size_t count);

/// The label of the region of each cell, in the order of deldrift_cells: that of the sides of its outer boundary, which
/// deldrift_set_regions and deldrift_set_segment_sides have given; where these have none, that of the sides around islands in
/// it. So a region keeps its label when an island jumps into it, or out of it.
///
/// other: the label of cells from which the outside of the hull is reached without crossing a segment, and of undecided ones.
/// labels: a buffer with room for capacity numbers. count: receives the number of cells, which is also written when the buffer is too
/// small. NULL with capacity 0 asks for the count alone. undecided: receives the number of cells in other regions whose
/// sides have several labels, or none; may be NULL. If it is not 0, segments
/// have been added or removed, or vertices have passed segments, and it is time for deldrift_set_regions.
///
/// Exact. Cost: m, and for each segment the cells around an end. After a change the first call also does what the first
/// deldrift_cells does.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
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
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT.
deldrift_status deldrift_quality_init(deldrift_quality *quality);

/// Inserts vertices into cells of the plane, and on segments at these, until the cells there are of a quality: one commit of
/// its own, all or nothing, of which deldrift_take_changes tells what it changed. docs/SEGMENTS.md has a loop that moves,
/// commits, coarsens and refines.
///
/// quality: what is wanted. mask: mask_count bytes, one for each cell in the order of deldrift_cells (mask_count must be
/// deldrift_cell_count): cells are refined if their byte is not 0. They have to end at segments: at an edge beyond which
/// there is no cell, or one that is not refined, there has to be one. NULL with mask_count 0 for the domain (see
/// deldrift_domain): by default the cells that have an odd nesting level. Read during the call only. report: receives what was
/// done; may be NULL. Ends all views if anything was inserted or removed.
///
/// A segment that gets a vertex is removed, and pieces take its place, with its marker: see deldrift_original_segments. The
/// places of new vertices are rounded, and pieces are straight between their own ends. Cells where the quality cannot be had
/// stay: between segments at a small angle, at segments that stay whole, and where there is no room for a vertex. The report
/// tells how many.
///
/// After a deldrift_coarsen it may make the mesh anew, where that has fewer vertices by a factor (see growth): then it removes
/// vertices that it has inserted, too, in its one commit.
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
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW,
/// DELDRIFT_INVALID_OPTIONS for struct_size, keeps and domain, DELDRIFT_WRONG_COUNT, DELDRIFT_INVALID_VALUE for a number of
/// quality that has no meaning, those for deldrift_coarsen included, and for a mask that does not end at segments,
/// DELDRIFT_UNDECIDED_REGIONS where the labels of regions are used: for the domain, and for areas without labels of cells,
/// DELDRIFT_STAGED_VERTEX if anything is staged, DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY,
/// DELDRIFT_CANCELLED, and DELDRIFT_ON_SEGMENT and DELDRIFT_CROSSING where pieces that are bent by rounding would touch
/// others (see deldrift_segment_conflicts). Not to be called at the same time as any other call on t.
deldrift_status deldrift_refine(deldrift_triangulation *t,
                                const deldrift_quality *quality,
                                const uint8_t *mask,
                                size_t mask_count,
                                deldrift_quality_report *report);

/// Removes vertices that deldrift_refine has inserted and that are not needed any more: those around which the cells would
/// still be of the quality, by a margin. Pieces of a segment are joined again. One commit of its own, all or nothing, of
/// which deldrift_take_changes tells what it changed.
///
/// The arguments are those of deldrift_refine. has_weights, limit and reuses_ids of the quality are not used; keeps says
/// what it would do.
///
/// Around cells that are of lower quality already, those that come may have angles as small: call it before deldrift_refine,
/// which then has less to insert. Ids of the vertices that stay are as they were, and so are values by id: one pass after
/// deldrift_refine carries them over both, see deldrift_refined_weights.
///
/// Cost: that of deldrift_refine where all is good, and for each vertex that deldrift_refine has inserted, and around
/// which cells are others than at the last call, or at segments, at most that of looking at these. Where no place,
/// cell or segment has changed since this call has found nothing to remove with these numbers: comparing mask, labels
/// and sizes.
///
/// Errors: those of deldrift_refine: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT,
/// DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_OPTIONS for struct_size, keeps and domain,
/// DELDRIFT_WRONG_COUNT, DELDRIFT_INVALID_VALUE, DELDRIFT_UNDECIDED_REGIONS, DELDRIFT_STAGED_VERTEX, DELDRIFT_TOO_MANY_CELLS,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED,
/// DELDRIFT_ON_SEGMENT and DELDRIFT_CROSSING. Not to be called at the same time as any other call on t.
deldrift_status deldrift_coarsen(deldrift_triangulation *t,
                                 const deldrift_quality *quality,
                                 const uint8_t *mask,
                                 size_t mask_count,
                                 deldrift_quality_report *report);

/// The vertices that deldrift_refine has inserted and that are present, ascending by id.
///
/// vertices: a buffer with room for capacity ids; segments: for as many: the segment that the vertex was put on, by the id
/// that it had before it was split, DELDRIFT_NONE if there is none. One that is NULL is not filled. count: receives the
/// number of vertices, which is also written when the buffers are too small. NULL for both with capacity 0 asks for the
/// count alone.
///
/// Cost: the vertices inserted so far.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_made_vertices(const deldrift_triangulation *t,
                                       uint32_t *vertices,
                                       uint32_t *segments,
                                       size_t capacity,
                                       size_t *count);

/// For each segment in force, in the order of deldrift_segments, the id of the segment that the program staged and of which
/// deldrift_stage_splits or deldrift_refine has made it a piece; its own id if it is whole. That segment is not in force any
/// more, or, where it was split before it was made, has never been.
///
/// originals: a buffer with room for capacity ids. count: receives the number of segments, which is also written when the
/// buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Cost: of s segments in force s log s.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_original_segments(const deldrift_triangulation *t,
                                           uint32_t *originals,
                                           size_t capacity,
                                           size_t *count);

/// For each vertex that the last deldrift_refine inserted, in the order of their ids, how linear values there follow from
/// those at the vertices before: the sum of the values of three vertices by their weights. So
///
///   value(new(k)) = sum of weights(3 k + i) * value(vertices(3 k + i)) for i = 0, 1, 2
///
/// carries values at vertices over, where new(k) is what deldrift_refined_vertices tells, or, without reuses_ids,
/// id_count - inserted + k. Those on the right may have been removed by the call, which has not given their ids again, and
/// by no deldrift_coarsen before it: one pass with values from before both carries them over both. It has to have been
/// called with has_weights, and neither a commit nor a compaction must have come since; otherwise there are none.
///
/// vertices: a buffer with room for capacity rows of 3 ids, those of the corners of the cell that the vertex was put into;
/// on a segment, or an edge, its two ends, the first one twice. weights: for as many rows of 3 numbers, from 0 to 1,
/// with a sum of 1 but for rounding. One that is NULL is not filled. count: receives the number of vertices, which is
/// also written when the buffers are too small. NULL for both with capacity 0 asks for the count alone.
///
/// Cost: the vertices inserted.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_refined_weights(const deldrift_triangulation *t,
                                         uint32_t *vertices,
                                         double *weights,
                                         size_t capacity,
                                         size_t *count);

/// For each vertex that the last deldrift_refine inserted, in the order of their ids, the greatest length of edges that it had
/// there, from those given in quality.sizes at the vertices before. With these by id, behind the others unless reuses_ids
/// was set, a second call finds nothing to do. It has to have been called with sizes, and neither a commit nor a
/// compaction must have come since; otherwise there are none.
///
/// sizes: a buffer with room for capacity numbers. count: receives the number of vertices, which is also written when the
/// buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Cost: the vertices inserted.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_refined_sizes(const deldrift_triangulation *t,
                                       double *sizes,
                                       size_t capacity,
                                       size_t *count);

/// The vertices that the last deldrift_refine inserted, ascending by id: those of which deldrift_refined_weights and
/// deldrift_refined_sizes tell, in this order. Neither a commit nor a compaction must have come since; otherwise there are
/// none.
///
/// vertices: a buffer with room for capacity ids. count: receives the number of vertices, which is also written when the
/// buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Cost: the vertices inserted.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_refined_vertices(const deldrift_triangulation *t,
                                          uint32_t *vertices,
                                          size_t capacity,
                                          size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// What meets what: edges, neighbours and cells of vertices, mirror indices, ordered stars.
// ---------------------------------------------------------------------------------------------------------------------

/// The edges: rows of two vertex ids, the lower one first, each edge once, in lexicographic order. They are a
/// function of positions and ids alone.
///
/// edges: a buffer with room for capacity rows. count: receives the number of edges, which is also written when the
/// buffer is too small. NULL with capacity 0 asks for the count alone, in constant time.
///
/// Takes some passes over the cells, and memory for the cells of each vertex while it runs.
///
/// Cost: n + m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_edges(const deldrift_triangulation *t,
                               uint32_t *edges,
                               size_t capacity,
                               size_t *count);

/// The neighbours of all vertices: for each id the vertices with which it shares an edge, ascending, one list after
/// the other. Removed and hidden vertices have none. They are a function of positions and ids alone.
///
/// offsets: a buffer for offset_count numbers, which must be deldrift_id_count + 1: the list of vertex v is in
/// neighbours from the index that is entry v of offsets on, and ends before entry v + 1. neighbours: a buffer with room
/// for capacity ids. One that is NULL is not filled, and its size not looked at, but capacity must be 0 then. count:
/// receives the number of entries, twice that of the edges, which is also written when neighbours is too small. NULL
/// for both asks for the count alone, in constant time.
///
/// Of a periodic triangulation a vertex is listed once for each edge that leads to it: several times where edges lead to it
/// in several periods, and itself twice for each edge to itself.
///
/// Takes some passes over the cells, and while it runs memory for the lists and for the cells of each vertex.
///
/// Cost: n + m, and d log d for the d neighbours of each vertex; m log m for a periodic triangulation. After a change the first
/// call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_WRONG_COUNT, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_vertex_neighbours(const deldrift_triangulation *t,
                                           uint32_t *offsets,
                                           size_t offset_count,
                                           uint32_t *neighbours,
                                           size_t capacity,
                                           size_t *count);

/// The cells of all vertices: for each id the indices of the cells that have it as a corner, ascending, one list
/// after the other. Removed and hidden vertices have none.
///
/// offsets: a buffer for offset_count numbers, which must be deldrift_id_count + 1: the list of vertex v is in cells
/// from the index that is entry v of offsets on, and ends before entry v + 1. cells: a buffer with room for capacity
/// indices. One that is NULL is not filled, and its size not looked at, but capacity must be 0 then. count: receives
/// the number of entries, 3 (2D) or 4 (3D) times that of the cells, which is also written when cells is too small. NULL
/// for both asks for the count alone, in constant time.
///
/// Of a periodic triangulation a cell is listed once for each of its corners that is the vertex, in whatever period.
///
/// Takes two passes over the cells, and memory for the lists while it runs.
///
/// Cost: n + m; m log m for a periodic triangulation. After a change the first call also does what the first deldrift_cells
/// does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_WRONG_COUNT, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_vertex_cells(const deldrift_triangulation *t,
                                      uint32_t *offsets,
                                      size_t offset_count,
                                      uint32_t *cells,
                                      size_t capacity,
                                      size_t *count);

/// A cell of each vertex, to cells: for each id the index of the first cell of which the vertex is a corner;
/// DELDRIFT_NONE for those that are hidden or removed, whose insertion is staged, and while there are no cells.
///
/// cells: a buffer with room for capacity indices. count: receives deldrift_id_count, which is also written when the
/// buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Cost: n + m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_cell_of_each_vertex(const deldrift_triangulation *t,
                                             uint32_t *cells,
                                             size_t capacity,
                                             size_t *count);

/// Cells that have given vertices as corners, to cells: for each of count simplices the index of one, DELDRIFT_NONE if
/// there is none. So it tells which edges of a list are in the triangulation, and which facets.
///
/// corners_per_simplex: 1 (a cell of each vertex), 2 (edges), 3 (triangles) or, in 3D, 4. vertices: count rows of as
/// many ids, in any order; NULL if count is 0. A hidden vertex stands for the one that represents it. A simplex with
/// two corners at the same place is in no cell. cells: receives count indices; NULL if count is 0.
///
/// Cost: for each simplex the least number of cells that a corner of it has, or, where there are more simplices than an
/// eighth of the vertices, n + m and that. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_VALUE for
/// another number of corners, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX,
/// DELDRIFT_OUT_OF_MEMORY; then nothing is written.
deldrift_status deldrift_find_simplices(const deldrift_triangulation *t,
                                        uint32_t corners_per_simplex,
                                        const uint32_t *vertices,
                                        size_t count,
                                        uint32_t *cells);

/// The mirror indices of all facets: entry i of the row of a cell, in the order of deldrift_cells, is about the facet
/// opposite corner i. It is the corner (0, 1, ...) of the neighbour beyond that is opposite the same facet, 255 on
/// the hull. In a periodic triangulation a cell may be its own neighbour.
///
/// mirrors: a buffer with room for capacity rows of 3 (2D) or 4 (3D) bytes. count: receives the number of cells, which
/// is also written when the buffer is too small. NULL with capacity 0 asks for the count alone.
///
/// Cost: m. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mirror_indices(const deldrift_triangulation *t,
                                        uint8_t *mirrors,
                                        size_t capacity,
                                        size_t *count);

/// The mirror index of one facet, to *mirror: the corner of the neighbour beyond that is opposite the same facet;
/// DELDRIFT_NONE for a facet of the hull.
///
/// cell, corner: the facet opposite this corner (0, 1, ...) of this cell, an index into deldrift_cells.
///
/// Cost: constant. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NO_SUCH_FACET, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mirror_index(const deldrift_triangulation *t,
                                      uint32_t cell,
                                      uint32_t corner,
                                      uint32_t *mirror);

/// The star of a vertex of the plane in the order in which one goes around it: the indices of the cells that have it
/// as a corner, counter-clockwise. Each shares an edge with the next one, and the last one with the first one, unless
/// the vertex is on the convex hull. There the first cell is the one at the hull's edge that leaves the vertex when
/// the hull is passed counter-clockwise; elsewhere it is the one of lowest index. For a hidden vertex the star of its
/// representative.
///
/// cells: a buffer with room for capacity indices. count: receives their number, which is also written when the buffer
/// is too small. NULL with capacity 0 asks for the count alone.
///
/// Cost: the cells of the star. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_ordered_star(const deldrift_triangulation *t,
                                      uint32_t vertex,
                                      uint32_t *cells,
                                      size_t capacity,
                                      size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Geometry of some of the cells: those around vertices, and entries of arrays that a program keeps for all cells.
// ---------------------------------------------------------------------------------------------------------------------

/// The cells around some vertices: the indices of those of which at least one of the vertices is a corner, ascending,
/// each once.
///
/// vertices: vertex_count ids, in any order, some maybe more than once; hidden vertices have no cells. NULL if
/// vertex_count is 0. cells: a buffer with room for capacity indices; deldrift_cell_count is always enough. count:
/// receives the number of indices, which is also written when the buffer is too small. NULL with capacity 0 asks for
/// the count alone, which takes as long.
///
/// After a commit, the cells around the vertices that have moved and those that deldrift_take_changes lists as created
/// are all whose shape has changed: with the functions that follow, a program that keeps an array for all cells updates
/// those entries alone.
///
/// Cost: the cells of the stars, and k log k for the k of them; m at most, and for a periodic triangulation. After a change the
/// first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_VERTEX,
/// DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_cells_around(const deldrift_triangulation *t,
                                      const uint32_t *vertices,
                                      size_t vertex_count,
                                      uint32_t *cells,
                                      size_t capacity,
                                      size_t *count);

/// Computes circumcentres and squared circumradii of some cells again, in arrays that deldrift_circumcentres has
/// filled: for each index in cells, the entry of this index becomes that of the cell. Other entries are not touched.
///
/// cells: cell_count indices into deldrift_cells, in any order, some maybe more than once. NULL if cell_count is 0.
/// centres: an array with room for capacity points. squared_radii: an array with room for capacity numbers. One that
/// is NULL is not filled, but not both. capacity: at least deldrift_cell_count.
///
/// After a change an array for all cells is brought up to date in three steps: its entries follow renumbered cells as
/// deldrift_changes says; then this is called for the created cells; and then for those that deldrift_cells_around
/// gives for the vertices that have moved. The values are then those of deldrift_circumcentres, with the same accuracy.
/// Their last bits may be others where a cell was removed and created again in between, as they depend on the order in
/// which the library keeps its corners. It pays while fewer than a tenth of the vertices move, or a third if they are
/// neighbours; beyond that the pass of deldrift_circumcentres is faster.
///
/// Cost: cell_count. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_FACET for an
/// index that is no cell's, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_update_circumcentres(const deldrift_triangulation *t,
                                              const uint32_t *cells,
                                              size_t cell_count,
                                              double *centres,
                                              double *squared_radii,
                                              size_t capacity);

/// Computes the areas (2D) or volumes (3D) of some cells again, in an array that deldrift_volumes has filled: for each
/// index in cells, the entry of this index becomes that of the cell. Other entries are not touched.
///
/// cells: cell_count indices into deldrift_cells, in any order, some maybe more than once. NULL if cell_count is 0.
/// volumes: an array with room for capacity numbers. capacity: at least deldrift_cell_count.
///
/// deldrift_update_circumcentres has the steps by which an array for all cells is brought up to date, and when that
/// pays. The values are then those of deldrift_volumes, with its accuracy; last bits may be others where a cell was
/// removed and created again.
///
/// Cost: cell_count. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_FACET for an
/// index that is no cell's, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_update_volumes(const deldrift_triangulation *t,
                                        const uint32_t *cells,
                                        size_t cell_count,
                                        double *volumes,
                                        size_t capacity);

/// Decides for some cells again whether their circumradius is at most a given one, in a mask that
/// deldrift_mask_by_circumradius has filled for the same one: for each index in cells, the entry of this index becomes
/// that of the cell. Other entries are not touched.
///
/// cells: cell_count indices into deldrift_cells, in any order, some maybe more than once. NULL if cell_count is 0.
/// squared_radius: 0 or more; infinity is all cells. mask: an array with room for capacity bytes. capacity: at least
/// deldrift_cell_count.
///
/// deldrift_update_circumcentres has the steps by which an array for all cells is brought up to date, and when that
/// pays.
///
/// Exact: a mask that is kept up to date is that of a full pass, byte by byte.
///
/// Cost: cell_count. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_VALUE for a
/// squared radius that is negative or NaN, DELDRIFT_NO_SUCH_FACET for an index that is no cell's,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_update_mask_by_circumradius(const deldrift_triangulation *t,
                                                     const uint32_t *cells,
                                                     size_t cell_count,
                                                     double squared_radius,
                                                     uint8_t *mask,
                                                     size_t capacity);

// ---------------------------------------------------------------------------------------------------------------------
// Voronoi cells and facets, clipped by a box, or by half-spaces besides.
// ---------------------------------------------------------------------------------------------------------------------

/// The areas (2D) or volumes (3D) of the Voronoi cells of all ids, within a box.
///
/// low, high: the corners of the box with the least and the greatest coordinates, 2 or 3 numbers each, read during the
/// call only; vertices may be outside of it. NULL for both is no box: then the Voronoi cells of the vertices on the
/// convex hull are infinite. volumes: a buffer with room for capacity numbers. count: receives the number of ids, which
/// is also written when the buffer is too small. NULL for volumes with capacity 0 asks for the count alone.
///
/// NaN is for removed vertices only. A hidden vertex has 0: the one of lowest id at its place has the
/// cell. Vertices in one hyperplane, a single one included, have cells too, though deldrift_cells has none: in a box
/// what of it is nearest to each; without one these are infinite. What is beyond the range of numbers, or has a corner
/// there, is infinite.
///
/// Rounded: in a box, let h be 1e-8 times its greatest extent and 1e-15 times the greatest magnitude of its
/// coordinates; without a box, 1e-8 times the greatest circumradius of the cells around the vertex and 1e-15 times the
/// greatest magnitude of a coordinate of their circumcentres. A corner of a Voronoi cell is off by at most h, and so,
/// to first order in h, is a volume by at most h times the area of the cell's surface, or two thirds of that of the
/// triangles that the vertex makes with its edges if that is more, as it may be for cells with dozens of facets; an area
/// by at most h times its perimeter, however near to each other vertices are. In place of 1e-8 it is some last bits, about
/// 1e-15, unless cells are nearly flat (see deldrift_circumcentres). Never negative. The volumes of all ids add up to that of
/// the box but for rounding.
///
/// The volumes are those of deldrift_voronoi_cells, to the last bit. In a periodic triangulation low and high are as they are
/// there. With NULL for both, cells without an end, as there are where the triangulation is open in some direction, are
/// infinite.
///
/// Takes time in proportion to the number of cells, and of ids; in a box, for Voronoi cells at its boundary, to the
/// number of corners of their facets as well, a microsecond (2D) or some (3D) for each such cell of ordinary sets.
/// Where a circumcentre nearly is in a face of the box, microseconds for each, as that is decided exactly. Takes memory
/// for circumcentres and sums, and for the cells of each vertex that is cut, while it runs. For vertices in one hyperplane,
/// in a box, it takes the time and the memory of creating a triangulation of these. Runs on several threads, as the options
/// allow. Calls the callbacks of the options.
///
/// Cost: n + m; in a box, for vertices in one hyperplane, that of deldrift_create. After a change the first call also
/// does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT (also if one of low and high is NULL), DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE if high is not above low in every coordinate, or if the
/// box is not one that repeats, or not bounded across the vectors, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY,
/// DELDRIFT_CANCELLED.
deldrift_status deldrift_voronoi_volumes(const deldrift_triangulation *t,
                                         const double *low,
                                         const double *high,
                                         double *volumes,
                                         size_t capacity,
                                         size_t *count);

/// The lengths (2D) or areas (3D) of the Voronoi facets of all edges, in the order of deldrift_edges, within a box.
/// The Voronoi facet of an edge is what the Voronoi cells of its two vertices share.
///
/// low, high: the corners of the box with the least and the greatest coordinates, 2 or 3 numbers each, read during the
/// call only; vertices may be outside of it. NULL for both is no box. Without a box, the Voronoi facets of the edges on
/// the convex hull are infinite. measures: a buffer with room for capacity numbers. count: receives the number of
/// edges, which is also written when the buffer is too small. NULL for measures with capacity 0 asks for the count
/// alone.
///
/// There is one number for each edge of the triangulation, so vertices in one hyperplane have none; each is the measure
/// of what both cells share, whichever of the two it is seen from. It is never NaN, and infinite where a corner is
/// beyond the range of numbers. Edges that exist only by tie-breaking have a facet of measure 0, up to rounding: of
/// vertices on an empty circle or sphere; those of them that have no edge share no more than that. A facet outside the box
/// has 0. One that is in a face of the box counts as inside.
///
/// Rounded: with the h that deldrift_voronoi_volumes has, of the cells around the edge, a length is off by at most 2 h,
/// an area by at most h times the perimeter of the facet, however near to each other vertices are. Never negative. The
/// facets of a vertex whose Voronoi cell is in the box, times the lengths of its edges and divided by 4 (2D) or 6 (3D),
/// add up to its area or volume but for rounding.
///
/// The measures are those of deldrift_voronoi_derivatives, to the last bit. In a periodic triangulation low and high are as
/// deldrift_voronoi_cells has them. Of several edges between two vertices each has the facet of its own, and one that leads from
/// a vertex to itself has the facet that two periods of its cell share.
///
/// Takes time in proportion to the number of cells, and memory for circumcentres, facets and the cells of each vertex while
/// it runs. What is cut by the box, and is nearly in a face of it, takes as long as in deldrift_voronoi_volumes. Runs on
/// several threads, as the options allow. Calls the callbacks of the options.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_NULL_ARGUMENT (also if one of low and high is NULL), DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_voronoi_facets(const deldrift_triangulation *t,
                                        const double *low,
                                        const double *high,
                                        double *measures,
                                        size_t capacity,
                                        size_t *count);

/// The Voronoi cells of all ids within a box, for programs that need them at every step: areas (2D) or volumes (3D),
/// boundaries and centroids, in one pass over the cells, however many vertices have moved. A program that needs their facets
/// as well gets both from deldrift_voronoi_cells_and_facets.
///
/// low, high: the corners of the box with the least and the greatest coordinates, 2 or 3 numbers each, read during the call
/// only; vertices may be outside of it. NULL for both is no box. mask, mask_count: a byte for each id, mask_count of them,
/// which must be deldrift_id_count; only entries of vertices of which the byte is not 0 are computed and written, and the
/// others are left as they are. NULL and 0 for all vertices. deldrift_voronoi_changed makes a mask of the cells that have
/// changed. The numbers of a vertex do not depend on the mask, nor on the number of threads that compute them, to the last
/// bit. They are sums in the order of the cells, which a build on several threads may have in another one.
///
/// volumes: a buffer with room for capacity numbers. areas: a buffer with room for as many; receives the length (2D) or area
/// (3D) of the boundary of what there is of each cell in the box, with what it has of the faces of the box. centroids: a buffer
/// with room for capacity rows of 2 or 3 coordinates. One that is NULL is not filled. count: receives the number of ids, which
/// is also written when the buffers are too small. NULL for all three with capacity 0 asks for the count alone.
///
/// A removed vertex has NaN, a hidden one volume and area 0; a centroid is NaN where the volume is 0 or infinite, and nothing
/// else is. Vertices in one hyperplane, a single one included, have cells too, as in deldrift_voronoi_volumes. Without a box
/// the cells of vertices on the convex hull have volume and area infinite. Segments are not looked at.
///
/// Rounded: let h be what deldrift_voronoi_volumes has for a box, or without one, and S, T, V and d the area of a cell's
/// surface, that of the triangles that the vertex makes with its edges, its volume and its diameter. To first order in h, a
/// volume is off by at most h times the greater of S and 2/3 T, which is less unless a cell has dozens of facets (2D: h
/// times the length of the boundary), an area by h times the sum of the perimeters of the cell's faces (2D: 2 h for each),
/// and a centroid, where that is less than d, by that error of the volume times d / V, and without a box by the rounding of
/// its coordinates besides; it is in the box in any case. The volumes of all ids add up to that of the box but for
/// rounding.
///
/// In a periodic triangulation low and high are walls, which repeat with it: they must be -infinity and infinity along each
/// axis along which a vector goes, so that both are infinite, or NULL, where vectors span all directions. Along other axes they
/// are finite, unless half-spaces (deldrift_voronoi_cells_within) bound what is left. Let the box that repeats be the least one
/// that has all places of the container which are up to 1.5 of each reduced vector away from the unit cell, with low and high
/// as faces; with the h of this box numbers are off as in the open, and the volumes add up to that of one period of the
/// container. NULL for low and high cuts nothing: then a cell without an end, as there are where the triangulation is open in
/// some direction, has volume and area infinite, and its centroid is NaN; h is the one that deldrift_voronoi_volumes has
/// without a box. A centroid is where the vertex is at its own position, in whatever period that is, and off by the rounding of
/// its coordinates besides. The numbers do not depend on the periods in which positions are given nor on copies that the
/// library keeps, but for rounding; with the same cells in the same order they are the same to the last bit.
///
/// Takes memory for circumcentres, for sums, and, where cells are cut by the box, for the cells of each vertex while it
/// runs. Runs on several threads, as the options allow. Cells that are cut take several times as long as others. Calls
/// the callbacks of the options.
///
/// Cost: n + m; with a mask, a byte for each id, a bit for each cell, and the cells around vertices of the mask; for
/// vertices in one hyperplane, that of deldrift_create. After a change the first call also does what the first
/// deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_INVALID_VALUE if high is not above low in every coordinate, or if the box is not one that repeats, or not bounded
/// across the vectors, DELDRIFT_WRONG_COUNT, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_voronoi_cells(const deldrift_triangulation *t,
                                       const double *low,
                                       const double *high,
                                       const uint8_t *mask,
                                       size_t mask_count,
                                       double *volumes,
                                       double *areas,
                                       double *centroids,
                                       size_t capacity,
                                       size_t *count);

/// The Voronoi cells of all ids within a box and half-spaces, as deldrift_voronoi_cells has them within a box: for
/// containers with oblique walls, as hoppers, wedges, boxes that are turned, and polygons that approximate a cylinder.
///
/// low, high, mask, mask_count, volumes, areas, centroids, capacity, count: as deldrift_voronoi_cells has them.
/// half_spaces: half_space_count rows of 3 (2D) or 4 (3D) numbers, read during the call only: an outward normal, of any
/// length, and an offset. The half-space is the set of the places x with normal · x at most the offset. NULL if there are
/// none. The box is needed besides, unless there are none; one around the container does. Vertices may be outside of box and
/// half-spaces.
///
/// What there is of a cell in the box and all half-spaces is convex. Areas include what it has of the faces of the
/// box and of the planes. Where nothing of a cell is left, or of the box, volume and area are 0 and the centroid is NaN.
/// Half-spaces may be equal, opposite, touch cells at corners or along faces, or leave nothing.
///
/// Rounded: let h be what deldrift_voronoi_volumes has for a box, with 3e-15 in place of 1e-15. Unlike the faces of the
/// box, planes are not exact: a corner within h of one may be taken as inside or as beyond. With this h the errors are those of
/// deldrift_voronoi_cells; what is left of a cell or of the box, and is thinner than 2 h, may have any area up to that of
/// its boundary. The volumes of all ids add up to that of the box in the half-spaces, but for rounding. Numbers depend
/// neither on the mask nor on the number of threads, to the last bit; without half-spaces they are those of
/// deldrift_voronoi_cells.
///
/// In a periodic triangulation the product of each normal and each of the vectors that deldrift_vectors tells must be 0,
/// exactly, so that the half-space repeats as well: along axes along which no vector goes normals may have any entries. What
/// low, high and half-spaces leave must be bounded across the vectors; NULL for low and high is a box that is infinite along
/// all axes.
///
/// A cell that is in all half-spaces takes little longer than in deldrift_voronoi_cells, as circumcentres are
/// compared with the half-spaces nearby alone. One that is cut takes some microseconds, and some nanoseconds for each
/// half-space. One thread computes those that are cut. Takes memory for half-spaces, and for lists of those nearby.
///
/// Cost: n + m, and half_space_count for each cell that is cut; otherwise that of deldrift_voronoi_cells. In a periodic
/// triangulation that is open in two directions also the square of half_space_count.
///
/// Errors: those of deldrift_voronoi_cells: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE (also for a normal or an offset), DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_INVALID_VALUE (also if a normal is zero, or one of a periodic triangulation has a product with a vector that is not
/// 0), DELDRIFT_WRONG_COUNT, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_voronoi_cells_within(const deldrift_triangulation *t,
                                              const double *low,
                                              const double *high,
                                              const double *half_spaces,
                                              size_t half_space_count,
                                              const uint8_t *mask,
                                              size_t mask_count,
                                              double *volumes,
                                              double *areas,
                                              double *centroids,
                                              size_t capacity,
                                              size_t *count);

/// The Voronoi facets of all edges within a box, in the order of deldrift_edges: lengths (2D) or areas (3D), centroids,
/// and the derivatives of the areas or volumes on their sides by positions.
///
/// low, high, mask, mask_count: as deldrift_voronoi_cells has them; only entries of edges that have an end of which the
/// byte is not 0 are computed and written.
///
/// measures: a buffer with room for capacity numbers. centroids: a buffer with room for capacity rows of 2 or 3
/// coordinates. derivatives: a buffer with room for capacity rows of 4 or 6 numbers: for the edge of the vertices i and
/// j the derivative of the area or volume of the cell of i by the position of j, and then that of the cell of j by the
/// position of i. One that is NULL is not filled. count: receives the number of edges, which is also written when the
/// buffers are too small. NULL for all three with capacity 0 asks for the count alone.
///
/// With the measure A and the centroid c of the facet, and the distance L of the vertices at x_i and x_j, the first
/// derivative is A (x_j - c) / L, the second one A (x_i - c) / L. The derivative of the volume of a cell by the position
/// of its own vertex is minus the sum, over the edges of that, of the derivatives of the other cells by that position,
/// as all fill the box, which stays. Where cells come to touch or to part, derivatives are still continuous, as A is 0
/// there.
///
/// A centroid is NaN where nothing of the facet is in the box or its measure is 0; measures and derivatives are 0 there.
/// Derivatives are infinite where the quotient is beyond the range of numbers. There is one entry for each edge of the
/// triangulation, as in deldrift_voronoi_facets, and none for vertices in one hyperplane.
///
/// Without a box, facets of edges on the convex hull have an infinite measure, and NaN for the rest; so have others of which a
/// corner is beyond the range of numbers.
///
/// Rounded: let h be what deldrift_voronoi_volumes has for a box, or without one, P the perimeter of a facet (2D: 2), d its
/// diameter. A measure is off by at most h P, a centroid by h P d / A, and by d + h where A is less than 4 h P; a
/// derivative by h P (d + |x - c|) / L, where x is the position by which it is.
///
/// In a periodic triangulation low and high are walls, as deldrift_voronoi_cells has them, with its h; or NULL, with the h that
/// deldrift_voronoi_volumes has without a box, of the cells around the edge. Then a facet without an end has an infinite
/// measure, and NaN for the rest. A centroid is where the first vertex of the edge is at its own position, and off by the
/// rounding of its coordinates besides; the second vertex is where deldrift_edge_shifts has it. The derivatives of an edge are
/// those by the position of one of its ends alone. As all periods of a vertex move, the derivative of the volume of the cell of
/// i by the position of j is the sum over the edges between i and j, and that by its own position is minus the sum of the
/// derivatives of the other cells by that position, over its edges to other vertices: an edge from a vertex to itself
/// contributes nothing, as its facet moves along with all of the cell.
///
/// Takes memory for circumcentres, edges and the cells of each vertex while it runs. What is cut by the box, and facets
/// narrower than 1e-7 of it, take about a microsecond each. Calls the callbacks of the options.
///
/// Cost: n + m, and d log d for the d neighbours of each vertex. After a change the first call also does what the first
/// deldrift_cells does.
///
/// Errors: those of deldrift_voronoi_cells: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE, DELDRIFT_WRONG_COUNT, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_voronoi_derivatives(const deldrift_triangulation *t,
                                             const double *low,
                                             const double *high,
                                             const uint8_t *mask,
                                             size_t mask_count,
                                             double *measures,
                                             double *centroids,
                                             double *derivatives,
                                             size_t capacity,
                                             size_t *count);

/// The Voronoi facets of all edges within a box and half-spaces, with derivatives, as deldrift_voronoi_derivatives has
/// them within a box.
///
/// low, high, mask, mask_count, measures, centroids, derivatives, capacity, count: as deldrift_voronoi_derivatives has
/// them. half_spaces, half_space_count: as deldrift_voronoi_cells_within has them, in a periodic triangulation as well. Box and
/// half-spaces stay where they are when vertices move, so that the sums of derivatives are as in a box.
///
/// Rounded: with the h of deldrift_voronoi_cells_within the errors are those of deldrift_voronoi_derivatives; for a facet that
/// a plane cuts divided by the sine of the angle between both. A facet that is in a plane, but for h, may be there or not.
///
/// Takes memory for half-spaces besides, and for lists of those nearby. A facet that is cut takes about a microsecond,
/// and some nanoseconds for each half-space.
///
/// Cost: n + m, and half_space_count for each facet that is cut; otherwise that of deldrift_voronoi_derivatives. In a periodic
/// triangulation that is open in two directions also the square of half_space_count.
///
/// Errors: those of deldrift_voronoi_cells_within: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE, DELDRIFT_WRONG_COUNT,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_voronoi_derivatives_within(const deldrift_triangulation *t,
                                                    const double *low,
                                                    const double *high,
                                                    const double *half_spaces,
                                                    size_t half_space_count,
                                                    const uint8_t *mask,
                                                    size_t mask_count,
                                                    double *measures,
                                                    double *centroids,
                                                    double *derivatives,
                                                    size_t capacity,
                                                    size_t *count);

/// Voronoi cells and facets in one call, any of their numbers: those of deldrift_voronoi_cells_within and
/// deldrift_voronoi_derivatives_within, to the last bit, with circumcentres computed and compared with box and half-spaces once.
///
/// low, high, half_spaces, half_space_count, mask, mask_count: as these functions have them; NULL for low and high is no box.
/// volumes, areas, centroids, capacity, count: as deldrift_voronoi_cells has them. measures, facet_centroids, derivatives,
/// edge_capacity, edge_count: as deldrift_voronoi_derivatives has them. One that is NULL is neither filled nor computed: with
/// NULL for measures, facet_centroids and derivatives, and edge_capacity 0, this takes as long as deldrift_voronoi_cells_within,
/// and with NULL for volumes, areas and centroids, and capacity 0, as long as deldrift_voronoi_derivatives_within. count and
/// edge_count receive the numbers of ids and of edges in any case, also when buffers of either kind are too small.
///
/// Cost: that of both functions, without the circumcentres of one of them.
///
/// Errors: those of deldrift_voronoi_cells_within: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT,
/// DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE, DELDRIFT_WRONG_COUNT,
/// DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_voronoi_cells_and_facets(const deldrift_triangulation *t,
                                                  const double *low,
                                                  const double *high,
                                                  const double *half_spaces,
                                                  size_t half_space_count,
                                                  const uint8_t *mask,
                                                  size_t mask_count,
                                                  double *volumes,
                                                  double *areas,
                                                  double *centroids,
                                                  size_t capacity,
                                                  size_t *count,
                                                  double *measures,
                                                  double *facet_centroids,
                                                  double *derivatives,
                                                  size_t edge_capacity,
                                                  size_t *edge_count);

/// Marks the vertices whose Voronoi cell has changed, or may have: a mask for deldrift_voronoi_cells, so that a step costs
/// what has changed.
///
/// vertices: vertex_count ids of those that have moved since the deldrift_take_changes before the last one, in any order,
/// some maybe more than once; NULL if there are none. To be called after deldrift_take_changes, before the next
/// change. mask: a buffer with room for capacity bytes; receives, for each id, 1 if the vertex has moved, shares a cell with
/// one that has, or is in the star of the changes that were taken last, hidden, shown, a corner of a renumbered cell, or has
/// been removed; 0 for all others. count: receives the number of ids, which is also written when the buffer is too small. NULL
/// with capacity 0 asks for the count alone.
///
/// A program keeps arrays of deldrift_voronoi_cells for a box. It moves vertices, commits, takes the changes, and calls
/// this and then deldrift_voronoi_cells with the mask. If changes are taken after every commit, its arrays are those of a
/// call without a mask, to the last bit; otherwise they are so within the errors documented, as cells that have come
/// back meanwhile may list their corners in another order. All are marked where nothing is known of single cells: if changes
/// have not been taken since the last change or since deldrift_compact, while all vertices are in one hyperplane, and where
/// there are segments.
///
/// In a periodic triangulation arrays are those of a call without a mask within the errors documented, as copies that the
/// library keeps may be others; and all are marked where the vectors are others than when changes were taken before.
///
/// Cost: a byte for each id; the changes taken, and the cells around the moved vertices, of k cells k log k.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_VERTEX,
/// DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_voronoi_changed(const deldrift_triangulation *t,
                                         const uint32_t *vertices,
                                         size_t vertex_count,
                                         uint8_t *mask,
                                         size_t capacity,
                                         size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Periodic triangulations: their creation, and what only they have.
// ---------------------------------------------------------------------------------------------------------------------

/// Creates the Delaunay triangulation of points that repeat: each is in all places to which sums of multiples of the
/// vectors take it.
///
/// dimension: 2 or 3. positions, count: as in deldrift_create; a position may be in any period. vectors: vector_count rows
/// of dimension numbers, the vectors of the box: 1 to dimension of them. They need not be orthogonal nor short, so that a
/// triclinic box, or one that is skewed by any number of its lengths, is legal. Directions that they do not span are open.
/// options: as in deldrift_create, but for coincidence, which must be DELDRIFT_COINCIDENCE_MERGE: vertices that are at the same
/// place in any period share it, and the one of the lowest id represents it. out: receives the triangulation, which the caller
/// has to hand to deldrift_destroy.
///
/// The cells are those of all the places at once, of which one of each class of translations of each other is told. Any
/// number of vertices is legal, one included: a cell may have a vertex in several periods, and be its own neighbour. The
/// cells do not depend on the periods in which positions are given, on which vectors of the same lattice are given, or on what
/// happened before. deldrift_cell_shifts tells in which period each corner is.
///
/// Positions and vectors are rounded to a grid, along axes along which a vector goes: its step is a power of two, so that all
/// coordinates that are calculated with have at most 53 binary digits. In a box whose reduced vectors (the shortest of its
/// lattice) have lengths up to L and are not flatter than a cube, the step is at most 2^-45 L, and mostly 2^-47 L; a position
/// moves by half of that at most, and so does each reduced vector. The step depends on the lattice alone, whichever of its
/// vectors are given. deldrift_copy_positions and deldrift_vectors tell what is used, to the last bit: for these positions
/// and vectors the cells are exact, and they are kept as they are when they are given again, here or to
/// deldrift_stage_vectors and deldrift_commit_positions. A vector of many times L may have no 53 digits as a sum of the
/// rounded reduced ones: then the vectors that are given are rounded to the grid instead. Entries of vectors may be up to
/// 1e50 in magnitude, and are 0 or at least 1e-50; positions may be some 1e13 L away, and less far in a box that is skewed by
/// more than a thousand of its lengths: so far that periods are counted by numbers of 64 bits. Where vectors go along more
/// axes than there are vectors, as one that is along no axis does, the step is 2^10 times that, and positions may be some 500
/// L away across the vectors, else they are out of range. Vectors that on their grid depend on each other, or nearly so, are
/// refused.
///
/// All functions serve a periodic triangulation but those of segments, refinement, keys, reach, and a few others, which
/// return DELDRIFT_PERIODIC: deldrift_stage_insertions_with_keys, deldrift_stage_insertions_at_free_ids,
/// deldrift_insert_vertex_with_key, deldrift_keys, deldrift_stage_segments, deldrift_stage_segment_removals,
/// deldrift_segments, deldrift_check_staged, deldrift_segment_conflicts, deldrift_check_passings, deldrift_passings,
/// deldrift_stage_splits, deldrift_release_cells, deldrift_tolerance, deldrift_cells_in_reach,
/// deldrift_hull_facets_in_reach, deldrift_vertices_in_reach, deldrift_mask_without_flat_cells,
/// deldrift_segments_of_cells, deldrift_cells_of_segments, deldrift_nesting_levels, deldrift_crossing_numbers,
/// deldrift_label_cells, deldrift_update_labels, deldrift_set_regions, deldrift_set_segment_sides, deldrift_regions,
/// deldrift_boundary_chains, deldrift_refine, deldrift_coarsen, deldrift_made_vertices, deldrift_original_segments,
/// deldrift_refined_weights, deldrift_refined_sizes, deldrift_refined_vertices, deldrift_find_simplices and
/// deldrift_ordered_star. Cells are numbered anew by each commit, unless changes are taken.
///
/// Cost: that of deldrift_create, of some n + c n^(1/2) vertices in 2D and n + c n^(2/3) in 3D. In the mean a commit of moves,
/// or of other vectors that are near those in force, costs what it costs in an open triangulation of as many, and reading the
/// cells after it n + m; each insertion and removal costs what it changes. One with more of these than a tenth of the vertices,
/// or where a vertex has drifted far out of the box since the last such commit, costs as much as creation.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_INVALID_OPTIONS, DELDRIFT_NULL_ARGUMENT,
/// DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_INVALID_VALUE, DELDRIFT_DEPENDENT_VECTORS, DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. May be called from any number of threads at once.
deldrift_status deldrift_create_periodic(uint32_t dimension,
                                         const double *positions,
                                         size_t count,
                                         const double *vectors,
                                         size_t vector_count,
                                         const deldrift_options *options,
                                         deldrift_triangulation **out);

/// Stages other vectors for the box: strain, shear, or others of the same lattice. The next commit, with positions or
/// moves or without, makes them those of the triangulation.
///
/// vectors, vector_count: as many as deldrift_create_periodic was given; none, vector_count being 0, for a triangulation
/// that is not periodic. Vertices that do not move stay at their positions: a program that deforms its box with all that
/// is in it gives the positions, too. Vectors that are staged already are forgotten. deldrift_discard_moves discards them.
///
/// Cost: constant. The commit costs as much as one of moves of all vertices, as long as the vectors lead to a lattice that is
/// near the one in force, whichever vectors of it are given: a box that is strained or sheared in small steps costs a creation
/// once for each strain of about 1.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT,
/// DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE, DELDRIFT_DEPENDENT_VECTORS, DELDRIFT_OUT_OF_MEMORY.
/// Not to be called at the same time as any other call on t.
deldrift_status deldrift_stage_vectors(deldrift_triangulation *t,
                                       const double *vectors,
                                       size_t vector_count);

/// The vectors by which the triangulation repeats: those that were given, on the grid of deldrift_create_periodic.
///
/// vectors: receives rows of 2 (2D) or 3 (3D) numbers: a buffer with room for capacity rows; NULL with capacity 0 asks for
/// the count alone. count: receives their number, 0 for a triangulation that is not periodic; it is also written when the
/// buffer is too small.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_vectors(const deldrift_triangulation *t,
                                 double *vectors,
                                 size_t capacity,
                                 size_t *count);

/// The shortest vectors of the lattice, which deldrift_wrap_positions translates by: a reduced basis of it.
///
/// vectors: receives rows of 2 (2D) or 3 (3D) numbers. multiples: receives as many rows of whole numbers, the multiples of the
/// vectors that were given whose sum each one is. greatest: receives a number for each: where vertices are at positions that
/// deldrift_wrap_positions gives, no edge spans more than entry j of greatest times vector j, and the place to which it leads is
/// calculated without rounding. All are buffers with room for capacity vectors; one
/// that is NULL is not filled. count: receives their number, 0 for a triangulation that is not periodic; it is also written
/// when the buffers are too small. NULL for all with capacity 0 asks for the count alone.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_reduced_vectors(const deldrift_triangulation *t,
                                         double *vectors,
                                         int64_t *multiples,
                                         uint32_t *greatest,
                                         size_t capacity,
                                         size_t *count);

/// Takes positions into the box: each to its place in the unit cell of deldrift_reduced_vectors, on the grid of
/// deldrift_create_periodic, which is where the triangulation would have it.
///
/// positions: count points, in any period; they need not be those of vertices, and the triangulation may have none. previous:
/// NULL, or count points, where the vertices have been: each keeps its
/// period, the one that is nearest to its entry, while it is at most a quarter of the unit cell outside of it, so that a vertex
/// does not flip back and forth at a face. places: receives count
/// points. shifts: receives count rows of 2 (2D) or 3 (3D) whole numbers: by which multiples of the vectors that were given the
/// position is translated from its place, 0 beyond the last of these.
///
/// Where the triangulation is not periodic, places are the positions, and shifts 0.
///
/// Cost: count.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_wrap_positions(const deldrift_triangulation *t,
                                        const double *positions,
                                        const double *previous,
                                        size_t count,
                                        double *places,
                                        int64_t *shifts);

/// In which period each corner of each cell is, and each neighbour.
///
/// shifts: receives a row of 2 (2D) or 3 (3D) whole numbers for each of the 3 or 4 corners of each cell, in the order of
/// deldrift_cells: multiples of the vectors, 0 beyond the last of these. The corner is at its position and the sum of these
/// multiples. The corner of the lowest id is at its position (if the vertex is there more than once, the first of these
/// corners by x, y, z).
/// neighbour_shifts: receives as many rows: those of the neighbour opposite the corner, by which it is to be translated from
/// where its own shifts have it, to share the facet; 0 on the hull.
/// Both are buffers with room for capacity cells; one that is NULL is not filled. count: receives the number of cells, which
/// is also written when the buffers are too small. NULL for both with capacity 0 asks for the count alone.
///
/// All are 0 where the triangulation is not periodic.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_cell_shifts(const deldrift_triangulation *t,
                                     int64_t *shifts,
                                     int64_t *neighbour_shifts,
                                     size_t capacity,
                                     size_t *count);

/// In which period the second vertex of each edge is, in the order of deldrift_edges.
///
/// Of a periodic triangulation deldrift_edges tells one of each class of translations of each other, the lower id first. An
/// edge may lead from a vertex to itself in another period, and two vertices may have several edges.
/// shifts: receives a row of 2 (2D) or 3 (3D) whole numbers for each edge, multiples of the vectors, 0 beyond the last of
/// these: from the position of the first vertex the edge leads to that of the second and the sum of these multiples. A
/// buffer with room for capacity edges; NULL with capacity 0 asks for the count alone. count: receives the number of edges,
/// which is also written when the buffer is too small.
///
/// All are 0 where the triangulation is not periodic.
///
/// Cost: n + m, and d log d for the d neighbours of each vertex.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_edge_shifts(const deldrift_triangulation *t,
                                     int64_t *shifts,
                                     size_t capacity,
                                     size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Values between vertices.
// ---------------------------------------------------------------------------------------------------------------------

/// Interpolates values of the vertices at count positions.
///
/// values: value_count rows of n_values numbers, one for each id (value_count must be deldrift_id_count); rows of
/// removed and hidden vertices are not used: it is that of the representative that counts. positions: 2 or 3 numbers
/// each. All are read during the call only. hint: where to begin to look for the first position, as for
/// deldrift_locate_points; NULL if nothing is known. It is fastest if each position is near the one before it. outside:
/// what positions outside the convex hull get, n_values numbers; NULL for NaN. While there are no cells, all positions
/// but those of vertices are outside. results: receives count rows of n_values numbers. values may be NULL if
/// value_count or n_values is 0, positions and results if count is 0.
///
/// At the place of a vertex the result is that of the vertex. Elsewhere it is rounded, and linear functions are
/// reproduced but for rounding, with either method. Which cell or which neighbours count is decided exactly. A position
/// takes as long as deldrift_locate_points, and with natural neighbours some microseconds more.
///
/// In a periodic triangulation positions may be in any period, and are rounded as for deldrift_locate. An image of a
/// vertex has the values of the vertex; natural neighbours of a position are images, several of one vertex in a small box.
///
/// Cost: count times that of deldrift_locate and n_values; with natural neighbours also the cells whose circle or
/// sphere has the position inside. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_VALUE for a
/// method that this version does not have, DELDRIFT_WRONG_COUNT, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE (of
/// positions), DELDRIFT_OUT_OF_MEMORY; then nothing is written.
deldrift_status deldrift_interpolate(const deldrift_triangulation *t,
                                     deldrift_interpolation method,
                                     const double *values,
                                     size_t value_count,
                                     size_t n_values,
                                     const double *positions,
                                     size_t count,
                                     const deldrift_location *hint,
                                     const double *outside,
                                     double *results);

/// The barycentric coordinates of count positions, each in a cell that is given: rows of 3 (2D) or 4 (3D) numbers, one
/// for each corner in the order of deldrift_cells. They are for programs that keep weights, to carry values with them
/// more than once; deldrift_interpolate has others of its own, which may differ in last bits, and more where a cell is
/// flat.
///
/// positions: 2 or 3 numbers each. cells: count indices into deldrift_cells, as deldrift_locate_points gives them;
/// DELDRIFT_NONE is no cell, for which the row is NaN. Both are read during the call only. weights: receives count
/// rows. All may be NULL if count is 0. A position may be outside of its cell: then some of its coordinates are
/// negative.
///
/// The sign of each is exact, and so is 0; the value has a relative error of at most 2.5e-13, however flat the cell.
/// (Where an area, a volume or the value itself is below the least normal number, 2.2e-308, it is less accurate.) What
/// is beyond the range of numbers is infinite. A row adds up to 1 but for these errors.
///
/// In a periodic triangulation positions may be in any period, and are rounded as for deldrift_locate. The weights are
/// those in the translation of the cell that has the position inside or on its boundary; where there is none, the row is NaN.
///
/// Cost: count. After a change the first call also does what the first deldrift_cells does.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_NO_SUCH_FACET if there is no cell of an index, DELDRIFT_OUT_OF_MEMORY; then nothing
/// is written.
deldrift_status deldrift_barycentric(const deldrift_triangulation *t,
                                     const double *positions,
                                     const uint32_t *cells,
                                     size_t count,
                                     double *weights);

// ---------------------------------------------------------------------------------------------------------------------
// A triangulation as bytes, in memory or in a file, and a second one like it.
// ---------------------------------------------------------------------------------------------------------------------

/// Makes an independent triangulation that is as this one, to *out, which the caller has to hand to
/// deldrift_destroy; it is written on success only.
///
/// Positions, ids, segments, cells with their indices, hidden vertices, staged moves, insertions and removals, the timestamp,
/// statistics, options, the changes that deldrift_take_changes has not given yet, and what the algorithm keeps between
/// commits are those of t, and so are the vectors of a periodic one, also those that are staged: after the same calls both have
/// the same cells. The callbacks of the options are called for either, so what user_data points to must live as long as both.
/// Views, and changes that have been taken, belong to t alone.
///
/// Takes a pass over the memory of t, and as much memory again; nothing is triangulated. If deldrift_cells has been
/// called before, this also does what the next deldrift_cells would do.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_clone(const deldrift_triangulation *t,
                               deldrift_triangulation **out);

/// Saves the triangulation: writes bytes from which deldrift_load makes one like it, on this machine or any other.
///
/// Saved are positions, ids, segments, removed and hidden vertices, cells with their indices, staged moves, insertions and
/// removals, the timestamp and statistics. Not saved are the options, what the algorithm keeps between commits,
/// which changes have been taken, the answers of deldrift_refined_weights, deldrift_refined_sizes and
/// deldrift_refined_vertices, and what deldrift_segment_conflicts and deldrift_passings tell. docs/FORMAT.md describes
/// the bytes. Of a periodic triangulation the vectors as deldrift_vectors tells them, those that are staged, and the
/// periods of vertices are saved, too, and all images with their cells.
///
/// buffer: room for capacity bytes, with any alignment. count: receives the number of bytes, which is also written
/// when the buffer is too small. NULL with capacity 0 asks for the count alone, in constant time.
///
/// Takes a pass over what is saved, and does what deldrift_cells does.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_BUFFER_TOO_SMALL,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_save(const deldrift_triangulation *t,
                              void *buffer,
                              size_t capacity,
                              size_t *count);

/// Makes a triangulation of bytes that deldrift_save has written, to *out, which the caller has to hand to
/// deldrift_destroy; it is written on success only.
///
/// The triangulation is as the one that was saved, cells with their indices included (but where it is periodic and changes
/// had been taken of it), and gives the same cells after the same calls; those cells that are new then may have other
/// indices. It has given no changes yet: the first deldrift_take_changes lists all cells as created. Like one whose cells
/// have been read, it keeps the arrays of deldrift_cells.
///
/// data: size bytes, with any alignment, read during the call only. options: they are not
/// saved; NULL stands for the defaults, whatever those of the triangulation that was saved. The callbacks are called.
///
/// Nothing is triangulated: takes a sort of the vertices and a few passes over the data, and memory for at most 16
/// times as many bytes. This holds whatever the data are: what is not a Delaunay triangulation, exactly, is refused,
/// even if the checksum is right.
///
/// Data of a periodic triangulation give one. Its images count as vertices: all that is in the data is checked, and that no
/// image is missing. Where cells do not tell that at once, as after some commits, it takes a copy of the triangulation, into
/// which images are inserted: as long as creation, and as much memory, at most, with data of any kind.
///
/// Cost: n log n + m, whatever the data are; of a periodic one that of creation at most.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_OPTIONS (also if
/// the options reject coincidence and the data are of a periodic one),
/// DELDRIFT_INVALID_DATA, DELDRIFT_COINCIDENT (if vertices are hidden and the options reject it),
/// DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. May be called from
/// any number of threads at once.
deldrift_status deldrift_load(const void *data,
                              size_t size,
                              const deldrift_options *options,
                              deldrift_triangulation **out);

/// Saves the triangulation to a file, as deldrift_save does.
///
/// path: of a file that is made, or replaced. The bytes go to a new file in the same folder, which takes the place of
/// the old one when it is complete and stored, so that after a failure or a crash there is either; only if the process
/// is killed the new file may be left behind. A file that is replaced keeps its mode, and its owner, group and POSIX
/// access control list where the system allows that; where it does not, nobody is allowed more than before. Other
/// attributes are not kept. A symbolic link is replaced itself, and another hard link keeps what it has. A device or a
/// pipe is written at once, and what is full is waited for; a named pipe that nobody reads is refused.
///
/// A pipe that is no longer read, and the limit on the size of files, are errors like any other: SIGPIPE and SIGXFSZ of
/// these writes do not reach the process, whose handlers stay as they are.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_IO_ERROR, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_save_file(const deldrift_triangulation *t,
                                   const char *path);

/// Makes a triangulation of a file that deldrift_save_file has written, to *out, as deldrift_load does.
///
/// Its header is read first, and the rest only if that is right and the file as long as it says; it is read as a whole
/// then, so that memory for it is needed during the call, too. Pipes, devices, sockets and directories are refused with
/// DELDRIFT_IO_ERROR.
///
/// Cost: that of deldrift_load.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_INVALID_OPTIONS, DELDRIFT_IO_ERROR,
/// DELDRIFT_INVALID_DATA, DELDRIFT_COINCIDENT, DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. May be called from any number of threads at once.
deldrift_status deldrift_load_file(const char *path,
                                   const deldrift_options *options,
                                   deldrift_triangulation **out);

/// Writes a file for ParaView and VTK: an unstructured grid of the cells, in VTK's XML format (.vtu).
///
/// Its points are the vertices that are present, hidden ones included, ascending by id; their ids are the point data
/// "vertex". In 2D the third coordinate is 0. Its cells are those of deldrift_cells, in that order. path: of a file
/// that is made, or replaced once the new one is complete, with what deldrift_save_file says of it.
///
/// If there are segments in force, those of deldrift_segments are lines behind these cells, in that order; an end that
/// is hidden is the vertex that represents it. Their markers are the cell data "marker", which is 0 for cells that are
/// no lines, and cell_fields are NaN for lines.
///
/// Of a periodic triangulation the cells are together as deldrift_cell_shifts has them. A vertex is a point for each period
/// in which a cell has it, ascending by id and by these shifts, all with its id and its numbers of fields; one that no cell
/// has is a point at its position.
///
/// vertex_fields, cell_fields: numbers to be written along as point data and cell data, vertex_field_count and
/// cell_field_count of them; NULL if the count is 0. All of it is read during the call only.
///
/// Does what deldrift_cells does.
///
/// Cost: n + m, and the numbers of the fields; m log m for a periodic triangulation.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_FIELD,
/// DELDRIFT_IO_ERROR, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_write_vtu(const deldrift_triangulation *t,
                                   const char *path,
                                   const deldrift_field *vertex_fields,
                                   size_t vertex_field_count,
                                   const deldrift_field *cell_fields,
                                   size_t cell_field_count);

/// Writes a file for Mmg, FreeFem, Gmsh and others: MEDIT's text format (.mesh).
///
/// Its vertices are those that are present, hidden ones included, ascending by id and numbered from 1; the reference
/// of each is its id. Its triangles or tetrahedra are the cells, in the order of deldrift_cells. If there are segments in
/// force, those of deldrift_segments are its edges, in that order, behind the triangles; the reference of each is its
/// marker, and an end that is hidden is the vertex that represents it. Reading the numbers gives the same doubles. Of a
/// periodic triangulation a vertex is there once for each period in which a cell has it, as in deldrift_write_vtu.
///
/// references: reference_count numbers, the reference of each cell in the order of deldrift_cells (reference_count must
/// be deldrift_cell_count), such as those of deldrift_label_cells; NULL with reference_count 0 for 1. They are read
/// during the call only. path: of a file that is made, or replaced once the new one is complete,
/// with what deldrift_save_file says of it.
///
/// Does what deldrift_cells does.
///
/// Cost: n + m; m log m for a periodic triangulation.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_WRONG_COUNT, DELDRIFT_IO_ERROR,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_write_medit(const deldrift_triangulation *t,
                                     const char *path,
                                     const int32_t *references,
                                     size_t reference_count);

// ---------------------------------------------------------------------------------------------------------------------
// Exact signs for points of the caller's own. They need no triangulation.
// ---------------------------------------------------------------------------------------------------------------------

/// The orientation of points, exactly, to *sign: 1, -1 or 0.
///
/// dimension: 2 or 3. points: dimension + 1 points, one after the other, 2 or 3 numbers each. Of 3 points in the
/// plane it is 1 if they are in counter-clockwise order, -1 if they are in clockwise order, and 0 on a line. Of 4
/// points a, b, c, d in space it is the sign of the determinant of the rows b - a, c - a, d - a, and 0 on a plane.
/// The cells of a triangulation have orientation 1. With another point in the place of a corner it tells on which
/// side of the opposite facet that point lies: 1 on the side of the cell, 0 on the facet's line or plane.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE. Constant time, some nanoseconds except close to 0. May be called from any number of threads
/// at once.
deldrift_status deldrift_orientation(uint32_t dimension,
                                     const double *points,
                                     int32_t *sign);

/// Whether a point is inside the circle or sphere through others, exactly, to *sign: 1 inside, -1 outside, 0 on it.
///
/// dimension: 2 or 3. points: dimension + 2 points, one after the other, 2 or 3 numbers each: those that the circle or
/// sphere goes through, of orientation 1 (deldrift_orientation), and the one that is asked about. If their orientation
/// is
/// -1, the sign is the opposite one. If it is 0 there is no circle or sphere, and the sign has no meaning. Ties are not
/// broken.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE. May be called from any number of threads at once.
deldrift_status deldrift_in_sphere(uint32_t dimension,
                                   const double *points,
                                   int32_t *sign);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif // DELDRIFT_H
