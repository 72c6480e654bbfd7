// A solver that rejects steps. Particles are stirred in a box, now slowly and now fast, and each stands for the area of
// its Voronoi cell. A step is good if no area changes by more than three tenths, which only the triangulation of the new
// positions can tell. So a step is prepared, looked at, and published or withdrawn and tried again with half the time. Where
// a good step leaves a large triangle, a particle is put into it: a second round of the same step.
//
//   cc examples/rejecting.c -Iinclude target/release/libdeldrift.a -lm -lpthread -ldl -o rejecting && ./rejecting
#include <deldrift.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 40, FIRST = SIDE * SIDE, MOST = 4 * FIRST };

static const double PI = 3.14159265358979323846, LOW[] = {0, 0}, HIGH[] = {1, 1};
static double now[2 * MOST], next[2 * MOST], areas[MOST], next_areas[MOST], triangles[2 * MOST];

static void check(deldrift_status status) {
    if (status == DELDRIFT_OK) return;
    fprintf(stderr, "%s: %s\n", deldrift_status_string(status), deldrift_last_error());
    exit(1);
}

// The velocity of the fluid: along the walls, without divergence, and fast every now and then.
static void velocity(const double *p, double time, double *v) {
    const double strength = 0.05 + pow(sin(PI * time), 20);
    v[0] = strength * sin(PI * p[0]) * cos(PI * p[1]);
    v[1] = -strength * cos(PI * p[0]) * sin(PI * p[1]);
}

static void advance(const double *from, double *to, size_t n, double time, double step) {
    for (size_t k = 0; k < n; k++) {
        double v[2], middle[2];
        velocity(from + 2 * k, time, v);
        for (size_t i = 0; i < 2; i++) middle[i] = from[2 * k + i] + step / 2 * v[i];
        velocity(middle, time + step / 2, v);
        for (size_t i = 0; i < 2; i++) to[2 * k + i] = fmin(fmax(from[2 * k + i] + step * v[i], 0), 1);
    }
}

// The Voronoi areas; how far from 1 their sum is.
static double measure(const deldrift_triangulation *t, double *out) {
    size_t n = 0;
    double sum = 0;
    check(deldrift_voronoi_volumes(t, LOW, HIGH, out, MOST, &n));
    for (size_t k = 0; k < n; k++) sum += out[k];
    return fabs(sum - 1);
}

// Stages a particle in the middle of each large triangle; how many.
static size_t stage_particles(deldrift_triangulation *t, size_t n, const double *positions) {
    deldrift_cells_view cells;
    size_t count = 0, staged = 0;
    check(deldrift_cells(t, &cells));
    check(deldrift_volumes(t, triangles, 2 * MOST, &count));
    for (size_t c = 0; c < count && n + staged < MOST; c++) {
        if (triangles[c] < 1.5 / FIRST) continue;
        double middle[2] = {0, 0};
        uint32_t id;
        for (size_t i = 0; i < 6; i++) middle[i % 2] += positions[2 * cells.vertices[3 * c + i / 2] + i % 2] / 3;
        check(deldrift_stage_insertions(t, middle, 1, &id));
        staged++;
    }
    return staged;
}

int main(void) {
    size_t n = FIRST, steps = 0, rejected = 0, as_before = 0, inserted = 0;
    double time = 0, step = 0.01, error = 0;
    for (size_t k = 0; k < n; k++) {
        now[2 * k] = ((double)(k % SIDE) + 0.5 + 0.3 * sin(12.9 * (double)k)) / SIDE;
        now[2 * k + 1] = ((double)(k / SIDE) + 0.5 + 0.3 * sin(78.2 * (double)k)) / SIDE;
    }
    deldrift_triangulation *t = NULL;
    check(deldrift_create(2, now, n, NULL, &t));
    error = measure(t, areas);
    while (time < 3) {
        advance(now, next, n, time, step);
        check(deldrift_move_vertices(t, NULL, next, n));
        check(deldrift_prepare_timestamp(t, NULL));
        measure(t, next_areas);
        double greatest = 0;
        for (size_t k = 0; k < n; k++) greatest = fmax(greatest, fabs(next_areas[k] / areas[k] - 1));
        if (greatest > 0.3) {
            check(deldrift_withdraw_timestamp(t));
            measure(t, next_areas);
            as_before += memcmp(areas, next_areas, n * sizeof *areas) == 0;
            rejected++;
            step /= 2;
            continue;
        }
        const size_t more = stage_particles(t, n, next);
        if (more > 0) check(deldrift_prepare_timestamp(t, NULL));
        check(deldrift_publish_timestamp(t));
        inserted += more;
        check(deldrift_copy_positions(t, now, MOST, &n));
        error = fmax(error, measure(t, areas));
        time += step;
        step *= 1.2;
        steps++;
    }
    uint64_t timestamp = 0;
    check(deldrift_timestamp(t, &timestamp));
    check(deldrift_validate(t, 3));
    printf("%zu steps, %zu rejected; %zu particles, %zu of them new; area within %.1e\n", steps, rejected, n, inserted, error);
    printf("after %zu of %zu rejected steps all areas are as before, bit for bit\n", as_before, rejected);
    deldrift_destroy(t);
    return timestamp == steps && as_before == rejected ? 0 : 1;
}
