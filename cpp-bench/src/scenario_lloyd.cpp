// SPDX-License-Identifier: GPL-3.0-or-later
#include "cgal_space.hpp"
#include "disk_cell.hpp"
#include "record.hpp"
#include "scenarios.hpp"

#include <algorithm>
#include <cmath>

namespace bench {
namespace {

using Space = CgalSpace<2>;

/// Every point to the centroid of its cell. A point whose cell has no
/// area left (it coincides with another) stays.
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
std::vector<double> sample(const Density &density, std::size_t n_points, Random &random) {
    const double radius = unit_density_radius(2, n_points);
    const double greatest = density.name == "lloyd_2d_sin2" ? 1 : radius * radius;
    std::vector<double> points(2 * n_points);
    for (std::size_t at = 0; at < points.size(); at += 2) {
        do random.in_ball(2, radius, &points[at]);
        while (random.unit() * greatest >= density.value(points[at], points[at + 1]));
    }
    return points;
}

Series record_lloyd(const std::string &name, const Density *density, std::size_t n_points,
                    std::size_t n_timestamps, std::uint64_t seed, Progress &progress) {
    Random random(seed);
    const std::vector<double> start =
        density ? sample(*density, n_points, random) : points_in_ball(2, n_points, random);
    const double radius = unit_density_radius(2, n_points);
    return record(name, 2, start, n_timestamps, progress,
                  [&](const double *from, double *to) { iterate(from, n_points, radius, density, to); });
}

}  // namespace

Series record_lloyd_2d_uniform(std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed,
                               Progress &progress) {
    return record_lloyd("lloyd_2d_uniform", nullptr, n_points, n_timestamps, seed, progress);
}

Series record_lloyd_2d(const Density &density, std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed,
                       Progress &progress) {
    return record_lloyd(density.name, &density, n_points, n_timestamps, seed, progress);
}

}  // namespace bench
