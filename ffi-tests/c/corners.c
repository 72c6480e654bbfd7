// Cells by their corners: those that have given vertices, one of each vertex, hidden vertices, barycentric coordinates,
// and which cells are flat along the hull.
#include "buffers.h"

static void simplices_of_the_square(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    const deldrift_cells_view view = cells_of(t);
    // All pairs: the diagonals of the quadrilateral alone are no edges.
    uint32_t pairs[20], found[10];
    size_t n = 0;
    for (uint32_t a = 0; a < 5; a++) {
        for (uint32_t b = 0; b < a; b++) {
            pairs[2 * n] = a;
            pairs[2 * n++ + 1] = b;
        }
    }
    // All at once, and one by one.
    for (size_t step = 1; step <= n; step += n - 1) {
        memset(found, 0x77, sizeof found);
        for (size_t k = 0; k < n; k += step) OK(deldrift_find_simplices(t, 2, pairs + 2 * k, step, found + k));
        for (size_t k = 0; k < n; k++) {
            const uint32_t a = pairs[2 * k], b = pairs[2 * k + 1];
            const bool is_diagonal = (a == 2 && b == 0) || (a == 3 && b == 1);
            CHECK((found[k] == DELDRIFT_NONE) == is_diagonal);
            if (is_diagonal) continue;
            CHECK(found[k] < view.count && has_corner(view.vertices + 3 * found[k], 3, a));
            CHECK(has_corner(view.vertices + 3 * found[k], 3, b));
        }
    }
    // Triangles in any order, and two that are none.
    static const uint32_t triangles[] = {4, 1, 0, 1, 2, 4, 4, 3, 2, 3, 0, 4, 0, 1, 2, 1, 2, 3};
    OK(deldrift_find_simplices(t, 3, triangles, 6, found));
    for (size_t k = 0; k < 4; k++) {
        CHECK(found[k] < view.count);
        for (int i = 0; i < 3; i++) CHECK(has_corner(view.vertices + 3 * found[k], 3, triangles[3 * k + i]));
    }
    CHECK(found[4] == DELDRIFT_NONE && found[5] == DELDRIFT_NONE);
    static const uint32_t alone[] = {3, 3, 0};
    OK(deldrift_find_simplices(t, 1, alone, 3, found));
    for (size_t k = 0; k < 3; k++) CHECK(has_corner(view.vertices + 3 * found[k], 3, alone[k]));
    CHECK(found[0] == found[1]);

    // A hidden vertex is its representative; one whose removal is staged is still there.
    uint32_t hidden;
    OK(deldrift_insert_vertex(t, SQUARE + 8, &hidden));
    OK(deldrift_stage_removals(t, (uint32_t[]){4}, 1));
    const uint32_t of_hidden[] = {hidden, 0, hidden, 4, hidden, hidden, 4, 4};
    OK(deldrift_find_simplices(t, 2, of_hidden, 4, found));
    CHECK(has_corner(view.vertices + 3 * found[0], 3, 4) && has_corner(view.vertices + 3 * found[0], 3, 0));
    CHECK(found[1] == DELDRIFT_NONE && found[2] == DELDRIFT_NONE && found[3] == DELDRIFT_NONE);
    deldrift_destroy(t);
}

static void bad_simplices(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    uint32_t found[8], coming;
    memset(found, 0x77, sizeof found);
    OK(deldrift_remove_vertex(t, 2));
    OK(deldrift_stage_insertions(t, SQUARE + 8, 1, &coming));
    const uint32_t strange[] = {0, 99}, removed[] = {0, 1, 2}, staged[] = {coming, 0};
    CHECK_STATUS(deldrift_find_simplices(t, 2, strange, 1, found), DELDRIFT_NO_SUCH_VERTEX);
    CHECK_MESSAGE("vertices[1] is 99");
    CHECK_STATUS(deldrift_find_simplices(t, 3, removed, 1, found), DELDRIFT_REMOVED_VERTEX);
    CHECK_MESSAGE("vertices[2] is 2");
    CHECK_STATUS(deldrift_find_simplices(t, 1, staged, 2, found), DELDRIFT_STAGED_VERTEX);
    CHECK_MESSAGE("vertices[0] is 5");
    static const uint32_t sizes[] = {0, 4, 5, UINT32_MAX};
    static const char *const said[] = {"corners_per_simplex[0] is 0", "corners_per_simplex[0] is 4",
                                       "corners_per_simplex[0] is 5", "corners_per_simplex[0] is 4294967295"};
    for (int k = 0; k < 4; k++) {
        CHECK_STATUS(deldrift_find_simplices(t, sizes[k], strange, 1, found), DELDRIFT_INVALID_VALUE);
        CHECK_MESSAGE(said[k]);
        CHECK_STATUS(deldrift_find_simplices(t, sizes[k], NULL, 0, NULL), DELDRIFT_INVALID_VALUE);
    }
    CHECK_STATUS(deldrift_find_simplices(t, 2, NULL, 1, found), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("vertices is NULL");
    CHECK_STATUS(deldrift_find_simplices(t, 2, removed, 1, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("cells is NULL");
    CHECK_STATUS(deldrift_find_simplices(t, 2, removed, SIZE_MAX, found), DELDRIFT_SIZE_OVERFLOW);
    CHECK_MESSAGE("vertices cannot have");
    OK(deldrift_find_simplices(t, 3, NULL, 0, NULL));
    CHECK(is_untouched(found, sizeof found));
    deldrift_destroy(t);
    t = create(3, TETRAHEDRON, TETRAHEDRON_COUNT, NULL);
    static const uint32_t four[] = {0, 1, 2, 4, 0, 1, 2, 3};
    OK(deldrift_find_simplices(t, 4, four, 2, found));
    CHECK(found[0] < 4 && found[1] == DELDRIFT_NONE);
    CHECK_STATUS(deldrift_find_simplices(t, 5, four, 1, found), DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("corners_per_simplex[0] is 5");
    deldrift_destroy(t);
}

// Of all pairs of vertices those that deldrift_edges lists are in a cell.
static void edges_are_those_of_the_list(uint32_t dimension) {
    enum { COUNT = 50, PAIRS = COUNT * (COUNT - 1) / 2 };
    double *positions = random_positions(dimension, COUNT, 3);
    deldrift_triangulation *t = create(dimension, positions, COUNT, NULL);
    static uint32_t pairs[2 * PAIRS], found[PAIRS], edges[2 * PAIRS];
    size_t n = 0, n_edges, n_found = 0;
    for (uint32_t a = 0; a < COUNT; a++) {
        for (uint32_t b = a + 1; b < COUNT; b++) {
            pairs[2 * n] = a;
            pairs[2 * n++ + 1] = b;
        }
    }
    OK(deldrift_edges(t, edges, PAIRS, &n_edges));
    OK(deldrift_find_simplices(t, 2, pairs, PAIRS, found));
    for (size_t k = 0; k < PAIRS; k++) {
        // Both lists are in lexicographic order.
        const bool is_edge = n_found < n_edges && memcmp(edges + 2 * n_found, pairs + 2 * k, 8) == 0;
        CHECK(is_edge == (found[k] != DELDRIFT_NONE));
        n_found += is_edge;
    }
    CHECK(n_found == n_edges && n_edges < PAIRS);
    deldrift_destroy(t);
    free(positions);
}

static void every_vertex_has_a_cell(uint32_t dimension) {
    enum { COUNT = 40 };
    double *positions = random_positions(dimension, COUNT, 8);
    memcpy(positions + 7 * dimension, positions + 3 * dimension, dimension * sizeof *positions);
    deldrift_triangulation *t = create(dimension, positions, COUNT, NULL);
    uint32_t cells[COUNT + 1], coming;
    size_t count;
    OK(deldrift_remove_vertex(t, 5));
    OK(deldrift_stage_insertions(t, positions, 1, &coming));
    CHECK_BUFFER(uint32_t, (size_t)COUNT + 1, 1, deldrift_cell_of_each_vertex(t, buffer, capacity, &count));
    CHECK_STATUS(deldrift_cell_of_each_vertex(t, cells, COUNT + 1, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("count is NULL");
    OK(deldrift_cell_of_each_vertex(t, cells, COUNT + 1, &count));
    CHECK(count == COUNT + 1);
    const deldrift_cells_view view = cells_of(t);
    for (uint32_t v = 0; v <= COUNT; v++) {
        // Removed, hidden, and only to be inserted.
        if (v == 5 || v == 7 || v == coming) {
            CHECK(cells[v] == DELDRIFT_NONE);
        } else {
            CHECK(cells[v] < view.count);
            CHECK(has_corner(view.vertices + cells[v] * view.corners_per_cell, view.corners_per_cell, v));
        }
    }
    deldrift_destroy(t);
    free(positions);
}

static void hidden_vertices_are_listed(void) {
    static const double places[] = {0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 5, 5};
    deldrift_triangulation *t = create(2, places, 7, NULL);
    uint32_t vertices[4], representatives[4];
    size_t count = 0;
    CHECK_BUFFER(uint32_t, (size_t)3, 1, deldrift_hidden_vertices(t, buffer, NULL, capacity, &count));
    CHECK_BUFFER(uint32_t, (size_t)3, 1, deldrift_hidden_vertices(t, NULL, buffer, capacity, &count));
    OK(deldrift_hidden_vertices(t, vertices, representatives, 4, &count));
    static const uint32_t wanted[] = {3, 4, 5}, shown[] = {1, 2, 1};
    CHECK(count == 3 && memcmp(vertices, wanted, 12) == 0 && memcmp(representatives, shown, 12) == 0);
    CHECK_STATUS(deldrift_hidden_vertices(t, NULL, NULL, 4, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("vertices is NULL");
    CHECK_STATUS(deldrift_hidden_vertices(t, vertices, NULL, 4, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("count is NULL");
    // Another one represents those at the place of one that leaves; at the next commit all are apart.
    OK(deldrift_remove_vertex(t, 1));
    OK(deldrift_hidden_vertices(t, vertices, representatives, 4, &count));
    CHECK(count == 2 && vertices[0] == 4 && representatives[0] == 2 && vertices[1] == 5 && representatives[1] == 3);
    OK(deldrift_move_vertex(t, 4, (const double[]){7, 7}));
    OK(deldrift_hidden_vertices(t, NULL, NULL, 0, &count));
    CHECK(count == 2);
    OK(deldrift_move_vertex(t, 3, (const double[]){7, 8}));
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_hidden_vertices(t, vertices, representatives, 4, &count));
    CHECK(count == 0);
    deldrift_destroy(t);
}

static void all_is_none_without_cells(void) {
    static const double line[] = {0, 0, 1, 1, 2, 2, 1, 1};
    deldrift_triangulation *t = create(2, line, 4, NULL);
    uint32_t cells[4], vertices[4];
    size_t count;
    OK(deldrift_cell_of_each_vertex(t, cells, 4, &count));
    CHECK(count == 4);
    for (int k = 0; k < 4; k++) CHECK(cells[k] == DELDRIFT_NONE);
    OK(deldrift_find_simplices(t, 2, (const uint32_t[]){0, 1, 1, 2}, 2, cells + 1));
    CHECK(cells[1] == DELDRIFT_NONE && cells[2] == DELDRIFT_NONE);
    CHECK_STATUS(deldrift_find_simplices(t, 2, (const uint32_t[]){0, 4}, 1, cells), DELDRIFT_NO_SUCH_VERTEX);
    OK(deldrift_hidden_vertices(t, vertices, NULL, 4, &count));
    CHECK(count == 1 && vertices[0] == 3);
    double weights[6];
    OK(deldrift_barycentric(t, line, (const uint32_t[]){DELDRIFT_NONE, DELDRIFT_NONE}, 2, weights));
    for (int k = 0; k < 6; k++) CHECK(isnan(weights[k]));
    CHECK_STATUS(deldrift_barycentric(t, line, (const uint32_t[]){0}, 1, weights), DELDRIFT_NO_SUCH_FACET);
    uint8_t mask;
    OK(deldrift_mask_without_flat_cells(t, 1e-9, &mask, 1, &count));
    CHECK(count == 0);
    deldrift_destroy(t);
    t = create(3, NULL, 0, NULL);
    OK(deldrift_cell_of_each_vertex(t, NULL, 0, &count));
    CHECK(count == 0);
    OK(deldrift_find_simplices(t, 4, NULL, 0, NULL));
    OK(deldrift_barycentric(t, NULL, NULL, 0, NULL));
    deldrift_destroy(t);
}

// By hand, in cells of one triangle and one tetrahedron.
static void weights_by_hand(void) {
    static const double triangle[] = {0, 0, 4, 0, 0, 4};
    // Inside, outside, on an edge, at a corner, and in no cell.
    static const double places[] = {1, 2, 5, 1, 2, 2, 4, 0, 1, 1};
    static const double wanted[4][3] = {{0.25, 0.25, 0.5}, {-0.5, 1.25, 0.25}, {0, 0.5, 0.5}, {0, 1, 0}};
    static const uint32_t cells[] = {0, 0, 0, 0, DELDRIFT_NONE};
    deldrift_triangulation *t = create(2, triangle, 3, NULL);
    double weights[16];
    memset(weights, 0x77, sizeof weights);
    OK(deldrift_barycentric(t, places, cells, 5, weights));
    const uint32_t *row = cells_of(t).vertices;
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < 3; i++) CHECK(weights[3 * k + i] == wanted[k][row[i]]);
    }
    for (int i = 12; i < 15; i++) CHECK(isnan(weights[i]));
    CHECK(is_untouched(weights + 15, sizeof *weights));

    memset(weights, 0x77, sizeof weights);
    static const double nowhere[] = {1, 1, 1, NAN}, far[] = {2e57, 0};
    static const uint32_t strange[] = {0, 1};
    CHECK_STATUS(deldrift_barycentric(t, nowhere, cells, 2, weights), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("positions[1], coordinate 1, is NaN");
    CHECK_STATUS(deldrift_barycentric(t, far, cells, 1, weights), DELDRIFT_OUT_OF_RANGE);
    CHECK_MESSAGE("positions[0], coordinate 0, is 2e57");
    CHECK_STATUS(deldrift_barycentric(t, places, strange, 2, weights), DELDRIFT_NO_SUCH_FACET);
    CHECK_MESSAGE("cells[1] is 1");
    CHECK_STATUS(deldrift_barycentric(t, NULL, cells, 1, weights), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("positions is NULL");
    CHECK_STATUS(deldrift_barycentric(t, places, NULL, 1, weights), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("cells is NULL");
    CHECK_STATUS(deldrift_barycentric(t, places, cells, 1, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("weights is NULL");
    CHECK_STATUS(deldrift_barycentric(t, places, cells, SIZE_MAX, weights), DELDRIFT_SIZE_OVERFLOW);
    CHECK_MESSAGE("positions cannot have " MOST_ENTRIES " entries");
    OK(deldrift_barycentric(t, NULL, NULL, 0, NULL));
    CHECK(is_untouched(weights, sizeof weights));
    deldrift_destroy(t);

    t = create(3, TETRAHEDRON, 4, NULL);
    OK(deldrift_barycentric(t, (const double[]){1, 1, 1}, cells, 1, weights));
    for (int i = 0; i < 4; i++) CHECK(fabs(weights[i] - 0.25) < 1e-15);
    deldrift_destroy(t);
}

// In every cell, also far outside: signs are those of orientations with the place for a corner, and positions are the
// means of corners.
static void weights_are_those_of_orientations(uint32_t dimension) {
    enum { COUNT = 30 };
    double *positions = random_positions(dimension, COUNT, 21), weights[4], points[12];
    deldrift_triangulation *t = create(dimension, positions, COUNT, NULL);
    const deldrift_cells_view view = cells_of(t);
    const uint32_t corners = view.corners_per_cell;
    int n_of[3] = {0, 0, 0};
    for (uint32_t cell = 0; cell < view.count; cell++) {
        const uint32_t *row = view.vertices + cell * corners;
        for (size_t p = 0; p < COUNT; p++) {
            const double *place = positions + p * dimension;
            OK(deldrift_barycentric(t, place, &cell, 1, weights));
            double sum = 0, mean[3] = {0}, most = 1;
            for (uint32_t i = 0; i < corners; i++) {
                for (uint32_t k = 0; k < corners; k++) {
                    const double *from = k == i ? place : positions + row[k] * dimension;
                    memcpy(points + k * dimension, from, dimension * sizeof *points);
                }
                int32_t sign = 77;
                OK(deldrift_orientation(dimension, points, &sign));
                CHECK((weights[i] > 0) - (weights[i] < 0) == sign);
                n_of[sign + 1]++;
                sum += weights[i];
                most = fmax(most, fabs(weights[i]));
                for (uint32_t k = 0; k < dimension; k++) mean[k] += weights[i] * positions[row[i] * dimension + k];
            }
            CHECK(fabs(sum - 1) < 2e-8 * most);
            for (uint32_t k = 0; k < dimension; k++) CHECK(fabs(mean[k] - place[k]) < 2e-8 * most);
        }
    }
    for (int k = 0; k < 3; k++) CHECK(n_of[k] > 100);
    deldrift_destroy(t);
    free(positions);
}

// So many cells are flat, and they alone are left out, or none is.
static void check_mask_by_volume(const deldrift_triangulation *t, size_t n_wanted, bool leaves_out) {
    uint8_t mask[16];
    double volumes[16];
    size_t count, n_flat = 0;
    OK(deldrift_mask_without_flat_cells(t, 1e-9, mask, 16, &count));
    OK(deldrift_volumes(t, volumes, 16, &count));
    for (size_t c = 0; c < count; c++) {
        const bool is_flat = volumes[c] < 1e-9;
        n_flat += is_flat;
        CHECK(mask[c] == !(leaves_out && is_flat));
    }
    CHECK(n_flat == n_wanted && count > n_wanted);
}

// A side that is straight but for rounding: the cell on it is left out, and the boundary of the others goes past all
// three vertices.
static void flat_cells_are_left_out(void) {
    static const double places[] = {0, 0, 2, 0, 1, 1e-15, 1, 1};
    deldrift_triangulation *t = create(2, places, 4, NULL);
    const deldrift_cells_view view = cells_of(t);
    uint8_t mask[3];
    uint32_t facets[8];
    size_t count;
    CHECK_BUFFER(uint8_t, (size_t)3, 1, deldrift_mask_without_flat_cells(t, 1e-9, buffer, capacity, &count));
    // Its height is 1e-15, and its longest edge 2.
    const double above[] = {1e-9, 0.501e-15, 1e-3}, below[] = {0, 0.499e-15, 1e-20};
    for (int k = 0; k < 3; k++) {
        OK(deldrift_mask_without_flat_cells(t, above[k], mask, 3, &count));
        for (uint32_t c = 0; c < 3; c++) CHECK(mask[c] == has_corner(view.vertices + 3 * c, 3, 3));
        OK(deldrift_mask_without_flat_cells(t, below[k], mask, 3, &count));
        CHECK(count == 3 && mask[0] == 1 && mask[1] == 1 && mask[2] == 1);
    }
    OK(deldrift_mask_without_flat_cells(t, 1e-9, mask, 3, &count));
    OK(deldrift_mask_boundary(t, mask, 3, facets, NULL, NULL, 4, &count));
    CHECK(count == 4);
    bool has[4] = {false};
    for (size_t k = 0; k < count; k++) has[facets[2 * k]] = true;
    CHECK(has[0] && has[1] && has[2] && has[3]);
    OK(deldrift_mask_without_flat_cells(t, INFINITY, mask, 3, &count));
    CHECK(mask[0] == 0 && mask[1] == 0 && mask[2] == 0);

    memset(mask, 0x77, sizeof mask);
    count = 777;
    const double without_meaning[] = {-1, NAN, -INFINITY, -5e-324};
    for (int k = 0; k < 4; k++) {
        CHECK_STATUS(deldrift_mask_without_flat_cells(t, without_meaning[k], mask, 3, &count), DELDRIFT_INVALID_VALUE);
        CHECK_MESSAGE("tolerance[0] is ");
        CHECK_STATUS(deldrift_mask_without_flat_cells(t, without_meaning[k], NULL, 0, &count), DELDRIFT_INVALID_VALUE);
    }
    CHECK_STATUS(deldrift_mask_without_flat_cells(t, 1e-9, mask, 3, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("count is NULL");
    CHECK(is_untouched(mask, sizeof mask) && count == 777);
    deldrift_destroy(t);

    // A side in space, of which one vertex is a little off.
    static const double base[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 3, 3, 1e-15, 1, 1, 3};
    t = create(3, base, 5, NULL);
    check_mask_by_volume(t, 1, true);
    deldrift_destroy(t);

    // Two vertices that are nearly at one place make flat cells inside, which are kept.
    static const double needles[] = {0, 0, 2, 0, 2, 1e-12, 1, 3, 1, -3, 5, 0};
    t = create(2, needles, 6, NULL);
    check_mask_by_volume(t, 2, false);
    deldrift_destroy(t);
}

int main(void) {
    simplices_of_the_square();
    bad_simplices();
    hidden_vertices_are_listed();
    all_is_none_without_cells();
    weights_by_hand();
    flat_cells_are_left_out();
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        edges_are_those_of_the_list(dimension);
        every_vertex_has_a_cell(dimension);
        weights_are_those_of_orientations(dimension);
    }
    return 0;
}
