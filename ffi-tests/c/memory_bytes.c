// What deldrift_memory_bytes says, beside what the library has asked the system for and not given back.
//
// DELDRIFT_SOAK below 1 leaves most of the work out.
#include "requests.h"
#include "state.h"

enum { MOST = 4000 };

// Of all comparisons.
static size_t n_compared, farthest_apart;

// What is held is what there is beyond `before`; it must be what the library says, but for a fiftieth and a little.
static void compare(const deldrift_triangulation *t, size_t before, const char *when) {
    size_t told = 0, held = held_bytes - before;
    OK(deldrift_memory_bytes(t, &told));
    size_t apart = told > held ? told - held : held - told;
    if (apart > farthest_apart) farthest_apart = apart;
    n_compared++;
    if (apart > held / 50 + 256) {
        deldrift_algorithm algorithm;
        OK(deldrift_get_algorithm(t, &algorithm));
        fprintf(stderr, "%s, algorithm %u: %zu bytes told, %zu held\n", when, algorithm, told, held);
        exit(1);
    }
}

static void nudge(double *points, size_t count, double size, uint64_t *state) {
    for (size_t i = 0; i < count; i++) points[i] += size * (next_random(state) - 0.5);
}

static bool never(void *user_data) {
    (void)user_data;
    return false;
}

// `flat` if all points are in one line at first. They move a little, then far; some come and go, at once and with a commit.
static void what_is_told_is_held(uint32_t dimension, deldrift_algorithm algorithm, bool asks, bool flat, size_t n,
                                 uint32_t threads) {
    uint64_t state = 3;
    double *points = random_positions(dimension, MOST, 9);
    if (flat) {
        for (size_t i = 0; i < n * dimension; i++) points[i] = i % dimension == 0 ? points[i] : 0.5;
    }
    for (size_t v = 0; v < n; v += 50) memcpy(points + v * dimension, points, dimension * sizeof *points);
    double spacing = pow((double)n, -1.0 / dimension);
    uint32_t leaving[100], first;
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = algorithm;
    options.threads = threads;
    options.cancel = asks ? never : NULL;
    deldrift_cells_view cells;
    deldrift_changes changes;
    size_t before = held_bytes;
    deldrift_triangulation *t = create(dimension, points, n, &options);
    CHECK(held_bytes > before);
    compare(t, before, "after creation");
    for (int round = 0; round < 2; round++) {
        for (int step = 0; step < 4; step++) {
            nudge(points, n * dimension, spacing * (step < 2 ? 1e-3 : 0.1), &state);
            OK(deldrift_move_vertices(t, NULL, points, n));
            compare(t, before, "with staged moves");
            OK(deldrift_commit_timestamp(t, NULL));
            compare(t, before, "after a commit");
        }
        OK(deldrift_cells(t, &cells));
        compare(t, before, "with cells");
        OK(deldrift_take_changes(t, &changes));
        compare(t, before, "with changes taken");
        for (uint32_t v = 0; v < 20; v++) {
            OK(deldrift_remove_vertex(t, v + (uint32_t)round * 20));
            OK(deldrift_relocate_vertex(t, v + 100, points + v * dimension));
            OK(deldrift_insert_vertex(t, points + n++ * dimension, &first));
        }
        compare(t, before, "after immediate calls");
        for (uint32_t v = 0; v < 100; v++) leaving[v] = 200 + 100 * (uint32_t)round + v;
        OK(deldrift_stage_removals(t, leaving, round == 0 ? 100 : 10));
        OK(deldrift_stage_insertions(t, points + n * dimension, round == 0 ? 100 : 10, &first));
        n += round == 0 ? 100 : 10;
        nudge(points, n * dimension, spacing * 0.01, &state);
        OK(deldrift_move_vertices(t, NULL, points, n));
        compare(t, before, "with staged edits");
        OK(deldrift_commit_timestamp(t, NULL));
        compare(t, before, "after a commit with edits");
        nudge(points, n * dimension, spacing * 0.01, &state);
        OK(deldrift_commit_positions(t, points, n, NULL));
        compare(t, before, "after a commit of positions");
        for (uint32_t v = 300; v < 400; v += 7) {
            bool present;
            OK(deldrift_is_present(t, v, &present));
            if (present) OK(deldrift_move_vertex(t, v, points + (v + 1) * dimension));
        }
        OK(deldrift_commit_timestamp(t, NULL));
        OK(deldrift_cells(t, &cells));
        OK(deldrift_take_changes(t, &changes));
        compare(t, before, "after a commit of some");
    }
    size_t count;
    OK(deldrift_compact(t, NULL, 0, &count));
    compare(t, before, "after a compaction");
    OK(deldrift_commit_timestamp(t, NULL));
    compare(t, before, "after a commit without moves");
    deldrift_destroy(t);
    CHECK(held_bytes == before);
    free(points);
}

int main(void) {
    static const deldrift_algorithm all[] = ALL_ALGORITHMS;
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
            what_is_told_is_held(dimension, all[i], i % 2 == 0, i % 3 == 0, 600, 1);
            if (soak() < 1) continue;
            what_is_told_is_held(dimension, all[i], false, false, 2000, 1);
            what_is_told_is_held(dimension, all[i], true, false, 600, 1);
            what_is_told_is_held(dimension, all[i], true, true, 600, 1);
            what_is_told_is_held(dimension, all[i], true, false, 2000, 3);
        }
    }
    printf("%zu comparisons, at most %zu bytes apart\n", n_compared, farthest_apart);
    return 0;
}
