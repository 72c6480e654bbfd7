// Sets on a line, in a plane, on a lattice and at one place, in the open and in boxes: the copies that processes have of
// their vertices, the rounds, and the boxes that are asked about, which is what they cost, as few as SCALING.md says.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "internal.h"

enum { MOST = 96 };
static const char *const sets[] = {"random", "diagonal", "axis", "plane", "lattice", "place"};
enum { SETS = sizeof sets / sizeof *sets };
static const double sides[] = {1, 1.1, 1.3};

// Points of the box; those on the diagonal are on a line but for the last bit.
static void fill(int set, uint32_t d, size_t count, double *points) {
    uint64_t state = 7;
    size_t wide = 1;
    while (d == 2 ? wide * wide < count : wide * wide * wide < count) wide++;
    for (size_t i = 0; i < count; i++) {
        size_t rest = i;
        for (uint32_t k = 0; k < d; k++, rest /= wide) {
            double any = random_number(&state), along = ((double)i + 0.5) / (double)count;
            double step = (double)(rest % wide) / (double)wide, level = 0.25 + 0.125 * k;
            double places[SETS] = {any, along, k ? level : along, k == d - 1 ? level : any, step, level};
            points[i * d + k] = sides[k] * places[set];
        }
    }
}

// Makes the set, moves it a little, and checks what that has taken.
static void check_set(int set, uint32_t d, bool is_periodic, size_t count) {
    double points[3 * MOST], box[9] = {0};
    for (uint32_t k = 0; k < d; k++) box[k * d + k] = sides[k];
    fill(set, d, count, points);
    size_t first = count * (size_t)rank / (size_t)size, own = count * ((size_t)rank + 1) / (size_t)size - first;
    double *mine = points + first * d;
    deldrift_mpi *m = NULL;
    deldrift_mpi_asked = 0;
    OK(is_periodic ? deldrift_mpi_create_periodic(MPI_COMM_WORLD, d, mine, NULL, own, box, d, NULL, &m)
                   : deldrift_mpi_create(MPI_COMM_WORLD, d, mine, NULL, own, NULL, &m));
    long asked = deldrift_mpi_asked;
    for (size_t i = 0; i < own * d; i++) mine[i] += 1e-3 * (double)(i % 3);
    size_t periods = is_periodic ? (d == 2 ? 25 : 125) : 1, peers = periods * (size_t)size - 1;
    deldrift_mpi_report made, moved;
    OK(deldrift_mpi_last_report(m, &made));
    deldrift_mpi_asked = 0;
    OK(deldrift_mpi_commit(m, mine, own, &moved));
    CHECK(made.rounds <= 3 && moved.rounds <= 3);
    // A vertex of each other process in each period, and of its own ones in all but one.
    CHECK(made.halo <= count * periods - own && moved.halo <= count * periods - own);
    // In a round at most a half-space on each side, and what a process has in a period as a whole and by boxes; most are far
    // from few vertices that are spread, and from the diagonal.
    size_t boxes = count < 16 ? count : 16, most = (2 * d + peers * (1 + boxes)) * (size_t)made.rounds;
    CHECK((size_t)asked <= most + peers * (1 + boxes));
    if (is_periodic && d == 3 && size == 1 && set <= 1 && count == 20) CHECK(3 * (size_t)asked < most);
    if (rank == 0 && size == 1 && is_periodic)
        printf("%s, %uD, %zu vertices: %llu copies in %llu rounds, %ld boxes asked about\n", sets[set], d, count,
               (unsigned long long)made.halo, (unsigned long long)made.rounds, asked);
    deldrift_mpi_destroy(m);
}

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    for (int set = 0; set < SETS; set++)
        for (uint32_t d = 2; d <= 3; d++)
            for (size_t count = 20; count <= 80; count *= 4)
                for (int is_periodic = 0; is_periodic <= 1; is_periodic++) check_set(set, d, is_periodic, count);
    if (rank == 0) printf("sets, P = %d: %ld failures\n", size, failures);
    MPI_Finalize();
    return failures ? 1 : 0;
}
