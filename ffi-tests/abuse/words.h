// The words in which calls are written that ffi-tests/abuse/rows.rs lists: arguments, what is written to, and what makes a
// status of other results. The file that includes this one says how large buffers are, in ROOM and BYTES, for how many points
// there are arguments, in PLACES, and defines spare(), spare_cells(), N_SEGMENTS, saved, saved_size and path_saved, if such calls are in
// it.
#ifndef WORDS_H
#define WORDS_H

#include "check.h"
#include "research_options.h"

enum { COUNT = 13, REMOVED = 5, HIDDEN = 12 };

// All that calls write to.
typedef struct {
    deldrift_triangulation *handle;
    deldrift_released_cells *owner;
    size_t count, edge_count;
    uint64_t timestamp;
    uint32_t number;
    int32_t sign;
    bool flag;
    deldrift_commit_report report;
    deldrift_split_report split;
    deldrift_changes changes;
    deldrift_cells_view cells;
    deldrift_location location, locations[8];
    double numbers[ROOM], more_numbers[ROOM], rows[ROOM], few_numbers[8];
    double facets[ROOM], more_facets[ROOM], facet_rows[ROOM];
    size_t offsets[ROOM];
    uint32_t ids[ROOM], more_ids[ROOM], few_ids[ROOM / 8], fewer_ids[ROOM / 8];
    int32_t labels[ROOM];
    uint64_t keys[ROOM];
    int64_t shifts[ROOM], more_shifts[ROOM];
    deldrift_conflict conflicts[8];
    deldrift_quality quality;
    deldrift_quality_report quality_report;
    deldrift_transfer_report transfer_report;
    uint8_t bytes[BYTES];
} outputs;

// Each thread has its own.
static _Thread_local outputs out;

// What they are before a call.
static outputs untouched;

// The triangulation in use; what is in it.
static uint32_t dimension;
static deldrift_triangulation *t;
static size_t n_ids, n_cells, n_edges;
static uint32_t inner_cell, inner_corner;

// Arguments, which are made again before each call.
static double points[PLACES * 3], moved[PLACES * 3], values[PLACES * 3], inside[PLACES * 3];
static double weights[PLACES * 3];
static double outside[ROOM], low[ROOM], high[ROOM], vectors[PLACES * 3], half_spaces[PLACES * 3];
static uint32_t ids[3], ends[6], segments[2];
static int32_t wholes[ROOM], one_region[ROOM];
static uint64_t keys[COUNT];
static uint8_t mask[ROOM], fenced[ROOM];
static deldrift_options options;
static deldrift_quality finer, coarser;
static double sizes[ROOM];
static deldrift_location near_by[8];
static deldrift_field field;
static _Thread_local char path[300];

// Functions that give no status: what they do as one.
static inline deldrift_status told(const char *said) {
    return said != NULL && strlen(said) < 512 ? DELDRIFT_OK : DELDRIFT_INTERNAL_ERROR;
}

static deldrift_status destroyed(deldrift_triangulation *which) {
    int32_t sign;
    CHECK_STATUS(deldrift_orientation(9, points, &sign), DELDRIFT_INVALID_DIMENSION);
    deldrift_destroy(which);
    const char *said = deldrift_last_error();
    if (strncmp(said, "dimension is 9", 14) == 0) return DELDRIFT_OK;
    return strncmp(said, "t is in use", 11) == 0 ? DELDRIFT_BUSY : DELDRIFT_MISALIGNED_ARGUMENT;
}

static inline deldrift_status initialised(deldrift_options *given) {
    deldrift_options_init(given);
    return DELDRIFT_OK;
}

static inline deldrift_status freed(deldrift_released_cells *owner) {
    deldrift_free_cells(owner);
    return DELDRIFT_OK;
}

// Makes arguments as they are before every call.
static void make_arguments(void) {
    uint64_t seed = 3;
    for (size_t i = 0; i < sizeof points / sizeof *points; i++) points[i] = next_random(&seed);
    memcpy(points + HIDDEN * dimension, points + 3 * dimension, dimension * sizeof *points);
    for (size_t i = 0; i < sizeof points / sizeof *points; i++) moved[i] = points[i] + 0.01 * next_random(&seed);
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) values[i] = (double)i;
    for (size_t i = 0; i < sizeof inside / sizeof *inside; i++) inside[i] = 0.5;
    // Of vertices that are not the hull's some are hidden by weight.
    for (size_t i = 0; i < sizeof weights / sizeof *weights; i++) weights[i] = i % 2 == 1 ? -4 : 0.01 * next_random(&seed);
    // Its rows are the axes, each with a bit of the one before.
    for (size_t i = 0; i < dimension * dimension; i++) {
        vectors[i] = i % (dimension + 1) == 0 ? 1 : i % (dimension + 1) == dimension ? 0.25 : 0;
    }
    // Two: x is at most 0.5, and at least 0.25.
    memset(half_spaces, 0, sizeof half_spaces);
    half_spaces[0] = 2, half_spaces[dimension] = 1;
    half_spaces[dimension + 1] = -1, half_spaces[2 * dimension + 1] = -0.25;
    for (size_t i = 0; i < 3; i++) {
        low[i] = -1;
        high[i] = 2;
        ids[i] = (uint32_t[]){0, 1, 4}[i];
    }
    for (size_t i = 0; i < ROOM; i++) wholes[i] = -5 * (int32_t)i, one_region[i] = 3;
    for (size_t i = 0; i < COUNT; i++) keys[i] = 7 * i % 5;
    for (size_t i = 0; i < 6; i++) ends[i] = (uint32_t[]){0, 1, 4, 2, 8, 11}[i];
    for (size_t i = 0; i < 2; i++) segments[i] = (uint32_t)(2 - 2 * i);
    for (size_t i = 0; i < ROOM; i++) sizes[i] = 1;
    OK(deldrift_quality_init(&finer));
    coarser = finer;
    finer.greatest_area = 0.001;
    outside[0] = outside[1] = 7;
    memset(mask, 1, sizeof mask);
    mask[0] = 0;
    near_by[0] = (deldrift_location){DELDRIFT_LOCATION_VERTEX, 1};
    field = (deldrift_field){"field", sizes, 1};
}

static inline const char *name_of(deldrift_status status) {
    static const char *const names[] = {STATUS_NAMES};
    return status < sizeof names / sizeof *names ? names[status] : "an unknown status";
}

// Ends what a call has handed out.
static void end_outputs(void) {
    if (out.handle != untouched.handle) deldrift_destroy(out.handle);
    if (out.owner != untouched.owner) deldrift_free_cells(out.owner);
}

#endif
