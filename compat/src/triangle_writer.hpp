// Triangle's output, from cells.
#pragma once

#include <deldrift_triangle.h>

#include "cells.hpp"
#include "triangle_switches.hpp"

namespace compat {

// Writes what the switches ask for to out and vorout, numbered and ordered as Triangle does. The points of in are
// valid. Throws std::bad_alloc, and has written nothing then.
void write_triangulation(const TriangleSwitches &switches, const Cells &cells, const triangulateio &in,
                         triangulateio &out, triangulateio *vorout);

} // namespace compat
