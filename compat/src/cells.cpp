#include "cells.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace compat {

namespace {

using Row = std::array<std::uint32_t, 4>;

// The order of the corners of a cell in its sorted row.
std::array<unsigned, 4> corner_order(const std::uint32_t *vertices, unsigned n_corners) {
    std::array<unsigned, 4> order{0, 1, 2, 3};
    if (n_corners == 3) {
        const unsigned lowest = static_cast<unsigned>(std::min_element(vertices, vertices + 3) - vertices);
        for (unsigned i = 0; i < 3; i++) order[i] = (lowest + i) % 3;
        return order;
    }
    bool odd = false;
    for (unsigned i = 1; i < n_corners; i++)
        for (unsigned j = i; j > 0 && vertices[order[j - 1]] > vertices[order[j]]; j--) {
            std::swap(order[j - 1], order[j]);
            odd = !odd;
        }
    if (odd) std::swap(order[2], order[3]);
    return order;
}

std::vector<Row> ascending_rows(const Cells &cells, const std::vector<std::uint32_t> &representative) {
    std::vector<Row> rows(cells.count, Row{});
    for (std::size_t c = 0; c < cells.count; c++) {
        for (unsigned i = 0; i < cells.n_corners; i++) {
            const std::uint32_t vertex = cells.vertices[c * cells.n_corners + i];
            rows[c][i] = vertex < representative.size() ? representative[vertex] : vertex;
        }
        std::sort(rows[c].begin(), rows[c].begin() + cells.n_corners);
    }
    std::sort(rows.begin(), rows.end());
    return rows;
}

} // namespace

OwnedCells sorted_cells(const Cells &cells, std::vector<std::uint32_t> *order) {
    const unsigned n = cells.n_corners;
    std::vector<Row> rows(cells.count, Row{});
    for (std::size_t c = 0; c < cells.count; c++) {
        const auto corners = corner_order(cells.vertices + c * n, n);
        for (unsigned i = 0; i < n; i++) rows[c][i] = cells.vertices[c * n + corners[i]];
    }
    std::vector<std::uint32_t> old_index(cells.count), new_index(cells.count);
    std::iota(old_index.begin(), old_index.end(), 0u);
    std::sort(old_index.begin(), old_index.end(), [&](std::uint32_t a, std::uint32_t b) { return rows[a] < rows[b]; });
    for (std::size_t c = 0; c < cells.count; c++) new_index[old_index[c]] = static_cast<std::uint32_t>(c);

    OwnedCells result{n, std::vector<std::uint32_t>(cells.count * n), std::vector<std::uint32_t>(cells.count * n)};
    for (std::size_t c = 0; c < cells.count; c++) {
        const std::size_t old = old_index[c];
        const auto corners = corner_order(cells.vertices + old * n, n);
        for (unsigned i = 0; i < n; i++) {
            const std::uint32_t neighbour = cells.neighbours[old * n + corners[i]];
            result.vertices[c * n + i] = rows[old][i];
            result.neighbours[c * n + i] = neighbour == no_cell ? no_cell : new_index[neighbour];
        }
    }
    if (order != nullptr) *order = std::move(old_index);
    return result;
}

Difference difference(const Cells &own, const Cells &other, const std::vector<std::uint32_t> &representative) {
    const std::vector<Row> left = ascending_rows(own, representative), right = ascending_rows(other, representative);
    Difference result;
    const auto note = [&](const Row &row, bool is_own) {
        if (result.count++ > 0) return;
        result.first_is_own = is_own;
        std::copy(row.begin(), row.end(), result.first);
    };
    auto a = left.begin();
    auto b = right.begin();
    while (a != left.end() || b != right.end()) {
        if (b == right.end() || (a != left.end() && *a < *b)) note(*a++, true);
        else if (a == left.end() || *b < *a) note(*b++, false);
        else ++a, ++b;
    }
    return result;
}

} // namespace compat
