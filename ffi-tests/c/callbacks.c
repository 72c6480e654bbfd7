// From inside which functions the callbacks of the options are called: each that a tour (tour.h) has found is a line. What
// the header says is compared with them in ffi-tests/functions.rs.
#define TOUR_SIZE 6000
#include "scattered.h"

static bool is_called;
static const char *seen[TOUR_STEPS];
static size_t n_seen;

static void forget(void) { is_called = false; }

static void remember(void) { is_called = true; }

// A call is a function's name, a parenthesis and more.
static size_t length_of_name(const char *call) { return strcspn(call, "("); }

static void tell(const char *call) {
    const char *name = strstr(call, "deldrift_");
    if (!is_called || name == NULL) return;
    for (size_t k = 0; k < n_seen; k++) {
        const size_t n = length_of_name(name);
        if (n == length_of_name(seen[k]) && strncmp(name, seen[k], n) == 0) return;
    }
    CHECK(n_seen < TOUR_STEPS);
    seen[n_seen++] = name;
    printf("%.*s\n", (int)length_of_name(name), name);
}

int main(void) {
    static places p;
    static record made;
    const deldrift_algorithm algorithms[] = {DELDRIFT_AUTO, DELDRIFT_PLACEMENT_FLIPS, DELDRIFT_REPAIR};
    before_call = forget, after_call = tell, in_callback = remember;
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        for (uint64_t k = 0; k < sizeof algorithms / sizeof *algorithms; k++) {
            p = places_of(ROUNDED, dimension, algorithms[k], k + 1);
            make_tour(&p, &made);
        }
    }
    return 0;
}
