// What the programs of ffi-tests/pairs.rs are made around: one call on a triangulation, and all that can be told of it
// afterwards.
#ifndef HARNESS_H
#define HARNESS_H

#define _POSIX_C_SOURCE 200809L
#include "state.h"

#include <unistd.h>

enum { ROOM = 256, BYTES = 16384, MOST_SAVED = 6 * BYTES, PLACES = 30, N_SEGMENTS = ROOM / 3 };

#include "words.h"

// Of the generated part: each call, as it is written, of which function, whether that changes t, the statuses that the header
// names, as bits, and whether it writes the file at `path`.
typedef struct {
    const char *text, *function;
    bool changes, writes;
    uint64_t documented;
} call;

extern const call calls[];
extern const size_t n_calls;
deldrift_status do_call(size_t k);

// Words of ffi-tests/pairs/rows.rs.
static double in_line[PLACES * 3], nowhere[PLACES * 3], strained[9];
static uint32_t last[1], all_ends[20];
static size_t n_vectors;
static bool is_cancelled;

static bool cancel(void *user_data) {
    (void)user_data;
    return is_cancelled;
}

// The triangulation in use, whose next call is cancelled.
static deldrift_triangulation *cancelled(void) {
    is_cancelled = true;
    return t;
}

static deldrift_triangulation *spare(void) {
    deldrift_triangulation *made = NULL;
    // There is none of a prepared timestamp.
    if (deldrift_clone(t, &made) != DELDRIFT_OK) return NULL;
    return made;
}

static void make_all_arguments(uint32_t d) {
    dimension = d;
    make_arguments();
    for (size_t i = 0; i < PLACES * 3; i++) {
        in_line[i] = points[i - i % d];
        nowhere[i] = i == d ? NAN : points[i];
    }
    for (size_t i = 0; i < d * d; i++) strained[i] = vectors[i] + 0.0625 * (i == 0);
    size_t n = 0;
    for (uint32_t v = 0; v < 5; v++) {
        for (uint32_t w = 0; w < v; w++) all_ends[n++] = w, all_ends[n++] = v;
    }
    finer.greatest_area = 0.01;
    deldrift_options_init(&options);
    options.cancel = cancel;
    n_edges = ROOM / 3;
    memset(&untouched, 0x4d, sizeof untouched);
}

// How many ids there are, cells and vectors: arguments that follow from the triangulation.
typedef struct {
    size_t ids, cells, vectors;
} counts;

static counts counts_of(const deldrift_triangulation *at) {
    counts c;
    OK(deldrift_id_count(at, &c.ids));
    OK(deldrift_cell_count(at, &c.cells));
    OK(deldrift_vectors(at, NULL, 0, &c.vectors));
    return c;
}

static void use_counts(const counts *c) {
    n_ids = c->ids;
    n_cells = c->cells;
    n_vectors = c->vectors;
    last[0] = (uint32_t)(c->ids == 0 ? 0 : c->ids - 1);
}

static uint64_t digest_of_list(uint64_t sum, const void *list, size_t bytes) {
    return mixed(sum, list == NULL ? bytes : digest_of(list, bytes));
}

static uint64_t digest_of_view(const deldrift_cells_view *view) {
    const size_t bytes = view->count * view->corners_per_cell * sizeof *view->vertices;
    return digest_of_list(digest_of_list(view->corners_per_cell, view->vertices, bytes), view->neighbours, bytes);
}

static uint64_t digest_of_changes(const deldrift_changes *c) {
    const size_t size = sizeof *c->created;
    uint64_t sum = digest_of_list(1, c->created, c->created_count * size);
    sum = digest_of_list(sum, c->removed, c->removed_count * size);
    sum = digest_of_list(sum, c->removed_vertices, c->removed_count * (dimension + 1) * size);
    sum = digest_of_list(sum, c->renumbered_from, c->renumbered_count * size);
    sum = digest_of_list(sum, c->renumbered_to, c->renumbered_count * size);
    sum = digest_of_list(sum, c->stars, c->star_count * size);
    sum = digest_of_list(sum, c->hidden, c->hidden_count * size);
    return digest_of_list(sum, c->shown, c->shown_count * size);
}

// What can be told of a triangulation: its bytes; or, while a timestamp is prepared, what is there to be read.
typedef struct {
    deldrift_status saving;
    size_t size, ids, vertices, staged;
    uint64_t timestamp, arrays, positions;
    deldrift_algorithm algorithm;
    // As many bytes as the size says.
    uint8_t saved[MOST_SAVED];
} look;

static void look_at(const deldrift_triangulation *at, look *l) {
    memset(l, 0, offsetof(look, saved));
    deldrift_cells_view view;
    double places[ROOM * 3];
    size_t count;
    l->saving = deldrift_save(at, l->saved, MOST_SAVED, &l->size);
    if (l->saving != DELDRIFT_OK) l->size = 0;
    // Nothing can be told of one that is unusable.
    if (l->saving == DELDRIFT_POISONED) return;
    CHECK(l->saving == DELDRIFT_OK || l->saving == DELDRIFT_PREPARED);
    OK(deldrift_cells(at, &view));
    l->arrays = digest_of_view(&view);
    OK(deldrift_id_count(at, &l->ids));
    OK(deldrift_vertex_count(at, &l->vertices));
    OK(deldrift_staged_count(at, &l->staged));
    OK(deldrift_timestamp(at, &l->timestamp));
    OK(deldrift_get_algorithm(at, &l->algorithm));
    OK(deldrift_copy_positions(at, places, ROOM, &count));
    l->positions = digest_of(places, count * dimension * sizeof *places);
}

// What a call has given.
typedef struct {
    deldrift_status status;
    uint64_t more;
    outputs out;
} answer;

static uint64_t digest_of_file(void) {
    static _Thread_local char bytes[BYTES * 4];
    FILE *file = fopen(path, "rb");
    CHECK(file != NULL);
    const size_t count = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    return digest_of(bytes, count);
}

// What pointers lead to takes their place.
static uint64_t settle_outputs(void) {
    uint64_t sum = 1;
    if (memcmp(&out.cells, &untouched.cells, sizeof out.cells) != 0) {
        sum = mixed(sum, digest_of_view(&out.cells));
        memset(&out.cells, 0, sizeof out.cells);
    }
    if (memcmp(&out.changes, &untouched.changes, sizeof out.changes) != 0) {
        sum = mixed(sum, digest_of_changes(&out.changes));
        memset(&out.changes, 0, sizeof out.changes);
    }
    if (out.handle != untouched.handle) {
        static _Thread_local look made;
        deldrift_changes changes;
        look_at(out.handle, &made);
        OK(deldrift_take_changes(out.handle, &changes));
        sum = mixed(digest_of(&made, offsetof(look, saved) + made.size), digest_of_changes(&changes));
    }
    end_outputs();
    out.handle = untouched.handle;
    out.owner = untouched.owner;
    return sum;
}

static int ascending(const void *a, const void *b) {
    const uint32_t v = *(const uint32_t *)a, w = *(const uint32_t *)b;
    return (v > w) - (v < w);
}

// Lists in no particular order are sorted, and which of the facets that face a place outside is told is left open.
static void order_outputs(const char *function) {
    if (strcmp(function, "deldrift_star") == 0 || strcmp(function, "deldrift_conflicts") == 0) {
        qsort(out.ids, out.count, sizeof *out.ids, ascending);
    }
    if (strncmp(function, "deldrift_locate", 15) == 0) {
        if (out.location.kind == DELDRIFT_LOCATION_OUTSIDE) out.location.index = 0;
        for (size_t k = 0; k < 3; k++) {
            if (out.locations[k].kind != DELDRIFT_LOCATION_OUTSIDE) continue;
            out.locations[k].index = 0;
            memset(out.shifts + k * dimension, 0, dimension * sizeof *out.shifts);
        }
    }
}

// One call on the triangulation in use; what is given is in `out`, too.
static deldrift_status ask(size_t k, uint64_t *more) {
    memset(&out, 0x4d, sizeof out);
    const deldrift_status status = do_call(k);
    if (status == DELDRIFT_OK) {
        *more = settle_outputs();
        if (calls[k].writes) *more = digest_of_file();
        order_outputs(calls[k].function);
    } else {
        *more = digest_of(deldrift_last_error(), strlen(deldrift_last_error()));
    }
    return status;
}

static void ask_for(size_t k, deldrift_triangulation *of, const counts *c, answer *a) {
    t = of;
    use_counts(c);
    a->status = ask(k, &a->more);
    a->out = out;
    is_cancelled = false;
}

#endif
