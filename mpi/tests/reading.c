// What a process reads of its part of a box that repeats, of own vertices, is what one process reads of all of them.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "repeating.h"

// Positions are rounded to one grid by all, so that numbers differ by the order of sums alone.
static const double OFF = 1e-9;

static long compared_facets, compared_vertices, compared_places;

typedef struct {
    uint64_t id;
    double position[3];
} vertex;

// The facet of an edge as seen from one of its ends: where the other one is if this one is where the program has it.
typedef struct {
    uint32_t from, to; // in the order of global ids
    int64_t shift[3];
    double measure;
    double centroid[3]; // from the end
    double derivatives[2][3];
} facet;

// A triangulation and what is read of it.
typedef struct {
    const deldrift_triangulation *t;
    size_t ids, edges;
    double *positions, *volumes, *areas, *centroids, *measures, *middles, *derivatives;
    uint32_t *ends;
} reading;

static void *room(size_t count, size_t bytes) {
    return calloc(count + 1, bytes);
}

static int compare_vertices(const void *first, const void *second) {
    const vertex *a = first, *b = second;
    return a->id < b->id ? -1 : a->id > b->id;
}

static int compare_facets(const void *first, const void *second) {
    const facet *a = first, *b = second;
    if (a->from != b->from) return a->from < b->from ? -1 : 1;
    if (a->to != b->to) return a->to < b->to ? -1 : 1;
    for (int k = 0; k < 3; k++)
        if (a->shift[k] != b->shift[k]) return a->shift[k] < b->shift[k] ? -1 : 1;
    return 0;
}

static bool is_close(double x, double y) {
    return x == y || (isnan(x) && isnan(y)) || fabs(x - y) <= OFF * (1 + fabs(y));
}

// All that there is of Voronoi cells and facets, in one call, and the same in several.
static reading read_all(const deldrift_triangulation *t, uint32_t d, const double *low, const double *high) {
    reading r = {.t = t};
    OK(deldrift_id_count(t, &r.ids));
    OK(deldrift_edges(t, NULL, 0, &r.edges));
    r.positions = room(r.ids * d, sizeof(double));
    r.volumes = room(r.ids, sizeof(double));
    r.areas = room(r.ids, sizeof(double));
    r.centroids = room(r.ids * d, sizeof(double));
    r.measures = room(r.edges, sizeof(double));
    r.middles = room(r.edges * d, sizeof(double));
    r.derivatives = room(r.edges * 2 * d, sizeof(double));
    r.ends = room(r.edges * 2, sizeof(uint32_t));
    OK(deldrift_copy_positions(t, r.positions, r.ids, &r.ids));
    OK(deldrift_edges(t, r.ends, r.edges, &r.edges));
    OK(deldrift_voronoi_cells_and_facets(t, low, high, NULL, 0, NULL, 0, r.volumes, r.areas, r.centroids, r.ids, &r.ids,
                                         r.measures, r.middles, r.derivatives, r.edges, &r.edges));
    double *again = room(r.ids + r.edges, sizeof(double));
    OK(deldrift_voronoi_cells(t, low, high, NULL, 0, again, NULL, NULL, r.ids, &r.ids));
    CHECK(!memcmp(again, r.volumes, r.ids * sizeof *again));
    OK(deldrift_voronoi_volumes(t, low, high, again, r.ids, &r.ids));
    CHECK(!memcmp(again, r.volumes, r.ids * sizeof *again));
    OK(deldrift_voronoi_derivatives(t, low, high, NULL, 0, again, NULL, NULL, r.edges, &r.edges));
    CHECK(!memcmp(again, r.measures, r.edges * sizeof *again));
    OK(deldrift_voronoi_facets(t, low, high, again, r.edges, &r.edges));
    CHECK(!memcmp(again, r.measures, r.edges * sizeof *again));
    free(again);
    return r;
}

static void forget(reading *r) {
    free(r->positions);
    free(r->volumes);
    free(r->areas);
    free(r->centroids);
    free(r->measures);
    free(r->middles);
    free(r->derivatives);
    free(r->ends);
}

// Of an edge, as seen from its first (0) or second (1) end; centroids are told where `anchor` is.
static facet facet_of(const reading *r, uint32_t d, size_t edge, int end, const double *anchor) {
    facet f;
    memset(&f, 0, sizeof f);
    f.measure = r->measures[edge];
    for (uint32_t k = 0; k < d; k++) {
        f.centroid[k] = r->middles[edge * d + k] - anchor[k];
        f.derivatives[0][k] = r->derivatives[(2 * edge + (size_t)end) * d + k];
        f.derivatives[1][k] = r->derivatives[(2 * edge + 1 - (size_t)end) * d + k];
    }
    return f;
}

// Facets of all vertices, each from both of its ends, in order.
static facet *serial_facets(const history *h, const reading *r, size_t *count) {
    uint32_t d = h->dimension;
    int64_t *shifts = room(r->edges * d, sizeof *shifts);
    size_t n;
    OK(deldrift_edge_shifts(r->t, shifts, r->edges, &n));
    facet *facets = room(2 * r->edges, sizeof *facets);
    for (size_t e = 0; e < r->edges; e++) {
        for (int end = 0; end < 2; end++) {
            uint32_t v = r->ends[2 * e + (size_t)end], w = r->ends[2 * e + 1 - (size_t)end];
            double anchor[3] = {0, 0, 0};
            for (uint32_t k = 0; k < d; k++) {
                anchor[k] = r->positions[v * d + k];
                for (size_t j = 0; j < h->vector_count && end; j++)
                    anchor[k] += (double)shifts[e * d + j] * h->vectors[j * d + k];
            }
            facet f = facet_of(r, d, e, end, anchor);
            f.from = v;
            f.to = w;
            for (size_t j = 0; j < h->vector_count; j++) f.shift[j] = end ? -shifts[e * d + j] : shifts[e * d + j];
            facets[2 * e + (size_t)end] = f;
        }
    }
    *count = 2 * r->edges;
    qsort(facets, *count, sizeof *facets, compare_facets);
    free(shifts);
    return facets;
}

static bool is_same_facet(uint32_t d, const facet *found, const facet *wanted) {
    bool is_same = is_close(found->measure, wanted->measure);
    // The centroid of next to nothing may be anywhere in it.
    bool has_centroid = wanted->measure > 1e-6 && isfinite(wanted->measure);
    for (uint32_t k = 0; k < d; k++) {
        is_same = is_same && (!has_centroid || is_close(found->centroid[k], wanted->centroid[k]));
        for (int i = 0; i < 2; i++) is_same = is_same && is_close(found->derivatives[i][k], wanted->derivatives[i][k]);
    }
    return is_same;
}

// Places near own vertices: where the nearest vertex is own, or the place is in a cell with an own corner, the whole says so too.
static void compare_locations(const history *h, const reading *local, const reading *serial, const uint32_t *rank_of,
                              const bool *is_own, const uint32_t *own, size_t own_count) {
    uint32_t d = h->dimension;
    uint64_t state = 99;
    deldrift_cells_view view, all;
    OK(deldrift_cells(local->t, &view));
    OK(deldrift_cells(serial->t, &all));
    for (size_t i = 0; i < own_count && i < 40; i++) {
        double x[3] = {0, 0, 0};
        for (uint32_t k = 0; k < d; k++)
            x[k] = local->positions[own[i] * d + k] + 0.125 * (random_number(&state) - 0.5);
        uint32_t near = 0, wanted = 0;
        OK(deldrift_nearest_vertex(local->t, x, &near));
        OK(deldrift_nearest_vertex(serial->t, x, &wanted));
        if (is_own[near]) {
            CHECK(rank_of[near] == wanted);
            compared_places++;
        }
        deldrift_location here, there;
        OK(deldrift_locate(local->t, x, &here));
        if (here.kind != DELDRIFT_LOCATION_CELL) continue;
        const uint32_t *corners = view.vertices + (size_t)here.index * (d + 1);
        bool has_own = false;
        for (uint32_t k = 0; k <= d; k++) has_own = has_own || is_own[corners[k]];
        if (!has_own) continue;
        OK(deldrift_locate(serial->t, x, &there));
        CHECK(there.kind == DELDRIFT_LOCATION_CELL);
        const uint32_t *row = all.vertices + (size_t)there.index * (d + 1);
        for (uint32_t k = 0; k <= d; k++) {
            size_t here_too = 0, there_too = 0;
            for (uint32_t j = 0; j <= d; j++) {
                here_too += rank_of[corners[j]] == rank_of[corners[k]];
                there_too += row[j] == rank_of[corners[k]];
            }
            CHECK(here_too == there_too);
        }
        compared_places++;
    }
}

// Within walls, which the whole may have at infinity along axes along which vectors go, and a part far away.
static void compare(const history *h, const vertex *all, size_t n, const double *low, const double *high) {
    uint32_t d = h->dimension;
    double *positions = room(n * d, sizeof *positions), far_low[3], far_high[3];
    for (size_t i = 0; i < n; i++) memcpy(positions + i * d, all[i].position, d * sizeof *positions);
    deldrift_triangulation *t = NULL;
    const deldrift_triangulation *part;
    OK(deldrift_create_periodic(d, positions, n, h->vectors, h->vector_count, NULL, &t));
    OK(deldrift_mpi_local(h->m, &part));
    for (uint32_t k = 0; k < d && low; k++) {
        far_low[k] = isfinite(low[k]) ? low[k] : -16;
        far_high[k] = isfinite(high[k]) ? high[k] : 16;
    }
    reading serial = read_all(t, d, low, high), local = read_all(part, d, low ? far_low : NULL, low ? far_high : NULL);
    size_t own = h->count, ids = local.ids, count = 0;
    uint32_t *vertices = room(own, sizeof *vertices), *rank_of = room(ids, sizeof *rank_of);
    uint64_t *keys = room(ids, sizeof *keys);
    int64_t *periods = room(ids * d, sizeof *periods);
    bool *is_own = room(ids, sizeof *is_own);
    OK(deldrift_mpi_vertices(h->m, NULL, vertices, own, &own));
    OK(deldrift_keys(part, keys, ids, &ids));
    OK(deldrift_mpi_periods(h->m, periods, ids, &ids));
    for (size_t v = 0; v < ids; v++) {
        const vertex wanted = {keys[v], {0, 0, 0}};
        const vertex *found = bsearch(&wanted, all, n, sizeof *all, compare_vertices);
        rank_of[v] = found ? (uint32_t)(found - all) : DELDRIFT_NONE;
    }
    for (size_t i = 0; i < own; i++) {
        uint32_t v = vertices[i], w = rank_of[v];
        is_own[v] = true;
        CHECK(is_close(local.volumes[v], serial.volumes[w]) && is_close(local.areas[v], serial.areas[w]));
        for (uint32_t k = 0; k < d && serial.volumes[w] > 1e-6; k++) {
            // Centroids are where the vertex is at home, and where it was given.
            double here = local.centroids[v * d + k] - local.positions[v * d + k];
            CHECK(is_close(here, serial.centroids[w * d + k] - serial.positions[w * d + k]));
            double given = local.centroids[v * d + k];
            for (size_t j = 0; j < h->vector_count; j++) given -= (double)periods[v * d + j] * h->vectors[j * d + k];
            CHECK(is_close(given, serial.centroids[w * d + k]));
        }
        compared_vertices++;
    }
    size_t found = 0, expected = 0;
    facet *facets = serial_facets(h, &serial, &count);
    for (size_t e = 0; e < local.edges; e++) {
        for (int end = 0; end < 2; end++) {
            uint32_t v = local.ends[2 * e + (size_t)end], w = local.ends[2 * e + 1 - (size_t)end];
            if (!is_own[v]) continue;
            facet f = facet_of(&local, d, e, end, local.positions + v * d);
            f.from = rank_of[v];
            f.to = rank_of[w];
            for (size_t j = 0; j < h->vector_count; j++) f.shift[j] = periods[w * d + j] - periods[v * d + j];
            const facet *wanted = bsearch(&f, facets, count, sizeof *facets, compare_facets);
            CHECK(wanted && is_same_facet(d, &f, wanted));
            found++;
        }
    }
    for (size_t k = 0; k < count; k++)
        for (size_t i = 0; i < own; i++) expected += facets[k].from == rank_of[vertices[i]];
    CHECK(found == expected);
    compared_facets += (long)found;
    if (!low) compare_locations(h, &local, &serial, rank_of, is_own, vertices, own);
    forget(&serial);
    forget(&local);
    free(facets);
    free(positions);
    free(vertices);
    free(rank_of);
    free(keys);
    free(periods);
    free(is_own);
    deldrift_destroy(t);
}

static void run(uint32_t d, size_t box, set_kind kind, int spread) {
    history h;
    memset(&h, 0, sizeof h);
    h.dimension = d;
    memcpy(h.vectors, boxes[d - 2][box], sizeof h.vectors);
    h.vector_count = vector_counts[d - 2][box];
    h.kind = kind;
    h.common = 31 * box + (uint64_t)kind + d;
    h.state = 7 + (uint64_t)rank;
    begin(&h, kind == FEW ? 3 : 60, spread, NULL);
    for (int step = 0; step < 2; step++) {
        size_t bytes = 0;
        vertex *own = room(h.count, sizeof *own);
        uint64_t *ids = room(h.count, sizeof *ids);
        OK(deldrift_mpi_vertices(h.m, ids, NULL, h.count, &h.count));
        for (size_t i = 0; i < h.count; i++) {
            own[i].id = ids[i];
            memcpy(own[i].position, h.positions + i * d, d * sizeof(double));
        }
        vertex *all = gather(own, h.count * sizeof *own, &bytes);
        size_t n = bytes / sizeof *all;
        qsort(all, n, sizeof *all, compare_vertices);
        compare(&h, all, n, NULL, NULL);
        // Walls, where the box is open along an axis.
        double low[3], high[3];
        bool is_open = false;
        for (uint32_t k = 0; k < d; k++) {
            bool is_spanned = false;
            for (size_t j = 0; j < h.vector_count; j++) is_spanned = is_spanned || h.vectors[j * d + k] != 0;
            is_open = is_open || !is_spanned;
            low[k] = is_spanned ? -INFINITY : 0.0625;
            high[k] = is_spanned ? INFINITY : 0.75;
        }
        if (is_open && h.vector_count < d) compare(&h, all, n, low, high);
        free(own);
        free(ids);
        free(all);
        // Some leave their period.
        for (size_t i = 0; i < h.count * d; i++) h.positions[i] += 0.25 * (random_number(&h.state) - 0.5);
        for (size_t i = 0; i < h.count; i += 5)
            for (uint32_t k = 0; k < d; k++) h.positions[i * d + k] += 3 * h.vectors[k];
        OK(deldrift_mpi_commit(h.m, h.positions, h.count, NULL));
    }
    deldrift_mpi_destroy(h.m);
    free(h.positions);
}

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    // The more processes share a processor, the fewer sets.
    int every = argc > 1 ? atoi(argv[1]) : 1, number = 0;
    for (uint32_t d = 2; d <= 3; d++)
        for (size_t box = 0; box < BOXES; box++)
            for (int kind = 0; kind < SETS; kind++)
                if (number++ % every == 0) run(d, box, (set_kind)kind, (int)((box + (size_t)kind) % 3));
    long sums[3] = {compared_vertices, compared_facets, compared_places}, whole[3];
    MPI_Allreduce(sums, whole, 3, MPI_LONG, MPI_SUM, MPI_COMM_WORLD);
    CHECK(whole[0] > 0 && whole[1] > 0 && whole[2] > 0);
    if (rank == 0)
        printf("reading, P = %d: %ld vertices, %ld facets and %ld places compared, %ld failures\n", size, whole[0],
               whole[1], whole[2], failures);
    MPI_Finalize();
    return failures ? 1 : 0;
}
