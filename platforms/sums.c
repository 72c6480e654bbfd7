// Checksums of recorded runs: a line for each, with its name, and sums of the cells, of every rounded number and of the
// bytes that are saved. platforms/run compares them with those of x86-64.
//
// Numbers are taken by value, not by their bytes in memory, so that the order of bytes does not matter.
#include "../ffi-tests/c/check.h"

#include <inttypes.h>

enum { COUNT = 150, STEPS = 4, SEEDS = 5, ROOM = 40 * COUNT };

typedef enum { OPEN, BOX, WEIGHTS, SEGMENTS, N_KINDS } kind;
static const char *const KINDS[] = {"open", "box", "weights", "segments"};

typedef struct {
    uint64_t cells, numbers, saved;
} sums;

static uint64_t mixed(uint64_t sum, uint64_t value) {
    sum = (sum ^ value) * 0x9e3779b97f4a7c15u;
    return sum ^ sum >> 29;
}

static uint64_t of_number(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static void add_ids(uint64_t *sum, const uint32_t *ids, size_t count) {
    for (size_t i = 0; i < count; i++) *sum = mixed(*sum, ids[i]);
}

// What a call has given, or how it has refused.
static void add_numbers(uint64_t *sum, deldrift_status status, const double *numbers, size_t count) {
    *sum = mixed(*sum, (uint64_t)status);
    for (size_t i = 0; status == DELDRIFT_OK && i < count; i++) *sum = mixed(*sum, of_number(numbers[i]));
}

static void look_at(deldrift_triangulation *t, uint32_t dimension, sums *s) {
    static double numbers[4 * ROOM];
    static unsigned char bytes[1 << 20];
    const double low[] = {-0.1, -0.1, -0.1}, high[] = {1.1, 1.1, 1.1};
    const deldrift_cells_view view = cells_of(t);
    const size_t n_corners = view.count * view.corners_per_cell;
    CHECK(view.count < ROOM);
    add_ids(&s->cells, view.vertices, n_corners);
    add_ids(&s->cells, view.neighbours, n_corners);
    size_t count = 0;
    deldrift_status status = deldrift_volumes(t, numbers, ROOM, &count);
    add_numbers(&s->numbers, status, numbers, count);
    status = deldrift_circumcentres(t, numbers, numbers + 3 * ROOM, ROOM, &count);
    add_numbers(&s->numbers, status, numbers, count * dimension);
    add_numbers(&s->numbers, status, numbers + 3 * ROOM, count);
    status = deldrift_voronoi_volumes(t, low, high, numbers, ROOM, &count);
    add_numbers(&s->numbers, status, numbers, count);
    status = deldrift_voronoi_facets(t, low, high, numbers, ROOM, &count);
    add_numbers(&s->numbers, status, numbers, count);
    OK(deldrift_save(t, bytes, sizeof bytes, &count));
    for (size_t i = 0; i < count; i++) s->saved = mixed(s->saved, bytes[i]);
}

static deldrift_triangulation *make(kind k, uint32_t dimension, const double *points, const double *weights,
                                    deldrift_algorithm algorithm) {
    const double in_plane[] = {1, 0, 0, 1}, in_space[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double *vectors = dimension == 2 ? in_plane : in_space;
    deldrift_triangulation *t = NULL;
    if (k == BOX) {
        OK(deldrift_create_periodic(dimension, points, COUNT, vectors, dimension, NULL, &t));
    } else if (k == WEIGHTS) {
        OK(deldrift_create_weighted(dimension, points, weights, NULL, COUNT, NULL, &t));
    } else {
        OK(deldrift_create(dimension, points, COUNT, NULL, &t));
    }
    // Some kinds have no choice.
    (void)choose(t, algorithm);
    return t;
}

static sums run(kind k, uint32_t dimension, deldrift_algorithm algorithm, uint64_t seed) {
    sums s = {1, 1, 1};
    double *points = random_positions(dimension, COUNT, seed), *weights = random_positions(1, COUNT, seed + 99);
    for (size_t i = 0; i < COUNT; i++) weights[i] *= 0.01;
    // Ties: half of them are on a grid.
    for (size_t i = 0; i < COUNT * dimension && seed % 2 == 0; i++) points[i] = (double)(int)(points[i] * 8) / 8;
    deldrift_triangulation *t = make(k, dimension, points, weights, algorithm);
    if (k == SEGMENTS) {
        // Refused where they meet, and then a sum of that.
        const uint32_t ends[] = {0, 1, 2, 3};
        deldrift_status status = deldrift_stage_segments(t, ends, NULL, 2, NULL);
        if (status == DELDRIFT_OK) status = deldrift_commit_timestamp(t, NULL);
        if (status != DELDRIFT_OK) OK(deldrift_discard_moves(t));
        s.cells = mixed(s.cells, (uint64_t)status);
    }
    look_at(t, dimension, &s);
    const double sizes[STEPS] = {1e-5, 0.02, 0.2, 0.005};
    for (int step = 0; step < STEPS; step++) {
        for (size_t i = 0; i < COUNT * dimension; i++) points[i] += sizes[step] * (next_random(&seed) - 0.5);
        const deldrift_status status = deldrift_commit_positions(t, points, COUNT, NULL);
        s.cells = mixed(s.cells, (uint64_t)status);
        look_at(t, dimension, &s);
    }
    const double place[] = {0.5, 0.25, 0.75};
    uint32_t new_vertex = 0;
    s.cells = mixed(s.cells, (uint64_t)deldrift_remove_vertex(t, 7));
    s.cells = mixed(s.cells, (uint64_t)deldrift_insert_vertex(t, place, &new_vertex));
    look_at(t, dimension, &s);
    deldrift_destroy(t);
    free(points);
    free(weights);
    return s;
}

int main(void) {
    const deldrift_algorithm algorithms[] = ALL_ALGORITHMS;
    const size_t n_algorithms = sizeof algorithms / sizeof *algorithms;
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        for (kind k = OPEN; k < N_KINDS; k++) {
            if (k == SEGMENTS && dimension == 3) continue;
            // Boxes and weights have few ways to commit.
            for (size_t a = 0; a < (k == BOX || k == WEIGHTS ? 3 : n_algorithms); a++) {
                for (uint64_t seed = 0; seed < SEEDS; seed++) {
                    const sums s = run(k, dimension, algorithms[a], seed);
                    printf("%s %" PRIu32 "D by %d from %" PRIu64, KINDS[k], dimension, (int)algorithms[a], seed);
                    printf(",%016" PRIx64 ",%016" PRIx64 ",%016" PRIx64 "\n", s.cells, s.numbers, s.saved);
                }
            }
        }
    }
    return 0;
}
