// What the program of ffi-tests/abuse.rs is made around: a triangulation, arguments for calls on it, and the check of
// what comes of a call.
#ifndef HARNESS_H
#define HARNESS_H

#define _POSIX_C_SOURCE 200809L
#include "state.h"

#include <malloc.h>
#include <pthread.h>
#include <stdarg.h>
#include <unistd.h>

// Segments in the plane: a fence around a cell, two more at one of its edges, of which one is removed and the other is to be,
// and one that is staged.
enum { N_SEGMENTS = 4, LEAVING_SEGMENT = 3, REMOVED_SEGMENT = 4, COMING_SEGMENT = 5, N_SEGMENT_IDS = 6 };

enum { STAGED = 7, LEAVING = 6, COMING = 13 };

// How many entries buffers have, how many bytes, and how many points are given at most.
enum { ROOM = 1024, BYTES = 16384, PLACES = 15 };

#include "words.h"

// The triangulations that calls are made on: with moves, insertions and removals staged; without; that, with the cell
// within the fence refined; prepared; with changes taken; and two with weights, with edits and without.
typedef enum { WITH_EDITS, WITHOUT_EDITS, REFINED, PREPARED, TAKEN, WEIGHTED, WEIGHTED_WITHOUT_EDITS, N_BASES } base;

// The bases.
static deldrift_triangulation *bases[N_BASES];
static uint32_t fence[3];

// One that has been saved.
static uint8_t saved[BYTES];
static size_t saved_size;
static char path_saved[320];

static const double one_direction[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
static uint64_t greatest_keys[COUNT];
static void *odd;

static size_t n_tried, n_wrong;

// What can be seen of a triangulation.
typedef struct {
    numbers numbers;
    arrays arrays;
    deldrift_algorithm algorithm;
    deldrift_commit_report sums;
    size_t size;
    uint8_t saved[BYTES];
} state;

static state kept[N_BASES], now;

static void look(const deldrift_triangulation *at, state *s) {
    memset(s, 0, sizeof *s);
    s->numbers = numbers_of(at);
    s->arrays = arrays_of(at);
    OK(deldrift_get_algorithm(at, &s->algorithm));
    OK(deldrift_statistics(at, &s->sums));
    // What is prepared is not saved.
    const deldrift_status status = deldrift_save(at, s->saved, BYTES, &s->size);
    CHECK(status == DELDRIFT_OK || status == DELDRIFT_PREPARED);
}

static const char *text(const char *format, ...) {
    static char made[2][1000];
    static size_t turn;
    turn = 1 - turn;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(made[turn], sizeof *made, format, arguments);
    va_end(arguments);
    return made[turn];
}

// A copy of an array of coordinates, with another number at this place.
static double *bad(const double *from, size_t at, double value) {
    static double made[PLACES * 3];
    memcpy(made, from, sizeof made);
    made[at] = value;
    return made;
}

static uint32_t *bad_ids(size_t at, uint32_t value) {
    static uint32_t made[3];
    memcpy(made, ids, sizeof made);
    made[at] = value;
    return made;
}

// The last end another one.
static uint32_t *bad_ends(uint32_t value) {
    static uint32_t made[6];
    memcpy(made, ends, sizeof made);
    made[5] = value;
    return made;
}

static uint32_t *bad_segments(uint32_t value) {
    static uint32_t made[2];
    made[0] = segments[0];
    made[1] = value;
    return made;
}

static int32_t *two_in_a_region(void) {
    one_region[0] = -1;
    return one_region;
}

static int32_t *bad_wholes(size_t at, int32_t value) {
    static int32_t made[ROOM];
    memcpy(made, wholes, sizeof made);
    made[at] = value;
    return made;
}

// Seeds of which the first is at a corner of the fence.
static double *on_fence(void) {
    static double made[PLACES * 3];
    memcpy(made, inside, sizeof made);
    memcpy(made, points + fence[0] * dimension, dimension * sizeof *made);
    return made;
}

static deldrift_options *bad_options(size_t size, deldrift_algorithm algorithm) {
    static deldrift_options made;
    made = options;
    made.struct_size = size;
    made.algorithm = algorithm;
    return &made;
}

// A quality that differs in a member.
static deldrift_quality bad_quality;

static double *bad_sizes(size_t at, double value) {
    static double changed[ROOM];
    memcpy(changed, sizes, sizeof changed);
    changed[at] = value;
    return changed;
}

static deldrift_field *bad_field(const char *name, const double *numbers, size_t components) {
    static deldrift_field made;
    made = (deldrift_field){name, numbers, components};
    return &made;
}

static deldrift_location *location_of(uint32_t kind, uint32_t index) {
    static uint32_t made[2];
    made[0] = kind;
    made[1] = index;
    return (deldrift_location *)(void *)made;
}

static uint8_t *damaged(size_t at) {
    static uint8_t made[BYTES];
    memcpy(made, saved, saved_size);
    made[at] ^= 4;
    return made;
}

static void *shifted(const void *data, size_t size) {
    static double made[BYTES / sizeof(double)];
    return memcpy((char *)made + 1, data, size);
}

static deldrift_triangulation *spare(void) {
    deldrift_triangulation *made = NULL;
    OK(deldrift_clone(bases[0], &made));
    return made;
}

static deldrift_released_cells *spare_cells(void) {
    deldrift_triangulation *made = spare();
    deldrift_released_cells *owner = NULL;
    deldrift_cells_view view;
    OK(deldrift_release_cells(made, &view, &owner));
    deldrift_destroy(made);
    return owner;
}

// Arguments and outputs as they are before every call.
static void before(void) {
    make_arguments();
    memset(&out, 0x4d, sizeof out);
}

static void wrong(const char *function, const char *argument, const char *given, const char *what) {
    fprintf(stderr, "%uD, %s, %s: %s: %s\n", dimension, function, argument, given, what);
    n_wrong++;
}

// What must be so after a call that fails: it says why, and has written nothing. Functions with a count tell how much
// room they need.
static void check_refusal(const char *function, const char *argument, const char *given, deldrift_status status,
                          deldrift_status expected, const char *message, bool has_count) {
    if (status != expected) wrong(function, argument, given, text("%s (%s)", name_of(status), deldrift_last_error()));
    if (strstr(deldrift_last_error(), message) == NULL) {
        wrong(function, argument, given, text("\"%s\" is not in \"%s\"", message, deldrift_last_error()));
    }
    if (status == DELDRIFT_BUFFER_TOO_SMALL && has_count) {
        if (out.count == untouched.count) wrong(function, argument, given, "the count is not told");
        out.count = untouched.count;
        // Where there are two, both are told.
        out.edge_count = untouched.edge_count;
    }
    if (memcmp(&out, &untouched, sizeof out) != 0) wrong(function, argument, given, "an output is written");
}

static void report(const char *function, const char *argument, const char *column, const char *given,
                   deldrift_status status) {
    n_tried++;
    const char *said = status == DELDRIFT_OK ? "" : deldrift_last_error();
    printf("%u\t%s\t%s\t%s\t%s\t%s\t%s\n", dimension, function, argument, column, given, name_of(status), said);
}

// The cells within the fence.
static void mask_fence(const deldrift_triangulation *of) {
    uint32_t levels[ROOM];
    OK(deldrift_nesting_levels(of, levels, ROOM, &n_cells));
    for (size_t c = 0; c < n_cells; c++) fenced[c] = levels[c] == 1;
}

static void use_base(base which) {
    if (t != NULL) deldrift_destroy(t);
    t = NULL;
    OK(deldrift_clone(bases[which], &t));
    if (which == PREPARED) OK(deldrift_prepare_timestamp(t, NULL));
    if (which == TAKEN) {
        // Of two times, as many cells were as there are.
        deldrift_changes changes;
        OK(deldrift_take_changes(t, &changes));
        OK(deldrift_take_changes(t, &changes));
    }
    OK(deldrift_id_count(t, &n_ids));
    OK(deldrift_cell_count(t, &n_cells));
    if (dimension == 2 && which < WEIGHTED) mask_fence(t);
}

// After a call: `message` is what has to be said, NULL if the call is legal.
static void after(const char *function, const char *argument, const char *column, const char *given,
                  deldrift_status status, deldrift_status expected, const char *message, base which,
                  bool has_count) {
    report(function, argument, column, given, status);
    if (expected == DELDRIFT_OK) {
        if (status != DELDRIFT_OK) wrong(function, argument, given, deldrift_last_error());
        if (status == DELDRIFT_OK) end_outputs();
        // What it may have changed is made again.
        use_base(which);
        return;
    }
    check_refusal(function, argument, given, status, expected, message, has_count);
    look(t, &now);
    if (memcmp(&now, &kept[which], sizeof now) != 0) {
        const char *what = difference(&now.numbers, &kept[which].numbers);
        wrong(function, argument, given, what != NULL ? what : "another state");
        use_base(which);
    }
}

#define CASE(function, argument, column, given, expected, message, call)                           \
    do {                                                                                           \
        before();                                                                                  \
        const char *wanted = (message);                                                            \
        deldrift_status status = (call);                                                           \
        after(function, argument, column, given, status, expected, wanted, BASE, HAS_COUNT);       \
    } while (0)

// Of the generated part: the functions, which of them take a triangulation, and a call of each with arguments that
// are all right.
typedef struct {
    const char *name;
    bool takes_t, of_plane;
    base base;
    bool has_count, refuses_periodic, refuses_weights, needs_weights;
    void (*cases)(void);
} function;

extern const function functions[];
extern const size_t n_functions;
deldrift_status call(size_t k);

static bool is_intruding;

// All calls on a triangulation that may not be used now.
static void all_are_refused(const char *column, const char *given, deldrift_status expected, const char *message) {
    for (size_t k = 0; k < n_functions; k++) {
        const function *f = &functions[k];
        if (f->of_plane && dimension == 3) continue;
        if (!f->takes_t) continue;
        bool destroys = strcmp(f->name, "deldrift_destroy") == 0;
        // It is destroyed in the end, and is no duty of this function.
        if (destroys && expected == DELDRIFT_POISONED) continue;
        before();
        deldrift_status status = destroys ? destroyed(t) : call(k);
        report(f->name, "t", column, given, status);
        check_refusal(f->name, "t", given, status, expected, message, f->has_count);
    }
}

static void all_others_work(const char *column, const char *given) {
    for (size_t k = 0; k < n_functions; k++) {
        if (functions[k].takes_t) continue;
        before();
        deldrift_status status = call(k);
        report(functions[k].name, "", column, given, status);
        if (status != DELDRIFT_OK) wrong(functions[k].name, "", given, deldrift_last_error());
        end_outputs();
    }
}

static void *from_a_thread_during_a_call(void *unused) {
    all_are_refused("thread", "during a commit", DELDRIFT_BUSY, "t is in use");
    return unused;
}

// The path of the first thread, for others.
static char first_path[300];

static void *from_a_thread(void *unused) {
    memcpy(path, first_path, sizeof path);
    for (size_t k = 0; k < n_functions; k++) {
        const function *f = &functions[k];
        if (f->of_plane && dimension == 3) continue;
        use_base(f->base);
        before();
        deldrift_status status = call(k);
        report(f->name, "", "thread", "between calls", status);
        if (status != DELDRIFT_OK) wrong(f->name, "", "from another thread", deldrift_last_error());
        end_outputs();
    }
    return unused;
}

static void in_a_thread(void *(*work)(void *)) {
    pthread_t thread;
    CHECK(pthread_create(&thread, NULL, work, NULL) == 0);
    CHECK(pthread_join(thread, NULL) == 0);
}

static bool intrude(void *user_data) {
    (void)user_data;
    if (is_intruding) {
        is_intruding = false;
        all_are_refused("callback", "from its callback", DELDRIFT_BUSY, "t is in use");
        all_others_work("callback", "from a callback");
        in_a_thread(from_a_thread_during_a_call);
    }
    return false;
}

// Calls from a callback of a commit, and meanwhile from another thread: the commit then does what it would have done.
static void calls_during_a_commit(void) {
    use_base(WITH_EDITS);
    deldrift_triangulation *control = spare();
    OK(deldrift_commit_timestamp(control, NULL));
    is_intruding = true;
    OK(deldrift_commit_timestamp(t, NULL));
    CHECK(!is_intruding);
    static state expected;
    look(control, &expected);
    look(t, &now);
    if (memcmp(&now, &expected, sizeof now) != 0) {
        wrong("deldrift_commit_timestamp", "t", "used meanwhile", "another state");
    }
    deldrift_destroy(control);
}

// Poisons the triangulation in use: finds the flag for that at the end of what the handle points to, by its effect. A
// program cannot bring about the internal error that would set it.
static uint8_t *poison(void) {
    size_t size = malloc_usable_size(t);
    uint8_t *bytes = (uint8_t *)t;
    uint64_t timestamp;
    for (size_t i = size - 1; i >= size - 16; i--) {
        uint8_t before_that = bytes[i];
        bytes[i] = 1;
        if (deldrift_timestamp(t, &timestamp) == DELDRIFT_POISONED) return bytes + i;
        bytes[i] = before_that;
    }
    CHECK(!"a flag that poisons");
    return NULL;
}

static void periodic_ones_are_refused_or_served(void) {
    use_base(WITH_EDITS);
    deldrift_triangulation *const open = t, *made = NULL;
    deldrift_cells_view view, as_before;
    before();
    OK(deldrift_create_periodic(dimension, points, COUNT, vectors, dimension, NULL, &made));
    OK(deldrift_cells(made, &view));
    size_t n_refused = 0, n_served = 0;
    for (size_t k = 0; k < n_functions; k++) {
        const function *f = &functions[k];
        if (!f->takes_t || (f->of_plane && dimension == 3)) continue;
        before();
        OK(deldrift_clone(made, &t));
        const deldrift_status status = call(k);
        if (f->refuses_periodic) {
            check_refusal(f->name, "t", "periodic", status, DELDRIFT_PERIODIC, "t is periodic", f->has_count);
            n_refused++;
        } else {
            if (status == DELDRIFT_PERIODIC) wrong(f->name, "t", "periodic", "the header does not say that it is refused");
            n_served++;
        }
        end_outputs();
        deldrift_destroy(t);
        t = open;
    }
    CHECK(n_refused > 10 && n_served > 60);
    before();
    size_t count;
    CHECK_STATUS(deldrift_voronoi_volumes(made, low, high, out.numbers, ROOM, &count), DELDRIFT_INVALID_VALUE);
    CHECK_STATUS(deldrift_voronoi_facets(made, low, NULL, out.numbers, ROOM, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_voronoi_cells(made, NULL, high, NULL, 0, NULL, NULL, NULL, 0, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_voronoi_derivatives(made, low, high, NULL, 0, NULL, NULL, NULL, 0, &count), DELDRIFT_INVALID_VALUE);
    OK(deldrift_cells(made, &as_before));
    CHECK(as_before.vertices == view.vertices && as_before.count == view.count);
    deldrift_destroy(made);
}

static void weighted_ones_are_refused_or_served(void) {
    size_t n_refused = 0, n_served = 0, n_needing = 0;
    for (size_t k = 0; k < n_functions; k++) {
        const function *f = &functions[k];
        if (!f->takes_t || (f->of_plane && dimension == 3)) continue;
        if (f->needs_weights) {
            use_base(WITH_EDITS);
            before();
            const deldrift_status status = call(k);
            check_refusal(f->name, "t", "without weights", status, DELDRIFT_NOT_WEIGHTED, "t has no weights", f->has_count);
            n_needing++;
            continue;
        }
        use_base(f->base == WITH_EDITS ? WEIGHTED : WEIGHTED_WITHOUT_EDITS);
        before();
        const deldrift_status status = call(k);
        if (f->refuses_weights) {
            check_refusal(f->name, "t", "weighted", status, DELDRIFT_WEIGHTED, "t has weights", f->has_count);
            n_refused++;
        } else {
            if (status == DELDRIFT_WEIGHTED) wrong(f->name, "t", "weighted", "the header does not say that it is refused");
            n_served++;
        }
        end_outputs();
    }
    CHECK(n_refused > 1 && n_served > 50 && n_needing == 7);
    use_base(WITH_EDITS);
}

static void poisoned_ones_can_be_destroyed(void) {
    use_base(WITH_EDITS);
    uint8_t *flag = poison();
    all_are_refused("poisoned", "poisoned", DELDRIFT_POISONED, "t is unusable");
    *flag = 0;
    look(t, &now);
    if (memcmp(&now, &kept[0], sizeof now) != 0) wrong("all", "t", "poisoned", "another state");
    *flag = 1;
    deldrift_status status = destroyed(t);
    report("deldrift_destroy", "t", "poisoned", "poisoned", status);
    CHECK(status == DELDRIFT_OK);
    t = NULL;
}

// A cell none of whose corners moves or goes.
static void choose_fence(const deldrift_triangulation *base) {
    const deldrift_cells_view view = cells_of(base);
    for (size_t c = 0; c < view.count; c++) {
        bool is_fit = true;
        for (int i = 0; i < 3; i++) {
            const uint32_t v = fence[i] = view.vertices[3 * c + (size_t)i];
            is_fit = is_fit && v != 1 && v != REMOVED && v != LEAVING && v != STAGED && v != HIDDEN && v != 3;
        }
        if (is_fit) return;
    }
    CHECK(!"a cell for the fence");
}

static void stage_segment(deldrift_triangulation *base, int side, uint32_t wanted) {
    const uint32_t ends_of[] = {fence[side], fence[(side + 1) % 3]};
    uint32_t segment;
    OK(deldrift_stage_segments(base, ends_of, NULL, 1, &segment));
    CHECK(segment == wanted);
}

static void lay_segments(deldrift_triangulation *base) {
    choose_fence(base);
    for (uint32_t k = 0; k < 5; k++) stage_segment(base, (int)(k % 3), k);
    OK(deldrift_commit_timestamp(base, NULL));
    OK(deldrift_stage_segment_removals(base, (uint32_t[]){REMOVED_SEGMENT}, 1));
    OK(deldrift_commit_timestamp(base, NULL));
}

static void refine_fence(deldrift_triangulation *of) {
    deldrift_quality quality = finer;
    deldrift_quality_report report;
    quality.greatest_area = 0.005;
    quality.has_weights = 1;
    double sizes[COUNT];
    for (int v = 0; v < COUNT; v++) sizes[v] = INFINITY;
    quality.sizes = sizes;
    quality.size_count = COUNT;
    mask_fence(of);
    OK(deldrift_refine(of, &quality, fenced, n_cells, &report));
    CHECK(report.inserted > 2);
}

static void make_bases(void) {
    deldrift_options_init(&options);
    options.cancel = intrude;
    before();
    uint32_t first;
    OK(deldrift_create(dimension, points, COUNT, &options, &bases[0]));
    OK(deldrift_remove_vertex(bases[0], REMOVED));
    OK(deldrift_commit_timestamp(bases[0], NULL));
    if (dimension == 2) lay_segments(bases[0]);
    OK(deldrift_clone(bases[0], &bases[WITHOUT_EDITS]));
    OK(deldrift_clone(bases[0], &bases[REFINED]));
    if (dimension == 2) refine_fence(bases[REFINED]);
    OK(deldrift_move_vertex(bases[0], STAGED, moved));
    OK(deldrift_stage_insertions(bases[0], moved, 1, &first));
    OK(deldrift_stage_removals(bases[0], (uint32_t[]){LEAVING}, 1));
    if (dimension == 2) {
        OK(deldrift_stage_segment_removals(bases[0], (uint32_t[]){LEAVING_SEGMENT}, 1));
        stage_segment(bases[0], 0, COMING_SEGMENT);
    }
    OK(deldrift_clone(bases[0], &bases[PREPARED]));
    OK(deldrift_clone(bases[WITHOUT_EDITS], &bases[TAKEN]));
    // Half of them are well inside, and hidden by weight.
    double middle[COUNT * 3];
    for (size_t i = 0; i < COUNT * dimension; i++) middle[i] = i / dimension % 2 == 1 ? 0.4 + 0.2 * points[i] : points[i];
    OK(deldrift_create_weighted(dimension, middle, weights, NULL, COUNT, &options, &bases[WEIGHTED]));
    OK(deldrift_remove_vertex(bases[WEIGHTED], REMOVED));
    OK(deldrift_commit_timestamp(bases[WEIGHTED], NULL));
    OK(deldrift_clone(bases[WEIGHTED], &bases[WEIGHTED_WITHOUT_EDITS]));
    OK(deldrift_move_vertex(bases[WEIGHTED], STAGED, moved));
    OK(deldrift_stage_insertions(bases[WEIGHTED], moved, 1, &first));
    OK(deldrift_stage_removals(bases[WEIGHTED], (uint32_t[]){LEAVING}, 1));
    for (base k = 0; k < N_BASES; k++) {
        use_base(k);
        look(t, &kept[k]);
    }
    OK(deldrift_save(bases[0], saved, BYTES, &saved_size));
    OK(deldrift_save_file(bases[0], path_saved));
    OK(deldrift_cell_count(bases[0], &n_cells));
    OK(deldrift_edges(bases[0], NULL, 0, &n_edges));
    deldrift_cells_view view;
    OK(deldrift_cells(bases[0], &view));
    CHECK(n_cells * view.corners_per_cell * 4 < ROOM);
    size_t at = 0;
    while (view.neighbours[at] == DELDRIFT_NONE) at++;
    inner_cell = (uint32_t)(at / view.corners_per_cell);
    inner_corner = (uint32_t)(at % view.corners_per_cell);
}

// Whatever has been tried, what is pending is still there: changes, and moves to be committed.
static void nothing_is_lost(void) {
    use_base(WITH_EDITS);
    deldrift_triangulation *both[2] = {t, bases[0]};
    size_t created[2], stars[2];
    static state ends[2];
    for (int k = 0; k < 2; k++) {
        deldrift_changes changes;
        OK(deldrift_take_changes(both[k], &changes));
        created[k] = changes.created_count;
        stars[k] = changes.star_count;
        OK(deldrift_commit_timestamp(both[k], NULL));
        OK(deldrift_validate(both[k], 3));
        look(both[k], &ends[k]);
    }
    CHECK(created[0] > 0 && created[0] == created[1] && stars[0] == stars[1]);
    CHECK(memcmp(&ends[0], &ends[1], sizeof *ends) == 0);
}

static void try_all(void) {
    static double somewhere[8];
    memset(greatest_keys, 255, sizeof greatest_keys);
    odd = (char *)somewhere + 1;
    memset(&untouched, 0x4d, sizeof untouched);
    const char *folder = getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/deldrift-abuse-%d", folder == NULL ? "/tmp" : folder, (int)getpid());
    memcpy(first_path, path, sizeof path);
    snprintf(path_saved, sizeof path_saved, "%s-saved", path);
    for (dimension = 2; dimension <= 3; dimension++) {
        make_bases();
        for (size_t k = 0; k < n_functions; k++) {
            use_base(functions[k].base);
            functions[k].cases();
        }
        calls_during_a_commit();
        periodic_ones_are_refused_or_served();
        weighted_ones_are_refused_or_served();
        poisoned_ones_can_be_destroyed();
        in_a_thread(from_a_thread);
        nothing_is_lost();
        deldrift_destroy(t);
        t = NULL;
        for (int k = 0; k < N_BASES; k++) deldrift_destroy(bases[k]);
    }
    unlink(path);
    unlink(path_saved);
    if (n_wrong > 0) {
        fprintf(stderr, "%zu of %zu calls are not as they should be\n", n_wrong, n_tried);
        exit(1);
    }
}

#endif
