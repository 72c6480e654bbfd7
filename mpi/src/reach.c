// Which own vertices another process may need: those of a cell, or of a facet of the hull, that a vertex in a box of
// that process could change.
#include <math.h>
#include <string.h>

#include "internal.h"

// A copy is dropped only where it would not be sent if the boxes were wider by this share of the spacing of vertices,
// so that it is not soon sent again.
static const double DROP_MARGIN = 0.1;

// Copies up to so many mean distances of vertices from the boxes of a process are there from the beginning: no vertex
// then has a cell without an end, whose half-space meets the boxes of nearly all periods.
static const double SEED_MARGIN = 1.5;

// In a periodic box own vertices are supposed to be in reach of nothing that is so many spacings away from all.
static const double EXTENT_MARGIN = 8;

// Processes are asked about in groups of this number, and groups of groups, as most are far.
#ifdef DELDRIFT_MPI_TESTING
enum { GROUP = 2 }; // so that few processes have groups of groups
#else
enum { GROUP = 16 };
#endif

static bool reserve_boxes(deldrift_mpi *m, size_t boxes) {
    uint32_t d = m->dimension;
    size_t room[5] = {m->box_room, m->box_room, m->box_room, m->box_room, m->box_room};
    dm_refusal *r = &m->refusal;
    if (!dm_reserve(r, &m->low, &room[0], boxes, d * sizeof(double)) ||
        !dm_reserve(r, &m->high, &room[1], boxes, d * sizeof(double)) ||
        !dm_reserve(r, &m->box_ranks, &room[2], boxes, sizeof *m->box_ranks) ||
        !dm_reserve(r, &m->nodes, &room[3], boxes, sizeof *m->nodes) ||
        !dm_reserve(r, &m->box_periods, &room[4], boxes, sizeof *m->box_periods) ||
        !dm_reserve(r, &m->offsets, &m->offset_room, boxes + 1, sizeof *m->offsets))
        return false;
    m->box_room = room[0] < room[2] ? room[0] : room[2];
    return true;
}

// A box that is asked about: what is in reach of it goes to the process, by that translation.
static void put_box(deldrift_mpi *m, size_t at, const dm_box *box, int process, uint32_t period) {
    for (uint32_t k = 0; k < m->dimension; k++) {
        m->low[at * m->dimension + k] = box->low[k];
        m->high[at * m->dimension + k] = box->high[k];
    }
    m->box_ranks[at] = process;
    m->box_periods[at] = period;
}

// A box, wider by `margin` spacings.
static dm_box widened(const deldrift_mpi *m, const dm_box *box, double margin) {
    dm_box wider = *box;
    for (uint32_t k = 0; k < m->dimension; k++) {
        wider.low[k] -= margin * box->spacing;
        wider.high[k] += margin * box->spacing;
        if (DM_HAS_FAULT(DM_FAULT_SMALL_REACH))
            wider.low[k] = wider.high[k] = wider.low[k] + (wider.high[k] - wider.low[k]) / 2;
    }
    return wider;
}

static void unite(const deldrift_mpi *m, dm_box *all, const dm_box *box) {
    for (uint32_t k = 0; k < m->dimension; k++) {
        all->low[k] = fmin(all->low[k], box->low[k]);
        all->high[k] = fmax(all->high[k], box->high[k]);
    }
    all->spacing = fmax(all->spacing, box->spacing);
}

static dm_box no_box(void) {
    return (dm_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
}

static dm_box everywhere(void) {
    return (dm_box){{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}, 0};
}

static void unite_boxes_of(const deldrift_mpi *m, dm_box *all, int process) {
    const dm_box *boxes = dm_boxes_now(m) + (size_t)process * m->options.boxes;
    for (uint32_t b = 0; b < m->options.boxes; b++)
        if (!dm_is_empty_box(&boxes[b])) unite(m, all, &boxes[b]);
}

// Whether a process has a copy of each own vertex by a translation, so that nothing is left to be sent: so it is with
// points on a sphere or a line, of which each cell is in reach of all boxes.
static bool has_all(const deldrift_mpi *m, int process, uint32_t period) {
    if (m->peer_of[process] < 0) return false;
    const dm_list *sent = &m->peers[m->peer_of[process]].sent;
    size_t staying = 0;
    for (size_t k = 0; sent->count >= m->next_count && k < sent->count; k++)
        staying += sent->period[k] == period && !sent->is_leaving[k];
    return staying >= m->next_count;
}

// The box around those of some processes that are asked about: other ones, and only those that have copies, or only
// those that have not all.
static dm_box box_of_group(const deldrift_mpi *m, int first, int width, bool of_peers) {
    dm_box all = no_box();
    for (int process = first; process < m->size && process < first + width; process++)
        if (process != m->rank && !(of_peers ? m->peer_of[process] < 0 : has_all(m, process, 0)))
            unite_boxes_of(m, &all, process);
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
    DM_COUNT_ASKED(boxes);
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
    dm_box own = no_box();
    unite_boxes_of(m, &own, m->rank);
    *count = 0;
    for (int first = 0; first < m->size; first += width) m->nodes[(*count)++] = first;
    for (;; width /= GROUP) {
        size_t asked = 0, kept = 0;
        for (size_t n = 0; n < *count; n++) {
            dm_box box = box_of_group(m, m->nodes[n], width, of_peers);
            if (dm_is_empty_box(&box)) continue;
            dm_box wider = widened(m, &box, margin);
            if (meet(m, &own, &box))
                m->nodes[kept++] = m->nodes[n];
            else
                put_box(m, asked++, &wider, m->nodes[n], 0);
        }
        if (asked && !search(m, asked)) return false;
        for (size_t b = 0; b < asked; b++)
            if (m->offsets[b + 1] > m->offsets[b]) m->nodes[kept++] = m->box_ranks[b];
        *count = kept;
        if (width == 1) return true;
        *count = expand(m, kept, width / GROUP);
    }
}

// Outside of this box nothing own is in reach of anything. It is one around own vertices, wider by a few spacings, and
// infinite on a side where that does not suffice. What is told of a half-space holds for all boxes in it.
static bool find_extent(deldrift_mpi *m, dm_box *extent) {
    uint32_t d = m->dimension;
    dm_box own = no_box();
    if (!reserve_boxes(m, 2 * d)) return false;
    unite_boxes_of(m, &own, m->rank);
    for (uint32_t k = 0; k < d; k++) {
        own.low[k] -= EXTENT_MARGIN * own.spacing;
        own.high[k] += EXTENT_MARGIN * own.spacing;
    }
    for (uint32_t side = 0; side < 2 * d; side++) {
        dm_box half = everywhere();
        if (side % 2)
            half.low[side / 2] = own.high[side / 2];
        else
            half.high[side / 2] = own.low[side / 2];
        put_box(m, side, &half, 0, 0);
    }
    if (!search(m, 2 * d)) return false;
    *extent = everywhere();
    for (uint32_t side = 0; side < 2 * d; side++) {
        if (m->offsets[side + 1] > m->offsets[side]) continue;
        if (side % 2)
            extent->high[side / 2] = own.high[side / 2];
        else
            extent->low[side / 2] = own.low[side / 2];
    }
    return true;
}

static dm_box translated(const deldrift_mpi *m, const dm_box *box, uint32_t period) {
    dm_box there = *box;
    dm_translate(m, there.low, box->low, period);
    dm_translate(m, there.high, box->high, period);
    return there;
}

// Whether what a process has in a period, in the box `all`, is asked about: it is not what is own, meets the extent,
// wider by `margin` spacings, and, unless it is asked what peers still need, something is left to be sent. A rounded
// translation of a box has the translations of all that is in it, as these are not rounded.
static bool may_reach(const deldrift_mpi *m, const dm_box *extent, int process, const dm_box *all, uint32_t period,
                      bool of_peers, double margin, dm_box *wider) {
    dm_box there = translated(m, all, period);
    if (DM_HAS_FAULT(DM_FAULT_NO_PERIOD) && period == m->lattice.unit[0]) return false;
    *wider = widened(m, &there, margin);
    return (process != m->rank || period) && meet(m, extent, wider) &&
           (of_peers || !has_all(m, process, dm_opposite(period)));
}

// The box of a process, which is empty where nothing is asked about it.
static dm_box box_of(const deldrift_mpi *m, int process, bool of_peers) {
    dm_box all = no_box();
    if (!of_peers || m->peer_of[process] >= 0) unite_boxes_of(m, &all, process);
    return all;
}

// Asks about all that a process has in a period, in one box, if it is farther from own vertices than these are from each
// other: in nodes, in the order of put_periods, whether something own is in reach. Of points on a line most periods are
// far, and no half-space tells.
static bool ask_far(deldrift_mpi *m, const dm_box *extent, const dm_box *near, bool of_peers, double margin) {
    size_t asked = 0;
    for (int process = 0; process < m->size; process++) {
        dm_box all = box_of(m, process, of_peers), wider;
        if (dm_is_empty_box(&all)) continue;
        if (!reserve_boxes(m, asked + m->lattice.count)) return false;
        for (uint32_t period = 0; period < m->lattice.count; period++)
            if (may_reach(m, extent, process, &all, period, of_peers, margin, &wider) && !meet(m, near, &wider))
                put_box(m, asked++, &wider, process, dm_opposite(period));
    }
    if (asked && !search(m, asked)) return false;
    for (size_t b = 0; b < asked; b++) m->nodes[b] = m->offsets[b + 1] > m->offsets[b];
    return true;
}

// The boxes of all processes in all periods that meet this one, wider by `margin` spacings; without those that ask_far
// has found to be out of reach, if there is a box near which it has not asked.
static bool put_periods(deldrift_mpi *m, const dm_box *extent, const dm_box *near, bool of_peers, double margin,
                        size_t *boxes) {
    size_t far = 0;
    *boxes = 0;
    for (int process = 0; process < m->size; process++) {
        dm_box all = box_of(m, process, of_peers), wider;
        if (dm_is_empty_box(&all)) continue;
        for (uint32_t period = 0; period < m->lattice.count; period++) {
            if (!may_reach(m, extent, process, &all, period, of_peers, margin, &wider)) continue;
            if (near && !meet(m, near, &wider) && !m->nodes[far++]) continue;
            const dm_box *each = dm_boxes_now(m) + (size_t)process * m->options.boxes;
            if (!reserve_boxes(m, *boxes + m->options.boxes)) return false;
            for (uint32_t b = 0; b < m->options.boxes; b++) {
                if (dm_is_empty_box(&each[b])) continue;
                dm_box there = translated(m, &each[b], period);
                wider = widened(m, &there, margin);
                if (meet(m, extent, &wider)) put_box(m, (*boxes)++, &wider, process, dm_opposite(period));
            }
        }
    }
    return true;
}

// Lists of own vertices in reach of other processes' boxes, and of all in other periods, widened by `margin` spacings;
// the lists of one process's in one period follow each other.
static bool search_processes(deldrift_mpi *m, bool of_peers, double margin, size_t *boxes) {
    size_t near = 0;
    *boxes = 0;
    if (m->lattice.rank) {
        dm_box extent, own = no_box();
        unite_boxes_of(m, &own, m->rank);
        dm_box beside = widened(m, &own, 1);
        if (!find_extent(m, &extent) || !ask_far(m, &extent, &beside, of_peers, margin) ||
            !put_periods(m, &extent, &beside, of_peers, margin, boxes))
            return false;
        return !*boxes || search(m, *boxes);
    }
    if (!find_near(m, of_peers, margin, &near)) return false;
    for (size_t n = 0; n < near; n++) {
        const dm_box *each = dm_boxes_now(m) + (size_t)m->nodes[n] * m->options.boxes;
        for (uint32_t b = 0; b < m->options.boxes; b++) {
            dm_box wider = widened(m, &each[b], margin);
            if (!dm_is_empty_box(&each[b])) put_box(m, (*boxes)++, &wider, m->nodes[n], 0);
        }
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

// The boxes of one process in one period: those from `first` on, before `end`.
typedef struct {
    size_t first, end;
    int rank;
    uint32_t period;
} group;

static group group_from(const deldrift_mpi *m, size_t first, size_t boxes) {
    group g = {first, first, m->box_ranks[first], m->box_periods[first]};
    while (g.end < boxes && m->box_ranks[g.end] == g.rank && m->box_periods[g.end] == g.period) g.end++;
    return g;
}

// Makes room in the list of a process for so many more. NULL, and a refusal, where there is no memory.
static dm_list *list_for(deldrift_mpi *m, int rank, size_t more) {
    dm_peer *peer = dm_peer_of(m, rank);
    return peer && dm_reserve_list(&m->refusal, &peer->sent, peer->sent.count + more) ? &peer->sent : NULL;
}

// What the list has in this period gets a stamp, which is told.
static uint32_t stamp_sent(deldrift_mpi *m, const dm_list *sent, uint32_t period) {
    uint32_t stamp = fresh_stamp(m);
    for (size_t k = 0; k < sent->count; k++)
        if (sent->period[k] == period && !sent->is_leaving[k]) m->stamp[sent->at[k]] = stamp;
    return stamp;
}

// Enters a vertex into a list that has room, unless it has the stamp.
static bool send(deldrift_mpi *m, dm_list *sent, uint32_t vertex, uint32_t period, uint32_t stamp) {
    if (m->stamp[vertex] == stamp) return false;
    m->stamp[vertex] = stamp;
    sent->is_leaving[sent->count] = 0;
    sent->period[sent->count] = period;
    sent->at[sent->count++] = vertex;
    return true;
}

size_t dm_find_sends(deldrift_mpi *m) {
    size_t boxes, sends = 0;
    if (!search_processes(m, false, 0, &boxes)) return 0;
    for (size_t b = 0; b < boxes;) {
        group g = group_from(m, b, boxes);
        size_t first = m->offsets[g.first], end = m->offsets[g.end];
        b = g.end;
        if (first == end) continue;
        dm_list *sent = list_for(m, g.rank, end - first);
        if (!sent) return 0;
        uint32_t stamp = stamp_sent(m, sent, g.period);
        for (size_t i = first; i < end; i++) sends += send(m, sent, m->found[i], g.period, stamp);
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
        if (sent->count) memset(sent->is_leaving, 1, sent->count);
    }
    for (size_t b = 0; b < boxes;) {
        group g = group_from(m, b, boxes);
        b = g.end;
        if (m->peer_of[g.rank] < 0) continue;
        dm_list *sent = &m->peers[m->peer_of[g.rank]].sent;
        uint32_t stamp = fresh_stamp(m);
        for (size_t i = m->offsets[g.first]; i < m->offsets[g.end]; i++) m->stamp[m->found[i]] = stamp;
        for (size_t k = 0; k < sent->count; k++)
            if (sent->period[k] == g.period && m->stamp[sent->at[k]] == stamp) sent->is_leaving[k] = 0;
    }
    return true;
}

// The mean distance of the vertices of all processes, roughly. Along directions that are open, the box of all counts.
static double mean_distance(const deldrift_mpi *m) {
    uint64_t mine = m->next_count, total = 0;
    MPI_Allreduce(&mine, &total, 1, MPI_UINT64_T, MPI_SUM, m->comm);
    dm_box all = no_box();
    for (int process = 0; process < m->size; process++) unite_boxes_of(m, &all, process);
    double measure = m->lattice.measure, diagonal = 0;
    for (uint32_t k = 0; k < m->dimension && total; k++) diagonal = hypot(diagonal, all.high[k] - all.low[k]);
    if (diagonal > 0) measure *= pow(diagonal, (double)(m->dimension - m->lattice.rank));
    return total ? pow(measure / (double)total, 1.0 / m->dimension) : 0;
}

void dm_seed(deldrift_mpi *m) {
    size_t boxes;
    dm_box own = no_box();
    double width = SEED_MARGIN * mean_distance(m);
    m->report.collectives++;
    if (m->refusal.status != DELDRIFT_OK || !m->next_count) return;
    unite_boxes_of(m, &own, m->rank);
    for (uint32_t k = 0; k < m->dimension; k++) {
        own.low[k] -= width;
        own.high[k] += width;
    }
    if (!put_periods(m, &own, NULL, false, 0, &boxes)) return;
    for (size_t b = 0; b < boxes;) {
        group g = group_from(m, b, boxes);
        dm_list *sent = list_for(m, g.rank, m->next_count);
        if (!sent) return;
        uint32_t stamp = stamp_sent(m, sent, g.period);
        for (; b < g.end; b++) {
            dm_box near = no_box();
            for (uint32_t k = 0; k < m->dimension; k++) {
                near.low[k] = m->low[b * m->dimension + k] - width;
                near.high[k] = m->high[b * m->dimension + k] + width;
            }
            for (size_t i = 0; i < m->next_count; i++)
                if (dm_is_in_box(m, &near, m->points + i * m->row))
                    send(m, sent, m->next_own[i], g.period, stamp);
        }
    }
}
