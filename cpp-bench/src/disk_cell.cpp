// SPDX-License-Identifier: GPL-3.0-or-later
#include "disk_cell.hpp"

#include <cmath>
#include <cstddef>

namespace bench {
namespace {

double dot(const Point2 &a, const Point2 &b) { return a[0] * b[0] + a[1] * b[1]; }

double cross(const Point2 &a, const Point2 &b) { return a[0] * b[1] - a[1] * b[0]; }

Point2 between(const Point2 &a, const Point2 &b, double t) {
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

/// Area and first moments, added up.
struct Moments {
    double area = 0;
    double x = 0;
    double y = 0;

    /// The triangle of the origin, a and b, negative where it is clockwise.
    void add_triangle(const Point2 &a, const Point2 &b) {
        const double signed_area = cross(a, b) / 2;
        area += signed_area;
        x += signed_area * (a[0] + b[0]) / 3;
        y += signed_area * (a[1] + b[1]) / 3;
    }

    /// The sector of the disk from the direction of a to that of b, less than half a turn.
    void add_sector(const Point2 &a, const Point2 &b, double radius) {
        const double from = std::atan2(a[1], a[0]);
        const double to = from + std::atan2(cross(a, b), dot(a, b));
        const double cube = radius * radius * radius / 3;
        area += radius * radius * (to - from) / 2;
        x += cube * (std::sin(to) - std::sin(from));
        y += cube * (std::cos(from) - std::cos(to));
    }
};

/// Mass and first moments of a density, seen from a point inside.
class DensityMoments {
public:
    DensityMoments(const Point2 &site, const std::function<double(double, double)> &density)
        : site_(site), density_(density) {}

    double mass = 0;
    double x = 0;
    double y = 0;

    void add_triangle(const Point2 &a, const Point2 &b) {
        const Point2 tangent{b[0] - a[0], b[1] - a[1]};
        for (const Node &node : nodes) add_ray(between(a, b, node.at), tangent, node.weight);
    }

    void add_sector(const Point2 &a, const Point2 &b, double radius) {
        const double from = std::atan2(a[1], a[0]);
        const double angle = std::atan2(cross(a, b), dot(a, b));
        const int n_pieces = 1 + static_cast<int>(std::fabs(angle) / longest_piece);
        const double step = angle / n_pieces;
        for (int piece = 0; piece < n_pieces; ++piece)
            for (const Node &node : nodes) {
                const double at = from + (piece + node.at) * step;
                const Point2 direction{radius * std::cos(at), radius * std::sin(at)};
                add_ray(direction, {-direction[1] * step, direction[0] * step}, node.weight);
            }
    }

private:
    struct Node {
        double at;
        double weight;
    };
    static constexpr double longest_piece = 0.5;
    /// Gauss' rule with 6 points on [0, 1].
    static constexpr Node nodes[6] = {{0.033765242898423986, 0.085662246189585173},
                                      {0.169395306766867743, 0.180380786524069304},
                                      {0.380690406958401546, 0.233956967286345524},
                                      {0.619309593041598454, 0.233956967286345524},
                                      {0.830604693233132257, 0.180380786524069304},
                                      {0.966234757101576014, 0.085662246189585173}};

    /// The segment from the site to a point of the boundary, where that runs along `tangent`.
    void add_ray(const Point2 &end, const Point2 &tangent, double weight) {
        const double swept = cross({end[0] - site_[0], end[1] - site_[1]}, tangent) * weight;
        for (const Node &node : nodes) {
            const Point2 p = between(site_, end, node.at);
            const double part = swept * node.at * node.weight * density_(p[0], p[1]);
            mass += part;
            x += part * p[0];
            y += part * p[1];
        }
    }

    Point2 site_;
    const std::function<double(double, double)> &density_;
};

constexpr DensityMoments::Node DensityMoments::nodes[6];

template <typename Moments>
void add_edge(Moments &moments, const Point2 &a, const Point2 &b, double radius) {
    const Point2 direction{b[0] - a[0], b[1] - a[1]};
    const double length = dot(direction, direction);
    if (length == 0) return;
    // |a + t (b - a)| = radius
    const double middle = -dot(a, direction) / length;
    const double discriminant = middle * middle - (dot(a, a) - radius * radius) / length;
    if (discriminant <= 0) return moments.add_sector(a, b, radius);
    const double half = std::sqrt(discriminant);
    const double enter = middle - half;
    const double leave = middle + half;
    if (leave <= 0 || enter >= 1) return moments.add_sector(a, b, radius);

    const Point2 first = enter > 0 ? between(a, b, enter) : a;
    const Point2 last = leave < 1 ? between(a, b, leave) : b;
    if (enter > 0) moments.add_sector(a, first, radius);
    moments.add_triangle(first, last);
    if (leave < 1) moments.add_sector(last, b, radius);
}

}  // namespace

Polygon square(double half_width) {
    return {{-half_width, -half_width}, {half_width, -half_width}, {half_width, half_width}, {-half_width, half_width}};
}

void clip_to_bisector(Polygon &polygon, const Point2 &site, const Point2 &other) {
    const Point2 normal{other[0] - site[0], other[1] - site[1]};
    const double offset = (dot(other, other) - dot(site, site)) / 2;
    const auto excess = [&](const Point2 &p) { return dot(normal, p) - offset; };

    Polygon kept;
    kept.reserve(polygon.size() + 1);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 &a = polygon[i];
        const Point2 &b = polygon[(i + 1) % polygon.size()];
        const double at_a = excess(a);
        const double at_b = excess(b);
        if (at_a <= 0) kept.push_back(a);
        if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) kept.push_back(between(a, b, at_a / (at_a - at_b)));
    }
    polygon.swap(kept);
}

AreaAndCentroid intersect_disk(const Polygon &polygon, double radius) {
    Moments moments;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        add_edge(moments, polygon[i], polygon[(i + 1) % polygon.size()], radius);
    AreaAndCentroid result;
    result.area = moments.area;
    if (moments.area > 0) result.centroid = {moments.x / moments.area, moments.y / moments.area};
    return result;
}

AreaAndCentroid intersect_disk(const Polygon &polygon, double radius, const Point2 &site,
                               const std::function<double(double, double)> &density) {
    DensityMoments moments(site, density);
    for (std::size_t i = 0; i < polygon.size(); ++i)
        add_edge(moments, polygon[i], polygon[(i + 1) % polygon.size()], radius);
    AreaAndCentroid result;
    result.area = moments.mass;
    if (moments.mass > 0) result.centroid = {moments.x / moments.mass, moments.y / moments.mass};
    return result;
}

}  // namespace bench
