// Semi-discrete optimal transport: weights with which the power cells of given points in a square have prescribed areas. Of all ways
// to divide the square into pieces of these areas, one for each point, power cells have the least mean square of the distance to it.
//
// The weights are the maximum of a concave function, whose gradient is what areas lack and whose second derivatives are the
// derivatives of areas by weights. Newton's method finds them, with half a step where a cell would become too small: Kitagawa,
// Merigot and Thibert, doi:10.4171/JEMS/889. Nothing moves but weights, and the triangulation follows them.
//
//   transport [points [picture.svg]]
#include "svg.hpp"

#include <deldrift.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr std::array<double, 2> low{0, 0}, high{1, 1};

using Numbers = std::vector<double>;
using Place = std::array<double, 2>;

// A square of points that lie closer where they are further to the left.
std::vector<Place> uneven_points(int count) {
    std::vector<Place> points;
    std::mt19937 random(1);
    const auto next = [&random] { return static_cast<double>(random()) / 4294967296.0; };
    for (int k = 0; k < count; k++) {
        const double x = next();
        points.push_back({0.02 + 0.96 * x * x, 0.02 + 0.96 * next()});
    }
    return points;
}

// Areas that are to be: large ones within a ring.
Numbers wanted_areas(const std::vector<Place> &points) {
    Numbers areas;
    double sum = 0;
    for (const auto &[x, y] : points) {
        areas.push_back(std::abs(std::hypot(x - 0.5, y - 0.5) - 0.3) < 0.1 ? 4 : 1);
        sum += areas.back();
    }
    for (double &area : areas) area /= sum;
    return areas;
}

double dot(const Numbers &a, const Numbers &b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); i++) sum += a[i] * b[i];
    return sum;
}

// Solves for the step of weights by conjugate gradients. The rows of the matrix add up to nothing, as a weight more for all changes
// no cell, and so do the right sides.
Numbers step_for(const deldrift::VoronoiWeightDerivatives &cells, const std::vector<std::uint32_t> &edges,
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
std::vector<Place> cell_of(std::uint32_t v, const std::vector<Place> &points, const Numbers &weights,
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

void draw(Picture &picture, const std::vector<Place> &points, const Numbers &weights, const Numbers &wanted,
          const std::vector<std::uint32_t> &edges, const std::string &caption) {
    picture.panel(caption);
    std::vector<std::vector<std::uint32_t>> neighbours(points.size());
    for (std::size_t i = 0; i < edges.size(); i++) neighbours[edges[i]].push_back(edges[i ^ 1]);
    const double most = *std::max_element(wanted.begin(), wanted.end());
    for (std::uint32_t v = 0; v < points.size(); v++) {
        const std::vector<Place> cell = cell_of(v, points, weights, neighbours);
        std::vector<const double *> corners;
        for (const Place &corner : cell) corners.push_back(corner.data());
        picture.polygon(0.8 * wanted[v] / most, corners);
    }
}

}  // namespace

int main(int n_arguments, char **arguments) {
    const int count = n_arguments > 1 ? std::atoi(arguments[1]) : 300;
    const std::vector<Place> points = uneven_points(count);
    const Numbers wanted = wanted_areas(points);
    Numbers weights(points.size());
    deldrift::Triangulation t(2, points, deldrift::Weights{weights});
    auto cells = t.voronoi_weight_derivatives(low, high);
    auto edges = t.edges();
    Picture picture({0, 0}, {1, 1}, 380, 2, "a small area is wanted", "a large one");
    draw(picture, points, weights, wanted, edges, "equal weights: Voronoi cells");

    // No cell may become smaller than this: then Newton's method ends.
    double least = 1;
    for (std::size_t v = 0; v < points.size(); v++) least = std::min({least, cells.volumes[v] / 2, wanted[v] / 2});
    double error = 1;
    int steps = 0, halves = 0;
    for (; steps < 60; steps++) {
        Numbers missing(points.size());
        error = 0;
        for (std::size_t v = 0; v < points.size(); v++) {
            missing[v] = wanted[v] - cells.volumes[v];
            error = std::max(error, std::abs(missing[v]) * static_cast<double>(points.size()));
        }
        if (error < 1e-6) break;
        const Numbers step = step_for(cells, edges, missing);
        for (double length = 1;; length /= 2, halves++) {
            Numbers next(weights);
            for (std::size_t v = 0; v < points.size(); v++) next[v] += length * step[v];
            // A vertex that is hidden has no cell: that is known before any cell is read.
            if (t.commit_weighted({}, next).hidden_by_weight > 0) continue;
            cells = t.voronoi_weight_derivatives(low, high);
            if (*std::min_element(cells.volumes.begin(), cells.volumes.end()) < least) continue;
            weights = next;
            break;
        }
        edges = t.edges();
    }
    draw(picture, points, weights, wanted, edges, "weights for which areas are as they are wanted");
    const double sum = [&cells] {
        double all = 0;
        for (const double area : cells.volumes) all += area;
        return all;
    }();
    std::printf("%d points: areas within %.1e of their mean after %d steps, %d of them halved; sum of areas within %.1e\n",
                count, error, steps, halves, std::abs(sum - 1));
    if (n_arguments > 2 && !picture.save(arguments[2])) {
        std::fprintf(stderr, "%s cannot be written\n", arguments[2]);
        return 1;
    }
    return error < 1e-6 ? 0 : 1;
}
