// The triangulations that the walker begins with. Each is made by its own calls, again and again.
#ifndef STATES_H
#define STATES_H

#include "harness.h"

typedef deldrift_triangulation *(*making)(void);
typedef deldrift_triangulation *(*changing)(deldrift_triangulation *of);

// What a triangulation is made of, what has happened to it since, in which dimensions that is walked, and whether calls on it are
// made at the same time, too.
typedef struct {
    const char *name;
    making make;
    changing then;
    bool in_plane, in_space, meets;
} state;

static deldrift_triangulation *of_points(const double *at, size_t count) {
    deldrift_triangulation *made = NULL;
    OK(deldrift_create(dimension, at, count, &options, &made));
    return made;
}

static deldrift_triangulation *plain(void) { return of_points(points, 9); }
// Two at one place.
static deldrift_triangulation *coincident(void) { return of_points(points, COUNT); }
static deldrift_triangulation *flat(void) { return of_points(in_line, 6); }
static deldrift_triangulation *single(void) { return of_points(points, 1); }
static deldrift_triangulation *none(void) { return of_points(NULL, 0); }

static deldrift_triangulation *lattice(void) {
    double at[27];
    const size_t side = dimension == 2 ? 3 : 2, count = dimension == 2 ? 9 : 8;
    for (size_t k = 0, i = 0; k < count; k++) {
        for (size_t axis = 0, rest = k; axis < dimension; axis++, rest /= side) at[i++] = (double)(rest % side);
    }
    return of_points(at, count);
}

static deldrift_triangulation *keyed(void) {
    deldrift_triangulation *made = NULL;
    OK(deldrift_create_with_keys(dimension, points, keys, 9, &options, &made));
    return made;
}

// Some are hidden by weight, and two at one place.
static deldrift_triangulation *weighted(void) {
    deldrift_triangulation *made = NULL;
    double middle[COUNT * 3];
    for (size_t i = 0; i < COUNT * dimension; i++) middle[i] = i / dimension % 2 == 1 ? 0.4 + 0.2 * points[i] : points[i];
    memcpy(middle + HIDDEN * dimension, middle + 3 * dimension, dimension * sizeof *middle);
    OK(deldrift_create_weighted(dimension, middle, weights, NULL, COUNT, &options, &made));
    return made;
}

static deldrift_triangulation *weighted_in_line(void) {
    deldrift_triangulation *made = NULL;
    OK(deldrift_create_weighted(dimension, in_line, weights, keys, 6, &options, &made));
    return made;
}

// A fence around a cell, two more segments from its first corner, of which one has been removed.
static deldrift_triangulation *fenced_in(void) {
    deldrift_triangulation *made = plain();
    uint32_t segment, around[6], corner[3];
    const deldrift_cells_view view = cells_of(made);
    size_t inner = 0;
    for (size_t k = 0; k < 3; k++) inner = view.neighbours[3 * inner + k] == DELDRIFT_NONE ? inner + 1 : inner;
    memcpy(corner, view.vertices + 3 * (inner % view.count), sizeof corner);
    for (size_t k = 0; k < 3; k++) around[2 * k] = corner[k], around[2 * k + 1] = corner[(k + 1) % 3];
    OK(deldrift_stage_segments(made, around, (int32_t[]){5, -5, 0}, 3, &segment));
    OK(deldrift_stage_segments(made, (uint32_t[]){around[1], around[0]}, NULL, 1, &segment));
    OK(deldrift_commit_timestamp(made, NULL));
    OK(deldrift_stage_segment_removals(made, &segment, 1));
    OK(deldrift_commit_timestamp(made, NULL));
    return made;
}

static deldrift_triangulation *refusing(void) {
    options.passing = DELDRIFT_PASSING_REFUSE;
    return fenced_in();
}

static deldrift_triangulation *refined(void) {
    deldrift_triangulation *made = fenced_in();
    uint32_t levels[ROOM];
    uint8_t within[ROOM];
    size_t count;
    deldrift_quality quality = finer;
    deldrift_quality_report report;
    OK(deldrift_nesting_levels(made, levels, ROOM, &count));
    for (size_t c = 0; c < count; c++) within[c] = levels[c] == 1;
    quality.greatest_area = 0.02;
    quality.has_weights = 1;
    OK(deldrift_refine(made, &quality, within, count, &report));
    return made;
}

// Segments that cross each other are staged, and a check has told so.
static deldrift_triangulation *crossing(void) {
    deldrift_triangulation *made = plain();
    uint32_t segment;
    OK(deldrift_stage_segments(made, all_ends, NULL, 10, &segment));
    CHECK_STATUS(deldrift_check_staged(made), DELDRIFT_CROSSING);
    return made;
}

static deldrift_triangulation *split(void) {
    deldrift_triangulation *made = crossing();
    OK(deldrift_stage_splits(made, 99, NULL));
    return made;
}

static deldrift_triangulation *in_box_of(const double *at, size_t count, uint32_t n) {
    deldrift_triangulation *made = NULL;
    OK(deldrift_create_periodic(dimension, at, count, vectors, n, &options, &made));
    return made;
}

static deldrift_triangulation *box(void) { return in_box_of(points, 8 - dimension, dimension); }
static deldrift_triangulation *box_of_one(void) { return in_box_of(points, 1, dimension); }
static deldrift_triangulation *slab(void) { return in_box_of(points, 6, dimension - 1); }
static deldrift_triangulation *rod(void) { return in_box_of(points, 6, 1); }

// The first one is there twice, once in another period.
static deldrift_triangulation *box_with_hidden(void) {
    double at[PLACES * 3];
    memcpy(at, points, sizeof at);
    for (size_t axis = 0; axis < dimension; axis++) at[2 * dimension + axis] = points[axis] + vectors[axis];
    return in_box_of(at, 5, dimension);
}

// Some are hidden by weight, and the first one is there twice, once in another period.
static deldrift_triangulation *weighted_box(void) {
    deldrift_triangulation *made = NULL;
    double at[PLACES * 3];
    for (size_t i = 0; i < 8 * dimension; i++) at[i] = i / dimension % 2 == 1 ? 0.4 + 0.2 * points[i] : points[i];
    for (size_t axis = 0; axis < dimension; axis++) at[2 * dimension + axis] = points[axis] + vectors[axis];
    OK(deldrift_create_periodic_weighted(dimension, at, weights, 7, vectors, dimension, &options, &made));
    return made;
}

static deldrift_triangulation *as_it_is(deldrift_triangulation *of) { return of; }

static deldrift_triangulation *without_two(deldrift_triangulation *of) {
    OK(deldrift_remove_vertex(of, 2));
    OK(deldrift_stage_removals(of, (uint32_t[]){3}, 1));
    OK(deldrift_commit_timestamp(of, NULL));
    return of;
}

// A move, an insertion and a removal are staged; and what there is of segments.
static deldrift_triangulation *edited(deldrift_triangulation *of) {
    uint32_t first;
    size_t n, count = 0;
    OK(deldrift_id_count(of, &n));
    if (n > 2) OK(deldrift_move_vertex(of, 1, moved));
    OK(deldrift_stage_insertions(of, moved + 3 * dimension, 1, &first));
    if (n > 5) OK(deldrift_stage_removals(of, (uint32_t[]){5}, 1));
    if (dimension == 2 && deldrift_segments(of, NULL, NULL, NULL, 0, &count) == DELDRIFT_OK && count > 0) {
        OK(deldrift_stage_segment_removals(of, (uint32_t[]){0}, 1));
        OK(deldrift_stage_segments(of, (uint32_t[]){0, 4}, NULL, 1, &first));
    }
    return of;
}

static deldrift_triangulation *prepared(deldrift_triangulation *of) {
    OK(deldrift_prepare_timestamp(edited(of), NULL));
    return of;
}

static deldrift_triangulation *withdrawn(deldrift_triangulation *of) {
    OK(deldrift_withdraw_timestamp(prepared(of)));
    return of;
}

static deldrift_triangulation *loaded(deldrift_triangulation *of) {
    static uint8_t bytes[MOST_SAVED];
    size_t size;
    deldrift_algorithm algorithm;
    OK(deldrift_save(of, bytes, sizeof bytes, &size));
    OK(deldrift_get_algorithm(of, &algorithm));
    deldrift_destroy(of);
    OK(deldrift_load(bytes, size, &options, &of));
    OK(choose(of, algorithm));
    return of;
}

static deldrift_triangulation *edited_and_loaded(deldrift_triangulation *of) { return loaded(edited(of)); }

static deldrift_triangulation *compacted(deldrift_triangulation *of) {
    uint32_t map[ROOM];
    size_t count;
    OK(deldrift_compact(edited(without_two(of)), map, ROOM, &count));
    return of;
}

// A copy of one whose changes have been taken.
static deldrift_triangulation *cloned(deldrift_triangulation *of) {
    deldrift_triangulation *made = NULL;
    deldrift_changes changes;
    OK(deldrift_take_changes(of, &changes));
    OK(deldrift_clone(edited(of), &made));
    deldrift_destroy(of);
    return made;
}

// Vertices are to come with keys where there have been none.
static deldrift_triangulation *keys_coming(deldrift_triangulation *of) {
    uint32_t first;
    OK(deldrift_stage_insertions_with_keys(of, moved, keys + 1, 2, &first));
    return of;
}

// Of one vertex the place is to change, of another one the weight.
static deldrift_triangulation *reweighted(deldrift_triangulation *of) {
    OK(deldrift_stage_weights(of, (uint32_t[]){3}, (double[]){0.5}, 1));
    return edited(of);
}

static deldrift_triangulation *reweighted_and_loaded(deldrift_triangulation *of) { return loaded(reweighted(of)); }

// One is to come under the highest id, which another one had.
static deldrift_triangulation *free_ids(deldrift_triangulation *of) {
    uint32_t given[1];
    OK(deldrift_remove_vertex(of, 8));
    OK(deldrift_stage_insertions_at_free_ids(of, moved, NULL, 1, given));
    CHECK(given[0] == 8);
    return of;
}

// While one is to come, a higher id has been given, and is forgotten by a compaction.
static deldrift_triangulation *higher_gone(deldrift_triangulation *of) {
    uint32_t v, map[ROOM];
    size_t count;
    OK(deldrift_stage_insertions(of, moved, 1, &v));
    OK(deldrift_insert_vertex(of, inside, &v));
    OK(deldrift_remove_vertex(of, v));
    OK(deldrift_compact(of, map, ROOM, &count));
    return of;
}

// Tolerances are kept.
static deldrift_triangulation *kept(deldrift_triangulation *of) {
    OK(deldrift_set_algorithm(of, DELDRIFT_TOLERANCE));
    for (int k = 0; k < 3; k++) {
        OK(deldrift_move_vertex(of, 0, k % 2 == 0 ? moved : points));
        OK(deldrift_commit_timestamp(of, NULL));
    }
    return of;
}

static deldrift_triangulation *strained_soon(deldrift_triangulation *of) {
    OK(deldrift_stage_vectors(edited(of), strained, dimension));
    return of;
}

// Of boxes in space, where a walk takes the longest, there are few.
static const state states[] = {
    {"plain", plain, as_it_is, true, true, false},
    {"plain, two removed", plain, without_two, true, false, false},
    {"plain, edited", plain, edited, true, true, true},
    {"plain, prepared", plain, prepared, true, true, false},
    {"plain, withdrawn", plain, withdrawn, true, false, false},
    {"plain, loaded", plain, edited_and_loaded, true, true, false},
    {"plain, compacted", plain, compacted, true, true, false},
    {"plain, cloned", plain, cloned, true, false, false},
    {"plain, keys coming", plain, keys_coming, true, false, false},
    {"plain, free ids", plain, free_ids, true, false, false},
    {"plain, a higher id gone", plain, higher_gone, true, false, false},
    {"plain, tolerances kept", plain, kept, true, true, false},
    {"coincident", coincident, as_it_is, true, false, false},
    {"coincident, edited", coincident, edited, true, true, false},
    {"coincident, compacted", coincident, compacted, true, false, false},
    {"flat", flat, as_it_is, true, false, false},
    {"flat, edited", flat, edited, true, true, false},
    {"single", single, edited, true, false, false},
    {"none", none, as_it_is, true, true, false},
    {"lattice", lattice, edited, true, true, false},
    {"keyed", keyed, as_it_is, true, false, false},
    {"keyed, edited", keyed, edited, true, true, true},
    {"keyed, loaded", keyed, edited_and_loaded, true, false, false},
    {"keyed, compacted", keyed, compacted, true, false, false},
    {"weighted, edited", weighted, reweighted, true, true, true},
    {"weighted, prepared", weighted, prepared, true, false, false},
    {"weighted, loaded", weighted, reweighted_and_loaded, true, false, false},
    {"weighted, compacted", weighted, compacted, true, false, false},
    {"weighted in a line", weighted_in_line, edited, true, false, false},
    {"segments", fenced_in, as_it_is, true, false, false},
    {"segments, edited", fenced_in, edited, true, false, false},
    {"segments, prepared", fenced_in, prepared, true, false, false},
    {"segments, loaded", fenced_in, edited_and_loaded, true, false, false},
    {"segments, compacted", fenced_in, compacted, true, false, false},
    {"segments, cloned", fenced_in, cloned, true, false, false},
    {"segments, passing refused", refusing, as_it_is, true, false, false},
    {"segments that cross", crossing, as_it_is, true, false, false},
    {"segments to be split", split, as_it_is, true, false, false},
    {"segments to be split, loaded", split, loaded, true, false, false},
    {"refined", refined, as_it_is, true, false, false},
    {"refined, edited", refined, edited, true, false, true},
    {"refined, loaded", refined, edited_and_loaded, true, false, false},
    {"refined, compacted", refined, compacted, true, false, false},
    {"box", box, as_it_is, true, false, false},
    {"box, two removed", box, without_two, true, false, false},
    {"box, edited", box, edited, true, false, true},
    {"box, prepared", box, prepared, true, false, false},
    {"box, loaded", box, loaded, true, false, false},
    {"box, edited and loaded", box, edited_and_loaded, true, true, true},
    {"box, compacted", box, compacted, true, false, false},
    {"box, cloned", box, cloned, true, false, false},
    {"box, vectors staged", box, strained_soon, true, false, false},
    {"box, one vertex", box_of_one, as_it_is, true, false, false},
    {"box, one hidden", box_with_hidden, edited, true, false, false},
    {"box, weighted, edited", weighted_box, reweighted, true, false, true},
    {"box, weighted, loaded", weighted_box, reweighted_and_loaded, true, false, false},
    {"slab", slab, edited, true, false, false},
    {"slab, loaded", slab, edited_and_loaded, true, false, false},
    {"rod", rod, edited, false, true, false},
};

#endif
