// A solver's data, carried from step to step: a mass of dye for each cell, updated from the change list at the cost of
// what has changed, while all vertices of a plane cloud go round in a vortex and some come and go.
//
//   cc examples/solver.c -Iinclude target/release/libdeldrift.a -lm -lpthread -ldl -o solver && ./solver picture.svg
#include <deldrift.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { DIMENSION = 2, CORNERS = DIMENSION + 1, VERTICES = 500, EXCHANGED = 2, STEPS = 90, SHOWN = 30 };
enum { PANEL = 3000, GAP = PANEL / 20, LINE = 200, WIDTH = PANEL + STEPS / SHOWN * (PANEL + GAP) };  // of the picture
enum { IDS = VERTICES + STEPS * EXCHANGED, MOST_CELLS = 2 * IDS };

static void check(deldrift_status status) {
    if (status == DELDRIFT_OK) return;
    fprintf(stderr, "%s: %s\n", deldrift_status_string(status), deldrift_last_error());
    exit(1);
}

static double random_number(void) {
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

// What the solver keeps: a mass by cell index; by vertex id a mass to be handed on, and the number of cells to hand it
// to, which are zero between steps.
static double mass[MOST_CELLS], loose[IDS];
static uint32_t takers[IDS];

// Masses of cells that are gone go to those of their vertices that have new cells, and from these to the new cells there.
// (A real solver would take the areas in which old and new cells overlap.)
static void carry(const deldrift_changes *changes, const deldrift_cells_view *view) {
    double rest = 0;
    for (size_t k = 0; k < changes->created_count; k++) {
        const uint32_t *vertices = view->vertices + changes->created[k] * CORNERS;
        for (size_t i = 0; i < CORNERS; i++) takers[vertices[i]]++;
    }
    for (size_t k = 0; k < changes->removed_count; k++) {
        const uint32_t *vertices = changes->removed_vertices + k * CORNERS;
        int n = 0;
        for (size_t i = 0; i < CORNERS; i++) n += takers[vertices[i]] > 0;
        for (size_t i = 0; i < CORNERS; i++)
            if (takers[vertices[i]] > 0) loose[vertices[i]] += mass[changes->removed[k]] / n;
        if (n == 0) rest += mass[changes->removed[k]];
    }
    // An index may be free for one cell and taken by another: all old ones are read before a new one is written.
    static double moved[MOST_CELLS];
    for (size_t k = 0; k < changes->renumbered_count; k++) moved[k] = mass[changes->renumbered_from[k]];
    for (size_t k = 0; k < changes->renumbered_count; k++) mass[changes->renumbered_to[k]] = moved[k];

    for (size_t k = 0; k < changes->created_count; k++) {
        const uint32_t *vertices = view->vertices + changes->created[k] * CORNERS;
        double *taken = &mass[changes->created[k]];
        *taken = k == 0 ? rest : 0;
        for (size_t i = 0; i < CORNERS; i++) *taken += loose[vertices[i]] / takers[vertices[i]];
    }
    for (size_t k = 0; k < changes->star_count; k++) loose[changes->stars[k]] = takers[changes->stars[k]] = 0;
}

// Takes what has changed, whatever has happened since this was last called.
static deldrift_cells_view follow(deldrift_triangulation *t, size_t *created) {
    deldrift_changes changes;
    deldrift_cells_view view;
    check(deldrift_take_changes(t, &changes));
    check(deldrift_cells(t, &view));
    carry(&changes, &view);
    *created += changes.created_count;
    return view;
}

static int shade_of(double density) { return 250 - (int)(200 * (density < 1 ? density : 1)); }

// The cells, the darker the more dye there is in them, and below them the number of the step.
static void draw(FILE *file, int step, const deldrift_cells_view *view, const double *positions, const double *areas) {
    const int panel = step / SHOWN;
    fprintf(file, "<text x='%d' y='%d' text-anchor='middle'>step %d</text>\n", panel * (PANEL + GAP) + PANEL / 2,
            PANEL + LINE, step);
    for (size_t c = 0; c < view->count; c++) {
        const int shade = shade_of(mass[c] / areas[c]);
        fprintf(file, "<path fill='rgb(%d,%d,250)' d='", shade, shade);
        for (size_t i = 0; i < CORNERS; i++) {
            const double *p = positions + (size_t)view->vertices[c * CORNERS + i] * DIMENSION;
            fprintf(file, "%c%.0f %.0f", i == 0 ? 'M' : 'L', panel * (PANEL + GAP) + PANEL * p[0], PANEL * p[1]);
        }
        fprintf(file, "z'/>\n");
    }
}

// What the shades mean.
static void draw_key(FILE *file) {
    const int top = PANEL + 2 * LINE;
    fprintf(file, "<text x='0' y='%d'>dye per area: 0</text>\n", top + LINE);
    for (int k = 0; k <= 10; k++)
        fprintf(file, "<rect x='%d' y='%d' width='%d' height='%d' fill='rgb(%d,%d,250)'/>\n", (9 + k) * LINE, top, LINE,
                LINE, shade_of(k / 10.0), shade_of(k / 10.0));
    fprintf(file, "<text x='%d' y='%d'>1</text>\n", 41 * LINE / 2, top + LINE);
}

int main(int argc, char **argv) {
    static double positions[IDS * DIMENSION], areas[MOST_CELLS];
    for (size_t i = 0; i < VERTICES * DIMENSION; i++) positions[i] = random_number();
    deldrift_triangulation *t = NULL;
    check(deldrift_create(DIMENSION, positions, VERTICES, NULL, &t));
    FILE *file = argc > 1 ? fopen(argv[1], "w") : tmpfile();
    if (file == NULL) return 1;
    fprintf(file, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %d %d'>\n", WIDTH, PANEL + 4 * LINE);
    fprintf(file, "<style>text{font:180px sans-serif} path,rect{stroke:gray;stroke-width:4}</style>\n");

    uint32_t n = VERTICES, oldest = 0;
    size_t created = 0, all = 0, count;
    double sum = 0, sum_before = 0;
    deldrift_cells_view view = follow(t, &created);
    for (int step = 0;; step++) {
        check(deldrift_volumes(t, areas, MOST_CELLS, &count));
        for (size_t c = 0; c < count && step == 0; c++) {  // dye in the lower half
            const bool is_low = positions[view.vertices[c * CORNERS] * DIMENSION + 1] > 0.5;
            sum_before += mass[c] = is_low ? areas[c] : 0;
        }
        if (step % SHOWN == 0) draw(file, step, &view, positions, areas);
        if (step == STEPS) break;

        // As many come as go, the oldest ones; all others move. One commit makes all of it.
        uint32_t leaving[EXCHANGED], first = 0;
        double *coming = positions + (size_t)n * DIMENSION;
        for (int k = 0; k < EXCHANGED; k++) leaving[k] = oldest++;
        for (size_t i = 0; i < EXCHANGED * DIMENSION; i++) coming[i] = random_number();
        for (size_t v = oldest; v < n; v++) {
            double *p = positions + v * DIMENSION, x = acos(-1) * p[0], y = acos(-1) * p[1];
            p[0] += 0.01 * sin(x) * cos(y);
            p[1] -= 0.01 * cos(x) * sin(y);
        }
        check(deldrift_stage_removals(t, leaving, EXCHANGED));
        check(deldrift_move_vertices(t, NULL, positions, n));
        check(deldrift_stage_insertions(t, coming, EXCHANGED, &first));
        n = first + EXCHANGED;
        check(deldrift_commit_timestamp(t, NULL));
        view = follow(t, &created);
        all += view.count;
    }
    draw_key(file);
    fprintf(file, "</svg>\n");
    bool is_kept = fclose(file) == 0;
    for (size_t c = 0; c < view.count; c++) {
        sum += mass[c];
        is_kept = is_kept && mass[c] >= 0;
    }
    is_kept = is_kept && fabs(sum - sum_before) < 1e-9 * sum_before;
    printf("%d steps, %zu of %zu cells new; mass %s\n", STEPS, created, all, is_kept ? "kept" : "lost");
    deldrift_destroy(t);
    return is_kept ? 0 : 1;
}
