#include "repeating.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

const char *const set_names[SETS] = {"random", "cubes", "few", "cluster", "at the same places"};

const double boxes[2][BOXES][9] = {
    {{1, 0, 0, 1}, {1, 0, 0.25, 1}, {1, 0, 7.5, 1}, {4, 0, 0, 0.25}, {1, 0}, {1, 0.5}},
    {{1, 0, 0, 0, 1, 0, 0, 0, 1},
     {1, 0, 0, 0.25, 1, 0, 0.5, -0.25, 1},
     {1, 0, 0, 3.25, 1, 0, -5, 2.5, 1},
     {3, 0, 0, 0, 1, 0, 0, 0, 0.25},
     {1, 0, 0, 0.125, 1, 0},
     {1, 0.25, 0.5}}};
const size_t vector_counts[2][BOXES] = {{2, 2, 2, 2, 1, 1}, {3, 3, 3, 3, 2, 1}};

void place(const history *h, uint64_t *state, double *x) {
    double share[3] = {0, 0, 0};
    uint32_t d = h->dimension;
    for (uint32_t k = 0; k < d; k++) {
        share[k] = random_number(state);
        if (h->kind == CUBES) share[k] = floor(share[k] * 4) / 4;
        if (h->kind == MEETING) share[k] = floor(share[k] * 3) / 4;
        if (h->kind == CLUSTER) share[k] = 0.97 + 0.06 * share[k];
    }
    for (uint32_t k = 0; k < d; k++) x[k] = h->vector_count < d ? 0.5 * share[k] : 0;
    for (size_t j = 0; j < h->vector_count; j++) {
        double multiple = share[j] + (double)(random_bits(state) % 5) - 2;
        for (uint32_t k = 0; k < d; k++) x[k] += multiple * h->vectors[j * d + k];
    }
}

static int compare_corners(const void *first, const void *second) {
    const corner *a = first, *b = second;
    if (a->id != b->id) return a->id < b->id ? -1 : 1;
    for (int k = 0; k < 3; k++)
        if (a->shift[k] != b->shift[k]) return a->shift[k] < b->shift[k] ? -1 : 1;
    return 0;
}

static int compare_cells(const void *first, const void *second) {
    const cell *a = first, *b = second;
    for (int i = 0; i < 4; i++) {
        int order = compare_corners(&a->corners[i], &b->corners[i]);
        if (order) return order;
    }
    return 0;
}

// Two corners are swapped where that makes the orientation what it was.
static cell cell_of(uint32_t d, const uint64_t *ids, const int64_t *shifts) {
    cell c;
    memset(&c, 0, sizeof c);
    for (uint32_t i = 0; i <= d; i++) {
        c.corners[i].id = ids[i];
        memcpy(c.corners[i].shift, shifts + i * d, d * sizeof *shifts);
    }
    int swaps = 0;
    for (uint32_t i = 1; i <= d; i++) {
        for (uint32_t j = i; j > 0 && compare_corners(&c.corners[j], &c.corners[j - 1]) < 0; j--, swaps++) {
            corner kept = c.corners[j];
            c.corners[j] = c.corners[j - 1];
            c.corners[j - 1] = kept;
        }
    }
    if (swaps % 2) {
        corner kept = c.corners[d];
        c.corners[d] = c.corners[d - 1];
        c.corners[d - 1] = kept;
    }
    return c;
}

static cell *cells_of(uint32_t d, const uint64_t *ids, const int64_t *shifts, size_t count) {
    cell *cells = malloc((count + 1) * sizeof *cells);
    for (size_t c = 0; c < count; c++) cells[c] = cell_of(d, ids + c * (d + 1), shifts + c * (d + 1) * d);
    qsort(cells, count, sizeof *cells, compare_cells);
    return cells;
}

double *make_weights(history *h, size_t count) {
    double *weights = malloc((count + 1) * sizeof *weights);
    for (size_t i = 0; i < count; i++) {
        double share = random_number(&h->state);
        weights[i] = h->heaviest * (h->kind == CUBES || h->kind == MEETING ? floor(5 * share) / 4 : share);
    }
    return weights;
}

typedef struct {
    uint64_t id;
    double position[3], weight;
} vertex;

static int compare_vertices(const void *first, const void *second) {
    const vertex *a = first, *b = second;
    return a->id < b->id ? -1 : a->id > b->id;
}

// The cells that one process has of all vertices, by global ids, and whether it hides those that are hidden here.
static cell *serial_cells(const history *h, const vertex *all, size_t n, size_t *count, bool *hides) {
    uint32_t d = h->dimension, corners = d + 1;
    double *positions = malloc((n + 1) * d * sizeof *positions);
    for (size_t i = 0; i < n; i++) memcpy(positions + i * d, all[i].position, d * sizeof *positions);
    deldrift_triangulation *t = NULL;
    *hides = true;
    if (h->heaviest > 0) {
        double *weights = malloc((n + 1) * sizeof *weights);
        uint64_t *of_vertices = malloc((n + 1) * sizeof *of_vertices);
        for (size_t i = 0; i < n; i++) weights[i] = all[i].weight;
        for (size_t i = 0; i < n; i++) of_vertices[i] = all[i].id;
        OK(deldrift_create_periodic_weighted(d, positions, weights, n, h->vectors, h->vector_count, NULL, &t));
        *hides = hides_the_same(h->m, t, of_vertices);
        free(weights);
        free(of_vertices);
    } else {
        OK(deldrift_create_periodic(d, positions, n, h->vectors, h->vector_count, NULL, &t));
    }
    deldrift_cells_view view;
    OK(deldrift_cells(t, &view));
    uint64_t *ids = malloc((view.count * corners + 1) * sizeof *ids);
    int64_t *shifts = malloc((view.count * corners * d + 1) * sizeof *shifts);
    for (size_t i = 0; i < view.count * corners; i++) ids[i] = all[view.vertices[i]].id;
    OK(deldrift_cell_shifts(t, shifts, NULL, view.count, count));
    cell *cells = cells_of(d, ids, shifts, *count);
    deldrift_destroy(t);
    free(positions);
    free(ids);
    free(shifts);
    return cells;
}

static cell *own_cells(const history *h, size_t *count) {
    uint32_t d = h->dimension, corners = d + 1;
    OK(deldrift_mpi_cells(h->m, NULL, NULL, 0, count));
    uint64_t *ids = malloc((*count * corners + 1) * sizeof *ids);
    int64_t *shifts = malloc((*count * corners * d + 1) * sizeof *shifts);
    OK(deldrift_mpi_cells(h->m, ids, NULL, *count, count));
    OK(deldrift_mpi_cell_shifts(h->m, shifts, *count, count));
    cell *cells = cells_of(d, ids, shifts, *count);
    free(ids);
    free(shifts);
    return cells;
}

// All cells of the triangulation of the process with an own vertex at home are among those of the whole, and each such
// vertex is in as many of them as there are in the whole.
static bool has_right_stars(const history *h, const uint64_t *own_ids, const cell *serial, size_t count) {
    uint32_t d = h->dimension, corners = d + 1;
    const deldrift_triangulation *t;
    deldrift_cells_view view;
    size_t ids = 0, own = h->count, expected = 0, found = 0;
    OK(deldrift_mpi_local(h->m, &t));
    OK(deldrift_mpi_owners(h->m, NULL, 0, &ids));
    uint64_t *keys = malloc((ids + 1) * sizeof *keys);
    uint32_t *vertices = malloc((own + 1) * sizeof *vertices);
    bool *is_own = calloc(ids + 1, sizeof *is_own), is_right = true;
    int64_t *periods = malloc((ids + 1) * d * sizeof *periods);
    OK(deldrift_keys(t, keys, ids, &ids));
    OK(deldrift_mpi_vertices(h->m, NULL, vertices, own, &own));
    OK(deldrift_mpi_periods(h->m, periods, ids, &ids));
    for (size_t i = 0; i < own; i++) is_own[vertices[i]] = true;
    OK(deldrift_cells(t, &view));
    for (size_t c = 0; c < view.count; c++) {
        const uint32_t *v = view.vertices + c * corners;
        uint64_t row[4];
        int64_t shifts[12];
        size_t incidences = 0;
        for (uint32_t i = 0; i < corners; i++) incidences += is_own[v[i]];
        if (!incidences) continue;
        found += incidences;
        uint32_t least = dm_least(h->m, v, corners);
        for (uint32_t i = 0; i < corners; i++) {
            row[i] = keys[v[i]];
            for (uint32_t k = 0; k < d; k++)
                shifts[i * d + k] = periods[v[i] * d + k] - periods[least * d + k];
        }
        cell wanted = cell_of(d, row, shifts);
        is_right = is_right && bsearch(&wanted, serial, count, sizeof *serial, compare_cells);
    }
    for (size_t c = 0; c < count; c++)
        for (uint32_t i = 0; i < corners; i++)
            for (size_t k = 0; k < own; k++) expected += serial[c].corners[i].id == own_ids[k];
    free(keys);
    free(vertices);
    free(is_own);
    free(periods);
    return is_right && expected == found;
}

bool is_right(history *h, const char *label) {
    uint32_t d = h->dimension;
    size_t own = h->count, bytes = 0, count = 0, mine = 0;
    uint64_t *own_ids = malloc((own + 1) * sizeof *own_ids);
    vertex *vertices = calloc(own + 1, sizeof *vertices);
    OK(deldrift_mpi_vertices(h->m, own_ids, NULL, own, &own));
    for (size_t i = 0; i < own; i++) {
        vertices[i].id = own_ids[i];
        memcpy(vertices[i].position, h->positions + i * d, d * sizeof(double));
    }
    if (h->heaviest > 0) {
        double *weights = malloc((own + 1) * sizeof *weights);
        read_weights(h->m, weights);
        for (size_t i = 0; i < own; i++) vertices[i].weight = weights[i];
        free(weights);
    }
    vertex *all = gather(vertices, own * sizeof *vertices, &bytes);
    size_t n = bytes / sizeof *all;
    qsort(all, n, sizeof *all, compare_vertices);
    bool hides;
    cell *serial = serial_cells(h, all, n, &count, &hides), *parts = own_cells(h, &mine);
    cell *whole = gather(parts, mine * sizeof *parts, &bytes);
    size_t total = bytes / sizeof *whole;
    qsort(whole, total, sizeof *whole, compare_cells);
    int results[3] = {total == count && !memcmp(whole, serial, count * sizeof *serial),
                      has_right_stars(h, own_ids, serial, count), hides};
    int everywhere[3];
    MPI_Allreduce(results, everywhere, 3, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    bool holds = everywhere[0] && everywhere[1] && everywhere[2];
    if (!holds && label && rank == 0)
        fprintf(stderr, "%s: union %s (%zu of %zu cells of %zu vertices), stars %s, hidden %s\n", label,
                everywhere[0] ? "right" : "WRONG", total, count, n, everywhere[1] ? "right" : "WRONG",
                everywhere[2] ? "right" : "WRONG");
    if (label && !holds) failures++;
    h->cells += (long)count;
    free(own_ids);
    free(vertices);
    free(all);
    free(serial);
    free(parts);
    free(whole);
    return holds;
}

// A cell without its orientation, the same for all translations of it: two cells with the same corners are one.
static cell class_of(uint32_t d, const uint64_t *ids, const int64_t *shifts) {
    cell c;
    memset(&c, 0, sizeof c);
    for (uint32_t i = 0; i <= d; i++) {
        c.corners[i].id = ids[i];
        memcpy(c.corners[i].shift, shifts + i * d, d * sizeof *shifts);
    }
    qsort(c.corners, d + 1, sizeof *c.corners, compare_corners);
    corner first = c.corners[0];
    for (uint32_t i = 0; i <= d; i++)
        for (uint32_t k = 0; k < d; k++) c.corners[i].shift[k] -= first.shift[k];
    return c;
}

static cell *classes_of(uint32_t d, const uint64_t *ids, const int64_t *shifts, size_t count) {
    cell *cells = malloc((count + 1) * sizeof *cells);
    for (size_t c = 0; c < count; c++) cells[c] = class_of(d, ids + c * (d + 1), shifts + c * (d + 1) * d);
    qsort(cells, count, sizeof *cells, compare_cells);
    return cells;
}

// Created cells are told as deldrift_mpi_cells and deldrift_mpi_cell_shifts do, but for the period of the cell.
static void check_created(uint32_t d, const deldrift_mpi_changes *changes, const uint64_t *ids, const int64_t *shifts,
                          const uint32_t *indices, size_t count) {
    uint32_t corners = d + 1;
    size_t own = 0;
    for (size_t k = 0; k < changes->created_count; k++) {
        while (own < count && indices[own] != changes->created_cells[k]) own++;
        CHECK(own < count);
        if (own == count) return;
        CHECK(!memcmp(ids + own * corners, changes->created + k * corners, corners * sizeof *ids));
        const int64_t *told = changes->created_shifts + k * corners * d, *row = shifts + own * corners * d;
        for (uint32_t i = 0; i < corners * d; i++) CHECK(told[i] - told[i % d] == row[i] - row[i % d]);
        cell c = class_of(d, changes->created + k * corners, told);
        bool has_origin = false;
        for (uint32_t i = 0; i < corners; i++) {
            corner first = {changes->created[k * corners + i], {0, 0, 0}};
            memcpy(first.shift, told + i * d, d * sizeof *told);
            has_origin = has_origin || !compare_corners(&first, &c.corners[0]);
        }
        CHECK(has_origin);
    }
}

void follow_changes(history *h, const deldrift_mpi_changes *given) {
    uint32_t d = h->dimension, corners = d + 1;
    size_t count = 0, kept = 0, gone = 0;
    deldrift_mpi_changes changes = *given;
    CHECK(changes.is_anew == (size_t)!h->has_taken);
    OK(deldrift_mpi_cells(h->m, NULL, NULL, 0, &count));
    uint64_t *ids = malloc((count * corners + 1) * sizeof *ids);
    uint32_t *indices = malloc((count + 1) * sizeof *indices);
    int64_t *shifts = malloc((count * corners * d + 1) * sizeof *shifts);
    OK(deldrift_mpi_cells(h->m, ids, indices, count, &count));
    OK(deldrift_mpi_cell_shifts(h->m, shifts, count, &count));
    check_created(d, &changes, ids, shifts, indices, count);
    size_t before = changes.is_anew ? 0 : h->taken_count;
    cell *now = classes_of(d, ids, shifts, count);
    cell *created = classes_of(d, changes.created, changes.created_shifts, changes.created_count);
    cell *removed = classes_of(d, changes.removed, changes.removed_shifts, changes.removed_count);
    cell *cells = malloc((before + changes.created_count + 1) * sizeof *cells);
    for (size_t c = 0; c < before; c++) {
        // One that is listed as created was not there.
        CHECK(!bsearch(&h->taken[c], created, changes.created_count, sizeof *created, compare_cells));
        if (gone < changes.removed_count && !compare_cells(&h->taken[c], &removed[gone]))
            gone++;
        else
            cells[kept++] = h->taken[c];
    }
    CHECK(gone == changes.removed_count);
    if (changes.created_count) memcpy(cells + kept, created, changes.created_count * sizeof *cells);
    kept += changes.created_count;
    qsort(cells, kept, sizeof *cells, compare_cells);
    CHECK(kept == count && !memcmp(cells, now, count * sizeof *now));
    h->changes += (long)(changes.created_count + changes.removed_count);
    free(h->taken);
    h->taken = now;
    h->taken_count = count;
    h->has_taken = true;
    free(ids);
    free(indices);
    free(shifts);
    free(created);
    free(removed);
    free(cells);
}

void check_changes(history *h) {
    deldrift_mpi_changes changes;
    memset(&changes, 0, sizeof changes);
    OK(deldrift_mpi_take_changes(h->m, &changes));
    follow_changes(h, &changes);
}

void check_places(const history *h) {
    uint32_t d = h->dimension;
    const deldrift_triangulation *t;
    size_t ids = 0, own = h->count;
    OK(deldrift_mpi_local(h->m, &t));
    OK(deldrift_mpi_owners(h->m, NULL, 0, &ids));
    uint32_t *vertices = malloc((own + 1) * sizeof *vertices);
    int32_t *owners = malloc((ids + 1) * sizeof *owners);
    double *given = calloc((ids + 1) * d, sizeof *given), *volumes = malloc((ids + 1) * sizeof *volumes);
    int64_t *periods = malloc((ids + 1) * d * sizeof *periods);
    OK(deldrift_mpi_vertices(h->m, NULL, vertices, own, &own));
    OK(deldrift_mpi_owners(h->m, owners, ids, &ids));
    OK(deldrift_mpi_periods(h->m, periods, ids, &ids));
    for (size_t i = 0; i < own; i++) memcpy(given + vertices[i] * d, h->positions + i * d, d * sizeof *given);
    OK(deldrift_mpi_exchange(h->m, given, d * sizeof *given, ids));
    for (size_t v = 0; v < ids; v++) {
        double position[3];
        if (owners[v] < 0) continue;
        OK(deldrift_position(t, (uint32_t)v, position));
        for (uint32_t k = 0; k < d; k++) {
            double there = given[v * d + k];
            for (size_t j = 0; j < h->vector_count; j++)
                there += (double)periods[v * d + j] * h->vectors[j * d + k];
            CHECK(fabs(there - position[k]) < 1e-9);
        }
    }
    double sum[2] = {0, (double)own}, whole[2], box = 1;
    if (own && ids) OK(deldrift_voronoi_volumes(t, NULL, NULL, volumes, ids, &ids));
    for (size_t i = 0; i < own; i++) sum[0] += volumes[vertices[i]];
    MPI_Allreduce(sum, whole, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    for (uint32_t k = 0; k < d; k++) box *= h->vectors[k * d + k];
    if (h->vector_count == d && whole[1] > 0) CHECK(fabs(whole[0] - box) < 1e-9 * box);
    free(vertices);
    free(owners);
    free(given);
    free(volumes);
    free(periods);
}

void begin(history *h, size_t n, int spread, const deldrift_mpi_options *options) {
    uint32_t d = h->dimension;
    uint64_t *ids = malloc((n + 1) * sizeof *ids), state = h->common + 1;
    h->positions = malloc((n + 1) * d * sizeof *h->positions);
    h->count = 0;
    for (size_t i = 0; i < n; i++) {
        double x[3];
        place(h, &state, x);
        uint64_t bits = random_bits(&state);
        double share = x[0] / (fabs(h->vectors[0]) + (d == 2 ? 0 : 1));
        int owner = spread == 0 ? (int)((share - floor(share)) * size) : spread == 1 ? (int)(bits % (uint64_t)size) : 0;
        if (owner % size != rank) continue;
        memcpy(h->positions + h->count * d, x, d * sizeof *x);
        ids[h->count++] = (i + 1) * 0x9e3779b97f4a7c15u | 1;
    }
    if (h->heaviest > 0) {
        double *weights = make_weights(h, h->count);
        OK(deldrift_mpi_create_periodic_weighted(MPI_COMM_WORLD, d, h->positions, weights, ids, h->count, h->vectors,
                                                 h->vector_count, options, &h->m));
        free(weights);
    } else {
        OK(deldrift_mpi_create_periodic(MPI_COMM_WORLD, d, h->positions, ids, h->count, h->vectors, h->vector_count,
                                        options, &h->m));
    }
    free(ids);
}
