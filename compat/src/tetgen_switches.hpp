// TetGen's switches.
#pragma once

#include <string>

namespace compat {

struct TetgenSwitches {
    bool zero_based = false; // z
    bool neighbours = false; // n
    bool faces = false;      // f: all of them, otherwise those of the hull
    bool edges = false;      // e
    bool voronoi = false;    // v
    bool weighted = false;   // w: the first attribute of each point is its weight
    bool jettison = true;    // not J: points that share the place of another are left out
    bool markers = true;     // not B
    bool points = true;      // neither N nor I
    bool tetrahedra = true;  // not E
    bool any_faces = true;   // not F, which also takes edges away
    char unserved = '\0';    // the first switch that deldrift does not serve, if there is any

    explicit TetgenSwitches(const char *switches);

    // Whether lists are asked for that have another place in each layout.
    bool lists_faces() const { return any_faces || voronoi; }

    // For the original, to give cells that can be compared: from zero, with neighbours and all points, quiet, and what
    // else is computed; but not v with w, as TetGen 1.5.0 cannot free what it makes then.
    std::string for_cells() const;
};

} // namespace compat
