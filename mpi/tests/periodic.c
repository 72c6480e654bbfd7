// Boxes that repeat: histories of motion, edits, migrations and refusals, each commit compared with the periodic
// triangulation that one process makes of all vertices, shifts included.
//     periodic FIRST COUNT [STEPS]    histories FIRST, FIRST + 1, ...
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"
#include "repeating.h"

static void move(history *h, int how) {
    uint32_t d = h->dimension;
    for (size_t i = 0; i < h->count; i++) {
        double *x = h->positions + i * d;
        if (how == 0) continue; // at rest
        if (how == 1 && random_bits(&h->state) % 10) continue;
        if (how == 2) {
            // To another period alone.
            for (uint32_t k = 0; k < d; k++) x[k] -= 2 * h->vectors[k];
            continue;
        }
        if (how == 3) {
            // All through the sides, by less than a period.
            for (uint32_t k = 0; k < d; k++) x[k] += 0.375 * h->vectors[k];
            continue;
        }
        if (h->kind == CUBES || h->kind == MEETING) {
            x[random_bits(&h->state) % d] += 0.125;
            continue;
        }
        for (uint32_t k = 0; k < d; k++) x[k] += h->amplitude * (2 * random_number(&h->state) - 1);
    }
}

static void stage_edits(history *h) {
    uint32_t d = h->dimension;
    size_t insertions = random_bits(&h->state) % 6, removals = 0, kept = 0;
    double places[6 * 3];
    uint64_t ids[6];
    for (size_t k = 0; k < insertions; k++) {
        place(h, &h->state, places + k * d);
        ids[k] = (h->next_id++ * (uint64_t)size + (uint64_t)rank) * 2; // even; those of the first are odd
    }
    if (h->heaviest > 0) {
        double *weights = make_weights(h, insertions);
        OK(deldrift_mpi_stage_insertions_with_weights(h->m, places, weights, ids, insertions));
        free(weights);
    } else {
        OK(deldrift_mpi_stage_insertions(h->m, places, ids, insertions));
    }
    uint32_t *removed = malloc((h->count + 1) * sizeof *removed);
    double *next = malloc((h->count + insertions + 1) * d * sizeof *next);
    double *wrong = malloc((h->count + 1) * d * sizeof *wrong);
    memcpy(wrong, h->positions, h->count * d * sizeof *wrong);
    for (size_t i = 0; i < h->count; i++) {
        if (random_bits(&h->state) % 12 == 0) {
            // What is not read may be anything.
            wrong[i * d] = NAN;
            removed[removals++] = (uint32_t)i;
        } else {
            memcpy(next + kept++ * d, h->positions + i * d, d * sizeof *next);
        }
    }
    OK(deldrift_mpi_stage_removals(h->m, removed, removals));
    OK(deldrift_mpi_commit(h->m, wrong, h->count, NULL));
    memcpy(next + kept * d, places, insertions * d * sizeof *next);
    free(h->positions);
    h->positions = next;
    h->count = kept + insertions;
    free(removed);
    free(wrong);
    h->edits++;
}

static void refuse_once(history *h) {
    uint32_t d = h->dimension;
    int who = (int)(random_bits(&h->common) % (uint64_t)size);
    double *wrong = malloc((h->count + 1) * d * sizeof *wrong);
    memcpy(wrong, h->positions, h->count * d * sizeof *wrong);
    for (size_t i = 0; i < h->count * d; i++) wrong[i] += 0.3;
    if (rank == who && h->count) wrong[0] = NAN;
    deldrift_status status = deldrift_mpi_commit(h->m, wrong, rank == who && !h->count ? 1 : h->count, NULL);
    CHECK(status == DELDRIFT_NOT_FINITE || status == DELDRIFT_WRONG_COUNT);
    CHECK(deldrift_mpi_refusing_process() == who);
    // Memory is refused in a later round, by one process, so that all take back what they have done.
    for (size_t i = 0; i < h->count * d; i++) wrong[i] = h->positions[i] + 0.3 * random_number(&h->state);
    if (rank == who) deldrift_mpi_allocations_left = 0;
    status = deldrift_mpi_commit(h->m, wrong, h->count, NULL);
    deldrift_mpi_allocations_left = -1;
    CHECK(status == DELDRIFT_OK || status == DELDRIFT_OUT_OF_MEMORY);
    if (status == DELDRIFT_OK) memcpy(h->positions, wrong, h->count * d * sizeof *wrong);
    free(wrong);
    h->refusals++;
}

static void migrate(history *h) {
    uint32_t d = h->dimension;
    int32_t *targets = calloc(h->count + 1, sizeof *targets);
    uint64_t choice = random_bits(&h->common);
    if (choice % 2)
        for (size_t i = 0; i < h->count; i++) targets[i] = (int32_t)(random_bits(&h->state) % (uint64_t)size);
    else
        OK(deldrift_mpi_partition(h->m, NULL, h->count, targets));
    const void *received = NULL;
    OK(deldrift_mpi_migrate(h->m, targets, h->count, h->positions, d * sizeof(double), &received, NULL));
    OK(deldrift_mpi_count(h->m, &h->count));
    h->positions = realloc(h->positions, (h->count + 1) * d * sizeof(double));
    if (h->count) memcpy(h->positions, received, h->count * d * sizeof(double));
    free(targets);
    h->has_taken = false;
    h->migrations++;
}

// Another box: a little longer or shorter, sheared, the same by other vectors, or twice as long one way. Positions stay
// as they are given, or are others. Where lengths are to be exact, so are the changes.
static void change_vectors(history *h) {
    bool is_exact = h->kind == CUBES || h->kind == MEETING;
    uint32_t d = h->dimension;
    uint64_t choice = random_bits(&h->common);
    double *first = h->vectors, *last = h->vectors + (h->vector_count - 1) * d;
    if (choice % 4 == 0) {
        for (uint32_t k = 0; k < d; k++) first[k] *= choice / 4 % 2 ? 2 : 0.5;
    } else if (choice % 4 == 1 && h->vector_count > 1) {
        // Of these steps some make other vectors the shortest ones.
        for (uint32_t k = 0; k < d; k++) last[k] += (choice / 4 % 2 ? 0.125 : -0.125) * first[k];
    } else if (choice % 4 == 2 && h->vector_count > 1) {
        for (uint32_t k = 0; k < d; k++) last[k] += first[k];
    } else {
        for (size_t k = 0; k < h->vector_count * d; k++) {
            double share = 0.2 * random_number(&h->common) - 0.1;
            if (h->vectors[k] != 0) h->vectors[k] *= is_exact ? 1.125 : 1 + share;
        }
    }
}

static void strain(history *h) {
    uint32_t d = h->dimension;
    double before[9];
    deldrift_mpi_report report;
    memcpy(before, h->vectors, sizeof before);
    change_vectors(h);
    uint64_t choice = random_bits(&h->common);
    if (choice % 2)
        for (size_t i = 0; i < h->count * d; i++) h->positions[i] += 0.125 * (double)(random_bits(&h->state) % 2);
    if (choice / 2 % 3 == 0) {
        // One process is refused memory, so that all take back what they have done; at which request differs.
        int who = (int)(choice / 16 % (uint64_t)size);
        if (rank == who) deldrift_mpi_allocations_left = (long)(choice / 1024 % 40);
        deldrift_status status =
            deldrift_mpi_commit_vectors(h->m, h->positions, h->count, h->vectors, h->vector_count, NULL);
        deldrift_mpi_allocations_left = -1;
        CHECK(status == DELDRIFT_OK || status == DELDRIFT_OUT_OF_MEMORY);
        if (status != DELDRIFT_OK) {
            CHECK(deldrift_mpi_refusing_process() == who);
            double next[9];
            memcpy(next, h->vectors, sizeof next);
            memcpy(h->vectors, before, sizeof before);
            // To the places that were refused, in the box that there was.
            OK(deldrift_mpi_commit(h->m, h->positions, h->count, NULL));
            is_right(h, "after memory was refused for other vectors");
            memcpy(h->vectors, next, sizeof next);
            h->refusals++;
        }
    }
    OK(deldrift_mpi_commit_vectors(h->m, h->positions, h->count, h->vectors, h->vector_count, &report));
    h->strains++;
    h->rebuilds += (long)report.is_rebuilt;
}

static void run(long number, int steps, history *totals) {
    history h;
    memset(&h, 0, sizeof h);
    h.common = (uint64_t)number * 77 + 5;
    h.dimension = 2 + (uint32_t)(number % 2);
    size_t box = (size_t)(number / 2) % BOXES;
    h.kind = (set_kind)((number / 2 + number / 12) % SETS);
    memcpy(h.vectors, boxes[h.dimension - 2][box], sizeof h.vectors);
    h.vector_count = vector_counts[h.dimension - 2][box];
    int spread = (int)(random_bits(&h.common) % 3);
    size_t n = 20 + random_bits(&h.common) % 60;
    if (h.kind == FEW) n = random_bits(&h.common) % 6;
    static const double AMPLITUDES[] = {1e-3, 1e-2, 0.1, 0.5};
    h.amplitude = AMPLITUDES[random_bits(&h.common) % 4];
    // Two histories of five have weights, of which the greatest hides few, or half of the vertices, or nearly all.
    static const double HEAVIEST[] = {0.1, 1, 16};
    if (number % 5 < 2)
        h.heaviest = HEAVIEST[random_bits(&h.common) % 3] / (h.kind == CUBES || h.kind == MEETING ? 16 : 40);
    totals->weighted += h.heaviest > 0;
    h.state = h.common ^ ((uint64_t)rank << 40);
    h.next_id = 1;
    deldrift_mpi_options options;
    deldrift_mpi_options_init(&options);
    options.boxes = 1 + (uint32_t)(random_bits(&h.common) % 8);
    options.drop_percent = (uint32_t)(random_bits(&h.common) % 3);
    begin(&h, n, spread, &options);
    if (!h.m) return;
    for (int step = 0; step < steps; step++) {
        char label[160];
        uint64_t choice = random_bits(&h.common);
        if (step && choice % 8 == 0) migrate(&h);
        if (step && choice / 256 % 3 == 0) stage_edits(&h);
        if (choice / 1024 % 5 == 0) refuse_once(&h);
        if (step && choice / 65536 % 4 == 0) {
            strain(&h);
            snprintf(label, sizeof label, "history %ld, step %d, other vectors: %uD %s, box %zu, spread %d, P = %d",
                     number, step, h.dimension, set_names[h.kind], box, spread, size);
            is_right(&h, label);
            check_places(&h);
        }
        if (step) {
            move(&h, choice / 8 % 16 < 8 ? (int)(choice / 8 % 16) / 2 : 4);
            const double *given = choice / 4096 % 4 || h.count ? h.positions : NULL;
            if (h.heaviest > 0 && choice / 262144 % 4) {
                double *weights = make_weights(&h, h.count);
                // Not all: the others are what they were.
                if (choice / 262144 % 4 < 3) {
                    double *before = malloc((h.count + 1) * sizeof *before);
                    read_weights(h.m, before);
                    for (size_t i = 0; i < h.count; i++)
                        if (random_bits(&h.state) % 4) weights[i] = before[i];
                    free(before);
                }
                OK(deldrift_mpi_commit_weighted(h.m, given, weights, h.count, NULL));
                free(weights);
            } else {
                OK(deldrift_mpi_commit(h.m, given, h.count, NULL));
            }
        }
        snprintf(label, sizeof label, "history %ld, step %d: %uD %s, box %zu, spread %d, P = %d", number, step,
                 h.dimension, set_names[h.kind], box, spread, size);
        is_right(&h, label);
        check_places(&h);
        // Not after each commit, so that lists are of several.
        if (random_bits(&h.common) % 2) check_changes(&h);
        h.commits++;
    }
    deldrift_mpi_destroy(h.m);
    free(h.positions);
    free(h.taken);
    totals->commits += h.commits;
    totals->refusals += h.refusals;
    totals->migrations += h.migrations;
    totals->edits += h.edits;
    totals->strains += h.strains;
    totals->rebuilds += h.rebuilds;
    totals->cells += h.cells;
    totals->changes += h.changes;
}

// One process is refused memory at its first, second, third, ... request in a commit with edits, until it gets all it
// asks for: all have what they had.
static void refuse_memory(uint32_t d, double heaviest, long *refused) {
    history h;
    memset(&h, 0, sizeof h);
    h.dimension = d;
    h.heaviest = heaviest;
    memcpy(h.vectors, boxes[d - 2][1], sizeof h.vectors);
    h.vector_count = d;
    h.common = 3;
    h.state = 17 + (uint64_t)rank;
    begin(&h, 40, 0, NULL);
    for (long allowed = 0; allowed < 1000; allowed++) {
        uint64_t before, after, id = (uint64_t)(2 * (allowed * size + rank));
        double inserted[3];
        uint32_t first = 0;
        double *far = malloc((h.count + 1) * d * sizeof *far);
        for (size_t i = 0; i < h.count * d; i++) far[i] = h.positions[i] + random_number(&h.state);
        place(&h, &h.state, inserted);
        double *weights = make_weights(&h, h.count + 1);
        OK(heaviest > 0 ? deldrift_mpi_stage_insertions_with_weights(h.m, inserted, weights + h.count, &id, 1)
                        : deldrift_mpi_stage_insertions(h.m, inserted, &id, 1));
        if (h.count) OK(deldrift_mpi_stage_removals(h.m, &first, 1));
        OK(deldrift_mpi_timestamp(h.m, &before));
        if (rank == size - 1) deldrift_mpi_allocations_left = allowed;
        deldrift_status status = heaviest > 0 ? deldrift_mpi_commit_weighted(h.m, far, weights, h.count, NULL)
                                              : deldrift_mpi_commit(h.m, far, h.count, NULL);
        deldrift_mpi_allocations_left = -1;
        free(weights);
        OK(deldrift_mpi_timestamp(h.m, &after));
        bool is_done = status == DELDRIFT_OK;
        CHECK(is_done ? after == before + 1 : status == DELDRIFT_OUT_OF_MEMORY && after == before);
        if (is_done) {
            size_t kept = h.count ? h.count - 1 : 0;
            h.positions = realloc(h.positions, (kept + 1) * d * sizeof *far);
            memcpy(h.positions, far + (h.count - kept) * d, kept * d * sizeof *far);
            memcpy(h.positions + kept * d, inserted, d * sizeof *far);
            h.count = kept + 1;
        }
        is_right(&h, "after memory was refused");
        check_places(&h);
        free(far);
        if (is_done) break;
        ++*refused;
        OK(deldrift_mpi_discard(h.m));
    }
    deldrift_mpi_destroy(h.m);
    free(h.positions);
}

// One process is refused memory at its first, second, third, ... request while changes are taken: none has taken them,
// and the list that is given in the end is of all that has changed.
static void refuse_memory_of_changes(uint32_t d, long *refused) {
    history h;
    memset(&h, 0, sizeof h);
    h.dimension = d;
    memcpy(h.vectors, boxes[d - 2][1], sizeof h.vectors);
    h.vector_count = d;
    h.common = 4;
    h.state = 18 + (uint64_t)rank;
    begin(&h, 40, 0, NULL);
    check_changes(&h);
    deldrift_status status = DELDRIFT_OUT_OF_MEMORY;
    for (long allowed = 0; status != DELDRIFT_OK && allowed < 100; allowed++) {
        deldrift_mpi_changes changes;
        memset(&changes, 0, sizeof changes);
        for (size_t i = 0; i < h.count * d; i++) h.positions[i] += 0.2 * random_number(&h.state);
        OK(deldrift_mpi_commit(h.m, h.positions, h.count, NULL));
        if (rank == size - 1) deldrift_mpi_allocations_left = allowed;
        status = deldrift_mpi_take_changes(h.m, &changes);
        deldrift_mpi_allocations_left = -1;
        CHECK(status == DELDRIFT_OK || status == DELDRIFT_OUT_OF_MEMORY);
        if (status == DELDRIFT_OK)
            follow_changes(&h, &changes);
        else
            ++*refused;
    }
    CHECK(status == DELDRIFT_OK);
    deldrift_mpi_destroy(h.m);
    free(h.positions);
    free(h.taken);
}

// Vectors that are near those before are a commit of moves, by which vertices keep their ids; others are a build.
static void follow_vectors(uint32_t d) {
    history h;
    memset(&h, 0, sizeof h);
    h.dimension = d;
    memcpy(h.vectors, boxes[d - 2][1], sizeof h.vectors);
    h.vector_count = d;
    h.common = 6 + d;
    begin(&h, 120, 0, NULL);
    size_t own = h.count;
    uint32_t *before = calloc(own + 1, sizeof *before), *after = calloc(own + 1, sizeof *after);
    deldrift_mpi_report report;
    OK(deldrift_mpi_vertices(h.m, NULL, before, own, &own));
    for (int step = 0; step < 12; step++) {
        bool is_far = step == 11;
        // Stretched along x and sheared along it, vertices with the box, by a thirty-second; at last twice as long.
        double share = is_far ? 1 : 0.03125;
        double *rows[2] = {h.positions, h.vectors};
        for (int r = 0; r < 2; r++)
            for (size_t i = 0; i < (r ? d : h.count); i++)
                rows[r][i * d] += share * (rows[r][i * d] + rows[r][i * d + 1]);
        OK(deldrift_mpi_commit_vectors(h.m, h.positions, h.count, h.vectors, d, &report));
        CHECK(report.is_rebuilt == is_far && report.timestamp == (uint64_t)step + 1);
        OK(deldrift_mpi_vertices(h.m, NULL, after, own, &own));
        if (!is_far) CHECK(!memcmp(before, after, own * sizeof *before));
        is_right(&h, "vectors that follow each other");
        check_places(&h);
    }
    free(before);
    free(after);
    deldrift_mpi_destroy(h.m);
    free(h.positions);
}

// What is not sent in one of the periods is missed by the comparison.
static void plant(void) {
    long wrong[2] = {0, 0};
    for (int is_planted = 0; is_planted < 2; is_planted++) {
        for (uint32_t d = 2; d <= 3; d++) {
            history h;
            memset(&h, 0, sizeof h);
            h.dimension = d;
            memcpy(h.vectors, boxes[d - 2][0], sizeof h.vectors);
            h.vector_count = vector_counts[d - 2][0];
            h.common = d;
            deldrift_mpi_fault = is_planted ? DM_FAULT_NO_PERIOD : DM_FAULT_NONE;
            begin(&h, 60, 0, NULL);
            wrong[is_planted] += !is_right(&h, NULL);
            deldrift_mpi_fault = DM_FAULT_NONE;
            deldrift_mpi_destroy(h.m);
            free(h.positions);
        }
    }
    CHECK(wrong[0] == 0 && wrong[1] == 2);
}

static void check_arguments(void) {
    deldrift_mpi *m = NULL;
    double place[3] = {0.5, 0.5, 0.5}, box[9] = {1, 0, 0, 1}, other[4] = {1, 0, 0, 2};
    uint64_t id = (uint64_t)rank;
    size_t count = 0;
    deldrift_mpi_changes changes;
    CHECK(deldrift_mpi_create_periodic(MPI_COMM_WORLD, 2, place, &id, 1, box, 0, NULL, &m) ==
          DELDRIFT_DEPENDENT_VECTORS);
    CHECK(deldrift_mpi_create_periodic(MPI_COMM_WORLD, 2, place, &id, 1, box, 3, NULL, &m) ==
          DELDRIFT_DEPENDENT_VECTORS);
    CHECK(deldrift_mpi_create_periodic(MPI_COMM_WORLD, 2, place, &id, 1, (double[]){1, 2, 2, 4}, 2, NULL, &m) ==
          DELDRIFT_DEPENDENT_VECTORS);
    CHECK(deldrift_mpi_create_periodic(MPI_COMM_WORLD, 2, place, &id, 1, (double[]){1, NAN, 2, 4}, 2, NULL, &m) ==
          DELDRIFT_NOT_FINITE);
    CHECK(deldrift_mpi_create_periodic(MPI_COMM_WORLD, 2, place, &id, 1, NULL, 2, NULL, &m) == DELDRIFT_NULL_ARGUMENT);
    if (size > 1) {
        CHECK(deldrift_mpi_create_periodic(MPI_COMM_WORLD, 2, place, &id, 1, rank == 1 ? other : box, 2, NULL, &m) ==
              DELDRIFT_INVALID_VALUE);
        CHECK(deldrift_mpi_create_periodic(MPI_COMM_WORLD, 2, place, &id, 1, box, rank == 1 ? 1 : 2, NULL, &m) ==
              DELDRIFT_INVALID_VALUE);
        CHECK(deldrift_mpi_refusing_process() == 1);
    }
    deldrift_options local;
    deldrift_mpi_options options;
    deldrift_options_init(&local);
    deldrift_mpi_options_init(&options);
    local.coincidence = DELDRIFT_COINCIDENCE_REJECT;
    options.local = &local;
    CHECK(deldrift_mpi_create_periodic(MPI_COMM_WORLD, 2, place, &id, 1, box, 2, &options, &m) ==
          DELDRIFT_INVALID_OPTIONS);
    CHECK(m == NULL);
    OK(deldrift_mpi_create_periodic(MPI_COMM_WORLD, 2, place, &id, 1, box, 2, NULL, &m));
    CHECK(deldrift_mpi_hull_facets(m, NULL, NULL, NULL, 0, &count) == DELDRIFT_PERIODIC);
    CHECK(deldrift_mpi_take_changes(m, rank == size - 1 ? NULL : &changes) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_refusing_process() == size - 1);
    OK(deldrift_mpi_take_changes(m, &changes));
    CHECK(changes.is_anew == 1 && !changes.removed_count);
    OK(deldrift_mpi_take_changes(m, &changes));
    CHECK(changes.is_anew == 0 && !changes.created_count && !changes.removed_count);
    CHECK(deldrift_mpi_cell_shifts(m, NULL, 0, NULL) == DELDRIFT_NULL_ARGUMENT);
    CHECK(deldrift_mpi_periods(m, NULL, 0, &count) == DELDRIFT_NULL_ARGUMENT && count > 0);
    int64_t shifts[2];
    CHECK(deldrift_mpi_periods(m, shifts, 1, &count) == DELDRIFT_BUFFER_TOO_SMALL);
    CHECK(deldrift_mpi_commit_vectors(m, place, 1, box, 1, NULL) == DELDRIFT_WRONG_COUNT);
    CHECK(deldrift_mpi_commit_vectors(m, NULL, 0, box, 2, NULL) == DELDRIFT_WRONG_COUNT);
    CHECK(deldrift_mpi_commit_vectors(m, place, 1, (double[]){1, 1, 1, 1}, 2, NULL) == DELDRIFT_DEPENDENT_VECTORS);
    if (size > 1)
        CHECK(deldrift_mpi_commit_vectors(m, place, 1, rank == 1 ? other : box, 2, NULL) == DELDRIFT_INVALID_VALUE);
    OK(deldrift_mpi_commit_vectors(m, place, 1, other, 2, NULL));
    place[0] = 1e30;
    CHECK(deldrift_mpi_stage_insertions(m, place, &id, 1) == DELDRIFT_OUT_OF_RANGE);
    CHECK(deldrift_mpi_commit(m, place, 1, NULL) == DELDRIFT_OUT_OF_RANGE);
    deldrift_mpi_destroy(m);
    m = NULL;
    OK(deldrift_mpi_create(MPI_COMM_WORLD, 2, place, &id, 1, NULL, &m));
    OK(deldrift_mpi_periods(m, shifts, 1, &count));
    CHECK(count >= 1 && shifts[0] == 0 && shifts[1] == 0);
    deldrift_mpi_destroy(m);
}

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    long first = argc > 1 ? atol(argv[1]) : 0, count = argc > 2 ? atol(argv[2]) : 20;
    int steps = argc > 3 ? atoi(argv[3]) : 8;
    history totals;
    memset(&totals, 0, sizeof totals);
    for (long number = first; number < first + count; number++) run(number, steps, &totals);
    long refused = 0;
    for (uint32_t d = 2; d <= 3; d++) {
        refuse_memory(d, 0, &refused);
        refuse_memory(d, 0.02, &refused);
        refuse_memory_of_changes(d, &refused);
        follow_vectors(d);
    }
    plant();
    check_arguments();
    if (rank == 0)
        printf("periodic, P = %d: %ld histories, %ld with weights, %ld commits, %ld cells, %ld hidden here, %ld edits, %ld other boxes, %ld of them built "
               "anew, %ld refusals, "
               "%ld migrations, %ld changes of cells here, %ld failures; memory refused %ld times\n",
               size, count, totals.weighted, totals.commits, totals.cells, compared_hidden, totals.edits, totals.strains, totals.rebuilds,
               totals.refusals, totals.migrations, totals.changes, failures, refused);
    MPI_Finalize();
    return failures ? 1 : 0;
}
