// What the files of libdeldrift_mpi know of each other.
#ifndef DELDRIFT_MPI_INTERNAL_H
#define DELDRIFT_MPI_INTERNAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "deldrift_mpi.h"

enum {
    DM_MESSAGE = 512, // room for an error message
    DM_CHUNK = 1024,  // vertices in a message of a push round
    DM_MAX_BOXES = 256,
};

// Own vertices that a peer has a copy of, or copies that came from it, by local id. Both processes have them in one
// order.
typedef struct {
    uint32_t *at;
    uint32_t *period;    // by which translation it is there
    uint8_t *is_leaving; // by place in the list: goes with the timestamp that is being prepared
    size_t count;
    size_t settled; // those of the timestamp in force; the others have come since
    size_t pushed;  // those that have gone to the other process
    size_t capacity;
} dm_list;

typedef struct {
    int rank;
    dm_list sent, received;
    double *outgoing, *incoming; // positions in the order of the lists, with room for all of them
    size_t outgoing_room, incoming_room;
    MPI_Request requests[2]; // persistent: to send outgoing, to receive incoming
    size_t requested[2];     // for how many vertices each was made
} dm_peer;

// Where vertices of a process are: closed boxes, each with the spacing of what is in it.
typedef struct {
    double low[3], high[3], spacing;
} dm_box;

// One own vertex of a set that spans what all own ones span.
typedef struct {
    double position[3];
    uint64_t id;
    uint32_t vertex; // local id
    int32_t owner;
    uint32_t period; // by which translation it is at the position
} dm_basis_point;

typedef struct {
    dm_basis_point points[4];
    int32_t count;
    int32_t has_no_cells; // though the process owns vertices
} dm_basis;

// What an id stood for, to be put back.
typedef struct {
    uint32_t vertex;
    int32_t owner;
    uint32_t period;
    uint64_t id;
    size_t order; // among those since changes were last taken
} dm_undo;

// By which translations vertices repeat: numbers of them, of which 0 leaves everything where it is.
typedef struct {
    deldrift_triangulation *box; // of no vertices, which wraps positions; NULL where the set is open
    uint32_t rank;               // how many vectors it has
    double given[9];
    double measure;   // product of the lengths of reduced vectors
    size_t count;     // of translations
    uint32_t greatest[3]; // multiples of the reduced vectors
    uint32_t unit[3];     // translations by one of these
    double *ways;     // by translation: what is added to a position
    int64_t *shifts;  // by translation: multiples of the given vectors
} dm_lattice;

// Other vectors that take the place of those in force, and what periods become by their numbers.
typedef struct {
    dm_lattice lattice;    // the other one; while it is in force, the one that was
    uint32_t *forth, *back; // DELDRIFT_NONE where there is no such period; NULL where the lattices differ too much
} dm_strain;

// Own cells of a periodic box, each by its corners in the order of ids and shifts, the first in the period 0.
typedef struct {
    uint64_t *ids;
    int64_t *shifts;
    size_t count;
    uint32_t *table; // by hash: the number of a cell from 1 on, or 0
    size_t slots;    // a power of two
} dm_classes;

// The first thing that this process refused in the collective call that runs.
typedef struct {
    deldrift_status status;
    char message[DM_MESSAGE];
} dm_refusal;

struct deldrift_mpi {
    MPI_Comm comm;
    int rank, size;
    uint32_t dimension;
    uint32_t row; // numbers of a point: coordinates, and a weight where there are weights
    deldrift_mpi_options options;
    deldrift_options local;
    deldrift_triangulation *t;
    dm_lattice lattice;
    uint64_t timestamp;
    bool is_prepared; // t has rounds that are neither published nor withdrawn
    dm_refusal refusal;
    deldrift_mpi_report report;

    // By local id. `where` has the positions of the timestamp that is being prepared; between commits, of that in
    // force.
    size_t ids, ids_room;
    uint64_t *id_of;
    int32_t *owner_of;
    uint32_t *period_of; // the translation from its place at home, by which a copy is here
    uint8_t *is_own;
    uint8_t *is_leaving;
    double *where;
    double *weight_of; // room for weights on their way to `where`; NULL without weights
    uint32_t *stamp;
    uint32_t stamped;
    // Vertices that have moved, with those of the halo; room for all ids.
    uint32_t *moved;
    size_t moved_count, moved_room;
    uint64_t sent_since_drop;
    bool has_dropped; // in the commit that runs
    uint64_t was_spanning;

    // Own vertices in the order of their list: local ids, and the box that each is in.
    uint32_t *own;
    uint16_t *box_of;
    // In a periodic box the multiples of the vectors by which the program's position is translated from that at home.
    int64_t *wraps;
    size_t own_count, own_room;
    // Those of the timestamp that is being prepared, and where they are: `points` is that, or an array of the caller.
    uint32_t *next_own;
    uint16_t *next_box_of;
    int64_t *next_wraps;
    double *next_points;
    size_t next_count, next_room;
    const double *points;
    // In a periodic box what a commit is given, at home, and where own vertices are.
    double *home, *home_before;
    int64_t *home_wraps;
    size_t home_room;

    // Staged by the program.
    double *insertion_points; // at home
    int64_t *insertion_wraps;
    uint64_t *insertion_ids;
    size_t insertion_count, insertion_room;
    uint8_t *is_removal; // by place; all 0 without removals
    size_t removal_count, removal_room;

    // options.boxes for each process, empty ones with low above high.
    dm_box *boxes, *next_boxes;
    bool has_next_boxes; // else those in force are those of the timestamp that is being prepared
    double extent;       // sum of the longest sides of own boxes when vertices were put into them
    double displacement; // longest coordinate of a displacement in the last commit, which says how much room boxes need

    dm_peer *peers;
    size_t peer_count, peer_room;
    int32_t *peer_of; // by rank, -1 without a peer

    dm_undo *undo;
    size_t undo_count, undo_room;

    // Changes: whether they have been taken, what ids stood for then, and the lists that were given last.
    bool has_taken;
    dm_undo *rebound;
    size_t rebound_count, rebound_room;
    deldrift_mpi_changes changes;
    uint64_t *created, *removed;
    uint32_t *created_cells;
    size_t created_room, removed_room, created_cell_room;
    // In a periodic box, in place of notes, own cells as they were then.
    dm_classes told;
    int64_t *created_shifts, *removed_shifts;
    size_t created_shift_room, removed_shift_room;

    // Scratch room.
    double *low, *high; // boxes that are asked about
    int *box_ranks;     // of what process, or first process of a group
    int *nodes;         // processes, or groups of them
    uint32_t *box_periods; // by which translation copies come to the box
    size_t box_room;
    size_t *offsets;
    size_t offset_room;
    uint32_t *found;
    size_t found_room;
    uint32_t *vertices;
    size_t vertex_room;
    double *coordinates;
    size_t coordinate_room;
    double *unzipped, *weights; // positions and weights, for deldrift.h
    size_t unzipped_room, weight_room;
    double *given; // points of a commit, where there are weights
    size_t given_room;
    uint64_t *numbers;
    size_t number_room;
    char *outgoing, *incoming; // records of a push round
    size_t outgoing_room, incoming_room, incoming_bytes;
    struct dm_chunk *chunks;
    size_t chunk_count, chunk_room;
    MPI_Request *requests;
    size_t request_room;
    char *chunk; // a chunk that arrives
    dm_basis *bases;
    void *migrated; // data that came with vertices
};

typedef struct dm_chunk {
    int source;
    size_t order, offset, count;
} dm_chunk;

// memory.c: false, and a refusal, where there is no memory. Room for `needed` elements; what is there stays.
bool dm_reserve(dm_refusal *refusal, void *array, size_t *room, size_t needed, size_t size);
void *dm_allocate(dm_refusal *refusal, size_t count, size_t size);
bool dm_reserve_list(dm_refusal *refusal, dm_list *list, size_t needed);
bool dm_reserve_ids(deldrift_mpi *m, size_t ids);
bool dm_reserve_own(deldrift_mpi *m, size_t count);

// agreement.c
typedef struct {
    deldrift_status status; // DELDRIFT_OK, or that of the lowest process that refused
    int64_t most[4];        // the greatest of each process's numbers
} dm_vote;
void dm_refuse(dm_refusal *refusal, deldrift_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
// Remembers the status of a call of deldrift, with its message. True if it is DELDRIFT_OK.
bool dm_took(dm_refusal *refusal, deldrift_status status);
// One reduction. Where a process has refused, all have its message afterwards.
dm_vote dm_decide(MPI_Comm comm, const dm_refusal *refusal, const int64_t numbers[4]);
// For calls of one process: the message of what it refused.
deldrift_status dm_fail(const dm_refusal *refusal);
deldrift_status dm_no_handle(void);
bool dm_check_points(dm_refusal *refusal, const char *name, uint32_t dimension, const double *positions, size_t count,
                     const uint8_t *is_skipped);

// The same of weights.
bool dm_check_weights(dm_refusal *refusal, const double *weights, size_t count, const uint8_t *is_skipped);

// points.c: points as rows of numbers, where deldrift.h has weights in an array of their own.
void dm_zip(uint32_t dimension, uint32_t row, const double *positions, const double *weights, size_t count,
            double *points);
// Points become positions, and their weights are told; NULL without weights.
bool dm_unzip(deldrift_mpi *m, const double **points, size_t count, const double **weights);
// `where` becomes what the triangulation has. Allocates nothing.
void dm_copy_points(deldrift_mpi *m);
bool dm_wrap_points(dm_refusal *refusal, const deldrift_mpi *m, const double *points, size_t count, double *places,
                    int64_t *shifts);
// Positions of own vertices become their points, with these weights; what is not given, NULL, stays as it is.
bool dm_take_points(deldrift_mpi *m, const double **positions, const double *weights);

// boxes.c
// Puts `points` into boxes of their own, `boxes` of them at most; box_of receives that of each.
void dm_make_boxes(deldrift_mpi *m, dm_box *boxes, uint16_t *box_of);
// Fits boxes around the points that are in them already.
void dm_fit_boxes(deldrift_mpi *m, dm_box *boxes, const uint16_t *box_of);
bool dm_is_in_box(const deldrift_mpi *m, const dm_box *box, const double *point);
bool dm_is_empty_box(const dm_box *box);
const dm_box *dm_boxes_now(const deldrift_mpi *m);
double dm_boxes_extent(const deldrift_mpi *m, const dm_box *boxes);
// Widens own boxes for the displacements to come, and lets all processes know each other's.
void dm_share_boxes(deldrift_mpi *m, dm_box *own);

// periods.c
bool dm_make_lattice(dm_refusal *refusal, dm_lattice *lattice, uint32_t dimension, const double *vectors, size_t rank);
void dm_free_lattice(dm_lattice *lattice);
uint32_t dm_opposite(uint32_t period);
// The number of a translation by multiples of the reduced vectors; DELDRIFT_NONE if these are too great.
uint32_t dm_period_of(const dm_lattice *lattice, const int64_t multiples[3]);
void dm_translate(const deldrift_mpi *m, double *to, const double *from, uint32_t period);
void dm_translate_point(const deldrift_mpi *m, double *to, const double *from, uint32_t period);
bool dm_wrap(dm_refusal *refusal, const dm_lattice *lattice, const double *positions, const double *near, size_t count,
             double *places, int64_t *shifts);
// Has what a commit is given in m->home, and where each comes from in m->home_wraps; positions become these.
bool dm_come_home(deldrift_mpi *m, const dm_lattice *lattice, const double **positions);
// By id the multiples by which a vertex is translated from where its owner has given it, in rows to be freed.
// Collective.
deldrift_status dm_read_periods(deldrift_mpi *m, dm_refusal *refusal, int64_t **rows);
// Own vertices where they are; in a periodic box all in the unit cell.
bool dm_unit_places(const deldrift_mpi *m, dm_refusal *refusal, double *places);

// strain.c: other vectors by a commit of moves.
bool dm_make_strain(dm_refusal *refusal, const deldrift_mpi *m, const double *vectors, dm_strain *strain);
void dm_free_strain(dm_strain *strain);
// Whether all copies have a period by the other vectors, so that none has to be found anew.
bool dm_can_strain(const deldrift_mpi *m, const dm_strain *strain);
// Puts the other vectors in force, and takes that back.
void dm_strain_copies(deldrift_mpi *m, dm_strain *strain);
void dm_unstrain_copies(deldrift_mpi *m, dm_strain *strain);

// peers.c
dm_peer *dm_peer_of(deldrift_mpi *m, int rank);
// Makes room for the exchange, before processes agree to make it.
bool dm_make_peers_ready(deldrift_mpi *m);
// Sends positions of own vertices that others have copies of, and receives those of the halo into `where`; marks what
// leaves.
void dm_exchange_positions(deldrift_mpi *m);
void dm_settle_peers(deldrift_mpi *m);
void dm_restore_peers(deldrift_mpi *m);
void dm_free_peers(deldrift_mpi *m);

// reach.c
// Adds to the peers' lists own vertices near their boxes, in a periodic box. Collective.
void dm_seed(deldrift_mpi *m);
// Adds to the peers' lists own vertices that these may need and do not have, and returns how many.
size_t dm_find_sends(deldrift_mpi *m);
// Marks those that peers have and do not need, by the wider boxes of the rule for dropping.
bool dm_find_drops(deldrift_mpi *m);

// span.c
// Decides, where a process has no cells, whether the vertices of all processes span the dimension. If they do, the
// owners of some that do add them to the lists of the processes without cells.
bool dm_span(deldrift_mpi *m, bool has_no_cells);

// vertices.c
// Stages insertions, whose ids are in m->vertices then, which has room for them.
bool dm_insert(deldrift_mpi *m, const double *points, const uint64_t *ids, size_t count);
void dm_set_vertex(deldrift_mpi *m, uint32_t vertex, int32_t owner, uint32_t period, uint64_t id,
                   const double *point);
void dm_unset_vertex(deldrift_mpi *m, uint32_t vertex);
// What ids stood for before the timestamp that is being prepared.
void dm_unbind(deldrift_mpi *m);

// push.c
bool dm_pack_sends(deldrift_mpi *m);
void dm_push(deldrift_mpi *m);
bool dm_stage_received(deldrift_mpi *m);

// phases.c: the two phases of a commit on the triangulation of the process.
bool dm_prepare(deldrift_mpi *m);
void dm_publish(deldrift_mpi *m);
void dm_withdraw(deldrift_mpi *m);

// commit.c Makes new positions in a box of other vectors the next timestamp, if the vectors are near those in force.
// All agree on that. Collective.
deldrift_status dm_commit_strain(deldrift_mpi *m, const double *positions, const double *vectors, bool *is_done);

// rounds.c
// Pushes until nobody sends, or a process refuses: all return the status of that.
deldrift_status dm_rounds(deldrift_mpi *m);
// What the triangulation and the lists say becomes, or does not become, the timestamp in force.
void dm_settle(deldrift_mpi *m);
void dm_count_copies(deldrift_mpi *m); // to the report
void dm_restore(deldrift_mpi *m);

// changes.c
// What the ids that have been given or taken away in a commit stood for.
void dm_note_rebound(deldrift_mpi *m);

// classes.c
// The lists of changes in a periodic box. Collective; where it is refused, nothing has been taken.
deldrift_status dm_take_classes(deldrift_mpi *m, dm_refusal *refusal);
void dm_free_classes(dm_classes *classes);

// reading.c
// The corner of the least global id; of several images of that vertex the first by position.
uint32_t dm_least(const deldrift_mpi *m, const uint32_t *corners, uint32_t count);

// create.c
// The triangulation of own vertices, for the first time: `points`, at home, with `ids` and `wraps`. Collective.
deldrift_status dm_build(deldrift_mpi *m, const double *points, const uint64_t *ids, const int64_t *wraps,
                         size_t count);
// Puts what has been built in the place of what there was.
void dm_replace(deldrift_mpi *m, deldrift_mpi *fresh);
// With weights if a row has a number more than the dimension.
deldrift_mpi *dm_new(dm_refusal *refusal, MPI_Comm comm, uint32_t dimension, uint32_t row,
                     const deldrift_mpi_options *options, const deldrift_options *local, const double *vectors,
                     size_t vector_count);
// All but the communicator and the handle itself.
void dm_free(deldrift_mpi *m);

// fault.c, in the build for tests alone: which of the faults that tests plant is in force, and how much memory there
// is.
#ifdef DELDRIFT_MPI_TESTING
enum {
    DM_FAULT_NONE,
    DM_FAULT_SMALL_REACH,
    DM_FAULT_LOST_MESSAGE,
    DM_FAULT_HALF_SPACE,
    DM_FAULT_STALE_HALO,
    DM_FAULT_NO_ROUND,
    DM_FAULT_LOCAL_KEYS,
    DM_FAULT_NO_PERIOD,
};
extern int deldrift_mpi_fault;
extern long deldrift_mpi_allocations_left; // negative: no limit
extern bool deldrift_mpi_is_preparing;     // while deldrift_prepare_timestamp runs
extern long deldrift_mpi_asked;            // boxes that have been asked about
#define DM_COUNT_ASKED(n)    (deldrift_mpi_asked += (long)(n))
#define DM_SET_PREPARING(is) (deldrift_mpi_is_preparing = (is))
#define DM_HAS_FAULT(name)   (deldrift_mpi_fault == (name))
#else
#define DM_HAS_FAULT(name)   false
#define DM_SET_PREPARING(is) ((void)0)
#define DM_COUNT_ASKED(n)    ((void)0)
#endif

#endif
