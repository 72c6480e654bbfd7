// Which own vertices another process may need: those of a cell, or of a facet of the hull, that a vertex in a box of
// that process could change.
#include <math.h>
#include <string.h>

#include "internal.h"

// A copy is dropped only where it would not be sent if the boxes were wider by this share of the spacing of vertices,
// so that it is not soon sent again.
static const double DROP_MARGIN = 0.1;

// Processes are asked about in groups of this number, and groups of groups, as most are far.
#ifdef DELDRIFT_MPI_TESTING
enum { GROUP = 2 }; // so that few processes have groups of groups
#else
enum { GROUP = 16 };
#endif

static bool reserve_boxes(deldrift_mpi *m, size_t boxes) {
    uint32_t d = m->dimension;
    size_t room[4] = {m->box_room, m->box_room, m->box_room, m->box_room};
    dm_refusal *r = &m->refusal;
    if (!dm_reserve(r, &m->low, &room[0], boxes, d * sizeof(double)) ||
        !dm_reserve(r, &m->high, &room[1], boxes, d * sizeof(double)) ||
        !dm_reserve(r, &m->box_ranks, &room[2], boxes, sizeof *m->box_ranks) ||
        !dm_reserve(r, &m->nodes, &room[3], boxes, sizeof *m->nodes) ||
        !dm_reserve(r, &m->offsets, &m->offset_room, boxes + 1, sizeof *m->offsets))
        return false;
    m->box_room = room[0] < room[2] ? room[0] : room[2];
    return true;
}

// A box that is asked about, widened by `margin` spacings.
static void put_box(deldrift_mpi *m, size_t at, const dm_box *box, double margin, int process) {
    for (uint32_t k = 0; k < m->dimension; k++) {
        double low = box->low[k] - margin * box->spacing, high = box->high[k] + margin * box->spacing;
        if (DM_HAS_FAULT(DM_FAULT_SMALL_REACH)) low = high = low + (high - low) / 2;
        m->low[at * m->dimension + k] = low;
        m->high[at * m->dimension + k] = high;
    }
    m->box_ranks[at] = process;
}

static void unite(const deldrift_mpi *m, dm_box *all, const dm_box *box) {
    for (uint32_t k = 0; k < m->dimension; k++) {
        all->low[k] = fmin(all->low[k], box->low[k]);
        all->high[k] = fmax(all->high[k], box->high[k]);
    }
    all->spacing = fmax(all->spacing, box->spacing);
}

// The box around those of some processes, without this one, and without those that have no copies if these are not
// wanted.
static dm_box box_of_group(const deldrift_mpi *m, int first, int width, bool of_peers) {
    dm_box all = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
    for (int process = first; process < m->size && process < first + width; process++) {
        if (process == m->rank || (of_peers && m->peer_of[process] < 0)) continue;
        const dm_box *boxes = dm_boxes_now(m) + (size_t)process * m->options.boxes;
        for (uint32_t b = 0; b < m->options.boxes; b++)
            if (!dm_is_empty_box(&boxes[b])) unite(m, &all, &boxes[b]);
    }
    return all;
}

static bool meet(const deldrift_mpi *m, const dm_box *a, const dm_box *b) {
    for (uint32_t k = 0; k < m->dimension; k++)
        if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) return false;
    return true;
}

#ifdef DELDRIFT_MPI_TESTING
// As if the half-spaces of the hull were those on the other side: cells alone.
static deldrift_status reach_without_hull(deldrift_mpi *m, size_t boxes, size_t *count) {
    uint32_t d = m->dimension;
    deldrift_cells_view view;
    deldrift_status status = deldrift_cells(m->t, &view);
    *count = 0;
    for (size_t b = 0; b < boxes && status == DELDRIFT_OK; b++) {
        size_t cells = 0;
        m->offsets[b] = *count;
        if (!dm_reserve(&m->refusal, &m->vertices, &m->vertex_room, view.count, sizeof(uint32_t)) ||
            !dm_reserve(&m->refusal, &m->found, &m->found_room, *count + view.count * (d + 1), sizeof(uint32_t)))
            return DELDRIFT_OUT_OF_MEMORY;
        status = deldrift_cells_in_reach(m->t, m->low + b * d, m->high + b * d, 1, m->is_own, m->ids, m->vertices, NULL,
                                         NULL, m->vertex_room, &cells);
        for (size_t c = 0; c < cells * (d + 1); c++) {
            uint32_t v = view.vertices[m->vertices[c / (d + 1)] * (d + 1) + c % (d + 1)];
            if (m->is_own[v]) m->found[(*count)++] = v;
        }
    }
    m->offsets[boxes] = *count;
    return status;
}
#endif

// Lists of own vertices in reach of the boxes, in `found` and `offsets`.
static bool search(deldrift_mpi *m, size_t boxes) {
    size_t count = 0;
#ifdef DELDRIFT_MPI_TESTING
    if (DM_HAS_FAULT(DM_FAULT_HALF_SPACE)) return dm_took(&m->refusal, reach_without_hull(m, boxes, &count));
#endif
    if (!m->found && !dm_reserve(&m->refusal, &m->found, &m->found_room, 1024, sizeof *m->found)) return false;
    for (;;) {
        deldrift_status status = deldrift_vertices_in_reach(m->t, m->low, m->high, boxes, m->is_own, m->ids, m->found,
                                                            m->offsets, m->found_room, &count);
        if (status != DELDRIFT_BUFFER_TOO_SMALL) return dm_took(&m->refusal, status);
        if (!dm_reserve(&m->refusal, &m->found, &m->found_room, count, sizeof *m->found)) return false;
    }
}

// Groups become the groups, or processes, in them. There is room for as many as there are processes.
static size_t expand(deldrift_mpi *m, size_t groups, int width) {
    size_t count = 0;
    memcpy(m->box_ranks, m->nodes, groups * sizeof *m->nodes);
    for (size_t n = 0; n < groups; n++)
        for (int first = m->box_ranks[n], c = 0; c < GROUP && first + c * width < m->size; c++)
            m->nodes[count++] = first + c * width;
    return count;
}

// The processes of which something may be in reach, in nodes: all but those of groups that are certainly far. What
// meets the box of this process is not asked about, as the answer would be long.
static bool find_near(deldrift_mpi *m, bool of_peers, double margin, size_t *count) {
    int width = 1;
    if (!reserve_boxes(m, (size_t)m->size * m->options.boxes)) return false;
    while (width * GROUP < m->size) width *= GROUP;
    dm_box own = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
    for (uint32_t b = 0; b < m->options.boxes; b++) {
        const dm_box *box = &dm_boxes_now(m)[(size_t)m->rank * m->options.boxes + b];
        if (!dm_is_empty_box(box)) unite(m, &own, box);
    }
    *count = 0;
    for (int first = 0; first < m->size; first += width) m->nodes[(*count)++] = first;
    for (;; width /= GROUP) {
        size_t asked = 0, kept = 0;
        for (size_t n = 0; n < *count; n++) {
            dm_box box = box_of_group(m, m->nodes[n], width, of_peers);
            if (dm_is_empty_box(&box)) continue;
            if (meet(m, &own, &box))
                m->nodes[kept++] = m->nodes[n];
            else
                put_box(m, asked++, &box, margin, m->nodes[n]);
        }
        if (asked && !search(m, asked)) return false;
        for (size_t b = 0; b < asked; b++)
            if (m->offsets[b + 1] > m->offsets[b]) m->nodes[kept++] = m->box_ranks[b];
        *count = kept;
        if (width == 1) return true;
        *count = expand(m, kept, width / GROUP);
    }
}

// Lists of own vertices in reach of other processes' boxes, widened by `margin` spacings; the lists of one process's
// follow each other.
static bool search_processes(deldrift_mpi *m, bool of_peers, double margin, size_t *boxes) {
    size_t near = 0;
    *boxes = 0;
    if (!find_near(m, of_peers, margin, &near)) return false;
    for (size_t n = 0; n < near; n++) {
        const dm_box *each = dm_boxes_now(m) + (size_t)m->nodes[n] * m->options.boxes;
        for (uint32_t b = 0; b < m->options.boxes; b++)
            if (!dm_is_empty_box(&each[b])) put_box(m, (*boxes)++, &each[b], margin, m->nodes[n]);
    }
    return !*boxes || search(m, *boxes);
}

static uint32_t fresh_stamp(deldrift_mpi *m) {
    if (++m->stamped == 0) {
        memset(m->stamp, 0, m->ids * sizeof *m->stamp);
        m->stamped = 1;
    }
    return m->stamped;
}

size_t dm_find_sends(deldrift_mpi *m) {
    size_t boxes, sends = 0;
    if (!search_processes(m, false, 0, &boxes)) return 0;
    for (size_t b = 0; b < boxes;) {
        int rank = m->box_ranks[b];
        size_t first = m->offsets[b];
        while (b < boxes && m->box_ranks[b] == rank) b++;
        size_t end = m->offsets[b];
        if (first == end) continue;
        dm_peer *peer = dm_peer_of(m, rank);
        if (!peer) return 0;
        dm_list *sent = &peer->sent;
        if (!dm_reserve_list(&m->refusal, sent, sent->count + (end - first))) return 0;
        uint32_t stamp = fresh_stamp(m);
        for (size_t k = 0; k < sent->count; k++)
            if (!sent->is_leaving[k]) m->stamp[sent->at[k]] = stamp;
        for (size_t i = first; i < end; i++) {
            uint32_t v = m->found[i];
            if (m->stamp[v] == stamp) continue;
            m->stamp[v] = stamp;
            sent->is_leaving[sent->count] = 0;
            sent->at[sent->count++] = v;
            sends++;
        }
    }
    return sends;
}

bool dm_find_drops(deldrift_mpi *m) {
    size_t cells = 0, boxes;
    // Without cells nothing is known of what is needed.
    if (!dm_took(&m->refusal, deldrift_cell_count(m->t, &cells))) return false;
    if (!cells) return true;
    if (!search_processes(m, true, DROP_MARGIN, &boxes)) return false;
    for (size_t p = 0; p < m->peer_count; p++) {
        dm_list *sent = &m->peers[p].sent;
        uint32_t stamp = fresh_stamp(m);
        for (size_t b = 0; b < boxes; b++) {
            if (m->box_ranks[b] != m->peers[p].rank) continue;
            for (size_t i = m->offsets[b]; i < m->offsets[b + 1]; i++) m->stamp[m->found[i]] = stamp;
        }
        for (size_t k = 0; k < sent->count; k++) sent->is_leaving[k] = m->stamp[sent->at[k]] != stamp;
    }
    return true;
}
