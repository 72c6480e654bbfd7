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

// A random walk with long steps, one with steps of which some are within tolerance, and one on a grid, where
// there are ties and coincident vertices.
typedef enum { FAR, NEAR, ON_GRID } motion;

// What has been seen of one algorithm.
typedef struct {
    uint64_t within_tolerance;
    uint64_t within_safe_region;
    uint64_t placements;
    uint64_t rebuilds;
} sums;

// Timestamps, with vertices in between that are moved at once or come and go.
static sums random_walk(uint32_t dimension, size_t count, deldrift_algorithm algorithm, motion motion) {
    bool on_grid = motion == ON_GRID;
    uint64_t state = 11;
    double *positions = random_positions(dimension, count, 8);
    size_t n = count * dimension;
    if (on_grid) {
        for (size_t i = 0; i < n; i++) positions[i] = floor(8 * positions[i]);
    }
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = algorithm;
    deldrift_triangulation *t = create(dimension, positions, count, &options);
    for (int step = 0; step < 6; step++) {
        for (size_t i = 0; i < n; i++) {
            double by = next_random(&state) - 0.5;
            positions[i] += on_grid ? floor(by * 1.2 + 0.5) : (motion == FAR ? 0.1 : 0.004) * by;
        }
        OK(deldrift_move_vertices(t, NULL, positions, count));
        OK(deldrift_commit_timestamp(t, NULL));
        OK(deldrift_validate(t, 3));
        has_the_cells_of_a_fresh_creation(t, dimension, positions, count);

        uint32_t v = (uint32_t)(next_random(&state) * (double)count);
        for (uint32_t k = 0; k < dimension; k++) positions[v * dimension + k] = on_grid ? 3 : 0.4;
        OK(deldrift_relocate_vertex(t, v, positions + v * dimension));
        has_the_cells_of_a_fresh_creation(t, dimension, positions, count);

        if (step % 2 == 1) {
            // Of an id behind all others, which the next step does not move.
            OK(deldrift_insert_vertex(t, (const double[]){0.6, 0.7, 0.5}, &v));
            CHECK(v == count + (size_t)step / 2);
            OK(deldrift_validate(t, 3));
            OK(deldrift_remove_vertex(t, v));
            has_the_cells_of_a_fresh_creation(t, dimension, positions, count);
        }
    }
    deldrift_commit_report report;
    uint64_t within_safe_region = 77;
    OK(deldrift_statistics(t, &report));
    OK(deldrift_research_within_safe_region(t, &within_safe_region));
    deldrift_destroy(t);
    free(positions);
    return (sums){report.within_tolerance, within_safe_region, report.placements, report.rebuilds};
}

// That each does what it is called after.
static void is_what_it_says(deldrift_algorithm algorithm, sums near) {
    bool by_tolerance = algorithm == DELDRIFT_TOLERANCE || algorithm == DELDRIFT_RESEARCH_SAFE_REGION_TOLERANCE;
    bool by_safe_region =
        algorithm == DELDRIFT_RESEARCH_SAFE_REGION || algorithm == DELDRIFT_RESEARCH_SAFE_REGION_TOLERANCE;
    bool may_turn_to_it = algorithm == DELDRIFT_RESEARCH_REBUILDING_TOLERANCE || algorithm == BY_WATCHING ||
                          algorithm == DELDRIFT_AUTO;
    if (!may_turn_to_it) CHECK((near.within_tolerance > 0) == by_tolerance);
    CHECK((near.within_safe_region > 0) == by_safe_region);
    if (algorithm == DELDRIFT_REBUILDING) CHECK(near.rebuilds == 6);
    bool may_rebuild = algorithm == DELDRIFT_REBUILDING || algorithm == DELDRIFT_RESEARCH_REBUILDING_TOLERANCE;
    if (!may_rebuild) CHECK(near.rebuilds < 6);
    if (by_tolerance || by_safe_region) CHECK(near.rebuilds == 0 && near.placements > 0);
}

int main(void) {
    static const deldrift_algorithm all[] = ALL_ALGORITHMS;
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        corners = dimension + 1;
        for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
            random_walk(dimension, 150, all[i], FAR);
            random_walk(dimension, 150, all[i], ON_GRID);
            is_what_it_says(all[i], random_walk(dimension, 150, all[i], NEAR));
        }
    }
    return 0;
}
