// Triangulations before a call, and the calls: what is done where memory is refused. See faults.c.
#ifndef SCENES_H
#define SCENES_H

#include "requests.h"
#include "state.h"

#include <unistd.h>

// What a triangulation has gone through before a call.
typedef struct {
    size_t n;
    uint32_t threads;
    // Vertices at the same place; cells read, changes taken; a callback.
    bool hides, reads, takes, asks;
    // Vertices that have come and gone at once.
    bool edits;
    // Insertions, and as many removals, staged with the moves of a commit.
    size_t stages;
    // Commits before.
    int warm;
    // All points around one of them; all in a line, until they move; all in a line once they have moved.
    bool is_hub, is_flat, flattens;
    // Segments, in the plane alone: half of them in force, the others staged with a commit; what is staged conflicts.
    size_t segments;
    bool conflicts;
    // Keys, some of them equal; weights, that hide some vertices.
    bool keyed, weighted;
} setting;

static const setting SETTINGS[] = {
    {.n = 60, .threads = 1},
    {.n = 60, .threads = 1, .reads = true, .warm = 2},
    {.n = 60, .threads = 1, .hides = true, .takes = true, .asks = true},
    {.n = 60, .threads = 1, .warm = 1},
    {.n = 60, .threads = 1, .hides = true, .reads = true, .takes = true, .stages = 3, .warm = 1},
    {.n = 60, .threads = 1, .hides = true, .takes = true, .stages = 16},
    {.n = 60, .threads = 1, .hides = true, .reads = true, .takes = true, .edits = true, .warm = 1},
    {.n = 100, .threads = 1, .is_hub = true},
    {.n = 60, .threads = 1, .is_flat = true, .hides = true, .takes = true, .stages = 5},
    {.n = 60, .threads = 1, .flattens = true, .hides = true, .takes = true, .warm = 1, .stages = 2},
    {.n = 3000, .threads = 2},
    {.n = 700, .threads = 3},
    {.n = 700, .threads = 3, .hides = true, .reads = true, .takes = true, .warm = 1, .stages = 16},
    {.n = 60, .threads = 1, .hides = true, .reads = true, .takes = true, .warm = 1, .stages = 3, .segments = 8},
    {.n = 60, .threads = 1, .takes = true, .edits = true, .segments = 6},
    {.n = 60, .threads = 1, .reads = true, .takes = true, .stages = 2, .segments = 8, .conflicts = true},
    {.n = 700, .threads = 3, .reads = true, .warm = 1, .stages = 16, .segments = 16},
    {.n = 60, .threads = 1, .hides = true, .takes = true, .edits = true, .warm = 1, .stages = 3, .keyed = true},
    {.n = 700, .threads = 3, .hides = true, .reads = true, .takes = true, .stages = 16, .keyed = true},
    {.n = 60, .threads = 1, .hides = true, .is_flat = true, .stages = 5, .keyed = true},
    {.n = 60, .threads = 1, .hides = true, .reads = true, .takes = true, .warm = 1, .stages = 3, .weighted = true},
    {.n = 60, .threads = 1, .hides = true, .takes = true, .edits = true, .keyed = true, .weighted = true},
    {.n = 40, .threads = 1, .is_flat = true, .takes = true, .stages = 3, .weighted = true},
};
enum { N_SETTINGS = sizeof SETTINGS / sizeof *SETTINGS };

typedef enum { CREATE, CREATE_WITH_KEYS, CREATE_PERIODIC, RELOCATE, INSERT, INSERT_WITH_KEY, REMOVE, MOVE, MOVE_SOME, MOVE_ALL,
    STAGE_INSERTIONS, STAGE_WITH_KEYS, STAGE_AT_FREE_IDS, STAGE_REMOVALS,
    STAGE_SEGMENTS, STAGE_SEGMENT_REMOVALS, COMMIT,
    COMMIT_SOME, COMMIT_POSITIONS, PREPARE, PREPARE_SOME, WITHDRAW, CHECK_STAGED, CHECK_PASSINGS, STAGE_SPLITS, COMPACT, TAKE_CHANGES, TRANSFER_CELLS, CELLS,
    COPY_CELLS, STAR, TOLERANCE, ANNULUS_WIDTHS,
    DELIMITER, LOCATE, LOCATE_POINTS, NEAREST, CIRCUMCENTRES, VOLUMES, MASK_BY_CIRCUMRADIUS,
    MASK_BOUNDARY, HULL_FACETS, EDGES, VERTEX_NEIGHBOURS, VERTEX_CELLS, MIRROR_INDICES, MIRROR_INDEX, ORDERED_STAR,
    CELLS_AROUND, CELLS_AROUND_ALL, UPDATE_CIRCUMCENTRES, UPDATE_VOLUMES, UPDATE_MASK,
    VORONOI_VOLUMES, VORONOI_FACETS, VORONOI_CELLS, VORONOI_CELLS_WITHIN, VORONOI_DERIVATIVES,
    VORONOI_DERIVATIVES_WITHIN, VORONOI_BY_WEIGHTS, VORONOI_BOTH, VORONOI_CHANGED, INTERPOLATE, INTERPOLATE_NATURAL,
    NEAREST_VERTICES, VERTICES_IN_BALL, NEIGHBOUR_LISTS, VERTICES_IN_BOX, CONFLICTS,
    CELLS_IN_REACH, HULL_FACETS_IN_REACH, VERTICES_IN_REACH, FIND_SIMPLICES, FIND_SIMPLICES_ALL,
    CELL_OF_EACH_VERTEX, BARYCENTRIC, MASK_WITHOUT_FLAT_CELLS, SEGMENTS_OF_CELLS, CELLS_OF_SEGMENTS, NESTING_LEVELS,
    CROSSING_NUMBERS,
    LABEL_CELLS, SET_REGIONS, REGIONS, UPDATE_LABELS, BOUNDARY_CHAINS, REFINE, COARSEN, RELEASE_CELLS, CLONE, SAVE, LOAD, SAVE_FILE, LOAD_FILE, WRITE_VTU, WRITE_MEDIT,
    PERIODIC_POSITIONS, STAGE_VECTORS, CELL_SHIFTS, EDGE_SHIFTS, PERIODIC_CELLS, PERIODIC_FACETS, PERIODIC_CENTRES,
    LOCATE_IN_PERIOD, PERIODIC_NEAREST, PERIODIC_BALL, PERIODIC_LISTS, PERIODIC_LINEAR, PERIODIC_WEIGHTS, PERIODIC_CLONE, PERIODIC_LOAD,
    PERIODIC_VTU, PERIODIC_NEIGHBOURS, PERIODIC_CHECK, PERIODIC_COMPACT, PERIODIC_HIDDEN, WRAP_POSITIONS,
    CREATE_WEIGHTED, CREATE_PERIODIC_WEIGHTED, STAGE_WEIGHTS, COMMIT_WEIGHTED, SET_WEIGHT, INSERT_WITH_WEIGHT,
    STAGE_WITH_WEIGHTS, HIDDEN_BY_WEIGHT, HIDDEN_BY_PLACE, REPRESENTATIVE, STATISTICS, N_KINDS } kind;

static const char *const NAMES[N_KINDS] = {
    "deldrift_create", "deldrift_create_with_keys", "deldrift_create_periodic", "deldrift_relocate_vertex", "deldrift_insert_vertex",
    "deldrift_insert_vertex_with_key", "deldrift_remove_vertex",
    "deldrift_move_vertex", "deldrift_move_vertices", "deldrift_move_vertices, all", "deldrift_stage_insertions",
    "deldrift_stage_insertions_with_keys", "deldrift_stage_insertions_at_free_ids",
    "deldrift_stage_removals", "deldrift_stage_segments", "deldrift_stage_segment_removals",
    "deldrift_commit_timestamp", "deldrift_commit_timestamp, some",
    "deldrift_commit_positions", "deldrift_prepare_timestamp", "deldrift_prepare_timestamp, some",
    "deldrift_withdraw_timestamp", "deldrift_check_staged", "deldrift_check_passings", "deldrift_stage_splits",
    "deldrift_compact", "deldrift_take_changes", "deldrift_transfer_cells", "deldrift_cells", "deldrift_copy_cells",
    "deldrift_star", "deldrift_tolerance", "deldrift_research_annulus_widths", "deldrift_research_standard_delimiter",
    "deldrift_locate",
    "deldrift_locate_points", "deldrift_nearest_vertex", "deldrift_circumcentres",
    "deldrift_volumes", "deldrift_mask_by_circumradius", "deldrift_mask_boundary", "deldrift_hull_facets",
    "deldrift_edges", "deldrift_vertex_neighbours", "deldrift_vertex_cells", "deldrift_mirror_indices",
    "deldrift_mirror_index", "deldrift_ordered_star", "deldrift_cells_around", "deldrift_cells_around, all",
    "deldrift_update_circumcentres", "deldrift_update_volumes", "deldrift_update_mask_by_circumradius",
    "deldrift_voronoi_volumes", "deldrift_voronoi_facets", "deldrift_voronoi_cells",
    "deldrift_voronoi_cells_within", "deldrift_voronoi_derivatives", "deldrift_voronoi_derivatives_within",
    "deldrift_voronoi_weight_derivatives",
    "deldrift_voronoi_cells_and_facets", "deldrift_voronoi_changed", "deldrift_interpolate", "deldrift_interpolate, natural",
    "deldrift_nearest_vertices", "deldrift_vertices_in_ball", "deldrift_neighbour_lists", "deldrift_vertices_in_box", "deldrift_conflicts",
    "deldrift_cells_in_reach", "deldrift_hull_facets_in_reach", "deldrift_vertices_in_reach",
    "deldrift_find_simplices", "deldrift_find_simplices, all", "deldrift_cell_of_each_vertex", "deldrift_barycentric",
    "deldrift_mask_without_flat_cells", "deldrift_segments_of_cells", "deldrift_cells_of_segments",
    "deldrift_nesting_levels", "deldrift_crossing_numbers", "deldrift_label_cells", "deldrift_set_regions", "deldrift_regions", "deldrift_update_labels", "deldrift_boundary_chains",
    "deldrift_refine", "deldrift_coarsen",
    "deldrift_release_cells", "deldrift_clone", "deldrift_save", "deldrift_load", "deldrift_save_file",
    "deldrift_load_file", "deldrift_write_vtu", "deldrift_write_medit",
    "deldrift_commit_positions, periodic", "deldrift_stage_vectors", "deldrift_cell_shifts", "deldrift_edge_shifts", "deldrift_voronoi_cells, periodic",
    "deldrift_voronoi_derivatives, periodic", "deldrift_circumcentres, periodic",
    "deldrift_locate_in_period", "deldrift_nearest_vertices, periodic", "deldrift_vertices_in_ball, periodic", "deldrift_neighbour_lists, periodic",
    "deldrift_interpolate, periodic", "deldrift_barycentric, periodic",
    "deldrift_clone, periodic", "deldrift_load, periodic", "deldrift_write_vtu, periodic",
    "deldrift_vertex_neighbours, periodic", "deldrift_validate, periodic", "deldrift_compact, periodic", "deldrift_hidden_vertices, periodic",
    "deldrift_wrap_positions",
    "deldrift_create_weighted", "deldrift_create_periodic_weighted", "deldrift_stage_weights", "deldrift_commit_weighted", "deldrift_set_weight",
    "deldrift_insert_vertex_with_weight", "deldrift_stage_insertions_with_weights",
    "deldrift_hidden_by_weight", "deldrift_hidden_vertices, weighted", "deldrift_coincident_representative, weighted",
    "deldrift_statistics, weighted",
};

enum { MOST_PAIRS = 24 };

// A call: `goal` is for those of one vertex, which goes near, far, or to a place that is taken.
typedef struct {
    kind kind;
    deldrift_algorithm algorithm;
    int goal;
} call;

static bool is_commit(kind k) {
    return (COMMIT <= k && k <= CHECK_STAGED) || k == STAGE_SPLITS;
}

static bool is_of_plane(kind k) {
    return k == ORDERED_STAR || k == CHECK_PASSINGS || k == STAGE_SEGMENTS || k == STAGE_SEGMENT_REMOVALS ||
           k == STAGE_SPLITS ||
           (SEGMENTS_OF_CELLS <= k && k <= COARSEN);
}

// Calls that only a triangulation with weights serves, or that serve it in a way of their own.
static bool is_of_weights(kind k) { return k >= CREATE_WEIGHTED; }

static bool is_periodic_call(kind k) {
    return k == CREATE_PERIODIC || (k >= PERIODIC_POSITIONS && k <= WRAP_POSITIONS);
}

// Calls that refuse weights, or have nothing to do with them.
static bool refuses_weights(kind k) {
    switch (k) {
        case CREATE:
        case CREATE_WITH_KEYS:
        case ANNULUS_WIDTHS:
        case DELIMITER: return true;
        default: break;
    }
    return is_periodic_call(k) || (CELLS_IN_REACH <= k && k <= VERTICES_IN_REACH) || k == STAGE_SEGMENTS || k == STAGE_SEGMENT_REMOVALS ||
           k == CHECK_STAGED || k == CHECK_PASSINGS || k == STAGE_SPLITS || (SEGMENTS_OF_CELLS <= k && k <= COARSEN);
}

typedef struct {
    uint32_t dimension;
    call call;
    const setting *setting;
    deldrift_triangulation *t;
    // A periodic one, for the calls that only such serve.
    deldrift_triangulation *periodic;
    // Where vertices are, and where those that are to move go; of all ids that there are.
    double *points, *places;
    size_t n;
    mirror mirror;
    // Pairs of vertices of which no two cross; how many are segments, or staged.
    uint32_t pairs[MOST_PAIRS][2];
    size_t n_pairs;
    // Of the cell that is refined.
    double area;
    // How many cells there were when changes were taken before.
    size_t n_before;
} scene;

// Room for what calls give, made before.
enum { ROOM = 1 << 16 };
static uint32_t ids_out[ROOM], more_out[ROOM];
static double numbers_out[ROOM];
static int64_t shifts_out[ROOM];
static uint8_t bytes_out[8 * ROOM];

// One label for all cells.
static const int32_t one_region[ROOM] = {0};

// What is loaded.
static uint8_t saved[8 * ROOM];

static const uint8_t *all_cells(void) {
    static uint8_t mask[ROOM];
    memset(mask, 1, sizeof mask);
    return mask;
}

// The numbers from 0 on, as a list of cells.
static const uint32_t *numbers_from_0(void) {
    static uint32_t numbers[ROOM];
    for (uint32_t k = 0; k < ROOM; k++) numbers[k] = k;
    return numbers;
}

// A file for calls that write one, or read it.
static const char *file_of_test(void) {
    static char path[300];
    const char *folder = getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/deldrift-faults-%d", folder == NULL ? "/tmp" : folder, (int)getpid());
    return path;
}

static bool never(void *user_data) {
    (void)user_data;
    return false;
}

static deldrift_options options_of(const scene *s) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = s->call.algorithm;
    options.threads = s->setting->threads;
    options.cancel = s->setting->asks ? never : NULL;
    return options;
}

static void put_at(double *points, uint32_t dimension, size_t v, size_t place) {
    memcpy(points + v * dimension, points + place * dimension, dimension * sizeof *points);
}

static void hide(const scene *s, double *points) {
    if (!s->setting->hides) return;
    put_at(points, s->dimension, 20, 10);
    put_at(points, s->dimension, 30, 10);
    put_at(points, s->dimension, 40, 11);
}

static void flatten(double *points, size_t n, uint32_t dimension) {
    for (size_t i = 0; i < n * dimension; i++) {
        if (i % dimension != 0) points[i] = 0.5;
    }
}

// Vertex 12 in the middle, all others as far from it as each other.
static void surround(double *points, size_t n, uint32_t dimension) {
    for (size_t v = 0; v < n; v++) {
        double length = 0, *p = points + v * dimension;
        for (uint32_t i = 0; i < dimension; i++) length += (p[i] - 0.5) * (p[i] - 0.5);
        for (uint32_t i = 0; i < dimension; i++) p[i] = v == 12 ? 0.5 : 0.5 + (p[i] - 0.5) / sqrt(length);
    }
}

static void nudge(double *points, size_t count, double size, uint64_t *state) {
    for (size_t i = 0; i < count; i++) points[i] += size * (next_random(state) - 0.5);
}

// Takes the changes, which must be those that there were.
static const char *take(scene *s) {
    deldrift_changes changes;
    OK(deldrift_take_changes(s->t, &changes));
    return follow(&s->mirror, &changes, s->t);
}

static double side_of(const double *a, const double *b, const double *c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool pairs_cross(const double *points, const uint32_t *e, const uint32_t *f) {
    const double *a = points + 2 * e[0], *b = points + 2 * e[1], *c = points + 2 * f[0], *d = points + 2 * f[1];
    if (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]) return false;
    return (side_of(a, b, c) > 0) != (side_of(a, b, d) > 0) && (side_of(c, d, a) > 0) != (side_of(c, d, b) > 0);
}

// Whether a vertex may be an end of segments: it stays where it is.
static bool may_end(uint32_t v) {
    return v % 3 == 0 && v != 3 && v != 9 && v != 12 && v != 30 && v < 60;
}

// Takes pairs of vertices that stay, long ones first, of which no two cross.
static void pair_up(scene *s) {
    for (uint32_t span = 30; span > 0; span--) {
        for (uint32_t v = 0; v + 3 * span < s->n && s->n_pairs < MOST_PAIRS; v++) {
            const uint32_t pair[] = {v, v + 3 * span};
            bool is_free = may_end(pair[0]) && may_end(pair[1]);
            for (size_t k = 0; k < s->n_pairs && is_free; k++) is_free = !pairs_cross(s->points, s->pairs[k], pair);
            if (is_free) memcpy(s->pairs[s->n_pairs++], pair, sizeof pair);
        }
    }
}

static void stage_pairs(scene *s, size_t first, size_t count) {
    uint32_t segment;
    CHECK(first + count <= s->n_pairs);
    OK(deldrift_stage_segments(s->t, s->pairs[first], NULL, count, &segment));
    CHECK(segment == first);
}

// Lays segments at the edges of the largest cell of which no corner goes before the call, and refines it a little.
static void lay_domain(scene *s) {
    const deldrift_cells_view view = cells_of(s->t);
    uint32_t ends[6], segment;
    for (size_t c = 0; c < view.count; c++) {
        const uint32_t *row = view.vertices + 3 * c;
        bool stays = true;
        for (int i = 0; i < 3; i++) stays = stays && (row[i] < 7 || row[i] > 9);
        const double area = side_of(s->points + 2 * row[0], s->points + 2 * row[1], s->points + 2 * row[2]) / 2;
        if (!stays || area <= s->area) continue;
        s->area = area;
        for (int i = 0; i < 6; i++) ends[i] = row[(i + 1) / 2 % 3];
    }
    if (s->area == 0) return;
    OK(deldrift_stage_segments(s->t, ends, NULL, 3, &segment));
    OK(deldrift_commit_timestamp(s->t, NULL));
    deldrift_quality quality;
    deldrift_quality_report report;
    OK(deldrift_quality_init(&quality));
    quality.greatest_area = s->area / 4;
    quality.limit = 8;
    quality.has_weights = 1;
    OK(deldrift_refine(s->t, &quality, NULL, 0, &report));
    CHECK(report.inserted > 0);
    OK(deldrift_copy_positions(s->t, s->points, s->n + report.inserted, &s->n));
}

// Keys of so many vertices: few numbers, each of several.
static const uint64_t *keys_of(size_t count) {
    static uint64_t keys[ROOM];
    CHECK(count <= ROOM);
    for (size_t i = 0; i < count; i++) keys[i] = 7 * i % 11;
    return keys;
}

// Vectors of a box, by dimension; and of another one.
static const double BOX[2][9] = {{1, 0, 0.25, 1}, {1, 0, 0, 0.25, 1, 0, 0, -0.375, 1}};
static const double OTHER_BOX[2][9] = {{1, 0, 5.25, 1.125}, {1, 0, 0, 0.25, 1, 0, 0, -0.375, 1.125}};

// Weights that hide some vertices: of a square of spacings, and some much lower; and others, of a second turn.
static const double *weights_of(size_t count, uint32_t dimension, size_t turn) {
    static double weights[2][ROOM];
    CHECK(count <= ROOM);
    double *these = weights[turn % 2];
    const double square = pow((double)count, -2.0 / dimension);
    for (size_t v = 0; v < count; v++) these[v] = (v + 3 * turn) % 5 == 3 ? -square : 0.3 * square * (double)(v % 7) / 7;
    return these;
}

// A number for the cells of a periodic triangulation, in any order.
static uint64_t digest_of_periodic(const deldrift_triangulation *t, uint32_t dimension) {
    static int64_t shifts[12 * 8192];
    const size_t n = dimension + 1;
    deldrift_cells_view view;
    size_t count;
    OK(deldrift_cells(t, &view));
    OK(deldrift_cell_shifts(t, shifts, NULL, 8192, &count));
    uint64_t sum = count;
    for (size_t c = 0; c < count; c++) {
        for (size_t i = 0; i < n; i++) {
            const uint64_t shift = digest_of(shifts + (c * n + i) * dimension, dimension * sizeof *shifts);
            sum += mixed(digest_of(view.vertices + c * n + i, sizeof *view.vertices), shift);
        }
    }
    return sum;
}

// The same each time.
static scene make_scene(uint32_t dimension, call call, const setting *setting) {
    scene s = {.dimension = dimension, .call = call, .setting = setting, .n = setting->n};
    const size_t n_laid = dimension == 2 ? setting->segments / 2 : 0;
    uint64_t state = 5;
    uint32_t d = dimension, v = 0;
    size_t room = (setting->n + 40) * d;
    double spacing = pow((double)setting->n, -1.0 / d);
    s.points = random_positions(d, setting->n + 40, 17);
    s.places = malloc(room * sizeof *s.places);
    CHECK(s.places != NULL);
    if (setting->is_hub) surround(s.points, s.n, d);
    if (setting->is_flat) flatten(s.points, s.n, d);
    hide(&s, s.points);
    deldrift_options options = options_of(&s);
    if (setting->weighted) {
        if (is_of_research(call.algorithm)) options.algorithm = DELDRIFT_AUTO;
        const uint64_t *keys = setting->keyed ? keys_of(s.n) : NULL;
        OK(deldrift_create_weighted(d, s.points, weights_of(s.n, d, 0), keys, s.n, &options, &s.t));
        OK(choose(s.t, call.algorithm));
    } else if (setting->keyed) {
        if (is_of_research(call.algorithm)) options.algorithm = DELDRIFT_AUTO;
        OK(deldrift_create_with_keys(d, s.points, keys_of(s.n), s.n, &options, &s.t));
        OK(choose(s.t, call.algorithm));
    } else {
        s.t = create(d, s.points, s.n, &options);
    }
    for (int k = 0; k < setting->warm; k++) {
        nudge(s.points, s.n * d, 0.02 * spacing, &state);
        hide(&s, s.points);
        OK(deldrift_move_vertices(s.t, NULL, s.points, s.n));
        OK(deldrift_commit_timestamp(s.t, NULL));
    }
    if (d == 2 && !setting->weighted) pair_up(&s);
    if (n_laid > 0) {
        stage_pairs(&s, 0, n_laid);
        OK(deldrift_commit_timestamp(s.t, NULL));
    }
    if (call.kind == REFINE || call.kind == COARSEN) lay_domain(&s);
    if (setting->takes) CHECK(take(&s) == NULL);
    if (setting->edits) {
        OK(deldrift_insert_vertex(s.t, s.points + s.n++ * d, &v));
        OK(deldrift_remove_vertex(s.t, 7));
        put_at(s.points, d, 8, s.n);
        OK(deldrift_relocate_vertex(s.t, 8, s.points + 8 * d));
    }
    if (setting->reads) {
        deldrift_cells_view view;
        OK(deldrift_cells(s.t, &view));
        // The arrays are there, but not up to date.
        if (setting->edits) OK(deldrift_remove_vertex(s.t, 9));
    }
    memcpy(s.places, s.points, room * sizeof *s.places);
    nudge(s.places, s.n * d, 0.3 * spacing, &state);
    if (call.kind >= PERIODIC_POSITIONS && is_periodic_call(call.kind)) OK(deldrift_create_periodic(d, s.points, s.n, BOX[d - 2], d, &options, &s.periodic));
    if (call.kind == PERIODIC_COMPACT) {
        OK(deldrift_stage_removals(s.periodic, (uint32_t[]){1, 4}, 2));
        OK(deldrift_commit_timestamp(s.periodic, NULL));
    }
    if (setting->flattens) flatten(s.places, s.n + 20, d);
    for (size_t k = 0; k < s.n_pairs && n_laid > 0; k++) {
        for (int i = 0; i < 2; i++) {
            const uint32_t end = s.pairs[k][i];
            memcpy(s.places + end * d, s.points + end * d, d * sizeof *s.places);
        }
    }
    const bool moves_all = call.kind == COMMIT || call.kind == PREPARE || call.kind == CHECK_STAGED || call.kind == CHECK_PASSINGS ||
                           call.kind == STAGE_SPLITS;
    if (moves_all) OK(deldrift_move_vertices(s.t, NULL, s.places, s.n));
    for (uint32_t w = 2; w < s.n; w += 3) {
        bool present;
        OK(deldrift_is_present(s.t, w, &present));
        const bool moves_some = call.kind == COMMIT_SOME || call.kind == PREPARE_SOME || call.kind == WITHDRAW;
        if (present && moves_some) OK(deldrift_move_vertex(s.t, w, s.places + w * d));
    }
    if (call.kind < COMMIT && call.kind != MOVE_ALL) OK(deldrift_move_vertices(s.t, (uint32_t[]){3, 4}, s.places, 2));
    if (is_commit(call.kind) || call.kind == COMPACT) {
        // Some at the places of others, some beside.
        for (size_t k = 0; k < setting->stages; k++) {
            double *coming = s.places + (s.n + k) * d;
            for (uint32_t i = 0; i < d; i++) coming[i] = s.points[3 * k * d + i] + 0.01 * (double)(k % 3);
        }
        uint32_t leaving[16];
        for (uint32_t k = 0; k < setting->stages; k++) leaving[k] = 10 + 3 * k;
        OK(deldrift_stage_insertions(s.t, s.places + s.n * d, setting->stages, &v));
        OK(deldrift_stage_removals(s.t, leaving, setting->stages));
        s.n += setting->stages;
        if (n_laid > 0) {
            stage_pairs(&s, n_laid, n_laid);
            OK(deldrift_stage_segment_removals(s.t, (uint32_t[]){1}, 1));
        }
        // An end goes, which no split mends, and segments cross.
        if (n_laid > 0 && setting->conflicts && is_commit(call.kind)) {
            if (call.kind != STAGE_SPLITS) OK(deldrift_stage_removals(s.t, s.pairs[0], 1));
            OK(deldrift_stage_segments(s.t, (uint32_t[]){1, 2, 4, 5, 7, 8, 11, 14, 17, 20}, NULL, 5, &v));
        }
    }
    if (call.kind == TRANSFER_CELLS) {
        CHECK(take(&s) == NULL);
        s.n_before = cell_count(s.t);
        memcpy(s.points + 12 * d, s.places + 12 * d, d * sizeof *s.points);
        OK(deldrift_relocate_vertex(s.t, 12, s.points + 12 * d));
        CHECK(take(&s) == NULL);
    }
    return s;
}

static void end_scene(scene *s) {
    deldrift_destroy(s->t);
    deldrift_destroy(s->periodic);
    free(s->points);
    free(s->places);
    free(s->mirror.rows);
}

// A number for cells, given by their indices, in any order.
static uint64_t digest_of_cells(const deldrift_triangulation *t, const uint32_t *indices, size_t count) {
    deldrift_cells_view view;
    OK(deldrift_cells(t, &view));
    uint64_t sum = count;
    for (size_t k = 0; k < count; k++) {
        CHECK(indices[k] < view.count);
        sum += digest_of_row(view.vertices + (size_t)indices[k] * view.corners_per_cell, view.corners_per_cell);
    }
    return sum;
}

// Prepares what is staged, and more in a second round, with a look at the cells after each; takes all back. What fails after
// the first round is withdrawn with it.
static deldrift_status prepare_and_withdraw(scene *s) {
    deldrift_cells_view view;
    const deldrift_status status = deldrift_prepare_timestamp(s->t, NULL);
    if (status != DELDRIFT_OK) return status;
    deldrift_status later = deldrift_cells(s->t, &view);
    if (later == DELDRIFT_OK) later = deldrift_move_vertices(s->t, (uint32_t[]){3, 4}, s->points, 2);
    if (later == DELDRIFT_OK) later = deldrift_prepare_timestamp(s->t, NULL);
    if (later == DELDRIFT_OK) later = deldrift_cells(s->t, &view);
    CHECK(later == DELDRIFT_OK || later == DELDRIFT_OUT_OF_MEMORY || s->setting->segments > 0);
    const size_t before = n_requests;
    OK(deldrift_withdraw_timestamp(s->t));
    CHECK(n_requests == before);
    return status;
}

// Makes the call while requests are counted, and of them `first` is refused; a number for what it gives, as far as that does
// not depend on the order of cells.
static deldrift_status make_call(scene *s, size_t first, later too, uint64_t *given, const char **wrong) {
    uint32_t d = s->dimension, goal = (uint32_t)s->call.goal, vertex = (const uint32_t[]){12, 10, 30}[goal];
    double to[3], centre[3] = {0}, radius = 0, tolerance = 0;
    for (uint32_t i = 0; i < d; i++) {
        to[i] = goal == 0 ? s->points[12 * d + i] + 1e-3 : goal == 1 ? 1.5 + i : s->points[13 * d + i];
    }
    deldrift_options options = options_of(s);
    deldrift_triangulation *const none = (deldrift_triangulation *)ids_out, *made = none;
    deldrift_commit_report report = {.timestamp = 77};
    deldrift_split_report split = {.inserted = 77};
    deldrift_changes changes;
    deldrift_cells_view cells;
    deldrift_location location;
    uint32_t out = 77;
    size_t count = 0;
    deldrift_status status = DELDRIFT_OK;
    ids_out[0] = more_out[0] = 77;
    bytes_out[0] = 77;
    numbers_out[0] = 77;
    for (size_t k = 0; k < s->n_before; k++) numbers_out[k] = 77;
    static const double low[] = {0.2, 0.3, 0.1}, high[] = {0.9, 0.7, 2}, at[] = {0.51, 0.5, 0.49};
    static const double squared = 0.004;
    const uint8_t *mask = all_cells();
    size_t n_cells = cell_count(s->t), id_count = 0;
    OK(deldrift_id_count(s->t, &id_count));
    const uint32_t *numbers = numbers_from_0();
    static uint32_t vertices[ROOM];
    size_t n_vertices = 0;
    for (uint32_t v = 0; v < id_count; v++) {
        bool present;
        OK(deldrift_is_present(s->t, v, &present));
        if (present) vertices[n_vertices++] = v;
    }
    const uint32_t some_cell = n_cells > 0 ? 0 : DELDRIFT_NONE;
    size_t size = 0;
    const deldrift_field field = {"field", numbers_out, 1};
    deldrift_cells_view released = {77, 0, NULL, NULL};
    deldrift_released_cells *owner = NULL;
    deldrift_quality quality;
    deldrift_quality_report improved = {.inserted = 77};
    OK(deldrift_quality_init(&quality));
    // Without a criterion all goes that has been made.
    if (s->call.kind == REFINE) {
        quality.greatest_area = s->area / 40;
        quality.reuses_ids = 1;
    }
    quality.has_weights = 1;
    const char *file = file_of_test();
    static deldrift_location locations_out[ROOM];
    int32_t *const labels = (int32_t *)(void *)ids_out;
    static uint32_t segments_out[ROOM], chains_out[ROOM];
    // After all that may be staged, but in flat sets, where vertices are on them.
    const bool is_flat = s->setting->is_flat || s->setting->flattens;
    const size_t n_segments = d == 2 ? s->setting->segments : 0, n_more = is_flat ? 0 : 5;
    if (s->call.kind == LOAD) OK(deldrift_save(s->t, saved, sizeof saved, &size));
    if (s->call.kind == PERIODIC_LOAD) OK(deldrift_save(s->periodic, saved, sizeof saved, &size));
    if (s->call.kind == LOAD_FILE) OK(deldrift_save_file(s->t, file));
    count_requests(first, too);
    switch (s->call.kind) {
        case CREATE: status = deldrift_create(d, s->points, s->n, &options, &made); break;
        case RELOCATE: status = deldrift_relocate_vertex(s->t, vertex, to); break;
        case CREATE_WEIGHTED:
            status = deldrift_create_weighted(d, s->points, weights_of(s->n, d, 1), NULL, s->n, &options, &made);
            break;
        case CREATE_PERIODIC_WEIGHTED:
            status = deldrift_create_periodic_weighted(d, s->points, weights_of(s->n, d, 1), s->n, BOX[d - 2], d, &options, &made);
            break;
        case STAGE_WEIGHTS: status = deldrift_stage_weights(s->t, NULL, weights_of(s->n, d, 1), s->n); break;
        case COMMIT_WEIGHTED:
            status = deldrift_commit_weighted(s->t, goal == 0 ? NULL : s->places, weights_of(s->n, d, 1), s->n, &report);
            break;
        case SET_WEIGHT: status = deldrift_set_weight(s->t, vertex, goal == 0 ? 0.5 : goal == 1 ? -0.5 : 0); break;
        case INSERT_WITH_WEIGHT:
            status = deldrift_insert_vertex_with_weight(s->t, to, goal == 0 ? 0.5 : goal == 1 ? -0.5 : 0, &out);
            break;
        case STAGE_WITH_WEIGHTS:
            status = deldrift_stage_insertions_with_weights(s->t, s->points, weights_of(20, d, 1), 20, &out);
            break;
        case HIDDEN_BY_WEIGHT: status = deldrift_hidden_by_weight(s->t, ids_out, more_out, ROOM, &count); break;
        case HIDDEN_BY_PLACE: status = deldrift_hidden_vertices(s->t, ids_out, more_out, ROOM, &count); break;
        case STATISTICS: status = deldrift_statistics(s->t, &report); break;
        case REPRESENTATIVE: status = deldrift_coincident_representative(s->t, vertex, &out); break;
        case CREATE_PERIODIC:
            status = deldrift_create_periodic(d, s->points, s->n, BOX[d - 2], d, &options, &made);
            break;
        case PERIODIC_POSITIONS: status = deldrift_commit_positions(s->periodic, s->places, s->n, &report); break;
        case STAGE_VECTORS: status = deldrift_stage_vectors(s->periodic, OTHER_BOX[d - 2], d); break;
        case CELL_SHIFTS: status = deldrift_cell_shifts(s->periodic, shifts_out, NULL, ROOM / 12, &count); break;
        case EDGE_SHIFTS: status = deldrift_edge_shifts(s->periodic, shifts_out, ROOM / 3, &count); break;
        case PERIODIC_CENTRES:
            status = deldrift_circumcentres(s->periodic, NULL, numbers_out, ROOM, &count);
            break;
        case PERIODIC_CELLS:
            status = deldrift_voronoi_cells(s->periodic, NULL, NULL, NULL, 0, numbers_out, NULL, NULL, ROOM, &count);
            break;
        case PERIODIC_FACETS:
            status = deldrift_voronoi_derivatives(s->periodic, NULL, NULL, NULL, 0, numbers_out, NULL, NULL, ROOM, &count);
            break;
        case LOCATE_IN_PERIOD:
            status = deldrift_locate_in_period(s->periodic, s->places, s->n, NULL, locations_out, shifts_out);
            break;
        case PERIODIC_NEAREST: status = deldrift_nearest_vertices(s->periodic, to, 1, 9, ids_out); break;
        case PERIODIC_BALL: status = deldrift_vertices_in_ball(s->periodic, at, 0.09, ids_out, ROOM, &count); break;
        case PERIODIC_LISTS:
            status = deldrift_neighbour_lists(s->periodic, &squared, 1, NULL, 0, DELDRIFT_PAIRS_FULL, NULL, 0, ids_out,
                                              shifts_out, ROOM / 3, &count);
            break;
        case PERIODIC_LINEAR:
            status = deldrift_interpolate(s->periodic, DELDRIFT_INTERPOLATION_LINEAR, s->points, s->n, 1, at, 1, NULL, NULL,
                                          numbers_out);
            break;
        case PERIODIC_WEIGHTS: status = deldrift_barycentric(s->periodic, at, &some_cell, 1, numbers_out); break;
        case PERIODIC_CLONE: status = deldrift_clone(s->periodic, &made); break;
        case PERIODIC_LOAD: status = deldrift_load(saved, size, &options, &made); break;
        case PERIODIC_VTU: status = deldrift_write_vtu(s->periodic, file, NULL, 0, NULL, 0); break;
        case PERIODIC_NEIGHBOURS:
            status = deldrift_vertex_neighbours(s->periodic, NULL, 0, ids_out, ROOM, &count);
            break;
        case PERIODIC_CHECK: status = deldrift_validate(s->periodic, 3); break;
        case PERIODIC_HIDDEN: status = deldrift_hidden_vertices(s->periodic, ids_out, more_out, ROOM, &count); break;
        case PERIODIC_COMPACT: status = deldrift_compact(s->periodic, ids_out, ROOM, &count); break;
        case WRAP_POSITIONS:
            status = deldrift_wrap_positions(s->periodic, s->places, s->points, s->n, numbers_out, shifts_out);
            break;
        case CREATE_WITH_KEYS: status = deldrift_create_with_keys(d, s->points, keys_of(s->n), s->n, &options, &made); break;
        case INSERT_WITH_KEY: status = deldrift_insert_vertex_with_key(s->t, to, 3, &out); break;
        case INSERT: status = deldrift_insert_vertex(s->t, to, &out); break;
        case REMOVE: status = deldrift_remove_vertex(s->t, vertex); break;
        case MOVE: status = deldrift_move_vertex(s->t, 12, to); break;
        case MOVE_SOME: status = deldrift_move_vertices(s->t, (uint32_t[]){1, 2, 5}, s->places, 3); break;
        case MOVE_ALL: status = deldrift_move_vertices(s->t, NULL, s->places, s->n); break;
        case STAGE_INSERTIONS: status = deldrift_stage_insertions(s->t, s->points, 20, &out); break;
        case STAGE_WITH_KEYS:
            status = deldrift_stage_insertions_with_keys(s->t, s->points, keys_of(20), 20, &out);
            break;
        case STAGE_AT_FREE_IDS:
            status = deldrift_stage_insertions_at_free_ids(s->t, s->points, keys_of(20), 20, ids_out);
            break;
        case STAGE_REMOVALS: status = deldrift_stage_removals(s->t, (uint32_t[]){10, 20, 21, 22}, 4); break;
        case STAGE_SEGMENTS:
            status = deldrift_stage_segments(s->t, s->pairs[n_segments / 2], NULL, n_more, &out);
            break;
        case STAGE_SEGMENT_REMOVALS:
            status = deldrift_stage_segment_removals(s->t, (uint32_t[]){0, 1}, n_segments > 0 ? 2 : 0);
            break;
        case CHECK_STAGED: status = deldrift_check_staged(s->t); break;
        case CHECK_PASSINGS: status = deldrift_check_passings(s->t); break;
        case STAGE_SPLITS: status = deldrift_stage_splits(s->t, 100, &split); break;
        case COMMIT:
        case COMMIT_SOME: status = deldrift_commit_timestamp(s->t, &report); break;
        case COMMIT_POSITIONS: status = deldrift_commit_positions(s->t, s->places, s->n, &report); break;
        case PREPARE:
        case PREPARE_SOME:
            status = deldrift_prepare_timestamp(s->t, &report);
            if (status == DELDRIFT_OK) OK(deldrift_publish_timestamp(s->t));
            break;
        case WITHDRAW: status = prepare_and_withdraw(s); break;
        case COMPACT: status = deldrift_compact(s->t, ids_out, ROOM, &count); break;
        case TAKE_CHANGES: status = deldrift_take_changes(s->t, &changes); break;
        case TRANSFER_CELLS:
            status = deldrift_transfer_cells(s->t, NULL, 0, DELDRIFT_TRANSFER_SECOND_ORDER, numbers_out, s->n_before, 1, ROOM,
                                             NULL, NULL, NULL);
            break;
        case CELLS: status = deldrift_cells(s->t, &cells); break;
        case COPY_CELLS: status = deldrift_copy_cells(s->t, ids_out, more_out, ROOM / 4, &count); break;
        case STAR: status = deldrift_star(s->t, 12, ids_out, ROOM, &count); break;
        case TOLERANCE: status = deldrift_tolerance(s->t, 12, &tolerance); break;
        case ANNULUS_WIDTHS: status = deldrift_research_annulus_widths(s->t, numbers_out, ROOM, &count); break;
        case DELIMITER: status = deldrift_research_standard_delimiter(s->t, 11, 1, centre, &radius, &tolerance); break;
        case LOCATE: status = deldrift_locate(s->t, to, &location); break;
        case LOCATE_POINTS: status = deldrift_locate_points(s->t, to, 1, NULL, &location); break;
        case NEAREST: status = deldrift_nearest_vertex(s->t, to, &out); break;
        case CIRCUMCENTRES: status = deldrift_circumcentres(s->t, numbers_out, NULL, ROOM / 3, &count); break;
        case VOLUMES: status = deldrift_volumes(s->t, numbers_out, ROOM, &count); break;
        case MASK_BY_CIRCUMRADIUS: status = deldrift_mask_by_circumradius(s->t, 0.01, bytes_out, ROOM, &count); break;
        case MASK_BOUNDARY:
            status = deldrift_mask_boundary(s->t, mask, n_cells, ids_out, more_out, bytes_out, ROOM / 3, &count);
            break;
        case HULL_FACETS: status = deldrift_hull_facets(s->t, ids_out, more_out, bytes_out, ROOM / 3, &count); break;
        case EDGES: status = deldrift_edges(s->t, ids_out, ROOM / 2, &count); break;
        case VERTEX_NEIGHBOURS:
            status = deldrift_vertex_neighbours(s->t, more_out, id_count + 1, ids_out, ROOM, &count);
            break;
        case VERTEX_CELLS: status = deldrift_vertex_cells(s->t, more_out, id_count + 1, ids_out, ROOM, &count); break;
        case MIRROR_INDICES: status = deldrift_mirror_indices(s->t, bytes_out, ROOM / 4, &count); break;
        case MIRROR_INDEX: status = deldrift_mirror_index(s->t, 11, 1, &out); break;
        case ORDERED_STAR: status = deldrift_ordered_star(s->t, 12, ids_out, ROOM, &count); break;
        case CELLS_AROUND:
            status = deldrift_cells_around(s->t, (uint32_t[]){12}, 1, ids_out, ROOM, &count);
            break;
        case CELLS_AROUND_ALL: status = deldrift_cells_around(s->t, vertices, n_vertices, ids_out, ROOM, &count); break;
        case UPDATE_CIRCUMCENTRES:
            status = deldrift_update_circumcentres(s->t, numbers, n_cells, numbers_out, NULL, ROOM / 3);
            break;
        case UPDATE_VOLUMES: status = deldrift_update_volumes(s->t, numbers, n_cells, numbers_out, ROOM); break;
        case UPDATE_MASK:
            status = deldrift_update_mask_by_circumradius(s->t, numbers, n_cells, 0.01, bytes_out, ROOM);
            break;
        case VORONOI_VOLUMES: status = deldrift_voronoi_volumes(s->t, low, high, numbers_out, ROOM, &count); break;
        case VORONOI_FACETS: status = deldrift_voronoi_facets(s->t, low, high, numbers_out, ROOM, &count); break;
        case VORONOI_CHANGED:
            status = deldrift_voronoi_changed(s->t, (uint32_t[]){12}, 1, bytes_out, ROOM, &count);
            break;
        case VORONOI_CELLS:
            status = deldrift_voronoi_cells(s->t, low, high, NULL, 0, numbers_out, NULL, NULL, ROOM, &count);
            break;
        case VORONOI_CELLS_WITHIN:
            status = deldrift_voronoi_cells_within(s->t, low, high, (double[]){1, 1, 1, 0.5, 2, -1, 1, 3}, 2, NULL, 0,
                                                   numbers_out, NULL, NULL, ROOM, &count);
            break;
        case VORONOI_DERIVATIVES:
            status = deldrift_voronoi_derivatives(s->t, low, high, NULL, 0, numbers_out, NULL, NULL, ROOM, &count);
            break;
        case VORONOI_DERIVATIVES_WITHIN:
            status = deldrift_voronoi_derivatives_within(s->t, low, high, (double[]){1, 1, 1, 0.5, 2, -1, 1, 3}, 2, NULL, 0,
                                                         numbers_out, NULL, NULL, ROOM, &count);
            break;
        case VORONOI_BY_WEIGHTS: {
            size_t n_edges;
            status = deldrift_voronoi_weight_derivatives(s->t, low, high, NULL, 0, NULL, 0, numbers_out, ROOM / 2, &count,
                                                         numbers_out + ROOM / 2, ROOM / 2, &n_edges);
            break;
        }
        case VORONOI_BOTH: {
            size_t n_edges;
            status = deldrift_voronoi_cells_and_facets(s->t, low, high, NULL, 0, NULL, 0, numbers_out, NULL, NULL, ROOM / 2,
                                                       &count, numbers_out + ROOM / 2, NULL, NULL, ROOM / 2, &n_edges);
            break;
        }
        case INTERPOLATE:
        case INTERPOLATE_NATURAL:
            status = deldrift_interpolate(s->t, s->call.kind == INTERPOLATE_NATURAL, s->points, id_count, 1, at, 1,
                                          NULL, NULL, numbers_out);
            break;
        case NEAREST_VERTICES: status = deldrift_nearest_vertices(s->t, to, 1, 9, ids_out); break;
        case VERTICES_IN_BALL: status = deldrift_vertices_in_ball(s->t, at, 0.09, ids_out, ROOM, &count); break;
        case NEIGHBOUR_LISTS:
            status = deldrift_neighbour_lists(s->t, &squared, 1, NULL, 0, DELDRIFT_PAIRS_HALF, NULL, 0, ids_out, NULL, ROOM,
                                              &count);
            break;
        case VERTICES_IN_BOX: status = deldrift_vertices_in_box(s->t, low, high, ids_out, ROOM, &count); break;
        case CONFLICTS: status = deldrift_conflicts(s->t, to, NULL, ids_out, ROOM, &count); break;
        case CELLS_IN_REACH:
            status = deldrift_cells_in_reach(s->t, low, high, 1, NULL, 0, ids_out, numbers_out, NULL, ROOM / 3, &count);
            break;
        case HULL_FACETS_IN_REACH:
            status = deldrift_hull_facets_in_reach(s->t, low, high, 1, NULL, 0, ids_out, bytes_out, ROOM, &count);
            break;
        case VERTICES_IN_REACH:
            status = deldrift_vertices_in_reach(s->t, low, high, 1, NULL, 0, ids_out, NULL, ROOM, &count);
            break;
        case FIND_SIMPLICES: status = deldrift_find_simplices(s->t, 2, vertices, 2, ids_out); break;
        case FIND_SIMPLICES_ALL: status = deldrift_find_simplices(s->t, 2, vertices, n_vertices / 2, ids_out); break;
        case CELL_OF_EACH_VERTEX: status = deldrift_cell_of_each_vertex(s->t, ids_out, ROOM, &count); break;
        case BARYCENTRIC: status = deldrift_barycentric(s->t, at, &some_cell, 1, numbers_out); break;
        case MASK_WITHOUT_FLAT_CELLS:
            status = deldrift_mask_without_flat_cells(s->t, 0.1, bytes_out, ROOM, &count);
            break;
        case SEGMENTS_OF_CELLS: status = deldrift_segments_of_cells(s->t, ids_out, ROOM / 3, &count); break;
        case CELLS_OF_SEGMENTS: status = deldrift_cells_of_segments(s->t, ids_out, ROOM / 2, &count); break;
        case NESTING_LEVELS: status = deldrift_nesting_levels(s->t, ids_out, ROOM, &count); break;
        case CROSSING_NUMBERS: status = deldrift_crossing_numbers(s->t, ids_out, ROOM, &count); break;
        case LABEL_CELLS: status = deldrift_label_cells(s->t, at, (int32_t[]){5}, 1, 2, labels, ROOM, &count); break;
        case SET_REGIONS: status = deldrift_set_regions(s->t, one_region, n_cells); break;
        case REGIONS: status = deldrift_regions(s->t, 2, labels, ROOM, &count, NULL); break;
        case UPDATE_LABELS:
            status = deldrift_update_labels(s->t, numbers, n_cells, 3, labels, ROOM, &count);
            break;
        case BOUNDARY_CHAINS:
            status = deldrift_boundary_chains(s->t, mask, n_cells, ids_out, more_out, segments_out, chains_out, bytes_out,
                                              ROOM, &count);
            break;
        case REFINE: status = deldrift_refine(s->t, &quality, NULL, 0, &improved); break;
        case COARSEN: status = deldrift_coarsen(s->t, &quality, NULL, 0, &improved); break;
        case RELEASE_CELLS: status = deldrift_release_cells(s->t, &released, &owner); break;
        case CLONE: status = deldrift_clone(s->t, &made); break;
        case SAVE: status = deldrift_save(s->t, bytes_out, sizeof bytes_out, &count); break;
        case LOAD: status = deldrift_load(saved, size, &options, &made); break;
        case SAVE_FILE: status = deldrift_save_file(s->t, file); break;
        case LOAD_FILE: status = deldrift_load_file(file, &options, &made); break;
        case WRITE_VTU: status = deldrift_write_vtu(s->t, file, &field, 1, NULL, 0); break;
        case WRITE_MEDIT: status = deldrift_write_medit(s->t, file, labels, n_cells); break;
        case N_KINDS: break;
    }
    stop_counting();
    // It is there exactly if it has been written.
    bool writes = s->call.kind == SAVE_FILE || s->call.kind == WRITE_VTU || s->call.kind == WRITE_MEDIT || s->call.kind == PERIODIC_VTU;
    bool is_there = unlink(file) == 0;
    if (writes && is_there != (status == DELDRIFT_OK)) {
        *wrong = "half a file";
        return status;
    }
    *wrong = NULL;
    *given = status;
    if (DELDRIFT_CROSSING <= status && status <= DELDRIFT_ENDS_MEET) {
        deldrift_conflict conflicts[64];
        size_t n_conflicts;
        OK(deldrift_segment_conflicts(s->t, conflicts, 64, &n_conflicts));
        *given = mixed(status, digest_of(conflicts, n_conflicts * sizeof *conflicts));
    }
    if (status == DELDRIFT_PASSES_SEGMENT) {
        static uint32_t passed[4000], passing[4000];
        size_t n_passings;
        OK(deldrift_passings(s->t, passed, passing, 4000, &n_passings));
        *given = mixed(mixed(status, digest_of(passed, n_passings * sizeof *passed)),
                       digest_of(passing, n_passings * sizeof *passing));
    }
    if (status != DELDRIFT_OK) {
        bool untouched = made == none && report.timestamp == 77 && out == 77 && ids_out[0] == 77 && more_out[0] == 77;
        if (owner != NULL || released.count != 77) *wrong = "an owner is given";
        untouched = untouched && improved.inserted == 77;
        if (!untouched || bytes_out[0] != 77 || numbers_out[0] != 77 || count != 0) *wrong = "an output is written";
        return status;
    }
    switch (s->call.kind) {
        case CREATE_PERIODIC:
        case CREATE_PERIODIC_WEIGHTED:
            *given = digest_of_periodic(made, d);
            deldrift_destroy(made);
            break;
        case PERIODIC_POSITIONS: *given = digest_of_periodic(s->periodic, d); break;
        case STAGE_VECTORS:
            OK(deldrift_commit_timestamp(s->periodic, NULL));
            *given = digest_of_periodic(s->periodic, d);
            break;
        case CELL_SHIFTS:
        case EDGE_SHIFTS:
        case PERIODIC_CELLS:
        case PERIODIC_CENTRES:
        case PERIODIC_FACETS: *given = count; break;
        case LOCATE_IN_PERIOD:
            for (size_t i = 0; i < s->n; i++) *given = mixed(*given, locations_out[i].kind);
            break;
        case PERIODIC_WEIGHTS: break;
        case PERIODIC_COMPACT: *given = digest_of_periodic(s->periodic, d); break;
        case PERIODIC_HIDDEN: *given = digest_of(ids_out, count * sizeof *ids_out); break;
        case PERIODIC_NEIGHBOURS: *given = digest_of(ids_out, count * sizeof *ids_out); break;
        case PERIODIC_CLONE:
        case PERIODIC_LOAD:
            *given = digest_of_periodic(made, d);
            if (deldrift_validate(made, 3) != DELDRIFT_OK) *wrong = "no triangulation";
            deldrift_destroy(made);
            break;
        case CREATE:
        case CREATE_WITH_KEYS:
        case CREATE_WEIGHTED:
        case CLONE:
        case LOAD:
        case LOAD_FILE:
            *given = arrays_of(made).cells;
            if (deldrift_validate(made, 3) != DELDRIFT_OK) *wrong = "no triangulation";
            deldrift_destroy(made);
            break;
        case COMMIT:
        case COMMIT_SOME:
        case COMMIT_POSITIONS:
        case COMMIT_WEIGHTED:
        case STATISTICS:
            *given = digest_of((uint64_t[]){report.timestamp, report.coincident, report.inserted, report.removed,
                                            report.hidden_by_weight, report.newly_hidden, report.newly_shown}, 56);
            break;
        case HIDDEN_BY_WEIGHT:
        case HIDDEN_BY_PLACE: *given = digest_of(ids_out, count * sizeof *ids_out); break;
        case COMPACT:
            *given = digest_of(ids_out, count * sizeof *ids_out);
            renumber(&s->mirror, d + 1, ids_out);
            break;
        case TAKE_CHANGES: *wrong = follow(&s->mirror, &changes, s->t); break;
        case TRANSFER_CELLS:
            for (size_t i = 0; i < cell_count(s->t); i++) *given += numbers_out[i] == 77;
            break;
        case STAGE_SPLITS: *given = digest_of(&split, sizeof split); break;
        case STAGE_AT_FREE_IDS: *given = digest_of(ids_out, 20 * sizeof *ids_out); break;
        case CELLS: *given = cells.count; break;
        case COPY_CELLS: {
            deldrift_cells_view view;
            OK(deldrift_cells(s->t, &view));
            size_t bytes = view.count * (d + 1) * sizeof *ids_out;
            if (count != view.count) *wrong = "not a copy";
            if (count > 0 && memcmp(ids_out, view.vertices, bytes) != 0) *wrong = "not a copy";
            if (count > 0 && memcmp(more_out, view.neighbours, bytes) != 0) *wrong = "not a copy";
            break;
        }
        case RELEASE_CELLS:
            // What is handed over is the cells, as a set.
            *given = released.count == cell_count(s->t) ? digest_of(&released.count, sizeof released.count) : 0;
            for (size_t i = 0; i < released.count * (d + 1); i++) *given += released.vertices[i];
            deldrift_free_cells(owner);
            break;
        case ORDERED_STAR:
        case HULL_FACETS_IN_REACH:
        case SAVE: *given = count; break;
        case CELLS_AROUND:
        case CELLS_AROUND_ALL:
        case CONFLICTS:
        case CELLS_IN_REACH:
        case STAR: *given = digest_of_cells(s->t, ids_out, count); break;
        case PERIODIC_LINEAR:
        case INTERPOLATE:
        case INTERPOLATE_NATURAL:
            // Its last bits depend on the order of cells.
            *given = numbers_out[0] == numbers_out[0] ? (uint64_t)(1e6 * (numbers_out[0] + 4)) : 0;
            break;
        case VORONOI_CELLS:
        case VORONOI_CELLS_WITHIN:
        case VORONOI_BY_WEIGHTS:
        case VORONOI_BOTH:
        case VORONOI_VOLUMES:
            for (size_t i = 0; i < count; i++) *given += (uint64_t)(1e6 * (numbers_out[i] > 0 ? numbers_out[i] : 0));
            break;
        case UPDATE_CIRCUMCENTRES:
        case UPDATE_VOLUMES: count = n_cells; // fall through
        case CIRCUMCENTRES:
        case VOLUMES:
        case ANNULUS_WIDTHS:
            if (s->call.kind == CIRCUMCENTRES || s->call.kind == UPDATE_CIRCUMCENTRES) count *= d;
            for (size_t i = 0; i < count; i++) *given += digest_of(&numbers_out[i], sizeof *numbers_out);
            break;
        case PERIODIC_NEAREST:
        case NEAREST_VERTICES: *given = digest_of(ids_out, 9 * sizeof *ids_out); break;
        case PERIODIC_BALL:
        case PERIODIC_LISTS:
        case NEIGHBOUR_LISTS:
        case VERTICES_IN_BALL:
        case VERTICES_IN_REACH:
        case VERTICES_IN_BOX: *given = digest_of(ids_out, count * sizeof *ids_out); break;
        case FIND_SIMPLICES: count = 2; // fall through
        case FIND_SIMPLICES_ALL:
            if (s->call.kind == FIND_SIMPLICES_ALL) count = n_vertices / 2; // fall through
        case CELL_OF_EACH_VERTEX:
            // Which cell it is depends on the order of cells.
            for (size_t i = 0; i < count; i++) *given = mixed(*given, ids_out[i] == DELDRIFT_NONE);
            break;
        case BARYCENTRIC: *given = isnan(numbers_out[0]) != 0; break;
        // The order of cells is not the scene's; which edges of a cell have segments is told by sums.
        case SEGMENTS_OF_CELLS:
            for (size_t i = 0; i < 3 * count; i++) *given += mixed(5, ids_out[i]);
            break;
        case CELLS_OF_SEGMENTS:
            for (size_t i = 0; i < 2 * count; i++) {
                const bool is_cell = ids_out[i] != DELDRIFT_NONE;
                *given = mixed(*given, is_cell ? digest_of_cells(s->t, &ids_out[i], 1) : 9);
            }
            break;
        case UPDATE_LABELS: *given = count; break;
        case LABEL_CELLS:
        case NESTING_LEVELS:
        case CROSSING_NUMBERS:
            for (size_t i = 0; i < count; i++) *given += ids_out[i];
            break;
        case BOUNDARY_CHAINS: *given = digest_of(ids_out, count * sizeof *ids_out); break;
        case REFINE:
        case COARSEN:
            if (s->area > 0 && improved.inserted + improved.removed == 0) *wrong = "nothing is done";
            *given = digest_of(&improved, sizeof improved);
            break;
        case UPDATE_MASK: count = n_cells; // fall through
        case MASK_WITHOUT_FLAT_CELLS:
        case MASK_BY_CIRCUMRADIUS:
            for (size_t i = 0; i < count; i++) *given += bytes_out[i];
            break;
        case MIRROR_INDICES:
            for (size_t i = 0; i < count * (d + 1); i++) *given += bytes_out[i] == UINT8_MAX;
            break;
        case MASK_BOUNDARY:
        case HULL_FACETS:
            for (size_t i = 0; i < count; i++) *given += digest_of_row(ids_out + i * d, d);
            break;
        case EDGES: *given = digest_of(ids_out, 2 * count * sizeof *ids_out); break;
        case VERTEX_NEIGHBOURS: *given = digest_of(ids_out, count * sizeof *ids_out) + more_out[id_count]; break;
        case VERTEX_CELLS: *given = digest_of_cells(s->t, ids_out, count) + more_out[id_count]; break;
        case VORONOI_DERIVATIVES:
        case VORONOI_FACETS: *given = count; break;
        case MIRROR_INDEX: *given = 0; break;
        case TOLERANCE: *given = digest_of(&tolerance, sizeof tolerance); break;
        case LOCATE:
        case LOCATE_POINTS: {
            bool is_cell = location.kind == DELDRIFT_LOCATION_CELL || location.kind == DELDRIFT_LOCATION_OUTSIDE;
            *given = mixed(location.kind, is_cell ? digest_of_cells(s->t, &location.index, 1) : location.index);
            break;
        }
        default: *given = out;
    }
    return status;
}

#endif
