// For comparisons with the research report RR-6750: the same motion by each of its algorithms, the cells of which must
// be those of DELDRIFT_AUTO, and how wide the margins are within which nothing changes. No program needs this to
// triangulate.
#include <deldrift/research.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 20, VERTICES = SIDE * SIDE, MOST = 2 * VERTICES, STEPS = 20 };  // MOST: more than there are triangles

static void check(deldrift_status status) {
    if (status == DELDRIFT_OK) return;
    fprintf(stderr, "%s: %s\n", deldrift_status_string(status), deldrift_last_error());
    exit(1);
}

// Points in a square, each of which goes round in a circle of its own.
static void place(double *positions, int step) {
    for (int i = 0; i < VERTICES; i++) {
        double angle = 0.05 * step + 78.233 * i;
        positions[2 * i] = (i % SIDE + 0.3 * sin(12.9898 * i) + 0.1 * cos(angle)) / SIDE;
        positions[2 * i + 1] = (i / SIDE + 0.3 * sin(4.1414 * i) + 0.1 * sin(angle)) / SIDE;
    }
}

static int compare_rows(const void *a, const void *b) { return memcmp(a, b, 3 * sizeof(uint32_t)); }

// The triangles, each from its lowest id on, in one order for all algorithms.
static size_t sorted_triangles(const deldrift_triangulation *t, uint32_t *triangles) {
    size_t count;
    check(deldrift_copy_cells(t, triangles, NULL, MOST, &count));
    for (uint32_t *v = triangles; v < triangles + 3 * count; v += 3) {
        while (v[0] > v[1] || v[0] > v[2]) {
            const uint32_t first = v[0];
            v[0] = v[1], v[1] = v[2], v[2] = first;
        }
    }
    qsort(triangles, count, 3 * sizeof *triangles, compare_rows);
    return count;
}

// The least and the greatest part of its annulus by which a bi-cell is certain to stay.
static void tell_margins(const deldrift_triangulation *t) {
    static double widths[3 * MOST];
    double least = INFINITY, greatest = 0;
    size_t count;
    check(deldrift_research_annulus_widths(t, widths, 3 * MOST, &count));
    for (size_t i = 0; i < count; i++) {
        double centre[2], radius, tolerance;
        const uint32_t cell = (uint32_t)(i / 3), corner = (uint32_t)(i % 3);
        check(deldrift_research_standard_delimiter(t, cell, corner, centre, &radius, &tolerance));
        if (isnan(radius)) continue;  // on the hull
        least = fmin(least, tolerance / widths[i]);
        greatest = fmax(greatest, tolerance / widths[i]);
    }
    printf("tolerances are %.3g to %.3g of the width of an annulus\n", least, greatest);
}

int main(void) {
    static const struct {
        deldrift_research_algorithm algorithm;
        const char *name;
    } all[] = {{DELDRIFT_RESEARCH_PLACEMENT, "placement"},
               {DELDRIFT_RESEARCH_SAFE_REGION, "safe region"},
               {DELDRIFT_RESEARCH_SAFE_REGION_TOLERANCE, "safe region and tolerance"},
               {DELDRIFT_RESEARCH_REBUILDING_TOLERANCE, "rebuilding, then tolerance"}};
    static double positions[2 * VERTICES];
    static uint32_t wanted[3 * MOST], found[3 * MOST];
    const deldrift_research_options options = {.struct_size = sizeof options, .switch_seed = 7};
    deldrift_triangulation *by_auto, *t;
    int n_same = 0;
    place(positions, 0);
    check(deldrift_create(2, positions, VERTICES, NULL, &by_auto));
    tell_margins(by_auto);
    place(positions, STEPS);
    check(deldrift_commit_positions(by_auto, positions, VERTICES, NULL));
    const size_t n_wanted = sorted_triangles(by_auto, wanted);
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        place(positions, 0);
        check(deldrift_create(2, positions, VERTICES, NULL, &t));
        check(deldrift_research_set_algorithm(t, all[k].algorithm, &options));
        for (int step = 1; step <= STEPS; step++) {
            place(positions, step);
            check(deldrift_commit_positions(t, positions, VERTICES, NULL));
        }
        deldrift_commit_report sums;
        uint64_t within_safe_region;
        check(deldrift_statistics(t, &sums));
        check(deldrift_research_within_safe_region(t, &within_safe_region));
        printf("%-27s %4d within tolerance, %4d within safe region, %4d placements, %2d rebuilds\n", all[k].name,
               (int)sums.within_tolerance, (int)within_safe_region, (int)sums.placements, (int)sums.rebuilds);
        const size_t n_found = sorted_triangles(t, found);
        n_same += n_found == n_wanted && memcmp(found, wanted, 3 * n_wanted * sizeof *wanted) == 0;
        deldrift_destroy(t);
    }
    deldrift_destroy(by_auto);
    printf("%d of %d have the same triangles\n", n_same, (int)(sizeof all / sizeof *all));
    return n_same == sizeof all / sizeof *all ? 0 : 1;
}
