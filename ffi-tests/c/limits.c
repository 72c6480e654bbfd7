// Processes that may not have more address space than some limit: calls succeed or give DELDRIFT_OUT_OF_MEMORY, and then all
// is as it was; once the limit is gone the same call gives what it would have given.
//
// Each limit is that of a process of its own, forked from one in which all is ready. Limits are spread between what is
// held before the call and the most that it comes to hold. DELDRIFT_SOAK multiplies their number, up to 20 for each call.
#define _GNU_SOURCE
#include "state.h"

#include <malloc.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { COUNT = 20000, EDITS = COUNT / 20, INSERTIONS = 300, LIMITS = 5, MOST_LIMITS = 20, STACK = 256 << 10 };

typedef enum { CREATE, COMMIT, COMMIT_SOME, COMMIT_EDITS, TAKE_CHANGES, CELLS, COMPACT, INSERT } kind;

typedef struct {
    const char *name;
    kind kind;
    deldrift_algorithm algorithm;
    uint32_t threads;
    bool takes;
    // Of the moves, in spacings.
    double step;
} scenario;

static const scenario SCENARIOS[] = {
    {"create", CREATE, DELDRIFT_AUTO, 1, false, 0},
    {"create, 2 threads", CREATE, DELDRIFT_AUTO, 2, false, 0},
    {"commit, auto, small step", COMMIT, DELDRIFT_AUTO, 1, false, 1e-3},
    {"commit, auto, large step", COMMIT, DELDRIFT_AUTO, 1, false, 1},
    {"commit, rebuilding, 2 threads", COMMIT, DELDRIFT_REBUILDING, 2, false, 1},
    {"commit, tolerance", COMMIT, DELDRIFT_TOLERANCE, 1, false, 1e-3},
    {"commit, placement with flips", COMMIT_SOME, DELDRIFT_PLACEMENT_FLIPS, 1, false, 0.3},
    {"commit, repair", COMMIT, DELDRIFT_REPAIR, 1, false, 3e-2},
    {"commit, repair, 2 threads", COMMIT, DELDRIFT_REPAIR, 2, false, 3e-2},
    {"commit, slack", COMMIT, BY_SLACK, 1, false, 1e-4},
    {"commit, changes taken", COMMIT, DELDRIFT_AUTO, 1, true, 1e-2},
    {"commit with edits", COMMIT_EDITS, DELDRIFT_AUTO, 1, true, 1e-2},
    {"take changes", TAKE_CHANGES, DELDRIFT_AUTO, 1, true, 1e-2},
    {"cells", CELLS, DELDRIFT_AUTO, 1, false, 1e-2},
    {"compact", COMPACT, DELDRIFT_AUTO, 1, true, 1e-2},
    {"insert, one by one", INSERT, DELDRIFT_AUTO, 1, false, 0},
};

static uint32_t dimension;
static const scenario *now;
static deldrift_triangulation *t;
static double points[(COUNT + EDITS) * 3];
static uint32_t ids[COUNT + EDITS];

// What processes tell each other: how much address space the call needs, what there is before it and in the end, and
// whether it failed.
typedef struct {
    size_t needed;
    numbers before, after;
    uint64_t cells_before, cells_after, given;
    bool has_failed;
} page;

static page *shared;

// A figure of /proc/self/status, in bytes.
static size_t figure(const char *name) {
    char text[4096];
    FILE *status = fopen("/proc/self/status", "r");
    CHECK(status != NULL);
    size_t n = fread(text, 1, sizeof text - 1, status);
    CHECK(fclose(status) == 0);
    text[n] = '\0';
    const char *at = strstr(text, name);
    CHECK(at != NULL);
    return strtoul(at + strlen(name), NULL, 10) << 10;
}

static void limit_to(rlim_t bytes) {
    struct rlimit limit;
    CHECK(getrlimit(RLIMIT_AS, &limit) == 0);
    limit.rlim_cur = bytes < limit.rlim_max ? bytes : limit.rlim_max;
    CHECK(setrlimit(RLIMIT_AS, &limit) == 0);
}

// The stack is not the library's to ask for: what it may come to need is there before.
static void touch_stack(void) {
    volatile char stack[STACK];
    for (size_t i = 0; i < sizeof stack; i += 1024) stack[i] = 1;
}

static void prepare(void) {
    uint64_t seed = 7, state = 8;
    double spacing = pow(COUNT, -1.0 / dimension);
    uint32_t first;
    for (size_t i = 0; i < (size_t)(COUNT + EDITS) * dimension; i++) points[i] = next_random(&seed);
    t = NULL;
    if (now->kind == CREATE) return;
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = now->algorithm;
    options.threads = now->threads;
    t = create(dimension, points, COUNT, &options);
    deldrift_cells_view view;
    if (now->takes || now->kind == CELLS) OK(deldrift_cells(t, &view));
    deldrift_changes changes;
    if (now->takes) OK(deldrift_take_changes(t, &changes));
    for (size_t i = 0; i < (size_t)COUNT * dimension; i++) points[i] += now->step * spacing * (next_random(&state) - 0.5);
    for (uint32_t v = 0; v < EDITS; v++) ids[v] = v * 7;
    if (now->kind == COMMIT_SOME) {
        OK(deldrift_move_vertices(t, ids, points, EDITS));
    } else if (now->kind != INSERT) {
        OK(deldrift_move_vertices(t, NULL, points, COUNT));
    }
    if (now->kind == COMMIT_EDITS) {
        OK(deldrift_stage_insertions(t, points + COUNT * dimension, EDITS, &first));
        OK(deldrift_stage_removals(t, ids, EDITS));
    }
    if (now->kind == TAKE_CHANGES || now->kind == CELLS) OK(deldrift_commit_timestamp(t, NULL));
    if (now->kind == COMPACT) {
        for (size_t k = 0; k < EDITS; k++) OK(deldrift_remove_vertex(t, ids[k]));
    }
}

// Makes the call, from its `*done`-th part on.
static deldrift_status make_call(size_t *done, uint64_t *given) {
    deldrift_cells_view view;
    deldrift_changes changes;
    deldrift_options options;
    deldrift_status status = DELDRIFT_OK;
    size_t count = 0;
    uint32_t v;
    switch (now->kind) {
        case CREATE:
            deldrift_options_init(&options);
            options.threads = now->threads;
            return deldrift_create(dimension, points, COUNT, &options, &t);
        case TAKE_CHANGES:
            status = deldrift_take_changes(t, &changes);
            if (status == DELDRIFT_OK) *given = changes.created_count * COUNT + changes.star_count;
            return status;
        case CELLS: return deldrift_cells(t, &view);
        case COMPACT:
            status = deldrift_compact(t, ids, COUNT + EDITS, &count);
            *given = status == DELDRIFT_OK ? count : 0;
            return status;
        case INSERT:
            for (; *done < INSERTIONS && status == DELDRIFT_OK; *done += status == DELDRIFT_OK) {
                status = deldrift_insert_vertex(t, points + (COUNT + *done) * dimension, &v);
            }
            return status;
        default: return deldrift_commit_timestamp(t, NULL);
    }
}

static bool are_same(const numbers *a, const numbers *b) {
    const char *other = difference(a, b);
    if (other != NULL) fprintf(stderr, "%s\n", other);
    return other == NULL;
}

// A process without a limit: what the call needs, and what it gives.
static void measure(void) {
    size_t done = 0, held = figure("VmSize:");
    shared->given = 0;
    OK(make_call(&done, &shared->given));
    size_t peak = figure("VmPeak:");
    shared->needed = peak > held ? peak - held : 0;
    OK(deldrift_validate(t, 3));
    shared->after = numbers_of(t);
    shared->cells_after = arrays_of(t).cells;
}

// Another one, before the call.
static void look(void) {
    if (t == NULL) return;
    shared->before = numbers_of(t);
    shared->cells_before = arrays_of(t).cells;
}

// A process with a limit of so many bytes beyond what is held.
static void limited(size_t room) {
    size_t done = 0;
    uint64_t given = 0;
    limit_to(figure("VmSize:") + room);
    deldrift_status status = make_call(&done, &given);
    limit_to(RLIM_INFINITY);
    if (status != DELDRIFT_OK) {
        CHECK(status == DELDRIFT_OUT_OF_MEMORY);
        shared->has_failed = true;
        if (now->kind == CREATE) {
            CHECK(t == NULL);
        } else {
            numbers there = numbers_of(t);
            if (done == 0) {
                CHECK(are_same(&there, &shared->before));
                CHECK(arrays_of(t).cells == shared->cells_before);
            }
            CHECK(there.ids == shared->before.ids + done);
            OK(deldrift_validate(t, 3));
        }
        OK(make_call(&done, &given));
    }
    numbers there = numbers_of(t);
    CHECK(given == shared->given);
    CHECK(are_same(&there, &shared->after));
    CHECK(arrays_of(t).cells == shared->cells_after);
    if (status == DELDRIFT_OK) OK(deldrift_validate(t, 2));
}

static void in_a_process(void (*work)(void), size_t room) {
    CHECK(fflush(NULL) == 0);
    pid_t child = fork();
    CHECK(child >= 0);
    if (child == 0) {
        alarm(300);
        touch_stack();
        if (work != NULL) work();
        else limited(room);
        _exit(0);
    }
    int status = 0;
    CHECK(waitpid(child, &status, 0) == child);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        fprintf(stderr, "%uD, %s, with %zu bytes: %s %d\n", dimension, now->name, room,
                WIFSIGNALED(status) ? "signal" : "exit code", WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status));
        exit(1);
    }
}

int main(void) {
    // What is freed goes back to the system, and is not there for calls that are to be without.
    CHECK(mallopt(M_MMAP_THRESHOLD, 4096) == 1 && mallopt(M_TRIM_THRESHOLD, 0) == 1 && mallopt(M_TOP_PAD, 0) == 1);
    CHECK(mallopt(M_ARENA_MAX, 1) == 1);
    shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    CHECK(shared != MAP_FAILED);
    size_t sum = 0, n_failed = 0;
    printf("%-34s%14s%8s%8s\n", "", "KiB needed", "limits", "failed");
    for (dimension = 2; dimension <= 3; dimension++) {
        for (now = SCENARIOS; now < SCENARIOS + sizeof SCENARIOS / sizeof *SCENARIOS; now++) {
            prepare();
            in_a_process(measure, 0);
            in_a_process(look, 0);
            size_t failed = 0, turn = (size_t)(now - SCENARIOS);
            // What several threads build is built by one where there is no memory for that: all limits matter.
            size_t n_limits = now->kind == CREATE ? MOST_LIMITS : (size_t)(LIMITS * soak());
            n_limits = n_limits < 1 ? 1 : n_limits > MOST_LIMITS ? MOST_LIMITS : n_limits;
            for (size_t k = 0; k < n_limits; k++) {
                // Which ones, of all that there may be, is a matter of turns.
                size_t at = (k * MOST_LIMITS + turn % MOST_LIMITS) / n_limits;
                shared->has_failed = false;
                in_a_process(NULL, shared->needed / MOST_LIMITS * at);
                failed += shared->has_failed;
            }
            printf("%uD, %-30s%14zu%8zu%8zu\n", dimension, now->name, shared->needed >> 10, n_limits, failed);
            sum += n_limits;
            n_failed += failed;
            deldrift_destroy(t);
        }
    }
    printf("%-34s%14s%8zu%8zu\n", "all", "", sum, n_failed);
    CHECK(n_failed > sum / 4);
    return 0;
}
