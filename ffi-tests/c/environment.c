// Calls from foreign floating-point environments: other rounding, traps, numbers near zero that count as zero, sticky flags.
// Every call does what it does in the default environment, and leaves the caller's as it is; callbacks have the caller's.
#define _GNU_SOURCE
#include "scattered.h"

#include <dlfcn.h>
#include <fenv.h>
#include <pthread.h>

#ifdef __SSE2__
#include <immintrin.h>
#endif

enum { N_SEEDS = 1, SIDE = 12, LARGE_SIDE = 16 };

// The processor's own bits: numbers near zero are zero, as arguments and as results; the flags of all exceptions, which
// the other unit of x86 would take for news when they are to trap.
#if defined __SSE2__
// MXCSR.
enum { FLUSH = 0x8040, FLAGS = 0x3f };
static unsigned control_now(void) { return _mm_getcsr(); }
static void add_control(unsigned bits) { _mm_setcsr(_mm_getcsr() | bits); }
#elif defined __aarch64__
// FPCR.
enum { FLUSH = 1 << 24, FLAGS = 0 };
static unsigned control_now(void) {
    unsigned long control;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control));
    return (unsigned)control;
}
static void add_control(unsigned bits) {
    unsigned long control = control_now() | bits;
    __asm__ volatile("msr fpcr, %0" : : "r"(control));
}
#else
enum { FLUSH = 0, FLAGS = 0 };
static unsigned control_now(void) { return 0; }
static void add_control(unsigned bits) { (void)bits; }
#endif

// What can be seen of an environment.
typedef struct {
    int rounding, traps, flags;
    unsigned control;
} environment;

static environment environment_now(void) {
    environment e = {fegetround(), fegetexcept(), fetestexcept(FE_ALL_EXCEPT), control_now()};
    return e;
}

// Many processors of ARM never trap: then no exception is asked to.
static void enter(environment e) {
    CHECK(fesetenv(FE_DFL_ENV) == 0);
    if (feenableexcept(FE_ALL_EXCEPT) == -1) e.traps = 0;
    CHECK(fesetenv(FE_DFL_ENV) == 0);
    CHECK(feraiseexcept(e.flags) == 0);
    CHECK(fesetround(e.rounding) == 0 && feenableexcept(e.traps) != -1);
    add_control(e.control);
    environment now = environment_now();
    CHECK(now.rounding == e.rounding && now.traps == e.traps && (now.flags & e.flags) == e.flags);
}

static void leave(void) {
    CHECK(fesetenv(FE_DFL_ENV) == 0);
}

static const environment FOREIGN[] = {
    {FE_TONEAREST, 0, FE_UNDERFLOW | FE_DIVBYZERO, 0},
    {FE_UPWARD, 0, 0, 0},
    {FE_DOWNWARD, 0, FE_INEXACT, 0},
    {FE_TOWARDZERO, 0, 0, 0},
    {FE_TONEAREST, FE_INVALID | FE_DIVBYZERO, 0, 0},
    {FE_TONEAREST, FE_ALL_EXCEPT, 0, 0},
    {FE_TONEAREST, FE_ALL_EXCEPT, 0, FLAGS},
    {FE_TONEAREST, 0, 0, FLUSH},
    {FE_TOWARDZERO, FE_ALL_EXCEPT, 0, FLUSH},
};
enum { N_FOREIGN = sizeof FOREIGN / sizeof *FOREIGN };

static bool are_same(environment a, environment b) {
    return a.rounding == b.rounding && a.traps == b.traps && a.flags == b.flags && a.control == b.control;
}

static environment callers;
static size_t n_callbacks;

static void look_before(void) {
    callers = environment_now();
}

static void look_after(const char *name) {
    environment now = environment_now();
    if (are_same(now, callers)) return;
    leave();
    fprintf(stderr, "%s: rounding %d, traps %d, flags %d, control %x have become %d, %d, %d, %x\n", name, callers.rounding,
            callers.traps, callers.flags, callers.control, now.rounding, now.traps, now.flags, now.control);
    exit(1);
}

static void look_inside(void) {
    CHECK(are_same(environment_now(), callers));
    n_callbacks++;
}

static void compare(const record *found, const record *expected, const char *shape, uint32_t dimension) {
    CHECK(found->count == expected->count);
    for (size_t k = 0; k < found->count; k++) {
        if (found->given[k] == expected->given[k]) continue;
        fprintf(stderr, "%uD, %s: %s gives something else\n", dimension, shape, found->names[k]);
        exit(1);
    }
}

// Everything that every call gives, bit by bit.
static void tours(void) {
    static places p;
    static record expected, found;
    const deldrift_algorithm algorithms[] = ALL_ALGORITHMS;
    size_t turn = 0;
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        for (shape s = 0; s < N_SHAPES; s++) {
            for (uint64_t seed = 1; (double)(seed - 1) < N_SEEDS * soak(); seed++) {
                p = places_of(s, dimension, algorithms[turn++ % (sizeof algorithms / sizeof *algorithms)], seed);
                before_call = NULL, after_call = NULL, in_callback = NULL;
                make_tour(&p, &expected);
                before_call = look_before, after_call = look_after, in_callback = look_inside;
                for (size_t k = 0; k < N_FOREIGN; k++) {
                    enter(FOREIGN[k]);
                    make_tour(&p, &found);
                    leave();
                    compare(&found, &expected, SHAPES[s], dimension);
                }
            }
        }
    }
    CHECK(n_callbacks > 1000);
}

static uint64_t cells_in(deldrift_triangulation *t) {
    uint64_t cells = arrays_of(t).cells;
    deldrift_destroy(t);
    return cells;
}

static deldrift_triangulation *create_on(uint32_t threads, uint32_t dimension, const double *points, size_t n) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.threads = threads;
    return create(dimension, points, n, &options);
}

// A grid that has been turned: nearly all is a tie but for rounding.
static double *turned_grid(int side, double angle) {
    int n = side * side * side;
    double *points = malloc((size_t)n * 3 * sizeof *points), c = cos(angle), s = sin(angle);
    CHECK(points != NULL);
    for (int v = 0; v < n; v++) {
        double x = v % side, y = v / side % side, z = v / side / side, *p = points + 3 * v;
        p[0] = c * x - s * y;
        p[1] = c * (s * x + c * y) - s * z;
        p[2] = s * (s * x + c * y) + c * z;
    }
    return points;
}

// A thread that the library starts, by the function below in the place of the system's.
typedef struct {
    void *(*run)(void *argument);
    void *argument;
} beginning;

static size_t n_started;

static void *begin(void *given) {
    beginning b = *(beginning *)given;
    free(given);
#ifdef __SSE2__
    // The other unit of the processor, which the library does not use, is as it was.
    CHECK((control_now() & ~(unsigned)FLAGS) == 0x1f80);
#else
    CHECK(fegetround() == FE_TONEAREST && fegetexcept() == 0);
#endif
    return b.run(b.argument);
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument) {
    int (*create_thread)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
    *(void **)&create_thread = dlsym(RTLD_NEXT, "pthread_create");
    beginning *given = malloc(sizeof *given);
    CHECK(create_thread != NULL && given != NULL);
    *given = (beginning){run, argument};
    n_started++;
    return create_thread(thread, attributes, begin, given);
}

// The library's own threads are started by a call from a foreign environment, and go on to work for others.
static void threads_started_abroad(void) {
    const size_t n = LARGE_SIDE * LARGE_SIDE * LARGE_SIDE;
    double *points = random_positions(3, n, 3);
    enter((environment){FE_TOWARDZERO, 0, 0, FLUSH});
    deldrift_triangulation *t = create_on(3, 3, points, n);
    leave();
    CHECK(n_started > 0);
    CHECK(cells_in(t) == cells_in(create_on(1, 3, points, n)));
    free(points);
    for (int turn = 1; turn <= 10; turn++) {
        points = turned_grid(LARGE_SIDE, 0.04 * turn);
        CHECK(cells_in(create_on(3, 3, points, n)) == cells_in(create_on(1, 3, points, n)));
        free(points);
    }
}

// A removal that divides by zero on its way.
static void removal_with_traps(void) {
    const double square[] = {0, 0, 2, 0, 2, 2, 0, 2, 1, 1};
    deldrift_triangulation *t = create(2, square, 5, NULL);
    enter((environment){FE_TONEAREST, FE_INVALID | FE_DIVBYZERO, 0, 0});
    OK(deldrift_remove_vertex(t, 4));
    leave();
    CHECK(cell_count(t) == 2);
    deldrift_destroy(t);
}

// A move of one vertex and its commit raise no flag.
static void commits_without_flags(void) {
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        for (uint64_t seed = 0; seed < 800; seed++) {
            uint64_t state = seed;
            double *points = random_positions(dimension, 40, seed);
            // Half of them on a grid.
            for (size_t i = 0; i < 40 * dimension && seed % 2 == 0; i++) points[i] = (double)(int)(points[i] * 4);
            deldrift_triangulation *t = create(dimension, points, 40, NULL);
            double to[3] = {next_random(&state), next_random(&state), next_random(&state)};
            leave();
            OK(deldrift_move_vertex(t, 5, seed % 4 == 0 ? points : to));
            OK(deldrift_commit_timestamp(t, NULL));
            CHECK(fetestexcept(FE_ALL_EXCEPT) == 0);
            deldrift_destroy(t);
            free(points);
        }
    }
}

static void nearest_vertex_with_other_rounding(void) {
    const double points[] = {0.83, 0.03, 0.71, 0.31, 0.22, 0.35}, position[] = {1.1, -0.05};
    deldrift_triangulation *t = create(2, points, 3, NULL);
    uint32_t nearest = 7;
    enter((environment){FE_DOWNWARD, 0, 0, 0});
    OK(deldrift_nearest_vertex(t, position, &nearest));
    leave();
    CHECK(nearest == 0);
    deldrift_destroy(t);
}

static void turned_grids(void) {
    const size_t n = SIDE * SIDE * SIDE;
    for (int turn = 1; turn <= 20; turn++) {
        double *points = turned_grid(SIDE, 0.05 * turn);
        uint64_t expected = cells_in(create_on(1, 3, points, n));
        for (size_t k = 0; k < N_FOREIGN; k++) {
            if (k % 4 != (size_t)turn % 4 && FOREIGN[k].rounding != FE_TOWARDZERO) continue;
            enter(FOREIGN[k]);
            deldrift_triangulation *t = create_on(1, 3, points, n);
            leave();
            CHECK(cells_in(t) == expected);
        }
        free(points);
    }
}

// What a callback does to the environment is done to the caller's, call in call or not.
static bool changes_it(void *user_data) {
    deldrift_triangulation *other = user_data;
    const double position[] = {0.3, 0.4};
    uint32_t nearest = 7;
    environment before = environment_now();
    OK(deldrift_nearest_vertex(other, position, &nearest));
    CHECK(are_same(environment_now(), before) && nearest == 0);
    CHECK(fesetround(FE_UPWARD) == 0);
    CHECK(feraiseexcept(FE_DIVBYZERO) == 0);
    return false;
}

static void callbacks_that_change_it(void) {
    double *points = random_positions(2, 2000, 5), *others = random_positions(2, 2000, 6);
    const double triangle[] = {0, 0, 1, 0, 0, 1};
    deldrift_options options;
    deldrift_options_init(&options);
    options.cancel = changes_it;
    options.user_data = create(2, triangle, 3, NULL);
    enter((environment){FE_DOWNWARD, 0, FE_UNDERFLOW, 0});
    // Where flags are raised by arithmetic, as on ARM, a number near zero is not exact either.
    const int flags = fetestexcept(FE_ALL_EXCEPT) | FE_DIVBYZERO;
    deldrift_triangulation *t = create(2, points, 2000, &options);
    CHECK(fegetround() == FE_UPWARD && fetestexcept(FE_ALL_EXCEPT) == flags);
    OK(deldrift_move_vertices(t, NULL, others, 2000));
    OK(deldrift_commit_timestamp(t, NULL));
    CHECK(fegetround() == FE_UPWARD && fetestexcept(FE_ALL_EXCEPT) == flags);
    leave();
    CHECK(cells_in(t) == cells_in(create(2, others, 2000, NULL)));
    deldrift_destroy(options.user_data);
    free(points);
    free(others);
}

int main(int count, char **arguments) {
    // Also where the caller has not asked for it: threads are started while there is little work.
    CHECK(setenv("DELDRIFT_ALL_THREADS", "1", 1) == 0);
    alarm(600);
    // By numbers, each in a process of its own; all of them without.
    void (*const parts[])(void) = {threads_started_abroad, removal_with_traps, commits_without_flags,
        nearest_vertex_with_other_rounding, turned_grids, callbacks_that_change_it, tours};
    const size_t n_parts = sizeof parts / sizeof *parts;
    for (size_t k = 0; k < n_parts; k++) {
        if (count < 2 || (size_t)atoi(arguments[1]) == k) parts[k]();
    }
    return 0;
}
