// A timestamp of all processes, from what is staged on the triangulation of each to the state in which none needs more.
#include <string.h>

#include "internal.h"

// What is to be sent, and whether the process owns vertices and has no cells.
static size_t look(deldrift_mpi *m, bool *has_no_cells) {
    size_t cells = 0;
    *has_no_cells = false;
    if (m->refusal.status != DELDRIFT_OK || !m->next_count) return 0;
    if (!dm_took(&m->refusal, deldrift_cell_count(m->t, &cells))) return 0;
    *has_no_cells = !cells;
    size_t sends = cells ? dm_find_sends(m) : 0;
    dm_pack_sends(m);
    return sends;
}

deldrift_status dm_rounds(deldrift_mpi *m) {
    m->report.is_spanning = 1;
    for (;;) {
        bool has_no_cells;
        int64_t numbers[4] = {0};
        numbers[0] = (int64_t)look(m, &has_no_cells);
        numbers[1] = has_no_cells;
        dm_vote vote = dm_decide(m->comm, &m->refusal, numbers);
        m->report.collectives++;
        if (vote.status != DELDRIFT_OK) return vote.status;
        if (vote.most[1]) {
            if (!dm_span(m, has_no_cells)) {
                m->report.is_spanning = 0;
                return DELDRIFT_OK;
            }
            dm_pack_sends(m);
        } else if (!vote.most[0] || (DM_HAS_FAULT(DM_FAULT_NO_ROUND) && m->is_prepared)) {
            // Nothing is left to be sent, but by a fault that tests plant.
            for (size_t p = 0; p < m->peer_count; p++) m->peers[p].sent.count = m->peers[p].sent.pushed;
            return DELDRIFT_OK;
        }
        m->report.rounds++;
        dm_push(m);
        if (dm_stage_received(m)) dm_prepare(m);
    }
}

void dm_count_copies(deldrift_mpi *m) {
    m->report.halo = m->report.neighbours = 0;
    for (size_t p = 0; p < m->peer_count; p++) {
        m->report.halo += m->peers[p].received.count;
        m->report.neighbours +=
            m->peers[p].rank != m->rank && (m->peers[p].sent.count || m->peers[p].received.count);
    }
}

void dm_settle(deldrift_mpi *m) {
    dm_publish(m);
    m->sent_since_drop = (m->has_dropped ? 0 : m->sent_since_drop) + m->report.sent;
    m->has_dropped = false;
    for (size_t k = 0; k < m->undo_count; k++) m->is_leaving[m->undo[k].vertex] = 0;
    dm_note_rebound(m);
    m->undo_count = 0;
    dm_settle_peers(m);
    memcpy(m->own, m->next_own, m->next_count * sizeof *m->own);
    memcpy(m->box_of, m->next_box_of, m->next_count * sizeof *m->box_of);
    m->own_count = m->next_count;
    if (m->has_next_boxes) {
        dm_box *boxes = m->boxes;
        m->boxes = m->next_boxes;
        m->next_boxes = boxes;
        m->has_next_boxes = false;
    }
    dm_count_copies(m);
}

void dm_restore(deldrift_mpi *m) {
    dm_withdraw(m);
    dm_unbind(m);
    dm_restore_peers(m);
    m->has_next_boxes = m->has_dropped = false;
    memset(m->is_leaving, 0, m->ids);
    dm_copy_points(m);
}
