// The walk: from each state all pairs of calls, one after the other, on the triangulation itself, on clones and on copies that
// have been saved and loaded.
#ifndef WALKER_H
#define WALKER_H

#include "copies.h"
#include "states.h"

enum { MOST_CALLS = 256 };

// How many differences are told.
#ifndef MOST_TOLD
#define MOST_TOLD 100
#endif

static const state *from;
// Whether its cells are read before the first call.
static bool is_read;
static size_t n_pairs, n_wrong;

// Of the state at hand: its counts and looks; and of each call on it: what it gives, and what there is then.
static counts at_first;
static look first_look, first_sets;
static answer first_answers[MOST_CALLS], second_answers[MOST_CALLS];
static look *first_ends, *first_end_sets;

// States that have been compared with fresh builds.
static uint64_t seen[1 << 18];

static bool is_new(uint64_t digest) {
    size_t at = digest % (sizeof seen / sizeof *seen);
    for (int steps = 0; steps < 64; steps++, at = (at + 1) % (sizeof seen / sizeof *seen)) {
        if (seen[at] == digest) return false;
        if (seen[at] == 0) {
            seen[at] = digest;
            return true;
        }
    }
    return true;
}

static const char *last_message(void) {
    static char kept_message[400];
    snprintf(kept_message, sizeof kept_message, "%s", deldrift_last_error());
    return kept_message;
}

static void wrong(size_t a, size_t b, const char *where, const char *what) {
    if (b < n_calls && is_of_latest_call(b) && strcmp(where, "status") != 0) return;
    const char *const second = b < n_calls ? calls[b].text : "";
    if (n_wrong++ < MOST_TOLD) {
        printf("%uD, %s: %s; %s: %s: %s (%s)\n", dimension, from->name, calls[a].text, second, where, what, last_message());
    }
}

static void read_cells(const deldrift_triangulation *of);

static deldrift_triangulation *begin(void) {
    make_all_arguments(dimension);
    deldrift_triangulation *made = from->then(from->make());
    if (is_read) read_cells(made);
    return made;
}

static deldrift_triangulation *clone_of(const deldrift_triangulation *of) {
    deldrift_triangulation *made = NULL;
    OK(deldrift_clone(of, &made));
    return made;
}

static deldrift_triangulation *copy_of(const look *saved_one) {
    deldrift_triangulation *made = NULL;
    OK(deldrift_load(saved_one->saved, saved_one->size, &options, &made));
    OK(choose(made, saved_one->algorithm));
    return made;
}

// A status that the header names, and none that tells of a defect.
static void check_status_of(size_t a, size_t b, size_t k, deldrift_status status) {
    if (status >= 64 || (calls[k].documented >> status & 1) == 0 || status == DELDRIFT_INTERNAL_ERROR ||
        status == DELDRIFT_POISONED || status == DELDRIFT_BUSY) {
        wrong(a, b, "status", name_of(status));
    }
}

// What a state is, is seen once.
static void check_end(size_t a, size_t b, const deldrift_triangulation *of, const look *l) {
    if (l->saving == DELDRIFT_OK && is_new(mixed(digest_of(l->saved, l->size), dimension))) {
        const char *what = difference_from_fresh(of);
        if (what != NULL) wrong(a, b, "fresh build", what);
    }
}

// Answers that tell of more than what there is: room that has been made.
static bool tells_room(size_t k) { return is_of(k, "deldrift_memory_bytes"); }

static void compare_answers(size_t a, size_t b, const char *where, const answer *is, const answer *should_be) {
    if (is->status != should_be->status) {
        wrong(a, b, where, name_of(is->status));
    } else if (!tells_room(b) &&
               (is->more != should_be->more || memcmp(&is->out, &should_be->out, sizeof is->out) != 0)) {
        wrong(a, b, where, "another answer");
    }
}

// Compares what a copy that was loaded gives.
static void compare_with_loaded(size_t a, size_t b, answer *is, const answer *wanted) {
    static answer should_be;
    should_be = *wanted;
    answer *const both[] = {is, &should_be};
    for (size_t k = 0; k < 2 && is_rounded_by_slots(b); k++) {
        outputs *const o = &both[k]->out;
        memset(o->numbers, 0, sizeof o->numbers);
        memset(o->more_numbers, 0, sizeof o->more_numbers);
        memset(o->rows, 0, sizeof o->rows);
        memset(o->facets, 0, sizeof o->facets);
        memset(o->more_facets, 0, sizeof o->more_facets);
        memset(o->facet_rows, 0, sizeof o->facet_rows);
        memset(o->few_numbers, 0, sizeof o->few_numbers);
    }
    compare_answers(a, b, "loaded copy", is, &should_be);
}

// Of answers that may tell other indices.
static void compare_statuses(size_t a, size_t b, const char *where, const answer *is, const answer *should_be) {
    if (is->status != should_be->status) wrong(a, b, where, name_of(is->status));
    if (is->out.number != should_be->out.number) wrong(a, b, where, "another id");
}

static void compare_looks(size_t a, size_t b, const char *where, const look *is, const look *should_be) {
    if (memcmp(is, should_be, offsetof(look, saved) + should_be->size) != 0) wrong(a, b, where, "another state");
}

// Changes that have not been taken, of which all copies but loaded ones know.
static uint64_t changes_of(deldrift_triangulation *of) {
    deldrift_changes changes;
    const deldrift_status status = deldrift_take_changes(of, &changes);
    return status == DELDRIFT_OK ? digest_of_changes(&changes) : 0;
}

// The indices of cells depend on when they are read.
static void read_cells(const deldrift_triangulation *of) {
    deldrift_cells_view view;
    const deldrift_status status = deldrift_cells(of, &view);
    CHECK(status == DELDRIFT_OK || status == DELDRIFT_POISONED);
}

#define END(of)                                                                                    \
    do {                                                                                           \
        deldrift_destroy(of);                                                                      \
        of = NULL;                                                                                 \
    } while (0)

// What each call does to the state by itself.
static void walk_first(void) {
    deldrift_triangulation *of = begin();
    look_at(of, &first_look);
    look_at_sets(of, &first_sets);
    at_first = counts_of(of);
    check_end(0, n_calls, of, &first_look);
    END(of);
    for (size_t k = 0; k < n_calls; k++) {
        of = begin();
        ask_for(k, of, &at_first, &first_answers[k]);
        check_status_of(k, n_calls, k, first_answers[k].status);
        look_at(of, &first_ends[k]);
        look_at_sets(of, &first_end_sets[k]);
        if (!calls[k].changes || first_answers[k].status != DELDRIFT_OK) {
            compare_looks(k, n_calls, "unchanged", &first_ends[k], &first_look);
        }
        check_end(k, n_calls, of, &first_ends[k]);
        END(of);
    }
}

// After a call that has changed nothing the others do what they do without it; on a clone that is made afterwards, too.
static void walk_after_nothing(size_t a) {
    static answer given;
    static look end;
    deldrift_triangulation *of = begin();
    for (size_t b = 0; b < n_calls; b++) {
        n_pairs++;
        if (calls[b].changes) continue;
        ask_for(a, of, &at_first, &given);
        ask_for(b, of, &at_first, &given);
        compare_answers(a, b, "after what changed nothing", &given, &first_answers[b]);
    }
    deldrift_triangulation *copy = NULL;
    for (size_t b = 0; b < n_calls; b++) {
        if (!calls[b].changes) continue;
        if (first_look.saving == DELDRIFT_OK) copy = clone_of(of);
        deldrift_triangulation *one = begin();
        ask_for(a, one, &at_first, &given);
        for (int k = 0; k < 2; k++) {
            deldrift_triangulation *const which = k == 0 ? one : copy;
            if (which == NULL) continue;
            ask_for(b, which, &at_first, &given);
            const char *const where = k == 0 ? "after what changed nothing" : "clone after what changed nothing";
            // What has been taken back may have left other hints by which cells are found, and then made, in another order.
            if (is_read && !calls[a].changes) {
                compare_answers(a, b, where, &given, &first_answers[b]);
                look_at(which, &end);
                compare_looks(a, b, where, &end, &first_ends[b]);
            } else {
                compare_statuses(a, b, where, &given, &first_answers[b]);
                look_at_sets(which, &end);
                compare_looks(a, b, where, &end, &first_end_sets[b]);
            }
        }
        END(one);
        END(copy);
    }
    END(of);
}

// Questions after a change: of the triangulation itself each is the first one, of the copies all come one after the other.
static void ask_all_after(size_t a, deldrift_triangulation *clone, deldrift_triangulation *copy, const counts *then) {
    static answer given;
    for (size_t b = 0; b < n_calls; b++) {
        if (calls[b].changes) continue;
        n_pairs++;
        deldrift_triangulation *one = begin();
        ask_for(a, one, &at_first, &given);
        ask_for(b, one, then, &second_answers[b]);
        END(one);
        check_status_of(a, b, b, second_answers[b].status);
        if (clone != NULL) {
            ask_for(b, clone, then, &given);
            compare_answers(a, b, "clone", &given, &second_answers[b]);
        }
        if (copy != NULL && !is_not_saved(b)) {
            ask_for(b, copy, then, &given);
            compare_with_loaded(a, b, &given, &second_answers[b]);
        }
    }
}

// Two changes: on the triangulation itself, on what was cloned and loaded between them, and before both. Its cells are read
// between them, or not.
static void walk_two_changes(size_t a, size_t b, deldrift_triangulation *after, const look *middle, const counts *then) {
    static answer given, wanted;
    static look end, sets, other;
    const bool is_read_between = (a + b) % 2 == 0;
    n_pairs++;
    deldrift_triangulation *one = begin();
    ask_for(a, one, &at_first, &given);
    if (is_read_between) read_cells(one);
    ask_for(b, one, then, &wanted);
    check_status_of(a, b, b, wanted.status);
    look_at(one, &end);
    if (wanted.status != DELDRIFT_OK) compare_looks(a, b, "refused", &end, middle);
    look_at_sets(one, &sets);
    check_end(a, b, one, &end);
    const uint64_t changes = changes_of(one);
    END(one);
    for (int k = 0; k < 4; k++) {
        const bool is_between = k % 2 == 0, is_clone = k < 2;
        if ((is_between ? middle : &first_look)->saving != DELDRIFT_OK) continue;
        static const char *const names[] = {"clone between", "clone before", "loaded between", "loaded before"};
        if (is_between) {
            one = is_clone ? clone_of(after) : copy_of(middle);
        } else {
            if (is_clone) {
                deldrift_triangulation *original = begin();
                one = clone_of(original);
                END(original);
            } else {
                one = copy_of(&first_look);
            }
            ask_for(a, one, &at_first, &given);
            if (is_read_between) read_cells(one);
        }
        ask_for(b, one, then, &given);
        // A copy has the cells that have been read once up to date, which decides on the indices of later ones.
        if (is_clone && is_read && (is_read_between || !is_between)) {
            compare_answers(a, b, names[k], &given, &wanted);
            look_at(one, &other);
            compare_looks(a, b, names[k], &other, &end);
            if (changes_of(one) != changes) wrong(a, b, names[k], "other changes");
        } else {
            compare_statuses(a, b, names[k], &given, &wanted);
            look_at_sets(one, &other);
            compare_looks(a, b, names[k], &other, &sets);
        }
        END(one);
    }
}

static void walk_after_change(size_t a) {
    static answer given;
    static look middle;
    deldrift_triangulation *after = begin(), *clone = NULL, *copy = NULL;
    ask_for(a, after, &at_first, &given);
    look_at(after, &middle);
    const counts then = counts_of(after);
    if (middle.saving == DELDRIFT_OK) {
        clone = clone_of(after);
        copy = copy_of(&middle);
        // A periodic one whose changes have been taken has its cells under other indices once it is loaded.
        static look copied;
        look_at(copy, &copied);
        if (is_periodic(copy) && copied.arrays != middle.arrays) {
            END(copy);
        }
    }
    ask_all_after(a, clone, copy, &then);
    END(clone);
    END(copy);
    for (size_t b = 0; b < n_calls; b++) {
        if (calls[b].changes) walk_two_changes(a, b, after, &middle, &then);
    }
    END(after);
}

static void walk(void) {
    walk_first();
    for (size_t a = 0; a < n_calls; a++) {
        if (calls[a].changes && first_answers[a].status == DELDRIFT_OK) {
            walk_after_change(a);
        } else {
            walk_after_nothing(a);
        }
    }
}

// Walks the states of a dimension; of many, every so many-th, from one on.
int main(int argc, char **argv) {
    CHECK(argc >= 2);
    dimension = (uint32_t)strtoul(argv[1], NULL, 10);
    const size_t stride = argc > 2 ? strtoul(argv[2], NULL, 10) : 1;
    const char *const folder = getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/deldrift-pairs-%d", folder == NULL ? "/tmp" : folder, (int)getpid());
    CHECK(n_calls <= MOST_CALLS);
    first_ends = malloc(n_calls * sizeof *first_ends);
    first_end_sets = malloc(n_calls * sizeof *first_end_sets);
    CHECK(first_ends != NULL && first_end_sets != NULL);
    size_t n_states = 0, turn = 0;
    for (size_t k = 0; k < sizeof states / sizeof *states; k++) {
        from = &states[k];
        if (!(dimension == 2 ? from->in_plane : from->in_space)) continue;
        if (argc > 3 ? strcmp(argv[3], from->name) != 0 : turn++ % stride != 0) continue;
        n_states++;
        is_read = k % 2 == 0;
        walk();
    }
    unlink(path);
    free(first_ends);
    free(first_end_sets);
    if (n_wrong > 0) {
        printf("%zu of %zu pairs are not as they should be\n", n_wrong, n_pairs);
        return 1;
    }
    printf("%zu %zu %zu\n", n_states, n_calls, n_pairs);
    return 0;
}

#endif
