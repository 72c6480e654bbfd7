// A round of the push: own vertices that have come to the lists of peers go there. Nobody knows beforehand from whom
// something comes: that all has arrived is told by a barrier that each process enters when what it has sent has been
// received.
#include <stdlib.h>
#include <string.h>

#include "internal.h"

enum { TAG_PUSH = 2 };

// The global id, the point, and in a periodic box the translation.
static size_t record_bytes(const deldrift_mpi *m) {
    return sizeof(uint64_t) + m->row * sizeof(double) + (m->lattice.rank ? sizeof(uint64_t) : 0);
}

static uint32_t period_in(const deldrift_mpi *m, const char *record) {
    uint64_t period = 0;
    if (m->lattice.rank) memcpy(&period, record + record_bytes(m) - sizeof period, sizeof period);
    return (uint32_t)period;
}

// Writes records of what is to be sent, one list behind the other, and makes room for a request for each message.
bool dm_pack_sends(deldrift_mpi *m) {
    size_t bytes = record_bytes(m), records = 0, chunks = 0;
    for (size_t p = 0; p < m->peer_count; p++) {
        const dm_list *sent = &m->peers[p].sent;
        records += sent->count - sent->pushed;
        chunks += (sent->count - sent->pushed + DM_CHUNK - 1) / DM_CHUNK;
    }
    if (!dm_reserve(&m->refusal, &m->outgoing, &m->outgoing_room, records, bytes) ||
        !dm_reserve(&m->refusal, &m->requests, &m->request_room, chunks, sizeof *m->requests))
        return false;
    char *record = m->outgoing;
    for (size_t p = 0; p < m->peer_count; p++) {
        const dm_list *sent = &m->peers[p].sent;
        for (size_t k = sent->pushed; k < sent->count; k++, record += bytes) {
            uint32_t v = sent->at[k];
            memcpy(record, &m->id_of[v], sizeof m->id_of[v]);
            double point[4];
            uint64_t period = sent->period[k];
            dm_translate_point(m, point, m->where + (size_t)v * m->row, sent->period[k]);
            memcpy(record + sizeof(uint64_t), point, m->row * sizeof(double));
            if (m->lattice.rank) memcpy(record + bytes - sizeof period, &period, sizeof period);
        }
    }
    return true;
}

static int start_sends(deldrift_mpi *m) {
    size_t bytes = record_bytes(m);
    const char *record = m->outgoing;
    int requests = 0;
    if (m->refusal.status != DELDRIFT_OK) return 0; // what there is to send may not be packed
    for (size_t p = 0; p < m->peer_count; p++) {
        dm_list *sent = &m->peers[p].sent;
        for (size_t k = sent->pushed, count; k < sent->count; k += count, record += count * bytes) {
            count = sent->count - k < DM_CHUNK ? sent->count - k : DM_CHUNK;
            m->report.sent += count;
            if (DM_HAS_FAULT(DM_FAULT_LOST_MESSAGE) && k == sent->pushed && m->peers[p].rank == 0) continue;
            m->report.messages++;
            m->report.bytes += count * bytes;
            MPI_Issend(record, (int)(count * bytes), MPI_BYTE, m->peers[p].rank, TAG_PUSH, m->comm,
                       &m->requests[requests++]);
        }
        sent->pushed = sent->count;
    }
    return requests;
}

// What finds no memory is received all the same, and forgotten: the next vote tells.
static void receive(deldrift_mpi *m, int source) {
    MPI_Status status;
    int bytes = 0;
    MPI_Recv(m->chunk, (int)(DM_CHUNK * record_bytes(m)), MPI_BYTE, source, TAG_PUSH, m->comm, &status);
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    size_t length = (size_t)bytes;
    if (!dm_reserve(&m->refusal, &m->incoming, &m->incoming_room, m->incoming_bytes + length, 1) ||
        !dm_reserve(&m->refusal, &m->chunks, &m->chunk_room, m->chunk_count + 1, sizeof *m->chunks))
        return;
    memcpy(m->incoming + m->incoming_bytes, m->chunk, length);
    m->chunks[m->chunk_count] = (dm_chunk){source, m->chunk_count, m->incoming_bytes, length / record_bytes(m)};
    m->chunk_count++;
    m->incoming_bytes += length;
}

void dm_push(deldrift_mpi *m) {
    int requests = start_sends(m), is_done = 0, is_in_barrier = 0;
    MPI_Request barrier;
    m->chunk_count = m->incoming_bytes = 0;
    m->report.collectives++;
    while (!is_done) {
        int is_waiting = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, TAG_PUSH, m->comm, &is_waiting, &status);
        if (is_waiting) receive(m, status.MPI_SOURCE);
        if (is_in_barrier) {
            MPI_Test(&barrier, &is_done, MPI_STATUS_IGNORE);
            continue;
        }
        MPI_Testall(requests, m->requests, &is_in_barrier, MPI_STATUSES_IGNORE);
        if (is_in_barrier) MPI_Ibarrier(m->comm, &barrier);
    }
}

// By source, and from one source as they were sent: ids do not depend on what arrives first.
static int compare_chunks(const void *first, const void *second) {
    const dm_chunk *a = first, *b = second;
    if (a->source != b->source) return a->source < b->source ? -1 : 1;
    return a->order < b->order ? -1 : a->order > b->order;
}

bool dm_stage_received(deldrift_mpi *m) {
    uint32_t row = m->row;
    size_t bytes = record_bytes(m), count = m->incoming_bytes / bytes, next = 0;
    if (m->refusal.status != DELDRIFT_OK) return false;
    if (!count) return true;
    qsort(m->chunks, m->chunk_count, sizeof *m->chunks, compare_chunks);
    if (!dm_reserve(&m->refusal, &m->coordinates, &m->coordinate_room, count * row, sizeof *m->coordinates) ||
        !dm_reserve(&m->refusal, &m->numbers, &m->number_room, count, sizeof *m->numbers) ||
        !dm_reserve(&m->refusal, &m->vertices, &m->vertex_room, count, sizeof *m->vertices))
        return false;
    for (size_t c = 0; c < m->chunk_count; c++) {
        const char *record = m->incoming + m->chunks[c].offset;
        for (size_t k = 0; k < m->chunks[c].count; k++, record += bytes, next++) {
            memcpy(&m->numbers[next], record, sizeof *m->numbers);
            memcpy(m->coordinates + next * row, record + sizeof *m->numbers, row * sizeof(double));
        }
    }
    if (!dm_insert(m, m->coordinates, m->numbers, count)) return false;
    next = 0;
    for (size_t c = 0; c < m->chunk_count; c++) {
        dm_peer *peer = dm_peer_of(m, m->chunks[c].source);
        if (!peer || !dm_reserve_list(&m->refusal, &peer->received, peer->received.count + m->chunks[c].count))
            return false;
        dm_list *received = &peer->received;
        const char *record = m->incoming + m->chunks[c].offset;
        for (size_t k = 0; k < m->chunks[c].count; k++, next++, record += bytes) {
            uint32_t period = period_in(m, record);
            received->is_leaving[received->count] = 0;
            received->period[received->count] = period;
            received->at[received->count++] = m->vertices[next];
            dm_set_vertex(m, m->vertices[next], peer->rank, period, m->numbers[next],
                          m->coordinates + next * row);
        }
    }
    m->report.received += count;
    return true;
}
