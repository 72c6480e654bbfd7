// Triangle's switches.
#pragma once

#include <string>

#include <deldrift_triangle.h>

namespace compat {

struct TriangleSwitches {
    bool zero_based = false;   // z
    bool neighbours = false;   // n
    bool edges = false;        // e
    bool voronoi = false;      // v
    bool planar_graph = false; // p: the input has lists of segments, holes and regions
    bool convex = false;       // c: the edges of the hull are segments
    bool regions = false;      // A: triangles have the attributes of regions
    bool holes = true;         // not O
    bool conforming = false;   // s: segments may be cut so that the triangulation stays Delaunay
    bool jettison = false;     // j: points that are in no triangle are left out
    bool markers = true;       // not B
    bool points = true;        // not N
    bool triangles = true;     // not E
    bool segments = true;      // not P
    char unserved = '\0';      // the first switch that deldrift does not serve, if there is any

    explicit TriangleSwitches(const char *switches);

    // What of the input deldrift does not serve, or null.
    const char *unserved_input(const triangulateio &in) const;

    bool has_segments() const { return planar_graph || convex; }
    bool lists_segments() const { return has_segments() && segments; }

    // For the original, to give cells that can be compared: from zero, with neighbours, quiet, and what else is
    // computed.
    std::string for_cells() const;
};

} // namespace compat
