// Options: sizes of other versions, values, algorithms, callbacks.
#include "check.h"

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

static void structures_of_earlier_versions_are_accepted(void) {
    // What lies beyond the size must not be read: it holds an algorithm that does not exist.
    const size_t ends[] = {sizeof(size_t),
                           offsetof(deldrift_options, threads),
                           offsetof(deldrift_options, coincidence),
                           offsetof(deldrift_options, cancel),
                           offsetof(deldrift_options, progress),
                           offsetof(deldrift_options, user_data),
                           offsetof(deldrift_options, switch_share),
                           offsetof(deldrift_options, switch_seed),
                           offsetof(deldrift_options, switch_sample),
                           offsetof(deldrift_options, switch_period),
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
}

static void shares_are_parts_of_a_whole(void) {
    static const double bad[] = {NAN, INFINITY, -INFINITY, -0.25, -4.9406564584124654e-324, 1.0000000000000002, 75};
    static const double good[] = {0, -0.0, 4.9406564584124654e-324, 0.25, 1};
    deldrift_options options;
    deldrift_options_init(&options);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        options.switch_share = bad[i];
        CHECK_STATUS(try_options(&options), DELDRIFT_INVALID_OPTIONS);
        CHECK_MESSAGE("options.switch_share is ");
    }
    CHECK_MESSAGE("options.switch_share is 75");
    options.switch_share = bad[0];
    CHECK_STATUS(try_options(&options), DELDRIFT_INVALID_OPTIONS);
    CHECK_MESSAGE("options.switch_share is NaN");
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        options.switch_share = good[i];
        OK(try_options(&options));
    }
    options.switch_seed = UINT64_MAX;
    options.switch_sample = options.switch_period = UINT32_MAX;
    OK(try_options(&options));
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
            OK(deldrift_set_algorithm(t, all[j]));
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

// A triangulation by DELDRIFT_COMPARE_REBUILDING_TOLERANCE, of which a part moves at each step.
typedef struct {
    deldrift_triangulation *t;
    uint32_t dimension;
    double *positions;
    uint64_t state;
} switching;

enum { SWITCHING_COUNT = 200 };

static switching switching_by(uint32_t dimension, deldrift_options options) {
    options.algorithm = DELDRIFT_COMPARE_REBUILDING_TOLERANCE;
    switching s = {NULL, dimension, random_positions(dimension, SWITCHING_COUNT, 9), 10};
    s.t = create(dimension, s.positions, SWITCHING_COUNT, &options);
    return s;
}

static void end(switching s) {
    OK(deldrift_validate(s.t, 3));
    deldrift_destroy(s.t);
    free(s.positions);
}

// Moves this share of the vertices far away and the others not at all; whether that was done by rebuilding.
static bool rebuilds(switching *s, double share) {
    for (size_t i = 0; i < (size_t)(share * SWITCHING_COUNT) * s->dimension; i++) {
        s->positions[i] = next_random(&s->state);
    }
    OK(deldrift_move_vertices(s->t, NULL, s->positions, SWITCHING_COUNT));
    deldrift_commit_report report;
    OK(deldrift_commit_timestamp(s->t, &report));
    CHECK(report.rebuilds == 1 || report.within_tolerance > 0 || share == 1);
    return report.rebuilds == 1;
}

static void rebuilding_ends_at_a_sample_within_tolerance(uint32_t dimension, uint32_t period) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.switch_period = period;
    switching s = switching_by(dimension, options);
    CHECK(rebuilds(&s, 1));
    for (uint32_t step = 1; step < (period == 0 ? 4 : period); step++) CHECK(rebuilds(&s, 0));
    CHECK(!rebuilds(&s, 0));

    // Once and for all, unless the algorithm is chosen again.
    for (int step = 0; step < 6; step++) CHECK(!rebuilds(&s, 1));
    OK(deldrift_set_algorithm(s.t, DELDRIFT_COMPARE_REBUILDING_TOLERANCE));
    CHECK(!rebuilds(&s, 1));
    OK(deldrift_set_algorithm(s.t, DELDRIFT_TOLERANCE));
    CHECK(!rebuilds(&s, 1));
    OK(deldrift_set_algorithm(s.t, DELDRIFT_COMPARE_REBUILDING_TOLERANCE));
    CHECK(rebuilds(&s, 1));
    end(s);
}

// With four vertices in ten far away, of which a sample of 2000 is a fair picture.
static void the_share_decides(uint32_t dimension, double share, bool switches) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.switch_share = share;
    options.switch_sample = 2000;
    options.switch_period = 1;
    switching s = switching_by(dimension, options);
    for (int step = 0; step < 3; step++) CHECK(rebuilds(&s, 0.4) == !switches);
    end(s);
}

// Steps before the sample of a single vertex, at each of them, is of the half that does not move.
static int steps_of_rebuilding(uint64_t seed) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.switch_seed = seed;
    options.switch_sample = options.switch_period = 1;
    switching s = switching_by(2, options);
    int steps = 0;
    while (rebuilds(&s, 0.5)) steps++;
    end(s);
    return steps;
}

static void the_seed_decides(void) {
    bool differs = false;
    for (uint64_t seed = 0; seed < 10; seed++) {
        CHECK(steps_of_rebuilding(seed) == steps_of_rebuilding(seed));
        differs = differs || steps_of_rebuilding(seed) != steps_of_rebuilding(0);
    }
    CHECK(differs);
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
    structures_of_earlier_versions_are_accepted();
    structures_of_later_versions_are_accepted_if_unused();
    unknown_values_are_refused_by_name();
    shares_are_parts_of_a_whole();
    algorithms_can_be_exchanged();
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        rebuilding_ends_at_a_sample_within_tolerance(dimension, 0);
        rebuilding_ends_at_a_sample_within_tolerance(dimension, 3);
        the_share_decides(dimension, 0.5, true);
        the_share_decides(dimension, 0.7, false);
        the_share_decides(dimension, 0, dimension == 3);
    }
    the_seed_decides();
    creation_can_be_cancelled();
    a_cancelled_commit_has_no_effect(DELDRIFT_REBUILDING);
    a_cancelled_commit_has_no_effect(DELDRIFT_PLACEMENT_FLIPS);
    a_cancelled_commit_has_no_effect(DELDRIFT_TOLERANCE);
    a_cancelled_commit_has_no_effect(DELDRIFT_COMPARE_SAFE_REGION_TOLERANCE);
    return 0;
}
