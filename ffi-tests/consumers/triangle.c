/* A program that was written for Triangle. */
#include <deldrift_triangle.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(void) {
    double points[] = {0, 0, 1, 0, 0, 1, 1, 1.5};
    char switches[] = "Qz";
    struct triangulateio in, out;
    memset(&in, 0, sizeof in);
    memset(&out, 0, sizeof out);
    in.pointlist = points;
    in.numberofpoints = 4;
    if (triangulate(switches, &in, &out, NULL) != 0) return 1;
    printf("%d triangles\n", out.numberoftriangles);
    free(out.pointlist);
    free(out.pointmarkerlist);
    free(out.trianglelist);
    return 0;
}
