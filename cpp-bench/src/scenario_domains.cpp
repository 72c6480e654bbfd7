// SPDX-License-Identifier: GPL-3.0-or-later
// Domains: a beam with a hole that turns, a circle that sweeps across a rectangle, a valve, a coast, and segments
// anywhere.
#include "domains.hpp"
#include "random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace bench {
namespace {

constexpr double pi = 3.14159265358979323846;
/// Boundaries are off by so much, so that no four vertices are on a circle.
constexpr double jitter = 1e-3;

using Place = std::array<double, 2>;

double squared(double x) { return x * x; }

/// Squared distance of p from the segment from a to b.
double squared_distance(const Place &p, const Place &a, const Place &b) {
    const double x = b[0] - a[0], y = b[1] - a[1];
    const double along = ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / (x * x + y * y);
    const double t = std::clamp(along, 0.0, 1.0);
    return squared(a[0] + t * x - p[0]) + squared(a[1] + t * y - p[1]);
}

/// On which side of the line from a to b.
double side(const Place &a, const Place &b, const Place &p) {
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

bool do_cross(const Place &a, const Place &b, const Place &c, const Place &d) {
    return (side(a, b, c) > 0) != (side(a, b, d) > 0) && (side(c, d, a) > 0) != (side(c, d, b) > 0);
}

/// A domain as it is drawn. Segments are found again by the squares, of side 1, that they come near.
class Sketch {
public:
    Sketch(std::string name, std::uint64_t seed) : random_(seed) { domain_.name = std::move(name); }

    /// A chain through these places, about one spacing apart.
    void add_chain(const std::vector<Place> &places, bool is_closed) {
        const auto first = static_cast<std::uint32_t>(domain_.n_points());
        const auto n = static_cast<std::uint32_t>(places.size());
        for (const Place &p : places) add_vertex({p[0] + random_.symmetric(jitter), p[1] + random_.symmetric(jitter)});
        for (std::uint32_t i = 0; i + 1 < n; ++i) add_segment(first + i, first + i + 1);
        if (is_closed) add_segment(first + n - 1, first);
    }
    void add_rectangle(double width, double height) {
        std::vector<Place> places;
        const Place corners[] = {{0, 0}, {width, 0}, {width, height}, {0, height}, {0, 0}};
        for (int side = 0; side < 4; ++side) {
            const Place &a = corners[side], &b = corners[side + 1];
            const auto n = static_cast<int>(std::ceil(std::hypot(b[0] - a[0], b[1] - a[1])));
            for (int i = 0; i < n; ++i) places.push_back({a[0] + (b[0] - a[0]) * i / n, a[1] + (b[1] - a[1]) * i / n});
        }
        add_chain(places, true);
    }
    void add_ellipse(const Place &centre, double a, double b) {
        const auto n = static_cast<int>(std::ceil(2 * pi * std::sqrt((a * a + b * b) / 2)));
        std::vector<Place> places;
        for (int i = 0; i < n; ++i)
            places.push_back({centre[0] + a * std::cos(2 * pi * i / n), centre[1] + b * std::sin(2 * pi * i / n)});
        add_chain(places, true);
    }
    /// A segment that crosses none and keeps clear of all; whether there was room for it.
    bool add_stick(const Place &a, const Place &b) {
        bool is_free = is_clear(a) && is_clear(b);
        visit_near(a, b, [&](const Place &c, const Place &d) {
            is_free = is_free && !do_cross(a, b, c, d) &&
                      std::min(squared_distance(c, a, b), squared_distance(d, a, b)) > squared(domain_clearance);
        });
        if (!is_free) return false;
        const auto first = static_cast<std::uint32_t>(domain_.n_points());
        add_vertex(a);
        add_vertex(b);
        add_segment(first, first + 1);
        return true;
    }
    /// Random vertices in a box that are wanted, until there are so many vertices.
    template <typename IsWanted>
    void fill(double width, double height, std::size_t n_points, IsWanted is_wanted) {
        while (domain_.n_points() < n_points) {
            const Place p = {width * random_.unit(), height * random_.unit()};
            if (is_wanted(p) && is_clear(p)) add_vertex(p);
        }
    }

    Random &random() { return random_; }
    Domain &domain() { return domain_; }

private:
    using Square = std::pair<int, int>;

    void add_vertex(const Place &p) { domain_.positions.insert(domain_.positions.end(), p.begin(), p.end()); }
    Place place(std::uint32_t vertex) const {
        return {domain_.positions[std::size_t{vertex} * 2], domain_.positions[std::size_t{vertex} * 2 + 1]};
    }
    void add_segment(std::uint32_t a, std::uint32_t b) {
        const auto index = domain_.segments.size();
        domain_.segments.push_back({a, b});
        const Place p = place(a), q = place(b);
        for (int x = square_of(std::min(p[0], q[0])); x <= square_of(std::max(p[0], q[0])); ++x)
            for (int y = square_of(std::min(p[1], q[1])); y <= square_of(std::max(p[1], q[1])); ++y)
                in_square_[{x, y}].push_back(index);
    }
    static int square_of(double x) { return static_cast<int>(std::floor(x)); }

    template <typename Visit>
    void visit_near(const Place &p, const Place &q, Visit visit) const {
        for (int x = square_of(std::min(p[0], q[0])) - 1; x <= square_of(std::max(p[0], q[0])) + 1; ++x)
            for (int y = square_of(std::min(p[1], q[1])) - 1; y <= square_of(std::max(p[1], q[1])) + 1; ++y) {
                const auto found = in_square_.find({x, y});
                if (found == in_square_.end()) continue;
                for (const std::size_t i : found->second)
                    visit(place(domain_.segments[i][0]), place(domain_.segments[i][1]));
            }
    }
    bool is_clear(const Place &p) const {
        bool is_clear = true;
        visit_near(p, p, [&](const Place &a, const Place &b) {
            is_clear = is_clear && squared_distance(p, a, b) > squared(domain_clearance);
        });
        return is_clear;
    }

    Random random_;
    Domain domain_;
    std::map<Square, std::vector<std::size_t>> in_square_;
};

bool is_in_ellipse(const Place &p, const Place &centre, double a, double b) {
    return squared((p[0] - centre[0]) / a) + squared((p[1] - centre[1]) / b) < 1;
}

/// All turn about the centre, as a whole up to `inner`, less and less up to `outer`, beyond which nothing moves.
void turn(const std::vector<double> &from, const Place &centre, double inner, double outer, double angle,
          std::vector<double> &positions) {
    positions = from;
    for (std::size_t at = 0; at < from.size(); at += 2) {
        const double x = from[at] - centre[0], y = from[at + 1] - centre[1];
        const double share = std::clamp((outer - std::hypot(x, y)) / (outer - inner), 0.0, 1.0);
        if (share == 0) continue;
        const double c = std::cos(angle * share), s = std::sin(angle * share);
        positions[at] = centre[0] + c * x - s * y;
        positions[at + 1] = centre[1] + s * x + c * y;
    }
}

/// A beam with an elliptic hole, whose boundary turns once, with what is close to it.
Domain beam(std::size_t n_points, std::uint64_t seed) {
    Sketch sketch("beam", seed);
    const double unit = std::sqrt(static_cast<double>(n_points)), width = 2 * unit, height = unit / 2;
    const Place centre = {unit, height / 2};
    sketch.add_rectangle(width, height);
    sketch.add_ellipse(centre, 0.15 * unit, 0.1 * unit);
    sketch.fill(width, height, n_points,
                [&](const Place &p) { return !is_in_ellipse(p, centre, 0.15 * unit, 0.1 * unit); });
    Domain domain = std::move(sketch.domain());
    domain.move = [from = domain.positions, centre, unit](std::size_t timestamp, std::vector<double> &positions) {
        const double angle = 2 * pi * static_cast<double>(timestamp) / domain_timestamps;
        turn(from, centre, 0.16 * unit, 0.24 * unit, angle, positions);
    };
    return domain;
}

/// A circle that goes from one end of a rectangle to the other, across vertices that stay where they are.
Domain sweep(std::size_t n_points, std::uint64_t seed) {
    Sketch sketch("sweep", seed);
    const double unit = std::sqrt(static_cast<double>(n_points)), width = 2 * unit, height = unit / 2;
    sketch.add_ellipse({0.25 * unit, height / 2}, 0.1 * unit, 0.1 * unit);
    const std::size_t n_on_circle = sketch.domain().n_points();
    sketch.add_rectangle(width, height);
    sketch.fill(width, height, n_points, [](const Place &) { return true; });
    Domain domain = std::move(sketch.domain());
    domain.move = [from = domain.positions, n_on_circle, unit](std::size_t timestamp, std::vector<double> &positions) {
        positions = from;
        for (std::size_t i = 0; i < n_on_circle; ++i)
            positions[2 * i] += 1.5 * unit * static_cast<double>(timestamp) / domain_timestamps;
    };
    return domain;
}

/// A plate in a channel that turns by 80 degrees and back: an open chain, with the same cells on both sides.
Domain valve(std::size_t n_points, std::uint64_t seed) {
    Sketch sketch("valve", seed);
    const double unit = std::sqrt(static_cast<double>(n_points)), width = 2 * unit, height = unit / 2;
    const Place centre = {unit, height / 2};
    sketch.add_rectangle(width, height);
    std::vector<Place> plate;
    const int half = static_cast<int>(0.2 * unit);
    for (int i = -half; i <= half; ++i) plate.push_back({centre[0] + i, centre[1]});
    sketch.add_chain(plate, false);
    sketch.fill(width, height, n_points, [](const Place &) { return true; });
    Domain domain = std::move(sketch.domain());
    domain.move = [from = domain.positions, centre, unit](std::size_t timestamp, std::vector<double> &positions) {
        const double phase = 2 * pi * static_cast<double>(timestamp) / domain_timestamps;
        turn(from, centre, 0.205 * unit, 0.245 * unit, 80 * pi / 180 * (1 - std::cos(phase)) / 2, positions);
    };
    return domain;
}

/// The radii of a coast line at equal angles, by displacement of midpoints.
std::vector<double> radii(double radius, std::size_t n_levels, Random &random) {
    std::vector<double> radii(4, radius);
    double most = 0.4 * radius;
    for (std::size_t level = 0; level < n_levels; ++level, most /= 1.9) {
        std::vector<double> finer;
        for (std::size_t i = 0; i < radii.size(); ++i) {
            finer.push_back(radii[i]);
            finer.push_back((radii[i] + radii[(i + 1) % radii.size()]) / 2 + random.symmetric(most));
        }
        radii = finer;
    }
    return radii;
}

/// A coast line in the sea, with vertices on both sides: all drift, and are sheared to and fro on the way.
Domain coast(std::size_t n_points, std::uint64_t seed) {
    Sketch sketch("coast", seed);
    const double side = std::sqrt(static_cast<double>(n_points));
    const auto n_levels = static_cast<std::size_t>(std::round(std::log2(0.8 * side)));
    const std::vector<double> radius = radii(0.3 * side, n_levels, sketch.random());
    std::vector<Place> places;
    for (std::size_t i = 0; i < radius.size(); ++i) {
        const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(radius.size());
        places.push_back({side / 2 + radius[i] * std::cos(angle), side / 2 + radius[i] * std::sin(angle)});
    }
    sketch.add_chain(places, true);
    sketch.fill(side, side, n_points, [](const Place &) { return true; });
    Domain domain = std::move(sketch.domain());
    domain.move = [from = domain.positions, side](std::size_t timestamp, std::vector<double> &positions) {
        const double share = static_cast<double>(timestamp) / domain_timestamps;
        positions.resize(from.size());
        for (std::size_t at = 0; at < from.size(); at += 2) {
            const double x = from[at] + 0.1 * side * share + 0.01 * side * share * std::sin(2 * pi * from[at + 1] / side);
            positions[at] = x;
            positions[at + 1] = from[at + 1] + 0.01 * side * share * std::sin(2 * pi * x / side);
        }
    };
    return domain;
}

/// A tenth as many short segments as vertices, in a square, in random directions. Every vertex goes 0.03 spacings to
/// and fro, each in a direction of its own.
Domain sticks(std::size_t n_points, std::uint64_t seed) {
    Sketch sketch("sticks", seed);
    const double side = std::sqrt(static_cast<double>(n_points));
    Random &random = sketch.random();
    while (sketch.domain().segments.size() < n_points / 10) {
        const Place a = {side * random.unit(), side * random.unit()};
        const double length = 1 + 2 * random.unit(), angle = 2 * pi * random.unit();
        sketch.add_stick(a, {a[0] + length * std::cos(angle), a[1] + length * std::sin(angle)});
    }
    sketch.fill(side, side, n_points, [](const Place &) { return true; });
    Domain domain = std::move(sketch.domain());
    std::vector<double> ways(domain.positions.size());
    for (std::size_t at = 0; at < ways.size(); at += 2) random.in_ball(2, 0.03, &ways[at]);
    domain.move = [from = domain.positions, ways](std::size_t timestamp, std::vector<double> &positions) {
        const double share = std::sin(2 * pi * static_cast<double>(timestamp) / domain_timestamps);
        positions.resize(from.size());
        for (std::size_t at = 0; at < from.size(); ++at) positions[at] = from[at] + share * ways[at];
    };
    return domain;
}

constexpr struct {
    const char *name;
    Domain (*make)(std::size_t, std::uint64_t);
} makers[] = {{"beam", beam}, {"sweep", sweep}, {"valve", valve}, {"coast", coast}, {"sticks", sticks}};

}  // namespace

const std::vector<std::string> &domain_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> names;
        for (const auto &maker : makers) names.push_back(maker.name);
        return names;
    }();
    return names;
}

Domain make_domain(const std::string &name, std::size_t n_points, std::uint64_t seed) {
    for (const auto &maker : makers)
        if (maker.name == name) return maker.make(n_points, seed);
    throw std::runtime_error(fmt::format("there is no domain {}", name));
}

}  // namespace bench
