// SPDX-License-Identifier: GPL-3.0-or-later
#include "cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <stdexcept>

namespace bench {

std::vector<std::uint32_t> representatives(unsigned dimension, const double *positions, std::size_t n_points) {
    std::vector<std::uint32_t> order(n_points);
    std::iota(order.begin(), order.end(), 0u);
    const auto place = [&](std::uint32_t id) { return positions + std::size_t{id} * dimension; };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        for (unsigned axis = 0; axis < dimension; ++axis)
            if (place(a)[axis] != place(b)[axis]) return place(a)[axis] < place(b)[axis];
        return a < b;
    });
    std::vector<std::uint32_t> representative(n_points);
    for (std::size_t i = 0; i < n_points; ++i) {
        const bool same_place =
            i > 0 && std::equal(place(order[i]), place(order[i]) + dimension, place(order[i - 1]));
        representative[order[i]] = same_place ? representative[order[i - 1]] : order[i];
    }
    return representative;
}

CellSet canonical(unsigned dimension, const std::vector<std::uint32_t> &flat_cells,
                  const std::vector<std::uint32_t> &representatives) {
    const std::size_t n_corners = dimension + 1;
    if (flat_cells.size() % n_corners != 0) throw std::runtime_error("a cell is incomplete");
    CellSet cells(flat_cells.size() / n_corners);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        Cell &cell = cells[c];
        cell.fill(no_vertex);
        for (std::size_t corner = 0; corner < n_corners; ++corner) {
            const std::uint32_t id = flat_cells[c * n_corners + corner];
            if (id >= representatives.size())
                throw std::runtime_error(fmt::format("a cell has vertex {} of {}", id, representatives.size()));
            cell[corner] = representatives[id];
        }
        std::sort(cell.begin(), cell.begin() + n_corners);
        if (std::adjacent_find(cell.begin(), cell.begin() + n_corners) != cell.begin() + n_corners)
            throw std::runtime_error("cell " + to_string(cell) + " has a vertex twice");
    }
    std::sort(cells.begin(), cells.end());
    const auto twice = std::adjacent_find(cells.begin(), cells.end());
    if (twice != cells.end()) throw std::runtime_error("cell " + to_string(*twice) + " comes twice");
    return cells;
}

CellSet difference(const CellSet &a, const CellSet &b) {
    CellSet only_a;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only_a));
    return only_a;
}

std::string to_string(const Cell &cell) {
    const auto end = std::find(cell.begin(), cell.end(), no_vertex);
    return fmt::format("({})", fmt::join(cell.begin(), end, ", "));
}

}  // namespace bench
