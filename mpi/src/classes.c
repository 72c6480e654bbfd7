// Own cells that have come and gone in a periodic box. A cell is its vertices with their shifts from each other, as the
// owners of these give positions. Own cells are read as a whole, and looked up among those of the time when changes
// were last taken.
#include <stdlib.h>
#include <string.h>

#include "internal.h"

// The corners of a cell in any order, in which those of one id are told apart by their shifts.
typedef struct {
    uint64_t id;
    int64_t shift[3];
} corner;

static int compare(const corner *a, const corner *b) {
    if (a->id != b->id) return a->id < b->id ? -1 : 1;
    for (int k = 0; k < 3; k++)
        if (a->shift[k] != b->shift[k]) return a->shift[k] < b->shift[k] ? -1 : 1;
    return 0;
}

// The corners of a cell in the order of its row, by their shifts from the first of them in the order of ids and shifts:
// the same for all cells that are translations of each other.
static void read_corners(const deldrift_mpi *m, const uint32_t *vertices, const int64_t *periods, corner *row) {
    uint32_t d = m->dimension, first = 0;
    memset(row, 0, (d + 1) * sizeof *row);
    for (uint32_t i = 0; i <= d; i++) {
        row[i].id = m->id_of[vertices[i]];
        memcpy(row[i].shift, periods + (size_t)vertices[i] * d, d * sizeof *periods);
        if (i && compare(&row[i], &row[first]) < 0) first = i;
    }
    corner origin = row[first];
    for (uint32_t i = 0; i <= d; i++)
        for (uint32_t k = 0; k < d; k++) row[i].shift[k] -= origin.shift[k];
}

static void sort_corners(uint32_t d, corner *row) {
    for (uint32_t i = 1; i <= d; i++) {
        for (uint32_t j = i; j > 0 && compare(&row[j], &row[j - 1]) < 0; j--) {
            corner kept = row[j];
            row[j] = row[j - 1];
            row[j - 1] = kept;
        }
    }
}

static void write_corners(uint32_t d, const corner *row, uint64_t *ids, int64_t *shifts) {
    for (uint32_t i = 0; i <= d; i++) {
        ids[i] = row[i].id;
        memcpy(shifts + i * d, row[i].shift, d * sizeof *shifts);
    }
}

static uint64_t mix(uint64_t sum, uint64_t word) {
    uint64_t z = (sum ^ word) * 0x9e3779b97f4a7c15u;
    return z ^ z >> 32;
}

// Where in the table a cell is, or is to be.
static size_t slot_of(const dm_classes *classes, uint32_t d, const uint64_t *ids, const int64_t *shifts) {
    size_t length = d + 1, slot;
    uint64_t sum = 0;
    for (size_t i = 0; i < length; i++) sum = mix(sum, ids[i]);
    for (size_t i = 0; i < length * d; i++) sum = mix(sum, (uint64_t)shifts[i]);
    for (slot = (size_t)sum & (classes->slots - 1); classes->table[slot]; slot = (slot + 1) & (classes->slots - 1)) {
        size_t c = classes->table[slot] - 1;
        if (!memcmp(classes->ids + c * length, ids, length * sizeof *ids) &&
            !memcmp(classes->shifts + c * length * d, shifts, length * d * sizeof *shifts))
            break;
    }
    return slot;
}

static bool make_room(dm_refusal *refusal, dm_classes *classes, uint32_t d, size_t count) {
    size_t length = d + 1;
    classes->slots = 4;
    while (classes->slots < 2 * count) classes->slots *= 2;
    classes->ids = dm_allocate(refusal, count * length, sizeof *classes->ids);
    classes->shifts = dm_allocate(refusal, count * length * d, sizeof *classes->shifts);
    classes->table = dm_allocate(refusal, classes->slots, sizeof *classes->table);
    return refusal->status == DELDRIFT_OK;
}

void dm_free_classes(dm_classes *classes) {
    free(classes->ids);
    free(classes->shifts);
    free(classes->table);
    memset(classes, 0, sizeof *classes);
}

static bool is_owned(const deldrift_mpi *m, const deldrift_cells_view *view, size_t cell) {
    const uint32_t *vertices = view->vertices + cell * view->corners_per_cell;
    return m->is_own[dm_least(m, vertices, view->corners_per_cell)];
}

// Own cells, in the order of the triangulation. What was there before is marked in `stays`.
static size_t read_classes(const deldrift_mpi *m, const deldrift_cells_view *view, const int64_t *periods,
                           dm_classes *classes, uint8_t *stays) {
    uint32_t d = m->dimension, length = d + 1;
    size_t created = 0;
    for (size_t c = 0; c < view->count; c++) {
        if (!is_owned(m, view, c)) continue;
        corner row[4];
        read_corners(m, view->vertices + c * length, periods, row);
        sort_corners(d, row);
        uint64_t *ids = classes->ids + classes->count * length;
        int64_t *shifts = classes->shifts + classes->count * length * d;
        write_corners(d, row, ids, shifts);
        classes->table[slot_of(classes, d, ids, shifts)] = (uint32_t)++classes->count;
        size_t before = m->told.count ? m->told.table[slot_of(&m->told, d, ids, shifts)] : 0;
        if (before)
            stays[before - 1] = 1;
        else
            created++;
    }
    return created;
}

static bool make_lists(deldrift_mpi *m, dm_refusal *refusal, size_t created, size_t removed) {
    size_t length = m->dimension + 1, row = length * m->dimension;
    return dm_reserve(refusal, &m->created, &m->created_room, created, length * sizeof *m->created) &&
           dm_reserve(refusal, &m->created_cells, &m->created_cell_room, created, sizeof *m->created_cells) &&
           dm_reserve(refusal, &m->removed, &m->removed_room, removed, length * sizeof *m->removed) &&
           dm_reserve(refusal, &m->created_shifts, &m->created_shift_room, created, row * sizeof *m->created_shifts) &&
           dm_reserve(refusal, &m->removed_shifts, &m->removed_shift_room, removed, row * sizeof *m->removed_shifts);
}

static void fill_lists(deldrift_mpi *m, const deldrift_cells_view *view, const int64_t *periods,
                       const dm_classes *classes, const uint8_t *stays) {
    uint32_t d = m->dimension, length = d + 1;
    size_t own = 0, created = 0, removed = 0;
    for (size_t c = 0; c < view->count; c++) {
        if (!is_owned(m, view, c)) continue;
        const uint64_t *ids = classes->ids + own * length;
        const int64_t *shifts = classes->shifts + own++ * length * d;
        if (m->told.count && m->told.table[slot_of(&m->told, d, ids, shifts)]) continue;
        corner row[4];
        read_corners(m, view->vertices + c * length, periods, row);
        write_corners(d, row, m->created + created * length, m->created_shifts + created * length * d);
        m->created_cells[created++] = (uint32_t)c;
    }
    for (size_t c = 0; c < m->told.count; c++) {
        if (stays[c]) continue;
        memcpy(m->removed + removed * length, m->told.ids + c * length, length * sizeof *m->removed);
        memcpy(m->removed_shifts + removed++ * length * d, m->told.shifts + c * length * d,
               length * d * sizeof *m->removed_shifts);
    }
    m->changes.created_count = created;
    m->changes.removed_count = removed;
}

deldrift_status dm_take_classes(deldrift_mpi *m, dm_refusal *refusal) {
    dm_classes now;
    deldrift_cells_view view;
    int64_t *periods = NULL;
    size_t own = 0, created = 0, staying = 0;
    memset(&now, 0, sizeof now);
    uint8_t *stays = dm_allocate(refusal, m->told.count, sizeof *stays);
    if (dm_took(refusal, deldrift_cells(m->t, &view))) {
        for (size_t c = 0; c < view.count; c++) own += is_owned(m, &view, c);
        make_room(refusal, &now, m->dimension, own);
    }
    deldrift_status status = dm_read_periods(m, refusal, &periods);
    if (status == DELDRIFT_OK) {
        created = read_classes(m, &view, periods, &now, stays);
        for (size_t c = 0; c < m->told.count; c++) staying += stays[c];
        make_lists(m, refusal, created, m->told.count - staying);
        status = dm_decide(m->comm, refusal, NULL).status;
    }
    if (status == DELDRIFT_OK) {
        memset(&m->changes, 0, sizeof m->changes);
        fill_lists(m, &view, periods, &now, stays);
        m->changes.is_anew = !m->has_taken;
        m->changes.created_shifts = m->created_shifts;
        m->changes.removed_shifts = m->removed_shifts;
        m->has_taken = true;
        dm_free_classes(&m->told);
        m->told = now;
    } else {
        dm_free_classes(&now);
    }
    free(stays);
    free(periods);
    return status;
}
