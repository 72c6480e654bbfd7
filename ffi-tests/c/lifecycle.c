// Creation and destruction, version, status texts.
#include "check.h"

static void version_is_that_of_the_header(void) {
    char version[64];
    snprintf(version, sizeof version, "%d.%d.%d", DELDRIFT_VERSION_MAJOR, DELDRIFT_VERSION_MINOR,
             DELDRIFT_VERSION_PATCH);
    CHECK(strcmp(version, DELDRIFT_VERSION_STRING) == 0);
    CHECK(strcmp(version, deldrift_version()) == 0);
}

static void every_status_has_a_text_of_its_own(void) {
    for (uint32_t s = DELDRIFT_OK; s <= DELDRIFT_STAGED_VERTEX; s++) {
        CHECK(strlen(deldrift_status_string((deldrift_status)s)) > 0);
        CHECK(strcmp(deldrift_status_string((deldrift_status)s), "unknown status") != 0);
        for (uint32_t other = DELDRIFT_OK; other < s; other++) {
            CHECK(strcmp(deldrift_status_string((deldrift_status)s),
                         deldrift_status_string((deldrift_status)other)) != 0);
        }
    }
    CHECK(strcmp(deldrift_status_string((deldrift_status)(DELDRIFT_NOT_WEIGHTED + 1)), "unknown status") == 0);
    CHECK(strcmp(deldrift_status_string((deldrift_status)UINT32_MAX), "unknown status") == 0);
}

static void nothing_has_failed_yet(void) {
    CHECK(deldrift_last_error() != NULL);
    CHECK(deldrift_last_error()[0] == '\0');
}

static void both_dimensions_exist(void) {
    uint32_t dimension = 0;
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    OK(deldrift_dimension(t, &dimension));
    CHECK(dimension == 2);
    CHECK(cell_count(t) == 4);
    deldrift_destroy(t);

    t = create(3, TETRAHEDRON, TETRAHEDRON_COUNT, NULL);
    OK(deldrift_dimension(t, &dimension));
    CHECK(dimension == 3);
    CHECK(cell_count(t) == 4);
    deldrift_destroy(t);

    t = (deldrift_triangulation *)SQUARE;
    for (uint32_t wrong = 0; wrong < 6; wrong += wrong == 1 ? 3 : 1) {
        CHECK_STATUS(deldrift_create(wrong, SQUARE, 1, NULL, &t), DELDRIFT_INVALID_DIMENSION);
        CHECK_MESSAGE("dimension is ");
        CHECK(t == (deldrift_triangulation *)SQUARE);
    }
    CHECK_STATUS(deldrift_create(UINT32_MAX, NULL, 0, NULL, &t), DELDRIFT_INVALID_DIMENSION);
    CHECK_MESSAGE("4294967295");
}

static void few_points_are_legal_and_have_no_cells(void) {
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        for (size_t count = 0; count <= dimension; count++) {
            deldrift_triangulation *t = create(dimension, count == 0 ? NULL : TETRAHEDRON, count, NULL);
            size_t vertices = SIZE_MAX;
            OK(deldrift_vertex_count(t, &vertices));
            CHECK(vertices == count);
            CHECK(cell_count(t) == 0);
            OK(deldrift_commit_timestamp(t, NULL));
            OK(deldrift_validate(t, 3));
            deldrift_destroy(t);
        }
    }
}

static void positions_are_copied(void) {
    double *positions = malloc(sizeof SQUARE);
    CHECK(positions != NULL);
    memcpy(positions, SQUARE, sizeof SQUARE);
    deldrift_triangulation *t = create(2, positions, SQUARE_COUNT, NULL);
    memset(positions, 255, sizeof SQUARE);
    free(positions);
    double position[2];
    OK(deldrift_position(t, 2, position));
    CHECK(position[0] == 5 && position[1] == 5);
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
}

static void bad_positions_are_refused(void) {
    static const double bad[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300, 1e58};
    deldrift_triangulation *t = NULL;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        double positions[sizeof SQUARE / sizeof *SQUARE];
        memcpy(positions, SQUARE, sizeof SQUARE);
        positions[5] = bad[i];
        CHECK_STATUS(deldrift_create(2, positions, SQUARE_COUNT, NULL, &t),
                     i < 3 ? DELDRIFT_NOT_FINITE : DELDRIFT_OUT_OF_RANGE);
        CHECK_MESSAGE("positions[2], coordinate 1");
        CHECK(t == NULL);
    }
}

static void the_whole_range_is_accepted(void) {
    static const double good[] = {0, -0.0, 1e57, -1e57, 1e-42, 1e-300, 2.2250738585072014e-308, -4.9406564584124654e-324};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        double positions[sizeof SQUARE / sizeof *SQUARE], position[2] = {NAN, NAN};
        memcpy(positions, SQUARE, sizeof SQUARE);
        positions[8] = good[i];
        deldrift_triangulation *t = create(2, positions, SQUARE_COUNT, NULL);
        OK(deldrift_position(t, 4, position));
        CHECK(position[0] == good[i] && position[1] == 2);
        OK(deldrift_validate(t, 3));
        OK(deldrift_move_vertex(t, 0, position));
        OK(deldrift_commit_timestamp(t, NULL));
        OK(deldrift_validate(t, 3));
        deldrift_destroy(t);
    }
}

static void absurd_counts_are_refused(void) {
    deldrift_triangulation *t = NULL;
    CHECK_STATUS(deldrift_create(2, SQUARE, SIZE_MAX, NULL, &t), DELDRIFT_TOO_MANY_VERTICES);
    CHECK_STATUS(deldrift_create(3, SQUARE, (size_t)UINT32_MAX, NULL, &t), DELDRIFT_TOO_MANY_VERTICES);
    CHECK_MESSAGE("4294967295");
    CHECK(t == NULL);
}

static void a_failure_leaves_the_triangulation_destroyable(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    CHECK_STATUS(deldrift_remove_vertex(t, 5), DELDRIFT_NO_SUCH_VERTEX);
    deldrift_destroy(t);
    CHECK_MESSAGE("vertex[0] is 5");
    deldrift_destroy(NULL);
}

int main(void) {
    nothing_has_failed_yet();
    version_is_that_of_the_header();
    every_status_has_a_text_of_its_own();
    both_dimensions_exist();
    few_points_are_legal_and_have_no_cells();
    positions_are_copied();
    bad_positions_are_refused();
    the_whole_range_is_accepted();
    absurd_counts_are_refused();
    a_failure_leaves_the_triangulation_destroyable();
    return 0;
}
