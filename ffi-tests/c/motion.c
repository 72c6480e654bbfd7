// Staging, commits, and the calls that take effect at once.
#include "check.h"

static size_t staged_count(const deldrift_triangulation *t) {
    size_t count = SIZE_MAX;
    OK(deldrift_staged_count(t, &count));
    return count;
}

static uint64_t timestamp(const deldrift_triangulation *t) {
    uint64_t number = UINT64_MAX;
    OK(deldrift_timestamp(t, &number));
    return number;
}

static bool is_at(const deldrift_triangulation *t, uint32_t vertex, double x, double y) {
    double position[2] = {NAN, NAN};
    OK(deldrift_position(t, vertex, position));
    return position[0] == x && position[1] == y;
}

static bool is_present(const deldrift_triangulation *t, uint32_t vertex) {
    bool present = false;
    OK(deldrift_is_present(t, vertex, &present));
    return present;
}

static void staged_moves_are_seen_after_the_commit(void) {
    static const double aim[2] = {2, 3};
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    OK(deldrift_move_vertex(t, 4, aim));
    CHECK(staged_count(t) == 1 && timestamp(t) == 0);
    CHECK(is_at(t, 4, 1, 2));
    deldrift_commit_report report;
    memset(&report, 255, sizeof report);
    OK(deldrift_commit_timestamp(t, &report));
    CHECK(staged_count(t) == 0 && timestamp(t) == 1);
    CHECK(is_at(t, 4, 2, 3));
    CHECK(report.timestamp == 1 && report.moved == 1 && report.coincident == 0);
    for (size_t i = 0; i < sizeof report.reserved / sizeof *report.reserved; i++) CHECK(report.reserved[i] == 0);

    // Without moves it is a timestamp too, and the report is optional.
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_commit_timestamp(t, &report));
    CHECK(report.timestamp == 3 && report.moved == 0 && timestamp(t) == 3);
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
}

static void moves_are_staged_all_or_none(void) {
    static const double aims[] = {0.5, 0.5, 2, 3};
    static const double bad_aims[] = {0.5, 0.5, NAN, 3};
    static const double far_aims[] = {0.5, 0.5, 2, 1e200};
    static const uint32_t vertices[] = {0, 4}, unknown[] = {0, 5}, twice[] = {4, 4};
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);

    CHECK_STATUS(deldrift_move_vertices(t, unknown, aims, 2), DELDRIFT_NO_SUCH_VERTEX);
    CHECK_MESSAGE("vertices[1] is 5");
    CHECK_STATUS(deldrift_move_vertices(t, twice, aims, 2), DELDRIFT_DUPLICATE_MOVE);
    CHECK_MESSAGE("vertices[1] is 4");
    CHECK_STATUS(deldrift_move_vertices(t, vertices, bad_aims, 2), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("positions[1], coordinate 0");
    CHECK_STATUS(deldrift_move_vertices(t, vertices, far_aims, 2), DELDRIFT_OUT_OF_RANGE);
    CHECK_MESSAGE("positions[1], coordinate 1");
    CHECK(staged_count(t) == 0);

    OK(deldrift_move_vertices(t, vertices, aims, 2));
    CHECK_STATUS(deldrift_move_vertex(t, 4, aims), DELDRIFT_DUPLICATE_MOVE);
    CHECK_MESSAGE("vertex[0] is 4");
    CHECK_STATUS(deldrift_move_vertex(t, 9, aims), DELDRIFT_NO_SUCH_VERTEX);
    CHECK_MESSAGE("vertex[0] is 9");
    CHECK_STATUS(deldrift_move_vertex(t, 1, bad_aims + 2), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("position[0], coordinate 0");
    CHECK_STATUS(deldrift_move_vertex(t, 1, far_aims + 2), DELDRIFT_OUT_OF_RANGE);
    CHECK(staged_count(t) == 2);

    OK(deldrift_discard_moves(t));
    CHECK(staged_count(t) == 0);
    OK(deldrift_discard_moves(t));
    OK(deldrift_commit_timestamp(t, NULL));
    CHECK(is_at(t, 0, 0, 0) && is_at(t, 4, 1, 2));
    deldrift_destroy(t);
}

static void the_first_vertices_move_without_a_list_of_ids(void) {
    double moved[2 * SQUARE_COUNT + 2] = {0};
    for (size_t i = 0; i < 2 * SQUARE_COUNT; i++) moved[i] = 2 * SQUARE[i] + 1;
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    CHECK_STATUS(deldrift_move_vertices(t, NULL, moved, SQUARE_COUNT + 1), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("count is 6");
    CHECK(staged_count(t) == 0);

    // Those behind them stay.
    OK(deldrift_move_vertices(t, NULL, moved, 2));
    CHECK(staged_count(t) == 2);
    CHECK_STATUS(deldrift_move_vertices(t, NULL, moved, 1), DELDRIFT_DUPLICATE_MOVE);
    CHECK_MESSAGE("vertices[0] is 0");
    OK(deldrift_commit_timestamp(t, NULL));
    CHECK(is_at(t, 0, 1, 1) && is_at(t, 1, 9, 1) && is_at(t, 2, 5, 5));
    OK(deldrift_validate(t, 3));
    OK(deldrift_move_vertices(t, NULL, SQUARE, SQUARE_COUNT));
    OK(deldrift_commit_timestamp(t, NULL));

    // The entry of a removed vertex is not read.
    OK(deldrift_remove_vertex(t, 1));
    moved[2] = moved[3] = NAN;
    OK(deldrift_move_vertices(t, NULL, moved, SQUARE_COUNT));
    CHECK(staged_count(t) == SQUARE_COUNT - 1);
    deldrift_commit_report report;
    OK(deldrift_commit_timestamp(t, &report));
    CHECK(report.moved == SQUARE_COUNT - 1);
    CHECK(is_at(t, 4, 3, 5));
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
}

static void a_vertex_relocates_at_once(void) {
    static const double aim[2] = {3, 3}, nowhere[2] = {1, INFINITY}, far[2] = {1, -1e100};
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    OK(deldrift_relocate_vertex(t, 4, aim));
    CHECK(is_at(t, 4, 3, 3) && timestamp(t) == 0);
    OK(deldrift_validate(t, 3));
    CHECK_STATUS(deldrift_relocate_vertex(t, 4, nowhere), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("position[0], coordinate 1");
    CHECK_STATUS(deldrift_relocate_vertex(t, 4, far), DELDRIFT_OUT_OF_RANGE);
    CHECK_STATUS(deldrift_relocate_vertex(t, 5, aim), DELDRIFT_NO_SUCH_VERTEX);
    CHECK_MESSAGE("vertex[0] is 5");
    CHECK(is_at(t, 4, 3, 3));
    OK(deldrift_move_vertex(t, 4, SQUARE));
    CHECK_STATUS(deldrift_relocate_vertex(t, 4, aim), DELDRIFT_DUPLICATE_MOVE);
    deldrift_destroy(t);
}

static void vertices_come_and_go(void) {
    static const double aim[2] = {3, 1}, nowhere[2] = {NAN, 1}, far[2] = {1e58, 1};
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    uint32_t vertex = 77;
    CHECK_STATUS(deldrift_insert_vertex(t, nowhere, &vertex), DELDRIFT_NOT_FINITE);
    CHECK_STATUS(deldrift_insert_vertex(t, far, &vertex), DELDRIFT_OUT_OF_RANGE);
    CHECK(vertex == 77);
    OK(deldrift_insert_vertex(t, aim, &vertex));
    CHECK(vertex == 5 && is_at(t, 5, 3, 1) && cell_count(t) == 6);

    OK(deldrift_move_vertex(t, 5, SQUARE));
    OK(deldrift_remove_vertex(t, 5));
    CHECK(staged_count(t) == 0 && !is_present(t, 5) && cell_count(t) == 4);
    CHECK_STATUS(deldrift_remove_vertex(t, 5), DELDRIFT_REMOVED_VERTEX);
    CHECK_MESSAGE("vertex[0] is 5");
    CHECK_STATUS(deldrift_remove_vertex(t, 6), DELDRIFT_NO_SUCH_VERTEX);
    CHECK_STATUS(deldrift_move_vertex(t, 5, aim), DELDRIFT_REMOVED_VERTEX);
    CHECK_STATUS(deldrift_move_vertices(t, &vertex, aim, 1), DELDRIFT_REMOVED_VERTEX);
    CHECK_STATUS(deldrift_relocate_vertex(t, 5, aim), DELDRIFT_REMOVED_VERTEX);
    double position[2] = {7, 7};
    CHECK_STATUS(deldrift_position(t, 5, position), DELDRIFT_REMOVED_VERTEX);
    CHECK(position[0] == 7);

    // Ids are not given again.
    OK(deldrift_insert_vertex(t, aim, &vertex));
    CHECK(vertex == 6 && is_present(t, 6) && !is_present(t, 7));
    size_t vertices = 0, ids = 0;
    OK(deldrift_vertex_count(t, &vertices));
    OK(deldrift_id_count(t, &ids));
    CHECK(vertices == 6 && ids == 7);
    for (uint32_t v = 0; v < ids; v++) {
        if (is_present(t, v)) OK(deldrift_remove_vertex(t, v));
    }
    CHECK(cell_count(t) == 0);
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
}

static void removed_vertices_leave_nothing_after_a_compaction(void) {
    enum { TURNS = 1000 };
    static const double aim[2] = {3, 1}, later[2] = {2, 2};
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    uint32_t vertex = 0;
    for (size_t turn = 0; turn < TURNS; turn++) {
        OK(deldrift_insert_vertex(t, aim, &vertex));
        if (turn + 1 < TURNS) OK(deldrift_remove_vertex(t, vertex));
    }
    OK(deldrift_remove_vertex(t, 1));
    OK(deldrift_move_vertex(t, vertex, later));
    enum { IDS = SQUARE_COUNT + TURNS };
    static uint32_t map[IDS];
    size_t count = 7, before = 0, after = 0;
    OK(deldrift_memory_bytes(t, &before));

    CHECK_STATUS(deldrift_compact(NULL, map, IDS, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_compact(t, NULL, IDS, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("map is NULL");
    CHECK_STATUS(deldrift_compact(t, map, IDS, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_compact(t, (uint32_t *)((char *)map + 1), IDS, &count), DELDRIFT_MISALIGNED_ARGUMENT);
    CHECK(count == 7);
    CHECK_STATUS(deldrift_compact(t, map, IDS - 1, &count), DELDRIFT_BUFFER_TOO_SMALL);
    CHECK_MESSAGE("capacity is 1004");
    CHECK(count == IDS && is_present(t, vertex) && map[0] == 0 && map[IDS - 1] == 0);

    OK(deldrift_compact(t, map, IDS, &count));
    CHECK(count == IDS && map[0] == 0 && map[1] == DELDRIFT_NONE && map[2] == 1 && map[4] == 3);
    for (size_t id = SQUARE_COUNT; id < IDS - 1; id++) CHECK(map[id] == DELDRIFT_NONE);
    CHECK(map[IDS - 1] == 4 && is_at(t, 4, 3, 1) && is_at(t, 3, 1, 2) && !is_present(t, 5));
    OK(deldrift_memory_bytes(t, &after));
    CHECK(2 * after < before);
    OK(deldrift_validate(t, 3));
    CHECK(staged_count(t) == 1);
    OK(deldrift_commit_timestamp(t, NULL));
    CHECK(is_at(t, 4, 2, 2) && timestamp(t) == 1);
    OK(deldrift_insert_vertex(t, aim, &vertex));
    CHECK(vertex == 5);
    OK(deldrift_remove_vertex(t, 0));
    OK(deldrift_compact(t, NULL, 0, &count));
    CHECK(count == 6 && is_at(t, 4, 3, 1));
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
}

static void coincident_vertices_hide_behind_the_lowest_id(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    OK(deldrift_move_vertex(t, 4, SQUARE + 2));
    deldrift_commit_report report;
    OK(deldrift_commit_timestamp(t, &report));
    CHECK(report.coincident == 1);
    uint32_t representative = 77;
    OK(deldrift_coincident_representative(t, 4, &representative));
    CHECK(representative == 1 && is_present(t, 4) && is_at(t, 4, 4, 0) && cell_count(t) == 2);
    OK(deldrift_coincident_representative(t, 0, &representative));
    CHECK(representative == 0);
    CHECK_STATUS(deldrift_coincident_representative(t, 5, &representative), DELDRIFT_NO_SUCH_VERTEX);

    OK(deldrift_relocate_vertex(t, 4, SQUARE + 8));
    OK(deldrift_coincident_representative(t, 4, &representative));
    CHECK(representative == 4 && cell_count(t) == 4);
    OK(deldrift_statistics(t, &report));
    CHECK(report.coincident == 0);
    OK(deldrift_remove_vertex(t, 4));
    CHECK_STATUS(deldrift_coincident_representative(t, 4, &representative), DELDRIFT_REMOVED_VERTEX);
    CHECK(representative == 4);
    deldrift_destroy(t);
}

static void coincident_vertices_can_be_refused(void) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.coincidence = DELDRIFT_COINCIDENCE_REJECT;
    static const double same[] = {0, 0, 1, 1, 0, 0};
    deldrift_triangulation *t = NULL;
    CHECK_STATUS(deldrift_create(2, same, 3, &options, &t), DELDRIFT_COINCIDENT);
    CHECK_MESSAGE("vertices 0 and 2");
    CHECK(t == NULL);

    t = create(2, SQUARE, SQUARE_COUNT, &options);
    uint32_t vertex = 77;
    CHECK_STATUS(deldrift_insert_vertex(t, SQUARE, &vertex), DELDRIFT_COINCIDENT);
    CHECK(vertex == 77);
    CHECK_STATUS(deldrift_relocate_vertex(t, 4, SQUARE), DELDRIFT_COINCIDENT);
    OK(deldrift_move_vertex(t, 4, SQUARE + 4));
    deldrift_commit_report report = {.timestamp = 99};
    CHECK_STATUS(deldrift_commit_timestamp(t, &report), DELDRIFT_COINCIDENT);
    CHECK_MESSAGE("vertices 2 and 4");
    CHECK(report.timestamp == 99 && timestamp(t) == 0 && staged_count(t) == 1);
    CHECK(is_at(t, 4, 1, 2) && cell_count(t) == 4);
    OK(deldrift_validate(t, 3));
    OK(deldrift_discard_moves(t));
    OK(deldrift_commit_timestamp(t, &report));
    CHECK(report.timestamp == 1 && report.moved == 0);
    deldrift_destroy(t);
}

static void statistics_sum_up(void) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = DELDRIFT_REBUILDING;
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, &options);
    static const double aims[] = {1, 2, 2, 2, 2, 3};
    deldrift_commit_report report, sums;
    uint64_t moved = 0, rebuilds = 0;
    for (size_t i = 0; i < 3; i++) {
        OK(deldrift_move_vertex(t, 4, aims + 2 * i));
        OK(deldrift_commit_timestamp(t, &report));
        moved += report.moved;
        rebuilds += report.rebuilds;
    }
    memset(&sums, 255, sizeof sums);
    OK(deldrift_statistics(t, &sums));
    CHECK(moved == 2 && sums.moved == moved && sums.rebuilds == rebuilds && sums.timestamp == 3);
    for (size_t i = 0; i < sizeof sums.reserved / sizeof *sums.reserved; i++) CHECK(sums.reserved[i] == 0);
    deldrift_destroy(t);
}

// The points of a grid are cocircular by fours; the same points out of line are not. (Coordinates of few bits would need no
// exact arithmetic for that.)
static void ties_are_counted(void) {
    static const double grid[] = {0, 0, .1, 0, .2, 0, 0, .1, .1, .1, .2, .1, 0, .2, .1, .2, .2, .2};
    static const double others[] = {0, 0, 1.1, -.2, 2.3, .1, -.4, 1.2, 1.3, .7, 2.4, 1.4, .3, 2.2, .9, 2.6, 1.8, 2.1};
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = DELDRIFT_REBUILDING;
    for (int is_grid = 0; is_grid < 2; is_grid++) {
        deldrift_triangulation *t = create(2, is_grid ? grid : others, 9, &options);
        deldrift_commit_report report, sums;
        OK(deldrift_commit_timestamp(t, &report));
        CHECK((report.exact_calls > 0) == is_grid);
        OK(deldrift_statistics(t, &sums));
        CHECK(sums.exact_calls == report.exact_calls);
        deldrift_destroy(t);
    }
}

int main(void) {
    staged_moves_are_seen_after_the_commit();
    moves_are_staged_all_or_none();
    the_first_vertices_move_without_a_list_of_ids();
    a_vertex_relocates_at_once();
    vertices_come_and_go();
    removed_vertices_leave_nothing_after_a_compaction();
    coincident_vertices_hide_behind_the_lowest_id();
    coincident_vertices_can_be_refused();
    statistics_sum_up();
    ties_are_counted();
    return 0;
}
