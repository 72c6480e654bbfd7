// Segments: constrained Delaunay triangulations of vertices that move, compared with the definition in integers, and what is
// in the way of segments with all pairs. All coordinates are small integers.
#include "buffers.h"
#include "lattice.h"

enum { MOST_SEGMENTS = 64, MOST_CONFLICTS = 4096 };

static uint64_t seed = 11;

static int64_t below(int64_t n) { return (int64_t)(next_random(&seed) * (double)n); }

// What the test knows of a triangulation: where vertices are, and will be, and which segments there are, and will be.
typedef struct {
    size_t n;
    points now, then;
    bool is_gone[MOST], will_be_gone[MOST];
    size_t n_segments, n_laid;
    uint32_t ends[MOST_SEGMENTS][2];
    bool has_ended[MOST_SEGMENTS], will_have_ended[MOST_SEGMENTS];
} model;

static uint32_t shown(const model *m, uint32_t v, const points *at, const bool *is_gone) {
    for (uint32_t u = 0; u < v && u < m->n; u++)
        if (!is_gone[u] && (*at)[u][0] == (*at)[v][0] && (*at)[u][1] == (*at)[v][1]) return u;
    return v;
}

// Each cell is counter-clockwise, each segment an edge, and no vertex beyond an edge between two cells that is no segment is
// in the circle of one of them; at ties the vertex of the higher id is outside.
static void check_cells(const deldrift_triangulation *t, const model *m) {
    const deldrift_cells_view view = cells_of(t);
    for (size_t c = 0; c < view.count; c++) {
        const uint32_t *v = view.vertices + 3 * c;
        CHECK(turn(m->now[v[0]], m->now[v[1]], m->now[v[2]]) > 0);
        for (int i = 0; i < 3; i++) {
            const uint32_t across = view.neighbours[3 * c + (size_t)i], a = v[(i + 1) % 3], b = v[(i + 2) % 3];
            bool is_segment = false;
            for (size_t k = 0; k < m->n_laid; k++) {
                const uint32_t p = shown(m, m->ends[k][0], &m->now, m->is_gone);
                const uint32_t q = shown(m, m->ends[k][1], &m->now, m->is_gone);
                is_segment = is_segment || (!m->has_ended[k] && ((p == a && q == b) || (p == b && q == a)));
            }
            if (is_segment || across == DELDRIFT_NONE) continue;
            const uint32_t *w = view.vertices + 3 * (size_t)across;
            uint32_t apex = DELDRIFT_NONE;
            for (int k = 0; k < 3; k++)
                if (w[k] != a && w[k] != b) apex = w[k];
            const uint32_t ids[4] = {v[0], v[1], v[2], apex};
            CHECK(!is_inside(m->now, ids));
        }
    }
    for (size_t k = 0; k < m->n_laid && view.count > 0; k++) {
        if (m->has_ended[k]) continue;
        const uint32_t edge[] = {m->ends[k][0], m->ends[k][1]};
        uint32_t cell;
        OK(deldrift_find_simplices(t, 2, edge, 1, &cell));
        CHECK(cell != DELDRIFT_NONE);
    }
    OK(deldrift_validate(t, 3));
}

static void check_list(const deldrift_triangulation *t, const model *m) {
    uint32_t segments[MOST_SEGMENTS], ends[MOST_SEGMENTS][2];
    int32_t markers[MOST_SEGMENTS];
    size_t count, n = 0;
    OK(deldrift_segments(t, segments, ends[0], markers, MOST_SEGMENTS, &count));
    for (uint32_t k = 0; k < m->n_laid; k++) {
        if (m->has_ended[k]) continue;
        CHECK(n < count && segments[n] == k && memcmp(ends[n], m->ends[k], sizeof *ends) == 0);
        CHECK(markers[n++] == -7 * (int32_t)k);
    }
    CHECK(n == count);
}

static bool is_same_edge(const uint32_t *a, const uint32_t *b) {
    return (a[0] == b[0] && a[1] == b[1]) || (a[0] == b[1] && a[1] == b[0]);
}

static int by_kind_segment_and_other(const void *one, const void *two) {
    const deldrift_conflict *a = one, *b = two;
    if (a->kind != b->kind) return a->kind < b->kind ? -1 : 1;
    if (a->segment != b->segment) return a->segment < b->segment ? -1 : 1;
    return a->other < b->other ? -1 : a->other > b->other;
}

// All conflicts that a commit would have, by all pairs.
static size_t conflicts_of(const model *m, deldrift_conflict *found) {
    uint32_t edges[MOST_SEGMENTS][2];
    bool has_ends[MOST_SEGMENTS] = {false};
    size_t n = 0;
    for (uint32_t k = 0; k < m->n_segments; k++) {
        if (m->will_have_ended[k]) continue;
        const uint32_t *ends = m->ends[k];
        size_t n_gone = 0;
        for (int i = 0; i < 2; i++) {
            if (!m->will_be_gone[ends[i]] || (i == 1 && n_gone > 0 && ends[0] == ends[1])) continue;
            found[n++] = (deldrift_conflict){DELDRIFT_CONFLICT_END_REMOVED, k, ends[i]};
            n_gone++;
        }
        for (int i = 0; i < 2; i++) edges[k][i] = shown(m, ends[i], &m->then, m->will_be_gone);
        has_ends[k] = n_gone == 0 && edges[k][0] != edges[k][1];
        if (n_gone == 0 && !has_ends[k]) {
            found[n++] = (deldrift_conflict){DELDRIFT_CONFLICT_ENDS_MEET, k, DELDRIFT_NONE};
        }
    }
    for (uint32_t k = 0; k < m->n_segments; k++) {
        if (!has_ends[k]) continue;
        const int64_t *p = m->then[edges[k][0]], *q = m->then[edges[k][1]];
        for (uint32_t v = 0; v < m->n; v++) {
            if (m->will_be_gone[v] || shown(m, v, &m->then, m->will_be_gone) != v || v == edges[k][0] || v == edges[k][1])
                continue;
            if (is_between(p, q, m->then[v])) found[n++] = (deldrift_conflict){DELDRIFT_CONFLICT_ON_SEGMENT, k, v};
        }
        for (uint32_t j = k + 1; j < m->n_segments; j++) {
            if (!has_ends[j] || is_same_edge(edges[j], edges[k])) continue;
            if (cross(p, q, m->then[edges[j][0]], m->then[edges[j][1]]))
                found[n++] = (deldrift_conflict){DELDRIFT_CONFLICT_CROSSING, k, j};
        }
        CHECK(n < MOST_CONFLICTS / 2);
    }
    qsort(found, n, sizeof *found, by_kind_segment_and_other);
    return n;
}

static deldrift_status status_of(deldrift_conflict_kind kind) { return DELDRIFT_CROSSING + kind; }

static void check_conflicts(const deldrift_triangulation *t, const deldrift_conflict *wanted, size_t n) {
    static deldrift_conflict told[MOST_CONFLICTS];
    size_t count;
    OK(deldrift_segment_conflicts(t, told, MOST_CONFLICTS, &count));
    CHECK(count == n && (n == 0 || memcmp(told, wanted, n * sizeof *told) == 0));
}

// A history of random changes, of which some are refused; how many of each kind.
static void history(deldrift_algorithm algorithm, int64_t size, size_t counts[2]) {
    static model m;
    static deldrift_conflict wanted[MOST_CONFLICTS];
    memset(&m, 0, sizeof m);
    m.n = 12 + (size_t)below(20);
    double positions[2 * MOST];
    for (size_t v = 0; v < m.n; v++)
        for (int i = 0; i < 2; i++) positions[2 * v + (size_t)i] = (double)(m.now[v][i] = below(size));
    memcpy(m.then, m.now, sizeof m.now);
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = algorithm;
    deldrift_triangulation *t = create(2, positions, m.n, &options);
    for (int step = 0; step < 30; step++) {
        uint32_t first, segment;
        for (uint32_t v = 0; v < m.n; v++) {
            if (m.is_gone[v] || below(4) > 0) continue;
            for (int i = 0; i < 2; i++) m.then[v][i] = below(size);
            OK(deldrift_move_vertex(t, v, (double[]){(double)m.then[v][0], (double)m.then[v][1]}));
        }
        if (below(3) == 0 && m.n < MOST) {
            for (int i = 0; i < 2; i++) m.then[m.n][i] = below(size);
            OK(deldrift_stage_insertions(t, (double[]){(double)m.then[m.n][0], (double)m.then[m.n][1]}, 1, &first));
            CHECK(first == m.n);
            m.n++;
        }
        const uint32_t leaving = (uint32_t)below((int64_t)m.n);
        if (below(4) == 0 && deldrift_stage_removals(t, &leaving, 1) == DELDRIFT_OK) m.will_be_gone[leaving] = true;
        for (int64_t k = below(3); k > 0 && m.n_segments < MOST_SEGMENTS; k--) {
            const uint32_t ends[] = {(uint32_t)below((int64_t)m.n), (uint32_t)below((int64_t)m.n)};
            if (m.is_gone[ends[0]] || m.is_gone[ends[1]]) continue;
            const int32_t marker = -7 * (int32_t)m.n_segments;
            OK(deldrift_stage_segments(t, ends, &marker, 1, &segment));
            CHECK(segment == m.n_segments);
            memcpy(m.ends[m.n_segments++], ends, sizeof ends);
        }
        if (m.n_laid > 0 && below(3) == 0) {
            segment = (uint32_t)below((int64_t)m.n_laid);
            const deldrift_status status = deldrift_stage_segment_removals(t, &segment, 1);
            CHECK(status == (m.has_ended[segment] ? DELDRIFT_NO_SUCH_SEGMENT : DELDRIFT_OK));
            m.will_have_ended[segment] = true;
        }
        const size_t n = conflicts_of(&m, wanted);
        const deldrift_status expected = n == 0 ? DELDRIFT_OK : status_of(wanted[0].kind);
        if (below(2) == 0) {
            CHECK_STATUS(deldrift_check_staged(t), expected);
            check_conflicts(t, wanted, n);
        }
        CHECK_STATUS(deldrift_commit_timestamp(t, NULL), expected);
        check_conflicts(t, wanted, n);
        counts[n > 0]++;
        if (n == 0) {
            memcpy(m.now, m.then, sizeof m.now);
            memcpy(m.is_gone, m.will_be_gone, sizeof m.is_gone);
            memcpy(m.has_ended, m.will_have_ended, sizeof m.has_ended);
            m.n_laid = m.n_segments;
        } else {
            // What is staged is staged still: without the conflicts' reasons it can be told.
            OK(deldrift_discard_moves(t));
            size_t ids;
            OK(deldrift_id_count(t, &ids));
            m.n = ids;
            memcpy(m.then, m.now, sizeof m.now);
            memcpy(m.will_be_gone, m.is_gone, sizeof m.is_gone);
            memcpy(m.will_have_ended, m.has_ended, sizeof m.has_ended);
            memset(m.will_have_ended + m.n_laid, 0, MOST_SEGMENTS - m.n_laid);
            m.n_segments = m.n_laid;
        }
        check_list(t, &m);
        check_cells(t, &m);
    }
    deldrift_destroy(t);
}

static void random_histories_are_as_the_definition_says(void) {
    static const deldrift_algorithm algorithms[] = {DELDRIFT_AUTO,      DELDRIFT_REBUILDING, DELDRIFT_PLACEMENT_FLIPS,
                                                    DELDRIFT_TOLERANCE, DELDRIFT_REPAIR};
    size_t counts[2] = {0, 0};
    for (int round = 0; round < 60; round++) {
        const int64_t sizes[] = {6, 40, 1000};
        history(algorithms[round % 5], sizes[round % 3], counts);
    }
    CHECK(counts[0] > 200 && counts[1] > 200);
}

// A square with its diagonal from 0 to 2 prescribed, and two vertices beside it that would have it replaced.
static const double KITE[] = {0, 0, 5, -1, 10, 0, 5, 1};
enum { KITE_COUNT = 4 };

static deldrift_triangulation *kite(deldrift_algorithm algorithm, uint32_t *segment) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = algorithm;
    deldrift_triangulation *t = create(2, KITE, KITE_COUNT, &options);
    const int32_t marker = 5;
    OK(deldrift_stage_segments(t, (uint32_t[]){0, 2}, &marker, 1, segment));
    OK(deldrift_commit_timestamp(t, NULL));
    return t;
}

static bool has_edge(const deldrift_triangulation *t, uint32_t a, uint32_t b) {
    uint32_t cell;
    OK(deldrift_find_simplices(t, 2, (uint32_t[]){a, b}, 1, &cell));
    return cell != DELDRIFT_NONE;
}

static void a_segment_comes_and_goes(void) {
    uint32_t segment = 77;
    deldrift_triangulation *t = create(2, KITE, KITE_COUNT, NULL);
    CHECK(has_edge(t, 1, 3) && !has_edge(t, 0, 2));
    OK(deldrift_stage_segments(t, (uint32_t[]){2, 0}, NULL, 1, &segment));
    size_t count = 77;
    OK(deldrift_segments(t, NULL, NULL, NULL, 0, &count));
    CHECK(segment == 0 && count == 0 && has_edge(t, 1, 3));
    OK(deldrift_staged_count(t, &count));
    CHECK(count == 0);
    OK(deldrift_discard_moves(t));
    OK(deldrift_stage_segments(t, NULL, NULL, 0, &segment));
    CHECK(segment == 0);
    OK(deldrift_stage_segments(t, (uint32_t[]){2, 0}, NULL, 1, &segment));
    OK(deldrift_commit_timestamp(t, NULL));
    CHECK(segment == 0 && has_edge(t, 0, 2) && !has_edge(t, 1, 3));
    // A removal is staged, forgotten, staged again, and made.
    OK(deldrift_stage_segment_removals(t, &segment, 1));
    CHECK_STATUS(deldrift_stage_segment_removals(t, &segment, 1), DELDRIFT_NO_SUCH_SEGMENT);
    OK(deldrift_discard_moves(t));
    CHECK_STATUS(deldrift_stage_segment_removals(t, (uint32_t[]){0, 0}, 2), DELDRIFT_NO_SUCH_SEGMENT);
    CHECK_MESSAGE("segments[1] is 0");
    OK(deldrift_stage_segment_removals(t, &segment, 1));
    OK(deldrift_segments(t, NULL, NULL, NULL, 0, &count));
    CHECK(count == 1 && has_edge(t, 0, 2));
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_segments(t, NULL, NULL, NULL, 0, &count));
    CHECK(count == 0 && has_edge(t, 1, 3));
    CHECK_STATUS(deldrift_stage_segment_removals(t, &segment, 1), DELDRIFT_NO_SUCH_SEGMENT);
    CHECK_MESSAGE("1 ids have been given");
    // Ids are not given again once they have been in force; one that is staged cannot be removed.
    OK(deldrift_stage_segments(t, (uint32_t[]){0, 2}, NULL, 1, &segment));
    CHECK(segment == 1);
    CHECK_STATUS(deldrift_stage_segment_removals(t, &segment, 1), DELDRIFT_NO_SUCH_SEGMENT);
    deldrift_destroy(t);
}

// Calls that change one vertex at once keep the segments in force, also where a tolerance says that nothing changes.
static void immediate_calls_are_refused(void) {
    static const deldrift_algorithm algorithms[] = {DELDRIFT_AUTO, DELDRIFT_TOLERANCE, DELDRIFT_REPAIR,
                                                    DELDRIFT_PLACEMENT_FLIPS};
    for (size_t k = 0; k < sizeof algorithms / sizeof *algorithms; k++) {
        uint32_t segment, vertex = 77;
        deldrift_triangulation *t = kite(algorithms[k], &segment);
        deldrift_conflict conflict;
        size_t count;
        for (uint32_t v = 0; v < KITE_COUNT; v++) OK(deldrift_relocate_vertex(t, v, KITE + 2 * v));
        CHECK_STATUS(deldrift_relocate_vertex(t, 3, (double[]){5, 0}), DELDRIFT_ON_SEGMENT);
        CHECK_MESSAGE("vertex 3 is on segment 0");
        OK(deldrift_segment_conflicts(t, &conflict, 1, &count));
        CHECK(count == 1 && conflict.kind == DELDRIFT_CONFLICT_ON_SEGMENT && conflict.segment == 0 && conflict.other == 3);
        // To the other side of the segment: only where it goes counts.
        OK(deldrift_relocate_vertex(t, 3, (double[]){5, -0.25}));
        OK(deldrift_segment_conflicts(t, NULL, 0, &count));
        CHECK(count == 0 && has_edge(t, 0, 2));
        OK(deldrift_validate(t, 3));
        OK(deldrift_relocate_vertex(t, 3, KITE + 6));
        CHECK_STATUS(deldrift_insert_vertex(t, (double[]){2, 0}, &vertex), DELDRIFT_ON_SEGMENT);
        CHECK(vertex == 77);
        CHECK_STATUS(deldrift_remove_vertex(t, 2), DELDRIFT_END_REMOVED);
        CHECK_STATUS(deldrift_relocate_vertex(t, 2, KITE), DELDRIFT_ENDS_MEET);
        OK(deldrift_insert_vertex(t, (double[]){3, 0.25}, &vertex));
        OK(deldrift_remove_vertex(t, 1));
        CHECK(vertex == 4 && has_edge(t, 0, 2));
        OK(deldrift_validate(t, 3));
        // The end of a segment goes over another vertex that becomes its representative.
        OK(deldrift_relocate_vertex(t, 0, (double[]){3, 0.25}));
        CHECK(has_edge(t, 0, 2));
        OK(deldrift_validate(t, 3));
        deldrift_destroy(t);
    }
}

// Vertices go by little, one at a time, beside a segment across all of them: tolerances are of the Delaunay triangulation, and
// say nothing of the cells that the segment has made.
static void vertices_beside_a_segment_do_not_slip_over_it(void) {
    enum { COUNT = 400 };
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = DELDRIFT_TOLERANCE;
    double *p = random_positions(2, COUNT, 5);
    memcpy(p, (double[]){-0.1, 0.5, 1.1, 0.5}, 4 * sizeof *p);
    deldrift_triangulation *t = create(2, p, COUNT, &options);
    uint32_t segment;
    size_t n_refused = 0;
    OK(deldrift_stage_segments(t, (uint32_t[]){0, 1}, NULL, 1, &segment));
    for (int step = 0; step < 3; step++) {
        for (size_t i = 4; i < 2 * COUNT; i++) p[i] += 1e-6 * next_random(&seed);
        OK(deldrift_commit_positions(t, p, COUNT, NULL));
    }
    for (size_t k = 0; k < 8000; k++) {
        const uint32_t v = 2 + (uint32_t)below(COUNT - 2);
        double *at = p + 2 * v, to[2];
        for (int i = 0; i < 2; i++) to[i] = at[i] + 1e-2 * (next_random(&seed) - 0.5);
        const bool is_on = k % 2 == 0 && fabs(at[1] - 0.5) < 0.02;
        if (is_on) to[1] = 0.5;
        CHECK_STATUS(deldrift_relocate_vertex(t, v, to), is_on ? DELDRIFT_ON_SEGMENT : DELDRIFT_OK);
        n_refused += is_on;
        if (!is_on) memcpy(at, to, sizeof to);
    }
    OK(deldrift_validate(t, 3));
    CHECK(has_edge(t, 0, 1) && n_refused > 100);
    deldrift_destroy(t);
    free(p);
}

static void segments_that_cross_are_refused(void) {
    uint32_t segment;
    deldrift_triangulation *t = kite(DELDRIFT_AUTO, &segment);
    deldrift_conflict conflicts[3];
    size_t count;
    OK(deldrift_stage_segments(t, (uint32_t[]){1, 3, 3, 1, 1, 1}, NULL, 3, &segment));
    CHECK_STATUS(deldrift_check_staged(t), DELDRIFT_CROSSING);
    CHECK_MESSAGE("segments 0 and 1 cross, and there are 2 more conflicts");
    CHECK_STATUS(deldrift_commit_timestamp(t, NULL), DELDRIFT_CROSSING);
    OK(deldrift_segment_conflicts(t, conflicts, 3, &count));
    CHECK(count == 3 && conflicts[2].kind == DELDRIFT_CONFLICT_ENDS_MEET && conflicts[2].segment == 3);
    CHECK(conflicts[2].other == DELDRIFT_NONE && conflicts[1].segment == 0 && conflicts[1].other == 2);
    CHECK_BUFFER(deldrift_conflict, 3, 1, deldrift_segment_conflicts(t, buffer, capacity, &count));
    // What is staged stays so; a commit without the segment that they cross has one conflict.
    OK(deldrift_stage_segment_removals(t, (uint32_t[]){0}, 1));
    CHECK_STATUS(deldrift_commit_timestamp(t, NULL), DELDRIFT_ENDS_MEET);
    CHECK_MESSAGE("both ends of segment 3 are at the same place");
    OK(deldrift_segment_conflicts(t, conflicts, 3, &count));
    CHECK(count == 1);
    deldrift_destroy(t);
}

// A triangulation with an option, of a slit from vertex 1 to vertex 3 and a vertex on each side of it, and a hidden one.
static deldrift_triangulation *slit(deldrift_passing passing) {
    const double places[] = {0, 0, 5, -2, 10, 0, 5, 2, 4, 0, 4, 0};
    deldrift_options options;
    deldrift_options_init(&options);
    options.passing = passing;
    uint32_t segment;
    deldrift_triangulation *t;
    OK(deldrift_create(2, places, 6, &options, &t));
    OK(deldrift_stage_segments(t, (uint32_t[]){1, 3}, NULL, 1, &segment));
    OK(deldrift_commit_timestamp(t, NULL));
    return t;
}

// What is told to pass the slit.
static void expect_passings(const deldrift_triangulation *t, const uint32_t *expected, size_t n) {
    uint32_t segments[8], vertices[8];
    size_t count;
    OK(deldrift_passings(t, segments, vertices, 8, &count));
    CHECK(count == n);
    for (size_t k = 0; k < n; k++) CHECK(segments[k] == 0 && vertices[k] == expected[k]);
}

static size_t saved(const deldrift_triangulation *t, uint8_t *bytes) {
    size_t size;
    OK(deldrift_save(t, bytes, 1 << 12, &size));
    return size;
}

// A vertex that jumps across a slit, and one that is hidden behind it: ignored, told or refused, and asked for.
static void vertices_that_pass_a_segment_are_told(void) {
    static uint8_t before[1 << 12], after[1 << 12];
    const uint32_t both[] = {4, 5};
    const double across[] = {6, 0, 6, 1}, on[] = {5, 0}, over[] = {6, 5};
    const double all[] = {0, 0, 5, -2, 10, 0, 5, 2, 6, 0, 4, 0};
    for (int passing = DELDRIFT_PASSING_IGNORE; passing <= DELDRIFT_PASSING_REFUSE; passing++) {
        deldrift_triangulation *t = slit((deldrift_passing)passing), *copy;
        const bool refuses = passing == DELDRIFT_PASSING_REFUSE;
        const deldrift_status status = refuses ? DELDRIFT_PASSES_SEGMENT : DELDRIFT_OK;
        const size_t one = passing != DELDRIFT_PASSING_IGNORE, two = 2 * one;
        uint64_t timestamp;
        OK(deldrift_move_vertices(t, both, across, 2));
        CHECK_STATUS(deldrift_check_passings(t), DELDRIFT_PASSES_SEGMENT);
        CHECK_MESSAGE("vertex 4 passes segment 0, and there is one more such pair");
        expect_passings(t, both, 2);
        const size_t size = saved(t, before);
        CHECK_STATUS(deldrift_check_staged(t), status);
        expect_passings(t, both, two);
        OK(deldrift_clone(t, &copy));
        expect_passings(copy, NULL, 0);
        CHECK_STATUS(deldrift_commit_timestamp(copy, NULL), status);
        expect_passings(copy, both, two);
        if (refuses) CHECK(saved(copy, after) == size && memcmp(before, after, size) == 0);
        OK(deldrift_timestamp(copy, &timestamp));
        CHECK(timestamp == (refuses ? 1 : 2));
        OK(deldrift_validate(copy, 3));
        deldrift_destroy(copy);
        OK(deldrift_discard_moves(t));
        expect_passings(t, both, two);
        // Ends at the place of a vertex, and around the slit: nothing passes.
        OK(deldrift_move_vertex(t, 4, over));
        OK(deldrift_check_passings(t));
        expect_passings(t, NULL, 0);
        OK(deldrift_discard_moves(t));
        // At once, and all in one call. What would stop on the slit is refused in any case.
        CHECK_STATUS(deldrift_relocate_vertex(t, 5, on), refuses ? DELDRIFT_PASSES_SEGMENT : DELDRIFT_ON_SEGMENT);
        expect_passings(t, both + 1, one);
        CHECK_STATUS(deldrift_commit_positions(t, all, 6, NULL), status);
        expect_passings(t, both, one);
        if (refuses) CHECK_MESSAGE("vertex 4 passes segment 0");
        CHECK_STATUS(deldrift_relocate_vertex(t, 5, across), status);
        expect_passings(t, both + 1, one);
        OK(deldrift_validate(t, 3));
        deldrift_destroy(t);
    }
    // A segment that goes, comes, or has an end that does, is not looked at.
    deldrift_triangulation *t = slit(DELDRIFT_PASSING_REFUSE);
    uint32_t segment;
    OK(deldrift_stage_segment_removals(t, (uint32_t[]){0}, 1));
    OK(deldrift_stage_segments(t, (uint32_t[]){1, 3}, NULL, 1, &segment));
    OK(deldrift_move_vertices(t, both, across, 2));
    OK(deldrift_commit_timestamp(t, NULL));
    expect_passings(t, NULL, 0);
    OK(deldrift_move_vertex(t, 4, all + 10));
    CHECK_STATUS(deldrift_commit_timestamp(t, NULL), DELDRIFT_PASSES_SEGMENT);
    CHECK_MESSAGE("vertex 4 passes segment 1");
    CHECK_BUFFER(uint32_t, 1, 1, deldrift_passings(t, buffer, NULL, capacity, &count));
    CHECK_BUFFER(uint32_t, 1, 1, deldrift_passings(t, NULL, buffer, capacity, &count));
    deldrift_destroy(t);
}

// Copies, compactions and saving take segments along, those that are staged and those that are to go included.
static void copies_have_segments(void) {
    double *positions = random_positions(2, 40, 3);
    deldrift_triangulation *t = create(2, positions, 40, NULL), *copies[3];
    uint32_t segment, map[41];
    size_t count;
    static uint8_t bytes[1 << 16];
    // Two long ones, beside each other.
    for (uint32_t v = 0; v < 4; v++)
        OK(deldrift_relocate_vertex(t, 10 + v, (double[]){v % 2 == 0 ? -1 : 2, v < 2 ? 0.31 : 0.62}));
    OK(deldrift_stage_segments(t, (uint32_t[]){10, 11, 13, 12}, (int32_t[]){4, -5}, 2, &segment));
    OK(deldrift_remove_vertex(t, 3));
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_stage_insertions(t, (double[]){0.5, 3}, 1, &segment));
    OK(deldrift_stage_segments(t, (uint32_t[]){40, 10}, (int32_t[]){6}, 1, &segment));
    OK(deldrift_stage_segment_removals(t, (uint32_t[]){1}, 1));
    for (int k = 0; k < 2; k++) OK(deldrift_clone(t, &copies[k]));
    OK(deldrift_save(t, bytes, sizeof bytes, &count));
    OK(deldrift_load(bytes, count, NULL, &copies[2]));
    OK(deldrift_compact(copies[1], map, 41, &count));
    CHECK(map[10] == 9 && map[40] == 39);
    for (int k = -1; k < 3; k++) {
        deldrift_triangulation *one = k < 0 ? t : copies[k];
        const uint32_t shift = k == 1;
        uint32_t segments[2], ends[4];
        int32_t markers[2];
        OK(deldrift_segments(one, segments, ends, markers, 2, &count));
        CHECK(count == 2 && segments[0] == 0 && segments[1] == 1 && markers[0] == 4 && markers[1] == -5);
        CHECK(ends[0] + shift == 10 && ends[1] + shift == 11 && ends[2] + shift == 13 && ends[3] + shift == 12);
        OK(deldrift_commit_timestamp(one, NULL));
        OK(deldrift_segments(one, segments, ends, markers, 2, &count));
        CHECK(count == 2 && segments[1] == 2 && markers[1] == 6 && ends[2] + shift == 40 && ends[3] + shift == 10);
        CHECK(has_edge(one, ends[0], ends[1]) && has_edge(one, ends[2], ends[3]) && !has_edge(one, 12 - shift, 13 - shift));
        OK(deldrift_validate(one, 3));
        if (one != t) deldrift_destroy(one);
    }
    deldrift_destroy(t);
    free(positions);
}

// Segments that cross are split at a place that is rounded, and pieces of one laid before are removed ones; what is discarded
// is forgotten, and what is refused has no effect.
static void segments_are_split(void) {
    uint32_t segment, ids[6], ends[12];
    int32_t markers[6];
    deldrift_triangulation *t = kite(DELDRIFT_AUTO, &segment);
    deldrift_split_report report = {.inserted = 77}, other;
    deldrift_conflict conflict;
    size_t count;
    OK(deldrift_stage_splits(t, 0, &report));
    CHECK(report.inserted == 0 && report.pieces == 0 && report.rounds == 0);
    CHECK(report.first_vertex == 4 && report.first_piece == segment + 1);
    OK(deldrift_stage_segments(t, (uint32_t[]){3, 1}, (int32_t[]){8}, 1, &segment));
    other = report;
    CHECK_STATUS(deldrift_stage_splits(t, 0, &other), DELDRIFT_CROSSING);
    CHECK_MESSAGE("segments 0 and 1 cross");
    CHECK(memcmp(&report, &other, sizeof other) == 0);
    OK(deldrift_segment_conflicts(t, &conflict, 1, &count));
    CHECK(count == 1 && conflict.segment == 0 && conflict.other == 1);
    for (int round = 0; round < 2; round++) {
        OK(deldrift_stage_splits(t, 1, round == 0 ? NULL : &report));
        if (round == 1) break;
        OK(deldrift_discard_moves(t));
        OK(deldrift_stage_segments(t, (uint32_t[]){3, 1}, (int32_t[]){8}, 1, &segment));
        CHECK(segment == 1);
    }
    CHECK(report.inserted == 1 && report.replaced_segments == 2 && report.pieces == 4 && report.rounds == 1);
    CHECK(report.first_vertex == 4 && report.first_piece == 2);
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_segments(t, ids, ends, markers, 6, &count));
    CHECK(count == 4 && ids[0] == 2 && ids[3] == 5);
    CHECK(memcmp(ends, (uint32_t[]){0, 4, 4, 2, 3, 4, 4, 1}, 8 * sizeof *ends) == 0);
    CHECK(markers[0] == markers[1] && markers[2] == 8 && markers[3] == 8);
    OK(deldrift_validate(t, 3));
    // A vertex that comes on a piece splits it; ends that meet are refused, and nothing is split.
    double middle[2], end[2];
    OK(deldrift_position(t, 4, middle));
    OK(deldrift_position(t, 2, end));
    OK(deldrift_stage_insertions(t, (double[]){(middle[0] + end[0]) / 2, (middle[1] + end[1]) / 2}, 1, &segment));
    OK(deldrift_stage_segments(t, (uint32_t[]){4, 4}, NULL, 1, &segment));
    CHECK_STATUS(deldrift_stage_splits(t, 9, NULL), DELDRIFT_ENDS_MEET);
    CHECK_MESSAGE("both ends of segment 6 are at the same place, and there is one more conflict");
    OK(deldrift_discard_moves(t));
    OK(deldrift_stage_insertions(t, (double[]){(middle[0] + end[0]) / 2, (middle[1] + end[1]) / 2}, 1, &segment));
    OK(deldrift_stage_splits(t, 0, &report));
    CHECK(report.inserted == 0 && report.pieces == 2 && report.first_piece == 6);
    OK(deldrift_commit_timestamp(t, NULL));
    CHECK(has_edge(t, 4, 5) && has_edge(t, 5, 2));
    deldrift_destroy(t);
}

static void arguments_are_checked(void) {
    uint32_t segment;
    deldrift_triangulation *t = kite(DELDRIFT_AUTO, &segment), *solid;
    OK(deldrift_create(3, TETRAHEDRON, TETRAHEDRON_COUNT, NULL, &solid));
    size_t count;
    segment = 77;
    CHECK_STATUS(deldrift_stage_segments(t, (uint32_t[]){0, 1, 2, 9}, NULL, 2, &segment), DELDRIFT_NO_SUCH_VERTEX);
    CHECK_MESSAGE("ends[3] is 9");
    CHECK_STATUS(deldrift_stage_segments(t, NULL, NULL, 1, &segment), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_stage_segments(t, (uint32_t[]){0, 1}, NULL, 1, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_stage_segments(solid, (uint32_t[]){0, 1}, NULL, 1, &segment), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_stage_segment_removals(solid, &segment, 1), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_segments(solid, NULL, NULL, NULL, 0, &count), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_segment_conflicts(solid, NULL, 0, &count), DELDRIFT_INVALID_DIMENSION);
    CHECK_MESSAGE("the dimension of t is 3");
    CHECK(segment == 77);
    OK(deldrift_check_staged(solid));
    CHECK_STATUS(deldrift_check_passings(solid), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_passings(solid, NULL, NULL, 0, &count), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_stage_splits(solid, 1, NULL), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_stage_splits(NULL, 1, NULL), DELDRIFT_NULL_ARGUMENT);
    OK(deldrift_stage_segments(t, (uint32_t[]){0, 1}, NULL, 1, &segment));
    OK(deldrift_commit_timestamp(t, NULL));
    CHECK_BUFFER(uint32_t, 2, 1, deldrift_segments(t, buffer, NULL, NULL, capacity, &count));
    CHECK_BUFFER(uint32_t, 2, 2, deldrift_segments(t, NULL, buffer, NULL, capacity, &count));
    CHECK_BUFFER(int32_t, 2, 1, deldrift_segments(t, NULL, NULL, buffer, capacity, &count));
    deldrift_destroy(t);
    deldrift_destroy(solid);
}

int main(void) {
    a_segment_comes_and_goes();
    immediate_calls_are_refused();
    vertices_beside_a_segment_do_not_slip_over_it();
    segments_that_cross_are_refused();
    vertices_that_pass_a_segment_are_told();
    copies_have_segments();
    segments_are_split();
    arguments_are_checked();
    random_histories_are_as_the_definition_says();
    return 0;
}
