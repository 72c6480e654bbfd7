// SPDX-License-Identifier: GPL-3.0-or-later
// Seeded random numbers with the same values on every platform (the standard distributions are not portable).
#pragma once

#include <cstdint>
#include <random>

namespace bench {

class Random {
public:
    explicit Random(std::uint64_t seed) : bits_(seed) {}

    /// Uniform in [0, 1), on the grid of 53-bit fractions.
    double unit() { return static_cast<double>(bits_() >> 11) * 0x1.0p-53; }

    /// Uniform in [-half_width, half_width).
    double symmetric(double half_width) { return (2.0 * unit() - 1.0) * half_width; }

    /// Uniform in the ball of the given radius around the origin (a disk in 2D), by rejection from the cube.
    void in_ball(unsigned dimension, double radius, double *point) {
        double squared;
        do {
            squared = 0.0;
            for (unsigned axis = 0; axis < dimension; ++axis) {
                point[axis] = symmetric(radius);
                squared += point[axis] * point[axis];
            }
        } while (squared > radius * radius);
    }

private:
    std::mt19937_64 bits_;
};

}  // namespace bench
