// How much of the stack calls take, on threads that have little of it, whatever coordinates are like.
//
// Before each call the stack below it is filled with a pattern; afterwards the lowest byte that has another value tells
// how far the call went. Prints the most that each function has taken.
#define _GNU_SOURCE
#include "scattered.h"

#include <pthread.h>

// What the header says that a call takes at most, and the smallest stack that it says is enough.
enum { MOST = 64 << 10, STACK = 128 << 10, MARGIN = 512, N_SEEDS = 8, MOST_NAMES = 300 };

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
    size_t depth = (size_t)(&here - at), length = strcspn(name, "( ="), k = 0;
    for (; taken[k].name != NULL; k++) {
        if (strncmp(taken[k].name, name, length) == 0 && strcspn(taken[k].name, "( =") == length) break;
    }
    CHECK(k + 1 < MOST_NAMES);
    taken[k].name = name;
    if (depth > taken[k].most) {
        taken[k].most = depth;
        memcpy(taken[k].where, where_now, sizeof where_now);
    }
}

static void *all_shapes(void *unused) {
    (void)unused;
    pthread_attr_t own;
    void *address;
    size_t size;
    CHECK(pthread_getattr_np(pthread_self(), &own) == 0);
    CHECK(pthread_attr_getstack(&own, &address, &size) == 0);
    CHECK(pthread_attr_destroy(&own) == 0);
    stack_end = address;
    static places p;
    static record made;
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        for (shape s = 0; s < N_SHAPES; s++) {
            for (uint64_t seed = 1; seed <= N_SEEDS; seed++) {
                const deldrift_algorithm algorithms[] = ALL_ALGORITHMS;
                deldrift_algorithm algorithm = algorithms[seed % (sizeof algorithms / sizeof *algorithms)];
                snprintf(where_now, sizeof where_now, "%uD, %s, seed %d", dimension, SHAPES[s], (int)seed);
                p = places_of(s, dimension, algorithm, seed);
                make_tour(&p, &made);
            }
        }
    }
    return NULL;
}

static void on_a_stack_of(size_t size) {
    pthread_attr_t attributes;
    pthread_t thread;
    CHECK(pthread_attr_init(&attributes) == 0);
    CHECK(pthread_attr_setstacksize(&attributes, size) == 0);
    CHECK(pthread_create(&thread, &attributes, all_shapes, NULL) == 0);
    CHECK(pthread_join(thread, NULL) == 0);
    CHECK(pthread_attr_destroy(&attributes) == 0);
}

int main(int count, char **arguments) {
    // The first panic hook, the first thread: what happens once happens on the small stack as well.
    before_call = paint;
    after_call = measure;
    on_a_stack_of(count > 1 ? (size_t)atoi(arguments[1]) << 10 : STACK);
    size_t most = 0;
    for (size_t k = 0; taken[k].name != NULL; k++) {
        int length = (int)strcspn(taken[k].name, "( =");
        printf("%-40.*s%8zu  %s\n", length, taken[k].name, taken[k].most, taken[k].where);
        if (taken[k].most > most) most = taken[k].most;
    }
    printf("%-40s%8zu\n", "most", most);
    CHECK(most <= MOST);
    return 0;
}
