// A triangulation as qhull has it: the facets of a convex hull in one dimension more, of which those below are the
// cells, and those above close it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cells.hpp"

namespace compat {

// Rows of n_corners points and of the n_corners facets opposite these. The first n_lower facets are the cells. A facet
// above has the orientation of a cell on the other side of the facet that they share.
struct QhullFacets {
    unsigned n_corners = 0;
    std::size_t n_lower = 0;
    std::vector<std::uint32_t> corners, neighbours;
    std::size_t count() const { return n_corners == 0 ? 0 : corners.size() / n_corners; }
};

// Of the cells that are not flat. Above, each facet on the boundary is joined to the apex: the point at infinity, or,
// with no_cell for apex, a point of the boundary. Empty if the boundary cannot be joined, or if a point of a cell is in
// none of those left: of points that nearly are on a line or plane.
QhullFacets closed_facets(const Cells &cells, const std::vector<bool> &is_flat, std::size_t n_points,
                          std::uint32_t apex);

} // namespace compat
