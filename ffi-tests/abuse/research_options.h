// Options of deldrift/research.h for the calls of harness.h.
#ifndef RESEARCH_OPTIONS_H
#define RESEARCH_OPTIONS_H

#include <deldrift/research.h>

static const deldrift_research_options research = {.struct_size = sizeof research};

static inline deldrift_research_options *bad_research(size_t size, double share) {
    static deldrift_research_options made;
    made = (deldrift_research_options){.struct_size = size, .switch_share = share};
    return &made;
}

#endif
