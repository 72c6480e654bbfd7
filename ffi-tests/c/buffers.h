// Buffers that calls fill: what they must not write, and every capacity.
#ifndef BUFFERS_H
#define BUFFERS_H

#include "check.h"

// A row of numbers in each of which a call must not write when it fails.
static inline bool is_untouched(const void *buffer, size_t bytes) {
    const unsigned char *from = buffer;
    for (size_t i = 0; i < bytes; i++) {
        if (from[i] != 0x77) return false;
    }
    return true;
}

// Counts alone, a buffer that is one short, and one that is long enough; `CALL` uses `buffer`, `capacity` and `count`.
#define CHECK_BUFFER(type, wanted, per_entry, CALL)                                  \
    do {                                                                             \
        type room[256], *buffer = NULL;                                              \
        size_t capacity = 0, count = 777;                                            \
        OK(CALL);                                                                    \
        CHECK(count == (wanted));                                                    \
        capacity = 1;                                                                \
        CHECK_STATUS(CALL, DELDRIFT_NULL_ARGUMENT);                                  \
        buffer = (type *)memset(room, 0x77, sizeof room);                            \
        capacity = (wanted) - 1;                                                     \
        count = 777;                                                                 \
        CHECK_STATUS(CALL, DELDRIFT_BUFFER_TOO_SMALL);                               \
        CHECK(count == (wanted) && is_untouched(room, sizeof room));                 \
        capacity = (wanted);                                                         \
        OK(CALL);                                                                    \
        size_t n_written = (wanted) * (per_entry);                                   \
        CHECK(is_untouched(room + n_written, sizeof room - n_written * sizeof *room)); \
        CHECK(!is_untouched(room, sizeof *room));                                    \
    } while (0)

#endif
