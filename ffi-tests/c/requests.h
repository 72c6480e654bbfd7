// What the library asks the system for: memory, and threads. Requests are counted, and refused where a test says so; blocks
// that have not been given back are known with their sizes.
//
// For programs linked with the static library, by a linker that puts these functions in the place of the system's (see
// ffi-tests/support.rs), so that checkers of memory see all else as it is.
#ifndef REQUESTS_H
#define REQUESTS_H

#include "check.h"

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <sys/types.h>
#include <sys/uio.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
int __real_posix_memalign(void **block, size_t alignment, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *block);
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument);
ssize_t __real_write(int file, const void *bytes, size_t count);
ssize_t __real_writev(int file, const struct iovec *parts, int count);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
int __wrap_posix_memalign(void **block, size_t alignment, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *block);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument);
ssize_t __wrap_write(int file, const void *bytes, size_t count);
ssize_t __wrap_writev(int file, const struct iovec *parts, int count);

// Which requests are refused beside the first one: none, all later ones, or those later ones with which as much would be
// held as with the first one, as where there is a limit.
typedef enum { NONE_LATER, ALL_LATER, BEYOND_LATER } later;

// Whether requests are counted; how many there were; which is the first to be refused, and how much would have been held
// with it; which later ones are; how many were; and how often something was printed while they were counted.
static atomic_bool is_counting;
static atomic_size_t n_requests, first_refused, too_much;
static later refused_later;
static atomic_size_t n_refused, n_written;

// Bytes that have been asked for and not given back.
static atomic_size_t held_bytes;

// From now on requests are counted, from 0 on, and number `first` is refused.
static inline void count_requests(size_t first, later too) {
    n_requests = 0;
    n_refused = 0;
    n_written = 0;
    first_refused = first;
    too_much = SIZE_MAX;
    refused_later = too;
    is_counting = true;
}

static inline void stop_counting(void) {
    is_counting = false;
}

static bool is_refused(size_t size) {
    if (!is_counting) return false;
    size_t k = n_requests++, held = held_bytes + size;
    if (k == first_refused) {
        too_much = held;
    } else if (k < first_refused || refused_later == NONE_LATER || (refused_later == BEYOND_LATER && held < too_much)) {
        return false;
    }
    n_refused++;
    errno = ENOMEM;
    return true;
}

// The blocks, at a hash of their addresses or behind.
enum { PLACES = 1 << 14 };
static struct {
    uintptr_t address;
    size_t size;
} blocks[PLACES];
static size_t n_blocks;
static pthread_mutex_t blocks_lock = PTHREAD_MUTEX_INITIALIZER;

static size_t place_of(uintptr_t address) {
    return (size_t)((uint64_t)address * 0x9e3779b97f4a7c15u >> 40) % PLACES;
}

static void *enter_block(void *block, size_t size) {
    if (block == NULL) return NULL;
    pthread_mutex_lock(&blocks_lock);
    CHECK(n_blocks < PLACES / 2);
    size_t at = place_of((uintptr_t)block);
    while (blocks[at].address != 0) at = (at + 1) % PLACES;
    blocks[at].address = (uintptr_t)block;
    blocks[at].size = size;
    n_blocks++;
    held_bytes += size;
    pthread_mutex_unlock(&blocks_lock);
    return block;
}

// Its size; 0 for one that was not made here.
static size_t forget_block(uintptr_t block) {
    size_t size = 0;
    if (block == 0) return 0;
    pthread_mutex_lock(&blocks_lock);
    size_t at = place_of(block);
    while (blocks[at].address != 0 && blocks[at].address != block) at = (at + 1) % PLACES;
    if (blocks[at].address == block) {
        size = blocks[at].size;
        n_blocks--;
        held_bytes -= size;
        // What is behind, and would no longer be found, moves up.
        size_t hole = at;
        for (size_t k = (at + 1) % PLACES; blocks[k].address != 0; k = (k + 1) % PLACES) {
            size_t home = place_of(blocks[k].address);
            if ((k + PLACES - home) % PLACES >= (k + PLACES - hole) % PLACES) {
                blocks[hole] = blocks[k];
                hole = k;
            }
        }
        blocks[hole].address = 0;
    }
    pthread_mutex_unlock(&blocks_lock);
    return size;
}

void *__wrap_malloc(size_t size) {
    return is_refused(size) ? NULL : enter_block(__real_malloc(size), size);
}

void *__wrap_calloc(size_t count, size_t size) {
    return is_refused(count * size) ? NULL : enter_block(__real_calloc(count, size), count * size);
}

void *__wrap_realloc(void *block, size_t size) {
    size_t before = forget_block((uintptr_t)block);
    void *moved = is_refused(size) ? NULL : __real_realloc(block, size);
    if (moved == NULL) enter_block(block, before);
    return enter_block(moved, size);
}

int __wrap_posix_memalign(void **block, size_t alignment, size_t size) {
    if (is_refused(size)) return ENOMEM;
    int failure = __real_posix_memalign(block, alignment, size);
    if (failure == 0) enter_block(*block, size);
    return failure;
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return is_refused(size) ? NULL : enter_block(__real_aligned_alloc(alignment, size), size);
}

void __wrap_free(void *block) {
    forget_block((uintptr_t)block);
    __real_free(block);
}

// A thread needs memory for its stack.
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument) {
    return is_refused(2 << 20) ? EAGAIN : __real_pthread_create(thread, attributes, run, argument);
}

ssize_t __wrap_write(int file, const void *bytes, size_t count) {
    n_written += is_counting && file <= 2;
    return __real_write(file, bytes, count);
}

ssize_t __wrap_writev(int file, const struct iovec *parts, int count) {
    n_written += is_counting && file <= 2;
    return __real_writev(file, parts, count);
}

#endif
