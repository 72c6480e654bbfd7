// SPDX-License-Identifier: GPL-3.0-or-later
// The two arrays of a reading, of a triangulation of CGAL's.
#pragma once

#include "cgal_space.hpp"
#include "reading.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bench {

/// Once over all cells for rows and corners, infinite cells having DELDRIFT_NONE for a row, and once more for the
/// rows of neighbours. The arrays are kept, so that only those of a larger triangulation need new memory.
template <unsigned dimension, typename Space = CgalSpace<dimension>>
class CgalReading {
    using Triangulation = typename Space::Triangulation;
    static constexpr int n_corners = dimension + 1;

public:
    Reading write(const Triangulation &triangulation) {
        if (triangulation.dimension() < static_cast<int>(dimension)) return {};
        const std::size_t room = n_corners * Space::n_all_cells(triangulation);
        if (vertices_.size() < room) {
            vertices_.resize(room);
            neighbours_.resize(room);
        }
        const std::uint32_t n_cells = write_vertices(triangulation);
        write_neighbours(triangulation);
        return {n_cells, vertices_.data(), neighbours_.data(), nullptr};
    }

private:
    std::uint32_t write_vertices(const Triangulation &triangulation) {
        std::uint32_t n_cells = 0;
        std::uint32_t *to = vertices_.data();
        const auto end = Space::all_cells_end(triangulation);
        for (auto cell = Space::all_cells_begin(triangulation); cell != end; ++cell) {
            const bool is_finite = !triangulation.is_infinite(cell);
            cell->info() = is_finite ? n_cells++ : DELDRIFT_NONE;
            if (is_finite)
                for (int corner = 0; corner < n_corners; ++corner) *to++ = cell->vertex(corner)->info().id;
        }
        return n_cells;
    }

    void write_neighbours(const Triangulation &triangulation) {
        std::uint32_t *to = neighbours_.data();
        const auto end = Space::all_cells_end(triangulation);
        for (auto cell = Space::all_cells_begin(triangulation); cell != end; ++cell)
            if (cell->info() != DELDRIFT_NONE)
                for (int corner = 0; corner < n_corners; ++corner) *to++ = cell->neighbor(corner)->info();
    }

    std::vector<std::uint32_t> vertices_;
    std::vector<std::uint32_t> neighbours_;
};

}  // namespace bench
