// What a step costs in boxes that repeat, with the same vectors and with others at each step, and of points on a
// sphere, beside an open box: one row of a table, or with no arguments its head.
//     steps SET DIMENSION COUNT STEPS AMPLITUDE
// SET is open (random points in the unit square or cube), periodic (the same, repeated), strained (the same, in a box
// that is sheared and stretched by a thousandth at each step, vertices with it) or sphere (whole numbers at one
// distance from 0, in space). The middle of each axis parts processes: 1, 2, 4 or 8. In steps each coordinate of a
// vertex changes by up to AMPLITUDE spacings; a sphere is turned by that, so that each step rounds all coordinates in
// another way.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "common.h"

// The square of the distance from 0, at which there are many points of whole numbers.
enum { SQUARE_OF_DISTANCE = 100000001, ON_SPHERE_AT_MOST = 200000 };

// Points of whole numbers with that sum of squares, in a random order.
static size_t points_on_sphere(double *points) {
    size_t count = 0;
    int64_t most = (int64_t)sqrt((double)SQUARE_OF_DISTANCE);
    uint64_t state = 42;
    for (int64_t x = -most; x <= most; x++) {
        int64_t rest = SQUARE_OF_DISTANCE - x * x, greatest = (int64_t)sqrt((double)rest);
        for (int64_t y = -greatest; y <= greatest; y++) {
            int64_t square = rest - y * y, z = (int64_t)sqrt((double)square);
            if (z * z != square) continue;
            for (int sign = z ? -1 : 1; sign <= 1 && count < ON_SPHERE_AT_MOST; sign += 2) {
                double point[3] = {(double)x, (double)y, (double)(sign * z)};
                size_t at = (size_t)(random_number(&state) * (double)++count);
                memcpy(points + 3 * (count - 1), points + 3 * at, sizeof point);
                memcpy(points + 3 * at, point, sizeof point);
            }
        }
    }
    return count;
}

static size_t make_sphere(size_t *count, double *positions, uint64_t *ids) {
    double *all = malloc(3 * ON_SPHERE_AT_MOST * sizeof *all);
    size_t own = 0, there = points_on_sphere(all);
    if (*count > there) *count = there;
    for (size_t i = 0; i < *count; i++) {
        const double *x = all + 3 * i;
        int block = 0;
        for (uint32_t k = 0, parts = 1; k < 3 && (int)parts < size; k++, parts *= 2) block = 2 * block + (x[k] >= 0);
        if (block != rank) continue;
        memcpy(positions + 3 * own, x, 3 * sizeof *x);
        ids[own++] = i;
    }
    free(all);
    return own;
}

// By an angle around (1, 2, 3).
static void turn(double *positions, size_t count, double angle) {
    static const double AXIS[3] = {0.2672612419124244, 0.5345224838248488, 0.8017837257372732};
    double c = cos(angle), s = sin(angle);
    for (size_t i = 0; i < count; i++) {
        double *x = positions + 3 * i;
        double along = (1 - c) * (x[0] * AXIS[0] + x[1] * AXIS[1] + x[2] * AXIS[2]);
        double turned[3] = {c * x[0] + s * (AXIS[1] * x[2] - AXIS[2] * x[1]) + along * AXIS[0],
                            c * x[1] + s * (AXIS[2] * x[0] - AXIS[0] * x[2]) + along * AXIS[1],
                            c * x[2] + s * (AXIS[0] * x[1] - AXIS[1] * x[0]) + along * AXIS[2]};
        memcpy(x, turned, sizeof turned);
    }
}

// Stretched along x, and sheared along it by y, by a thousandth.
static void strain(uint32_t d, double *points, size_t count) {
    for (size_t i = 0; i < count; i++) points[i * d] += 1e-3 * (points[i * d] + points[i * d + 1]);
}

// Copies that a process needs: within SHELL spacings of its block, on all sides where the box repeats; of a sphere all.
static double model_of(uint32_t d, size_t count, int is_periodic, int is_sphere) {
    if (is_sphere) return (double)count * (size - 1) / size;
    return is_periodic ? model_of_blocks(d, count, 2) : model_of_blocks(d, count, 1);
}

static int compare_numbers(const void *first, const void *second) {
    double a = *(const double *)first, b = *(const double *)second;
    return a < b ? -1 : a > b;
}

static double greatest_of_all(double mine) {
    double all = 0;
    MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return all;
}

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (argc < 6) {
        if (rank == 0)
            printf("set,dimension,processes,vertices,amplitude,model,first_rounds,first_received,first_seconds,steps,"
                   "steps_0_rounds,steps_1_round,steps_2_rounds,steps_more_rounds,steps_rebuilt,received_a_step,"
                   "halo_last,messages_a_step,bytes_a_step,collectives_a_step,neighbours,milliseconds_a_step,"
                   "megabytes\n");
        MPI_Finalize();
        return 0;
    }
    const char *set = argv[1];
    uint32_t d = (uint32_t)atoi(argv[2]);
    size_t count = (size_t)atol(argv[3]), steps = (size_t)atol(argv[4]), own;
    double amplitude = atof(argv[5]), vectors[9] = {0};
    int is_sphere = !strcmp(set, "sphere"), is_strained = !strcmp(set, "strained");
    int is_periodic = is_strained || !strcmp(set, "periodic");
    double *positions = malloc((count + 1) * d * sizeof *positions), *times = malloc((steps + 1) * sizeof *times);
    uint64_t *ids = malloc((count + 1) * sizeof *ids);
    own = is_sphere ? make_sphere(&count, positions, ids) : make_points(d, count, positions, ids);
    double spacing = is_sphere ? sqrt(4 * 3.141592653589793 / (double)count) : pow((double)count, -1.0 / d);
    for (uint32_t k = 0; k < d; k++) vectors[k * d + k] = 1;
    deldrift_mpi *m;
    deldrift_mpi_report report;
    MPI_Barrier(MPI_COMM_WORLD);
    double start = MPI_Wtime();
    if (is_periodic)
        need(deldrift_mpi_create_periodic(MPI_COMM_WORLD, d, positions, ids, own, vectors, d, NULL, &m));
    else
        need(deldrift_mpi_create(MPI_COMM_WORLD, d, positions, ids, own, NULL, &m));
    double seconds = greatest_of_all(MPI_Wtime() - start);
    need(deldrift_mpi_last_report(m, &report));
    sums first = {0}, moving = {0}, last = {0};
    size_t rounds[4] = {0}, rebuilt = 0;
    uint64_t first_rounds = report.rounds, state = 99 + (uint64_t)rank;
    add(&first, &report);
    for (size_t step = 0; step < steps; step++) {
        if (is_sphere && amplitude > 0) turn(positions, own, amplitude * spacing);
        for (size_t i = 0; !is_sphere && i < own * d; i++)
            positions[i] += amplitude * spacing * (2 * random_number(&state) - 1);
        if (is_strained) {
            strain(d, positions, own);
            strain(d, vectors, d);
        }
        MPI_Barrier(MPI_COMM_WORLD);
        start = MPI_Wtime();
        if (is_strained)
            need(deldrift_mpi_commit_vectors(m, positions, own, vectors, d, &report));
        else
            need(deldrift_mpi_commit(m, positions, own, &report));
        times[step] = greatest_of_all(MPI_Wtime() - start);
        rounds[report.rounds < 3 ? report.rounds : 3]++;
        rebuilt += (size_t)report.is_rebuilt;
        add(&moving, &report);
    }
    add(&last, &report);
    qsort(times, steps, sizeof *times, compare_numbers);
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    double n = steps ? (double)steps : 1, megabytes = greatest_of_all((double)usage.ru_maxrss / 1024);
    if (rank == 0)
        printf("%s,%u,%d,%zu,%g,%.0f,%llu,%.0f,%.3f,%zu,%zu,%zu,%zu,%zu,%zu,%.1f,%.0f,%.1f,%.0f,%.1f,%.1f,%.2f,%.0f\n",
               set, d, size, count, amplitude, model_of(d, count, is_periodic, is_sphere),
               (unsigned long long)first_rounds, first.received, seconds, steps, rounds[0], rounds[1], rounds[2],
               rounds[3], rebuilt, moving.received / n, last.halo, moving.messages / n, moving.bytes / n,
               moving.collectives / n, last.neighbours, steps ? 1000 * times[steps / 2] : 0, megabytes);
    free(positions);
    free(times);
    free(ids);
    deldrift_mpi_destroy(m);
    MPI_Finalize();
    return 0;
}
