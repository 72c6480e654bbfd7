// A solver's data, carried from step to step: a mass for each cell, and for each vertex the list of its neighbours, in
// one array with offsets (compressed sparse rows). Both are updated from the change list, at the cost of what has
// changed, while all vertices of a cloud in space move and some come and go.
//
//   cc examples/solver.c -Iinclude target/release/libdeldrift.a -lm -lpthread -ldl -o solver && ./solver
#include <deldrift.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DIMENSION = 3, CORNERS = DIMENSION + 1, VERTICES = 2000, EXCHANGED = 20, STEPS = 50 };

static void check(deldrift_status status) {
    if (status == DELDRIFT_OK) return;
    fprintf(stderr, "%s: %s\n", deldrift_status_string(status), deldrift_last_error());
    exit(1);
}

static void *resized(void *array, size_t count, size_t size) {
    array = realloc(array, (count > 0 ? count : 1) * size);
    if (array == NULL) {
        fprintf(stderr, "no memory\n");
        exit(1);
    }
    return array;
}

static double random_number(void) {
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

// What the solver keeps.
typedef struct {
    // By cell index.
    double *mass;
    size_t cell_count;
    // By vertex id: where its neighbours are, how many, and for how many there is room.
    size_t *row;
    uint32_t *degree, *room;
    size_t id_count;
    uint32_t *neighbours;
    size_t used, capacity;
    // By vertex id: mass to be handed on, and cells to hand it to. All are zero between steps.
    double *loose;
    uint32_t *takers;
} solver;

// Masses of cells that are gone go to their vertices, and from these to the new cells there. (A real solver would take
// the volumes in which old and new cells overlap.)
static void carry_masses(solver *s, const deldrift_changes *changes, const deldrift_cells_view *view) {
    double *mass = resized(NULL, changes->renumbered_count, sizeof *mass);
    for (size_t k = 0; k < changes->removed_count; k++) {
        for (size_t i = 0; i < CORNERS; i++)
            s->loose[changes->removed_vertices[k * CORNERS + i]] += s->mass[changes->removed[k]] / CORNERS;
    }
    // An index may be free for one cell and taken by another: all old ones are read before a new one is written.
    for (size_t k = 0; k < changes->renumbered_count; k++) mass[k] = s->mass[changes->renumbered_from[k]];
    s->mass = resized(s->mass, view->count, sizeof *s->mass);
    s->cell_count = view->count;
    for (size_t k = 0; k < changes->renumbered_count; k++) s->mass[changes->renumbered_to[k]] = mass[k];
    free(mass);

    for (size_t k = 0; k < changes->created_count; k++) {
        const uint32_t *vertices = view->vertices + changes->created[k] * CORNERS;
        for (size_t i = 0; i < CORNERS; i++) s->takers[vertices[i]]++;
    }
    for (size_t k = 0; k < changes->created_count; k++) {
        const uint32_t *vertices = view->vertices + changes->created[k] * CORNERS;
        double *taken = &s->mass[changes->created[k]];
        *taken = 0;
        for (size_t i = 0; i < CORNERS; i++) *taken += s->loose[vertices[i]] / s->takers[vertices[i]];
    }
    // Vertices that have gone have no new cells: what is left of theirs goes to the first new cell.
    for (size_t k = 0; k < changes->star_count; k++) {
        uint32_t v = changes->stars[k];
        if (s->takers[v] == 0 && changes->created_count > 0) s->mass[changes->created[0]] += s->loose[v];
        s->loose[v] = 0;
        s->takers[v] = 0;
    }
}

// The neighbours of a vertex are those that share a cell with it. `seen` is all false before and after.
static void list_neighbours(solver *s, const deldrift_triangulation *t, const deldrift_cells_view *view, uint32_t v,
                            uint32_t **star, size_t *star_room, bool *seen) {
    size_t n_cells = 0;
    s->degree[v] = 0;
    deldrift_status status = deldrift_star(t, v, *star, *star_room, &n_cells);
    if (status == DELDRIFT_REMOVED_VERTEX) return;
    if (status == DELDRIFT_BUFFER_TOO_SMALL) {
        *star_room = 2 * n_cells;
        *star = resized(*star, *star_room, sizeof **star);
        status = deldrift_star(t, v, *star, *star_room, &n_cells);
    }
    check(status);
    // No more than this many; a row that is too short moves to the end.
    if (s->room[v] < DIMENSION * n_cells) {
        s->room[v] = (uint32_t)(DIMENSION * n_cells);
        if (s->used + s->room[v] > s->capacity) {
            s->capacity = 2 * (s->used + s->room[v]);
            s->neighbours = resized(s->neighbours, s->capacity, sizeof *s->neighbours);
        }
        s->row[v] = s->used;
        s->used += s->room[v];
    }
    uint32_t *row = s->neighbours + s->row[v];
    for (size_t k = 0; k < n_cells; k++) {
        for (size_t i = 0; i < CORNERS; i++) {
            uint32_t other = view->vertices[(*star)[k] * CORNERS + i];
            if (other == v || seen[other]) continue;
            seen[other] = true;
            row[s->degree[v]++] = other;
        }
    }
    for (uint32_t k = 0; k < s->degree[v]; k++) seen[row[k]] = false;
}

// Takes what has changed, whatever has happened since this was last called, and brings everything up to date.
static size_t follow(solver *s, deldrift_triangulation *t) {
    deldrift_changes changes;
    deldrift_cells_view view;
    check(deldrift_take_changes(t, &changes));
    check(deldrift_cells(t, &view));

    size_t n = 0;
    check(deldrift_id_count(t, &n));
    s->row = resized(s->row, n, sizeof *s->row);
    s->degree = resized(s->degree, n, sizeof *s->degree);
    s->room = resized(s->room, n, sizeof *s->room);
    s->loose = resized(s->loose, n, sizeof *s->loose);
    s->takers = resized(s->takers, n, sizeof *s->takers);
    for (; s->id_count < n; s->id_count++) {
        s->row[s->id_count] = 0;
        s->degree[s->id_count] = s->room[s->id_count] = s->takers[s->id_count] = 0;
        s->loose[s->id_count] = 0;
    }

    carry_masses(s, &changes, &view);
    size_t star_room = 64;
    uint32_t *star = resized(NULL, star_room, sizeof *star);
    bool *seen = resized(NULL, n, sizeof *seen);
    memset(seen, 0, n * sizeof *seen);
    for (size_t k = 0; k < changes.star_count; k++)
        list_neighbours(s, t, &view, changes.stars[k], &star, &star_room, seen);
    free(star);
    free(seen);
    return changes.created_count;
}

static int ascending(const void *a, const void *b) {
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

// Whether the lists are those that are made of all cells.
static bool lists_are_right(solver *s, deldrift_triangulation *t) {
    solver fresh = {0};
    deldrift_triangulation *same = NULL;
    double *positions = resized(NULL, s->id_count * DIMENSION, sizeof *positions);
    uint32_t *ids = resized(NULL, s->id_count, sizeof *ids), n = 0;
    for (uint32_t v = 0; v < s->id_count; v++) {
        if (deldrift_position(t, v, positions + (size_t)n * DIMENSION) == DELDRIFT_OK) ids[n++] = v;
    }
    check(deldrift_create(DIMENSION, positions, n, NULL, &same));
    follow(&fresh, same);
    bool are_right = fresh.cell_count == s->cell_count;
    for (uint32_t k = 0; k < n && are_right; k++) {
        uint32_t *ours = s->neighbours + s->row[ids[k]], *theirs = fresh.neighbours + fresh.row[k];
        for (uint32_t i = 0; i < fresh.degree[k]; i++) theirs[i] = ids[theirs[i]];
        qsort(ours, s->degree[ids[k]], sizeof *ours, ascending);
        qsort(theirs, fresh.degree[k], sizeof *theirs, ascending);
        are_right = s->degree[ids[k]] == fresh.degree[k] &&
                    memcmp(ours, theirs, fresh.degree[k] * sizeof *ours) == 0;
    }
    deldrift_destroy(same);
    free(positions);
    free(ids);
    free(fresh.mass), free(fresh.row), free(fresh.degree), free(fresh.room);
    free(fresh.neighbours), free(fresh.loose), free(fresh.takers);
    return are_right;
}

int main(void) {
    solver s = {0};
    double *positions = resized(NULL, (VERTICES + STEPS * EXCHANGED) * DIMENSION, sizeof *positions);
    for (size_t i = 0; i < VERTICES * DIMENSION; i++) positions[i] = random_number();
    deldrift_triangulation *t = NULL;
    check(deldrift_create(DIMENSION, positions, VERTICES, NULL, &t));
    follow(&s, t);
    for (size_t c = 0; c < s.cell_count; c++) s.mass[c] = 1;
    const double mass_before = (double)s.cell_count;

    uint32_t n = VERTICES, oldest = 0;
    size_t created = 0, all = 0;
    for (int step = 0; step < STEPS; step++) {
        // As many come as go, the oldest ones; all others move. One commit makes all of it.
        uint32_t leaving[EXCHANGED], first = 0;
        double *coming = positions + (size_t)n * DIMENSION;
        for (int k = 0; k < EXCHANGED; k++) leaving[k] = oldest++;
        for (size_t i = 0; i < EXCHANGED * DIMENSION; i++) coming[i] = random_number();
        check(deldrift_stage_removals(t, leaving, EXCHANGED));
        for (size_t i = (size_t)oldest * DIMENSION; i < (size_t)n * DIMENSION; i++)
            positions[i] += 2e-4 * (random_number() - 0.5);
        check(deldrift_move_vertices(t, NULL, positions, n));
        check(deldrift_stage_insertions(t, coming, EXCHANGED, &first));
        n = first + EXCHANGED;
        check(deldrift_commit_timestamp(t, NULL));
        created += follow(&s, t);
        all += s.cell_count;
    }

    double mass = 0;
    for (size_t c = 0; c < s.cell_count; c++) mass += s.mass[c];
    const bool is_kept = mass > mass_before * (1 - 1e-9) && mass < mass_before * (1 + 1e-9);
    const bool are_right = lists_are_right(&s, t);
    printf("%d steps, %zu of %zu cells new; mass %s, neighbours %s\n", STEPS, created, all,
           is_kept ? "kept" : "lost", are_right ? "right" : "wrong");
    deldrift_destroy(t);
    free(positions);
    free(s.mass), free(s.row), free(s.degree), free(s.room), free(s.neighbours), free(s.loose), free(s.takers);
    return is_kept && are_right ? 0 : 1;
}
