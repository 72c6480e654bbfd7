// Triangle's output, from cells.
#pragma once

#include <deldrift_triangle.h>

#include <cstdint>
#include <vector>

#include "cells.hpp"
#include "triangle_switches.hpp"

namespace compat {

// Writes what the switches ask for to out and vorout, numbered and ordered as Triangle does. The points of in are
// valid. Switch j leaves out the points that are in no cell; where there are no cells, those that another one than
// themselves represents (see representatives.hpp). Throws std::bad_alloc, and has written nothing then.
void write_triangulation(const TriangleSwitches &switches, const Cells &cells,
                         const std::vector<std::uint32_t> &representative, const triangulateio &in,
                         triangulateio &out, triangulateio *vorout);

} // namespace compat
