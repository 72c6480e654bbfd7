// One process dies in the middle of a series of commits, which the others go on making: tests/dying runs this, and
// looks how the program ends.
//     dying HOW FOLDER    each process writes its number in the system to FOLDER/pid.RANK, and what is about to happen
//                         to FOLDER/died
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness.h"
#include "internal.h"

enum {
    OWN = 20000, // so many that a commit calls back
    STEPS = 6,
    FATAL_STEP = 3,
    TAG_OF_PUSH = 2,
};

static const char *folder;
static volatile bool dies_within;

static void write_number(const char *name, long number) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    if (!file) abort();
    fprintf(file, "%ld\n", number);
    fclose(file);
}

// Anywhere in this process's strip of a square: others need new copies after each step.
static void place(double *points, uint64_t *state) {
    for (size_t i = 0; i < OWN; i++) {
        points[2 * i] = (rank + random_number(state)) / size;
        points[2 * i + 1] = random_number(state);
    }
}

static bool cancel(void *user_data) {
    (void)user_data;
    if (!dies_within) return false;
    write_number("died", FATAL_STEP);
    raise(SIGKILL);
    return false;
}

static void die(const char *how, const deldrift_mpi *m) {
    if (!strcmp(how, "within")) {
        dies_within = true;
        return;
    }
    write_number("died", FATAL_STEP);
    if (!strcmp(how, "exit")) _exit(0);
    if (!strcmp(how, "fail")) _exit(3);
    if (!strcmp(how, "kill")) raise(SIGKILL);
    if (!strcmp(how, "abort")) MPI_Abort(MPI_COMM_WORLD, 7);
    if (!strcmp(how, "error")) {
        // More than the receiver has room for: an error of MPI in the library's own communicator.
        size_t bytes = 2 * DM_CHUNK * 64;
        char *message = calloc(bytes, 1);
        MPI_Request request;
        MPI_Isend(message, (int)bytes, MPI_BYTE, 0, TAG_OF_PUSH, m->comm, &request);
    }
}

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (argc < 3) return 2;
    const char *how = argv[1];
    folder = argv[2];
    char name[32];
    snprintf(name, sizeof name, "pid.%d", rank);
    write_number(name, (long)getpid());
    // Errors of MPI are to come back from the program's own calls.
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    deldrift_options local;
    deldrift_mpi_options options;
    deldrift_options_init(&local);
    deldrift_mpi_options_init(&options);
    local.threads = 1;
    local.cancel = cancel;
    options.local = &local;
    uint64_t state = 5 + (uint64_t)rank;
    double *points = malloc(2 * OWN * sizeof *points);
    deldrift_mpi *m = NULL;
    place(points, &state);
    OK(deldrift_mpi_create(MPI_COMM_WORLD, 2, points, NULL, OWN, &options, &m));
    for (int step = 1; step <= STEPS; step++) {
        // What has been told before is written by then, however soon the launcher ends the others.
        if (step == FATAL_STEP) MPI_Barrier(MPI_COMM_WORLD);
        if (step == FATAL_STEP && rank == size - 1) die(how, m);
        place(points, &state);
        OK(deldrift_mpi_commit(m, points, OWN, NULL));
        if (rank == 0) write_number("steps", step);
    }
    deldrift_mpi_destroy(m);
    free(points);
    MPI_Finalize();
    return failures ? 1 : 0;
}
