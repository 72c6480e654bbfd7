// What is known to be wrong, and why the walker does not tell it.
#ifndef KNOWN_H
#define KNOWN_H

#include "copies.h"

static bool is_known(size_t b, const char *said) {
    // Lists of what the latest refusal found: some refusals leave those of earlier ones, and clones have none.
    if (b < n_calls && (is_of(b, "deldrift_segment_conflicts") || is_of(b, "deldrift_passings"))) return true;
    // The marks of what is staged in boxes are too short after an insertion.
    return strstr(said, "src/periodic/staged.rs") != NULL || strstr(said, "t is unusable") != NULL;
}

// A status that the header does not name.
static bool is_known_status(size_t k, deldrift_status status) {
    return is_of(k, "deldrift_stage_splits") && status == DELDRIFT_PASSES_SEGMENT;
}

#endif
