// What a vertex in a box could change: cells, hull facets and vertices in reach, against integers.
#include "buffers.h"

enum { COUNT = 60, SIDE = 7, MOST = 2000, FAR = 20000 };

typedef struct {
    uint32_t dimension;
    deldrift_triangulation *t;
    deldrift_cells_view view;
    double positions[3 * COUNT], weights[COUNT];
    int64_t greatest; // weight of those that are there, at least 0
    bool is_there[COUNT];
} lattice;

// Vertices at places of a small lattice, some of them at one place, and some removed. Weights are whole numbers of some
// units, of which many vertices have none, so that many are hidden and many are not.
static lattice make_lattice(uint32_t dimension, bool is_weighted) {
    lattice l = {.dimension = dimension};
    uint64_t seed = 21 + dimension;
    for (size_t i = 0; i < COUNT * dimension; i++) l.positions[i] = floor(SIDE * next_random(&seed));
    for (size_t i = 0; i < COUNT && is_weighted; i++) l.weights[i] = floor(8 * next_random(&seed)) - 3;
    if (is_weighted)
        OK(deldrift_create_weighted(dimension, l.positions, l.weights, NULL, COUNT, NULL, &l.t));
    else
        l.t = create(dimension, l.positions, COUNT, NULL);
    for (uint32_t v = 0; v < COUNT; v++) l.is_there[v] = v % 9 != 4;
    for (uint32_t v = 0; v < COUNT; v++) {
        if (l.is_there[v] && l.weights[v] > (double)l.greatest) l.greatest = (int64_t)l.weights[v];
    }
    for (uint32_t v = 0; v < COUNT; v++) {
        if (!l.is_there[v]) OK(deldrift_remove_vertex(l.t, v));
    }
    l.view = cells_of(l.t);
    return l;
}

static int64_t at(const lattice *l, uint32_t vertex, uint32_t axis) {
    return (int64_t)l->positions[vertex * l->dimension + axis];
}

static int64_t whole(double x) {
    return isinf(x) ? (x > 0 ? FAR : -FAR) : (int64_t)x;
}

// The cross product of two vectors, or in 2D the last component of it.
static void cross(const int64_t *u, const int64_t *v, int64_t *product) {
    for (int k = 0; k < 3; k++) product[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
}

static void edges_of(const lattice *l, const uint32_t *row, int64_t edges[3][3]) {
    memset(edges, 0, 9 * sizeof(int64_t));
    for (uint32_t i = 0; i < l->dimension; i++) {
        for (uint32_t k = 0; k < l->dimension; k++) edges[i][k] = at(l, row[i + 1], k) - at(l, row[0], k);
    }
    // In the plane the third edge is upright, and adds nothing to the centre.
    if (l->dimension == 2) edges[2][2] = 1;
}

static bool has_weights(const lattice *l) {
    bool is = false;
    OK(deldrift_is_weighted(l->t, &is));
    return is;
}

static int64_t weight_apart(const lattice *l, uint32_t vertex, uint32_t first) {
    return (int64_t)(l->weights[vertex] - l->weights[first]);
}

// The place of the box next to the centre, at n / 2V from the first corner, is no further from it than that; with
// weights the squares differ by the greatest weight less that of the corner.
static bool is_cell_in_reach(const lattice *l, size_t cell, const double *low, const double *high) {
    const uint32_t *row = l->view.vertices + cell * (l->dimension + 1);
    int64_t e[3][3], product[3], n[3] = {0}, volume = 0, left = 0;
    edges_of(l, row, e);
    for (int i = 0; i < 3; i++) {
        int64_t squared = 0;
        for (uint32_t k = 0; k < l->dimension; k++) squared += e[i][k] * e[i][k];
        if (i < (int)l->dimension) squared -= weight_apart(l, row[i + 1], row[0]);
        cross(e[(i + 1) % 3], e[(i + 2) % 3], product);
        for (uint32_t k = 0; k < l->dimension; k++) n[k] += squared * product[k];
        if (i == 0) volume = e[0][0] * product[0] + e[0][1] * product[1] + e[0][2] * product[2];
    }
    CHECK(volume > 0);
    if (has_weights(l)) left = 4 * volume * volume * (l->greatest - (int64_t)l->weights[row[0]]);
    for (uint32_t k = 0; k < l->dimension; k++) {
        const int64_t below = 2 * volume * (whole(low[k]) - at(l, row[0], k)) - n[k];
        const int64_t above = n[k] - 2 * volume * (whole(high[k]) - at(l, row[0], k));
        const int64_t apart = below > 0 ? below : above > 0 ? above : 0;
        left += n[k] * n[k] - apart * apart;
    }
    return left >= 0;
}

// A corner of the box and the vertex behind are strictly on two sides.
static bool is_facet_in_reach(const lattice *l, size_t cell, uint32_t corner, const double *low, const double *high) {
    const uint32_t *row = l->view.vertices + cell * (l->dimension + 1);
    uint32_t on[4];
    for (uint32_t i = 1; i <= l->dimension; i++) on[i - 1] = row[(corner + i) % (l->dimension + 1)];
    int64_t u[3] = {0}, v[3] = {0, 0, 1}, normal[3], inside = 0;
    for (uint32_t k = 0; k < l->dimension; k++) {
        u[k] = at(l, on[1], k) - at(l, on[0], k);
        if (l->dimension == 3) v[k] = at(l, on[2], k) - at(l, on[0], k);
    }
    cross(u, v, normal);
    for (uint32_t k = 0; k < l->dimension; k++) inside += normal[k] * (at(l, row[corner], k) - at(l, on[0], k));
    CHECK(inside != 0);
    for (unsigned bits = 0; bits < 1u << l->dimension; bits++) {
        int64_t here = 0;
        for (uint32_t k = 0; k < l->dimension; k++) {
            here += normal[k] * (whole(bits >> k & 1 ? high[k] : low[k]) - at(l, on[0], k));
        }
        if (inside > 0 ? here < 0 : here > 0) return true;
    }
    return false;
}

static bool is_empty(const lattice *l, const double *low, const double *high) {
    for (uint32_t k = 0; k < l->dimension; k++) {
        if (low[k] > high[k]) return true;
    }
    return false;
}

// Whether a vertex of the mask is at the place of a corner but one; with weights, whether it is one.
static bool has_masked(const lattice *l, size_t cell, uint32_t without, const uint8_t *mask) {
    if (mask == NULL) return true;
    const uint32_t *row = l->view.vertices + cell * (l->dimension + 1);
    for (uint32_t v = 0; v < COUNT; v++) {
        uint32_t shown = DELDRIFT_NONE;
        if (!l->is_there[v] || mask[v] == 0) continue;
        OK(deldrift_coincident_representative(l->t, v, &shown));
        if (v != shown && has_weights(l)) continue;
        for (uint32_t i = 0; i <= l->dimension; i++) {
            if (i != without && row[i] == shown) return true;
        }
    }
    return false;
}

static double side(uint64_t *seed, double infinity) {
    return next_random(seed) < 0.15 ? infinity : floor((SIDE + 6) * next_random(seed)) - 3;
}

static void those_of_boxes(const lattice *l, uint64_t *seed, const uint8_t *mask) {
    enum { BOXES = 3 };
    const uint32_t d = l->dimension;
    double low[3 * BOXES], high[3 * BOXES];
    for (uint32_t i = 0; i < BOXES * d; i++) {
        low[i] = side(seed, -INFINITY);
        high[i] = side(seed, INFINITY);
        if (high[i] < low[i] && i >= d) high[i] = low[i];
    }
    static uint32_t cells[MOST], hull[MOST], vertices[MOST];
    static uint8_t corners[MOST];
    static double centres[3 * MOST], radii[MOST];
    size_t count = 0, n_hull = 0, next = 0, n_vertices = 0, offsets[BOXES + 1];
    OK(deldrift_cells_in_reach(l->t, low, high, BOXES, mask, COUNT, cells, centres, radii, MOST, &count));
    OK(deldrift_hull_facets_in_reach(l->t, low, high, BOXES, mask, COUNT, hull, corners, MOST, &n_hull));
    bool is_in[BOXES][COUNT] = {{false}};
    size_t next_facet = 0;
    for (size_t cell = 0; cell < l->view.count; cell++) {
        const uint32_t *row = l->view.vertices + cell * (d + 1);
        bool is_any = false, is_any_facet[4] = {false};
        for (size_t b = 0; b < BOXES; b++) {
            if (is_empty(l, low + b * d, high + b * d)) continue;
            const bool is_here = is_cell_in_reach(l, cell, low + b * d, high + b * d);
            is_any = is_any || is_here;
            for (uint32_t i = 0; i <= d && is_here; i++) is_in[b][row[i]] = true;
            for (uint32_t i = 0; i <= d; i++) {
                if (l->view.neighbours[cell * (d + 1) + i] != DELDRIFT_NONE) continue;
                if (!is_facet_in_reach(l, cell, i, low + b * d, high + b * d)) continue;
                is_any_facet[i] = true;
                for (uint32_t k = 0; k <= d; k++) is_in[b][row[k]] = is_in[b][row[k]] || k != i;
            }
        }
        if (is_any && has_masked(l, cell, DELDRIFT_NONE, mask)) {
            CHECK(next < count && cells[next] == cell);
            // The ball has the corners in it, but for the rounding here; with weights all that has a power as they have or
            // less, for the greatest weight.
            for (uint32_t i = 0; i <= d; i++) {
                double squared = 0;
                for (uint32_t k = 0; k < d; k++) {
                    const double off = centres[next * d + k] - l->positions[row[i] * d + k];
                    squared += off * off;
                }
                const double reach = squared + (double)l->greatest - l->weights[row[i]];
                const double off = has_weights(l) ? 1e-8 * (squared + 8) : 0;
                CHECK(reach <= radii[next] * radii[next] * (1 + 1e-14) + off / 1e4);
                CHECK(radii[next] * radii[next] <= reach * (1 + 3e-8) + off);
            }
            next++;
        }
        for (uint32_t i = 0; i <= d; i++) {
            if (!is_any_facet[i] || !has_masked(l, cell, i, mask)) continue;
            CHECK(next_facet < n_hull && hull[next_facet] == cell && corners[next_facet] == i);
            next_facet++;
        }
    }
    CHECK(next == count && next_facet == n_hull);
    OK(deldrift_vertices_in_reach(l->t, low, high, BOXES, mask, COUNT, vertices, offsets, MOST, &n_vertices));
    CHECK(offsets[0] == 0 && offsets[BOXES] == n_vertices);
    for (size_t b = 0; b < BOXES; b++) {
        size_t k = offsets[b];
        for (uint32_t v = 0; v < COUNT; v++) {
            uint32_t shown = DELDRIFT_NONE;
            if (!l->is_there[v] || (mask != NULL && mask[v] == 0)) continue;
            OK(deldrift_coincident_representative(l->t, v, &shown));
            if (!is_in[b][shown] || (v != shown && has_weights(l))) continue;
            CHECK(k < offsets[b + 1] && vertices[k] == v);
            k++;
        }
        CHECK(k == offsets[b + 1]);
    }
}

static void those_of_all(uint32_t dimension, bool is_weighted) {
    lattice l = make_lattice(dimension, is_weighted);
    size_t n_hidden = 0;
    if (is_weighted) OK(deldrift_hidden_by_weight(l.t, NULL, NULL, 0, &n_hidden));
    CHECK(!is_weighted || n_hidden > 3);
    uint64_t seed = 5;
    uint8_t mask[COUNT];
    for (size_t round = 0; round < 300; round++) {
        for (size_t v = 0; v < COUNT; v++) mask[v] = next_random(&seed) < 0.1 ? 255 : 0;
        those_of_boxes(&l, &seed, round % 2 == 0 ? NULL : mask);
    }
    deldrift_destroy(l.t);
}

// The circle of the square has its centre at (1, 1), and its square of a radius is 2.
static void a_last_bit_decides(void) {
    static const double corners[] = {0, 0, 2, 0, 0, 2, 2, 2};
    deldrift_triangulation *t = create(2, corners, 4, NULL);
    // (2, 2) is on the circle, and so is (2.25, 1.6614...) nearly: the last bit tells on which side a number is.
    double low[] = {2, 2}, high[] = {INFINITY, INFINITY};
    size_t count = 77;
    OK(deldrift_cells_in_reach(t, low, high, 1, NULL, 0, NULL, NULL, NULL, 0, &count));
    CHECK(count == 2);
    low[0] = nextafter(2, 3);
    OK(deldrift_cells_in_reach(t, low, high, 1, NULL, 0, NULL, NULL, NULL, 0, &count));
    CHECK(count == 0);
    // Along an axis the circle ends at the root of 2, which is between two numbers.
    low[0] = 1 + sqrt(2.0);
    low[1] = -INFINITY;
    OK(deldrift_cells_in_reach(t, low, high, 1, NULL, 0, NULL, NULL, NULL, 0, &count));
    const bool is_above = (low[0] - 1) * (low[0] - 1) > 2;
    CHECK(count == (is_above ? 0u : 2u));
    low[0] = nextafter(low[0], is_above ? 0 : 9);
    OK(deldrift_cells_in_reach(t, low, high, 1, NULL, 0, NULL, NULL, NULL, 0, &count));
    CHECK(count == (is_above ? 2u : 0u));
    // On the line of a side no facet is in reach, a last bit further one is.
    double beside[] = {-1, 2}, above[] = {3, nextafter(2, 3)};
    OK(deldrift_hull_facets_in_reach(t, beside, beside, 1, NULL, 0, NULL, NULL, 0, &count));
    CHECK(count == 1);
    double inside[] = {1, 2};
    OK(deldrift_hull_facets_in_reach(t, inside, inside, 1, NULL, 0, NULL, NULL, 0, &count));
    CHECK(count == 0);
    above[0] = 1;
    OK(deldrift_hull_facets_in_reach(t, inside, above, 1, NULL, 0, NULL, NULL, 0, &count));
    CHECK(count == 1);
    deldrift_destroy(t);
}

static void buffers_are_as_large_as_they_say(uint32_t d) {
    deldrift_triangulation *t = d == 2 ? create(2, SQUARE, SQUARE_COUNT, NULL)
                                       : create(3, TETRAHEDRON, TETRAHEDRON_COUNT, NULL);
    const double low[] = {-9, -9, -9}, high[] = {9, 9, 9};
    size_t n = cell_count(t), n_hull = 0, offsets[2];
    OK(deldrift_hull_facets(t, NULL, NULL, NULL, 0, &n_hull));
    CHECK_BUFFER(uint32_t, n, 1,
                 deldrift_cells_in_reach(t, low, high, 1, NULL, 0, buffer, NULL, NULL, capacity, &count));
    CHECK_BUFFER(double, n, d, deldrift_cells_in_reach(t, low, high, 1, NULL, 0, NULL, buffer, NULL, capacity, &count));
    CHECK_BUFFER(double, n, 1, deldrift_cells_in_reach(t, low, high, 1, NULL, 0, NULL, NULL, buffer, capacity, &count));
    CHECK_BUFFER(uint32_t, n_hull, 1,
                 deldrift_hull_facets_in_reach(t, low, high, 1, NULL, 0, buffer, NULL, capacity, &count));
    CHECK_BUFFER(uint8_t, n_hull, 1,
                 deldrift_hull_facets_in_reach(t, low, high, 1, NULL, 0, NULL, buffer, capacity, &count));
    CHECK_BUFFER(uint32_t, (size_t)5, 1,
                 deldrift_vertices_in_reach(t, low, high, 1, NULL, 0, buffer, offsets, capacity, &count));
    CHECK(offsets[0] == 0 && offsets[1] == 5);
    deldrift_destroy(t);
}

static void without_cells(void) {
    static const double line[] = {0, 0, 1, 1, 2, 2, 3, 3}, low[] = {8, 8, 1, 1}, high[] = {9, 9, 0, 0};
    static const uint8_t mask[] = {1, 0, 0, 7};
    deldrift_triangulation *t = create(2, line, 4, NULL);
    uint32_t vertices[4];
    size_t count = 77, offsets[3];
    OK(deldrift_cells_in_reach(t, low, high, 2, NULL, 0, NULL, NULL, NULL, 0, &count));
    CHECK(count == 0);
    OK(deldrift_hull_facets_in_reach(t, low, high, 2, NULL, 0, NULL, NULL, 0, &count));
    CHECK(count == 0);
    OK(deldrift_vertices_in_reach(t, low, high, 2, mask, 4, vertices, offsets, 4, &count));
    CHECK(count == 2 && vertices[0] == 0 && vertices[1] == 3);
    CHECK(offsets[0] == 0 && offsets[1] == 2 && offsets[2] == 2);
    deldrift_destroy(t);
}

static void bad_boxes(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    static const double good[] = {2, 1, 1, 1}, nowhere[] = {2, 1, NAN, 0};
    static const uint8_t mask[SQUARE_COUNT + 1] = {1};
    uint32_t cells[8];
    size_t count = 777;
    memset(cells, 0x77, sizeof cells);
    CHECK_STATUS(deldrift_cells_in_reach(t, nowhere, good, 2, NULL, 0, cells, NULL, NULL, 8, &count),
                 DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("low[2] is NaN, but must be a number or infinite");
    CHECK_STATUS(deldrift_hull_facets_in_reach(t, good, nowhere, 2, NULL, 0, cells, NULL, 8, &count),
                 DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("high[2] is NaN");
    CHECK_STATUS(deldrift_vertices_in_reach(t, NULL, good, 1, NULL, 0, cells, NULL, 8, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("low is NULL");
    CHECK_STATUS(deldrift_vertices_in_reach(t, good, good, 1, mask, SQUARE_COUNT + 1, cells, NULL, 8, &count),
                 DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("mask_count is 6, but must be 5");
    CHECK_STATUS(deldrift_vertices_in_reach(t, good, good, SIZE_MAX, NULL, 0, cells, NULL, 8, &count),
                 DELDRIFT_SIZE_OVERFLOW);
    CHECK_MESSAGE("low cannot have " MOST_ENTRIES " entries");
    CHECK(is_untouched(cells, sizeof cells) && count == 777);
    OK(deldrift_vertices_in_reach(t, NULL, NULL, 0, NULL, 0, cells, NULL, 8, &count));
    CHECK(count == 0);
    deldrift_destroy(t);
}

int main(void) {
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        those_of_all(dimension, false);
        those_of_all(dimension, true);
        buffers_are_as_large_as_they_say(dimension);
    }
    a_last_bit_decides();
    without_cells();
    bad_boxes();
    return 0;
}
