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
void iterate(const double *from, std::size_t n_points, double radius, double *to) {
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
        const AreaAndCentroid clipped = intersect_disk(cell, radius);
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

Series record_lloyd_2d_uniform(std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed,
                               Progress &progress) {
    Series series;
    series.name = "lloyd_2d_uniform";
    series.dimension = 2;
    series.n_points = n_points;
    series.positions.resize((n_timestamps + 1) * 2 * n_points);
    const double radius = unit_density_radius(2, n_points);
    Random random(seed);
    for (std::size_t id = 0; id < n_points; ++id) random.in_ball(2, radius, &series.positions[2 * id]);

    progress.begin(series.name + ": recording " + std::to_string(n_timestamps) + " timestamps", n_timestamps);
    for (std::size_t timestamp = 1; timestamp <= n_timestamps; ++timestamp) {
        iterate(series.frame(timestamp - 1), n_points, radius,
                series.positions.data() + timestamp * series.frame_length());
        progress.step();
    }
    return series;
}

}  // namespace bench
