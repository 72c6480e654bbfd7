// What the test programs share: checks that end the program and say where.
#ifndef CHECK_H
#define CHECK_H

#include "condition.h"

#include <deldrift.h>
#include <deldrift/research.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

// The call gives this status.
#define CHECK_STATUS(call, expected) check_status((call), (expected), #call, __FILE__, __LINE__)

// The call succeeds.
#define OK(call) CHECK_STATUS(call, DELDRIFT_OK)

// The message of the last failure contains this text.
#define CHECK_MESSAGE(part)                                                                         \
    do {                                                                                            \
        if (strstr(deldrift_last_error(), (part)) == NULL) {                                        \
            fprintf(stderr, "%s:%d: \"%s\" is not in \"%s\"\n", __FILE__, __LINE__, (part),         \
                    deldrift_last_error());                                                         \
            exit(1);                                                                                \
        }                                                                                           \
    } while (0)

// SIZE_MAX, as messages write it.
#if SIZE_MAX > UINT32_MAX
#define MOST_ENTRIES "18446744073709551615"
#else
#define MOST_ENTRIES "4294967295"
#endif

static inline void check_status(deldrift_status status, deldrift_status expected, const char *call,
                                const char *file, int line) {
    if (status != expected) {
        fprintf(stderr, "%s:%d: %s gave \"%s\" (%s) and not \"%s\"\n", file, line, call,
                deldrift_status_string(status), deldrift_last_error(), deldrift_status_string(expected));
        exit(1);
    }
}

// Numbers from 0 to 1, the same in every run.
static inline double next_random(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

static inline double *random_positions(uint32_t dimension, size_t count, uint64_t seed) {
    double *positions = malloc((count * dimension + 1) * sizeof *positions);
    CHECK(positions != NULL);
    for (size_t i = 0; i < count * dimension; i++) positions[i] = next_random(&seed);
    return positions;
}

// Algorithms of deldrift/research.h, and those for tests, are chosen after creation.
static inline bool is_of_research(deldrift_algorithm algorithm) { return algorithm >= DELDRIFT_RESEARCH_PLACEMENT; }

static inline deldrift_status choose(deldrift_triangulation *t, deldrift_algorithm algorithm) {
    if (is_of_research(algorithm)) return deldrift_research_set_algorithm(t, algorithm, NULL);
    return deldrift_set_algorithm(t, algorithm);
}

static inline deldrift_triangulation *create(uint32_t dimension, const double *positions, size_t count,
                                             const deldrift_options *options) {
    deldrift_triangulation *t = NULL;
    if (options != NULL && is_of_research(options->algorithm)) {
        deldrift_options at_creation = *options;
        at_creation.algorithm = DELDRIFT_AUTO;
        OK(deldrift_create(dimension, positions, count, &at_creation, &t));
        OK(choose(t, options->algorithm));
    } else {
        OK(deldrift_create(dimension, positions, count, options, &t));
    }
    CHECK(t != NULL);
    return t;
}

static inline size_t cell_count(const deldrift_triangulation *t) {
    size_t count = SIZE_MAX;
    OK(deldrift_cell_count(t, &count));
    return count;
}

// ALL_ALGORITHMS, for an array, and BY_WATCHING and so on for those that have no name in a header, come from the
// command line: see ffi-tests/algorithms.rs.

// The corners of a quadrilateral, and of a tetrahedron, with a vertex inside: four cells, without ties.
static const double SQUARE[] = {0, 0, 4, 0, 5, 5, 0, 4, 1, 2};
enum { SQUARE_COUNT = 5 };
static const double TETRAHEDRON[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 0.5, 0.5, 0.75};
enum { TETRAHEDRON_COUNT = 5 };

static inline deldrift_cells_view cells_of(const deldrift_triangulation *t) {
    deldrift_cells_view view;
    memset(&view, 255, sizeof view);
    OK(deldrift_cells(t, &view));
    return view;
}

static inline bool has_corner(const uint32_t *cell, uint32_t corners, uint32_t vertex) {
    for (uint32_t i = 0; i < corners; i++) {
        if (cell[i] == vertex) return true;
    }
    return false;
}

#endif
