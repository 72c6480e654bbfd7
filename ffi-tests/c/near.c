// What is near a place: the nearest vertices, those in a ball or a box, the cells that a new vertex would remove.
#include "buffers.h"

// Sixty vertices at places of a small lattice, so that distances tie and places are shared, and some of them removed;
// or, in a line, without cells. Places to ask about are of the lattice, too, so that squares of distances are integers.
enum { COUNT = 60, SIDE = 7, PLACES = 200 };

typedef struct {
    uint32_t dimension;
    deldrift_triangulation *t;
    double positions[3 * COUNT], places[3 * PLACES];
    bool is_there[COUNT];
} lattice;

static lattice make_lattice(uint32_t dimension, bool is_flat) {
    lattice l = {.dimension = dimension};
    uint64_t seed = 11 + dimension;
    for (size_t i = 0; i < COUNT * dimension; i++) {
        l.positions[i] = is_flat && i % dimension > 0 ? 1 : floor(SIDE * next_random(&seed));
    }
    for (size_t i = 0; i < PLACES * dimension; i++) l.places[i] = floor((SIDE + 4) * next_random(&seed)) - 2;
    l.t = create(dimension, l.positions, COUNT, NULL);
    CHECK((cell_count(l.t) == 0) == is_flat);
    for (uint32_t v = 0; v < COUNT; v++) l.is_there[v] = v % 9 != 4;
    for (uint32_t v = 0; v < COUNT; v++) {
        if (!l.is_there[v]) OK(deldrift_remove_vertex(l.t, v));
    }
    return l;
}

static int64_t square(const lattice *l, size_t vertex, const double *place) {
    int64_t sum = 0;
    for (uint32_t k = 0; k < l->dimension; k++) {
        const int64_t difference = (int64_t)l->positions[vertex * l->dimension + k] - (int64_t)place[k];
        sum += difference * difference;
    }
    return sum;
}

// The vertex that comes after those in a row, by distance and id; DELDRIFT_NONE after the last one.
static uint32_t next_nearest(const lattice *l, const double *place, const uint32_t *row, size_t n) {
    uint32_t best = DELDRIFT_NONE;
    for (uint32_t v = 0; v < COUNT; v++) {
        bool is_free = l->is_there[v];
        for (size_t i = 0; i < n; i++) is_free = is_free && row[i] != v;
        if (is_free && (best == DELDRIFT_NONE || square(l, v, place) < square(l, best, place))) best = v;
    }
    return best;
}

static void nearest_are_those_of_all(uint32_t dimension, bool is_flat) {
    const size_t ks[] = {0, 1, 5, COUNT + 2};
    lattice l = make_lattice(dimension, is_flat);
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++) {
        static uint32_t rows[PLACES * (COUNT + 2)];
        memset(rows, 0x77, sizeof rows);
        OK(deldrift_nearest_vertices(l.t, l.places, PLACES, ks[i], rows));
        for (size_t p = 0; p < PLACES; p++) {
            const uint32_t *row = rows + p * ks[i];
            const double *place = l.places + p * dimension;
            for (size_t n = 0; n < ks[i]; n++) CHECK(row[n] == next_nearest(&l, place, row, n));
            uint32_t first = 77;
            OK(deldrift_nearest_vertex(l.t, place, &first));
            CHECK(ks[i] == 0 || row[0] == first);
        }
        CHECK(is_untouched(rows + PLACES * ks[i], sizeof rows - PLACES * ks[i] * sizeof *rows));
    }
    deldrift_destroy(l.t);
}

static void balls_have_those_of_all(uint32_t dimension, bool is_flat) {
    lattice l = make_lattice(dimension, is_flat);
    size_t n_found = 0;
    for (size_t p = 0; p < PLACES; p++) {
        const double *place = l.places + p * dimension;
        for (int squared = 0; squared < 30; squared++) {
            // The sphere goes through vertices, or is a last bit smaller.
            const double radii[2] = {squared, nextafter(squared, 0)};
            for (int k = 0; k < (squared > 0 ? 2 : 1); k++) {
                uint32_t found[COUNT];
                size_t count = 0, n = 0;
                OK(deldrift_vertices_in_ball(l.t, place, radii[k], found, COUNT, &count));
                for (uint32_t v = 0; v < COUNT; v++) {
                    if (l.is_there[v] && square(&l, v, place) <= squared - k) CHECK(n < count && found[n++] == v);
                }
                CHECK(n == count);
                n_found += n;
            }
        }
    }
    CHECK(n_found > 1000);
    deldrift_destroy(l.t);
}

static bool is_in_box(const lattice *l, size_t vertex, const double *low, const double *high) {
    const double *p = l->positions + vertex * l->dimension;
    for (uint32_t k = 0; k < l->dimension; k++) {
        if (p[k] < low[k] || p[k] > high[k]) return false;
    }
    return l->is_there[vertex];
}

static void boxes_have_those_of_all(uint32_t dimension, bool is_flat) {
    lattice l = make_lattice(dimension, is_flat);
    uint64_t seed = 5;
    size_t n_found = 0;
    for (size_t p = 0; p < 10 * PLACES; p++) {
        double low[3], high[3];
        for (uint32_t k = 0; k < dimension; k++) {
            // Whole numbers, so that vertices are on faces; some corners infinite, and some the wrong way round.
            low[k] = floor((SIDE + 2) * next_random(&seed)) - 1;
            high[k] = low[k] + floor(SIDE * next_random(&seed)) - 1;
            const double choice = next_random(&seed);
            if (choice < 0.1) low[k] = -INFINITY;
            if (choice > 0.9) high[k] = INFINITY;
            if (choice > 0.45 && choice < 0.5) high[k] = 1e300;
            if (choice > 0.5 && choice < 0.55) low[k] = nextafter(low[k], INFINITY);
        }
        uint32_t found[COUNT];
        size_t count = 0, n = 0;
        OK(deldrift_vertices_in_box(l.t, low, high, found, COUNT, &count));
        for (uint32_t v = 0; v < COUNT; v++) {
            if (is_in_box(&l, v, low, high)) CHECK(n < count && found[n++] == v);
        }
        CHECK(n == count);
        n_found += n;
    }
    CHECK(n_found > 1000);
    const double everywhere[] = {INFINITY, INFINITY, INFINITY}, nowhere[] = {-INFINITY, -INFINITY, -INFINITY};
    size_t all = 0, count = 77;
    OK(deldrift_vertex_count(l.t, &all));
    OK(deldrift_vertices_in_box(l.t, nowhere, everywhere, NULL, 0, &count));
    CHECK(count == all);
    OK(deldrift_vertices_in_box(l.t, everywhere, nowhere, NULL, 0, &count));
    CHECK(count == 0);
    OK(deldrift_vertices_in_box(l.t, everywhere, everywhere, NULL, 0, &count));
    CHECK(count == 0);
    deldrift_destroy(l.t);
}

static int compare_rows(const void *a, const void *b) { return memcmp(a, b, 4 * sizeof(uint32_t)); }

// The corners of some cells, ascending, and the rows in an order that does not depend on that of the cells.
static void sort_rows(uint32_t rows[][4], size_t count, uint32_t corners) {
    for (size_t c = 0; c < count; c++) {
        for (uint32_t i = corners; i < 4; i++) rows[c][i] = DELDRIFT_NONE;
        for (uint32_t i = 1; i < corners; i++) {
            for (uint32_t k = i; k > 0 && rows[c][k - 1] > rows[c][k]; k--) {
                const uint32_t other = rows[c][k];
                rows[c][k] = rows[c][k - 1];
                rows[c][k - 1] = other;
            }
        }
    }
    qsort(rows, count, sizeof *rows, compare_rows);
}

// The cells that the insertion of a vertex removes, as a list of changes tells.
static size_t removed_by_insertion(const deldrift_triangulation *t, const double *place, uint32_t rows[][4]) {
    deldrift_triangulation *copy = NULL;
    deldrift_changes changes;
    uint32_t vertex;
    OK(deldrift_clone(t, &copy));
    OK(deldrift_take_changes(copy, &changes));
    OK(deldrift_insert_vertex(copy, place, &vertex));
    OK(deldrift_take_changes(copy, &changes));
    const uint32_t corners = cells_of(t).corners_per_cell;
    for (size_t c = 0; c < changes.removed_count; c++) {
        memcpy(rows[c], changes.removed_vertices + c * corners, corners * sizeof *changes.removed_vertices);
    }
    const size_t count = changes.removed_count;
    deldrift_destroy(copy);
    return count;
}

static int32_t side_of(const deldrift_triangulation *t, const uint32_t *cell, uint32_t dimension, const double *place) {
    double points[5 * 3];
    int32_t sign = 77;
    for (uint32_t i = 0; i <= dimension; i++) OK(deldrift_position(t, cell[i], points + i * dimension));
    memcpy(points + (dimension + 1) * dimension, place, dimension * sizeof *place);
    OK(deldrift_in_sphere(dimension, points, &sign));
    return sign;
}

// By the sign of every cell's circle or sphere, and where the place is on one by what an insertion does.
static void conflicts_are_what_an_insertion_removes(uint32_t dimension, bool is_flat) {
    enum { MOST = 1000 };
    static uint32_t found[MOST], rows[MOST][4], removed[MOST][4];
    static bool is_found[MOST];
    lattice l = make_lattice(dimension, is_flat);
    const deldrift_cells_view view = cells_of(l.t);
    const uint32_t corners = view.corners_per_cell;
    CHECK(view.count <= MOST);
    size_t n_tied = 0, n_found = 0;
    deldrift_location hint = {DELDRIFT_LOCATION_CELL, 0};
    for (size_t p = 0; p < PLACES; p++) {
        const double *place = l.places + p * dimension;
        bool is_taken = false;
        for (uint32_t v = 0; v < COUNT; v++) is_taken = is_taken || (l.is_there[v] && square(&l, v, place) == 0);
        size_t count = 77;
        OK(deldrift_conflicts(l.t, place, p % 2 == 0 ? NULL : &hint, found, MOST, &count));
        OK(deldrift_locate(l.t, place, &hint));
        memset(is_found, 0, sizeof is_found);
        for (size_t c = 0; c < count; c++) {
            CHECK(found[c] < view.count && !is_found[found[c]]);
            is_found[found[c]] = true;
            memcpy(rows[c], view.vertices + (size_t)found[c] * corners, corners * sizeof *found);
        }
        n_found += count;
        if (is_taken || is_flat) {
            CHECK(count == 0);
            continue;
        }
        for (size_t c = 0; c < view.count; c++) {
            const int32_t side = side_of(l.t, view.vertices + c * corners, dimension, place);
            CHECK(side == 0 || (side > 0) == is_found[c]);
            n_tied += side == 0;
        }
        CHECK(removed_by_insertion(l.t, place, removed) == count);
        sort_rows(rows, count, corners);
        sort_rows(removed, count, corners);
        CHECK(memcmp(rows, removed, count * sizeof *rows) == 0);
    }
    CHECK(is_flat || (n_tied > 20 && n_found > 20));
    deldrift_destroy(l.t);
}

// By hand: squares of distances from (2, 1) are 5, 5, 25, 13 and 2, those from (0, 0) are 0, 16, 50, 16 and 5.
static void those_of_the_square(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    static const double places[] = {2, 1, 0, 0}, low[] = {0, 1}, high[] = {4, 4}, above[] = {INFINITY, INFINITY};
    uint32_t rows[12], found[6];
    size_t count;
    OK(deldrift_nearest_vertices(t, places, 2, 6, rows));
    static const uint32_t nearest[12] = {4, 0, 1, 3, 2, DELDRIFT_NONE, 0, 4, 1, 3, 2, DELDRIFT_NONE};
    CHECK(memcmp(rows, nearest, sizeof rows) == 0);
    OK(deldrift_vertices_in_ball(t, places + 2, 16, found, 6, &count));
    CHECK(count == 4 && found[0] == 0 && found[1] == 1 && found[2] == 3 && found[3] == 4);
    OK(deldrift_vertices_in_ball(t, places + 2, nextafter(16, 0), found, 6, &count));
    CHECK(count == 2 && found[0] == 0 && found[1] == 4);
    OK(deldrift_vertices_in_ball(t, places + 2, 0, found, 6, &count));
    CHECK(count == 1 && found[0] == 0);
    OK(deldrift_vertices_in_ball(t, places, 0, NULL, 0, &count));
    CHECK(count == 0);
    OK(deldrift_vertices_in_ball(t, places, INFINITY, found, 6, &count));
    CHECK(count == 5 && found[4] == 4);
    OK(deldrift_vertices_in_box(t, low, high, found, 6, &count));
    CHECK(count == 2 && found[0] == 3 && found[1] == 4);
    OK(deldrift_vertices_in_box(t, high, above, found, 6, &count));
    CHECK(count == 1 && found[0] == 2);
    OK(deldrift_vertices_in_box(t, high, low, found, 6, &count));
    CHECK(count == 0);

    // Another vertex at the place of the one inside is hidden, and comes after it.
    uint32_t hidden = 0;
    OK(deldrift_insert_vertex(t, SQUARE + 8, &hidden));
    OK(deldrift_nearest_vertices(t, places, 1, 3, rows));
    CHECK(rows[0] == 4 && rows[1] == hidden && rows[2] == 0);
    OK(deldrift_vertices_in_ball(t, places, 2, found, 6, &count));
    CHECK(count == 2 && found[0] == 4 && found[1] == hidden);
    OK(deldrift_vertices_in_box(t, low, high, found, 6, &count));
    CHECK(count == 3 && found[1] == 4 && found[2] == hidden);

    // One that is only to be inserted is not there, and one that is to be removed is.
    uint32_t first;
    OK(deldrift_stage_insertions(t, places, 1, &first));
    OK(deldrift_stage_removals(t, &hidden, 1));
    OK(deldrift_nearest_vertices(t, places, 1, 2, rows));
    CHECK(rows[0] == 4 && rows[1] == hidden);
    deldrift_destroy(t);

    t = create(2, NULL, 0, NULL);
    OK(deldrift_nearest_vertices(t, places, 2, 1, rows));
    CHECK(rows[0] == DELDRIFT_NONE && rows[1] == DELDRIFT_NONE);
    OK(deldrift_vertices_in_ball(t, places, INFINITY, NULL, 0, &count));
    CHECK(count == 0);
    OK(deldrift_vertices_in_box(t, low, above, NULL, 0, &count));
    CHECK(count == 0);
    OK(deldrift_conflicts(t, places, NULL, NULL, 0, &count));
    CHECK(count == 0);
    deldrift_destroy(t);
}

// Beyond a hull of four cells around the origin: near an edge one cell goes, at a vertex none, and far away none.
static void conflicts_from_outside(void) {
    static const double diamond[] = {2, 0, 0, 2, -2, 0, 0, -2, 0, 0};
    // The circle of each cell has its centre on the middle of its edge of the hull, and goes through the origin.
    static const double beside[] = {1.25, 1.25}, at[] = {2, 0}, far[] = {300, 300}, inside[] = {0.25, 0};
    deldrift_triangulation *t = create(2, diamond, 5, NULL);
    const deldrift_cells_view view = cells_of(t);
    uint32_t cells[4];
    size_t count = 77;
    OK(deldrift_conflicts(t, beside, NULL, cells, 4, &count));
    CHECK(count == 1 && has_corner(view.vertices + 3 * cells[0], 3, 0));
    CHECK(has_corner(view.vertices + 3 * cells[0], 3, 1));
    OK(deldrift_conflicts(t, at, NULL, NULL, 0, &count));
    CHECK(count == 0);
    OK(deldrift_conflicts(t, far, NULL, NULL, 0, &count));
    CHECK(count == 0);
    OK(deldrift_conflicts(t, inside, NULL, cells, 4, &count));
    CHECK(count == 2 && cells[0] != cells[1]);
    // Wherever it is said to be.
    const deldrift_location nears[] = {{DELDRIFT_LOCATION_VERTEX, 3}, {DELDRIFT_LOCATION_OUTSIDE, 2},
                                       {DELDRIFT_LOCATION_NO_CELLS, DELDRIFT_NONE}, {DELDRIFT_LOCATION_CELL, 1000},
                                       {DELDRIFT_LOCATION_VERTEX, DELDRIFT_NONE}};
    for (size_t k = 0; k < sizeof nears / sizeof *nears; k++) {
        OK(deldrift_conflicts(t, beside, nears + k, NULL, 0, &count));
        CHECK(count == 1);
    }
    deldrift_destroy(t);
}

static void buffers_are_as_large_as_they_say(uint32_t d) {
    deldrift_triangulation *t = d == 2 ? create(2, SQUARE, SQUARE_COUNT, NULL)
                                       : create(3, TETRAHEDRON, TETRAHEDRON_COUNT, NULL);
    const double centre[] = {0, 0, 0}, high[] = {9, 9, 9}, inside[] = {1, 1.75, 0.25};
    size_t n = 0;
    OK(deldrift_conflicts(t, inside, NULL, NULL, 0, &n));
    CHECK(n > 0 && n <= cell_count(t));
    CHECK_BUFFER(uint32_t, (size_t)5, 1, deldrift_vertices_in_ball(t, centre, 100, buffer, capacity, &count));
    CHECK_BUFFER(uint32_t, (size_t)5, 1, deldrift_vertices_in_box(t, centre, high, buffer, capacity, &count));
    CHECK_BUFFER(uint32_t, n, 1, deldrift_conflicts(t, inside, NULL, buffer, capacity, &count));
    deldrift_destroy(t);
}

// Lists of what is near each vertex are balls around it, without it; half lists have each pair once.
static void lists_are_balls(uint32_t dimension, bool is_flat) {
    lattice l = make_lattice(dimension, is_flat);
    static size_t offsets[COUNT + 1], half_offsets[COUNT + 1];
    static uint32_t neighbours[COUNT * COUNT], half[COUNT * COUNT], ball[COUNT];
    static int64_t shifts[3 * COUNT * COUNT];
    static uint8_t mask[COUNT];
    static double radii[COUNT];
    for (size_t v = 0; v < COUNT; v++) mask[v] = v % 3 != 1;
    for (int k = 0; k < 6; k++) {
        const double one[] = {0, 1, 4, nextafter(4, 0), 9.5, INFINITY};
        const bool is_each = k % 2 == 1, is_masked = k > 2;
        size_t count = 0, half_count = 0, asked = 0;
        for (size_t v = 0; v < COUNT; v++) radii[v] = is_each ? (double)(v % 5) : one[k];
        const size_t n_radii = is_each ? COUNT : 1, n_mask = is_masked ? COUNT : 0;
        const uint8_t *of = is_masked ? mask : NULL;
        OK(deldrift_neighbour_lists(l.t, radii, n_radii, of, n_mask, DELDRIFT_PAIRS_FULL, NULL, 0, NULL, NULL, 0, &asked));
        OK(deldrift_neighbour_lists(l.t, radii, n_radii, of, n_mask, DELDRIFT_PAIRS_FULL, offsets, COUNT + 1, neighbours,
                                    shifts, COUNT * COUNT, &count));
        CHECK(asked == count && offsets[0] == 0 && offsets[COUNT] == count);
        for (size_t s = 0; s < dimension * count; s++) CHECK(shifts[s] == 0);
        for (uint32_t v = 0; v < COUNT; v++) {
            size_t n = 0, at = offsets[v];
            if (l.is_there[v] && !(is_masked && !mask[v])) {
                OK(deldrift_vertices_in_ball(l.t, l.positions + v * dimension, radii[v], ball, COUNT, &n));
            }
            for (size_t i = 0; i < n; i++) CHECK(ball[i] == v || neighbours[at++] == ball[i]);
            CHECK(at == offsets[v + 1]);
        }
        OK(deldrift_neighbour_lists(l.t, radii, n_radii, of, n_mask, DELDRIFT_PAIRS_HALF, half_offsets, COUNT + 1, half, NULL,
                                    COUNT * COUNT, &half_count));
        // Each entry of full lists is in one of the half lists, one way or the other.
        static uint8_t times[COUNT][COUNT];
        memset(times, 0, sizeof times);
        for (uint32_t v = 0; v < COUNT; v++) {
            for (size_t i = half_offsets[v]; i < half_offsets[v + 1]; i++) {
                CHECK(times[v][half[i]]++ == 0 && times[half[i]][v]++ == 0);
                CHECK(v < half[i] || (is_masked && !mask[half[i]]));
            }
        }
        size_t pairs = 0;
        for (uint32_t v = 0; v < COUNT; v++) {
            for (size_t i = offsets[v]; i < offsets[v + 1]; i++) pairs += times[v][neighbours[i]]++ == 1 ? 1 : 0;
            for (size_t i = offsets[v]; i < offsets[v + 1]; i++) times[neighbours[i]][v] = 2;
        }
        CHECK(pairs == half_count);
    }
    deldrift_destroy(l.t);
}

// A program may stop the search, and gets nothing then.
static bool is_stopped(void *stops) { return *(bool *)stops; }

static void lists_can_be_cancelled(void) {
    bool stops = false;
    deldrift_options options;
    deldrift_options_init(&options);
    static const double radius = 100;
    size_t offsets[SQUARE_COUNT + 1], count = 777;
    uint32_t neighbours[SQUARE_COUNT * SQUARE_COUNT];
    memset(offsets, 0x77, sizeof offsets);
    memset(neighbours, 0x77, sizeof neighbours);
    options.user_data = &stops;
    options.cancel = is_stopped;
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, &options);
    stops = true;
    const size_t n = SQUARE_COUNT;
    CHECK_STATUS(deldrift_neighbour_lists(t, &radius, 1, NULL, 0, DELDRIFT_PAIRS_FULL, offsets, n + 1, neighbours, NULL,
                                          n * n, &count), DELDRIFT_CANCELLED);
    CHECK(is_untouched(offsets, sizeof offsets) && is_untouched(neighbours, sizeof neighbours) && count == 777);
    stops = false;
    OK(deldrift_neighbour_lists(t, &radius, 1, NULL, 0, DELDRIFT_PAIRS_FULL, offsets, n + 1, neighbours, NULL, n * n, &count));
    CHECK(count == n * (n - 1));
    deldrift_destroy(t);
}

static void bad_lists(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    static const double good[SQUARE_COUNT] = {2, 1, 1, 1}, bad[] = {-1, NAN, -INFINITY, -5e-324};
    static const uint8_t mask[SQUARE_COUNT + 1] = {1, 1, 1};
    size_t offsets[SQUARE_COUNT + 2], count = 777;
    uint32_t rows[8];
    int64_t shifts[16];
    memset(rows, 0x77, sizeof rows);
    memset(offsets, 0x77, sizeof offsets);
    memset(shifts, 0x77, sizeof shifts);
    const size_t n = SQUARE_COUNT;
    for (int k = 0; k < 4; k++) {
        CHECK_STATUS(deldrift_neighbour_lists(t, bad + k, 1, NULL, 0, DELDRIFT_PAIRS_FULL, offsets, n + 1, rows, shifts, 8,
                                              &count), DELDRIFT_INVALID_VALUE);
        CHECK_MESSAGE("squared_radii[0] is ");
    }
    CHECK_STATUS(deldrift_neighbour_lists(t, good, 1, NULL, 0, (deldrift_pairs)7, offsets, n + 1, rows, shifts, 8, &count),
                 DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("pairs[0] is 7");
    CHECK_STATUS(deldrift_neighbour_lists(t, good, 2, NULL, 0, DELDRIFT_PAIRS_FULL, offsets, n + 1, rows, shifts, 8, &count),
                 DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("radius_count is 2, but must be ");
    CHECK_STATUS(deldrift_neighbour_lists(t, good, 1, mask, n + 1, DELDRIFT_PAIRS_FULL, offsets, n + 1, rows, shifts, 8,
                                          &count), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("mask_count is ");
    CHECK_STATUS(deldrift_neighbour_lists(t, good, 1, mask, n, DELDRIFT_PAIRS_FULL, offsets, n, rows, shifts, 8, &count),
                 DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("offset_count is ");
    CHECK_STATUS(deldrift_neighbour_lists(t, NULL, 1, mask, n, DELDRIFT_PAIRS_FULL, offsets, n + 1, rows, shifts, 8, &count),
                 DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("squared_radii is NULL");
    CHECK_STATUS(deldrift_neighbour_lists(t, good, 1, NULL, 0, DELDRIFT_PAIRS_FULL, offsets, n + 1, rows, shifts, 8, NULL),
                 DELDRIFT_NULL_ARGUMENT);
    CHECK(count == 777 && is_untouched(shifts, sizeof shifts));
    const double all = INFINITY;
    CHECK_STATUS(deldrift_neighbour_lists(t, &all, 1, NULL, 0, DELDRIFT_PAIRS_FULL, offsets, n + 1, rows, shifts, 8, &count),
                 DELDRIFT_BUFFER_TOO_SMALL);
    CHECK(count == n * (n - 1) && is_untouched(rows, sizeof rows) && is_untouched(offsets, sizeof offsets));
    CHECK(is_untouched(shifts, sizeof shifts));
    deldrift_destroy(t);
}

static void bad_places(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    static const double good[] = {2, 1, 1, 1}, nowhere[] = {2, 1, NAN, 0}, endless[] = {INFINITY, 0};
    static const double far[] = {0, 1e99};
    uint32_t rows[8];
    size_t count = 777;
    memset(rows, 0x77, sizeof rows);
    CHECK_STATUS(deldrift_nearest_vertices(t, nowhere, 2, 3, rows), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("positions[1], coordinate 0, is NaN");
    CHECK_STATUS(deldrift_nearest_vertices(t, far, 1, 3, rows), DELDRIFT_OUT_OF_RANGE);
    CHECK_MESSAGE("positions[0], coordinate 1, is 1e99");
    // Places are looked at even if nothing is asked about them.
    CHECK_STATUS(deldrift_nearest_vertices(t, nowhere, 2, 0, NULL), DELDRIFT_NOT_FINITE);
    CHECK_STATUS(deldrift_nearest_vertices(t, NULL, 1, 3, rows), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("positions is NULL");
    CHECK_STATUS(deldrift_nearest_vertices(t, good, 1, 3, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("vertices is NULL");
    CHECK_STATUS(deldrift_nearest_vertices(t, good, SIZE_MAX, 1, rows), DELDRIFT_SIZE_OVERFLOW);
    CHECK_MESSAGE("positions cannot have " MOST_ENTRIES " entries");
    CHECK_STATUS(deldrift_nearest_vertices(t, good, 2, SIZE_MAX, rows), DELDRIFT_SIZE_OVERFLOW);
    CHECK_MESSAGE("vertices cannot have");
    CHECK_STATUS(deldrift_nearest_vertices(t, good, 1, SIZE_MAX / 4 + 1, rows), DELDRIFT_SIZE_OVERFLOW);
    CHECK_MESSAGE(SIZE_MAX > UINT32_MAX ? "vertices cannot have 4611686018427387904 entries"
                                       : "vertices cannot have 1073741824 entries");
    OK(deldrift_nearest_vertices(t, NULL, 0, 3, NULL));
    OK(deldrift_nearest_vertices(t, NULL, 0, SIZE_MAX, NULL));
    OK(deldrift_nearest_vertices(t, good, 2, 0, NULL));

    CHECK_STATUS(deldrift_vertices_in_ball(t, endless, 1, rows, 8, &count), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("centre[0], coordinate 0, is inf");
    CHECK_STATUS(deldrift_vertices_in_ball(t, far, 1, rows, 8, &count), DELDRIFT_OUT_OF_RANGE);
    CHECK_MESSAGE("centre[0], coordinate 1, is 1e99");
    CHECK_STATUS(deldrift_vertices_in_ball(t, NULL, 1, rows, 8, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("centre is NULL");
    CHECK_STATUS(deldrift_vertices_in_ball(t, good, 1, rows, 8, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("count is NULL");
    const double without_meaning[] = {-1, NAN, -INFINITY, -5e-324};
    for (int k = 0; k < 4; k++) {
        CHECK_STATUS(deldrift_vertices_in_ball(t, good, without_meaning[k], rows, 8, &count), DELDRIFT_INVALID_VALUE);
        CHECK_MESSAGE("squared_radius[0] is ");
    }

    CHECK_STATUS(deldrift_vertices_in_box(t, nowhere + 2, good, rows, 8, &count), DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("low[0] is NaN");
    CHECK_STATUS(deldrift_vertices_in_box(t, good, nowhere + 1, rows, 8, &count), DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("high[1] is NaN");
    CHECK_STATUS(deldrift_vertices_in_box(t, NULL, good, rows, 8, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("low is NULL");
    CHECK_STATUS(deldrift_vertices_in_box(t, good, NULL, rows, 8, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("high is NULL");

    CHECK_STATUS(deldrift_conflicts(t, nowhere + 2, NULL, rows, 8, &count), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("position[0], coordinate 0, is NaN");
    CHECK_STATUS(deldrift_conflicts(t, far, NULL, rows, 8, &count), DELDRIFT_OUT_OF_RANGE);
    CHECK_MESSAGE("position[0], coordinate 1, is 1e99");
    CHECK_STATUS(deldrift_conflicts(t, NULL, NULL, rows, 8, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("position is NULL");
    CHECK(is_untouched(rows, sizeof rows) && count == 777);
    deldrift_destroy(t);
}

int main(void) {
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        for (int is_flat = 0; is_flat < 2; is_flat++) {
            nearest_are_those_of_all(dimension, is_flat);
            balls_have_those_of_all(dimension, is_flat);
            lists_are_balls(dimension, is_flat);
            boxes_have_those_of_all(dimension, is_flat);
            conflicts_are_what_an_insertion_removes(dimension, is_flat);
        }
        buffers_are_as_large_as_they_say(dimension);
    }
    those_of_the_square();
    conflicts_from_outside();
    lists_can_be_cancelled();
    bad_lists();
    bad_places();
    return 0;
}
