// Gas in the plane on a mesh that moves with it, on several processes: the Euler equations on Voronoi cells in a square
// that repeats. A stream of denser gas is between two that go the other way; the layers of shear roll up.
//     mpiexec -n 4 shear_layer [VERTICES [END [PICTURE.svg]]]
// Mass and energy are kept to rounding, and what is printed is the same on any number of processes.
#include <deldrift_mpi.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double GAMMA = 5.0 / 3, PI = 3.14159265358979323846, COURANT = 0.3;
static const double BOX[4] = {1, 0, 0, 1};
static const double LOW[2] = {-1, -1}, HIGH[2] = {2, 2}; // around all cells of own vertices

enum { DENSITY, X_VELOCITY, Y_VELOCITY, PRESSURE, X_MESH, Y_MESH, STATE };

// What a process has: of own vertices, in the order of their list, positions and what is in their cells (mass,
// momentum, energy); by id of its triangulation the state that follows, of own vertices and copies in any period.
typedef struct {
    deldrift_mpi *m;
    const deldrift_triangulation *t;
    size_t count, ids;
    uint32_t *vertices;
    double *points, *kept, *places, *volumes, *centroids, *states, *flux;
    uint64_t *keys;
    uint8_t *is_own;
} gas;

static int rank;

static void need(deldrift_status status, const char *message) {
    if (status == DELDRIFT_OK) return;
    fprintf(stderr, "process %d: %s\n", rank, message);
    MPI_Abort(MPI_COMM_WORLD, 1);
}
#define NEED(call) need((call), deldrift_mpi_last_error())
#define READ(call) need((call), deldrift_last_error())

static void *resized(void *array, size_t count, size_t size) {
    array = realloc(array, (count + 1) * size);
    need(array ? DELDRIFT_OK : DELDRIFT_OUT_OF_MEMORY, "no memory");
    return array;
}

// Positions, volumes and centroids after a change of the mesh.
static void read_mesh(gas *g) {
    NEED(deldrift_mpi_local(g->m, &g->t));
    NEED(deldrift_mpi_count(g->m, &g->count));
    READ(deldrift_id_count(g->t, &g->ids));
    g->vertices = resized(g->vertices, g->count, sizeof *g->vertices);
    g->places = resized(g->places, g->ids, 2 * sizeof(double));
    g->volumes = resized(g->volumes, g->ids, sizeof(double));
    g->centroids = resized(g->centroids, g->ids, 2 * sizeof(double));
    g->states = resized(g->states, g->ids, STATE * sizeof(double));
    g->flux = resized(g->flux, g->ids, 4 * sizeof(double));
    g->is_own = resized(g->is_own, g->ids, 1);
    g->keys = resized(g->keys, g->ids, sizeof *g->keys);
    NEED(deldrift_mpi_vertices(g->m, NULL, g->vertices, g->count, &g->count));
    READ(deldrift_copy_positions(g->t, g->places, g->ids, &g->ids));
    READ(deldrift_keys(g->t, g->keys, g->ids, &g->ids));
    memset(g->is_own, 0, g->ids);
    for (size_t i = 0; i < g->count; i++) g->is_own[g->vertices[i]] = 1;
    size_t n = g->ids;
    if (n) READ(deldrift_voronoi_cells(g->t, LOW, HIGH, g->is_own, n, g->volumes, NULL, g->centroids, n, &n));
    g->points = resized(g->points, g->count, 2 * sizeof(double));
    for (size_t i = 0; i < g->count; i++) memcpy(g->points + 2 * i, g->places + 2 * g->vertices[i], 2 * sizeof(double));
}

// Density, velocity and pressure from what is kept, and how the mesh moves: with the gas, and towards the middles of
// cells.
static double find_states(gas *g) {
    double step = 1, all;
    for (size_t i = 0; i < g->count; i++) {
        uint32_t v = g->vertices[i];
        double *s = g->states + STATE * v, *q = g->kept + 4 * i, volume = g->volumes[v];
        s[DENSITY] = q[0] / volume, s[X_VELOCITY] = q[1] / q[0], s[Y_VELOCITY] = q[2] / q[0];
        s[PRESSURE] = (GAMMA - 1) * (q[3] - 0.5 * (q[1] * q[1] + q[2] * q[2]) / q[0]) / volume;
        double sound = sqrt(GAMMA * s[PRESSURE] / s[DENSITY]), radius = sqrt(volume / PI);
        for (int k = 0; k < 2; k++)
            s[X_MESH + k] = s[X_VELOCITY + k] + 0.5 * sound * (g->centroids[2 * v + k] - g->points[2 * i + k]) / radius;
        step = fmin(step, COURANT * radius / sound);
    }
    MPI_Allreduce(&step, &all, 1, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
    NEED(deldrift_mpi_exchange(g->m, g->states, STATE * sizeof(double), g->ids));
    return all;
}

// Conserved quantities per area, their flux, and the velocity along the normal.
typedef struct {
    double u[4], f[4], normal, pressure, sound;
} side;

static side side_of(const double *s, const double *n) {
    side a;
    a.normal = s[X_VELOCITY] * n[0] + s[Y_VELOCITY] * n[1];
    a.pressure = s[PRESSURE];
    a.sound = sqrt(GAMMA * s[PRESSURE] / s[DENSITY]);
    a.u[0] = s[DENSITY];
    for (int k = 0; k < 2; k++) a.u[1 + k] = s[DENSITY] * s[X_VELOCITY + k];
    a.u[3] = s[PRESSURE] / (GAMMA - 1) + 0.5 * (a.u[1] * s[X_VELOCITY] + a.u[2] * s[Y_VELOCITY]);
    double push[4] = {0, n[0], n[1], a.normal};
    for (int k = 0; k < 4; k++) a.f[k] = a.u[k] * a.normal + a.pressure * push[k];
    return a;
}

// Through a facet that moves with the speed w along its normal: the solver of Toro, Spruce and Speares (HLLC).
static void find_flux(const double *left, const double *right, const double *n, double w, double flux[4]) {
    side l = side_of(left, n), r = side_of(right, n);
    double slow = fmin(l.normal - l.sound, r.normal - r.sound), fast = fmax(l.normal + l.sound, r.normal + r.sound);
    double ml = l.u[0] * (slow - l.normal), mr = r.u[0] * (fast - r.normal);
    double middle = (r.pressure - l.pressure + ml * l.normal - mr * r.normal) / (ml - mr);
    bool is_left = w < middle;
    const side *a = is_left ? &l : &r;
    double wave = is_left ? slow : fast, jump = middle - a->normal;
    double density = a->u[0] * (wave - a->normal) / (wave - middle);
    double star[4] = {density, density * (a->u[1] / a->u[0] + jump * n[0]), density * (a->u[2] / a->u[0] + jump * n[1]),
                      density * (a->u[3] / a->u[0] + jump * (middle + a->pressure / (a->u[0] * (wave - a->normal))))};
    bool is_outside = is_left ? w < slow : w > fast;
    for (int k = 0; k < 4; k++)
        flux[k] = is_outside ? a->f[k] - w * a->u[k] : a->f[k] + wave * (star[k] - a->u[k]) - w * star[k];
}

// What leaves each cell through its facets.
static void find_fluxes(gas *g) {
    size_t count = 0;
    READ(deldrift_edges(g->t, NULL, 0, &count));
    uint32_t *edges = resized(NULL, count, 2 * sizeof *edges);
    double *lengths = resized(NULL, count, sizeof *lengths), *middles = resized(NULL, count, 2 * sizeof *middles);
    READ(deldrift_edges(g->t, edges, count, &count));
    if (count)
        READ(deldrift_voronoi_derivatives(g->t, LOW, HIGH, g->is_own, g->ids, lengths, middles, NULL, count, &count));
    memset(g->flux, 0, 4 * g->ids * sizeof(double));
    for (size_t e = 0; e < count; e++) {
        uint32_t a = edges[2 * e], b = edges[2 * e + 1];
        if (!(g->is_own[a] || g->is_own[b]) || !(lengths[e] > 0)) continue;
        // The vertex of lower id is on the left, whichever process asks.
        if (g->keys[a] > g->keys[b]) a = edges[2 * e + 1], b = edges[2 * e];
        const double *l = g->states + STATE * a, *r = g->states + STATE * b;
        const double *p = g->places + 2 * a, *q = g->places + 2 * b;
        double distance = hypot(q[0] - p[0], q[1] - p[1]), n[2] = {(q[0] - p[0]) / distance, (q[1] - p[1]) / distance};
        double w = 0, flux[4];
        for (int k = 0; k < 2; k++)
            w += 0.5 * (l[X_MESH + k] + r[X_MESH + k]) * n[k] +
                 (l[X_MESH + k] - r[X_MESH + k]) * (middles[2 * e + k] - 0.5 * (p[k] + q[k])) / distance;
        find_flux(l, r, n, w, flux);
        for (int k = 0; k < 4; k++) {
            g->flux[4 * a + k] += lengths[e] * flux[k];
            g->flux[4 * b + k] -= lengths[e] * flux[k];
        }
    }
    free(edges), free(lengths), free(middles);
}

// A vertex that leaves the square goes on outside of it, or comes in at the other side: the library takes either.
static void advance(gas *g, double step) {
    for (size_t i = 0; i < g->count; i++) {
        const double *s = g->states + STATE * g->vertices[i], *f = g->flux + 4 * g->vertices[i];
        for (int k = 0; k < 4; k++) g->kept[4 * i + k] -= step * f[k];
        for (int k = 0; k < 2; k++) g->points[2 * i + k] += step * s[X_MESH + k];
    }
    NEED(deldrift_mpi_commit(g->m, g->points, g->count, NULL));
    read_mesh(g);
}

// Equal parts for all processes; what is kept goes along.
static void balance(gas *g) {
    const void *received;
    int32_t *targets = resized(NULL, g->count, sizeof *targets);
    NEED(deldrift_mpi_partition(g->m, NULL, g->count, targets));
    NEED(deldrift_mpi_migrate(g->m, targets, g->count, g->kept, 4 * sizeof(double), &received, NULL));
    free(targets);
    read_mesh(g);
    g->kept = resized(g->kept, g->count, 4 * sizeof(double));
    if (g->count) memcpy(g->kept, received, 4 * g->count * sizeof(double));
}

static void fill(gas *g) {
    g->kept = resized(g->kept, g->count, 4 * sizeof(double));
    for (size_t i = 0; i < g->count; i++) {
        double x = g->points[2 * i], y = g->points[2 * i + 1], volume = g->volumes[g->vertices[i]];
        double density = fabs(y - 0.5) < 0.25 ? 2 : 1, u = density - 1.5, v = 0.1 * sin(4 * PI * x);
        double energy = 2.5 / (GAMMA - 1) + 0.5 * density * (u * u + v * v);
        double per_area[4] = {density, density * u, density * v, energy};
        for (int k = 0; k < 4; k++) g->kept[4 * i + k] = per_area[k] * volume;
    }
}

static void report(const gas *g, int steps, double time) {
    double parts[2] = {0}, sums[2], densest = 0, most;
    for (size_t i = 0; i < g->count; i++) {
        parts[0] += g->kept[4 * i], parts[1] += g->kept[4 * i + 3];
        densest = fmax(densest, g->kept[4 * i] / g->volumes[g->vertices[i]]);
    }
    MPI_Reduce(parts, sums, 2, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
    MPI_Reduce(&densest, &most, 1, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
    if (rank == 0)
        printf("step %4d, time %.4f: mass %.12f, energy %.12f, greatest density %.6f\n", steps, time, sums[0],
               sums[1], most);
}

// Each cell as a dot of the colour of its density, by one process after the other.
static void draw(const gas *g, const char *path, int size) {
    for (int turn = 0; turn < size; turn++, MPI_Barrier(MPI_COMM_WORLD)) {
        if (turn != rank) continue;
        FILE *file = fopen(path, turn ? "a" : "w");
        need(file ? DELDRIFT_OK : DELDRIFT_IO_ERROR, "the picture cannot be written");
        if (turn == 0) fprintf(file, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 1000 1000' width='500'>\n");
        for (size_t i = 0; i < g->count; i++) {
            double volume = g->volumes[g->vertices[i]], share = fmin(fmax(g->kept[4 * i] / volume - 0.8, 0) / 1.2, 1);
            double x = g->points[2 * i], y = -g->points[2 * i + 1];
            int red = (int)(240 * share), blue = (int)(240 * (1 - share));
            fprintf(file, "<circle cx='%.0f' cy='%.0f' r='%.0f' fill='#%02x50%02x'/>\n", 1000 * (x - floor(x)),
                    1000 * (y - floor(y)), 1 + 760 * sqrt(volume), red, blue);
        }
        if (turn == size - 1) fprintf(file, "</svg>\n");
        fclose(file);
    }
}

int main(int argc, char **argv) {
    int size, steps = 0;
    MPI_Init(&argc, &argv), MPI_Comm_rank(MPI_COMM_WORLD, &rank), MPI_Comm_size(MPI_COMM_WORLD, &size);
    size_t vertices = argc > 1 ? (size_t)atol(argv[1]) : 2500, row = (size_t)ceil(sqrt((double)vertices));
    double end = argc > 2 ? atof(argv[2]) : 1, time = 0;
    gas g = {0};
    uint64_t *ids = resized(NULL, row * row, sizeof *ids);
    g.points = resized(NULL, 2 * row * row, sizeof(double));
    for (size_t i = (size_t)rank; i < row * row; i += (size_t)size, g.count++) {
        ids[g.count] = i;
        g.points[2 * g.count] = ((double)(i % row) + 0.5 + 0.2 * sin(37.0 * (double)i)) / (double)row;
        g.points[2 * g.count + 1] = ((double)(i / row) + 0.5 + 0.2 * sin(91.0 * (double)i)) / (double)row;
    }
    NEED(deldrift_mpi_create_periodic(MPI_COMM_WORLD, 2, g.points, ids, g.count, BOX, 2, NULL, &g.m));
    read_mesh(&g);
    fill(&g);
    for (; time < end; steps++) {
        if (steps % 50 == 0) balance(&g);
        double step = fmin(find_states(&g), end - time);
        if (steps % 50 == 0) report(&g, steps, time);
        find_fluxes(&g), advance(&g, step);
        time += step;
    }
    report(&g, steps, time);
    if (argc > 3) draw(&g, argv[3], size);
    deldrift_mpi_destroy(g.m);
    free(g.vertices), free(g.points), free(g.kept), free(g.places), free(g.volumes), free(g.centroids);
    free(g.states), free(g.flux), free(g.is_own), free(g.keys), free(ids);
    MPI_Finalize();
}
