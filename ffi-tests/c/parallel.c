// Calls that work on several threads: the cells are those of one thread, and in the same order where parts are given.
#include "check.h"

enum { COUNT = 2000 };

static deldrift_triangulation *moved(uint32_t dimension, deldrift_algorithm algorithm, uint32_t threads,
                                     size_t parts) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = algorithm;
    options.threads = threads;
    options.parts = parts;
    double *positions = random_positions(dimension, COUNT, 1);
    deldrift_triangulation *t = create(dimension, positions, COUNT, &options);
    uint64_t state = 2;
    for (int step = 0; step < 3; step++) {
        for (size_t i = 0; i < COUNT * dimension; i++) positions[i] += 1e-3 * next_random(&state);
        OK(deldrift_move_vertices(t, NULL, positions, COUNT));
        OK(deldrift_commit_timestamp(t, NULL));
    }
    free(positions);
    return t;
}

// The order of the cells may depend on the threads; a sum over all of a scrambled product of their ids does not.
static uint64_t digest(const deldrift_triangulation *t, size_t *count) {
    deldrift_cells_view cells;
    OK(deldrift_cells(t, &cells));
    uint64_t sum = 0;
    for (size_t c = 0; c < cells.count; c++) {
        uint64_t product = 1;
        for (uint32_t i = 0; i < cells.corners_per_cell; i++)
            product *= 2 * (uint64_t)cells.vertices[c * cells.corners_per_cell + i] + 3;
        product *= 0x9e3779b97f4a7c15u;
        sum += product ^ product >> 29;
    }
    *count = cells.count;
    return sum;
}

static bool has_same_order(const deldrift_triangulation *t, const deldrift_triangulation *other) {
    deldrift_cells_view cells, others;
    OK(deldrift_cells(t, &cells));
    OK(deldrift_cells(other, &others));
    const size_t bytes = cells.count * cells.corners_per_cell * sizeof(uint32_t);
    return cells.count == others.count && memcmp(cells.vertices, others.vertices, bytes) == 0 &&
           memcmp(cells.neighbours, others.neighbours, bytes) == 0;
}

static void parts_give_one_order(uint32_t dimension, deldrift_algorithm algorithm) {
    deldrift_triangulation *one = moved(dimension, algorithm, 1, 4);
    for (uint32_t threads = 2; threads <= 5; threads++) {
        deldrift_triangulation *several = moved(dimension, algorithm, threads, 4);
        CHECK(has_same_order(several, one));
        deldrift_destroy(several);
    }
    deldrift_triangulation *undivided = moved(dimension, algorithm, 3, 1);
    CHECK(!has_same_order(undivided, one));
    deldrift_destroy(undivided);
    deldrift_destroy(one);
}

int main(void) {
    const deldrift_algorithm algorithms[] = {DELDRIFT_REPAIR, DELDRIFT_REBUILDING};
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        for (size_t k = 0; k < 2; k++) {
            deldrift_triangulation *one = moved(dimension, algorithms[k], 1, 0);
            deldrift_triangulation *three = moved(dimension, algorithms[k], 3, 0);
            size_t counts[2];
            CHECK(digest(one, &counts[0]) == digest(three, &counts[1]) && counts[0] == counts[1]);
            CHECK(counts[0] > COUNT);
            OK(deldrift_validate(three, 3));
            deldrift_destroy(one);
            deldrift_destroy(three);
            parts_give_one_order(dimension, algorithms[k]);
        }
    }
    return 0;
}
