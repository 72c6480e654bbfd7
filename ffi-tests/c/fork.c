// A process that forks after calls on several threads, and while other threads are in such calls: the new process works
// on with the triangulations it has, and with new ones.
#define _POSIX_C_SOURCE 200809L
#include "check.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

// How often to fork while another thread is in calls. Not at all under the address sanitizer: its allocator does not
// release its locks in the new process, which then waits for ever where the other thread was about to allocate.
#ifdef __SANITIZE_ADDRESS__
enum { FORKS = 0 };
#else
enum { FORKS = 5 };
#endif

// For the same reason the library's own threads are given time to fall asleep: when a call returns, one of them may still
// be about to free what it was given.
static void let_threads_sleep(void) {
#ifdef __SANITIZE_ADDRESS__
    struct timespec tenth = {0, 100000000};
    nanosleep(&tenth, NULL);
#endif
}

enum { COUNT = 2000, THREADS = 3 };

static deldrift_triangulation *created(uint32_t dimension, const double *positions) {
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = DELDRIFT_REPAIR;
    options.threads = THREADS;
    return create(dimension, positions, COUNT, &options);
}

static void commit(deldrift_triangulation *t, uint32_t dimension, double *positions, uint64_t *state) {
    for (size_t i = 0; i < COUNT * dimension; i++) positions[i] += 1e-3 * next_random(state);
    OK(deldrift_move_vertices(t, NULL, positions, COUNT));
    OK(deldrift_commit_timestamp(t, NULL));
}

// Calls on several threads, on triangulations that are there and on new ones.
static void work(deldrift_triangulation *t, uint32_t dimension, double *positions) {
    uint64_t state = 5;
    commit(t, dimension, positions, &state);
    OK(deldrift_validate(t, 3));
    deldrift_triangulation *other = created(dimension, positions);
    commit(other, dimension, positions, &state);
    OK(deldrift_validate(other, 3));
    deldrift_destroy(other);
}

// `are_others` tells whether other threads are in calls: what these have allocated is nobody's in the new process,
// which then ends without looking for leaks.
static void in_new_process(deldrift_triangulation *t, uint32_t dimension, double *positions, bool are_others) {
    let_threads_sleep();
    pid_t child = fork();
    CHECK(child >= 0);
    if (child == 0) {
        alarm(60);
        work(t, dimension, positions);
        if (are_others) raise(SIGKILL);
        deldrift_destroy(t);
        free(positions);
        exit(0);
    }
    int status = 0;
    CHECK(waitpid(child, &status, 0) == child);
    CHECK(are_others ? WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL
                     : WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

static atomic_bool is_done;

static void *commit_until_done(void *unused) {
    (void)unused;
    double *positions = random_positions(2, COUNT, 3);
    deldrift_triangulation *t = created(2, positions);
    uint64_t state = 4;
    while (!is_done) commit(t, 2, positions, &state);
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
    free(positions);
    return NULL;
}

int main(void) {
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        double *positions = random_positions(dimension, COUNT, 1);
        deldrift_triangulation *t = created(dimension, positions);
        work(t, dimension, positions);
        in_new_process(t, dimension, positions, false);
        pthread_t other;
        is_done = false;
        CHECK(pthread_create(&other, NULL, commit_until_done, NULL) == 0);
        for (int k = 0; k < FORKS; k++) {
            in_new_process(t, dimension, positions, true);
            work(t, dimension, positions);
        }
        is_done = true;
        CHECK(pthread_join(other, NULL) == 0);
        deldrift_destroy(t);
        free(positions);
    }
    return 0;
}
