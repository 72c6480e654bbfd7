// NULL and misaligned pointers in every argument of every function, and counts beyond the address space.
#include "check.h"

// Statuses of a call with a NULL and with a misaligned pointer in the place of POINTER.
#define REFUSES(argument, type, POINTER)                                                     \
    do {                                                                                     \
        type *pointer = NULL;                                                                \
        CHECK_STATUS(POINTER, DELDRIFT_NULL_ARGUMENT);                                       \
        CHECK_MESSAGE(argument " is NULL");                                                  \
        pointer = (type *)(void *)((char *)&storage + 1);                                    \
        CHECK_STATUS(POINTER, DELDRIFT_MISALIGNED_ARGUMENT);                                 \
        CHECK_MESSAGE(argument " is 0x");                                                    \
    } while (0)

// Large and aligned enough for whatever the pointers should point to.
static union {
    double numbers[64];
    deldrift_triangulation *pointer;
} storage;

static deldrift_triangulation *t;
static size_t count;
static uint32_t number;

static void handles(void) {
    static const double position[3] = {1, 1, 1};
    uint64_t timestamp;
    bool present;
    double coordinates[3];
    deldrift_algorithm algorithm;
    deldrift_commit_report report;
    deldrift_cells_view cells;
    deldrift_indices_view indices;
    deldrift_changes changes;
    deldrift_location location;

    REFUSES("t", deldrift_triangulation, deldrift_dimension(pointer, &number));
    REFUSES("t", deldrift_triangulation, deldrift_set_algorithm(pointer, DELDRIFT_AUTO));
    REFUSES("t", deldrift_triangulation, deldrift_get_algorithm(pointer, &algorithm));
    REFUSES("t", deldrift_triangulation, deldrift_move_vertex(pointer, 0, position));
    REFUSES("t", deldrift_triangulation, deldrift_move_vertices(pointer, NULL, position, 1));
    REFUSES("t", deldrift_triangulation, deldrift_move_vertices(pointer, NULL, NULL, 0));
    REFUSES("t", deldrift_triangulation, deldrift_discard_moves(pointer));
    REFUSES("t", deldrift_triangulation, deldrift_commit_timestamp(pointer, &report));
    REFUSES("t", deldrift_triangulation, deldrift_commit_timestamp(pointer, NULL));
    REFUSES("t", deldrift_triangulation, deldrift_commit_positions(pointer, position, 1, NULL));
    REFUSES("t", deldrift_triangulation, deldrift_stage_insertions(pointer, position, 1, &number));
    REFUSES("t", deldrift_triangulation, deldrift_stage_removals(pointer, &number, 1));
    REFUSES("t", deldrift_triangulation, deldrift_take_changes(pointer, &changes));
    REFUSES("t", deldrift_triangulation, deldrift_relocate_vertex(pointer, 0, position));
    REFUSES("t", deldrift_triangulation, deldrift_insert_vertex(pointer, position, &number));
    REFUSES("t", deldrift_triangulation, deldrift_remove_vertex(pointer, 0));
    REFUSES("t", deldrift_triangulation, deldrift_vertex_count(pointer, &count));
    REFUSES("t", deldrift_triangulation, deldrift_id_count(pointer, &count));
    REFUSES("t", deldrift_triangulation, deldrift_cell_count(pointer, &count));
    REFUSES("t", deldrift_triangulation, deldrift_staged_count(pointer, &count));
    REFUSES("t", deldrift_triangulation, deldrift_memory_bytes(pointer, &count));
    REFUSES("t", deldrift_triangulation, deldrift_timestamp(pointer, &timestamp));
    REFUSES("t", deldrift_triangulation, deldrift_statistics(pointer, &report));
    REFUSES("t", deldrift_triangulation, deldrift_is_present(pointer, 0, &present));
    REFUSES("t", deldrift_triangulation, deldrift_position(pointer, 0, coordinates));
    REFUSES("t", deldrift_triangulation, deldrift_copy_positions(pointer, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_cells(pointer, &cells));
    REFUSES("t", deldrift_triangulation, deldrift_copy_cells(pointer, NULL, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_star(pointer, 0, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_tolerance(pointer, 0, coordinates));
    REFUSES("t", deldrift_triangulation, deldrift_annulus_widths(pointer, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation,
            deldrift_standard_delimiter(pointer, 0, 0, coordinates, coordinates, coordinates));
    REFUSES("t", deldrift_triangulation, deldrift_locate(pointer, position, &location));
    REFUSES("t", deldrift_triangulation, deldrift_locate_points(pointer, position, 1, NULL, &location));
    REFUSES("t", deldrift_triangulation, deldrift_nearest_vertex(pointer, position, &number));
    REFUSES("t", deldrift_triangulation, deldrift_coincident_representative(pointer, 0, &number));
    REFUSES("t", deldrift_triangulation, deldrift_changed_cells(pointer, &indices));
    REFUSES("t", deldrift_triangulation, deldrift_validate(pointer, 1));
    REFUSES("t", deldrift_triangulation, deldrift_circumcentres(pointer, NULL, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_volumes(pointer, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_mask_by_circumradius(pointer, 1, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_mask_boundary(pointer, NULL, 0, NULL, NULL, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_hull_facets(pointer, NULL, NULL, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_edges(pointer, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_vertex_neighbours(pointer, NULL, 0, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_vertex_cells(pointer, NULL, 0, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_mirror_indices(pointer, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_mirror_index(pointer, 0, 0, &number));
    REFUSES("t", deldrift_triangulation, deldrift_ordered_star(pointer, 0, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_voronoi_volumes(pointer, NULL, NULL, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation, deldrift_voronoi_facets(pointer, NULL, NULL, NULL, 0, &count));
    REFUSES("t", deldrift_triangulation,
            deldrift_interpolate(pointer, 0, NULL, 0, 1, position, 1, NULL, NULL, coordinates));
}

static void inputs(void) {
    static const double positions[4] = {1, 1, 2, 2};
    static const uint32_t vertices[2] = {0, 1};
    deldrift_triangulation *other = NULL;
    deldrift_location location;

    REFUSES("positions", double, deldrift_create(2, pointer, 1, NULL, &other));
    REFUSES("positions", double, deldrift_create(3, pointer, 1, NULL, &other));
    REFUSES("position", double, deldrift_move_vertex(t, 0, pointer));
    REFUSES("positions", double, deldrift_move_vertices(t, NULL, pointer, SQUARE_COUNT));
    REFUSES("positions", double, deldrift_move_vertices(t, vertices, pointer, 2));
    REFUSES("positions", double, deldrift_commit_positions(t, pointer, SQUARE_COUNT, NULL));
    REFUSES("positions", double, deldrift_stage_insertions(t, pointer, 1, &number));
    REFUSES("vertices", uint32_t, deldrift_stage_removals(t, pointer, 1));
    REFUSES("position", double, deldrift_relocate_vertex(t, 0, pointer));
    REFUSES("position", double, deldrift_insert_vertex(t, pointer, &number));
    REFUSES("position", double, deldrift_locate(t, pointer, &location));
    REFUSES("positions", double, deldrift_locate_points(t, pointer, 1, NULL, &location));
    REFUSES("position", double, deldrift_nearest_vertex(t, pointer, &number));
    CHECK(other == NULL);

    // Where NULL is legal, misaligned pointers still are not.
    const void *odd = (char *)&storage + 1;
    CHECK_STATUS(deldrift_move_vertices(t, (const uint32_t *)odd, positions, 2), DELDRIFT_MISALIGNED_ARGUMENT);
    CHECK_MESSAGE("vertices is 0x");
    CHECK_STATUS(deldrift_create(2, SQUARE, SQUARE_COUNT, (const deldrift_options *)odd, &other),
                 DELDRIFT_MISALIGNED_ARGUMENT);
    CHECK_MESSAGE("options is 0x");
    CHECK_STATUS(deldrift_commit_timestamp(t, (deldrift_commit_report *)(size_t)odd), DELDRIFT_MISALIGNED_ARGUMENT);
    CHECK_MESSAGE("report is 0x");
    CHECK_STATUS(deldrift_locate_points(t, positions, 1, (const deldrift_location *)odd, &location),
                 DELDRIFT_MISALIGNED_ARGUMENT);
    CHECK_MESSAGE("near is 0x");
}

static void outputs(void) {
    static const double position[2] = {1, 1};
    static const uint8_t mask[4] = {1, 1, 1, 1};
    double numbers[3];

    REFUSES("out", deldrift_triangulation *, deldrift_create(2, SQUARE, SQUARE_COUNT, NULL, pointer));
    REFUSES("dimension", uint32_t, deldrift_dimension(t, pointer));
    REFUSES("algorithm", deldrift_algorithm, deldrift_get_algorithm(t, pointer));
    REFUSES("out_vertex", uint32_t, deldrift_insert_vertex(t, position, pointer));
    REFUSES("first_vertex", uint32_t, deldrift_stage_insertions(t, position, 1, pointer));
    REFUSES("changes", deldrift_changes, deldrift_take_changes(t, pointer));
    REFUSES("count", size_t, deldrift_vertex_count(t, pointer));
    REFUSES("count", size_t, deldrift_id_count(t, pointer));
    REFUSES("count", size_t, deldrift_cell_count(t, pointer));
    REFUSES("count", size_t, deldrift_staged_count(t, pointer));
    REFUSES("bytes", size_t, deldrift_memory_bytes(t, pointer));
    REFUSES("timestamp", uint64_t, deldrift_timestamp(t, pointer));
    REFUSES("report", deldrift_commit_report, deldrift_statistics(t, pointer));
    REFUSES("position", double, deldrift_position(t, 0, pointer));
    REFUSES("positions", double, deldrift_copy_positions(t, pointer, 64, &count));
    REFUSES("count", size_t, deldrift_copy_positions(t, NULL, 0, pointer));
    REFUSES("view", deldrift_cells_view, deldrift_cells(t, pointer));
    REFUSES("count", size_t, deldrift_copy_cells(t, NULL, NULL, 0, pointer));
    REFUSES("cells", uint32_t, deldrift_star(t, 0, pointer, 64, &count));
    REFUSES("count", size_t, deldrift_star(t, 0, NULL, 0, pointer));
    REFUSES("out", double, deldrift_tolerance(t, 0, pointer));
    REFUSES("widths", double, deldrift_annulus_widths(t, pointer, 64, &count));
    REFUSES("count", size_t, deldrift_annulus_widths(t, NULL, 0, pointer));
    REFUSES("centre", double, deldrift_standard_delimiter(t, 0, 0, pointer, numbers, numbers));
    REFUSES("radius", double, deldrift_standard_delimiter(t, 0, 0, numbers, pointer, numbers));
    REFUSES("tolerance", double, deldrift_standard_delimiter(t, 0, 0, numbers, numbers, pointer));
    REFUSES("location", deldrift_location, deldrift_locate(t, position, pointer));
    REFUSES("locations", deldrift_location, deldrift_locate_points(t, position, 1, NULL, pointer));
    REFUSES("vertex", uint32_t, deldrift_nearest_vertex(t, position, pointer));
    REFUSES("representative", uint32_t, deldrift_coincident_representative(t, 0, pointer));

    REFUSES("count", size_t, deldrift_circumcentres(t, NULL, NULL, 0, pointer));
    REFUSES("count", size_t, deldrift_volumes(t, NULL, 0, pointer));
    REFUSES("count", size_t, deldrift_mask_by_circumradius(t, 1, NULL, 0, pointer));
    REFUSES("count", size_t, deldrift_mask_boundary(t, mask, 4, NULL, NULL, NULL, 0, pointer));
    REFUSES("count", size_t, deldrift_hull_facets(t, NULL, NULL, NULL, 0, pointer));
    REFUSES("count", size_t, deldrift_edges(t, NULL, 0, pointer));
    REFUSES("count", size_t, deldrift_vertex_neighbours(t, NULL, 0, NULL, 0, pointer));
    REFUSES("count", size_t, deldrift_vertex_cells(t, NULL, 0, NULL, 0, pointer));
    REFUSES("count", size_t, deldrift_mirror_indices(t, NULL, 0, pointer));
    REFUSES("count", size_t, deldrift_ordered_star(t, 0, NULL, 0, pointer));
    REFUSES("centres", double, deldrift_circumcentres(t, pointer, NULL, 64, &count));
    REFUSES("volumes", double, deldrift_volumes(t, pointer, 64, &count));
    REFUSES("facets", uint32_t, deldrift_hull_facets(t, pointer, NULL, NULL, 64, &count));
    REFUSES("facets", uint32_t, deldrift_mask_boundary(t, mask, 4, pointer, NULL, NULL, 64, &count));
    REFUSES("edges", uint32_t, deldrift_edges(t, pointer, 64, &count));
    REFUSES("neighbours", uint32_t, deldrift_vertex_neighbours(t, NULL, 0, pointer, 64, &count));
    REFUSES("cells", uint32_t, deldrift_vertex_cells(t, NULL, 0, pointer, 64, &count));
    REFUSES("mirror", uint32_t, deldrift_mirror_index(t, 0, 0, pointer));
    REFUSES("cells", uint32_t, deldrift_ordered_star(t, 0, pointer, 64, &count));
    REFUSES("low", double, deldrift_voronoi_volumes(t, pointer, SQUARE, NULL, 0, &count));
    REFUSES("high", double, deldrift_voronoi_facets(t, SQUARE, pointer, NULL, 0, &count));
    REFUSES("volumes", double, deldrift_voronoi_volumes(t, NULL, NULL, pointer, 64, &count));
    REFUSES("measures", double, deldrift_voronoi_facets(t, NULL, NULL, pointer, 64, &count));
    REFUSES("count", size_t, deldrift_voronoi_volumes(t, NULL, NULL, NULL, 0, pointer));
    REFUSES("count", size_t, deldrift_voronoi_facets(t, NULL, NULL, NULL, 0, pointer));
    REFUSES("values", double, deldrift_interpolate(t, 0, pointer, 5, 1, position, 1, NULL, NULL, numbers));
    REFUSES("positions", double, deldrift_interpolate(t, 0, SQUARE, 5, 1, pointer, 1, NULL, NULL, numbers));
    REFUSES("results", double, deldrift_interpolate(t, 0, SQUARE, 5, 1, position, 1, NULL, NULL, pointer));
    // Where NULL is legal, misaligned pointers still are not.
    double *odd_numbers = (double *)(void *)((char *)&storage + 1);
    uint32_t *odd_ids = (uint32_t *)(void *)((char *)&storage + 1);
    CHECK_STATUS(deldrift_circumcentres(t, numbers, odd_numbers, 64, &count), DELDRIFT_MISALIGNED_ARGUMENT);
    CHECK_MESSAGE("squared_radii is 0x");
    CHECK_STATUS(deldrift_hull_facets(t, NULL, odd_ids, NULL, 64, &count), DELDRIFT_MISALIGNED_ARGUMENT);
    CHECK_MESSAGE("cells is 0x");
    CHECK_STATUS(deldrift_vertex_neighbours(t, odd_ids, 6, NULL, 0, &count), DELDRIFT_MISALIGNED_ARGUMENT);
    CHECK_MESSAGE("offsets is 0x");

    CHECK_STATUS(deldrift_is_present(t, 0, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("present is NULL");
    CHECK_STATUS(deldrift_changed_cells(t, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("view is NULL");
    CHECK_STATUS(deldrift_copy_cells(t, NULL, NULL, 1, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("vertices is NULL");
    CHECK_STATUS(deldrift_annulus_widths(t, NULL, 1, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("widths is NULL");
    uint32_t *odd = (uint32_t *)(void *)((char *)&storage + 1);
    CHECK_STATUS(deldrift_copy_cells(t, odd, NULL, 64, &count), DELDRIFT_MISALIGNED_ARGUMENT);
    CHECK_STATUS(deldrift_copy_cells(t, NULL, odd, 64, &count), DELDRIFT_MISALIGNED_ARGUMENT);
    CHECK_MESSAGE("neighbours is 0x");
}

static void sizes(void) {
    static const uint32_t vertices[1] = {0};
    static const size_t overflows[] = {SIZE_MAX, SIZE_MAX / 16 + 1, SIZE_MAX / 32 + 1};
    for (size_t i = 0; i < 3; i++) {
        CHECK_STATUS(deldrift_move_vertices(t, vertices, SQUARE, overflows[i]), DELDRIFT_SIZE_OVERFLOW);
        CHECK_MESSAGE("positions cannot have ");
        CHECK_STATUS(deldrift_move_vertices(t, NULL, SQUARE, overflows[i]), DELDRIFT_SIZE_OVERFLOW);
    }
    // An unlimited capacity is only a promise that there is room for what is needed.
    double positions[2 * SQUARE_COUNT];
    OK(deldrift_copy_positions(t, positions, SIZE_MAX, &count));
    CHECK(memcmp(positions, SQUARE, sizeof SQUARE) == 0);
}

static void nothing_has_changed(void) {
    size_t staged = 1;
    uint64_t timestamp = 1;
    OK(deldrift_staged_count(t, &staged));
    OK(deldrift_timestamp(t, &timestamp));
    OK(deldrift_id_count(t, &count));
    CHECK(staged == 0 && timestamp == 0 && count == SQUARE_COUNT);
    OK(deldrift_validate(t, 3));
}

static void nothing_to_do_needs_no_arrays(void) {
    OK(deldrift_move_vertices(t, NULL, NULL, 0));
    OK(deldrift_move_vertices(t, (const uint32_t *)1, (const double *)1, 0));
    deldrift_options_init(NULL);
    deldrift_destroy(NULL);
}

int main(void) {
    t = create(2, SQUARE, SQUARE_COUNT, NULL);
    handles();
    inputs();
    outputs();
    sizes();
    nothing_to_do_needs_no_arrays();
    nothing_has_changed();
    deldrift_destroy(t);
    return 0;
}
