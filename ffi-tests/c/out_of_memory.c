// A process that may not have more memory: creation says so, and works once there is enough.
#define _DEFAULT_SOURCE
#include "check.h"

#include <sys/resource.h>
#include <unistd.h>

enum { COUNT = 1000000, ROOM = 8 << 20 };

// Bytes of address space in use.
static size_t used(void) {
    unsigned long pages = 0;
    FILE *statistics = fopen("/proc/self/statm", "r");
    CHECK(statistics != NULL);
    CHECK(fscanf(statistics, "%lu", &pages) == 1);
    CHECK(fclose(statistics) == 0);
    return pages * (size_t)sysconf(_SC_PAGESIZE);
}

static void limit_to(rlim_t bytes) {
    struct rlimit limit;
    CHECK(getrlimit(RLIMIT_AS, &limit) == 0);
    limit.rlim_cur = bytes < limit.rlim_max ? bytes : limit.rlim_max;
    CHECK(setrlimit(RLIMIT_AS, &limit) == 0);
}

int main(void) {
    double *positions = random_positions(2, COUNT, 12);
    deldrift_triangulation *t = NULL;
    limit_to(used() + ROOM);
    CHECK_STATUS(deldrift_create(2, positions, COUNT, NULL, &t), DELDRIFT_OUT_OF_MEMORY);
    CHECK_MESSAGE("bytes");
    CHECK(t == NULL);
    limit_to(RLIM_INFINITY);
    t = create(2, positions, COUNT / 100, NULL);
    OK(deldrift_validate(t, 3));
    deldrift_destroy(t);
    free(positions);
    return 0;
}
