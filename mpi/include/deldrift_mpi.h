/*
 * deldrift on several processes: one exact Delaunay triangulation of vertices that are spread over the processes of an
 * MPI communicator.
 *
 * Each process owns vertices, with global ids of 64 bits. It has a triangulation of its own vertices and of copies of
 * those of other processes that it needs, its halo; the library finds which these are. Every cell that has an own
 * vertex for a corner is exactly a cell of the triangulation that one process would have of all vertices, ties
 * included: ids are the keys of deldrift_create_with_keys. So the cells do not depend on how many processes there are,
 * which owns what, or what has been before. docs/MPI.md has the method, and why it is exact.
 *
 *     #include <deldrift_mpi.h>
 *     #include <stdio.h>
 *
 *     int main(int argc, char **argv) {
 *         MPI_Init(&argc, &argv);
 *         int rank;
 *         MPI_Comm_rank(MPI_COMM_WORLD, &rank);
 *         double points[] = {2.0 * rank, 0, 2.0 * rank + 1, 0, 2.0 * rank, 1, 2.0 * rank + 1, 1};
 *         deldrift_mpi *m;
 *         if (deldrift_mpi_create(MPI_COMM_WORLD, 2, points, NULL, 4, NULL, &m) != DELDRIFT_OK) {
 *             fprintf(stderr, "%s\n", deldrift_mpi_last_error());
 *             MPI_Abort(MPI_COMM_WORLD, 1);
 *         }
 *         points[1] = 0.25;
 *         deldrift_mpi_commit(m, points, 4, NULL);
 *         size_t count;
 *         deldrift_mpi_cells(m, NULL, NULL, 0, &count);
 *         printf("process %d owns %zu triangles\n", rank, count);
 *         deldrift_mpi_destroy(m);
 *         MPI_Finalize();
 *     }
 *
 * Compile and link: `mpicc program.c $(pkg-config --cflags --libs deldrift-mpi)`, or in CMake
 * `find_package(deldrift COMPONENTS mpi)` and `target_link_libraries(program deldrift::mpi)`.
 *
 * Own vertices have a place in a list: 0, 1, ... in the order in which they were given. A removal closes the gap, and
 * vertices that are inserted follow behind. Arrays of a program, positions and others, are in this order.
 * deldrift_mpi_vertices tells the id that each has in the triangulation of the process, deldrift_mpi_local, by which
 * all functions of deldrift.h read it.
 *
 * Collective calls, which are named so, have to be made by all processes of the communicator, in the same order. They
 * return the same status on all. All or nothing: if one process refuses, nothing has changed on any, what is staged
 * stays so, and deldrift_mpi_last_error tells everywhere which process it was, and why. Other calls concern the calling
 * process alone. A call without a handle (NULL) returns at once and is not collective.
 *
 * Ownership, arrays, counts and the floating-point environment are as in deldrift.h. No call on a handle may be made
 * while another one runs, on any thread; MPI_THREAD_SINGLE is enough. Errors of MPI itself end the program, as is MPI's
 * default, whatever the communicator's error handler is: so a process that dies ends all, and none waits for ever,
 * where MPI can tell; docs/MPI.md says where it can.
 */

#ifndef DELDRIFT_MPI_H
#define DELDRIFT_MPI_H

#include <deldrift.h>
#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A triangulation on several processes: opaque, made by deldrift_mpi_create, unmade by deldrift_mpi_destroy.
typedef struct deldrift_mpi deldrift_mpi;

/// Options of deldrift_mpi_create. Initialise them with deldrift_mpi_options_init, then set what should differ from the
/// defaults. No option changes the cells. All processes need to have the same boxes.
///
/// The structure may grow in later versions: struct_size says how much of it the program knows.
typedef struct deldrift_mpi_options {
    /// sizeof(deldrift_mpi_options) as the program sees it.
    size_t struct_size;
    /// Greatest number of boxes in which a process tells the others where its vertices are, from 1 to 256; 0, the
    /// default, is 16. More boxes make a smaller halo where the places of own vertices are far from a box, and take
    /// longer to search.
    uint32_t boxes;
    /// A process looks which copies of its vertices others do not need any more, when so many in a hundred of those
    /// that there are have been sent since it last did; 0, the default, is 5. UINT32_MAX has none dropped.
    uint32_t drop_percent;
    /// Options of the triangulation of the process. NULL, the default, stands for those of deldrift_options_init with
    /// one thread, as each processor has a process of its own. Read during the call only. DELDRIFT_COINCIDENCE_REJECT
    /// refuses vertices at the same place, also where these are of several processes.
    const deldrift_options *local;
} deldrift_mpi_options;

/// What a commit did, or deldrift_mpi_create or deldrift_mpi_migrate, on the calling process.
typedef struct deldrift_mpi_report {
    /// Number of the timestamp reached: 0 at creation, one more at each commit.
    uint64_t timestamp;
    /// How often vertices were sent that some process did not have and may need; the same on all processes.
    uint64_t rounds;
    /// Copies of vertices that have come from others.
    uint64_t received;
    /// Own vertices that have gone to others, counted for each of these.
    uint64_t sent;
    /// Copies that were dropped, as they are far, or as their owner has removed them.
    uint64_t dropped;
    /// Copies that the process has now.
    uint64_t halo;
    /// Messages from this process to another one.
    uint64_t messages;
    /// Bytes in these.
    uint64_t bytes;
    /// Collective operations of MPI, which all processes have part in.
    uint64_t collectives;
    /// Processes from which this one has copies, or to which it has sent vertices.
    uint64_t neighbours;
    /// Whether the vertices of all processes span the dimension: if not there are no cells.
    uint64_t is_spanning;
    /// 1 if the triangulations of the processes were built anew, so that vertices may have other ids in these: by
    /// creation, by migration, and by a commit of vectors that are not near those before.
    uint64_t is_rebuilt;
    /// Zero; later versions may count more.
    uint64_t reserved[4];
} deldrift_mpi_report;

/// Own cells that have come and gone since the program last took changes: lists that belong to the handle, valid until
/// the next call of deldrift_mpi_take_changes, a migration, or a commit of other vectors. A cell is its set of global
/// ids, in a periodic box with their shifts from each other: one that was own before and is own now is in neither list,
/// whatever has happened in between. So in a periodic box a cell is new if the program gives one of its vertices in
/// another period, or other vectors of the lattice.
typedef struct deldrift_mpi_changes {
    /// Number of own cells that there were not.
    size_t created_count;
    /// created_count rows of 3 (2D) or 4 (3D) global ids, positively oriented.
    const uint64_t *created;
    /// Their indices in the triangulation of the process, as it is.
    const uint32_t *created_cells;
    /// Number of own cells that there are not any more.
    size_t removed_count;
    /// removed_count rows of 3 (2D) or 4 (3D) global ids, in any order.
    const uint64_t *removed;
    /// 1 if all own cells are listed as created, and none as removed: by the first call, and the first one after a
    /// migration, or after memory was refused.
    size_t is_anew;
    /// In a periodic box a row of 2 (2D) or 3 (3D) whole numbers for each corner of each created cell, in the order of
    /// created: multiples of the vectors, as deldrift_mpi_cell_shifts has them, but counted from the corner of the
    /// least id and, of several with that id, of the least row. So a cell is told by the same ids and shifts each time.
    /// NULL where the triangulation is not periodic.
    const int64_t *created_shifts;
    /// Likewise for removed cells: the ids and shifts by which each was told as created.
    const int64_t *removed_shifts;
    /// Zero; later versions may tell more.
    size_t reserved[1];
} deldrift_mpi_changes;

/// Creates the triangulation of the vertices of all processes, at timestamp 0. Collective.
///
/// comm: a communicator of one group, of which a copy is used. dimension: 2 or 3, the same on all. positions: count
/// points, those that the process owns; NULL if count is 0. ids: a global id for each, any number, each once in all
/// processes; NULL on all processes stands for 0, 1, ... through all processes in the order of their ranks. options:
/// NULL for the defaults. Any set is legal: processes without vertices, all on one, fewer than span the dimension,
/// coincident ones.
///
/// out: receives the handle, on success only.
///
/// Cost: that of deldrift_create for the own vertices and the halo, a sort of the ids, and some messages:
/// docs/SCALING.md.
///
/// Errors: those of deldrift_create_with_keys; DELDRIFT_NULL_ARGUMENT also for MPI_COMM_NULL, DELDRIFT_INVALID_VALUE
/// for an intercommunicator and for an id that is given twice; DELDRIFT_INVALID_DIMENSION also for another dimension
/// than that of process 0, DELDRIFT_INVALID_OPTIONS also for another number of boxes.
deldrift_status deldrift_mpi_create(MPI_Comm comm, uint32_t dimension, const double *positions, const uint64_t *ids,
                                    size_t count, const deldrift_mpi_options *options, deldrift_mpi **out);

/// Creates the triangulation of the vertices of all processes and all places to which sums of multiples of the vectors
/// take them, at timestamp 0: that of deldrift_create_periodic, on several processes. Collective.
///
/// comm, dimension, positions, ids, count, options, out: as in deldrift_mpi_create; a position may be in any period.
/// vectors: vector_count rows of dimension numbers, 1 to dimension of them, the same on all processes. Positions are
/// rounded to a grid as deldrift_create_periodic says.
///
/// A process has copies of vertices in other periods, those of its own included. Inside, each vertex is *at home* in
/// the unit cell of deldrift_reduced_vectors, or near it: there its owner has it in deldrift_mpi_local, wherever the
/// program gives it, and each copy is a translation from there. A vertex that leaves the cell goes on outside of it, by
/// a quarter of it at most, and then comes in at the other side. deldrift_mpi_periods and deldrift_mpi_cell_shifts tell
/// periods. deldrift_mpi_hull_facets returns DELDRIFT_PERIODIC; all else serves.
///
/// Errors: those of deldrift_mpi_create and deldrift_create_periodic; DELDRIFT_INVALID_VALUE for vectors that are not
/// those of process 0.
deldrift_status deldrift_mpi_create_periodic(MPI_Comm comm, uint32_t dimension, const double *positions,
                                             const uint64_t *ids, size_t count, const double *vectors,
                                             size_t vector_count, const deldrift_mpi_options *options,
                                             deldrift_mpi **out);

/// Creates the regular triangulation of the vertices of all processes and their weights, at timestamp 0: that of
/// deldrift_create_weighted, on several processes. Collective.
///
/// comm, dimension, positions, ids, count, options, out: as in deldrift_mpi_create. weights: count numbers; NULL stands
/// for 0 each, on this process. All processes have to make this call: vertices without weights and with them are not in
/// one triangulation.
///
/// A vertex that is hidden by its weight is so on its owner: deldrift_hidden_by_weight of deldrift_mpi_local tells of
/// own vertices what it would tell of them on one process, and so do deldrift_hidden_vertices and all else that reads
/// their cells. deldrift_weights of deldrift_mpi_local has the weights.
///
/// Of several vertices at one place, of different processes, that are all hidden by weight, each process may tell
/// of its own that it represents the place. Where the vertices of all processes do not span the dimension, processes do
/// not know of each other's.
///
/// Cost: that of deldrift_mpi_create. A process sends what is in reach of the greatest weight that it knows of, so one
/// vertex whose weight is large beside the others' makes halos larger near it.
///
/// Errors: those of deldrift_mpi_create and deldrift_create_weighted; DELDRIFT_WEIGHTED or DELDRIFT_NOT_WEIGHTED where
/// process 0 calls deldrift_mpi_create.
deldrift_status deldrift_mpi_create_weighted(MPI_Comm comm, uint32_t dimension, const double *positions,
                                             const double *weights, const uint64_t *ids, size_t count,
                                             const deldrift_mpi_options *options, deldrift_mpi **out);

/// Creates the regular triangulation of the vertices of all processes, their weights, and all places to which sums of
/// multiples of the vectors take them: deldrift_create_periodic_weighted, on several processes. Collective.
///
/// weights: as in deldrift_mpi_create_weighted; all else as in deldrift_mpi_create_periodic.
///
/// Errors: those of deldrift_mpi_create_periodic and deldrift_mpi_create_weighted.
deldrift_status deldrift_mpi_create_periodic_weighted(MPI_Comm comm, uint32_t dimension, const double *positions,
                                                      const double *weights, const uint64_t *ids, size_t count,
                                                      const double *vectors, size_t vector_count,
                                                      const deldrift_mpi_options *options, deldrift_mpi **out);

/// Destroys a triangulation. Collective. NULL is legal and does nothing.
void deldrift_mpi_destroy(deldrift_mpi *m);

/// Stages the insertion of count vertices, to be owned by the calling process: all, or none if it fails. The next
/// commit inserts them, behind the own vertices that there are, in the order in which they were staged.
///
/// positions: count points. ids: a global id for each, which no vertex of any process may have. That no other process
/// has it is a duty of the program, and not looked at.
///
/// Cost: count, in the mean over many calls.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mpi_stage_insertions(deldrift_mpi *m, const double *positions, const uint64_t *ids,
                                              size_t count);

/// Stages the insertion of count vertices with weights: deldrift_mpi_stage_insertions gives them weight 0.
///
/// positions, ids, count: as there. weights: a number for each; NULL for 0 each.
///
/// Cost: count, in the mean over many calls.
///
/// Errors: those of deldrift_mpi_stage_insertions, also for a weight; DELDRIFT_NOT_WEIGHTED.
deldrift_status deldrift_mpi_stage_insertions_with_weights(deldrift_mpi *m, const double *positions,
                                                       const double *weights, const uint64_t *ids, size_t count);

/// Stages the removal of count own vertices by the next commit: all, or none if it fails.
///
/// places: places in the list of own vertices, each at most once.
///
/// Cost: count; the first call after a commit also the own vertices.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_STAGED_VERTEX for one whose removal is staged
/// already, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mpi_stage_removals(deldrift_mpi *m, const uint32_t *places, size_t count);

/// Forgets staged insertions and removals of the calling process.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_mpi_discard(deldrift_mpi *m);

/// Makes new positions of the own vertices, and the staged insertions and removals, the next timestamp. Collective.
///
/// positions: count points, one for each own vertex (those whose removal is staged too; their entries are not read);
/// count must be deldrift_mpi_count. NULL with count 0 if no own vertex moves. report: receives what was done; may be
/// NULL.
///
/// Cost: that of deldrift_commit_timestamp for the own vertices and the halo, and of deldrift_vertices_in_reach for the
/// boxes of the other processes; docs/SCALING.md has the messages. If no process has moved, inserted or removed
/// anything: one reduction, and no other message.
///
/// Errors: those of deldrift_commit_timestamp, DELDRIFT_WRONG_COUNT, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_OUT_OF_MEMORY, on any process.
deldrift_status deldrift_mpi_commit(deldrift_mpi *m, const double *positions, size_t count,
                                    deldrift_mpi_report *report);

/// Makes new positions and weights of the own vertices, and the staged insertions and removals, the next timestamp.
/// Collective.
///
/// positions, count, report: as in deldrift_mpi_commit. weights: a number for each own vertex (those whose removal is
/// staged too; their entries are not read). NULL for positions or weights leaves these as they are, on this process.
///
/// Cost: that of deldrift_mpi_commit.
///
/// Errors: those of deldrift_mpi_commit, also for a weight, and DELDRIFT_NOT_WEIGHTED, on any process.
deldrift_status deldrift_mpi_commit_weighted(deldrift_mpi *m, const double *positions, const double *weights,
                                             size_t count, deldrift_mpi_report *report);

/// Makes other vectors of a periodic box, and new positions of the own vertices, the next timestamp. Collective. Where
/// each reduced vector is near a sum of those before, as in a step of a barostat or of a shear, this is a commit of
/// moves. Else all is built again: vertices have other ids in the triangulations of the processes, as after
/// deldrift_mpi_migrate. The report says which: is_rebuilt.
///
/// positions, count, report: as in deldrift_mpi_commit, but for positions, which are to be given. vectors: vector_count
/// rows, as many as there are, the same on all processes. What is staged has to be committed or discarded before:
/// DELDRIFT_STAGED_VERTEX.
///
/// Cost: that of deldrift_mpi_commit in which all move; where all is built, that of deldrift_mpi_create_periodic.
///
/// Errors: those of deldrift_mpi_create_periodic, DELDRIFT_WRONG_COUNT for another number of positions or vectors,
/// DELDRIFT_STAGED_VERTEX.
deldrift_status deldrift_mpi_commit_vectors(deldrift_mpi *m, const double *positions, size_t count,
                                            const double *vectors, size_t vector_count, deldrift_mpi_report *report);

/// How many vertices the calling process owns, to *count.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_mpi_count(const deldrift_mpi *m, size_t *count);

/// The own vertices in the order of their list: their global ids, and their ids in the triangulation of the process.
///
/// ids, vertices: buffers with room for capacity entries; one that is NULL is not filled. count: receives their number,
/// also when the buffers are too small. NULL for both with capacity 0 asks for the count alone. A vertex keeps its id
/// in the triangulation of the process until a report says is_rebuilt.
///
/// Cost: the own vertices.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_mpi_vertices(const deldrift_mpi *m, uint64_t *ids, uint32_t *vertices, size_t capacity,
                                      size_t *count);

/// The triangulation of the own vertices and the halo, to *t, for all functions that take a const triangulation. It
/// belongs to m, and is another one after a report that says is_rebuilt. Cells without an own vertex may not be cells
/// of the whole. What functions tell of an own vertex and its cells, such as deldrift_star, deldrift_voronoi_volumes
/// and deldrift_vertex_neighbours, is that of the whole; deldrift_keys gives global ids. Its timestamp counts rounds.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_mpi_local(const deldrift_mpi *m, const deldrift_triangulation **t);

/// For each id of the triangulation of the process the rank of the process that owns the vertex, or -1 where there is
/// none. In a periodic box copies of own vertices have the own rank as well; deldrift_mpi_vertices has those at home.
///
/// owners: a buffer with room for capacity entries. count: receives the number of ids, also when the buffer is too
/// small. NULL with capacity 0 asks for the count alone.
///
/// Cost: the ids.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL.
deldrift_status deldrift_mpi_owners(const deldrift_mpi *m, int32_t *owners, size_t capacity, size_t *count);

/// The cells that the calling process owns: of those with an own vertex the ones whose corner of least global id is
/// own. So each cell of the whole is owned by one process. In a periodic box one cell is owned of each class of those
/// that are translations of each other; ids may be there more than once in a row.
///
/// ids: a buffer with room for capacity rows of 3 (2D) or 4 (3D) global ids, positively oriented. cells: a buffer with
/// room for capacity indices of cells in the triangulation of the process. One that is NULL is not filled. count:
/// receives their number, also when the buffers are too small. NULL for both with capacity 0 asks for the count alone.
///
/// Cost: the cells of the triangulation of the process.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mpi_cells(const deldrift_mpi *m, uint64_t *ids, uint32_t *cells, size_t capacity,
                                   size_t *count);

/// In which period each corner of each own cell is, in the order of deldrift_mpi_cells. Collective, as owners tell how
/// vertices were given.
///
/// shifts: receives a row of 2 (2D) or 3 (3D) whole numbers for each of the 3 or 4 corners: multiples of the vectors, 0
/// beyond the last of these. The corner is at the position that its owner has given, rounded to the grid, and the sum
/// of these multiples. The corner of the least id is at its position (if the vertex is there more than once, the first
/// of these by x, y, z). A buffer with room for capacity cells. count: receives the number of cells, also when the
/// buffer is too small: that of deldrift_mpi_cells.
///
/// Of each class of cells that are translations of each other, one process owns one. All shifts are 0 where the
/// triangulation is not periodic.
///
/// Cost: the halo, and the cells of the triangulation of the process.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY, on any process.
deldrift_status deldrift_mpi_cell_shifts(deldrift_mpi *m, int64_t *shifts, size_t capacity, size_t *count);

/// For each id of the triangulation of the process the multiples of the vectors by which the vertex is translated there
/// from the position that its owner has given. Collective.
///
/// shifts: receives rows of 2 (2D) or 3 (3D) whole numbers; 0 where there is no vertex, and all where the triangulation
/// is not periodic. A buffer with room for capacity ids. count: receives the number of ids, also when the buffer is too
/// small: that of deldrift_mpi_owners.
///
/// Cost: the halo.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY, on any process.
deldrift_status deldrift_mpi_periods(deldrift_mpi *m, int64_t *shifts, size_t capacity, size_t *count);

/// The facets of the convex hull of the whole that the calling process owns, as deldrift_mpi_cells does: rows of 2 (2D)
/// or 3 (3D) global ids, seen from outside as deldrift_hull_facets has them, and in the triangulation of the process
/// the cell of each and which of its corners is opposite.
///
/// Cost: the cells of the triangulation of the process.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_BUFFER_TOO_SMALL, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_PERIODIC in a periodic
/// box.
deldrift_status deldrift_mpi_hull_facets(const deldrift_mpi *m, uint64_t *ids, uint32_t *cells, uint8_t *corners,
                                         size_t capacity, size_t *count);

/// The own cells that have come and gone since this was last called, to *changes. It concerns the calling process
/// alone; in a periodic box it is collective, as owners tell how vertices were given. A program that never calls it
/// pays nothing.
///
/// Cost: what has changed in the triangulation of the process, its halo included, and the stars of vertices that have
/// an id which was another one's; of a list of all, the cells. In a periodic box always the cells and the halo, and the
/// memory of a copy of the own cells.
///
/// Errors: DELDRIFT_NULL_ARGUMENT; DELDRIFT_OUT_OF_MEMORY, then the next list is of all own cells. In a periodic box,
/// on any process: then nothing has been taken on any.
deldrift_status deldrift_mpi_take_changes(deldrift_mpi *m, deldrift_mpi_changes *changes);

/// Brings values of vertices from their owners to all copies. Collective, but messages go between neighbours only.
///
/// values: bytes_per_vertex bytes for each id of the triangulation of the process: those of own vertices are read,
/// those of the halo written, others left as they are. bytes_per_vertex is the same on all processes. count: how many
/// ids, as deldrift_mpi_owners tells.
///
/// Cost: the halo.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_WRONG_COUNT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mpi_exchange(deldrift_mpi *m, void *values, size_t bytes_per_vertex, size_t count);

/// For each own vertex the process that should own it: parts of a space-filling curve (Hilbert's) through all vertices,
/// of equal weight. Collective. Nothing changes: deldrift_mpi_migrate does it.
///
/// weights: count numbers above 0, or 0, one for each own vertex; NULL for 1 each. targets: receives count ranks. count
/// must be deldrift_mpi_count.
///
/// The parts are the same on any number of processes that have the same vertices and weights among them, but for the
/// number of parts. Vertices of the same cell of the finest grid of the curve (2^20 a side in 3D, 2^31 in 2D) are in
/// one part.
///
/// Cost: count log count, and some sixty reductions of a number for each process.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_WRONG_COUNT, DELDRIFT_INVALID_VALUE for a weight that is negative, infinite
/// or NaN, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mpi_partition(deldrift_mpi *m, const double *weights, size_t count, int32_t *targets);

/// Gives own vertices to other processes, with data that the program has for them. Collective. The timestamp and the
/// cells stay; vertices have other ids in the triangulations of the processes, which are built again.
///
/// targets: for each own vertex the rank of the process that is to own it; count must be deldrift_mpi_count. Then the
/// list of own vertices has those that came from process 0, 1, ..., each in the order they had there, those that stay
/// among them. values: bytes_per_vertex bytes for each own vertex; NULL if bytes_per_vertex, the same on all processes,
/// is 0. received: receives those of the vertices owned afterwards, in the order of their list; may be NULL. It belongs
/// to m, until the next migration. report: receives what was done; may be NULL.
///
/// What is staged has to be committed or discarded before: DELDRIFT_STAGED_VERTEX.
///
/// Cost: that of deldrift_mpi_create.
///
/// Errors: those of deldrift_mpi_create, DELDRIFT_WRONG_COUNT, DELDRIFT_STAGED_VERTEX, DELDRIFT_INVALID_VALUE for a
/// rank that there is not, or another number of bytes than on process 0.
deldrift_status deldrift_mpi_migrate(deldrift_mpi *m, const int32_t *targets, size_t count, const void *values,
                                     size_t bytes_per_vertex, const void **received, deldrift_mpi_report *report);

/// The number of the current timestamp, to *timestamp.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_mpi_timestamp(const deldrift_mpi *m, uint64_t *timestamp);

/// What deldrift_mpi_create or the latest commit or migration did, to *report.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
deldrift_status deldrift_mpi_last_report(const deldrift_mpi *m, deldrift_mpi_report *report);

/// The message of the last call of this library on this thread that failed. After a collective call it begins with the
/// process that refused, and is the same on all processes. It is as deldrift_last_error in all else.
const char *deldrift_mpi_last_error(void);

/// The rank of the process that refused in the last collective call on this thread that failed; -1 if none has. If
/// several refused, the lowest of them.
int deldrift_mpi_refusing_process(void);

/// Sets struct_size and the default of every other option. NULL is legal and does nothing.
static inline void deldrift_mpi_options_init(deldrift_mpi_options *options) {
    static deldrift_mpi_options zeros;
    if (options) {
        *options = zeros;
        options->struct_size = sizeof *options;
    }
}

#ifdef __cplusplus
} // extern "C"
#endif

#endif // DELDRIFT_MPI_H
