// A program with a libqhull_r of another version.
#include <stdio.h>

int qh_new_qhull(void *qh, int dim, int numpoints, double *points, unsigned int ismalloc, char *command, void *outfile,
                 void *errfile);

int main(void) {
    double points[] = {0, 0, 1, 0, 0, 1, 1, 1.1};
    char command[] = "qhull d Qt Qbb Qc Qz";
    const int returned = qh_new_qhull(points, 2, 4, points, 0, command, NULL, NULL);
    if (returned == 77) return 0;
    fprintf(stderr, "returned %d\n", returned);
    return 1;
}
