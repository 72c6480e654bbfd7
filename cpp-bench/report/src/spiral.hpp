// SPDX-License-Identifier: GPL-3.0-or-later
// Directions spread evenly.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace bench {

/// The i-th of n points of a spiral lattice on the unit sphere: equal steps of height, turned by the golden
/// angle.
inline std::array<double, 3> spiral_direction(std::size_t i, std::size_t n) {
    const double golden_angle = std::acos(-1.0) * (3 - std::sqrt(5.0));
    const double height = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
    const double radius = std::sqrt(1 - height * height);
    const double angle = golden_angle * static_cast<double>(i);
    return {radius * std::cos(angle), radius * std::sin(angle), height};
}

}  // namespace bench
