/*
 * Triangle's calling convention, as far as deldrift serves it: for programs that call Triangle as a library and have
 * no triangle.h of their own. compat/README.md says which switches are served, and by whom.
 *
 * The layout is that of Triangle 1.6 with double coordinates. Fields are named as there. Arrays that the function
 * makes come from malloc, and the caller frees them; where out or vorout has an array already, it is filled instead.
 */
#ifndef DELDRIFT_TRIANGLE_H
#define DELDRIFT_TRIANGLE_H

#ifdef __cplusplus
extern "C" {
#endif

struct triangulateio {
    double *pointlist;          /* x and y of each point */
    double *pointattributelist; /* numberofpointattributes numbers for each point */
    int *pointmarkerlist;       /* in: NULL for zeros; out: those, and 1 for points of the hull that had 0 */
    int numberofpoints;
    int numberofpointattributes;

    int *trianglelist; /* three corners each, counter-clockwise; with o2 also the middles opposite these */
    double *triangleattributelist;
    double *trianglearealist;
    int *neighborlist; /* entry i: the triangle opposite corner i, -1 on the hull */
    int numberoftriangles;
    int numberofcorners;
    int numberoftriangleattributes;

    int *segmentlist;       /* with switch p or c: two ends each */
    int *segmentmarkerlist; /* in: NULL for zeros; out: those, and 1 for the boundary */
    int numberofsegments;   /* in: not looked at without switch p; out: without p and c the edges of the hull */

    double *holelist; /* a place in each; out: the list of the input */
    int numberofholes;

    double *regionlist; /* a place, the attribute, and the greatest area; out: the list of the input */
    int numberofregions;

    int *edgelist;       /* two ends each; in vorout two Voronoi vertices, the second -1 for a ray */
    int *edgemarkerlist; /* 1 for edges of the hull */
    double *normlist;    /* in vorout: the direction of a ray, zero for other edges */
    int numberofedges;
};

/*
 * Returns 0, and 1 if the call cannot be served: then one line on stderr says why, and there are no triangles. Triangle
 * 1.6 returns nothing, later versions of it an int; programs that declare either may call this function.
 */
int triangulate(char *switches, struct triangulateio *in, struct triangulateio *out, struct triangulateio *vorout);

/* Frees a list of the output: it is free(), which programs may call as well. */
void trifree(void *list);

#ifdef __cplusplus
}
#endif

#endif
