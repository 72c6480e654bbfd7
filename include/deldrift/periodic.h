/*
 * deldrift/periodic.h: Periodic boxes.
 *
 * A part of deldrift.h, the first page of which has the rules that hold for all functions.
 *
 * Made by `make header` from these files of src/capi: periodic.rs. Change it there.
 *
 * Periodic triangulations: their creation, and what only they have.
 *
 *     deldrift_create_periodic: Creates the Delaunay triangulation of points that repeat.
 *     deldrift_create_periodic_weighted: Creates the regular triangulation of points with weights that repeat:
 *         deldrift_create_periodic for vertices with weights, as deldrift_create_weighted has them.
 *     deldrift_stage_vectors: Stages other vectors for the box: strain, shear, or others of the same lattice.
 *     deldrift_vectors: The vectors by which the triangulation repeats: those that were given, on the grid of
 *         deldrift_create_periodic.
 *     deldrift_reduced_vectors: The shortest vectors of the lattice, a reduced basis of it.
 *     deldrift_wrap_positions: Takes positions into the box, each to its place in the unit cell of
 *         deldrift_reduced_vectors, on the grid of deldrift_create_periodic.
 *     deldrift_cell_shifts: In which period each corner of each cell is, and each neighbour.
 *     deldrift_edge_shifts: In which period the second vertex of each edge is, in the order of deldrift_edges.
 */

#ifndef DELDRIFT_PERIODIC_H
#define DELDRIFT_PERIODIC_H

#include "core.h"

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// ---------------------------------------------------------------------------------------------------------------------
// Periodic triangulations: their creation, and what only they have.
// ---------------------------------------------------------------------------------------------------------------------

/// Creates the Delaunay triangulation of points that repeat. Each is in all places to which sums of multiples of the
/// vectors take it.
///
/// dimension: 2 or 3. positions, count: as in deldrift_create; a position may be in any period. vectors: vector_count
/// rows of dimension numbers, the vectors of the box: 1 to dimension of them. They need not be orthogonal nor short: a
/// triclinic box, or one that is skewed by any number of its lengths, is legal. Directions that they do not span are
/// open. options: as in deldrift_create, except that coincidence must be DELDRIFT_COINCIDENCE_MERGE. Vertices that are
/// at the same place in any period share it, and the one of the lowest id represents it. out: receives the
/// triangulation.
///
/// The cells are those of all the places at once. Of cells that are translations of each other one is told. Any number
/// of vertices is legal, one included: a cell may have a vertex in several periods, and be its own neighbour. The cells
/// do not depend on the periods in which positions are given, on which vectors of the same lattice are given, or on
/// what happened before. deldrift_cell_shifts tells in which period each corner is.
///
/// Positions and vectors are rounded to a grid, along axes along which a vector goes. Its step is a power of two, so
/// that all coordinates that are calculated with have at most 53 binary digits. In a box whose reduced vectors (the
/// shortest of its lattice) have lengths up to L and are not flatter than a cube, the step is at most 2^-45 L, and
/// mostly 2^-47 L. A position moves by half of that at most, and so does each reduced vector. The step depends on the
/// lattice alone, whichever of its vectors are given. deldrift_copy_positions and deldrift_vectors tell what is used,
/// to the last bit. For these positions and vectors the cells are exact. They are kept as they are when they are given
/// again, here or to deldrift_stage_vectors and deldrift_commit_positions. A vector of many times L may have no 53
/// digits as a sum of the rounded reduced ones: then the vectors that are given are rounded to the grid instead.
/// Entries of vectors may be up to 1e50 in magnitude, and are 0 or at least 1e-50. Positions may be some 1e13 L away,
/// so far that 64 bits still count the periods, and less far in a box that is skewed by more than a thousand of its
/// lengths. Where vectors go along more axes than there are vectors, as one that is along no axis does, the step is
/// 2^10 times that. Then positions may be some 500 L away across the vectors, else they are out of range. Vectors that
/// on their grid depend on each other, or nearly so, are refused.
///
/// All functions serve a periodic triangulation but those of deldrift/segments.h and the following, which return
/// DELDRIFT_PERIODIC: deldrift_stage_insertions_with_keys, deldrift_stage_insertions_at_free_ids,
/// deldrift_insert_vertex_with_key, deldrift_keys, deldrift_cells_in_reach, deldrift_hull_facets_in_reach and
/// deldrift_vertices_in_reach. Cells are numbered anew by each commit, unless changes are taken.
///
/// Cost: that of deldrift_create, of some n + c n^(1/2) vertices in 2D and n + c n^(2/3) in 3D. In the mean a commit of
/// moves, or of other vectors that are near those in force, costs what it costs in an open triangulation of as many,
/// and reading the cells after it n + m. Each insertion and removal costs what it changes. A commit with more of these
/// than a tenth of the vertices, or where a vertex has drifted far out of the box since the last such commit, costs as
/// much as creation.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_INVALID_OPTIONS, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE, DELDRIFT_DEPENDENT_VECTORS, DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_create_periodic(uint32_t dimension,
                                         const double *positions,
                                         size_t count,
                                         const double *vectors,
                                         size_t vector_count,
                                         const deldrift_options *options,
                                         deldrift_triangulation **out);

/// Creates the regular triangulation of points with weights that repeat: deldrift_create_periodic for vertices with
/// weights, as deldrift_create_weighted has them.
///
/// weights: count numbers, or NULL: then all are 0. Each is finite and at most 1e114 in magnitude, and may be negative.
/// Weights are not rounded to the grid, and may be as far apart as they like: one heavy vertex may hide all others, whose
/// cells are then its own in several periods. All else is as in deldrift_create_periodic.
///
/// Of vertices at one place in any period that of the greatest weight represents the place; of these the one of the lowest
/// id. deldrift_hidden_by_weight and deldrift_hidden_vertices tell who is hidden.
///
/// The functions that serve such a triangulation are those that serve a periodic one and one with weights.
/// deldrift_nearest_vertices looks at all vertices for each position.
///
/// Cost: that of deldrift_create_periodic. A commit looks at all cells at home where weights hide vertices.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_INVALID_OPTIONS, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE, DELDRIFT_DEPENDENT_VECTORS, DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_create_periodic_weighted(uint32_t dimension,
                                                  const double *positions,
                                                  const double *weights,
                                                  size_t count,
                                                  const double *vectors,
                                                  size_t vector_count,
                                                  const deldrift_options *options,
                                                  deldrift_triangulation **out);

/// Stages other vectors for the box: strain, shear, or others of the same lattice. The next commit, with or without
/// moves, makes them those of the triangulation.
///
/// vectors, vector_count: as many as deldrift_create_periodic was given; none, vector_count being 0, for a
/// triangulation that is not periodic. Vertices that do not move stay at their positions. So a program that deforms its
/// box with all that is in it gives the positions, too. Vectors that are staged already are replaced.
/// deldrift_discard_moves discards them.
///
/// Cost: constant. The commit costs as much as one of moves of all vertices, as long as the lattice is near the one in
/// force, whichever vectors of it are given. A box that is strained or sheared in small steps costs a creation once for
/// each strain of about 1.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_INVALID_VALUE, DELDRIFT_DEPENDENT_VECTORS, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_stage_vectors(deldrift_triangulation *t,
                                       const double *vectors,
                                       size_t vector_count);

/// The vectors by which the triangulation repeats: those that were given, on the grid of deldrift_create_periodic.
///
/// vectors: a buffer with room for capacity rows of 2 (2D) or 3 (3D) numbers. count: receives their number, 0 for a
/// triangulation that is not periodic.
///
/// Cost: constant.
deldrift_status deldrift_vectors(const deldrift_triangulation *t,
                                 double *vectors,
                                 size_t capacity,
                                 size_t *count);

/// The shortest vectors of the lattice, a reduced basis of it. deldrift_wrap_positions translates by them.
///
/// vectors: receives rows of 2 (2D) or 3 (3D) numbers. multiples: receives as many rows of whole numbers: each vector
/// is the sum of these multiples of the vectors that were given. greatest: receives a number for each. No edge between
/// positions that deldrift_wrap_positions gives spans more than entry j of greatest times vector j, and the place to
/// which it leads is calculated without rounding. All are buffers with room for capacity vectors. count: receives their
/// number, 0 for a triangulation that is not periodic.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW.
deldrift_status deldrift_reduced_vectors(const deldrift_triangulation *t,
                                         double *vectors,
                                         int64_t *multiples,
                                         uint32_t *greatest,
                                         size_t capacity,
                                         size_t *count);

/// Takes positions into the box, each to its place in the unit cell of deldrift_reduced_vectors, on the grid of
/// deldrift_create_periodic.
///
/// positions: count points. They need not be those of vertices, and the triangulation may have none. previous: NULL, or
/// count points where the vertices have been. Each position then goes to the period nearest to its entry, while it is
/// at most a quarter of the unit cell outside of it. So a vertex does not flip back and forth at a face. places:
/// receives count points. shifts: receives count rows of 2 (2D) or 3 (3D) whole numbers: the multiples of the vectors
/// that were given by which the position is translated from its place, 0 beyond the last of these.
///
/// Where the triangulation is not periodic, places are the positions, and shifts 0.
///
/// Cost: count.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_wrap_positions(const deldrift_triangulation *t,
                                        const double *positions,
                                        const double *previous,
                                        size_t count,
                                        double *places,
                                        int64_t *shifts);

/// In which period each corner of each cell is, and each neighbour.
///
/// shifts: receives a row of 2 (2D) or 3 (3D) whole numbers for each of the 3 or 4 corners of each cell, in the order
/// of deldrift_cells: multiples of the vectors, 0 beyond the last of these. The corner is at its position and the sum
/// of these multiples. The corner of the lowest id is at its position (if the vertex is there more than once, the first
/// of these corners by x, y, z). neighbour_shifts: receives as many rows, one for the neighbour opposite each corner.
/// Translated by it from where its own shifts have it, the neighbour shares the facet. It is 0 on the hull. Both are
/// buffers with room for capacity cells. count: receives the number of cells.
///
/// All are 0 where the triangulation is not periodic.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_cell_shifts(const deldrift_triangulation *t,
                                     int64_t *shifts,
                                     int64_t *neighbour_shifts,
                                     size_t capacity,
                                     size_t *count);

/// In which period the second vertex of each edge is, in the order of deldrift_edges.
///
/// In a periodic triangulation deldrift_edges tells one of the edges that are translations of each other, the lower id
/// first. An edge may lead from a vertex to itself in another period, and two vertices may have several edges. shifts:
/// a buffer with room for capacity edges, which receives a row of 2 (2D) or 3 (3D) whole numbers for each: multiples of
/// the vectors, 0 beyond the last of these. From the position of the first vertex the edge leads to that of the second
/// and the sum of these multiples. count: receives the number of edges.
///
/// All are 0 where the triangulation is not periodic.
///
/// Cost: n + m, and d log d for the d neighbours of each vertex.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_edge_shifts(const deldrift_triangulation *t,
                                     int64_t *shifts,
                                     size_t capacity,
                                     size_t *count);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif // DELDRIFT_PERIODIC_H
