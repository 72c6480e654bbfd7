// Periodic triangulations: their cells are those around the middle one of so many copies that are triangulated in the open.
#include "state.h"

enum { MOST = 40, COPIES = 2, ROOM = 16384 };

typedef struct {
    uint32_t dimension;
    size_t n;
    double vectors[9], points[MOST * 3];
    size_t vector_count;
} set;

// Where a vertex is after a translation by these multiples.
static void translated(const set *s, size_t v, const int64_t *shift, double *to) {
    for (uint32_t axis = 0; axis < s->dimension; axis++) {
        to[axis] = s->points[v * s->dimension + axis];
        for (size_t k = 0; k < s->vector_count; k++) to[axis] += (double)shift[k] * s->vectors[k * s->dimension + axis];
    }
}

typedef struct {
    uint32_t vertex;
    int64_t shift[3];
    double place[3];
} corner;

static int compare(const void *first, const void *second) {
    const corner *a = first, *b = second;
    if (a->vertex != b->vertex) return a->vertex < b->vertex ? -1 : 1;
    for (int i = 0; i < 3; i++) {
        if (a->place[i] != b->place[i]) return a->place[i] < b->place[i] ? -1 : 1;
    }
    return 0;
}

// A number for the class of a cell: its corners in order, relative to the first.
static uint64_t digest_of_class(const set *s, corner *row) {
    const size_t n = s->dimension + 1;
    for (size_t i = 0; i < n; i++) translated(s, row[i].vertex, row[i].shift, row[i].place);
    qsort(row, n, sizeof *row, compare);
    uint64_t digest = 0;
    for (size_t i = 0; i < n; i++) {
        int64_t numbers[4] = {row[i].vertex};
        for (int k = 0; k < 3; k++) numbers[k + 1] = row[i].shift[k] - row[0].shift[k];
        digest = mixed(digest, digest_of(numbers, sizeof numbers));
    }
    return digest;
}

static int ascending(const void *first, const void *second) {
    const uint64_t a = *(const uint64_t *)first, b = *(const uint64_t *)second;
    return a < b ? -1 : a > b;
}

static size_t each_once(uint64_t *digests, size_t count) {
    size_t n = 0;
    qsort(digests, count, sizeof *digests, ascending);
    for (size_t i = 0; i < count; i++) {
        if (n == 0 || digests[n - 1] != digests[i]) digests[n++] = digests[i];
    }
    return n;
}

// The classes of cells that have a corner in the middle copy.
static size_t classes_of_copies(const set *s, uint64_t *digests) {
    static double places[ROOM * 3];
    static uint64_t keys[ROOM];
    static corner all[ROOM];
    int64_t most[3], shift[3];
    size_t n = 0, n_found = 0;
    for (size_t k = 0; k < 3; k++) most[k] = k < s->vector_count ? COPIES : 0;
    for (shift[0] = -most[0]; shift[0] <= most[0]; shift[0]++) {
        for (shift[1] = -most[1]; shift[1] <= most[1]; shift[1]++) {
            for (shift[2] = -most[2]; shift[2] <= most[2]; shift[2]++) {
                for (size_t v = 0; v < s->n; v++) {
                    CHECK(n < ROOM);
                    all[n] = (corner){.vertex = (uint32_t)v};
                    memcpy(all[n].shift, shift, sizeof shift);
                    keys[n] = v;
                    translated(s, v, shift, places + s->dimension * n++);
                }
            }
        }
    }
    deldrift_triangulation *t = NULL;
    OK(deldrift_create_with_keys(s->dimension, places, keys, n, NULL, &t));
    const deldrift_cells_view view = cells_of(t);
    for (size_t c = 0; c < view.count; c++) {
        corner row[4];
        bool is_of_middle = false;
        for (uint32_t i = 0; i < view.corners_per_cell; i++) {
            row[i] = all[view.vertices[c * view.corners_per_cell + i]];
            is_of_middle = is_of_middle || (row[i].shift[0] == 0 && row[i].shift[1] == 0 && row[i].shift[2] == 0);
        }
        if (is_of_middle) digests[n_found++] = digest_of_class(s, row);
        CHECK(n_found < ROOM);
    }
    deldrift_destroy(t);
    return each_once(digests, n_found);
}

// Cells are made of the pyramids of their vertices over facets, which are in the middle between the ends of edges.
static void check_voronoi(const set *s, const deldrift_triangulation *t, const uint32_t *edges, const int64_t *shifts, size_t n_edges) {
    static double measures[ROOM], centroids[ROOM * 3], derivatives[ROOM * 6], facets[ROOM];
    const size_t d = s->dimension;
    double volumes[MOST], areas[MOST], places[MOST * 3], by_facets[2][MOST] = {{0}}, only[MOST] = {0};
    uint8_t mask[MOST] = {1};
    size_t count;
    OK(deldrift_voronoi_cells(t, NULL, NULL, NULL, 0, volumes, areas, places, MOST, &count));
    CHECK(count == s->n);
    OK(deldrift_voronoi_derivatives(t, NULL, NULL, NULL, 0, measures, centroids, derivatives, ROOM, &count));
    CHECK(count == n_edges);
    OK(deldrift_voronoi_facets(t, NULL, NULL, facets, ROOM, &count));
    CHECK(count == n_edges && memcmp(facets, measures, count * sizeof *facets) == 0);
    OK(deldrift_voronoi_cells(t, NULL, NULL, mask, s->n, only, NULL, NULL, MOST, &count));
    CHECK(only[0] == volumes[0] && (s->n == 1 || only[1] == 0));
    for (size_t k = 0; k < n_edges; k++) {
        const uint32_t *ends = edges + 2 * k;
        double second[3], square = 0, along = 0, moved = 0;
        translated(s, ends[1], shifts + k * d, second);
        for (size_t axis = 0; axis < d; axis++) {
            const double first = s->points[ends[0] * d + axis], way = second[axis] - first;
            square += way * way;
            along += (centroids[k * d + axis] - (first + second[axis]) / 2) * way;
            moved += (derivatives[2 * k * d + axis] - derivatives[(2 * k + 1) * d + axis]) * way;
        }
        for (int i = 0; i < 2; i++) {
            by_facets[0][ends[i]] += measures[k];
            by_facets[1][ends[i]] += measures[k] * sqrt(square) / 2 / (double)d;
        }
        if (measures[k] > 1e-6 && isfinite(measures[k])) {
            // If both ends move along the edge, the facet does.
            CHECK(fabs(along) < 1e-9 && fabs(moved - measures[k] * sqrt(square)) < 1e-9);
        }
    }
    for (size_t v = 0; v < s->n; v++) {
        CHECK(isfinite(volumes[v]) == isfinite(areas[v]) && isfinite(volumes[v]) == !isnan(places[v * d]));
        if (!isfinite(volumes[v])) continue;
        CHECK(fabs(by_facets[0][v] - areas[v]) < 1e-9 * areas[v] && fabs(by_facets[1][v] - volumes[v]) < 1e-9 * volumes[v]);
    }
}

// Balls have all corners of the cell on them, volumes are those of the corners, and the facets of the hull are those with nothing
// beyond.
static void check_cells(const set *s, const deldrift_triangulation *t, const int64_t *shifts) {
    static double centres[ROOM * 3], squares[ROOM], volumes[ROOM], again[ROOM];
    static uint32_t cells[ROOM], facets[ROOM * 3];
    static uint8_t mask[ROOM], corners[ROOM], all[ROOM];
    const size_t d = s->dimension, n = d + 1;
    const deldrift_cells_view view = cells_of(t);
    size_t count, n_hull = 0;
    OK(deldrift_circumcentres(t, centres, squares, ROOM, &count));
    CHECK(count == view.count);
    OK(deldrift_volumes(t, volumes, ROOM, &count));
    double sum = 0, greatest = 0;
    for (size_t c = 0; c < count; c++) {
        sum += volumes[c];
        if (squares[c] > greatest) greatest = squares[c];
        for (size_t i = 0; i < n; i++) {
            double at[3], square = 0;
            translated(s, view.vertices[c * n + i], shifts + (c * n + i) * d, at);
            for (size_t axis = 0; axis < d; axis++) square += (at[axis] - centres[c * d + axis]) * (at[axis] - centres[c * d + axis]);
            CHECK(fabs(square - squares[c]) < 1e-8 * squares[c]);
            n_hull += view.neighbours[c * n + i] == DELDRIFT_NONE;
        }
    }
    if (s->vector_count == d) CHECK(fabs(sum - s->vectors[0] * s->vectors[d + 1] * (d == 3 ? s->vectors[8] : 1)) < 1e-9);
    memset(all, 1, count);
    OK(deldrift_mask_by_circumradius(t, greatest * 1.0001, mask, ROOM, &count));
    CHECK(memcmp(mask, all, count) == 0);
    OK(deldrift_mask_boundary(t, mask, view.count, facets, cells, corners, ROOM, &count));
    CHECK(count == n_hull);
    OK(deldrift_hull_facets(t, facets, cells, corners, ROOM, &count));
    CHECK(count == n_hull && (n_hull == 0 || s->vector_count < d));
    if (view.count == 0) return;
    memcpy(again, volumes, view.count * sizeof *again);
    const uint32_t last = (uint32_t)view.count - 1;
    again[last] = mask[last] = 0;
    OK(deldrift_update_volumes(t, &last, 1, again, ROOM));
    OK(deldrift_update_circumcentres(t, &last, 1, centres, NULL, ROOM));
    OK(deldrift_update_mask_by_circumradius(t, &last, 1, greatest * 1.0001, mask, ROOM));
    CHECK(again[last] == volumes[last] && mask[last] == 1);
    CHECK_STATUS(deldrift_update_volumes(t, (uint32_t[]){last + 1}, 1, again, ROOM), DELDRIFT_NO_SUCH_FACET);
}

// Places in the box are positions less what is told, and those of places are themselves. Reduced vectors are sums of others.
static void check_places(const set *s, const deldrift_triangulation *t) {
    const size_t d = s->dimension, rank = s->vector_count;
    double places[MOST * 3], again[MOST * 3], reduced[9];
    int64_t shifts[MOST * 3], multiples[9];
    uint32_t greatest[3];
    size_t count;
    OK(deldrift_reduced_vectors(t, reduced, multiples, greatest, 3, &count));
    CHECK(count == rank);
    for (size_t k = 0; k < rank * d; k++) {
        double sum = 0;
        for (size_t j = 0; j < rank; j++) sum += (double)multiples[k / d * d + j] * s->vectors[j * d + k % d];
        CHECK(sum == reduced[k] && greatest[k / d] >= 1);
    }
    OK(deldrift_wrap_positions(t, s->points, NULL, s->n, places, shifts));
    for (size_t v = 0; v < s->n; v++) {
        for (size_t axis = 0; axis < d; axis++) {
            double sum = places[v * d + axis];
            for (size_t j = 0; j < rank; j++) sum += (double)shifts[v * d + j] * s->vectors[j * d + axis];
            CHECK(sum == s->points[v * d + axis]);
        }
    }
    OK(deldrift_wrap_positions(t, places, places, s->n, again, shifts));
    for (size_t i = 0; i < s->n * d; i++) CHECK(again[i] == places[i] && shifts[i] == 0);
}

// The cells of a triangulation are those classes, and each is told once.
static void check(const set *s, const deldrift_triangulation *t) {
    static uint64_t expected[ROOM], found[ROOM];
    static int64_t shifts[ROOM * 12], beside[ROOM * 12];
    static uint32_t edges[ROOM * 2];
    const size_t d = s->dimension, n = d + 1;
    size_t count, n_edges;
    double vectors[9], positions[MOST * 3];
    // Both are used as they are: they are on the grid.
    OK(deldrift_vectors(t, vectors, 3, &count));
    CHECK(count == s->vector_count && memcmp(vectors, s->vectors, count * d * sizeof *vectors) == 0);
    OK(deldrift_copy_positions(t, positions, MOST, &count));
    CHECK(count == s->n && memcmp(positions, s->points, count * d * sizeof *positions) == 0);
    check_places(s, t);
    const size_t n_expected = classes_of_copies(s, expected);
    const deldrift_cells_view view = cells_of(t);
    OK(deldrift_cell_shifts(t, shifts, beside, ROOM, &count));
    CHECK(count == view.count && count == n_expected);
    for (size_t c = 0; c < count; c++) {
        corner row[4];
        for (size_t i = 0; i < n; i++) {
            row[i] = (corner){.vertex = view.vertices[c * n + i]};
            memcpy(row[i].shift, shifts + (c * n + i) * d, d * sizeof *shifts);
        }
        found[c] = digest_of_class(s, row);
    }
    CHECK(each_once(found, count) == n_expected && memcmp(found, expected, count * sizeof *found) == 0);
    // Beside a facet of a cell is one with all corners of the facet, where the shifts of the neighbour have it.
    for (size_t c = 0; c < count; c++) {
        for (size_t i = 0; i < n; i++) {
            const uint32_t other = view.neighbours[c * n + i];
            if (other == DELDRIFT_NONE) {
                CHECK(s->vector_count < d);
                continue;
            }
            size_t n_shared = 0;
            for (size_t j = 0; j < n; j++) {
                for (size_t k = 0; k < n && j != i; k++) {
                    bool is_same = view.vertices[c * n + j] == view.vertices[other * n + k];
                    for (size_t axis = 0; axis < d; axis++) {
                        is_same = is_same && shifts[(c * n + j) * d + axis] ==
                                                 shifts[(other * n + k) * d + axis] + beside[(c * n + i) * d + axis];
                    }
                    n_shared += is_same;
                }
            }
            CHECK(n_shared == d);
        }
    }
    check_cells(s, t, shifts);
    OK(deldrift_edges(t, edges, ROOM, &n_edges));
    OK(deldrift_edge_shifts(t, shifts, ROOM, &count));
    CHECK(count == n_edges);
    for (size_t k = 0; k < n_edges; k++) CHECK(edges[2 * k] <= edges[2 * k + 1]);
    // Of a torus, in two dimensions and in three, as facets are half as many as the corners of cells.
    if (s->vector_count == d) CHECK(n_edges == s->n + view.count);
    if (s->vector_count == d) {
        double volumes[MOST], sum = 0, box = vectors[0] * vectors[d + 1] * (d == 3 ? vectors[8] : 1);
        OK(deldrift_voronoi_volumes(t, NULL, NULL, volumes, MOST, &count));
        for (size_t v = 0; v < count; v++) sum += volumes[v];
        CHECK(fabs(sum - box) < 1e-12 * box);
    }
    check_voronoi(s, t, edges, shifts, n_edges);
}

static bool is_same(const double *p, const double *q, size_t d) { return memcmp(p, q, d * sizeof *p) == 0; }

// What is at vertices, and in the middle of cells, some periods away.
static void check_located(const set *s, const deldrift_triangulation *t) {
    static int64_t shifts[ROOM * 12], found[ROOM * 3];
    static double middles[ROOM * 3], weights[ROOM * 4], values[MOST];
    static deldrift_location locations[ROOM];
    static uint32_t cells[ROOM];
    const size_t d = s->dimension, n = d + 1;
    const int64_t away[3] = {3, -2, s->vector_count > 2 ? 5 : 0};
    const int64_t by[3] = {away[0], s->vector_count > 1 ? away[1] : 0, away[2]};
    double at[3], nearest_place[3];
    uint32_t nearest, ids[MOST];
    size_t count;
    deldrift_location location;
    for (uint32_t v = 0; v < s->n; v++) {
        translated(s, v, by, at);
        OK(deldrift_locate_in_period(t, at, 1, NULL, &location, found));
        CHECK(location.kind == DELDRIFT_LOCATION_VERTEX && location.index <= v);
        translated(s, location.index, found, nearest_place);
        CHECK(is_same(at, nearest_place, d));
        OK(deldrift_locate(t, at, &location));
        CHECK(location.kind == DELDRIFT_LOCATION_VERTEX && location.index <= v);
        OK(deldrift_nearest_vertex(t, at, &nearest));
        CHECK(nearest == location.index);
        OK(deldrift_vertices_in_ball(t, at, 0, ids, MOST, &count));
        CHECK(count >= 1 && ids[0] == nearest);
        values[v] = v;
    }
    OK(deldrift_vertices_in_ball(t, s->points, 1e9, ids, MOST, &count));
    CHECK(count == s->n && ids[count - 1] == count - 1);
    const deldrift_cells_view view = cells_of(t);
    OK(deldrift_cell_shifts(t, shifts, NULL, ROOM, &count));
    for (size_t c = 0; c < count; c++) {
        for (size_t i = 0; i < n; i++) {
            int64_t shift[3] = {0, 0, 0};
            for (size_t k = 0; k < s->vector_count; k++) shift[k] = shifts[(c * n + i) * d + k] + by[k];
            translated(s, view.vertices[c * n + i], shift, at);
            for (size_t axis = 0; axis < d; axis++) middles[c * d + axis] = (i > 0 ? middles[c * d + axis] : 0) + at[axis] / (double)n;
        }
    }
    OK(deldrift_locate_points(t, middles, count, NULL, locations));
    OK(deldrift_locate_in_period(t, middles, count, locations, locations, found));
    for (size_t c = 0; c < count; c++) {
        CHECK(locations[c].kind == DELDRIFT_LOCATION_CELL);
        cells[c] = locations[c].index;
        // But for cells so flat that their middle is rounded out of them.
        if (cells[c] == c) CHECK(memcmp(found + c * d, by, d * sizeof *by) == 0);
    }
    OK(deldrift_barycentric(t, middles, cells, count, weights));
    for (size_t c = 0; c < count; c++) {
        double sum = 0, value = 0, given;
        for (size_t i = 0; i < n; i++) {
            sum += weights[c * n + i];
            value += weights[c * n + i] * view.vertices[cells[c] * n + i];
        }
        OK(deldrift_interpolate(t, DELDRIFT_INTERPOLATION_LINEAR, values, s->n, 1, middles + c * d, 1, NULL, NULL, &given));
        CHECK(fabs(sum - 1) < 1e-12 && fabs(value - given) < 1e-6);
    }
    for (size_t c = 0; c < view.count; c++) {
        double given, least = values[s->n - 1], most = values[0];
        OK(deldrift_interpolate(t, DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR, values, s->n, 1, middles + c * d, 1, NULL, NULL, &given));
        CHECK(given > fmin(least, most) - 1e-6 && given < fmax(least, most) + 1e-6);
        // What is in a cell is in conflict with it.
        static uint32_t removed[ROOM];
        size_t n_removed, k = 0;
        OK(deldrift_conflicts(t, middles + c * d, locations + c, removed, ROOM, &n_removed));
        while (k < n_removed && removed[k] != cells[c]) k++;
        CHECK(k < n_removed);
    }
    double low[3], high[3];
    uint32_t all[MOST];
    for (size_t v = 0; v < s->n; v++) {
        OK(deldrift_position(t, (uint32_t)v, low));
        for (size_t i = 0; i < d; i++) high[i] = low[i];
        OK(deldrift_vertices_in_box(t, low, high, all, MOST, &count));
        CHECK(count >= 1 && all[0] <= v);
    }
    for (size_t i = 0; i < d; i++) low[i] = -INFINITY, high[i] = INFINITY;
    OK(deldrift_vertices_in_box(t, low, high, all, MOST, &count));
    CHECK(count == s->n);
    uint8_t changed[MOST];
    OK(deldrift_voronoi_changed(t, NULL, 0, changed, MOST, &count));
    CHECK(count == s->n && changed[0] == 1);
}

// What is cloned and what is saved and loaded, in memory or in a file, have these cells as well, and the first two the same bytes.
static void check_kept(const set *s, const deldrift_triangulation *t) {
    deldrift_triangulation *kept[3] = {NULL};
    size_t size, count;
    OK(deldrift_save(t, NULL, 0, &size));
    unsigned char *bytes = malloc(size), *again = malloc(size);
    CHECK(bytes != NULL && again != NULL);
    CHECK_STATUS(deldrift_save(t, bytes, size - 1, &count), DELDRIFT_BUFFER_TOO_SMALL);
    OK(deldrift_save(t, bytes, size, &count));
    OK(deldrift_clone(t, &kept[0]));
    OK(deldrift_load(bytes, size, NULL, &kept[1]));
    OK(deldrift_save_file(t, "periodic.saved"));
    OK(deldrift_load_file("periodic.saved", NULL, &kept[2]));
    remove("periodic.saved");
    for (int k = 0; k < 3; k++) {
        check(s, kept[k]);
        OK(deldrift_validate(kept[k], 3));
        OK(deldrift_save(kept[k], again, size, &count));
        CHECK(count == size && memcmp(bytes, again, size) == 0);
        deldrift_destroy(kept[k]);
    }
    bytes[size / 2] ^= 1;
    CHECK_STATUS(deldrift_load(bytes, size, NULL, &kept[0]), DELDRIFT_INVALID_DATA);
    free(bytes);
    free(again);
}

// Lists by vertex have an entry for each end of an edge, and each corner of a cell.
static void check_lists(const set *s, const deldrift_triangulation *t) {
    static uint32_t edges[ROOM * 2], lists[ROOM * 4], star[ROOM], offsets[MOST + 1];
    static uint8_t mirrors[ROOM * 4];
    const size_t n = s->dimension + 1;
    const deldrift_cells_view view = cells_of(t);
    size_t n_edges, count;
    OK(deldrift_edges(t, edges, ROOM, &n_edges));
    OK(deldrift_vertex_neighbours(t, offsets, s->n + 1, lists, ROOM * 4, &count));
    CHECK(count == 2 * n_edges && offsets[0] == 0 && offsets[s->n] == count);
    for (uint32_t v = 0; v < s->n; v++) {
        uint64_t sum = 0, expected = 0;
        for (size_t k = 0; k < n_edges; k++) {
            for (int i = 0; i < 2; i++) expected += edges[2 * k + i] == v ? mixed(1, edges[2 * k + 1 - i]) : 0;
        }
        for (uint32_t k = offsets[v]; k < offsets[v + 1]; k++) {
            CHECK(k == offsets[v] || lists[k - 1] <= lists[k]);
            sum += mixed(1, lists[k]);
        }
        CHECK(sum == expected);
    }
    OK(deldrift_vertex_cells(t, offsets, s->n + 1, lists, ROOM * 4, &count));
    CHECK(count == n * view.count);
    for (uint32_t v = 0; v < s->n; v++) {
        size_t n_corners = 0;
        for (size_t k = 0; k < n * view.count; k++) n_corners += view.vertices[k] == v;
        CHECK(offsets[v + 1] - offsets[v] == n_corners);
        OK(deldrift_star(t, v, star, ROOM, &count));
        CHECK(count == n_corners && memcmp(star, lists + offsets[v], count * sizeof *star) == 0);
        OK(deldrift_cells_around(t, &v, 1, star, ROOM, &count));
        CHECK(count <= n_corners);
    }
    OK(deldrift_cell_of_each_vertex(t, star, ROOM, &count));
    CHECK(count == s->n && star[0] == (view.count == 0 ? DELDRIFT_NONE : lists[0]));
    OK(deldrift_mirror_indices(t, mirrors, ROOM, &count));
    for (size_t k = 0; k < n * view.count; k++) {
        uint32_t mirror;
        OK(deldrift_mirror_index(t, (uint32_t)(k / n), (uint32_t)(k % n), &mirror));
        CHECK(view.neighbours[k] == DELDRIFT_NONE ? mirrors[k] == UINT8_MAX && mirror == DELDRIFT_NONE : mirror == mirrors[k]);
        if (mirror != DELDRIFT_NONE) CHECK(view.neighbours[view.neighbours[k] * n + mirror] == k / n);
    }
    OK(deldrift_hidden_vertices(t, NULL, NULL, 0, &count));
    CHECK(count == 0);
    const deldrift_field field = {"x", s->points, s->dimension};
    OK(deldrift_write_vtu(t, "periodic.vtu", &field, 1, NULL, 0));
    OK(deldrift_write_medit(t, "periodic.mesh", NULL, 0));
    CHECK(remove("periodic.vtu") == 0 && remove("periodic.mesh") == 0);
}

// Places on a grid, so that they are used as they are.
static double random_place(uint64_t *state) { return floor(next_random(state) * 1048576) / 1048576; }

static void moves_and_boxes(uint32_t dimension, size_t n, size_t vector_count, uint64_t seed) {
    // Of each vector those of the axes before it alone, so that the measure is a product.
    set s = {.dimension = dimension, .n = n, .vector_count = vector_count};
    static const double boxes[2][9] = {{1, 0, 0.25, 1.125}, {1, 0, 0, 0.25, 0.875, 0, 0.125, -0.375, 1.125}};
    memcpy(s.vectors, boxes[dimension - 2], sizeof s.vectors);
    for (size_t i = 0; i < n * dimension; i++) s.points[i] = random_place(&seed);
    deldrift_triangulation *t = NULL;
    deldrift_commit_report report;
    size_t count;
    OK(deldrift_create_periodic(dimension, s.points, n, s.vectors, vector_count, NULL, &t));
    OK(deldrift_vertex_count(t, &count));
    CHECK(count == n);
    check(&s, t);
    check_located(&s, t);
    check_lists(&s, t);
    for (int step = 0; step < 6; step++) {
        for (size_t i = 0; i < n * dimension; i++) {
            s.points[i] += (random_place(&seed) - 0.5) / (step % 2 == 0 ? 1024 : 4);
            // The program takes back what leaves the box along an axis, by the first vector.
            if (i % dimension == 0 && s.points[i] > 1) s.points[i] -= 1;
            if (i % dimension == 0 && s.points[i] < 0) s.points[i] += 1;
        }
        if (step == 4) {
            s.vectors[0] += 0.125;
            OK(deldrift_stage_vectors(t, s.vectors, vector_count));
        }
        OK(deldrift_commit_positions(t, s.points, n, &report));
        CHECK(report.timestamp == (uint64_t)step + 1 && report.moved == n);
        check(&s, t);
        check_located(&s, t);
        if (step == 3) check_kept(&s, t);
    }
    deldrift_destroy(t);
}

// A cell that stays keeps its index; what is in the plane comes and goes by twos.
static void changes_are_told(void) {
    static const double square[] = {1, 0, 0, 1};
    deldrift_triangulation *t = NULL;
    deldrift_changes changes;
    size_t count;
    uint32_t first;
    OK(deldrift_create_periodic(2, (double[]){0.25, 0.25, 0.75, 0.5, 0.5, 0.875}, 3, square, 2, NULL, &t));
    OK(deldrift_take_changes(t, &changes));
    CHECK(changes.created_count == 6 && changes.removed_count == 0 && changes.star_count == 3);
    OK(deldrift_move_vertex(t, 0, (double[]){0.25, 0.28125}));
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_take_changes(t, &changes));
    CHECK(changes.created_count == 0 && changes.removed_count == 0 && changes.renumbered_count == 0);
    // The vertex is at the same place, in another period: its cells have other shifts.
    OK(deldrift_move_vertex(t, 0, (double[]){1.25, 0.28125}));
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_take_changes(t, &changes));
    CHECK(changes.created_count == changes.removed_count && changes.created_count > 0);
    OK(deldrift_stage_insertions(t, (double[]){0.25, 0.28125}, 1, &first));
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_take_changes(t, &changes));
    CHECK(changes.created_count == 0 && changes.hidden_count == 1 && changes.hidden[0] == first);
    OK(deldrift_move_vertex(t, first, (double[]){0.5, 0.375}));
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_take_changes(t, &changes));
    CHECK(changes.created_count == changes.removed_count + 2 && changes.shown_count == 1);
    OK(deldrift_cell_count(t, &count));
    CHECK(count == 8 && changes.stars[changes.star_count - 1] == first);
    deldrift_destroy(t);
}

static void vertices_come_and_go(void) {
    static const double square[] = {1, 0, 0, 1};
    double position[2];
    deldrift_triangulation *t = NULL;
    deldrift_commit_report report;
    uint32_t first = 0, other = 0;
    size_t count = 0;
    bool present = true;
    OK(deldrift_create_periodic(2, NULL, 0, square, 2, NULL, &t));
    OK(deldrift_cell_count(t, &count));
    CHECK(count == 0);
    OK(deldrift_stage_insertions(t, (double[]){0.5, 0.5, 7.5, -0.25, 2.5, 0.5}, 3, &first));
    CHECK_STATUS(deldrift_move_vertex(t, 1, square), DELDRIFT_STAGED_VERTEX);
    OK(deldrift_commit_timestamp(t, &report));
    CHECK(first == 0 && report.inserted == 3 && report.coincident == 1);
    OK(deldrift_coincident_representative(t, 2, &other));
    OK(deldrift_cell_count(t, &count));
    CHECK(other == 0 && count == 4);
    uint32_t hidden, shown;
    OK(deldrift_hidden_vertices(t, &hidden, &shown, 1, &count));
    CHECK(count == 1 && hidden == 2 && shown == 0);
    OK(deldrift_stage_removals(t, (uint32_t[]){0}, 1));
    CHECK_STATUS(deldrift_move_vertex(t, 0, square), DELDRIFT_STAGED_VERTEX);
    OK(deldrift_move_vertex(t, 1, (double[]){7.5, 0.5}));
    OK(deldrift_commit_timestamp(t, &report));
    CHECK(report.removed == 1 && report.moved == 1 && report.coincident == 1);
    OK(deldrift_coincident_representative(t, 2, &other));
    OK(deldrift_is_present(t, 0, &present));
    OK(deldrift_position(t, 1, position));
    CHECK(other == 1 && !present && position[0] == 7.5);
    CHECK_STATUS(deldrift_position(t, 0, position), DELDRIFT_REMOVED_VERTEX);
    OK(deldrift_cell_count(t, &count));
    CHECK(count == 2);
    uint32_t map[3];
    CHECK_STATUS(deldrift_compact(t, map, 2, &count), DELDRIFT_BUFFER_TOO_SMALL);
    OK(deldrift_compact(t, map, 3, &count));
    CHECK(count == 3 && map[0] == DELDRIFT_NONE && map[1] == 0 && map[2] == 1);
    OK(deldrift_position(t, 0, position));
    OK(deldrift_coincident_representative(t, 1, &other));
    CHECK(position[0] == 7.5 && other == 0);
    OK(deldrift_relocate_vertex(t, 1, (double[]){0.25, 0.75}));
    OK(deldrift_insert_vertex(t, (double[]){0.125, 0.25}, &other));
    OK(deldrift_cell_count(t, &count));
    CHECK(other == 2 && count == 6);
    OK(deldrift_remove_vertex(t, 0));
    OK(deldrift_cell_count(t, &count));
    CHECK(count == 4);
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
}

// Rounds are seen, and can be taken back, or be the next timestamp.
static void steps_are_tried(void) {
    static const double square[] = {1, 0, 0, 1}, sheared[] = {1, 0, 0.25, 1};
    static unsigned char before[8192], after[8192];
    deldrift_triangulation *t = NULL;
    deldrift_commit_report report;
    uint64_t timestamp = 77;
    size_t count = 0, size = 0, again = 0;
    double vectors[4], position[2];
    uint32_t first = 0;
    OK(deldrift_create_periodic(2, (double[]){0.5, 0.5, 7.5, -0.25, 2.25, 0.5}, 3, square, 2, NULL, &t));
    OK(deldrift_save(t, before, sizeof before, &size));
    OK(deldrift_move_vertex(t, 1, (double[]){7.5, 0}));
    OK(deldrift_stage_vectors(t, sheared, 2));
    OK(deldrift_prepare_timestamp(t, &report));
    CHECK(report.timestamp == 1 && report.moved == 1);
    OK(deldrift_stage_insertions(t, (double[]){0.125, 0.25}, 1, &first));
    OK(deldrift_prepare_timestamp(t, &report));
    OK(deldrift_cell_count(t, &count));
    OK(deldrift_timestamp(t, &timestamp));
    OK(deldrift_vectors(t, vectors, 2, &again));
    CHECK(report.inserted == 1 && first == 3 && count == 8 && timestamp == 0 && vectors[2] == 0.25);
    CHECK_STATUS(deldrift_commit_timestamp(t, NULL), DELDRIFT_PREPARED);
    CHECK_MESSAGE("timestamp 1 is prepared, in 2 rounds");
    CHECK_STATUS(deldrift_save(t, after, sizeof after, &again), DELDRIFT_PREPARED);
    CHECK_STATUS(deldrift_remove_vertex(t, 0), DELDRIFT_PREPARED);
    OK(deldrift_stage_removals(t, (uint32_t[]){0}, 1));
    OK(deldrift_withdraw_timestamp(t));
    OK(deldrift_save(t, after, sizeof after, &again));
    CHECK(size == again && memcmp(before, after, size) == 0);
    CHECK_STATUS(deldrift_publish_timestamp(t), DELDRIFT_NOT_PREPARED);
    OK(deldrift_move_vertex(t, 1, (double[]){7.5, 0}));
    OK(deldrift_prepare_timestamp(t, NULL));
    // A round that fails is taken back alone.
    OK(deldrift_stage_removals(t, (uint32_t[]){0}, 1));
    OK(deldrift_stage_vectors(t, (double[]){1e-20, 0, 0, 1e-20}, 2));
    CHECK_STATUS(deldrift_prepare_timestamp(t, NULL), DELDRIFT_OUT_OF_RANGE);
    OK(deldrift_discard_moves(t));
    OK(deldrift_publish_timestamp(t));
    OK(deldrift_timestamp(t, &timestamp));
    OK(deldrift_position(t, 1, position));
    OK(deldrift_vertex_count(t, &count));
    CHECK(timestamp == 1 && position[1] == 0 && count == 3);
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
}

static void what_is_wrong_is_told(void) {
    static const double one[] = {0.5, 0.5, 0.5};
    deldrift_triangulation *t = NULL;
    deldrift_options options;
    deldrift_options_init(&options);
    CHECK_STATUS(deldrift_create_periodic(2, one, 1, (double[]){1, 2, 2, 4}, 2, NULL, &t), DELDRIFT_DEPENDENT_VECTORS);
    CHECK_MESSAGE("vectors[1]");
    CHECK_STATUS(deldrift_create_periodic(2, one, 1, one, 0, NULL, &t), DELDRIFT_DEPENDENT_VECTORS);
    CHECK_STATUS(deldrift_create_periodic(2, one, 1, (double[]){1, 0, 1e-60, 1}, 2, NULL, &t), DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("vectors[2] is");
    options.coincidence = DELDRIFT_COINCIDENCE_REJECT;
    CHECK_STATUS(deldrift_create_periodic(2, one, 1, one, 1, &options, &t), DELDRIFT_INVALID_OPTIONS);
    CHECK_MESSAGE("options.coincidence is 1");
    OK(deldrift_create_periodic(3, one, 1, one, 1, NULL, &t));
    CHECK_STATUS(deldrift_publish_timestamp(t), DELDRIFT_NOT_PREPARED);
    double place[3];
    int64_t shift[3];
    CHECK_STATUS(deldrift_wrap_positions(t, (double[]){0, NAN, 0}, NULL, 1, place, shift), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("positions[0], coordinate 1");
    CHECK_STATUS(deldrift_wrap_positions(t, one, NULL, 1, NULL, shift), DELDRIFT_NULL_ARGUMENT);
    size_t count;
    const double low[] = {-INFINITY, 0, 0}, high[] = {INFINITY, 2, 3}, tilted[] = {0, 1, 1, 9, 0.125, 1, 0, 9};
    double volume;
    deldrift_triangulation *column = NULL;
    OK(deldrift_create_periodic(3, one, 1, (double[]){1, 0, 0}, 1, NULL, &column));
    OK(deldrift_voronoi_volumes(column, low, high, &volume, 1, &count));
    CHECK(count == 1 && fabs(volume - 6) < 1e-12);
    OK(deldrift_voronoi_cells_within(column, low, high, tilted, 1, NULL, 0, &volume, NULL, NULL, 1, &count));
    CHECK(fabs(volume - 6) < 1e-12);
    CHECK_STATUS(deldrift_voronoi_cells(column, one, one, NULL, 0, NULL, NULL, NULL, 0, &count), DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("low[0] is 0.5, but must be -infinity");
    CHECK_STATUS(deldrift_voronoi_cells_within(column, low, high, tilted, 2, NULL, 0, NULL, NULL, NULL, 0, &count), DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("half_spaces[1] is 0.125, but must be 0");
    CHECK_STATUS(deldrift_voronoi_derivatives_within(column, NULL, NULL, tilted, 1, NULL, 0, NULL, NULL, NULL, 0, &count), DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("low[1] is -inf, but must be finite, or half-spaces must bound");
    CHECK_STATUS(deldrift_voronoi_facets(column, low, NULL, NULL, 0, &count), DELDRIFT_NULL_ARGUMENT);
    deldrift_triangulation *strip = NULL;
    OK(deldrift_create_periodic(2, (double[]){0, 0, 0.5, 1}, 2, (double[]){1, 0}, 1, NULL, &strip));
    CHECK_STATUS(deldrift_conflicts(strip, (double[]){0, 2}, NULL, NULL, 0, &count), DELDRIFT_PERIODIC);
    CHECK_MESSAGE("position is outside the convex hull of a triangulation that is periodic");
    deldrift_destroy(strip);
    deldrift_destroy(column);
    CHECK_STATUS(deldrift_voronoi_cells(t, NULL, NULL, (uint8_t[]){1, 1}, 2, NULL, NULL, NULL, 0, &count), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("mask_count is 2, but must be 1");
    CHECK_STATUS(deldrift_stage_vectors(t, one, 0), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("vector_count is 0, but must be 1");
    CHECK_STATUS(deldrift_stage_vectors(t, (double[]){0, 0, 0}, 1), DELDRIFT_DEPENDENT_VECTORS);
    CHECK_STATUS(deldrift_commit_positions(t, (double[]){0, 1e30, 0}, 1, NULL), DELDRIFT_OUT_OF_RANGE);
    CHECK_MESSAGE("positions[0], coordinate 1, is 1e30");
    unsigned char bytes[4096];
    size_t size;
    deldrift_triangulation *other = NULL;
    CHECK_STATUS(deldrift_validate(t, 4), DELDRIFT_INVALID_LEVEL);
    OK(deldrift_save(t, bytes, sizeof bytes, &size));
    CHECK_STATUS(deldrift_load(bytes, size, &options, &other), DELDRIFT_INVALID_OPTIONS);
    CHECK_MESSAGE("options.coincidence is 1");
    CHECK_STATUS(deldrift_load(bytes, size - 1, NULL, &other), DELDRIFT_INVALID_DATA);
    OK(deldrift_load(bytes, size, NULL, &other));
    deldrift_destroy(other);
    deldrift_destroy(t);
}

int main(void) {
    uint64_t seed = 1;
    for (size_t rank = 1; rank <= 2; rank++) {
        for (size_t n = 1; n <= MOST; n = 3 * n + 1) moves_and_boxes(2, n, rank, seed++);
    }
    for (size_t rank = 1; rank <= 3; rank++) {
        for (size_t n = 1; n <= MOST; n = 3 * n + 1) moves_and_boxes(3, n, rank, seed++);
    }
    vertices_come_and_go();
    steps_are_tried();
    changes_are_told();
    what_is_wrong_is_told();
    return 0;
}
