#include <deldrift_mpi.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// Each process has a strip of a square and turns it around the middle; vertices go to other processes when parts become
// unequal.
enum { COUNT = 1000, STEPS = 20 };

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    int rank, size;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    size_t count = COUNT;
    double *points = malloc(2 * COUNT * sizeof *points);
    srand((unsigned)rank + 1);
    for (size_t i = 0; i < COUNT; i++) {
        points[2 * i] = (rank + rand() / (RAND_MAX + 1.0)) / size;
        points[2 * i + 1] = rand() / (RAND_MAX + 1.0);
    }
    deldrift_mpi *m;
    if (deldrift_mpi_create(MPI_COMM_WORLD, 2, points, NULL, count, NULL, &m) != DELDRIFT_OK) {
        if (rank == 0) fprintf(stderr, "%s\n", deldrift_mpi_last_error());
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    for (int step = 1; step <= STEPS; step++) {
        for (size_t i = 0; i < count; i++) {
            double x = points[2 * i] - 0.5, y = points[2 * i + 1] - 0.5;
            points[2 * i] = 0.5 + cos(0.05) * x - sin(0.05) * y;
            points[2 * i + 1] = 0.5 + sin(0.05) * x + cos(0.05) * y;
        }
        // All processes get the same status: all have made the step, or none has.
        deldrift_mpi_report report;
        if (deldrift_mpi_commit(m, points, count, &report) != DELDRIFT_OK) {
            if (rank == 0) fprintf(stderr, "%s\n", deldrift_mpi_last_error());
            break;
        }
        if (step % 10 == 0) {
            int32_t *targets = malloc((count + 1) * sizeof *targets);
            const void *received;
            deldrift_mpi_partition(m, NULL, count, targets);
            deldrift_mpi_migrate(m, targets, count, points, 2 * sizeof *points, &received, NULL);
            free(targets);
            deldrift_mpi_count(m, &count);
            points = realloc(points, (2 * count + 1) * sizeof *points);
            for (size_t i = 0; i < 2 * count; i++) points[i] = ((const double *)received)[i];
        }
    }
    // The area of the own triangles; every triangle is one process's own.
    const deldrift_triangulation *t;
    size_t own_cells, cells;
    deldrift_mpi_local(m, &t);
    deldrift_mpi_cells(m, NULL, NULL, 0, &own_cells);
    deldrift_cell_count(t, &cells);
    uint32_t *own = malloc((own_cells + 1) * sizeof *own);
    double *areas = malloc((cells + 1) * sizeof *areas), area = 0, whole;
    deldrift_mpi_cells(m, NULL, own, own_cells, &own_cells);
    deldrift_volumes(t, areas, cells, &cells);
    for (size_t k = 0; k < own_cells; k++) area += areas[own[k]];
    MPI_Reduce(&area, &whole, 1, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
    if (rank == 0) printf("area of the convex hull: %.6f\n", whole);
    free(areas);
    free(own);
    free(points);
    deldrift_mpi_destroy(m);
    MPI_Finalize();
}
