// Every function of the headers, called once or more for one set of points, and a number for all that each call gives.
//
// The program has its own functions called before and after each call, and in the callbacks. What the calls are given is
// made before: a tour does no arithmetic of its own with numbers that have a point.
#ifndef TOUR_H
#define TOUR_H

#include "state.h"

#include <unistd.h>

// How many points there are at most, and room for what calls give; a program that includes this may define another number.
#ifndef TOUR_SIZE
#define TOUR_SIZE 48
#endif
enum {
    TOUR_POINTS = TOUR_SIZE,
    TOUR_STEPS = 360,
    TOUR_ROOM = TOUR_SIZE <= 48 ? 1 << 14 : TOUR_SIZE << 7,
    TOUR_FILE = TOUR_SIZE <= 48 ? 1 << 18 : TOUR_SIZE << 12
};

// What a tour is given.
typedef struct {
    uint32_t dimension, threads;
    deldrift_algorithm algorithm;
    size_t n;
    // Where the points are first; where they go together; where some go alone, and vertices are inserted.
    double at[TOUR_POINTS * 3], then[TOUR_POINTS * 3], later[TOUR_POINTS * 3];
    // A box, and the square of a radius.
    double low[3], high[3], squared_radius;
} places;

// What its calls have given.
typedef struct {
    size_t count;
    const char *names[TOUR_STEPS];
    uint64_t given[TOUR_STEPS];
} record;

// What the program does beside, or NULL.
static void (*before_call)(void), (*after_call)(const char *name), (*in_callback)(void);

static record *tour_record;
static deldrift_status tour_status;

// A result of the latest call.
static void note(const void *bytes, size_t size) {
    uint64_t *sum = &tour_record->given[tour_record->count - 1];
    if (tour_status == DELDRIFT_OK) *sum = mixed(*sum, digest_of(bytes, size));
}

static void begin_step(const char *name) {
    CHECK(tour_record->count < TOUR_STEPS);
    tour_record->names[tour_record->count++] = name;
    if (before_call != NULL) before_call();
}

static void end_step(const char *name, deldrift_status status) {
    if (after_call != NULL) after_call(name);
    CHECK(status != DELDRIFT_INTERNAL_ERROR && status != DELDRIFT_POISONED);
    tour_status = DELDRIFT_OK;
    note(&status, sizeof status);
    tour_status = status;
    // The message, too, may have numbers in it.
    if (status != DELDRIFT_OK) {
        tour_record->given[tour_record->count - 1] += digest_of(deldrift_last_error(), strlen(deldrift_last_error()));
    }
}

// A call, whatever its status.
#define TRY(call)                                                                                   \
    do {                                                                                            \
        begin_step(#call);                                                                          \
        deldrift_status step_status = (call);                                                       \
        end_step(#call, step_status);                                                               \
    } while (0)

// A call that must succeed.
#define GO(call)                                                                                    \
    do {                                                                                            \
        TRY(call);                                                                                  \
        CHECK_STATUS(tour_status, DELDRIFT_OK);                                                     \
    } while (0)

// A call without a status.
#define DO(call)                                                                                    \
    do {                                                                                            \
        begin_step(#call);                                                                          \
        call;                                                                                       \
        end_step(#call, DELDRIFT_OK);                                                               \
    } while (0)

static bool tour_cancel(void *user_data) {
    (void)user_data;
    if (in_callback != NULL) in_callback();
    return false;
}

static void tour_progress(void *user_data, double fraction) {
    (void)user_data;
    (void)fraction;
    if (in_callback != NULL) in_callback();
}

// An answer for a cell that depends on its corners alone, whatever their order.
static int tour_is_too_large(void *user_data, const double *corners) {
    (void)user_data;
    if (in_callback != NULL) in_callback();
    uint64_t sum = 0;
    for (size_t i = 0; i < 6; i++) sum += digest_of(corners + i, sizeof *corners);
    return sum % 4 == 0;
}

// Room for what calls give.
static struct {
    uint32_t ids[TOUR_ROOM], more_ids[TOUR_ROOM];
    int32_t labels[TOUR_ROOM];
    deldrift_conflict conflicts[TOUR_ROOM];
    double numbers[TOUR_ROOM], more_numbers[TOUR_ROOM];
    uint8_t bytes[TOUR_ROOM], saved[TOUR_FILE];
    deldrift_location locations[TOUR_POINTS];
} tour_out;

static const char *tour_path(void) {
    static char path[300];
    const char *folder = getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/deldrift-tour-%d", folder == NULL ? "/tmp" : folder, (int)getpid());
    return path;
}

// What is in the file that the latest call has written.
static void note_file(void) {
    FILE *file = fopen(tour_path(), "rb");
    CHECK(file != NULL);
    size_t n = fread(tour_out.saved, 1, TOUR_FILE, file);
    CHECK(n > 0 && n < TOUR_FILE && fclose(file) == 0);
    note(tour_out.saved, n);
}

// What can be asked about segments, and what they divide: in space that is refused.
static void ask_about_segments(const deldrift_triangulation *t, const places *p, size_t n_cells) {
    uint32_t *ids = tour_out.ids, *ends = tour_out.more_ids;
    uint8_t *bytes = tour_out.bytes;
    size_t count = 0;
    TRY(deldrift_segments(t, ids, ends, tour_out.labels, TOUR_ROOM / 2, &count));
    note(ids, count * sizeof *ids);
    note(ends, count * 2 * sizeof *ends);
    note(tour_out.labels, count * sizeof *tour_out.labels);
    TRY(deldrift_segments_of_cells(t, ids, TOUR_ROOM / 3, &count));
    note(ids, count * 3 * sizeof *ids);
    TRY(deldrift_cells_of_segments(t, ids, TOUR_ROOM / 2, &count));
    note(ids, count * 2 * sizeof *ids);
    TRY(deldrift_label_cells(t, p->later, (const int32_t[]){5, -6, 7}, 3, 8, tour_out.labels, TOUR_ROOM, &count));
    note(tour_out.labels, count * sizeof *tour_out.labels);
    TRY(deldrift_regions(t, 8, tour_out.labels, TOUR_ROOM, &count, NULL));
    note(tour_out.labels, count * sizeof *tour_out.labels);
    TRY(deldrift_update_labels(t, (const uint32_t[]){0}, n_cells > 0, 8, tour_out.labels, TOUR_ROOM, &count));
    note(tour_out.labels, n_cells * sizeof *tour_out.labels);
    TRY(deldrift_crossing_numbers(t, ids, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    TRY(deldrift_nesting_levels(t, ids, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    for (size_t k = 0; k < n_cells; k++) bytes[k] = k % 3 == 0 || (p->dimension == 2 && ids[k] == 1);
    uint32_t *more = ids + TOUR_ROOM / 2, *most = ends + TOUR_ROOM / 2;
    TRY(deldrift_boundary_chains(t, bytes, n_cells, ids, more, ends, most, bytes + TOUR_ROOM / 2, TOUR_ROOM / 2, &count));
    note(ids, count * sizeof *ids);
    note(more, count * sizeof *more);
    note(ends, count * sizeof *ends);
}

// What refinement has made.
static void ask_what_was_made(const deldrift_triangulation *t) {
    uint32_t *ids = tour_out.ids, *more = tour_out.more_ids;
    size_t count = 0;
    TRY(deldrift_made_vertices(t, ids, more, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    note(more, count * sizeof *more);
    TRY(deldrift_original_segments(t, ids, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    TRY(deldrift_refined_weights(t, ids, tour_out.numbers, TOUR_ROOM / 3, &count));
    note(ids, count * 3 * sizeof *ids);
    note(tour_out.numbers, count * 3 * sizeof *tour_out.numbers);
    TRY(deldrift_refined_sizes(t, tour_out.numbers, TOUR_ROOM, &count));
    note(tour_out.numbers, count * sizeof *tour_out.numbers);
    TRY(deldrift_refined_vertices(t, ids, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    if (deldrift_copy_positions(t, tour_out.numbers, TOUR_ROOM / 3, &count) == DELDRIFT_OK) {
        note(tour_out.numbers, count * 2 * sizeof *tour_out.numbers);
    }
}

// A timestamp is prepared in two rounds and taken back, and prepared again and published.
static void prepare(const deldrift_triangulation *of, const places *p) {
    deldrift_triangulation *t = NULL;
    deldrift_commit_report report;
    deldrift_cells_view view;
    deldrift_changes changes;
    uint32_t first = 0;
    GO(deldrift_clone(of, &t));
    GO(deldrift_discard_moves(t));
    for (int k = 0; k < 2; k++) {
        TRY(deldrift_stage_insertions(t, p->later, 2, &first));
        TRY(deldrift_prepare_timestamp(t, &report));
        note(&report, sizeof report);
        TRY(deldrift_cells(t, &view));
        note(&view.count, sizeof view.count);
        TRY(deldrift_move_vertex(t, first, p->later));
        TRY(deldrift_prepare_timestamp(t, &report));
        note(&report, sizeof report);
        TRY(deldrift_take_changes(t, &changes));
        if (k == 0) GO(deldrift_withdraw_timestamp(t));
    }
    TRY(deldrift_publish_timestamp(t));
    GO(deldrift_validate(t, 3));
    DO(deldrift_destroy(t));
}

// Cells within segments are refined, by length, by angle and by what a callback says, and coarsened.
static void improve(const deldrift_triangulation *of) {
    static double sizes[2 * TOUR_POINTS];
    deldrift_triangulation *t = NULL;
    deldrift_quality quality;
    deldrift_quality_report report;
    size_t n_ids = 0;
    uint32_t segment = 0;
    GO(deldrift_clone(of, &t));
    GO(deldrift_discard_moves(t));
    TRY(deldrift_hull_facets(t, tour_out.ids, NULL, NULL, TOUR_ROOM / 3, &n_ids));
    TRY(deldrift_stage_segments(t, tour_out.ids, NULL, n_ids, &segment));
    TRY(deldrift_commit_timestamp(t, NULL));
    if (tour_status != DELDRIFT_OK) GO(deldrift_discard_moves(t));
    for (size_t k = 0; k < TOUR_ROOM; k++) tour_out.labels[k] = 1;
    GO(deldrift_cell_count(t, &n_ids));
    TRY(deldrift_set_regions(t, tour_out.labels, n_ids));
    TRY(deldrift_set_segment_sides(t, &segment, (const int32_t[]){1, DELDRIFT_NO_LABEL}, 1));
    GO(deldrift_quality_init(&quality));
    note(&quality.share, sizeof quality.share);
    GO(deldrift_id_count(t, &n_ids));
    CHECK(n_ids <= 2 * TOUR_POINTS);
    for (size_t k = 0; k < n_ids; k++) sizes[k] = k % 2 == 0 ? 1 : 0.5;
    quality.sizes = sizes;
    quality.size_count = n_ids;
    quality.limit = 12;
    quality.has_weights = 1;
    TRY(deldrift_refine(t, &quality, NULL, 0, &report));
    note(&report, sizeof report);
    ask_what_was_made(t);
    quality.sizes = NULL;
    quality.size_count = 0;
    quality.least_angle = 30;
    quality.is_too_large = tour_is_too_large;
    quality.domain = DELDRIFT_DOMAIN_REGIONS;
    TRY(deldrift_refine(t, &quality, NULL, 0, &report));
    note(&report, sizeof report);
    ask_what_was_made(t);
    quality.is_too_large = NULL;
    quality.least_angle = 10;
    TRY(deldrift_coarsen(t, &quality, NULL, 0, &report));
    note(&report, sizeof report);
    ask_what_was_made(t);
    GO(deldrift_validate(t, 3));
    DO(deldrift_destroy(t));
}

// What can be asked about the cells and vertices of any triangulation.
static void ask_about(const deldrift_triangulation *t, const places *p) {
    const uint32_t d = p->dimension, corners = d + 1;
    uint32_t *ids = tour_out.ids, *more_ids = tour_out.more_ids, one = 0;
    double *numbers = tour_out.numbers, *more = tour_out.more_numbers, width = 0;
    uint8_t *bytes = tour_out.bytes;
    size_t count = 0, n_ids = 0, n_cells = 0;
    GO(deldrift_id_count(t, &n_ids));
    note(&n_ids, sizeof n_ids);
    GO(deldrift_vertex_count(t, &count));
    note(&count, sizeof count);
    GO(deldrift_staged_count(t, &count));
    note(&count, sizeof count);
    GO(deldrift_memory_bytes(t, &count));
    GO(deldrift_cell_count(t, &n_cells));
    note(&n_cells, sizeof n_cells);
    CHECK(n_ids <= TOUR_POINTS * 2 && n_cells * corners * 3 <= TOUR_ROOM);
    GO(deldrift_dimension(t, &one));
    note(&one, sizeof one);
    deldrift_algorithm algorithm = 0;
    GO(deldrift_get_algorithm(t, &algorithm));
    note(&algorithm, sizeof algorithm);
    uint64_t timestamp = 0;
    GO(deldrift_timestamp(t, &timestamp));
    note(&timestamp, sizeof timestamp);
    deldrift_commit_report sums;
    GO(deldrift_statistics(t, &sums));
    note(&sums, sizeof sums);
    ask_about_segments(t, p, n_cells);
    GO(deldrift_research_within_safe_region(t, &timestamp));
    note(&timestamp, sizeof timestamp);
    bool present = false;
    GO(deldrift_is_present(t, 1, &present));
    note(&present, sizeof present);
    TRY(deldrift_position(t, 3, numbers));
    note(numbers, d * sizeof *numbers);
    GO(deldrift_copy_positions(t, numbers, TOUR_ROOM / d, &count));
    note(numbers, count * d * sizeof *numbers);
    deldrift_cells_view cells;
    GO(deldrift_cells(t, &cells));
    note(cells.vertices, n_cells * corners * sizeof *cells.vertices);
    note(cells.neighbours, n_cells * corners * sizeof *cells.neighbours);
    GO(deldrift_copy_cells(t, ids, more_ids, TOUR_ROOM / corners, &count));
    note(ids, count * corners * sizeof *ids);
    GO(deldrift_validate(t, 1));
    GO(deldrift_validate(t, 2));
    GO(deldrift_validate(t, 3));
    TRY(deldrift_star(t, 4, ids, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    TRY(deldrift_ordered_star(t, 4, ids, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    TRY(deldrift_tolerance(t, 4, &width));
    note(&width, sizeof width);
    GO(deldrift_research_annulus_widths(t, numbers, TOUR_ROOM, &count));
    note(numbers, count * sizeof *numbers);
    for (uint32_t corner = 0; corner < corners; corner++) {
        TRY(deldrift_research_standard_delimiter(t, 0, corner, numbers, numbers + 3, numbers + 4));
        note(numbers, d * sizeof *numbers);
        note(numbers + 3, 2 * sizeof *numbers);
        TRY(deldrift_mirror_index(t, 0, corner, &one));
        note(&one, sizeof one);
    }
    deldrift_location location;
    GO(deldrift_locate(t, p->later, &location));
    note(&location, sizeof location);
    GO(deldrift_locate_points(t, p->later, p->n, NULL, tour_out.locations));
    note(tour_out.locations, p->n * sizeof location);
    for (size_t k = 0; k < 3; k++) {
        GO(deldrift_nearest_vertex(t, p->later + k * d, &one));
        note(&one, sizeof one);
    }
    TRY(deldrift_coincident_representative(t, 4, &one));
    note(&one, sizeof one);
    GO(deldrift_hidden_vertices(t, ids, more_ids, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    note(more_ids, count * sizeof *more_ids);
    GO(deldrift_nearest_vertices(t, p->later, p->n, 7, ids));
    note(ids, p->n * 7 * sizeof *ids);
    for (size_t k = 0; k < 2; k++) {
        GO(deldrift_vertices_in_ball(t, p->later + k * d, p->squared_radius, ids, TOUR_ROOM, &count));
        note(ids, count * sizeof *ids);
        GO(deldrift_conflicts(t, p->later + k * d, &location, ids, TOUR_ROOM, &count));
        note(ids, count * sizeof *ids);
    }
    GO(deldrift_vertices_in_box(t, p->low, p->high, ids, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    static size_t starts[TOUR_ROOM];
    // Lists of many vertices have no room otherwise.
    const double squared = n_ids > 1000 ? p->squared_radius / 1000 : p->squared_radius;
    GO(deldrift_neighbour_lists(t, &squared, 1, NULL, 0, DELDRIFT_PAIRS_HALF, starts, n_ids + 1, ids, NULL,
                                TOUR_ROOM, &count));
    note(starts, (n_ids + 1) * sizeof *starts);
    note(ids, count * sizeof *ids);
    GO(deldrift_cells_in_reach(t, p->low, p->high, 1, NULL, 0, ids, numbers, more, TOUR_ROOM / 3, &count));
    note(ids, count * sizeof *ids);
    note(numbers, count * d * sizeof *numbers);
    note(more, count * sizeof *more);
    GO(deldrift_hull_facets_in_reach(t, p->low, p->high, 1, NULL, 0, ids, bytes, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    note(bytes, count);
    size_t offsets[2];
    GO(deldrift_vertices_in_reach(t, p->low, p->high, 1, NULL, 0, ids, offsets, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    note(offsets, sizeof offsets);
    GO(deldrift_cell_of_each_vertex(t, ids, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    for (size_t k = 0; k < p->n; k++) {
        const uint32_t kind = tour_out.locations[k].kind;
        const bool is_cell = kind == DELDRIFT_LOCATION_CELL || kind == DELDRIFT_LOCATION_OUTSIDE;
        ids[k] = is_cell ? tour_out.locations[k].index : DELDRIFT_NONE;
    }
    GO(deldrift_barycentric(t, p->later, ids, p->n, numbers));
    note(numbers, p->n * corners * sizeof *numbers);
    // Facets, of few cells and of all.
    for (size_t part = 1; part <= 2; part++) {
        const size_t n = part == 1 && n_cells > 3 ? 3 : n_cells;
        for (size_t k = 0; k < n; k++) memcpy(more_ids + k * d, cells.vertices + k * corners, d * sizeof *ids);
        GO(deldrift_find_simplices(t, d, more_ids, n, ids));
        note(ids, n * sizeof *ids);
    }
    GO(deldrift_circumcentres(t, numbers, more, TOUR_ROOM / 3, &count));
    note(numbers, count * d * sizeof *numbers);
    note(more, count * sizeof *more);
    GO(deldrift_volumes(t, numbers, TOUR_ROOM, &count));
    note(numbers, count * sizeof *numbers);
    GO(deldrift_mask_by_circumradius(t, p->squared_radius, bytes, TOUR_ROOM, &count));
    note(bytes, count);
    GO(deldrift_mask_without_flat_cells(t, 0.25, bytes, TOUR_ROOM, &count));
    note(bytes, count);
    GO(deldrift_mask_boundary(t, bytes, n_cells, ids, more_ids, bytes + TOUR_ROOM / 2, TOUR_ROOM / 3, &count));
    note(ids, count * d * sizeof *ids);
    GO(deldrift_hull_facets(t, ids, more_ids, bytes, TOUR_ROOM / 3, &count));
    note(ids, count * d * sizeof *ids);
    GO(deldrift_edges(t, ids, TOUR_ROOM / 2, &count));
    note(ids, count * 2 * sizeof *ids);
    GO(deldrift_vertex_neighbours(t, more_ids, n_ids + 1, ids, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    GO(deldrift_vertex_cells(t, more_ids, n_ids + 1, ids, TOUR_ROOM, &count));
    note(ids, count * sizeof *ids);
    GO(deldrift_mirror_indices(t, bytes, TOUR_ROOM / 4, &count));
    note(bytes, count * corners);
    const uint32_t vertices[] = {1, 2};
    TRY(deldrift_cells_around(t, vertices, 2, ids, TOUR_ROOM, &count));
    if (tour_status != DELDRIFT_OK) count = 0;
    note(ids, count * sizeof *ids);
    size_t n_marked;
    TRY(deldrift_voronoi_changed(t, vertices, 2, bytes, TOUR_ROOM, &n_marked));
    if (tour_status == DELDRIFT_OK) note(bytes, n_marked);
    GO(deldrift_update_circumcentres(t, ids, count, numbers, more, TOUR_ROOM / 3));
    note(numbers, TOUR_ROOM / 8 * sizeof *numbers);
    GO(deldrift_update_volumes(t, ids, count, numbers, TOUR_ROOM));
    note(numbers, TOUR_ROOM / 8 * sizeof *numbers);
    GO(deldrift_update_mask_by_circumradius(t, ids, count, p->squared_radius, bytes, TOUR_ROOM));
    note(bytes, TOUR_ROOM / 8);
    GO(deldrift_voronoi_volumes(t, NULL, NULL, numbers, TOUR_ROOM, &count));
    note(numbers, count * sizeof *numbers);
    TRY(deldrift_voronoi_volumes(t, p->low, p->high, numbers, TOUR_ROOM, &count));
    note(numbers, count * sizeof *numbers);
    GO(deldrift_voronoi_facets(t, NULL, NULL, numbers, TOUR_ROOM, &count));
    note(numbers, count * sizeof *numbers);
    TRY(deldrift_voronoi_facets(t, p->low, p->high, numbers, TOUR_ROOM, &count));
    note(numbers, count * sizeof *numbers);
    memset(bytes, 1, n_ids);
    memset(numbers, 0, n_ids * sizeof *numbers);
    for (int is_masked = 0; is_masked < 2; is_masked++) {
        const uint8_t *mask = is_masked ? bytes : NULL;
        const size_t mask_count = is_masked ? n_ids : 0;
        if (is_masked && n_ids > 0) bytes[0] = 0;
        TRY(deldrift_voronoi_cells(t, p->low, p->high, mask, mask_count, numbers, NULL, more, TOUR_ROOM / 3, &count));
        note(numbers, n_ids * sizeof *numbers);
        TRY(deldrift_voronoi_cells_within(t, p->low, p->high, (double[]){1, 2, 3, 4, -1, 1, 1, 4}, 2, mask, mask_count,
                                          numbers, more, NULL, TOUR_ROOM, &count));
        note(numbers, n_ids * sizeof *numbers);
        TRY(deldrift_voronoi_derivatives(t, p->low, p->high, mask, mask_count, numbers, NULL, NULL, TOUR_ROOM, &count));
        note(numbers, n_ids * sizeof *numbers);
        TRY(deldrift_voronoi_derivatives_within(t, p->low, p->high, (double[]){1, 2, 3, 4, -1, 1, 1, 4}, 2, mask,
                                                mask_count, numbers, NULL, NULL, TOUR_ROOM, &count));
        note(numbers, n_ids * sizeof *numbers);
        size_t n_edges;
        TRY(deldrift_voronoi_cells_and_facets(t, p->low, p->high, NULL, 0, mask, mask_count, numbers, NULL, NULL, TOUR_ROOM,
                                              &count, more, NULL, NULL, TOUR_ROOM, &n_edges));
        note(numbers, n_ids * sizeof *numbers);
        TRY(deldrift_voronoi_weight_derivatives(t, p->low, p->high, NULL, 0, mask, mask_count, numbers, TOUR_ROOM, &count,
                                                more, TOUR_ROOM, &n_edges));
        note(numbers, n_ids * sizeof *numbers);
    }
    for (uint32_t method = 0; method < 2; method++) {
        TRY(deldrift_interpolate(t, method, p->then, n_ids, 1, p->later, p->n, NULL, NULL, numbers));
        note(numbers, p->n * sizeof *numbers);
    }
}

// Files and copies.
static void keep(const deldrift_triangulation *t, const places *p, const deldrift_options *options) {
    size_t size = 0;
    deldrift_triangulation *made = NULL;
    GO(deldrift_save(t, tour_out.saved, TOUR_FILE, &size));
    note(tour_out.saved, size);
    GO(deldrift_load(tour_out.saved, size, options, &made));
    ask_about(made, p);
    DO(deldrift_destroy(made));
    GO(deldrift_clone(t, &made));
    deldrift_cells_view cells;
    deldrift_released_cells *owner;
    GO(deldrift_release_cells(made, &cells, &owner));
    DO(deldrift_destroy(made));
    note(cells.vertices, cells.count * cells.corners_per_cell * sizeof *cells.vertices);
    DO(deldrift_free_cells(owner));
    GO(deldrift_save_file(t, tour_path()));
    note_file();
    GO(deldrift_load_file(tour_path(), options, &made));
    DO(deldrift_destroy(made));
    const deldrift_field field = {"then", p->then, 1};
    TRY(deldrift_write_vtu(t, tour_path(), &field, 1, NULL, 0));
    if (tour_status == DELDRIFT_OK) note_file();
    GO(deldrift_write_medit(t, tour_path(), NULL, 0));
    note_file();
    CHECK(unlink(tour_path()) == 0);
}

static const double tour_far[] = {40, 40, 40};

// Segments of which some may conflict, and some that are edges already.
static void prescribe(deldrift_triangulation *t) {
    uint32_t segment = 0;
    size_t count = 0;
    TRY(deldrift_stage_segments(t, (const uint32_t[]){0, 9, 3, 11, 4, 13, 6, 15}, NULL, 4, &segment));
    TRY(deldrift_check_staged(t));
    TRY(deldrift_segment_conflicts(t, tour_out.conflicts, TOUR_ROOM, &count));
    note(tour_out.conflicts, count * sizeof *tour_out.conflicts);
    TRY(deldrift_stage_splits(t, 1, NULL));
    TRY(deldrift_commit_timestamp(t, NULL));
    if (tour_status != DELDRIFT_OK) GO(deldrift_discard_moves(t));
    GO(deldrift_edges(t, tour_out.ids, TOUR_ROOM / 2, &count));
    for (size_t k = 0; k < count; k++) tour_out.labels[k] = (int32_t)k - 3;
    TRY(deldrift_stage_segments(t, tour_out.ids, tour_out.labels, count < 9 ? count : 9, &segment));
    note(&segment, sizeof segment);
    TRY(deldrift_commit_timestamp(t, NULL));
    if (tour_status != DELDRIFT_OK) GO(deldrift_discard_moves(t));
    TRY(deldrift_move_vertex(t, 5, tour_far));
    TRY(deldrift_check_passings(t));
    TRY(deldrift_passings(t, tour_out.ids, NULL, TOUR_ROOM, &count));
    note(tour_out.ids, count * sizeof *tour_out.ids);
    GO(deldrift_discard_moves(t));
    TRY(deldrift_stage_segment_removals(t, &segment, 1));
}

// All of it.
static void make_tour(const places *p, record *made) {
    const uint32_t d = p->dimension;
    const size_t n = p->n;
    memset(made, 0, sizeof *made);
    memset(&tour_out, 0, sizeof tour_out);
    tour_record = made;
    deldrift_options options;
    DO(deldrift_options_init(&options));
    options.algorithm = is_of_research(p->algorithm) ? DELDRIFT_AUTO : p->algorithm;
    options.threads = p->threads;
    options.cancel = tour_cancel;
    options.progress = tour_progress;
    const char *text = NULL;
    DO(text = deldrift_version());
    note(text, strlen(text));
    DO(text = deldrift_status_string(DELDRIFT_OUT_OF_RANGE));
    note(text, strlen(text));
    DO(text = deldrift_last_error());

    int32_t sign = 7;
    for (size_t k = 0; k < 4; k++) {
        GO(deldrift_orientation(d, p->at + k * d, &sign));
        note(&sign, sizeof sign);
        GO(deldrift_in_sphere(d, p->at + k * d, &sign));
        note(&sign, sizeof sign);
        GO(deldrift_in_power_sphere(d, p->at + k * d, p->then + k * d, &sign));
        note(&sign, sizeof sign);
    }
    deldrift_triangulation *t = NULL;
    GO(deldrift_create(d, p->at, n, &options, &t));
    if (is_of_research(p->algorithm)) GO(deldrift_research_set_algorithm(t, p->algorithm, NULL));
    deldrift_commit_report report;
    deldrift_changes changes;
    GO(deldrift_take_changes(t, &changes));
    note(changes.stars, changes.star_count * sizeof *changes.stars);

    uint32_t first = 0;
    GO(deldrift_move_vertex(t, 2, p->then + 2 * d));
    GO(deldrift_discard_moves(t));
    GO(deldrift_move_vertices(t, NULL, p->then, n));
    GO(deldrift_stage_insertions(t, p->later, 3, &first));
    note(&first, sizeof first);
    const uint32_t leaving[] = {5, 7};
    GO(deldrift_stage_removals(t, leaving, 2));
    size_t n_before = 0;
    GO(deldrift_cell_count(t, &n_before));
    GO(deldrift_commit_timestamp(t, &report));
    note(&report, sizeof report);
    GO(deldrift_take_changes(t, &changes));
    // Where all vertices change places each cell meets all others.
    if (n < 1000) {
        const deldrift_transfer_order order = DELDRIFT_TRANSFER_SECOND_ORDER;
        memset(tour_out.numbers, 0, n_before * sizeof *tour_out.numbers);
        GO(deldrift_transfer_cells(t, p->then, n, order, tour_out.numbers, n_before, 1, TOUR_ROOM, NULL, NULL, NULL));
        note(tour_out.numbers, changes.created_count * sizeof *tour_out.numbers);
    }
    note(changes.created, changes.created_count * sizeof *changes.created);
    note(changes.stars, changes.star_count * sizeof *changes.stars);
    for (uint32_t v = 0; v < 4; v++) GO(deldrift_relocate_vertex(t, v, p->later + v * d));
    for (uint32_t v = 8; v < 11; v++) GO(deldrift_remove_vertex(t, v));
    for (uint32_t v = 5; v < 8; v++) GO(deldrift_insert_vertex(t, p->at + v * d, &first));
    ask_about(t, p);
    GO(deldrift_compact(t, tour_out.ids, TOUR_ROOM, &(size_t){0}));
    note(tour_out.ids, n * sizeof *tour_out.ids);

    // A few of which each goes elsewhere, and then all of them back.
    size_t count = 0;
    GO(deldrift_set_algorithm(t, DELDRIFT_AUTO));
    for (uint32_t v = 0; v < 3; v++) GO(deldrift_move_vertex(t, v, p->at + (v + 9) * d));
    GO(deldrift_commit_timestamp(t, &report));
    note(&report, sizeof report);
    GO(deldrift_id_count(t, &count));
    CHECK(count <= n + 1);
    GO(deldrift_commit_positions(t, p->at, count, &report));
    note(&report, sizeof report);
    prescribe(t);
    improve(t);
    prepare(t, p);
    keep(t, p, &options);
    DO(deldrift_destroy(t));

    // Keys, some of them equal; ids that are given again.
    static const uint64_t keys[] = {4, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5, 8};
    t = NULL;
    GO(deldrift_create_with_keys(d, p->at, keys, 12, &options, &t));
    GO(deldrift_remove_vertex(t, 3));
    GO(deldrift_stage_insertions_at_free_ids(t, p->later, keys, 2, tour_out.ids));
    note(tour_out.ids, 2 * sizeof *tour_out.ids);
    GO(deldrift_stage_insertions_with_keys(t, p->later + 2 * d, keys, 2, &first));
    GO(deldrift_commit_timestamp(t, &report));
    note(&report, sizeof report);
    GO(deldrift_insert_vertex_with_key(t, p->at + 13 * d, 7, &first));
    note(&first, sizeof first);
    static uint64_t keys_out[TOUR_POINTS];
    GO(deldrift_keys(t, keys_out, TOUR_POINTS, &count));
    note(keys_out, count * sizeof *keys_out);
    DO(deldrift_destroy(t));

    // A periodic one, of which the box changes.
    static const double box[2][9] = {{3, 0, 0.5, 3}, {3, 0, 0, 0.5, 3, 0, 0, 0.75, 3}};
    static const double other_box[2][9] = {{3, 0, 6.5, 3.25}, {3, 0, 0, 0.5, 3.25, 0, 0, 0.75, 3}};
    static int64_t shifts[48 * TOUR_POINTS], beside[48 * TOUR_POINTS];
    static double box_out[9], in_box[36], in_other_box[36], wrapped[36];
    uint32_t greatest[3];
    // Those of the tour may be far away, for a box.
    for (uint32_t i = 0; i < 36; i++) {
        in_box[i] = (i * 37 + 11) % 97 / 32.0;
        in_other_box[i] = (i * 41 + 5) % 89 / 32.0;
    }
    t = NULL;
    GO(deldrift_create_periodic(d, in_box, 12, box[d - 2], d, &options, &t));
    GO(deldrift_commit_positions(t, in_other_box, 12, &report));
    note(&report, sizeof report);
    GO(deldrift_stage_vectors(t, other_box[d - 2], d));
    GO(deldrift_commit_timestamp(t, &report));
    note(&report, sizeof report);
    GO(deldrift_vectors(t, box_out, d, &count));
    note(box_out, count * d * sizeof *box_out);
    GO(deldrift_reduced_vectors(t, box_out, shifts, greatest, d, &count));
    note(box_out, count * d * sizeof *box_out);
    note(shifts, count * d * sizeof *shifts);
    note(greatest, count * sizeof *greatest);
    GO(deldrift_wrap_positions(t, in_box, in_other_box, 12, wrapped, shifts));
    note(wrapped, 12 * d * sizeof *wrapped);
    note(shifts, 12 * d * sizeof *shifts);
    GO(deldrift_cell_shifts(t, shifts, beside, 4 * TOUR_POINTS, &count));
    note(shifts, count * (d + 1) * d * sizeof *shifts);
    note(beside, count * (d + 1) * d * sizeof *beside);
    GO(deldrift_edge_shifts(t, NULL, 0, &count));
    note(&count, sizeof count);
    GO(deldrift_locate_in_period(t, in_box, 12, NULL, tour_out.locations, shifts));
    note(tour_out.locations, 12 * sizeof *tour_out.locations);
    note(shifts, 12 * d * sizeof *shifts);
    GO(deldrift_nearest_vertices(t, in_box, 12, 5, tour_out.ids));
    note(tour_out.ids, 60 * sizeof *tour_out.ids);
    DO(deldrift_destroy(t));

    // One with weights, of vertices that these hide and show again.
    double weights[12], weights_out[16];
    for (uint32_t i = 0; i < 12; i++) weights[i] = i % 3 == 0 ? -1.5 : i / 8.0;
    bool is_weighted = false;
    t = NULL;
    GO(deldrift_create_weighted(d, in_box, weights, keys, 12, &options, &t));
    GO(deldrift_is_weighted(t, &is_weighted));
    note(&is_weighted, sizeof is_weighted);
    for (uint32_t i = 0; i < 12; i++) weights[i] = i % 5 == 0 ? -2.5 : i / 16.0;
    GO(deldrift_commit_weighted(t, in_other_box, weights, 12, &report));
    note(&report, sizeof report);
    GO(deldrift_stage_insertions(t, in_box + 5, 1, &first));
    GO(deldrift_stage_weights(t, &first, weights + 3, 1));
    GO(deldrift_commit_timestamp(t, &report));
    note(&report, sizeof report);
    GO(deldrift_set_weight(t, 7, -4));
    GO(deldrift_insert_vertex_with_weight(t, in_box + 3, 0.75, &first));
    note(&first, sizeof first);
    GO(deldrift_stage_insertions_with_weights(t, in_other_box + 2, weights, 2, &first));
    GO(deldrift_commit_timestamp(t, &report));
    note(&report, sizeof report);
    GO(deldrift_weights(t, weights_out, 16, &count));
    note(weights_out, count * sizeof *weights_out);
    GO(deldrift_hidden_by_weight(t, tour_out.ids, tour_out.ids + 16, 16, &count));
    note(tour_out.ids, count * sizeof *tour_out.ids);
    note(tour_out.ids + 16, count * sizeof *tour_out.ids);
    GO(deldrift_copy_cells(t, tour_out.ids, NULL, 4 * TOUR_POINTS, &count));
    note(tour_out.ids, count * (d + 1) * sizeof *tour_out.ids);
    DO(deldrift_destroy(t));

    // One with weights that repeats.
    t = NULL;
    GO(deldrift_create_periodic_weighted(d, in_box, weights, 12, box[d - 2], d, &options, &t));
    for (uint32_t i = 0; i < 12; i++) weights[i] = i % 4 == 0 ? -1.5 : i / 8.0;
    GO(deldrift_commit_weighted(t, in_other_box, weights, 12, &report));
    note(&report, sizeof report);
    GO(deldrift_stage_weights(t, (const uint32_t[]){3}, (const double[]){-3}, 1));
    GO(deldrift_stage_vectors(t, other_box[d - 2], d));
    GO(deldrift_commit_timestamp(t, &report));
    note(&report, sizeof report);
    GO(deldrift_hidden_by_weight(t, tour_out.ids, tour_out.ids + 13, 13, &count));
    note(tour_out.ids, count * sizeof *tour_out.ids);
    note(tour_out.ids + 13, count * sizeof *tour_out.ids);
    GO(deldrift_voronoi_volumes(t, NULL, NULL, tour_out.numbers, 12, &count));
    note(tour_out.numbers, count * sizeof *tour_out.numbers);
    DO(deldrift_destroy(t));

    // Calls that are refused: what a number is like is told.
    uint32_t vertex = 0;
    t = NULL;
    GO(deldrift_create(d, p->at, n, NULL, &t));
    TRY(deldrift_insert_vertex(t, (const double[]){1e-310, 1e300, 0}, &vertex));
    CHECK(tour_status == DELDRIFT_OUT_OF_RANGE);
    DO(deldrift_destroy(t));
}

#endif
