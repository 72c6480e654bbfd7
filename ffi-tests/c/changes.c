// A solver keeps a number for each cell, and lists of neighbours for each vertex, and updates both from the change list
// while vertices move, come and go.
#include "check.h"

// What the solver keeps: for each cell the sum of its vertices' squares, which depends on nothing else, and for
// each vertex how many cells it has.
typedef struct {
    uint32_t corners;
    size_t cells, vertices;
    uint64_t *datum;
    uint32_t *degree;
} solver;

enum { ROOM = 20000 };

static uint64_t datum_of(const uint32_t *row, uint32_t corners) {
    uint64_t sum = 0;
    for (uint32_t i = 0; i < corners; i++) sum += (uint64_t)row[i] * row[i] + 1;
    return sum;
}

static void add(solver *s, const uint32_t *row, uint32_t by) {
    for (uint32_t i = 0; i < s->corners; i++) s->degree[row[i]] += by;
}

static void follow(solver *s, deldrift_triangulation *t) {
    deldrift_changes changes;
    deldrift_cells_view view;
    OK(deldrift_take_changes(t, &changes));
    OK(deldrift_cells(t, &view));
    CHECK(view.count < ROOM);
    for (size_t i = 0; i < sizeof changes.reserved / sizeof *changes.reserved; i++) CHECK(changes.reserved[i] == 0);
    for (size_t k = 0; k < changes.removed_count; k++) {
        const uint32_t *row = changes.removed_vertices + k * s->corners;
        CHECK(s->datum[changes.removed[k]] == datum_of(row, s->corners));
        add(s, row, UINT32_MAX);
    }
    uint64_t *moved = malloc((changes.renumbered_count + 1) * sizeof *moved);
    for (size_t k = 0; k < changes.renumbered_count; k++) moved[k] = s->datum[changes.renumbered_from[k]];
    for (size_t k = 0; k < changes.renumbered_count; k++) s->datum[changes.renumbered_to[k]] = moved[k];
    free(moved);
    for (size_t k = 0; k < changes.created_count; k++) {
        const uint32_t *row = view.vertices + changes.created[k] * s->corners;
        s->datum[changes.created[k]] = datum_of(row, s->corners);
        add(s, row, 1);
    }
    CHECK(view.count + changes.removed_count == s->cells + changes.created_count);
    s->cells = view.count;
    for (size_t c = 0; c < view.count; c++) {
        CHECK(s->datum[c] == datum_of(view.vertices + c * s->corners, s->corners));
    }
    for (uint32_t v = 0; v < s->vertices; v++) {
        bool present;
        size_t count = 0;
        OK(deldrift_is_present(t, v, &present));
        if (present) (void)deldrift_star(t, v, NULL, 0, &count);
        CHECK(s->degree[v] == count);
    }
}

static void a_solver_follows(uint32_t dimension) {
    enum { COUNT = 400 };
    uint64_t state = 23;
    double *positions = random_positions(dimension, COUNT, 5);
    deldrift_triangulation *t = create(dimension, positions, COUNT, NULL);
    solver s = {dimension + 1, 0, COUNT, calloc(ROOM, sizeof *s.datum), calloc(ROOM, sizeof *s.degree)};
    follow(&s, t);
    for (int step = 0; step < 40; step++) {
        // A hundredth of the vertices go, as many come, and the others move, in one commit.
        uint32_t leaving[4], first = 0;
        double coming[12];
        size_t n_leaving = 0;
        for (uint32_t v = (uint32_t)(step * 4); n_leaving < 4; v++) {
            bool present;
            OK(deldrift_is_present(t, v, &present));
            if (present) leaving[n_leaving++] = v;
        }
        for (size_t i = 0; i < 4 * dimension; i++) coming[i] = next_random(&state);
        OK(deldrift_stage_insertions(t, coming, 4, &first));
        CHECK(first == s.vertices);
        OK(deldrift_stage_removals(t, leaving, n_leaving));
        positions = realloc(positions, (s.vertices + 4) * dimension * sizeof *positions);
        memcpy(positions + s.vertices * dimension, coming, 4 * dimension * sizeof *positions);
        for (size_t i = 0; i < s.vertices * dimension; i++) positions[i] += 0.004 * (next_random(&state) - 0.5);
        OK(deldrift_move_vertices(t, NULL, positions, s.vertices + 4));
        deldrift_commit_report report;
        OK(deldrift_commit_timestamp(t, &report));
        CHECK(report.inserted == 4 && report.removed == 4);
        s.vertices += 4;
        if (step % 3 != 1) follow(&s, t);
        // Immediate calls count like commits.
        if (step % 4 == 0) {
            uint32_t vertex;
            OK(deldrift_insert_vertex(t, coming + dimension, &vertex));
            OK(deldrift_remove_vertex(t, vertex));
            positions = realloc(positions, (s.vertices + 1) * dimension * sizeof *positions);
            memset(positions + s.vertices * dimension, 0, dimension * sizeof *positions);
            s.vertices += 1;
            OK(deldrift_relocate_vertex(t, first, coming + dimension * (step % 2)));
            memcpy(positions + first * dimension, coming + dimension * (step % 2), dimension * sizeof *positions);
        }
    }
    follow(&s, t);
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
    free(s.datum);
    free(s.degree);
    free(positions);
}

static void nothing_is_listed_twice(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    deldrift_changes changes;
    OK(deldrift_take_changes(t, &changes));
    CHECK(changes.created_count == 4 && changes.created[0] == 0 && changes.star_count == SQUARE_COUNT);
    CHECK(changes.removed_count == 0 && changes.removed == NULL && changes.removed_vertices == NULL);
    OK(deldrift_take_changes(t, &changes));
    CHECK(changes.created_count + changes.removed_count + changes.renumbered_count + changes.star_count == 0);
    CHECK(changes.created == NULL && changes.hidden == NULL && changes.shown == NULL);

    // Onto another vertex, and away again.
    OK(deldrift_move_vertex(t, 4, SQUARE + 2));
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_take_changes(t, &changes));
    CHECK(changes.hidden_count == 1 && changes.hidden[0] == 4 && changes.shown_count == 0);
    CHECK(changes.removed_count == 4 && changes.created_count == 2);
    OK(deldrift_relocate_vertex(t, 4, SQUARE + 8));
    OK(deldrift_take_changes(t, &changes));
    CHECK(changes.shown_count == 1 && changes.shown[0] == 4 && changes.hidden_count == 0);
    CHECK(changes.removed_count == 2 && changes.created_count == 4);
    deldrift_destroy(t);
}

static void positions_are_committed_in_one_call(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    double positions[2 * SQUARE_COUNT];
    memcpy(positions, SQUARE, sizeof positions);
    positions[8] = 2;
    deldrift_commit_report report;
    OK(deldrift_commit_positions(t, positions, SQUARE_COUNT, &report));
    CHECK(report.moved == 1 && report.timestamp == 1);
    CHECK_STATUS(deldrift_commit_positions(t, positions, SQUARE_COUNT - 1, &report), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("count is 4");
    positions[3] = NAN;
    CHECK_STATUS(deldrift_commit_positions(t, positions, SQUARE_COUNT, NULL), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("positions[1], coordinate 1");
    positions[3] = 0;
    size_t staged = 77;
    OK(deldrift_staged_count(t, &staged));
    CHECK(staged == 0);
    OK(deldrift_move_vertex(t, 3, positions));
    CHECK_STATUS(deldrift_commit_positions(t, positions, SQUARE_COUNT, NULL), DELDRIFT_DUPLICATE_MOVE);
    OK(deldrift_discard_moves(t));
    OK(deldrift_commit_positions(t, positions, SQUARE_COUNT, NULL));
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
}

static void edits_are_staged_all_or_none(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    static const double bad[] = {1, 1, 2, INFINITY}, good[] = {1, 1, 2, 1};
    static const uint32_t twice[] = {4, 4}, unknown[] = {4, 5};
    uint32_t first = 77;
    size_t ids = 0;
    CHECK_STATUS(deldrift_stage_insertions(t, bad, 2, &first), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("positions[1], coordinate 1");
    CHECK_STATUS(deldrift_stage_removals(t, twice, 2), DELDRIFT_STAGED_VERTEX);
    CHECK_MESSAGE("vertices[1] is 4");
    CHECK_STATUS(deldrift_stage_removals(t, unknown, 2), DELDRIFT_NO_SUCH_VERTEX);
    OK(deldrift_stage_removals(t, NULL, 0));
    OK(deldrift_stage_insertions(t, NULL, 0, &first));
    OK(deldrift_id_count(t, &ids));
    CHECK(first == 5 && ids == 5);
    OK(deldrift_stage_insertions(t, good, 2, &first));
    OK(deldrift_stage_removals(t, twice, 1));
    CHECK_STATUS(deldrift_move_vertex(t, 4, good), DELDRIFT_STAGED_VERTEX);
    OK(deldrift_discard_moves(t));
    OK(deldrift_id_count(t, &ids));
    CHECK(first == 5 && ids == 5);
    OK(deldrift_commit_timestamp(t, NULL));
    CHECK(cell_count(t) == 4);
    deldrift_destroy(t);
}

int main(void) {
    a_solver_follows(2);
    a_solver_follows(3);
    nothing_is_listed_twice();
    positions_are_committed_in_one_call();
    edits_are_staged_all_or_none();
    return 0;
}
