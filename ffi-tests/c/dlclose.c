// A program that loads the library, has it work on several threads, and unloads it: again and again, and then waits for
// what may run on.
#define _DEFAULT_SOURCE
#include "condition.h"

#include <deldrift.h>
#include <dlfcn.h>
#include <string.h>
#include <time.h>

enum { COUNT = 2000, THREADS = 3, ROUNDS = 4 };

// A function of the library. A pointer to data is copied, as ISO C has no conversion.
static void find(void *library, const char *name, void *function, size_t size) {
    void *found = dlsym(library, name);
    CHECK(found != NULL && size == sizeof found);
    memcpy(function, &found, size);
}

static void use(void *library) {
    deldrift_status (*create)(uint32_t, const double *, size_t, const deldrift_options *, deldrift_triangulation **);
    deldrift_status (*validate)(const deldrift_triangulation *, uint32_t);
    void (*destroy)(deldrift_triangulation *);
    find(library, "deldrift_create", &create, sizeof create);
    find(library, "deldrift_validate", &validate, sizeof validate);
    find(library, "deldrift_destroy", &destroy, sizeof destroy);
    static double positions[3 * COUNT];
    for (size_t i = 0; i < 3 * COUNT; i++) positions[i] = rand() / (double)RAND_MAX;
    deldrift_options options;
    deldrift_options_init(&options);
    options.threads = THREADS;
    deldrift_triangulation *t = NULL;
    CHECK(create(3, positions, COUNT, &options, &t) == DELDRIFT_OK);
    CHECK(validate(t, 3) == DELDRIFT_OK);
    destroy(t);
}

int main(void) {
    for (size_t round = 0; round < ROUNDS; round++) {
        void *library = dlopen(LIBRARY, RTLD_NOW | RTLD_LOCAL);
        if (library == NULL) fprintf(stderr, "%s\n", dlerror());
        CHECK(library != NULL);
        use(library);
        CHECK(dlclose(library) == 0);
        // It is gone, and nothing of it runs.
        CHECK(dlopen(LIBRARY, RTLD_NOW | RTLD_NOLOAD) == NULL);
        const struct timespec pause = {.tv_nsec = 20000000};
        nanosleep(&pause, NULL);
    }
    return 0;
}
