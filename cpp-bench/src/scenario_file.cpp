// SPDX-License-Identifier: GPL-3.0-or-later
#include "npy.hpp"
#include "scenarios.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace bench {
namespace {

std::string stem(const std::string &path) {
    const std::string name = std::filesystem::path(path).stem().string();
    if (name.empty() || name.find_first_of(",\"\n\r") != std::string::npos)
        throw std::runtime_error(path + " does not make a scenario name: it must not hold commas, quotes or line ends");
    return name;
}

std::string shape_text(const NpyArray &array) {
    return array.shape.empty() ? "a single number" : fmt::format("{}", fmt::join(array.shape, " x "));
}

void require_finite(const Series &series, const std::string &path) {
    for (std::size_t i = 0; i < series.positions.size(); ++i)
        if (!std::isfinite(series.positions[i]))
            throw std::runtime_error(fmt::format("{} holds a coordinate that is not finite: frame {}, point {}", path,
                                                 i / series.frame_length(),
                                                 i % series.frame_length() / series.dimension));
}

}  // namespace

Series load_series(const std::string &path) {
    NpyArray array = read_npy(path);
    const std::size_t n_axes = array.shape.size();
    const bool has_frames = n_axes == 3;
    const bool fits = (n_axes == 2 || n_axes == 3) && (array.shape.back() == 2 || array.shape.back() == 3) &&
                      !array.values.empty();
    if (!fits)
        throw std::runtime_error(path + " has shape " + shape_text(array) +
                                 "; wanted is frames x points x 2 or 3, or points x 2 or 3");
    Series series;
    series.name = stem(path);
    series.dimension = static_cast<unsigned>(array.shape.back());
    series.n_points = array.shape[has_frames ? 1 : 0];
    series.positions = std::move(array.values);
    require_finite(series, path);
    return series;
}

Series load_displacement(const std::string &path, const std::string &displacement_path, std::size_t n_steps) {
    const Series base = load_series(path);
    const Series displacement = load_series(displacement_path);
    if (base.n_frames() != 1 || displacement.n_frames() != 1)
        throw std::runtime_error("--displacement wants positions and displacements of points x dimension each");
    if (base.n_points != displacement.n_points || base.dimension != displacement.dimension)
        throw std::runtime_error(path + " and " + displacement_path + " differ in shape");
    Series series;
    series.name = base.name;
    series.dimension = base.dimension;
    series.n_points = base.n_points;
    series.positions.reserve((n_steps + 1) * base.frame_length());
    for (std::size_t step = 0; step <= n_steps; ++step) {
        const double share = static_cast<double>(step) / static_cast<double>(n_steps);
        for (std::size_t i = 0; i < base.frame_length(); ++i)
            series.positions.push_back(base.positions[i] + share * displacement.positions[i]);
    }
    return series;
}

std::size_t snap(Series &series, double magnitude) {
    std::size_t n_snapped = 0;
    for (double &coordinate : series.positions)
        if (coordinate != 0 && std::fabs(coordinate) < magnitude) {
            coordinate = 0;
            ++n_snapped;
        }
    return n_snapped;
}

}  // namespace bench
