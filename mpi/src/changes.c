// Own cells that have come and gone, by global ids. The triangulation of the process tells them by its own ids, which
// may have been given to other vertices meanwhile.
#include <stdlib.h>
#include <string.h>

#include "internal.h"

// What an id stood for when changes were last taken; those of one id in the order in which they were noted.
static int compare_notes(const void *first, const void *second) {
    const dm_undo *a = first, *b = second;
    if (a->vertex != b->vertex) return a->vertex < b->vertex ? -1 : 1;
    return a->order < b->order ? -1 : a->order > b->order;
}

void dm_note_rebound(deldrift_mpi *m) {
    // In a periodic box cells are compared with those that there were.
    if (!m->has_taken || m->lattice.rank) return;
    if (!dm_reserve(&m->refusal, &m->rebound, &m->rebound_room, m->rebound_count + m->undo_count, sizeof *m->rebound)) {
        // The commit stands: all is told anew by the next list.
        memset(&m->refusal, 0, sizeof m->refusal);
        m->has_taken = false;
        return;
    }
    for (size_t k = 0; k < m->undo_count; k++) {
        dm_undo *note = &m->rebound[m->rebound_count];
        *note = m->undo[k];
        note->order = m->rebound_count++;
    }
}

// The first note of each id remains.
static void sort_notes(deldrift_mpi *m) {
    size_t kept = 0;
    if (m->rebound_count) qsort(m->rebound, m->rebound_count, sizeof *m->rebound, compare_notes);
    for (size_t k = 0; k < m->rebound_count; k++)
        if (!kept || m->rebound[kept - 1].vertex != m->rebound[k].vertex) m->rebound[kept++] = m->rebound[k];
    m->rebound_count = kept;
}

static const dm_undo *note_of(const deldrift_mpi *m, uint32_t vertex) {
    size_t low = 0, high = m->rebound_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (m->rebound[middle].vertex < vertex)
            low = middle + 1;
        else
            high = middle;
    }
    return low < m->rebound_count && m->rebound[low].vertex == vertex ? &m->rebound[low] : NULL;
}

// The ids of a row of corners, as they are or as they were, and whether the least one is own.
static bool translate(const deldrift_mpi *m, const uint32_t *corners, bool is_former, uint64_t *ids) {
    bool is_own = false;
    uint64_t least = 0;
    for (uint32_t i = 0; i <= m->dimension; i++) {
        const dm_undo *note = is_former ? note_of(m, corners[i]) : NULL;
        ids[i] = note ? note->id : m->id_of[corners[i]];
        if (i && ids[i] > least) continue;
        least = ids[i];
        is_own = (note ? note->owner : m->owner_of[corners[i]]) == m->rank;
    }
    return is_own;
}

static bool add_created(deldrift_mpi *m, const uint32_t *corners, uint32_t cell) {
    uint32_t length = m->dimension + 1;
    size_t count = m->changes.created_count;
    if (!dm_reserve(&m->refusal, &m->created, &m->created_room, count + 1, length * sizeof *m->created) ||
        !dm_reserve(&m->refusal, &m->created_cells, &m->created_cell_room, count + 1, sizeof *m->created_cells))
        return false;
    m->created_cells[count] = cell;
    m->changes.created_count += translate(m, corners, false, m->created + count * length);
    return true;
}

static bool add_removed(deldrift_mpi *m, const uint32_t *corners) {
    uint32_t length = m->dimension + 1;
    size_t count = m->changes.removed_count;
    if (!dm_reserve(&m->refusal, &m->removed, &m->removed_room, count + 1, length * sizeof *m->removed)) return false;
    m->changes.removed_count += translate(m, corners, true, m->removed + count * length);
    return true;
}

static bool is_listed(const uint32_t *list, size_t count, uint32_t cell) {
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (list[middle] < cell)
            low = middle + 1;
        else
            high = middle;
    }
    return low < count && list[low] == cell;
}

// Whether the cell is to be looked at for this vertex: it is the first of the corners whose ids stand for others.
static bool is_first_rebound(const deldrift_mpi *m, const uint32_t *corners, uint32_t vertex) {
    for (uint32_t i = 0; i <= m->dimension; i++) {
        if (corners[i] == vertex) return true;
        if (note_of(m, corners[i])) return false;
    }
    return false;
}

// Cells that are there as before by their ids, of which one stands for another vertex.
static bool look_at_rebound(deldrift_mpi *m, const deldrift_changes *changes, const deldrift_cells_view *view) {
    for (size_t k = 0; k < m->rebound_count; k++) {
        uint32_t v = m->rebound[k].vertex;
        size_t count = 0;
        if (m->rebound[k].owner < 0 || m->owner_of[v] < 0) continue;
        deldrift_status status = deldrift_star(m->t, v, NULL, 0, &count);
        if (!dm_took(&m->refusal, status) ||
            !dm_reserve(&m->refusal, &m->vertices, &m->vertex_room, count, sizeof *m->vertices) ||
            !dm_took(&m->refusal, deldrift_star(m->t, v, m->vertices, m->vertex_room, &count)))
            return false;
        for (size_t i = 0; i < count; i++) {
            const uint32_t *corners = view->vertices + (size_t)m->vertices[i] * view->corners_per_cell;
            if (is_listed(changes->created, changes->created_count, m->vertices[i])) continue;
            if (!is_first_rebound(m, corners, v)) continue;
            if (!add_removed(m, corners) || !add_created(m, corners, m->vertices[i])) return false;
        }
    }
    return true;
}

static bool take(deldrift_mpi *m) {
    uint32_t length = m->dimension + 1;
    bool is_anew = !m->has_taken;
    deldrift_changes changes;
    deldrift_cells_view view;
    sort_notes(m);
    if (!dm_took(&m->refusal, deldrift_take_changes(m->t, &changes)) ||
        !dm_took(&m->refusal, deldrift_cells(m->t, &view)))
        return false;
    m->changes.is_anew = is_anew;
    for (size_t c = 0; is_anew && c < view.count; c++)
        if (!add_created(m, view.vertices + c * length, (uint32_t)c)) return false;
    for (size_t k = 0; !is_anew && k < changes.created_count; k++)
        if (!add_created(m, view.vertices + (size_t)changes.created[k] * length, changes.created[k])) return false;
    for (size_t k = 0; !is_anew && k < changes.removed_count; k++)
        if (!add_removed(m, changes.removed_vertices + k * length)) return false;
    return is_anew || look_at_rebound(m, &changes, &view);
}

deldrift_status deldrift_mpi_take_changes(deldrift_mpi *m, deldrift_mpi_changes *changes) {
    if (!m) return dm_no_handle();
    memset(&m->refusal, 0, sizeof m->refusal);
    if (!changes) dm_refuse(&m->refusal, DELDRIFT_NULL_ARGUMENT, "changes is NULL");
    if (m->lattice.rank) {
        deldrift_status status = dm_take_classes(m, &m->refusal);
        if (status != DELDRIFT_OK) return status;
    } else {
        if (!changes) return dm_fail(&m->refusal);
        memset(&m->changes, 0, sizeof m->changes);
        // Where memory is refused after the triangulation has told its changes, the next list is of all.
        m->has_taken = take(m);
        m->rebound_count = 0;
        if (!m->has_taken) return dm_fail(&m->refusal);
    }
    m->changes.created = m->created;
    m->changes.created_cells = m->created_cells;
    m->changes.removed = m->removed;
    *changes = m->changes;
    return DELDRIFT_OK;
}
