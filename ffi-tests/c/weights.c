// Weights: every state is the regular triangulation of its vertices, by the definition in exact signs and by a fresh build, with who is
// hidden by what, counts and lists of changes; by every algorithm, with all calls that change a triangulation.
#include "state.h"

enum { MOST = 120 };

typedef struct {
    uint32_t dimension;
    size_t n_ids;
    bool present[MOST];
    double positions[MOST * 3], weights[MOST];
} model;

// Who is hidden: by place, with who represents it, or by weight.
typedef struct {
    size_t by_place, by_weight;
    bool is_hidden[MOST];
} hidden;

static bool is_at(const model *m, uint32_t v, uint32_t w) {
    const size_t d = m->dimension;
    return memcmp(m->positions + v * d, m->positions + w * d, d * sizeof(double)) == 0;
}

// Of those at the place of a vertex that of the greatest weight, then of the lowest id.
static uint32_t representative_of(const model *m, uint32_t v) {
    uint32_t best = v;
    for (uint32_t w = 0; w < m->n_ids; w++) {
        if (!m->present[w] || !is_at(m, v, w)) continue;
        if (m->weights[w] > m->weights[best] || (m->weights[w] == m->weights[best] && w < best)) best = w;
    }
    return best;
}

// On which side of the power sphere of a cell a vertex is: 1 if the cell would go if it came.
static int side_of(const model *m, const uint32_t *row, uint32_t v) {
    double points[5 * 3], weights[5];
    const uint32_t d = m->dimension;
    for (uint32_t i = 0; i <= d + 1; i++) {
        const uint32_t w = i <= d ? row[i] : v;
        memcpy(points + i * d, m->positions + w * d, d * sizeof(double));
        weights[i] = m->weights[w];
    }
    int32_t sign = 0;
    OK(deldrift_in_power_sphere(d, points, weights, &sign));
    return sign;
}

// What a triangulation says of who is hidden, which has to agree with itself and with the definition.
static hidden check_hidden(const deldrift_triangulation *t, const model *m, const deldrift_cells_view *view) {
    uint32_t vertices[MOST], representatives[MOST], cells[MOST];
    hidden h = {0};
    OK(deldrift_hidden_vertices(t, vertices, representatives, MOST, &h.by_place));
    for (size_t k = 0; k < h.by_place; k++) {
        CHECK(k == 0 || vertices[k - 1] < vertices[k]);
        h.is_hidden[vertices[k]] = true;
        CHECK(representatives[k] != vertices[k] && representatives[k] == representative_of(m, vertices[k]));
    }
    size_t n_shared = 0;
    for (uint32_t v = 0; v < m->n_ids; v++) {
        if (!m->present[v]) continue;
        uint32_t representative;
        OK(deldrift_coincident_representative(t, v, &representative));
        CHECK(representative == representative_of(m, v));
        n_shared += representative != v;
    }
    CHECK(n_shared == h.by_place);
    OK(deldrift_hidden_by_weight(t, vertices, cells, MOST, &h.by_weight));
    const uint32_t n_corners = m->dimension + 1;
    for (size_t k = 0; k < h.by_weight; k++) {
        CHECK(k == 0 || vertices[k - 1] < vertices[k]);
        CHECK(!h.is_hidden[vertices[k]] && representative_of(m, vertices[k]) == vertices[k]);
        h.is_hidden[vertices[k]] = true;
        if (view->count == 0) {
            CHECK(cells[k] == DELDRIFT_NONE);
            continue;
        }
        // It is in the cell that it is said to be above, and not within its power sphere.
        CHECK(cells[k] < view->count);
        double points[4 * 3];
        const uint32_t d = m->dimension, *row = view->vertices + cells[k] * n_corners;
        for (uint32_t i = 0; i <= d; i++) {
            for (uint32_t j = 0; j <= d; j++) {
                memcpy(points + j * d, m->positions + (j == i ? vertices[k] : row[j]) * d, d * sizeof(double));
            }
            int32_t sign;
            OK(deldrift_orientation(d, points, &sign));
            CHECK(sign >= 0);
        }
        CHECK(side_of(m, row, vertices[k]) <= 0);
    }
    return h;
}

static void has_same_cells(const deldrift_triangulation *t, const deldrift_triangulation *fresh, const uint32_t *ids, uint32_t n_corners) {
    deldrift_cells_view view, expected;
    OK(deldrift_cells(t, &view));
    OK(deldrift_cells(fresh, &expected));
    uint64_t found = 0, wanted = 0;
    for (size_t c = 0; c < expected.count; c++) {
        uint32_t row[4];
        for (uint32_t i = 0; i < n_corners; i++) row[i] = ids[expected.vertices[c * n_corners + i]];
        wanted += digest_of_row(row, n_corners);
    }
    for (size_t c = 0; c < view.count; c++) found += digest_of_row(view.vertices + c * n_corners, n_corners);
    CHECK(view.count == expected.count && found == wanted);
}

// Everything there is to say of a state.
static hidden check(const deldrift_triangulation *t, const model *m) {
    const uint32_t d = m->dimension;
    OK(deldrift_validate(t, 3));
    double positions[MOST * 3], weights[MOST];
    size_t n;
    OK(deldrift_copy_positions(t, positions, MOST, &n));
    CHECK(n == m->n_ids);
    OK(deldrift_weights(t, weights, MOST, &n));
    CHECK(n == m->n_ids);
    double present_at[MOST * 3], present_weights[MOST];
    uint32_t ids[MOST];
    size_t n_present = 0;
    for (uint32_t v = 0; v < m->n_ids; v++) {
        bool present;
        OK(deldrift_is_present(t, v, &present));
        CHECK(present == m->present[v]);
        if (!present) {
            CHECK(isnan(weights[v]) && isnan(positions[v * d]));
            continue;
        }
        double position[3];
        OK(deldrift_position(t, v, position));
        CHECK(memcmp(position, m->positions + v * d, d * sizeof(double)) == 0);
        CHECK(memcmp(positions + v * d, m->positions + v * d, d * sizeof(double)) == 0 && weights[v] == m->weights[v]);
        memcpy(present_at + n_present * d, m->positions + v * d, d * sizeof(double));
        present_weights[n_present] = m->weights[v];
        ids[n_present++] = v;
    }
    deldrift_cells_view view;
    OK(deldrift_cells(t, &view));
    // The definition: no vertex within the power sphere of a cell.
    for (size_t c = 0; c < view.count; c++) {
        const uint32_t *row = view.vertices + c * (d + 1);
        for (uint32_t v = 0; v < m->n_ids; v++) {
            bool is_corner = false;
            for (uint32_t i = 0; i <= d; i++) is_corner = is_corner || row[i] == v;
            if (m->present[v] && !is_corner) CHECK(side_of(m, row, v) <= 0);
        }
    }
    const hidden h = check_hidden(t, m, &view);
    // Who is in no cell is hidden.
    if (view.count > 0) {
        bool is_corner[MOST] = {false};
        for (size_t i = 0; i < view.count * (d + 1); i++) is_corner[view.vertices[i]] = true;
        for (uint32_t v = 0; v < m->n_ids; v++) CHECK(!m->present[v] || is_corner[v] != h.is_hidden[v]);
    }
    deldrift_triangulation *fresh;
    OK(deldrift_create_weighted(d, present_at, present_weights, NULL, n_present, NULL, &fresh));
    has_same_cells(t, fresh, ids, d + 1);
    deldrift_commit_report sums;
    OK(deldrift_statistics(fresh, &sums));
    CHECK(sums.coincident == h.by_place && sums.hidden_by_weight == h.by_weight);
    deldrift_destroy(fresh);
    return h;
}

static double coordinate(uint64_t *state, int kind) {
    const double x = next_random(state);
    return kind == 0 ? x : floor(x * (kind == 1 ? 4 : 8));
}

static double weight(uint64_t *state, int kind) {
    const double w = next_random(state);
    if (kind == 0) return 0.2 * w - 0.05;
    return floor(w * (kind == 1 ? 5 : 20)) - 2;
}

static void draw(model *m, uint32_t v, uint64_t *state, int kind) {
    for (uint32_t i = 0; i < m->dimension; i++) m->positions[v * m->dimension + i] = coordinate(state, kind);
    m->weights[v] = weight(state, kind);
}

// What a report and the list of changes say of two states, one after the other.
static void check_report(const deldrift_commit_report *report, const model *before, const model *m, const hidden *was, const hidden *is) {
    uint64_t moved = 0, reweighted = 0, came = 0, went = 0;
    for (uint32_t v = 0; v < m->n_ids; v++) {
        const size_t d = m->dimension;
        if (before->present[v] && m->present[v]) {
            moved += memcmp(before->positions + v * d, m->positions + v * d, d * sizeof(double)) != 0;
            reweighted += before->weights[v] != m->weights[v];
        }
        if (m->present[v]) {
            came += is->is_hidden[v] && !was->is_hidden[v];
            went += !is->is_hidden[v] && was->is_hidden[v];
        }
    }
    CHECK(report->moved == moved && report->reweighted == reweighted);
    CHECK(report->coincident == is->by_place && report->hidden_by_weight == is->by_weight);
    CHECK(report->newly_hidden == came && report->newly_shown == went);
}

static void check_changes(deldrift_triangulation *t, const model *m, const hidden *was, const hidden *is) {
    deldrift_changes changes;
    OK(deldrift_take_changes(t, &changes));
    size_t n_hidden = 0, n_shown = 0;
    for (uint32_t v = 0; v < m->n_ids; v++) {
        if (!m->present[v] || is->is_hidden[v] == was->is_hidden[v]) continue;
        if (is->is_hidden[v]) CHECK(n_hidden < changes.hidden_count && changes.hidden[n_hidden++] == v);
        else CHECK(n_shown < changes.shown_count && changes.shown[n_shown++] == v);
    }
    CHECK(n_hidden == changes.hidden_count && n_shown == changes.shown_count);
}

// A history with all that can be called.
static size_t live(uint32_t d, deldrift_algorithm algorithm, int kind, uint64_t seed) {
    static model m, before;
    memset(&m, 0, sizeof m);
    uint64_t state = seed;
    m.dimension = d;
    m.n_ids = 4 + (size_t)(next_random(&state) * 40);
    for (uint32_t v = 0; v < m.n_ids; v++) {
        m.present[v] = true;
        draw(&m, v, &state, kind);
    }
    deldrift_triangulation *t;
    OK(deldrift_create_weighted(d, m.positions, m.weights, NULL, m.n_ids, NULL, &t));
    OK(choose(t, algorithm));
    hidden was = check(t, &m), taken = {0};
    size_t n_hidden = was.by_weight;
    for (int step = 0; step < 14; step++) {
        before = m;
        deldrift_commit_report report;
        const uint32_t n = (uint32_t)m.n_ids;
        const uint32_t one = (uint32_t)(next_random(&state) * n);
        switch ((int)(next_random(&state) * 8)) {
            case 0: // Weights alone.
                for (uint32_t v = 0; v < n; v++) {
                    if (m.present[v]) m.weights[v] = weight(&state, kind);
                }
                OK(deldrift_commit_weighted(t, NULL, m.weights, n, &report));
                break;
            case 1: // Both.
                for (uint32_t v = 0; v < n; v++) {
                    if (m.present[v]) draw(&m, v, &state, kind);
                }
                OK(deldrift_commit_weighted(t, m.positions, m.weights, n, &report));
                break;
            case 2: { // Positions alone, of some.
                for (uint32_t v = 0; v < n; v++) {
                    if (!m.present[v] || next_random(&state) < 0.7) continue;
                    for (uint32_t i = 0; i < d; i++) m.positions[v * d + i] = coordinate(&state, kind);
                }
                OK(deldrift_commit_positions(t, m.positions, n, &report));
                break;
            }
            case 3: { // Staged apart, in either order; a weight twice is refused.
                if (!m.present[one]) continue;
                const uint32_t v = one;
                draw(&m, v, &state, kind);
                const bool is_weight_first = next_random(&state) < 0.5;
                if (is_weight_first) OK(deldrift_stage_weights(t, &v, m.weights + v, 1));
                OK(deldrift_move_vertex(t, v, m.positions + v * d));
                if (!is_weight_first) OK(deldrift_stage_weights(t, &v, m.weights + v, 1));
                const double other = 7;
                CHECK_STATUS(deldrift_stage_weights(t, &v, &other, 1), DELDRIFT_DUPLICATE_MOVE);
                CHECK_STATUS(deldrift_move_vertex(t, v, m.positions), DELDRIFT_DUPLICATE_MOVE);
                CHECK_STATUS(deldrift_set_weight(t, v, other), DELDRIFT_DUPLICATE_MOVE);
                CHECK_STATUS(deldrift_commit_weighted(t, NULL, m.weights, n, NULL), DELDRIFT_DUPLICATE_MOVE);
                OK(deldrift_commit_timestamp(t, &report));
                break;
            }
            case 4: { // Inserted and removed, with weights given late, and withdrawn once.
                if (m.n_ids + 2 > MOST) continue;
                uint32_t first;
                draw(&m, n, &state, kind);
                draw(&m, n + 1, &state, kind);
                const uint32_t late = n + 1;
                const double wrong = 3;
                for (int round = 0; round < 2; round++) {
                    if (step % 2 == 0) {
                        OK(deldrift_stage_insertions(t, m.positions + n * d, 2, &first));
                        OK(deldrift_stage_weights(t, &late, &wrong, 1));
                        OK(deldrift_stage_weights(t, (uint32_t[]){n, n + 1}, m.weights + n, 2));
                    } else {
                        OK(deldrift_stage_insertions_with_weights(t, m.positions + n * d, m.weights + n, 2, &first));
                    }
                    CHECK(first == n);
                    if (m.present[one]) OK(deldrift_stage_removals(t, &one, 1));
                    OK(deldrift_prepare_timestamp(t, &report));
                    if (round == 0) OK(deldrift_withdraw_timestamp(t));
                }
                OK(deldrift_publish_timestamp(t));
                m.n_ids += 2;
                m.present[n] = m.present[n + 1] = true;
                m.present[one] = false;
                break;
            }
            case 5: // At once.
                if (!m.present[one]) continue;
                m.weights[one] = weight(&state, kind);
                OK(deldrift_set_weight(t, one, m.weights[one]));
                for (uint32_t i = 0; i < d; i++) m.positions[one * d + i] = coordinate(&state, kind);
                OK(deldrift_relocate_vertex(t, one, m.positions + one * d));
                was = check(t, &m);
                before = m;
                OK(deldrift_commit_timestamp(t, &report));
                break;
            case 6: { // Gone at once, and others come, with a weight and without; lists tell after each whom it hides and shows.
                if (m.n_ids + 2 > MOST || !m.present[one]) continue;
                check_changes(t, &m, &taken, &was);
                OK(deldrift_remove_vertex(t, one));
                m.present[one] = false;
                taken = check(t, &m);
                check_changes(t, &m, &was, &taken);
                for (int k = 0; k < 2; k++) {
                    const uint32_t next = n + (uint32_t)k;
                    uint32_t inserted;
                    draw(&m, next, &state, kind);
                    if (k == 0) {
                        OK(deldrift_insert_vertex_with_weight(t, m.positions + next * d, m.weights[next], &inserted));
                    } else {
                        m.weights[next] = 0;
                        OK(deldrift_insert_vertex(t, m.positions + next * d, &inserted));
                    }
                    CHECK(inserted == next);
                    m.n_ids++;
                    m.present[next] = true;
                    was = check(t, &m);
                    check_changes(t, &m, &taken, &was);
                    taken = was;
                }
                before = m;
                OK(deldrift_commit_timestamp(t, &report));
                break;
            }
            default: { // A copy goes on in its place.
                deldrift_triangulation *copy;
                OK(deldrift_clone(t, &copy));
                deldrift_destroy(t);
                t = copy;
                OK(deldrift_commit_timestamp(t, &report));
            }
        }
        const hidden is = check(t, &m);
        check_report(&report, &before, &m, &was, &is);
        if (next_random(&state) < 0.5) {
            check_changes(t, &m, &taken, &is);
            taken = is;
        }
        was = is;
        n_hidden += is.by_weight;
        // At rest nothing changes.
        deldrift_commit_report rest;
        deldrift_cells_view view, again;
        OK(deldrift_cells(t, &view));
        OK(deldrift_commit_weighted(t, m.positions, m.weights, m.n_ids, &rest));
        OK(deldrift_cells(t, &again));
        CHECK(rest.moved == 0 && rest.reweighted == 0 && rest.newly_hidden == 0 && rest.newly_shown == 0);
        CHECK(view.count == again.count);
    }
    deldrift_destroy(t);
    return n_hidden;
}

// Equal weights give the rows of a triangulation without weights.
static void equal_weights_are_none(uint32_t d) {
    double *positions = random_positions(d, MOST, 3), weights[MOST];
    for (int k = 0; k < MOST; k++) weights[k] = 0.25;
    deldrift_triangulation *plain = create(d, positions, MOST, NULL), *t;
    OK(deldrift_create_weighted(d, positions, weights, NULL, MOST, NULL, &t));
    deldrift_cells_view view, expected;
    bool is_weighted;
    OK(deldrift_cells(t, &view));
    OK(deldrift_cells(plain, &expected));
    CHECK(view.count == expected.count);
    uint32_t ids[MOST];
    for (uint32_t v = 0; v < MOST; v++) ids[v] = v;
    has_same_cells(t, plain, ids, d + 1);
    OK(deldrift_is_weighted(t, &is_weighted));
    CHECK(is_weighted);
    OK(deldrift_is_weighted(plain, &is_weighted));
    CHECK(!is_weighted);
    CHECK_STATUS(deldrift_weights(plain, weights, MOST, &(size_t){0}), DELDRIFT_NOT_WEIGHTED);
    CHECK_STATUS(deldrift_set_weight(plain, 0, 1), DELDRIFT_NOT_WEIGHTED);
    uint32_t segment;
    CHECK_STATUS(deldrift_stage_segments(t, (uint32_t[]){0, 1}, NULL, 1, &segment), DELDRIFT_WEIGHTED);
    CHECK_MESSAGE("t has weights");
    CHECK_STATUS(deldrift_set_weight(t, 0, 1.5e114), DELDRIFT_OUT_OF_RANGE);
    CHECK_MESSAGE("weight[0] is 1.5e114");
    CHECK_STATUS(deldrift_set_weight(t, 0, NAN), DELDRIFT_NOT_FINITE);
    uint32_t first = 7;
    CHECK_STATUS(deldrift_insert_vertex_with_weight(plain, positions, 1, &first), DELDRIFT_NOT_WEIGHTED);
    CHECK_STATUS(deldrift_stage_insertions_with_weights(plain, positions, NULL, 2, &first), DELDRIFT_NOT_WEIGHTED);
    CHECK_STATUS(deldrift_insert_vertex_with_weight(t, positions, -1.5e114, &first), DELDRIFT_OUT_OF_RANGE);
    CHECK_MESSAGE("weight[0] is -1.5e114");
    // All of them, or none.
    weights[1] = NAN;
    CHECK_STATUS(deldrift_stage_insertions_with_weights(t, positions, weights, 2, &first), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("weights[1]");
    CHECK(first == 7);
    OK(deldrift_stage_insertions_with_weights(t, positions, NULL, 1, &first));
    CHECK(first == MOST);
    OK(deldrift_discard_moves(t));
    weights[1] = 0.25;
    weights[5] = INFINITY;
    CHECK_STATUS(deldrift_stage_weights(t, NULL, weights, MOST), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("weights[5]");
    size_t staged;
    OK(deldrift_staged_count(t, &staged));
    CHECK(staged == 0);
    deldrift_destroy(t);
    deldrift_destroy(plain);
    free(positions);
}

// What is read of some cells is what is read of all; beyond the arrays nothing is written.
static void reads_rows_of_coordinates(const deldrift_triangulation *t, uint32_t d) {
    enum { CELLS = 16 * MOST };
    static double all[CELLS * 3], some[CELLS * 3 + 1], squares[CELLS], again[CELLS];
    static uint32_t cells[CELLS];
    size_t n;
    OK(deldrift_circumcentres(t, all, squares, CELLS, &n));
    for (size_t c = 0; c < n; c++) cells[c] = (uint32_t)c;
    some[n * d] = 4.5;
    OK(deldrift_update_circumcentres(t, cells, n, some, again, n));
    CHECK(memcmp(all, some, n * d * sizeof *all) == 0 && memcmp(squares, again, n * sizeof *squares) == 0);
    CHECK(some[n * d] == 4.5);
}

// Power cells fill a box, whatever the weights; their derivatives by weights are what differences say, and a sum of nothing.
static void cells_follow_weights(uint32_t d) {
    enum { N = 40, EDGES = 12 * N };
    static const double low[] = {-1, -1, -1}, high[] = {2, 2, 2};
    double *positions = random_positions(d, N, 11), weights[N], volumes[N], others[N], by_weight[EDGES];
    uint64_t state = 5;
    for (int v = 0; v < N; v++) weights[v] = 0.06 * next_random(&state);
    deldrift_triangulation *t;
    OK(deldrift_create_weighted(d, positions, weights, NULL, N, NULL, &t));
    uint32_t edges[2 * EDGES];
    size_t n, n_edges, n_hidden;
    OK(deldrift_edges(t, edges, EDGES, &n_edges));
    OK(deldrift_hidden_by_weight(t, NULL, NULL, 0, &n_hidden));
    CHECK(n_hidden > 0);
    OK(deldrift_voronoi_weight_derivatives(t, low, high, NULL, 0, NULL, 0, volumes, N, &n, by_weight, EDGES, &n_edges));
    double sum = 0, whole = d == 2 ? 9 : 27;
    size_t n_empty = 0;
    for (int v = 0; v < N; v++) {
        sum += volumes[v];
        n_empty += volumes[v] == 0;
    }
    CHECK(fabs(sum - whole) < 1e-6 && n_empty == n_hidden);
    // A step so small that no cell changes its neighbours, and so large that it is seen.
    const double step = 1e-6;
    reads_rows_of_coordinates(t, d);
    for (uint32_t v = 0; v < N; v += 7) {
        if (volumes[v] == 0) continue;
        OK(deldrift_set_weight(t, v, weights[v] + step));
        OK(deldrift_voronoi_volumes(t, low, high, others, N, &n));
        OK(deldrift_set_weight(t, v, weights[v]));
        double own = 0;
        for (size_t e = 0; e < n_edges; e++) {
            const uint32_t *ends = edges + 2 * e;
            if (ends[0] != v && ends[1] != v) continue;
            const uint32_t other = ends[ends[0] == v];
            CHECK(by_weight[e] <= 0 && fabs((others[other] - volumes[other]) / step - by_weight[e]) < 1e-2);
            own -= by_weight[e];
        }
        CHECK(own > 0 && fabs((others[v] - volumes[v]) / step - own) < 1e-2);
    }
    deldrift_destroy(t);
    free(positions);
}

// Two vertices at one place are refused where the options say so, of whatever weights.
static void coincidence_is_refused(uint32_t d) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.coincidence = DELDRIFT_COINCIDENCE_REJECT;
    double *positions = random_positions(d, MOST, 3);
    deldrift_triangulation *t;
    double weights[MOST] = {0};
    OK(deldrift_create_weighted(d, positions, weights, NULL, MOST, &options, &t));
    // So light that it is hidden, and there.
    OK(deldrift_set_weight(t, 7, -100));
    CHECK_STATUS(deldrift_relocate_vertex(t, 7, positions), DELDRIFT_COINCIDENT);
    uint32_t first;
    CHECK_STATUS(deldrift_insert_vertex(t, positions + 7 * d, &first), DELDRIFT_COINCIDENT);
    OK(deldrift_move_vertex(t, 7, positions));
    CHECK_STATUS(deldrift_commit_timestamp(t, NULL), DELDRIFT_COINCIDENT);
    OK(deldrift_discard_moves(t));
    OK(deldrift_validate(t, 3));
    memcpy(positions, positions + d, d * sizeof *positions);
    deldrift_triangulation *other;
    weights[0] = -50;
    CHECK_STATUS(deldrift_create_weighted(d, positions, weights, NULL, MOST, &options, &other), DELDRIFT_COINCIDENT);
    deldrift_destroy(t);
    free(positions);
}

// In a box equal weights are none, one that is heavy enough hides all others, and what is staged is saved.
static void weights_repeat(uint32_t d) {
    static const double box[2][9] = {{1, 0, 0.25, 1}, {1, 0, 0, 0.25, 1, 0, 0, 0.5, 1}};
    enum { BYTES = 1 << 20 };
    static uint8_t bytes[BYTES], again[BYTES];
    double *positions = random_positions(d, MOST, 8), weights[MOST], volumes[MOST], plain_volumes[MOST], found[MOST];
    size_t count, size, n_cells, plain_cells;
    bool is_weighted;
    deldrift_commit_report report;
    deldrift_triangulation *t, *plain, *loaded;
    for (size_t v = 0; v < MOST; v++) weights[v] = 7;
    OK(deldrift_create_periodic_weighted(d, positions, weights, MOST, box[d - 2], d, NULL, &t));
    OK(deldrift_create_periodic(d, positions, MOST, box[d - 2], d, NULL, &plain));
    OK(deldrift_is_weighted(t, &is_weighted));
    CHECK(is_weighted);
    OK(deldrift_cell_count(t, &n_cells));
    OK(deldrift_cell_count(plain, &plain_cells));
    CHECK(n_cells == plain_cells);
    OK(deldrift_voronoi_volumes(t, NULL, NULL, volumes, MOST, &count));
    OK(deldrift_voronoi_volumes(plain, NULL, NULL, plain_volumes, MOST, &count));
    for (size_t v = 0; v < MOST; v++) CHECK(fabs(volumes[v] - plain_volumes[v]) < 1e-12);
    CHECK_STATUS(deldrift_hidden_by_weight(plain, NULL, NULL, 0, &count), DELDRIFT_NOT_WEIGHTED);
    double told[10] = {[9] = 4.5}, reduced[10] = {[9] = 4.5}, plain_reduced[9], wrapped[MOST * 3];
    OK(deldrift_vectors(t, told, d, &count));
    CHECK(count == d && memcmp(told, box[d - 2], d * d * sizeof *told) == 0 && told[d * d] == (d == 3 ? 4.5 : 0));
    OK(deldrift_reduced_vectors(t, reduced, NULL, NULL, d, &count));
    OK(deldrift_reduced_vectors(plain, plain_reduced, NULL, NULL, d, &count));
    CHECK(memcmp(reduced, plain_reduced, d * d * sizeof *reduced) == 0 && reduced[9] == 4.5);
    int64_t shifts[MOST * 3];
    OK(deldrift_wrap_positions(t, positions, NULL, MOST, wrapped, shifts));
    for (size_t i = 0; i < MOST * d; i++) CHECK(wrapped[i] > -1 && wrapped[i] < 2);
    reads_rows_of_coordinates(t, d);
    OK(deldrift_set_weight(t, 5, 100));
    uint32_t hidden[MOST], above[MOST];
    OK(deldrift_hidden_by_weight(t, hidden, above, MOST, &count));
    OK(deldrift_cell_count(t, &n_cells));
    CHECK(count == MOST - 1 && n_cells == (d == 2 ? 2 : 6) && above[0] < n_cells);
    OK(deldrift_move_vertex(t, 4, positions));
    OK(deldrift_stage_weights(t, (uint32_t[]){5}, (double[]){7}, 1));
    CHECK_STATUS(deldrift_stage_weights(t, (uint32_t[]){3, 5}, (double[]){1, 2}, 2), DELDRIFT_DUPLICATE_MOVE);
    OK(deldrift_save(t, bytes, BYTES, &size));
    OK(deldrift_load(bytes, size, NULL, &loaded));
    OK(deldrift_save(loaded, again, BYTES, &count));
    CHECK(count == size && memcmp(bytes, again, size) == 0);
    OK(deldrift_commit_timestamp(loaded, &report));
    CHECK(report.reweighted == 1 && report.moved == 1 && report.newly_shown == MOST - 2 && report.coincident == 1);
    OK(deldrift_weights(loaded, found, MOST, &count));
    CHECK(memcmp(found, weights, sizeof weights) == 0);
    OK(deldrift_validate(loaded, 3));
    weights[2] = NAN;
    CHECK_STATUS(deldrift_commit_weighted(loaded, NULL, weights, MOST, &report), DELDRIFT_NOT_FINITE);
    deldrift_triangulation *none = NULL;
    CHECK_STATUS(deldrift_create_periodic_weighted(d, positions, weights, MOST, box[d - 2], d, NULL, &none), DELDRIFT_NOT_FINITE);
    CHECK(none == NULL);
    // One at once, whatever is staged for others, and two with their weights.
    uint32_t first = 9;
    const double coming[] = {0.5, 0.125, 0.75, 0.25, 0.375, 0.5}, their[] = {9, -3};
    CHECK_STATUS(deldrift_insert_vertex_with_weight(t, coming, NAN, &first), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("weight[0] is NaN");
    CHECK(first == 9);
    OK(deldrift_insert_vertex_with_weight(t, coming, 200, &first));
    OK(deldrift_hidden_by_weight(t, NULL, NULL, 0, &count));
    CHECK(first == MOST && count == MOST);
    OK(deldrift_remove_vertex(t, first));
    OK(deldrift_stage_insertions_with_weights(t, coming, their, 2, &first));
    CHECK_STATUS(deldrift_insert_vertex_with_weight(t, coming, 0, &first), DELDRIFT_STAGED_VERTEX);
    OK(deldrift_commit_timestamp(t, &report));
    double all[MOST + 3];
    OK(deldrift_weights(t, all, MOST + 3, &count));
    CHECK(report.inserted == 2 && count == MOST + 3 && isnan(all[MOST]) && all[MOST + 1] == 9 && all[MOST + 2] == -3);
    OK(deldrift_validate(t, 3));
    deldrift_destroy(loaded);
    deldrift_destroy(plain);
    deldrift_destroy(t);
    free(positions);
}

int main(void) {
    static const deldrift_algorithm algorithms[] = {
        DELDRIFT_AUTO, DELDRIFT_REBUILDING, DELDRIFT_REPAIR, DELDRIFT_TOLERANCE, DELDRIFT_PLACEMENT_FLIPS,
        DELDRIFT_RESEARCH_PLACEMENT, DELDRIFT_RESEARCH_SAFE_REGION, DELDRIFT_RESEARCH_REBUILDING_TOLERANCE,
    };
    size_t n_hidden = 0;
    for (uint32_t d = 2; d <= 3; d++) {
        equal_weights_are_none(d);
        coincidence_is_refused(d);
        weights_repeat(d);
        cells_follow_weights(d);
        for (size_t a = 0; a < sizeof algorithms / sizeof *algorithms; a++) {
            for (int kind = 0; kind < 3; kind++) {
                for (uint64_t seed = 1; seed <= 2; seed++) n_hidden += live(d, algorithms[a], kind, seed * 1000 + a);
            }
        }
    }
    CHECK(n_hidden > 500);
    return 0;
}
