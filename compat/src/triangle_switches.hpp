// Triangle's switches.
#pragma once

#include <cstddef>
#include <cstdint>
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
    bool splits = false;       // s: segments may be cut so that the triangulation stays Delaunay
    bool jettison = false;     // j: points that are in no triangle are left out
    bool has_middles = false;  // o2: the middles of edges are points, triangles have six
    bool markers = true;       // not B
    bool points = true;        // not N
    bool triangles = true;     // not E
    bool segments = true;      // not P
    bool reconstructs = false; // r: triangles are given, and what they cover is refined
    bool refines = false;      // q, a, D, L or u: points are added
    double least_angle = 0;    // q: in degrees
    double greatest_area = 0;  // a with a number; 0 for any
    bool has_region_areas = false; // a without a number: those of regions
    bool conforms = false;     // D, or L, as it was called: no point is inside the circle around a triangle
    bool asks = false;         // u: the program's triunsuitable says which triangles are too large
    int n_kept = 0;            // Y: segments of the boundary stay whole, YY: all
    std::size_t limit = SIZE_MAX; // S: of the points that are added
    std::string unserved;      // the first switch that deldrift does not serve; empty if there is none
    std::string wrong;         // what is wrong with a switch; empty if nothing is

    explicit TriangleSwitches(const char *switches);

    // What of the input deldrift does not serve, or null.
    const char *unserved_input(const triangulateio &in) const;

    bool has_segments() const { return planar_graph || convex || refines; }
    // Whether the edges of the hull are segments.
    bool encloses() const { return !reconstructs && (convex || !planar_graph); }
    bool lists_segments() const { return (planar_graph || convex) && segments; }

    // For the original, to give cells that can be compared: from zero, with neighbours, quiet, and what else is
    // computed.
    std::string for_cells() const;

private:
    void read_angle(const std::string &number);
    void read_area(const std::string &number);
    void read_order(const std::string &number);
};

} // namespace compat
