// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bench {
namespace {

using Ring = std::vector<std::array<double, 2>>;

constexpr double tau = 6.283185307179586;
/// Where the stirrer's motion begins to be less than the hole's, and where it ends.
constexpr double inner = 0.55, outer = 0.95;

class Pencil {
public:
    explicit Pencil(std::string name) { outline_.name = std::move(name); }

    Pencil &ring(const Ring &ring) {
        const std::uint32_t first = add(ring), n = static_cast<std::uint32_t>(ring.size());
        for (std::uint32_t k = 0; k < n; ++k) outline_.segments.push_back({first + k, first + (k + 1) % n});
        outline_.n_loops = outline_.segments.size();
        return *this;
    }
    Pencil &hole(const Ring &boundary, std::array<double, 2> place) {
        outline_.holes.push_back(place);
        return ring(boundary);
    }
    Pencil &chain(const Ring &chain) {
        const std::uint32_t first = add(chain), n = static_cast<std::uint32_t>(chain.size());
        for (std::uint32_t k = 1; k < n; ++k) outline_.segments.push_back({first + k - 1, first + k});
        return *this;
    }
    Outline done() { return std::move(outline_); }

private:
    std::uint32_t add(const Ring &places) {
        const auto first = static_cast<std::uint32_t>(outline_.n_points());
        for (const auto &place : places) outline_.points.insert(outline_.points.end(), place.begin(), place.end());
        return first;
    }

    Outline outline_;
};

Ring ellipse(double a, double b, int n) {
    Ring ring;
    for (int k = 0; k < n; ++k) ring.push_back({a * std::cos(tau * k / n), b * std::sin(tau * k / n)});
    return ring;
}

Ring rectangle(std::array<double, 2> low, std::array<double, 2> high) {
    return {low, {high[0], low[1]}, high, {low[0], high[1]}};
}

}  // namespace

std::vector<Outline> outlines() {
    const Ring square = rectangle({0, 0}, {1, 1});
    const Ring letter = {{0, 0},   {0.2, 0}, {0.5, 0.8}, {0.52, 0.8}, {0.8, 0}, {1, 0}, {0.55, 1}, {0.45, 1}};
    return {
        Pencil("square").ring(square).done(),
        Pencil("hole").ring(square).hole(rectangle({0.4, 0.4}, {0.6, 0.6}), {0.5, 0.5}).done(),
        Pencil("letter").ring(letter).chain({{0.45, 0.9}, {0.55, 0.95}, {0.55, 0.9}}).done(),
        Pencil("slit").ring(square).chain({{0.3, 0.5}, {0.7, 0.5}}).done(),
        Pencil("L").ring({{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}}).done(),
        Pencil("ring").ring(ellipse(1, 1, 64)).hole(ellipse(0.4, 0.4, 32), {0, 0}).done(),
    };
}

Outline stirrer() {
    return Pencil("stirrer").ring(rectangle({-1, -1}, {1, 1})).hole(ellipse(0.5, 0.15, 40), {0, 0}).done();
}

void stir(double angle, std::vector<double> &points) {
    for (std::size_t at = 0; at < points.size(); at += 2) {
        const double x = points[at], y = points[at + 1];
        const double part = angle * std::clamp((outer - std::hypot(x, y)) / (outer - inner), 0.0, 1.0);
        if (part == 0) continue;
        points[at] = std::cos(part) * x - std::sin(part) * y;
        points[at + 1] = std::sin(part) * x + std::cos(part) * y;
    }
}

double area_of(const Outline &outline) {
    // By the first loop less the others, whatever way they go around.
    double area = 0, loop = 0;
    bool is_first = true;
    for (std::size_t k = 0; k < outline.n_loops; ++k) {
        const auto [a, b] = outline.segments[k];
        const double *p = &outline.points[2 * a], *q = &outline.points[2 * b];
        loop += (p[0] * q[1] - q[0] * p[1]) / 2;
        if (b > a) continue;
        area += is_first ? std::fabs(loop) : -std::fabs(loop);
        is_first = false;
        loop = 0;
    }
    return area;
}

}  // namespace bench
