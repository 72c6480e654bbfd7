// Without motion: every kind of points, spread in every way.
#include <stdio.h>
#include <stdlib.h>

#include "harness.h"

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    long runs = 0, most_rounds = 0;
    size_t count = argc > 1 ? (size_t)atol(argv[1]) : 600;
    for (uint32_t d = 2; d <= 3; d++) {
        for (int k = 0; k < KINDS; k++) {
            for (int s = 0; s < SPREADS; s++) {
                char label[160];
                snprintf(label, sizeof label, "%uD %s, %s, P = %d", d, kind_names[k], spread_names[s], size);
                point_set p = make_points(d, (point_kind)k, (point_spread)s, k == SPHERE && d == 3 ? count / 3 : count,
                                          7u + (unsigned)s);
                deldrift_mpi *m = NULL;
                OK(deldrift_mpi_create(MPI_COMM_WORLD, d, p.own, p.own_ids, p.own_count, NULL, &m));
                if (m) {
                    deldrift_mpi_report report;
                    is_serial(m, d, label);
                    OK(deldrift_mpi_last_report(m, &report));
                    if ((long)report.rounds > most_rounds) most_rounds = (long)report.rounds;
                }
                deldrift_mpi_destroy(m);
                free_points(&p);
                runs++;
            }
        }
    }
    for (size_t n = 0; n < 7; n++) {
        point_set p = make_points(3, RANDOM, SCATTERED, n, 11 + n);
        deldrift_mpi *m = NULL;
        OK(deldrift_mpi_create(MPI_COMM_WORLD, 3, p.own, p.own_ids, p.own_count, NULL, &m));
        if (m) is_serial(m, 3, "few points");
        deldrift_mpi_destroy(m);
        free_points(&p);
        runs++;
    }
    if (rank == 0)
        printf("static, P = %d: %ld runs, %ld failures, at most %ld rounds\n", size, runs, failures, most_rounds);
    MPI_Finalize();
    return failures ? 1 : 0;
}
