// Handles: made, built, unmade.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

// The vectors of a periodic box.
typedef struct {
    const double *vectors;
    size_t vector_count;
} box;

// Weights, or NULL for 0 each; and whether there are any.
typedef struct {
    const double *of;
    bool are_there;
} weighing;

enum { DEFAULT_BOXES = 16, DEFAULT_DROP_PERCENT = 5 };

// What the program says of options, with defaults in place. False if it has no meaning.
static bool read_options(dm_refusal *refusal, const deldrift_mpi_options *given, deldrift_mpi_options *options,
                         deldrift_options *local) {
    deldrift_mpi_options_init(options);
    deldrift_options_init(local);
    local->threads = 1;
    if (given) {
        if (given->struct_size != sizeof *options) {
            dm_refuse(refusal, DELDRIFT_INVALID_OPTIONS, "struct_size of the options is %zu, not %zu",
                      given->struct_size, sizeof *options);
            return false;
        }
        *options = *given;
        if (given->local) {
            size_t size = given->local->struct_size;
            if (size != sizeof *local) {
                dm_refuse(refusal, DELDRIFT_INVALID_OPTIONS, "struct_size of the local options is %zu, not %zu", size,
                          sizeof *local);
                return false;
            }
            *local = *given->local;
        }
    }
    options->local = NULL;
    if (!options->boxes) options->boxes = DEFAULT_BOXES;
    if (!options->drop_percent) options->drop_percent = DEFAULT_DROP_PERCENT;
    if (options->boxes > DM_MAX_BOXES) {
        dm_refuse(refusal, DELDRIFT_INVALID_OPTIONS, "boxes is %u, above %d", options->boxes, DM_MAX_BOXES);
        options->boxes = DM_MAX_BOXES;
        return false;
    }
    return true;
}

void dm_free(deldrift_mpi *m) {
    dm_free_peers(m);
    deldrift_destroy(m->t);
    dm_free_lattice(&m->lattice);
    dm_free_classes(&m->told);
    void *arrays[] = {
        m->id_of,         m->owner_of,   m->is_own,       m->is_leaving,  m->where,       m->stamp,
        m->own,           m->box_of,     m->next_own,     m->next_box_of, m->next_points, m->insertion_points,
        m->insertion_ids, m->is_removal, m->boxes,        m->next_boxes,  m->peer_of,     m->undo,
        m->low,           m->high,       m->box_ranks,    m->offsets,     m->found,       m->vertices,
        m->coordinates,   m->numbers,    m->outgoing,     m->incoming,    m->chunks,      m->requests,
        m->chunk,         m->bases,      m->migrated,     m->moved,       m->nodes,       m->rebound,
        m->created,       m->removed,    m->created_cells, m->period_of,  m->wraps,       m->next_wraps,
        m->home,          m->home_before, m->home_wraps,  m->box_periods, m->insertion_wraps,
        m->created_shifts, m->removed_shifts, m->weight_of, m->unzipped,  m->weights,     m->given};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
}

deldrift_mpi *dm_new(dm_refusal *refusal, MPI_Comm comm, uint32_t dimension, uint32_t row,
                     const deldrift_mpi_options *options, const deldrift_options *local, const double *vectors,
                     size_t vector_count) {
    deldrift_mpi *m = dm_allocate(refusal, 1, sizeof *m);
    if (!m) return NULL;
    m->comm = comm;
    MPI_Comm_rank(comm, &m->rank);
    MPI_Comm_size(comm, &m->size);
    m->dimension = dimension;
    m->row = row;
    m->options = *options;
    m->local = *local;
    size_t size = (size_t)m->size, boxes = size * m->options.boxes;
    m->boxes = dm_allocate(refusal, boxes, sizeof *m->boxes);
    m->next_boxes = dm_allocate(refusal, boxes, sizeof *m->next_boxes);
    m->peer_of = dm_allocate(refusal, size, sizeof *m->peer_of);
    m->bases = dm_allocate(refusal, size, sizeof *m->bases);
    m->chunk = dm_allocate(refusal, DM_CHUNK, 2 * sizeof(uint64_t) + 4 * sizeof(double));
    dm_make_lattice(refusal, &m->lattice, dimension, vectors, vector_count);
    if (refusal->status != DELDRIFT_OK) {
        dm_free(m);
        free(m);
        return NULL;
    }
    for (size_t p = 0; p < size; p++) m->peer_of[p] = -1;
    return m;
}

// The first push of a periodic box, before anything is known of cells.
static deldrift_status push_seeds(deldrift_mpi *m) {
    dm_seed(m);
    dm_pack_sends(m);
    deldrift_status status = dm_decide(m->comm, &m->refusal, NULL).status;
    m->report.collectives++;
    if (status != DELDRIFT_OK) return status;
    m->report.rounds++;
    dm_push(m);
    if (dm_stage_received(m)) dm_prepare(m);
    return DELDRIFT_OK;
}

// That of the next own vertices.
static bool make_triangulation(deldrift_mpi *m, const double *points, const uint64_t *keys) {
    const double *weights;
    size_t count = m->next_count;
    if (!dm_unzip(m, &points, count, &weights)) return false;
    return dm_took(&m->refusal,
                   m->row == m->dimension
                       ? deldrift_create_with_keys(m->dimension, points, keys, count, &m->local, &m->t)
                       : deldrift_create_weighted(m->dimension, points, weights, keys, count, &m->local, &m->t));
}

deldrift_status dm_build(deldrift_mpi *m, const double *points, const uint64_t *ids, const int64_t *wraps,
                         size_t count) {
    dm_refusal *refusal = &m->refusal;
    memset(&m->report, 0, sizeof m->report);
    m->report.is_rebuilt = 1;
    m->next_count = count;
    m->points = points;
    dm_box own[DM_MAX_BOXES];
    (void)(dm_reserve_own(m, count) && make_triangulation(m, points, DM_HAS_FAULT(DM_FAULT_LOCAL_KEYS) ? NULL : ids) &&
           dm_reserve_ids(m, count) && dm_reserve(refusal, &m->undo, &m->undo_room, count, sizeof *m->undo));
    deldrift_status status = dm_decide(m->comm, refusal, NULL).status;
    m->report.collectives++;
    if (status != DELDRIFT_OK) return status;
    for (size_t i = 0; i < count; i++) {
        m->next_own[i] = (uint32_t)i;
        dm_set_vertex(m, (uint32_t)i, m->rank, 0, ids[i], points + i * m->row);
    }
    dm_make_boxes(m, own, m->next_box_of);
    dm_share_boxes(m, own);
    if (m->lattice.rank) status = push_seeds(m);
    if (status == DELDRIFT_OK) status = dm_rounds(m);
    if (status != DELDRIFT_OK) return status;
    dm_settle(m);
    if (m->lattice.rank && count) memcpy(m->wraps, wraps, count * m->dimension * sizeof *wraps);
    m->was_spanning = m->report.is_spanning;
    return DELDRIFT_OK;
}

static int compare_ids(const void *first, const void *second) {
    uint64_t a = *(const uint64_t *)first, b = *(const uint64_t *)second;
    return a < b ? -1 : a > b;
}

static int process_of(uint64_t id, int size) {
    return (int)((id * 0x9e3779b97f4a7c15u >> 32) * (uint64_t)size >> 32);
}

// Each id goes to a process that looks for another one like it.
static void find_twins(MPI_Comm comm, int size, dm_refusal *refusal, const uint64_t *ids, size_t count) {
    int *numbers = dm_allocate(refusal, 4 * (size_t)size, sizeof *numbers);
    uint64_t *sorted = dm_allocate(refusal, count, sizeof *sorted), *arrived = NULL;
    if (dm_decide(comm, refusal, NULL).status == DELDRIFT_OK) {
        int *sends = numbers, *from = numbers + size, *receives = numbers + 2 * size, *to = numbers + 3 * size;
        for (size_t i = 0; i < count; i++) sends[process_of(ids[i], size)]++;
        for (int p = 1; p < size; p++) from[p] = from[p - 1] + sends[p - 1];
        for (size_t i = 0; i < count; i++) sorted[from[process_of(ids[i], size)]++] = ids[i];
        for (int p = size - 1; p >= 0; p--) from[p] -= sends[p];
        MPI_Alltoall(sends, 1, MPI_INT, receives, 1, MPI_INT, comm);
        for (int p = 1; p < size; p++) to[p] = to[p - 1] + receives[p - 1];
        size_t total = (size_t)(to[size - 1] + receives[size - 1]);
        arrived = dm_allocate(refusal, total, sizeof *arrived);
        if (dm_decide(comm, refusal, NULL).status == DELDRIFT_OK) {
            MPI_Alltoallv(sorted, sends, from, MPI_UINT64_T, arrived, receives, to, MPI_UINT64_T, comm);
            qsort(arrived, total, sizeof *arrived, compare_ids);
            for (size_t i = 1; i < total; i++)
                if (arrived[i] == arrived[i - 1])
                    dm_refuse(refusal, DELDRIFT_INVALID_VALUE, "the id %llu is given twice",
                              (unsigned long long)arrived[i]);
        }
    }
    free(numbers);
    free(sorted);
    free(arrived);
}

// The ids that are given, or the numbers from that of the first own vertex on.
static uint64_t *make_ids(MPI_Comm comm, dm_refusal *refusal, const uint64_t *ids, size_t count) {
    uint64_t mine = count, first = 0;
    int rank;
    MPI_Comm_rank(comm, &rank);
    MPI_Exscan(&mine, &first, 1, MPI_UINT64_T, MPI_SUM, comm);
    if (rank == 0) first = 0;
    uint64_t *made = dm_allocate(refusal, count, sizeof *made);
    for (size_t i = 0; made && i < count; i++) made[i] = ids ? ids[i] : first + i;
    return made;
}

// What is wrong with the arguments, also beside those of other processes. The status is that of all.
static deldrift_status check_arguments(MPI_Comm comm, dm_refusal *refusal, uint32_t dimension, const double *positions,
                                       bool are_weighted, const uint64_t *ids, size_t count,
                                       const deldrift_mpi_options *options) {
    if (dimension != 2 && dimension != 3)
        dm_refuse(refusal, DELDRIFT_INVALID_DIMENSION, "the dimension is %u", dimension);
    else if (count > UINT32_MAX - 1)
        dm_refuse(refusal, DELDRIFT_TOO_MANY_VERTICES, "count is %zu", count);
    else
        dm_check_points(refusal, "positions", dimension, positions, count, NULL);
    int64_t numbers[4] = {ids || !count, !ids && count, 0, 0};
    if (!ids) numbers[0] = 0;
    uint64_t first[3] = {dimension, options->boxes, are_weighted};
    MPI_Bcast(first, 3, MPI_UINT64_T, 0, comm);
    if (first[0] != dimension)
        dm_refuse(refusal, DELDRIFT_INVALID_DIMENSION, "the dimension is %u, that of process 0 is %llu", dimension,
                  (unsigned long long)first[0]);
    if (first[1] != options->boxes)
        dm_refuse(refusal, DELDRIFT_INVALID_OPTIONS, "boxes is %u, that of process 0 is %llu", options->boxes,
                  (unsigned long long)first[1]);
    if (first[2] != are_weighted)
        dm_refuse(refusal, are_weighted ? DELDRIFT_WEIGHTED : DELDRIFT_NOT_WEIGHTED,
                  "the call is for %s, that of process 0 is not", are_weighted ? "weights" : "vertices without weights");
    dm_vote vote = dm_decide(comm, refusal, numbers);
    if (vote.status == DELDRIFT_OK && vote.most[0] && vote.most[1]) {
        if (!ids && count)
            dm_refuse(refusal, DELDRIFT_NULL_ARGUMENT, "ids is NULL, and that of another process is not");
        vote = dm_decide(comm, refusal, NULL);
    }
    return vote.status;
}

// All processes have to have the vectors of process 0.
static deldrift_status check_vectors(MPI_Comm comm, dm_refusal *refusal, uint32_t dimension, const box *given) {
    uint64_t count = given->vector_count;
    double first[9] = {0};
    MPI_Bcast(&count, 1, MPI_UINT64_T, 0, comm);
    if (count != given->vector_count)
        dm_refuse(refusal, DELDRIFT_INVALID_VALUE, "vector_count is %zu, that of process 0 is %llu",
                  given->vector_count, (unsigned long long)count);
    else if (!count || count > dimension)
        dm_refuse(refusal, DELDRIFT_DEPENDENT_VECTORS, "vector_count is %zu", given->vector_count);
    else if (!given->vectors)
        dm_refuse(refusal, DELDRIFT_NULL_ARGUMENT, "vectors is NULL");
    deldrift_status status = dm_decide(comm, refusal, NULL).status;
    if (status != DELDRIFT_OK) return status;
    size_t length = given->vector_count * dimension;
    memcpy(first, given->vectors, length * sizeof *first);
    MPI_Bcast(first, (int)length, MPI_DOUBLE, 0, comm);
    for (size_t k = 0; k < length; k++)
        if (first[k] != given->vectors[k] && !(isnan(first[k]) && isnan(given->vectors[k])))
            dm_refuse(refusal, DELDRIFT_INVALID_VALUE, "number %zu of vectors is %.17g, that of process 0 is %.17g", k,
                      given->vectors[k], first[k]);
    return dm_decide(comm, refusal, NULL).status;
}

// All processes see the same, so that none has to be told.
static bool check_communicator(dm_refusal *refusal, MPI_Comm comm) {
    int is_inter = 0;
    if (comm == MPI_COMM_NULL)
        dm_refuse(refusal, DELDRIFT_NULL_ARGUMENT, "comm is MPI_COMM_NULL");
    else if (MPI_Comm_test_inter(comm, &is_inter) != MPI_SUCCESS || is_inter)
        dm_refuse(refusal, DELDRIFT_INVALID_VALUE, "comm is %s", is_inter ? "an intercommunicator" : "no communicator");
    return refusal->status == DELDRIFT_OK;
}

// What a process owns, at home in the box if there is one.
typedef struct {
    uint64_t *ids;
    double *home, *points;
    int64_t *wraps;
} own_points;

static void free_own(own_points *own) {
    free(own->ids);
    free(own->home);
    free(own->points);
    free(own->wraps);
}

// The points to build from. NULL, and a refusal, where there is no memory.
static const double *place_own(dm_refusal *refusal, const deldrift_mpi *m, own_points *own, const double *positions,
                               const double *weights, size_t count) {
    uint32_t d = m->dimension;
    if (m->lattice.rank) {
        own->home = dm_allocate(refusal, count * d, sizeof *own->home);
        own->wraps = dm_allocate(refusal, count * d, sizeof *own->wraps);
        if (!own->home || !own->wraps) return NULL;
        dm_wrap(refusal, &m->lattice, positions, NULL, count, own->home, own->wraps);
        positions = own->home;
    }
    if (m->row == d) return positions;
    own->points = dm_allocate(refusal, count * m->row, sizeof *own->points);
    if (own->points) dm_zip(d, m->row, positions, weights, count, own->points);
    return own->points;
}

// With the vectors of a box, or NULL where the set is open.
static deldrift_status create(MPI_Comm comm, uint32_t dimension, const double *positions, weighing weights,
                              const uint64_t *ids, size_t count, const box *given,
                              const deldrift_mpi_options *options, deldrift_mpi **out) {
    dm_refusal refusal = {DELDRIFT_OK, ""};
    deldrift_mpi_options read;
    deldrift_options local;
    MPI_Comm copy;
    if (!check_communicator(&refusal, comm)) return dm_fail(&refusal);
    // All calls on the copy end the program on an error. This one may return, if the program's handler says so.
    if (MPI_Comm_dup(comm, &copy) != MPI_SUCCESS) MPI_Abort(comm, 1);
    MPI_Comm_set_errhandler(copy, MPI_ERRORS_ARE_FATAL);
    if (!out) dm_refuse(&refusal, DELDRIFT_NULL_ARGUMENT, "out is NULL");
    read_options(&refusal, options, &read, &local);
    deldrift_mpi *m = NULL;
    own_points own = {NULL, NULL, NULL, NULL};
    const double *points = NULL;
    if (given && local.coincidence == DELDRIFT_COINCIDENCE_REJECT)
        dm_refuse(&refusal, DELDRIFT_INVALID_OPTIONS, "a periodic triangulation does not reject coincident vertices");
    dm_check_weights(&refusal, weights.of, count, NULL);
    deldrift_status status =
        check_arguments(copy, &refusal, dimension, positions, weights.are_there, ids, count, &read);
    if (status == DELDRIFT_OK && given) status = check_vectors(copy, &refusal, dimension, given);
    if (status == DELDRIFT_OK) {
        int size;
        MPI_Comm_size(copy, &size);
        own.ids = make_ids(copy, &refusal, ids, count);
        if (own.ids) find_twins(copy, size, &refusal, own.ids, count);
        m = dm_new(&refusal, copy, dimension, dimension + weights.are_there, &read, &local,
                   given ? given->vectors : NULL, given ? given->vector_count : 0);
        if (m) points = place_own(&refusal, m, &own, positions, weights.of, count);
        status = dm_decide(copy, &refusal, NULL).status;
    }
    if (status == DELDRIFT_OK) status = dm_build(m, points, own.ids, own.wraps, count);
    free_own(&own);
    if (status == DELDRIFT_OK) {
        *out = m;
        return status;
    }
    if (m) {
        dm_free(m);
        free(m);
    }
    MPI_Comm_free(&copy);
    return status;
}

deldrift_status deldrift_mpi_create(MPI_Comm comm, uint32_t dimension, const double *positions, const uint64_t *ids,
                                    size_t count, const deldrift_mpi_options *options, deldrift_mpi **out) {
    return create(comm, dimension, positions, (weighing){NULL, false}, ids, count, NULL, options, out);
}

deldrift_status deldrift_mpi_create_weighted(MPI_Comm comm, uint32_t dimension, const double *positions,
                                             const double *weights, const uint64_t *ids, size_t count,
                                             const deldrift_mpi_options *options, deldrift_mpi **out) {
    return create(comm, dimension, positions, (weighing){weights, true}, ids, count, NULL, options, out);
}

deldrift_status deldrift_mpi_create_periodic(MPI_Comm comm, uint32_t dimension, const double *positions,
                                             const uint64_t *ids, size_t count, const double *vectors,
                                             size_t vector_count, const deldrift_mpi_options *options,
                                             deldrift_mpi **out) {
    box given = {vectors, vector_count};
    return create(comm, dimension, positions, (weighing){NULL, false}, ids, count, &given, options, out);
}

deldrift_status deldrift_mpi_create_periodic_weighted(MPI_Comm comm, uint32_t dimension, const double *positions,
                                                      const double *weights, const uint64_t *ids, size_t count,
                                                      const double *vectors, size_t vector_count,
                                                      const deldrift_mpi_options *options, deldrift_mpi **out) {
    box given = {vectors, vector_count};
    return create(comm, dimension, positions, (weighing){weights, true}, ids, count, &given, options, out);
}

void dm_replace(deldrift_mpi *m, deldrift_mpi *fresh) {
    deldrift_mpi old = *m;
    fresh->timestamp = old.timestamp;
    fresh->report.timestamp = old.timestamp;
    *m = *fresh;
    dm_free(&old);
}

// What is wrong with the arguments of one process.
static void check_strain(const deldrift_mpi *m, dm_refusal *refusal, const double *positions, size_t count,
                         size_t vector_count) {
    if (m->insertion_count || m->removal_count)
        dm_refuse(refusal, DELDRIFT_STAGED_VERTEX, "%zu insertions and %zu removals are staged", m->insertion_count,
                  m->removal_count);
    if (count != m->own_count)
        dm_refuse(refusal, DELDRIFT_WRONG_COUNT, "count is %zu, and there are %zu own vertices", count, m->own_count);
    else
        dm_check_points(refusal, "positions", m->dimension, positions, count, NULL);
    if (vector_count != m->lattice.rank)
        dm_refuse(refusal, DELDRIFT_WRONG_COUNT, "vector_count is %zu, and the box has %u vectors", vector_count,
                  m->lattice.rank);
}

// Builds all again, in a box of other vectors.
static deldrift_status build_strained(deldrift_mpi *m, const double *positions, size_t count, const double *vectors,
                                      size_t vector_count) {
    dm_refusal refusal = {DELDRIFT_OK, ""};
    uint64_t *ids = dm_allocate(&refusal, count, sizeof *ids);
    double *home = dm_allocate(&refusal, count * m->dimension, sizeof *home);
    int64_t *wraps = dm_allocate(&refusal, count * m->dimension, sizeof *wraps);
    deldrift_mpi *fresh =
        dm_new(&refusal, m->comm, m->dimension, m->row, &m->options, &m->local, vectors, vector_count);
    const double *points = home;
    if (refusal.status == DELDRIFT_OK) {
        for (size_t i = 0; i < count; i++) ids[i] = m->id_of[m->own[i]];
        if (dm_wrap(&refusal, &fresh->lattice, positions, NULL, count, home, wraps)) {
            m->refusal = refusal;
            dm_take_points(m, &points, NULL);
            refusal = m->refusal;
        }
    }
    deldrift_status status = dm_decide(m->comm, &refusal, NULL).status;
    if (status == DELDRIFT_OK) status = dm_build(fresh, points, ids, wraps, count);
    if (status == DELDRIFT_OK) {
        // Cells are known by global ids, so lists of changes go on.
        fresh->told = m->told;
        fresh->has_taken = m->has_taken;
        memset(&m->told, 0, sizeof m->told);
        dm_replace(m, fresh);
        m->report.timestamp = ++m->timestamp;
    } else if (fresh) {
        dm_free(fresh);
    }
    free(fresh);
    free(ids);
    free(home);
    free(wraps);
    return status;
}

deldrift_status deldrift_mpi_commit_vectors(deldrift_mpi *m, const double *positions, size_t count,
                                            const double *vectors, size_t vector_count, deldrift_mpi_report *report) {
    if (!m) return dm_no_handle();
    dm_refusal refusal = {DELDRIFT_OK, ""};
    box given = {vectors, vector_count};
    bool is_done;
    check_strain(m, &refusal, positions, count, vector_count);
    deldrift_status status = check_vectors(m->comm, &refusal, m->dimension, &given);
    if (status == DELDRIFT_OK) status = dm_commit_strain(m, positions, vectors, &is_done);
    if (status == DELDRIFT_OK && !is_done) status = build_strained(m, positions, count, vectors, vector_count);
    if (status == DELDRIFT_OK && report) *report = m->report;
    return status;
}

void deldrift_mpi_destroy(deldrift_mpi *m) {
    if (!m) return;
    MPI_Comm comm = m->comm;
    dm_free(m);
    free(m);
    MPI_Comm_free(&comm);
}
