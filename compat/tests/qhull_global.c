// A program with qhull's other library, whose qh_new_qhull has no qhT: it is called as if this library were not there.
#include <libqhull/qhull_a.h>
#include <stdio.h>

int main(void) {
    coordT points[] = {0, 0, 1, 0, 0, 1, 1, 1.1, 0.3, 0.4};
    char command[] = "qhull d Qt Qbb Qc Qz";
    int n_cells = 0, n_left = 0, bytes_left = 0;
    facetT *facet;
    if (qh_new_qhull(2, 5, points, False, command, NULL, stderr) != 0) return 1;
    FORALLfacets n_cells += !facet->upperdelaunay;
    qh_freeqhull(!qh_ALL);
    qh_memfreeshort(&n_left, &bytes_left);
    if (n_cells == 4 && n_left == 0) return 0;
    fprintf(stderr, "%d cells\n", n_cells);
    return 1;
}
