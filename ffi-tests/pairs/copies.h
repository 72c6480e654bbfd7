// What a copy that has been saved and loaded has in common with the original, and what it has not.
#ifndef COPIES_H
#define COPIES_H

#include "fresh.h"

static bool is_periodic(const deldrift_triangulation *at) {
    size_t count;
    OK(deldrift_vectors(at, NULL, 0, &count));
    return count > 0;
}

static uint64_t number_at(const uint8_t *bytes, size_t at) {
    uint64_t number;
    memcpy(&number, bytes + at, sizeof number);
    return number;
}

// What is in the bytes but the indices of cells, and counts of what algorithms have done; of what repeats, what is known by its
// vertices. That is what a loaded copy has in common with the original from the next change of cells on.
static void look_at_sets(const deldrift_triangulation *at, look *l) {
    look_at(at, l);
    if (l->saving == DELDRIFT_POISONED) return;
    l->arrays = set_of_cells(at, NULL);
    // What algorithms choose by is not saved, nor are options.
    l->algorithm = 0;
    if (l->saving != DELDRIFT_OK) return;
    if (is_periodic(at)) {
        l->size = 0;
        return;
    }
    uint8_t *const bytes = l->saved;
    const uint64_t n = number_at(bytes, 24), m = number_at(bytes, 32);
    const uint64_t moving = number_at(bytes, 40), coming = number_at(bytes, 48);
    // With weights there are cells below vertices before the rows, and a weight behind each position.
    const size_t one = has_weights(at), before = 168 + (n + moving + coming) * (dimension + one) * 8 + n * 4;
    memset(bytes + before, 0, one * n * 4 + m * (dimension + 1) * 8);
    // Vertices moved, inserted and removed are counted by all alike.
    memset(bytes + 80, 0, 9 * 8);
    memset(bytes + l->size - 4, 0, 4);
}

static bool is_of(size_t k, const char *function) { return strcmp(calls[k].function, function) == 0; }

// Answers of what a saved triangulation does not have with it.
static bool is_not_saved(size_t k) {
    return is_of(k, "deldrift_take_changes") || is_of(k, "deldrift_clone") || is_of(k, "deldrift_segment_conflicts") ||
           is_of(k, "deldrift_passings") || is_of(k, "deldrift_refined_weights") ||
           is_of(k, "deldrift_refined_vertices") || is_of(k, "deldrift_refined_sizes") ||
           is_of(k, "deldrift_transfer_cells");
}

// What is rounded in an order that follows from slots of the kernel, which are not saved.
static bool is_rounded_by_slots(size_t k) {
    static const char *const all[] = {"circumcentres",  "volumes",   "cells_in_reach",  "tolerance",  "interpolate",
                                      "voronoi_volumes", "voronoi_facets", "voronoi_cells", "voronoi_derivatives",
                                      "voronoi_cells_within", "voronoi_derivatives_within", "voronoi_cells_and_facets", "voronoi_weight_derivatives",
                                      "annulus_widths",
                                      "standard_delimiter"};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const char *const at = strstr(calls[k].function, all[i]);
        if (at != NULL && strlen(at) == strlen(all[i])) return true;
    }
    return false;
}

// Whether a call tells what the latest call that changes or checks has found: not what a triangulation is, and nothing that
// clones have. tests/last_found.rs has what each call leaves. Changes that have been taken belong to the original alone, too.
static bool is_of_latest_call(size_t k) {
    return is_of(k, "deldrift_transfer_cells") || is_of(k, "deldrift_segment_conflicts") || is_of(k, "deldrift_passings");
}

#endif
