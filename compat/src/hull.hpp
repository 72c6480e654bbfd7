// The edges of the hull of cells in the plane, in their order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "cells.hpp"

namespace compat {

// A cell and the corner opposite an edge.
struct HullEdge {
    std::uint32_t cell;
    unsigned corner;
};

// That with the start that is first by x, then by y; no_cell if there is none.
inline HullEdge first_hull_edge(const Cells &cells, const double *points) {
    HullEdge first{no_cell, 0};
    const double *least = nullptr;
    for (std::uint32_t c = 0; c < cells.count; c++) {
        for (unsigned corner = 0; corner < 3; corner++) {
            if (cells.neighbours[std::size_t{3} * c + corner] != no_cell) continue;
            const double *start = points + std::size_t{2} * cells.vertices[std::size_t{3} * c + (corner + 1) % 3];
            if (least != nullptr && !std::lexicographical_compare(start, start + 2, least, least + 2)) continue;
            least = start;
            first = {c, corner};
        }
    }
    return first;
}

// Turns around the edge's end, from cell to cell.
inline HullEdge next_on_hull(const Cells &cells, HullEdge edge) {
    const std::uint32_t end = cells.vertices[std::size_t{3} * edge.cell + (edge.corner + 2) % 3];
    edge.corner = (edge.corner + 1) % 3;
    for (;;) {
        const std::uint32_t next = cells.neighbours[std::size_t{3} * edge.cell + edge.corner];
        if (next == no_cell) return edge;
        unsigned at = 0;
        while (cells.vertices[std::size_t{3} * next + at] != end) at++;
        edge = {next, (at + 2) % 3};
    }
}

// Counter-clockwise from the first: cell, and corner opposite.
template <class Visit>
void for_each_hull_edge(const Cells &cells, const double *points, Visit visit) {
    const HullEdge first = first_hull_edge(cells, points);
    if (first.cell == no_cell) return;
    HullEdge edge = first;
    do {
        visit(edge.cell, edge.corner);
        edge = next_on_hull(cells, edge);
    } while (edge.cell != first.cell || edge.corner != first.corner);
}

} // namespace compat
