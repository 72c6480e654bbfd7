// What the ids of the triangulation stand for: vertices of which process, with which global ids.
#include <string.h>

#include "internal.h"

bool dm_insert(deldrift_mpi *m, const double *points, const uint64_t *ids, size_t count) {
    if (DM_HAS_FAULT(DM_FAULT_LOCAL_KEYS)) ids = NULL;
    const double *weights;
    if (!dm_unzip(m, &points, count, &weights)) return false;
    deldrift_status status = deldrift_stage_insertions_at_free_ids(m->t, points, ids, count, m->vertices);
    if (status == DELDRIFT_OK && weights) status = deldrift_stage_weights(m->t, m->vertices, weights, count);
    size_t id_count = 0;
    if (status == DELDRIFT_OK) status = deldrift_id_count(m->t, &id_count);
    if (!dm_took(&m->refusal, status)) return false;
    return dm_reserve_ids(m, id_count) &&
           dm_reserve(&m->refusal, &m->undo, &m->undo_room, m->undo_count + count, sizeof *m->undo);
}

static void note(deldrift_mpi *m, uint32_t vertex) {
    m->undo[m->undo_count++] = (dm_undo){vertex, m->owner_of[vertex], m->period_of[vertex], m->id_of[vertex], 0};
}

static void bind(deldrift_mpi *m, uint32_t vertex, int32_t owner, uint32_t period, uint64_t id) {
    m->owner_of[vertex] = owner;
    m->period_of[vertex] = period;
    m->id_of[vertex] = id;
    m->is_own[vertex] = owner == m->rank && period == 0;
}

void dm_set_vertex(deldrift_mpi *m, uint32_t vertex, int32_t owner, uint32_t period, uint64_t id,
                   const double *point) {
    note(m, vertex);
    bind(m, vertex, owner, period, id);
    m->is_leaving[vertex] = 0;
    memcpy(m->where + (size_t)vertex * m->row, point, m->row * sizeof *point);
}

void dm_unset_vertex(deldrift_mpi *m, uint32_t vertex) {
    note(m, vertex);
    m->owner_of[vertex] = -1;
    m->is_own[vertex] = 0;
}

void dm_unbind(deldrift_mpi *m) {
    while (m->undo_count) {
        dm_undo undo = m->undo[--m->undo_count];
        bind(m, undo.vertex, undo.owner, undo.period, undo.id);
    }
}
