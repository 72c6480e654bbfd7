// A mesh that lives: a stirrer turns in a ring for 100,000 steps, each of which moves, commits, coarsens and refines.
// New vertices get ids of those that have gone, and the dye of what they were put into. The program ends in an error if
// vertices, ids or memory have grown by a tenth since the first tenth of the steps, or a cell is bad, or dye is
// below none or above full.
//
//   cc examples/overnight.c -Iinclude target/release/libdeldrift.a -lm -lpthread -ldl -o overnight
//   ./overnight [steps [picture.svg]]
#include <deldrift.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { OUTER = 12, INNER = 8, CORNERS = OUTER + INNER, ROOM = 1 << 13, SHADES = 8, PARTS = 10 };
static const double ANGLE = 0.02, RADIUS = 0.4, STILL = 0.95, TURN = 6.283185307179586;

static double positions[2 * ROOM], dye[ROOM], weights[3 * ROOM];
static uint32_t come[ROOM], from[3 * ROOM];

static void check(deldrift_status status) {
    if (status == DELDRIFT_OK) return;
    fprintf(stderr, "%s: %s\n", deldrift_status_string(status), deldrift_last_error());
    exit(1);
}

// Two polygons of segments. All other vertices come by refinement.
static deldrift_triangulation *build(void) {
    uint32_t ends[2 * CORNERS], id;
    for (uint32_t k = 0; k < CORNERS; k++) {
        const uint32_t first = k < OUTER ? 0 : OUTER, n = k < OUTER ? OUTER : INNER;
        const double angle = TURN * (k - first) / n + 0.05, radius = k < OUTER ? 1 : RADIUS;
        positions[2 * k] = radius * cos(angle), positions[2 * k + 1] = radius * sin(angle);
        ends[2 * k] = k, ends[2 * k + 1] = first + (k - first + 1) % n;
    }
    deldrift_triangulation *t;
    check(deldrift_create(2, positions, CORNERS, NULL, &t));
    check(deldrift_stage_segments(t, ends, NULL, CORNERS, &id));
    check(deldrift_commit_timestamp(t, NULL));
    return t;
}

// All turn: by the angle of the stirrer at it, and not at all at the outer polygon. A step that segments refuse is cut.
static void advance(deldrift_triangulation *t) {
    static double goals[2 * ROOM];
    size_t n;
    check(deldrift_copy_positions(t, positions, ROOM, &n));
    deldrift_status status = DELDRIFT_CROSSING;
    for (double turn = ANGLE; status == DELDRIFT_CROSSING || status == DELDRIFT_ON_SEGMENT; turn /= 2) {
        for (size_t v = 0; v < n; v++) {
            const double x = positions[2 * v], y = positions[2 * v + 1];
            const double share = fmin(1, fmax(0, (STILL - hypot(x, y)) / (STILL - RADIUS)));
            const double c = cos(turn * share), s = sin(turn * share);
            goals[2 * v] = c * x - s * y, goals[2 * v + 1] = s * x + c * y;
        }
        status = deldrift_commit_positions(t, goals, n, NULL);
    }
    check(status);
}

// Gives the mesh its quality again, and the vertices that have come their dye. Returns how many cells are bad.
static size_t mend(deldrift_triangulation *t, const deldrift_quality *quality) {
    size_t n;
    deldrift_quality_report report;
    check(deldrift_coarsen(t, quality, NULL, 0, NULL));
    check(deldrift_refine(t, quality, NULL, 0, &report));
    check(deldrift_refined_vertices(t, come, ROOM, &n));
    check(deldrift_refined_weights(t, from, weights, ROOM, &n));
    static double sums[ROOM];  // all before any is written: ids are given again
    for (size_t k = 0; k < n; k++) {
        sums[k] = 0;
        for (size_t i = 3 * k; i < 3 * k + 3; i++) sums[k] += weights[i] * dye[from[i]];
    }
    for (size_t k = 0; k < n; k++) dye[come[k]] = sums[k];
    return report.bad_cells;
}

// The cells of the ring, the redder the more dye they have, so far to the right.
static void draw(FILE *file, const deldrift_triangulation *t, double shift) {
    static uint32_t levels[2 * ROOM];
    deldrift_cells_view cells;
    size_t n;
    check(deldrift_cells(t, &cells));
    check(deldrift_copy_positions(t, positions, ROOM, &n));
    check(deldrift_nesting_levels(t, levels, 2 * ROOM, &n));
    fprintf(file, "<g transform='translate(%g 0) scale(1 -1)'>", shift);
    for (int shade = 0; shade < SHADES; shade++) {
        fprintf(file, "<path fill='hsl(%d,60%%,50%%)' d='", 220 + 170 * shade / (SHADES - 1));
        for (size_t c = 0; c < cells.count; c++) {
            const uint32_t *v = cells.vertices + 3 * c;
            const double mean = (dye[v[0]] + dye[v[1]] + dye[v[2]]) / 3;
            for (int i = 0; i < 3 && levels[c] == 1 && (int)(mean * (SHADES - 1) + 0.5) == shade; i++)
                fprintf(file, "%c%.2f %.2f", i == 0 ? 'M' : 'L', positions[2 * v[i]], positions[2 * v[i] + 1]);
        }
        fprintf(file, "'/>");
    }
    fprintf(file, "</g>\n");
}

int main(int argc, char **argv) {
    const int n_steps = argc > 1 ? atoi(argv[1]) : 100000;
    if (n_steps < PARTS) return 2;
    FILE *const picture = argc > 2 ? fopen(argv[2], "w") : tmpfile();
    if (picture == NULL) return perror("the picture"), 1;
    fprintf(picture, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-1 -1 6.4 2'>"
                     "<style>path{stroke:#fff;stroke-width:.004}</style>\n");
    deldrift_triangulation *t = build();
    deldrift_quality quality;
    check(deldrift_quality_init(&quality));
    quality.least_angle = 25, quality.greatest_area = 0.004, quality.has_weights = quality.reuses_ids = 1;
    size_t first[3] = {0}, most[3] = {0}, n_bad = mend(t, &quality), n;  // vertices, ids, bytes
    check(deldrift_copy_positions(t, positions, ROOM, &n));
    for (size_t v = 0; v < n; v++) dye[v] = positions[2 * v] > 0;
    double least = 1, greatest = 0;
    for (int step = 0; step <= n_steps; step++) {
        if (step > 0) advance(t), n_bad += mend(t, &quality);
        size_t now[3];
        check(deldrift_vertex_count(t, &now[0]));
        check(deldrift_id_count(t, &now[1]));
        check(deldrift_memory_bytes(t, &now[2]));
        for (int k = 0; k < 3; k++) {
            size_t *const greatest_of = step <= n_steps / PARTS ? first : most;
            if (greatest_of[k] < now[k]) greatest_of[k] = now[k];
        }
        for (size_t v = 0; v < now[1]; v++) least = fmin(least, dye[v]), greatest = fmax(greatest, dye[v]);
        if (step % (n_steps / PARTS) == 0)
            printf("step %6d: %zu vertices, %zu ids, %.0f kB\n", step, now[0], now[1], now[2] / 1e3);
        if (step == 0 || step == 60 || step == n_steps) draw(picture, t, step == 0 ? 0 : step == n_steps ? 4.4 : 2.2);
    }
    printf("most in the first tenth: %zu vertices, %zu ids, %.0f kB\n", first[0], first[1], first[2] / 1e3);
    printf("most from then on:       %zu vertices, %zu ids, %.0f kB\n", most[0], most[1], most[2] / 1e3);
    printf("%zu bad cells in %d steps, dye from %.2f to %.2f\n", n_bad, n_steps, least, greatest);
    deldrift_destroy(t);
    fprintf(picture, "</svg>\n");
    int is_flat = fclose(picture) == 0 && n_bad == 0 && least >= 0 && greatest < 1 + 1e-9;  // weights are rounded
    for (int k = 0; k < 3; k++) is_flat &= most[k] <= 1.1 * first[k];
    return !is_flat;
}
