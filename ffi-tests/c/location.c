// Where points lie, one at a time and several.
#include "check.h"

static void places_are_found(void) {
    static const double inside[] = {2, 1}, vertex[] = {1, 2}, outside[] = {-1, 2}, nowhere[] = {NAN, 0}, far[] = {0, 1e99};
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    deldrift_cells_view view = cells_of(t);
    deldrift_location location;
    OK(deldrift_locate(t, inside, &location));
    CHECK(location.kind == DELDRIFT_LOCATION_CELL);
    const uint32_t *cell = view.vertices + 3 * location.index;
    CHECK(has_corner(cell, 3, 0) && has_corner(cell, 3, 1) && has_corner(cell, 3, 4));
    OK(deldrift_locate(t, vertex, &location));
    CHECK(location.kind == DELDRIFT_LOCATION_VERTEX && location.index == 4);
    OK(deldrift_locate(t, outside, &location));
    CHECK(location.kind == DELDRIFT_LOCATION_OUTSIDE);
    CHECK(has_corner(view.vertices + 3 * location.index, 3, 0) && has_corner(view.vertices + 3 * location.index, 3, 3));
    CHECK_STATUS(deldrift_locate(t, nowhere, &location), DELDRIFT_NOT_FINITE);
    CHECK_STATUS(deldrift_locate(t, far, &location), DELDRIFT_OUT_OF_RANGE);
    CHECK(location.kind == DELDRIFT_LOCATION_OUTSIDE);

    uint32_t nearest = 77;
    OK(deldrift_nearest_vertex(t, inside, &nearest));
    CHECK(nearest == 4);
    OK(deldrift_nearest_vertex(t, outside, &nearest));
    CHECK(nearest == 4 || nearest == 3 || nearest == 0);
    CHECK_STATUS(deldrift_nearest_vertex(t, nowhere, &nearest), DELDRIFT_NOT_FINITE);
    CHECK_STATUS(deldrift_nearest_vertex(t, far, &nearest), DELDRIFT_OUT_OF_RANGE);
    deldrift_destroy(t);

    t = create(2, NULL, 0, NULL);
    OK(deldrift_locate(t, inside, &location));
    CHECK(location.kind == DELDRIFT_LOCATION_NO_CELLS && location.index == DELDRIFT_NONE);
    OK(deldrift_nearest_vertex(t, inside, &nearest));
    CHECK(nearest == DELDRIFT_NONE);
    deldrift_destroy(t);
}

// As one at a time, wherever they are said to be.
static void several_places_are_found(void) {
    deldrift_triangulation *t = create(2, SQUARE, SQUARE_COUNT, NULL);
    static const double points[] = {2, 1, 1, 2, -1, 2, 2, 1}, bad[] = {2, 1, NAN, 0};
    deldrift_location found[4], one;
    const deldrift_location nears[] = {{DELDRIFT_LOCATION_VERTEX, 3}, {DELDRIFT_LOCATION_CELL, 1},
                                       {DELDRIFT_LOCATION_OUTSIDE, 0}, {DELDRIFT_LOCATION_NO_CELLS, DELDRIFT_NONE},
                                       {DELDRIFT_LOCATION_CELL, 1000}, {DELDRIFT_LOCATION_VERTEX, DELDRIFT_NONE}};
    for (size_t k = 0; k <= sizeof nears / sizeof *nears; k++) {
        memset(found, 0x77, sizeof found);
        OK(deldrift_locate_points(t, points, 4, k == 0 ? NULL : nears + k - 1, found));
        for (int i = 0; i < 4; i++) {
            OK(deldrift_locate(t, points + 2 * i, &one));
            CHECK(found[i].kind == one.kind);
            CHECK(one.kind == DELDRIFT_LOCATION_OUTSIDE || found[i].index == one.index);
        }
    }
    OK(deldrift_locate_points(t, points, 2, found + 3, found + 2));
    CHECK(found[2].kind == DELDRIFT_LOCATION_CELL && found[3].kind == DELDRIFT_LOCATION_VERTEX);
    uint32_t any[2] = {0x12345678, 9};
    OK(deldrift_locate_points(t, points, 1, (const deldrift_location *)(const void *)any, found));
    OK(deldrift_locate_points(t, NULL, 0, NULL, NULL));
    memset(found, 0x77, sizeof found);
    CHECK_STATUS(deldrift_locate_points(t, bad, 2, NULL, found), DELDRIFT_NOT_FINITE);
    CHECK(strstr(deldrift_last_error(), "positions[1], coordinate 0") != NULL);
    CHECK(found[0].index == 0x77777777);
    deldrift_destroy(t);
}

int main(void) {
    places_are_found();
    several_places_are_found();
    return 0;
}
