// SPDX-License-Identifier: GPL-3.0-or-later
// Recording a series, one timestamp after the other.
#pragma once

#include "progress.hpp"
#include "random.hpp"
#include "series.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <vector>

namespace bench {

/// Radius of the ball (disk) that has volume (area) `n_points`, so that they are at unit density in it.
double unit_density_radius(unsigned dimension, std::size_t n_points);

/// Random points in that ball.
std::vector<double> points_in_ball(unsigned dimension, std::size_t n_points, Random &random);

/// The series that begins with these points; `advance(from, to)` makes each frame from the one before.
template <typename Advance>
Series record(const std::string &name, unsigned dimension, const std::vector<double> &start,
              std::size_t n_timestamps, Progress &progress, Advance advance) {
    Series series;
    series.name = name;
    series.dimension = dimension;
    series.n_points = start.size() / dimension;
    series.positions.reserve((n_timestamps + 1) * start.size());
    series.positions = start;
    series.positions.resize((n_timestamps + 1) * start.size());
    progress.begin(fmt::format("{}: recording {} timestamps", name, n_timestamps), n_timestamps);
    for (std::size_t timestamp = 1; timestamp <= n_timestamps; ++timestamp) {
        advance(series.frame(timestamp - 1), series.positions.data() + timestamp * series.frame_length());
        progress.step();
    }
    return series;
}

}  // namespace bench
