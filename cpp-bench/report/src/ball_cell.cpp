// SPDX-License-Identifier: GPL-3.0-or-later
#include "ball_cell.hpp"

#include "spiral.hpp"

#include <cmath>

namespace bench {

BallCells::BallCells(double radius, std::size_t n_directions) : radius_(radius), nearness_(n_directions) {
    for (std::size_t i = 0; i < n_directions; ++i) {
        const std::array<double, 3> direction = spiral_direction(i, n_directions);
        for (unsigned axis = 0; axis < 3; ++axis) directions_[axis].push_back(direction[axis]);
    }
}

VolumeAndCentroid BallCells::cell(const double *site, const std::vector<const double *> &others) {
    const std::size_t n = nearness_.size();
    const double *x = directions_[0].data(), *y = directions_[1].data(), *z = directions_[2].data();
    const double left = radius_ * radius_ - (site[0] * site[0] + site[1] * site[1] + site[2] * site[2]);
    for (std::size_t i = 0; i < n; ++i) {
        const double along = site[0] * x[i] + site[1] * y[i] + site[2] * z[i];
        nearness_[i] = 1 / (std::sqrt(along * along + left) - along);
    }
    for (const double *other : others) {
        const double normal[3] = {other[0] - site[0], other[1] - site[1], other[2] - site[2]};
        const double scale = 2 / (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        const double a = normal[0] * scale, b = normal[1] * scale, c = normal[2] * scale;
        for (std::size_t i = 0; i < n; ++i) {
            const double nearness = a * x[i] + b * y[i] + c * z[i];
            nearness_[i] = nearness > nearness_[i] ? nearness : nearness_[i];
        }
    }
    const double share = 4 * std::acos(-1.0) / static_cast<double>(n);
    VolumeAndCentroid result;
    double moment[3] = {0, 0, 0};
    for (std::size_t i = 0; i < n; ++i) {
        const double t = 1 / nearness_[i];
        const double cube = t * t * t;
        result.volume += cube;
        moment[0] += cube * t * x[i];
        moment[1] += cube * t * y[i];
        moment[2] += cube * t * z[i];
    }
    result.volume *= share / 3;
    for (unsigned axis = 0; axis < 3; ++axis)
        result.centroid[axis] = site[axis] + moment[axis] * share / 4 / result.volume;
    return result;
}

}  // namespace bench
