// Meshes of domains: angles, areas, pieces and weights, measured here; a domain that is squeezed; what is refused.
#include "buffers.h"

enum { ROOM = 20000, CORNERS = 8, NAILS = 4 };

// A square with a square hole, and a loop in another one that is no part of it.
static const double PLACES[2 * CORNERS] = {0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 1, 2, 2, 2, 2, 1};

static deldrift_triangulation *domain(const deldrift_options *options) {
    deldrift_triangulation *t = create(2, PLACES, CORNERS, options);
    uint32_t ends[CORNERS][2], first;
    int32_t markers[CORNERS];
    for (uint32_t k = 0; k < CORNERS; k++) {
        ends[k][0] = k;
        ends[k][1] = k - k % 4 + (k + 1) % 4;
        markers[k] = 10 + (int32_t)k;
    }
    OK(deldrift_stage_segments(t, ends[0], markers, CORNERS, &first));
    OK(deldrift_commit_timestamp(t, NULL));
    return t;
}

static double positions[2 * ROOM], least_angle, greatest_area, area, longest_share;
static double *sizes;
static size_t n_cells;

// Measures the cells of an odd level.
static void measure(const deldrift_triangulation *t) {
    static uint32_t levels[ROOM];
    size_t n;
    const deldrift_cells_view view = cells_of(t);
    CHECK(view.count <= ROOM);
    OK(deldrift_nesting_levels(t, levels, ROOM, &n));
    OK(deldrift_copy_positions(t, positions, ROOM, &n));
    least_angle = 180, greatest_area = area = longest_share = 0, n_cells = 0;
    for (size_t c = 0; c < view.count; c++) {
        if (levels[c] % 2 == 0) continue;
        n_cells++;
        const double *p[3];
        double mean = 0;
        for (int i = 0; i < 3; i++) {
            const uint32_t v = view.vertices[3 * c + (size_t)i];
            p[i] = positions + 2 * v;
            if (sizes != NULL) mean += 0.1 + 0.1 * p[i][0];
        }
        for (int i = 0; i < 3; i++) {
            const double *o = p[i], *a = p[(i + 1) % 3], *b = p[(i + 2) % 3];
            const double u[2] = {a[0] - o[0], a[1] - o[1]}, w[2] = {b[0] - o[0], b[1] - o[1]};
            const double cross = u[0] * w[1] - u[1] * w[0], angle = atan2(cross, u[0] * w[0] + u[1] * w[1]);
            least_angle = fmin(least_angle, angle * 180 / acos(-1));
            if (i == 0) area += cross / 2, greatest_area = fmax(greatest_area, cross / 2);
            if (sizes != NULL) longest_share = fmax(longest_share, hypot(u[0], u[1]) / (mean / 3));
        }
    }
    OK(deldrift_validate(t, 3));
}

// Pieces are chains along the segments, with their markers.
static void check_pieces(const deldrift_triangulation *t) {
    static uint32_t ends[ROOM][2], originals[ROOM], made[ROOM], on[ROOM];
    static int32_t markers[ROOM];
    size_t n, n_originals, n_made, n_on = 0;
    double lengths[CORNERS] = {0};
    OK(deldrift_segments(t, NULL, ends[0], markers, ROOM, &n));
    OK(deldrift_original_segments(t, originals, ROOM, &n_originals));
    CHECK(n == n_originals);
    for (size_t k = 0; k < n; k++) {
        CHECK(originals[k] < CORNERS && markers[k] == 10 + (int32_t)originals[k]);
        const double *a = positions + 2 * ends[k][0], *b = positions + 2 * ends[k][1];
        lengths[originals[k]] += hypot(a[0] - b[0], a[1] - b[1]);
    }
    for (int k = 0; k < CORNERS; k++) CHECK(fabs(lengths[k] - (k < 4 ? 4 : 1)) < 1e-12);
    OK(deldrift_made_vertices(t, made, on, ROOM, &n_made));
    for (size_t k = 0; k < n_made; k++) {
        CHECK(made[k] >= CORNERS && (k == 0 || made[k] > made[k - 1]));
        CHECK(on[k] == DELDRIFT_NONE || on[k] < CORNERS);
        n_on += on[k] != DELDRIFT_NONE;
    }
    CHECK(n == CORNERS + n_on);
}

static double linear(const double *p) { return 3 + 2 * p[0] - p[1]; }

// A linear function is carried over by the weights.
static void check_weights(const deldrift_triangulation *t, size_t n_before, size_t inserted) {
    static uint32_t vertices[ROOM][3], ids[ROOM];
    static double weights[ROOM][3];
    size_t n;
    OK(deldrift_refined_vertices(t, ids, ROOM, &n));
    CHECK(n == inserted);
    OK(deldrift_refined_weights(t, vertices[0], weights[0], ROOM, &n));
    CHECK(n == inserted);
    for (size_t k = 0; k < n; k++) {
        double value = 0, sum = 0;
        for (int i = 0; i < 3; i++) {
            CHECK(vertices[k][i] < n_before && weights[k][i] >= 0);
            value += weights[k][i] * linear(positions + 2 * vertices[k][i]);
            sum += weights[k][i];
        }
        CHECK(fabs(sum - 1) < 1e-12 && fabs(value - linear(positions + 2 * ids[k])) < 1e-12);
    }
}

static void a_domain_gets_the_quality_asked_for(void) {
    deldrift_triangulation *t = domain(NULL);
    deldrift_quality quality;
    deldrift_quality_report report;
    OK(deldrift_quality_init(&quality));
    OK(deldrift_refine(t, &quality, NULL, 0, &report));
    CHECK(report.inserted == 0 && report.bad_cells == 0);
    quality.least_angle = 30;
    quality.greatest_area = 0.02;
    quality.has_weights = 1;
    OK(deldrift_refine(t, &quality, NULL, 0, &report));
    measure(t);
    size_t ids;
    OK(deldrift_id_count(t, &ids));
    CHECK(report.inserted == ids - CORNERS && report.inserted > 500 && report.bad_cells == 0 && report.is_cut_short == 0);
    CHECK(least_angle >= 30 && greatest_area <= 0.02 && fabs(area - 15) < 1e-12);
    check_pieces(t);
    check_weights(t, CORNERS, report.inserted);
    // Nothing is done twice, and then no vertex has been inserted by the last call.
    uint64_t before, after;
    OK(deldrift_timestamp(t, &before));
    OK(deldrift_refine(t, &quality, NULL, 0, &report));
    OK(deldrift_timestamp(t, &after));
    size_t n;
    OK(deldrift_refined_weights(t, NULL, NULL, 0, &n));
    CHECK(report.inserted == 0 && before == after && n == 0);
    // With a coarser quality most of them go, and no angle gets too small.
    quality.greatest_area = 0.5;
    quality.least_angle = 20;
    quality.growth = INFINITY;
    OK(deldrift_coarsen(t, &quality, NULL, 0, &report));
    CHECK(report.removed > ids / 10 * 8 && report.inserted == 0);
    measure(t);
    CHECK(least_angle >= 20 && greatest_area <= 0.5 && fabs(area - 15) < 1e-12);
    check_pieces(t);
    // As fine again, with the ids of those that have gone.
    const uint64_t n_free = report.removed;
    quality.greatest_area = 0.03;
    quality.reuses_ids = 1;
    OK(deldrift_refine(t, &quality, NULL, 0, &report));
    measure(t);
    OK(deldrift_id_count(t, &n));
    CHECK(report.inserted > 300 && n == ids + (report.inserted > n_free ? report.inserted - n_free : 0));
    check_weights(t, n, report.inserted);
    check_pieces(t);
    OK(deldrift_refined_vertices(t, NULL, 0, &n));
    CHECK(n == report.inserted);
    OK(deldrift_compact(t, NULL, 0, &n));
    OK(deldrift_refined_vertices(t, NULL, 0, &n));
    CHECK(n == 0);
    deldrift_destroy(t);
}

static int is_wide(void *calls, const double *corners) {
    ++*(size_t *)calls;
    const double low = fmin(corners[0], fmin(corners[2], corners[4])), high = fmax(corners[0], fmax(corners[2], corners[4]));
    return high - low > 0.5;
}

static void cells_are_of_the_sizes_asked_for(void) {
    deldrift_triangulation *t = domain(NULL);
    deldrift_quality quality;
    deldrift_quality_report report;
    double of_vertices[CORNERS];
    for (int k = 0; k < CORNERS; k++) of_vertices[k] = 0.1 + 0.1 * PLACES[2 * k];
    OK(deldrift_quality_init(&quality));
    quality.least_angle = 25;
    quality.sizes = sizes = of_vertices;
    quality.size_count = CORNERS;
    OK(deldrift_refine(t, &quality, NULL, 0, &report));
    measure(t);
    CHECK(report.inserted > 300 && least_angle >= 25 && longest_share <= 1 + 1e-9);
    sizes = NULL;
    // With the sizes that it had at its vertices there is nothing to do.
    static double all[ROOM];
    size_t n;
    for (int k = 0; k < CORNERS; k++) all[k] = of_vertices[k];
    OK(deldrift_refined_sizes(t, all + CORNERS, ROOM - CORNERS, &n));
    CHECK(n == report.inserted);
    quality.sizes = all;
    quality.size_count = CORNERS + n;
    OK(deldrift_refine(t, &quality, NULL, 0, &report));
    OK(deldrift_refined_sizes(t, NULL, 0, &n));
    CHECK(report.inserted == 0 && n == 0);
    deldrift_destroy(t);

    // Areas by region: that of the hole, and of all else.
    t = domain(NULL);
    static int32_t labels[ROOM];
    static uint8_t mask[ROOM];
    const double areas[] = {0, 0.001}, seed[] = {1.5, 1.5};
    OK(deldrift_label_cells(t, seed, (const int32_t[]){1}, 1, -1, labels, ROOM, &n));
    memset(mask, 1, n);
    OK(deldrift_quality_init(&quality));
    quality.labels = labels;
    quality.label_count = n;
    quality.areas = areas;
    quality.area_count = 2;
    OK(deldrift_refine(t, &quality, mask, n, &report));
    measure(t);
    CHECK(report.inserted > 400 && greatest_area > 0.01);
    const size_t in_all = report.inserted;
    deldrift_destroy(t);

    // A callback, which is not asked about cells of other regions.
    t = domain(NULL);
    size_t calls = 0;
    OK(deldrift_quality_init(&quality));
    quality.is_too_large = is_wide;
    quality.user_data = &calls;
    OK(deldrift_refine(t, &quality, NULL, 0, &report));
    CHECK(calls > report.inserted && report.inserted > 10 && report.inserted < in_all);
    measure(t);
    check_pieces(t);
    deldrift_destroy(t);
}

static int stops(void *left, const double *corners) {
    (void)corners;
    return --*(int *)left == 0 ? -1 : *(int *)left > 0;
}

// It is not called again, and nothing has changed.
static void a_callback_may_stop_the_call(void) {
    deldrift_triangulation *t = domain(NULL);
    deldrift_quality quality;
    deldrift_quality_report report;
    size_t ids;
    uint64_t before, after;
    OK(deldrift_timestamp(t, &before));
    OK(deldrift_quality_init(&quality));
    quality.greatest_area = 0.5;
    quality.is_too_large = stops;
    for (int calls = 1; calls < 60; calls += 7) {
        int left = calls;
        quality.user_data = &left;
        CHECK_STATUS(deldrift_refine(t, &quality, NULL, 0, &report), DELDRIFT_CANCELLED);
        CHECK_MESSAGE("a callback asked to stop");
        OK(deldrift_id_count(t, &ids));
        OK(deldrift_timestamp(t, &after));
        CHECK(left == 0 && ids == CORNERS && before == after);
    }
    quality.is_too_large = NULL;
    OK(deldrift_refine(t, &quality, NULL, 0, &report));
    OK(deldrift_id_count(t, &ids));
    int left = 1;
    quality.is_too_large = stops;
    quality.user_data = &left;
    CHECK_STATUS(deldrift_coarsen(t, &quality, NULL, 0, &report), DELDRIFT_CANCELLED);
    CHECK(left == 0);
    measure(t);
    check_pieces(t);
    deldrift_destroy(t);
}

// The most that a corner of a cell at a segment is inside the circle around it.
static double depth_in_circles(const deldrift_triangulation *t) {
    static uint32_t levels[ROOM], sides[ROOM][3];
    size_t n;
    const deldrift_cells_view view = cells_of(t);
    OK(deldrift_copy_positions(t, positions, ROOM, &n));
    OK(deldrift_nesting_levels(t, levels, ROOM, &n));
    OK(deldrift_segments_of_cells(t, sides[0], ROOM, &n));
    double depth = 0;
    for (size_t c = 0; c < n; c++) {
        for (size_t i = 0; i < 3; i++) {
            if (levels[c] % 2 == 0 || sides[c][i] == DELDRIFT_NONE) continue;
            const double *o = positions + 2 * view.vertices[3 * c + i], *a = positions + 2 * view.vertices[3 * c + (i + 1) % 3],
                         *b = positions + 2 * view.vertices[3 * c + (i + 2) % 3];
            depth = fmax(depth, -((a[0] - o[0]) * (b[0] - o[0]) + (a[1] - o[1]) * (b[1] - o[1])));
        }
    }
    return depth;
}

static void all_cells_are_delaunay_on_request(void) {
    deldrift_triangulation *t = domain(NULL);
    deldrift_quality quality;
    deldrift_quality_report report;
    OK(deldrift_quality_init(&quality));
    CHECK(depth_in_circles(t) > 0);
    quality.is_conforming = 1;
    OK(deldrift_refine(t, &quality, NULL, 0, &report));
    CHECK(report.inserted > 0 && report.inserted == report.on_segments && report.unsplit == 0 && depth_in_circles(t) == 0);
    quality.greatest_area = 0.01;
    OK(deldrift_refine(t, &quality, NULL, 0, &report));
    CHECK(report.inserted > 500 && depth_in_circles(t) == 0);
    quality.greatest_area = 1;
    OK(deldrift_coarsen(t, &quality, NULL, 0, &report));
    CHECK(report.removed > 400 && depth_in_circles(t) == 0);
    measure(t);
    check_pieces(t);
    deldrift_destroy(t);
}

static void segments_stay_whole_on_request(void) {
    for (uint32_t keeps = DELDRIFT_KEPT_OUTER; keeps <= DELDRIFT_KEPT_ALL; keeps++) {
        deldrift_triangulation *t = domain(NULL);
        deldrift_quality quality;
        deldrift_quality_report report;
        size_t n;
        OK(deldrift_quality_init(&quality));
        quality.greatest_area = 0.01;
        quality.keeps = (deldrift_kept)keeps;
        OK(deldrift_refine(t, &quality, NULL, 0, &report));
        OK(deldrift_segments(t, NULL, NULL, NULL, 0, &n));
        CHECK(n == CORNERS && report.on_segments == 0 && report.inserted > 100);
        quality.greatest_area = 0.001;
        quality.limit = 7;
        OK(deldrift_refine(t, &quality, NULL, 0, &report));
        CHECK(report.inserted == 7 && report.is_cut_short == 1 && report.bad_cells > 0);
        deldrift_destroy(t);
    }
}

static void a_squeezed_domain_keeps_its_number_of_vertices(void) {
    deldrift_triangulation *t = domain(NULL);
    deldrift_quality quality;
    OK(deldrift_quality_init(&quality));
    quality.least_angle = 25;
    quality.greatest_area = 0.05;
    size_t n, most[2] = {0, 0}, removed = 0, inserted = 0;
    double width = 1;
    for (int step = 0; step < 200; step++) {
        const double wanted = exp(0.5 * sin(0.2 * step));
        OK(deldrift_copy_positions(t, positions, ROOM, &n));
        for (size_t k = 0; k < n; k++) positions[2 * k] *= wanted / width;
        width = wanted;
        OK(deldrift_commit_positions(t, positions, n, NULL));
        deldrift_quality_report report;
        OK(deldrift_coarsen(t, &quality, NULL, 0, &report));
        removed += report.removed;
        OK(deldrift_refine(t, &quality, NULL, 0, &report));
        inserted += report.inserted;
        measure(t);
        CHECK(report.bad_cells == 0 && least_angle >= 25 && greatest_area <= 0.05 && fabs(area - 15 * width) < 1e-9);
        OK(deldrift_vertex_count(t, &n));
        if (n > most[step / 100]) most[step / 100] = n;
    }
    CHECK(removed > 300 && inserted > 300 && most[1] < most[0] + most[0] / 10);
    deldrift_destroy(t);
}

static bool cancel_now(void *is_wanted) { return *(bool *)is_wanted; }

static void what_has_no_meaning_is_refused(void) {
    bool is_cancelled = false;
    deldrift_options options;
    deldrift_options_init(&options);
    options.cancel = cancel_now;
    options.user_data = &is_cancelled;
    deldrift_triangulation *t = domain(&options), *solid = create(3, TETRAHEDRON, TETRAHEDRON_COUNT, NULL);
    deldrift_quality good, quality;
    static const uint8_t mask[64] = {1};
    size_t n;
    OK(deldrift_cell_count(t, &n));
    OK(deldrift_quality_init(&good));
    good.least_angle = 20;
    good.greatest_area = 0.01;
    const struct {
        size_t at;
        double value;
        const char *message;
    } numbers[] = {
        {offsetof(deldrift_quality, least_angle), 34.5, "quality.least_angle[0] is 34.5"},
        {offsetof(deldrift_quality, least_angle), NAN, "quality.least_angle[0] is NaN"},
        {offsetof(deldrift_quality, greatest_area), -1, "quality.greatest_area[0] is -1"},
        {offsetof(deldrift_quality, margin), NAN, "quality.margin[0] is NaN"},
        {offsetof(deldrift_quality, margin), 31, "quality.margin[0] is 31"},
        {offsetof(deldrift_quality, share), 0, "quality.share[0] is 0"},
        {offsetof(deldrift_quality, share), 1.5, "quality.share[0] is 1.5"},
        {offsetof(deldrift_quality, joins), -1, "quality.joins[0] is -1"},
        {offsetof(deldrift_quality, joins), NAN, "quality.joins[0] is NaN"},
    };
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        quality = good;
        *(double *)((char *)&quality + numbers[k].at) = numbers[k].value;
        CHECK_STATUS(deldrift_refine(t, &quality, NULL, 0, NULL), DELDRIFT_INVALID_VALUE);
        CHECK_MESSAGE(numbers[k].message);
        CHECK_STATUS(deldrift_coarsen(t, &quality, NULL, 0, NULL), DELDRIFT_INVALID_VALUE);
    }
    quality = good;
    quality.keeps = (deldrift_kept)3;
    CHECK_STATUS(deldrift_refine(t, &quality, NULL, 0, NULL), DELDRIFT_INVALID_OPTIONS);
    CHECK_MESSAGE("quality.keeps is 3");
    quality = good;
    quality.struct_size = 3;
    CHECK_STATUS(deldrift_refine(t, &quality, NULL, 0, NULL), DELDRIFT_INVALID_OPTIONS);
    CHECK_MESSAGE("quality.struct_size is 3");
    quality = good;
    quality.size_count = 3;
    CHECK_STATUS(deldrift_refine(t, &quality, NULL, 0, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("quality.sizes is NULL");
    const double few[] = {1, 1, 1}, areas[] = {1, -1};
    quality.sizes = few;
    CHECK_STATUS(deldrift_refine(t, &quality, NULL, 0, NULL), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("quality.size_count is 3, but must be 8");
    quality = good;
    quality.areas = areas;
    quality.area_count = 2;
    CHECK_STATUS(deldrift_refine(t, &quality, NULL, 0, NULL), DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("quality.areas[1] is -1");
    CHECK_STATUS(deldrift_refine(t, &good, mask, n - 1, NULL), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("mask_count is");
    CHECK_STATUS(deldrift_refine(t, &good, mask, n, NULL), DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("no segment");
    CHECK_STATUS(deldrift_refine(t, &good, NULL, 5, NULL), DELDRIFT_WRONG_COUNT);
    CHECK_STATUS(deldrift_refine(t, NULL, NULL, 0, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("quality is NULL");
    CHECK_STATUS(deldrift_refine(solid, &good, NULL, 0, NULL), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_coarsen(solid, &good, NULL, 0, NULL), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_made_vertices(solid, NULL, NULL, 0, &n), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_original_segments(solid, NULL, 0, &n), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_refined_weights(solid, NULL, NULL, 0, &n), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_refined_sizes(solid, NULL, 0, &n), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_refined_vertices(solid, NULL, 0, &n), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_quality_init(NULL), DELDRIFT_NULL_ARGUMENT);
    OK(deldrift_move_vertex(t, 0, PLACES));
    CHECK_STATUS(deldrift_refine(t, &good, NULL, 0, NULL), DELDRIFT_STAGED_VERTEX);
    CHECK_MESSAGE("1 moves");
    OK(deldrift_discard_moves(t));
    OK(deldrift_id_count(t, &n));
    CHECK(n == CORNERS);
    is_cancelled = true;
    CHECK_STATUS(deldrift_refine(t, &good, NULL, 0, NULL), DELDRIFT_CANCELLED);
    OK(deldrift_id_count(t, &n));
    CHECK(n == CORNERS);
    is_cancelled = false;
    OK(deldrift_refine(t, &good, NULL, 0, NULL));
    deldrift_destroy(t);
    deldrift_destroy(solid);
}

int main(void) {
    a_domain_gets_the_quality_asked_for();
    cells_are_of_the_sizes_asked_for();
    a_callback_may_stop_the_call();
    all_cells_are_delaunay_on_request();
    segments_stay_whole_on_request();
    a_squeezed_domain_keeps_its_number_of_vertices();
    what_has_no_meaning_is_refused();
    return 0;
}
