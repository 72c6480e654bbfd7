/* The steps of bench.py in C, on one thread: reads dimension, number of points, number of frames and positions of all
 * frames from a file; then for each line of the input makes a step (positions in, cells, neighbours and changes out), and
 * prints how many seconds of the processor it took. */
#include <deldrift.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void must(deldrift_status status) {
    if (status != DELDRIFT_OK) {
        fprintf(stderr, "%s\n", deldrift_last_error());
        exit(1);
    }
}

int main(int argc, char **argv) {
    uint64_t head[3];
    FILE *file = argc == 2 ? fopen(argv[1], "rb") : NULL;
    if (!file || fread(head, sizeof head[0], 3, file) != 3) return 1;
    size_t dimension = head[0], count = head[1], frames = head[2], numbers = dimension * count;
    double *positions = malloc(frames * numbers * sizeof *positions);
    if (!positions || fread(positions, sizeof *positions, frames * numbers, file) != frames * numbers) return 1;
    fclose(file);

    deldrift_triangulation *t;
    deldrift_cells_view cells;
    deldrift_changes changes;
    deldrift_commit_report report;
    deldrift_options options;
    deldrift_options_init(&options);
    options.threads = 1;
    must(deldrift_create((uint32_t)dimension, positions, count, &options, &t));
    must(deldrift_cells(t, &cells));
    must(deldrift_take_changes(t, &changes));
    for (size_t frame = 1; frame < frames && getchar() == '\n'; frame++) {
        double start = now();
        must(deldrift_commit_positions(t, positions + frame * numbers, count, &report));
        must(deldrift_cells(t, &cells));
        must(deldrift_take_changes(t, &changes));
        printf("%.9f\n", now() - start);
        fflush(stdout);
    }
    deldrift_destroy(t);
    free(positions);
}
