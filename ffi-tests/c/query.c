// Positions, cells, stars, changes, validation.
#include "check.h"

// Twice the area or six times the volume of a cell.
static double measure_of(const deldrift_triangulation *t, const uint32_t *cell, uint32_t corners) {
    double e[3][3] = {{0}}, origin[3], p[3];
    OK(deldrift_position(t, cell[0], origin));
    for (uint32_t i = 1; i < corners; i++) {
        OK(deldrift_position(t, cell[i], p));
        for (uint32_t k = 0; k + 1 < corners; k++) e[i - 1][k] = p[k] - origin[k];
    }
    if (corners == 3) return e[0][0] * e[1][1] - e[0][1] * e[1][0];
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

static void cells_are_positive_and_neighbours_mutual(uint32_t dimension) {
    enum { COUNT = 300 };
    double *positions = random_positions(dimension, COUNT, 5);
    deldrift_triangulation *t = create(dimension, positions, COUNT, NULL);
    deldrift_cells_view view = cells_of(t);
    uint32_t d = view.corners_per_cell;
    CHECK(d == dimension + 1 && view.count == cell_count(t) && view.count > COUNT);
    size_t hull = 0;
    for (size_t c = 0; c < view.count; c++) {
        const uint32_t *cell = view.vertices + c * d;
        CHECK(measure_of(t, cell, d) > 0);
        for (uint32_t i = 0; i < d; i++) {
            CHECK(cell[i] < COUNT);
            uint32_t other = view.neighbours[c * d + i];
            if (other == DELDRIFT_NONE) {
                hull++;
                continue;
            }
            CHECK(other < view.count);
            const uint32_t *across = view.vertices + other * d;
            CHECK(!has_corner(across, d, cell[i]));
            for (uint32_t j = 0; j < d; j++) CHECK(j == i || has_corner(across, d, cell[j]));
            CHECK(has_corner(view.neighbours + other * d, d, (uint32_t)c));
        }
    }
    CHECK(hull > dimension);
    for (uint32_t level = 1; level <= 3; level++) OK(deldrift_validate(t, level));
    CHECK_STATUS(deldrift_validate(t, 0), DELDRIFT_INVALID_LEVEL);
    CHECK_STATUS(deldrift_validate(t, 4), DELDRIFT_INVALID_LEVEL);
    CHECK_MESSAGE("level is 4");
    deldrift_destroy(t);
    free(positions);
}

static void stars_are_the_cells_with_the_vertex(uint32_t dimension) {
    enum { COUNT = 200 };
    double *positions = random_positions(dimension, COUNT, 6);
    deldrift_triangulation *t = create(dimension, positions, COUNT, NULL);
    deldrift_cells_view view = cells_of(t);
    uint32_t d = view.corners_per_cell;
    size_t corners = 0;
    for (uint32_t v = 0; v < COUNT; v++) {
        size_t count = 0, again = 0;
        OK(deldrift_star(t, v, NULL, 0, &count));
        CHECK(count > 0);
        uint32_t *star = malloc(count * sizeof *star);
        CHECK(star != NULL);
        star[0] = 77;
        CHECK_STATUS(deldrift_star(t, v, star, count - 1, &again), DELDRIFT_BUFFER_TOO_SMALL);
        CHECK_MESSAGE("capacity is ");
        CHECK(again == count && star[0] == 77);
        OK(deldrift_star(t, v, star, count, &again));
        CHECK(again == count);
        for (size_t i = 0; i < count; i++) CHECK(has_corner(view.vertices + star[i] * d, d, v));
        corners += count;
        free(star);
    }
    CHECK(corners == view.count * d);
    size_t count = 77;
    CHECK_STATUS(deldrift_star(t, COUNT, NULL, 0, &count), DELDRIFT_NO_SUCH_VERTEX);
    OK(deldrift_remove_vertex(t, 7));
    CHECK_STATUS(deldrift_star(t, 7, NULL, 0, &count), DELDRIFT_REMOVED_VERTEX);
    CHECK(count == 77);
    deldrift_destroy(t);
    free(positions);
}

static void copies_are_those_of_the_views(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    deldrift_cells_view view = cells_of(t);
    size_t numbers = view.count * view.corners_per_cell, count = 0;
    uint32_t vertices[12], neighbours[12];
    CHECK(numbers == 12);
    OK(deldrift_copy_cells(t, NULL, NULL, 0, &count));
    CHECK(count == 4);
    count = 0;
    vertices[0] = neighbours[0] = 77;
    CHECK_STATUS(deldrift_copy_cells(t, vertices, neighbours, 3, &count), DELDRIFT_BUFFER_TOO_SMALL);
    CHECK(count == 4 && vertices[0] == 77 && neighbours[0] == 77);
    OK(deldrift_copy_cells(t, vertices, NULL, 4, &count));
    CHECK(memcmp(vertices, view.vertices, sizeof vertices) == 0 && neighbours[0] == 77);
    memset(vertices, 0, sizeof vertices);
    OK(deldrift_copy_cells(t, NULL, neighbours, 4, &count));
    CHECK(memcmp(neighbours, view.neighbours, sizeof neighbours) == 0 && vertices[0] == 0);
    OK(deldrift_copy_cells(t, vertices, neighbours, 5, &count));
    CHECK(memcmp(vertices, view.vertices, sizeof vertices) == 0 && count == 4);
    deldrift_destroy(t);
}

static void positions_of_removed_vertices_are_not_numbers(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    double positions[2 * SQUARE_COUNT] = {77};
    size_t count = 0;
    OK(deldrift_copy_positions(t, NULL, 0, &count));
    CHECK(count == SQUARE_COUNT);
    count = 0;
    CHECK_STATUS(deldrift_copy_positions(t, positions, SQUARE_COUNT - 1, &count), DELDRIFT_BUFFER_TOO_SMALL);
    CHECK(count == SQUARE_COUNT && positions[0] == 77);
    OK(deldrift_remove_vertex(t, 1));
    OK(deldrift_copy_positions(t, positions, SQUARE_COUNT, &count));
    for (size_t i = 0; i < 2 * SQUARE_COUNT; i++) {
        if (i / 2 == 1) {
            CHECK(isnan(positions[i]));
        } else {
            CHECK(positions[i] == SQUARE[i]);
        }
    }
    double position[2] = {77, 77};
    CHECK_STATUS(deldrift_position(t, 9, position), DELDRIFT_NO_SUCH_VERTEX);
    CHECK(position[0] == 77);
    deldrift_destroy(t);
}

static double distance(const double *p, const double *q, uint32_t dimension) {
    double sum = 0;
    for (uint32_t k = 0; k < dimension; k++) sum += (p[k] - q[k]) * (p[k] - q[k]);
    return sqrt(sum);
}

// Nearly as far as they may, in all directions.
static void cells_stay_while_vertices_are_within_tolerance(uint32_t dimension) {
    enum { COUNT = 300 };
    uint64_t state = 17;
    double *positions = random_positions(dimension, COUNT, 16);
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = DELDRIFT_TOLERANCE;
    deldrift_triangulation *t = create(dimension, positions, COUNT, &options);
    deldrift_changes changes;
    OK(deldrift_take_changes(t, &changes));
    for (uint32_t v = 0; v < COUNT; v++) {
        double tolerance, direction[3] = {0}, nowhere[3] = {0};
        OK(deldrift_tolerance(t, v, &tolerance));
        for (uint32_t k = 0; k < dimension; k++) direction[k] = next_random(&state) - 0.5;
        double length = distance(direction, nowhere, dimension);
        for (uint32_t k = 0; k < dimension; k++) {
            positions[v * dimension + k] += 0.999 * tolerance * direction[k] / length;
        }
    }
    OK(deldrift_move_vertices(t, NULL, positions, COUNT));
    deldrift_commit_report report;
    OK(deldrift_commit_timestamp(t, &report));
    CHECK(report.moved == COUNT && report.within_tolerance == COUNT && report.placements == 0);
    OK(deldrift_take_changes(t, &changes));
    CHECK(changes.created_count == 0 && changes.removed_count == 0);
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
    free(positions);
}

static void views_without_cells_are_empty(void) {
    static const double line[] = {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3};
    deldrift_triangulation *t = create(3, line, 4, NULL);
    deldrift_cells_view view = cells_of(t);
    CHECK(view.count == 0 && view.corners_per_cell == 4 && view.vertices == NULL && view.neighbours == NULL);
    deldrift_changes changes = {.created_count = 77};
    OK(deldrift_take_changes(t, &changes));
    CHECK(changes.created_count == 0 && changes.created == NULL && changes.stars == NULL);
    size_t count = 77;
    OK(deldrift_star(t, 0, NULL, 0, &count));
    CHECK(count == 0);
    double tolerance = 0;
    OK(deldrift_tolerance(t, 0, &tolerance));
    CHECK(tolerance == INFINITY);
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
}

static void views_stay_until_the_next_change(void) {
    enum { COUNT = 500 };
    double *positions = random_positions(2, COUNT, 7);
    deldrift_triangulation *t = create(2, positions, COUNT, NULL);
    deldrift_cells_view view = cells_of(t), later;
    size_t bytes = view.count * 3 * sizeof(uint32_t), count = 0;
    uint32_t *copy = malloc(bytes);
    CHECK(copy != NULL);
    memcpy(copy, view.vertices, bytes);

    // Queries, failures among them, leave it where it is.
    deldrift_location location;
    uint32_t vertex;
    OK(deldrift_locate(t, positions + 10, &location));
    OK(deldrift_nearest_vertex(t, positions + 12, &vertex));
    OK(deldrift_star(t, 3, NULL, 0, &count));
    OK(deldrift_validate(t, 3));
    OK(deldrift_memory_bytes(t, &count));
    CHECK(count > COUNT * 2 * sizeof(double) + 2 * bytes);
    CHECK_STATUS(deldrift_position(t, COUNT, positions), DELDRIFT_NO_SUCH_VERTEX);
    later = cells_of(t);
    CHECK(later.vertices == view.vertices && later.neighbours == view.neighbours);
    CHECK(memcmp(copy, view.vertices, bytes) == 0);

    // After a change that has no effect in the end, the cells are the same set, in a new view.
    OK(deldrift_insert_vertex(t, (const double[]){0.5, 0.5}, &vertex));
    OK(deldrift_remove_vertex(t, vertex));
    later = cells_of(t);
    CHECK(later.count == view.count);
    free(copy);
    deldrift_destroy(t);
    free(positions);
}

int main(void) {
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        cells_are_positive_and_neighbours_mutual(dimension);
        stars_are_the_cells_with_the_vertex(dimension);
        cells_stay_while_vertices_are_within_tolerance(dimension);
    }
    copies_are_those_of_the_views();
    positions_of_removed_vertices_are_not_numbers();
    views_without_cells_are_empty();
    views_stay_until_the_next_change();
    return 0;
}
