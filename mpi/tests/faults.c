// Faults that are planted in the library, in its build for tests: each has to be found by the comparison with one
// process. Memory that one process is refused: nothing changes on any.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "internal.h"

static const char *const names[] = {
    "none",     "a reach too small",         "a lost message", "no half-spaces", "stale copies",
    "no round", "keys of each process's own"};
enum { FAULTS = sizeof names / sizeof *names };

// Whether vertices were sent that nobody has received. Then those who sent them, and those who did not get them, have lists of
// other lengths, and positions of the next commit are messages of other lengths: an error of MPI, which ends the program
// where MPI notices it.
static bool has_lost(const deldrift_mpi *m) {
    deldrift_mpi_report report;
    OK(deldrift_mpi_last_report(m, &report));
    long counts[2] = {(long)report.sent, (long)report.received}, whole[2];
    MPI_Allreduce(counts, whole, 2, MPI_LONG, MPI_SUM, MPI_COMM_WORLD);
    return whole[0] != whole[1];
}

// How many of the states, which are counted, are not those of one process.
// With weights those of process 0 are far greater than the others'.
static long wrong_states(int fault, bool is_weighted, uint32_t d, point_kind kind, point_spread spread, uint64_t seed,
                         long *states) {
    point_set p = make_points(d, kind, spread, 300, seed);
    uint64_t state = seed + (uint64_t)rank;
    long wrong = 0;
    deldrift_mpi *m = NULL;
    double *weights = calloc(p.own_count + 1, sizeof *weights);
    for (size_t i = 0; rank == 0 && i < p.own_count; i++) weights[i] = kind == LATTICE ? 4 : 0.02;
    deldrift_mpi_fault = fault;
    OK(is_weighted
           ? deldrift_mpi_create_weighted(MPI_COMM_WORLD, d, p.own, weights, p.own_ids, p.own_count, NULL, &m)
           : deldrift_mpi_create(MPI_COMM_WORLD, d, p.own, p.own_ids, p.own_count, NULL, &m));
    free(weights);
    for (int step = 0; step < 6; step++) {
        wrong += !is_serial(m, d, NULL);
        ++*states;
        if (has_lost(m)) {
            CHECK(fault == DM_FAULT_LOST_MESSAGE);
            break;
        }
        for (size_t i = 0; i < p.own_count * d; i++)
            p.own[i] += kind == LATTICE ? (i % d == 0) * 0.125 : 0.02 * (random_number(&state) - 0.5);
        OK(deldrift_mpi_commit(m, p.own, p.own_count, NULL));
    }
    deldrift_mpi_fault = DM_FAULT_NONE;
    deldrift_mpi_destroy(m);
    free_points(&p);
    return wrong;
}

static void plant(void) {
    for (int fault = 0; fault < FAULTS; fault++) {
        long wrong = 0, states = 0;
        for (uint32_t d = 2; d <= 3; d++) {
            for (uint64_t seed = 1; seed <= 3; seed++) {
                static const point_kind KINDS_HERE[] = {RANDOM, LATTICE, CLUSTERS};
                for (size_t k = 0; k < 3; k++)
                    wrong += wrong_states(fault, seed == 2, d, KINDS_HERE[k],
                                          seed == 3 ? SCATTERED : SLABS, seed, &states);
            }
        }
        CHECK((wrong > 0) == (fault != DM_FAULT_NONE));
        if (rank == 0) printf("faults, P = %d: %s: %ld of %ld states wrong\n", size, names[fault], wrong, states);
    }
}

// The system's allocator, which is asked while a timestamp is prepared: request `first_refused` and all later ones are
// refused.
static long requests, first_refused = -1;

void *__libc_malloc(size_t bytes);
void *__libc_calloc(size_t count, size_t bytes);
void *__libc_realloc(void *block, size_t bytes);
void *__libc_memalign(size_t alignment, size_t bytes);

static bool is_refused(void) {
    return deldrift_mpi_is_preparing && first_refused >= 0 && requests++ >= first_refused;
}

void *malloc(size_t bytes) {
    return is_refused() ? NULL : __libc_malloc(bytes);
}

void *calloc(size_t count, size_t bytes) {
    return is_refused() ? NULL : __libc_calloc(count, bytes);
}

void *realloc(void *block, size_t bytes) {
    return is_refused() ? NULL : __libc_realloc(block, bytes);
}

int posix_memalign(void **block, size_t alignment, size_t bytes) {
    void *made = is_refused() ? NULL : __libc_memalign(alignment, bytes);
    if (made) *block = made;
    return made ? 0 : 12; // ENOMEM
}

void *aligned_alloc(size_t alignment, size_t bytes) {
    return is_refused() ? NULL : __libc_memalign(alignment, bytes);
}

// One process is refused memory while it prepares, in the first round or a later one, which then all take back.
static void refuse_memory_of_triangulation(uint32_t d, int who, size_t *refused) {
    point_set p = make_points(d, RANDOM, SLABS, 240, 3 + d);
    uint64_t state = 17 + (uint64_t)rank;
    deldrift_mpi *m = NULL;
    OK(deldrift_mpi_create(MPI_COMM_WORLD, d, p.own, p.own_ids, p.own_count, NULL, &m));
    double *far = malloc((p.own_count + 1) * d * sizeof *far);
    for (size_t i = 0; i < p.own_count * d; i++) far[i] = random_number(&state);
    bool is_done = false;
    for (long k = 0; !is_done && k < 100000; k += 1 + k / 4) {
        uint64_t before, after;
        OK(deldrift_mpi_timestamp(m, &before));
        requests = 0;
        first_refused = rank == who ? k : -1;
        deldrift_status status = deldrift_mpi_commit(m, far, p.own_count, NULL);
        first_refused = -1;
        OK(deldrift_mpi_timestamp(m, &after));
        is_done = status == DELDRIFT_OK;
        CHECK(is_done ? after == before + 1
                      : status == DELDRIFT_OUT_OF_MEMORY && after == before && deldrift_mpi_refusing_process() == who);
        *refused += !is_done;
        is_serial(m, d, "after memory was refused while preparing");
    }
    CHECK(is_done);
    // Back, as if nothing had been refused.
    OK(deldrift_mpi_commit(m, p.own, p.own_count, NULL));
    is_serial(m, d, "back from where memory was refused");
    free(far);
    deldrift_mpi_destroy(m);
    free_points(&p);
}

// One process is refused memory at its first, second, third, ... request in a commit with edits, until it gets all it
// asks for.
static void refuse_memory(uint32_t d, bool is_weighted, int who, size_t *refused) {
    point_set p = make_points(d, RANDOM, SLABS, 240, 3 + d);
    uint64_t state = 17 + (uint64_t)rank;
    deldrift_mpi *m = NULL;
    OK(is_weighted ? deldrift_mpi_create_weighted(MPI_COMM_WORLD, d, p.own, NULL, p.own_ids, p.own_count, NULL, &m)
                   : deldrift_mpi_create(MPI_COMM_WORLD, d, p.own, p.own_ids, p.own_count, NULL, &m));
    for (long allowed = 0; allowed < 1000; allowed++) {
        uint64_t before, after, id = (uint64_t)(2 * (allowed * size + rank));
        double place[3] = {random_number(&state), random_number(&state), random_number(&state)};
        uint32_t first = 0;
        size_t count = 0, count_after = 0;
        OK(deldrift_mpi_count(m, &count));
        // Far enough that all have to send anew.
        double *far = malloc((count + 1) * d * sizeof *far);
        double *weights = malloc((count + 1) * sizeof *weights);
        for (size_t i = 0; i < count * d; i++) far[i] = random_number(&state);
        for (size_t i = 0; i <= count; i++) weights[i] = 0.02 * random_number(&state);
        OK(is_weighted ? deldrift_mpi_stage_insertions_with_weights(m, place, weights, &id, 1)
                       : deldrift_mpi_stage_insertions(m, place, &id, 1));
        if (count) OK(deldrift_mpi_stage_removals(m, &first, 1));
        OK(deldrift_mpi_timestamp(m, &before));
        if (rank == who) deldrift_mpi_allocations_left = allowed;
        deldrift_status status = is_weighted ? deldrift_mpi_commit_weighted(m, far, weights, count, NULL)
                                             : deldrift_mpi_commit(m, far, count, NULL);
        deldrift_mpi_allocations_left = -1;
        OK(deldrift_mpi_timestamp(m, &after));
        OK(deldrift_mpi_count(m, &count_after));
        is_serial(m, d, "after memory was refused");
        free(far);
        free(weights);
        if (status == DELDRIFT_OK) {
            CHECK(after == before + 1);
            break;
        }
        CHECK(status == DELDRIFT_OUT_OF_MEMORY && deldrift_mpi_refusing_process() == who && after == before &&
              count == count_after);
        ++*refused;
        OK(deldrift_mpi_discard(m));
    }
    deldrift_mpi_destroy(m);
    free_points(&p);
}

// Two vertices of different processes would meet, which the options reject: one process or two see it, when they know
// of both.
static void refuse_coincidence(uint32_t d) {
    point_set p = make_points(d, RANDOM, SLABS, 300, 5 + d);
    deldrift_options local;
    deldrift_mpi_options options;
    deldrift_options_init(&local);
    deldrift_mpi_options_init(&options);
    local.coincidence = DELDRIFT_COINCIDENCE_REJECT;
    options.local = &local;
    deldrift_mpi *m = NULL;
    OK(deldrift_mpi_create(MPI_COMM_WORLD, d, p.own, p.own_ids, p.own_count, &options, &m));
    double *moved = malloc((p.own_count + 1) * d * sizeof *moved);
    for (int attempt = 0; attempt < 5; attempt++) {
        for (size_t i = 0; i < p.own_count * d; i++) moved[i] = p.own[i] + 1e-3 * (double)(i % 7);
        // The first own vertex of each process goes to a place that is common to all.
        for (uint32_t k = 0; k < d && p.own_count; k++) moved[k] = 0.1 + 0.2 * attempt;
        uint64_t before = 0, after = 0;
        OK(deldrift_mpi_timestamp(m, &before));
        deldrift_status status = deldrift_mpi_commit(m, moved, p.own_count, NULL);
        OK(deldrift_mpi_timestamp(m, &after));
        CHECK(size == 1 ? status == DELDRIFT_OK : status == DELDRIFT_COINCIDENT && before == after);
        is_serial(m, d, "after coincident vertices were rejected");
        OK(deldrift_mpi_commit(m, p.own, p.own_count, NULL));
        is_serial(m, d, "after a commit that followed a rejected one");
    }
    free(moved);
    deldrift_mpi_destroy(m);
    free_points(&p);
}

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    size_t refused = 0, refused_within = 0;
    if (size > 1) plant();
    for (uint32_t d = 2; d <= 3; d++) {
        refuse_memory(d, false, size - 1, &refused);
        refuse_memory(d, true, size - 1, &refused);
        refuse_memory_of_triangulation(d, size / 2, &refused_within);
        refuse_coincidence(d);
    }
    if (rank == 0)
        printf("faults, P = %d: memory refused %zu times, and %zu times while preparing, %ld failures\n", size, refused,
               refused_within, failures);
    MPI_Finalize();
    return failures ? 1 : 0;
}
