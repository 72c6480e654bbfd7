// SPDX-License-Identifier: GPL-3.0-or-later
// What a program without geometry of its mesh writes itself: a mask of triangles, and its boundary.
#pragma once

#include "../examples/particle_fem_flow.hpp"

/// Which triangles have a circumradius of at most so much.
inline void mask_of(const double *positions, const CellArrays &cells, double radius, std::vector<std::uint8_t> &mask) {
    const auto squared = [&](std::uint32_t a, std::uint32_t b) {
        const double x = positions[2 * b] - positions[2 * a], y = positions[2 * b + 1] - positions[2 * a + 1];
        return x * x + y * y;
    };
    mask.resize(cells.count);
    for (std::size_t c = 0; c < cells.count; c++) {
        const std::uint32_t *v = cells.vertices + 3 * c;
        const double *a = positions + 2 * v[0], *b = positions + 2 * v[1], *d = positions + 2 * v[2];
        const double twice = (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]);
        const double edges = squared(v[0], v[1]) * squared(v[1], v[2]) * squared(v[2], v[0]);
        mask[c] = edges <= 4 * radius * radius * twice * twice;
    }
}

/// Edges of triangles in the mask that no other one in it has: pairs of vertices, the triangle to the left.
inline void boundary_of(const CellArrays &cells, const std::vector<std::uint8_t> &mask,
                        std::vector<std::uint32_t> &facets) {
    facets.clear();
    for (std::size_t c = 0; c < cells.count; c++) {
        for (std::size_t i = 0; mask[c] && i < 3; i++) {
            const std::uint32_t other = cells.neighbours[3 * c + i];
            if (other < cells.count && mask[other]) continue;
            facets.insert(facets.end(), {cells.vertices[3 * c + (i + 1) % 3], cells.vertices[3 * c + (i + 2) % 3]});
        }
    }
}
