// TetGen's output, from cells.
#pragma once

#include <deldrift_tetgen.h>

#include <vector>

#include "cells.hpp"
#include "tetgen_switches.hpp"

namespace compat {

// Writes what the switches ask for to out, numbered and ordered as TetGen does. The points of in are valid. Points
// that a representative (see representatives.hpp) stands for are left out, if the switches say so. Throws
// std::bad_alloc, and has written nothing then.
void write_tetrahedra(const TetgenSwitches &switches, const Cells &cells, const tetgenio &in, tetgenio &out,
                      const std::vector<std::uint32_t> &representative);

} // namespace compat
