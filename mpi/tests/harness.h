// Sets of points spread over processes, and the comparison of what they have with the triangulation of one process.
#ifndef DELDRIFT_MPI_HARNESS_H
#define DELDRIFT_MPI_HARNESS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "deldrift_mpi.h"

#define CHECK(condition) check(condition, #condition, __FILE__, __LINE__)
#define OK(call)         CHECK((call) == DELDRIFT_OK)

extern int rank, size;

// Counts a failure; the program goes on, so that collective calls stay in step.
void check(bool holds, const char *text, const char *file, int line);
extern long failures;
extern long compared_cells; // of the whole, by is_serial

uint64_t random_bits(uint64_t *state);
double random_number(uint64_t *state); // from 0 to 1

typedef enum { RANDOM, LATTICE, SHEARED, CLUSTERS, SPHERE, LINE, PLANE, DUPLICATES, KINDS } point_kind;
extern const char *const kind_names[KINDS];

typedef enum { SLABS, SCATTERED, BLOCKS, FIRST_EMPTY, ONE_OWNS_ALL, FEW_ELSEWHERE, SPREADS } point_spread;
extern const char *const spread_names[SPREADS];

// The points of all processes, the same on each, with ids that are no places; a part of them is own.
typedef struct {
    uint32_t dimension;
    size_t count, own_count;
    double *positions; // of all
    uint64_t *ids;     // of all
    int *owners;       // of all
    double *own;       // positions of own ones
    uint64_t *own_ids;
} point_set;

point_set make_points(uint32_t dimension, point_kind kind, point_spread spread, size_t count, uint64_t seed);
void free_points(point_set *p);
// Own positions and ids again, from those of all.
void collect_own(point_set *p);

// Bytes of all processes, one behind the other, on each.
void *gather(const void *mine, size_t bytes, size_t *total);

// Whether vertices have weights; those of own ones, and whether those that one process hides are hidden here, each in a
// cell of the whole, given their ids in the order of that one.
bool has_weights(const deldrift_triangulation *t);
void read_weights(const deldrift_mpi *m, double *weights);
bool hides_the_same(const deldrift_mpi *m, const deldrift_triangulation *serial, const uint64_t *ids);
extern long compared_hidden; // vertices that are hidden by this comparison

// Sorts rows, and the ids in each.
void sort_sets(uint64_t *rows, size_t count, uint32_t length);

// Whether the union of own cells is exactly the triangulation of all vertices, each cell owned once; whether this
// process has exactly the cells with an own vertex; whether hull facets are those of the whole. What all own is
// gathered: no argument but m. Collective; the answer is the same on all.
bool is_serial(const deldrift_mpi *m, uint32_t dimension, const char *label);

#endif
