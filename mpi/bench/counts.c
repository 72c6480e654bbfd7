// Counts of what processes send and receive, beside the model of docs/SCALING.md: one row of a table, or with no
// arguments its head.
//     counts DIMENSION COUNT STEPS AMPLITUDE SPREAD [BOXES]
// COUNT random points in the unit square or cube; in steps each coordinate of a vertex changes by up to AMPLITUDE
// spacings; SPREAD is blocks (the middle of each axis parts processes: 1, 2, 4 or 8) or curve (deldrift_mpi_partition).
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common.h"

static double *own_positions(const deldrift_mpi *m, uint32_t d, size_t *count) {
    const deldrift_triangulation *t;
    need(deldrift_mpi_local(m, &t));
    need(deldrift_mpi_count(m, count));
    uint32_t *vertices = malloc((*count + 1) * sizeof *vertices);
    double *positions = malloc((*count + 1) * d * sizeof *positions);
    need(deldrift_mpi_vertices(m, NULL, vertices, *count, count));
    for (size_t i = 0; i < *count; i++) need(deldrift_position(t, vertices[i], positions + i * d));
    free(vertices);
    return positions;
}

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (argc < 6) {
        if (rank == 0)
            printf(
                "dimension,processes,vertices,spread,amplitude,model,first_rounds,first_received,steps,steps_0_rounds,"
                "steps_1_round,steps_2_rounds,steps_more_rounds,received_a_step,halo_last,messages_a_step,bytes_a_step,"
                "collectives_a_step,neighbours\n");
        MPI_Finalize();
        return 0;
    }
    uint32_t d = (uint32_t)atoi(argv[1]);
    size_t count = (size_t)atol(argv[2]), steps = (size_t)atol(argv[3]);
    double spacing = pow((double)count, -1.0 / d), amplitude = atof(argv[4]);
    int is_curve = !strcmp(argv[5], "curve");
    deldrift_mpi_options options;
    deldrift_mpi_options_init(&options);
    if (argc > 6) options.boxes = (uint32_t)atoi(argv[6]);
    double *positions = malloc((count + 1) * d * sizeof *positions);
    uint64_t *ids = malloc((count + 1) * sizeof *ids);
    size_t own = make_points(d, count, positions, ids);
    deldrift_mpi *m;
    deldrift_mpi_report report;
    double start = MPI_Wtime();
    need(deldrift_mpi_create(MPI_COMM_WORLD, d, positions, ids, own, &options, &m));
    double seconds_first = MPI_Wtime() - start;
    free(ids);
    free(positions);
    need(deldrift_mpi_last_report(m, &report));
    positions = own_positions(m, d, &own);
    if (is_curve) {
        int32_t *targets = malloc((own + 1) * sizeof *targets);
        need(deldrift_mpi_partition(m, NULL, own, targets));
        start = MPI_Wtime();
        need(deldrift_mpi_migrate(m, targets, own, NULL, 0, NULL, &report));
        seconds_first = MPI_Wtime() - start;
        free(targets);
        free(positions);
        positions = own_positions(m, d, &own);
    }
    sums first = {0}, moving = {0}, last = {0};
    size_t rounds[4] = {0};
    uint64_t first_rounds = report.rounds, state = 99 + (uint64_t)rank;
    add(&first, &report);
    double seconds = 0;
    for (size_t step = 0; step < steps; step++) {
        for (size_t i = 0; i < own * d; i++) positions[i] += amplitude * spacing * (2 * random_number(&state) - 1);
        start = MPI_Wtime();
        need(deldrift_mpi_commit(m, positions, own, &report));
        seconds += MPI_Wtime() - start;
        rounds[report.rounds < 3 ? report.rounds : 3]++;
        add(&moving, &report);
    }
    add(&last, &report);
    double n = steps ? (double)steps : 1;
    if (rank == 0)
        printf("%u,%d,%zu,%s,%g,%.0f,%llu,%.0f,%zu,%zu,%zu,%zu,%zu,%.1f,%.0f,%.1f,%.0f,%.1f,%.1f\n", d, size, count,
               argv[5], amplitude, model_of_blocks(d, count, 1), (unsigned long long)first_rounds, first.received, steps,
               rounds[0], rounds[1], rounds[2], rounds[3], moving.received / n, last.halo, moving.messages / n,
               moving.bytes / n, moving.collectives / n, last.neighbours);
    // Times are for who looks: they are no counts, and differ from run to run.
    if (rank == 0) fprintf(stderr, "%.3f s from nothing, %.4f s a step\n", seconds_first, seconds / n);
    free(positions);
    deldrift_mpi_destroy(m);
    MPI_Finalize();
    return 0;
}
