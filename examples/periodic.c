// A sheared periodic box. Soft discs are dragged along by a box that is sheared, without walls: each disc pushes its
// neighbours, those across the border included, and every vertex is there once. Where the box leans by more than half of its
// width, another basis of its lattice is taken, which leaves all cells as they are.
//
//   cc examples/periodic.c -Iinclude target/release/libdeldrift.a -lm -lpthread -ldl -o periodic && ./periodic picture.svg
#include <deldrift.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N = 400, EDGES = 4 * N, STEPS = 470, WIDTH = 600 };

static const double STEP = 0.005, DIAMETER = 0.055;
static double positions[2 * N], forces[2 * N], areas[N];

static void check(deldrift_status status) {
    if (status == DELDRIFT_OK) return;
    fprintf(stderr, "%s: %s\n", deldrift_status_string(status), deldrift_last_error());
    exit(1);
}

static double random_number(void) {
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

// Where a vertex is after a translation by these multiples of the vectors of the box.
static void place(const double *box, uint32_t vertex, const int64_t *shift, double *to) {
    for (int axis = 0; axis < 2; axis++) {
        to[axis] = positions[2 * vertex + axis] + (double)shift[0] * box[axis] + (double)shift[1] * box[2 + axis];
    }
}

// Discs that overlap push each other along the edge between them; the sum of all forces is none.
static void push(const deldrift_triangulation *t, const double *box) {
    static uint32_t edges[2 * EDGES];
    static int64_t shifts[2 * EDGES];
    size_t count;
    check(deldrift_edges(t, edges, EDGES, &count));
    check(deldrift_edge_shifts(t, shifts, EDGES, &count));
    memset(forces, 0, sizeof forces);
    for (size_t k = 0; k < count; k++) {
        const uint32_t u = edges[2 * k], w = edges[2 * k + 1];
        double to[2];
        place(box, w, shifts + 2 * k, to);
        const double x = to[0] - positions[2 * u], y = to[1] - positions[2 * u + 1], length = hypot(x, y);
        const double strength = length < DIAMETER ? (DIAMETER - length) / length : 0;
        forces[2 * u] -= strength * x;
        forces[2 * u + 1] -= strength * y;
        forces[2 * w] += strength * x;
        forces[2 * w + 1] += strength * y;
    }
}

// The cells where their shifts have them, and the box.
static void draw(FILE *file, const deldrift_triangulation *t, const double *box) {
    static int64_t shifts[6 * 2 * N];
    deldrift_cells_view view;
    size_t count;
    check(deldrift_cells(t, &view));
    check(deldrift_cell_shifts(t, shifts, NULL, 2 * N, &count));
    fprintf(file, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-360 -60 1440 720'>\n");
    fprintf(file, "<style>path{fill:rgb(225,232,250);stroke:rgb(90,110,170)}.b{fill:none;stroke:black;stroke-width:4}</style>\n");
    for (size_t c = 0; c < count; c++) {
        fprintf(file, "<path d='");
        for (size_t i = 0; i < 3; i++) {
            double at[2];
            place(box, view.vertices[3 * c + i], shifts + 6 * c + 2 * i, at);
            fprintf(file, "%c%.0f %.0f", i == 0 ? 'M' : 'L', WIDTH * at[0], WIDTH * (1 - at[1]));
        }
        fprintf(file, "z'/>\n");
    }
    fprintf(file, "<path class='b' d='M0 %d l%.0f %.0f l%.0f %.0f l%.0f %.0fz'/>\n</svg>\n", WIDTH, WIDTH * box[0],
            -WIDTH * box[1], WIDTH * box[2], -WIDTH * box[3], -WIDTH * box[0], WIDTH * box[1]);
}

// Positions in the box; a vertex that leaves it comes in at the other side.
static void wrap(const deldrift_triangulation *t) {
    static double places[2 * N];
    static int64_t shifts[2 * N];
    check(deldrift_wrap_positions(t, positions, NULL, N, places, shifts));
    memcpy(positions, places, sizeof positions);
}

// Whether what is in the middle of the box is also ten boxes away, ten boxes away.
static bool is_everywhere(const deldrift_triangulation *t, const double *box) {
    double places[4];
    int64_t shifts[4];
    deldrift_location at[2];
    for (int axis = 0; axis < 2; axis++) {
        places[axis] = 0.5 * (box[axis] + box[2 + axis]);
        places[2 + axis] = places[axis] + 10 * box[axis];
    }
    check(deldrift_locate_in_period(t, places, 2, NULL, at, shifts));
    return at[0].kind == DELDRIFT_LOCATION_CELL && at[0].index == at[1].index && shifts[2] == shifts[0] + 10 &&
           shifts[3] == shifts[1];
}

int main(int argc, char **argv) {
    double box[] = {1, 0, 0, 1}, used[4], shortest[4], error = 0, momentum = 0;
    size_t flips = 0, kept = 0, count = 0, cells = 0;
    deldrift_triangulation *t = NULL;
    for (size_t i = 0; i < 2 * N; i++) positions[i] = random_number();
    check(deldrift_create_periodic(2, positions, N, box, 2, NULL, &t));
    for (int step = 0; step < STEPS; step++) {
        push(t, box);
        double sum = 0;
        for (size_t i = 0; i < 2 * N; i++) sum += forces[i];
        momentum = fmax(momentum, fabs(sum));
        wrap(t);
        // What is in the box is sheared with it.
        for (size_t v = 0; v < N; v++) {
            positions[2 * v] += 0.4 * forces[2 * v] + STEP * positions[2 * v + 1];
            positions[2 * v + 1] += 0.4 * forces[2 * v + 1];
        }
        box[2] += STEP * box[3];
        check(deldrift_stage_vectors(t, box, 2));
        check(deldrift_commit_positions(t, positions, N, NULL));
        check(deldrift_voronoi_volumes(t, NULL, NULL, areas, N, &count));
        double area = 0;
        for (size_t v = 0; v < N; v++) area += areas[v];
        error = fmax(error, fabs(area - 1));
        if (box[2] <= 0.5 * box[0]) continue;
        box[2] -= box[0];
        check(deldrift_stage_vectors(t, box, 2));
        check(deldrift_commit_timestamp(t, NULL));
        double after[N];
        check(deldrift_voronoi_volumes(t, NULL, NULL, after, N, &count));
        bool is_same = true;
        for (size_t v = 0; v < N; v++) is_same = is_same && fabs(after[v] - areas[v]) < 1e-12;
        kept += is_same;
        flips++;
    }
    check(deldrift_cell_count(t, &cells));
    check(deldrift_vectors(t, used, 2, &count));
    check(deldrift_reduced_vectors(t, shortest, NULL, NULL, 2, &count));
    printf("%d steps, %zu cells of %d discs; area within %.1e, momentum within %.1e\n", STEPS, cells, N, error, momentum);
    printf("after %zu of %zu changes of the basis all areas are as before; the box leans by %.3f\n", kept, flips, used[2]);
    FILE *file = argc > 1 ? fopen(argv[1], "w") : tmpfile();
    if (file == NULL) return 1;
    draw(file, t, box);
    const bool is_found = is_everywhere(t, used);
    deldrift_destroy(t);
    return fclose(file) == 0 && is_found && cells == 2 * N && kept == flips && shortest[2] == used[2] ? 0 : 1;
}
