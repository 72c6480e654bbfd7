// Boxes that tell other processes where own vertices are.
#include <math.h>
#include <string.h>

#include "internal.h"

// Boxes are widened by so many of the largest displacements in the last commit, so that they need not be told anew at
// each, but by no more than this share of the spacing of vertices, as a wider box makes a larger halo.
static const double COMMITS_AHEAD = 4, MOST_ROOM = 0.02;

bool dm_is_empty_box(const dm_box *box) {
    return box->low[0] > box->high[0];
}

const dm_box *dm_boxes_now(const deldrift_mpi *m) {
    return m->has_next_boxes ? m->next_boxes : m->boxes;
}

bool dm_is_in_box(const deldrift_mpi *m, const dm_box *box, const double *point) {
    for (uint32_t k = 0; k < m->dimension; k++)
        if (point[k] < box->low[k] || point[k] > box->high[k]) return false;
    return true;
}

static void empty(dm_box *box) {
    memset(box, 0, sizeof *box);
    for (int k = 0; k < 3; k++) {
        box->low[k] = INFINITY;
        box->high[k] = -INFINITY;
    }
}

static void take_in(const deldrift_mpi *m, dm_box *box, const double *point) {
    for (uint32_t k = 0; k < m->dimension; k++) {
        if (point[k] < box->low[k]) box->low[k] = point[k];
        if (point[k] > box->high[k]) box->high[k] = point[k];
    }
}

static uint32_t longest_axis(const deldrift_mpi *m, const dm_box *box) {
    uint32_t axis = 0;
    for (uint32_t k = 1; k < m->dimension; k++)
        if (box->high[k] - box->low[k] > box->high[axis] - box->low[axis]) axis = k;
    return axis;
}

static double longest_side(const deldrift_mpi *m, const dm_box *box) {
    uint32_t axis = longest_axis(m, box);
    return dm_is_empty_box(box) ? 0 : box->high[axis] - box->low[axis];
}

double dm_boxes_extent(const deldrift_mpi *m, const dm_box *boxes) {
    double sum = 0;
    for (uint32_t b = 0; b < m->options.boxes; b++) sum += longest_side(m, &boxes[b]);
    return sum;
}

void dm_fit_boxes(deldrift_mpi *m, dm_box *boxes, const uint16_t *box_of) {
    size_t counts[DM_MAX_BOXES] = {0};
    for (uint32_t b = 0; b < m->options.boxes; b++) empty(&boxes[b]);
    for (size_t i = 0; i < m->next_count; i++) {
        take_in(m, &boxes[box_of[i]], m->points + i * m->row);
        counts[box_of[i]]++;
    }
    for (uint32_t b = 0; b < m->options.boxes; b++) {
        if (!counts[b]) continue;
        double volume = 1;
        for (uint32_t k = 0; k < m->dimension; k++) volume *= boxes[b].high[k] - boxes[b].low[k];
        boxes[b].spacing = pow(volume / (double)counts[b], 1.0 / m->dimension);
        if (!isfinite(boxes[b].spacing)) boxes[b].spacing = 0;
    }
}

// Splits the box of the longest side in its middle, until there are enough: what is far from a box gets more of them.
void dm_make_boxes(deldrift_mpi *m, dm_box *boxes, uint16_t *box_of) {
    memset(box_of, 0, m->next_count * sizeof *box_of);
    dm_fit_boxes(m, boxes, box_of);
    for (uint16_t fresh = 1; fresh < m->options.boxes; fresh++) {
        uint16_t split = 0;
        for (uint16_t b = 1; b < fresh; b++)
            if (longest_side(m, &boxes[b]) > longest_side(m, &boxes[split])) split = b;
        double side = longest_side(m, &boxes[split]);
        uint32_t axis = longest_axis(m, &boxes[split]);
        double middle = boxes[split].low[axis] + side / 2;
        if (!(side > 0) || !(middle < boxes[split].high[axis])) break;
        empty(&boxes[split]);
        empty(&boxes[fresh]);
        for (size_t i = 0; i < m->next_count; i++) {
            if (box_of[i] != split) continue;
            const double *point = m->points + i * m->row;
            if (point[axis] > middle) box_of[i] = fresh;
            take_in(m, &boxes[box_of[i]], point);
        }
    }
    dm_fit_boxes(m, boxes, box_of);
    m->extent = dm_boxes_extent(m, boxes);
}

void dm_share_boxes(deldrift_mpi *m, dm_box *own) {
    for (uint32_t b = 0; b < m->options.boxes; b++) {
        if (dm_is_empty_box(&own[b])) continue;
        double room = fmin(COMMITS_AHEAD * m->displacement, MOST_ROOM * own[b].spacing);
        for (uint32_t k = 0; k < m->dimension; k++) {
            own[b].low[k] -= room;
            own[b].high[k] += room;
        }
    }
    // dm_box is seven numbers.
    int numbers = (int)(m->options.boxes * (sizeof *own / sizeof(double)));
    MPI_Allgather(own, numbers, MPI_DOUBLE, m->next_boxes, numbers, MPI_DOUBLE, m->comm);
    m->has_next_boxes = true;
    m->report.collectives++;
}
