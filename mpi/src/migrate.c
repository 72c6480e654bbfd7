// Vertices change their owners, with data of the program.
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

enum { TAG_MIGRATION = 3 };

// What goes and what comes: records (id, point, in a periodic box the multiples of the vectors by which that is
// translated to where the program has it, data) by process.
typedef struct {
    size_t record, *goes, *comes; // counts by rank
    char *outgoing, *incoming;
    MPI_Request *requests;
    size_t arriving;
    // What has come: ids, points, data, each contiguous.
    uint64_t *ids;
    double *points, *home;
    int64_t *wraps, *more_wraps;
    char *values;
} freight;

static void free_freight(freight *f) {
    void *arrays[] = {f->goes, f->comes,     f->outgoing, f->incoming, f->requests,  f->ids,
                      f->home, f->points,    f->wraps,    f->values,   f->more_wraps};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
}

static void check_targets(deldrift_mpi *m, dm_refusal *refusal, const int32_t *targets, size_t count,
                          const void *values, size_t bytes) {
    if (m->insertion_count || m->removal_count)
        dm_refuse(refusal, DELDRIFT_STAGED_VERTEX, "%zu insertions and %zu removals are staged", m->insertion_count,
                  m->removal_count);
    if (count != m->own_count)
        dm_refuse(refusal, DELDRIFT_WRONG_COUNT, "count is %zu, and there are %zu own vertices", count, m->own_count);
    else if (count && !targets)
        dm_refuse(refusal, DELDRIFT_NULL_ARGUMENT, "targets is NULL, and count is %zu", count);
    else if (count && bytes && !values)
        dm_refuse(refusal, DELDRIFT_NULL_ARGUMENT, "values is NULL, and bytes_per_vertex is %zu", bytes);
    for (size_t i = 0; refusal->status == DELDRIFT_OK && i < count; i++)
        if (targets[i] < 0 || targets[i] >= m->size)
            dm_refuse(refusal, DELDRIFT_INVALID_VALUE, "entry %zu of targets is %d, and there are %d processes", i,
                      targets[i], m->size);
    if (bytes > INT_MAX / 2) dm_refuse(refusal, DELDRIFT_SIZE_OVERFLOW, "bytes_per_vertex is %zu", bytes);
    uint64_t first = bytes;
    MPI_Bcast(&first, 1, MPI_UINT64_T, 0, m->comm);
    if (first != bytes)
        dm_refuse(refusal, DELDRIFT_INVALID_VALUE, "bytes_per_vertex is %zu, that of process 0 is %llu", bytes,
                  (unsigned long long)first);
}

static void pack(const deldrift_mpi *m, freight *f, const int32_t *targets, const void *values, size_t bytes) {
    size_t *next = f->comes; // free until counts come
    for (int p = 0; p < m->size; p++) next[p] = p ? next[p - 1] + f->goes[p - 1] : 0;
    for (size_t i = 0; i < m->own_count; i++) {
        char *record = f->outgoing + next[targets[i]]++ * f->record;
        uint32_t v = m->own[i];
        memcpy(record, &m->id_of[v], sizeof(uint64_t));
        char *place = record + sizeof(uint64_t);
        memcpy(place, m->where + (size_t)v * m->row, m->row * sizeof(double));
        if (m->lattice.rank)
            memcpy(place + m->row * sizeof(double), m->wraps + i * m->dimension, m->dimension * sizeof(int64_t));
        if (bytes) memcpy(record + f->record - bytes, (const char *)values + i * bytes, bytes);
    }
}

static void check_lengths(const deldrift_mpi *m, dm_refusal *refusal, const freight *f) {
    for (int p = 0; p < m->size; p++)
        if (f->goes[p] * f->record > INT_MAX || f->comes[p] * f->record > INT_MAX)
            dm_refuse(refusal, DELDRIFT_SIZE_OVERFLOW, "more than 2 GiB go to one process");
}

static void transfer(deldrift_mpi *m, freight *f) {
    int requests = 0;
    size_t from = 0, to = 0;
    for (int p = 0; p < m->size; p++) {
        if (f->comes[p])
            MPI_Irecv(f->incoming + from * f->record, (int)(f->comes[p] * f->record), MPI_BYTE, p, TAG_MIGRATION,
                      m->comm, &f->requests[requests++]);
        from += f->comes[p];
    }
    for (int p = 0; p < m->size; p++) {
        if (f->goes[p])
            MPI_Isend(f->outgoing + to * f->record, (int)(f->goes[p] * f->record), MPI_BYTE, p, TAG_MIGRATION, m->comm,
                      &f->requests[requests++]);
        to += f->goes[p];
    }
    MPI_Waitall(requests, f->requests, MPI_STATUSES_IGNORE);
}

static void unpack(const deldrift_mpi *m, freight *f, size_t bytes) {
    for (size_t i = 0; i < f->arriving; i++) {
        const char *record = f->incoming + i * f->record;
        memcpy(&f->ids[i], record, sizeof(uint64_t));
        const char *place = record + sizeof(uint64_t);
        memcpy(f->points + i * m->row, place, m->row * sizeof(double));
        if (m->lattice.rank)
            memcpy(f->wraps + i * m->dimension, place + m->row * sizeof(double), m->dimension * sizeof(int64_t));
        if (bytes) memcpy(f->values + i * bytes, record + f->record - bytes, bytes);
    }
}

// Each step that may be refused memory ends in a vote.
static deldrift_status move_freight(deldrift_mpi *m, dm_refusal *refusal, freight *f, const int32_t *targets,
                                    const void *values, size_t bytes) {
    size_t size = (size_t)m->size;
    f->record = sizeof(uint64_t) + m->row * sizeof(double) + bytes;
    if (m->lattice.rank) f->record += m->dimension * sizeof(int64_t);
    f->goes = dm_allocate(refusal, size, sizeof *f->goes);
    f->comes = dm_allocate(refusal, size, sizeof *f->comes);
    f->requests = dm_allocate(refusal, 2 * size, sizeof *f->requests);
    f->outgoing = dm_allocate(refusal, m->own_count, f->record);
    deldrift_status status = dm_decide(m->comm, refusal, NULL).status;
    if (status != DELDRIFT_OK) return status;
    for (size_t i = 0; i < m->own_count; i++) f->goes[targets[i]]++;
    pack(m, f, targets, values, bytes);
    MPI_Alltoall(f->goes, sizeof *f->goes, MPI_BYTE, f->comes, sizeof *f->comes, MPI_BYTE, m->comm);
    for (size_t p = 0; p < size; p++) f->arriving += f->comes[p];
    check_lengths(m, refusal, f);
    f->incoming = dm_allocate(refusal, f->arriving, f->record);
    f->ids = dm_allocate(refusal, f->arriving, sizeof *f->ids);
    f->points = dm_allocate(refusal, f->arriving, m->row * sizeof *f->points);
    f->home = dm_allocate(refusal, f->arriving, m->row * sizeof *f->home);
    f->wraps = dm_allocate(refusal, f->arriving, m->dimension * sizeof *f->wraps);
    f->more_wraps = dm_allocate(refusal, f->arriving, m->dimension * sizeof *f->more_wraps);
    f->values = dm_allocate(refusal, f->arriving, bytes ? bytes : 1);
    status = dm_decide(m->comm, refusal, NULL).status;
    if (status != DELDRIFT_OK) return status;
    transfer(m, f);
    unpack(m, f, bytes);
    return DELDRIFT_OK;
}

// All that has come goes to the unit cell of a periodic box: the places that dm_build is given.
static const double *come_home(dm_refusal *refusal, const deldrift_mpi *fresh, freight *f) {
    if (!fresh->lattice.rank) return f->points;
    dm_wrap_points(refusal, fresh, f->points, f->arriving, f->home, f->more_wraps);
    for (size_t i = 0; i < f->arriving * fresh->dimension; i++) f->wraps[i] += f->more_wraps[i];
    return f->home;
}

deldrift_status deldrift_mpi_migrate(deldrift_mpi *m, const int32_t *targets, size_t count, const void *values,
                                     size_t bytes_per_vertex, const void **received, deldrift_mpi_report *report) {
    if (!m) return dm_no_handle();
    dm_refusal refusal = {DELDRIFT_OK, ""};
    freight f;
    memset(&f, 0, sizeof f);
    check_targets(m, &refusal, targets, count, values, bytes_per_vertex);
    deldrift_status status = dm_decide(m->comm, &refusal, NULL).status;
    if (status == DELDRIFT_OK) status = move_freight(m, &refusal, &f, targets, values, bytes_per_vertex);
    deldrift_mpi *fresh = NULL;
    const double *places = NULL;
    if (status == DELDRIFT_OK) {
        fresh = dm_new(&refusal, m->comm, m->dimension, m->row, &m->options, &m->local, m->lattice.given,
                       m->lattice.rank);
        if (fresh) places = come_home(&refusal, fresh, &f);
        status = dm_decide(m->comm, &refusal, NULL).status;
    }
    if (status == DELDRIFT_OK) status = dm_build(fresh, places, f.ids, f.wraps, f.arriving);
    if (status == DELDRIFT_OK) {
        fresh->migrated = f.values;
        f.values = NULL;
        dm_replace(m, fresh);
        if (received) *received = m->migrated;
        if (report) *report = m->report;
    } else if (fresh) {
        dm_free(fresh);
    }
    free(fresh);
    free_freight(&f);
    return status;
}
