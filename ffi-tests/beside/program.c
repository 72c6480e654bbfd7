// Has a panic caught in deldrift and one in another library that is written in Rust, in this order and in the other.
#include <deldrift.h>

#include <stdbool.h>
#include <string.h>

bool other_catches_a_panic(void);

// Writes an id that no vertex has into the arrays of the cells, which is against the rules, and reads lists by vertex.
static bool deldrift_catches_a_panic(void) {
    const double square[] = {0, 0, 4, 0, 4, 3, 0, 3, 1, 1};
    deldrift_triangulation *t;
    deldrift_cells_view cells;
    if (deldrift_create(2, square, 5, NULL, &t) != DELDRIFT_OK) return false;
    if (deldrift_cells(t, &cells) != DELDRIFT_OK) return false;
    uint32_t *corner = (uint32_t *)cells.vertices, offsets[6], entries[100];
    *corner = 4000000;
    size_t count;
    const deldrift_status status = deldrift_vertex_neighbours(t, offsets, 6, entries, 100, &count);
    const bool has_said_so = strstr(deldrift_last_error(), "panicked at") != NULL;
    deldrift_destroy(t);
    return status == DELDRIFT_INTERNAL_ERROR && has_said_so;
}

// Of the program itself, or of a shared library that is made of both.
int catch_both(void) {
    for (int round = 0; round < 2; round++) {
        if (!deldrift_catches_a_panic()) return 1;
        if (!other_catches_a_panic() || !other_catches_a_panic()) return 2;
    }
    return 0;
}
