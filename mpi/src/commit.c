// Staging, and a commit of all processes.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

// The boxes are made anew, rather than fitted, where they have grown so much.
static const double MOST_GROWTH = 1.1;

// The points of insertions, behind those that are staged, where there is room.
static bool place_insertions(deldrift_mpi *m, dm_refusal *refusal, const double *positions, const double *weights,
                             size_t count) {
    uint32_t d = m->dimension;
    double *points = m->insertion_points + m->insertion_count * m->row;
    if (!count) return true;
    if (!m->lattice.rank) {
        dm_zip(d, m->row, positions, weights, count, points);
        return true;
    }
    double *home = dm_allocate(refusal, count * d, sizeof *home);
    bool are_home = home && dm_wrap(refusal, &m->lattice, positions, NULL, count, home,
                                    m->insertion_wraps + m->insertion_count * d);
    if (are_home) dm_zip(d, m->row, home, weights, count, points);
    free(home);
    return are_home;
}

static deldrift_status stage(deldrift_mpi *m, dm_refusal *refusal, const double *positions, const double *weights,
                             const uint64_t *ids, size_t count) {
    if (count && !ids) dm_refuse(refusal, DELDRIFT_NULL_ARGUMENT, "ids is NULL, and count is %zu", count);
    dm_check_points(refusal, "positions", m->dimension, positions, count, NULL);
    dm_check_weights(refusal, weights, count, NULL);
    if (refusal->status != DELDRIFT_OK) return dm_fail(refusal);
    size_t needed = m->insertion_count + count, room = m->insertion_room, wrap_room = room, wrap = sizeof(int64_t);
    if (!dm_reserve(refusal, &m->insertion_points, &room, needed, m->row * sizeof(double)) ||
        (m->lattice.rank && !dm_reserve(refusal, &m->insertion_wraps, &wrap_room, needed, m->dimension * wrap)) ||
        !dm_reserve(refusal, &m->insertion_ids, &m->insertion_room, needed, sizeof *ids) ||
        !place_insertions(m, refusal, positions, weights, count))
        return dm_fail(refusal);
    if (count) memcpy(m->insertion_ids + m->insertion_count, ids, count * sizeof *ids);
    m->insertion_count = needed;
    return DELDRIFT_OK;
}

deldrift_status deldrift_mpi_stage_insertions(deldrift_mpi *m, const double *positions, const uint64_t *ids,
                                              size_t count) {
    dm_refusal refusal = {DELDRIFT_OK, ""};
    return m ? stage(m, &refusal, positions, NULL, ids, count) : dm_no_handle();
}

static void refuse_without_weights(const deldrift_mpi *m, dm_refusal *refusal) {
    if (m->row == m->dimension)
        dm_refuse(refusal, DELDRIFT_NOT_WEIGHTED, "m has no weights, and this function is for those that have");
}

deldrift_status deldrift_mpi_stage_insertions_with_weights(deldrift_mpi *m, const double *positions,
                                                       const double *weights, const uint64_t *ids, size_t count) {
    if (!m) return dm_no_handle();
    dm_refusal refusal = {DELDRIFT_OK, ""};
    refuse_without_weights(m, &refusal);
    return stage(m, &refusal, positions, weights, ids, count);
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

static const double *point_of(const deldrift_mpi *m, const double *points, size_t place) {
    return points ? points + place * m->row : m->where + (size_t)m->own[place] * m->row;
}

// The list of own vertices as it will be, where they will be, and the boxes that those are in which there are already.
static bool make_next(deldrift_mpi *m, const double *points) {
    uint32_t d = m->dimension, row = m->row;
    m->next_count = m->own_count - m->removal_count + m->insertion_count;
    if (!dm_reserve_own(m, m->own_count > m->next_count ? m->own_count : m->next_count) ||
        !dm_reserve(&m->refusal, &m->moved, &m->moved_room, m->ids, sizeof *m->moved))
        return false;
    bool is_copied = !points || m->removal_count || m->insertion_count;
    m->points = is_copied ? m->next_points : points;
    size_t next = 0;
    for (size_t i = 0; i < m->own_count; i++) {
        if (is_removed(m, i)) continue;
        m->next_own[next] = m->own[i];
        m->next_box_of[next] = m->box_of[i];
        if (is_copied) memcpy(m->next_points + next * row, point_of(m, points, i), row * sizeof(double));
        if (m->lattice.rank) memcpy(m->next_wraps + next * d, m->home_wraps + i * d, d * sizeof *m->next_wraps);
        next++;
    }
    if (m->insertion_count)
        memcpy(m->next_points + next * row, m->insertion_points, m->insertion_count * row * sizeof(double));
    if (m->insertion_count && m->lattice.rank)
        memcpy(m->next_wraps + next * d, m->insertion_wraps, m->insertion_count * d * sizeof *m->next_wraps);
    return true;
}

// Whether no own vertex leaves the boxes that other processes know; finds those of vertices to be inserted.
static bool fits(deldrift_mpi *m) {
    const dm_box *boxes = m->boxes + (size_t)m->rank * m->options.boxes;
    size_t kept = m->next_count - m->insertion_count;
    for (size_t i = 0; i < m->next_count; i++) {
        const double *point = m->points + i * m->row;
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

// Own vertices that change: to `where`, and on the list.
static void take_points(deldrift_mpi *m, const double *points) {
    uint32_t d = m->dimension;
    m->displacement = 0;
    for (size_t i = 0; points && i < m->own_count; i++) {
        if (is_removed(m, i)) continue;
        double *where = m->where + (size_t)m->own[i] * m->row;
        const double *point = points + i * m->row;
        bool has_changed = false;
        for (uint32_t k = 0; k < m->row; k++) {
            if (where[k] == point[k]) continue;
            has_changed = true;
            if (k < d) m->displacement = fmax(m->displacement, fabs(point[k] - where[k]));
            where[k] = point[k];
        }
        if (has_changed) m->moved[m->moved_count++] = m->own[i];
    }
}

static bool moves(const deldrift_mpi *m, const double *points) {
    uint32_t row = m->row;
    for (size_t i = 0; points && i < m->own_count; i++) {
        const double *where = m->where + (size_t)m->own[i] * row;
        for (uint32_t k = 0; k < row && !is_removed(m, i); k++)
            if (where[k] != points[i * row + k]) return true;
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
    size_t count = m->insertion_count, kept = m->next_count - count;
    if (!count) return true;
    if (!dm_reserve(&m->refusal, &m->vertices, &m->vertex_room, count, sizeof *m->vertices) ||
        !dm_insert(m, m->insertion_points, m->insertion_ids, count))
        return false;
    for (size_t k = 0; k < count; k++) {
        m->next_own[kept + k] = m->vertices[k];
        dm_set_vertex(m, m->vertices[k], m->rank, 0, m->insertion_ids[k], m->insertion_points + k * m->row);
    }
    return true;
}

static bool stage_moves(deldrift_mpi *m) {
    uint32_t row = m->row;
    const double *points, *weights;
    if (row == m->dimension && m->moved_count > m->ids / 4)
        return dm_took(&m->refusal, deldrift_move_vertices(m->t, NULL, m->where, m->ids));
    if (!dm_reserve(&m->refusal, &m->coordinates, &m->coordinate_room, m->moved_count * row, sizeof *m->coordinates))
        return false;
    for (size_t k = 0; k < m->moved_count; k++)
        memcpy(m->coordinates + k * row, m->where + (size_t)m->moved[k] * row, row * sizeof(double));
    points = m->coordinates;
    return dm_unzip(m, &points, m->moved_count, &weights) &&
           dm_took(&m->refusal, deldrift_move_vertices(m->t, m->moved, points, m->moved_count)) &&
           (!weights || dm_took(&m->refusal, deldrift_stage_weights(m->t, m->moved, weights, m->moved_count)));
}

// Each process decides for its own vertices: the exchange tells who drops.
static bool is_time_to_drop(const deldrift_mpi *m) {
    uint64_t copies = 0;
    for (size_t p = 0; p < m->peer_count; p++) copies += m->peers[p].sent.count;
    return m->options.drop_percent < UINT32_MAX && m->sent_since_drop * 100 > copies * m->options.drop_percent;
}

// From what all have agreed to do to what all have, or none; with other vectors, or NULL.
static deldrift_status advance(deldrift_mpi *m, const double *points, bool has_new_boxes, dm_strain *strain) {
    m->has_dropped = is_time_to_drop(m);
    if (m->has_dropped) dm_find_drops(m);
    if (strain) dm_strain_copies(m, strain);
    m->moved_count = 0;
    take_points(m, points);
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
        if (!numbers[0] && dm_come_home(m, &strain.lattice, &positions) && dm_take_points(m, &positions, NULL) &&
            make_next(m, positions) && dm_make_peers_ready(m))
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

// What is wrong with what a process is given for its own vertices.
static bool check_given(const deldrift_mpi *m, dm_refusal *refusal, const double *positions, const double *weights,
                        size_t count) {
    const uint8_t *is_skipped = m->removal_count ? m->is_removal : NULL;
    if ((positions || weights || count) && count != m->own_count) {
        dm_refuse(refusal, DELDRIFT_WRONG_COUNT, "count is %zu, and there are %zu own vertices", count, m->own_count);
        return false;
    }
    return (!positions && weights) ? dm_check_weights(refusal, weights, count, is_skipped)
                                   : dm_check_points(refusal, "positions", m->dimension, positions, count, is_skipped) &&
                                         dm_check_weights(refusal, weights, count, is_skipped);
}

static deldrift_status commit(deldrift_mpi *m, const double *positions, const double *weights, size_t count,
                              deldrift_mpi_report *report) {
    memset(&m->report, 0, sizeof m->report);
    m->report.is_spanning = m->was_spanning;
    const double *points = positions;
    bool is_legal = check_given(m, &m->refusal, positions, weights, count);
    if (is_legal && m->lattice.rank) is_legal = dm_come_home(m, &m->lattice, &points);
    int64_t numbers[4] = {0};
    if (is_legal && dm_take_points(m, &points, weights) && make_next(m, points) && dm_make_peers_ready(m)) {
        numbers[0] = m->insertion_count || m->removal_count || moves(m, points);
        numbers[1] = numbers[0] && !fits(m);
    }
    dm_vote vote = dm_decide(m->comm, &m->refusal, numbers);
    m->report.collectives++;
    deldrift_status status = vote.status;
    if (status == DELDRIFT_OK && vote.most[0]) status = advance(m, points, vote.most[1], NULL);
    if (status != DELDRIFT_OK) return status;
    finish(m);
    if (report) *report = m->report;
    return DELDRIFT_OK;
}

deldrift_status deldrift_mpi_commit(deldrift_mpi *m, const double *positions, size_t count,
                                    deldrift_mpi_report *report) {
    if (!m) return dm_no_handle();
    memset(&m->refusal, 0, sizeof m->refusal);
    return commit(m, positions, NULL, count, report);
}

deldrift_status deldrift_mpi_commit_weighted(deldrift_mpi *m, const double *positions, const double *weights,
                                             size_t count, deldrift_mpi_report *report) {
    if (!m) return dm_no_handle();
    memset(&m->refusal, 0, sizeof m->refusal);
    refuse_without_weights(m, &m->refusal);
    return commit(m, positions, weights, count, report);
}
