// A rotor stirs the fluid in a box that a pipe goes through: a domain that moves, for ten thousand steps. Each moves,
// commits, coarsens and refines, so that the mesh keeps its quality and its size, and carries values over. Heat comes
// in at the rotor and leaves at the pipe, as markers of segments say. Area and heat are compared with what is known.
//
//   cc examples/domain.c -Iinclude target/release/libdeldrift.a -lm -lpthread -ldl -o domain
//   ./domain [steps [picture.svg [animation.html]]]
#include "domain_picture.h"

enum { WALLS = 4, ROTOR = 40, PIPE = 24, CORNERS = WALLS + ROTOR + PIPE };
enum { INSULATED, HEATED, COOLED };  // markers
static const double ANGLE = 0.02, HEATING = 5, TIME = 2e-5, TURN = 6.283185307179586;

static double areas[2 * ROOM], weights[3 * ROOM], lengths[3], area, total, least_angle;
static uint32_t from[3 * ROOM], come[ROOM], ends[2 * ROOM];
static int32_t markers[ROOM];

// The scalar product of the ways from a vertex to two others.
static double product(uint32_t o, uint32_t a, uint32_t b) {
    const double *p = positions + 2 * o, *q = positions + 2 * a, *r = positions + 2 * b;
    return (q[0] - p[0]) * (r[0] - p[0]) + (q[1] - p[1]) * (r[1] - p[1]);
}
static double distance(uint32_t a, uint32_t b) { return sqrt(product(a, b, b)); }

// Loops of segments: the box, the rotor in it, the pipe. All other vertices come by refinement.
static deldrift_triangulation *build(void) {
    static const uint32_t first[] = {0, WALLS, WALLS + ROTOR, CORNERS};
    static const double box[][2] = {{-1, -1}, {2, -1}, {2, 1}, {-1, 1}};
    for (uint32_t k = 0; k < CORNERS; k++) {
        const int loop = k < WALLS ? INSULATED : k < WALLS + ROTOR ? HEATED : COOLED;
        const double angle = TURN * (k - first[loop]) / (first[loop + 1] - first[loop]), c = cos(angle), s = sin(angle);
        const double place[2] = {loop == HEATED ? 0.5 * c : 1.4 + 0.2 * c, loop == HEATED ? 0.15 * s : 0.2 * s};
        memcpy(positions + 2 * k, loop == INSULATED ? box[k] : place, sizeof place);
        ends[2 * k] = k, ends[2 * k + 1] = k + 1 < first[loop + 1] ? k + 1 : first[loop];
        markers[k] = loop;
        heat[k] = 1;
    }
    for (int k = 0; k < CORNERS; k++) lengths[markers[k]] += distance(ends[2 * k], ends[2 * k + 1]);
    deldrift_triangulation *t;
    uint32_t id;
    check(deldrift_create(2, positions, CORNERS, NULL, &t));
    check(deldrift_stage_segments(t, ends, markers, CORNERS, &id));
    check(deldrift_commit_timestamp(t, NULL));
    return t;
}

// Turns all by an angle that is the rotor's near it, and 0 at walls and pipe. A step that segments refuse is cut.
static void advance(deldrift_triangulation *t) {
    static double goals[2 * ROOM];
    size_t n;
    check(deldrift_copy_positions(t, positions, ROOM, &n));
    deldrift_status status = DELDRIFT_CROSSING;
    for (double turn = ANGLE; status == DELDRIFT_CROSSING || status == DELDRIFT_ON_SEGMENT; turn /= 2) {
        for (size_t v = 0; v < n; v++) {
            const double x = positions[2 * v], y = positions[2 * v + 1];
            const double angle = turn * fmin(1, fmax(0, (0.95 - hypot(x, y)) / 0.4)), c = cos(angle), s = sin(angle);
            goals[2 * v] = c * x - s * y, goals[2 * v + 1] = s * x + c * y;
        }
        status = deldrift_commit_positions(t, goals, n, NULL);
    }
    check(status);
}

// Gives the mesh its quality again, and new vertices, which have ids of those removed, the heat of what they were put into.
static void mend(deldrift_triangulation *t, const deldrift_quality *quality) {
    size_t n_new;
    check(deldrift_coarsen(t, quality, NULL, 0, NULL));
    check(deldrift_refine(t, quality, NULL, 0, NULL));
    check(deldrift_refined_vertices(t, come, ROOM, &n_new));
    check(deldrift_refined_weights(t, from, weights, ROOM, &n_new));
    for (size_t k = 0; k < 3 * n_new; k++) {
        double *const sum = heat + come[k / 3];
        *sum = (k % 3 == 0 ? 0 : *sum) + weights[k] * heat[from[k]];
    }
}

// Reads the cells, and measures those of the domain.
static void measure(const deldrift_triangulation *t) {
    size_t n;
    check(deldrift_cells(t, &cells));
    check(deldrift_copy_positions(t, positions, ROOM, &n));
    check(deldrift_volumes(t, areas, 2 * ROOM, &n));
    check(deldrift_nesting_levels(t, levels, 2 * ROOM, &n));
    area = total = 0, least_angle = 180;
    for (size_t c = 0; c < cells.count; c++) {
        for (int i = 0; i < 3 && levels[c] == 1; i++) {
            const uint32_t *v = cells.vertices + 3 * c, a = v[(i + 1) % 3], b = v[(i + 2) % 3];
            area += areas[c] / 3, total += areas[c] / 3 * heat[v[i]];
            least_angle = fmin(least_angle, atan2(2 * areas[c], product(v[i], a, b)) * 360 / TURN);
        }
    }
}

// Conducts heat for a time: what flows along an edge leaves one vertex and comes to the other.
static void conduct(const deldrift_triangulation *t) {
    static double mass[ROOM], share[ROOM], inflow[ROOM];
    size_t n;
    memset(mass, 0, sizeof mass), memset(share, 0, sizeof share), memset(inflow, 0, sizeof inflow);
    for (size_t c = 0; c < cells.count; c++) {
        for (int i = 0; i < 3 && levels[c] == 1; i++) {
            const uint32_t *v = cells.vertices + 3 * c, a = v[(i + 1) % 3], b = v[(i + 2) % 3];
            const double weight = TIME * product(v[i], a, b) / (4 * areas[c]);  // half the cotangent of the angle
            mass[v[i]] += areas[c] / 3;
            share[a] += weight, share[b] += weight;
            inflow[a] += weight * (heat[b] - heat[a]), inflow[b] += weight * (heat[a] - heat[b]);
        }
    }
    check(deldrift_segments(t, NULL, ends, markers, ROOM, &n));
    for (size_t k = 0; k < 2 * n; k++) {  // as much leaves as comes
        const double half = HEATING * TIME / 2 * distance(ends[k], ends[k ^ 1]) / lengths[markers[k / 2]];
        inflow[ends[k]] += markers[k / 2] == HEATED ? half : markers[k / 2] == COOLED ? -half : 0;
    }
    for (size_t v = 0; v < ROOM; v++) {
        if (share[v] > mass[v]) exit((fprintf(stderr, "the time of a step is too long for vertex %zu\n", v), 1));
        if (mass[v] > 0) heat[v] += inflow[v] / mass[v];
    }
}

int main(int argc, char **argv) {
    const int n_steps = argc > 1 ? atoi(argv[1]) : 10000;
    if (n_steps < 1) return 2;
    FILE *picture = begin_picture(argc > 2 ? argv[2] : NULL), *page = begin_page(argc > 3 ? argv[3] : NULL);
    deldrift_triangulation *t = build();
    deldrift_quality quality;
    check(deldrift_quality_init(&quality));
    quality.least_angle = 25, quality.greatest_area = 0.005, quality.has_weights = quality.reuses_ids = 1;
    const double exact = 6 - ROTOR / 2 * 0.5 * 0.15 * sin(TURN / ROTOR) - PIPE / 2 * 0.2 * 0.2 * sin(TURN / PIPE);
    double of_area = 0, of_heat = 0, of_carrying = 0, angle = 180;  // the worst of all steps
    for (int step = 0; step <= n_steps; step++) {
        if (step > 0) advance(t);
        mend(t, &quality);
        measure(t);
        const double missing = (exact - total) / area;  // as areas are others: all vertices get a part of it
        for (size_t v = 0; v < ROOM; v++) heat[v] += missing;
        conduct(t);
        measure(t);
        of_area = fmax(of_area, fabs(area - exact)), of_heat = fmax(of_heat, fabs(total - exact));
        of_carrying = fmax(of_carrying, fabs(missing)), angle = fmin(angle, least_angle);
        report(step, n_steps, t, picture, page);
    }
    printf("%d steps: least angle %.2f, area within %.0e, heat within %.0e, of which carrying over had changed %.0e\n",
           n_steps, angle, of_area, of_heat, of_carrying);
    deldrift_destroy(t);
    return end_picture(picture) + end_page(page) == 0 && of_area < 1e-11 && of_heat < 1e-11 && angle >= 25 ? 0 : 1;
}
