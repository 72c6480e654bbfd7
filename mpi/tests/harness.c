#include "harness.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int rank, size;
long failures, compared_cells;

void check(bool holds, const char *text, const char *file, int line) {
    if (holds) return;
    failures++;
    fprintf(stderr, "process %d: %s:%d: %s does not hold; last message: %s\n", rank, file, line, text,
            deldrift_mpi_last_error());
}

uint64_t random_bits(uint64_t *state) {
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

double random_number(uint64_t *state) {
    return (double)(random_bits(state) >> 11) * 0x1p-53;
}

const char *const kind_names[KINDS] = {"random", "lattice", "sheared", "clusters",
                                       "sphere", "line",    "plane",   "duplicates"};
const char *const spread_names[SPREADS] = {"slabs",        "scattered",    "blocks", "first and last empty",
                                           "one owns all", "few elsewhere"};

// A point of integer coordinates on a circle or sphere around 0 that has hundreds of them: cospherical without
// rounding.
static void place_on_sphere(uint32_t d, uint64_t *state, double *x) {
    static const int64_t SQUARES[2] = {5928325, 5909};
    int64_t left = SQUARES[d - 2], root = (int64_t)sqrt((double)left);
    for (;;) {
        int64_t rest = left, y[3] = {0, 0, 0};
        for (uint32_t k = 0; k + 1 < d; k++) {
            y[k] = (int64_t)(random_bits(state) % (uint64_t)(2 * root + 1)) - root;
            rest -= y[k] * y[k];
        }
        y[d - 1] = rest < 0 ? -1 : (int64_t)sqrt((double)rest);
        if (y[d - 1] < 0 || y[d - 1] * y[d - 1] != rest) continue;
        if (random_bits(state) % 2) y[d - 1] = -y[d - 1];
        for (uint32_t k = 0; k < d; k++) x[k] = (double)y[k];
        return;
    }
}

static void place(uint32_t d, point_kind kind, size_t i, size_t count, uint64_t *state, double *x) {
    size_t side = (size_t)ceil(pow((double)count, 1.0 / d) - 1e-9);
    for (uint32_t k = 0; k < d; k++) x[k] = random_number(state);
    switch (kind) {
        case LATTICE:
        case SHEARED:
            for (uint32_t k = 0; k < d; k++, i /= side) x[k] = (double)(i % side);
            if (kind == SHEARED) x[0] += 0.125 * x[1];
            break;
        case CLUSTERS:
            for (uint32_t k = 0; k < d; k++) x[k] = (double)(i % 5 * (k + 3) % 5) + x[k] * x[k] * x[k] * 0.01;
            break;
        case SPHERE: place_on_sphere(d, state, x); break;
        case LINE:
            for (uint32_t k = 0; k < d; k++) x[k] = (double)(k + 1) * (double)i;
            break;
        case PLANE:
            for (uint32_t k = 0; k < d; k++) x[k] = floor(x[k] * 64);
            x[d - 1] = x[0] + (d == 3 ? x[1] : 0);
            break;
        case DUPLICATES:
            for (uint32_t k = 0; k < d; k++) x[k] = floor(x[k] * 5);
            break;
        default: break;
    }
}

static int owner_of(uint32_t d, point_spread spread, size_t i, const double *x, const double *low, const double *high,
                    uint64_t *state) {
    double share[3] = {0, 0, 0};
    for (uint32_t k = 0; k < d; k++) share[k] = high[k] > low[k] ? (x[k] - low[k]) / (high[k] - low[k]) : 0;
    int slab = (int)(share[0] * size);
    if (slab >= size) slab = size - 1;
    uint64_t bits = random_bits(state);
    switch (spread) {
        case SLABS: return slab;
        case SCATTERED: return (int)(bits % (uint64_t)size);
        case BLOCKS: {
            int code = 0;
            for (uint32_t k = 0; k < d; k++) code = 2 * code + (share[k] > 0.5);
            return code % size;
        }
        case FIRST_EMPTY: return size < 3 ? size - 1 : 1 + slab * (size - 2) / size;
        case ONE_OWNS_ALL: return size / 2;
        case FEW_ELSEWHERE: return i < 4 * (size_t)size ? (int)(i % (size_t)size) : 0;
        default: return 0;
    }
}

void collect_own(point_set *p) {
    uint32_t d = p->dimension;
    p->own_count = 0;
    for (size_t i = 0; i < p->count; i++) {
        if (p->owners[i] != rank) continue;
        memcpy(p->own + p->own_count * d, p->positions + i * d, d * sizeof(double));
        p->own_ids[p->own_count++] = p->ids[i];
    }
}

point_set make_points(uint32_t d, point_kind kind, point_spread spread, size_t count, uint64_t seed) {
    point_set p = {d,
                   count,
                   0,
                   calloc(count * d + 1, sizeof(double)),
                   calloc(count + 1, sizeof(uint64_t)),
                   calloc(count + 1, sizeof(int)),
                   calloc(count * d + 1, sizeof(double)),
                   calloc(count + 1, sizeof(uint64_t))};
    uint64_t state = seed;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++) {
        double *x = p.positions + i * d;
        place(d, kind, i, count, &state, x);
        for (uint32_t k = 0; k < d; k++) {
            low[k] = fmin(low[k], x[k]);
            high[k] = fmax(high[k], x[k]);
        }
    }
    for (size_t i = 0; i < count; i++) {
        // An odd factor, so no two are the same, and their order is none of space.
        p.ids[i] = (i + 1) * 0x9e3779b97f4a7c15u;
        p.owners[i] = owner_of(d, spread, i, p.positions + i * d, low, high, &state);
    }
    collect_own(&p);
    return p;
}

void free_points(point_set *p) {
    free(p->positions);
    free(p->ids);
    free(p->owners);
    free(p->own);
    free(p->own_ids);
}

static int compare_numbers(const void *first, const void *second) {
    uint64_t a = *(const uint64_t *)first, b = *(const uint64_t *)second;
    return a < b ? -1 : a > b;
}

static uint32_t row_length;

static int compare_rows(const void *first, const void *second) {
    const uint64_t *a = first, *b = second;
    for (uint32_t k = 0; k < row_length; k++)
        if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
    return 0;
}

// Rotates and swaps in pairs: rows of the same corners and orientation become the same.
static void normalise(uint64_t *row, uint32_t length) {
    int swaps = 0;
    for (uint32_t i = 1; i < length; i++)
        for (uint32_t j = i; j > 0 && row[j] < row[j - 1]; j--, swaps++) {
            uint64_t kept = row[j];
            row[j] = row[j - 1];
            row[j - 1] = kept;
        }
    if (swaps % 2) {
        uint64_t kept = row[length - 1];
        row[length - 1] = row[length - 2];
        row[length - 2] = kept;
    }
}

static void sort_rows(uint64_t *rows, size_t count, uint32_t length) {
    for (size_t i = 0; i < count; i++) normalise(rows + i * length, length);
    row_length = length;
    qsort(rows, count, length * sizeof *rows, compare_rows);
}

void sort_sets(uint64_t *rows, size_t count, uint32_t length) {
    for (size_t i = 0; i < count; i++) qsort(rows + i * length, length, sizeof *rows, compare_numbers);
    row_length = length;
    qsort(rows, count, length * sizeof *rows, compare_rows);
}

void *gather(const void *mine, size_t bytes, size_t *total) {
    int *counts = calloc(2 * (size_t)size, sizeof *counts), *offsets = counts + size, count = (int)bytes;
    MPI_Allgather(&count, 1, MPI_INT, counts, 1, MPI_INT, MPI_COMM_WORLD);
    for (int p = 1; p < size; p++) offsets[p] = offsets[p - 1] + counts[p - 1];
    *total = (size_t)(offsets[size - 1] + counts[size - 1]);
    void *all = malloc(*total + 1);
    MPI_Allgatherv(mine, count, MPI_BYTE, all, counts, offsets, MPI_BYTE, MPI_COMM_WORLD);
    free(counts);
    return all;
}

typedef struct {
    uint64_t *rows;
    size_t count;
} table;

static bool is_same(table a, table b, uint32_t length) {
    return a.count == b.count && (!a.count || !memcmp(a.rows, b.rows, a.count * length * sizeof *a.rows));
}

static table gather_rows(table mine, uint32_t length) {
    size_t bytes;
    table all;
    all.rows = gather(mine.rows, mine.count * length * sizeof *mine.rows, &bytes);
    all.count = bytes / (length * sizeof *mine.rows);
    return all;
}

static table serial_cells(const deldrift_triangulation *t, const uint64_t *ids) {
    deldrift_cells_view view;
    OK(deldrift_cells(t, &view));
    uint32_t corners = view.corners_per_cell;
    table cells = {malloc(view.count * corners * sizeof(uint64_t) + 1), view.count};
    for (size_t i = 0; i < view.count * corners; i++) cells.rows[i] = ids[view.vertices[i]];
    return cells;
}

static table serial_facets(const deldrift_triangulation *t, const uint64_t *ids, uint32_t d) {
    size_t count = 0;
    OK(deldrift_hull_facets(t, NULL, NULL, NULL, 0, &count));
    uint32_t *facets = malloc(count * d * sizeof *facets + 1);
    table rows = {malloc(count * d * sizeof(uint64_t) + 1), count};
    OK(deldrift_hull_facets(t, facets, NULL, NULL, count, &count));
    for (size_t i = 0; i < count * d; i++) rows.rows[i] = ids[facets[i]];
    free(facets);
    return rows;
}

// The rows with an own id.
static table select_own(table all, uint32_t length, const uint64_t *own_ids, size_t own_count) {
    uint64_t *sorted = malloc(own_count * sizeof *sorted + 1);
    memcpy(sorted, own_ids, own_count * sizeof *sorted);
    qsort(sorted, own_count, sizeof *sorted, compare_numbers);
    table chosen = {malloc(all.count * length * sizeof(uint64_t) + 1), 0};
    for (size_t c = 0; c < all.count; c++) {
        bool is_own = false;
        for (uint32_t k = 0; k < length; k++)
            is_own = is_own || bsearch(&all.rows[c * length + k], sorted, own_count, sizeof *sorted, compare_numbers);
        if (is_own) memcpy(chosen.rows + chosen.count++ * length, all.rows + c * length, length * sizeof(uint64_t));
    }
    free(sorted);
    return chosen;
}

static table local_cells(const deldrift_triangulation *t) {
    size_t count = 0;
    OK(deldrift_keys(t, NULL, 0, &count));
    uint64_t *keys = malloc(count * sizeof *keys + 1);
    OK(deldrift_keys(t, keys, count, &count));
    table cells = serial_cells(t, keys);
    free(keys);
    return cells;
}

bool has_weights(const deldrift_triangulation *t) {
    bool has = false;
    OK(deldrift_is_weighted(t, &has));
    return has;
}

// The keys of all vertices that are hidden, by weight or by place, that a mask by id has.
static table hidden_keys(const deldrift_triangulation *t, const uint64_t *keys, const bool *is_wanted) {
    size_t by_weight = 0, by_place = 0, n = 0;
    OK(deldrift_hidden_by_weight(t, NULL, NULL, 0, &by_weight));
    OK(deldrift_hidden_vertices(t, NULL, NULL, 0, &by_place));
    uint32_t *vertices = malloc((by_weight + by_place + 1) * sizeof *vertices);
    OK(deldrift_hidden_by_weight(t, vertices, NULL, by_weight, &n));
    OK(deldrift_hidden_vertices(t, vertices + by_weight, NULL, by_place, &n));
    table hidden = {malloc((by_weight + by_place + 1) * sizeof(uint64_t)), 0};
    for (size_t k = 0; k < by_weight + by_place; k++)
        if (is_wanted[vertices[k]]) hidden.rows[hidden.count++] = keys[vertices[k]];
    free(vertices);
    sort_rows(hidden.rows, hidden.count, 1);
    return hidden;
}

// Whether each own vertex that is hidden by weight is in a cell of the whole, as is told.
static bool are_in_cells(const deldrift_triangulation *t, const uint64_t *keys, const bool *is_own, table whole) {
    size_t n = 0;
    deldrift_cells_view view;
    OK(deldrift_cells(t, &view));
    OK(deldrift_hidden_by_weight(t, NULL, NULL, 0, &n));
    uint32_t *vertices = malloc((2 * n + 1) * sizeof *vertices), *cells = vertices + n, length = view.corners_per_cell;
    bool are_in = true;
    OK(deldrift_hidden_by_weight(t, vertices, cells, n, &n));
    for (size_t k = 0; k < n; k++) {
        uint64_t row[4];
        if (!is_own[vertices[k]] || !whole.count) continue;
        for (uint32_t i = 0; i < length; i++) row[i] = keys[view.vertices[cells[k] * length + i]];
        normalise(row, length);
        row_length = length;
        are_in = are_in && bsearch(row, whole.rows, whole.count, length * sizeof *row, compare_rows);
    }
    free(vertices);
    return are_in;
}

long compared_hidden;

bool hides_the_same(const deldrift_mpi *m, const deldrift_triangulation *serial, const uint64_t *ids) {
    const deldrift_triangulation *t;
    size_t own = 0, n_keys = 0, n = 0;
    OK(deldrift_mpi_local(m, &t));
    OK(deldrift_mpi_count(m, &own));
    OK(deldrift_keys(t, NULL, 0, &n_keys));
    OK(deldrift_id_count(serial, &n));
    uint64_t *keys = calloc(n_keys + 1, sizeof *keys), *own_ids = calloc(own + 1, sizeof *own_ids);
    uint32_t *vertices = calloc(own + 1, sizeof *vertices);
    bool *is_own = calloc(n_keys + 1, sizeof *is_own), *is_wanted = calloc(n + 1, sizeof *is_wanted);
    OK(deldrift_keys(t, keys, n_keys, &n_keys));
    OK(deldrift_mpi_vertices(m, own_ids, vertices, own, &own));
    for (size_t i = 0; i < own; i++) is_own[vertices[i]] = true;
    qsort(own_ids, own, sizeof *own_ids, compare_numbers);
    for (size_t v = 0; v < n; v++) is_wanted[v] = bsearch(&ids[v], own_ids, own, sizeof *own_ids, compare_numbers);
    table here = hidden_keys(t, keys, is_own), there = hidden_keys(serial, ids, is_wanted);
    bool holds = is_same(here, there, 1);
    deldrift_cells_view view;
    OK(deldrift_cells(serial, &view));
    size_t n_vectors = 0;
    OK(deldrift_vectors(serial, NULL, 0, &n_vectors));
    if (!n_vectors && view.count) {
        table cells = serial_cells(serial, ids);
        sort_rows(cells.rows, cells.count, view.corners_per_cell);
        holds = holds && are_in_cells(t, keys, is_own, cells);
        free(cells.rows);
    }
    compared_hidden += (long)there.count;
    free(here.rows);
    free(there.rows);
    free(keys);
    free(own_ids);
    free(vertices);
    free(is_own);
    free(is_wanted);
    return holds;
}

void read_weights(const deldrift_mpi *m, double *weights) {
    const deldrift_triangulation *t;
    size_t own = 0, n = 0;
    OK(deldrift_mpi_local(m, &t));
    OK(deldrift_mpi_count(m, &own));
    OK(deldrift_weights(t, NULL, 0, &n));
    double *all = malloc((n + 1) * sizeof *all);
    uint32_t *vertices = malloc((own + 1) * sizeof *vertices);
    OK(deldrift_weights(t, all, n, &n));
    OK(deldrift_mpi_vertices(m, NULL, vertices, own, &own));
    for (size_t i = 0; i < own; i++) weights[i] = all[vertices[i]];
    free(all);
    free(vertices);
}

// The triangulation that one process makes; with weights if `m` has them. Collective.
static deldrift_triangulation *make_serial(const deldrift_mpi *m, uint32_t d, const double *all, const uint64_t *ids,
                                           size_t count) {
    const deldrift_triangulation *t;
    deldrift_triangulation *serial = NULL;
    size_t own = 0, bytes = 0;
    OK(deldrift_mpi_local(m, &t));
    if (!has_weights(t)) {
        OK(deldrift_create_with_keys(d, all, ids, count, NULL, &serial));
        return serial;
    }
    OK(deldrift_mpi_count(m, &own));
    double *mine = malloc((own + 1) * sizeof *mine);
    read_weights(m, mine);
    double *weights = gather(mine, own * sizeof *mine, &bytes);
    OK(deldrift_create_weighted(d, all, weights, ids, count, NULL, &serial));
    free(mine);
    free(weights);
    return serial;
}

bool is_serial(const deldrift_mpi *m, uint32_t d, const char *label) {
    const deldrift_triangulation *t;
    size_t own = 0, bytes = 0;
    OK(deldrift_mpi_local(m, &t));
    OK(deldrift_mpi_count(m, &own));
    uint64_t *own_ids = malloc(own * sizeof *own_ids + 1);
    uint32_t *vertices = malloc(own * sizeof *vertices + 1);
    double *positions = malloc(own * d * sizeof *positions + 1);
    OK(deldrift_mpi_vertices(m, own_ids, vertices, own, &own));
    for (size_t i = 0; i < own; i++) OK(deldrift_position(t, vertices[i], positions + i * d));
    uint64_t *ids = gather(own_ids, own * sizeof *own_ids, &bytes);
    double *all = gather(positions, own * d * sizeof *positions, &bytes);
    size_t count = bytes / (d * sizeof *all);

    deldrift_triangulation *serial = make_serial(m, d, all, ids, count);
    table cells = serial_cells(serial, ids), facets = serial_facets(serial, ids, d);
    sort_rows(cells.rows, cells.count, d + 1);
    sort_rows(facets.rows, facets.count, d);

    table mine = {NULL, 0}, mine_facets = {NULL, 0};
    OK(deldrift_mpi_cells(m, NULL, NULL, 0, &mine.count));
    mine.rows = malloc(mine.count * (d + 1) * sizeof(uint64_t) + 1);
    OK(deldrift_mpi_cells(m, mine.rows, NULL, mine.count, &mine.count));
    OK(deldrift_mpi_hull_facets(m, NULL, NULL, NULL, 0, &mine_facets.count));
    mine_facets.rows = malloc(mine_facets.count * d * sizeof(uint64_t) + 1);
    OK(deldrift_mpi_hull_facets(m, mine_facets.rows, NULL, NULL, mine_facets.count, &mine_facets.count));
    table whole = gather_rows(mine, d + 1), whole_facets = gather_rows(mine_facets, d);
    sort_rows(whole.rows, whole.count, d + 1);
    sort_rows(whole_facets.rows, whole_facets.count, d);

    table local = local_cells(t);
    sort_rows(local.rows, local.count, d + 1);
    table local_own = select_own(local, d + 1, own_ids, own), serial_own = select_own(cells, d + 1, own_ids, own);

    // Without cells a process knows of no others, which may hide its vertices.
    int results[4] = {is_same(cells, whole, d + 1), is_same(facets, whole_facets, d),
                      is_same(local_own, serial_own, d + 1),
                      !has_weights(t) || !cells.count || hides_the_same(m, serial, ids)};
    int all_results[4];
    MPI_Allreduce(results, all_results, 4, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    bool holds = all_results[0] && all_results[1] && all_results[2] && all_results[3];
    if (!holds && label && rank == 0)
        fprintf(stderr, "%s: union %s (%zu of %zu cells), hull %s (%zu of %zu), own cells %s, hidden %s\n", label,
                all_results[0] ? "right" : "WRONG", whole.count, cells.count, all_results[1] ? "right" : "WRONG",
                whole_facets.count, facets.count, all_results[2] ? "right" : "WRONG",
                all_results[3] ? "right" : "WRONG");
    if (label && !holds) failures++;
    compared_cells += (long)cells.count;
    table tables[] = {cells, facets, mine, mine_facets, whole, whole_facets, local, local_own, serial_own};
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) free(tables[i].rows);
    deldrift_destroy(serial);
    free(own_ids);
    free(vertices);
    free(positions);
    free(ids);
    free(all);
    return holds;
}
