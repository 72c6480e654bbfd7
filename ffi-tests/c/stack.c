// How much of the stack calls take, on threads that have little of it, whatever coordinates are like.
//
// Before each call the stack below it is filled with a pattern; afterwards the lowest byte that has another value tells
// how far the call went. Prints the most that each function has taken.
#define _GNU_SOURCE
#include "scattered.h"

#include <pthread.h>

// What the header says that a call takes at most, and the smallest stack that it says is enough.
enum { MOST = 80 << 10, STACK = 128 << 10, MARGIN = 512, N_SEEDS = 3, MOST_NAMES = 300, MANY = 3000 };

static const unsigned char PATTERN = 0xa5;

// The lowest address of the stack, and where the call begins.
static volatile unsigned char *stack_end;

static struct {
    const char *name;
    size_t most;
    char where[80];
} taken[MOST_NAMES];

static char where_now[80];

// No function is called where the pattern is: that would take the stack that it fills.
__attribute__((noinline)) static void paint(void) {
    volatile unsigned char here;
    for (volatile unsigned char *at = &here - MARGIN; at >= stack_end; at--) *at = PATTERN;
}

__attribute__((noinline)) static void measure(const char *name) {
    volatile unsigned char here;
    volatile unsigned char *at = stack_end;
    while (at < &here && *at == PATTERN) at++;
    name = strstr(name, "deldrift_");
    size_t depth = (size_t)(&here - at), length = strcspn(name, "("), k = 0;
    for (; taken[k].name != NULL; k++) {
        if (strncmp(taken[k].name, name, length) == 0 && strcspn(taken[k].name, "(") == length) break;
    }
    CHECK(k + 1 < MOST_NAMES);
    taken[k].name = name;
    if (depth > taken[k].most) {
        taken[k].most = depth;
        memcpy(taken[k].where, where_now, sizeof where_now);
    }
}

static void all_shapes(void) {
    static places p;
    size_t turn = 0;
    static record made;
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        for (shape s = 0; s < N_SHAPES; s++) {
            for (uint64_t seed = 1; seed <= N_SEEDS; seed++, turn++) {
                const deldrift_algorithm algorithms[] = ALL_ALGORITHMS;
                deldrift_algorithm algorithm = algorithms[turn % (sizeof algorithms / sizeof *algorithms)];
                snprintf(where_now, sizeof where_now, "%uD, %s, seed %d", dimension, SHAPES[s], (int)seed);
                p = places_of(s, dimension, algorithm, seed);
                make_tour(&p, &made);
            }
        }
    }
}

// Points on a curve all of whose pairs are edges; a vertex that all others are around; any.
static void lay_out(double *points, uint32_t dimension, int kind) {
    uint64_t state = 11;
    for (size_t v = 0; v < MANY; v++) {
        double *p = points + v * dimension, length = 0, s = (double)(v % 300 + 1) / 8;
        for (uint32_t axis = 0; axis < dimension; axis++) {
            p[axis] = next_random(&state) - 0.5;
            length += p[axis] * p[axis];
            if (kind == 1) p[axis] = axis == 0 ? s : axis == 1 ? s * s : s * s * s;
        }
        for (uint32_t axis = 0; axis < dimension && kind == 2; axis++) p[axis] = v == 12 ? 0 : p[axis] / sqrt(length);
    }
}

// Calls on many points, on several threads, by every algorithm.
static void many_points(void) {
    static double at[MANY * 3], then[MANY * 3];
    static record made;
    tour_record = &made;
    const deldrift_algorithm algorithms[] = ALL_ALGORITHMS;
    for (size_t k = 0; k < 6 * sizeof algorithms / sizeof *algorithms; k++) {
        uint32_t dimension = 2 + k % 2, v = 0;
        int kind = (int)(k / 2 % 3);
        snprintf(where_now, sizeof where_now, "%uD, many, kind %d, algorithm %zu", dimension, kind, k / 6);
        lay_out(at, dimension, kind);
        uint64_t state = k;
        for (size_t i = 0; i < MANY * dimension; i++) then[i] = at[i] + (k % 4 < 2 ? 1e-3 : 0.1) * next_random(&state);
        deldrift_options options;
        deldrift_options_init(&options);
        deldrift_algorithm algorithm = algorithms[k / 6];
        options.algorithm = is_of_research(algorithm) ? DELDRIFT_AUTO : algorithm;
        options.threads = 3;
        size_t n = kind == 1 ? 300 : MANY;
        deldrift_triangulation *t = NULL, *other = NULL;
        made.count = 0;
        GO(deldrift_create(dimension, at, n, &options, &t));
        if (is_of_research(algorithm)) GO(deldrift_research_set_algorithm(t, algorithm, NULL));
        for (int step = 0; step < 2; step++) {
            GO(deldrift_commit_positions(t, step == 0 ? then : at, n, NULL));
            for (v = 0; v < 30; v += 3) GO(deldrift_move_vertex(t, v, then + (v + 7) * dimension));
            GO(deldrift_commit_timestamp(t, NULL));
        }
        uint32_t leaving[] = {1, 2, 3};
        GO(deldrift_stage_insertions(t, then, 5, &v));
        GO(deldrift_stage_removals(t, leaving, 3));
        GO(deldrift_commit_timestamp(t, NULL));
        TRY(deldrift_stage_segments(t, (const uint32_t[]){20, 220, 21, 171}, NULL, 2, &v));
        TRY(deldrift_check_staged(t));
        TRY(deldrift_check_passings(t));
        TRY(deldrift_stage_splits(t, 9, NULL));
        TRY(deldrift_commit_timestamp(t, NULL));
        if (tour_status != DELDRIFT_OK) GO(deldrift_discard_moves(t));
        GO(deldrift_relocate_vertex(t, 12, then));
        GO(deldrift_remove_vertex(t, 12));
        GO(deldrift_clone(t, &other));
        GO(deldrift_compact(t, NULL, 0, &(size_t){0}));
        GO(deldrift_validate(t, 3));
        DO(deldrift_destroy(other));
        DO(deldrift_destroy(t));
    }
}

// Boxes that are periodic along one axis, with coordinates of any exponents along the others: what is loaded is checked
// below frames of two kinds of triangulation.
static void strips(void) {
    static double at[24];
    static unsigned char bytes[1 << 16];
    static record made;
    tour_record = &made;
    for (uint64_t state = 1, seed = 0; seed < 100; seed++) {
        snprintf(where_now, sizeof where_now, "3D, periodic along one axis, seed %d", (int)seed);
        for (size_t i = 0; i < 24; i++) {
            at[i] = floor(4 * next_random(&state)) / 8;
            double few = floor(3 * next_random(&state));
            if (i % 3 != 0) at[i] += ldexp(few, -60 - (int)(200 * next_random(&state)));
        }
        deldrift_triangulation *t = NULL, *other = NULL;
        size_t size = 0;
        made.count = 0;
        GO(deldrift_create_periodic(3, at, 8, (const double[]){1, 0, 0}, 1, NULL, &t));
        GO(deldrift_save(t, bytes, sizeof bytes, &size));
        GO(deldrift_load(bytes, size, NULL, &other));
        DO(deldrift_destroy(other));
        DO(deldrift_destroy(t));
    }
}

static void *measured(void *unused) {
    (void)unused;
    pthread_attr_t own;
    void *address;
    size_t size;
    CHECK(pthread_getattr_np(pthread_self(), &own) == 0);
    CHECK(pthread_attr_getstack(&own, &address, &size) == 0);
    CHECK(pthread_attr_destroy(&own) == 0);
    stack_end = address;
    before_call = paint;
    after_call = measure;
    all_shapes();
    many_points();
    strips();
    return NULL;
}

static void on_a_stack_of(size_t size) {
    pthread_attr_t attributes;
    pthread_t thread;
    CHECK(pthread_attr_init(&attributes) == 0);
    CHECK(pthread_attr_setstacksize(&attributes, size) == 0);
    CHECK(pthread_create(&thread, &attributes, measured, NULL) == 0);
    CHECK(pthread_join(thread, NULL) == 0);
    CHECK(pthread_attr_destroy(&attributes) == 0);
}

int main(int count, char **arguments) {
    // Threads, too, are started from the small stack.
    CHECK(setenv("DELDRIFT_ALL_THREADS", "1", 1) == 0);
    on_a_stack_of(count > 1 ? (size_t)atoi(arguments[1]) << 10 : STACK);
    size_t most = 0;
    for (size_t k = 0; taken[k].name != NULL; k++) {
        int length = (int)strcspn(taken[k].name, "(");
        printf("%-40.*s%8zu  %s\n", length, taken[k].name, taken[k].most, taken[k].where);
        if (taken[k].most > most) most = taken[k].most;
    }
    printf("%-40s%8zu\n", "most", most);
    CHECK(most <= MOST);
    return 0;
}
