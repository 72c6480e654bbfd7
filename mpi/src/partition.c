// Parts of Hilbert's curve, of equal weight.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

// Bits of a coordinate on the finest grid.
static int bits_of(uint32_t dimension) {
    return dimension == 2 ? 31 : 20;
}

// The place on the curve of a cell of the grid. J. Skilling: Programming the Hilbert curve, AIP Conference Proceedings
// 707, 2004, 10.1063/1.1751381: from the coarsest level on, the coordinates below are mirrored or exchanged as the
// curve turns; the Gray code of what that gives is the place.
static uint64_t curve_place(uint32_t dimension, uint32_t x[3]) {
    uint32_t top = (uint32_t)1 << (bits_of(dimension) - 1);
    for (uint32_t level = top; level > 1; level >>= 1) {
        uint32_t below = level - 1;
        for (uint32_t k = 0; k < dimension; k++) {
            uint32_t exchanged = x[k] & level ? 0 : (x[0] ^ x[k]) & below;
            if (x[k] & level) x[0] ^= below;
            x[0] ^= exchanged;
            x[k] ^= exchanged;
        }
    }
    for (uint32_t k = 1; k < dimension; k++) x[k] ^= x[k - 1];
    uint32_t turned = 0;
    for (uint32_t level = top; level > 1; level >>= 1)
        if (x[dimension - 1] & level) turned ^= level - 1;
    uint64_t place = 0;
    for (uint32_t level = top; level; level >>= 1)
        for (uint32_t k = 0; k < dimension; k++) place = place << 1 | (((x[k] ^ turned) & level) != 0);
    return place;
}

typedef struct {
    uint64_t place;
    double weight; // in the sorted list, with all before it
} item;

static int compare_items(const void *first, const void *second) {
    const item *a = first, *b = second;
    return a->place < b->place ? -1 : a->place > b->place;
}

// The place on the curve of each own vertex, which is at `own`, on a grid of cubes over all vertices.
static void find_places(const deldrift_mpi *m, const double *own, item *items) {
    uint32_t d = m->dimension;
    double bounds[6], all[6], side = 0;
    for (uint32_t k = 0; k < 2 * d; k++) bounds[k] = INFINITY;
    for (size_t i = 0; i < m->own_count; i++) {
        const double *where = own + i * d;
        for (uint32_t k = 0; k < d; k++) {
            bounds[k] = fmin(bounds[k], where[k]);
            bounds[d + k] = fmin(bounds[d + k], -where[k]);
        }
    }
    MPI_Allreduce(bounds, all, (int)(2 * d), MPI_DOUBLE, MPI_MIN, m->comm);
    for (uint32_t k = 0; k < d; k++) side = fmax(side, -all[d + k] - all[k]);
    double cells = ldexp(1, bits_of(d));
    for (size_t i = 0; i < m->own_count; i++) {
        const double *where = own + i * d;
        uint32_t cell[3] = {0, 0, 0};
        for (uint32_t k = 0; k < d; k++) {
            double share = side > 0 ? (where[k] - all[k]) / side : 0;
            cell[k] = (uint32_t)fmin(share * cells, cells - 1);
        }
        items[i].place = curve_place(d, cell);
    }
}

static double weight_below(const item *sorted, size_t count, uint64_t place) {
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (sorted[middle].place < place)
            low = middle + 1;
        else
            high = middle;
    }
    return low ? sorted[low - 1].weight : 0;
}

// Halves the interval of each boundary until it is one place: before it is less than the weight wanted.
static void find_boundaries(deldrift_mpi *m, const item *sorted, uint64_t *low, uint64_t *high, double *mine,
                            double *all) {
    size_t count = m->own_count;
    int boundaries = m->size - 1, steps = (int)m->dimension * bits_of(m->dimension);
    double own = count ? sorted[count - 1].weight : 0, total = 0;
    MPI_Allreduce(&own, &total, 1, MPI_DOUBLE, MPI_SUM, m->comm);
    for (int b = 0; b < boundaries; b++) {
        low[b] = 0;
        high[b] = (uint64_t)1 << steps;
    }
    for (int step = 0; boundaries && step <= steps; step++) {
        for (int b = 0; b < boundaries; b++) mine[b] = weight_below(sorted, count, low[b] + (high[b] - low[b]) / 2);
        MPI_Allreduce(mine, all, boundaries, MPI_DOUBLE, MPI_SUM, m->comm);
        for (int b = 0; b < boundaries; b++) {
            uint64_t middle = low[b] + (high[b] - low[b]) / 2;
            if (all[b] < total * (b + 1) / m->size)
                low[b] = middle;
            else
                high[b] = middle;
        }
    }
}

static bool check_weights(dm_refusal *refusal, const double *weights, size_t count) {
    for (size_t i = 0; weights && i < count; i++)
        if (!(weights[i] >= 0) || isinf(weights[i]))
            dm_refuse(refusal, DELDRIFT_INVALID_VALUE, "weight %zu is %.17g", i, weights[i]);
    return refusal->status == DELDRIFT_OK;
}

deldrift_status deldrift_mpi_partition(deldrift_mpi *m, const double *weights, size_t count, int32_t *targets) {
    if (!m) return dm_no_handle();
    dm_refusal refusal = {DELDRIFT_OK, ""};
    if (count != m->own_count)
        dm_refuse(&refusal, DELDRIFT_WRONG_COUNT, "count is %zu, and there are %zu own vertices", count, m->own_count);
    else if (count && !targets)
        dm_refuse(&refusal, DELDRIFT_NULL_ARGUMENT, "targets is NULL, and count is %zu", count);
    else
        check_weights(&refusal, weights, count);
    size_t size = (size_t)m->size;
    item *items = dm_allocate(&refusal, count, sizeof *items), *sorted = dm_allocate(&refusal, count, sizeof *sorted);
    uint64_t *bounds = dm_allocate(&refusal, 2 * size, sizeof *bounds);
    double *sums = dm_allocate(&refusal, 2 * size, sizeof *sums);
    double *own = dm_allocate(&refusal, m->own_count * m->dimension, sizeof *own);
    if (own) dm_unit_places(m, &refusal, own);
    deldrift_status status = dm_decide(m->comm, &refusal, NULL).status;
    if (status == DELDRIFT_OK) {
        find_places(m, own, items);
        for (size_t i = 0; i < count; i++) items[i].weight = weights ? weights[i] : 1;
        if (count) memcpy(sorted, items, count * sizeof *items);
        qsort(sorted, count, sizeof *sorted, compare_items);
        for (size_t i = 1; i < count; i++) sorted[i].weight += sorted[i - 1].weight;
        find_boundaries(m, sorted, bounds, bounds + size, sums, sums + size);
        for (size_t i = 0; i < count; i++) {
            // Boundaries are few, and ascending.
            int low = 0, high = m->size - 1;
            while (low < high) {
                int middle = (low + high) / 2;
                if (bounds[size + (size_t)middle] <= items[i].place)
                    low = middle + 1;
                else
                    high = middle;
            }
            targets[i] = low;
        }
    }
    free(items);
    free(sorted);
    free(bounds);
    free(sums);
    free(own);
    return status;
}
