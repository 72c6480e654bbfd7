// Keys: the cells are those of a triangulation without keys whose vertices are in the order of key, position and id. Ids that
// are given again.
#include "state.h"

enum { SIDE = 6, MOST = SIDE * SIDE * SIDE + 20 };

static size_t memory_bytes(const deldrift_triangulation *t) {
    size_t bytes = 0;
    OK(deldrift_memory_bytes(t, &bytes));
    return bytes;
}

typedef struct {
    uint64_t key;
    const double *place;
    uint32_t id;
} ranked;

static uint32_t ranked_dimension;

static int compare(const void *first, const void *second) {
    const ranked *a = first, *b = second;
    if (a->key != b->key) return a->key < b->key ? -1 : 1;
    for (uint32_t i = 0; i < ranked_dimension; i++) {
        if (a->place[i] != b->place[i]) return a->place[i] < b->place[i] ? -1 : 1;
    }
    return a->id < b->id ? -1 : 1;
}

// Whether the cells, and what represents each place, are those of vertices in the order that counts.
static void has_cells_by_rank(const deldrift_triangulation *t) {
    static double positions[MOST * 3], ordered[MOST * 3];
    static uint64_t keys[MOST];
    static ranked order[MOST];
    static uint32_t rank_of[MOST];
    uint32_t d = 0, n = 0;
    size_t n_ids = 0;
    OK(deldrift_dimension(t, &d));
    OK(deldrift_copy_positions(t, positions, MOST, &n_ids));
    OK(deldrift_keys(t, keys, MOST, &n_ids));
    for (uint32_t v = 0; v < n_ids; v++) {
        bool present = false;
        OK(deldrift_is_present(t, v, &present));
        if (present) order[n++] = (ranked){keys[v], positions + (size_t)v * d, v};
        else CHECK(keys[v] == 0);
    }
    ranked_dimension = d;
    qsort(order, n, sizeof *order, compare);
    for (uint32_t k = 0; k < n; k++) {
        memcpy(ordered + (size_t)k * d, order[k].place, d * sizeof *ordered);
        rank_of[order[k].id] = k;
    }
    deldrift_triangulation *other = create(d, ordered, n, NULL);
    deldrift_cells_view view, expected;
    OK(deldrift_cells(t, &view));
    OK(deldrift_cells(other, &expected));
    uint64_t found = 0, wanted = 0;
    for (size_t c = 0; c < view.count; c++) {
        uint32_t row[4];
        for (uint32_t i = 0; i <= d; i++) row[i] = rank_of[view.vertices[c * (d + 1) + i]];
        found += digest_of_row(row, d + 1);
    }
    for (size_t c = 0; c < expected.count; c++) wanted += digest_of_row(expected.vertices + c * (d + 1), d + 1);
    CHECK(view.count == expected.count && found == wanted);
    for (uint32_t k = 0; k < n; k++) {
        uint32_t representative, of_rank;
        OK(deldrift_coincident_representative(t, order[k].id, &representative));
        OK(deldrift_coincident_representative(other, k, &of_rank));
        CHECK(representative == order[of_rank].id);
    }
    OK(deldrift_validate(t, 3));
    deldrift_destroy(other);
}

// Points of a lattice, some of them at the same places, with few keys; all calls that change a triangulation, by every
// algorithm.
static void keys_rank_vertices(uint32_t d, deldrift_algorithm algorithm) {
    static double positions[MOST * 3], goals[MOST * 3];
    static uint64_t keys[MOST];
    uint64_t state = 3 + algorithm;
    const size_t n = d == 2 ? SIDE * SIDE : SIDE * SIDE * SIDE;
    for (size_t v = 0; v < n; v++) {
        for (uint32_t i = 0; i < d; i++) positions[v * d + i] = (double)(int)(SIDE * next_random(&state));
        keys[v] = (uint64_t)(5 * next_random(&state));
    }
    deldrift_triangulation *t = NULL;
    OK(deldrift_create_with_keys(d, positions, keys, n, NULL, &t));
    OK(choose(t, algorithm));
    has_cells_by_rank(t);
    for (int step = 0; step < 4; step++) {
        for (size_t k = 0; k < n * d; k++) {
            goals[k] = positions[k] + (next_random(&state) < 0.2 ? 1 : step == 2 ? 0.25 * next_random(&state) : 0);
        }
        OK(deldrift_move_vertices(t, NULL, goals, n));
        OK(deldrift_commit_timestamp(t, NULL));
        has_cells_by_rank(t);
    }
    uint32_t first = 77, ids[3] = {77, 77, 77};
    OK(deldrift_stage_removals(t, (uint32_t[]){3, 11}, 2));
    OK(deldrift_stage_insertions_with_keys(t, positions, keys + 5, 2, &first));
    CHECK(first == n);
    OK(deldrift_commit_timestamp(t, NULL));
    has_cells_by_rank(t);
    OK(deldrift_stage_insertions_at_free_ids(t, positions + 2 * d, keys + 9, 3, ids));
    CHECK(ids[0] == 3 && ids[1] == 11 && ids[2] == n + 2);
    OK(deldrift_commit_timestamp(t, NULL));
    has_cells_by_rank(t);
    OK(deldrift_insert_vertex_with_key(t, positions + 7 * d, 2, &first));
    OK(deldrift_relocate_vertex(t, 5, positions + 9 * d));
    has_cells_by_rank(t);
    deldrift_triangulation *copy = NULL;
    OK(deldrift_clone(t, &copy));
    has_cells_by_rank(copy);
    deldrift_destroy(copy);
    static uint8_t bytes[1 << 20];
    size_t count = 0;
    OK(deldrift_save(t, bytes, sizeof bytes, &count));
    OK(deldrift_load(bytes, count, NULL, &copy));
    has_cells_by_rank(copy);
    deldrift_destroy(copy);
    OK(deldrift_remove_vertex(t, 0));
    OK(deldrift_compact(t, NULL, 0, &count));
    has_cells_by_rank(t);
    deldrift_destroy(t);
}

// Without keys a vertex has its id for one, and the first key of another one changes nothing of that.
static void ids_are_keys_by_default(void) {
    static const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
    uint64_t keys[6];
    size_t count = 77;
    uint32_t first = 77;
    deldrift_triangulation *t = NULL;
    OK(deldrift_create_with_keys(2, square, NULL, 4, NULL, &t));
    OK(deldrift_keys(t, keys, 6, &count));
    CHECK(count == 4);
    for (uint64_t v = 0; v < 4; v++) CHECK(keys[v] == v);
    const size_t bytes = memory_bytes(t);
    OK(deldrift_stage_insertions_with_keys(t, square, NULL, 1, &first));
    OK(deldrift_discard_moves(t));
    OK(deldrift_stage_insertions_with_keys(t, (double[]){0.5, 0.25}, (uint64_t[]){UINT64_MAX}, 1, &first));
    CHECK_STATUS(deldrift_stage_insertions_with_keys(t, square, NULL, 1, NULL), DELDRIFT_NULL_ARGUMENT);
    OK(deldrift_keys(t, keys, 6, &count));
    CHECK(count == 5 && keys[3] == 3 && keys[4] == UINT64_MAX);
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_insert_vertex(t, (double[]){0.5, 0.75}, &first));
    OK(deldrift_keys(t, keys, 6, &count));
    CHECK(count == 6 && keys[4] == UINT64_MAX && keys[5] == 5 && memory_bytes(t) > bytes);
    CHECK_STATUS(deldrift_keys(t, keys, 5, &count), DELDRIFT_BUFFER_TOO_SMALL);
    deldrift_destroy(t);
}

// Vertices come and go for ever, and ids stay few: what is staged and given up is free again, and what a commit could not make.
static void ids_are_given_again(void) {
    enum { N = 50, STEPS = 40 };
    static uint32_t ids[N], again[N];
    double *positions = random_positions(3, N, 5);
    deldrift_options options;
    deldrift_options_init(&options);
    options.coincidence = DELDRIFT_COINCIDENCE_REJECT;
    deldrift_triangulation *t = create(3, positions, N, &options);
    size_t n_ids = 0;
    uint64_t state = 9;
    for (uint32_t step = 0; step < STEPS; step++) {
        uint32_t leaving[5];
        double coming[5 * 3];
        for (uint32_t k = 0; k < 5; k++) leaving[k] = (step * 7 + k * 11) % N;
        for (size_t k = 0; k < 15; k++) coming[k] = next_random(&state);
        OK(deldrift_stage_removals(t, leaving, 5));
        OK(deldrift_commit_timestamp(t, NULL));
        if (step % 4 == 0) {
            // One is at the place of another, which the options reject.
            double there[3];
            OK(deldrift_position(t, (leaving[0] + 1) % N, there));
            OK(deldrift_stage_insertions_at_free_ids(t, there, NULL, 1, again));
            CHECK_STATUS(deldrift_commit_timestamp(t, NULL), DELDRIFT_COINCIDENT);
            OK(deldrift_discard_moves(t));
        }
        OK(deldrift_stage_insertions_at_free_ids(t, coming, NULL, 5, ids));
        for (uint32_t k = 1; k < 5; k++) CHECK(ids[k - 1] < ids[k]);
        for (uint32_t k = 0; k < 5; k++) {
            bool was_free = false;
            for (uint32_t i = 0; i < 5; i++) was_free = was_free || ids[k] == leaving[i];
            CHECK(was_free);
        }
        OK(deldrift_discard_moves(t));
        OK(deldrift_stage_insertions_at_free_ids(t, coming, NULL, 5, again));
        CHECK(memcmp(ids, again, 5 * sizeof *ids) == 0);
        OK(deldrift_commit_timestamp(t, NULL));
        OK(deldrift_id_count(t, &n_ids));
        CHECK(n_ids == N);
        double place[3];
        OK(deldrift_position(t, ids[4], place));
        CHECK(memcmp(place, coming + 12, sizeof place) == 0);
    }
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
    free(positions);
}

int main(void) {
    static const deldrift_algorithm all[] = ALL_ALGORITHMS;
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        for (size_t k = 0; k < sizeof all / sizeof *all; k++) keys_rank_vertices(dimension, all[k]);
    }
    ids_are_keys_by_default();
    ids_are_given_again();
    return 0;
}
