// Cells along the convex hull that are flat but for rounding.
#pragma once

#include <cstddef>
#include <vector>

#include "cells.hpp"

namespace compat {

// qhull's bound of the rounding in the distance of a point to a facet of the hull, times the factor within which it
// takes a point for one in the plane of the facet: 2 where points are in the plane, 6 in space.
double flatness_tolerance(unsigned dimension, const double *points, std::size_t n_points);

// For each cell whether it is dropped: it has a facet on the boundary of those that are left, and the corner opposite
// is within the tolerance of the plane of that facet. Empty if none is.
std::vector<bool> flat_cells(const Cells &cells, const double *points, double tolerance);

} // namespace compat
