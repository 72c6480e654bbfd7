// Commits in two phases: what is prepared is seen by all that reads, what is withdrawn leaves the bytes that there were, and
// what may not be done in between is refused.
#include "state.h"

enum { COUNT = 300, BYTES = 1 << 20 };

static uint8_t before[BYTES], after[BYTES];

static size_t save(const deldrift_triangulation *t, uint8_t *to) {
    size_t size = 0;
    OK(deldrift_save(t, to, BYTES, &size));
    return size;
}

static void nudge(double *positions, size_t n, double size, uint64_t *state) {
    for (size_t i = 0; i < n; i++) positions[i] += size * (next_random(state) - 0.5);
}

#define IS_PREPARED(call, rounds)                                             \
    do {                                                                      \
        CHECK_STATUS(call, DELDRIFT_PREPARED);                                \
        CHECK_MESSAGE("timestamp 1 is prepared, in " rounds);                 \
        CHECK_MESSAGE("it has to be published or withdrawn first");           \
    } while (0)

static void calls_that_would_not_be_withdrawn_are_refused(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL), *copy = NULL;
    static const double place[] = {2, 2};
    uint32_t id = 77, ids[8];
    size_t count = 77;
    deldrift_changes changes;
    deldrift_quality quality;
    deldrift_quality_report report;
    OK(deldrift_quality_init(&quality));
    CHECK_STATUS(deldrift_publish_timestamp(t), DELDRIFT_NOT_PREPARED);
    CHECK_MESSAGE("no timestamp is prepared");
    OK(deldrift_withdraw_timestamp(t));
    CHECK_STATUS(deldrift_prepare_timestamp(NULL, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_publish_timestamp(NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_withdraw_timestamp(NULL), DELDRIFT_NULL_ARGUMENT);
    OK(deldrift_prepare_timestamp(t, NULL));
    IS_PREPARED(deldrift_commit_timestamp(t, NULL), "1 round:");
    OK(deldrift_prepare_timestamp(t, NULL));
    IS_PREPARED(deldrift_commit_timestamp(t, NULL), "2 rounds:");
    IS_PREPARED(deldrift_commit_positions(t, SQUARE, SQUARE_COUNT, NULL), "2 rounds:");
    IS_PREPARED(deldrift_relocate_vertex(t, 4, place), "2 rounds:");
    IS_PREPARED(deldrift_insert_vertex(t, place, &id), "2 rounds:");
    IS_PREPARED(deldrift_remove_vertex(t, 4), "2 rounds:");
    IS_PREPARED(deldrift_compact(t, ids, 8, &count), "2 rounds:");
    IS_PREPARED(deldrift_refine(t, &quality, NULL, 0, &report), "2 rounds:");
    IS_PREPARED(deldrift_coarsen(t, &quality, NULL, 0, &report), "2 rounds:");
    IS_PREPARED(deldrift_take_changes(t, &changes), "2 rounds:");
    IS_PREPARED(deldrift_clone(t, &copy), "2 rounds:");
    IS_PREPARED(deldrift_save(t, before, BYTES, &count), "2 rounds:");
    IS_PREPARED(deldrift_save_file(t, "/nowhere/at/all"), "2 rounds:");
    CHECK(id == 77 && count == 77 && copy == NULL);
    OK(deldrift_publish_timestamp(t));
    uint64_t timestamp = 77;
    OK(deldrift_timestamp(t, &timestamp));
    CHECK(timestamp == 1);
    deldrift_destroy(t);
}

// Rounds of moves, insertions and removals are taken back together, ids included.
static void rounds_leave_the_bytes_that_there_were(uint32_t d, deldrift_algorithm algorithm, bool reads) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = algorithm;
    double *positions = random_positions(d, COUNT, 7), *moved = random_positions(d, COUNT, 7);
    deldrift_triangulation *t = create(d, positions, COUNT, &options);
    uint64_t state = 3, timestamp = 77;
    uint32_t first = 0;
    size_t ids = 0;
    deldrift_cells_view view;
    deldrift_changes changes;
    deldrift_commit_report report;
    if (reads) OK(deldrift_take_changes(t, &changes));
    const size_t size = save(t, before);
    for (int turn = 0; turn < 3; turn++) {
        memcpy(moved, positions, COUNT * d * sizeof *moved);
        nudge(moved, COUNT * d, turn == 2 ? 1 : 1e-3, &state);
        OK(deldrift_move_vertices(t, NULL, moved, COUNT));
        OK(deldrift_prepare_timestamp(t, &report));
        CHECK(report.timestamp == 1 && report.moved == COUNT);
        for (int round = 0; round < 3; round++) {
            double place[3];
            OK(deldrift_position(t, 5, place));
            CHECK(round > 0 || memcmp(place, moved + 5 * d, d * sizeof *place) == 0);
            if (reads) OK(deldrift_cells(t, &view));
            OK(deldrift_stage_insertions(t, positions, 20, &first));
            CHECK(first == COUNT + 20 * (uint32_t)round);
            OK(deldrift_stage_removals(t, (uint32_t[]){10 + (uint32_t)round, 50 + (uint32_t)round}, 2));
            OK(deldrift_move_vertex(t, 5, positions + 7 * d));
            OK(deldrift_prepare_timestamp(t, &report));
            CHECK(report.inserted == 20 && report.removed == 2);
            OK(deldrift_validate(t, 3));
        }
        OK(deldrift_stage_insertions(t, positions, 3, &first));
        OK(deldrift_timestamp(t, &timestamp));
        CHECK(timestamp == 0);
        OK(deldrift_withdraw_timestamp(t));
        OK(deldrift_id_count(t, &ids));
        CHECK(ids == COUNT);
        CHECK(save(t, after) == size && memcmp(before, after, size) == 0);
    }
    if (reads) {
        OK(deldrift_take_changes(t, &changes));
        CHECK(changes.created_count == 0 && changes.removed_count == 0 && changes.renumbered_count == 0);
    }
    deldrift_destroy(t);
    free(positions);
    free(moved);
}

// Segments come and go in rounds; a round that they refuse is taken back alone.
static void rounds_of_segments(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    static const uint32_t across[] = {0, 2}, other[] = {1, 3};
    uint32_t first = 77, ids[8];
    size_t count = 77;
    const size_t size = save(t, before);
    OK(deldrift_move_vertex(t, 4, (double[]){0.5, 0.25}));
    OK(deldrift_prepare_timestamp(t, NULL));
    OK(deldrift_stage_segments(t, across, NULL, 1, &first));
    OK(deldrift_prepare_timestamp(t, NULL));
    OK(deldrift_stage_segments(t, other, NULL, 1, &first));
    CHECK_STATUS(deldrift_prepare_timestamp(t, NULL), DELDRIFT_CROSSING);
    OK(deldrift_segments(t, ids, NULL, NULL, 8, &count));
    CHECK(count == 1 && ids[0] == 0);
    OK(deldrift_stage_segment_removals(t, ids, 1));
    OK(deldrift_prepare_timestamp(t, NULL));
    OK(deldrift_segments(t, ids, NULL, NULL, 8, &count));
    CHECK(count == 1 && ids[0] == 1);
    OK(deldrift_withdraw_timestamp(t));
    OK(deldrift_segments(t, ids, NULL, NULL, 8, &count));
    CHECK(count == 0 && save(t, after) == size && memcmp(before, after, size) == 0);
    OK(deldrift_stage_segments(t, other, NULL, 1, &first));
    CHECK(first == 0);
    OK(deldrift_prepare_timestamp(t, NULL));
    OK(deldrift_publish_timestamp(t));
    OK(deldrift_segments(t, ids, NULL, NULL, 8, &count));
    CHECK(count == 1);
    deldrift_destroy(t);
}

int main(void) {
    static const deldrift_algorithm all[] = ALL_ALGORITHMS;
    calls_that_would_not_be_withdrawn_are_refused();
    for (uint32_t d = 2; d <= 3; d++) {
        for (size_t k = 0; k < 2 * sizeof all / sizeof *all; k++) {
            rounds_leave_the_bytes_that_there_were(d, all[k / 2], k % 2 == 1);
        }
    }
    rounds_of_segments();
    return 0;
}
