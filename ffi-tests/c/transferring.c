// Means in cells are brought over as vertices move, come and go: their sum stays, and so does a constant.
#include "check.h"

enum { ROOM = 4000, SIDE = 6 };

static uint64_t state = 7;

static double unit(void) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

static double positions[3 * ROOM], volumes[ROOM], values[2 * ROOM];

static double content(const deldrift_triangulation *t, size_t component) {
    size_t count;
    OK(deldrift_volumes(t, volumes, ROOM, &count));
    double sum = 0;
    for (size_t c = 0; c < count; c++) sum += volumes[c] * values[2 * c + component];
    return sum;
}

static bool is_near(double x, double y) { return x - y < 1e-12 && y - x < 1e-12; }

// A lattice whose sides stay.
static size_t lattice(uint32_t dimension) {
    size_t n = 1;
    for (uint32_t k = 0; k < dimension; k++) n *= SIDE;
    for (size_t v = 0; v < n; v++) {
        size_t rest = v;
        for (uint32_t k = 0; k < dimension; k++, rest /= SIDE) positions[v * dimension + k] = (double)(rest % SIDE);
    }
    return n;
}

static bool is_inside(const double *p, uint32_t dimension) {
    bool is = true;
    for (uint32_t k = 0; k < dimension; k++) is = is && p[k] > 0.5 && p[k] < SIDE - 1.5;
    return is;
}

static void live(uint32_t dimension, deldrift_transfer_order order) {
    deldrift_triangulation *t;
    deldrift_changes changes;
    size_t n = lattice(dimension);
    OK(deldrift_create(dimension, positions, n, NULL, &t));
    size_t n_cells, n_before = 0;
    double lost[2], gained[2];
    deldrift_transfer_report report;
    // Nothing has been taken.
    CHECK_STATUS(deldrift_transfer_cells(t, NULL, 0, order, values, 0, 2, ROOM, NULL, NULL, NULL),
                 DELDRIFT_CHANGES_NOT_TAKEN);
    OK(deldrift_take_changes(t, &changes));
    // There were no cells.
    OK(deldrift_cell_count(t, &n_cells));
    OK(deldrift_transfer_cells(t, NULL, 0, order, values, 0, 2, ROOM, &report, lost, gained));
    CHECK(report.uncovered == n_cells && report.gone == 0 && values[0] == 0);
    for (size_t c = 0; c < n_cells; c++) values[2 * c] = 0.1, values[2 * c + 1] = unit();
    for (int step = 0; step < 30; step++) {
        for (size_t v = 0; v < n; v++) {
            double *p = positions + v * dimension;
            if (!is_inside(p, dimension)) continue;
            for (uint32_t k = 0; k < dimension; k++) p[k] += 0.2 * (unit() - 0.5);
        }
        OK(deldrift_cell_count(t, &n_before));
        OK(deldrift_commit_positions(t, positions, n, NULL));
        bool removes = step % 3 == 0;
        if (removes) {
            uint32_t v;
            bool present;
            do {
                v = (uint32_t)(unit() * (double)n);
                OK(deldrift_is_present(t, v, &present));
            } while (!present || !is_inside(positions + v * dimension, dimension));
            OK(deldrift_remove_vertex(t, v));
            uint32_t id;
            double place[3] = {1 + 3 * unit(), 1 + 3 * unit(), 1 + 3 * unit()};
            OK(deldrift_insert_vertex(t, place, &id));
            CHECK_STATUS(deldrift_transfer_cells(t, NULL, 0, order, values, n_before, 2, ROOM, NULL, NULL, NULL),
                         DELDRIFT_CHANGES_NOT_TAKEN);
        }
        OK(deldrift_take_changes(t, &changes));
        size_t count = 0;
        OK(deldrift_cell_count(t, &count));
        CHECK_STATUS(deldrift_transfer_cells(t, NULL, 0, order, values, n_before + 1, 2, ROOM, NULL, NULL, NULL),
                     DELDRIFT_WRONG_COUNT);
        CHECK_STATUS(deldrift_transfer_cells(t, NULL, 0, order, values, n_before, 2, count - 1, NULL, NULL, NULL),
                     DELDRIFT_BUFFER_TOO_SMALL);
        if (removes) {
            CHECK_STATUS(deldrift_transfer_cells(t, NULL, 0, order, values, n_before, 2, ROOM, NULL, NULL, NULL),
                         DELDRIFT_REMOVED_VERTEX);
            CHECK_STATUS(deldrift_transfer_cells(t, positions, 1, order, values, n_before, 2, ROOM, NULL, NULL, NULL),
                         DELDRIFT_NO_SUCH_VERTEX);
        }
        OK(deldrift_transfer_cells(t, positions, n, order, values, n_before, 2, ROOM, &report, lost, gained));
        for (size_t c = 0; c < count; c++) CHECK(values[2 * c] == 0.1);
        double side = SIDE - 1, whole = dimension == 2 ? side * side : side * side * side;
        CHECK(is_near(content(t, 0), 0.1 * whole));
        CHECK(is_near(report.lost_volume, 0) && is_near(report.gained_volume, 0));
        OK(deldrift_copy_positions(t, positions, ROOM, &n));
    }
    deldrift_destroy(t);
}

// A mean that is no number is told, and nothing is written.
static void refusals(void) {
    const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    deldrift_triangulation *t;
    deldrift_changes changes;
    OK(deldrift_create(2, square, 4, NULL, &t));
    OK(deldrift_take_changes(t, &changes));
    OK(deldrift_insert_vertex(t, (const double[]){0.5, 0.4}, &(uint32_t){0}));
    OK(deldrift_take_changes(t, &changes));
    double means[8] = {1, NAN};
    CHECK_STATUS(deldrift_transfer_cells(t, NULL, 0, DELDRIFT_TRANSFER_FIRST_ORDER, means, 2, 1, 8, NULL, NULL, NULL),
                 DELDRIFT_INVALID_VALUE);
    CHECK(means[0] == 1 && means[1] != means[1] && means[2] == 0);
    means[1] = 3;
    deldrift_triangulation *copy;
    OK(deldrift_clone(t, &copy));
    const deldrift_transfer_order order = DELDRIFT_TRANSFER_FIRST_ORDER;
    CHECK_STATUS(deldrift_transfer_cells(copy, NULL, 0, order, means, 2, 1, 8, NULL, NULL, NULL),
                 DELDRIFT_CHANGES_NOT_TAKEN);
    deldrift_destroy(copy);
    OK(deldrift_transfer_cells(t, NULL, 0, DELDRIFT_TRANSFER_FIRST_ORDER, means, 2, 1, 8, NULL, NULL, NULL));
    for (int c = 0; c < 4; c++) CHECK(means[c] >= 1 && means[c] <= 3);
    OK(deldrift_compact(t, NULL, 0, &(size_t){0}));
    CHECK_STATUS(deldrift_transfer_cells(t, NULL, 0, DELDRIFT_TRANSFER_FIRST_ORDER, means, 4, 1, 8, NULL, NULL, NULL),
                 DELDRIFT_CHANGES_NOT_TAKEN);
    deldrift_destroy(t);
}

int main(void) {
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        live(dimension, DELDRIFT_TRANSFER_FIRST_ORDER);
        live(dimension, DELDRIFT_TRANSFER_SECOND_ORDER);
    }
    refusals();
    return 0;
}
