// Triangle's switches.
#pragma once

#include <string>

namespace compat {

struct TriangleSwitches {
    bool zero_based = false; // z
    bool neighbours = false; // n
    bool edges = false;      // e
    bool voronoi = false;    // v
    bool markers = true;     // not B
    bool points = true;      // not N
    bool triangles = true;   // not E
    char unserved = '\0';    // the first switch that deldrift does not serve, if there is any

    explicit TriangleSwitches(const char *switches);

    // For the original, to give cells that can be compared: from zero, with neighbours, quiet, and what else is
    // computed.
    std::string for_cells() const;
};

} // namespace compat
