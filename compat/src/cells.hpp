// Cells as rows of vertices and neighbours, wherever they come from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace compat {

constexpr std::uint32_t no_cell = UINT32_MAX;

// Rows that belong to someone else. Cells are positively oriented, and entry i of a row of neighbours is the cell
// opposite corner i, or no_cell.
struct Cells {
    unsigned n_corners = 0;
    std::size_t count = 0;
    const std::uint32_t *vertices = nullptr;
    const std::uint32_t *neighbours = nullptr;
};

struct OwnedCells {
    unsigned n_corners = 0;
    std::vector<std::uint32_t> vertices, neighbours;
    Cells view() const { return {n_corners, vertices.size() / n_corners, vertices.data(), neighbours.data()}; }
};

// In an order that depends on the vertices alone: corners begin with the lowest (2D) or ascend, the last two exchanged
// where orientation asks for it (3D); rows ascend. order, where not null: for each row the cell that it was.
OwnedCells sorted_cells(const Cells &cells, std::vector<std::uint32_t> *order = nullptr);

// What one set of cells has that another has not.
struct Difference {
    std::size_t count = 0;      // cells that are in one of them only
    bool first_is_own = false;  // whether the first is in the first set
    std::uint32_t first[4] = {}; // its vertices, ascending
};

// Of two sets of cells with as many corners; representative, where not empty, maps each vertex to the lowest one at its
// place.
Difference difference(const Cells &own, const Cells &other, const std::vector<std::uint32_t> &representative);

} // namespace compat
