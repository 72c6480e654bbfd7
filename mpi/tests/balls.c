#include <deldrift_mpi.h>
#include <stdio.h>
#include <stdlib.h>

// Balls that grow, some faster than others, until many are hidden by their neighbours. Each process has those of a slab.
enum { COUNT = 500, STEPS = 8 };

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    int rank, size;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    double *centres = malloc(3 * COUNT * sizeof *centres), radii[COUNT], weights[COUNT];
    srand((unsigned)rank + 1);
    for (size_t i = 0; i < COUNT; i++) {
        for (int k = 0; k < 3; k++) centres[3 * i + k] = rand() / (RAND_MAX + 1.0);
        centres[3 * i] = (rank + centres[3 * i]) / size;
        radii[i] = rand() / (RAND_MAX + 1.0);
    }
    deldrift_mpi *m; // NULL weights: all 0, which is the Delaunay triangulation
    if (deldrift_mpi_create_weighted(MPI_COMM_WORLD, 3, centres, NULL, NULL, COUNT, NULL, &m) != DELDRIFT_OK) {
        if (rank == 0) fprintf(stderr, "%s\n", deldrift_mpi_last_error());
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    for (int step = 0; step <= STEPS; step++) {
        double scale = 0.02 * step;
        for (size_t i = 0; i < COUNT; i++) weights[i] = scale * radii[i] * scale * radii[i];
        // NULL for what stays: centres. Weights and positions can change in one commit.
        if (deldrift_mpi_commit_weighted(m, NULL, weights, COUNT, NULL) != DELDRIFT_OK) {
            if (rank == 0) fprintf(stderr, "%s\n", deldrift_mpi_last_error());
            MPI_Abort(MPI_COMM_WORLD, 1);
        }
        // Own vertices are hidden here exactly if they are so in the triangulation of all.
        const deldrift_triangulation *t;
        size_t n = 0, ids = 0, count = COUNT;
        uint64_t hidden[2] = {0, 0};
        uint32_t vertices[COUNT];
        deldrift_mpi_local(m, &t);
        deldrift_hidden_by_weight(t, NULL, NULL, 0, &n);
        deldrift_id_count(t, &ids);
        uint32_t *list = malloc((n + 1) * sizeof *list);
        char *is_hidden = calloc(ids, 1);
        deldrift_hidden_by_weight(t, list, NULL, n, &n);
        deldrift_mpi_vertices(m, NULL, vertices, count, &count);
        for (size_t k = 0; k < n; k++) is_hidden[list[k]] = 1;
        for (size_t i = 0; i < count; i++) hidden[0] += is_hidden[vertices[i]];
        free(list);
        free(is_hidden);
        MPI_Reduce(&hidden[0], &hidden[1], 1, MPI_UINT64_T, MPI_SUM, 0, MPI_COMM_WORLD);
        if (rank == 0 && step % 4 == 0)
            printf("radii up to %.2f: %lu of %d balls are hidden\n", scale, (unsigned long)hidden[1], size * COUNT);
    }
    free(centres);
    deldrift_mpi_destroy(m);
    MPI_Finalize();
}
