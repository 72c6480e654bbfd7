// Histories: motion, edits, migrations and refusals, each commit compared with the triangulation of one process.
//     moving FIRST COUNT [STEPS]    histories FIRST, FIRST + 1, ...
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"

typedef struct {
    uint32_t dimension;
    deldrift_mpi *m;
    double *positions, *weights; // of own vertices
    double heaviest;             // weights are up to this, and 0 without weights
    size_t count;
    double amplitude;
    uint64_t state;  // differs between processes
    uint64_t common; // is the same on all
    uint64_t next_id;
    uint64_t *cells; // own ones, when changes were last taken
    size_t cell_count;
    bool has_migrated; // since then
    long changes;
    long commits, refusals, migrations, extra_rounds, edits, weighted;
} history;

static void read_own(history *h) {
    const deldrift_triangulation *t;
    OK(deldrift_mpi_local(h->m, &t));
    OK(deldrift_mpi_count(h->m, &h->count));
    uint32_t *vertices = calloc(h->count + 1, sizeof *vertices);
    OK(deldrift_mpi_vertices(h->m, NULL, vertices, h->count, &h->count));
    h->positions = realloc(h->positions, (h->count + 1) * h->dimension * sizeof(double));
    for (size_t i = 0; i < h->count; i++) OK(deldrift_position(t, vertices[i], h->positions + i * h->dimension));
    free(vertices);
    h->weights = realloc(h->weights, (h->count + 1) * sizeof(double));
    if (h->heaviest > 0) read_weights(h->m, h->weights);
}

// Whole numbers of a few steps, so that there are ties, or any.
static double any_weight(history *h, bool is_whole) {
    double share = random_number(&h->state);
    return h->heaviest * (is_whole ? floor(5 * share) / 4 : share);
}

// All, some, or none; the heaviest vertex of a process may outweigh all others, or be as light as any.
static void reweigh(history *h, int how) {
    for (size_t i = 0; i < h->count; i++) {
        if (how == 0 || (how == 1 && random_bits(&h->state) % 10)) continue;
        if (how == 2)
            h->weights[i] += 0.01 * h->heaviest * (2 * random_number(&h->state) - 1);
        else
            h->weights[i] = any_weight(h, how == 3);
    }
    if (how == 1 && h->count) h->weights[0] = random_bits(&h->state) % 2 ? 10 * h->heaviest : 0;
}

static void move(history *h, int how) {
    uint32_t d = h->dimension;
    for (size_t i = 0; i < h->count; i++) {
        double *x = h->positions + i * d;
        if (how == 0) continue; // at rest
        if (how == 1 && random_bits(&h->state) % 10) continue;
        if (how == 2) {
            x[0] += h->amplitude * (double)rank;
            continue;
        }
        if (how == 3) {
            x[d - 1] = 0.5 * x[0]; // all into a line or plane
            continue;
        }
        for (uint32_t k = 0; k < d; k++) x[k] += h->amplitude * (2 * random_number(&h->state) - 1);
    }
}

static void stage_edits(history *h) {
    uint32_t d = h->dimension;
    double *places = malloc(20 * d * sizeof *places);
    uint64_t ids[20];
    size_t insertions = random_bits(&h->state) % 20, removals = 0;
    for (size_t k = 0; k < insertions; k++) {
        for (uint32_t j = 0; j < d; j++) places[k * d + j] = 8 * random_number(&h->state);
        ids[k] =
            (h->next_id++ * (uint64_t)size + (uint64_t)rank) * 2; // even; those of the first points are odd multiples
    }
    double weights[20];
    for (size_t k = 0; k < insertions; k++) weights[k] = any_weight(h, k % 2);
    if (h->heaviest > 0 && insertions % 4)
        OK(deldrift_mpi_stage_insertions_with_weights(h->m, places, weights, ids, insertions));
    else
        OK(deldrift_mpi_stage_insertions(h->m, places, ids, insertions));
    uint32_t *removed = malloc((h->count + 1) * sizeof *removed);
    for (size_t i = 0; i < h->count; i++)
        if (random_bits(&h->state) % 16 == 0) removed[removals++] = (uint32_t)i;
    OK(deldrift_mpi_stage_removals(h->m, removed, removals));
    free(places);
    free(removed);
}

static void refuse_once(history *h) {
    uint32_t d = h->dimension;
    int who = (int)(random_bits(&h->common) % (uint64_t)size);
    uint64_t before = 0, after = 0;
    OK(deldrift_mpi_timestamp(h->m, &before));
    // Entries of vertices whose removal is staged are not read, and not all of so many are.
    bool is_possible = rank == who && h->count >= 40;
    double *wrong = malloc((h->count + 1) * d * sizeof *wrong);
    memcpy(wrong, h->positions, h->count * d * sizeof *wrong);
    for (size_t i = 0; is_possible && i < h->count; i++) wrong[i * d + 1] = NAN;
    deldrift_status status =
        deldrift_mpi_commit(h->m, wrong, rank == who && !is_possible ? h->count + 1 : h->count, NULL);
    CHECK(status == DELDRIFT_NOT_FINITE || status == DELDRIFT_WRONG_COUNT);
    CHECK(deldrift_mpi_refusing_process() == who);
    OK(deldrift_mpi_timestamp(h->m, &after));
    CHECK(before == after);
    free(wrong);
    h->refusals++;
}

static void migrate(history *h) {
    uint32_t d = h->dimension;
    int32_t *targets = calloc(h->count + 1, sizeof *targets);
    uint64_t choice = random_bits(&h->common);
    double *weights = calloc(h->count + 1, sizeof *weights);
    for (size_t i = 0; i < h->count; i++) weights[i] = 1 + (double)(random_bits(&h->state) % 4);
    if (choice % 4 == 0) {
        for (size_t i = 0; i < h->count; i++) targets[i] = (int32_t)(random_bits(&h->state) % (uint64_t)size);
    } else if (choice % 4 == 1) {
        for (size_t i = 0; i < h->count; i++) targets[i] = (int32_t)(choice / 4 % (uint64_t)size);
    } else {
        OK(deldrift_mpi_partition(h->m, choice % 4 == 2 ? NULL : weights, h->count, targets));
    }
    const void *received = NULL;
    OK(deldrift_mpi_migrate(h->m, targets, h->count, h->positions, d * sizeof(double), &received, NULL));
    free(targets);
    free(weights);
    double *carried = NULL, *of_weights = calloc(h->count + 1, sizeof(double));
    memcpy(of_weights, h->weights, h->count * sizeof(double));
    double sums[4] = {0, 0, 0, 0};
    for (size_t i = 0; i < h->count; i++) sums[0] += h->heaviest > 0 ? of_weights[i] : 0;
    free(of_weights);
    read_own(h);
    carried = h->positions;
    CHECK(!h->count || !memcmp(carried, received, h->count * d * sizeof(double)));
    for (size_t i = 0; i < h->count; i++) sums[1] += h->heaviest > 0 ? h->weights[i] : 0;
    MPI_Allreduce(sums, sums + 2, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    CHECK(fabs(sums[2] - sums[3]) <= 1e-9 * fabs(sums[2]) + 1e-300);
    h->has_migrated = true;
    h->migrations++;
}

// What deldrift_mpi_exchange brings to copies is what their owners have.
static void check_exchange(history *h) {
    const deldrift_triangulation *t;
    size_t ids = 0;
    OK(deldrift_mpi_local(h->m, &t));
    OK(deldrift_mpi_owners(h->m, NULL, 0, &ids));
    int32_t *owners = calloc(ids + 1, sizeof *owners);
    uint64_t *keys = calloc(ids + 1, sizeof *keys), *values = calloc(2 * ids + 1, sizeof *values);
    OK(deldrift_mpi_owners(h->m, owners, ids, &ids));
    OK(deldrift_keys(t, keys, ids, &ids));
    for (size_t v = 0; v < ids; v++)
        if (owners[v] == rank) {
            values[2 * v] = ~keys[v];
            values[2 * v + 1] = (uint64_t)rank;
        }
    OK(deldrift_mpi_exchange(h->m, values, 2 * sizeof *values, ids));
    for (size_t v = 0; v < ids; v++) {
        bool present = false;
        OK(deldrift_is_present(t, (uint32_t)v, &present));
        CHECK(present == (owners[v] >= 0));
        if (present) CHECK(values[2 * v] == ~keys[v] && values[2 * v + 1] == (uint64_t)owners[v]);
    }
    free(owners);
    free(keys);
    free(values);
}

// The own cells, in order, as rows without orientation.
static uint64_t *own_cells(const history *h, size_t *count) {
    OK(deldrift_mpi_cells(h->m, NULL, NULL, 0, count));
    uint64_t *rows = malloc(*count * (h->dimension + 1) * sizeof *rows + 1);
    OK(deldrift_mpi_cells(h->m, rows, NULL, *count, count));
    sort_sets(rows, *count, h->dimension + 1);
    return rows;
}

// Own cells before, without those that are said to be removed, and with those that are said to be created, are those
// now.
static void check_changes(history *h) {
    uint32_t length = h->dimension + 1;
    size_t count = 0, kept = 0, found = 0;
    deldrift_mpi_changes changes;
    OK(deldrift_mpi_take_changes(h->m, &changes));
    CHECK(changes.is_anew == (size_t)!h->cells || h->has_migrated);
    CHECK(!changes.is_anew || !changes.removed_count);
    uint64_t *now = own_cells(h, &count);
    uint64_t *removed = malloc(changes.removed_count * length * sizeof *removed + 1);
    if (changes.removed_count) memcpy(removed, changes.removed, changes.removed_count * length * sizeof *removed);
    sort_sets(removed, changes.removed_count, length);
    size_t before = changes.is_anew ? 0 : h->cell_count;
    uint64_t *rows = malloc((before + changes.created_count) * length * sizeof *rows + 1);
    for (size_t c = 0; c < before; c++) {
        const uint64_t *row = h->cells + c * length;
        if (found < changes.removed_count && !memcmp(row, removed + found * length, length * sizeof *row))
            found++;
        else
            memcpy(rows + kept++ * length, row, length * sizeof *row);
    }
    CHECK(found == changes.removed_count);
    if (changes.created_count)
        memcpy(rows + kept * length, changes.created, changes.created_count * length * sizeof *rows);
    kept += changes.created_count;
    sort_sets(rows, kept, length);
    CHECK(kept == count && !memcmp(rows, now, count * length * sizeof *rows));
    h->has_migrated = false;
    h->changes += (long)(changes.created_count + changes.removed_count);
    free(removed);
    free(rows);
    free(h->cells);
    h->cells = now;
    h->cell_count = count;
}

// Voronoi cells of own vertices fill the box, taken over all processes.
static void check_volumes(const history *h) {
    uint32_t d = h->dimension;
    const deldrift_triangulation *t;
    size_t ids = 0, own = 0;
    deldrift_mpi_report report;
    OK(deldrift_mpi_last_report(h->m, &report));
    if (!report.is_spanning) return;
    OK(deldrift_mpi_local(h->m, &t));
    OK(deldrift_id_count(t, &ids));
    OK(deldrift_mpi_count(h->m, &own));
    double low[3] = {-2, -2, -2}, high[3] = {9, 9, 9}, sum = 0, whole = 0;
    double *volumes = calloc(ids + 1, sizeof *volumes);
    uint32_t *vertices = calloc(own + 1, sizeof *vertices);
    OK(deldrift_mpi_vertices(h->m, NULL, vertices, own, &own));
    if (own) OK(deldrift_voronoi_volumes(t, low, high, volumes, ids, &ids));
    for (size_t i = 0; i < own; i++) sum += volumes[vertices[i]];
    MPI_Allreduce(&sum, &whole, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    CHECK(fabs(whole / pow(11, d) - 1) < 1e-9);
    free(volumes);
    free(vertices);
}

static void run(long number, int steps, history *totals) {
    history h;
    memset(&h, 0, sizeof h);
    h.common = (uint64_t)number * 77 + 5;
    h.dimension = 2 + (uint32_t)(random_bits(&h.common) % 2);
    point_kind kind = (point_kind)(random_bits(&h.common) % KINDS);
    point_spread spread = (point_spread)(random_bits(&h.common) % SPREADS);
    size_t count = 20 + random_bits(&h.common) % 400;
    if (kind == SPHERE) count = count / 4 + 4;
    static const double AMPLITUDES[] = {1e-3, 1e-2, 0.1, 1};
    double spacing = kind == LATTICE || kind == SHEARED ? 1 : 1 / pow((double)count, 1.0 / h.dimension);
    h.amplitude = AMPLITUDES[random_bits(&h.common) % 4] * spacing;
    h.state = h.common ^ ((uint64_t)rank << 40);
    h.next_id = 1;
    // Two histories of five have weights, of which the greatest hides few, or half of the vertices, or nearly all.
    static const double HEAVIEST[] = {0.1, 1, 16};
    if (number % 5 < 2) h.heaviest = HEAVIEST[random_bits(&h.common) % 3] * spacing * spacing;
    point_set p = make_points(h.dimension, kind, spread, count, h.common);
    for (size_t i = 0; i < p.count; i++) p.ids[i] |= 1;
    for (size_t i = 0; i < p.own_count; i++) p.own_ids[i] |= 1;
    deldrift_mpi_options options;
    deldrift_mpi_options_init(&options);
    options.boxes = 1 + (uint32_t)(random_bits(&h.common) % 8);
    options.drop_percent = (uint32_t)(random_bits(&h.common) % 3);
    if (h.heaviest > 0) {
        double *weights = malloc((p.own_count + 1) * sizeof *weights);
        for (size_t i = 0; i < p.own_count; i++) weights[i] = any_weight(&h, number % 2);
        OK(deldrift_mpi_create_weighted(MPI_COMM_WORLD, h.dimension, p.own, weights, p.own_ids, p.own_count, &options,
                                        &h.m));
        free(weights);
    } else {
        OK(deldrift_mpi_create(MPI_COMM_WORLD, h.dimension, p.own, p.own_ids, p.own_count, &options, &h.m));
    }
    free_points(&p);
    if (!h.m) return;
    read_own(&h);
    for (int step = 0; step < steps; step++) {
        char label[160];
        uint64_t choice = random_bits(&h.common);
        deldrift_mpi_report report;
        if (choice % 8 == 0) migrate(&h);
        move(&h, choice / 8 % 16 < 4 ? (int)(choice / 8 % 16) : 4);
        if (choice / 256 % 3 == 0) {
            stage_edits(&h);
            h.edits++;
        }
        if (choice / 1024 % 5 == 0) refuse_once(&h);
        if (h.heaviest > 0) {
            // Weights and positions, or one of these on some processes and the other on others.
            uint64_t given = choice / 65536 % 4 ? 0 : random_bits(&h.state) % 3;
            reweigh(&h, (int)(choice / 1048576 % 5));
            OK(deldrift_mpi_commit_weighted(h.m, given == 1 ? NULL : h.positions, given == 2 ? NULL : h.weights,
                                            h.count, &report));
        } else {
            OK(deldrift_mpi_commit(h.m, h.positions, h.count, &report));
        }
        snprintf(label, sizeof label, "history %ld, step %d: %uD %s, %s, P = %d", number, step, h.dimension,
                 kind_names[kind], spread_names[spread], size);
        is_serial(h.m, h.dimension, label);
        check_exchange(&h);
        // Not after each commit, so that ids stand for several vertices in turn.
        if (random_bits(&h.common) % 2) check_changes(&h);
        if (!(choice / 8192 % 4)) check_volumes(&h);
        read_own(&h);
        h.commits++;
        h.extra_rounds += report.rounds > 1;
    }
    deldrift_mpi_destroy(h.m);
    free(h.positions);
    free(h.weights);
    free(h.cells);
    totals->weighted += h.heaviest > 0;
    totals->changes += h.changes;
    totals->commits += h.commits;
    totals->refusals += h.refusals;
    totals->migrations += h.migrations;
    totals->extra_rounds += h.extra_rounds;
    totals->edits += h.edits;
}

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    long first = argc > 1 ? atol(argv[1]) : 0, count = argc > 2 ? atol(argv[2]) : 20;
    int steps = argc > 3 ? atoi(argv[3]) : 12;
    history totals;
    memset(&totals, 0, sizeof totals);
    for (long number = first; number < first + count; number++) run(number, steps, &totals);
    if (rank == 0)
        printf("moving, P = %d: %ld histories, %ld with weights, %ld commits, %ld cells, %ld hidden here, %ld with "
               "edits, %ld refusals, %ld migrations, %ld changes of cells here, %ld failures; %ld commits took more "
               "than one round\n",
               size, count, totals.weighted, totals.commits, compared_cells, compared_hidden, totals.edits,
               totals.refusals, totals.migrations, totals.changes, failures, totals.extra_rounds);
    MPI_Finalize();
    return failures ? 1 : 0;
}
