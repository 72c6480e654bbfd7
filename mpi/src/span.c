// Whether the vertices of all processes span the dimension, where a process has no cells. Exact.
#include <string.h>

#include "internal.h"

static bool is_independent(uint32_t dimension, const double *const points[4]) {
    double rows[12];
    int32_t sign = 0;
    for (uint32_t i = 0; i <= dimension; i++) memcpy(rows + i * dimension, points[i], dimension * sizeof *rows);
    // The coordinates have been checked, so this cannot fail.
    return deldrift_orientation(dimension, rows, &sign) == DELDRIFT_OK && sign != 0;
}

// Three points of space are on a line if their shadows on all three planes of coordinates are.
static bool is_on_line(const double *a, const double *b, const double *c) {
    for (int x = 0; x < 3; x++) {
        int y = (x + 1) % 3;
        double shadows[3][2] = {{a[x], a[y]}, {b[x], b[y]}, {c[x], c[y]}};
        const double *const points[4] = {shadows[0], shadows[1], shadows[2], NULL};
        if (is_independent(2, points)) return false;
    }
    return true;
}

static bool is_same_place(uint32_t dimension, const double *a, const double *b) {
    for (uint32_t k = 0; k < dimension; k++)
        if (a[k] != b[k]) return false;
    return true;
}

// Whether a point is outside what those of the basis span.
static bool is_beyond(uint32_t dimension, const dm_basis *basis, const double *point) {
    const double *points[4] = {NULL, NULL, NULL, NULL};
    for (int32_t i = 0; i < basis->count; i++) points[i] = basis->points[i].position;
    if (basis->count == 0) return true;
    if (basis->count == 1) return !is_same_place(dimension, points[0], point);
    if (basis->count == 2 && dimension == 3) return !is_on_line(points[0], points[1], point);
    points[basis->count] = point;
    return is_independent(dimension, points);
}

static void extend(uint32_t dimension, dm_basis *basis, const dm_basis_point *candidate) {
    if (basis->count <= (int32_t)dimension && is_beyond(dimension, basis, candidate->position))
        basis->points[basis->count++] = *candidate;
}

// One pass: a point that is not beyond those so far is not beyond more of them.
static void find_own_basis(const deldrift_mpi *m, dm_basis *basis) {
    for (size_t i = 0; i < m->next_count && basis->count <= (int32_t)m->dimension; i++) {
        dm_basis_point candidate;
        memset(&candidate, 0, sizeof candidate);
        candidate.vertex = m->next_own[i];
        candidate.id = m->id_of[candidate.vertex];
        candidate.owner = m->rank;
        memcpy(candidate.position, m->where + (size_t)candidate.vertex * m->row, m->dimension * sizeof(double));
        extend(m->dimension, basis, &candidate);
    }
    // The vectors of a periodic box span as well.
    for (uint32_t j = 0; m->next_count && j < m->lattice.rank; j++) {
        dm_basis_point candidate = basis->points[0];
        candidate.period = m->lattice.unit[j];
        dm_translate(m, candidate.position, basis->points[0].position, candidate.period);
        extend(m->dimension, basis, &candidate);
    }
}

static bool is_sent(const dm_list *sent, const dm_basis_point *point) {
    for (size_t k = 0; k < sent->count; k++)
        if (sent->at[k] == point->vertex && sent->period[k] == point->period && !sent->is_leaving[k]) return true;
    return false;
}

static void send_basis(deldrift_mpi *m, const dm_basis *basis, int to) {
    for (int32_t i = 0; i < basis->count; i++) {
        const dm_basis_point *point = &basis->points[i];
        if (point->owner != m->rank || (to == m->rank && !point->period)) continue;
        dm_peer *peer = dm_peer_of(m, to);
        if (!peer || !dm_reserve_list(&m->refusal, &peer->sent, peer->sent.count + 1)) return;
        if (is_sent(&peer->sent, point)) continue;
        peer->sent.is_leaving[peer->sent.count] = 0;
        peer->sent.period[peer->sent.count] = point->period;
        peer->sent.at[peer->sent.count++] = point->vertex;
    }
}

bool dm_span(deldrift_mpi *m, bool has_no_cells) {
    dm_basis mine, all;
    memset(&mine, 0, sizeof mine);
    memset(&all, 0, sizeof all);
    mine.has_no_cells = has_no_cells;
    find_own_basis(m, &mine);
    MPI_Allgather(&mine, sizeof mine, MPI_BYTE, m->bases, sizeof mine, MPI_BYTE, m->comm);
    m->report.collectives++;
    for (int rank = 0; rank < m->size; rank++)
        for (int32_t i = 0; i < m->bases[rank].count; i++) extend(m->dimension, &all, &m->bases[rank].points[i]);
    if (all.count <= (int32_t)m->dimension) return false;
    for (int rank = 0; rank < m->size; rank++)
        if (m->bases[rank].has_no_cells) send_basis(m, &all, rank);
    return true;
}
