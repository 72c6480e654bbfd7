// A tour of what the other examples do not use: changing one vertex at a time, and all that can be asked of a
// triangulation. Each stop says what is expected, and is compared with it.
#include <deldrift.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 20, VERTICES = SIDE * SIDE, MOST = 4 * VERTICES };  // MOST: more than there are of anything

static void check(deldrift_status status) {
    if (status == DELDRIFT_OK) return;
    fprintf(stderr, "%s: %s\n", deldrift_status_string(status), deldrift_last_error());
    exit(1);
}

static int n_expected, n_found;

static void expect(bool is_so, const char *what) {
    n_expected++, n_found += is_so;
    if (!is_so) printf("not so: %s\n", what);
}

static bool is_near(double a, double b) { return fabs(a - b) < 1e-12; }

static void change_one_at_a_time(deldrift_triangulation *t) {
    uint32_t vertex, kept;
    size_t vertices, ids, staged, count;
    double position[2];
    bool is_present;
    check(deldrift_insert_vertex(t, (double[]){0.5, 0.5}, &vertex));
    check(deldrift_relocate_vertex(t, vertex, (double[]){0.51, 0.5}));
    check(deldrift_move_vertex(t, vertex, (double[]){0.52, 0.5}));  // for the next commit, which does not come
    check(deldrift_staged_count(t, &staged));
    check(deldrift_discard_moves(t));
    check(deldrift_position(t, vertex, position));
    expect(staged == 1 && position[0] == 0.51, "a discarded move leaves the vertex where it was");
    check(deldrift_insert_vertex(t, position, &kept));  // at the same place
    check(deldrift_coincident_representative(t, kept, &vertex));
    expect(vertex == kept - 1, "of vertices at the same place the lowest id represents them");
    check(deldrift_remove_vertex(t, vertex));
    check(deldrift_remove_vertex(t, kept));
    check(deldrift_is_present(t, kept, &is_present));
    check(deldrift_vertex_count(t, &vertices));
    check(deldrift_id_count(t, &ids));
    expect(!is_present && vertices == VERTICES && ids == VERTICES + 2, "ids of removed vertices remain");
    check(deldrift_compact(t, NULL, 0, &count));
    check(deldrift_id_count(t, &ids));
    expect(count == VERTICES + 2 && ids == VERTICES, "until the triangulation is compacted");
    uint64_t timestamp;
    deldrift_algorithm algorithm;
    deldrift_commit_report all;
    deldrift_changes changes;
    check(deldrift_set_algorithm(t, DELDRIFT_REBUILDING));
    check(deldrift_get_algorithm(t, &algorithm));
    check(deldrift_take_changes(t, &changes));  // the first time all cells
    check(deldrift_move_vertex(t, 0, (double[]){-0.01, -0.01}));
    check(deldrift_commit_timestamp(t, NULL));
    check(deldrift_timestamp(t, &timestamp));
    check(deldrift_statistics(t, &all));
    check(deldrift_take_changes(t, &changes));
    expect(algorithm == DELDRIFT_REBUILDING && timestamp == 1 && all.rebuilds == 1, "a commit that rebuilds");
    expect(changes.created_count < 10, "changes few cells if one vertex moves");
}

static void ask_for_places(const deldrift_triangulation *t) {
    static double positions[2 * VERTICES], values[VERTICES];
    size_t count;
    check(deldrift_copy_positions(t, positions, VERTICES, &count));
    for (size_t v = 0; v < count; v++) values[v] = 3 * positions[2 * v] - positions[2 * v + 1];
    const double places[] = {0.3, 0.7, 2, 2}, outside = -1;
    deldrift_location at, locations[2];
    uint32_t nearest;
    check(deldrift_locate(t, places, &at));
    check(deldrift_locate_points(t, places, 2, &at, locations));
    expect(locations[0].index == at.index && locations[1].kind == DELDRIFT_LOCATION_OUTSIDE, "places are located");
    check(deldrift_nearest_vertex(t, places, &nearest));
    expect(hypot(positions[2 * nearest] - 0.3, positions[2 * nearest + 1] - 0.7) < 1.0 / SIDE, "a vertex is near");
    double results[2];
    check(deldrift_interpolate(t, DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR, values, VERTICES, 1, places, 2, NULL,
                               &outside, results));
    expect(is_near(results[0], 3 * 0.3 - 0.7) && results[1] == -1, "linear functions are reproduced");
    double tolerance;
    check(deldrift_tolerance(t, nearest, &tolerance));
    expect(tolerance > 0 && tolerance < 1.0 / SIDE, "a vertex may move by less than the spacing");
}

static void ask_what_is_near(deldrift_triangulation *t) {
    static double positions[2 * VERTICES];
    static uint32_t found[MOST];
    const double place[] = {0.3, 0.7}, width = 2.0 / SIDE;
    const double low[] = {place[0] - width, -INFINITY}, high[] = {place[0] + width, INFINITY};
    uint32_t nearest, near[6], vertex;
    size_t count, n_between = 0, n_cells, n_conflicts;
    check(deldrift_copy_positions(t, positions, VERTICES, &count));
    check(deldrift_nearest_vertex(t, place, &nearest));
    check(deldrift_nearest_vertices(t, place, 1, 6, near));
    const double *farthest = positions + 2 * near[5];
    const double radius = hypot(farthest[0] - place[0], farthest[1] - place[1]);
    check(deldrift_vertices_in_ball(t, place, 1.000001 * radius * radius, found, MOST, &count));
    expect(near[0] == nearest && count == 6, "the six nearest vertices are those in the circle to the sixth");
    // The neighbours of all vertices in a radius, each pair once.
    static size_t begins[VERTICES + 1];
    static uint32_t neighbours[8 * VERTICES];
    const double squared_radius = 1.5 / (SIDE * SIDE);
    check(deldrift_neighbour_lists(t, &squared_radius, 1, NULL, 0, DELDRIFT_PAIRS_HALF, begins, VERTICES + 1, neighbours, NULL,
                                   8 * VERTICES, &count));
    for (size_t v = 0; v < VERTICES; v++) {
        for (size_t i = begins[v]; i < begins[v + 1]; i++) {
            const double *p = positions + 2 * v, *q = positions + 2 * neighbours[i];
            expect(neighbours[i] > v && hypot(p[0] - q[0], p[1] - q[1]) < 1.3 / SIDE, "neighbours are near");
        }
    }
    for (size_t v = 0; v < VERTICES; v++) n_between += low[0] <= positions[2 * v] && positions[2 * v] <= high[0];
    check(deldrift_vertices_in_box(t, low, high, found, MOST, &count));
    expect(count == n_between && count > SIDE, "a strip is a box without an end");

    // A vertex here would remove some triangles, and have two more around it.
    check(deldrift_conflicts(t, place, NULL, found, MOST, &n_conflicts));
    check(deldrift_cell_count(t, &n_cells));
    check(deldrift_insert_vertex(t, place, &vertex));
    check(deldrift_star(t, vertex, NULL, 0, &count));
    expect(count == n_conflicts + 2, "what an insertion would do is known before");
    check(deldrift_remove_vertex(t, vertex));
    check(deldrift_compact(t, NULL, 0, &count));
    check(deldrift_cell_count(t, &count));
    expect(count == n_cells, "and undone by a removal");
}

// What a vertex beyond the right side could change: the cells and edges there, whose corners another process would need.
static void ask_what_is_in_reach(deldrift_triangulation *t) {
    static uint32_t cells[MOST], edges[MOST], vertices[MOST];
    static uint8_t corners[MOST];
    static double centres[2 * MOST], radii[MOST];
    const double low[] = {1.5, -INFINITY}, high[] = {INFINITY, INFINITY};
    size_t n_cells, n_edges, count, offsets[2];
    check(deldrift_cells_in_reach(t, low, high, 1, NULL, 0, cells, centres, radii, MOST, &n_cells));
    for (size_t k = 0; k < n_cells; k++) {
        expect(centres[2 * k] + radii[k] >= low[0], "the circle of each cell in reach comes to the box");
    }
    check(deldrift_hull_facets_in_reach(t, low, high, 1, NULL, 0, edges, corners, MOST, &n_edges));
    expect(n_edges > 0, "from far away a part of the hull is seen");
    check(deldrift_vertices_in_reach(t, low, high, 1, NULL, 0, vertices, offsets, MOST, &count));
    expect(offsets[0] == 0 && offsets[1] == count && count > n_edges, "one list, with both ends of all edges");
}

static void ask_for_corners(deldrift_triangulation *t) {
    static double positions[2 * VERTICES];
    static uint32_t cells[VERTICES];
    static uint8_t mask[MOST];
    const double place[] = {0.3, 0.7};
    uint32_t edge_cells[2], twin, hidden, shown;
    double weights[3], there[2] = {0, 0};
    size_t count;
    check(deldrift_copy_positions(t, positions, VERTICES, &count));
    check(deldrift_cell_of_each_vertex(t, cells, VERTICES, &count));
    deldrift_cells_view view;
    check(deldrift_cells(t, &view));
    const uint32_t *row = view.vertices + 3 * cells[7];
    expect(row[0] == 7 || row[1] == 7 || row[2] == 7, "each vertex has a triangle");
    const uint32_t pairs[] = {row[0], row[1], 0, VERTICES - 1};
    check(deldrift_find_simplices(t, 2, pairs, 2, edge_cells));
    expect(edge_cells[0] != DELDRIFT_NONE && edge_cells[1] == DELDRIFT_NONE, "edges are told from other pairs");

    deldrift_location at;
    check(deldrift_locate(t, place, &at));
    check(deldrift_barycentric(t, place, &at.index, 1, weights));
    for (int i = 0; i < 3; i++) {
        const double *corner = positions + 2 * view.vertices[3 * at.index + i];
        there[0] += weights[i] * corner[0], there[1] += weights[i] * corner[1];
    }
    expect(is_near(there[0], place[0]) && is_near(there[1], place[1]), "a place is a mean of corners");
    check(deldrift_mask_without_flat_cells(t, 1e-9, mask, MOST, &count));
    size_t n_left = 0;
    for (size_t c = 0; c < count; c++) n_left += mask[c];
    expect(n_left == count, "no side of this set is straight but for rounding, so all triangles stay");

    check(deldrift_insert_vertex(t, positions + 14, &twin));
    check(deldrift_hidden_vertices(t, &hidden, &shown, 1, &count));
    expect(count == 1 && hidden == twin && shown == 7, "vertices at the place of others are listed");
    check(deldrift_remove_vertex(t, twin));
    check(deldrift_compact(t, NULL, 0, &count));
}

static void ask_for_geometry(const deldrift_triangulation *t) {
    static uint32_t vertices[3 * MOST], neighbours[3 * MOST], edges[2 * MOST], facets[2 * MOST], entries[2 * MOST];
    static uint32_t offsets[VERTICES + 1], star[MOST], mirror;
    static double centres[2 * MOST], squared_radii[MOST], areas[MOST], lengths[MOST], positions[2 * VERTICES];
    static uint8_t mirrors[3 * MOST];
    size_t n_cells, n_edges, n_facets, count;
    check(deldrift_copy_positions(t, positions, VERTICES, &count));
    check(deldrift_copy_cells(t, vertices, neighbours, MOST, &n_cells));
    check(deldrift_edges(t, edges, MOST, &n_edges));
    expect(VERTICES - n_edges + n_cells == 1, "vertices - edges + triangles is 1");
    check(deldrift_hull_facets(t, facets, NULL, NULL, MOST, &n_facets));
    expect(3 * n_cells == 2 * n_edges - n_facets, "edges have two triangles, and one on the hull");
    check(deldrift_volumes(t, areas, MOST, &count));
    double area = 0, hull = 0;
    for (size_t c = 0; c < n_cells; c++) area += areas[c];
    for (size_t k = 0; k < n_facets; k++)
        hull += (positions[2 * facets[2 * k]] * positions[2 * facets[2 * k + 1] + 1] -
                 positions[2 * facets[2 * k] + 1] * positions[2 * facets[2 * k + 1]]) / 2;
    expect(is_near(area, hull), "the triangles fill the hull");
    check(deldrift_circumcentres(t, centres, squared_radii, MOST, &count));
    const double *a = positions + 2 * vertices[0];
    expect(is_near(hypot(centres[0] - a[0], centres[1] - a[1]), sqrt(squared_radii[0])), "a centre has its radius");
    check(deldrift_vertex_neighbours(t, offsets, VERTICES + 1, entries, 2 * MOST, &count));
    expect(count == 2 * n_edges, "each edge makes two vertices neighbours");
    check(deldrift_vertex_cells(t, offsets, VERTICES + 1, entries, 2 * MOST, &count));
    expect(count == 3 * n_cells, "each triangle has three vertices");
    check(deldrift_ordered_star(t, VERTICES / 2, star, MOST, &count));
    expect(count == offsets[VERTICES / 2 + 1] - offsets[VERTICES / 2], "those of one are its star");
    static const uint32_t middle = VERTICES / 2;
    static uint32_t around[MOST];
    static uint8_t mask[MOST];
    size_t n_around;
    check(deldrift_cells_around(t, &middle, 1, around, MOST, &n_around));
    expect(n_around == count, "and the triangles around it");
    const double radius = squared_radii[around[0]], before = areas[around[0]];
    areas[around[0]] = 0;
    check(deldrift_update_volumes(t, around, n_around, areas, MOST));
    check(deldrift_update_circumcentres(t, around, n_around, centres, squared_radii, MOST));
    check(deldrift_update_mask_by_circumradius(t, around, n_around, 2 * radius, mask, MOST));
    expect(areas[around[0]] == before && squared_radii[around[0]] == radius && mask[around[0]] == 1,
           "what is computed again of these alone is as before");
    check(deldrift_mirror_indices(t, mirrors, MOST, &count));
    const uint32_t beyond = neighbours[3 * star[0]];
    check(deldrift_mirror_index(t, star[0], 0, &mirror));
    expect(beyond == DELDRIFT_NONE || (mirror == mirrors[3 * star[0]] && neighbours[3 * beyond + mirror] == star[0]),
           "the neighbour's neighbour is the triangle itself");
    check(deldrift_voronoi_facets(t, (double[]){0, 0}, (double[]){1, 1}, lengths, MOST, &count));
    expect(count == n_edges && lengths[0] >= 0, "each edge has a Voronoi edge, where the box does not cut it off");
    check(deldrift_voronoi_cells(t, (double[]){0, 0}, (double[]){1, 1}, NULL, 0, areas, NULL, NULL, MOST, &count));
    double whole = 0;
    for (size_t v = 0; v < count; v++) whole += areas[v] > 0 ? areas[v] : 0;
    expect(fabs(whole - 1) < 1e-9, "the Voronoi cells fill the box");
    const double below_diagonal[] = {1, 1, 1}; // x + y is at most 1
    check(deldrift_voronoi_cells_within(t, (double[]){0, 0}, (double[]){1, 1}, below_diagonal, 1, NULL, 0, areas, NULL,
                                        NULL, MOST, &count));
    double half = 0;
    for (size_t v = 0; v < count; v++) half += areas[v] > 0 ? areas[v] : 0;
    expect(fabs(half - 0.5) < 1e-9, "a half-plane leaves half of the box");
    check(deldrift_voronoi_changed(t, &middle, 1, mask, MOST, &count));
    expect(count == VERTICES && mask[middle] == 1, "with a vertex its Voronoi cell changes");
    check(deldrift_voronoi_derivatives(t, (double[]){0, 0}, (double[]){1, 1}, NULL, 0, lengths, NULL, NULL, MOST, &count));
    expect(count == n_edges, "each edge has a derivative");
    check(deldrift_voronoi_derivatives_within(t, (double[]){0, 0}, (double[]){1, 1}, below_diagonal, 1, NULL, 0, lengths,
                                              NULL, NULL, MOST, &count));
    expect(count == n_edges && lengths[0] >= 0, "a half-plane cuts Voronoi edges, too");
    static double same_areas[MOST], same_lengths[MOST];
    size_t n_lengths;
    check(deldrift_voronoi_cells_and_facets(t, (double[]){0, 0}, (double[]){1, 1}, below_diagonal, 1, NULL, 0, same_areas,
                                            NULL, NULL, MOST, &count, same_lengths, NULL, NULL, MOST, &n_lengths));
    expect(memcmp(same_areas, areas, count * sizeof *areas) == 0 &&
               memcmp(same_lengths, lengths, n_lengths * sizeof *lengths) == 0,
           "both come from one call, too");
    check(deldrift_voronoi_weight_derivatives(t, (double[]){0, 0}, (double[]){1, 1}, below_diagonal, 1, NULL, 0, same_areas,
                                              MOST, &count, same_lengths, MOST, &n_lengths));
    expect(memcmp(same_areas, areas, count * sizeof *areas) == 0 && n_lengths == n_edges && same_lengths[0] <= 0,
           "a cell shrinks as a neighbour grows heavier");
}

// Whether two triangulations have the same cells under the same indices.
static bool are_equal(const deldrift_triangulation *a, const deldrift_triangulation *b) {
    static uint32_t cells[2][3 * MOST];
    size_t counts[2];
    check(deldrift_copy_cells(a, cells[0], NULL, MOST, &counts[0]));
    check(deldrift_copy_cells(b, cells[1], NULL, MOST, &counts[1]));
    return counts[0] == counts[1] && memcmp(cells[0], cells[1], 3 * counts[0] * sizeof(uint32_t)) == 0;
}

static void keep_and_write(deldrift_triangulation *t) {
    deldrift_triangulation *copy, *loaded;
    deldrift_released_cells *owner;
    deldrift_cells_view released, cells;
    check(deldrift_clone(t, &copy));
    check(deldrift_release_cells(copy, &released, &owner));  // before the next change
    check(deldrift_relocate_vertex(copy, 0, (double[]){0.5, 0.5}));
    expect(!are_equal(t, copy), "a clone goes on by itself");
    deldrift_destroy(copy);
    check(deldrift_cells(t, &cells));
    const size_t n_numbers = cells.count * cells.corners_per_cell;
    expect(released.count == cells.count && memcmp(released.vertices, cells.vertices, n_numbers * sizeof(uint32_t)) == 0,
           "cells that have been handed over outlive their triangulation");
    deldrift_free_cells(owner);

    size_t size, count;
    check(deldrift_save(t, NULL, 0, &size));
    void *bytes = malloc(size);
    check(deldrift_save(t, bytes, size, &count));
    check(deldrift_load(bytes, count, NULL, &loaded));
    expect(are_equal(t, loaded), "what is loaded is what was saved");
    deldrift_destroy(loaded);
    free(bytes);
    check(deldrift_save_file(t, "tour.deldrift"));
    check(deldrift_load_file("tour.deldrift", NULL, &loaded));
    expect(are_equal(t, loaded), "also in a file");
    deldrift_destroy(loaded);

    static double positions[2 * VERTICES], areas[MOST];
    check(deldrift_copy_positions(t, positions, VERTICES, &count));
    check(deldrift_volumes(t, areas, MOST, &count));
    const deldrift_field place = {"place", positions, 2}, area = {"area", areas, 1};
    check(deldrift_write_vtu(t, "tour.vtu", &place, 1, &area, 1));  // for ParaView
    check(deldrift_write_medit(t, "tour.mesh", NULL, 0));           // for Mmg, FreeFem and Gmsh
    expect(remove("tour.deldrift") + remove("tour.vtu") + remove("tour.mesh") == 0, "the files are there");
}

static void ask_for_signs(void) {
    int32_t sign;
    check(deldrift_orientation(2, (double[]){0, 0, 1, 1e-300, 2, 2e-300}, &sign));
    expect(sign == 0, "points on a line are known as such");
    check(deldrift_orientation(2, (double[]){0, 0, 1, 1e-300, 2, 2.1e-300}, &sign));
    expect(sign == 1, "and those that are almost on one, too");
    check(deldrift_in_sphere(2, (double[]){0, 0, 1e9, 0, 0, 1e9, 1e9, 1e9}, &sign));
    expect(sign == 0, "the fourth corner of a square is on the circle through the others");
    check(deldrift_in_sphere(2, (double[]){0, 0, 1e9, 0, 0, 1e9, 1e9, 999999999.9999999}, &sign));
    expect(sign == 1, "and inside, if it is moved by a last bit");
    const double corners[] = {1, 0, 0, 1, -1, 0, 3, 0};
    check(deldrift_in_power_sphere(2, corners, (double[]){0, 0, 0, 8}, &sign));
    expect(sign == 0, "a circle with the square 8 of its radius, at 3, crosses the one through the others at a right angle");
    check(deldrift_in_power_sphere(2, corners, (double[]){0, 0, 0, 8.000000000000002}, &sign));
    expect(sign == 1, "and is inside, if it is larger by a last bit");
}

// A kite that segments divide: a slit along it, which a third vertex cannot pass, and its outline.
static void ask_for_a_domain(void) {
    const double kite[] = {0, 0, 5, -1, 10, 0, 5, 1, 5, 3};
    const uint32_t ends[] = {0, 1, 1, 2, 2, 3, 3, 0, 0, 2};
    uint32_t first, segments[3 * 4], beside[2 * 5];
    int32_t labels[4];
    deldrift_conflict conflict;
    size_t count;
    deldrift_triangulation *t;
    check(deldrift_create(2, kite, 5, NULL, &t));
    check(deldrift_stage_segments(t, ends, NULL, 5, &first));
    check(deldrift_commit_timestamp(t, NULL));
    check(deldrift_cells_of_segments(t, beside, 5, &count));
    expect(count == 5 && beside[8] != DELDRIFT_NONE && beside[8] != beside[9], "cells are on both sides of the slit");
    check(deldrift_segments_of_cells(t, segments, 4, &count));
    int n_slits = 0;
    for (size_t k = 0; k < 3 * count; k++) n_slits += segments[k] == first + 4;
    expect(n_slits == 2, "and it is an edge of two cells");
    check(deldrift_label_cells(t, (double[]){5, 0.5, 5, -0.5}, (int32_t[]){7, 8}, 2, 0, labels, 4, &count));
    expect(count == 4 && labels[beside[8]] == 7 && labels[beside[9]] == 8, "which have labels of their own");
    check(deldrift_crossing_numbers(t, segments, 4, &count));
    expect(segments[beside[8]] == 1 && segments[beside[9]] == 1, "and one segment between them and the outside");
    check(deldrift_move_vertex(t, 3, (double[]){5, 0}));
    expect(deldrift_check_staged(t) == DELDRIFT_ON_SEGMENT, "a vertex does not come on a segment");
    check(deldrift_segment_conflicts(t, &conflict, 1, &count));
    expect(count == 1 && conflict.segment == first + 4 && conflict.other == 3, "and it is told which");
    check(deldrift_stage_segment_removals(t, &conflict.segment, 1));
    expect(deldrift_check_staged(t) == DELDRIFT_OK, "unless the segment goes");
    check(deldrift_commit_timestamp(t, NULL));
    check(deldrift_segments(t, NULL, NULL, NULL, 0, &count));
    expect(count == 4, "and four segments stay");
    check(deldrift_move_vertex(t, 4, (double[]){5, -3}));
    expect(deldrift_check_passings(t) == DELDRIFT_PASSES_SEGMENT, "a vertex does not jump across the kite unnoticed");
    check(deldrift_passings(t, segments, beside, 4, &count));
    expect(count > 0 && beside[0] == 4, "and it is told what it would pass");
    check(deldrift_discard_moves(t));
    deldrift_split_report report;
    check(deldrift_stage_segments(t, (uint32_t[]){0, 2, 1, 4}, NULL, 2, &first));
    check(deldrift_stage_splits(t, 1, &report));
    expect(report.inserted == 0 && report.pieces == 4, "two that would cross where a vertex is are split there");
    check(deldrift_commit_timestamp(t, NULL));
    double sizes[100] = {2, 2, 2, 2, 2, 2, 2};
    deldrift_quality quality;
    check(deldrift_quality_init(&quality));
    check(deldrift_id_count(t, &quality.size_count));
    quality.sizes = sizes;
    check(deldrift_refine(t, &quality, NULL, 0, NULL));
    check(deldrift_refined_sizes(t, sizes + quality.size_count, 100 - quality.size_count, &count));
    expect(count > 3, "edges longer than 2 are divided");
    quality.size_count += count;
    check(deldrift_refine(t, &quality, NULL, 0, NULL));
    check(deldrift_refined_sizes(t, NULL, 0, &count));
    expect(count == 0, "and with the sizes that the new vertices have none is left");
    deldrift_destroy(t);
}

// Four points on a circle, of which the order of keys says which two are joined, whatever their ids; and an id that is given
// again.
static void break_ties_by_keys(void) {
    static const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
    static const uint64_t keys[2][4] = {{10, 20, 30, 40}, {20, 10, 40, 30}};
    uint32_t vertices[2], first, id;
    uint64_t found[7];
    size_t count;
    deldrift_triangulation *t;
    bool has_first[2];
    for (int k = 0; k < 2; k++) {
        check(deldrift_create_with_keys(2, square, keys[k], 4, NULL, &t));
        deldrift_cells_view view;
        check(deldrift_cells(t, &view));
        has_first[k] = true;
        for (size_t c = 0; c < view.count; c++) {
            const uint32_t *row = view.vertices + 3 * c;
            has_first[k] = has_first[k] && (row[0] == 0 || row[1] == 0 || row[2] == 0);
        }
        if (k == 0) deldrift_destroy(t);
    }
    expect(has_first[0] != has_first[1], "keys choose the diagonal");
    check(deldrift_remove_vertex(t, 1));
    check(deldrift_stage_insertions_at_free_ids(t, (double[]){0.5, 0.25, 0.5, 0.75}, (uint64_t[]){7, 8}, 2, vertices));
    expect(vertices[0] == 1 && vertices[1] == 4, "the id of a vertex that has gone is given again");
    check(deldrift_stage_insertions_with_keys(t, (double[]){0.25, 0.5}, (uint64_t[]){9}, 1, &first));
    check(deldrift_commit_timestamp(t, NULL));
    check(deldrift_insert_vertex_with_key(t, (double[]){0.75, 0.5}, 11, &id));
    check(deldrift_keys(t, found, 7, &count));
    expect(count == 7 && found[1] == 7 && found[first] == 9 && found[id] == 11, "keys are read by id");
    deldrift_destroy(t);
}

// Four corners and a vertex between them that weights hide: it comes back as it grows heavier, and goes again as the others do.
static void hide_by_weights(void) {
    static const double positions[] = {0, 0, 1, 0, 1, 1, 0, 1, 0.5, 0.25};
    static const double weights[] = {0.5, 0.5, 0.5, 0.5, -0.5};
    double found[5];
    uint32_t vertices[5], cells[5];
    size_t count;
    bool is_weighted;
    deldrift_commit_report report;
    deldrift_triangulation *t;
    check(deldrift_create_weighted(2, positions, weights, NULL, 5, NULL, &t));
    check(deldrift_is_weighted(t, &is_weighted));
    check(deldrift_hidden_by_weight(t, vertices, cells, 5, &count));
    expect(is_weighted && count == 1 && vertices[0] == 4 && cells[0] < 2, "a light vertex is above a cell");
    check(deldrift_set_weight(t, 4, 0.25));
    check(deldrift_hidden_by_weight(t, NULL, NULL, 0, &count));
    expect(count == 0, "it is heavy enough");
    check(deldrift_stage_weights(t, (uint32_t[]){4}, (double[]){-0.5}, 1));
    check(deldrift_commit_timestamp(t, &report));
    expect(report.hidden_by_weight == 1 && report.newly_hidden == 1 && report.reweighted == 1, "a report tells it");
    check(deldrift_commit_weighted(t, NULL, (double[]){0, 0, 0, 0, 0}, 5, &report));
    expect(report.newly_shown == 1 && report.moved == 0, "weights alone");
    check(deldrift_weights(t, found, 5, &count));
    expect(count == 5 && found[4] == 0, "weights are read by id");
    // Whom one that is inserted hides, and whom it shows when it is gone.
    deldrift_changes changes;
    uint32_t heavy, first;
    check(deldrift_take_changes(t, &changes));
    check(deldrift_insert_vertex_with_weight(t, (double[]){0.5, 0.5}, 1, &heavy));
    check(deldrift_take_changes(t, &changes));
    expect(changes.hidden_count == 1 && changes.hidden[0] == 4, "a heavier neighbour hides it");
    check(deldrift_remove_vertex(t, heavy));
    check(deldrift_take_changes(t, &changes));
    expect(changes.shown_count == 1 && changes.shown[0] == 4, "and does so no more");
    check(deldrift_stage_insertions_with_weights(t, (double[]){0.5, 0.5, 2, 0.5}, (double[]){1, 0}, 2, &first));
    check(deldrift_commit_timestamp(t, &report));
    expect(report.inserted == 2 && report.newly_hidden == 1, "both come with their weights");
    deldrift_destroy(t);
    check(deldrift_create_periodic_weighted(2, positions + 8, (double[]){3}, 1, (double[]){1, 0, 0, 1}, 2, NULL, &t));
    check(deldrift_cell_count(t, &count));
    expect(count == 2, "one vertex that repeats has two cells, whatever its weight");
    deldrift_destroy(t);
}

// A square of two regions whose mesh is refined: where vertices and pieces come from, labels, and the boundary.
static void refine_a_domain(void) {
    enum { ROOM = 4096 };
    static uint32_t vertices[ROOM], of_vertices[ROOM], originals[ROOM];
    static int32_t labels[ROOM];
    static uint8_t mask[ROOM];
    const double square[] = {0, 0, 1, 0, 2, 0, 2, 1, 1, 1, 0, 1};
    const uint32_t ends[] = {0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 0, 1, 4};
    uint32_t first;
    size_t count, n_cells, undecided;
    deldrift_triangulation *t;
    deldrift_quality quality;
    deldrift_quality_report report;
    check(deldrift_create(2, square, 6, NULL, &t));
    check(deldrift_stage_segments(t, ends, NULL, 7, &first));
    check(deldrift_commit_timestamp(t, NULL));
    deldrift_quality_init(&quality);
    quality.least_angle = 30;
    quality.greatest_area = 0.01;
    check(deldrift_refine(t, &quality, NULL, 0, &report));
    expect(report.bad_cells == 0 && report.on_segments > 6, "no angle is below 30 degrees, and segments have got vertices");
    check(deldrift_made_vertices(t, vertices, of_vertices, ROOM, &count));
    expect(count == report.inserted && vertices[0] == 6, "which it tells, each with its segment");
    check(deldrift_original_segments(t, originals, ROOM, &count));
    expect(count == 7 + report.on_segments && originals[0] < 7, "and pieces know theirs");
    check(deldrift_label_cells(t, (double[]){0.3, 0.3, 1.3, 0.3}, (int32_t[]){1, 2}, 2, 0, labels, ROOM, &n_cells));
    const int32_t label = labels[0];
    labels[0] = 0;
    check(deldrift_update_labels(t, (uint32_t[]){0}, 1, 0, labels, ROOM, &undecided));
    expect(undecided == 0 && labels[0] == label, "a cell has the label of those around it");
    check(deldrift_set_regions(t, labels, n_cells));
    check(deldrift_segments(t, originals, NULL, NULL, ROOM, &count));
    check(deldrift_set_segment_sides(t, originals, (int32_t[]){DELDRIFT_NO_LABEL, DELDRIFT_NO_LABEL}, 1));
    quality.domain = DELDRIFT_DOMAIN_REGIONS;
    quality.greatest_area = 0.005;
    check(deldrift_refine(t, &quality, NULL, 0, &report));
    check(deldrift_regions(t, 0, labels, ROOM, &n_cells, &undecided));
    expect(report.inserted > 0 && undecided == 0 && labels[0] > 0, "labels of regions follow by themselves");
    for (size_t c = 0; c < n_cells; c++) mask[c] = labels[c] == 1;
    check(deldrift_boundary_chains(t, mask, n_cells, vertices, of_vertices, NULL, NULL, NULL, ROOM, &count));
    expect(count > 4 && of_vertices[count - 1] == 0, "and the boundary of one half is one chain");
    deldrift_destroy(t);
}

int main(void) {
    static double positions[2 * VERTICES];
    for (int i = 0; i < VERTICES; i++) {
        positions[2 * i] = (i % SIDE + 0.2 * sin(12.9898 * i)) / (SIDE - 1);
        positions[2 * i + 1] = (i / SIDE + 0.2 * sin(78.233 * i)) / (SIDE - 1);
    }
    uint32_t dimension;
    size_t bytes;
    deldrift_triangulation *t;
    deldrift_options options;
    deldrift_options_init(&options);
    options.threads = 1;  // more would not pay for so few
    check(deldrift_create(2, positions, VERTICES, &options, &t));
    change_one_at_a_time(t);
    ask_for_places(t);
    ask_what_is_near(t);
    ask_what_is_in_reach(t);
    ask_for_corners(t);
    ask_for_geometry(t);
    keep_and_write(t);
    ask_for_signs();
    ask_for_a_domain();
    break_ties_by_keys();
    hide_by_weights();
    refine_a_domain();
    check(deldrift_validate(t, 3));
    check(deldrift_dimension(t, &dimension));
    check(deldrift_memory_bytes(t, &bytes));
    printf("deldrift %s, %uD, %zu bytes: %d of %d as expected\n", deldrift_version(), (unsigned)dimension, bytes,
           n_found, n_expected);
    deldrift_destroy(t);
    return n_found == n_expected ? 0 : 1;
}
