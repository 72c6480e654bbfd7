// A plate that turns, with heat flowing through it: linear finite elements on a square whose sides are straight but for
// the rounding of coordinates. The hull then goes over flat cells from vertex to vertex of a side. They are exactly
// Delaunay, and useless as elements; deldrift_mask_without_flat_cells leaves them out.
//
//   cc examples/plate.c -Iinclude target/release/libdeldrift.a -lm -lpthread -ldl -o plate && ./plate
#include <deldrift.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 40, LINE = SIDE + 1, VERTICES = LINE * LINE, MOST = 2 * VERTICES, MOST_ROUNDS = 2000 };

static void check(deldrift_status status) {
    if (status == DELDRIFT_OK) return;
    fprintf(stderr, "%s: %s\n", deldrift_status_string(status), deldrift_last_error());
    exit(1);
}

static double positions[2 * VERTICES], areas[MOST];

static void turn(double angle) {
    for (int v = 0; v < VERTICES; v++) {
        const double x = v % LINE, y = v / LINE;
        positions[2 * v] = cos(angle) * x - sin(angle) * y;
        positions[2 * v + 1] = sin(angle) * x + cos(angle) * y;
    }
}

// Two sides of the plate are kept at 0 and at 1; the other two are insulated.
static bool is_free(int v) { return v % LINE != 0 && v % LINE != SIDE; }

// Adds the heat that flows out of each vertex at temperatures u: gradients of linear functions, cell by cell.
static void flow(const deldrift_cells_view *cells, const uint8_t *mask, const double *u, double *out) {
    memset(out, 0, VERTICES * sizeof *out);
    for (size_t c = 0; c < cells->count; c++) {
        if (!mask[c]) continue;
        const uint32_t *v = cells->vertices + 3 * c;
        double gradient[3][2], of_u[2] = {0, 0};
        for (int i = 0; i < 3; i++) {
            const double *a = positions + 2 * v[(i + 1) % 3], *b = positions + 2 * v[(i + 2) % 3];
            gradient[i][0] = (a[1] - b[1]) / (2 * areas[c]);
            gradient[i][1] = (b[0] - a[0]) / (2 * areas[c]);
            for (int k = 0; k < 2; k++) of_u[k] += gradient[i][k] * u[v[i]];
        }
        for (int i = 0; i < 3; i++) out[v[i]] += areas[c] * (gradient[i][0] * of_u[0] + gradient[i][1] * of_u[1]);
    }
}

static double product(const double *a, const double *b) {
    double sum = 0;
    for (int v = 0; v < VERTICES; v++) sum += is_free(v) ? a[v] * b[v] : 0;
    return sum;
}

// Temperatures at rest by conjugate gradients; the number of rounds, MOST_ROUNDS if it does not converge. error: the
// greatest difference from the temperature that is known, which grows evenly from one side to the other.
static int solve(const deldrift_cells_view *cells, const uint8_t *mask, double *error) {
    static double u[VERTICES], residual[VERTICES], direction[VERTICES], change[VERTICES];
    for (int v = 0; v < VERTICES; v++) u[v] = v % LINE == SIDE;
    flow(cells, mask, u, residual);
    for (int v = 0; v < VERTICES; v++) direction[v] = residual[v] = is_free(v) ? -residual[v] : 0;
    const double wanted = 1e-24 * product(residual, residual);
    double square = product(residual, residual);
    int round = 0;
    for (; round < MOST_ROUNDS && square > wanted; round++) {
        flow(cells, mask, direction, change);
        const double step = square / product(direction, change);
        for (int v = 0; v < VERTICES; v++) {
            u[v] += is_free(v) ? step * direction[v] : 0;
            residual[v] -= is_free(v) ? step * change[v] : 0;
        }
        const double before = square;
        square = product(residual, residual);
        for (int v = 0; v < VERTICES; v++) direction[v] = is_free(v) ? residual[v] + square / before * direction[v] : 0;
    }
    *error = 0;
    for (int v = 0; v < VERTICES; v++) *error = fmax(*error, fabs(u[v] - (double)(v % LINE) / SIDE));
    return round;
}

int main(void) {
    static uint8_t mask[MOST], all[MOST];
    memset(all, 1, sizeof all);
    deldrift_triangulation *t;
    turn(0);
    check(deldrift_create(2, positions, VERTICES, NULL, &t));
    printf("angle  cells  flat, greatest area  rounds without them, error  rounds with them, error\n");
    for (int step = 0; step <= 5; step++) {
        deldrift_cells_view cells;
        size_t count, n_flat = 0;
        turn(0.1 * step);
        check(deldrift_commit_positions(t, positions, VERTICES, NULL));
        check(deldrift_cells(t, &cells));
        check(deldrift_volumes(t, areas, MOST, &count));
        check(deldrift_mask_without_flat_cells(t, 1e-9, mask, MOST, &count));
        double greatest = 0;  // others have half a unit
        for (size_t c = 0; c < count; c++) {
            n_flat += mask[c] == 0;
            if (mask[c] == 0) greatest = fmax(greatest, areas[c]);
        }
        double error, error_of_all;
        const int rounds = solve(&cells, mask, &error), rounds_of_all = solve(&cells, all, &error_of_all);
        printf("%5.1f %6zu %5zu, %5.0e %25d, %.0e %16d, %.0e\n", 0.1 * step, cells.count, n_flat, greatest, rounds, error,
               rounds_of_all, error_of_all);
    }
    deldrift_destroy(t);
}
