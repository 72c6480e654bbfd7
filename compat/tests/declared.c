/*
 * A program with no header but its own, which declares the function as its copy of Triangle does: without a result
 * (RETURNS_void), or as an int that is 0 unless the call has failed (RETURNS_int). Small sets are triangulated anew at
 * each call, large ones are kept from call to call.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <deldrift.h>

struct triangulateio {
    double *pointlist, *pointattributelist;
    int *pointmarkerlist, numberofpoints, numberofpointattributes;
    int *trianglelist;
    double *triangleattributelist, *trianglearealist;
    int *neighborlist, numberoftriangles, numberofcorners, numberoftriangleattributes;
    int *segmentlist, *segmentmarkerlist, numberofsegments;
    double *holelist;
    int numberofholes;
    double *regionlist;
    int numberofregions;
    int *edgelist, *edgemarkerlist;
    double *normlist;
    int numberofedges;
};

#ifdef RETURNS_void
void triangulate(char *, struct triangulateio *, struct triangulateio *, struct triangulateio *);
#define SUCCEEDS(call) ((call), 1)
#define FAILS(call) ((call), 1)
#else
int triangulate(char *, struct triangulateio *, struct triangulateio *, struct triangulateio *);
#define SUCCEEDS(call) ((call) == 0)
#define FAILS(call) ((call) != 0)
#endif

#define CHECK(condition)                                                             \
    do {                                                                             \
        if (!(condition)) {                                                          \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);  \
            exit(1);                                                                 \
        }                                                                            \
    } while (0)

static int compare_ids(const void *a, const void *b) {
    const int x = *(const int *)a, y = *(const int *)b;
    return (x > y) - (x < y);
}

static int compare_rows(const void *a, const void *b) {
    for (int i = 0; i < 3; i++) {
        const int order = compare_ids((const int *)a + i, (const int *)b + i);
        if (order != 0) return order;
    }
    return 0;
}

static void sort(int *triangles, size_t count) {
    for (size_t i = 0; i < count; i++) qsort(triangles + 3 * i, 3, sizeof(int), compare_ids);
    qsort(triangles, count, 3 * sizeof(int), compare_rows);
}

/* Triangulates the points, and compares with the cells of a new triangulation. */
static void check(double *points, int n_points) {
    struct triangulateio in, out;
    char switches[] = "Qz";
    memset(&in, 0, sizeof in);
    memset(&out, 0, sizeof out);
    in.pointlist = points;
    in.numberofpoints = n_points;
    CHECK(SUCCEEDS(triangulate(switches, &in, &out, NULL)));

    deldrift_triangulation *t;
    deldrift_cells_view cells;
    CHECK(deldrift_create(2, points, (size_t)n_points, NULL, &t) == DELDRIFT_OK);
    CHECK(deldrift_cells(t, &cells) == DELDRIFT_OK && cells.count == (size_t)out.numberoftriangles);
    int *expected = malloc(3 * cells.count * sizeof *expected);
    CHECK(expected != NULL);
    memcpy(expected, cells.vertices, 3 * cells.count * sizeof *expected);
    sort(expected, cells.count);
    sort(out.trianglelist, cells.count);
    CHECK(memcmp(expected, out.trianglelist, 3 * cells.count * sizeof *expected) == 0);
    deldrift_destroy(t);
    free(expected);
    free(out.pointlist);
    free(out.pointmarkerlist);
    free(out.trianglelist);
}

static double random_number(void) {
    static unsigned long long state = 1;
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(state >> 11) * 0x1p-53;
}

/* Three steps of points that move. */
static void check_moving(int n_points) {
    double *points = malloc(2 * (size_t)n_points * sizeof *points);
    CHECK(points != NULL);
    for (int i = 0; i < 2 * n_points; i++) points[i] = random_number();
    for (int step = 0; step < 3; step++) {
        check(points, n_points);
        for (int i = 0; i < 2 * n_points; i++) points[i] += 1e-3 * random_number();
    }
    free(points);
}

static void too_few_points_fail(void) {
    double line[] = {0, 0, 1, 1};
    struct triangulateio in, out;
    char switches[] = "Qz";
    memset(&in, 0, sizeof in);
    memset(&out, 0, sizeof out);
    in.pointlist = line;
    in.numberofpoints = 2;
    out.numberoftriangles = 5;
    CHECK(FAILS(triangulate(switches, &in, &out, NULL)) && out.numberoftriangles == 0);
}

int main(void) {
    static const int sizes[] = {3, 4, 10, 63, 64, 20000};
    double kite[] = {0, 0, 1, 0, 0, 1, 1, 1.5};
    check(kite, 4);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) check_moving(sizes[i]);
    too_few_points_fail();
    return 0;
}
