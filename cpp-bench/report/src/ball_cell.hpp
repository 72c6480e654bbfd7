// SPDX-License-Identifier: GPL-3.0-or-later
// Voronoi cells in space clipped to a ball around the origin, by quadrature over directions.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace bench {

struct VolumeAndCentroid {
    double volume = 0;
    std::array<double, 3> centroid{0, 0, 0};
};

/// The part of a Voronoi cell inside a ball is star-shaped around its site: with the distance t of its
/// boundary in a direction w, its volume is the integral of t^3 / 3 over all w, its moment from the site that
/// of w t^4 / 4. Both are sums over the directions of a spiral lattice on the unit sphere, each with the same
/// weight.
class BallCells {
public:
    BallCells(double radius, std::size_t n_directions);

    /// Of the cell of `site`, which is inside the ball, among these other sites.
    VolumeAndCentroid cell(const double *site, const std::vector<const double *> &others);

private:
    double radius_;
    std::array<std::vector<double>, 3> directions_;
    std::vector<double> nearness_;  // 1 / t, for each direction
};

}  // namespace bench
