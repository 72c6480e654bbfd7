// Lists of what other processes have of this one, and this one of them, and the exchange of points by these lists.
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

enum { TAG_POSITIONS = 1 };

dm_peer *dm_peer_of(deldrift_mpi *m, int rank) {
    if (m->peer_of[rank] >= 0) return &m->peers[m->peer_of[rank]];
    if (!dm_reserve(&m->refusal, &m->peers, &m->peer_room, m->peer_count + 1, sizeof *m->peers)) return NULL;
    dm_peer *peer = &m->peers[m->peer_count];
    memset(peer, 0, sizeof *peer);
    peer->rank = rank;
    peer->requests[0] = peer->requests[1] = MPI_REQUEST_NULL;
    m->peer_of[rank] = (int32_t)m->peer_count++;
    return peer;
}

// Requests know the address and the size of a buffer: they are made again where either has changed.
static bool make_ready(deldrift_mpi *m, dm_peer *peer) {
    uint32_t row = m->row;
    size_t longest = peer->sent.count > peer->received.count ? peer->sent.count : peer->received.count;
    if (longest > INT_MAX / row) {
        dm_refuse(&m->refusal, DELDRIFT_SIZE_OVERFLOW, "%zu vertices go between two processes in one message", longest);
        return false;
    }
    const double *before[2] = {peer->outgoing, peer->incoming};
    if (!dm_reserve(&m->refusal, &peer->outgoing, &peer->outgoing_room, peer->sent.count, row * sizeof(double)) ||
        !dm_reserve(&m->refusal, &peer->incoming, &peer->incoming_room, peer->received.count, row * sizeof(double)))
        return false;
    double *now[2] = {peer->outgoing, peer->incoming};
    size_t counts[2] = {peer->sent.count, peer->received.count};
    for (int k = 0; k < 2; k++) {
        if (now[k] == before[k] && counts[k] == peer->requested[k]) continue;
        if (peer->requests[k] != MPI_REQUEST_NULL) MPI_Request_free(&peer->requests[k]);
        peer->requested[k] = counts[k];
        if (!counts[k]) continue;
        int numbers = (int)(counts[k] * row);
        if (k == 0)
            MPI_Send_init(now[k], numbers, MPI_DOUBLE, peer->rank, TAG_POSITIONS, m->comm, &peer->requests[k]);
        else
            MPI_Recv_init(now[k], numbers, MPI_DOUBLE, peer->rank, TAG_POSITIONS, m->comm, &peer->requests[k]);
    }
    return true;
}

bool dm_make_peers_ready(deldrift_mpi *m) {
    for (size_t p = 0; p < m->peer_count; p++)
        if (!make_ready(m, &m->peers[p])) return false;
    return true;
}

void dm_exchange_positions(deldrift_mpi *m) {
    uint32_t row = m->row;
    for (size_t p = 0; p < m->peer_count; p++) {
        dm_peer *peer = &m->peers[p];
        if (peer->requests[1] != MPI_REQUEST_NULL) MPI_Start(&peer->requests[1]);
    }
    for (size_t p = 0; p < m->peer_count; p++) {
        dm_peer *peer = &m->peers[p];
        for (size_t k = 0; k < peer->sent.count; k++) {
            uint32_t v = peer->sent.at[k];
            if (m->is_leaving[v]) peer->sent.is_leaving[k] = 1;
            dm_translate_point(m, peer->outgoing + k * row, m->where + (size_t)v * row, peer->sent.period[k]);
            // A position that is no number says that the copy goes.
            if (peer->sent.is_leaving[k]) peer->outgoing[k * row] = NAN;
        }
        if (peer->requests[0] == MPI_REQUEST_NULL) continue;
        MPI_Start(&peer->requests[0]);
        m->report.messages++;
        m->report.bytes += peer->sent.count * row * sizeof(double);
    }
    for (size_t p = 0; p < m->peer_count; p++) {
        dm_peer *peer = &m->peers[p];
        MPI_Wait(&peer->requests[1], MPI_STATUS_IGNORE);
        for (size_t k = 0; k < peer->received.count; k++) {
            uint32_t v = peer->received.at[k];
            peer->received.is_leaving[k] = isnan(peer->incoming[k * row]);
            if (peer->received.is_leaving[k]) {
                m->is_leaving[v] = 1;
                m->report.dropped++;
            } else if (!DM_HAS_FAULT(DM_FAULT_STALE_HALO) || k % 16) {
                double *where = m->where + (size_t)v * row;
                if (!memcmp(where, peer->incoming + k * row, row * sizeof(double))) continue;
                memcpy(where, peer->incoming + k * row, row * sizeof(double));
                m->moved[m->moved_count++] = v;
            }
        }
    }
    for (size_t p = 0; p < m->peer_count; p++) MPI_Wait(&m->peers[p].requests[0], MPI_STATUS_IGNORE);
}

static void settle_list(dm_list *list) {
    size_t kept = 0;
    for (size_t k = 0; k < list->count; k++) {
        if (!list->is_leaving[k]) {
            list->period[kept] = list->period[k];
            list->at[kept++] = list->at[k];
        }
    }
    list->count = list->settled = list->pushed = kept;
    if (kept) memset(list->is_leaving, 0, kept);
}

static void restore_list(dm_list *list) {
    list->count = list->pushed = list->settled;
    if (list->count) memset(list->is_leaving, 0, list->count);
}

void dm_settle_peers(deldrift_mpi *m) {
    for (size_t p = 0; p < m->peer_count; p++) {
        settle_list(&m->peers[p].sent);
        settle_list(&m->peers[p].received);
    }
}

void dm_restore_peers(deldrift_mpi *m) {
    for (size_t p = 0; p < m->peer_count; p++) {
        restore_list(&m->peers[p].sent);
        restore_list(&m->peers[p].received);
    }
}

void dm_free_peers(deldrift_mpi *m) {
    for (size_t p = 0; p < m->peer_count; p++) {
        dm_peer *peer = &m->peers[p];
        for (int k = 0; k < 2; k++)
            if (peer->requests[k] != MPI_REQUEST_NULL) MPI_Request_free(&peer->requests[k]);
        void *arrays[] = {peer->sent.at,       peer->sent.period,     peer->sent.is_leaving,
                          peer->received.at,   peer->received.period, peer->received.is_leaving,
                          peer->outgoing,      peer->incoming};
        for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
    }
    free(m->peers);
    m->peers = NULL;
    m->peer_count = m->peer_room = 0;
}
