// Other vectors of a periodic box, near those in force: vertices and copies move, and each copy stays one of its
// vertex, in the period by the other vectors that is nearest to where it was. That is a sum of the nearest ones of the
// single vectors: copies of one vertex remain at different places, and those that its owner and another process know of
// have the same periods on both. What more the other box needs, rounds bring.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

// The multiples of each vector are within so much of a whole number. So all processes find the same ones, whatever
// their rounding, or one finds that there are none.
static const double NEAR = 0.25;

static double dot(const double *a, const double *b, uint32_t d) {
    double sum = 0;
    for (uint32_t k = 0; k < d; k++) sum += a[k] * b[k];
    return sum;
}

static double determinant(double rows[3][3]) {
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += rows[0][i] * (rows[1][j] * rows[2][k] - rows[1][k] * rows[2][j]);
    }
    return sum;
}

static const double *reduced(const dm_lattice *lattice, uint32_t d, uint32_t j) {
    return lattice->ways + (size_t)lattice->unit[j] * d;
}

// The multiples of the other reduced vectors whose sum is nearest to one that is in force, roughly.
static bool find_multiples(const dm_lattice *other, uint32_t d, const double *vector, int64_t multiples[3]) {
    double products[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, with[3] = {0, 0, 0};
    for (uint32_t i = 0; i < other->rank; i++) {
        with[i] = dot(reduced(other, d, i), vector, d);
        for (uint32_t j = 0; j < other->rank; j++)
            products[i][j] = dot(reduced(other, d, i), reduced(other, d, j), d);
    }
    double whole = determinant(products);
    for (uint32_t j = 0; j < 3; j++) {
        double replaced[3][3];
        memcpy(replaced, products, sizeof replaced);
        for (uint32_t i = 0; i < 3; i++) replaced[i][j] = with[i];
        double x = determinant(replaced) / whole, nearest = nearbyint(x);
        // Also false for what is no number.
        if (!(fabs(x - nearest) <= NEAR && fabs(nearest) <= 1000)) return false;
        multiples[j] = (int64_t)nearest;
    }
    return true;
}

static bool find_relation(const dm_lattice *lattice, const dm_lattice *other, uint32_t d, int64_t rows[3][3]) {
    double as_numbers[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (uint32_t j = 0; j < lattice->rank; j++) {
        if (!find_multiples(other, d, reduced(lattice, d, j), rows[j])) return false;
        for (uint32_t k = 0; k < 3; k++) as_numbers[j][k] = (double)rows[j][k];
    }
    // Each sum of the other vectors has to be one of these: the products are exact.
    return fabs(determinant(as_numbers)) == 1;
}

static void fill(const dm_lattice *lattice, int64_t rows[3][3], dm_strain *strain) {
    memset(strain->back, 0xff, strain->lattice.count * sizeof *strain->back);
    memset(strain->forth, 0xff, lattice->count * sizeof *strain->forth);
    int64_t most[3], n[3];
    for (uint32_t j = 0; j < 3; j++) most[j] = (int64_t)lattice->greatest[j];
    for (n[0] = -most[0]; n[0] <= most[0]; n[0]++) {
        for (n[1] = -most[1]; n[1] <= most[1]; n[1]++) {
            for (n[2] = -most[2]; n[2] <= most[2]; n[2]++) {
                int64_t sums[3];
                for (uint32_t k = 0; k < 3; k++) sums[k] = n[0] * rows[0][k] + n[1] * rows[1][k] + n[2] * rows[2][k];
                uint32_t before = dm_period_of(lattice, n), after = dm_period_of(&strain->lattice, sums);
                strain->forth[before] = after;
                if (after != DELDRIFT_NONE) strain->back[after] = before;
            }
        }
    }
}

bool dm_make_strain(dm_refusal *refusal, const deldrift_mpi *m, const double *vectors, dm_strain *strain) {
    int64_t rows[3][3] = {{0}};
    memset(strain, 0, sizeof *strain);
    if (!dm_make_lattice(refusal, &strain->lattice, m->dimension, vectors, m->lattice.rank)) return false;
    if (!find_relation(&m->lattice, &strain->lattice, m->dimension, rows)) return true;
    strain->forth = dm_allocate(refusal, m->lattice.count, sizeof *strain->forth);
    strain->back = dm_allocate(refusal, strain->lattice.count, sizeof *strain->back);
    if (refusal->status != DELDRIFT_OK) return false;
    fill(&m->lattice, rows, strain);
    return true;
}

void dm_free_strain(dm_strain *strain) {
    dm_free_lattice(&strain->lattice);
    free(strain->forth);
    free(strain->back);
}

static bool has_periods(const dm_list *list, const uint32_t *table) {
    for (size_t k = 0; k < list->count; k++)
        if (table[list->period[k]] == DELDRIFT_NONE) return false;
    return true;
}

bool dm_can_strain(const deldrift_mpi *m, const dm_strain *strain) {
    bool can = strain->forth != NULL;
    for (size_t p = 0; can && p < m->peer_count; p++)
        can = has_periods(&m->peers[p].sent, strain->forth) && has_periods(&m->peers[p].received, strain->forth);
    return can;
}

static void rename_periods(dm_list *list, const uint32_t *table) {
    for (size_t k = 0; k < list->count; k++) list->period[k] = table[list->period[k]];
}

static void exchange_lattices(deldrift_mpi *m, dm_strain *strain, const uint32_t *table) {
    dm_lattice kept = m->lattice;
    m->lattice = strain->lattice;
    strain->lattice = kept;
    for (size_t p = 0; p < m->peer_count; p++) {
        rename_periods(&m->peers[p].sent, table);
        rename_periods(&m->peers[p].received, table);
    }
    for (size_t v = 0; v < m->ids; v++) m->period_of[v] = m->owner_of[v] < 0 ? 0 : table[m->period_of[v]];
}

void dm_strain_copies(deldrift_mpi *m, dm_strain *strain) {
    exchange_lattices(m, strain, strain->forth);
}

void dm_unstrain_copies(deldrift_mpi *m, dm_strain *strain) {
    exchange_lattices(m, strain, strain->back);
}
