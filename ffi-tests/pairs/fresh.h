// The triangulation that is made anew of the places, keys, weights, segments and vectors of another one has the same cells.
#ifndef FRESH_H
#define FRESH_H

#include "harness.h"

// The cells as a set, each with the vertex beyond each of its facets, and the periods of both.
static uint64_t set_of_cells(const deldrift_triangulation *at, const uint32_t *names) {
    static int64_t shifts[ROOM * 12], across[ROOM * 12];
    deldrift_cells_view view;
    size_t count;
    OK(deldrift_cells(at, &view));
    CHECK(view.count <= ROOM);
    OK(deldrift_cell_shifts(at, shifts, across, ROOM, &count));
    const size_t corners = view.corners_per_cell;
    uint64_t all = view.count;
    for (size_t c = 0; c < view.count; c++) {
        uint64_t cell = corners;
        for (size_t k = c * corners; k < (c + 1) * corners; k++) {
            const uint32_t v = view.vertices[k];
            uint64_t beyond = 3;
            for (size_t i = 0; view.neighbours[k] != DELDRIFT_NONE && i < corners; i++) {
                const uint32_t w = view.vertices[view.neighbours[k] * corners + i];
                beyond += mixed(11, names == NULL ? w : names[w]);
            }
            uint64_t own = mixed(mixed(7, names == NULL ? v : names[v]), beyond);
            own = mixed(own, digest_of(shifts + k * dimension, dimension * sizeof *shifts));
            cell += mixed(own, digest_of(across + k * dimension, dimension * sizeof *across));
        }
        all += mixed(2, cell);
    }
    return all;
}

static bool has_weights(const deldrift_triangulation *of) {
    bool is_weighted;
    OK(deldrift_is_weighted(of, &is_weighted));
    return is_weighted;
}

static deldrift_triangulation *built(const double *at, const uint64_t *names, const double *weighing, size_t count,
                                     const double *box, uint32_t n_box) {
    deldrift_triangulation *made = NULL;
    if (weighing != NULL && n_box > 0) {
        OK(deldrift_create_periodic_weighted(dimension, at, weighing, count, box, n_box, NULL, &made));
    } else if (weighing != NULL) {
        OK(deldrift_create_weighted(dimension, at, weighing, names, count, NULL, &made));
    } else if (n_box > 0) {
        OK(deldrift_create_periodic(dimension, at, count, box, n_box, NULL, &made));
    } else {
        OK(deldrift_create_with_keys(dimension, at, names, count, NULL, &made));
    }
    return made;
}

// Stages the segments in force between vertices of other ids, and lays them.
static void lay(deldrift_triangulation *made, const deldrift_triangulation *of, const uint32_t *index) {
    uint32_t all[ROOM], ends_of[2 * ROOM], first;
    size_t count;
    OK(deldrift_segments(of, all, ends_of, NULL, ROOM, &count));
    for (size_t k = 0; k < 2 * count; k++) ends_of[k] = index[ends_of[k]];
    OK(deldrift_stage_segments(made, ends_of, NULL, count, &first));
    OK(deldrift_commit_timestamp(made, NULL));
}

// What is wrong with a triangulation of which nothing is prepared, or NULL.
static const char *difference_from_fresh(const deldrift_triangulation *of) {
    double places[ROOM * 3], weighing[ROOM], box[9], *at = places;
    uint64_t names[ROOM];
    uint32_t index[ROOM], ids_of[ROOM], first, expected;
    size_t n, count = 0, n_box;
    OK(deldrift_vectors(of, box, 3, &n_box));
    OK(deldrift_copy_positions(of, places, ROOM, &n));
    for (size_t v = 0; v < n; v++) names[v] = v;
    if (n_box == 0) OK(deldrift_keys(of, names, ROOM, &n));
    const bool is_weighted = has_weights(of);
    if (is_weighted) OK(deldrift_weights(of, weighing, ROOM, &n));
    for (uint32_t v = 0; v < n; v++) {
        bool present;
        OK(deldrift_is_present(of, v, &present));
        if (!present) continue;
        memmove(at, places + v * dimension, dimension * sizeof *at);
        at += dimension;
        names[count] = names[v];
        weighing[count] = weighing[v];
        index[v] = (uint32_t)count;
        ids_of[count++] = v;
    }
    deldrift_triangulation *made = built(places, names, is_weighted ? weighing : NULL, count, box, (uint32_t)n_box);
    if (dimension == 2 && n_box == 0 && !is_weighted) lay(made, of, index);
    const char *wrong = NULL;
    if (set_of_cells(of, NULL) != set_of_cells(made, ids_of)) wrong = "other cells than those of a fresh build";
    for (uint32_t v = 0; v < count && wrong == NULL; v++) {
        OK(deldrift_coincident_representative(of, ids_of[v], &first));
        OK(deldrift_coincident_representative(made, v, &expected));
        if (first != ids_of[expected]) wrong = "other vertices stand for places than in a fresh build";
    }
    if (wrong == NULL && deldrift_validate(of, 3) != DELDRIFT_OK) wrong = "it is not valid";
    deldrift_destroy(made);
    return wrong;
}

#endif
