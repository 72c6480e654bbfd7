// Translations by which a set repeats. A process is a peer of its own in other periods, and of others in all; what
// follows from that is in reach.c and span.c. A triangulation that is open has one translation, by nothing.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

// Translations are numbered in pairs of one and its opposite, behind that by nothing.
uint32_t dm_opposite(uint32_t period) {
    return period == 0 ? 0 : period % 2 ? period + 1 : period - 1;
}

// The number of a translation from its place in the order of its multiples, in whose middle is that by nothing.
static uint32_t period_at(size_t place, size_t count) {
    size_t middle = count / 2;
    return (uint32_t)(place > middle ? 2 * (place - middle) - 1 : 2 * (middle - place));
}

uint32_t dm_period_of(const dm_lattice *lattice, const int64_t multiples[3]) {
    size_t place = 0, width = 1;
    for (uint32_t j = 0; j < lattice->rank; j++) {
        int64_t most = (int64_t)lattice->greatest[j];
        if (multiples[j] < -most || multiples[j] > most) return DELDRIFT_NONE;
        place += (size_t)(multiples[j] + most) * width;
        width *= 2 * (size_t)most + 1;
    }
    return period_at(place, lattice->count);
}

void dm_translate(const deldrift_mpi *m, double *to, const double *from, uint32_t period) {
    const double *way = m->lattice.ways + (size_t)period * m->dimension;
    for (uint32_t k = 0; k < m->dimension; k++) to[k] = period ? from[k] + way[k] : from[k];
}

void dm_translate_point(const deldrift_mpi *m, double *to, const double *from, uint32_t period) {
    dm_translate(m, to, from, period);
    if (m->row > m->dimension) to[m->dimension] = from[m->dimension];
}

static bool make_translations(dm_refusal *refusal, dm_lattice *lattice, uint32_t d, const double *reduced,
                              const int64_t *multiples) {
    const uint32_t *greatest = lattice->greatest;
    lattice->count = 1;
    for (uint32_t j = 0; j < lattice->rank; j++) {
        lattice->unit[j] = (uint32_t)(2 * lattice->count - 1);
        lattice->count *= 2 * (size_t)greatest[j] + 1;
    }
    lattice->ways = dm_allocate(refusal, lattice->count * d, sizeof *lattice->ways);
    lattice->shifts = dm_allocate(refusal, lattice->count * d, sizeof *lattice->shifts);
    if (refusal->status != DELDRIFT_OK) return false;
    for (size_t place = 0; place < lattice->count; place++) {
        size_t row = (size_t)period_at(place, lattice->count) * d, rest = place;
        for (uint32_t j = 0; j < lattice->rank; j++) {
            size_t width = 2 * (size_t)greatest[j] + 1;
            int64_t n = (int64_t)(rest % width) - (int64_t)greatest[j];
            rest /= width;
            for (uint32_t k = 0; k < d; k++) {
                lattice->ways[row + k] += (double)n * reduced[j * d + k];
                lattice->shifts[row + k] += n * multiples[j * d + k];
            }
        }
    }
    return true;
}

bool dm_make_lattice(dm_refusal *refusal, dm_lattice *lattice, uint32_t d, const double *vectors, size_t rank) {
    double reduced[9] = {0};
    int64_t multiples[9] = {0};
    memset(lattice, 0, sizeof *lattice);
    if (rank && (!dm_took(refusal, deldrift_create_periodic(d, NULL, 0, vectors, rank, NULL, &lattice->box)) ||
                 !dm_took(refusal, deldrift_reduced_vectors(lattice->box, reduced, multiples, lattice->greatest, 3,
                                                            &rank))))
        return false;
    lattice->rank = (uint32_t)rank;
    lattice->measure = 1;
    for (size_t j = 0; j < rank; j++) {
        double square = 0;
        for (uint32_t k = 0; k < d; k++) square += reduced[j * d + k] * reduced[j * d + k];
        lattice->measure *= sqrt(square);
    }
    if (rank) memcpy(lattice->given, vectors, rank * d * sizeof *vectors);
    return make_translations(refusal, lattice, d, reduced, multiples);
}

void dm_free_lattice(dm_lattice *lattice) {
    deldrift_destroy(lattice->box);
    free(lattice->ways);
    free(lattice->shifts);
}

bool dm_wrap(dm_refusal *refusal, const dm_lattice *lattice, const double *positions, const double *near, size_t count,
             double *places, int64_t *shifts) {
    return !count || dm_took(refusal, deldrift_wrap_positions(lattice->box, positions, near, count, places, shifts));
}

// The places of own vertices, one after the other.
static void gather_own(const deldrift_mpi *m, double *places) {
    uint32_t d = m->dimension;
    for (size_t i = 0; i < m->own_count; i++)
        memcpy(places + i * d, m->where + (size_t)m->own[i] * m->row, d * sizeof *places);
}

bool dm_come_home(deldrift_mpi *m, const dm_lattice *lattice, const double **positions) {
    uint32_t d = m->dimension;
    size_t count = m->own_count, room[3] = {m->home_room, m->home_room, m->home_room};
    dm_refusal *r = &m->refusal;
    if (!dm_reserve(r, &m->home, &room[0], count, d * sizeof *m->home) ||
        !dm_reserve(r, &m->home_before, &room[1], count, d * sizeof *m->home_before) ||
        !dm_reserve(r, &m->home_wraps, &room[2], count, d * sizeof *m->home_wraps))
        return false;
    m->home_room = room[0];
    if (!*positions) {
        if (count) memcpy(m->home_wraps, m->wraps, count * d * sizeof *m->wraps);
        return true;
    }
    gather_own(m, m->home_before);
    // What removed vertices have is not read, and may be no number: they stay.
    const double *given = *positions;
    if (m->removal_count) {
        if (!dm_reserve(r, &m->coordinates, &m->coordinate_room, count * d, sizeof *m->coordinates)) return false;
        for (size_t i = 0; i < count; i++)
            memcpy(m->coordinates + i * d, (m->is_removal[i] ? m->home_before : given) + i * d, d * sizeof *given);
        given = m->coordinates;
    }
    *positions = m->home;
    return dm_wrap(r, lattice, given, m->home_before, count, m->home, m->home_wraps);
}

bool dm_unit_places(const deldrift_mpi *m, dm_refusal *refusal, double *places) {
    uint32_t d = m->dimension;
    if (!m->lattice.rank) {
        gather_own(m, places);
        return true;
    }
    double *own = dm_allocate(refusal, m->own_count * d, sizeof *own);
    int64_t *shifts = dm_allocate(refusal, m->own_count * d, sizeof *shifts);
    if (own) gather_own(m, own);
    bool has_them = own && shifts && dm_wrap(refusal, &m->lattice, own, NULL, m->own_count, places, shifts);
    free(own);
    free(shifts);
    return has_them;
}

deldrift_status dm_read_periods(deldrift_mpi *m, dm_refusal *refusal, int64_t **rows) {
    uint32_t d = m->dimension;
    *rows = dm_allocate(refusal, m->ids * d, sizeof **rows);
    deldrift_status status = dm_decide(m->comm, refusal, NULL).status;
    if (status != DELDRIFT_OK || !m->lattice.rank) return status;
    for (size_t i = 0; i < m->own_count; i++)
        memcpy(*rows + (size_t)m->own[i] * d, m->wraps + i * d, d * sizeof **rows);
    status = deldrift_mpi_exchange(m, *rows, d * sizeof **rows, m->ids);
    for (size_t v = 0; v < m->ids; v++) {
        const int64_t *shift = m->lattice.shifts + (size_t)m->period_of[v] * d;
        for (uint32_t k = 0; k < d; k++)
            (*rows)[v * d + k] = m->owner_of[v] < 0 ? 0 : shift[k] - (*rows)[v * d + k];
    }
    return status;
}

static void check_room(dm_refusal *refusal, const void *buffer, size_t capacity, size_t needed, size_t *count) {
    if (!count) dm_refuse(refusal, DELDRIFT_NULL_ARGUMENT, "count is NULL");
    if (!buffer && (needed || capacity)) dm_refuse(refusal, DELDRIFT_NULL_ARGUMENT, "shifts is NULL");
    if (count) *count = needed;
    if (capacity < needed)
        dm_refuse(refusal, DELDRIFT_BUFFER_TOO_SMALL, "capacity is %zu, and %zu entries are needed", capacity, needed);
}

deldrift_status deldrift_mpi_periods(deldrift_mpi *m, int64_t *shifts, size_t capacity, size_t *count) {
    if (!m) return dm_no_handle();
    dm_refusal refusal = {DELDRIFT_OK, ""};
    int64_t *rows = NULL;
    check_room(&refusal, shifts, capacity, m->ids, count);
    deldrift_status status = dm_read_periods(m, &refusal, &rows);
    if (status == DELDRIFT_OK && m->ids) memcpy(shifts, rows, m->ids * m->dimension * sizeof *rows);
    free(rows);
    return status;
}

deldrift_status deldrift_mpi_cell_shifts(deldrift_mpi *m, int64_t *shifts, size_t capacity, size_t *count) {
    if (!m) return dm_no_handle();
    dm_refusal refusal = {DELDRIFT_OK, ""};
    uint32_t d = m->dimension, corners = d + 1;
    int64_t *rows = NULL;
    size_t owned = 0;
    deldrift_cells_view view;
    if (dm_took(&refusal, deldrift_cells(m->t, &view))) {
        for (size_t c = 0; c < view.count; c++)
            owned += m->is_own[dm_least(m, view.vertices + c * corners, corners)];
        check_room(&refusal, shifts, capacity, owned, count);
    }
    deldrift_status status = dm_read_periods(m, &refusal, &rows);
    for (size_t c = 0; status == DELDRIFT_OK && c < view.count; c++) {
        const uint32_t *v = view.vertices + c * corners;
        uint32_t least = dm_least(m, v, corners);
        if (!m->is_own[least]) continue;
        for (uint32_t i = 0; i < corners; i++)
            for (uint32_t k = 0; k < d; k++)
                *shifts++ = rows[(size_t)v[i] * d + k] - rows[(size_t)least * d + k];
    }
    free(rows);
    return status;
}
