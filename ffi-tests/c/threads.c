// Many threads reading one triangulation, the first request for its cells included; errors per thread.
#define _POSIX_C_SOURCE 200809L
#include "check.h"

#include <pthread.h>

enum { THREADS = 4, COUNT = 2000, ROUNDS = 5 };

static deldrift_triangulation *t;
static double *positions;
static pthread_barrier_t start;
static const uint32_t *seen[THREADS];

static void *read_everything(void *argument) {
    size_t thread = *(size_t *)argument;
    int waited = pthread_barrier_wait(&start);
    CHECK(waited == 0 || waited == PTHREAD_BARRIER_SERIAL_THREAD);
    deldrift_cells_view view;
    OK(deldrift_cells(t, &view));
    seen[thread] = view.vertices;
    for (uint32_t v = (uint32_t)thread; v < COUNT; v += 7) {
        uint32_t star[512], nearest, representative;
        double position[3];
        size_t count = 0;
        deldrift_location location;
        OK(deldrift_star(t, v, star, 512, &count));
        for (size_t i = 0; i < count; i++) {
            const uint32_t *cell = view.vertices + 4 * star[i];
            CHECK(cell[0] == v || cell[1] == v || cell[2] == v || cell[3] == v);
        }
        OK(deldrift_position(t, v, position));
        OK(deldrift_locate(t, position, &location));
        CHECK(location.kind == DELDRIFT_LOCATION_VERTEX && location.index == v);
        OK(deldrift_nearest_vertex(t, position, &nearest));
        OK(deldrift_coincident_representative(t, v, &representative));
        double tolerance, centre[3], radius;
        OK(deldrift_tolerance(t, v, &tolerance));
        OK(deldrift_research_standard_delimiter(t, star[0], 0, centre, &radius, &tolerance));
        CHECK(nearest == v && representative == v);
    }
    size_t widths = 0;
    OK(deldrift_research_annulus_widths(t, NULL, 0, &widths));
    CHECK(widths == 4 * view.count);
    OK(deldrift_validate(t, 2));

    // A message belongs to the thread whose call failed.
    char own[32];
    uint32_t wrong = COUNT + (uint32_t)thread;
    snprintf(own, sizeof own, "vertex[0] is %u", (unsigned)wrong);
    CHECK_STATUS(deldrift_position(t, wrong, (double[3]){0, 0, 0}), DELDRIFT_NO_SUCH_VERTEX);
    waited = pthread_barrier_wait(&start);
    CHECK(waited == 0 || waited == PTHREAD_BARRIER_SERIAL_THREAD);
    CHECK_MESSAGE(own);
    return NULL;
}

int main(void) {
    positions = random_positions(3, COUNT, 9);
    t = create(3, positions, COUNT, NULL);
    uint64_t state = 10;
    for (int round = 0; round < ROUNDS; round++) {
        pthread_t threads[THREADS];
        size_t numbers[THREADS];
        CHECK(pthread_barrier_init(&start, NULL, THREADS) == 0);
        for (size_t i = 0; i < THREADS; i++) {
            numbers[i] = i;
            CHECK(pthread_create(&threads[i], NULL, read_everything, &numbers[i]) == 0);
        }
        for (size_t i = 0; i < THREADS; i++) CHECK(pthread_join(threads[i], NULL) == 0);
        for (size_t i = 1; i < THREADS; i++) CHECK(seen[i] == seen[0]);
        CHECK(pthread_barrier_destroy(&start) == 0);
        CHECK(deldrift_last_error()[0] == '\0');

        for (size_t i = 0; i < 3 * COUNT; i++) positions[i] += 0.01 * next_random(&state);
        OK(deldrift_move_vertices(t, NULL, positions, COUNT));
        OK(deldrift_commit_timestamp(t, NULL));
    }
    deldrift_destroy(t);
    free(positions);
    return 0;
}
