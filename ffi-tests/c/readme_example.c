#include <deldrift.h>
#include <stdio.h>

int main(void) {
    double square[] = {0, 0, 4, 0, 4, 3, 0, 3, 1, 1};  // vertices 0 to 4
    deldrift_triangulation *t;
    if (deldrift_create(2, square, 5, NULL, &t) != DELDRIFT_OK) {
        fprintf(stderr, "%s\n", deldrift_last_error());
        return 1;
    }
    double position[] = {3, 2};
    deldrift_cells_view cells;
    deldrift_move_vertex(t, 4, position);
    deldrift_commit_timestamp(t, NULL);
    deldrift_cells(t, &cells);
    for (const uint32_t *v = cells.vertices; v < cells.vertices + 3 * cells.count; v += 3)
        printf("triangle %u %u %u\n", v[0], v[1], v[2]);
    deldrift_destroy(t);
}
