// SPDX-License-Identifier: GPL-3.0-or-later
// Optimal Delaunay triangulation (ODT), as far as the report's inputs need it: vertices move one after
// another, each seeing the new places of those before, and the boundary stays.
#include "body.hpp"
#include "record.hpp"
#include "report_space.hpp"
#include "report_scenarios.hpp"
#include "spiral.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace bench {
namespace {

struct Nothing {};

using Space = ReportSpace<3, Nothing>;
using Contains = std::function<bool(const double *)>;

/// One triangulation that follows all relocations.
class Optimisation {
public:
    Optimisation(const double *positions, std::size_t n_points, std::size_t n_fixed, Contains contains)
        : n_fixed_(n_fixed), contains_(std::move(contains)), vertices_(n_points) {
        std::vector<Space::InputPoint> input;
        for (std::size_t id = 0; id < n_points; ++id)
            input.emplace_back(Space::point(positions + 3 * id),
                               VertexInfo{static_cast<std::uint32_t>(id), 0});
        insert_sorted<Space>(triangulation_, input);
        for (auto vertex = triangulation_.finite_vertices_begin();
             vertex != triangulation_.finite_vertices_end(); ++vertex)
            vertices_[vertex->info().id] = vertex;
    }

    /// Every vertex that is not fixed once, in the order of the ids; where all vertices are then.
    void sweep(double *to) {
        for (std::size_t id = n_fixed_; id < vertices_.size(); ++id) relocate(vertices_[id]);
        for (std::size_t id = 0; id < vertices_.size(); ++id)
            std::copy(coordinates(vertices_[id]), coordinates(vertices_[id]) + 3, to + 3 * id);
    }

private:
    static const double *coordinates(Space::Vertex vertex) { return &*vertex->point().cartesian_begin(); }

    void relocate(Space::Vertex &vertex) {
        Space::star(triangulation_, vertex, star_);
        others_.clear();
        for (const auto cell : star_) {
            if (triangulation_.is_infinite(cell)) return;
            for (int corner = 0; corner < 4; ++corner)
                if (cell->vertex(corner) != vertex) others_.push_back(coordinates(cell->vertex(corner)));
        }
        double place[3];
        if (!odt_place(coordinates(vertex), others_, place) || !contains_(place)) return;
        const Space::Point point = Space::point(place);
        if (point == vertex->point() || move_if_star_stays<Space>(triangulation_, vertex, point, star_))
            return;
        made_.clear();
        vertex = Space::place(triangulation_, vertex, point, made_);
    }

    std::size_t n_fixed_;
    Contains contains_;
    Space::Triangulation triangulation_;
    std::vector<Space::Vertex> vertices_;
    std::vector<Space::Cell> star_;
    std::vector<Space::Cell> made_;
    std::vector<const double *> others_;
};

/// The first `n_fixed` points stay. The order of the relocations is that of the ids.
Series record_odt(const std::string &name, const std::vector<Vector3> &points, std::size_t n_fixed,
                  const Contains &contains, std::size_t n_timestamps, Progress &progress) {
    std::vector<double> start;
    for (const Vector3 &point : points) start.insert(start.end(), point.begin(), point.end());
    Optimisation optimisation(start.data(), points.size(), n_fixed, contains);
    Series series = record(name, 3, start, n_timestamps, progress,
                           [&](const double *, double *to) { optimisation.sweep(to); });
    series.is_sequential = true;
    return series;
}

/// How many of n points go to the surface so that it is as dense as the inside: with the spacing h, area /
/// h^2 on the surface, each of which has half a cell of the volume / h^3.
std::size_t share_of_surface(double area, double volume, std::size_t n_points) {
    double h = std::cbrt(volume / static_cast<double>(n_points));
    for (int i = 0; i < 50; ++i)
        h = std::cbrt(volume / std::max(static_cast<double>(n_points) - area / (2 * h * h), 1.0));
    return std::min(n_points, static_cast<std::size_t>(area / (h * h)));
}

}  // namespace

bool odt_place(const double *vertex, const std::vector<const double *> &star, double *place) {
    double volume = 0;
    Vector3 sum{};
    for (std::size_t i = 0; i + 2 < star.size(); i += 3) {
        const Vector3 b = vector(star[i]) - vector(vertex), c = vector(star[i + 1]) - vector(vertex),
                      d = vector(star[i + 2]) - vector(vertex);
        const double sixfold = dot(b, cross(c, d));
        volume += std::fabs(sixfold);
        sum = sum + (sixfold < 0 ? -0.5 : 0.5) * weighted_circumcentre(b, c, d);
    }
    if (!(volume > 0)) return false;
    for (unsigned axis = 0; axis < 3; ++axis) place[axis] = vertex[axis] + sum[axis] / volume;
    return true;
}

Series record_snodt(std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed, Progress &progress) {
    const double radius = unit_density_radius(3, n_points);
    const double pi = std::acos(-1.0);
    const std::size_t n_fixed = std::min(n_points, static_cast<std::size_t>(4 * pi * radius * radius));
    std::vector<Vector3> points;
    for (std::size_t i = 0; i < n_fixed; ++i) points.push_back(radius * spiral_direction(i, n_fixed));
    Random random(seed);
    points.resize(n_points);
    for (std::size_t id = n_fixed; id < n_points; ++id) random.in_ball(3, radius, points[id].data());
    const auto contains = [radius](const double *p) { return dot(vector(p), vector(p)) < radius * radius; };
    return record_odt("snodt", points, n_fixed, contains, n_timestamps, progress);
}

Series record_man(const Body &unscaled, std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed,
                  Progress &progress) {
    Body body = unscaled;
    body.scale_to_volume(static_cast<double>(n_points));
    const std::size_t n_fixed = share_of_surface(body.area(), body.volume(), n_points);
    Random random(seed);
    std::vector<Vector3> points = body.surface_points(n_fixed, random);
    const std::vector<Vector3> inner = body.inner_points(n_points - n_fixed, random);
    points.insert(points.end(), inner.begin(), inner.end());
    const auto contains = [&](const double *p) { return body.contains(p); };
    Series series = record_odt("man", points, n_fixed, contains, n_timestamps, progress);
    series.remark = "body: " + body.name();
    return series;
}

}  // namespace bench
