// What a program reads of a triangulation.
#include <string.h>

#include "internal.h"

static bool is_given(dm_refusal *refusal, const void *pointer, const char *name) {
    if (!pointer) dm_refuse(refusal, DELDRIFT_NULL_ARGUMENT, "%s is NULL", name);
    return pointer != NULL;
}

// Writes the count, and tells whether the buffers, of which one may be wanted, have room.
static bool has_room(dm_refusal *refusal, bool is_wanted, size_t capacity, size_t needed, size_t *count) {
    if (!is_wanted && capacity) {
        dm_refuse(refusal, DELDRIFT_NULL_ARGUMENT, "the buffers are NULL, and capacity is %zu", capacity);
        return false;
    }
    *count = needed;
    if (is_wanted && capacity < needed)
        dm_refuse(refusal, DELDRIFT_BUFFER_TOO_SMALL, "capacity is %zu, and %zu entries are needed", capacity, needed);
    return is_wanted && capacity >= needed;
}

deldrift_status deldrift_mpi_count(const deldrift_mpi *m, size_t *count) {
    dm_refusal refusal = {DELDRIFT_OK, ""};
    if (is_given(&refusal, m, "m") && is_given(&refusal, count, "count")) *count = m->own_count;
    return dm_fail(&refusal);
}

deldrift_status deldrift_mpi_vertices(const deldrift_mpi *m, uint64_t *ids, uint32_t *vertices, size_t capacity,
                                      size_t *count) {
    dm_refusal refusal = {DELDRIFT_OK, ""};
    if (is_given(&refusal, m, "m") && is_given(&refusal, count, "count") &&
        has_room(&refusal, ids || vertices, capacity, m->own_count, count)) {
        for (size_t i = 0; i < m->own_count; i++) {
            if (ids) ids[i] = m->id_of[m->own[i]];
            if (vertices) vertices[i] = m->own[i];
        }
    }
    return dm_fail(&refusal);
}

deldrift_status deldrift_mpi_local(const deldrift_mpi *m, const deldrift_triangulation **t) {
    dm_refusal refusal = {DELDRIFT_OK, ""};
    if (is_given(&refusal, m, "m") && is_given(&refusal, t, "t")) *t = m->t;
    return dm_fail(&refusal);
}

deldrift_status deldrift_mpi_owners(const deldrift_mpi *m, int32_t *owners, size_t capacity, size_t *count) {
    dm_refusal refusal = {DELDRIFT_OK, ""};
    if (is_given(&refusal, m, "m") && is_given(&refusal, count, "count") &&
        has_room(&refusal, owners != NULL, capacity, m->ids, count) && m->ids)
        memcpy(owners, m->owner_of, m->ids * sizeof *owners);
    return dm_fail(&refusal);
}

static bool is_before(const deldrift_mpi *m, uint32_t v, uint32_t w) {
    if (m->id_of[v] != m->id_of[w]) return m->id_of[v] < m->id_of[w];
    const double *p = m->where + (size_t)v * m->row, *q = m->where + (size_t)w * m->row;
    for (uint32_t k = 0; k < m->dimension; k++)
        if (p[k] != q[k]) return p[k] < q[k];
    return false;
}

uint32_t dm_least(const deldrift_mpi *m, const uint32_t *corners, uint32_t count) {
    uint32_t least = corners[0];
    for (uint32_t i = 1; i < count; i++)
        if (is_before(m, corners[i], least)) least = corners[i];
    return least;
}

// Whether the least corner of a cell, or facet, is own, and at home.
static bool is_owned(const deldrift_mpi *m, const uint32_t *corners, uint32_t count) {
    return m->is_own[dm_least(m, corners, count)];
}

deldrift_status deldrift_mpi_cells(const deldrift_mpi *m, uint64_t *ids, uint32_t *cells, size_t capacity,
                                   size_t *count) {
    dm_refusal refusal = {DELDRIFT_OK, ""};
    if (!is_given(&refusal, m, "m") || !is_given(&refusal, count, "count")) return dm_fail(&refusal);
    deldrift_cells_view view;
    if (!dm_took(&refusal, deldrift_cells(m->t, &view))) return dm_fail(&refusal);
    uint32_t corners = view.corners_per_cell;
    size_t owned = 0;
    for (size_t c = 0; c < view.count; c++) owned += is_owned(m, view.vertices + c * corners, corners);
    if (has_room(&refusal, ids || cells, capacity, owned, count)) {
        size_t row = 0;
        for (size_t c = 0; c < view.count; c++) {
            const uint32_t *v = view.vertices + c * corners;
            if (!is_owned(m, v, corners)) continue;
            for (uint32_t i = 0; ids && i < corners; i++) ids[row * corners + i] = m->id_of[v[i]];
            if (cells) cells[row] = (uint32_t)c;
            row++;
        }
    }
    return dm_fail(&refusal);
}

deldrift_status deldrift_mpi_hull_facets(const deldrift_mpi *m, uint64_t *ids, uint32_t *cells, uint8_t *corners,
                                         size_t capacity, size_t *count) {
    dm_refusal refusal = {DELDRIFT_OK, ""};
    if (!is_given(&refusal, m, "m") || !is_given(&refusal, count, "count")) return dm_fail(&refusal);
    if (m->lattice.rank) dm_refuse(&refusal, DELDRIFT_PERIODIC, "the triangulation is periodic");
    deldrift_cells_view view;
    if (refusal.status != DELDRIFT_OK || !dm_took(&refusal, deldrift_cells(m->t, &view))) return dm_fail(&refusal);
    uint32_t d = m->dimension;
    size_t owned = 0;
    // Twice: to count, and to fill.
    for (int pass = 0; pass < 2; pass++) {
        if (pass == 1 && !has_room(&refusal, ids || cells || corners, capacity, owned, count)) break;
        size_t row = 0;
        for (size_t i = 0; i < view.count * (d + 1); i++) {
            if (view.neighbours[i] != DELDRIFT_NONE) continue;
            uint32_t facet[3], length = 0, corner = (uint32_t)(i % (d + 1));
            const uint32_t *v = view.vertices + (i - corner);
            for (uint32_t k = 0; k <= d; k++)
                if (k != corner) facet[length++] = v[k];
            if (!is_owned(m, facet, d)) continue;
            if (pass == 1) {
                // Without a corner of an odd place the others are in the order that is seen from inside.
                if (corner % 2) {
                    uint32_t swapped = facet[0];
                    facet[0] = facet[1];
                    facet[1] = swapped;
                }
                for (uint32_t k = 0; ids && k < d; k++) ids[row * d + k] = m->id_of[facet[k]];
                if (cells) cells[row] = (uint32_t)(i / (d + 1));
                if (corners) corners[row] = (uint8_t)corner;
            }
            row++;
        }
        owned = row;
    }
    return dm_fail(&refusal);
}

deldrift_status deldrift_mpi_timestamp(const deldrift_mpi *m, uint64_t *timestamp) {
    dm_refusal refusal = {DELDRIFT_OK, ""};
    if (is_given(&refusal, m, "m") && is_given(&refusal, timestamp, "timestamp")) *timestamp = m->timestamp;
    return dm_fail(&refusal);
}

deldrift_status deldrift_mpi_last_report(const deldrift_mpi *m, deldrift_mpi_report *report) {
    dm_refusal refusal = {DELDRIFT_OK, ""};
    if (is_given(&refusal, m, "m") && is_given(&refusal, report, "report")) *report = m->report;
    return dm_fail(&refusal);
}
