// SPDX-License-Identifier: GPL-3.0-or-later
// Where the positions come from. Every series is recorded in full before anything is timed.
#pragma once

#include "progress.hpp"
#include "series.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace bench {

/// Lloyd's iterations in a disk at unit density: random points, and at each timestamp every point goes to the
/// centroid of its Voronoi cell clipped to the disk.
Series record_lloyd_2d_uniform(std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed,
                               Progress &progress);

/// A density of Lloyd's iterations, and the scenario that has it.
struct Density {
    std::string name;
    std::function<double(double, double)> value;
};

/// The report's x^2 + y^2, x^2 and sin^2 of the distance from the centre.
const std::vector<Density> &lloyd_densities();

/// Lloyd's iterations as above, with a density: initial points are drawn by it, centroids are those of the
/// density (quadrature: see disk_cell.hpp).
Series record_lloyd_2d(const Density &density, std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed,
                       Progress &progress);

/// In so many timestamps DELDRIFT_AUTO has found out how points move and computed its tolerances.
constexpr std::size_t segment_warm_up = 3;

/// Random points in a disk or ball at unit density, and segments that all begin there: at each of
/// `segment_warm_up` timestamps and the `length` that follow every point goes the segment's displacement in a
/// random direction, drawn again where it would leave.
Series record_segments(const std::string &name, unsigned dimension, std::size_t n_points,
                       const std::vector<double> &displacements, std::size_t length, std::uint64_t seed,
                       Progress &progress);

/// Length of a step of the random walk, as a share of the spacing (1 at unit density).
constexpr double walk_step = 0.01;

/// Random points in a ball at unit density; at each timestamp every point goes `walk_step` in a random
/// direction, drawn again where it would leave the ball.
Series record_walk_3d(std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed, Progress &progress);

/// One frame of random points in the unit square or cube.
Series uniform_points(unsigned dimension, std::size_t n_points, std::uint64_t seed);

/// A recorded series: an array of frames x points x dimension; of points x dimension, it is a single frame.
Series load_series(const std::string &path);

/// Positions of points x dimension and as many displacements, applied in equal steps.
Series load_displacement(const std::string &path, const std::string &displacement_path, std::size_t n_steps);

/// Coordinates smaller than `magnitude` become 0, as some codes leave what rounding made of a zero and
/// deldrift has a least magnitude. How many there were.
std::size_t snap(Series &series, double magnitude);

}  // namespace bench
