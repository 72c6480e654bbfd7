// Values of vertices, from their owners to all copies.
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

enum { TAG_VALUES = 4 };

static void copy(char *values, char *buffer, const dm_list *list, size_t bytes, bool is_outgoing) {
    for (size_t k = 0; k < list->count; k++) {
        char *value = values + (size_t)list->at[k] * bytes, *place = buffer + k * bytes;
        if (is_outgoing)
            memcpy(place, value, bytes);
        else
            memcpy(value, place, bytes);
    }
}

static void transfer(deldrift_mpi *m, char *values, size_t bytes, char *outgoing, char *incoming,
                     MPI_Request *requests) {
    int count = 0;
    char *next = incoming;
    for (size_t p = 0; p < m->peer_count; p++) {
        const dm_peer *peer = &m->peers[p];
        size_t length = peer->received.count * bytes;
        if (length) MPI_Irecv(next, (int)length, MPI_BYTE, peer->rank, TAG_VALUES, m->comm, &requests[count++]);
        next += length;
    }
    for (size_t p = 0; p < m->peer_count; p++) {
        const dm_peer *peer = &m->peers[p];
        size_t length = peer->sent.count * bytes;
        copy(values, outgoing, &peer->sent, bytes, true);
        if (length) MPI_Isend(outgoing, (int)length, MPI_BYTE, peer->rank, TAG_VALUES, m->comm, &requests[count++]);
        outgoing += length;
    }
    MPI_Waitall(count, requests, MPI_STATUSES_IGNORE);
    for (size_t p = 0; p < m->peer_count; p++) {
        copy(values, incoming, &m->peers[p].received, bytes, false);
        incoming += m->peers[p].received.count * bytes;
    }
}

deldrift_status deldrift_mpi_exchange(deldrift_mpi *m, void *values, size_t bytes_per_vertex, size_t count) {
    if (!m) return dm_no_handle();
    dm_refusal refusal = {DELDRIFT_OK, ""};
    size_t sent = 0, received = 0, largest = 0;
    for (size_t p = 0; p < m->peer_count; p++) {
        size_t out = m->peers[p].sent.count, in = m->peers[p].received.count;
        sent += out;
        received += in;
        largest = out > largest ? out : largest;
        largest = in > largest ? in : largest;
    }
    if (count != m->ids)
        dm_refuse(&refusal, DELDRIFT_WRONG_COUNT, "count is %zu, and there are %zu ids", count, m->ids);
    else if (!values && count && bytes_per_vertex)
        dm_refuse(&refusal, DELDRIFT_NULL_ARGUMENT, "values is NULL");
    if (largest && bytes_per_vertex > INT_MAX / largest)
        dm_refuse(&refusal, DELDRIFT_SIZE_OVERFLOW,
                  "bytes_per_vertex is %zu, and %zu vertices go between two processes", bytes_per_vertex, largest);
    size_t bytes = bytes_per_vertex ? bytes_per_vertex : 1;
    char *outgoing = dm_allocate(&refusal, sent, bytes), *incoming = dm_allocate(&refusal, received, bytes);
    MPI_Request *requests = dm_allocate(&refusal, 2 * m->peer_count, sizeof *requests);
    deldrift_status status = dm_decide(m->comm, &refusal, NULL).status;
    if (status == DELDRIFT_OK && bytes_per_vertex) transfer(m, values, bytes_per_vertex, outgoing, incoming, requests);
    free(outgoing);
    free(incoming);
    free(requests);
    return status;
}
