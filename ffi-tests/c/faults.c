// Calls for which there is no memory. One request for memory of a call is refused: alone, with all later ones, or with
// those later ones that would have as much held; the three take turns. The call gives DELDRIFT_OUT_OF_MEMORY, or does
// without. After a failure everything is as before, and the same call then gives what it would have given. Nothing is
// printed, and all memory is given back in the end.
//
// DELDRIFT_SOAK multiplies the number of faults; below 1 some calls are left out.
#include "scenes.h"

#include <signal.h>
#include <unistd.h>

// Of the requests of a call, the first `FIRST` are refused in turn, and `SPREAD` more at even distances.
enum { FIRST = 6, SPREAD = 4 };

typedef struct {
    size_t faults, clean, absorbed, changed;
} tally;

static tally tallies[N_KINDS];
static size_t n_shown;

// Where the program is, for one that ends here.
static char place[200] = "before the first call";

static void tell_where(int signal) {
    (void)signal;
    (void)!__real_write(2, "ended at: ", 10);
    (void)!__real_write(2, place, strlen(place));
    (void)!__real_write(2, "\n", 1);
    _exit(1);
}

// What there is after a call that has succeeded, and after one commit more.
typedef struct {
    uint64_t given;
    numbers now, later;
    uint64_t cells, later_cells;
} ending;

static const char *end_of(scene *s, ending *end) {
    const char *wrong = NULL;
    // What conflicts would do so again.
    if (s->setting->conflicts) OK(deldrift_discard_moves(s->t));
    end->now = numbers_of(s->t);
    end->cells = arrays_of(s->t).cells;
    if (s->setting->takes) wrong = take(s);
    OK(deldrift_commit_timestamp(s->t, NULL));
    if (deldrift_validate(s->t, 3) != DELDRIFT_OK) return "no triangulation after the next commit";
    end->later = numbers_of(s->t);
    end->later_cells = arrays_of(s->t).cells;
    if (s->setting->takes && wrong == NULL) wrong = take(s);
    return wrong;
}

// How a scene is before its call, and what comes of that without faults.
typedef struct {
    numbers before;
    deldrift_commit_report sums;
    size_t n_requests;
    arrays arrays;
    deldrift_status status;
    ending end;
} control;

static control control_of(uint32_t dimension, call call, const setting *setting) {
    control c;
    const char *wrong = NULL;
    scene s = make_scene(dimension, call, setting);
    c.before = numbers_of(s.t);
    OK(deldrift_statistics(s.t, &c.sums));
    c.status = make_call(&s, SIZE_MAX, NONE_LATER, &c.end.given, &wrong);
    c.n_requests = n_requests;
    const bool has_conflicts = setting->conflicts && is_commit(call.kind) && call.kind != STAGE_SPLITS;
    const deldrift_status other = call.kind == CHECK_PASSINGS ? DELDRIFT_PASSES_SEGMENT : DELDRIFT_NO_SUCH_FACET;
    CHECK(has_conflicts ? c.status == DELDRIFT_CROSSING : c.status == DELDRIFT_OK || c.status == other);
    if (wrong == NULL) wrong = end_of(&s, &c.end);
    if (wrong != NULL) fprintf(stderr, "%s without a fault: %s\n", NAMES[call.kind], wrong);
    CHECK(wrong == NULL);
    end_scene(&s);
    s = make_scene(dimension, call, setting);
    c.arrays = arrays_of(s.t);
    end_scene(&s);
    return c;
}

// One fault; what is wrong, or NULL. `looks` if the cells are read after a failure, even if nobody had.
static const char *fault(scene *s, const control *c, size_t k, later too, bool looks, bool *has_failed) {
    const char *wrong = NULL;
    ending end;
    deldrift_status status = make_call(s, k, too, &end.given, &wrong);
    CHECK(n_refused > 0);
    if (n_written > 0) return "something is printed";
    if (wrong != NULL) return wrong;
    *has_failed = status == DELDRIFT_OUT_OF_MEMORY;
    if (*has_failed) {
        numbers now = numbers_of(s->t);
        deldrift_commit_report sums;
        OK(deldrift_statistics(s->t, &sums));
        wrong = difference(&now, &c->before);
        if (wrong != NULL) return wrong;
        if (memcmp(&sums, &c->sums, sizeof sums) != 0) return "other sums";
        if (deldrift_validate(s->t, 3) != DELDRIFT_OK) return "no triangulation";
        if (looks || s->setting->reads) {
            arrays there = arrays_of(s->t);
            if (there.cells != c->arrays.cells) return "other cells";
            if (s->setting->reads && memcmp(&there, &c->arrays, sizeof there) != 0) return "other rows of cells";
        }
        // What is carried over goes by the latest list of changes.
        if (looks && s->setting->takes && s->call.kind != TRANSFER_CELLS) wrong = take(s);
        if (wrong != NULL) return wrong;
        status = make_call(s, SIZE_MAX, NONE_LATER, &end.given, &wrong);
        if (wrong != NULL) return wrong;
    }
    if (status != c->status) return deldrift_status_string(status);
    if (end.given != c->end.given) return "it gives something else";
    wrong = end_of(s, &end);
    if (wrong == NULL) wrong = difference(&end.now, &c->end.now);
    if (wrong == NULL && end.cells != c->end.cells) wrong = "other cells in the end";
    if (wrong == NULL) wrong = difference(&end.later, &c->end.later);
    if (wrong == NULL && end.later_cells != c->end.later_cells) wrong = "other cells after the next commit";
    return wrong;
}

static void faults_of(uint32_t dimension, call call, size_t which, double share, size_t turn) {
    const setting *setting = &SETTINGS[which];
    // Of those that are in a line without end most images are there.
    const bool is_periodic = is_periodic_call(call.kind) || call.kind == CREATE_PERIODIC_WEIGHTED;
    if (setting->weighted ? refuses_weights(call.kind) : is_of_weights(call.kind)) return;
    if (is_periodic && (setting->n > 100 || setting->stages > 0)) return;
    // And so many bytes.
    if (call.kind == PERIODIC_LOAD && setting->is_flat) return;
    // Segments are of the plane; a set without them has nothing to check.
    const bool is_of_segments = call.kind == CHECK_STAGED || call.kind == CHECK_PASSINGS || call.kind == STAGE_SPLITS;
    if (setting->segments > 0 ? dimension == 3 : is_of_segments) return;
    // There for what several threads build.
    bool builds = call.kind == CREATE || call.kind == CREATE_WITH_KEYS || (call.kind == COMMIT && call.algorithm == DELDRIFT_REBUILDING);
    if (setting->n > 1000 && !builds) return;
    // Larger ones are slower.
    share *= setting->n > 1000 ? 3 : setting->n > 100 ? 0.5 : 1;
    size_t most = (size_t)(share * (FIRST + SPREAD) + 0.5), n_first = (size_t)(share * FIRST + 0.5);
    if (most == 0) {
        size_t period = (size_t)(1 / (share * (FIRST + SPREAD)));
        if (turn % period != 0) return;
        most = 1;
    }
    control c = control_of(dimension, call, setting);
    tally *sum = &tallies[call.kind];
    for (size_t round = 0; round < most; round++) {
        size_t k = round, n_rest = c.n_requests > n_first ? c.n_requests - n_first : 0;
        if (most == 1) {
            k = turn * 7 % (c.n_requests + 1);
        } else if (round >= n_first && n_rest > most - n_first) {
            k = n_first + ((round - n_first) * n_rest + turn % n_rest) / (most - n_first) % n_rest;
        }
        if (k >= c.n_requests) break;
        later too = (later)((round + turn) % 3);
        bool has_failed = false;
        const char *others = (const char *[]){"", " and all later ones", " and all beyond it"}[too];
        snprintf(place, sizeof place, "%s, %uD, algorithm %u, goal %d, setting %zu: request %zu of %zu%s",
                 NAMES[call.kind], dimension, call.algorithm, call.goal, which, k, c.n_requests, others);
        size_t blocks_before = n_blocks;
        scene s = make_scene(dimension, call, setting);
        const char *wrong = fault(&s, &c, k, too, (round + turn) % 2 == 0, &has_failed);
        end_scene(&s);
        if (wrong == NULL && n_blocks != blocks_before) wrong = "memory is not given back";
        sum->faults++;
        sum->clean += wrong == NULL && has_failed;
        sum->absorbed += wrong == NULL && !has_failed;
        sum->changed += wrong != NULL;
        if (wrong != NULL && n_shown++ < 30) fprintf(stderr, "%s: %s\n", place, wrong);
    }
}

// The first calls of a process make what later ones have.
static void the_first_calls_need_no_more_than_others(void) {
    deldrift_triangulation *t = NULL;
    size_t count;
    count_requests(0, ALL_LATER);
    CHECK_STATUS(deldrift_vertex_count(NULL, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK(n_requests == 0);
    CHECK_STATUS(deldrift_create(2, SQUARE, SQUARE_COUNT, NULL, &t), DELDRIFT_OUT_OF_MEMORY);
    CHECK_STATUS(deldrift_create(3, TETRAHEDRON, TETRAHEDRON_COUNT, NULL, &t), DELDRIFT_OUT_OF_MEMORY);
    CHECK_MESSAGE("bytes");
    stop_counting();
    // Otherwise the requests of the library are not seen here at all.
    CHECK(t == NULL && n_refused >= 2 && n_written == 0);
}

static deldrift_released_cells *released_cells(deldrift_triangulation *t) {
    deldrift_cells_view view;
    deldrift_released_cells *owner;
    OK(deldrift_release_cells(t, &view, &owner));
    return owner;
}

// A copy, whose staged moves are prepared.
static deldrift_triangulation *prepared_copy(const deldrift_triangulation *t) {
    deldrift_triangulation *copy;
    OK(deldrift_clone(t, &copy));
    OK(deldrift_prepare_timestamp(copy, NULL));
    return copy;
}

// One with weights, of the vertices of a scene.
static deldrift_triangulation *weighted_of(const scene *s) {
    deldrift_triangulation *made;
    OK(deldrift_create_weighted(s->dimension, s->points, weights_of(s->n, s->dimension, 0), NULL, s->n, NULL, &made));
    return made;
}

// All functions whose documentation does not name DELDRIFT_OUT_OF_MEMORY.
static void other_functions_ask_for_nothing(uint32_t dimension) {
    const call some = {COMMIT_SOME, DELDRIFT_AUTO, 0};
    scene s = make_scene(dimension, some, &SETTINGS[6]);
    uint32_t number;
    size_t count;
    uint64_t timestamp;
    bool present, is_weighted;
    double position[3];
    deldrift_triangulation *const weighted = weighted_of(&s);
    deldrift_released_cells *const owner = released_cells(s.t);
    scene refined = make_scene(2, (call){COARSEN, DELDRIFT_AUTO, 0}, &SETTINGS[0]);
    size_t n_made, n_segments, n_weights;
    deldrift_triangulation *const trial = prepared_copy(s.t);
    count_requests(0, ALL_LATER);
    deldrift_free_cells(owner);
    deldrift_options options;
    deldrift_options_init(&options);
    CHECK(strlen(deldrift_version()) > 0 && strlen(deldrift_status_string(DELDRIFT_OK)) > 0);
    OK(deldrift_dimension(s.t, &number));
    OK(deldrift_get_algorithm(s.t, &number));
    OK(deldrift_vertex_count(s.t, &count));
    OK(deldrift_keys(s.t, NULL, 0, &count));
    OK(deldrift_vectors(s.t, NULL, 0, &count));
    OK(deldrift_reduced_vectors(s.t, NULL, NULL, NULL, 0, &count));
    OK(deldrift_cell_count(s.t, &count));
    OK(deldrift_staged_count(s.t, &count));
    OK(deldrift_memory_bytes(s.t, &count));
    OK(deldrift_id_count(s.t, &count));
    OK(deldrift_timestamp(s.t, &timestamp));
    OK(deldrift_is_present(s.t, 3, &present));
    OK(deldrift_position(s.t, 3, position));
    CHECK_STATUS(deldrift_position(s.t, 1u << 30, position), DELDRIFT_NO_SUCH_VERTEX);
    CHECK(strlen(deldrift_last_error()) > 0);
    OK(deldrift_copy_positions(s.t, numbers_out, ROOM / 3, &count));
    OK(deldrift_is_weighted(weighted, &is_weighted));
    OK(deldrift_weights(weighted, numbers_out, ROOM, &count));
    CHECK_STATUS(deldrift_weights(s.t, numbers_out, ROOM, &count), DELDRIFT_NOT_WEIGHTED);
    if (dimension == 2) {
        OK(deldrift_segments(s.t, ids_out, NULL, NULL, ROOM, &count));
        OK(deldrift_segment_conflicts(s.t, NULL, 0, &count));
        OK(deldrift_passings(s.t, NULL, NULL, 0, &count));
        OK(deldrift_set_segment_sides(s.t, NULL, NULL, 0));
    }
    OK(deldrift_made_vertices(refined.t, ids_out, more_out, ROOM, &n_made));
    OK(deldrift_original_segments(refined.t, ids_out, ROOM, &n_segments));
    OK(deldrift_refined_weights(refined.t, ids_out, numbers_out, ROOM / 3, &n_weights));
    OK(deldrift_refined_sizes(refined.t, numbers_out, ROOM, &count));
    OK(deldrift_refined_vertices(refined.t, ids_out, ROOM, &count));
    deldrift_quality quality;
    OK(deldrift_quality_init(&quality));
    int32_t sign;
    static const double flat[15] = {0, 0, 0, 1, 1e-300, 0, 0, 1, 0, 1, 1, 1e-300, 1, 1e-300, 1};
    OK(deldrift_orientation(dimension, flat, &sign));
    OK(deldrift_in_sphere(dimension, flat, &sign));
    OK(deldrift_in_power_sphere(dimension, flat, flat, &sign));
    OK(deldrift_research_within_safe_region(s.t, &timestamp));
    OK(deldrift_research_set_algorithm(s.t, DELDRIFT_RESEARCH_PLACEMENT, NULL));
    OK(deldrift_set_algorithm(s.t, DELDRIFT_TOLERANCE));
    OK(deldrift_discard_moves(s.t));
    deldrift_destroy(s.t);
    OK(deldrift_publish_timestamp(trial));
    OK(deldrift_withdraw_timestamp(trial));
    stop_counting();
    deldrift_destroy(trial);
    deldrift_destroy(weighted);
    CHECK(n_requests == 0 && n_written == 0);
    CHECK(n_made > 0 && n_segments > 3 && n_weights == n_made);
    end_scene(&refined);
    s.t = NULL;
    end_scene(&s);
}

// The first cells of a flat set are created in the change list, or, without the memory for that, are not in it: when
// fewer cells are there at the next call, only these are listed.
static void first_cells_are_listed_once(void) {
    enum { COUNT = 40 };
    deldrift_options options;
    deldrift_options_init(&options);
    options.threads = 1;
    bool has_failed = true;
    for (size_t k = 0; has_failed; k++) {
        double positions[2 * COUNT];
        for (size_t i = 0; i < COUNT; i++) {
            positions[2 * i] = (double)i;
            positions[2 * i + 1] = 0;
        }
        deldrift_triangulation *t = create(2, positions, COUNT, &options);
        deldrift_changes changes;
        deldrift_cells_view view;
        OK(deldrift_take_changes(t, &changes));
        CHECK(changes.created_count == 0);
        for (size_t i = 0; i < COUNT; i++) positions[2 * i + 1] = (double)(i * 7 % 11);
        OK(deldrift_move_vertices(t, NULL, positions, COUNT));
        OK(deldrift_commit_timestamp(t, NULL));
        count_requests(k, NONE_LATER);
        deldrift_status status = deldrift_take_changes(t, &changes);
        stop_counting();
        has_failed = status == DELDRIFT_OUT_OF_MEMORY;
        if (has_failed) {
            for (uint32_t v = 0; v < COUNT / 2; v++) OK(deldrift_remove_vertex(t, v));
            OK(deldrift_take_changes(t, &changes));
        } else {
            CHECK(status == DELDRIFT_OK && n_refused == 0 && k >= 5);
        }
        OK(deldrift_cells(t, &view));
        CHECK(view.count > 0 && changes.created_count == view.count && changes.removed_count == 0);
        for (size_t c = 0; c < view.count; c++) CHECK(changes.created[c] == c);
        deldrift_destroy(t);
    }
}

// Of what is not periodic.
static void checks_ask_for_nothing(void) {
    size_t count;
    scene s = make_scene(2, (call){CELLS, DELDRIFT_AUTO, 0}, &SETTINGS[2]);
    count_requests(0, ALL_LATER);
    OK(deldrift_hidden_vertices(s.t, ids_out, more_out, ROOM, &count));
    OK(deldrift_validate(s.t, 3));
    stop_counting();
    CHECK(n_refused == 0 && count > 0);
    end_scene(&s);
}

int main(void) {
    static const deldrift_algorithm all[] = ALL_ALGORITHMS;
    struct sigaction action = {.sa_handler = tell_where};
    sigaction(SIGABRT, &action, NULL);
    double factor = soak();
    the_first_calls_need_no_more_than_others();
    checks_ask_for_nothing();
    first_cells_are_listed_once();
    size_t turn = 0;
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        other_functions_ask_for_nothing(dimension);
        for (size_t which = 0; which < N_SETTINGS; which++) {
            for (kind k = 0; k < N_KINDS; k++) {
                bool is_of_one = k == RELOCATE || k == INSERT || k == INSERT_WITH_KEY || k == REMOVE || k == LOCATE ||
                                 k == LOCATE_POINTS || k == NEAREST || k == NEAREST_VERTICES || k == CONFLICTS ||
                                 k == COMMIT_WEIGHTED || k == SET_WEIGHT || k == INSERT_WITH_WEIGHT ||
                                 k == REPRESENTATIVE;
                // Moves and edits that are staged already would be in the way.
                if (SETTINGS[which].edits && (k == STAGE_REMOVALS || k == MOVE_ALL)) continue;
                if (dimension == 3 && is_of_plane(k)) continue;
                if (is_commit(k)) {
                    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
                        faults_of(dimension, (call){k, all[i], 0}, which, factor, turn++);
                    }
                } else {
                    for (int goal = 0; goal < (is_of_one ? 3 : 1); goal++) {
                        deldrift_algorithm algorithm =
                            is_of_one ? DELDRIFT_RESEARCH_SAFE_REGION_TOLERANCE : DELDRIFT_AUTO;
                        faults_of(dimension, (call){k, algorithm, goal}, which, factor, turn++);
                    }
                }
            }
        }
    }
    tally sum = {0, 0, 0, 0};
    printf("%-34s%8s%8s%10s%9s\n", "", "faults", "clean", "absorbed", "changed");
    for (kind k = 0; k < N_KINDS; k++) {
        tally *of = &tallies[k];
        printf("%-34s%8zu%8zu%10zu%9zu\n", NAMES[k], of->faults, of->clean, of->absorbed, of->changed);
        sum.faults += of->faults;
        sum.clean += of->clean;
        sum.absorbed += of->absorbed;
        sum.changed += of->changed;
        CHECK(factor < 1 || of->clean > 0);
    }
    printf("%-34s%8zu%8zu%10zu%9zu\n", "all", sum.faults, sum.clean, sum.absorbed, sum.changed);
    CHECK(sum.changed == 0);
    CHECK((double)sum.faults > 1000 * factor);
    return 0;
}
