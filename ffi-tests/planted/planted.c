// Faults for the checkers to find, one for each run: the argument names it. See ffi-tests/checkers.rs.
#define _POSIX_C_SOURCE 200809L
#include "../c/check.h"

#include <limits.h>
#include <pthread.h>

// What the compiler must not know.
static volatile size_t hidden_count = 8;
static volatile int hidden_int = INT_MAX;
static volatile double seen;
static int shared;
static deldrift_triangulation *t;

static void none(void) {
    seen = sqrt(2);
}

static void heap_overflow(void) {
    double *numbers = malloc(hidden_count * sizeof *numbers);
    CHECK(numbers != NULL);
    numbers[hidden_count] = 1;
    seen = numbers[hidden_count];
    free(numbers);
}

static void use_after_free(void) {
    double *numbers = calloc(hidden_count, sizeof *numbers);
    CHECK(numbers != NULL);
    double *volatile kept = numbers;
    free(numbers);
    seen = kept[1];
}

static void leak(void) {
    double *volatile numbers = calloc(hidden_count, sizeof *numbers);
    seen = numbers[0];
    numbers = NULL;
}

// The compiler would warn of what it sees.
static double *numbers_never_set(size_t count) {
    void *volatile made = malloc(count * sizeof(double));
    return made;
}

static void uninitialised_read(void) {
    double *numbers = numbers_never_set(hidden_count);
    CHECK(numbers != NULL);
    if (numbers[3] > 1) puts("more");
    free(numbers);
}

static void signed_overflow(void) {
    hidden_int = hidden_int + 1;
}

static void misaligned_read(void) {
    char *bytes = calloc(hidden_count, 2);
    CHECK(bytes != NULL);
    void *volatile within = bytes + 1;
    seen = *(double *)within;
    free(bytes);
}

static void *increment(void *unused) {
    for (int i = 0; i < 1000; i++) shared++;
    return unused;
}

static void in_two_threads(void *(*work)(void *)) {
    pthread_t other;
    CHECK(pthread_create(&other, NULL, work, NULL) == 0);
    work(NULL);
    CHECK(pthread_join(other, NULL) == 0);
}

static void data_race(void) {
    in_two_threads(increment);
}

// Misuse of the library, which its own memory shows.

static void view_after_destruction(void) {
    deldrift_triangulation *made = create(2, SQUARE, SQUARE_COUNT, NULL);
    deldrift_cells_view view = cells_of(made);
    deldrift_destroy(made);
    seen = view.vertices[hidden_count];
}

static void view_too_far(void) {
    deldrift_triangulation *made = create(2, SQUARE, SQUARE_COUNT, NULL);
    deldrift_cells_view view = cells_of(made);
    seen = view.vertices[1000 * hidden_count];
    deldrift_destroy(made);
}

static void triangulation_not_destroyed(void) {
    deldrift_triangulation *volatile made = create(2, SQUARE, SQUARE_COUNT, NULL);
    made = NULL;
    seen = made == NULL;
}

static void buffer_shorter_than_its_capacity(void) {
    deldrift_triangulation *made = create(2, SQUARE, SQUARE_COUNT, NULL);
    double *positions = malloc(hidden_count * sizeof *positions);
    CHECK(positions != NULL);
    size_t count;
    OK(deldrift_copy_positions(made, positions, SQUARE_COUNT, &count));
    free(positions);
    deldrift_destroy(made);
}

static void positions_never_set(void) {
    double *positions = numbers_never_set(2 * SQUARE_COUNT);
    CHECK(positions != NULL);
    deldrift_triangulation *made = NULL;
    deldrift_status status = deldrift_create(2, positions, SQUARE_COUNT, NULL, &made);
    seen = status == DELDRIFT_OK;
    deldrift_destroy(made);
    free(positions);
}

static void *stage(void *unused) {
    for (uint32_t v = 0; v < SQUARE_COUNT; v++) (void)deldrift_move_vertex(t, v, SQUARE);
    return unused;
}

static void changes_at_the_same_time(void) {
    t = create(2, SQUARE, SQUARE_COUNT, NULL);
    in_two_threads(stage);
    deldrift_destroy(t);
}

static const struct {
    const char *name;
    void (*make)(void);
} FAULTS[] = {
    {"none", none},
    {"heap_overflow", heap_overflow},
    {"use_after_free", use_after_free},
    {"leak", leak},
    {"uninitialised_read", uninitialised_read},
    {"signed_overflow", signed_overflow},
    {"misaligned_read", misaligned_read},
    {"data_race", data_race},
    {"view_after_destruction", view_after_destruction},
    {"view_too_far", view_too_far},
    {"triangulation_not_destroyed", triangulation_not_destroyed},
    {"buffer_shorter_than_its_capacity", buffer_shorter_than_its_capacity},
    {"positions_never_set", positions_never_set},
    {"changes_at_the_same_time", changes_at_the_same_time},
};

int main(int count, char **arguments) {
    CHECK(count == 2);
    for (size_t k = 0; k < sizeof FAULTS / sizeof *FAULTS; k++) {
        if (strcmp(FAULTS[k].name, arguments[1]) == 0) {
            FAULTS[k].make();
            return 0;
        }
    }
    CHECK(!"a fault of this name");
}
