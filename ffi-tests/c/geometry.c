// Geometry of the cells: values, masks, facets and lists by vertex, and every buffer that is too small or wrong.
#include "buffers.h"

static void buffers_are_as_large_as_they_say(uint32_t d) {
    deldrift_triangulation *t = d == 2 ? create(2, SQUARE, SQUARE_COUNT, NULL)
                                       : create(3, TETRAHEDRON, TETRAHEDRON_COUNT, NULL);
    const size_t n = cell_count(t), hull = 4, n_edges = d == 2 ? 8 : 10;
    const uint8_t mask[4] = {1, 255, 2, 1};
    const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
    uint32_t offsets[6];
    CHECK_BUFFER(double, n, d, deldrift_circumcentres(t, buffer, NULL, capacity, &count));
    CHECK_BUFFER(double, n, 1, deldrift_circumcentres(t, NULL, buffer, capacity, &count));
    CHECK_BUFFER(double, n, 1, deldrift_volumes(t, buffer, capacity, &count));
    CHECK_BUFFER(uint8_t, n, 1, deldrift_mask_by_circumradius(t, 4, buffer, capacity, &count));
    CHECK_BUFFER(uint32_t, hull, d, deldrift_mask_boundary(t, mask, n, buffer, NULL, NULL, capacity, &count));
    CHECK_BUFFER(uint32_t, hull, 1, deldrift_mask_boundary(t, mask, n, NULL, buffer, NULL, capacity, &count));
    CHECK_BUFFER(uint8_t, hull, 1, deldrift_mask_boundary(t, mask, n, NULL, NULL, buffer, capacity, &count));
    CHECK_BUFFER(uint32_t, hull, d, deldrift_hull_facets(t, buffer, NULL, NULL, capacity, &count));
    CHECK_BUFFER(uint32_t, hull, 1, deldrift_hull_facets(t, NULL, buffer, NULL, capacity, &count));
    CHECK_BUFFER(uint8_t, hull, 1, deldrift_hull_facets(t, NULL, NULL, buffer, capacity, &count));
    CHECK_BUFFER(uint32_t, n_edges, 2, deldrift_edges(t, buffer, capacity, &count));
    CHECK_BUFFER(uint32_t, 2 * n_edges, 1, deldrift_vertex_neighbours(t, NULL, 0, buffer, capacity, &count));
    CHECK_BUFFER(uint32_t, n * (d + 1), 1, deldrift_vertex_cells(t, offsets, 6, buffer, capacity, &count));
    CHECK_BUFFER(uint8_t, n, d + 1, deldrift_mirror_indices(t, buffer, capacity, &count));
    CHECK_BUFFER(double, (size_t)5, 1, deldrift_voronoi_volumes(t, low, high, buffer, capacity, &count));
    CHECK_BUFFER(double, n_edges, 1, deldrift_voronoi_facets(t, NULL, NULL, buffer, capacity, &count));
    CHECK_BUFFER(double, (size_t)5, d,
                 deldrift_voronoi_cells(t, low, high, NULL, 0, NULL, NULL, buffer, capacity, &count));
    CHECK_BUFFER(double, (size_t)5, d,
                 deldrift_voronoi_cells_within(t, low, high, (double[]){1, 1, 1, 9}, 1, NULL, 0, NULL, NULL, buffer,
                                               capacity, &count));
    CHECK_BUFFER(double, n_edges, 2 * d,
                 deldrift_voronoi_derivatives(t, low, high, NULL, 0, NULL, NULL, buffer, capacity, &count));
    const uint32_t inner[2] = {4, 4};
    CHECK_BUFFER(uint8_t, 5u, 1, deldrift_voronoi_changed(t, inner, 2, buffer, capacity, &count));
    CHECK_BUFFER(uint32_t, n, 1, deldrift_cells_around(t, inner, 2, buffer, capacity, &count));
    if (d == 2) CHECK_BUFFER(uint32_t, 4u, 1, deldrift_ordered_star(t, 4, buffer, capacity, &count));
    deldrift_destroy(t);
}

static void values_are_those_of_the_cells(void) {
    static const double right[] = {0, 0, 4, 0, 0, 2};
    deldrift_triangulation *t = create(2, right, 3, NULL);
    double centre[2], squared, volume;
    uint8_t mask = 77;
    size_t count;
    OK(deldrift_circumcentres(t, centre, &squared, 1, &count));
    OK(deldrift_volumes(t, &volume, 1, &count));
    CHECK(centre[0] == 2 && centre[1] == 1 && squared == 5 && volume == 4);
    OK(deldrift_mask_by_circumradius(t, 5, &mask, 1, &count));
    CHECK(mask == 1);
    OK(deldrift_mask_by_circumradius(t, nextafter(5, 0), &mask, 1, &count));
    CHECK(mask == 0);
    OK(deldrift_mask_by_circumradius(t, INFINITY, &mask, 1, &count));
    CHECK(mask == 1);
    const double without_meaning[] = {-1, NAN, -INFINITY};
    for (int k = 0; k < 3; k++) {
        CHECK_STATUS(deldrift_mask_by_circumradius(t, without_meaning[k], &mask, 1, &count), DELDRIFT_INVALID_VALUE);
        CHECK_MESSAGE("squared_radius[0] is");
        CHECK(mask == 1);
    }
    deldrift_destroy(t);

    t = create(3, TETRAHEDRON, 4, NULL);
    double centre3[3];
    OK(deldrift_circumcentres(t, centre3, &squared, 1, &count));
    OK(deldrift_volumes(t, &volume, 1, &count));
    CHECK(fabs(volume - 64.0 / 6) < 1e-14 && squared == 12 && centre3[0] == 2 && centre3[1] == 2 && centre3[2] == 2);
    deldrift_destroy(t);
}

static void boundaries_go_around(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    const deldrift_cells_view view = cells_of(t);
    // One cell alone: its own edges, each with the cell on its left.
    for (uint32_t alone = 0; alone < view.count; alone++) {
        uint8_t mask[4] = {0}, corners[3];
        uint32_t facets[6], cells[3];
        size_t count;
        mask[alone] = 3;
        OK(deldrift_mask_boundary(t, mask, 4, facets, cells, corners, 3, &count));
        CHECK(count == 3);
        const uint32_t *row = view.vertices + 3 * alone;
        for (uint32_t i = 0; i < 3; i++) {
            CHECK(cells[i] == alone && corners[i] == i);
            CHECK(facets[2 * i] == row[(i + 1) % 3] && facets[2 * i + 1] == row[(i + 2) % 3]);
        }
    }
    const uint8_t none[5] = {0};
    size_t count = 777;
    OK(deldrift_mask_boundary(t, none, 4, NULL, NULL, NULL, 0, &count));
    CHECK(count == 0);
    CHECK_STATUS(deldrift_mask_boundary(t, none, 3, NULL, NULL, NULL, 0, &count), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("mask_count is 3, but must be 4");
    CHECK_STATUS(deldrift_mask_boundary(t, none, SIZE_MAX, NULL, NULL, NULL, 0, &count), DELDRIFT_WRONG_COUNT);
    CHECK_STATUS(deldrift_mask_boundary(t, NULL, 4, NULL, NULL, NULL, 0, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("mask is NULL");
    deldrift_destroy(t);

    // In 3D, all facets of the hull see the origin behind them.
    static const double octahedron[] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    t = create(3, octahedron, 6, NULL);
    uint32_t facets[24];
    OK(deldrift_hull_facets(t, facets, NULL, NULL, 8, &count));
    CHECK(count == 8);
    for (int k = 0; k < 8; k++) {
        const double *a = octahedron + 3 * facets[3 * k], *b = octahedron + 3 * facets[3 * k + 1];
        const double *c = octahedron + 3 * facets[3 * k + 2];
        double det = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                     a[2] * (b[0] * c[1] - b[1] * c[0]);
        CHECK(det == 1);
    }
    deldrift_destroy(t);
}

static void lists_are_by_vertex(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    uint32_t edges[16], offsets[6], neighbours[16], cells[12];
    size_t count;
    OK(deldrift_edges(t, edges, 8, &count));
    static const uint32_t wanted[16] = {0, 1, 0, 3, 0, 4, 1, 2, 1, 4, 2, 3, 2, 4, 3, 4};
    CHECK(memcmp(edges, wanted, sizeof edges) == 0);
    OK(deldrift_vertex_neighbours(t, offsets, 6, neighbours, 16, &count));
    static const uint32_t starts[6] = {0, 3, 6, 9, 12, 16};
    static const uint32_t others[16] = {1, 3, 4, 0, 2, 4, 1, 3, 4, 0, 2, 4, 0, 1, 2, 3};
    CHECK(memcmp(offsets, starts, sizeof offsets) == 0 && memcmp(neighbours, others, sizeof neighbours) == 0);
    memset(offsets, 0x77, sizeof offsets);
    OK(deldrift_vertex_neighbours(t, offsets, 6, NULL, 0, &count));
    CHECK(memcmp(offsets, starts, sizeof offsets) == 0 && count == 16);
    OK(deldrift_vertex_cells(t, offsets, 6, cells, 12, &count));
    const deldrift_cells_view view = cells_of(t);
    for (uint32_t v = 0; v < 5; v++) {
        CHECK(offsets[v + 1] - offsets[v] == (v == 4 ? 4 : 2));
        for (uint32_t k = offsets[v]; k < offsets[v + 1]; k++) CHECK(has_corner(view.vertices + 3 * cells[k], 3, v));
    }
    CHECK_STATUS(deldrift_vertex_neighbours(t, offsets, 5, neighbours, 16, &count), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("offset_count is 5, but must be 6");
    CHECK_STATUS(deldrift_vertex_cells(t, offsets, 7, NULL, 0, &count), DELDRIFT_WRONG_COUNT);

    uint8_t mirrors[12];
    uint32_t mirror = 77;
    OK(deldrift_mirror_indices(t, mirrors, 4, &count));
    for (uint32_t cell = 0; cell < 4; cell++) {
        for (uint32_t i = 0; i < 3; i++) {
            const uint32_t across = view.neighbours[3 * cell + i];
            OK(deldrift_mirror_index(t, cell, i, &mirror));
            if (across == DELDRIFT_NONE) {
                CHECK(mirror == DELDRIFT_NONE && mirrors[3 * cell + i] == 255);
            } else {
                CHECK(mirror == mirrors[3 * cell + i] && view.neighbours[3 * across + mirror] == cell);
            }
        }
    }
    CHECK_STATUS(deldrift_mirror_index(t, 4, 0, &mirror), DELDRIFT_NO_SUCH_FACET);
    CHECK_STATUS(deldrift_mirror_index(t, 0, 3, &mirror), DELDRIFT_NO_SUCH_FACET);
    deldrift_destroy(t);
}

static void stars_go_around(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    const deldrift_cells_view view = cells_of(t);
    uint32_t star[4];
    size_t count;
    OK(deldrift_ordered_star(t, 4, star, 4, &count));
    CHECK(count == 4 && star[0] == 0);
    OK(deldrift_ordered_star(t, 0, star, 4, &count));
    // From the edge 0 1 to the edge 3 0.
    CHECK(count == 2 && has_corner(view.vertices + 3 * star[0], 3, 1) && has_corner(view.vertices + 3 * star[1], 3, 3));
    CHECK_STATUS(deldrift_ordered_star(t, 5, star, 4, &count), DELDRIFT_NO_SUCH_VERTEX);
    OK(deldrift_remove_vertex(t, 4));
    CHECK_STATUS(deldrift_ordered_star(t, 4, star, 4, &count), DELDRIFT_REMOVED_VERTEX);
    deldrift_destroy(t);
    t = create(3, TETRAHEDRON, TETRAHEDRON_COUNT, NULL);
    CHECK_STATUS(deldrift_ordered_star(t, 4, star, 4, &count), DELDRIFT_INVALID_DIMENSION);
    CHECK_MESSAGE("dimension of t is 3");
    deldrift_destroy(t);
}

// A vertex moves within its tolerance: what is kept for the cells around it is made again, and nothing else.
static void arrays_are_kept(uint32_t d) {
    static double nine[] = {0, 0, 4, 0, 5, 5, 0, 4, 1, 2, 3, 1, 6, 2, 2, 5, 3, 3};
    deldrift_triangulation *t = d == 2 ? create(2, nine, 9, NULL) : create(3, TETRAHEDRON, TETRAHEDRON_COUNT, NULL);
    const uint32_t moved[3] = {4, 4, 4};
    const size_t n = cell_count(t);
    enum { MOST = 32 };
    double centres[3 * MOST], squares[MOST], volumes[MOST], position[3];
    uint8_t mask[MOST];
    uint32_t around[MOST];
    size_t count;
    CHECK(n <= MOST);
    deldrift_changes changes;
    OK(deldrift_take_changes(t, &changes));
    OK(deldrift_position(t, 4, position));
    position[0] += 1.0 / 1024;
    OK(deldrift_move_vertex(t, 4, position));
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_take_changes(t, &changes));
    CHECK(changes.created_count == 0 && changes.renumbered_count == 0);
    OK(deldrift_cells_around(t, moved, 3, around, MOST, &count));
    const deldrift_cells_view view = cells_of(t);
    for (uint32_t cell = 0, k = 0; cell < n; cell++) {
        bool is_around = has_corner(view.vertices + cell * (d + 1), d + 1, 4);
        CHECK(is_around == (k < count && around[k] == cell));
        k += is_around;
    }
    CHECK(d == 3 || (count > 2 && count < n));
    memset(centres, 0x77, sizeof centres);
    memset(squares, 0x77, sizeof squares);
    memset(volumes, 0x77, sizeof volumes);
    memset(mask, 0x77, sizeof mask);

    // Nothing is written by a call that fails.
    const uint32_t wrong[3] = {around[0], around[0], (uint32_t)n};
    CHECK_STATUS(deldrift_update_circumcentres(t, wrong, 3, centres, squares, n), DELDRIFT_NO_SUCH_FACET);
    CHECK_MESSAGE("cells[2] is");
    CHECK_STATUS(deldrift_update_volumes(t, wrong, 3, volumes, n), DELDRIFT_NO_SUCH_FACET);
    CHECK_STATUS(deldrift_update_mask_by_circumradius(t, wrong, 3, 9, mask, n), DELDRIFT_NO_SUCH_FACET);
    CHECK_STATUS(deldrift_update_circumcentres(t, around, count, centres, squares, n - 1), DELDRIFT_BUFFER_TOO_SMALL);
    CHECK_MESSAGE("capacity is");
    CHECK_STATUS(deldrift_update_volumes(t, around, count, volumes, n - 1), DELDRIFT_BUFFER_TOO_SMALL);
    CHECK_STATUS(deldrift_update_mask_by_circumradius(t, around, count, 9, mask, n - 1), DELDRIFT_BUFFER_TOO_SMALL);
    CHECK_STATUS(deldrift_update_mask_by_circumradius(t, around, count, -9, mask, n), DELDRIFT_INVALID_VALUE);
    CHECK_STATUS(deldrift_update_circumcentres(t, around, count, NULL, NULL, n), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("centres is NULL");
    CHECK_STATUS(deldrift_update_circumcentres(t, NULL, 0, NULL, NULL, 0), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_update_volumes(t, around, count, NULL, n), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_update_mask_by_circumradius(t, around, count, 9, NULL, n), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_update_volumes(t, NULL, 1, volumes, n), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("cells is NULL");
    const uint32_t strange[2] = {4, 99};
    CHECK_STATUS(deldrift_cells_around(t, strange, 2, around, MOST, &count), DELDRIFT_NO_SUCH_VERTEX);
    CHECK_MESSAGE("vertices[1] is 99");
    CHECK_STATUS(deldrift_cells_around(t, NULL, 2, around, MOST, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK(is_untouched(centres, sizeof centres) && is_untouched(squares, sizeof squares));
    CHECK(is_untouched(volumes, sizeof volumes) && is_untouched(mask, sizeof mask));

    // What is listed becomes what a pass over all cells gives, and the rest stays.
    double all_centres[3 * MOST], all_squares[MOST], all_volumes[MOST];
    uint8_t all_mask[MOST];
    size_t n_listed = count;
    OK(deldrift_circumcentres(t, all_centres, all_squares, MOST, &count));
    OK(deldrift_volumes(t, all_volumes, MOST, &count));
    OK(deldrift_mask_by_circumradius(t, all_squares[around[0]], all_mask, MOST, &count));
    OK(deldrift_update_circumcentres(t, around, n_listed, centres, NULL, n));
    OK(deldrift_update_circumcentres(t, around, n_listed, NULL, squares, MOST));
    OK(deldrift_update_volumes(t, around, n_listed, volumes, n));
    OK(deldrift_update_mask_by_circumradius(t, around, n_listed, all_squares[around[0]], mask, n));
    for (uint32_t cell = 0, k = 0; cell < MOST; cell++) {
        if (k < n_listed && around[k] == cell) {
            k++;
            for (uint32_t i = 0; i < d; i++) CHECK(centres[cell * d + i] == all_centres[cell * d + i]);
            CHECK(squares[cell] == all_squares[cell] && volumes[cell] == all_volumes[cell]);
            CHECK(mask[cell] == all_mask[cell]);
        } else {
            CHECK(is_untouched(centres + cell * d, d * sizeof *centres));
            CHECK(is_untouched(squares + cell, sizeof *squares) && is_untouched(volumes + cell, sizeof *volumes));
            CHECK(mask[cell] == 0x77);
        }
    }
    OK(deldrift_update_volumes(t, NULL, 0, volumes, n));
    deldrift_destroy(t);
}

// Nothing is an answer, too.
static void without_cells_all_is_empty(void) {
    static const double line[] = {0, 0, 1, 1, 2, 2};
    for (size_t n = 0; n <= 3; n += 3) {
        deldrift_triangulation *t = create(2, line, n, NULL);
        uint32_t offsets[4] = {7, 7, 7, 7}, id;
        double number;
        uint8_t byte;
        size_t count = 777;
        OK(deldrift_circumcentres(t, &number, &number, 0, &count));
        OK(deldrift_volumes(t, &number, 0, &count));
        OK(deldrift_mask_by_circumradius(t, 1, &byte, 0, &count));
        OK(deldrift_mask_boundary(t, NULL, 0, &id, &id, &byte, 0, &count));
        OK(deldrift_hull_facets(t, &id, &id, &byte, 0, &count));
        OK(deldrift_edges(t, &id, 0, &count));
        OK(deldrift_vertex_cells(t, offsets, n + 1, &id, 0, &count));
        OK(deldrift_vertex_neighbours(t, offsets, n + 1, NULL, 0, &count));
        OK(deldrift_mirror_indices(t, &byte, 0, &count));
        OK(deldrift_voronoi_facets(t, NULL, NULL, &number, 0, &count));
        CHECK(count == 0);
        static const uint32_t first = 0;
        OK(deldrift_cells_around(t, n > 0 ? &first : NULL, n > 0, &id, 0, &count));
        OK(deldrift_update_circumcentres(t, NULL, 0, NULL, NULL, 0));
        OK(deldrift_update_volumes(t, NULL, 0, NULL, 0));
        OK(deldrift_update_mask_by_circumradius(t, NULL, 0, 1, NULL, 0));
        CHECK_STATUS(deldrift_update_volumes(t, &first, 1, &number, 1), DELDRIFT_NO_SUCH_FACET);
        CHECK(count == 0 && offsets[0] == 0 && offsets[n] == 0);
        if (n > 0) OK(deldrift_ordered_star(t, 1, &id, 0, &count));
        CHECK(count == 0);
        deldrift_destroy(t);
    }
}

static void voronoi_cells_of_few_vertices(void) {
    static const double two[] = {0, 0, 1, 0}, low[] = {-1, -2}, high[] = {7, 3};
    deldrift_triangulation *t = create(2, two, 2, NULL);
    double volumes[2], facet = 77;
    size_t count;
    OK(deldrift_voronoi_volumes(t, low, high, volumes, 2, &count));
    CHECK(count == 2 && fabs(volumes[0] - 7.5) < 1e-12 && fabs(volumes[1] - 32.5) < 1e-12);
    OK(deldrift_voronoi_volumes(t, NULL, NULL, volumes, 2, &count));
    CHECK(isinf(volumes[0]) && isinf(volumes[1]));
    // There is no edge to have a facet.
    OK(deldrift_voronoi_facets(t, low, high, &facet, 1, &count));
    CHECK(count == 0 && facet == 77);
    deldrift_destroy(t);
}

typedef struct reading {
    deldrift_triangulation *t;
    size_t calls;
    bool stops;
} reading;

// What it is called from reads the triangulation: so may it, but not change it.
static bool reads_and_tries_to_change(void *user_data) {
    reading *r = user_data;
    if (r->t == NULL) return false;
    r->calls++;
    size_t count;
    const double place[] = {0.5, 0.25};
    OK(deldrift_cell_count(r->t, &count));
    CHECK_STATUS(deldrift_move_vertex(r->t, 0, place), DELDRIFT_BUSY);
    CHECK_STATUS(deldrift_commit_timestamp(r->t, NULL), DELDRIFT_BUSY);
    deldrift_destroy(r->t);
    return r->stops;
}

static void voronoi_cells_can_be_cancelled(void) {
    enum { N = 30000 };
    double *places = malloc(2 * N * sizeof *places), *volumes = malloc(N * sizeof *volumes);
    CHECK(places != NULL && volumes != NULL);
    for (size_t k = 0; k < N; k++) {
        places[2 * k] = (double)(k * 7919 % 10007);
        places[2 * k + 1] = (double)(k * 104729 % 10009);
    }
    reading r = {NULL, 0, false};
    deldrift_options options;
    deldrift_options_init(&options);
    options.cancel = reads_and_tries_to_change;
    options.user_data = &r;
    deldrift_triangulation *t = create(2, places, N, &options);
    const double low[] = {0, 0}, high[] = {10000, 10000};
    size_t count;
    r.t = t;
    OK(deldrift_voronoi_volumes(t, low, high, volumes, N, &count));
    CHECK(r.calls > 0);
    r.stops = true;
    volumes[0] = 77;
    CHECK_STATUS(deldrift_voronoi_volumes(t, low, high, volumes, N, &count), DELDRIFT_CANCELLED);
    CHECK_STATUS(deldrift_voronoi_cells(t, low, high, NULL, 0, volumes, NULL, NULL, N, &count), DELDRIFT_CANCELLED);
    CHECK_STATUS(deldrift_voronoi_cells(t, NULL, NULL, NULL, 0, volumes, NULL, NULL, N, &count), DELDRIFT_CANCELLED);
    size_t n_edges;
    CHECK_STATUS(deldrift_voronoi_cells_and_facets(t, NULL, NULL, NULL, 0, NULL, 0, volumes, NULL, NULL, N, &count, NULL, NULL,
                                                   NULL, 0, &n_edges),
                 DELDRIFT_CANCELLED);
    CHECK_STATUS(deldrift_voronoi_facets(t, NULL, NULL, NULL, 0, &count), DELDRIFT_OK);
    CHECK(volumes[0] == 77);
    OK(deldrift_move_vertex(t, 0, low));
    deldrift_destroy(t);
    free(places);
    free(volumes);
}

// Of a square with a vertex in its middle, in a box; then of that vertex alone.
static void voronoi_cells_have_centroids(void) {
    static const double places[] = {0, 0, 2, 0, 0, 2, 2, 2, 1, 1}, low[] = {-1, -1}, high[] = {3, 3};
    deldrift_triangulation *t = create(2, places, 5, NULL);
    double volumes[5], areas[5], centroids[10], measures[8], middles[16], derivatives[32], sum = 0;
    size_t count;
    OK(deldrift_voronoi_cells(t, low, high, NULL, 0, volumes, areas, centroids, 5, &count));
    CHECK(count == 5 && volumes[4] == 2 && fabs(areas[4] - 4 * sqrt(2)) < 1e-12);
    CHECK(centroids[8] == 1 && centroids[9] == 1);
    for (int v = 0; v < 5; v++) sum += volumes[v];
    CHECK(fabs(sum - 16) < 1e-12);
    OK(deldrift_voronoi_derivatives(t, low, high, NULL, 0, measures, middles, derivatives, 8, &count));
    // The last edge is that from vertex 3, at (2, 2), to the middle: the facet is from (2, 1) to (1, 2).
    CHECK(count == 8 && fabs(measures[7] - sqrt(2)) < 1e-12);
    CHECK(fabs(middles[14] - 1.5) < 1e-12 && fabs(middles[15] - 1.5) < 1e-12);
    for (int k = 0; k < 2; k++) CHECK(fabs(derivatives[28 + k] + 0.5) < 1e-12 && fabs(derivatives[30 + k] - 0.5) < 1e-12);
    // What has no byte is left as it is.
    static const uint8_t mask[] = {0, 0, 0, 0, 1};
    for (int v = 0; v < 5; v++) volumes[v] = areas[v] = 77;
    for (int e = 0; e < 8; e++) measures[e] = 77;
    OK(deldrift_voronoi_cells(t, low, high, mask, 5, volumes, NULL, NULL, 5, &count));
    CHECK(volumes[4] == 2 && volumes[0] == 77 && areas[4] == 77);
    OK(deldrift_voronoi_derivatives(t, low, high, mask, 5, measures, NULL, NULL, 8, &count));
    for (int e = 0, n = 0; e < 8; e++) {
        n += measures[e] != 77;
        CHECK(e < 7 || n == 4);
    }
    CHECK_STATUS(deldrift_voronoi_cells(t, low, high, mask, 4, volumes, NULL, NULL, 5, &count), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("mask_count");
    CHECK_STATUS(deldrift_voronoi_cells(t, low, NULL, NULL, 0, volumes, NULL, NULL, 5, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_voronoi_cells(t, NULL, high, NULL, 0, volumes, NULL, NULL, 5, &count), DELDRIFT_NULL_ARGUMENT);
    deldrift_destroy(t);
}

// Of a square with a vertex in its middle, without a box: that vertex has a cell and four facets that end, and nothing else has.
static void voronoi_cells_without_a_box(void) {
    static const double places[] = {5, 0, 7, 0, 5, 2, 7, 2, 6, 1}, far[] = {1, 1, 100};
    deldrift_triangulation *t = create(2, places, 5, NULL);
    double volumes[5], areas[5], centroids[10], measures[8], middles[16], derivatives[32];
    size_t count, n_edges;
    OK(deldrift_voronoi_cells(t, NULL, NULL, NULL, 0, volumes, areas, centroids, 5, &count));
    CHECK(count == 5 && volumes[4] == 2 && fabs(areas[4] - 4 * sqrt(2)) < 1e-12);
    CHECK(centroids[8] == 6 && centroids[9] == 1);
    for (int v = 0; v < 4; v++) CHECK(isinf(volumes[v]) && isinf(areas[v]) && isnan(centroids[2 * v]));
    OK(deldrift_voronoi_derivatives(t, NULL, NULL, NULL, 0, measures, middles, derivatives, 8, &n_edges));
    uint32_t edges[16];
    OK(deldrift_edges(t, edges, 8, &count));
    for (size_t e = 0; e < 8; e++) {
        const bool ends = edges[2 * e + 1] == 4;
        const double *x = &places[2 * edges[2 * e]];
        CHECK(ends ? fabs(measures[e] - sqrt(2)) < 1e-12 : isinf(measures[e]) && isnan(middles[2 * e]));
        for (int k = 0; k < 2 && ends; k++) CHECK(fabs(middles[2 * e + k] - 0.5 * (x[k] + places[8 + k])) < 1e-12);
        CHECK(ends || isnan(derivatives[4 * e]));
    }
    // One call has all of them, to the last bit, and any of them.
    double all[5], other_areas[5], rows[10], lengths[8], other_middles[16], by[32];
    OK(deldrift_voronoi_cells_and_facets(t, NULL, NULL, NULL, 0, NULL, 0, all, other_areas, rows, 5, &count, lengths,
                                         other_middles, by, 8, &n_edges));
    CHECK(count == 5 && n_edges == 8);
    CHECK(!memcmp(all, volumes, sizeof all) && !memcmp(other_areas, areas, sizeof areas));
    CHECK(!memcmp(&rows[8], &centroids[8], 2 * sizeof *rows) && !memcmp(lengths, measures, sizeof measures));
    for (int k = 0; k < 16; k++) CHECK(middles[k] == other_middles[k] || isnan(middles[k]));
    for (int k = 0; k < 32; k++) CHECK(derivatives[k] == by[k] || isnan(derivatives[k]));
    count = n_edges = 77;
    OK(deldrift_voronoi_cells_and_facets(t, NULL, NULL, NULL, 0, NULL, 0, NULL, NULL, NULL, 0, &count, NULL, NULL, NULL, 0,
                                         &n_edges));
    CHECK(count == 5 && n_edges == 8);
    count = n_edges = lengths[0] = 77;
    CHECK_STATUS(deldrift_voronoi_cells_and_facets(t, NULL, NULL, NULL, 0, NULL, 0, all, NULL, NULL, 4, &count, lengths, NULL,
                                                   NULL, 7, &n_edges),
                 DELDRIFT_BUFFER_TOO_SMALL);
    CHECK(count == 5 && n_edges == 8 && lengths[0] == 77);
    CHECK_STATUS(deldrift_voronoi_cells_and_facets(t, NULL, NULL, NULL, 0, NULL, 0, all, NULL, NULL, 5, &count, lengths, NULL,
                                                   NULL, 7, &n_edges),
                 DELDRIFT_BUFFER_TOO_SMALL);
    CHECK_MESSAGE("edge_capacity is 7");
    count = n_edges = 77;
    CHECK_STATUS(deldrift_voronoi_cells_and_facets(t, NULL, NULL, NULL, 0, NULL, 0, all, NULL, NULL, 4, &count, lengths, NULL,
                                                   NULL, 8, &n_edges),
                 DELDRIFT_BUFFER_TOO_SMALL);
    CHECK(count == 5 && n_edges == 8);
    // Half-spaces alone need not bound anything.
    CHECK_STATUS(deldrift_voronoi_cells_within(t, NULL, NULL, far, 1, NULL, 0, volumes, NULL, NULL, 5, &count),
                 DELDRIFT_NULL_ARGUMENT);
    deldrift_destroy(t);
}

// Of a square with a vertex in its middle, in a box whose corner is cut off, and in a square that is turned.
static void voronoi_cells_in_half_spaces(void) {
    static const double places[] = {0, 0, 2, 0, 0, 2, 2, 2, 1, 1}, low[] = {-1, -1}, high[] = {3, 3};
    deldrift_triangulation *t = create(2, places, 5, NULL);
    double volumes[5], areas[5], centroids[10];
    size_t count;
    OK(deldrift_voronoi_cells_within(t, low, high, NULL, 0, NULL, 0, volumes, areas, centroids, 5, &count));
    CHECK(count == 5 && volumes[4] == 2 && volumes[3] == 3.5);
    // x + y is at most 2: through the middle, the two vertices beside it and two corners of the box.
    static const double diagonal[] = {0.5, 0.5, 1};
    OK(deldrift_voronoi_cells_within(t, low, high, diagonal, 1, NULL, 0, volumes, areas, centroids, 5, &count));
    static const double wanted[] = {3.5, 1.75, 1.75, 0, 1};
    for (int v = 0; v < 5; v++) CHECK(fabs(volumes[v] - wanted[v]) < 1e-14);
    CHECK(areas[3] == 0 && isnan(centroids[6]) && fabs(areas[4] - 3 * sqrt(2)) < 1e-14);
    CHECK(fabs(centroids[8] - 0.75) < 1e-14 && fabs(centroids[9] - 0.75) < 1e-14);
    double measures[8], middles[16], derivatives[32];
    OK(deldrift_voronoi_derivatives_within(t, low, high, diagonal, 1, NULL, 0, measures, middles, derivatives, 8, &count));
    // From vertex 0 to the middle a side of the diamond; from vertex 1 half of one; from vertex 3 nothing.
    CHECK(count == 8 && fabs(measures[2] - sqrt(2)) < 1e-14 && measures[7] == 0 && isnan(middles[14]));
    CHECK(fabs(measures[4] - sqrt(2) / 2) < 1e-14 && fabs(middles[8] - 1.25) < 1e-14 && fabs(middles[9] - 0.25) < 1e-14);
    // Its length over that of the edge, times the way from the middle of what is left to (1, 1).
    CHECK(fabs(derivatives[16] + 0.125) < 1e-14 && fabs(derivatives[17] - 0.375) < 1e-14);
    // The square with its corners in the middles of the box's sides, of which the middle's cell is a quarter.
    static const double turned[] = {1, 1, 4, -1, 1, 2, 1, -1, 2, -3, -3, 0};
    OK(deldrift_voronoi_cells_within(t, low, high, turned, 4, NULL, 0, volumes, NULL, NULL, 5, &count));
    for (int v = 0; v < 5; v++) CHECK(fabs(volumes[v] - (v == 4 ? 2 : 1.5)) < 1e-14);
    static const double bad[] = {1, 1, 4, 0, 0, 2, 1, NAN, 2};
    CHECK_STATUS(deldrift_voronoi_cells_within(t, low, high, bad, 2, NULL, 0, volumes, NULL, NULL, 5, &count),
                 DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("half_spaces[1] is 0, but must be a normal that is not zero");
    CHECK_STATUS(deldrift_voronoi_cells_within(t, low, high, bad + 3, 2, NULL, 0, volumes, NULL, NULL, 5, &count),
                 DELDRIFT_INVALID_VALUE);
    CHECK_STATUS(deldrift_voronoi_cells_within(t, low, high, bad + 6, 1, NULL, 0, volumes, NULL, NULL, 5, &count),
                 DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("half_spaces[0], coordinate 1, is NaN");
    CHECK_STATUS(deldrift_voronoi_cells_within(t, low, high, NULL, 1, NULL, 0, volumes, NULL, NULL, 5, &count),
                 DELDRIFT_NULL_ARGUMENT);
    CHECK(fabs(volumes[4] - 2) < 1e-14);
    deldrift_destroy(t);
}

// A lattice, of which the vertex in the middle moves: its own cell changes and those of its neighbours.
static void voronoi_cells_that_have_changed(void) {
    enum { SIDE = 9, N = SIDE * SIDE };
    static double places[2 * N], kept[N], all[N], low[] = {-1, -1}, high[] = {SIDE, SIDE};
    static uint8_t mask[N];
    for (int k = 0; k < N; k++) places[2 * k] = k % SIDE, places[2 * k + 1] = (int)(k / SIDE);
    deldrift_triangulation *t = create(2, places, N, NULL);
    deldrift_changes changes;
    const uint32_t middle = N / 2;
    size_t count, n_marked = 0;
    OK(deldrift_voronoi_changed(t, NULL, 0, mask, N, &count));
    for (int k = 0; k < N; k++) CHECK(mask[k] == 1);
    OK(deldrift_take_changes(t, &changes));
    OK(deldrift_voronoi_cells(t, low, high, NULL, 0, kept, NULL, NULL, N, &count));
    const double goal[] = {4.125, 4.0625};
    OK(deldrift_move_vertices(t, &middle, goal, 1));
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_take_changes(t, &changes));
    OK(deldrift_voronoi_changed(t, &middle, 1, mask, N, &count));
    CHECK(count == N && mask[middle] == 1 && mask[0] == 0);
    for (int k = 0; k < N; k++) n_marked += mask[k];
    CHECK(n_marked >= 5 && n_marked <= 20);
    OK(deldrift_voronoi_cells(t, low, high, mask, N, kept, NULL, NULL, N, &count));
    OK(deldrift_voronoi_cells(t, low, high, NULL, 0, all, NULL, NULL, N, &count));
    CHECK(memcmp(kept, all, sizeof all) == 0);
    const uint32_t strange[] = {middle, N};
    CHECK_STATUS(deldrift_voronoi_changed(t, strange, 2, mask, N, &count), DELDRIFT_NO_SUCH_VERTEX);
    CHECK_MESSAGE("vertices");
    deldrift_destroy(t);
}

static void voronoi_cells_fill_the_box(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    static const double low[] = {-1, -2}, high[] = {7, 3}, nowhere[] = {NAN, 0}, far[] = {1e58, 9};
    double volumes[5], facets[8], sum = 0;
    size_t count;
    OK(deldrift_voronoi_volumes(t, low, high, volumes, 5, &count));
    for (int v = 0; v < 5; v++) {
        CHECK(volumes[v] > 0);
        sum += volumes[v];
    }
    CHECK(fabs(sum - 40) < 1e-12);
    OK(deldrift_voronoi_volumes(t, NULL, NULL, volumes, 5, &count));
    CHECK(isinf(volumes[0]) && isinf(volumes[3]) && isfinite(volumes[4]));
    OK(deldrift_voronoi_facets(t, NULL, NULL, facets, 8, &count));
    // The edges of the hull, and those to the vertex inside.
    CHECK(isinf(facets[0]) && isinf(facets[1]) && isfinite(facets[2]) && facets[2] > 0 && isfinite(facets[7]));
    volumes[0] = 77;
    CHECK_STATUS(deldrift_voronoi_volumes(t, high, low, volumes, 5, &count), DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("high[0] is -1");
    CHECK_STATUS(deldrift_voronoi_volumes(t, low, low, volumes, 5, &count), DELDRIFT_INVALID_VALUE);
    CHECK_STATUS(deldrift_voronoi_volumes(t, nowhere, high, volumes, 5, &count), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("low[0]");
    CHECK_STATUS(deldrift_voronoi_facets(t, low, far, NULL, 0, &count), DELDRIFT_OUT_OF_RANGE);
    CHECK(volumes[0] == 77);
    deldrift_destroy(t);
}

static void values_are_interpolated(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    // Linear functions of the position, inside, at a vertex and outside.
    static const double positions[] = {2, 1, 1, 2, -1, 0}, outside[] = {8, 9};
    double values[10], results[6];
    for (int v = 0; v < 5; v++) {
        values[2 * v] = 3 - SQUARE[2 * v] + 2 * SQUARE[2 * v + 1];
        values[2 * v + 1] = SQUARE[2 * v];
    }
    static const deldrift_interpolation methods[] = {DELDRIFT_INTERPOLATION_LINEAR,
                                                     DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR};
    const deldrift_location near = {DELDRIFT_LOCATION_CELL, 1};
    for (int k = 0; k < 2; k++) {
        OK(deldrift_interpolate(t, methods[k], values, 5, 2, positions, 3, NULL, outside, results));
        CHECK(fabs(results[0] - 3) < 1e-14 && fabs(results[1] - 2) < 1e-14);
        CHECK(results[2] == values[8] && results[3] == values[9] && results[4] == 8 && results[5] == 9);
        OK(deldrift_interpolate(t, methods[k], values, 5, 2, positions, 3, &near, NULL, results));
        CHECK(results[2] == values[8] && isnan(results[4]) && isnan(results[5]));
        OK(deldrift_interpolate(t, methods[k], NULL, 5, 0, positions, 3, NULL, NULL, NULL));
        OK(deldrift_interpolate(t, methods[k], values, 5, 2, NULL, 0, NULL, NULL, NULL));
    }
    results[0] = 77;
    CHECK_STATUS(deldrift_interpolate(t, (deldrift_interpolation)2, values, 5, 2, positions, 3, NULL, NULL, results),
                 DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("method[0] is 2");
    CHECK_STATUS(deldrift_interpolate(t, methods[0], values, 4, 2, positions, 3, NULL, NULL, results),
                 DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("value_count is 4, but must be 5");
    CHECK_STATUS(deldrift_interpolate(t, methods[0], values, 5, SIZE_MAX / 2, positions, 3, NULL, NULL, results),
                 DELDRIFT_SIZE_OVERFLOW);
    static const double bad[] = {2, 1, 1, INFINITY};
    CHECK_STATUS(deldrift_interpolate(t, methods[0], values, 5, 2, bad, 2, NULL, NULL, results), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("positions[1]");
    CHECK(results[0] == 77);
    deldrift_destroy(t);
}

int main(void) {
    voronoi_cells_fill_the_box();
    voronoi_cells_have_centroids();
    voronoi_cells_without_a_box();
    voronoi_cells_in_half_spaces();
    voronoi_cells_that_have_changed();
    voronoi_cells_of_few_vertices();
    voronoi_cells_can_be_cancelled();
    values_are_interpolated();
    buffers_are_as_large_as_they_say(2);
    buffers_are_as_large_as_they_say(3);
    values_are_those_of_the_cells();
    boundaries_go_around();
    lists_are_by_vertex();
    stars_go_around();
    arrays_are_kept(2);
    arrays_are_kept(3);
    without_cells_all_is_empty();
    return 0;
}
