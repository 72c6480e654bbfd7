// Triangle's refinement: points that are added until triangles are as the switches q, a and D say.
#pragma once

#include <deldrift_triangle.h>

#include <cstdint>
#include <string>
#include <vector>

#include <deldrift.h>

#include "kept.hpp"
#include "triangle_given.hpp"
#include "triangle_graph.hpp"
#include "triangle_mesh.hpp"
#include "triangle_switches.hpp"

namespace compat {

// What a program that gives switch u has as triunsuitable: whether the triangle of three places with this area is too large.
using Unsuitable = int (*)(double *, double *, double *, double);

// Refines a copy of t, which has the pieces of the graph as its segments, with their numbers, and cells. The copy,
// which the mesh refers to, and the mesh are set. unsuitable: for switch u; given: for switch r, or null. Empty, or a message
// that says why it cannot be done.
std::string refine(const TriangleSwitches &switches, const triangulateio &in, const Graph &graph,
                   const deldrift_triangulation *t, Unsuitable unsuitable, GivenTriangles *given, Triangulation &copy,
                   Mesh &mesh);

} // namespace compat
