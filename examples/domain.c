// A hot rotor turns in a cold square: its outline and the walls are segments, which stay edges while the vertices of
// the fluid are stirred. Heat flows between both: linear finite elements on the cells of the domain, with boundary
// conditions by the markers of segments. The area of the domain is compared with that of the square less the rotor.
//
//   cc examples/domain.c -Iinclude target/release/libdeldrift.a -lm -lpthread -ldl -o domain && ./domain picture.svg
#include <deldrift.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WALL = 80, ROTOR = 40, FLUID = 560, SEGMENTS = WALL + ROTOR, VERTICES = SEGMENTS + FLUID, CELLS = 2 * VERTICES };
enum { STEPS = 200, ROUNDS = 60, SHADES = 12, COLD = 1, HOT = 2 };

static double positions[2 * VERTICES], goals[2 * VERTICES], temperature[VERTICES], areas[CELLS];
static bool is_given[VERTICES];
static deldrift_cells_view cells;
static uint8_t mask[CELLS];  // 1 for the cells of the domain

static void check(deldrift_status status) {
    if (status != DELDRIFT_OK) fprintf(stderr, "%s: %s\n", deldrift_status_string(status), deldrift_last_error());
    if (status != DELDRIFT_OK) exit(1);
}

static double from_minus_1_to_1(void) {
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 4503599627370496.0 - 1;
}

// Walls from -1 to 1, an ellipse, and the fluid anywhere else, no two of its vertices near to each other.
static void lay_out(uint32_t *ends, int32_t *markers) {
    for (uint32_t k = 0; k < SEGMENTS; k++) {
        const double s = 2.0 * (k % (WALL / 4)) / (WALL / 4) - 1, angle = 2 * acos(-1) * (k - WALL) / ROTOR;
        const double sides[4][2] = {{s, -1}, {1, s}, {-s, 1}, {-1, -s}}, oval[] = {0.5 * cos(angle), 0.15 * sin(angle)};
        memcpy(positions + 2 * k, k < WALL ? sides[k / (WALL / 4)] : oval, sizeof oval);
        ends[2 * k] = k;
        ends[2 * k + 1] = k < WALL ? (k + 1) % WALL : WALL + (k - WALL + 1) % ROTOR;
        markers[k] = k < WALL ? COLD : HOT;
    }
    for (uint32_t n = SEGMENTS; n < VERTICES;) {
        const double x = from_minus_1_to_1(), y = from_minus_1_to_1();
        bool is_free = fmax(fabs(x), fabs(y)) < 0.97 && hypot(x / 0.53, y / 0.18) > 1;
        for (uint32_t v = SEGMENTS; v < n; v++)
            is_free = is_free && hypot(x - positions[2 * v], y - positions[2 * v + 1]) > 0.05;
        if (is_free) memcpy(positions + 2 * n++, (double[]){x, y}, 2 * sizeof x);
    }
}

// Turns all by an angle that is the rotor's near it, and 0 at the walls. A step that segments refuse is cut.
static int advance(deldrift_triangulation *t, double angle) {
    for (int n_cuts = 0;; n_cuts++, angle /= 2) {
        for (int v = 0; v < VERTICES; v++) {
            const double *p = positions + 2 * v, r = hypot(p[0], p[1]), part = r < 0.55 ? 1 : fmax(0, (0.95 - r) / 0.4);
            goals[2 * v] = cos(part * angle) * p[0] - sin(part * angle) * p[1];
            goals[2 * v + 1] = sin(part * angle) * p[0] + cos(part * angle) * p[1];
        }
        const deldrift_status status = deldrift_commit_positions(t, goals, VERTICES, NULL);
        if (status == DELDRIFT_CROSSING || status == DELDRIFT_ON_SEGMENT) continue;
        check(status);
        memcpy(positions, goals, sizeof goals);
        return n_cuts;
    }
}

// Lets heat flow for a time: an implicit step by relaxation, in which each temperature becomes a mean of those around.
static void conduct(double time) {
    static double mass[VERTICES], all[VERTICES], sum[VERTICES], before[VERTICES];
    memcpy(before, temperature, sizeof before);
    for (int round = 0; round < ROUNDS; round++) {
        memset(mass, 0, sizeof mass), memset(all, 0, sizeof all), memset(sum, 0, sizeof sum);
        for (size_t c = 0; c < cells.count; c++) {
            const uint32_t *v = cells.vertices + 3 * c;
            for (int i = 0; i < 3 && mask[c]; i++) {
                const uint32_t a = v[(i + 1) % 3], b = v[(i + 2) % 3];
                const double *o = positions + 2 * v[i], *p = positions + 2 * a, *q = positions + 2 * b;
                const double dot = (p[0] - o[0]) * (q[0] - o[0]) + (p[1] - o[1]) * (q[1] - o[1]);
                const double weight = time * dot / (4 * areas[c]);  // half the cotangent at o
                mass[v[i]] += areas[c] / 3;
                all[a] += weight, all[b] += weight;
                sum[a] += weight * temperature[b], sum[b] += weight * temperature[a];
            }
        }
        for (int v = 0; v < VERTICES; v++)
            if (!is_given[v]) temperature[v] = (mass[v] * before[v] + sum[v]) / (mass[v] + all[v]);
    }
}

// The cells of the domain, the redder the hotter, and their boundary.
static void draw(FILE *file, int step, const deldrift_triangulation *t) {
    static uint32_t vertices[CELLS], chains[CELLS];
    size_t count;
    fprintf(file, "<text x='%d' y='22.5'>step %d</text><g transform='translate(%d 11) scale(10 -10)'>\n",
            22 * step * 2 / STEPS - 10, step, 22 * step * 2 / STEPS);
    for (int shade = 0; shade < SHADES; shade++) {
        fprintf(file, "<path fill='hsl(%d,60%%,50%%)' d='", 220 + 170 * shade / (SHADES - 1));
        for (size_t c = 0; c < cells.count; c++) {
            const uint32_t *v = cells.vertices + 3 * c;
            const double mean = (temperature[v[0]] + temperature[v[1]] + temperature[v[2]]) / 3;
            for (int i = 0; i < 3 && mask[c] && (int)(mean * (SHADES - 1) + 0.5) == shade; i++)
                fprintf(file, "%c%.3f %.3f", i == 0 ? 'M' : 'L', positions[2 * v[i]], positions[2 * v[i] + 1]);
        }
        fprintf(file, "'/>\n");
    }
    check(deldrift_boundary_chains(t, mask, cells.count, vertices, chains, NULL, NULL, NULL, CELLS, &count));
    for (size_t k = 0; k < count; k++)
        fprintf(file, "%s%.3f %.3f", k == 0 ? "<path class='b' d='M" : chains[k] == chains[k - 1] ? "L" : "zM",
                positions[2 * vertices[k]], positions[2 * vertices[k] + 1]);
    fprintf(file, "z'/></g>\n");
}

int main(int argc, char **argv) {
    uint32_t ends[2 * SEGMENTS], first, levels[CELLS];
    int32_t markers[SEGMENTS];
    deldrift_triangulation *t = NULL;
    lay_out(ends, markers);
    check(deldrift_create(2, positions, VERTICES, NULL, &t));
    check(deldrift_stage_segments(t, ends, markers, SEGMENTS, &first));
    check(deldrift_commit_timestamp(t, NULL));
    FILE *file = argc > 1 ? fopen(argv[1], "w") : tmpfile();
    if (file == NULL) return 1;
    fprintf(file, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-11 0 66 24'><style>text{font:1px sans-serif}"
                  "path{stroke:#fff;stroke-width:.002} .b{fill:none;stroke:#000;stroke-width:.01}</style>\n");
    size_t count;
    check(deldrift_segments(t, NULL, ends, markers, SEGMENTS, &count));
    for (size_t k = 0; k < 2 * count; k++) is_given[ends[k]] = true;
    for (size_t k = 0; k < 2 * count; k++) temperature[ends[k]] = markers[k / 2] == HOT;
    double error = 0, least = 1, most = 0, n_cuts = 0;
    for (int step = 0; step <= STEPS; step++) {
        double area = ROTOR / 2 * sin(2 * acos(-1) / ROTOR) * 0.5 * 0.15 - 4;  // that of the rotor without the square
        if (step > 0) n_cuts += advance(t, 0.02);
        check(deldrift_cells(t, &cells));
        check(deldrift_volumes(t, areas, CELLS, &count));
        check(deldrift_nesting_levels(t, levels, CELLS, &count));
        for (size_t c = 0; c < count; c++) area += (mask[c] = levels[c] == 1) ? areas[c] : 0;
        error = fmax(error, fabs(area));
        conduct(2e-3);
        for (int v = 0; v < VERTICES; v++) least = fmin(least, temperature[v]), most = fmax(most, temperature[v]);
        if (step % (STEPS / 2) == 0) draw(file, step, t);
    }
    fprintf(file, "</svg>\n");
    const bool is_right = fclose(file) == 0 && error < 1e-12 && least >= 0 && most <= 1;
    printf("%d steps, %.0f cut; area within %.0e; temperatures from %g to %g\n", STEPS, n_cuts, error, least, most);
    deldrift_destroy(t);
    return is_right ? 0 : 1;
}
