// The same motion by every algorithm: the cells are the same, and those of a fresh creation.
#include "check.h"

enum { MOST_CORNERS = 4 };
static uint32_t corners;

static int compare_ids(const void *a, const void *b) {
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static int compare_cells(const void *a, const void *b) {
    const uint32_t *x = a, *y = b;
    for (uint32_t i = 0; i < corners; i++) {
        if (x[i] != y[i]) return x[i] < y[i] ? -1 : 1;
    }
    return 0;
}

// The cells, each with ascending ids, in ascending order.
static uint32_t *sorted_cells(const deldrift_triangulation *t, size_t *count) {
    OK(deldrift_copy_cells(t, NULL, NULL, 0, count));
    uint32_t *cells = malloc((*count * corners + 1) * sizeof *cells);
    CHECK(cells != NULL);
    OK(deldrift_copy_cells(t, cells, NULL, *count, count));
    for (size_t c = 0; c < *count; c++) qsort(cells + c * corners, corners, sizeof *cells, compare_ids);
    qsort(cells, *count, corners * sizeof *cells, compare_cells);
    return cells;
}

static void has_the_cells_of_a_fresh_creation(const deldrift_triangulation *t, uint32_t dimension,
                                              const double *positions, size_t count) {
    deldrift_triangulation *fresh = create(dimension, positions, count, NULL);
    size_t mine = 0, theirs = 0;
    uint32_t *cells = sorted_cells(t, &mine), *wanted = sorted_cells(fresh, &theirs);
    CHECK(mine == theirs);
    CHECK(memcmp(cells, wanted, mine * corners * sizeof *cells) == 0);
    free(cells);
    free(wanted);
    deldrift_destroy(fresh);
}

// Timestamps of a random walk; on a grid if there are to be ties, and with coincident vertices then.
static void random_walk(uint32_t dimension, size_t count, deldrift_algorithm algorithm, bool on_grid) {
    uint64_t state = 11;
    double *positions = random_positions(dimension, count, 8);
    size_t n = count * dimension;
    if (on_grid) {
        for (size_t i = 0; i < n; i++) positions[i] = floor(8 * positions[i]);
    }
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = algorithm;
    options.track_changes = 1;
    deldrift_triangulation *t = create(dimension, positions, count, &options);
    for (int step = 0; step < 6; step++) {
        for (size_t i = 0; i < n; i++) {
            double by = next_random(&state) - 0.5;
            positions[i] += on_grid ? floor(by * 1.2 + 0.5) : 0.1 * by;
        }
        OK(deldrift_move_vertices(t, NULL, positions, count));
        OK(deldrift_commit_timestamp(t, NULL));
        OK(deldrift_validate(t, 3));
        has_the_cells_of_a_fresh_creation(t, dimension, positions, count);

        uint32_t v = (uint32_t)(next_random(&state) * (double)count);
        for (uint32_t k = 0; k < dimension; k++) positions[v * dimension + k] = on_grid ? 3 : 0.4;
        OK(deldrift_relocate_vertex(t, v, positions + v * dimension));
        has_the_cells_of_a_fresh_creation(t, dimension, positions, count);
    }
    deldrift_destroy(t);
    free(positions);
}

int main(void) {
    static const deldrift_algorithm all[] = {DELDRIFT_AUTO, DELDRIFT_REBUILDING, DELDRIFT_PLACEMENT,
                                             DELDRIFT_PLACEMENT_FLIPS,
        DELDRIFT_TOLERANCE, DELDRIFT_SAFE_REGION, DELDRIFT_SAFE_REGION_TOLERANCE, DELDRIFT_REBUILDING_TOLERANCE};
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        corners = dimension + 1;
        for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
            random_walk(dimension, 150, all[i], false);
            random_walk(dimension, 150, all[i], true);
        }
    }
    return 0;
}
