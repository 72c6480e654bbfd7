// SPDX-License-Identifier: GPL-3.0-or-later
#include "record.hpp"
#include "scenarios.hpp"

#include <fmt/format.h>

#include <cmath>

namespace bench {
namespace {

void random_direction(Random &random, unsigned dimension, double *direction) {
    double squared;
    do {
        random.in_ball(dimension, 1.0, direction);
        squared = 0;
        for (unsigned axis = 0; axis < dimension; ++axis) squared += direction[axis] * direction[axis];
    } while (squared < 1e-6);
    for (unsigned axis = 0; axis < dimension; ++axis) direction[axis] /= std::sqrt(squared);
}

void step_inside(Random &random, unsigned dimension, double step, double radius, const double *from, double *to) {
    double squared;
    do {
        double direction[3];
        random_direction(random, dimension, direction);
        squared = 0;
        for (unsigned axis = 0; axis < dimension; ++axis) {
            to[axis] = from[axis] + step * direction[axis];
            squared += to[axis] * to[axis];
        }
    } while (squared > radius * radius);
}

}  // namespace

double unit_density_radius(unsigned dimension, std::size_t n_points) {
    const double pi = std::acos(-1.0);
    const double n = static_cast<double>(n_points);
    return dimension == 2 ? std::sqrt(n / pi) : std::cbrt(3 * n / (4 * pi));
}

std::vector<double> points_in_ball(unsigned dimension, std::size_t n_points, Random &random) {
    const double radius = unit_density_radius(dimension, n_points);
    std::vector<double> points(n_points * dimension);
    for (std::size_t at = 0; at < points.size(); at += dimension) random.in_ball(dimension, radius, &points[at]);
    return points;
}

Series record_walk_3d(std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed, Progress &progress) {
    const double radius = unit_density_radius(3, n_points);
    Random random(seed);
    const std::vector<double> start = points_in_ball(3, n_points, random);
    return record("walk_3d", 3, start, n_timestamps, progress, [&](const double *from, double *to) {
        for (std::size_t at = 0; at < start.size(); at += 3)
            step_inside(random, 3, walk_step, radius, from + at, to + at);
    });
}

Series record_segments(const std::string &name, unsigned dimension, std::size_t n_points,
                       const std::vector<double> &displacements, std::size_t length, std::uint64_t seed,
                       Progress &progress) {
    Series series;
    series.name = name;
    series.dimension = dimension;
    series.n_points = n_points;
    const double radius = unit_density_radius(dimension, n_points);
    Random random(seed);
    const std::vector<double> start = points_in_ball(dimension, n_points, random);

    progress.begin(fmt::format("{}: recording {} displacements", name, displacements.size()),
                   displacements.size());
    for (const double displacement : displacements) {
        series.positions.insert(series.positions.end(), start.begin(), start.end());
        const std::size_t begin = series.n_frames(), first = begin + segment_warm_up;
        for (std::size_t timestamp = begin; timestamp < first + length; ++timestamp) {
            series.positions.resize((timestamp + 1) * series.frame_length());
            const double *from = series.frame(timestamp - 1);
            double *to = series.positions.data() + timestamp * series.frame_length();
            for (std::size_t at = 0; at < series.frame_length(); at += dimension)
                step_inside(random, dimension, displacement, radius, from + at, to + at);
        }
        series.segments.push_back({begin, first, first + length - 1, displacement});
        progress.step();
    }
    return series;
}

Series uniform_points(unsigned dimension, std::size_t n_points, std::uint64_t seed) {
    Series series;
    series.name = dimension == 2 ? "static_2d" : "static_3d";
    series.dimension = dimension;
    series.n_points = n_points;
    series.positions.resize(n_points * dimension);
    Random random(seed);
    for (double &coordinate : series.positions) coordinate = random.unit();
    return series;
}

}  // namespace bench
