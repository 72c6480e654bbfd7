// SPDX-License-Identifier: GPL-3.0-or-later
// Sets of cells in one canonical form, so that triangulations of different libraries can be compared.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bench {

/// The ids of a cell's vertices in ascending order; a triangle's fourth entry is `no_vertex`.
using Cell = std::array<std::uint32_t, 4>;
constexpr std::uint32_t no_vertex = UINT32_MAX;

/// Cells in ascending order, each once.
using CellSet = std::vector<Cell>;

/// For every point the lowest id among the points at exactly its place.
std::vector<std::uint32_t> representatives(unsigned dimension, const double *positions, std::size_t n_points);

/// Canonical form of flat cells (dimension + 1 ids each), every id replaced by its representative. Throws
/// std::runtime_error where an id is out of range, a cell has a vertex twice or a cell comes twice.
CellSet canonical(unsigned dimension, const std::vector<std::uint32_t> &flat_cells,
                  const std::vector<std::uint32_t> &representatives);

/// The cells of `a` that are not in `b`.
CellSet difference(const CellSet &a, const CellSet &b);

/// "(3, 14, 15)", for messages.
std::string to_string(const Cell &cell);

}  // namespace bench
