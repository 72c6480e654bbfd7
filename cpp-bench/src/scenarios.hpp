// SPDX-License-Identifier: GPL-3.0-or-later
// Where the positions come from. Every series is recorded in full before anything is timed.
#pragma once

#include "progress.hpp"
#include "series.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace bench {

/// Radius of the ball (disk) that has volume (area) `n_points`, so that they are at unit density in it.
double unit_density_radius(unsigned dimension, std::size_t n_points);

/// Lloyd's iterations in a disk at unit density: random points, and at each timestamp every point goes to the
/// centroid of its Voronoi cell clipped to the disk.
Series record_lloyd_2d_uniform(std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed,
                               Progress &progress);

/// Length of a step of the random walk, as a share of the spacing (1 at unit density).
constexpr double walk_step = 0.01;

/// Random points in a ball at unit density; at each timestamp every point goes `walk_step` in a random direction,
/// drawn again where it would leave the ball.
Series record_walk_3d(std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed, Progress &progress);

/// One frame of random points in the unit square or cube.
Series uniform_points(unsigned dimension, std::size_t n_points, std::uint64_t seed);

/// A recorded series: an array of frames x points x dimension; of points x dimension, it is a single frame.
Series load_series(const std::string &path);

/// Positions of points x dimension and as many displacements, applied in equal steps.
Series load_displacement(const std::string &path, const std::string &displacement_path, std::size_t n_steps);

/// Coordinates smaller than `magnitude` become 0, as some codes leave what rounding made of a zero and deldrift
/// has a least magnitude. How many there were.
std::size_t snap(Series &series, double magnitude);

}  // namespace bench
