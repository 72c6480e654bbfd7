// All that can be read of a triangulation, in a few numbers; and a copy of its cells that follows the lists of changes.
#ifndef STATE_H
#define STATE_H

#include "check.h"

static inline uint64_t mixed(uint64_t sum, uint64_t value) {
    sum = (sum ^ value) * 0x9e3779b97f4a7c15u;
    return sum ^ sum >> 29;
}

static inline uint64_t digest_of(const void *bytes, size_t count) {
    const uint8_t *from = bytes;
    uint64_t sum = count;
    while (count >= 8) {
        uint64_t word;
        memcpy(&word, from, 8);
        sum = mixed(sum, word);
        from += 8;
        count -= 8;
    }
    for (size_t i = 0; i < count; i++) sum = mixed(sum, from[i]);
    return sum;
}

// A number for a set of vertices, whatever their order.
static inline uint64_t digest_of_row(const uint32_t *row, uint32_t corners) {
    uint64_t sum = corners;
    for (uint32_t i = 0; i < corners; i++) sum += mixed(7, row[i]);
    return mixed(1, sum);
}

typedef struct {
    size_t ids, vertices, cells, staged;
    uint64_t timestamp;
    // Bits of all positions and weights; of each vertex the one that stands for its place; segments in force; what refinement has made,
    // and keys.
    uint64_t positions, representatives, segments, made;
} numbers;

typedef struct {
    // The cells as a set, each with the vertex beyond each of its facets.
    uint64_t cells;
    // The arrays as they are.
    uint64_t rows, neighbours;
} arrays;

// The segments in force, with their ends and markers; in space there are none.
static inline uint64_t digest_of_segments(const deldrift_triangulation *t, uint32_t dimension) {
    size_t count = 0;
    if (dimension != 2) return 0;
    OK(deldrift_segments(t, NULL, NULL, NULL, 0, &count));
    uint32_t *rows = malloc((count + 1) * 4 * sizeof *rows);
    CHECK(rows != NULL);
    OK(deldrift_segments(t, rows, rows + count, (int32_t *)(rows + 3 * count), count, &count));
    const uint64_t digest = digest_of(rows, count * 4 * sizeof *rows);
    free(rows);
    return digest;
}

// Vertices that refinement has inserted, with their weights, and what segments are pieces of; in space there are none.
static inline uint64_t digest_of_made(const deldrift_triangulation *t, uint32_t dimension) {
    size_t n_made = 0, n_segments = 0, n_weights = 0, n_sizes = 0, n_new = 0;
    if (dimension != 2) return 0;
    OK(deldrift_made_vertices(t, NULL, NULL, 0, &n_made));
    OK(deldrift_original_segments(t, NULL, 0, &n_segments));
    OK(deldrift_refined_weights(t, NULL, NULL, 0, &n_weights));
    OK(deldrift_refined_sizes(t, NULL, 0, &n_sizes));
    OK(deldrift_refined_vertices(t, NULL, 0, &n_new));
    const size_t n_ids = 2 * n_made + n_segments + 3 * n_weights + n_new, bytes = n_ids * sizeof(uint32_t);
    uint32_t *ids = malloc(bytes + 1);
    const size_t n_numbers = 3 * n_weights + n_sizes;
    double *weights = malloc(n_numbers * sizeof *weights + 1);
    CHECK(ids != NULL && weights != NULL);
    OK(deldrift_made_vertices(t, ids, ids + n_made, n_made, &n_made));
    OK(deldrift_original_segments(t, ids + 2 * n_made, n_segments, &n_segments));
    OK(deldrift_refined_weights(t, ids + 2 * n_made + n_segments, weights, n_weights, &n_weights));
    OK(deldrift_refined_sizes(t, weights + 3 * n_weights, n_sizes, &n_sizes));
    OK(deldrift_refined_vertices(t, ids + n_ids - n_new, n_new, &n_new));
    const uint64_t digest = mixed(digest_of(ids, bytes), digest_of(weights, n_numbers * sizeof *weights));
    free(ids);
    free(weights);
    return digest;
}

static inline uint64_t digest_of_keys(const deldrift_triangulation *t, size_t n_ids) {
    size_t count = 0;
    uint64_t *keys = malloc((n_ids + 1) * sizeof *keys);
    CHECK(keys != NULL);
    OK(deldrift_keys(t, keys, n_ids + 1, &count));
    const uint64_t digest = digest_of(keys, count * sizeof *keys);
    free(keys);
    return digest;
}

// What can be read without cells being made for the one who reads.
static inline numbers numbers_of(const deldrift_triangulation *t) {
    numbers n = {0};
    uint32_t dimension = 0;
    OK(deldrift_dimension(t, &dimension));
    OK(deldrift_id_count(t, &n.ids));
    OK(deldrift_vertex_count(t, &n.vertices));
    OK(deldrift_cell_count(t, &n.cells));
    OK(deldrift_staged_count(t, &n.staged));
    OK(deldrift_timestamp(t, &n.timestamp));
    double *positions = malloc((n.ids * dimension + 1) * sizeof *positions);
    CHECK(positions != NULL);
    size_t count = 0;
    OK(deldrift_copy_positions(t, positions, n.ids, &count));
    CHECK(count == n.ids);
    n.positions = digest_of(positions, n.ids * dimension * sizeof *positions);
    bool is_weighted = false;
    OK(deldrift_is_weighted(t, &is_weighted));
    if (is_weighted) {
        OK(deldrift_weights(t, positions, n.ids, &count));
        n.positions = mixed(n.positions, digest_of(positions, n.ids * sizeof *positions));
    }
    free(positions);
    for (uint32_t v = 0; v < n.ids; v++) {
        bool present = false;
        uint32_t representative = DELDRIFT_NONE;
        OK(deldrift_is_present(t, v, &present));
        if (present) OK(deldrift_coincident_representative(t, v, &representative));
        n.representatives = mixed(n.representatives, representative);
    }
    // Segments do not serve weights.
    n.segments = is_weighted ? 0 : digest_of_segments(t, dimension);
    n.made = mixed(is_weighted ? 0 : digest_of_made(t, dimension), digest_of_keys(t, n.ids));
    return n;
}

static inline arrays arrays_of(const deldrift_triangulation *t) {
    arrays a = {0};
    deldrift_cells_view view;
    OK(deldrift_cells(t, &view));
    uint32_t corners = view.corners_per_cell;
    for (size_t c = 0; c < view.count; c++) {
        const uint32_t *row = view.vertices + c * corners;
        uint64_t own = digest_of_row(row, corners);
        a.cells += mixed(2, own);
        for (uint32_t i = 0; i < corners; i++) {
            uint32_t across = view.neighbours[c * corners + i];
            CHECK(across == DELDRIFT_NONE || across < view.count);
            uint64_t other = across == DELDRIFT_NONE
                                 ? 3
                                 : digest_of_row(view.vertices + (size_t)across * corners, corners);
            a.cells += mixed(mixed(own, row[i]), other);
        }
    }
    a.rows = digest_of(view.vertices, view.count * corners * sizeof *view.vertices);
    a.neighbours = digest_of(view.neighbours, view.count * corners * sizeof *view.neighbours);
    return a;
}

// What differs; NULL if nothing does.
static inline const char *difference(const numbers *a, const numbers *b) {
    if (a->ids != b->ids) return "other ids";
    if (a->vertices != b->vertices) return "another number of vertices";
    if (a->cells != b->cells) return "another number of cells";
    if (a->staged != b->staged) return "other staged moves";
    if (a->timestamp != b->timestamp) return "another timestamp";
    if (a->positions != b->positions) return "other positions";
    if (a->representatives != b->representatives) return "other vertices hidden";
    if (a->segments != b->segments) return "other segments";
    if (a->made != b->made) return "other origins of vertices and segments, or weights";
    return NULL;
}

// The vertices of the cells by index, as the lists of changes tell.
typedef struct {
    size_t count, room;
    uint32_t *rows;
} mirror;

// The ids are others now.
static inline void renumber(mirror *m, uint32_t corners, const uint32_t *map) {
    for (size_t i = 0; i < m->count * corners; i++) m->rows[i] = map[m->rows[i]];
}

// Checks a list against what was there, and follows it; what is wrong, or NULL.
static inline const char *follow(mirror *m, const deldrift_changes *list, const deldrift_triangulation *t) {
    deldrift_cells_view view;
    OK(deldrift_cells(t, &view));
    const size_t corners = view.corners_per_cell, bytes = corners * sizeof *m->rows;
    size_t room = m->count > view.count ? m->count : view.count;
    if (room > m->room) {
        m->rows = realloc(m->rows, room * bytes);
        CHECK(m->rows != NULL);
        m->room = room;
    }
    for (size_t k = 0; k < list->removed_count; k++) {
        if (list->removed[k] >= m->count) return "removed is what was not there";
        if (memcmp(m->rows + list->removed[k] * corners, list->removed_vertices + k * corners, bytes) != 0) {
            return "another is removed";
        }
    }
    uint32_t *moving = malloc((list->renumbered_count + 1) * bytes);
    CHECK(moving != NULL);
    for (size_t k = 0; k < list->renumbered_count; k++) {
        CHECK(list->renumbered_from[k] < m->count && list->renumbered_to[k] < view.count);
        memcpy(moving + k * corners, m->rows + list->renumbered_from[k] * corners, bytes);
    }
    for (size_t k = 0; k < list->renumbered_count; k++) {
        memcpy(m->rows + list->renumbered_to[k] * corners, moving + k * corners, bytes);
    }
    free(moving);
    for (size_t k = 0; k < list->created_count; k++) {
        CHECK(list->created[k] < view.count);
        memcpy(m->rows + list->created[k] * corners, view.vertices + list->created[k] * corners, bytes);
    }
    m->count = view.count;
    for (size_t c = 0; c < view.count; c++) {
        uint32_t *row = m->rows + c * corners;
        const uint32_t *now = view.vertices + c * corners;
        if (digest_of_row(row, view.corners_per_cell) != digest_of_row(now, view.corners_per_cell)) {
            return "a list that is not right";
        }
        // One that has been turned over has its vertices in another order.
        memcpy(row, now, bytes);
    }
    return NULL;
}

// Times that a test is to do its work, by the environment; 1 if it says nothing.
static inline double soak(void) {
    const char *given = getenv("DELDRIFT_SOAK");
    double factor = given == NULL ? 1 : strtod(given, NULL);
    return factor > 0 ? factor : 1;
}

#endif
