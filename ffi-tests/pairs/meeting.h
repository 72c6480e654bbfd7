// Calls that only read at the same time on several threads: every two of them, right after a change. Each gives what it gives
// by itself.
#ifndef MEETING_H
#define MEETING_H

#include "states.h"

#include <pthread.h>
#include <stdatomic.h>

// COPIES stands for a copy that tells its cells and changes, and NOBODY for the end.
enum { N_THREADS = 3, MANY = 8000, ROUNDS = 2, COPIES = 1000, NOBODY = 1001 };

// Of a round: what each thread calls, and what has come of it. All begin together, and end together.
static struct {
    size_t call;
    answer given;
} turns[N_THREADS];

static pthread_barrier_t begins, ends_all;
static atomic_size_t n_ready;
static size_t n_meetings, n_wrong;

static void wait_at(pthread_barrier_t *barrier) {
    const int waited = pthread_barrier_wait(barrier);
    CHECK(waited == 0 || waited == PTHREAD_BARRIER_SERIAL_THREAD);
}

static uint64_t told_by(deldrift_triangulation *of);

// Several are made, while cells are brought up to date; what all tell, or nothing if they differ.
static uint64_t told_by_copies(void) {
    deldrift_triangulation *copies[4];
    uint64_t sum = 0;
    for (size_t k = 0; k < 4; k++) copies[k] = spare();
    for (size_t k = 0; k < 4; k++) {
        const uint64_t told_by_one = told_by(copies[k]);
        sum = k == 0 || sum == told_by_one ? told_by_one : 0;
        deldrift_destroy(copies[k]);
    }
    return sum;
}

static void meet(size_t thread) {
    // So that they begin as nearly at once as can be, if all are running.
    const size_t round_ends = (atomic_fetch_add(&n_ready, 1) / N_THREADS + 1) * N_THREADS;
    for (size_t spins = 0; spins < 3000 && atomic_load(&n_ready) < round_ends; spins++) continue;
    answer *const given = &turns[thread].given;
    if (turns[thread].call == COPIES) {
        given->more = told_by_copies();
    } else {
        given->status = ask(turns[thread].call, &given->more);
        given->out = out;
    }
    wait_at(&ends_all);
}

// Each writes files of its own.
static void name_path(size_t thread) {
    const char *const folder = getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/deldrift-pairs-%d-%zu", folder == NULL ? "/tmp" : folder, (int)getpid(), thread);
}

static void *attend(void *number) {
    name_path(*(size_t *)number);
    for (;;) {
        wait_at(&begins);
        if (turns[0].call == NOBODY) {
            unlink(path);
            return NULL;
        }
        meet(*(size_t *)number);
    }
}

// One round, on the triangulation in use.
static void hold(size_t x, size_t y) {
    turns[0].call = turns[2].call = x;
    turns[1].call = y;
    wait_at(&begins);
    meet(0);
    n_meetings++;
}

static void wrong(const char *where, size_t change, size_t k) {
    if (n_wrong++ < 50) {
        const size_t other = turns[1].call;
        printf("%uD, %s, %s: %s beside %s or %s: another answer\n", dimension, where, calls[change].text,
               calls[turns[k].call].text, calls[turns[0].call].text, other < n_calls ? calls[other].text : "a copy");
    }
}

static bool tells_room(size_t k) { return strcmp(calls[k].function, "deldrift_memory_bytes") == 0; }

static void compare(const answer *alone, const char *where, size_t change, size_t thread) {
    const answer *const is = &turns[thread].given;
    const bool is_same = is->more == alone->more && memcmp(&is->out, &alone->out, sizeof is->out) == 0;
    if (is->status != alone->status || !(is_same || tells_room(turns[thread].call))) wrong(where, change, thread);
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
            for (size_t k = 0; k < N_THREADS; k++) compare(&wanted[turns[k].call], from->name, changers[c], k);
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
        // Fields for files are of few; copies are compared by their bytes elsewhere, for which there is no room here.
        if (calls[k].changes || calls[k].writes || strcmp(calls[k].function, "deldrift_clone") == 0) continue;
        for (size_t i = 0; i < MANY * dimension; i++) to[i] = next_random(&seed);
        OK(deldrift_commit_positions(of, to, MANY, NULL));
        t = of;
        // There is no room for what is told of all.
        const counts few = {ROOM - 1, ROOM - 1, 0};
        use_counts(&few);
        hold(k, COPIES);
        static answer alone;
        ask_for(k, of, &few, &alone);
        compare(&alone, "many", k, 0);
        compare(&alone, "many", k, 2);
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
    CHECK(pthread_barrier_init(&begins, NULL, N_THREADS) == 0 && pthread_barrier_init(&ends_all, NULL, N_THREADS) == 0);
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
    wait_at(&begins);
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
