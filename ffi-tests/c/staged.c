// What the header says of vertices whose insertion or removal is staged, of callbacks, counts and buffers, function by
// function.
#include "state.h"

static bool is_present(const deldrift_triangulation *t, uint32_t vertex) {
    bool present = false;
    OK(deldrift_is_present(t, vertex, &present));
    return present;
}

static void has_position(const deldrift_triangulation *t, uint32_t vertex, double x, double y) {
    double position[2] = {NAN, NAN};
    OK(deldrift_position(t, vertex, position));
    CHECK(position[0] == x && position[1] == y);
}

#define INSERTION_IS_STAGED(call)                                   \
    do {                                                            \
        CHECK_STATUS(call, DELDRIFT_STAGED_VERTEX);                 \
        CHECK_MESSAGE("[0] is 5, a vertex whose insertion is staged"); \
    } while (0)

// A vertex whose insertion is staged has an id, and that is all.
static void coming_vertices_are_not_there(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    static const double place[] = {2, 2}, aim[] = {7, 7};
    uint32_t first = 77, coming = 5, number = 77;
    size_t count = 77, ids = 0, vertices = 0;
    double values[12];
    OK(deldrift_stage_insertions(t, place, 1, &first));
    OK(deldrift_id_count(t, &ids));
    OK(deldrift_vertex_count(t, &vertices));
    CHECK(first == coming && ids == 6 && vertices == 5 && !is_present(t, coming));
    INSERTION_IS_STAGED(deldrift_position(t, coming, values));
    INSERTION_IS_STAGED(deldrift_star(t, coming, NULL, 0, &count));
    INSERTION_IS_STAGED(deldrift_ordered_star(t, coming, NULL, 0, &count));
    INSERTION_IS_STAGED(deldrift_tolerance(t, coming, values));
    INSERTION_IS_STAGED(deldrift_coincident_representative(t, coming, &number));
    INSERTION_IS_STAGED(deldrift_cells_around(t, &coming, 1, NULL, 0, &count));
    INSERTION_IS_STAGED(deldrift_move_vertex(t, coming, aim));
    INSERTION_IS_STAGED(deldrift_move_vertices(t, &coming, aim, 1));
    INSERTION_IS_STAGED(deldrift_relocate_vertex(t, coming, aim));
    INSERTION_IS_STAGED(deldrift_remove_vertex(t, coming));
    INSERTION_IS_STAGED(deldrift_stage_removals(t, &coming, 1));
    CHECK(count == 77 && number == 77);
    // Nor is it found where it will be.
    deldrift_location location;
    OK(deldrift_locate(t, place, &location));
    CHECK(location.kind == DELDRIFT_LOCATION_CELL);
    // In arrays by id it is absent, but its place is told.
    OK(deldrift_voronoi_volumes(t, NULL, NULL, values, 6, &count));
    CHECK(count == 6 && isnan(values[5]));
    OK(deldrift_copy_positions(t, values, 6, &count));
    CHECK(count == 6 && values[10] == 2 && values[11] == 2);
    CHECK_STATUS(deldrift_commit_positions(t, values, 5, NULL), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("count is 5, but must be 6, with one vertex whose insertion is staged");
    deldrift_destroy(t);
}

// Positions of all ids say where it will be, with the commit or before it.
static void coming_vertices_are_placed_by_positions_of_all(void) {
    for (int in_one = 0; in_one < 2; in_one++) {
        deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
        static const double place[] = {2, 2};
        uint32_t first = 77;
        size_t count = 77, staged = 77;
        double values[12];
        deldrift_commit_report report;
        OK(deldrift_stage_insertions(t, place, 1, &first));
        OK(deldrift_copy_positions(t, values, 6, &count));
        values[10] = NAN;
        CHECK_STATUS(deldrift_move_vertices(t, NULL, values, 6), DELDRIFT_NOT_FINITE);
        CHECK_STATUS(deldrift_commit_positions(t, values, 6, NULL), DELDRIFT_NOT_FINITE);
        CHECK_MESSAGE("positions[5], coordinate 0");
        OK(deldrift_staged_count(t, &staged));
        CHECK(staged == 0);
        values[10] = values[11] = 7;
        if (in_one) {
            OK(deldrift_commit_positions(t, values, 6, &report));
        } else {
            OK(deldrift_move_vertices(t, NULL, values, 6));
            OK(deldrift_commit_timestamp(t, &report));
        }
        CHECK(report.inserted == 1 && report.moved == 0);
        has_position(t, first, 7, 7);
        OK(deldrift_validate(t, 3));
        deldrift_destroy(t);
    }
}

#define REMOVAL_IS_STAGED(call)                                      \
    do {                                                             \
        CHECK_STATUS(call, DELDRIFT_STAGED_VERTEX);                  \
        CHECK_MESSAGE("is 4, a vertex whose removal is staged");     \
    } while (0)

// A vertex whose removal is staged is there until the commit, and goes with it.
static void leaving_vertices_are_there(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    static const uint32_t twice[] = {4, 4};
    static const double aim[] = {2, 1};
    const uint32_t leaving = 4;
    uint32_t number = 77;
    size_t count = 77;
    double tolerance = 0;
    REMOVAL_IS_STAGED(deldrift_stage_removals(t, twice, 2));
    OK(deldrift_stage_removals(t, twice, 1));
    CHECK(is_present(t, leaving));
    REMOVAL_IS_STAGED(deldrift_stage_removals(t, &leaving, 1));
    REMOVAL_IS_STAGED(deldrift_move_vertex(t, leaving, aim));
    REMOVAL_IS_STAGED(deldrift_move_vertices(t, &leaving, aim, 1));
    has_position(t, leaving, 1, 2);
    OK(deldrift_star(t, leaving, NULL, 0, &count));
    OK(deldrift_tolerance(t, leaving, &tolerance));
    OK(deldrift_coincident_representative(t, leaving, &number));
    OK(deldrift_cells_around(t, &leaving, 1, NULL, 0, &count));
    CHECK(count == 4 && tolerance > 0 && number == leaving);
    OK(deldrift_relocate_vertex(t, leaving, aim));
    has_position(t, leaving, 2, 1);
    // Its entry is not read.
    double positions[10];
    memcpy(positions, SQUARE, sizeof positions);
    positions[8] = positions[9] = NAN;
    deldrift_commit_report report;
    OK(deldrift_commit_positions(t, positions, SQUARE_COUNT, &report));
    CHECK(report.removed == 1 && !is_present(t, leaving) && cell_count(t) == 2);
    CHECK_STATUS(deldrift_position(t, leaving, positions), DELDRIFT_REMOVED_VERTEX);
    deldrift_destroy(t);
}

// A removal at once takes the staged one along.
static void leaving_vertices_are_removed_at_once(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    static const uint32_t two[] = {4, 1};
    deldrift_commit_report report;
    OK(deldrift_stage_removals(t, two, 2));
    OK(deldrift_remove_vertex(t, 4));
    OK(deldrift_commit_timestamp(t, &report));
    CHECK(report.removed == 1 && !is_present(t, 1) && cell_count(t) == 1);
    deldrift_destroy(t);
}

// All that can be read.
typedef struct {
    numbers numbers;
    arrays arrays;
} state;

static state look(const deldrift_triangulation *t) {
    return (state){numbers_of(t), arrays_of(t)};
}

static bool are_equal(state a, state b) {
    return memcmp(&a, &b, sizeof a) == 0;
}

typedef struct {
    deldrift_triangulation *t;
    size_t calls, last;
    double fraction;
} asked;

static void progress(void *user_data, double fraction) {
    ((asked *)user_data)->fraction = fraction;
}

static bool cancel(void *user_data) {
    asked *a = user_data;
    size_t count;
    // What is in use is busy.
    if (a->t != NULL) CHECK_STATUS(deldrift_vertex_count(a->t, &count), DELDRIFT_BUSY);
    return ++a->calls == a->last;
}

// Callbacks come from all calls that may take long.
static void callbacks_come_from_steps_in_one_call(void) {
    const size_t count = 4000;
    double *positions = random_positions(2, count, 5), *others = random_positions(2, count, 6);
    asked a = {NULL, 0, 0, -1};
    deldrift_options options;
    deldrift_options_init(&options);
    options.progress = progress;
    options.cancel = cancel;
    options.user_data = &a;
    deldrift_triangulation *t = create(2, positions, count, &options);
    CHECK(a.calls > 0 && a.fraction >= 0 && a.fraction <= 1);
    a = (asked){t, 0, 0, -1};
    OK(deldrift_commit_positions(t, others, count, NULL));
    CHECK(a.calls > 0 && a.fraction >= 0 && a.fraction <= 1);
    const state before = look(t);
    a = (asked){t, 0, 1, -1};
    CHECK_STATUS(deldrift_commit_positions(t, positions, count, NULL), DELDRIFT_CANCELLED);
        CHECK(are_equal(before, look(t)));
    deldrift_destroy(t);
    free(positions);
    free(others);
}

// A vertex with many neighbours is removed and relocated with callbacks, and put back when they say so.
static void callbacks_come_from_calls_on_one_vertex(void) {
    enum { N = 400 };
    static double curve[3 * N];
    for (size_t i = 0; i < N; i++) {
        const double x = (double)i;
        curve[3 * i] = x;
        curve[3 * i + 1] = x * x;
        curve[3 * i + 2] = x * x * x;
    }
    static const double aim[] = {50, 1e5, 1e6};
    asked a = {NULL, 0, 0, -1};
    deldrift_options options;
    deldrift_options_init(&options);
    options.cancel = cancel;
    options.user_data = &a;
    deldrift_triangulation *t = create(3, curve, N, &options);
    const state before = look(t);
    for (size_t last = 1; last < 4; last++) {
        a = (asked){t, 0, last, -1};
        CHECK_STATUS(deldrift_remove_vertex(t, 7), DELDRIFT_CANCELLED);
                CHECK(a.calls == last && are_equal(before, look(t)));
        a = (asked){t, 0, last, -1};
        CHECK_STATUS(deldrift_relocate_vertex(t, 7, aim), DELDRIFT_CANCELLED);
                CHECK(a.calls == last && are_equal(before, look(t)));
    }
    a = (asked){t, 0, 0, -1};
    OK(deldrift_relocate_vertex(t, 7, aim));
    OK(deldrift_remove_vertex(t, 7));
    CHECK(a.calls > 4 && !is_present(t, 7));
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
}

// Ids last until a compaction.
static void ids_are_those_of_the_points_until_a_compaction(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    static const double place[] = {3, 3};
    uint32_t map[6], first = 77;
    size_t count = 77;
    OK(deldrift_remove_vertex(t, 0));
    OK(deldrift_stage_insertions(t, place, 1, &first));
    has_position(t, 4, 1, 2);
    CHECK_STATUS(deldrift_compact(t, NULL, 1, &count), DELDRIFT_NULL_ARGUMENT);
    OK(deldrift_compact(t, map, 6, &count));
    CHECK(count == 6 && map[0] == DELDRIFT_NONE && map[4] == 3 && map[5] == 4);
    has_position(t, 3, 1, 2);
    CHECK_STATUS(deldrift_remove_vertex(t, map[5]), DELDRIFT_STAGED_VERTEX);
    OK(deldrift_commit_timestamp(t, NULL));
    has_position(t, map[5], 3, 3);
    deldrift_destroy(t);
}

// Too few are as wrong as too many, where there has to be one for each id; else only too many are.
static void counts_may_be_too_small(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    double positions[12];
    memcpy(positions, SQUARE, sizeof SQUARE);
    positions[10] = positions[11] = 9;
    CHECK_STATUS(deldrift_commit_positions(t, positions, 4, NULL), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("count is 4, but must be 5");
    CHECK_STATUS(deldrift_commit_positions(t, positions, 0, NULL), DELDRIFT_WRONG_COUNT);
    CHECK_STATUS(deldrift_commit_positions(t, positions, 6, NULL), DELDRIFT_WRONG_COUNT);
    CHECK_STATUS(deldrift_move_vertices(t, NULL, positions, 6), DELDRIFT_WRONG_COUNT);
    OK(deldrift_move_vertices(t, NULL, positions, 4));
    deldrift_destroy(t);
}

// Where there are no cells a vertex is found at its place, and nothing elsewhere.
static void places_are_located_without_cells(void) {
    static const double line[] = {0, 0, 2, 2, 1, 1}, beside[] = {1, 2}, between[] = {0.5, 0.5};
    deldrift_triangulation *t = create(2, line, 3, NULL);
    deldrift_location location;
    for (uint32_t v = 0; v < 3; v++) {
        OK(deldrift_locate(t, line + 2 * v, &location));
        CHECK(location.kind == DELDRIFT_LOCATION_VERTEX && location.index == v);
    }
    OK(deldrift_locate(t, beside, &location));
    CHECK(location.kind == DELDRIFT_LOCATION_NO_CELLS && location.index == DELDRIFT_NONE);
    OK(deldrift_locate(t, between, &location));
    CHECK(location.kind == DELDRIFT_LOCATION_NO_CELLS && location.index == DELDRIFT_NONE);
    deldrift_destroy(t);
}

// NULL asks for a count, but only with a capacity of 0.
static void null_has_no_capacity(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    const uint32_t vertex = 4;
    size_t count = 77;
    OK(deldrift_copy_cells(t, NULL, NULL, 0, &count));
    OK(deldrift_copy_positions(t, NULL, 0, &count));
    OK(deldrift_star(t, vertex, NULL, 0, &count));
    OK(deldrift_research_annulus_widths(t, NULL, 0, &count));
    OK(deldrift_cells_around(t, &vertex, 1, NULL, 0, &count));
    OK(deldrift_edges(t, NULL, 0, &count));
    count = 77;
    CHECK_STATUS(deldrift_copy_cells(t, NULL, NULL, 4, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("vertices is NULL");
    CHECK_STATUS(deldrift_copy_positions(t, NULL, 5, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_star(t, vertex, NULL, 4, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_research_annulus_widths(t, NULL, 1, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_cells_around(t, &vertex, 1, NULL, 9, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_edges(t, NULL, 9, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK(count == 77);
    uint32_t first = 77;
    CHECK_STATUS(deldrift_stage_insertions(t, NULL, 0, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("first_vertex is NULL");
    OK(deldrift_stage_insertions(t, NULL, 0, &first));
    CHECK(first == 5);
    deldrift_destroy(t);
}

static size_t memory_bytes(const deldrift_triangulation *t) {
    size_t bytes = 0;
    OK(deldrift_memory_bytes(t, &bytes));
    return bytes;
}

// A call that fails, or only reads, may leave room behind, and nothing else.
static void memory_may_grow_where_nothing_else_changes(void) {
    const size_t count = 2000;
    double *positions = random_positions(2, count, 7), *others = random_positions(2, count, 8);
    asked a = {NULL, 0, 0, -1};
    deldrift_options options;
    deldrift_options_init(&options);
    options.cancel = cancel;
    options.user_data = &a;
    deldrift_triangulation *t = create(2, positions, count, &options);
    size_t bytes = memory_bytes(t);
    cells_of(t);
    CHECK(memory_bytes(t) > bytes);
    const state before = look(t);
    bytes = memory_bytes(t);
    a = (asked){t, 0, 1, -1};
    CHECK_STATUS(deldrift_commit_positions(t, others, count, NULL), DELDRIFT_CANCELLED);
    CHECK(memory_bytes(t) > bytes);
        CHECK(are_equal(before, look(t)));
    bytes = memory_bytes(t);
    size_t ids = 0;
    OK(deldrift_compact(t, NULL, 0, &ids));
    CHECK(ids == count && memory_bytes(t) < bytes);
    deldrift_destroy(t);
    free(positions);
    free(others);
}

int main(void) {
    coming_vertices_are_not_there();
    coming_vertices_are_placed_by_positions_of_all();
    leaving_vertices_are_there();
    leaving_vertices_are_removed_at_once();
    callbacks_come_from_steps_in_one_call();
    callbacks_come_from_calls_on_one_vertex();
    ids_are_those_of_the_points_until_a_compaction();
    counts_may_be_too_small();
    places_are_located_without_cells();
    null_has_no_capacity();
    memory_may_grow_where_nothing_else_changes();
    return 0;
}
