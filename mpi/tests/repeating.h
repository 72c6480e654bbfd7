// Histories in boxes that repeat, and the comparison of what processes have with the periodic triangulation of one.
#ifndef DELDRIFT_MPI_REPEATING_H
#define DELDRIFT_MPI_REPEATING_H

#include "harness.h"

typedef enum { ANYWHERE, CUBES, FEW, CLUSTER, MEETING, SETS } set_kind;
extern const char *const set_names[SETS];

// By dimension the boxes: orthogonal, triclinic, skewed by many of its lengths, flat, one with fewer vectors, and one
// of a vector that is along no axis.
enum { BOXES = 6 };
extern const double boxes[2][BOXES][9];
extern const size_t vector_counts[2][BOXES];

// A cell: its corners in the order of ids and shifts, each with its shift.
typedef struct {
    uint64_t id;
    int64_t shift[3];
} corner;

typedef struct {
    corner corners[4];
} cell;

typedef struct {
    uint32_t dimension;
    size_t vector_count;
    double vectors[9];
    set_kind kind;
    deldrift_mpi *m;
    double *positions; // of own vertices, as they were given
    double heaviest;   // weights are up to this, and 0 without weights
    size_t count;
    double amplitude;
    uint64_t state;  // differs between processes
    uint64_t common; // is the same on all
    uint64_t next_id;
    long commits, refusals, migrations, edits, strains, rebuilds, cells, weighted;
    cell *taken; // own cells when changes were last taken
    size_t taken_count;
    bool has_taken;
    long changes;
} history;

// Weights for as many vertices, to be freed.
double *make_weights(history *h, size_t count);

// A place in the box, in any of some periods.
void place(const history *h, uint64_t *state, double *x);

// Own cells when changes were last taken, without those that are said to be removed, and with those that are said to be
// created, are those now. Collective.
void follow_changes(history *h, const deldrift_mpi_changes *changes);
void check_changes(history *h); // takes them

// Makes a triangulation of n vertices, of which a part is own: in slabs (0), scattered (1), all of one process.
void begin(history *h, size_t n, int spread, const deldrift_mpi_options *options);

// Whether what processes own together are exactly the classes of cells of all vertices, and each process has all cells
// at its own ones. Collective; the answer is the same on all.
bool is_right(history *h, const char *label);

// Copies are where the positions that their owners give are, translated by what is told. Voronoi cells fill the box.
void check_places(const history *h);

#endif
