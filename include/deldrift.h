/*
 * deldrift: exact Delaunay triangulations of moving points, in 2D and 3D.
 *
 * Made by `make header` from ffi-tests/header/first_page.h: change it there.
 *
 * A triangulation is created once from an array of points. Vertex i is the i-th point, until deldrift_compact gives new
 * ids. Then the points move: stage the moves, commit them as the next timestamp, read the cells. After every commit the
 * cells are exactly those of the Delaunay triangulation of the current positions. Ties (cocircular and cospherical
 * points) are broken by vertex id, so the cells depend only on positions and ids. A program can give keys that break
 * them instead (deldrift_create_with_keys). In 2D edges can be prescribed: with segments (deldrift_stage_segments) the
 * triangulation is the constrained Delaunay triangulation.
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
 * Compile and link: `cc program.c $(pkg-config --cflags --libs deldrift)`, or in CMake `find_package(deldrift)` and
 * `target_link_libraries(program deldrift::deldrift)`. C++ programs may use deldrift.hpp, which wraps this header.
 *
 * This header includes the following ones. Each can be included alone, and begins with an index of its functions:
 *
 *     deldrift/core.h: What every program needs: statuses, options, creation, positions and cells.
 *         What a call says when it ends: status codes, the message of the last failure, the version.
 *         Options: a structure that can grow, read as far as the caller's header knows it.
 *         Creation, destruction, and what is chosen for the whole life of a triangulation.
 *         What a triangulation holds: counts, and the positions of vertices.
 *         Queries: cells, and what is where. None changes the triangulation.
 *     deldrift/motion.h: Vertices that move, come and go: staging, commits, keys, the list of changes.
 *         Motion: what is staged, and becomes a timestamp.
 *         Commits in two phases.
 *         Changes that take effect at once, one vertex at a time; and new ids.
 *         Keys of vertices, which break ties in place of ids, and ids that are given again.
 *         The change list: what a program has to know that keeps something for each cell.
 *         Conservative transfer of means in cells.
 *     deldrift/read.h: What is where, and what is near: location, neighbours, values between vertices.
 *         Where points lie, and which vertices are near.
 *         What is near a place: the nearest vertices, those in a ball or a box, the cells that a new vertex would
 *             remove.
 *         The cells, hull facets and vertices that a vertex in a box could change.
 *         What meets what: edges, neighbours and cells of vertices, mirror indices, ordered stars.
 *         Values between vertices.
 *     deldrift/geometry.h: Circumspheres, volumes, masks and boundaries of cells; exact signs.
 *         Geometry of the cells: circumspheres, volumes, masks by circumradius, and the facets around a mask.
 *         Geometry of some of the cells: those around vertices, and entries of arrays that a program keeps for all
 *             cells.
 *         Exact signs for points of the caller's own. They need no triangulation.
 *     deldrift/voronoi.h: Voronoi cells and facets, in a box or a container.
 *         Voronoi cells and facets, clipped by a box, or by half-spaces besides.
 *     deldrift/segments.h: Segments in the plane, the domains that they bound, and the refinement of these.
 *         Segments between vertices of the plane, which have to be edges.
 *         Segments that are split where they are in the way of each other.
 *         What segments divide the plane into: levels, labels, and boundaries in chains.
 *         Labels of regions that follow: the sides of segments keep them.
 *         Refinement and coarsening of the cells of a domain.
 *     deldrift/periodic.h: Periodic boxes.
 *         Periodic triangulations: their creation, and what only they have.
 *     deldrift/weights.h: Vertices with weights: regular triangulations.
 *         Triangulations of vertices with weights: their creation, and what only they have.
 *     deldrift/files.h: Copies, saved data, and files for other programs.
 *         A triangulation as bytes, in memory or in a file, and a second one like it.
 *
 * The rest of this page has the rules that hold for all functions. What they say is not repeated with each function.
 *
 * Arrays. Points are contiguous: x0 y0 x1 y1 ... in 2D, x0 y0 z0 x1 ... in 3D. A position is 2 or 3 numbers. Counts and
 * capacities are in points, vertices or cells, never in numbers or bytes. Arrays that are passed in are read during the
 * call and not kept. An array that a call writes must not overlap with any other of its arrays.
 *
 * Pointers. A pointer must be aligned for its type and lead to as many elements as the count says. NULL is accepted if
 * the count is 0, and where the documentation says so. What a pointer leads to cannot be checked. It is a duty of the
 * program that arrays are as long as their counts say, that strings end in a NUL, and that what is handed over has not
 * been freed or destroyed.
 *
 * Buffers. A function that gives a list takes buffers with room for `capacity` entries, and writes the number of
 * entries to *count. If the room is too small it returns DELDRIFT_BUFFER_TOO_SMALL, and writes the count alone. NULL
 * for all buffers with capacity 0 asks for the count alone, which may take as long; NULL for all with another capacity
 * is DELDRIFT_NULL_ARGUMENT. Of several buffers, one that is NULL is not filled.
 *
 * Staging. A vertex whose insertion is staged has an id, but is not present before the commit. Functions that take its
 * id return DELDRIFT_STAGED_VERTEX. In arrays by id that a call fills, its entry is that of a removed vertex, except in
 * deldrift_copy_positions. In positions by id that you pass, its entry is where the vertex will be inserted. A vertex
 * whose removal is staged is present until the commit. It cannot be moved by that commit, nor removed by it twice.
 *
 * Errors. Functions return a deldrift_status; DELDRIFT_OK is 0. A call that fails has no effect: all that can be asked
 * about the triangulation is as it was, and so is what is staged. Outputs are not written, except the count of a buffer
 * that is too small. A failed call may still end views and keep memory that it has reserved, which
 * deldrift_memory_bytes tells. deldrift_last_error gives the details. Nothing is printed, and no exception leaves the
 * library. The documentation of a function names its errors, except these:
 *
 *     DELDRIFT_NULL_ARGUMENT, DELDRIFT_MISALIGNED_ARGUMENT   of functions that take pointers
 *     DELDRIFT_BUFFER_TOO_SMALL                              of functions that take a capacity
 *     DELDRIFT_BUSY                                          of functions that take a triangulation, if they are called
 *                                                            from a callback of a call on the same one
 *     DELDRIFT_POISONED, DELDRIFT_INTERNAL_ERROR             of functions that take a triangulation
 *     DELDRIFT_PERIODIC                                      see below
 *
 * Costs. "Cost:" says how the time of a call grows: n stands for the number of ids, m for that of cells. m is below 2 n
 * in 2D. In 3D it is about 6.8 n for points spread evenly, and n² / 2 at most. After a change, the first call that
 * reads cells also does what the first deldrift_cells does; its cost is named without that. docs/COSTS.md has what has
 * been measured, on sets of points that are hard. Memory is in proportion to n + m.
 *
 * Ownership. A triangulation that deldrift_create or another function has made must be given to deldrift_destroy, once.
 * Strings belong to the library. Views (deldrift_cells_view, deldrift_changes) belong to the triangulation. They end
 * with the next call that takes it as non-const, or with its destruction. There are two exceptions:
 * deldrift_cells_view says which calls change no cells, and deldrift_release_cells gives views that outlive any call.
 *
 * Threads. Functions that take `const deldrift_triangulation *` may run on the same triangulation from any number of
 * threads at once. Those that take it as non-const change it, and no other call on it may run meanwhile. Functions that
 * take no triangulation may be called from any number of threads at once. Different triangulations are independent, and
 * none is bound to a thread. Errors are kept per thread. Where more threads pay, the library starts some of its own and
 * keeps them (see deldrift_options). They handle no signals. A process that is forked off, between calls, has the
 * triangulations but not these threads, and starts its own. dlclose and exit end them.
 *
 * Callbacks. Functions that name DELDRIFT_CANCELLED among their errors call the callbacks of the options, and no others
 * do. deldrift_options says what callbacks may do.
 *
 * Periodic boxes. A position that is handed to a periodic triangulation may be in any period, and is rounded to the
 * grid of deldrift_create_periodic, as a vertex would be. Functions that do not serve such a triangulation return
 * DELDRIFT_PERIODIC: deldrift_create_periodic names them. Functions that tell of its cells may return
 * DELDRIFT_OUT_OF_MEMORY.
 *
 * Floating point. Every function does, and gives, what it does in the default floating-point environment, whatever that
 * of the caller is: its rounding, its traps, and numbers near zero that count as zero. The caller's environment stays as
 * it is, the flags of exceptions included. Callbacks run in the caller's environment; what they change there stays
 * changed. This is so on x86-64, by MXCSR, and on 64-bit ARM. On other processors calls must come from the default
 * environment. Inline code of deldrift.hpp and deldrift/cgal.hpp is compiled as a part of the program, and does its
 * arithmetic in the environment of the program.
 *
 * Stack. A call takes at most 80 KiB of the stack of its thread, however many points there are and whatever their
 * coordinates, if the library is compiled with any optimisation. So 128 KiB, as threads of musl have by default, are
 * enough for a call without callbacks. The library's own threads have 2 MiB of address space each, of which they use no
 * more than a call does.
 */

#ifndef DELDRIFT_H
#define DELDRIFT_H

#include "deldrift/core.h"
#include "deldrift/motion.h"
#include "deldrift/read.h"
#include "deldrift/geometry.h"
#include "deldrift/voronoi.h"
#include "deldrift/segments.h"
#include "deldrift/periodic.h"
#include "deldrift/weights.h"
#include "deldrift/files.h"

#endif // DELDRIFT_H
