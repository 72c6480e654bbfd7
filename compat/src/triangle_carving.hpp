// What Triangle makes of a triangulation with segments: without the concavities and holes, with boundaries marked, and
// regions with their attributes.
#pragma once

#include <deldrift_triangle.h>

#include <string>

#include <deldrift.h>

#include "triangle_graph.hpp"
#include "triangle_mesh.hpp"
#include "triangle_switches.hpp"

namespace compat {

// t has the pieces of the graph as its segments, with their numbers. cells are those of t; the mesh may refer to them
// and to the graph.
Mesh carve(const TriangleSwitches &switches, const triangulateio &in, const Graph &graph,
           const deldrift_triangulation *t, const Cells &cells);

} // namespace compat
