// Points as rows of numbers: the coordinates, and the weight behind them where vertices have weights. A program, and
// deldrift.h, have weights in an array of their own.
#include <stdlib.h>
#include <string.h>

#include "internal.h"

void dm_zip(uint32_t dimension, uint32_t row, const double *positions, const double *weights, size_t count,
            double *points) {
    for (size_t i = 0; i < count; i++) {
        memcpy(points + i * row, positions + i * dimension, dimension * sizeof *points);
        if (row > dimension) points[i * row + dimension] = weights ? weights[i] : 0;
    }
}

// The rows without their weights, and these.
static void unzip(uint32_t dimension, uint32_t row, const double *points, size_t count, double *positions,
                  double *weights) {
    for (size_t i = 0; i < count; i++) {
        memcpy(positions + i * dimension, points + i * row, dimension * sizeof *points);
        weights[i] = points[i * row + dimension];
    }
}

bool dm_unzip(deldrift_mpi *m, const double **points, size_t count, const double **weights) {
    *weights = NULL;
    if (m->row == m->dimension) return true;
    if (!dm_reserve(&m->refusal, &m->unzipped, &m->unzipped_room, count, m->dimension * sizeof(double)) ||
        !dm_reserve(&m->refusal, &m->weights, &m->weight_room, count, sizeof(double)))
        return false;
    unzip(m->dimension, m->row, *points, count, m->unzipped, m->weights);
    *points = m->unzipped;
    *weights = m->weights;
    return true;
}

void dm_copy_points(deldrift_mpi *m) {
    uint32_t d = m->dimension;
    size_t count = 0;
    // There is room, as there was for more ids.
    deldrift_copy_positions(m->t, m->where, m->ids_room, &count);
    m->ids = count;
    if (m->row == d) return;
    deldrift_weights(m->t, m->weight_of, m->ids_room, &count);
    for (size_t v = m->ids; v-- > 0;) {
        memmove(m->where + v * m->row, m->where + v * d, d * sizeof *m->where);
        m->where[v * m->row + d] = m->weight_of[v];
    }
}

bool dm_wrap_points(dm_refusal *refusal, const deldrift_mpi *m, const double *points, size_t count, double *places,
                    int64_t *shifts) {
    uint32_t d = m->dimension;
    if (m->row == d) return dm_wrap(refusal, &m->lattice, points, NULL, count, places, shifts);
    double *positions = dm_allocate(refusal, 2 * count * d, sizeof *positions);
    double *weights = dm_allocate(refusal, count, sizeof *weights);
    bool has_them = positions && weights;
    if (has_them) {
        unzip(d, m->row, points, count, positions, weights);
        has_them = dm_wrap(refusal, &m->lattice, positions, NULL, count, positions + count * d, shifts);
    }
    if (has_them) dm_zip(d, m->row, positions + count * d, weights, count, places);
    free(positions);
    free(weights);
    return has_them;
}

bool dm_take_points(deldrift_mpi *m, const double **positions, const double *weights) {
    uint32_t d = m->dimension;
    const double *given = *positions;
    if (m->row == d || (!given && !weights)) return true;
    if (!dm_reserve(&m->refusal, &m->given, &m->given_room, m->own_count, m->row * sizeof *m->given)) return false;
    *positions = m->given;
    for (size_t i = 0; i < m->own_count; i++) {
        double *point = m->given + i * m->row;
        memcpy(point, m->where + (size_t)m->own[i] * m->row, m->row * sizeof *point);
        // What removed vertices are given is not read.
        if (m->removal_count && m->is_removal[i]) continue;
        if (given) memcpy(point, given + i * d, d * sizeof *point);
        if (weights) point[d] = weights[i];
    }
    return true;
}
