// What segments divide the plane into, compared with floods of the cells made here, and with areas and places that are known.
#include "buffers.h"

enum { SIDE = 6, RING = 4 * SIDE, HOLE = 12, INSIDE = 160, COUNT = RING + HOLE + INSIDE, SEGMENTS = RING + HOLE };
enum { ROOM = 2 * COUNT, WALL = 1, ROTOR = 2 };

static double places[2 * COUNT];

// A square from 0 to 4 and a hole of two radii that is turned; other vertices anywhere, also beyond the square.
static void turn_hole(double angle) {
    for (int k = 0; k < HOLE; k++) {
        const double a = 2 * acos(-1) * k / HOLE, x = 1.2 * cos(a), y = 0.6 * sin(a);
        places[2 * (RING + k)] = 2 + cos(angle) * x - sin(angle) * y;
        places[2 * (RING + k) + 1] = 2 + sin(angle) * x + cos(angle) * y;
    }
}

static deldrift_triangulation *domain(void) {
    uint64_t seed = 4;
    for (int k = 0; k < SIDE; k++) {
        const double s = 4.0 * k / SIDE, sides[4][2] = {{s, 0}, {4, s}, {4 - s, 4}, {0, 4 - s}};
        for (int j = 0; j < 4; j++) memcpy(places + 2 * (j * SIDE + k), sides[j], sizeof *sides);
    }
    turn_hole(0);
    for (size_t i = 2 * (RING + HOLE); i < 2 * COUNT; i++) places[i] = 5 * next_random(&seed) - 0.5;
    deldrift_triangulation *t = create(2, places, COUNT, NULL);
    uint32_t ends[SEGMENTS][2], first;
    int32_t markers[SEGMENTS];
    for (uint32_t k = 0; k < SEGMENTS; k++) {
        const bool is_wall = k < RING;
        ends[k][0] = k;
        ends[k][1] = is_wall ? (k + 1) % RING : RING + (k - RING + 1) % HOLE;
        markers[k] = is_wall ? WALL : ROTOR;
    }
    OK(deldrift_stage_segments(t, ends[0], markers, SEGMENTS, &first));
    OK(deldrift_commit_timestamp(t, NULL));
    return t;
}

typedef struct {
    size_t n, n_segments;
    deldrift_cells_view view;
    uint32_t at_edges[ROOM][3], levels[ROOM], beside[2 * SEGMENTS][2];
    uint32_t segments[2 * SEGMENTS], ends[2 * SEGMENTS][2];
} seen;

static seen s;

static void look(const deldrift_triangulation *t) {
    s.view = cells_of(t);
    OK(deldrift_segments_of_cells(t, s.at_edges[0], ROOM, &s.n));
    CHECK(s.n == s.view.count);
    OK(deldrift_nesting_levels(t, s.levels, ROOM, &s.n));
    OK(deldrift_segments(t, s.segments, s.ends[0], NULL, 2 * SEGMENTS, &s.n_segments));
    OK(deldrift_cells_of_segments(t, s.beside[0], 2 * SEGMENTS, &s.n));
    CHECK(s.n == s.n_segments);
    s.n = s.view.count;
}

static uint32_t shown(const deldrift_triangulation *t, uint32_t v) {
    OK(deldrift_coincident_representative(t, v, &v));
    return v;
}

// The segment between two vertices, and the cell to the left of an edge, looked for among all.
static void check_sides(const deldrift_triangulation *t) {
    for (size_t c = 0; c < s.n; c++) {
        for (size_t i = 0; i < 3; i++) {
            const uint32_t *v = s.view.vertices + 3 * c, a = v[(i + 1) % 3], b = v[(i + 2) % 3];
            uint32_t wanted = DELDRIFT_NONE;
            for (size_t k = s.n_segments; k-- > 0;) {
                const uint32_t p = shown(t, s.ends[k][0]), q = shown(t, s.ends[k][1]);
                if ((p == a && q == b) || (p == b && q == a)) wanted = s.segments[k];
                if (p == a && q == b) CHECK(s.beside[k][0] == c && s.beside[k][1] == s.view.neighbours[3 * c + i]);
                if (p == b && q == a) CHECK(s.beside[k][1] == c && s.beside[k][0] == s.view.neighbours[3 * c + i]);
            }
            CHECK(s.at_edges[c][i] == wanted);
        }
    }
}

// Levels are lengths of ways: each cell's is that of a neighbour or of the outside, or one more where a segment is crossed,
// and the least that is so.
static void check_levels(void) {
    static uint32_t wanted[ROOM];
    for (size_t c = 0; c < s.n; c++) wanted[c] = UINT32_MAX;
    for (bool has_changed = true; has_changed;) {
        has_changed = false;
        for (size_t c = 0; c < s.n; c++) {
            for (size_t i = 0; i < 3; i++) {
                const uint32_t across = s.view.neighbours[3 * c + i], from = across == DELDRIFT_NONE ? 0 : wanted[across];
                if (from == UINT32_MAX) continue;
                const uint32_t level = from + (s.at_edges[c][i] != DELDRIFT_NONE);
                if (level >= wanted[c]) continue;
                wanted[c] = level;
                has_changed = true;
            }
        }
    }
    CHECK(memcmp(wanted, s.levels, s.n * sizeof *wanted) == 0);
}

// Regions by joining cells, without an order; the label of the first seed in each.
static void check_labels(const deldrift_triangulation *t, const double *seeds, const int32_t *labels, size_t n_seeds) {
    static size_t region[ROOM];
    static int32_t told[ROOM];
    for (size_t c = 0; c < s.n; c++) region[c] = c;
    for (bool has_changed = true; has_changed;) {
        has_changed = false;
        for (size_t c = 0; c < s.n; c++) {
            for (size_t i = 0; i < 3; i++) {
                const uint32_t across = s.view.neighbours[3 * c + i];
                if (across == DELDRIFT_NONE || s.at_edges[c][i] != DELDRIFT_NONE || region[across] >= region[c]) continue;
                region[c] = region[across];
                has_changed = true;
            }
        }
    }
    size_t count;
    OK(deldrift_label_cells(t, seeds, labels, n_seeds, -99, told, ROOM, &count));
    CHECK(count == s.n);
    size_t n_labelled = 0;
    for (size_t c = 0; c < s.n; c++) {
        int32_t wanted = -99;
        for (size_t k = n_seeds; k-- > 0;) {
            deldrift_location location;
            OK(deldrift_locate(t, seeds + 2 * k, &location));
            if (location.kind == DELDRIFT_LOCATION_CELL && region[location.index] == region[c]) wanted = labels[k];
        }
        CHECK(told[c] == wanted);
        n_labelled += wanted != -99;
    }
    CHECK(n_labelled > 0);
}

// The chains of a mask, whose edges are those of deldrift_mask_boundary; how many there are.
static uint32_t check_chains(const deldrift_triangulation *t, const uint8_t *mask) {
    static uint32_t vertices[ROOM], chains[ROOM], segments[ROOM], cells[ROOM], facets[ROOM][2], cells_of_facets[ROOM];
    static uint8_t corners[ROOM], corners_of_facets[ROOM];
    size_t n, n_facets;
    OK(deldrift_boundary_chains(t, mask, s.n, vertices, chains, segments, cells, corners, ROOM, &n));
    OK(deldrift_mask_boundary(t, mask, s.n, facets[0], cells_of_facets, corners_of_facets, ROOM, &n_facets));
    CHECK(n == n_facets);
    uint32_t before[2] = {0, 0};
    for (size_t k = 0, first = 0; k < n; k++) {
        const bool starts = k == 0 || chains[k] != chains[k - 1], ends = k + 1 == n || chains[k + 1] != chains[k];
        if (starts) first = k;
        const uint32_t edge[] = {vertices[k], vertices[ends ? first : k + 1]};
        size_t f = 0;
        while (f < n && memcmp(facets[f], edge, sizeof edge) != 0) f++;
        CHECK(f < n && cells_of_facets[f] == cells[k] && corners_of_facets[f] == corners[k]);
        CHECK(segments[k] == s.at_edges[cells[k]][corners[k]]);
        if (!starts) {
            CHECK(edge[0] > vertices[first] || (edge[0] == vertices[first] && edge[1] > vertices[first + 1]));
            continue;
        }
        CHECK(chains[k] == (k == 0 ? 0 : chains[k - 1] + 1));
        CHECK(k == 0 || edge[0] > before[0] || (edge[0] == before[0] && edge[1] > before[1]));
        memcpy(before, edge, sizeof edge);
    }
    return n == 0 ? 0 : chains[n - 1] + 1;
}

static void check_all(const deldrift_triangulation *t, uint64_t *seed) {
    look(t);
    check_sides(t);
    check_levels();
    const double seeds[] = {2, 2, 0.01, 2.2, 2, 2.3, 9, 9, -0.2, 2};
    const int32_t labels[] = {7, -3, 8, 5, INT32_MIN};
    check_labels(t, seeds, labels, 5);
    check_labels(t, seeds + 2, labels, 1);
    uint8_t mask[ROOM];
    for (size_t c = 0; c < s.n; c++) mask[c] = next_random(seed) < 0.4 ? (uint8_t)(1 + c % 255) : 0;
    CHECK(check_chains(t, mask) > 1);
    memset(mask, 0, sizeof mask);
    CHECK(check_chains(t, mask) == 0);
    memset(mask, 1, sizeof mask);
    CHECK(check_chains(t, mask) == 1);
}

static void a_domain_keeps_its_areas_while_its_hole_turns(void) {
    uint64_t seed = 8;
    deldrift_triangulation *t = domain();
    for (int step = 0; step < 30; step++) {
        turn_hole(0.11 * step);
        uint32_t moving[HOLE];
        for (uint32_t k = 0; k < HOLE; k++) moving[k] = RING + k;
        OK(deldrift_move_vertices(t, moving, places + 2 * RING, HOLE));
        OK(deldrift_commit_timestamp(t, NULL));
        check_all(t, &seed);
        double volumes[ROOM], areas[3] = {0, 0, 0}, hole = 0;
        uint8_t mask[ROOM];
        size_t count;
        OK(deldrift_volumes(t, volumes, ROOM, &count));
        for (size_t c = 0; c < count; c++) {
            CHECK(s.levels[c] < 3);
            areas[s.levels[c]] += volumes[c];
            mask[c] = s.levels[c] == 1;
        }
        for (size_t k = 0; k < HOLE; k++) {
            const double *a = places + 2 * (RING + k), *b = places + 2 * (RING + (k + 1) % HOLE);
            hole += (a[0] * b[1] - a[1] * b[0]) / 2;
        }
        CHECK(fabs(areas[1] - (16 - hole)) < 1e-12 && fabs(areas[2] - hole) < 1e-12 && areas[0] > 1);
        CHECK(check_chains(t, mask) == 2);
    }
    deldrift_destroy(t);
}

static void slits_and_islands_have_levels(void) {
    uint64_t seed = 9;
    deldrift_triangulation *t = domain();
    uint32_t first, island;
    // An island in the hole, a slit in the domain, an open chain at its wall; one at the edge of another.
    const double corners[] = {1.9, 1.9, 2.1, 1.9, 2, 2.1, 0.2, 0.3, 0.4, 3.1};
    OK(deldrift_stage_insertions(t, corners, 5, &island));
    const uint32_t a = island, more[] = {a, a + 1, a + 1, a + 2, a + 2, a, a + 3, a + 4, 0, a + 3, a + 2, a + 1};
    OK(deldrift_stage_segments(t, more, NULL, 6, &first));
    OK(deldrift_commit_timestamp(t, NULL));
    check_all(t, &seed);
    bool is_seen[5] = {false};
    for (size_t c = 0; c < s.n; c++) is_seen[s.levels[c] > 3 ? 4 : s.levels[c]] = true;
    CHECK(is_seen[0] && is_seen[1] && is_seen[2] && is_seen[3] && !is_seen[4]);
    // Vertices at the place of ends that have higher ids: they take the segments over.
    OK(deldrift_relocate_vertex(t, COUNT - 1, corners + 6));
    OK(deldrift_remove_vertex(t, COUNT - 2));
    check_all(t, &seed);
    // On a segment that divides nothing a seed is in one region; on a wall it is in two.
    int32_t told[ROOM];
    const int32_t label = 1;
    size_t count;
    OK(deldrift_label_cells(t, corners + 6, &label, 1, 0, told, ROOM, &count));
    CHECK_STATUS(deldrift_label_cells(t, places, &label, 1, 0, told, ROOM, &count), DELDRIFT_AMBIGUOUS_SEED);
    CHECK_MESSAGE("seeds[0] is on the boundary of several regions");
    const double twice[] = {2, 2, places[2 * RING], places[2 * RING + 1]};
    CHECK_STATUS(deldrift_label_cells(t, twice, (int32_t[]){1, 2}, 2, 0, told, ROOM, &count), DELDRIFT_AMBIGUOUS_SEED);
    CHECK_MESSAGE("seeds[1]");
    deldrift_destroy(t);
}

// The outside is a region: a seed on the outline of a domain, or at a corner of it, is between two.
static void outlines_are_boundaries(void) {
    const double square[] = {0, 0, 4, 0, 4, 4, 0, 4}, seeds[] = {4, 2, 4, 4, 2, 0, 0, 0};
    const uint32_t sides[] = {0, 1, 1, 2, 2, 3, 3, 0};
    const int32_t label = 5;
    int32_t told[ROOM];
    uint32_t first;
    size_t count;
    deldrift_triangulation *t = create(2, square, 4, NULL);
    OK(deldrift_stage_segments(t, sides, NULL, 4, &first));
    OK(deldrift_commit_timestamp(t, NULL));
    for (size_t k = 0; k < 4; k++) {
        CHECK_STATUS(deldrift_label_cells(t, seeds + 2 * k, &label, 1, 0, told, ROOM, &count), DELDRIFT_AMBIGUOUS_SEED);
        CHECK_MESSAGE("seeds[0] is on the boundary of several regions");
    }
    // Without one of its sides the domain and the outside are one region.
    OK(deldrift_stage_segment_removals(t, &first, 1));
    OK(deldrift_commit_timestamp(t, NULL));
    for (size_t k = 0; k < 4; k++) {
        OK(deldrift_label_cells(t, seeds + 2 * k, &label, 1, 0, told, ROOM, &count));
        CHECK(count == 2 && told[0] == 5 && told[1] == 5);
    }
    deldrift_destroy(t);
}

// Two triangles of a mask that touch in a vertex have a chain each; a ring of cells has two.
static void chains_do_not_cross(void) {
    const double bow[] = {0, 0, 2, -1, 2, 1, -2, -1, -2, 1};
    deldrift_triangulation *t = create(2, bow, 5, NULL);
    look(t);
    CHECK(s.n == 4);
    uint8_t mask[4];
    for (size_t c = 0; c < 4; c++) {
        const uint32_t *v = s.view.vertices + 3 * c;
        mask[c] = (has_corner(v, 3, 1) && has_corner(v, 3, 2)) || (has_corner(v, 3, 3) && has_corner(v, 3, 4));
    }
    CHECK(check_chains(t, mask) == 2);
    for (size_t c = 0; c < 4; c++) mask[c] = !mask[c];
    CHECK(check_chains(t, mask) == 2);
    deldrift_destroy(t);
}

static double area_of_odd(const deldrift_triangulation *t, const uint32_t *numbers) {
    static double areas[ROOM];
    size_t n;
    double sum = 0;
    OK(deldrift_volumes(t, areas, ROOM, &n));
    for (size_t c = 0; c < n; c++) sum += numbers[c] % 2 == 1 ? areas[c] : 0;
    return sum;
}

// A square with a notch that is a chain of its own along a side, and the square twice: segments count each, or as one wall.
static void shared_sides_count_each(void) {
    const double corners[] = {0, 0, 4, 0, 4, 4, 0, 4, 1, 0, 3, 0, 3, 2, 1, 2};
    const uint32_t square[] = {0, 4, 4, 5, 5, 1, 1, 2, 2, 3, 3, 0}, notch[] = {4, 5, 5, 6, 6, 7, 7, 4};
    for (int is_notch = 0; is_notch < 2; is_notch++) {
        deldrift_triangulation *t = create(2, corners, is_notch ? 8 : 6, NULL);
        static uint32_t numbers[ROOM];
        uint32_t first;
        size_t count;
        OK(deldrift_stage_segments(t, square, NULL, 6, &first));
        OK(deldrift_stage_segments(t, is_notch ? notch : square, NULL, is_notch ? 4 : 6, &first));
        OK(deldrift_commit_timestamp(t, NULL));
        look(t);
        check_levels();
        OK(deldrift_crossing_numbers(t, numbers, ROOM, &count));
        CHECK(count == s.n && area_of_odd(t, s.levels) == 16 && area_of_odd(t, numbers) == (is_notch ? 12 : 0));
        deldrift_destroy(t);
    }
}

static void without_cells_there_is_nothing(void) {
    const double line[] = {0, 0, 1, 1, 2, 2};
    deldrift_triangulation *t = create(2, line, 3, NULL);
    uint32_t segment, cells[2] = {7, 7};
    size_t count;
    OK(deldrift_stage_segments(t, (uint32_t[]){0, 1}, NULL, 1, &segment));
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_cells_of_segments(t, cells, 1, &count));
    CHECK(count == 1 && cells[0] == DELDRIFT_NONE && cells[1] == DELDRIFT_NONE);
    OK(deldrift_nesting_levels(t, NULL, 0, &count));
    CHECK(count == 0);
    OK(deldrift_crossing_numbers(t, NULL, 0, &count));
    CHECK(count == 0);
    OK(deldrift_label_cells(t, line, (int32_t[]){1}, 1, 0, NULL, 0, &count));
    OK(deldrift_segments_of_cells(t, NULL, 0, &count));
    OK(deldrift_boundary_chains(t, NULL, 0, NULL, NULL, NULL, NULL, NULL, 0, &count));
    CHECK(count == 0);
    OK(deldrift_stage_segments(t, (uint32_t[]){0, 2}, NULL, 1, &segment));
    CHECK_STATUS(deldrift_commit_timestamp(t, NULL), DELDRIFT_ON_SEGMENT);
    deldrift_destroy(t);
}

// Labels that are brought up to date by the changes are those of seeds.
static void labels_follow_the_changes(void) {
    deldrift_triangulation *t = domain();
    static int32_t labels[ROOM], anew[ROOM], old[ROOM];
    const double seeds[] = {2, 2, 0.01, 0.02};
    const int32_t of_seeds[] = {7, 8};
    size_t n, n_created = 0, n_passed = 0;
    deldrift_changes changes;
    OK(deldrift_take_changes(t, &changes));
    OK(deldrift_label_cells(t, seeds, of_seeds, 2, -1, labels, ROOM, &n));
    for (int step = 1; step <= 300; step++) {
        turn_hole(0.01 * step);
        OK(deldrift_move_vertices(t, NULL, places, COUNT));
        const deldrift_status passed = deldrift_check_passings(t);
        OK(deldrift_commit_timestamp(t, NULL));
        OK(deldrift_take_changes(t, &changes));
        memcpy(old, labels, sizeof old);
        for (size_t k = 0; k < changes.renumbered_count; k++) labels[changes.renumbered_to[k]] = old[changes.renumbered_from[k]];
        size_t undecided = 77;
        OK(deldrift_update_labels(t, changes.created, changes.created_count, -1, labels, ROOM, &undecided));
        n_created += changes.created_count;
        n_passed += passed == DELDRIFT_PASSES_SEGMENT;
        OK(deldrift_label_cells(t, seeds, of_seeds, 2, -1, anew, ROOM, &n));
        // Where vertices pass segments, cells may be in another region.
        CHECK(passed == DELDRIFT_PASSES_SEGMENT || (undecided == 0 && memcmp(labels, anew, n * sizeof *anew) == 0));
        memcpy(labels, anew, sizeof labels);
    }
    CHECK(n_created > 500 && n_passed > 10 && n_passed < 150);
    deldrift_destroy(t);
}

// Labels that the library keeps are those of seeds, without any changes, through refinement, a clone and saved data.
static void labels_of_regions_follow(void) {
    enum { REFINED = 4096 };
    deldrift_triangulation *t = domain(), *other = NULL;
    static int32_t labels[REFINED], anew[REFINED];
    static uint8_t bytes[1 << 20];
    const double seeds[] = {2, 2, 0.01, 0.02};
    const int32_t of_seeds[] = {-7, 1};
    const double areas[] = {0, 0.1};
    deldrift_quality quality;
    deldrift_quality_report report;
    uint64_t inserted = 0;
    size_t n, size, undecided;
    OK(deldrift_quality_init(&quality));
    quality.domain = DELDRIFT_DOMAIN_REGIONS;
    quality.areas = areas;
    quality.area_count = 2;
    // Without labels no cell is in it.
    OK(deldrift_refine(t, &quality, NULL, 0, &report));
    CHECK(report.inserted == 0 && report.bad_cells == 0);
    OK(deldrift_label_cells(t, seeds, of_seeds, 2, 0, labels, REFINED, &n));
    OK(deldrift_set_regions(t, labels, n));
    for (int step = 1; step <= 60; step++) {
        turn_hole(0.01 * step);
        for (uint32_t v = 0; v < COUNT; v++) OK(deldrift_move_vertex(t, v, places + 2 * v));
        if (deldrift_commit_timestamp(t, NULL) != DELDRIFT_OK) {
            OK(deldrift_discard_moves(t));
            continue;
        }
        OK(deldrift_coarsen(t, &quality, NULL, 0, &report));
        OK(deldrift_refine(t, &quality, NULL, 0, &report));
        inserted += report.inserted;
        OK(deldrift_label_cells(t, seeds, of_seeds, 2, 0, anew, REFINED, &n));
        OK(deldrift_regions(t, 0, labels, REFINED, &n, &undecided));
        CHECK(undecided == 0 && memcmp(labels, anew, n * sizeof *anew) == 0);
        if (step % 20 != 0) continue;
        OK(deldrift_clone(t, &other));
        OK(deldrift_regions(other, 0, labels, REFINED, &n, NULL));
        CHECK(memcmp(labels, anew, n * sizeof *anew) == 0);
        deldrift_destroy(other);
        OK(deldrift_save(t, bytes, sizeof bytes, &size));
        OK(deldrift_load(bytes, size, NULL, &other));
        OK(deldrift_regions(other, 0, labels, REFINED, &n, &undecided));
        CHECK(undecided == 0 && memcmp(labels, anew, n * sizeof *anew) == 0);
        deldrift_destroy(other);
    }
    CHECK(inserted > 20);
    // Labels that are taken away leave regions undecided; where some sides have labels, refinement says so.
    OK(deldrift_set_regions(t, NULL, 0));
    OK(deldrift_regions(t, 0, labels, REFINED, &n, &undecided));
    CHECK(undecided > 0);
    static uint32_t ids[REFINED];
    static int32_t markers[REFINED];
    OK(deldrift_segments(t, ids, NULL, markers, REFINED, &n));
    int32_t label = 4;
    for (size_t k = 0; k < n; k++) {
        if (markers[k] != WALL) continue;
        OK(deldrift_set_segment_sides(t, ids + k, (const int32_t[]){label, label}, 1));
        label = 5;
    }
    OK(deldrift_regions(t, 0, labels, REFINED, &n, &undecided));
    CHECK(undecided > 0);
    CHECK_STATUS(deldrift_refine(t, &quality, NULL, 0, &report), DELDRIFT_UNDECIDED_REGIONS);
    CHECK_MESSAGE("cells are in regions whose sides have no label, or several");
    CHECK_STATUS(deldrift_coarsen(t, &quality, NULL, 0, &report), DELDRIFT_UNDECIDED_REGIONS);
    quality.domain = (deldrift_domain)4;
    CHECK_STATUS(deldrift_refine(t, &quality, NULL, 0, &report), DELDRIFT_INVALID_OPTIONS);
    CHECK_MESSAGE("quality.domain is 4");
    deldrift_destroy(t);
}

static void arguments_are_checked(void) {
    const double corners[] = {0, 0, 4, 0, 4, 4, 0, 4, 1, 2};
    deldrift_triangulation *t = create(2, corners, 5, NULL), *solid = create(3, TETRAHEDRON, TETRAHEDRON_COUNT, NULL);
    const uint8_t mask[] = {1, 0, 1, 0};
    const int32_t label = 3;
    uint32_t ids[8], first;
    int32_t told[8] = {0};
    size_t count;
    OK(deldrift_stage_segments(t, (uint32_t[]){0, 4, 4, 2}, NULL, 2, &first));
    OK(deldrift_commit_timestamp(t, NULL));
    CHECK(cell_count(t) == 4);
    CHECK_BUFFER(uint32_t, 4, 3, deldrift_segments_of_cells(t, buffer, capacity, &count));
    CHECK_BUFFER(uint32_t, 2, 2, deldrift_cells_of_segments(t, buffer, capacity, &count));
    CHECK_BUFFER(uint32_t, 4, 1, deldrift_nesting_levels(t, buffer, capacity, &count));
    CHECK_BUFFER(uint32_t, 4, 1, deldrift_crossing_numbers(t, buffer, capacity, &count));
    CHECK_BUFFER(int32_t, 4, 1, deldrift_label_cells(t, corners + 2, &label, 1, 0, buffer, capacity, &count));
    OK(deldrift_boundary_chains(t, mask, 4, NULL, NULL, NULL, NULL, NULL, 0, &count));
    const size_t n = count;
    CHECK_BUFFER(uint32_t, n, 1, deldrift_boundary_chains(t, mask, 4, buffer, NULL, NULL, NULL, NULL, capacity, &count));
    CHECK_BUFFER(uint32_t, n, 1, deldrift_boundary_chains(t, mask, 4, NULL, buffer, NULL, NULL, NULL, capacity, &count));
    CHECK_BUFFER(uint32_t, n, 1, deldrift_boundary_chains(t, mask, 4, NULL, NULL, buffer, NULL, NULL, capacity, &count));
    CHECK_BUFFER(uint32_t, n, 1, deldrift_boundary_chains(t, mask, 4, NULL, NULL, NULL, buffer, NULL, capacity, &count));
    CHECK_BUFFER(uint8_t, n, 1, deldrift_boundary_chains(t, mask, 4, NULL, NULL, NULL, NULL, buffer, capacity, &count));
    CHECK_STATUS(deldrift_boundary_chains(t, mask, 3, NULL, NULL, NULL, NULL, NULL, 0, &count), DELDRIFT_WRONG_COUNT);
    const double bad[] = {1, 1, NAN, 0};
    CHECK_STATUS(deldrift_label_cells(t, bad, (int32_t[]){1, 2}, 2, 0, told, 8, &count), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("seeds[1], coordinate 0, is NaN");
    CHECK_STATUS(deldrift_label_cells(t, bad, NULL, 1, 0, told, 8, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("labels is NULL");
    CHECK_STATUS(deldrift_label_cells(solid, bad, &label, 1, 0, told, 8, &count), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_update_labels(solid, ids, 0, 0, told, 8, &count), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_update_labels(t, (const uint32_t[]){9}, 1, 0, told, 8, &count), DELDRIFT_NO_SUCH_FACET);
    CHECK_MESSAGE("cells[0] is 9");
    CHECK_STATUS(deldrift_update_labels(t, NULL, 0, 0, told, 0, &count), DELDRIFT_BUFFER_TOO_SMALL);
    CHECK_STATUS(deldrift_update_labels(t, NULL, 0, 0, told, 8, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_BUFFER(int32_t, 4, 1, deldrift_regions(t, 0, buffer, capacity, &count, NULL));
    CHECK_STATUS(deldrift_set_regions(t, (const int32_t[]){1, 2, 1, 1}, 4), DELDRIFT_INVALID_VALUE);
    CHECK_STATUS(deldrift_set_regions(t, (const int32_t[]){1, 1, 1}, 3), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("label_count is 3, but must be 4");
    CHECK_STATUS(deldrift_set_regions(solid, NULL, 0), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_regions(solid, 0, told, 8, &count, NULL), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_set_segment_sides(solid, NULL, NULL, 0), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_set_segment_sides(t, (const uint32_t[]){0, 9}, told, 2), DELDRIFT_NO_SUCH_SEGMENT);
    CHECK_MESSAGE("segments[1] is 9");
    CHECK_STATUS(deldrift_nesting_levels(solid, ids, 8, &count), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_crossing_numbers(solid, ids, 8, &count), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_segments_of_cells(solid, ids, 2, &count), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_cells_of_segments(solid, ids, 4, &count), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_boundary_chains(solid, mask, 4, ids, NULL, NULL, NULL, NULL, 8, &count), DELDRIFT_INVALID_DIMENSION);
    deldrift_destroy(t);
    deldrift_destroy(solid);
}

int main(void) {
    a_domain_keeps_its_areas_while_its_hole_turns();
    slits_and_islands_have_levels();
    outlines_are_boundaries();
    chains_do_not_cross();
    shared_sides_count_each();
    without_cells_there_is_nothing();
    labels_follow_the_changes();
    labels_of_regions_follow();
    arguments_are_checked();
    return 0;
}
