// Memory that may be refused. A process that is refused goes on to the next reduction, where all hear of it.
#include <stdlib.h>
#include <string.h>

#include "internal.h"

#ifdef DELDRIFT_MPI_TESTING
int deldrift_mpi_fault = DM_FAULT_NONE;
long deldrift_mpi_allocations_left = -1;
bool deldrift_mpi_is_preparing = false;
long deldrift_mpi_asked = 0;

static void *reallocate(void *old, size_t bytes) {
    if (deldrift_mpi_allocations_left == 0) return NULL;
    if (deldrift_mpi_allocations_left > 0) deldrift_mpi_allocations_left--;
    return realloc(old, bytes);
}
#else
static void *reallocate(void *old, size_t bytes) {
    return realloc(old, bytes);
}
#endif

bool dm_reserve(dm_refusal *refusal, void *array, size_t *room, size_t needed, size_t size) {
    if (needed <= *room) return true;
    size_t larger = needed + needed / 4 + 16;
    void *old, *grown = NULL;
    memcpy(&old, array, sizeof old);
    if (larger > needed && larger <= SIZE_MAX / size) grown = reallocate(old, larger * size);
    if (!grown) {
        dm_refuse(refusal, DELDRIFT_OUT_OF_MEMORY, "no memory for %zu entries of %zu bytes", needed, size);
        return false;
    }
    memcpy(array, &grown, sizeof grown);
    *room = larger;
    return true;
}

void *dm_allocate(dm_refusal *refusal, size_t count, size_t size) {
    void *array = NULL;
    size_t room = 0;
    if (!dm_reserve(refusal, &array, &room, count ? count : 1, size)) return NULL;
    memset(array, 0, room * size);
    return array;
}

bool dm_reserve_list(dm_refusal *refusal, dm_list *list, size_t needed) {
    size_t room = list->capacity;
    size_t other_room = list->capacity;
    if (!dm_reserve(refusal, &list->is_leaving, &room, needed, 1) ||
        !dm_reserve(refusal, &list->period, &other_room, needed, sizeof *list->period))
        return false;
    return dm_reserve(refusal, &list->at, &list->capacity, needed, sizeof *list->at);
}

// There is an array also for no ids, or own vertices: copies of nothing need an address.
bool dm_reserve_ids(deldrift_mpi *m, size_t ids) {
    if (ids > m->ids_room || !m->ids_room) {
        size_t room[8];
        for (int k = 0; k < 8; k++) room[k] = m->ids_room;
        dm_refusal *r = &m->refusal;
        size_t needed = ids ? ids : 1;
        if (!dm_reserve(r, &m->id_of, &room[0], needed, sizeof *m->id_of) ||
            !dm_reserve(r, &m->owner_of, &room[1], needed, sizeof *m->owner_of) ||
            !dm_reserve(r, &m->is_own, &room[2], needed, 1) || !dm_reserve(r, &m->is_leaving, &room[3], needed, 1) ||
            !dm_reserve(r, &m->where, &room[4], needed, m->row * sizeof *m->where) ||
            (m->row > m->dimension && !dm_reserve(r, &m->weight_of, &room[7], needed, sizeof *m->weight_of)) ||
            !dm_reserve(r, &m->stamp, &room[5], needed, sizeof *m->stamp) ||
            !dm_reserve(r, &m->period_of, &room[6], needed, sizeof *m->period_of))
            return false;
        m->ids_room = room[0];
    }
    for (; m->ids < ids; m->ids++) {
        m->id_of[m->ids] = 0;
        m->owner_of[m->ids] = -1;
        m->period_of[m->ids] = 0;
        m->is_own[m->ids] = 0;
        m->is_leaving[m->ids] = 0;
        m->stamp[m->ids] = 0;
    }
    return true;
}

bool dm_reserve_own(deldrift_mpi *m, size_t count) {
    if (!count) count = 1;
    if (count > m->own_room) {
        size_t room[6] = {m->own_room, m->own_room, m->own_room, m->own_room, m->own_room, m->own_room};
        size_t wrap = m->dimension * sizeof *m->wraps;
        dm_refusal *r = &m->refusal;
        if (!dm_reserve(r, &m->own, &room[0], count, sizeof *m->own) ||
            !dm_reserve(r, &m->box_of, &room[1], count, sizeof *m->box_of) ||
            !dm_reserve(r, &m->next_own, &room[2], count, sizeof *m->next_own) ||
            !dm_reserve(r, &m->next_box_of, &room[3], count, sizeof *m->next_box_of) ||
            (m->lattice.rank && (!dm_reserve(r, &m->wraps, &room[4], count, wrap) ||
                                 !dm_reserve(r, &m->next_wraps, &room[5], count, wrap))))
            return false;
        m->own_room = room[0];
    }
    return dm_reserve(&m->refusal, &m->next_points, &m->next_room, count, m->row * sizeof *m->next_points);
}
