// deldrift/research.h: its options, what its algorithms count, and the certificates.
#include "check.h"

static const deldrift_research_options DEFAULTS = {.struct_size = sizeof DEFAULTS};

static deldrift_status try_options(const deldrift_research_options *options) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    deldrift_status status = deldrift_research_set_algorithm(t, DELDRIFT_RESEARCH_REBUILDING_TOLERANCE, options);
    deldrift_algorithm algorithm = 77;
    OK(deldrift_get_algorithm(t, &algorithm));
    CHECK(algorithm == (status == DELDRIFT_OK ? DELDRIFT_RESEARCH_REBUILDING_TOLERANCE : DELDRIFT_AUTO));
    deldrift_destroy(t);
    return status;
}

static void structures_of_other_sizes_are_refused(void) {
    OK(try_options(NULL));
    OK(try_options(&DEFAULTS));
    for (size_t size = 0; size < 2 * sizeof DEFAULTS; size++) {
        deldrift_research_options options = DEFAULTS;
        options.struct_size = size;
        CHECK_STATUS(try_options(&options), size == sizeof DEFAULTS ? DELDRIFT_OK : DELDRIFT_INVALID_OPTIONS);
        if (size != sizeof DEFAULTS) CHECK_MESSAGE("options.struct_size is ");
    }
}

static void algorithms_for_use_are_refused(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    CHECK_STATUS(deldrift_research_set_algorithm(t, DELDRIFT_REPAIR, NULL), DELDRIFT_INVALID_OPTIONS);
    CHECK_MESSAGE("algorithm is 4");
    CHECK_STATUS(deldrift_set_algorithm(t, DELDRIFT_RESEARCH_PLACEMENT), DELDRIFT_INVALID_OPTIONS);
    CHECK_MESSAGE("algorithm is 16");
    deldrift_destroy(t);
}

static void shares_are_parts_of_a_whole(void) {
    static const double bad[] = {NAN, INFINITY, -INFINITY, -0.25, -4.9406564584124654e-324, 1.0000000000000002, 75};
    static const double good[] = {0, -0.0, 4.9406564584124654e-324, 0.25, 1};
    deldrift_research_options options = DEFAULTS;
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

// A triangulation by DELDRIFT_RESEARCH_REBUILDING_TOLERANCE, of which a part moves at each step.
typedef struct {
    deldrift_triangulation *t;
    uint32_t dimension;
    double *positions;
    uint64_t state;
} switching;

enum { SWITCHING_COUNT = 200 };

static switching switching_by(uint32_t dimension, deldrift_research_options options) {
    switching s = {NULL, dimension, random_positions(dimension, SWITCHING_COUNT, 9), 10};
    s.t = create(dimension, s.positions, SWITCHING_COUNT, NULL);
    OK(deldrift_research_set_algorithm(s.t, DELDRIFT_RESEARCH_REBUILDING_TOLERANCE, &options));
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
    deldrift_research_options options = DEFAULTS;
    options.switch_period = period;
    switching s = switching_by(dimension, options);
    CHECK(rebuilds(&s, 1));
    for (uint32_t step = 1; step < (period == 0 ? 4 : period); step++) CHECK(rebuilds(&s, 0));
    CHECK(!rebuilds(&s, 0));

    // Once and for all, unless the algorithm is chosen again.
    for (int step = 0; step < 6; step++) CHECK(!rebuilds(&s, 1));
    OK(deldrift_research_set_algorithm(s.t, DELDRIFT_RESEARCH_REBUILDING_TOLERANCE, &options));
    CHECK(!rebuilds(&s, 1));
    OK(deldrift_set_algorithm(s.t, DELDRIFT_TOLERANCE));
    CHECK(!rebuilds(&s, 1));
    OK(deldrift_research_set_algorithm(s.t, DELDRIFT_RESEARCH_REBUILDING_TOLERANCE, &options));
    CHECK(rebuilds(&s, 1));
    end(s);
}

// With four vertices in ten far away, of which a sample of 2000 is a fair picture.
static void the_share_decides(uint32_t dimension, double share, bool switches) {
    deldrift_research_options options = DEFAULTS;
    options.switch_share = share;
    options.switch_sample = 2000;
    options.switch_period = 1;
    switching s = switching_by(dimension, options);
    for (int step = 0; step < 3; step++) CHECK(rebuilds(&s, 0.4) == !switches);
    end(s);
}

// Steps before the sample of a single vertex, at each of them, is of the half that does not move.
static int steps_of_rebuilding(uint64_t seed) {
    deldrift_research_options options = DEFAULTS;
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

// A vertex inside a quadrilateral moves first by less than its tolerance, then to near a corner.
static void reports_count_what_was_within(deldrift_algorithm algorithm, bool tolerance, bool safe_region) {
    static const double positions[] = {-4, -4, 4, -4, 5, 5, -4, 4, 0, 0};
    static const double near[] = {0.01, 0}, far[] = {3, 3.5};
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = algorithm;
    deldrift_triangulation *t = create(2, positions, SQUARE_COUNT, &options);
    deldrift_commit_report report, sums;
    uint64_t within_safe_region = 77;
    OK(deldrift_move_vertex(t, 4, near));
    OK(deldrift_commit_timestamp(t, &report));
    CHECK(report.moved == 1 && report.placements == 0 && report.rebuilds == 0);
    CHECK(report.within_tolerance == (tolerance ? 1 : 0));
    OK(deldrift_research_within_safe_region(t, &within_safe_region));
    CHECK(within_safe_region == (safe_region ? 1 : 0));
    OK(deldrift_move_vertex(t, 4, far));
    OK(deldrift_commit_timestamp(t, &report));
    CHECK(report.moved == 1 && report.within_tolerance == 0);
    CHECK(report.placements + report.flips + report.unchanged > 0);
    CHECK(report.tolerances > 0 || !(tolerance || safe_region));
    OK(deldrift_statistics(t, &sums));
    CHECK(sums.moved == 2 && sums.timestamp == 2 && sums.tolerances >= report.tolerances);
    CHECK(sums.within_tolerance == (tolerance ? 1 : 0));
    OK(deldrift_research_within_safe_region(t, &within_safe_region));
    CHECK(within_safe_region == (safe_region ? 1 : 0));
    CHECK(sums.certificates >= report.certificates);
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
}

static void relocated_stars_are_certified(void) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = DELDRIFT_RESEARCH_PLACEMENT;
    deldrift_triangulation *t = create(3, TETRAHEDRON, TETRAHEDRON_COUNT, &options);
    static const double aim[3] = {0.5, 0.75, 0.75};
    deldrift_commit_report report;
    OK(deldrift_move_vertex(t, 4, aim));
    OK(deldrift_commit_timestamp(t, &report));
    CHECK(report.moved == 1 && report.unchanged == 1 && report.certificates > 0);
    CHECK(report.within_tolerance == 0 && report.tolerances == 0);
    deldrift_destroy(t);
}

static double distance(const double *p, const double *q, uint32_t dimension) {
    double sum = 0;
    for (uint32_t k = 0; k < dimension; k++) sum += (p[k] - q[k]) * (p[k] - q[k]);
    return sqrt(sum);
}

static double *widths_of(const deldrift_triangulation *t, size_t wanted) {
    size_t count = 0, again = 0;
    OK(deldrift_research_annulus_widths(t, NULL, 0, &count));
    CHECK(count == wanted);
    double *widths = malloc((count + 1) * sizeof *widths);
    CHECK(widths != NULL);
    widths[0] = 77;
    if (count > 0) {
        CHECK_STATUS(deldrift_research_annulus_widths(t, widths, count - 1, &again), DELDRIFT_BUFFER_TOO_SMALL);
        CHECK_MESSAGE("capacity is ");
        CHECK(again == count && widths[0] == 77);
    }
    OK(deldrift_research_annulus_widths(t, widths, count, &again));
    CHECK(again == count);
    return widths;
}

// Delimiters and widths of a facet seen from either cell, up to the rounding of a circle that may be large.
static bool is_about(double a, double b, double radius) { return fabs(a - b) <= 1e-14 * radius; }

static void delimiters_separate(uint32_t dimension) {
    enum { COUNT = 200 };
    double *positions = random_positions(dimension, COUNT, 14);
    deldrift_triangulation *t = create(dimension, positions, COUNT, NULL);
    deldrift_cells_view view = cells_of(t);
    uint32_t d = view.corners_per_cell;
    double *widths = widths_of(t, view.count * d), centre[3] = {77, 77, 77}, radius = 77, tolerance = 77;
    for (uint32_t c = 0; c < view.count; c++) {
        for (uint32_t i = 0; i < d; i++) {
            const uint32_t *cell = view.vertices + c * d;
            double width = widths[c * d + i];
            uint32_t other = view.neighbours[c * d + i];
            if (other == DELDRIFT_NONE) {
                OK(deldrift_research_standard_delimiter(t, c, i, centre, &radius, &tolerance));
                CHECK(isnan(width) && isnan(centre[0]) && isnan(radius) && isnan(tolerance));
                continue;
            }
            OK(deldrift_research_standard_delimiter(t, c, i, centre, &radius, &tolerance));
            CHECK(width > 0 && tolerance > 0 && radius >= width / 2);
            CHECK(dimension == 2 ? tolerance == width / 2 : tolerance <= width / 2);
            const uint32_t *across = view.vertices + other * d;
            for (uint32_t k = 0; k < d; k++) {
                double at = distance(positions + cell[k] * dimension, centre, dimension);
                CHECK(is_about(at, radius + (k == i ? width : -width) / 2, radius));
                if (!has_corner(cell, d, across[k])) {
                    at = distance(positions + across[k] * dimension, centre, dimension);
                    CHECK(is_about(at, radius + width / 2, radius));
                    CHECK(is_about(widths[other * d + k], width, radius));
                }
            }
        }
    }
    radius = 77;
    CHECK_STATUS(deldrift_research_standard_delimiter(t, (uint32_t)view.count, 0, centre, &radius, &tolerance),
                 DELDRIFT_NO_SUCH_FACET);
    CHECK_STATUS(deldrift_research_standard_delimiter(t, DELDRIFT_NONE, 0, centre, &radius, &tolerance),
                 DELDRIFT_NO_SUCH_FACET);
    CHECK_MESSAGE("cell is 4294967295");
    CHECK_STATUS(deldrift_research_standard_delimiter(t, 0, d, centre, &radius, &tolerance), DELDRIFT_NO_SUCH_FACET);
    CHECK_MESSAGE(dimension == 2 ? "corner is 3" : "corner is 4");
    CHECK(radius == 77);
    deldrift_destroy(t);
    free(positions);
    free(widths);
}

static void tolerances_are_those_of_the_bi_cells(uint32_t dimension) {
    enum { COUNT = 200 };
    double *positions = random_positions(dimension, COUNT, 15);
    deldrift_triangulation *t = create(dimension, positions, COUNT, NULL);
    size_t inside = 0;
    for (uint32_t v = 0; v < COUNT; v++) {
        double tolerance = -1, least = INFINITY, centre[3], radius, of_bi_cell;
        OK(deldrift_tolerance(t, v, &tolerance));
        CHECK(tolerance > 0);
        uint32_t star[512];
        size_t count = 0;
        OK(deldrift_star(t, v, star, 512, &count));
        bool is_inside = true;
        for (size_t c = 0; c < count; c++) {
            for (uint32_t i = 0; i <= dimension; i++) {
                OK(deldrift_research_standard_delimiter(t, star[c], i, centre, &radius, &of_bi_cell));
                if (isnan(radius)) {
                    is_inside = false;
                } else {
                    least = fmin(least, of_bi_cell);
                }
            }
        }
        CHECK(is_inside ? tolerance == least : tolerance <= least);
        inside += is_inside;
    }
    CHECK(inside > COUNT / 10);
    double tolerance = 77;
    CHECK_STATUS(deldrift_tolerance(t, COUNT, &tolerance), DELDRIFT_NO_SUCH_VERTEX);
    CHECK_MESSAGE("vertex[0] is 200");
    OK(deldrift_remove_vertex(t, 7));
    CHECK_STATUS(deldrift_tolerance(t, 7, &tolerance), DELDRIFT_REMOVED_VERTEX);
    CHECK(tolerance == 77);
    OK(deldrift_relocate_vertex(t, 9, positions));
    OK(deldrift_tolerance(t, 9, &tolerance));
    CHECK(tolerance == 0);
    OK(deldrift_tolerance(t, 0, &tolerance));
    CHECK(tolerance == 0);
    deldrift_destroy(t);
    free(positions);
}

static void without_cells_there_are_no_bi_cells(void) {
    static const double line[] = {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3};
    deldrift_triangulation *t = create(3, line, 4, NULL);
    double tolerance, centre[3], radius;
    free(widths_of(t, 0));
    CHECK_STATUS(deldrift_research_standard_delimiter(t, 0, 0, centre, &radius, &tolerance), DELDRIFT_NO_SUCH_FACET);
    CHECK_MESSAGE("there are 0 cells");
    deldrift_destroy(t);
}

int main(void) {
    structures_of_other_sizes_are_refused();
    algorithms_for_use_are_refused();
    shares_are_parts_of_a_whole();
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        rebuilding_ends_at_a_sample_within_tolerance(dimension, 0);
        rebuilding_ends_at_a_sample_within_tolerance(dimension, 3);
        the_share_decides(dimension, 0.5, true);
        the_share_decides(dimension, 0.7, false);
        the_share_decides(dimension, 0, dimension == 3);
        delimiters_separate(dimension);
        tolerances_are_those_of_the_bi_cells(dimension);
    }
    the_seed_decides();
    reports_count_what_was_within(DELDRIFT_RESEARCH_PLACEMENT, false, false);
    reports_count_what_was_within(DELDRIFT_TOLERANCE, true, false);
    reports_count_what_was_within(DELDRIFT_RESEARCH_SAFE_REGION, false, true);
    reports_count_what_was_within(DELDRIFT_RESEARCH_SAFE_REGION_TOLERANCE, true, false);
    relocated_stars_are_certified();
    without_cells_there_are_no_bi_cells();
    return 0;
}
