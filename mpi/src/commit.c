// Staging, and a commit of all processes.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

// The boxes are made anew, rather than fitted, where they have grown so much.
static const double MOST_GROWTH = 1.1;

deldrift_status deldrift_mpi_stage_insertions(deldrift_mpi *m, const double *positions, const uint64_t *ids,
                                              size_t count) {
    if (!m) return dm_no_handle();
    dm_refusal refusal = {DELDRIFT_OK, ""};
    if (count && !ids) dm_refuse(&refusal, DELDRIFT_NULL_ARGUMENT, "ids is NULL, and count is %zu", count);
    dm_check_points(&refusal, "positions", m->dimension, positions, count, NULL);
    if (refusal.status != DELDRIFT_OK) return dm_fail(&refusal);
    uint32_t d = m->dimension;
    size_t needed = m->insertion_count + count, room = m->insertion_room, wrap_room = room;
    if (!dm_reserve(&refusal, &m->insertion_positions, &room, needed, d * sizeof(double)) ||
        (m->lattice.rank && !dm_reserve(&refusal, &m->insertion_wraps, &wrap_room, needed, d * sizeof(int64_t))) ||
        !dm_reserve(&refusal, &m->insertion_ids, &m->insertion_room, needed, sizeof *ids))
        return dm_fail(&refusal);
    if (m->lattice.rank) {
        size_t first = m->insertion_count * d;
        if (!dm_wrap(&refusal, &m->lattice, positions, NULL, count, m->insertion_positions + first,
                     m->insertion_wraps + first))
            return dm_fail(&refusal);
    } else if (count) {
        memcpy(m->insertion_positions + m->insertion_count * d, positions, count * d * sizeof(double));
    }
    if (count) {
        memcpy(m->insertion_ids + m->insertion_count, ids, count * sizeof *ids);
    }
    m->insertion_count = needed;
    return DELDRIFT_OK;
}

static void unmark(deldrift_mpi *m, const uint32_t *places, size_t count) {
    for (size_t k = 0; k < count; k++) m->is_removal[places[k]] = 0;
}

deldrift_status deldrift_mpi_stage_removals(deldrift_mpi *m, const uint32_t *places, size_t count) {
    if (!m) return dm_no_handle();
    dm_refusal refusal = {DELDRIFT_OK, ""};
    if (count && !places) dm_refuse(&refusal, DELDRIFT_NULL_ARGUMENT, "places is NULL, and count is %zu", count);
    if (refusal.status != DELDRIFT_OK ||
        !dm_reserve(&refusal, &m->is_removal, &m->removal_room, m->own_count, sizeof *m->is_removal))
        return dm_fail(&refusal);
    if (!m->removal_count && m->own_count) memset(m->is_removal, 0, m->own_count);
    for (size_t k = 0; k < count; k++) {
        if (places[k] >= m->own_count)
            dm_refuse(&refusal, DELDRIFT_NO_SUCH_VERTEX, "entry %zu of places is %u, and there are %zu own vertices", k,
                      places[k], m->own_count);
        else if (m->is_removal[places[k]])
            dm_refuse(&refusal, DELDRIFT_STAGED_VERTEX, "entry %zu of places is %u, whose removal is staged already", k,
                      places[k]);
        if (refusal.status != DELDRIFT_OK) {
            unmark(m, places, k);
            return dm_fail(&refusal);
        }
        m->is_removal[places[k]] = 1;
    }
    m->removal_count += count;
    return DELDRIFT_OK;
}

deldrift_status deldrift_mpi_discard(deldrift_mpi *m) {
    if (!m) return dm_no_handle();
    m->insertion_count = m->removal_count = 0;
    return DELDRIFT_OK;
}

static bool is_removed(const deldrift_mpi *m, size_t place) {
    return m->removal_count && m->is_removal[place];
}

static const double *position_of(const deldrift_mpi *m, const double *positions, size_t place) {
    uint32_t d = m->dimension;
    return positions ? positions + place * d : m->where + (size_t)m->own[place] * d;
}

// The list of own vertices as it will be, where they will be, and the boxes that those are in which there are already.
static bool make_next(deldrift_mpi *m, const double *positions) {
    uint32_t d = m->dimension;
    m->next_count = m->own_count - m->removal_count + m->insertion_count;
    if (!dm_reserve_own(m, m->own_count > m->next_count ? m->own_count : m->next_count) ||
        !dm_reserve(&m->refusal, &m->moved, &m->moved_room, m->ids, sizeof *m->moved))
        return false;
    bool is_copied = !positions || m->removal_count || m->insertion_count;
    m->points = is_copied ? m->next_points : positions;
    size_t next = 0;
    for (size_t i = 0; i < m->own_count; i++) {
        if (is_removed(m, i)) continue;
        m->next_own[next] = m->own[i];
        m->next_box_of[next] = m->box_of[i];
        if (is_copied) memcpy(m->next_points + next * d, position_of(m, positions, i), d * sizeof(double));
        if (m->lattice.rank) memcpy(m->next_wraps + next * d, m->home_wraps + i * d, d * sizeof *m->next_wraps);
        next++;
    }
    if (m->insertion_count)
        memcpy(m->next_points + next * d, m->insertion_positions, m->insertion_count * d * sizeof(double));
    if (m->insertion_count && m->lattice.rank)
        memcpy(m->next_wraps + next * d, m->insertion_wraps, m->insertion_count * d * sizeof *m->next_wraps);
    return true;
}

// Whether no own vertex leaves the boxes that other processes know; finds those of vertices to be inserted.
static bool fits(deldrift_mpi *m) {
    const dm_box *boxes = m->boxes + (size_t)m->rank * m->options.boxes;
    size_t kept = m->next_count - m->insertion_count;
    for (size_t i = 0; i < m->next_count; i++) {
        const double *point = m->points + i * m->dimension;
        if (i < kept && dm_is_in_box(m, &boxes[m->next_box_of[i]], point)) continue;
        uint32_t b = 0;
        while (b < m->options.boxes && !dm_is_in_box(m, &boxes[b], point)) b++;
        if (b == m->options.boxes) return false;
        m->next_box_of[i] = (uint16_t)b;
    }
    return true;
}

static void share_new_boxes(deldrift_mpi *m) {
    dm_box own[DM_MAX_BOXES];
    bool is_fitted = !m->insertion_count;
    if (is_fitted) dm_fit_boxes(m, own, m->next_box_of);
    if (!is_fitted || !(dm_boxes_extent(m, own) <= MOST_GROWTH * m->extent)) dm_make_boxes(m, own, m->next_box_of);
    dm_share_boxes(m, own);
}

// Own vertices that move: to `where`, and on the list.
static void take_positions(deldrift_mpi *m, const double *positions) {
    uint32_t d = m->dimension;
    m->displacement = 0;
    for (size_t i = 0; positions && i < m->own_count; i++) {
        if (is_removed(m, i)) continue;
        double *where = m->where + (size_t)m->own[i] * d;
        const double *position = positions + i * d;
        bool has_moved = false;
        for (uint32_t k = 0; k < d; k++) {
            if (where[k] == position[k]) continue;
            has_moved = true;
            m->displacement = fmax(m->displacement, fabs(position[k] - where[k]));
            where[k] = position[k];
        }
        if (has_moved) m->moved[m->moved_count++] = m->own[i];
    }
}

static bool moves(const deldrift_mpi *m, const double *positions) {
    uint32_t d = m->dimension;
    for (size_t i = 0; positions && i < m->own_count; i++) {
        const double *where = m->where + (size_t)m->own[i] * d;
        for (uint32_t k = 0; k < d && !is_removed(m, i); k++)
            if (where[k] != positions[i * d + k]) return true;
    }
    return false;
}

// Removals of own vertices, and of copies that their owners have removed or need not be here any more.
static bool stage_leaving(deldrift_mpi *m) {
    size_t count = 0, most = m->removal_count;
    for (size_t p = 0; p < m->peer_count; p++) most += m->peers[p].received.count;
    if (!dm_reserve(&m->refusal, &m->vertices, &m->vertex_room, most, sizeof *m->vertices) ||
        !dm_reserve(&m->refusal, &m->undo, &m->undo_room, m->undo_count + most, sizeof *m->undo))
        return false;
    for (size_t i = 0; m->removal_count && i < m->own_count; i++)
        if (m->is_removal[i]) m->vertices[count++] = m->own[i];
    for (size_t p = 0; p < m->peer_count; p++) {
        const dm_list *received = &m->peers[p].received;
        for (size_t k = 0; k < received->count; k++)
            if (received->is_leaving[k]) m->vertices[count++] = received->at[k];
    }
    if (!dm_took(&m->refusal, deldrift_stage_removals(m->t, m->vertices, count))) return false;
    for (size_t k = 0; k < count; k++) dm_unset_vertex(m, m->vertices[k]);
    return true;
}

static bool stage_insertions(deldrift_mpi *m) {
    uint32_t d = m->dimension;
    size_t count = m->insertion_count, kept = m->next_count - count;
    if (!count) return true;
    if (!dm_reserve(&m->refusal, &m->vertices, &m->vertex_room, count, sizeof *m->vertices) ||
        !dm_insert(m, m->insertion_positions, m->insertion_ids, count))
        return false;
    for (size_t k = 0; k < count; k++) {
        m->next_own[kept + k] = m->vertices[k];
        dm_set_vertex(m, m->vertices[k], m->rank, 0, m->insertion_ids[k], m->insertion_positions + k * d);
    }
    return true;
}

static bool stage_moves(deldrift_mpi *m) {
    uint32_t d = m->dimension;
    if (m->moved_count > m->ids / 4) return dm_took(&m->refusal, deldrift_move_vertices(m->t, NULL, m->where, m->ids));
    if (!dm_reserve(&m->refusal, &m->coordinates, &m->coordinate_room, m->moved_count * d, sizeof *m->coordinates))
        return false;
    for (size_t k = 0; k < m->moved_count; k++)
        memcpy(m->coordinates + k * d, m->where + (size_t)m->moved[k] * d, d * sizeof(double));
    return dm_took(&m->refusal, deldrift_move_vertices(m->t, m->moved, m->coordinates, m->moved_count));
}

// Each process decides for its own vertices: the exchange tells who drops.
static bool is_time_to_drop(const deldrift_mpi *m) {
    uint64_t copies = 0;
    for (size_t p = 0; p < m->peer_count; p++) copies += m->peers[p].sent.count;
    return m->options.drop_percent < UINT32_MAX && m->sent_since_drop * 100 > copies * m->options.drop_percent;
}

// From what all have agreed to do to what all have, or none; with other vectors, or NULL.
static deldrift_status advance(deldrift_mpi *m, const double *positions, bool has_new_boxes, dm_strain *strain) {
    m->has_dropped = is_time_to_drop(m);
    if (m->has_dropped) dm_find_drops(m);
    if (strain) dm_strain_copies(m, strain);
    m->moved_count = 0;
    take_positions(m, positions);
    if (has_new_boxes) share_new_boxes(m);
    for (size_t i = 0; m->removal_count && i < m->own_count; i++) m->is_leaving[m->own[i]] = m->is_removal[i];
    dm_exchange_positions(m);
    if (m->refusal.status == DELDRIFT_OK && stage_leaving(m) && stage_insertions(m) && stage_moves(m)) dm_prepare(m);
    deldrift_status status = dm_rounds(m);
    if (status != DELDRIFT_OK) {
        dm_restore(m);
        if (strain) dm_unstrain_copies(m, strain);
        return status;
    }
    dm_settle(m);
    m->insertion_count = m->removal_count = 0;
    return DELDRIFT_OK;
}

static void finish(deldrift_mpi *m) {
    if (m->lattice.rank && m->own_count)
        memcpy(m->wraps, m->next_wraps, m->own_count * m->dimension * sizeof *m->wraps);
    dm_count_copies(m);
    m->was_spanning = m->report.is_spanning;
    m->report.timestamp = ++m->timestamp;
}

deldrift_status dm_commit_strain(deldrift_mpi *m, const double *positions, const double *vectors, bool *is_done) {
    memset(&m->refusal, 0, sizeof m->refusal);
    memset(&m->report, 0, sizeof m->report);
    *is_done = false;
    dm_strain strain;
    int64_t numbers[4] = {0};
    if (dm_make_strain(&m->refusal, m, vectors, &strain)) {
        numbers[0] = !dm_can_strain(m, &strain);
        if (!numbers[0] && dm_come_home(m, &strain.lattice, &positions) && make_next(m, positions) &&
            dm_make_peers_ready(m))
            numbers[1] = !fits(m);
    }
    dm_vote vote = dm_decide(m->comm, &m->refusal, numbers);
    m->report.collectives++;
    deldrift_status status = vote.status;
    if (status == DELDRIFT_OK && !vote.most[0]) {
        status = advance(m, positions, vote.most[1], &strain);
        *is_done = status == DELDRIFT_OK;
        if (*is_done) finish(m);
    }
    dm_free_strain(&strain);
    return status;
}

deldrift_status deldrift_mpi_commit(deldrift_mpi *m, const double *positions, size_t count,
                                    deldrift_mpi_report *report) {
    if (!m) return dm_no_handle();
    memset(&m->refusal, 0, sizeof m->refusal);
    memset(&m->report, 0, sizeof m->report);
    m->report.is_spanning = m->was_spanning;
    bool is_legal = true;
    if ((positions || count) && count != m->own_count) {
        dm_refuse(&m->refusal, DELDRIFT_WRONG_COUNT, "count is %zu, and there are %zu own vertices", count,
                  m->own_count);
        is_legal = false;
    } else {
        is_legal = dm_check_points(&m->refusal, "positions", m->dimension, positions, count,
                                   m->removal_count ? m->is_removal : NULL);
    }
    if (is_legal && m->lattice.rank) is_legal = dm_come_home(m, &m->lattice, &positions);
    int64_t numbers[4] = {0};
    if (is_legal && make_next(m, positions) && dm_make_peers_ready(m)) {
        numbers[0] = m->insertion_count || m->removal_count || moves(m, positions);
        numbers[1] = numbers[0] && !fits(m);
    }
    dm_vote vote = dm_decide(m->comm, &m->refusal, numbers);
    m->report.collectives++;
    deldrift_status status = vote.status;
    if (status == DELDRIFT_OK && vote.most[0]) status = advance(m, positions, vote.most[1], NULL);
    if (status != DELDRIFT_OK) return status;
    finish(m);
    if (report) *report = m->report;
    return DELDRIFT_OK;
}
