// Triangle's output, from cells.
#pragma once

#include <deldrift_triangle.h>

#include "triangle_mesh.hpp"
#include "triangle_switches.hpp"

namespace compat {

// Writes what the switches ask for to out and vorout, numbered and ordered as Triangle does. The points of the mesh are
// valid. Lists of holes and regions are those of the input, or copies if the caller frees them. Switch j leaves out the points that are in no cell; where there are no cells, those that another one than
// themselves represents (Mesh::representative; empty if there are none). Throws std::bad_alloc, and has written nothing
// then.
void write_triangulation(const TriangleSwitches &switches, const Mesh &mesh, const triangulateio &in,
                         bool copies_lists, triangulateio &out, triangulateio *vorout);

} // namespace compat
