#include "qhull_flat.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace compat {

namespace {

using Vector = std::array<double, 3>;

Vector edge(const double *points, unsigned dimension, std::uint32_t from, std::uint32_t to) {
    Vector result{};
    for (unsigned axis = 0; axis < dimension; axis++)
        result[axis] = points[to * std::size_t{dimension} + axis] - points[from * std::size_t{dimension} + axis];
    return result;
}

Vector cross(const Vector &a, const Vector &b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector &a, const Vector &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The distance of corner i from the plane of the others.
double height(const Cells &cells, const double *points, std::size_t cell, unsigned i) {
    const unsigned n = cells.n_corners, dimension = n - 1;
    const std::uint32_t *row = cells.vertices + cell * n;
    const std::uint32_t base = row[(i + 1) % n];
    const Vector to_apex = edge(points, dimension, base, row[i]), first = edge(points, dimension, base, row[(i + 2) % n]);
    if (dimension == 2) return std::abs(cross(first, to_apex)[2]) / std::sqrt(dot(first, first));
    const Vector normal = cross(first, edge(points, dimension, base, row[(i + 3) % n]));
    return std::abs(dot(normal, to_apex)) / std::sqrt(dot(normal, normal));
}

} // namespace

double flatness_tolerance(unsigned dimension, const double *points, std::size_t n_points) {
    double greatest = 0;
    for (std::size_t i = 0; i < n_points * dimension; i++) greatest = std::max(greatest, std::abs(points[i]));
    // Of an inner product of unit vector and point on the paraboloid, whose coordinates qhull scales to that range.
    const double n = dimension + 1;
    const double rounding = std::numeric_limits<double>::epsilon() * greatest * (1.01 * n * std::sqrt(n) + 1);
    return (dimension == 2 ? 2 : 6) * rounding;
}

std::vector<bool> flat_cells(const Cells &cells, const double *points, double tolerance) {
    const unsigned n = cells.n_corners;
    std::vector<std::size_t> waiting;
    std::vector<bool> is_flat;
    const auto is_outside = [&](std::uint32_t cell) { return cell == no_cell || (!is_flat.empty() && is_flat[cell]); };
    const auto is_dropped = [&](std::size_t cell) {
        for (unsigned i = 0; i < n; i++)
            if (is_outside(cells.neighbours[cell * n + i]) && !(height(cells, points, cell, i) > tolerance)) return true;
        return false;
    };
    const auto drop = [&](std::size_t cell) {
        if (is_flat.empty()) is_flat.resize(cells.count);
        is_flat[cell] = true;
        for (unsigned i = 0; i < n; i++)
            if (const std::uint32_t next = cells.neighbours[cell * n + i]; !is_outside(next)) waiting.push_back(next);
    };
    for (std::size_t cell = 0; cell < cells.count; cell++) {
        const std::uint32_t *neighbours = cells.neighbours + cell * n;
        if (std::find(neighbours, neighbours + n, no_cell) != neighbours + n && is_dropped(cell)) drop(cell);
    }
    while (!waiting.empty()) {
        const std::size_t cell = waiting.back();
        waiting.pop_back();
        if (!is_flat[cell] && is_dropped(cell)) drop(cell);
    }
    return is_flat;
}

} // namespace compat
