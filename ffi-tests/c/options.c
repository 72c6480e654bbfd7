// Options: sizes of other versions, values, algorithms, callbacks.
//
// The header defines deldrift_options_init, and the library has it for other languages: here that of the library has the
// name, and that of the header another one.
#define deldrift_options_init init_of_header
#include "check.h"
#undef deldrift_options_init

extern void deldrift_options_init(deldrift_options *options);

typedef struct {
    deldrift_options known;
    uint64_t later[4];
} later_options;

static deldrift_status try_options(const deldrift_options *options) {
    deldrift_triangulation *t = NULL;
    deldrift_status status = deldrift_create(2, SQUARE, SQUARE_COUNT, options, &t);
    CHECK((t != NULL) == (status == DELDRIFT_OK));
    deldrift_destroy(t);
    return status;
}

static void defaults_are_zero(void) {
    deldrift_options options;
    memset(&options, 255, sizeof options);
    deldrift_options_init(&options);
    deldrift_options zero;
    memset(&zero, 0, sizeof zero);
    zero.struct_size = sizeof zero;
    CHECK(memcmp(&options, &zero, sizeof zero) == 0);
    OK(try_options(&options));
    OK(try_options(NULL));
}

static void library_and_header_have_the_same_defaults(void) {
    struct {
        deldrift_options options;
        unsigned char beyond[64];
    } given, of_library, of_header;
    memset(&given, 255, sizeof given);
    of_library = of_header = given;
    deldrift_options_init(&of_library.options);
    init_of_header(&of_header.options);
    CHECK(memcmp(&of_library, &of_header, sizeof given) == 0);
    OK(try_options(&of_library.options));
    deldrift_options_init(NULL);
    init_of_header(NULL);
}

static void structures_of_earlier_versions_are_accepted(void) {
    // What lies beyond the size must not be read: it holds an algorithm that does not exist.
    const size_t ends[] = {sizeof(size_t),
                           offsetof(deldrift_options, threads),
                           offsetof(deldrift_options, coincidence),
                           offsetof(deldrift_options, passing),
                           offsetof(deldrift_options, parts),
                           offsetof(deldrift_options, cancel),
                           offsetof(deldrift_options, progress),
                           offsetof(deldrift_options, user_data),
                           sizeof(deldrift_options)};
    for (size_t size = 0; size < sizeof(deldrift_options); size++) {
        bool is_end = false;
        for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) is_end = is_end || ends[i] == size;
        deldrift_options options;
        memset(&options, 255, sizeof options);
        unsigned char defaults[sizeof options];
        deldrift_options_init((deldrift_options *)memset(&options, 255, sizeof options));
        memcpy(defaults, &options, sizeof options);
        memset(&options, 255, sizeof options);
        memcpy(&options, defaults, size);
        options.struct_size = size;
        CHECK_STATUS(try_options(&options), is_end ? DELDRIFT_OK : DELDRIFT_INVALID_OPTIONS);
        if (!is_end) CHECK_MESSAGE("options.struct_size");
    }

    // Exactly as much memory as the size says, for the memory checkers.
    deldrift_options *shortest = malloc(sizeof(size_t));
    CHECK(shortest != NULL);
    *(size_t *)(void *)shortest = sizeof(size_t);
    OK(try_options(shortest));
    free(shortest);
}

static void structures_of_later_versions_are_accepted_if_unused(void) {
    later_options options;
    memset(&options, 0, sizeof options);
    deldrift_options_init(&options.known);
    options.known.struct_size = sizeof options;
    OK(try_options(&options.known));
    ((unsigned char *)&options)[sizeof options - 1] = 1;
    CHECK_STATUS(try_options(&options.known), DELDRIFT_INVALID_OPTIONS);
    char message[64];
    snprintf(message, sizeof message, "options.struct_size is %zu", sizeof options);
    CHECK_MESSAGE(message);
    options.known.struct_size = SIZE_MAX;
    CHECK_STATUS(try_options(&options.known), DELDRIFT_INVALID_OPTIONS);
    options.known.struct_size = 4097;
    CHECK_STATUS(try_options(&options.known), DELDRIFT_INVALID_OPTIONS);
}

static void unknown_values_are_refused_by_name(void) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = (deldrift_algorithm)77;
    CHECK_STATUS(try_options(&options), DELDRIFT_INVALID_OPTIONS);
    CHECK_MESSAGE("options.algorithm is 77");
    deldrift_options_init(&options);
    options.coincidence = (deldrift_coincidence)2;
    CHECK_STATUS(try_options(&options), DELDRIFT_INVALID_OPTIONS);
    CHECK_MESSAGE("options.coincidence is 2");
    deldrift_options_init(&options);
    options.passing = (deldrift_passing)3;
    CHECK_STATUS(try_options(&options), DELDRIFT_INVALID_OPTIONS);
    CHECK_MESSAGE("options.passing is 3");
    // Those of deldrift/research.h are chosen by its own function.
    deldrift_options_init(&options);
    options.algorithm = DELDRIFT_RESEARCH_PLACEMENT;
    CHECK_STATUS(try_options(&options), DELDRIFT_INVALID_OPTIONS);
    CHECK_MESSAGE("options.algorithm is 16");
}

static void algorithms_can_be_exchanged(void) {
    static const deldrift_algorithm all[] = ALL_ALGORITHMS;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        deldrift_options options;
        deldrift_options_init(&options);
        options.algorithm = all[i];
        options.threads = 1;
        deldrift_triangulation *t = create(3, TETRAHEDRON, TETRAHEDRON_COUNT, &options);
        deldrift_algorithm algorithm = (deldrift_algorithm)99;
        OK(deldrift_get_algorithm(t, &algorithm));
        CHECK(algorithm == all[i]);
        for (size_t j = 0; j < sizeof all / sizeof *all; j++) {
            OK(choose(t, all[j]));
            OK(deldrift_get_algorithm(t, &algorithm));
            CHECK(algorithm == all[j]);
        }
        CHECK_STATUS(deldrift_set_algorithm(t, (deldrift_algorithm)999), DELDRIFT_INVALID_OPTIONS);
        CHECK_MESSAGE("algorithm is 999");
        OK(deldrift_get_algorithm(t, &algorithm));
        CHECK(algorithm == all[sizeof all / sizeof *all - 1]);
        deldrift_destroy(t);
    }
}

// What the callbacks see and do.
typedef struct {
    deldrift_triangulation *t;
    size_t calls;
    size_t cancel_at;
    double fraction;
    bool intrudes;
} watcher;

static void watch(void *user_data, double fraction) {
    watcher *w = user_data;
    CHECK(fraction >= 0 && fraction <= 1);
    w->fraction = fraction;
    w->calls++;
    if (w->intrudes && w->t != NULL) {
        size_t count = 77;
        CHECK_STATUS(deldrift_vertex_count(w->t, &count), DELDRIFT_BUSY);
        CHECK_STATUS(deldrift_discard_moves(w->t), DELDRIFT_BUSY);
        CHECK_STATUS(deldrift_commit_timestamp(w->t, NULL), DELDRIFT_BUSY);
        CHECK(count == 77);
        deldrift_destroy(w->t);
        CHECK_MESSAGE("t is in use");
        deldrift_destroy(create(2, SQUARE, SQUARE_COUNT, NULL));
    }
}

static bool is_over(void *user_data) {
    watcher *w = user_data;
    return w->calls >= w->cancel_at;
}

static deldrift_options watched(watcher *w) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.cancel = is_over;
    options.progress = watch;
    options.user_data = w;
    return options;
}

enum { MANY = 20000 };

static void creation_can_be_cancelled(void) {
    double *positions = random_positions(2, MANY, 1);
    deldrift_triangulation *t = NULL;
    watcher w = {NULL, 0, 1, -1, false};
    deldrift_options options = watched(&w);
    CHECK_STATUS(deldrift_create(2, positions, MANY, &options, &t), DELDRIFT_CANCELLED);
    CHECK(t == NULL && w.calls == 1);
    options.progress = NULL;
    CHECK_STATUS(deldrift_create(2, positions, MANY, &options, &t), DELDRIFT_CANCELLED);
    CHECK(t == NULL && w.calls == 1);
    free(positions);
}

static void a_cancelled_commit_has_no_effect(deldrift_algorithm algorithm) {
    double *positions = random_positions(2, MANY, 2);
    double *moved = random_positions(2, MANY, 3);
    double *now = random_positions(2, MANY, 4);
    watcher w = {NULL, 0, SIZE_MAX, -1, false};
    deldrift_options options = watched(&w);
    options.algorithm = algorithm;
    deldrift_triangulation *t = create(2, positions, MANY, &options);
    CHECK(w.calls > 0);
    size_t cells = cell_count(t);
    OK(deldrift_move_vertices(t, NULL, moved, MANY));

    w.cancel_at = w.calls + 2;
    deldrift_commit_report report = {.timestamp = 99};
    CHECK_STATUS(deldrift_commit_timestamp(t, &report), DELDRIFT_CANCELLED);
    CHECK(report.timestamp == 99);
    uint64_t timestamp = 99;
    size_t count = 0;
    OK(deldrift_timestamp(t, &timestamp));
    OK(deldrift_staged_count(t, &count));
    CHECK(timestamp == 0 && count == MANY && cell_count(t) == cells);
    OK(deldrift_copy_positions(t, now, MANY, &count));
    CHECK(memcmp(now, positions, 2 * MANY * sizeof *now) == 0);
    OK(deldrift_validate(t, 3));

    // The moves are still staged, and the next commit makes them; whatever the callbacks try.
    w.cancel_at = SIZE_MAX;
    w.intrudes = true;
    w.t = t;
    OK(deldrift_commit_timestamp(t, &report));
    CHECK(report.timestamp == 1 && report.moved == MANY);
    OK(deldrift_copy_positions(t, now, MANY, &count));
    CHECK(memcmp(now, moved, 2 * MANY * sizeof *now) == 0);
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
    free(positions);
    free(moved);
    free(now);
}

int main(void) {
    defaults_are_zero();
    library_and_header_have_the_same_defaults();
    structures_of_earlier_versions_are_accepted();
    structures_of_later_versions_are_accepted_if_unused();
    unknown_values_are_refused_by_name();
    algorithms_can_be_exchanged();
    creation_can_be_cancelled();
    a_cancelled_commit_has_no_effect(DELDRIFT_REBUILDING);
    a_cancelled_commit_has_no_effect(DELDRIFT_PLACEMENT_FLIPS);
    a_cancelled_commit_has_no_effect(DELDRIFT_TOLERANCE);
    a_cancelled_commit_has_no_effect(DELDRIFT_RESEARCH_SAFE_REGION_TOLERANCE);
    return 0;
}
