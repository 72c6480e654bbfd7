// Power cells of prescribed areas in the unit square: weights are looked for, and nothing moves. The weights are the maximum of a
// concave function, whose gradient is what areas lack and whose second derivatives are the derivatives of areas by weights.
// Newton's method finds them, with half a step where a cell would become too small: Kitagawa, Merigot and Thibert,
// doi:10.4171/JEMS/889.
#pragma once

#include "svg.hpp"

#include <deldrift.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace areas {

constexpr std::array<double, 2> low{0, 0}, high{1, 1};

using Numbers = std::vector<double>;
using Place = std::array<double, 2>;

inline double dot(const Numbers &a, const Numbers &b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); i++) sum += a[i] * b[i];
    return sum;
}

// Solves for the step of weights by conjugate gradients. The rows of the matrix add up to nothing, as a weight more for all changes
// no cell, and so do the right sides.
inline Numbers step_for(const deldrift::VoronoiWeightDerivatives &cells, const std::vector<std::uint32_t> &edges,
                 const Numbers &missing) {
    Numbers step(missing.size()), rest = missing, image(missing.size()), diagonal(missing.size());
    for (std::size_t i = 0; i < edges.size(); i++) diagonal[edges[i]] -= cells.derivatives[i / 2];
    const auto scaled = [&diagonal](const Numbers &of) {
        Numbers result(of);
        for (std::size_t v = 0; v < of.size(); v++) result[v] = diagonal[v] > 0 ? of[v] / diagonal[v] : 0;
        return result;
    };
    Numbers z = scaled(rest), along = z;
    double square = dot(rest, z);
    const double enough = 1e-16 * square;
    for (int turn = 0; turn < 10 * static_cast<int>(rest.size()) && square > enough; turn++) {
        std::fill(image.begin(), image.end(), 0);
        for (std::size_t i = 0; i < edges.size(); i += 2) {
            const std::uint32_t a = edges[i], b = edges[i + 1];
            const double flow = cells.derivatives[i / 2] * (along[b] - along[a]);
            image[a] += flow;
            image[b] -= flow;
        }
        const double length = square / dot(along, image);
        for (std::size_t v = 0; v < rest.size(); v++) {
            step[v] += length * along[v];
            rest[v] -= length * image[v];
        }
        z = scaled(rest);
        const double next = dot(rest, z);
        for (std::size_t v = 0; v < rest.size(); v++) along[v] = z[v] + next / square * along[v];
        square = next;
    }
    return step;
}

// The power cell of a vertex: the square, cut by the line of equal powers to each neighbour.
inline std::vector<Place> cell_of(std::uint32_t v, const std::vector<Place> &points, const Numbers &weights,
                           const std::vector<std::vector<std::uint32_t>> &neighbours) {
    std::vector<Place> cell{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (const std::uint32_t w : neighbours[v]) {
        const auto power = [&](const Place &at, std::uint32_t of) {
            const double x = at[0] - points[of][0], y = at[1] - points[of][1];
            return x * x + y * y - weights[of];
        };
        std::vector<Place> rest;
        for (std::size_t i = 0; i < cell.size(); i++) {
            const Place &a = cell[i], &b = cell[(i + 1) % cell.size()];
            const double before = power(a, w) - power(a, v), after = power(b, w) - power(b, v);
            if (before >= 0) rest.push_back(a);
            if ((before >= 0) != (after >= 0)) {
                const double at = before / (before - after);
                rest.push_back({a[0] + at * (b[0] - a[0]), a[1] + at * (b[1] - a[1])});
            }
        }
        cell = rest;
    }
    return cell;
}

// Fills the cells of all vertices by values from 0 to 1.
inline void draw(Picture &picture, const std::string &caption, const std::vector<Place> &points, const Numbers &weights,
                 const Numbers &values, const std::vector<std::uint32_t> &edges) {
    picture.panel(caption);
    std::vector<std::vector<std::uint32_t>> neighbours(points.size());
    for (std::size_t i = 0; i < edges.size(); i++) neighbours[edges[i]].push_back(edges[i ^ 1]);
    for (std::uint32_t v = 0; v < points.size(); v++) {
        const std::vector<Place> cell = cell_of(v, points, weights, neighbours);
        std::vector<const double *> corners;
        for (const Place &corner : cell) corners.push_back(corner.data());
        picture.polygon(values[v], corners);
    }
}

// What Newton's method has done.
struct Search {
    deldrift::VoronoiWeightDerivatives cells;
    double error = 1;  // of an area, in mean areas
    int steps = 0, halves = 0;
};

// Commits weights with which cells have the wanted areas, and has them in `weights`, from which it begins: with these no vertex
// may be hidden.
inline Search find_weights(deldrift::Triangulation &t, Numbers &weights, const Numbers &wanted, double enough) {
    Search search;
    search.cells = t.voronoi_weight_derivatives(low, high);
    std::vector<std::uint32_t> edges = t.edges();
    // No cell may become smaller than this: then Newton's method ends.
    double least = 1;
    for (std::size_t v = 0; v < wanted.size(); v++) least = std::min({least, search.cells.volumes[v] / 2, wanted[v] / 2});
    for (; search.steps < 60; search.steps++) {
        Numbers missing(wanted.size());
        search.error = 0;
        for (std::size_t v = 0; v < wanted.size(); v++) {
            missing[v] = wanted[v] - search.cells.volumes[v];
            search.error = std::max(search.error, std::abs(missing[v]) * static_cast<double>(wanted.size()));
        }
        if (search.error < enough) break;
        const Numbers step = step_for(search.cells, edges, missing);
        for (double length = 1;; length /= 2, search.halves++) {
            Numbers next(weights);
            for (std::size_t v = 0; v < wanted.size(); v++) next[v] += length * step[v];
            // A vertex that is hidden has no cell: that is known before any cell is read.
            if (t.commit_weighted({}, next).hidden_by_weight > 0) continue;
            search.cells = t.voronoi_weight_derivatives(low, high);
            if (*std::min_element(search.cells.volumes.begin(), search.cells.volumes.end()) < least) continue;
            weights = next;
            break;
        }
        edges = t.edges();
    }
    return search;
}

}  // namespace areas
