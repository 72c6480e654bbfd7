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

// A box of many vertices, as that of a tour has few: with what builds inside, copies, checks and asks.
static void in_a_box(const places *p) {
    static const double box[2][9] = {{1, 0, 0, 1}, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    deldrift_options options;
    deldrift_options_init(&options);
    options.cancel = tour_cancel;
    options.progress = tour_progress;
    deldrift_triangulation *t = NULL, *copy = NULL;
    deldrift_changes changes;
    size_t count = 0;
    uint32_t vertex = 0;
    tour_record->count = 0;
    GO(deldrift_create_periodic(p->dimension, p->at, p->n, box[p->dimension - 2], p->dimension, &options, &t));
    GO(deldrift_take_changes(t, &changes));
    GO(deldrift_move_vertices(t, NULL, p->then, p->n));
    GO(deldrift_prepare_timestamp(t, NULL));
    GO(deldrift_withdraw_timestamp(t));
    GO(deldrift_commit_positions(t, p->then, p->n, NULL));
    GO(deldrift_remove_vertex(t, 5));
    GO(deldrift_compact(t, tour_out.ids, TOUR_ROOM, &count));
    GO(deldrift_relocate_vertex(t, 5, p->later));
    GO(deldrift_insert_vertex(t, p->later + 30, &vertex));
    GO(deldrift_validate(t, 3));
    GO(deldrift_clone(t, &copy));
    DO(deldrift_destroy(copy));
    GO(deldrift_edges(t, NULL, 0, &count));
    GO(deldrift_voronoi_cells(t, NULL, NULL, NULL, 0, tour_out.numbers, NULL, NULL, TOUR_ROOM, &count));
    GO(deldrift_voronoi_derivatives(t, NULL, NULL, NULL, 0, tour_out.numbers, NULL, NULL, TOUR_ROOM, &count));
    GO(deldrift_save_file(t, tour_path()));
    GO(deldrift_load_file(tour_path(), &options, &copy));
    DO(deldrift_destroy(copy));
    DO(deldrift_destroy(t));
    CHECK(unlink(tour_path()) == 0);
}

// A transfer of many cells: all vertices go a hundredth of the way to other places.
static void in_a_transfer(const places *p) {
    static double goals[3 * TOUR_SIZE];
    deldrift_options options;
    deldrift_options_init(&options);
    options.cancel = tour_cancel;
    options.progress = tour_progress;
    deldrift_triangulation *t = NULL;
    deldrift_changes changes;
    const uint32_t d = p->dimension;
    size_t n_before = 0, n_cells = 0;
    tour_record->count = 0;
    GO(deldrift_create(d, p->at, p->n, &options, &t));
    GO(deldrift_take_changes(t, &changes));
    GO(deldrift_cell_count(t, &n_before));
    for (size_t k = 0; k < p->n * d; k++) goals[k] = p->at[k] + 0.01 * (p->then[k] - p->at[k]);
    GO(deldrift_commit_positions(t, goals, p->n, NULL));
    GO(deldrift_take_changes(t, &changes));
    GO(deldrift_cell_count(t, &n_cells));
    const size_t room = n_before > n_cells ? n_before : n_cells;
    double *const values = calloc(room, sizeof *values);
    CHECK(values != NULL);
    GO(deldrift_transfer_cells(t, goals, p->n, DELDRIFT_TRANSFER_SECOND_ORDER, values, n_before, 1, room, NULL, NULL, NULL));
    free(values);
    DO(deldrift_destroy(t));
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
        in_a_box(&p);
        in_a_transfer(&p);
    }
    return 0;
}
