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
    }
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
    CHECK_STATUS(deldrift_validate(t, 3), DELDRIFT_PERIODIC);
    double place[3];
    int64_t shift[3];
    CHECK_STATUS(deldrift_wrap_positions(t, (double[]){0, NAN, 0}, NULL, 1, place, shift), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("positions[0], coordinate 1");
    CHECK_STATUS(deldrift_wrap_positions(t, one, NULL, 1, NULL, shift), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_stage_vectors(t, one, 0), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("vector_count is 0, but must be 1");
    CHECK_STATUS(deldrift_stage_vectors(t, (double[]){0, 0, 0}, 1), DELDRIFT_DEPENDENT_VECTORS);
    CHECK_STATUS(deldrift_commit_positions(t, (double[]){0, 1e30, 0}, 1, NULL), DELDRIFT_OUT_OF_RANGE);
    CHECK_MESSAGE("positions[0], coordinate 1, is 1e30");
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
    what_is_wrong_is_told();
    return 0;
}
