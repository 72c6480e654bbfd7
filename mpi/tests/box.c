#include <deldrift_mpi.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// Particles of a box that is periodic along all axes go to the centroids of their Voronoi cells, through its faces too. Each
// process has those that start in a slab; positions may be in any period.
enum { COUNT = 500, STEPS = 10 };

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    int rank, size;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    const double box[] = {1, 0, 0, 0, 1, 0, 0.25, 0, 1}; // three vectors, of which the third one is tilted
    double *points = malloc(3 * COUNT * sizeof *points);
    srand((unsigned)rank + 1);
    for (size_t i = 0; i < COUNT; i++) {
        points[3 * i] = (rank + rand() / (RAND_MAX + 1.0)) / size;
        points[3 * i + 1] = rand() / (RAND_MAX + 1.0);
        points[3 * i + 2] = rand() / (RAND_MAX + 1.0);
    }
    deldrift_mpi *m;
    if (deldrift_mpi_create_periodic(MPI_COMM_WORLD, 3, points, NULL, COUNT, box, 3, NULL, &m) != DELDRIFT_OK) {
        if (rank == 0) fprintf(stderr, "%s\n", deldrift_mpi_last_error());
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    double sums[2] = {0, 0}, whole[2];
    for (int step = 0; step <= STEPS; step++) {
        // The part of this process: own vertices at home, and copies in the periods in which they are needed.
        const deldrift_triangulation *t;
        size_t ids, own = COUNT;
        uint32_t vertices[COUNT];
        deldrift_mpi_local(m, &t);
        deldrift_mpi_vertices(m, NULL, vertices, own, &own);
        deldrift_id_count(t, &ids);
        double *volumes = malloc(ids * sizeof *volumes), *centroids = malloc(3 * ids * sizeof *centroids);
        int64_t *periods = malloc(3 * ids * sizeof *periods);
        // No box: the cells of own vertices have an end. A failure of a function of deldrift.h is told by deldrift_last_error.
        if (deldrift_voronoi_cells(t, NULL, NULL, NULL, 0, volumes, NULL, centroids, ids, &ids) != DELDRIFT_OK ||
            deldrift_mpi_periods(m, periods, ids, &ids) != DELDRIFT_OK) {
            fprintf(stderr, "%s\n", deldrift_last_error());
            MPI_Abort(MPI_COMM_WORLD, 1);
        }
        sums[0] = sums[1] = 0;
        for (size_t i = 0; i < own; i++) {
            uint32_t v = vertices[i];
            sums[0] += volumes[v];
            for (int k = 0; k < 3; k++) {
                // A centroid is where the vertex is at home, and a position where the program has it.
                double there = centroids[3 * v + k];
                for (int j = 0; j < 3; j++) there -= periods[3 * v + j] * box[3 * j + k];
                sums[1] += (there - points[3 * i + k]) * (there - points[3 * i + k]);
                points[3 * i + k] = there;
            }
        }
        free(volumes);
        free(centroids);
        free(periods);
        MPI_Allreduce(sums, whole, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        if (rank == 0 && step % STEPS == 0)
            printf("volume %.9f, particles %.4f from their centroids\n", whole[0], sqrt(whole[1] / (size * COUNT)));
        if (step < STEPS && deldrift_mpi_commit(m, points, COUNT, NULL) != DELDRIFT_OK) {
            if (rank == 0) fprintf(stderr, "%s\n", deldrift_mpi_last_error());
            break;
        }
    }
    free(points);
    deldrift_mpi_destroy(m);
    MPI_Finalize();
}
