#include "qhull_flat.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace compat {

namespace {

using Vector = std::array<double, 3>;

double dot(const Vector &a, const Vector &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The thickness of a cell: the distance of one of its corners from the line or plane of the others, which are those
// farthest apart: the ends of the longest edge, in space then the corner farthest from that. Off by no more than a
// rounding of the longest edge, however near to a line the corners are.
double thickness(const Cells &cells, const double *points, std::size_t cell) {
    const unsigned n = cells.n_corners, dimension = n - 1;
    const std::uint32_t *row = cells.vertices + cell * n;
    std::array<Vector, 4> from_base{};
    double longest = -1;
    for (unsigned base = 0; base < n; base++) {
        std::array<Vector, 4> edges{};
        double greatest = 0;
        for (unsigned i = 0; i < n; i++) {
            for (unsigned axis = 0; axis < dimension; axis++)
                edges[i][axis] = points[row[i] * std::size_t{dimension} + axis] -
                                 points[row[base] * std::size_t{dimension} + axis];
            greatest = std::max(greatest, dot(edges[i], edges[i]));
        }
        if (greatest <= longest) continue;
        longest = greatest;
        from_base = edges;
    }
    // Each step takes the longest of the vectors, and leaves of the others what is orthogonal to it.
    double left = 0;
    for (unsigned step = 0; step < dimension; step++) {
        const auto is_shorter = [](const Vector &a, const Vector &b) { return dot(a, a) < dot(b, b); };
        const Vector taken = *std::max_element(from_base.begin(), from_base.end(), is_shorter);
        left = std::sqrt(dot(taken, taken));
        if (left == 0) return 0;
        for (Vector &each : from_base) {
            const double part = dot(each, taken) / left / left;
            for (unsigned axis = 0; axis < dimension; axis++) each[axis] -= part * taken[axis];
        }
    }
    return left;
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
    const auto drop = [&](std::size_t cell) {
        if (is_flat.empty()) is_flat.resize(cells.count);
        is_flat[cell] = true;
        for (unsigned i = 0; i < n; i++)
            if (const std::uint32_t next = cells.neighbours[cell * n + i]; !is_outside(next)) waiting.push_back(next);
    };
    for (std::size_t cell = 0; cell < cells.count; cell++) {
        const std::uint32_t *neighbours = cells.neighbours + cell * n;
        const bool is_at_hull = std::find(neighbours, neighbours + n, no_cell) != neighbours + n;
        if (is_at_hull && thickness(cells, points, cell) <= tolerance) drop(cell);
    }
    while (!waiting.empty()) {
        const std::size_t cell = waiting.back();
        waiting.pop_back();
        if (!is_flat[cell] && thickness(cells, points, cell) <= tolerance) drop(cell);
    }
    return is_flat;
}

} // namespace compat
