// Views of cells: which calls leave them as they are, and views that outlive their triangulation.
#include "check.h"

enum { COUNT = 300 };

// A copy of what a view shows.
typedef struct {
    deldrift_cells_view view;
    uint32_t *vertices, *neighbours;
} copy;

static copy copy_of(const deldrift_triangulation *t) {
    copy made = {cells_of(t), NULL, NULL};
    const size_t bytes = made.view.count * made.view.corners_per_cell * sizeof(uint32_t);
    made.vertices = malloc(bytes);
    made.neighbours = malloc(bytes);
    CHECK(made.vertices != NULL && made.neighbours != NULL);
    memcpy(made.vertices, made.view.vertices, bytes);
    memcpy(made.neighbours, made.view.neighbours, bytes);
    return made;
}

// Whether the arrays that the view shows are as they were.
static void check_copy(const copy *made) {
    const size_t bytes = made->view.count * made->view.corners_per_cell * sizeof(uint32_t);
    CHECK(memcmp(made->vertices, made->view.vertices, bytes) == 0);
    CHECK(memcmp(made->neighbours, made->view.neighbours, bytes) == 0);
}

static void free_copy(copy *made) {
    free(made->vertices);
    free(made->neighbours);
}

static void calls_that_change_no_cell_leave_views(uint32_t dimension) {
    double *positions = random_positions(dimension, COUNT, 11);
    deldrift_triangulation *t = create(dimension, positions, COUNT, NULL);
    deldrift_changes changes;
    uint32_t first;
    for (int round = 0; round < 3; round++) {
        copy made = copy_of(t);
        OK(deldrift_take_changes(t, &changes));
        check_copy(&made);
        for (uint32_t v = 0; v < COUNT; v += 3) OK(deldrift_move_vertex(t, v, positions + (v + 1) % COUNT * dimension));
        check_copy(&made);
        OK(deldrift_discard_moves(t));
        OK(deldrift_move_vertices(t, NULL, positions, COUNT));
        OK(deldrift_stage_insertions(t, positions, COUNT / 2, &first));
        OK(deldrift_stage_removals(t, (const uint32_t[]){5, 7}, 2));
        check_copy(&made);
        OK(deldrift_set_algorithm(t, round == 0 ? DELDRIFT_TOLERANCE : DELDRIFT_AUTO));
        check_copy(&made);
        OK(deldrift_discard_moves(t));
        const deldrift_cells_view again = cells_of(t);
        CHECK(again.vertices == made.view.vertices && again.neighbours == made.view.neighbours);
        free_copy(&made);
        for (uint32_t k = 0; k < COUNT * dimension; k++) positions[k] += 0.01 * (k % 7);
        OK(deldrift_commit_positions(t, positions, COUNT, NULL));
    }
    deldrift_destroy(t);
    free(positions);
}

static void released_cells_outlive_changes_and_triangulations(uint32_t dimension) {
    double *positions = random_positions(dimension, COUNT, 12);
    deldrift_triangulation *t = create(dimension, positions, COUNT, NULL);
    deldrift_triangulation *other = create(dimension, positions, COUNT, NULL);
    deldrift_changes all;
    OK(deldrift_take_changes(t, &all));
    OK(deldrift_take_changes(other, &all));
    enum { ROUNDS = 3 };
    copy copies[ROUNDS];
    deldrift_released_cells *owners[ROUNDS];
    for (int round = 0; round < ROUNDS; round++) {
        copies[round] = copy_of(t);
        deldrift_cells_view view;
        OK(deldrift_release_cells(t, &view, &owners[round]));
        // What has been shown before is what is handed over, and the triangulation has the same cells elsewhere.
        CHECK(view.vertices == copies[round].view.vertices && view.neighbours == copies[round].view.neighbours);
        CHECK(view.count == copies[round].view.count && view.corners_per_cell == dimension + 1);
        const deldrift_cells_view own = cells_of(t);
        CHECK(own.vertices != view.vertices && own.count == view.count);
        CHECK(memcmp(own.vertices, view.vertices, view.count * (dimension + 1) * sizeof(uint32_t)) == 0);
        for (uint32_t k = 0; k < COUNT * dimension; k++) positions[k] += 0.02 * (k % 5);
        OK(deldrift_commit_positions(t, positions, COUNT, NULL));
        OK(deldrift_validate(t, 3));
        // Cells and changes are those of a copy that has handed nothing over.
        OK(deldrift_commit_positions(other, positions, COUNT, NULL));
        copy one = copy_of(t), its = copy_of(other);
        CHECK(one.view.count == its.view.count);
        const size_t bytes = one.view.count * (dimension + 1) * sizeof(uint32_t);
        CHECK(memcmp(one.vertices, its.vertices, bytes) == 0 && memcmp(one.neighbours, its.neighbours, bytes) == 0);
        free_copy(&one);
        free_copy(&its);
        deldrift_changes changes[2];
        OK(deldrift_take_changes(t, &changes[0]));
        OK(deldrift_take_changes(other, &changes[1]));
        CHECK(changes[0].created_count == changes[1].created_count && changes[0].created_count > 0);
        CHECK(changes[0].removed_count == changes[1].removed_count);
        CHECK(changes[0].renumbered_count == changes[1].renumbered_count);
    }
    deldrift_destroy(other);
    deldrift_destroy(t);
    for (int round = ROUNDS - 1; round >= 0; round--) {
        check_copy(&copies[round]);
        deldrift_free_cells(owners[round]);
        free_copy(&copies[round]);
    }
    free(positions);
}

static void there_may_be_no_cells_to_release(void) {
    deldrift_triangulation *t = create(2, NULL, 0, NULL);
    deldrift_cells_view view;
    deldrift_released_cells *owner;
    OK(deldrift_release_cells(t, &view, &owner));
    CHECK(view.count == 0 && view.corners_per_cell == 3 && view.vertices == NULL && view.neighbours == NULL);
    deldrift_free_cells(owner);
    deldrift_free_cells(NULL);
    CHECK_STATUS(deldrift_release_cells(NULL, &view, &owner), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_release_cells(t, NULL, &owner), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("view is NULL");
    CHECK_STATUS(deldrift_release_cells(t, &view, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("owner is NULL");
    deldrift_destroy(t);
}

int main(void) {
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        calls_that_change_no_cell_leave_views(dimension);
        released_cells_outlive_changes_and_triangulations(dimension);
    }
    there_may_be_no_cells_to_release();
    return 0;
}
