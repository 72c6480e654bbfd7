// Gas in the plane on a mesh that moves with it, on several processes: the Euler equations on Voronoi cells. A disc of
// denser gas turns within gas at rest; the layer of shear around it rolls up. Walls are around all.
//     mpiexec -n 4 shear_layer [VERTICES [END [PICTURE.svg]]]
// Mass and energy are kept to rounding, and what is printed is the same on any number of processes.
#include <deldrift_mpi.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double GAMMA = 5.0 / 3, PI = 3.14159265358979323846, COURANT = 0.3;
static const double LOW[2] = {0, 0}, HIGH[2] = {1, 1};

enum { DENSITY, X_VELOCITY, Y_VELOCITY, PRESSURE, X_MESH, Y_MESH, STATE };

// What a process has: of own vertices, in the order of their list, positions and what is in their cells (mass,
// momentum, energy); by id of its triangulation the state that follows, of own vertices and copies.
typedef struct {
    deldrift_mpi *m;
    const deldrift_triangulation *t;
    size_t count, ids;
    uint32_t *vertices;
    double *points, *kept;
    double *places, *volumes, *centroids, *states, *flux;
    uint8_t *is_own;
    uint64_t *keys;
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
    g->flux = resized(g->flux, g->ids, 6 * sizeof(double));
    g->is_own = resized(g->is_own, g->ids, 1);
    g->keys = resized(g->keys, g->ids, sizeof *g->keys);
    NEED(deldrift_mpi_vertices(g->m, NULL, g->vertices, g->count, &g->count));
    READ(deldrift_copy_positions(g->t, g->places, g->ids, &g->ids));
    READ(deldrift_keys(g->t, g->keys, g->ids, &g->ids));
    memset(g->is_own, 0, g->ids);
    for (size_t i = 0; i < g->count; i++) g->is_own[g->vertices[i]] = 1;
    if (g->ids)
        READ(deldrift_voronoi_cells(g->t, LOW, HIGH, g->is_own, g->ids, g->volumes, NULL, g->centroids, g->ids,
                                    &g->ids));
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
        s[DENSITY] = q[0] / volume;
        for (int k = 0; k < 2; k++) s[X_VELOCITY + k] = q[1 + k] / q[0];
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

// What leaves each cell through its facets, and the part of its boundary that is none of these: a wall.
static void find_fluxes(gas *g) {
    size_t count = 0;
    READ(deldrift_edges(g->t, NULL, 0, &count));
    uint32_t *edges = resized(NULL, count, 2 * sizeof *edges);
    double *lengths = resized(NULL, count, sizeof *lengths), *middles = resized(NULL, count, 2 * sizeof *middles);
    READ(deldrift_edges(g->t, edges, count, &count));
    if (count)
        READ(deldrift_voronoi_derivatives(g->t, LOW, HIGH, g->is_own, g->ids, lengths, middles, NULL, count, &count));
    memset(g->flux, 0, 6 * g->ids * sizeof(double));
    for (size_t e = 0; e < count; e++) {
        uint32_t a = edges[2 * e], b = edges[2 * e + 1];
        if (!(g->is_own[a] || g->is_own[b]) || !(lengths[e] > 0)) continue;
        // The vertex of lower id is on the left, whichever process asks.
        if (g->keys[a] > g->keys[b]) a = edges[2 * e + 1], b = edges[2 * e];
        const double *l = g->states + STATE * a, *r = g->states + STATE * b, *p = g->places + 2 * a,
                     *q = g->places + 2 * b;
        double distance = hypot(q[0] - p[0], q[1] - p[1]), n[2] = {(q[0] - p[0]) / distance, (q[1] - p[1]) / distance};
        double w = 0, flux[4];
        for (int k = 0; k < 2; k++)
            w += 0.5 * (l[X_MESH + k] + r[X_MESH + k]) * n[k] +
                 (l[X_MESH + k] - r[X_MESH + k]) * (middles[2 * e + k] - 0.5 * (p[k] + q[k])) / distance;
        find_flux(l, r, n, w, flux);
        for (int k = 0; k < 6; k++) {
            double part = lengths[e] * (k < 4 ? flux[k] : n[k - 4]);
            g->flux[6 * a + k] += part;
            g->flux[6 * b + k] -= part;
        }
    }
    free(edges), free(lengths), free(middles);
}

static void advance(gas *g, double step) {
    for (size_t i = 0; i < g->count; i++) {
        const double *s = g->states + STATE * g->vertices[i], *f = g->flux + 6 * g->vertices[i];
        double wall[2] = {-f[4], -f[5]}, length = hypot(wall[0], wall[1]);
        double sound = sqrt(GAMMA * s[PRESSURE] / s[DENSITY]), pressure = s[PRESSURE];
        if (length > 1e-9)
            pressure += s[DENSITY] * sound * (s[X_VELOCITY] * wall[0] + s[Y_VELOCITY] * wall[1]) / length;
        for (int k = 0; k < 4; k++) g->kept[4 * i + k] -= step * f[k];
        for (int k = 0; k < 2; k++) {
            g->kept[4 * i + 1 + k] -= step * pressure * wall[k];
            g->points[2 * i + k] = fmin(fmax(g->points[2 * i + k] + step * s[X_MESH + k], 1e-6), 1 - 1e-6);
        }
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
        double x = g->points[2 * i] - 0.5, y = g->points[2 * i + 1] - 0.5, volume = g->volumes[g->vertices[i]];
        double edge = 0.25 * (1 + 0.03 * cos(5 * atan2(y, x))), radius = hypot(x, y), turn = radius < edge ? 4 : 0;
        double density = turn > 0 ? 2 : 1, pressure = 4 - 0.5 * density * turn * turn * (edge * edge - radius * radius);
        double energy = pressure / (GAMMA - 1) + 0.5 * density * turn * turn * radius * radius;
        double per_area[4] = {density, -turn * y * density, turn * x * density, energy};
        for (int k = 0; k < 4; k++) g->kept[4 * i + k] = per_area[k] * volume;
    }
}

static void report(const gas *g, int steps, double time) {
    double sums[2] = {0}, all[2], densest = 0, most;
    for (size_t i = 0; i < g->count; i++) {
        sums[0] += g->kept[4 * i];
        sums[1] += g->kept[4 * i + 3];
        densest = fmax(densest, g->kept[4 * i] / g->volumes[g->vertices[i]]);
    }
    MPI_Reduce(sums, all, 2, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
    MPI_Reduce(&densest, &most, 1, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
    if (rank == 0)
        printf("step %4d, time %.4f: mass %.12f, energy %.12f, greatest density %.6f\n", steps, time, all[0], all[1],
               most);
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
            fprintf(file, "<circle cx='%.0f' cy='%.0f' r='%.0f' fill='#%02x50%02x'/>\n", 1000 * g->points[2 * i],
                    1000 - 1000 * g->points[2 * i + 1], 1 + 640 * sqrt(volume), (int)(240 * share),
                    (int)(240 * (1 - share)));
        }
        if (turn == size - 1) fprintf(file, "</svg>\n");
        fclose(file);
    }
}

int main(int argc, char **argv) {
    int size, steps = 0;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank), MPI_Comm_size(MPI_COMM_WORLD, &size);
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
    NEED(deldrift_mpi_create(MPI_COMM_WORLD, 2, g.points, ids, g.count, NULL, &g.m));
    read_mesh(&g);
    fill(&g);
    for (; time < end; steps++) {
        if (steps % 50 == 0) balance(&g);
        double step = fmin(find_states(&g), end - time);
        if (steps % 50 == 0) report(&g, steps, time);
        find_fluxes(&g);
        advance(&g, step);
        time += step;
    }
    report(&g, steps, time);
    if (argc > 3) draw(&g, argv[3], size);
    deldrift_mpi_destroy(g.m);
    void *arrays[] = {g.vertices, g.points, g.kept,   g.places, g.volumes, g.centroids,
                      g.states,   g.flux,   g.is_own, g.keys,   ids};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
    MPI_Finalize();
}
