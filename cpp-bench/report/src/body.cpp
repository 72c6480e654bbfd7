// SPDX-License-Identifier: GPL-3.0-or-later
#include "body.hpp"

#include "random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace bench {
namespace {

constexpr std::size_t n_columns_per_axis = 128;
constexpr unsigned n_candidates = 10;

/// The numbers of a text without its comments.
std::istringstream numbers_of(const std::string &path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path + " cannot be opened");
    std::string line, text;
    std::getline(file, line);
    if (line.compare(0, 3, "OFF") != 0) throw std::runtime_error(path + " does not begin with OFF");
    while (std::getline(file, line)) text += line.substr(0, line.find('#')) + "\n";
    return std::istringstream(text);
}

double norm(const Vector3 &a) { return std::sqrt(dot(a, a)); }

std::size_t column_at(double at, double least, double greatest) {
    const double share = (at - least) / (greatest - least);
    const double column = std::floor(share * n_columns_per_axis);
    return static_cast<std::size_t>(std::min<double>(std::max(column, 0.0), n_columns_per_axis - 1));
}

}  // namespace

Body::Body(std::string name, std::vector<Vector3> corners, std::vector<Triangle> triangles)
    : name_(std::move(name)), corners_(std::move(corners)), triangles_(std::move(triangles)) {
    require_closed();
    sort_into_columns();
}

Body Body::load(const std::string &path) {
    std::istringstream numbers = numbers_of(path);
    std::size_t n_corners = 0, n_triangles = 0, n_edges = 0;
    numbers >> n_corners >> n_triangles >> n_edges;
    std::vector<Vector3> corners(n_corners);
    for (Vector3 &corner : corners) numbers >> corner[0] >> corner[1] >> corner[2];
    std::vector<Triangle> triangles(n_triangles);
    for (Triangle &triangle : triangles) {
        unsigned length = 0;
        numbers >> length >> triangle[0] >> triangle[1] >> triangle[2];
        if (length != 3) throw std::runtime_error(path + " has a face that is no triangle, or is cut short");
        for (const std::uint32_t corner : triangle)
            if (corner >= n_corners)
                throw std::runtime_error(path + " has a triangle with a corner that is none");
    }
    if (!numbers || triangles.empty()) throw std::runtime_error(path + " is cut short");
    const std::size_t slash = path.find_last_of('/');
    return Body(path.substr(slash == std::string::npos ? 0 : slash + 1), std::move(corners),
                std::move(triangles));
}

Body Body::generate() {
    // Radius by height, from the foot to the crown.
    const std::vector<std::pair<double, double>> profile = {
        {0.00, 0.10}, {0.03, 0.13}, {0.25, 0.08}, {0.45, 0.14}, {0.55, 0.16}, {0.65, 0.12}, {0.78, 0.17},
        {0.82, 0.10}, {0.84, 0.05}, {0.87, 0.05}, {0.90, 0.08}, {0.94, 0.09}, {0.98, 0.06}};
    constexpr std::uint32_t n_around = 48;
    std::vector<Vector3> corners;
    std::vector<Triangle> triangles;
    for (const auto &[height, radius] : profile)
        for (std::uint32_t i = 0; i < n_around; ++i) {
            const double angle = 2 * std::acos(-1.0) * i / n_around;
            corners.push_back({0.7 * radius * std::cos(angle), radius * std::sin(angle), height - 0.5});
        }
    const auto at = [&](std::size_t ring, std::uint32_t i) {
        return static_cast<std::uint32_t>(ring) * n_around + i % n_around;
    };
    for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring)
        for (std::uint32_t i = 0; i < n_around; ++i) {
            triangles.push_back({at(ring, i), at(ring, i + 1), at(ring + 1, i)});
            triangles.push_back({at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i)});
        }
    const auto cap = [&](std::size_t ring, double height, bool is_top) {
        corners.push_back({0, 0, height - 0.5});
        const auto pole = static_cast<std::uint32_t>(corners.size() - 1);
        for (std::uint32_t i = 0; i < n_around; ++i)
            triangles.push_back(is_top ? Triangle{at(ring, i), at(ring, i + 1), pole}
                                       : Triangle{at(ring, i + 1), at(ring, i), pole});
    };
    cap(0, 0, false);
    cap(profile.size() - 1, 1, true);
    return Body("a generated body", std::move(corners), std::move(triangles));
}

void Body::require_closed() const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Triangle &triangle : triangles_)
        for (int i = 0; i < 3; ++i) {
            ++edges[{triangle[i], triangle[(i + 1) % 3]}];
            --edges[{triangle[(i + 1) % 3], triangle[i]}];
        }
    for (const auto &[edge, balance] : edges)
        if (balance != 0)
            throw std::runtime_error(
                fmt::format("{} is not closed at the edge {}, {}", name_, edge.first, edge.second));
}

double Body::volume() const {
    double sum = 0;
    for (const Triangle &t : triangles_) sum += dot(corner(t, 0), cross(corner(t, 1), corner(t, 2)));
    return std::fabs(sum) / 6;
}

double Body::area() const {
    double sum = 0;
    for (const Triangle &t : triangles_)
        sum += norm(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0))) / 2;
    return sum;
}

void Body::scale_to_volume(double wanted) {
    const double scale = std::cbrt(wanted / volume());
    for (Vector3 &corner : corners_) corner = scale * corner;
    sort_into_columns();
}

void Body::sort_into_columns() {
    least_ = greatest_ = corners_.front();
    for (const Vector3 &corner : corners_)
        for (unsigned axis = 0; axis < 3; ++axis) {
            least_[axis] = std::min(least_[axis], corner[axis]);
            greatest_[axis] = std::max(greatest_[axis], corner[axis]);
        }
    columns_.assign(n_columns_per_axis * n_columns_per_axis, {});
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        std::size_t first[2], last[2];
        for (unsigned axis = 1; axis < 3; ++axis) {
            const auto [low, high] =
                std::minmax({corner(triangles_[t], 0)[axis], corner(triangles_[t], 1)[axis],
                             corner(triangles_[t], 2)[axis]});
            first[axis - 1] = column_at(low, least_[axis], greatest_[axis]);
            last[axis - 1] = column_at(high, least_[axis], greatest_[axis]);
        }
        for (std::size_t y = first[0]; y <= last[0]; ++y)
            for (std::size_t z = first[1]; z <= last[1]; ++z)
                columns_[y * n_columns_per_axis + z].push_back(t);
    }
}

bool Body::contains(const double *place) const {
    for (unsigned axis = 0; axis < 3; ++axis)
        if (!(place[axis] > least_[axis] && place[axis] < greatest_[axis])) return false;
    const double y = place[1], z = place[2];
    const std::size_t column =
        column_at(y, least_[1], greatest_[1]) * n_columns_per_axis + column_at(z, least_[2], greatest_[2]);
    bool is_inside = false;
    for (const std::uint32_t t : columns_[column]) {
        // Edges with their lower end (in z, not counting the upper) cross the line of the ray to one side or
        // the other; a triangle is crossed if that holds for one edge each.
        double x_at[3], y_at[3];
        int n_crossings = 0;
        for (int i = 0; i < 3; ++i) {
            Vector3 a = corner(triangles_[t], i), b = corner(triangles_[t], (i + 1) % 3);
            // The same arithmetic from either triangle at the edge.
            if (std::make_pair(b[2], b[1]) < std::make_pair(a[2], a[1])) std::swap(a, b);
            if (!(a[2] <= z && z < b[2])) continue;
            const double share = (z - a[2]) / (b[2] - a[2]);
            x_at[n_crossings] = a[0] + share * (b[0] - a[0]);
            y_at[n_crossings++] = a[1] + share * (b[1] - a[1]);
        }
        if (n_crossings != 2) continue;
        if ((y_at[0] <= y) == (y_at[1] <= y)) continue;
        const double share = (y - y_at[0]) / (y_at[1] - y_at[0]);
        if (x_at[0] + share * (x_at[1] - x_at[0]) > place[0]) is_inside = !is_inside;
    }
    return is_inside;
}

std::vector<Vector3> Body::surface_points(std::size_t count, Random &random) const {
    std::vector<double> areas_up_to;
    double sum = 0;
    for (const Triangle &t : triangles_)
        areas_up_to.push_back(sum += norm(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0))));
    const auto draw = [&] {
        const auto found = std::upper_bound(areas_up_to.begin(), areas_up_to.end(), random.unit() * sum);
        const Triangle &t =
            triangles_[std::min<std::size_t>(found - areas_up_to.begin(), triangles_.size() - 1)];
        double u = random.unit(), v = random.unit();
        if (u + v > 1) u = 1 - u, v = 1 - v;
        return corner(t, 0) + u * (corner(t, 1) - corner(t, 0)) + v * (corner(t, 2) - corner(t, 0));
    };
    std::vector<Vector3> points;
    while (points.size() < count) {
        Vector3 best{};
        double farthest = -1;
        for (unsigned candidate = 0; candidate < n_candidates; ++candidate) {
            const Vector3 point = draw();
            double nearest = HUGE_VAL;
            for (const Vector3 &other : points)
                nearest = std::min(nearest, dot(point - other, point - other));
            if (nearest > farthest) {
                farthest = nearest;
                best = point;
            }
        }
        points.push_back(best);
    }
    return points;
}

std::vector<Vector3> Body::inner_points(std::size_t count, Random &random) const {
    std::vector<Vector3> points;
    while (points.size() < count) {
        Vector3 point;
        for (unsigned axis = 0; axis < 3; ++axis)
            point[axis] = least_[axis] + random.unit() * (greatest_[axis] - least_[axis]);
        if (contains(point.data())) points.push_back(point);
    }
    return points;
}

}  // namespace bench
