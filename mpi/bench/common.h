// What programs that count and measure have in common.
#ifndef DELDRIFT_MPI_BENCH_COMMON_H
#define DELDRIFT_MPI_BENCH_COMMON_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "deldrift_mpi.h"

static const double SHELL = 1.5; // spacings, of the model

static int rank, size;

static double random_number(uint64_t *state) {
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static void need(deldrift_status status) {
    if (status == DELDRIFT_OK) return;
    if (rank == 0) fprintf(stderr, "%s\n", deldrift_mpi_last_error());
    MPI_Abort(MPI_COMM_WORLD, 1);
}

// The part of the points that are in this process's block; ids are places in the list of all.
static size_t make_points(uint32_t d, size_t count, double *positions, uint64_t *ids) {
    uint64_t state = 42;
    size_t own = 0;
    for (size_t i = 0; i < count; i++) {
        double x[3] = {0};
        int block = 0;
        for (uint32_t k = 0; k < d; k++) x[k] = random_number(&state);
        for (uint32_t k = 0, parts = 1; k < d && (int)parts < size; k++, parts *= 2) block = 2 * block + (x[k] >= 0.5);
        if (block != rank) continue;
        memcpy(positions + own * d, x, d * sizeof *x);
        ids[own++] = i;
    }
    return own;
}

// Vertices within SHELL spacings of a block, on one or both of its sides along each axis: on one, if there are others.
static double model_of_blocks(uint32_t d, size_t count, int sides) {
    double side = pow((double)count, 1.0 / d), block = 1, with_shell = 1;
    for (uint32_t k = 0, parts = 1; k < d; k++, parts *= 2) {
        double length = (int)parts < size ? side / 2 : side;
        block *= length;
        with_shell *= (int)parts < size || sides == 2 ? length + sides * SHELL : length;
    }
    return with_shell - block;
}

typedef struct {
    double received, sent, halo, messages, bytes, collectives, neighbours;
} sums;

static void add(sums *s, const deldrift_mpi_report *r) {
    double mine[7] = {(double)r->received, (double)r->sent,        (double)r->halo,      (double)r->messages,
                      (double)r->bytes,    (double)r->collectives, (double)r->neighbours};
    double all[7];
    MPI_Allreduce(mine, all, 7, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    s->received += all[0] / size;
    s->sent += all[1] / size;
    s->halo += all[2] / size;
    s->messages += all[3] / size;
    s->bytes += all[4] / size;
    s->collectives += all[5] / size;
    s->neighbours += all[6] / size;
}

#endif
