// TetGen's output, from cells.
#pragma once

#include <cstdint>
#include <vector>

#include "cells.hpp"
#include "tetgen_layout.hpp"
#include "tetgen_switches.hpp"

namespace compat {

// Writes what the switches ask for to out, numbered and ordered as TetGen does. Io is one of the layouts. The points of
// in are valid. Points that a representative (see representatives.hpp) stands for are left out, if the switches say so.
// weights: of all points, or empty. Without attributes they are that of each point.
// Throws std::bad_alloc, and has written nothing then.
template <class Io>
void write_tetrahedra(const TetgenSwitches &switches, const Cells &cells, const Io &in, Io &out,
                      const std::vector<std::uint32_t> &representative, const std::vector<double> &weights);

extern template void write_tetrahedra(const TetgenSwitches &, const Cells &, const TetgenIo150 &, TetgenIo150 &,
                                      const std::vector<std::uint32_t> &, const std::vector<double> &);
extern template void write_tetrahedra(const TetgenSwitches &, const Cells &, const TetgenIo151 &, TetgenIo151 &,
                                      const std::vector<std::uint32_t> &, const std::vector<double> &);
extern template void write_tetrahedra(const TetgenSwitches &, const Cells &, const TetgenIo16 &, TetgenIo16 &,
                                      const std::vector<std::uint32_t> &, const std::vector<double> &);

} // namespace compat
