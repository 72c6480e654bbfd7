// Wrong arguments: each has its status, on all processes where the call is collective, and no effect.
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"

static const double SQUARE[8] = {0, 0, 1, 0, 0, 1, 1, 1.25};

// Process `who` gives something wrong, the others what is right. All have the same status, and know who it was.
#define REFUSED(call, status, who)                       \
    do {                                                 \
        CHECK((call) == (status));                       \
        CHECK(deldrift_mpi_refusing_process() == (who)); \
    } while (0)

static void wrong_creation(void) {
    int who = size - 1;
    bool is_wrong = rank == who;
    deldrift_mpi *m = NULL;
    double points[8], moved[8];
    memcpy(points, SQUARE, sizeof points);
    points[0] += 4 * rank;
    points[2] += 4 * rank;
    points[4] += 4 * rank;
    points[6] += 4 * rank;
    MPI_Comm comm = MPI_COMM_WORLD;
    deldrift_mpi_options options;
    deldrift_mpi_options_init(&options);

    REFUSED(deldrift_mpi_create(comm, is_wrong ? 4 : 2, points, NULL, 4, NULL, &m), DELDRIFT_INVALID_DIMENSION, who);
    if (size > 1)
        REFUSED(deldrift_mpi_create(comm, is_wrong ? 3 : 2, points, NULL, 2, NULL, &m), DELDRIFT_INVALID_DIMENSION,
                who);
    REFUSED(deldrift_mpi_create(comm, 2, is_wrong ? NULL : points, NULL, 4, NULL, &m), DELDRIFT_NULL_ARGUMENT, who);
    REFUSED(deldrift_mpi_create(comm, 2, points, NULL, 4, NULL, is_wrong ? NULL : &m), DELDRIFT_NULL_ARGUMENT, who);
    memcpy(moved, points, sizeof moved);
    if (is_wrong) moved[5] = INFINITY;
    REFUSED(deldrift_mpi_create(comm, 2, moved, NULL, 4, NULL, &m), DELDRIFT_NOT_FINITE, who);
    if (is_wrong) CHECK(strstr(deldrift_mpi_last_error(), "coordinate 1 of point 2 is inf") != NULL);
    if (is_wrong) moved[5] = -2e57;
    REFUSED(deldrift_mpi_create(comm, 2, moved, NULL, 4, NULL, &m), DELDRIFT_OUT_OF_RANGE, who);
    options.struct_size = is_wrong ? 8 : sizeof options;
    REFUSED(deldrift_mpi_create(comm, 2, points, NULL, 4, &options, &m), DELDRIFT_INVALID_OPTIONS, who);
    options.struct_size = sizeof options;
    options.boxes = is_wrong ? 257 : 0;
    REFUSED(deldrift_mpi_create(comm, 2, points, NULL, 4, &options, &m), DELDRIFT_INVALID_OPTIONS, who);
    options.boxes = is_wrong ? 3 : 4;
    if (size > 1) REFUSED(deldrift_mpi_create(comm, 2, points, NULL, 4, &options, &m), DELDRIFT_INVALID_OPTIONS, who);
    options.boxes = 0;
    deldrift_options local;
    deldrift_options_init(&local);
    if (is_wrong) local.algorithm = 77;
    options.local = &local;
    REFUSED(deldrift_mpi_create(comm, 2, points, NULL, 4, &options, &m), DELDRIFT_INVALID_OPTIONS, who);

    uint64_t ids[4] = {10 * (uint64_t)rank, 10 * (uint64_t)rank + 1, 10 * (uint64_t)rank + 2, 10 * (uint64_t)rank + 3};
    if (is_wrong) ids[3] = size > 1 ? 1 : ids[0];
    CHECK(deldrift_mpi_create(comm, 2, points, ids, 4, NULL, &m) == DELDRIFT_INVALID_VALUE);
    if (is_wrong) ids[3] = 10 * (uint64_t)rank + 3;
    if (size > 1)
        REFUSED(deldrift_mpi_create(comm, 2, points, is_wrong ? NULL : ids, 4, NULL, &m), DELDRIFT_NULL_ARGUMENT, who);
    CHECK(m == NULL);
    CHECK(deldrift_mpi_create(comm, 2, points, ids, 4, NULL, &m) == DELDRIFT_OK);
    is_serial(m, 2, "after wrong calls of deldrift_mpi_create");
    deldrift_mpi_destroy(m);
}

// What is no communicator of one group is refused without a message.
static void wrong_communicators(void) {
    deldrift_mpi *m = NULL;
    CHECK(deldrift_mpi_create(MPI_COMM_NULL, 2, SQUARE, NULL, 4, NULL, &m) == DELDRIFT_NULL_ARGUMENT);
    CHECK(strstr(deldrift_mpi_last_error(), "comm is MPI_COMM_NULL") != NULL);
    if (size > 1) {
        MPI_Comm half, inter;
        MPI_Comm_split(MPI_COMM_WORLD, rank % 2, rank, &half);
        MPI_Intercomm_create(half, 0, MPI_COMM_WORLD, 1 - rank % 2, 9, &inter);
        CHECK(deldrift_mpi_create(inter, 2, SQUARE, NULL, 4, NULL, &m) == DELDRIFT_INVALID_VALUE);
        CHECK(strstr(deldrift_mpi_last_error(), "intercommunicator") != NULL);
        MPI_Comm_free(&inter);
        MPI_Comm_free(&half);
    }
    CHECK(m == NULL);
}

static void wrong_commits(deldrift_mpi *m, double *points) {
    int who = size / 2;
    bool is_wrong = rank == who;
    double kept = points[3];
    REFUSED(deldrift_mpi_commit(m, points, is_wrong ? 3 : 4, NULL), DELDRIFT_WRONG_COUNT, who);
    REFUSED(deldrift_mpi_commit(m, is_wrong ? NULL : points, 4, NULL), DELDRIFT_NULL_ARGUMENT, who);
    if (is_wrong) points[3] = NAN;
    REFUSED(deldrift_mpi_commit(m, points, 4, NULL), DELDRIFT_NOT_FINITE, who);
    points[3] = kept;
    int32_t targets[4] = {rank, rank, rank, is_wrong ? size : rank};
    REFUSED(deldrift_mpi_migrate(m, targets, 4, NULL, 0, NULL, NULL), DELDRIFT_INVALID_VALUE, who);
    targets[3] = is_wrong ? -1 : rank;
    REFUSED(deldrift_mpi_migrate(m, targets, 4, NULL, 0, NULL, NULL), DELDRIFT_INVALID_VALUE, who);
    targets[3] = rank;
    REFUSED(deldrift_mpi_migrate(m, targets, is_wrong ? 5 : 4, NULL, 0, NULL, NULL), DELDRIFT_WRONG_COUNT, who);
    REFUSED(deldrift_mpi_migrate(m, is_wrong ? NULL : targets, 4, NULL, 0, NULL, NULL), DELDRIFT_NULL_ARGUMENT, who);
    REFUSED(deldrift_mpi_migrate(m, targets, 4, is_wrong ? NULL : points, 16, NULL, NULL), DELDRIFT_NULL_ARGUMENT, who);
    if (who > 0)
        REFUSED(deldrift_mpi_migrate(m, targets, 4, points, is_wrong ? 8 : 16, NULL, NULL), DELDRIFT_INVALID_VALUE,
                who);
    double weights[4] = {1, 1, is_wrong ? -1.5 : 1, 1};
    REFUSED(deldrift_mpi_partition(m, weights, 4, targets), DELDRIFT_INVALID_VALUE, who);
    CHECK(strstr(deldrift_mpi_last_error(), "weight 2 is -1.5") != NULL);
    REFUSED(deldrift_mpi_partition(m, NULL, 4, is_wrong ? NULL : targets), DELDRIFT_NULL_ARGUMENT, who);
    REFUSED(deldrift_mpi_partition(m, NULL, is_wrong ? 2 : 4, targets), DELDRIFT_WRONG_COUNT, who);
    size_t ids = 0;
    OK(deldrift_mpi_owners(m, NULL, 0, &ids));
    double *values = calloc(ids + 1, sizeof *values);
    REFUSED(deldrift_mpi_exchange(m, values, sizeof *values, is_wrong ? ids + 1 : ids), DELDRIFT_WRONG_COUNT, who);
    REFUSED(deldrift_mpi_exchange(m, is_wrong ? NULL : values, sizeof *values, ids), DELDRIFT_NULL_ARGUMENT, who);
    free(values);
}

// With weights, and without where they are asked for. At rest nothing is sent, whichever of both is given.
static void weights_are_checked(deldrift_mpi *plain, const double *points) {
    int who = size / 2;
    bool is_wrong = rank == who;
    double weights[4] = {0.5, -1, 0, is_wrong ? INFINITY : 0.25};
    uint64_t ids[4], number = 0, after = 0;
    deldrift_mpi *m = NULL;
    deldrift_mpi_report report;
    for (uint64_t i = 0; i < 4; i++) ids[i] = 10 * (uint64_t)rank + i;
    REFUSED(deldrift_mpi_create_weighted(MPI_COMM_WORLD, 2, points, weights, ids, 4, NULL, &m), DELDRIFT_NOT_FINITE,
            who);
    CHECK(strstr(deldrift_mpi_last_error(), "weights: entry 3 is inf") != NULL);
    if (is_wrong) weights[3] = 2e114;
    REFUSED(deldrift_mpi_create_weighted(MPI_COMM_WORLD, 2, points, weights, ids, 4, NULL, &m), DELDRIFT_OUT_OF_RANGE,
            who);
    if (size > 1)
        CHECK((is_wrong ? deldrift_mpi_create(MPI_COMM_WORLD, 2, points, ids, 4, NULL, &m)
                        : deldrift_mpi_create_weighted(MPI_COMM_WORLD, 2, points, NULL, ids, 4, NULL, &m)) ==
              DELDRIFT_NOT_WEIGHTED);
    CHECK(m == NULL);
    if (is_wrong) weights[3] = 0.25;
    OK(deldrift_mpi_create_weighted(MPI_COMM_WORLD, 2, points, is_wrong ? NULL : weights, ids, 4, NULL, &m));
    is_serial(m, 2, "after wrong calls of deldrift_mpi_create_weighted");
    OK(deldrift_mpi_timestamp(m, &number));
    if (is_wrong) weights[2] = NAN;
    REFUSED(deldrift_mpi_commit_weighted(m, points, weights, 4, NULL), DELDRIFT_NOT_FINITE, who);
    REFUSED(deldrift_mpi_commit_weighted(m, NULL, weights, 4, NULL), DELDRIFT_NOT_FINITE, who);
    weights[2] = 0;
    REFUSED(deldrift_mpi_commit_weighted(m, points, weights, is_wrong ? 3 : 4, NULL), DELDRIFT_WRONG_COUNT, who);
    REFUSED(deldrift_mpi_commit_weighted(m, NULL, NULL, is_wrong ? 4 : 0, NULL), DELDRIFT_NULL_ARGUMENT, who);
    double place[2] = {0.5, 0.5}, heavy = NAN;
    CHECK(deldrift_mpi_stage_insertions_with_weights(m, place, &heavy, ids, 1) == DELDRIFT_NOT_FINITE);
    OK(deldrift_mpi_timestamp(m, &after));
    CHECK(number == after);
    OK(deldrift_mpi_commit_weighted(m, points, weights, 4, NULL));
    is_serial(m, 2, "after wrong weights");
    for (int step = 0; step < 6; step++) {
        OK(deldrift_mpi_commit_weighted(m, step % 2 ? points : NULL, step % 3 ? weights : NULL,
                                        step % 2 || step % 3 ? 4 : 0, &report));
        CHECK(report.messages == 0 && report.collectives == 1);
    }
    deldrift_mpi_destroy(m);
    CHECK(deldrift_mpi_stage_insertions_with_weights(NULL, place, NULL, ids, 1) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_commit_weighted(NULL, place, NULL, 1, NULL) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_stage_insertions_with_weights(plain, place, NULL, ids, 1) == DELDRIFT_NOT_WEIGHTED);
    CHECK(deldrift_mpi_commit_weighted(plain, points, weights, 4, NULL) == DELDRIFT_NOT_WEIGHTED);
}

static void wrong_calls_of_one_process(deldrift_mpi *m) {
    size_t count = 99;
    uint64_t ids[4], number;
    uint32_t places[2] = {1, 1};
    double wrong[2] = {NAN, 0};
    deldrift_mpi_report report;
    CHECK(deldrift_mpi_stage_insertions(m, NULL, ids, 1) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_stage_insertions(m, wrong, NULL, 1) == DELDRIFT_NULL_ARGUMENT);
    ids[0] = 7;
    CHECK(deldrift_mpi_stage_insertions(m, wrong, ids, 1) == DELDRIFT_NOT_FINITE);
    CHECK(deldrift_mpi_stage_removals(m, NULL, 1) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_stage_removals(m, places, 2) == DELDRIFT_STAGED_VERTEX);
    OK(deldrift_mpi_stage_removals(m, places, 1));
    CHECK(deldrift_mpi_stage_removals(m, places, 1) == DELDRIFT_STAGED_VERTEX);
    places[0] = 4;
    CHECK(deldrift_mpi_stage_removals(m, places, 1) == DELDRIFT_NO_SUCH_VERTEX);
    CHECK(strstr(deldrift_mpi_last_error(), "entry 0 of places is 4") != NULL);
    // What is staged has to go before vertices may.
    int32_t targets[4] = {rank, rank, rank, rank};
    CHECK(deldrift_mpi_migrate(m, targets, 4, NULL, 0, NULL, NULL) == DELDRIFT_STAGED_VERTEX);
    OK(deldrift_mpi_discard(m));

    CHECK(deldrift_mpi_vertices(m, ids, NULL, 3, &count) == DELDRIFT_BUFFER_TOO_SMALL && count == 4);
    CHECK(deldrift_mpi_vertices(m, NULL, NULL, 3, &count) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_vertices(m, ids, NULL, 4, NULL) == DELDRIFT_NULL_ARGUMENT);
    int32_t owner;
    CHECK(deldrift_mpi_owners(m, &owner, 1, &count) == DELDRIFT_BUFFER_TOO_SMALL && count >= 4);
    uint32_t cell;
    CHECK(deldrift_mpi_cells(m, NULL, &cell, 0, &count) == (count ? DELDRIFT_BUFFER_TOO_SMALL : DELDRIFT_OK));
    CHECK(deldrift_mpi_hull_facets(m, NULL, &cell, NULL, 0, &count) ==
          (count ? DELDRIFT_BUFFER_TOO_SMALL : DELDRIFT_OK));
    const deldrift_triangulation *t;
    CHECK(deldrift_mpi_take_changes(m, NULL) == DELDRIFT_NULL_ARGUMENT);
    deldrift_mpi_changes changes;
    CHECK(deldrift_mpi_take_changes(NULL, &changes) == DELDRIFT_NULL_ARGUMENT);
    OK(deldrift_mpi_cells(m, NULL, NULL, 0, &count));
    OK(deldrift_mpi_take_changes(m, &changes));
    CHECK(changes.is_anew && changes.created_count == count && !changes.removed_count);
    OK(deldrift_mpi_take_changes(m, &changes));
    CHECK(!changes.is_anew && !changes.created_count && !changes.removed_count);
    CHECK(deldrift_mpi_count(m, NULL) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_local(m, NULL) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_timestamp(m, NULL) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_last_report(m, NULL) == DELDRIFT_NULL_ARGUMENT);

    CHECK(deldrift_mpi_stage_insertions(NULL, wrong, ids, 1) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_stage_removals(NULL, places, 1) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_discard(NULL) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_commit(NULL, wrong, 1, &report) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_count(NULL, &count) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_vertices(NULL, ids, NULL, 4, &count) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_local(NULL, &t) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_owners(NULL, &owner, 1, &count) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_cells(NULL, NULL, NULL, 0, &count) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_hull_facets(NULL, NULL, NULL, NULL, 0, &count) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_exchange(NULL, wrong, 1, 1) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_partition(NULL, NULL, 0, NULL) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_migrate(NULL, NULL, 0, NULL, 0, NULL, NULL) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_timestamp(NULL, &number) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_last_report(NULL, &report) == DELDRIFT_NULL_ARGUMENT);
    deldrift_mpi_destroy(NULL);
}

// Without motion a commit is one reduction, and no message.
static void rest(deldrift_mpi *m, const double *points) {
    deldrift_mpi_report report;
    uint64_t before = 0;
    double other[8];
    memcpy(other, points, sizeof other);
    other[0] += 0.125;
    OK(deldrift_mpi_commit(m, other, 4, NULL));
    OK(deldrift_mpi_commit(m, points, 4, &report));
    CHECK(!report.is_rebuilt);
    uint64_t halo = report.halo;
    CHECK(size == 1 ? halo == 0 : halo > 0);
    OK(deldrift_mpi_timestamp(m, &before));
    for (int step = 0; step < 20; step++) {
        OK(deldrift_mpi_commit(m, step % 2 ? points : NULL, step % 2 ? 4 : 0, &report));
        CHECK(report.messages == 0 && report.bytes == 0 && report.collectives == 1 && report.rounds == 0);
        CHECK(report.halo == halo && report.is_spanning == 1 && report.timestamp == ++before);
    }
    is_serial(m, 2, "at rest");
}

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    // One whose numbers have a comma, which those of messages do not.
    const char *locale_name = getenv("DELDRIFT_TEST_LOCALE");
    if (locale_name) CHECK(setlocale(LC_ALL, locale_name) && !strcmp(localeconv()->decimal_point, ","));
    CHECK(deldrift_mpi_refusing_process() == -1 && !*deldrift_mpi_last_error());
    wrong_communicators();
    wrong_creation();
    double points[8];
    memcpy(points, SQUARE, sizeof points);
    for (int i = 0; i < 8; i += 2) points[i] += 1.5 * rank;
    deldrift_mpi *m = NULL;
    OK(deldrift_mpi_create(MPI_COMM_WORLD, 2, points, NULL, 4, NULL, &m));
    if (m) {
        uint64_t ids[4] = {0};
        size_t count = 0;
        deldrift_mpi_report report;
        OK(deldrift_mpi_last_report(m, &report));
        CHECK(report.is_rebuilt == 1 && report.timestamp == 0);
        OK(deldrift_mpi_vertices(m, ids, NULL, 4, &count));
        for (size_t i = 0; i < 4; i++) CHECK(ids[i] == 4 * (size_t)rank + i);
        wrong_commits(m, points);
        wrong_calls_of_one_process(m);
        weights_are_checked(m, points);
        is_serial(m, 2, "after wrong calls");
        rest(m, points);
    }
    deldrift_mpi_destroy(m);
    if (rank == 0) printf("arguments, P = %d: %ld failures\n", size, failures);
    MPI_Finalize();
    return failures ? 1 : 0;
}
