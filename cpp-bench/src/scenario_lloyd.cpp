// SPDX-License-Identifier: GPL-3.0-or-later
#include "cgal_space.hpp"
#include "disk_cell.hpp"
#include "random.hpp"
#include "scenarios.hpp"

#include <algorithm>
#include <cmath>

namespace bench {
namespace {

using Space = CgalSpace<2>;

/// Every point to the centroid of its cell. A point whose cell has no area left (it coincides with another) stays.
void iterate(const double *from, std::size_t n_points, double radius, const Density *density, double *to) {
    std::vector<Space::InputPoint> input = input_points<2>(from, n_points);
    Space::Triangulation triangulation;
    insert_range<2>(triangulation, input);

    std::copy(from, from + 2 * n_points, to);
    for (auto vertex = triangulation.finite_vertices_begin(); vertex != triangulation.finite_vertices_end();
         ++vertex) {
        const Point2 site{vertex->point().x(), vertex->point().y()};
        Polygon cell = square(2 * radius);
        auto neighbour = triangulation.incident_vertices(vertex);
        const auto first = neighbour;
        if (first != nullptr) do {
                if (triangulation.is_infinite(neighbour)) continue;
                clip_to_bisector(cell, site, {neighbour->point().x(), neighbour->point().y()});
            } while (++neighbour != first);
        const AreaAndCentroid clipped =
            density ? intersect_disk(cell, radius, site, density->value) : intersect_disk(cell, radius);
        if (clipped.area > 0) {
            to[2 * vertex->info().id] = clipped.centroid[0];
            to[2 * vertex->info().id + 1] = clipped.centroid[1];
        }
    }
}

}  // namespace

double unit_density_radius(unsigned dimension, std::size_t n_points) {
    const double pi = std::acos(-1.0);
    const double n = static_cast<double>(n_points);
    return dimension == 2 ? std::sqrt(n / pi) : std::cbrt(3 * n / (4 * pi));
}

const std::vector<Density> &lloyd_densities() {
    static const std::vector<Density> densities = {
        {"lloyd_2d_r2", [](double x, double y) { return x * x + y * y; }},
        {"lloyd_2d_x2", [](double x, double) { return x * x; }},
        {"lloyd_2d_sin2",
         [](double x, double y) {
             const double sine = std::sin(std::sqrt(x * x + y * y));
             return sine * sine;
         }},
    };
    return densities;
}

namespace {

/// By rejection; no density here exceeds the greater of 1 and the squared radius.
void sample(const Density &density, double radius, Random &random, double *point) {
    const double greatest = density.name == "lloyd_2d_sin2" ? 1 : radius * radius;
    do random.in_ball(2, radius, point);
    while (random.unit() * greatest >= density.value(point[0], point[1]));
}

Series record(const std::string &name, const Density *density, std::size_t n_points, std::size_t n_timestamps,
              std::uint64_t seed, Progress &progress) {
    Series series;
    series.name = name;
    series.dimension = 2;
    series.n_points = n_points;
    series.positions.resize((n_timestamps + 1) * 2 * n_points);
    const double radius = unit_density_radius(2, n_points);
    Random random(seed);
    for (std::size_t id = 0; id < n_points; ++id) {
        double *point = &series.positions[2 * id];
        if (density)
            sample(*density, radius, random, point);
        else
            random.in_ball(2, radius, point);
    }
    progress.begin(name + ": recording " + std::to_string(n_timestamps) + " timestamps", n_timestamps);
    for (std::size_t timestamp = 1; timestamp <= n_timestamps; ++timestamp) {
        iterate(series.frame(timestamp - 1), n_points, radius, density,
                series.positions.data() + timestamp * series.frame_length());
        progress.step();
    }
    return series;
}

}  // namespace

Series record_lloyd_2d_uniform(std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed,
                               Progress &progress) {
    return record("lloyd_2d_uniform", nullptr, n_points, n_timestamps, seed, progress);
}

Series record_lloyd_2d(const Density &density, std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed,
                       Progress &progress) {
    return record(density.name, &density, n_points, n_timestamps, seed, progress);
}

}  // namespace bench
