// A libqhull_r of another version, whose structures may be others: calls are passed on to it as they are.
#include <stddef.h>

const char qh_version2[] = "qhull_r 9.0.0 (2099.1.r 2099/01/01)";

int qh_new_qhull(void *qh, int dim, int numpoints, double *points, unsigned int ismalloc, char *command, void *outfile,
                 void *errfile) {
    return qh == points && dim == 2 && numpoints == 4 && ismalloc == 0 && command != NULL && outfile == NULL &&
           errfile == NULL ? 77 : 1;
}
