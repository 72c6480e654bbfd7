// Calls that only read at the same time on several threads: every two of them, right after a change. Each gives what it gives
// by itself.
#ifndef MEETING_H
#define MEETING_H

#include "states.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>

// COPIES stands for a copy that tells its cells and changes, and NOBODY for the end.
enum { N_THREADS = 3, MANY = 700, ROUNDS = 4, COPIES = 1000, NOBODY = 1001 };

// Of a round: what each thread calls, and what has come of it. A thread begins when the number of the round has grown.
static struct {
    size_t call;
    answer given;
} turns[N_THREADS];

static atomic_size_t round_number, n_ready, n_done;
static size_t n_meetings, n_wrong;

static void wait_for(atomic_size_t *number, size_t value) {
    while (atomic_load(number) < value) sched_yield();
}

static uint64_t told_by(deldrift_triangulation *of);

static uint64_t told_by_copy(void) {
    deldrift_triangulation *const copy = spare();
    const uint64_t sum = told_by(copy);
    deldrift_destroy(copy);
    return sum;
}

static void meet(size_t thread, size_t this_round) {
    // So that they begin as nearly at once as can be.
    atomic_fetch_add(&n_ready, 1);
    for (size_t spins = 0; atomic_load(&n_ready) < N_THREADS * this_round; spins++) {
        if (spins > 1000) sched_yield();
    }
    answer *const given = &turns[thread].given;
    if (turns[thread].call == COPIES) {
        given->more = told_by_copy();
    } else {
        given->status = ask(turns[thread].call, &given->more);
        given->out = out;
    }
    atomic_fetch_add(&n_done, 1);
}

// Each writes files of its own.
static void name_path(size_t thread) {
    const char *const folder = getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/deldrift-pairs-%d-%zu", folder == NULL ? "/tmp" : folder, (int)getpid(), thread);
}

static void *attend(void *number) {
    name_path(*(size_t *)number);
    for (size_t this_round = 1;; this_round++) {
        wait_for(&round_number, this_round);
        if (turns[0].call == NOBODY) {
            unlink(path);
            return NULL;
        }
        meet(*(size_t *)number, this_round);
    }
}

// One round, on the triangulation in use.
static void hold(size_t x, size_t y) {
    const size_t this_round = atomic_load(&round_number) + 1;
    turns[0].call = turns[2].call = x;
    turns[1].call = y;
    atomic_store(&round_number, this_round);
    meet(0, this_round);
    wait_for(&n_done, N_THREADS * this_round);
    n_meetings++;
}

static void wrong(const char *where, size_t change, size_t k) {
    if (n_wrong++ < 50) {
        printf("%uD, %s, %s: %s beside %s or %s: another answer\n", dimension, where, calls[change].text,
               calls[turns[k].call].text, calls[turns[0].call].text, calls[turns[1].call].text);
    }
}

static bool tells_room(size_t k) { return strcmp(calls[k].function, "deldrift_memory_bytes") == 0; }

static void compare(const answer *wanted, const char *where, size_t change) {
    for (size_t k = 0; k < N_THREADS; k++) {
        const answer *const is = &turns[k].given, *const alone = &wanted[turns[k].call];
        const bool is_same = is->more == alone->more && memcmp(&is->out, &alone->out, sizeof is->out) == 0;
        if (is->status != alone->status || !(is_same || tells_room(turns[k].call))) wrong(where, change, k);
    }
}

static deldrift_triangulation *changed(const state *from, size_t change, counts *then) {
    static answer given;
    make_all_arguments(dimension);
    deldrift_triangulation *of = from->then(from->make());
    deldrift_cells_view view;
    OK(deldrift_cells(of, &view));
    const counts before = counts_of(of);
    ask_for(change, of, &before, &given);
    *then = before;
    return of;
}

// Every two calls, each two after another change.
static void meet_in(const state *from) {
    static answer wanted[256];
    size_t readers[256], changers[256], n_readers = 0, n_changers = 0;
    for (size_t k = 0; k < n_calls; k++) {
        if (calls[k].changes) {
            changers[n_changers++] = k;
        } else {
            readers[n_readers++] = k;
        }
    }
    const size_t n_both = n_readers * n_readers;
    for (size_t c = 0; c < n_changers; c++) {
        counts then;
        deldrift_triangulation *alone = changed(from, changers[c], &then);
        for (size_t k = 0; k < n_readers; k++) ask_for(readers[k], alone, &then, &wanted[readers[k]]);
        deldrift_destroy(alone);
        for (size_t pair = c; pair < n_both; pair += n_changers) {
            const size_t x = readers[pair / n_readers], y = readers[pair % n_readers];
            if (y < x) continue;
            t = changed(from, changers[c], &then);
            use_counts(&then);
            hold(x, y);
            compare(wanted, from->name, changers[c]);
            deldrift_destroy(t);
        }
    }
}

// The cells and what has changed, as this one tells.
static uint64_t told_by(deldrift_triangulation *of) {
    deldrift_cells_view view;
    deldrift_changes changes;
    OK(deldrift_cells(of, &view));
    OK(deldrift_take_changes(of, &changes));
    return mixed(digest_of_view(&view), digest_of_changes(&changes));
}

// Of many vertices, whose cells take a while to be brought up to date, a copy beside every other call, by which they are.
static void meet_with_many(void) {
    double *const to = random_positions(dimension, MANY, 5);
    deldrift_triangulation *of = create(dimension, to, MANY, NULL);
    uint64_t seed = 8;
    told_by(of);
    for (size_t other = 0; other < n_calls * ROUNDS; other++) {
        const size_t k = other % n_calls;
        // The bytes of all have no room either, by which copies are compared elsewhere.
        if (calls[k].changes || strcmp(calls[k].function, "deldrift_clone") == 0) continue;
        for (size_t i = 0; i < MANY * dimension; i++) to[i] = next_random(&seed);
        OK(deldrift_commit_positions(of, to, MANY, NULL));
        t = of;
        // There is no room for what is told of all.
        use_counts(&(counts){ROOM - 1, ROOM - 1, 0});
        hold(k, COPIES);
        const uint64_t by_copy = turns[1].given.more;
        if (by_copy != told_by(of) && n_wrong++ < 50) printf("%uD: a copy beside %s tells other changes\n", dimension, calls[k].text);
    }
    deldrift_destroy(of);
    free(to);
}

int main(int argc, char **argv) {
    CHECK(argc == 2);
    dimension = (uint32_t)strtoul(argv[1], NULL, 10);
    name_path(0);
    make_all_arguments(dimension);
    pthread_t threads[N_THREADS];
    size_t numbers_of_threads[N_THREADS], n_states = 0;
    for (size_t k = 1; k < N_THREADS; k++) {
        numbers_of_threads[k] = k;
        CHECK(pthread_create(&threads[k], NULL, attend, &numbers_of_threads[k]) == 0);
    }
    meet_with_many();
    for (size_t k = 0; k < sizeof states / sizeof *states; k++) {
        const state *const from = &states[k];
        if (!from->meets || !(dimension == 2 ? from->in_plane : from->in_space)) continue;
        n_states++;
        meet_in(from);
    }
    turns[0].call = NOBODY;
    atomic_fetch_add(&round_number, 1);
    for (size_t k = 1; k < N_THREADS; k++) CHECK(pthread_join(threads[k], NULL) == 0);
    unlink(path);
    if (n_wrong > 0) {
        printf("%zu of %zu meetings have not ended as they should have\n", n_wrong, n_meetings);
        return 1;
    }
    printf("%zu %zu %zu\n", n_states, n_calls, n_meetings);
    return 0;
}

#endif
